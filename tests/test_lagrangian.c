/* examples/tools/lagrangian.h: L alone, or H, and nothing else.  What is expected: equations of motion derived by
   hand and integrated by another method, closed forms, and the same scenes with derivatives by hand. */
#include "gvi_test.h"
#include "tools/lagrangian.h"
#include "tools/check.h"

static const real g = R(9.81);

/* -- as on paper; beside each the accelerations by hand */

/* Henon-Heiles, driven */
LAGRANGIAN(driven, 2)
{
    return (v[0]*v[0] + v[1]*v[1])/2 - (q[0]*q[0] + q[1]*q[1])/2*(1 + cos(3*t)/10) - q[0]*q[0]*q[1] + q[1]*q[1]*q[1]/3;
}
static void driven_by_hand(long double t, const long double *q, const long double *v, long double *a)
{
    const long double k = 1 + cosl(3*t)/10;
    a[0] = -k*q[0] - 2*q[0]*q[1];
    a[1] = -k*q[1] - q[0]*q[0] + q[1]*q[1];
}

LAGRANGIAN(charge, 2)
{
    const number x = q[0], y = q[1];
    return (v[0]*v[0] + v[1]*v[1])/2 - y/2*v[0] + (x/2 + x*x*x/12)*v[1] - (x*x + 4*y*y)/2;
}
static void charge_by_hand(long double t, const long double *q, const long double *v, long double *a)
{
    const long double B = 1 + q[0]*q[0]/4;
    a[0] = B*v[1] - q[0];
    a[1] = -B*v[0] - 4*q[1];
}

LAGRANGIAN(pendulum, 2)
{
    return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*cos(q[0] - q[1]) + 2*g*cos(q[0]) + g*cos(q[1]);
}
static void pendulum_by_hand(long double t, const long double *q, const long double *v, long double *a)
{
    const long double G = 9.81L, c = cosl(q[0] - q[1]), s = sinl(q[0] - q[1]);
    const long double x = -s*v[1]*v[1] - 2*G*sinl(q[0]), y = s*v[0]*v[0] - G*sinl(q[1]);
    a[0] = (x - c*y)/(2 - c*c);
    a[1] = (2*y - c*x)/(2 - c*c);
}

/* growing mass: friction as a Lagrangian (Caldirola, Kanai) */
LAGRANGIAN(growing, 2)
{
    return exp(t/2)*(v[0]*v[0] + v[1]*v[1] - q[0]*q[0] - q[1]*q[1] - pow(q[0], 4)/2)/2;
}
static void growing_by_hand(long double t, const long double *q, const long double *v, long double *a)
{
    a[0] = -q[0] - q[0]*q[0]*q[0] - v[0]/2;
    a[1] = -q[1] - v[1]/2;
}

LAGRANGIAN(fast, 2) { return -25*sqrt(1 - (v[0]*v[0] + v[1]*v[1])/25) + 1/sqrt(q[0]*q[0] + q[1]*q[1]); }
static void fast_by_hand(long double t, const long double *q, const long double *v, long double *a)
{
    const long double d = hypotl(q[0], q[1]), f[] = { -q[0]/(d*d*d), -q[1]/(d*d*d) },
                      root = sqrtl(1 - (v[0]*v[0] + v[1]*v[1])/25), power = (f[0]*v[0] + f[1]*v[1])/25;
    for (int i = 0; i < 2; ++i) a[i] = root*(f[i] - power*v[i]);
}

/* a pendulum on a spring in polar coordinates, its support moved: speed w = -sin(2t)/5 */
LAGRANGIAN(moved, 2)
{
    const number w = -sin(2*t)/5;
    return (v[0]*v[0] + q[0]*q[0]*v[1]*v[1])/2 + w*(v[0]*sin(q[1]) + q[0]*v[1]*cos(q[1])) + g*q[0]*cos(q[1])
           - 20*(q[0] - 1)*(q[0] - 1);
}
static void moved_by_hand(long double t, const long double *q, const long double *v, long double *a)
{
    const long double dw = -cosl(2*t)*0.4L;
    a[0] = q[0]*v[1]*v[1] + 9.81L*cosl(q[1]) - 40*(q[0] - 1) - dw*sinl(q[1]);
    a[1] = (-2*v[0]*v[1] - 9.81L*sinl(q[1]) - dw*cosl(q[1]))/q[0];
}

typedef void motion(long double t, const long double *q, const long double *v, long double *a);
static const struct system {
    const lagrangian_function *L;
    motion                    *by_hand;
    lagrangian_kind            kind;
    gvi_formulation            formulation;
    int                        timed;
    real                       q[2], v[2], h;
} systems[] = {
    { &driven, driven_by_hand, LAGRANGIAN_POTENTIAL, GVI_POSITIONS, 1, { R(0.3), R(0.1) }, { 0, R(0.4) }, R(0.1) },
    { &charge, charge_by_hand, LAGRANGIAN_LINEAR, GVI_MOMENTA, 0, { R(0.8), R(0.4) }, { 0, R(0.5) }, R(0.2) },
    { &pendulum, pendulum_by_hand, LAGRANGIAN_MASS, GVI_MOMENTA, 0, { R(0.8), R(0.4) }, { 0, 0 }, R(0.05) },
    { &growing, growing_by_hand, LAGRANGIAN_MASS, GVI_MOMENTA, 1, { R(0.8), R(0.4) }, { 0, R(0.3) }, R(0.1) },
    { &fast, fast_by_hand, LAGRANGIAN_GENERAL, GVI_NEWTON, 0, { R(0.8), 0 }, { R(0.1), 1 }, R(0.1) },
    { &moved, moved_by_hand, LAGRANGIAN_MASS_LINEAR, GVI_MOMENTA, 1, { R(1.1), R(0.5) }, { 0, R(0.1) }, R(0.05) },
};

/* The state at t = 1: the classical Runge-Kutta method, 8,000 steps */
static void reference(const struct system *s, long double *z)
{
    const long double h = 1/8000.0L;
    for (int i = 0; i < 2; ++i) {
        z[i] = s->q[i];
        z[2 + i] = s->v[i];
    }
    for (int k = 0; k < 8000; ++k) {
        long double slope[4][4], at[4], t = k*h;
        for (int j = 0; j < 4; ++j) {
            const long double part = j == 3 ? 1 : 0.5L;
            for (int i = 0; i < 4; ++i) at[i] = z[i] + (j ? part*h*slope[j-1][i] : 0);
            slope[j][0] = at[2];
            slope[j][1] = at[3];
            s->by_hand(j ? t + part*h : t, at, at + 2, slope[j] + 2);
        }
        for (int i = 0; i < 4; ++i) z[i] += h*(slope[0][i] + 2*slope[1][i] + 2*slope[2][i] + slope[3][i])/6;
    }
}

