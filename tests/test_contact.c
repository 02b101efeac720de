/* examples/tools/contact.h: what closes, opens and strikes.  What is expected are closed forms, the definition of
   complementarity, and a motion by Runge's and Kutta's method with events by bisection. */
#include "gvi_test.h"
#include "tools/contact.h"
#include "tools/friction.h"

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
        go(&c, 40, 400);                           // 17 tops: the curve sees some, within order s
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
    for (int s = 1; s <= 4; ++s) {
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

static real lost;                               /* momentum, in impacts of two balls */

static void told_pairs(contact *c, contact_kind kind, int which)
{
    real sum[2] = { 0, 0 };
    for (int i = 0; i < 8 && which >= 16 && kind == CONTACT_IMPACT; ++i) sum[i % 2] += c->v[i] - c->st.p[i];
    lost = fmax(lost, fmax(fabs(sum[0]), fabs(sum[1])));
}

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
    c.told = told_pairs, lost = 0;
    while (c.seen[CONTACT_IMPACT] < 10000) {
        assert_ok(contact_step(&c, R(0.1)));
        for (int a = 0; a < 22; ++a) {
            billiard(a, 0, c.st.q, &phi, slope, &rate, NULL);
            least = fmin(least, phi);
        }
    }
    for (int i = 0; i < 8; ++i) E += (c.st.p[i]*c.st.p[i] - v[i]*v[i])/2;
    assert_close(E, 0, 1000*EPS);                               // 100 in the root, of 10 each
    assert_close(lost, 0, 8*EPS);
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

GAP(box) { *phi = a % 2 ? 1 - q[a/2] : q[a/2], G[a/2] = a % 2 ? -1 : 1; }

/* Two balls on lines of their own between walls at 0 and 1, 17 impacts: in one step or by the dial, forth and back */
TEST(all_impacts_of_a_step_come_in_their_order)
{
    const real e[] = { 1, 1, 1, 1 }, q[] = { R(0.4), R(0.7) }, v[] = { 1, R(-0.7) }, T = R(10.3);
    for (int run = 0; run < 4; ++run) {
        const real way = run % 2 ? -1 : 1;
        contact c = { .count = 4, .slots = 2, .gap = box, .e = e };
        begin(&c, (gvi_desc){ .n = 2, .degree = 3, .resolution = run < 2 ? 0 : sqrt(EPS) }, 0, q, v);
        if (run < 2) go(&c, way*T, 1);
        while (run > 1 && way*c.st.t < T) assert_ok(contact_advance(&c, way*T));

        real x[2] = { q[0], q[1] }, u[2] = { way*v[0], way*v[1] }, left[2], t = 0;
        int k = 0;
        for (; ; ++k) {                                               // by the next of the two alone
            for (int i = 0; i < 2; ++i) left[i] = u[i] > 0 ? (1 - x[i])/u[i] : -x[i]/u[i];
            const int i = left[1] < left[0];
            if (t + left[i] > T) break;
            assert_between(k + 1, events, LOG);
            assert_int_equal(seen[k].which, 2*i + (u[i] > 0));
            assert_close(seen[k].t, way*(t += left[i]), 100*EPS*T);
            x[!i] += u[!i]*left[i], x[i] = u[i] > 0, u[i] = -u[i];
        }
        assert_int_equal(events, k);
        assert_int_equal(c.seen[CONTACT_IMPACT], k);
        for (int i = 0; i < 2; ++i) assert_close(c.st.q[i], x[i] + u[i]*(T - t), 100*EPS*T);
    }
}

GVI_EACH(spring, 1, f) { x->f[0] -= x->q[0]; }
GAP(near_the_turn) { *phi = q[0] + R(0.9), G[0] = 1; }

/* A step of two periods, which ends as far from the wall as it starts, and as much at rest */
TEST(a_long_step_does_not_pass_over_a_wall)
{
    const real e = 1, at = acos(R(-0.9));
    for (int s = 24; s <= 32; s += 4) {
        contact c = { .count = 1, .slots = 1, .gap = near_the_turn, .e = &e };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = spring };
        begin(&c, (gvi_desc){ .n = 1, .degree = s }, 1, (real[]){ 1 }, (real[]){ 0 });
        go(&c, 4*acos(R(-1.0)), 1);
        assert_int_equal(events, 2);
        for (int i = 0; i < 2; ++i) assert_close(seen[i].t, (real)(2*i + 1)*at, KIND == 1 ? R(1e-4) : R(1e-9));
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

/* ---- a double pendulum and a wall, e = 0 ---- */

static const real wall = R(1.1), aside = 2;     /* gravity (2, -1) presses the lower bob against x = 1.1 */

GVI_EACH(pull_bobs, 4, f) { x->f[0] += aside, x->f[2] += aside, x->f[1] -= 1, x->f[3] -= 1; }
GVI_EACH(two_rods, 4, rows(2))
{
    const real X = x->q[0], Y = x->q[1], U = x->q[2] - X, V = x->q[3] - Y;
    real *G = x->jacobian;
    x->g[0] = (X*X + Y*Y - 1)/2, x->g[1] = (U*U + V*V - 1)/2;
    G[0] = X, G[1] = Y, G[4] = -U, G[5] = -V, G[6] = U, G[7] = V;
}
GVI_EACH(pull_angles, 2, f)
{
    x->f[0] += 2*(aside*cos(x->q[0]) - sin(x->q[0]));
    x->f[1] += aside*cos(x->q[1]) - sin(x->q[1]);
}
GVI_EACH(angles_mass, 2, mass) { x->mass[0] = 2, x->mass[2] = cos(x->q[0] - x->q[1]), x->mass[3] = 1; }
GVI_EACH(angles_gradient, 2, v, f)
{
    const real w = sin(x->q[0] - x->q[1])*x->v[0]*x->v[1];
    x->f[0] -= w, x->f[1] += w;
}
GAP(wall_of_bobs) { *phi = wall - q[2], G[2] = -1; }
GAP(wall_of_angles) { *phi = wall - sin(q[0]) - sin(q[1]), G[0] = -cos(q[0]), G[1] = -cos(q[1]); }

typedef long double wide;                       /* the judge's, in each type */

/* Accelerations in angles, and what the wall has to push for the gap to stay: y = a, b, a', b' */
static wide push(const wide *y, int touches, wide *dy)
{
    const wide c = cos(y[0] - y[1]), s = sin(y[0] - y[1]), det = 2 - c*c,
               F = 2*(aside*cos(y[0]) - sin(y[0])) - s*y[3]*y[3], H = aside*cos(y[1]) - sin(y[1]) + s*y[2]*y[2],
               g = -cos(y[0]), h = -cos(y[1]), curved = sin(y[0])*y[2]*y[2] + sin(y[1])*y[3]*y[3],
               A = (F - c*H)/det, B = (2*H - c*F)/det, W = (g*(g - c*h) + h*(2*h - c*g))/det,
               lambda = -(g*A + h*B + curved)/W, l = touches ? lambda : 0;
    dy[0] = y[2], dy[1] = y[3];
    dy[2] = A + (g - c*h)/det*l, dy[3] = B + (2*h - c*g)/det*l;
    return lambda;
}

static void runge_kutta(wide *y, int touches, wide h)
{
    wide k[4][4], z[4];
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i) z[i] = y[i] + (j == 0 ? 0 : j == 3 ? h : h/2)*(j > 0 ? k[j - 1][i] : 0);
        push(z, touches, k[j]);
    }
    for (int i = 0; i < 4; ++i) y[i] += h*(k[0][i] + 2*k[1][i] + 2*k[2][i] + k[3][i])/6;
}

