/* examples/tools/adjoint.h: the gradient of a cost by stepping back.  What is expected comes from
   Gauss collocation in 40 digits, from closed forms, and from the pairing that an adjoint keeps
   with every direction. */
#include "gvi_test.h"
#include "tools/adjoint.h"
#include "products.h"
enum { N = 2, NODES = 8 };

static real room[2*TANGENT_ROOM(2, 6)];

static real drag_c;

GVI_EACH(drag, 2, v, f)
{
    const real a = x->v[0], b = x->v[1], z = drag_c*sqrt(a*a + b*b);
    x->f[0] -= z*a;
    x->f[1] -= z*b;
}

/* f_v l, symmetric here: -c (|v| l + v (v.l)/|v|) */
static void drag_slope(const gvi_points *x, int k, real la, real lb, real *out)
{
    const real a = x->v[k], b = x->v[x->stride+k], z = sqrt(a*a + b*b), along = z > 0 ? (a*la + b*lb)/z : 0;
    out[0] = -drag_c*(z*la + along*a);
    out[1] = -drag_c*(z*lb + along*b);
}

static int drag_transposed(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    real z[2];
    for (int k = 0; k < x->count && d->dldv; ++k) {
        drag_slope(x, k, d->q[k], d->q[s+k], z);
        d->dldv[k] += z[0];
        d->dldv[s+k] += z[1];
    }
    return 0;
}

static int drag_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    real z[2];
    for (int k = 0; k < x->count; ++k) {
        const real a = x->v[k], b = x->v[s+k], speed = sqrt(a*a + b*b);
        drag_slope(x, k, d->v[k], d->v[s+k], z);
        d->f[k] += z[0] - (parameter == 0 ? speed*a : 0);
        d->f[s+k] += z[1] - (parameter == 0 ? speed*b : 0);
    }
    return 0;
}

static void by_drag(real t, const real *q, const real *v, const real *l, const real *dl,
                    real weight, int node, real *gradient, void *user)
{
    const real z = sqrt(v[0]*v[0] + v[1]*v[1]);
    gradient[0] -= weight*z*(v[0]*l[0] + v[1]*l[1]);
}

static const gvi_effect with_drag[] = { { .kind = GVI_POTENTIAL, .points = attraction },
                                        { .kind = GVI_FORCE, .points = drag } };
static const real q0[] = { 1, R(0.2) }, p0[] = { R(-0.1), R(1.1) }, end_q[] = { 1, -2 }, end_p[] = { R(0.4), 3 };

/* d(q1 - 2 q2 + 0.4 p1 + 3 p2)/dc after 10 steps of 0.2 with c = 0.05.  s = 1, 2, 4, 8: collocation at
   Gauss nodes in 40 digits and differences of order 4. */
static const long double gradient[] = { -1.41923704319197546044L, -1.384460345420786965887L,
                                        -1.384460604060167018781L, -1.384460604036492789706L };

TEST(the_gradient_by_the_drag_is_that_of_40_digits)
{
    for (int e = 0; e < 4; ++e) {
        const int s = 1 << e;
        adjoint A = { .plain = { .n = N, .degree = s, .effects = with_drag, .effect_count = 2 },
                      .product = { attraction_product, drag_transposed }, .by_parameters = by_drag,
                      .room = room, .room_length = ADJOINT_ROOM(N, s) };
        gvi_stepper st, ad;
        real g = 0;
        drag_c = R(0.05);
        assert_ok(adjoint_scene(&A));
        st = new_stepper(&A.plain);
        ad = new_stepper(&A.scene.desc);
        assert_ok(gvi_start_momentum(&st, 0, q0, p0));
        for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, R(0.2)));
        assert_ok(adjoint_start(&A, &ad, st.t, st.q, st.p, end_q, end_p));
        for (int k = 0; k < 10; ++k) assert_ok(adjoint_step(&A, &ad, R(0.2), &g));
        assert_close(g, gradient[e], 128*EPS);
        for (int i = 0; i < N; ++i) {                                    /* retraced */
            assert_close(ad.q[i], q0[i], 64*EPS);
            assert_close(ad.p[i], p0[i], 64*EPS);
        }
    }
}

