/* 14 - Kicks by a table: compositions and splittings without an iteration

   With constant mass and forces of position only, a step may be a row of kicks at
   nodes of the step and free drifts between them.  A table of nodes and weights says
   which: Stoermer-Verlet (order 2), Yoshida's composition of three of them (order 4),
   Kahan and Li's of 17 (order 8; SIAM J. Sci. Comput. 18, 1997).  All get the same
   number of force evaluations for ten revolutions of a planet, e = 0.2.

   prints

     Stoermer-Verlet  kicks a step  1   error of q below 1e-02
     Yoshida 4        kicks a step  3   error of q below 1e-04
     Kahan-Li 8       kicks a step 17   error of q below 1e-08
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static int attraction(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double d2 = X[k]*X[k] + Y[k]*Y[k], w = -1/(d2*sqrt(d2));
        x->f[k] += w*X[k];
        x->f[x->stride + k] += w*Y[k];
    }
    return (void)user, 0;
}

/* Verlet steps of lengths g[0..m-1], h in all: half a kick at both ends of each */
static int compose(int m, const double *g, double *nodes, double *weights)
{
    double t = 0;
    for (int j = 0; j <= m; ++j) {
        nodes[j] = j < m ? t : 1;
        weights[j] = ((j > 0 ? g[j - 1] : 0) + (j < m ? g[j] : 0))/2;
        if (j < m) t += g[j];
    }
    return m + 1;
}

int main(void)
{
    enum { EVALUATIONS = 10*765 };
    const double w = 1/(2 - cbrt(2)), verlet[] = { 1 }, yoshida[] = { w, 1 - 2*w, w };
    double kahan_li[17] = {
        0.13020248308889008087881763, 0.56116298177510838456196441, -0.38947496264484728640807860,
        0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
        0.25837438768632204729397911, 0.29501172360931029887096624, 1 };
    for (int j = 0; j < 8; ++j) kahan_li[8] -= 2*(kahan_li[16 - j] = kahan_li[j]);

    const struct { const char *name; int stages; const double *g; } methods[] = {
        { "Stoermer-Verlet", 1, verlet }, { "Yoshida 4", 3, yoshida }, { "Kahan-Li 8", 17, kahan_li } };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    for (int i = 0; i < 3; ++i) {
        static double memory[GVI_LENGTH(2, 1, 18)];
        double nodes[18], weights[18];
        const int m = methods[i].stages, steps = EVALUATIONS/m;
        const gvi_rule rule = { GVI_KICKS, compose(m, methods[i].g, nodes, weights), nodes, weights };
        const gvi_desc desc = { .n = 2, .rule = rule, .effects = scene, .effect_count = 1 };
        gvi_stepper st;
        gvi_init(&st, &desc, memory, sizeof memory);
        gvi_start(&st, 0, (double[]){ 0.8, 0 }, (double[]){ 0, sqrt(1.5) });
        for (int k = 0; k < steps && st.status == GVI_OK; ++k) gvi_step(&st, 20*acos(-1)/steps);
        if (st.status != GVI_OK) return puts(gvi_status_text(st.status)), 1;
        const double error = hypot(st.q[0] - 0.8, st.q[1]);         // ten periods of 2 pi: back at the start
        printf("%-15s  kicks a step %2llu   error of q below %.0e\n", methods[i].name,
               st.counters.effect[0]/st.counters.steps, pow(10, ceil(log10(error))));
    }
    return 0;
}
