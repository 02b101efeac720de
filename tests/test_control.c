/* Optimal control: lessons 19 and 20 themselves, their functions included.  What is expected are
   solutions of Pontryagin's boundary value problems in 24 to 32 digits by another program (Gauss
   collocation with 12 and 8 stages, Newton's method by differences; the cart there in velocities,
   with the adjoint equations of that form).  And what they find is the minimum of the discrete
   problem: by adjoint.h, thrust by thrust.                                    */
#include "gvi_test.h"
#define main lesson_19
#include "19_low_thrust.c"
#undef main
#define main lesson_20
#include "20_swing_up.c"
#undef main
#include "tools/adjoint.h"


/* ------------------------------------------------------------- low thrust */

static const double flight_cost = 0.0004374230531335397759746, flight_start[] = { -0.001223261471621544535146,
                    -0.008026228113038987346453, 0.009170708578766099044291, 0.001223261471621544535146 };

/* Errors of the cost and of the costate at the start.                          */
static void flight_errors(int degree, int steps, double *e)
{
    double cost, q[FLIGHT], p[FLIGHT];
    assert_ok(best_flight(degree, steps, &cost, q, p, NULL));
    e[0] = fabs(cost - flight_cost);
    e[1] = fmax(fmax(fabs(q[2] - flight_start[0]), fabs(q[3] - flight_start[1])),
                fmax(fabs(p[2] - flight_start[2]), fabs(p[3] - flight_start[3])));
}

TEST(the_best_flight)
{
    double cost, q[FLIGHT], p[FLIGHT];
    assert_ok(best_flight(6, 48, &cost, q, p, NULL));
    assert_close(cost, flight_cost, 1e-17);
    assert_close(-q[3], 0.008026228113038987346453, 1e-14);
    assert_close(q[2], flight_start[0], 1e-14);
    assert_close(p[2], flight_start[2], 1e-14);
    assert_close(p[3], flight_start[3], 1e-14);
}

TEST(the_flight_has_order_2s)
{
    static const int steps[] = { 48, 24, 12 };
    for (int s = 2; s <= 4; ++s) {
        double coarse[2], fine[2];
        flight_errors(s, steps[s-2], coarse);
        flight_errors(s, 2*steps[s-2], fine);
        for (int i = 0; i < 2; ++i) assert_between(2*s - 0.2, log2(coarse[i]/fine[i]), 2*s + 0.2);
    }
}

/* ------------------------- discretise, then optimise: the thrust at each node as a number

   The craft with thrusts given at the nodes: its gradient by adjoint.h is that of the lesson's costates.    */

typedef struct thrust { int degree; double t, h, node[MOST_NODES], bary[MOST_NODES], u[MOST_NODES]; } thrust;

static double thrust_at(const thrust *T, double t)
{
    return gvi_interpolate(T->degree, T->node, T->bary, T->u, (t - T->t)/T->h);
}

static int gravity_force(const gvi_points *x, void *user)
{
    for (int k = 0, s = x->stride; k < x->count; ++k) {
        const double a = x->q[k], b = x->q[s+k], d2 = a*a + b*b, w = 1/(d2*sqrt(d2));
        x->f[k] -= w*a;
        x->f[s+k] -= w*b;
    }
    return 0;
}

static int gravity_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    for (int k = 0, s = x->stride; k < x->count; ++k) {
        const double a = x->q[k], b = x->q[s+k], da = d->q[k], db = d->q[s+k], d2 = a*a + b*b;
        const double w = 1/(d2*sqrt(d2)), along = 3*(a*da + b*db)/d2;
        d->f[k] -= w*(da - along*a);
        d->f[s+k] -= w*(db - along*b);
    }
    return 0;
}

static int engine(const gvi_points *x, void *user)
{
    for (int k = 0, s = x->stride; k < x->count; ++k) {
        const double a = x->q[k], b = x->q[s+k], u = thrust_at(user, x->t[k])/sqrt(a*a + b*b);
        x->f[k] -= u*b;
        x->f[s+k] += u*a;
    }
    return 0;
}

static int engine_transposed(const gvi_points *x, const gvi_points *l, int parameter, void *user)
{
    for (int k = 0, s = x->stride; k < x->count && l->f; ++k) {
        const double a = x->q[k], b = x->q[s+k], d = sqrt(a*a + b*b), u = thrust_at(user, x->t[k])/d;
        const double across = (a*l->q[s+k] - b*l->q[k])/(d*d);
        l->f[k] += u*(l->q[s+k] - across*a);
        l->f[s+k] -= u*(l->q[k] + across*b);
    }
    return 0;
}

/* The derivative of the sum of h b u^2/2 and of the end's costate times the end, by u over h b.    */
static void by_thrust(double t, const double *q, const double *v, const double *l, const double *dl,
                      double weight, int node, double *g, void *user)
{
    g[node] = thrust_at(user, t) + (q[0]*l[1] - q[1]*l[0])/sqrt(q[0]*q[0] + q[1]*q[1]);
}