static int velocity_transposed(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k] - x->q[s+k], da = d->q[k] - d->q[s+k], c = cos(a), D = 1/(2 - c*c), dc = -sin(a)*da;
        real z[2];
        drag_slope(x, k, d->q[k], d->q[s+k], z);
        const real pa = d->p[k] - dc*x->v[s+k] - z[0], pb = d->p[s+k] - dc*x->v[k] - z[1];
        d->velocity[k] = (pa - c*pb)*D;
        d->velocity[s+k] = (2*pb - c*pa)*D;
    }
    return 0;
}

/* A force that turns: neither a gradient nor of the velocity. */
GVI_EACH(turning, 2, f)
{
    x->f[0] -= x->q[1]/4;
    x->f[1] += x->q[0]*x->q[0]/4;
}

static int turning_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        d->f[k] -= d->q[s+k]/4;
        d->f[s+k] += x->q[k]*d->q[k]/2;
    }
    return 0;
}

static int turning_transposed(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count && d->f; ++k) {
        d->f[k] += x->q[k]*d->q[s+k]/2;
        d->f[s+k] -= d->q[k]/4;
    }
    return 0;
}

static const gvi_effect turned[] = { { .kind = GVI_POTENTIAL, .points = attraction },
                                     { .kind = GVI_FORCE, .points = turning },
                                     { .kind = GVI_FORCE, .points = drag } },
                        two_links[] = { { .kind = GVI_POTENTIAL, .points = weight },
                                        { .kind = GVI_FORCE, .points = drag } },
                        by_term[] = { { .kind = GVI_POTENTIAL, .points = weight },
                                      { .kind = GVI_LAGRANGIAN, .points = pendulum_term },
                                      { .kind = GVI_FORCE, .points = drag } },
                        charged[] = { { .kind = GVI_POTENTIAL, .points = attraction },
                                      { .kind = GVI_LAGRANGIAN, .points = magnetic },
                                      { .kind = GVI_FORCE, .points = drag } };
typedef struct scene {
    const char *name;
    gvi_desc    desc;
    tangent_fn *product[3], *transposed[3];
} scene;

#define TURNED .n = N, .effects = turned, .effect_count = 3
#define PRODUCTS { attraction_product, turning_product, drag_product }, \
                 { attraction_product, turning_transposed, drag_transposed }

static const scene scenes[] = {
    { "potential", { .n = N, .degree = 3, .effects = turned, .effect_count = 1 },
      { attraction_product }, { attraction_product } },
    { "kicks", { .n = N, .degree = 1, .effects = turned, .effect_count = 1, .rule = { GVI_KICKS, 4, ruth_at, ruth } },
      { attraction_product }, { attraction_product } },
    { "a magnetic field and drag", { .n = N, .degree = 4, .effects = charged, .effect_count = 3 },
      { attraction_product, magnetic_product, drag_product },
      { attraction_product, magnetic_product, drag_transposed } },
    { "Stoermer-Verlet", { .n = N, .degree = 1, .effects = turned, .effect_count = 1, .rule = { .kind = GVI_LOBATTO } },
      { attraction_product }, { attraction_product } },
    { "forces, degree 1", { TURNED, .degree = 1 }, PRODUCTS },
    { "forces, degree 5", { TURNED, .degree = 5 }, PRODUCTS },
    { "forces, Lobatto", { TURNED, .degree = 3, .rule = { .kind = GVI_LOBATTO, .points = 5 } }, PRODUCTS },
    { "forces, diagonal mass", { TURNED, .degree = 4, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = diagonal } },
      PRODUCTS },
    { "forces, dense mass", { TURNED, .degree = 4, .mass = { .kind = GVI_MASS_DENSE, .matrix = dense } }, PRODUCTS },
    { "M(q) and friction", { .n = N, .degree = 4, .effects = two_links, .effect_count = 2, .mass = PENDULUM },
      { weight_product, drag_product }, { weight_product, drag_transposed } },
    { "no mass but a term, and friction", { .n = N, .degree = 3, .effects = by_term, .effect_count = 3,
                                            .mass = { .kind = GVI_MASS_NONE, .velocity = pendulum_velocity } },
      { weight_product, pendulum_term_product, drag_product }, { weight_product, pendulum_term_product, drag_transposed } },
    { "potential, momenta", { .n = N, .degree = 3, .effects = turned, .effect_count = 1, .formulation = GVI_MOMENTA },
      { attraction_product }, { attraction_product } },
    { "potential, Newton", { .n = N, .degree = 3, .effects = turned, .effect_count = 1, .formulation = GVI_NEWTON },
      { attraction_product }, { attraction_product } },
    { "forces, Newton", { TURNED, .degree = 4, .formulation = GVI_NEWTON }, PRODUCTS },
};

