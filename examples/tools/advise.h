/* advise.h - which degree, rule, step and tolerance for a wanted error?

   advise_find runs a scene for a short while with one setting after the other and
   returns the cheapest one that has the wanted error at the horizon:

     1 reference   the scene over a window, a sixteenth of the horizon, with
                   degree 12 and steps that are made shorter until two runs agree to
                   a thirtieth of the error looked for, or to rounding
     2 growth      a pilot (degree 6, error about 1e-7 in the window) goes on to the
                   horizon; what its error has grown by, the errors of others will,
                   too, being of the same cause: an error of the energy, or of a
                   frequency, which stays what it is, and moves the phase in
                   proportion to time; friction or chaos, which do with every error
                   what they do.  If the horizon is too far: the power of t by which
                   the pilot's error grows inside the window, at least 1.
     3 trials      for each setting the number of steps by which the error in the
                   window becomes (wanted error)/(growth): a few runs, Newton's
                   method in log error over log steps.  A window in which that is
                   below rounding is doubled.
     4 proof       the cheapest settings go to the horizon, and their steps are
                   corrected, until none that has not been there is predicted to
                   be cheaper.

   A tolerance leaves errors that grow faster than those of steps (t^1.5 to t^2):
   step 4 finds that.  Where the horizon is too far for it, no tolerances are tried.

   Errors are those of q, in the maximum norm, divided by the largest |q_i|; in the
   window those of p as well, so that nothing depends on the phase that the motion
   is in.  Cost is CPU time, or counted: see advise_counted.                   */
#ifndef ADVISE_H
#define ADVISE_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ADVISE_SETTINGS = 64, ADVISE_SAMPLES = 4, ADVISE_TABLES = 8 };

typedef struct advise_kicks {          /* a splitting                          */
    const char   *name;
    int           order, points;
    const double *nodes, *weights;
} advise_kicks;

typedef struct advise_case {
    gvi_desc      desc;                /* n, mass and effects count            */
    const double *q, *v;               /* at t = 0; v is the momentum if       */
    int           momentum;
    double        horizon, h;          /* h: a step worth beginning with       */
    double        weight[GVI_EFFECTS]; /* operations a point, for counted cost */
    advise_kicks  kicks[ADVISE_TABLES];
    int           kicks_count;
} advise_case;

typedef struct advise_options {
    double error;                      /* wanted at the horizon                */
    double seconds;                    /* of CPU time, for any single run: 2;  */
                                       /* after eight times that it is broken off */
    int    counted;                    /* cost is counted, not measured        */
    void (*say)(const char *line);     /* or NULL                              */
} advise_options;

typedef struct advise_setting {
    int           degree, order, points;
    gvi_rule_kind rule;
    double        tolerance;
    const advise_kicks *kicks;
    /* found */
    double        steps;               /* in the window                        */
    double        cost;                /* to the horizon                       */
} advise_setting;

typedef struct advise_result {
    advise_setting setting;
    double h, error, cost, growth, power;    /* error: at the horizon          */
    long   steps;
    int    proved;                     /* measured there, not extrapolated     */
    int    runs;
    double spent;                      /* cost of all runs                     */
    const char *why;                   /* nothing was found: a sentence        */
} advise_result;

struct advise_run {
    gvi_status status;
    int        newton;                 /* so coarse that Newton's method was needed */
    double    *z;                      /* [SAMPLES][2n]: q and p               */
    double     cost, seconds;
};

struct advise {
    const advise_case    *a;
    const advise_options *o;
    advise_result        *result;
    double                window, size[2], target, best;    /* size: of q, of p */
    double                guess;                 /* steps of degree 1 in the window */
    gvi_formulation       pinned;                /* of the runs: no Newton where it can do without */
    int                   sizing;                /* look for the sizes           */
    double               *reference, *far, *z;   /* in the window, to the horizon, of a run */
    advise_setting        list[ADVISE_SETTINGS];
    int                   count, proof;
};

static inline void advise_say(const struct advise *x, const char *line)
{
    if (x->o->say) x->o->say(line);
}

