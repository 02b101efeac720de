/* baselines.c - explicit, splitting, Nystroem and point-by-point Gauss integrators

   Written from the published coefficients, each to be as fast as its author would wish it: n is
   a constant of the inner functions, state and stages are whole vectors (which also spares the
   processor to put a wide load together from narrow stores), tables are scaled with h once,
   loops skip the zeros of the tables, kicks and drifts of adjacent steps are merged.  Compensated
   variants carry what rounding leaves of q and v, and what rounding leaves of the weights.  The
   right-hand side is called through a pointer, one point a call.                              */
#include "baselines.h"
#include "splittings.h"
#include "../gauss.h"

#include <float.h>
#include <math.h>
#include <string.h>

#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
#else
#error "the baselines are written with the vector types of gcc and clang"
#endif
#if defined(__clang__)
#define UNROLL7 _Pragma("clang loop unroll(full)")
#else
#define UNROLL7 _Pragma("GCC unroll 7")
#endif

/* ------------------------------------------------------- vectors of n */

/* op(type) for at = 0, WIDTH, ..., then 4, then 2 of what is left: n is even and constant.     */
#define LANES(n, op) do {                                     \
    int at = 0;                                               \
    for (; at + WIDTH <= (n); at += WIDTH) { op(widest); }    \
    if (WIDTH > 4 && (n) & 4) { op(lane4); at += 4; }         \
    if (WIDTH > 2 && (n) & 2) { op(lane2); }                  \
} while (0)
#define AT(type, x)  (*(type *)((x) + at))
#define OF(type, x)  (*(const type *)((x) + at))

INLINE void copy(const int n, const double *x, double *y)
{
#define OP(L) AT(L, y) = OF(L, x)
    LANES(n, OP);
#undef OP
}

INLINE void zero(const int n, double *x)
{
    for (int i = 0; i < n; ++i) x[i] = 0;
}

/* y += h x                                                                                    */
INLINE void add(const int n, double h, const double *x, double *y)
{
#define OP(L) AT(L, y) += h*OF(L, x)
    LANES(n, OP);
#undef OP
}

/* y + rest += h x, rest being what rounding leaves of y; |y| > |h x| is supposed              */
INLINE void add_compensated(const int n, double h, const double *x, double *y, double *rest)
{
#define OP(L) L d = h*OF(L, x) + OF(L, rest), a = OF(L, y), b = a + d; AT(L, y) = b; AT(L, rest) = d - (b - a)
    LANES(n, OP);
#undef OP
}

/* x = q + h v + sum a_j k_j, j = 0 and lo..hi-1: the latest k last, which the others wait for */
INLINE void combine(const int n, const double *q, double h, const double *v,
                    const double *a, int lo, int hi, const double *k, double *x)
{
#define OP(L) L s = OF(L, q) + h*OF(L, v) + a[0]*OF(L, k);        \
    for (int j = lo; j < hi; ++j) s += a[j]*OF(L, k + j*n);       \
    AT(L, x) = s
    LANES(n, OP);
#undef OP
}

/* d = sum a_j k_j over the same j                                                             */
INLINE void sum(const int n, const double *a, int lo, int hi, const double *k, double *d)
{
#define OP(L) L s = a[0]*OF(L, k);                                \
    for (int j = lo; j < hi; ++j) s += a[j]*OF(L, k + j*n);       \
    AT(L, d) = s
    LANES(n, OP);
#undef OP
}

INLINE double square(const int n, const double *x)
{
    double total = 0;
    widest all = { 0 };
    lane4 s4 = { 0 };
    lane2 s2 = { 0 };
    int at = 0;
    for (; at + WIDTH <= n; at += WIDTH) all += OF(widest, x)*OF(widest, x);
    if (WIDTH > 4 && n & 4) s4 += OF(lane4, x)*OF(lane4, x), at += 4;
    if (WIDTH > 2 && n & 2) s2 += OF(lane2, x)*OF(lane2, x);
    if (n >= WIDTH) for (int i = 0; i < WIDTH; ++i) total += all[i];
    if (WIDTH > 4 && n & 4) total += (s4[0] + s4[1]) + (s4[2] + s4[3]);
    if (WIDTH > 2 && n & 2) total += s2[0] + s2[1];
    return total;
}

INLINE double norm(const int n, const double *x) { return sqrt(square(n, x)); }

/* n as a constant: those of the problems                                                      */
#define BY_SIZE(n, call) do {                                     \
    switch (n) {                                                  \
    case 2:   call(2);   break;                                   \
    case 4:   call(4);   break;                                   \
    case 6:   call(6);   break;                                   \
    case 10:  call(10);  break;                                   \
    case 14:  call(14);  break;                                   \
    case 16:  call(16);  break;                                   \
    case 18:  call(18);  break;                                   \
    case 100: call(100); break;                                   \
    default:  o->failed = 1;                                      \
    } } while (0)
#define BY_STATE(n, call) do {                                    \
    switch (n) {                                                  \
    case 2:   call(4);   break;                                   \
    case 3:   call(6);   break;                                   \
    case 6:   call(12);  break;                                   \
    case 10:  call(20);  break;                                   \
    case 14:  call(28);  break;                                   \
    case 16:  call(32);  break;                                   \
    case 18:  call(36);  break;                                   \
    case 100: call(200); break;                                   \
    default:  o->failed = 1;                                      \
    } } while (0)

static void begin(const problem *p, outcome *o)
{
    memset(o, 0, sizeof *o);
    memcpy(o->q, p->q, sizeof(double)*(size_t)p->n);
    memcpy(o->v, p->v, sizeof(double)*(size_t)p->n);
}

/* y = (q, v) or (q, p), n numbers, and its slope, also where only q'' is given                */
INLINE void get_state(const int n, const outcome *o, double *y)
{
    memcpy(y, o->q, sizeof(double)*(size_t)(n/2));
    memcpy(y + n/2, o->v, sizeof(double)*(size_t)(n/2));
}

INLINE void put_state(const int n, const double *y, outcome *o)
{
    memcpy(o->q, y, sizeof(double)*(size_t)(n/2));
    memcpy(o->v, y + n/2, sizeof(double)*(size_t)(n/2));
}

