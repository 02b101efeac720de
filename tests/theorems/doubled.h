/* doubled.h - a forced system as half of a conservative one

     L~(q, Q) = L(Q,Q') - L(q,q') + (f(Q,Q') + f(q,q'))/2 . (Q - q)

   Its Euler-Lagrange equations keep Q = q, and are there those of the forced
   system, twice; the momentum of q is minus that of Q.                       */
#ifndef DOUBLED_H
#define DOUBLED_H

#include "bench.h"

/* dL~/d(q,Q) and dL~/d(v,V), adding to them the derivatives of sign L and of the
   product above by one of the two copies                                      */
static MAYBE void doubled_half(const problem *pb, real t, const real *q, const real *v, real sign,
                               const real *apart, const real *f_sum, real *dq, real *dv)
{
    const gvi_effect *force = &pb->effects[pb->effect_count - 1];
    real Lq[MAX_N], Lv[MAX_N], fq[MAX_N*MAX_N] = { 0 }, fv[MAX_N*MAX_N] = { 0 };
    int n = pb->n;
    gradient(pb, t, q, v, Lq, Lv);
    force->hessian(t, q, v, fq, fv, NULL, NULL);
    for (int i = 0; i < n; ++i) {
        dq[i] += sign*(Lq[i] + f_sum[i]/2);
        dv[i] += sign*Lv[i];
        for (int j = 0; j < n; ++j) {
            dq[i] += fq[j*n + i]*apart[j]/2;
            dv[i] += fv[j*n + i]*apart[j]/2;
        }
    }
}

static MAYBE int doubled_term(real t, const real *x, const real *w, real *f, real *dldv, void *user)
{
    const problem *pb = user;
    real apart[MAX_N], f_sum[MAX_N] = { 0 };
    int n = pb->n;
    for (int i = 0; i < n; ++i) apart[i] = x[n + i] - x[i];
    add_force(pb, t, x, w, f_sum);
    add_force(pb, t, x + n, w + n, f_sum);
    doubled_half(pb, t, x, w, -1, apart, f_sum, f, dldv);
    doubled_half(pb, t, x + n, w + n, 1, apart, f_sum, f + n, dldv + n);
    return 0;
}

/* What is left between the two after `steps` steps of h */
typedef struct doubled_result { real q, p, diagonal; } doubled_result;

static MAYBE doubled_result compare_with_doubled(const problem *pb, const method *m, int start, real h,
                                                 int steps)
{
    static real memory[20000];
    static problem copy;
    copy = *pb;
    const gvi_effect whole[] = { { .kind = GVI_LAGRANGIAN, .point = doubled_term, .user = &copy } };
    const gvi_desc desc = { .n = 2*pb->n, .degree = m->s, .rule = m->rule, .mass = { .kind = GVI_MASS_NONE },
                            .effects = whole, .effect_count = 1 };
    doubled_result left = { 0, 0, 0 };
    real y[MAX_Y], x[2*MAX_N], p[2*MAX_N];
    gvi_stepper twice, *once;
    int n = pb->n;

    start_state(pb, start, y);
    for (int i = 0; i < n; ++i) { x[i] = x[n + i] = y[i]; p[i] = -y[n + i]; p[n + i] = y[n + i]; }
    once = bench(pb, m, 0, y);
    if (gvi_init(&twice, &desc, memory, sizeof memory) == GVI_OK) gvi_start_momentum(&twice, 0, x, p);
    for (int k = 0; k < steps; ++k)
        if (gvi_step(&twice, h) != GVI_OK || gvi_step(once, h) != GVI_OK) left.q = (real)NAN;
    for (int i = 0; i < n; ++i) {
        left.q = larger(left.q, fabs(twice.q[n + i] - once->q[i]));
        left.p = larger(left.p, fabs(twice.p[n + i] - once->p[i]));
        left.diagonal = larger(left.diagonal, fabs(twice.q[n + i] - twice.q[i]));
        left.diagonal = larger(left.diagonal, fabs(twice.p[n + i] + twice.p[i]));
    }
    return left;
}

/* F- and F+ of the two ends of an exact solution against the exact discrete
   forces, of one start; as a pair, and their sum                              */
static MAYBE int force_errors(const problem *pb, const method *m, real h, real *pair, real *sum)
{
    real y0[MAX_Y], y1[MAX_Y], minus[MAX_N], plus[MAX_N], F0[MAX_N], F1[MAX_N];
    exact_step(pb, 0, h, y0, y1);
    exact_forces(pb, step_time(pb, h), h, y0, y1, F0, F1);
    gvi_stepper *st = bench(pb, m, step_time(pb, h), y0);
    if (st->status != GVI_OK || gvi_discrete_lagrangian(st, st->t, h, y0, y1,
                                    &(gvi_discrete){ .minus = minus, .plus = plus }) != GVI_OK) return 0;
    *pair = sqrt(square_distance(pb->n, minus, F0) + square_distance(pb->n, plus, F1));
    for (int i = 0; i < pb->n; ++i) { minus[i] += plus[i]; F0[i] += F1[i]; }
    *sum = sqrt(square_distance(pb->n, minus, F0));
    return 1;
}

static MAYBE real force_error(const problem *pb, const method *m, real h)
{
    real pair, sum;
    return force_errors(pb, m, h, &pair, &sum) ? pair : (real)NAN;
}

static MAYBE real force_sum_error(const problem *pb, const method *m, real h)
{
    real pair, sum;
    return force_errors(pb, m, h, &pair, &sum) ? sum : (real)NAN;
}

#endif
