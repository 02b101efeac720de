/* examples/tools/contact.h: what closes, opens and strikes.  What is expected are closed forms, the definition of
   complementarity, and a motion by Runge's and Kutta's method with events by bisection. */
#include "gvi_test.h"
#include "tools/contact.h"

#define GAP(name) static void name(int a, real t, const real *q, real *phi, real *G, real *rate, void *user)

enum { LOG = 4000, SLOTS = 14 };
static struct { contact_kind kind; int which; real t, q[4], p[4]; } seen[LOG];
static int events;
static gvi_effect list[2 + SLOTS];
static long double memory[1 << 19];

static void told(contact *c, contact_kind kind, int which)
{
    if (events == LOG) return;
    seen[events].kind = kind, seen[events].which = which, seen[events].t = c->st.t;
    for (int i = 0; i < 4 && i < c->st.n; ++i) seen[events].q[i] = c->st.q[i], seen[events].p[i] = c->st.p[i];
    ++events;
}

/* The first event of a kind from number `from` on; -1: there is none */
static int find(contact_kind kind, int from)
{
    for (int i = from; i < events; ++i) if (seen[i].kind == kind) return i;
    return -1;
}

/* The scene in list[], with `others` effects before the slots */
static void set_up(contact *c, gvi_desc desc, int others)
{
    events = 0;
    c->told = told;
    contact_rows(c, list + others);
    desc.effects = list;
    desc.effect_count = others + c->slots;
    assert_between(1, contact_size(c, &desc), sizeof memory);
    assert_ok(contact_init(c, &desc, (real *)memory, sizeof memory));
}

static void begin(contact *c, gvi_desc desc, int others, const real *q, const real *v)
{
    set_up(c, desc, others);
    assert_ok(contact_start(c, 0, q, v));
}

static void go(contact *c, real to, int steps)
{
    const real h = (to - c->st.t)/(real)steps;
    for (int k = 0; k < steps; ++k) {
        const gvi_status status = contact_step(c, h);
        if (status) print_error("t = %g: %s (contact %d)\n", (double)c->st.t, contact_why(c, status), c->fault);
        assert_int_equal(status, 0);
    }
}

/* error[k] of steps 1, 1/2, 1/4 falls like the 2s-th power, as far as rounding does not hide it */
static void assert_order(const real *error, int count, int s, real rounding)
{
    for (int k = 1; k < count; ++k)
        if (error[k] > rounding) assert_between((real)(2*s) - R(0.3), log2(error[k - 1]/error[k]), (real)(2*s) + R(0.3));
}

GVI_EACH(weight, 2, f) { x->f[1] -= 1; }

/* ---- a bead on a sphere, a carriage in a loop, a cam ---- */

GAP(sphere_and_floor)
{
    const real r = sqrt(q[0]*q[0] + q[1]*q[1]);
    if (a == 0) *phi = r - 1, G[0] = q[0]/r, G[1] = q[1]/r;
    else *phi = q[1] + 1, G[1] = 1;
}

/* Leaves the sphere where cos = 2/3 of the energy, flies, and slides on the floor at y = -1 with its vx */
TEST(a_bead_leaves_a_sphere_and_lands)
{
    const real from = R(0.3), w = R(0.1), E = cos(from) + w*w/2, C = 2*E/3, S = sqrt(1 - C*C), speed = sqrt(2*(E - C)),
               vx = speed*C, vy = -speed*S, flight = vy + sqrt(vy*vy + 2*(C + 1)), land = S + vx*flight;
    for (int s = 1; s <= 5; ++s) {
        real left[4], landed[4];
        for (int k = 0; k < 4; ++k) {
            contact c = { .count = 2, .slots = 2, .gap = sphere_and_floor };
            list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
            begin(&c, (gvi_desc){ .n = 2, .degree = s }, 1, (real[]){ sin(from), cos(from) }, (real[]){ w*cos(from), -w*sin(from) });
            go(&c, 3, (s == 1 ? 16 : 8) << k);
            assert_int_equal(events, 4);
            assert_int_equal(find(CONTACT_CLOSED, 0), 0);
            assert_int_equal(find(CONTACT_OPENED, 0), 1);
            assert_int_equal(find(CONTACT_IMPACT, 0), 2);
            assert_int_equal(find(CONTACT_CLOSED, 1), 3);
            left[k] = fabs(seen[1].q[1] - C);
            landed[k] = fabs(c.st.q[0] - (land + vx*(3 - seen[2].t)));
            assert_close(seen[2].t - seen[1].t, flight, 2*left[k] + 64*EPS);
            assert_close(c.st.q[1], -1, 8*EPS);
            assert_close(contact_force(&c, 1), 1, 400*EPS);
            assert_true(contact_force(&c, 0) == 0);
        }
        assert_order(left, 4, s, 100*EPS);
        assert_order(landed, 4, s, 200*EPS);
        assert_between(0, left[3], s < 5 ? pow((real)4, -(real)(s + 2)) + 64*EPS : 64*EPS);
    }
}

