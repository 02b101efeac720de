/* random.h - scenes of all kinds at random, and two references in long double that share nothing with gvi.h

   The motion itself: Hamilton's equations with multipliers that keep G v + dg/dt = 0 and A v + a = 0, by extrapolation.
   The equations of one step, (1) and (2) of gvi.h with those of CONSTRAINTS: Newton's method goes on from the curve that
   the step found; kicks by hand.                                                                       */
#ifndef RANDOM_H
#define RANDOM_H

#include "hard.h"
#include "gauss.h"

typedef long double L;
enum { N = 4, M = 2, S = 10, UNKNOWNS = 6*(N + M) };

/* V = sum k q^2/2 + a cos(q - o + phase) + push q sin(w t) - pull/sqrt(soft^2 + |q|^2), o the next coordinate
   L += sum (c q^2 + b o + e q o + d o cos(w t)) v + own v^2/2 + r cos(o) v^2/2 + u v^4/4
   f += sum - drag v - air v sqrt(1 + v^2) + turn o + drive cos(w t)
   M(q): m (1 + wave sin(o)/2) on the diagonal, side cos(q - o) beside it
   g = sum w q^2/2 + x sin(q) + z sin(w t) - level;   A = x + y cos(o) + z o, a = r sin(w t) - r0
   clock 1/2 + 2/5 sin(q_0 + phase)                                                              */
typedef struct row { double w[N], x[N], y[N], z[N], r, r0, level; } row;
typedef struct scene {
    int n, mass, potential, terms, force, clock, holonomic, rolling, timed, listed;
    gvi_real m[N], full[N*N];
    double k[N], a[N], phase[N], push[N], pull, soft, w;
    double c[N], b[N], e[N], d[N], r[N], u[N], own[N], drag[N], air[N], turn[N], drive[N], wave[N], side;
    row rows[2*M];
} scene;

static int next_of(const scene *z, int i) { return (i + 1) % z->n; }

/* Each adds to f what acts, to P what is dL/dv, and to fs and Ps the magnitudes of their terms */
typedef struct sums { L f[N], P[N], fs[N], Ps[N], value; } sums;
static void add_f(sums *s, int i, L x) { s->f[i] += x; s->fs[i] += fabsl(x); }
static void add_P(sums *s, int i, L x) { s->P[i] += x; s->Ps[i] += fabsl(x); }

static void potential_at(const scene *z, L t, const L *q, sums *s)
{
    L d2 = (L)z->soft*z->soft;
    for (int i = 0; i < z->n; ++i) d2 += q[i]*q[i];
    const L d = sqrtl(d2);
    for (int i = 0; i < z->n; ++i) {
        const int o = next_of(z, i);
        const L angle = q[i] - (o == i ? 0 : q[o]) + z->phase[i], pulse = z->push[i]*sinl(z->w*t);
        add_f(s, i, -z->k[i]*q[i]);
        add_f(s, i, z->a[i]*sinl(angle));
        if (o != i) add_f(s, o, -z->a[i]*sinl(angle));
        add_f(s, i, -pulse);
        add_f(s, i, -z->pull*q[i]/(d*d2));
        s->value += z->k[i]*q[i]*q[i]/2 + z->a[i]*cosl(angle) + pulse*q[i];
    }
    s->value -= z->pull/d;
}

static void terms_at(const scene *z, L t, const L *q, const L *v, sums *s)
{
    for (int i = 0; i < z->n; ++i) {
        const int o = next_of(z, i);
        const L beat = z->d[i]*cosl(z->w*t), A = z->c[i]*q[i]*q[i] + (z->b[i] + z->e[i]*q[i] + beat)*q[o], v2 = v[i]*v[i];
        add_P(s, i, z->c[i]*q[i]*q[i]);
        add_P(s, i, (z->b[i] + beat)*q[o]);
        add_P(s, i, z->e[i]*q[i]*q[o]);
        add_P(s, i, (z->own[i] + z->r[i]*cosl(q[o]))*v[i]);
        add_P(s, i, z->u[i]*v2*v[i]);
        add_f(s, i, (2*z->c[i]*q[i] + z->e[i]*q[o])*v[i]);
        add_f(s, o, (z->b[i] + z->e[i]*q[i] + beat)*v[i]);
        add_f(s, o, -z->r[i]*sinl(q[o])*v2/2);
        s->value += A*v[i] + (z->own[i] + z->r[i]*cosl(q[o]))*v2/2 + z->u[i]*v2*v2/4;
    }
}

