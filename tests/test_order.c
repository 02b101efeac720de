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

/* ---------------------------------------------------------- the problem

   L = v'Mv/2 + a(t,q)'v - V(t,q)                            and a force f
   M = constant, or the double pendulum's with relative angles
   a = (-0.4 sin(q2) cos(t), 0.3 q1^2)
   V = -g(t) (2 cos(q1) + cos(q1 + q2))      g = 1 + sin(2t)/2
   f = (-0.2 v1 + 0.3 cos(3t), -0.1 (1 + q1^2) v2)                          */
typedef struct { int moving_mass, magnetic, forced; } parts;

enum { T_END = 1 };
static const real q_start[2] = { 0.7L, -0.4L }, v_start[2] = { 0.5L, 0.9L };
static const real constant_mass[4] = { 2, 0.5L, 0.5L, 1 };

static real gravity(real t) { return 1 + sin(2*t)/2; }

static int pendulum_force(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    real both = gravity(t)*sin(q[0] + q[1]);
    (void)v; (void)dldv; (void)user;
    f[0] -= 2*gravity(t)*sin(q[0]) + both;
    f[1] -= both;
    return 0;
}

static int magnetic_term(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    (void)user;
    dldv[0] += -0.4L*sin(q[1])*cos(t);
    dldv[1] += 0.3L*q[0]*q[0];
    f[0] += 0.6L*q[0]*v[1];
    f[1] += -0.4L*cos(q[1])*cos(t)*v[0];
    return 0;
}

static int damping_and_drive(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    (void)dldv; (void)user;
    f[0] += -0.2L*v[0] + 0.3L*cos(3*t);
    f[1] += -0.1L*(1 + q[0]*q[0])*v[1];
    return 0;
}

static int pendulum_mass(const gvi_points *x, void *user)
{
    int N = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        real c = cos(x->q[N + k]);
        x->mass[0*N + k] = 3 + 2*c;
        x->mass[2*N + k] = 1 + c;
        x->mass[3*N + k] = 1;
    }
    return 0;
}

/* v' dM/dq2 v / 2; M does not depend on q1 */
static int pendulum_mass_gradient(const gvi_points *x, void *user)
{
    int N = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k)
        x->f[N + k] -= sin(x->q[N + k])*x->v[k]*(x->v[k] + x->v[N + k]);
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

/* Gragg's modified midpoint rule: n substeps, an expansion in even powers of
   H/n.  Increments throughout, so that rounding is relative to them.          */
static void gragg(const parts *has, real t, real H, int n, const real *y, real *out)
{
    real a[4] = { 0 }, b[4], d[4], x[4], h = H/n;
    hamilton(has, t, y, d);
    for (int i = 0; i < 4; ++i) b[i] = h*d[i];
    for (int k = 1; k <= n; ++k) {
        for (int i = 0; i < 4; ++i) x[i] = y[i] + b[i];
        hamilton(has, t + k*h, x, d);
        if (k == n) break;
        for (int i = 0; i < 4; ++i) { real next = a[i] + 2*h*d[i]; a[i] = b[i]; b[i] = next; }
    }
    for (int i = 0; i < 4; ++i) out[i] = (a[i] + b[i] + h*d[i])/2;
}

enum { COLUMNS = 7 };                                        /* order 14 */

/* The increment of one step by Neville's scheme in h^2.  Bulirsch's sequence
   has small weights: rounding is not amplified.                              */
static void extrapolate(const parts *has, real t, real H, const real *y, real *increment)
{
    static const int substeps[COLUMNS] = { 2, 4, 6, 8, 12, 16, 24 };
    real table[COLUMNS][4];
    for (int j = 0; j < COLUMNS; ++j) {
        gragg(has, t, H, substeps[j], y, table[j]);
        for (int k = j; k-- > 0; ) {
            real ratio = (real)substeps[j]/(real)substeps[k], w = 1/(ratio*ratio - 1);
            for (int i = 0; i < 4; ++i) table[k][i] = table[k + 1][i] + w*(table[k + 1][i] - table[k][i]);
        }
    }
    memcpy(increment, table[0], sizeof table[0]);
}

