/* problems.c - initial data, energies and right-hand sides of the problems of `make cost`

   Every formula is there once, as a small inline function; the loop over points around it is
   written once per problem and called with the usual numbers of points as constants, so that
   the compiler makes straight vector code of it.  The potentials are those of Hairer, Lubich,
   Wanner, Geometric Numerical Integration, I.2, I.3, I.5.                                     */
#include "problems.h"
#include "references.h"
#include "sines.h"
#include "solar.h"

#include <math.h>
#include <stddef.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))

/* Before a loop over points: they do not depend on each other.                                */
#if defined(__GNUC__) && !defined(__clang__)
#define INDEPENDENT _Pragma("GCC ivdep")
#if defined(__AVX512F__)
#define WIDE __attribute__((target("prefer-vector-width=512")))
#endif
#define UNROLL _Pragma("GCC unroll 7")
#define UNROLL18 _Pragma("GCC unroll 18")
#else
#define INDEPENDENT
#define UNROLL
#define UNROLL18
#endif

/* Before a function of long loops: gcc would rather have registers of half the width.          */
#ifndef WIDE
#define WIDE
#endif

/* Whole vectors where rows are, also of fewer points.                                          */
#define BY_COUNT(kernel, x) (                            \
    (x)->stride ==  8 ? kernel(x,  8,  8)                \
  : (x)->stride ==  1 ? kernel(x,  1,  1)                \
  : (x)->stride == 16 ? kernel(x, 16, 16)                \
  : (x)->stride ==  4 ? kernel(x,  4,  4)                \
  : kernel(x, (x)->count, (x)->stride))

/* At one point: adds mass times acceleration, so that an explicit method gets from a scene what
   it gets from the acceleration itself.                                                       */
#define ONE_POINT(n, acceleration, x, mass) do {             \
    double a_[n];                                            \
    acceleration((x)->q, a_);                                \
    for (int i = 0; i < (n); ++i) (x)->f[i] += (mass)*a_[i]; \
    return 0;                                                \
    } while (0)

/* ---------------------------------------------------------------- roots */

/* 1/d^3 of d^2: by the processor's root and quotient, or without either, from a shift of the bits
   (error 3.4 %) by a step of fourth order for 1/d and one for its cube; both right to 1 or 2 in
   the last place.  The first is sooner there where one waits for it, the second takes some
   processors less time where there are many.  So each form of the right-hand side exists with both,
   and problems_begin takes the faster on the processor at hand.                               */
INLINE double over_cube(double d2, const int processor)
{
    if (processor) return 1/(d2*sqrt(d2));
    unsigned long long bits;
    double y;
    memcpy(&bits, &d2, sizeof y);
    bits = 0x5fe6eb50c7b537a9ULL - (bits >> 1);
    memcpy(&y, &bits, sizeof y);
    double e = 1 - d2*(y*y);
    y += y*e*(0.5 + e*(0.375 + e*0.3125));
    const double y2 = y*y, y3 = y2*y;
    e = 1 - d2*y2;
    return y3 + (y3*e)*(1.5 + e*(1.875 + e*2.1875));
}

/* Whether the processor's, at one point and at many, as problems_begin finds it.               */
typedef struct roots { int one, many; } roots;
static roots kepler_roots = { 1, 1 }, solar_roots = { 1, 1 };

/* ------------------------------------------------------- P1, P2: Kepler */

static const double kepler6_q[] = { 0x1.999999999999ap-2, 0 }, kepler6_v[] = { 0, 2 };
static const double kepler9_q[] = { 0x1.9999999999998p-4, 0 }, kepler9_v[] = { 0, 0x1.16f8334644df9p+2 };

static long double kepler_energy(const double *q, const double *v)
{
    long double x = q[0], y = q[1], u = v[0], w = v[1];
    return (u*u + w*w)/2 - 1/sqrtl(x*x + y*y);
}

INLINE void kepler_acceleration(const double *q, double *a)
{
    double x = q[0], y = q[1], d2 = x*x + y*y, w = kepler_roots.one ? -over_cube(d2, 1) : -over_cube(d2, 0);
    a[0] = w*x;
    a[1] = w*y;
}

INLINE int kepler_points(const gvi_points *p, int count, int stride, const int processor)
{
    const double *restrict X = p->q, *restrict Y = X + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double w = -over_cube(X[k]*X[k] + Y[k]*Y[k], processor);
        fx[k] += w*X[k];
        fy[k] += w*Y[k];
    }
    return 0;
}

INLINE int kepler_by_processor(const gvi_points *p, int count, int stride) { return kepler_points(p, count, stride, 1); }
INLINE int kepler_from_bits(const gvi_points *p, int count, int stride) { return kepler_points(p, count, stride, 0); }

