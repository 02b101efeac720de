/* irk_newton.h - the published algorithm for stiff Hamiltonian systems, as a rival of stiff.c

   Gauss's method with s stages for y' = f(y), from the formulas of Antonana, Makazaga, Murua:
   Efficient implementation of symplectic implicit Runge-Kutta schemes with simplified Newton
   iterations, 2017 (arXiv 1703.07697) [B], and the order of operations of the variant that the
   authors' code (github.com/mikelehu/IRK-Newton, NSS_MIX_Step) marks as that of the article.

     L_i = h b_i f(Y_i)     Y_i = y + sum_j m_ij L_j     m_ij = a_ij/b_j, m_ij + m_ji = 1 exactly

   1 simplified Newton from L = 0, Jacobian J at the start of the step, until L, rounded to float,
     no longer comes closer in any component
   2 Jacobians J_i at the stages; the last correction is solved again with them, by iterations
     that have the matrix of 1 as preconditioner
   3 one more such correction dL, of a residual that knows the rest e of y, but is not added:
     y + e + sum dL + sum L in this order, compensated

   Other than there: the linear system (I - h BAB^-1 x J) dL = g, which [B] reduces to s/2 + 1
   matrices of size d, is here block tridiagonal, in Legendre modes of g (Hairer, Wanner: Solving
   ordinary differential equations II, IV.5); the corrections agree to rounding.  Coefficients are
   made in long double.                                                                         */
#ifndef IRK_NEWTON_H
#define IRK_NEWTON_H

#include "../gauss.h"

#include <math.h>
#include <string.h>

enum { NEWTON_D = 4, NEWTON_S = 12 };                   /* components; most stages */

typedef void newton_slope_fn(const double *y, double *f);
typedef void newton_jacobian_fn(const double *y, double *J);   /* [d][d] */
typedef double newton_block[NEWTON_D*NEWTON_D];
typedef double newton_stages[NEWTON_S*NEWTON_D];               /* [stage][component] */

typedef struct newton {
    int s, failed;
    newton_slope_fn *slope;
    newton_jacobian_fn *jacobian;
    double h, y[NEWTON_D], rest[NEWTON_D];
    double m[NEWTON_S][NEWTON_S], hb[NEWTON_S];
    double in[NEWTON_S][NEWTON_S], out[NEWTON_S][NEWTON_S], hxi[NEWTON_S];  /* to modes and back */
    newton_block J, at[NEWTON_S], factor[NEWTON_S];
    int pivot[NEWTON_S][NEWTON_D];
    long long evaluations, iterations;
} newton;

/* -------------------------------------------------------------- coefficients */

/* a_ij/b_j = sum over k of (2k+1) P_k(2 c_j - 1) times the integral of P_k from 0 to c_i */
static long double newton_share(int s, long double ci, long double cj)
{
    long double at[NEWTON_S + 2], of[NEWTON_S + 2], sum = ci;
    legendre(s + 1, 2*ci - 1, at);
    legendre(s + 1, 2*cj - 1, of);
    for (int k = 1; k < s; ++k) sum += (at[k + 1] - at[k - 1])/2*of[k];
    return sum;
}

static void newton_modes(newton *w, const long double *c, const long double *b)
{
    for (int i = 0; i < w->s; ++i) {
        long double P[NEWTON_S + 2];
        legendre(w->s, 2*c[i] - 1, P);
        for (int k = 0; k < w->s; ++k) {
            w->in[k][i] = (double)(sqrtl(2*k + 1)*P[k]);
            w->out[i][k] = (double)(b[i]*sqrtl(2*k + 1)*P[k]);
        }
    }
    for (int k = 1; k < w->s; ++k) w->hxi[k] = (double)(w->h/(2*sqrtl(4*k*k - 1)));
}

static void newton_begin(newton *w, int s, double h, newton_slope_fn *slope, newton_jacobian_fn *jacobian)
{
    long double c[NEWTON_S], b[NEWTON_S];
    double sum = 0;
    memset(w, 0, sizeof *w);
    w->s = s;
    w->h = h;
    w->slope = slope;
    w->jacobian = jacobian;
    gauss_nodes(s, c, b);
    newton_modes(w, c, b);
    for (int i = 0; i < s; ++i) {
        w->m[i][i] = 0.5;
        // 1 - m is exact for m in [1/2, 2]; beyond, m is that which is left of it
        for (int j = 0; j < i; ++j) {
            w->m[j][i] = 1 - (double)newton_share(s, c[i], c[j]);
            w->m[i][j] = 1 - w->m[j][i];
        }
    }
    for (int i = 1; i < s - 1; ++i) sum += w->hb[i] = (double)(h*b[i]);
    w->hb[0] = w->hb[s - 1] = (h - sum)/2;
}

