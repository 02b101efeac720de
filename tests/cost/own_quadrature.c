/* own_quadrature.c - may a weak effect have its own quadrature?  And what does gvi.h gain by a mark?

     own_quadrature [--quick]

   Three ways to spend less on effects that are weaker or slower than the leading one:

     own rule    weak effects at fewer points.  The action is a sum over effects, each by its own
                 nodes c^e and weights b^e; the kinetic energy by the leading rule.  The unknowns
                 are the forces at all nodes of all rules, and (3), (4) of gvi.h become
                   Q(c) = q0 + h c v0 + h M^-1 sum_e sum_j (c - S(c, c_j^e)) h b_j^e F_j^e
                   V(c) = v0 + M^-1 sum_e sum_j (1 - T(c, c_j^e)) h b_j^e F_j^e
                   S(c, d) = sum_k (2k+1) Phi_k(c) Phi_k(d)    T(c, d) = sum_k (2k+1) phi_k(c) Phi_k(d)
     own degree  the same, but weak effects see only the first s_e modes of the curve: the sums
                 end at the lesser of the two degrees
     marked      gvi_effect.weak: all points of the one rule, asked in only some of the iterations

   The first two by a stepper of its own, in the formulation by positions, or by velocities where
   an effect reads v.  It starts and ends an iteration as gvi.h does; q, p and t are compensated,
   increments are not.  At most two rules, r, s <= 8.  The third by gvi.h itself.
   Printed: the stepper beside gvi.h; prices of effects by points; errors; orders; symplecticity
   and momentum; evaluations of what is marked; time to an error.  Lines with "ok" are checks;
   the program returns 1 if one fails.  Times are CPU times, the least of some runs.            */
#define _POSIX_C_SOURCE 200809L
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "solar.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
#define INLINE static inline __attribute__((always_inline))
/* Before a loop over points: they do not depend on each other, and are not to be unrolled, so that
   a few of them become a vector as well.                                                        */
#if defined(__GNUC__) && !defined(__clang__)
#define INDEPENDENT _Pragma("GCC ivdep") _Pragma("GCC unroll 1")
#else
#define INDEPENDENT
#endif

enum { LANES = 8, RULES = 2, MOST = 48, EFFECTS = 4 };
typedef double lanes __attribute__((vector_size(64), may_alias));
typedef double four __attribute__((vector_size(32), aligned(8), may_alias));
typedef double two __attribute__((vector_size(16), aligned(8), may_alias));

/* A loop over points with its usual numbers of points as constants.                            */
#define BY_COUNT(kernel, x, user) (                                  \
    (x)->stride != LANES ? kernel(x, user, (x)->count, (x)->stride)  \
  : (x)->count == 8 ? kernel(x, user, 8, LANES)                      \
  : (x)->count == 4 ? kernel(x, user, 4, LANES)                      \
  : (x)->count == 3 ? kernel(x, user, 3, LANES)                      \
  : (x)->count == 2 ? kernel(x, user, 2, LANES)                      \
  : (x)->count == 1 ? kernel(x, user, 1, LANES)                      \
  : kernel(x, user, (x)->count, LANES))

/* All weak effects are multiplied by this.                                                     */
static double strength = 1;

/* -------------------------------------------------------- forces: satellite
   Units: radius of the Earth, GM = 1; time 806.8 s.                                            */

INLINE int central_points(const gvi_points *p, void *user, int count, int stride)
{
    const double *restrict X = p->q, *restrict Y = X + stride, *restrict Z = Y + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride, *restrict fz = fy + stride;
    (void)user;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double d2 = X[k]*X[k] + Y[k]*Y[k] + Z[k]*Z[k], w = -1/(d2*sqrt(d2));
        fx[k] += w*X[k];
        fy[k] += w*Y[k];
        fz[k] += w*Z[k];
    }
    return 0;
}

static int central(const gvi_points *p, void *user) { return BY_COUNT(central_points, p, user); }

/* J2 to J6 of EGM96 (Lemoine et al., NASA/TP-1998-206861), rounded.  U = 1/r - sum J_n r^-(n+1) P_n(z/r),
   grad r^-(n+1) P_n = r^-(n+2) (P_n' e_z - P_(n+1)' x/r)                                        */
static const double zonal_J[7] = { 0, 0, 1.0826267e-3, -2.5327e-6, -1.6196e-6, -2.2730e-7, 5.4068e-7 };

INLINE int zonal_points(const gvi_points *p, void *user, int count, int stride)
{
    const double *restrict X = p->q, *restrict Y = X + stride, *restrict Z = Y + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride, *restrict fz = fy + stride;
    (void)user;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double u = 1/sqrt(X[k]*X[k] + Y[k]*Y[k] + Z[k]*Z[k]), t = Z[k]*u, power = strength*u*u;
        double before = 1, P = t, d_before = 0, d = 1, radial = 0, axial = 0;
        for (int n = 1; n < 7; ++n) {
            double next = ((2*n + 1)*t*P - n*before)/(n + 1), d_next = d_before + (2*n + 1)*P;
            power *= u;
            radial += zonal_J[n]*power*d_next;
            axial -= zonal_J[n]*power*d;
            before = P;
            P = next;
            d_before = d;
            d = d_next;
        }
        fx[k] += radial*u*X[k];
        fy[k] += radial*u*Y[k];
        fz[k] += radial*u*Z[k] + axial;
    }
    return 0;
}

static int zonal(const gvi_points *p, void *user) { return BY_COUNT(zonal_points, p, user); }

/* A field of degree 20, synthetic: normalised coefficients at random, of the size of Kaula's rule,
   1e-5/n^2.  Cunningham's recurrence of V, W [Montenbruck, Gill: Satellite orbits, 3.2], column by
   column, every V_km, W_km adding to all that it is in at once.                                 */
enum { FIELD = 20 };
typedef struct term { double xV, xW, yV, yW, zV, zW, next, before; } term;
static term field[(FIELD + 2)*(FIELD + 3)/2];

static double random_number(void)        /* uniform in -1, 1                                     */
{
    static unsigned long long state = 20240229;
    state = state*6364136223846793005ull + 1442695040888963407ull;
    return (double)(state >> 11)/4503599627370496.0 - 1;
}

static void field_coefficients(double C[FIELD + 3][FIELD + 3], double S[FIELD + 3][FIELD + 3])
{
    for (int n = 2; n <= FIELD; ++n)
        for (int m = n < 7 ? 1 : 0; m <= n; ++m) {
            double square = (m ? 2 : 1)*(2*n + 1);
            for (int k = n - m + 1; k <= n + m; ++k) square /= k;
            double size = sqrt(3*square)*1e-5/n/n;
            C[n][m] = size*random_number();
            S[n][m] = m ? size*random_number() : 0;
        }
}

static void make_field(void)
{
    static double C[FIELD + 3][FIELD + 3], S[FIELD + 3][FIELD + 3];
    term *w = field;
    field_coefficients(C, S);
    for (int m = 0; m <= FIELD + 1; ++m)
        for (int k = m; k <= FIELD + 1; ++k, ++w) {
            int n = k - 1;
            double less = m == 1 ? 1 : 0.5, more = 0.5*(n - m + 1)*(n - m);
            double cl = m && n >= 0 ? less*C[n][m - 1] : 0, sl = m && n >= 0 ? less*S[n][m - 1] : 0;
            double cm = n >= 0 ? more*C[n][m + 1] : 0, sm = n >= 0 ? more*S[n][m + 1] : 0;
            double c0 = n >= 0 ? (n - m + 1)*C[n][m] : 0, s0 = n >= 0 ? (n - m + 1)*S[n][m] : 0;
            term found = { cm - cl, sm - sl, sl + sm, -cl - cm, -c0, -s0,
                           (2.0*k + 1)/(k + 1 - m), (double)(k + m)/(k + 1 - m) };
            *w = found;
        }
}

