/* damped.h - friction in an explicit loop, for gvi.h

   A force that reads velocities makes a step implicit. Friction alone, though, is often solved
   exactly: linear drag takes p to p exp(-c h/m), air drag v' = -(c/m)|v|v takes v to
   v/(1 + c |v| h/m). So split: half of the friction, a step of all else, half of the friction,

     D(h/2) . step(h) . D(h/2)

   of order 2, symmetric; between the steps of a run two halves are one whole. The step may be any; an
   explicit one should begin and end with a drift, for then a start costs no evaluation:

     rule = { .kind = GVI_KICKS, .points = 1, .nodes = (double[]){ 0.5 }, .weights = (double[]){ 1 } }

   is drift, kick, drift: one evaluation of the potentials a step.

     keeps     with drag in proportion to the mass, exactly, at any h: momentum and angular
               momentum decay by exp(-c t) where a symmetry keeps them without friction, and
               areas in phase space by exp(-c h) (conformally symplectic). Friction never adds energy
     order 4   three runs of damped_steps, g h, (1 - 2g) h, g h with g = 1/(2 - 2^(1/3)); in the
               middle one friction amplifies, so only where it is light, c h below 1, and smooth
               (air drag is not, where v passes 0)
     loses     the compensation of q, p and t: rounding grows like the number of steps at worst
     fails     with the status of the step; the state is that after the steps that succeeded

   friction: replaces p, [n], by what friction alone makes of it in the time h, which may be
   negative. M is constant, and v = p/m.
   Source: McLachlan, Quispel: Splitting methods, Acta Numerica 11, 2002.                */
#ifndef DAMPED_H
#define DAMPED_H

#include "gvi.h"
typedef void damped_fn(gvi_real h, const gvi_real *q, gvi_real *p, void *user);

/* Friction for the time h, from p of length n, which is left as it is, through `work`. */
static inline gvi_status damped_start(gvi_stepper *st, gvi_real t, gvi_real h, damped_fn *friction, void *user, gvi_real *work)
{
    for (int i = 0; i < st->n; ++i) work[i] = st->p[i];
    friction(h, st->q, work, user);
    return gvi_start_momentum(st, t, st->q, work);
}

/* `count` steps of h; work: [2n].                                              */
static inline gvi_status damped_steps(gvi_stepper *st, gvi_real h, int count, damped_fn *friction, void *user, gvi_real *work)
{
    const gvi_real start = st->t;
    gvi_real *before = work + st->n;
    for (int k = 0; k < count; ++k) {
        const gvi_real t = start + (gvi_real)k*h;
        for (int i = 0; i < st->n; ++i) before[i] = st->p[i];
        gvi_status status = damped_start(st, t, k ? h : h/2, friction, user, work);
        if (status == GVI_OK) status = gvi_step(st, h);
        if (status == GVI_OK) continue;
        if (k) friction(h/2, st->q, before, user);
        gvi_start_momentum(st, t, st->q, before);
        return st->status = status;
    }
    return count > 0 ? damped_start(st, start + (gvi_real)count*h, h/2, friction, user, work) : GVI_OK;
}

#endif
