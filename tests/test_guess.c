/* What a step's iteration starts from: two extrapolations of the forces of the last two steps, and the
   choice between them.  The one for long steps against the solution of its equations by elimination in
   long double, and against the functions that it is to foretell; the choice against runs that are held
   to one of the two; and what comes after an extrapolation that led nowhere.  In float there is only one,
   of one step.                                                                 */
#ifndef GVI_REAL
#define GVI_REAL double
#endif
#include "gvi_test.h"

typedef gvi_real real;
enum { MOST = 8000 };
static real memory[MOST], more[MOST], saved[MOST];

/* Henon and Heiles: V = (x^2 + y^2)/2 + x^2 y - y^3/3                              */
static int henon_heiles(const gvi_points *p, void *user)
{
    const real *x = p->q, *y = x + p->stride;
    real *f = p->f, *g = f + p->stride;
    for (int k = 0; k < p->count; ++k) {
        f[k] -= x[k] + 2*x[k]*y[k];
        g[k] -= y[k] + x[k]*x[k] - y[k]*y[k];
    }
    return (void)user, 0;
}

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = henon_heiles } };
static const real q0[2] = { 0, (real)0.1L }, v0[2] = { (real)0.5L, 0 };

static void begin(gvi_stepper *st, gvi_desc desc, real *where)
{
    desc.n = 2;
    desc.effects = scene;
    desc.effect_count = 1;
    assert_true(gvi_size(&desc) > 0 && gvi_size(&desc) <= sizeof memory);
    assert_ok(gvi_init(st, &desc, where, sizeof memory));
    assert_ok(gvi_start(st, 0, q0, v0));
}

static void go(gvi_stepper *st, real h, int steps)
{
    while (steps-- > 0) assert_ok(gvi_step(st, h));
}

/* ------------------------------------------------------------- the table */

enum { NODES = 32 };                              /* of one step, of two no more than 18 */

static long double a_squared;                     /* 0.4 or 0.7, squared                 */
static long double correlation(long double d) { return 1/(1 + a_squared*d*d); }

/* w := (C(x_i - x_j) + e I)^-1 C(x_i - y), all nodes at once                        */
static void solve(int m, const long double *x, long double y, long double *w)
{
    long double K[NODES][NODES + 1];
    for (int i = 0; i < m; ++i) {
        for (int j = 0; j < m; ++j) K[i][j] = correlation(x[i] - x[j]) + (i == j ? 64*(long double)EPS : 0);
        K[i][m] = correlation(x[i] - y);
    }
    for (int k = 0; k < m; ++k) {
        int best = k;
        for (int i = k; i < m; ++i) if (fabsl(K[i][k]) > fabsl(K[best][k])) best = i;
        for (int j = 0; j <= m; ++j) {
            const long double z = K[k][j];
            K[k][j] = K[best][j];
            K[best][j] = z;
        }
        for (int i = 0; i < m; ++i) {
            const long double a = i == k ? 0 : K[i][k]/K[k][k];
            for (int j = k; j <= m; ++j) K[i][j] -= a*K[k][j];
        }
    }
    for (int k = 0; k < m; ++k) w[k] = K[k][m]/K[k][k];
}

/* Mean square error of a guess with the weights w, C(0) - 2 w'C(x - y) + w'(C(x - x) + e) w: the best
   has the least.  Weights are no surer than a system of condition 2/e lets them be, that error is.  */
static long double mean_square(int m, const long double *x, const long double *w, long double y)
{
    long double z = 1;
    for (int i = 0; i < m; ++i) {
        z += 64*(long double)EPS*w[i]*w[i] - 2*w[i]*correlation(x[i] - y);
        for (int j = 0; j < m; ++j) z += w[i]*w[j]*correlation(x[i] - x[j]);
    }
    return z;
}

