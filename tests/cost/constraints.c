/* constraints.c - what a constrained state costs: gvi.h, RATTLE and its compositions, DOP853 projected

   Two rods in Cartesian coordinates (n = 4, m = 2) and a heavy top in directors (n = 9, m = 6), to T = 10,
   against states to 28 digits. RATTLE is written for each: M^-1 in closed form, Newton's method with the
   exact matrix for the rods, for the top with the diagonal that orthonormal directors leave; multipliers
   predicted by those of the stage before; the momentum projected once a step, since within a composition
   the next stage does not feel it. DOP853 integrates index-1 equations, the top's in quaternion and body
   rates, with fixed steps, and projects after each; it keeps no structure. CPU time, best of several.

   Then many constraints: chains of rods and molecules of water, whose G M^-1 G' is sparse, CPU time per
   step; and a chain of 200 rods to T = 10 against RATTLE with a tridiagonal matrix.

     constraints [--out DIR]  prints the tables; with DIR draws the runs in them, DIR/constraints.svg
     constraints --many       only the part of many constraints                                         */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"
typedef gvi_real real;
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "linkages.h"
#include "coefficients.h"
#include "tools/svg.h"

static const double rods_end[4] = { 0.9717130808687679340841202356, -0.2361645368562504330536795036,
                                    1.6219338957314591733328457283, -0.9959098178019749018726361532 };
static const double top_end[9] = { -0.416343706154668577187138345341149, -0.115056788854345004103443568458648,
    -0.901897917551604982060428490290107, -0.0882014446436753847585884344086695, -0.982171014486001291745432377154461,
    0.166013865283318150641957197023671, -0.904919014889268228322007054922296, 0.148667527194292540180369712771377,
    0.398772545255776898420060751163816 };

/* ---- compositions of RATTLE ---- */

static const double one_stage[] = { 1 }, yoshida4[] = { 1.35120719195965763405, -1.70241438391931526810, 1.35120719195965763405 };
static const double kahan_li6[] = { 0.39216144400731413927925056, 0.33259913678935943859974864, -0.70624617255763935980996482,
    0.08221359629355080023149045, 0.79854399093482996339895035, 0.08221359629355080023149045, -0.70624617255763935980996482,
    0.33259913678935943859974864, 0.39216144400731413927925056 };
static double kahan_li8_all[17];

/* v = M^-1 p of the rods, 6/7 (2, -1; -1, 4) of each direction */
static inline void rods_velocity(const double *p, double *v)
{
    for (int i = 0; i < 2; ++i) {
        v[i] = (12*p[i] - 6*p[i + 2])/7;
        v[i + 2] = (24*p[i + 2] - 6*p[i])/7;
    }
}

static void rattle_rods(const double *gamma, int stages, double h, int steps, double *q, double *p)
{
    double y0 = 0, y1 = 0;
    for (int k = 0; k < steps*stages; ++k) {
        const double d = h*gamma[k % stages], X = q[0], Y = q[1], A = q[2] - X, B = q[3] - Y;
        double v[4], G0[4] = { X, Y, 0, 0 }, G1[4] = { -A, -B, A, B }, W0[4], W1[4], r0, r1;
        p[1] -= d/2;
        p[3] -= d/4;
        rods_velocity(p, v);
        rods_velocity(G0, W0);
        rods_velocity(G1, W1);
        double free[4];
        for (int i = 0; i < 4; ++i) free[i] = q[i] + d*v[i];
        y0 *= d, y1 *= d;                         // mu in units of the stage
        for (int j = 0; j < 20; ++j) {
            for (int i = 0; i < 4; ++i) q[i] = free[i] + d*(y0*W0[i] + y1*W1[i]);
            const double a = q[2] - q[0], b = q[3] - q[1];
            r0 = (q[0]*q[0] + q[1]*q[1] - 1)/2;
            r1 = (a*a + b*b - 1)/2;
            if (fabs(r0) < 2e-16 && fabs(r1) < 2e-16) break;
            const double m00 = q[0]*W0[0] + q[1]*W0[1], m01 = q[0]*W1[0] + q[1]*W1[1];
            const double m10 = a*(W0[2] - W0[0]) + b*(W0[3] - W0[1]), m11 = a*(W1[2] - W1[0]) + b*(W1[3] - W1[1]);
            const double det = d*(m00*m11 - m01*m10), s0 = (m11*r0 - m01*r1)/det, s1 = (m00*r1 - m10*r0)/det;
            y0 -= s0;
            y1 -= s1;
            if (fabs(s0*d) + fabs(s1*d) < 2e-16) break;
        }
        for (int i = 0; i < 4; ++i) p[i] += y0*G0[i] + y1*G1[i];
        y0 /= d, y1 /= d;
        p[1] -= d/2;
        p[3] -= d/4;
    }
}

