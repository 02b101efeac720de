/* 20 - What if the motion hits something? A bouncing ball

   gvi.h knows no contact. But an impact is an instant: step up to it, change the momentum, start again
   from there. tools/event.h finds the instant, g = 0 for the distance g from the surface, and a start is
   cheap. So a ball bounces on a wavy table, y = cos(3x)/10, in a trough that keeps it there. It is elastic:
   the momentum is mirrored at the table, and the energy must come back after 5,000 bounces.

   In each step only the first impact counts; what the step computes beyond it does not happen. A real ball
   loses a part of its speed each time (elasticity 0.8). Its bounces then follow faster and faster, infinitely many in
   a finite time: stop when they are low enough.
   (Then it slides: another scene.)

   prints

     degree 1: 5000 bounces, energy within 1e-02
     degree 2: 5000 bounces, energy within 1e-07
     degree 4: 5000 bounces, energy within 1e-13
     degree 8: 5000 bounces, energy within 1e-13
     elasticity 0.8: jumps no more after 33 bounces, at t = 12.19
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/event.h"
#include <math.h>
#include <stdio.h>

/* V = y + x^2/2 + x^4/4 + x^2 y/10: weight, and walls                             */
GVI_EACH(weight_and_walls, 2, f)
{
    const double X = x->q[0], Y = x->q[1];
    x->f[0] -= X*(1 + X*X + Y/5);
    x->f[1] -= 1 + X*X/10;
}

static double energy(const double *q, const double *p)
{
    const double x = q[0], y = q[1];
    return (p[0]*p[0] + p[1]*p[1])/2 + y + x*x/2 + x*x*x*x/4 + x*x*y/10;
}

static double height(double t, const double *q, const double *v, void *user)
{
    return (void)t, (void)v, (void)user, q[1] - cos(3*q[0])/10;
}

/* The momentum after the impact; returns the speed at which the ball leaves.     */
static double bounce(const double *q, double *p, double elasticity)
{
    const double n[2] = { 0.3*sin(3*q[0]), 1 }, size = n[0]*n[0] + n[1]*n[1];        // gradient of the height
    const double towards = (n[0]*p[0] + n[1]*p[1])/size;
    for (int i = 0; i < 2; ++i) p[i] -= (1 + elasticity)*towards*n[i];
    return -elasticity*towards*sqrt(size);
}

/* Until `most` bounces, or until the jumps are low: how many, and the largest error of the energy.  */
static int jump(int degree, double elasticity, int most, double *t, double *worst)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight_and_walls } };
    const gvi_desc desc = { .n = 2, .degree = degree, .effects = scene, .effect_count = 1 };
    double q[2] = { 0.3, 1 }, v[2], p[2] = { 0.2, 0 }, leaves = 1;
    const double start = energy(q, p);
    event e = { .g = height, .q = q, .v = v, .p = p };
    gvi_stepper st;
    int bounces = 0;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start_momentum(&st, 0, q, p);
    *worst = 0;
    while (bounces < most && leaves > 1e-3) {
        if (gvi_step(&st, 0.1)) return puts(gvi_why(&st)), -1;
        const int found = event_next(&e, &st);
        if (found < 0) return puts(gvi_status_text((gvi_status)found)), -1;
        if (!found) continue;
        leaves = bounce(q, p, elasticity);
        gvi_start_momentum(&st, e.t, q, p);
        *worst = fmax(*worst, fabs(energy(q, p)/start - 1));
        ++bounces;
    }
    *t = st.t;
    return bounces;
}

int main(void)
{
    double t, worst;
    for (int degree = 1; degree <= 8; degree *= 2) {
        const int bounces = jump(degree, 1, 5000, &t, &worst);
        printf("degree %d: %d bounces, energy within %.0e\n", degree, bounces, pow(10, ceil(log10(worst))));
    }
    const int bounces = jump(8, 0.8, 5000, &t, &worst);
    printf("elasticity 0.8: jumps no more after %d bounces, at t = %.2f\n", bounces, t);
    return 0;
}
