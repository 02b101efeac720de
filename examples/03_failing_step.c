/* 03 - A step that fails, and how to go on

   A particle flies at a wall that repels it with the potential 1/x.  The
   callback refuses, by returning non-zero, points where the step cannot be
   right: behind the wall there is nothing to evaluate, and close to it h is too
   long for so steep a force.  Such a step ends with GVI_E_CALLBACK, and
   nothing is lost: t, q and p are bit for bit what they were.  So halve h and
   try again; double it when steps succeed.  h is a power of two throughout, so
   that the end is met exactly.

   prints

     t = 1, h = 1: an effect (fault.effect) did not return 0: halve h: effect 0, state unchanged
     turned back, shortest step 1/64
     t = 16: v = 4.026682, energy kept to 1e-12: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* user: the step h.  It resolves the wall where h^2 |f'(x)| < 1.              */
GVI_POINTS(wall, 1, f, value)(const gvi_points *x, void *user)
{
    const double *h = user, q = x->q[0];
    if (!(q > 0) || *h * *h*2 > q*q*q) return 1;
    x->value[0] += 1/q;
    x->f[0] += 1/(q*q);
    return 0;
}

int main(void)
{
    double h = 1, shortest = 1, e0 = 0, e = 0;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = wall, .value = wall, .user = &h } };
    const gvi_desc desc = { .n = 1, .degree = 8, .effects = scene, .effect_count = 1 };
    static double memory[GVI_LENGTH(1, 8, 8)];
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 8 }, (double[]){ -4 });
    gvi_energy(&st, &e0);
    while (st.t < 16) {
        const double t = st.t, q = st.q[0], p = st.p[0];
        if (gvi_step(&st, h) == GVI_OK) {
            if (h < shortest) shortest = h;
            if (h < 1 && fmod(st.t, 2*h) <= 0) h *= 2;
            continue;
        }
        int same = !memcmp(&t, &st.t, sizeof t) && !memcmp(&q, st.q, sizeof q) && !memcmp(&p, st.p, sizeof p);
        if (st.counters.failures == 1)
            printf("t = %g, h = %g: %s: effect %d, state %s\n", st.t, h, gvi_why(&st),
                   st.fault.effect, same ? "unchanged" : "changed");
        h /= 2;
        if (h < 1e-6) return puts("given up"), 1;
    }
    gvi_energy(&st, &e);
    printf("turned back, shortest step 1/%g\n", 1/shortest);
    printf("t = %g: v = %.6f, energy kept to 1e-12: %s\n", st.t, st.p[0], fabs(e/e0 - 1) < 1e-12 ? "yes" : "no");
    return 0;
}