/* By steps of T/steps, each event by bisection of the last step */
static void judge(wide *y, wide T, int steps, int *closed, int *opened)
{
    int touches = 0;
    *closed = *opened = 0;
    for (wide t = 0, h = T/(wide)steps; t < T - h/1000; ) {
        wide was[4], dy[4], lo = 0, hi = fmin(h, T - t);
        memcpy(was, y, sizeof was);
        runge_kutta(y, touches, hi);
        int event = touches ? push(y, 1, dy) < 0 : sin(y[0]) + sin(y[1]) > wall;
        if (!event) { t += hi; continue; }
        for (int k = 0; k < 60; ++k) {
            const wide x = (lo + hi)/2;
            memcpy(y, was, sizeof was);
            runge_kutta(y, touches, x);
            event = touches ? push(y, 1, dy) < 0 : sin(y[0]) + sin(y[1]) > wall;
            if (event) hi = x; else lo = x;
        }
        memcpy(y, was, sizeof was);
        runge_kutta(y, touches, lo);
        t += lo;
        if ((touches = !touches)) {                           // v+ = v- - M^-1 G' (G v)/(G M^-1 G')
            const wide c = cos(y[0] - y[1]), det = 2 - c*c, g = -cos(y[0]), e = -cos(y[1]), R0 = (g - c*e)/det,
                       R1 = (2*e - c*g)/det, z = (g*y[2] + e*y[3])/(g*R0 + e*R1);
            y[2] -= R0*z, y[3] -= R1*z;
            ++*closed;
        } else ++*opened;
    }
}

TEST(a_double_pendulum_meets_a_wall_and_leaves_it)
{
    const real a = atan2(R(0.6), R(-0.8)), b = atan2(R(-0.6), R(-0.8)), T = 9;
    wide y[4] = { atan2l(0.6L, -0.8L), atan2l(-0.6L, -0.8L), 0, 0 };
    int closed, opened;
    judge(y, T, 20000, &closed, &opened);
    const wide near = sin(y[0]) + sin(y[1]);
    y[0] = atan2l(0.6L, -0.8L), y[1] = atan2l(-0.6L, -0.8L), y[2] = y[3] = 0;
    judge(y, T, 40000, &closed, &opened);
    const wide X = sin(y[0]) + sin(y[1]), Y = -cos(y[0]) - cos(y[1]);
    const real own = (real)(4*fabs(X - near)/15);                     // of order 4, with some room
    assert_between(2, closed, 4);
    for (int form = 0; form < 2; ++form)
        for (int s = 1; s <= 5; ++s) {
            real error[3];
            if (s == 5 && !form) continue;
            for (int k = 0; k < 3; ++k) {
                contact c = { .count = 1, .slots = 1, .gap = form ? wall_of_bobs : wall_of_angles };
                gvi_desc desc = { .n = form ? 4 : 2, .degree = s < 5 ? s : 8, .resolution = s < 5 ? 0 : 100*EPS };
                list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = form ? pull_bobs : pull_angles };
                list[1] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = two_rods, .rows = 2 };
                if (!form) desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = angles_mass, .gradient = angles_gradient };
                begin(&c, desc, 1 + form, form ? (real[]){ R(0.6), R(0.8), 0, R(1.6) } : (real[]){ a, b }, (real[4]){ 0 });
                if (s < 5) go(&c, T, (s == 1 ? 1024 : 128) << k);
                else while (c.st.t < T) assert_ok(contact_advance(&c, T));
                error[k] = (real)(form ? hypot(c.st.q[2] - X, c.st.q[3] - Y)
                                       : hypot(sin(c.st.q[0]) + sin(c.st.q[1]) - X, cos(c.st.q[0]) + cos(c.st.q[1]) + Y));
                assert_int_equal(c.seen[CONTACT_CLOSED], closed);
                assert_int_equal(c.seen[CONTACT_OPENED], opened);
            }
            if (s < 5) assert_order(error + (s > 1), s > 1 ? 2 : 3, s, 200*EPS);
            else assert_between(0, error[2], 100*EPS + own);
        }
}