static lagrangian lagrangians[2];
static gvi_effect effects[2];

/* A stepper from L alone, started */
static gvi_stepper from_l(const lagrangian_function *function, int which, int degree, const real *q, const real *v)
{
    lagrangian *L = lagrangians + which;
    const char *wrong = lagrangian_init(L, *function, NULL, 0, q, v);
    if (wrong) print_error("%s\n", wrong);
    assert_null(wrong);
    effects[which] = lagrangian_effect(L);
    const gvi_desc desc = { .n = function->n, .degree = degree, .effects = effects + which, .effect_count = 1, .mass = lagrangian_mass(L) };
    return new_motion(&desc, 0, q, v);
}

TEST(kinds_are_found)
{
    for (int k = 0; k < COUNT(systems); ++k) {
        gvi_stepper st = from_l(systems[k].L, 0, 4, systems[k].q, systems[k].v);
        assert_int_equal(lagrangians[0].kind, systems[k].kind);
        assert_int_equal(st.formulation, systems[k].formulation);
    }
}

/* of another kind by a term that the start does not show, or only at the second look; not defined at rest */
LAGRANGIAN(far_mass, 1) { return v[0]*v[0]/2*(1 + pow(q[0], 16)) - q[0]*q[0]/2; }
LAGRANGIAN(quartic, 1) { return v[0]*v[0]/2 + v[0]*v[0]*v[0]*v[0]/1000 - q[0]*q[0]/2; }
LAGRANGIAN(cubic, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + v[0]*v[1]*q[0]*v[1]/100 - q[0]*q[0]/2; }
LAGRANGIAN(constant_term, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + q[1]*v[0]/1000 - q[0]*q[0]/2; }
LAGRANGIAN(no_rest, 1) { return v[0]*log(v[0]) - q[0]*q[0]/2; }
LAGRANGIAN(dense, 2) { return (v[0]*v[0] + v[0]*v[1] + v[1]*v[1])/3 - q[0]*q[0]/2; }

LAGRANGIAN(sun_and_sail, 2) { return R(1e30)*v[0]*v[0]/2 + v[1]*v[1]/2 + q[0]*v[1]/1000; }
LAGRANGIAN(sun_and_turning, 2) { return R(1e30)*v[0]*v[0]/2 + (2 + cos(q[1]))*v[1]*v[1]/2; }
LAGRANGIAN(coupled, 2) { return R(1e30)*v[0]*v[0]/2 + R(1e14)*v[0]*v[1] + v[1]*v[1]/2; }

TEST(kinds_are_found_far_from_the_start)
{
    const real small[] = { R(0.01) }, rest[] = { 0 };
    const struct { const lagrangian_function *L; lagrangian_kind kind; real q[2], v[2]; } cases[] = {
        { &far_mass, LAGRANGIAN_MASS, { 0 }, { 0 } },
        { &quartic, LAGRANGIAN_GENERAL, { R(0.01) }, { 0 } },       { &cubic, LAGRANGIAN_GENERAL, { 0, 0 }, { 0, 0 } },
        { &constant_term, LAGRANGIAN_LINEAR, { 0, 0 }, { 0, 0 } },  { &no_rest, LAGRANGIAN_GENERAL, { 1 }, { 1 } },
        { &dense, LAGRANGIAN_POTENTIAL, { R(0.1), R(0.2) }, { 0, 1 } },
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        const char *wrong = lagrangian_init(lagrangians, *cases[k].L, NULL, 0, cases[k].q, cases[k].v);
        if (wrong) print_error("%d: %s\n", k, wrong);
        assert_null(wrong);
        assert_int_equal(lagrangians[0].kind, cases[k].kind);
    }
    assert_int_equal(lagrangian_mass(lagrangians).kind, GVI_MASS_DENSE);
    /* masses that differ by 30 orders of magnitude, the heavy one in motion */
    const real far[] = { 1, 2 }, both[] = { 3, 4 };
    assert_null(lagrangian_init(lagrangians, sun_and_sail, NULL, 0, far, both));
    assert_int_equal(lagrangians[0].kind, LAGRANGIAN_LINEAR);
    assert_null(lagrangian_init(lagrangians, sun_and_turning, NULL, 0, far, both));
    assert_int_equal(lagrangians[0].kind, LAGRANGIAN_MASS);
    assert_null(lagrangian_init(lagrangians, coupled, NULL, 0, far, both));
    assert_int_equal(lagrangians[0].kind, LAGRANGIAN_POTENTIAL);
    assert_close(lagrangians[0].M[2], R(1e14), R(1e14)*EPS);
    /* also from a start that is small */
    assert_null(lagrangian_init(lagrangians, far_mass, NULL, 0, small, rest));
    assert_int_equal(lagrangians[0].kind, LAGRANGIAN_MASS);
    lagrangians[0].kind = LAGRANGIAN_GENERAL;
    assert_int_equal(lagrangian_mass(lagrangians).kind, GVI_MASS_NONE);
}

static long double error(const struct system *s, int degree, int steps, const long double *z)
{
    gvi_stepper st = from_l(s->L, 0, degree, s->q, s->v);
    real v[2];
    long double worst = 0;
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, 1/(real)steps));
    assert_ok(gvi_velocity(&st, v));
    for (int i = 0; i < 2; ++i) worst = fmaxl(worst, fmaxl(fabsl(st.q[i] - z[i]), fabsl(v[i] - z[2 + i])));
    return worst;
}

TEST(order_is_2s)
{
    for (int k = 0; k < COUNT(systems); ++k) {
        long double z[4];
        reference(systems + k, z);
        for (int s = 1; s <= (KIND == 1 ? 1 : 3); ++s) {
            const int steps = s == 1 ? 60 : s == 2 ? 30 : 16;
            const long double coarse = error(systems + k, s, steps, z), fine = error(systems + k, s, steps*3/2, z);
            assert_between(2*s - 0.3L, logl(coarse/fine)/logl(1.5L), 2*s + 0.3L);
        }
    }
}

