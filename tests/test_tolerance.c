/* A tolerance: what is left undone is no more than that, and where there is nothing left to do
   it changes no more than the last places, in every formulation and for every number of points. */
#include "gvi_test.h"

enum { MOST = 9, STEPS = 24 };                  /* coordinates; steps */

/* V = sum q_i^4/4 + sum (q_i+1 - q_i)^2/2; a potential is not to see velocities, whatever else is there */
AT_POINTS(chain)
{
    if (x->v || x->dldv || x->p) return 1;
    FOR_EACH(x, a) {
        const int i = a/x->stride;
        const real q = x->q[a], left = i > 0 ? q - x->q[a - x->stride] : 0;
        x->f[a] += (i < x->n - 1 ? x->q[a + x->stride] - q : 0) - left - q*q*q;
    }
    return 0;
}

AT_EACH(friction) { x->f[a] -= x->v[a]/16; }

/* L = q_1 v_2 - q_2 v_1, halved */
GVI_EACH(magnetic, 2, v, f, dldv)
{
    x->f[0] += x->v[1]/2;
    x->f[1] -= x->v[0]/2;
    x->dldv[0] -= x->q[1]/2;
    x->dldv[1] += x->q[0]/2;
}

/* M = diag(2 + cos q_i) */
AT_EACH(mass)
{
    for (int j = 0, i = a/x->stride; j <= i; ++j)
        x->mass[(i*(x->n - 1) + j)*x->stride + a] = i == j ? 2 + cos(x->q[a]) : 0;
}

AT_EACH(gradient) { x->f[a] -= sin(x->q[a])*x->v[a]*x->v[a]/2; }

enum { FRICTION = 1, MAGNETIC = 2, OFF = 4 };   /* OFF: friction is listed, and switched off */
typedef struct scene {
    gvi_formulation formulation;
    gvi_mass_kind   mass;
    int             more, n;
    gvi_rule_kind   rule;
    int             fewer;                      /* r - s */
} scene;

static const scene scenes[] = {
    { GVI_POSITIONS, GVI_MASS_UNIT, 0, 2, GVI_GAUSS, 0 }, { GVI_POSITIONS, GVI_MASS_UNIT, 0, 3, GVI_GAUSS, 0 },
    { GVI_POSITIONS, GVI_MASS_UNIT, 0, 9, GVI_GAUSS, 0 }, { GVI_POSITIONS, GVI_MASS_DIAGONAL, 0, 3, GVI_GAUSS, 0 },
    { GVI_POSITIONS, GVI_MASS_DIAGONAL, 0, 2, GVI_GAUSS, 0 }, { GVI_POSITIONS, GVI_MASS_DENSE, 0, 3, GVI_GAUSS, 0 },
    { GVI_POSITIONS, GVI_MASS_UNIT, 0, 2, GVI_LOBATTO, 1 }, { GVI_POSITIONS, GVI_MASS_UNIT, 0, 3, GVI_GAUSS, 1 },
    { GVI_VELOCITIES, GVI_MASS_UNIT, FRICTION, 2, GVI_GAUSS, 0 }, { GVI_VELOCITIES, GVI_MASS_UNIT, FRICTION, 9, GVI_GAUSS, 0 },
    { GVI_VELOCITIES, GVI_MASS_UNIT, FRICTION | OFF, 2, GVI_GAUSS, 0 },
    { GVI_VELOCITIES, GVI_MASS_DENSE, FRICTION, 3, GVI_GAUSS, 0 },
    { GVI_MOMENTA, GVI_MASS_UNIT, FRICTION | MAGNETIC, 3, GVI_GAUSS, 0 },
    { GVI_MOMENTA, GVI_MASS_UNIT, MAGNETIC, 3, GVI_GAUSS, 0 }, { GVI_MOMENTA, GVI_MASS_POSITION, 0, 2, GVI_GAUSS, 0 },
    { GVI_MOMENTA, GVI_MASS_POSITION, FRICTION, 3, GVI_GAUSS, 0 }, { GVI_MOMENTA, GVI_MASS_POSITION, 0, 9, GVI_LOBATTO, 0 },
    { GVI_AUTO, GVI_MASS_UNIT, FRICTION, 3, GVI_GAUSS, 0 }
};

static real diagonal[MOST], dense[MOST*MOST];