/* For one point, two, four or eight at once                                                     */
#define FIELD_OF(name, type)                                                              \
static void name(const double *q, const double *root, double *a)                         \
{                                                                                         \
    const type x = *(const type *)q, y = *(const type *)(q + LANES), z = *(const type *)(q + 2*LANES), \
               u = *(const type *)root, u2 = u*u, X = x*u2, Y = y*u2, Z = z*u2;            \
    type ax = u*0, ay = u*0, az = u*0, top = u, low = u*0;                                 \
    const term *w = field;                                                                \
    for (int m = 0; m <= FIELD + 1; ++m) {                                                \
        type V = top, W = low, V1 = u*0, W1 = u*0;                                         \
        for (int k = m; k <= FIELD + 1; ++k, ++w) {                                       \
            const type V2 = w->next*Z*V - w->before*u2*V1, W2 = w->next*Z*W - w->before*u2*W1; \
            ax += w->xV*V + w->xW*W;                                                      \
            ay += w->yV*V + w->yW*W;                                                      \
            az += w->zV*V + w->zW*W;                                                      \
            V1 = V;                                                                       \
            W1 = W;                                                                       \
            V = V2;                                                                       \
            W = W2;                                                                       \
        }                                                                                 \
        const type next = (2*m + 1)*(X*top - Y*low);                                      \
        low = (2*m + 1)*(X*low + Y*top);                                                  \
        top = next;                                                                       \
    }                                                                                     \
    *(type *)a = ax;                                                                      \
    *(type *)(a + LANES) = ay;                                                            \
    *(type *)(a + 2*LANES) = az;                                                          \
}
FIELD_OF(field_1, double)
FIELD_OF(field_2, two)
FIELD_OF(field_4, four)
FIELD_OF(field_8, lanes)

static void field_many(int count, const double *q, const double *root, double *a)
{
    if (count > 4) field_8(q, root, a);
    else if (count > 2) field_4(q, root, a);
    else if (count > 1) field_2(q, root, a);
    else field_1(q, root, a);
}

/* The Earth turns.  user: not NULL, one point at a time, as code from elsewhere often does.     */
static const double earth_rate = 7.292115e-5*806.8109;
static char one_by_one;

static void tesseral_block(const gvi_points *p, int first, int count, int single)
{
    lanes q[3], a[3], root, cosine = { 0 }, sine = { 0 };
    const int R = p->stride;
    for (int k = 0; k < LANES; ++k) {                      /* the last point fills up           */
        const int at = first + (k < count ? k : count - 1);
        const double angle = earth_rate*p->t[at], x = p->q[at], y = p->q[R + at], z = p->q[2*R + at];
        cosine[k] = k < count ? cos(angle) : cosine[count - 1];
        sine[k] = k < count ? sin(angle) : sine[count - 1];
        q[0][k] = cosine[k]*x + sine[k]*y;
        q[1][k] = cosine[k]*y - sine[k]*x;
        q[2][k] = z;
        root[k] = 1/sqrt(x*x + y*y + z*z);
    }
    if (!single) field_many(count, (double *)q, (double *)&root, (double *)a);
    for (int k = 0; single && k < count; ++k) field_1((double *)q + k, (double *)&root + k, (double *)a + k);
    for (int k = 0; k < count; ++k) {
        double *f = p->f + first + k;
        f[0] += strength*(cosine[k]*a[0][k] - sine[k]*a[1][k]);
        f[R] += strength*(cosine[k]*a[1][k] + sine[k]*a[0][k]);
        f[2*R] += strength*a[2][k];
    }
}

static int tesseral(const gvi_points *p, void *user)
{
    for (int first = 0; first < p->count; first += LANES)
        tesseral_block(p, first, p->count - first < LANES ? p->count - first : LANES, user != NULL);
    return 0;
}

/* Moon and Sun on circles: mass, distance, rate, inclination.  Mean elements, rounded.          */
static const double bodies[2][4] = {
    { 0.0123, 60.27, 2.1476e-3, 0.4 }, { 332946, 23455, 1.6063e-4, 0.4091 } };

static int third_bodies(const gvi_points *p, void *user)
{
    const int R = p->stride;
    (void)user;
    for (int k = 0; k < p->count; ++k)
        for (int i = 0; i < 2; ++i) {
            const double *b = bodies[i], c = cos(b[2]*p->t[k] + i), s = sin(b[2]*p->t[k] + i);
            const double d[3] = { b[1]*c, b[1]*s*cos(b[3]), b[1]*s*sin(b[3]) };
            const double x = d[0] - p->q[k], y = d[1] - p->q[R + k], z = d[2] - p->q[2*R + k];
            const double d2 = x*x + y*y + z*z, m = strength*b[0];
            const double w = m/(d2*sqrt(d2)), w0 = m/(b[1]*b[1]*b[1]);
            p->f[k] += w*x - w0*d[0];
            p->f[R + k] += w*y - w0*d[1];
            p->f[2*R + k] += w*z - w0*d[2];
        }
    return 0;
}

/* Drag: density falls by e in 50 km, the air turns with the Earth; 5e-6 of gravity at 285 km.    */
INLINE int drag_points(const gvi_points *p, void *user, int count, int stride)
{
    const double *restrict X = p->q, *restrict Y = X + stride, *restrict Z = Y + stride;
    const double *restrict U = p->v, *restrict V = U + stride, *restrict W = V + stride;
    double *restrict fx = p->f, *restrict fy = fx + stride, *restrict fz = fy + stride;
    (void)user;
    for (int k = 0; k < count; ++k) {
        double r = sqrt(X[k]*X[k] + Y[k]*Y[k] + Z[k]*Z[k]);
        double u = U[k] + earth_rate*Y[k], v = V[k] - earth_rate*X[k];
        double w = -strength*5e-6*exp((1.04475 - r)*127.56)*sqrt(u*u + v*v + W[k]*W[k]);
        fx[k] += w*u;
        fy[k] += w*v;
        fz[k] += w*W[k];
    }
    return 0;
}

static int drag(const gvi_points *p, void *user) { return BY_COUNT(drag_points, p, user); }

/* ------------------------------------------------------------ forces: bodies */

/* From body i to j, mass times mass = g, at `count` points                                      */
INLINE void pair(const gvi_points *p, int i, int j, double g, int count, int stride)
{
    const double *restrict a = p->q + 3*i*stride, *restrict b = p->q + 3*j*stride;
    double *restrict s = p->f + 3*i*stride, *restrict t = p->f + 3*j*stride;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double x = b[k] - a[k], y = b[stride+k] - a[stride+k], z = b[2*stride+k] - a[2*stride+k];
        double d2 = x*x + y*y + z*z, w = g/(d2*sqrt(d2));
        s[k] += w*x;  s[stride+k] += w*y;  s[2*stride+k] += w*z;
        t[k] -= w*x;  t[stride+k] -= w*y;  t[2*stride+k] -= w*z;
    }
}

/* The leading pairs are those with the Sun.                                                     */
INLINE int sun_points(const gvi_points *p, void *user, int count, int stride)
{
    (void)user;
    for (int j = 1; j < 6; ++j) pair(p, 0, j, solar_mass[0]*solar_mass[3*j], count, stride);
    return 0;
}

INLINE int planet_points(const gvi_points *p, void *user, int count, int stride)
{
    (void)user;
    for (int i = 1; i < 5; ++i)
        for (int j = i + 1; j < 6; ++j)
            pair(p, i, j, strength*solar_mass[3*i]*solar_mass[3*j], count, stride);
    return 0;
}

static int sun(const gvi_points *p, void *user) { return BY_COUNT(sun_points, p, user); }
static int planets(const gvi_points *p, void *user) { return BY_COUNT(planet_points, p, user); }

/* Eight double stars of mass 1/2 + 1/2 and distance 1 at the corners of a cube of side 20, which
   turns.  Leading: the eight near pairs; weak: the 112 others.                                  */
enum { STARS = 16 };
static double star_mass[3*STARS], star_q[3*STARS], star_v[3*STARS];

