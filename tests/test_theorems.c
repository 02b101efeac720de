/* The theorems of docs/theorems.md, the part of them that fits in seconds.  The
   measurements are those of the studies in tests/theorems/, whose headers say what
   the expected values are and why they owe nothing to gvi.h.

   Not here, because it is elsewhere: the double pendulum's orders, the state inside
   a step and weak rules (test_order.c), conjugate points of the oscillator and the
   derivatives of L_d and its forces (test_queries.c), other methods that steps are
   (test_identities.c, test_oracle.c).                                          */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#include "gvi_test.h"
#include "theorems/inertia.h"
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

static const problem *conservative(int k) { return k ? &problems[k - 1] : &oscillator; }

/* ------------------------------------------------------------------- reference */

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

/* -------------------------------------------------------------- the two theorems */

TEST(the_order_of_the_step_is_the_smaller_of_2s_and_u)
{
    static const int which[3] = { 0, 2, 3 };
    misses = 0;
    for (int i = 0; i < 3; ++i)
        for (int s = 1; s <= 5; ++s)
            for (int k = 0; k < 3; ++k) {
                method m;
                int u = rule_of(k, s, &m);
                if (u) expect_slope("step", end_error, &problems[which[i]], &m, u, 48, 0.15L);
            }
    assert_int_equal(misses, 0);
}

TEST(the_discrete_lagrangian_is_exact_to_one_power_more)
{
    misses = 0;
    for (int i = 0; i <= PROBLEMS; ++i)
        for (int s = 1; s <= 4; ++s)
            for (int k = 0; k < 3; ++k) {
                method m;
                int u = rule_of(k, s, &m);
                if (u) expect_slope("L_d", lagrangian_error, conservative(i), &m, u + 1, 48, 0.15L);
            }
    assert_int_equal(misses, 0);
}

/* Two that know nothing of each other */
TEST(degree_24_gives_the_exact_discrete_lagrangian)
{
    const method m = { 24, { 0 } };
    for (int i = 0; i <= PROBLEMS; ++i) assert_close(lagrangian_error(conservative(i), &m, 0.25L), 0, 8*EPS);
    for (int i = 0; i < FORCED; ++i) assert_close(lagrangian_error(&forced_problems[i], &m, 0.25L), 0, 8*EPS);
}

/* ----------------------------------------------------------------------- curve */

static int which_norm;

static real norm_error(const problem *pb, const method *m, real h)
{
    real norm[NORMS];
    curve_norms(pb, m, h, OF_THE_STEP, norm);
    return norm[which_norm];
}

/* Exactly min(s, u/2) + 1 in the maximum norm, one more in L1, one less each for the velocity */
TEST(the_curve_has_order_min_s_and_half_u_plus_one)
{
    static const int more[NORMS] = { 1, 2, 0, 1 };
    misses = 0;
    for (int i = 0; i < PROBLEMS; ++i)
        for (int s = 1; s <= 4; ++s)
            for (int k = 0; k < 3; ++k) {
                method m;
                int u = rule_of(k, s, &m);
                for (which_norm = 0; which_norm < NORMS && u; ++which_norm)
                    expect_slope("curve", norm_error, &problems[i], &m, u/2 + more[which_norm], 192, 0.15L);
            }
    assert_int_equal(misses, 0);
}

/* ---------------------------------------------------------------------- forced */

TEST(forces_leave_the_order_as_it_is)
{
    misses = 0;
    for (int i = 0; i < 2; ++i)
        for (int s = 1; s <= 5; ++s)
            for (int k = 0; k < 3; ++k) {
                method m;
                int u = rule_of(k, s, &m);
                if (u) expect_slope("forced step", end_error, &forced_problems[i], &m, u, 48, 0.15L);
            }
    assert_int_equal(misses, 0);
}

/* -------------------------------------------------------------------- spectral */

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

/* --------------------------------------------------------------------- inertia */

TEST(negative_directions_of_the_oscillator_count_half_turns)
{
    const real y[2] = { 1, 0.5L };
    const method m = { 16, { 0 } };
    for (int k = 0; k <= 4; ++k)
        for (int side = 0; side < 2; ++side) {
            real h = (k + (side ? 0.999L : 0.001L))*TAU/2;
            assert_int_equal(index_of_step(&oscillator, &m, 0, y, h), k);
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

/* ------------------------------------------------------------------- stability */

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

/* The edges of Lobatto's first windows: half trace -1, then 1, by hand from
   1 - x/2 and, degree 2, (x^2 - 22 x + 48)/(2 (x + 24)), x = (h omega)^2         */
TEST(lobatto_is_unstable_in_its_windows_and_not_outside)
{
    static const struct { int s; real edge; int grows_after; } edges[] = {
        { 1, 2, 1 }, { 2, 2.8284271247461900976L, 1 },
        { 2, 3.4641016151377545871L, 0 }, { 2, 4.8989794855663561964L, 1 }
    };
    for (int i = 0; i < COUNT(edges); ++i) {
        const method m = { edges[i].s, { GVI_LOBATTO, .points = edges[i].s + 1 } };
        for (int side = -1; side <= 1; side += 2) {
            int grows = fabs(half_trace(&m, edges[i].edge + side*1e-6L)) > 1;
            assert_int_equal(grows, (side > 0) == edges[i].grows_after);
        }
    }
}

RUN_TESTS(NULL, NULL)