/* D = (d1, d2, d3), E = (1/4, 1/4, 3/4), weight on d3z; G M^-1 G' of orthonormal directors is diagonal */
static void rattle_top(const double *gamma, int stages, double h, int steps, double *q, double *p)
{
    static const double w[3] = { 4, 4, 4/3.0 };
    double L[3][3] = { { 0 } };
    for (int k = 0; k < steps*stages; ++k) {
        const double d = h*gamma[k % stages];
        double old[9], free[9];
        p[8] -= d/2;
        memcpy(old, q, sizeof old);
        for (int i = 0; i < 9; ++i) free[i] = q[i] + d*w[i/3]*p[i];
        for (int a = 0; a < 9; ++a) L[a/3][a%3] *= d;
        for (int j = 0; j < 40; ++j) {
            double most = 0;
            for (int a = 0; a < 3; ++a)
                for (int i = 0; i < 3; ++i)
                    q[3*a + i] = free[3*a + i] + d*w[a]*(L[a][0]*old[i] + L[a][1]*old[3 + i] + L[a][2]*old[6 + i]);
            for (int a = 0; a < 3; ++a)
                for (int b = a; b < 3; ++b) {
                    const double r = q[3*a]*q[3*b] + q[3*a + 1]*q[3*b + 1] + q[3*a + 2]*q[3*b + 2] - (a == b);
                    const double s = r/(d*(w[a] + w[b]));
                    most = fabs(r) > most ? fabs(r) : most;
                    L[a][b] = L[b][a] = L[a][b] - s;
                }
            if (most < 4e-16) break;
        }
        for (int a = 0; a < 3; ++a)
            for (int i = 0; i < 3; ++i) p[3*a + i] += L[a][0]*old[i] + L[a][1]*old[3 + i] + L[a][2]*old[6 + i];
        for (int a = 0; a < 9; ++a) L[a/3][a%3] /= d;
        p[8] -= d/2;
    }
}

/* ---- DOP853 ---- */

static double table_a[12][12], table_b[12];

static inline void rods_slope(const double *y, double *dy)
{
    const double X = y[0], Y = y[1], A = y[2] - X, B = y[3] - Y, *v = y + 4, a = v[2] - v[0], b = v[3] - v[1];
    const double G0[4] = { X, Y, 0, 0 }, G1[4] = { -A, -B, A, B };
    double W0[4], W1[4];
    rods_velocity(G0, W0);
    rods_velocity(G1, W1);
    const double m00 = X*W0[0] + Y*W0[1], m01 = X*W1[0] + Y*W1[1], m11 = A*(W1[2] - W1[0]) + B*(W1[3] - W1[1]);
    const double f1 = -9/7.0, f3 = -6/7.0;        // M^-1 (-1, -1/2): (12 (-1) - 6 (-1/2))/7, (24 (-1/2) + 6)/7
    const double r0 = -(v[0]*v[0] + v[1]*v[1]) - Y*f1, r1 = -(a*a + b*b) - B*(f3 - f1), det = m00*m11 - m01*m01;
    const double y0 = (m11*r0 - m01*r1)/det, y1 = (m00*r1 - m01*r0)/det;
    for (int i = 0; i < 4; ++i) {
        dy[i] = v[i];
        dy[4 + i] = y0*W0[i] + y1*W1[i];
    }
    dy[5] += f1;
    dy[7] += f3;
}