static void place_stars(void)
{
    for (int i = 0; i < STARS/2; ++i) {
        const double centre[3] = { i & 1 ? 10 : -10, i & 2 ? 10 : -10, i & 4 ? 10 : -10 };
        const double speed[3] = { -0.02*centre[1], 0.02*centre[0], 0 }, a = 2.4*i + 0.3, b = 1.1*i;
        const double u[3] = { cos(a), sin(a), 0 }, w[3] = { -sin(a)*cos(b), cos(a)*cos(b), sin(b) };
        for (int c = 0; c < 3; ++c)
            for (int j = 0; j < 2; ++j) {
                const int at = 6*i + 3*j + c;
                star_mass[at] = 0.5;
                star_q[at] = centre[c] + (j ? -0.5 : 0.5)*u[c];
                star_v[at] = speed[c] + (j ? -0.5 : 0.5)*w[c];
            }
    }
}

INLINE int near_points(const gvi_points *p, void *user, int count, int stride)
{
    (void)user;
    for (int i = 0; i < STARS; i += 2) pair(p, i, i + 1, 0.25, count, stride);
    return 0;
}

INLINE int far_points(const gvi_points *p, void *user, int count, int stride)
{
    (void)user;
    for (int i = 0; i < STARS - 2; ++i)
        for (int j = (i | 1) + 1; j < STARS; ++j) pair(p, i, j, strength*0.25, count, stride);
    return 0;
}

static int near(const gvi_points *p, void *user) { return BY_COUNT(near_points, p, user); }
static int far(const gvi_points *p, void *user) { return BY_COUNT(far_points, p, user); }

/* ------------------------------------------------------------------ scenes */

typedef struct scene {
    const char   *key, *title;
    int           n;
    const double *mass, *q, *v;           /* mass NULL: 1                                       */
    double        end, period, unit;      /* errors of q are in this unit                       */
    int           leading, weak;
    gvi_effect    effects[2*EFFECTS];     /* leading ones first                                 */
} scene;

#define POTENTIAL(f) { .kind = GVI_POTENTIAL, .points = f }
#define ONE_BY_ONE(f) { .kind = GVI_POTENTIAL, .points = f, .user = &one_by_one }
static double low_q[3], low_v[3], high_q[3], high_v[3], air_q[3], air_v[3];

static scene scenes[] = {
    { "low",   "satellite at 710 km: gravity, J2-J6 | field of degree 20, Moon, Sun", 3, NULL, low_q, low_v,
      20, 1, 1, 2, 2, { POTENTIAL(central), POTENTIAL(zonal),
                        POTENTIAL(tesseral), POTENTIAL(third_bodies) } },
    { "low1",  "the same, the field one point at a time", 3, NULL, low_q, low_v,
      5, 1, 1, 2, 2, { POTENTIAL(central), POTENTIAL(zonal),
                       ONE_BY_ONE(tesseral), POTENTIAL(third_bodies) } },
    { "J2",    "satellite at 710 km: gravity | J2-J6", 3, NULL, low_q, low_v,
      20, 1, 1, 1, 1, { POTENTIAL(central), POTENTIAL(zonal) } },
    { "moon",  "satellite at 20,000 km: gravity, J2-J6 | Moon, Sun", 3, NULL, high_q, high_v,
      20, 1, 1, 2, 1, { POTENTIAL(central), POTENTIAL(zonal), POTENTIAL(third_bodies) } },
    { "high1", "satellite at 20,000 km: gravity | J2-J6, field one point at a time, Moon, Sun", 3, NULL,
      high_q, high_v, 5, 1, 1, 1, 3, { POTENTIAL(central), POTENTIAL(zonal),
                       ONE_BY_ONE(tesseral), POTENTIAL(third_bodies) } },
    { "drag",  "satellite at 320 km: gravity, J2-J6 | drag", 3, NULL, air_q, air_v,
      20, 1, 1, 2, 1, { POTENTIAL(central), POTENTIAL(zonal), { .kind = GVI_FORCE, .points = drag } } },
    { "solar", "outer solar system: Sun and planet | planet and planet", 18, solar_mass, solar_q, solar_v,
      40, 4332.6, 30, 1, 1, { POTENTIAL(sun), POTENTIAL(planets) } },
    { "stars", "eight double stars: near pairs | far pairs", 48, star_mass, star_q, star_v,
      6, 6.283185307179586, 1, 1, 1, { POTENTIAL(near), POTENTIAL(far) } },
};

static const scene *scene_named(const char *key)
{
    for (int i = 0; i < COUNT(scenes); ++i) if (!strcmp(scenes[i].key, key)) return scenes + i;
    return NULL;
}

/* Perigee on the x axis of a plane inclined by i                                                */
static void orbit(double a, double e, double i, double *q, double *v)
{
    const double speed = sqrt((1 + e)/(1 - e)/a);
    q[0] = a*(1 - e);
    v[1] = speed*cos(i);
    v[2] = speed*sin(i);
}

static void set_up(void)
{
    const double circle = 6.283185307179586;
    make_field();
    place_stars();
    orbit(1.1113, 0.01, 0.9, low_q, low_v);
    orbit(4.164, 0.01, 0.96, high_q, high_v);
    orbit(1.05, 0.005, 0.9, air_q, air_v);
    for (int i = 0; i < COUNT(scenes); ++i) {
        scene *p = scenes + i;
        const double a = p->q == low_q ? 1.1113 : p->q == high_q ? 4.164 : 1.05;
        if (p->n == 3) p->period = circle*a*sqrt(a);
        if (p->n == 3) p->unit = a;
        p->end *= p->period;
    }
}

/* --------------------------------------------------------------- the stepper */

enum { HERE, PLAIN, MARKED };     /* the stepper of this file; gvi.h; gvi.h, the weak marked      */

typedef struct setting {
    int    degree;             /* s; also the points of the leading rule                         */
    int    points;             /* of the weak: 0, the leading rule; -2, both ends of the step    */
    int    modes;              /* that the weak see; 0: s                                        */
    int    by;                 /* HERE, PLAIN, MARKED                                           */
    double tolerance;
    int    start;              /* from 0: two steps' forces; 1: one step's; -1: none             */
    int    broken;             /* S not symmetric: for the test of symplecticity to fail         */
} setting;

typedef struct rule {
    int        r, modes, reads_velocity, count;
    gvi_effect effects[2*EFFECTS];
    int        weak[2*EFFECTS];
    lanes      c, less, b, hb, t;
    lanes      g[RULES][LANES], m[RULES][LANES], E[2*LANES];
    lanes      Q[MOST], V[MOST], L[MOST], store[3][MOST];
    lanes     *F[3];                          /* forces now, in the last step, in the one before */
} rule;

typedef struct stepper {
    int    n, rules, past, most, fresh;           /* steps known, and used, for a start           */
    double tolerance, t, te, h;
    double q[MOST], qe[MOST], p[MOST], pe[MOST], v0[MOST], over[MOST], scale[2*MOST];
    rule   rule[RULES];
    long long steps, iterations, points[2];
} stepper;

static void legendre(int s, long double tau, long double *phi, long double *Phi)
{
    long double X = 1 - 2*tau, P = 1, before = 1;
    for (int k = 0; k < s; ++k) {
        long double next = ((2*k + 1)*X*P - k*before)/(k + 1);
        phi[k] = P;
        Phi[k] = (before - next)/(4*k + 2);
        before = P;
        P = next;
    }
}

/* Multiples of 2^-53: c - S is exact then, and as symmetric as S                                 */
static double on_grid(double a) { return ldexp(rint(ldexp(a, 53)), -53); }

/* c - S and 1 - T from rule e to rule g, column j for its node j                                */
static void make_tables(rule *g, const rule *e, int modes, lanes *S, lanes *T)
{
    for (int i = 0; i < g->r; ++i)
        for (int j = 0; j < e->r; ++j) {
            long double a[LANES], A[LANES], b[LANES], B[LANES], s = 0, t = 0;
            legendre(modes, g->c[i], a, A);
            legendre(modes, e->c[j], b, B);
            for (int k = 0; k < modes; ++k) {
                s += (2*k + 1)*A[k]*B[k];
                t += (2*k + 1)*a[k]*B[k];
            }
            S[j][i] = g->c[i] - on_grid((double)s);
            T[j][i] = (double)(1 - t);
        }
}

