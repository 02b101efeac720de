/* cost.c - what accuracy costs: gvi.h and its rivals on the problems of problems.c

     cost [--quick] [--problem P4] [--only gvi|peers] [--out DIR]     the study
     cost --dial [--problem P14] [--out DIR]      what you ask for, what you get, what it takes: gvi.h by its dial beside
                                      fixed steps and rivals that choose their steps
     cost --horizon [--out DIR]       P4 at 1, 10 and 100 times its length
     cost --list                      methods and settings

   Time: the smallest CPU time of at least five runs, from the first line of set-up to the last
   step.  Error: max |q_i - reference| at the end.  Time to an error: the least at which the curve
   of one method and setting, over its steps or tolerances, falls to it, by logarithms between
   two points, if the next finer point confirms it (at most twice the error).  What comes within
   a quarter of the fastest is timed again, in turn: a machine's speed wanders within minutes.
   Energy: largest |E - E0|/|E0| at about 400 times, in a run of its own that is not timed.
   Written: DIR/P1.csv and P1.svg and so on, the table of docs/cost.md to DIR/table.md; all tables and the
   summary to stdout.                                                                          */
#define _POSIX_C_SOURCE 200809L

#include "baselines.h"
#include "gvi_run.h"
#include "tools/svg.h"
#include "horizon.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
enum { SAMPLES = 80, CURVES = 400, ERRORS = 4 };

static const double wanted[ERRORS] = { 1e-4, 1e-7, 1e-10, 1e-12 };

typedef struct options { int quick, gvi, peers, dial; const char *problem, *out; } options;

typedef struct sample {
    double    parameter, ms, error, energy;
    long long steps, evaluations, iterations;
} sample;

typedef struct job {
    const problem     *p;
    const baseline    *rival;          /* or                                                   */
    const gvi_setting *setting;
    double            *memory;
} job;

/* One method with one setting over its parameter, coarse to fine.                             */
typedef struct curve {
    char        name[64];
    const char *family;
    int         ours, structure, reference, count;
    job         job;
    sample      samples[SAMPLES];
} curve;

typedef struct study { const problem *p; int count; curve curves[CURVES]; } study;

/* --------------------------------------------------------------- one run */

static double cpu_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e3 + (double)t.tv_nsec*1e-6;
}

/* Returns the CPU time; an error that is not finite where it gave up.                         */
static double run_once(const job *j, double parameter, watch *w, sample *s)
{
    static outcome o;
    static gvi_result r;
    double begin = cpu_ms(), time;
    if (j->rival) j->rival->run(j->p, j->rival, parameter, w, &o);
    else gvi_run(j->p, j->setting, parameter, j->memory, w, &r);
    time = cpu_ms() - begin;
    s->parameter = parameter;
    s->steps = j->rival ? o.steps : r.steps;
    s->evaluations = j->rival ? o.evaluations : r.evaluations;
    s->iterations = j->rival ? o.iterations : r.iterations + r.newton_iterations;
    int failed = j->rival ? o.failed : r.status != GVI_OK;
    s->error = failed ? HUGE_VAL : problem_error(j->p, j->rival ? o.q : r.q);
    return time;
}

/* At least five runs, and more where they are short.                                          */
static void measure(const job *j, int runs, sample *s)
{
    double total = s->ms;
    for (int k = 1; k < runs || (total < 2 && k < 40); ++k) {
        double ms = run_once(j, s->parameter, NULL, s);
        total += ms;
        if (ms < s->ms) s->ms = ms;
    }
    sample ignored;
    watch w = watch_begin(j->p, (long)(s->steps/400));
    run_once(j, s->parameter, &w, &ignored);
    s->energy = (double)w.worst;
}

/* ----------------------------------------------------------- one curve */

typedef struct sweep { double first, factor, limit, smallest; int runs; } sweep;

/* Is there a sample of ours as exact and in clearly less time?  Then one run of this one will do. */
static int surpassed(const study *y, const sample *s)
{
    for (int i = 0; i < y->count; ++i)
        for (int k = 0; y->curves[i].ours && k < y->curves[i].count; ++k) {
            const sample *z = y->curves[i].samples + k;
            if (z->error <= s->error && z->ms < 0.6*s->ms) return 1;
        }
    return 0;
}

