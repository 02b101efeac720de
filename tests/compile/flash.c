/* flash.c - the least program of each formulation, for the table of docs/embedded.md: FORMULATION 1 explicit, 2 positions,
   3 velocities, 4 momenta.  As one writes it: plain gvi.h, or with LEAST all that leaves code out. */
#define GVI_REAL float
#define GVI_STATIC
#if LEAST
#define GVI_EFFECTS 2
#if FORMULATION < 4
#define GVI_CORE
#if FORMULATION == 1
#define GVI_ONLY_EXPLICIT
#endif
#else                                   // all but M(q)
#define GVI_NO_RULES
#define GVI_NO_LAGRANGIAN
#define GVI_NO_CLOCK
#define GVI_NO_KICKS
#define GVI_NO_NEWTON
#define GVI_NO_CONSTRAINTS
#define GVI_NO_OUTPUT
#define GVI_NO_DIAL
#define GVI_NO_RESTORE
#define GVI_NO_EXPLAIN
#define GVI_NO_TEXTS
#endif
#endif
#define GVI_IMPLEMENTATION
#include "gvi.h"

GVI_EACH(spring, 1, f) { x->f[0] -= 40*x->q[0]; }
#if FORMULATION == 3
GVI_EACH(friction, 1, v, f) { x->f[0] -= x->v[0]; }
#elif FORMULATION == 4
GVI_EACH(mass, 1, mass) { x->mass[0] = 1 + x->q[0]*x->q[0]; }
GVI_EACH(gradient, 1, v, f) { x->f[0] += x->q[0]*x->v[0]*x->v[0]; }
#endif

static const gvi_effect scene[] = {
    { .kind = GVI_POTENTIAL, .points = spring },
#if FORMULATION == 3
    { .kind = GVI_FORCE, .points = friction }
#endif
};
static const gvi_desc desc = { .n = 1, .degree = FORMULATION == 1 ? 1 : 2,
                               .effects = scene, .effect_count = sizeof scene/sizeof *scene,
#if FORMULATION == 1
                               .rule = { .kind = GVI_LOBATTO, .points = 2 },
#elif FORMULATION == 4
                               .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = gradient },
#endif
                               .formulation = (gvi_formulation)FORMULATION, .iterations = FORMULATION == 1 ? 0 : 3 };
static float memory[FORMULATION == 1 && LEAST ? GVI_LENGTH(1, 1, 2) : GVI_LENGTH(1, 2, 2)];
static gvi_stepper st;
volatile float angle;

int main(void)
{
    static const float q[1] = { 1 }, v[1] = { 0 };
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    while (gvi_step(&st, 0.01f) == GVI_OK) angle = st.q[0];
    return st.status;
}
