/* The order, measured.  One problem holds everything that has ever hidden a
   wrong order: nonlinear, not separable, a mass matrix that depends on q, a
   term linear in v, every term with a clock of its own, and damping.  Parts of
   it are left out, so that each formulation gets its turn.

   The reference and the slopes are those of theorems/bench.h, in long double, so
   that rounding does not blur them. */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#define OWN_REAL
#include "gvi_test.h"
#include "theorems/bench.h"

/* L = v'Mv/2 + a(t,q)'v - V(t,q)                            and a force f
   M = constant, or the double pendulum's with relative angles
   a = (-0.4 sin(q2) cos(t), 0.3 q1^2)
   V = -g(t) (2 cos(q1) + cos(q1 + q2))      g = 1 + sin(2t)/2
   f = (-0.2 v1 + 0.3 cos(3t), -0.1 (1 + q1^2) v2) */
static const real constant_mass[4] = { 2, 0.5L, 0.5L, 1 };
static int with_time;

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

/* For the reference: M v, its inverse on p - a, and an action that no test here reads */
static void dense_kinetic(const real *q, const real *v, real *dq, real *dv)
{
    dv[0] += 2*v[0] + v[1]/2;
    dv[1] += v[0]/2 + v[1];
}

static void dense_velocity(real t, const real *q, const real *p, real *v)
{
    v[0] = (p[0] - p[1]/2)/1.75L;
    v[1] = (2*p[1] - p[0]/2)/1.75L;
}

static void without_field(real t, const real *q, const real *p, real *w)
{
    w[0] = p[0] + 0.4L*sin(q[1])*cos(t);
    w[1] = p[1] - 0.3L*q[0]*q[0];
}

static void dense_magnetic_velocity(real t, const real *q, const real *p, real *v)
{
    real w[2];
    without_field(t, q, p, w);
    dense_velocity(t, q, w, v);
}

static void pendulum_magnetic_velocity(real t, const real *q, const real *p, real *v)
{
    real w[2];
    without_field(t, q, p, w);
    pendulum_velocity(t, q, w, v);
}

static real no_action(real t, const real *q, const real *v) { return 0; }

#define DENSE    { .kind = GVI_MASS_DENSE, .matrix = constant_mass }
#define PENDULUM { .kind = GVI_MASS_POSITION, .points = pendulum_mass, .gradient = pendulum_mass_gradient }
#define SWAYING  { .kind = GVI_POTENTIAL, .point = weights, .user = &with_time }
#define MAGNETIC { .kind = GVI_LAGRANGIAN, .point = magnetic_term }
#define DAMPED   { .kind = GVI_FORCE, .point = damping_and_drive }

#define STATES   PENDULUM_START_STATES, 1

enum { CONSERVATIVE = 4, ALL_PARTS = 7, SETS = 8 };

static const problem sets[SETS] = {
    { "dense", 2, DENSE, { SWAYING }, 1, 0, no_action, dense_kinetic, dense_velocity, STATES },
    { "dense, magnetic", 2, DENSE, { SWAYING, MAGNETIC }, 2, 0,
      no_action, dense_kinetic, dense_magnetic_velocity, STATES },
    { "M(q)", 2, PENDULUM, { SWAYING }, 1, 0, no_action, pendulum_kinetic, pendulum_velocity, STATES },
    { "M(q), magnetic", 2, PENDULUM, { SWAYING, MAGNETIC }, 2, 0,
      no_action, pendulum_kinetic, pendulum_magnetic_velocity, STATES },
    { "dense, forced", 2, DENSE, { SWAYING, DAMPED }, 2, 1, no_action, dense_kinetic, dense_velocity, STATES },
    { "dense, magnetic, forced", 2, DENSE, { SWAYING, MAGNETIC, DAMPED }, 3, 1,
      no_action, dense_kinetic, dense_magnetic_velocity, STATES },
    { "M(q), forced", 2, PENDULUM, { SWAYING, DAMPED }, 2, 1,
      no_action, pendulum_kinetic, pendulum_velocity, STATES },
    { "M(q), magnetic, forced", 2, PENDULUM, { SWAYING, MAGNETIC, DAMPED }, 3, 1,
      no_action, pendulum_kinetic, pendulum_magnetic_velocity, STATES },
};

static real norm_error(const problem *pb, const method *m, real h, int which)
{
    real norm[NORMS];
    curve_norms(pb, m, h, OF_THE_STEP, norm);
    return norm[which];
}

static real curve_error(const problem *pb, const method *m, real h) { return norm_error(pb, m, h, 0); }
/* q, v and p of gvi_state_at in one exact step, root mean square; not in the middle,
   which is as near to one end as to the other */