/* Is the parameter an accuracy, from coarse to fine?  Otherwise it is a number of steps.        */
static int chooses(const job *j) { return j->rival ? j->rival->adaptive : j->setting->dial; }

/* Have so many finer steps in a row brought nothing that none will?  The tolerance is the floor then,
   or rounding; steps too long for the motion bring nothing either, and more of them in a row.                */
static int given_up(const job *j, double best, int vain)
{
    if (j->setting && j->setting->dial) return 0;
    if (best < 1e-9) return vain >= 4;
    return j->setting && j->setting->tolerance > 0 && vain >= (best < 1e-3 ? 4 : 12);
}

/* From coarse to fine until it takes too long or finer steps bring nothing any more.          */
static void run_curve(const study *y, const options *o, const sweep *w, curve *c)
{
    const job *j = &c->job;
    double best = HUGE_VAL, before = 0;
    int vain = 0;
    const int adaptive = chooses(j), dial = j->setting && j->setting->dial;
    c->count = 0;
    for (double x = w->first; c->count < SAMPLES; x *= w->factor) {
        sample s;
        if (adaptive ? x < w->smallest : x > 1e9) return;
        s.ms = run_once(j, adaptive ? x : floor(x + 0.5), NULL, &s);
        s.energy = (double)NAN;
        if (s.ms > w->limit && s.ms >= before && (c->count > 0 || !adaptive)) return;
        before = s.ms;
        if (!(s.error < 1) || s.ms > w->limit) continue;
        if (j->rival || dial || !surpassed(y, &s)) measure(j, w->runs, &s);
        c->samples[c->count++] = s;
        if (o->dial && !dial && c->count > 1 && fmax(s.error, c->samples[c->count-2].error) < 1e-10) return;
        vain = s.error < 0.7*best ? 0 : vain + 1;
        if (s.error < best) best = s.error;
        if (given_up(j, best, vain)) return;
    }
}

/* Logarithms between two samples.                                                             */
static double between(const sample *a, const sample *b, double error)
{
    double share = log(a->error/error)/log(a->error/b->error);
    return a->ms*pow(b->ms/a->ms, share);
}

/* Least time to an error, or infinity; *at: the sample that reaches it.  The first to reach it need
   not be the fastest: where steps are so long that many iterations are needed, shorter ones are.  */
static double time_to(const curve *c, double error, const sample **at)
{
    double least = HUGE_VAL;
    for (int k = 0; k + 1 < c->count; ++k) {
        const sample *s = c->samples + k;
        if (!(s->error <= error && s[1].error <= 2*error)) continue;
        const double ms = k > 0 && s[-1].error > error ? fmin(s->ms, between(s - 1, s, error)) : s->ms;
        if (ms < least) least = ms, *at = s;
    }
    return least;
}

/* ---------------------------------------------------------- one problem */

enum { SETTINGS = 360, TABLE = 40 };
static gvi_setting settings[SETTINGS];
static int setting_count;

static gvi_setting *add_setting(int degree, gvi_rule_kind rule, gvi_formulation formulation, double tolerance)
{
    static gvi_setting none;
    gvi_setting s = { .degree = degree, .rule = rule, .formulation = formulation, .tolerance = tolerance };
    if (setting_count == SETTINGS) return &none;
    settings[setting_count] = s;
    return settings + setting_count++;
}

/* The baselines' splittings as tables of kicks.                                                */
static void add_kicks(void)
{
    static const char *const names[] = { "Stoermer-Verlet", "Kahan-Li 8", "Sofroniou-Spaletta 10",
                                         "Blanes-Moan SRKN11", "Blanes-Moan SRKN14", "Splitting 8" };
    static double nodes[COUNT(names)][TABLE], weights[COUNT(names)][TABLE];
    for (int i = 0; i < COUNT(names); ++i) {
        gvi_setting *s = add_setting(1, GVI_KICKS, GVI_EXPLICIT, 0);
        s->name = names[i];
        s->points = baseline_kicks(baseline_named(names[i]), nodes[i], weights[i]);
        s->nodes = nodes[i];
        s->weights = weights[i];
    }
}