static void force_at(const scene *z, L t, const L *q, const L *v, sums *s)
{
    for (int i = 0; i < z->n; ++i) {
        add_f(s, i, -z->drag[i]*v[i]);
        add_f(s, i, -z->air[i]*v[i]*sqrtl(1 + v[i]*v[i]));
        add_f(s, i, z->turn[i]*q[next_of(z, i)]);
        add_f(s, i, z->drive[i]*cosl(z->w*t));
    }
}

static void mass_at(const scene *z, const L *q, L *matrix)
{
    const int n = z->n;
    for (int i = 0; i < n*n; ++i) {
        const int diagonal = i/n == i%n;
        matrix[i] = z->mass == GVI_MASS_DENSE ? z->full[i] : z->mass == GVI_MASS_NONE || !diagonal ? 0
                  : z->mass == GVI_MASS_UNIT ? 1 : z->m[i/n];
    }
    if (z->mass != GVI_MASS_POSITION) return;
    for (int i = 0; i < n; ++i) {
        matrix[i*n + i] *= 1 + z->wave[i]*sinl(q[next_of(z, i)])/2;
        if (i + 1 < n) matrix[i*n + i + 1] = matrix[(i + 1)*n + i] = z->side*cosl(q[i] - q[i + 1]);
    }
}

static void gradient_at(const scene *z, const L *q, const L *v, sums *s)        /* v' dM/dq v/2 */
{
    if (z->mass != GVI_MASS_POSITION) return;
    for (int i = 0; i < z->n; ++i) {
        const int o = next_of(z, i);
        add_f(s, o, z->m[i]*z->wave[i]*cosl(q[o])*v[i]*v[i]/4);
        if (i + 1 == z->n) continue;
        add_f(s, i, -z->side*sinl(q[i] - q[i + 1])*v[i]*v[i + 1]);
        add_f(s, i + 1, z->side*sinl(q[i] - q[i + 1])*v[i]*v[i + 1]);
    }
}

static void row_at(const scene *z, const row *a, int rolls, L t, const L *q, L *g, L *G, L *rate)
{
    *g = -(L)a->level;
    *rate = 0;
    for (int i = 0; i < z->n; ++i) {
        const L o = q[next_of(z, i)];
        *g += a->w[i]*q[i]*q[i]/2 + a->x[i]*sinl(q[i]);
        G[i] = rolls ? a->x[i] + a->y[i]*cosl(o) + a->z[i]*o : a->w[i]*q[i] + a->x[i]*cosl(q[i]);
    }
    *g += a->r*sinl(z->w*t);
    *rate = rolls ? a->r*sinl(z->w*t) - a->r0 : a->r*z->w*cosl(z->w*t);
}

static int rows_of(const scene *z) { return z->holonomic + z->rolling; }
static void rows_at(const scene *z, L t, const L *q, L *g, L *G, L *rate)
{
    for (int a = 0; a < rows_of(z); ++a) row_at(z, z->rows + a, a >= z->holonomic, t, q, g + a, G + a*z->n, rate + a);
}

/* ------------------------------------------------------------- as gvi.h sees them */

static void column(const gvi_points *x, int k, L *q, L *v)
{
    for (int i = 0; i < x->n; ++i) {
        q[i] = x->q[i*x->stride + k];
        v[i] = x->v ? x->v[i*x->stride + k] : 0;
    }
}

static void give(const gvi_points *x, int k, const sums *s)
{
    for (int i = 0; i < x->n; ++i) {
        if (x->f) x->f[i*x->stride + k] += (gvi_real)s->f[i];
        if (x->dldv) x->dldv[i*x->stride + k] += (gvi_real)s->P[i];
    }
    if (x->value) x->value[k] += (gvi_real)s->value;
}