TEST(energy_stays)
{
    for (int k = 0; k < COUNT(systems); ++k) {
        if (systems[k].timed) continue;
        gvi_stepper st = from_l(systems[k].L, 0, 8, systems[k].q, systems[k].v);
        real start, now;
        long double worst = 0;
        assert_ok(gvi_energy(&st, &start));
        for (int i = 0; i < 3000; ++i) {
            assert_ok(gvi_step(&st, systems[k].h));
            assert_ok(gvi_energy(&st, &now));
            worst = fmaxl(worst, fabsl((long double)now/(long double)start - 1));
        }
        assert_between(0, worst, 45*EPS);             /* 1e-14 in double */
    }
}

LAGRANGIAN(planet, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + 1/sqrt(q[0]*q[0] + q[1]*q[1]); }

/* -- the trap, in each kind: a variable that keeps the value alone.  `real r = q[0]` does the same, with a warning */

LAGRANGIAN(trap_potential, 2)
{
    const real r2 = (real)creal(q[0]*q[0] + q[1]*q[1]);
    return (v[0]*v[0] + v[1]*v[1])/2 + 1/sqrt(r2);
}
LAGRANGIAN(trap_linear, 2)
{
    const real x = (real)creal(q[0]);
    return (v[0]*v[0] + v[1]*v[1])/2 - q[1]/2*v[0] + (x/2 + x*x*x/12)*v[1] - (q[0]*q[0] + 4*q[1]*q[1])/2;
}
LAGRANGIAN(trap_mass, 2)
{
    const real c = (real)cos(creal(q[0] - q[1]));
    return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*c + 2*g*cos(q[0]) + g*cos(q[1]);
}
LAGRANGIAN(trap_general, 2)
{
    const real v2 = (real)creal(v[0]*v[0] + v[1]*v[1]);
    return -25*sqrt(1 - v2/25) + 1/sqrt(q[0]*q[0] + q[1]*q[1]);
}
/* at rest, at a place where the derivative that is lost is 0 */
LAGRANGIAN(trap_at_rest, 1)
{
    const real c = (real)cos(creal(q[0]));
    return v[0]*v[0]/2 + c;
}

static void assert_refused(const lagrangian_function *function, const real *q, const real *v, const char *sentence)
{
    static lagrangian L;
    const char *wrong = lagrangian_init(&L, *function, NULL, 0, q, v);
    assert_non_null(wrong);
    if (!strstr(wrong, sentence)) print_error("\"%s\" is not \"%s\"\n", wrong, sentence);
    assert_non_null(strstr(wrong, sentence));
    /* and nothing runs with it */
    const gvi_effect effect = lagrangian_effect(&L);
    const gvi_desc desc = { .n = 2, .degree = 2, .effects = &effect, .effect_count = 1, .mass = lagrangian_mass(&L) };
    assert_int_equal(gvi_size(&desc), 0);
}

static const real some_q[] = { R(0.8), R(0.4) }, some_v[] = { R(0.2), R(0.5) }, zeros[2];

TEST(lost_derivatives_are_refused)
{
    const char *question = "is a variable in L a double that has to be a number?";
    assert_refused(&trap_potential, some_q, some_v, question);
    assert_refused(&trap_linear, some_q, some_v, question);
    assert_refused(&trap_mass, some_q, some_v, question);
    assert_refused(&trap_general, some_q, some_v, question);
    assert_refused(&trap_potential, some_q, some_v, "dL/dq[0] is 0 by numbers, -1.11");     /* -0.8/0.8^(3/2) */
    assert_refused(&trap_general, some_q, some_v, "dL/dv[0] is 0 by numbers, 0.20");
    assert_refused(&trap_at_rest, zeros, zeros, question);
}

LAGRANGIAN(first_order, 2) { return q[0]*v[1] - q[0]*q[0] - q[1]*q[1]; }
LAGRANGIAN(first_order_alone, 2) { return q[0]*v[1] - q[1]*v[0]; }
LAGRANGIAN(massless, 2) { return v[0]*v[0]/2 + v[1] - q[0]*q[0] - q[1]*q[1]; }
LAGRANGIAN(one_direction, 2) { return (v[0] + v[1])*(v[0] + v[1])/2 - q[0]*q[0] - q[1]*q[1]; }
LAGRANGIAN(not_there, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + log(q[0] - 5); }
LAGRANGIAN(steep, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + sqrt(q[1]); }
LAGRANGIAN(nowhere, 2) { return v[0]*v[0] + v[1]*v[1]; }
LAGRANGIAN(large, LAGRANGIAN_MOST + 1) { return v[0]*v[0]; }

TEST(refusals_say_why)
{
    assert_refused(&first_order, some_q, some_v, "L is linear in v: its equations are of first order; give H(t,q,p) by HAMILTONIAN");
    assert_refused(&first_order_alone, (real[]){ 1, 1 }, zeros, "L is linear in v: its equations are of first order");
    assert_refused(&massless, some_q, some_v, "L has no kinetic energy in q[1]");
    assert_refused(&one_direction, some_q, some_v, "L has no kinetic energy in some direction");
    assert_refused(&not_there, some_q, some_v, "L is not finite at the start");
    assert_refused(&steep, zeros, some_v, "dL/dq[1] is not finite at the start");
    assert_refused(&nowhere, NULL, some_v, "the start is NULL or not finite: t, q, v");
    assert_refused(&nowhere, some_q, NULL, "the start is NULL");
    for (int i = 0; i < 2; ++i) {
        const real none[] = { 0, i ? (real)NAN : (real)INFINITY };
        assert_refused(&nowhere, none, some_v, "the start is NULL or not finite");
        assert_refused(&nowhere, some_q, none, "the start is NULL or not finite");
    }
    assert_refused(&large, some_q, some_v, "n is 33, there is room for 32: define LAGRANGIAN_MOST before lagrangian.h");
}

LAGRANGIAN(alone, 2) { return v[0]*v[0] + v[1]*v[1] - cos(q[0])*cos(q[1]); }
LAGRANGIAN(through_mass, 2) { return (2 + cos(q[1]))*v[0]*v[0] + v[1]*v[1] - cos(q[0]); }
LAGRANGIAN(through_v, 2) { return v[0]*v[0] + v[1]*v[1] + q[0]*q[0]*v[1]; }
LAGRANGIAN(through_v4, 2) { return v[0]*v[0] + v[1]*v[1] + v[0]*v[0]*v[0]*v[0] - cos(q[0]); }