GAP(loop)
{
    const real r = sqrt(q[0]*q[0] + q[1]*q[1]);
    *phi = 1 - r, G[0] = -q[0]/r, G[1] = -q[1]/r;
}

/* From the lowest point with v: leaves at the height (v^2 - 2)/3 = sin a, and its parabola meets the circle at -3a */
TEST(a_carriage_leaves_a_loop_and_meets_it_again)
{
    const real height = R(2.0)/3, a = asin(height);
    for (int s = 2; s <= 4; ++s) {
        real left[3], met[3];
        for (int k = 0; k < 3; ++k) {
            contact c = { .count = 1, .slots = 1, .gap = loop };
            list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
            begin(&c, (gvi_desc){ .n = 2, .degree = s }, 1, (real[]){ 0, -1 }, (real[]){ 2, 0 });
            go(&c, 4, 16 << k);
            const int o = find(CONTACT_OPENED, 0), i = find(CONTACT_IMPACT, 0);
            assert_between(1, o, i);
            left[k] = fabs(seen[o].q[1] - height);
            met[k] = hypot(seen[i].q[0] - cos(-3*a), seen[i].q[1] - sin(-3*a));
        }
        assert_order(left, 3, s, 100*EPS);
        assert_order(met, 3, s, 200*EPS);
    }
    contact c = { .count = 1, .slots = 1, .gap = loop };
    begin(&c, (gvi_desc){ .n = 2, .degree = 5 }, 1, (real[]){ 0, -1 }, (real[]){ sqrt(R(5.001)), 0 });
    go(&c, 4, 64);
    assert_int_equal(c.seen[CONTACT_OPENED], 0);
    assert_close(hypot(c.st.q[0], c.st.q[1]), 1, 8*EPS);
}

static real omega;
GVI_EACH(preload, 1, f) { x->f[0] -= 3 + 2*x->q[0]; }
GAP(cam)
{
    *phi = q[0] - (1 - cos(omega*t)), G[0] = 1, *rate = -omega*sin(omega*t);
}

/* m = 1, k = 2, preload 3, lift 1 - cos wt: lambda = w^2 cos wt + 3 + 2 (1 - cos wt), first 0 at the top where w^2 = 7 */
TEST(a_cam_lifts_its_follower_above_a_critical_speed)
{
    const real aside = KIND == 1 ? R(1e-3) : R(1e-6), critical = sqrt(R(7.0)), W = sqrt(R(2.0));
    for (int i = 0; i < 2; ++i) {
        contact c = { .count = 1, .slots = 1, .gap = cam };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = preload };
        omega = critical*(i ? 1 + aside : 1 - aside);
        begin(&c, (gvi_desc){ .n = 1, .degree = 5 }, 1, (real[]){ 0 }, (real[]){ 0 });
        go(&c, 10, 100);
        if (i) assert_true(c.seen[CONTACT_OPENED] > 0);
        else assert_int_equal(c.seen[CONTACT_OPENED], 0);
    }

    omega = R(1.3)*critical;
    const real C = -5/(omega*omega - 2), at = acos(C)/omega, y0 = 1 - C + R(1.5), u0 = omega*sin(omega*at);
    real lo = at + R(0.05), hi = at + R(1.5);
    for (int k = 0; k < 200; ++k) {                                   // free oscillation against the cam
        const real t = (lo + hi)/2, y = y0*cos(W*(t - at)) + u0/W*sin(W*(t - at)) - R(1.5);
        if (y > 1 - cos(omega*t)) lo = t; else hi = t;
    }
    for (int s = 1; s <= 3; ++s) {
        real error[3];
        for (int k = 0; k < 3; ++k) {
            contact c = { .count = 1, .slots = 1, .gap = cam };
            begin(&c, (gvi_desc){ .n = 1, .degree = s }, 1, (real[]){ 0 }, (real[]){ 0 });
            go(&c, 2, 16 << k);
            assert_close(seen[find(CONTACT_OPENED, 0)].t, at, 200*EPS);
            error[k] = fabs(seen[find(CONTACT_IMPACT, 0)].t - lo);
        }
        assert_order(error, 3, s, 100*EPS);
    }
}

