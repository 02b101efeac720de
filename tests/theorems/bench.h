/* bench.h - a stepper on a problem, and slopes

   What goes wrong in a call comes out as NaN, which no bound accepts.         */
#ifndef BENCH_H
#define BENCH_H

#include "rules.h"

typedef struct method { int s; gvi_rule rule; } method;

static real bench_memory[150000];
static MAYBE gvi_stepper bench_stepper;

static MAYBE gvi_desc bench_desc(const problem *pb, const method *m)
{
    return (gvi_desc){ .n = pb->n, .degree = m->s, .rule = m->rule, .mass = pb->mass,
                       .effects = pb->effects, .effect_count = pb->effect_count };
}

/* Ready to step from y = (q, p, ...) at time t; the status is in it */
static MAYBE gvi_stepper *bench(const problem *pb, const method *m, real t, const real *y)
{
    const gvi_desc desc = bench_desc(pb, m);
    if (gvi_init(&bench_stepper, &desc, bench_memory, sizeof bench_memory) == GVI_OK)
        gvi_start_momentum(&bench_stepper, t, y, y + pb->n);
    return &bench_stepper;
}

static MAYBE real square_distance(int n, const real *a, const real *b)
{
    real sum = 0;
    for (int i = 0; i < n; ++i) sum += (a[i] - b[i])*(a[i] - b[i]);
    return sum;
}

/* Keeps NaN */
static MAYBE real larger(real a, real b) { return isnan(a) || b <= a ? a : b; }

/* Distance of (q, p) from the exact state after pb->time in steps of h, root
   mean square over the starts                                                */
static MAYBE real end_error(const problem *pb, const method *m, real h)
{
    int steps = (int)(pb->time/h + 0.5L), n = pb->n;
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        real y[MAX_Y];
        const real *end = run_state(pb, start, 1);
        start_state(pb, start, y);
        gvi_stepper *st = bench(pb, m, 0, y);
        for (int k = 0; k < steps && st->status == GVI_OK; ++k) gvi_step(st, pb->time/steps);
        if (st->status != GVI_OK) return (real)NAN;
        sum += square_distance(n, st->q, end) + square_distance(n, st->p, end + n);
    }
    return sqrt(sum/STARTS);
}

/* The start of the step of exact_step() */
static MAYBE real step_time(const problem *pb, real h) { return pb->time/2 - h/2; }

/* Distance of (q, p) after one step from the exact state, root mean square over
   the starts                                                                 */
static MAYBE real step_error(const problem *pb, const method *m, real h)
{
    real sum = 0;
    int n = pb->n;
    for (int start = 0; start < STARTS; ++start) {
        real y0[MAX_Y], y1[MAX_Y];
        exact_step(pb, start, h, y0, y1);
        gvi_stepper *st = bench(pb, m, step_time(pb, h), y0);
        if (st->status != GVI_OK || gvi_step(st, h) != GVI_OK) return (real)NAN;
        sum += square_distance(n, st->q, y1) + square_distance(n, st->p, y1 + n);
    }
    return sqrt(sum/STARTS);
}

/* L_d of the two ends of an exact solution against its action, root mean square
   over the starts.  The oscillator: against its closed form.                  */
static MAYBE real lagrangian_error(const problem *pb, const method *m, real h)
{
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        real y0[MAX_Y], y1[MAX_Y], Ld, exact;
        exact_step(pb, start, h, y0, y1);
        exact = y1[2*pb->n];
        if (pb == &oscillator) exact = ((y0[0]*y0[0] + y1[0]*y1[0])*cos(h) - 2*y0[0]*y1[0])/(2*sin(h));
        gvi_stepper *st = bench(pb, m, step_time(pb, h), y0);
        if (st->status != GVI_OK || gvi_discrete_lagrangian(st, st->t, h, y0, y1,
                                        &(gvi_discrete){ .lagrangian = &Ld }) != GVI_OK) return (real)NAN;
        sum += (Ld - exact)*(Ld - exact);
    }
    return sqrt(sum/STARTS);
}

