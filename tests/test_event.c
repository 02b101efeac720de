/* examples/tools/event.h: zeros inside a step.  What is expected are closed forms: Kepler's equation,
   the oscillator, the parabola, free motion. */
#include "gvi_test.h"
#include "tools/event.h"
#include "problems.h"

enum { N = 2 };
static real q[N], v[N], p[N];
static const real pi = R(3.14159265358979323846264338328);

static event of(event_fn *g, void *user) { return (event){ .g = g, .user = user, .q = q, .v = v, .p = p }; }

GVI_EACH(spring, 1, f) { x->f[0] -= x->q[0]; }
GVI_EACH(weight, 1, f) { x->f[0] -= 1; }

GVI_EACH(distance, 2, f, value)
{
    const real d = sqrt(x->q[0]*x->q[0] + x->q[1]*x->q[1]);
    x->value[0] += d;
    x->f[0] += x->q[0]/d;
    x->f[1] += x->q[1]/d;
}

static real level(real t, const real *at, const real *rate, void *user) { return at[0] - *(real *)user; }
static real apsis(real t, const real *at, const real *rate, void *user) { return at[0]*rate[0] + at[1]*rate[1]; }
static real clock_hand(real t, const real *at, const real *rate, void *user) { return t - *(real *)user; }
static real undefined(real t, const real *at, const real *rate, void *user) { return sqrt(R(-1.0)); }

static const gvi_effect oscillator[] = { { .kind = GVI_POTENTIAL, .points = spring } };

/* q = cos t from t on */
static gvi_stepper *cosine(int degree, real t)
{
    static gvi_stepper st;
    const gvi_desc desc = { .n = 1, .degree = degree, .effects = oscillator, .effect_count = 1 };
    st = new_motion(&desc, t, (real[]){ cos(t) }, (real[]){ -sin(t) });
    return &st;
}

static const gvi_effect attracted[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                        { .kind = GVI_CLOCK, .points = distance } };
static const real ellipse = R(0.3);                     /* eccentricity, half axis 1, from the perihelion */

/* Largest error of three times within a revolution, q passing x = cos E - e for E = 1, E = 2, and the
   aphelion, in steps of h.  Each must be found once. */
static real kepler_error(const gvi_desc *desc, real h)
{
    static const real E[] = { 1, 2, R(3.14159265358979323846264338328) };
    real worst = 0;
    for (int k = 0; k < COUNT(E); ++k) {
        real x = cos(E[k]) - ellipse;
        const real exact = E[k] - ellipse*sin(E[k]);
        event e = of(k == 2 ? apsis : level, &x);
        gvi_stepper st = new_motion(desc, 0, (real[]){ 1 - ellipse, 0 }, (real[]){ 0, sqrt((1 + ellipse)/(1 - ellipse)) });
        for (int found = 0; !found; ) {
            assert_ok(gvi_step(&st, h));
            found = event_next(&e, &st);
            assert_between(0, found, 1);
            assert_true(st.t < 4);
        }
        assert_false(e.rising);
        assert_between(st.t0, e.t, st.t);
        worst = fmax(worst, fabs(e.t - exact));
        assert_int_equal(event_next(&e, &st), 0);
    }
    return worst;
}

static void expect_order(const gvi_desc *desc, real h, real order)
{
    const real coarse = kepler_error(desc, h), fine = kepler_error(desc, h/2);
    assert_between(order - R(0.25), log2(coarse/fine), order + R(0.25));
}