WIDE static int kepler(const gvi_points *p, void *user)
{
    if (p->count > 1 && kepler_roots.many) return BY_COUNT(kepler_by_processor, p);
    if (p->count > 1) return BY_COUNT(kepler_from_bits, p);
    ONE_POINT(2, kepler_acceleration, p, 1);
}

/* The same and the potential beside it, which a clock needs: what is not NULL of f and value. */
INLINE int kepler_both_points(const gvi_points *p, int count, int stride, const int processor)
{
    const double *restrict X = p->q, *restrict Y = X + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride, *restrict value = p->value;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double d2 = X[k]*X[k] + Y[k]*Y[k], w = -over_cube(d2, processor);
        fx[k] += w*X[k];
        fy[k] += w*Y[k];
        value[k] += w*d2;
    }
    return 0;
}

INLINE int both_by_processor(const gvi_points *p, int count, int stride) { return kepler_both_points(p, count, stride, 1); }
INLINE int both_from_bits(const gvi_points *p, int count, int stride) { return kepler_both_points(p, count, stride, 0); }

WIDE static int kepler_both(const gvi_points *p, void *user)
{
    if (!p->value) return kepler(p, user);
    if (p->f && kepler_roots.many) return BY_COUNT(both_by_processor, p);
    if (p->f) return BY_COUNT(both_from_bits, p);
    for (int k = 0; k < p->count; ++k)
        p->value[k] -= 1/sqrt(p->q[k]*p->q[k] + p->q[p->stride+k]*p->q[p->stride+k]);
    return 0;
}

/* Clocks g = d, dg/dq = q/d, and g = d^(3/2), dg/dq = 3/2 q/sqrt(d), d = |q|.                 */
INLINE int clock_1_points(const gvi_points *p, int count, int stride)
{
    const double *restrict X = p->q, *restrict Y = X + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride, *restrict value = p->value;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double d = sqrt(X[k]*X[k] + Y[k]*Y[k]), w = 1/d;
        value[k] += d;
        fx[k] += w*X[k];
        fy[k] += w*Y[k];
    }
    return 0;
}

INLINE int clock_32_points(const gvi_points *p, int count, int stride)
{
    const double *restrict X = p->q, *restrict Y = X + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride, *restrict value = p->value;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double d = sqrt(X[k]*X[k] + Y[k]*Y[k]), root = sqrt(d), w = 1.5/root;
        value[k] += d*root;
        fx[k] += w*X[k];
        fy[k] += w*Y[k];
    }
    return 0;
}

static int clock_1(const gvi_points *p, void *user) { return BY_COUNT(clock_1_points, p); }
static int clock_32(const gvi_points *p, void *user) { return BY_COUNT(clock_32_points, p); }

/* tau of a revolution of 2 pi, dt = d^a dtau: the integral of d^(1-a) over the eccentric anomaly
   E, d = 1 - e cos E, by the trapezoidal rule, which is exact to rounding for e <= 0.9.       */
double kepler_tau(double eccentricity, double a)
{
    enum { POINTS = 256 };
    const double circle = 6.283185307179586477;
    double sum = 0;
    for (int k = 0; k < POINTS; ++k) sum += pow(1 - eccentricity*cos(circle/POINTS*k), 1 - a);
    return circle*sum/POINTS;
}

/* ----------------------------------------------------- P3: Henon-Heiles */

static const double henon_q[] = { 0, 0x1.999999999999ap-4 }, henon_v[] = { 0x1.f65a0cefb0839p-2, 0 };

static long double henon_energy(const double *q, const double *v)
{
    long double x = q[0], y = q[1], u = v[0], w = v[1];
    return (u*u + w*w + x*x + y*y)/2 + x*x*y - y*y*y/3;
}

INLINE void henon_acceleration(const double *q, double *a)
{
    double x = q[0], y = q[1];
    a[0] = -x - 2*x*y;
    a[1] = -y - (x*x - y*y);
}

INLINE int henon_points(const gvi_points *p, int count, int stride)
{
    const double *restrict X = p->q, *restrict Y = X + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double x = X[k], y = Y[k];
        fx[k] += -x - 2*x*y;
        fy[k] += -y - (x*x - y*y);
    }
    return 0;
}

static int henon(const gvi_points *p, void *user)
{
    if (p->count > 1) return BY_COUNT(henon_points, p);
    ONE_POINT(2, henon_acceleration, p, 1);
}

/* ----------------------------------------------- P4: outer solar system */

