/* kicks.c - a splitting as gvi.h runs it from a table, and the same one written by hand

   The problems of `make cost` where forces depend on positions only, five splittings each.  CPU time of
   a run from set-up to the last step, the smallest of 15, taken in turn with the loop of baselines.c,
   which knows n when it is compiled.
   Printed: time over the number of evaluations, of gvi_step and of gvi_steps; their ratios to the loop by
   hand; and what gvi_steps takes more than that, a step.                                                                                 */
#include "baselines.h"
#include "gvi_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
enum { RUNS = 15, TABLE = 40, EVALUATIONS = 200000 };

static const char *const names[] = { "Stoermer-Verlet", "Blanes-Moan SRKN11", "Blanes-Moan SRKN14",
                                     "Splitting 8", "Sofroniou-Spaletta 10" };

typedef struct job {
    const problem  *p;
    const baseline *by_hand;
    gvi_setting     setting;
    double         *memory;
    long            steps;
    long long       evaluations;       /* of the loop by hand                                  */
} job;

static void fail(const job *j, const char *why)
{
    printf("%s, %s: %s\n", j->p->key, j->by_hand->name, why);
    exit(1);
}

static double run_by_hand(job *j)
{
    static outcome o;
    const clock_t from = clock();
    j->by_hand->run(j->p, j->by_hand, (double)j->steps, NULL, &o);
    const double time = (double)(clock() - from)/CLOCKS_PER_SEC;
    if (o.failed || !isfinite(problem_error(j->p, o.q))) fail(j, "the loop by hand failed");
    j->evaluations = o.evaluations;
    return time;
}

static double run_gvi(job *j, int in_a_row)
{
    static gvi_result r;
    j->setting.in_a_row = in_a_row;
    const clock_t from = clock();
    gvi_run(j->p, &j->setting, (double)j->steps, j->memory, NULL, &r);
    const double time = (double)(clock() - from)/CLOCKS_PER_SEC;
    if (r.status != GVI_OK) fail(j, gvi_status_text(r.status));
    if (llabs(r.evaluations - j->evaluations) > 2) fail(j, "other numbers of evaluations");
    return time;
}

static void compare(job *j)
{
    double hand = HUGE_VAL, single = HUGE_VAL, row = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        hand = fmin(hand, run_by_hand(j));
        single = fmin(single, run_gvi(j, 0));
        row = fmin(row, run_gvi(j, 1));
    }
    const double evaluations = (double)j->evaluations, steps = (double)j->steps;
    printf("%-4s %3d  %-22s %7.1f %8.1f %6.2f %8.1f %6.2f %6.0f\n", j->p->key, j->p->n, j->by_hand->name,
           1e9*hand/evaluations, 1e9*single/evaluations, single/hand, 1e9*row/evaluations, row/hand,
           1e9*(row - hand)/steps);
    fflush(stdout);
}

/* As many evaluations for all, 8 times fewer where n is 100: a run takes a millisecond or more. */
static void study(const problem *p, const char *name)
{
    double nodes[TABLE], weights[TABLE];
    const baseline *b = baseline_named(name);
    job j = { .p = p, .by_hand = b, .setting = { .degree = 1, .rule = GVI_KICKS, .formulation = GVI_EXPLICIT,
              .name = name, .points = baseline_kicks(b, nodes, weights), .nodes = nodes, .weights = weights } };
    j.steps = (long)((p->n < 100 ? EVALUATIONS : EVALUATIONS/8)/b->cost);
    j.memory = malloc(sizeof(double)*(size_t)gvi_run_memory(p, &j.setting));
    if (!j.memory) fail(&j, "no memory");
    compare(&j);
    free(j.memory);
}

int main(void)
{
    problems_begin();
    baselines_begin();
    printf("%31s %7s %15s %15s\n%-4s %3s  %-22s %6s %8s %6s %8s %6s %6s\n", "", "by hand", "gvi_step", "gvi_steps",
           "", "n", "ns a kick, ns a step:", "kick", "kick", "ratio", "kick", "ratio", "more");
    for (int i = 0; i < problem_count; ++i)
        for (int k = 0; k < COUNT(names) && !problems[i].slope; ++k) study(problems + i, names[k]);
    return 0;
}
