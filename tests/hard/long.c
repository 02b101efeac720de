/* long.c - long runs in float or double: drift, compensation, a clock, kicks, Newton, large numbers

   Bounds are laws, not figures:

     walk    standard deviation of E/E(0) - 1 if dq and dp of each step are wrong by EPS/2 of
             themselves, at random, and no more: sum over the steps of (v dp)^2 EPS^2/6
     plain   the same if q and p themselves are rounded after each step, to the nearest: sum of
             ((F ulp(q))^2 + (v ulp(p))^2)/12, with F = dp/h.  What a state without
             compensation must do
     t       mean over standard error of the mean of the energy's changes over fiftieths of a
             run: Student's t with 49 degrees of freedom, beyond 4 once in 5000.  A bias shows
             here: it grows with the number of steps, the walk with its square root

   Energies are computed in long double from q and p and what rounding left of them.  Of float all; of
   double a chaotic pendulum, the figure-eight, angles that wind up and late times: the rest is in
   brouwer, corners, stiff and test_clock.  The Pythagorean problem makes 1e9 of one rounding, so in
   float nothing is left of its end.

     long [steps of the long runs, 10000000]                                                */
#include "pendulum.h"
#include "planets.h"
#include "cost/coefficients.h"

enum { MOST = 18 };
static const int single = sizeof(real) < sizeof(double);

typedef struct problem {
    const char *name;
    gvi_desc    desc;
    real        h, q[MOST], p[MOST];
    long double (*energy)(const long double *q, const long double *p);
} problem;

static real arena[GVI_LENGTH(MOST, 8, 8)];

static void begin(const problem *a, gvi_stepper *st)
{
    must(gvi_init(st, &a->desc, arena, sizeof arena));
    must(gvi_start_momentum(st, 0, a->q, a->p));
}

static long double energy_of(const problem *a, const gvi_stepper *st)
{
    long double q[MOST], p[MOST];
    read_state(st, q, p);
    return a->energy(q, p);
}

/* -------------------------------------------------------------------- walks */

enum { PARTS = 50, SAMPLES = 1000, EVERY = 16 };
/* early: in the first half; wound: walk, and of a pendulum's forces at angles that wind up */
typedef struct trace { double worst, early, walk, plain, wound, t, drift; gvi_status status; } trace;

static double ulp(real x) { return ldexp((double)EPS, x == 0 ? -126 : ilogb((double)x)); }

/* Adds what EVERY steps like this one do to the walks */
static void reckon(const problem *a, gvi_stepper *st, const real *was, trace *z)
{
    real v[MOST];
    double power = 0, speed = 0, far = 0;
    must(gvi_velocity(st, v));
    for (int i = 0; i < st->n; ++i) {
        const double dp = (double)st->p[i] - (double)was[i];
        power += fabs((double)v[i]*dp);
        speed += fabs((double)v[i]);
        far += fabs((double)st->q[i]);
        z->plain += EVERY*(pow(dp/(double)a->h*ulp(st->q[i]), 2) + pow((double)v[i]*ulp(st->p[i]), 2))/12;
    }
    const double walk = EVERY*power*power*(double)EPS*(double)EPS/6;
    z->walk += walk;
    z->wound += walk + EVERY*pow(speed*fmax(1, far)*29.4*(double)a->h*(double)EPS, 2)/12;
}

static void advance(const problem *a, gvi_stepper *st, long steps, int compensated, trace *z)
{
    real was[MOST];
    for (long k = 0; k < steps && z->status == GVI_OK; ++k) {
        if (!compensated) {                       // a start keeps nothing
            real q[MOST], p[MOST];
            memcpy(q, st->q, sizeof(real)*(size_t)st->n);
            memcpy(p, st->p, sizeof(real)*(size_t)st->n);
            must(gvi_start_momentum(st, st->t, q, p));
        }
        if (k % EVERY == 0) memcpy(was, st->p, sizeof(real)*(size_t)st->n);
        z->status = gvi_step(st, a->h);
        if (k % EVERY == 0) reckon(a, st, was, z);
    }
}