INLINE void slope_at(const int n, const problem *p, const double *y, double *dy)
{
    if (p->slope) { p->slope(y, dy); return; }
    memcpy(dy, y + n/2, sizeof(double)*(size_t)(n/2));
    p->acceleration(y, dy + n/2);
}

/* -------------------------------------- compositions and splittings */

INLINE void move(const int n, int compensated, double h, const double *x, double *y, double *rest)
{
    if (compensated) add_compensated(n, h, x, y, rest);
    else add(n, h, x, y);
}

/* The part that begins a step, a kick or a drift, ends it too: the two are one, but for the first and the last. */
INLINE void splitting_loop(const int n, const int compensated, const int drift_first, const problem *p,
                           const splitting *s, long steps, watch *w, outcome *o)
{
    double q[MOST_COORDINATES], v[MOST_COORDINATES], a[MOST_COORDINATES], qe[MOST_COORDINATES] = { 0 },
           ve[MOST_COORDINATES] = { 0 }, kick[KICKS], drift[KICKS], h = p->end/(double)steps;
    const int m = s->stages;
    for (int i = 0; i <= m; ++i) kick[i] = h*s->kick[i], drift[i] = h*s->drift[i];
    copy(n, o->q, q);
    copy(n, o->v, v);
    if (drift_first) {
        drift[m] += drift[0];
        move(n, compensated, drift[0], v, q, qe);
    } else {
        kick[m] += kick[0];
        p->acceleration(q, a);
        move(n, compensated, kick[0], a, v, ve);
    }
    for (long k = 0; k < steps; ++k) {
        for (int i = 0; i < m; ++i) {
            if (!drift_first) move(n, compensated, drift[i], v, q, qe);
            p->acceleration(q, a);
            move(n, compensated, kick[drift_first ? i : i+1], a, v, ve);
            if (drift_first) move(n, compensated, drift[i+1], v, q, qe);
        }
        if (!watch_due(w)) continue;
        copy(n, q, o->q);
        copy(n, v, o->v);
        if (drift_first) add(n, -drift[0], v, o->q);
        else add(n, -kick[0], a, o->v);
        watch_look(w, o->q, o->v);
    }
    if (drift_first) move(n, compensated, -drift[0], v, q, qe);
    else move(n, compensated, -kick[0], a, v, ve);
    copy(n, q, o->q);
    copy(n, v, o->v);
    o->evaluations = steps*m + !drift_first;
}

static void run_splitting(const problem *p, const baseline *m, double parameter, watch *w, outcome *o)
{
    const splitting *s = splittings + m->option;
    long steps = (long)parameter;
    begin(p, o);
#define CALL(n) if (s->drift_first) splitting_loop(n, 0, 1, p, s, steps, w, o);      \
                else if (m->compensated) splitting_loop(n, 1, 0, p, s, steps, w, o); \
                else splitting_loop(n, 0, 0, p, s, steps, w, o)
    BY_SIZE(p->n, CALL);
#undef CALL
    o->steps = steps;
}

/* ------------------------------------------------------ Nystroem pairs */

enum { STAGES = 17 };
enum { RKN86, RKN1210, NYSTROEMS };

/* One sum: coefficients, and the range lo..hi-1 that they fill besides the first one.         */
typedef struct row { double a[STAGES]; int lo, hi; } row;

typedef struct nystroem_rows {
    int stages, order, reuse;
    double c[STAGES];
    row A[STAGES], b, w, e, f, b_rest, w_rest;       /* rest: b - (double)b                    */
} nystroem_rows;
static nystroem_rows nystroems[NYSTROEMS];

static void make_row(row *r, int count, const long double *a)
{
    r->lo = r->hi = 1;
    for (int j = 0; j < count; ++j) {
        r->a[j] = (double)a[j];
        if (a[j] < 0 || a[j] > 0) r->hi = j + 1;
    }
    if (r->hi < 1) r->hi = 1;
    while (r->lo < r->hi && !(a[r->lo] < 0 || a[r->lo] > 0)) ++r->lo;
}

static void make_rest(row *r, int count, const long double *a)
{
    long double rest[STAGES];
    for (int j = 0; j < count; ++j) rest[j] = a[j] - (double)a[j];
    make_row(r, count, rest);
}

/* The sums over b and w that must hold exactly, sum w = 1 and sum b = 1/2, hold to the digits
   that the tables are printed with.                                                           */
static void nystroem_begin(nystroem_rows *t, const nystroem *s)
{
    t->stages = s->reuse ? s->stages - 1 : s->stages;
    t->order = s->order;
    t->reuse = s->reuse;
    for (int i = 0; i < s->stages; ++i) {
        t->c[i] = (double)s->c[i];
        make_row(t->A + i, i, s->A[i]);
    }
    make_row(&t->b, s->stages, s->b);
    make_row(&t->w, s->stages, s->w);
    make_row(&t->e, s->stages, s->e);
    make_row(&t->f, s->stages, s->f);
    make_rest(&t->b_rest, s->stages, s->b);
    make_rest(&t->w_rest, s->stages, s->w);
}

INLINE void scale_row(const row *r, double h, row *s)
{
    s->lo = r->lo;
    s->hi = r->hi;
    for (int j = 0; j < STAGES; ++j) s->a[j] = h*r->a[j];
}

/* The table for a step h.                                                                     */
typedef struct scaled { double c[STAGES]; row A[STAGES]; } scaled;

static void scale(const nystroem_rows *t, double h, scaled *s)
{
    for (int i = 0; i < t->stages; ++i) {
        s->c[i] = h*t->c[i];
        scale_row(t->A + i, h*h, s->A + i);
    }
}

typedef struct nystroem_state {
    double q[MOST_COORDINATES], v[MOST_COORDINATES], qe[MOST_COORDINATES], ve[MOST_COORDINATES];
    double x[MOST_COORDINATES], dq[MOST_COORDINATES], dv[MOST_COORDINATES], k[STAGES*MOST_COORDINATES];
} nystroem_state;

