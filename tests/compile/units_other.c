/* See units_main.c.  A description without designators, field by field. */
#include "gvi.h"

int other(gvi_stepper *st, gvi_real *memory, size_t size);

static int spring(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *f, gvi_real *dldv, void *user)
{
    f[0] -= q[0];
    return (void)t, (void)v, (void)dldv, (void)user, 0;
}

int other(gvi_stepper *st, gvi_real *memory, size_t size)
{
    static gvi_desc desc;          // static: all zero, in C and in C++
    static gvi_effect scene[1];
    const gvi_real q = 1, v = 0;
    scene[0].point = spring;
    desc.n = 1;
    desc.degree = 3;
    desc.effects = scene;
    desc.effect_count = 1;
    if (gvi_init(st, &desc, memory, size)) return 1;
    return gvi_start(st, 0, &q, &v);
}