#define CALLBACK(name, what)                                    \
    static int name(const gvi_points *x, void *user)            \
    {                                                           \
        const scene *z = user;                                  \
        for (int k = 0; k < x->count; ++k) {                    \
            L q[N], v[N], t = x->t[k];                          \
            sums s = { { 0 }, { 0 }, { 0 }, { 0 }, 0 };         \
            column(x, k, q, v);                                 \
            what;                                               \
            give(x, k, &s);                                     \
            (void)t;                                            \
        }                                                       \
        return 0;                                               \
    }
CALLBACK(the_potential, potential_at(z, t, q, &s))
CALLBACK(the_terms, terms_at(z, t, q, v, &s))
CALLBACK(the_force, force_at(z, t, q, v, &s))
CALLBACK(the_gradient, gradient_at(z, q, v, &s))
CALLBACK(the_clock, (s.value = 0.5L + 0.4L*sinl(q[0] + z->phase[0]), s.f[0] = 0.4L*cosl(q[0] + z->phase[0])))

static int the_mass(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        L q[N] = { 0 }, v[N], matrix[N*N];
        column(x, k, q, v);
        mass_at(user, q, matrix);
        for (int i = 0; i < x->n; ++i)
            for (int j = 0; j <= i; ++j) x->mass[(i*x->n + j)*x->stride + k] = (gvi_real)matrix[i*x->n + j];
    }
    return 0;
}

static int write_rows(const gvi_points *x, const scene *z, int rolls)
{
    for (int k = 0; k < x->count; ++k)
        for (int a = 0; a < (rolls ? z->rolling : z->listed); ++a) {
            L q[N], v[N], g, G[N], rate;
            column(x, k, q, v);
            row_at(z, z->rows + (rolls ? z->listed : 0) + a, rolls, x->t[k], q, &g, G, &rate);
            if (!rolls) x->g[a*x->stride + k] = (gvi_real)g;
            x->rate[a*x->stride + k] = (gvi_real)rate;
            for (int i = 0; i < x->n; ++i) x->jacobian[(a*x->n + i)*x->stride + k] = (gvi_real)G[i];
        }
    return 0;
}
static int the_holonomic(const gvi_points *x, void *user) { return write_rows(x, user, 0); }
static int the_rolling(const gvi_points *x, void *user) { return write_rows(x, user, 1); }

static int list_effects(scene *z, gvi_effect *list)
{
    int count = 0;
    const gvi_effect all[] = {
        { .kind = GVI_POTENTIAL, .points = the_potential, .value = the_potential, .user = z },
        { .kind = GVI_LAGRANGIAN, .points = the_terms, .value = the_terms, .user = z },
        { .kind = GVI_FORCE, .points = the_force, .user = z },
        { .kind = GVI_CLOCK, .points = the_clock, .value = the_clock, .user = z },
        { .kind = GVI_CONSTRAINT, .points = the_holonomic, .rows = z->holonomic, .user = z },
        { .kind = GVI_NONHOLONOMIC, .points = the_rolling, .rows = z->rolling, .user = z } };
    const int there[] = { z->potential, z->terms, z->force, z->clock, z->holonomic, z->rolling };
    for (int e = 0; e < COUNT(all); ++e) if (there[e]) list[count++] = all[e];
    return count;
}

/* ------------------------------------------------------------- one point of the motion */

static void all_sums(const scene *z, L t, const L *q, const L *v, sums *s)
{
    const sums none = { { 0 }, { 0 }, { 0 }, { 0 }, 0 };
    L matrix[N*N];
    *s = none;
    if (z->potential) potential_at(z, t, q, s);
    if (z->terms) terms_at(z, t, q, v, s);
    if (z->force) force_at(z, t, q, v, s);
    gradient_at(z, q, v, s);
    mass_at(z, q, matrix);
    for (int i = 0; i < z->n; ++i)
        for (int j = 0; j < z->n; ++j) if (fabsl(matrix[i*z->n + j]) > 0) add_P(s, i, matrix[i*z->n + j]*v[j]);
}