/* Every decade, the likely ones first.                                                        */
static const double decades[] = { 1e-12, 0, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-11, 1e-10, 1e-9, 1e-8,
                                  1e-7, 1e-6 };

/* Kepler's ellipses with a clock.                                                             */
static void add_clocks(const problem *p)
{
    static const int degrees[] = { 8, 6, 7, 10, 12, 16 };
    static const double tolerances[] = { 1e-12, 0, 1e-17, 1e-15, 1e-14, 1e-10, 1e-8 }, powers[] = { 1.5, 1 };
    for (int a = 0; a < COUNT(powers); ++a)
        for (int i = 0; i < COUNT(degrees); ++i)
            for (int k = 0; k < COUNT(tolerances); ++k) {
                gvi_setting *s = add_setting(degrees[i], GVI_GAUSS, GVI_MOMENTA, tolerances[k]);
                s->scene = p->clocks[powers[a] < 1.25];
                s->power = powers[a];
                s->tau = p->revolutions*kepler_tau(p->eccentricity, powers[a]);
            }
}

/* Degrees times tolerances in the formulation that suits the scene, without Newton's memory;
   what gvi.h chooses by itself; splittings; clocks.  The likely ones first.                   */
static void settings_for(const problem *p, int dial)
{
    static const int degrees[] = { 8, 6, 7, 5, 4, 10, 12, 16, 3, 2 };
    gvi_formulation pinned = p->formulation ? p->formulation : p->slope ? GVI_MOMENTA : GVI_POSITIONS;
    setting_count = 0;
    add_setting(8, GVI_GAUSS, pinned, 0)->dial = 1;
    if (dial) {
        add_setting(8, GVI_GAUSS, pinned, 0);
        return;
    }
    for (int i = 0; i < COUNT(degrees); ++i)
        for (int k = 0; k < COUNT(decades); ++k) add_setting(degrees[i], GVI_GAUSS, pinned, decades[k]);
    add_setting(8, GVI_GAUSS, GVI_AUTO, 0);
    add_setting(12, GVI_GAUSS, GVI_AUTO, 0);
    if (!p->slope) add_kicks();
    if (p->clocks[0]) add_clocks(p);
}

static curve *new_curve(study *y, const char *family, int ours, int structure)
{
    curve *c = y->curves + y->count;
    memset(c, 0, sizeof *c);
    c->family = family;
    c->ours = ours;
    c->structure = structure;
    return c;
}

static void keep_curve(study *y, const curve *c)
{
    fprintf(stderr, "  %-4s %-40s %2d points, smallest error %.1e\n", y->p->key, c->name, c->count,
            c->count ? c->samples[c->count-1].error : HUGE_VAL);
    if (c->count > 0 && y->count < CURVES - 1) ++y->count;
    else free(c->job.memory);
}

static void end_study(study *y)
{
    for (int i = 0; i < y->count; ++i) free(y->curves[i].job.memory);
}

static sweep steps_from(double first, double limit, const options *o)
{
    sweep w = { first, o->quick || o->dial ? 1.35 : 1.15, limit, 0, o->quick || o->dial ? 3 : 5 };
    return w;
}

static void study_gvi(study *y, const options *o, double length)
{
    for (int i = 0; i < setting_count; ++i) {
        const gvi_setting *g = settings + i;
        const double work = g->rule == GVI_KICKS ? g->points : 6*g->degree;
        sweep w = steps_from(g->power > 0 ? 5*y->p->revolutions : y->p->evaluations*length/work,
                             y->p->limit*length*(o->dial ? 10 : 1), o);
        if (g->dial) {
            w.first = 1e-4;
            w.factor = o->quick ? 0.1 : sqrt(0.1);
            w.smallest = 0.9e-14;
        }
        job j = { y->p, NULL, g, malloc(sizeof(double)*(size_t)gvi_run_memory(y->p, g)) };
        const char *rest = o->dial ? "gvi.h, fixed steps" : "gvi.h";
        curve *c = new_curve(y, g->dial ? "gvi.h by its dial" : rest, 1, 1);
        c->job = j;
        gvi_setting_name(g, sizeof c->name, c->name);
        if (j.memory) run_curve(y, o, &w, c);
        keep_curve(y, c);
    }
}

