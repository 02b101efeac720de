/* pythagorean.c - the end of the Pythagorean problem, for tests/hard/pythagorean.c and `make cost`

   Burrau's three bodies (1913): masses 3, 4, 5 at rest at (1,3), (-2,-1), (1,-1),
   G = 1, to T = 63, or another time (Szebehely and Peters 1967).  Quadruple precision, Gragg's rule
   extrapolated to order 16, each step a fraction of sqrt(r^3/M) of the closest pair.

     gcc -O2 -Itests tests/gen/pythagorean.c -o pythagorean && ./pythagorean 64 && ./pythagorean 96
     ./pythagorean 128 30 && ./pythagorean 192 30

   prints the state with 25 digits; what the two runs have in common is right.   */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

__extension__ typedef __float128 real;
#include "hard/extrapolate.h"

static const int mass[3] = { 3, 4, 5 };

static real root(real x)                           /* Newton on 1/sqrt, from double */
{
    real y = 1/sqrt((double)x);
    for (int k = 0; k < 3; ++k) y += y*(1 - x*y*y)/2;
    return x*y;
}

/* y = (x1, y1, x2, y2, x3, y3, velocities) */
static void attract(real t, const real *y, real *dy, void *user)
{
    (void)t; (void)user;
    for (int i = 0; i < 6; ++i) { dy[i] = y[6 + i]; dy[6 + i] = 0; }
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < a; ++b) {
            real x = y[2*a] - y[2*b], z = y[2*a + 1] - y[2*b + 1], d2 = x*x + z*z, w = 1/(d2*root(d2));
            dy[6 + 2*a] -= mass[b]*w*x;  dy[7 + 2*a] -= mass[b]*w*z;
            dy[6 + 2*b] += mass[a]*w*x;  dy[7 + 2*b] += mass[a]*w*z;
        }
}

static double shortest(const real *y)
{
    double rate = 0;
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < a; ++b) {
            double d = hypot((double)(y[2*a] - y[2*b]), (double)(y[2*a + 1] - y[2*b + 1]));
            rate = fmax(rate, sqrt((mass[a] + mass[b])/(d*d*d)));
        }
    return 1/rate;
}

static void print(real x)                          /* 25 digits after the point */
{
    printf("%s%d.", x < 0 ? "-" : "", (int)(x < 0 ? -x : x));
    x = x < 0 ? -x : x;
    for (int k = 0; k < 25; ++k) {
        x = (x - (int)x)*10;
        printf("%d", (int)x);
    }
}

int main(int argc, char **argv)
{
    const motion bodies = { 12, attract, NULL };
    const double fraction = argc > 1 ? atof(argv[1]) : 64, end = argc > 2 ? atof(argv[2]) : 63;
    real y[12] = { 1, 3, -2, -1, 1, -1 }, low[12] = { 0 }, d[12], t = 0;
    int steps = 0;
    while (t < end) {
        real H = shortest(y)*8/fraction;
        if (t + H > end) H = end - t;
        extrapolate(&bodies, t, H, y, d);
        for (int i = 0; i < 12; ++i) {
            real x = d[i] + low[i], sum = y[i] + x;
            low[i] = x - (sum - y[i]);
            y[i] = sum;
        }
        t += H;
        ++steps;
    }
    for (int i = 0; i < 12; ++i) {
        print(y[i]);
        printf(i % 2 ? "\n" : "  ");
    }
    fprintf(stderr, "%d steps\n", steps);
    return 0;
}