/* Student's t of the changes over PARTS equal parts */
static double bias(const double *value)
{
    double mean = value[SAMPLES - 1]/PARTS, spread = 0;
    for (int k = 0; k < PARTS; ++k) {
        const int last = (k + 1)*SAMPLES/PARTS - 1, first = k*SAMPLES/PARTS - 1;
        const double d = value[last] - (k ? value[first] : 0) - mean;
        spread += d*d/(PARTS - 1);
    }
    return mean/sqrt(spread/PARTS);
}

static trace follow(const problem *a, long steps, int compensated)
{
    static double value[SAMPLES];
    trace z = { 0, 0, 0, 0, 0, 0, 0, GVI_OK };
    gvi_stepper st;
    begin(a, &st);
    const long double E0 = energy_of(a, &st);
    for (int k = 0; k < SAMPLES && z.status == GVI_OK; ++k) {
        advance(a, &st, steps/SAMPLES, compensated, &z);
        value[k] = (double)(energy_of(a, &st)/E0 - 1);
        z.worst = fmax(z.worst, fabs(value[k]));
        if (k < SAMPLES/2) z.early = z.worst;
        progress(a->name, k + 1, SAMPLES);
    }
    z.walk = sqrt(z.walk)/(double)fabsl(E0);
    z.plain = sqrt(z.plain)/(double)fabsl(E0);
    z.wound = sqrt(z.wound)/(double)fabsl(E0);
    z.t = z.status == GVI_OK ? bias(value) : NAN;
    z.drift = value[SAMPLES - 1];
    if (z.status != GVI_OK) printf("  FAILED: %s after %llu steps: %s\n", a->name, st.counters.steps,
                                   gvi_status_text(z.status));
    return z;
}

/* ----------------------------------------------------------- double pendulum */

static long double energy_of_pendulum(const long double *q, const long double *p)
{
    return pendulum_energy_at(q[0], q[1], p[0], p[1]);
}

static problem pendulum(int s, real h, real K, gvi_formulation formulation)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pendulum_forces } };
    problem a = { .name = "double pendulum", .h = h, .q = { (real)1.1, (real)-1.1/sqrt(1 + 100*K) },
                  .p = { (real)2.7746, (real)2.7746 }, .energy = energy_of_pendulum };
    stiffness = K;
    a.desc = (gvi_desc){ .n = 2, .degree = s, .effects = scene, .effect_count = 1,
                         .formulation = formulation,
                         .mass = pendulum_inertia };
    return a;
}

static void report(const problem *a, long steps, const trace *z, double law)
{
    printf("  %s, %ld steps: max |dE/E| %.2e, %.0f EPS; at the end %.2e\n", a->name, steps, z->worst,
           z->worst/(double)EPS, z->drift);
    expect("max |dE/E| in units of its law", 0, z->worst/law, 4);
    expect("t of the drift", -4, z->t, 4);
}

/* Newton's method has P = M v at the points, rounded to EPS/2 of |M||v|, instead of v from p */
static double newton_law(const problem *a, long steps)
{
    gvi_stepper st;
    double sum = 0;
    const long some = 10000;
    begin(a, &st);
    const double E0 = (double)energy_of(a, &st);
    for (long k = 0; k < some; ++k) {
        const double u = (double)st.p[0], w = (double)st.p[1];
        must(gvi_step(&st, a->h));
        const double c = cos((double)st.q[1]), m = 3 + 2*c, o = 1 + c, d = 2 - c*c;
        const double du = (double)st.p[0] - u, dw = (double)st.p[1] - w;
        const double v[2] = { fabs(u - o*w)/d, fabs(m*w - o*u)/d };
        const double dv[2] = { (du - o*dw)/d, (m*dw - o*du)/d };
        sum += (pow(dv[0]*(m*v[0] + o*v[1]), 2) + pow(dv[1]*(o*v[0] + v[1]), 2))/12;
    }
    return (double)EPS*sqrt(sum/(double)some*(double)steps)/fabs(E0);
}

