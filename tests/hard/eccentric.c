/* eccentric.c - what a fixed step makes of eccentric orbits, and that it is seen

   Kepler's problem, e = 0.99, 20 revolutions without a clock: at these steps the
   perihelion is stepped over and the planet gets another energy, or is thrown out.
   Nothing in the state says so; what the stepper reports does: its status, its
   counters (iterations, contraction), or the energy that it gives when asked.

   The threshold is one that a caller can have: a fixed point that contracts by less than
   4 an iteration does not resolve the motion, whatever Newton's method makes of it. */
#include "hard.h"
#include "problems.h"

typedef struct report { gvi_status status; double energy, contraction; int iterations; double farthest;
                        } report;

static report run(double e, int degree, int per_revolution, int revolutions, gvi_formulation formulation)
{
    static real memory[GVI_LENGTH(2, 24, 24)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction } };
    const gvi_desc desc = { .n = 2, .degree = degree, .effects = scene, .effect_count = 1,
                            .formulation = formulation };
    const real q[2] = { (real)(1 + e), 0 }, v[2] = { 0, (real)sqrt((1 - e)/(1 + e)) };
    const real h = (real)(2*acos(-1)/per_revolution);
    gvi_stepper st;
    report z = { GVI_OK, 0, 0, 0, 0 };
    real E0 = 0, E = 0;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q, v));
    must(gvi_energy(&st, &E0));
    for (long k = 0; k < (long)revolutions*per_revolution; ++k) {
        z.status = gvi_step(&st, h);
        if (z.status != GVI_OK) break;
        must(gvi_energy(&st, &E));
        z.energy = fmax(z.energy, fabs((double)(E/E0) - 1));
        z.farthest = fmax(z.farthest, hypot((double)st.q[0], (double)st.q[1]));
    }
    z.contraction = (double)st.counters.worst_contraction;
    z.iterations = st.counters.most_iterations;
    return z;
}

int main(void)
{
    static const struct { int degree, steps; gvi_formulation formulation; } coarse[] = {
        { 8, 60, GVI_AUTO }, { 8, 100, GVI_AUTO }, { 8, 200, GVI_AUTO }, { 8, 400, GVI_AUTO }, { 8, 800,
                                                                                                 GVI_AUTO },
        { 16, 100, GVI_AUTO }, { 16, 200, GVI_AUTO }, { 24, 60, GVI_AUTO },
        { 8, 100, GVI_POSITIONS }, { 8, 400, GVI_POSITIONS }, { 8, 400, GVI_NEWTON }, { 2, 1000, GVI_AUTO },
    };
    int silent = 0, wrong = 0;
    printf("Kepler at a fixed step, e = 0.99, 20 revolutions\n");
    printf("  degree steps formulation  energy    farthest  contraction iterations  status\n");
    for (int k = 0; k < COUNT(coarse); ++k) {
        const report z = run(0.99, coarse[k].degree, coarse[k].steps, 20, coarse[k].formulation);
        const int seen = z.status != GVI_OK || z.contraction > 0.25;
        printf("  %4d   %5d %7d      %.1e   %7.2f   %.2f        %4d        %s\n", coarse[k].degree,
               coarse[k].steps,
               coarse[k].formulation, z.energy, z.farthest, z.contraction, z.iterations,
               gvi_status_text(z.status));
        wrong += z.energy > 1e-3;
        silent += z.energy > 1e-3 && !seen;
    }
    const report good = run(0.5, 8, 60, 100, GVI_AUTO);
    printf("  e = 0.5, 60 steps: energy %.1e, contraction %.2f, iterations %d\n", good.energy,
           good.contraction, good.iterations);
    expect("orbits with an energy that is wrong by more than 1e-3", 6, wrong, COUNT(coarse));
    expect("of them, with neither a status nor a worst contraction above 1/4", 0, silent, 0);
    expect("a step that is small enough: contraction", 0, good.contraction, 0.25);
    return verdict("eccentric");
}
