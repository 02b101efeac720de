/* reference.h - exact values, to rounding, by means that share nothing with gvi.h

   The flow of Hamilton's equations by Gragg-Bulirsch-Stoer extrapolation of
   order 14 (20 in quadruple precision), the action carried along as one more
   unknown, S' = L(t,q,v): of a solution it is the exact discrete Lagrangian.  */
#ifndef REFERENCE_H
#define REFERENCE_H

#include "problems.h"
#define EXTRAPOLATE_COLUMNS (LDBL_MANT_DIG > 64 ? 10 : 7)
#include "tests/hard/extrapolate.h"

enum { MAX_Y = 2*MAX_N + 1 };

/* dL/dq and dL/dv */
static MAYBE void gradient(const problem *pb, real t, const real *q, const real *v, real *dq, real *dv)
{
    for (int i = 0; i < pb->n; ++i) dq[i] = dv[i] = 0;
    pb->kinetic(q, v, dq, dv);
    for (int k = 0; k < pb->effect_count - pb->forced; ++k) {
        const gvi_effect *e = &pb->effects[k];
        e->point(t, q, v, dq, dv, e->user);
    }
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

/* ----------------------------------------------------------- derivatives of it */

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

/* Jacobi fields by differences: J[i][j] = d q_i(t + h)/d p_j, exact to about 1e-12  */
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

/* ------------------------------------------------- more of the exact step, kept */

/* Values of a step are wanted again for other methods: the last ones are kept */
enum { INSIDE = 24, VALUES = (INSIDE + 1)*MAX_Y, PARTS = 4 };
typedef void fill_fn(const problem *pb, int start, real h, real *values);

static MAYBE const real *kept(fill_fn *fill, const problem *pb, int start, real h)
{
    enum { MOST = 256 };
    static struct { fill_fn *fill; const problem *pb; int start; real h, values[VALUES]; } known[MOST];
    static int next;
    for (int k = 0; k < MOST; ++k)
        if (known[k].fill == fill && known[k].pb == pb && known[k].start == start && known[k].h == h)
            return known[k].values;
    next = (next + 1)%MOST;
    known[next].fill = fill;
    known[next].pb = pb;
    known[next].start = start;
    known[next].h = h;
    fill(pb, start, h, known[next].values);
    return known[next].values;
}

/* (q, p, S) at tau = k/INSIDE */
static MAYBE void exact_inside(const problem *pb, int start, real h, real *y)
{
    const real t = pb->time/2 - h/2;
    real end[MAX_Y];
    exact_step(pb, start, h, y, end);
    for (int k = 1; k <= INSIDE; ++k) {
        real *to = y + k*MAX_Y;
        memcpy(to, to - MAX_Y, MAX_Y*sizeof *y);
        flow_of(pb, t + (real)(k - 1)/INSIDE*h, t + (real)k/INSIDE*h, to);
    }
}

/* The ends of a smooth curve that is no solution, a cubic around the middle of a run, and the action of the solution
   between them, by Newton's method for its momentum: q0, q1, its velocity at q0, S  */
static MAYBE void any_ends(const problem *pb, int start, real h, real *ends)
{
    real y0[MAX_Y], y1[MAX_Y], v[MAX_N], unused[MAX_N], J[MAX_N*MAX_N], off[MAX_N];
    const int n = pb->n;
    for (int end = 0; end < 2; ++end)
        for (int i = 0; i < n; ++i) {
            const real t = end ? h/2 : -h/2;
            ends[end*MAX_N + i] = pb->q[start][i] + t*(pb->v[start][i] + t*(0.5L*i - 0.7L + t*(0.4L - 0.9L*i)));
        }
    for (int i = 0; i < n; ++i) {
        y0[i] = ends[i];
        v[i] = (ends[MAX_N + i] - ends[i])/h;
    }
    gradient(pb, pb->time/2 - h/2, y0, v, unused, y0 + n);
    for (int it = 0; it < 8; ++it) {
        y0[2*n] = 0;
        memcpy(y1, y0, sizeof y1);
        flow_of(pb, pb->time/2 - h/2, pb->time/2 + h/2, y1);
        jacobi(pb, pb->time/2 - h/2, h, y0, J);
        for (int i = 0; i < n; ++i) off[i] = ends[MAX_N + i] - y1[i];
        solve(n, J, off);
        for (int i = 0; i < n; ++i) y0[n + i] += off[i];
    }
    pb->velocity(pb->time/2 - h/2, y0, y0 + n, ends + 2*MAX_N);
    ends[3*MAX_N] = y1[2*n];
}

/* d^k/dt^k of the solution's (q, p) in the middle of a run, by the differences of 13 points that are exact for
   polynomials                                                                */
static MAYBE void derivative_in_time(const problem *pb, int start, int k, real *d)
{
    enum { POINTS = 13, HALF = POINTS/2 };
    const real delta = 1/64.0L;
    real A[POINTS*POINTS], w[POINTS] = { 0 };
    for (int i = 0; i < POINTS; ++i)
        for (int j = 0; j < POINTS; ++j) A[i*POINTS + j] = i ? A[(i - 1)*POINTS + j]*(j - HALF) : 1;
    w[k] = 1;
    for (int i = 1; i <= k; ++i) w[k] *= i/delta;
    solve(POINTS, A, w);
    for (int i = 0; i < 2*pb->n; ++i) d[i] = 0;
    for (int j = 0; j < POINTS; ++j) {
        real y[MAX_Y];
        memcpy(y, run_state(pb, start, 0), sizeof y);
        flow_of(pb, pb->time/2, pb->time/2 + (j - HALF)*delta, y);
        for (int i = 0; i < 2*pb->n; ++i) d[i] += w[j]*y[i];
    }
}

/* x'M^-1 x and x'M x in the middle of a run, M = d^2L/dv^2: M^-1 = dv/dp     */
static MAYBE real inverse_mass_of(const problem *pb, int start, const real *x)
{
    const real *y = run_state(pb, start, 0), delta = cbrt(UNIT);
    real p[2][MAX_N], v[2][MAX_N], sum = 0;
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < pb->n; ++i) p[k][i] = y[pb->n + i] + (k ? delta : -delta)*x[i];
        pb->velocity(pb->time/2, y, p[k], v[k]);
    }
    for (int i = 0; i < pb->n; ++i) sum += x[i]*(v[1][i] - v[0][i])/(2*delta);
    return sum;
}