/* ---- a block that rocks, a rope, a table ---- */

GVI_EACH(heavy, 3, f) { x->f[1] -= R(9.81); }
GAP(corners)
{
    const real s = sin(q[2]), k = cos(q[2]), X = a ? R(0.2) : R(-0.2);
    *phi = q[1] + s*X - k, G[1] = 1, G[2] = k*X + s;
}

/* b = 1/5, h = 1 on a smooth floor: each impact leaves (h^2 - 2 b^2)/(h^2 + 4 b^2) of the rate */
TEST(a_block_rocks_to_rest)
{
    const real I = R(1.04)/3, m[] = { 1, 1, I }, ratio = R(0.92)/R(1.16), from = R(0.1);
    contact c = { .count = 2, .slots = 2, .gap = corners, .rest = KIND == 1 ? R(0.05) : R(1e-3) };
    list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = heavy };
    const real q[] = { 0, cos(from) + R(0.2)*sin(from), from }, v[] = { R(0.3), 0, 0 };
    begin(&c, (gvi_desc){ .n = 3, .degree = 4, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } }, 1, q, v);
    go(&c, 4, 400);
    real last = 0, E = R(9.81)*(c.st.q[1] - q[1]) + c.energy - R(0.045);
    int impacts = 0;
    for (int i = 0; i < 3; ++i) E += c.st.p[i]*c.st.p[i]/m[i]/2;
    assert_close(E, 0, 4000*EPS);
    for (int i = 0; i < events; ++i) {
        if (seen[i].kind != CONTACT_IMPACT) continue;
        const real w = fabs(seen[i].p[2]);                    // told at the impact, before it
        if (impacts++ > 0) assert_close(w/last, ratio, KIND == 1 ? R(0.05) : R(1e-7));
        last = w;
    }
    assert_between(KIND == 1 ? 5 : 20, impacts, 40);
    assert_close(c.st.q[2], 0, 64*EPS);
    assert_close(c.st.q[0], R(1.2), 64*EPS);
    assert_close(contact_force(&c, 0) + contact_force(&c, 1), R(9.81), 4000*EPS);
}

enum { BEADS = 13 };
static const real link = R(1.0)/12, radius = R(0.1);
static real table;

GVI_EACH(beads_weight, 2*BEADS, f) { for (int i = 0; i < BEADS; ++i) x->f[2*i + 1] -= 1; }
GVI_EACH(beads_links, 2*BEADS, rows(BEADS - 1))
{
    for (int a = 0; a < BEADS - 1; ++a) {
        const real X = x->q[2*a + 2] - x->q[2*a], Y = x->q[2*a + 3] - x->q[2*a + 1];
        real *G = x->jacobian + a*2*BEADS + 2*a;
        x->g[a] = (X*X + Y*Y - link*link)/2;
        G[0] = -X, G[1] = -Y, G[2] = X, G[3] = Y;
    }
}
GAP(edge)                                       /* the plane y = table up to x = table, then a quarter of a circle */
{
    const real X = q[2*a] - table, Y = q[2*a + 1] - table, r = hypot(X, Y + radius);
    if (X <= 0) *phi = Y, G[2*a + 1] = 1;
    else *phi = r - radius, G[2*a] = X/r, G[2*a + 1] = (Y + radius)/r;
}

static void on_the_edge(real u, real *x)        /* by the length of the arc */
{
    if (u <= 0) x[0] = u, x[1] = 0;
    else x[0] = radius*sin(u/radius), x[1] = radius*(cos(u/radius) - 1);
}

