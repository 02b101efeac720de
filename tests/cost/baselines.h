/* baselines.h - the integrators that gvi.h is compared with in `make cost`, see baselines.c   */
#ifndef BASELINES_H
#define BASELINES_H

#include "problems.h"

typedef struct outcome {
    double    q[MOST_COORDINATES], v[MOST_COORDINATES];   /* at the end        */
    long long evaluations, steps, iterations;
    int       failed;                                     /* gave up           */
} outcome;

typedef struct baseline baseline;
struct baseline {
    const char *name, *family;
    int         structure;      /* symplectic                                                 */
    int         reference;      /* no existing code offers it: shown, but no rival            */
    int         adaptive;       /* parameter: tolerance; otherwise: number of steps           */
    int         first_order;    /* for problems with a slope, otherwise those without         */
    double      cost;           /* evaluations a step, about                                  */
    void      (*run)(const problem *p, const baseline *m, double parameter, watch *w, outcome *o);
    int         option;         /* stages, columns, ... of the method                         */
    int         compensated;    /* sums                                                       */
    double      stop;           /* of an iteration                                            */
};

extern const baseline baselines[];
extern const int baseline_count;

const baseline *baseline_named(const char *name);

/* The table of a splitting that a baseline uses, as fractions of a step: nodes, the drifts added up,
   and weights, the kicks.  Returns how many; 0 for any other baseline.  40 of each is enough.  */
int baseline_kicks(const baseline *b, double *nodes, double *weights);

/* Once, before any other call: the tables that the coefficients make.                         */
void baselines_begin(void);

#endif
