/* embedded.c - the program of docs/embedded.md, which must compile without a warning */
#define GVI_REAL float          /* what the processor computes with                   */
#define GVI_IMPLEMENTATION
#define GVI_STATIC              /* what is not called is not there                    */
#define GVI_CORE                /* no chapter: this scene needs none, see below       */
#define GVI_EFFECTS 3           /* three effects                                      */
#include "gvi.h"
#include <math.h>

static int weight(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= 39.25f*sinf(x->q[k]);
    return (void)user, 0;
}

static int friction(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= 1.5f*x->v[k];
    return (void)user, 0;
}

static int drive(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] += 12*cosf(4*x->t[k]);
    return (void)user, 0;
}

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight },
                                    { .kind = GVI_POTENTIAL, .points = drive },
                                    { .kind = GVI_FORCE, .points = friction } };
static const gvi_desc desc = { .n = 1, .degree = 3, .effects = scene, .effect_count = 3,
                               .formulation = GVI_VELOCITIES, .iterations = 3 };
static float memory[GVI_LENGTH(1, 3, 3)];
static gvi_stepper pendulum;

int pendulum_start(void)
{
    static const float angle[1] = { 1 }, rest[1] = { 0 };
    gvi_init(&pendulum, &desc, memory, sizeof memory);
    return gvi_start(&pendulum, 0, angle, rest);      /* the first failure of the two */
}

int pendulum_period(void) { return gvi_step(&pendulum, 1/128.0f); }
