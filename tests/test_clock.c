/* GVI_CLOCK: time that runs as dt = g(q) dtau.  Order and structure on four scenes,
   against extrapolation of g times Hamilton's equations; then eccentric orbits
   against Kepler's equation, which no fixed step can follow. */
#include "gvi_test.h"
#include <time.h>

#include "problems.h"
#include "hard/extrapolate.h"

/* Each with two degrees of freedom: forces of its effects, the velocity that
   belongs to p, and a clock. */

typedef enum scene_name { KEPLER, PENDULUM, MAGNETIC, FORCED, SCENES } scene_name;
/* g = |q|^a at the centre's distance, a from `user` */
GVI_EACH(distance_clock, 2, f, value)
{
    const real a = *(const real *)user, d2 = x->q[0]*x->q[0] + x->q[1]*x->q[1], d = sqrt(d2);
    const real g = a > 1 ? d*sqrt(d) : d, w = a*g/d2;
    x->value[0] += g;
    x->f[0] += w*x->q[0];
    x->f[1] += w*x->q[1];
}

/* g = exp(sin(q1 + 2 q2)/2) */
static void smooth_clock_at(const real *q, real *g, real *dg)
{
    const real c = cos(q[0] + 2*q[1])/2;
    *g = exp(sin(q[0] + 2*q[1])/2);
    dg[0] = *g*c;
    dg[1] = *g*c*2;
}

GVI_EACH(smooth_clock, 2, f, value)
{
    real g, dg[2], q[2] = { x->q[0], x->q[1] };
    smooth_clock_at(q, &g, dg);
    x->value[0] += g;
    x->f[0] += dg[0];
    x->f[1] += dg[1];
}

/* The gradient's share of f, and nothing else to add to: the level that a clock sums is not its business. */
AT_POINTS(only_f)
{
    assert_null(x->dldv);
    assert_null(x->value);
    return pendulum_mass_gradient(x, user);
}

AT_POINT(push)
{
    f[0] -= v[0]/4 - cos(3*t)/2;
    f[1] -= v[1]/4 + sin(2*t)/3;
    return 0;
}

static const real dense[4] = { 2, 0.5, 0.5, 1 };
static real power_one = 1, power_more = 1.5;

/* dq/dt and dp/dt at (t, q, p), physical time */
static void motion_at(scene_name a, real t, const real *y, real *dy)
{
    const real *q = y, *p = y + 2, c = cos(q[1]);
    real m[3] = { dense[0], dense[1], dense[3] }, b[2] = { p[0], p[1] }, *f = dy + 2, unused[2] = { 0, 0 };
    if (a == KEPLER) m[0] = m[2] = 1, m[1] = 0;
    if (a == PENDULUM) m[0] = 3 + 2*c, m[1] = 1 + c, m[2] = 1;
    if (a == MAGNETIC) b[0] += q[1]*(1 + q[0]*q[0])/2, b[1] -= q[0]/2;
    const real det = m[0]*m[2] - m[1]*m[1], d = hypot(q[0], q[1]);
    dy[0] = (m[2]*b[0] - m[1]*b[1])/det;
    dy[1] = (m[0]*b[1] - m[1]*b[0])/det;
    f[0] = f[1] = 0;
    if (a == KEPLER) f[0] = -q[0]/(d*d*d), f[1] = -q[1]/(d*d*d);
    else weights(t, q, dy, f, NULL, NULL);
    if (a == PENDULUM) f[1] -= sin(q[1])*dy[0]*(dy[0] + dy[1]);
    if (a == MAGNETIC) field(t, q, dy, f, unused, NULL);
    if (a == FORCED) push(t, q, dy, f, NULL, NULL);
}

static void by_time(real t, const real *y, real *dy, void *user) { motion_at(*(scene_name *)user, t, y, dy); }

/* y = (q, p, t), by tau */
static void by_tau(real tau, const real *y, real *dy, void *user)
{
    real g = hypot(y[0], y[1]), dg[2];
    if (*(scene_name *)user != KEPLER) smooth_clock_at(y, &g, dg);
    motion_at(*(scene_name *)user, y[4], y, dy);
    for (int i = 0; i < 4; ++i) dy[i] *= g;
    dy[4] = g;
}

