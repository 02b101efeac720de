/* gvi_run.h - one run of gvi.h with one setting, for `make cost`                              */
#ifndef GVI_RUN_H
#define GVI_RUN_H

#include "problems.h"

/* What is varied.  Zero: 8, Gauss, s points, chosen by the scene, at round-off.               */
typedef struct gvi_setting {
    int             degree;
    gvi_rule_kind   rule;
    int             points;
    gvi_formulation formulation;
    double          tolerance;
    const char     *name;              /* GVI_KICKS: of the splitting, and its table           */
    const double   *nodes, *weights;
    const gvi_effect *scene;           /* not NULL: two effects, the second a clock            */
    int             in_a_row;          /* by gvi_steps, where nothing is looked at on the way  */
    int             dial;              /* its parameter is desc.resolution, not a number of steps */
    double          power;             /* of the distance, the clock; 0: there is none         */
    double          tau;               /* of the whole way                                     */
} gvi_setting;

typedef struct gvi_result {
    double          q[MOST_COORDINATES], p[MOST_COORDINATES];  /* at the end                   */
    long long       steps, iterations, newton_iterations, evaluations, refused;
    gvi_status      status;
    gvi_formulation formulation;                               /* of the last step             */
} gvi_result;

/* "s = 8", "s = 8, tol 1e-09", ...                                                            */
void gvi_setting_name(const gvi_setting *g, int size, char *name);

/* parameter: how many steps, or the dial.  Everything from gvi_init to the last step, with a clock to the state at the end; memory: of
   gvi_run_memory doubles.                                                                     */
int  gvi_run_memory(const problem *p, const gvi_setting *g);
void gvi_run(const problem *p, const gvi_setting *g, double parameter, double *memory, watch *w,
             gvi_result *r);

#endif
