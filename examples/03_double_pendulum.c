/* 03 - The double pendulum: a mass matrix that depends on the position

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

/* Element (i,j) of M at point k is mass[(i*n + j)*stride + k], i >= j.        */
static int mass(const gvi_points *x, void *user)
{
    const double *a = x->q, *b = a + x->stride;
    double *m00 = x->mass, *m10 = m00 + 2*x->stride, *m11 = m00 + 3*x->stride;
    for (int k = 0; k < x->count; ++k) {
        m00[k] = 2;
        m10[k] = cos(a[k] - b[k]);
        m11[k] = 1;
    }
    return (void)user, 0;
}

static int mass_gradient(const gvi_points *x, void *user)
{
    const double *a = x->q, *b = a + x->stride, *va = x->v, *vb = va + x->stride;
    double *fa = x->f, *fb = fa + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double f = sin(a[k] - b[k])*va[k]*vb[k];
        fa[k] -= f;
        fb[k] += f;
    }
    return (void)user, 0;
}

static const double g = 9.81;

static int weight(const gvi_points *x, void *user)
{
    const double *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] -= 2*g*sin(a[k]);
        x->f[x->stride + k] -= g*sin(b[k]);
    }
    return (void)user, 0;
}

static int height(const gvi_points *x, void *user)
{
    const double *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k) x->value[k] -= 2*g*cos(a[k]) + g*cos(b[k]);
    return (void)user, 0;
}

int main(void)
{
    const double a = 0.63125763155384497, b = 0.43653838426081101;  // at t = 100
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = height } };
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
    if (st.status != GVI_OK) return puts(gvi_status_text(st.status)), 1;

    printf("t = %g: a = %.9f, b = %.9f\n", st.t, st.q[0], st.q[1]);
    printf("against 25 digits, below 1e-11: %s\n", fmax(fabs(st.q[0] - a), fabs(st.q[1] - b)) < 1e-11 ? "yes" : "no");
    printf("energy kept to 1e-13: %s\n", worst < 1e-13 ? "yes" : "no");
    return 0;
}
