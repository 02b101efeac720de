/* Constraints: order of positions, momenta and multipliers, two-sided, and what the discrete motion keeps,
   on linkages and bodies of every kind.  In long double, so that rounding does not blur the slopes.  The
   reference integrates index-1 equations, or Euler's, by extrapolation: it shares no line with gvi.h. */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#include "gvi_test.h"
#include "linkages.h"
#define EXTRAPOLATE_MOST (2*MOST_N)
#include "hard/extrapolate.h"

static gvi_formulation formulation;

static void set_up(gvi_stepper *st, const linkage *a, int degree, gvi_rule_kind rule, int points)
{
    gvi_desc desc = linkage_desc(a, degree);
    desc.rule.kind = rule;
    desc.rule.points = points;
    desc.formulation = formulation;
    *st = new_stepper(&desc);
    assert_true(gvi_size(&desc) <= sizeof(real)*GVI_CONSTRAINED_LENGTH(a->n, degree, st->r, a->m));
    assert_ok(gvi_start(st, 0, a->q, a->v));
}

static void solve(int n, real *A, real *b)        /* symmetric, positive: no pivots */
{
    for (int k = 0; k < n; ++k)
        for (int i = k + 1; i < n; ++i) {
            const real l = A[i*n + k]/A[k*n + k];
            for (int j = k; j < n; ++j) A[i*n + j] -= l*A[k*n + j];
            b[i] -= l*b[k];
        }
    for (int k = n; k-- > 0; ) {
        for (int j = k + 1; j < n; ++j) b[k] -= A[k*n + j]*b[j];
        b[k] /= A[k*n + k];
    }
}

static void over_mass(const linkage *a, real *z)
{
    real m[MOST_N*MOST_N];
    for (int i = 0; i < a->n*a->n; ++i) m[i] = a->mass.kind == GVI_MASS_DENSE ? a->mass.matrix[i] : 0;
    if (a->mass.kind == GVI_MASS_DENSE) solve(a->n, m, z);
    else if (a->mass.kind == GVI_MASS_DIAGONAL)
        for (int i = 0; i < a->n; ++i) z[i] /= a->mass.matrix[i];
}

static void constraint_at(const linkage *a, real t, const real *q, real *g, real *G, real *rate)
{
    gvi_points x;
    memset(&x, 0, sizeof x);
    memset(G, 0, sizeof(real)*(size_t)(a->n*a->m));
    memset(rate, 0, sizeof(real)*(size_t)a->m);
    x.n = a->n;
    x.count = x.stride = 1;
    x.t = &t;
    x.q = q;
    x.g = g;
    x.jacobian = G;
    x.rate = rate;
    a->effects[1].points(&x, a->effects[1].user);
}

/* Acceleration and multipliers: G q'' = -v'Hv - ..., with the quadratic g of this file d(Gv + rate) =
   (G(q + v) - G(q)) v + 2 (rate(q + v) - rate(q)) + d2g/dt2 */
static void accelerate(const linkage *a, linkage_id id, real t, const real *q, const real *v, real *acc, real *lambda)
{
    const int n = a->n, m = a->m;
    real g[MOST_M], G[MOST_M*MOST_N], H[MOST_M*MOST_N], rate[MOST_M], next[MOST_M], moved[MOST_N] = { 0 }, F[MOST_N] = { 0 };
    real A[MOST_M*MOST_M], W[MOST_M][MOST_N];
    for (int i = 0; i < n; ++i) moved[i] = q[i] + v[i];
    constraint_at(a, t, moved, g, H, next);
    constraint_at(a, t, q, g, G, rate);
    const real *weight = (const real *)a->effects[0].user;
    for (int i = 0; i < n; ++i) F[i] = weight[i] - (id == FRICTION ? v[i]/10 : 0);
    if (id == MAGNET) F[0] += v[1], F[1] -= v[0];
    for (int i = 0; i < n; ++i) acc[i] = F[i];
    over_mass(a, acc);
    for (int b = 0; b < m; ++b) {
        memcpy(W[b], G + b*n, sizeof(real)*(size_t)n);
        over_mass(a, W[b]);
        lambda[b] = -2*(next[b] - rate[b]);
        if (id == PIVOT) lambda[b] -= pow(2*cos(2*t)/3, 2) + (q[0] - sin(2*t)/3)*4*sin(2*t)/3;
        for (int i = 0; i < n; ++i) lambda[b] -= G[b*n + i]*acc[i] + (H[b*n + i] - G[b*n + i])*v[i];
        for (int c = 0; c <= b; ++c) {
            A[b*m + c] = 0;
            for (int i = 0; i < n; ++i) A[b*m + c] += G[c*n + i]*W[b][i];
            A[c*m + b] = A[b*m + c];
        }
    }
    solve(m, A, lambda);
    for (int b = 0; b < m; ++b)
        for (int i = 0; i < n; ++i) acc[i] += lambda[b]*W[b][i];
}

