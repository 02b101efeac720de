/* What a variational integrator keeps: the symplectic form, momentum maps, the energy within
   bounds, reversal in time. In long double by default, so that differences of the step map say something;
   every bound is a multiple of a power of EPS, so that -DGVI_REAL=double serves as well. */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#include "gvi_test.h"
#include "problems.h"

static gvi_stepper *set_up(const gvi_desc *desc)
{
    static gvi_stepper st;
    st = new_stepper(desc);
    return &st;
}

/* Two degrees of freedom: constant mass or the double pendulum's, a potential
   that couples them and has a clock, a field that bends the path, drag. */

AT_EACH(drag) { x->f[a] -= x->v[a]/4; }

enum { FIELD = 1, DRAG = 2 };

typedef struct {
    gvi_formulation formulation;
    int             moving_mass, extra;          /* FIELD, DRAG */
    int             s;
    gvi_rule_kind   rule;
    int             r;
} variant;

static gvi_stepper *set_up_variant(const variant *a)
{
    static const real dense[4] = { 2, 0.5L, 0.5L, 1 };
    static gvi_effect effects[3];
    gvi_desc desc = { .n = 2, .degree = a->s, .rule = { .kind = a->rule, .points = a->r },
                      .effects = effects, .formulation = a->formulation, .mass = RELATIVE_ANGLES };
    if (!a->moving_mass) desc.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = dense };
    effects[desc.effect_count++] = (gvi_effect){ .kind = GVI_POTENTIAL, .point = weights, .user = effects };
    if (a->extra & FIELD) effects[desc.effect_count++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .point = field };
    if (a->extra & DRAG) effects[desc.effect_count++] = (gvi_effect){ .kind = GVI_FORCE, .points = drag };
    return set_up(&desc);
}

static const variant variants[] = {
    { GVI_EXPLICIT,   0, 0,     1, GVI_LOBATTO, 2 },
    { GVI_POSITIONS,  0, 0,     1, GVI_GAUSS,   1 },
    { GVI_POSITIONS,  0, 0,     2, GVI_GAUSS,   2 },
    { GVI_POSITIONS,  0, 0,     3, GVI_GAUSS,   5 },
    { GVI_POSITIONS,  0, 0,     4, GVI_LOBATTO, 4 },
    { GVI_POSITIONS,  0, 0,     4, GVI_LOBATTO, 5 },
    { GVI_POSITIONS,  0, 0,     8, GVI_GAUSS,   8 },
    { GVI_VELOCITIES, 0, 0,     3, GVI_GAUSS,   3 },
    { GVI_MOMENTA,    0, FIELD, 1, GVI_GAUSS,   1 },
    { GVI_NEWTON,     0, FIELD, 2, GVI_LOBATTO, 3 },
    { GVI_MOMENTA,    0, FIELD, 4, GVI_LOBATTO, 4 },
    { GVI_NEWTON,     0, FIELD, 5, GVI_GAUSS,   7 },
    { GVI_MOMENTA,    1, 0,     1, GVI_GAUSS,   1 },
    { GVI_MOMENTA,    1, 0,     3, GVI_GAUSS,   3 },
    { GVI_MOMENTA,    1, FIELD, 4, GVI_GAUSS,   4 },
    { GVI_MOMENTA,    1, FIELD, 3, GVI_LOBATTO, 3 },
    { GVI_NEWTON,     0, 0,     1, GVI_LOBATTO, 2 },
    { GVI_NEWTON,     0, 0,     4, GVI_GAUSS,   4 },
    { GVI_NEWTON,     0, FIELD, 3, GVI_GAUSS,   4 },
    { GVI_NEWTON,     0, FIELD, 3, GVI_LOBATTO, 3 },
    { GVI_NEWTON,     1, 0,     2, GVI_GAUSS,   2 },
    { GVI_NEWTON,     1, 0,     2, GVI_LOBATTO, 3 },
    { GVI_NEWTON,     1, FIELD, 3, GVI_GAUSS,   5 },
    { GVI_NEWTON,     1, FIELD, 6, GVI_GAUSS,   6 },
};

static const real start[4] = { 0.7L, -0.4L, 1.1L, 0.6L };              /* q, p */

/* x = (q, p) at t = 0.3 -> one step -> y; a stepper of its own each time, so
   that nothing but x can matter */
static void step_map(const void *a, const real *x, real *y)
{
    const real h = 0.25L;
    gvi_stepper *st = set_up_variant(a);
    assert_ok(gvi_start_momentum(st, 0.3L, x, x + 2));
    assert_ok(gvi_step(st, h));
    for (int i = 0; i < 2; ++i) { y[i] = st->q[i]; y[2 + i] = st->p[i]; }
}

/* What is left is the differencing: entries of M wrong by a few EPS^(8/9), four
   products of two entries in each sum. */