/* Masses times the constant of gravitation: those of solar.h once a body.                     */
static const double gm[6] = { 0x1.3649cda6c4954p-12, 0x1.2f5e0adcea3e9p-22, 0x1.6af5369599412p-24,
                              0x1.bc9893d604ea6p-27, 0x1.073705365b3cdp-26, 0x1.405a77e6ee075p-39 };
static long double solar_energy(const double *q, const double *v)
{
    long double e = 0;
    for (int i = 0; i < 6; ++i) {
        for (int c = 0; c < 3; ++c) e += (long double)gm[i]*v[3*i+c]*v[3*i+c]/2;
        for (int j = 0; j < i; ++j) {
            long double x = (long double)q[3*i] - q[3*j], y = (long double)q[3*i+1] - q[3*j+1],
                        z = (long double)q[3*i+2] - q[3*j+2];
            e -= (long double)gm[i]*gm[j]/sqrtl(x*x + y*y + z*z);
        }
    }
    return e;
}

/* Each pair once; the 15 roots and quotients in one vector loop.  The bodies' own loops are
   unrolled, so that the sums stay in registers.                                               */
INLINE void solar_pairs(const double *q, const int processor, double *a)
{
    double x[16], y[16], z[16], w[16];
    int m = 0;
    x[15] = y[15] = z[15] = 1;
    UNROLL for (int i = 0; i < 5; ++i)
        UNROLL for (int j = i + 1; j < 6; ++j, ++m) {
            x[m] = q[3*j] - q[3*i];
            y[m] = q[3*j+1] - q[3*i+1];
            z[m] = q[3*j+2] - q[3*i+2];
        }
    for (m = 0; m < 16; ++m) {
        double d2 = x[m]*x[m] + y[m]*y[m] + z[m]*z[m];
        w[m] = over_cube(d2, processor);
    }
    double s[18] = { 0 };
    m = 0;
    UNROLL for (int i = 0; i < 5; ++i)
        UNROLL for (int j = i + 1; j < 6; ++j, ++m) {
            double to = gm[j]*w[m], from = gm[i]*w[m];
            s[3*i] += to*x[m];    s[3*i+1] += to*y[m];    s[3*i+2] += to*z[m];
            s[3*j] -= from*x[m];  s[3*j+1] -= from*y[m];  s[3*j+2] -= from*z[m];
        }
    for (int i = 0; i < 18; ++i) a[i] = s[i];
}

/* Forces, for the masses go with the scene: of the pairs whose first body is one of first..last */
INLINE int solar_points(const gvi_points *p, int count, int stride, const int first, const int last,
                        const int processor)
{
    const double *restrict q = p->q;
    double *restrict f = p->f;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double s[18] = { 0 };
        UNROLL for (int i = first; i <= last; ++i)
            UNROLL for (int j = i + 1; j < 6; ++j) {
                const double *a = q + 3*i*stride + k, *b = q + 3*j*stride + k;
                double x = b[0] - a[0], y = b[stride] - a[stride], z = b[2*stride] - a[2*stride];
                double w = gm[i]*gm[j]*over_cube(x*x + y*y + z*z, processor);
                s[3*i] += w*x;  s[3*i+1] += w*y;  s[3*i+2] += w*z;
                s[3*j] -= w*x;  s[3*j+1] -= w*y;  s[3*j+2] -= w*z;
            }
        UNROLL18 for (int i = 3*first; i < 18; ++i) f[i*stride+k] += s[i];
    }
    return 0;
}

#define SOLAR(name, first, last, processor) \
    INLINE int name(const gvi_points *p, int count, int stride) { return solar_points(p, count, stride, first, last, processor); }
SOLAR(solar_by_processor, 0, 4, 1)
SOLAR(solar_from_bits, 0, 4, 0)
SOLAR(sun_by_processor, 0, 0, 1)
SOLAR(sun_from_bits, 0, 0, 0)
SOLAR(planets_by_processor, 1, 4, 1)
SOLAR(planets_from_bits, 1, 4, 0)

static void solar_acceleration(const double *q, double *a)
{
    if (solar_roots.one) solar_pairs(q, 1, a);
    else solar_pairs(q, 0, a);
}

WIDE static int solar(const gvi_points *p, void *user)
{
    if (p->count > 1 && solar_roots.many) return BY_COUNT(solar_by_processor, p);
    if (p->count > 1) return BY_COUNT(solar_from_bits, p);
    ONE_POINT(18, solar_acceleration, p, solar_mass[i]);
}

/* -------------------------------------------------- P5: double pendulum */

#define G 9.81
static const double pendulum_q[] = { 0x1.999999999999ap-1, 0.5 }, pendulum_p[] = { 0, 0 };

