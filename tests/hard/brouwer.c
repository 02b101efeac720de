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
#include "pendulum.h"
#include "planets.h"

enum { STARTS = 64, TIMES = 7, MOST = 18 };

typedef struct system_ {
    const char *name;
    gvi_desc    desc;
    real        h, q[MOST], p[MOST];
    long        length;
    long double (*energy)(const long double *q, const long double *p);
} system_;

/* ---------------------------------------------------------------- energies */

static long double energy_of_pendulum(const long double *q, const long double *p)
{
    return pendulum_energy_at(q[0], q[1], p[0], p[1]);
}

/* --------------------------------------------------------------------- a run */

static double error[STARTS][TIMES + 1], slope[STARTS];

static long double energy_of(const system_ *a, const gvi_stepper *st)
{
    long double q[MOST], p[MOST];
    read_state(st, q, p);
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
    static const gvi_effect falling[] = { { .kind = GVI_POTENTIAL, .points = pendulum_forces } };
    static const gvi_effect attracting[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    const int single = sizeof(real) == sizeof(float);
    system_ pendulum = { "double pendulum", { .n = 2, .degree = 6, .effects = falling, .effect_count = 1 },
                         1/(real)128, { (real)1.1, -(real)1.1 }, { (real)2.7746,
                                                                   (real)2.7746 }, 1 << 17, energy_of_pendulum };
    system_ planets = { "outer solar system", { .n = 18, .degree = 8, .effects = attracting,
                                                .effect_count = 1 },
                        single ? 200 : 100, { 0 }, { 0 }, 1 << 15, planets_energy };
    pendulum.desc.mass = pendulum_inertia;
    planets.desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = mass_of };
    read_planets(planets.q, planets.p);
    printf("Brouwer's law in %s\n", single ? "float" : "double");
    study(&pendulum);
    study(&planets);
    return verdict("brouwer");
}
