/* price - what each effect of a scene costs

     price SCENE [steps]

   A row an effect: at how many points it is evaluated in a step; what share of the
   time goes when it is not listed; what the step would take then, how it would be
   found, and the memory.  Times are the least of several runs, the scene with all
   its effects before each, so that both see the same machine; a share that is
   below 0 says that the scene without it needs more iterations, or is noise.    */
#ifndef PRICE_NO_MAIN
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "scenes.c"
#endif

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

/* Of one list of effects.                                                     */
typedef struct price {
    gvi_status      status;
    double          step;                        /* seconds                    */
    double          points[GVI_EFFECTS];         /* a step, of each effect     */
    double          iterations;                  /* a step                     */
    gvi_formulation formulation;
    size_t          bytes;
} price;

/* One run of a scene without some of its effects; the time if it is less than p->step. */
static void price_run(const scene *a, const char *without, long steps, price *p)
{
    static scene_setup made;
    static gvi_stepper st;
    scene_build(a, &made, without);
    p->bytes = gvi_size(&made.desc);
    gvi_real *memory = malloc(p->bytes);
    p->status = memory ? gvi_init(&st, &made.desc, memory, p->bytes) : GVI_E_MEMORY;
    if (p->status == GVI_OK) p->status = gvi_start(&st, 0, made.q, made.v);
    const clock_t begin = clock();
    for (long k = 0; k < steps && p->status == GVI_OK; ++k) p->status = gvi_step(&st, (gvi_real)a->h);
    const double time = (double)(clock() - begin)/CLOCKS_PER_SEC/(double)steps;
    if (!(p->step > 0) || time < p->step) p->step = time;
    for (int e = 0; e < GVI_EFFECTS; ++e) p->points[e] = (double)st.counters.effect[e]/(double)steps;
    p->iterations = (double)(st.counters.iterations + st.counters.newton_iterations)/(double)steps;
    p->formulation = st.formulation;
    free(memory);
}

/* With all effects to *all; without effect e to without[e].  0, or a failure.   */
static gvi_status price_scene(const scene *a, long steps, int runs, price *all, price *without)
{
    static scene_setup made;
    scene_build(a, &made, NULL);
    for (int k = 0; k < runs; ++k)
        for (int e = 0; e < made.desc.effect_count; ++e) {
            price_run(a, NULL, steps, all);
            price_run(a, made.names[e], steps, without + e);
            if (all->status || without[e].status) return all->status ? all->status : without[e].status;
        }
    return GVI_OK;
}

#ifndef PRICE_NO_MAIN
static const char *price_formulation(gvi_formulation f)
{
    static const char *const names[] = { "?", "explicit", "positions", "velocities", "momenta", "Newton" };
    return names[f];
}

/* Steps for a run of about 20 ms, but no more than the scene has.              */
static long price_steps(const scene *a)
{
    price once = { .status = GVI_OK };
    const double whole = floor(a->duration/a->h);
    price_run(a, NULL, 20, &once);
    return (long)fmax(20, fmin(whole, 0.02/fmax(once.step, 1e-7)));
}

static void price_print(const scene *a, long steps, const price *all, const price *without)
{
    static scene_setup made;
    double sum = 0;
    scene_build(a, &made, NULL);
    printf("%s: n = %d, degree %d, %ld steps of %g\n\n", a->title, a->n, a->degree, steps, a->h);
    printf("%-12s %8s %8s %12s  %-12s %10s\n", "effect", "points", "share", "step, us", "formulation",
           "bytes");
    for (int e = 0; e < made.desc.effect_count; ++e) {
        const price *p = without + e;
        const double share = 1 - p->step/all->step;
        sum += share;
        printf("%-12s %8.1f %7.1f%% %12.3f  %-12s %10zu\n", made.names[e], all->points[e], 100*share,
               1e6*p->step, price_formulation(p->formulation), p->bytes);
    }
    printf("%-12s %8s %7.1f%%   (points: with all effects; the rest: without that one)\n", "the rest", "",
           100*(1 - sum));
    printf("%-12s %8s %8s %12.3f  %-12s %10zu   %.1f iterations a step\n", "all", "", "", 1e6*all->step,
           price_formulation(all->formulation), all->bytes, all->iterations);
}

int main(int argc, char **argv)
{
    static price all, without[GVI_EFFECTS];
    const scene *a = argc > 1 ? scene_find(argv[1]) : NULL;
    if (!a || argc > 3) {
        fprintf(stderr, "usage: price SCENE [steps]; scenes:\n");
        for (int i = 0; i < scene_count; ++i) fprintf(stderr, "  %s\n", scenes[i]->name);
        return 2;
    }
    const long steps = argc > 2 ? atol(argv[2]) : price_steps(a);
    if (steps < 1) return fprintf(stderr, "price: steps\n"), 2;
    const gvi_status status = price_scene(a, steps, 7, &all, without);
    if (status) return fprintf(stderr, "%s\n", gvi_status_text(status)), 1;
    price_print(a, steps, &all, without);
    return 0;
}
#endif