/* DOP853 everywhere: where q'' is given, for (q, v); Gauss-Radau where the second order form is    */
static int fits(const baseline *b, const problem *p)
{
    if (!strcmp(b->family, "Gauss-Radau 15")) return p->acceleration || p->law;
    return b->first_order == (p->slope != NULL) || !strcmp(b->family, "DOP853");
}

static void study_rival(study *y, const options *o, const baseline *b, double length)
{
    // to rounding, however long that takes
    sweep w = steps_from(y->p->evaluations*length/b->cost, 20*y->p->limit*length, o);
    if (b->adaptive) {
        w.first = 1.28;
        w.factor = o->quick || o->dial ? 0.2 : 0.5;
        w.smallest = 2e-16;
    }
    job j = { y->p, b, NULL, NULL };
    curve *c = new_curve(y, b->family, 0, b->structure);
    c->job = j;
    c->reference = b->reference;
    snprintf(c->name, sizeof c->name, "%s", b->name);
    run_curve(y, o, &w, c);
    keep_curve(y, c);
}

/* ------------------------------------------------------------ the fastest */

typedef struct winner { double ms; const curve *c; const sample *s; } winner;

/* The fastest of ours or theirs; of all that preserve structure; or of those that exist.      */
static winner fastest(const study *y, int ours, int structure, double error)
{
    winner w = { HUGE_VAL, NULL, NULL };
    for (int i = 0; i < y->count; ++i) {
        const curve *c = y->curves + i;
        const sample *s;
        if (c->ours != ours || (structure ? !c->structure : c->reference)) continue;
        double ms = time_to(c, error, &s);
        if (ms < w.ms) w.ms = ms, w.c = c, w.s = s;
    }
    return w;
}

/* ------------------------------------------------------------------ in turn */

enum { ENTRANTS = 200 };
typedef struct entrant { const job *j; sample *s; double ms; } entrant;

static int enter(curve *c, const sample *s, int count, entrant *e)
{
    for (int k = 0; k < count; ++k) if (e[k].s == s) return count;
    if (count == ENTRANTS) return count;
    entrant x = { &c->job, c->samples + (s - c->samples), HUGE_VAL };
    e[count] = x;
    return count + 1;
}

/* The samples on which the times to an error rest, of all that come within a quarter of the
   fastest of their group: ours, theirs, and those of theirs that preserve structure.          */
static int enter_all(study *y, double error, int all, int count, entrant *e)
{
    const double limit[3] = { 1.25*fastest(y, 0, 0, error).ms, 1.25*fastest(y, 1, 0, error).ms,
                              1.25*fastest(y, 0, 1, error).ms };
    for (int i = 0; i < y->count; ++i) {
        curve *c = y->curves + i;
        const sample *s;
        const double ms = time_to(c, error, &s);
        if (!isfinite(ms) || (!all && ms > limit[c->ours] && (c->ours || !c->structure || ms > limit[2]))) continue;
        count = enter(c, s, count, e);
        if (s > c->samples) count = enter(c, s - 1, count, e);
    }
    return count;
}

/* Each gets a turn of a millisecond or two runs, sixty times round; the least of all counts.  */
static void time_in_turn(study *y, const options *o)
{
    static entrant e[ENTRANTS];
    int count = 0;
    for (int k = 0; k < ERRORS; ++k) count = enter_all(y, wanted[k], o->dial, count, e);
    for (int round = 0; round < (o->quick || o->dial ? 10 : 60); ++round)
        for (int i = 0; i < count; ++i) {
            double total = 0;
            for (int k = 0; k < 2 || (total < 1 && k < 40); ++k) {
                const double ms = run_once(e[i].j, e[i].s->parameter, NULL, e[i].s);
                total += ms;
                e[i].ms = fmin(e[i].ms, ms);
            }
        }
    for (int i = 0; i < count; ++i) e[i].s->ms = e[i].ms;
}

/* What the dial is compared with: the rivals that choose their steps                           */
static void study_problem(study *y, const options *o)
{
    settings_for(y->p, o->dial);
    if (o->gvi) study_gvi(y, o, 1);
    for (int i = 0; o->peers && i < baseline_count; ++i)
        if (fits(baselines + i, y->p) && (!o->dial || baselines[i].adaptive)) study_rival(y, o, baselines + i, 1);
    time_in_turn(y, o);
    end_study(y);
}

