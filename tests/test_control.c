/* Optimal control: lessons 34 and 35 themselves, their functions included.  What is expected are
   solutions of Pontryagin's boundary value problems in 24 to 32 digits by another program (Gauss
   collocation with 12 and 8 stages, Newton's method by differences; the cart there in velocities,
   with the adjoint equations of that form). */
#include "gvi_test.h"
#define I _Complex_I
#define main lesson_34
#include "34_low_thrust.c"
#undef main
#define main lesson_35
#include "35_swing_up.c"
#undef main

static const double flight_cost = 0.0004374230531335397759746, flight_start[] = { -0.001223261471621544535146,
                    -0.008026228113038987346453, 0.009170708578766099044291, 0.001223261471621544535146 };

/* Errors of the cost and of the costate at the start. */
static void flight_errors(int degree, int steps, double *e)
{
    double cost, q[FLIGHT], p[FLIGHT];
    assert_ok(best_flight(degree, steps, &cost, q, p, NULL));
    e[0] = fabs(cost - flight_cost);
    e[1] = fmax(fmax(fabs(q[2] - flight_start[0]), fabs(q[3] - flight_start[1])),
                fmax(fabs(p[2] - flight_start[2]), fabs(p[3] - flight_start[3])));
}

TEST(the_best_flight_is_that_of_24_digits)
{
    double cost, q[FLIGHT], p[FLIGHT];
    assert_ok(best_flight(6, 48, &cost, q, p, NULL));
    assert_close(cost, flight_cost, 1e-17);
    assert_close(-q[3], 0.008026228113038987346453, 1e-16);
    assert_close(q[2], flight_start[0], 1e-16);
    assert_close(p[2], flight_start[2], 1e-16);
    assert_close(p[3], flight_start[3], 1e-16);
}

TEST(the_flight_has_order_2s)
{
    static const int steps[] = { 48, 24, 12 };
    for (int s = 2; s <= 4; ++s) {
        double coarse[2], fine[2];
        flight_errors(s, steps[s-2], coarse);
        flight_errors(s, 2*steps[s-2], fine);
        for (int i = 0; i < 2; ++i) assert_between(2*s - 0.2, log2(coarse[i]/fine[i]), 2*s + 0.2);
    }
}

static const double swing_cost = 57.9447803067280225, swing_start[] = { 6.86114732239437159, -44.992257478480388,
                    -3.15295148504546297, 17.7809038154745571 };

static void swing_errors(int degree, int steps, double *e)
{
    double q[CART] = { 0, 0, swing_start[0], swing_start[1] }, p[CART] = { 0, 0, swing_start[2], swing_start[3] };
    assert_ok(swing_to(1, degree, steps, q, p));
    e[0] = fabs(effort(degree, steps, q, p, NULL) - swing_cost);
    e[1] = fmax(fmax(fabs(q[2] - swing_start[0]), fabs(q[3] - swing_start[1])),
                fmax(fabs(p[2] - swing_start[2]), fabs(p[3] - swing_start[3])));
}

TEST(the_least_effort_is_that_of_pontryagin)
{
    double e[2];
    swing_errors(6, 80, e);
    assert_between(0, e[0], 57.9*64*EPS);
    assert_between(0, e[1], 45*64*EPS);
}

TEST(the_swing_has_order_2s)
{
    for (int s = 2; s <= 4; ++s) {
        double coarse[2], fine[2];
        swing_errors(s, s < 4 ? 80 : 72, coarse);
        swing_errors(s, s < 4 ? 160 : 144, fine);
        for (int i = 0; i < 2; ++i) assert_between(2*s - 0.25, log2(coarse[i]/fine[i]), 2*s + 0.25);
    }
}

/* The lesson's products, by complex steps, agree with differences. */
TEST(complex_products_agree_with_differences)
{
    const double q[] = { 0.1, 0.4, 0.3, 0.2 }, v[] = { 0.5, 0.3, 0.2, 0.1 };
    int part = -1;
    assert_ok(tangent_scene(&swing));
    assert_between(0, tangent_check(&swing, 0, q, v, v, q, &part), 1e-11);
}

