/* friction.h - one contact that slides along a fixed line, with Coulomb's friction: slips, stops, sticks, breaks away.
   For gvi.h

   The scene has three effects for it: the contact itself, a GVI_CONSTRAINT; a GVI_NONHOLONOMIC row T v = 0 along the
   line, for as long as it sticks; a GVI_FORCE -mu f.sign N(t, q, v) T, for as long as it slips, with the pressure N as a
   function of the motion.  So between events the equations are smooth, and a step keeps order 2s.  An event is found by
   the step made again, to end there:

     stops      the speed of slip, T v, is 0: sticks if mu lambda >= |tau|, the multipliers of the two rows; else it
                slips the way that tau did not hold
     breaks     mu lambda = |tau|: slips from here on

     friction f = { .contact = 1, .stick = 2, .slip = 3, .mu = 0.3, .speed = speed };
     friction_init(&f, &desc, memory, size);    friction_size(&desc) bytes
     friction_start(&f, t, q, v);
     friction_step(&f, h);                      to t + h, h > 0.  f.st is a gvi_stepper, to be read

   fails            a gvi_status; the state is that before the step, or of the last event in it
   not seen         a speed or a margin that changes its sign twice in a step; lambda < 0: contact.h             */
#ifndef FRICTION_H
#define FRICTION_H

#include "gvi.h"
#include <float.h>
#include <string.h>

typedef gvi_real friction_fn(gvi_real t, const gvi_real *q, const gvi_real *v, void *user);

typedef struct friction {
    int          contact, stick, slip;     /* effects of the scene; contact and stick have one row each   */
    gvi_real     mu;
    friction_fn *speed;                    /* of slip: T v                                                */
    void        *user;                     /* handed to speed                                             */

    gvi_stepper  st;                       /* from here on to be read                                     */
    gvi_real     sign;                     /* of the slip; 0: sticks                                      */
    unsigned long long stops, breaks;

    gvi_desc     desc;                     /* private                                                     */
    gvi_stepper  saved;                    /* the state before a step, with its memory in copy            */
    gvi_real    *memory, *copy, *q, *v, *lambda, saved_sign;
    int          row[2];                   /* of contact and stick among the multipliers                  */
} friction;

#if GVI__KIND == 1
static const gvi_real friction__eps = FLT_EPSILON;
#elif GVI__KIND == 2
static const gvi_real friction__eps = DBL_EPSILON;
#else
static const gvi_real friction__eps = LDBL_EPSILON;
#endif

static inline gvi_real friction__abs(gvi_real a) { return a < 0 ? -a : a; }
static inline int friction__slips(const friction *f) { return f->sign > 0 || f->sign < 0; }

static inline int friction__rows(const gvi_desc *desc, int effects)
{
    int rows = 0;
    for (int i = 0; i < effects; ++i) rows += desc->effects[i].rows;
    return rows;
}

static inline size_t friction_size(const gvi_desc *desc)
{
    const size_t own = gvi_size(desc), more = 2*(size_t)desc->n + (size_t)friction__rows(desc, desc->effect_count);
    return own ? 2*own + more*sizeof(gvi_real) : 0;
}

static inline gvi_status friction_init(friction *f, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    const size_t own = gvi_size(desc);
    if (!f->speed || !own) return GVI_E_ARGUMENT;
    if (!memory || size < friction_size(desc)) return GVI_E_MEMORY;
    f->desc = *desc;
    f->memory = memory, f->copy = memory + own/sizeof *memory;
    f->q = f->copy + own/sizeof *memory, f->v = f->q + desc->n, f->lambda = f->v + desc->n;
    f->row[0] = friction__rows(desc, f->contact), f->row[1] = friction__rows(desc, f->stick);
    f->sign = 0, f->stops = f->breaks = 0;
    return gvi_init(&f->st, desc, memory, own);
}

/* Slips with the sign, or 0: sticks.  */
static inline gvi_status friction__switch(friction *f, gvi_real sign)
{
    f->sign = sign;
    gvi_status status = gvi_switch(&f->st, friction__slips(f) ? f->stick : f->slip, 0);
    return status ? status : gvi_switch(&f->st, friction__slips(f) ? f->slip : f->stick, 1);
}

/* Slips from here on, the way that tau did not hold.  */
static inline gvi_status friction__break(friction *f)
{
    return friction__switch(f, f->lambda[f->row[1]] > 0 ? -1 : 1);
}

