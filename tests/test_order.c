/* The order, measured.  One problem holds everything that has ever hidden a
   wrong order: nonlinear, not separable, a mass matrix that depends on q, a
   term linear in v, every term with a clock of its own, and damping.  Parts of
   it can be left out, so that each formulation gets its turn.

   In long double, so that rounding does not blur the slopes.  The reference is
   Gragg-Bulirsch-Stoer extrapolation of Hamilton's equations, which shares no
   line with gvi.h and no formula with its callbacks.                         */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#include "gvi_test.h"
#include <tgmath.h>

typedef gvi_real real;
#include "problems.h"
#include "hard/extrapolate.h"

/* ---------------------------------------------------------- the problem

   L = v'Mv/2 + a(t,q)'v - V(t,q)                            and a force f
   M = constant, or the double pendulum's with relative angles
   a = (-0.4 sin(q2) cos(t), 0.3 q1^2)
   V = -g(t) (2 cos(q1) + cos(q1 + q2))      g = 1 + sin(2t)/2
   f = (-0.2 v1 + 0.3 cos(3t), -0.1 (1 + q1^2) v2)                          */
typedef struct { int moving_mass, magnetic, forced; } parts;

/* Several starts, so that no leading term is small by accident */
enum { T_END = 1, STARTS = 3 };
static const real q_start[STARTS][2] = { { 0.7L, -0.4L }, { -0.3L, 1.1L }, { 0.2L, 0.5L } };
static const real v_start[STARTS][2] = { { 0.5L, 0.9L }, { 0.8L, -0.2L }, { -0.6L, 0.4L } };
static const real constant_mass[4] = { 2, 0.5L, 0.5L, 1 };

static int magnetic_term(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    dldv[0] += -0.4L*sin(q[1])*cos(t);
    dldv[1] += 0.3L*q[0]*q[0];
    f[0] += 0.6L*q[0]*v[1];
    f[1] += -0.4L*cos(q[1])*cos(t)*v[0];
    return 0;
}

static int damping_and_drive(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] += -0.2L*v[0] + 0.3L*cos(3*t);
    f[1] += -0.1L*(1 + q[0]*q[0])*v[1];
    return 0;
}

/* ---------------------------------------------------------- the reference */

/* y = (q1, q2, p1, p2) */
static void hamilton(const parts *has, real t, const real *y, real *dy)
{
    real sum = y[0] + y[1], g = 1 + sin(2*t)/2, C = cos(y[1]), S = sin(y[1]);
    real m11 = has->moving_mass ? 3 + 2*C : 2, m12 = has->moving_mass ? 1 + C : 0.5L;
    real a1 = has->magnetic ? -0.4L*S*cos(t) : 0, a2 = has->magnetic ? 0.3L*y[0]*y[0] : 0;
    real w1 = y[2] - a1, w2 = y[3] - a2, det = m11 - m12*m12;
    real u = (w1 - m12*w2)/det, v = (m11*w2 - m12*w1)/det;

    dy[0] = u;
    dy[1] = v;
    dy[2] = -g*(2*sin(y[0]) + sin(sum));
    dy[3] = -g*sin(sum);
    if (has->moving_mass) dy[3] -= S*u*(u + v);
    if (has->magnetic) {
        dy[2] += 0.6L*y[0]*v;
        dy[3] -= 0.4L*C*cos(t)*u;
    }
    if (has->forced) {
        dy[2] += 0.3L*cos(3*t) - 0.2L*u;
        dy[3] -= 0.1L*(1 + y[0]*y[0])*v;
    }
}

static void rates(real t, const real *y, real *dy, void *has) { hamilton(has, t, y, dy); }

/* Moves y from time a to b in steps of about H */
static void reference(const parts *has, real a, real b, real H, real *y)
{
    parts copy = *has;
    const motion exact = { 4, rates, &copy };
    if (fabs(b - a) > 0) flow(&exact, a, b, H, y);
}

static const real H_REF = 1/32.0L;

static void initial_state(const parts *has, int start, real *y)
{
    const real *q = q_start[start], *v = v_start[start], C = cos(q[1]);
    real m11 = has->moving_mass ? 3 + 2*C : 2, m12 = has->moving_mass ? 1 + C : 0.5L;
    y[0] = q[0];
    y[1] = q[1];
    y[2] = m11*v[0] + m12*v[1] + (has->magnetic ? -0.4L*sin(q[1]) : 0);
    y[3] = m12*v[0] + v[1] + (has->magnetic ? 0.3L*q[0]*q[0] : 0);
}