/* y = (q, v), for a quaternion (q, body angular velocity) */
static void slope(const linkage *a, linkage_id id, real t, const real *y, real *dy)
{
    real lambda[MOST_M];
    if (id != QUATERNION) {
        memcpy(dy, y + a->n, sizeof(real)*(size_t)a->n);
        accelerate(a, id, t, y, y + a->n, dy + a->n, lambda);
        return;
    }
    const real *I = (const real *)a->mass.user, *w = y + 4, half[4] = { 0, w[0]/2, w[1]/2, w[2]/2 };
    static const real sign[4] = { 1, -1, -1, 1 };
    quaternion_product(y, half, dy);
    for (int i = 0; i < 3; ++i) {                 /* torque: -dV along q e_i/2 */
        const real e[4] = { 0, i == 0, i == 1, i == 2 };
        real along[4], torque = 0;
        quaternion_product(y, e, along);
        for (int j = 0; j < 4; ++j) torque -= sign[j]*y[j]*along[j];
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        dy[4 + i] = (torque + (I[1 + j] - I[1 + k])*w[j]*w[k])/I[1 + i];
    }
}

typedef struct which { const linkage *a; linkage_id id; } which;

static void slope_of(real t, const real *y, real *dy, void *user)
{
    const which *w = user;
    slope(w->a, w->id, t, y, dy);
}

static void reference(const linkage *a, linkage_id id, real T, int steps, real *q, real *p)
{
    which w = { a, id };
    const motion exact = { id == QUATERNION ? 7 : 2*a->n, slope_of, &w };
    real y[2*MOST_N];
    memcpy(y, a->q, sizeof(real)*(size_t)a->n);
    memcpy(y + a->n, a->v, sizeof(real)*(size_t)a->n);
    if (id == QUATERNION) y[4] = 0.5L, y[5] = 0, y[6] = 5;
    flow(&exact, 0, T, T/steps, y);
    memcpy(q, y, sizeof(real)*(size_t)a->n);
    if (id == QUATERNION) {                       /* p = M v = 2 q (0, I w) */
        const real *I = (const real *)a->mass.user, z[4] = { 0, 2*I[1]*y[4], 2*I[2]*y[5], 2*I[3]*y[6] };
        quaternion_product(q, z, p);
        return;
    }
    for (int i = 0; i < a->n; ++i) {
        const real *M = a->mass.matrix, *v = y + a->n;
        p[i] = a->mass.kind == GVI_MASS_DENSE ? 0 : a->mass.kind == GVI_MASS_DIAGONAL ? M[i]*v[i] : v[i];
        for (int j = 0; a->mass.kind == GVI_MASS_DENSE && j < a->n; ++j) p[i] += M[i*a->n + j]*v[j];
    }
    if (id == MAGNET) p[0] -= q[1]/2, p[1] += q[0]/2;
}

static real distance(int n, const real *a, const real *b)
{
    real d = 0;
    for (int i = 0; i < n; ++i) d = fabs(a[i] - b[i]) > d ? fabs(a[i] - b[i]) : d;
    return d;
}

static void errors(const linkage *a, int s, gvi_rule_kind rule, int r, real T, int N, const real *q, const real *p,
                   real *error)
{
    gvi_stepper st;
    set_up(&st, a, s, rule, r);
    for (int k = 0; k < N; ++k) assert_ok(gvi_step(&st, T/N));
    error[0] = distance(a->n, st.q, q);
    error[1] = distance(a->n, st.p, p);
}