static gvi_desc describe(scene_name a, int s)
{
    static const gvi_effect kepler[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                         { .kind = GVI_CLOCK, .points = distance_clock,
                                           .user = &power_one } };
    static const gvi_effect others[] = { { .kind = GVI_POTENTIAL, .point = weights, .value = weights_value },
                                         { .kind = GVI_CLOCK, .points = smooth_clock },
                                         { .kind = GVI_LAGRANGIAN, .point = field, .value = field_value } };
    static const gvi_effect forced[] = { { .kind = GVI_FORCE, .point = push },
                                         { .kind = GVI_POTENTIAL, .point = weights, .value = weights_value },
                                         { .kind = GVI_CLOCK, .points = smooth_clock } };
    gvi_desc desc = { .n = 2, .degree = s, .effects = a == KEPLER ? kepler : a == FORCED ? forced : others,
                      .effect_count = a == MAGNETIC || a == FORCED ? 3 : 2 };
    if (a == PENDULUM)
        desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = pendulum_mass, .gradient = only_f };
    else if (a != KEPLER) desc.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = dense };
    return desc;
}

static const real start[4] = { 0.7, -0.4, 0.6, 1.1 };         /* q, p; an ellipse for KEPLER too */
static real memory[6000], more[6000];

static gvi_stepper *set_up(gvi_stepper *st, const gvi_desc *desc, real *where)
{
    *st = new_stepper(desc);
    return st;
}

static gvi_stepper *begin(gvi_stepper *st, scene_name a, int s, const real *y)
{
    const gvi_desc desc = describe(a, s);
    set_up(st, &desc, memory);
    assert_int_equal(st->formulation, GVI_MOMENTA);
    assert_ok(gvi_start_momentum(st, 0, y, y + 2));
    return st;
}

/* The effects of a description, to be changed; and without the clock, which was at the place that is returned */
static gvi_effect *own_effects(gvi_desc *desc)
{
    static gvi_effect own[3];
    memcpy(own, desc->effects, (size_t)desc->effect_count*sizeof own[0]);
    desc->effects = own;
    return own;
}

static int drop_clock(gvi_desc *desc)
{
    static gvi_effect rest[3];
    int n = 0, at = 0;
    for (int e = 0; e < desc->effect_count; ++e)
        if (desc->effects[e].kind == GVI_CLOCK) at = e;
        else rest[n++] = desc->effects[e];
    desc->effects = rest;
    desc->effect_count = n;
    desc->formulation = GVI_MOMENTA;
    return at;
}

/* Two descriptions that are to move alike, from the same state */
static void begin_both(gvi_stepper *x, const gvi_desc *one, gvi_stepper *y, const gvi_desc *other)
{
    set_up(x, one, memory);
    set_up(y, other, more);
    assert_ok(gvi_start_momentum(x, 0, start, start + 2));
    assert_ok(gvi_start_momentum(y, 0, start, start + 2));
}

static real distance(const real *q, const real *p, const real *y)
{
    return hypot(hypot(q[0] - y[0], q[1] - y[1]), hypot(p[0] - y[2], p[1] - y[3]));
}

typedef struct errors { real state, time, inside; } errors;

/* After N steps to tau = 2: the state, the time, and the state at a wanted time in
   the last step, at 3/8 of it */
static errors errors_of(scene_name a, int s, int N)
{
    const motion transformed = { 5, by_tau, &a }, physical = { 4, by_time, &a };
    real y[5] = { start[0], start[1], start[2], start[3], 0 }, z[4], q[2], p[2], before = 0;
    gvi_stepper st;
    begin(&st, a, s, start);
    for (int k = 0; k < N; ++k) {
        before = st.t;
        assert_ok(gvi_step(&st, (real)2/(real)N));
    }
    const real wanted = before + (st.t - before)*3/8;
    errors e;
    flow(&transformed, 0, 2, (real)0.0625, y);
    memcpy(z, start, sizeof z);
    flow(&physical, 0, wanted, (real)0.0625, z);
    e.state = distance(st.q, st.p, y);
    e.time = fabs(st.t - y[4]);
    assert_ok(gvi_state_at(&st, wanted, q, NULL, p));
    e.inside = distance(q, p, z);
    return e;
}

/* Errors between 1e-2 and 1e-12; the smallest slope of a few belongs to coarse steps.
   An error that happens to pass through zero may fall faster, by less than one. */
TEST(the_order_is_twice_the_degree)
{
    static const int steps[SCENES][5] = { { 0, 32, 10, 5, 3 }, { 0, 64, 32, 48, 34 },
                                          { 0, 32, 10, 5, 5 }, { 0, 32, 10, 6, 8 } };
    for (int a = KEPLER; a < SCENES; ++a)
    for (int s = 1; s <= 4; ++s) {
        const int N = steps[a][s];
        const errors e = errors_of((scene_name)a, s, 2*N), f = errors_of((scene_name)a, s, 4*N);
        const real by_state = log2(e.state/f.state), by_time_too = log2(e.time/f.time);
        const real inside = log2(e.inside/f.inside);
        assert_true(f.state > 50*EPS);
        assert_between(2*s - 0.3, by_state, 2*s + 0.4);
        assert_between(2*s - 0.3, by_time_too, 2*s + 0.9);
        assert_between(2*s - 0.4, inside, 2*s + 0.4);
    }
}

