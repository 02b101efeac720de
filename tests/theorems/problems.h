/* problems.h - the mechanical systems of the studies in this directory

   Six that are nonlinear, each in a way of its own, and two whose closed forms are
   known:

     oscillator   L = v^2/2 - q^2/2                                     (omega = 1)
     uniform      L = v^2/2 - 3q/2
     Kepler       L = v'v/2 + 1/|q|
     pendulum     L = v'M(q)v/2 + 2 cos q1 + cos(q1 + q2)         double pendulum
     magnetic     L = v'v/2 + a(q)'v - q1^2/2 - q2^2 - q1^2 q2/2
                  a = (-q2 (1 + q1^2), q1)/2
     length       L = l(t)^2 v^2/2 + l(t) cos q      a pendulum being pulled up and
                  l = 1 + sin(2t)/4                  down: time in the kinetic term
     saddle       L = (v1^2 - v2^2)/2 + cos(q1 + q2) - q1^2 q2/4
                  kinetic energy of both signs: no curve is a minimum
     mixed        L = l(t) (1 + q2^2/3) v1^2/2 + v1^4/24 - v2^2/2 + q1 v1 v2/3
                      + q2^2 v1/2 - cos(q1 - q2)
                  all of it at once: M(t, q, v) of both signs, momenta cubic in v

   and the forces of the forced ones:

     drag         -0.2 v                                             on magnetic
     air          -0.05 |v| v       (whose speed must not come near 0) on Kepler
     motor        cos(3t) (1 - v1/4), less 0.1 v2 on the other joint on pendulum
                  (a torque of t alone would be a potential: -q tau(t))
     swirl        (-v1/5 + 3 q2 v2/10, cos(3t)/2 - (1 + q1^2) v2/10) on mixed

   Each is told to gvi.h as a scene, and once more to the reference as what
   reference.h needs: kinetic energy, its derivatives, v from p.              */
#ifndef PROBLEMS_H
#define PROBLEMS_H

#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#ifndef GVI_IMPLEMENTATION
#define GVI_IMPLEMENTATION
#endif
#include "gvi.h"
#include <float.h>
#include <stdlib.h>
#include <string.h>
#include <tgmath.h>

typedef gvi_real real;
#include "tests/problems.h"

#define UNIT  ((real)LDBL_EPSILON)
#define TAU   6.28318530717958647692528676655900577L

enum { MAX_N = 2, STARTS = 3, MAX_EFFECTS = 3 };

typedef struct problem {
    const char *name;
    int         n;
    gvi_mass    mass;
    gvi_effect  effects[MAX_EFFECTS];     /* the force, if any, last */
    int         effect_count, forced;
    real      (*lagrangian)(real t, const real *q, const real *v);
    /* adds dT/dq and dT/dv of a kinetic energy that no effect holds */
    void      (*kinetic)(const real *q, const real *v, real *dq, real *dv);
    void      (*velocity)(real t, const real *q, const real *p, real *v);
    real        q[STARTS][MAX_N], v[STARTS][MAX_N];
    real        time;                     /* of a run */
} problem;

/* ------------------------------------------------------- kinetic energies */

static MAYBE void unit_1(const real *q, const real *v, real *dq, real *dv)
{
    dv[0] += v[0];
}

static MAYBE void unit_2(const real *q, const real *v, real *dq, real *dv)
{
    dv[0] += v[0];
    dv[1] += v[1];
}

static MAYBE void no_kinetic(const real *q, const real *v, real *dq, real *dv)
{
}

static MAYBE void pendulum_kinetic(const real *q, const real *v, real *dq, real *dv)
{
    real c = cos(q[1]);
    dv[0] += (3 + 2*c)*v[0] + (1 + c)*v[1];
    dv[1] += (1 + c)*v[0] + v[1];
    dq[1] -= sin(q[1])*v[0]*(v[0] + v[1]);
}

/* -------------------------------------------------------------- oscillator */

static MAYBE int spring(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] -= q[0];
    return 0;
}

