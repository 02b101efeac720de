/* 30 - A throw that hits: start from two configurations

   A ball leaves (0, 0) and is to be at (30, 10) two seconds later, with drag.
   gvi_start_configurations solves for the start: one curve of degree 6, by
   Newton's method, pinned here, with the effects' Hessians; Lobatto's points.
   A step of that length then ends where the ball was wanted.

   prints

     start with v = 16.400 15.632
     Jacobians made: 3
     after 2 s at 30.000000 10.000000
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static int gravity(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    f[1] -= 9.81;
    return (void)t, (void)q, (void)v, (void)dldv, (void)user, 0;
}

static int gravity_hessian(double t, const double *q, const double *v, double *fq, double *fv, double *pv, void *user)
{
    return (void)t, (void)q, (void)v, (void)fq, (void)fv, (void)pv, (void)user, 0;   // all zero
}

static int drag(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    double speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    for (int i = 0; i < 2; ++i) f[i] -= 0.005*speed*v[i];
    return (void)t, (void)q, (void)dldv, (void)user, 0;
}

static int drag_hessian(double t, const double *q, const double *v, double *fq, double *fv, double *pv, void *user)
{
    double speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) fv[2*i + j] -= 0.005*((i == j ? speed : 0) + v[i]*v[j]/speed);
    return (void)t, (void)q, (void)fq, (void)pv, (void)user, 0;
}

int main(void)
{
    static double memory[GVI_LENGTH(2, 6, 7)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = gravity, .hessian = gravity_hessian },
                                 { .kind = GVI_FORCE, .point = drag, .hessian = drag_hessian } };
    const gvi_desc desc = { .n = 2, .degree = 6, .rule = { .kind = GVI_LOBATTO }, .effects = scene,
                            .effect_count = 2, .formulation = GVI_NEWTON };
    double v[2] = { 0, 0 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start_configurations(&st, 0, 2, (double[]){ 0, 0 }, (double[]){ 30, 10 });
    gvi_velocity(&st, v);
    printf("start with v = %.3f %.3f\n", v[0], v[1]);
    printf("Jacobians made: %d\n", (int)st.counters.factorizations);
    if (gvi_step(&st, 2) != GVI_OK) return puts(gvi_why(&st)), 1;
    printf("after 2 s at %.6f %.6f\n", st.q[0], st.q[1]);
    return 0;
}