/* With t0 fixed and E = H at the start, one step to (q, p, t) keeps dq^dp + dE^dt:
   the extended phase space's form.  M: derivatives of q, p, t, E by the start */
static real defect_of(scene_name a, int s, int extended)
{
    static const real weight[4] = { (real)(4/5.0L), (real)(-1/5.0L), (real)(4/105.0L), (real)(-1/280.0L) };
    const real delta = pow((real)EPS, 1/(real)9)/4;
    real M[6][4] = { { 0 } }, worst = 0;
    for (int j = 0; j < 4; ++j)
        for (int k = -4; k <= 4; ++k) {
            gvi_stepper st;
            real x[4], E = 0;
            if (k == 0) continue;
            memcpy(x, start, sizeof x);
            x[j] = start[j] + (real)k*delta;
            begin(&st, a, s, x);
            assert_ok(gvi_energy(&st, &E));
            assert_ok(gvi_step(&st, (real)0.125));
            const real y[6] = { st.q[0], st.q[1], st.p[0], st.p[1], st.t, E };
            for (int i = 0; i < 6; ++i) M[i][j] += (k < 0 ? -1 : 1)*weight[abs(k) - 1]/delta*y[i];
        }
    for (int j = 0; j < 4; ++j)
    for (int k = 0; k < 4; ++k) {
        real sum = k == j + 2 ? -1 : j == k + 2 ? 1 : 0;
        for (int i = 0; i < 2; ++i) sum += M[i][j]*M[i + 2][k] - M[i + 2][j]*M[i][k];
        if (extended) sum += M[5][j]*M[4][k] - M[5][k]*M[4][j];
        worst = fmax(worst, isnan(sum) ? (real)INFINITY : fabs(sum));
    }
    return worst;
}

/* Differences of order 8 as in test_structure; without dE^dt the form is missed by far,
   and drag shrinks it by about h/4 */
TEST(the_map_is_symplectic)
{
    const real bound = 200*pow((real)EPS, 8/(real)9);
    for (int a = KEPLER; a < FORCED; ++a)
    for (int s = 1; s <= 5; s += 2) {
        assert_between(0, defect_of((scene_name)a, s, 1), bound);
        assert_between(1e-3, defect_of((scene_name)a, s, 0), 10);
    }
    assert_between(1e-3, defect_of(FORCED, 3, 1), 1);
}

/* The energy stays on the level it started from: within truncation for ever, which is
   shown by what it is over the second half against the first; and to rounding at a
   high degree.  The pendulum swings gently: a chaotic orbit is another one with every
   rounding, and its halves differ by more than a drift would make them */
TEST(the_energy_keeps_to_its_level)
{
    static const real gentle[4] = { 0.2, -0.1, 0.1, 0.2 };
    for (int a = KEPLER; a < FORCED; ++a)
    for (int s = 2; s <= 8; s += 6) {
        gvi_stepper st;
        real E0, E, worst[2] = { 0, 0 };
        begin(&st, (scene_name)a, s, a == PENDULUM ? gentle : start);
        assert_ok(gvi_energy(&st, &E0));
        for (int k = 0; k < 20000; ++k) {
            assert_ok(gvi_step(&st, (real)(s == 2 ? 0.1 : 0.03)));
            assert_ok(gvi_energy(&st, &E));
            worst[k/10000] = fmax(worst[k/10000], fabs(E - E0));
        }
        if (s == 2) assert_between(0.7, worst[1]/worst[0], 1.4);
        else assert_between(0, worst[1], 40*EPS);
    }
}

GVI_EACH(constant_clock, 1, value) { x->value[0] += *(const real *)user; }

/* An orbit of eccentricity 0.9: a rounding of p or q at each step moves q x p by EPS/2
   of |q||dp| + |p||dq| < 2; four standard deviations */
TEST(angular_momentum_is_constant)
{
    const gvi_desc desc = describe(KEPLER, 8);
    gvi_stepper st;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start(&st, 0, (const real[]){ (real)0.1, 0 }, (const real[]){ 0, sqrt((real)19) }));
    check_angular_momentum(&st, 20000, (real)0.08, 4);
}

/* g = c is nothing but a step of c h.  The scene is regular: roundings of 200 steps
   part the two by their sum at most */
