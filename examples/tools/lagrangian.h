/* lagrangian.h - type the Lagrangian as it stands on paper, or H(q,p), and nothing else

     LAGRANGIAN(pendulum, 2)                    // its name, n; t, q, v and user are there
     {
         const double g = 9.81;
         return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*cos(q[0] - q[1]) + 2*g*cos(q[0]) + g*cos(q[1]);
     }

     lagrangian L;
     const char *wrong = lagrangian_init(&L, pendulum, NULL, 0, q, v);   // user, and the start: t, q, v
     if (wrong) return puts(wrong), 1;
     const gvi_effect scene[] = { lagrangian_effect(&L) };               // friction, rods: more rows
     const gvi_desc desc = { .n = 2, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 1 };

   The type of t, q, v is `number`.  Every variable that depends on q or v is a number, too:

     number r2 = q[0]*q[0] + q[1]*q[1];         // `double r2` would lose its derivative

   Functions: sqrt exp log pow sin cos tan fabs, in C also the others of <tgmath.h> that take complex
   numbers.  The same text compiles as C and as C++.  There is no `if (q[0] < 0)`, because L has
   to be smooth: a step over a kink, as of fabs at 0, is of order 2 at most.

   C99 with gcc or clang, or C++11.

   First derivatives of L are exact to rounding.  In C, number is complex, and the imaginary part
   carries the derivative by one coordinate (complex step); in C++ a dual number carries those by
   all of them.  lagrangian_init looks at L near the start, and near it on wider scales, for what it is:

     LAGRANGIAN_POTENTIAL  v'Mv/2 - V(t,q)          steps without velocities
     LAGRANGIAN_LINEAR     v'Mv/2 + a(t,q)'v - V    velocities
     LAGRANGIAN_MASS       v'M(t,q)v/2 - V(t,q)     momenta
     LAGRANGIAN_GENERAL    anything else            Newton's method

   L.kind says which.  An L that is of one kind near the start and of another far away cannot be
   known: set L.kind = LAGRANGIAN_GENERAL after lagrangian_init, which covers all.  So it is with
   the entries of M that vary.  Of the first kind, with many coordinates, -dV/dq by hand saves most.

   Refused, with a sentence: derivatives lost to a `double`; L not finite at the start; no kinetic
   energy in a coordinate; n above LAGRANGIAN_MOST (32; define it before the header).  By the
   callbacks (GVI_E_CALLBACK): a desc.n that is another.

   H(t,q,p) likewise, for momenta: a vortex, a spin, populations; or a mass that you know in p.

     HAMILTONIAN(vortices, 3) { ... }           // t, q, p and user are there
     hamiltonian_init, hamiltonian_effect, hamiltonian_mass; desc.formulation = GVI_MOMENTA;
     gvi_start_momentum in the place of gvi_start.  Gauss collocation of Hamilton's equations,
     symplectic, of order 2s.  No constraints, no action.

   One object for each stepper, and it stays where it is as long as the stepper is used.

   Source: Squire, Trapp: Using complex variables to estimate derivatives of real functions,
   SIAM Review 40, 1998.                                                        */
#ifndef LAGRANGIAN_H
#define LAGRANGIAN_H

#include "gvi.h"
#include <float.h>
#include <stdio.h>                    /* snprintf, for the sentences alone      */
#include <string.h>

#ifndef LAGRANGIAN_MOST
#define LAGRANGIAN_MOST 32
#endif

#if defined(__GNUC__)
#define LAGRANGIAN__ALWAYS __attribute__((always_inline))
#define LAGRANGIAN__INLINE static inline LAGRANGIAN__ALWAYS
#define LAGRANGIAN__UNUSED __attribute__((unused))
#else
#define LAGRANGIAN__ALWAYS
#define LAGRANGIAN__INLINE static inline
#define LAGRANGIAN__UNUSED
#endif

/* What is wanted of a function F(t,q,w) at the points of x: `scale` times its value and its
   derivatives, added to what is not NULL.                                      */
typedef struct lagrangian_wanted {
    const gvi_points *x;              /* t, q                                   */
    const gvi_real   *w;              /* [n][stride] v or p; NULL: 0, but       */
    int               one;            /* w[one] = 1; -1: nowhere                */
    gvi_real          scale, *value, *by_q, *by_w;
    int               first, end, apart;  /* of by_w: these coordinates, [.][apart] */
    const void       *user;
} lagrangian_wanted;

typedef struct lagrangian_function {
    int n;
    void (*add)(const lagrangian_wanted *wanted);
} lagrangian_function;

/* -------------------------------------------------- numbers with a derivative */

#ifndef __cplusplus
#include <tgmath.h>
#undef I                              /* <complex.h> comes with it; I is a user's name */

/* sqrt(number) and the like keep the first derivative alone: a third of the time of csqrt. */
typedef GVI_REAL complex number;

enum { LAGRANGIAN__FLOAT = sizeof(gvi_real) == sizeof(float) };
#define LAGRANGIAN__STEP ((gvi_real)(LAGRANGIAN__FLOAT ? 0x1p-64 : 0x1p-332))

LAGRANGIAN__INLINE number lagrangian_number(gvi_real value, gvi_real derivative)
{
    union { number z; gvi_real part[2]; } u;
    u.part[0] = value;
    u.part[1] = derivative;
    return u.z;
}

LAGRANGIAN__INLINE int lagrangian_is_zero(gvi_real x) { return x <= 0 && x >= 0; }

