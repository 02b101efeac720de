/* Never wrong with GVI_OK, at the edges: a clock beside a light body, the times at which a step
   begins and ends, callbacks that refuse, slips in a description, and what each is told. */
#include "gvi_test.h"
#include "problems.h"

/* Sun, Jupiter, Saturn and a comet, AU and days.  A body without mass moves as one of mass m does,
   to m: what a clock adds must not depend on m. */

enum { BODIES = 4, COORDINATES = 3*BODIES };
static const real gravity = 2.95912208286e-4;
static real masses[BODIES] = { 1, 1/(real)1047, 1/(real)3500, 0 };

static real pair(const gvi_points *x, int k, int a, int b, real *d)
{
    real r2 = 0;
    for (int i = 0; i < 3; ++i) {
        d[i] = x->q[(3*a + i)*x->stride + k] - x->q[(3*b + i)*x->stride + k];
        r2 += d[i]*d[i];
    }
    return sqrt(r2);
}

static int bodies(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k)
        for (int a = 0; a < BODIES; ++a)
            for (int b = 0; b < a; ++b) {
                real d[3], r = pair(x, k, a, b, d), w = gravity*masses[a]*masses[b]/r;
                if (x->value) x->value[k] -= w;
                for (int i = 0; x->f && i < 3; ++i) {
                    x->f[(3*a + i)*x->stride + k] -= w*d[i]/(r*r);
                    x->f[(3*b + i)*x->stride + k] += w*d[i]/(r*r);
                }
            }
    return (void)user, 0;
}

/* g = (sum of 2/r^3)^(-1/2), or the comet's distance from the Sun */
static int bodies_clock(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        real sum = 0, slope[COORDINATES] = { 0 }, d[3], r;
        for (int a = 0; a < BODIES; ++a)
            for (int b = 0; b < a && !user; ++b) {
                r = pair(x, k, a, b, d);
                sum += 2/(r*r*r);
                for (int i = 0; i < 3; ++i) {
                    slope[3*a + i] -= 6*d[i]/(r*r*r*r*r);
                    slope[3*b + i] += 6*d[i]/(r*r*r*r*r);
                }
            }
        r = pair(x, k, 3, 0, d);
        const real g = user ? r : 1/sqrt(sum);
        for (int i = 0; i < COORDINATES; ++i)
            x->f[i*x->stride + k] += !user ? -g/sum/2*slope[i] : i < 3 ? -d[i]/r : i > 8 ? d[i - 9]/r : 0;
        x->value[k] += g;
    }
    return 0;
}

/* Where all are at `end`; the energy's relative change */
static gvi_status travel(int clock, int distance, real h, real end, real *q, real *energy)
{
    static const real q0[] = { 0, 0, 0, -3.5, -3.8, -1.5, 9.07, -3.04, -1.64, 1.2, 0.1, 0.05 };
    static const real v0[] = { 0, 0, 0, 0.0056, -0.0041, -0.0019, 0.0017, 0.0048, 0.0019, 0.002, 0.019, 0.001 };
    real m[COORDINATES], before, after;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = bodies, .value = bodies },
                                 { .kind = GVI_CLOCK, .points = bodies_clock, .user = distance ? &m : NULL } };
    const gvi_desc desc = { .n = COORDINATES, .effects = scene, .effect_count = 1 + clock,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    for (int i = 0; i < COORDINATES; ++i) m[i] = masses[i/3];
    gvi_stepper st = new_motion(&desc, 0, q0, v0);
    assert_ok(gvi_energy(&st, &before));
    while (st.t < end)
        if (gvi_step(&st, h) != GVI_OK) return st.status;
    assert_ok(gvi_energy(&st, &after));
    *energy = after/before - 1;
    return gvi_state_at(&st, end, q, NULL, NULL);
}

TEST(a_clock_leaves_a_light_body_where_it_is)
{
    int done = 0;
    for (int exponent = 3; exponent <= 15; exponent += 3) {
        real right[COORDINATES], q[COORDINATES], energy;
        masses[3] = pow((real)10, -(real)exponent);
        assert_ok(travel(0, 0, 1, 1000, right, &energy));
        for (int distance = 0; distance < 2; ++distance)
            for (real h = 8; h > 0.1L; h /= 2) {
                const gvi_status got = travel(1, distance, h, 1000, q, &energy);
                // longer steps are refused where the comet is lighter
                if (got == GVI_E_CONVERGENCE && exponent > 9 && h > 0.2L) continue;
                assert_ok(got);
                assert_between(-1e-14L, energy, 1e-14L);
                for (int i = 0; i < COORDINATES; ++i) assert_close(q[i], right[i], 1e-13L);
                done += 1;
            }
    }
    assert_between(50, done, 70);
}

