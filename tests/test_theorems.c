/* The theorems of docs/theory.md, the part of them that fits in seconds.  The
   measurements are those of the studies in tests/theorems/, whose headers say what
   the expected values are and why they owe nothing to gvi.h.

   Not here, because it is elsewhere: the double pendulum's orders, the state inside
   a step and weak rules (test_order.c), conjugate points of the oscillator and the
   derivatives of L_d and its forces (test_queries.c), other methods that steps are
   (test_identities.c, test_oracle.c). */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#define OWN_REAL
#include "gvi_test.h"
#include "theorems/inertia.h"
#include "theorems/modified.h"
#include "theorems/spectral.h"
#include "theorems/stability.h"

static int misses;

/* A slope within `within` of what theory says, from both sides */
static void expect_slope(const char *what, error_fn *error, const problem *pb, const method *m, int expected,
                         int most, real within)
{
    real got = slope(error, pb, m, expected, most);
    if (fabs(got - expected) <= within) return;                        /* false for NaN */
    ++misses;
    print_error("%s, %s, s = %d, rule %d with %d points: exponent %.3Lf, not %d +- %.2Lf\n",
                what, pb->name, m->s, (int)m->rule.kind, m->rule.points, (long double)got, expected,
                (long double)within);
}

/* Gauss s, Lobatto s, Lobatto s + 1 in turn; u = 2s, 2s - 2, 2s.  0: there is none */
static int rule_of(int k, int s, method *m)
{
    int r = k == 2 ? s + 1 : s;
    *m = (method){ s, { k ? GVI_LOBATTO : GVI_GAUSS, .points = r } };
    return k == 1 ? (s > 1 ? 2*s - 2 : 0) : 2*s;
}

/* Exponent u/share + more, all degrees up to s and those rules */
static void expect_slopes(const char *what, error_fn *error, const problem *pb, int s, int share, int more, int most,
                          real within)
{
    for (int degree = 1; degree <= s; ++degree)
        for (int k = 0; k < 3; ++k) {
            method m;
            const int u = rule_of(k, degree, &m);
            if (u) expect_slope(what, error, pb, &m, u/share + more, most, within);
        }
}

static const problem *conservative(int k) { return k ? &problems[k - 1] : &oscillator; }

/* Against itself with half the step, and against Kepler's equation */
TEST(the_reference_is_exact_to_rounding)
{
    for (int k = 0; k <= PROBLEMS; ++k)
        for (int start = 0; start < STARTS; ++start) {
            const problem *pb = conservative(k);
            real y[MAX_Y];
            start_state(pb, start, y);
            flow_with(pb, 0, pb->time, 1/64.0L, y);
            assert_close(sqrt(square_distance(2*pb->n + 1, y, run_state(pb, start, 1))), 0, 20*EPS);
        }
    real y[MAX_Y], end[4];
    kepler_state(0.5L, -1, y, y + 2);
    kepler_state(0.5L, 1, end, end + 2);
    flow_of(&problems[0], 0, 2, y);
    assert_close(sqrt(square_distance(4, y, end)), 0, 20*EPS);
}

TEST(the_discrete_lagrangian_is_exact_to_one_power_more)
{
    misses = 0;
    for (int i = 0; i <= PROBLEMS; ++i) expect_slopes("L_d", lagrangian_error, conservative(i), 4, 1, 1, 48, 0.15L);
    assert_int_equal(misses, 0);
}

/* Two that know nothing of each other */
TEST(degree_24_gives_the_exact_discrete_lagrangian)
{
    const method m = { 24, { 0 } };
    for (int i = 0; i <= PROBLEMS; ++i) assert_close(lagrangian_error(conservative(i), &m, 0.25L), 0, 8*EPS);
    for (int i = 0; i < FORCED; ++i) assert_close(lagrangian_error(&forced_problems[i], &m, 0.25L), 0, 8*EPS);
}

/* The hypotheses hold for the 3/8 rule with s = 4 and Boole's with s = 5, and the order is not min(2s, u) = 4, 6.
   Milne's rule with s = 3 is the converse: a negative weight, no minimum at any step, and the full order. */
TEST(a_rule_that_is_too_weak_lowers_the_order_although_every_curve_is_a_minimum)
{
    static const struct { int r, s, order, top, negative; } cases[] = {
        { 4, 3, 4, 0, 0 }, { 4, 4, 2, -2, 0 }, { 5, 4, 6, 0, 0 }, { 5, 5, 4, -2, 0 }, { 3, 3, 4, 0, 2 }
    };
    misses = 0;
    for (int k = 0; k < COUNT(cases); ++k)
        for (int i = 0; i < 3; i += 2) {
            const problem *pb = &problems[i];
            const own_rule rule = cases[k].r == 3 ? milne : newton_cotes(cases[k].r);
            const method m = { cases[k].s, rule_or_own(GVI_OWN, rule.r, &rule) };
            expect_slope("step", end_error, pb, &m, cases[k].order, 96, 0.15L);
            expect_slope("L_d", lagrangian_error, pb, &m, cases[k].order + 1, 96, 0.15L);
            expect_slope("d^s q/dt^s", top_derivative, pb, &m, cases[k].top, 192, 0.15L);
            assert_int_equal(most_negative(pb, &m), cases[k].negative);
        }
    assert_int_equal(misses, 0);
}