TEST(a_constant_clock_is_a_longer_step)
{
    real c = (real)0.3;
    for (int a = PENDULUM; a < SCENES; ++a) {
        gvi_desc with = describe((scene_name)a, 5), without = with;
        gvi_stepper x, y;
        gvi_effect *const clock = own_effects(&with) + drop_clock(&without);
        clock->points = constant_clock;
        clock->user = &c;
        begin_both(&x, &with, &y, &without);
        for (int k = 0; k < 200; ++k) {
            assert_ok(gvi_step(&x, (real)0.25));
            assert_ok(gvi_step(&y, (real)0.25*c));
        }
        assert_close(x.t, y.t, 8*EPS*fabs(y.t));
        assert_between(0, distance(x.q, x.p, (const real[]){ y.q[0], y.q[1], y.p[0], y.p[1] }), 200*EPS);
    }
}

/* 100,000 times the same increment: added plainly, 0.1 is wrong by 1.9e-8 after them */
TEST(time_is_added_up_with_compensation)
{
    real c = (real)0.1;
    const gvi_effect clock[] = { { .kind = GVI_CLOCK, .points = constant_clock, .user = &c } };
    const gvi_desc desc = { .n = 1, .degree = 2, .effects = clock, .effect_count = 1 };
    gvi_stepper st;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start(&st, 0, (const real[]){ 0 }, (const real[]){ 1 }));
    for (int k = 0; k < 100000; ++k) assert_ok(gvi_step(&st, 1));
    assert_close(st.t, 100000*(long double)c, 2*EPS*st.t);
    assert_close(st.q[0], 100000*(long double)c, 2*EPS*st.t);
}

/* z'' = (i f - 1) z: z = exp(i t + f t/2) for small f, the angle is t.  Each step does the work EPS/4: without the
   compensation of the energy none is added, and H - E at the end, 5000 EPS, has turned z by 3e6 EPS. */
GVI_EACH(disk, 2, f, value)
{
    for (int i = 0; i < 2; ++i) x->f[i] -= x->q[i], x->value[0] += x->q[i]*x->q[i]/2;
}
GVI_EACH(disk_clock, 2, f, value)
{
    x->value[0] += (1 + x->q[0]*x->q[0] + x->q[1]*x->q[1])/4;
    for (int i = 0; i < 2; ++i) x->f[i] += x->q[i]/2;
}
GVI_EACH(disk_push, 2, f)
{
    x->f[0] -= 2*EPS*x->q[1];
    x->f[1] += 2*EPS*x->q[0];
}

TEST(work_is_added_up_with_compensation)
{
    const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = disk, .value = disk },
                                   { .kind = GVI_CLOCK, .points = disk_clock }, { .kind = GVI_FORCE, .points = disk_push } };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = effects, .effect_count = 3 };
    gvi_stepper st;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start(&st, 0, (const real[]){ 1, 0 }, (const real[]){ 0, 1 }));
    for (int k = 0; k < 20000; ++k) assert_ok(gvi_step(&st, (real)0.25));
    const long double turn = atan2l(st.q[1], st.q[0]) - (long double)st.t;
    assert_close(remainderl(turn, 2*acosl(-1)), 0, 3e5L*EPS);
}

TEST(a_clock_that_is_off_is_as_if_it_were_not_listed)
{
    for (int a = KEPLER; a < SCENES; ++a) {
        const gvi_desc with = describe((scene_name)a, 4);
        gvi_desc without = with;
        gvi_stepper x, y;
        const int clock = drop_clock(&without);
        begin_both(&x, &with, &y, &without);
        assert_ok(gvi_switch(&x, clock, 0));
        const unsigned long long asked = x.counters.effect[clock];
        assert_ok(gvi_start_momentum(&x, 0, start, start + 2));
        move_alike(&x, &y, 50, (real)0.0625);
        assert_int_equal(x.counters.effect[clock], asked);

        // on again: the level is that of the energy now
        real E0, E;
        assert_ok(gvi_switch(&x, clock, 1));
        assert_ok(gvi_energy(&x, &E0));
        for (int k = 0; k < 50; ++k) assert_ok(gvi_step(&x, (real)0.0625));
        assert_ok(gvi_energy(&x, &E));
        if (a != FORCED) assert_close(E, E0, 1e-7);
        assert_true(x.counters.effect[clock] > asked);
    }
}