GVI_EACH(varying, 1, f, value)
{
    const real w = 1 + sin(x->t[0])/8;
    x->value[0] += w*x->q[0]*x->q[0]/2;
    x->f[0] -= w*x->q[0];
}

GVI_EACH(half, 1, value) { x->value[0] += (real)0.5; }

/* A potential that reads t, beside a clock: refused at the start, and when it is switched on */
TEST(a_clock_refuses_a_potential_that_reads_t)
{
    const real one = 1;
    const gvi_effect scene[] = { { .kind = GVI_CLOCK, .points = half },
                                 { .kind = GVI_POTENTIAL, .points = varying, .value = varying } };
    const gvi_desc desc = { .n = 1, .effects = scene, .effect_count = 2 };
    gvi_stepper st = new_stepper(&desc);
    assert_status(gvi_start(&st, 0, &one, &one), GVI_E_FORMULATION);
    assert_int_equal(st.fault.effect, 1);
    assert_ok(gvi_switch(&st, 0, 0));
    assert_ok(gvi_start(&st, 0, &one, &one));
    assert_ok(gvi_step(&st, 0.25));
    assert_status(gvi_switch(&st, 0, 1), GVI_E_FORMULATION);
    assert_ok(gvi_step(&st, 0.25));               // still without the clock
    assert_close(st.t, 0.5, EPS);
}

/* A value that is defined up to a time is looked at once */
AT_POINTS(until_half)
{
    for (int k = 0; k < x->count; ++k) if (x->t[k] > R(0.5)) return 1;
    return 0;
}

TEST(a_clock_takes_a_value_that_ends)
{
    const real one = 1;
    const gvi_effect scene[] = { { .kind = GVI_CLOCK, .points = half }, { .points = until_half, .value = until_half } };
    const gvi_desc desc = { .n = 1, .effects = scene, .effect_count = 2 };
    gvi_stepper st = new_motion(&desc, 0, &one, &one);
    assert_ok(gvi_step(&st, R(0.5)));
    assert_status(gvi_step(&st, 2), GVI_E_CALLBACK);
}

/* g = 1 up to q = user, what it may not be beyond */
static real stopped;
GVI_EACH(stopping, 1, value) { x->value[0] += x->q[0] < *(real *)user ? 1 : stopped; }

/* A free particle at the points c_k h of its first iteration: the first beyond is the fault's */
TEST(a_clock_that_stops_names_the_point)
{
    static const real ills[] = { 0, -4, (real)NAN, (real)INFINITY };
    for (int j = 0; j < 20; ++j) {
        const int k = j % 5;
        real c[5], b[5], at;
        stopped = ills[j/5];
        const gvi_effect scene[] = { { .kind = GVI_CLOCK, .points = stopping, .user = &at } };
        const gvi_desc desc = { .n = 1, .degree = 5, .effects = scene, .effect_count = 1 };
        const real q = 0, v = 1;
        assert_ok(gvi_gauss(5, c, b));
        at = (k ? c[k - 1] + c[k] : c[0])/2;
        gvi_stepper st = new_motion(&desc, 0, &q, &v);
        SAME_STATE(&st) assert_status(gvi_step(&st, 1), j < 10 ? GVI_E_CLOCK : GVI_E_NON_FINITE);
        assert_int_equal(st.fault.effect, 0);
        assert_int_equal(st.fault.point, k);
        at = 2;
        assert_ok(gvi_step(&st, 1));
    }
}

TEST(times_within_2_ulp_of_a_step_are_in_it)
{
    int outside = 0;
    for (int clock = 0; clock < 2; ++clock) {
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                     { .kind = GVI_CLOCK, .points = half } };
        const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1 + clock };
        const real start[4] = { 1, 0, 0, 1 };
        gvi_stepper st = new_motion(&desc, 0, start, start + 2);
        for (int k = 0; k < 1000; ++k) {
            real before[2] = { st.q[0], st.q[1] }, q[2], began = st.t;
            assert_ok(gvi_step(&st, (real)0.1));
            const real dt = clock ? (real)0.05 : (real)0.1, ulp = EPS*st.t;
            assert_true(st.t0 == began);
            outside += st.t - dt < st.t0;
            assert_ok(gvi_state_at(&st, st.t - dt, q, NULL, NULL));
            assert_close(q[0], before[0], 8*ulp + 4*EPS);
            assert_ok(gvi_state_at(&st, st.t0, q, NULL, NULL));
            assert_true(q[0] == before[0] && q[1] == before[1]);
            assert_ok(gvi_state_at(&st, st.t + ulp, q, NULL, NULL));
            assert_close(q[0], st.q[0], ulp + 4*EPS);   // the state is that at t + t_low
            assert_status(gvi_state_at(&st, st.t + 4*ulp, q, NULL, NULL), GVI_E_STATE);
            assert_status(gvi_state_at(&st, st.t0 - 4*ulp - EPS, q, NULL, NULL), GVI_E_STATE);
        }
    }
    assert_between(100, outside, 900);            // what used to be refused
}

