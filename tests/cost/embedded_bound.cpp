// embedded_bound.cpp - the bound of gvi.h's opening comment, paragraph work, on the floating-point
// operations of a step, against operations counted one by one
//
//   embedded_bound [--list]      one line a case; else one line a formulation and mass
//
// gvi.h is compiled as C++ with a number type that counts what is done with it, as the loops that a
// processor without vector registers runs.  A chain of n coordinates, degree s, r = s and s + 1 points,
// N iterations.  Fails if a step takes more than the bound, or so little that the bound says nothing:
// less than 1/2.5 of it.  A step that is begun again, because the extrapolated values led nowhere, may take
// twice as much, one that fails four times.
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>

#ifndef REAL
#define REAL  float
#define DIGITS 1
#endif

static unsigned long flops;

struct counted {
    REAL x;
    counted() = default;
    template <class T> counted(T y) : x(static_cast<REAL>(y)) {}
    template <class T> explicit operator T() const { return static_cast<T>(x); }
};

static inline counted count(REAL x) { ++flops; return counted(x); }
static inline counted operator+(counted a, counted b) { return count(a.x + b.x); }
static inline counted operator-(counted a, counted b) { return count(a.x - b.x); }
static inline counted operator*(counted a, counted b) { return count(a.x*b.x); }
static inline counted operator/(counted a, counted b) { return count(a.x/b.x); }
static inline counted operator-(counted a) { return counted(-a.x); }
static inline counted &operator+=(counted &a, counted b) { return a = a + b; }
static inline counted &operator-=(counted &a, counted b) { return a = a - b; }
static inline counted &operator*=(counted &a, counted b) { return a = a*b; }
static inline counted &operator/=(counted &a, counted b) { return a = a/b; }
static inline bool operator<(counted a, counted b) { return a.x < b.x; }
static inline bool operator>(counted a, counted b) { return a.x > b.x; }
static inline bool operator<=(counted a, counted b) { return a.x <= b.x; }
static inline bool operator>=(counted a, counted b) { return a.x >= b.x; }
static inline counted counted_root(counted a) { return count(std::sqrt(a.x)); }
static inline counted counted_abs(counted a) { return std::fabs(a.x); }
static inline counted counted_floor(counted a) { return count(std::floor(a.x)); }
static inline counted counted_ldexp(counted a, int e) { return count(std::ldexp(a.x, e)); }
static inline counted counted_frexp(counted a, int *e) { return count(std::frexp(a.x, e)); }

// what gvi.h asks about the name of its type
#define GVI__LONG_counted 0
#define GVI__KIND_counted DIGITS
#define GVI_REAL counted
#define GVI_SQRT(a)     counted_root(a)
#define GVI_ABS(a)      counted_abs(a)
#define GVI_FLOOR(a)    counted_floor(a)
#define GVI_LDEXP(a, e) counted_ldexp(a, e)
#define GVI_FREXP(a, e) counted_frexp(a, e)
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"

/* Rows as long as r, or a multiple of 8 from 5 on                                               */
static double flops_row(int r) { return r < 5 ? r : (r + 7)/8*8; }

/* A step as long as the one before, N iterations.  A set of rows takes n R sums of r products in each
   iteration and at the start, and K sets are to be found: positions, or with them velocities, or
   momenta.  M^-1 full: its solutions for each row.  M(q): L D L' and two solutions at each point.  */
static double flops_of_step(gvi_formulation f, gvi_mass_kind mass, int n, int r, int N)
{
    const double R = flops_row(r), K = f == GVI_POSITIONS ? 1 : 2;
    double all = (N + 2)*(K*n*R*(2*r + 20) + 30) + 30*K*n*r + 132*n;
    if (f == GVI_EXPLICIT) return 10*n*(r + 1) + 32*n + 8*r + 16;
    if (mass == GVI_MASS_DENSE) all += 2*n*n*((N + 2)*K*R + 17) + 8*(N + 2)*K*n*R;
    if (mass == GVI_MASS_POSITION) all += (N + 1)*R*(n*n*n/2.0 + 6*n*n + 4*n);
    return all;
}

