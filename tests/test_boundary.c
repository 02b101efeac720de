/* Two configurations, one curve: what gvi_start_configurations and gvi_discrete_lagrangian return
   as ok is the curve near the chord or the guess, and reaches q1; anything else is a status.
   Lambert's problem against its closed form. */
#include "gvi_test.h"
#include "problems.h"

#define PI 3.14159265358979323846L
static const gvi_effect sun[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction,
                                    .hessian = attraction_hessian } };

static void set_up(gvi_stepper *st, int degree)
{
    const gvi_desc desc = { .n = 2, .degree = degree, .effects = sun, .effect_count = 1 };
    *st = new_stepper(&desc);
}

/* Bate, Mueller, White: Fundamentals of astrodynamics, 1971, ch. 5.3: the time of flight over
   one arc grows with z, from hyperbolas (z < 0) to one revolution (z = 4 pi^2). */

static long double stumpff_c(long double z)
{
    return z > 1e-6L ? (1 - cosl(sqrtl(z)))/z : z < -1e-6L ? (coshl(sqrtl(-z)) - 1)/-z : 0.5L - z/24;
}

static long double stumpff_s(long double z)
{
    const long double x = sqrtl(fabsl(z));
    return z > 1e-6L ? (x - sinl(x))/(x*x*x) : z < -1e-6L ? (sinhl(x) - x)/(x*x*x) : 1/6.0L - z/120;
}

/* The velocity at (1, 0) of the orbit that takes h to the point at radius r, `span` further on */
static void lambert(long double r, long double span, long double h, long double *v)
{
    const long double A = sinl(span)*sqrtl(r/(1 - cosl(span)));
    long double below = -100, above = 4*PI*PI - 1e-9L, y = 0;
    for (int k = 0; k < 200; ++k) {
        const long double z = (below + above)/2, C = stumpff_c(z), S = stumpff_s(z);
        y = 1 + r + A*(z*S - 1)/sqrtl(C);
        const long double x = sqrtl(y/C), time = x*x*x*S + A*sqrtl(y);
        if (y < 0 || time < h) below = z;
        else above = z;
    }
    v[0] = (r*cosl(span) - (1 - y))/(A*sqrtl(y));
    v[1] = r*sinl(span)/(A*sqrtl(y));
}

/* The guess is the circle's velocity, one way or the other, not that of the orbit */
TEST(a_guess_says_which_way_round)
{
    for (int way = -1; way <= 1; way += 2)
        for (int degrees = 20; degrees <= 330; degrees += 10) {
            const long double span = degrees*PI/180, r = 1.1L, h = 1.05L*span;
            const real q0[2] = { 1, 0 }, guess[2] = { 0, (real)way };
            const real q1[2] = { (real)(r*cosl(span)), (real)(way*r*sinl(span)) };
            real p0[2], p1[2];
            long double v[2];
            gvi_stepper st;
            if (degrees == 180) continue;         // the formula is 0/0
            lambert(r, span, h, v);
            set_up(&st, 40);
            assert_ok(gvi_discrete_lagrangian(&st, 0, (real)h, q0, q1, &(gvi_discrete){
                .p0 = p0, .p1 = p1, .guess = guess }));
            assert_close(p0[0], v[0], 200*EPS);
            assert_close(p0[1], way*v[1], 200*EPS);
            assert_close(q1[0]*p1[1] - q1[1]*p1[0], p0[1], 40*EPS);
            // and a step of that length ends there
            if (degrees > 200) continue;
            assert_ok(gvi_start_momentum(&st, 0, q0, p0));
            assert_ok(gvi_step(&st, (real)h));
            assert_close(st.q[0], q1[0], 200*EPS);
            assert_close(st.q[1], q1[1], 200*EPS);
        }
}

/* No guess is of use to a straight line; one at which dL/dv fails is the caller's */
AT_POINT(no_momentum) { return v[0] > 1; }

