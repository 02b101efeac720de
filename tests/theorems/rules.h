/* rules.h - quadrature rules and Runge-Kutta tables, written from their
   definitions, without gvi.h: for rules of the caller, and as expected values  */
#ifndef RULES_H
#define RULES_H

#include "reference.h"

enum { MAX_R = 12 };

typedef struct own_rule { const char *name; int r, u; real c[MAX_R], b[MAX_R]; } own_rule;

/* The library's rule of r points, or own nodes: these are refused beside one of the library's          */
static MAYBE gvi_rule rule_or_own(gvi_rule_kind kind, int r, const own_rule *own)
{
    int is_own = kind == GVI_OWN;
    return (gvi_rule){ kind, r, is_own ? own->c : NULL, is_own ? own->b : NULL };
}

/* What a rule of order u makes of degree s: theorem 4.1 where u >= 2s - 2, below that the law that
   docs/theory.md explains; 0: refused                                        */
static MAYBE int order_expected(int s, int u)
{
    int order = 2*s < u ? 2*s : u, weak = 2*(u - s + 1);
    return u < s ? 0 : u < 2*s - 2 && weak < order ? weak : order;
}

/* P_n and P_n' at x in (-1, 1) */
static MAYBE real legendre(int n, real x, real *slope_)
{
    real a = 1, b = x;
    if (n == 0) return *slope_ = 0, (real)1;
    for (int k = 2; k <= n; ++k) { real next = ((2*k - 1)*x*b - (k - 1)*a)/k; a = b; b = next; }
    *slope_ = n*(x*b - a)/(x*x - 1);
    return b;
}

/* P_n at a node c in [0,1] */
static MAYBE real mode_at(int n, real c)
{
    const real x = 2*c - 1;
    real unused;
    if (x*x < 1) return legendre(n, x, &unused);
    return x < 0 && n%2 ? -1 : 1;
}

/* Interpolatory weights on [0,1]: exact for Legendre polynomials of degree < r */
static MAYBE void weights_for(own_rule *rule)
{
    real A[MAX_R*MAX_R];
    int r = rule->r;
    for (int k = 0; k < r; ++k) {
        for (int i = 0; i < r; ++i) A[k*r + i] = mode_at(k, rule->c[i]);
        rule->b[k] = k == 0;
    }
    solve(r, A, rule->b);
}

/* Equal distances, ends included; order r, or r + 1 for odd r */
static MAYBE own_rule newton_cotes(int r)
{
    own_rule rule = { "Newton-Cotes", r, r + r%2, { 0 }, { 0 } };
    for (int i = 0; i < r; ++i) rule.c[i] = (real)i/(r - 1);
    weights_for(&rule);
    return rule;
}

static const MAYBE own_rule milne = { "Milne", 3, 4, { 0.25L, 0.5L, 0.75L }, { 2/3.0L, -1/3.0L, 2/3.0L } };

/* Extrema of Chebyshev polynomials; order as above */
static MAYBE own_rule clenshaw_curtis(int r)
{
    own_rule rule = { "Clenshaw-Curtis", r, r + r%2, { 0 }, { 0 } };
    for (int i = 0; i < r; ++i) { real x = sin(TAU*i/(real)(4*(r - 1))); rule.c[i] = x*x; }
    weights_for(&rule);
    return rule;
}

/* A zero of g = P_a + w P_b (w = 0: of P_a) by Newton's method, deflated by the
   zeros that are known and by (1 + x) if `end`                               */
static MAYBE real next_zero(int a, int b, int w, int end, const real *known, int count)
{
    real x = -0.99L, last = 1;
    for (int it = 0; it < 200 && fabs(last) > UNIT/8; ++it) {
        real da, db = 0, f = legendre(a, x, &da) + (w ? w*legendre(b, x, &db) : 0), s = (da + w*db)/f;
        if (!(fabs(f) > 0)) break;
        if (end) s -= 1/(1 + x);
        for (int k = 0; k < count; ++k) s -= 1/(x - known[k]);
        last = 1/s;
        x -= last;
    }
    return x;
}

