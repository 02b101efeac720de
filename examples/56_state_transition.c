/* 56 - And if the satellite starts a little elsewhere? The state-transition matrix with J2

   Orbit determination, manoeuvres and covariances need the derivatives of the end by the start, the
   matrix Phi = d(q1, p1)/d(q0, p0), which solves the variational equations. tools/tangent.h steps
   it along with the orbit, and tools/effects_tangent.h has the derivatives of gravity and of J2,
   the flattening of the planet, so there is nothing to derive. Further columns are the derivatives
   by gm and by J2 themselves. The unit of length is the planet's radius; gm and the mass are 1, so
   p is the velocity.

   The motion is symplectic, and so is the matrix of a step, and of many: Phi' J Phi = J. With
   atmosphere(&air) as a third effect all else holds, but that.

   prints

     all 36 entries are those of differences of orbits, to 1e-9: yes
     so are the derivatives by gm and J2: yes
     Phi' J Phi = J, to rounding: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/effects_tangent.h"
#include <float.h>
#include <math.h>
#include <stdio.h>

enum { STEPS = 20, COLUMNS = 8 };                        // six directions, gm and J2

static struct central_gravity earth = { .on = { 0, 1, 3 }, .mass = (double[]){ 1 }, .gm = 1 };
static struct oblateness bulge = { { 0, 1, 3 }, (double[]){ 1 }, 1, 1, 1.08262668e-3 };
static const double h = 0.36, start[6] = { 1.1, 0, 0, 0, 0.7, 0.7 };

/* A revolution from (q, p), and with phi its derivatives: phi[j] is column j.   */
static gvi_status orbit(const double *from, double *end, double (*phi)[6])
{
    static double memory[GVI_LENGTH(TANGENT_N(3, COLUMNS), 8, 8)], room[TANGENT_ROOM(3, COLUMNS)];
    const gvi_effect scene[] = { central_gravity(&earth), oblateness(&bulge) };
    tangent T = { .plain = { .n = 3, .effects = scene, .effect_count = 2 }, .product = EFFECTS_TANGENT_ORBIT,
                  .directions = 6, .parameters = 2, .room = room, .room_length = TANGENT_ROOM(3, COLUMNS) };
    gvi_stepper st;
    if (tangent_scene(&T)) return GVI_E_ARGUMENT;

    gvi_init(&st, phi ? &T.desc : &T.plain, memory, sizeof memory);
    if (phi) tangent_start(&T, &st, 0, from, from + 3, NULL, NULL);
    else gvi_start_momentum(&st, 0, from, from + 3);
    for (int k = 0; k < STEPS && st.status == GVI_OK; ++k) gvi_step(&st, h);

    for (int i = 0; i < 3; ++i) end[i] = st.q[i], end[3 + i] = st.p[i];
    for (int j = 0; phi && j < COLUMNS; ++j) tangent_column(&T, &st, j, phi[j], phi[j] + 3);
    return st.status;
}

/* How far a column is from differences of four orbits, over its largest entry.  `at` is what moves. */
static double off(double *at, const double *from, const double *column)
{
    const double middle = *at, d = 1e-4;
    double end[5][6], worst = 0, largest = 0;
    for (int k = 0; k < 5; ++k) {
        *at = middle + (k - 2)*d;
        if (orbit(from, end[k], NULL)) return HUGE_VAL;
    }
    *at = middle;

    for (int i = 0; i < 6; ++i) {
        const double slope = (8*(end[3][i] - end[1][i]) - (end[4][i] - end[0][i]))/(12*d);
        worst = fmax(worst, fabs(slope - column[i]));
        largest = fmax(largest, fabs(column[i]));
    }
    return worst/largest;
}

int main(void)
{
    double from[6], end[6], phi[COLUMNS][6], worst = 0, twist = 0;
    for (int i = 0; i < 6; ++i) from[i] = start[i];
    if (orbit(from, end, phi)) return puts("no orbit"), 1;

    for (int j = 0; j < 6; ++j) worst = fmax(worst, off(&from[j], from, phi[j]));
    printf("all 36 entries are those of differences of orbits, to 1e-9: %s\n", worst < 1e-9 ? "yes" : "no");
    printf("so are the derivatives by gm and J2: %s\n",
           off(&earth.gm, from, phi[6]) < 1e-9 && off(&bulge.j2, from, phi[7]) < 1e-9 ? "yes" : "no");

    // Rounding: eps of the terms, in each of the steps.
    for (int a = 0; a < 6; ++a)
        for (int b = 0; b < 6; ++b) {
            double z = (a == b + 3) - (b == a + 3), size = 1;
            for (int i = 0; i < 3; ++i) {
                z += phi[a][i]*phi[b][3 + i] - phi[a][3 + i]*phi[b][i];
                size += fabs(phi[a][i]*phi[b][3 + i]) + fabs(phi[a][3 + i]*phi[b][i]);
            }
            twist = fmax(twist, fabs(z)/size);
        }
    printf("Phi' J Phi = J, to rounding: %s\n", twist < STEPS*DBL_EPSILON ? "yes" : "no");
    return 0;
}
