/* long.c - long runs: a chaotic double pendulum, the figure-eight, angles that wind up

   Chaotic pendulum: relative angles, m = l = 1, g = 9.8, from rest at q = (2, 1), 10^7 steps of
   1/128 with degree 8.  A straight line through 1000 samples of the energy error; samples of a
   walk are not independent, so the line's own standard error is that of ten lines through
   its tenths, whose slopes are.  The walk to expect: dp and dq of a step are wrong by EPS/2 of
   themselves, and the force by EPS/2 of q times its derivative, 3 g or less: the angles
   wind up, and sin(q) of a large q has lost digits.
   Figure-eight (Chenciner, Montgomery 2000; start by Simo): stable, so it stays on its curve.
   Winding: the same pendulum with 1e6 turns added to its first angle, and q'' = -sin q
   spinning through 1e6 turns.                                                 */
#include "pendulum.h"

static gvi_stepper *start_pendulum(double turns)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    static gvi_stepper st;
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pendulum_forces } };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1,
                            .mass = pendulum_inertia };
    const double q[2] = { 2 + 2*acos(-1)*turns, 1 }, p[2] = { 0, 0 };
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start_momentum(&st, 0, q, p));
    return &st;
}

static void chaotic_pendulum(long steps)
{
    enum { SAMPLES = 1000, PARTS = 10 };
    static double at[SAMPLES], error[SAMPLES];
    gvi_stepper *st = start_pendulum(0);
    const long double E0 = pendulum_energy(st->q, st->p);
    double worst = 0, mean = 0, spread = 0, walk = 0;
    for (int k = 0; k < SAMPLES; ++k) {
        for (long m = 0; m < steps/SAMPLES; ++m) {
            const double u = st->p[0], w = st->p[1];
            double v[2];
            must(gvi_step(st, 1.0/128));
            must(gvi_velocity(st, v));
            const double speed = fabs(v[0]) + fabs(v[1]), far = fmax(1, fabs(st->q[0]) + fabs(st->q[1]));
            walk += pow(fabs(v[0]*(st->p[0] - u)) + fabs(v[1]*(st->p[1] - w)), 2)/6 + pow(speed*far*29.4/128,
                                                                                          2)/12;
        }
        at[k] = (k + 1)/(double)SAMPLES;
        error[k] = (double)(pendulum_energy(st->q, st->p)/E0 - 1);
        worst = fmax(worst, fabs(error[k]));
        progress("chaotic pendulum", k + 1, SAMPLES);
    }
    const double slope = slope_of(SAMPLES, at, error, NULL);
    // a random walk: increments of the tenths are independent, their mean is the slope's estimate
    double step[PARTS];
    for (int k = 0; k < PARTS; ++k) {
        step[k] = error[(k + 1)*SAMPLES/PARTS - 1] - (k ? error[k*SAMPLES/PARTS - 1] : 0);
        mean += step[k]/PARTS;
    }
    for (int k = 0; k < PARTS; ++k) spread += (step[k] - mean)*(step[k] - mean)/(PARTS - 1);
    printf("  max |dE/E| %.2g, line through all %.2g over the run, walk of the tenths %.2g each\n", worst,
           slope, sqrt(spread));
    expect("mean of the tenths over its standard error (t, 9 degrees)", -4, mean/sqrt(spread/PARTS), 4);
    expect("line over what a walk of such tenths gives it", -4, slope/(sqrt(1.2*spread*PARTS)), 4);
    walk = DBL_EPSILON*sqrt(walk)/(double)fabsl(E0);
    printf("  q = %.0f %.0f at the end; walk of the roundings %.1e\n", st->q[0], st->q[1], walk);
    expect("max |dE/E| in units of that walk", 0.02, worst/walk, 4);
}

/* -------------------------------------------------------------- figure-eight */

static int gravity(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k)
        for (int a = 1; a < 3; ++a)
            for (int b = 0; b < a; ++b) {
                const int i = 2*a*x->stride + k, j = 2*b*x->stride + k, d = x->stride;
                const double u = x->q[i] - x->q[j], v = x->q[i + d] - x->q[j + d];
                const double r2 = u*u + v*v, w = 1/(r2*sqrt(r2));
                x->f[i] -= w*u;  x->f[i + d] -= w*v;
                x->f[j] += w*u;  x->f[j + d] += w*v;
            }
    return 0;
}

static long double eight_energy(const double *q, const double *p)
{
    long double E = 0;
    for (int i = 0; i < 6; ++i) E += (long double)p[i]*p[i]/2;
    for (int a = 1; a < 3; ++a)
        for (int b = 0; b < a; ++b) E -= 1/hypotl((long double)q[2*a] - q[2*b],
                                                  (long double)q[2*a + 1] - q[2*b + 1]);
    return E;
}