#define LAGRANGIAN__NUMBER(name, value, slope)                                                  \
    static inline number name(number z)                                                         \
    {                                                                                           \
        const gvi_real x = creal(z), d = cimag(z);                                              \
        if (lagrangian_is_zero(d)) return value;                                                \
        const gvi_real y = value;                                                               \
        return lagrangian_number(y, (slope)*d);                                                 \
    }
LAGRANGIAN__NUMBER(lagrangian_sqrt, GVI_SQRT(x), 1/(2*y))
LAGRANGIAN__NUMBER(lagrangian_exp, exp(x), y)
LAGRANGIAN__NUMBER(lagrangian_log, log(x), 1/x)
LAGRANGIAN__NUMBER(lagrangian_sin, sin(x), cos(x))
LAGRANGIAN__NUMBER(lagrangian_cos, cos(x), -sin(x))
LAGRANGIAN__NUMBER(lagrangian_tan, tan(x), 1 + y*y)
LAGRANGIAN__NUMBER(lagrangian_abs, fabs(x), y > x ? -1 : 1)

LAGRANGIAN__INLINE number lagrangian_pow(number z, number exponent)
{
    const gvi_real x = creal(z), d = cimag(z), a = creal(exponent), da = cimag(exponent), y = pow(x, a);
    gvi_real slope = 0;
    if (!lagrangian_is_zero(d)) slope = a*pow(x, a - 1)*d;
    if (!lagrangian_is_zero(da)) slope += y*log(x)*da;
    return lagrangian_number(y, slope);
}

