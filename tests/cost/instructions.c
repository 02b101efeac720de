/* instructions.c - fixed runs, whose work tests/tools/instructions.sh counts

     instructions --compiler     which one made this program, for which machine
     instructions --counts       all runs: name, steps, points evaluated, iterations
     instructions --ends         the same, and where they end
     instructions NAME           one run, under callgrind: what is collected is run_steps

   Right-hand sides without libm but for square roots, which are exact everywhere: with
   -ffp-contract=off points and iterations are the same on every machine, with every compiler. */
#define GVI_REAL double
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "solar.h"

typedef double real;
#include "../problems.h"
static double omega = 50;

#include <math.h>
#include <stdio.h>
#include <string.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))

/* ---------------------------------------------------------------- scenes */

/* g = |q|                                                                                     */
static int distance(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double d = sqrt(X[k]*X[k] + Y[k]*Y[k]), w = 1/d;
        x->value[k] += d;
        x->f[k] += w*X[k];
        x->f[x->stride+k] += w*Y[k];
    }
    return 0;
}

/* Henon-Heiles                                                                                */
static int well(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] -= X[k] + 2*X[k]*Y[k];
        x->f[x->stride+k] -= Y[k] + (X[k]*X[k] - Y[k]*Y[k]);
    }
    return 0;
}

/* A sun in space: -q/|q|^3                                                                     */
static int sun(const gvi_points *x, void *user)
{
    const int R = x->stride;
    const double *q = x->q;
    for (int k = 0; k < x->count; ++k) {
        double d2 = q[k]*q[k] + q[R+k]*q[R+k] + q[2*R+k]*q[2*R+k], w = 1/(d2*sqrt(d2));
        for (int i = 0; i < 3; ++i) x->f[i*R+k] -= w*q[i*R+k];
    }
    return 0;
}

static int pair(const gvi_points *x, int i, int j)
{
    const int R = x->stride;
    const double *a = x->q + 3*i*R, *b = x->q + 3*j*R, g = solar_mass[3*i]*solar_mass[3*j];
    double *s = x->f + 3*i*R, *t = x->f + 3*j*R;
    for (int k = 0; k < x->count; ++k) {
        double u = b[k] - a[k], v = b[R+k] - a[R+k], w = b[2*R+k] - a[2*R+k];
        double d2 = u*u + v*v + w*w, z = g/(d2*sqrt(d2));
        s[k] += z*u;  s[R+k] += z*v;  s[2*R+k] += z*w;
        t[k] -= z*u;  t[R+k] -= z*v;  t[2*R+k] -= z*w;
    }
    return 0;
}

static int gravitation(const gvi_points *x, void *user)
{
    for (int i = 0; i < 5; ++i)
        for (int j = i + 1; j < 6; ++j) pair(x, i, j);
    return 0;
}

/* sin and cos for |x| < 4 by Taylor's series, halved twice: right to about 1e-15              */
static void sines(double x, double *sine, double *cosine)
{
    double z = x*x/16, s = 1, c = 1;
    for (int k = 15; k > 1; k -= 2) {
        s = 1 - z/(k*(k - 1))*s;
        c = 1 - z/((k - 1)*(k - 2))*c;
    }
    s *= x/4;
    for (int k = 0; k < 2; ++k) {
        double twice = 2*s*c;
        c = 1 - 2*s*s;
        s = twice;
    }
    *sine = s;
    *cosine = c;
}

/* Double pendulum, second angle relative to the first, m = l = 1: as in tests/test_ncdp.c      */
static int weight(const gvi_points *x, void *user)
{
    const double *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double first, both, c;
        sines(a[k], &first, &c);
        sines(a[k] + b[k], &both, &c);
        x->f[k] -= 9.8*(2*first + both);
        x->f[x->stride+k] -= 9.8*both;
    }
    return 0;
}

static int velocity(const gvi_points *x, void *user)
{
    const double *b = x->q + x->stride, *p = x->p;
    for (int k = 0; k < x->count; ++k) {
        double s, c, p2 = p[x->stride+k], less = p[k] - p2;
        sines(b[k], &s, &c);
        x->velocity[k] = (less - c*p2)/(1 + s*s);
        x->velocity[x->stride+k] = ((2 + c)*p2 - (1 + c)*less)/(1 + s*s);
    }
    return 0;
}

static int mass(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        double s, c;
        sines(x->q[R+k], &s, &c);
        x->mass[k] = 3 + 2*c;
        x->mass[2*R+k] = 1 + c;
        x->mass[3*R+k] = 1;
    }
    return 0;
}

