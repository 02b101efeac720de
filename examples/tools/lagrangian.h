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

   Functions: sqrt cbrt exp log pow, sin cos tan asin acos atan atan2, sinh cosh tanh asinh acosh atanh,
   hypot fabs.  The same text compiles as C and as C++.  There is no `if (q[0] < 0)`, because L has to be
   smooth: a step over a kink, as of fabs at 0, is of order 2 at most.  1/2 is 0, as everywhere in C.

   C99 with gcc or clang, or C++11.

   First derivatives of L are exact to rounding.  In C, number is complex, and the imaginary part
   carries the derivative by one coordinate (complex step); in C++ a dual number carries those by
   all of them.  lagrangian_init looks at L at the start and at many distances, times and speeds, small
   and large, for what it is:

     LAGRANGIAN_POTENTIAL    v'Mv/2 - V(t,q)              steps without velocities
     LAGRANGIAN_LINEAR       v'Mv/2 + a(t,q)'v - V        momenta
     LAGRANGIAN_MASS         v'M(t,q)v/2 - V(t,q)         momenta
     LAGRANGIAN_MASS_LINEAR  v'M(t,q)v/2 + a(t,q)'v - V   momenta
     LAGRANGIAN_GENERAL      anything else                Newton's method

   L.kind says which.  No look at the start shows that L is so everywhere.  Therefore the callbacks
   watch: now and then they compare a dL/dv_i of L with what L.kind says, where the motion is, and in C a
   derivative with a difference.  What is off by more than rounding makes the step fail, the state stays
   as it was before it, and gvi_why says where and what to set: L.kind = LAGRANGIAN_MASS, say, between
   lagrangian_init and lagrangian_effect.  Of the first kind, with many coordinates, -dV/dq by hand saves
   most.

   Refused, with a sentence: derivatives lost to a `double`; L not finite at the start; no kinetic
   energy in a coordinate; a multiplier; a length, sqrt(v'g(q)v); n above LAGRANGIAN_MOST (32; define
   it before the header).  By the callbacks (GVI_E_CALLBACK): a desc.n that is another.

   Constraints, rolling and friction, typed likewise, are rows for desc.effects by themselves:

     HOLDS(rod, 2, 1) { row[0] = q[0]*q[0] + q[1]*q[1] - 1; }              // t, q, user; n, rows: g(t,q)
     ROLLS(edge, 3, 1) { row[0] = sin(q[2])*v[0] - cos(q[2])*v[1]; }       // A(t,q)v + a(t,q)
     DISSIPATION(drag, 2) { return 0.1*(v[0]*v[0] + v[1]*v[1])/2; }        // Rayleigh's F(t,q,v): f = -dF/dv

     { .kind = GVI_CONSTRAINT, .points = rod, .rows = 1 }
     { .kind = GVI_NONHOLONOMIC, .points = edge, .rows = 1 }
     { .kind = GVI_FORCE, .points = drag }

   A row of ROLLS that is not linear in v fails, and so does, in C, one that has lost a derivative.

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

/* Numbers are double where the library's are float: products of small ones do not underflow. */
#if GVI__KIND == 1
typedef double lagrangian_real;
#define LAGRANGIAN__SQRT(x) sqrt(x)
#else
typedef GVI_REAL lagrangian_real;
#define LAGRANGIAN__SQRT(x) GVI_SQRT(x)
#endif

/* What is wanted of a function F(t,q,w), or of rows of them, at the points of x: `scale` times its value and its
   derivatives, added to what is not NULL.                                      */
typedef struct lagrangian_wanted {
    const gvi_points *x;              /* t, q                                   */
    const gvi_real   *w;              /* [n][stride] v or p; NULL: 0, but       */
    int               one;            /* w[one] = 1; -1: nowhere                */
    lagrangian_real   times;          /* w, or the 1, times this                */
    lagrangian_real   scale;
    lagrangian_real   least;          /* not 0: nothing where w is 0, no derivative below `least` times the value */
    gvi_real         *value, *by_q, *by_w;         /* [rows][stride], [rows*n][stride] */
    int               first, end, apart;  /* of by_w: these coordinates, [.][apart] */
    const gvi_real   *along;          /* [2n] if not NULL: of derivatives only that in this direction */
    gvi_real         *by_along;       /* [count]                                */
    const void       *user;
    gvi_real         *by_t;           /* [rows][stride], with by_q alone        */
} lagrangian_wanted;

typedef struct lagrangian_function {
    int n;
    void (*add)(const lagrangian_wanted *wanted);
} lagrangian_function;

LAGRANGIAN__INLINE int lagrangian_is_zero(lagrangian_real x) { return x <= 0 && x >= 0; }

/* Is there nothing to add at point k? */
LAGRANGIAN__INLINE int lagrangian_rests(const lagrangian_wanted *a, int k)
{
    if (!(a->least > 0)) return 0;
    for (int i = 0; i < a->x->n; ++i)
        if (!lagrangian_is_zero((lagrangian_real)a->w[i*a->x->stride + k])) return 0;
    return 1;
}

static inline int lagrangian_holds(const lagrangian_function *F, int rows, gvi_real *room, const gvi_points *x, void *user);
static inline int lagrangian_rolls(const lagrangian_function *F, int rows, gvi_real *room, const gvi_points *x, void *user);
static inline int lagrangian_dissipates(const lagrangian_function *F, const gvi_points *x, void *user);

/* -------------------------------------------------- numbers with a derivative

   y of x, and dy/dx; z of x and y, dz/dx and dz/dy                             */
#define LAGRANGIAN__OF_ONE(OF)                                                                  \
    OF(sqrt, LAGRANGIAN__SQRT(x), 1/(2*y))                                                      \
    OF(cbrt, cbrt(x), 1/(3*y*y))                                                                \
    OF(exp, exp(x), y)                                                                          \
    OF(log, log(x), 1/x)                                                                        \
    OF(sin, sin(x), cos(x))                                                                     \
    OF(cos, cos(x), -sin(x))                                                                    \
    OF(tan, tan(x), 1 + y*y)                                                                    \
    OF(asin, asin(x), 1/sqrt((1 - x)*(1 + x)))                                                  \
    OF(acos, acos(x), -1/sqrt((1 - x)*(1 + x)))                                                 \
    OF(atan, atan(x), 1/(1 + x*x))                                                              \
    OF(sinh, sinh(x), cosh(x))                                                                  \
    OF(cosh, cosh(x), sinh(x))                                                                  \
    OF(tanh, tanh(x), (1 - y)*(1 + y))                                                          \
    OF(asinh, asinh(x), 1/sqrt(1 + x*x))                                                        \
    OF(acosh, acosh(x), 1/sqrt((x - 1)*(x + 1)))                                                \
    OF(atanh, atanh(x), 1/((1 - x)*(1 + x)))                                                    \
    OF(fabs, fabs(x), x < 0 ? -1 : 1)
#define LAGRANGIAN__OF_TWO(OF)                                                                  \
    OF(pow, pow(x, y), y*pow(x, y - 1), z*log(x))                                               \
    OF(atan2, atan2(x, y), y/(x*x + y*y), -x/(x*x + y*y))                                       \
    OF(hypot, hypot(x, y), x/z, y/z)

#ifndef __cplusplus
#include <tgmath.h>
#undef I                              /* <complex.h> comes with it; I is a user's name */

/* Functions of a number keep the first derivative alone: sqrt takes a third of the time of csqrt. */
#if GVI__KIND == 1
typedef double complex number;
#else
typedef GVI_REAL complex number;
#endif
#define LAGRANGIAN__STEP ((lagrangian_real)0x1p-332)
enum { LAGRANGIAN__LOSES = 1 };       /* a derivative, where a double is given a number */

LAGRANGIAN__INLINE number lagrangian_number(lagrangian_real value, lagrangian_real derivative)
{
    union { number z; lagrangian_real part[2]; } u;
    u.part[0] = value;
    u.part[1] = derivative;
    return u.z;
}

#define LAGRANGIAN__NUMBER(name, value, slope)                                                  \
    static inline number lagrangian_##name(number a)                                            \
    {                                                                                           \
        const lagrangian_real x = creal(a), d = cimag(a);                                       \
        if (lagrangian_is_zero(d)) return value;                                                \
        const lagrangian_real y = value;                                                        \
        return lagrangian_number(y, (slope)*d);                                                 \
    }
#define LAGRANGIAN__NUMBERS(name, value, slope_x, slope_y)                                      \
    LAGRANGIAN__INLINE number lagrangian_##name(number a, number b)                             \
    {                                                                                           \
        const lagrangian_real x = creal(a), y = creal(b), dx = cimag(a), dy = cimag(b), z = value; \
        const lagrangian_real by_x = lagrangian_is_zero(dx) ? 0 : (slope_x)*dx;                 \
        return lagrangian_number(z, lagrangian_is_zero(dy) ? by_x : by_x + (slope_y)*dy);       \
    }
LAGRANGIAN__OF_ONE(LAGRANGIAN__NUMBER)
LAGRANGIAN__OF_TWO(LAGRANGIAN__NUMBERS)