/* A rope slides over the edge: energy and links are kept, no bead is inside, and the table may lie at y = 0 */
TEST(a_rope_leaves_an_edge_bead_by_bead)
{
    real ends[2] = { 0, 0 };
    for (int k = 0; k < 2; ++k) {
        contact c = { .count = BEADS, .slots = SLOTS - 1, .gap = edge, .rest = R(1e-3) };
        real q[2*BEADS], v[2*BEADS] = { 0 }, u = R(0.15), E = 0, phi, rate, slope[2*BEADS];
        table = 0;
        for (int i = 0; i < BEADS; ++i) {
            real lo = u - 2*link, hi = u;
            for (int j = 0; i > 0 && j < 200; ++j) {
                u = (lo + hi)/2;
                on_the_edge(u, q + 2*i);
                if (hypot(q[2*i] - q[2*i - 2], q[2*i + 1] - q[2*i - 1]) > link) lo = u; else hi = u;
            }
            on_the_edge(u, q + 2*i);
        }
        table = (real)k;
        for (int i = 0; i < 2*BEADS; ++i) q[i] += table;
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = beads_weight };
        list[1] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = beads_links, .rows = BEADS - 1 };
        begin(&c, (gvi_desc){ .n = 2*BEADS, .degree = 4 }, 2, q, v);
        for (int step = 0; step < 300; ++step) {
            assert_ok(contact_step(&c, R(0.01)));
            for (int a = 0; a < BEADS; ++a) {
                edge(a, 0, c.st.q, &phi, slope, &rate, NULL);
                assert_between(-64*EPS*(4 + fabs(c.st.q[2*a + 1])), phi, 4);
                if (a) assert_close(hypot(c.st.q[2*a] - c.st.q[2*a - 2], c.st.q[2*a + 1] - c.st.q[2*a - 1]), link, 16*EPS);
            }
        }
        for (int i = 0; i < BEADS; ++i)
            E += c.st.q[2*i + 1] - q[2*i + 1] + (c.st.p[2*i]*c.st.p[2*i] + c.st.p[2*i + 1]*c.st.p[2*i + 1])/2;
        assert_close(E + c.energy, 0, KIND == 1 ? R(1e-3) : R(1e-5));     // a bead passes x = 0, where the curvature jumps
        assert_between(BEADS - 3, c.seen[CONTACT_OPENED], BEADS + 2);
        ends[k] = c.st.q[2*BEADS - 1] - table;
    }
    assert_close(ends[0], ends[1], KIND == 1 ? R(2e-3) : R(1e-8));
}

GVI_EACH(load, 3, f) { x->f[0] -= 1, x->f[1] -= R(0.3)*x->t[0], x->f[2] -= R(0.1); }
GAP(legs)
{
    const real X = a & 1 ? 1 : -1, Y = a & 2 ? 1 : -1;
    *phi = q[0] + X*q[1] + Y*q[2] - table, G[0] = 1, G[1] = X, G[2] = Y;
}

/* Four legs and three coordinates: one leg more than can carry.  The load moves to one side, over the edge at t = 10/3; then
   2 q_0'' = .3 t - 1 about the two legs that are left */
TEST(a_table_of_four_legs_tips)
{
    for (int run = 0; run < 8; ++run) {
        const int n = 3 + run/4;
        const real way = run % 2 ? -1 : 1;
        contact c = { .count = 4, .slots = n, .gap = legs };
        table = run & 2 ? R(0.7) : 0;
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = load };
        begin(&c, (gvi_desc){ .n = n, .degree = 4 }, 1, (real[]){ table, 0, 0, 0 }, (real[4]){ 0 });
        go(&c, 3*way, 30);
        for (int i = 0; i < 3; ++i) assert_close(c.st.q[i], i ? 0 : table, 64*EPS);
        real all = 0, most = 0;
        for (int a = 0; a < 4; ++a) all += contact_force(&c, a), most = fmax(most, -contact_force(&c, a));
        assert_close(all, 1, 400*EPS);
        assert_between(0, most, 400*EPS);
        go(&c, 4*way, 10);
        const real since = 4 - R(10.0)/3, lift = R(0.3)*since*since*since/12;
        assert_close(c.st.q[0] - table, lift, 4000*EPS);
        assert_close(c.st.q[1], -way*lift, 4000*EPS);
        assert_close(c.st.q[2], 0, 4000*EPS);
    }
}

static real place;
GAP(corner) { *phi = a ? q[1] : q[0] - place, G[a] = 1; }

GVI_EACH(chain_weight, 6, f) { x->f[1] -= 1, x->f[3] -= 1, x->f[5] -= 1, x->f[0] += *(const real *)user; }
GVI_EACH(chain_rods, 6, rows(3))
{
    for (int a = 0; a < 3; ++a) {
        const real X = x->q[2*a] - (a ? x->q[2*a - 2] : 0), Y = x->q[2*a + 1] - (a ? x->q[2*a - 1] : 0);
        real *G = x->jacobian + 6*a + 2*a;
        x->g[a] = (X*X + Y*Y - 1)/2;
        G[0] = X, G[1] = Y;
        if (a) G[-2] = -X, G[-1] = -Y;
    }
}
GAP(hanging_wall) { *phi = q[2*a], G[2*a] = 1; }

/* Links that hang along a wall touch it without force; pulled against it they press, pulled off they leave */
TEST(links_that_hang_along_a_wall_press_only_where_they_are_pulled)
{
    for (int run = 0; run < 3; ++run) {
        real force = (real)(run - 1)/10;
        contact c = { .count = 3, .slots = 3, .gap = hanging_wall, .touch = 64*EPS };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = chain_weight, .user = &force };
        list[1] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = chain_rods, .rows = 3 };
        begin(&c, (gvi_desc){ .n = 6, .degree = 4 }, 2, (real[]){ 0, -1, 0, -2, 0, -3 }, (real[6]){ 0 });
        go(&c, R(0.5), 10);
        for (int a = 0; a < 3; ++a) {
            if (run < 2) assert_close(c.st.q[2*a], 0, 64*EPS);
            assert_close(contact_force(&c, a), run == 0 && a == 0 ? R(0.1) : 0, 400*EPS);
        }
        if (run == 2) assert_true(c.st.q[0] > R(0.005));
    }
}

