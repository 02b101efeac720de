/* A two-link robot arm in a real-time loop on a microcontroller: 128 periods a
   second, in each of them one output of a controller and one step of a fixed number
   of iterations, so the time that a period takes has a bound.  Motors and joint
   friction are rows of effects[]; the arm is its mass matrix M(q) and its weight.

   Prints time, both angles and both momenta eight times a second, each as bits and
   as decimals, then how many periods ended before their work was done.          */
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#define GVI_NO_RULES            /* of all chapters M(q) alone is wanted */
#define GVI_NO_LAGRANGIAN
#define GVI_NO_CLOCK
#define GVI_NO_KICKS
#define GVI_NO_NEWTON
#define GVI_NO_CONSTRAINTS
#define GVI_NO_DIAL
#define GVI_NO_EXPLAIN
#define GVI_NO_TEXTS
#define GVI_EFFECTS 3
#include "gvi.h"
#include "board.h"
#include "print.h"
#include "sine.h"

/* Links of 0.5 and 0.25 m with their masses of 1 and 0.5 kg at the ends:
   M_11 = inner + outer + 2 cross cos b, M_21 = outer + cross cos b, M_22 = outer.  */
static const gvi_real inner = 0.375, outer = 0.03125, cross = 0.0625;
static const gvi_real upper = 7.359375, lower = 1.2265625;      /* m g l, g = 9.8125 m/s^2 */

typedef struct motors { gvi_real torque[2], sum[2]; } motors;

static int arm_mass(const gvi_points *x, void *user)
{
    const gvi_real *b = x->q + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real turned = cross*cosine(b[k]);
        x->mass[k] = inner + outer + 2*turned;
        x->mass[2*x->stride + k] = outer + turned;
        x->mass[3*x->stride + k] = outer;
    }
    return (void)user, 0;
}

static int arm_gradient(const gvi_points *x, void *user)
{
    const gvi_real *b = x->q + x->stride, *u = x->v, *v = u + x->stride;
    for (int k = 0; k < x->count; ++k) x->f[x->stride + k] -= cross*sine(b[k])*u[k]*(u[k] + v[k]);
    return (void)user, 0;
}

static int arm_weight(const gvi_points *x, void *user)
{
    const gvi_real *a = x->q, *b = a + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real low = lower*sine(a[k] + b[k]);
        x->f[k] -= upper*sine(a[k]) + low;
        x->f[x->stride + k] -= low;
    }
    return (void)user, 0;
}

static int friction(const gvi_points *x, void *user)
{
    const gvi_real damping = 0.25;
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= damping*x->v[i*x->stride + k];
    return (void)user, 0;
}

static int drive(const gvi_points *x, void *user)
{
    const motors *m = user;
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] += m->torque[i];
    return 0;
}

/* Once a period: proportional, integral, differential.  Here a board reads its own torques. */
static void control(gvi_stepper *st, motors *m, gvi_real h)
{
    static const gvi_real target[2] = { 0.75, 1 }, kp[2] = { 40, 10 }, ki[2] = { 60, 15 }, kd[2] = { 6, 1 };
    gvi_real v[2] = { 0, 0 };
    gvi_velocity(st, v);
    for (int i = 0; i < 2; ++i) {
        const gvi_real error = target[i] - st->q[i];
        m->sum[i] += error*h;
        m->torque[i] = kp[i]*error + ki[i]*m->sum[i] - kd[i]*v[i];
    }
}

static void print_state(const gvi_stepper *st)
{
    print_real(st->t);
    for (int i = 0; i < 2; ++i) print_real(st->q[i]);
    for (int i = 0; i < 2; ++i) print_real(st->p[i]);
    board_print("\n");
}

int main(void)
{
    static motors m;
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = arm_weight },
                                        { .kind = GVI_FORCE, .points = friction },
                                        { .kind = GVI_FORCE, .points = drive, .user = &m } };
    static const gvi_desc desc = { .n = 2, .degree = 2, .effects = scene, .effect_count = 3,
                                   .mass = { .kind = GVI_MASS_POSITION, .points = arm_mass,
                                             .gradient = arm_gradient },
                                   .formulation = GVI_MOMENTA, .iterations = 4 };
    static gvi_real memory[GVI_LENGTH(2, 2, 2)];
    static const gvi_real rest[2] = { 0, 0 };
    static gvi_stepper st;
    const gvi_real h = 1/(gvi_real)128;
    unsigned missed = 0;

    gvi_init(&st, &desc, memory, sizeof memory);
    if (gvi_start(&st, 0, rest, rest) != GVI_OK) return print_failure(st.status);
    print_state(&st);
    board_every(128);
    for (int k = 1; k <= 2*128; ++k) {
        control(&st, &m, h);
        if (gvi_step(&st, h) != GVI_OK) return print_failure(st.status);
        missed += (unsigned)board_wait();
        if (k%16 == 0) print_state(&st);
    }
    board_print("periods missed: ");
    print_count(missed);
    board_print("\n");
    return 0;
}
