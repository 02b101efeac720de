/* reference.h - exact values, to rounding, by means that share nothing with gvi.h

   The flow of Hamilton's equations by Gragg-Bulirsch-Stoer extrapolation of
   order 14 (20 in quadruple precision), the action carried along as one more unknown, S' = L(t,q,v); the
   solution between two configurations by shooting; from both, the exact discrete
   Lagrangian and the exact discrete forces of Marsden and West (2001).        */
#ifndef REFERENCE_H
#define REFERENCE_H

#include "problems.h"
#define EXTRAPOLATE_COLUMNS (LDBL_MANT_DIG > 64 ? 10 : 7)
#include "tests/hard/extrapolate.h"

enum { MAX_Y = 2*MAX_N + 1, NODES = 20 };

/* dL/dq and dL/dv */
static MAYBE void gradient(const problem *pb, real t, const real *q, const real *v, real *dq, real *dv)
{
    for (int i = 0; i < pb->n; ++i) dq[i] = dv[i] = 0;
    pb->kinetic(q, v, dq, dv);
    for (int k = 0; k < pb->effect_count - pb->forced; ++k) pb->effects[k].point(t, q, v, dq, dv, NULL);
}

/* adds the force, if there is one */
static MAYBE void add_force(const problem *pb, real t, const real *q, const real *v, real *f)
{
    if (pb->forced) pb->effects[pb->effect_count - 1].point(t, q, v, f, NULL, NULL);
}

/* y = (q, p, S) */
static MAYBE void rates(const problem *pb, real t, const real *y, real *dy)
{
    real unused[MAX_N];
    int n = pb->n;
    pb->velocity(t, y, y + n, dy);
    gradient(pb, t, y, dy, dy + n, unused);
    add_force(pb, t, y, dy, dy + n);
    dy[2*n] = pb->lagrangian(t, y, dy);
}

static MAYBE void rates_of(real t, const real *y, real *dy, void *pb) { rates(pb, t, y, dy); }

/* Moves y from time a to b in steps of at most H */
static MAYBE void flow_with(const problem *pb, real a, real b, real H, real *y)
{
    problem copy = *pb;
    const motion exact = { 2*pb->n + 1, rates_of, &copy };
    if (fabs(b - a) > 0) flow(&exact, a, b, H, y);
}

static MAYBE void flow_of(const problem *pb, real a, real b, real *y) { flow_with(pb, a, b, 1/32.0L, y); }

/* y = (q, p, 0) of a start */
static MAYBE void start_state(const problem *pb, int start, real *y)
{
    real unused[MAX_N];
    int n = pb->n;
    memcpy(y, pb->q[start], (size_t)n*sizeof *y);
    gradient(pb, 0, pb->q[start], pb->v[start], unused, y + n);
    y[2*n] = 0;
}

/* The states in the middle and at the end of a run; computed once */
static MAYBE const real *run_state(const problem *pb, int start, int end)
{
    static struct { const problem *pb; real y[STARTS][2][MAX_Y]; } known[16];
    int k = 0;
    while (known[k].pb && known[k].pb != pb) ++k;
    if (!known[k].pb) {
        known[k].pb = pb;
        for (int i = 0; i < STARTS; ++i) {
            start_state(pb, i, known[k].y[i][0]);
            flow_of(pb, 0, pb->time/2, known[k].y[i][0]);
            memcpy(known[k].y[i][1], known[k].y[i][0], sizeof known[k].y[i][1]);
            flow_of(pb, pb->time/2, pb->time, known[k].y[i][1]);
        }
    }
    return known[k].y[start][end];
}

/* A step of length h, its middle in the middle of a run: the exact states at both
   ends, with the action from one to the other.  The middle stays while h shrinks,
   which rids the error of a symmetric method of every other power of h.       */
static MAYBE void exact_step(const problem *pb, int start, real h, real *y0, real *y1)
{
    const real *y = run_state(pb, start, 0);
    real middle = pb->time/2;
    int n = pb->n;
    memcpy(y0, y, MAX_Y*sizeof *y);
    memcpy(y1, y, MAX_Y*sizeof *y);
    y0[2*n] = y1[2*n] = 0;
    flow_of(pb, middle, middle - h/2, y0);
    flow_of(pb, middle, middle + h/2, y1);
    y1[2*n] -= y0[2*n];
    y0[2*n] = 0;
}

/* ------------------------------------------------------ between configurations */

