/* peers.c - what libraries that are to be had need for the problems of `make cost`

     peers [--quick] [--problem P4] [--out DIR]

   GSL's rk8pd and msadams, SUNDIALS' CVODE (Adams, functional iteration) and ARKODE (explicit pairs
   of order 6 and 8), Boost.odeint's Bulirsch-Stoer, over their tolerance, absolute and relative the
   same; the right-hand sides are those of problems.c, as first-order systems y = (q, v).  SUNDIALS
   has its partitioned symplectic methods (SPRKStep) from 6.6 on; they are compositions, which
   baselines.c has.  Time, error and energy as in cost.c; written: DIR/P1-peers.csv and so on, with
   the columns of cost.c, and a table of CPU ms to an error.                                   */
#define _POSIX_C_SOURCE 200809L
#include "problems.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <nvector/nvector_serial.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
enum { SAMPLES = 80, ERRORS = 4, MOST_STEPS = 100000000 };
static const double wanted[ERRORS] = { 1e-4, 1e-7, 1e-10, 1e-12 };

/* ------------------------------------------------------ right-hand side */

static const problem *current;
static long long calls, most_calls;     /* beyond most_calls a method gives up */

static void rate(const double *y, double *dy)
{
    ++calls;
    if (current->slope) { current->slope(y, dy); return; }
    memcpy(dy, y + current->n, sizeof(double)*(size_t)current->n);
    current->acceleration(y, dy + current->n);
}

static int gsl_rate(double t, const double *y, double *dy, void *user)
{
    if (calls > most_calls) return GSL_EBADFUNC;
    rate(y, dy);
    return GSL_SUCCESS;
}

static int sundials_rate(realtype t, N_Vector y, N_Vector dy, void *user)
{
    if (calls > most_calls) return -1;
    rate(NV_DATA_S(y), NV_DATA_S(dy));
    return 0;
}

/* ------------------------------------------------------------ the peers */

/* One run from y at 0 to the end, over `pieces` equal times; after each, look.  Returns the number
   of steps, or -1.                                                                            */
typedef struct job {
    double *y, tolerance;
    int     pieces;
    watch  *w;
} job;

static double piece(const job *j, int k) { return current->end*k/j->pieces; }

static void look(const job *j)
{
    if (j->w) watch_look(j->w, j->y, j->y + current->n);
}

static long long with_gsl(const job *j, const gsl_odeiv2_step_type *type)
{
    gsl_odeiv2_system system = { gsl_rate, NULL, (size_t)(2*current->n), NULL };
    gsl_odeiv2_driver *d =
        gsl_odeiv2_driver_alloc_y_new(&system, type, 1e-3*current->end, j->tolerance, j->tolerance);
    double t = 0;
    long long steps = 0;
    for (int k = 1; k <= j->pieces && steps >= 0; ++k) {
        int status = gsl_odeiv2_driver_apply(d, &t, piece(j, k), j->y);
        steps = status == GSL_SUCCESS ? steps + (long long)d->n : -1;
        look(j);
    }
    gsl_odeiv2_driver_free(d);
    return steps;
}

static long long gsl_rk8pd(const job *j) { return with_gsl(j, gsl_odeiv2_step_rk8pd); }
static long long gsl_msadams(const job *j) { return with_gsl(j, gsl_odeiv2_step_msadams); }

static SUNContext context;

static long long cvode_adams(const job *j)
{
    N_Vector y = N_VMake_Serial(2*current->n, j->y, context);
    SUNNonlinearSolver fixed = SUNNonlinSol_FixedPoint(y, 0, context);
    void *c = CVodeCreate(CV_ADAMS, context);
    double t = 0;
    long steps = 0;
    int status = CVodeInit(c, sundials_rate, 0, y);
    CVodeSetErrFile(c, NULL);
    CVodeSStolerances(c, j->tolerance, j->tolerance);
    CVodeSetNonlinearSolver(c, fixed);
    CVodeSetMaxNumSteps(c, MOST_STEPS);
    for (int k = 1; k <= j->pieces && status >= 0; ++k) {
        CVodeSetStopTime(c, piece(j, k));
        status = CVode(c, piece(j, k), y, &t, CV_NORMAL);
        look(j);
    }
    CVodeGetNumSteps(c, &steps);
    CVodeFree(&c);
    SUNNonlinSolFree(fixed);
    N_VDestroy(y);
    return status >= 0 ? steps : -1;
}

