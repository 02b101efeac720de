/* motion.c - all that takes time: the force, and gvi.h as a private copy.  MOTION names the form
   that this compilation is; without it the plain one.                                                   */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "motion.h"

#ifndef MOTION
#define MOTION motion_plain
#endif

enum { S = 8 };                                       // points: rows of degree 8 have no others behind them

static int halo(const gvi_points *x, void *user)
{
    const double y2 = 1/(flat_y*flat_y), z2 = 1/(flat_z*flat_z), *restrict q = x->q;
    double *restrict f = x->f;
    if (x->stride != S) return 1;
    for (int k = 0; k < S; ++k) {
        const double X = q[k], Y = y2*q[S + k], Z = z2*q[2*S + k];
        const double w = -speed*speed/(core*core + X*X + Y*q[S + k] + Z*q[2*S + k]);
        f[k] += w*X;
        f[S + k] += w*Y;
        f[2*S + k] += w*Z;
    }
    return (void)user, 0;
}

int MOTION(int count, star *stars, double h, int steps)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = halo } };
    static const gvi_desc desc = { .n = 3, .degree = S, .effects = scene, .effect_count = 1,
                                   .formulation = GVI_POSITIONS };
    double memory[GVI_LENGTH(3, S, S)];
    gvi_stepper st;
    int failed = gvi_init(&st, &desc, memory, sizeof memory) != GVI_OK ? count : 0;
    for (int i = 0; i < count && failed < count; ++i) {
        star *s = stars + i;
        gvi_start(&st, 0, s->q, s->v);
        for (int k = 0; k < steps && st.status == GVI_OK; ++k) gvi_step(&st, h);
        failed += st.status != GVI_OK || gvi_velocity(&st, s->v) != GVI_OK;
        for (int j = 0; j < 3; ++j) s->q[j] = st.q[j];
    }
    return failed;
}
