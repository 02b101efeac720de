/* A tolerance: what is left undone is no more than that, and where there is nothing left to do
   it changes no more than the last places, in every formulation and for every number of points. */
#include "gvi_test.h"

typedef gvi_real real;
enum { N = 3, STEPS = 24 };

/* V = sum q_i^4/4 + sum (q_i+1 - q_i)^2/2 */
static int chain(const gvi_points *x, void *user)
{
    const int R = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < N; ++i) {
            const real q = x->q[i*R + k];
            const real left = i > 0 ? q - x->q[(i - 1)*R + k] : 0, right = i < N - 1 ? x->q[(i + 1)*R + k] - q : 0;
            x->f[i*R + k] += right - left - q*q*q;
        }
    return 0;
}

static int friction(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < N; ++i) x->f[i*x->stride + k] -= x->v[i*x->stride + k]/16;
    return 0;
}

/* L = q_1 v_2 - q_2 v_1, halved */
static int magnetic(const gvi_points *x, void *user)
{
    const int R = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] += x->v[R + k]/2;
        x->f[R + k] -= x->v[k]/2;
        x->dldv[k] -= x->q[R + k]/2;
        x->dldv[R + k] += x->q[k]/2;
    }
    return 0;
}

/* M = diag(2 + cos q_i) */
static int mass(const gvi_points *x, void *user)
{
    const int R = x->stride;
    (void)user;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < N; ++i)
            for (int j = 0; j <= i; ++j)
                x->mass[(i*N + j)*R + k] = i == j ? 2 + (real)cosl((long double)x->q[i*R + k]) : 0;
    return 0;
}

static int gradient(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < N*x->stride; ++k)
        if (k % x->stride < x->count) x->f[k] -= (real)sinl((long double)x->q[k])*x->v[k]*x->v[k]/2;
    return 0;
}

enum { FRICTION = 1, MAGNETIC = 2 };
typedef struct scene { gvi_formulation formulation; gvi_mass_kind mass; int more; } scene;

static const scene scenes[] = {
    { GVI_POSITIONS, GVI_MASS_UNIT, 0 }, { GVI_POSITIONS, GVI_MASS_DIAGONAL, 0 }, { GVI_POSITIONS, GVI_MASS_DENSE, 0 },
    { GVI_VELOCITIES, GVI_MASS_UNIT, FRICTION }, { GVI_VELOCITIES, GVI_MASS_DENSE, FRICTION },
    { GVI_VELOCITIES, GVI_MASS_UNIT, FRICTION | MAGNETIC }, { GVI_MOMENTA, GVI_MASS_UNIT, MAGNETIC },
    { GVI_MOMENTA, GVI_MASS_POSITION, 0 }, { GVI_MOMENTA, GVI_MASS_POSITION, FRICTION },
    { GVI_AUTO, GVI_MASS_UNIT, FRICTION }
};

static gvi_desc describe(const scene *a, int r, gvi_effect *effects)
{
    static const real diagonal[N] = { 1, 2, 3 }, dense[N*N] = { 2, 0, 0, (real)0.5, 2, 0, 0, (real)0.5, 1 };
    gvi_desc d = { .n = N, .degree = r, .effects = effects, .formulation = a->formulation };
    d.rule.points = r;
    d.mass.kind = a->mass;
    if (a->mass == GVI_MASS_DIAGONAL) d.mass.matrix = diagonal;
    if (a->mass == GVI_MASS_DENSE) d.mass.matrix = dense;
    if (a->mass == GVI_MASS_POSITION) d.mass.points = mass, d.mass.gradient = gradient;
    effects[d.effect_count++] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = chain };
    if (a->more & FRICTION) effects[d.effect_count++] = (gvi_effect){ .kind = GVI_FORCE, .points = friction };
    if (a->more & MAGNETIC) effects[d.effect_count++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = magnetic };
    return d;
}

