/* embedded_scenes.h - the five scenes of embedded.c: callbacks for gvi.h, and the same equations as
   right-hand sides for steps written by hand.  `real` is gvi_real.  Sines are polynomials of this file,
   so that a computer and a small processor give the same bits.                                  */
#ifndef EMBEDDED_SCENES_H
#define EMBEDDED_SCENES_H

#include <math.h>

typedef gvi_real real;
#define R(x) ((real)(x))
#if GVI__KIND == 1
#define ROOT(x) sqrtf(x)
#else
#define ROOT(x) sqrt(x)
#endif
#define INLINE static inline __attribute__((always_inline))

/* sin and cos of y, |y| <= pi/4, z = y^2: Taylor's series, the rest below half a unit of the last place */
#if GVI__KIND == 1
#define SINE(y, z)   ((y)*(1 + (z)*(R(-1/6.0) + (z)*(R(1/120.0) + (z)*(R(-1/5040.0) + (z)*R(1/362880.0))))))
#define COSINE(y, z) (1 + (z)*(R(-1/2.0) + (z)*(R(1/24.0) + (z)*(R(-1/720.0) + (z)*R(1/40320.0)))))
#else
#define SINE(y, z)                                                                                \
    ((y)*(1 + (z)*(R(-1/6.0) + (z)*(R(1/120.0) + (z)*(R(-1/5040.0) + (z)*(R(1/362880.0)           \
     + (z)*(R(-1/39916800.0) + (z)*(R(1/6227020800.0) + (z)*(R(-1/1307674368000.0)                \
     + (z)*R(1/355687428096000.0))))))))))
#define COSINE(y, z)                                                                              \
    (1 + (z)*(R(-1/2.0) + (z)*(R(1/24.0) + (z)*(R(-1/720.0) + (z)*(R(1/40320.0)                   \
     + (z)*(R(-1/3628800.0) + (z)*(R(1/479001600.0) + (z)*(R(-1/87178291200.0)                    \
     + (z)*R(1/20922789888000.0)))))))))
#endif

/* Both for |x| < 200: quarter turns are taken off exactly, pi/2 being a number of 8 bits and a rest */
INLINE void sines(real x, real *sine, real *cosine)
{
    const int turns = (int)(x*R(0.6366197723675814) + (x < 0 ? R(-0.5) : R(0.5)));
    const real y = (x - (real)turns*R(1.5703125)) - (real)turns*R(4.838267948966192e-4), z = y*y;
    const real s = SINE(y, z), c = COSINE(y, z), a = turns & 1 ? c : s, b = turns & 1 ? s : c;
    *sine = turns & 2 ? -a : a;
    *cosine = (turns + 1) & 2 ? -b : b;
}

/* What a controller sets once a step, and what friction takes                                   */
typedef struct motor { real torque[2]; } motor;

/* -------------------------------------------------------------- pendulum, 1 m */

#define WEIGHT 9.81

static int pendulum_weight(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        real s, c;
        sines(x->q[k], &s, &c);
        x->f[k] -= R(WEIGHT)*s;
    }
    return (void)user, 0;
}

INLINE void pendulum_rates(const motor *m, const real *y, real *dy)
{
    real s, c;
    sines(y[0], &s, &c);
    dy[0] = y[1];
    dy[1] = -R(WEIGHT)*s;
    (void)m;
}

/* The same with a motor that is set once a step, and friction                                   */
#define DAMPING 0.1

static int pendulum_motor(const gvi_points *x, void *user)
{
    const motor *m = user;
    for (int k = 0; k < x->count; ++k) x->f[k] += m->torque[0] - R(DAMPING)*x->v[k];
    return 0;
}

INLINE void motor_rates(const motor *m, const real *y, real *dy)
{
    pendulum_rates(m, y, dy);
    dy[1] += m->torque[0] - R(DAMPING)*y[1];
}

/* ---------------------------------------------------------------------- orbit */

static int attraction(const gvi_points *x, void *user)
{
    const real *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real d2 = X[k]*X[k] + Y[k]*Y[k], w = -1/(d2*ROOT(d2));
        x->f[k] += w*X[k];
        x->f[x->stride + k] += w*Y[k];
    }
    return (void)user, 0;
}

INLINE void orbit_rates(const motor *m, const real *y, real *dy)
{
    const real d2 = y[0]*y[0] + y[1]*y[1], w = -1/(d2*ROOT(d2));
    dy[0] = y[2];
    dy[1] = y[3];
    dy[2] = w*y[0];
    dy[3] = w*y[1];
    (void)m;
}

/* -------------------------- arm: 1.2 kg and 0.8 kg at the ends of 0.4 m and 0.3 m */

#define ARM_FAR   (0.8*0.3*0.3)
#define ARM_MID   (0.8*0.4*0.3)
#define ARM_NEAR  ((1.2 + 0.8)*0.4*0.4)
#define ARM_UPPER ((1.2 + 0.8)*9.81*0.4)
#define ARM_LOWER (0.8*9.81*0.3)
#define ARM_DAMPING 0.05

