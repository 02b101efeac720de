/* 37 - A Galerkin variational integrator by hand, from the public building blocks

   Ober-Bloebaum, Vermeeren, Superconvergence of Galerkin variational integrators,
   section 2.4.  The curve of a step is the polynomial of degree s through the control
   points x_0 = q0 .. x_s = q1, and any quadrature c_i, b_i makes of its action a sum:

     q(tau h) = sum_m l_m(tau) x_m          l_m: Lagrange basis at d_0 = 0 .. d_s = 1
     S = h sum_i b_i L(Q_i, V_i)            Q_i = sum_m l_m(c_i) x_m
                                            V_i = sum_m l_m'(c_i) x_m / h

   Inner control points make S stationary, and the ends give the momenta.  With
   S_m = dS/dx_m = sum_i b_i (h l_m(c_i) dL/dq + l_m'(c_i) dL/dv),

     S_0 = -p0          S_m = 0, 0 < m < s          p1 = S_s.

   The first s equations determine x_1 .. x_s: Newton's method, with dense LU.  Here for a
   pendulum, L = v^2/2 + cos q, compared with gvi_step over ten steps of 0.25.

   prints

     degree 4, 4 Gauss points:   q = -0.2439194843   within 100 eps of gvi_step: yes
     degree 4, 5 Lobatto points: q = -0.2439194843   within 100 eps of gvi_step: yes
     degree 2, Simpson's rule:   q = -0.2439186257   within 100 eps of gvi_step: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 8 };                    // control points and quadrature points, at most

typedef struct { int s, r; double c[MOST], b[MOST], l[MOST][MOST], dl[MOST][MOST]; } method;

/* S_m and its derivatives S_mk by the control points, all at once.            */
static void derivatives(const method *a, double h, const double *x, double *S, double S2[MOST][MOST])
{
    memset(S, 0, MOST*sizeof *S);
    memset(S2, 0, MOST*sizeof *S2);
    for (int i = 0; i < a->r; ++i) {
        double Q = 0, V = 0;
        for (int m = 0; m <= a->s; ++m) {
            Q += a->l[i][m]*x[m];
            V += a->dl[i][m]*x[m]/h;
        }
        const double *l = a->l[i], *dl = a->dl[i], dLdq = -sin(Q), dLdv = V, Lqq = -cos(Q), Lvv = 1;
        for (int m = 0; m <= a->s; ++m) {
            S[m] += a->b[i]*(h*l[m]*dLdq + dl[m]*dLdv);
            for (int k = 0; k <= a->s; ++k)
                S2[m][k] += a->b[i]*(h*l[m]*l[k]*Lqq + dl[m]*dl[k]*Lvv/h);
        }
    }
}

/* (q, p) at the beginning of a step becomes (q, p) at its end.                */
static void step(const method *a, double h, double *q, double *p)
{
    const int s = a->s;
    double x[MOST], S[MOST], S2[MOST][MOST], J[MOST*MOST], pivot[MOST + 1], rest[MOST];
    for (int m = 0; m <= s; ++m) x[m] = *q;
    for (int iteration = 0; iteration < 8; ++iteration) {  // each doubles the digits: to rounding
        derivatives(a, h, x, S, S2);
        S[0] += *p;
        for (int m = 0; m < s; ++m) {                      // S_m = 0, linearised in x_1 .. x_s
            rest[m] = -S[m];
            for (int k = 0; k < s; ++k) J[m*s + k] = S2[m][k + 1];
        }
        gvi_lu_factor(s, J, pivot);
        gvi_lu_solve(s, J, pivot, rest);
        for (int k = 0; k < s; ++k) x[k + 1] += rest[k];
    }
    derivatives(a, h, x, S, S2);
    *q = x[s];
    *p = S[s];
}

GVI_POINTS(gravity, 1, f)(const gvi_points *x, void *user)
{
    x->f[0] -= sin(x->q[0]);
    return (void)user, 0;
}

static void compare(const char *name, int s, int r, int lobatto)
{
    static double memory[GVI_LENGTH(1, MOST, MOST)];
    const double h = 0.25, q0 = 1, v0 = 0.5;
    method a = { .s = s, .r = r };
    double d[MOST], w[MOST];
    gvi_lobatto(s + 1, d, w);                              // control points: their weights are not used
    gvi_barycentric(s + 1, d, w);
    if (lobatto) gvi_lobatto(r, a.c, a.b);
    else gvi_gauss(r, a.c, a.b);
    for (int i = 0; i < r; ++i) {                          // l_m(c_i), l_m'(c_i)
        gvi_basis(s + 1, d, w, a.c[i], a.l[i]);
        gvi_basis_derivative(s + 1, d, w, a.c[i], a.dl[i]);
    }
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    const gvi_desc desc = { .n = 1, .degree = s, .effects = scene, .effect_count = 1,
                            .rule = { .kind = GVI_OWN, .points = r, .nodes = a.c, .weights = a.b } };
    gvi_stepper st;
    double q = q0, p = v0, apart = 0;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, &q0, &v0);
    for (int k = 0; k < 10; ++k) {
        step(&a, h, &q, &p);
        gvi_step(&st, h);
        apart = fmax(apart, fmax(fabs(q - st.q[0]), fabs(p - st.p[0])));
    }
    printf("%-27s q = %.10f   within 100 eps of gvi_step: %s\n", name, q,
           st.status == GVI_OK && apart < 100*DBL_EPSILON ? "yes" : "no");
}

int main(void)
{
    compare("degree 4, 4 Gauss points:", 4, 4, 0);
    compare("degree 4, 5 Lobatto points:", 4, 5, 1);
    compare("degree 2, Simpson's rule:", 2, 3, 1);
    return 0;
}