static int which_norm;
static curve_kind which_curve;

static real norm_error(const problem *pb, const method *m, real h)
{
    real norm[NORMS];
    curve_norms(pb, m, h, which_curve, norm);
    return norm[which_norm];
}

/* Theorem 5.1, the curve between given ends: exactly min(s, u/2) + 1 in the maximum norm, one more in L1, one less
   each for the velocity */
TEST(the_curve_has_order_min_s_and_half_u_plus_one)
{
    static const int more[NORMS] = { 1, 2, 0, 1 };
    misses = 0;
    which_curve = OF_THE_ENDS;
    for (int i = 0; i < PROBLEMS; ++i)
        for (which_norm = 0; which_norm < NORMS; ++which_norm)
            expect_slopes("curve", norm_error, &problems[i], 4, 2, more[which_norm], 192, 0.15L);
    assert_int_equal(misses, 0);
}

/* Lemma 3.1, k = 0, 1: without a method, from the solution alone */
TEST(a_polynomial_of_degree_s_comes_as_near_as_s_plus_1)
{
    misses = 0;
    which_curve = INTERPOLANT;
    for (int i = 0; i < PROBLEMS; ++i)
        for (int s = 1; s <= 4; ++s)
            for (which_norm = 0; which_norm < NORMS; which_norm += 2)
                expect_slope("interpolant", norm_error, &problems[i], &(method){ s, { 0 } }, s + 1 - which_norm/2, 48, 0.15L);
    assert_int_equal(misses, 0);
}

static int which_part;

static real part_error(const problem *pb, const method *m, real h)
{
    real error[PARTS];
    force_errors(pb, m, h, error);
    return error[which_part];
}

/* Section 6.2 bounds L_d and the discrete forces by O(h^(s+1)) */
TEST(forces_cost_no_order_of_the_step_of_the_discrete_lagrangian_or_of_the_discrete_forces)
{
    static const char *const part[PARTS] = { "D_1 L_d", "D_2 L_d", "F-", "F+" };
    static const int top[FORCED] = { 4, 4, 2 }, most[FORCED] = { 24, 24, 64 };     /* M(q) has no Hessian: sqrt(EPS) */
    misses = 0;
    for (int i = 0; i < FORCED; ++i) {
        expect_slopes("step", end_error, &forced_problems[i], 5, 1, 0, 48, 0.2L);
        expect_slopes("L_d", lagrangian_error, &forced_problems[i], 4, 1, 1, 48, 0.2L);
        for (which_part = 0; which_part < PARTS; ++which_part)
            expect_slopes(part[which_part], part_error, &forced_problems[i], top[i], 1, 0, most[i], 0.2L);
    }
    assert_int_equal(misses, 0);
}

/* Section 6.3: Kepler with drag f = -|v|v/20 as stationary action in variables x = (q1, q2), y = (q3, q4):
     L(x) - L(y) + (f(x) + f(y))'(x - y)/2 */
static int two_copies(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    real pull_y[2] = { 0 }, x[2] = { 0 }, y[2] = { 0 }, X[4] = { 0 }, Y[4] = { 0 };
    attraction_at(t, q, v, f, NULL, NULL);
    attraction_at(t, q + 2, v, pull_y, NULL, NULL);
    air(t, q, v, x, NULL, NULL);
    air(t, q + 2, v + 2, y, NULL, NULL);
    air_hessian(t, q, v, NULL, X, NULL, NULL);
    air_hessian(t, q + 2, v + 2, NULL, Y, NULL, NULL);
    for (int i = 0; i < 2; ++i) {
        f[i] += (x[i] + y[i])/2;
        f[2 + i] -= pull_y[i] + (x[i] + y[i])/2;
        for (int j = 0; j < 2; ++j) {
            dldv[i] += X[2*i + j]*(q[j] - q[2 + j])/2;
            dldv[2 + i] += Y[2*i + j]*(q[j] - q[2 + j])/2;
        }
    }
    return 0;
}

TEST(doubled_variables_move_as_the_forced_system_and_are_a_saddle)
{
    static const real masses[4] = { 1, 1, -1, -1 };
    const problem *pb = &forced_problems[1];
    for (int s = 1; s <= 8; ++s)
        for (int k = 0; k < 3; k += 2) {
            method m;
            rule_of(k, s, &m);
            const gvi_effect scene[] = { { .kind = GVI_LAGRANGIAN, .point = two_copies } };
            const gvi_desc desc = { .n = 4, .degree = s, .rule = m.rule,
                                    .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = masses },
                                    .effects = scene, .effect_count = 1 };
            const real *q = pb->q[0], *v = pb->v[0];
            const real q0[4] = { q[0], q[1], q[0], q[1] }, v0[4] = { v[0], v[1], v[0], v[1] };
            real y[MAX_Y], q1[4];
            int negative = -1;
            gvi_stepper twice = new_motion(&desc, 0, q0, v0);
            start_state(pb, 0, y);
            gvi_stepper *once = bench(pb, &m, 0, y);
            for (int step = 0; step < 200; ++step) {
                assert_ok(gvi_step(&twice, 1/32.0L));
                assert_ok(gvi_step(once, 1/32.0L));
                if (step == 0) memcpy(q1, twice.q, sizeof q1);
                for (int i = 0; i < 4; ++i) {
                    assert_true(twice.q[i] == once->q[i%2]);
                    assert_true(twice.p[i] == (i < 2 ? 1 : -1)*once->p[i%2]);
                }
            }
            assert_ok(gvi_discrete_lagrangian(&twice, 0, 1/32.0L, q0, q1, &(gvi_discrete){ .negative = &negative }));
            assert_int_equal(negative, 2*(s - 1));
        }
}

