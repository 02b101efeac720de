/* horizon.c - makes tests/cost/horizon.h: the outer solar system after 10 and 100 times 548 years

     cc -O2 -I. tests/gen/horizon.c tests/cost/problems.c -lm && ./a.out > tests/cost/horizon.h

   Gauss collocation in the Nystroem form, 12 stages, all in long double with compensated sums;
   twice, with steps of 80 and of 100 days.  What the two differ by is printed with each state.
   At one length the result is compared with the reference of 113 bits.                        */
#include "tests/cost/problems.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__LDBL_MANT_DIG__) && __LDBL_MANT_DIG__ < 64
#error "needs a long double of at least 64 bits"
#endif

enum { S = 12, N = 18 };
typedef long double real;
static real c[S], b[S], A2[S][S], E[S][S], gm[6];

static void legendre(int m, real u, real *P)
{
    P[0] = 1;
    P[1] = u;
    for (int k = 1; k < m; ++k) P[k+1] = ((2*k + 1)*u*P[k] - k*P[k-1])/(k + 1);
}

/* Nodes by Newton's method; A from integrals of Legendre polynomials; E extrapolates a step.  */
static void tables(void)
{
    static real at[S][S + 2], A[S][S], P[S + 2];
    for (int i = 0; i < S; ++i) {
        real u = cosl(3.14159265358979323846L*(i + 0.75L)/(S + 0.5L)), slope = 1;
        for (int k = 0; k < 8; ++k) {
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
            E[i][j] = 1;
            for (int k = 0; k < S; ++k) if (k != j) E[i][j] *= (1 + c[i] - c[k])/(c[j] - c[k]);
        }
    for (int i = 0; i < S; ++i)
        for (int j = 0; j < S; ++j)
            for (int k = 0; k < S; ++k) A2[i][j] += A[i][k]*A[k][j];
}

static void acceleration(const real *q, real *a)
{
    memset(a, 0, N*sizeof *a);
    for (int i = 0; i < 5; ++i)
        for (int j = i + 1; j < 6; ++j) {
            real x = q[3*j] - q[3*i], y = q[3*j+1] - q[3*i+1], z = q[3*j+2] - q[3*i+2];
            real d2 = x*x + y*y + z*z, w = 1/(d2*sqrtl(d2)), to = gm[j]*w, from = gm[i]*w;
            a[3*i] += to*x;    a[3*i+1] += to*y;    a[3*i+2] += to*z;
            a[3*j] -= from*x;  a[3*j+1] -= from*y;  a[3*j+2] -= from*z;
        }
}

static void add(real d, real *x, real *rest)
{
    real e = d + *rest, y = *x + e;
    *rest = e - (y - *x);
    *x = y;
}

/* Returns the largest change of the points in this round.                                     */
static real round_of(const real *q, const real *v, real h, real (*X)[N], real (*F)[N])
{
    real most = 0;
    for (int i = 0; i < S; ++i)
        for (int d = 0; d < N; ++d) {
            real x = 0;
            for (int j = 0; j < S; ++j) x += A2[i][j]*F[j][d];
            x = q[d] + (h*c[i]*v[d] + h*h*x);
            most = fmaxl(most, fabsl(x - X[i][d]));
            X[i][d] = x;
        }
    for (int i = 0; i < S; ++i) acceleration(X[i], F[i]);
    return most;
}

static void integrate(const problem *p, real end, long steps, real *q, real *v)
{
    static real X[S][N], F[S][N], old[S][N];
    real qe[N] = { 0 }, ve[N] = { 0 }, h = end/steps;
    for (int d = 0; d < N; ++d) q[d] = p->q[d], v[d] = p->v[d];
    memset(F, 0, sizeof F);
    for (long k = 0; k < steps; ++k) {
        real before = HUGE_VALL, change;
        memcpy(old, F, sizeof F);
        for (int i = 0; i < S; ++i)
            for (int d = 0; d < N; ++d) {
                F[i][d] = 0;
                for (int j = 0; j < S; ++j) F[i][d] += E[i][j]*old[j][d];
            }
        for (int m = 0; m < 60; ++m, before = change) {
            change = round_of(q, v, h, X, F);
            if (m > 1 && change < 1e-16L && change >= before) break;
        }
        for (int d = 0; d < N; ++d) {
            real dq = 0, dv = 0;
            for (int j = 0; j < S; ++j) dq += b[j]*(1 - c[j])*F[j][d], dv += b[j]*F[j][d];
            add(h*v[d] + h*(ve[d] + h*dq), q + d, qe + d);
            add(h*dv, v + d, ve + d);
        }
    }
}

/* Steps of 80 and of 100 days; what the two results differ by.                                */
static void print_state(const problem *p, int length)
{
    real q[2][N], v[N], differ = 0;
    for (int r = 0; r < 2; ++r) integrate(p, (real)p->end*length, (long)length*(r ? 2000 : 2500), q[r], v);
    for (int d = 0; d < N; ++d) differ = fmaxl(differ, fabsl(q[0][d] - q[1][d]));
    if (length == 1) {
        real off = 0;
        for (int d = 0; d < N; ++d) off = fmaxl(off, fabsl(q[0][d] - p->reference[d]));
        printf("/* At one length: %.1Le from the reference of 113 bits.  */\n", off);
    }
    printf("/* At %d: the two runs differ by %.1Le.  */\n", length, differ);
    printf("static const long double horizon_%d[] = {\n", length);
    for (int d = 0; d < N; ++d) printf("%s%.21LeL,%s", d%3 ? " " : "    ", q[0][d], d%3 == 2 ? "\n" : "");
    printf("};\n\n");
}

int main(void)
{
    const problem *p = problem_named("P4");
    for (int i = 0; i < 6; ++i) gm[i] = p->mass.matrix[3*i];
    tables();
    printf("/* horizon.h - the outer solar system after long times, made by tests/gen/horizon.c */\n"
           "#ifndef HORIZON_H\n#define HORIZON_H\n\n");
    print_state(p, 1);
    print_state(p, 10);
    print_state(p, 100);
    printf("static const struct { int length; const long double *q; } horizons[] = {\n"
           "    { 1, horizon_1 }, { 10, horizon_10 }, { 100, horizon_100 }\n};\n\n#endif\n");
    return 0;
}