HESSIAN(spring_hessian)
{
    fq[0] -= 1;
    return 0;
}

static MAYBE int spring_value(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->value[k] += x->q[k]*x->q[k]/2;
    return 0;
}

static MAYBE real oscillator_lagrangian(real t, const real *q, const real *v)
{
    return (v[0]*v[0] - q[0]*q[0])/2;
}

static MAYBE void momentum_is_velocity_1(real t, const real *q, const real *p, real *v)
{
    v[0] = p[0];
}

/* ------------------------------------------------------------------ Kepler */

static MAYBE int attraction_at(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    real r2 = q[0]*q[0] + q[1]*q[1], w = -1/(r2*sqrt(r2));
    f[0] += w*q[0];
    f[1] += w*q[1];
    return 0;
}

static MAYBE real kepler_lagrangian(real t, const real *q, const real *v)
{
    return (v[0]*v[0] + v[1]*v[1])/2 + 1/sqrt(q[0]*q[0] + q[1]*q[1]);
}

static MAYBE void momentum_is_velocity_2(real t, const real *q, const real *p, real *v)
{
    v[0] = p[0];
    v[1] = p[1];
}

/* ---------------------------------------------------------- double pendulum */

static MAYBE real pendulum_lagrangian(real t, const real *q, const real *v)
{
    real c = cos(q[1]);
    return ((3 + 2*c)*v[0]*v[0] + 2*(1 + c)*v[0]*v[1] + v[1]*v[1])/2 + 2*cos(q[0]) + cos(q[0] + q[1]);
}

/* M^-1 p in closed form: det M = 3 + 2c - (1 + c)^2 = 2 - c^2 */
static MAYBE void pendulum_velocity(real t, const real *q, const real *p, real *v)
{
    real c = cos(q[1]), det = 2 - c*c;
    v[0] = (p[0] - (1 + c)*p[1])/det;
    v[1] = ((3 + 2*c)*p[1] - (1 + c)*p[0])/det;
}

/* ----------------------------------------------------------------- magnetic */

static MAYBE int trap(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] -= q[0] + q[0]*q[1];
    f[1] -= 2*q[1] + q[0]*q[0]/2;
    return 0;
}

HESSIAN(trap_hessian)
{
    fq[0] -= 1 + q[1];
    fq[1] -= q[0];
    fq[2] -= q[0];
    fq[3] -= 2;
    return 0;
}

static MAYBE int trap_value(const gvi_points *x, void *user)
{
    const real *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k) x->value[k] += a[k]*a[k]/2 + b[k]*b[k] + a[k]*a[k]*b[k]/2;
    return 0;
}

static MAYBE real magnetic_lagrangian(real t, const real *q, const real *v)
{
    return (v[0]*v[0] + v[1]*v[1])/2 + (q[0]*v[1] - q[1]*(1 + q[0]*q[0])*v[0])/2
         - q[0]*q[0]/2 - q[1]*q[1] - q[0]*q[0]*q[1]/2;
}

static MAYBE void magnetic_velocity(real t, const real *q, const real *p, real *v)
{
    v[0] = p[0] + q[1]*(1 + q[0]*q[0])/2;
    v[1] = p[1] - q[0]/2;
}

/* ----------------------------------------------- pendulum of changing length */

static MAYBE real length_at(real t) { return 1 + sin(2*t)/4; }

static MAYBE int swing(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    real l = length_at(t);
    f[0] -= l*sin(q[0]);
    dldv[0] += l*l*v[0];
    return 0;
}

HESSIAN(swing_hessian)
{
    real l = length_at(t);
    fq[0] -= l*cos(q[0]);
    pv[0] += l*l;
    return 0;
}

static MAYBE real swing_lagrangian(real t, const real *q, const real *v)
{
    real l = length_at(t);
    return l*l*v[0]*v[0]/2 + l*cos(q[0]);
}

static MAYBE int swing_value(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->value[k] += swing_lagrangian(x->t[k], x->q + k, x->v + k);
    return 0;
}

