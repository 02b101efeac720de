/* inertia.h - minimum or saddle: the second variation of the discrete action on
   the interior of a step, and the conjugate points of the solution             */
#ifndef INERTIA_H
#define INERTIA_H

#include "bench.h"

enum { MAX_S = 24, MAX_H = MAX_N*(MAX_S - 1) };

/* The action of a polynomial by its values x at s + 1 Lobatto points, and what it
   takes to move one of them                                                   */
typedef struct action {
    const problem *pb;
    int  s, r;
    real t, h, c[MAX_S + 4], b[MAX_S + 4];
    real l[MAX_S + 4][MAX_S + 1], dl[MAX_S + 4][MAX_S + 1];   /* basis at the nodes of the rule */
    real x[MAX_S + 1][MAX_N];
} action;

static MAYBE real action_value(const action *a)
{
    real sum = 0;
    for (int i = 0; i < a->r; ++i) {
        real q[MAX_N] = { 0 }, v[MAX_N] = { 0 };
        for (int j = 0; j <= a->s; ++j)
            for (int k = 0; k < a->pb->n; ++k) {
                q[k] += a->l[i][j]*a->x[j][k];
                v[k] += a->dl[i][j]*a->x[j][k]/a->h;
            }
        sum += a->h*a->b[i]*a->pb->lagrangian(a->t + a->c[i]*a->h, q, v);
    }
    return sum;
}

/* The curve of one library step of m from y at time t; 0 if there is none */
static MAYBE int action_of_step(action *a, const problem *pb, const method *m, real t, const real *y, real h)
{
    real x[MAX_S + 1], w[MAX_S + 1];
    gvi_stepper *st = bench(pb, m, t, y);
    if (st->status != GVI_OK || gvi_step(st, h) != GVI_OK) return 0;
    *a = (action){ .pb = pb, .s = m->s, .r = st->r, .t = t, .h = h };
    if (m->rule.kind == GVI_LOBATTO) gvi_lobatto(a->r, a->c, a->b);
    else gvi_gauss(a->r, a->c, a->b);
    if (m->s > 1) gvi_lobatto(m->s + 1, x, w);
    else x[0] = 0, x[1] = 1;
    for (int j = 0; j <= m->s; ++j) gvi_curve(st, x[j], a->x[j], NULL);
    gvi_barycentric(m->s + 1, x, w);
    for (int i = 0; i < a->r; ++i) {
        gvi_basis(m->s + 1, x, w, a->c[i], a->l[i]);
        gvi_basis_derivative(m->s + 1, x, w, a->c[i], a->dl[i]);
    }
    return 1;
}

/* d^2 S/dx_j dx_k over the interior values, by central differences: exact to
   about sqrt(eps) of its largest entries                                      */
static MAYBE int second_variation(action *a, real *H)
{
    int n = a->pb->n, N = n*(a->s - 1);
    real delta = sqrt(sqrt(UNIT))*4, *x = &a->x[1][0];
    for (int i = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j) {
            real *xi = x + i/n*MAX_N + i%n, *xj = x + j/n*MAX_N + j%n, sum = 0, ki = *xi, kj = *xj;
            for (int k = 0; k < 4; ++k) {
                *xi = ki;
                *xj = kj;
                *xi += k & 1 ? delta : -delta;
                *xj += k & 2 ? delta : -delta;
                sum += (k == 0 || k == 3 ? 1 : -1)*action_value(a);
            }
            *xj = kj;
            *xi = ki;
            H[i*N + j] = H[j*N + i] = sum/(4*delta*delta);
        }
    return N;
}

/* Eigenvalues on the diagonal, by Jacobi's rotations */
static MAYBE void diagonalise(int N, real *H)
{
    for (int sweep = 0; sweep < 40; ++sweep) {
        real off = 0;
        for (int p = 0; p < N; ++p)
            for (int q = p + 1; q < N; ++q) {
                real g = H[p*N + q];
                off += fabs(g);
                if (!(fabs(g) > 0)) continue;
                real theta = (H[q*N + q] - H[p*N + p])/(2*g);
                real t = (theta < 0 ? -1 : 1)/(fabs(theta) + sqrt(1 + theta*theta));
                real c = 1/sqrt(1 + t*t), s = t*c;
                for (int k = 0; k < N; ++k) {
                    real a = H[k*N + p], b = H[k*N + q];
                    H[k*N + p] = c*a - s*b;
                    H[k*N + q] = s*a + c*b;
                }
                for (int k = 0; k < N; ++k) {
                    real a = H[p*N + k], b = H[q*N + k];
                    H[p*N + k] = c*a - s*b;
                    H[q*N + k] = s*a + c*b;
                }
            }
        if (!(off > 1e-15L*N)) break;
    }
}

/* The number of negative eigenvalues: 0 minimum, else saddle; -1: no step.
   The library's own count is index_by_query.                                  */
static MAYBE int index_of_step(const problem *pb, const method *m, real t, const real *y, real h)
{
    static action a;
    static real H[MAX_H*MAX_H];
    int count = 0;
    if (!action_of_step(&a, pb, m, t, y, h)) return -1;
    int N = second_variation(&a, H);
    diagonalise(N, H);
    for (int i = 0; i < N; ++i) if (H[i*N + i] < 0) ++count;
    return count;
}

/* The same as gvi_discrete_lagrangian counts it, between the ends of that step; -1
   if its boundary-value problem has found no curve, or another one.           */
static MAYBE int index_by_query(const problem *pb, const method *m, real t, const real *y, real h)
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

/* det dq(t + h)/dp, p at t: zero at a conjugate point.  Morse: as many negative
   directions of the action as there are conjugate points in (t, t + h).       */
static MAYBE real jacobi_determinant(const problem *pb, real t, const real *y, real h)
{
    real J[MAX_N*MAX_N] = { 0 };
    jacobi(pb, t, h, y, J);
    return pb->n == 1 ? J[0] : J[0]*J[3] - J[1]*J[2];
}

#endif
