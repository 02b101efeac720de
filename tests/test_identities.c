/* What Galerkin variational integrators are known to coincide with, to round-off over many steps:
   the midpoint rule, Stoermer-Verlet, Gauss collocation, the Lobatto IIIA-IIIB pair. These are
   written here in Hamilton's equations, with the published coefficients, in long double. */
#include "gvi_test.h"
#include "problems.h"

typedef long double wide;

enum { STEPS = 50, N = 2 };

/* The largest difference allowed after STEPS steps, in eps. */
#define LIMIT 10

/* two systems, each told twice:
   to gvi.h as a Lagrangian, to the methods below as z = (q, p), dz = (dH/dp, -dH/dq) */

typedef void rates_fn(const wide *z, wide *dz);

/* separable: p0^2/(5/2) + p1^2/(3/2) + x^2/2 + 3 y^2/4 + x^2 y - y^3/3 */

static const gvi_real two_masses[] = { 5/(gvi_real)4, 3/(gvi_real)4 };

GVI_EACH(separable_points, 2, f)
{
    gvi_real a = x->q[0], b = x->q[1];
    x->f[0] -= a + 2*a*b;
    x->f[1] -= 3*b/2 + a*a - b*b;
}

static void separable_rates(const wide *z, wide *dz)
{
    dz[0] = 4*z[2]/5;
    dz[1] = 4*z[3]/3;
    dz[2] = -z[0]*(1 + 2*z[1]);
    dz[3] = z[1]*(z[1] - 3/2.0L) - z[0]*z[0];
}

/* double pendulum: T = a v0^2/2 + b v1^2/2 + c v0 v1 cos(q0 - q1), a = 11/4,
   b = 7/8, c = 9/8; V = -11/2 cos q0 - 7/4 cos q1 */

/* H = (b p0^2 + a p1^2 - 2 w p0 p1)/(2D) + V,  w = c cos(q0 - q1),  D = ab - w^2 */
static void pendulum_rates(const wide *z, wide *dz)
{
    wide a = 11/4.0L, b = 7/8.0L, w = 9*cosl(z[0] - z[1])/8, dw = -9*sinl(z[0] - z[1])/8;
    wide D = a*b - w*w, numerator = b*z[2]*z[2] + a*z[3]*z[3] - 2*w*z[2]*z[3];
    wide dT = dw*(w*numerator/D - z[2]*z[3])/D;        /* by q0; by q1 its negative */
    dz[0] = (b*z[2] - w*z[3])/D;
    dz[1] = (a*z[3] - w*z[2])/D;
    dz[2] = -dT - 11*sinl(z[0])/2;
    dz[3] = dT - 7*sinl(z[1])/4;
}

struct system {
    rates_fn   *rates;
    gvi_mass    mass;
    gvi_effect  effect;
    gvi_real    q[N], p[N], h;
};

static const struct system separable = {
    separable_rates, { .kind = GVI_MASS_DIAGONAL, .matrix = two_masses },
    { .kind = GVI_POTENTIAL, .points = separable_points },
    { 3/(gvi_real)8, -1/(gvi_real)4 }, { 1/(gvi_real)8, 1/(gvi_real)4 }, 1/(gvi_real)4
};
static const struct system pendulum = {
    pendulum_rates, { .kind = GVI_MASS_POSITION, .points = absolute_mass, .gradient = absolute_gradient },
    { .kind = GVI_POTENTIAL, .point = absolute_weight },
    { 3/(gvi_real)4, -3/(gvi_real)8 }, { 13/(gvi_real)8, -5/(gvi_real)16 }, 1/(gvi_real)8
};

/* Partitioned Runge-Kutta: Q = q0 + h sum a V,  P = p0 + h sum ahat F */
struct tableau {
    int  stages;
    wide a[3][3], ahat[3][3], b[3];
};

/* The increment dz of a step from z. */
typedef void method_fn(rates_fn *rates, const struct tableau *T, wide h, const wide *z, wide *dz);