TEST(another_n_in_desc_is_refused)
{
    const lagrangian_function all[] = { alone, through_mass, through_v, through_v4 };
    for (int i = 0; i < 4; ++i)
        for (int n = 1; n <= 3; ++n) {
            lagrangian L;
            assert_null(lagrangian_init(&L, all[i], NULL, 0, (gvi_real[]){ 1, 1 }, (gvi_real[]){ 1, 1 }));
            const gvi_effect scene[] = { lagrangian_effect(&L) };
            const gvi_desc desc = { .n = n, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 1 };
            const gvi_real q[] = { 1, 1, 1 };
            gvi_real memory[20000];
            gvi_stepper st;
            gvi_status status = gvi_init(&st, &desc, memory, sizeof memory);
            if (status == GVI_E_SINGULAR && n == 3) continue;                   /* a constant M shows it */
            if (status == GVI_OK) status = gvi_start(&st, 0, q, q);
            if (status == GVI_OK) status = gvi_step(&st, R(0.125));
            assert_status(status, n == 2 ? GVI_OK : GVI_E_CALLBACK);
        }
}

/* -- functions, against their derivatives */

LAGRANGIAN(functions, 8)
{
    return sqrt(q[0]) + 2*exp(q[1]) + 3*log(q[2]) + 4*sin(q[3]) + 5*cos(q[4]) + 6*tan(q[5]) + 7*fabs(q[6] - 1) + 8*tanh(q[7])
           + pow(v[0], 3) + pow(v[1], R(-1.5)) + pow(2, v[2]) + pow(v[3], v[4]);
}

LAGRANGIAN(more_functions, 6)
{
    return cbrt(q[0]) + 2*asin(q[1]) + 3*acos(q[2]) + 4*atan(q[3]) + 5*atan2(q[4], q[5]) + sinh(v[0]) + 2*cosh(v[1])
           + 3*asinh(v[2]) + 4*acosh(v[3] + 1) + 5*atanh(v[4]) + 6*hypot(v[4], v[5]);
}

TEST(more_functions_have_their_derivatives)
{
    real q[6], v[6], by_q[6], by_v[6];
    for (int i = 0; i < 6; ++i) q[i] = v[i] = R(0.5) + (real)i/64;
    const real value = lagrangian_at(&more_functions, NULL, 0, q, v, by_q, by_v);
    const long double x[6] = { q[0], q[1], q[2], q[3], q[4], q[5] }, d2 = x[4]*x[4] + x[5]*x[5], r = sqrtl(d2);
    const long double right[6] = { powl(x[0], -2/3.0L)/3, 2/sqrtl(1 - x[1]*x[1]), -3/sqrtl(1 - x[2]*x[2]), 4/(1 + x[3]*x[3]),
                                   5*x[5]/d2, -5*x[4]/d2 };
    const long double right_v[6] = { coshl(x[0]), 2*sinhl(x[1]), 3/sqrtl(1 + x[2]*x[2]), 4/sqrtl((x[3] + 1)*(x[3] + 1) - 1),
                                     5/(1 - x[4]*x[4]) + 6*x[4]/r, 6*x[5]/r };
    for (int i = 0; i < 6; ++i) {
        assert_close(by_q[i], right[i], 32*EPS);
        assert_close(by_v[i], right_v[i], 32*EPS);
    }
    assert_close(value, cbrtl(x[0]) + 2*asinl(x[1]) + 3*acosl(x[2]) + 4*atanl(x[3]) + 5*atan2l(x[4], x[5]) + sinhl(x[0])
                 + 2*coshl(x[1]) + 3*asinhl(x[2]) + 4*acoshl(x[3] + 1) + 5*atanhl(x[4]) + 6*r, 128*EPS);
}

TEST(functions_have_their_derivatives)
{
    real q[8], v[8], by_q[8], by_v[8];
    for (int i = 0; i < 8; ++i) q[i] = v[i] = R(0.5) + (real)i/64;
    const real value = lagrangian_at(&functions, NULL, 0, q, v, by_q, by_v);
    const long double x[8] = { q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7] };
    const long double right[8] = { 0.5L/sqrtl(x[0]), 2*expl(x[1]), 3/x[2], 4*cosl(x[3]), -5*sinl(x[4]), 6/(cosl(x[5])*cosl(x[5])),
                                   -7, 8/(coshl(x[7])*coshl(x[7])) };
    const long double power = powl(x[3], x[4]), right_v[5] = { 3*x[0]*x[0], -1.5L*powl(x[1], -2.5L), powl(2, x[2])*logl(2),
                                                             x[4]*power/x[3], power*logl(x[3]) };
    for (int i = 0; i < 8; ++i) assert_close(by_q[i], right[i], 32*EPS);
    for (int i = 0; i < 5; ++i) assert_close(by_v[i], right_v[i], 32*EPS);
    assert_close(value, sqrtl(x[0]) + 2*expl(x[1]) + 3*logl(x[2]) + 4*sinl(x[3]) + 5*cosl(x[4]) + 6*tanl(x[5]) + 7*fabsl(x[6] - 1)
                 + 8*tanhl(x[7]) + powl(x[0], 3) + powl(x[1], -1.5L) + powl(2, x[2]) + power, 128*EPS);
}

/* -- beside other effects */

LAGRANGIAN(oscillator, 1) { return v[0]*v[0]/2 - R(1.25)*q[0]*q[0]/2; }
GVI_EACH(friction, 1, v, f) { x->f[0] -= x->v[0]/2; }

/* Which entries of M vary is found once; the others are those of the start. */
LAGRANGIAN(patched, 4)
{
    const number a = q[0], c = q[2];
    return (3*v[0]*v[0] + (2 + sin(a))*v[1]*v[1] + 2*v[2]*v[2] + v[3]*v[3])/2 + cos(c)*v[2]*v[0]/4 + v[1]*v[0]/8
           + cos(t)*v[3]*v[1]/4 + v[3]*v[2]/16 - a*a;
}

TEST(entries_of_the_mass_are_right_whichever_vary)
{
    static lagrangian L;
    const real q0[] = { R(0.3), R(0.2), R(0.1), 0 }, v0[] = { R(0.1), R(0.2), R(0.3), R(0.4) };
    real q[4*3], M[16*3] = { 0 }, t[3];
    assert_null(lagrangian_init(&L, patched, NULL, 0, q0, v0));
    assert_int_equal(L.kind, LAGRANGIAN_MASS);
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 4; ++i) q[i*3 + k] = R(0.7)*(real)(i + 1) - (real)k, t[k] = 1 + (real)k;
    const gvi_points x = { .n = 4, .count = 3, .stride = 3, .t = t, .q = q, .mass = M };
    const gvi_mass mass = lagrangian_mass(&L);
    assert_int_equal(mass.points(&x, mass.user), 0);
    for (int k = 0; k < 3; ++k) {
        const real known[4][4] = { { 3 }, { R(0.125), 2 + sin(q[k]) }, { cos(q[6 + k])/4, 0, 2 }, { 0, cos(t[k])/4, R(0.0625), 1 } };
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j <= i; ++j) assert_close(M[(i*4 + j)*3 + k], known[i][j], 16*EPS);
    }
}