/* As gvi__fit in gvi.h: least squares through the forces of one step or two.                    */
static void fit(rule *g, int known)
{
    const int r = g->r, nodes = known*r, all = nodes + r;
    const int degree = known == 1 ? r - 1 : r + r/2 - r/8;
    double at[3*LANES], P[3*LANES], before[3*LANES] = { 0 }, coupling = 0;
    memset(g->E, 0, sizeof g->E);
    for (int m = 0; m < all; ++m) {                    /* the last step, the one before, the next */
        at[m] = g->c[m % r] + (m < nodes ? -(m/r) : 1);
        P[m] = 1/sqrt(nodes);
    }
    for (int k = 0; k <= degree; ++k) {
        double middle = 0, size = 0;
        for (int j = 0; j < nodes; ++j)
            for (int i = 0; i < r; ++i) g->E[j/r*LANES + j % r][i] += P[nodes + i]*P[j];
        for (int m = 0; m < nodes; ++m) middle += at[m]*P[m]*P[m];
        for (int m = 0; m < all; ++m) {
            double next = (at[m] - middle)*P[m] - coupling*before[m];
            before[m] = P[m];
            P[m] = next;
            if (m < nodes) size += next*next;
        }
        coupling = sqrt(size);
        for (int m = 0; m < all; ++m) P[m] /= coupling;
    }
}

static void set_rule(rule *g, int points, int modes, double h)
{
    double c[LANES] = { 0 }, b[LANES] = { 0 };
    g->r = abs(points);
    g->modes = modes;
    if (points > 0) gvi_gauss(g->r, c, b);
    else gvi_lobatto(g->r, c, b);
    for (int i = 0; i < LANES; ++i) {
        g->c[i] = on_grid(c[i]);
        g->b[i] = b[i];
        g->less[i] = i < g->r ? 1 - g->c[i] : 0;
    }
    g->hb = h*g->b;
    for (int i = 0; i < 3; ++i) g->F[i] = g->store[i];
}

static void add_effect(rule *g, const gvi_effect *e, int weak)
{
    g->effects[g->count] = *e;
    g->weak[g->count++] = weak;
    if (e->kind == GVI_FORCE) g->reads_velocity = 1;
}

static void begin(stepper *st, const scene *p, const setting *u, double h)
{
    const int s = u->degree, modes = u->modes && u->modes < s ? u->modes : s;
    memset(st, 0, sizeof *st);
    st->n = p->n;
    st->h = h;
    st->rules = u->points ? 2 : 1;
    st->tolerance = u->tolerance > 0 ? u->tolerance : GVI__EPS/65536;
    st->most = u->start ? u->start > 0 : 3;
    set_rule(st->rule, s, s, h);
    if (u->points) set_rule(st->rule + 1, u->points, modes, h);
    for (int i = 0; i < p->leading + p->weak; ++i) {
        const int weak = i >= p->leading;
        add_effect(st->rule + (weak && u->points), p->effects + i, weak);
    }
    for (int g = 0; g < st->rules; ++g)
        for (int e = 0; e < st->rules; ++e) {
            const int least = g + e ? modes : s, all = u->broken && e == 0;
            make_tables(st->rule + g, st->rule + e, all ? s : least, st->rule[g].g[e], st->rule[g].m[e]);
        }
    for (int i = 0; i < p->n; ++i) {
        st->over[i] = p->mass ? 1/p->mass[i] : 1;
        st->q[i] = p->q[i];
        st->p[i] = p->mass ? p->mass[i]*p->v[i] : p->v[i];
    }
}

/* z += sum_j table[j] L_j                                                                       */
INLINE void sum_of(int r, const lanes *table, const double *L, lanes *z)
{
    lanes a = table[0]*L[0], b = { 0 };
    for (int j = 1; j < r; j += 2) b += table[j]*L[j];
    for (int j = 2; j < r; j += 2) a += table[j]*L[j];
    *z += a + b;
}

INLINE void add_sum(int r, const lanes *table, const lanes *row, lanes *z)
{
    const double *L = (const double *)row;
    switch (r) {
    case 8:  sum_of(8, table, L, z); break;
    case 6:  sum_of(6, table, L, z); break;
    case 4:  sum_of(4, table, L, z); break;
    case 3:  sum_of(3, table, L, z); break;
    case 2:  sum_of(2, table, L, z); break;
    case 1:  sum_of(1, table, L, z); break;
    default: sum_of(r, table, L, z);
    }
}

static double lane_sum(const lanes *a)
{
    const double *z = (const double *)a;
    return ((z[0] + z[4]) + (z[1] + z[5])) + ((z[2] + z[6]) + (z[3] + z[7]));
}

/* 1/unit of a row's changes, made anew where st->fresh                                          */
static void rescale(const stepper *st, double base, double was, double is, double *scale)
{
    const double size = fabs(base) + fabs(was - base) + fabs(is - base);
    if (st->fresh) *scale = size > GVI__MIN/GVI__EPS ? 1/size : 0;
}

/* Rows of one rule: base + (extra + (c slope + factor sum)); adds the squares of their changes   */
INLINE void rows_of(stepper *st, rule *g, int by_v, lanes *squares)
{
    const rule *e = st->rule;
    const int r0 = e[0].r, r1 = st->rules > 1 ? e[1].r : 0;
    for (int i = 0; i < st->n; ++i) {
        const double base = by_v ? st->v0[i] : st->q[i], extra = by_v ? st->over[i]*st->pe[i] : st->qe[i];
        const double slope = by_v ? 0 : st->h*st->v0[i], factor = by_v ? st->over[i] : st->h*st->over[i];
        double *scale = st->scale + (by_v ? MOST : 0) + i;
        lanes z = { 0 }, *row = (by_v ? g->V : g->Q) + i;
        add_sum(r0, by_v ? g->m[0] : g->g[0], e[0].L + i, &z);
        if (r1) add_sum(r1, by_v ? g->m[1] : g->g[1], e[1].L + i, &z);
        z = base + (extra + (g->c*slope + factor*z));
        if (g == st->rule) rescale(st, base, (*row)[r0 - 1], z[r0 - 1], scale);
        const lanes moved = (z - *row)* *scale;
        *squares += moved*moved;
        *row = z;
    }
}

static double stages(stepper *st)
{
    lanes squares = { 0 };
    for (int g = 0; g < st->rules; ++g) {
        rule *e = st->rule + g;
        for (int i = 0; i < st->n; ++i) e->L[i] = e->hb*e->F[0][i];
    }
    for (int g = 0; g < st->rules; ++g) rows_of(st, st->rule + g, 0, &squares);
    for (int g = 0; g < st->rules; ++g)
        if (st->rule[g].reads_velocity) rows_of(st, st->rule + g, 1, &squares);
    return lane_sum(&squares);
}

static void ask(stepper *st)
{
    for (int k = 0; k < st->rules; ++k) {
        rule *g = st->rule + k;
        gvi_points x = { .n = st->n, .count = g->r, .stride = LANES, .t = (double *)&g->t,
                         .q = (double *)g->Q, .f = (double *)g->F[0] };
        memset(g->F[0], 0, sizeof(lanes)*(size_t)st->n);
        for (int i = 0; i < g->count; ++i) {
            const gvi_effect *e = g->effects + i;
            x.v = e->kind == GVI_FORCE ? (double *)g->V : NULL;
            st->points[g->weak[i]] += g->r;
            e->points(&x, e->user);
        }
    }
}

