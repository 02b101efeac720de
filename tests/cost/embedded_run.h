/* embedded_run.h - the settings of embedded.c and one run of a scene with any of them           */
#ifndef EMBEDDED_RUN_H
#define EMBEDDED_RUN_H

#include "embedded_scenes.h"
#include <stdint.h>

enum { STEPS_FIRST = 3 };                          /* which make tables: two in float, three in double */

typedef enum method {
    VERLET, VERLET_CARRIED, RK4, RK4_CARRIED,      /* by hand; carried: with the rounding of the state */
    EXPLICIT, SUZUKI, FIXED, FIXED_GIVEN           /* gvi.h; given: desc.mass.velocity                 */
} method;

typedef struct setting { method method; int degree, iterations; } setting;

#define DEGREE(m, s) { m, s, 1 }, { m, s, 2 }, { m, s, 3 }, { m, s, 4 }, { m, s, 5 }, { m, s, 0 }
static const setting settings[] = {
    { VERLET, 1, 0 }, { VERLET_CARRIED, 1, 0 }, { RK4, 4, 0 }, { RK4_CARRIED, 4, 0 },
    { EXPLICIT, 1, 0 }, { SUZUKI, 1, 0 },
    DEGREE(FIXED, 1), DEGREE(FIXED, 2), DEGREE(FIXED, 3), DEGREE(FIXED, 4), DEGREE(FIXED_GIVEN, 2)
};
enum { SETTINGS = (int)(sizeof settings/sizeof *settings) };

typedef struct run {
    const scene   *scene;
    const setting *setting;
    gvi_stepper    st;
    by_hand        hand;
    hand_fn       *step;                           /* NULL: gvi_step                                   */
    real           h;
    long           k;                              /* steps done                                       */
    gvi_desc       desc;
    real           memory[GVI_LENGTH(2, 4, 6)];    /* six points: Suzuki's kicks                      */
} run;

/* Suzuki's five steps of Stoermer-Verlet in one, gamma = 1/(4 - 4^(1/3)): order 4 [Hairer, Lubich,
   Wanner: Geometric numerical integration, II.4]                                               */
#define GAMMA 0.4144907717943757
static const real corners[] = { 0, R(GAMMA), R(2*GAMMA), R(1 - 2*GAMMA), R(1 - GAMMA), 1 };
static const real kicks[] = { R(GAMMA/2), R(GAMMA), R((1 - 3*GAMMA)/2), R((1 - 3*GAMMA)/2),
                              R(GAMMA), R(GAMMA/2) };

static int by_hand_only(const setting *s) { return s->method < EXPLICIT; }

static hand_fn *hand_step(const scene *s, method m)
{
    return m == VERLET ? s->verlet : m == VERLET_CARRIED ? s->verlet_carried : m == RK4 ? s->rk4
         : m == RK4_CARRIED ? s->rk4_carried : NULL;
}

static void hand_start(run *r)
{
    const int n = r->scene->n;
    for (int i = 0; i < 4; ++i) r->hand.y[i] = r->hand.rest[i] = r->hand.force[i] = 0;
    for (int i = 0; i < n; ++i) {
        r->hand.y[i] = r->scene->q[i];
        r->hand.y[n + i] = r->scene->v[i];
    }
    if (r->setting->method > VERLET_CARRIED) return;
    by_hand still = r->hand;                       // a step of no length finds the force
    r->scene->verlet(&drive, &still, 0);
    for (int i = 0; i < n; ++i) r->hand.force[i] = still.force[i];
}

static gvi_status gvi_desc_of(const scene *s, const setting *t, gvi_desc *d)
{
    const gvi_desc none = { 0 };
    const int given = t->method == FIXED_GIVEN;
    if (given && s->mass.kind != GVI_MASS_POSITION) return GVI_E_FORMULATION;
    *d = none;
    d->n = s->n;
    d->degree = t->degree;
    d->effects = s->effects;
    d->effect_count = s->effect_count;
    d->mass = s->mass;
    d->mass.velocity = given ? arm_velocity : NULL;
    d->rule.kind = t->method == EXPLICIT ? GVI_LOBATTO : t->method == SUZUKI ? GVI_KICKS : GVI_GAUSS;
    if (t->method == SUZUKI) d->rule.points = 6, d->rule.nodes = corners, d->rule.weights = kicks;
    d->formulation = t->method == EXPLICIT || t->method == SUZUKI ? GVI_EXPLICIT : s->fixed;
    d->iterations = t->iterations;
    return GVI_OK;
}

/* 0, or the reason why there is no such run                                                     */
static int run_start(run *r, const scene *s, const setting *t, real h)
{
    r->scene = s;
    r->setting = t;
    r->h = h;
    r->k = 0;
    r->step = hand_step(s, t->method);
    if (by_hand_only(t)) return r->step ? hand_start(r), 0 : (int)GVI_E_FORMULATION;
    if (gvi_desc_of(s, t, &r->desc) != GVI_OK) return (int)GVI_E_FORMULATION;
    if (gvi_init(&r->st, &r->desc, r->memory, sizeof r->memory) == GVI_OK) gvi_start(&r->st, 0, s->q, s->v);
    return (int)r->st.status;
}

/* What a controller does before a step                                                          */
static void run_control(run *r)
{
    real s, c;
    sines(r->scene->turn*((real)r->k*r->h), &s, &c);
    for (int i = 0; i < r->scene->n; ++i) drive.torque[i] = r->scene->torque[i]*s;
}

/* FNV-1a over the bits of x                                                                     */
static uint32_t bits_of(uint32_t hash, const real *x, int n)
{
    const unsigned char *p = (const unsigned char *)x;
    for (int i = 0; i < n*(int)sizeof *x; ++i) hash = (hash ^ p[i])*16777619u;
    return hash;
}

static uint32_t run_bits(const run *r)
{
    const int n = r->scene->n;
    const uint32_t start = 2166136261u;
    if (by_hand_only(r->setting)) return bits_of(start, r->hand.y, 2*n);
    return bits_of(bits_of(start, r->st.q, n), r->st.p, n);
}

#endif