TEST(a_guess_may_be_of_no_use)
{
    const gvi_effect effects[] = { { .kind = GVI_LAGRANGIAN, .point = no_momentum } };
    const real zero = 0, one = 1, fast = 2;
    for (int s = 1; s <= 2; ++s) {
        const gvi_desc desc = { .n = 1, .degree = s, .effects = effects, .effect_count = 1 };
        gvi_stepper st = new_stepper(&desc);
        const gvi_discrete out = { .guess = &fast };
        assert_status(gvi_discrete_lagrangian(&st, 0, 1, &zero, &one, &out), s == 1 ? GVI_OK : GVI_E_CALLBACK);
        assert_status(gvi_discrete_lagrangian(NULL, 0, 1, &zero, &one, &out), GVI_E_ARGUMENT);
    }
}

/* Without a guess the short way round, prograde or not: it is the curve near the chord */
TEST(near_the_chord_is_the_short_way_round)
{
    for (int degree = 8; degree <= 32; degree *= 2)
        for (int degrees = 20; degrees <= 340; degrees += 10) {
            const long double span = degrees*PI/180, h = 1.2L*span, r = 1.3L;
            const real q0[2] = { 1, 0 }, q1[2] = { (real)(r*cosl(span)), (real)(r*sinl(span)) };
            const int way = degrees < 180 ? 1 : -1;
            long double v[2];
            gvi_stepper st;
            if (degrees == 180) continue;
            lambert(r, way > 0 ? span : 2*PI - span, h, v);
            set_up(&st, degree);
            assert_ok(gvi_start_configurations(&st, 0, (real)h, q0, q1));
            const long double bound = degree == 8 ? 2e-3L : degree == 16 ? 1e-6L : 1e-11L;
            assert_close(st.p[0], v[0], bound);
            assert_close(st.p[1], way*v[1], bound);
        }
}

/* A half circle is not near its diameter, which goes through the Sun, also where no point is there */
TEST(a_half_circle_is_conjugate)
{
    const real q0[2] = { 1, 0 }, q1[2] = { -1, 0 };
    for (int degree = 2; degree <= 41; ++degree) {
        gvi_stepper st;
        set_up(&st, degree);
        assert_status(gvi_start_configurations(&st, 0, (real)PI, q0, q1), GVI_E_CONJUGATE);
    }
    // a guess has the direction that the chord has not
    gvi_stepper st;
    real p0[2];
    const real guess[2] = { (real)0.1, (real)-0.9 };
    set_up(&st, 24);
    assert_ok(gvi_discrete_lagrangian(&st, 0, (real)PI, q0, q1, &(gvi_discrete){ .p0 = p0, .guess = guess }));
    assert_close(p0[0], 0, 2*EPS);
    assert_close(p0[1], -1, 1e-12L);
}

/* Two coupled pendulums, in units that differ by 2^30, with a force: momenta scale, whatever is
   returned, as 1/unit.  A condition that knew the units would call it a conjugate point. */

GVI_EACH(pendulums, 2, f)
{
    const real *unit = user, A = x->q[0]/unit[0], B = x->q[1]/unit[1];
    x->f[0] -= (sin(A) + (A - B)/2)/unit[0];
    x->f[1] -= (sin(B) + (B - A)/2)/unit[1];
}

AT_EACH(drag)
{
    const real unit = ((const real *)user)[a/x->stride];
    x->f[a] -= x->v[a]/(unit*unit)/8;
}

TEST(units_2_to_the_30_apart_change_nothing)
{
    real wanted[6] = { 0 };
    for (int k = 0; k < 3; ++k) {
        real unit[2] = { 1, ldexp((real)1, k == 0 ? 0 : k == 1 ? 30 : -30) }, got[6];
        const real mass[2] = { 1/(unit[0]*unit[0]), 1/(unit[1]*unit[1]) };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pendulums, .user = unit },
                                     { .kind = GVI_FORCE, .points = drag, .user = unit } };
        const gvi_desc desc = { .n = 2, .degree = 6, .effects = scene, .effect_count = 2,
                                .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
        const real q0[2] = { unit[0]/2, -unit[1]/4 }, q1[2] = { unit[0]*7/8, unit[1]/2 };
        gvi_stepper st = new_stepper(&desc);
        assert_ok(gvi_discrete_lagrangian(&st, 0, 1, q0, q1, &(gvi_discrete){
            .p0 = got, .minus = got + 2, .plus = got + 4 }));
        for (int i = 0; i < 6; ++i) {
            if (k == 0) wanted[i] = got[i];
            assert_close(got[i]*unit[i % 2], wanted[i], i < 2 ? 8*EPS : sqrt((real)EPS));
        }
    }
}