/* dJ/dq.dq + dJ/dp.dp is the same at the end and at the start, for every direction. */
TEST(the_pairing_with_every_direction_is_kept)
{
    for (int i = 0; i < COUNT(scenes); ++i) {
        const scene *s = &scenes[i];
        const real h = R(0.15625);
        tangent T = { .plain = s->desc, .gradient = pendulum_gradient_product, .velocity = pendulum_velocity_product, .directions = 2*N,
                      .room = room, .room_length = TANGENT_ROOM(N, 4) };
        adjoint A = { .plain = s->desc, .gradient = pendulum_gradient_product, .velocity = velocity_transposed,
                      .room = room + TANGENT_ROOM(N, 4), .room_length = ADJOINT_ROOM(N, NODES) };
        gvi_stepper st, ad;
        real dq[N], dp[N], by_q[N], by_p[N];
        for (int k = 0; k < 3; ++k) T.product[k] = s->product[k], A.product[k] = s->transposed[k];
        drag_c = R(0.125);
        assert_ok(tangent_scene(&T));
        assert_ok(adjoint_scene(&A));
        st = new_stepper(&T.desc);
        ad = new_stepper(&A.scene.desc);
        assert_ok(tangent_start(&T, &st, 0, q0, p0, NULL, NULL));
        for (int k = 0; k < 12; ++k) assert_ok(gvi_step(&st, h));
        assert_ok(adjoint_start(&A, &ad, st.t, st.q, st.p, end_q, end_p));
        for (int k = 0; k < 12; ++k) assert_ok(adjoint_step(&A, &ad, h, NULL));
        adjoint_gradient(&A, &ad, by_q, by_p);
        for (int j = 0; j < 2*N; ++j) {
            tangent_column(&T, &st, j, dq, dp);
            real forward = 0, size = 1;
            for (int k = 0; k < N; ++k) {
                forward += end_q[k]*dq[k] + end_p[k]*dp[k];
                size += fabs(end_q[k]*dq[k]) + fabs(end_p[k]*dp[k]);
            }
            const real back = j < N ? by_q[j] : by_p[j-N];
            assert_close(back, forward, 64*EPS*size);
        }
    }
}

/* J = end_q.q + end_p.p at the end + integral of k |q|^2/2 + |v|^2, by the drag, by the strength of the
   magnetic field, which is in the momentum too, and by k: back against the columns of the tangent scene. */

static const real cost_k = R(0.75);

static int cost_with_k(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        if (d->f) d->f[k] += cost_k*x->q[k], d->f[s+k] += cost_k*x->q[s+k];
        if (d->dldv) d->dldv[k] += 2*x->v[k], d->dldv[s+k] += 2*x->v[s+k];
    }
    return 0;
}

static void by_all(real t, const real *q, const real *v, const real *l, const real *dl, real w, int node, real *g,
                   void *user)
{
    real f[N] = { 0 }, p[N] = { 0 };
    const gvi_points x = { .n = N, .count = 1, .stride = 1, .t = &t, .q = q, .v = v, .f = f, .dldv = p };
    by_drag(t, q, v, l, dl, w, node, g, NULL);
    magnetic(&x, NULL);                                      /* linear in its strength, which is 1 */
    g[1] += w*(l[0]*f[0] + l[1]*f[1] + dl[0]*p[0] + dl[1]*p[1]);
    g[2] += w*(q[0]*q[0] + q[1]*q[1])/2;
}