TEST(times_have_the_order_of_the_steps)
{
    static const real at[] = { 0, R(1.35120719195965763), R(-0.35120719195965763), 1 };
    static const real kick[] = { R(0.67560359597982882), R(-0.17560359597982882), R(-0.17560359597982882), R(0.67560359597982882) };
    static const real h[] = { R(0.011), R(0.09), R(0.18), R(0.18) };
    gvi_desc desc = { .n = N, .degree = 8, .effects = attracted, .effect_count = 1 };
    assert_between(0, kepler_error(&desc, R(0.07)), 200*EPS);
    if (DIG < 50) return;
    for (int s = 1; s <= 4; ++s) {
        desc.degree = s;
        expect_order(&desc, h[s-1], (real)(2*s));
    }
    desc.degree = 0;
    desc.rule = (gvi_rule){ .kind = GVI_KICKS, .points = 4, .nodes = at, .weights = kick };
    expect_order(&desc, R(0.03), 4);
    desc = (gvi_desc){ .n = N, .degree = 1, .rule = { .kind = GVI_LOBATTO }, .effects = attracted, .effect_count = 1 };
    expect_order(&desc, R(0.011), 2);
    for (int s = 2; s <= 3; ++s) {
        desc = (gvi_desc){ .n = N, .degree = s, .effects = attracted, .effect_count = 2 };
        expect_order(&desc, R(0.09), (real)(2*s));
    }
}

/* cos t = 0.3, twice a period; and again with a new start at every zero. */
TEST(every_zero_is_found_once)
{
    static const real h[] = { R(0.0625), R(0.3), R(0.7), R(-0.45) };
    real wanted = R(0.3);
    const real first = acos(wanted);
    for (int anew = 0; anew < 2; ++anew)
        for (int i = 0; i < COUNT(h); ++i) {
            event e = of(level, &wanted);
            gvi_stepper *st = cosine(8, 0);
            const real way = h[i] < 0 ? -1 : 1;
            for (int k = 0; k < 60; ) {
                int found;
                assert_ok(gvi_step(st, h[i]));
                while ((found = event_next(&e, st)) > 0) {
                    const real exact = way*((real)(k/2)*2*pi + (k % 2 ? 2*pi - first : first));
                    assert_close(e.t, exact, 16*EPS*(1 + fabs(exact)));
                    assert_close(e.q[0], wanted, 200*EPS);
                    assert_int_equal(e.rising, k % 2);
                    ++k;
                    if (anew) {
                        assert_ok(gvi_start_momentum(st, e.t, e.q, e.p));
                        break;
                    }
                }
                assert_true(found >= 0);
            }
        }
}

/* q = t - 1 is 0 where the fourth step ends; so is q = 1 - t. */
TEST(a_zero_where_two_steps_meet_counts_once)
{
    const gvi_desc desc = { .n = 1, .degree = 2 };
    for (int rising = 0; rising < 2; ++rising) {
        real zero = 0;
        const real rate = rising ? 1 : -1;
        event e = of(level, &zero);
        int count = 0;
        gvi_stepper st = new_motion(&desc, 0, (real[]){ -rate }, (real[]){ rate });
        for (int k = 0; k < 12; ++k) {
            int found;
            assert_ok(gvi_step(&st, R(0.25)));
            while ((found = event_next(&e, &st)) > 0) {
                ++count;
                assert_close(e.t, 1, 0);
                assert_int_equal(e.rising, rising);
            }
            assert_int_equal(found, 0);
        }
        assert_int_equal(count, 1);

        /* a run that starts at its zero does not count it */
        e = of(level, &zero);
        assert_ok(gvi_start(&st, 0, (real[]){ 0 }, (real[]){ rate }));
        assert_ok(gvi_step(&st, R(0.25)));
        assert_int_equal(event_next(&e, &st), 0);
    }
}

/* Four intervals of a quarter each; the top of cos t in the middle of one.  Zeros of cos t - level that
   are 0.2 apart lie both inside and are not seen, 0.3 apart they are; nor are those lost in shorter steps. */
TEST(two_zeros_in_one_interval_are_not_seen)
{
    static const struct { real apart, h; int zeros; } cases[] = { { R(0.2), 1, 0 }, { R(0.3), 1, 2 }, { R(0.2), R(0.5), 2 } };
    for (int i = 0; i < COUNT(cases); ++i) {
        real wanted = cos(cases[i].apart/2);
        event e = of(level, &wanted);
        gvi_stepper *st = cosine(3, R(-0.375));
        int count = 0;
        for (int k = 0; k < 3; ++k) {
            assert_ok(gvi_step(st, cases[i].h));
            while (event_next(&e, st) > 0)
                assert_close(fabs(e.t), cases[i].apart/2, R(1e-4)), ++count;
        }
        assert_int_equal(count, cases[i].zeros);
    }
}