/* of complex numbers these, of anything else what <math.h> has */
#define LAGRANGIAN__EITHER(x, of_number, name)                                                  \
    (__extension__ _Generic((x), float complex: of_number, double complex: of_number,           \
                            long double complex: of_number, float: name##f, long double: name##l, default: name))
#undef sqrt
#undef exp
#undef log
#undef sin
#undef cos
#undef tan
#undef fabs
#undef pow
#define sqrt(x) LAGRANGIAN__EITHER(x, lagrangian_sqrt, sqrt)(x)
#define exp(x)  LAGRANGIAN__EITHER(x, lagrangian_exp, exp)(x)
#define log(x)  LAGRANGIAN__EITHER(x, lagrangian_log, log)(x)
#define sin(x)  LAGRANGIAN__EITHER(x, lagrangian_sin, sin)(x)
#define cos(x)  LAGRANGIAN__EITHER(x, lagrangian_cos, cos)(x)
#define tan(x)  LAGRANGIAN__EITHER(x, lagrangian_tan, tan)(x)
#define fabs(x) LAGRANGIAN__EITHER(x, lagrangian_abs, fabs)(x)
#define pow(x, y) LAGRANGIAN__EITHER((x) + (y), lagrangian_pow, pow)(x, y)

/* gcc: products and quotients in line, without the rescue of infinite ones (of squares in a quotient, at 1e154) */
#if defined(__GNUC__) && !defined(__clang__) && GVI__KIND != 1
#define LAGRANGIAN__PLAIN __attribute__((optimize("cx-limited-range")))
#else
#define LAGRANGIAN__PLAIN
#endif

/* One coordinate after the other; z[2n]: q and w. */
typedef number lagrangian_body(number t, const number *q, const number *w, const void *user);

LAGRANGIAN__INLINE void lagrangian_add(lagrangian_body *F, int n, number *z, const lagrangian_wanted *a)
{
    const gvi_points *x = a->x;
    const int from = a->by_q ? 0 : n + a->first, to = a->by_w ? n + a->end : n, R = x->stride;
    const gvi_real step = LAGRANGIAN__STEP, by = a->scale/step;
    for (int k = 0; k < x->count; ++k) {
        for (int i = 0; i < n; ++i) {
            z[i] = x->q[i*R + k];
            z[n + i] = a->w ? a->w[i*R + k] : i == a->one;
        }
        int d = from;
        number L;
        do {
            const gvi_real at = d < to ? creal(z[d]) : 0;
            if (d < to) z[d] = lagrangian_number(at, step);
            L = F(x->t[k], z, z + n, a->user);
            if (d >= to) break;
            z[d] = at;
            if (d < n) a->by_q[d*R + k] += by*cimag(L);
            else a->by_w[(d - n)*a->apart + k] += by*cimag(L);
        } while (++d < to);
        if (a->value) a->value[k] += a->scale*creal(L);
    }
}

#define LAGRANGIAN__FUNCTION(name, n, w)                                                        \
    LAGRANGIAN__INLINE number name##_at(number t, const number *q, const number *w, const void *user); \
    LAGRANGIAN__PLAIN static void name##_add(const lagrangian_wanted *wanted)                  \
    {                                                                                           \
        number z[2*(n)];                                                                        \
        lagrangian_add(name##_at, n, z, wanted);                                                \
    }                                                                                           \
    static const lagrangian_function name = { n, name##_add };                                  \
    LAGRANGIAN__INLINE number name##_at(LAGRANGIAN__UNUSED number t, LAGRANGIAN__UNUSED const number *q, \
                                        LAGRANGIAN__UNUSED const number *w, LAGRANGIAN__UNUSED const void *user)

#else
#include <cmath>

/* A value and N derivatives.  A double cannot hold one: what would lose them does not compile. */
template <int N> struct lagrangian_dual {
    gvi_real x, d[N];
    lagrangian_dual(gvi_real value = 0) : x(value) { for (int i = 0; i < N; ++i) d[i] = 0; }

    /* f(a) with slope f'(a); f(a, b) likewise */
    static lagrangian_dual of(gvi_real value, gvi_real slope, const lagrangian_dual &a)
    {
        lagrangian_dual y(value);
        for (int i = 0; i < N; ++i) y.d[i] = slope*a.d[i];
        return y;
    }
    static lagrangian_dual of(gvi_real value, gvi_real slope_a, const lagrangian_dual &a, gvi_real slope_b,
                              const lagrangian_dual &b)
    {
        lagrangian_dual y(value);
        for (int i = 0; i < N; ++i) y.d[i] = slope_a*a.d[i] + slope_b*b.d[i];
        return y;
    }
    typedef lagrangian_dual number;
    friend number operator-(const number &a) { return of(-a.x, -1, a); }
    friend number operator+(const number &a) { return a; }
    friend number operator+(const number &a, const number &b) { return of(a.x + b.x, 1, a, 1, b); }
    friend number operator+(const number &a, gvi_real b) { return of(a.x + b, 1, a); }
    friend number operator+(gvi_real a, const number &b) { return of(a + b.x, 1, b); }
    friend number operator-(const number &a, const number &b) { return of(a.x - b.x, 1, a, -1, b); }
    friend number operator-(const number &a, gvi_real b) { return of(a.x - b, 1, a); }
    friend number operator-(gvi_real a, const number &b) { return of(a - b.x, -1, b); }
    friend number operator*(const number &a, const number &b) { return of(a.x*b.x, b.x, a, a.x, b); }
    friend number operator*(const number &a, gvi_real b) { return of(a.x*b, b, a); }
    friend number operator*(gvi_real a, const number &b) { return of(a*b.x, a, b); }
    friend number operator/(const number &a, const number &b)
    {
        const gvi_real r = 1/b.x, y = a.x*r;
        return of(y, r, a, -y*r, b);
    }
    friend number operator/(const number &a, gvi_real b) { return of(a.x/b, 1/b, a); }
    friend number operator/(gvi_real a, const number &b)
    {
        const gvi_real r = 1/b.x, y = a*r;
        return of(y, -y*r, b);
    }
    friend number &operator+=(number &a, const number &b) { return a = a + b; }
    friend number &operator-=(number &a, const number &b) { return a = a - b; }
    friend number &operator*=(number &a, const number &b) { return a = a*b; }
    friend number &operator/=(number &a, const number &b) { return a = a/b; }
    friend number sqrt(const number &a)
    {
        const gvi_real y = GVI_SQRT(a.x);
        return of(y, 1/(2*y), a);
    }
    friend number exp(const number &a)
    {
        const gvi_real y = std::exp(a.x);
        return of(y, y, a);
    }
    friend number log(const number &a) { return of(std::log(a.x), 1/a.x, a); }
    friend number sin(const number &a) { return of(std::sin(a.x), std::cos(a.x), a); }
    friend number cos(const number &a) { return of(std::cos(a.x), -std::sin(a.x), a); }
    friend number tan(const number &a)
    {
        const gvi_real y = std::tan(a.x);
        return of(y, 1 + y*y, a);
    }
    friend number fabs(const number &a) { return of(std::fabs(a.x), a.x < 0 ? -1 : 1, a); }
    friend number pow(const number &a, gvi_real b) { return of(std::pow(a.x, b), b*std::pow(a.x, b - 1), a); }
    friend number pow(const number &a, const number &b)
    {
        const gvi_real y = std::pow(a.x, b.x);
        return of(y, b.x*std::pow(a.x, b.x - 1), a, y*std::log(a.x), b);
    }
};

/* Derivatives in one evaluation: by q at rest, by q, by w, by both; the value in any case. */
enum { LAGRANGIAN__REST, LAGRANGIAN__Q, LAGRANGIAN__W, LAGRANGIAN__BOTH };

/* gcc: loops over derivatives in line, as with -O3 */
#if defined(__GNUC__) && !defined(__clang__)
#define LAGRANGIAN__UNROLLED __attribute__((optimize("O3")))
#else
#define LAGRANGIAN__UNROLLED
#endif

template <class F, int n, int what> LAGRANGIAN__UNROLLED inline void lagrangian_add(const lagrangian_wanted *a)
{
    enum { by_q = what != LAGRANGIAN__W, by_w = what >= LAGRANGIAN__W, w_at = by_q ? n : 0 };
    typedef lagrangian_dual<by_q && by_w ? 2*n : n> number;
    const gvi_points *x = a->x;
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        number q[n], w[n];
        for (int i = 0; i < n; ++i) {
            q[i].x = x->q[i*R + k];
            if (what != LAGRANGIAN__REST) w[i].x = a->w ? a->w[i*R + k] : i == a->one;
            if (by_q) q[i].d[i] = 1;
            if (by_w) w[i].d[w_at + i] = 1;
        }
        const number L = F().template at<number>(number(x->t[k]), q, w, a->user);
        for (int i = 0; i < n && by_q && a->by_q; ++i) a->by_q[i*R + k] += a->scale*L.d[i];
        for (int i = a->first; i < a->end && by_w; ++i) a->by_w[i*a->apart + k] += a->scale*L.d[w_at + i];
        if (a->value) a->value[k] += a->scale*L.x;
    }
}

template <class F, int n> inline void lagrangian_any(const lagrangian_wanted *a)
{
    if (a->by_q && a->by_w) lagrangian_add<F, n, LAGRANGIAN__BOTH>(a);
    else if (a->by_w) lagrangian_add<F, n, LAGRANGIAN__W>(a);
    else if (a->w || a->one >= 0) lagrangian_add<F, n, LAGRANGIAN__Q>(a);
    else lagrangian_add<F, n, LAGRANGIAN__REST>(a);
}

#define LAGRANGIAN__FUNCTION(name, n, w)                                                        \
    struct name##_body {                                                                        \
        template <class number> number at(number t, const number *q, const number *w, const void *user) const; \
    };                                                                                          \
    static void name##_add(const lagrangian_wanted *wanted) { lagrangian_any<name##_body, n>(wanted); } \
    static const lagrangian_function name = { n, name##_add };                                  \
    template <class number>                                                                     \
    LAGRANGIAN__UNROLLED LAGRANGIAN__ALWAYS inline number name##_body::at(                      \
        LAGRANGIAN__UNUSED number t, LAGRANGIAN__UNUSED const number *q,                        \
        LAGRANGIAN__UNUSED const number *w, LAGRANGIAN__UNUSED const void *user) const
#endif

#define LAGRANGIAN(name, n) LAGRANGIAN__FUNCTION(name, n, v)
#define HAMILTONIAN(name, n) LAGRANGIAN__FUNCTION(name, n, p)

/* ------------------------------------------------------------- L at one point */

enum { LAGRANGIAN__KEPT = 16*LAGRANGIAN_MOST };

typedef enum lagrangian_kind {
    LAGRANGIAN_REFUSED, LAGRANGIAN_POTENTIAL, LAGRANGIAN_LINEAR, LAGRANGIAN_MASS, LAGRANGIAN_GENERAL
} lagrangian_kind;

typedef struct lagrangian {
    lagrangian_kind     kind;
    lagrangian_function function;
    const void         *user;
    gvi_real            M[LAGRANGIAN_MOST*LAGRANGIAN_MOST], diagonal[LAGRANGIAN_MOST];
    unsigned char       varies[LAGRANGIAN_MOST*LAGRANGIAN_MOST];        /* does M_ij?        */
    int                 kept;         /* MASS: numbers in q and rest; 0: none   */
    gvi_real            t, q[LAGRANGIAN__KEPT], rest[LAGRANGIAN__KEPT];  /* dL/dq at v = 0, at these q */
    char                why[240];
} lagrangian;

/* Value, and derivatives by q and w where there is room for them, at one point. */
static inline gvi_real lagrangian_at(const lagrangian_function *f, const void *user, gvi_real t, const gvi_real *q,
                                     const gvi_real *w, gvi_real *by_q, gvi_real *by_w)
{
    const int n = f->n;
    gvi_real value = 0;
    gvi_points x;
    lagrangian_wanted a;
    memset(&x, 0, sizeof x);
    memset(&a, 0, sizeof a);
    x.n = a.end = n;
    x.count = x.stride = a.apart = 1;
    x.t = &t;
    x.q = q;
    a.x = &x;
    a.w = w;
    a.one = -1;
    a.scale = 1;
    a.value = &value;
    a.by_q = by_q;
    a.by_w = by_w;
    a.user = user;
    for (int i = 0; i < n && by_q; ++i) by_q[i] = 0;
    for (int i = 0; i < n && by_w; ++i) by_w[i] = 0;
    f->add(&a);
    return value;
}

static inline int lagrangian_finite(int count, const gvi_real *x)
{
    for (int i = 0; i < count; ++i)
        if (!(x[i] - x[i] >= 0)) return 0;
    return 1;
}

static inline gvi_real lagrangian_abs_of(gvi_real x) { return x < 0 ? -x : x; }

static inline gvi_real lagrangian_largest(int count, const gvi_real *x)
{
    gvi_real most = 0;
    for (int i = 0; i < count; ++i)
        if (lagrangian_abs_of(x[i]) > most) most = lagrangian_abs_of(x[i]);
    return most;
}

static inline gvi_real lagrangian_eps(void)
{
    return sizeof(gvi_real) == sizeof(float) ? (gvi_real)FLT_EPSILON
         : sizeof(gvi_real) == sizeof(double) ? (gvi_real)DBL_EPSILON : (gvi_real)LDBL_EPSILON;
}

/* The same numbers on every machine, in (-1, 1). */
static inline gvi_real lagrangian_random(unsigned *seed)
{
    *seed = *seed*1664525u + 1013904223u;
    return (gvi_real)((double)(*seed >> 8 & 0xFFFFFF)/8388608.0 - 1);
}

/* dL/dx by central differences, x one of the numbers of q or w, left as it was.  Richardson's
   extrapolation of 20 widths, each half the one before; the entry where neighbours agree best. */
static inline gvi_real lagrangian_difference(const lagrangian_function *f, const void *user, gvi_real t, const gvi_real *q,
                                             const gvi_real *w, gvi_real *x, gvi_real size, gvi_real *error)
{
    gvi_real best = 0, width = size/8, row[2] = { 0, 0 };
    const gvi_real was = *x;
    int rows = 0;
    *error = -1;
    for (int k = 0; k < 20; ++k, width /= 2) {
        *x = was + width;
        const gvi_real up = *x, at_up = lagrangian_at(f, user, t, q, w, NULL, NULL);
        *x = was - width;
        const gvi_real first = (at_up - lagrangian_at(f, user, t, q, w, NULL, NULL))/(up - *x),
                       rounding = 4*lagrangian_eps()*lagrangian_abs_of(at_up)/width;
        *x = was;
        if (!lagrangian_finite(1, &first)) continue;
        const gvi_real second = first + (first - row[0])/3, off = rounding + lagrangian_abs_of(second - row[1]);
        if (rows++ > 1 && (*error < 0 || off < *error)) {
            best = second;
            *error = off;
        }
        row[0] = first;
        row[1] = second;
    }
    return best;
}

/* ----------------------------------------------------------- what kind is it? */

static inline const char *lagrangian_refuse(lagrangian *L, const char *text, const char *name, const char *of, int i)
{
    snprintf(L->why, sizeof L->why, text, name, of, i);
    L->kind = LAGRANGIAN_REFUSED;
    return L->why;
}

/* Are the derivatives at (q, w) those that differences show?                   */
static inline const char *lagrangian_compare(lagrangian *L, gvi_real t, gvi_real *q, gvi_real *w, const char *name,
                                             const char *of)
{
    const int n = L->function.n;
    const gvi_real eps = lagrangian_eps();
    gvi_real g[2*LAGRANGIAN_MOST];
    lagrangian_at(&L->function, L->user, t, q, w, g, g + n);
    if (!lagrangian_finite(2*n, g)) return NULL;
    for (int d = 0; d < 2*n; ++d) {
        gvi_real *z = d < n ? q : w, most = lagrangian_largest(n, z), error, size = lagrangian_abs_of(z[d%n]);
        if (most <= 0) most = size = 1;
        if (size < most/1000) size = most/1000;
        const gvi_real right = lagrangian_difference(&L->function, L->user, t, q, w, z + d%n, size, &error);
        const gvi_real bound = 20*error + GVI_SQRT(eps)/16*lagrangian_abs_of(right) + 64*eps*lagrangian_largest(2*n, g);
        if (error < 0 || lagrangian_abs_of(g[d] - right) <= bound) continue;
        snprintf(L->why, sizeof L->why,
                 "d%s/d%s[%d] is %.6g by numbers, %.6g by differences: is a variable in %s a double that has to be a number?",
                 name, d < n ? "q" : of, d%n, (double)g[d], (double)right, name);
        L->kind = LAGRANGIAN_REFUSED;
        return L->why;
    }
    return NULL;
}

/* What L(t,q,v) and H(t,q,p) have to be: of a size there is room for, finite with its derivatives at the start,
   and with derivatives that are right, there and at two states near it.      */
static inline const char *lagrangian_begin(lagrangian *L, lagrangian_function function, const void *user, gvi_real t,
                                           const gvi_real *q, const gvi_real *w, const char *name, const char *of)
{
    const int n = function.n;
    gvi_real at[2*LAGRANGIAN_MOST], g[2*LAGRANGIAN_MOST];
    unsigned seed = 7;
    memset(L, 0, sizeof *L);
    L->function = function;
    L->user = user;
    if (n < 1 || n > LAGRANGIAN_MOST) {
        snprintf(L->why, sizeof L->why, "n is %d, there is room for %d: define LAGRANGIAN_MOST before lagrangian.h", n,
                 LAGRANGIAN_MOST);
        return L->why;
    }
    if (!q || !w || !lagrangian_finite(n, q) || !lagrangian_finite(n, w) || !lagrangian_finite(1, &t))
        return lagrangian_refuse(L, "the start is NULL or not finite: t, q, %s%s", of, "", 0);
    gvi_real value = lagrangian_at(&function, user, t, q, w, g, g + n);
    if (!lagrangian_finite(1, &value)) return lagrangian_refuse(L, "%s is not finite at the start", name, of, 0);
    for (int i = 0; i < 2*n; ++i)
        if (!lagrangian_finite(1, g + i))
            return lagrangian_refuse(L, "d%s/d%s[%d] is not finite at the start", name, i < n ? "q" : of, i%n);
    for (int sample = 0; sample < 3; ++sample) {
        const gvi_real reach = (gvi_real)(sample ? 0.05 : 0);
        for (int d = 0; d < 2*n; ++d) {
            const gvi_real *z = d < n ? q : w, size = lagrangian_largest(n, z);
            at[d] = z[d%n] + reach*(size > 0 ? size : 1)*lagrangian_random(&seed);
        }
        if (lagrangian_compare(L, t + reach, at, at + n, name, of)) return L->why;
    }
    return NULL;
}

/* H [n*n]: d2L/dw2 at (q, w), from dL/dw at w_j - d and w_j + d; and how far rounding may be off. */
static inline void lagrangian_hessian(const lagrangian *L, gvi_real t, const gvi_real *q, gvi_real *w, gvi_real d, gvi_real *H,
                                      gvi_real *rounding)
{
    const int n = L->function.n;
    gvi_real down[LAGRANGIAN_MOST], up[LAGRANGIAN_MOST];
    for (int j = 0; j < n; ++j) {
        const gvi_real was = w[j];
        w[j] = was - d;
        const gvi_real from = w[j];
        lagrangian_at(&L->function, L->user, t, q, w, NULL, down);
        w[j] = was + d;
        const gvi_real width = w[j] - from;
        lagrangian_at(&L->function, L->user, t, q, w, NULL, up);
        w[j] = was;
        for (int i = 0; i < n; ++i) {
            H[i*n + j] = (up[i] - down[i])/width;
            rounding[i*n + j] = 2048*lagrangian_eps()*(lagrangian_abs_of(up[i]) + lagrangian_abs_of(down[i]))/width;
        }
    }
}

enum { LAGRANGIAN__MATRIX = LAGRANGIAN_MOST*LAGRANGIAN_MOST };

/* What is known of L after some states; L->M is M at the start, by v around 0, here d2L/dv2 at the start itself. */
struct lagrangian__found { gvi_real here[LAGRANGIAN__MATRIX]; int quadratic, constant, linear; };

/* One more state.  Nothing is learned where L is not finite.  Each entry counts by its own size: masses may
   differ by any factor.                                                       */
static inline int lagrangian_learn(lagrangian *L, struct lagrangian__found *found, gvi_real t, const gvi_real *q, gvi_real *w,
                                   gvi_real speed, int first)
{
    const int n = L->function.n;
    gvi_real zero[LAGRANGIAN_MOST], a[LAGRANGIAN_MOST], M[LAGRANGIAN__MATRIX], H[LAGRANGIAN__MATRIX],
             of_M[LAGRANGIAN__MATRIX], of_H[LAGRANGIAN__MATRIX];          /* rounding */
    for (int i = 0; i < n; ++i) zero[i] = 0;
    lagrangian_at(&L->function, L->user, t, q, zero, NULL, a);
    lagrangian_hessian(L, t, q, zero, speed, M, of_M);
    lagrangian_hessian(L, t, q, w, speed/4, H, of_H);
    if (!lagrangian_finite(n, a) || !lagrangian_finite(n*n, M) || !lagrangian_finite(n*n, H)) return 0;
    for (int i = 0; i < n; ++i) {
        const gvi_real mass = lagrangian_abs_of(M[i*n + i]);
        if (lagrangian_abs_of(a[i]) > 16*lagrangian_eps()*mass*speed) found->linear = 1;
        for (int j = 0; j < n; ++j) {
            const int at = i*n + j;
            const gvi_real size = 256*lagrangian_eps()*GVI_SQRT(mass)*GVI_SQRT(lagrangian_abs_of(M[j*n + j]));
            if (first) {
                L->M[at] = lagrangian_abs_of(M[at]) <= of_M[at] + size ? 0 : M[at];
                found->here[at] = lagrangian_abs_of(H[at]) <= of_H[at] + size ? 0 : H[at];
            }
            if (lagrangian_abs_of(M[at] - H[at]) > of_M[at] + of_H[at] + size) found->quadratic = 0;
            if (lagrangian_abs_of(M[at] - L->M[at]) > of_M[at] + size) {
                L->varies[at] = 1;
                found->constant = 0;
            }
        }
    }
    return 1;
}

/* Is there kinetic energy in all directions?                                  */
static inline const char *lagrangian_check_mass(lagrangian *L, struct lagrangian__found *found)
{
    const int n = L->function.n;
    gvi_real pivot[LAGRANGIAN_MOST + 1];
    if (found->quadratic) memcpy(found->here, L->M, sizeof found->here);     // the same, and v adds no rounding
    if (lagrangian_largest(n*n, found->here) <= 0)
        return lagrangian_refuse(L, "%s is linear in %s: its equations are of first order; give H(t,q,p) by HAMILTONIAN", "L", "v", 0);
    for (int i = 0; i < n; ++i)
        if (lagrangian_largest(n, found->here + i*n) <= 0)
            return lagrangian_refuse(L, "%s has no kinetic energy in q%s[%d] at the start", "L", "", i);
    for (int i = 0; i < n; ++i) {                  // each coordinate in units that make its own mass 1
        const gvi_real own = lagrangian_abs_of(found->here[i*n + i]), unit = own > 0 ? GVI_SQRT(own) : 1;
        for (int j = 0; j < n; ++j) {
            found->here[i*n + j] /= unit;
            found->here[j*n + i] /= unit;
        }
    }
    if (gvi_lu_factor(n, found->here, pivot) != GVI_OK)
        return lagrangian_refuse(L, "%s has no kinetic energy in some direction: d2L/d%s2 is singular at the start", "L", "v", 0);
    return NULL;
}

/* Finds out what L is, from the start and from states near it, on scales of 1/10, 1 and 3 of q and v.
   Returns NULL, or a sentence that says why L is refused.                     */
static inline const char *lagrangian_init(lagrangian *L, lagrangian_function function, const void *user, gvi_real t,
                                          const gvi_real *q, const gvi_real *v)
{
    const int n = function.n;
    gvi_real x[LAGRANGIAN_MOST], w[LAGRANGIAN_MOST];
    struct lagrangian__found found = { { 0 }, 1, 1, 0 };
    unsigned seed = 1;
    int known = 0;                    /* is L defined at rest, where the start is? */
    if (lagrangian_begin(L, function, user, t, q, v, "L", "v")) return L->why;

    gvi_real size = lagrangian_largest(n, q), speed = lagrangian_largest(n, v);
    if (size <= 0) size = 1;
    if (speed <= 0) speed = 1;
    for (int sample = 0; sample < 12; ++sample) {
        const gvi_real reach = (gvi_real)(sample == 0 ? 0 : sample < 6 ? 0.1 : sample < 9 ? 1 : 3);
        for (int i = 0; i < n; ++i) {
            x[i] = q[i] + reach*size*lagrangian_random(&seed);
            w[i] = v[i] + (reach > 0)*speed*lagrangian_random(&seed)/2;
        }
        const gvi_real time = t + reach*lagrangian_random(&seed);
        for (gvi_real part = 1; part > (gvi_real)1e-4; part /= 4) {  // slower where L is not defined: speed of light
            const int learned = lagrangian_learn(L, &found, time, x, w, part*speed, sample == 0);
            if (sample == 0) known |= learned;
            if (learned) break;
            for (int i = 0; i < n; ++i) w[i] = v[i] + (w[i] - v[i])/4;
        }
    }
    if (known && lagrangian_check_mass(L, &found)) return L->why;
    L->kind = !known || !found.quadratic || (found.linear && !found.constant) ? LAGRANGIAN_GENERAL
            : !found.constant ? LAGRANGIAN_MASS : found.linear ? LAGRANGIAN_LINEAR : LAGRANGIAN_POTENTIAL;
    return NULL;
}

static inline const char *lagrangian_text(const lagrangian *L)
{
    switch (L->kind) {
    case LAGRANGIAN_POTENTIAL: return "v'Mv/2 - V(t,q)";
    case LAGRANGIAN_LINEAR:    return "v'Mv/2 + a(t,q)'v - V(t,q)";
    case LAGRANGIAN_MASS:      return "v'M(t,q)v/2 - V(t,q)";
    case LAGRANGIAN_GENERAL:   return "of no special form";
    default:                   return "refused";
    }
}

/* -------------------------------------------------------------- effect and mass */

/* What lagrangian_add is asked for most: derivatives by q at v, or with v NULL at rest. */
static inline lagrangian_wanted lagrangian_want(const lagrangian *L, const gvi_points *x, const gvi_real *v, gvi_real scale)
{
    lagrangian_wanted a;
    memset(&a, 0, sizeof a);
    a.x = x;
    a.w = v;
    a.one = -1;
    a.scale = scale;
    a.by_q = x->f;
    a.end = x->n;
    a.apart = x->stride;
    a.user = L->user;
    return a;
}

/* f += dL/dq at v = 0, kept for lagrangian_gradient, which the library asks for next, at the same points. */
static inline void lagrangian_rest(lagrangian *L, const gvi_points *x)
{
    lagrangian_wanted a = lagrangian_want(L, x, NULL, 1);
    const int length = x->n*x->stride;
    if (L->kind == LAGRANGIAN_MASS && length <= LAGRANGIAN__KEPT) {
        a.by_q = L->rest;
        memset(L->rest, 0, (size_t)length*sizeof *L->rest);
        memcpy(L->q, x->q, (size_t)length*sizeof *L->q);
        L->t = x->t[x->count - 1];
        L->kept = length;
    }
    L->function.add(&a);
    for (int i = 0; i < length && a.by_q == L->rest; ++i) x->f[i] += L->rest[i];
}

/* POTENTIAL, MASS: V = -L(t,q,0) */
static inline int lagrangian_potential(const gvi_points *x, void *user)
{
    lagrangian *L = (lagrangian *)user;
    lagrangian_wanted a = lagrangian_want(L, x, NULL, -1);
    if (x->n != L->function.n) return 1;
    if (x->f) lagrangian_rest(L, x);
    a.by_q = NULL;
    a.value = x->value;
    if (x->value) L->function.add(&a);
    return 0;
}

/* LINEAR: L - v'Mv/2, dL/dv at v = 0; GENERAL: L */
static inline int lagrangian_term(const gvi_points *x, void *user)
{
    const lagrangian *L = (const lagrangian *)user;
    const int n = x->n, R = x->stride, linear = L->kind == LAGRANGIAN_LINEAR;
    lagrangian_wanted a = lagrangian_want(L, x, x->v, 1);
    if (n != L->function.n) return 1;
    a.value = x->value;
    if (!linear) a.by_w = x->dldv;
    if (a.by_q || a.by_w || a.value) L->function.add(&a);
    if (!linear) return 0;
    if (x->dldv) {
        a = lagrangian_want(L, x, NULL, 1);
        a.by_q = NULL;
        a.by_w = x->dldv;
        L->function.add(&a);
    }
    for (int k = 0; k < x->count && x->value; ++k)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) x->value[k] -= x->v[i*R + k]*L->M[i*n + j]*x->v[j*R + k]/2;
    return 0;
}

