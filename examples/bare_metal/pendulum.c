/* A driven, damped pendulum on a microcontroller: no operating system, no heap, no
   stdio, every step of 1/128 s with the same number of iterations.  Three rows of
   effects[] are the physics; the library is compiled for them alone.  The constants
   are exact in float, so that every GVI_REAL computes the same pendulum.

   Prints time, angle and momentum (of unit mass: angular velocity) once a second,
   each as bits and as decimals.                                                 */
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#define GVI_CORE
#define GVI_EFFECTS 3
#include "gvi.h"
#include "board.h"
#include "print.h"
#include "sine.h"

static const gvi_real stiffness = 39.25, damping = 1.5, strength = 12, rate = 4;

static int weight(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= stiffness*sine(x->q[k]);
    return (void)user, 0;
}

static int friction(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= damping*x->v[k];
    return (void)user, 0;
}

static int drive(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] += strength*cosine(rate*x->t[k]);
    return (void)user, 0;
}

static void print_state(const gvi_stepper *st)
{
    print_real(st->t);
    print_real(st->q[0]);
    print_real(st->p[0]);
    board_print("\n");
}

int main(void)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight },
                                        { .kind = GVI_POTENTIAL, .points = drive },
                                        { .kind = GVI_FORCE, .points = friction } };
    static const gvi_desc desc = { .n = 1, .degree = 3, .effects = scene, .effect_count = 3,
                                   .formulation = GVI_VELOCITIES, .iterations = 3 };
    static gvi_real memory[GVI_LENGTH(1, 3, 3)];
    static gvi_stepper st;
    static const gvi_real angle[1] = { 1 }, rest[1] = { 0 };
    const gvi_real h = 1/(gvi_real)128;

    gvi_init(&st, &desc, memory, sizeof memory);
    if (gvi_start(&st, 0, angle, rest) != GVI_OK) return print_failure(st.status);
    print_state(&st);
    for (int k = 1; k <= 20*128; ++k) {
        if (gvi_step(&st, h) != GVI_OK) return print_failure(st.status);
        if (k%128 == 0) print_state(&st);
    }
    return 0;
}
