/* spectral.h - a Kepler step through the pericentre, whose spectral rate is known  */
#ifndef SPECTRAL_H
#define SPECTRAL_H

#include "bench.h"

/* Kepler, a = 1: t = E - e sin E.  Collision where 1 = e cos E: E = i arcosh(1/e),
   t = i (arcosh(1/e) - sqrt(1 - e^2)) =: i d.  The ellipse around [-h/2, h/2] with
   i d on it: rho = x + sqrt(1 + x^2), x = 2 d/h.                               */

static MAYBE real rho_of(real e, real h)
{
    real d = log((1 + sqrt(1 - e*e))/e) - sqrt(1 - e*e), x = 2*d/h;
    return x + sqrt(1 + x*x);
}

/* q and p at time t after the pericentre */
static MAYBE void kepler_state(real e, real t, real *q, real *p)
{
    real E = t;
    for (int it = 0; it < 60; ++it) E -= (E - e*sin(E) - t)/(1 - e*cos(E));
    q[0] = cos(E) - e;
    q[1] = sqrt(1 - e*e)*sin(E);
    p[0] = -sin(E)/(1 - e*cos(E));
    p[1] = sqrt(1 - e*e)*cos(E)/(1 - e*cos(E));
}

static MAYBE real pericentre_error(real e, real h, int s)
{
    real y[4], end[4];
    method m = { s, { 0 } };
    kepler_state(e, -h/2, y, y + 2);
    kepler_state(e, h/2, end, end + 2);
    gvi_stepper *st = bench(&problems[0], &m, -h/2, y);
    if (st->status != GVI_OK || gvi_step(st, h) != GVI_OK) return (real)NAN;
    return sqrt(square_distance(2, st->q, end) + square_distance(2, st->p, end + 2));
}

#endif