/* d1, d2, F- and F+ at the two ends of an exact solution, against those of the solution; root mean square over the
   starts                                                                     */
static MAYBE void force_errors(const problem *pb, const method *m, real h, real *error)
{
    const real t = step_time(pb, h);
    for (int k = 0; k < PARTS; ++k) error[k] = 0;
    for (int start = 0; start < STARTS; ++start) {
        const real *want = kept(exact_parts, pb, start, h);
        real y0[MAX_Y], y1[MAX_Y], got[PARTS][MAX_N];
        exact_step(pb, start, h, y0, y1);
        gvi_stepper *st = bench(pb, m, t, y0);
        const gvi_discrete out = { .d1 = got[0], .d2 = got[1], .minus = got[2], .plus = got[3] };
        if (st->status == GVI_OK) gvi_discrete_lagrangian(st, t, h, y0, y1, &out);
        for (int k = 0; k < PARTS; ++k)
            error[k] += st->status == GVI_OK ? square_distance(pb->n, got[k], want + k*MAX_N)/STARTS : (real)NAN;
    }
    for (int k = 0; k < PARTS; ++k) error[k] = sqrt(error[k]);
}

/* ------------------------------------------------------- inside one exact step

   Distances of a curve from the solution in a step: the largest and the integral
   over the step, of the position and of its velocity, root mean square over the
   starts                                                                     */
enum { NORMS = 4 };
typedef enum curve_kind { OF_THE_STEP, OF_THE_ENDS, STATE_AT, INTERPOLANT } curve_kind;

/* Ready for gvi_curve: a step from y0, or with the momentum that the boundary-value problem from y0 to y1 gives */
static MAYBE gvi_stepper *stepped(const problem *pb, const method *m, real t, real h, const real *y0, const real *y1,
                                  curve_kind kind)
{
    real dy[MAX_Y], p0[MAX_N];
    gvi_stepper *st = bench(pb, m, t, y0);
    rates(pb, t, y0, dy);
    const gvi_discrete out = { .p0 = p0, .guess = dy };
    if (st->status == GVI_OK && kind == OF_THE_ENDS && gvi_discrete_lagrangian(st, t, h, y0, y1, &out) == GVI_OK)
        gvi_start_momentum(st, t, y0, p0);
    if (st->status == GVI_OK) gvi_step(st, h);
    return st;
}

/* The polynomial of degree s through the solution at Lobatto's s + 1 points: q and its derivative at tau */
static MAYBE void interpolant(const problem *pb, const own_rule *at, real h, real y[MAX_R][MAX_Y], real tau,
                              real *q, real *v)
{
    for (int i = 0; i < pb->n; ++i) q[i] = v[i] = 0;
    for (int e = 0; e < at->r; ++e) {
        real value = 1, slope_ = 0;
        for (int k = 0; k < at->r; ++k) {
            if (k == e) continue;
            const real w = 1/(at->c[e] - at->c[k]), x = (tau - at->c[k])*w;
            slope_ = slope_*x + value*w;
            value *= x;
        }
        for (int i = 0; i < pb->n; ++i) {
            q[i] += value*y[e][i];
            v[i] += slope_*y[e][i]/h;
        }
    }
}