/* ---- balls ---- */

static const int pairs[6][2] = { { 0, 1 }, { 0, 2 }, { 0, 3 }, { 1, 2 }, { 1, 3 }, { 2, 3 } };

GAP(billiard)                                   /* balls of radius .3 in [-2, 2]^2: sixteen walls, six pairs */
{
    if (a < 16) {
        const int i = a/2;
        *phi = a % 2 ? R(1.7) - q[i] : q[i] + R(1.7), G[i] = a % 2 ? -1 : 1;
        return;
    }
    const int i = 2*pairs[a - 16][0], j = 2*pairs[a - 16][1];
    const real X = q[j] - q[i], Y = q[j + 1] - q[i + 1], d = sqrt(X*X + Y*Y);
    *phi = d - R(0.6), G[j] = X/d, G[j + 1] = Y/d, G[i] = -X/d, G[i + 1] = -Y/d;
}

TEST(billiard_balls_keep_their_energy_and_go_back)
{
    const real q[] = { -1, -1, 1, R(-1.1), R(1.05), 1, -1, R(0.9) },
               v[] = { 1, R(0.3), R(-0.2), R(0.7), R(-0.5), R(-0.6), R(0.1), R(-0.9) };
    real e[22], E = 0, least = 0, slope[8], phi, rate;
    for (int i = 0; i < 22; ++i) e[i] = 1;
    contact c = { .count = 22, .slots = 8, .gap = billiard, .e = e };
    begin(&c, (gvi_desc){ .n = 8, .degree = 2 }, 0, q, v);
    while (c.seen[CONTACT_IMPACT] < 1000) {
        assert_ok(contact_step(&c, R(0.1)));
        for (int a = 0; a < 22; ++a) {
            billiard(a, 0, c.st.q, &phi, slope, &rate, NULL);
            least = fmin(least, phi);
        }
    }
    for (int i = 0; i < 8; ++i) E += (c.st.p[i]*c.st.p[i] - v[i]*v[i])/2;
    assert_close(E, 0, 1000*EPS);
    assert_between(-64*EPS*6, least, 64*EPS*6);                 // the gap's terms: 2 sqrt(2) (1.7 + |h v|)
    assert_close(c.energy, 0, 1000*EPS);
    assert_int_equal(c.seen[CONTACT_CLOSED] + c.seen[CONTACT_OPENED] + c.seen[CONTACT_CAPTURED], 0);

    assert_ok(contact_start(&c, 0, q, v));
    const unsigned long long before = c.seen[CONTACT_IMPACT];
    for (int k = 0; k < 40; ++k) assert_ok(contact_step(&c, R(0.1)));
    const unsigned long long there = c.seen[CONTACT_IMPACT] - before;
    assert_between(4, there, 6);
    for (int k = 0; k < 40; ++k) assert_ok(contact_step(&c, R(-0.1)));
    assert_int_equal(c.seen[CONTACT_IMPACT] - before, 2*there);
    for (int i = 0; i < 8; ++i) assert_close(c.st.q[i], q[i], 400*EPS), assert_close(c.st.p[i], v[i], 400*EPS);
}

GAP(slope)                                      /* a plane that falls to +x by .3 */
{
    *phi = cos(R(0.3))*q[1] + sin(R(0.3))*q[0], G[0] = sin(R(0.3)), G[1] = cos(R(0.3));
}