static inline void rods_project(double *y)
{
    double W0[4], W1[4], *v = y + 4;
    for (int pass = 0; pass < 2; ++pass) {        // q, then v; one Newton step from an error of h^9
        const double X = y[0], Y = y[1], A = y[2] - X, B = y[3] - Y, G0[4] = { X, Y, 0, 0 }, G1[4] = { -A, -B, A, B };
        rods_velocity(G0, W0);
        rods_velocity(G1, W1);
        const double m00 = X*W0[0] + Y*W0[1], m01 = X*W1[0] + Y*W1[1], m11 = A*(W1[2] - W1[0]) + B*(W1[3] - W1[1]);
        const double r0 = pass ? X*v[0] + Y*v[1] : (X*X + Y*Y - 1)/2;
        const double r1 = pass ? A*(v[2] - v[0]) + B*(v[3] - v[1]) : (A*A + B*B - 1)/2, det = m00*m11 - m01*m01;
        const double y0 = (m11*r0 - m01*r1)/det, y1 = (m00*r1 - m01*r0)/det;
        for (int i = 0; i < 4; ++i) (pass ? v : y)[i] -= y0*W0[i] + y1*W1[i];
    }
}

/* quaternion, body rates: inertia (1, 1, 1/2), V = q0^2 - q1^2 - q2^2 + q3^2 */
static inline void top_slope(const double *y, double *dy)
{
    const double a = y[0], b = y[1], c = y[2], d = y[3], w1 = y[4], w2 = y[5], w3 = y[6];
    dy[0] = -(b*w1 + c*w2 + d*w3)/2;
    dy[1] = (a*w1 + c*w3 - d*w2)/2;
    dy[2] = (a*w2 + d*w1 - b*w3)/2;
    dy[3] = (a*w3 + b*w2 - c*w1)/2;
    dy[4] = 2*(a*b + c*d) + w2*w3/2;              // torque -dV along q e_i/2, and (I2 - I3) w2 w3
    dy[5] = 2*(a*c - b*d) - w1*w3/2;
    dy[6] = 0;
}

static inline void top_project(double *y)
{
    const double n = 1/sqrt(y[0]*y[0] + y[1]*y[1] + y[2]*y[2] + y[3]*y[3]);
    for (int i = 0; i < 4; ++i) y[i] *= n;
}

#define DOP853(name, size, slope, project)                                                      \
    static void name(double h, int steps, double *y)                                            \
    {                                                                                           \
        double K[12][size], x[size];                                                            \
        for (int k = 0; k < steps; ++k) {                                                       \
            for (int i = 0; i < 12; ++i) {                                                      \
                memcpy(x, y, sizeof x);                                                         \
                for (int j = 0; j < i; ++j)                                                     \
                    for (int c = 0; c < size && fabs(table_a[i][j]) > 0; ++c) x[c] += h*table_a[i][j]*K[j][c]; \
                slope(x, K[i]);                                                                 \
            }                                                                                   \
            for (int j = 0; j < 12; ++j)                                                        \
                for (int c = 0; c < size; ++c) y[c] += h*table_b[j]*K[j][c];                    \
            project(y);                                                                         \
        }                                                                                       \
    }
DOP853(dop853_rods, 8, rods_slope, rods_project)
DOP853(dop853_top, 7, top_slope, top_project)

/* ---- gvi.h: the callbacks as loops over points ---- */

static int fast_weight(const gvi_points *x, void *user)
{
    const int row = *(const int *)user;
    for (int k = 0; k < x->count; ++k) x->f[row*x->stride + k] -= 1;
    for (int k = 0; row == 1 && k < x->count; ++k) x->f[3*x->stride + k] -= 0.5;
    return 0;
}

static int fast_rods(const gvi_points *x, void *user)
{
    const int R = x->stride;
    const double *restrict X = x->q, *restrict Y = X + R, *restrict U = Y + R, *restrict W = U + R;
    double *restrict g = x->g, *restrict G = x->jacobian;
    for (int k = 0; k < R; ++k) {
        const double a = U[k] - X[k], b = W[k] - Y[k];
        g[k] = (X[k]*X[k] + Y[k]*Y[k] - 1)/2;
        g[R + k] = (a*a + b*b - 1)/2;
        G[k] = X[k], G[R + k] = Y[k];
        G[4*R + k] = -a, G[5*R + k] = -b, G[6*R + k] = a, G[7*R + k] = b;
    }
    return (void)user, 0;
}

/* ---- the table ---- */