static int mass_gradient(const gvi_points *x, void *user)
{
    const double *u = x->v, *v = u + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double s, c;
        sines(x->q[x->stride+k], &s, &c);
        x->f[x->stride+k] -= s*u[k]*(u[k] + v[k]);
    }
    return 0;
}

/* ------------------------------------------------------------------ runs */

/* Yoshida's triple jump of Stoermer-Verlet, gamma = 1/(2 - 2^(1/3)): order 4                  */
#define GAMMA 1.3512071919596576
static const double corners[] = { 0, GAMMA, 1 - GAMMA, 1 };
static const double kicks[] = { GAMMA/2, (1 - GAMMA)/2, (1 - GAMMA)/2, GAMMA/2 };

static const gvi_effect kepler_scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
static const gvi_effect space_scene[] = { { .kind = GVI_POTENTIAL, .points = sun } };
static const gvi_effect solar_scene[] = { { .kind = GVI_POTENTIAL, .points = gravitation } };
static const gvi_effect pendulum_scene[] = { { .kind = GVI_POTENTIAL, .points = weight } };
static const gvi_effect well_scene[] = { { .kind = GVI_POTENTIAL, .points = well } };
static const gvi_effect chain_scene[] = { { .kind = GVI_POTENTIAL, .points = fermi_pasta_ulam_forces, .user = &omega } };
static const gvi_effect clock_scene[] = {
    { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
    { .kind = GVI_CLOCK, .points = distance } };

/* Start: configuration and velocity, in the pendulum momentum                                  */
static const double kepler_q[] = { 0.4, 0 }, kepler_v[] = { 0, 2 };
static const double space_q[] = { 1, 0, 0 }, space_v[] = { 0, 0.8, 0.5 };
static const double pendulum_q[] = { 1.1, -1.1 }, pendulum_p[] = { 2.7746, 2.7746 };
static const double well_q[] = { 0, 0.1 }, well_v[] = { 0.49, 0 };
static const double chain_q[] = { 1, 0, 0, 0.02, 0, 0 }, chain_v[] = { 1, 0, 0, 1, 0, 0 };
static const double far_q[] = { 0.1, 0 }, far_v[] = { 0, 4.358898943540674 };

/* A net of 16 knots, its weight, and drag: listed last, or not, or not in the program (-DNO_DRAG)  */
enum { SIDE = 4, KNOTS = SIDE*SIDE, NET = 3*KNOTS };

static void thread(const gvi_points *x, int a, int b)
{
    const int d = x->stride;
    const double *p = x->q + 3*a*d, *q = x->q + 3*b*d;
    double *f = x->f + 3*a*d, *g = x->f + 3*b*d;
    for (int k = 0; k < x->count; ++k) {
        const double u = q[k] - p[k], v = q[d+k] - p[d+k], w = q[2*d+k] - p[2*d+k];
        const double s = 40*(1 - 0.09/sqrt(u*u + v*v + w*w));
        f[k] += s*u;  f[d+k] += s*v;  f[2*d+k] += s*w;
        g[k] -= s*u;  g[d+k] -= s*v;  g[2*d+k] -= s*w;
    }
}

static int threads(const gvi_points *x, void *user)
{
    for (int i = 0; i < KNOTS; ++i) {
        if (i % SIDE < SIDE - 1) thread(x, i, i + 1);
        if (i/SIDE < SIDE - 1) thread(x, i, i + SIDE);
    }
    return 0;
}

static int net_weight(const gvi_points *x, void *user)
{
    for (int i = 0; i < KNOTS; ++i)
        for (int k = 0; k < x->count; ++k) x->f[(3*i+2)*x->stride + k] -= 9.81*0.005;
    return 0;
}

#ifndef NO_DRAG
static int drag(const gvi_points *x, void *user)
{
    for (int i = 0; i < NET; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= 0.01*x->v[i*x->stride + k];
    return 0;
}
#endif

static const gvi_effect net_scene[] = { { .kind = GVI_POTENTIAL, .points = threads },
                                        { .kind = GVI_POTENTIAL, .points = net_weight },
#ifndef NO_DRAG
                                        { .kind = GVI_FORCE, .points = drag },
#endif
};
static double net_mass[NET], net_q[NET], net_v[NET];

static void hang_net(void)
{
    for (int i = 0; i < NET; ++i) {
        net_mass[i] = 0.005;
        net_q[i] = i % 3 == 2 ? 0.02*(i % 7) : 0.1*(i % 3 ? i/3/SIDE : i/3 % SIDE);
    }
}

typedef struct run {
    const char   *name;
    gvi_desc      desc;
    const double *q, *v;
    double        h;
    long          steps;
    int           off;              /* effect that is switched off, or 0 */
} run;

#define SCENE(s) .effects = s, .effect_count = COUNT(s)
static const run runs[] = {
    { "kepler", { .n = 2, .degree = 8, SCENE(kepler_scene), .formulation = GVI_POSITIONS },
      kepler_q, kepler_v, 0.1, 2000, 0 },
    { "solar", { .n = 18, .degree = 8, SCENE(solar_scene),
      .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = solar_mass } },
      solar_q, solar_v, 200, 500, 0 },
    { "pendulum", { .n = 2, .degree = 6, SCENE(pendulum_scene), .formulation = GVI_MOMENTA,
      .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient,
                .velocity = velocity } },
      pendulum_q, pendulum_p, 1.0/128, 2000, 0 },
    { "links", { .n = 2, .degree = 8, SCENE(pendulum_scene), .formulation = GVI_MOMENTA,
      .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient } },
      pendulum_q, pendulum_p, 1.0/32, 1000, 0 },
    { "space", { .n = 3, .degree = 8, SCENE(space_scene), .formulation = GVI_POSITIONS, .tolerance = 1e-12 },
      space_q, space_v, 0.2, 2000, 0 },
    { "kicks", { .n = 2, SCENE(well_scene),
      .rule = { .kind = GVI_KICKS, .points = 4, .nodes = corners, .weights = kicks } },
      well_q, well_v, 0.1, 20000, 0 },
    { "clock", { .n = 2, .degree = 8, SCENE(clock_scene) }, far_q, far_v, 0.1, 1000, 0 },
    { "springs", { .n = 6, .degree = 8, SCENE(chain_scene), .formulation = GVI_POSITIONS },
      chain_q, chain_v, 0.05, 1000, 0 },