static long double pendulum_energy(const double *q, const double *p)
{
    long double c = cosl((long double)q[0] - q[1]), u = p[0], v = p[1];
    return (u*u - 2*c*u*v + 2*v*v)/(2 - c*c)/2 - (long double)G*(2*cosl(q[0]) + cosl(q[1]));
}

/* v = M^-1 p, M = (2, c; c, 1), c = cos(q1 - q2), det M = 1 + sin^2                           */
static void pendulum_slope(const double *y, double *dy)
{
    double s[2], c[2];
    for (int i = 0; i < 2; ++i) sine_and_cosine(y[i], s + i, c + i);
    double cd = c[0]*c[1] + s[0]*s[1], sd = s[0]*c[1] - c[0]*s[1], d = 1/(1 + sd*sd);
    double u = (y[2] - cd*y[3])*d, v = (2*y[3] - cd*y[2])*d, f = sd*u*v;
    dy[0] = u;
    dy[1] = v;
    dy[2] = -2*G*s[0] - f;
    dy[3] = f - G*s[1];
}

/* M a = (-2 G s1 - sd v2^2, -G s2 + sd v1^2); p = M v                                          */
INLINE void pendulum_accelerate(const double *s, double cd, double sd, const double *v, double *a)
{
    const double f = -2*G*s[0] - sd*v[1]*v[1], g = -G*s[1] + sd*v[0]*v[0], d = 1/(1 + sd*sd);
    a[0] = (f - cd*g)*d;
    a[1] = (2*g - cd*f)*d;
}

static void pendulum_law(const double *q, const double *v, double *a)
{
    double s[2], c[2];
    for (int i = 0; i < 2; ++i) sine_and_cosine(q[i], s + i, c + i);
    pendulum_accelerate(s, c[0]*c[1] + s[0]*s[1], s[0]*c[1] - c[0]*s[1], v, a);
}

static void pendulum_momentum(const double *q, const double *v, double *p)
{
    const double c = cos(q[0] - q[1]), u = v[0], w = v[1];
    p[0] = 2*u + c*w;
    p[1] = c*u + w;
}

/* M, and the sines that it, the gradient and the weight need: gvi.h asks for them next, at the same
   points.                                                                                     */
enum { MOST_POINTS = 64 };
static double sine_1[MOST_POINTS], sine_2[MOST_POINTS], sine_between[MOST_POINTS];

INLINE int pendulum_mass_points(const gvi_points *x, int count, int stride)
{
    const double *restrict q = x->q;
    double *restrict m = x->mass;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double s1, c1, s2, c2;
        sine_and_cosine(q[k], &s1, &c1);
        sine_and_cosine(q[stride+k], &s2, &c2);
        m[k] = 2;
        m[2*stride+k] = c1*c2 + s1*s2;
        m[3*stride+k] = 1;
        sine_1[k] = s1;
        sine_2[k] = s2;
        sine_between[k] = s1*c2 - c1*s2;
    }
    return 0;
}

INLINE int pendulum_gradient_points(const gvi_points *x, int count, int stride)
{
    const double *restrict v = x->v;
    double *restrict f = x->f;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double w = sine_between[k]*v[k]*v[stride+k];
        f[k] -= w;
        f[stride+k] += w;
    }
    return 0;
}

INLINE int pendulum_weight_points(const gvi_points *x, int count, int stride)
{
    double *restrict f = x->f;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        f[k] -= 2*G*sine_1[k];
        f[stride+k] -= G*sine_2[k];
    }
    return 0;
}

static int pendulum_mass(const gvi_points *x, void *user)
{
    return x->count > MOST_POINTS ? 1 : BY_COUNT(pendulum_mass_points, x);
}

static int pendulum_gradient(const gvi_points *x, void *user)
{
    return BY_COUNT(pendulum_gradient_points, x);
}

static int pendulum_weight(const gvi_points *x, void *user)
{
    return BY_COUNT(pendulum_weight_points, x);
}

/* ---------------------------------------------- P6: Fermi, Pasta, Ulam */

/* Three stiff springs, frequency 50, between soft quartic ones [GNI, I.5.1]; q = centres and
   lengths of the stiff springs.                                                               */
#define STIFF 2500.0
static const double fpu_q[8] = { 1, 0, 0, 0x1.47ae147ae147bp-6 }, fpu_v[8] = { 1, 0, 0, 1 };

static long double fpu_energy(const double *q, const double *v)
{
    long double a = q[0], b = q[1], c = q[2], d = q[3], e = q[4], f = q[5], kinetic = 0;
    long double s[4] = { a - d, b - e - a - d, c - f - b - e, c + f }, potential = (d*d + e*e + f*f)*STIFF/2;
    for (int i = 0; i < 6; ++i) kinetic += (long double)v[i]*v[i]/2;
    for (int i = 0; i < 4; ++i) potential += s[i]*s[i]*s[i]*s[i]/4;
    return kinetic + potential;
}

