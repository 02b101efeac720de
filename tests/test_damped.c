/* examples/tools/damped.h: friction that is exact between explicit steps.  What is expected are closed forms,
   and what linear friction does to momentum and to areas. */
#include "gvi_test.h"
#include "tools/damped.h"

enum { N = 6 };
static real work[2*N];
static const real middle[] = { R(0.5) }, whole[] = { 1 };
static const gvi_rule drift_kick_drift = { .kind = GVI_KICKS, .points = 1, .nodes = middle, .weights = whole };

/* q'' = -k q - c q' with k = 5/4, c = 1/2:  q = e^(-at) (cos wt + a/w sin wt), a = c/2, w^2 = k - a^2 */
GVI_EACH(spring, 1, f) { x->f[0] -= R(1.25)*x->q[0]; }

static void linear(real h, const real *q, real *p, void *user)
{
    const int n = *(int *)user;
    for (int i = 0; i < n; ++i) p[i] *= exp(-h/2);
}

/* q'' = g - |q'| q', g = 2:  at rest q = log(cosh(t sqrt(g))) at t = 0; from t = 1/2 on, where |q'|q' is smooth */
GVI_EACH(fall, 1, f) { x->f[0] += 2; }
static void air(real h, const real *q, real *p, void *user) { p[0] /= 1 + fabs(p[0])*h; }

/* Error of position and momentum at t = 2; fourth: three runs in the place of a step. */
static real error(int drag, int steps, int fourth)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring }, { .kind = GVI_POTENTIAL, .points = fall } };
    const gvi_desc desc = { .n = 1, .rule = drift_kick_drift, .effects = scene + drag, .effect_count = 1 };
    const real h = 2/(real)steps, g = 1/(2 - cbrt(R(2.0))), part[] = { g, 1 - 2*g, g };
    const long double a = 0.25L, w = sqrtl(1.1875L), e = expl(-2*a), b = sqrtl(2);
    int n = 1;
    gvi_stepper st = new_motion(&desc, 0, (real[]){ drag ? log(cosh((real)b/2)) : 1 }, (real[]){ drag ? (real)b*tanh((real)b/2) : 0 });
    for (int k = 0; k < steps && fourth; ++k)
        for (int j = 0; j < 3; ++j) assert_ok(damped_steps(&st, part[j]*h, 1, drag ? air : linear, &n, work));
    if (!fourth) {
        assert_ok(damped_steps(&st, h, steps, drag ? air : linear, &n, work));
        assert_int_equal((int)st.counters.effect[0], steps);          /* one evaluation a step */
    }
    assert_close(st.t, 2, 8*(real)steps*EPS);
    const long double q = drag ? logl(coshl(2.5L*b)) : e*(cosl(2*w) + a/w*sinl(2*w));
    const long double p = drag ? b*tanhl(2.5L*b) : -e*1.25L/w*sinl(2*w);
    return fmax(fabs(st.q[0] - (real)q), fabs(st.p[0] - (real)p));
}

TEST(orders_are_2_and_4)
{
    for (int drag = 0; drag < 2; ++drag) {
        const int steps = DIG < 50 ? 16 : 64;
        const real coarse = error(drag, steps, 0), fine = error(drag, 2*steps, 0);
        assert_between(1.95L, log2(coarse/fine), 2.05L);
        if (DIG < 50) continue;
        const real rough = error(drag, 40, 1), better = error(drag, 80, 1);
        assert_between(3.85L, log2(rough/better), 4.15L);
    }
}

/* Three particles in a plane, all pairs on springs of rest length 1. */
static int pairs(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < i; ++j) {
                const real a = x->q[2*i*s+k] - x->q[2*j*s+k], b = x->q[(2*i+1)*s+k] - x->q[(2*j+1)*s+k];
                const real d = sqrt(a*a + b*b), w = (d - 1)/d;
                x->f[2*i*s+k] -= w*a, x->f[(2*i+1)*s+k] -= w*b;
                x->f[2*j*s+k] += w*a, x->f[(2*j+1)*s+k] += w*b;
            }
    return 0;
}

