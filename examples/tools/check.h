/* check.h - are the derivatives that you wrote those of the function that you wrote?

     check_finding list[20];
     check_report report = { .list = list, .room = 20 };
     char line[300];
     if (check_scene(&desc, t, q, v, &report) < 0) puts("gvi_init refuses it");
     for (int i = 0; i < report.count && i < 20; ++i)
         puts(check_line(&list[i], line, sizeof line));

   prints nothing if all is well, and otherwise each entry that is wrong:

     effect 0: f[1] is 1.15, but -dV/dq[1] is -1.15 (at the state given): wrong sign?

   Looked at, for every effect and the mass, at the state given and at three near
   it (always the same ones):

     f             against differences of value: -dV/dq, dL/dq, of a clock dg/dq;
                   a potential without value: is there one whose gradient f is?
     dldv          against differences of L in v
     fq, fv, pv    the Hessian callback against differences of f and dldv
     gradient      of the mass against differences of v'M(q)v/2
     velocity      of the mass: does it undo p = M v + sum of dL/dv?
     jacobian, rate  of a constraint against differences of g in q and t
     mass          symmetric where both triangles are there; definite
     all           added to, not overwritten; many points as one at a time; nothing
                   written beyond the rows; f and value in one call where one function
                   gives both; a potential asks for no velocity

   Derivatives by central differences at 24 widths, each half the one before, and
   Richardson extrapolation; the entry of that table is taken where neighbours
   agree best, and how well they agree is its error.  Widths begin at an eighth of
   the size of the coordinate, |q_i|, but no less than 1/1000 of the largest; where
   all are 0 that is 1, unless report.size_q or .size_v says more.  An entry is
   wrong when it is off by more than 20 such errors and 1e-9 of itself.

   Works on gvi_real, best on double: float leaves few digits to differences.  Takes
   its memory, some n*n numbers, from malloc.                                  */
#ifndef CHECK_H
#define CHECK_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "gvi.h"
#include <stdio.h>                    /* snprintf, for check_line alone        */
#include <stdlib.h>
#include <string.h>
#include <math.h>
#ifndef __cplusplus
#include <tgmath.h>
#undef I                              /* <complex.h> comes with it; I is a user's name */
#endif

typedef enum check_what {
    CHECK_DERIVATIVE, /* entry [i] or [i][j] is not the derivative             */
    CHECK_CURL,       /* potential without value: df_i/dq_j is not df_j/dq_i   */
    CHECK_VELOCITY,   /* mass.velocity gives another v than p was made from    */
    CHECK_SYMMETRY,   /* M_ij is not M_ji                                      */
    CHECK_DEFINITE,   /* M is not definite: pivot i                            */
    CHECK_ADDS,       /* overwrites what others have added                     */
    CHECK_BATCH,      /* many points at once are not as one at a time          */
    CHECK_BOTH,       /* f and value in one call are not as in two             */
    CHECK_BEYOND,     /* writes where it has no points                         */
    CHECK_READS_V,    /* potential or clock that depends on v                  */
    CHECK_POSITIVE,   /* a clock's g is not above 0                            */
    CHECK_REFUSED,    /* refuses, or gives NaN or Inf                          */
    CHECK_STATE       /* t, q or v itself is not finite: nothing else is looked at */
} check_what;

typedef enum check_hint {
    CHECK_NO_HINT, CHECK_SIGN, CHECK_MISSING, CHECK_SURPLUS, CHECK_TWICE, CHECK_HALF, CHECK_TRANSPOSED
} check_hint;

typedef struct check_finding {
    check_what  what;
    check_hint  hint;
    int         effect;               /* index, GVI_FAULT_MASS; NONE: the state */
    const char *entry;                /* "f", "dldv", "fq", "mass", ...        */
    const char *against;              /* "-dV/dq", ...; "" if nothing          */
    int         i, j;                 /* coordinates; -1 where there is none   */
    int         point;                /* 0: the state given, 1.. near it       */
    gvi_real    found, right, bound;  /* of |found - right|                    */
} check_finding;

typedef struct check_report {
    check_finding *list;              /* in: where findings go; NULL if room 0 */
    int            room;
    const gvi_real *size_q, *size_v;  /* in: [n] or NULL, see above            */
    int            count;             /* findings, also those without room     */
    long           checked;           /* entries compared                      */
    int            unchecked;         /* derivatives with nothing to compare   */
    long           zero;              /* of those: nothing but rounding        */
    gvi_real       worst;             /* bound over size of the others, largest:
                                         a smaller error would not be seen     */
} check_report;

enum { CHECK_POINTS = 4, CHECK_LEVELS = 24, CHECK_DEPTH = 6, CHECK_STRIDE = 8, CHECK_GUARD = 8 };

struct check_run {
    const gvi_desc *desc;
    check_report   *report;
    int             n, effect, point, reads_v;
    int             row;              /* 1 + that of a constraint; 0: none     */
    gvi_real        eps, tolerance, t, times[CHECK_POINTS];
    gvi_real       *q, *v;            /* [n] the state looked at               */
    gvi_real       *qs, *vs;          /* [POINTS][n]                           */
    gvi_real       *size;             /* [2n] of q, of v                       */
    gvi_real       *one, *two;        /* [n] scratch                           */
    gvi_real       *plus, *minus;     /* [n]                                   */
    gvi_real       *tableau;          /* [2][DEPTH][n]                         */
    gvi_real       *grain;            /* [n] rounding of outputs               */
    gvi_real       *best, *err;       /* [n] or [n*n] derivatives              */
    gvi_real       *found;            /* [3][n*n] Hessians                     */
    gvi_real       *guarded[3];       /* [n*n or n][STRIDE] and guards: outputs */
    gvi_real       *many;             /* [2n][STRIDE] inputs                   */
};

/* ------------------------------------------------------------------ findings */

static inline check_hint check_guess(gvi_real found, gvi_real right)
{
    const gvi_real size = fabs(found) + fabs(right), near = size/100000;
    if (fabs(found) <= near) return CHECK_MISSING;
    if (fabs(right) <= near) return CHECK_SURPLUS;
    if (fabs(found + right) <= near) return CHECK_SIGN;
    if (fabs(found - 2*right) <= near) return CHECK_TWICE;
    return fabs(2*found - right) <= near ? CHECK_HALF : CHECK_NO_HINT;
}