/* ------------------------------------------------------------- linear algebra */

/* y += a M x */
static void newton_add(const double *M, double a, const double *x, double *y)
{
    for (int i = 0; i < NEWTON_D; ++i) {
        double sum = 0;
        for (int j = 0; j < NEWTON_D; ++j) sum += M[i*NEWTON_D + j]*x[j];
        y[i] += a*sum;
    }
}

/* PA = LU in place, partial pivoting */
static void newton_factor(double *A, int *pivot)
{
    const int d = NEWTON_D;
    for (int k = 0; k < d; ++k) {
        int p = k;
        for (int i = k + 1; i < d; ++i)
            if (fabs(A[i*d + k]) > fabs(A[p*d + k])) p = i;
        pivot[k] = p;
        for (int j = 0; j < d; ++j) { double t = A[k*d + j]; A[k*d + j] = A[p*d + j]; A[p*d + j] = t; }
        for (int i = k + 1; i < d; ++i) {
            A[i*d + k] /= A[k*d + k];
            for (int j = k + 1; j < d; ++j) A[i*d + j] -= A[i*d + k]*A[k*d + j];
        }
    }
}

static void newton_back(const double *A, const int *pivot, double *x)
{
    const int d = NEWTON_D;
    for (int k = 0; k < d; ++k) {
        double t = x[k];
        x[k] = x[pivot[k]];
        x[pivot[k]] = t;
    }
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < i; ++j) x[i] -= A[i*d + j]*x[j];
    for (int i = d; i-- > 0; ) {
        for (int j = i + 1; j < d; ++j) x[i] -= A[i*d + j]*x[j];
        x[i] /= A[i*d + i];
    }
}

/* Diagonal blocks of I - h X x J after elimination from the first mode on: I - h J/2, then
   I + (h xi_k)^2 J (block k-1)^-1 J; all of them commute with J, so J^2 is solved for        */
static void newton_blocks(newton *w)
{
    const int d = NEWTON_D;
    newton_block square = { 0 };
    for (int i = 0; i < d; ++i)
        for (int j = 0; j < d; ++j)
            for (int k = 0; k < d; ++k) square[i*d + j] += w->J[i*d + k]*w->J[k*d + j];
    for (int k = 0; k < w->s; ++k) {
        double *F = w->factor[k];
        for (int j = 0; j < d; ++j) {
            double column[NEWTON_D];
            for (int i = 0; i < d; ++i) column[i] = square[i*d + j];
            if (k) newton_back(w->factor[k - 1], w->pivot[k - 1], column);
            for (int i = 0; i < d; ++i)
                F[i*d + j] = (i == j) + (k ? w->hxi[k]*w->hxi[k]*column[i] : -w->h/2*w->J[i*d + j]);
        }
        newton_factor(F, w->pivot[k]);
    }
}

/* x = (I - h BAB^-1 x J)^-1 g */
static void newton_solve(newton *w, const double *g, double *x)
{
    const int d = NEWTON_D, s = w->s;
    newton_stages u = { 0 };
    for (int k = 0; k < s; ++k)
        for (int i = 0; i < s; ++i)
            for (int e = 0; e < d; ++e) u[k*d + e] += w->in[k][i]*g[i*d + e];
    for (int k = 0; k < s; ++k) {
        if (k) newton_add(w->J, w->hxi[k], u + (k - 1)*d, u + k*d);
        newton_back(w->factor[k], w->pivot[k], u + k*d);
    }
    for (int k = s - 1; k-- > 0; ) {
        double less[NEWTON_D] = { 0 };
        newton_add(w->J, w->hxi[k + 1], u + (k + 1)*d, less);
        newton_back(w->factor[k], w->pivot[k], less);
        for (int e = 0; e < d; ++e) u[k*d + e] -= less[e];
    }
    memset(x, 0, sizeof(newton_stages));
    for (int i = 0; i < s; ++i)
        for (int k = 0; k < s; ++k)
            for (int e = 0; e < d; ++e) x[i*d + e] += w->out[i][k]*u[k*d + e];
}

/* ------------------------------------------------------------------ the step */

/* Smallest change of each component so far, of values rounded to float; goes on while one falls
   below it, and once more then, unless nothing changes at all                                */
typedef struct newton_watch { newton_stages least; int once_more; } newton_watch;

static void newton_watch_begin(newton_watch *a)
{
    for (int i = 0; i < NEWTON_S*NEWTON_D; ++i) a->least[i] = HUGE_VAL;
    a->once_more = 0;
}

