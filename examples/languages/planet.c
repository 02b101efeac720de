/* planet.c - gvi.h for JavaScript: what planet.mjs calls, as WebAssembly

     clang --target=wasm32-wasi -mexec-model=reactor -O2 -I. examples/languages/planet.c -o planet.wasm
     node examples/languages/planet.mjs planet.wasm

   The scene is built here, the force is JavaScript's: `force` is imported, and gets the addresses of all points in
   the module's memory.  (A force written here in C is ten times as fast.)                     */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"

#define EXPORT(name) __attribute__((export_name(#name))) name
__attribute__((import_module("scene"), import_name("force")))
int force(int count, int stride, const double *q, double *f);

static int at_points(const gvi_points *x, void *user) { return (void)user, force(x->count, x->stride, x->q, x->f); }

static double memory[GVI_LENGTH(2, 8, 8)], start[4];
static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = at_points } };
static gvi_stepper st;

double *EXPORT(start_values)(void) { return start; }          // q0, q1, v0, v1, to be filled
const double *EXPORT(q)(void) { return st.q; }
const char *EXPORT(why)(void) { return gvi_why(&st); }
int EXPORT(step)(double h) { return gvi_step(&st, h); }
int EXPORT(begin)(void)
{
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 };
    gvi_init(&st, &desc, memory, sizeof memory);
    return gvi_start(&st, 0, start, start + 2);
}