static void check_table(gvi_rule_kind kind, int r)
{
    gvi_stepper st;
    long double x[NODES], best[NODES], ours[NODES];
    begin(&st, (gvi_desc){ .degree = kind == GVI_LOBATTO ? r - 1 : r, .rule = { .kind = kind, .points = r },
                           .formulation = GVI_POSITIONS }, memory);
    const int two = r < 10, nodes = two ? 2*r : r;
    assert_true(gvi__fits_long(&st));
    a_squared = two ? 0.16L : 0.49L;
    st.x.E_is = two ? GVI__OF_TWO : 0;
    assert_int_equal(gvi__fit_long(&st), 1);
    for (int j = 0; j < nodes; ++j) x[j] = j < r ? (long double)st.x.c[j] : (long double)st.x.c[j - r] - 1;
    for (int k = 0; k < r; ++k) {
        const long double y = 1 + (long double)st.x.c[k];
        for (int j = 0; j < nodes; ++j) ours[j] = st.x.E[j*st.x.stride + k];
        solve(nodes, x, y, best);
        const long double most = 1.1L*mean_square(nodes, x, best, y) + 64*LDBL_EPSILON;   // its own rounding
        assert_between(-64*LDBL_EPSILON, mean_square(nodes, x, ours, y), most);
    }
    assert_int_equal(st.counters.factorizations, 0);
}

static void the_table_for_long_steps_is_the_best_guess(void **state)
{
    (void)state;
    for (int r = 2; GVI__LEARNS && r <= NODES; ++r) {
        check_table(GVI_GAUSS, r);
        if (r > 2) check_table(GVI_LOBATTO, r);
    }
}

/* Where the nodes are not symmetric it has no halves: polynomials then, whatever is chosen   */
static void nodes_without_symmetry_have_none(void **state)
{
    static const real nodes[3] = { (real)0.1L, (real)0.4L, (real)0.9L };
    real weights[3], E[3*2*3];
    gvi_stepper st;
    (void)state;
    if (!GVI__LEARNS) return;
    // exact for 1, x and x^2
    for (int i = 0; i < 3; ++i) {
        const real a = nodes[(i + 1) % 3], b = nodes[(i + 2) % 3];
        weights[i] = ((real)1/3 - (a + b)/2 + a*b)/((nodes[i] - a)*(nodes[i] - b));
    }
    begin(&st, (gvi_desc){ .degree = 2, .formulation = GVI_POSITIONS,
                           .rule = { .kind = GVI_OWN, .points = 3, .nodes = nodes, .weights = weights } }, memory);
    assert_int_equal(gvi__fit_long(&st), 0);
    go(&st, (real)0.1L, 3);
    st.x.E_is = GVI__OF_TWO;
    gvi__fit(&st, 1, 1);
    memcpy(E, st.x.E, sizeof E);
    st.x.E_is = GVI__OF_TWO + GVI__LONG;
    gvi__fit(&st, 1, 1);
    assert_memory_equal(E, st.x.E, sizeof E);
}

/* ------------------------------------------------------------- the choice */

// never to try the other extrapolation, and to keep to this one
static void hold(gvi_stepper *st, int lengthy)
{
    st->x.learned.stage = GVI__IDLES;
    st->x.learned.steps = 0;
    st->x.learned.lengthy = (signed char)lengthy;
}

static unsigned long long held(gvi_desc desc, real h, int steps, int lengthy, real *q)
{
    gvi_stepper st;
    begin(&st, desc, more);
    for (int k = 0; k < steps; ++k) {
        hold(&st, lengthy);
        go(&st, h, 1);
    }
    q[0] = st.q[0];
    q[1] = st.q[1];
    return st.counters.iterations;
}

/* Steps of 2.1, or of 2.7 where the degree is 16, in which the fastest of the motion turns by 4: the best
   guess is chosen, after two steps without a choice, eight with polynomials and, more than those, eight
   that try.  Of 0.25: a step takes less than six rounds, nothing is tried.  Where the iteration ends does
   not depend on it.                                                            */
