/* references.c - end states of the problems in tests/cost/ordinary.h and encounters.h that are no others' again, and
   those of horizon.h: the outer solar system after 1, 10 and 100 times 548 years

     gcc -O2 -std=gnu99 -I. tests/gen/references.c -lquadmath -lm && ./a.out      (three minutes)
     ./a.out 100             the outer solar system at 100 times its length (hours), or at 1 or 10 times

   Gauss collocation of 14 stages for y' = f(y) in 113-bit arithmetic, with two numbers of steps, one 3/2 of the
   other; printed is the finer result, and how far it is from the coarser.  Comets and flyby by Kepler's equation.
   The starts are the doubles of ordinary.h and encounters.h.                                                   */
#include "tests/cost/solar.h"
#include <quadmath.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef __float128 real;
enum { S = 14, MOST = 36 };
static real c[S], A[S][S], b[S];

static void legendre(int m, real u, real *P)
{
    P[0] = 1;
    P[1] = u;
    for (int k = 1; k < m; ++k) P[k+1] = ((2*k + 1)*u*P[k] - k*P[k-1])/(k + 1);
}

/* Nodes by Newton's method; A from integrals of Legendre polynomials                          */
static void tables(void)
{
    static real at[S][S + 2], P[S + 2];
    for (int i = 0; i < S; ++i) {
        real u = cosq(M_PIq*(i + 0.75Q)/(S + 0.5Q)), slope = 1;
        for (int k = 0; k < 9; ++k) {
            legendre(S, u, P);
            slope = S*(P[S-1] - u*P[S])/(1 - u*u);
            u -= P[S]/slope;
        }
        c[i] = (1 - u)/2;
        b[i] = 1/((1 - u*u)*slope*slope);
        legendre(S + 1, u, at[i]);
    }
    for (int i = 0; i < S; ++i)
        for (int j = 0; j < S; ++j) {
            A[i][j] = c[i];
            for (int k = 1; k < S; ++k) A[i][j] += (at[i][k-1] - at[i][k+1])/2*at[j][k];
            A[i][j] *= b[j];
        }
}

typedef void slope_fn(const real *y, real *dy);

static void integrate(slope_fn *f, int n, real end, long steps, real *y)
{
    static real k[S][MOST], next[MOST], Y[MOST];
    const real h = end/steps;
    memset(k, 0, sizeof k);
    for (long step = 0; step < steps; ++step) {
        real change = 1, before = 2;
        for (int it = 0; it < 200 && (change > 1e-30Q || change < before); ++it) {
            before = change;
            change = 0;
            for (int i = 0; i < S; ++i) {
                for (int d = 0; d < n; ++d) {
                    Y[d] = 0;
                    for (int j = 0; j < S; ++j) Y[d] += A[i][j]*k[j][d];
                    Y[d] = y[d] + h*Y[d];
                }
                f(Y, next);
                for (int d = 0; d < n; ++d) {
                    const real e = fabsq(next[d] - k[i][d])*h;
                    if (e > change) change = e;
                    k[i][d] = next[d];
                }
            }
        }
        for (int d = 0; d < n; ++d) {
            real s = 0;
            for (int j = 0; j < S; ++j) s += b[j]*k[j][d];
            y[d] += h*s;
        }
    }
}

static void solar(const real *y, real *dy)
{
    for (int i = 0; i < 18; ++i) dy[i] = y[18+i], dy[18+i] = 0;
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) {
            const real x = y[3*j] - y[3*i], z = y[3*j+1] - y[3*i+1], w = y[3*j+2] - y[3*i+2], d2 = x*x + z*z + w*w;
            if (i == j) continue;
            const real s = solar_mass[3*j]/(d2*sqrtq(d2));
            dy[18+3*i] += s*x;
            dy[19+3*i] += s*z;
            dy[20+3*i] += s*w;
        }
}

static void toda(const real *y, real *dy)
{
    for (int i = 0; i < 16; ++i) {
        dy[i] = y[16+i];
        dy[16+i] = expq(y[(i+15)%16] - y[i]) - expq(y[i] - y[(i+1)%16]);
    }
}

