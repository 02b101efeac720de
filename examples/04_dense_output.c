/* 04 - Between the steps: the curve, the state at any time, and events

   A pendulum let go at 2 rad passes the vertical after a quarter of its period,
   T/4 = pi/(2 agm(1, cos 1)).  The steps do not meet that instant.  Inside the
   last step gvi_curve gives the polynomial, cheaply and with the lower order
   that the curve has; gvi_state_at gives the state at the full order of the
   method.  Bisection with either finds the passage.  Neither changes what later
   steps compute.

   prints

     first passage at 2.087438232, exactly 2.087438232
     40 passages: error by the curve 1e-09 or less, by gvi_state_at 1e-11 or less
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

GVI_EACH(weight, 1, f)
{
    x->f[0] -= sin(x->q[0]);
}

static double quarter_period(double amplitude)
{
    double a = 1, b = cos(amplitude/2);
    for (int k = 0; k < 8; ++k) {
        double mean = (a + b)/2;
        b = sqrt(a*b);
        a = mean;
    }
    return 1.5707963267948966/a;
}

static double above(double x) { return pow(10, ceil(log10(x))); }

/* The angle at fraction tau of the last step, by the curve or at full order.  */
static double angle(gvi_stepper *st, double tau, int full)
{
    double q = 0;
    if (full) gvi_state_at(st, st->t - (1 - tau)*st->h, &q, NULL, NULL);
    else gvi_curve(st, tau, &q, NULL);
    return q;
}

/* The time of the sign change in the last step.                               */
static double passage(gvi_stepper *st, int full)
{
    double a = 0, b = 1, start = angle(st, 0, full);
    while (b - a > 1e-14) {
        double middle = (a + b)/2;
        if (angle(st, middle, full)*start > 0) a = middle;
        else b = middle;
    }
    return st->t - (1 - a)*st->h;
}

int main(void)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight } };
    const gvi_desc desc = { .n = 1, .degree = 5, .effects = scene, .effect_count = 1 };
    static double memory[GVI_LENGTH(1, 5, 5)];
    double quarter = quarter_period(2), by_curve = 0, by_state = 0;
    int found = 0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 2 }, (double[]){ 0 });
    while (found < 40) {
        double before = st.q[0];
        if (gvi_step(&st, 0.25) != GVI_OK) return puts(gvi_why(&st)), 1;
        if (before*st.q[0] > 0) continue;
        double exact = (2*found++ + 1)*quarter;
        by_curve = fmax(by_curve, fabs(passage(&st, 0) - exact));
        by_state = fmax(by_state, fabs(passage(&st, 1) - exact));
        if (found == 1) printf("first passage at %.9f, exactly %.9f\n", passage(&st, 1), exact);
    }
    printf("40 passages: error by the curve %.0e or less, by gvi_state_at %.0e or less\n",
           above(by_curve), above(by_state));
    return 0;
}
