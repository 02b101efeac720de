/* pythagorean.c - Burrau's three bodies to T = 63, with a clock of mutual distances

   Masses 3, 4, 5 fall from rest through a dozen close encounters, the closest at a
   distance of 4e-4, where coordinates of size 1 are known to EPS/4e-4 of it.  How much that
   is at the end is printed: the end of a start that was moved by one rounding.  Reference:
   tests/gen/pythagorean.c.

   The clock is the free-fall time of the closest pair, smoothly:
     g = (sum_ab (m_a + m_b)/r_ab^3)^(-1/2)                                     */
#include "hard.h"

static const double mass[3] = { 3, 4, 5 };
static const double reference[6] = {
    2.83943397249150024545700,  8.11285442469595138029942,
    -0.46342027997511906675765, -2.85222836293400241462695,
    -1.33292415951480489386808, -2.58592996447036889647809 };

/* Pair by pair: distance vector, and its square */
static double apart(const gvi_points *x, int a, int b, int k, double *u, double *v)
{
    *u = x->q[2*a*x->stride + k] - x->q[2*b*x->stride + k];
    *v = x->q[(2*a + 1)*x->stride + k] - x->q[(2*b + 1)*x->stride + k];
    return *u * *u + *v * *v;
}

static void push(const gvi_points *x, int a, int b, int k, double fu, double fv)
{
    x->f[2*a*x->stride + k] += fu;  x->f[(2*a + 1)*x->stride + k] += fv;
    x->f[2*b*x->stride + k] -= fu;  x->f[(2*b + 1)*x->stride + k] -= fv;
}

static int gravity(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k)
        for (int a = 1; a < 3; ++a)
            for (int b = 0; b < a; ++b) {
                double u, v, d2 = apart(x, a, b, k, &u, &v), w = mass[a]*mass[b]/sqrt(d2);
                if (x->value) x->value[k] -= w;
                if (x->f) push(x, a, b, k, -w/d2*u, -w/d2*v);
            }
    return 0;
}

static int fall_time(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        double sum = 0, g;
        for (int a = 1; a < 3; ++a)
            for (int b = 0; b < a; ++b) {
                double u, v, d2 = apart(x, a, b, k, &u, &v);
                sum += (mass[a] + mass[b])/(d2*sqrt(d2));
            }
        x->value[k] += g = 1/sqrt(sum);
        for (int a = 1; a < 3; ++a)
            for (int b = 0; b < a; ++b) {
                double u, v, d2 = apart(x, a, b, k, &u, &v);
                double w = 1.5*g/sum*(mass[a] + mass[b])/(d2*d2*sqrt(d2));
                push(x, a, b, k, w*u, w*v);
            }
    }
    return 0;
}

static long double energy(const double *q, const double *p, double *closest)
{
    long double E = 0;
    *closest = 10;
    for (int i = 0; i < 6; ++i) E += (long double)p[i]*p[i]/(2*mass[i/2]);
    for (int a = 1; a < 3; ++a)
        for (int b = 0; b < a; ++b) {
            long double d = hypotl((long double)q[2*a] - q[2*b], (long double)q[2*a + 1] - q[2*b + 1]);
            E -= mass[a]*mass[b]/d;
            *closest = fmin(*closest, (double)d);
        }
    return E;
}

/* Energy where no pair is closer than 0.1, and everywhere */
typedef struct outcome { double position, apart, all, closest; unsigned long long steps; double seconds;
                         } outcome;

