/* points.h - callbacks written twice: with GVI_POINTS, and as the loop over points that it stands for

   Kepler's problem, a pendulum, an arm of three links in absolute angles, a uniform magnetic field,
   a relativistic particle, and a chain by GVI_ROWS; for test_points.c and cost/points.c, after gvi.h. */
#ifndef TESTS_POINTS_H
#define TESTS_POINTS_H

#include <tgmath.h>
#undef I

GVI_POINTS(kepler, 2, f, value)(const gvi_points *x, void *user)
{
    const gvi_real X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, d = GVI_SQRT(d2), w = -1/(d2*d);
    x->f[0] += w*X;
    x->f[1] += w*Y;
    x->value[0] -= 1/d;
    return (void)user, 0;
}

static int kepler_loop(const gvi_points *x, void *user)
{
    const gvi_real *X = x->q, *Y = X + x->stride;
    gvi_real *fx = x->f, *fy = fx + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real d2 = X[k]*X[k] + Y[k]*Y[k], d = GVI_SQRT(d2), w = -1/(d2*d);
        fx[k] += w*X[k];
        fy[k] += w*Y[k];
    }
    return (void)user, 0;
}

static int kepler_value_loop(const gvi_points *x, void *user)
{
    const gvi_real *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) x->value[k] -= 1/GVI_SQRT(X[k]*X[k] + Y[k]*Y[k]);
    return (void)user, 0;
}

/* Six bodies of masses 1..6, all pairs */
GVI_POINTS(bodies, 18, f)(const gvi_points *x, void *user)
{
    GVI_UNROLL for (int i = 1; i < 6; ++i)
        GVI_UNROLL for (int j = 0; j < i; ++j) {
            const gvi_real *a = x->q + 3*i, *b = x->q + 3*j, X = b[0] - a[0], Y = b[1] - a[1], Z = b[2] - a[2];
            const gvi_real d2 = X*X + Y*Y + Z*Z, w = (gvi_real)((i + 1)*(j + 1))/(d2*GVI_SQRT(d2));
            gvi_real *f = x->f + 3*i, *g = x->f + 3*j;
            f[0] += w*X, f[1] += w*Y, f[2] += w*Z;
            g[0] -= w*X, g[1] -= w*Y, g[2] -= w*Z;
        }
    return (void)user, 0;
}

static int bodies_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int i = 1; i < 6; ++i)
        for (int j = 0; j < i; ++j) {
            const gvi_real *a = x->q + 3*i*s, *b = x->q + 3*j*s;
            gvi_real *f = x->f + 3*i*s, *g = x->f + 3*j*s;
            for (int k = 0; k < x->count; ++k) {
                const gvi_real X = b[k] - a[k], Y = b[s + k] - a[s + k], Z = b[2*s + k] - a[2*s + k];
                const gvi_real d2 = X*X + Y*Y + Z*Z, w = (gvi_real)((i + 1)*(j + 1))/(d2*GVI_SQRT(d2));
                f[k] += w*X, f[s + k] += w*Y, f[2*s + k] += w*Z;
                g[k] -= w*X, g[s + k] -= w*Y, g[2*s + k] -= w*Z;
            }
        }
    return (void)user, 0;
}

GVI_POINTS(pendulum, 1, f)(const gvi_points *x, void *user)
{
    x->f[0] -= sin(x->q[0]);
    return (void)user, 0;
}

static int pendulum_loop(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= sin(x->q[k]);
    return (void)user, 0;
}

/* M_ij = m_ij cos(q_i - q_j), m = (3 2 1; 2 2 1; 1 1 1) */
GVI_POINTS(arm_mass, 3, mass)(const gvi_points *x, void *user)
{
    const gvi_real a = x->q[0], b = x->q[1], c = x->q[2];
    gvi_real *m = x->mass;
    m[0] = 3;
    m[3] = 2*cos(b - a);
    m[4] = 2;
    m[6] = cos(c - a);
    m[7] = cos(c - b);
    m[8] = 1;
    return (void)user, 0;
}

static int arm_mass_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    const gvi_real *a = x->q, *b = a + s, *c = b + s;
    gvi_real *m = x->mass;
    for (int k = 0; k < x->count; ++k) {
        m[k] = 3;
        m[3*s + k] = 2*cos(b[k] - a[k]);
        m[4*s + k] = 2;
        m[6*s + k] = cos(c[k] - a[k]);
        m[7*s + k] = cos(c[k] - b[k]);
        m[8*s + k] = 1;
    }
    return (void)user, 0;
}

GVI_POINTS(arm_gradient, 3, v, f)(const gvi_points *x, void *user)
{
    const gvi_real a = x->q[0], b = x->q[1], c = x->q[2], *v = x->v;
    const gvi_real ab = 2*sin(b - a)*v[0]*v[1], ac = sin(c - a)*v[0]*v[2], bc = sin(c - b)*v[1]*v[2];
    x->f[0] += ab + ac;
    x->f[1] += bc - ab;
    x->f[2] -= ac + bc;
    return (void)user, 0;
}

