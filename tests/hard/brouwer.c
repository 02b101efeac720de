/* brouwer.c - the energy error of ensembles is a random walk: exponent 1/2, no drift

   Brouwer (1937): roundings that are independent make the error of a constant of motion
   grow like sqrt(t); any bias (rounded tables, an iteration that stops too early, sums
   without compensation) makes it grow like t in the end.

   64 starts, each moved by about 1e-5 of itself.  The energy error is read in long double
   after L/64, L/32, ... L steps of each.  From the ensemble:
     exponent  of the root mean square, by a straight line in logarithms
     t         mean over standard error of the mean, of each start's straight line through
               its own energy error: Student's t with 63 degrees of freedom, beyond 3.5
               once in a thousand
   The root mean square of 64 is known to 1/sqrt(128), so the exponent over a factor of 64
   in time to about 0.03.

     brouwer [seed]     of the random numbers that move the starts, 1 if not given */
#include "hard.h"

enum { STARTS = 64, TIMES = 7, MOST = 18 };

typedef struct system_ {
    const char *name;
    gvi_desc    desc;
    real        h, q[MOST], p[MOST];
    long        length;
    long double (*energy)(const long double *q, const long double *p);
} system_;

/* ------------------------------------------------------------- double pendulum */

/* tests/test_ncdp.c: relative angles, m = l = 1, g = 9.8 */
static int pendulum_gravity(const gvi_points *x, void *user)
{
    const real *q1 = x->q, *q2 = q1 + x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const real both = (real)9.8*(real)sin((double)(q1[k] + q2[k]));
        x->f[k] -= 2*(real)9.8*(real)sin((double)q1[k]) + both;
        x->f[x->stride + k] -= both;
    }
    return 0;
}

static int pendulum_mass(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const real c = (real)cos((double)x->q[x->stride + k]);
        x->mass[k] = 3 + 2*c;
        x->mass[2*x->stride + k] = 1 + c;
        x->mass[3*x->stride + k] = 1;
    }
    return 0;
}

static int pendulum_velocity(const gvi_points *x, void *user)
{
    const real *q2 = x->q + x->stride, *p1 = x->p, *p2 = p1 + x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const real c = (real)cos((double)q2[k]), s = (real)sin((double)q2[k]), p = p1[k] - p2[k];
        x->velocity[k] = (p - c*p2[k])/(1 + s*s);
        x->velocity[x->stride + k] = ((2 + c)*p2[k] - (1 + c)*p)/(1 + s*s);
    }
    return 0;
}

static int pendulum_gradient(const gvi_points *x, void *user)
{
    const real *q2 = x->q + x->stride, *v1 = x->v, *v2 = v1 + x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k)
        x->f[x->stride + k] -= (real)sin((double)q2[k])*v1[k]*(v1[k] + v2[k]);
    return 0;
}

static long double pendulum_energy(const long double *q, const long double *p)
{
    const long double a = q[0], b = q[1], u = p[0], v = p[1], c = cosl(b), g = (real)9.8;
    return (u*u - 2*(1 + c)*u*v + (3 + 2*c)*v*v)/(2 - c*c)/2 - 2*g*cosl(a) - g*cosl(a + b);
}

/* -------------------------------------------------------------- outer solar system */

enum { BODIES = 6 };
static double gm[BODIES];
static real   mass_of[3*BODIES];

static int gravity(const gvi_points *x, void *user)
{
    const int d = x->stride;
    (void)user;
    for (int i = 1; i < BODIES; ++i)
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < x->count; ++k) {
                const real *a = x->q + 3*i*d + k, *c = x->q + 3*j*d + k;
                const real u = c[0] - a[0], v = c[d] - a[d], w = c[2*d] - a[2*d];
                const real r2 = u*u + v*v + w*w, s = (real)(gm[i]*gm[j])/(r2*(real)sqrt((double)r2));
                real *f = x->f + 3*i*d + k, *g = x->f + 3*j*d + k;
                f[0] += s*u;  f[d] += s*v;  f[2*d] += s*w;
                g[0] -= s*u;  g[d] -= s*v;  g[2*d] -= s*w;
            }
    return 0;
}

static long double solar_energy(const long double *q, const long double *p)
{
    long double E = 0;
    for (int i = 0; i < BODIES; ++i) {
        const long double *a = q + 3*i, *u = p + 3*i;
        E += (u[0]*u[0] + u[1]*u[1] + u[2]*u[2])/(2*(long double)mass_of[3*i]);
        for (int j = 0; j < i; ++j) {
            const long double *c = q + 3*j, x = a[0] - c[0], y = a[1] - c[1], z = a[2] - c[2];
            E -= (long double)(real)(gm[i]*gm[j])/sqrtl(x*x + y*y + z*z);
        }
    }
    return E;
}

