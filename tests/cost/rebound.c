/* rebound.c - gvi.h by its dial against REBOUND's IAS15 itself, on the problems of gravity (make cost-rebound)

   Both choose their steps.  gvi.h: degree 8, dials from 1e-3 to 1e-15.  IAS15: epsilon from 1e-4 to 1e-13 in its default
   mode; a body without mass is no active one, so that neither computes its attraction.  For a wanted error the least time of
   the settings that reach it, the best of some turns, from the first step to the last.  Links the librebound of a user;
   nothing of it is here.                                                                              */
#define GVI_IMPLEMENTATION
#include "problems.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "rebound.h"

#define COUNT(a) ((int)(sizeof(a)/sizeof *(a)))
enum { TURNS = 7, BODIES = 6 };

typedef struct { double ms, error; } run;
typedef run method(const problem *p, double setting);

static double clock_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e3 + (double)t.tv_nsec*1e-6;
}

static run by_dial(const problem *p, double dial)
{
    static double memory[100000];
    const gvi_desc desc = { .n = p->n, .degree = 8, .mass = p->mass, .effects = p->effects, .effect_count = p->effect_count,
                            .formulation = GVI_POSITIONS, .resolution = dial };
    gvi_stepper st;
    if (gvi_init(&st, &desc, memory, sizeof memory) || gvi_start(&st, 0, p->q, p->v)) exit(1);
    const double began = clock_ms();
    while (st.t < p->end && gvi_advance(&st, p->end) == GVI_OK) continue;
    const run r = { clock_ms() - began, st.status == GVI_OK ? problem_error(p, st.q) : HUGE_VAL };
    return r;
}

/* A centre of mass 1 that is none of the coordinates, or all bodies; in the plane or in space        */
static run by_ias15(const problem *p, double epsilon)
{
    const int all = p->mass.matrix != NULL, wide = p->n == 18 ? 3 : 2, bodies = p->n/wide;
    struct reb_simulation *r = reb_simulation_create();
    struct reb_integrator_ias15_state *ias15 = reb_simulation_set_integrator(r, "ias15");
    double q[3*BODIES] = { 0 };

    ias15->epsilon = epsilon;
    r->dt = p->end*1e-6;
    if (!all) {
        const struct reb_particle centre = { .m = 1 };
        reb_simulation_add(r, centre);
        r->N_active = 1;
    }
    for (int b = 0; b < bodies; ++b) {
        const double *x = p->q + wide*b, *v = p->v + wide*b;
        const struct reb_particle body = { .m = all ? p->mass.matrix[wide*b] : 0, .x = x[0], .y = x[1], .z = wide == 3 ? x[2] : 0,
                                           .vx = v[0], .vy = v[1], .vz = wide == 3 ? v[2] : 0 };
        reb_simulation_add(r, body);
    }

    const double began = clock_ms();
    (void)reb_simulation_integrate(r, p->end);
    const double ms = clock_ms() - began;
    for (int b = 0; b < bodies; ++b) {
        const struct reb_particle *body = r->particles + b + !all;
        const double x[3] = { body->x, body->y, body->z };
        memcpy(q + wide*b, x, (size_t)wide*sizeof *x);
    }
    reb_simulation_free(r);
    return (run){ ms, problem_error(p, q) };
}

/* The least time for each of the wanted errors, over settings half a decade apart                    */
static void least(method *by, const problem *p, double first, double last, const double *wanted, int count, double *ms)
{
    for (int w = 0; w < count; ++w) ms[w] = HUGE_VAL;
    for (double setting = first; setting > last; setting *= sqrt(0.1)) {
        run best = by(p, setting);
        for (int k = 1; k < TURNS; ++k) best.ms = fmin(best.ms, by(p, setting).ms);
        for (int w = 0; w < count; ++w)
            if (best.error <= wanted[w]) ms[w] = fmin(ms[w], best.ms);
    }
}

static void put(FILE *f, const char *before, double x)
{
    if (x < HUGE_VAL) fprintf(f, "%s%.2g", before, x);
    else fprintf(f, "%s-", before);
}

int main(int argc, char **argv)
{
    static const char *const keys[] = { "P1", "P2", "P4", "P13", "P14", "P15", "P16" };
    static const double wanted[] = { 1e-7, 1e-10 };
    FILE *out = argc > 2 ? fopen(argv[1], "w") : NULL;
    if (!out) return fprintf(stderr, "rebound TABLE WHICH: the file for the table; which REBOUND, and how it was compiled\n"), 1;
    problems_begin();
    fprintf(out, "| time to 1e-7; 1e-10 | by the dial, ms | REBOUND's IAS15 (%s) |\n|---|---|---|\n", argv[2]);
    for (int k = 0; k < COUNT(keys); ++k) {
        const problem *p = problem_named(keys[k]);
        double own[COUNT(wanted)], other[COUNT(wanted)];
        least(by_dial, p, 1e-3, 1e-15, wanted, COUNT(wanted), own);
        least(by_ias15, p, 1e-4, 1e-13, wanted, COUNT(wanted), other);
        fprintf(out, "| %s |", p->key);
        put(out, " ", own[0]);
        put(out, "; ", own[1]);
        put(out, " | ", other[0]/own[0]);
        put(out, "; ", other[1]/own[1]);
        fputs(" |\n", out);
        printf("%s: dial %.3g %.3g ms, IAS15 %.3g %.3g ms\n", p->key, own[0], own[1], other[0], other[1]);
        fflush(stdout);
    }
    fclose(out);
    return 0;
}
