/* 36 - The building blocks alone: quadrature, interpolation, linear equations

   Public, and useful by themselves: Gauss and Lobatto rules with any number of
   points; dense LU with an estimate of the condition; barycentric interpolation
   through any nodes.  The stepper uses the first two, and Legendre modes of the
   velocity in place of the third.  37_by_hand.c builds an integrator from all three.

   prints

     integral of exp over [0,1], 5 Gauss points: 1.7182818285
     order of the 5-point rules: Gauss 10, Lobatto 8
     1/(1 + 25 x^2) through 21 points, largest error
       equidistant 59.8, Lobatto 0.0
     derivative of sin at 1, 10 Lobatto points on [0,1]: 0.540302306
     Hilbert matrix of size 6: condition 2.9e+07, solved to 1e-9: yes
     singular matrix: reported
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static double runge(double x) { return 1/(1 + 25*x*x); }

/* The largest error on [-1,1] of the interpolant of runge through n nodes.    */
static double runge_error(int n, const double *x)
{
    double w[21], f[21], worst = 0;
    for (int j = 0; j < n; ++j) f[j] = runge(x[j]);
    gvi_barycentric(n, x, w);
    for (int k = -1000; k <= 1000; ++k)
        worst = fmax(worst, fabs(gvi_interpolate(n, x, w, f, k/1000.0) - runge(k/1000.0)));
    return worst;
}

static void quadrature(void)
{
    double c[5], b[5], sum = 0;
    gvi_gauss(5, c, b);
    for (int i = 0; i < 5; ++i) sum += b[i]*exp(c[i]);
    printf("integral of exp over [0,1], 5 Gauss points: %.10f\n", sum);
    int gauss = gvi_rule_order(5, c, b);
    gvi_lobatto(5, c, b);
    printf("order of the 5-point rules: Gauss %d, Lobatto %d\n", gauss, gvi_rule_order(5, c, b));
}

static void interpolation(void)
{
    double x[21], b[21], w[21], f[21], even[21];
    gvi_lobatto(21, x, b);
    for (int j = 0; j < 21; ++j) {
        x[j] = 2*x[j] - 1;
        even[j] = (j - 10)/10.0;
    }
    printf("1/(1 + 25 x^2) through 21 points, largest error\n");
    printf("  equidistant %.1f, Lobatto %.1f\n", runge_error(21, even), runge_error(21, x));

    gvi_lobatto(10, x, b);
    for (int j = 0; j < 10; ++j) f[j] = sin(x[j]);
    gvi_barycentric(10, x, w);
    printf("derivative of sin at 1, 10 Lobatto points on [0,1]: %.9f\n", gvi_interpolate_derivative(10, x, w, f, 1));
}

static void equations(void)
{
    enum { n = 6 };
    double a[n*n], pivot[2*n + 1], x[n], work[2*n], worst = 0;

    // A x = b whose solution is 1, 1, ..., 1
    for (int i = 0; i < n; ++i) {
        x[i] = 0;
        for (int j = 0; j < n; ++j) x[i] += a[i*n + j] = 1.0/(i + j + 1);
    }
    gvi_lu_factor(n, a, pivot);
    gvi_lu_solve(n, a, pivot, x);
    for (int i = 0; i < n; ++i) worst = fmax(worst, fabs(x[i] - 1));
    printf("Hilbert matrix of size %d: condition %.1e, solved to 1e-9: %s\n", n,
           1/gvi_lu_rcond(n, a, pivot, work), worst < 1e-9 ? "yes" : "no");

    double s[] = { 1, 2, 2, 4 };
    printf("singular matrix: %s\n", gvi_lu_factor(2, s, pivot) == GVI_E_SINGULAR ? "reported" : "missed");
}

int main(void)
{
    quadrature();
    interpolation();
    equations();
    return 0;
}