/* The same entry at another point is not a finding of its own.                */
static inline void check_add(struct check_run *c, check_finding f)
{
    check_report *r = c->report;
    f.effect = c->effect;
    f.point = c->point;
    for (int k = 0; k < r->count && k < r->room; ++k) {
        const check_finding *g = &r->list[k];
        const int same = g->what == f.what && g->effect == f.effect && g->i == f.i && g->j == f.j;
        if (same && !strcmp(g->entry, f.entry)) return;
    }
    if (r->count++ < r->room) r->list[r->count - 1] = f;
}

static inline void check_note(struct check_run *c, check_what what, const char *entry, int i, int j)
{
    check_add(c, (check_finding){ .what = what, .entry = entry, .against = "", .i = i, .j = j });
}

/* Is `found`, whose neighbours are of that size, off by more than err and rounding allow? */
static inline int check_compare(struct check_run *c, check_finding f, gvi_real err, gvi_real size)
{
    const gvi_real large = fmax(fabs(f.found), fabs(f.right));
    f.bound = 20*err + c->tolerance*large + 64*c->eps*size;
    ++c->report->checked;
    if (!isfinite(err)) {                                     // no two differences were to be had
        f.what = CHECK_REFUSED;
        f.entry = f.against;
        f.against = "";
        check_add(c, f);
        return 0;
    }
    size = fmax(size, large);
    if (fabs(f.found - f.right) <= f.bound) {
        if (f.bound >= size) ++c->report->zero;
        else c->report->worst = fmax(c->report->worst, f.bound/size);
        return 1;
    }
    if (f.hint == CHECK_NO_HINT) f.hint = check_guess(f.found, f.right);
    check_add(c, f);
    return 0;
}

/* -------------------------------------------------------- asking at one point */

/* Outputs that are not NULL are cleared first.  v goes to those who may read it. */
static inline int check_ask(struct check_run *c, const gvi_effect *e, int value_fn, gvi_real *f,
                            gvi_real *dldv, gvi_real *value)
{
    const int sees_v = e->kind == GVI_FORCE || e->kind == GVI_LAGRANGIAN || c->reads_v;
    gvi_real room[1 + CHECK_GUARD] = { 0 };
    const gvi_points x = { .n = c->n, .count = 1, .stride = 1, .t = &c->t, .q = c->q,
                           .v = sees_v ? c->v : NULL, .f = f, .dldv = dldv, .value = value ? room : NULL };
    int refused;
    if (f) memset(f, 0, (size_t)c->n*sizeof *f);
    if (dldv) memset(dldv, 0, (size_t)c->n*sizeof *dldv);
    if (value_fn) refused = e->value(&x, e->user);
    else refused = e->points ? e->points(&x, e->user) : e->point(c->t, x.q, x.v, f, dldv, e->user);
    if (value) *value = room[0];
    return refused;
}

/* What is differentiated: m outputs at the state (q, v) as it is.             */
typedef int check_fn(struct check_run *c, gvi_real *out);

static inline const gvi_effect *check_effect(const struct check_run *c)
{
    return c->desc->effects + c->effect;
}

static inline int check_f(struct check_run *c, gvi_real *out)
{
    gvi_real g;
    const gvi_effect *e = check_effect(c);
    gvi_real *dldv = e->kind == GVI_LAGRANGIAN ? c->two : NULL;
    return check_ask(c, e, 0, out, dldv, e->kind == GVI_CLOCK ? &g : NULL);
}

static inline int check_dldv(struct check_run *c, gvi_real *out)
{
    return check_ask(c, check_effect(c), 0, c->two, out, NULL);
}

static inline int check_value(struct check_run *c, gvi_real *out)
{
    const gvi_effect *e = check_effect(c);
    if (e->kind == GVI_CLOCK) return check_ask(c, e, 0, c->two, NULL, out);
    return check_ask(c, e, 1, NULL, NULL, out);
}

static inline int check_finite(int m, const gvi_real *x)
{
    for (int k = 0; k < m; ++k)
        if (!isfinite(x[k])) return 0;
    return 1;
}

/* ---------------------------------------------------------------- differences */

static inline gvi_real check_largest(int n, const gvi_real *x)
{
    gvi_real largest = 0;
    for (int i = 0; i < n; ++i) largest = fmax(largest, fabs(x[i]));
    return largest;
}

/* One more row of output k's table: of its entries, which agree best?  Each of the
   two outputs is taken to be rounded by an eps of itself and by its grain.    */
static inline void check_extrapolate(struct check_run *c, int k, int depth, gvi_real width,
                                     gvi_real *best, gvi_real *err)
{
    const gvi_real up = c->plus[k], down = c->minus[k], slope = (up - down)/width;
    const gvi_real noise = 2*(c->eps*(fabs(up) + fabs(down)) + c->grain[k])/width;
    gvi_real *old = c->tableau + k*2*CHECK_DEPTH, *now = old + CHECK_DEPTH, power = 1;
    now[0] = slope;
    for (int j = 1; j <= depth && j < CHECK_DEPTH; ++j) {
        power *= 4;
        now[j] = now[j-1] + (now[j-1] - old[j-1])/(power - 1);
        const gvi_real a = fabs(now[j] - now[j-1]), b = fabs(now[j] - old[j-1]), e = (a > b ? a : b) + noise;
        if (e < *err) *err = e, *best = now[j];
    }
    memcpy(old, now, CHECK_DEPTH*sizeof *old);
}

/* best[k*step] = d out[k]/d x, x being one of c->q and c->v, k < m.            */
static inline void check_differentiate(struct check_run *c, check_fn *f, int m, gvi_real *x, gvi_real size,
                                       int step, gvi_real *best, gvi_real *err)
{
    const gvi_real at = *x;
    int depth = 0;
    for (int k = 0; k < m; ++k) best[k*step] = 0, err[k*step] = (gvi_real)HUGE_VAL;
    for (int level = 0; level < CHECK_LEVELS; ++level) {
        const gvi_real h = ldexp(size, -3 - level);
        const volatile gvi_real above = at + h, below = at - h;
        const gvi_real width = above - below;
        int refused;
        *x = above;
        refused = f(c, c->plus);
        *x = below;
        refused |= f(c, c->minus);
        if (refused || !(width > 0) || !check_finite(m, c->plus) || !check_finite(m, c->minus)) {
            depth = 0;                                        // too far: begin again
            continue;
        }
        for (int k = 0; k < m; ++k)
            check_extrapolate(c, k, depth, width, best + k*step, err + k*step);
        ++depth;
    }
    *x = at;
}