INLINE void stages(const int n, const problem *p, const nystroem_rows *t, const scaled *s, nystroem_state *z)
{
    for (int i = 1; i < t->stages; ++i) {
        const row *r = s->A + i;
        combine(n, z->q, s->c[i], z->v, r->a, r->lo, r->hi, z->k, z->x);
        p->acceleration(z->x, z->k + i*n);
    }
}

/* q + qe += h v + h^2 (b + rest) k, v + ve += h (w + rest) k.                                 */
INLINE void advance(const int n, const int compensated, const nystroem_rows *t, double h, double h_rest,
                    nystroem_state *z)
{
    sum(n, t->b.a, t->b.lo, t->b.hi, z->k, z->dq);
    sum(n, t->w.a, t->w.lo, t->w.hi, z->k, z->dv);
    if (!compensated) {
#define OP(L) AT(L, z->q) += h*(OF(L, z->v) + h*OF(L, z->dq)); AT(L, z->v) += h*OF(L, z->dv)
        LANES(n, OP);
#undef OP
        return;
    }
    double bk[MOST_COORDINATES], wk[MOST_COORDINATES];
    sum(n, t->b_rest.a, t->b_rest.lo, t->b_rest.hi, z->k, bk);
    sum(n, t->w_rest.a, t->w_rest.lo, t->w_rest.hi, z->k, wk);
#define OP(L) \
    L v = OF(L, z->v), q = OF(L, z->q), ve = OF(L, z->ve);                                               \
    L d = h*v + (OF(L, z->qe) + h_rest*v + h*ve + h*h*OF(L, bk)) + h*h*OF(L, z->dq), r = q + d;          \
    L f = h*OF(L, z->dv) + (ve + h*OF(L, wk) + h_rest*OF(L, z->dv)), u = v + f;                          \
    AT(L, z->q) = r; AT(L, z->qe) = d - (r - q); AT(L, z->v) = u; AT(L, z->ve) = f - (u - v)
    LANES(n, OP);
#undef OP
}

INLINE void nystroem_begin_state(const int n, const outcome *o, nystroem_state *z)
{
    copy(n, o->q, z->q);
    copy(n, o->v, z->v);
    zero(n, z->qe);
    zero(n, z->ve);
}

INLINE void nystroem_fixed(const int n, const int compensated, const problem *p, const nystroem_rows *t,
                           long steps, watch *w, outcome *o)
{
    nystroem_state z;
    scaled s;
    double h = p->end/(double)steps, h_rest = (double)((long double)p->end/steps - h);
    nystroem_begin_state(n, o, &z);
    scale(t, h, &s);
    for (long k = 0; k < steps; ++k) {
        p->acceleration(z.q, z.k);
        stages(n, p, t, &s, &z);
        advance(n, compensated, t, h, h_rest, &z);
        if (watch_due(w)) watch_look(w, z.q, z.v);
    }
    copy(n, z.q, o->q);
    copy(n, z.v, o->v);
    o->evaluations = steps*t->stages;
    o->steps = steps;
}

/* The larger of the errors of q and v, each against the size of the whole vector.             */
INLINE double nystroem_error(const int n, const nystroem_rows *t, double h, nystroem_state *z)
{
    double eq[MOST_COORDINATES], ev[MOST_COORDINATES];
    sum(n, t->e.a, t->e.lo, t->e.hi, z->k, eq);
    sum(n, t->f.a, t->f.lo, t->f.hi, z->k, ev);
    double q = norm(n, z->q), v = norm(n, z->v), a = norm(n, z->k);
    double of_q = h*h*norm(n, eq)/(q + h*v + 1e-300), of_v = h*norm(n, ev)/(v + h*a + 1e-300);
    return of_q > of_v ? of_q : of_v;
}

/* Error per step; a controller with a little of the error before in it. Returns h_new/h.      */
static double control(double err, double *before, double tolerance, int power)
{
    double x = err/tolerance;
    if (!(x > 1e-10)) x = 1e-10;
    double factor = 0.9*pow(x, -0.85/power)*pow(*before, 0.15/power);
    if (x <= 1) *before = x;
    return factor < 0.2 ? 0.2 : factor > 4 ? 4 : factor;
}

INLINE void nystroem_adaptive(const int n, const int compensated, const problem *p, const nystroem_rows *t,
                              double tolerance, watch *w, outcome *o)
{
    nystroem_state z;
    scaled s;
    long double time = 0, end = p->end;
    nystroem_begin_state(n, o, &z);
    p->acceleration(z.q, z.k);
    o->evaluations = 1;
    double before = 1, power = t->order - 1;
    double h = 0.1*sqrt(norm(n, z.q)/(1e-300 + norm(n, z.k)))*pow(tolerance*1e6, 1/power);
    if (!(h < p->end/10)) h = p->end/10;
    for (long tries = 0; time < end; ++tries) {
        if (tries > 1000000 || !(h > 1e-12*p->end)) { o->failed = 1; return; }
        if (time + h >= end) h = (double)(end - time);
        scale(t, h, &s);
        stages(n, p, t, &s, &z);
        if (t->reuse) {
            double hb[STAGES];
            for (int j = 0; j < STAGES; ++j) hb[j] = h*h*t->b.a[j];
            combine(n, z.q, h, z.v, hb, t->b.lo, t->b.hi, z.k, z.x);
            p->acceleration(z.x, z.k + t->stages*n);
        }
        o->evaluations += t->stages - 1 + t->reuse;
        double err = nystroem_error(n, t, h, &z), factor = control(err, &before, tolerance, (int)power);
        if (!(err <= tolerance)) { h *= factor < 0.9 ? factor : 0.9; continue; }
        advance(n, compensated, t, h, 0, &z);
        time += h;
        h *= factor;
        ++o->steps;
        if (watch_due(w)) watch_look(w, z.q, z.v);
        if (t->reuse) copy(n, z.k + t->stages*n, z.k);
        else { p->acceleration(z.q, z.k); ++o->evaluations; }
    }
    copy(n, z.q, o->q);
    copy(n, z.v, o->v);
}