static void pendulums(long steps)
{
    static const struct { const char *name; int degree; real K; gvi_formulation formulation; } runs[] = {
        { "Newton, degree 4", 4, 0, GVI_NEWTON }, { "Newton, degree 6", 6, 0, GVI_NEWTON },
        { "Newton, degree 8", 8, 0, GVI_NEWTON }, { "spring 1024, degree 8", 8, 1024, GVI_AUTO },
        { "spring 4096, degree 10", 10, 4096, GVI_AUTO } };
    problem a = pendulum(6, 1/(real)128, 0, GVI_MOMENTA);
    trace z = follow(&a, steps, 1);
    report(&a, steps, &z, z.walk);
    for (int k = 0; k < COUNT(runs); ++k) {
        a = pendulum(runs[k].degree, 1/(real)128, runs[k].K, runs[k].formulation);
        a.name = runs[k].name;
        const double law = runs[k].formulation == GVI_NEWTON ? newton_law(&a, steps/10) : 0;
        z = follow(&a, steps/10, 1);
        report(&a, steps/10, &z, law > 0 ? law : z.walk);
    }
    // where the fixed point ends, going to and fro between two neighbours, has a side: no bound
    a = pendulum(6, 1/(real)128, 4096, GVI_AUTO);
    z = follow(&a, steps/10, 1);
    printf("  spring 4096, degree 6, contraction 1/4: max |dE/E| %.2e, %.1f walks, t %.1f\n", z.worst,
           z.worst/z.walk, z.t);
}

/* From rest at (2, 1), degree 8.  The force is wrong by EPS/2 of q times its derivative, 3 g or less, too:
   the angles wind up, and sin(q) of a large q has lost digits                               */
static void chaotic_pendulum(long steps)
{
    problem a = pendulum(8, 1/(real)128, 0, GVI_MOMENTA);
    a.name = "chaotic pendulum";
    a.q[0] = 2;
    a.q[1] = 1;
    a.p[0] = a.p[1] = 0;
    const trace z = follow(&a, steps, 1);
    report(&a, steps, &z, z.wound);
}

/* -------------------------------------------------------------- outer solar system */

static problem planets(void)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    problem a = { .name = "outer solar system", .h = 200, .energy = planets_energy };
    read_planets(a.q, a.p);
    a.desc = (gvi_desc){ .n = 3*BODIES, .degree = 8, .effects = scene, .effect_count = 1,
                         .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass_of } };
    return a;
}

/* With what rounding leaves of q and p carried on, and thrown away before every step */
static void compensation(const problem *a, long steps)
{
    const trace with = follow(a, steps, 1), without = follow(a, steps, 0);
    printf("  %s, %ld steps: max |dE/E| %.2e with compensation, %.2e without: %.0f times\n", a->name, steps,
           with.worst, without.worst, without.worst/with.worst);
    printf("    laws: %.2e and %.2e\n", with.walk, without.plain);
    expect("with, in walks", 0, with.worst/with.walk, 4);
    expect("without, in walks of plain rounding", 0.2, without.worst/without.plain, 4);
    expect("t of the drift, with", -4, with.t, 4);
}

/* -------------------------------------------------------------------- kicks */

static long double kepler_energy(const long double *q, const long double *p)
{
    return (p[0]*p[0] + p[1]*p[1])/2 - 1/hypotl(q[0], q[1]);
}

/* Aphelion of an ellipse with semi-major axis 1 */
static problem kepler(double e, real h)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    problem a = { .name = "Kepler", .h = h, .q = { (real)(1 + e), 0 },
                  .p = { 0, (real)sqrt((1 - e)/(1 + e)) }, .energy = kepler_energy };
    a.desc = (gvi_desc){ .n = 2, .effects = scene, .effect_count = 1 };
    return a;
}

/* Blanes and Moan's splitting of order 6 */
static void split(real *c, real *b)
{
    long double at = 0, sum = 0;
    for (int j = 0; j < 6; ++j) {
        const long double kick = j < 5 ? blanes_moan11_b[j] : 0.5L - sum;
        sum += kick;
        c[j] = (real)at;
        c[11 - j] = (real)(1 - at);
        b[j] = b[11 - j] = (real)kick;
        if (j < 5) at += blanes_moan11_a[j];
    }
}