/* The sines of one call, for the gradient, which comes right after at the same q                */
static real elbow[8];

static int arm_mass(const gvi_points *x, void *user)
{
    const real *b = x->q + x->stride;
    for (int k = 0; k < x->count; ++k) {
        real c;
        sines(b[k], elbow + k, &c);
        x->mass[k] = R(ARM_NEAR + ARM_FAR) + 2*R(ARM_MID)*c;
        x->mass[2*x->stride + k] = R(ARM_FAR) + R(ARM_MID)*c;
        x->mass[3*x->stride + k] = R(ARM_FAR);
    }
    return (void)user, 0;
}

static int arm_gradient(const gvi_points *x, void *user)
{
    const real *u = x->v, *v = u + x->stride;
    for (int k = 0; k < x->count; ++k) x->f[x->stride + k] -= R(ARM_MID)*elbow[k]*u[k]*(u[k] + v[k]);
    return (void)user, 0;
}

static int arm_velocity(const gvi_points *x, void *user)
{
    const real *b = x->q + x->stride, *p = x->p, *o = p + x->stride;
    for (int k = 0; k < x->count; ++k) {
        real c;
        sines(b[k], elbow + k, &c);
        const real one = R(ARM_NEAR + ARM_FAR) + 2*R(ARM_MID)*c, two = R(ARM_FAR) + R(ARM_MID)*c;
        const real over = 1/(one*R(ARM_FAR) - two*two);
        x->velocity[k] = (R(ARM_FAR)*p[k] - two*o[k])*over;
        x->velocity[x->stride + k] = (one*o[k] - two*p[k])*over;
    }
    return (void)user, 0;
}

static int arm_weight(const gvi_points *x, void *user)
{
    const real *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k) {
        real s, t, c;
        sines(a[k], &s, &c);
        sines(a[k] + b[k], &t, &c);
        x->f[k] -= R(ARM_UPPER)*s + R(ARM_LOWER)*t;
        x->f[x->stride + k] -= R(ARM_LOWER)*t;
    }
    return (void)user, 0;
}

static int arm_motors(const gvi_points *x, void *user)
{
    const motor *m = user;
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < x->count; ++k)
            x->f[i*x->stride + k] += m->torque[i] - R(ARM_DAMPING)*x->v[i*x->stride + k];
    return 0;
}

/* M(q) v' = F: by Cramer's rule                                                                 */
INLINE void arm_solve(const real *y, real f, real g, real *dy)
{
    real s, c;
    sines(y[1], &s, &c);
    const real one = R(ARM_NEAR + ARM_FAR) + 2*R(ARM_MID)*c, two = R(ARM_FAR) + R(ARM_MID)*c;
    const real u = y[2], w = y[3], pull = R(ARM_MID)*s;
    const real a = f + pull*w*(2*u + w), b = g - pull*u*u, over = 1/(one*R(ARM_FAR) - two*two);
    dy[0] = u;
    dy[1] = w;
    dy[2] = (R(ARM_FAR)*a - two*b)*over;
    dy[3] = (one*b - two*a)*over;
}

INLINE void arm_rates(const motor *m, const real *y, real *dy)
{
    real s, t, c;
    sines(y[0], &s, &c);
    sines(y[0] + y[1], &t, &c);
    arm_solve(y, -R(ARM_UPPER)*s - R(ARM_LOWER)*t, -R(ARM_LOWER)*t, dy);
    (void)m;
}

INLINE void driven_arm_rates(const motor *m, const real *y, real *dy)
{
    real s, t, c;
    sines(y[0], &s, &c);
    sines(y[0] + y[1], &t, &c);
    arm_solve(y, m->torque[0] - R(ARM_DAMPING)*y[2] - R(ARM_UPPER)*s - R(ARM_LOWER)*t,
              m->torque[1] - R(ARM_DAMPING)*y[3] - R(ARM_LOWER)*t, dy);
}

/* ------------------------------------------------------------- steps by hand */

typedef struct by_hand { real y[4], rest[4], force[4]; } by_hand;
typedef void rates_fn(const motor *m, const real *y, real *dy);

/* y + sum, and with its rounding carried on (Kahan 1965)                                        */
INLINE void advance(by_hand *s, int i, real sum, int compensated)
{
    if (compensated) {
        const real d = sum + s->rest[i], next = s->y[i] + d;
        s->rest[i] = d - (next - s->y[i]);
        s->y[i] = next;
    } else s->y[i] += sum;
}

INLINE void rk4(rates_fn *f, int m, const motor *drive, by_hand *s, real h, int compensated)
{
    real a[4], b[4], c[4], d[4], z[4];
    f(drive, s->y, a);
    for (int i = 0; i < m; ++i) z[i] = s->y[i] + h/2*a[i];
    f(drive, z, b);
    for (int i = 0; i < m; ++i) z[i] = s->y[i] + h/2*b[i];
    f(drive, z, c);
    for (int i = 0; i < m; ++i) z[i] = s->y[i] + h*c[i];
    f(drive, z, d);
    for (int i = 0; i < m; ++i) advance(s, i, h/6*(a[i] + 2*(b[i] + c[i]) + d[i]), compensated);
}