TEST(friction_is_a_row)                    /* q = e^(-t/4) (cos wt + sin wt/(4w)), w^2 = 5/4 - 1/16 */
{
    static lagrangian L;
    const real q[] = { 1 }, v[] = { 0 };
    assert_null(lagrangian_init(&L, oscillator, NULL, 0, q, v));
    const gvi_effect scene[] = { lagrangian_effect(&L), { .kind = GVI_FORCE, .points = friction } };
    const gvi_desc desc = { .n = 1, .degree = 8, .effects = scene, .effect_count = 2, .mass = lagrangian_mass(&L) };
    gvi_stepper st = new_motion(&desc, 0, q, v);
    for (int i = 0; i < 8; ++i) assert_ok(gvi_step(&st, R(0.25)));
    const long double w = sqrtl(1.1875L);
    assert_close(st.q[0], expl(-0.5L)*(cosl(2*w) + sinl(2*w)/(4*w)), 8*EPS);
}

LAGRANGIAN(falling, 2) { return (v[0]*v[0] + v[1]*v[1])/2 - g*q[1]; }
LAGRANGIAN(swinging, 1) { return v[0]*v[0]/2 + g*cos(q[0]); }
GVI_EACH(rod, 2, rows(1))
{
    x->g[0] = (x->q[0]*x->q[0] + x->q[1]*x->q[1] - 1)/2;
    x->jacobian[0] = x->q[0];
    x->jacobian[1] = x->q[1];
}

TEST(constraints_are_rows)                 /* a pendulum by its rod, and by its angle */
{
    static lagrangian L;
    const real q[] = { 1, 0 }, v[] = { 0, 0 }, angle[] = { R(1.57079632679489661923) }, rest[] = { 0 };
    assert_null(lagrangian_init(&L, falling, NULL, 0, q, v));
    const gvi_effect scene[] = { lagrangian_effect(&L), { .kind = GVI_CONSTRAINT, .points = rod, .rows = 1 } };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 2, .mass = lagrangian_mass(&L) };
    gvi_stepper st = new_motion(&desc, 0, q, v), other = from_l(&swinging, 1, 8, angle, rest);
    for (int i = 0; i < 32; ++i) {
        assert_ok(gvi_step(&st, R(0.0625)));
        assert_ok(gvi_step(&other, R(0.0625)));
    }
    assert_close(st.q[0], sin(other.q[0]), 4096*EPS);
    assert_close(st.q[1], -cos(other.q[0]), 4096*EPS);
}

LAGRANGIAN(on_spring, 1)
{
    const real *k = (const real *)user;
    return v[0]*v[0]/2 - *k*q[0]*q[0]/2;
}

TEST(parameters_come_by_user)
{
    static lagrangian L;
    const real k = 4, q[] = { 1 }, v[] = { 0 };
    assert_null(lagrangian_init(&L, on_spring, &k, 0, q, v));
    const gvi_effect scene[] = { lagrangian_effect(&L) };
    const gvi_desc desc = { .n = 1, .degree = 8, .effects = scene, .effect_count = 1, .mass = lagrangian_mass(&L) };
    gvi_stepper st = new_motion(&desc, 0, q, v);
    for (int i = 0; i < 8; ++i) assert_ok(gvi_step(&st, R(0.125)));
    assert_close(st.q[0], cosl(2), 8*EPS);
}

/* what the tool makes of L is a scene in which check.h finds nothing wrong */
TEST(check_finds_nothing)
{
    for (int k = 0; k < COUNT(systems) && KIND == 2; ++k) {
        check_finding list[4];
        check_report report = { .list = list, .room = 4 };
        char line[300];
        from_l(systems[k].L, 0, 2, systems[k].q, systems[k].v);
        const gvi_desc desc = { .n = 2, .effects = effects, .effect_count = 1, .mass = lagrangian_mass(lagrangians) };
        check_scene(&desc, 0, systems[k].q, systems[k].v, &report);
        for (int i = 0; i < report.count && i < 4; ++i) print_error("%s\n", check_line(&list[i], line, sizeof line));
        assert_int_equal(report.count, 0);
        assert_true(report.checked > 0);
    }
}

/* -- the watch: L of another kind than it was found to be, or said to be */

LAGRANGIAN(bump, 1)
{
    const number u = q[0] - 50, y = exp(-u*u)/20, slope = -2*u*y;
    return v[0]*v[0]*(1 + slope*slope)/2 - g*y;
}
LAGRANGIAN(field_far_off, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + exp(-(q[0] - 50)*(q[0] - 50)/4)*q[0]*v[1]; }
LAGRANGIAN(wall_far_off, 2)
{
    const real over = (real)creal(q[0]) - 50;
    return (v[0]*v[0] + v[1]*v[1])/2 - (over > 0 ? 500*over*over : 0);
}
LAGRANGIAN(switched, 1) { return *(const real *)user*v[0]*v[0]/2 - q[0]*q[0]/2; }

/* Six seconds at 25 m/s; NULL, or what gvi_why says */
static const char *ride(const lagrangian_function *function, lagrangian_kind kind, int verlet, real *end)
{
    static lagrangian L;
    static char why[400];
    const real q[] = { 0, R(0.1) }, v[] = { 25, R(0.25) };
    assert_null(lagrangian_init(&L, *function, NULL, 0, q, v));
    L.kind = kind;
    const gvi_effect scene[] = { lagrangian_effect(&L) };
    gvi_desc desc = { .n = function->n, .effects = scene, .effect_count = 1, .mass = lagrangian_mass(&L) };
    if (verlet) desc.degree = 1, desc.rule = (gvi_rule){ .kind = GVI_LOBATTO, .points = 2 };
    gvi_stepper st = new_motion(&desc, 0, q, v);
    /* an explicit step evaluates one point, and one in eight is looked at: every metre of a bump that is 4 m wide in float */
    const int count = verlet ? 1200 : 600;
    for (int k = 0; k < count && st.status == GVI_OK; ++k) gvi_step(&st, 6/(real)count);
    *end = st.q[0];
    if (st.status == GVI_OK) return NULL;
    assert_int_equal(st.status, GVI_E_CALLBACK);
    return strcpy(why, gvi_why(&st));
}