/* a x = b by Gauss elimination with pivots, for small n; overwrites a */
static MAYBE void solve(int n, real *a, real *b)
{
    for (int k = 0; k < n; ++k) {
        int best = k;
        for (int i = k; i < n; ++i) if (fabs(a[i*n + k]) > fabs(a[best*n + k])) best = i;
        for (int j = 0; j < n; ++j) { real x = a[k*n + j]; a[k*n + j] = a[best*n + j]; a[best*n + j] = x; }
        { real x = b[k]; b[k] = b[best]; b[best] = x; }
        for (int i = k + 1; i < n; ++i) {
            real w = a[i*n + k]/a[k*n + k];
            for (int j = k; j < n; ++j) a[i*n + j] -= w*a[k*n + j];
            b[i] -= w*b[k];
        }
    }
    for (int k = n; k-- > 0; ) {
        for (int j = k + 1; j < n; ++j) b[k] -= a[k*n + j]*b[j];
        b[k] /= a[k*n + k];
    }
}

/* Jacobi fields by differences: J[i][j] = d q_i(t + h)/d p_j.  For a Jacobian of
   Newton's method and for signs of determinants: exact to about 1e-12.        */
static MAYBE void jacobi(const problem *pb, real t, real h, const real *y0, real *J)
{
    real delta = cbrt(UNIT);
    int n = pb->n;
    for (int j = 0; j < n; ++j) {
        real up[MAX_Y], down[MAX_Y];
        memcpy(up, y0, sizeof up);
        memcpy(down, y0, sizeof down);
        up[n + j] += delta;
        down[n + j] -= delta;
        flow_of(pb, t, t + h, up);
        flow_of(pb, t, t + h, down);
        for (int i = 0; i < n; ++i) J[i*n + j] = (up[i] - down[i])/(2*delta);
    }
}

/* Shooting: changes the momentum in y0 until the solution meets q1; y1 is where
   it ends.  Newton's method from a guess that is near, with one Jacobian.      */
static MAYBE void shoot(const problem *pb, real t, real h, real *y0, const real *q1, real *y1)
{
    real J[MAX_N*MAX_N], A[MAX_N*MAX_N], d[MAX_N];
    int n = pb->n;
    jacobi(pb, t, h, y0, J);
    for (int it = 0; it < 40; ++it) {
        memcpy(y1, y0, MAX_Y*sizeof *y1);
        flow_of(pb, t, t + h, y1);
        for (int i = 0; i < n; ++i) d[i] = q1[i] - y1[i];
        memcpy(A, J, sizeof A);
        solve(n, A, d);
        real size = 0;
        for (int i = 0; i < n; ++i) { size += fabs(d[i]); y0[n + i] += d[i]; }
        if (size < 2*UNIT) break;
    }
}

/* The exact discrete forces: the integrals of f . dq/dq0 and f . dq/dq1 along
   the solution from q0 to q1.  Gauss-Legendre in time; the derivatives of the
   solution by its boundary values are central differences of order 8 of
   solutions that were shot.                                                  */
static MAYBE void exact_forces(const problem *pb, real t, real h, const real *y0, const real *y1,
                               real *minus, real *plus)
{
    static const real weight[4] = { 4/5.0L, -1/5.0L, 4/105.0L, -1/280.0L };
    real c[NODES], b[NODES], f[NODES][MAX_N] = { { 0 } }, delta = pow(UNIT, 1/9.0L)/4;
    int n = pb->n;
    gvi_gauss(NODES, c, b);
    for (int k = 0; k < NODES; ++k) {
        real y[MAX_Y], dy[MAX_Y];
        memcpy(y, y0, sizeof y);
        flow_of(pb, t, t + c[k]*h, y);
        rates(pb, t + c[k]*h, y, dy);
        add_force(pb, t + c[k]*h, y, dy, f[k]);
    }
    for (int j = 0; j < 2*n; ++j) {
        real sum = 0;
        for (int step = -4; step <= 4; ++step) {
            real a[MAX_Y], q1[MAX_N], end[MAX_Y];
            if (step == 0) continue;
            memcpy(a, y0, sizeof a);
            memcpy(q1, y1, sizeof q1);
            *(j < n ? a + j : q1 + j - n) += step*delta;
            shoot(pb, t, h, a, q1, end);
            for (int k = 0; k < NODES; ++k) {
                flow_of(pb, t + (k ? c[k - 1] : 0)*h, t + c[k]*h, a);
                for (int i = 0; i < n; ++i)
                    sum += h*b[k]*f[k][i]*a[i]*(step > 0 ? 1 : -1)*weight[abs(step) - 1]/delta;
            }
        }
        *(j < n ? minus + j : plus + j - n) = sum;
    }
}

#endif