/* The state of start `start` at t = 0, 1/SAMPLES, ..., 1 times T_END; computed once */
enum { SAMPLES = 8 };

static const real *reference_at(const parts *has, int start, int sample)
{
    static real known[STARTS][2][2][2][SAMPLES + 1][4];
    static int computed[STARTS][2][2][2];
    real (*y)[4] = known[start][has->moving_mass][has->magnetic][has->forced];
    int *done = &computed[start][has->moving_mass][has->magnetic][has->forced];
    if (!*done) {
        initial_state(has, start, y[0]);
        for (int k = 0; k < SAMPLES; ++k) {
            memcpy(y[k + 1], y[k], sizeof y[k]);
            reference(has, (real)k*T_END/SAMPLES, (real)(k + 1)*T_END/SAMPLES, H_REF, y[k + 1]);
        }
        *done = 1;
    }
    return y[sample];
}

/* The state at t, near a sample */
static void reference_near(const parts *has, int start, int sample, real t, real *y)
{
    memcpy(y, reference_at(has, start, sample), 4*sizeof(real));
    reference(has, (real)sample*T_END/SAMPLES, t, H_REF, y);
}

/* ------------------------------------------------------------- the stepper */

typedef struct { parts has; int s; gvi_rule rule; } method;

/* A stepper and what it points to */
typedef struct {
    gvi_stepper st;
    gvi_effect  effects[3];
    real        memory[12000];
} bench;

static bench the_bench;

/* Ready to step from the state y at time t */
static gvi_stepper *start_at(const method *m, real t, const real *y)
{
    bench *b = &the_bench;
    gvi_desc desc = { .n = 2, .degree = m->s, .rule = m->rule, .effects = b->effects };
    int n = 0;

    b->effects[n++] = (gvi_effect){ .kind = GVI_POTENTIAL, .point = weights, .user = b };
    if (m->has.magnetic) b->effects[n++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .point = magnetic_term };
    if (m->has.forced) b->effects[n++] = (gvi_effect){ .kind = GVI_FORCE, .point = damping_and_drive };
    desc.effect_count = n;
    if (m->has.moving_mass)
        desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = pendulum_mass,
                                .gradient = pendulum_mass_gradient };
    else
        desc.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = constant_mass };
    assert_ok(gvi_init(&b->st, &desc, b->memory, sizeof b->memory));
    assert_ok(gvi_start_momentum(&b->st, t, y, y + 2));
    return &b->st;
}

static real square_distance(const real *q, const real *p, const real *y)
{
    real sum = 0;
    for (int i = 0; i < 2; ++i) {
        sum += (q[i] - y[i])*(q[i] - y[i]);
        if (p) sum += (p[i] - y[2 + i])*(p[i] - y[2 + i]);
    }
    return sum;
}

/* ------------------------------------------------ what converges, for a slope */

typedef real error_fn(const method *m, real h);

/* q and p at T_END, root mean square over the starts */
static real end_error(const method *m, real h)
{
    int steps = (int)(T_END/h + 0.5L);
    real sum = 0;
    for (int k = 0; k < STARTS; ++k) {
        gvi_stepper *st = start_at(m, 0, reference_at(&m->has, k, 0));
        for (int j = 0; j < steps; ++j) assert_ok(gvi_step(st, (real)T_END/steps));
        sum += square_distance(st->q, st->p, reference_at(&m->has, k, SAMPLES));
    }
    return sqrt(sum/STARTS);
}

/* One step of length h, its middle at a sample, from the exact state: inside it,
   errors are local.  The middle stays where it is while h shrinks, which rids
   the error of a symmetric method of every other power.                      */
static gvi_stepper *single_step(const method *m, int start, int sample, real h)
{
    real y[4], t = (real)sample*T_END/SAMPLES - h/2;
    gvi_stepper *st;
    reference_near(&m->has, start, sample, t, y);
    st = start_at(m, t, y);
    assert_ok(gvi_step(st, h));
    return st;
}

enum { INSIDE = 12 };

/* The largest distance of the curve in a step, root mean square over steps; of
   its velocity where of_velocity                                             */
static real curve_distance(const method *m, real h, int of_velocity)
{
    real sum = 0;
    for (int j = 1; j < SAMPLES; ++j) {
        gvi_stepper *st = single_step(m, j%STARTS, j, h);
        real worst = 0;
        for (int k = 0; k <= INSIDE; ++k) {
            real tau = (real)k/INSIDE, t = (real)j*T_END/SAMPLES + (tau - 0.5L)*h, y[4], dy[4], q[2], v[2], d;
            reference_near(&m->has, j%STARTS, j, t, y);
            hamilton(&m->has, t, y, dy);
            assert_ok(gvi_curve(st, tau, q, v));
            d = of_velocity ? square_distance(v, NULL, dy) : square_distance(q, NULL, y);
            if (!(d <= worst)) worst = d;                              /* keeps NaN */
        }
        sum += worst;
    }
    return sqrt(sum/(SAMPLES - 1));
}