static gvi_desc describe(const scene *a, int r, gvi_effect *effects)
{
    gvi_desc d = { .n = a->n, .degree = r - a->fewer, .effects = effects, .formulation = a->formulation };
    for (int i = 0; i < a->n; ++i) {
        diagonal[i] = (real)(1 + i % 3);
        for (int j = 0; j <= i; ++j) dense[i*a->n + j] = i == j ? 2 : i == j + 1 ? (real)0.5 : 0;
    }
    d.rule.kind = a->rule;
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

static real *set_up(gvi_stepper *st, const scene *a, const gvi_desc *d, size_t *size)
{
    const real start[MOST] = { 1, 0, (real)-0.5 }, v[MOST] = { 0, (real)0.5, 0 };
    real *memory = malloc(*size = gvi_size(d));
    assert_non_null(memory);
    assert_ok(gvi_init(st, d, memory, *size));
    if (a->more & OFF) assert_ok(gvi_switch(st, 1, 0));
    assert_ok(gvi_start(st, 0, start, v));
    return memory;
}

/* Steps of three lengths in turn and back, so that the tables are made anew, to and fro; a state inside each */
static double run(const scene *a, int r, real tolerance, int iterations, real *q, real *inside)
{
    gvi_effect effects[3];
    gvi_desc d = describe(a, r, effects);
    gvi_stepper st;
    size_t size;
    d.tolerance = tolerance;
    d.iterations = iterations;
    real *memory = set_up(&st, a, &d, &size);
    for (int k = 0; k < STEPS; ++k) {
        assert_ok(gvi_step(&st, k % 4 == 3 ? (real)-0.0625 : (real)(3 + k % 4)/16));
        assert_ok(gvi_state_at(&st, st.t - st.h/3, inside, NULL, NULL));
    }
    memcpy(q, st.q, sizeof(real)*(size_t)a->n);
    free(memory);
    return (double)st.counters.iterations/STEPS;
}

/* Five seconds let a perturbation grow by no more than 10 or so (the springs are stable).  A step adds a few eps of
   rounding of its own, and that of the products, of relative eps/2, times h^2 F or h v: below 1. */
TEST(a_tolerance_below_rounding_changes_the_last_places_only)
{
    static const int points[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 17 };
    for (int i = 0; i < COUNT(scenes); ++i)
        for (int j = 0; j < COUNT(points); ++j) {
            real q[2][MOST], inside[2][MOST];
            if (points[j] < 3 && (scenes[i].fewer || scenes[i].rule == GVI_LOBATTO)) continue;
            run(scenes + i, points[j], 0, 0, q[0], inside[0]);
            run(scenes + i, points[j], EPS/256, 0, q[1], inside[1]);
            for (int k = 0; k < scenes[i].n; ++k) {
                assert_close(q[0][k], q[1][k], STEPS*EPS);
                assert_close(inside[0][k], inside[1][k], STEPS*EPS);
            }
            run(scenes + i, points[j], EPS*EPS, 0, q[1], inside[1]);
            for (int k = 0; k < scenes[i].n; ++k) assert_true(q[0][k] == q[1][k] && inside[0][k] == inside[1][k]);
        }
}

/* Where the number of iterations is given a tolerance says nothing */
TEST(with_iterations_given_a_tolerance_changes_no_bit)
{
    for (int i = 0; i < COUNT(scenes); ++i) {
        real q[2][MOST], inside[2][MOST];
        if (scenes[i].formulation == GVI_AUTO) continue;
        run(scenes + i, 8, 0, 12, q[0], inside[0]);
        run(scenes + i, 8, (real)0.001, 12, q[1], inside[1]);
        for (int k = 0; k < scenes[i].n; ++k) assert_true(q[0][k] == q[1][k]);
    }
}

/* What is left undone in a step is below the tolerance, in units of q and the way of a step: no more than 2 */
TEST(what_is_left_undone_is_the_tolerance)
{
    for (int i = 0; i < COUNT(scenes); ++i)
        for (real tolerance = (real)0.01; tolerance > 64*EPS; tolerance /= 10) {
            real q[2][MOST], inside[2][MOST];
            const double all = run(scenes + i, 8, 0, 0, q[0], inside[0]), some = run(scenes + i, 8, tolerance, 0, q[1], inside[1]);
            assert_true(some < all);
            for (int k = 0; k < scenes[i].n; ++k) assert_close(q[0][k], q[1][k], 10*STEPS*2*tolerance);
        }
}

/* Springs between neighbours, rounded to a grid of 16 eps: their sum is 0 to the last bit */
static int pairs(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i + 1 < x->n; ++i) {
            const real d = x->q[(i + 1)*R + k] - x->q[i*R + k];
            const real pull = (real)floorl((long double)((d + d*d*d)/(16*EPS)))*(16*EPS);
            x->f[i*R + k] += pull;
            x->f[(i + 1)*R + k] -= pull;
        }
    return 0;
}