static void guess(stepper *st)
{
    for (int k = 0; k < st->rules; ++k) {
        rule *g = st->rule + k;
        const int known = st->past < 2 ? st->past : 2;
        if (known == 0) memset(g->F[0], 0, sizeof(lanes)*(size_t)st->n);
        if (known > 0 && st->past <= st->most && st->past < 3) fit(g, known);
        for (int i = 0; i < st->n && known > 0; ++i) {
            lanes z = { 0 };
            add_sum(g->r, g->E, g->F[1] + i, &z);
            if (known > 1) add_sum(g->r, g->E + LANES, g->F[2] + i, &z);
            g->F[0][i] = z;
        }
    }
}

/* Within four units of the last place at the last point                                          */
static int is_rounding(const stepper *st, const double *was)
{
    for (int i = 0; i < st->n; ++i) {
        const double Q = st->rule[0].Q[i][st->rule[0].r - 1];
        if (!(fabs(Q - was[i]) <= 4*GVI__EPS*fabs(Q))) return 0;
    }
    return 1;
}

/* The iteration of gvi__fixed_point                                                            */
static int solve(stepper *st)
{
    const double enough = st->tolerance*st->tolerance, rounding = 16*GVI__EPS*GVI__EPS*st->n*st->rule[0].r;
    double was[MOST], before = 0, least = HUGE_VAL;
    int idle = 0;
    guess(st);
    stages(st);
    st->fresh = 1;
    for (int used = 1; used <= 60; ++used) {
        ask(st);
        st->iterations += 1;
        for (int i = 0; i < st->n; ++i) was[i] = st->rule[0].Q[i][st->rule[0].r - 1];
        const double change = stages(st), known = before > 1 ? 1 : before > 0 ? before : change;
        if (!(change <= GVI__MAX)) return 1;
        if (change*change <= enough*known) return 0;
        idle = change < least*0.81 ? 0 : idle + 1;
        if (change < least) least = change;
        if ((idle > 2 && change <= rounding) || (idle > 1 && is_rounding(st, was))) return ask(st), 0;
        st->fresh = before > 0 && change >= before/4;
        before = change;
    }
    return 1;
}

/* x + xe := x + d + xe                                                                          */
static void add(double d, double *x, double *xe)
{
    const gvi__two a = gvi__sum(*x, d), b = gvi__sum(a.hi, a.lo + *xe);
    *x = b.hi;
    *xe = b.lo;
}

static void commit(stepper *st)
{
    for (int i = 0; i < st->n; ++i) {
        lanes all = { 0 }, path = { 0 };
        for (int g = 0; g < st->rules; ++g) {
            const lanes L = st->rule[g].hb*st->rule[g].F[0][i];
            all += L;
            path += st->rule[g].less*L;
        }
        add(st->h*(st->v0[i] + st->over[i]*(st->pe[i] + lane_sum(&path))), st->q + i, st->qe + i);
        add(lane_sum(&all), st->p + i, st->pe + i);
    }
    for (int k = 0; k < st->rules; ++k) {
        rule *g = st->rule + k;
        lanes *f = g->F[2];
        for (int i = 2; i > 0; --i) g->F[i] = g->F[i - 1];
        g->F[0] = f;
    }
    st->past = st->past < st->most ? st->past + 1 : st->most;
    st->steps += 1;
    add(st->h, &st->t, &st->te);
}

/* 0, or 1 where the iteration does not end                                                      */
static int step(stepper *st)
{
    for (int i = 0; i < st->n; ++i) st->v0[i] = st->over[i]*st->p[i];
    for (int g = 0; g < st->rules; ++g) st->rule[g].t = st->t + (st->te + st->rule[g].c*st->h);
    if (solve(st)) return 1;
    commit(st);
    return 0;
}

/* ---------------------------------------------------------------------- runs */

typedef struct result {
    double q[MOST], p[MOST], time, error;          /* us in all                                  */
    double iterations, points[2];                  /* a step; asked of leading and weak effects  */
} result;

static double cpu_us(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e6 + (double)t.tv_nsec*1e-3;
}

/* max |q - reference| in the scene's unit; infinite where the run ended early                   */
static double distance(const scene *p, const double *q, const double *reference)
{
    double worst = 0;
    for (int i = 0; i < p->n; ++i) {
        const double d = fabs(q[i] - reference[i])/p->unit;
        if (!(d <= worst)) worst = d;
    }
    return worst >= 0 ? worst : HUGE_VAL;
}

static stepper     here;
static gvi_stepper there;

static void begin_gvi(const scene *p, const setting *u)
{
    static double memory[GVI_LENGTH(MOST, 16, 16)];
    static gvi_effect effects[2*EFFECTS];
    const gvi_formulation pinned = p->effects[p->leading].kind == GVI_FORCE ? GVI_VELOCITIES : GVI_POSITIONS;
    const gvi_mass mass = { .kind = p->mass ? GVI_MASS_DIAGONAL : GVI_MASS_UNIT, .matrix = p->mass };
    const gvi_desc desc = { .n = p->n, .degree = u->degree, .effects = effects, .mass = mass,
                            .effect_count = p->leading + p->weak, .formulation = pinned,
                            .tolerance = u->tolerance };
    memcpy(effects, p->effects, sizeof effects);
    for (int i = p->leading; i < p->leading + p->weak; ++i) effects[i].weak = u->by == MARKED;
    gvi_init(&there, &desc, memory, sizeof memory);
    gvi_start(&there, 0, p->q, p->v);
}

static void start(const scene *p, const setting *u, double h)
{
    if (u->by == HERE) begin(&here, p, u, h);
    else begin_gvi(p, u);
}

static int go(const setting *u, double h)
{
    return u->by == HERE ? step(&here) : gvi_step(&there, h) != GVI_OK;
}

static const double *q_now(const setting *u) { return u->by == HERE ? here.q : there.q; }
static const double *p_now(const setting *u) { return u->by == HERE ? here.p : there.p; }

static void count(const scene *p, const setting *u, double steps, result *r)
{
    const gvi_counters *a = &there.counters;
    r->iterations = (double)(u->by == HERE ? (unsigned long long)here.iterations : a->iterations)/steps;
    for (int i = 0; i < 2; ++i) r->points[i] = u->by == HERE ? (double)here.points[i]/steps : 0;
    for (int e = 0; u->by != HERE && e < p->leading + p->weak; ++e)
        r->points[e >= p->leading] += (double)a->effect[e]/steps;
}

static void run(const scene *p, const setting *u, long steps, int times, const double *reference, result *r)
{
    const double h = p->end/(double)steps;
    int failed = 0;
    r->time = HUGE_VAL;
    for (int k = 0; k < times && !failed; ++k) {
        start(p, u, h);
        const double began = cpu_us();
        for (long i = 0; i < steps && !failed; ++i) failed = go(u, h);
        const double time = cpu_us() - began;
        if (time < r->time) r->time = time;
    }
    memcpy(r->q, q_now(u), sizeof(double)*(size_t)p->n);
    memcpy(r->p, p_now(u), sizeof(double)*(size_t)p->n);
    if (failed) r->q[0] = HUGE_VAL;
    count(p, u, (double)steps, r);
    r->error = reference ? distance(p, r->q, reference) : 0;
}

static int failures;

static void check(int good, const char *what)
{
    if (!good) ++failures;
    printf("  %s  %s\n", good ? "ok    " : "FAILED", what);
}

/* gvi.h of degree 12, steps of a 96th of the period                                             */
static long fine_steps(const scene *p) { return lround(p->end/p->period*96); }

static void refer(const scene *p, double *q)
{
    const setting fine = { .degree = 12, .by = PLAIN };
    result r;
    run(p, &fine, fine_steps(p), 1, NULL, &r);
    memcpy(q, r.q, sizeof r.q);
}

/* ---------------------------------------------- the stepper beside gvi.h, prices */

static double references[COUNT(scenes)][MOST];

static long steps_for(const scene *p, double a_period) { return lround(p->end/p->period*a_period); }
static const double *reference_of(const scene *p) { return references[p - scenes]; }

