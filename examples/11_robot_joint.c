/* 11 - A two-joint arm in a 1 kHz loop: float, static memory, bounded work

   As on a microcontroller: the type is float (chosen before the #include), all
   memory is static and its length a constant, the number of iterations is
   bounded, and nothing in the loop allocates or prints.  Motor torque and
   friction are rows in effects[]; the arm is a mass matrix M(q) and a weight.
   The controller sets the torque once a step, as a sampled controller does.

   prints

     after 6 s: joints at 0.600 and 0.900 rad
     steps that failed: 0
     iterations in one step, at most 10: yes
*/
#define GVI_REAL float
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static const float m1 = 1.2f, m2 = 0.8f, l1 = 0.4f, l2 = 0.3f, g = 9.81f;

typedef struct motor { float torque[2]; } motor;

GVI_EACH(arm_mass, 2, mass)
{
    float far = m2*l2*l2, mid = m2*l1*l2*cosf(x->q[1]);
    x->mass[0] = (m1 + m2)*l1*l1 + far + 2*mid;
    x->mass[2] = far + mid;
    x->mass[3] = far;
}

GVI_EACH(arm_gradient, 2, v, f)
{
    x->f[1] -= m2*l1*l2*sinf(x->q[1])*x->v[0]*(x->v[0] + x->v[1]);
}

GVI_EACH(arm_weight, 2, f)
{
    float far = m2*g*l2*sinf(x->q[0] + x->q[1]);
    x->f[0] -= (m1 + m2)*g*l1*sinf(x->q[0]) + far;
    x->f[1] -= far;
}

GVI_EACH(motors, 2, f)
{
    const motor *m = user;
    x->f[0] += m->torque[0];
    x->f[1] += m->torque[1];
}

GVI_EACH(friction, 2, v, f)
{
    x->f[0] -= 0.2f*x->v[0];
    x->f[1] -= 0.2f*x->v[1];
}

/* Proportional, integral and differential control of both joints.             */
static void control(gvi_stepper *st, motor *m, float *sum)
{
    static const float target[2] = { 0.6f, 0.9f }, kp[2] = { 60, 20 }, ki[2] = { 90, 30 }, kd[2] = { 6, 2 };
    float v[2] = { 0, 0 };
    gvi_velocity(st, v);
    for (int i = 0; i < 2; ++i) {
        float e = target[i] - st->q[i];
        sum[i] += e*0.001f;
        m->torque[i] = kp[i]*e + ki[i]*sum[i] - kd[i]*v[i];
    }
}

int main(void)
{
    static float memory[GVI_LENGTH(2, 2, 2)];
    static const float rest[2] = { 0, 0 };
    motor m = { { 0, 0 } };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = arm_weight },
                                 { .kind = GVI_FORCE, .points = friction },
                                 { .kind = GVI_FORCE, .points = motors, .user = &m } };
    const gvi_desc desc = { .n = 2, .degree = 2, .effects = scene, .effect_count = 3, .max_iterations = 10,
                            .mass = { .kind = GVI_MASS_POSITION, .points = arm_mass, .gradient = arm_gradient } };
    float sum[2] = { 0, 0 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, rest, rest);
    for (int k = 0; k < 6000 && st.status == GVI_OK; ++k) {
        control(&st, &m, sum);
        gvi_step(&st, 0.001f);
    }
    printf("after 6 s: joints at %.3f and %.3f rad\n", (double)st.q[0], (double)st.q[1]);
    printf("steps that failed: %d\n", (int)st.counters.failures);
    printf("iterations in one step, at most 10: %s\n", st.counters.most_iterations <= 10 ? "yes" : "no");
    return 0;
}
