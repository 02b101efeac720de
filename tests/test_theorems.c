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
#include "theorems/constant.h"
#include "theorems/inertia.h"
#include "theorems/modified.h"
#include "theorems/printed.h"
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

/* Exponent u + more, all degrees up to s and those rules */
static void expect_slopes(const char *what, error_fn *error, const problem *pb, int s, int more, int most, real within)
{
    for (int degree = 1; degree <= s; ++degree)
        for (int k = 0; k < 3; ++k) {
            method m;
            const int u = rule_of(k, degree, &m);
            if (u) expect_slope(what, error, pb, &m, u + more, most, within);
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
    for (int i = 0; i <= PROBLEMS; ++i) expect_slopes("L_d", lagrangian_error, conservative(i), 4, 1, 48, 0.15L);
    assert_int_equal(misses, 0);
}

/* Theorem 2.1 asks for all ends that are near, not for those of one solution */
TEST(and_between_the_ends_of_a_curve_that_is_no_solution)
{
    misses = 0;
    for (int i = 0; i < PROBLEMS; i += 5) expect_slopes("L_d", any_lagrangian_error, &problems[i], 3, 1, 48, 0.2L);
    assert_int_equal(misses, 0);
}

/* Two that know nothing of each other */
TEST(degree_20_gives_the_exact_discrete_lagrangian)
{
    const method m = { 20, { 0 } };
    for (int i = 0; i <= PROBLEMS; ++i) assert_close(lagrangian_error(conservative(i), &m, 0.25L), 0, 8*EPS);
    for (int i = 0; i < FORCED; ++i) assert_close(lagrangian_error(&forced_problems[i], &m, 0.25L), 0, 8*EPS);
}

/* ------------------------------------------------- theorem 4.1, corrected

   The step, by gvi.h where it takes the rule and by galerkin.h where not: nodes at random, weights of any sign,
   u = s..2s and beyond, kinetic energies of both signs, M(t, q, v), magnetic terms, time, forces            */
TEST(the_order_of_a_step_is_the_least_of_2s_u_and_2_u_less_s_plus_1)
{
    misses = 0;
    for (int more = 0; more <= 2; more += 2)
        for (int u = more ? 3 : 1; u <= (more ? 4 : 7); ++u)
            for (int s = 1; s <= least(u, 4); ++s) {
                const own_rule rule = random_rule(u + more, u, 1), outside = random_rule(u + more, u, 1.4L);
                const method m = { s, rule_or_own(GVI_OWN, rule.r, &rule) };
                const method out = { s, rule_or_own(GVI_OWN, outside.r, &outside) };
                const int order = order_expected(s, u);
                for (int i = 1; i < PROBLEMS; ++i) expect_slope("step", step_error, &problems[i], &m, order + 1, 1600, 0.25L);
                for (int i = 1; i < FORCED; i += 2)
                    expect_slope("step", step_error, &forced_problems[i], &m, order + 1, 1600, 0.25L);
                if (more == 0) expect_slope("outside", own_step_error, &forced_problems[3], &out, order + 1, 1600, 0.25L);
            }
    assert_int_equal(misses, 0);
}

/* And L_d, with them; Newton-Cotes and Milne's rule */
TEST(the_discrete_lagrangian_follows_it_with_weak_rules_and_forces)
{
    misses = 0;
    for (int u = 2; u <= 6; ++u)
        for (int s = 2; s <= least(u, 4); ++s) {
            const own_rule rule = random_rule(u, u, 1);
            const method m = { s, rule_or_own(GVI_OWN, u, &rule) };
            expect_slope("L_d", lagrangian_error, &problems[5], &m, order_expected(s, u) + 1, 400, 0.25L);
            expect_slope("L_d", lagrangian_error, &forced_problems[3], &m, order_expected(s, u) + 1, 400, 0.25L);
        }
    assert_int_equal(misses, 0);
}

TEST(gvi_h_solves_the_equations_of_the_definition)
{
    for (int u = 2; u <= 7; ++u)
        for (int i = 0; i < PROBLEMS + FORCED; ++i) {
            const problem *pb = i < PROBLEMS ? &problems[i] : &forced_problems[i - PROBLEMS];
            const own_rule rule = random_rule(u, u, 1);
            const int s = (u + 2)/2;
            const method m = { s, rule_or_own(GVI_OWN, u, &rule) };
            const real h = 1/32.0L, t = step_time(pb, h);
            real y0[MAX_Y], y1[MAX_Y], v[MAX_N];
            exact_step(pb, 0, h, y0, y1);
            const curve_of a = curve_between(pb, &rule, s, t, h, y0, y1);
            pb->velocity(t, y0, y0 + pb->n, v);
            assert_close(lagrangian_less(pb, &m, h, y0, v, y1, a.action), 0, 4*EPS);
            gvi_stepper *st = bench(pb, &m, t, y0);
            assert_ok(gvi_step(st, h));
            assert_true(step_of_curve(pb, &rule, s, t, h, y0));
            assert_close(sqrt(square_distance(pb->n, st->q, y0) + square_distance(pb->n, st->p, y0 + pb->n)), 0, 64*EPS);
        }
}

TEST(the_leading_term_of_the_discrete_lagrangian_is_known_to_one_per_cent)
{
    const own_rule smallest = { "", 3, 3, { 0.25L, 0.5L, 1 }, { 4/9.0L, 1/3.0L, 2/9.0L } };
    const struct { own_rule rule; int s, steps; } cases[] = {
        { smallest, 3, 4096 }, { newton_cotes(4), 4, 512 }, { random_rule(6, 4, 1), 4, 1024 }, { newton_cotes(5), 5, 128 },
        { gauss(3), 2, 64 },
    };
    for (int k = 0; k < COUNT(cases); ++k)
        for (int i = 0; i <= PROBLEMS; ++i)
            assert_close(constant_seen(conservative(i), &cases[k].rule, cases[k].s, 1/(real)cases[k].steps), 1, 0.01L);
}

/* Theorem 4.1 as printed: the 3/8 rule with s = 4 has order min(2s, u) = 4 */
TEST(the_three_eighths_rule_with_degree_4_is_wrong_by_h_squared_over_72)
{
    const own_rule rule = newton_cotes(4);
    const method m = { 4, rule_or_own(GVI_OWN, 4, &rule) };
    const real h = 1/64.0L, omega = acos(half_trace(&m, h))/h;
    assert_close((omega - 1)/(h*h), 1/72.0L, 1e-5L);
    for (int start = 0; start < STARTS; ++start)                                /* -g^2 h^3/72, no more terms */
        assert_close(lagrangian_excess(&uniform_field, &m, start, 0.5L), -2.25L/(8*72), 4*EPS);
    assert_int_equal(most_negative(&problems[0], &m), 0);                       /* every curve a strict minimum */
    assert_between(0.75L, coercivity(&rule, 4), 0.76L);
}

/* Milne's rule is the converse: a negative weight, no minimum at any step, and the full order.  X = 0: one more. */
TEST(minima_are_neither_enough_nor_needed)
{
    const own_rule vanishing = rule_without_phi_2(6);
    const method with_milne = { 3, rule_or_own(GVI_OWN, 3, &milne) }, better = { 4, rule_or_own(GVI_OWN, 6, &vanishing) };
    misses = 0;
    for (int i = 0; i < 3; i += 2) {
        expect_slope("Milne", end_error, &problems[i], &with_milne, 4, 96, 0.15L);
        expect_slope("X = 0", step_error, &problems[i], &better, 4, 1600, 0.15L);
    }
    assert_int_equal(most_negative(&problems[0], &with_milne), 2);
    assert_int_equal(misses, 0);
}

/* u < s, and Gamma' singular: refused, and for a reason */
TEST(what_the_theorem_leaves_out_loses_the_order)
{
    const own_rule cases[2] = { random_rule(5, 3, 1), rule_without_phi_2(5) };
    misses = 0;
    for (int k = 0; k < 2; ++k) {
        const method m = { 4 - k, rule_or_own(GVI_OWN, 5, &cases[k]) };
        const gvi_desc desc = bench_desc(&problems[0], &m);
        assert_int_equal(gvi_init(&bench_stepper, &desc, bench_memory, sizeof bench_memory), k ? GVI_E_POINTS : GVI_E_ORDER);
        expect_slope("left out", own_step_error, &problems[0], &m, k ? 3 : 1, 200, 0.15L);
    }
    assert_int_equal(misses, 0);
}

/* Of a rule, at any M(q): what a proof by minima would need, and what 3/8 and Boole have too */
TEST(the_action_is_as_coercive_as_the_rule)
{
    const struct { int r, s; } cases[] = { { 4, 3 }, { 4, 4 }, { 5, 5 } };
    for (int k = 0; k < COUNT(cases); ++k) {
        const own_rule rule = newton_cotes(cases[k].r);
        assert_between(0.95L, coercivity_seen(&problems[1], &rule, cases[k].s)/coercivity(&rule, cases[k].s), 1.001L);
    }
}

static int which_norm;
static curve_kind which_curve;

static real norm_error(const problem *pb, const method *m, real h)
{
    real norm[NORMS];
    curve_norms(pb, m, h, which_curve, norm);
    return norm[which_norm];
}

/* Theorem 5.1, corrected, the curve between given ends: min(s, u - s + 1) + 1 in the maximum norm, one more in L1, one
   less each for the velocity.  Radau's u is odd, Newton-Cotes' too small.      */
TEST(the_curve_has_order_min_s_and_u_less_s_plus_1_and_one_more)
{
    static const int more[NORMS] = { 1, 2, 0, 1 };
    misses = 0;
    which_curve = OF_THE_ENDS;
    for (int i = 0; i < PROBLEMS; ++i)
        for (which_norm = 0; which_norm < NORMS; ++which_norm)
            for (int s = 1; s <= 4; ++s)
                for (int k = 0; k < 5; ++k) {
                    const own_rule rule = k == 3 ? radau(s) : newton_cotes(s > 2 ? s : 3);
                    method m = { s, rule_or_own(GVI_OWN, rule.r, &rule) };
                    const int u = k < 3 ? rule_of(k, s, &m) : rule.u;
                    if (u) expect_slope("curve", norm_error, &problems[i], &m, velocity_expected(s, u) + more[which_norm],
                                        192, 0.15L);
                }
    assert_int_equal(misses, 0);
}

/* q = sin 2t + e^t/3, and its derivatives */
static real smooth(int k, real t) { return pow(2, (real)k)*sin(2*t + k*TAU/4) + exp(t)/3; }

/* The largest error of d^k/dt^k of the polynomial through it at the points c */
static int  which_derivative;

static real derivative_error(const problem *pb, const method *m, real h)
{
    const own_rule at = controls(m->s);
    const int s = m->s, k = which_derivative;
    real A[MAX_R*MAX_R], a[MAX_R], most = 0;
    for (int i = 0; i <= s; ++i) {
        a[i] = smooth(0, 0.3L + h*(at.c[i] - 0.5L));
        for (int j = 0; j <= s; ++j) A[i*(s + 1) + j] = j ? A[i*(s + 1) + j - 1]*at.c[i] : 1;
    }
    solve(s + 1, A, a);
    for (int i = 0; i <= 16; ++i) {
        real value = 0;
        for (int j = s; j >= k; --j) value = value*i/16 + a[j]*factorial(j)/factorial(j - k);
        most = larger(fabs(value/pow(h, (real)k) - smooth(k, 0.3L + h*(i/16.0L - 0.5L))), most);
    }
    return most;
}

/* Lemma 3.1: any smooth curve, derivatives up to the s-th, any control points */
TEST(an_interpolant_and_its_derivatives_are_as_near_as_s_plus_1_less_k)
{
    misses = 0;
    for (int s = 1; s <= 6; ++s)
        for (control_points = AT_LOBATTO; control_points <= AT_RANDOM; ++control_points)
            for (which_derivative = 0; which_derivative <= s; ++which_derivative)
                expect_slope("interpolant", derivative_error, &oscillator, &(method){ s, { 0 } }, s + 1 - which_derivative,
                             s > 4 ? 24 : 48, 0.2L);
    assert_int_equal(misses, 0);
}

/* k = 0, 1 on solutions */
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
    real error[PARTS_AND_SUMS];
    force_errors(pb, m, h, error);
    return error[which_part];
}

