/* drift.c - where the energy drifts by rounding: steps of a short binary period, loose tolerances

   A product with h is rounded by what repeats with the digits of h.  Where h is a/5 2^k, as 0.1
   is, the error of fl(h x) is a sawtooth over the binade of x, and <x error>, the mean over an
   oscillation x, is not 0.  Two such products belong to a step in which errors of one sign change
   the energy of an oscillator by one sign, if they are rounded.  With theta = h omega,
   s = 1 - cos theta - theta sin theta and N = (1 - cos theta)^2 + (theta - sin theta)^2, unit mass:
     h v    in the rows alone: an error e is a step that begins with v + e/h and loses e/h at its
            end:  <v e> s/h
     h d    in the increment of q, d = (q1 - q0)/h - v, whose amplitude is sqrt(N)/theta that of v.
            An error e moves q1, of which h d makes the part s/N: omega^2 h <d e> s/N
   gvi.h carries both with their rests, so nothing of that is to be seen; what would be is printed
   beside it, the means taken over the phase here, with the errors of the products from fma().
   With few digits, as 1/8 and 3/32 have, it is 0: exact, or ties to even.  Measured is what four
   oscillators do, speeds spread over a binade, started at any phase, frequencies moved by 1e-5 so
   that their squares have digits of their own.  0.05, 0.1 and 0.2 are the same digits, so three
   samples of one drift.  Bounds, EPS a step:
     degree 8   0.002, a sixteenth of what rounded products would do; for 1/8 and 3/32 0.0005: 80 EPS
                in the 160,000 steps in which a walk of 0.2 EPS a step comes as far
     others     0.004: the end of the iteration has a side there, another with each degree
   The outer solar system as in brouwer.c, with tolerances: what an iteration leaves undone has a
   sign.  Of its own stop Student's t is that of no drift, below 3.5; with eps/256 it is above 7, or
   this study would not see one.

     drift [seed]     of the random numbers that move the starts, 1 if not given */
#include "planets.h"

enum { MANY = 4, RUNS = 6, STEPS = 1 << 19, LENGTH = 1 << 15, MOST = 3*BODIES };
static const double pi = 3.14159265358979323846, theta = 1;

/* --------------------------------------------------------------------- means */

typedef struct sample { int n; double sum, squares; } sample;

static void add(sample *a, double x)
{
    ++a->n;
    a->sum += x;
    a->squares += x*x;
}

static double mean(const sample *a) { return a->sum/a->n; }

static double standard_error(const sample *a)
{
    return sqrt((a->squares/a->n - mean(a)*mean(a))/(a->n - 1));
}

/* --------------------------------------------------------------- oscillators */

/* even: few digits or no period, so that products with h are rounded evenly */
typedef struct step { const char *name; real h; int degree, even; } step;

/* <x (fl(h x) - h x)> of x = size sin(phi), which is the same in each quarter */
static double product_with_error(double h, double size)
{
    enum { PHASES = 1000000 };
    double sum = 0;
    for (int k = 0; k < PHASES; ++k) {
        const double x = size*sin(pi/2*(k + 0.5)/PHASES), hx = h*x;
        sum -= x*fma(h, x, -hx);
    }
    return sum/PHASES;
}

/* If both products were rounded, in EPS of the energy a step */
static double expected_drift(const step *a, double speed)
{
    const double h = a->h, omega = theta/h, s = 1 - cos(theta) - theta*sin(theta);
    const double N = pow(1 - cos(theta), 2) + pow(theta - sin(theta), 2), d = speed*sqrt(N)/theta;
    if (a->even) return 0;
    const double rows = s/h*product_with_error(h, speed);
    const double increment = omega*theta*s/N*product_with_error(h, d);
    return (rows + increment)/(speed*speed/2)/(double)EPS;
}

static double speed_of(int i) { return pow(2, i/(double)MANY); }

static void read_energies(const gvi_stepper *st, const real *stiff, long double *E)
{
    long double q[MANY], p[MANY];
    read_state(st, q, p);
    for (int i = 0; i < MANY; ++i) E[i] = (p[i]*p[i] + (long double)stiff[i]*q[i]*q[i])/2;
}