static inline const char *advise_name(const advise_setting *s, char *name, size_t size)
{
    char tolerance[32] = "", points[32] = "";
    if (s->kicks) { snprintf(name, size, "kicks, %s", s->kicks->name); return name; }
    if (s->tolerance > 0) snprintf(tolerance, sizeof tolerance, ", tolerance %.0e", s->tolerance);
    if (s->points) snprintf(points, sizeof points, ", %d points", s->points);
    snprintf(name, size, "degree %d, %s%s%s", s->degree, s->rule == GVI_LOBATTO ? "Lobatto" : "Gauss", points,
             tolerance);
    return name;
}

static inline gvi_desc advise_desc(const advise_case *a, const advise_setting *s)
{
    gvi_desc d = a->desc;
    d.degree = s->degree;
    d.tolerance = s->tolerance;
    d.rule = (gvi_rule){ .kind = s->rule, .points = s->points };
    if (!s->kicks) return d;
    d.rule = (gvi_rule){ GVI_KICKS, s->kicks->points, s->kicks->nodes, s->kicks->weights };
    d.degree = 1;
    d.formulation = GVI_EXPLICIT;
    return d;
}

/* ---------------------------------------------------------------- one run */

static inline double advise_largest(int n, const double *a, const double *b)
{
    double most = 0;
    for (int k = 0; k < n; ++k) {
        const double d = fabs(a[k] - (b ? b[k] : 0));
        if (!(d <= most)) most = d;
    }
    return most;
}

/* Operations: `weight` for a point of an effect; a row of an r*r matrix for each
   coordinate and point an iteration, twice where there are velocities, and for
   the extrapolation at its start; LU and substitutions of Newton's method; some
   300 a step, and 10 a coordinate and point for what is done to vectors.       */
static inline double advise_counted(const advise_case *a, const gvi_stepper *st)
{
    const gvi_counters *c = &st->counters;
    const double n = st->n, r = st->r, N = n*st->s, steps = (double)c->steps;
    const double products = st->formulation == GVI_POSITIONS ? 1 : 2;
    double cost = steps*(300 + 10*n*r);
    for (int e = 0; e < a->desc.effect_count; ++e) cost += a->weight[e]*(double)c->effect[e];
    if (st->formulation == GVI_EXPLICIT) return cost;
    cost += ((double)c->iterations*products + 2*steps)*n*r*r;
    return cost + (double)c->factorizations*N*N*N/1.5 + (double)c->newton_iterations*(2*N*N + 4*N*r);
}

/* `steps`, a multiple of SAMPLES, over `span`.  Time: the least of three, where short. */
static inline struct advise_run advise_go(struct advise *x, const advise_setting *s, double span,
                                          double steps)
{
    gvi_desc d = advise_desc(x->a, s);
    const int n = d.n, repeats = x->o->counted ? 1 : 3;
    int late = 0;
    struct advise_run run = { GVI_OK, 0, x->z, HUGE_VAL, HUGE_VAL };
    gvi_stepper st;
    if (!s->kicks && x->a->desc.formulation == GVI_AUTO) d.formulation = x->pinned;
    double *memory = (double *)malloc(gvi_size(&d) + 1);
    for (int k = 0; memory && k < repeats && (k == 0 || run.seconds < 0.02) && run.status == GVI_OK; ++k) {
        const clock_t begin = clock();
        gvi_init(&st, &d, memory, gvi_size(&d));
        if (x->a->momentum) gvi_start_momentum(&st, 0, x->a->q, x->a->v);
        else gvi_start(&st, 0, x->a->q, x->a->v);
        for (int sample = 0; sample < ADVISE_SAMPLES; ++sample) {
            for (long i = 0; (double)i < steps/(int)ADVISE_SAMPLES && st.status == GVI_OK && !late; ++i) {
                gvi_step(&st, span/steps);
                late = i%64 == 63 && (double)(clock() - begin) > 8*x->o->seconds*CLOCKS_PER_SEC;
                if (!x->sizing) continue;
                x->size[0] = fmax(x->size[0], advise_largest(n, st.q, NULL));
                x->size[1] = fmax(x->size[1], advise_largest(n, st.p, NULL));
            }
            if (st.status != GVI_OK || late) break;
            memcpy(x->z + 2*sample*n, st.q, (size_t)n*sizeof(double));
            memcpy(x->z + (2*sample + 1)*n, st.p, (size_t)n*sizeof(double));
        }
        run.seconds = fmin(run.seconds, (double)(clock() - begin)/CLOCKS_PER_SEC);
        run.status = late ? GVI_E_CONVERGENCE : st.status;
        run.newton = st.counters.newton_iterations > 0;
        run.cost = x->o->counted ? advise_counted(x->a, &st) : run.seconds;
        x->result->spent += run.cost;
    }
    if (!memory) run.status = GVI_E_MEMORY;
    free(memory);
    ++x->result->runs;
    return run;
}