/* The paper has s + 1 for L_d and the discrete forces: section 6.2 */
TEST(forces_cost_no_order_of_the_step_of_the_discrete_lagrangian_or_of_the_discrete_forces)
{
    static const char *const part[] = { "D_1 L_d", "D_2 L_d", "F-", "F+" };
    static const int top[FORCED] = { 4, 4, 2, 3 }, most[FORCED] = { 24, 24, 64, 64 };  /* M(q) has no Hessian: sqrt(EPS) */
    misses = 0;
    for (int i = 0; i < FORCED; ++i) {
        expect_slopes("step", end_error, &forced_problems[i], 5, 0, 48, 0.2L);
        expect_slopes("L_d", lagrangian_error, &forced_problems[i], 4, 1, 48, 0.2L);
        for (which_part = 0; which_part < PARTS; ++which_part)
            expect_slopes(part[which_part], part_error, &forced_problems[i], top[i], 0, most[i], 0.2L);
    }
    assert_int_equal(misses, 0);
}

/* As printed, a constant force acts as (B_0 + B_s) f: a third for s = 2, a quarter for s = 3 */
TEST(discrete_forces_at_fixed_inner_points_converge_to_another_motion)
{
    for (int s = 2; s <= 3; ++s) {
        real right[MAX_Y], wrong[MAX_Y];
        share_of_push = 1;
        start_state(&pushed, 0, right);
        flow_of(&pushed, 0, 1, right);
        share_of_push = s == 2 ? 1/3.0L : 0.25L;
        start_state(&pushed, 0, wrong);
        flow_of(&pushed, 0, 1, wrong);
        share_of_push = 1;
        const real off = position_as_printed(s, 10) - wrong[0], half = position_as_printed(s, 20) - wrong[0];
        assert_between(3.9L, off/half, 4.1L);                                   /* of order 2, towards it */
        assert_close(half, 0, 1e-4L);
        assert_true(fabs(right[0] - wrong[0]) > 0.2L);
    }
}

/* Section 6.2: O(h^(s+2)) at any control points, O(h^(2s+1)) at Lobatto's */
TEST(the_action_of_the_interpolant_is_nearer_than_its_curve)
{
    misses = 0;
    for (int s = 2; s <= 4; ++s) {
        control_points = AT_LOBATTO;
        expect_slope("at Lobatto's points", first_term, &forced_problems[2], &(method){ s, { 0 } }, 2*s + 1, 48, 0.2L);
        control_points = AT_RANDOM;
        expect_slope("at random", first_term, &forced_problems[2], &(method){ s, { 0 } }, s + 2, 400, 0.2L);
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
                    assert_close(twice.q[i], once->q[i%2], (step + 1)*EPS);
                    assert_close(twice.p[i], (i < 2 ? 1 : -1)*once->p[i%2], (step + 1)*EPS);
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
    real revolution;
    return fabs(shift_measured(0.5L, h, &revolution) - shift_predicted(0.5L, h));
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
    static const real h[PROBLEMS] = { 0.5L, 0.5L, 1, 1, 0.5L, 0.5L };
    for (int i = 0; i < PROBLEMS; ++i)
        for (int s = 24; s <= 64; s += 20) {
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
        real y[MAX_Y], last, step = 0.0625L;
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