/* q and p of order `order`, no less and no more */
static void check_order(linkage_id id, int s, gvi_rule_kind rule, int r, int order, const real *q, const real *p)
{
    static const int steps[] = { 0, 64, 24, 14, 8 }, five[LINKAGES] = { 4, 4, 5, 28, 12, 8, 5, 5, 5 };
    const linkage a = make_linkage(id);
    const int N = s == 5 ? five[id] : steps[s]*(id == DIRECTORS || id == QUATERNION || id == FOUR_BAR ? 3 : 1);
    real first[2], second[2];
    errors(&a, s, rule, r, 1, N, q, p, first);
    errors(&a, s, rule, r, 1, 2*N, q, p, second);
    for (int k = 0; k < 2; ++k) {
        const real found = log2(first[k]/second[k]);
        assert_between(order - 0.2L, found, order + 0.6L);
    }
}

TEST(q_and_p_have_the_full_order)
{
    for (int id = 0; id < LINKAGES; ++id) {
        const linkage a = make_linkage((linkage_id)id);
        const int constant_mass = id != QUATERNION && id != MAGNET;
        formulation = GVI_AUTO;
        real q[MOST_N], p[MOST_N], q2[MOST_N], p2[MOST_N];
        reference(&a, (linkage_id)id, 1, 60, q, p);
        reference(&a, (linkage_id)id, 1, 50, q2, p2);
        assert_between(0, distance(a.n, q, q2) + distance(a.n, p, p2), 4000*EPS);
        for (int s = 1; s <= 5; ++s) {
            check_order((linkage_id)id, s, GVI_GAUSS, s, 2*s, q, p);
            if (constant_mass) check_order((linkage_id)id, s, GVI_LOBATTO, s + 1, 2*s, q, p);
            if (s > 1 && constant_mass) check_order((linkage_id)id, s, GVI_LOBATTO, s, 2*s - 2, q, p);
        }
        formulation = GVI_NEWTON;                 // of which M(q) and Lagrangian terms may have any rule
        for (int s = 1; s <= 4; ++s) {
            check_order((linkage_id)id, s, GVI_GAUSS, s, 2*s, q, p);
            check_order((linkage_id)id, s, GVI_LOBATTO, s + 1, 2*s, q, p);
        }
        formulation = GVI_AUTO;
    }
}

/* Along a motion, against those of the index-1 equations at the same state: no method's order is in it */
TEST(multipliers_are_those_of_the_index_1_equations)
{
    for (int id = 0; id < LINKAGES; ++id) {
        const linkage a = make_linkage((linkage_id)id);
        gvi_stepper st;
        if (id == QUATERNION) continue;
        set_up(&st, &a, 3, GVI_GAUSS, 3);
        for (int k = 0; k < 20; ++k) {
            real v[MOST_N], acc[MOST_N], wanted[MOST_M], lambda[MOST_M];
            assert_ok(gvi_multipliers(&st, lambda));
            assert_ok(gvi_velocity(&st, v));
            accelerate(&a, (linkage_id)id, st.t, st.q, v, acc, wanted);
            for (int b = 0; b < a.m; ++b) {
                real size = 0;
                for (int c = 0; c < a.m; ++c) size += fabs(wanted[c]);
                assert_close(lambda[b], wanted[b], 400*EPS*(1 + size));
            }
            assert_ok(gvi_step(&st, 0.05L));
        }
    }
}

/* A quaternion's multiplier is that of |q|: T and V are homogeneous of degree 2 in q, so q'(dL/dq) = 2T - 2V,
   and d(q'p)/dt = 0 with q'p = 4 I0 q'v = 0, v'p = 2T: lambda = 2V - 4T */
TEST(the_multiplier_of_a_quaternion_is_2V_less_4T)
{
    const linkage a = make_linkage(QUATERNION);
    gvi_stepper st;
    set_up(&st, &a, 4, GVI_GAUSS, 4);
    for (int k = 0; k < 20; ++k) {
        real v[4], lambda, T = 0, V = 0, E;
        assert_ok(gvi_multipliers(&st, &lambda));
        assert_ok(gvi_velocity(&st, v));
        for (int i = 0; i < 4; ++i) T += st.p[i]*v[i]/2;
        assert_ok(gvi_energy(&st, &E));
        V = E - T;
        assert_close(lambda, 2*V - 4*T, 2000*EPS*(fabs(V) + T));
        assert_ok(gvi_step(&st, 0.05L));
    }
}

