/* inertia.h - minimum or saddle: negative directions of the discrete action, and the
   conjugate points of the solution                                             */
#ifndef INERTIA_H
#define INERTIA_H

#include "bench.h"

/* How many gvi_discrete_lagrangian counts between the ends of a step from y; -1 if
   its boundary-value problem has found no curve, or another one.              */
static MAYBE int index_of_step(const problem *pb, const method *m, real t, const real *y, real h)
{
    real q1[MAX_N], p0[MAX_N];
    int count = -1;
    gvi_stepper *st = bench(pb, m, t, y);
    const gvi_discrete out = { .p0 = p0, .negative = &count };
    if (st->status != GVI_OK || gvi_step(st, h) != GVI_OK) return -1;
    for (int i = 0; i < pb->n; ++i) q1[i] = st->q[i];
    if (gvi_discrete_lagrangian(st, t, h, y, q1, &out) != GVI_OK) return -1;
    for (int i = 0; i < pb->n; ++i)
        if (!(fabs(p0[i] - y[pb->n + i]) < 1e-6L*(1 + fabs(y[pb->n + i])))) return -1;
    return count;
}

/* Most negative directions of steps of many lengths from the starts; -1 if one of them was not found */
static MAYBE int most_negative(const problem *pb, const method *m)
{
    int most = -1;
    for (int start = 0; start < STARTS; ++start)
        for (real h = 0.5L; h > 0.01L; h /= 2) {
            real y[MAX_Y];
            start_state(pb, start, y);
            const int count = index_of_step(pb, m, 0, y, h);
            if (count < 0) return -1;
            if (count > most) most = count;
        }
    return most;
}

/* det dq(t + h)/dp, p at t: zero at a conjugate point.  Morse: as many negative
   directions of the action as there are conjugate points in (t, t + h).       */
static MAYBE real jacobi_determinant(const problem *pb, real t, const real *y, real h)
{
    real J[MAX_N*MAX_N] = { 0 };
    jacobi(pb, t, h, y, J);
    return pb->n == 1 ? J[0] : J[0]*J[3] - J[1]*J[2];
}

#endif
