/* stiff.c - fast and slow together: a stiff double pendulum, the Fermi-Pasta-Ulam chain

   Pendulum: a spring K q2^2/2 in the joint, frequency sqrt(5K); problem, start, K = 32^2 and
   64^2 and h = 2^-7 are those of Antonana, Makazaga, Murua, arXiv 1703.07697.  Chain: Hairer,
   Lubich, Wanner, Geometric numerical integration, I.5.1: three stiff springs of frequency
   omega = 50, linked by soft quartic ones; the energy of all stiff springs, I, is an adiabatic invariant that varies by O(1/omega).
   Numerically it is lost at resonances, where the method turns the fast oscillation by
   theta = k pi a step: at h omega = k pi for small steps, later for large ones, since
   Gauss's method turns by no more than s pi in all.

     stiff [folder for hard_fpu.svg]                                            */
#include "pendulum.h"
#include "tools/svg.h"

static double omega = 50;
#include "problems.h"

/* ------------------------------------------------------------- stiff pendulum */

enum { PER = 128 };                                      /* steps a unit of time */

static void start_pendulum(double K, int s, gvi_stepper *st)
{
    static double memory[GVI_LENGTH(2, 12, 12)];
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pendulum_forces } };
    const gvi_desc desc = { .n = 2, .degree = s, .effects = scene, .effect_count = 1,
                            .mass = pendulum_inertia };
    const double q[2] = { 1.1, -1.1/sqrt(1 + 100*K) }, p[2] = { 2.7746, 2.7746 };
    stiffness = K;
    must(gvi_init(st, &desc, memory, sizeof memory));
    must(gvi_start_momentum(st, 0, q, p));
}

typedef struct pendulum_run { double energy, walk, newton, contraction; } pendulum_run;

/* To t = 1024, degree s.  walk: standard deviation of dE/E if dp and dq of each step are wrong
   by EPS/2 of themselves, at random, and no more */
static pendulum_run run_pendulum(double K, int s)
{
    pendulum_run z = { 0, 0, 0, 0 };
    gvi_stepper st;
    start_pendulum(K, s, &st);
    const long double E0 = pendulum_energy(st.q, st.p);
    for (int k = 0; k < 1024*PER; ++k) {
        const double u = st.p[0], w = st.p[1];
        double v[2];
        must(gvi_step(&st, 1.0/PER));
        must(gvi_velocity(&st, v));
        z.walk += pow(fabs(v[0]*(st.p[0] - u)) + fabs(v[1]*(st.p[1] - w)), 2);
        z.energy = fmax(z.energy, (double)fabsl(pendulum_energy(st.q, st.p)/E0 - 1));
    }
    z.walk = DBL_EPSILON*sqrt(z.walk/6)/(double)fabsl(E0);
    z.newton = (double)st.counters.newton_iterations/(1024.0*PER);
    z.contraction = (double)st.counters.worst_contraction;
    return z;
}

/* Degree 6 at 2^-7 has truncation at these frequencies: h omega = 0.56 and 1.1.  Twice the
   degree shows what rounding leaves.                                           */
static void stiff_pendulum(double K)
{
    static const int degrees[] = { 6, 8, 10, 12 };
    pendulum_run z = { 0, 0, 0, 0 };
    char name[64];
    for (int k = 0; k < COUNT(degrees); ++k) {
        z = run_pendulum(K, degrees[k]);
        printf("  K = %g, degree %d: energy %.1e, walk %.1e, contraction %.2f,"
               " %.1f Newton iterations a step\n", K, degrees[k], z.energy, z.walk, z.contraction, z.newton);
    }
    snprintf(name, sizeof name, "energy error in units of that walk, K = %g, degree 12", K);
    expect(name, 0, z.energy/z.walk, 4);
}

/* ------------------------------------------------------------------------ FPU */

enum { M = 3, POINTS = 240 };

static double stiff_energy(const double *q, const double *p)
{
    double I = 0;
    for (int j = M; j < 2*M; ++j) I += (p[j]*p[j] + omega*omega*q[j]*q[j])/2;
    return I;
}

static double chain_energy(const double *q, const double *p)
{
    double E = stiff_energy(q, p);
    for (int j = 0; j < M; ++j) E += p[j]*p[j]/2;
    for (int j = 0; j <= M; ++j) {
        const double u = (j < M ? q[j] - q[M + j] : 0) - (j > 0 ? q[j - 1] + q[M + j - 1] : 0);
        E += u*u*u*u/4;
    }
    return E;
}

typedef struct outcome { double invariant, energy; gvi_status status; } outcome;