/* ----------------------------------------------------------------- output */

static FILE *create(const options *o, const char *key, const char *ending)
{
    char path[512];
    snprintf(path, sizeof path, "%s/%s%s", o->out, key, ending);
    FILE *f = fopen(path, "w");
    if (!f) perror(path);
    return f;
}

static void write_csv(const study *y, const options *o)
{
    FILE *f = create(o, y->p->key, ".csv");
    if (!f) return;
    fprintf(f, "family,method,parameter,steps,cpu_ms,error,energy_error,evaluations,iterations\n");
    for (int i = 0; i < y->count; ++i)
        for (int k = 0; k < y->curves[i].count; ++k) {
            const curve *c = y->curves + i;
            const sample *s = c->samples + k;
            fprintf(f, "\"%s\",\"%s\",%.6g,%lld,%.6f,%.4e,%.4e,%lld,%lld\n", c->family, c->name, s->parameter,
                    s->steps, s->ms, s->error, s->energy, s->evaluations, s->iterations);
        }
    fclose(f);
}

static void print_ms(double ms)
{
    if (isfinite(ms)) printf(" %9.4f", ms);
    else printf(" %9s", "-");
}

static void print_table(const study *y)
{
    printf("\n%s  %s: CPU ms to an error\n  %-22s %-30s", y->p->key, y->p->title, "", "");
    for (int e = 0; e < ERRORS; ++e) printf(" %9.0e", wanted[e]);
    printf("  best error\n");
    for (int i = 0; i < y->count; ++i) {
        const curve *c = y->curves + i;
        const sample *at;
        double best = HUGE_VAL;
        for (int k = 0; k < c->count; ++k) if (c->samples[k].error < best) best = c->samples[k].error;
        printf("  %-22s %-30s", c->family, c->name);
        for (int e = 0; e < ERRORS; ++e) print_ms(time_to(c, wanted[e], &at));
        printf("  %.0e\n", best);
    }
}

/* What no point of the family betters both in time and in y.                                  */
typedef struct envelope { double x[SAMPLES*4], y[SAMPLES*4]; int count; } envelope;

static int by_time(const void *a, const void *b)
{
    double x = (*(const sample *const *)a)->ms, y = (*(const sample *const *)b)->ms;
    return (x > y) - (x < y);
}

static void make_envelope(const study *y, const char *family, int of_energy, envelope *v)
{
    static const sample *all[CURVES*SAMPLES];
    int n = 0;
    double best = HUGE_VAL;
    for (int i = 0; i < y->count; ++i)
        for (int k = 0; !strcmp(y->curves[i].family, family) && k < y->curves[i].count; ++k)
            all[n++] = y->curves[i].samples + k;
    qsort(all, (size_t)n, sizeof *all, by_time);
    v->count = 0;
    for (int k = 0; k < n; ++k) {
        double z = of_energy ? all[k]->energy : all[k]->error;
        if (!(z < 0.8*best) || !(z > 0) || v->count == COUNT(v->x)) continue;
        best = z;
        v->x[v->count] = all[k]->ms;
        v->y[v->count++] = z;
    }
}

/* The same method has the same colour in all pictures, where it is not grey (faint_ones).      */
static const char *colour_of(const char *family)
{
    static const char *const colour[][2] = {
        { "Stoermer-Verlet", "#d55e00" }, { "RK4", "#0072b2" }, { "compositions 8, 10", "#009e73" },
        { "Blanes-Moan SRKN", "#aa4499" }, { "splitting 8 by hand", "#b8860b" }, { "RKN8(6)", "#56b4e9" },
        { "RKN12(10)", "#88562b" }, { "Gauss, one point a call", "#444444" }, { "DOP853", "#cc3311" },
        { "Gauss-Radau 15", "#5e3fbe" },
        { "gvi.h by its dial", "#111111" }, { "gvi.h, fixed steps", "#888888" } };
    for (int i = 0; i < COUNT(colour); ++i)
        if (!strcmp(family, colour[i][0])) return colour[i][1];
    return NULL;
}

static double drawn_time(const envelope *v, double error)
{
    int k = 0;
    while (k < v->count && v->y[k] > error) ++k;
    return k < v->count ? v->x[k] : HUGE_VAL;
}