INLINE double cube(double x) { return x*x*x; }

/* Written as an integrator reads it: narrower parts would make its wide loads wait.            */
INLINE void fpu_acceleration(const double *q, double *a)
{
    double s0 = cube(q[0] - q[3]), s1 = cube(q[1] - q[4] - (q[0] + q[3]));
    double s2 = cube(q[2] - q[5] - (q[1] + q[4])), s3 = cube(q[2] + q[5]);
    *(lane4 *)a = (lane4){ s1 - s0, s2 - s1, -s2 - s3, s0 + s1 - STIFF*q[3] };
    *(lane2 *)(a + 4) = (lane2){ s1 + s2 - STIFF*q[4], s2 - s3 - STIFF*q[5] };
}

INLINE int fpu_points(const gvi_points *p, int count, int stride)
{
    const double *restrict a = p->q, *restrict b = a + stride, *restrict c = b + stride;
    const double *restrict d = c + stride, *restrict e = d + stride, *restrict g = e + stride;
    double *restrict f = p->f;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double s0 = cube(a[k] - d[k]), s1 = cube(b[k] - e[k] - (a[k] + d[k]));
        double s2 = cube(c[k] - g[k] - (b[k] + e[k])), s3 = cube(c[k] + g[k]);
        f[k] += s1 - s0;
        f[stride+k] += s2 - s1;
        f[2*stride+k] -= s2 + s3;
        f[3*stride+k] += s0 + s1 - STIFF*d[k];
        f[4*stride+k] += s1 + s2 - STIFF*e[k];
        f[5*stride+k] += s2 - s3 - STIFF*g[k];
    }
    return 0;
}

static int fpu(const gvi_points *p, void *user)
{
    if (p->count > 1) return BY_COUNT(fpu_points, p);
    double a[6];
    fpu_acceleration(p->q, a);
    *(lane4 *)p->f += (lane4){ a[0], a[1], a[2], a[3] };     // ONE_POINT would store a and load it wider, and wait
    *(lane2 *)(p->f + 4) += (lane2){ a[4], a[5] };
    return 0;
}

/* ------------------------------------------------------ P7: chain of 100 */

/* Springs d + d^3 between fixed walls.                                                        */
enum { LINKS = 100 };
static const double chain_v[MOST_COORDINATES];

static long double chain_energy(const double *q, const double *v)
{
    long double e = 0;
    for (int i = 0; i <= LINKS; ++i) {
        long double d = (i < LINKS ? (long double)q[i] : 0) - (i > 0 ? (long double)q[i-1] : 0);
        e += d*d/2 + d*d*d*d/4;
        if (i < LINKS) e += (long double)v[i]*v[i]/2;
    }
    return e;
}

INLINE double spring(double d) { return d + d*d*d; }

#if defined(__GNUC__) && !defined(__clang__)
typedef long long lanes_of_it __attribute__((vector_size(sizeof(widest))));
#if defined(__AVX512F__)
#define ONE_ON   { 1, 2, 3, 4, 5, 6, 7, 8 }
#define ONE_BACK { 8, 0, 1, 2, 3, 4, 5, 6 }
#elif defined(__AVX__)
#define ONE_ON   { 1, 2, 3, 4 }
#define ONE_BACK { 4, 0, 1, 2 }
#else
#define ONE_ON   { 1, 2 }
#define ONE_BACK { 2, 0 }
#endif

/* x without its first number and y behind it; x without its last one and y before it          */
INLINE widest shifted(widest x, double y, lanes_of_it from)
{
    const widest other = { y };
    return __builtin_shuffle(x, other, from);
}
#endif

/* f := or += the forces at one point.  In whole vectors from 0 on, neighbours by a shuffle: those that lie
   across two vectors just stored would have to wait until these have left for the cache.               */
INLINE void chain_forces(const int adds, const double *restrict q, double *restrict f)
{
    double before = spring(q[0]);
    int i = 0;
#if defined(__GNUC__) && !defined(__clang__)
    for (; i + WIDTH < LINKS; i += WIDTH) {
        const widest x = *(const widest *)(q + i), d = shifted(x, q[i+WIDTH], (lanes_of_it)ONE_ON) - x;
        const widest s = d + d*d*d;
        const widest sum = s - shifted(s, before, (lanes_of_it)ONE_BACK);
        if (adds) *(widest *)(f + i) += sum;
        else *(widest *)(f + i) = sum;
        before = s[WIDTH-1];
    }
#endif
    for (; i < LINKS; ++i) {
        const double s = spring((i + 1 < LINKS ? q[i+1] : 0) - q[i]);
        f[i] = adds ? f[i] + (s - before) : s - before;
        before = s;
    }
}