/* An end that does not depend on the start, and too few runs. */
static void nowhere(const double *q, const double *p, const double *dq, const double *dp,
                    double *c, void *user)
{
    for (int i = 0; i < 4; ++i) c[i] = dq ? 0 : 1;
}

TEST(shooting_that_cannot_arrive_is_refused)
{
    static double work[SHOOTING_ROOM(CART, CART)];
    static const double dq[16] = { [2] = 1, [7] = 1 }, dp[16] = { [10] = 1, [15] = 1 };
    shooting S = { .scene = &swing, .dq = dq, .dp = dp, .h = 0.1, .steps = 20, .end = nowhere, .tolerance = 1e-8,
                   .most = 10, .room = work };
    double q[CART] = { 0 }, p[CART] = { 0 }, all = 1;
    gvi_stepper st;
    swing.plain.degree = 4;
    assert_ok(tangent_scene(&swing));
    st = new_stepper(&swing.desc);
    assert_status(shoot(&S, &st, q, p), GVI_E_SINGULAR);
    S.end = arrive;
    S.user = &all;
    S.most = 1;
    assert_status(shoot(&S, &st, q, p), GVI_E_CONVERGENCE);
}

/* x'' = -x: the start whose motion ends at (1, 1/2) */
AT_POINTS(spring)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= x->q[k];
    return 0;
}

static int spring_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    for (int k = 0; k < x->count; ++k) d->f[k] -= d->q[k];
    return 0;
}

static void meet(const double *q, const double *p, const double *dq, const double *dp, double *c, void *user)
{
    const double *spoil = user;
    c[0] = dq ? *dq*spoil[0] : (*q - 1)*spoil[1];
    c[1] = dq ? *dp : *p - 0.5;
}

TEST(shooting_leaves_the_start_as_it_was_where_the_end_is_not_finite)
{
    static double work[SHOOTING_ROOM(1, 2)], room[TANGENT_ROOM(1, 2)], good[2] = { 1, 1 };
    static const double none[] = { NAN, INFINITY };
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    tangent T = { .plain = { .n = 1, .degree = 8, .effects = scene, .effect_count = 1 }, .product = { spring_product },
                  .directions = 2, .room = room, .room_length = COUNT(room) };
    assert_ok(tangent_scene(&T));
    gvi_stepper st = new_stepper(&T.desc);
    const shooting usual = { .scene = &T, .h = 0.25, .steps = 8, .end = meet, .user = good, .tolerance = 1e-12, .most = 5,
                             .room = work };                    // dq, dp: NULL, the unit directions
    double q = 0.3, p = 0.4;
    assert_ok(shoot(&usual, &st, &q, &p));
    assert_close(q, cos(2) - sin(2)/2, 32*EPS);
    assert_close(p, sin(2) + cos(2)/2, 32*EPS);

    for (int i = 0; i < 2*COUNT(none); ++i) {
        double bad[2] = { 1, 1 };
        shooting S = usual;
        bad[i % 2] = none[i/2];
        S.user = bad;
        S.most = 1 + i/2;
        q = 0.3, p = 0.4;
        assert_status(shoot(&S, &st, &q, &p), GVI_E_NON_FINITE);
        assert_true(q == 0.3 && p == 0.4);
    }
    double tiny[2] = { DBL_MIN, DBL_MAX };                      // a correction that overflows
    shooting S = usual;
    S.user = tiny;
    assert_status(shoot(&S, &st, &q, &p), GVI_E_NON_FINITE);
    assert_true(q == 0.3 && p == 0.4);

    for (int i = 0; i < 5; ++i) {
        S = usual;
        if (i == 0) S.end = NULL;
        if (i == 1) S.room = NULL;
        if (i == 2) S.scene = NULL;
        if (i == 3) S.steps = -1;
        if (i == 4) T.directions = 0;
        assert_status(shoot(&S, &st, &q, &p), GVI_E_ARGUMENT);
        T.directions = 2;
    }
    assert_status(shoot(&usual, &st, NULL, &p), GVI_E_ARGUMENT);
    assert_status(shoot(&usual, NULL, &q, &p), GVI_E_ARGUMENT);
    assert_status(tangent_start(&T, &st, 0, NULL, &p, NULL, NULL), GVI_E_ARGUMENT);
}

RUN_TESTS(NULL, NULL)