/* Forces that cancel keep the total momentum, however early the iteration ends: each p is rounded once, when it is read.
   Sums that were rounded would let it wander, by some sqrt(steps) eps. */
TEST(a_tolerance_keeps_the_total_momentum)
{
    enum { BODIES = 5 };
    const real start[BODIES] = { 0, (real)0.25, 0, (real)-0.5, 0 }, v[BODIES] = { (real)0.3, 0, (real)-0.7, (real)0.1, 1 };
    const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = pairs } };
    real q[BODIES], total = 0, now = 0;
    for (int i = 0; i < BODIES; ++i) total += v[i];
    for (int degree = 3; degree <= 8; degree += 5) {
        gvi_desc d = { .n = BODIES, .degree = degree, .effects = effects, .effect_count = 1, .formulation = GVI_POSITIONS };
        d.tolerance = 1000*EPS;
        gvi_stepper st = new_stepper(&d);
        memcpy(q, start, sizeof q);
        assert_ok(gvi_start(&st, 0, q, v));
        for (int k = 0; k < 100000; ++k) assert_ok(gvi_step(&st, (real)0.1));
        now = 0;
        for (int i = 0; i < BODIES; ++i) now += st.p[i];
        assert_close(now, total, 5*EPS);
    }
}

/* A checkpoint made with a tolerance goes on in a stepper with that tolerance, to the bit.  One without may
   refuse it; if it does not, it goes on by its own: at round-off */
TEST(a_checkpoint_with_a_tolerance_goes_on_with_one)
{
    const real tolerances[3] = { (real)0.001, (real)0.001, 0 };
    for (int i = 0; i < COUNT(scenes); ++i) {
        gvi_effect effects[3][3];
        real *memory[3], *copy;
        gvi_stepper st[3], saved;
        size_t size[3];
        for (int k = 0; k < 3; ++k) {
            gvi_desc d = describe(scenes + i, 6, effects[k]);
            d.tolerance = tolerances[k];
            memory[k] = set_up(st + k, scenes + i, &d, size + k);
        }
        for (int k = 0; k < 5; ++k) assert_ok(gvi_step(st, (real)0.125));
        saved = st[0];
        copy = malloc(size[0]);
        assert_non_null(copy);
        memcpy(copy, memory[0], size[0]);
        assert_ok(gvi_restore(st + 1, &saved, copy));
        const gvi_status other = gvi_restore(st + 2, &saved, copy);
        assert_true(other == GVI_OK || other == GVI_E_ARGUMENT);
        for (int k = 0; k < 5; ++k)
            for (int j = 0; j < 2; ++j) assert_ok(gvi_step(st + j, k < 2 ? (real)0.125 : (real)0.25));
        for (int k = 0; k < scenes[i].n; ++k) assert_true(st[0].q[k] == st[1].q[k]);
        for (int k = 0; k < 3; ++k) free(memory[k]);
        free(copy);
    }
}

/* q'' = -k q - c q^3 from q = 1 at rest, so |q| <= 1: given iterations that have left that are refused */
GVI_EACH(bowl, 1, f)
{
    const real *k = user;
    x->f[0] -= x->q[0]*(k[0] + k[1]*x->q[0]*x->q[0]);
}

TEST(given_iterations_do_not_leave_the_motion)
{
    static const real bowls[][2] = { { 1, (real)0.25L }, { (real)0.1L, 1 }, { 1, 0 } };
    int taken = 0;
    for (int b = 0; b < COUNT(bowls); ++b)
        for (int N = 2; N <= 10; ++N)
            for (int degree = 2; degree < 6; ++degree)
                for (real h = (real)0.25L; h < 12; h += (real)0.0731L) {
                    const gvi_effect effect = { .points = bowl, .user = (void *)bowls[b] };
                    const gvi_desc desc = { .n = 1, .degree = degree, .effects = &effect, .effect_count = 1, .iterations = N };
                    gvi_stepper st = new_motion(&desc, 0, (const real[]){ 1 }, (const real[]){ 0 });
                    for (int k = 0; k < 8 && gvi_step(&st, h) == GVI_OK; ++k) ++taken;
                    assert_true(fabs(st.q[0]) < 16);      // a last change of a quarter of the motion is allowed
                }
    assert_true(taken > 5000);
}

RUN_TESTS(NULL, NULL)