static MAYBE void swing_velocity(real t, const real *q, const real *p, real *v)
{
    real l = length_at(t);
    v[0] = p[0]/(l*l);
}

/* ------------------------------------------------------------ uniform field */

static MAYBE int fall(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] -= 1.5L;
    return 0;
}

HESSIAN(fall_hessian) { return 0; }

static MAYBE int fall_value(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->value[k] += 1.5L*x->q[k];
    return 0;
}

static MAYBE real uniform_lagrangian(real t, const real *q, const real *v) { return v[0]*v[0]/2 - 1.5L*q[0]; }

/* ------------------------------------------------------------------- saddle */

static const MAYBE real both_signs[2] = { 1, -1 };

static MAYBE void saddle_kinetic(const real *q, const real *v, real *dq, real *dv)
{
    dv[0] += v[0];
    dv[1] -= v[1];
}

static MAYBE int hills(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    const real s = sin(q[0] + q[1]);
    f[0] -= s + q[0]*q[1]/2;
    f[1] -= s + q[0]*q[0]/4;
    return 0;
}

HESSIAN(hills_hessian)
{
    const real c = cos(q[0] + q[1]);
    fq[0] -= c + q[1]/2;
    fq[1] -= c + q[0]/2;
    fq[2] -= c + q[0]/2;
    fq[3] -= c;
    return 0;
}

static MAYBE real hills_at(const real a, const real b) { return a*a*b/4 - cos(a + b); }

static MAYBE int hills_value(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->value[k] += hills_at(x->q[k], x->q[x->stride + k]);
    return 0;
}

static MAYBE real saddle_lagrangian(real t, const real *q, const real *v)
{
    return (v[0]*v[0] - v[1]*v[1])/2 - hills_at(q[0], q[1]);
}

static MAYBE void saddle_velocity(real t, const real *q, const real *p, real *v)
{
    v[0] = p[0];
    v[1] = -p[1];
}

/* -------------------------------------------------------------------- mixed */

static MAYBE int mixture(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    const real l = length_at(t), s = sin(q[0] - q[1]);
    f[0] += v[0]*v[1]/3 + s;
    f[1] += l*q[1]*v[0]*v[0]/3 + q[1]*v[0] - s;
    dldv[0] += l*(1 + q[1]*q[1]/3)*v[0] + v[0]*v[0]*v[0]/6 + q[0]*v[1]/3 + q[1]*q[1]/2;
    dldv[1] += q[0]*v[0]/3 - v[1];
    return 0;
}

HESSIAN(mixture_hessian)
{
    const real l = length_at(t), c = cos(q[0] - q[1]);
    fq[0] += c;
    fq[1] -= c;
    fq[2] -= c;
    fq[3] += l*v[0]*v[0]/3 + v[0] + c;
    fv[0] += v[1]/3;
    fv[1] += v[0]/3;
    fv[2] += 2*l*q[1]*v[0]/3 + q[1];
    pv[0] += l*(1 + q[1]*q[1]/3) + v[0]*v[0]/2;
    pv[1] += q[0]/3;
    pv[2] += q[0]/3;
    pv[3] -= 1;
    return 0;
}

static MAYBE real mixed_lagrangian(real t, const real *q, const real *v)
{
    const real vv = v[0]*v[0];
    return length_at(t)*(1 + q[1]*q[1]/3)*vv/2 + vv*vv/24 - v[1]*v[1]/2 + q[0]*v[0]*v[1]/3 + q[1]*q[1]*v[0]/2
         - cos(q[0] - q[1]);
}

static MAYBE int mixture_value(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        const real q[2] = { x->q[k], x->q[x->stride + k] }, v[2] = { x->v[k], x->v[x->stride + k] };
        x->value[k] += mixed_lagrangian(x->t[k], q, v);
    }
    return 0;
}