/* Above 0 while it goes on as it does: the speed of slip, or mu lambda - |tau|.  */
static inline gvi_status friction__margin(friction *f, gvi_real *margin)
{
    const gvi_status status = friction__slips(f) ? gvi_velocity(&f->st, f->v) : gvi_multipliers(&f->st, f->lambda);
    if (friction__slips(f)) *margin = f->sign*f->speed(f->st.t, f->st.q, f->v, f->user);
    else *margin = f->mu*f->lambda[f->row[0]] - friction__abs(f->lambda[f->row[1]]);
    return status;
}

/* From f->q and f->v, projected on the scene with the stick's row if it does not slip: does it stick?  */
static inline gvi_status friction__settle(friction *f, gvi_real t, gvi_real t_low, gvi_real sign)
{
    gvi_real margin = 0;
    gvi_status status = gvi_init(&f->st, &f->desc, f->memory, gvi_size(&f->desc));
    if (!status) status = friction__switch(f, sign);
    if (!status && !friction__slips(f)) status = gvi_project(&f->st, t, f->q, f->v, NULL);
    if (!status) status = gvi_start(&f->st, t, f->q, f->v);
    f->st.t_low = t_low;
    if (!status) status = friction__margin(f, &margin);
    return status || margin >= 0 ? status : friction__break(f);
}

static inline gvi_status friction_start(friction *f, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    const gvi_real speed = f->speed(t, q, v, f->user);
    memcpy(f->q, q, (size_t)f->desc.n*sizeof *q);
    memcpy(f->v, v, (size_t)f->desc.n*sizeof *v);
    return friction__settle(f, t, 0, (gvi_real)(speed > 0) - (gvi_real)(speed < 0));
}

/* The step that was saved, made again with length h; its margin.  */
static inline gvi_status friction__again(friction *f, gvi_real h, gvi_real *margin)
{
    gvi_status status = gvi_restore(&f->st, &f->saved, f->copy);
    f->sign = f->saved_sign;
    if (!status && friction__abs(h) > 0) status = gvi_step(&f->st, h);
    return status ? status : friction__margin(f, margin);
}

/* The step of h, with margins fa at its start and fb < 0 at its end, made again to end at 0: Illinois's method.  */
static inline gvi_status friction__event(friction *f, gvi_real h, gvi_real fa, gvi_real fb, gvi_real *part)
{
    gvi_real a = 0, b = 1, m = fb;
    gvi_status status = GVI_OK;
    for (int j = 0, side = 0; j < 60 && b - a > 4*friction__eps*b && (m > 0 || m < 0) && !status; ++j) {
        *part = a + (b - a)*(fa/(fa - fb));
        if (!(*part > a && *part < b)) *part = a + (b - a)/2;
        status = friction__again(f, *part*h, &m);
        if (m > 0) {
            a = *part, fa = m;
            if (side < 0) fb /= 2;
            side = -1;
        } else {
            b = *part, fb = m;
            if (side > 0) fa /= 2;
            side = 1;
        }
    }
    return status;
}

/* A step of h to the first event at most, which is at *part of it.  */
static inline gvi_status friction__once(friction *f, gvi_real h, gvi_real *part)
{
    gvi_real begin = 0, end = 0;
    f->saved = f->st, f->saved_sign = f->sign, *part = 1;
    memcpy(f->copy, f->memory, gvi_size(&f->desc));
    gvi_status status = friction__margin(f, &begin);
    if (!status) status = gvi_step(&f->st, h);
    if (!status) status = friction__margin(f, &end);
    if (status || end >= 0) return status;

    if (!(begin > 0)) begin = -end*friction__eps;                     // it has just begun
    status = friction__event(f, h, begin, end, part);
    if (status) return status;
    if (!friction__slips(f)) return ++f->breaks, friction__break(f);
    ++f->stops;
    memcpy(f->q, f->st.q, (size_t)f->desc.n*sizeof *f->q);            // f->v is of the margin
    return friction__settle(f, f->st.t, f->st.t_low, 0);
}

static inline gvi_status friction_step(friction *f, gvi_real h)
{
    gvi_real left = h, part = 1;
    gvi_status status = GVI_OK;
    for (int i = 0; i < 1000 && !status && friction__abs(left) > 8*friction__eps*friction__abs(h); ++i, left -= part*left)
        status = friction__once(f, left, &part);
    return status;
}

#endif