static void beside_gvi(void)
{
    int alike = 1;
    printf("\nThe stepper beside gvi.h, all effects on 8 points, 12 steps a period\n"
           "         iterations a step    us a step          q apart\n"
           "  scene     here     gvi.h     here   gvi.h\n");
    for (int i = 0; i < COUNT(scenes); ++i) {
        const scene *p = scenes + i;
        const setting u = { .degree = 8 }, gvi = { .degree = 8, .by = PLAIN };
        const long steps = steps_for(p, 12);
        result a, b;
        run(p, &u, steps, 5, NULL, &a);
        run(p, &gvi, steps, 5, NULL, &b);
        const double apart = distance(p, a.q, b.q);
        printf("  %-6s %7.2f   %7.2f  %7.2f %7.2f   %8.1e\n", p->key, a.iterations, b.iterations,
               a.time/(double)steps, b.time/(double)steps, apart);
        alike &= apart < 1e-11 && fabs(a.iterations - b.iterations) < 1;
    }
    check(alike, "the same q to 1e-11, iterations to 1");
}

static double price(const gvi_effect *e, const scene *p, int count)
{
    static lanes q[MOST], v[MOST], f[MOST], t;
    gvi_points x = { .n = p->n, .count = count, .stride = LANES, .t = (double *)&t, .q = (double *)q,
                     .v = (double *)v, .f = (double *)f };
    double best = HUGE_VAL;
    for (int i = 0; i < p->n; ++i)
        for (int k = 0; k < LANES; ++k) {
            q[i][k] = p->q[i] + 0.01*k;
            v[i][k] = p->v[i];
        }
    for (int k = 0; k < 7; ++k) {
        const int calls = 500;
        const double start = cpu_us();
        for (int m = 0; m < calls; ++m) e->points(&x, e->user);
        const double time = (cpu_us() - start)*1e3/calls;
        if (time < best) best = time;
    }
    return best;
}

static void prices(void)
{
    static const struct { const char *name, *scene; int effect; } list[] = {
        { "gravity", "J2", 0 }, { "J2 to J6", "J2", 1 }, { "degree 20, points in vectors", "low", 2 },
        { "degree 20, one by one", "low1", 2 }, { "Moon, Sun", "moon", 2 }, { "drag", "drag", 2 },
        { "Sun and planet", "solar", 0 }, { "planet and planet", "solar", 1 },
        { "8 near pairs", "stars", 0 }, { "112 far pairs", "stars", 1 } };
    static const int counts[] = { 8, 4, 3, 2, 1 };
    printf("\nAn effect at so many points, ns a call\n  %-30s", "");
    for (int k = 0; k < COUNT(counts); ++k) printf("%8d", counts[k]);
    for (int i = 0; i < COUNT(list); ++i) {
        const scene *p = scene_named(list[i].scene);
        printf("\n  %-30s", list[i].name);
        for (int k = 0; k < COUNT(counts); ++k)
            printf("%8.0f", price(p->effects + list[i].effect, p, counts[k]));
    }
    printf("\n");
}

/* ---------------------------------------------------------------- own rule: errors */

static const setting own_settings[] = {
    { .degree = 8 }, { .degree = 8, .points = 4, .modes = 4 }, { .degree = 8, .points = 4 },
    { .degree = 8, .points = 3, .modes = 3 }, { .degree = 8, .points = 3 },
    { .degree = 8, .points = 2, .modes = 2 }, { .degree = 8, .points = 2 },
    { .degree = 8, .points = 1 }, { .degree = 8, .points = -2 } };

static void name_of(const setting *u, char *name)
{
    if (u->points == 0) strcpy(name, "8, leading rule");
    else if (u->points < 0) strcpy(name, "2, at both ends");
    else snprintf(name, 40, "%d, degree %d", u->points, u->modes ? u->modes : u->degree);
}

static void errors_of(const scene *p)
{
    static const double a_period[] = { 6, 12, 24, 48 };
    printf("\nErrors of q at the end, own rule for the weak.  %s\n"
           "  weak: points, degree    steps a period   6        12        24        48"
           "  |  at 12, strength   |  at 12, a step: us,\n"
           "%77s|  0.1       0.01     |  iterations, weak points\n", p->title, "");
    for (int i = 0; i < COUNT(own_settings); ++i) {
        result r, once = { .time = 0 };
        char name[40];
        name_of(own_settings + i, name);
        printf("  %-28s", name);
        for (int k = 0; k < COUNT(a_period); ++k) {
            run(p, own_settings + i, steps_for(p, a_period[k]), k == 1 ? 5 : 1, reference_of(p), &r);
            printf("  %8.1e", r.error);
            if (k == 1) once = r;
        }
        printf("  |");
        for (int k = 1; k < 3; ++k) {
            double q[MOST];
            strength = k == 1 ? 0.1 : 0.01;
            refer(p, q);
            run(p, own_settings + i, steps_for(p, 12), 1, q, &r);
            printf("  %8.1e", r.error);
        }
        strength = 1;
        printf("  | %7.2f %6.2f %7.1f\n", once.time/(double)steps_for(p, 12), once.iterations,
               once.points[1]);
    }
}

static void errors(void)
{
    static const char *const shown[] = { "J2", "low", "moon", "drag", "solar", "stars" };
    for (int i = 0; i < COUNT(shown); ++i) errors_of(scene_named(shown[i]));
}

/* ---------------------------------------------------------------- own rule: orders */

/* The order from a to b steps a period of the part of the error that is odd, or even, in the
   strength of the weak effects                                                                  */
static double order_of(const setting *u, double by, int even, const double *a_period)
{
    scene p = *scene_named("J2");
    double error[2] = { 0, 0 };
    p.end = 2*p.period;                             /* so that rounding has not grown yet        */
    for (int k = 0; k < 2; ++k) {
        double q[2][MOST];
        result r[2];
        for (int i = 0; i < 2; ++i) {
            strength = i ? -by : by;
            refer(&p, q[i]);
            run(&p, u, steps_for(&p, a_period[k]), 1, NULL, r + i);
        }
        for (int i = 0; i < 3; ++i) {
            const double plus = r[0].q[i] - q[0][i], minus = r[1].q[i] - q[1][i];
            error[k] = fmax(error[k], fabs(even ? plus + minus : plus - minus));
        }
    }
    strength = 1;
    return log(error[0]/error[1])/log(a_period[1]/a_period[0]);
}

/* An error of first order in the strength e is that of the rule, e h^u; of second order, e^2 h^2 or
   e^2 h^(2(u-s+1)): the highest modes of the curve, which the rule does not see properly.       */
static void orders(void)
{
    static const struct { int points, odd, even; double by, o[2], e[2], own[2]; } list[] = {
        { 1, 2, 2, 1, { 48, 96 }, { 48, 96 }, { 64, 128 } },
        { 2, 4, 2, 0.1, { 20, 40 }, { 48, 96 }, { 32, 64 } },
        { 3, 6, 2, 0.03, { 20, 28 }, { 48, 96 }, { 24, 48 } },
        { 4, 8, 2, 0.03, { 12, 16 }, { 32, 64 }, { 16, 32 } },
        { 5, 0, 6, 0, { 0, 0 }, { 16, 32 }, { 12, 20 } },
        { 6, 0, 10, 0, { 0, 0 }, { 10, 16 }, { 10, 15 } } };
    int good = 1;
    printf("\nOrders, gravity | J2-J6 of strength e, s = 8: of the error ~ e, of that ~ e^2; own degree\n"
           "  weak points       e  theory      e^2  theory    own degree  theory\n");
    for (int i = 0; i < COUNT(list); ++i) {
        const int n = list[i].points;
        const setting full = { .degree = 8, .points = n }, own = { .degree = 8, .points = n, .modes = n };
        const double a = list[i].odd ? order_of(&full, list[i].by, 0, list[i].o) : 0,
                     b = order_of(&full, 30, 1, list[i].e), c = order_of(&own, 30, 0, list[i].own);
        printf("  %11d  ", n);
        if (list[i].odd) printf("%6.2f  %6d", a, list[i].odd);
        else printf("%14s", "not seen");
        printf("   %6.2f  %6d    %10.2f  %6d\n", b, list[i].even, c, 2*n);
        good &= fabs(a - list[i].odd) < 0.5 && fabs(b - list[i].even) < 0.5 && fabs(c - 2*n) < 0.5;
    }
    check(good, "orders, to 1/2");
}