/* A point of the constraint manifold from angles and their rates; a quaternion from (1, z) and body rates */
static void at_coordinates(const linkage *a, linkage_id id, const real *z, real *q, real *v)
{
    (void)a;
    if (id == PENDULUM || id == RODS || id == FRICTION) {
        const int two = id != PENDULUM;
        const real w = z[two ? 2 : 1];
        q[0] = sin(z[0]); q[1] = -cos(z[0]);
        v[0] = cos(z[0])*w; v[1] = sin(z[0])*w;
        if (!two) return;
        q[2] = q[0] + sin(z[1]); q[3] = q[1] - cos(z[1]);
        v[2] = v[0] + cos(z[1])*z[3]; v[3] = v[1] + sin(z[1])*z[3];
    } else if (id == SPHERE || id == MAGNET) {
        const real S = sin(z[0]), C = cos(z[0]), s = sin(z[1]), c = cos(z[1]);
        q[0] = S*c; q[1] = S*s; q[2] = -C;
        v[0] = C*c*z[2] - S*s*z[3]; v[1] = C*s*z[2] + S*c*z[3]; v[2] = S*z[2];
    } else {
        const real n = sqrt(1 + z[0]*z[0] + z[1]*z[1] + z[2]*z[2]), half[4] = { 0, z[3]/2, z[4]/2, z[5]/2 };
        q[0] = 1/n;
        for (int i = 0; i < 3; ++i) q[1 + i] = z[i]/n;
        quaternion_product(q, half, v);
    }
}

/* (q, p) after N steps */
static void run(gvi_stepper *st, const linkage *a, linkage_id id, const real *z, real h, int N, real *q, real *p)
{
    real x[MOST_N], v[MOST_N];
    at_coordinates(a, id, z, x, v);
    assert_ok(gvi_start(st, 0, x, v));
    for (int k = 0; k < N; ++k) assert_ok(gvi_step(st, h));
    memcpy(q, st->q, sizeof(real)*(size_t)a->n);
    memcpy(p, st->p, sizeof(real)*(size_t)a->n);
}

/* Columns of the derivative of `run` by z, by differences of order 8 */
static void tangents(gvi_stepper *st, const linkage *a, linkage_id id, int D, const real *z, real h, int N,
                     real dq[][MOST_N], real dp[][MOST_N])
{
    static const real weight[] = { 4/5.0L, -1/5.0L, 4/105.0L, -1/280.0L };
    const real e = 1/512.0L;
    for (int k = 0; k < D; ++k) {
        for (int i = 0; i < a->n; ++i) dq[k][i] = dp[k][i] = 0;
        for (int j = -4; j <= 4; ++j) {
            real y[6], q[MOST_N], p[MOST_N];
            if (j == 0) continue;
            memcpy(y, z, sizeof y);
            y[k] += j*e;
            run(st, a, id, y, h, N, q, p);
            for (int i = 0; i < a->n; ++i) {
                const real w = (j < 0 ? -1 : 1)*weight[abs(j) - 1]/e;
                dq[k][i] += w*q[i];
                dp[k][i] += w*p[i];
            }
        }
    }
}

/* The largest change of dq dp' - dp dq' over all pairs of tangent vectors, relative */
static real change_of_form(linkage_id id, int s, gvi_rule_kind rule, int r)
{
    static const real start[LINKAGES][6] = { [PENDULUM] = { 1, 0.7L }, [SPHERE] = { 1, 0.3L, 0.4L, 1.1L },
        [RODS] = { 1.2L, -0.4L, 0.5L, 1.5L }, [FRICTION] = { 1.2L, -0.4L, 0.5L, 1.5L }, [MAGNET] = { 1, 0.3L, 0.4L, 1.1L },
        [QUATERNION] = { 0.3L, 0.2L, -0.1L, 0.5L, 0.2L, 2 } };
    const linkage a = make_linkage(id);
    const int D = id == PENDULUM ? 2 : id == QUATERNION ? 6 : 4;
    real q0[6][MOST_N], p0[6][MOST_N], q1[6][MOST_N], p1[6][MOST_N], worst = 0, size = 0;
    gvi_stepper st;
    set_up(&st, &a, s, rule, r);
    tangents(&st, &a, id, D, start[id], 0.2L, 0, q0, p0);
    tangents(&st, &a, id, D, start[id], 0.2L, 3, q1, p1);
    for (int x = 0; x < D; ++x)
        for (int y = 0; y < x; ++y) {
            real before = 0, after = 0;
            for (int i = 0; i < a.n; ++i) {
                before += q0[x][i]*p0[y][i] - q0[y][i]*p0[x][i];
                after += q1[x][i]*p1[y][i] - q1[y][i]*p1[x][i];
            }
            worst = fabs(after - before) > worst ? fabs(after - before) : worst;
            size = fabs(before) > size ? fabs(before) : size;
        }
    return worst/size;
}