static void chain_acceleration(const double *q, double *a) { chain_forces(0, q, a); }

INLINE int chain_points(const gvi_points *p, int count, int stride)
{
    const double *q = p->q, *last = q + (LINKS - 1)*stride;
    double *f = p->f;
    INDEPENDENT for (int k = 0; k < count; ++k) f[k] += spring(q[stride+k] - q[k]) - spring(q[k]);
    for (int i = 1; i < LINKS - 1; ++i) {
        const double *x = q + i*stride;
        double *g = f + i*stride;
        INDEPENDENT for (int k = 0; k < count; ++k)
            g[k] += spring(x[stride+k] - x[k]) - spring(x[k] - x[k-stride]);
    }
    f += (LINKS - 1)*stride;
    INDEPENDENT for (int k = 0; k < count; ++k) f[k] -= spring(last[k]) + spring(last[k] - last[k-stride]);
    return 0;
}

static int chain(const gvi_points *p, void *user)
{
    if (p->count > 1) return BY_COUNT(chain_points, p);
    chain_forces(1, p->q, p->f);
    return 0;
}

#include "ordinary.h"
#include "encounters.h"

/* ------------------------------------------------------------- the list */

static const gvi_effect kepler_scene[] = { { .kind = GVI_POTENTIAL, .points = kepler } };
#define WITH_CLOCK(g) { { .kind = GVI_POTENTIAL, .points = kepler_both, .value = kepler_both }, \
                        { .kind = GVI_CLOCK, .points = g } }
static const gvi_effect kepler_clock_1[] = WITH_CLOCK(clock_1), kepler_clock_32[] = WITH_CLOCK(clock_32);
static const gvi_effect henon_scene[] = { { .kind = GVI_POTENTIAL, .points = henon } };
static const gvi_effect solar_scene[] = { { .kind = GVI_POTENTIAL, .points = solar } };
static const gvi_effect pendulum_scene[] = { { .kind = GVI_POTENTIAL, .points = pendulum_weight } };
static const gvi_effect fpu_scene[] = { { .kind = GVI_POTENTIAL, .points = fpu } };
static const gvi_effect chain_scene[] = { { .kind = GVI_POTENTIAL, .points = chain } };
#define SCENE(s) .effects = s, .effect_count = COUNT(s)

#define KEPLER_CLOCKS(e, turns) \
    .clocks = { kepler_clock_32, kepler_clock_1 }, .eccentricity = e, .revolutions = turns

#define REVOLUTION 6.283185307179586