/* found[i] against sign times the derivatives of a number by x, c->q or c->v. */
static inline int check_gradient(struct check_run *c, check_fn *f, gvi_real *x, const gvi_real *size,
                                 int sign, const gvi_real *found, const char *entry, const char *against)
{
    gvi_real largest = 0;
    int well = 1;
    for (int i = 0; i < c->n; ++i) largest = fmax(largest, fabs(found[i])*size[i]);
    c->grain[0] = c->eps*check_largest(c->n, found)*check_largest(c->n, x);
    for (int i = 0; i < c->n; ++i) {
        gvi_real best, err;
        check_differentiate(c, f, 1, x + i, size[i], 1, &best, &err);
        check_finding y = { .what = CHECK_DERIVATIVE, .entry = entry, .against = against,
                            .i = c->row ? c->row - 1 : i, .j = c->row ? i : -1,
                            .found = found[i], .right = (gvi_real)sign*best };
        well &= check_compare(c, y, err, largest/size[i]);
    }
    return well;
}

/* c->best, c->err[i*n+j]: d out[i]/d x[j], which is about as large as about[i*n+j]:
   a change of x by its own rounding is one of out.                            */
static inline void check_jacobian(struct check_run *c, check_fn *f, gvi_real *x, const gvi_real *size,
                                  const gvi_real *about)
{
    const gvi_real *own = x == c->q ? c->size : c->size + c->n;
    gvi_real all = 0;                                         // out[k]*own[k] is an energy, for all k
    for (int i = 0; i < c->n; ++i)
        for (int j = 0; j < c->n; ++j) all = fmax(all, fabs(about[i*c->n+j])*own[i]*size[j]);
    for (int i = 0; i < c->n; ++i)
        c->grain[i] = c->eps*fmax(all/own[i], check_largest(c->n, about + i*c->n)*check_largest(c->n, x));
    for (int j = 0; j < c->n; ++j)
        check_differentiate(c, f, c->n, x + j, size[j], c->n, c->best + j, c->err + j);
}

static inline void check_hessian_part(struct check_run *c, check_fn *f, int by_v, const gvi_real *found,
                                      const char *entry, const char *against)
{
    const int n = c->n;
    const gvi_real *size = c->size + (by_v ? n : 0);
    check_jacobian(c, f, by_v ? c->v : c->q, size, found);
    for (int i = 0; i < n; ++i) {
        gvi_real largest = 0;
        for (int j = 0; j < n; ++j) largest = fmax(largest, fabs(found[i*n+j])*size[j]);
        for (int j = 0; j < n; ++j) {
            check_finding y = { .what = CHECK_DERIVATIVE, .entry = entry, .against = against, .i = i, .j = j,
                                .found = found[i*n+j], .right = c->best[i*n+j] };
            const gvi_real other = c->best[j*n+i], far = fabs(y.right - other);
            if (fabs(y.found - other) <= far/100000) y.hint = CHECK_TRANSPOSED;
            check_compare(c, y, c->err[i*n+j], largest/size[j]);
        }
    }
}

/* ------------------------------------------------------- outputs under guard */

/* What is there before a callback writes: never 0 unless unit is.              */
static inline gvi_real check_filling(gvi_real unit, int row, int point)
{
    return unit*(1 + (gvi_real)((7*row + 3*point) % 11)/8);
}

/* `rows` rows of output `which` between two guards.                            */
static inline gvi_real *check_fill(struct check_run *c, int which, int rows, int stride, gvi_real unit)
{
    gvi_real *a = c->guarded[which], *row = a + CHECK_GUARD;
    for (int i = 0; i < rows; ++i)
        for (int k = 0; k < stride; ++k) row[i*stride + k] = check_filling(unit, i, k);
    for (int k = 0; k < CHECK_GUARD; ++k) a[k] = row[rows*stride + k] = check_filling(unit, 1, k);
    return row;
}

static inline int check_same(gvi_real a, gvi_real b) { return !(a < b) && !(a > b); }

/* Is what lies before and behind the rows as it was filled?  The padding of a row may be written. */
static inline void check_guards(struct check_run *c, int which, int rows, int stride, gvi_real unit,
                                const char *entry)
{
    const gvi_real *a = c->guarded[which] + CHECK_GUARD;
    for (int k = 0; k < CHECK_GUARD; ++k)
        if (!check_same(a[k - CHECK_GUARD], check_filling(unit, 1, k))
            || !check_same(a[rows*stride + k], check_filling(unit, 1, k)))
            check_note(c, CHECK_BEYOND, entry, -1, -1);
}

/* Output of point k, row i, is what was there and `alone`; `unit` is above |alone|. */
static inline void check_added(struct check_run *c, int which, int i, int k, int stride, gvi_real unit,
                               gvi_real alone, const char *entry)
{
    const gvi_real was = check_filling(unit, i, k), now = c->guarded[which][CHECK_GUARD + i*stride + k];
    const gvi_real bound = c->tolerance*unit;
    ++c->report->checked;
    if (fabs(now - was - alone) <= bound) return;
    check_finding f = { .what = stride == 1 || fabs(now - alone) <= bound ? CHECK_ADDS : CHECK_BATCH,
                        .entry = entry, .against = "alone", .i = i, .j = -1, .found = now - was,
                        .right = alone, .bound = bound };
    if (f.what == CHECK_ADDS) f.found = now, f.right = was + alone, f.against = "sum";
    check_add(c, f);
}

/* A size to compare with: 1 where all is 0.                                    */
static inline gvi_real check_or_one(gvi_real unit) { return unit > 0 ? unit : 1; }

static inline gvi_real check_unit(int n, const gvi_real *x) { return check_or_one(check_largest(n, x)); }

static inline void check_go_to(struct check_run *c, int point)
{
    c->point = point;
    c->t = c->times[point];
    memcpy(c->q, c->qs + point*c->n, (size_t)c->n*sizeof *c->q);
    memcpy(c->v, c->vs + point*c->n, (size_t)c->n*sizeof *c->v);
}

/* Inputs of `count` points, in c->many.                                       */
static inline gvi_points check_inputs(struct check_run *c, int count, int stride)
{
    gvi_real *q = c->many, *v = q + c->n*stride;
    for (int i = 0; i < c->n; ++i)
        for (int k = 0; k < stride; ++k) {
            q[i*stride+k] = c->qs[(k < count ? k : 0)*c->n + i];
            v[i*stride+k] = c->vs[(k < count ? k : 0)*c->n + i];
        }
    return (gvi_points){ .n = c->n, .count = count, .stride = stride, .t = c->times, .q = q, .v = v };
}

/* f, dldv and value of an effect, asked at `count` points with something there
   already, against one point a call with nothing there.                       */
