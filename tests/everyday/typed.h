/* typed.h - scenes whose L is typed, by examples/tools/lagrangian.h: the same text, in typed.c and in typed.cpp

   Each is a law for one point: all of L as one Lagrangian term, with no mass beside it.                  */
#include "tools/lagrangian.h"

LAGRANGIAN(kepler_typed, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + 1/sqrt(q[0]*q[0] + q[1]*q[1]); }

LAGRANGIAN(double_pendulum_typed, 2)
{
    const gvi_real g = (gvi_real)9.81L;
    return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*cos(q[0] - q[1]) + 2*g*cos(q[0]) + g*cos(q[1]);
}

LAGRANGIAN(charge_typed, 2)
{
    return (v[0]*v[0] + v[1]*v[1] + q[0]*v[1] - q[1]*v[0] - q[0]*q[0] - q[1]*q[1])/2;
}

/* A law by the callback for L of any kind; looked at once, at some state */
static void at_point(lagrangian *L, const lagrangian_function f, const gvi_points *x)
{
    static const gvi_real q[] = { (gvi_real)0.4L, (gvi_real)0.3L }, v[] = { (gvi_real)0.1L, 1 };
    if (L->kind == LAGRANGIAN_REFUSED) lagrangian_init(L, f, NULL, 0, q, v);
    L->kind = LAGRANGIAN_GENERAL;
    const gvi_effect effect = lagrangian_effect(L);
    effect.points(x, effect.user);
    const gvi_points value = { x->n, x->count, x->stride, x->t, x->q, x->v, NULL, NULL, NULL, x->value, NULL, NULL, NULL, NULL, NULL, NULL };
    effect.value(&value, effect.user);
}

#define TYPED(language, name)                                                       \
    void language##_##name(const gvi_points *x, const gvi_real *par);               \
    void language##_##name(const gvi_points *x, const gvi_real *par)                \
    {                                                                               \
        static lagrangian L;                                                        \
        at_point(&L, name##_typed, x);                                              \
        (void)par;                                                                  \
    }