/* A ball that lies in a corner and nears its wall, or leaves it, by rounding of its place in a step: it stays, or goes */
TEST(a_ball_that_lies_in_a_corner_stays_there)
{
    for (int run = 0; run < 64; ++run) {
        const real way = run % 2 ? 1 : -1, speed = 32*way*EPS*pow(R(10.0), -(real)(run % 16)/4);
        contact c = { .count = 2, .slots = 2, .gap = corner, .rest = run % 4 < 2 ? R(1e-3) : 0 };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
        place = run & 32 ? R(1.0) : 0;
        begin(&c, (gvi_desc){ .n = 2, .degree = 4 }, 1, (real[]){ place, 0 }, (real[]){ speed, 0 });
        go(&c, 40, 400);
        assert_between(1, events, 10);
        assert_between(-72*EPS*place, c.st.q[0] - place, 40*fabs(speed) + 8*EPS);
        assert_close(c.st.q[1], 0, 8*EPS);
        assert_close(contact_force(&c, 1), 1, 400*EPS);
    }
}

GVI_EACH(one_rod, 2, rows(1))
{
    x->g[0] = (x->q[0]*x->q[0] + x->q[1]*x->q[1] - 1)/2;
    x->jacobian[0] = x->q[0], x->jacobian[1] = x->q[1];
}
GAP(stop)                                       /* a wall at the angle 2w - 0.7 from the lowest point */
{
    const real w = place;
    *phi = cos(w)*q[0] + sin(w)*q[1] - sin(w - R(0.7)), G[0] = cos(w), G[1] = sin(w);
}

/* A pendulum meets walls of many slopes, e = 0: all its speed goes, and it leans there */
TEST(a_pendulum_stops_dead)
{
    for (int run = 0; run < 40; ++run) {
        place = R(0.36) + R(0.027)*(real)run;
        const real from = R(2.5), at = 2*place - R(0.7);
        contact c = { .count = 1, .slots = 1, .gap = stop };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
        list[1] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = one_rod, .rows = 1 };
        begin(&c, (gvi_desc){ .n = 2, .degree = 5 }, 2, (real[]){ sin(from), -cos(from) }, (real[]){ 0, 0 });
        go(&c, 8, 80);
        assert_int_equal(events, 2);
        assert_int_equal(seen[0].kind, CONTACT_IMPACT);
        assert_int_equal(seen[1].kind, CONTACT_CLOSED);
        assert_close(c.st.q[0], sin(at), 64*EPS);
        assert_close(c.st.q[1], -cos(at), 64*EPS);
        assert_close(contact_force(&c, 0), sin(at)/cos(place - R(0.7)), 400*EPS);
    }
}

/* ---- friction ---- */

static friction rub;
static real pull;
GVI_EACH(drag_and_weight, 2, f) { x->f[0] += pull*x->t[0], x->f[1] -= 1; }
GVI_EACH(bowl, 2, rows(1))
{
    const real X = x->q[0], Y = x->q[1], r = sqrt(X*X + Y*Y);
    x->g[0] = 1 - r, x->jacobian[0] = -X/r, x->jacobian[1] = -Y/r;
}
GVI_EACH(along, 2, rows(1))
{
    const real r = hypot(x->q[0], x->q[1]);
    x->jacobian[0] = -x->q[1]/r, x->jacobian[1] = x->q[0]/r;
}
GVI_EACH(slips, 2, v, f)
{
    const real X = x->q[0], Y = x->q[1], r = sqrt(X*X + Y*Y), w = (X*x->v[1] - Y*x->v[0])/r,
               N = w*w/r + (X*pull*x->t[0] - Y)/r;
    x->f[0] += rub.mu*rub.sign*N*Y/r, x->f[1] -= rub.mu*rub.sign*N*X/r;
}
static real speed_along(real t, const real *q, const real *v, void *user)
{
    return (void)t, (void)user, (q[0]*v[1] - q[1]*v[0])/hypot(q[0], q[1]);
}

static void rub_in_a_bowl(int degree, real mu, real from)
{
    static gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = drag_and_weight },
                                  { .kind = GVI_CONSTRAINT, .points = bowl, .rows = 1 },
                                  { .kind = GVI_NONHOLONOMIC, .points = along, .rows = 1 },
                                  { .kind = GVI_FORCE, .points = slips } };
    const gvi_desc desc = { .n = 2, .degree = degree, .effects = scene, .effect_count = 4 };
    rub = (friction){ .contact = 1, .stick = 2, .slip = 3, .mu = mu, .speed = speed_along };
    assert_between(1, friction_size(&desc), sizeof memory);
    assert_int_equal(friction_init(&rub, &desc, (real *)memory, friction_size(&desc) - 1), GVI_E_MEMORY);
    assert_ok(friction_init(&rub, &desc, (real *)memory, friction_size(&desc)));
    assert_ok(friction_start(&rub, 0, (real[]){ sin(from), -cos(from) }, (real[]){ 0, 0 }));
}