static void assert_says(const char *wrong, const char *sentence)
{
    assert_non_null(wrong);
    if (!strstr(wrong, sentence)) print_error("\"%s\" is not \"%s\"\n", wrong, sentence);
    assert_non_null(strstr(wrong, sentence));
}

TEST(watch_sees_another_kind)
{
    real end, mass, general;
    for (int verlet = 0; verlet < 2; ++verlet) {
        assert_says(ride(&bump, LAGRANGIAN_POTENTIAL, verlet, &end), "set L.kind = LAGRANGIAN_MASS after lagrangian_init");
        assert_between(40, end, 50);
    }
    assert_null(ride(&bump, LAGRANGIAN_MASS, 0, &mass));
    assert_null(ride(&bump, LAGRANGIAN_GENERAL, 0, &general));
    assert_close(mass, general, 45000*EPS*150);
    assert_says(ride(&field_far_off, LAGRANGIAN_POTENTIAL, 0, &end), "set L.kind = LAGRANGIAN_LINEAR after lagrangian_init");
    assert_between(30, end, 50);
    assert_null(ride(&field_far_off, LAGRANGIAN_LINEAR, 0, &end));
}

/* By the dial as well: it does not creep up to the bump in ever shorter steps, but ends.  (In float steps of 256 EPS are
   longer than the bump.) */
TEST(watch_ends_a_run_by_the_dial)
{
    static lagrangian L;
    const real q[] = { 0 }, v[] = { 25 };
    assert_null(lagrangian_init(&L, bump, NULL, 0, q, v));
    const gvi_effect scene[] = { lagrangian_effect(&L) };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = scene, .effect_count = 1, .mass = lagrangian_mass(&L),
                            .resolution = (EPS > R(1e-10) ? 16 : 256)*EPS };
    gvi_stepper st = new_motion(&desc, 0, q, v);
    for (int k = 0; k < 200 && st.status == GVI_OK; ++k) gvi_advance(&st, 4);
    assert_int_equal(st.status, GVI_E_CALLBACK);
    assert_says(gvi_why(&st), "set L.kind = LAGRANGIAN_MASS after lagrangian_init");
    assert_between(1, st.t, 2);
}

/* The wall stands at 50; steps are 1/4 long and take eight points or more, and of every fourth look at one of 36 points
   derivatives are compared. */
TEST(watch_sees_a_derivative_lost_on_the_way)
{
    real end;
    assert_says(ride(&wall_far_off, LAGRANGIAN_POTENTIAL, 0, &end), "dL/dq[0] is 0 by numbers, -");
    assert_between(49.9L, end, 50 + (4*36/8 + 1)/4.0L);
}

TEST(watch_sees_a_mass_changed)
{
    static lagrangian L;
    real m = 1;
    const real q[] = { 1 }, v[] = { R(0.5) };
    assert_null(lagrangian_init(&L, switched, &m, 0, q, v));
    const gvi_effect scene[] = { lagrangian_effect(&L) };
    const gvi_desc desc = { .n = 1, .effects = scene, .effect_count = 1, .mass = lagrangian_mass(&L) };
    gvi_stepper st = new_motion(&desc, 0, q, v);
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, R(0.125)));
    m = 2;
    const long long points = (long long)st.counters.effect[0];
    while ((long long)st.counters.effect[0] < points + 36 && st.status == GVI_OK) gvi_step(&st, R(0.125));
    assert_int_equal(st.status, GVI_E_CALLBACK);
    assert_says(gvi_why(&st), "its dL/dv[0] is");
    m = 1;
    for (int k = 0; k < 20; ++k) assert_ok(gvi_step(&st, R(0.125)));
}

/* -- what has no units, and what only cancels */

LAGRANGIAN(length, 2) { return sqrt(v[0]*v[0] + sin(q[0])*sin(q[0])*v[1]*v[1]); }
LAGRANGIAN(multiplied, 3) { return (v[0]*v[0] + v[1]*v[1])/2 - g*q[1] + q[2]*(q[0]*q[0] + q[1]*q[1] - 1); }
LAGRANGIAN(electron, 1) { return R(-81871.0)*sqrt(1 - v[0]*v[0]/R(8.98755179e16)) + R(0.16)*q[0]; }
LAGRANGIAN(slow, 1) { return exp(-t/R(3e13))*v[0]*v[0]/2; }
LAGRANGIAN(strong, 1) { return v[0]*v[0]/2 + R(1e12)*v[0] - q[0]*q[0]/2; }
LAGRANGIAN(small_mass, 1) { return R(1.3e-30)*(v[0]*v[0] - q[0]*q[0])/2; }
LAGRANGIAN(turned_back, 2)
{
    const number x = v[0] - 3*q[1], y = v[1] + 3*q[0];
    return (x*x + y*y)/2 + 3*(q[1]*v[0] - q[0]*v[1]) - 10*(q[0]*q[0] + q[1]*q[1]);
}
LAGRANGIAN(two_large_ones, 1) { return 1024*v[0]*v[0] - R(1023.5)*v[0]*v[0] - q[0]*q[0]/2; }
LAGRANGIAN(noisy, 1) { return v[0]*v[0]/2 - q[0]*q[0]/2 + R(1e-8)*sin(1e12*(double)creal(q[0])); }
LAGRANGIAN(half, 1) { return v[0]*v[0]/2 - 1/2*9*q[0]*q[0]; }

