/* examples/tools/tangent.h: the derivative of a step.  What is expected comes from
   theory (the matrix of a step is symplectic), from Kepler's equation in 50 digits,
   and from differences of the scene alone. */
#include "gvi_test.h"
#include "tools/tangent.h"
#include "products.h"
enum { N = 2, MOST = 6, ROWS = N*(1 + MOST), ROOM = 13*ROWS + ROWS*ROWS };

static real other_memory[20000], room[ROOM];

/* Henon and Heiles: V = (x^2 + y^2)/2 + x^2 y - y^3/3 */
GVI_EACH(heiles, 2, f)
{
    const real a = x->q[0], b = x->q[1];
    x->f[0] -= a + 2*a*b;
    x->f[1] -= b + a*a - b*b;
}

static int heiles_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k], b = x->q[s+k], da = d->q[k], db = d->q[s+k];
        d->f[k] -= (1 + 2*b)*da + 2*a*db;
        d->f[s+k] -= 2*a*da + (1 - 2*b)*db;
    }
    return 0;
}

static int heiles_point(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] -= q[0] + 2*q[0]*q[1];
    f[1] -= q[1] + q[0]*q[0] - q[1]*q[1];
    return 0;
}

/* Friction -c |v|^2 v; c is parameter 0. */
static real friction_c;

GVI_EACH(friction, 2, v, f)
{
    const real a = x->v[0], b = x->v[1], z = a*a + b*b;
    x->f[0] -= friction_c*z*a;
    x->f[1] -= friction_c*z*b;
}

static int friction_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->v[k], b = x->v[s+k], da = d->v[k], db = d->v[s+k], z = a*a + b*b;
        const real dc = parameter == 0, dz = 2*(a*da + b*db);
        d->f[k] -= friction_c*(z*da + dz*a) + dc*z*a;
        d->f[s+k] -= friction_c*(z*db + dz*b) + dc*z*b;
    }
    return 0;
}

static int clock_rate(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count && x->value; ++k) x->value[k] += 1;
    return 0;
}

static const gvi_effect
    of_heiles[] = { { .kind = GVI_POTENTIAL, .points = heiles } },
    of_heiles_point[] = { { .kind = GVI_POTENTIAL, .point = heiles_point } },
    of_kepler[] = { { .kind = GVI_POTENTIAL, .points = attraction } },
    of_friction[] = { { .kind = GVI_POTENTIAL, .points = heiles }, { .kind = GVI_FORCE, .points = friction } },
    of_magnetic[] = { { .kind = GVI_POTENTIAL, .points = heiles }, { .kind = GVI_LAGRANGIAN, .points = magnetic } },
    of_weight[] = { { .kind = GVI_POTENTIAL, .points = weight } },
    of_rubbed[] = { { .kind = GVI_POTENTIAL, .points = weight }, { .kind = GVI_FORCE, .points = friction } },
    of_term[] = { { .kind = GVI_POTENTIAL, .points = weight }, { .kind = GVI_LAGRANGIAN, .points = pendulum_term } };

#define HEILES .n = N, .effects = of_heiles, .effect_count = 1

typedef struct scene {
    const char *name;
    gvi_desc    desc;
    tangent_fn *product[2];
    int         forced;              /* friction: not symplectic */
    gvi_formulation used;
} scene;

#define FACTORED { .kind = GVI_MASS_POSITION, .points = pendulum_matrix, .gradient = pendulum_gradient }