/* `shift`: added to one coordinate of the start */
static outcome run(double h, double shift, double *q)
{
    static double memory[GVI_LENGTH(6, 8, 8)];
    static const double m[6] = { 3, 3, 4, 4, 5, 5 }, rest[6] = { 0 };
    const double q0[6] = { 1 + shift, 3, -2, -1, 1, -1 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity, .value = gravity },
                                 { .kind = GVI_CLOCK, .points = fall_time } };
    const gvi_desc desc = { .n = 6, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    outcome z = { 0, 0, 0, 1, 0, 0 };
    gvi_stepper st;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q0, rest));
    double d;
    const long double E0 = energy(st.q, st.p, &d);
    const clock_t began = clock();
    while (st.t < 63) {
        must(gvi_step(&st, h));
        const double error = (double)fabsl(energy(st.q, st.p, &d)/E0 - 1);
        z.all = fmax(z.all, error);
        if (d > 0.1) z.apart = fmax(z.apart, error);
        z.closest = fmin(z.closest, d);
    }
    z.seconds = (double)(clock() - began)/CLOCKS_PER_SEC;
    must(gvi_state_at(&st, 63, q, NULL, NULL));
    for (int i = 0; i < 6; ++i) z.position = fmax(z.position, fabs(q[i] - reference[i]));
    z.steps = st.counters.steps;
    return z;
}

// a run to the end of the closest encounter, at t = 15.83: does every step pass?
static int passes(double h)
{
    static double memory[GVI_LENGTH(6, 8, 8)];
    static const double m[6] = { 3, 3, 4, 4, 5, 5 }, q0[6] = { 1, 3, -2, -1, 1, -1 }, rest[6] = { 0 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity, .value = gravity },
                                 { .kind = GVI_CLOCK, .points = fall_time } };
    const gvi_desc desc = { .n = 6, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    gvi_stepper st;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q0, rest));
    while (st.t < 16 && st.status == GVI_OK) (void)gvi_step(&st, h);
    return st.status == GVI_OK;
}

/* The same without a clock: the encounter is stepped over */
static double without_clock(int steps)
{
    static double memory[GVI_LENGTH(6, 8, 8)];
    static const double m[6] = { 3, 3, 4, 4, 5, 5 }, q0[6] = { 1, 3, -2, -1, 1, -1 }, rest[6] = { 0 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity, .value = gravity } };
    const gvi_desc desc = { .n = 6, .effects = scene, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    gvi_stepper st;
    double closest = 1, worst = 0;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q0, rest));
    const long double E0 = energy(st.q, st.p, &closest);
    for (int k = 0; k < steps; ++k) {
        if (gvi_step(&st, 63.0/steps) != GVI_OK) return INFINITY;       // seen by its status
        worst = fmax(worst, (double)fabsl(energy(st.q, st.p, &closest)/E0 - 1));
    }
    return worst;
}

int main(void)
{
    double q[6], near[6], apart = 0;
    printf("Pythagorean three bodies to T = 63\n");
    printf("  h      steps   closest   energy, apart   all steps   end against reference   ms\n");
    outcome z = { 0, 0, 0, 0, 0, 0 };
    for (int k = 0; k < 5; ++k) {
        z = run(0.5*pow(0.7, k), 0, q);
        printf("  %.3f  %6llu   %.1e   %.1e         %.1e     %.1e                 %.0f\n", 0.5*pow(0.7, k),
               z.steps, z.closest,
               z.apart, z.all, z.position, z.seconds*1e3);
    }
    expect("energy error where no pair is closer than 0.1", 0, z.apart, 1e-11);
    expect("the same at all steps: EPS/distance of V at the closest", 0, z.all,
           DBL_EPSILON/4e-4*20/4e-4/12.8);
    int refused = 0;
    for (int k = 0; k < 40; ++k) refused += !passes(0.1 + k*0.01);
    expect("lengths that are refused, of 40 from 0.1 to 0.49", 0, refused, 0);
    (void)run(0.12, DBL_EPSILON, near);
    for (int i = 0; i < 6; ++i) apart = fmax(apart, fabs(near[i] - q[i]));
    printf("  a start moved by 2.2e-16 ends %.1e away\n", apart);
    expect("end state against the reference, in that unit", 0, z.position/apart, 4);
    expect("energy error without a clock, as many steps", 1e-3, without_clock((int)z.steps), INFINITY);
    return verdict("pythagorean");
}