/* Of sample k, in units of the motion: of q, or of q and p.                     */
static inline double advise_error_at(const struct advise *x, const double *z, const double *right, int k,
                                     int both)
{
    const int n = x->a->desc.n;
    const double q = advise_largest(n, z + 2*k*n, right + 2*k*n)/(x->size[0] > 0 ? x->size[0] : 1);
    const double p = advise_largest(n, z + (2*k + 1)*n, right + (2*k + 1)*n)
                   / (x->size[1] > 0 ? x->size[1] : 1);
    return both && !(p <= q) ? p : q;
}

static inline double advise_error(const struct advise *x, const double *z, const double *right)
{
    double most = 0;
    for (int k = 0; k < ADVISE_SAMPLES; ++k) {
        const double d = advise_error_at(x, z, right, k, 1);
        if (!(d <= most)) most = d;
    }
    return most;
}

static inline double advise_fours(double steps)
{
    const int samples = ADVISE_SAMPLES;
    return samples*ceil(fmax(steps, 1)/samples - 1e-9);
}

/* -------------------------------------------------------------- reference */

/* To `right`: the scene over span, exact to goal or to rounding.  0: it cannot be had.
   Returns the steps that it took.                                             */
static inline double advise_reference(struct advise *x, double span, double goal, double h, double *right)
{
    const advise_setting fine = { .degree = 12, .order = 24 };
    const int n = x->a->desc.n;
    double last = HUGE_VAL;
    int have = 0;
    double steps = advise_fours(span/h);
    for (int k = 0; k < 14; ++k, steps = advise_fours(1.4*steps + 1)) {
        if (x->sizing) x->size[0] = x->size[1] = 0;           // coarse runs may go astray
        const struct advise_run run = advise_go(x, &fine, span, steps);
        if (run.status != GVI_OK) {
            if (run.seconds > x->o->seconds) return 0;
            have = 0;
            continue;
        }
        const double off = have ? advise_error(x, run.z, right) : HUGE_VAL;
        memcpy(right, run.z, (size_t)(2*ADVISE_SAMPLES*n)*sizeof(double));
        have = 1;
        if (off <= goal || (off < 1e-9 && off > last/2)) {
            x->sizing = 0;
            return steps;
        }
        if (run.seconds > x->o->seconds) return 0;
        last = off;
    }
    return 0;
}

/* ----------------------------------------------------------------- trials */

/* Fewest steps in the window for the target, by which `s` is filled in; cost, or infinity. */
static inline double advise_trial(struct advise *x, advise_setting *s)
{
    double steps = s->steps, before = 0, error_before = 0, failed = 0, power = s->order;
    s->cost = HUGE_VAL;
    for (int k = 0; k < 8; ++k) {
        const struct advise_run run = advise_go(x, s, x->window, steps);
        if (run.status != GVI_OK) {
            if (run.seconds > x->o->seconds) return s->cost;
            failed = steps;
            if (before < steps) before = 0;
            steps = advise_fours(before > 0 ? sqrt(before*steps) : 1.6*steps);
            continue;
        }
        const double error = fmax(advise_error(x, run.z, x->reference), 1e-17);
        const double cost = run.cost*x->a->horizon/x->window;
        if (before > 0 && fabs(log(steps/before)) > 0.05) {
            power = log(error_before/error)/log(steps/before);
            if (power < 1 && error > x->target) return s->cost;                  // more steps do not help
            power = fmin(fmax(power, 0.6*s->order), 1.4*s->order);
        }
        // near this number of steps error and cost follow powers of it; from further away, or from
        // errors of rounding, `exact` is but what to try next
        const double exact = steps*pow(error/x->target, 1/power);
        if (error < 8*x->target) {
            s->steps = error > x->target/8 ? exact : steps;
            s->cost = cost*s->steps/steps;
        }
        if (error < 1.2*x->target && error > x->target/8) return s->cost;
        if (cost*exact/steps > 3*x->best && error < 0.03 && !run.newton) return s->cost;    // takes too long
        if (run.seconds > x->o->seconds && error > x->target) return s->cost;
        before = steps;
        error_before = error;
        steps = advise_fours(fmin(fmax(fmax(exact*1.03, sqrt(failed*steps)), steps/6), steps*6));
        if (fabs(steps - before) < 1) return s->cost;
    }
    return s->cost;
}