/* Steps of three lengths in turn, so that the tables are made anew, to and fro; a state inside each */
static double run(const scene *a, int r, real tolerance, real *q, real *inside)
{
    gvi_effect effects[3];
    gvi_desc d = describe(a, r, effects);
    d.tolerance = tolerance;
    real *memory = malloc(gvi_size(&d));
    const real start[N] = { 1, 0, (real)-0.5 }, v[N] = { 0, (real)0.5, 0 };
    gvi_stepper st;
    assert_non_null(memory);
    assert_ok(gvi_init(&st, &d, memory, gvi_size(&d)));
    assert_ok(gvi_start(&st, 0, start, v));
    for (int k = 0; k < STEPS; ++k) {
        assert_ok(gvi_step(&st, (real)(3 + k % 3)/16));
        assert_ok(gvi_state_at(&st, st.t - st.h/3, inside, NULL, NULL));
    }
    memcpy(q, st.q, sizeof(real)*N);
    free(memory);
    return (double)st.counters.iterations/STEPS;
}

/* Six seconds let a perturbation grow by no more than 10 or so (the springs are stable).  A step adds a few eps of
   rounding of its own, and that of the products, of relative eps/2, times h^2 F or h v: below 1. */
static void a_tolerance_below_rounding_changes_the_last_places_only(void **state)
{
    static const int points[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 17 };
    (void)state;
    for (int i = 0; i < COUNT(scenes); ++i)
        for (int j = 0; j < COUNT(points); ++j) {
            real q[2][N], inside[2][N];
            run(scenes + i, points[j], 0, q[0], inside[0]);
            run(scenes + i, points[j], EPS/256, q[1], inside[1]);
            for (int k = 0; k < N; ++k) {
                assert_close(q[0][k], q[1][k], 10*STEPS*EPS);
                assert_close(inside[0][k], inside[1][k], 10*STEPS*EPS);
            }
        }
}

/* What is left undone in a step is below the tolerance, in units of q and the way of a step: no more than 2 */
static void what_is_left_undone_is_the_tolerance(void **state)
{
    (void)state;
    for (int i = 0; i < COUNT(scenes); ++i)
        for (real tolerance = (real)0.01; tolerance > 64*EPS; tolerance /= 10) {
            real q[2][N], inside[2][N];
            const double all = run(scenes + i, 8, 0, q[0], inside[0]), some = run(scenes + i, 8, tolerance, q[1], inside[1]);
            assert_true(some < all);
            for (int k = 0; k < N; ++k) assert_close(q[0][k], q[1][k], 10*STEPS*2*tolerance);
        }
}

/* A checkpoint made with a tolerance goes on in a stepper with that tolerance, to the bit; without one its tables
   would have no place there */
static void a_checkpoint_with_a_tolerance_goes_on_with_one(void **state)
{
    const real tolerances[3] = { (real)0.001, (real)0.001, 0 }, start[N] = { 1, 0, (real)-0.5 }, v[N] = { 0, (real)0.5, 0 };
    (void)state;
    for (int i = 0; i < COUNT(scenes); ++i) {
        gvi_effect effects[3][3];
        real *memory[3], *copy;
        gvi_stepper st[3], saved;
        size_t size = 0;
        for (int k = 0; k < 3; ++k) {
            gvi_desc d = describe(scenes + i, 6, effects[k]);
            d.tolerance = tolerances[k];
            size = k < 2 ? gvi_size(&d) : size;
            memory[k] = malloc(gvi_size(&d));
            assert_non_null(memory[k]);
            assert_ok(gvi_init(st + k, &d, memory[k], gvi_size(&d)));
            assert_ok(gvi_start(st + k, 0, start, v));
        }
        for (int k = 0; k < 5; ++k) assert_ok(gvi_step(st, (real)0.125));
        saved = st[0];
        copy = malloc(size);
        assert_non_null(copy);
        memcpy(copy, memory[0], size);
        assert_ok(gvi_restore(st + 1, &saved, copy));
        assert_status(gvi_restore(st + 2, &saved, copy), GVI_E_ARGUMENT);
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 2; ++j) assert_ok(gvi_step(st + j, k < 2 ? (real)0.125 : (real)0.25));
        for (int k = 0; k < N; ++k) assert_true(st[0].q[k] == st[1].q[k]);
        for (int k = 0; k < 3; ++k) free(memory[k]);
        free(copy);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tolerance_below_rounding_changes_the_last_places_only),
        cmocka_unit_test(what_is_left_undone_is_the_tolerance),
        cmocka_unit_test(a_checkpoint_with_a_tolerance_goes_on_with_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
