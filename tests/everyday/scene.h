/* scene.h - what a scene is, and the laws that scenes are made of

   A scene is written once, by hand, in units in which its figures are about 1: n coordinates, the laws that act, the
   start.  A law is a callback of gvi.h for one point, count = stride = 1: it reads t, q and v of x, adds to f, dldv and value
   or writes g, jacobian and rate, all of which are there.  par: the scene's own numbers.                 */
#ifndef EVERYDAY_SCENE_H
#define EVERYDAY_SCENE_H

enum { N = 8, PARTS = 4, ROWS = 6 };

typedef void law(const gvi_points *x, const real *par);
typedef void chart(const real *q, const real *v, real *Q, real *V);

typedef struct part { gvi_kind kind; law *at; int rows; } part;

enum {
    TIMED = 1,                          /* a law reads t                                                   */
    EXACT = 2                           /* the scene it is like has the same steps: Gauss with s points     */
};

typedef struct scene {
    const char *name;
    int   n;
    part  parts[PARTS];                 /* those that have a law                                           */
    real  q[N], v[N], period, par[6];   /* start; the fastest period, and how long the scene runs          */
    law  *mass, *gradient;              /* M(q); else                                                      */
    real  m[N];                         /* the masses, 1 where 0                                           */
    int   massless;                     /* all kinetic energy comes from terms of L                        */
    int   tags;
    const char *like;                   /* the same motion in the coordinates of that scene,               */
    chart *to;                          /* by this map                                                     */
} scene;

static int parts_of(const scene *s)
{
    int count = 0;
    while (count < PARTS && s->parts[count].at) ++count;
    return count;
}

static int has_kind(const scene *s, gvi_kind kind)
{
    for (int e = 0; e < parts_of(s); ++e) if (s->parts[e].kind == kind) return 1;
    return 0;
}

static int has_rows(const scene *s) { return has_kind(s, GVI_CONSTRAINT) || has_kind(s, GVI_NONHOLONOMIC); }
static int has_clock(const scene *s) { return has_kind(s, GVI_CLOCK); }

#endif
