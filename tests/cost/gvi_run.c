/* gvi_run.c - one run of gvi.h with one setting; and gvi.h itself, for `make cost`            */
#define GVI_IMPLEMENTATION
#include "gvi_run.h"

#include <stdio.h>
#include <string.h>

static gvi_desc describe(const problem *p, const gvi_setting *g)
{
    gvi_desc desc = { .n = p->n, .degree = g->degree, .rule = { .kind = g->rule, .points = g->points },
                      .mass = p->mass, .effects = p->effects, .effect_count = p->effect_count,
                      .formulation = g->formulation, .tolerance = g->tolerance };
    return desc;
}

void gvi_setting_name(const gvi_setting *g, int size, char *name)
{
    static const char *const pinned[] = { "", "explicit", "positions", "velocities", "momenta", "Newton" };
    const char *rule = g->rule == GVI_LOBATTO ? " Lobatto" : "", *how = pinned[g->formulation];
    char points[24] = "", tolerance[24] = "";
    if (g->points) snprintf(points, sizeof points, ", r = %d", g->points);
    if (g->tolerance > 0) snprintf(tolerance, sizeof tolerance, ", tol %.0e", g->tolerance);
    snprintf(name, (size_t)size, "s = %d%s%s%s%s%s", g->degree, rule, points, tolerance,
             *how ? ", " : "", how);
}

int gvi_run_memory(const problem *p, const gvi_setting *g)
{
    gvi_desc desc = describe(p, g);
    return (int)(gvi_size(&desc)/sizeof(double));
}

/* Velocity for the energy; where M depends on q it takes the momentum as it is.               */
static void look(const problem *p, gvi_stepper *st, watch *w)
{
    double v[MOST_COORDINATES];
    if (p->slope) { watch_look(w, st->q, st->p); return; }
    gvi_velocity(st, v);
    watch_look(w, st->q, v);
}

void gvi_run(const problem *p, const gvi_setting *g, long steps, double *memory, watch *w, gvi_result *r)
{
    gvi_stepper st;
    gvi_desc desc = describe(p, g);
    double h = p->end/(double)steps;
    memset(r, 0, sizeof *r);
    gvi_init(&st, &desc, memory, gvi_size(&desc));
    if (st.status == GVI_OK) {
        if (p->slope) gvi_start_momentum(&st, 0, p->q, p->v);
        else gvi_start(&st, 0, p->q, p->v);
    }
    for (long k = 0; k < steps && st.status == GVI_OK; ++k) {
        gvi_step(&st, h);
        if (watch_due(w) && st.status == GVI_OK) look(p, &st, w);
    }
    r->status = st.status;
    if (st.status == GVI_E_ARGUMENT || st.status == GVI_E_MEMORY || st.status == GVI_E_FORMULATION) return;
    memcpy(r->q, st.q, sizeof(double)*(size_t)p->n);
    memcpy(r->p, st.p, sizeof(double)*(size_t)p->n);
    r->steps = (long long)st.counters.steps;
    r->iterations = (long long)st.counters.iterations;
    r->newton_iterations = (long long)st.counters.newton_iterations;
    r->evaluations = (long long)st.counters.effect[0];
    r->formulation = st.formulation;
}