/* of complex numbers these, of anything else what <math.h> has */
#define LAGRANGIAN__EITHER(x, name)                                                             \
    (__extension__ _Generic((x), float complex: lagrangian_##name, double complex: lagrangian_##name, \
                            long double complex: lagrangian_##name, float: name##f, long double: name##l, default: name))
#undef sqrt
#undef cbrt
#undef exp
#undef log
#undef sin
#undef cos
#undef tan
#undef asin
#undef acos
#undef atan
#undef sinh
#undef cosh
#undef tanh
#undef asinh
#undef acosh
#undef atanh
#undef fabs
#undef pow
#undef atan2
#undef hypot
#define sqrt(x)     LAGRANGIAN__EITHER(x, sqrt)(x)
#define cbrt(x)     LAGRANGIAN__EITHER(x, cbrt)(x)
#define exp(x)      LAGRANGIAN__EITHER(x, exp)(x)
#define log(x)      LAGRANGIAN__EITHER(x, log)(x)
#define sin(x)      LAGRANGIAN__EITHER(x, sin)(x)
#define cos(x)      LAGRANGIAN__EITHER(x, cos)(x)
#define tan(x)      LAGRANGIAN__EITHER(x, tan)(x)
#define asin(x)     LAGRANGIAN__EITHER(x, asin)(x)
#define acos(x)     LAGRANGIAN__EITHER(x, acos)(x)
#define atan(x)     LAGRANGIAN__EITHER(x, atan)(x)
#define sinh(x)     LAGRANGIAN__EITHER(x, sinh)(x)
#define cosh(x)     LAGRANGIAN__EITHER(x, cosh)(x)
#define tanh(x)     LAGRANGIAN__EITHER(x, tanh)(x)
#define asinh(x)    LAGRANGIAN__EITHER(x, asinh)(x)
#define acosh(x)    LAGRANGIAN__EITHER(x, acosh)(x)
#define atanh(x)    LAGRANGIAN__EITHER(x, atanh)(x)
#define fabs(x)     LAGRANGIAN__EITHER(x, fabs)(x)
#define pow(x, y)   LAGRANGIAN__EITHER((x) + (y), pow)(x, y)
#define atan2(y, x) LAGRANGIAN__EITHER((y) + (x), atan2)(y, x)
#define hypot(x, y) LAGRANGIAN__EITHER((x) + (y), hypot)(x, y)

/* gcc: products and quotients in line, without the rescue of infinite ones (of squares in a quotient, at 1e154) */
#if defined(__GNUC__) && !defined(__clang__) && GVI__KIND != 1
#define LAGRANGIAN__PLAIN __attribute__((optimize("cx-limited-range")))
#else
#define LAGRANGIAN__PLAIN
#endif

/* Returns the first row; the others are in row[] */
typedef number lagrangian_body(number t, const number *q, const number *w, number *row, const void *user);

LAGRANGIAN__INLINE gvi_real lagrangian_slope_of(number y, const lagrangian_wanted *a, lagrangian_real by)
{
    if (a->least > 0 && fabs(cimag(y)) <= a->least*LAGRANGIAN__STEP*fabs(creal(y))) return 0;
    return (gvi_real)(by*cimag(y));
}

/* One number after the other; z[2n + 1 + rows]: t, q, w and the rows.  `timed`, known to the compiler: by t as well? */
LAGRANGIAN__INLINE void lagrangian_add(lagrangian_body *F, int n, int rows, int timed, number *z, const lagrangian_wanted *wanted)
{
    const lagrangian_wanted own = *wanted, *a = &own;         // which no output overlaps
    const gvi_points *x = a->x;
    const int w = n + 1, from = timed && a->by_t ? 0 : a->by_q ? 1 : w + a->first, to = a->by_w ? w + a->end : w, R = x->stride;
    const lagrangian_real by = a->scale/LAGRANGIAN__STEP;
    number *row = z + w + n;
    for (int k = 0; k < x->count; ++k) {
        if (lagrangian_rests(a, k)) continue;
        if (timed) z[0] = x->t[k];
        for (int i = 0; i < n; ++i) {
            z[1 + i] = x->q[i*R + k];
            z[w + i] = a->w ? a->times*(lagrangian_real)a->w[i*R + k] : i == a->one ? a->times : 0;
        }
        for (int i = 0; a->along && i < 2*n; ++i)
            z[1 + i] = lagrangian_number(creal(z[1 + i]), (lagrangian_real)a->along[i]*LAGRANGIAN__STEP);
        int d = a->along ? to : from;
        number y;
        do {
            const lagrangian_real at = d < to ? creal(z[d]) : 0;
            if (d < to) z[d] = lagrangian_number(at, LAGRANGIAN__STEP);
            for (int r = 0; r < rows && timed; ++r) row[r] = 0;
            y = F(timed ? z[0] : (number)x->t[k], z + 1, z + w, row, a->user);
            if (d >= to) break;
            z[d] = at;
            for (int r = 0; r < rows; ++r) {
                gvi_real *slope = timed && d == 0 ? a->by_t + r*R : d < w ? a->by_q + (r*n + d - 1)*R : a->by_w + (r*n + d - w)*a->apart;
                slope[k] += lagrangian_slope_of(r ? row[r] : y, a, by);
            }
        } while (++d < to);
        if (a->along) a->by_along[k] += lagrangian_slope_of(y, a, by);
        for (int r = 0; r < rows && a->value; ++r) a->value[r*R + k] += (gvi_real)(a->scale*creal(r ? row[r] : y));
    }
}

/* leave: `return` where name_at returns its one row */
#define LAGRANGIAN__DECLARE(name, n, rows, timed, type, leave)                                  \
    LAGRANGIAN__INLINE type name##_at(number, const number *, const number *, number *, const void *); \
    LAGRANGIAN__INLINE number name##_rows(number lagrangian_t, const number *lagrangian_q, const number *lagrangian_w, \
                                          number *lagrangian_row, const void *lagrangian_user)  \
    {                                                                                           \
        leave name##_at(lagrangian_t, lagrangian_q, lagrangian_w, lagrangian_row, lagrangian_user); \
        return lagrangian_row[0];                                                               \
    }                                                                                           \
    LAGRANGIAN__PLAIN static void name##_add(const lagrangian_wanted *lagrangian_a)             \
    {                                                                                           \
        number lagrangian_z[2*(n) + 1 + (rows)];                                                \
        lagrangian_add(name##_rows, n, rows, timed, lagrangian_z, lagrangian_a);                \
    }
#define LAGRANGIAN__BODY(name, type, w, row)                                                    \
    LAGRANGIAN__INLINE type name##_at(LAGRANGIAN__UNUSED number t, LAGRANGIAN__UNUSED const number *q, \
                                      LAGRANGIAN__UNUSED const number *w, LAGRANGIAN__UNUSED number *row, \
                                      LAGRANGIAN__UNUSED const void *user)

#else
#include <cmath>
enum { LAGRANGIAN__LOSES = 0 };       /* what would lose a derivative does not compile */

/* A value and N derivatives. */
template <int N> struct lagrangian_dual {
    lagrangian_real value, d[N];
    lagrangian_dual(lagrangian_real a = 0) : value(a) { for (int i = 0; i < N; ++i) d[i] = 0; }

    /* f(a) with slope f'(a); f(a, b) likewise */
    static lagrangian_dual of(lagrangian_real f, lagrangian_real slope, const lagrangian_dual &a)
    {
        lagrangian_dual y(f);
        for (int i = 0; i < N; ++i) y.d[i] = slope*a.d[i];
        return y;
    }
    static lagrangian_dual of(lagrangian_real f, lagrangian_real slope_a, const lagrangian_dual &a, lagrangian_real slope_b,
                              const lagrangian_dual &b)
    {
        lagrangian_dual y(f);
        for (int i = 0; i < N; ++i) y.d[i] = slope_a*a.d[i] + slope_b*b.d[i];
        return y;
    }
    typedef lagrangian_dual number;
    friend number operator-(const number &a) { return of(-a.value, -1, a); }
    friend number operator+(const number &a) { return a; }
    friend number operator+(const number &a, const number &b) { return of(a.value + b.value, 1, a, 1, b); }
    friend number operator+(const number &a, lagrangian_real b) { return of(a.value + b, 1, a); }
    friend number operator+(lagrangian_real a, const number &b) { return of(a + b.value, 1, b); }
    friend number operator-(const number &a, const number &b) { return of(a.value - b.value, 1, a, -1, b); }
    friend number operator-(const number &a, lagrangian_real b) { return of(a.value - b, 1, a); }
    friend number operator-(lagrangian_real a, const number &b) { return of(a - b.value, -1, b); }
    friend number operator*(const number &a, const number &b) { return of(a.value*b.value, b.value, a, a.value, b); }
    friend number operator*(const number &a, lagrangian_real b) { return of(a.value*b, b, a); }
    friend number operator*(lagrangian_real a, const number &b) { return of(a*b.value, a, b); }
    friend number operator/(const number &a, const number &b)
    {
        const lagrangian_real r = 1/b.value, y = a.value*r;
        return of(y, r, a, -y*r, b);
    }
    friend number operator/(const number &a, lagrangian_real b) { return of(a.value/b, 1/b, a); }
    friend number operator/(lagrangian_real a, const number &b)
    {
        const lagrangian_real r = 1/b.value, y = a*r;
        return of(y, -y*r, b);
    }
    friend number &operator+=(number &a, const number &b) { return a = a + b; }
    friend number &operator-=(number &a, const number &b) { return a = a - b; }
    friend number &operator*=(number &a, const number &b) { return a = a*b; }
    friend number &operator/=(number &a, const number &b) { return a = a/b; }

    /* Functions, whose slope may be infinite: where a does not vary, neither does f(a). */
    int varies() const
    {
        int any = 0;
        for (int i = 0; i < N; ++i) any |= !lagrangian_is_zero(d[i]);
        return any;
    }
    static number steep(lagrangian_real f, lagrangian_real slope, const number &a)
    {
        number y(f);
        for (int i = 0; i < N; ++i) y.d[i] = lagrangian_is_zero(a.d[i]) ? 0 : slope*a.d[i];
        return y;
    }
#define LAGRANGIAN__NUMBER(name, f_of_x, slope)                                                 \
    friend number name(const number &a)                                                         \
    {                                                                                           \
        using namespace std;                                                                    \
        const lagrangian_real x = a.value, y = f_of_x, by_x = slope;                            \
        return (void)x, by_x - by_x >= 0 ? of(y, by_x, a) : steep(y, by_x, a);                  \
    }
#define LAGRANGIAN__NUMBERS(name, f_of_xy, slope_x, slope_y)                                    \
    friend number name(const number &a, const number &b)                                        \
    {                                                                                           \
        using namespace std;                                                                    \
        const lagrangian_real x = a.value, y = b.value, z = f_of_xy;                        \
        const number f = steep(z, slope_x, a);                                                  \
        return b.varies() ? f + steep(0, slope_y, b) : f;                                       \
    }
    LAGRANGIAN__OF_ONE(LAGRANGIAN__NUMBER)
    LAGRANGIAN__OF_TWO(LAGRANGIAN__NUMBERS)
};

/* Derivatives in one evaluation: by q at rest, by q, by w, by both, by q and t, along a direction; the value in any case. */
enum { LAGRANGIAN__REST, LAGRANGIAN__Q, LAGRANGIAN__W, LAGRANGIAN__BOTH, LAGRANGIAN__Q_T, LAGRANGIAN__ALONG };

/* gcc: loops over derivatives in line, as with -O3 */
#if defined(__GNUC__) && !defined(__clang__)
#define LAGRANGIAN__UNROLLED __attribute__((optimize("O3")))
#else
#define LAGRANGIAN__UNROLLED
#endif

inline gvi_real lagrangian_slope_of(lagrangian_real value, lagrangian_real slope, const lagrangian_wanted *a)
{
    if (a->least > 0 && std::fabs(slope) <= a->least*std::fabs(value)) return 0;
    return (gvi_real)(a->scale*slope);
}

template <class F, int n, int rows, int what> LAGRANGIAN__UNROLLED inline void lagrangian_add(const lagrangian_wanted *wanted)
{
    const lagrangian_wanted own = *wanted, *a = &own;         // which no output overlaps
    enum { along = what == LAGRANGIAN__ALONG, by_q = what != LAGRANGIAN__W && !along, by_t = what == LAGRANGIAN__Q_T,
           by_w = what == LAGRANGIAN__W || what == LAGRANGIAN__BOTH, w_at = by_q ? n : 0 };
    typedef lagrangian_dual<along ? 1 : by_q && by_w ? 2*n : n + by_t> number;
    const gvi_points *x = a->x;
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        number t((lagrangian_real)x->t[k]), q[n], w[n], row[rows];
        if (lagrangian_rests(a, k)) continue;
        if (by_t) t.d[by_t ? n : 0] = 1;
        for (int i = 0; i < n; ++i) {
            q[i].value = (lagrangian_real)x->q[i*R + k];
            if (what != LAGRANGIAN__REST) w[i].value = a->w ? a->times*(lagrangian_real)a->w[i*R + k] : i == a->one ? a->times : 0;
            if (by_q) q[i].d[i] = 1;
            if (by_w) w[i].d[w_at + i] = 1;
            if (along && a->along) q[i].d[0] = (lagrangian_real)a->along[i], w[i].d[0] = (lagrangian_real)a->along[n + i];
        }
        const number first = F().rows(t, q, w, row, a->user);
        if (along && a->along) a->by_along[k] += lagrangian_slope_of(first.value, first.d[0], a);
        for (int r = 0; r < rows; ++r) {
            const number &y = r ? row[r] : first;
            if (by_t) a->by_t[r*R + k] += lagrangian_slope_of(y.value, y.d[by_t ? n : 0], a);
            for (int i = 0; i < n && by_q; ++i) a->by_q[(r*n + i)*R + k] += lagrangian_slope_of(y.value, y.d[i], a);
            for (int i = a->first; i < a->end && by_w; ++i)
                a->by_w[(r*n + i)*a->apart + k] += lagrangian_slope_of(y.value, y.d[w_at + i], a);
            if (a->value) a->value[r*R + k] += (gvi_real)(a->scale*y.value);
        }
    }
}