/* Ends: 100 and 20 revolutions of 2 pi; 548 years; times.                                     */
const problem problems[] = {
    { .key = "P1", .title = "Kepler, eccentricity 0.6, 100 revolutions", .n = 2, .end = 0x1.3a28c59d5433bp+9,
      .q = kepler6_q, .v = kepler6_v, .reference = reference_P1, .energy = kepler_energy,
      .acceleration = kepler_acceleration, SCENE(kepler_scene), KEPLER_CLOCKS(0.6, 100),
      .evaluations = 8e3, .limit = 16 },
    { .key = "P2", .title = "Kepler, eccentricity 0.9, 20 revolutions", .n = 2, .end = 0x1.f6a7a2955385ep+6,
      .q = kepler9_q, .v = kepler9_v, .reference = reference_P2, .energy = kepler_energy,
      .acceleration = kepler_acceleration, SCENE(kepler_scene), KEPLER_CLOCKS(0.9, 20),
      .evaluations = 4e3, .limit = 4 },
    { .key = "P3", .title = "Henon-Heiles, energy 1/8, t = 1000", .n = 2, .end = 1000,
      .q = henon_q, .v = henon_v, .reference = reference_P3, .energy = henon_energy,
      .acceleration = henon_acceleration, SCENE(henon_scene), .evaluations = 2e3, .limit = 2 },
    { .key = "P4", .title = "Outer solar system, 548 years", .n = 18, .end = 200000,
      .q = solar_q, .v = solar_v, .reference = reference_P4, .energy = solar_energy,
      .acceleration = solar_acceleration, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = solar_mass },
      SCENE(solar_scene), .evaluations = 1e3, .limit = 10 },
    { .key = "P5", .title = "Double pendulum, t = 100", .n = 2, .end = 100,
      .q = pendulum_q, .v = pendulum_p, .reference = reference_P5, .energy = pendulum_energy,
      .slope = pendulum_slope, .law = pendulum_law, .momentum = pendulum_momentum, .mass = { .kind = GVI_MASS_POSITION, .points = pendulum_mass,
      .gradient = pendulum_gradient },
      SCENE(pendulum_scene), .evaluations = 3e3, .limit = 12 },
    { .key = "P6", .title = "Fermi-Pasta-Ulam, frequency 50, t = 200", .n = 6, .end = 200,
      .q = fpu_q, .v = fpu_v, .reference = reference_P6, .energy = fpu_energy,
      .acceleration = fpu_acceleration, SCENE(fpu_scene),
      .evaluations = 1e4, .limit = 48 },
    { .key = "P6b", .title = "Fermi-Pasta-Ulam, frequency 50, t = 50", .n = 6, .end = 50,
      .q = fpu_q, .v = fpu_v, .reference = reference_P6b, .energy = fpu_energy,
      .acceleration = fpu_acceleration, SCENE(fpu_scene),
      .evaluations = 2500, .limit = 3 },
    { .key = "P7", .title = "Chain of 100, t = 100", .n = LINKS, .end = 100,
      .q = start_P7, .v = chain_v, .reference = reference_P7, .energy = chain_energy,
      .acceleration = chain_acceleration, SCENE(chain_scene), .evaluations = 100, .limit = 2 },
    { .key = "P8", .title = "Toda's lattice, 16 masses, t = 100", .n = 16, .end = 100,
      .q = toda_q, .v = toda_v, .reference = reference_toda, .energy = toda_energy,
      .acceleration = toda_acceleration, SCENE(toda_scene), .evaluations = 300, .limit = 10 },
    { .key = "P9", .title = "Arenstorf's orbit, one revolution", .n = 2, .end = 17.065216560157964,
      .q = arenstorf_q, .v = arenstorf_p, .reference = reference_arenstorf, .energy = arenstorf_energy,
      .slope = arenstorf_slope, .law = arenstorf_law, .momentum = arenstorf_momentum, SCENE(arenstorf_scene), .evaluations = 2e3, .limit = 20 },
    { .key = "P10", .title = "Magnetic bottle, t = 200", .n = 3, .end = 200,
      .q = bottle_q, .v = bottle_v, .reference = reference_bottle, .energy = bottle_energy,
      .slope = bottle_slope, .law = bottle_law, SCENE(bottle_scene), .formulation = GVI_VELOCITIES, .evaluations = 600, .limit = 4 },
    { .key = "P11", .title = "Seven atoms, Lennard-Jones, t = 10", .n = 14, .end = 10,
      .q = atoms_q, .v = atoms_v, .reference = reference_atoms, .energy = atoms_energy,
      .acceleration = atoms_acceleration, SCENE(atoms_scene), .evaluations = 300, .limit = 4 },
    { .key = "P12", .title = "Relativistic Kepler, c = 5, t = 200", .n = 2, .end = 200,
      .q = kepler6_q, .v = relativistic_p, .reference = reference_relativistic, .energy = relativistic_energy,
      .slope = relativistic_slope, .law = relativistic_law, .momentum = relativistic_momentum, .mass = { .kind = GVI_MASS_NONE, .velocity = relativistic_velocity },
      SCENE(relativistic_scene), .evaluations = 3e3, .limit = 8 },
    { .key = "P1o", .title = "P1, ordinary callbacks", .n = 2, .end = 0x1.3a28c59d5433bp+9,
      .q = kepler6_q, .v = kepler6_v, .reference = reference_P1, .energy = kepler_energy,
      .acceleration = plain_kepler_acceleration, SCENE(plain_kepler_scene), .evaluations = 8e3, .limit = 16 },
    { .key = "P4o", .title = "P4, ordinary callbacks", .n = 18, .end = 200000,
      .q = solar_q, .v = solar_v, .reference = reference_P4, .energy = solar_energy,
      .acceleration = plain_solar_acceleration, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = solar_mass },
      SCENE(plain_solar_scene), .evaluations = 1e3, .limit = 10 },
    { .key = "P5o", .title = "P5, ordinary callbacks, libm's sine", .n = 2, .end = 100,
      .q = pendulum_q, .v = pendulum_p, .reference = reference_P5, .energy = pendulum_energy,
      .slope = plain_pendulum_slope, .law = plain_pendulum_law, .momentum = pendulum_momentum, .mass = { .kind = GVI_MASS_POSITION, .points = plain_pendulum_mass,
      .gradient = plain_pendulum_gradient }, SCENE(plain_pendulum_scene), .evaluations = 3e3, .limit = 24 },
    { .key = "P13", .title = "Comet, eccentricity 0.99, 20 revolutions", .n = 2, .end = 20*REVOLUTION,
      .q = comet2_q, .v = comet2_v, .reference = reference_comet2, .energy = kepler_energy,
      .acceleration = plain_kepler_acceleration, SCENE(plain_kepler_scene), .evaluations = 2e4, .limit = 8, .by_dial = 1 },
    { .key = "P14", .title = "Comet, eccentricity 0.9999, 10 revolutions", .n = 2, .end = 10*REVOLUTION,
      .q = comet4_q, .v = comet4_v, .reference = reference_comet4, .energy = kepler_energy,
      .acceleration = plain_kepler_acceleration, SCENE(plain_kepler_scene), .evaluations = 1e5, .limit = 8, .by_dial = 1 },
    { .key = "P15", .title = "Pythagorean three bodies, t = 30", .n = 6, .end = 30,
      .q = burrau_q, .v = burrau_v, .reference = reference_burrau, .energy = burrau_energy,
      .acceleration = burrau_acceleration, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = burrau_mass },
      SCENE(burrau_scene), .evaluations = 1e4, .limit = 20, .by_dial = 1 },
    { .key = "P16", .title = "Flyby, t = 200", .n = 2, .end = 200,
      .q = flyby_q, .v = flyby_v, .reference = reference_flyby, .energy = kepler_energy,
      .acceleration = plain_kepler_acceleration, SCENE(plain_kepler_scene), .evaluations = 1e4, .limit = 4, .by_dial = 1 },
    { .key = "P17", .title = "Rope of four rods, tumbling, t = 60", .n = ROPE, .end = 60,
      .q = rope_q, .v = rope_v, .reference = reference_rope, .energy = rope_energy,
      .slope = rope_slope, .law = rope_law, SCENE(rope_scene), .formulation = GVI_POSITIONS, .evaluations = 600, .limit = 40, .by_dial = 1 },
};
const int problem_count = COUNT(problems);