/* cos t - level where only the curve passes the level, above the top of the states, and a sample lies
   between its two zeros. What counts are states. */
TEST(a_touch_that_only_the_curve_sees_does_not_count)
{
    real curve, top, wanted;
    event e = of(level, &wanted);
    gvi_stepper *st = cosine(3, R(-0.75));
    assert_ok(gvi_step(st, 1));
    assert_ok(gvi_curve(st, R(0.75), &curve, NULL));
    assert_ok(gvi_state_at(st, 0, &top, NULL, NULL));
    assert_between(R(1e-5), curve - top, R(1e-2));
    wanted = top + (curve - top)*R(0.5);
    assert_int_equal(event_next(&e, st), 0);
    wanted = top - (curve - top)*R(0.5);
    e = of(level, &wanted);
    assert_int_equal(event_next(&e, st), 1);
    assert_int_equal(event_next(&e, st), 1);
    assert_int_equal(event_next(&e, st), 0);
}

/* Two rods of 1, bobs of 1, g = 1; the wall at x = 1.1. Elastic. */
static const real wall = R(1.1);

GVI_EACH(bobs, 4, f, value)
{
    x->f[1] -= 1, x->f[3] -= 1;
    x->value[0] += x->q[1] + x->q[3];
}

GVI_EACH(rods, 4, rows(2))
{
    const real *z = x->q, a = z[2] - z[0], b = z[3] - z[1];
    const real G[8] = { z[0], z[1], 0, 0, -a, -b, a, b };
    x->g[0] = (z[0]*z[0] + z[1]*z[1] - 1)/2;
    x->g[1] = (a*a + b*b - 1)/2;
    for (int i = 0; i < 8; ++i) x->jacobian[i] = G[i];
}

static real gap(real t, const real *at, const real *rate, void *user) { return wall - at[2]; }

/* p+ = p- - 2 (n.p-)/(n.n) n, n the wall's normal without what the rods hold. */
static void mirror(const real *at, real *momentum)
{
    const real U = at[2] - at[0], W = at[3] - at[1], c = at[0]*U + at[1]*W, a = c*U/(2 - c*c), b = U/(2 - c*c);
    const real n[4] = { b*U - a*at[0], b*W - a*at[1], 1 - b*U, -b*W };
    const real twice = 2*momentum[2]/(n[0]*n[0] + n[1]*n[1] + n[2]*n[2] + n[3]*n[3]);
    for (int i = 0; i < 4; ++i) momentum[i] -= twice*n[i];
}

static real linkage_q[4], linkage_v[4], linkage_p[4];

static gvi_stepper *linkage(int degree, event *e)
{
    static gvi_stepper st;
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = bobs, .value = bobs },
                                        { .kind = GVI_CONSTRAINT, .points = rods, .rows = 2 } };
    const gvi_desc desc = { .n = 4, .degree = degree, .effects = scene, .effect_count = 2 };
    *e = (event){ .g = gap, .q = linkage_q, .v = linkage_v, .p = linkage_p };
    st = new_motion(&desc, 0, (real[]){ R(0.6), R(0.8), 0, R(1.6) }, (real[]){ 0, 0, 0, 0 });
    return &st;
}

/* 200 impacts: no loss, and the rods as long as before */
TEST(a_linkage_hits_a_wall_often_without_loss)
{
    event e;
    gvi_stepper *st = linkage(8, &e);
    real start, now;
    assert_ok(gvi_energy(st, &start));
    for (int hits = 0; hits < 200; ) {
        assert_ok(gvi_step(st, R(0.02)));
        const int found = event_next(&e, st);
        assert_true(found >= 0);
        if (!found || e.rising) continue;
        mirror(e.q, e.p);
        assert_ok(gvi_start_momentum(st, e.t, e.q, e.p));
        ++hits;
        assert_ok(gvi_energy(st, &now));
        assert_close(now, start, 32*EPS*(real)(hits + 4));
        assert_close(e.q[0]*e.q[0] + e.q[1]*e.q[1], 1, 8*EPS);
    }
}

