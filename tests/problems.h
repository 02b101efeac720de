/* problems.h - the effects and masses that more than one test or study integrates, for all types

   To be included after gvi.h and a typedef of `real`; brings <tgmath.h>.  Tables of kicks: splittings.h; what
   make cost times, written for speed: cost/problems.c; ready effects for scenes: examples/tools/effects.h. */
#ifndef TESTS_PROBLEMS_H
#define TESTS_PROBLEMS_H

#include <tgmath.h>
#undef I                                          // of <complex.h>, which it includes

#define MAYBE __attribute__((unused))             // not every program needs everything
#define HESSIAN(name) static MAYBE int name(real t, const real *q, const real *v, \
                                            real *fq, real *fv, real *pv, void *user)

/* V = -1/|q|, in a plane: Kepler's problem, GM = 1 */
static MAYBE int attraction(const gvi_points *x, void *user)
{
    const real *X = x->q, *Y = X + x->stride;
    real *f = x->f, *value = x->value;
    for (int k = 0; k < x->count && f; ++k) {
        const real d2 = X[k]*X[k] + Y[k]*Y[k], w = -1/(d2*sqrt(d2));
        f[k] += w*X[k];
        f[x->stride + k] += w*Y[k];
    }
    for (int k = 0; k < x->count && value; ++k) value[k] -= 1/sqrt(X[k]*X[k] + Y[k]*Y[k]);
    return 0;
}

HESSIAN(attraction_hessian)
{
    real r2 = q[0]*q[0] + q[1]*q[1], w = -1/(r2*sqrt(r2)), u = -3*w/r2;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) fq[2*i + j] += (i == j ? w : 0) + u*q[i]*q[j];
    return 0;
}

/* Its derivative in the direction d, for tools/tangent.h and tools/adjoint.h */
static MAYBE int attraction_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k], b = x->q[s+k], da = d->q[k], db = d->q[s+k], d2 = a*a + b*b;
        const real w = 1/(d2*sqrt(d2)), along = 3*(a*da + b*db)/d2;
        d->f[k] -= w*(da - along*a);
        d->f[s+k] -= w*(db - along*b);
    }
    return 0;
}

/* M of a double pendulum with relative angles, all lengths and masses 1:
     M = (3 + 2 cos q2, 1 + cos q2; 1 + cos q2, 1) */
static MAYBE int pendulum_mass(const gvi_points *x, void *user)
{
    const int N = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = cos(x->q[N + k]);
        x->mass[k] = 3 + 2*c;
        x->mass[2*N + k] = 1 + c;
        x->mass[3*N + k] = 1;
    }
    return 0;
}

/* v' dM/dq2 v / 2; M does not depend on q1 */
static MAYBE int pendulum_mass_gradient(const gvi_points *x, void *user)
{
    const int N = x->stride;
    for (int k = 0; k < x->count; ++k)
        x->f[N + k] -= sin(x->q[N + k])*x->v[k]*(x->v[k] + x->v[N + k]);
    return 0;
}

#define RELATIVE_ANGLES { .kind = GVI_MASS_POSITION, .points = pendulum_mass, .gradient = pendulum_mass_gradient }

/* V = -g (2 cos q1 + cos(q1 + q2)), the double pendulum's; g = 1, or 1 + sin(2t)/2 with any user */
static MAYBE real gravity_at(real t, const void *user) { return user ? 1 + sin(2*t)/2 : 1; }

static MAYBE int weights(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    real g = gravity_at(t, user), both = g*sin(q[0] + q[1]);
    f[0] -= 2*g*sin(q[0]) + both;
    f[1] -= both;
    return 0;
}

HESSIAN(weights_hessian)
{
    real g = gravity_at(t, user), both = g*cos(q[0] + q[1]);
    fq[0] -= 2*g*cos(q[0]) + both;
    fq[1] -= both;
    fq[2] -= both;
    fq[3] -= both;
    return 0;
}

static MAYBE int weights_value(const gvi_points *x, void *user)
{
    const real *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k)
        x->value[k] -= gravity_at(x->t[k], user)*(2*cos(a[k]) + cos(a[k] + b[k]));
    return x->v != NULL;                                          // a potential has no v
}

/* Two links in angles from the vertical: T = (11/4 v0^2 + 7/8 v1^2)/2 + 9/8 v0 v1 cos(q0 - q1), V = -11/2 cos q0 - 7/4 cos q1;
   the upper triangle of M is not read */
static MAYBE int absolute_mass(const gvi_points *x, void *user)
{
    for (int k = 0, d = x->stride; k < x->count; ++k) {
        x->mass[k] = 11/(gvi_real)4;
        x->mass[d + k] = (gvi_real)NAN;
        x->mass[2*d + k] = 9*cos(x->q[k] - x->q[d + k])/8;
        x->mass[3*d + k] = 7/(gvi_real)8;
    }
    return 0;
}

static MAYBE int absolute_gradient(const gvi_points *x, void *user)
{
    for (int k = 0, d = x->stride; k < x->count; ++k) {
        const gvi_real w = 9*x->v[k]*x->v[d + k]*sin(x->q[k] - x->q[d + k])/8;
        x->f[k] -= w;
        x->f[d + k] += w;
    }
    return 0;
}