/* Queries about a step are of its own measure of time, and of the effects that are on now */
TEST(switching_beside_a_clock_does_not_confuse_the_last_step)
{
    enum { ATTRACTION, CLOCK };
    gvi_stepper st;
    real before[4], after[4], q[2], p[2], number = 7;
    begin(&st, KEPLER, 4, start);
    assert_ok(gvi_step(&st, (real)0.125));
    assert_ok(gvi_curve(&st, (real)0.25, before, before + 2));

    // without attraction the first quarter is a straight line
    assert_ok(gvi_switch(&st, ATTRACTION, 0));
    assert_ok(gvi_state_at(&st, st.t/4, q, NULL, p));
    for (int i = 0; i < 2; ++i) {
        assert_close(p[i], start[2 + i], 4*EPS);
        assert_close(q[i], start[i] + start[2 + i]*st.t/4, 4*EPS);
    }

    // the curve is still in tau, and v on it dq/dt
    assert_ok(gvi_switch(&st, CLOCK, 0));
    assert_ok(gvi_curve(&st, (real)0.25, after, after + 2));
    assert_memory_equal(before, after, sizeof before);
    assert_status(gvi_action(&st, &number), GVI_E_FORMULATION);
    assert_ok(gvi_step(&st, (real)0.125));
    assert_ok(gvi_switch(&st, CLOCK, 1));
    assert_status(gvi_state_at(&st, st.t - (real)0.01, q, NULL, NULL), GVI_E_STATE);
    assert_true(number == 7);
}

AT_POINTS(attraction_alone)
{
    gvi_points y = *x;
    y.value = NULL;
    return attraction(&y, user);
}

GVI_EACH(value_without_number, 2, value)
{
    x->value[0] += x->q[0] < (real)0.6 ? (real)NAN : -1/hypot(x->q[0], x->q[1]);
}

AT_POINT(no_force) { return 0; }

TEST(a_value_that_is_not_a_number_is_named)
{
    for (int later = 0; later < 3; ++later) {     // behind one that is good, the term of a Lagrangian too
        gvi_desc desc = describe(KEPLER, 4);
        gvi_effect effects[3] = { desc.effects[0], desc.effects[1],
                                  { .kind = later > 1 ? GVI_LAGRANGIAN : GVI_POTENTIAL, .point = no_force, .value = value_without_number } };
        gvi_stepper st;
        desc.effects = effects;
        desc.effect_count = later ? 3 : 2;
        if (!later) effects[0].points = attraction_alone, effects[0].value = value_without_number;
        set_up(&st, &desc, memory);
        assert_ok(gvi_start(&st, 0, start, start + 2));
        while (gvi_step(&st, (real)0.03125) == GVI_OK) assert_true(st.t < 10);
        assert_int_equal(st.status, GVI_E_NON_FINITE);
        assert_int_equal(st.fault.effect, later ? 2 : 0);
    }
}

GVI_EACH(clock_without_number, 1, value) { x->value[0] += *(real *)user; }

TEST(a_curve_whose_clock_is_not_a_number_is_refused)
{
    gvi_desc desc = describe(KEPLER, 4);
    gvi_effect *const effects = own_effects(&desc);
    gvi_stepper st;
    real g = 1, q[2] = { 7, 7 }, v[2];
    effects[1].points = clock_without_number;
    effects[1].user = &g;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start_momentum(&st, 0, start, start + 2));
    assert_ok(gvi_step(&st, (real)0.03125));
    g = (real)NAN;
    assert_status(gvi_curve(&st, (real)0.25, q, v), GVI_E_NON_FINITE);
    assert_int_equal(st.fault.effect, 1);
    assert_true(q[0] == 7);
}

/* Late: t has too few digits left to move by g h */
TEST(the_state_at_a_time_that_stands_still)
{
    const gvi_desc desc = describe(KEPLER, 4);
    const real late = 1/EPS;
    real q[2];
    gvi_stepper st;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start_momentum(&st, late, start, start + 2));
    for (int k = 0; k < 8; ++k) {
        assert_ok(gvi_step(&st, (real)0.001));
        assert_true(st.t == late);
        assert_ok(gvi_state_at(&st, st.t, q, NULL, NULL));
        assert_close(hypot(q[0] - st.q[0], q[1] - st.q[1]), 0, 2*8*0.001);      // where t is that, |v| < 2
    }
}

/* g = exp(q) of a free particle: q = t = -log(1 - tau), so steep at the end that Newton's method for tau leaves the step.
   It refuses calls of `unwanted` points: those of a step, or the single one at the end of a part of it. */
static int steep_clock(const gvi_points *x, void *user)
{
    if (x->count == *(int *)user) return 1;
    for (int k = 0; k < x->count; ++k) x->value[k] += exp(x->q[k]), x->f[k] += exp(x->q[k]);
    return 0;
}