static void run_nystroem(const problem *p, const baseline *m, double parameter, watch *w, outcome *o)
{
    const nystroem_rows *t = nystroems + m->option;
    begin(p, o);
#define CALL(n) if (m->adaptive && m->compensated) nystroem_adaptive(n, 1, p, t, parameter, w, o);     \
                else if (m->adaptive) nystroem_adaptive(n, 0, p, t, parameter, w, o);                  \
                else if (m->compensated) nystroem_fixed(n, 1, p, t, (long)parameter, w, o);            \
                else nystroem_fixed(n, 0, p, t, (long)parameter, w, o)
    BY_SIZE(p->n, CALL);
#undef CALL
}

/* ------------------------------------------ Gauss, one point after another */

/* Collocation in the Nystroem form, as in Hairer's gni_irk2: fixed point, start extrapolated from
   the forces of the last step, compensated sums.  One point a call.                           */
enum { GAUSS_STAGES = 8 };
typedef struct gauss_rows {
    nystroem_rows second;                                   /* A^2, for q'' = a(q)            */
    double A[GAUSS_STAGES][GAUSS_STAGES], b[GAUSS_STAGES], E[GAUSS_STAGES][GAUSS_STAGES];
} gauss_rows;
static gauss_rows gausses[GAUSS_STAGES + 1];

/* a_ij = b_j sum_k (2k+1) Phi_k(c_i) P_k(1 - 2 c_j), Phi_k = integral of P_k(1 - 2x), 0 to c.
   E: the polynomial through the forces of the last step, at the nodes of this one.            */
static void gauss_begin(gauss_rows *t, int s)
{
    long double c[GAUSS_STAGES], b[GAUSS_STAGES], A[GAUSS_STAGES][GAUSS_STAGES], P[GAUSS_STAGES + 2],
                at[GAUSS_STAGES][GAUSS_STAGES + 2], row2[GAUSS_STAGES], bq[GAUSS_STAGES];
    gauss_nodes(s, c, b);
    for (int i = 0; i < s; ++i) legendre(s + 1, 1 - 2*c[i], at[i]);
    for (int i = 0; i < s; ++i)
        for (int j = 0; j < s; ++j) {
            A[i][j] = c[i];
            for (int k = 1; k < s; ++k) A[i][j] += (at[i][k-1] - at[i][k+1])/2*at[j][k];
            A[i][j] *= b[j];
            t->A[i][j] = (double)A[i][j];
            t->b[j] = (double)b[j];
            P[0] = 1;
            for (int k = 0; k < s; ++k) if (k != j) P[0] *= (1 + c[i] - c[k])/(c[j] - c[k]);
            t->E[i][j] = (double)P[0];
        }
    t->second.stages = s;
    t->second.order = 2*s;
    for (int i = 0; i < s; ++i) {
        for (int j = 0; j < s; ++j) {
            row2[j] = 0;
            for (int k = 0; k < s; ++k) row2[j] += A[i][k]*A[k][j];
        }
        make_row(t->second.A + i, s, row2);
        t->second.c[i] = (double)c[i];
        bq[i] = b[i]*(1 - c[i]);
    }
    make_row(&t->second.b, s, bq);
    make_row(&t->second.w, s, b);
    make_rest(&t->second.b_rest, s, bq);
    make_rest(&t->second.w_rest, s, b);
}

/* Done when the points change by less than stop |q|, or no longer less than before.           */
INLINE int settled(double change, double before, double stop, double scale, int round)
{
    if (change <= stop*stop*scale) return 1;
    return round > 2 && change >= before && change <= 1e-24*scale;
}

/* x_i = q + c_i v + sum A_ij k_j, k_i the right-hand side at x_i, from the k of the last step on; 0: failed */
INLINE int gauss_iterate(const int n, const int first_order, const problem *p, const gauss_rows *t, double stop, int after,
                         const double *q, const double *c, const double *v, const row *A, double *k, outcome *o)
{
    double x[GAUSS_STAGES*MOST_COORDINATES], next[MOST_COORDINATES], d[MOST_COORDINATES],
           old[GAUSS_STAGES*MOST_COORDINATES], before = HUGE_VAL, size = square(n, q);
    const int m = t->second.stages;
    if (after) {
        copy(m*n, k, old);
        for (int i = 0; i < m; ++i) sum(n, t->E[i], 1, m, old, k + i*n);
    }
    for (int round = 1; ; ++round) {
        double change = 0;
        for (int i = 0; i < m; ++i) {
            combine(n, q, c[i], v, A[i].a, 1, m, k, next);
            if (round > 1) {
#define OP(L) AT(L, d) = OF(L, next) - OF(L, x + i*n)
                LANES(n, OP);
#undef OP
                change += square(n, d);
            }
            copy(n, next, x + i*n);
        }
        o->iterations += round > 1;
        if (round > 1 && settled(change, before, stop, size, round)) return 1;
        if (round > 60 || !(change <= 1e6*size)) return 0;
        if (round > 1) before = change;
        for (int i = 0; i < m; ++i) {
            if (first_order) p->slope(x + i*n, k + i*n);
            else p->acceleration(x + i*n, k + i*n);
        }
    }
}

INLINE void gauss_second(const int n, const problem *p, const gauss_rows *t, double stop,
                         long steps, watch *w, outcome *o)
{
    nystroem_state z;
    scaled s;
    const int m = t->second.stages;
    double h = p->end/(double)steps, h_rest = (double)((long double)p->end/steps - h);
    nystroem_begin_state(n, o, &z);
    scale(&t->second, h, &s);
    p->acceleration(z.q, z.k);
    for (int i = 1; i < m; ++i) copy(n, z.k, z.k + i*n);
    for (long k = 0; k < steps; ++k) {
        if (!gauss_iterate(n, 0, p, t, stop, k > 0, z.q, s.c, z.v, s.A, z.k, o)) { o->failed = 1; return; }
        advance(n, 1, &t->second, h, h_rest, &z);
        if (watch_due(w)) watch_look(w, z.q, z.v);
    }
    copy(n, z.q, o->q);
    copy(n, z.v, o->v);
    o->steps = steps;
    o->evaluations = o->iterations*m;
}