static const scene scenes[] = {
    { "positions, degree 1", { HEILES, .degree = 1 }, { heiles_product }, 0, GVI_POSITIONS },
    { "positions, degree 3", { HEILES, .degree = 3 }, { heiles_product }, 0, GVI_POSITIONS },
    { "positions, degree 8", { HEILES, .degree = 8 }, { heiles_product }, 0, GVI_POSITIONS },
    { "one point a call", { .n = N, .degree = 4, .effects = of_heiles_point, .effect_count = 1 },
      { heiles_product }, 0, GVI_POSITIONS },
    { "Stoermer-Verlet", { HEILES, .degree = 1, .rule = { .kind = GVI_LOBATTO } }, { heiles_product }, 0, GVI_EXPLICIT },
    { "kicks of Forest and Ruth", { HEILES, .degree = 1, .rule = { GVI_KICKS, 4, ruth_at, ruth } },
      { heiles_product }, 0, GVI_EXPLICIT },
    { "Lobatto, 6 points, degree 3", { HEILES, .degree = 3, .rule = { .kind = GVI_LOBATTO, .points = 6 } },
      { heiles_product }, 0, GVI_POSITIONS },
    { "Newton, degree 4", { HEILES, .degree = 4, .formulation = GVI_NEWTON }, { heiles_product }, 0, GVI_NEWTON },
    { "diagonal mass", { HEILES, .degree = 4, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = diagonal } },
      { heiles_product }, 0, GVI_POSITIONS },
    { "dense mass", { HEILES, .degree = 4, .mass = { .kind = GVI_MASS_DENSE, .matrix = dense } },
      { heiles_product }, 0, GVI_POSITIONS },
    { "unit mass in momenta", { HEILES, .degree = 4, .formulation = GVI_MOMENTA }, { heiles_product }, 0, GVI_MOMENTA },
    { "velocities, friction", { .n = N, .degree = 4, .effects = of_friction, .effect_count = 2 },
      { heiles_product, friction_product }, 1, GVI_VELOCITIES },
    { "Newton, magnetic", { .n = N, .degree = 3, .effects = of_magnetic, .effect_count = 2, .formulation = GVI_NEWTON },
      { heiles_product, magnetic_product }, 0, GVI_NEWTON },
    { "M(q), degree 4", { .n = N, .degree = 4, .effects = of_weight, .effect_count = 1, .mass = PENDULUM },
      { weight_product }, 0, GVI_MOMENTA },
    { "M(q) and friction", { .n = N, .degree = 4, .effects = of_rubbed, .effect_count = 2, .mass = PENDULUM },
      { weight_product, friction_product }, 1, GVI_MOMENTA },
    { "M(q) to be factored, degree 3", { .n = N, .degree = 3, .effects = of_weight, .effect_count = 1, .mass = FACTORED },
      { weight_product }, 0, GVI_MOMENTA },
    { "M(q) to be factored and friction", { .n = N, .degree = 4, .effects = of_rubbed, .effect_count = 2, .mass = FACTORED },
      { weight_product, friction_product }, 1, GVI_MOMENTA },
    { "no mass but a term", { .n = N, .degree = 4, .effects = of_term, .effect_count = 2,
                              .mass = { .kind = GVI_MASS_NONE, .velocity = pendulum_velocity } },
      { weight_product, pendulum_term_product }, 0, GVI_MOMENTA },
};

static const real q0[] = { R(0.125), R(0.25) }, p0[] = { R(0.4375), R(-0.125) };

/* The scene with its directions, 2 parameters if wanted, and h if wanted. */
static gvi_stepper *made(tangent *T, const scene *s, int directions, int parameters, real h)
{
    static gvi_stepper st;
    *T = (tangent){ .plain = s->desc, .product = { s->product[0], s->product[1] },
                    .gradient = pendulum_gradient_product, .velocity = pendulum_velocity_product,
                    .directions = directions, .parameters = parameters, .by_h = h > 0, .h = h,
                    .room = room, .room_length = COUNT(room) };
    friction_c = R(0.25);
    coupling = 1;
    assert_ok(tangent_scene(T));
    st = new_stepper(&T->desc);
    assert_ok(tangent_start(T, &st, 0, q0, p0, NULL, NULL));
    return &st;
}

/* The scene alone, for `steps` of h, from where start says: the end (q, p). */
static void alone(const scene *s, const real *start, real h, int steps, real *end)
{
    gvi_stepper st;
    assert_true(gvi_size(&s->desc) <= sizeof other_memory);
    st = new_stepper(&s->desc);
    assert_ok(gvi_start_momentum(&st, 0, start, start + N));
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, h));
    for (int i = 0; i < N; ++i) end[i] = st.q[i], end[N + i] = st.p[i];
}

/* Differences of the scene alone, to order 4: by state variable j < 4, by the parameters
   (4 the friction, 5 the coupling), or by h (6). */
static void differences(const scene *s, int j, real h, int steps, real *out)
{
    const real D = pow((real)EPS, R(0.2))/4;
    for (int i = 0; i < 2*N; ++i) out[i] = 0;
    for (int z = 0; z < 4; ++z) {
        const real move = (z%2 ? -1 : 1)*(z/2 ? 2*D : D), w = (real)((z%2 ? -1 : 1)*(z/2 ? -1 : 8))/(12*D);
        real start[] = { q0[0], q0[1], p0[0], p0[1] }, end[2*N];
        friction_c = R(0.25) + (j == 4 ? move : 0);
        coupling = 1 + (j == 5 ? move : 0);
        if (j < 4) start[j] += move;
        alone(s, start, h + (j == 6 ? move : 0), steps, end);
        for (int i = 0; i < 2*N; ++i) out[i] += w*end[i];
    }
    friction_c = R(0.25);
    coupling = 1;
}

