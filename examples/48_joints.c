/* 48 - Which joints are there? Two shafts at an angle, a universal joint between them, a gear behind

   The first shaft turns in a bearing along z, the second in one at 40 degrees to it, the third beside the second, geared to turn
   twice as fast the other way. tools/body.h has the rows; each joint is made where the bodies lie at the start:

     hinge 5 rows      universal 4      gear 1      (ball 3, slider 5, cylinder 4; a rope over a pulley 1)

   20 rows for 18 ways to move, and one way is left: three rows are redundant, which the library sees by itself.

   A constant torque T drives the first shaft from rest. Its angle a and the second's, b, are in tan b = tan a cos 40,
   so b goes fast and slow: b' = r a', r = cos 40/(cos a cos a + cos 40 cos 40 sin a sin a). The work is the energy,
   T a = W a' a'/2, W = I1 + J r r, J = I2 + 4 I3. What the joint passes on is J b''. None of that is in the program but to compare.

   prints

     turns: 20.10
     tan b = tan a cos 40, to 1e-12: yes
     a' as the work says, to 1e-12: yes
     the joint's torque on the second shaft is J b'', to 1e-9: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/body.h"
#include <math.h>
#include <stdio.h>

enum { N = 21, ROWS = 20 };
static const double T = 0.5, turn = 6.283185307179586;                     /* Nm */

GVI_EACH(motor, N, f)
{
    const double torque[] = { 0, 0, T };
    body_torque(x->q + 3, torque, x->f + 3);
}

int main(void)
{
    static double memory[GVI_CONSTRAINED_LENGTH(N, 6, 6, ROWS)];
    static const body shaft[] = { { 2, { 0.03, 0.03, 0.01 } }, { 2, { 0.03, 0.03, 0.02 } }, { 1, { 0.01, 0.01, 0.005 } } };
    static const bodies all = { shaft, 3 };
    const double tilt = turn/9, c = cos(tilt), s = sin(tilt), e = cos(tilt/2), f = -sin(tilt/2), J = 0.04;
    const double z[] = { 0, 0, 1 }, x[] = { 1, 0, 0 }, along[] = { 0, s, c }, pin[] = { 0, c, -s }, centre[] = { 0, 0, 0 };
    double q[N] = { 0, 0, -0.5, 1, 0, 0, 0,   0, s/2, c/2, e, f, 0, 0,   0.2, s/2, c/2, e, f, 0, 0 }, v[N] = { 0 };
    const body_joint bearing[] = { body_joined(BODY_HINGE, q, BODY_WORLD, 0, q, z, NULL),
                                   body_joined(BODY_HINGE, q, BODY_WORLD, 7, q + 7, along, NULL),
                                   body_joined(BODY_HINGE, q, BODY_WORLD, 14, q + 14, along, NULL) };
    const body_joint cross = body_joined(BODY_UNIVERSAL, q, 0, 7, centre, x, pin);
    const body_gear gear = { { &bearing[1], &bearing[2] }, { 2, 1 } };
    const gvi_effect scene[] = { { .kind = GVI_FORCE, .points = motor }, body_holds(&cross), body_holds(&bearing[0]),
                                 body_holds(&bearing[1]), body_holds(&bearing[2]), body_meshes(&gear) };
    gvi_desc desc = { .n = N, .degree = 6, .effects = scene, .effect_count = 6, .mass = body_mass(&all) };
    desc.mass.velocity = NULL;
    double a = 0, off[3] = { 0 }, lambda[ROWS], force[3], torque[3], w[3], first[2], second[2];
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 1000 && st.status == GVI_OK; ++k) {
        gvi_step(&st, 0.005);
        gvi_velocity(&st, v);
        gvi_multipliers(&st, lambda);
        body_spin(st.q + 3, v + 3, w);
        body_reaction(&cross, st.q, lambda, force, torque);                // its rows are the first

        body_turned(&bearing[0], st.q, first);                             // cosine and sine
        body_turned(&bearing[1], st.q, second);
        a += remainder(atan2(first[1], first[0]) - a, turn);
        const double low = cos(a)*cos(a) + c*c*sin(a)*sin(a), r = c/low, slope = c*s*s*sin(2*a)/(low*low);
        const double W = 0.01 + J*r*r, speed = sqrt(2*T*a/W), faster = (T - J*r*slope*speed*speed)/W;
        const double passed = torque[1]*s + torque[2]*c, wanted = J*(slope*speed*speed + r*faster);
        off[0] = fmax(off[0], fabs(second[1]*first[0] - second[0]*first[1]*c));
        off[1] = fmax(off[1], fabs(w[2]/speed - 1));
        off[2] = fmax(off[2], fabs(passed - wanted)/(J*speed*speed));
    }
    if (st.status) return puts(gvi_why(&st)), 1;
    printf("turns: %.2f\n", a/turn);
    printf("tan b = tan a cos 40, to 1e-12: %s\n", off[0] < 1e-12 ? "yes" : "no");
    printf("a' as the work says, to 1e-12: %s\n", off[1] < 1e-12 ? "yes" : "no");
    printf("the joint's torque on the second shaft is J b'', to 1e-9: %s\n", off[2] < 1e-9 ? "yes" : "no");
    return 0;
}