/* The same for y' = f(y), y = (q, p).                                                         */
enum { MOST_SLOPES = 8 };
INLINE void gauss_first(const int n, const problem *p, const gauss_rows *t, double stop, long steps, watch *w, outcome *o)
{
    const int m = t->second.stages;
    double y[MOST_SLOPES], rest[MOST_SLOPES] = { 0 }, d[MOST_SLOPES], k[GAUSS_STAGES*MOST_SLOPES], zeros[MOST_SLOPES] = { 0 };
    const double h = p->end/(double)steps;
    row hA[GAUSS_STAGES];
    for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j) hA[i].a[j] = h*t->A[i][j];
    get_state(n, o, y);
    p->slope(y, k);
    for (int i = 1; i < m; ++i) copy(n, k, k + i*n);
    for (long step = 0; step < steps; ++step) {
        if (!gauss_iterate(n, 1, p, t, stop, step > 0, y, zeros, zeros, hA, k, o)) { o->failed = 1; return; }
        sum(n, t->b, 1, m, k, d);
        add_compensated(n, h, d, y, rest);
        if (watch_due(w)) watch_look(w, y, y + n/2);
    }
    put_state(n, y, o);
    o->steps = steps;
    o->evaluations = o->iterations*m;
}

static void run_gauss(const problem *p, const baseline *m, double parameter, watch *w, outcome *o)
{
    const gauss_rows *t = gausses + m->option;
    begin(p, o);
    if (p->slope) {
#define CALL(n) gauss_first(n, p, t, m->stop, (long)parameter, w, o)
        switch (p->n) { case 2: CALL(4); return; case 3: CALL(6); return; default: o->failed = 1; return; }
#undef CALL
    }
#define CALL(n) gauss_second(n, p, t, m->stop, (long)parameter, w, o)
    BY_SIZE(p->n, CALL);
#undef CALL
}

/* ------------------------------------------- Runge-Kutta for y' = f(y) */

enum { CLASSICAL, DOP853, RUNGE_KUTTAS };
typedef struct runge_kutta_rows { int stages, order; row A[12], b, e, f; } runge_kutta_rows;
static runge_kutta_rows runge_kuttas[RUNGE_KUTTAS];

static void runge_kutta_begin(runge_kutta_rows *t, const runge_kutta *s)
{
    long double f[12];
    t->stages = s->stages;
    t->order = s->order;
    for (int i = 0; i < s->stages; ++i) {
        make_row(t->A + i, i, s->A[i]);
        f[i] = s->b[i] - s->third[i];
    }
    make_row(&t->b, s->stages, s->b);
    make_row(&t->e, s->stages, s->e);
    make_row(&t->f, s->stages, f);
}

enum { BOTH = 2*MOST_COORDINATES };

INLINE void runge_kutta_stages(const int n, const problem *p, const runge_kutta_rows *t, const row *hA,
                               const double *y, double *k)
{
    double x[2*MOST_COORDINATES];
    for (int i = 1; i < t->stages; ++i) {
        combine(n, y, 0, y, hA[i].a, hA[i].lo, hA[i].hi, k, x);
        slope_at(n, p, x, k + i*n);
    }
}

INLINE void runge_kutta_fixed(const int n, const problem *p, const runge_kutta_rows *t, int compensated, long steps,
                              watch *w, outcome *o)
{
    double y[BOTH], rest[BOTH] = { 0 }, k[12*BOTH], d[BOTH], h = p->end/(double)steps;
    row hA[12];
    get_state(n, o, y);
    for (int i = 0; i < t->stages; ++i) scale_row(t->A + i, h, hA + i);
    for (long step = 0; step < steps; ++step) {
        slope_at(n, p, y, k);
        runge_kutta_stages(n, p, t, hA, y, k);
        sum(n, t->b.a, t->b.lo, t->b.hi, k, d);
        if (compensated) add_compensated(n, h, d, y, rest);
        else add(n, h, d, y);
        if (watch_due(w)) watch_look(w, y, y + n/2);
    }
    put_state(n, y, o);
    o->steps = steps;
    o->evaluations = steps*t->stages;
}

/* As in DOP853: the estimate of order 5, damped where that of order 3 is larger.              */
INLINE void runge_kutta_adaptive(const int n, const problem *p, const runge_kutta_rows *t, int compensated,
                                 double tolerance, watch *w, outcome *o)
{
    double y[BOTH], rest[BOTH] = { 0 }, k[12*BOTH], d[BOTH], e[BOTH], f[BOTH], before = 1, h = 0.01*p->end;
    long double time = 0, end = p->end;
    row hA[12];
    get_state(n, o, y);
    slope_at(n, p, y, k);
    for (long tries = 0; time < end; ++tries) {
        if (tries > 1000000 || !(h > 1e-12*p->end)) { o->failed = 1; return; }
        if (time + h >= end) h = (double)(end - time);
        for (int i = 0; i < t->stages; ++i) scale_row(t->A + i, h, hA + i);
        runge_kutta_stages(n, p, t, hA, y, k);
        o->evaluations += t->stages;
        sum(n, t->b.a, t->b.lo, t->b.hi, k, d);
        sum(n, t->e.a, t->e.lo, t->e.hi, k, e);
        sum(n, t->f.a, t->f.lo, t->f.hi, k, f);
        double e2 = square(n, e), f2 = square(n, f), err = h*e2/(1e-300 + sqrt(e2 + 0.01*f2)*norm(n, y));
        double factor = control(err, &before, tolerance, 8);
        if (!(err <= tolerance)) { h *= factor < 0.9 ? factor : 0.9; continue; }
        if (compensated) add_compensated(n, h, d, y, rest);
        else add(n, h, d, y);
        time += h;
        h *= factor;
        ++o->steps;
        slope_at(n, p, y, k);
        if (watch_due(w)) watch_look(w, y, y + n/2);
    }
    put_state(n, y, o);
}