/* Left Radau: -1 and the other zeros of P_{r-1} + P_r; order 2r - 1 */
static MAYBE own_rule radau(int r)
{
    own_rule rule = { "Radau", r, 2*r - 1, { 0 }, { 0 } };
    real x[MAX_R];
    for (int i = 0; i < r - 1; ++i) x[i] = next_zero(r, r - 1, 1, 1, x, i);
    for (int i = 1; i < r; ++i) rule.c[i] = (1 + x[i - 1])/2;
    weights_for(&rule);
    return rule;
}

/* Gauss, by the zeros of P_r; order 2r */
static MAYBE own_rule gauss(int r)
{
    own_rule rule = { "Gauss", r, 2*r, { 0 }, { 0 } };
    real x[MAX_R];
    for (int i = 0; i < r; ++i) x[i] = next_zero(r, 0, 0, 0, x, i);
    for (int i = 0; i < r; ++i) rule.c[i] = (1 + x[i])/2;
    weights_for(&rule);
    return rule;
}

/* Lobatto: the ends and the zeros of P_{r-1}', that is of (P_r - P_{r-2})/(1 - x^2) */
static MAYBE own_rule lobatto(int r)
{
    own_rule rule = { "Lobatto", r, 2*r - 2, { 0 }, { 0 } };
    real x[MAX_R];
    x[0] = 1;
    for (int i = 1; i < r - 1; ++i) x[i] = next_zero(r, r - 2, -1, 1, x, i);
    rule.c[r - 1] = 1;
    for (int i = 1; i < r - 1; ++i) rule.c[i] = (1 + x[i])/2;
    weights_for(&rule);
    return rule;
}

/* Collocation: a[i][j] = integral of the j-th Lagrange polynomial from 0 to c_i,
   that is, sum_j a_ij P_k(c_j) = integral of P_k from 0 to c_i, k < r; with P_k on
   [0,1], whose integral is (P_{k+1} - P_{k-1})/(2(2k+1)), 0 at c = 0.           */
static MAYBE void collocation(const own_rule *rule, real *a)
{
    int r = rule->r;
    for (int i = 0; i < r; ++i) {
        real A[MAX_R*MAX_R], unused, xi = 2*rule->c[i] - 1;
        for (int k = 0; k < r; ++k) {
            for (int j = 0; j < r; ++j) A[k*r + j] = mode_at(k, rule->c[j]);
            if (k == 0) a[i*r] = rule->c[i];
            else if (xi*xi < 1)
                a[i*r + k] = (legendre(k + 1, xi, &unused) - legendre(k - 1, xi, &unused))/(4*k + 2);
            else a[i*r + k] = 0;                         /* both ends */
        }
        solve(r, A, a + i*r);
    }
}

/* The partner of a symplectic pair: b_i ahat_ij + b_j a_ji = b_i b_j */
static MAYBE void partner(const own_rule *rule, const real *a, real *ahat)
{
    int r = rule->r;
    for (int i = 0; i < r; ++i)
        for (int j = 0; j < r; ++j) ahat[i*r + j] = rule->b[j] - rule->b[j]*a[j*r + i]/rule->b[i];
}

/* Least c with sum_i b_i |w(c_i)|^2 >= c * (integral of |w|^2), over velocities w of degree < s and mean 0: what a
   quadrature leaves of the action's coercivity.  By the power method on C - shift.                                */
static MAYBE real coercivity(const own_rule *rule, int s)
{
    const real shift = 10;                                   /* beyond all eigenvalues */
    real C[MAX_R*MAX_R], x[MAX_R], least = 0;
    for (int k = 1; k < s; ++k) {
        x[k] = 1/(real)k;
        for (int l = 1; l < s; ++l) {
            C[k*s + l] = 0;
            for (int i = 0; i < rule->r; ++i) C[k*s + l] += rule->b[i]*mode_at(k, rule->c[i])*mode_at(l, rule->c[i]);
            C[k*s + l] *= sqrt((real)((2*k + 1)*(2*l + 1)));
        }
    }
    for (int it = 0; it < 1000; ++it) {
        real y[MAX_R], size = 0;
        for (int k = 1; k < s; ++k) {
            y[k] = shift*x[k];
            for (int l = 1; l < s; ++l) y[k] -= C[k*s + l]*x[l];
            size += y[k]*y[k];
        }
        least = shift - sqrt(size);
        for (int k = 1; k < s; ++k) x[k] = y[k]/sqrt(size);
    }
    return least;
}

#endif
