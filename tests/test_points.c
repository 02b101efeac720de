/* GVI_POINTS: the callback that it makes of one point gives the bits of a loop over points written
   by hand, for every kind of callback, every number of points and the padding behind them; bodies that
   no compiler makes vectors of as well.  Expected values are those of the loops in points.h. */
#include "gvi_test.h"
#include "points.h"

enum { N = 18, ROW = 24 };

typedef struct arrays {
    gvi_real t[ROW], q[N*ROW], v[N*ROW], p[N*ROW], f[N*ROW], dldv[N*ROW], value[ROW], mass[N*N*ROW], velocity[N*ROW],
        g[2*ROW], jacobian[2*4*ROW], rate[2*ROW];
} arrays;
static arrays one, two;
static gvi_real field = (gvi_real)1.25;

static const int sizes[][2] = { { 1, 1 }, { 2, 2 }, { 3, 3 }, { 4, 4 }, { 5, 8 }, { 8, 8 }, { 9, 16 }, { 16, 16 }, { 17, 24 } };

static void fill(arrays *a)
{
    gvi_real *z = a->t;
    for (size_t i = 0; i < sizeof *a/sizeof *z; ++i) z[i] = (gvi_real)((i*7919 + 13)%1009)/800;
}

/* All arrays of `a` that a callback with these outputs may see */
static gvi_points points_of(arrays *a, int n, int size, const char *outputs)
{
    gvi_points x = { .n = n, .count = sizes[size][0], .stride = sizes[size][1], .t = a->t, .q = a->q, .v = a->v, .p = a->p };
    if (strchr(outputs, 'f')) x.f = a->f;
    if (strchr(outputs, 'd')) x.dldv = a->dldv;
    if (strchr(outputs, 'V')) x.value = a->value;
    if (strchr(outputs, 'M')) x.mass = a->mass;
    if (strchr(outputs, 'v')) x.velocity = a->velocity;
    if (strchr(outputs, 'g')) {                    // what the library gives is 0 where it is not written
        x.g = a->g, x.jacobian = a->jacobian, x.rate = a->rate;
        memset(a->jacobian, 0, sizeof a->jacobian);
        memset(a->rate, 0, sizeof a->rate);
    }
    return x;
}

/* Rows differ at most in their padding */
static void assert_rows(int rows, const gvi_points *x, const gvi_real *a, const gvi_real *b)
{
    for (int i = 0; i < rows; ++i)
        assert_same_numbers(a + i*x->stride, b + i*x->stride, x->count);
}

static void assert_same(int n, gvi_points_fn *made, gvi_points_fn *loop, const char *outputs)
{
    for (int size = 0; size < COUNT(sizes); ++size) {
        fill(&one);
        fill(&two);
        const gvi_points x = points_of(&one, n, size, outputs), y = points_of(&two, n, size, outputs);
        assert_int_equal(made(&x, &field), loop(&y, &field));
        assert_rows(n, &x, one.f, two.f);
        assert_rows(n, &x, one.dldv, two.dldv);
        assert_rows(1, &x, one.value, two.value);
        for (int i = 0; i < n; ++i) assert_rows(i + 1, &x, one.mass + i*n*x.stride, two.mass + i*n*x.stride);
        assert_rows(n, &x, one.velocity, two.velocity);
        assert_rows(2, &x, one.g, two.g);
        assert_rows(2*4, &x, one.jacobian, two.jacobian);
        assert_rows(2, &x, one.rate, two.rate);
    }
}

static int kepler_both(const gvi_points *x, void *user)
{
    return kepler_loop(x, user) | kepler_value_loop(x, user);
}

static int magnetic_both(const gvi_points *x, void *user)
{
    return magnetic_loop(x, user) | magnetic_value_loop(x, user);
}

TEST(every_kind_of_callback_has_the_bits_of_a_loop)
{
    assert_same(2, kepler, kepler_loop, "f");
    assert_same(2, kepler, kepler_value_loop, "V");
    assert_same(2, kepler, kepler_both, "fV");
    assert_same(18, bodies, bodies_loop, "f");
    assert_same(1, pendulum, pendulum_loop, "f");
    assert_same(3, arm_mass, arm_mass_loop, "M");
    assert_same(3, arm_gradient, arm_gradient_loop, "f");
    assert_same(2, magnetic, magnetic_loop, "fd");
    assert_same(2, magnetic, magnetic_value_loop, "V");
    assert_same(2, magnetic, magnetic_both, "fdV");
    assert_same(2, relativistic, relativistic_loop, "v");
    assert_same(4, rods, rods_loop, "g");
}

TEST(rows_have_the_bits_of_a_loop_over_coordinates)
{
    assert_same(N, chain, chain_loop, "f");
    assert_same(3, chain, chain_loop, "f");
}

/* A failure counts where there is a point, and not in the padding */
TEST(a_failure_counts_at_points_alone)
{
    for (int size = 0; size < COUNT(sizes); ++size)
        for (int k = 0; k < sizes[size][1]; ++k) {
            fill(&one);
            const gvi_points x = points_of(&one, 2, size, "v");
            one.p[k] = -2;
            assert_int_equal(relativistic(&x, NULL) != 0, k < x.count);
        }
}

/* Loops, indices that only the run knows, branches: the array of one point stays in memory */
GVI_POINTS(all_pairs, 12, v, f)(const gvi_points *x, void *user)
{
    for (int i = 0; i < 12; ++i)
        for (int j = 0; j < i; ++j) {
            const gvi_real d = x->q[i] - x->q[j];
            if (d > 1) continue;
            x->f[i] -= d;
            x->f[j] += d*x->v[i];
        }
    return (void)user, 0;
}

static int all_pairs_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < 12; ++i)
            for (int j = 0; j < i; ++j) {
                const gvi_real d = x->q[i*s + k] - x->q[j*s + k];
                if (d > 1) continue;
                x->f[i*s + k] -= d;
                x->f[j*s + k] += d*x->v[i*s + k];
            }
    return (void)user, 0;
}

TEST(what_stays_a_loop_has_the_same_bits)
{
    assert_same(12, all_pairs, all_pairs_loop, "f");

}

RUN_TESTS(NULL, NULL)