template <class F, int n, int rows> inline void lagrangian_any(const lagrangian_wanted *a)
{
    if (a->along || !(a->by_q || a->by_w)) lagrangian_add<F, n, rows, LAGRANGIAN__ALONG>(a);
    else if (a->by_t) lagrangian_add<F, n, rows, LAGRANGIAN__Q_T>(a);
    else if (a->by_q && a->by_w) lagrangian_add<F, n, rows, LAGRANGIAN__BOTH>(a);
    else if (a->by_w) lagrangian_add<F, n, rows, LAGRANGIAN__W>(a);
    else if (a->w || a->one >= 0) lagrangian_add<F, n, rows, LAGRANGIAN__Q>(a);
    else lagrangian_add<F, n, rows, LAGRANGIAN__REST>(a);
}

/* leave: `return` where `at` returns its one row */
#define LAGRANGIAN__DECLARE(name, n, rows_, timed, type, leave)                                 \
    struct name##_body {                                                                        \
        template <class number> type at(number, const number *, const number *, number *, const void *) const; \
        template <class number> LAGRANGIAN__UNROLLED LAGRANGIAN__ALWAYS                         \
        number rows(number lagrangian_t, const number *lagrangian_q, const number *lagrangian_w, \
                    number *lagrangian_row, const void *lagrangian_user) const                  \
        {                                                                                       \
            leave at(lagrangian_t, lagrangian_q, lagrangian_w, lagrangian_row, lagrangian_user); \
            return lagrangian_row[0];                                                           \
        }                                                                                       \
    };                                                                                          \
    static void name##_add(const lagrangian_wanted *lagrangian_a) { lagrangian_any<name##_body, n, rows_>(lagrangian_a); }
#define LAGRANGIAN__BODY(name, type, w, row)                                                    \
    template <class number>                                                                     \
    LAGRANGIAN__UNROLLED LAGRANGIAN__ALWAYS inline type name##_body::at(                        \
        LAGRANGIAN__UNUSED number t, LAGRANGIAN__UNUSED const number *q,                        \
        LAGRANGIAN__UNUSED const number *w, LAGRANGIAN__UNUSED number *row, LAGRANGIAN__UNUSED const void *user) const
#endif