static MAYBE int absolute_weight(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *f, gvi_real *dldv, void *user)
{
    f[0] -= 11*sin(q[0])/2;
    f[1] -= 7*sin(q[1])/4;
    return 0;
}

/* L = a(q)'v, a = (-q2 (1 + q1^2), q1)/2 */
static MAYBE int field(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    dldv[0] -= q[1]*(1 + q[0]*q[0])/2;
    dldv[1] += q[0]/2;
    f[0] += v[1]/2 - q[0]*q[1]*v[0];
    f[1] -= v[0]*(1 + q[0]*q[0])/2;
    return 0;
}

HESSIAN(field_hessian)
{
    fq[0] -= q[1]*v[0];
    fq[1] -= q[0]*v[0];
    fq[2] -= q[0]*v[0];
    fv[0] -= q[0]*q[1];
    fv[1] += (real)0.5;
    fv[2] -= (1 + q[0]*q[0])/2;
    return 0;
}

static MAYBE int field_value(const gvi_points *x, void *user)
{
    const real *a = x->q, *b = a + x->stride, *u = x->v, *v = u + x->stride;
    for (int k = 0; k < x->count; ++k) x->value[k] += (a[k]*v[k] - b[k]*(1 + a[k]*a[k])*u[k])/2;
    return 0;
}

/* How far spring i is stretched; coordinates are d apart */
static MAYBE real stretch(int n, int i, int d, const real *q)
{
    return (i + 1 < n ? q[(i + 1)*d] : 0) - q[i*d];
}

static MAYBE void add_tension(int n, int i, int d, real tension, real *f)
{
    f[i*d] += tension;
    if (i + 1 < n) f[(i + 1)*d] -= tension;
}

/* Of spring i to the Hessian, n by n */
static MAYBE void add_stiffness(int n, int i, real k, real *fq)
{
    fq[i*n + i] -= k;
    if (i + 1 == n) return;
    fq[(i + 1)*n + i + 1] -= k;
    fq[i*n + i + 1] += k;
    fq[(i + 1)*n + i] += k;
}

/* The chain of Hairer, Lubich, Wanner, Geometric numerical integration, I.5.1: n/2 stiff springs of frequency
   omega = *user, linked by soft quartic ones; q = their centres and lengths.
   1/4 sum of fourth powers of the soft springs' lengths, and the stiff ones */
static MAYBE int fermi_pasta_ulam_forces(const gvi_points *x, void *user)
{
    const real omega = *(const real *)user;
    const int d = x->stride, M = x->n/2;
    for (int k = 0; k < x->count; ++k)
        for (int j = 0; j <= M; ++j) {
            const real *slow = x->q + k, *fast = slow + M*d;
            real u = 0, w;
            if (j < M) u += slow[j*d] - fast[j*d];
            if (j > 0) u -= slow[(j - 1)*d] + fast[(j - 1)*d];
            w = u*u*u;
            if (j < M) {
                x->f[j*d + k] -= w;
                x->f[(M + j)*d + k] += w - omega*omega*fast[j*d];
            }
            if (j > 0) {
                x->f[(j - 1)*d + k] += w;
                x->f[(M + j - 1)*d + k] += w;
            }
        }
    return 0;
}

/* M_ij = dy_i/dx_j, m by n, of a map x -> y from n numbers to m, by central differences of order 8.  Maps vary over
   lengths of about 1/4; with the distance eps^(1/9)/4, truncation and rounding are both of the size of some
   eps^(8/9). */
enum { MAP_MOST = 5 };
typedef void map_fn(const void *what, const real *x, real *y);

static MAYBE void derivative(map_fn *map, const void *what, int n, int m, const real *start, real eps, real *M)
{
    static const real weight[4] = { (real)4/5, -(real)1/5, (real)4/105, -(real)1/280 };
    const real delta = pow(eps, 1/(real)9)/4;
    for (int i = 0; i < m*n; ++i) M[i] = 0;
    for (int j = 0; j < n; ++j)
        for (int k = 1; k <= 4; ++k) {
            real x[MAP_MOST], up[MAP_MOST], down[MAP_MOST];
            for (int i = 0; i < n; ++i) x[i] = start[i];
            x[j] = start[j] + (real)k*delta;
            map(what, x, up);
            x[j] = start[j] - (real)k*delta;
            map(what, x, down);
            for (int i = 0; i < m; ++i) M[i*n + j] += weight[k - 1]*(up[i] - down[i])/delta;
        }
}

/* max |M'JM - J|, J = (0 1; -1 0) in blocks of 2, of the derivative M of a map x = (q, p) -> y */
static MAYBE real symplectic_defect(map_fn *map, const void *what, const real *start, real eps)
{
    real M[16], worst = 0;
    derivative(map, what, 4, 4, start, eps, M);
    for (int j = 0; j < 4; ++j)
        for (int k = 0; k < 4; ++k) {
            real sum = k == j + 2 ? -1 : j == k + 2 ? 1 : 0;
            for (int i = 0; i < 2; ++i) sum += M[4*i + j]*M[4*i + 8 + k] - M[4*i + 8 + j]*M[4*i + k];
            if (!(fabs(sum) <= worst)) worst = fabs(sum);                  // keeps NaN
        }
    return worst;
}

#endif