/* v2 eliminated, p is a cubic in v1 that grows: Newton's method from its linear part */
static MAYBE void mixed_velocity(real t, const real *q, const real *p, real *v)
{
    const real a = length_at(t)*(1 + q[1]*q[1]/3) + q[0]*q[0]/9, b = p[0] + q[0]*p[1]/3 - q[1]*q[1]/2;
    real x = b/a;
    for (int k = 0; k < 60; ++k) {
        const real change = (a*x + x*x*x/6 - b)/(a + x*x/2);
        x -= change;
        if (!(fabs(change) > UNIT*fabs(x))) break;
    }
    v[0] = x;
    v[1] = q[0]*x/3 - p[1];
}

/* ------------------------------------------------------------------- forces */

static MAYBE int drag(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] -= 0.2L*v[0];
    f[1] -= 0.2L*v[1];
    return 0;
}

HESSIAN(drag_hessian)
{
    fv[0] -= 0.2L;
    fv[3] -= 0.2L;
    return 0;
}

static MAYBE int air(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    real speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    f[0] -= 0.05L*speed*v[0];
    f[1] -= 0.05L*speed*v[1];
    return 0;
}

HESSIAN(air_hessian)
{
    real speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    if (!(speed > 0)) return 0;
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) fv[2*i + j] -= 0.05L*((i == j ? speed : 0) + v[i]*v[j]/speed);
    return 0;
}

static MAYBE int motor(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] += cos(3*t)*(1 - v[0]/4);
    f[1] -= 0.1L*v[1];
    return 0;
}

HESSIAN(motor_hessian)
{
    fv[0] -= cos(3*t)/4;
    fv[3] -= 0.1L;
    return 0;
}

static MAYBE int swirl(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] += 0.3L*q[1]*v[1] - 0.2L*v[0];
    f[1] += cos(3*t)/2 - 0.1L*(1 + q[0]*q[0])*v[1];
    return 0;
}

HESSIAN(swirl_hessian)
{
    fq[1] += 0.3L*v[1];
    fq[2] -= 0.2L*q[0]*v[1];
    fv[0] -= 0.2L;
    fv[1] += 0.3L*q[1];
    fv[3] -= 0.1L*(1 + q[0]*q[0]);
    return 0;
}

/* ---------------------------------------------------------------- the tables

   Several starts, so that no leading term of an error is small by accident   */

#define SPRING     { .kind = GVI_POTENTIAL, .point = spring, .value = spring_value, .hessian = spring_hessian }
#define ATTRACTION { .kind = GVI_POTENTIAL, .point = attraction_at, .value = attraction, .hessian = attraction_hessian }
#define WEIGHTS    { .kind = GVI_POTENTIAL, .point = weights, .value = weights_value, .hessian = weights_hessian }
#define TRAP       { .kind = GVI_POTENTIAL, .point = trap, .value = trap_value, .hessian = trap_hessian }
#define FIELD      { .kind = GVI_LAGRANGIAN, .point = field, .value = field_value, .hessian = field_hessian }
#define SWING      { .kind = GVI_LAGRANGIAN, .point = swing, .value = swing_value, .hessian = swing_hessian }
#define FALL       { .kind = GVI_POTENTIAL, .point = fall, .value = fall_value, .hessian = fall_hessian }
#define HILLS      { .kind = GVI_POTENTIAL, .point = hills, .value = hills_value, .hessian = hills_hessian }
#define MIXTURE    { .kind = GVI_LAGRANGIAN, .point = mixture, .value = mixture_value, .hessian = mixture_hessian }
#define FORCE(f)   { .kind = GVI_FORCE, .point = f, .hessian = f##_hessian }
#define PENDULUM_MASS { GVI_MASS_POSITION, NULL, pendulum_mass, pendulum_mass_gradient, NULL, NULL }

#define KEPLER_STARTS   { { 0.7L, 0 }, { 0.2L, 0.8L }, { -0.9L, 0.1L } }, \
                        { { 0.1L, 1.3L }, { -1.1L, 0.2L }, { 0.1L, -1 } }, 2
#define PENDULUM_START_STATES { { 0.7L, -0.4L }, { -0.3L, 1.1L }, { 0.2L, 0.5L } }, \
                              { { 0.5L, 0.9L }, { 0.8L, -0.2L }, { -0.6L, 0.4L } }