static int which_energy;

static real energy_error(const problem *pb, const method *m, real h)
{
    real range[ENERGIES];
    energy_ranges(pb, m, h, range);
    return range[which_energy];
}

static real shift_error(const problem *pb, const method *m, real h)
{
    return fabs(shift_measured(0.5L, h) - shift_predicted(0.5L, h));
}

TEST(verlet_keeps_the_energy_of_its_modified_lagrangian)
{
    static const problem *const which[2] = { &pendulum, &problems[0] };
    misses = 0;
    for (int i = 0; i < 2; ++i) {
        expect_slope("energy of L_mod less H_mod", legendre_error, which[i], &verlet, 6, 96, 0.15L);
        for (which_energy = 0; which_energy < ENERGIES; ++which_energy)
            expect_slope("energy", energy_error, which[i], &verlet, 2 + 2*which_energy, 1600, 0.15L);
    }
    assert_int_equal(misses, 0);
}

TEST(keplers_ellipse_turns_as_the_modified_lagrangian_predicts)
{
    misses = 0;
    expect_slope("perihelion less its prediction", shift_error, &problems[0], &verlet, 4, 500, 0.15L);
    assert_int_equal(misses, 0);
}

/* A factor rho^-2 a degree, within 15 per cent, over ten degrees; then flat */
TEST(the_error_falls_with_the_degree_as_fast_as_the_solution_is_analytic)
{
    static const struct { real h; int from; } cases[] = { { 0.5L, 5 }, { 1, 10 } };
    for (int i = 0; i < COUNT(cases); ++i) {
        real h = cases[i].h, rho = rho_of(0.5L, h);
        real first = pericentre_error(0.5L, h, cases[i].from);
        real last = pericentre_error(0.5L, h, cases[i].from + 10);
        real rate = pow(last/first, 0.1L);
        assert_between(0.85L, rate*rho*rho, 1.15L);
    }
}

TEST(at_high_degree_the_error_of_a_large_step_stays_at_rounding)
{
    static const real h[PROBLEMS] = { 0.5L, 0.5L, 1, 1 };
    for (int i = 0; i < PROBLEMS; ++i)
        for (int s = 24; s <= 64; s += 8) {
            const method m = { s, { 0 } };
            assert_between(0, step_error(&problems[i], &m, h[i]), 8*EPS);
        }
}

/* Morse: conjugate points inside, of nonlinear motions, on both sides of each */
TEST(negative_directions_are_as_many_as_conjugate_points)
{
    static const struct { int problem, start; real top; } cases[] = { { 1, 2, 2 }, { 2, 0, 3 }, { 3, 0, 5 } };
    const method m = { 16, { 0 } };
    for (int i = 0; i < COUNT(cases); ++i) {
        const problem *pb = &problems[cases[i].problem];
        real y[MAX_Y], last, step = 0.05L;
        int count = 0, asked = 0;
        start_state(pb, cases[i].start, y);
        last = jacobi_determinant(pb, 0, y, step);
        for (real h = 2*step; h < cases[i].top; h += step) {
            real now = jacobi_determinant(pb, 0, y, h);
            count += (now < 0) != (last < 0);
            last = now;
            int index = index_of_step(pb, &m, 0, y, h);          // -1: it found another curve
            assert_true(index == count || index == -1);
            asked += index == count && count > 0;
        }
        assert_true(count >= 1 && asked >= 5);
    }
}

/* Relative to the size of the matrix's entries, up to h^2 = 400 of which meet */
TEST(the_stability_functions_are_those_of_theory)
{
    for (int s = 1; s <= 6; ++s)
        for (int k = 0; k < 200; ++k) {
            const method gauss_s = { s, { GVI_GAUSS, .points = s } };
            const method lobatto_s = { s, { GVI_LOBATTO, .points = s + 1 } };
            real h = (k + 0.5L)/10, want = lobatto_half_trace(s + 1, h), turn = half_trace(&gauss_s, h);
            assert_close(turn, gauss_half_trace(s, h), 32*EPS);
            assert_between(-1 - 32*EPS, turn, 1 + 32*EPS);
            assert_close(half_trace(&lobatto_s, h), want, 400*EPS*(1 + want*want));
        }
}

RUN_TESTS(NULL, NULL)
