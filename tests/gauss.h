/* gauss.h - Legendre's polynomials and Gauss's rule in long double, by Newton's method */
#ifndef TESTS_GAUSS_H
#define TESTS_GAUSS_H

#include <math.h>

enum { LEGENDRE_MOST = 16 };

/* P_0..P_m at u */
static void legendre(int m, long double u, long double *P)
{
    P[0] = 1;
    P[1] = u;
    for (int k = 1; k < m; ++k) P[k+1] = ((2*k + 1)*u*P[k] - k*P[k-1])/(k + 1);
}

/* Nodes c, rising, and weights b on [0, 1], s <= LEGENDRE_MOST */
static void gauss_nodes(int s, long double *c, long double *b)
{
    long double P[LEGENDRE_MOST + 1];
    for (int i = 0; i < s; ++i) {
        long double u = cosl(3.14159265358979323846L*(i + 0.75L)/(s + 0.5L)), slope = 1;
        for (int k = 0; k < 8; ++k) {
            legendre(s, u, P);
            slope = s*(P[s-1] - u*P[s])/(1 - u*u);
            u -= P[s]/slope;
        }
        c[i] = (1 - u)/2;
        b[i] = 1/((1 - u*u)*slope*slope);
    }
}

#endif
