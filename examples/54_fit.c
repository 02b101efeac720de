/* 54 - Which J2, and how thick is the air? Parameters fitted to observations

   A satellite is seen twenty times in two revolutions. J is half the sum of the squared misses.
   One run forward and one back give its gradient by all parameters (lesson 33): each observation
   adds its miss to the costate when the run back passes it. Newton's method, with differences of
   that gradient for the second derivatives, makes the gradient 0. The unit of length is the
   planet's radius, and gm is 1; derivatives of the forces: tools/effects_tangent.h.

   prints

     J2 = 0.001082626680, c = 0.000100000000
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/adjoint.h"
#include "tools/effects_tangent.h"
#include <stdio.h>

enum { SEEN = 20 };
static struct central_gravity earth = { .on = { 0, 1, 3 }, .mass = (double[]){ 1 }, .gm = 1 };
static struct oblateness bulge = { { 0, 1, 3 }, (double[]){ 1 }, 1, 1, 1.08262668e-3 };
static struct atmosphere air = { { 0, 1, 3 }, 1e-4, 1.1, 0.05 };
static const double h = 0.75, start[] = { 1.1, 0, 0 }, velocity[] = { 0, 0.7, 0.7 };

/* Adds weight l.df/dtheta for both; the forces are linear in them.              */
static void by_both(double t, const double *q, const double *v, const double *l, const double *dl, double weight, int node,
                    double *gradient, void *user)
{
    double f[2][3], unused[2][9] = { { 0 } };
    oblateness_blocks(&bulge, 1, q, v, f[0], unused[0], unused[1]);
    atmosphere_blocks(&air, 1, q, v, f[1], unused[0], unused[1]);
    for (int i = 0; i < 3; ++i) gradient[0] += weight*l[i]*f[0][i]/bulge.j2, gradient[1] += weight*l[i]*f[1][i]/air.c;
    (void)t, (void)dl, (void)node, (void)user;
}

/* Sees the positions, or with g the gradient of J by j2 and c from those seen.   */
static gvi_status run(const double *theta, double (*seen)[3], double *g)
{
    static double memory[2][GVI_LENGTH(6, 8, 8)], room[ADJOINT_ROOM(3, 8)];
    const gvi_effect scene[] = { central_gravity(&earth), oblateness(&bulge), atmosphere(&air) };
    adjoint A = { .plain = { .n = 3, .effects = scene, .effect_count = 3 }, .product = EFFECTS_ADJOINT_ORBIT,
                  .by_parameters = by_both, .room = room, .room_length = ADJOINT_ROOM(3, 8) };
    double at[6], miss[SEEN][3], by[6] = { 0 };
    gvi_stepper st, ad;
    bulge.j2 = theta[0], air.c = theta[1];
    gvi_init(&st, &A.plain, memory[0], sizeof memory[0]);
    gvi_start(&st, 0, start, velocity);
    for (int k = 0; k < SEEN && !gvi_step(&st, h); ++k)
        for (int i = 0; i < 3; ++i) if (g) miss[k][i] = st.q[i] - seen[k][i]; else seen[k][i] = st.q[i];
    if (st.status || !g) return st.status;
    for (int i = 0; i < 3; ++i) at[i] = st.q[i], at[3 + i] = st.p[i];
    if (adjoint_scene(&A) || gvi_init(&ad, &A.scene.desc, memory[1], sizeof memory[1])) return GVI_E_ARGUMENT;
    g[0] = g[1] = 0;
    for (int k = SEEN - 1; k >= 0 && !ad.status; --k) {
        for (int i = 0; i < 3; ++i) by[i] += miss[k][i];
        adjoint_start(&A, &ad, (k + 1)*h, at, at + 3, by, by + 3);
        adjoint_step(&A, &ad, h, g);
        adjoint_gradient(&A, &ad, by, by + 3);
        for (int i = 0; i < 3; ++i) at[i] = ad.q[i], at[3 + i] = ad.p[i];
    }
    return ad.status;
}

int main(void)
{
    double seen[SEEN][3], theta[] = { 1.08262668e-3, 1e-4 }, g[3][2];
    if (run(theta, seen, NULL)) return 1;
    theta[0] = 1.2e-3, theta[1] = 0.8e-4;                // what is guessed
    for (int k = 0; k < 5; ++k) {
        const double d[] = { 1e-6*theta[0], 1e-6*theta[1] };
        if (run(theta, seen, g[0]) || run((double[]){ theta[0] + d[0], theta[1] }, seen, g[1])
            || run((double[]){ theta[0], theta[1] + d[1] }, seen, g[2])) return 1;
        const double a = (g[1][0] - g[0][0])/d[0], b = (g[2][0] - g[0][0])/d[1];
        const double e = (g[1][1] - g[0][1])/d[0], f = (g[2][1] - g[0][1])/d[1];
        theta[0] -= (f*g[0][0] - b*g[0][1])/(a*f - b*e);
        theta[1] -= (a*g[0][1] - e*g[0][0])/(a*f - b*e);
    }
    printf("J2 = %.12f, c = %.12f\n", theta[0], theta[1]);
    return 0;
}