static inline void check_many(struct check_run *c, int count, int stride)
{
    const gvi_effect *e = check_effect(c);
    const int with_dldv = e->kind == GVI_LAGRANGIAN, with_g = e->kind == GVI_CLOCK;
    gvi_real g = 0, units[3] = { 0, 0, 0 };
    gvi_points x = check_inputs(c, count, stride);
    for (int k = 0; k < count; ++k) {
        check_go_to(c, k);
        if (check_ask(c, e, 0, c->one, with_dldv ? c->two : NULL, with_g ? &g : NULL)) return;
        units[0] = fmax(units[0], check_largest(c->n, c->one));
        if (with_dldv) units[1] = fmax(units[1], check_largest(c->n, c->two));
        units[2] = fmax(units[2], fabs(g));
    }
    for (int m = 0; m < 3; ++m) units[m] = check_or_one(units[m]);
    if (e->kind == GVI_POTENTIAL || (with_g && !c->reads_v)) x.v = c->reads_v ? x.v : NULL;
    x.f = check_fill(c, 0, c->n, stride, units[0]);
    if (with_dldv) x.dldv = check_fill(c, 1, c->n, stride, units[1]);
    if (with_g) x.value = check_fill(c, 2, 1, stride, units[2]);
    c->point = 0;
    if (e->points ? e->points(&x, e->user) : e->point(*x.t, x.q, x.v, x.f, x.dldv, e->user)) {
        check_note(c, CHECK_REFUSED, "points", -1, -1);
        return;
    }
    check_guards(c, 0, c->n, stride, units[0], "f");
    if (with_dldv) check_guards(c, 1, c->n, stride, units[1], "dldv");
    if (with_g) check_guards(c, 2, 1, stride, units[2], "value");
    for (int k = 0; k < count; ++k) {
        check_go_to(c, k);
        check_ask(c, e, 0, c->one, with_dldv ? c->two : NULL, with_g ? &g : NULL);
        for (int i = 0; i < c->n; ++i) {
            check_added(c, 0, i, k, stride, units[0], c->one[i], "f");
            if (with_dldv) check_added(c, 1, i, k, stride, units[1], c->two[i], "dldv");
        }
        if (with_g) check_added(c, 2, 0, k, stride, units[2], g, "value");
    }
}

/* The same of the value callback; with f as well (`both`) where one function
   gives the two.                                                              */
static inline void check_many_values(struct check_run *c, int count, int stride)
{
    const gvi_effect *e = check_effect(c);
    gvi_real value, unit = 0;
    gvi_points x = check_inputs(c, count, stride);
    for (int k = 0; k < count; ++k) {
        check_go_to(c, k);
        if (check_ask(c, e, 1, NULL, NULL, &value)) return;
        unit = fmax(unit, fabs(value));
    }
    unit = check_or_one(unit);
    if (e->kind != GVI_LAGRANGIAN && !c->reads_v) x.v = NULL;
    x.value = check_fill(c, 0, 1, stride, unit);
    c->point = 0;
    if (e->value(&x, e->user)) check_note(c, CHECK_REFUSED, "value", -1, -1);
    check_guards(c, 0, 1, stride, unit, "value");
    for (int k = 0; k < count; ++k) {
        check_go_to(c, k);
        check_ask(c, e, 1, NULL, NULL, &value);
        check_added(c, 0, 0, k, stride, unit, value, "value");
    }
}

/* f and value in one call, as a scene with a clock asks where one function gives both. */
static inline void check_both(struct check_run *c)
{
    const gvi_effect *e = check_effect(c);
    gvi_real *f = c->plus, value, alone, bound;
    if (!e->points || e->points != e->value || e->kind == GVI_CLOCK) return;
    if (check_ask(c, e, 0, c->one, e->kind == GVI_LAGRANGIAN ? c->two : NULL, NULL)) return;
    if (check_ask(c, e, 1, NULL, NULL, &alone)) return;
    if (check_ask(c, e, 0, f, e->kind == GVI_LAGRANGIAN ? c->two : NULL, &value)) return;
    bound = check_unit(c->n, c->one)*c->tolerance;
    for (int i = 0; i < c->n; ++i)
        if (!(fabs(f[i] - c->one[i]) <= bound))
            check_add(c, (check_finding){ .what = CHECK_BOTH, .entry = "f", .against = "alone", .i = i,
                                          .j = -1, .found = f[i], .right = c->one[i], .bound = bound });
    bound = check_unit(1, &alone)*c->tolerance;
    if (!(fabs(value - alone) <= bound))
        check_add(c, (check_finding){ .what = CHECK_BOTH, .entry = "value", .against = "alone", .i = -1,
                                      .j = -1, .found = value, .right = alone, .bound = bound });
}

/* -------------------------------------------------------------- one effect */

/* A potential's velocities, given to it for once, must make no difference.     */
static inline void check_reads_v(struct check_run *c)
{
    const gvi_effect *e = check_effect(c);
    gvi_real g[2] = { 0, 0 }, *f[2] = { c->plus, c->minus };
    if (e->kind != GVI_POTENTIAL && e->kind != GVI_CLOCK) return;
    c->reads_v = 1;
    for (int k = 0; k < 2; ++k) {
        if (k) for (int i = 0; i < c->n; ++i) c->v[i] += c->size[c->n+i]*(1 + (gvi_real)(i % 5));
        check_ask(c, e, 0, f[k], NULL, e->kind == GVI_CLOCK ? &g[k] : NULL);
        if (e->kind == GVI_POTENTIAL && e->value) check_ask(c, e, 1, NULL, NULL, &g[k]);
    }
    check_go_to(c, c->point);
    c->reads_v = 0;
    if (!check_same(g[0], g[1])) check_note(c, CHECK_READS_V, "value", -1, -1), c->reads_v = 1;
    for (int i = 0; i < c->n; ++i)
        if (!check_same(f[0][i], f[1][i])) check_note(c, CHECK_READS_V, "f", i, -1), c->reads_v = 1;
}