/* All but six: ours, which are first, stay, then the rivals fastest at the most errors, then those nearest to the
   fastest.                                                                                    */
static unsigned faint_ones(const envelope *v, int ours, int count)
{
    double merit[12] = { 0 };
    for (int e = 0; e < ERRORS; ++e) {
        double least = HUGE_VAL;
        for (int i = ours; i < count; ++i) least = fmin(least, drawn_time(v + i, wanted[e]));
        for (int i = ours; i < count; ++i) {
            const double ms = drawn_time(v + i, wanted[e]);
            if (isfinite(ms)) merit[i] += least/ms + (ms <= least ? ERRORS : 0);
        }
    }
    unsigned faint = 0;
    for (int left = count; left > 6; --left) {
        int worst = ours;
        for (int i = ours; i < count; ++i) if (merit[i] < merit[worst]) worst = i;
        merit[worst] = HUGE_VAL;
        faint |= 1u << worst;
    }
    return faint;
}

static void write_picture(const study *y, const options *o)
{
    const char *colours[12];
    static envelope envelopes[2][12];
    svg_line lines[2][12];
    unsigned dashed = 0;
    int ours = 0, count = 0;
    for (int i = 0; i < y->count && count < 12; ++i) {
        int known = 0;
        for (int k = 0; k < count; ++k) known |= !strcmp(lines[0][k].name, y->curves[i].family);
        if (known) continue;
        for (int e = 0; e < 2; ++e) {
            envelope *v = &envelopes[e][count];
            make_envelope(y, y->curves[i].family, e, v);
            svg_line line = { y->curves[i].family, v->x, v->y, v->count };
            lines[e][count] = line;
        }
        colours[count] = colour_of(y->curves[i].family);
        dashed |= (unsigned)!strcmp(y->curves[i].family, "gvi.h by its dial") << count;
        ours += y->curves[i].ours;
        ++count;
    }
    char path[512];
    snprintf(path, sizeof path, "%s/%s.svg", o->out, y->p->key);
    svg_plot panels[2] = {
        { .title = y->p->title, .x_label = "CPU time, ms", .y_label = "error of q at the end", .lines = lines[0] },
        { .title = "", .x_label = "CPU time, ms", .y_label = "largest relative error of the energy", .lines = lines[1] } };
    for (int e = 0; e < 2; ++e) {
        panels[e].log_x = panels[e].log_y = 1;
        panels[e].line_count = count;
        panels[e].thick = (1u << ours) - 1;
        panels[e].dashed = dashed;
        panels[e].faint = faint_ones(envelopes[0], ours, count);
        panels[e].colours = colours;
    }
    if (svg_write_all(path, panels, 2, 360)) perror(path);
}

/* ---------------------------------------------------------------- summary */

static void summary_head(void)
{
    puts("\nSUMMARY: CPU ms to an error of q; ratio = best rival / gvi.h; kept = the same against the best\n"
         "rival that preserves structure; ev, it = evaluations and iterations a step; 8, 0 and 8, tol: time of degree 8\n"
         "with tolerance 0 and with 1e-5 of the error over that of the best setting, without a clock\n");
    printf("%-4s %6s  %-22s %9s  %-26s %9s %6s %6s %5s  %6s  %-22s %6s %6s %6s\n", "", "error", "best rival",
           "ms", "gvi.h", "ms", "steps", "ev", "it", "ratio", "best that preserves", "kept", "8, 0", "8, tol");
}

/* Time to an error with degree 8, Gauss, no clock, and this tolerance                         */
static double time_of_degree_8(const study *y, double tolerance, double error)
{
    double least = HUGE_VAL;
    const sample *at;
    for (int i = 0; i < y->count; ++i) {
        const gvi_setting *g = y->curves[i].job.setting;
        if (!g || g->degree != 8 || g->rule != GVI_GAUSS || g->power > 0) continue;
        if (fabs(g->tolerance - tolerance) <= 0.01*tolerance) least = fmin(least, time_to(y->curves + i, error, &at));
    }
    return least;
}

typedef struct cell { winner theirs, kept, ours; double ratio, structure, rounding, rule; } cell;

