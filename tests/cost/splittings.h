/* splittings.h - the compositions and splittings of baselines.c, from their published coefficients   */
#ifndef COST_SPLITTINGS_H
#define COST_SPLITTINGS_H

#include "coefficients.h"
#include <stddef.h>

#ifndef COUNT
#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
#endif

enum { KICKS = 40 };
/* kick[0], then drift[i], kick[i+1] (kick first), or drift[0], then kick[i], drift[i+1].      */
typedef struct splitting { int stages, drift_first; double kick[KICKS], drift[KICKS]; } splitting;

enum { VERLET, YOSHIDA8, KAHAN_LI8, SOFRONIOU10, BLANES_MOAN11, BLANES_MOAN14, SPLITTING8, SPLITTINGS };
static splitting splittings[SPLITTINGS];

/* All of a symmetric row from its first half; the next one closes the sum to 1.               */
static void mirror(int count, const long double *half, long double *all)
{
    int given = (count - 1)/2;
    long double rest = 1;
    for (int i = 0; i < given; ++i) rest -= 2*half[i];
    for (int i = 0; i < count; ++i) {
        int k = i < count - 1 - i ? i : count - 1 - i;
        all[i] = k < given ? half[k] : count % 2 ? rest : rest/2;
    }
}

/* Composition of kick-drift-kick steps gamma_1..gamma_m: adjacent kicks are one.              */
static void compose(splitting *s, int half, const long double *gamma)
{
    long double g[KICKS];
    int m = s->stages = 2*half + 1;
    mirror(m, gamma, g);
    for (int i = 0; i <= m; ++i) {
        s->kick[i] = (double)(((i > 0 ? g[i-1] : 0) + (i < m ? g[i] : 0))/2);
        if (i < m) s->drift[i] = (double)g[i];
    }
}

static void split(splitting *s, int stages, int drift_first, const long double *kick,
                  const long double *drift)
{
    long double k[KICKS], d[KICKS];
    int kicks = drift_first ? stages : stages + 1, drifts = drift_first ? stages + 1 : stages;
    mirror(kicks, kick, k);
    mirror(drifts, drift, d);
    for (int i = 0; i < kicks; ++i) s->kick[i] = (double)k[i];
    for (int i = 0; i < drifts; ++i) s->drift[i] = (double)d[i];
    s->stages = stages;
    s->drift_first = drift_first;
}

static void splittings_begin(void)
{
    compose(splittings + VERLET, 0, NULL);
    compose(splittings + YOSHIDA8, COUNT(yoshida8), yoshida8);
    compose(splittings + KAHAN_LI8, COUNT(kahan_li8), kahan_li8);
    compose(splittings + SOFRONIOU10, COUNT(sofroniou10), sofroniou10);
    split(splittings + BLANES_MOAN11, 11, 0, blanes_moan11_b, blanes_moan11_a);
    split(splittings + BLANES_MOAN14, 14, 1, blanes_moan14_b, blanes_moan14_a);
    split(splittings + SPLITTING8, 22, 0, splitting8_b, splitting8_a);
}

/* The table as fractions of a step: nodes, the drifts added up, and weights, the kicks.  Returns how many.  */
static int splitting_kicks(const splitting *s, double *nodes, double *weights)
{
    const int kicks = s->drift_first ? s->stages : s->stages + 1;
    long double at = s->drift_first ? s->drift[0] : 0, rest = 1;
    for (int i = 0; i < kicks; ++i) {
        nodes[i] = (double)at;
        weights[i] = s->kick[i];
        rest -= s->kick[i];
        if (i + 1 < kicks) at += s->drift_first ? s->drift[i+1] : s->drift[i];
    }
    if (!s->drift_first) nodes[kicks-1] = 1;
    weights[kicks/2] += (double)rest;
    return kicks;
}

#endif