#define A_NET(count) { .n = NET, .degree = 6, .effects = net_scene, .effect_count = count, \
                       .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = net_mass } }, net_q, net_v, 0.005, 100
    { "net", A_NET(2), 0 },
#ifndef NO_DRAG
    { "net-off", A_NET(3), 2 },
    { "net-drag", A_NET(3), 0 },
#endif
};

/* What callgrind collects, called through a pointer that no compiler sees through              */
void run_steps(gvi_stepper *st, double h, long steps);
void run_steps(gvi_stepper *st, double h, long steps)
{
    for (long k = 0; k < steps && st->status == GVI_OK; ++k) gvi_step(st, h);
}
static void (*volatile steps_of)(gvi_stepper *, double, long) = run_steps;

static gvi_status perform(const run *r, gvi_stepper *st)
{
    static double memory[GVI_LENGTH(NET, 6, 6) + GVI_LENGTH(18, 8, 8)];
    hang_net();
    gvi_init(st, &r->desc, memory, sizeof memory);
    if (r->off) gvi_switch(st, r->off, 0);
    if (r->desc.mass.kind == GVI_MASS_POSITION) gvi_start_momentum(st, 0, r->q, r->v);
    else gvi_start(st, 0, r->q, r->v);
    steps_of(st, r->h, r->steps);
    return st->status;
}

static int say_counts(int ends)
{
    for (int i = 0; i < COUNT(runs); ++i) {
        gvi_stepper st;
        gvi_status status = perform(runs + i, &st);
        if (status != GVI_OK) return fprintf(stderr, "%s: %s\n", runs[i].name, gvi_status_text(status)), 1;
        printf("%s %llu %llu %llu\n", runs[i].name, st.counters.steps, st.counters.effect[0],
               st.counters.iterations + st.counters.newton_iterations);
        if (ends) printf("%s ends at %a\n", runs[i].name, st.q[st.n-1]);
    }
    return 0;
}

static int say_compiler(void)
{
#if defined(__clang__)
    const char *name = "clang";
#elif defined(__GNUC__)
    const char *name = "gcc";
#else
    const char *name = "unknown";
#endif
#if defined(__VERSION__)
    const char *version = __VERSION__;
#else
    const char *version = "?";
#endif
#if defined(__x86_64__)
    const char *machine = "x86-64";
#elif defined(__aarch64__)
    const char *machine = "aarch64";
#else
    const char *machine = "other";
#endif
    return printf("%s %s %s\n", name, version, machine) < 0;
}

int main(int argc, char **argv)
{
    gvi_stepper st;
    if (argc == 2 && !strcmp(argv[1], "--compiler")) return say_compiler();
    if (argc == 2 && !strcmp(argv[1], "--counts")) return say_counts(0);
    if (argc == 2 && !strcmp(argv[1], "--ends")) return say_counts(1);
    for (int i = 0; argc == 2 && i < COUNT(runs); ++i)
        if (!strcmp(argv[1], runs[i].name)) return perform(runs + i, &st) != GVI_OK;
    fputs("instructions --compiler | --counts | --ends | NAME\n", stderr);
    return 2;
}
