/* event.h - when does g(t, q, v) pass zero? And the state at given times. For gvi.h

   The steps do not meet the instant that is wanted: an impact, the passage through a plane, a
   switch that closes.  After each step ask for its zeros, in the order of time:

     while ((found = event_next(&e, &st)) > 0)  ... e.t, e.q, e.v, e.p, e.rising ...

   Looked for on the curve, which costs no evaluation of the scene: in four intervals of the step
   (s + 1, if s < 3), then, where the sign of g changes, by the Illinois method. Made exact by the
   secant method on gvi_state_at: the zero has the order of the steps, 2s, not the curve's.
   Nothing is changed: the steps that follow are the same to the bit.

     event_next  1: a zero; 0: no more in this step; a negative gvi_status, or EVENT_PILE_UP
     once        the sign on both sides of a zero is that of states, and the states where two
                 steps meet are the same: none is found twice, or lost between.  Where a run
                 starts anew from a zero (a bounce), or begins at one, this zero does not
                 count again: g is looked at 1/4096 of the step later
     pile up     impacts that lose speed come ever faster, at last within 1/4096 of the step: then
                 g has turned back there already, and the answer is EVENT_PILE_UP.  Let the body
                 rest from there on.  Not in float, whose digits do not show it
     not seen    two zeros within one interval: the sign is the same at its ends.  Take h (with
                 gvi_advance: t_end) so short that g has one extremum in a step at most
     output_at   output_at(&st, h, t, q, v, p): steps of h past t, and the state at t there; q, v,
                 p are [st.n] each, or NULL.  By the dial: gvi_advance until t is passed, then
                 gvi_state_at, with t_end no earlier than the last of the times (02_comet.c)
     ask         after every step; a step not asked about is not searched
     kicks and a clock have no curve over t: states are taken instead, at a partial step each

   A bounce: change e.p and call gvi_start_momentum(&st, e.t, e.q, e.p).  Another run: fill in
   the struct anew.  Sources: Shampine, Thompson: Event location for ordinary differential
   equations, Comput. Math. Appl. 39, 2000; Dowell, Jarratt: A modified regula falsi method
   for computing the root of an equation, BIT 11, 1971.                             */
#ifndef EVENT_H
#define EVENT_H

#include "gvi.h"
typedef gvi_real event_fn(gvi_real t, const gvi_real *q, const gvi_real *v, void *user);

typedef struct event {
    event_fn *g;
    void     *user;                /* handed to g                                   */
    gvi_real *q, *v, *p;           /* [st.n] each, of the caller: the state at the zero */
    gvi_real  t;                   /* its time                                      */
    int       rising;              /* g goes from - to +                            */

    gvi_real from, to, at, before; /* the step asked about; where it has been searched, g there */
    gvi_real sure, g_sure;         /* up to where with states, g there              */
    int      asked, found, next;   /* ever; a zero, ever; interval of this step     */
    unsigned long long step;       /* its number: from a zero at its start it may be made again */
} event;

#define EVENT_PILE_UP (-1000)      /* no gvi_status                                 */

static inline int event_same(gvi_real a, gvi_real b) { return !(a < b) && !(a > b); }
static inline gvi_real event_size(gvi_real a) { return a < 0 ? -a : a; }
static inline gvi_real event_time(const gvi_stepper *st, gvi_real x) { return x < 1 ? st->t0 + x*(st->t - st->t0) : st->t; }

/* g at fraction x of the last step, of the state or of the curve.  The state at the end is there,
   without a partial step for the rounding of t.                                  */
static inline gvi_status event_value(event *e, gvi_stepper *st, gvi_real x, int state, gvi_real *g)
{
    const gvi_real t = event_time(st, x);
    const int end = state && !(x < 1);
    for (int i = 0; end && i < st->n; ++i) e->q[i] = st->q[i], e->p[i] = st->p[i];
    const gvi_status status = end ? gvi_velocity(st, e->v)
        : state ? gvi_state_at(st, t, e->q, e->v, e->p) : gvi_curve(st, x, e->q, e->v);
    if (status) return status;
    *g = e->g(t, e->q, e->v, e->user);
    return *g < 0 || *g >= 0 ? GVI_OK : GVI_E_NON_FINITE;
}

/* Is the curve none, or not one over time? Kicks have no order, and with a clock t - t0 is not h. */
static inline int event_by_states(const gvi_stepper *st)
{
    const gvi_real size = event_size(st->t0) + event_size(st->t), off = ((st->t - st->t0) - st->h)/8;
    return st->order == 0 || !event_same(size + off, size);
}

/* Illinois's method between a and b, to `width` or to what the time can tell apart.  */
static inline gvi_status event_between(event *e, gvi_stepper *st, int state, gvi_real width, gvi_real a, gvi_real b,
                                gvi_real ga, gvi_real gb, gvi_real *x)
{
    gvi_real g;
    *x = a + (b - a)*(ga/(ga - gb));
    for (int k = 0, side = 0; k < 100 && b - a > width; ++k) {
        if (event_same(event_time(st, *x), event_time(st, side < 0 ? a : b)) && side) break;
        const gvi_status status = event_value(e, st, *x, state, &g);
        if (status) return status;
        if ((g < 0) == (gb < 0)) {
            b = *x, gb = g;
            if (side > 0) ga /= 2;
            side = 1;
        } else {
            a = *x, ga = g;
            if (side < 0) gb /= 2;
            side = -1;
        }
        *x = a + (b - a)*(ga/(ga - gb));
    }
    return GVI_OK;
}

