/* 29 - How does a body get its forces? A top, a satellite, a drone

   tools/body.h leaves to you what acts on the body. The quaternion's length is free, or held by a row (the top):

     top         stands on its tip, so its place is no coordinate: n = 4. Its weight is a force in space at a
                 place of the body. Spun by C w = A W cos a + m g l/W, tilted by a, it goes round at W
     satellite   the earth pulls its near end more strongly: a torque in body axes. It rocks about the vertical,
                 sin x = sin a cd(w t, sin a) with w^2 = 3 (B - A)/C, the orbit going round at 1
     drone       flies: n = 7. Four rotors push along its own axis and twist against their turning; a
                 controller reads the state before each step and sets the thrusts

   prints

     top: back after one round of 0.314 s, to 1e-13: yes
     top, length held: back after one round of 0.314 s, to 1e-13: yes
     satellite: rocks once in 0.822 orbits, by elliptic functions 0.822
     drone: after 10 s at 1.000 2.000 3.000 m
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/body.h"
#include "tools/event.h"
#include <math.h>
#include <stdio.h>

static const double turn = 6.283185307179586;
static double memory[GVI_CONSTRAINED_LENGTH(7, 8, 8, 1)];

/* From the spin w in body axes; at rest in its place.                             */
static void begin(gvi_stepper *st, const gvi_desc *desc, const double *q, const double *w)
{
    double v[7] = { 0 };
    body_turn(q + desc->n - 4, w, v + desc->n - 4);
    gvi_init(st, desc, memory, sizeof memory);
    gvi_start(st, 0, q, v);
}

static const body toy = { .inertia = { 2e-4, 2e-4, 8e-5 } };              /* kg m^2, about its tip */

GVI_EACH(toy_weight, 4, f)
{
    const double centre[] = { 0, 0, 0.04 }, weight[] = { 0, 0, -0.981 };  /* m, N   */
    double own[3];
    body_rotate(x->q, 1, weight, own);
    body_force_about(x->q, centre, own, x->f);
}

static void spin_top(int held)
{
    static const bodies one = { &toy, 1 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = toy_weight }, body_unit(&one) };
    gvi_desc desc = { .n = 4, .effects = scene, .effect_count = 1 + held, .mass = body_mass(&one) };
    if (held) desc.mass.velocity = NULL;
    double axis[2][3], off = 0, W = 20, a = 0.5, A = toy.inertia[0], C = toy.inertia[2];
    gvi_stepper st;
    begin(&st, &desc, (double[]){ cos(a/2), sin(a/2), 0, 0 },
          (double[]){ 0, W*sin(a), (A*W*cos(a) + 0.04*0.981/W)/C });
    body_rotate(st.q, 0, (double[]){ 0, 0, 1 }, axis[0]);
    for (int k = 0; k < 80 && st.status == GVI_OK; ++k) gvi_step(&st, turn/W/80);
    body_rotate(st.q, 0, (double[]){ 0, 0, 1 }, axis[1]);
    for (int i = 0; i < 3; ++i) off = fmax(off, fabs(axis[1][i] - axis[0][i]));
    printf("top%s: back after one round of %.3f s, to 1e-13: %s\n", held ? ", length held" : "", st.t, off < 1e-13 ? "yes" : "no");
}

static const body boom = { .inertia = { 1, 4, 4.5 } };

/* 3 r x I r, r pointing away from the earth                                       */
GVI_EACH(gravity_gradient, 4, f)
{
    double r[3], Ir[3], torque[3];
    body_rotate(x->q, 1, (double[]){ cos(*x->t), sin(*x->t), 0 }, r);
    for (int i = 0; i < 3; ++i) Ir[i] = 3*boom.inertia[i]*r[i];
    body_cross(r, Ir, torque);
    body_torque(x->q, torque, x->f);
}