static int refuses;

/* L = -sqrt(1 - v^2): refused, or NaN, where v is beyond 1 */
static int relativity(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    const int n = *(const int *)user;
    real v2 = 0;
    for (int i = 0; i < n; ++i) v2 += v[i]*v[i];
    if (v2 >= 1 && refuses) return 1;
    for (int i = 0; i < n; ++i) dldv[i] += v[i]/sqrt(1 - v2);
    return (void)t, (void)q, (void)f, 0;
}

/* From rest, v is found to the last places: p = gamma v is then as exact as v allows */
TEST(relativistic_particles_start_by_momentum)
{
    for (refuses = 0; refuses < 2; ++refuses)
        for (int n = 1; n <= 3; ++n)
            for (real size = (real)0.1; size < 2e6L; size *= 10) {
                const gvi_effect scene[] = { { .kind = GVI_LAGRANGIAN, .point = relativity, .user = &n } };
                const gvi_desc desc = { .n = n, .degree = 4, .effects = scene, .effect_count = 1,
                                        .mass = { .kind = GVI_MASS_NONE } };
                const real q[3] = { 0 }, p[3] = { size*3/5, size*4/5, size*3/10 };
                real v[3], gamma2 = 1;
                for (int i = 0; i < n; ++i) gamma2 += p[i]*p[i];
                gvi_stepper st = new_stepper(&desc);
                assert_ok(gvi_start_momentum(&st, 0, q, p));
                assert_ok(gvi_velocity(&st, v));
                for (int i = 0; i < n; ++i) assert_close(v[i], p[i]/sqrt(gamma2), 4*EPS);
                if (size > 2000) continue;        // beyond, differences for Newton's method leave the domain
                assert_ok(gvi_step(&st, (real)0.125));
                for (int i = 0; i < n; ++i) assert_close(st.q[i], p[i]/sqrt(gamma2)/8, 4*EPS);
            }
}

/* V = -log(1 - q)/10, refused from 1 on, where free motion would be */
static int wall(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    if (q[0] >= 1) return 1;
    f[0] -= (real)0.1/(1 - q[0]);
    return (void)t, (void)v, (void)dldv, (void)user, 0;
}

TEST(free_motion_that_is_refused_is_shortened)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = wall } };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = scene, .effect_count = 1, .formulation = GVI_POSITIONS };
    const real q = (real)0.75, v = (real)0.5;
    gvi_stepper st, fine;
    st = new_motion(&desc, 0, &q, &v);
    assert_ok(gvi_step(&st, (real)0.55));         // 0.75 + 0.55/2 > 1
    fine = new_motion(&desc, 0, &q, &v);
    for (int k = 0; k < 64; ++k) assert_ok(gvi_step(&fine, (real)0.55/64));
    assert_close(st.q[0], fine.q[0], 2e-5L);
    assert_true(st.counters.effect[0] > 0);
}

/* The program of the README, with a degree for which its memory is too small */
TEST(a_failed_set_up_leaves_something_to_read)
{
    static real small[GVI_LENGTH(2, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    const gvi_desc desc = { .n = 2, .degree = 20, .effects = scene, .effect_count = 1 };
    const real start[2] = { 1, 1 };
    gvi_stepper st;
    for (size_t i = 0; i < sizeof small/sizeof *small; ++i) small[i] = 7;
    for (int k = 0; k < 3; ++k) {
        static const gvi_status wanted[] = { GVI_E_MEMORY, GVI_E_MEMORY, GVI_E_ARGUMENT };
        gvi_init(&st, &desc, k < 2 ? small : NULL, k == 1 ? 8 : sizeof small);
        gvi_start(&st, 0, start, start);
        assert_status(gvi_step(&st, 1), wanted[k]);
        for (int i = 0; i < 2; ++i)
            assert_true(st.q[i] == 0 && st.p[i] == 0 && st.q_low[i] == 0 && st.p_low[i] == 0);
    }
}

RUN_TESTS(NULL, NULL)
