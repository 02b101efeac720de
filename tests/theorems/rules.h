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

static MAYBE int least(int a, int b) { return a < b ? a : b; }

/* What a rule of order u makes of degree s, as docs/theory.md proves it; 0: refused.  Of the velocity along the
   curve, and of the step: min(2s, u, 2(u - s + 1)).                          */
static MAYBE int velocity_expected(int s, int u) { return least(s, u - s + 1); }
static MAYBE int order_expected(int s, int u) { return u < s ? 0 : least(u, 2*velocity_expected(s, u)); }

/* P_n and, but at +-1, P_n' at x */
static MAYBE real legendre(int n, real x, real *slope_)
{
    real a = 1, b = x;
    if (n == 0) return *slope_ = 0, (real)1;
    for (int k = 2; k <= n; ++k) { real next = ((2*k - 1)*x*b - (k - 1)*a)/k; a = b; b = next; }
    *slope_ = n*(x*b - a)/(x*x - 1);
    return b;
}

/* P_n at a node c, 0 and 1 being the ends */
static MAYBE real mode_at(int n, real c)
{
    real unused;
    return legendre(n, 2*c - 1, &unused);
}

/* Weights that give `moment[k]` for the Legendre polynomial of degree k < r on [0,1], k > 0 */
static MAYBE void weights_of(own_rule *rule, const real *moment)
{
    real A[MAX_R*MAX_R];
    int r = rule->r;
    for (int k = 0; k < r; ++k) {
        for (int i = 0; i < r; ++i) A[k*r + i] = mode_at(k, rule->c[i]);
        rule->b[k] = k ? moment[k] : 1;
    }
    solve(r, A, rule->b);
}

/* Interpolatory weights: exact for degrees < r */
static MAYBE void weights_for(own_rule *rule)
{
    static const real exact[MAX_R];
    weights_of(rule, exact);
}

/* A rule of order u with r >= u nodes at random, spread over `wide` times [0,1] around its middle; where r > u the
   moments from u on are drawn too.  Weights come out with any sign.            */
static MAYBE own_rule random_rule(int r, int u, real wide)
{
    own_rule rule = { "random", r, u, { 0 }, { 0 } };
    unsigned seed = 1000u*(unsigned)r + (unsigned)u;
    real moment[MAX_R] = { 0 };
    for (int i = 0; i < 2*r; ++i) {
        seed = seed*1664525u + 1013904223u;
        const real x = (real)(seed >> 8)/16777216;
        if (i < r) rule.c[i] = 0.5L + wide*((i + 0.1L + 0.8L*x)/r - 0.5L);
        else if (i - r >= u) moment[i - r] = (x < 0.5L ? -1 : 1)*(0.01L + 0.02L*x);
    }
    weights_of(&rule, moment);
    return rule;
}

/* For s = 3 and 4: E_4 = -1/180 makes sum b phi_2^2 vanish.  With five nodes and s = 3 Gamma' is singular; with six and
   s = 4 the last entry of its inverse is 0.                                  */
static MAYBE own_rule rule_without_phi_2(int r)
{
    own_rule rule = random_rule(r, 4, 1);
    const real moment[MAX_R] = { 1, 0, 0, 0, -7/18.0L, r > 5 ? 0.02L : 0 };
    weights_of(&rule, moment);
    return rule;
}

/* ------------------------------------------------ the constant of docs/theory.md */

/* sum_i b_i c_i^k - 1/(k + 1): what the rule does wrong at degree k */
static MAYBE real defect(const own_rule *rule, int k)
{
    real sum = -1/(real)(k + 1);
    for (int i = 0; i < rule->r; ++i) {
        real power = rule->b[i];
        for (int j = 0; j < k; ++j) power *= rule->c[i];
        sum += power;
    }
    return sum;
}

/* Gamma' = sum_i b_i phi_k(c_i) phi_l(c_i), k, l = 1..s-1, in an array of (s-1)^2 */
static MAYBE void gamma_of(const own_rule *rule, int s, real *G)
{
    for (int k = 1; k < s; ++k)
        for (int l = 1; l < s; ++l) {
            real sum = 0;
            for (int i = 0; i < rule->r; ++i) sum += rule->b[i]*mode_at(k, rule->c[i])*mode_at(l, rule->c[i]);
            G[(k - 1)*(s - 1) + l - 1] = sum;
        }
}

/* The last entry of its inverse, X */
static MAYBE real last_of_inverse(const own_rule *rule, int s)
{
    real G[MAX_R*MAX_R], x[MAX_R] = { 0 };
    gamma_of(rule, s, G);
    x[s - 2] = 1;
    solve(s - 1, G, x);
    return x[s - 2];
}

static MAYBE real factorial(int n) { return n < 2 ? 1 : n*factorial(n - 1); }

/* kappa^2 X, for u < 2s - 2: L_d - L_exact = -kappa^2 X h^(2 sigma + 1) P^(sigma) . M^-1 P^(sigma)/2 + ... */
static MAYBE real weakness(const own_rule *rule, int s)
{
    const int u = rule->u;
    const real lead = factorial(2*s - 2)/(factorial(s - 1)*factorial(s - 1));
    const real kappa = lead*defect(rule, u)*(u + 1)/(s*factorial(velocity_expected(s, u)));
    return kappa*kappa*last_of_inverse(rule, s);
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

/* Of a symmetric matrix, by the power method on shift - C, no eigenvalue being above the largest sum of a row */
static MAYBE real least_eigenvalue(int n, const real *C)
{
    real x[MAX_R*MAX_N], shift = 0, found = 0;
    for (int k = 0; k < n; ++k) {
        real sum = 0;
        for (int l = 0; l < n; ++l) sum += fabs(C[k*n + l]);
        shift = fmax(shift, sum);
        x[k] = 1/(real)(k + 1);
    }
    for (int it = 0; it < 1000; ++it) {
        real y[MAX_R*MAX_N], size = 0;
        for (int k = 0; k < n; ++k) {
            y[k] = shift*x[k];
            for (int l = 0; l < n; ++l) y[k] -= C[k*n + l]*x[l];
            size += y[k]*y[k];
        }
        found = shift - sqrt(size);
        for (int k = 0; k < n; ++k) x[k] = y[k]/sqrt(size);
    }
    return found;
}

/* Least c with sum_i b_i |w(c_i)|^2 >= c * (integral of |w|^2), over velocities w of degree < s and mean 0: what a
   quadrature leaves of the action's coercivity.                               */
static MAYBE real coercivity(const own_rule *rule, int s)
{
    real C[MAX_R*MAX_R];
    gamma_of(rule, s, C);
    for (int k = 1; k < s; ++k)
        for (int l = 1; l < s; ++l) C[(k - 1)*(s - 1) + l - 1] *= sqrt((real)((2*k + 1)*(2*l + 1)));
    return least_eigenvalue(s - 1, C);
}

#endif