TEST(the_step_map_is_symplectic)
{
    real bound = 100*pow((real)EPS, 8/(real)9);
    int misses = 0;
    for (int i = 0; i < COUNT(variants); ++i) {
        real defect = symplectic_defect(step_map, &variants[i], start, EPS);
        if (defect <= bound) continue;          /* false for NaN */
        ++misses;
        print_error("variant %d: defect %.3Lg, allowed %.3Lg\n", i, (long double)defect, (long double)bound);
    }
    assert_int_equal(misses, 0);
}

/* The same measurement must see drag: the map contracts areas by about c h */
TEST(drag_is_not_symplectic)
{
    const variant damped[] = {
        { GVI_VELOCITIES, 0, DRAG,         3, GVI_GAUSS, 3 },
        { GVI_MOMENTA,    1, DRAG | FIELD, 3, GVI_GAUSS, 3 },
        { GVI_NEWTON,     1, DRAG,         3, GVI_GAUSS, 4 },
    };
    for (int i = 0; i < COUNT(damped); ++i)
        assert_between(0.01L, symplectic_defect(step_map, &damped[i], start, EPS), 1);
}

static const gvi_effect sun[] = { { .kind = GVI_POTENTIAL, .points = attraction } };

static gvi_stepper *start_planet(int s, gvi_rule_kind rule, int r, gvi_formulation formulation)
{
    const gvi_desc desc = { .n = 2, .degree = s, .rule = { .kind = rule, .points = r },
                            .effects = sun, .effect_count = 1, .formulation = formulation };
    gvi_stepper *st = set_up(&desc);
    assert_ok(gvi_start(st, 0, (const real[]){ 0.4L, 0 }, (const real[]){ 0, 2 }));
    return st;
}

static real angular_momentum(const gvi_stepper *st)
{
    return st->q[0]*st->p[1] - st->q[1]*st->p[0];
}

/* Each step adds a rounding to L = q x p: increments are at most of the size of q and p and wrong by about EPS/2 of
   themselves, which at the perihelion makes |q||dp| + |p||dq| = 1 times EPS at the most.  Independent from step to
   step, N of them have a standard deviation below sqrt(N) EPS/2; four are allowed. */
TEST(angular_momentum_is_constant_in_every_formulation)
{
    static const struct { int s; gvi_rule_kind rule; int r; gvi_formulation formulation; int steps; } cases[] = {
        { 8, GVI_GAUSS, 8, GVI_AUTO, 100000 },   { 5, GVI_LOBATTO, 6, GVI_POSITIONS, 5000 },
        { 6, GVI_GAUSS, 6, GVI_VELOCITIES, 5000 }, { 6, GVI_GAUSS, 8, GVI_NEWTON, 5000 },
        { 6, GVI_LOBATTO, 6, GVI_NEWTON, 5000 } };
    for (int k = 0; k < COUNT(cases); ++k)
        check_angular_momentum(start_planet(cases[k].s, cases[k].rule, cases[k].r, cases[k].formulation), cases[k].steps, 0.15L, 2);
}

/* No systematic part: the mean change over blocks is within four standard errors of nothing. */
TEST(angular_momentum_has_no_drift)
{
    enum { BLOCKS = 500, BLOCK = 41 };
    gvi_stepper *st = start_planet(8, GVI_GAUSS, 8, GVI_AUTO);
    real last = angular_momentum(st), sum = 0, squares = 0;
    for (int b = 0; b < BLOCKS; ++b) {
        for (int k = 0; k < BLOCK; ++k) assert_ok(gvi_step(st, 0.15L));
        real now = angular_momentum(st), d = (now - last)/EPS;
        sum += d;
        squares += d*d;
        last = now;
    }
    assert_close(sum/BLOCKS, 0, 4*sqrt(squares)/BLOCKS);
}

static real stiffness[4];

AT_EACH(stiff_springs) { x->f[a] -= stiffness[a/x->stride]*x->q[a]; }

/* Oscillators with masses whose h/m is not a number of the type.  Were it rounded once,
   rows and velocities would see masses that differ by up to EPS/2, the map would not be
   symplectic, and the energy would gain or lose up to 0.6 EPS in every step at h omega =
   5/2.  A walk of EPS a step comes to 64 EPS in 2^12 steps; multiples of h = 1/10, whose
   digits have a short period, round with a mean, up to 0.05 EPS a step. */