/* A x = b by elimination with pivots, several right-hand sides [w][n]; the smallest pivot over the largest */
static L solve(int n, const L *A, int w, L *x)
{
    L B[UNKNOWNS*UNKNOWNS], least = 1e300L, most = 0;
    memcpy(B, A, sizeof *A*(size_t)(n*n));
    for (int k = 0; k < n; ++k) {
        int p = k;
        for (int i = k; i < n; ++i) if (fabsl(B[i*n + k]) > fabsl(B[p*n + k])) p = i;
        for (int j = 0; j < n; ++j) { const L y = B[k*n + j]; B[k*n + j] = B[p*n + j]; B[p*n + j] = y; }
        for (int j = 0; j < w; ++j) { const L y = x[j*n + k]; x[j*n + k] = x[j*n + p]; x[j*n + p] = y; }
        least = fminl(least, fabsl(B[k*n + k]));
        most = fmaxl(most, fabsl(B[k*n + k]));
        if (!(least > 0)) return 0;
        for (int i = k + 1; i < n; ++i) {
            const L f = B[i*n + k]/B[k*n + k];
            for (int j = k; j < n; ++j) B[i*n + j] -= f*B[k*n + j];
            for (int j = 0; j < w; ++j) x[j*n + i] -= f*x[j*n + k];
        }
    }
    for (int j = 0; j < w; ++j)
        for (int k = n; k-- > 0; ) {
            for (int i = k + 1; i < n; ++i) x[j*n + k] -= B[k*n + i]*x[j*n + i];
            x[j*n + k] /= B[k*n + k];
        }
    return n ? least/most : 1;
}

static void inertia_at(const scene *z, const L *q, const L *v, L *H)            /* d2L/dv2 */
{
    mass_at(z, q, H);
    if (z->terms)
        for (int i = 0; i < z->n; ++i)
            H[i*z->n + i] += z->own[i] + z->r[i]*cosl(q[next_of(z, i)]) + 3*z->u[i]*v[i]*v[i];
}

static void velocity_of(const scene *z, L t, const L *q, const L *p, L *v)
{
    const int nonlinear = z->terms && fabs(z->u[0]) > 0;
    for (int i = 0; i < z->n; ++i) v[i] = 0;
    for (int pass = 0; pass < (nonlinear ? 200 : 2); ++pass) {
        L H[N*N], d[N], moved = 0, size = 0;
        sums s;
        all_sums(z, t, q, v, &s);
        inertia_at(z, q, v, H);
        for (int i = 0; i < z->n; ++i) d[i] = p[i] - s.P[i];
        solve(z->n, H, 1, d);
        for (int i = 0; i < z->n; ++i) {
            v[i] += d[i];
            moved = fmaxl(moved, fabsl(d[i]));
            size = fmaxl(size, fabsl(v[i]));
        }
        if (pass && moved <= 1e-18L*size) break;
    }
}

static void slip_of(const scene *z, L t, const L *q, const L *p, L *slip)       /* G v + dg/dt, A v + a */
{
    L v[N], g[2*M], G[2*M*N], rate[2*M];
    velocity_of(z, t, q, p, v);
    rows_at(z, t, q, g, G, rate);
    for (int a = 0; a < rows_of(z); ++a) {
        slip[a] = rate[a];
        for (int i = 0; i < z->n; ++i) slip[a] += G[a*z->n + i]*v[i];
    }
}

/* The multipliers that keep the slip: its derivative along (1, v, F) by differences of order 8, and G (d2L/dv2)^-1 G'.
   `finer`: by how many halvings they are shorter than 1/64 of the time in which v would change by 1          */
