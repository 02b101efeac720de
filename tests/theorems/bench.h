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

/* A velocity to find the curve between two configurations by, where it is a saddle: refused without */
static MAYBE const real *guess_for(const problem *pb, const real *v)
{
    return pb->lagrangian == saddle_lagrangian || pb->lagrangian == mixed_lagrangian ? v : NULL;
}

/* L_d between q0 and q1 less `exact`; v: the velocity at q0 of the solution between them */
static MAYBE real lagrangian_less(const problem *pb, const method *m, real h, const real *q0, const real *v,
                                  const real *q1, real exact)
{
    const real t = step_time(pb, h);
    real y[MAX_Y], unused[MAX_N], Ld;
    memcpy(y, q0, (size_t)pb->n*sizeof *y);
    gradient(pb, t, q0, v, unused, y + pb->n);
    gvi_stepper *st = bench(pb, m, t, y);
    const gvi_discrete out = { .lagrangian = &Ld, .guess = guess_for(pb, v) };
    if (st->status != GVI_OK || gvi_discrete_lagrangian(st, t, h, q0, q1, &out) != GVI_OK) return (real)NAN;
    return Ld - exact;
}

/* Of the two ends of an exact solution, against its action.  The oscillator: against its closed form. */
static MAYBE real lagrangian_excess(const problem *pb, const method *m, int start, real h)
{
    real y0[MAX_Y], y1[MAX_Y], v[MAX_N];
    exact_step(pb, start, h, y0, y1);
    real exact = y1[2*pb->n];
    if (pb == &oscillator) exact = ((y0[0]*y0[0] + y1[0]*y1[0])*cos(h) - 2*y0[0]*y1[0])/(2*sin(h));
    pb->velocity(step_time(pb, h), y0, y0 + pb->n, v);
    return lagrangian_less(pb, m, h, y0, v, y1, exact);
}

/* Root mean squares over the starts: between the ends of a solution; between those of a curve that is none */
static MAYBE real lagrangian_error(const problem *pb, const method *m, real h)
{
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        const real e = lagrangian_excess(pb, m, start, h);
        sum += e*e/STARTS;
    }
    return sqrt(sum);
}

static MAYBE real any_lagrangian_error(const problem *pb, const method *m, real h)
{
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        const real *ends = kept(any_ends, pb, start, h);
        const real e = lagrangian_less(pb, m, h, ends, ends + 2*MAX_N, ends + MAX_N, ends[3*MAX_N]);
        sum += e*e/STARTS;
    }
    return sqrt(sum);
}

/* d1, d2, F- and F+ at the two ends of an exact solution, against those of the solution, and so d1 + d2 and F- + F+;
   root mean square over the starts                                           */
enum { PARTS_AND_SUMS = PARTS + 2 };

static MAYBE void force_errors(const problem *pb, const method *m, real h, real *error)
{
    const real t = step_time(pb, h);
    for (int k = 0; k < PARTS_AND_SUMS; ++k) error[k] = 0;
    for (int start = 0; start < STARTS; ++start) {
        const real *want = kept(exact_parts, pb, start, h);
        real y0[MAX_Y], y1[MAX_Y], v[MAX_N], off[PARTS_AND_SUMS][MAX_N];
        exact_step(pb, start, h, y0, y1);
        pb->velocity(t, y0, y0 + pb->n, v);
        gvi_stepper *st = bench(pb, m, t, y0);
        const gvi_discrete out = { .d1 = off[0], .d2 = off[1], .minus = off[2], .plus = off[3],
                                    .guess = guess_for(pb, v) };
        if (st->status == GVI_OK) gvi_discrete_lagrangian(st, t, h, y0, y1, &out);
        for (int i = 0; i < pb->n; ++i) {
            for (int k = 0; k < PARTS; ++k) off[k][i] = st->status == GVI_OK ? off[k][i] - want[k*MAX_N + i] : (real)NAN;
            for (int k = 0; k < 2; ++k) off[PARTS + k][i] = off[2*k][i] + off[2*k + 1][i];
            for (int k = 0; k < PARTS_AND_SUMS; ++k) error[k] += off[k][i]*off[k][i]/STARTS;
        }
    }
    for (int k = 0; k < PARTS_AND_SUMS; ++k) error[k] = sqrt(error[k]);
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

/* The solution at the nodes of `at` in one exact step */
static MAYBE void nodes_of_step(const problem *pb, int start, real h, const own_rule *at, real y[MAX_R][MAX_Y])
{
    real end[MAX_Y];
    for (int e = 0; e < at->r; ++e) {
        exact_step(pb, start, h, y[e], end);
        flow_of(pb, step_time(pb, h), step_time(pb, h) + at->c[e]*h, y[e]);
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
    nodes_of_step(pb, start, h, &at, at_nodes);
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