/* -------------------------------------------------------- symplecticity, momentum */

static void map_of(const scene *p, const setting *u, const double *x, double h, double *y)
{
    scene from = *p;
    result r;
    from.q = x;
    from.v = x + p->n;
    from.end = h;
    run(&from, u, 1, 1, NULL, &r);
    memcpy(y, r.q, sizeof(double)*(size_t)p->n);
    memcpy(y + p->n, r.p, sizeof(double)*(size_t)p->n);
}

/* Largest entry of J' Omega J - Omega after a step of an eighth of the period, n = 3, J by central
   differences of order 8                                                                       */
static double asymmetry(const scene *p, const setting *u)
{
    enum { D = 6 };
    static const double weight[4] = { 4/5.0, -1/5.0, 4/105.0, -1/280.0 };
    const double d = 0.004;
    double J[D][D] = { { 0 } }, x[D], y[D], worst = 0;
    for (int j = 0; j < D; ++j)
        for (int k = 1; k < 5; ++k)
            for (int side = -1; side < 2; side += 2) {
                memcpy(x, p->q, sizeof x/2);
                memcpy(x + 3, p->v, sizeof x/2);
                x[j] += side*k*d;
                map_of(p, u, x, p->period/8, y);
                for (int i = 0; i < D; ++i) J[i][j] += side*weight[k - 1]*y[i]/d;
            }
    for (int i = 0; i < D; ++i)
        for (int j = 0; j < D; ++j) {
            double sum = i + 3 == j ? -1 : j + 3 == i ? 1 : 0;
            for (int k = 0; k < 3; ++k) sum += J[k][i]*J[k + 3][j] - J[k + 3][i]*J[k][j];
            if (!(fabs(sum) <= worst)) worst = fabs(sum);
        }
    return worst;
}

static void symplecticity(void)
{
    static const struct { const char *name; setting u; } list[] = {
        { "8, leading rule", { .degree = 8 } },
        { "4, degree 8", { .degree = 8, .points = 4 } },
        { "2, degree 8", { .degree = 8, .points = 2 } },
        { "2, degree 2", { .degree = 8, .points = 2, .modes = 2 } },
        { "1, degree 8", { .degree = 8, .points = 1 } },
        { "2, at both ends", { .degree = 8, .points = -2 } },
        { "gvi.h, marked", { .degree = 8, .by = MARKED } },
        { "2, S not symmetric", { .degree = 8, .points = 2, .modes = 2, .broken = 1 } } };
    double value[COUNT(list)], worst = 0;
    printf("\n|J' Omega J - Omega| of a step of an eighth of the period, J2 times 30; field of degree 20\n");
    for (int i = 0; i < COUNT(list); ++i) {
        strength = 30;
        value[i] = asymmetry(scene_named("J2"), &list[i].u);
        strength = 1;
        const double other = asymmetry(scene_named("low"), &list[i].u);
        printf("  %-28s %8.1e  %8.1e\n", list[i].name, value[i], other);
        if (i < COUNT(list) - 1) worst = fmax(worst, fmax(value[i], other));
    }
    check(worst < 2e-12, "below 2e-12, all but the last");
    check(value[COUNT(list) - 1] > 1e-6, "the last is above 1e-6");
}

/* Energy and angular momentum of bodies with masses times G; energies of pairs by mass product    */
static void invariants(const scene *p, const setting *u, double *E, double *L)
{
    *E = L[0] = L[1] = L[2] = 0;
    for (int i = 0; i < p->n; i += 3) {
        const double *a = q_now(u) + i, *w = p_now(u) + i;
        for (int c = 0; c < 3; ++c) {
            *E += w[c]*w[c]/(2*p->mass[i]);
            L[c] += a[(c + 1)%3]*w[(c + 2)%3] - a[(c + 2)%3]*w[(c + 1)%3];
        }
        for (int j = 0; j < i; j += 3) {
            const double *b = q_now(u) + j, x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
            *E -= p->mass[i]*p->mass[j]/sqrt(x*x + y*y + z*z);
        }
    }
}

/* Largest relative change of the energy and of angular momentum, and what is left of it at the end */
static void long_run(const scene *p, const setting *u, double a_period, long steps, double *worst,
                     double *last)
{
    double E0, L0[3], E, L[3], size, h = p->period/a_period;
    long k = 0;
    start(p, u, h);
    invariants(p, u, &E0, L0);
    size = sqrt(L0[0]*L0[0] + L0[1]*L0[1] + L0[2]*L0[2]);
    worst[0] = worst[1] = 0;
    for (; k < steps && !go(u, h); ++k) {
        if (k % 64) continue;
        invariants(p, u, &E, L);
        last[0] = fabs(E/E0 - 1);
        for (int c = 0; c < 3; ++c) L[c] -= L0[c];
        last[1] = sqrt(L[0]*L[0] + L[1]*L[1] + L[2]*L[2])/size;
        for (int i = 0; i < 2; ++i) if (!(last[i] <= worst[i])) worst[i] = last[i];
    }
    if (k < steps) worst[0] = worst[1] = HUGE_VAL;
}

static void momentum(long steps)
{
    static const struct { const char *name; setting u; } list[] = {
        { "8, leading rule", { .degree = 8 } },
        { "gvi.h, marked", { .degree = 8, .by = MARKED } },
        { "4, degree 8", { .degree = 8, .points = 4 } },
        { "2, degree 8", { .degree = 8, .points = 2 } },
        { "2, degree 2", { .degree = 8, .points = 2, .modes = 2 } },
        { "2, S not symmetric", { .degree = 8, .points = 2, .modes = 2, .broken = 1 } } };
    double all = 0, worst[2];
    printf("\nOuter solar system, %ld steps, 16 a period: largest relative error, and at the end\n"
           "  %-28s    energy               angular momentum\n", steps, "");
    for (int i = 0; i < COUNT(list); ++i) {
        double last[2] = { 0, 0 };
        long_run(scene_named("solar"), &list[i].u, 16, steps, worst, last);
        printf("  %-28s  %8.1e  %8.1e   %8.1e  %8.1e\n", list[i].name, worst[0], last[0], worst[1], last[1]);
        if (i < COUNT(list) - 1 && !(worst[1] <= all)) all = worst[1];
    }
    check(all < 1e-12, "angular momentum to 1e-12, all but the last");
    check(worst[1] > 1e-9, "the last is above 1e-9");
}

/* --------------------------------------------------- marked as weak, in gvi.h itself */

/* Evaluations of a weak effect in a step                                                        */
static double asked(const scene *p, const result *r) { return r->points[1]/(8*p->weak); }

static void marked_in(const scene *p, double tolerance, double a_period, double *apart)
{
    const long steps = steps_for(p, a_period);
    result r[2];
    for (int k = 0; k < 2; ++k) {
        const setting u = { .degree = 8, .tolerance = tolerance, .by = k ? MARKED : PLAIN };
        run(p, &u, steps, 5, reference_of(p), r + k);
        printf(k ? "  | %5.2f %5.2f %8.2f %8.1e" : "  %5.2f %5.2f %8.2f %8.1e", r[k].iterations,
               asked(p, r + k), r[k].time/(double)steps, r[k].error);
    }
    *apart = distance(p, r[1].q, r[0].q);
    printf("  %8.1e\n", *apart);
}

