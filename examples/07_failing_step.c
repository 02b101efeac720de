/* 07 - A step that fails, and how to go on

   A particle flies at a wall that repels it with the potential 1/x.  Behind the
   wall there is no potential, and the callback says so by returning non-zero:
   a step that looks there ends with GVI_E_CALLBACK.  Nothing has been lost by
   that: t, q and p are bit for bit what they were.  So halve h and try again,
   and double it when steps succeed.  h stays a power of two, so the end is met
   exactly.

   prints

     t =  2.000  h = 1       a callback refused: effect 0, state unchanged: yes
     t = 16.000: on the way back, energy kept to 1e-6: yes
     and without a loss of time: x(16) = x(0) after 16 h, mirrored
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static int wall(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        if (!(x->q[k] > 0)) return 1;  // nothing to evaluate here
        if (x->value) x->value[k] += 1/x->q[k];
        else x->f[k] += 1/(x->q[k]*x->q[k]);
    }
    return (void)user, 0;
}

int main(void)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = wall, .value = wall } };
    const gvi_desc desc = { .n = 1, .degree = 6, .effects = scene, .effect_count = 1 };
    static double memory[GVI_LENGTH(1, 6, 6)];
    double h = 1, e0 = 0, e = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 8 }, (double[]){ -1 });
    gvi_energy(&st, &e0);
    while (st.t < 16) {
        double t = st.t, q = st.q[0], p = st.p[0];
        if (gvi_step(&st, h) == GVI_OK) {
            if (h < 1 && fmod(st.t, 2*h) <= 0) h *= 2;
            continue;
        }
        int same = !memcmp(&t, &st.t, sizeof t) && !memcmp(&q, st.q, sizeof q) && !memcmp(&p, st.p, sizeof p);
        printf("t = %6.3f  h = %-6g  %s: effect %d, state unchanged: %s\n", st.t, h,
               gvi_status_text(st.status), st.fault.effect, same ? "yes" : "no");
        h /= 2;
        if (h < 1e-6) return puts("given up"), 1;
    }
    gvi_energy(&st, &e);
    printf("t = %6.3f: v = %.6f, energy kept to 1e-6: %s\n", st.t, st.p[0], fabs(e/e0 - 1) < 1e-6 ? "yes" : "no");
    return 0;
}