static real curve_error(const method *m, real h) { return curve_distance(m, h, 0); }
static real slope_error(const method *m, real h) { return curve_distance(m, h, 1); }

/* q, v and p of gvi_state_at, root mean square; not in the middle, which is as
   near to one end as to the other                                            */
static real inside_error(const method *m, real h)
{
    real sum = 0;
    for (int j = 1; j < SAMPLES; ++j) {
        gvi_stepper *st = single_step(m, j%STARTS, j, h);
        for (int k = 1; k < 4; k += 2) {
            real t = (real)j*T_END/SAMPLES + ((real)k/4 - 0.5L)*h, y[4], dy[4], q[2], v[2], p[2];
            reference_near(&m->has, j%STARTS, j, t, y);
            hamilton(&m->has, t, y, dy);
            assert_ok(gvi_state_at(st, t, q, v, p));
            sum += square_distance(q, p, y) + square_distance(v, NULL, dy);
        }
    }
    return sqrt(sum/(2*(SAMPLES - 1)));
}

/* The slope over an octave of step sizes, as late as rounding allows: the last
   error is still 50 EPS, so rounding moves the slope by a few hundredths.  The
   expected order only says where to look.  At most 64 steps: what converges
   slowly has shown its slope by then.                                        */
static real slope(error_fn *error, const method *m, real expected)
{
    real at_8 = error(m, T_END/(real)8), steps = floor(8*pow(at_8/(50*EPS), 1/expected)), e;
    if (!(steps < 64)) steps = 64;
    steps += fmod(steps, 2) + 2;
    do {
        steps -= 2;
        e = error(m, T_END/steps);
    } while (steps > 8 && !(e > 50*EPS));
    return log2(error(m, 2*T_END/steps)/e);
}

/* ------------------------------------------------------------ expectations */

static int misses;

static void expect_slope(const char *what, const method *m, error_fn *error, real lo, real hi)
{
    real got = slope(error, m, hi);
    if (lo - 0.2L <= got && got <= hi + 0.2L) return;
    ++misses;
    print_error("%s, s = %d, rule %d with %d points, M(q) %d, magnetic %d, forced %d, %s: "
                "slope %.3Lf, not within 0.2 of [%.1Lf, %.1Lf]\n", what, m->s, (int)m->rule.kind,
                m->rule.points, m->has.moving_mass, m->has.magnetic, m->has.forced,
                gvi_formulation_text(&the_bench.st), (long double)got, (long double)lo, (long double)hi);
}