/* The Hessian callback into guarded matrices; to c->found.                     */
static inline int check_get_hessian(struct check_run *c)
{
    const gvi_effect *e = check_effect(c);
    const int n = c->n, parts = e->kind == GVI_LAGRANGIAN ? 3 : e->kind == GVI_FORCE ? 2 : 1;
    static const char *const entry[3] = { "fq", "fv", "pv" };
    gvi_real *out[3] = { NULL, NULL, NULL };
    const gvi_real *v = parts > 1 || c->reads_v ? c->v : NULL;
    for (int pass = 0; pass < 2; ++pass) {
        for (int m = 0; m < parts; ++m) {
            gvi_real *found = c->found + m*n*n, unit = pass ? check_unit(n*n, found) : 0;
            out[m] = check_fill(c, m, n*n, 1, unit);
        }
        if (e->hessian(c->t, c->q, v, out[0], out[1], out[2], e->user)) return -1;
        for (int m = 0; m < parts; ++m) {
            gvi_real *found = c->found + m*n*n, unit = pass ? check_unit(n*n, found) : 0;
            if (!pass) memcpy(found, out[m], (size_t)(n*n)*sizeof *found);
            check_guards(c, m, n*n, 1, unit, entry[m]);
            for (int k = 0; pass && k < n*n; ++k) {
                const gvi_real sum = check_filling(unit, k, 0) + found[k];
                if (!(fabs(out[m][k] - sum) <= c->tolerance*unit))
                    check_add(c, (check_finding){ .what = CHECK_ADDS, .entry = entry[m], .against = "sum",
                                                  .i = k/n, .j = k % n, .found = out[m][k], .right = sum });
            }
        }
    }
    return 0;
}

static inline void check_hessian(struct check_run *c)
{
    const gvi_effect *e = check_effect(c);
    const int n = c->n;
    if (check_get_hessian(c)) {
        check_note(c, CHECK_REFUSED, "hessian", -1, -1);
        return;
    }
    check_hessian_part(c, check_f, 0, c->found, "fq", "df/dq");
    if (e->kind == GVI_FORCE || e->kind == GVI_LAGRANGIAN)
        check_hessian_part(c, check_f, 1, c->found + n*n, "fv", "df/dv");
    if (e->kind == GVI_LAGRANGIAN)
        check_hessian_part(c, check_dldv, 1, c->found + 2*n*n, "pv", "d(dL/dv)/dv");
}

/* Without a value: forces with a potential have a symmetric Jacobian.          */
static inline void check_curl(struct check_run *c)
{
    const int n = c->n;
    memset(c->found, 0, (size_t)(n*n)*sizeof *c->found);
    for (int pass = 0; pass < 2; ++pass) {                    // the first, to know the size
        check_jacobian(c, check_f, c->q, c->size, c->found);
        memcpy(c->found, c->best, (size_t)(n*n)*sizeof *c->found);
    }
    for (int i = 1; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            check_finding y = { .what = CHECK_CURL, .entry = "df", .against = "df", .i = i, .j = j,
                                .found = c->best[i*n+j], .right = c->best[j*n+i] };
            check_compare(c, y, c->err[i*n+j] + c->err[j*n+i], 0);
        }
}

/* f, dldv against the value; are they well?                                    */
static inline int check_first(struct check_run *c)
{
    const gvi_effect *e = check_effect(c);
    static const char *const against[] = { "-dV/dq", "", "dL/dq", "dg/dq" };
    gvi_real g = 1;
    int well = 1;
    if (check_f(c, c->one) || (e->kind == GVI_CLOCK && check_value(c, &g)) || !check_finite(c->n, c->one)) {
        check_note(c, CHECK_REFUSED, "f", -1, -1);
        return 0;
    }
    if (!(g > 0)) check_note(c, CHECK_POSITIVE, "value", -1, -1);
    if (e->kind == GVI_FORCE) return 1;
    if (e->kind == GVI_POTENTIAL && !e->value) return check_curl(c), 1;
    if (e->kind == GVI_LAGRANGIAN && !e->value) return ++c->report->unchecked, 1;
    well = check_gradient(c, check_value, c->q, c->size, e->kind == GVI_POTENTIAL ? -1 : 1, c->one, "f",
                          against[e->kind]);
    if (e->kind == GVI_LAGRANGIAN) {
        check_dldv(c, c->one);
        well &= check_gradient(c, check_value, c->v, c->size + c->n, 1, c->one, "dldv", "dL/dv");
    }
    return well;
}

/* g of row c->row - 1 at the state; G [rows][n] to found, dg/dt [rows] to two  */
static inline int check_g(struct check_run *c, gvi_real *out)
{
    const gvi_effect *e = check_effect(c);
    const gvi_points x = { .n = c->n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .g = c->one,
                           .jacobian = c->found, .rate = c->two };
    memset(c->two, 0, (size_t)c->n*sizeof *c->two);
    memset(c->found, 0, (size_t)(c->n*c->n)*sizeof *c->found);
    const int refused = e->points(&x, e->user);
    *out = c->one[c->row - 1];
    return refused;
}

/* The Jacobian of a constraint, and dg/dt, against differences of g            */
static inline void check_constraint(struct check_run *c, int index)
{
    c->effect = index;
    for (int k = 0; k < CHECK_POINTS; ++k)
        for (c->row = check_effect(c)->rows; c->row > 0; --c->row) {
            gvi_real g, best, err, *G = c->found + c->n*c->n;
            check_go_to(c, k);
            if (check_g(c, &g) || !check_finite(c->n, c->found + (c->row - 1)*c->n)) {
                check_note(c, CHECK_REFUSED, "g", c->row - 1, -1);
                continue;
            }
            check_finding y = { .what = CHECK_DERIVATIVE, .entry = "rate", .against = "dg/dt", .i = c->row - 1,
                                .j = -1, .found = c->two[c->row - 1] };
            memcpy(G, c->found + (c->row - 1)*c->n, (size_t)c->n*sizeof *G);
            const gvi_real at = check_largest(c->n, G)*check_largest(c->n, c->q);
            check_gradient(c, check_g, c->q, c->size, 1, G, "jacobian", "dg/dq");
            c->grain[0] = c->eps*at;
            check_differentiate(c, check_g, 1, &c->t, fmax(fabs(c->t), (gvi_real)0.125), 1, &best, &err);
            y.right = best;
            check_compare(c, y, err, fabs(y.found));
        }
}

/* Rows A v + a = 0 are no derivatives: A and a have to be numbers              */
static inline void check_rolling(struct check_run *c, int index)
{
    const int rows = c->desc->effects[index].rows;
    gvi_real g;
    c->effect = index;
    c->row = 1;
    for (int k = 0; k < CHECK_POINTS; ++k) {
        check_go_to(c, k);
        if (check_g(c, &g) || !check_finite(rows*c->n, c->found) || !check_finite(rows, c->two))
            check_note(c, CHECK_REFUSED, "A or a", -1, -1);
    }
}

