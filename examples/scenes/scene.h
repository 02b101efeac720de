/* scene.h - what a scene is, and how a program gets one ready

   A scene is data: a list of effects, a mass, initial values, a step that suits
   it, and what to draw.  All of them stand in scenes[], see scenes.c:

     static scene_setup made;                       (not to be moved afterwards)
     scene_build(scene_find("net"), &made, NULL);   or: without the effects "air" or "a,b"
     gvi_init(&st, &made.desc, memory, gvi_size(&made.desc));
     gvi_start(&st, 0, made.q, made.v);

   gvi_real may be double or long double.                                     */
#ifndef SCENE_H
#define SCENE_H

#include "tools/effects.h"
#include <string.h>

enum { SCENE_MAX = 192,        /* most degrees of freedom                      */
       SCENE_BODIES = 64,      /* most points in a picture                     */
       SCENE_CURVES = 4 };     /* most curves next to it, most conserved things */

typedef struct scene_setup {
    gvi_desc    desc;
    gvi_effect  effects[GVI_EFFECTS];
    const char *names[GVI_EFFECTS];
    gvi_real    q[SCENE_MAX], v[SCENE_MAX];      /* at t = 0                   */
} scene_setup;

/* Points first, first + step, ... joined by a line.                           */
typedef struct scene_line { int first, step, count; } scene_line;

typedef struct scene {
    const char *name, *title;
    int         n, degree;
    double      h, duration;
    void      (*build)(scene_setup *s);          /* effects, mass, q and v     */

    /* energies are shown in `energy_unit` = 1/energy_scale scene units; times
       in `time_unit`; a conserved quantity is a function of the state          */
    const char *energy_unit, *time_unit;
    double      energy_scale, time_scale;
    const char *conserved[SCENE_CURVES];
    void      (*quantities)(const gvi_real *q, const gvi_real *v, const gvi_real *p, gvi_real *out);

    /* picture: where the points are; which leave a trail; how large they are
       (pixels; below 0: in units of the picture); samples taken in a step, or
       steps to a sample (below 0); curves to show instead of the energies      */
    const char *caption, *unit;                  /* unit: of the picture; NULL: no scale */
    int         points, trail_first, trails, samples;
    void      (*place)(const gvi_real *q, const gvi_real *v, double (*xy)[2]);
    const double *sizes;
    scene_line  lines[16];
    double      seconds, view[4];                /* of the film; x0 x1 y0 y1, 0: fit */
    const char *curves_title, *curve_names[SCENE_CURVES];
    void      (*curves)(const gvi_real *q, const gvi_real *v, double *out);
} scene;

extern const scene *const scenes[];
extern const int scene_count;

static inline const scene *scene_find(const char *name)
{
    for (int i = 0; i < scene_count; ++i)
        if (!strcmp(scenes[i]->name, name)) return scenes[i];
    return NULL;
}

/* Adds a row; for use in build.                                               */
static inline void scene_add(scene_setup *s, const char *name, gvi_effect effect)
{
    s->names[s->desc.effect_count] = name;
    s->effects[s->desc.effect_count++] = effect;
}

/* Is `name` among the comma-separated names?                                  */
static inline int scene_lists(const char *names, const char *name)
{
    const size_t length = strlen(name);
    while (names && *names) {
        if (!strncmp(names, name, length) && (names[length] == ',' || !names[length])) return 1;
        names = strchr(names, ',');
        if (names) ++names;
    }
    return 0;
}

static inline int scene_effect(const scene_setup *s, const char *name)
{
    for (int e = 0; e < s->desc.effect_count; ++e)
        if (!strcmp(s->names[e], name)) return e;
    return -1;
}

/* Makes scene a ready; the effects named in `without`, if any, are not listed. */
static inline void scene_build(const scene *a, scene_setup *s, const char *without)
{
    int kept = 0;
    memset(s, 0, sizeof *s);
    s->desc.n = a->n;
    s->desc.degree = a->degree;
    s->desc.effects = s->effects;
    a->build(s);
    for (int e = 0; e < s->desc.effect_count; ++e) {
        if (scene_lists(without, s->names[e])) continue;
        s->names[kept] = s->names[e];
        s->effects[kept++] = s->effects[e];
    }
    s->desc.effect_count = kept;
    if (!kept) s->desc.effects = NULL;
}

/* The work that each force did in the last step, added to work[effect]: its
   power on the step's own curve, at the points where the step asked for it.
   `off`: bit e for effect e switched off.  0, or a callback's refusal.        */
static inline int scene_work(gvi_stepper *st, const scene_setup *s, unsigned off, gvi_real *work)
{
    static gvi_real c[64], b[64];
    gvi_real q[SCENE_MAX], v[SCENE_MAX], f[SCENE_MAX], t;
    const int r = st->r < 64 ? st->r : 64, n = st->n;
    gvi_gauss(r, c, b);
    for (int i = 0; i < r; ++i) {
        gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &t, .q = q, .v = v, .f = f };
        t = st->t - (1 - c[i])*st->h;
        gvi_curve(st, c[i], q, v);
        for (int e = 0; e < s->desc.effect_count; ++e) {
            const gvi_effect *effect = s->effects + e;
            if (effect->kind != GVI_FORCE || off >> e & 1u) continue;
            memset(f, 0, sizeof f);
            if (effect->points(&x, effect->user)) return -1;
            for (int j = 0; j < n; ++j) work[e] += b[i]*st->h*f[j]*v[j];
        }
    }
    return 0;
}

/* Potential energy, of the effects that are on: the potentials, less the Lagrangian terms at rest. */
static inline gvi_real scene_potential(const scene_setup *s, unsigned off, gvi_real t, const gvi_real *q)
{
    static const gvi_real rest[SCENE_MAX];
    gvi_real V = 0, L = 0;
    gvi_points x = { .n = s->desc.n, .count = 1, .stride = 1, .t = &t, .q = q };
    for (int e = 0; e < s->desc.effect_count; ++e) {
        const gvi_kind kind = s->effects[e].kind;
        if ((kind != GVI_POTENTIAL && kind != GVI_LAGRANGIAN) || off >> e & 1u) continue;
        x.v = kind == GVI_POTENTIAL ? NULL : rest;
        x.value = kind == GVI_POTENTIAL ? &V : &L;
        s->effects[e].value(&x, s->effects[e].user);
    }
    return V - L;
}

/* ---- what several scenes draw and conserve ---- */

/* Particles in the plane, as they are.                                        */
static inline void scene_place_plane(int count, const gvi_real *q, double (*xy)[2])
{
    for (int i = 0; i < count; ++i) xy[i][0] = (double)q[2*i], xy[i][1] = (double)q[2*i+1];
}

/* From space to the picture: turned by `turn` about the third axis, then seen
   from `above` over the plane of the first two (radians).                     */
static inline void scene_project(double x, double y, double z, double turn, double above, double *xy)
{
    double a = cos(turn), b = sin(turn), depth = b*x + a*y;
    xy[0] = a*x - b*y;
    xy[1] = z*cos(above) + depth*sin(above);
}

/* Sums over `count` particles in dim dimensions: momentum along the first axis,
   angular momentum about the third (or about the point, in the plane).        */
static inline void scene_momenta(int count, int dim, const gvi_real *q, const gvi_real *p, gvi_real *out)
{
    out[0] = out[1] = 0;
    for (int i = 0; i < count; ++i, q += dim, p += dim) {
        out[0] += p[0];
        out[1] += q[0]*p[1] - q[1]*p[0];
    }
}

#endif