/* Verlet has truncation at 100 steps a revolution (a number that the samples do not share),
   which must not grow beyond the walk; the splitting at 60 has rounding alone.  e = 0.2    */
static void kicks(long steps)
{
    real c[12], b[12];
    problem a = kepler(0.2, (real)0.0625);
    a.name = "Kepler by Verlet";
    a.desc.degree = 1;
    a.desc.rule.kind = GVI_LOBATTO;
    const trace all = follow(&a, steps, 1);
    printf("  Verlet, %ld steps: max |dE/E| %.4e, in the first half %.4e; walk %.1e\n", steps, all.worst,
           all.early, all.walk);
    expect("growth, in walks", -4, (all.worst - all.early)/all.walk, 4);
    expect("t of the drift", -4, all.t, 4);
    split(c, b);
    a = kepler(0.2, (real)(2*acos(-1)/60));
    a.name = "Kepler by a splitting of order 6";
    a.desc.degree = 1;
    a.desc.rule = (gvi_rule){ GVI_KICKS, 12, c, b };
    const trace z = follow(&a, steps, 1);
    report(&a, steps, &z, z.walk);
    a = kepler(0.2, (real)(2*acos(-1)/60));
    a.name = "Kepler by positions, degree 8";
    const trace y = follow(&a, steps, 1);
    report(&a, steps, &y, y.walk);
}

/* -------------------------------------------------------------------- clock */

static int distance(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[x->stride + k], d = sqrt(X*X + Y*Y);
        x->value[k] += d;
        x->f[k] += X/d;
        x->f[x->stride + k] += Y/d;
    }
    return 0;
}

/* The ellipse through the rounded start, in long double, and the place on it at t */
typedef struct ellipse { long double a, e, n, b; } ellipse;

static ellipse through(const real *q, const real *p)
{
    const long double r = q[0], v = p[1], E = v*v/2 - 1/r, L = r*v;
    ellipse z = { -1/(2*E), 0, 0, 0 };
    z.e = r/z.a - 1;                                        // at the aphelion
    z.n = 1/(z.a*sqrtl(z.a));
    z.b = L*sqrtl(z.a);
    return z;
}

static void on_ellipse(const ellipse *z, long double t, long double *q)
{
    const long double turn = 2*acosl(-1), M = remainderl(z->n*t + turn/2, turn);
    long double lo = M - z->e, hi = M + z->e;
    for (int k = 0; k < 70; ++k) {
        const long double u = (lo + hi)/2;
        if (u - z->e*sinl(u) < M) lo = u;
        else hi = u;
    }
    const long double u = (lo + hi)/2;
    q[0] = -z->a*(cosl(u) - z->e);
    q[1] = -z->b*sinl(u);
}

typedef struct orbit { gvi_status status; double end, worst, outside, inside, walk; } orbit;

/* 100 revolutions in `steps` of g = |q|; errors of place over the last one.  The time that goes
   with q is t and what rounding left of it.  walk: of g (H - E), which the method keeps    */
static orbit eccentric(double e, int steps)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                        { .kind = GVI_CLOCK, .points = distance } };
    problem a = kepler(e, (real)(200*acos(-1)/steps));
    a.desc.effects = scene;
    a.desc.effect_count = 2;
    const ellipse path = through(a.q, a.p);
    orbit z = { GVI_OK, 0, 0, 0, 0, 0 };
    gvi_stepper st;
    begin(&a, &st);
    const double E0 = (double)energy_of(&a, &st);
    for (int k = 1; k <= steps; ++k) {
        const double u = (double)st.p[0], w = (double)st.p[1];
        long double q[2];
        z.status = gvi_step(&st, a.h);
        if (z.status != GVI_OK) break;
        const double x = (double)st.p[0], y = (double)st.p[1], r = hypot((double)st.q[0], (double)st.q[1]);
        const double error = fabs((double)energy_of(&a, &st)/E0 - 1);
        z.walk += pow(r*(fabs(x*(x - u)) + fabs(y*(y - w))), 2);
        if (r > 1) z.outside = fmax(z.outside, error);
        else z.inside = fmax(z.inside, error);
        if (k <= steps - steps/100) continue;
        on_ellipse(&path, (long double)st.t + (long double)st.t_low, q);
        for (int i = 0; i < 2; ++i) q[i] -= (long double)st.q[i] + (long double)st.q_low[i];
        z.end = (double)hypotl(q[0], q[1]);
        z.worst = fmax(z.worst, z.end);
    }
    z.walk = (double)EPS*sqrt(z.walk/6)/fabs(E0);
    return z;
}