static cell cell_of(const study *y, int e)
{
    const double tolerance = fmax(1e-5*wanted[e], 1e-17);
    cell c = { fastest(y, 0, 0, wanted[e]), fastest(y, 0, 1, wanted[e]), fastest(y, 1, 0, wanted[e]), 0, 0, 0, 0 };
    c.ratio = c.theirs.ms/c.ours.ms;
    c.structure = c.kept.ms/c.ours.ms;
    c.rounding = time_of_degree_8(y, 0, wanted[e])/c.ours.ms;
    c.rule = time_of_degree_8(y, tolerance, wanted[e])/c.ours.ms;
    return c;
}

static void print_ratio(double x)
{
    if (x > 0 && isfinite(x)) printf(" %6.2f", x);
    else printf(" %6s", "-");
}

static void summary_row(const study *y, int e)
{
    const cell c = cell_of(y, e);
    const winner ours = c.ours;
    printf("%-4s %6.0e  %-22s", y->p->key, wanted[e], c.theirs.c ? c.theirs.c->name : "-");
    print_ms(c.theirs.ms);
    printf("  %-26s", ours.c ? ours.c->name : "-");
    print_ms(ours.ms);
    if (ours.s)
        printf(" %6lld %6.1f %5.2f ", ours.s->steps, (double)ours.s->evaluations/(double)ours.s->steps,
               (double)ours.s->iterations/(double)ours.s->steps);
    else printf(" %6s %6s %5s ", "-", "-", "-");
    print_ratio(c.ratio);
    printf("  %-22s", c.kept.c ? c.kept.c->name : "-");
    print_ratio(c.structure);
    print_ratio(c.rounding);
    print_ratio(c.rule);
    puts("");
}

static void put_ratio(FILE *f, const char *before, double x, const char *after)
{
    if (x > 0 && isfinite(x)) fprintf(f, "%s%.2f%s", before, x, after);
    else fprintf(f, "%s-%s", before, after);
}

/* For docs/cost.md: gvi.h against its rivals                                                   */
static void write_table(const study *studies, int count, const options *o)
{
    FILE *f = create(o, "table", ".md");
    if (!f) return;
    fprintf(f, "| best rival (best that keeps the structure)");
    for (int e = 0; e < ERRORS; ++e) fprintf(f, " | %.0e", wanted[e]);
    fprintf(f, " |\n|---|---|---|---|---|\n");
    for (int i = 0; i < count; ++i) {
        fprintf(f, "| [%s](img/cost/%s.svg) %s |", studies[i].p->key, studies[i].p->key, studies[i].p->title);
        for (int e = 0; e < ERRORS; ++e) {
            const cell c = cell_of(studies + i, e);
            put_ratio(f, " ", c.ratio, "");
            put_ratio(f, " (", c.structure, ") |");
        }
        fprintf(f, "\n");
    }
    fclose(f);
}

static void summarise(const study *studies, int count, const options *o)
{
    summary_head();
    for (int i = 0; i < count; ++i)
        for (int e = 0; e < ERRORS; ++e) summary_row(studies + i, e);
    write_table(studies, count, o);
}

/* ---------------------------------------------------------------- horizon */