/* Largest deviations of I and H from their start, over 200 units of time */
static outcome run_chain(int s, double h_omega)
{
    static double memory[GVI_LENGTH(6, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = fermi_pasta_ulam_forces, .user = &omega } };
    const gvi_desc desc = { .n = 2*M, .degree = s, .effects = scene, .effect_count = 1 };
    const double q[6] = { 1, 0, 0, 1/omega, 0, 0 }, p[6] = { 1, 0, 0, 1, 0, 0 }, h = h_omega/omega;
    const double I0 = stiff_energy(q, p), E0 = chain_energy(q, p);
    outcome z = { 0, 0, GVI_OK };
    gvi_stepper st;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start_momentum(&st, 0, q, p));
    while (st.t < 200 && z.status == GVI_OK) {
        z.status = gvi_step(&st, h);
        if (z.status != GVI_OK) break;
        z.invariant = fmax(z.invariant, fabs(stiff_energy(st.q, st.p) - I0));
        z.energy = fmax(z.energy, fabs(chain_energy(st.q, st.p) - E0));
    }
    return z;
}

/* Angle by which Gauss's method of degree s turns an oscillation: e^(i theta) = P(iz)/P(-iz),
   P the diagonal Pade numerator of exp; 2 arg P(iz), followed from z = 0          */
static double turn(int s, double z)
{
    double last = 0;
    for (int k = 1; k <= 400; ++k) {
        const double y = z*k/400;
        double re = 0, im = 0, c = 1;
        for (int j = 0; j <= s; ++j) {
            const int quarter = j % 4;
            if (quarter % 2 == 0) re += quarter == 0 ? c : -c;
            else im += quarter == 1 ? c : -c;
            c *= y*(s - j)/((double)(2*s - j)*(j + 1));
        }
        double a = atan2(im, re);
        while (a < last - 1.6) a += acos(-1);
        last = a;
    }
    return 2*last;
}

static double resonance(int s, int k)                    /* h omega at which theta = k pi, or NaN */
{
    double lo = 0, hi = 50;
    if (turn(s, hi) < k*acos(-1)) return NAN;
    for (int i = 0; i < 60; ++i) {
        const double z = (lo + hi)/2;
        if (turn(s, z) < k*acos(-1)) lo = z;
        else hi = z;
    }
    return lo;
}

static void fermi_pasta_ulam(const char *folder)
{
    static const int degrees[] = { 2, 4, 8 };
    static double x[3][POINTS], I[3][POINTS];
    static char names[3][64];
    svg_line lines[3];
    int failures = 0;
    double worst = 0, calm = 0;
    for (int d = 0; d < 3; ++d) {
        const int s = degrees[d];
        double top = 0, below = 0;
        for (int k = 0; k < POINTS; ++k) {
            const double z = 0.1*pow(500, k/(POINTS - 1.0));
            const outcome o = run_chain(s, z);
            progress("FPU", d*POINTS + k + 1, 3*POINTS);
            x[d][k] = z;
            I[d][k] = o.status == GVI_OK ? o.invariant : NAN;
            if (o.status != GVI_OK) { ++failures; continue; }
            worst = fmax(worst, o.energy);
            top = fmax(top, o.energy);
            if (z < 6.3) below = fmax(below, o.energy);
            if (z < 1) calm = fmax(calm, o.invariant);
        }
        snprintf(names[d], sizeof names[d], "degree %d", s);
        lines[d] = (svg_line){ names[d], x[d], I[d], POINTS };
        printf("  degree %d: resonances theta = k pi at h omega =", s);
        for (int k = 1; k < s; ++k) printf(" %.2f", resonance(s, k));
        printf("\n    deviation of H: h omega < 2 pi %.1e, to 50 %.1e\n", below, top);
        for (int k = 1; k < s; ++k) {
            const double at = resonance(s, k);
            double near = 0;
            for (int i = 0; i < POINTS; ++i)
                if (fabs(x[d][i]/at - 1) < 0.03 && I[d][i] > near) near = I[d][i];
            if (at < 50) printf("    k = %d, %.2f: largest deviation of I near it %.2g\n", k, at, near);
        }
    }
    printf("  steps refused with a status: %d runs of %d\n", failures, 3*POINTS);
    expect("h omega < 1: deviation of I, O(1/omega)", 0.01, calm, 0.2);
    expect("deviation of H = 2.0, all degrees and all h omega", 0, worst, 4);
    if (folder) {
        char path[512];
        const svg_plot plot = { .title = "FPU chain: adiabatic invariant", .x_label = "h omega",
                                .y_label = "largest |I - I(0)|, t to 200", .log_x = 1, .log_y = 1,
                                .lines = lines, .line_count = 3 };
        snprintf(path, sizeof path, "%s/hard_fpu.svg", folder);
        if (svg_write(path, &plot)) { printf("  FAILED: %s\n", path); ++misses; }
    }
}

int main(int argc, char **argv)
{
    printf("Stiff double pendulum, 131072 steps of 2^-7\n");
    stiff_pendulum(1024);
    stiff_pendulum(4096);
    printf("Fermi-Pasta-Ulam chain, omega = 50\n");
    fermi_pasta_ulam(argc > 1 ? argv[1] : NULL);
    return verdict("stiff");
}
