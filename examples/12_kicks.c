/* 12 - Kicks by a table: compositions and splittings without an iteration

   With constant mass and forces of position only, a step may be a row of kicks at
   nodes of the step and free drifts between them.  A table of nodes and weights says
   which: Stoermer-Verlet (order 2), Yoshida's composition of three of them (order 4),
   Kahan and Li's of 17 (order 8; SIAM J. Sci. Comput. 18, 1997), and a splitting of
   order 8 of 22 kicks and drifts, which is the one to copy where six digits or more are
   wanted (tests/gen/splitting.py).  All get about as many force evaluations for ten
   revolutions of a planet, e = 0.5.

   prints

     Stoermer-Verlet  kicks a step  1   error of q below 1e-01
     Yoshida 4        kicks a step  3   error of q below 1e-03
     Kahan-Li 8       kicks a step 17   error of q below 1e-06
     splitting 8      kicks a step 22   error of q below 1e-08
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

GVI_EACH(attraction, 2, f)
{
    double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2));
    x->f[0] += w*X;
    x->f[1] += w*Y;
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

/* Kicks b and drifts a of a symmetric splitting, a kick first and one in the middle, from its first half */
static int split(int half, const double *b, const double *a, double *nodes, double *weights)
{
    double t = 0;
    nodes[half] = 0.5;
    weights[half] = 1;
    for (int j = 0; j < half; ++j) {
        nodes[j] = t;
        nodes[2*half - j] = 1 - t;
        weights[j] = weights[2*half - j] = b[j];
        weights[half] -= 2*b[j];
        if (j < half - 1) t += a[j];
    }
    return 2*half + 1;
}

/* Ten revolutions in `steps` steps: they end where they began                    */
static int revolve(const char *name, gvi_rule rule, int steps)
{
    static double memory[GVI_LENGTH(2, 1, 23)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    const gvi_desc desc = { .n = 2, .rule = rule, .effects = scene, .effect_count = 1 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0.5, 0 }, (double[]){ 0, sqrt(3) });
    gvi_steps(&st, 20*acos(-1)/steps, steps);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    const double error = hypot(st.q[0] - 0.5, st.q[1]);
    printf("%-15s  kicks a step %2llu   error of q below %.0e\n", name,
           st.counters.effect[0]/st.counters.steps, pow(10, ceil(log10(error))));
    return 0;
}

int main(void)
{
    enum { EVALUATIONS = 10*1000 };
    const double w = 1/(2 - cbrt(2)), verlet[] = { 1 }, yoshida[] = { w, 1 - 2*w, w };
    double kahan_li[17] = {
        0.13020248308889008087881763, 0.56116298177510838456196441, -0.38947496264484728640807860,
        0.15884190655515560089621075, -0.39590389413323757733623154, 0.18453964097831570709183254,
        0.25837438768632204729397911, 0.29501172360931029887096624, 1 };
    for (int j = 0; j < 8; ++j) kahan_li[8] -= 2*(kahan_li[16 - j] = kahan_li[j]);

    const struct { const char *name; int stages; const double *g; } methods[] = {
        { "Stoermer-Verlet", 1, verlet }, { "Yoshida 4", 3, yoshida }, { "Kahan-Li 8", 17, kahan_li } };
    double nodes[23], weights[23];
    for (int i = 0; i < 3; ++i) {
        const int points = compose(methods[i].stages, methods[i].g, nodes, weights);
        const gvi_rule rule = { GVI_KICKS, points, nodes, weights };
        if (revolve(methods[i].name, rule, EVALUATIONS/methods[i].stages)) return 1;
    }

    const double kicks[] = {
        0.02255151357259981, 0.10752128668344970, 0.03344303945469728, -0.02079, -0.03742, 0.05421835992874599,
        -0.02267460462919294, 0.16086706529831623, 0.44740362398900284, 0.01473, -0.3303 };
    const double drifts[] = {
        0.06893611127615369, 0.23058844925619343, -0.12702730798682120, 0.11040356329995864, -0.16983095339312991,
        -0.04837, 0.15827719598400379, 0.12867470981550479, -0.02402901800352018, 0.01919245966175391 };
    const gvi_rule rule = { GVI_KICKS, split(11, kicks, drifts, nodes, weights), nodes, weights };
    return revolve("splitting 8", rule, EVALUATIONS/22);
}
