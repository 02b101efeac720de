/* 07 - An oscillator that is driven and damped: forces, and switching them off

   Three rows in effects[]: a spring (a potential), friction, and a drive that
   depends on the time.  The result is compared with the exact solution.  Energy
   is not conserved, but its balance is: the work of the forces in each step,
   integrated along the step's own curve at Gauss points, is the change of the
   energy.  At the end the drive is switched off and is no longer evaluated.

   prints

     t = 100: q = -0.640327124
     against the exact solution, below 1e-12: yes
     energy gained less work done, below 1e-12: yes
     drive evaluated after it was switched off: no
     energy 60 later: 0.000004
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static const double damping = 0.1, strength = 0.5, w = 0.8;

GVI_EACH(spring, 1, f, value)
{
    x->f[0] -= x->q[0];
    x->value[0] += x->q[0]*x->q[0]/2;
}

GVI_EACH(friction, 1, v, f)
{
    x->f[0] -= 2*damping*x->v[0];
}

GVI_EACH(drive, 1, f)
{
    x->f[0] += strength*cos(w*x->t[0]);
}

/* From q = 1 at rest: the transient, and the response to the drive.           */
static double exact(double t)
{
    double k = 1 - w*w, d = 2*damping*w, a = strength/(k*k + d*d), W = sqrt(1 - damping*damping);
    double C = 1 - a*k, S = (damping*C - a*d*w)/W;
    return a*(k*cos(w*t) + d*sin(w*t)) + exp(-damping*t)*(C*cos(W*t) + S*sin(W*t));
}

/* The work of friction and drive in the last step.                            */
static double work(gvi_stepper *st)
{
    double c[8], b[8], sum = 0, q, v;
    gvi_gauss(8, c, b);
    for (int i = 0; i < 8; ++i) {
        double f = 0, t = st->t - (1 - c[i])*st->h;
        gvi_curve(st, c[i], &q, &v);
        const gvi_points x = { .n = 1, .count = 1, .stride = 1, .t = &t, .q = &q, .v = &v, .f = &f };
        friction(&x, NULL);
        drive(&x, NULL);
        sum += b[i]*st->h*f*v;
    }
    return sum;
}

int main(void)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring, .value = spring },
                                 { .kind = GVI_FORCE, .points = friction },
                                 { .kind = GVI_FORCE, .points = drive } };
    const gvi_desc desc = { .n = 1, .degree = 8, .effects = scene, .effect_count = 3 };
    static double memory[GVI_LENGTH(1, 8, 8)];
    double e0 = 0, e = 0, done = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 1 }, (double[]){ 0 });
    gvi_energy(&st, &e0);
    for (int k = 0; k < 200 && gvi_step(&st, 0.5) == GVI_OK; ++k) done += work(&st);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    gvi_energy(&st, &e);
    printf("t = %g: q = %.9f\n", st.t, st.q[0]);
    printf("against the exact solution, below 1e-12: %s\n", fabs(st.q[0] - exact(st.t)) < 1e-12 ? "yes" : "no");
    printf("energy gained less work done, below 1e-12: %s\n", fabs(e - e0 - done) < 1e-12 ? "yes" : "no");

    const unsigned long long before = st.counters.effect[2];
    gvi_switch(&st, 2, 0);
    for (int k = 0; k < 120 && gvi_step(&st, 0.5) == GVI_OK; ++k) {}
    gvi_energy(&st, &e);
    printf("drive evaluated after it was switched off: %s\n", st.counters.effect[2] == before ? "no" : "yes");
    printf("energy 60 later: %.6f\n", e);
    return 0;
}
