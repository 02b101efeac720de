/* A robot arm as two rods in Cartesian coordinates on a microcontroller: the mass is a
   constant, the weight a constant force, and what holds the joints together two constraints.
   A motor turns the shoulder, air brakes; steps of 1/128 s, each iterated to rounding.
   What the bearings feel comes from gvi_multipliers.

   Prints time, both coordinates of elbow and hand and the multipliers of the rods eight
   times a second, each as bits and as decimals.                                  */
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#define GVI_NO_RULES            /* of all chapters constraints alone are wanted */
#define GVI_NO_LAGRANGIAN
#define GVI_NO_MOMENTA          /* and the clock with it */
#define GVI_NO_KICKS
#define GVI_NO_NEWTON
#define GVI_NO_DIAL
#define GVI_NO_EXPLAIN
#define GVI_NO_TEXTS
#define GVI_EFFECTS 4
#include "gvi.h"
#include "board.h"
#include "print.h"

static const gvi_real mass[4] = { 1, 1, 0.5, 0.5 };           /* kg: elbow x, y, hand x, y */
static const gvi_real upper = 0.5, lower = 0.25, gravity = 9.8125, damping = 0.5;

static int weight(const gvi_points *x, void *user)
{
    for (int i = 1; i < 4; i += 2)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= mass[i]*gravity;
    return (void)user, 0;
}

static int air(const gvi_points *x, void *user)
{
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= damping*x->v[i*x->stride + k];
    return (void)user, 0;
}

/* A torque about the pivot is a force across the upper rod, torque (-y, x)/upper^2. */
static int shoulder(const gvi_points *x, void *user)
{
    const gvi_real push = *(const gvi_real *)user/(upper*upper);
    for (int k = 0; k < x->count; ++k) {
        x->f[k] -= push*x->q[x->stride + k];
        x->f[x->stride + k] += push*x->q[k];
    }
    return 0;
}

static int rods(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real *q = x->q + k, X = q[0], Y = q[R], a = q[2*R] - X, b = q[3*R] - Y;
        gvi_real *first = x->jacobian + k, *second = first + 4*R;
        x->g[k] = (X*X + Y*Y - upper*upper)/2;
        x->g[R + k] = (a*a + b*b - lower*lower)/2;
        first[0] = X;
        first[R] = Y;
        second[0] = -a;
        second[R] = -b;
        second[2*R] = a;
        second[3*R] = b;
    }
    return (void)user, 0;
}

int main(void)
{
    static gvi_real torque;
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight },
                                        { .kind = GVI_FORCE, .points = air },
                                        { .kind = GVI_POTENTIAL, .points = shoulder, .user = &torque },
                                        { .kind = GVI_CONSTRAINT, .points = rods, .rows = 2 } };
    static const gvi_desc desc = { .n = 4, .degree = 2, .effects = scene, .effect_count = 4,
                                   .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass },
                                   .formulation = GVI_VELOCITIES };
    static gvi_real memory[GVI_CONSTRAINED_LENGTH(4, 2, 2, 2)];
    static const gvi_real hanging[4] = { 0, -0.5, 0, -0.75 }, rest[4] = { 0, 0, 0, 0 };
    static gvi_stepper st;
    const gvi_real h = 1/(gvi_real)128;

    gvi_init(&st, &desc, memory, sizeof memory);
    if (gvi_start(&st, 0, hanging, rest) != GVI_OK) return print_failure(st.status);
    for (int k = 0; k <= 2*128; ++k) {
        gvi_real lambda[2];
        torque = k/32 % 2 ? -8 : 8;               // N m, turned at the end of a step
        if (k > 0 && gvi_step(&st, h) != GVI_OK) return print_failure(st.status);
        if (k%16) continue;
        if (gvi_multipliers(&st, lambda) != GVI_OK) return print_failure(st.status);
        print_real(st.t);
        for (int i = 0; i < 4; ++i) print_real(st.q[i]);
        for (int a = 0; a < 2; ++a) print_real(lambda[a]);
        board_print("\n");
    }
    return 0;
}