/* e = .8: each impact where the parabola says, at last at rest normally; then it slides with g sin */
TEST(a_ball_on_a_slope_comes_to_rest_and_slides)
{
    const real e = R(0.8), C = cos(R(0.3)), S = sin(R(0.3)), vn = R(0.2)*S, vt = R(0.2)*C, rest = KIND == 1 ? R(0.1) : R(0.01);
    for (int s = 2; s <= 8; s *= 2) {
        contact c = { .count = 1, .slots = 1, .gap = slope, .e = &e, .rest = rest };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
        begin(&c, (gvi_desc){ .n = 2, .degree = s }, 1, (real[]){ 0, 1 }, (real[]){ R(0.2), 0 });
        go(&c, 20, 16);
        real up = sqrt(vn*vn + 2*C*C), t = (vn + up)/C;
        int bounces = 0;
        for (int i = 0; i < events; ++i) {
            if (seen[i].kind != CONTACT_IMPACT) continue;
            assert_close(seen[i].t, t, 4000*EPS*t);
            up *= e, t += 2*up/C, ++bounces;
        }
        assert_int_equal(bounces, (int)ceil(log(rest/sqrt(vn*vn + 2*C*C))/log(e)) + 1);
        assert_int_equal(c.seen[CONTACT_CAPTURED], 1);
        assert_close(C*c.st.q[0] - S*c.st.q[1], -S + 20*vt + 200*S, 400*EPS*60);
        assert_close(contact_force(&c, 0), C, 400*EPS);
    }
}

GAP(row_of_balls) { *phi = q[a + 1] - q[a] - 1, G[a + 1] = 1, G[a] = -1; }

/* Four balls that touch are hit by a fifth: all at once, v+ = -e v- at the first contact and 0 at the others; in turn,
   Newton's cradle */
TEST(balls_that_touch_are_hit_together_or_in_turn)
{
    const real one[] = { 1, 1, 1, 1 }, half[] = { R(0.5), R(0.5), R(0.5), R(0.5) },
               expected[3][5] = { { R(-0.6), R(0.4), R(0.4), R(0.4), R(0.4) }, { 0, 0, 0, 0, 1 },
                                  { R(-0.2), R(0.3), R(0.3), R(0.3), R(0.3) } };
    for (int test = 0; test < 3; ++test) {
        contact c = { .count = 4, .slots = 4, .gap = row_of_balls, .e = test == 2 ? half : one, .in_turn = test == 1 };
        begin(&c, (gvi_desc){ .n = 5, .degree = 3 }, 0, (real[]){ 0, 2, 3, 4, 5 }, (real[]){ 1, 0, 0, 0, 0 });
        go(&c, 3, 20);
        for (int i = 0; i < 5; ++i) assert_close(c.st.p[i], expected[test][i], 64*EPS);
        assert_close(seen[0].t, 1, 8*EPS);
        assert_close(c.energy, test == 2 ? R(0.3) : 0, 64*EPS);
    }
}

GAP(disc)
{
    const real X = q[0] - R(5.3), Y = q[1] - R(0.05), r = sqrt(X*X + Y*Y);
    *phi = r - R(0.1), G[0] = X/r, G[1] = Y/r;
}

/* A bullet that would be through a disc within a thirtieth of the step: reflected at 30 degrees */
TEST(a_bullet_does_not_pass_through_a_disc)
{
    const real e = 1;
    for (int s = 1; s <= 8; s *= 2)
        for (int k = 1; k <= 8; k *= 2) {
            contact c = { .count = 1, .slots = 1, .gap = disc, .e = &e };
            begin(&c, (gvi_desc){ .n = 2, .degree = s }, 0, (real[]){ 0, 0 }, (real[]){ 10, 0 });
            go(&c, 1, k);
            assert_int_equal(c.seen[CONTACT_IMPACT], 1);
            assert_close(c.st.p[0], -5, 2000*EPS);
            assert_close(c.st.p[1], -5*sqrt(R(3.0)), 2000*EPS);
        }
}
RUN_TESTS(NULL, NULL)