enum { GVI4, GVI8, GVI12, RATTLE1, YOSHIDA, LI6, LI8, PROJECTED, METHODS };
static const char *const names[] = { "gvi.h, s = 4", "gvi.h, s = 8", "gvi.h, s = 12", "RATTLE", "Yoshida 4 of RATTLE",
                                     "Kahan-Li 6 of RATTLE", "Kahan-Li 8 of RATTLE", "DOP853, index 1, projected" };

static double forces;                             // evaluated in the last run

static double run(int top, int method, int steps)
{
    static double memory[60000];
    static int rows[2] = { 1, 8 };
    const linkage a = make_linkage(top ? DIRECTORS : RODS);
    const double h = 10.0/steps, *end = top ? top_end : rods_end;
    double q[9], p[9], y[8], error = 0;
    forces = 12.0*steps;
    memcpy(q, a.q, sizeof q);
    for (int i = 0; i < 9; ++i) p[i] = top ? a.mass.matrix[i]*a.v[i] : 0;
    if (method < RATTLE1) {
        static gvi_effect scene[2];
        const gvi_effect list[] = { { .kind = GVI_POTENTIAL, .points = fast_weight, .user = rows + top },
                               { .kind = GVI_CONSTRAINT, .points = top ? directors : fast_rods, .rows = a.m } };
        memcpy(scene, list, sizeof scene);
        const gvi_desc desc = { .n = a.n, .degree = 4 + 4*method, .effects = scene, .effect_count = 2, .mass = a.mass };
        static gvi_stepper st;
        static int ready = -1;                    // set up once, as for many runs
        if (ready != 2*method + top && gvi_init(&st, &desc, memory, sizeof memory)) return HUGE_VAL;
        ready = 2*method + top;
        if (gvi_start(&st, 0, a.q, a.v)) return HUGE_VAL;
        const unsigned long long before = st.counters.effect[0];
        for (int k = 0; k < steps; ++k) if (gvi_step(&st, h)) return HUGE_VAL;
        forces = (double)(st.counters.effect[0] - before);
        memcpy(q, st.q, sizeof *q*(size_t)a.n);
    } else if (method < PROJECTED) {
        static const double *const gammas[] = { one_stage, yoshida4, kahan_li6, kahan_li8_all };
        static const int counts[] = { 1, 3, 9, 17 };
        forces = (double)steps*counts[method - RATTLE1];
        (top ? rattle_top : rattle_rods)(gammas[method - RATTLE1], counts[method - RATTLE1], h, steps, q, p);
    } else if (top) {
        const double start[7] = { 2/sqrt(5), 1/sqrt(5), 0, 0, 0.5, 0, 5 };
        memcpy(y, start, sizeof start);
        dop853_top(h, steps, y);
        const double A = y[0], B = y[1], C = y[2], D = y[3], R[9] = {
            A*A + B*B - C*C - D*D, 2*(B*C + A*D), 2*(B*D - A*C), 2*(B*C - A*D), A*A - B*B + C*C - D*D, 2*(C*D + A*B),
            2*(B*D + A*C), 2*(C*D - A*B), A*A - B*B - C*C + D*D };
        memcpy(q, R, sizeof R);
    } else {
        memcpy(y, a.q, 4*sizeof *y);
        memset(y + 4, 0, 4*sizeof *y);
        dop853_rods(h, steps, y);
        memcpy(q, y, 4*sizeof *y);
    }
    for (int i = 0; i < a.n; ++i) error = fabs(q[i] - end[i]) <= error ? error : fabs(q[i] - end[i]);
    return error < 1 ? error : HUGE_VAL;          // NaN too
}

static double seconds(int top, int method, int steps, double *error)
{
    double best = 1e9;
    for (int k = 0, repeats = 1; k < 5; ++k) {
        const clock_t t0 = clock();
        for (int j = 0; j < repeats; ++j) *error = run(top, method, steps);
        const double t = (double)(clock() - t0)/CLOCKS_PER_SEC;
        if (t < 0.01 && repeats < 4096) { repeats *= 4, --k; continue; }
        best = fmin(best, t/repeats);
        if (t > 0.2) break;
    }
    return best;
}

/* ---- many constraints ---- */