static void the_better_one_is_chosen(void **state)
{
    static const gvi_formulation pins[] = { GVI_POSITIONS, GVI_VELOCITIES, GVI_MOMENTA };
    (void)state;
    for (int f = 0; GVI__LEARNS && f < 2*COUNT(pins); ++f)
        for (int lengthy = 0; lengthy < 2; ++lengthy) {
            const gvi_desc desc = { .degree = f < COUNT(pins) ? 8 : 16, .formulation = pins[f % COUNT(pins)] };
            const real h = lengthy ? desc.degree == 8 ? (real)2.1L : (real)2.7L : (real)0.25L;
            const int steps = lengthy ? 200 : 1600;
            gvi_stepper st;
            real q[2], other[2];
            const unsigned long long polynomials = held(desc, h, steps, 0, q);
            const unsigned long long best_guess = held(desc, h, steps, 1, other);
            begin(&st, desc, memory);
            go(&st, h, steps);
            const unsigned long long rounds = st.counters.iterations;
            assert_int_equal(st.x.learned.lengthy, lengthy);
            for (int i = 0; i < 2; ++i) {
                assert_close(st.q[i], q[i], 2000*EPS);
                assert_close(other[i], q[i], 2000*EPS);
            }
            if (!lengthy) {
                assert_int_equal(rounds, polynomials);
                assert_true(best_guess > polynomials);
            } else {
                assert_true(100*best_guess < 95*polynomials);
                assert_between(0, rounds, (long double)best_guess + (long double)(polynomials - best_guess)/4);
            }
        }
}

/* What was found for one h says nothing of another, and nothing of another start         */
static void a_new_length_begins_anew(void **state)
{
    gvi_stepper st;
    (void)state;
    if (!GVI__LEARNS) return;
    begin(&st, (gvi_desc){ .degree = 8 }, memory);
    go(&st, (real)2.1L, 30);
    assert_int_equal(st.x.learned.lengthy, 1);
    go(&st, 2, 1);
    assert_int_equal(st.x.learned.lengthy, 0);
    assert_int_equal(st.x.learned.stage, GVI__MEASURES);
    go(&st, 2, 30);
    assert_int_equal(st.x.learned.lengthy, 1);
    assert_ok(gvi_start(&st, 0, q0, v0));
    go(&st, 2, 1);
    assert_int_equal(st.x.learned.lengthy, 0);
}

/* A thousand steps later the other one has its turn: the orbit may have become another one      */
static void the_choice_is_looked_at_again(void **state)
{
    gvi_stepper st;
    int tried = 0;
    (void)state;
    if (!GVI__LEARNS) return;
    begin(&st, (gvi_desc){ .degree = 8 }, memory);
    go(&st, (real)2.1L, 30);
    for (int k = 0; k < 1040; ++k) {
        go(&st, (real)2.1L, 1);
        tried += !st.x.learned.lengthy;
    }
    assert_int_equal(tried, 8);
    assert_int_equal(st.x.learned.lengthy, 1);
}

/* Where extrapolated values are refused the step begins again, and the other extrapolation has its turn.  A
   pendulum that refuses |q| > 2.5 and swings to 1, of whose 3000 steps of 2 polynomials miss two thirds.  */
static int narrow(const gvi_points *p, void *user)
{
    int *refused = (int *)user;
    for (int k = 0; k < p->count; ++k)
        if (!(fabsl((long double)p->q[k]) < 2.5L)) return ++*refused;
    for (int k = 0; k < p->count; ++k) p->f[k] -= (real)sinl((long double)p->q[k]);
    return 0;
}

static void refusals_count(void **state)
{
    int refused = 0;
    const gvi_effect pendulum = { .kind = GVI_POTENTIAL, .points = narrow, .user = &refused };
    const gvi_desc desc = { .n = 1, .degree = 6, .effects = &pendulum, .effect_count = 1,
                            .formulation = GVI_POSITIONS };
    const real q = 1, v = 0;
    gvi_stepper st;
    (void)state;
    if (!GVI__LEARNS) return;
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, &q, &v));
    go(&st, 2, 30);
    assert_int_equal(st.x.learned.lengthy, 1);
    refused = 0;
    go(&st, 2, 1000);
    assert_between(0, refused, 50);
}

static void slope(const long double *y, long double *dy)
{
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = -y[0] - 2*y[0]*y[1];
    dy[3] = -y[1] - y[0]*y[0] + y[1]*y[1];
}