static inline void advise_list(struct advise *x, advise_setting s)
{
    if (x->count < ADVISE_SETTINGS) x->list[x->count++] = s;
}

static inline void advise_try(struct advise *x, advise_setting s)
{
    char name[96], line[240];
    const gvi_desc d = advise_desc(x->a, &s);
    if (gvi_size(&d) == 0) return;                            // the scene has no such formulation
    if (!(s.steps > 0)) s.steps = advise_fours(x->guess/(s.kicks ? s.points/6.0 : s.degree));
    const double cost = advise_trial(x, &s);
    if (cost < HUGE_VAL) {
        advise_list(x, s);
        x->best = fmin(x->best, cost);
    }
    advise_name(&s, name, sizeof name);
    if (cost < HUGE_VAL)
        snprintf(line, sizeof line, "  %-44s h = %-10.4g cost %.3g", name, x->window/s.steps, cost);
    else snprintf(line, sizeof line, "  %-44s not to be had, or too slow", name);
    advise_say(x, line);
}

static inline int advise_by_cost(const void *a, const void *b)
{
    const double x = ((const advise_setting *)a)->cost, y = ((const advise_setting *)b)->cost;
    return (x > y) - (x < y);
}

static inline void advise_sort(struct advise *x)
{
    qsort(x->list, (size_t)x->count, sizeof *x->list, advise_by_cost);
}

/* Degrees first; then splittings; then, with the best degrees, tolerances and
   Lobatto's rule.                                                             */
static inline void advise_trials(struct advise *x)
{
    static const int degrees[] = { 8, 6, 10, 4, 12, 5, 7, 3, 16, 2 };
    static const double tolerances[] = { 1e-2, 1e-3, 1e-4, 1e-5, 1e-6 };        // of the error
    for (int i = 0; i < 10; ++i)
        advise_try(x, (advise_setting){ .degree = degrees[i], .order = 2*degrees[i] });
    for (int i = 0; i < x->a->kicks_count; ++i) {
        const advise_kicks *k = &x->a->kicks[i];
        advise_try(x, (advise_setting){ .degree = 1, .order = k->order, .points = k->points,
                                        .rule = GVI_KICKS, .kicks = k });
    }
    advise_sort(x);
    advise_setting best[4];
    int taken = 0;
    for (int i = 0; i < x->count && taken < 4; ++i)
        if (!x->list[i].kicks) best[taken++] = x->list[i];
    for (int i = 0; i < taken; ++i) {
        advise_setting lobatto = best[i];
        best[i].steps = lobatto.steps = advise_fours(best[i].steps);
        lobatto.rule = GVI_LOBATTO;
        if (i < 2) advise_try(x, lobatto);
        for (int k = 0; x->proof && k < 5; ++k) {
            best[i].tolerance = fmax(tolerances[k]*x->o->error, 1e-16);
            advise_try(x, best[i]);
        }
    }
    advise_sort(x);
}

/* ------------------------------------------------------- growth and proof */