static long long with_arkode(const job *j, ARKODE_ERKTableID table)
{
    N_Vector y = N_VMake_Serial(2*current->n, j->y, context);
    void *c = ERKStepCreate(sundials_rate, 0, y, context);
    double t = 0;
    long steps = 0;
    int status = ERKStepSetTableNum(c, table);
    ERKStepSetErrFile(c, NULL);
    ERKStepSStolerances(c, j->tolerance, j->tolerance);
    ERKStepSetMaxNumSteps(c, MOST_STEPS);
    for (int k = 1; k <= j->pieces && status >= 0; ++k) {
        ERKStepSetStopTime(c, piece(j, k));
        status = ERKStepEvolve(c, piece(j, k), y, &t, ARK_NORMAL);
        look(j);
    }
    ERKStepGetNumSteps(c, &steps);
    ERKStepFree(&c);
    N_VDestroy(y);
    return status >= 0 ? steps : -1;
}

static long long arkode_fehlberg(const job *j) { return with_arkode(j, ARKODE_FEHLBERG_13_7_8); }
static long long arkode_verner(const job *j) { return with_arkode(j, ARKODE_VERNER_8_5_6); }

/* peers_odeint.cpp; -1 when it gives up                                                       */
long long odeint_bulirsch_stoer(int size, void (*rate)(const double *, double *), const long long *calls,
                                long long most_calls, double *y, double from, double to, double tolerance);

static long long odeint(const job *j)
{
    long long steps = 0;
    for (int k = 1; k <= j->pieces && steps >= 0; ++k) {
        long long more = odeint_bulirsch_stoer(2*current->n, rate, &calls, most_calls, j->y, piece(j, k - 1),
                                               piece(j, k), j->tolerance);
        steps = more < 0 ? -1 : steps + more;
        look(j);
    }
    return steps;
}

typedef struct peer { const char *name; long long (*run)(const job *j); } peer;
static const peer peers[] = {
    { "GSL rk8pd", gsl_rk8pd }, { "GSL msadams", gsl_msadams }, { "SUNDIALS CVODE Adams", cvode_adams },
    { "SUNDIALS ARKODE 8(7)", arkode_fehlberg }, { "SUNDIALS ARKODE 6(5)", arkode_verner },
    { "Boost.odeint B.-Stoer", odeint } };

/* -------------------------------------------------------------- one curve */

typedef struct sample { double tolerance, ms, error, energy; long long steps, evaluations; } sample;
typedef struct curve { int count; sample samples[SAMPLES]; } curve;

static double cpu_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e3 + (double)t.tv_nsec*1e-6;
}

static double run_once(const peer *m, int pieces, watch *w, sample *s)
{
    static double y[2*MOST_COORDINATES];
    job j = { y, s->tolerance, pieces, w };
    calls = 0;
    double begin = cpu_ms();
    memcpy(y, current->q, sizeof(double)*(size_t)current->n);
    memcpy(y + current->n, current->v, sizeof(double)*(size_t)current->n);
    long long steps = m->run(&j);
    double time = cpu_ms() - begin;
    if (w) return time;
    s->steps = steps;
    s->evaluations = calls;
    s->error = steps < 0 ? HUGE_VAL : problem_error(current, y);
    return time;
}

static void measure(const peer *m, int runs, sample *s)
{
    double total = s->ms;
    for (int k = 1; k < runs || (total < 2 && k < 40); ++k) {
        double ms = run_once(m, 1, NULL, s);
        total += ms;
        if (ms < s->ms) s->ms = ms;
    }
    int pieces = s->steps > 8000 ? 400 : s->steps > 40 ? (int)(s->steps/20) : 2;
    watch w = watch_begin(current, 1);
    run_once(m, pieces, &w, s);
    s->energy = (double)w.worst;
}

/* Until it takes too long, or four tolerances bring nothing any more.  At first some are so loose
   that a body escapes.                                                                        */
