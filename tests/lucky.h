/* lucky.h - random steps with terms linear in v, each against the same equations solved in long double

     L = sum_i m_i v_i^2/2 + (c_i q_i^2 + b_i q_o + e_i q_i q_o) v_i - k_i q_i^2/2,   o the other of two coordinates, if n = 2

   Degrees 1 to 8, Gauss's rule, everything else default.  The fixed point of such terms contracts by what is independent
   of the length of the step, or does not: there changes can be small by chance.  Newton's method in long double goes on
   from the curve of the step to the solution of (1) in gvi.h; what it moves q1 and p1 is the error of the step. */
#ifndef LUCKY_H
#define LUCKY_H

#include "gauss.h"

enum { LUCKY_MOST = 16 };                         /* 2 coordinates, degree 8 */

typedef struct lucky { int n; gvi_real m[2], c[2], b[2], e[2], k[2]; } lucky;

typedef struct lucky_rule { int s; long double c[8], b[8], phi[8][8], Phi[8][8]; } lucky_rule;

static int lucky_terms(const gvi_points *x, void *user)
{
    const lucky *z = user;
    for (int i = 0; i < x->n; ++i) {
        const gvi_real *q = x->q + i*x->stride, *o = x->q + (x->n - 1 - i)*x->stride, *v = x->v + i*x->stride;
        gvi_real *f = x->f + i*x->stride, *g = x->f + (x->n - 1 - i)*x->stride, *A = x->dldv + i*x->stride;
        const gvi_real two = x->n > 1 ? 1 : 0;
        for (int k = 0; k < x->count; ++k) {
            f[k] += (2*z->c[i]*q[k] + two*z->e[i]*o[k])*v[k] - z->k[i]*q[k];
            g[k] += two*(z->b[i] + z->e[i]*q[k])*v[k];
            A[k] += z->c[i]*q[k]*q[k] + two*(z->b[i] + z->e[i]*q[k])*o[k];
        }
    }
    return 0;
}

static void lucky_make_rule(lucky_rule *r, int s)
{
    long double P[LEGENDRE_MOST + 1];
    r->s = s;
    gauss_nodes(s, r->c, r->b);
    for (int j = 0; j < s; ++j) {
        legendre(s + 1, 1 - 2*r->c[j], P);
        for (int k = 0; k < s; ++k) {
            r->phi[k][j] = P[k];
            r->Phi[k][j] = k == 0 ? r->c[j] : (P[k - 1] - P[k + 1])/(2*(2*k + 1));
        }
    }
}

/* Rows of (1) at the modes y, their terms' magnitudes, and derivatives J; the sums of h b F to `push`. */
static void lucky_rows(const lucky *z, const lucky_rule *r, long double h, const gvi_real *q0, const gvi_real *p0,
                       const long double *y, long double *row, long double *size, long double *J, long double *push)
{
    const int n = z->n, s = r->s, N = n*s;
    for (int i = 0; i < N; ++i) row[i] = i < n ? -p0[i] : 0, size[i] = fabsl(row[i]);
    for (int i = 0; i < N*N; ++i) J[i] = 0;
    for (int i = 0; i < n; ++i) push[i] = push[n + i] = 0;
    for (int j = 0; j < s; ++j) {
        long double q[2] = { 0, 0 }, v[2] = { 0, 0 }, f[2] = { 0, 0 }, P[2], Fq[2][2] = { { 0 } }, Fv[2][2] = { { 0 } },
                    fs[2] = { 0, 0 }, ps[2];
        for (int i = 0; i < n; ++i) {
            for (int k = 0; k < s; ++k) v[i] += r->phi[k][j]*y[k*n + i], q[i] += h*r->Phi[k][j]*y[k*n + i];
            q[i] += q0[i];
        }
        for (int i = 0, o = n - 1; i < n; ++i, --o) {
            const long double two = n > 1, slope = 2*z->c[i]*q[i] + two*z->e[i]*q[o], across = two*(z->b[i] + z->e[i]*q[i]);
            f[i] += slope*v[i] - z->k[i]*q[i];
            fs[i] += fabsl(slope*v[i]) + fabsl(z->k[i]*q[i]);
            f[o] += across*v[i];
            fs[o] += fabsl(across*v[i]);
            P[i] = z->m[i]*v[i] + z->c[i]*q[i]*q[i] + across*q[o];
            ps[i] = fabsl(z->m[i]*v[i]) + fabsl(z->c[i]*q[i]*q[i]) + fabsl(across*q[o]);
            Fq[i][i] += 2*z->c[i]*v[i] - z->k[i];
            Fv[i][i] += slope;                                  /* dP_i/dq_j is Fv_ji */
            if (n == 1) continue;
            Fq[i][o] += z->e[i]*v[i];
            Fq[o][i] += z->e[i]*v[i];
            Fv[o][i] += across;
        }
        for (int i = 0; i < n; ++i) push[i] += h*r->b[j]*f[i], push[n + i] += fabsl(h*r->b[j])*fs[i];
        for (int k = 0; k < s; ++k)
            for (int i = 0; i < n; ++i) {
                const long double W = (k == 0) - r->Phi[k][j], a = r->b[j]*r->phi[k][j], w = h*r->b[j]*W;
                row[k*n + i] += a*P[i] - w*f[i];
                size[k*n + i] += fabsl(a)*ps[i] + fabsl(w)*fs[i];
                for (int l = 0; l < s; ++l)
                    for (int o = 0; o < n; ++o) {
                        const long double by_v = r->phi[l][j], by_q = h*r->Phi[l][j];
                        J[(k*n + i)*N + l*n + o] += a*((i == o)*z->m[i]*by_v + Fv[o][i]*by_q) - w*(Fv[i][o]*by_v + Fq[i][o]*by_q);
                    }
            }
    }
}