static const parts conservative[] = { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
static const parts with_forces[]  = { { 0, 0, 1 }, { 0, 1, 1 }, { 1, 0, 1 }, { 1, 1, 1 } };

static int min_int(int a, int b) { return a < b ? a : b; }

typedef void expectation(const method *m, int u);

/* Every s up to 5, Gauss and Lobatto, r = s, s + 1, s + 2, each set of parts */
static void for_all(const parts *sets, int count, expectation *expect)
{
    misses = 0;
    for (int i = 0; i < count; ++i)
    for (int s = 1; s <= 5; ++s)
    for (int extra = 0; extra <= 2; ++extra)
    for (int lobatto = 0; lobatto <= 1; ++lobatto) {
        int r = s + extra;
        method m = { sets[i], s, { .kind = lobatto ? GVI_LOBATTO : GVI_GAUSS, .points = r } };
        if (lobatto && r < 2) continue;
        expect(&m, lobatto ? 2*r - 2 : 2*r);
    }
    assert_int_equal(misses, 0);
}

static void expect_step_order(const method *m, int u)
{
    real order = (real)min_int(2*m->s, u);
    expect_slope("step", m, end_error, order, order);
    assert_int_equal(the_bench.st.order, u);
}

/* A polynomial of degree s cannot be nearer than O(h^(s+1)), and O(h^s) for its
   derivative: from above, the theory is exact where u >= 2s.                 */
static void expect_curve_order(const method *m, int u)
{
    real least = min_int(2*m->s, u)/2.0L;
    expect_slope("curve", m, curve_error, least + 1, (real)m->s + 1);
    expect_slope("velocity of the curve", m, slope_error, least, (real)m->s);
}

/* One step and a partial step: one power more than the global order */
static void expect_order_inside(const method *m, int u)
{
    real order = (real)min_int(2*m->s, u) + 1;
    expect_slope("state inside a step", m, inside_error, order, order);
}

/* ------------------------------------------------------------------- tests */

TEST(the_reference_agrees_with_itself_and_with_degree_12)
{
    for (int i = 0; i < COUNT(with_forces); ++i) {
        method m = { with_forces[i], 12, { .kind = GVI_GAUSS, .points = 12 } };
        real fine[4];
        initial_state(&m.has, 0, fine);
        reference(&m.has, 0, T_END, H_REF/2, fine);
        /* roundings of t, q and p while the state moves by about 3 units */
        assert_close(sqrt(square_distance(fine, fine + 2, reference_at(&m.has, 0, SAMPLES))), 0, 10*EPS);
        assert_close(end_error(&m, (real)T_END/16), 0, 10*EPS);
    }
}

TEST(the_order_is_the_smaller_of_2s_and_u)
{
    for_all(conservative, COUNT(conservative), expect_step_order);
}

TEST(the_order_is_the_same_with_damping_and_driving)
{
    for_all(with_forces, COUNT(with_forces), expect_step_order);
}

TEST(the_curve_has_order_min_s_and_half_u_plus_one)
{
    for_all(conservative, COUNT(conservative), expect_curve_order);
    for_all(with_forces + 3, 1, expect_curve_order);
}

TEST(the_state_inside_a_step_has_the_full_order)
{
    for_all(conservative, COUNT(conservative), expect_order_inside);
    for_all(with_forces + 3, 1, expect_order_inside);
}

/* A rule of the caller and its order u by the textbook */
typedef struct { const char *name; int r, u; real c[7], b[7]; } own_rule;

#define ROOT6 2.44948974278317809819728407470589139196594748L

static const own_rule own[] = {
    { "Radau 1",    1, 1, { 1 }, { 1 } },
    { "Radau 2",    2, 3, { 1/3.0L, 1 }, { 0.75L, 0.25L } },
    { "left Radau 2", 2, 3, { 0, 2/3.0L }, { 0.25L, 0.75L } },
    { "Radau 3",    3, 5, { (4 - ROOT6)/10, (4 + ROOT6)/10, 1 },
                          { (16 - ROOT6)/36, (16 + ROOT6)/36, 1/9.0L } },
    { "Milne",      3, 4, { 0.25L, 0.5L, 0.75L }, { 2/3.0L, -1/3.0L, 2/3.0L } },
    { "three eighths", 4, 4, { 0, 1/3.0L, 2/3.0L, 1 }, { 0.125L, 0.375L, 0.375L, 0.125L } },
    { "Boole",      5, 6, { 0, 0.25L, 0.5L, 0.75L, 1 }, { 7/90.0L, 32/90.0L, 12/90.0L, 32/90.0L, 7/90.0L } },
    { "Weddle",     7, 8, { 0, 1/6.0L, 2/6.0L, 3/6.0L, 4/6.0L, 5/6.0L, 1 },
                          { 41/840.0L, 216/840.0L, 27/840.0L, 272/840.0L, 27/840.0L, 216/840.0L, 41/840.0L } },
};

/* min(2s, u), as long as u >= 2s - 2.  A rule that is weaker than that lets the
   top modes of the curve go wrong, and they take their share of the order: the
   stages of (3) satisfy the simplifying conditions C(u-s) and D(s) of Runge-Kutta
   theory, which give 2(u-s) + 2.                                             */
static int order_with_rule(int s, int u)
{
    int order = min_int(2*s, u);
    return u < 2*s - 2 ? min_int(order, 2*u - 2*s + 2) : order;
}

TEST(rules_of_the_caller_have_the_order_that_theory_says)
{
    misses = 0;
    for (int k = 0; k < COUNT(own); ++k)
    for (int s = 1; s <= min_int(own[k].r, 6); ++s)
    for (int i = 0; i < 4; ++i) {
        method m = { i < 3 ? conservative[i] : with_forces[i], s,
                     { GVI_OWN, own[k].r, own[k].c, own[k].b } };
        real order = (real)order_with_rule(s, own[k].u);
        expect_slope(own[k].name, &m, end_error, order, order);
        order = (real)(min_int(s, own[k].u - s + 1) + 1);
        expect_slope(own[k].name, &m, curve_error, order, order);
        assert_int_equal(the_bench.st.order, own[k].u);
    }
    assert_int_equal(misses, 0);
}

RUN_TESTS(NULL, NULL)