static inline void check_one_effect(struct check_run *c, int index)
{
    const gvi_effect *e = c->desc->effects + index;
    int well = 1;
    c->effect = index;
    c->reads_v = 0;
    for (int k = 0; k < CHECK_POINTS; ++k) {
        check_go_to(c, k);
        check_reads_v(c);
        well &= check_first(c);
        if (e->kind != GVI_FORCE) check_both(c);
    }
    for (int k = 0; well && e->hessian && k < CHECK_POINTS; ++k) {       // of a wrong f it says nothing
        check_go_to(c, k);
        check_hessian(c);
    }
    check_many(c, 1, 1);
    if (e->points) {
        check_many(c, CHECK_POINTS - 1, CHECK_STRIDE);
        check_many(c, CHECK_POINTS, CHECK_POINTS);
    }
    if (!e->value || e->kind == GVI_CLOCK || e->kind == GVI_FORCE) return;
    check_many_values(c, 1, 1);
    check_many_values(c, CHECK_POINTS - 1, CHECK_STRIDE);
}

/* -------------------------------------------------------------------- mass */

/* M(q) at the state, both triangles, from its lower one.                       */
static inline int check_mass(struct check_run *c, gvi_real *M)
{
    const gvi_mass *m = &c->desc->mass;
    const int n = c->n;
    const gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .mass = M };
    memset(M, 0, (size_t)(n*n)*sizeof *M);
    if (m->kind == GVI_MASS_POSITION && m->points(&x, m->user)) return -1;
    if (m->kind == GVI_MASS_DENSE) memcpy(M, m->matrix, (size_t)(n*n)*sizeof *M);
    for (int i = 0; m->kind != GVI_MASS_POSITION && m->kind != GVI_MASS_DENSE && i < n; ++i) {
        for (int j = 0; j < n; ++j) M[i*n+j] = 0;
        M[i*n+i] = m->kind == GVI_MASS_NONE ? 0 : m->kind == GVI_MASS_UNIT ? 1 : m->matrix[i];
    }
    for (int i = 1; i < n; ++i)
        for (int j = 0; j < i; ++j) M[j*n+i] = M[i*n+j];
    return 0;
}

static inline int check_kinetic(struct check_run *c, gvi_real *out)
{
    gvi_real *M = c->found;
    const int n = c->n;
    *out = 0;
    if (check_mass(c, M)) return -1;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) *out += c->v[i]*M[i*n+j]*c->v[j]/2;
    return 0;
}

/* Both triangles, where the upper one is given.                                */
static inline int check_mass_entries(struct check_run *c)
{
    const gvi_mass *m = &c->desc->mass;
    const int n = c->n;
    gvi_real *M = c->found;
    if (m->kind == GVI_MASS_POSITION) {
        gvi_real *out = check_fill(c, 0, n*n, 1, 0);
        const gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .mass = out };
        if (m->points(&x, m->user)) return -1;
        check_guards(c, 0, n*n, 1, 0, "mass");
        for (int k = 0; k < n*n; ++k) {
            M[k] = out[k];
            if (k % n > k/n && !(fabs(out[k]) > 0)) M[k] = out[k % n*n + k/n];    // left alone: mirrored
        }
    }
    if (m->kind != GVI_MASS_POSITION) memcpy(M, m->matrix, (size_t)(n*n)*sizeof *M);
    for (int i = 1; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            check_finding y = { .what = CHECK_SYMMETRY, .entry = "mass", .against = "mass", .i = j, .j = i,
                                .found = M[j*n+i], .right = M[i*n+j] };
            check_compare(c, y, 0, 0);
        }
    return check_finite(n*n, M) ? 0 : -1;
}

/* L D L' of the lower triangle: D has one sign.                                */
static inline void check_definite(struct check_run *c)
{
    const int n = c->n;
    gvi_real *M = c->found;
    for (int k = 0; k < n; ++k) {
        if (!(M[0] > 0 ? M[k*n+k] > 0 : M[k*n+k] < 0)) {
            check_note(c, CHECK_DEFINITE, "mass", k, k);
            return;
        }
        for (int i = k + 1; i < n; ++i)
            for (int j = k + 1; j <= i; ++j) M[i*n+j] -= M[i*n+k]*M[j*n+k]/M[k*n+k];
    }
}

/* p = M v + dL/dv of all effects; `size`: the same of absolute values.          */
static inline int check_momentum(struct check_run *c, const gvi_real *v, gvi_real *p, gvi_real *size)
{
    const int n = c->n, was = c->effect;
    gvi_real *M = c->found, *keep = c->v;
    int refused = check_mass(c, M);
    for (int i = 0; i < n; ++i) {
        p[i] = size[i] = 0;
        for (int j = 0; j < n; ++j) p[i] += M[i*n+j]*v[j], size[i] += fabs(M[i*n+j]*v[j]);
    }
    c->v = (gvi_real *)v;
    for (c->effect = 0; c->effect < c->desc->effect_count; ++c->effect) {
        if (check_effect(c)->kind != GVI_LAGRANGIAN) continue;
        refused |= check_dldv(c, c->one);
        for (int i = 0; i < n; ++i) p[i] += c->one[i], size[i] += fabs(c->one[i]);
    }
    c->v = keep;
    c->effect = was;
    return refused;
}

/* velocity(p) must have the momentum p; what it is wrong in is named by v.       */
static inline void check_velocity(struct check_run *c)
{
    const gvi_mass *m = &c->desc->mass;
    const int n = c->n;
    gvi_real *p = c->best, *size = p + n, *again = c->err, *more = again + n, far = 0;
    int well = 1;
    if (check_momentum(c, c->v, p, size)) return;
    gvi_real *u = check_fill(c, 0, n, 1, 1);
    const gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .p = p, .velocity = u };
    if (m->velocity(&x, m->user)) {
        check_note(c, CHECK_REFUSED, "velocity", -1, -1);
        return;
    }
    check_guards(c, 0, n, 1, 1, "velocity");
    if (check_momentum(c, u, again, more)) return;
    for (int i = 0; i < n; ++i) {
        well &= fabs(again[i] - p[i]) <= c->tolerance*(size[i] + more[i]);
        far = fmax(far, fabs(u[i] - c->v[i])/c->size[n+i]);
        ++c->report->checked;
    }
    for (int i = 0; !well && i < n; ++i)
        if (!(fabs(u[i] - c->v[i]) <= far*c->size[n+i]/1000))
            check_add(c, (check_finding){ .what = CHECK_VELOCITY, .hint = check_guess(u[i], c->v[i]),
                                          .entry = "velocity", .against = "v", .i = i, .j = -1,
                                          .found = u[i], .right = c->v[i] });
}

/* The three mass callbacks at many points against one at a time: points; then
   gradient after points, then velocity, and gradient after velocity.           */