/* A start at any phase; what each gained in EPS a step is added to its sample */
static void swing(const step *a, sample *gain)
{
    static real memory[GVI_LENGTH(MANY, 8, 8)], stiff[MANY];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = stiff } };
    const gvi_desc desc = { .n = MANY, .degree = a->degree, .effects = scene, .effect_count = 1 };
    gvi_stepper st;
    real q[MANY], v[MANY];
    long double before[MANY], after[MANY];
    for (int i = 0; i < MANY; ++i) {
        const double omega = theta/a->h, phase = pi*uniform(), speed = speed_of(i)*(1 + 1e-3*uniform());
        stiff[i] = omega*omega*(1 + 1e-5*uniform());
        q[i] = speed/omega*cos(phase);
        v[i] = speed*sin(phase);
    }
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q, v));
    read_energies(&st, stiff, before);
    for (long k = 0; k < STEPS; ++k) must(gvi_step(&st, a->h));
    read_energies(&st, stiff, after);
    for (int i = 0; i < MANY; ++i) add(gain + i, (double)(after[i]/before[i] - 1)/(double)EPS/STEPS);
}

static void oscillators(const step *a)
{
    sample gain[MANY] = { { 0, 0, 0 } };
    double largest = 0, rounded = 0;
    for (int k = 0; k < RUNS; ++k) {
        swing(a, gain);
        progress(a->name, k + 1, RUNS);
    }
    printf("h = %s, degree %d\n", a->name, a->degree);
    for (int i = 0; i < MANY; ++i) {
        const double is = mean(gain + i), of_two = expected_drift(a, speed_of(i));
        printf("  speed %.2f: %8.4f +- %.4f   with rounded products %8.4f\n", speed_of(i), is,
               standard_error(gain + i), of_two);
        largest = fmax(largest, fabs(is));
        rounded = fmax(rounded, fabs(of_two));
    }
    expect("largest drift, EPS a step", 0, largest, a->degree < 8 ? 0.004 : a->even ? 0.0005 : 0.002);
    if (!a->even) expect("with rounded products", 0.02, rounded, 0.1);      // or this would not see one
}

/* ------------------------------------------------------- outer solar system */

/* From a start moved by about 1e-5 of itself: what the energy gained, in EPS */
static double revolve(const gvi_desc *desc, const real *q0, const real *p0)
{
    static real memory[GVI_LENGTH(MOST, 8, 8)];
    gvi_stepper st;
    real q[MOST], p[MOST];
    long double Q[MOST], P[MOST];
    for (int i = 0; i < MOST; ++i) {
        q[i] = q0[i]*(1 + 1e-5*uniform());
        p[i] = p0[i]*(1 + 1e-5*uniform());
    }
    must(gvi_init(&st, desc, memory, sizeof memory));
    must(gvi_start_momentum(&st, 0, q, p));
    read_state(&st, Q, P);
    const long double before = planets_energy(Q, P);
    for (long k = 0; k < LENGTH; ++k) must(gvi_step(&st, 100));
    read_state(&st, Q, P);
    return (double)(planets_energy(Q, P)/before - 1)/(double)EPS;
}

/* Student's t of the mean gain */
static double planets(const char *name, real tolerance, int starts)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    gvi_desc desc = { .n = MOST, .degree = 8, .effects = scene, .effect_count = 1, .tolerance = tolerance };
    real q[MOST], p[MOST];
    sample gain = { 0, 0, 0 };
    read_planets(q, p);
    desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = mass_of };
    for (int k = 0; k < starts; ++k) {
        add(&gain, revolve(&desc, q, p));
        progress(name, k + 1, starts);
    }
    printf("  tolerance %-9s %6.1f +- %.1f EPS, %d starts\n", name, mean(&gain), standard_error(&gain),
           starts);
    return mean(&gain)/standard_error(&gain);
}

int main(int argc, char **argv)
{
    static const step steps[] = { { "0.05", 0.05, 8, 0 }, { "0.1", 0.1, 8, 0 }, { "0.2", 0.2, 8, 0 },
                                  { "3/32", 3.0/32, 8, 1 }, { "1/8", 1.0/8, 8, 1 }, { "1/8", 1.0/8, 4, 1 },
                                  { "0.0712345", 0.0712345, 2, 1 }, { "0.0712345", 0.0712345, 3, 1 },
                                  { "0.0712345", 0.0712345, 5, 1 }, { "0.0712345", 0.0712345, 6, 1 } };
    if (argc > 1) seed = strtoull(argv[1], NULL, 10);
    printf("Oscillators, h omega = %g: drift of the energy over %d runs of %d steps, EPS a step\n", theta,
           RUNS, STEPS);
    for (int k = 0; k < COUNT(steps); ++k) oscillators(steps + k);
    printf("Outer solar system: drift of the energy over %d steps\n", LENGTH);
    expect("t with its own stop", -3.5, planets("0", 0, 128), 3.5);
    planets("eps/4096", EPS/4096, 128);
    expect("|t| with eps/256", 7, fabs(planets("eps/256", EPS/256, 32)), HUGE_VAL);
    return verdict("drift");
}