/* u = v^2 over the angle w from rest at `from`, s the sign: u' = -2 sin w - 2 mu s (u + cos w) */
static wide square_of_speed(wide w, wide from, wide mu, wide s)
{
    const wide k = 2*mu*s, b = -3*k/(1 + k*k), a = -1 - b/k;
    return a*cosl(w) + b*sinl(w) - (a*cosl(from) + b*sinl(from))*expl(-k*(w - from));
}

/* Slides there and back from -1.2 until it sticks; where, and after how many stops, is in closed form */
TEST(a_bead_in_a_bowl_stops_where_friction_says)
{
    wide stop[8], from = -1.2L;
    int stops = 0;
    for (wide s = 1; stops < 8 && (stops == 0 || fabsl(tanl(from)) > (wide)R(0.2)); s = -s) {
        wide lo = from + s*1e-3L, hi = lo;
        while (square_of_speed(hi, from, R(0.2), s) > 0) hi += s*0.01L;
        for (int k = 0; k < 100; ++k) {
            const wide w = (lo + hi)/2;
            if (square_of_speed(w, from, R(0.2), s) > 0) lo = w; else hi = w;
        }
        from = stop[stops++] = lo;
    }
    assert_between(2, stops, 6);
    for (int s = 1; s <= 5; ++s) {
        real error[3];
        for (int k = 0; k < 3; ++k) {
            pull = 0;
            rub_in_a_bowl(s, R(0.2), R(-1.2));
            assert_true(rub.sign > 0);
            for (int i = 0; i < 32 << k; ++i) {
                assert_ok(friction_step(&rub, R(14.0)/(real)(32 << k)));
                assert_close(hypot(rub.st.q[0], rub.st.q[1]), 1, 8*EPS);
            }
            assert_int_equal(rub.stops, stops);
            assert_int_equal(rub.breaks, 0);
            assert_true(rub.sign == 0);
            const wide last = atan2l((wide)rub.st.q[0], -(wide)rub.st.q[1]);
            error[k] = (real)fabsl(last - stop[stops - 1]);
        }
        assert_order(error + 1, 2, s, 16*EPS);
        assert_between(0, error[2], s < 4 ? 1 : 16*EPS + R(1e-14));
    }
}

/* At the lowest point, a side force that grows like t/20 breaks it away where that is mu; from there
   v v' = t/20 cos w - sin w - mu (v^2 + t/20 sin w + cos w), by Runge's and Kutta's method */
TEST(a_bead_breaks_away)
{
    for (int way = -1; way <= 1; way += 2) {
        pull = (real)way/20;
        rub_in_a_bowl(4, R(0.3), 0);
        assert_true(rub.sign == 0);
        for (int i = 0; i < 12; ++i) assert_ok(friction_step(&rub, R(0.4)));
        assert_int_equal(rub.breaks, 0);
        assert_close(rub.st.q[0], 0, 64*EPS);
        for (int i = 0; i < 40; ++i) assert_ok(friction_step(&rub, R(0.1)));
        assert_int_equal(rub.breaks, 1);
        assert_true(rub.sign == way);

        wide y[2] = { 0, 0 };
        const wide mu = (wide)R(0.3), from = 20*mu, h = ((wide)rub.st.t - from)/4000;
        for (int i = 0; i < 4000; ++i) {
            wide k[4][2], z[2];
            for (int j = 0; j < 4; ++j) {
                const wide part = j == 0 ? 0 : j == 3 ? h : h/2, drag = (from + (wide)i*h + part)/20;
                for (int c = 0; c < 2; ++c) z[c] = y[c] + (j ? part*k[j - 1][c] : 0);
                k[j][0] = z[1];
                k[j][1] = drag*cosl(z[0]) - sinl(z[0]) - mu*(z[1]*z[1] + drag*sinl(z[0]) + cosl(z[0]));
            }
            for (int c = 0; c < 2; ++c) y[c] += h*(k[0][c] + 2*k[1][c] + 2*k[2][c] + k[3][c])/6;
        }
        assert_close((real)(way*asinl((wide)rub.st.q[0])), (real)y[0], 16*EPS + R(1e-14));
    }
}

/* ---- decisions ---- */

/* z >= 0, y = W z + b >= 0, z'y = 0, by the definition: of random contacts, more of them than coordinates in half of all */
TEST(complementarity_is_solved)
{
    dice = 1;
    for (int run = 0; run < 20000; ++run) {
        const int k = 1 + (int)(uniform()*12), n = 1 + (int)(uniform()*12);
        real G[12][12], W[144], b[12], z[12], v[12], size = 0;
        for (int i = 0; i < n; ++i) v[i] = random_unit();
        for (int a = 0; a < k; ++a) {
            const int twin = a > 0 && uniform() < R(0.1);
            b[a] = 0;
            for (int i = 0; i < n; ++i) G[a][i] = twin ? 2*G[a - 1][i] : (uniform() < R(0.3) ? 0 : random_unit()) + (i ? 0 : R(1.2));
            for (int i = 0; i < n; ++i) b[a] += G[a][i]*v[i];
            size += fabs(b[a]);
        }
        for (int a = 0; a < k*k; ++a) {
            W[a] = 0;
            for (int i = 0; i < n; ++i) W[a] += G[a/k][i]*G[a % k][i];
        }
        assert_true(contact__lcp(k, W, b, z));               // G_1 > 0 parts them all: there is one
        for (int a = 0; a < k; ++a) {
            real y = b[a];
            for (int j = 0; j < k; ++j) y += W[a*k + j]*z[j];
            assert_true(z[a] >= 0);
            assert_between(-sqrt(EPS)*(1 + size), y, z[a] > 0 ? sqrt(EPS)*(1 + size) : MAX);
        }
    }
}

