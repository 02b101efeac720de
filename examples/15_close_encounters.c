/* 15 - Close encounters: a clock that slows down where it matters

   A comet on an ellipse of eccentricity 0.99 is 200 times faster at the perihelion than
   far out.  With a fixed step the perihelion is stepped over: the comet is thrown out,
   and every single step "converged".  It shows all the same: a fixed point contracts
   slowly, and with desc.resolution the step is refused.  A clock g = |q| makes time run as
   dt = g dtau, h being a step in tau: 80 of them a revolution are enough.  gvi_state_at
   gives the state at a wanted time, here after 100 periods of 2 pi.

   prints

     fixed step, 400 a revolution: thrown out, worst contraction above 1/4: yes
     the same with a limit of 1e-3: refused
     clock, 80 a revolution: energy kept to 1e-13: yes, position after 100 to 1e-10: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

/* Force and potential in one function: with a clock a step wants both         */
GVI_POINTS(attraction, 2, f, value)(const gvi_points *x, void *user)
{
    double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, d = sqrt(d2), w = -1/(d2*d);
    x->value[0] -= 1/d;
    x->f[0] += w*X;
    x->f[1] += w*Y;
    return (void)user, 0;
}

/* g = |q| and its gradient                                                    */
GVI_POINTS(distance, 2, f, value)(const gvi_points *x, void *user)
{
    double d = sqrt(x->q[0]*x->q[0] + x->q[1]*x->q[1]);
    x->value[0] += d;
    x->f[0] += x->q[0]/d;
    x->f[1] += x->q[1]/d;
    return (void)user, 0;
}

int main(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                 { .kind = GVI_CLOCK, .points = distance } };
    const double e = 0.99, turn = 2*acos(-1), start[2] = { 1 + e, 0 }, v[2] = { 0, sqrt((1 - e)/(1 + e)) };
    gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1 };        // without the clock
    gvi_stepper st;
    double e0 = 0, energy = 0, farthest = 0, q[2];
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, start, v);
    for (int k = 0; k < 20*400 && st.status == GVI_OK; ++k) {
        gvi_step(&st, turn/400);
        farthest = fmax(farthest, hypot(st.q[0], st.q[1]));
    }
    printf("fixed step, 400 a revolution: %s, worst contraction above 1/4: %s\n",
           farthest > 10 ? "thrown out" : "bound", st.counters.worst_contraction > 0.25 ? "yes" : "no");

    desc.resolution = 1e-3;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, start, v);
    while (st.t < turn && st.status == GVI_OK) gvi_step(&st, turn/400);
    printf("the same with a limit of 1e-3: %s\n", st.status == GVI_E_RESOLUTION ? "refused" : "not seen");

    desc.resolution = 0;
    desc.effect_count = 2;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, start, v);
    gvi_energy(&st, &e0);
    while (st.t < 100*turn)
        if (gvi_step(&st, turn/80) != GVI_OK) return puts(gvi_status_text(st.status)), 1;
    gvi_energy(&st, &energy);
    gvi_state_at(&st, 100*turn, q, NULL, NULL);
    printf("clock, 80 a revolution: energy kept to 1e-13: %s, position after 100 to 1e-10: %s\n",
           fabs(energy/e0 - 1) < 1e-13 ? "yes" : "no", hypot(q[0] - start[0], q[1]) < 1e-10 ? "yes" : "no");
    return 0;
}