enum { MOST_RODS = 500, MOLECULES = 216 };

/* bobs of mass 1, rods of length 1, one after the other from the origin */
static int chain_rods(const gvi_points *x, void *user)
{
    const int rods = *(const int *)user, R = x->stride, n = x->n;
    for (int a = 0; a < rods; ++a)
        for (int k = 0; k < R; ++k) {
            double square = 0;
            for (int c = 0; c < 2; ++c) {
                const int i = 2*a + c;
                const double d = x->q[i*R + k] - (a > 0 ? x->q[(i - 2)*R + k] : 0);
                x->jacobian[(a*n + i)*R + k] = d;
                if (a > 0) x->jacobian[(a*n + i - 2)*R + k] = -d;
                square += d*d;
            }
            x->g[a*R + k] = (square - 1)/2;
        }
    return 0;
}

static int chain_weight(const gvi_points *x, void *user)
{
    for (int i = 1; i < x->n; i += 2)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= 1;
    return (void)user, 0;
}

/* O, H, H: three distances each, 1, 1 and 1.633, in a trap */
static int water_bonds(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int a = 0; a < n/3; ++a) {
        const int first = 9*(a/3) + (a % 3 == 2 ? 3 : 0), second = 9*(a/3) + (a % 3 == 0 ? 3 : 6);
        const double length = a % 3 == 2 ? 1.633 : 1;
        for (int k = 0; k < R; ++k) {
            double square = 0;
            for (int c = 0; c < 3; ++c) {
                const double d = x->q[(second + c)*R + k] - x->q[(first + c)*R + k];
                x->jacobian[(a*n + second + c)*R + k] = d;
                x->jacobian[(a*n + first + c)*R + k] = -d;
                square += d*d;
            }
            x->g[a*R + k] = (square - length*length)/2;
        }
    }
    return (void)user, 0;
}

static int trap(const gvi_points *x, void *user)
{
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= x->q[i*x->stride + k];
    return (void)user, 0;
}

/* CPU seconds per step; rods > 0: a chain, hanging askew, else molecules.  The last q to `end` */
static double many(int rods, int molecules, int degree, double h, int steps, double *end)
{
    static double q[9*MOLECULES], v[9*MOLECULES], mass[9*MOLECULES];
    const int n = rods > 0 ? 2*rods : 9*molecules, m = rods > 0 ? rods : 3*molecules;
    const double x = sqrt(1 - 0.8165*0.8165);
    const double water[9] = { 0, 0, 0, x, 0.8165, 0, x, -0.8165, 0 };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = rods > 0 ? chain_weight : trap },
                                 { .kind = GVI_CONSTRAINT, .points = rods > 0 ? chain_rods : water_bonds, .rows = m,
                                   .user = &rods } };
    for (int i = 0; i < n; ++i) {
        v[i] = 0;
        mass[i] = rods > 0 || i % 9 > 2 ? 1 : 16;
        q[i] = rods > 0 ? (i/2 + 1)*(i % 2 ? -0.8 : 0.6) : water[i % 9] + 0.1*(i/9 + 1)*(i % 3 == 0);
    }
    const gvi_desc desc = { .n = n, .degree = degree, .effects = scene, .effect_count = 2,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
    const size_t bytes = gvi_size(&desc);
    void *memory = malloc(bytes);
    gvi_stepper st;
    double time = HUGE_VAL;
    gvi_status status = memory ? gvi_init(&st, &desc, memory, bytes) : GVI_E_MEMORY;
    if (status == GVI_OK) status = gvi_start(&st, 0, q, v);
    for (int k = 0; k < 4 && !end && status == GVI_OK; ++k) status = gvi_step(&st, h);
    const clock_t t0 = clock();
    for (int k = 0; k < steps && status == GVI_OK; ++k) status = gvi_step(&st, h);
    if (status == GVI_OK) time = (double)(clock() - t0)/CLOCKS_PER_SEC/steps;
    else if (!end) puts(gvi_status_text(status));
    if (end && status == GVI_OK) memcpy(end, st.q, sizeof *end*(size_t)n);
    free(memory);
    return time;
}