/* What an error in the window is multiplied by until the horizon.             */
static inline double advise_growth(struct advise *x, double h)
{
    const double span = x->a->horizon, ratio = span/x->window;
    advise_setting pilot = { .degree = 6, .order = 12 };
    char line[240];
    double early, late, power = 1;
    for (double goal = 1e-7; goal > 1e-12; goal /= 30) {
        x->target = goal;
        x->best = HUGE_VAL;
        pilot.steps = advise_fours(x->guess/6);
        if (!(advise_trial(x, &pilot) < HUGE_VAL)) return 0;
        const double steps = advise_fours(pilot.steps);
        struct advise_run run = advise_go(x, &pilot, x->window, steps);
        const double error = advise_error(x, run.z, x->reference);
        early = advise_error_at(x, run.z, x->reference, 0, 1);
        power = log(error/early)/log((double)ADVISE_SAMPLES);
        power = fmax(1, power);
        if (!x->proof) return pow(ratio, power);
        if (run.seconds*ratio > x->o->seconds) break;         // the horizon is too far
        if (!(advise_reference(x, span, 1e-3*goal*ratio, h, x->far) > 0)) break;
        run = advise_go(x, &pilot, span, advise_fours(steps*ratio));
        late = advise_error_at(x, run.z, x->far, ADVISE_SAMPLES - 1, 1);
        x->result->power = log(late/error)/log(ratio);
        snprintf(line, sizeof line, "growth: an error of %.1e at t = %g is %.1e at t = %g, like t^%.1f%s",
                 error, x->window, late, span, x->result->power, x->result->power > 3 ? ": chaos?" : "");
        advise_say(x, line);
        if (late < 3e-3) return fmax(late, 0.1*error)/error;
    }
    x->proof = 0;
    x->result->power = power;
    return pow(ratio, power);
}

/* To the horizon and back to the right number of steps.                        */
static inline void advise_prove(struct advise *x, advise_setting *s)
{
    const double span = x->a->horizon, wanted = x->o->error;
    const double first = advise_fours(s->steps*span/x->window);
    double steps = first, power = s->order, before = 0, error_before = 0;
    char name[96], line[280];
    for (int k = 0; k < 8; ++k) {
        const struct advise_run run = advise_go(x, s, span, steps);
        double error = HUGE_VAL;
        if (run.status == GVI_OK) error = advise_error_at(x, run.z, x->far, ADVISE_SAMPLES - 1, 0);
        snprintf(line, sizeof line, "  %-44s h = %-10.4g cost %-10.3g error %.1e",
                 advise_name(s, name, sizeof name), span/steps, run.cost, error);
        advise_say(x, line);
        if (!(error < 1)) return;
        if (error <= wanted && run.cost < x->result->cost) {
            const double spent = x->result->spent, growth = x->result->growth, p = x->result->power;
            const int runs = x->result->runs;
            *x->result = (advise_result){ .setting = *s, .h = span/steps, .error = error, .cost = run.cost,
                                          .growth = growth, .power = p, .steps = (long)steps, .proved = 1,
                                          .runs = runs, .spent = spent };
        }
        if (error <= wanted && error > wanted/4) return;
        if (before > 0 && fabs(steps/before - 1) > 1e-3) {
            power = log(error_before/error)/log(steps/before);
            if (!(power > 0.5*s->order)) {
                if (!(s->tolerance > 1e-15)) return;          // rounding
                s->tolerance /= 10;                           // is what limits it, at the first steps as well
                steps = first;
                power = s->order;
                before = 0;
                continue;
            }
            power = fmin(power, 1.5*s->order);
        }
        before = steps;
        error_before = error;
        const double next = advise_fours(steps*pow(fmax(error, 1e-17)/(0.6*wanted), 1/power));
        if (fabs(next - steps) < 1 || (error <= wanted && next > 0.97*steps)) return;
        if (run.cost*next/steps > 1.2*x->result->cost) return;
        steps = next;
    }
}

static inline void advise_choose(struct advise *x)
{
    advise_result *r = x->result;
    r->cost = HUGE_VAL;
    for (int k = 0; x->proof && k < x->count && k < 16; ++k)
        if (x->list[k].cost < r->cost) advise_prove(x, &x->list[k]);
    if (x->proof || x->count == 0) return;
    int k = 0;
    while (k < x->count - 1 && x->list[k].tolerance > 0) ++k;                    // none without proof
    r->setting = x->list[k];
    r->steps = (long)ceil(r->setting.steps*x->a->horizon/x->window);
    r->h = x->a->horizon/(double)r->steps;
    r->error = x->o->error;
    r->cost = r->setting.cost;
}