/* H - E = K/|q| with K from its walk.  Mean motion goes like |E|^(3/2): after M = 200 pi the phase
   is wrong by 3/2 M times the walk's mean, 1/sqrt(3) of its end, and the rounding of the level E at
   the start, EPS/2 of it at most; the place by that times the speed                         */
static void eccentric_orbits(void)
{
    static const double all[] = { 0.5, 0.9, 0.99, 0.999 };
    char name[96];
    for (int k = 0; k < COUNT(all); ++k) {
        const double e = all[k], M = 200*acos(-1), speed = sqrt((1 + e)/(1 - e));
        const orbit z = eccentric(e, e < 0.995 ? 8000 : 16000);
        const double phase = 1.5*M*sqrt((z.walk*z.walk + (double)(EPS*EPS)/4)/3);
        must(z.status);
        printf("  e = %g: place %.1e at the end, %.1e at worst in the last revolution; energy %.1e outside"
               " |q| = 1, %.1e inside\n", e, z.end, z.worst, z.outside, z.inside);
        snprintf(name, sizeof name, "e = %g: energy outside, in walks", e);
        expect(name, 0, z.outside/z.walk, 4);
        snprintf(name, sizeof name, "e = %g: energy inside, in walks over 1 - e", e);
        expect(name, 0, z.inside/z.walk*(1 - e), 4);
        snprintf(name, sizeof name, "e = %g: place at worst, in speed times error of phase", e);
        expect(name, 0, z.worst/(speed*phase), 4);
    }
}

/* -------------------------------------------------------------- figure-eight */

static int three(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int a = 1; a < 3; ++a)
            for (int b = 0; b < a; ++b) {
                const int i = 2*a*d + k, j = 2*b*d + k;
                const real u = x->q[i] - x->q[j], v = x->q[i + d] - x->q[j + d];
                const real r2 = u*u + v*v, w = 1/(r2*sqrt(r2));
                x->f[i] -= w*u;  x->f[i + d] -= w*v;
                x->f[j] += w*u;  x->f[j + d] += w*v;
            }
    return 0;
}

static long double three_energy(const long double *q, const long double *p)
{
    long double E = 0;
    for (int i = 0; i < 6; ++i) E += p[i]*p[i]/2;
    for (int a = 1; a < 3; ++a)
        for (int b = 0; b < a; ++b) E -= 1/hypotl(q[2*a] - q[2*b], q[2*a + 1] - q[2*b + 1]);
    return E;
}

/* Chenciner, Montgomery 2000, start by Simo: 10,000 periods of 64 steps; stable, so the start's rounding does not matter.
   Angular momentum: each step's changes of q and p, rounded, in units of |q| |p| h         */
static void figure_eight(void)
{
    enum { PERIODS = 10000, STEPS = 64 };
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = three } };
    const real u = (real)-0.93240737, v = (real)-0.86473146;
    problem a = { .name = "figure-eight", .h = (real)(6.32591398/STEPS), .energy = three_energy,
                  .q = { (real)0.97000436, (real)-0.24308753, (real)-0.97000436, (real)0.24308753, 0, 0 },
                  .p = { -u/2, -v/2, -u/2, -v/2, u, v } };
    a.desc = (gvi_desc){ .n = 6, .effects = scene, .effect_count = 1 };
    const trace z = follow(&a, (long)PERIODS*STEPS, 1);
    double L = 0, widest = 0;
    gvi_stepper st;
    report(&a, (long)PERIODS*STEPS, &z, z.walk);
    begin(&a, &st);
    for (long k = 0; k < (long)PERIODS*STEPS; ++k) {
        must(gvi_step(&st, a.h));
        widest = fmax(widest, fabs((double)st.q[0]));
    }
    for (int b = 0; b < 3; ++b)
        L += (double)st.q[2*b]*(double)st.p[2*b + 1] - (double)st.q[2*b + 1]*(double)st.p[2*b];
    expect("angular momentum, 0 at the start, in EPS sqrt(steps)", 0,
           fabs(L)/((double)EPS*sqrt((double)PERIODS*STEPS)), 4);
    expect("width of the eight", 1.05, widest, 1.10);
}