/* as rattle_rods, by L D L' of the tridiagonal G G' at the start of each stage */
static void rattle_chain(int rods, const double *gamma, int stages, double h, int steps, double *q, double *p)
{
    static double G[2*MOST_RODS], start[2*MOST_RODS], D[MOST_RODS], L[MOST_RODS], y[MOST_RODS], r[MOST_RODS];
    memset(y, 0, sizeof y);
    for (int k = 0; k < steps*stages; ++k) {
        const double d = h*gamma[k % stages];
        for (int i = 0; i < 2*rods; ++i) {
            if (i % 2) p[i] -= d/2;
            G[i] = q[i] - (i > 1 ? q[i - 2] : 0);
            start[i] = q[i];
        }
        for (int a = 0; a < rods; ++a) {
            const double side = a > 0 ? -(G[2*a]*G[2*a - 2] + G[2*a + 1]*G[2*a - 1]) : 0;
            L[a] = a > 0 ? side/D[a - 1] : 0;
            D[a] = (G[2*a]*G[2*a] + G[2*a + 1]*G[2*a + 1])*(a > 0 ? 2 : 1) - L[a]*side;
        }
        for (int a = 0; a < rods; ++a) {          // r: the change of y, impulses of the stage
            r[a] = k > 0 ? y[a]*d/gamma[(k - 1) % stages]/h : 0;
            y[a] = 0;
        }
        for (int j = 0; j < 60; ++j) {
            double most = 0;
            for (int a = 0; a < rods; ++a) {
                for (int c = 0; c < 2; ++c) {
                    const int i = 2*a + c;
                    p[i] += r[a]*G[i] - (a + 1 < rods ? r[a + 1]*G[i + 2] : 0);
                    q[i] = start[i] + d*p[i];
                }
                y[a] += r[a];
            }
            for (int a = 0; a < rods; ++a) {
                const double u = q[2*a] - (a > 0 ? q[2*a - 2] : 0), w = q[2*a + 1] - (a > 0 ? q[2*a - 1] : 0);
                r[a] = (1 - u*u - w*w)/(2*d);
                most = fmax(most, fabs(r[a]*d));
            }
            if (most < 2e-14) break;
            for (int a = 1; a < rods; ++a) r[a] -= L[a]*r[a - 1];
            for (int a = rods; a-- > 0; ) r[a] = r[a]/D[a] - (a + 1 < rods ? L[a + 1]*r[a + 1] : 0);
        }
        for (int i = 1; i < 2*rods; i += 2) p[i] -= d/2;
    }
}