const problem *problem_named(const char *key)
{
    for (int i = 0; i < problem_count; ++i)
        if (!strcmp(problems[i].key, key)) return problems + i;
    return NULL;
}

/* The time of calls that wait for each other, as an integrator's do.                          */
static clock_t time_of(const problem *p, int count)
{
    double q[18*8], f[18*8], t[8] = { 0 };
    gvi_points x = { .n = p->n, .count = count, .stride = count, .t = t, .q = q, .f = f };
    for (int i = 0; i < p->n*count; ++i) {
        q[i] = p->q[i/count];
        f[i] = 0;
    }
    const clock_t begin = clock();
    for (int call = 0; call < 2000; ++call) {
        if (count == 1) p->acceleration(q, f);
        else p->effects->points(&x, NULL);
        for (int i = 0; i < p->n*count; ++i) q[i] += 1e-30*f[i];
    }
    return clock() - begin;
}

/* The least times of both, taken in turn, so that what else the machine does meets both.      */
static void choose(const problem *p, int count, int *processor)
{
    clock_t least[2] = { 0, 0 };
    for (int trial = 0; trial < 80; ++trial) {
        *processor = trial % 2;
        const clock_t time = time_of(p, count);
        if (trial < 2 || time < least[*processor]) least[*processor] = time;
    }
    *processor = least[1] <= least[0];
}

void problems_begin(void)
{
    choose(problem_named("P1"), 1, &kepler_roots.one);
    choose(problem_named("P1"), 8, &kepler_roots.many);
    choose(problem_named("P4"), 1, &solar_roots.one);
    choose(problem_named("P4"), 8, &solar_roots.many);
}

static const char *told(roots r)
{
    return r.one ? r.many ? "the processor's roots for one point and many"
                          : "the processor's roots for one point, none for many"
                 : r.many ? "no roots for one point, the processor's for many"
                          : "no roots";
}

void problems_tell(FILE *f)
{
    fprintf(f, "P1, P2: %s\nP4: %s\n", told(kepler_roots), told(solar_roots));
}

double problem_error(const problem *p, const double *q)
{
    long double worst = 0;
    for (int i = 0; i < p->n; ++i) {
        long double d = fabsl(q[i] - p->reference[i]);
        if (!(d <= worst)) worst = d;
    }
    return (double)worst;
}

watch watch_begin(const problem *p, long every)
{
    watch w = { p, every > 0 ? every : 1, 0, p->energy(p->q, p->v), 0 };
    return w;
}

void watch_look(watch *w, const double *q, const double *v)
{
    long double d = fabsl((w->p->energy(q, v) - w->first)/w->first);
    if (!(d <= w->worst)) w->worst = d;
}