TEST(the_state_at_a_time_of_a_steep_clock)
{
    int unwanted = 0;
    const gvi_effect effects[] = { { .kind = GVI_CLOCK, .points = steep_clock, .user = &unwanted } };
    const gvi_desc desc = { .n = 1, .degree = 16, .effects = effects, .effect_count = 1 };
    gvi_stepper st;
    real q = 7;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start(&st, 0, (const real[]){ 0 }, (const real[]){ 1 }));
    assert_ok(gvi_step(&st, (real)0.98));
    for (int k = 1; k < 32; ++k) {
        assert_ok(gvi_state_at(&st, st.t*k/32, &q, NULL, NULL));
        assert_close(q, st.t*k/32, 16*EPS);
    }
    for (unwanted = 1; unwanted <= 16; unwanted += 15) {
        assert_status(gvi_state_at(&st, st.t/3, &q, NULL, NULL), GVI_E_CALLBACK);
        assert_int_equal(st.fault.effect, 0);
    }
    assert_close(q, st.t*31/32, 16*EPS);
}

/* g = q1, or what sick says */
AT_POINTS(moody_clock)
{
    for (int k = 0; k < x->count; ++k) x->value[k] += x->q[k] + *(const real *)user, x->f[k] += 1;
    return 0;
}

/* In the middle of a step: the pendulum turns back before q1 = 0 is reached only if h is small */
TEST(a_clock_that_turns_negative_on_the_way_is_seen)
{
    real sick = 0;
    const gvi_effect effects[] = { { .kind = GVI_CLOCK, .points = moody_clock, .user = &sick } };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = effects, .effect_count = 1 };
    gvi_stepper st;
    set_up(&st, &desc, memory);
    assert_ok(gvi_start(&st, 0, (const real[]){ 1 }, (const real[]){ -1 }));
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, (real)0.5));      // q = exp(-tau) never gets there
    /* degree 4 is Pade's (4,4): 10 steps of 4!^2/(8! 9!) 0.5^9 */
    assert_close((st.q[0] - exp(-(long double)5))/(exp(-(long double)5)*7.689e-10L), 1, 0.1L);
    assert_status(gvi_step(&st, 50), GVI_E_CLOCK);
    gvi_status at_zero = gvi_start(&st, 0, (const real[]){ 0 }, (const real[]){ 1 });
    if (at_zero == GVI_OK) at_zero = gvi_step(&st, 0.125);
    assert_status(at_zero, GVI_E_CLOCK);                                   // g = 0 is not positive
    assert_int_equal(st.fault.effect, 0);
}

static gvi_status status_of(const gvi_desc *desc)
{
    gvi_stepper st;
    const gvi_status status = gvi_init(&st, desc, memory, sizeof memory);
    assert_int_equal(gvi_size(desc) > 0, status == GVI_OK);
    return status;
}

/* Two clocks, one of one point a call, r > s: test_why.c */
TEST(clocks_that_cannot_run_are_refused)
{
    gvi_desc desc = describe(KEPLER, 4);
    for (int f = GVI_EXPLICIT; f <= GVI_NEWTON; ++f) {
        desc.formulation = (gvi_formulation)f;
        assert_int_equal(status_of(&desc), f == GVI_MOMENTA ? GVI_OK : GVI_E_FORMULATION);
    }
    desc.formulation = GVI_AUTO;
    desc.rule = (gvi_rule){ GVI_KICKS, 2, (const real[]){ 0, 1 }, (const real[]){ 0.5, 0.5 } };
    desc.degree = 1;
    assert_int_equal(status_of(&desc), GVI_E_FORMULATION);
}

TEST(a_level_needs_values)
{
    gvi_desc desc = describe(FORCED, 4);
    gvi_stepper st;
    own_effects(&desc)[1].value = NULL;
    set_up(&st, &desc, memory);
    assert_status(gvi_start_momentum(&st, 0, start, start + 2), GVI_E_VALUE);
    assert_int_equal(st.fault.effect, 1);
    assert_status(gvi_start(&st, 0, start, start + 2), GVI_E_VALUE);
    assert_status(gvi_step(&st, (real)0.1), GVI_E_VALUE);                   // the first cause
}

TEST(questions_about_the_action_are_refused)
{
    gvi_stepper st;
    real q[2] = { 7, 7 }, number = 7;
    begin(&st, PENDULUM, 4, start);
    assert_ok(gvi_step(&st, (real)0.125));
    assert_status(gvi_action(&st, &number), GVI_E_FORMULATION);
    assert_status(gvi_discrete_lagrangian(&st, 0, (real)0.125, start, start + 2, &(gvi_discrete){ .p0 = q }),
                  GVI_E_FORMULATION);
    assert_status(gvi_start_configurations(&st, 0, (real)0.125, start, start + 2), GVI_E_FORMULATION);
    assert_status(gvi_state_at(&st, st.t*2, q, NULL, NULL), GVI_E_STATE);
    assert_true(q[0] == 7 && q[1] == 7 && number == 7);
    assert_ok(gvi_step(&st, (real)0.125));
}