static void run_runge_kutta(const problem *p, const baseline *m, double parameter, watch *w, outcome *o)
{
    const runge_kutta_rows *t = runge_kuttas + m->option;
    begin(p, o);
#define CALL(n) do { if (m->adaptive) runge_kutta_adaptive(n, p, t, m->compensated, parameter, w, o);  \
                     else runge_kutta_fixed(n, p, t, m->compensated, (long)parameter, w, o); } while (0)
    BY_STATE(p->n, CALL);
#undef CALL
}

/* ------------------------------------------------ Gauss-Radau, order 15 */

/* q'' = a(q, v) at Radau's eight points of a step, the first at its start [Everhart: An efficient integrator that
   uses Gauss-Radau spacings, 1985]: a = a_0 + sum g_k c (c - c_1)...(c - c_k), each g_k from the newest values as soon
   as its point is evaluated.  In powers, a = a_0 + sum b_k c^(k+1), it is continued into the next step, and what the
   last prediction missed is added.  Two controls, each as published:
     Everhart        two iterations (six in the first step); h^2 |b_6|/72, the last term of q, follows the tolerance;
                     a step grows by 1.4 at most, and none but the first is done again
     Rein, Spiegel   (IAS15, 2015) iterations until b_6 changes by no more than 1e-16 |a|; |b_6|/|a| follows the
                     tolerance; a step that should be a quarter of its length is done again; sums are compensated */
enum { RADAU = 8 };
typedef struct radau_rows {
    double c[RADAU];
    double q[RADAU][RADAU], v[RADAU][RADAU];         /* of a_0, g_0, ...: integrals to c_i; row 0: to 1 */
    double d[RADAU][RADAU];                          /* g_(i-1) of a_i - a_0, g_0, ...                  */
    double C[RADAU][RADAU], D[RADAU][RADAU];         /* b_m = sum C_mk g_k, and its inverse             */
    double shift[RADAU][RADAU];                      /* binomials (m+1, k+1)                            */
} radau_rows;
static radau_rows radau;

static void radau_begin(radau_rows *t)
{
    /* zeros of P_7(u) + P_8(u), u = 2c - 1, from four digits by Newton's method */
    long double c[RADAU] = { 0, 0.0563L, 0.1802L, 0.3526L, 0.5472L, 0.7342L, 0.8853L, 0.9775L };
    for (int i = 1; i < RADAU; ++i)
        for (int k = 0; k < 6; ++k) {
            long double P[RADAU + 2], u = 2*c[i] - 1;
            legendre(RADAU, u, P);
            const long double slope = (7*(P[6] - u*P[7]) + 8*(P[7] - u*P[8]))/(1 - u*u);
            c[i] -= (P[7] + P[8])/slope/2;
        }
    long double C[RADAU][RADAU] = { { 1 } }, D[RADAU][RADAU] = { { 0 } };            /* C[k][m] of c^(m+1) */
    for (int k = 1; k < RADAU - 1; ++k)
        for (int m = 0; m <= k; ++m) C[k][m] = (m > 0 ? C[k-1][m-1] : 0) - c[k]*C[k-1][m];
    for (int k = 0; k < RADAU - 1; ++k) {
        D[k][k] = 1;
        for (int m = k - 1; m >= 0; --m)
            for (int j = m + 1; j <= k; ++j) D[m][k] -= C[j][m]*D[j][k];
    }
    for (int i = 0; i < RADAU; ++i) {
        const long double x = i > 0 ? c[i] : 1;
        long double newton = x;
        t->c[i] = (double)c[i];
        t->v[i][0] = (double)x;
        t->q[i][0] = (double)(x*x/2);
        for (int k = 0; k < RADAU - 1; ++k) {
            long double v = 0, q = 0;
            for (int m = 0; m <= k; ++m) {
                v += C[k][m]*powl(x, m + 2)/(m + 2);
                q += C[k][m]*powl(x, m + 3)/((m + 2)*(m + 3));
                t->C[m][k] = (double)C[k][m];
                t->D[m][k] = (double)D[m][k];
            }
            t->v[i][k+1] = (double)v;
            t->q[i][k+1] = (double)q;
        }
        for (int k = 1; k < i; ++k) newton *= x - c[k];
        const long double over = 1/newton;
        t->d[i][0] = (double)over;
        for (int k = i - 1; k > 0; --k) {
            newton /= x - c[k];
            t->d[i][k] = (double)(-newton*over);
        }
    }
    for (int m = 0; m < RADAU - 1; ++m) {
        t->shift[0][m] = m + 1;
        for (int k = 1; k <= m; ++k) t->shift[k][m] = t->shift[k-1][m]*(m + 1 - k)/(k + 1);
    }
}

INLINE void force_at(const int turning, const problem *p, const double *q, const double *v, double *a)
{
    if (turning) p->law(q, v, a);
    else p->acceleration(q, a);
}

/* One iteration: k = (a_0, g_0, ..., g_6); the newest g last, which the others wait for        */
INLINE void radau_iterate(const int n, const int turning, const problem *p, const double *q, const double *v, double h,
                          double *k, double *a)
{
    const radau_rows *t = &radau;
    double x[MOST_COORDINATES], u[MOST_COORDINATES];
    UNROLL7 for (int i = 1; i < RADAU; ++i) {
        const double *r = t->q[i], *s = t->v[i], *d = t->d[i], hc = h*t->c[i], h2 = h*h;
#define OP(L) L z = r[0]*OF(L, k);                                              \
        UNROLL7 for (int j = RADAU - 1; j >= i; --j) z += r[j]*OF(L, k + j*n);  \
        UNROLL7 for (int j = 1; j < i; ++j) z += r[j]*OF(L, k + j*n);           \
        AT(L, x) = (OF(L, q) + hc*OF(L, v)) + h2*z
        LANES(n, OP);
#undef OP
#define OP(L) L z = s[0]*OF(L, k);                                              \
        UNROLL7 for (int j = RADAU - 1; j >= i; --j) z += s[j]*OF(L, k + j*n);  \
        UNROLL7 for (int j = 1; j < i; ++j) z += s[j]*OF(L, k + j*n);           \
        AT(L, u) = OF(L, v) + h*z
        if (turning) LANES(n, OP);
#undef OP
        force_at(turning, p, x, u, a);
#define OP(L) L z = -d[0]*OF(L, k);                                             \
        UNROLL7 for (int j = 1; j < i; ++j) z += d[j]*OF(L, k + j*n);           \
        AT(L, k + i*n) = z + d[0]*OF(L, a)
        LANES(n, OP);
#undef OP
    }
}