/* MASS: column j of M(q) is dL/dv at v = e_j, from the first to the last entry that varies */
static inline int lagrangian_matrix(const gvi_points *x, void *user)
{
    const lagrangian *L = (const lagrangian *)user;
    const int n = x->n, R = x->stride;
    if (n != L->function.n) return 1;
    for (int j = 0; j < n; ++j) {
        lagrangian_wanted a = lagrangian_want(L, x, NULL, 1);
        a.one = a.first = j;
        while (a.first < n && !L->varies[a.first*n + j]) ++a.first;
        while (a.end > a.first && !L->varies[(a.end - 1)*n + j]) --a.end;
        for (int i = j; i < n; ++i)
            for (int k = 0; k < x->count && (i < a.first || i >= a.end); ++k) x->mass[(i*n + j)*R + k] = L->M[i*n + j];
        a.by_q = NULL;
        a.by_w = x->mass + j*R;
        a.apart = n*R;
        if (a.first < a.end) L->function.add(&a);
    }
    return 0;
}

/* v' dM/dq v/2 = dL/dq - dL/dq at v = 0 */
static inline int lagrangian_gradient(const gvi_points *x, void *user)
{
    const lagrangian *L = (const lagrangian *)user;
    lagrangian_wanted a = lagrangian_want(L, x, x->v, 1);
    const int length = x->n*x->stride;
    L->function.add(&a);
    if (L->kept == length && !memcmp(&L->t, x->t + x->count - 1, sizeof L->t)
        && !memcmp(L->q, x->q, (size_t)length*sizeof *L->q)) {
        for (int i = 0; i < length; ++i) x->f[i] -= L->rest[i];
        return 0;
    }
    a = lagrangian_want(L, x, NULL, -1);
    L->function.add(&a);
    return 0;
}