/* Momentum and angular momentum decay by exp(-t/2), for steps that resolve nothing of it. */
TEST(momenta_decay_exactly)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pairs } };
    static const real mass[] = { 1, 1, 2, 2, R(0.5), R(0.5) };
    const gvi_desc desc = { .n = N, .rule = drift_kick_drift, .effects = scene, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
    int n = N;
    real first[3], now[3];
    gvi_stepper st = new_motion(&desc, 0, (real[]){ 0, 0, 1, R(0.25), R(0.25), 1 }, (real[]){ 1, 0, R(0.5), R(0.25), -1, 2 });
    for (int k = 0; k <= 20; ++k) {
        now[0] = now[1] = now[2] = 0;
        for (int i = 0; i < 3; ++i) {
            now[0] += st.p[2*i];
            now[1] += st.p[2*i+1];
            now[2] += st.q[2*i]*st.p[2*i+1] - st.q[2*i+1]*st.p[2*i];
        }
        for (int i = 0; i < 3; ++i) {
            if (k == 0) first[i] = now[i];
            else assert_close(now[i], first[i]*exp(-st.t/2), 32*EPS);
        }
        assert_ok(damped_steps(&st, R(0.25), 2, linear, &n, work));
    }
}

/* The matrix of a step of a linear scene: M'JM = exp(-c h) J. */
TEST(areas_shrink_exactly)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    const gvi_desc desc = { .n = 1, .rule = drift_kick_drift, .effects = scene, .effect_count = 1 };
    static const real h[] = { R(0.125), R(0.5), R(1.5), R(-1.5) };
    for (int i = 0; i < COUNT(h); ++i) {
        real M[2][2];
        int n = 1;
        for (int j = 0; j < 2; ++j) {
            gvi_stepper st = new_motion(&desc, 0, (real[]){ j == 0 }, (real[]){ j == 1 });
            assert_ok(damped_steps(&st, h[i], 1, linear, &n, work));
            M[j][0] = st.q[0];
            M[j][1] = st.p[0];
        }
        assert_close(M[0][0]*M[1][1] - M[0][1]*M[1][0], exp(-h[i]/2), 16*EPS);
    }
}

static int limit;

static int fails(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= x->q[k];
    return limit-- <= 0;
}

/* The third of five steps fails: two are done, as if these had been all; and a first one leaves all as it was. */
TEST(a_step_that_fails_leaves_those_before)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = fails } };
    const gvi_desc desc = { .n = 1, .rule = drift_kick_drift, .effects = scene, .effect_count = 1 };
    real q, p;
    int n = 1;
    limit = 9;                                     // the first start looks, too
    gvi_stepper st = new_motion(&desc, 0, (real[]){ 1 }, (real[]){ 2 });
    limit = 2;
    assert_ok(damped_steps(&st, R(0.25), 2, linear, &n, work));
    q = st.q[0], p = st.p[0];
    limit = 0;
    assert_status(damped_steps(&st, R(0.25), 5, linear, &n, work), GVI_E_CALLBACK);
    assert_true(st.q[0] == q && st.p[0] == p && st.t == R(0.5));
    assert_ok(gvi_start(&st, 0, (real[]){ 1 }, (real[]){ 2 }));
    limit = 2;
    assert_status(damped_steps(&st, R(0.25), 5, linear, &n, work), GVI_E_CALLBACK);
    assert_true(st.q[0] == q && st.p[0] == p && st.t == R(0.5));
    assert_status(st.status, GVI_E_CALLBACK);
}

static int until;
static void breaks(real h, const real *q, real *p, void *user)
{
    linear(h, q, p, user);
    if (until-- == 0) p[0] = (real)NAN;
}

/* once: half of it for the end of the second step is there */
TEST(friction_that_fails_leaves_the_steps_before)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = fails } };
    const gvi_desc desc = { .n = 1, .rule = drift_kick_drift, .effects = scene, .effect_count = 1 };
    int n = 1;
    limit = 1000;
    gvi_stepper st = new_motion(&desc, 0, (real[]){ 1 }, (real[]){ 2 });
    assert_ok(damped_steps(&st, R(0.25), 2, linear, &n, work));
    const real q = st.q[0], p = st.p[0];
    assert_ok(gvi_start(&st, 0, (real[]){ 1 }, (real[]){ 2 }));
    until = 2;
    assert_status(damped_steps(&st, R(0.25), 5, breaks, &n, work), GVI_E_ARGUMENT);
    assert_true(st.q[0] == q && st.p[0] == p && st.t == R(0.5));
}

RUN_TESTS(NULL, NULL)
