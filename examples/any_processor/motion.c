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

// inlined, so that a length known at compile time reaches the loop
static inline void halo_rows(const gvi_points *x, int length)
{
    const double y2 = 1/(flat_y*flat_y), z2 = 1/(flat_z*flat_z), *restrict q = x->q;
    double *restrict f = x->f;
    for (int k = 0; k < length; ++k) {
        const double X = q[k], Y = y2*q[length + k], Z = z2*q[2*length + k];
        const double w = -speed*speed/(core*core + X*X + Y*q[length + k] + Z*q[2*length + k]);
        f[k] += w*X;
        f[length + k] += w*Y;
        f[2*length + k] += w*Z;
    }
}

static int halo(const gvi_points *x, void *user)
{
    if (x->stride == S) halo_rows(x, S);
    else halo_rows(x, x->stride);                     // the one point of a start
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
