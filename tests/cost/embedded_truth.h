/* embedded_truth.h - energies and references for embedded.c, in double and with libm's sines, written
   apart from the callbacks: Runge-Kutta of order 4 in many small steps                          */
#ifndef EMBEDDED_TRUTH_H
#define EMBEDDED_TRUTH_H

#include "embedded_scenes.h"
#include <math.h>

enum { SUBSTEPS = 64 };

typedef struct truth { double y[4], torque[2]; } truth;

static double arm_one(double b) { return ARM_NEAR + ARM_FAR + 2*ARM_MID*cos(b); }
static double arm_two(double b) { return ARM_FAR + ARM_MID*cos(b); }

static void arm_accelerate(const truth *x, const double *y, double damping, double *dy)
{
    const double one = arm_one(y[1]), two = arm_two(y[1]), pull = ARM_MID*sin(y[1]);
    const double low = ARM_LOWER*sin(y[0] + y[1]), u = y[2], w = y[3];
    const double f = x->torque[0] - damping*u - ARM_UPPER*sin(y[0]) - low + pull*w*(2*u + w);
    const double g = x->torque[1] - damping*w - low - pull*u*u, det = one*ARM_FAR - two*two;
    dy[2] = (ARM_FAR*f - two*g)/det;
    dy[3] = (one*g - two*f)/det;
}

static void true_rates(int index, const truth *x, const double *y, double *dy)
{
    const int n = scenes[index].n;
    for (int i = 0; i < n; ++i) dy[i] = y[n + i];
    if (index == PENDULUM) dy[1] = -WEIGHT*sin(y[0]);
    if (index == MOTOR) dy[1] = x->torque[0] - DAMPING*y[1] - WEIGHT*sin(y[0]);
    if (index == ORBIT)
        for (int i = 0; i < 2; ++i) dy[2 + i] = -y[i]/pow(y[0]*y[0] + y[1]*y[1], 1.5);
    if (index == ARM || index == DRIVEN_ARM) arm_accelerate(x, y, index == ARM ? 0 : ARM_DAMPING, dy);
}

static void true_substep(int index, truth *x, double h)
{
    const int m = 2*scenes[index].n;
    double k[4][4], z[4];
    static const double at[4] = { 0, 0.5, 0.5, 1 };
    for (int stage = 0; stage < 4; ++stage) {
        for (int i = 0; i < m; ++i) z[i] = x->y[i] + (stage > 0 ? at[stage]*h*k[stage - 1][i] : 0);
        true_rates(index, x, z, k[stage]);
    }
    for (int i = 0; i < m; ++i) x->y[i] += h/6*(k[0][i] + 2*(k[1][i] + k[2][i]) + k[3][i]);
}

static void true_start(int index, truth *x)
{
    const int n = scenes[index].n;
    x->torque[0] = x->torque[1] = 0;
    for (int i = 0; i < n; ++i) {
        x->y[i] = (double)scenes[index].q[i];
        x->y[n + i] = (double)scenes[index].v[i];
    }
}

/* One step of h, the torque being that of the run                                               */
static void true_step(int index, truth *x, double h, int substeps)
{
    for (int i = 0; i < 2; ++i) x->torque[i] = (double)drive.torque[i];
    for (int k = 0; k < substeps; ++k) true_substep(index, x, h/substeps);
}

/* Of configuration and velocity, above the state of least energy; the orbit's is -1/2           */
static double true_energy(int index, const double *y)
{
    if (index == PENDULUM || index == MOTOR) return y[1]*y[1]/2 + WEIGHT*(1 - cos(y[0]));
    if (index == ORBIT) return (y[2]*y[2] + y[3]*y[3])/2 - 1/hypot(y[0], y[1]);
    const double kinetic = (arm_one(y[1])*y[2]*y[2] + ARM_FAR*y[3]*y[3])/2 + arm_two(y[1])*y[2]*y[3];
    return kinetic + ARM_UPPER*(1 - cos(y[0])) + ARM_LOWER*(1 - cos(y[0] + y[1]));
}

/* Momenta become velocities                                                                     */
static void true_velocity(int index, double *y)
{
    if (index != ARM && index != DRIVEN_ARM) return;
    const double one = arm_one(y[1]), two = arm_two(y[1]), det = one*ARM_FAR - two*two, p = y[2], o = y[3];
    y[2] = (ARM_FAR*p - two*o)/det;
    y[3] = (one*o - two*p)/det;
}

#endif