/* 10,000 periods of 6.3259: after each, the bodies are where they began but for a phase */
static void figure_eight(void)
{
    static double memory[GVI_LENGTH(6, 8, 8)];
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    const gvi_desc desc = { .n = 6, .effects = scene, .effect_count = 1 };
    const double q[6] = { 0.97000436, -0.24308753, -0.97000436, 0.24308753, 0, 0 };
    const double u = -0.93240737, v = -0.86473146, w[6] = { -u/2, -v/2, -u/2, -v/2, u, v };
    enum { PERIODS = 10000, STEPS = 64 };
    gvi_stepper st;
    double worst = 0, widest = 0, L = 0;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q, w));
    const long double E0 = eight_energy(st.q, st.p);
    for (long k = 0; k < (long)PERIODS*STEPS; ++k) {
        must(gvi_step(&st, 6.32591398/STEPS));
        widest = fmax(widest, fabs(st.q[0]));
        if (k % STEPS) continue;
        progress("figure-eight", k/STEPS + 1, PERIODS);
        worst = fmax(worst, (double)fabsl(eight_energy(st.q, st.p)/E0 - 1));
        L = 0;
        for (int b = 0; b < 3; ++b) L += st.q[2*b]*st.p[2*b + 1] - st.q[2*b + 1]*st.p[2*b];
    }
    printf("  %d periods, %.1f iterations a step\n", PERIODS,
           (double)st.counters.iterations/(double)st.counters.steps);
    expect("energy error", 0, worst, 4*sqrt((double)PERIODS*STEPS)*DBL_EPSILON);
    expect("angular momentum, 0 at the start", 0, fabs(L), 4*sqrt((double)PERIODS*STEPS)*DBL_EPSILON);
    expect("width of the eight", 1.05, widest, 1.10);
}

/* -------------------------------------------------------------------- winding */

static int pendulum(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        if (x->value) x->value[k] -= cos(x->q[k]);
        else x->f[k] -= sin(x->q[k]);
    }
    return 0;
}

/* A spinning pendulum: E = p^2/2 - cos q = 31, q through 1e6 turns.  sin(q) is that of an angle
   wrong by EPS/2 of it: v h dF = 8/8 EPS/sqrt(12) q a step, at random, q up to 6.3e6  */
static void winding(void)
{
    static double memory[GVI_LENGTH(1, 8, 8)];
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pendulum, .value = pendulum } };
    const gvi_desc desc = { .n = 1, .effects = scene, .effect_count = 1 };
    gvi_stepper st;
    double E0 = 0, E = 0, worst = 0;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, (double[]){ 0 }, (double[]){ 8 }));
    must(gvi_energy(&st, &E0));
    while (st.q[0] < 2*acos(-1)*1e6) {
        must(gvi_step(&st, 0.125));
        must(gvi_energy(&st, &E));
        worst = fmax(worst, fabs(E/E0 - 1));
    }
    printf("  %llu steps, %.0f turns\n", st.counters.steps, st.q[0]/(2*acos(-1)));
    expect("energy error, |q| to 6e6", 0, worst,
           4*sqrt((double)st.counters.steps/3)*6.3e6*DBL_EPSILON/sqrt(12)/31);

    // 1e6 turns away the same pendulum, as far as the angle can tell
    double q[2];
    gvi_stepper *one = start_pendulum(0);
    for (int k = 0; k < 128; ++k) must(gvi_step(one, 1.0/64));
    memcpy(q, one->q, sizeof q);
    one = start_pendulum(1e6);
    for (int k = 0; k < 128; ++k) must(gvi_step(one, 1.0/64));
    expect("start 1e6 turns away, t = 2: difference of the other angle", 0, fabs(one->q[1] - q[1]),
           6.3e6*DBL_EPSILON*100);
}

/* t near 1e9 with h = 1e-3: q'' = -q + cos(t/2); 1e6 steps of h, t exact at the end.  The
   response to the driving is 4/3 cos(t/2), and t in the effect is known to EPS/2 1e9  */
static int driven(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] += cos(t/2) - q[0];
    return 0;
}

static void late(void)
{
    static double memory[GVI_LENGTH(1, 4, 4)];
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = driven } };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = scene, .effect_count = 1 };
    const double t0 = 1e9;
    const double q = 4*cos(t0/2)/3, v = -2*sin(t0/2)/3;
    gvi_stepper st;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, t0, &q, &v));
    for (int k = 0; k < 1000000; ++k) must(gvi_step(&st, 1e-3));
    expect("t = 1e9, 1e6 steps of 1e-3: error of t", 0, fabs(st.t - (t0 + 1e6*1e-3)), 1e9*DBL_EPSILON);
    expect("error of q, in units of the rounding of t", 0,
           (double)fabsl(st.q[0] - 4*cosl(((long double)t0 + 1e6L*1e-3)/2)/3)/(t0*DBL_EPSILON/2), 10);
}

int main(int argc, char **argv)
{
    const long steps = argc > 1 ? atol(argv[1]) : 10000000;
    printf("Chaotic double pendulum, %ld steps\n", steps);
    chaotic_pendulum(steps);
    printf("Figure-eight\n");
    figure_eight();
    printf("Angles that wind up, and late times\n");
    winding();
    late();
    return verdict("long");
}