/* What a new h costs besides, in the step that has it and the next two                          */
static inline double flops_of_new_h(gvi_formulation f, int r)
{
    return f == GVI_EXPLICIT ? 1800*r : 6*r*r*flops_row(r) + 4*(r + 10)*r*flops_row(r) + 70*r + 60;
}

enum { MOST_N = 6, MOST_S = 8, MOST_KICKS = 24, MOST_ITERATIONS = 8, STEPS = 20, FIRST = 3 };
static const REAL length = REAL(1)/64;

// ---- a chain, in plain numbers: callbacks are not counted

static int chain(const gvi_points *x, void *)
{
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const counted *q = x->q + i*x->stride + k;
            counted *f = x->f + i*x->stride + k;
            const REAL pull = i > 0 ? (q->x - q[-x->stride].x)/4 : 0;
            f->x -= std::sin(q->x) + pull;
            if (i > 0) f[-x->stride].x += pull;
        }
    return 0;
}

static int friction(const gvi_points *x, void *)
{
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k].x -= x->v[i*x->stride + k].x/8;
    return 0;
}

static int inertia(const gvi_points *x, void *)
{
    for (int i = 0; i < x->n; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < x->count; ++k)
                x->mass[(i*x->n + j)*x->stride + k].x
                    = i == j ? 2 + std::cos(x->q[i*x->stride + k].x)/4 : REAL(0.125);
    return 0;
}

static int inertia_gradient(const gvi_points *x, void *)
{
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const REAL v = x->v[i*x->stride + k].x;
            x->f[i*x->stride + k].x -= std::sin(x->q[i*x->stride + k].x)*v*v/8;
        }
    return 0;
}

// ---- cases

struct kind { const char *name; gvi_formulation f; gvi_mass_kind mass; };

static const kind kinds[] = {
    { "explicit, unit mass", GVI_EXPLICIT, GVI_MASS_UNIT },
    { "explicit, diagonal mass", GVI_EXPLICIT, GVI_MASS_DIAGONAL },
    { "positions, unit mass", GVI_POSITIONS, GVI_MASS_UNIT },
    { "positions, diagonal mass", GVI_POSITIONS, GVI_MASS_DIAGONAL },
    { "positions, full mass", GVI_POSITIONS, GVI_MASS_DENSE },
    { "velocities, unit mass", GVI_VELOCITIES, GVI_MASS_UNIT },
    { "velocities, diagonal mass", GVI_VELOCITIES, GVI_MASS_DIAGONAL },
    { "velocities, full mass", GVI_VELOCITIES, GVI_MASS_DENSE },
    { "momenta, unit mass", GVI_MOMENTA, GVI_MASS_UNIT },
    { "momenta, diagonal mass", GVI_MOMENTA, GVI_MASS_DIAGONAL },
    { "momenta, full mass", GVI_MOMENTA, GVI_MASS_DENSE },
    { "momenta, M(q)", GVI_MOMENTA, GVI_MASS_POSITION } };

// the most of a step; of one of the first, which make tables; of one that was begun again, because the
// extrapolated values led nowhere; of one that failed
struct outcome { unsigned long most, first, again, failed; };

static counted matrix[MOST_N*MOST_N], corners[MOST_KICKS], weights[MOST_KICKS];
static const gvi_effect effects[] = {
    { GVI_POTENTIAL, chain, 0, 0, 0, 0 },
    { GVI_FORCE, friction, 0, 0, 0, 0 } };

static gvi_desc describe(const kind &k, int n, int s, int r, int N)
{
    gvi_desc d = gvi_desc();
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            matrix[i*n + j] = i == j || k.mass == GVI_MASS_DIAGONAL ? REAL(2 + j) : REAL(0.125);
    for (int j = 0; j < r; ++j) {
        corners[j] = REAL(j)/REAL(r > 1 ? r - 1 : 1);
        weights[j] = 1/REAL(r);
    }
    d.n = n;
    d.degree = s;
    d.rule.kind = k.f != GVI_EXPLICIT ? GVI_GAUSS : r == 2 ? GVI_LOBATTO : GVI_KICKS;
    d.rule.points = r;
    if (d.rule.kind == GVI_KICKS) d.rule.nodes = corners;
    if (d.rule.kind == GVI_KICKS) d.rule.weights = weights;
    d.mass.kind = k.mass;
    if (k.mass == GVI_MASS_DIAGONAL || k.mass == GVI_MASS_DENSE) d.mass.matrix = matrix;
    if (k.mass == GVI_MASS_POSITION) d.mass.points = inertia;
    if (k.mass == GVI_MASS_POSITION) d.mass.gradient = inertia_gradient;
    d.effects = effects;
    d.effect_count = k.f >= GVI_VELOCITIES ? 2 : 1;
    d.formulation = k.f;
    d.iterations = N;
    return d;
}