/* Moves y from time a to b in steps of about H, with Kahan's summation */
static void reference(const parts *has, real a, real b, real H, real *y)
{
    int n = (int)ceil(fabs(b - a)/H);
    real low[4] = { 0 };
    for (int k = 0; k < n; ++k) {
        real d[4];
        extrapolate(has, a + (b - a)*k/n, (b - a)/n, y, d);
        for (int i = 0; i < 4; ++i) {
            real sum, x = d[i] + low[i];
            sum = y[i] + x;
            low[i] = x - (sum - y[i]);
            y[i] = sum;
        }
    }
}

static const real H_REF = 1/32.0L;

static void initial_state(const parts *has, real *y)
{
    real C = cos(q_start[1]);
    real m11 = has->moving_mass ? 3 + 2*C : 2, m12 = has->moving_mass ? 1 + C : 0.5L;
    y[0] = q_start[0];
    y[1] = q_start[1];
    y[2] = m11*v_start[0] + m12*v_start[1] + (has->magnetic ? -0.4L*sin(q_start[1]) : 0);
    y[3] = m12*v_start[0] + v_start[1] + (has->magnetic ? 0.3L*q_start[0]*q_start[0] : 0);
}

static void reference_at(const parts *has, real t, real *y)
{
    initial_state(has, y);
    reference(has, 0, t, H_REF, y);
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

static gvi_stepper *set_up(const method *m)
{
    bench *b = &the_bench;
    gvi_desc desc = { .n = 2, .degree = m->s, .rule = m->rule, .effects = b->effects };
    real y[4];
    int n = 0;

    b->effects[n++] = (gvi_effect){ .kind = GVI_POTENTIAL, .point = pendulum_force };
    if (m->has.magnetic) b->effects[n++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .point = magnetic_term };
    if (m->has.forced) b->effects[n++] = (gvi_effect){ .kind = GVI_FORCE, .point = damping_and_drive };
    desc.effect_count = n;
    if (m->has.moving_mass)
        desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = pendulum_mass,
                                .gradient = pendulum_mass_gradient };
    else
        desc.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = constant_mass };
    assert_ok(gvi_init(&b->st, &desc, b->memory, sizeof b->memory));
    initial_state(&m->has, y);
    assert_ok(gvi_start_momentum(&b->st, 0, y, y + 2));
    return &b->st;
}

static real largest(real a, real b) { return !(b <= a) ? b : a; }       /* keeps NaN */

static real distance(const real *q, const real *p, const real *y)
{
    real d = 0;
    for (int i = 0; i < 2; ++i) {
        if (q) d = largest(d, fabs(q[i] - y[i]));
        if (p) d = largest(d, fabs(p[i] - y[2 + i]));
    }
    return d;
}

static gvi_stepper *run(const method *m, int steps)
{
    gvi_stepper *st = set_up(m);
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(st, (real)T_END/steps));
    return st;
}

/* ------------------------------------------------ what converges, for a slope */

typedef real error_fn(const method *m, int steps);

/* q and p at T_END */
static real end_error(const method *m, int steps)
{
    gvi_stepper *st = run(m, steps);
    real y[4];
    reference_at(&m->has, T_END, y);
    return distance(st->q, st->p, y);
}

enum { CURVE_POINTS = 16 };

/* q of the curve inside the last step, or v where of_velocity */
static real curve_distance(const method *m, int steps, int of_velocity)
{
    gvi_stepper *st = run(m, steps);
    real y[4], dy[4], q[2], v[2], h = (real)T_END/steps, d = 0;
    for (int k = 0; k <= CURVE_POINTS; ++k) {
        real tau = (real)k/CURVE_POINTS;
        reference_at(&m->has, T_END - h*(1 - tau), y);
        hamilton(&m->has, T_END - h*(1 - tau), y, dy);
        assert_ok(gvi_curve(st, tau, q, v));
        d = largest(d, of_velocity ? distance(v, NULL, dy) : distance(q, NULL, y));
    }
    return d;
}