/* Secants through states from x, where the curve has its zero, the first with the curve's slope,
   until |g| no longer shrinks.  1: that is a zero between a and b.              */
static inline int event_secant(event *e, gvi_stepper *st, gvi_real a, gvi_real b, gvi_real *x)
{
    const gvi_real enough = sizeof(gvi_real) < 8 ? (gvi_real)1e-5 : (gvi_real)1e-10, aside = (gvi_real)1e-3;
    const gvi_real low = *x > aside ? *x - aside : 0, high = *x < 1 - aside ? *x + aside : 1;
    gvi_real z = *x, g, g_low, g_high, best;
    gvi_status status;
    if ((status = event_value(e, st, low, 0, &g_low)) || (status = event_value(e, st, high, 0, &g_high))
        || (status = event_value(e, st, z, 1, &g))) return status;
    gvi_real slope = (g_high - g_low)/(high - low);
    best = event_size(g);
    for (int k = 0; k < 20 && !event_same(g, 0); ++k) {
        const gvi_real was = z, g_was = g;
        z -= g/slope;
        if (!(z >= a && z <= b) || event_same(event_time(st, z), event_time(st, was))) break;
        if ((status = event_value(e, st, z, 1, &g))) return status;
        if (!(event_size(g) < best)) break;
        best = event_size(g);
        *x = z;
        slope = (g - g_was)/(z - was);
    }
    return *x >= a && *x <= b && best <= enough*event_size(slope);
}

/* The next zero of the last step.                                               */
static inline int event_next(event *e, gvi_stepper *st)
{
    if (!e || !st || !e->g || !e->q || !e->v || !e->p) return GVI_E_ARGUMENT;
    const int intervals = st->s < 3 ? st->s + 1 : 4, states = event_by_states(st);
    gvi_real g, x;
    gvi_status status;
    if (!e->asked || !event_same(e->from, st->t0) || !event_same(e->to, st->t)
        || e->step != st->counters.steps) {                                             // a new step
        e->at = 0;
        if ((status = event_value(e, st, 0, 1, &g))) return status;
        if (e->asked ? e->found && event_same(e->t, st->t0) : event_same(g, 0)) {       // from a zero
            const gvi_real g0 = g;
            gvi_real half;
            e->at = (gvi_real)1/4096;
            if ((status = event_value(e, st, e->at/2, 1, &half)) || (status = event_value(e, st, e->at, 1, &g)))
                return status;
            // of g0 + b x + c x^2 through the three, is c x^2 more than b x?  Then g turned back, to where it went before
            if (sizeof(gvi_real) > sizeof(float) && e->asked && (g < 0) != e->rising
                && event_size(4*half - g - 3*g0) <= event_size(2*g - 4*half + 2*g0)) return EVENT_PILE_UP;
        }
        e->from = st->t0, e->to = st->t, e->step = st->counters.steps;
        e->sure = e->at, e->before = e->g_sure = g;
        e->asked = 1, e->next = 0;
    }
    while (e->next < intervals) {
        const gvi_real a = e->at, before = e->before, sure = e->sure, g_sure = e->g_sure;
        const int last = ++e->next == intervals;
        e->at = last ? 1 : (gvi_real)e->next/(gvi_real)intervals;
        if ((status = event_value(e, st, e->at, last || states, &g))) return status;
        e->before = g;
        if ((before < 0) == (g < 0)) continue;

        // has the state changed its sign as well?
        int found = 0;
        if ((status = event_value(e, st, e->at, 1, &e->g_sure))) return status;
        e->before = e->g_sure;
        e->sure = e->at;
        e->rising = g_sure < 0;
        if ((g_sure < 0) == (e->g_sure < 0)) continue;
        if (!states) {
            if ((status = event_between(e, st, 0, (gvi_real)1e-5, a, e->at, before, g, &x))) return status;
            if ((found = event_secant(e, st, sure, e->at, &x)) < 0) return found;
        }
        if (!found && (status = event_between(e, st, 1, 0, sure, e->at, g_sure, e->g_sure, &x))) return status;
        if ((status = event_value(e, st, x, 1, &g))) return status;             // e->q, v, p there
        e->t = event_time(st, x);
        return e->found = 1;
    }
    return 0;
}

/* Steps of h until the last one reaches over t, then the state at t; q, v, p [n], or NULL.
   For a list of times, in the order of the steps.  GVI_E_ARGUMENT: h is 0 or so short that t is 1e15 steps away. */
static inline gvi_status output_at(gvi_stepper *st, gvi_real h, gvi_real t, gvi_real *q, gvi_real *v, gvi_real *p)
{
    if (!(t - t >= 0)) return gvi_state_at(st, t, q, v, p);          // says that it is not finite
    if (event_same(st->h, 0) && event_same(st->t, t)) {              // at the start
        for (int i = 0; i < st->n; ++i) {
            if (q) q[i] = st->q[i];
            if (p) p[i] = st->p[i];
        }
        return v ? gvi_velocity(st, v) : GVI_OK;
    }
    while (h > 0 ? st->t < t : st->t > t) {
        if (event_size(t - st->t) > event_size(h)*(gvi_real)1e15) return GVI_E_ARGUMENT;
        if (gvi_step(st, h)) return st->status;
    }
    return gvi_state_at(st, t, q, v, p);
}

#endif