static int newton_goes_on(newton_watch *a, int count, const double *now, const double *before)
{
    int same = 0, falls = 0;
    for (int i = 0; i < count; ++i) {
        const double change = fabs((double)((float)now[i] - (float)before[i]));
        same += change == 0;
        if (change > 0 && change < a->least[i]) {
            a->least[i] = change;
            falls = 1;
        }
    }
    const int stop = !falls && (a->once_more || same == count);
    a->once_more = !falls;
    return !stop;
}

/* Y_i = y + sum_j m_ij L_j */
static void newton_stage(const newton *w, const double *L, int i, double *Y)
{
    for (int e = 0; e < NEWTON_D; ++e) {
        double sum = 0;
        for (int j = 0; j < w->s; ++j) sum += w->m[i][j]*L[j*NEWTON_D + e];
        Y[e] = w->y[e] + sum;
    }
}

/* g = h b f(Y) - L */
static void newton_residual(newton *w, const double *L, double *g)
{
    const int d = NEWTON_D, s = w->s;
    for (int i = 0; i < s; ++i) {
        double Y[NEWTON_D], f[NEWTON_D];
        newton_stage(w, L, i, Y);
        w->slope(Y, f);
        for (int e = 0; e < d; ++e) g[i*d + e] = w->hb[i]*f[e] - L[i*d + e];
    }
    w->evaluations += s;
}

/* What is left of g by dL: g - dL + h b J_i sum_j m_ij dL_j */
static void newton_left(const newton *w, const double *g, const double *dL, double *left)
{
    const int d = NEWTON_D, s = w->s;
    for (int i = 0; i < s; ++i) {
        double sum[NEWTON_D] = { 0 };
        for (int j = 0; j < s; ++j)
            for (int e = 0; e < d; ++e) sum[e] += w->m[i][j]*dL[j*d + e];
        for (int e = 0; e < d; ++e) left[i*d + e] = g[i*d + e] - dL[i*d + e];
        newton_add(w->at[i], w->hb[i], sum, left + i*d);
    }
}

enum { NEWTON_MOST = 100 };

/* dL with the Jacobians at the stages, from a dL near it */
static void newton_refine(newton *w, const double *g, double *dL)
{
    newton_watch watch;
    int round = 0, more = 1;
    newton_watch_begin(&watch);
    for (; more && round < NEWTON_MOST; ++round) {
        newton_stages left, x, before;
        memcpy(before, dL, sizeof before);
        newton_left(w, g, dL, left);
        newton_solve(w, left, x);
        for (int i = 0; i < w->s*NEWTON_D; ++i) dL[i] += x[i];
        more = newton_goes_on(&watch, w->s*NEWTON_D, dL, before);
    }
    w->failed |= more;
}

static void newton_advance(newton *w, const double *L, const double *dL)
{
    const int d = NEWTON_D, s = w->s;
    for (int e = 0; e < d; ++e) {
        double more = 0;
        for (int i = 0; i < s; ++i) more += dL[i*d + e];
        w->rest[e] += more;
        for (int k = 0; k < s; ++k) {                    // weights ascending: 0, s-1, 1, s-2 ...
            const int i = k % 2 ? s - 1 - k/2 : k/2;
            const double x = L[i*d + e] + w->rest[e], sum = w->y[e] + x;
            w->rest[e] = x - (sum - w->y[e]);
            w->y[e] = sum;
        }
    }
}

/* 1: L by simplified Newton; before, g, dL: of its last iteration */
static void newton_first(newton *w, double *L, double *before, double *g, double *dL)
{
    const int count = w->s*NEWTON_D;
    newton_watch watch;
    int round = 0, more = 1;
    newton_watch_begin(&watch);
    for (; more && round < NEWTON_MOST; ++round) {
        newton_residual(w, L, g);
        newton_solve(w, g, dL);
        memcpy(before, L, sizeof(newton_stages));
        for (int i = 0; i < count; ++i) L[i] += dL[i];
        more = newton_goes_on(&watch, count, L, before);
    }
    w->failed |= more;
    w->iterations += round;
}

static void newton_step(newton *w)
{
    const int d = NEWTON_D, s = w->s;
    newton_stages L = { 0 }, before, g, dL;
    w->jacobian(w->y, w->J);
    newton_blocks(w);
    newton_first(w, L, before, g, dL);
    for (int i = 0; i < s; ++i) {
        double Y[NEWTON_D];
        newton_stage(w, L, i, Y);
        w->jacobian(Y, w->at[i]);
    }
    newton_refine(w, g, dL);
    for (int i = 0; i < s*d; ++i) L[i] = before[i] + dL[i];
    newton_residual(w, L, g);
    for (int i = 0; i < s; ++i) newton_add(w->at[i], w->hb[i], w->rest, g + i*d);
    newton_solve(w, g, dL);
    newton_refine(w, g, dL);
    newton_advance(w, L, dL);
}

#endif