static void larger(unsigned long *most) { if (flops > *most) *most = flops; }

static outcome perform(const gvi_desc &d)
{
    static counted memory[GVI_LENGTH(MOST_N, MOST_S, MOST_S + 1) + GVI_LENGTH(MOST_N, 1, MOST_KICKS)];
    static gvi_stepper st;
    outcome x = { 0, 0, 0, 0 };
    const unsigned long long points = (unsigned long long)(d.iterations*d.rule.points);
    counted q[MOST_N], v[MOST_N];
    for (int i = 0; i < d.n; ++i) q[i] = REAL(0.5) + REAL(0.125)*REAL(i), v[i] = 0;
    if (gvi_init(&st, &d, memory, sizeof memory) == GVI_OK) gvi_start(&st, 0, q, v);
    for (int k = 0; k < STEPS && st.status == GVI_OK; ++k) {
        flops = 0;
        st.counters.effect[0] = 0;
        gvi_step(&st, length);
        const bool again = d.iterations > 0 && st.counters.effect[0] > points;
        larger(st.status != GVI_OK ? &x.failed : k < FIRST ? &x.first : again ? &x.again : &x.most);
    }
    return x;
}

struct summary { int cases, bad, again, failed; double least, most; };

static void judge(const kind &k, int n, int s, int r, int N, bool list, summary *sum)
{
    const outcome x = perform(describe(k, n, s, r, N));
    const double bound = flops_of_step(k.f, k.mass, n, r, N);
    const double more = flops_of_new_h(k.f, r);
    const double ratio = bound/double(x.most);
    const bool bad = !(ratio >= 1 && ratio <= 2.5) || double(x.first) > bound + more
                     || double(x.again) > 2*bound || double(x.failed) > 4*bound;
    sum->cases += 1;
    sum->bad += bad;
    sum->again += x.again > 0;
    sum->failed += x.failed > 0;
    if (ratio < sum->least) sum->least = ratio;
    if (ratio > sum->most) sum->most = ratio;
    if (!list && !bad) return;
    std::printf("%s%s: n %d, s %d, r %d, N %d: %lu operations, bound %.0f; first steps %lu, bound %.0f; "
                "begun again %lu; failed %lu\n", bad ? "FAILED: " : "", k.name, n, s, r, N, x.most, bound,
                x.first, bound + more, x.again, x.failed);
}

static summary judge_kind(const kind &k, bool list)
{
    summary sum = { 0, 0, 0, 0, 1e9, 0 };
    const bool explicitly = k.f == GVI_EXPLICIT;
    for (int n = 1; n <= MOST_N; ++n)
        for (int s = 1; s <= (explicitly ? 1 : MOST_S); ++s)
            for (int r = explicitly ? 2 : s; r <= (explicitly ? MOST_KICKS : k.f == GVI_MOMENTA ? s : s + 1); ++r)
                for (int N = 1; N <= (explicitly ? 1 : MOST_ITERATIONS); ++N)
                    judge(k, n, s, r, explicitly ? 0 : N, list, &sum);
    return sum;
}

int main(int argc, char **argv)
{
    const bool list = argc == 2 && !std::strcmp(argv[1], "--list");
    int bad = 0;
    for (const kind &k : kinds) {
        const summary s = judge_kind(k, list);
        std::printf("  %-26s %5d cases, bound/counted %.2f to %.2f", k.name, s.cases, s.least, s.most);
        if (s.again || s.failed) std::printf("; begun again in %d, failed in %d", s.again, s.failed);
        std::puts("");
        bad += s.bad + (s.cases == 0);
    }
    if (bad) std::printf("FAILED: embedded_bound: %d\n", bad);
    return bad > 0;
}