static void runge_kutta(long double h, long double *y)
{
    static const long double at[4] = { 0, 0.5L, 0.5L, 1 }, weight[4] = { 1, 2, 2, 1 };
    long double k[4] = { 0, 0, 0, 0 }, sum[4] = { 0, 0, 0, 0 }, z[4];
    for (int s = 0; s < 4; ++s) {
        for (int i = 0; i < 4; ++i) z[i] = y[i] + at[s]*h*k[i];
        slope(z, k);
        for (int i = 0; i < 4; ++i) sum[i] += weight[s]*k[i];
    }
    for (int i = 0; i < 4; ++i) y[i] += h/6*sum[i];
}

static void long_steps(gvi_formulation pin)
{
    gvi_stepper st;
    long double y[4] = { q0[0], q0[1], v0[0], v0[1] };
    const real h = (real)3.3L;
    begin(&st, (gvi_desc){ .degree = 16, .formulation = pin }, memory);
    for (int k = 0; k < 40; ++k) {
        const unsigned long long before = st.counters.iterations;
        go(&st, h, 1);
        for (int i = 0; i < 2000; ++i) runge_kutta(h/2000.0L, y);
        for (int i = 0; i < 2; ++i) assert_close(st.q[i], y[i], 1e-9L);
        if (k > 4) assert_int_equal(st.counters.iterations - before, (unsigned)st.iterations);    // none was lost
    }
    assert_int_equal(st.x.learned.lengthy, 1);
    assert_int_equal(st.counters.failures, 0);
    assert_int_equal(st.counters.newton_iterations, 0);
}

/* Where the extrapolation leads nowhere, plain rows do, and the other one has its turn at once: in steps of
   3.3 polynomials of degree 15 miss by a thousand times the motion.  It ends where Runge and Kutta do, in
   2000 parts of a step, to their 1e-10; and AUTO has no reason to turn to Newton's method.        */
static void what_led_nowhere_is_not_tried_again(void **state)
{
    (void)state;
    if (!GVI__LEARNS) return;
    long_steps(GVI_POSITIONS);
    long_steps(GVI_MOMENTA);
    long_steps(GVI_AUTO);
}

/* A deadline gives the rounds: none are to be saved, and what they leave is that of polynomials   */
static void given_rounds_try_nothing(void **state)
{
    gvi_stepper st;
    (void)state;
    begin(&st, (gvi_desc){ .degree = 8, .iterations = 12 }, memory);
    go(&st, (real)2.1L, 40);
    assert_int_equal(st.x.learned.steps, 0);
    assert_int_equal(st.x.learned.lengthy, 0);
}

/* Saved before the trial, during it and after: steps go on to the same bits, queries in between or not */
static void a_checkpoint_keeps_the_choice(void **state)
{
    (void)state;
    for (int at = 8; at < 26; at += 6) {
        gvi_stepper st, copy;
        real q[2], p[2];
        begin(&st, (gvi_desc){ .degree = 8 }, memory);
        go(&st, (real)2.1L, at);
        copy = st;
        memcpy(saved, memory, sizeof memory);
        assert_ok(gvi_state_at(&st, st.t - 1, q, NULL, NULL));
        go(&st, (real)2.1L, 20);
        memcpy(q, st.q, sizeof q);
        memcpy(p, st.p, sizeof p);
        assert_ok(gvi_restore(&st, &copy, saved));
        go(&st, (real)2.1L, 20);
        assert_memory_equal(st.q, q, sizeof q);
        assert_memory_equal(st.p, p, sizeof p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_for_long_steps_is_the_best_guess),
        cmocka_unit_test(nodes_without_symmetry_have_none),
        cmocka_unit_test(the_better_one_is_chosen),
        cmocka_unit_test(a_new_length_begins_anew),
        cmocka_unit_test(the_choice_is_looked_at_again),
        cmocka_unit_test(refusals_count),
        cmocka_unit_test(what_led_nowhere_is_not_tried_again),
        cmocka_unit_test(given_rounds_try_nothing),
        cmocka_unit_test(a_checkpoint_keeps_the_choice),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