TEST(gradient_by_parameters_of_all_kinds)
{
    enum { DEGREE = 4, STEPS = 10 };
    const gvi_desc plain = { .n = N, .degree = DEGREE, .effects = charged, .effect_count = 3 };
    const real h = R(0.15625);
    tangent T = { .plain = plain, .product = { attraction_product, magnetic_product, drag_product }, .parameters = 2,
                  .room = room, .room_length = TANGENT_ROOM(N, 2) };
    adjoint A = { .plain = plain, .product = { attraction_product, magnetic_product, drag_transposed },
                  .running = cost_with_k, .by_parameters = by_all,
                  .room = room + TANGENT_ROOM(N, 4), .room_length = ADJOINT_ROOM(N, NODES) };
    gvi_stepper st, ad;
    real forward[3] = { 0 }, back[3] = { 0 }, size[3] = { 1, 1, 1 }, c[DEGREE], b[DEGREE], q[3*N], v[3*N];
    drag_c = R(0.125);
    assert_ok(gvi_gauss(DEGREE, c, b));
    assert_ok(tangent_scene(&T));
    assert_ok(adjoint_scene(&A));
    st = new_stepper(&T.desc);
    ad = new_stepper(&A.scene.desc);
    assert_ok(tangent_start(&T, &st, 0, q0, p0, NULL, NULL));
    for (int k = 0; k < STEPS; ++k) {
        assert_ok(gvi_step(&st, h));
        for (int i = 0; i < DEGREE; ++i) {
            assert_ok(gvi_curve(&st, c[i], q, v));
            for (int j = 0; j < N; ++j) {
                forward[2] += h*b[i]*q[j]*q[j]/2;
                for (int z = 0; z < 2; ++z) {
                    const int at = N*(1 + z) + j;
                    forward[z] += h*b[i]*(cost_k*q[j]*q[at] + 2*v[j]*v[at]);
                    size[z] += h*b[i]*fabs(cost_k*q[j]*q[at]) + h*b[i]*fabs(2*v[j]*v[at]);
                }
            }
        }
    }
    for (int z = 0; z < 2; ++z) {
        tangent_column(&T, &st, z, q, v);
        for (int j = 0; j < N; ++j) {
            forward[z] += end_q[j]*q[j] + end_p[j]*v[j];
            size[z] += fabs(end_q[j]*q[j]) + fabs(end_p[j]*v[j]);
        }
    }
    assert_ok(adjoint_start(&A, &ad, st.t, st.q, st.p, end_q, end_p));
    for (int k = 0; k < STEPS; ++k) assert_ok(adjoint_step(&A, &ad, h, back));
    for (int z = 0; z < 3; ++z) {
        assert_true(fabs(forward[z]) > R(0.1));
        assert_close(back[z], forward[z], 64*EPS*size[z]);
    }
}

/* q'' = -q - c q' with c = 2.5 over 20: the modes exp(-t/2), exp(-2t) go back as exp(t/2),
   exp(2t), and 80 steps multiply the rounding of the end by 1e17.  States kept at every fourth
   step hold the gradient of J, the integral of q^2, to rounding. */

GVI_EACH(damped, 1, v, f) { x->f[0] -= x->q[0] + R(2.5)*x->v[0]; }

static int damped_transposed(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        if (d->f) d->f[k] -= d->q[k];
        if (d->dldv) d->dldv[k] -= R(2.5)*d->q[k];
    }
    return 0;
}

static int square(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    for (int k = 0; k < x->count && d->f; ++k) d->f[k] += 2*x->q[k];
    return 0;
}

static void by_c(real t, const real *q, const real *v, const real *l, const real *dl,
                 real weight, int node, real *g, void *user)
{
    g[0] -= weight*v[0]*l[0];
}

static void damped_gradient(int every, real *by_q, real *by_damping)
{
    static real kept[ADJOINT_KEPT(1, 80, 1)];
    const gvi_effect effect = { .kind = GVI_FORCE, .points = damped };
    adjoint A = { .plain = { .n = 1, .degree = 8, .effects = &effect, .effect_count = 1 },
                  .product = { damped_transposed },
                  .running = square, .by_parameters = by_c, .room = room, .room_length = ADJOINT_ROOM(1, 8),
                  .kept = every ? kept : NULL, .kept_length = every ? ADJOINT_KEPT(1, 80, every) : 0, .every = every };
    gvi_stepper st, ad;
    real by_p;
    const real q = 1, p = R(0.25), none = 0, h = R(0.25);
    *by_damping = 0;
    assert_ok(adjoint_scene(&A));
    st = new_stepper(&A.plain);
    ad = new_stepper(&A.scene.desc);
    assert_ok(gvi_start_momentum(&st, 0, &q, &p));
    if (every) assert_ok(adjoint_keep(&A, &st));
    for (int k = 0; k < 80; ++k) {
        assert_ok(gvi_step(&st, h));
        if (every) assert_ok(adjoint_keep(&A, &st));
    }
    assert_ok(adjoint_start(&A, &ad, st.t, st.q, st.p, &none, &none));
    for (int k = 0; k < 80; ++k) assert_ok(adjoint_step(&A, &ad, h, by_damping));
    adjoint_gradient(&A, &ad, by_q, &by_p);
}