static void atoms(const real *y, real *dy)
{
    for (int i = 0; i < 14; ++i) dy[i] = y[14+i], dy[14+i] = 0;
    for (int i = 0; i < 7; ++i)
        for (int j = 0; j < 7; ++j) {
            const real x = y[2*i] - y[2*j], z = y[2*i+1] - y[2*j+1], r2 = x*x + z*z;
            if (i == j) continue;
            const real w = 48/(r2*r2*r2*r2*r2*r2*r2) - 24/(r2*r2*r2*r2);
            dy[14+2*i] += w*x;
            dy[14+2*i+1] += w*z;
        }
}

static void arenstorf(const real *y, real *dy)
{
    const real m = 0.012277471, x = y[0] + m, z = y[0] - ((double)1 - 0.012277471);
    const real d = sqrtq(x*x + y[1]*y[1]), e = sqrtq(z*z + y[1]*y[1]), u = ((double)1 - 0.012277471)/(d*d*d), w = m/(e*e*e);
    dy[0] = y[2] + y[1];
    dy[1] = y[3] - y[0];
    dy[2] = -u*x - w*z + y[3];
    dy[3] = -u*y[1] - w*y[1] - y[2];
}

static void bottle(const real *y, real *dy)
{
    const real k = 0.1, bx = -k*y[0]*y[2], by = -k*y[1]*y[2], bz = 1 + k*(y[2]*y[2] - (y[0]*y[0] + y[1]*y[1])/2);
    for (int i = 0; i < 3; ++i) dy[i] = y[3+i];
    dy[3] = y[4]*bz - y[5]*by;
    dy[4] = y[5]*bx - y[3]*bz;
    dy[5] = y[3]*by - y[4]*bx;
}

static void relativistic(const real *y, real *dy)
{
    const real w = 1/sqrtq(1 + (y[2]*y[2] + y[3]*y[3])/25), d = sqrtq(y[0]*y[0] + y[1]*y[1]);
    dy[0] = w*y[2];
    dy[1] = w*y[3];
    dy[2] = -y[0]/(d*d*d);
    dy[3] = -y[1]/(d*d*d);
}

/* y = (q, v) of 5 balls on 4 rods: G G' lambda = -|rates|^2, v' = G' lambda                    */
static void rope(const real *y, real *dy)
{
    const real *v = y + 10;
    real d[4][2], M[4][4] = { { 0 } }, lambda[4];
    for (int i = 0; i < 4; ++i) {
        lambda[i] = 0;
        for (int k = 0; k < 2; ++k) {
            const real rate = v[2*i+2+k] - v[2*i+k];
            d[i][k] = y[2*i+2+k] - y[2*i+k];
            lambda[i] -= rate*rate;
        }
        M[i][i] = 2*(d[i][0]*d[i][0] + d[i][1]*d[i][1]);
        if (i > 0) M[i][i-1] = M[i-1][i] = -d[i][0]*d[i-1][0] - d[i][1]*d[i-1][1];
    }
    for (int i = 0; i < 4; ++i)                     // Gauss and Jordan
        for (int j = 0; j < 4; ++j) {
            const real factor = M[j][i]/M[i][i];
            if (j == i) continue;
            for (int k = 0; k < 4; ++k) M[j][k] -= factor*M[i][k];
            lambda[j] -= factor*lambda[i];
        }
    for (int i = 0; i < 10; ++i) dy[i] = v[i], dy[10+i] = 0;
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 2; ++k) {
            dy[10+2*i+k] -= lambda[i]/M[i][i]*d[i][k];
            dy[12+2*i+k] += lambda[i]/M[i][i]*d[i][k];
        }
}

/* q = f q0 + g v0 after t, by the difference D of the eccentric anomalies, found by bisection: Kepler's equation
   n t = D - (e cos E0) sin D + (e sin E0)(1 - cos D), and the same with hyperbolic functions    */