static MAYBE real mass_of(const problem *pb, int start, const real *x)
{
    const real *y = run_state(pb, start, 0), delta = cbrt(UNIT);
    real v[MAX_N], w[MAX_N], unused[MAX_N], p[2][MAX_N], sum = 0;
    pb->velocity(pb->time/2, y, y + pb->n, v);
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < pb->n; ++i) w[i] = v[i] + (k ? delta : -delta)*x[i];
        gradient(pb, pb->time/2, y, w, unused, p[k]);
    }
    for (int i = 0; i < pb->n; ++i) sum += x[i]*(p[1][i] - p[0][i])/(2*delta);
    return sum;
}

/* A stretch of the flow as a map (q, p) -> (q, p, S) */
typedef struct flow_span { const problem *pb; real t, h; } flow_span;

static MAYBE void flow_map(const void *what, const real *x, real *y)
{
    const flow_span *a = what;
    const int n = a->pb->n;
    memcpy(y, x, (size_t)(2*n)*sizeof *y);
    y[2*n] = 0;
    flow_of(a->pb, a->t, a->t + a->h, y);
}

/* The derivatives d1 and d2 of the exact discrete Lagrangian by q0 and q1, and the discrete forces F- and F+: with
   forces it is the action of the forced solution, dS = d1'dq0 + d2'dq1 along all solutions near the given one, and
   p0 = -d1 - F-, p1 = d2 + F+                                                */
static MAYBE void exact_parts(const problem *pb, int start, real h, real *part)
{
    real M[MAX_Y*2*MAX_N], A[MAX_N*MAX_N], y0[MAX_Y], y1[MAX_Y];              /* M: rows q1, p1, S; columns q0, p0 */
    real *d1 = part, *d2 = d1 + MAX_N, *minus = d2 + MAX_N, *plus = minus + MAX_N;
    const int n = pb->n;
    const real *S = M + 4*n*n;
    exact_step(pb, start, h, y0, y1);
    derivative(flow_map, &(flow_span){ pb, pb->time/2 - h/2, h }, 2*n, 2*n + 1, y0, UNIT, M);
    for (int i = 0; i < n; ++i) {
        d2[i] = S[n + i];
        for (int j = 0; j < n; ++j) A[i*n + j] = M[j*2*n + n + i];
    }
    solve(n, A, d2);
    for (int i = 0; i < n; ++i) {
        d1[i] = S[i];
        for (int j = 0; j < n; ++j) d1[i] -= d2[j]*M[j*2*n + i];
        minus[i] = -y0[n + i] - d1[i];
        plus[i] = y1[n + i] - d2[i];
    }
}

#endif