/* Stoermer-Verlet, M = 1: the force at the end is kept for the next step                        */
INLINE void verlet(rates_fn *f, int n, const motor *drive, by_hand *s, real h, int compensated)
{
    real dy[4];
    for (int i = 0; i < n; ++i) advance(s, n + i, h/2*s->force[i], compensated);
    for (int i = 0; i < n; ++i) advance(s, i, h*s->y[n + i], compensated);
    f(drive, s->y, dy);
    for (int i = 0; i < n; ++i) s->force[i] = dy[n + i];
    for (int i = 0; i < n; ++i) advance(s, n + i, h/2*s->force[i], compensated);
}

/* As written out for one scene: the compiler sees right-hand side and length                    */
#define STEPS_BY_HAND(name, rates, m)                                                             \
    static void name##_rk4(const motor *d, by_hand *s, real h) { rk4(rates, m, d, s, h, 0); }       \
    static void name##_rk4_carried(const motor *d, by_hand *s, real h) { rk4(rates, m, d, s, h, 1); }
#define VERLET_BY_HAND(name, rates, n)                                                            \
    static void name##_verlet(const motor *d, by_hand *s, real h) { verlet(rates, n, d, s, h, 0); } \
    static void name##_verlet_carried(const motor *d, by_hand *s, real h) { verlet(rates, n, d, s, h, 1); }

STEPS_BY_HAND(pendulum, pendulum_rates, 2)
STEPS_BY_HAND(motor, motor_rates, 2)
STEPS_BY_HAND(orbit, orbit_rates, 4)
STEPS_BY_HAND(arm, arm_rates, 4)
STEPS_BY_HAND(driven_arm, driven_arm_rates, 4)
VERLET_BY_HAND(pendulum, pendulum_rates, 1)
VERLET_BY_HAND(orbit, orbit_rates, 2)

/* -------------------------------------------------------------------- scenes */

typedef void hand_fn(const motor *drive, by_hand *s, real h);

typedef struct scene {
    const char     *name, *title;
    int             n;
    real            h;                      /* of the tables                                   */
    gvi_formulation fixed;                  /* the fixed point that covers it                  */
    gvi_mass        mass;
    const gvi_effect *effects;
    int             effect_count;
    real            q[2], v[2];
    real            torque[2], turn;        /* torque sin(turn t), set once a step             */
    hand_fn        *rk4, *rk4_carried, *verlet, *verlet_carried;
} scene;

static motor drive;
static const gvi_effect pendulum_effects[] = { { .kind = GVI_POTENTIAL, .points = pendulum_weight } };
static const gvi_effect motor_effects[] = {
    { .kind = GVI_POTENTIAL, .points = pendulum_weight },
    { .kind = GVI_FORCE, .points = pendulum_motor, .user = &drive } };
static const gvi_effect orbit_effects[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
static const gvi_effect arm_effects[] = {
    { .kind = GVI_POTENTIAL, .points = arm_weight },
    { .kind = GVI_FORCE, .points = arm_motors, .user = &drive } };

#define ARM_MASS { .kind = GVI_MASS_POSITION, .points = arm_mass, .gradient = arm_gradient }
enum { PENDULUM, MOTOR, ORBIT, ARM, DRIVEN_ARM, SCENES };

static const scene scenes[SCENES] = {
    { "pendulum", "pendulum of 1 m, from 1 rad; h = 20 ms", 1, R(0.02), GVI_POSITIONS, { 0 },
      pendulum_effects, 1, { 1 }, { 0 }, { 0 }, 0,
      pendulum_rk4, pendulum_rk4_carried, pendulum_verlet, pendulum_verlet_carried },
    { "motor", "pendulum with friction and a motor set once a step; h = 20 ms", 1, R(0.02),
      GVI_VELOCITIES, { 0 }, motor_effects, 2, { 1 }, { 0 }, { 1 }, R(1.5),
      motor_rk4, motor_rk4_carried, NULL, NULL },
    { "orbit", "orbit of eccentricity 0.3; h = 1/16, 100.5 steps a revolution", 2, R(0.0625),
      GVI_POSITIONS, { 0 }, orbit_effects, 1, { R(0.7), 0 }, { 0, R(1.362770287738494) }, { 0 }, 0,
      orbit_rk4, orbit_rk4_carried, orbit_verlet, orbit_verlet_carried },
    { "arm", "arm of two links, M(q), no friction; h = 10 ms", 2, R(0.01), GVI_MOMENTA, ARM_MASS,
      arm_effects, 1, { R(0.5), R(0.3) }, { 0, 0 }, { 0 }, 0, arm_rk4, arm_rk4_carried, NULL, NULL },
    { "driven arm", "arm with friction, torques set once a step; h = 10 ms", 2, R(0.01),
      GVI_MOMENTA, ARM_MASS, arm_effects, 2, { R(0.5), R(0.3) }, { 0, 0 }, { 2, R(0.5) }, 3,
      driven_arm_rk4, driven_arm_rk4_carried, NULL, NULL },
};

#endif