/* P4 over longer times; the reference is that of horizon.h.                                    */
static void study_horizon(const options *o)
{
    static const char *const rivals[] = { "RKN12(10) fixed c", "RKN12(10) c" };
    static study y;
    double length[3], ms[3][3], ratio[3][3];
    printf("P4 over longer times: CPU ms to an error of 1e-7; RKN12(10) with compensated sums\n"
           "%8s %9s %9s %9s %9s\n", "length", "gvi.h", "fixed", "adaptive", "ratio");
    for (int i = 0; i < COUNT(horizons); ++i) {
        problem p = *problem_named("P4");
        const sample *at;
        length[i] = horizons[i].length;
        p.end *= length[i];
        p.reference = horizons[i].q;
        y.p = &p;
        y.count = setting_count = 0;
        for (int s = 6; s <= 12; s += 2) add_setting(s, GVI_GAUSS, GVI_POSITIONS, 0);
        for (int s = 8; s <= 12; s += 2)
            for (double tolerance = 1e-16; tolerance < 1e-11; tolerance *= 100)
                add_setting(s, GVI_GAUSS, GVI_POSITIONS, tolerance);
        p.evaluations *= 2;
        p.limit = 2;
        options quick = *o;
        quick.quick = 1;
        study_gvi(&y, &quick, length[i]);
        ms[0][i] = fastest(&y, 1, 0, 1e-7).ms;
        for (int r = 0; r < 2; ++r) {
            study_rival(&y, &quick, baseline_named(rivals[r]), length[i]);
            ms[r+1][i] = time_to(y.curves + y.count - 1, 1e-7, &at);
        }
        char key[32];
        snprintf(key, sizeof key, "horizon-%d", horizons[i].length);
        p.key = key;
        end_study(&y);
        write_csv(&y, o);
        for (int r = 0; r < 3; ++r) ratio[r][i] = ms[r][i]/ms[0][i];
        printf("%8.0f", length[i]);
        for (int r = 0; r < 3; ++r) print_ms(ms[r][i]);
        printf(" %9.2f\n", fmin(ratio[1][i], ratio[2][i]));
    }
    svg_line lines[] = { { "gvi.h", length, ratio[0], 3 }, { "RKN12(10), fixed step", length, ratio[1], 3 },
                         { "RKN12(10), adaptive", length, ratio[2], 3 } };
    svg_plot panel = { .title = "Outer solar system: time to an error of 1e-7", .x_label = "length in units of 548 years",
                       .y_label = "times the time of gvi.h", .log_x = 1, .from_zero = 1, .lines = lines, .line_count = 3,
                       .thick = 1, .dashed = 2, .colours = (const char *const[]){ NULL, "#88562b", "#88562b" } };
    char path[512];
    snprintf(path, sizeof path, "%s/horizon.svg", o->out);
    if (svg_write_all(path, &panel, 1, 360)) perror(path);
}

/* --------------------------------------------------------------- the dial */

static void put_time(FILE *f, const char *before, double ms, double over)
{
    if (isfinite(ms) && isfinite(over)) fprintf(f, "%s%.2g", before, ms/over);
    else fprintf(f, "%s-", before);
}

#include "dial.h"

/* ------------------------------------------------------------------- main */

static void list(void)
{
    for (int i = 0; i < baseline_count; ++i)
        printf("%-26s %-24s %s\n", baselines[i].name, baselines[i].family,
               baselines[i].first_order ? "y' = f(y)" : "q'' = a(q)");
}

static int usage(void)
{
    fputs("cost [--quick] [--problem KEY] [--only gvi|peers] [--out DIR] | --dial | --horizon | --list\n", stderr);
    return 2;
}

int main(int argc, char **argv)
{
    static study studies[24];
    options o = { 0, 1, 1, 0, NULL, "." };
    int horizon = 0;
    baselines_begin();
    problems_begin();
    problems_tell(stdout);
    for (int i = 1; i < argc; ++i) {
        if (!strcmp(argv[i], "--quick")) o.quick = 1;
        else if (!strcmp(argv[i], "--dial")) o.dial = 1;
        else if (!strcmp(argv[i], "--horizon")) horizon = 1;
        else if (!strcmp(argv[i], "--list")) return list(), 0;
        else if (!strcmp(argv[i], "--problem") && i + 1 < argc) o.problem = argv[++i];
        else if (!strcmp(argv[i], "--out") && i + 1 < argc) o.out = argv[++i];
        else if (!strcmp(argv[i], "--only") && i + 1 < argc) {
            o.gvi = !strcmp(argv[++i], "gvi");
            o.peers = !o.gvi;
        } else return usage();
    }
    if (o.problem && !problem_named(o.problem)) return usage();
    if (horizon) return study_horizon(&o), 0;

    int count = 0;
    for (int i = 0; i < problem_count; ++i) {
        if (o.problem && strcmp(o.problem, problems[i].key)) continue;
        if (!o.problem && !o.dial && problems[i].by_dial) continue;
        if (!o.problem && o.dial && !in_dial_study(problems[i].key)) continue;
        study *y = studies + count++;
        y->p = problems + i;
        study_problem(y, &o);
        write_csv(y, &o);
        write_picture(y, &o);
        print_table(y);
    }
    if (o.dial) return report_dial(studies, count, &o), 0;
    summarise(studies, count, &o);
    return 0;
}