/* |M' J M - J|, the largest entry; M by columns (q, p). */
static real defect(real M[2*N][2*N], real *most)
{
    real worst = 0;
    *most = 1;
    for (int a = 0; a < 2*N; ++a)
        for (int b = 0; b < 2*N; ++b) {
            long double z = (a == b + N) - (b == a + N);
            for (int i = 0; i < N; ++i)
                z += (long double)M[a][i]*M[b][N+i] - (long double)M[a][N+i]*M[b][i];
            worst = fmax(worst, (real)fabsl(z));
            *most = fmax(*most, fabs(M[a][b]));
        }
    return worst;
}

TEST(a_step_with_its_derivative_is_symplectic)
{
    for (int i = 0; i < COUNT(scenes); ++i)
        for (int z = 0; z < 2; ++z) {
            const real h = z ? R(0.3125) : R(0.0625);
            const int pendulum = scenes[i].desc.effects[0].points == weight;
            tangent T;
            if (scenes[i].forced) continue;
            gvi_stepper *st = made(&T, &scenes[i], 2*N, 0, 0);
            real M[2*N][2*N], most;
            for (int k = 0; k < 20; ++k) {
                assert_ok(gvi_step(st, pendulum ? h/4 : h));
                for (int j = 0; j < 2*N; ++j) tangent_column(&T, st, j, M[j], M[j] + N);
                const real d = defect(M, &most);
                assert_between(0, d, 16*EPS*most*most);
            }
            assert_int_equal(st->formulation, scenes[i].used);
        }
}

TEST(so_is_a_run_by_the_dial)
{
    const scene kepler = { "Kepler", { .n = N, .effects = of_kepler, .effect_count = 1, .resolution = KIND == 1 ? R(1e-4) : R(1e-9) },
                           { attraction_product }, 0, GVI_POSITIONS };
    tangent T;
    real M[2*N][2*N], most, q[] = { R(0.5), 0 }, p[] = { 0, R(1.75) };
    gvi_stepper *st = made(&T, &kepler, 2*N, 0, 0);
    int steps = 0;
    assert_ok(tangent_start(&T, st, 0, q, p, NULL, NULL));
    for (; st->t < 8; ++steps) assert_ok(gvi_advance(st, 8));
    for (int j = 0; j < 2*N; ++j) tangent_column(&T, st, j, M[j], M[j] + N);
    const real d = defect(M, &most);
    assert_between(0, d, 2*N*EPS*most*most);                  // entries rounded to EPS/2, 2N products of two
    assert_true(steps > 4);
}

/* By state, by parameters and by h, after 8 steps. */
TEST(every_column_is_what_differences_say)
{
    for (int i = 0; i < COUNT(scenes); ++i) {
        const scene *s = &scenes[i];
        const int pendulum = s->desc.effects[0].points == weight, tests = pendulum || s->forced,
                  factored = pendulum && !s->desc.mass.velocity;            // then M has no parameter
        const real h = pendulum ? R(0.0625) : R(0.1875);
        tangent T;
        gvi_stepper *st = made(&T, s, tests ? 1 : 2*N, factored ? 1 : tests ? 2 : 0, h);
        for (int k = 0; k < 8; ++k) assert_ok(gvi_step(st, h));
        for (int j = 0; j < T.columns; ++j) {
            real column[2*N], wanted[2*N], most = 1;
            tangent_column(&T, st, j, column, column + N);
            differences(s, j < T.directions ? j : j == T.columns - 1 ? 6 : 4 + j - T.directions, h, 8, wanted);
            for (int k = 0; k < 2*N; ++k) most = fmax(most, fabs(wanted[k]));
            for (int k = 0; k < 2*N; ++k) {
                const real tol = 400*pow((real)EPS, R(0.8))*most;
                assert_close(column[k], wanted[k], tol);
            }
        }
    }
}

/* The state beside its derivative is that of the scene alone, but for another number of
   iterations. */
