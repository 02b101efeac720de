/* gvi_run.c - one run of gvi.h with one setting; and gvi.h itself, for `make cost`            */
#define GVI_IMPLEMENTATION
#include "gvi_run.h"

#include <stdio.h>
#include <string.h>

static gvi_desc describe(const problem *p, const gvi_setting *g, double parameter)
{
    gvi_desc desc = { .n = p->n, .degree = g->degree, .rule = { .kind = g->rule, .points = g->points },
                      .mass = p->mass, .effects = p->effects, .effect_count = p->effect_count,
                      .formulation = g->formulation, .tolerance = g->tolerance };
    desc.rule.nodes = g->nodes;
    desc.rule.weights = g->weights;
    if (g->dial) desc.resolution = parameter;
    if (g->scene) {
        desc.effects = g->scene;
        desc.effect_count = 2;
    }
    return desc;
}

void gvi_setting_name(const gvi_setting *g, int size, char *name)
{
    static const char *const pinned[] = { "", "explicit", "positions", "velocities", "momenta", "Newton" };
    if (g->rule == GVI_KICKS) {
        snprintf(name, (size_t)size, "kicks %s", g->name);
        return;
    }
    const char *rule = g->rule == GVI_LOBATTO ? " Lobatto" : "", *how = pinned[g->formulation];
    char points[24] = "", tolerance[24] = "", clock[24] = "";
    if (g->points) snprintf(points, sizeof points, ", r = %d", g->points);
    if (g->tolerance > 0) snprintf(tolerance, sizeof tolerance, ", tol %.0e", g->tolerance);
    if (g->power > 0) { snprintf(clock, sizeof clock, ", clock %g", g->power); how = ""; }
    snprintf(name, (size_t)size, "s = %d%s%s%s%s%s%s%s", g->degree, g->dial ? ", dial" : "", rule, points, clock, tolerance,
             *how ? ", " : "", how);
}

int gvi_run_memory(const problem *p, const gvi_setting *g)
{
    gvi_desc desc = describe(p, g, 0.5);
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

/* With a clock: steps in tau until the end is passed, then the state at the end.               */
static void run_clock(const problem *p, const gvi_setting *g, long steps, gvi_stepper *st, watch *w,
                      gvi_result *r)
{
    const double h = g->tau/(double)steps;
    for (long k = 0; st->t < p->end && k < 2*steps && st->status == GVI_OK; ++k) {
        gvi_step(st, h);
        if (watch_due(w) && st->status == GVI_OK) look(p, st, w);
    }
    gvi_state_at(st, p->end, r->q, NULL, r->p);
}

static void run_steps(const problem *p, const gvi_setting *g, long steps, gvi_stepper *st, watch *w)
{
    const double h = p->end/(double)steps;
    if (g->in_a_row && !w) {
        gvi_steps(st, h, (int)steps);
        return;
    }
    for (long k = 0; k < steps && st->status == GVI_OK; ++k) {
        gvi_step(st, h);
        if (watch_due(w) && st->status == GVI_OK) look(p, st, w);
    }
}

static void run_dial(const problem *p, gvi_stepper *st, watch *w)
{
    while (st->status == GVI_OK && st->t < p->end) {
        gvi_advance(st, p->end);
        if (watch_due(w) && st->status == GVI_OK) look(p, st, w);
    }
}

static void end_state(const problem *p, const gvi_stepper *st, gvi_result *r)
{
    memcpy(r->q, st->q, sizeof(double)*(size_t)p->n);
    memcpy(r->p, st->p, sizeof(double)*(size_t)p->n);
}

void gvi_run(const problem *p, const gvi_setting *g, double parameter, double *memory, watch *w, gvi_result *r)
{
    gvi_stepper st;
    gvi_desc desc = describe(p, g, parameter);
    memset(r, 0, sizeof *r);
    gvi_init(&st, &desc, memory, gvi_size(&desc));
    r->status = st.status;
    if (st.status != GVI_OK) return;
    if (p->slope) gvi_start_momentum(&st, 0, p->q, p->v);
    else gvi_start(&st, 0, p->q, p->v);
    if (g->power > 0) run_clock(p, g, (long)parameter, &st, w, r);
    else if (g->dial) run_dial(p, &st, w);
    else run_steps(p, g, (long)parameter, &st, w);
    if (!(g->power > 0)) end_state(p, &st, r);
    r->status = st.status;
    r->steps = (long long)st.counters.steps;
    r->iterations = (long long)st.counters.iterations;
    r->newton_iterations = (long long)st.counters.newton_iterations;
    r->evaluations = (long long)st.counters.effect[0];
    r->refused = (long long)st.counters.failures;
    r->formulation = st.formulation;
}