GAP(fan)                                        /* twelve half planes around the origin's lower side */
{
    const real w = (real)(a - 6)/5;
    *phi = q[1] + w*q[0], G[0] = w, G[1] = 1;
}

/* All at once into a corner of many planes, each with an e of its own: energy is never gained, nothing approaches then */
TEST(impacts_never_gain_energy)
{
    dice = 2;
    for (int run = 0; run < 300; ++run) {
        real e[12], m[2] = { R(0.1) + uniform(), R(0.1) + uniform() }, v[2] = { random_unit(), -R(0.1) - uniform() }, was = 0, is = 0;
        contact c = { .count = 12, .slots = 2, .gap = fan, .e = e, .in_turn = run % 2 };
        for (int i = 0; i < 12; ++i) e[i] = run % 3 ? uniform() : 1;
        begin(&c, (gvi_desc){ .n = 2, .degree = 2, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } }, 0,
              (real[]){ 0, 0 }, v);
        const gvi_status status = contact_step(&c, R(0.01));
        if (status == (gvi_status)CONTACT_E_JAMMED && c.in_turn) continue;    // e = 1 in a wedge, ten thousand in turn
        assert_int_equal(status, 0);
        for (int i = 0; i < 2; ++i) was += m[i]*v[i]*v[i]/2, is += c.st.p[i]*c.st.p[i]/m[i]/2;
        assert_between(-64*EPS, is, was*(1 + 4000*EPS));
        assert_close(is + c.energy, was, 1000*EPS);
        for (int a = 0; a < 12; ++a) assert_between(-64*EPS, c.st.q[1] + (real)(a - 6)/5*c.st.q[0], 1);
    }
}

GVI_EACH(upwards, 2, f) { x->f[1] -= 1; }
GAP(ceiling) { *phi = -q[1], G[1] = -1; }

/* It turns a little below, at, a little above the ceiling at t = 1 */
TEST(a_gap_that_turns_at_0_is_grazed)
{
    const real near = KIND == 1 ? R(1e-4) : R(1e-9);
    for (int i = -1; i <= 1; ++i) {
        contact c = { .count = 1, .slots = 1, .gap = ceiling };
        list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = upwards };
        begin(&c, (gvi_desc){ .n = 2, .degree = 4 }, 1, (real[]){ 0, R(-0.5) + (real)i*near }, (real[]){ 0, 1 });
        go(&c, 2, 9);
        assert_int_equal(c.seen[CONTACT_IMPACT], i > 0);
        if (i < 1) assert_int_equal(c.seen[CONTACT_GRAZED], i == 0);
        if (i > 0) assert_close(seen[0].t, 1 - sqrt(2*near), KIND == 1 ? R(1e-3) : R(1e-10));
    }
}

/* Contact that is far changes no bit of the motion */
TEST(an_open_contact_changes_nothing)
{
    contact c = { .count = 2, .slots = 2, .gap = sphere_and_floor };
    list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
    begin(&c, (gvi_desc){ .n = 2, .degree = 5 }, 1, (real[]){ 2, 30 }, (real[]){ 1, 3 });
    gvi_stepper st = new_motion(&(gvi_desc){ .n = 2, .degree = 5, .effects = list, .effect_count = 1 }, 0,
                                (real[]){ 2, 30 }, (real[]){ 1, 3 });
    for (int k = 0; k < 40; ++k) {
        assert_ok(gvi_step(&st, R(0.1)));
        assert_ok(contact_step(&c, R(0.1)));
        assert_same_numbers(c.st.q, st.q, 2);
        assert_same_numbers(c.st.p, st.p, 2);
    }
}

GAP(closing_walls)
{
    if (a == 0) *phi = q[0] + 1, G[0] = 1;
    else *phi = 1 - t - q[0], G[0] = -1, *rate = -1;
}
GVI_EACH(pinned, 2, rows(1)) { x->g[0] = x->q[0], x->jacobian[0] = 1; }
GAP(coming_wall) { *phi = 1 - t - q[0], G[0] = -1, *rate = -1; (void)a; }
GAP(under) { *phi = q[2*a + 1], G[2*a + 1] = 1; }
GAP(wrong_slope) { *phi = q[1], G[1] = 2; }
GAP(floors) { *phi = q[1], G[0] = 0, G[1] = 1 + (real)a; *phi *= 1 + (real)a; }

GAP(crowd) { *phi = q[1], G[1] = 1; (void)a; }

/* No trace: the same state, and the next steps are those of a twin of whom nothing was wanted; to the rounding that a step
   carries over, unless it is a start that is refused */
#define REFUSED(c, twin, room, status, call) do { \
    SAME_STATE(&(c).st) assert_int_equal(call, status); \
    for (int k_ = 0; k_ < 5; ++k_) { \
        assert_ok(contact_step(&(c), R(0.01))); \
        assert_ok(contact_step(&(twin), R(0.01))); \
        for (int i_ = 0; i_ < (c).st.n; ++i_) { \
            assert_close((c).st.q[i_], (twin).st.q[i_], room); \
            assert_close((c).st.p[i_], (twin).st.p[i_], room); \
        } \
        for (int a_ = 0; a_ < (c).count; ++a_) \
            assert_close(contact_force(&(c), a_), contact_force(&(twin), a_), 50*(room)); \
    } } while (0)