static real curve_error(const method *m, int steps) { return curve_distance(m, steps, 0); }
static real slope_error(const method *m, int steps) { return curve_distance(m, steps, 1); }

/* The state inside the very first step: its whole error is local */
static real inside_error(const method *m, int steps)
{
    gvi_stepper *st = set_up(m);
    real y[4], dy[4], q[2], v[2], p[2], h = (real)T_END/steps, d = 0;
    assert_ok(gvi_step(st, h));
    for (int k = 1; k < 4; ++k) {
        reference_at(&m->has, h*k/4, y);
        hamilton(&m->has, h*k/4, y, dy);
        assert_ok(gvi_state_at(st, h*k/4, q, v, p));
        d = largest(d, distance(q, p, y));
        d = largest(d, distance(v, NULL, dy));
    }
    return d;
}

/* The slope where it is cleanest: between the last two of a sequence of
   halved steps that ends before rounding is felt.                            */
static real slope(error_fn *error, const method *m)
{
    real floor_ = 100*EPS, before = error(m, 4), now = error(m, 8);
    for (int steps = 16; steps <= 512; steps *= 2) {
        real next = error(m, steps);
        if (!(next > floor_)) break;
        before = now;
        now = next;
    }
    return log2(before/now);
}

/* ------------------------------------------------------------ expectations */

static int misses;

static void expect_slope(const char *what, const method *m, error_fn *error, real lo, real hi)
{
    real got = slope(error, m);
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

static void the_reference_agrees_with_itself_and_with_degree_12(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(with_forces); ++i) {
        method m = { with_forces[i], 12, { .kind = GVI_GAUSS, .points = 12 } };
        real coarse[4], fine[4];
        initial_state(&m.has, fine);
        reference_at(&m.has, T_END, coarse);
        reference(&m.has, 0, T_END, H_REF/2, fine);
        /* roundings of t, q and p while the state moves by about 3 units */
        assert_close(distance(coarse, coarse + 2, fine), 0, 10*EPS);
        assert_close(end_error(&m, 16), 0, 10*EPS);
    }
}

static void the_order_is_the_smaller_of_2s_and_u(void **state)
{
    (void)state;
    for_all(conservative, COUNT(conservative), expect_step_order);
}

static void the_order_is_the_same_with_damping_and_driving(void **state)
{
    (void)state;
    for_all(with_forces, COUNT(with_forces), expect_step_order);
}

static void the_curve_has_order_min_s_and_half_u_plus_one(void **state)
{
    (void)state;
    for_all(conservative, COUNT(conservative), expect_curve_order);
    for_all(with_forces + 3, 1, expect_curve_order);
}

static void the_state_inside_a_step_has_the_full_order(void **state)
{
    (void)state;
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

/* Every degree that the rule's points allow; above 5 the slopes would need more
   digits than there are.                                                     */
static void rules_of_the_caller_have_the_order_min_2s_u(void **state)
{
    (void)state;
    misses = 0;
    for (int k = 0; k < COUNT(own); ++k)
    for (int s = 1; s <= min_int(own[k].r, 5); ++s)
    for (int i = 0; i < 4; ++i) {
        method m = { i < 3 ? conservative[i] : with_forces[i], s,
                     { GVI_OWN, own[k].r, own[k].c, own[k].b } };
        real order = (real)min_int(2*s, own[k].u);
        expect_slope(own[k].name, &m, end_error, order, order);
        assert_int_equal(the_bench.st.order, own[k].u);
    }
    assert_int_equal(misses, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_reference_agrees_with_itself_and_with_degree_12),
        cmocka_unit_test(the_order_is_the_smaller_of_2s_and_u),
        cmocka_unit_test(the_order_is_the_same_with_damping_and_driving),
        cmocka_unit_test(the_curve_has_order_min_s_and_half_u_plus_one),
        cmocka_unit_test(the_state_inside_a_step_has_the_full_order),
        cmocka_unit_test(rules_of_the_caller_have_the_order_min_2s_u),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