static inline void check_many_masses(struct check_run *c, int count, int stride)
{
    const gvi_mass *m = &c->desc->mass;
    const int n = c->n;
    gvi_points x = check_inputs(c, count, stride), y = { .n = n, .count = 1, .stride = 1, .t = &c->t };
    gvi_real unit = 0, *M = c->found;
    x.mass = check_fill(c, 0, n*n, stride, 0);
    if (m->points(&x, m->user)) return;
    check_guards(c, 0, n*n, stride, 0, "mass");
    x.mass = NULL;
    for (int k = 0; k < count; ++k) {
        check_go_to(c, k);
        check_mass(c, M);
        for (int e = 0; e < n*n; ++e) {
            const gvi_real one = c->guarded[0][CHECK_GUARD + e*stride + k];
            if (e % n > e/n || fabs(M[e] - one) <= c->tolerance*fabs(M[e])) continue;
            check_add(c, (check_finding){ .what = CHECK_BATCH, .entry = "mass", .against = "alone", .i = e/n,
                                          .j = e % n, .found = one, .right = M[e] });
        }
    }
    // alone: the gradients, point by point, to c->best
    y.q = c->q;
    y.v = c->v;
    y.mass = M;
    for (int k = 0; k < count; ++k) {
        check_go_to(c, k);
        y.f = c->one;
        memset(c->one, 0, (size_t)n*sizeof *c->one);
        if (m->points(&y, m->user) || m->gradient(&y, m->user)) return;
        memcpy(c->tableau + k*n, c->one, (size_t)n*sizeof *c->one);
        unit = fmax(unit, check_largest(n, c->one));
    }
    unit = check_or_one(unit);
    x.mass = check_fill(c, 1, n*n, stride, 1);
    m->points(&x, m->user);
    x.mass = NULL;
    x.f = check_fill(c, 0, n, stride, unit);
    c->point = 0;
    if (m->gradient(&x, m->user)) return;
    check_guards(c, 0, n, stride, unit, "gradient");
    for (int k = 0; k < count; ++k)
        for (int i = 0; i < n; ++i) {
            c->point = k;
            check_added(c, 0, i, k, stride, unit, c->tableau[k*n + i], "gradient");
        }
}

/* gradient where velocity, not points, was called before it at the same q; points
   was called elsewhere, so that what it left behind does not help.             */
static inline void check_after_velocity(struct check_run *c)
{
    const gvi_mass *m = &c->desc->mass;
    const int n = c->n;
    const gvi_real *elsewhere = c->qs + (c->point ? 0 : n);
    gvi_real *p = c->best, *size = p + n, *f = c->err, *after = f + n;
    gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .mass = c->found };
    memset(f, 0, 2*(size_t)n*sizeof *f);
    if (check_momentum(c, c->v, p, size) || m->points(&x, m->user)) return;
    x.mass = NULL;
    x.v = c->v;
    x.f = f;
    if (m->gradient(&x, m->user)) return;
    x = (gvi_points){ .n = n, .count = 1, .stride = 1, .t = &c->t, .q = elsewhere, .mass = c->found };
    m->points(&x, m->user);
    x = (gvi_points){ .n = n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .p = p, .velocity = c->one };
    if (m->velocity(&x, m->user)) return;
    x = (gvi_points){ .n = n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .v = c->v, .f = after };
    if (m->gradient(&x, m->user)) return;
    for (int i = 0; i < n; ++i) {
        check_finding y = { .what = CHECK_BATCH, .entry = "gradient", .against = "after points", .i = i,
                            .j = -1, .found = after[i], .right = f[i] };
        check_compare(c, y, 0, check_unit(n, f));
    }
}

static inline void check_whole_mass(struct check_run *c)
{
    const gvi_mass *m = &c->desc->mass;
    const int moves = m->kind == GVI_MASS_POSITION;
    c->effect = GVI_FAULT_MASS;
    for (int k = 0; k < CHECK_POINTS && (k == 0 || moves || m->velocity); ++k) {
        check_go_to(c, k);
        if ((moves || m->kind == GVI_MASS_DENSE) && check_mass_entries(c)) {
            check_note(c, CHECK_REFUSED, "mass", -1, -1);
            return;
        }
        if (m->kind != GVI_MASS_NONE && !check_mass(c, c->found)) check_definite(c);
        if (moves) {
            const gvi_points x = { .n = c->n, .count = 1, .stride = 1, .t = &c->t, .q = c->q, .v = c->v,
                                   .f = c->one };
            memset(c->one, 0, (size_t)c->n*sizeof *c->one);
            if (check_mass(c, c->found) || m->gradient(&x, m->user)) {
                check_note(c, CHECK_REFUSED, "gradient", -1, -1);
                continue;
            }
            check_gradient(c, check_kinetic, c->q, c->size, 1, c->one, "gradient", "d(v'Mv/2)/dq");
        }
        if (m->velocity) check_velocity(c);
        if (m->velocity && moves) check_after_velocity(c);
    }
    if (!moves) return;
    check_many_masses(c, CHECK_POINTS - 1, CHECK_STRIDE);
    check_many_masses(c, CHECK_POINTS, CHECK_POINTS);
}

/* ------------------------------------------------------------------- the whole */

static inline void check_sizes(int n, const gvi_real *x, const gvi_real *given, gvi_real *size)
{
    const gvi_real largest = check_largest(n, x);
    for (int i = 0; i < n; ++i) {
        size[i] = fmax(fabs(x[i]), largest/1000);
        if (given && given[i] > 0) size[i] = given[i];
        else if (!(size[i] > 0)) size[i] = 1;
    }
}

/* The state given, and others near it: off by up to 1/20 of its size in q, 1/2 in v. */
static inline void check_make_points(struct check_run *c, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    unsigned long long seed = 88172645463325252ull;
    for (int k = 0; k < CHECK_POINTS; ++k) {
        c->times[k] = t + (gvi_real)k*fmax(fabs(t), (gvi_real)1)/8;
        for (int i = 0; i < 2*c->n; ++i) {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            const gvi_real off = k ? (gvi_real)((double)(seed >> 11)/4503599627370496.0 - 1)*c->size[i] : 0;
            if (i < c->n) c->qs[k*c->n + i] = q[i] + off/20;
            else c->vs[k*c->n + i - c->n] = v[i - c->n] + off/2;
        }
    }
}

static inline gvi_real *check_carve(gvi_real **memory, size_t count)
{
    gvi_real *a = *memory;
    *memory += count + CHECK_GUARD;                           // room for a callback that writes too far
    return a;
}

