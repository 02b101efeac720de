/* 10 - How do I write a robot arm as it stands on paper?

   Three rods, hinge after hinge, in the plane; q_i is the angle of rod i to the vertical. On paper:

     M_ij = B_ij cos(q_i - q_j)       dT/dq_i = -v_i sum_j B_ij sin(q_i - q_j) v_j       V = -sum_i G_i cos q_i

   with numbers B, G of lengths and masses. GVI_EACH takes a function for one point, for the mass as for
   forces. So each formula is a line below, and friction and motors of the hinges are two more rows. Hinge i
   turns rod i against the one before it.

   A controller sets the motors once a step, 200 times a second: to the target on a smooth way, with the
   weight taken off, within what the motors can give. Then both rows are switched off and the arm swings freely.

   prints

     after 3 s the hand is at 0.600 0.300 m
     the motors needed no more than 20 of their 40 Nm
     swinging freely for 20 s the energy is kept to 1e-11: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static const double l1 = 0.4, l2 = 0.35, l3 = 0.2;                        /* m */
static const double B11 = 0.64, B22 = 0.204, B33 = 0.0133, B21 = 0.28, B31 = 0.04, B32 = 0.035;
static const double G1 = 17.7, G2 = 6.87, G3 = 0.981;

GVI_EACH(mass, 3, mass)
{
    const double *q = x->q;
    double *M = x->mass;
    M[0] = B11;
    M[3] = B21*cos(q[1] - q[0]);  M[4] = B22;
    M[6] = B31*cos(q[2] - q[0]);  M[7] = B32*cos(q[2] - q[1]);  M[8] = B33;
}

GVI_EACH(gradient, 3, v, f)
{
    const double *q = x->q, *v = x->v;
    const double a = B21*sin(q[1] - q[0])*v[0]*v[1], b = B31*sin(q[2] - q[0])*v[0]*v[2], c = B32*sin(q[2] - q[1])*v[1]*v[2];
    x->f[0] += a + b;  x->f[1] += c - a;  x->f[2] -= b + c;
}

GVI_EACH(weight, 3, f, value)
{
    const double *q = x->q;
    x->f[0] -= G1*sin(q[0]);  x->f[1] -= G2*sin(q[1]);  x->f[2] -= G3*sin(q[2]);
    x->value[0] -= G1*cos(q[0]) + G2*cos(q[1]) + G3*cos(q[2]);
}

/* A torque of a hinge turns one rod forward, the one before it back.              */
GVI_EACH(friction, 3, v, f)
{
    const double *v = x->v, a = 0.4*v[0], b = 0.2*(v[1] - v[0]), c = 0.1*(v[2] - v[1]);
    x->f[0] += b - a;  x->f[1] += c - b;  x->f[2] -= c;
}

GVI_EACH(motors, 3, f)
{
    const double *torque = user;
    x->f[0] += torque[0] - torque[1];  x->f[1] += torque[1] - torque[2];  x->f[2] += torque[2];
}

/* The hand at (x, y), the last rod level.                                         */
static void reach(double x, double y, double *q)
{
    const double wx = x - l3, ww = wx*wx + y*y, bend = acos((ww - l1*l1 - l2*l2)/(2*l1*l2));
    q[0] = atan2(wx, -y) - atan2(l2*sin(bend), l1 + l2*cos(bend));
    q[1] = q[0] + bend;
    q[2] = 1.5707963267948966;
}

/* Torques of the hinges for this step; returns the largest.                       */
static double control(gvi_stepper *st, const double *target, double *torque)
{
    static const double stiff[] = { 100, 40, 5 }, brake[] = { 20, 8, 1 }, G[] = { 17.7, 6.87, 0.981 }, most = 40;
    const double s = fmin(st->t/2.5, 1), way = s*s*s*(10 - s*(15 - 6*s)), rate = 30*s*s*(1 - s)*(1 - s)/2.5;
    double v[3], largest = 0;
    gvi_velocity(st, v);
    for (int i = 2; i >= 0; --i) {
        const double wanted = stiff[i]*(way*target[i] - st->q[i]) + brake[i]*(rate*target[i] - v[i]) + G[i]*sin(st->q[i]);
        torque[i] = fmax(-most, fmin(most, wanted + (i < 2 ? torque[i + 1] : 0)));
        largest = fmax(largest, fabs(torque[i]));
    }
    return largest;
}

int main(void)
{
    static double memory[GVI_LENGTH(3, 8, 8)];
    double torque[3] = { 0, 0, 0 }, target[3], largest = 0, first = 0, now = 0, off = 0;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_FORCE, .points = friction },
                                 { .kind = GVI_FORCE, .points = motors, .user = torque } };
    const gvi_desc desc = { .n = 3, .degree = 8, .effects = scene, .effect_count = 3,
                            .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = gradient } };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0, 0, 0 }, (double[]){ 0, 0, 0 });
    reach(0.6, 0.3, target);
    for (int k = 0; k < 600 && st.status == GVI_OK; ++k) {
        largest = fmax(largest, control(&st, target, torque));
        gvi_step(&st, 0.005);
    }
    if (st.status) return puts(gvi_why(&st)), 1;
    printf("after 3 s the hand is at %.3f %.3f m\n", l1*sin(st.q[0]) + l2*sin(st.q[1]) + l3*sin(st.q[2]),
           -l1*cos(st.q[0]) - l2*cos(st.q[1]) - l3*cos(st.q[2]));
    printf("the motors needed no more than %.0f of their 40 Nm\n", ceil(largest));

    gvi_switch(&st, 1, 0);
    gvi_switch(&st, 2, 0);
    gvi_energy(&st, &first);
    for (int k = 0; k < 8000 && gvi_step(&st, 0.0025) == GVI_OK; ++k) {
        gvi_energy(&st, &now);
        off = fmax(off, fabs(now - first));
    }
    if (st.status) return puts(gvi_why(&st)), 1;
    printf("swinging freely for 20 s the energy is kept to 1e-11: %s\n", off < 1e-11 ? "yes" : "no");
    return 0;
}