TEST(the_motion_is_the_same)
{
    for (int i = 0; i < COUNT(scenes); ++i) {
        const real h = scenes[i].desc.effects[0].points == weight ? R(0.0625) : R(0.25);
        const real start[] = { q0[0], q0[1], p0[0], p0[1] };
        tangent T;
        real end[2*N];
        gvi_stepper *st = made(&T, &scenes[i], 2*N, 0, 0);
        for (int k = 0; k < 50; ++k) assert_ok(gvi_step(st, h));
        alone(&scenes[i], start, h, 50, end);
        for (int k = 0; k < N; ++k) {
            assert_close(st->q[k], end[k], 8*EPS);
            assert_close(st->p[k], end[N+k], 8*EPS);
        }
    }
}

/* With a given number of iterations not even that differs: the same bits.  Left to themselves they part
   (in float they happen not to). */
TEST(given_iterations_make_the_same_bits)
{
    scene s = { "given", { HEILES, .degree = 8, .iterations = 12 }, { heiles_product }, 0, GVI_POSITIONS };
    const real start[] = { q0[0], q0[1], p0[0], p0[1] }, h = R(0.4);
    real end[2*N];
    tangent T;
    for (int given = 1; given >= 0; --given) {
        s.desc.iterations = 12*given;
        gvi_stepper *st = made(&T, &s, 1, 0, 0);
        for (int k = 0; k < 1000; ++k) assert_ok(gvi_step(st, h));
        alone(&s, start, h, 1000, end);
        int same = 1;
        for (int k = 0; k < N; ++k) same = same && st->q[k] == end[k] && st->p[k] == end[N+k];
        assert_true(same == given || (DIG < 50 && !given));
    }
}

/* Kepler, e = 0.6, three quarters of a revolution from the pericentre: the derivative of the
   motion, from Kepler's equation in 80 digits. */
static const long double kepler_exact[4][4] = {
    { -79.07308723498460733702751L, -2.000955817470989425996232L,
      -0.7472129229862102570649894L, -25.80888329793299832150607L },
    { 22.06606955485905022458062L, 4.163682683656246384009329L,
      1.38140768767370103713952L, 7.354426359653600316318849L },
    { -51.23436322364835783480574L, -0.6083820638830060705750963L,
      -0.2748927531006705711666885L, -16.61606970653625514425881L },
    { -25.58195941868144992730694L, -2.361277443582027627662347L,
      -0.8063400555773231528643289L, -8.144761093859571391205861L },
};

static real kepler_error(int degree, int steps)
{
    const scene s = { "Kepler", { .n = N, .degree = degree, .effects = of_kepler, .effect_count = 1 },
                      { attraction_product }, 0, 0 };
    const real h = R(4.71238898038468985769396507492)/(real)steps, q[] = { R(0.4), 0 }, p[] = { 0, 2 };
    tangent T;
    real column[2*N], worst = 0;
    gvi_stepper *st = made(&T, &s, 2*N, 0, 0);
    assert_ok(tangent_start(&T, st, 0, q, p, NULL, NULL));
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(st, h));
    for (int j = 0; j < 2*N; ++j) {
        tangent_column(&T, st, j, column, column + N);
        for (int i = 0; i < 2*N; ++i) worst = fmax(worst, fabs(column[i] - (real)kepler_exact[i][j]));
    }
    return worst;
}

TEST(keplers_derivative_has_order_2s)
{
    if (DIG < 50) {                              /* float: what rounding leaves of 79 */
        assert_between(0, kepler_error(4, 80), 79*300*EPS);
        return;
    }
    static const int steps[] = { 320, 160, 160, 80 };
    for (int s = 1; s <= 4; ++s) {
        const real coarse = kepler_error(s, steps[s-1]), fine = kepler_error(s, 2*steps[s-1]);
        assert_between(2*s - 0.15L, log2(coarse/fine), 2*s + 0.15L);
    }
    assert_between(0, kepler_error(8, 80), 79*100*EPS + R(1e-15));
}

