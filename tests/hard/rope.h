/* rope.h - a rope in a game: what rope.c and refused.c share

   3 m, 60 beads of 20 g on rods of 5 cm; it falls from level rest and cracks like a whip.                         */
#ifndef ROPE_H
#define ROPE_H

#include "hard.h"

enum { MOST = 60, ROOM = 40000000, RATE = 240, DEEPEST = 10 };
static const real rod = (real)0.05, bead = (real)0.02, weight_of = (real)9.81;
static int beads = MOST;

static int rods(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int a = 0; a < beads; ++a)
        for (int k = 0; k < x->count; ++k) {
            const real *q = x->q + 2*a*R + k, X = q[0] - (a ? q[-2*R] : 0), Y = q[R] - (a ? q[-R] : 0);
            real *G = x->jacobian + (a*x->n + 2*a)*R + k;
            x->g[a*R + k] = (X*X + Y*Y - rod*rod)/2;
            G[0] = X;
            G[R] = Y;
            if (a) G[-2*R] = -X;
            if (a) G[-R] = -Y;
        }
    return (void)user, 0;
}

static int weight(const gvi_points *x, void *user)
{
    for (int i = 1; i < x->n; i += 2)
        for (int k = 0; k < x->count; ++k) {
            if (x->f) x->f[i*x->stride + k] -= bead*weight_of;
            if (x->value) x->value[k] += bead*weight_of*x->q[i*x->stride + k];
        }
    return (void)user, 0;
}

/* At level rest; in `room`, of ROOM bytes */
static void hang(gvi_stepper *st, int degree, real resolution, real *room)
{
    static real mass[2*MOST];
    static gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                  { .kind = GVI_CONSTRAINT, .points = rods } };
    real q[2*MOST] = { 0 }, v[2*MOST] = { 0 };
    for (int i = 0; i < 2*beads; ++i) mass[i] = bead;
    for (int i = 0; i < beads; ++i) q[2*i] = rod*(real)(i + 1);
    scene[1].rows = beads;
    const gvi_desc desc = { .n = 2*beads, .degree = degree, .rule = { .kind = degree == 1 ? GVI_LOBATTO : GVI_GAUSS },
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass }, .effects = scene,
                            .effect_count = 2, .resolution = resolution };
    must(gvi_init(st, &desc, room, ROOM));
    must(gvi_start(st, 0, q, v));
}

#endif