TEST(steps_are_symplectic)
{
    static const linkage_id ids[] = { PENDULUM, SPHERE, RODS, QUATERNION, MAGNET };
    for (int k = 0; k < COUNT(ids); ++k)
        for (int s = 1; s <= 4; ++s) {
            const real gauss = change_of_form(ids[k], s, GVI_GAUSS, s);
            const real lobatto = ids[k] < QUATERNION ? change_of_form(ids[k], s, GVI_LOBATTO, s + 1) : 0;
            assert_between(0, gauss, 2e-14L);
            assert_between(0, lobatto, 2e-14L);
            formulation = GVI_NEWTON;
            const real newton = s > 3 ? 0 : change_of_form(ids[k], s, GVI_LOBATTO, s + 1);
            formulation = GVI_AUTO;
            assert_between(0, newton, 2e-14L);
        }
    assert_between(1e-3L, change_of_form(FRICTION, 2, GVI_GAUSS, 2), 1);       // it can fail
}

GVI_EACH(downwards, 2, f) { x->f[1] -= 1; }
GVI_EACH(unit_rod, 2, rows(1))
{
    x->g[0] = (x->q[0]*x->q[0] + x->q[1]*x->q[1] - 1)/2;
    x->jacobian[0] = x->q[0], x->jacobian[1] = x->q[1];
}

/* y of a pendulum of length 1 at time t, from the side with v_y = -1/2, in its angle by Runge and Kutta */
static real height_at(real t)
{
    const int steps = 2000;
    const real h = t/steps;
    real a = 0, w = R(-0.5);
    for (int k = 0; k < steps; ++k) {
        const real k1 = -cos(a), w2 = w + h*k1/2, k2 = -cos(a + h*w/2), w3 = w + h*k2/2, k3 = -cos(a + h*w2/2),
                   w4 = w + h*k3, k4 = -cos(a + h*w3);
        a += h*(w + 2*w2 + 2*w3 + w4)/6;
        w += h*(k1 + 2*k2 + 2*k3 + k4)/6;
    }
    return sin(a);
}

/* lambda = -v^2 + y = 3 y - 1/4 */
TEST(multipliers_within_a_step_have_order_s)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = downwards },
                                        { .kind = GVI_CONSTRAINT, .points = unit_rod, .rows = 1 } };
    for (int run = 0; run < 2*5*3; ++run) {
        const int s = 1 + run/2 % 5;
        const real at[] = { 0, R(0.2), 1 }, tau = at[run/10];
        const gvi_desc desc = { .n = 2, .degree = s, .effects = scene, .effect_count = 2,
                                .formulation = run % 2 ? GVI_NEWTON : GVI_AUTO };
        real error[2], lambda;
        for (int k = 0; k < 2; ++k) {
            const real h = R(0.02)*(real)s/(real)(1 + k);
            gvi_stepper st = new_motion(&desc, 0, (real[]){ 1, 0 }, (real[]){ 0, R(-0.5) });
            assert_status(gvi_curve_multipliers(&st, tau, &lambda), GVI_E_STATE);
            assert_ok(gvi_step(&st, h));
            assert_ok(gvi_curve_multipliers(&st, tau, &lambda));
            error[k] = fabs(lambda - (3*height_at(tau*h) - R(0.25)));
            assert_status(gvi_curve_multipliers(&st, 2, &lambda), GVI_E_ARGUMENT);
            assert_ok(gvi_switch(&st, 1, 0));
            assert_status(gvi_curve_multipliers(&st, tau, &lambda), GVI_E_FORMULATION);
        }
        assert_between((real)s - R(0.3), log2(error[0]/error[1]), (real)s + R(0.4));
    }
}

RUN_TESTS(NULL, NULL)