/* y_m = sum T_mk x_k over k from m on (in powers) or all                                       */
INLINE void radau_change(const int n, double (*T)[RADAU], const double *x, double *y)
{
    UNROLL7 for (int m = 0; m < RADAU - 1; ++m) {
#define OP(L) L z = T[m][m]*OF(L, x + m*n);                                     \
        UNROLL7 for (int k = m + 1; k < RADAU - 1; ++k) z += T[m][k]*OF(L, x + k*n); \
        AT(L, y + m*n) = z
        LANES(n, OP);
#undef OP
    }
}

/* What the b of the last step make of those of a step ratio times as long                      */
INLINE void radau_predict(const int n, double ratio, const double *b, double *next)
{
    double power = ratio;
    radau_change(n, radau.shift, b, next);
    for (int m = 0; m < RADAU - 1; ++m, power *= ratio) {
#define OP(L) AT(L, next + m*n) = power*OF(L, next + m*n)
        LANES(n, OP);
#undef OP
    }
}

/* Returns how many iterations it took.                                                         */
INLINE int radau_solve(const int n, const int turning, const int most, const problem *p, const double *q,
                       const double *v, double h, double *k, double *a)
{
    double before = HUGE_VAL, old[MOST_COORDINATES];
    for (int round = 1; ; ++round) {
        double *g6 = k + (RADAU - 1)*n;
        copy(n, g6, old);
        radau_iterate(n, turning, p, q, v, h, k, a);
        if (round >= (most > 0 ? most : 12)) return round;
        if (most > 0) continue;
        add(n, -1, g6, old);
        const double change = square(n, old)/square(n, a);
        if (change < 1e-32 || (round > 2 && change >= before)) return round;
        before = change;
    }
}

INLINE void radau_loop(const int n, const int turning, int everhart, int compensated, const problem *p, double tolerance, watch *w, outcome *o)
{
    double q[MOST_COORDINATES], v[MOST_COORDINATES], qe[MOST_COORDINATES], ve[MOST_COORDINATES], a[MOST_COORDINATES];
    double k[RADAU*MOST_COORDINATES], b[RADAU*MOST_COORDINATES], predicted[RADAU*MOST_COORDINATES],
           missed[RADAU*MOST_COORDINATES], start[RADAU*MOST_COORDINATES], both[BOTH], slope[BOTH];
    long double time = 0, end = p->end;
    copy(n, o->q, q);
    copy(n, o->v, v);
    if (turning) {
        get_state(2*p->n, o, both);
        p->slope(both, slope);
        memcpy(v, slope, sizeof *v*(size_t)p->n);
    }
    zero(n, qe);
    zero(n, ve);
    zero(n, a);
    zero(n, k);
    zero(7*n, b);
    zero(7*n, predicted);
    zero(7*n, missed);
    force_at(turning, p, q, v, k);
    o->evaluations = 1;
    double h = 0.1*sqrt(norm(n, q)/(1e-300 + norm(n, k)));
    if (!(h < p->end/10)) h = p->end/10;
    double before = h;
    for (long tries = 0; time < end; ++tries) {
        if (tries > 1000000 || !(h > 1e-12*p->end)) { o->failed = 1; return; }
        const int last = time + h >= end;
        if (last) h = (double)(end - time);
        if (o->steps > 0) radau_predict(n, h/before, b, predicted);
        copy(7*n, predicted, start);
        add(7*n, 1, missed, start);
        radau_change(n, radau.D, start, k + n);
        const int rounds = radau_solve(n, turning, everhart ? (o->steps > 0 ? 2 : 6) : 0, p, q, v, h, k, a);
        o->iterations += rounds;
        o->evaluations += 7*rounds;
        const double b6 = norm(n, k + (RADAU - 1)*n) + 1e-300;
        double factor = everhart ? pow(tolerance/(h*h*b6/72), 1.0/9) : pow(tolerance*norm(n, a)/b6, 1.0/7);
        const int again = everhart ? o->steps == 0 && factor < 1 : factor < 0.25 && !last;
        if (!(factor > 0.01)) factor = 0.01;
        if (again) { h *= everhart ? 0.8*factor : factor; continue; }
        double dq[MOST_COORDINATES], dv[MOST_COORDINATES];
        sum(n, radau.q[0], 1, RADAU, k, dq);
        sum(n, radau.v[0], 1, RADAU, k, dv);
        if (compensated) {
#define OP(L) L f = h*OF(L, v) + (h*h*OF(L, dq) + h*OF(L, ve) + OF(L, qe)), y = OF(L, q), z = y + f; \
            AT(L, q) = z; AT(L, qe) = f - (z - y)
            LANES(n, OP);
#undef OP
            add_compensated(n, h, dv, v, ve);
        } else {
#define OP(L) AT(L, q) += h*(OF(L, v) + h*OF(L, dq)); AT(L, v) += h*OF(L, dv)
            LANES(n, OP);
#undef OP
        }
        time += h;
        ++o->steps;
        radau_change(n, radau.C, k + n, b);
        copy(7*n, b, missed);
        add(7*n, -1, predicted, missed);
        before = h;
        h *= fmin(factor, everhart ? 1.4 : 4);
        force_at(turning, p, q, v, k);
        ++o->evaluations;
        memcpy(o->q, q, sizeof *q*(size_t)p->n);
        memcpy(o->v, v, sizeof *v*(size_t)p->n);
        if (p->momentum) p->momentum(q, v, o->v);
        if (watch_due(w)) watch_look(w, o->q, o->v);
    }
}

static void run_radau(const problem *p, const baseline *m, double tolerance, watch *w, outcome *o)
{
    const int turning = p->law != NULL;
    begin(p, o);
#define CALL(n) if (turning) radau_loop(n, 1, m->option, m->compensated, p, tolerance, w, o);  \
                else radau_loop(n, 0, m->option, m->compensated, p, tolerance, w, o)
    BY_SIZE(p->n == 3 ? 4 : p->n, CALL);
#undef CALL
}