#define PENDULUM_STARTS PENDULUM_START_STATES, 2
#define MAGNETIC_STARTS { { 0.7L, -0.4L }, { -0.3L, 0.8L }, { 0.2L, 0.5L } }, \
                        { { 0.5L, 0.9L }, { 0.8L, -0.2L }, { -0.6L, 0.8L } }, 2

#define MIXED_STARTS { { 0.4L, -0.3L }, { -0.5L, 0.6L }, { 0.7L, 0.2L } }, \
                     { { 0.6L, 0.5L }, { 0.4L, -0.7L }, { -0.5L, 0.3L } }, 2

static const MAYBE problem oscillator = {
    "oscillator", 1, { .kind = GVI_MASS_UNIT }, { SPRING }, 1, 0,
    oscillator_lagrangian, unit_1, momentum_is_velocity_1,
    { { 0.7L }, { -0.4L }, { 1.1L } }, { { 0.5L }, { 1 }, { -0.2L } }, 2
};

static const MAYBE problem uniform_field = {
    "uniform field", 1, { .kind = GVI_MASS_UNIT }, { FALL }, 1, 0,
    uniform_lagrangian, unit_1, momentum_is_velocity_1,
    { { 0.7L }, { -0.4L }, { 1.1L } }, { { 0.5L }, { 1 }, { -0.2L } }, 2
};

enum { PROBLEMS = 6, FORCED = 4 };

static const MAYBE problem problems[PROBLEMS] = {
    { "Kepler", 2, { .kind = GVI_MASS_UNIT }, { ATTRACTION }, 1, 0,
      kepler_lagrangian, unit_2, momentum_is_velocity_2, KEPLER_STARTS },
    { "double pendulum", 2, PENDULUM_MASS, { WEIGHTS }, 1, 0,
      pendulum_lagrangian, pendulum_kinetic, pendulum_velocity, PENDULUM_STARTS },
    { "magnetic", 2, { .kind = GVI_MASS_UNIT }, { TRAP, FIELD }, 2, 0,
      magnetic_lagrangian, unit_2, magnetic_velocity, MAGNETIC_STARTS },
    { "changing length", 1, { .kind = GVI_MASS_NONE }, { SWING }, 1, 0,
      swing_lagrangian, no_kinetic, swing_velocity,
      { { 0.7L }, { -1.2L }, { 0.3L } }, { { 0.5L }, { 0.9L }, { -1.6L } }, 2 },
    { "saddle", 2, { .kind = GVI_MASS_DIAGONAL, .matrix = both_signs }, { HILLS }, 1, 0,
      saddle_lagrangian, saddle_kinetic, saddle_velocity, MIXED_STARTS },
    { "mixed", 2, { .kind = GVI_MASS_NONE }, { MIXTURE }, 1, 0,
      mixed_lagrangian, no_kinetic, mixed_velocity, MIXED_STARTS },
};

static const MAYBE problem forced_problems[FORCED] = {
    { "magnetic, drag", 2, { .kind = GVI_MASS_UNIT }, { TRAP, FIELD, FORCE(drag) }, 3, 1,
      magnetic_lagrangian, unit_2, magnetic_velocity, MAGNETIC_STARTS },
    { "Kepler, air", 2, { .kind = GVI_MASS_UNIT }, { ATTRACTION, FORCE(air) }, 2, 1,
      kepler_lagrangian, unit_2, momentum_is_velocity_2, KEPLER_STARTS },
    { "pendulum, motor", 2, PENDULUM_MASS, { WEIGHTS, FORCE(motor) }, 2, 1,
      pendulum_lagrangian, pendulum_kinetic, pendulum_velocity, PENDULUM_STARTS },
    { "mixed, swirl", 2, { .kind = GVI_MASS_NONE }, { MIXTURE, FORCE(swirl) }, 2, 1,
      mixed_lagrangian, no_kinetic, mixed_velocity, MIXED_STARTS },
};

#endif