static inline gvi_real *check_memory(struct check_run *c)
{
    const size_t n = (size_t)c->n, square = n*n;
    const size_t rows = square > 2*n ? square : 2*n;
    const size_t batch = (c->desc->mass.kind == GVI_MASS_POSITION ? square : n)*CHECK_STRIDE;
    const size_t guarded = (batch > square ? batch : square) + 2*CHECK_GUARD;
    const size_t vectors = (9 + 2*CHECK_POINTS + 2*CHECK_DEPTH + 2*CHECK_STRIDE)*n;
    const size_t total = vectors + 2*rows + 3*square + 3*guarded + 20*CHECK_GUARD;
    gvi_real *memory = (gvi_real *)calloc(total, sizeof *memory), *next = memory;
    if (!memory) return NULL;
    c->q = check_carve(&next, n);
    c->v = check_carve(&next, n);
    c->qs = check_carve(&next, CHECK_POINTS*n);
    c->vs = check_carve(&next, CHECK_POINTS*n);
    c->size = check_carve(&next, 2*n);
    c->one = check_carve(&next, n);
    c->two = check_carve(&next, n);
    c->plus = check_carve(&next, n);
    c->minus = check_carve(&next, n);
    c->grain = check_carve(&next, n);
    c->tableau = check_carve(&next, 2*CHECK_DEPTH*n);
    c->best = check_carve(&next, rows);
    c->err = check_carve(&next, rows);
    c->found = check_carve(&next, 3*square);
    for (int k = 0; k < 3; ++k) c->guarded[k] = check_carve(&next, guarded);
    c->many = check_carve(&next, 2*n*CHECK_STRIDE);
    return memory;
}

/* May the scene be looked at?  Not what gvi_init refuses, whatever the steps are to be.          */
static inline gvi_status check_refused(const gvi_desc *desc)
{
    gvi_desc plain = { .n = desc->n, .degree = 1, .mass = desc->mass, .effects = desc->effects, .effect_count = desc->effect_count };
    gvi_stepper st;
    if (plain.mass.matrix) plain.mass.kind = GVI_MASS_UNIT, plain.mass.matrix = NULL;     // is looked at here
    const size_t size = gvi_size(&plain);
    gvi_real *memory = (gvi_real *)malloc(size + 1);
    const gvi_status status = memory ? gvi_init(&st, &plain, memory, size) : GVI_E_MEMORY;
    free(memory);
    return status;
}

static inline void check_state(struct check_run *c, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    c->effect = GVI_FAULT_NONE;
    if (!check_finite(1, &t)) check_note(c, CHECK_STATE, "t", -1, -1);
    for (int i = 0; i < c->n; ++i) {
        if (!check_finite(1, q + i)) check_note(c, CHECK_STATE, "q", i, -1);
        if (!check_finite(1, v + i)) check_note(c, CHECK_STATE, "v", i, -1);
    }
}

/* Returns how many findings there are; negative: a NULL, no memory, or what gvi_init refuses the scene with. */
static inline int check_scene(const gvi_desc *desc, gvi_real t, const gvi_real *q, const gvi_real *v,
                              check_report *report)
{
    struct check_run c = { .desc = desc, .report = report };
    if (!desc || !q || !v || !report) return GVI_E_ARGUMENT;
    c.n = desc->n;
    report->count = 0;
    const gvi_status refused = check_refused(desc);
    if (refused) return refused;
    check_state(&c, t, q, v);
    if (report->count) return report->count;
    gvi_real *memory = check_memory(&c);
    if (!memory) return GVI_E_MEMORY;
    c.eps = nextafter((gvi_real)1, (gvi_real)2) - 1;
    c.tolerance = pow(c.eps, (gvi_real)0.575);
    report->count = report->unchecked = 0;
    report->checked = report->zero = 0;
    report->worst = 0;
    check_sizes(c.n, q, report->size_q, c.size);
    check_sizes(c.n, v, report->size_v, c.size + c.n);
    check_make_points(&c, t, q, v);
    check_whole_mass(&c);
    for (int e = 0; e < desc->effect_count; ++e)
        if (desc->effects[e].kind == GVI_CONSTRAINT) check_constraint(&c, e);
        else if (desc->effects[e].kind == GVI_NONHOLONOMIC) check_rolling(&c, e);
        else check_one_effect(&c, e);
    free(memory);
    return report->count;
}

/* -------------------------------------------------------------------- in words */

static inline const char *check_line(const check_finding *f, char *line, int size)
{
    static const char *const hints[] = { "", ": wrong sign?", ": missing?", ": nothing should be there",
                                         ": twice what it should be", ": half of what it should be",
                                         ": transposed?" };
    static const char *const words[] = {
        "", "", "", "", "is not definite", "overwrites what was there",
        "differs with many points at once", "differs when both are wanted at once", "writes beyond its rows",
        "depends on v, which it may not", "is not above 0", "refuses, or is not finite", "is not finite" };
    char who[32] = "mass", at[48] = "", where[40] = "the state given", is[96] = "";
    if (f->effect >= 0) snprintf(who, sizeof who, "effect %d", f->effect);
    if (f->effect == GVI_FAULT_NONE) snprintf(who, sizeof who, "the state");
    if (f->i >= 0 && f->j >= 0) snprintf(at, sizeof at, "[%d][%d]", f->i, f->j);
    else if (f->i >= 0) snprintf(at, sizeof at, "[%d]", f->i);
    if (f->point) snprintf(where, sizeof where, "point %d near it", f->point);
    if (*f->against && *words[f->what])
        snprintf(is, sizeof is, ": %.9g for %.9g", (double)f->found, (double)f->right);
    if (*words[f->what]) {
        snprintf(line, (size_t)size, "%s: %s%s %s%s (at %s)", who, f->entry, at, words[f->what], is, where);
        return line;
    }
    if (f->what == CHECK_SYMMETRY || f->what == CHECK_CURL)
        snprintf(at, sizeof at, "[%d][%d]", f->j, f->i);
    char entry[64];
    snprintf(entry, sizeof entry, f->what == CHECK_CURL ? "%s%d/dq%d" : f->j >= 0 ? "%s[%d][%d]" : "%s[%d]",
             f->entry, f->i, f->j);
    if (f->what == CHECK_CURL) snprintf(at, sizeof at, "%d/dq%d", f->j, f->i);
    snprintf(line, (size_t)size, "%s: %s is %.9g, but %s%s is %.9g (at %s)%s", who, entry, (double)f->found,
             f->against, at, (double)f->right, where, hints[f->hint]);
    return line;
}

#endif