/* examples/outer_solar_system.txt, moved to the centre of mass */
static void read_bodies(const char *path, system_ *a)
{
    double G = 0, m, x[6], centre[6] = { 0 }, all[BODIES][6], total = 0;
    char line[512];
    int n = 0;
    FILE *file = fopen(path, "r");
    while (file && n < BODIES && fgets(line, sizeof line, file)) {
        if (line[0] == '#' || sscanf(line, "G %lf", &G) == 1) continue;
        if (sscanf(line, "%*s %lf %lf %lf %lf %lf %lf %lf", &m, x, x + 1, x + 2, x + 3, x + 4,
                   x + 5) != 7) continue;
        gm[n] = G*m;
        memcpy(all[n], x, sizeof x);
        for (int i = 0; i < 6; ++i) centre[i] += gm[n]*x[i];
        total += gm[n++];
    }
    if (!file || n < BODIES) { printf("  FAILED: %s cannot be read\n", path); exit(1); }
    fclose(file);
    for (int i = 0; i < 3*BODIES; ++i) {
        mass_of[i] = (real)gm[i/3];
        a->q[i] = (real)(all[i/3][i%3] - centre[i%3]/total);
        a->p[i] = mass_of[i]*(real)(all[i/3][3 + i%3] - centre[3 + i%3]/total);
    }
}

/* --------------------------------------------------------------------- a run */

static double error[STARTS][TIMES + 1], slope[STARTS];

/* With what rounding left of q and p, which the stepper carries: else reading the energy
   would be as wrong as some 1000 steps                                        */
static long double energy_of(const system_ *a, const gvi_stepper *st)
{
    long double q[MOST], p[MOST];
    for (int i = 0; i < st->n; ++i) {
        q[i] = (long double)st->q[i] + (long double)st->x.qe[i];
        p[i] = (long double)st->p[i] + (long double)st->x.pe[i];
    }
    return a->energy(q, p);
}

/* Relative energy error at L/64, ... and the slope of 64 samples on the way */
static void run(const system_ *a, int start)
{
    enum { SAMPLES = 64 };
    static real memory[GVI_LENGTH(MOST, 8, 8)];
    static double at[SAMPLES], value[SAMPLES];
    gvi_stepper st;
    real q[MOST], p[MOST];
    for (int i = 0; i < a->desc.n; ++i) {
        q[i] = a->q[i]*(1 + (real)(1e-5*uniform()));
        p[i] = a->p[i]*(1 + (real)(1e-5*uniform()));
    }
    must(gvi_init(&st, &a->desc, memory, sizeof memory));
    must(gvi_start_momentum(&st, 0, q, p));
    const long double E0 = energy_of(a, &st);
    for (int k = 0; k < SAMPLES; ++k) {
        for (long m = 0; m < a->length/SAMPLES; ++m) must(gvi_step(&st, a->h));
        at[k] = (k + 1)/(double)SAMPLES;
        value[k] = (double)(energy_of(a, &st)/E0 - 1);
    }
    for (int k = 0; k < TIMES; ++k) error[start][k] = value[(1 << k) - 1];
    slope[start] = slope_of(SAMPLES, at, value, NULL);
}

static void study(const system_ *a)
{
    double x[TIMES], y[TIMES], mean = 0, squares = 0, spread;
    for (int s = 0; s < STARTS; ++s) {
        run(a, s);
        progress(a->name, s + 1, STARTS);
        mean += slope[s]/STARTS;
        squares += slope[s]*slope[s]/STARTS;
    }
    printf("%s, %ld steps\n  steps      root mean square of dE/E, in EPS\n", a->name, a->length);
    for (int k = 0; k < TIMES; ++k) {
        double sum = 0;
        for (int s = 0; s < STARTS; ++s) sum += error[s][k]*error[s][k]/STARTS;
        x[k] = log((double)a->length/64*(1 << k));
        y[k] = log(sqrt(sum));
        printf("  %-9ld  %.3g\n", a->length/64*(1 << k), exp(y[k])/(double)EPS);
    }
    spread = sqrt((squares - mean*mean)/(STARTS - 1));
    printf("  mean drift over the run %.2g EPS, of one start %.2g EPS\n", mean/(double)EPS,
           sqrt(squares)/(double)EPS);
    expect("exponent", 0.4, slope_of(TIMES, x, y, NULL), 0.6);
    expect("t of the mean drift", -3.5, mean/spread, 3.5);
}

int main(int argc, char **argv)
{
    if (argc > 1) seed = strtoull(argv[1], NULL, 10);
    static const gvi_effect falling[] = { { .kind = GVI_POTENTIAL, .points = pendulum_gravity } };
    static const gvi_effect attracting[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    const int single = sizeof(real) == sizeof(float);
    system_ pendulum = { "double pendulum", { .n = 2, .degree = 6, .effects = falling, .effect_count = 1 },
                         1/(real)128, { (real)1.1, -(real)1.1 }, { (real)2.7746,
                                                                   (real)2.7746 }, 1 << 17, pendulum_energy };
    system_ planets = { "outer solar system", { .n = 18, .degree = 8, .effects = attracting,
                                                .effect_count = 1 },
                        single ? 200 : 100, { 0 }, { 0 }, 1 << 15, solar_energy };
    pendulum.desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = pendulum_mass,
                                     .gradient = pendulum_gradient,
                                     .velocity = pendulum_velocity };
    planets.desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = mass_of };
    read_bodies("examples/outer_solar_system.txt", &planets);
    printf("Brouwer's law in %s\n", single ? "float" : "double");
    study(&pendulum);
    study(&planets);
    return verdict("brouwer");
}
