/* 21 - How hard do the rods pull? A double pendulum in Cartesian coordinates

   Two uniform rods of length 1 and mass 1 hang from each other. Coordinates are the ends of the
   rods, (x, y) and (u, w): then the mass is a constant matrix, the weight a constant force, and
   all geometry is in two constraints,

         g1 = (x^2 + y^2 - 1)/2 = 0      g2 = ((u - x)^2 + (w - y)^2 - 1)/2 = 0

   The callback writes g and what is not 0 of the Jacobian dg_a/dq_i, at a*n + i. Multipliers
   come with the state: the force of constraint is G' lambda, so -lambda pulls in a rod of length
   1. Where it is negative the rod is pushed: a thread would hang slack.

   21_rods [--svg file]
   prints

     t = 10: end at 1.621933896 -0.995909818
     against 28 digits, below 1e-13: yes
     lengths kept, energy to 1e-13: yes yes
     tension of the upper rod -0.41 to 9.07, of the lower -0.10 to 5.58
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"

GVI_EACH(rods, 4, rows(2))
{
    const double *q = x->q, a = q[2] - q[0], b = q[3] - q[1];
    double *G1 = x->jacobian, *G2 = G1 + 4;
    x->g[0] = (q[0]*q[0] + q[1]*q[1] - 1)/2;
    x->g[1] = (a*a + b*b - 1)/2;
    G1[0] = q[0], G1[1] = q[1];
    G2[0] = -a, G2[1] = -b, G2[2] = a, G2[3] = b;
}

/* g = 1: half of each rod's weight at each of its ends. */
GVI_EACH(weight, 4, f, value)
{
    x->f[1] -= 1;
    x->f[3] -= 0.5;
    x->value[0] += x->q[1] + x->q[3]/2;
}

enum { STEPS = 400 };
static double t[STEPS], tension[2][STEPS];

static int draw(const char *path)
{
    const svg_line lines[] = { { "upper rod", t, tension[0], STEPS }, { "lower rod", t, tension[1], STEPS } };
    const svg_plot plot = { .title = "Tension of the rods of a double pendulum", .x_label = "t, in sqrt(length/g)",
                            .y_label = "in weights of a rod", .lines = lines, .line_count = 2 };
    return svg_write(path, &plot);
}

int main(int argc, char **argv)
{
    // uniform rods: 1/3 of the mass at each end, and 1/6 between them
    static const double M[16] = { 2/3.0, 0, 1/6.0, 0,  0, 2/3.0, 0, 1/6.0,  1/6.0, 0, 1/3.0, 0,  0, 1/6.0, 0, 1/3.0 };
    static const double end[4] = { 0.9717130808687679, -0.2361645368562504, 1.6219338957314592, -0.9959098178019749 };
    static double memory[GVI_CONSTRAINED_LENGTH(4, 8, 8, 2)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_CONSTRAINT, .points = rods, .rows = 2 } };
    const gvi_desc desc = { .n = 4, .degree = 8, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_DENSE, .matrix = M } };
    double e0 = 0, e = 0, lambda[2], low[2] = { 9, 9 }, high[2] = { -9, -9 }, error = 0, drift = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 1, 0, 1.6, 0.8 }, (double[]){ 0, 0, 0, 0 });
    gvi_energy(&st, &e0);
    for (int k = 0; k < STEPS && st.status == GVI_OK; ++k) {
        gvi_step(&st, 10.0/STEPS);
        gvi_multipliers(&st, lambda);
        for (int i = 0; i < 2; ++i) {
            t[k] = st.t;
            tension[i][k] = -lambda[i];
            low[i] = fmin(low[i], -lambda[i]);
            high[i] = fmax(high[i], -lambda[i]);
        }
        drift = fmax(drift, fabs(hypot(st.q[0], st.q[1]) - 1));
        drift = fmax(drift, fabs(hypot(st.q[2] - st.q[0], st.q[3] - st.q[1]) - 1));
    }
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    if (argc == 3 && !strcmp(argv[1], "--svg")) return draw(argv[2]) ? perror(argv[2]), 1 : 0;
    gvi_energy(&st, &e);
    for (int i = 0; i < 4; ++i) error = fmax(error, fabs(st.q[i] - end[i]));
    printf("t = %g: end at %.9f %.9f\n", st.t, st.q[2], st.q[3]);
    printf("against 28 digits, below 1e-13: %s\n", error < 1e-13 ? "yes" : "no");
    printf("lengths kept, energy to 1e-13: %s %s\n", drift < 1e-15 ? "yes" : "no", fabs(e - e0) < 1e-13 ? "yes" : "no");
    printf("tension of the upper rod %.2f to %.2f, of the lower %.2f to %.2f\n", low[0], high[0], low[1], high[1]);
    return 0;
}