static L multipliers_of(const scene *z, L t, const L *q, const L *p, const L *v, const L *F, const L *G, int finer, L *lambda)
{
    static const L weight[] = { 4/5.0L, -1/5.0L, 4/105.0L, -1/280.0L };
    const int n = z->n, m = rows_of(z);
    L Q[N] = { 0 }, P[N] = { 0 }, V[N], fast = 1, step = 1/1024.0L, H[N*N], X[2*M*N], gram[4*M*M], change[2*M] = { 0 };
    for (int i = 0; i < n; ++i) { Q[i] = q[i] + step*v[i]; P[i] = p[i] + step*F[i]; fast = fmaxl(fast, fabsl(v[i])); }
    velocity_of(z, t + step, Q, P, V);
    for (int i = 0; i < n; ++i) fast = fmaxl(fast, fabsl(V[i] - v[i])/step);
    step = ldexpl(1, -6 - finer)/fast;
    for (int k = 1; k <= 4; ++k)
        for (int side = -1; side <= 1; side += 2) {
            L slip[2*M];
            for (int i = 0; i < n; ++i) { Q[i] = q[i] + side*k*step*v[i]; P[i] = p[i] + side*k*step*F[i]; }
            slip_of(z, t + side*k*step, Q, P, slip);
            for (int a = 0; a < m; ++a) change[a] += side*weight[k - 1]*slip[a]/step;
        }
    inertia_at(z, q, v, H);
    memcpy(X, G, sizeof *X*(size_t)(m*n));
    solve(n, H, m, X);
    for (int a = 0; a < m; ++a) {
        lambda[a] = -change[a];
        for (int b = 0; b < m; ++b) {
            gram[a*m + b] = 0;
            for (int i = 0; i < n; ++i) gram[a*m + b] += G[a*n + i]*X[b*n + i];
        }
    }
    return solve(m, gram, 1, lambda);
}

typedef L real_;
#define real real_
#define EXTRAPOLATE_MOST 8
#include "extrapolate.h"
#undef real

static L worst_rank;                               /* smallest pivot of G M^-1 G' over the largest, since it was set to 1 */
static int finer_by = 4;                           /* how fine the differences are that give the multipliers */

static void rates_of(L t, const L *y, L *dy, void *user)
{
    const scene *z = user;
    const int n = z->n, m = rows_of(z);
    const L *q = y, *p = y + n;
    sums s;
    velocity_of(z, t, q, p, dy);
    all_sums(z, t, q, dy, &s);
    for (int i = 0; i < n; ++i) dy[n + i] = s.f[i];
    if (!m) return;
    L g[2*M], G[2*M*N], rate[2*M], lambda[2*M];
    rows_at(z, t, q, g, G, rate);
    worst_rank = fminl(worst_rank, multipliers_of(z, t, q, p, dy, s.f, G, finer_by, lambda));
    for (int a = 0; a < m; ++a)
        for (int i = 0; i < n; ++i) dy[n + i] += G[a*n + i]*lambda[a];
}

/* ------------------------------------------------------------- the equations of a step */

typedef struct rule { int r; L c[S + 2], b[S + 2]; } rule;

static void lobatto_nodes(int r, L *c, L *b)
{
    L P[LEGENDRE_MOST + 1];
    const int m = r - 1;
    for (int i = 0; i < r; ++i) {
        L u = cosl(3.14159265358979323846L*i/m);
        for (int k = 0; k < 60 && i > 0 && i < m; ++k) {        /* (1 - u^2) P_m' = m (P_(m-1) - u P_m) = 0 */
            legendre(m, u, P);
            u -= (P[m - 1] - u*P[m])/(-(m + 1)*P[m]);
        }
        legendre(m, u, P);
        c[i] = (1 - u)/2;
        b[i] = 1/(m*(m + 1)*P[m]*P[m]);
    }
}

static void modes(int s, L tau, L *phi, L *Phi)
{
    L P[LEGENDRE_MOST + 1];
    legendre(s + 1, 1 - 2*tau, P);
    for (int k = 0; k < s; ++k) {
        phi[k] = P[k];
        Phi[k] = k == 0 ? tau : (P[k - 1] - P[k + 1])/(2*(2*k + 1));
    }
}

typedef struct step { const scene *z; const rule *r; int s; L t0, h, q0[N], p0[N]; } step;
typedef struct outcome { L q[N], p[N], qs[N], ps[N], qr[N], pr[N]; } outcome;      /* ..s: terms, ..r: with what they move */

