/* pendulum.h - the double pendulum of long.c, stiff.c and brouwer.c: relative angles,
   m = l = 1, g = 9.8, a spring of the given stiffness in the joint; M(q), and the velocity in
   closed form.  Functions of the type of their argument: <tgmath.h>.                       */
#ifndef HARD_PENDULUM_H
#define HARD_PENDULUM_H

#include "hard.h"
#include "problems.h"

static real stiffness;
static const real pendulum_g = (real)9.8;

static int pendulum_forces(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k], b = x->q[x->stride + k], both = pendulum_g*sin(a + b);
        x->f[k] -= 2*pendulum_g*sin(a) + both;
        x->f[x->stride + k] -= both + stiffness*b;
    }
    return 0;
}

static int pendulum_velocity(const gvi_points *x, void *user)
{
    const real *q2 = x->q + x->stride, *p1 = x->p, *p2 = p1 + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = cos(q2[k]), s = sin(q2[k]), p = p1[k] - p2[k];
        x->velocity[k] = (p - c*p2[k])/(1 + s*s);
        x->velocity[x->stride + k] = ((2 + c)*p2[k] - (1 + c)*p)/(1 + s*s);
    }
    return 0;
}

static const gvi_mass pendulum_inertia = { .kind = GVI_MASS_POSITION, .points = pendulum_mass,
                                           .gradient = pendulum_mass_gradient, .velocity = pendulum_velocity };

/* At angles a, b with momenta u, v */
static long double pendulum_energy_at(long double a, long double b, long double u, long double v)
{
    const long double c = cosl(b), g = pendulum_g;
    return (u*u - 2*(1 + c)*u*v + (3 + 2*c)*v*v)/(2 - c*c)/2 - 2*g*cosl(a) - g*cosl(a + b) + stiffness*b*b/2;
}

HARD_MAYBE long double pendulum_energy(const real *q, const real *p)
{
    return pendulum_energy_at(q[0], q[1], p[0], p[1]);
}

#endif