TEST(a_mass_is_the_same_wherever_it_is_read)
{
    enum { STEPS = 1 << 12 };
    static const real mass[4] = { 3, 7, 11, 13 }, q[4] = { 1, 1.1L, 0.9L, 0.7L }, v[4] = { 0.03L, 0.03L, 0.02L, 0.03L };
    static const gvi_formulation found[] = { GVI_POSITIONS, GVI_VELOCITIES, GVI_MOMENTA };
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = stiff_springs } };
    const real h = 0.1L, omega = 25;
    for (int i = 0; i < 4; ++i) stiffness[i] = mass[i]*omega*omega;
    for (int m = 0; m < COUNT(found); ++m) {
        const gvi_desc desc = { .n = 4, .degree = 8, .effects = scene, .effect_count = 1, .formulation = found[m],
                                .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
        gvi_stepper *st = set_up(&desc);
        assert_ok(gvi_start(st, 0, q, v));
        for (int k = 0; k < STEPS; ++k) assert_ok(gvi_step(st, h));
        for (int i = 0; i < 4; ++i) {
            const real before = mass[i]*v[i]*v[i] + stiffness[i]*q[i]*q[i];
            const real now = st->p[i]*st->p[i]/mass[i] + stiffness[i]*st->q[i]*st->q[i];
            assert_close(now/before, 1, (real)0.1L*STEPS*EPS);
        }
    }
}

/* 200 steps of different lengths, and the same back.  Independent errors of EPS/4 a step, and a motion that is
   regular: neighbours part linearly, by less than 20 times in the 20 units of time.  sqrt(400)/4 * 20 = 100. */
TEST(many_different_steps_and_back_return)
{
    enum { STEPS = 200 };
    static const int chosen[] = { 3, 5, 9, 13, 18, 20 };
    real h[STEPS];
    dice = 7;
    for (int k = 0; k < STEPS; ++k) h[k] = 0.05L + 0.1L*uniform();
    for (int i = 0; i < COUNT(chosen); ++i) {
        gvi_stepper *st = set_up_variant(&variants[chosen[i]]);
        const real q[2] = { 0.2L, -0.1L }, p[2] = { 0.1L, 0.1L };
        assert_ok(gvi_start_momentum(st, 0, q, p));
        assert_between(0, there_and_back(st, STEPS, h, STEPS), 100*EPS);
        assert_close(st->t, 0, 4*EPS);
    }
}

/* H = p'M^-1 p/2 + V, by hand */
static real pendulum_energy(const real *q, const real *p)
{
    real m12 = 1 + cos(q[1]), m11 = 3 + 2*cos(q[1]);
    return (p[0]*p[0] - 2*m12*p[0]*p[1] + m11*p[1]*p[1])/(m11 - m12*m12)/2
         - 2*cos(q[0]) - cos(q[0] + q[1]);
}

/* A chaotic double pendulum at a step where truncation is seen and rounding is not.  The energy follows a nearby one
   that is kept up to terms exponentially small in 1/h (at four times this step they would be seen), so its error is a
   function of the state, of size C h^6.  Later it cannot be larger, except by the luck of a state not visited before. */
TEST(the_energy_of_a_chaotic_pendulum_stays_in_its_band)
{
    enum { STEPS = 40000 };
    static const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .point = weights } };
    const gvi_desc desc = { .n = 2, .degree = 3, .effects = effects, .effect_count = 1, .mass = RELATIVE_ANGLES };
    gvi_stepper st = new_motion(&desc, 0, (const real[]){ 2, 1 }, (const real[]){ 0, 0 });
    real band[2] = { 0, 0 }, E0 = pendulum_energy(st.q, st.p), mean[2] = { 0, 0 };
    for (int k = 0; k < STEPS; ++k) {
        const int half = k >= STEPS/2;
        assert_ok(gvi_step(&st, 0.025L));
        const real d = pendulum_energy(st.q, st.p) - E0;
        band[half] = fmax(band[half], fabs(d));
        mean[half] += d/(STEPS/2);
    }
    assert_between(1e-9L, band[0], 1e-6L);                   /* it is truncation that is seen */
    assert_between(0.7L*band[0], band[1], 1.4L*band[0]);
    assert_close(mean[0], mean[1], band[0]/250);
}

TEST(a_conservative_scene_forms_no_velocity_and_no_matrix)
{
    gvi_stepper *st = start_planet(8, GVI_GAUSS, 8, GVI_AUTO);
    const gvi_counters *count = &st->counters;
    for (int k = 0; k < 100; ++k) assert_ok(gvi_step(st, 0.05L));
    assert_int_equal(st->formulation, GVI_POSITIONS);
    assert_int_equal(count->steps, 100);
    assert_int_equal(count->failures, 0);
    assert_int_equal(count->velocities, 0);
    assert_int_equal(count->factorizations, 0);
    assert_int_equal(count->newton_iterations, 0);
    assert_int_equal(count->mass, 0);
    /* an iteration asks for 8 points, and for the guess's new one at the most once a step */
    assert_between((real)(8*count->iterations), (real)count->effect[0], (real)(8*count->iterations + 100));
    for (int i = 1; i < GVI_EFFECTS; ++i) assert_int_equal(count->effect[i], 0);
}

RUN_TESTS(NULL, NULL)