/* Rows of (1) and g(D_a), sizes of their terms, at modes y [s][n] and lambda [s][m]; q1, p1 */
static void step_rows(const step *a, const L *y, L *out, L *size, outcome *end)
{
    const scene *z = a->z;
    const int n = z->n, s = a->s, m = z->holonomic;
    L phi[S], Phi[S], impulse[N] = { 0 }, d[S + 1], w[S + 1];
    for (int i = 0; i < n*s + m*s; ++i) out[i] = size[i] = 0;
    for (int i = 0; i < n; ++i) {
        out[i] = -a->p0[i];
        size[i] = fabsl(a->p0[i]);
        end->q[i] = a->q0[i] + a->h*y[i];
        end->qs[i] = fabsl(a->q0[i]) + fabsl(a->h*y[i]);
        end->p[i] = a->p0[i];
        end->ps[i] = fabsl(a->p0[i]);
    }
    for (int j = 0; j < a->r->r; ++j) {
        L q[N], v[N];
        sums e;
        modes(s, a->r->c[j], phi, Phi);
        for (int i = 0; i < n; ++i) {
            q[i] = a->q0[i], v[i] = 0;
            for (int k = 0; k < s; ++k) { q[i] += a->h*Phi[k]*y[k*n + i]; v[i] += phi[k]*y[k*n + i]; }
        }
        all_sums(z, a->t0 + a->r->c[j]*a->h, q, v, &e);
        const L b = a->r->b[j], hb = a->h*b;
        for (int i = 0; i < n; ++i) {
            end->p[i] += hb*e.f[i];
            end->ps[i] += fabsl(hb)*e.fs[i];
            for (int k = 0; k < s; ++k) {
                const L W = (k == 0) - Phi[k];
                out[k*n + i] += b*phi[k]*e.P[i] - hb*W*e.f[i];
                size[k*n + i] += fabsl(b*phi[k])*e.Ps[i] + fabsl(hb*W)*e.fs[i];
            }
        }
    }
    if (!m) return;
    lobatto_nodes(s + 1, d, w);
    for (int e = 0; e <= s; ++e) {
        L q[N], g[2*M], G[2*M*N], rate[2*M];
        modes(s, d[e], phi, Phi);
        for (int i = 0; i < n; ++i) {
            q[i] = a->q0[i];
            for (int k = 0; k < s; ++k) q[i] += a->h*Phi[k]*y[k*n + i];
        }
        rows_at(z, a->t0 + d[e]*a->h, q, g, G, rate);
        for (int c = 0; c < m && e > 0; ++c) {
            out[n*s + (e - 1)*m + c] = g[c];
            size[n*s + (e - 1)*m + c] = fabsl((L)z->rows[c].level);
            for (int i = 0; i < n; ++i) size[n*s + (e - 1)*m + c] += fabsl(G[c*n + i]*q[i]);
        }
        for (int c = 0; c < m && e < s; ++c)
            for (int i = 0; i < n; ++i) {
                const L R = a->h*w[e]*G[c*n + i]*y[n*s + e*m + c];
                impulse[i] += R;
                end->ps[i] += fabsl(R);
                for (int k = 0; k < s; ++k) {
                    const L W = (k == 0) - Phi[k];
                    out[k*n + i] -= W*R;
                    size[k*n + i] += fabsl(W*R);
                }
            }
    }
    for (int i = 0; i < n; ++i) end->p[i] += impulse[i];
}

/* p1 += G' x such that G v + dg/dt = 0, by Newton's method: x is halved where G v + dg/dt would grow, as with v^4 */
static void end_rates(const step *a, outcome *end)
{
    const scene *z = a->z;
    const int n = z->n, m = z->holonomic;
    const L t = a->t0 + a->h;
    L g[2*M], G[2*M*N], rate[2*M], slip[2*M];
    rows_at(z, t, end->q, g, G, rate);
    slip_of(z, t, end->q, end->p, slip);
    for (int pass = 0; pass < 60 && m; ++pass) {
        L v[N], p[N], H[N*N], X[2*M*N], gram[4*M*M], x[2*M], before = 0, now = 0, share = 1;
        for (int c = 0; c < m; ++c) before = fmaxl(before, fabsl(x[c] = slip[c]));
        velocity_of(z, t, end->q, end->p, v);
        inertia_at(z, end->q, v, H);
        memcpy(X, G, sizeof *X*(size_t)(m*n));
        solve(n, H, m, X);
        for (int b = 0; b < m*m; ++b) {
            gram[b] = 0;
            for (int i = 0; i < n; ++i) gram[b] += G[b/m*n + i]*X[b%m*n + i];
        }
        solve(m, gram, 1, x);
        for (int k = 0; k < 20; ++k, share /= 2) {
            memcpy(p, end->p, sizeof p);
            for (int c = 0; c < m; ++c)
                for (int i = 0; i < n; ++i) p[i] -= share*G[c*n + i]*x[c];
            slip_of(z, t, end->q, p, slip);
            now = 0;
            for (int c = 0; c < m; ++c) now = fmaxl(now, fabsl(slip[c]));
            if (now < before) break;
        }
        if (!(now < before)) return;
        for (int i = 0; i < n; ++i) end->ps[i] += fabsl(p[i] - end->p[i]);
        memcpy(end->p, p, sizeof p);
    }
}

