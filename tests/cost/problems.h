/* problems.h - the problems on which `make cost` compares integrators

   Seventeen mechanical systems, one of them over two lengths, three also with callbacks as a user
   writes them (ordinary.h); the last five want steps that change (encounters.h).  Each is there in three forms with
   the same formulas, so that no method gets a better right-hand side than another:

     acceleration   q'' = a(q), one point a call             the explicit baselines
     slope          y' = f(y), y = (q, p), one point a call  baselines, where M depends on q
     effects, mass  all points of a step at once             gvi.h                             */
#ifndef PROBLEMS_H
#define PROBLEMS_H

#include "gvi.h"

#include <stdio.h>

enum { MOST_COORDINATES = 104 };        /* 100, rounded up to whole vectors    */

#if defined(__GNUC__)
typedef double lane2 __attribute__((vector_size(16), aligned(8), may_alias));
typedef double lane4 __attribute__((vector_size(32), aligned(8), may_alias));
typedef double lane8 __attribute__((vector_size(64), aligned(8), may_alias));

/* Vectors no wider than a register: gcc passes the parts of a wider one through memory.       */
#if defined(__AVX512F__)
typedef lane8 widest;
#elif defined(__AVX__)
typedef lane4 widest;
#else
typedef lane2 widest;
#endif
enum { WIDTH = sizeof(widest)/sizeof(double) };
#endif

/* One point.                                                                                  */
typedef void acceleration_fn(const double *q, double *a);
typedef void slope_fn(const double *y, double *dy);
typedef void law_fn(const double *q, const double *v, double *a);
typedef long double energy_fn(const double *q, const double *v);

typedef struct problem {
    const char        *key, *title;
    int                n;
    double             end;            /* from t = 0                                           */
    const double      *q, *v;          /* at t = 0; v is the momentum where there is a slope   */
    const long double *reference;      /* q at the end, to 25 digits and more                  */
    energy_fn         *energy;
    acceleration_fn   *acceleration;   /* NULL where M depends on q                            */
    slope_fn          *slope;          /* NULL where it does not                               */
    law_fn            *law;            /* q'' = a(q, v), where there is a slope                */
    law_fn            *momentum;       /* p(q, v); NULL: v                                     */
    gvi_mass           mass;
    gvi_formulation    formulation;    /* pinned; 0: momenta with a slope, else positions      */
    const gvi_effect  *effects;
    int                effect_count;
    const gvi_effect  *clocks[2];      /* two effects each: the scene with the clock d^(3/2), d; or NULL */
    double             eccentricity, revolutions;      /* of the orbit that they are for       */
    double             evaluations;    /* of q'' for an error of about 0.1: where sweeps begin */
    double             limit;          /* CPU ms above which no setting is of interest         */
    int                by_dial;        /* in the study of the dial alone                       */
} problem;

extern const problem problems[];
extern const int problem_count;

const problem *problem_named(const char *key);

/* Once, for those who measure: takes the faster of two forms of Kepler's right-hand side and of
   the solar system's, for one point and for many each; and says which.                        */
void problems_begin(void);
void problems_tell(FILE *f);

/* Length in tau of a revolution on Kepler's ellipse of half-axis 1, with dt = |q|^a dtau.     */
double kepler_tau(double eccentricity, double a);

/* max |q_i - reference_i|, subtracted in long double; NaN stays NaN                           */
double problem_error(const problem *p, const double *q);

/* Largest |E - E0|/|E0| at every `every`-th step: NULL where nobody watches.                  */
typedef struct watch {
    const problem *p;
    long           every, count;
    long double    first, worst;
} watch;

watch watch_begin(const problem *p, long every);
void  watch_look(watch *w, const double *q, const double *v);

static inline int watch_due(watch *w) { return w && ++w->count % w->every == 0; }

#endif