#define LAGRANGIAN__FUNCTION(name, n, w)                                                        \
    LAGRANGIAN__DECLARE(name, n, 1, 0, number, return)                                          \
    static const lagrangian_function name = { n, name##_add };                                  \
    LAGRANGIAN__BODY(name, number, w, lagrangian_row)
#define LAGRANGIAN(name, n) LAGRANGIAN__FUNCTION(name, n, v)
#define HAMILTONIAN(name, n) LAGRANGIAN__FUNCTION(name, n, p)

#define LAGRANGIAN__ROWS(name, n, m, fill)                                                      \
    LAGRANGIAN__DECLARE(name, n, m, 1, void, )                                                  \
    static int name(const gvi_points *lagrangian_x, void *user)                                 \
    {                                                                                           \
        const lagrangian_function lagrangian_f = { n, name##_add };                             \
        gvi_real lagrangian_room[4*(n) + 2*(m)];                                                \
        return fill(&lagrangian_f, m, lagrangian_room, lagrangian_x, user);                     \
    }                                                                                           \
    LAGRANGIAN__BODY(name, void, v, row)
#define HOLDS(name, n, m) LAGRANGIAN__ROWS(name, n, m, lagrangian_holds)
#define ROLLS(name, n, m) LAGRANGIAN__ROWS(name, n, m, lagrangian_rolls)

#define DISSIPATION(name, n)                                                                    \
    LAGRANGIAN__DECLARE(name, n, 1, 0, number, return)                                          \
    static int name(const gvi_points *lagrangian_x, void *user)                                 \
    {                                                                                           \
        const lagrangian_function lagrangian_f = { n, name##_add };                             \
        return lagrangian_dissipates(&lagrangian_f, lagrangian_x, user);                        \
    }                                                                                           \
    LAGRANGIAN__BODY(name, number, v, lagrangian_row)

/* ------------------------------------------------------------- F at one point */

/* w of this speed: beside what is quadratic in w all else vanishes.  2^240   */
#define LAGRANGIAN__HUGE ((lagrangian_real)1.7668470647783843e72)

static inline gvi_real lagrangian_eps(void)
{
    return sizeof(gvi_real) == sizeof(float) ? (gvi_real)FLT_EPSILON
         : sizeof(gvi_real) == sizeof(double) ? (gvi_real)DBL_EPSILON : (gvi_real)LDBL_EPSILON;
}

/* Smaller derivatives underflow: in C because of the step, in float beside values */
static inline gvi_real lagrangian_smallest(void)
{
    return sizeof(gvi_real) == sizeof(float) ? (gvi_real)(FLT_MIN/FLT_EPSILON)
                                             : (gvi_real)(DBL_MIN/DBL_EPSILON*8.75e99);      // 2^332
}

static inline gvi_real lagrangian_size(gvi_real x) { return x < 0 ? -x : x; }

static inline gvi_real lagrangian_largest(int count, const gvi_real *x)
{
    gvi_real most = 0;
    for (int i = 0; i < count; ++i)
        if (lagrangian_size(x[i]) > most) most = lagrangian_size(x[i]);
    return most;
}

/* A size of x_i: its own, or that of others, or 1 */
static inline gvi_real lagrangian_scale(int count, const gvi_real *x, int i)
{
    const gvi_real own = lagrangian_size(x[i]), most = lagrangian_largest(count, x);
    return own > 0 ? own : most > 0 ? most : 1;
}

static inline int lagrangian_finite(int count, const gvi_real *x)
{
    for (int i = 0; i < count; ++i)
        if (!(x[i] - x[i] >= 0)) return 0;
    return 1;
}

/* The same numbers on every machine, in (-1, 1) */
static inline gvi_real lagrangian_random(unsigned *seed)
{
    *seed = *seed*1664525u + 1013904223u;
    return (gvi_real)((double)(*seed >> 8 & 0xFFFFFF)/8388608.0 - 1);
}

/* A power of 2 from 2^-most to 2^most */
static inline gvi_real lagrangian_decade(unsigned *seed, int most)
{
    const int k = (int)((double)lagrangian_random(seed)*(most + 1));
    gvi_real x = 1;
    for (int i = 0; i < k; ++i) x *= 2;
    for (int i = 0; i > k; --i) x /= 2;
    return x;
}

LAGRANGIAN__INLINE gvi_points lagrangian_point(int n, const gvi_real *t, const gvi_real *q)
{
    gvi_points x;
    memset(&x, 0, sizeof x);
    x.n = n;
    x.count = x.stride = 1;
    x.t = t;
    x.q = q;
    return x;
}

/* Nothing yet, of F at w, or with w NULL at rest */
LAGRANGIAN__INLINE lagrangian_wanted lagrangian_want(const void *user, const gvi_points *x, const gvi_real *w, lagrangian_real scale)
{
    lagrangian_wanted a;
    memset(&a, 0, sizeof a);
    a.x = x;
    a.w = w;
    a.one = -1;
    a.times = 1;
    a.scale = scale;
    a.end = x->n;
    a.apart = x->stride;
    a.user = user;
    return a;
}

/* What is quadratic in w alone: F(huge w)/huge^2, and of its derivatives by q what is not left of the others */
static inline lagrangian_wanted lagrangian_want_quadratic(const void *user, const gvi_points *x, const gvi_real *w, lagrangian_real sign)
{
    lagrangian_wanted a = lagrangian_want(user, x, w, 1);
    a.times = LAGRANGIAN__HUGE;
    a.scale = sign/LAGRANGIAN__HUGE/LAGRANGIAN__HUGE;
    a.least = 1/LAGRANGIAN__HUGE;
    return a;
}

/* Value, and derivatives by q and w where there is room for them, at one point */
static inline gvi_real lagrangian_at(const lagrangian_function *F, const void *user, gvi_real t, const gvi_real *q,
                                     const gvi_real *w, gvi_real *by_q, gvi_real *by_w)
{
    const gvi_points x = lagrangian_point(F->n, &t, q);
    lagrangian_wanted a = lagrangian_want(user, &x, w, 1);
    gvi_real value = 0;
    a.value = &value;
    a.by_q = by_q;
    a.by_w = by_w;
    for (int i = 0; i < F->n && by_q; ++i) by_q[i] = 0;
    for (int i = 0; i < F->n && by_w; ++i) by_w[i] = 0;
    F->add(&a);
    return value;
}

/* The derivative in a direction [2n] */
static inline gvi_real lagrangian_along(const lagrangian_function *F, const void *user, gvi_real t, const gvi_real *q,
                                        const gvi_real *w, const gvi_real *direction)
{
    const gvi_points x = lagrangian_point(F->n, &t, q);
    lagrangian_wanted a = lagrangian_want(user, &x, w, 1);
    gvi_real slope = 0;
    a.along = direction;
    a.by_along = &slope;
    F->add(&a);
    return slope;
}

/* dF/dw_i at `times` w, over `times` */
static inline gvi_real lagrangian_slope(const lagrangian_function *F, const void *user, gvi_real t, const gvi_real *q,
                                        const gvi_real *w, lagrangian_real times, int i)
{
    const gvi_points x = lagrangian_point(F->n, &t, q);
    lagrangian_wanted a = lagrangian_want(user, &x, w, 1);
    gvi_real slope = 0;
    a.times = times;
    a.scale = 1/times;
    a.first = i;
    a.end = i + 1;
    a.apart = 0;
    a.by_w = &slope;
    F->add(&a);
    return slope;
}

/* ----------------------------------------------------------------- differences */

/* Row `row` of F at s from (t, q, w), of which `direction` [2n] tells how q and w go.  Room: at [2n], values [rows] */
typedef struct lagrangian_line {
    const lagrangian_function *F;
    const void                *user;
    gvi_real                   t, dt;
    const gvi_real            *q, *w, *direction;
    gvi_real                  *at, *values;
    int                        rows, row;
} lagrangian_line;

static inline gvi_real lagrangian_on_line(const lagrangian_line *l, gvi_real s)
{
    const int n = l->F->n;
    for (int i = 0; i < n; ++i) {
        l->at[i] = l->q[i] + s*l->direction[i];
        l->at[n + i] = l->w ? l->w[i] + s*l->direction[n + i] : 0;
    }
    const gvi_real t = l->t + s*l->dt;
    const gvi_points x = lagrangian_point(n, &t, l->at);
    lagrangian_wanted a = lagrangian_want(l->user, &x, l->at + n, 1);
    for (int r = 0; r < l->rows; ++r) l->values[r] = 0;
    a.value = l->values;
    l->F->add(&a);
    return l->values[l->row];
}

/* Nine places, at uneven distances: on a lattice rounding may look smooth. */
static const double lagrangian_places[9] = { -4, -2.87, -2.21, -0.92, 0.29, 0.83, 2.05, 2.7, 4.2 };

/* The largest fourth difference of the values there: where these are close together, rounding and noise */
static inline gvi_real lagrangian_noise(const gvi_real *y)
{
    gvi_real most = 0;
    for (int k = 0; k < 5; ++k) {
        gvi_real sum = 0;
        for (int i = k; i < k + 5; ++i) {
            double weight = 24;
            for (int j = k; j < k + 5; ++j)
                if (j != i) weight /= lagrangian_places[i] - lagrangian_places[j];
            sum += (gvi_real)weight*y[i];
        }
        if (lagrangian_size(sum) > most) most = lagrangian_size(sum);
    }
    return most;
}

/* d/ds of F on the line at 0, from central differences, each of half the width of the one before, by one of Richardson's
   extrapolations: the one that agrees best with the two before it, unless a narrower one contradicts it.
   rounding: of F because of that of its arguments.  error < 0: there are none. */
static inline gvi_real lagrangian_difference(const lagrangian_line *l, gvi_real size, gvi_real rounding, gvi_real *error)
{
    const gvi_real apart = GVI_SQRT(lagrangian_eps())/16*size;
    gvi_real near_by[9], best = 0, width = size/8, row[2] = { 0, 0 }, before = 0;
    int rows = 0;
    for (int k = 0; k < 9; ++k) near_by[k] = lagrangian_on_line(l, (gvi_real)lagrangian_places[k]*apart);
    const gvi_real noise = lagrangian_noise(near_by), grain = rounding + (lagrangian_finite(1, &noise) ? noise : 0);

    *error = -1;
    for (int k = 0; k < 40; ++k, width /= 2) {
        const gvi_real up = lagrangian_on_line(l, width), down = lagrangian_on_line(l, -width), first = (up - down)/(2*width),
                       rough = (4*lagrangian_eps()*lagrangian_size(up) + grain)/width;
        if (!lagrangian_finite(1, &first)) continue;
        const gvi_real second = first + (first - row[0])/3, change = lagrangian_size(second - row[1]),
                       off = rough + (change > before ? change : before);
        const int contradicts = lagrangian_size(second - best) > 4*(*error + off);
        if (rows++ > 2 && (*error < 0 || off < *error || contradicts)) {
            best = second;
            *error = off;
        }
        before = change;
        row[0] = first;
        row[1] = second;
    }
    return best;
}

/* A derivative by numbers against one by differences that is right up to `error`: by chance two widths may agree
   to several digits, so that what is less than 1/4096 of the whole counts as right. */
static inline int lagrangian_apart(gvi_real by_numbers, gvi_real right, gvi_real error)
{
    const gvi_real bound = 8*error + lagrangian_size(right)/4096 + lagrangian_smallest();
    return error >= 0 && lagrangian_size(by_numbers - right) > bound;
}

/* At first glance: one difference.  It is off where F bends as well; then lagrangian_difference has to be asked. */
static inline int lagrangian_seems_apart(const lagrangian_line *l, gvi_real by_numbers)
{
    const gvi_real width = (gvi_real)(1/64.0), up = lagrangian_on_line(l, width), down = lagrangian_on_line(l, -width),
                   D = (up - down)/(2*width);
    return lagrangian_size(D - by_numbers) > (lagrangian_size(D) + lagrangian_size(by_numbers))/1024
                                             + 16*lagrangian_eps()*(lagrangian_size(up) + lagrangian_size(down))/width;
}

/* Does the derivative of F along the line differ from differences? */
static inline int lagrangian_loses_on(const lagrangian_line *l)
{
    const int n = l->F->n;
    const gvi_real slope = lagrangian_along(l->F, l->user, l->t, l->q, l->w, l->direction);
    gvi_real g[2*LAGRANGIAN_MOST], rounding = 0, error;
    if (!lagrangian_seems_apart(l, slope)) return 0;
    lagrangian_at(l->F, l->user, l->t, l->q, l->w, g, g + n);
    for (int d = 0; d < 2*n; ++d) rounding += lagrangian_size(g[d]*(d < n ? l->q[d] : l->w[d - n]));
    const gvi_real right = lagrangian_difference(l, 1, lagrangian_eps()*rounding, &error);
    return lagrangian_apart(slope, right, error);
}

/* ------------------------------------------------------------------------ rows */

/* On the way from the first point to the second */
static inline int lagrangian_rows_lose(const lagrangian_function *F, int rows, gvi_real *room, const gvi_points *x, const void *user)
{
    const int n = x->n, R = x->stride;
    gvi_real *q = room, *dq = q + n, *at = dq + n;
    lagrangian_line line = { F, user, x->t[0], x->t[1] - x->t[0], q, NULL, dq, at, at + 2*n, rows, 0 };
    for (int i = 0; i < n; ++i) {
        q[i] = x->q[i*R];
        dq[i] = x->q[i*R + 1] - q[i];
    }
    for (; line.row < rows; ++line.row) {
        const gvi_real rate = x->rate[line.row*R];
        gvi_real slope = rate*line.dt, rounding = lagrangian_size(rate*line.t), error;
        for (int i = 0; i < n; ++i) {
            const gvi_real G = x->jacobian[(line.row*n + i)*R];
            slope += G*dq[i];
            rounding += lagrangian_size(G*q[i]);
        }
        if (!lagrangian_seems_apart(&line, slope)) continue;
        const gvi_real right = lagrangian_difference(&line, 1, lagrangian_eps()*rounding, &error);
        if (lagrangian_apart(slope, right, error)) return 1;
    }
    return 0;
}

static inline void lagrangian_clear(int count, gvi_real *x)
{
    for (int i = 0; i < count; ++i) x[i] = 0;
}

/* g(t,q), dg/dq and dg/dt */
static inline int lagrangian_holds(const lagrangian_function *F, int rows, gvi_real *room, const gvi_points *x, void *user)
{
    const int size = rows*x->stride;
    if (x->n != F->n || !x->g) return gvi_fail(x, "HOLDS is of another n than the scene, or .kind is not GVI_CONSTRAINT");
    lagrangian_wanted a = lagrangian_want(user, x, NULL, 1);
    lagrangian_clear(size, a.value = x->g);
    lagrangian_clear(size*x->n, a.by_q = x->jacobian);
    lagrangian_clear(size, a.by_t = x->rate);
    F->add(&a);
    if (!LAGRANGIAN__LOSES || x->count < 4 || !lagrangian_rows_lose(F, rows, room, x, user)) return 0;
    return gvi_fail(x, "a row of HOLDS has lost a derivative: is a variable in it a double that has to be a number?");
}

/* Is row A v + a at the first point that at a huge v, too? */
static inline int lagrangian_linear(const lagrangian_function *F, int rows, gvi_real *room, const gvi_points *x, const void *user)
{
    const int n = x->n, R = x->stride;
    gvi_real *q = room, *w = q + n, *values = w + n;
    const gvi_points first = lagrangian_point(n, x->t, q);
    lagrangian_wanted a = lagrangian_want(user, &first, w, 1/LAGRANGIAN__HUGE);
    for (int i = 0; i < n; ++i) {
        q[i] = x->q[i*R];
        w[i] = 1 + (gvi_real)((i*5)%7)/8;
    }
    a.times = LAGRANGIAN__HUGE;
    lagrangian_clear(rows, a.value = values);
    F->add(&a);
    for (int r = 0; r < rows; ++r) {
        gvi_real off = values[r], size = 0;
        for (int i = 0; i < n; ++i) {
            const gvi_real part = x->jacobian[(r*n + i)*R]*w[i];
            off -= part;
            size += lagrangian_size(part);
        }
        if (lagrangian_size(off) > GVI_SQRT(lagrangian_eps())*size) return 0;
    }
    return 1;
}

/* A(t,q) and a(t,q) of the row A v + a */
static inline int lagrangian_rolls(const lagrangian_function *F, int rows, gvi_real *room, const gvi_points *x, void *user)
{
    const int size = rows*x->stride;
    if (x->n != F->n || !x->jacobian) return gvi_fail(x, "ROLLS is of another n than the scene, or .kind is not GVI_NONHOLONOMIC");
    lagrangian_wanted a = lagrangian_want(user, x, NULL, 1);
    lagrangian_clear(size*x->n, a.by_w = x->jacobian);
    lagrangian_clear(size, a.value = x->rate);
    F->add(&a);
    if (lagrangian_linear(F, rows, room, x, user)) return 0;
    return gvi_fail(x, "a row of ROLLS is not linear in v, or has lost a derivative: is a variable in it a double that has to "
                       "be a number?");
}

/* f -= dF/dv */
static inline int lagrangian_dissipates(const lagrangian_function *F, const gvi_points *x, void *user)
{
    const int n = F->n, R = x->stride;
    gvi_real q[LAGRANGIAN_MOST], w[LAGRANGIAN_MOST], direction[2*LAGRANGIAN_MOST] = { 0 }, at[2*LAGRANGIAN_MOST], value;
    if (x->n != n || n > LAGRANGIAN_MOST || !x->v)
        return gvi_fail(x, "DISSIPATION is of another n than the scene, above LAGRANGIAN_MOST, or .kind is not GVI_FORCE");
    lagrangian_wanted a = lagrangian_want(user, x, x->v, -1);
    a.by_w = x->f;
    F->add(&a);

    if (!LAGRANGIAN__LOSES || x->count < 4) return 0;
    for (int i = 0; i < n; ++i) {
        q[i] = x->q[i*R];
        direction[n + i] = w[i] = x->v[i*R];
    }
    const lagrangian_line line = { F, user, x->t[0], 0, q, w, direction, at, &value, 1, 0 };
    if (!lagrangian_loses_on(&line)) return 0;
    return gvi_fail(x, "DISSIPATION has lost a derivative: is a variable in it a double that has to be a number?");
}

/* ----------------------------------------------------------- what kind is it? */

/* Which have a term linear in v: even ones; a mass that varies: those from MASS on.  GENERAL has all. */
typedef enum lagrangian_kind {
    LAGRANGIAN_REFUSED, LAGRANGIAN_POTENTIAL, LAGRANGIAN_LINEAR, LAGRANGIAN_MASS, LAGRANGIAN_MASS_LINEAR,
    LAGRANGIAN_GENERAL
} lagrangian_kind;
enum { LAGRANGIAN__TERM = 1, LAGRANGIAN__MASS_VARIES = 2, LAGRANGIAN__MATRIX = LAGRANGIAN_MOST*LAGRANGIAN_MOST };

static inline int lagrangian_has(lagrangian_kind kind, int what) { return (((int)kind - 1) & what) != 0; }

typedef struct lagrangian {
    lagrangian_kind     kind, found;  /* kind may be set, after lagrangian_init */
    lagrangian_function function;
    const void         *user;
    const char         *name, *of;    /* L and v, H and p                       */
    gvi_real            M[LAGRANGIAN__MATRIX], diagonal[LAGRANGIAN_MOST];   /* M at the start */
    unsigned char       varies[LAGRANGIAN__MATRIX];         /* does M_ij?       */
    int                 reads_q;      /* was any dL/dq seen that is not 0?      */
    /* the watch */
    int                 points;       /* since the last look                    */
    int                 looks, alert; /* alert: calls in which all points are looked at */
    int                 alarms;       /* since there was none                   */
    gvi_real            grain[LAGRANGIAN_MOST];             /* of dL/dv_i: rounding that was seen */
    gvi_real            t, q[LAGRANGIAN_MOST], v[LAGRANGIAN_MOST];  /* of the last look */
    char                why[400];
} lagrangian;

static inline const char *lagrangian_refuse(lagrangian *L, const char *text, const char *name, const char *of, int i)
{
    snprintf(L->why, sizeof L->why, text, name, of, i);
    L->kind = LAGRANGIAN_REFUSED;
    return L->why;
}

/* Are the derivatives at (q, w) those that differences show?                   */
static inline const char *lagrangian_compare(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *w)
{
    const int n = L->function.n;
    gvi_real g[2*LAGRANGIAN_MOST];
    lagrangian_at(&L->function, L->user, t, q, w, g, g + n);
    if (!lagrangian_finite(2*n, g)) return NULL;
    for (int d = 0; d < 2*n; ++d) {
        const gvi_real *z = d < n ? q : w;
        const gvi_real size = lagrangian_scale(n, z, d%n);
        gvi_real direction[2*LAGRANGIAN_MOST] = { 0 }, at[2*LAGRANGIAN_MOST], value, error;
        direction[d] = 1;
        const lagrangian_line line = { &L->function, L->user, t, 0, q, w, direction, at, &value, 1, 0 };
        const gvi_real right = lagrangian_difference(&line, size, 0, &error);
        if (!lagrangian_apart(g[d], right, error + 4*lagrangian_eps()*lagrangian_largest(2*n, g))) continue;
        snprintf(L->why, sizeof L->why,
                 "d%s/d%s[%d] is %.6g by numbers, %.6g by differences: is a variable in %s a double that has to be a number?",
                 L->name, d < n ? "q" : L->of, d%n, (double)g[d], (double)right, L->name);
        return L->why;
    }
    return NULL;
}

/* What L(t,q,v) and H(t,q,p) have to be: of a size there is room for, finite with its derivatives at the start,
   and with derivatives that are right, there and at two states near it. */
static inline const char *lagrangian_begin(lagrangian *L, lagrangian_function function, const void *user, gvi_real t,
                                           const gvi_real *q, const gvi_real *w, const char *name, const char *of)
{
    const int n = function.n;
    gvi_real at[2*LAGRANGIAN_MOST], g[2*LAGRANGIAN_MOST];
    unsigned seed = 7;
    memset(L, 0, sizeof *L);
    L->function = function;
    L->user = user;
    L->name = name;
    L->of = of;
    if (n < 1 || n > LAGRANGIAN_MOST) {
        snprintf(L->why, sizeof L->why, "n is %d, there is room for %d: define LAGRANGIAN_MOST before lagrangian.h", n,
                 LAGRANGIAN_MOST);
        return L->why;
    }
    if (!q || !w || !lagrangian_finite(n, q) || !lagrangian_finite(n, w) || !lagrangian_finite(1, &t))
        return lagrangian_refuse(L, "the start is NULL or not finite: t, q, %s%s", of, "", 0);

    const gvi_real value = lagrangian_at(&function, user, t, q, w, g, g + n);
    if (!lagrangian_finite(1, &value)) return lagrangian_refuse(L, "%s is not finite at the start", name, of, 0);
    for (int i = 0; i < 2*n; ++i)
        if (!lagrangian_finite(1, g + i))
            return lagrangian_refuse(L, "d%s/d%s[%d] is not finite at the start", name, i < n ? "q" : of, i%n);

    for (int sample = 0; sample < 3; ++sample) {
        const gvi_real reach = sample ? 8*GVI_SQRT(GVI_SQRT(lagrangian_eps())) : 0;
        for (int d = 0; d < 2*n; ++d) {
            const gvi_real *z = d < n ? q : w;
            at[d] = z[d%n] + reach*lagrangian_scale(n, z, d%n)*lagrangian_random(&seed);
        }
        if (!lagrangian_compare(L, t + reach, at, at + n)) continue;
        L->kind = LAGRANGIAN_REFUSED;
        return L->why;
    }
    return NULL;
}

/* What is 0 if L is of a kind: dL/dv_i at `times` v, over `times`, less M_i v and, if the kind has one, the linear term.
   all: any M_ij may vary, if the kind lets one. */
typedef struct lagrangian_test {
    int             i;
    lagrangian_kind kind;
    lagrangian_real times;
    int             all;
} lagrangian_test;

static inline gvi_real lagrangian_entry(const lagrangian *L, gvi_real t, const gvi_real *q, int i, int j)
{
    gvi_real one[LAGRANGIAN_MOST] = { 0 };
    one[j] = 1;
    return lagrangian_slope(&L->function, L->user, t, q, one, LAGRANGIAN__HUGE, i);
}

/* `size`: of what it is the difference of */
static inline gvi_real lagrangian_off(const lagrangian *L, const lagrangian_test *test, gvi_real t, const gvi_real *q,
                                      const gvi_real *v, gvi_real *size)
{
    const lagrangian_function *F = &L->function;
    const int n = F->n, i = test->i, huge = test->times > 1;
    gvi_real p = lagrangian_slope(F, L->user, t, q, v, test->times, i), a = 0;
    if (huge || lagrangian_has(test->kind, LAGRANGIAN__TERM))       // huge: where there is no mass, the term is all
        a = (gvi_real)((lagrangian_real)lagrangian_slope(F, L->user, t, q, NULL, 1, i)/test->times);
    if (!huge && p <= a && p >= a) {               // so slow a v that nothing is left of it beside a: at a huge one
        p = lagrangian_slope(F, L->user, t, q, v, LAGRANGIAN__HUGE, i);
        a = (gvi_real)((lagrangian_real)a/LAGRANGIAN__HUGE);
    }
    gvi_real off = p - a;
    *size = lagrangian_size(p) + lagrangian_size(a);
    for (int j = 0; j < n; ++j) {
        const gvi_real vj = v ? v[j] : 0;
        if (vj <= 0 && vj >= 0) continue;
        const int varies = lagrangian_has(test->kind, LAGRANGIAN__MASS_VARIES) && (test->all || L->varies[i*n + j]);
        const gvi_real part = (varies ? lagrangian_entry(L, t, q, i, j) : L->M[i*n + j])*vj;
        off -= part;
        *size += lagrangian_size(part);
        if (huge) *size += 4*GVI_SQRT(lagrangian_size(L->M[i*n + i]))*GVI_SQRT(lagrangian_size(L->M[j*n + j]))*lagrangian_size(vj);
    }
    return off;
}

/* Is it more than rounding?  Rounding comes and goes as q changes in its last digits, and v by up to a half, where a
   difference keeps its sign and changes smoothly.  What is rounding is left in *grain. */
static inline int lagrangian_differs(const lagrangian *L, const lagrangian_test *test, gvi_real t, const gvi_real *q,
                                     const gvi_real *v, gvi_real *grain)
{
    const gvi_real eps = lagrangian_eps(), was = grain ? *grain : 0;
    gvi_real off[9], x[LAGRANGIAN_MOST], w[LAGRANGIAN_MOST], size, rough;
    unsigned seed = 3;
    int up = 0, down = 0;
    off[0] = lagrangian_off(L, test, t, q, v, &size);
    if (!lagrangian_finite(1, off)) return 1;
    if (lagrangian_size(off[0]) <= 64*eps*size + was + lagrangian_smallest()) return 0;

    for (int s = 0; s < 9; ++s) {
        for (int k = 0; k < L->function.n; ++k) {
            x[k] = q[k]*(1 + 8*eps*lagrangian_random(&seed));
            w[k] = v ? v[k]*(1 + (gvi_real)lagrangian_places[s]/8) : 0;
        }
        off[s] = lagrangian_off(L, test, t*(1 + 8*eps*lagrangian_random(&seed)), x, w, &rough);
        if (!lagrangian_finite(1, off + s)) return 1;
        up += off[s] > 0;
        down += off[s] < 0;
    }
    const gvi_real most = lagrangian_largest(9, off);
    if ((up == 9 || down == 9) && most > 2*lagrangian_noise(off) + 64*eps*size + was) return 1;
    if (grain && 2*most > was) *grain = 2*most;
    return 0;
}

/* Linear in q_i, and without v_i: a multiplier? */
static inline int lagrangian_is_multiplier(const lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v, int i)
{
    const int n = L->function.n;
    gvi_real x[LAGRANGIAN_MOST], w[LAGRANGIAN_MOST];
    unsigned seed = 5;
    for (int k = 0; k < n; ++k) {
        x[k] = q[k] + (1 + lagrangian_size(q[k]))*lagrangian_random(&seed)/8;
        w[k] = v[k] + (1 + lagrangian_size(v[k]))*lagrangian_random(&seed)/8;
    }
    gvi_real p[LAGRANGIAN_MOST], one[LAGRANGIAN_MOST], more[LAGRANGIAN_MOST];
    lagrangian_at(&L->function, L->user, t, x, w, one, p);
    x[i] += 1 + lagrangian_size(x[i]);
    lagrangian_at(&L->function, L->user, t, x, w, more, p);
    return more[i] <= one[i] && more[i] >= one[i] && (one[i] < 0 || one[i] > 0) && lagrangian_size(p[i]) <= 0;
}

/* Is there kinetic energy in all directions? */
static inline const char *lagrangian_check_mass(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const int n = L->function.n;
    gvi_real H[LAGRANGIAN__MATRIX], pivot[LAGRANGIAN_MOST + 1];
    const int known = L->kind != LAGRANGIAN_GENERAL;           // else the library finds out
    if (known && lagrangian_largest(n*n, L->M) <= 0)
        return lagrangian_refuse(L, "%s is linear in %s: its equations are of first order; give H(t,q,p) by HAMILTONIAN", "L", "v", 0);
    for (int i = 0; i < n; ++i) {
        if (known && lagrangian_largest(n, L->M + i*n) > 0) continue;
        if (lagrangian_is_multiplier(L, t, q, v, i))
            return lagrangian_refuse(L, "%s has no kinetic energy in q%s[%d] and is linear in it: is it a multiplier? Leave its term "
                                        "out, and give what it multiplies as a row, by HOLDS (GVI_CONSTRAINT)", "L", "", i);
        if (known) return lagrangian_refuse(L, "%s has no kinetic energy in q%s[%d] at the start", "L", "", i);
    }
    if (!known) return NULL;

    memcpy(H, L->M, sizeof H);
    for (int i = 0; i < n; ++i) {                  // each coordinate in units that make its own mass 1
        const gvi_real own = lagrangian_size(H[i*n + i]), unit = own > 0 ? GVI_SQRT(own) : 1;
        for (int j = 0; j < n; ++j) {
            H[i*n + j] /= unit;
            H[j*n + i] /= unit;
        }
    }
    if (gvi_lu_factor(n, H, pivot) == GVI_OK) return NULL;
    return lagrangian_refuse(L, "%s has no kinetic energy in some direction: d2L/d%s2 is singular at the start", "L", "v", 0);
}

/* Of first degree in v, as a length is: v'dL/dv = L wherever one looks */
static inline int lagrangian_is_length(const lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const int n = L->function.n;
    const gvi_real most = lagrangian_largest(n, v);
    gvi_real w[LAGRANGIAN_MOST], p[LAGRANGIAN_MOST];
    unsigned seed = 11;
    int seen = 0;
    for (int sample = 0; sample < 12; ++sample) {
        const gvi_real speed = most > 0 ? most/4 : lagrangian_decade(&seed, 20);
        for (int i = 0; i < n; ++i) w[i] = (v[i] + speed*lagrangian_random(&seed))*(gvi_real)(1 + sample);
        const gvi_real value = lagrangian_at(&L->function, L->user, t, q, w, NULL, p);
        gvi_real off = -value, size = lagrangian_size(value);
        for (int i = 0; i < n; ++i) {
            off += w[i]*p[i];
            size += lagrangian_size(w[i]*p[i]);
        }
        if (!lagrangian_finite(1, &size)) continue;
        if (lagrangian_size(off) > 64*lagrangian_eps()*size) return 0;
        ++seen;
    }
    return seen > 2;
}

static inline void lagrangian_add_to_kind(lagrangian *L, int what)
{
    L->kind = (lagrangian_kind)((((int)L->kind - 1) | what) + 1);
}

/* The smallest kind, from the one given, that covers L as it is known and dL/dv_i here */
static inline lagrangian_kind lagrangian_cover(const lagrangian *L, lagrangian_kind from, gvi_real t, const gvi_real *q,
                                               const gvi_real *v, int i)
{
    const int known = (int)L->kind - 1;
    for (int kind = (int)from; kind < (int)LAGRANGIAN_GENERAL; ++kind) {
        const lagrangian_test test = { i, (lagrangian_kind)kind, 1, 1 };
        if (((kind - 1) & known) == known && !lagrangian_differs(L, &test, t, q, v, NULL)) return test.kind;
    }
    return LAGRANGIAN_GENERAL;
}

/* One state more: what of it is not yet in L?  Nothing is learned where L is not finite at rest. */
static inline void lagrangian_learn(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const int n = L->function.n;
    gvi_real a[LAGRANGIAN_MOST], p[LAGRANGIAN_MOST], by_q[LAGRANGIAN_MOST];
    lagrangian_at(&L->function, L->user, t, q, NULL, by_q, a);
    if (!lagrangian_finite(n, a) || !lagrangian_finite(n, by_q)) return;
    if (lagrangian_largest(n, by_q) > 0) L->reads_q = 1;
    for (int i = 0; i < n; ++i) {
        const lagrangian_test term = { i, LAGRANGIAN_POTENTIAL, 1, 0 }, entry = { i, LAGRANGIAN_POTENTIAL, LAGRANGIAN__HUGE, 0 };
        if (!lagrangian_has(L->kind, LAGRANGIAN__TERM) && lagrangian_differs(L, &term, t, q, NULL, NULL))
            lagrangian_add_to_kind(L, LAGRANGIAN__TERM);
        for (int j = 0; j <= i; ++j) {
            const gvi_real M = lagrangian_entry(L, t, q, i, j);
            if (!lagrangian_finite(1, &M)) return;
            gvi_real one[LAGRANGIAN_MOST] = { 0 };
            one[j] = 1;
            if (L->varies[i*n + j] || !lagrangian_differs(L, &entry, t, q, one, NULL)) continue;
            L->varies[i*n + j] = L->varies[j*n + i] = 1;
            lagrangian_add_to_kind(L, LAGRANGIAN__MASS_VARIES);
        }
    }

    lagrangian_at(&L->function, L->user, t, q, v, NULL, p);
    for (int i = 0; i < n; ++i) {
        const lagrangian_test rest = { i, L->kind, 1, 0 };
        const int undefined = !(p[i] <= 0) && !(p[i] > 0);             // as beyond the speed of light
        if (!undefined && (!lagrangian_finite(1, p + i) || !lagrangian_differs(L, &rest, t, q, v, NULL))) continue;
        L->kind = undefined ? LAGRANGIAN_GENERAL : lagrangian_cover(L, L->kind, t, q, v, i);
        if (L->kind == LAGRANGIAN_GENERAL) return;
        for (int j = 0; j < n; ++j) L->varies[i*n + j] = L->varies[j*n + i] = 1;
    }
}

/* M at the start, where 0 up to rounding is 0 */
static inline void lagrangian_first_mass(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *a)
{
    const int n = L->function.n;
    for (int i = 0; i < n; ++i)                    // less dL/dv_i at v = 0, which is all where there is no mass
        for (int j = 0; j < n; ++j) L->M[i*n + j] = lagrangian_entry(L, t, q, i, j) - (gvi_real)((lagrangian_real)a[i]/LAGRANGIAN__HUGE);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            const gvi_real size = GVI_SQRT(lagrangian_size(L->M[i*n + i]))*GVI_SQRT(lagrangian_size(L->M[j*n + j]));
            if (lagrangian_size(L->M[i*n + j]) <= 8*lagrangian_eps()*size) L->M[i*n + j] = 0;
            L->M[j*n + i] = L->M[i*n + j];
        }
}

/* States of any size, for there are no units: every third at the place of the start, half of them at the speed of
   the start, or near it */
static inline void lagrangian_search(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const int n = L->function.n, samples = n > 8 ? 48 : 144;
    gvi_real x[LAGRANGIAN_MOST], w[LAGRANGIAN_MOST];
    unsigned seed = 1;
    for (int sample = 0; sample < samples && L->kind != LAGRANGIAN_GENERAL; ++sample) {
        const int here = sample%3 == 0, narrow = sample%4 == 1 ? 4 : 20;
        const gvi_real speed = sample%2 ? 1 : lagrangian_decade(&seed, 80),
                       wait = here ? 0 : lagrangian_scale(1, &t, 0)*lagrangian_decade(&seed, 40);
        for (int i = 0; i < n; ++i) {
            const gvi_real way = here ? 0 : lagrangian_scale(n, q, i)*lagrangian_decade(&seed, narrow);
            x[i] = q[i] + way*lagrangian_random(&seed);
            w[i] = sample ? speed*lagrangian_random(&seed) + (sample%4 < 2 ? v[i] : 0) : v[i];
        }
        lagrangian_learn(L, t + wait*lagrangian_random(&seed), x, w);
    }
}

/* Finds out what L is.  Returns NULL, or a sentence that says why L is refused. */
static inline const char *lagrangian_init(lagrangian *L, lagrangian_function function, const void *user, gvi_real t,
                                          const gvi_real *q, const gvi_real *v)
{
    const int n = function.n;
    gvi_real a[LAGRANGIAN_MOST], by_q[LAGRANGIAN_MOST];
    if (lagrangian_begin(L, function, user, t, q, v, "L", "v")) return L->why;
    lagrangian_at(&function, user, t, q, NULL, by_q, a);
    lagrangian_first_mass(L, t, q, a);
    const int quadratic = lagrangian_finite(n, a) && lagrangian_finite(n, by_q) && lagrangian_finite(n*n, L->M);
    L->kind = quadratic ? LAGRANGIAN_POTENTIAL : LAGRANGIAN_GENERAL;
    lagrangian_search(L, t, q, v);

    if (L->kind == LAGRANGIAN_GENERAL && lagrangian_is_length(L, t, q, v))
        return lagrangian_refuse(L, "%s is of first degree in %s, as a length is: any speed along the curve would do. Take "
                                    "half its square, v'g(q)v/2, whose curves are the same", "L", "v", 0);
    if (lagrangian_check_mass(L, t, q, v)) return L->why;
    L->found = L->kind;
    L->t = t;
    memcpy(L->q, q, (size_t)n*sizeof *q);
    memcpy(L->v, v, (size_t)n*sizeof *v);
    return NULL;
}

static inline const char *lagrangian_kind_text(lagrangian_kind kind)
{
    switch (kind) {
    case LAGRANGIAN_POTENTIAL:   return "v'Mv/2 - V(t,q)";
    case LAGRANGIAN_LINEAR:      return "v'Mv/2 + a(t,q)'v - V(t,q)";
    case LAGRANGIAN_MASS:        return "v'M(t,q)v/2 - V(t,q)";
    case LAGRANGIAN_MASS_LINEAR: return "v'M(t,q)v/2 + a(t,q)'v - V(t,q)";
    case LAGRANGIAN_GENERAL:     return "of no special form";
    default:                     return "refused";
    }
}

static inline const char *lagrangian_text(const lagrangian *L)
{
    if (L->kind == LAGRANGIAN_POTENTIAL && !L->reads_q) return "v'Mv/2, no q seen in it";
    return lagrangian_kind_text(L->kind);
}

/* ------------------------------------------------------------------ the watch

   Is L still what it was found to be?  One dL/dv_i at one point of 36 against what L.kind says, at the v of the step
   or, where a step makes none, at one that its points show.  Of C every fourth look also compares the derivative
   along the motion with a difference.  What is off makes the callback fail, and from then on all points
   are looked at until none is.  After as many alarms in a row as gvi_advance has tries every step fails: it
   would creep up to the place in ever shorter ones.                            */
enum { LAGRANGIAN__EVERY = 36, LAGRANGIAN__ALARMS = 64 };

static inline int lagrangian_fail(lagrangian *L, const gvi_points *x)
{
    L->alert = 16;
    ++L->alarms;
    return gvi_fail(x, L->why);
}

static inline int lagrangian_is_other(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v, int i)
{
    const lagrangian_test test = { i, L->kind, 1, 0 };
    static const char *const names[] = { "", "", "LINEAR", "MASS", "MASS_LINEAR", "GENERAL" };
    gvi_real size;
    if (L->kind == LAGRANGIAN_GENERAL || !lagrangian_differs(L, &test, t, q, v, L->grain + i)) return 0;
    const gvi_real p = lagrangian_slope(&L->function, L->user, t, q, v, 1, i), off = lagrangian_off(L, &test, t, q, v, &size);
    snprintf(L->why, sizeof L->why,
             "L is not %s, as it was near the start: at t = %.9g, q[%d] = %.9g, v[%d] = %.9g its dL/dv[%d] is %.15g, not %.15g; "
             "set L.kind = LAGRANGIAN_%s after lagrangian_init",
             lagrangian_kind_text(L->kind), (double)t, i, (double)q[i], i, (double)v[i], i, (double)p, (double)(p - off),
             names[lagrangian_cover(L, (lagrangian_kind)((int)L->kind + 1), t, q, v, i)]);
    return 1;
}

/* `way`: to a neighbour, of q and v */
static inline int lagrangian_loses(lagrangian *L, gvi_real t, const gvi_real *q, const gvi_real *v, const gvi_real *way)
{
    gvi_real at[2*LAGRANGIAN_MOST], value;
    const lagrangian_line line = { &L->function, L->user, t, 0, q, v, way, at, &value, 1, 0 };
    if (!lagrangian_loses_on(&line)) return 0;
    if (!lagrangian_compare(L, t, q, v))
        snprintf(L->why, sizeof L->why, "a derivative of %s is lost: is a variable in it a double that has to be a number?", L->name);
    const size_t end = strlen(L->why);
    snprintf(L->why + end, sizeof L->why - end, " (at t = %.9g, q[0] = %.9g)", (double)t, (double)q[0]);
    return 1;
}

/* Point k: q and v, and the way to a neighbour */
static inline void lagrangian_state(const lagrangian *L, const gvi_points *x, int k, gvi_real *q, gvi_real *v, gvi_real *way)
{
    const int n = x->n, R = x->stride, to = k + 1 < x->count ? k + 1 : k - 1;
    const gvi_real dt = to < 0 ? L->t - x->t[k] : x->t[to] - x->t[k];
    for (int i = 0; i < n; ++i) {
        q[i] = x->q[i*R + k];
        way[i] = (to < 0 ? L->q[i] : x->q[i*R + to]) - q[i];
        v[i] = x->v ? x->v[i*R + k] : dt < 0 || dt > 0 ? way[i]/dt : L->v[i];
        way[n + i] = to < 0 ? L->v[i] - v[i] : x->v ? x->v[i*R + to] - v[i] : 0;
    }
}

static inline int lagrangian_look(lagrangian *L, const gvi_points *x)
{
    const int n = x->n;
    gvi_real q[LAGRANGIAN_MOST], v[LAGRANGIAN_MOST], way[2*LAGRANGIAN_MOST];
    if (L->alarms >= LAGRANGIAN__ALARMS) return gvi_fail(x, L->why);
    L->points += x->count > 4 ? x->count : 4;      // explicit steps have one
    if (!L->alert && L->points < LAGRANGIAN__EVERY) return 0;
    L->points = 0;
    if (!L->alert) ++L->looks;

    const int one = (L->looks*3)%x->count, from = L->alert ? 0 : one, end = L->alert ? x->count : one + 1,
              derivatives = LAGRANGIAN__LOSES && (L->alert || L->looks%4 == 0);
    for (int k = from; k < end; ++k) {
        lagrangian_state(L, x, k, q, v, way);
        const int off = lagrangian_is_other(L, x->t[k], q, v, L->looks%n)
                        || (derivatives && lagrangian_loses(L, x->t[k], q, v, way));
        if (off && lagrangian_finite(n, q) && lagrangian_finite(n, v)) return lagrangian_fail(L, x);       // else an iterate
    }                                                                                                  // went astray
    if (L->alert && !--L->alert) L->alarms = 0;
    if (x->count > 1) return 0;
    L->t = x->t[0];
    memcpy(L->q, q, (size_t)n*sizeof *q);
    memcpy(L->v, v, (size_t)n*sizeof *v);
    return 0;
}

/* -------------------------------------------------------------- effect and mass */

static inline int lagrangian_other_n(const gvi_points *x)
{
    return gvi_fail(x, "desc.n is not that of LAGRANGIAN or HAMILTONIAN");
}

static inline void lagrangian_less_kinetic(const lagrangian *L, const gvi_points *x)
{
    lagrangian_wanted a = lagrangian_want_quadratic(L->user, x, x->v, -1);
    a.value = x->value;
    if (L->kind == LAGRANGIAN_MASS_LINEAR) a.by_q = x->f;        // see lagrangian_gradient
    if (a.by_q || a.value) L->function.add(&a);
}

/* POTENTIAL, MASS: -V = L(t,q,0).  LINEAR, MASS_LINEAR: L - v'Mv/2.  GENERAL: L */
static inline int lagrangian_points(const gvi_points *x, void *user)
{
    lagrangian *L = (lagrangian *)user;
    const int whole = L->kind == LAGRANGIAN_GENERAL, term = lagrangian_has(L->kind, LAGRANGIAN__TERM) && !whole;
    if (x->n != L->function.n) return lagrangian_other_n(x);
    lagrangian_wanted a = lagrangian_want(L->user, x, whole || term ? x->v : NULL, 1);
    a.by_q = x->f;
    a.by_w = whole ? x->dldv : NULL;
    if (a.by_q || a.by_w) L->function.add(&a);

    a.by_q = NULL;
    a.by_w = NULL;
    a.value = x->value;
    if (!whole && !term) a.scale = -1;
    if (a.value) L->function.add(&a);

    a.value = NULL;
    a.w = NULL;
    a.by_w = x->dldv;
    if (term && a.by_w) L->function.add(&a);
    if (term) lagrangian_less_kinetic(L, x);
    return x->f && L->kind != LAGRANGIAN_MASS ? lagrangian_look(L, x) : 0;
}

/* Column j of M(q) is dL/dv at a huge v = e_j, from the first to the last entry that varies */
static inline int lagrangian_matrix(const gvi_points *x, void *user)
{
    const lagrangian *L = (const lagrangian *)user;
    const int n = x->n, R = x->stride;
    if (n != L->function.n) return lagrangian_other_n(x);
    for (int j = 0; j < n; ++j) {
        lagrangian_wanted a = lagrangian_want(L->user, x, NULL, 1);
        a.first = j;
        while (a.first < n && !L->varies[a.first*n + j]) ++a.first;
        while (a.end > a.first && !L->varies[(a.end - 1)*n + j]) --a.end;
        for (int i = j; i < n; ++i)
            for (int k = 0; k < x->count && (i < a.first || i >= a.end); ++k) x->mass[(i*n + j)*R + k] = L->M[i*n + j];
        a.one = j;
        a.times = LAGRANGIAN__HUGE;
        a.scale = 1/LAGRANGIAN__HUGE;
        a.by_w = x->mass + j*R;
        a.apart = n*R;
        if (a.first < a.end) L->function.add(&a);
    }
    return 0;
}

/* v' dM/dq v/2 = dL/dq at a huge v */
static inline int lagrangian_gradient(const gvi_points *x, void *user)
{
    lagrangian *L = (lagrangian *)user;
    if (x->n != L->function.n) return lagrangian_other_n(x);
    lagrangian_wanted a = lagrangian_want_quadratic(L->user, x, x->v, 1);
    a.by_q = x->f;
    L->function.add(&a);
    return L->kind == LAGRANGIAN_MASS ? lagrangian_look(L, x) : 0;
}

/* What was set to more than was found: then any entry of M may vary. */
static inline void lagrangian_take(lagrangian *L)
{
    if (L->kind != L->found) memset(L->varies, 1, sizeof L->varies);
    L->found = L->kind;
    L->alarms = 0;
}

static inline gvi_effect lagrangian_effect(lagrangian *L)
{
    gvi_effect effect;
    const int term = lagrangian_has(L->kind, LAGRANGIAN__TERM), whole = L->kind == LAGRANGIAN_GENERAL;
    lagrangian_take(L);
    memset(&effect, 0, sizeof effect);
    effect.kind = term || whole ? GVI_LAGRANGIAN : GVI_POTENTIAL;
    if (L->kind != LAGRANGIAN_REFUSED) effect.points = lagrangian_points;
    effect.value = effect.points;
    effect.user = L;
    return effect;
}

/* The constant mass, in its simplest form */
static inline void lagrangian_matrix_of(lagrangian *L, gvi_mass *mass)
{
    const int n = L->function.n;
    int unit = 1, diagonal = 1;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const gvi_real m = L->M[i*n + j];
            if (i != j && (m < 0 || m > 0)) diagonal = 0;
            if (i == j && (m < 1 || m > 1)) unit = 0;
        }
    for (int i = 0; i < n && diagonal; ++i) L->diagonal[i] = L->M[i*n + i];
    mass->kind = diagonal ? unit ? GVI_MASS_UNIT : GVI_MASS_DIAGONAL : GVI_MASS_DENSE;
    mass->matrix = !diagonal ? L->M : unit ? NULL : L->diagonal;
}

static inline gvi_mass lagrangian_mass(lagrangian *L)
{
    gvi_mass mass;
    lagrangian_take(L);
    memset(&mass, 0, sizeof mass);
    mass.user = L;
    mass.kind = GVI_MASS_NONE;
    if (L->kind == LAGRANGIAN_POTENTIAL || L->kind == LAGRANGIAN_LINEAR) lagrangian_matrix_of(L, &mass);
    if (L->kind != LAGRANGIAN_MASS && L->kind != LAGRANGIAN_MASS_LINEAR) return mass;
    mass.kind = GVI_MASS_POSITION;
    mass.points = lagrangian_matrix;
    mass.gradient = lagrangian_gradient;
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
    H->look.kind = LAGRANGIAN_GENERAL;             // of which the watch looks for derivatives that are lost
    return why;
}

static inline int hamiltonian_velocity(const gvi_points *x, void *user)
{
    hamiltonian *H = (hamiltonian *)user;
    gvi_points at = *x;
    if (x->n != H->function.n) return lagrangian_other_n(x);
    lagrangian_wanted a = lagrangian_want(H->user, x, x->p, 1);
    a.by_w = x->velocity;
    memset(x->velocity, 0, (size_t)(x->n*x->stride)*sizeof *x->velocity);
    H->function.add(&a);
    H->q = x->q;
    H->p = x->p;
    H->v = x->velocity;
    at.v = x->p;
    return lagrangian_look(&H->look, &at);
}

static inline int hamiltonian_term(const gvi_points *x, void *user)
{
    const hamiltonian *H = (const hamiltonian *)user;
    const int n = x->n, R = x->stride;
    if (!H->p || x->q != H->q || x->v != H->v)
        return gvi_fail(x, x->value ? "H has no action: its step is collocation"
                                    : "H needs gvi_start_momentum and GVI_MOMENTA: a velocity is not its start");
    lagrangian_wanted a = lagrangian_want(H->user, x, H->p, -1);
    a.by_q = x->f;
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
