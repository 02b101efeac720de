/* 43 - A coin that rolls, and one that falls: nonholonomic constraints

   A disc of mass and radius 1 (inertia 1/4 and 1/2) rolls on a plane. Coordinates: its centre's x and y, yaw, tilt
   (upright: pi/2), spin. That its lowest point does not slip is no condition on coordinates: the coin may be anywhere
   with any yaw and spin. It is one on velocities, A(q) v = 0, two rows. The ground's force, sideways, is lambda.

   With a steady tilt a and yaw rate W the spin about the axis has to be (W W sin a cos a/4 - g cos a)/(1.5 sin a W).

   prints

     steady for 20 s, to 1e-10: yes
     the ground pushes sideways with 3.159, centre on its circle: 3.159
     a slow one falls to 0.342 and rises; energy kept to 1e-12: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

GVI_EACH(mass, 5, mass)
{
    const double c = cos(x->q[3]), s = sin(x->q[3]);
    x->mass[0] = x->mass[6] = 1;
    x->mass[12] = s*s/4 + c*c/2;
    x->mass[18] = 0.25 + c*c;
    x->mass[22] = c/2;
    x->mass[24] = 0.5;
}

GVI_EACH(slope, 5, v, f)                          // v' dM/dq v/2
{
    const double c = cos(x->q[3]), s = sin(x->q[3]), *v = x->v;
    x->f[3] += -c*s*v[3]*v[3] + v[2]*v[2]*s*c/4 - (v[4] + c*v[2])*s*v[2]/2;
}

GVI_EACH(weight, 5, f, value)
{
    x->f[3] -= 9.81*cos(x->q[3]);
    x->value[0] += 9.81*sin(x->q[3]);
}

GVI_EACH(rolls, 5, rows(2))                       // the velocity of the point on the ground is 0
{
    const double cf = cos(x->q[2]), sf = sin(x->q[2]), c = cos(x->q[3]), s = sin(x->q[3]);
    double *A = x->jacobian, *B = A + 5;
    A[0] = 1, A[2] = c*cf, A[3] = -s*sf, A[4] = cf;
    B[1] = 1, B[2] = c*sf, B[3] = s*cf, B[4] = sf;
}

static void roll(double *q, double *v)            // x', y' from the other velocities
{
    v[0] = -(cos(q[3])*v[2] + v[4])*cos(q[2]) + sin(q[3])*v[3]*sin(q[2]);
    v[1] = -(cos(q[3])*v[2] + v[4])*sin(q[2]) - sin(q[3])*v[3]*cos(q[2]);
}

int main(void)
{
    static double memory[GVI_CONSTRAINED_LENGTH(5, 6, 6, 2)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_NONHOLONOMIC, .points = rolls, .rows = 2 } };
    const gvi_desc desc = { .n = 5, .degree = 6, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = slope } };
    const double c = cos(1.1), s = sin(1.1), W = 1.5, axis = (W*W*s*c/4 - 9.81*c)/(1.5*s*W);
    double q[] = { 0, 0, 0, 1.1, 0 }, v[] = { 0, 0, W, 0, axis - W*c }, off = 0, start, end, lambda[2];
    gvi_stepper st;
    roll(q, v);
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 400 && st.status == GVI_OK; ++k) {
        gvi_step(&st, 0.05);
        off = fmax(off, fabs(st.q[3] - 1.1));
    }
    gvi_multipliers(&st, lambda);
    printf("steady for 20 s, to 1e-10: %s\n", off < 1e-10 ? "yes" : "no");
    printf("the ground pushes sideways with %.3f, centre on its circle: %.3f\n", hypot(lambda[0], lambda[1]), fabs(axis*W));

    double q2[] = { 0, 0, 0, 1.2, 0 };
    double v2[] = { 0, 0, 0.6, 0.1, -1 }, lowest = 2;
    roll(q2, v2);
    gvi_start(&st, 0, q2, v2);
    gvi_energy(&st, &start);
    for (int k = 0; k < 500 && st.status == GVI_OK; ++k) {
        gvi_step(&st, 0.01);
        lowest = fmin(lowest, st.q[3]);
    }
    gvi_energy(&st, &end);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    printf("a slow one falls to %.3f and rises; energy kept to 1e-12: %s\n", lowest, fabs(end/start - 1) < 1e-12 ? "yes" : "no");
    return 0;
}