static void conic(const char *name, const double *q, const double *v, double end)
{
    const real r = sqrtq((real)q[0]*q[0] + (real)q[1]*q[1]), square = (real)v[0]*v[0] + (real)v[1]*v[1];
    const real sign = square < 2/r ? 1 : -1, a = sign/(2/r - square), n = 1/(a*sqrtq(a)), nt = n*end;
    const real along = 1 - sign*r/a, across = ((real)q[0]*v[0] + (real)q[1]*v[1])/sqrtq(a);
    real lo = sign > 0 ? nt - 4 : 0, hi = sign > 0 ? nt + 4 : 60, s = 0, c = 0, D = 0;
    for (int k = 0; k < 150; ++k) {
        D = (lo + hi)/2;
        s = sign > 0 ? sinq(D) : sinhq(D);
        c = sign > 0 ? 1 - cosq(D) : coshq(D) - 1;
        if (sign*(D - along*s) + across*c < nt) lo = D;
        else hi = D;
    }
    const real f = 1 - a/r*c, g = end - sign*(D - s)/n;
    char text[2][64];
    for (int i = 0; i < 2; ++i) quadmath_snprintf(text[i], sizeof text[i], "%.34Qe", f*q[i] + g*v[i]);
    printf("\nstatic const long double reference_%s[] = {\n    %sL, %sL\n};\n", name, text[0], text[1]);
}

static void make(const char *name, slope_fn *f, int n, double end, long steps, const double *y0)
{
    real y[2][MOST], apart = 0;
    char text[64];
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < n; ++i) y[k][i] = y0[i];
        integrate(f, n, end, steps*(2 + k)/2, y[k]);
    }
    for (int i = 0; i < n; ++i) apart = fmaxq(apart, fabsq(y[0][i] - y[1][i]));
    printf("\nstatic const long double reference_%s[] = {                  // to %.0e", name, (double)apart);
    for (int i = 0; i < n/2; ++i) {
        quadmath_snprintf(text, sizeof text, "%.34Qe", y[1][i]);
        printf("%s%sL", i == 0 ? "\n    " : i % 2 ? ", " : ",\n    ", text);
    }
    printf("\n};\n");
}

int main(int argc, char **argv)
{
    tables();
    if (argc > 1) {
        double y[36];
        memcpy(y, solar_q, sizeof solar_q);
        memcpy(y + 18, solar_v, sizeof solar_v);
        return make("solar", solar, 36, 200000*atof(argv[1]), 1000*atol(argv[1]), y), 0;
    }
    conic("comet2", (double[]){ -1.99, 0 }, (double[]){ 0, -0.070888120500833 }, 20*6.283185307179586);
    conic("comet4", (double[]){ -1.9999, 0 }, (double[]){ 0, -0.0070712445851 }, 10*6.283185307179586);
    conic("flyby", (double[]){ -100, 0.2 }, (double[]){ 1.01, 0 }, 200);
    make("rope", rope, 20, 60, 4000, (double[]){ -2, 0, -1, 0, 0, 0, 1, 0, 2, 0, 0, -2, 0, -1.2, 0, 0.2, 0, 1, 0, 2 });
    make("toda", toda, 32, 100, 400, (double[32]){ [16] = 1, -0.5, 0.25, 0, 0.5, -1, 0.75, 0, -0.25, 0.5, -0.75, 0, 0, 0.25, -0.5, -0.25 });
    make("arenstorf", arenstorf, 4, 17.065216560157964, 20000, (double[]){ 0.994, 0, 0, 0.994 - 2.0015851063790825 });
    make("bottle", bottle, 6, 200, 400, (double[]){ 0.5, 0, 0, 0, 0.5, 0.25 });
    make("atoms", atoms, 28, 10, 800, (double[]){ 0, 0, 1.12, 0.02, 0.55, 0.98, -0.56, 0.97, -1.11, 0.01, -0.57, -0.96, 0.56, -0.98,
         0.1, -0.2, -0.3, 0.1, 0.2, 0.2, -0.1, -0.3, 0.3, 0.1, -0.2, 0.2, 0, -0.1 });
    make("relativistic", relativistic, 4, 200, 3000, (double[]){ 0.4, 0, 0, 2 });
    return 0;
}