/* A spring given as a force is not in the action: its index is 0 where a potential's is 1 */
GVI_EACH(spring, 1, f) { x->f[0] -= 16*x->q[0]; }

TEST(the_index_leaves_forces_out)
{
    for (int force = 0; force < 2; ++force) {
        const gvi_effect scene[] = { { .kind = force ? GVI_FORCE : GVI_POTENTIAL, .points = spring } };
        const gvi_desc desc = { .n = 1, .degree = 8, .effects = scene, .effect_count = 1 };
        const real q0 = 1, q1 = (real)0.5;
        int negative = 7;
        gvi_stepper st = new_stepper(&desc);
        assert_ok(gvi_discrete_lagrangian(&st, 0, 1, &q0, &q1, &(gvi_discrete){ .negative = &negative }));
        assert_int_equal(negative, !force);       // omega h = 4 is beyond pi
    }
}

/* Where h leaves the range no effect is at fault, and nothing is wrong where the curve starts */
TEST(a_length_beyond_the_range_is_no_effects_fault)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    for (int degree = 2; degree < 5; ++degree) {
        const gvi_desc desc = { .n = 1, .degree = degree, .effects = scene, .effect_count = 1 };
        const real q0 = 1, q1 = (real)0.5;
        gvi_stepper st = new_stepper(&desc);
        assert_status(gvi_discrete_lagrangian(&st, 0, MAX/64, &q0, &q1, &(gvi_discrete){ .lagrangian = NULL }), GVI_E_CONVERGENCE);
        assert_non_null(strstr(gvi_why(&st), "halve h"));
    }
}

/* As accurate as a step from (q0, p0) has to be: else refused, and nothing is written */
TEST(the_dial_is_for_boundary_values_too)
{
    static const real dials[] = { (real)1e-4, (real)1e-6, (real)1e-8 };
    for (int d = 0; d < COUNT(dials); ++d) {
        const gvi_desc desc = { .n = 2, .degree = 8, .effects = sun, .effect_count = 1, .resolution = dials[d] };
        gvi_stepper st = new_stepper(&desc);
        int ok = 0, refused = 0;
        for (int k = 0; k < 400; ++k) {
            const real r = (real)(1.25L + 0.75L*random_unit()), span = (real)(1.55L + 1.25L*random_unit()),
                       h = (real)(1.9L + 1.6L*random_unit());
            const real q0[] = { 1, 0 }, q1[] = { r*cos(span), r*sin(span) };
            long double v[2];
            real p0[2] = { 7, 7 };
            const gvi_discrete out = { .p0 = p0 };
            const gvi_status status = gvi_start_configurations(&st, 0, h, q0, q1);
            assert_status(gvi_discrete_lagrangian(&st, 0, h, q0, q1, &out), status);
            if (status == GVI_E_RESOLUTION) {
                assert_true(p0[0] == 7 && st.resolution > dials[d]);
                ++refused;
            }
            if (status != GVI_OK) continue;
            lambert(r, span, h, v);
            const long double speed = hypotl(v[0], v[1]);
            for (int i = 0; i < 2; ++i) {
                assert_close(st.p[i], v[i], 20*dials[d]*speed);
                assert_close(p0[i], v[i], 20*dials[d]*speed);
            }
            ++ok;
        }
        assert_true(ok > 20 && refused > 20);
    }
}

RUN_TESTS(NULL, NULL)
