/* identities.h - Runge-Kutta methods for Hamilton's equations, in the form of the
   literature, and their difference from a stepper                             */
#ifndef IDENTITIES_H
#define IDENTITIES_H

#include "bench.h"
#include "rules.h"

enum { IDENTITY_STEPS = 20 };
static const MAYBE real IDENTITY_STEP = 0.0625L;

typedef struct tableau { int stages; real c[MAX_R], b[MAX_R], A[MAX_R*MAX_R], B[MAX_R*MAX_R]; } tableau;

/* (Q, P) at the stages from a_ij V_j and ahat_ij F_j, by fixed point; dz: the step */
static MAYBE void partitioned(const problem *pb, const tableau *T, real t, real h, const real *z, real *dz)
{
    real K[MAX_R][MAX_Y] = { { 0 } }, Z[MAX_Y];
    int n = pb->n, r = T->stages;
    for (int it = 0; it < 80; ++it) {
        real next[MAX_R][MAX_Y];
        for (int k = 0; k < r; ++k) {
            for (int i = 0; i < 2*n; ++i) {
                real sum = 0;
                for (int l = 0; l < r; ++l) sum += (i < n ? T->A : T->B)[k*r + l]*K[l][i];
                Z[i] = z[i] + h*sum;
            }
            rates(pb, t + T->c[k]*h, Z, next[k]);
        }
        memcpy(K, next, sizeof K);
    }
    for (int i = 0; i < 2*n; ++i) {
        real sum = 0;
        for (int k = 0; k < r; ++k) sum += T->b[k]*K[k][i];
        dz[i] = h*sum;
    }
}

static MAYBE void midpoint(const problem *pb, const tableau *T, real t, real h, const real *z, real *dz)
{
    real middle[MAX_Y], g[MAX_Y] = { 0 };
    for (int it = 0; it < 80; ++it) {
        for (int i = 0; i < 2*pb->n; ++i) middle[i] = z[i] + h*g[i]/2;
        rates(pb, t + h/2, middle, g);
    }
    for (int i = 0; i < 2*pb->n; ++i) dz[i] = h*g[i];
}

/* Kick, drift, kick */
static MAYBE void verlet(const problem *pb, const tableau *T, real t, real h, const real *z, real *dz)
{
    real before[MAX_Y], after[MAX_Y], Z[MAX_Y];
    int n = pb->n;
    rates(pb, t, z, before);
    for (int i = 0; i < n; ++i) {
        dz[i] = h*(z[n + i] + h*before[n + i]/2);
        Z[i] = z[i] + dz[i];
        Z[n + i] = z[n + i];
    }
    rates(pb, t + h, Z, after);
    for (int i = n; i < 2*n; ++i) dz[i] = h*(before[i] + after[i])/2;
}

typedef void step_fn(const problem *pb, const tableau *T, real t, real h, const real *z, real *dz);

/* Largest difference over the steps and starts, in eps */
static MAYBE double difference(const problem *pb, const method *m, step_fn *step, const tableau *T)
{
    real worst = 0;
    int n = pb->n;
    for (int start = 0; start < STARTS; ++start) {
        real z[MAX_Y], low[MAX_Y] = { 0 }, dz[MAX_Y];
        start_state(pb, start, z);
        gvi_stepper *st = bench(pb, m, 0, z);
        for (int k = 0; k < IDENTITY_STEPS; ++k) {
            if (st->status != GVI_OK || gvi_step(st, IDENTITY_STEP) != GVI_OK) return (double)NAN;
            step(pb, T, k*IDENTITY_STEP, IDENTITY_STEP, z, dz);
            for (int i = 0; i < 2*n; ++i) {           /* Kahan's summation */
                real was = z[i], d = dz[i] + low[i];
                z[i] = was + d;
                low[i] = d - (z[i] - was);
                worst = larger(worst, fabs(z[i] - (i < n ? st->q[i] : st->p[i - n])));
            }
        }
    }
    return (double)(worst/UNIT);
}

static MAYBE tableau table_of(const own_rule *rule)
{
    tableau T = { .stages = rule->r };
    memcpy(T.c, rule->c, sizeof T.c);
    memcpy(T.b, rule->b, sizeof T.b);
    collocation(rule, T.A);
    partner(rule, T.A, T.B);
    return T;
}

#endif