/* dz = h g(z + dz/2) */
static void midpoint(rates_fn *rates, const struct tableau *T, wide h, const wide *z, wide *dz)
{
    wide middle[2*N], g[2*N] = { 0 };
    for (int it = 0; it < 100; ++it) {
        for (int i = 0; i < 2*N; ++i) middle[i] = z[i] + h*g[i]/2;
        rates(middle, g);
    }
    for (int i = 0; i < 2*N; ++i) dz[i] = h*g[i];
}

/* kick, drift, kick */
static void verlet(rates_fn *rates, const struct tableau *T, wide h, const wide *z, wide *dz)
{
    wide Z[2*N], before[2*N], drift[2*N], after[2*N];
    rates(z, before);
    for (int i = 0; i < 2*N; ++i) Z[i] = i < N ? z[i] : z[i] + h*before[i]/2;
    rates(Z, drift);
    for (int i = 0; i < N; ++i) Z[i] += h*drift[i];
    rates(Z, after);
    for (int i = 0; i < 2*N; ++i) dz[i] = i < N ? h*drift[i] : h*(before[i] + after[i])/2;
}

static void partitioned(rates_fn *rates, const struct tableau *T, wide h, const wide *z, wide *dz)
{
    wide K[3][2*N] = { { 0 } }, Z[3][2*N];
    for (int it = 0; it < 100; ++it) {
        for (int k = 0; k < T->stages; ++k)
            for (int i = 0; i < 2*N; ++i) {
                wide sum = 0;
                for (int l = 0; l < T->stages; ++l) sum += (i < N ? T->a : T->ahat)[k][l]*K[l][i];
                Z[k][i] = z[i] + h*sum;
            }
        for (int k = 0; k < T->stages; ++k) rates(Z[k], K[k]);
    }
    for (int i = 0; i < 2*N; ++i) {
        wide sum = 0;
        for (int k = 0; k < T->stages; ++k) sum += T->b[k]*K[k][i];
        dz[i] = h*sum;
    }
}

/* z += dz, what rounding takes off is kept in e for the next time. */
static void add(wide *z, wide *e, const wide *dz)
{
    for (int i = 0; i < 2*N; ++i) {
        wide was = z[i], d = dz[i] + e[i];
        z[i] = was + d;
        e[i] = d - (z[i] - was);
    }
}

/* Hairer, Lubich, Wanner, tables II.1.1, II.2.1 and II.2.2; in the functions,
   since a long double of two doubles has no constant quotients. */
#define SQRT3  1.7320508075688772935274463415058723669L
#define SQRT15 3.8729833462074168851792653997823996108L
#define GAUSS2 { { 1/4.0L, 1/4.0L - SQRT3/6 }, { 1/4.0L + SQRT3/6, 1/4.0L } }
#define GAUSS3 { { 5/36.0L, 2/9.0L - SQRT15/15, 5/36.0L - SQRT15/30 }, \
                 { 5/36.0L + SQRT15/24, 2/9.0L, 5/36.0L - SQRT15/24 }, \
                 { 5/36.0L + SQRT15/30, 2/9.0L + SQRT15/15, 5/36.0L } }

/* The largest difference from the method over STEPS steps, in eps; the step
   size changes every five steps.  -1 if the formulation does not cover it. */
