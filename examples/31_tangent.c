/* 31 - What becomes of a neighbour? The derivative of a step

   Is an orbit regular or chaotic? Look at an orbit that starts close to it: on a regular one the
   distance grows like the time, on a chaotic one exponentially. The distance of infinitely
   close orbits is the derivative of the motion in a direction, and tools/tangent.h steps it
   along with the motion: four coordinates instead of two, and on the second pair acts the
   derivative of the force times the direction. What comes out is the derivative of the step
   itself, to rounding; so it is symplectic, as the step is.

   The star of lesson 19, V = (x^2 + y^2)/2 + x^2 y - y^3/3, at energy 1/8. MEGNO (Cincotta
   and Simo 2000) is a weighted mean of the rate of growth: it tends to 2 on a regular orbit,
   and grows like half the Lyapunov exponent times the time on a chaotic one.

   prints

     the product agrees with differences of the force: yes
     from y = 0.55:  exponent below 0.001, MEGNO 2.0: regular
     from y = -0.15: exponent about 0.05, MEGNO above 100: chaotic
     a step's derivative in all four directions is symplectic to 4e-15: yes
     its derivative by h is (v, F) at its end, to 1e-12: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/tangent.h"
#include <math.h>
#include <stdio.h>

GVI_EACH(potential, 2, f)
{
    const double X = x->q[0], Y = x->q[1];
    x->f[0] -= X + 2*X*Y;
    x->f[1] -= Y + X*X - Y*Y;
}

/* The derivative of that force at x, times the direction d.                     */
static int product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    const double *X = x->q, *Y = X + s, *dX = d->q, *dY = dX + s;
    for (int k = 0; k < x->count; ++k) {
        d->f[k]     -= (1 + 2*Y[k])*dX[k] + 2*X[k]*dY[k];
        d->f[s + k] -= 2*X[k]*dX[k] + (1 - 2*Y[k])*dY[k];
    }
    return (void)parameter, (void)user, 0;
}

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = potential } };
static const gvi_desc star = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 };
static double memory[GVI_LENGTH(12, 8, 8)], room[TANGENT_ROOM(2, 5)];

/* 20,000 units of time from (0, y), at energy 1/8.                              */
static int follow(double y, double *exponent, double *megno)
{
    tangent T = { .plain = star, .product = { product }, .directions = 1,
                  .room = room, .room_length = TANGENT_ROOM(2, 1) };
    const double q[] = { 0, y }, p[] = { sqrt(0.25 - y*y + 2*y*y*y/3), 0 };
    double d[4] = { 1, 0.3, 0.2, -0.5 }, before = sqrt(1.38), sum = 0, mean = 0;
    gvi_stepper st;
    if (tangent_scene(&T) || gvi_init(&st, &T.desc, memory, sizeof memory)) return 1;
    tangent_start(&T, &st, 0, q, p, d, d + 2);
    *megno = 0;
    for (int k = 1; k <= 50000; ++k) {
        if (gvi_step(&st, 0.4)) return puts(gvi_why(&st)), 1;
        tangent_column(&T, &st, 0, d, d + 2);
        const double size = sqrt(d[0]*d[0] + d[1]*d[1] + d[2]*d[2] + d[3]*d[3]), growth = log(size/before);
        sum += growth;
        mean += 2*growth - mean/k;                       // 2/t times the integral of t d(log size)/dt
        *megno += (mean - *megno)/k;                     // and its own mean over time
        before = size;
        if (size < 1e8) continue;                        // linear: any size will do
        for (int i = 0; i < 4; ++i) d[i] /= size;
        tangent_start(&T, &st, st.t, st.q, st.p, d, d + 2);
        before = 1;
    }
    *exponent = sum/st.t;
    return 0;
}

int main(void)
{
    const double q[] = { 0.1, 0.2 }, p[] = { 0.4, -0.1 }, dq[] = { 1, 2 }, dp[] = { 2, -1 };
    tangent T = { .plain = star, .product = { product }, .directions = 4, .by_h = 1, .h = 0.25,
                  .room = room, .room_length = TANGENT_ROOM(2, 5) };
    double d[5][4], force[2] = { 0, 0 }, worst = 0, off = 0, exponent, megno;
    gvi_stepper st;
    int part;
    if (tangent_scene(&T)) return 1;
    printf("the product agrees with differences of the force: %s\n",
           tangent_check(&T, 0, q, p, dq, dp, &part) < 1e-9 ? "yes" : "no");

    for (int k = 0; k < 2; ++k) {
        if (follow(k ? -0.15 : 0.55, &exponent, &megno)) return 1;
        if (megno < 3) printf("from y = 0.55:  exponent %s 0.001, MEGNO %.1f: regular\n",
                              exponent < 0.001 ? "below" : "above", megno);
        else printf("from y = -0.15: exponent %s 0.05, MEGNO %s 100: chaotic\n",
                    exponent > 0.01 && exponent < 0.1 ? "about" : "not", megno > 100 ? "above" : "below");
    }

    // All directions at once are the matrix M of the step: M'JM = J.
    gvi_init(&st, &T.desc, memory, sizeof memory);
    tangent_start(&T, &st, 0, q, p, NULL, NULL);
    if (st.status || gvi_step(&st, 0.25)) return puts(gvi_why(&st)), 1;
    for (int j = 0; j < 5; ++j) tangent_column(&T, &st, j, d[j], d[j] + 2);
    for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
            double z = (a == b + 2) - (b == a + 2);
            for (int i = 0; i < 2; ++i) z += d[a][i]*d[b][2 + i] - d[a][2 + i]*d[b][i];
            worst = fmax(worst, fabs(z));
        }
    printf("a step's derivative in all four directions is symplectic to 4e-15: %s\n", worst < 4e-15 ? "yes" : "no");

    // A longer step ends later on the same orbit, but for the error of a step.
    const gvi_real end[] = { st.q[0], st.q[1] };
    const gvi_points x = { .n = 2, .count = 1, .stride = 1, .t = &st.t, .q = end, .f = force };
    potential(&x, NULL);
    for (int i = 0; i < 2; ++i) off = fmax(off, fmax(fabs(d[4][i] - st.p[i]), fabs(d[4][2 + i] - force[i])));
    printf("its derivative by h is (v, F) at its end, to 1e-12: %s\n", off < 1e-12 ? "yes" : "no");
    return 0;
}