/* ------------------------------------------------------------- the list */

/* Of the Gauss methods gni_irk2 has 4 and 6 stages (and 2), with a stop that the caller may loosen;
   8 is there to show what gvi.h gains by asking for all points at once.                       */
#define SPLIT(label, kind, of, work)                                                                     \
    { .name = label, .family = kind, .structure = 1, .cost = work, .run = run_splitting, .option = of }, \
    { .name = label " c", .family = kind, .structure = 1, .cost = work, .run = run_splitting, .option = of, \
      .compensated = 1 }
#define PAIR(label, of, work)                                                                            \
    { .name = label " fixed", .family = label, .cost = work, .run = run_nystroem, .option = of },        \
    { .name = label " fixed c", .family = label, .cost = work, .run = run_nystroem, .option = of,        \
      .compensated = 1 },                                                                                \
    { .name = label, .family = label, .adaptive = 1, .cost = work, .run = run_nystroem, .option = of },  \
    { .name = label " c", .family = label, .adaptive = 1, .cost = work, .run = run_nystroem, .option = of, \
      .compensated = 1 }
#define GAUSS(stages, label, first, end) {                                                               \
      .name = "Gauss " #stages label, .family = "Gauss, one point a call", .structure = 1,               \
      .reference = stages > 6, .first_order = first, .cost = 4*stages, .run = run_gauss,                 \
      .option = stages, .stop = end }
#define GAUSSES(stages, first)                                                                           \
    GAUSS(stages, "", first, 1e-18), GAUSS(stages, " 1e-17", first, 1e-17),                              \
    GAUSS(stages, " 1e-16", first, 1e-16), GAUSS(stages, " 1e-15", first, 1e-15),                        \
    GAUSS(stages, " 1e-14", first, 1e-14), GAUSS(stages, " 1e-13", first, 1e-13),                        \
    GAUSS(stages, " 1e-12", first, 1e-12), GAUSS(stages, " 1e-11", first, 1e-11),                        \
    GAUSS(stages, " 1e-10", first, 1e-10), GAUSS(stages, " 1e-9", first, 1e-9),                          \
    GAUSS(stages, " 1e-8", first, 1e-8), GAUSS(stages, " 1e-7", first, 1e-7),                            \
    GAUSS(stages, " 1e-6", first, 1e-6)

const baseline baselines[] = {
    { .name = "Stoermer-Verlet", .family = "Stoermer-Verlet", .structure = 1, .cost = 1, .run = run_splitting,
      .option = VERLET },
    { .name = "RK4", .family = "RK4", .cost = 4, .run = run_runge_kutta, .option = CLASSICAL },
    SPLIT("Yoshida 8", "compositions 8, 10", YOSHIDA8, 15),
    SPLIT("Kahan-Li 8", "compositions 8, 10", KAHAN_LI8, 17),
    SPLIT("Sofroniou-Spaletta 10", "compositions 8, 10", SOFRONIOU10, 35),
    SPLIT("Blanes-Moan SRKN11", "Blanes-Moan SRKN", BLANES_MOAN11, 11),
    { .name = "Blanes-Moan SRKN14", .family = "Blanes-Moan SRKN", .structure = 1, .cost = 14,
      .run = run_splitting, .option = BLANES_MOAN14 },
    { .name = "Splitting 8", .family = "splitting 8 by hand", .structure = 1, .reference = 1, .cost = 22,
      .run = run_splitting, .option = SPLITTING8 },
    PAIR("RKN8(6)", RKN86, 8),
    PAIR("RKN12(10)", RKN1210, 17),
    GAUSSES(4, 0), GAUSSES(6, 0), GAUSSES(8, 0),
    { .name = "RK4", .family = "RK4", .first_order = 1, .cost = 4, .run = run_runge_kutta,
      .option = CLASSICAL },
    { .name = "DOP853 fixed", .family = "DOP853", .first_order = 1, .cost = 12, .run = run_runge_kutta,
      .option = DOP853 },
    { .name = "DOP853 fixed c", .family = "DOP853", .first_order = 1, .cost = 12, .run = run_runge_kutta,
      .option = DOP853, .compensated = 1 },
    { .name = "DOP853", .family = "DOP853", .first_order = 1, .adaptive = 1, .run = run_runge_kutta,
      .option = DOP853 },
    { .name = "DOP853 c", .family = "DOP853", .first_order = 1, .adaptive = 1, .run = run_runge_kutta,
      .option = DOP853, .compensated = 1 },
    { .name = "Gauss-Radau 15", .family = "Gauss-Radau 15", .adaptive = 1, .run = run_radau, .compensated = 1 },
    { .name = "Gauss-Radau 15 Everhart", .family = "Gauss-Radau 15", .adaptive = 1, .run = run_radau, .option = 1 },
    { .name = "Gauss-Radau 15 Everhart c", .family = "Gauss-Radau 15", .adaptive = 1, .run = run_radau, .option = 1,
      .compensated = 1 },
    GAUSSES(4, 1), GAUSSES(6, 1), GAUSSES(8, 1),
};
const int baseline_count = COUNT(baselines);

const baseline *baseline_named(const char *name)
{
    for (int i = 0; i < baseline_count; ++i)
        if (!strcmp(baselines[i].name, name)) return baselines + i;
    return NULL;
}

int baseline_kicks(const baseline *b, double *nodes, double *weights)
{
    return b->run == run_splitting ? splitting_kicks(splittings + b->option, nodes, weights) : 0;
}

void baselines_begin(void)
{
    splittings_begin();
    nystroem_begin(nystroems + RKN86, &rkn86_table);
    nystroem_begin(nystroems + RKN1210, &rkn1210_table);
    for (int s = 2; s <= GAUSS_STAGES; ++s) gauss_begin(gausses + s, s);
    runge_kutta_begin(runge_kuttas + CLASSICAL, &classical_table);
    runge_kutta_begin(runge_kuttas + DOP853, &dop853_table);
    radau_begin(&radau);
}
