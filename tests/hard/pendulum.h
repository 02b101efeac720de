/* pendulum.h - the double pendulum of long.c and stiff.c: relative angles, m = l = 1, g = 9.8,
   a spring of the given stiffness in the joint; M(q), and the velocity in closed form */
#ifndef HARD_PENDULUM_H
#define HARD_PENDULUM_H

#include "hard.h"

static double stiffness;

static int pendulum_forces(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const double a = x->q[k], b = x->q[x->stride + k], both = 9.8*sin(a + b);
        x->f[k] -= 19.6*sin(a) + both;
        x->f[x->stride + k] -= both + stiffness*b;
    }
    return 0;
}

static int pendulum_mass(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const double c = cos(x->q[x->stride + k]);
        x->mass[k] = 3 + 2*c;
        x->mass[2*x->stride + k] = 1 + c;
        x->mass[3*x->stride + k] = 1;
    }
    return 0;
}

static int pendulum_velocity(const gvi_points *x, void *user)
{
    const double *q2 = x->q + x->stride, *p1 = x->p, *p2 = p1 + x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const double c = cos(q2[k]), s = sin(q2[k]), p = p1[k] - p2[k];
        x->velocity[k] = (p - c*p2[k])/(1 + s*s);
        x->velocity[x->stride + k] = ((2 + c)*p2[k] - (1 + c)*p)/(1 + s*s);
    }
    return 0;
}

static int pendulum_gradient(const gvi_points *x, void *user)
{
    const double *q2 = x->q + x->stride, *v1 = x->v, *v2 = v1 + x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) x->f[x->stride + k] -= sin(q2[k])*v1[k]*(v1[k] + v2[k]);
    return 0;
}

static long double pendulum_energy(const double *q, const double *p)
{
    const long double a = q[0], b = q[1], u = p[0], v = p[1], c = cosl(b), g = 9.8;
    return (u*u - 2*(1 + c)*u*v + (3 + 2*c)*v*v)/(2 - c*c)/2 - 2*g*cosl(a) - g*cosl(a + b) + stiffness*b*b/2;
}

#endif
