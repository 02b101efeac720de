/* 09 - The double pendulum: a mass matrix that depends on the position

   Two rods of length 1 with a point mass 1 at each end, a and b their angles
   from the vertical.  The kinetic energy is v'M(a,b)v/2 with

         M = ( 2            cos(a - b) )
             ( cos(a - b)   1          )

   so the momenta are p = M v: not a multiple of the velocities.  Two callbacks
   say all of it: M at the points of a step, and v'(dM/dq)v/2 added to the
   force.  No derivative beyond that, no equation of motion.

   prints

     t = 100: a = 0.631257632, b = 0.436538384
     against 25 digits, below 1e-11: yes
     energy kept to 1e-13: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

/* Element (i,j) of M is mass[i*n + j], i >= j.                                */
GVI_EACH(mass, 2, mass)
{
    x->mass[0] = 2;
    x->mass[2] = cos(x->q[0] - x->q[1]);
    x->mass[3] = 1;
}

GVI_EACH(mass_gradient, 2, v, f)
{
    double f = sin(x->q[0] - x->q[1])*x->v[0]*x->v[1];
    x->f[0] -= f;
    x->f[1] += f;
}

static const double g = 9.81;

/* Force and potential: what is not wanted is not computed.                    */
GVI_EACH(weight, 2, f, value)
{
    x->f[0] -= 2*g*sin(x->q[0]);
    x->f[1] -= g*sin(x->q[1]);
    x->value[0] -= 2*g*cos(x->q[0]) + g*cos(x->q[1]);
}

int main(void)
{
    const double a = 0.63125763155384497, b = 0.43653838426081101;  // at t = 100
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight } };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient } };
    static double memory[GVI_LENGTH(2, 8, 8)];
    double e0 = 0, e = 0, worst = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0.8, 0.5 }, (double[]){ 0, 0 });
    gvi_energy(&st, &e0);
    for (int k = 0; k < 1600 && st.status == GVI_OK; ++k) {
        gvi_step(&st, 1.0/16);
        if (st.status == GVI_OK && gvi_energy(&st, &e) == GVI_OK) worst = fmax(worst, fabs((e - e0)/e0));
    }
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;

    printf("t = %g: a = %.9f, b = %.9f\n", st.t, st.q[0], st.q[1]);
    printf("against 25 digits, below 1e-11: %s\n", fmax(fabs(st.q[0] - a), fabs(st.q[1] - b)) < 1e-11 ? "yes" : "no");
    printf("energy kept to 1e-13: %s\n", worst < 1e-13 ? "yes" : "no");
    return 0;
}