static real inside_error(const problem *pb, const method *m, real h)
{
    real sum = 0, t0 = step_time(pb, h);
    for (int start = 0; start < STARTS; ++start)
        for (int k = 1; k < 4; k += 2) {
            real y[MAX_Y], dy[MAX_Y], end[MAX_Y], q[2], v[2], p[2];
            exact_step(pb, start, h, y, end);
            gvi_stepper *st = bench(pb, m, t0, y);
            if (gvi_step(st, h) != GVI_OK || gvi_state_at(st, t0 + k*h/4, q, v, p) != GVI_OK) return (real)NAN;
            flow_of(pb, t0, t0 + k*h/4, y);
            rates(pb, t0 + k*h/4, y, dy);
            sum += square_distance(2, q, y) + square_distance(2, p, y + 2) + square_distance(2, v, dy);
        }
    return sqrt(sum/(2*STARTS));
}

static int misses;

static void expect_slope(const char *what, const problem *pb, const method *m, error_fn *error, real lo, real hi)
{
    real got = slope(error, pb, m, hi, 32);
    if (lo - 0.2L <= got && got <= hi + 0.2L) return;
    ++misses;
    print_error("%s, %s, s = %d, rule %d with %d points, %s: slope %.3Lf, not within 0.2 of [%.1Lf, %.1Lf]\n",
                what, pb->name, m->s, (int)m->rule.kind, m->rule.points, gvi_formulation_text(&bench_stepper),
                (long double)got, (long double)lo, (long double)hi);
}

static int min_int(int a, int b) { return a < b ? a : b; }

typedef void expectation(const problem *pb, const method *m, int u);

/* Every s up to 5, Gauss and Lobatto, r = s, s + 1, s + 2, sets first to last */
static void for_all(int first, int last, expectation *expect)
{
    misses = 0;
    for (int i = first; i <= last; ++i)
    for (int s = 1; s <= 5; ++s)
    for (int extra = 0; extra <= 2; ++extra)
    for (int lobatto = 0; lobatto <= 1; ++lobatto) {
        int r = s + extra;
        method m = { s, { .kind = lobatto ? GVI_LOBATTO : GVI_GAUSS, .points = r } };
        if (lobatto && r < 2) continue;
        expect(&sets[i], &m, lobatto ? 2*r - 2 : 2*r);
    }
    assert_int_equal(misses, 0);
}

static void expect_step_order(const problem *pb, const method *m, int u)
{
    real order = (real)min_int(2*m->s, u);
    expect_slope("step", pb, m, end_error, order, order);
    assert_int_equal(bench_stepper.order, u);
}

/* One step and a partial step: one power more than the global order */
static void expect_order_inside(const problem *pb, const method *m, int u)
{
    real order = (real)min_int(2*m->s, u) + 1;
    expect_slope("state inside a step", pb, m, inside_error, order, order);
}

TEST(the_reference_agrees_with_itself_and_with_degree_12)
{
    for (int i = CONSERVATIVE; i < SETS; ++i) {
        const method m = { 12, { .kind = GVI_GAUSS, .points = 12 } };
        real fine[MAX_Y];
        start_state(&sets[i], 0, fine);
        flow_with(&sets[i], 0, sets[i].time, 1/64.0L, fine);
        /* roundings of t, q and p while the state moves by about 3 units */
        assert_close(sqrt(square_distance(4, fine, run_state(&sets[i], 0, 1))), 0, 20*EPS);
        assert_close(end_error(&sets[i], &m, 1/16.0L), 0, 20*EPS);
    }
}

TEST(the_order_is_the_smaller_of_2s_and_u) { for_all(0, CONSERVATIVE - 1, expect_step_order); }
TEST(the_order_is_the_same_with_damping_and_driving) { for_all(CONSERVATIVE, SETS - 1, expect_step_order); }

TEST(the_state_inside_a_step_has_the_full_order)
{
    for_all(0, CONSERVATIVE - 1, expect_order_inside);
    for_all(ALL_PARTS, ALL_PARTS, expect_order_inside);
}

/* Rules of the caller, and their order u by the textbook */
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

TEST(rules_of_the_caller_have_the_order_that_theory_says)
{
    static const int which[] = { 0, 1, 2, ALL_PARTS };
    misses = 0;
    for (int k = 0; k < COUNT(own); ++k)
    for (int s = 1; s <= min_int(own[k].r, 6); ++s)
    for (int i = 0; i < COUNT(which); ++i) {
        const method m = { s, { GVI_OWN, own[k].r, own[k].c, own[k].b } };
        real order = (real)order_expected(s, own[k].u);
        expect_slope(own[k].name, &sets[which[i]], &m, end_error, order, order);
        order = (real)(min_int(s, own[k].u - s + 1) + 1);
        expect_slope(own[k].name, &sets[which[i]], &m, curve_error, order, order);
        assert_int_equal(bench_stepper.order, own[k].u);
    }
    assert_int_equal(misses, 0);
}

RUN_TESTS(NULL, NULL)