static int arm_gradient_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    const gvi_real *a = x->q, *b = a + s, *c = b + s, *va = x->v, *vb = va + s, *vc = vb + s;
    gvi_real *fa = x->f, *fb = fa + s, *fc = fb + s;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real ab = 2*sin(b[k] - a[k])*va[k]*vb[k], ac = sin(c[k] - a[k])*va[k]*vc[k],
                       bc = sin(c[k] - b[k])*vb[k]*vc[k];
        fa[k] += ab + ac;
        fb[k] += bc - ab;
        fc[k] -= ac + bc;
    }
    return (void)user, 0;
}

/* L = B (x y' - y x')/2 */
GVI_POINTS(magnetic, 2, v, f, dldv, value)(const gvi_points *x, void *user)
{
    const gvi_real b = *(const gvi_real *)user/2, *q = x->q, *v = x->v;
    x->f[0] += b*v[1];
    x->f[1] -= b*v[0];
    x->dldv[0] -= b*q[1];
    x->dldv[1] += b*q[0];
    x->value[0] += b*(q[0]*v[1] - q[1]*v[0]);
    return 0;
}

static int magnetic_loop(const gvi_points *x, void *user)
{
    const gvi_real b = *(const gvi_real *)user/2;
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] += b*x->v[s + k];
        x->f[s + k] -= b*x->v[k];
        x->dldv[k] -= b*x->q[s + k];
        x->dldv[s + k] += b*x->q[k];
    }
    return 0;
}

static int magnetic_value_loop(const gvi_points *x, void *user)
{
    const gvi_real b = *(const gvi_real *)user/2;
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) x->value[k] += b*(x->q[k]*x->v[s + k] - x->q[s + k]*x->v[k]);
    return 0;
}

/* v = p/GVI_SQRT(1 + p^2); refuses p_1 < -1, for the test */
GVI_POINTS(relativistic, 2, p, velocity)(const gvi_points *x, void *user)
{
    const gvi_real w = 1/GVI_SQRT(1 + x->p[0]*x->p[0] + x->p[1]*x->p[1]);
    x->velocity[0] = x->p[0]*w;
    x->velocity[1] = x->p[1]*w;
    return (void)user, x->p[0] < -1;
}

static int relativistic_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    int failed = 0;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real w = 1/GVI_SQRT(1 + x->p[k]*x->p[k] + x->p[s + k]*x->p[s + k]);
        x->velocity[k] = x->p[k]*w;
        x->velocity[s + k] = x->p[s + k]*w;
        failed |= x->p[k] < -1;
    }
    return (void)user, failed;
}

/* Two rods, the lower one's length 1 + t */
GVI_POINTS(rods, 4, rows(2))(const gvi_points *x, void *user)
{
    const gvi_real *q = x->q, a = q[2] - q[0], b = q[3] - q[1], length = 1 + x->t[0];
    gvi_real *G = x->jacobian;
    x->g[0] = (q[0]*q[0] + q[1]*q[1] - 1)/2;
    x->g[1] = (a*a + b*b - length*length)/2;
    G[0] = q[0], G[1] = q[1];
    G[4] = -a, G[5] = -b, G[6] = a, G[7] = b;
    x->rate[1] = -length;
    return (void)user, 0;
}

static int rods_loop(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real *q = x->q + k, a = q[2*s] - q[0], b = q[3*s] - q[s], length = 1 + x->t[k];
        gvi_real *G = x->jacobian + k;
        x->g[k] = (q[0]*q[0] + q[s]*q[s] - 1)/2;
        x->g[s + k] = (a*a + b*b - length*length)/2;
        G[0] = q[0], G[s] = q[s];
        G[4*s] = -a, G[5*s] = -b, G[6*s] = a, G[7*s] = b;
        x->rate[s + k] = -length;
    }
    return (void)user, 0;
}

/* A chain of n springs d + d^3 between walls */
static inline gvi_real spring(gvi_real d) { return d + d*d*d; }

static int chain(const gvi_points *x, void *user)
{
    const gvi_real *q = x->q;
    gvi_real *f = x->f;
    const int n = x->n, d = x->stride;
    GVI_ROWS(x, 0, 1, j, f[j] += spring(q[j + d] - q[j]) - spring(q[j]);)
    GVI_ROWS(x, 1, n - 1, j, f[j] += spring(q[j + d] - q[j]) - spring(q[j] - q[j - d]);)
    GVI_ROWS(x, n - 1, n, j, f[j] += spring(-q[j]) - spring(q[j] - q[j - d]);)
    return (void)user, 0;
}

static int chain_loop(const gvi_points *x, void *user)
{
    const int n = x->n, s = x->stride;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const gvi_real at = x->q[i*s + k], left = i > 0 ? at - x->q[(i - 1)*s + k] : at,
                           right = i < n - 1 ? x->q[(i + 1)*s + k] - at : -at;
            x->f[i*s + k] += spring(right) - spring(left);
        }
    return (void)user, 0;
}

#endif
