/* Many coordinates go in whole vectors, one alone does not.  Coordinates that know nothing of each other
   have to move as each of them alone, to the bit: explicit and in the fixed points, any mass that is a number
   for each, rounded or not, steps forward and back, one that fails between them.                  */
#include "gvi_test.h"

typedef gvi_real real;

enum { MOST = 100, STEPS = 40 };

/* the coordinate of a stepper that has one, or -1; which of them is NaN, or -1 */
typedef struct place { int alone, bad; } place;

static real masses[MOST];

/* an oscillator each, of its own frequency, with a cubic term and a drive; whole numbers over powers of two */
static int springs(const gvi_points *x, void *user)
{
    const place *w = (const place *)user;
    for (int i = 0; i < x->n; ++i) {
        const int is = w->alone < 0 ? i : w->alone;
        const real k = 1 + (real)(is % 7)/4, cubic = (real)(is % 5)/8;
        for (int j = 0; j < x->count; ++j) {
            const real q = x->q[i*x->stride + j];
            x->f[i*x->stride + j] += (x->t[j]/4 - k*q) - cubic*(q*q*q);
            if (is == w->bad) x->f[i*x->stride + j] += (real)NAN;
        }
    }
    return 0;
}

static real q_of(int i) { return (real)((37*i) % 64 - 31)/32; }
static real p_of(int i) { return (real)((23*i) % 64 - 17)/16; }

typedef struct rule_of_test { const char *name; int degree; gvi_rule rule; int iterations; } rule_of_test;

/* Stoermer-Verlet; a drift first; a kick first that the last step does not know, and one of weight 0 */
static const real drift_c[] = { (real)0.25L, (real)0.75L }, half[] = { (real)0.5L, (real)0.5L };
static const real some_c[] = { 0, (real)0.375L, (real)0.625L, 1 };
static const real some_b[] = { (real)0.3125L, (real)0.25L, (real)0.4375L, 0 };
static const rule_of_test rules[] = {
    { "Verlet",      1, { .kind = GVI_LOBATTO, .points = 2 }, 0 },
    { "drift first", 1, { GVI_KICKS, 2, drift_c, half }, 0 },
    { "weight 0",    1, { GVI_KICKS, 4, some_c, some_b }, 0 },
    { "degree 2",    2, { .kind = GVI_GAUSS }, 5 },
    { "degree 4",    4, { .kind = GVI_GAUSS }, 5 },
    { "degree 8",    8, { .kind = GVI_GAUSS }, 6 },
    { "degree 12",  12, { .kind = GVI_GAUSS }, 6 } };

static gvi_desc describe(const rule_of_test *r, int n, int diagonal, real tolerance, const gvi_effect *scene)
{
    const place *w = (const place *)scene->user;
    gvi_desc d = { .n = n, .degree = r->degree, .rule = r->rule, .effects = scene, .effect_count = 1,
                   .tolerance = tolerance, .iterations = r->iterations };
    if (r->iterations) d.formulation = GVI_POSITIONS;
    if (diagonal) d.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = masses + (w->alone < 0 ? 0 : w->alone) };
    return d;
}

/* One step fails where bad is a coordinate: nothing may have moved.  z: q, then p, at the end; the same inside the
   last step, which wants its start                                            */
static void run(const gvi_desc *d, place *w, int bad, real *z)
{
    static real memory[60000];
    real was[2*MOST], q0[MOST], p0[MOST];
    const int n = d->n, first = w->alone < 0 ? 0 : w->alone;
    gvi_stepper st;
    assert_true(gvi_size(d) > 0 && gvi_size(d) <= sizeof memory);
    for (int i = 0; i < n; ++i) {
        q0[i] = q_of(first + i);
        p0[i] = p_of(first + i);
    }
    assert_ok(gvi_init(&st, d, memory, sizeof memory));
    assert_ok(gvi_start_momentum(&st, 0, q0, p0));
    for (int k = 0; k < STEPS; ++k) {
        if (bad >= 0 && k % 9 == 4) {
            memcpy(was, st.q, sizeof(real)*(size_t)n);
            memcpy(was + n, st.p, sizeof(real)*(size_t)n);
            w->bad = bad;
            assert_status(gvi_step(&st, (real)0.1L), GVI_E_NON_FINITE);
            w->bad = -1;
            assert_memory_equal(was, st.q, sizeof(real)*(size_t)n);
            assert_memory_equal(was + n, st.p, sizeof(real)*(size_t)n);
        }
        assert_ok(gvi_step(&st, k == 17 ? (real)-0.07L : (real)0.1L));
    }
    memcpy(z, st.q, sizeof(real)*(size_t)n);
    memcpy(z + n, st.p, sizeof(real)*(size_t)n);
    assert_ok(gvi_state_at(&st, st.t - (real)0.07L, z + 2*n, NULL, z + 3*n));
}

static void compare(const rule_of_test *r, int n, int diagonal, real tolerance)
{
    real z[4*MOST], one[4];
    for (int bad = -1; bad < n; bad += n - 1) {
        place w = { -1, -1 };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = &w } };
        const gvi_desc d = describe(r, n, diagonal, tolerance, scene);
        run(&d, &w, bad, z);
    }
    for (int i = 0; i < n; ++i) {
        place w = { i, -1 };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = &w } };
        const gvi_desc d = describe(r, 1, diagonal, tolerance, scene);
        run(&d, &w, i, one);
        for (int k = 0; k < 4; ++k)
            if (z[k*n + i] < one[k] || z[k*n + i] > one[k])
                fail_msg("%s, %d coordinates%s%s: number %d of %d is %.17Lg, alone %.17Lg", r->name, n,
                         diagonal ? ", masses" : "", tolerance > 0 ? ", tolerance" : "", k, i,
                         (long double)z[k*n + i], (long double)one[k]);
    }
}

TEST(each_of_many_moves_as_alone)
{
    static const int counts[] = { 3, 8, 13, MOST };
    for (int i = 0; i < MOST; ++i) masses[i] = (real)(3 + i % 11)/4;
    for (int k = 0; k < COUNT(rules); ++k)
        for (int j = 0; j < COUNT(counts); ++j)
            for (int with = 0; with < 4; ++with)
                compare(&rules[k], counts[j], with & 1, with & 2 ? (real)1e-4L : 0);
}

RUN_TESTS(NULL, NULL)