static inline gvi_effect lagrangian_effect(lagrangian *L)
{
    gvi_effect effect;
    memset(&effect, 0, sizeof effect);
    const int potential = L->kind == LAGRANGIAN_POTENTIAL || L->kind == LAGRANGIAN_MASS;
    effect.kind = potential ? GVI_POTENTIAL : GVI_LAGRANGIAN;
    if (L->kind != LAGRANGIAN_REFUSED) effect.points = potential ? lagrangian_potential : lagrangian_term;
    effect.value = effect.points;
    effect.user = L;
    return effect;
}

static inline gvi_mass lagrangian_mass(lagrangian *L)
{
    gvi_mass mass;
    const int n = L->function.n;
    int unit = 1, diagonal = 1;
    memset(&mass, 0, sizeof mass);
    mass.user = L;
    mass.kind = L->kind == LAGRANGIAN_MASS ? GVI_MASS_POSITION : GVI_MASS_NONE;
    if (L->kind == LAGRANGIAN_MASS) {
        mass.points = lagrangian_matrix;
        mass.gradient = lagrangian_gradient;
    }
    if (L->kind != LAGRANGIAN_POTENTIAL && L->kind != LAGRANGIAN_LINEAR) return mass;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const gvi_real m = L->M[i*n + j];
            if (i != j && (m < 0 || m > 0)) diagonal = 0;
            if (i == j && (m < 1 || m > 1)) unit = 0;
        }
    for (int i = 0; i < n && diagonal; ++i) L->diagonal[i] = L->M[i*n + i];
    mass.kind = diagonal ? unit ? GVI_MASS_UNIT : GVI_MASS_DIAGONAL : GVI_MASS_DENSE;
    mass.matrix = !diagonal ? L->M : unit ? NULL : L->diagonal;
    return mass;
}