static void run_curve(const peer *m, int quick, curve *c)
{
    double best = HUGE_VAL;
    int vain = 0;
    c->count = 0;
    most_calls = (long long)(1.5e5*current->limit);
    for (double tolerance = 1e-2; tolerance > 2e-16 && vain < 4; tolerance *= quick ? 0.2 : 0.5) {
        sample s = { .tolerance = tolerance };
        s.ms = run_once(m, 1, NULL, &s);
        if (s.error < 1 && s.ms > 40*current->limit) return;
        if (calls > most_calls && c->count > 0) return;
        if (!(s.error < 1)) continue;
        measure(m, quick ? 3 : 5, &s);
        if (c->count < SAMPLES) c->samples[c->count++] = s;
        vain = s.error < 0.7*best ? 0 : vain + 1;
        if (s.error < best) best = s.error;
    }
}

/* As in cost.c: the least of the crossings that the next finer tolerance confirms.            */
static double time_to(const curve *c, double error)
{
    double least = HUGE_VAL;
    for (int k = 0; k + 1 < c->count; ++k) {
        const sample *s = c->samples + k, *a = s - 1;
        if (!(s->error <= error && s[1].error <= 2*error)) continue;
        least = fmin(least, s->ms);
        if (k > 0 && a->error > error)
            least = fmin(least, a->ms*pow(s->ms/a->ms, log(a->error/error)/log(a->error/s->error)));
    }
    return least;
}

/* ----------------------------------------------------------------- output */

static void write_csv(FILE *f, const peer *m, const curve *c)
{
    for (int k = 0; f && k < c->count; ++k) {
        const sample *s = c->samples + k;
        fprintf(f, "\"%s\",\"%s\",%.6g,%lld,%.6f,%.4e,%.4e,%lld,0\n", m->name, m->name, s->tolerance,
                s->steps, s->ms, s->error, s->energy, s->evaluations);
    }
}

static void print_row(const peer *m, const curve *c)
{
    double best = HUGE_VAL;
    printf("  %-24s", m->name);
    for (int e = 0; e < ERRORS; ++e) {
        double ms = time_to(c, wanted[e]);
        if (isfinite(ms)) printf(" %9.4f", ms);
        else printf(" %9s", "-");
    }
    for (int k = 0; k < c->count; ++k) if (c->samples[k].error < best) best = c->samples[k].error;
    printf("  %.0e\n", best);
}

static void study(const problem *p, int quick, const char *out)
{
    static curve c;
    char path[512];
    current = p;
    snprintf(path, sizeof path, "%s/%s-peers.csv", out, p->key);
    FILE *f = fopen(path, "w");
    if (!f) perror(path);
    else fprintf(f, "family,method,parameter,steps,cpu_ms,error,energy_error,evaluations,iterations\n");
    printf("\n%s  %s: CPU ms to an error\n  %-24s", p->key, p->title, "");
    for (int e = 0; e < ERRORS; ++e) printf(" %9.0e", wanted[e]);
    printf("  best error\n");
    for (int i = 0; i < COUNT(peers); ++i) {
        run_curve(peers + i, quick, &c);
        write_csv(f, peers + i, &c);
        print_row(peers + i, &c);
    }
    if (f) fclose(f);
}

int main(int argc, char **argv)
{
    const char *key = NULL, *out = ".";
    int quick = 0;
    for (int i = 1; i < argc; ++i) {
        if (!strcmp(argv[i], "--quick")) quick = 1;
        else if (!strcmp(argv[i], "--problem") && i + 1 < argc) key = argv[++i];
        else if (!strcmp(argv[i], "--out") && i + 1 < argc) out = argv[++i];
        else key = "";
    }
    if (key && !problem_named(key)) {
        fputs("peers [--quick] [--problem KEY] [--out DIR]\n", stderr);
        return 2;
    }
    gsl_set_error_handler_off();
    if (SUNContext_Create(NULL, &context)) return 1;
    for (int i = 0; i < problem_count; ++i)
        if (!key || !strcmp(key, problems[i].key)) study(problems + i, quick, out);
    SUNContext_Free(&context);
    return 0;
}