/* From modes near the solution to it: q1 and p1, and what rounding of the terms can move them; 0: no solution is near. */
static int solve_step(const step *a, L *y, outcome *end)
{
    const int n = a->z->n, s = a->s, m = a->z->holonomic, K = s*(n + m);
    static L J[UNKNOWNS*UNKNOWNS], X[UNKNOWNS*UNKNOWNS];
    L out[UNKNOWNS], size[UNKNOWNS], moved = 0, last = 1e300L;
    outcome other;
    for (int pass = 0; pass < 40; ++pass) {
        L large = 0, shift = 0;
        step_rows(a, y, out, size, end);
        if (pass % 4 == 0)
            for (int j = 0; j < K; ++j) {
                L there[UNKNOWNS], unused[UNKNOWNS], was = y[j], e = 1e-9L*(1 + fabsl(y[j]));
                y[j] += e;
                step_rows(a, y, there, unused, &other);
                y[j] = was;
                for (int i = 0; i < K; ++i) J[i*K + j] = (there[i] - out[i])/e;
            }
        L dy[UNKNOWNS];
        memcpy(dy, out, sizeof dy);
        if (!(solve(K, J, 1, dy) > 0)) return 0;
        for (int j = 0; j < K; ++j) {
            y[j] -= dy[j];
            if (j >= s*n) continue;                /* lambda is known to rounding/h^2 alone */
            shift = fmaxl(shift, fabsl(dy[j]));
            large = fmaxl(large, fabsl(y[j]));
        }
        moved = shift/(large + 1e-300L);
        if (!(moved < last/2) && moved <= (pass < 20 ? 1e-12L : 1e-9L)) break;       /* rounding is left */
        last = moved;
        if (pass == 39) return 0;
    }
    step_rows(a, y, out, size, end);
    memset(X, 0, sizeof X);
    for (int i = 0; i < K; ++i) X[i*K + i] = size[i];
    solve(K, J, K, X);                             /* what the rounding of row i moves */
    for (int i = 0; i < n; ++i) {
        L spread = 0;
        for (int j = 0; j < K; ++j) spread += fabsl(X[j*K + i]);
        end->qr[i] = fabsl(a->h)*spread;
        end->pr[i] = spread;
    }
    end_rates(a, end);
    return 1;
}

/* Kicks by hand */
static void kicks_by_hand(const step *a, outcome *end)
{
    const scene *z = a->z;
    const int n = z->n;
    L at = 0, H[N*N], v[N];
    for (int i = 0; i < n; ++i) {
        end->q[i] = a->q0[i], end->p[i] = a->p0[i];
        end->qs[i] = fabsl(a->q0[i]), end->ps[i] = fabsl(a->p0[i]);
    }
    for (int j = 0; j <= a->r->r; ++j) {
        const L to = j < a->r->r ? a->r->c[j] : 1, dt = (to - at)*a->h;
        const sums none = { { 0 }, { 0 }, { 0 }, { 0 }, 0 };
        sums s = none;
        mass_at(z, end->q, H);
        memcpy(v, end->p, sizeof v);
        solve(n, H, 1, v);
        for (int i = 0; i < n; ++i) { end->q[i] += dt*v[i]; end->qs[i] += fabsl(dt*v[i]); }
        at = to;
        if (j == a->r->r) break;
        if (z->potential) potential_at(z, a->t0 + at*a->h, end->q, &s);
        for (int i = 0; i < n; ++i) {
            end->p[i] += a->h*a->r->b[j]*s.f[i];
            end->ps[i] += fabsl(a->h*a->r->b[j])*s.fs[i];
        }
    }
}

#endif