/* From the closed form of J, in 40 digits. */
TEST(kept_states_hold_the_gradient_under_strong_damping)
{
    const long double exact_q = 3.149999991755385510245948704788715L, exact_c = 0.4149999398830193455394625389761956L;
    real by_q, by_damping;
    for (int every = 1; every <= 4; every += 3) {
        damped_gradient(every, &by_q, &by_damping);
        assert_close(by_q, exact_q, 8*EPS);
        assert_close(by_damping, exact_c, 8*EPS);
    }
    damped_gradient(0, &by_q, &by_damping);                /* nothing kept: that is what it is for */
    assert_false(fabs(by_q - (real)exact_q) < 10000*EPS);
}

static int distance(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count && x->value; ++k) x->value[k] += 1;
    return 0;
}

TEST(scenes_without_an_adjoint_are_refused)
{
    static const gvi_effect with_clock[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                                             { .kind = GVI_CLOCK, .points = distance } };
    static const real at[] = { 0, R(0.25), 1 }, kick[] = { R(0.25), R(0.25), R(0.5) };
    adjoint A = { .plain = { .n = N, .effects = turned, .effect_count = 1, .rule = { GVI_KICKS, 3, at, kick } },
                  .product = { attraction_product }, .room = room, .room_length = ADJOINT_ROOM(N, 8) };
    gvi_stepper ad;
    assert_status(adjoint_scene(&A), GVI_E_FORMULATION);
    A.plain.rule = (gvi_rule){ 0 };
    assert_ok(adjoint_scene(&A));
    ad = new_stepper(&A.scene.desc);
    --A.room_length;
    assert_status(adjoint_start(&A, &ad, 0, q0, p0, end_q, end_p), GVI_E_MEMORY);
    ++A.room_length;
    for (int i = 0; i < 4; ++i)
        assert_status(adjoint_start(&A, &ad, 0, i == 0 ? NULL : q0, i == 1 ? NULL : p0, i == 2 ? NULL : end_q, i == 3 ? NULL : end_p),
                      GVI_E_ARGUMENT);
    A.every = 1, A.kept_length = 100;
    assert_status(adjoint_keep(&A, &ad), GVI_E_ARGUMENT);                     /* nowhere to keep it */

    real kept[2*(2*N + 1)];                      /* two states, not three */
    A.kept = kept, A.kept_length = COUNT(kept), A.every = 1;
    assert_ok(gvi_start_momentum(&ad, 0, (real[]){ 1, 0, 0, 0 }, (real[]){ 0, 1, 0, 0 }));
    assert_ok(adjoint_keep(&A, &ad));
    assert_ok(adjoint_keep(&A, &ad));
    assert_status(adjoint_keep(&A, &ad), GVI_E_MEMORY);
    for (A.every = -1; A.every <= 0; ++A.every) assert_status(adjoint_keep(&A, &ad), GVI_E_ARGUMENT);

    A.plain.rule = (gvi_rule){ .kind = GVI_OWN, .points = 3 };                 /* nodes are missing */
    assert_ok(adjoint_scene(&A));
    assert_status(gvi_init(&ad, &A.scene.desc, NULL, 0), GVI_E_ARGUMENT);
    A.plain.rule = (gvi_rule){ 0 };

    A.plain.effects = with_clock, A.plain.effect_count = 2;
    A.product[1] = tangent_constant;
    assert_status(adjoint_scene(&A), GVI_E_FORMULATION);
    A.plain.effects = two_links;
    A.plain.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = pendulum_matrix, .gradient = pendulum_gradient };
    assert_status(adjoint_scene(&A), GVI_E_FORMULATION);
}

RUN_TESTS(NULL, NULL)
