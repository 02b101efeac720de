/* 58 - Where does a bead in a rough bowl stop? Where friction holds it

   A bead slides in a bowl of radius 1 from an angle of -1.2, under gravity and Coulomb's friction, mu = 0.2.  It comes to
   rest on each side and slides back, until it sticks: where the slope is at most mu.  friction.h finds these events on the
   step's curve and ends a step at each, so the order of the steps is kept.  What it needs are three effects: the bowl, a row
   that holds the bead while it sticks, and friction while it slips, mu N against the motion, N the pressure.

   On one way, from rest at `from`, the square of the speed at an angle w is in closed form, and so are all stops.

   prints

     stops at  0.583331 and slides back
     stops at -0.152197 and sticks: the slope is less than mu = 0.2
     within 1e-13 of the closed form
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/friction.h"
#include <math.h>
#include <stdio.h>

static const double mu = 0.2, first = -1.2;
static friction bead;

GVI_EACH(weight, 2, f) { x->f[1] -= 1; }

GVI_EACH(bowl, 2, rows(1))
{
    const double X = x->q[0], Y = x->q[1], r = GVI_SQRT(X*X + Y*Y);
    x->g[0] = 1 - r;
    x->jacobian[0] = -X/r;
    x->jacobian[1] = -Y/r;
}

/* T v = 0, T the direction along the bowl */
GVI_EACH(sticks, 2, rows(1))
{
    const double X = x->q[0], Y = x->q[1], r = GVI_SQRT(X*X + Y*Y);
    x->jacobian[0] = -Y/r;
    x->jacobian[1] = X/r;
}

/* The pressure carries the weight's part across the bowl and keeps the bead on its circle */
GVI_EACH(slips, 2, v, f)
{
    const double X = x->q[0], Y = x->q[1], r = GVI_SQRT(X*X + Y*Y), w = (X*x->v[1] - Y*x->v[0])/r,
                 N = w*w/r - Y/r;
    x->f[0] += mu*bead.sign*N*Y/r;
    x->f[1] -= mu*bead.sign*N*X/r;
}

static double speed(double t, const double *q, const double *v, void *user)
{
    return (void)t, (void)user, (q[0]*v[1] - q[1]*v[0])/hypot(q[0], q[1]);
}

/* u = w'^2 on the way with sign s: du/dw = -2 sin w - 2 mu s (u + cos w), u(from) = 0 */
static double speed_squared(double w, double from, double s)
{
    const double k = 2*mu*s, b = -3*k/(1 + k*k), a = -1 - b/k;
    return a*cos(w) + b*sin(w) - (a*cos(from) + b*sin(from))*exp(-k*(w - from));
}

/* Where the bead that leaves `from` stops, by bisection behind the lowest point */
static double stop_after(double from)
{
    const double s = from < 0 ? 1 : -1;
    double low = 0, high = -from;
    if (speed_squared(low, from, s) < 0) low = from/2;
    for (int k = 0; k < 60; ++k) {
        const double w = (low + high)/2;
        if (speed_squared(w, from, s) > 0) low = w;
        else high = w;
    }
    return low;
}

int main(void)
{
    static double memory[8000];
    static const gvi_effect scene[] = {
        { .kind = GVI_POTENTIAL, .points = weight },
        { .kind = GVI_CONSTRAINT, .points = bowl, .rows = 1 },
        { .kind = GVI_NONHOLONOMIC, .points = sticks, .rows = 1 },
        { .kind = GVI_FORCE, .points = slips },
    };
    const gvi_desc desc = { .n = 2, .degree = 4, .effects = scene, .effect_count = 4 };
    const double q[] = { sin(first), -cos(first) }, v[] = { 0, 0 };
    double right = first, off = 0;
    gvi_status status;

    bead = (friction){ .contact = 1, .stick = 2, .slip = 3, .mu = mu, .speed = speed };
    status = friction_init(&bead, &desc, memory, sizeof memory);
    if (status == GVI_OK) status = friction_start(&bead, 0, q, v);

    for (unsigned long long seen = 0; status == GVI_OK && bead.st.t < 14;) {
        status = friction_step(&bead, 1.0/16);
        if (bead.stops == seen) continue;
        seen = bead.stops;
        right = stop_after(right);
        const int slides = bead.sign < 0 || bead.sign > 0;
        if (!slides) off = fabs(atan2(bead.st.q[0], -bead.st.q[1]) - right);
        printf("stops at %9.6f and %s\n", right, slides ? "slides back" : "sticks: the slope is less than mu = 0.2");
    }

    if (status != GVI_OK) return printf("%s\n", gvi_why(&bead.st)), 1;
    printf("within 1e-13 of the closed form%s\n", off < 1e-13 ? "" : ": no");
    return 0;
}