static wide deviation(const struct system *a, gvi_rule_kind rule, int s, int r, gvi_formulation how,
                      method_fn *method, const struct tableau *T)
{
    static gvi_real memory[GVI_LENGTH(N, 3, 3)];
    const int own = rule == GVI_OWN;
    gvi_real nodes[3] = { 0 }, weights[3] = { 0 };
    for (int i = 0; own && i < r; ++i) {
        for (int j = 0; j < r; ++j) nodes[i] += (gvi_real)T->a[i][j];
        weights[i] = (gvi_real)T->b[i];
    }
    const gvi_desc desc = {
        .n = N, .degree = s, .rule = { rule, r, own ? nodes : NULL, own ? weights : NULL },
        .mass = a->mass,
        .effects = &a->effect, .effect_count = 1, .formulation = how
    };
    wide z[2*N] = { a->q[0], a->q[1], a->p[0], a->p[1] }, e[2*N] = { 0 }, dz[2*N], worst = 0;
    gvi_stepper st;
    gvi_status status = gvi_init(&st, &desc, memory, sizeof memory);
    if (status == GVI_E_FORMULATION) return -1;
    assert_ok(status);
    assert_ok(gvi_start_momentum(&st, 0, a->q, a->p));
    for (int k = 0; k < STEPS; ++k) {
        gvi_real h = k/5 % 2 ? a->h/2 : a->h;
        assert_ok(gvi_step(&st, h));
        method(a->rates, T, h, z, dz);
        add(z, e, dz);
        for (int i = 0; i < N; ++i) {
            wide q = fabsl(st.q[i] - z[i]), p = fabsl(st.p[i] - z[N + i]);
            worst = q <= worst ? worst : q;             /* a NaN stays */
            worst = p <= worst ? worst : p;
        }
    }
    return worst/EPS;
}

static void compare(const char *what, const struct system *a, gvi_rule_kind rule, int s, int r,
                    method_fn *method, const struct tableau *T)
{
    wide worst[6];
    print_message("  %-38s s=%d r=%d ", what, s, r);
    for (int how = 0; how < COUNT(worst); ++how) {
        worst[how] = deviation(a, rule, s, r, (gvi_formulation)how, method, T);
        if (worst[how] < 0) print_message("       -");
        else print_message(" %7.2Lf", worst[how]);
    }
    print_message("\n");
    assert_true(worst[GVI_AUTO] >= 0 && worst[GVI_NEWTON] >= 0);
    for (int how = 0; how < COUNT(worst); ++how) assert_between(-1, worst[how], LIMIT);
}

TEST(gauss_of_degree_1_is_the_midpoint_rule)
{
    print_message("  worst differences in eps                           "
                  "auto    expl     pos     vel     mom  newton\n");
    compare("midpoint rule, separable", &separable, GVI_GAUSS, 1, 1, midpoint, NULL);
    compare("midpoint rule, double pendulum", &pendulum, GVI_GAUSS, 1, 1, midpoint, NULL);
}

TEST(lobatto_of_degree_1_is_stoermer_verlet)
{
    compare("Stoermer-Verlet", &separable, GVI_LOBATTO, 1, 2, verlet, NULL);
}

TEST(gauss_is_gauss_collocation)
{
    const struct tableau gauss2 = { 2, GAUSS2, GAUSS2, { 1/2.0L, 1/2.0L } };
    const struct tableau gauss3 = { 3, GAUSS3, GAUSS3, { 5/18.0L, 4/9.0L, 5/18.0L } };
    compare("Gauss 2, separable", &separable, GVI_GAUSS, 2, 2, partitioned, &gauss2);
    compare("Gauss 3, separable", &separable, GVI_GAUSS, 3, 3, partitioned, &gauss3);
    compare("Gauss 2, double pendulum", &pendulum, GVI_GAUSS, 2, 2, partitioned, &gauss2);
    compare("Gauss 3, double pendulum", &pendulum, GVI_GAUSS, 3, 3, partitioned, &gauss3);
}

/* With constant mass and potentials the degrees r - 1 and r give one method;
   else it is degree r, equation (5). */