/* -------------------------------------------------- large angles, late times */

static int spinning(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= sin(x->q[k]);
    return 0;
}

static long double spinning_energy(const long double *q, const long double *p) { return p[0]*p[0]/2 - cosl(q[0]); }

/* E = p^2/2 - cos q = 31; q through 1000 turns, or a million in double.  sin(q) is that of an angle wrong by
   half a unit of its last place: v h dF = 8/8 EPS/sqrt(12) q a step, at random              */
static void winding(void)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spinning } };
    problem a = { .name = "winding", .h = (real)0.125, .q = { 0 }, .p = { 8 }, .energy = spinning_energy };
    a.desc = (gvi_desc){ .n = 1, .effects = scene, .effect_count = 1 };
    const double far = 2*acos(-1.0)*(single ? 1e3 : 1e6);
    double worst = 0;
    long steps = 0;
    gvi_stepper st;
    begin(&a, &st);
    const long double E0 = energy_of(&a, &st);
    for (; (double)st.q[0] < far; ++steps) {
        must(gvi_step(&st, a.h));
        worst = fmax(worst, fabs((double)(energy_of(&a, &st)/E0 - 1)));
    }
    printf("  %ld steps, %.0f turns: max |dE/E| %.1e\n", steps, (double)st.q[0]/(2*acos(-1.0)), worst);
    expect("energy error, in walks", 0.02, worst/(sqrt((double)steps/3)*far*(double)EPS/sqrt(12.0)/31), 4);
}

/* q'' = -q + cos(t/2), response 4/3 cos(t/2), from a t whose last place is 4 or 8 steps: t comes out exact.
   The effect is told a t that is wrong by up to half of that, at random: a force wrong by last place
   sin(t/2)/2 /sqrt(12)                                                                     */
static int driven(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] += cos(t/2) - q[0];
    return 0;
}

static void late(void)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = driven } };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = scene, .effect_count = 1 };
    const double t0 = single ? 1e5 : 1e13, h = single ? 1.0/1024 : 1.0/2048;
    const real q = (real)(4*cos(t0/2)/3), v = (real)(-2*sin(t0/2)/3);
    const long steps = 1000000;
    gvi_stepper st;
    must(gvi_init(&st, &desc, arena, sizeof arena));
    must(gvi_start(&st, (real)t0, &q, &v));
    for (long k = 0; k < steps; ++k) must(gvi_step(&st, (real)h));
    const long double t = (long double)t0 + (long double)h*steps;
    printf("  t = %g, 1e6 steps of 1/%.0f\n", t0, 1/h);
    expect("error of t", 0, (double)fabsl((long double)st.t - t), 0);
    expect("error of q, in walks of the rounding of t", 0,
           (double)fabsl((long double)st.q[0] - 4*cosl(t/2)/3)/(h*sqrt((double)steps)*ulp((real)t0)/sqrt(96.0)), 4);
}

int main(int argc, char **argv)
{
    const long steps = argc > 1 ? atol(argv[1]) : 10000000;
    printf("Long runs in %s\n", single ? "float" : "double");
    if (single) {
        const problem joint = pendulum(6, 1/(real)128, 0, GVI_MOMENTA), solar = planets();
        pendulums(steps);
        printf("Kicks, and the same without\n");
        kicks(steps);
        printf("Compensation\n");
        stiffness = 0;
        compensation(&joint, steps/10);
        compensation(&solar, steps/10);
        printf("Eccentric orbits with a clock, 100 revolutions\n");
        eccentric_orbits();
    } else chaotic_pendulum(steps);
    printf("Figure-eight\n");
    figure_eight();
    printf("Large angles, late times\n");
    winding();
    late();
    return verdict("long");
}