TEST(scenes_without_a_tangent_are_refused)
{
    static const gvi_effect with_clock[] = { { .kind = GVI_POTENTIAL, .points = heiles, .value = heiles },
                                             { .kind = GVI_CLOCK, .points = clock_rate } },
                            with_row[] = { { .kind = GVI_CONSTRAINT, .points = heiles, .rows = 1 } };
    gvi_stepper st;
    real energy;
    tangent T = { .plain = { .n = N, .effects = with_clock, .effect_count = 2 },
                  .product = { heiles_product, tangent_constant },
                  .directions = 4, .room = room, .room_length = COUNT(room) };
    assert_status(tangent_scene(&T), GVI_E_FORMULATION);
    T.plain.effect_count = 1;
    assert_ok(tangent_scene(&T));
    st = new_stepper(&T.desc);
    assert_ok(tangent_start(&T, &st, 0, q0, p0, NULL, NULL));
    assert_status(gvi_energy(&st, &energy), GVI_E_VALUE);
    T.plain.effects = with_row;
    assert_status(tangent_scene(&T), GVI_E_FORMULATION);
    T.plain.effects = NULL;
    assert_status(tangent_scene(&T), GVI_E_ARGUMENT);
    T.plain.effects = with_clock;
    T.room_length = 20*N + 3*5*N - 1;
    assert_status(tangent_scene(&T), GVI_E_MEMORY);
    T.room_length = COUNT(room);
    T.product[0] = NULL;
    assert_status(tangent_scene(&T), GVI_E_ARGUMENT);
    T.product[0] = heiles_product;
    T.by_h = 1;
    assert_status(tangent_scene(&T), GVI_E_ARGUMENT);
    T.by_h = 0;
    T.plain.mass = (gvi_mass)PENDULUM;
    assert_status(tangent_scene(&T), GVI_E_ARGUMENT);            /* no products */
    T.velocity = pendulum_velocity_product;
    T.gradient = pendulum_gradient_product;
    assert_ok(tangent_scene(&T));
    T.plain.formulation = GVI_NEWTON;
    assert_status(tangent_scene(&T), GVI_E_FORMULATION);
    T.plain.formulation = GVI_AUTO;
    T.plain.mass.velocity = NULL;
    T.velocity = NULL;
    assert_ok(tangent_scene(&T));                                /* factored */
    T.plain.mass.kind = GVI_MASS_NONE;
    assert_status(tangent_scene(&T), GVI_E_FORMULATION);
    T.plain.mass.kind = GVI_MASS_POSITION;
    T.gradient = NULL;
    assert_status(tangent_scene(&T), GVI_E_ARGUMENT);
}

/* An arm of six joints, rod after rod, angles to the vertical: M_ij = B_ij cos(q_i - q_j), B_ij = 7 - max(i, j) and 1/4 on the
   diagonal besides.  No closed form of M^-1. */
enum { JOINTS = 6, ARM = JOINTS*(1 + 2*JOINTS) };

static real arm_b(int i, int j) { return (real)(7 - (i > j ? i : j)) + (i == j ? R(0.25) : 0); }

static int arm_mass(const gvi_points *x, void *user)
{
    for (int i = 0; i < JOINTS; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < x->count; ++k)
                x->mass[(i*JOINTS + j)*x->stride + k] = arm_b(i, j)*cos(x->q[i*x->stride + k] - x->q[j*x->stride + k]);
    return 0;
}

static int arm_gradient(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int i = 0; i < JOINTS; ++i)
        for (int j = 0; j < JOINTS; ++j)
            for (int k = 0; k < x->count; ++k)
                x->f[i*s + k] -= arm_b(i, j)*sin(x->q[i*s + k] - x->q[j*s + k])*x->v[i*s + k]*x->v[j*s + k];
    return 0;
}

static int arm_gradient_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    for (int i = 0; i < JOINTS; ++i)
        for (int j = 0; j < JOINTS; ++j)
            for (int k = 0; k < x->count; ++k) {
                const int a = i*s + k, b = j*s + k;
                const real turn = x->q[a] - x->q[b];
                d->f[a] -= arm_b(i, j)*(cos(turn)*(d->q[a] - d->q[b])*x->v[a]*x->v[b]
                                        + sin(turn)*(d->v[a]*x->v[b] + x->v[a]*d->v[b]));
            }
    return 0;
}

AT_EACH(arm_weight) { x->f[a] -= 4*sin(x->q[a]); }

static int arm_weight_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    FOR_EACH(x, a) d->f[a] -= 4*cos(x->q[a])*d->q[a];
    return 0;
}

