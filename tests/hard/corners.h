/* corners.h - scenes of corners.c and, in float, single.c: attraction in any unit, a top

   Functions of the type of their argument: <tgmath.h>.                                     */
#ifndef HARD_CORNERS_H
#define HARD_CORNERS_H

#include "hard.h"

#include <tgmath.h>
#undef I                                          // of <complex.h>, which it includes

typedef struct units { real length, time; } units;

/* Attraction with GM = length^3/time^2 in these units */
static int attraction_in_units(const gvi_points *x, void *user)
{
    const units *a = user;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k]/a->length, Y = x->q[x->stride + k]/a->length, d2 = X*X + Y*Y;
        const real w = -a->length/(a->time*a->time)/(d2*sqrt(d2));
        x->f[k] += w*X;
        x->f[x->stride + k] += w*Y;
    }
    return 0;
}

/* A heavy symmetric top, I1 = 1, I3 = 1/2, m g l = 1; q = (theta, phi, psi).  M from
     T = (th'^2 + sin^2 th ph'^2)/2 + I3 (ps' + cos th ph')^2/2
   No velocity is given, so M is factored at the points.                                    */
static const real I3 = (real)0.5;

static int top_mass(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = cos(x->q[k]), s = sin(x->q[k]);
        for (int e = 0; e < 9; ++e) x->mass[e*d + k] = 0;
        x->mass[k] = 1;
        x->mass[4*d + k] = s*s + I3*c*c;
        x->mass[7*d + k] = I3*c;
        x->mass[8*d + k] = I3;
    }
    return 0;
}

static int top_gradient(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real c = cos(x->q[k]), s = sin(x->q[k]), ph = x->v[d + k], ps = x->v[2*d + k];
        x->f[k] += s*c*ph*ph - I3*(ps + c*ph)*s*ph;
    }
    return 0;
}

static int top_weight(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        if (x->value) x->value[k] += cos(x->q[k]);
        else x->f[k] += sin(x->q[k]);
    }
    return 0;
}

#endif