TEST(no_units)
{
    const struct { const lagrangian_function *L; lagrangian_kind kind; real q[2], v[2]; } cases[] = {
        { &electron, LAGRANGIAN_GENERAL, { 0 }, { 0 } },      { &slow, LAGRANGIAN_MASS, { 0 }, { 1 } },
        { &strong, LAGRANGIAN_LINEAR, { 0 }, { 0 } },         { &small_mass, LAGRANGIAN_POTENTIAL, { 1 }, { R(0.5) } },
        { &turned_back, LAGRANGIAN_POTENTIAL, { 1, R(0.3) }, { R(0.2), R(0.5) } },
        { &two_large_ones, LAGRANGIAN_POTENTIAL, { 1 }, { R(0.2) } },
        { &noisy, LAGRANGIAN_POTENTIAL, { 1 }, { R(0.5) } },
    };
    static lagrangian L;
    for (int k = 0; k < COUNT(cases); ++k) {
        const char *wrong = lagrangian_init(&L, *cases[k].L, NULL, 0, cases[k].q, cases[k].v);
        if (wrong) print_error("%s\n", wrong);
        assert_null(wrong);
        if (L.kind != cases[k].kind) print_error("%d: %s\n", k, lagrangian_text(&L));
        assert_int_equal(L.kind, cases[k].kind);
    }
    assert_null(lagrangian_init(&L, strong, NULL, 0, zeros, zeros));
    assert_close(L.M[0], 1, 0);
    assert_null(lagrangian_init(&L, small_mass, NULL, 0, zeros, zeros));
    assert_close(L.M[0], R(1.3e-30), 0);
    assert_null(lagrangian_init(&L, half, NULL, 0, some_q, zeros));
    assert_string_equal(lagrangian_text(&L), "v'Mv/2, no q seen in it");
    assert_refused(&length, some_q, some_v, "of first degree in v");
    assert_refused(&multiplied, (real[]){ 1, 0, 0 }, (real[]){ 0, 0, 0 }, "by HOLDS (GVI_CONSTRAINT)");
}

/* -- rows typed, against derivatives by hand */

HOLDS(circle, 3, 1) { row[0] = q[0]*q[0] + q[1]*q[1] - 1 - sin(t)*q[0]; }
ROLLS(blade, 3, 1) { row[0] = sin(q[2])*v[0] - cos(q[2])*v[1] + q[0]*t; }
ROLLS(curved, 3, 1) { row[0] = sin(q[2])*v[0] - cos(q[2])*v[1] + v[0]*v[1]; }
ROLLS(rolls_trap, 3, 1) { row[0] = sin(q[2])*v[0] - (real)creal(cos(q[2])*v[1]); }
HOLDS(holds_trap, 2, 1) { row[0] = q[0]*q[0] + q[1]*q[1] + q[0]*(real)creal(q[1]) - 1; }
DISSIPATION(drag, 3) { return (v[0]*v[0] + v[1]*v[1])*(2 + q[0])/8; }
DISSIPATION(drag_trap, 3) { return (v[0]*v[0] + v[1]*(real)creal(v[1]))/2; }

static const real two_t[] = { R(0.5), 1 }, two_q[] = { R(0.25), R(0.5), 1, 2, R(0.75), R(-0.5) }, two_v[] = { 1, 2, 3, 4, 5, 6 };

TEST(typed_rows_have_their_derivatives)
{
    real row[2], G[6], rate[2], f[6] = { 0 };
    const char *why = NULL;
    const real *q = two_q;
    gvi_points x = { .n = 3, .count = 2, .stride = 2, .t = two_t, .q = q, .g = row, .jacobian = G, .rate = rate, .why = &why };
    assert_int_equal(circle(&x, NULL), 0);
    for (int k = 0; k < 2; ++k) {
        assert_close(row[k], q[k]*q[k] + q[2 + k]*q[2 + k] - 1 - sinl(two_t[k])*q[k], 8*EPS);
        assert_close(G[k], 2*q[k] - sinl(two_t[k]), 8*EPS);
        assert_close(G[2 + k], 2*q[2 + k], 8*EPS);
        assert_close(G[4 + k], 0, 0);
        assert_close(rate[k], -cosl(two_t[k])*q[k], 8*EPS);
    }
    assert_int_equal(blade(&x, NULL), 0);
    for (int k = 0; k < 2; ++k) {
        assert_close(G[k], sinl(q[4 + k]), 8*EPS);
        assert_close(G[2 + k], -cosl(q[4 + k]), 8*EPS);
        assert_close(rate[k], q[k]*two_t[k], 8*EPS);
    }
    x.v = two_v;
    x.f = f;
    assert_int_equal(drag(&x, NULL), 0);
    for (int k = 0; k < 2; ++k) assert_close(f[2 + k], -two_v[2 + k]*(2 + q[k])/4, 8*EPS);
    assert_null(why);
}

/* several rows, more coordinates than L may have, and what the arrays held before */
HOLDS(two_rows, 40, 2)
{
    row[0] = q[0]*q[39] - t*t;
    row[1] = sin(q[1]) - 3*t*q[2];
}
ROLLS(two_that_roll, 3, 2)
{
    row[0] = q[0]*v[1] + t;
    row[1] = v[2] - q[1]*q[2]*v[0];
}

TEST(several_typed_rows_have_their_derivatives)
{
    real t[] = { R(0.5), 2 }, q[80], row[4], G[160], rate[4], A[12], a[4], kept[] = { 7, 7, 7, 7 };
    for (int i = 0; i < 80; ++i) q[i] = R(0.25) + (real)i/64;
    for (int i = 0; i < 160; ++i) G[i] = 5;
    for (int i = 0; i < 12; ++i) A[i] = 5;
    for (int i = 0; i < 4; ++i) row[i] = rate[i] = a[i] = 5;
    gvi_points x = { .n = 40, .count = 2, .stride = 2, .t = t, .q = q, .g = row, .jacobian = G, .rate = rate };
    assert_int_equal(two_rows(&x, NULL), 0);
    for (int k = 0; k < 2; ++k) {
        const long double first[] = { q[78 + k], q[k] }, second[] = { cosl(q[2 + k]), -3*(long double)t[k] };
        assert_close(row[k], (long double)q[k]*q[78 + k] - (long double)t[k]*t[k], 8*EPS);
        assert_close(row[2 + k], sinl(q[2 + k]) - 3*(long double)t[k]*q[4 + k], 8*EPS);
        assert_close(rate[k], -2*(long double)t[k], 8*EPS);
        assert_close(rate[2 + k], -3*(long double)q[4 + k], 8*EPS);
        for (int i = 0; i < 40; ++i) {
            assert_close(G[i*2 + k], i == 0 ? first[0] : i == 39 ? first[1] : 0, 8*EPS);
            assert_close(G[(40 + i)*2 + k], i == 1 ? second[0] : i == 2 ? second[1] : 0, 8*EPS);
        }
    }

    x = (gvi_points){ .n = 3, .count = 2, .stride = 2, .t = t, .q = q, .g = kept, .jacobian = A, .rate = a };
    assert_int_equal(two_that_roll(&x, NULL), 0);
    for (int k = 0; k < 2; ++k) {
        const long double right[2][3] = { { 0, q[k], 0 }, { -(long double)q[2 + k]*q[4 + k], 0, 1 } };
        assert_close(a[k], t[k], 0);
        assert_close(a[2 + k], 0, 0);
        for (int i = 0; i < 6; ++i) assert_close(A[i*2 + k], right[i/3][i%3], 8*EPS);
        assert_close(kept[k], 7, 0);
    }
}