TEST(an_arm_of_six_joints_is_symplectic_and_what_differences_say)
{
    static real arm_room[TANGENT_ROOM(JOINTS, 2*JOINTS)], M[2*JOINTS][2*JOINTS];
    const gvi_effect weight_of[] = { { .kind = GVI_POTENTIAL, .points = arm_weight } };
    const gvi_desc arm = { .n = JOINTS, .degree = 4, .effects = weight_of, .effect_count = 1,
                           .mass = { .kind = GVI_MASS_POSITION, .points = arm_mass, .gradient = arm_gradient } };
    tangent T = { .plain = arm, .product = { arm_weight_product }, .gradient = arm_gradient_product,
                  .directions = 2*JOINTS, .room = arm_room, .room_length = 20*JOINTS + 2*ARM + 2*JOINTS*JOINTS - 1 };
    real start[2*JOINTS], most = 1, D = pow((real)EPS, R(0.2))/8;
    assert_status(tangent_scene(&T), GVI_E_MEMORY);
    ++T.room_length;
    assert_ok(tangent_scene(&T));
    for (int i = 0; i < JOINTS; ++i) start[i] = R(0.25)*(real)(1 + i%3), start[JOINTS + i] = R(0.5)*(real)(i%2) - R(0.25);
    gvi_stepper st = new_stepper(&T.desc);
    assert_ok(tangent_start(&T, &st, 0, start, start + JOINTS, NULL, NULL));
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, R(0.03125)));
    for (int j = 0; j < 2*JOINTS; ++j) {
        tangent_column(&T, &st, j, M[j], M[j] + JOINTS);
        for (int i = 0; i < 2*JOINTS; ++i) most = fmax(most, fabs(M[j][i]));
    }
    for (int a = 0; a < 2*JOINTS; ++a)
        for (int b = 0; b < 2*JOINTS; ++b) {
            long double z = 0;
            for (int i = 0; i < JOINTS; ++i)
                z += (long double)M[a][i]*M[b][JOINTS + i] - (long double)M[a][JOINTS + i]*M[b][i];
            assert_close(z, (b == a + JOINTS) - (a == b + JOINTS), 16*EPS*most*most);
        }
    for (int j = 0; j < 2*JOINTS; ++j) {
        real slope[2*JOINTS] = { 0 };
        for (int z = 0; z < 4; ++z) {
            const real move = (z%2 ? -1 : 1)*(z/2 ? 2*D : D), w = (real)((z%2 ? -1 : 1)*(z/2 ? -1 : 8))/(12*D);
            real from[2*JOINTS];
            memcpy(from, start, sizeof from);
            from[j] += move;
            gvi_stepper one = new_stepper(&arm);
            assert_ok(gvi_start_momentum(&one, 0, from, from + JOINTS));
            for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&one, R(0.03125)));
            for (int i = 0; i < JOINTS; ++i) slope[i] += w*one.q[i], slope[JOINTS + i] += w*one.p[i];
        }
        for (int i = 0; i < 2*JOINTS; ++i) assert_close(M[j][i], slope[i], 400*pow((real)EPS, R(0.8))*most);
    }
}

static int wrong_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    heiles_product(x, d, parameter, user);
    for (int k = 0; k < x->count; ++k) d->f[k] += d->q[x->stride+k]/50;
    return 0;
}

static int nan_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    for (int k = 0; k < x->count; ++k) d->f[k] += (real)NAN;
    return 0;
}

/* Products that are right agree with differences; a term that is off by 2 % is found. */
TEST(the_check_finds_what_is_off_by_2_percent)
{
    const real v[] = { R(0.5), R(-0.75) }, dq[] = { R(0.25), R(0.5) }, dv[] = { R(-0.5), R(0.75) };
    tangent T;
    int part = -1;
    for (int i = 0; i < COUNT(scenes); ++i) {
        made(&T, &scenes[i], 1, 0, 0);
        assert_between(0, tangent_check(&T, 0, q0, v, dq, dv, &part), 400*pow((real)EPS, R(0.8)));
    }
    made(&T, &scenes[0], 1, 0, 0);
    T.product[0] = wrong_product;
    assert_ok(tangent_scene(&T));
    assert_between(0.005L, tangent_check(&T, 0, q0, v, dq, dv, &part), 0.1L);
    assert_int_equal(part, 0);
    T.product[0] = nan_product;
    assert_ok(tangent_scene(&T));
    part = -1;
    assert_true(isnan(tangent_check(&T, 0, q0, v, dq, dv, &part)));
    assert_int_equal(part, 0);
    made(&T, &scenes[COUNT(scenes) - 2], 1, 0, 0);
    T.gradient = tangent_constant;
    assert_ok(tangent_scene(&T));
    assert_between(1, tangent_check(&T, 0, q0, v, dq, dv, &part), 1);
    assert_int_equal(part, GVI_EFFECTS + 1);
}

RUN_TESTS(NULL, NULL)
