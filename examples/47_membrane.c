/* 47 - A drum of 1,024 knots: many coordinates under one law

   A square membrane, clamped at its edge, is a grid of knots, each pulled towards its four neighbours.
   GVI_ROWS runs one line of C over the rows of many knots, and compilers make vectors of it: of the points of
   a step where it has several, of the knots where it has one, as Stoermer-Verlet and other kicks have. So the
   callback is written once, and the method is chosen afterwards.

   The grid has standing waves in closed form, sin(a x) sin(b y) cos(omega t) with omega^2 = 4 sin^2(a/2) +
   4 sin^2(b/2) for knots at a distance of 1. It starts as one of them, and is flat after two periods and a quarter.

   prints

     Stoermer-Verlet   80 steps  about  100 evaluations, error 2e-02
     Stoermer-Verlet  800 steps  about  800 evaluations, error 2e-04
     Gauss, degree 4   40 steps  about 2200 evaluations, error 1e-10
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { SIDE = 32, KNOTS = SIDE*SIDE };

/* Each knot is pulled by 1 a length towards the places of its neighbours; beyond the edge that is 0.   */
static int membrane(const gvi_points *x, void *user)
{
    const double *q = x->q;
    double *f = x->f;
    const int d = x->stride, line = SIDE*d;

    GVI_ROWS(x, 0, KNOTS, j, f[j] -= 4*q[j];)
    GVI_ROWS(x, SIDE, KNOTS, j, f[j] += q[j - line];)
    GVI_ROWS(x, 0, KNOTS - SIDE, j, f[j] += q[j + line];)
    for (int i = 0; i < KNOTS; i += SIDE) {
        GVI_ROWS(x, i + 1, i + SIDE, j, f[j] += q[j - d];)
        GVI_ROWS(x, i, i + SIDE - 1, j, f[j] += q[j + d];)
    }
    return (void)user, 0;
}

/* Two periods and a quarter of the wave of 2 by 3 bellies, which should be flat then, in `steps` steps        */
static int swing(const char *name, gvi_desc desc, int steps)
{
    static double at_rest[KNOTS], shape[KNOTS];
    const double along = acos(-1)/(SIDE + 1), omega = 2*hypot(sin(2*along/2), sin(3*along/2));
    for (int i = 0; i < KNOTS; ++i) shape[i] = sin(2*along*(i/SIDE + 1))*sin(3*along*(i%SIDE + 1));

    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = membrane } };
    desc.n = KNOTS, desc.effects = scene, desc.effect_count = 1;
    double *memory = malloc(gvi_size(&desc)), error = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, gvi_size(&desc));
    gvi_start(&st, 0, shape, at_rest);
    gvi_steps(&st, 4.5*acos(-1)/omega/steps, steps);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;

    for (int i = 0; i < KNOTS; ++i) error = fmax(error, fabs(st.q[i]));
    const double hundreds = floor((double)st.counters.effect[0]/100 + 0.5);
    printf("%-15s  %3d steps  about %4.0f evaluations, error %.0e\n", name, steps, 100*hundreds, error);
    free(memory);
    return 0;
}

int main(void)
{
    const gvi_desc verlet = { .degree = 1, .rule = { .kind = GVI_LOBATTO }, .formulation = GVI_EXPLICIT },
                   gauss = { .degree = 4, .formulation = GVI_POSITIONS };
    return swing("Stoermer-Verlet", verlet, 80) || swing("Stoermer-Verlet", verlet, 800)
        || swing("Gauss, degree 4", gauss, 40);
}