static void many_constraints(void)
{
    static const int rods[] = { 20, 100, 200, 500 };
    static const double wanted[] = { 1e-3, 1e-6, 1e-9 };
    static double right[2*MOST_RODS], q[2*MOST_RODS], p[2*MOST_RODS];
    const double T = 10;
    double times[4] = { 0 };
    puts("\nchain of rods, s = 4, h = 0.05: CPU ms per step");
    for (int k = 0; k < 4; ++k) {
        times[k] = fmin(many(rods[k], 0, 4, 0.05, 20, NULL), many(rods[k], 0, 4, 0.05, 20, NULL));
        printf("%4d rods %9.3f\n", rods[k], 1000*times[k]);
    }
    printf("exponent from 20 to 500: %.2f\n", log(times[3]/times[0])/log(25.0));
    const double one = many(0, 1, 4, 0.1, 2000, NULL), all = many(0, MOLECULES, 4, 0.1, 10, NULL);
    printf("%d molecules of water: a step in one scene %.3f ms, in one scene each %.3f ms, ratio %.2f\n", MOLECULES,
           1000*all, 1000*one*MOLECULES, all/one/MOLECULES);

    puts("chain of 200 rods, T = 10: CPU ms to an error of\n                                1e-03    1e-06    1e-09");
    many(200, 0, 12, T/400, 400, right);
    for (int method = 0; method < PROJECTED; ++method) {
        static const double *const gammas[] = { one_stage, yoshida4, kahan_li6, kahan_li8_all };
        static const int counts[] = { 1, 3, 9, 17 };
        double need[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, time = 0, error = 1;
        for (int N = 32; !(error <= 1e-10) && time < 2; N += N/2) {
            error = 0;
            if (method < RATTLE1) time = N*many(200, 0, 4 + 4*method, T/N, N, q);
            else {
                for (int i = 0; i < 400; ++i) q[i] = (i/2 + 1)*(i % 2 ? -0.8 : 0.6), p[i] = 0;
                const clock_t t0 = clock();
                rattle_chain(200, gammas[method - RATTLE1], counts[method - RATTLE1], T/N, N, q, p);
                time = (double)(clock() - t0)/CLOCKS_PER_SEC;
            }
            if (!(time < 1e9)) time = 0, error = HUGE_VAL;       // a step that long failed
            for (int i = 0; i < 400; ++i) error = fabs(q[i] - right[i]) <= error ? error : fabs(q[i] - right[i]);
            for (int w = 0; w < 3; ++w)
                if (error <= wanted[w]) need[w] = fmin(need[w], 1000*time);
        }
        printf("%-28s", names[method]);
        for (int w = 0; w < 3; ++w)
            if (need[w] < HUGE_VAL) printf("%9.1f", need[w]);
            else printf("%9s", "-");
        puts("");
    }
}

int main(int argc, char **argv)
{
    static const char *const colours[METHODS] = { "#999999", "#111111", "#d55e00", "#0072b2", "#aa4499", "#b8860b", "#009e73",
                                                  "#cc3311" };
    static double times[2][METHODS][4], errors[2][METHODS][4];
    svg_line lines[2][METHODS];
    svg_plot panels[2];
    static const double wanted[] = { 1e-4, 1e-7, 1e-10, 1e-12 };
    for (int i = 0; i < 17; ++i) kahan_li8_all[i] = (double)kahan_li8[i < 8 ? i : 16 - i];
    kahan_li8_all[8] = 1;
    for (int i = 0; i < 16; ++i) kahan_li8_all[8] -= kahan_li8_all[i < 8 ? i : i + 1];
    if (argc > 1 && !strcmp(argv[1], "--many")) return many_constraints(), 0;
    for (int i = 0; i < 12; ++i) {
        table_b[i] = (double)dop853_table.b[i];
        for (int j = 0; j < 12; ++j) table_a[i][j] = (double)dop853_table.A[i][j];
    }
    for (int top = 0; top < 2; ++top) {
        printf("%s, T = 10: CPU milliseconds to an error of\n%-28s", top ? "heavy top in directors" : "double pendulum of rods", "");
        for (int w = 0; w < 4; ++w) printf("%9.0e", wanted[w]);
        puts("   forces, 1e-10");
        for (int method = 0; method < METHODS; ++method) {
            double need[4] = { 0 }, points = 0, *const x = times[top][method], *const y = errors[top][method];
            int drawn = 0;
            for (int N = 8, found = 0; N < 2000000 && found < 4; N += N/3) {
                double error = 0;
                if (run(top, method, N) > wanted[found]) continue;
                const double t = 1000*seconds(top, method, N, &error);
                if (t > 400) break;
                x[drawn] = t;
                y[drawn++] = error;
                for (; found < 4 && error <= wanted[found]; ++found) {
                    need[found] = t;
                    if (found == 2) points = forces;
                }
            }
            printf("%-28s", names[method]);
            for (int w = 0; w < 4; ++w)
                if (need[w] > 0) printf("%9.3f", need[w]);
                else printf("%9s", "-");
            if (points > 0) printf("%9.0f", points);
            puts("");
            if (drawn == 1) {                     // a dash, since one point is no line
                x[1] = 1.15*x[0];
                x[0] /= 1.15;
                y[drawn++] = y[0];
            }
            lines[top][method] = (svg_line){ names[method], x, y, drawn };
        }
        panels[top] = (svg_plot){ .title = top ? "heavy top in directors" : "double pendulum of rods", .x_label = "CPU time, ms",
                                  .y_label = "error of q at the end", .lines = lines[top], .line_count = METHODS,
                                  .log_x = 1, .log_y = 1, .thick = 7, .dashed = 1 << PROJECTED,
                                  .colours = colours };
    }
    many_constraints();
    if (argc < 3 || strcmp(argv[1], "--out")) return 0;
    char path[512];
    snprintf(path, sizeof path, "%s/constraints.svg", argv[2]);
    if (svg_write_all(path, panels, 2, 360)) return perror(path), 1;
    return 0;
}