/* The boom's angle to the vertical, its sine.                                     */
static double sideways(double t, const double *e, const double *v, void *user)
{
    double r[3];
    body_rotate(e, 1, (double[]){ cos(t), sin(t), 0 }, r);
    return (void)v, (void)user, -r[1];
}

static void rock_satellite(void)
{
    static const bodies one = { &boom, 1 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity_gradient } };
    const gvi_desc desc = { .n = 4, .effects = scene, .effect_count = 1, .mass = body_mass(&one) };
    double q[4], v[4], p[4], x = 0.75, mean = 1, other = cos(x);
    event e = { .g = sideways, .q = q, .v = v, .p = p };
    gvi_stepper st;
    begin(&st, &desc, (double[]){ cos(x/2), 0, 0, sin(x/2) }, (double[]){ 0, 0, 1 });
    while (gvi_step(&st, 0.1) == GVI_OK && !event_next(&e, &st)) {}         /* a quarter of its period */
    for (int k = 0; k < 6; ++k) x = (mean + other)/2, other = sqrt(mean*other), mean = x;
    printf("satellite: rocks once in %.3f orbits, by elliptic functions %.3f\n", 4*e.t/turn, sqrt(4.5/9)/mean);
}

static const body quad = { 0.8, { 0.005, 0.005, 0.009 } };
static const double arm[4][3] = { { 0.2, 0, 0 }, { 0, 0.2, 0 }, { -0.2, 0, 0 }, { 0, -0.2, 0 } }, twist = 0.02;

GVI_POINTS(rotors, 7, f)(const gvi_points *x, void *thrust)
{
    x->f[2] -= quad.mass*9.81;
    for (int i = 0; i < 4; ++i) {
        const double push = ((const double *)thrust)[i];
        body_force(x->q, arm[i], (double[]){ 0, 0, push }, x->f);
        body_torque(x->q + 3, (double[]){ 0, 0, i % 2 ? twist*push : -twist*push }, x->f + 3);
    }
    return 0;
}

/* Towards the target: the lift, a tilt, and a torque that gives the tilt.         */
static void control(gvi_stepper *st, const double *target, double *thrust)
{
    double v[7], w[3], pull[3], torque[3];
    gvi_velocity(st, v);
    body_spin(st->q + 3, v + 3, w);
    for (int i = 0; i < 3; ++i) pull[i] = fmax(-3, fmin(3, 1.5*(target[i] - st->q[i]) - 2*v[i]));
    const double tilt[3] = { -pull[1]/9.81, pull[0]/9.81, 0 }, lift = quad.mass*(9.81 + pull[2]);
    for (int i = 0; i < 3; ++i) torque[i] = quad.inertia[i]*(60*(tilt[i] - 2*st->q[4 + i]*st->q[3]) - 12*w[i]);
    for (int i = 0; i < 4; ++i)
        thrust[i] = lift/4 + (arm[i][1]*torque[0] - arm[i][0]*torque[1])/0.08 + (i % 2 ? 1 : -1)*torque[2]/(4*twist);
}

static void fly_drone(void)
{
    static const bodies one = { &quad, 1 };
    double thrust[4];
    const gvi_effect scene[] = { { .kind = GVI_FORCE, .points = rotors, .user = thrust } };
    const gvi_desc desc = { .n = 7, .degree = 4, .effects = scene, .effect_count = 1, .mass = body_mass(&one) };
    gvi_stepper st;
    begin(&st, &desc, (double[]){ 0, 0, 0, 0.9, 0.3, -0.2, 0.2 }, (double[]){ 1, 0, -1 });       /* thrown */
    for (int k = 0; k < 1000 && st.status == GVI_OK; ++k) {
        control(&st, (double[]){ 1, 2, 3 }, thrust);
        gvi_step(&st, 0.01);
    }
    printf("drone: after %.0f s at %.3f %.3f %.3f m\n", st.t, st.q[0], st.q[1], st.q[2]);
}

int main(void)
{
    spin_top(0);
    spin_top(1);
    rock_satellite();
    fly_drone();
}