/* |position| and |velocity| of the difference at tau = k/INSIDE, in one step */
static MAYBE int curve_errors(const problem *pb, const method *m, int start, real h, curve_kind kind,
                              real *of_q, real *of_v)
{
    const real *exact = kept(exact_inside, pb, start, h), *end = exact + INSIDE*MAX_Y, t0 = step_time(pb, h);
    own_rule at = { 0 };
    real at_nodes[MAX_R][MAX_Y], dy[MAX_Y], q[MAX_N], v[MAX_N];
    gvi_stepper *st = stepped(pb, m, t0, h, exact, end, kind);
    if (kind == INTERPOLANT) at = lobatto(m->s + 1);
    for (int e = 0; e < at.r; ++e) {
        memcpy(at_nodes[e], exact, sizeof at_nodes[e]);
        flow_of(pb, t0, t0 + at.c[e]*h, at_nodes[e]);
    }
    for (int k = 0; k <= INSIDE && st->status == GVI_OK; ++k) {
        const real tau = (real)k/INSIDE, t = k < INSIDE ? t0 + tau*h : st->t, *y = exact + k*MAX_Y;
        rates(pb, t, y, dy);
        if (kind == INTERPOLANT) interpolant(pb, &at, h, at_nodes, tau, q, v);
        else if (kind == STATE_AT) gvi_state_at(st, t, q, v, NULL);
        else gvi_curve(st, tau, q, v);
        of_q[k] = sqrt(square_distance(pb->n, q, y));
        of_v[k] = sqrt(square_distance(pb->n, v, dy));
    }
    return st->status == GVI_OK;
}

/* Largest |q|, integral of |q|, largest |v|, integral of |v| */
static MAYBE void curve_norms(const problem *pb, const method *m, real h, curve_kind kind, real *norm)
{
    for (int i = 0; i < NORMS; ++i) norm[i] = 0;
    for (int start = 0; start < STARTS; ++start) {
        real e[2][INSIDE + 1];
        int known = curve_errors(pb, m, start, h, kind, e[0], e[1]);
        for (int i = 0; i < 2; ++i) {
            real most = 0, sum = -(e[i][0] + e[i][INSIDE])/2;
            for (int k = 0; k <= INSIDE; ++k) { most = larger(most, e[i][k]); sum += e[i][k]; }
            if (!known) most = sum = (real)NAN;
            norm[2*i] += most*most/STARTS;
            norm[2*i + 1] += h*h*sum*sum/(INSIDE*INSIDE*STARTS);
        }
    }
    for (int i = 0; i < NORMS; ++i) norm[i] = sqrt(norm[i]);
}

/* Size of d^s q/dt^s, the highest derivative of the discrete curve of one exact step: its s-th difference over
   h/s, root mean square over the starts                                      */
static MAYBE real top_derivative(const problem *pb, const method *m, real h)
{
    const int n = pb->n, s = m->s;
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        real y0[MAX_Y], y1[MAX_Y], d[MAX_N] = { 0 }, q[MAX_N], v[MAX_N], w = pow(s/h, (real)s);
        exact_step(pb, start, h, y0, y1);
        gvi_stepper *st = stepped(pb, m, step_time(pb, h), h, y0, y1, OF_THE_STEP);
        for (int k = 0; k <= s; ++k) {
            if (gvi_curve(st, (real)k/s, q, v) != GVI_OK) return (real)NAN;
            for (int i = 0; i < n; ++i) d[i] += w*q[i];
            w *= -(real)(s - k)/(k + 1);
        }
        for (int i = 0; i < n; ++i) sum += d[i]*d[i];
    }
    return sqrt(sum/STARTS);
}

/* ----------------------------------------------------------------------- slopes

   What converges with h, and where it is looked at                            */
typedef real error_fn(const problem *pb, const method *m, real h);

/* The exponent in error = C h^exponent, from two step sizes T/N and T/M, M near
   2N/3, T the length of a run.  N: as far as rounding allows, where the error is
   still 1000 or more units of it, and no more than `most` steps: what converges
   slowly has shown its slope by then.  `expected` only says where to look.     */
static MAYBE real slope(error_fn *error, const problem *pb, const method *m, real expected, int most)
{
    real T = pb->time, first = error(pb, m, T/12), least = 1e3L*UNIT, e;
    int N = most, M;
    if (first > 0 && first < 1) N = (int)fmin((real)most, 12*pow(first/least, 1/expected));
    if (N < 5) N = 5;
    while ((e = error(pb, m, T/N)) < least && N > 5) N -= N < 32 ? 1 : N/16;
    M = (2*N + 1)/3;
    return log(error(pb, m, T/M)/e)/log((real)N/M);
}

#endif