/* The polynomial is in tau: it begins and ends with the step, and its velocity, there of
   order s, is dq/dt */
TEST(the_curve_runs_from_end_to_end)
{
    real miss[2];
    for (int k = 0; k < 2; ++k) {
        gvi_stepper st;
        real q[2], v[2], end[2], p[2];
        begin(&st, PENDULUM, 6, start);
        assert_ok(gvi_step(&st, (real)0.03125/(real)(1 + k)));
        assert_ok(gvi_curve(&st, 0, q, NULL));
        for (int i = 0; i < 2; ++i) assert_close(q[i], start[i], 2*EPS);
        assert_ok(gvi_curve(&st, 1, q, v));
        assert_ok(gvi_velocity(&st, end));
        for (int i = 0; i < 2; ++i) assert_close(q[i], st.q[i], 4*EPS);
        miss[k] = hypot(v[0] - end[0], v[1] - end[1]);
        assert_ok(gvi_state_at(&st, st.t, q, NULL, p));
        for (int i = 0; i < 2; ++i) assert_true(q[i] == st.q[i] && p[i] == st.p[i]);
    }
    assert_between(5.5, log2(miss[0]/miss[1]), 6.5);
}

#if GVI__KIND == 2

/* The ellipse of the start (x, 0), (0, v), as it is in double: 1/a = 2/x - v^2 cancels
   all but its last digits, so both terms are taken with what rounding left of them */
typedef struct ellipse { long double a, rest, period; } ellipse;        /* rest = 1 - e */

static ellipse ellipse_of(double x, double v)
{
    const long double X = x, V = v, square = V*V, under = fmal(V, V, -square);
    const long double two = 2/X, over = fmal(-two, X, 2)/X, pi = acosl(-1);
    ellipse o;
    o.a = 1/((two - square) + (over - under));
    o.rest = X < o.a ? X/o.a : square*X;                       // 2 - X/a without cancellation
    o.period = 2*pi*o.a*sqrtl(o.a);
    return o;
}

/* E - sin E without cancellation */
static long double excess(long double E)
{
    long double term = E*E*E/6, sum = 0;
    if (fabsl(E) > 1) return E - sinl(E);
    for (int k = 4; fabsl(term) > 1e-22L*fabsl(sum); k += 2) {
        sum += term;
        term *= -E*E/(long double)(k*(k + 1));
    }
    return sum;
}

/* Where the planet is at time t after the perihelion, or the aphelion:
   (E - sin E) + (1 - e) sin E = M, by Newton's method kept inside an interval by bisection */
static void kepler(const ellipse *o, int far, long double t, long double *x, long double *y)
{
    const long double e = 1 - o->rest, turns = t/o->period + far/2.0L;
    const long double M = (t - o->period*(roundl(turns) - far/2.0L))/(o->a*sqrtl(o->a));
    long double lo = -4, hi = 4, E = M, s = 0;
    for (int k = 0; k < 100; ++k) {
        s = sinl(E/2);
        const long double miss = excess(E) + o->rest*sinl(E) - M, next = E - miss/(2*e*s*s + o->rest);
        if (miss < 0) lo = E;
        else hi = E;
        E = next > lo && next < hi ? next : (lo + hi)/2;
    }
    s = sinl(E/2);
    *x = (far ? -1 : 1)*o->a*(o->rest - 2*s*s);
    *y = (far ? -1 : 1)*o->a*sqrtl(o->rest*(1 + e))*sinl(E);
}

/* Length of a period in tau for g = |q|^a: of a = 1, 2 pi; of 3/2, the complete elliptic
   integral 4/sqrt(1 + e) K(k), k^2 = 2e/(1 + e), by the arithmetic-geometric mean */
static long double period_of_tau(long double rest, real power)
{
    long double a = 1, b = sqrtl(rest/(2 - rest));
    const long double pi = acosl(-1);
    if (!(power > 1)) return 2*pi;
    for (int k = 0; k < 12; ++k) {
        const long double mean = (a + b)/2;
        b = sqrtl(a*b);
        a = mean;
    }
    return 2*pi/(a*sqrtl(2 - rest));
}

typedef struct orbit {
    double rest;                             /* 1 - e */
    real  *power;
    int    steps;                            /* in 100 revolutions */
    int    far;                              /* from the aphelion, or the perihelion */
    int    s;
    double allowed;
} orbit;

