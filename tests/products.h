/* products.h - effects with their derivatives times a direction, for the tests of tangent.h and adjoint.h;
   to be included after a typedef of `real` */
#ifndef TESTS_PRODUCTS_H
#define TESTS_PRODUCTS_H

#include "problems.h"

/* A magnetic field: L = b |q|^2 (x y' - y x')/2, b = 1; b is parameter 1 */
static MAYBE int magnetic(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k], b = x->q[s+k], u = x->v[k], v = x->v[s+k], z = (a*a + b*b)/2, l = a*v - b*u;
        if (x->f) x->f[k] += a*l + z*v, x->f[s+k] += b*l - z*u;
        if (x->dldv) x->dldv[k] -= z*b, x->dldv[s+k] += z*a;
    }
    return 0;
}

static MAYBE int magnetic_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    if (parameter == 1) {
        gvi_points y = *x;
        y.f = d->f, y.dldv = d->dldv;                        /* linear in b */
        magnetic(&y, NULL);
    }
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k], b = x->q[s+k], z = (a*a + b*b)/2;
        const real da = d->q[k], db = d->q[s+k], dz = a*da + b*db;
        if (d->f) {
            const real u = x->v[k], v = x->v[s+k], du = d->v[k], dv = d->v[s+k];
            const real l = a*v - b*u, dl = da*v + a*dv - db*u - b*du;
            d->f[k] += da*l + a*dl + dz*v + z*dv;
            d->f[s+k] += db*l + b*dl - dz*u - z*du;
        }
        if (d->dldv) d->dldv[k] -= dz*b + z*db, d->dldv[s+k] += dz*a + z*da;
    }
    return 0;
}

/* The double pendulum, M = [2, c; c, 1], c = e cos(a - b); e is parameter 1. */
static MAYBE real coupling = 1;

static MAYBE int weight(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] -= 20*sin(x->q[k]);
        x->f[s+k] -= 10*sin(x->q[s+k]);
    }
    return 0;
}

static MAYBE int weight_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        d->f[k] -= 20*cos(x->q[k])*d->q[k];
        d->f[s+k] -= 10*cos(x->q[s+k])*d->q[s+k];
    }
    return 0;
}

static MAYBE int pendulum_matrix(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        x->mass[k] = 2;
        x->mass[2*s+k] = coupling*cos(x->q[k] - x->q[s+k]);
        x->mass[3*s+k] = 1;
    }
    return 0;
}

static MAYBE int pendulum_gradient(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real w = coupling*sin(x->q[k] - x->q[s+k])*x->v[k]*x->v[s+k];
        x->f[k] -= w;
        x->f[s+k] += w;
    }
    return 0;
}

static MAYBE int pendulum_gradient_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k] - x->q[s+k], da = d->q[k] - d->q[s+k], u = x->v[k], v = x->v[s+k];
        real w = coupling*(cos(a)*da*u*v + sin(a)*(d->v[k]*v + u*d->v[s+k]));
        if (parameter == 1) w += sin(a)*u*v;
        d->f[k] -= w;
        d->f[s+k] += w;
    }
    return 0;
}

static MAYBE int pendulum_velocity(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = coupling*cos(x->q[k] - x->q[s+k]), D = 1/(2 - c*c);
        x->velocity[k] = (x->p[k] - c*x->p[s+k])*D;
        x->velocity[s+k] = (2*x->p[s+k] - c*x->p[k])*D;
    }
    return 0;
}

static MAYBE int pendulum_velocity_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k] - x->q[s+k], da = d->q[k] - d->q[s+k], c = coupling*cos(a), D = 1/(2 - c*c);
        const real dc = -coupling*sin(a)*da + (parameter == 1 ? cos(a) : 0);
        const real pa = d->p[k] - dc*x->v[s+k], pb = d->p[s+k] - dc*x->v[k];
        d->velocity[k] = (pa - c*pb)*D;
        d->velocity[s+k] = (2*pb - c*pa)*D;
    }
    return 0;
}

/* The same kinetic energy as a Lagrangian term, for GVI_MASS_NONE. */
static MAYBE int pendulum_term(const gvi_points *x, void *user)
{
    const int s = x->stride;
    if (x->f) pendulum_gradient(x, NULL);
    for (int k = 0; k < x->count && x->dldv; ++k) {
        const real c = coupling*cos(x->q[k] - x->q[s+k]);
        x->dldv[k] += 2*x->v[k] + c*x->v[s+k];
        x->dldv[s+k] += c*x->v[k] + x->v[s+k];
    }
    return 0;
}

static MAYBE int pendulum_term_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    if (d->f) pendulum_gradient_product(x, d, parameter, NULL);
    for (int k = 0; k < x->count && d->dldv; ++k) {
        const real a = x->q[k] - x->q[s+k], da = d->q[k] - d->q[s+k], c = coupling*cos(a);
        const real dc = -coupling*sin(a)*da + (parameter == 1 ? cos(a) : 0);
        d->dldv[k] += 2*d->v[k] + c*d->v[s+k] + dc*x->v[s+k];
        d->dldv[s+k] += c*d->v[k] + d->v[s+k] + dc*x->v[k];
    }
    return 0;
}

static MAYBE const real diagonal[] = { R(1.25), R(0.75) }, dense[] = { R(1.25), 0, R(0.5), R(0.75) };

/* Forest and Ruth's splitting: drifts of g/2, (1-g)/2, ... between kicks of g, 1-2g, g. */
#define G R(1.35120719195965763404768780897)
static MAYBE const real ruth_at[] = { 0, G, 1 - G, 1 }, ruth[] = { G/2, (1 - G)/2, (1 - G)/2, G/2 };

#define PENDULUM { .kind = GVI_MASS_POSITION, .points = pendulum_matrix, .gradient = pendulum_gradient, \
                   .velocity = pendulum_velocity }
#endif
