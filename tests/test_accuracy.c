/* The order of the method, the first thing to know of it: min(2s, u) for polynomials of degree s and a
   rule of order u >= 2s - 2.  A planet of eccentricity 0.3, against Kepler's equation E - e sin E = t.
   This file needs gvi.h, cmocka and nothing else.                                                  */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <cmocka.h>
#define GVI_IMPLEMENTATION
#include "gvi.h"

static const double e = 0.3;

GVI_POINTS(attraction, 2, f)(const gvi_points *x, void *user)
{
    const double d2 = x->q[0]*x->q[0] + x->q[1]*x->q[1], w = -1/(d2*sqrt(d2));
    x->f[0] += w*x->q[0];
    x->f[1] += w*x->q[1];
    return (void)user, 0;
}

/* How far from Kepler's orbit is the planet after the time 2, in `steps` steps?                    */
static double error_after(int steps, int degree, gvi_rule rule)
{
    static double memory[GVI_LENGTH(2, 5, 6)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    const gvi_desc desc = { .n = 2, .degree = degree, .rule = rule, .effects = scene, .effect_count = 1 };
    const double q[] = { 1 - e, 0 }, v[] = { 0, sqrt((1 + e)/(1 - e)) };
    double E = 2;
    gvi_stepper st;
    assert_int_equal(gvi_init(&st, &desc, memory, sizeof memory), GVI_OK);
    assert_int_equal(gvi_start(&st, 0, q, v), GVI_OK);
    for (int k = 0; k < steps; ++k) assert_int_equal(gvi_step(&st, 2.0/steps), GVI_OK);
    for (int k = 0; k < 20; ++k) E -= (E - e*sin(E) - 2)/(1 - e*cos(E));
    return hypot(st.q[0] - (cos(E) - e), st.q[1] - sqrt(1 - e*e)*sin(E));
}

static void assert_order(int expected, int steps, int degree, gvi_rule_kind kind, int points)
{
    const gvi_rule rule = { .kind = kind, .points = points };
    const double order = log2(error_after(steps, degree, rule)/error_after(2*steps, degree, rule));
    if (fabs(order - expected) > 0.1) fail_msg("degree %d, %d points: order %.2f", degree, points, order);
}

static const int steps[] = { 0, 200, 40, 20, 12, 7 };          // for degree s, so that rounding does not show

static void gauss_with_s_points_has_order_2s(void **state)
{
    for (int s = 1; s <= 5; ++s) assert_order(2*s, steps[s], s, GVI_GAUSS, s);
}

static void lobatto_with_s_plus_1_points_has_order_2s(void **state)
{
    for (int s = 1; s <= 5; ++s) assert_order(2*s, steps[s], s, GVI_LOBATTO, s + 1);
}

static void a_rule_of_order_2s_minus_2_has_order_2s_minus_2(void **state)
{
    for (int s = 3; s <= 5; ++s) assert_order(2*s - 2, 2*steps[s], s, GVI_LOBATTO, s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gauss_with_s_points_has_order_2s),
        cmocka_unit_test(lobatto_with_s_plus_1_points_has_order_2s),
        cmocka_unit_test(a_rule_of_order_2s_minus_2_has_order_2s_minus_2),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