/* A := A^-1, Gauss and Jordan; 0 if a pivot is 0 */
static int lucky_invert(int N, long double *A)
{
    int swapped[LUCKY_MOST];
    for (int k = 0; k < N; ++k) {
        int m = k;
        for (int i = k; i < N; ++i) if (fabsl(A[i*N + k]) > fabsl(A[m*N + k])) m = i;
        swapped[k] = m;
        for (int j = 0; j < N; ++j) { const long double x = A[k*N + j]; A[k*N + j] = A[m*N + j]; A[m*N + j] = x; }
        const long double pivot = A[k*N + k];
        if (!(fabsl(pivot) > 0)) return 0;
        A[k*N + k] = 1;
        for (int j = 0; j < N; ++j) A[k*N + j] /= pivot;
        for (int i = 0; i < N; ++i) {
            if (i == k) continue;
            const long double x = A[i*N + k];
            A[i*N + k] = 0;
            for (int j = 0; j < N; ++j) A[i*N + j] -= x*A[k*N + j];
        }
    }
    for (int k = N; k-- > 0; )
        for (int i = 0; i < N; ++i) { const long double x = A[i*N + k]; A[i*N + k] = A[i*N + swapped[k]]; A[i*N + swapped[k]] = x; }
    return 1;
}

/* The error of q1, relative to the largest |q0| and way, and what the rounding of the terms of (1) explains of it; -1: no
   solution is near.  V [n][s]: the velocities of the curve at the nodes. */
static long double lucky_error(const lucky *z, const lucky_rule *r, long double h, const gvi_real *q0, const gvi_real *p0,
                               const gvi_real *q1, const gvi_real *V, long double *explained)
{
    const int n = z->n, s = r->s, N = n*s;
    long double y[LUCKY_MOST], row[LUCKY_MOST], size[LUCKY_MOST], J[LUCKY_MOST*LUCKY_MOST], push[4], unit = 0, error = 0;
    for (int k = 0; k < s; ++k)
        for (int i = 0; i < n; ++i) {
            y[k*n + i] = 0;
            for (int j = 0; j < s; ++j) y[k*n + i] += (2*k + 1)*r->b[j]*r->phi[k][j]*V[i*s + j];
        }
    long double before = LDBL_MAX;
    for (int pass = 0; ; ++pass) {
        long double moved = 0, large = 0;
        lucky_rows(z, r, h, q0, p0, y, row, size, J, push);
        if (!lucky_invert(N, J)) return -1;
        for (int i = 0; i < N; ++i) {
            long double d = 0;
            for (int j = 0; j < N; ++j) d += J[i*N + j]*row[j];
            y[i] -= d;
            moved = fmaxl(moved, fabsl(d));
            large = fmaxl(large, fabsl(y[i]));
        }
        if (moved <= 1e-9L*large && !(moved < before/2)) break;          /* rounding is left */
        if (pass == 30) return -1;
        before = moved;
    }
    *explained = 0;
    for (int i = 0; i < n; ++i) unit = fmaxl(unit, fmaxl(fabsl(q0[i]), fabsl(h*y[i])));
    for (int i = 0; i < n; ++i) {
        long double rounding = 0;
        for (int j = 0; j < N; ++j) rounding += fabsl(J[i*N + j])*size[j];
        *explained = fmaxl(*explained, DBL_EPSILON*fabsl(h)*rounding/unit);
        error = fmaxl(error, fabsl(q1[i] - (q0[i] + h*y[i]))/unit);
    }
    return error;
}