/* The same motion twice: c in list[], twin in a list and memory of its own */
static void twins(contact *c, contact *twin, gvi_desc desc, const real *q, const real *v)
{
    static gvi_effect other[2 + SLOTS];
    static long double store[1 << 16];
    *twin = *c;
    begin(c, desc, 1, q, v);
    other[0] = list[0];
    contact_rows(twin, other + 1);
    desc.effects = other, desc.effect_count = 1 + twin->slots;
    assert_ok(contact_init(twin, &desc, (real *)store, sizeof store));
    assert_ok(contact_start(twin, 0, q, v));
}

TEST(what_cannot_be_is_refused_and_leaves_no_trace)
{
    real e = R(0.99);
    contact twin, c = { .count = 2, .slots = 2, .gap = sphere_and_floor };
    const gvi_desc desc = { .n = 2, .degree = 4 };
    list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };

    twins(&c, &twin, desc, (real[]){ sin(R(0.3)), cos(R(0.3)) }, (real[]){ 0, 0 });         // presses on the sphere
    go(&c, R(0.2), 2);
    go(&twin, R(0.2), 2);
    REFUSED(c, twin, 0, CONTACT_E_PENETRATES, contact_start(&c, 0, (real[]){ 0, R(0.999) }, (real[]){ 0, 0 }));
    assert_int_equal(contact_start(&c, 0, (real[]){ 0, R(0.999) }, (real[]){ 0, 0 }), CONTACT_E_PENETRATES);
    assert_int_equal(c.fault, 0);
    REFUSED(c, twin, 0, GVI_E_ARGUMENT, contact_start(&c, 0, (real[]){ 0, 2 }, (real[]){ MAX*2, 0 }));
    c.gap = wrong_slope;
    SAME_STATE(&c.st) assert_int_equal(contact_start(&c, 0, (real[]){ 0, 1 }, (real[]){ 0, 0 }), GVI_E_ARGUMENT);
    assert_int_equal(c.fault, 0);
    assert_non_null(strstr(contact_why(&c, GVI_E_ARGUMENT), "jacobian"));
    c.gap = sphere_and_floor;
    REFUSED(c, twin, 0, CONTACT_E_PENETRATES, contact_start(&c, 0, (real[]){ 0, -2 }, (real[]){ 0, 0 }));
    assert_int_equal(c.fault, -1);                                              // of the steps since

    c = (contact){ .count = 2, .slots = 2, .gap = closing_walls };             // they meet at t = 2
    twins(&c, &twin, desc, (real[]){ 0, 0 }, (real[]){ R(-0.3), 0 });
    go(&c, R(1.9), 19);
    go(&twin, R(1.9), 19);
    SAME_STATE(&c.st) assert_int_equal(contact_step(&c, R(0.2)), CONTACT_E_JAMMED);
    assert_between(0, c.fault, 1);
    REFUSED(c, twin, 8*EPS, CONTACT_E_JAMMED, contact_step(&c, R(0.2)));

    c = (contact){ .count = 1, .slots = 1, .gap = coming_wall };               // cannot give way: x is held
    list[0] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = pinned, .rows = 1 };
    twins(&c, &twin, desc, (real[]){ 0, 0 }, (real[]){ 0, 1 });
    REFUSED(c, twin, 8*EPS, CONTACT_E_JAMMED, contact_step(&c, 2));
    assert_ok(contact_step(&c, R(0.5)));
    list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };

    c = (contact){ .count = 1, .slots = 1, .gap = floors, .e = &e, .most = 20 };   // a bounce of ever less
    twins(&c, &twin, desc, (real[]){ 0, R(1e-3) }, (real[]){ 0, 0 });
    REFUSED(c, twin, 8*EPS, CONTACT_E_PILE_UP, contact_step(&c, 10));

    c = (contact){ .count = 2, .slots = 1, .gap = under };                     // two fall on the floor, one slot
    list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = pull_bobs };
    twins(&c, &twin, (gvi_desc){ .n = 4, .degree = 2 }, (real[]){ 0, 1, 0, 1 }, (real[4]){ 0 });
    REFUSED(c, twin, 8*EPS, CONTACT_E_TOO_MANY, contact_step(&c, 2));

    c = (contact){ .count = CONTACT_TOUCH + 1, .slots = 1, .gap = crowd };     // more touch than there is room for
    list[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight };
    twins(&c, &twin, desc, (real[]){ 0, 1 }, (real[]){ 0, 0 });
    REFUSED(c, twin, 8*EPS, CONTACT_E_TOO_MANY, contact_step(&c, 2));

    c = (contact){ .count = 3, .slots = 0, .gap = hanging_wall };
    contact_rows(&c, list);
    assert_int_equal(contact_init(&c, &desc, (real *)memory, sizeof memory), GVI_E_ARGUMENT);
    c.slots = 1;
    assert_int_equal(contact_init(&c, &desc, (real *)memory, 100), GVI_E_ARGUMENT);
}

RUN_TESTS(NULL, NULL)
