/* run.h - a written scene runs; where it ends, in the scene's own coordinates, and what it took */
#ifndef EVERYDAY_RUN_H
#define EVERYDAY_RUN_H

#include "written.h"

/* How it is driven to its end: `count` steps of h, or by the dial */
typedef struct plan { real h; int count; void (*drive)(gvi_stepper *st, const struct plan *p); int back; } plan;

typedef struct outcome {
    gvi_status status;
    char   why[200];
    int    stuck;
    real   q[MOST], v[MOST];            /* of the scene, copy by copy                                      */
    double cost, iteration;             /* points, and what else Newton's method takes, as points; of one iteration */
    int    points;                      /* r                                                               */
    long   steps, newton;
    gvi_formulation formulation;
    double contraction, resolution;
} outcome;

enum { MEMORY = 1 << 18, STEPS_AT_MOST = 2000 };
static gvi_real memory[MEMORY], other_memory[MEMORY];

/* ---- ways to drive */

static void by_step(gvi_stepper *st, const plan *p)
{
    for (int i = 0; i < p->count && st->status == GVI_OK; ++i) gvi_step(st, p->h);
}

static void by_steps(gvi_stepper *st, const plan *p) { if (p->count > 0) gvi_steps(st, p->h, p->count); }

static void by_pairs(gvi_stepper *st, const plan *p)               /* queries in between, which change nothing */
{
    real q[MOST], v[MOST], energy;
    for (int i = 0; i < p->count && st->status == GVI_OK; ++i) {
        if (gvi_step(st, p->h) != GVI_OK) return;
        gvi_velocity(st, v);
        gvi_energy(st, &energy);
        if (st->order) gvi_curve(st, R(.3), q, v);         /* kicks have none */
    }
}

/* Half of it, saved; nonsense; restored; the rest */
static void restored(gvi_stepper *st, const plan *p)
{
    const int half = p->count/2;
    if (half < 1) { by_step(st, p); return; }
    if (gvi_steps(st, p->h, half) != GVI_OK) return;
    const gvi_stepper saved = *st;
    memcpy(other_memory, memory, sizeof memory);
    if (gvi_steps(st, p->h*R(.7), 2) == GVI_OK) gvi_steps(st, -p->h, 1);
    if (gvi_restore(st, &saved, other_memory) == GVI_OK && p->count > half) gvi_steps(st, p->h, p->count - half);
}

static void there_and_back(gvi_stepper *st, const plan *p)
{
    by_step(st, p);
    for (int i = 0; i < p->count && st->status == GVI_OK; ++i) gvi_step(st, -p->h);
}

static void by_dial(gvi_stepper *st, const plan *p)
{
    const real end = st->t + p->h*(real)p->count;
    while (st->status == GVI_OK && st->t < end && st->counters.steps < STEPS_AT_MOST) gvi_advance(st, end);
}

/* By hand: half of h where a step fails or its measure is above the dial, twice h after each that succeeds */
static void halving(gvi_stepper *st, const plan *p)
{
    const real end = st->t + p->h*(real)p->count;
    real h = 4*(end - st->t);
    for (int tries = 0; st->t < end && tries < STEPS_AT_MOST; ++tries) {
        const real left = end - st->t;
        if (h > left) h = left;
        if (gvi_step(st, h) == GVI_OK) h *= 2;
        else h /= 2;
        if (!(st->t + h > st->t)) return;
    }
}

/* ---- a run */

static double points_taken(const gvi_stepper *st)
{
    double most = (double)st->counters.mass;
    for (int e = 0; e < GVI_EFFECTS; ++e) most = fmax(most, (double)st->counters.effect[e]);
    return most;
}

/* A point costs 50 operations for each coordinate; N unknowns 2/3 N^3 to factor, 2 N^2 to solve. */
static double cost_of(const gvi_stepper *st)
{
    const double n = st->s*(st->n + st->in.con.m), factors = (double)st->counters.factorizations;
    const double newton = (double)st->counters.newton_iterations;
    return points_taken(st) + (newton > 0 ? (factors*2*n*n*n/3 + newton*2*n*n)/(50*st->n) : 0);
}

static void read_end(gvi_stepper *st, const written *w, outcome *out)
{
    const int n = w->scene->n;
    real v[MOST], q[N], u[N];
    out->status = gvi_velocity(st, v);
    if (out->status != GVI_OK) snprintf(out->why, sizeof out->why, "its velocity: %s", gvi_why(st));
    if (out->status != GVI_OK) return;
    for (int c = 0; c < w->copies; ++c) {
        back(w, c, ((st->t - w->date) + st->t_low)/w->time, st->q, v, 1, q, u);
        for (int i = 0; i < n; ++i) out->q[c*n + i] = q[i], out->v[c*n + i] = u[i];
    }
}

static void read_costs(const gvi_stepper *st, outcome *out)
{
    out->cost = cost_of(st);
    out->points = st->r;
    out->iteration = st->r;
    if (st->counters.newton_iterations) out->iteration = out->cost/(double)st->counters.newton_iterations;
    out->steps = (long)st->counters.steps;
    out->newton = (long)st->counters.newton_iterations;
    out->formulation = st->formulation;
    out->contraction = (double)st->counters.worst_contraction;
    out->resolution = (double)st->counters.worst_resolution;
}

typedef struct state { real q[N], v[N]; } state;
static listing listed;

static gvi_status set_up(gvi_stepper *st, const written *w)
{
    list_all(&listed, w);
    gvi_status status = gvi_init(st, &listed.desc, memory, sizeof memory);
    if (status == GVI_OK && listed.idle >= 0) status = gvi_switch(st, listed.idle, 0);
    return status;
}

static outcome run_from(const written *w, const plan *p, const state *from)
{
    gvi_stepper st;
    outcome out;
    real q[MOST], v[MOST];
    plan own = *p;
    memset(&out, 0, sizeof out);
    gvi_status status = set_up(&st, w);
    forth(w, from->q, from->v, q, v);
    if (status == GVI_OK) status = gvi_start(&st, w->date, q, v);
    memset(&st.counters, 0, sizeof st.counters);
    if (!has_clock(w->scene)) own.h *= w->time;
    if (status == GVI_OK) p->drive(&st, &own);
    out.status = st.status;
    out.stuck = st.status == GVI_OK && !has_clock(w->scene) && !p->back
             && st.t < w->date + own.h*(real)own.count*(1 - 64*EPS) - 4*EPS*fabs(w->date);
    snprintf(out.why, sizeof out.why, "%s", gvi_why(&st));
    if (st.status != GVI_OK) return out;
    read_end(&st, w, &out);
    read_costs(&st, &out);
    return out;
}

#endif
