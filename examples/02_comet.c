/* 02 - A comet: ask for an accuracy, and the steps follow

   Halley's comet passes the sun sixty times as fast as it moves far out, so no one step suits
   its whole way. desc.resolution, the dial, says how accurate a step has to be; gvi_advance takes
   one step, as long as the dial allows, and a step that would be worse is refused and taken again,
   shorter. Nothing else has to be chosen, and no step passes the time given.

   Output does not bind the steps: gvi_state_at has the state at any time in the last one. Nor does
   the event: tools/event.h finds the perihelion, where q.v passes zero from below (lesson 19).

   Units: astronomical unit, year. The comet starts at its aphelion.

   prints

     year 10:  -33.4535  -1.8935
     year 20:  -28.2370  -3.5726
     year 30:  -17.8629  -4.5335
     year 38:   -1.1463   1.9505
     year 60:  -31.1819   2.8311
     against Kepler's equation, below 1e-11: yes
     perihelion after 37.66 years, at 0.5866 from the sun: to 1e-11, yes
     longest step over shortest: more than 100
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/event.h"
#include <math.h>
#include <stdio.h>

#define GM 39.47841760435743                                   /* 4 pi^2            */
static const double axis = 17.834, eccentricity = 0.96711;

GVI_POINTS(sun, 2, f)(const gvi_points *x, void *user)
{
    const double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -GM/(d2*sqrt(d2));
    x->f[0] += w*X;
    x->f[1] += w*Y;
    return (void)user, 0;
}

static double outward(double t, const double *q, const double *v, void *user)
{
    return (void)t, (void)user, q[0]*v[0] + q[1]*v[1];
}

/* The exact place: E - e sin E = pi + 2 pi t/T                                   */
static void kepler(double t, double *q)
{
    const double pi = acos(-1), M = pi + sqrt(GM/axis)/axis*t;
    double E = M;
    for (int k = 0; k < 60; ++k) E -= (E - eccentricity*sin(E) - M)/(1 - eccentricity*cos(E));
    q[0] = axis*(cos(E) - eccentricity);
    q[1] = axis*sqrt(1 - eccentricity*eccentricity)*sin(E);
}

int main(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    static const double times[5] = { 10, 20, 30, 38, 60 };
    const double far = axis*(1 + eccentricity), near = axis*(1 - eccentricity), half = acos(-1)*axis*sqrt(axis/GM);
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = sun } };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1, .resolution = 1e-12 };
    double q[2], v[2], p[2], at[2], exact[2], off = 0, when = 0, distance = 0, shortest = 1e9, longest = 0;
    event perihelion = { .g = outward, .q = q, .v = v, .p = p };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ -far, 0 }, (double[]){ 0, -sqrt(GM/axis*near/far) });
    int out = 0, found = 0;
    while (st.t < 60 && gvi_advance(&st, 60) == GVI_OK) {
        for (; out < 5 && times[out] <= st.t; ++out) {
            gvi_state_at(&st, times[out], at, NULL, NULL);
            kepler(times[out], exact);
            off = fmax(off, hypot(at[0] - exact[0], at[1] - exact[1]));
            printf("year %.0f: %9.4f %8.4f\n", times[out], at[0], at[1]);
        }
        while ((found = event_next(&perihelion, &st)) > 0)
            if (perihelion.rising) {
                when = perihelion.t;
                distance = hypot(q[0], q[1]);
            }
        shortest = fmin(shortest, st.h);
        longest = fmax(longest, st.h);
    }
    if (st.status != GVI_OK || found < 0) return puts(gvi_status_text(st.status)), 1;
    printf("against Kepler's equation, below 1e-11: %s\n", off < 1e-11 ? "yes" : "no");
    printf("perihelion after %.2f years, at %.4f from the sun: to 1e-11, %s\n", when, distance,
           fabs(when - half) < 1e-11 && fabs(distance - near) < 1e-11 ? "yes" : "no");
    printf("longest step over shortest: %s\n", longest > 100*shortest ? "more than 100" : "100 or less");
    return 0;
}
