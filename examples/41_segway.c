/* 41 - A motor and a Lagrangian: a segway that stands up

   A wheel of radius r rolls, a body leans on its axle: x is how far the axle has gone, a the lean of the body.
   L is one line. The motor acts between body and wheel: its torque pushes the axle by torque/r and
   turns the body back by as much, a force that is not in L. A controller sets the torque a hundred times a
   second from x, a and their velocities; between two of these times it is constant, and a step ends there.

   How much does the motor work? In each step the torque times the angle by which the wheel has turned against the
   body, since the torque is constant. All of it must be the energy that the segway has gained; and in the
   end, when it stands at rest, what it takes to raise the body, m g h (1 - cos 0.2).

   prints

     without the motor it lies down after 0.57 s
     with it, after 20 s: x = 0.000, lean = 0.000
     largest torque 14.00 N m
     work of the motor 0.9777 J, to raise the body 0.9777 J
     energy gained the same to 1e-10: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"

/* kg, m, kg m^2: the wheels with their moment of inertia, the body about its centre of mass */
typedef struct segway { double wheels, radius, inertia, body, height, about, torque; } segway;

LAGRANGIAN(leaning, 2)
{
    const segway *s = user;
    const number a = q[1], u = v[0], w = v[1];             // x is not in it: the ground is level
    const double rolling = s->wheels + s->inertia/(s->radius*s->radius);
    return (rolling + s->body)*u*u/2 + s->body*s->height*cos(a)*u*w + (s->body*s->height*s->height + s->about)*w*w/2
           - s->body*9.81*s->height*cos(a);
}

GVI_EACH(motor, 2, v, f)
{
    const segway *s = user;
    x->f[0] += s->torque/s->radius;
    x->f[1] -= s->torque;
}

/* Steps of 1/100 s, until it lies down or 20 s have passed. */
static int ride(gvi_stepper *st, segway *s, int on, double *work, double *most)
{
    int k = 0;
    *work = *most = 0;
    for (; k < 2000 && st->status == GVI_OK && fabs(st->q[1]) < 1.57; ++k) {
        double v[2];
        gvi_velocity(st, v);
        s->torque = on ? 4*st->q[0] + 7*v[0] + 70*st->q[1] + 18*v[1] : 0;
        const double before = st->q[0]/s->radius - st->q[1];
        gvi_step(st, 0.01);
        *work += s->torque*(st->q[0]/s->radius - st->q[1] - before);
        *most = fmax(*most, fabs(s->torque));
    }
    return k;
}

int main(void)
{
    static segway s = { .wheels = 2, .radius = 0.2, .inertia = 0.04, .body = 10, .height = 0.5, .about = 0.8 };
    static double memory[GVI_LENGTH(2, 4, 4)];
    static lagrangian L;
    const double q[] = { 0, 0.2 }, v[] = { 0, 0 };
    const char *wrong = lagrangian_init(&L, leaning, &s, 0, q, v);
    if (wrong) return puts(wrong), 1;
    const gvi_effect scene[] = { lagrangian_effect(&L), { .kind = GVI_FORCE, .points = motor, .user = &s } };
    const gvi_desc desc = { .n = 2, .degree = 4, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 2 };
    double start, end, work, most;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    gvi_energy(&st, &start);
    printf("without the motor it lies down after %.2f s\n", ride(&st, &s, 0, &work, &most)/100.0);

    gvi_start(&st, 0, q, v);
    ride(&st, &s, 1, &work, &most);
    gvi_energy(&st, &end);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    printf("with it, after %.0f s: x = %.3f, lean = %.3f\n", st.t, fabs(st.q[0]), fabs(st.q[1]));
    printf("largest torque %.2f N m\n", most);
    printf("work of the motor %.4f J, to raise the body %.4f J\n", work, s.body*9.81*s.height*(1 - cos(q[1])));
    printf("energy gained the same to 1e-10: %s\n", fabs(end - start - work) < 1e-10 ? "yes" : "no");
    return 0;
}