TEST(lobatto_is_the_lobatto_iiia_iiib_pair)
{
    const struct tableau lobatto2 = {
        2, { { 0, 0 }, { 1/2.0L, 1/2.0L } }, { { 1/2.0L, 0 }, { 1/2.0L, 0 } }, { 1/2.0L, 1/2.0L }
    };
    const struct tableau lobatto3 = {
        3, { { 0, 0, 0 }, { 5/24.0L, 1/3.0L, -1/24.0L }, { 1/6.0L, 2/3.0L, 1/6.0L } },
        { { 1/6.0L, -1/6.0L, 0 }, { 1/6.0L, 1/3.0L, 0 }, { 1/6.0L, 5/6.0L, 0 } },
        { 1/6.0L, 2/3.0L, 1/6.0L }
    };
    compare("Lobatto IIIA-IIIB 2, separable", &separable, GVI_LOBATTO, 1, 2, partitioned, &lobatto2);
    compare("Lobatto IIIA-IIIB 2, separable", &separable, GVI_LOBATTO, 2, 2, partitioned, &lobatto2);
    compare("Lobatto IIIA-IIIB 3, separable", &separable, GVI_LOBATTO, 2, 3, partitioned, &lobatto3);
    compare("Lobatto IIIA-IIIB 3, separable", &separable, GVI_LOBATTO, 3, 3, partitioned, &lobatto3);
    compare("Lobatto IIIA-IIIB 2, double pendulum", &pendulum, GVI_LOBATTO, 2, 2, partitioned, &lobatto2);
    compare("Lobatto IIIA-IIIB 3, double pendulum", &pendulum, GVI_LOBATTO, 3, 3, partitioned, &lobatto3);
}

/* Any s nodes: a_ij is the integral of l_j to c_i, ahat_ij = b_j - b_j a_ji/b_i. */
static struct tableau of_nodes(int s, const wide *c)
{
    struct tableau T = { s, { { 0 } }, { { 0 } }, { 0 } };
    for (int j = 0; j < s; ++j) {
        const wide x = c[(j + 1) % s], y = s > 2 ? c[(j + 2) % s] : 0;
        for (int i = 0; i <= s; ++i) {           // l_j = (t - x)(t - y)/..., without y for two nodes
            const wide t = i < s ? c[i] : 1,
                       area = s > 2 ? t*t*t/3 - (x + y)*t*t/2 + x*y*t : t*t/2 - x*t,
                       a = area/((c[j] - x)*(s > 2 ? c[j] - y : 1));
            if (i < s) T.a[i][j] = a;
            else T.b[j] = a;
        }
    }
    for (int i = 0; i < s; ++i)
        for (int j = 0; j < s; ++j) T.ahat[i][j] = T.b[j] - T.b[j]*T.a[j][i]/T.b[i];
    return T;
}

/* order 2 = 2s - 2, and 3 < 2s - 2 */
TEST(s_nodes_of_any_kind_are_a_partitioned_runge_kutta_pair)
{
    const struct tableau two = of_nodes(2, (const wide[]){ 1/4.0L, 3/4.0L }),
                         three = of_nodes(3, (const wide[]){ 0, 1/2.0L, 3/4.0L });
    compare("nodes 1/4 3/4, separable", &separable, GVI_OWN, 2, 2, partitioned, &two);
    compare("nodes 1/4 3/4, double pendulum", &pendulum, GVI_OWN, 2, 2, partitioned, &two);
    compare("nodes 0 1/2 3/4, separable", &separable, GVI_OWN, 3, 3, partitioned, &three);
    compare("nodes 0 1/2 3/4, double pendulum", &pendulum, GVI_OWN, 3, 3, partitioned, &three);
}

/* What makes a step symplectic holds in the rounded tables exactly: S_ij = S_ji, and T_ij + T_ji = 1 for Gauss */
TEST(tables_are_symplectic_to_the_bit)
{
    for (int s = 1; s <= 16; ++s)
        for (int rule = GVI_GAUSS; rule <= GVI_LOBATTO; ++rule) {
            const gvi_desc desc = { .n = 1, .degree = s, .rule = { .kind = (gvi_rule_kind)rule },
                                    .formulation = GVI_VELOCITIES };
            gvi_stepper st = new_stepper(&desc);
            const gvi_real *c = st.in.table.c, *K = st.in.table.K, *U = st.in.table.U;
            const int R = st.in.R;
            for (int i = 0; i < st.r; ++i)
                for (int j = 0; j <= i; ++j) {
                    assert_true((wide)c[i] - K[j*R + i] == (wide)c[j] - K[i*R + j]);
                    if (rule == GVI_GAUSS) assert_true((wide)U[j*R + i] + U[i*R + j] == 1);
                }
        }
}

RUN_TESTS(NULL, NULL)