typedef struct outcome { long double end, worst, energy, near; double seconds; } outcome;

static long double energy_error(const gvi_stepper *st, long double E0)
{
    const long double x = st->q[0], y = st->q[1], u = st->p[0], v = st->p[1];
    return fabsl(((u*u + v*v)/2 - 1/hypotl(x, y))/E0 - 1);
}

static gvi_stepper *launch(gvi_stepper *st, const orbit *a, ellipse *o)
{
    static gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                    { .kind = GVI_CLOCK, .points = distance_clock } };
    const gvi_desc desc = { .n = 2, .degree = a->s, .effects = effects, .effect_count = 2 };
    const double x0 = a->far ? 2 - a->rest : a->rest, v0 = sqrt((2 - x0)/x0);
    *o = ellipse_of(x0, v0);
    effects[1].user = a->power;
    set_up(st, &desc, memory);
    assert_ok(gvi_start(st, 0, (const real[]){ x0, 0 }, (const real[]){ 0, v0 }));
    return st;
}

/* 100 revolutions: position at the wanted time of their end, and the worst of all steps
   of the last one, both against Kepler's equation; energy outside and inside |q| = 1 */
static outcome revolve(const orbit *a)
{
    gvi_stepper st;
    ellipse o;
    launch(&st, a, &o);
    const double h = (double)(100*period_of_tau(a->rest, *a->power))/a->steps, end = (double)(100*o.period);
    const long double E0 = -1/(2*o.a);
    long double X, Y;
    outcome z = { 0, 0, 0, 0, 0 };
    real q[2];
    const clock_t began = clock();
    while (st.t < end) {
        assert_ok(gvi_step(&st, h));
        if (hypot(st.q[0], st.q[1]) > 1) z.energy = fmaxl(z.energy, energy_error(&st, E0));
        else z.near = fmaxl(z.near, energy_error(&st, E0));
        if (st.t < (double)(99*o.period)) continue;
        kepler(&o, a->far, (long double)st.t + (long double)st.t_low, &X, &Y);       // t as it is carried
        z.worst = fmaxl(z.worst, hypotl(st.q[0] - X, st.q[1] - Y));
    }
    z.seconds = (double)(clock() - began)/CLOCKS_PER_SEC;
    assert_ok(gvi_state_at(&st, end, q, NULL, NULL));
    kepler(&o, a->far, end, &X, &Y);
    z.end = hypotl(q[0] - X, q[1] - Y);
    return z;
}

/* The figures of docs/hard-cases.md.  From the aphelion E = p'p/2 + V is known to
   rounding.  From the perihelion it is the difference of two terms of 1/(1 - e), each
   wrong by half a unit of its last place: the orbit is followed on a level that is
   wrong by EPS/(1 - e) at the most, and its period by 3/2 2(1/2) of that a revolution. */
TEST(eccentric_orbits_are_followed)
{
    static const orbit all[] = {
        { 0.1,   &power_one,   8000, 1, 8, 5e-12 },
        { 0.01,  &power_one,   8000, 1, 8, 1e-10 },
        { 0.001, &power_more, 17000, 1, 8, 1e-11 },
        { 1e-7,  &power_more, 32000, 1, 8, 1e-9 },
        { 0.1,   &power_one,   8000, 0, 8, 0 },
        { 0.01,  &power_one,   8000, 0, 8, 0 },
        { 0.001, &power_more, 17000, 0, 8, 0 },
        { 1e-7,  &power_more, 32000, 0, 8, 0 },
    };
    print_message("    from       1 - e   steps   at the end  worst    energy, |q| > 1  |q| < 1  ms\n");
    for (int i = 0; i < COUNT(all); ++i) {
        const outcome z = revolve(&all[i]);
        const double level = EPS/all[i].rest, speed = sqrt((2 - all[i].rest)/all[i].rest);
        print_message("    %s  %-6.0e %6d   %.1Le     %.1Le  %.1Le          %.1Le  %.1f\n",
                      all[i].far ? "aphelion  " : "perihelion", all[i].rest, all[i].steps,
                      z.end, z.worst, z.energy, z.near, z.seconds*1e3);
        if (all[i].far) {
            assert_between(0, z.end, all[i].allowed);
            assert_between(0, z.worst, all[i].allowed);
            assert_between(0, z.energy, 1e-14);
        } else {
            assert_between(0, z.energy, 2*level + 1e-14);
            assert_between(0, z.end, 3*628.4*level*speed + 1e-12);
        }
    }
}

#endif

RUN_TESTS(NULL, NULL)
