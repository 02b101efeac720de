/* 53 - An observer in float: a model that measurements correct, for hours

   A driven pendulum has an encoder of 4096 counts a turn and nothing that measures its speed.
   Differences of counts are steps of 0.15 rad/s. An observer is a model that runs beside the
   machine: each period it makes a step with the torque that was commanded, and what the encoder
   says then moves its angle and its speed a little,

     q += l1 (y - q)    v += l2 (y - q)    l1 = 2 D w h,  l2 = w^2 h:  the error decays like exp(-D w t)

   gvi_start takes the corrected state. At the stepper's own time, st.t, it keeps the low word of
   the time: st.t + st.t_low is right for as long as the machine runs. A step after a start has no
   predictor: fix .iterations at one more than the model alone would need.

   Do not take sin(4 t) in float: after an hour x->t moves in steps of 1/4096 s. What repeats
   counts its periods in an integer; its value reaches the callback by `user`.

   The machine is a Runge-Kutta method in double, with more friction than the model knows of.

   prints

     from the 2nd second to the end of an hour the speed is known
       by differences of counts to   0.26 rad/s
       by the observer to            0.01 rad/s
     and the angle within a count of the encoder: yes
     after an hour, h added up in float is off by  3.2 s
                    st.t + st.t_low is off by      0.0 s
     steps that failed: 0
*/
#define GVI_REAL float
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

enum { HOUR = 360000, TURN = 125 };                     // periods; those of the drive
static const float h = 0.01f, weight = 39.25f, rub = 1.5f;

GVI_EACH(swing, 1, f)    { x->f[0] -= weight*sinf(x->q[0]); }
GVI_EACH(friction, 1, v, f) { x->f[0] -= rub*x->v[0]; }
GVI_EACH(motor, 1, f)    { x->f[0] += *(const float *)user; }

/* The machine over one period: classical Runge-Kutta, order 4, eight steps.     */
static double pushed(double q, double v, double torque) { return torque - 39.25*sin(q) - 1.52*v; }
static void machine(double *q, double *v, double torque)
{
    const double d = (double)h/8;
    for (int k = 0; k < 8; ++k) {
        const double a = pushed(*q, *v, torque), v2 = *v + d/2*a, b = pushed(*q + d/2**v, v2, torque);
        const double v3 = *v + d/2*b, c = pushed(*q + d/2*v2, v3, torque), v4 = *v + d*c;
        const double e = pushed(*q + d*v3, v4, torque);
        *q += d/6*(*v + 2*v2 + 2*v3 + v4);
        *v += d/6*(a + 2*b + 2*c + e);
    }
}

int main(void)
{
    static float memory[GVI_LENGTH(1, 2, 2)];
    const double turn = 2*acos(-1), count = turn/4096;
    const float w = 20, D = 0.7f, l1 = 2*D*w*h, l2 = w*w*h;
    float torque = 0, summed = 0;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = swing },
                                 { .kind = GVI_FORCE, .points = friction },
                                 { .kind = GVI_POTENTIAL, .points = motor, .user = &torque } };
    const gvi_desc desc = { .n = 1, .degree = 2, .effects = scene, .effect_count = 3,
                            .formulation = GVI_VELOCITIES, .iterations = 4 };
    const float unknown[] = { 0 };
    double q = 1, v = 0, before = 0, off[3] = { 0, 0, 0 };       // of differences, observer, angle
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, unknown, unknown);

    for (int k = 0; k < HOUR && st.status == GVI_OK; ++k) {
        torque = 12*(float)sin(turn*(k % TURN)/TURN);
        machine(&q, &v, (double)torque);
        const double y = count*floor(q/count + 0.5);             // the encoder

        gvi_step(&st, h);
        float speed;
        gvi_velocity(&st, &speed);
        const float miss = (float)y - st.q[0], angle = st.q[0] + l1*miss;
        speed += l2*miss;
        gvi_start(&st, st.t, &angle, &speed);

        summed += h;
        if (k > 100) {
            off[0] = fmax(off[0], fabs((y - before)/(double)h - v));
            off[1] = fmax(off[1], fabs((double)speed - v));
            off[2] = fmax(off[2], fabs((double)angle - q));
        }
        before = y;
    }

    const double end = HOUR*(double)h;
    printf("from the 2nd second to the end of an hour the speed is known\n");
    printf("  by differences of counts to   %.2f rad/s\n", off[0]);
    printf("  by the observer to            %.2f rad/s\n", off[1]);
    printf("and the angle within a count of the encoder: %s\n", off[2] < count ? "yes" : "no");
    printf("after an hour, h added up in float is off by  %.1f s\n", fabs((double)summed - end));
    printf("               st.t + st.t_low is off by      %.1f s\n", fabs((double)st.t + (double)st.t_low - end));
    printf("steps that failed: %d\n", (int)st.counters.failures);
    return 0;
}