static void marked(void)
{
    static const double tolerances[] = { 0, 1e-11, 1e-8 }, a_period[] = { 8, 16 };
    double apart, worst = 0;
    printf("\ngvi.h, 8 points: iterations a step, evaluations of the weak, time a step, error; the same\n"
           "with the weak marked; q apart\n  scene  tolerance  a period   it  asked      us    error  |"
           "    it asked       us    error     apart\n");
    for (int i = 0; i < COUNT(scenes); ++i)
        for (int t = 0; t < COUNT(tolerances); ++t)
            for (int k = 0; k < COUNT(a_period); ++k) {
                printf("  %-6s %8.0e %8.0f", scenes[i].key, tolerances[t], a_period[k]);
                marked_in(scenes + i, tolerances[t], a_period[k], &apart);
                if (t == 0) worst = fmax(worst, apart);
            }
    check(worst < 1e-11, "at tolerance 0 the same q to 1e-11");
}

/* The mark on an effect that is not weak                                                        */
static void strong(void)
{
    static const double factors[] = { 10, 30, 100 };
    const scene *p = scene_named("J2");
    double worst = 0;
    printf("\nThe same, J2-J6 times 10, 30, 100, 12 steps a period: iterations; marked: iterations,\n"
           "evaluations, q apart\n");
    for (int k = 0; k < COUNT(factors); ++k) {
        const setting plain = { .degree = 8, .by = PLAIN }, wrong = { .degree = 8, .by = MARKED };
        result a, b;
        strength = factors[k];
        run(p, &plain, steps_for(p, 12), 1, NULL, &a);
        run(p, &wrong, steps_for(p, 12), 1, NULL, &b);
        printf("  %4.0f  %5.2f  %5.2f %5.2f  %8.1e\n", strength, a.iterations, b.iterations, asked(p, &b),
               distance(p, a.q, b.q));
        worst = fmax(worst, distance(p, a.q, b.q));
    }
    strength = 1;
    check(worst < 1e-11, "the same q to 1e-11");
}

/* Evaluations a step by what the iteration starts from                                          */
static void starts(void)
{
    static const int from[] = { -1, 1, 0 };
    printf("\nIterations a step, all on 8 points, 12 steps a period, by the start: no force; the forces\n"
           "of the last step, extrapolated; of the last two\n");
    for (int i = 0; i < COUNT(scenes); ++i) {
        printf("  %-6s", scenes[i].key);
        for (int k = 0; k < COUNT(from); ++k) {
            const setting u = { .degree = 8, .start = from[k] };
            result r;
            run(scenes + i, &u, steps_for(scenes + i, 12), 1, NULL, &r);
            printf("  %6.2f", r.iterations);
        }
        printf("\n");
    }
}

/* ----------------------------------------------------------------- time to an error */

enum { FAMILIES = 6, TARGETS = 3, MOST_SETTINGS = 64, CHOICE = 4 };
static const double targets[TARGETS] = { 1e-4, 1e-7, 1e-10 };
static const char *const families[FAMILIES] = {
    "leading rule", "own rule, degree s", "own rule, own degree", "both ends", "gvi.h", "gvi.h, marked" };

typedef struct best { setting u; long steps; double time; } best;
typedef best choice[TARGETS][CHOICE];

static int settings_of(int family, setting *list)
{
    static const double tolerances[] = { 0, 1e-11, 1e-8 };
    static const int degrees[] = { 4, 6, 8 }, points[] = { 1, 2, 3, 4, 6 };
    int count = 0;
    for (int t = 0; t < COUNT(tolerances); ++t)
        for (int s = 0; s < COUNT(degrees); ++s) {
            const setting u = { .degree = degrees[s], .tolerance = tolerances[t] };
            for (int k = 0; k < COUNT(points); ++k) {
                setting w = u;
                if (family == 1 || family == 2) {
                    if (points[k] >= degrees[s] || (family == 2 && points[k] == 1)) continue;
                    w.points = points[k];
                    w.modes = family == 2 ? points[k] : 0;
                } else if (k > 0) break;
                if (family == 3) w.points = -2;
                w.by = family < 4 ? HERE : family == 4 ? PLAIN : MARKED;
                list[count++] = w;
            }
        }
    return count;
}

/* The fastest first                                                                             */
static void insert(best *list, const best *found)
{
    int k = CHOICE - 1;
    if (!(found->time < list[k].time)) return;
    for (; k > 0 && found->time < list[k - 1].time; --k) list[k] = list[k - 1];
    list[k] = *found;
}

/* The few fastest of all settings and steps with an error below each target                     */
static void best_of(const scene *p, int family, int fine, choice b)
{
    setting list[MOST_SETTINGS];
    const int count = settings_of(family, list);
    result r;
    for (int g = 0; g < TARGETS; ++g)
        for (int k = 0; k < CHOICE; ++k) b[g][k].time = HUGE_VAL;
    for (int i = 0; i < count; ++i)
        for (double a = 3; a < 50; a *= pow(2, 1.0/fine)) {
            const long steps = steps_for(p, a);
            run(p, list + i, steps, 2, reference_of(p), &r);
            const best found = { list[i], steps, r.time };
            for (int g = 0; g < TARGETS; ++g) if (r.error <= targets[g]) insert(b[g], &found);
            if (r.error <= targets[TARGETS - 1] || r.time > 3*b[TARGETS - 1][0].time) break;
        }
}

/* The chosen once more, in turn, so that what else the machine does falls on all of them alike;
   the least time of some runs, the best of those first                                          */
static void time_again(const scene *p, choice *b)
{
    enum { ROUNDS = 8, ALL = FAMILIES*TARGETS*CHOICE };
    best *all = &b[0][0][0];
    for (int k = 0; k < ROUNDS; ++k)
        for (int i = 0; i < ALL; ++i) {
            result r;
            if (!(all[i].time < HUGE_VAL)) continue;
            run(p, &all[i].u, all[i].steps, 1, NULL, &r);
            if (k == 0 || r.time < all[i].time) all[i].time = r.time;
        }
    for (int i = 0; i < ALL; ++i)
        if (all[i].time < all[i/CHOICE*CHOICE].time) all[i/CHOICE*CHOICE] = all[i];
}

static void print_best(const scene *p, const best *b, const best *leading)
{
    if (!(b->time < HUGE_VAL)) { printf("  |     -                               "); return; }
    char how[40];
    snprintf(how, sizeof how, "%d", b->u.degree);
    if (b->u.points) snprintf(how + strlen(how), 16, "/%d", abs(b->u.points));
    printf("  | %8.1f %5.2f  %-4s %4.1f %6.0e", b->time, leading->time/b->time, how,
           (double)b->steps*p->period/p->end, b->u.tolerance);
}

static void work_precision(int fine)
{
    printf("\nTime to an error, the best of s = 4, 6, 8, weak points, tolerance and step: us for the run,\n"
           "time on the leading rule (for gvi.h: that of gvi.h unmarked) over it, s/weak points, steps a\n"
           "period, tolerance\n  %-22s", "");
    for (int g = 0; g < TARGETS; ++g) printf("  | %-34.0e", targets[g]);
    for (int i = 0; i < COUNT(scenes); ++i) {
        choice b[FAMILIES];
        printf("\n  %s\n", scenes[i].title);
        for (int f = 0; f < FAMILIES; ++f) best_of(scenes + i, f, fine, b[f]);
        time_again(scenes + i, b);
        for (int f = 0; f < FAMILIES; ++f) {
            printf("    %-20s", families[f]);
            for (int g = 0; g < TARGETS; ++g) print_best(scenes + i, b[f][g], b[f < 4 ? 0 : 4][g]);
            printf("\n");
        }
    }
}

int main(int argc, char **argv)
{
    const int quick = argc > 1 && !strcmp(argv[1], "--quick");
    if (argc > 1 && !quick) return fputs("own_quadrature [--quick]\n", stderr), 2;
    set_up();
    for (int i = 0; i < COUNT(scenes); ++i) refer(scenes + i, references[i]);
    beside_gvi();
    prices();
    errors();
    orders();
    symplecticity();
    momentum(quick ? 20000 : 100000);
    marked();
    strong();
    starts();
    if (!quick) work_precision(4);
    printf("\n%d check%s failed\n", failures, failures == 1 ? "" : "s");
    return failures > 0;
}