TEST(typed_rows_refuse)
{
    real row[6], G[18], rate[6], f[18] = { 0 }, t[6], q[18], v[18];
    const char *why = NULL;
    for (int k = 0; k < 18; ++k) {
        t[k/3] = (real)(k/3)/8;
        q[k] = 1 + (real)k/32;
        v[k] = 1 + (real)k/16;
    }
    gvi_points x = { .n = 3, .count = 6, .stride = 6, .t = t, .q = q, .v = v, .f = f, .g = row, .jacobian = G, .rate = rate, .why = &why };
    const struct { gvi_points_fn *fn; int n; const char *says; } cases[] = {
        { curved, 3, "a row of ROLLS is not linear in v" },     { rolls_trap, 3, "or has lost a derivative" },
        { holds_trap, 2, "a row of HOLDS has lost" },           { drag_trap, 3, "DISSIPATION has lost a derivative" },
        { circle, 2, "HOLDS is of another n" },                 { blade, 2, "ROLLS is of another n" },
        { drag, 2, "DISSIPATION is of another n" },
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        x.n = cases[k].n;
        why = NULL;
        assert_int_not_equal(cases[k].fn(&x, NULL), 0);
        assert_says(why, cases[k].says);
    }
    x.n = 3;
    assert_int_equal(circle(&x, NULL), 0);
    assert_int_equal(blade(&x, NULL), 0);
    assert_int_equal(drag(&x, NULL), 0);
}

/* -- H(q,p) */

/* two vortices of strength 1, q = x, p = y, at a distance d: they turn about their middle with 1/(pi d^2) */
HAMILTONIAN(vortices, 2)
{
    const number x = q[0] - q[1], y = p[0] - p[1];
    return -log(x*x + y*y)/R(12.5663706143591729538505735331180115);
}

static hamiltonian hamiltonians[1];

static gvi_stepper from_h(const lagrangian_function *function, int degree, const real *q, const real *p)
{
    assert_null(hamiltonian_init(hamiltonians, *function, NULL, 0, q, p));
    effects[0] = hamiltonian_effect(hamiltonians);
    const gvi_desc desc = { .n = function->n, .degree = degree, .effects = effects, .effect_count = 1,
                            .mass = hamiltonian_mass(hamiltonians), .formulation = GVI_MOMENTA };
    gvi_stepper st = new_stepper(&desc);
    assert_ok(gvi_start_momentum(&st, 0, q, p));
    return st;
}

TEST(vortices_have_order_2s)
{
    const real q[] = { R(0.5), R(-0.5) }, p[] = { 0, 0 };
    for (int s = 1; s <= (KIND == 1 ? 2 : 4); ++s) {
        long double off[2];
        for (int k = 0; k < 2; ++k) {
            const int steps = k ? 6 : 4;
            gvi_stepper st = from_h(&vortices, s, q, p);
            for (int i = 0; i < steps; ++i) assert_ok(gvi_step(&st, 6/(real)steps));
            const long double angle = 6/3.14159265358979323846264338327950288L;
            off[k] = hypotl(st.q[0] - cosl(angle)/2, st.p[0] - sinl(angle)/2);
        }
        assert_between(2*s - 0.3L, logl(off[0]/off[1])/logl(1.5L), 2*s + 0.3L);
    }
}

TEST(energy_of_h_stays)
{
    const real q[] = { R(0.5), R(-0.25) }, p[] = { R(0.125), 0 };
    gvi_stepper st = from_h(&vortices, 8, q, p);
    real start, now;
    long double worst = 0;
    assert_ok(gvi_energy(&st, &start));
    assert_close(start, -logl(0.578125L)/12.5663706143591729538505735331180115L, 8*EPS);
    for (int i = 0; i < 3000; ++i) {
        assert_ok(gvi_step(&st, R(0.25)));
        assert_ok(gvi_energy(&st, &now));
        worst = fmaxl(worst, fabsl((long double)(now - start)));
    }
    assert_between(0, worst, 45*EPS);
    assert_status(gvi_action(&st, &now), GVI_E_CALLBACK);
    assert_says(gvi_why(&st), "H has no action");
}

/* p of the Lagrangian: the same steps from L and from H, to rounding */
HAMILTONIAN(planet_by_h, 2) { return (p[0]*p[0] + p[1]*p[1])/2 - 1/sqrt(q[0]*q[0] + q[1]*q[1]); }

TEST(h_and_l_are_one_motion)
{
    const real q[] = { R(0.4), 0 }, v[] = { 0, 2 };
    gvi_stepper a = from_l(&planet, 1, 8, q, v), b = from_h(&planet_by_h, 8, q, v);
    for (int i = 0; i < 60; ++i) {
        assert_ok(gvi_step(&a, R(0.1)));
        assert_ok(gvi_step(&b, R(0.1)));
    }
    for (int i = 0; i < 2; ++i) assert_close(a.q[i], b.q[i], 4096*EPS);
}

HAMILTONIAN(trap_of_h, 1)
{
    const real r = (real)creal(p[0]);
    return r*r/2 + q[0]*q[0];
}

TEST(h_refuses)
{
    static hamiltonian H;
    const real q[] = { R(0.5), R(-0.5) }, p[] = { R(0.1), 0 };
    const char *wrong = hamiltonian_init(&H, trap_of_h, NULL, 0, q, p);
    assert_non_null(wrong);
    assert_non_null(strstr(wrong, "dH/dp[0] is 0 by numbers, "));
    gvi_effect effect = hamiltonian_effect(&H);
    gvi_desc desc = { .n = 1, .degree = 2, .effects = &effect, .effect_count = 1, .mass = hamiltonian_mass(&H) };
    assert_int_equal(gvi_size(&desc), 0);
    /* a velocity is not where it starts from */
    assert_null(hamiltonian_init(&H, vortices, NULL, 0, q, p));
    effect = hamiltonian_effect(&H);
    desc = (gvi_desc){ .n = 2, .degree = 2, .effects = &effect, .effect_count = 1, .mass = hamiltonian_mass(&H), .formulation = GVI_MOMENTA };
    gvi_stepper st = new_stepper(&desc);
    assert_status(gvi_start(&st, 0, q, p), GVI_E_CALLBACK);
}

RUN_TESTS(NULL, NULL)
