/* 25 - A ring of six tetrahedra that turns through itself: a linkage with one constraint too many

   Bricard's trihedral linkage: six hinges, each at right angles to the next; neighbours are the
   opposite edges of a tetrahedron. Twelve points at the ends of the hinges and all 30 edges as rods:
   36 - 30 leaves 6 ways to move, those of a rigid body. But the ring moves: one of the rows depends on the
   others, wherever it is. That row is left out by the library, its multiplier is 0.

   Masses of 1 at the points; springs between opposite hinges, stretched at the start, drive it.

   prints

     30 rods, of which 1 without a part to play
     the inner end of the first hinge goes from -0.829 to 0.252 in height
     energy to 1e-13: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

enum { HINGES = 6, POINTS = 12, N = 3*POINTS, ROWS = 30, DEGREE = 6 };
static int from[ROWS], to[ROWS];                  /* the ends of each rod */
static double square[ROWS];                       /* and its length, squared */

static int rods(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int a = 0; a < ROWS; ++a)
        for (int k = 0; k < x->count; ++k) {
            double sum = -square[a];
            for (int i = 0; i < 3; ++i) {
                const double d = x->q[(3*from[a] + i)*R + k] - x->q[(3*to[a] + i)*R + k];
                x->jacobian[(a*N + 3*from[a] + i)*R + k] = d;
                x->jacobian[(a*N + 3*to[a] + i)*R + k] = -d;
                sum += d*d;
            }
            x->g[a*R + k] = sum/2;
        }
    return (void)user, 0;
}

/* a spring of no length at rest between the upper ends of hinges 1, 3 and 5 */
static int springs(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < x->count; ++k) {
                const int p = (12*a + 6 + 3 + i)*R + k, q = (12*((a + 1)%3) + 6 + 3 + i)*R + k;
                const double d = x->q[p] - x->q[q];
                if (x->f) x->f[p] -= d/4, x->f[q] += d/4;
                if (x->value) x->value[k] += d*d/8;
            }
    return (void)user, 0;
}

int main(void)
{
    static double memory[GVI_CONSTRAINED_LENGTH(N, DEGREE, DEGREE, ROWS)], q[N], v[N], lambda[ROWS];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .value = springs },
                                 { .kind = GVI_CONSTRAINT, .points = rods, .rows = ROWS } };
    const gvi_desc desc = { .n = N, .degree = DEGREE, .effects = scene, .effect_count = 2 };
    const double pi = acos(-1.0);
    gvi_stepper st;
    double E0, E, worst = 0, least = 1e9, most = 0;
    int rows = 0, without = 0;
    for (int p = 0; p < POINTS; ++p) {            /* hinges along the radius at 1, across it at 2 */
        const int hinge = p/2, sign = p%2 ? 1 : -1;
        const double r = hinge%2 ? 2 : 1 + 0.5*sign;
        q[3*p] = r*cos(pi/3*hinge);
        q[3*p + 1] = r*sin(pi/3*hinge);
        q[3*p + 2] = hinge%2 ? 0.5*sign : 0;
    }
    for (int p = 0; p < POINTS; ++p)              /* its own hinge, and the two ends of the next one */
        for (int k = p%2; k < 3; ++k) {
            from[rows] = p;
            to[rows++] = (p - p%2 + (k == 0 ? 1 : k + 1))%POINTS;
        }
    for (int a = 0; a < ROWS; ++a)
        for (int i = 0; i < 3; ++i) square[a] += pow(q[3*from[a] + i] - q[3*to[a] + i], 2);
    if (gvi_init(&st, &desc, memory, sizeof memory) != GVI_OK || gvi_start(&st, 0, q, v) != GVI_OK)
        return printf("%s\n", gvi_status_text(st.status)), 1;
    gvi_energy(&st, &E0);
    for (int k = 0; k < 500; ++k) {
        if (gvi_step(&st, 0.02) != GVI_OK) return printf("%s\n", gvi_status_text(st.status)), 1;
        gvi_energy(&st, &E);
        worst = fmax(worst, fabs(E - E0)/E0);
        least = fmin(least, st.q[2]);
        most = fmax(most, st.q[2]);
    }
    if (gvi_multipliers(&st, lambda) != GVI_OK) return 1;
    for (int a = 0; a < ROWS; ++a) without += !(fabs(lambda[a]) > 0);
    printf("%d rods, of which %d without a part to play\n", rows, without);
    printf("the inner end of the first hinge goes from %.3f to %.3f in height\n", least, most);
    printf("energy to 1e-13: %s\n", worst < 1e-13 ? "yes" : "no");
    return 0;
}