/* ------------------------------------------------------------------- H(t,q,p)

   v = dH/dp as mass.velocity, and f = -dH/dq, dL/dv = p, L = p'v - H as a Lagrangian term.  The term
   gets q and v, not p: it takes p from the call of mass.velocity before it, where q and v are the
   same arrays, and fails where they are not (gvi_start; Newton's method).      */

typedef struct hamiltonian {
    lagrangian_function function;
    const void         *user;
    const gvi_real     *q, *p, *v;    /* of the last call of mass.velocity     */
    lagrangian          look;         /* kind, why                             */
} hamiltonian;

/* Returns NULL, or a sentence that says why H is refused.                     */
static inline const char *hamiltonian_init(hamiltonian *H, lagrangian_function function, const void *user, gvi_real t,
                                           const gvi_real *q, const gvi_real *p)
{
    memset(H, 0, sizeof *H);
    H->function = function;
    H->user = user;
    const char *why = lagrangian_begin(&H->look, function, user, t, q, p, "H", "p");
    if (why) H->function.add = NULL;
    return why;
}

static inline int hamiltonian_velocity(const gvi_points *x, void *user)
{
    hamiltonian *H = (hamiltonian *)user;
    lagrangian_wanted a = lagrangian_want(&H->look, x, x->p, 1);
    if (x->n != H->function.n) return 1;
    a.by_q = NULL;
    a.by_w = x->velocity;
    memset(x->velocity, 0, (size_t)(x->n*x->stride)*sizeof *x->velocity);
    H->function.add(&a);
    H->q = x->q;
    H->p = x->p;
    H->v = x->velocity;
    return 0;
}

static inline int hamiltonian_term(const gvi_points *x, void *user)
{
    const hamiltonian *H = (const hamiltonian *)user;
    const int n = x->n, R = x->stride;
    if (!H->p || x->q != H->q || x->v != H->v) return 1;
    lagrangian_wanted a = lagrangian_want(&H->look, x, H->p, -1);
    a.value = x->value;
    if (a.by_q || a.value) H->function.add(&a);
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < x->count; ++k) {
            if (x->dldv) x->dldv[i*R + k] += H->p[i*R + k];
            if (x->value) x->value[k] += H->p[i*R + k]*x->v[i*R + k];
        }
    return 0;
}

static inline gvi_effect hamiltonian_effect(hamiltonian *H)
{
    gvi_effect effect;
    memset(&effect, 0, sizeof effect);
    effect.kind = GVI_LAGRANGIAN;
    if (H->function.add) effect.points = effect.value = hamiltonian_term;
    effect.user = H;
    return effect;
}

static inline gvi_mass hamiltonian_mass(hamiltonian *H)
{
    gvi_mass mass;
    memset(&mass, 0, sizeof mass);
    mass.kind = GVI_MASS_NONE;
    mass.velocity = hamiltonian_velocity;
    mass.user = H;
    return mass;
}
#endif