/* The formulation that the scene has without Newton's method.  NULL, or why the scene does not start. */
static inline const char *advise_pin(struct advise *x)
{
    const advise_setting s = { .degree = 8, .order = 16 };
    const gvi_desc d = advise_desc(x->a, &s);
    double *memory = (double *)malloc(gvi_size(&d) + 1);
    gvi_stepper st;
    gvi_status status = memory ? gvi_init(&st, &d, memory, gvi_size(&d)) : GVI_E_MEMORY;
    x->pinned = status ? GVI_AUTO : st.formulation;
    if (!status) status = x->a->momentum ? gvi_start_momentum(&st, 0, x->a->q, x->a->v) : gvi_start(&st, 0, x->a->q, x->a->v);
    free(memory);
    return !status ? NULL : memory ? gvi_why(&st) : gvi_status_text(status);
}

/* NULL, or what of the case and the options makes no sense.                    */
static inline const char *advise_wrong(const advise_case *a, const advise_options *o)
{
    if (!(a->horizon > 0) || !isfinite(a->horizon)) return "horizon is not a finite number above 0";
    if (!(a->h > 0) || !isfinite(a->h)) return "h, a step worth beginning with, is not a finite number above 0";
    if (a->horizon/a->h > 1e9) return "h is so short that the horizon is more than 1e9 steps away: begin with a longer one";
    if (!(o->error > 0) || !isfinite(o->error)) return "error is not a finite number above 0";
    if (!(o->seconds > 0)) return "seconds, the CPU time of a run, is not above 0";
    if (a->kicks_count > ADVISE_TABLES) return "kicks_count is above ADVISE_TABLES";
    return NULL;
}

/* 0, or -1 if nothing was found that comes to the wanted error: result->why.   */
static inline int advise_find(const advise_case *a, const advise_options *o, advise_result *result)
{
    static struct advise x;
    char line[240];
    int shrunk = 0;
    memset(result, 0, sizeof *result);
    x = (struct advise){ .a = a, .o = o, .result = result, .best = HUGE_VAL, .sizing = 1, .proof = 1 };
    result->why = advise_wrong(a, o);
    if (!result->why) result->why = advise_pin(&x);
    if (result->why) return advise_say(&x, result->why), -1;
    const size_t room = (size_t)(2*ADVISE_SAMPLES*a->desc.n)*sizeof(double);
    result->why = "there is no reference: its steps fail, or a window of the horizon takes longer than `seconds`";
    x.reference = (double *)malloc(room);
    x.far = (double *)malloc(room);
    x.z = (double *)malloc(room);
    for (x.window = fmin(a->horizon, fmax(a->horizon/16, 16*a->h)); x.reference && x.far && x.z; ) {
        const double ratio = a->horizon/x.window;
        const double goal = fmax(o->error/ratio/30, 1e-15);
        double steps = advise_reference(&x, x.window, goal, a->h, x.reference);
        if (!(steps > 0) && x.pinned) {                                          // stiff: Newton
            x.pinned = GVI_AUTO;
            steps = advise_reference(&x, x.window, goal, a->h, x.reference);
        }
        if (!(steps > 0) && x.window > 64*a->h && !shrunk++) {                   // takes long, too
            x.window = fmax(x.window/16, 32*a->h);
            advise_pin(&x);
            continue;
        }
        if (!(steps > 0)) break;
        x.guess = 0.8*12*steps;
        result->why = "the error is below rounding, or no setting has it within `seconds`";
        result->growth = ratio > 1 ? advise_growth(&x, x.window/steps*1.4) : 1;
        if (!(result->growth > 0)) break;
        x.target = o->error/result->growth;
        if (x.target < 3e-14 && ratio > 1) {                                     // below rounding
            x.window = fmin(2*x.window, a->horizon);
            continue;
        }
        if (x.target < 1e-15) break;
        snprintf(line, sizeof line, "trials: error %.1e at t = %g%s", x.target, x.window,
                 x.proof ? "" : "; the horizon is too far, extrapolated");
        advise_say(&x, line);
        x.best = HUGE_VAL;
        advise_trials(&x);
        if (x.proof) x.proof = advise_reference(&x, a->horizon, o->error/30, x.window/steps, x.far) > 0;
        advise_say(&x, x.proof ? "proof: to the horizon" : "not proved: the horizon is too far");
        advise_choose(&x);
        if (result->cost < HUGE_VAL) result->why = NULL;
        break;
    }
    free(x.reference);
    free(x.far);
    free(x.z);
    return result->why ? -1 : 0;
}

#endif
