/* mechanics.h - the effects and masses that more than one test or study integrates, for all types

   To be included after gvi.h and a typedef of `real`; brings <tgmath.h>.  Other problems: springs.h,
   fermi_pasta_ulam.h, splittings.h; those that are timed, written for speed: cost/problems.c.        */
#ifndef TESTS_MECHANICS_H
#define TESTS_MECHANICS_H

#include <tgmath.h>
#undef I                                          // of <complex.h>, which it includes

/* V = -1/|q|, in a plane: Kepler's problem, GM = 1 */
static __attribute__((unused)) int attraction(const gvi_points *x, void *user)
{
    const real *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real d2 = X[k]*X[k] + Y[k]*Y[k], d = sqrt(d2), w = 1/(d2*d);
        if (x->value) x->value[k] -= 1/d;
        if (!x->f) continue;
        x->f[k] -= w*X[k];
        x->f[x->stride + k] -= w*Y[k];
    }
    return 0;
}

/* Its derivative in the direction d, for tools/tangent.h and tools/adjoint.h */
static __attribute__((unused)) int attraction_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
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
static __attribute__((unused)) int pendulum_mass(const gvi_points *x, void *user)
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
static __attribute__((unused)) int pendulum_mass_gradient(const gvi_points *x, void *user)
{
    const int N = x->stride;
    for (int k = 0; k < x->count; ++k)
        x->f[N + k] -= sin(x->q[N + k])*x->v[k]*(x->v[k] + x->v[N + k]);
    return 0;
}

#endif
