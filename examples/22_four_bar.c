/* 22 - What must the joints of a driven linkage bear? A four-bar, a motor and its loads

   Crank of 0.1 m about the origin, coupler of 0.25 m, rocker of 0.2 m about (0.3, 0) m; uniform
   bars of 2 kg a metre in the plane, weight along -y. Coordinates are the two moving joints. Three
   bars, three constraints: the loop closes by itself, no angle is ever solved for. A motor turns
   the crank with torque K (w0 - w), w = (x vy - y vx)/l^2: as a force on the joint, across the bar.

   Multipliers are loads: lambda times the length is the force along the bar, less the part of its
   own inertia and weight that its ends carry. The work of the motor, less losses at the rocker,
   is the energy gained: a check that shares nothing with the constraints.

   prints

     turns in 5 s: 15.48
     crank speed in the last second: 16.1 to 25.1 rad/s
     the rocker swings between 93.6 and 153.6 degrees
     load along crank, coupler, rocker: 59.4, 41.7, 25.7 N at most
     energy against the work of motor and bearing, to 1e-9: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static const double crank = 0.1, coupler = 0.25, rocker = 0.2, ground = 0.3, gravity = 9.81;

GVI_EACH(bars, 6, rows(3))
{
    const double X = x->q[0], Y = x->q[1], U = x->q[2], W = x->q[3], a = U - X, b = W - Y, c = U - ground;
    double *G1 = x->jacobian, *G2 = G1 + 6, *G3 = G2 + 6;
    x->g[0] = (X*X + Y*Y - crank*crank)/2;
    x->g[1] = (a*a + b*b - coupler*coupler)/2;
    x->g[2] = (c*c + W*W - rocker*rocker)/2;
    G1[0] = X, G1[1] = Y;
    G2[0] = -a, G2[1] = -b, G2[2] = a, G2[3] = b;
    G3[2] = c, G3[3] = W;
}

/* Half of each bar's weight at each of its ends. */
GVI_EACH(weight, 4, f, value)
{
    const double first = (crank + coupler)*gravity, second = (coupler + rocker)*gravity;
    x->f[1] -= first;
    x->f[3] -= second;
    x->value[0] += first*x->q[1] + second*x->q[3];
}

/* The two powers are coordinates that nothing moves: their momenta are the works. */
GVI_EACH(motor, 6, v, f)
{
    const double *q = x->q, *v = x->v;
    const double w = (q[0]*v[1] - q[1]*v[0])/(crank*crank), torque = 0.3*(20 - w);
    const double c = q[2] - ground, turn = (c*v[3] - q[3]*v[2])/(rocker*rocker), brake = -0.02*turn;
    x->f[0] -= torque*q[1]/(crank*crank);
    x->f[1] += torque*q[0]/(crank*crank);
    x->f[2] -= brake*q[3]/(rocker*rocker);
    x->f[3] += brake*c/(rocker*rocker);
    x->f[4] += torque*w;
    x->f[5] += brake*turn;
}

int main(void)
{
    static double M[36], memory[GVI_CONSTRAINED_LENGTH(6, 6, 6, 3)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_FORCE, .points = motor },
                                 { .kind = GVI_CONSTRAINT, .points = bars, .rows = 3 } };
    const gvi_desc desc = { .n = 6, .degree = 6, .effects = scene, .effect_count = 3,
                            .mass = { .kind = GVI_MASS_DENSE, .matrix = M } };
    for (int i = 0; i < 2; ++i) {                 // a uniform bar: m/3 at each end, m/6 between them
        M[7*i] = 2*(crank + coupler)/3;
        M[7*i + 14] = 2*(coupler + rocker)/3;
        M[6*(i + 2) + i] = M[6*i + i + 2] = 2*coupler/6;
        M[7*i + 28] = 1;
    }
    // crank up: the other joint where circles about both its neighbours meet
    const double d = hypot(ground, crank), along = (d*d + coupler*coupler - rocker*rocker)/(2*d);
    const double across = sqrt(coupler*coupler - along*along);
    const double q[6] = { 0, crank, (along*ground + across*crank)/d, crank + (across*ground - along*crank)/d };
    const double v[6] = { 0 };
    double turns = 0, load[3] = { 0 }, slow = 99, fast = 0, least = 9, most = -9, before = 0, after = 0, lambda[3], now[6];
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    gvi_energy(&st, &before);
    for (int k = 0; k < 2500 && st.status == GVI_OK; ++k) {
        gvi_step(&st, 0.002);
        gvi_multipliers(&st, lambda);
        gvi_velocity(&st, now);
        const double w = (st.q[0]*now[1] - st.q[1]*now[0])/(crank*crank), swing = atan2(st.q[3], st.q[2] - ground);
        const double length[3] = { crank, coupler, rocker };
        turns += 0.002*w/6.28318530717958648;
        if (st.t > 4) slow = fmin(slow, w), fast = fmax(fast, w);
        least = fmin(least, swing), most = fmax(most, swing);
        for (int i = 0; i < 3; ++i) load[i] = fmax(load[i], fabs(lambda[i])*length[i]);
    }
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    gvi_energy(&st, &after);
    const double kinetic = (st.p[4]*st.p[4] + st.p[5]*st.p[5])/2, gained = after - kinetic - before;
    printf("turns in 5 s: %.2f\n", turns);
    printf("crank speed in the last second: %.1f to %.1f rad/s\n", slow, fast);
    printf("the rocker swings between %.1f and %.1f degrees\n", least*57.29577951, most*57.29577951);
    printf("load along crank, coupler, rocker: %.1f, %.1f, %.1f N at most\n", load[0], load[1], load[2]);
    printf("energy against the work of motor and bearing, to 1e-9: %s\n",
           fabs(gained - st.p[4] - st.p[5]) < 1e-9 ? "yes" : "no");
    return 0;
}