TEST(no_thrust_can_be_better)
{
    enum { S = 3, K = 24 };
    static double memory[GVI_LENGTH(4, S, S)], back[GVI_LENGTH(4, S, S)], room[ADJOINT_ROOM(2, S)], u[K][S];
    thrust T = { .degree = S, .h = flight_time/K };
    const gvi_effect craft[] = { { .kind = GVI_POTENTIAL, .points = gravity_force },
                                 { .kind = GVI_FORCE, .points = engine, .user = &T } };
    const gvi_effect both_scenes[] = { { .kind = GVI_POTENTIAL, .points = flight } };
    const gvi_desc desc = { .n = FLIGHT, .degree = S, .effects = both_scenes, .effect_count = 1 };
    adjoint A = { .plain = { .n = 2, .degree = S, .effects = craft, .effect_count = 2 }, .by_parameters = by_thrust,
                  .product = { gravity_product, engine_transposed }, .user = &T,
                  .room = room, .room_length = COUNT(room) };
    double cost, q[FLIGHT], p[FLIGHT], z[FLIGHT], g[S], weight[S];
    gvi_stepper st, ad;
    assert_ok(best_flight(S, K, &cost, q, p, NULL));
    assert_ok(gvi_gauss(S, T.node, weight));
    assert_ok(gvi_barycentric(S, T.node, T.bary));

    /* the thrusts, and the costate at the end, of the lesson                    */
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, q, p));
    for (int k = 0; k < K; ++k) {
        assert_ok(gvi_step(&st, T.h));
        for (int i = 0; i < S; ++i) {
            assert_ok(gvi_curve(&st, T.node[i], z, NULL));
            u[k][i] = (z[1]*z[2] - z[0]*z[3])/sqrt(z[0]*z[0] + z[1]*z[1]);
        }
    }
    const double by_q[] = { -st.p[2], -st.p[3] }, by_p[] = { st.q[2], st.q[3] }, end[] = { st.q[0], st.q[1] };

    /* the craft with these thrusts goes there, and its discrete gradient is 0   */
    assert_ok(adjoint_scene(&A));
    assert_ok(gvi_init(&st, &A.plain, memory, sizeof memory));
    assert_ok(gvi_init(&ad, &A.scene.desc, back, sizeof back));
    assert_ok(gvi_start(&st, 0, q, p));
    for (int k = 0; k < K; ++k) {
        T.t = k*T.h;
        memcpy(T.u, u[k], sizeof u[k]);
        assert_ok(gvi_step(&st, T.h));
    }
    for (int i = 0; i < 2; ++i) assert_close(st.q[i], end[i], 1e-13);
    assert_ok(adjoint_start(&A, &ad, flight_time, st.q, st.p, by_q, by_p));
    for (int k = K - 1; k >= 0; --k) {
        T.t = k*T.h;
        memcpy(T.u, u[k], sizeof u[k]);
        assert_ok(adjoint_step(&A, &ad, T.h, g));
        for (int i = 0; i < S; ++i) assert_close(g[i], 0, 1e-14);           /* of 0.013 at most */
    }
}

/* ---------------------------------------------------------------- swing-up */

static const double swing_cost = 57.9447803067280225, swing_start[] = { 6.86114732239437159, -44.992257478480388,
                    -3.15295148504546297, 17.7809038154745571 };

static void swing_errors(int degree, int steps, double *e)
{
    double q[CART] = { 0, 0, swing_start[0], swing_start[1] }, p[CART] = { 0, 0, swing_start[2], swing_start[3] };
    assert_ok(swing_to(1, degree, steps, q, p));
    e[0] = fabs(effort(degree, steps, q, p, NULL) - swing_cost);
    e[1] = fmax(fmax(fabs(q[2] - swing_start[0]), fabs(q[3] - swing_start[1])),
                fmax(fabs(p[2] - swing_start[2]), fabs(p[3] - swing_start[3])));
}

TEST(the_least_effort)
{
    double e[2];
    swing_errors(6, 80, e);
    assert_between(0, e[0], 57.9*1e-12);
    assert_between(0, e[1], 45*1e-11);
}

TEST(the_swing_has_order_2s)
{
    for (int s = 2; s <= 4; ++s) {
        double coarse[2], fine[2];
        swing_errors(s, s < 4 ? 80 : 72, coarse);
        swing_errors(s, s < 4 ? 160 : 144, fine);
        for (int i = 0; i < 2; ++i) assert_between(2*s - 0.25, log2(coarse[i]/fine[i]), 2*s + 0.25);
    }
}

/* The lesson's products, by complex steps, agree with differences.             */
TEST(complex_products)
{
    const double q[] = { 0.1, 0.4, 0.3, 0.2 }, v[] = { 0.5, 0.3, 0.2, 0.1 };
    int part = -1;
    assert_ok(tangent_scene(&swing));
    assert_between(0, tangent_check(&swing, 0, q, v, v, q, &part), 1e-9);
}

/* An end that does not depend on the start, and too few runs.                  */
static void nowhere(const double *q, const double *p, const double *dq, const double *dp,
                    double *c, void *user)
{
    for (int i = 0; i < 4; ++i) c[i] = dq ? 0 : 1;
}

TEST(what_shooting_refuses)
{
    static double memory[GVI_LENGTH(20, 4, 4)], work[SHOOTING_ROOM(CART, CART)];
    static const double dq[16] = { [2] = 1, [7] = 1 }, dp[16] = { [10] = 1, [15] = 1 };
    shooting S = { .scene = &swing, .dq = dq, .dp = dp, .h = 0.1, .steps = 20, .end = nowhere, .tolerance = 1e-8,
                   .most = 10, .room = work };
    double q[CART] = { 0 }, p[CART] = { 0 }, all = 1;
    gvi_stepper st;
    swing.plain.degree = 4;
    assert_ok(tangent_scene(&swing));
    assert_ok(gvi_init(&st, &swing.desc, memory, sizeof memory));
    assert_status(shoot(&S, &st, q, p), GVI_E_SINGULAR);
    S.end = arrive;
    S.user = &all;
    S.most = 1;
    assert_status(shoot(&S, &st, q, p), GVI_E_CONVERGENCE);
}

RUN_TESTS(NULL, NULL)