/* g may read the time alone, and need not be finite. */
TEST(g_may_read_the_time_alone_and_be_undefined)
{
    real noon = R(1.3);
    event e = of(clock_hand, &noon);
    gvi_stepper *st = cosine(4, 0);
    assert_int_equal(event_next(&e, st), GVI_E_STATE);
    for (int k = 0; k < 4; ++k) {
        assert_ok(gvi_step(st, R(0.5)));
        assert_int_equal(event_next(&e, st), k == 2);
    }
    assert_close(e.t, noon, 2*EPS);
    e = of(undefined, NULL);
    assert_int_equal(event_next(&e, st), GVI_E_NON_FINITE);
}

TEST(output_at_given_times_is_the_motion)
{
    for (int way = -1; way <= 1; way += 2) {
        gvi_stepper *st = cosine(8, 0);
        for (int k = 0; k <= 30; ++k) {
            const real t = R(0.25)*(real)(way*k);
            assert_ok(output_at(st, (real)way*R(0.75), t, q, v, p));
            assert_close(q[0], cos(t), 8*EPS);
            assert_close(v[0], -sin(t), 8*EPS);
            assert_close(p[0], -sin(t), 8*EPS);
        }
        assert_int_equal((int)st->counters.steps, 10);
        assert_status(output_at(st, (real)way*R(0.75), 0, q, NULL, NULL), GVI_E_STATE);      /* long past */
        assert_status(output_at(st, (real)way*R(0.75), (real)way*(real)INFINITY, q, NULL, NULL), GVI_E_ARGUMENT);
        assert_true(output_at(cosine(8, 0), 1, (real)NAN, q, NULL, NULL) < 0);
    }
}

/* A ball on a level floor: each impact when the parabola says so; then, if it loses speed, the end of that, above the floor */
TEST(impacts_that_pile_up_end_in_a_status)
{
    if (KIND == 1) skip();                            // the digits of float do not show it
    static const real restitutions[] = { 1, R(0.9), R(0.5), R(0.01), 0 }, hs[] = { R(0.02), R(0.5) };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight } };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = scene, .effect_count = 1 };
    for (int i = 0; i < COUNT(restitutions)*COUNT(hs); ++i) {
        const real k = restitutions[i/2], h = hs[i % 2], floor = 0;
        event e = of(level, (void *)&floor);
        real speed = 1, when = 1;                                         /* from 1/2, at rest */
        int found = 0;
        gvi_stepper st = new_motion(&desc, 0, (real[]){ R(0.5) }, (real[]){ 0 });
        while (found >= 0 && st.t < 40) {
            assert_ok(gvi_step(&st, h));
            found = event_next(&e, &st);
            if (found <= 0) continue;
            assert_false(e.rising);
            assert_close(e.t, when, 1000*EPS*when);
            speed *= k;
            when += 2*speed;
            p[0] *= -k;
            assert_ok(gvi_start_momentum(&st, e.t, q, p));
        }
        assert_int_equal(found, k < 1 ? EVENT_PILE_UP : 0);
        if (k < 1) assert_true(2*speed <= h/4096);
    }
}

/* Steps that would never come there, and arrays that are not there */
TEST(what_makes_no_sense_is_refused)
{
    static const real hs[] = { R(1e-30), R(-1e-30), R(1e-16), 0 };
    for (int i = 0; i < COUNT(hs); ++i) {
        gvi_stepper *st = cosine(8, 0);
        assert_status(output_at(st, hs[i], hs[i] > 0 ? 2 : -2, q, NULL, NULL), GVI_E_ARGUMENT);
        assert_int_equal((int)st->counters.steps, 0);
    }
    real noon = 1;
    gvi_stepper *st = cosine(4, 0);
    assert_ok(gvi_step(st, 2));
    for (int i = 0; i < 4; ++i) {
        event e = of(clock_hand, &noon);
        if (i == 0) e.g = NULL;
        if (i == 1) e.q = NULL;
        if (i == 2) e.v = NULL;
        if (i == 3) e.p = NULL;
        assert_int_equal(event_next(&e, st), GVI_E_ARGUMENT);
    }
    assert_int_equal(event_next(NULL, st), GVI_E_ARGUMENT);
}

RUN_TESTS(NULL, NULL)