static unsigned long long lucky_seed = 1;
static double lucky_unit(void)                    /* in (0,1) */
{
    lucky_seed = lucky_seed*6364136223846793005ULL + 1442695040888963407ULL;
    return ((double)(lucky_seed >> 33) + 0.5)/2147483648.0;
}
static gvi_real lucky_log(double low, double high)        /* of either sign, its magnitude between low and high */
{
    const double x = low*pow(high/low, lucky_unit());
    return (gvi_real)(lucky_unit() < 0.5 ? -x : x);
}

typedef struct lucky_found { long steps, ok, wrong; long double worst; } lucky_found;

/* Scenes of at most 8 steps, until there are so many.  Wrong: off by more than 1e-13 and 200 times what the rounding of
   the equations explains. */
static void lucky_run(long steps, lucky_found *found)
{
    static gvi_real memory[GVI_LENGTH(2, 8, 8)];
    static lucky_rule rules[9];
    for (int s = 1; s <= 8; ++s) lucky_make_rule(rules + s, s);
    const lucky_found none = { 0, 0, 0, 0 };
    *found = none;
    while (found->steps < steps) {
        lucky z = { 1 + (lucky_unit() < 0.5), { 0 }, { 0 }, { 0 }, { 0 }, { 0 } };
        gvi_real q[2], v[2];
        const int s = 1 + (int)(8*lucky_unit());
        for (int i = 0; i < 2; ++i) {
            z.m[i] = (gvi_real)fabs((double)lucky_log(0.01, 10));
            z.c[i] = lucky_log(0.01, 3);
            z.b[i] = lucky_log(0.01, 3);
            z.e[i] = lucky_unit() < 0.5 ? 0 : lucky_log(0.01, 1);
            z.k[i] = lucky_unit() < 0.5 ? 0 : lucky_log(0.01, 1);
            q[i] = lucky_log(0.1, 4);
            v[i] = lucky_log(0.1, 4);
        }
        const gvi_real h = lucky_log(0.003, 2);
        const gvi_effect scene[] = { { .kind = GVI_LAGRANGIAN, .points = lucky_terms, .user = &z } };
        const gvi_desc desc = { .n = z.n, .degree = s, .effects = scene, .effect_count = 1,
                                .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = z.m } };
        gvi_stepper st;
        gvi_init(&st, &desc, memory, sizeof memory);
        gvi_start(&st, 0, q, v);
        for (int k = 0; k < 8 && st.status == GVI_OK && found->steps < steps; ++k) {
            gvi_real q0[2] = { 0, 0 }, p0[2] = { 0, 0 }, V[LUCKY_MOST], Q[2], W[2];
            long double explained = 0;
            for (int i = 0; i < z.n; ++i) q0[i] = st.q[i], p0[i] = st.p[i];
            ++found->steps;
            if (gvi_step(&st, h) != GVI_OK) break;
            ++found->ok;
            for (int j = 0; j < s; ++j) {
                gvi_curve(&st, (gvi_real)rules[s].c[j], Q, W);
                for (int i = 0; i < z.n; ++i) V[i*s + j] = W[i];
            }
            const long double error = lucky_error(&z, rules + s, h, q0, p0, st.q, V, &explained);
            if (error >= 0 && error <= 1e-13L + 200*explained) {
                found->worst = fmaxl(found->worst, error/(explained + DBL_EPSILON));
                continue;
            }
            ++found->wrong;
            if (found->wrong <= 5)
                printf("  degree %d, h %.17g, n %d, step %d: off by %.2Lg, explained %.2Lg; formulation %d, iterations %d\n", s,
                       (double)h, z.n, k, error, explained, st.formulation, st.iterations);
        }
    }
}

#endif
