/* A long run against the standard for round-off: the non-chaotic double pendulum
   of Antonana, Makazaga and Murua [5], 2^19 steps of degree 6.  Their fixed-point
   code keeps max |dE/E| = 2.2e-15 there, one walk of many that roundings can take.

   The velocity comes from the momenta in closed form: M as a matrix of rounded
   entries costs a factor 2, since det M = 1 + sin^2 q2 is a difference of them.
   Then a step is worth about EPS/8 |v||dp|, 3e-18 of E; 2^19 of them, independent,
   have the standard deviation 724 * 3e-18 = 2.2e-15.  The long run must keep to
   5e-15; an ensemble of neighbours to the standard deviation and to no drift.

   Second angle relative to the first, m = l = 1, g = 9.8: problems.h's pendulum_mass, V = -2 g cos(q1) - g cos(q1 + q2) */
#define GVI_REAL double
#include "gvi_test.h"
#include "problems.h"

#define G 9.8
#define PER_STEP 3e-18L                     /* standard deviation of dE/E, a step */

GVI_EACH(gravity, 2, f)
{
    const double both = G*sin(x->q[0] + x->q[1]);
    x->f[0] -= 2*G*sin(x->q[0]) + both;
    x->f[1] -= both;
}

/* v = M^-1 p, with p1 - p2 for what both angles share */
GVI_EACH(velocity, 2, p, velocity)
{
    const double c = cos(x->q[1]), s = sin(x->q[1]), p2 = x->p[1], p = x->p[0] - p2;
    x->velocity[0] = (p - c*p2)/(1 + s*s);
    x->velocity[1] = ((2 + c)*p2 - (1 + c)*p)/(1 + s*s);
}

/* In long double, so that only the error of q and p is seen.  det M = 2 - cos^2 */
static long double energy(const double *q, const double *p)
{
    long double a = q[0], b = q[1], u = p[0], v = p[1], c = cosl(b), g = (long double)G;
    return ((u*u - 2*(1 + c)*u*v + (3 + 2*c)*v*v)/(2 - c*c)/2) - 2*g*cosl(a) - g*cosl(a + b);
}

enum { STEPS = 1 << 19, EVERY = 1 << 10 };

static gvi_stepper *start(const double *q, const double *p)
{
    static const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = gravity } };
    static gvi_stepper st;
    const gvi_desc desc = { .n = 2, .degree = 6, .effects = effects, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_POSITION, .points = pendulum_mass,
                                      .gradient = pendulum_mass_gradient, .velocity = velocity } };
    st = new_stepper(&desc);
    assert_int_equal(st.formulation, GVI_MOMENTA);
    assert_ok(gvi_start_momentum(&st, 0, q, p));
    return &st;
}

TEST(half_a_million_steps_keep_the_energy_to_round_off)
{
    const double q[2] = { 1.1, -1.1 }, p[2] = { 2.7746, 2.7746 };
    long double E0 = energy(q, p), worst = 0;
    gvi_stepper *st = start(q, p);
    assert_close(E0, -14.39988748L, 1e-8L);
    for (int k = 1; k <= STEPS; ++k) {
        assert_ok(gvi_step(st, 1.0/128));
        if (k % EVERY == 0) worst = fmaxl(worst, fabsl((energy(st->q, st->p) - E0)/E0));
    }
    print_message("    max |dE/E| = %.3Lg, %.3f iterations a step\n", worst, (double)st->counters.iterations/STEPS);
    assert_int_equal(st->formulation, GVI_MOMENTA);
    assert_true(st->t == 4096);
    assert_between(0, worst, 5e-15L);
    assert_close(st->q[0], -0.540054552496L, 1e-10L);
    assert_close(st->q[1], 1.762261020480L, 1e-10L);
}

/* Neighbours walk independently: their mean is no drift as long as it is within
   four of its standard errors.  After 2^14 steps their spread is 128 times that of a
   step; that of ten is known to 1/sqrt(20), four times which are allowed. */
TEST(the_energy_error_of_an_ensemble_is_a_random_walk_without_drift)
{
    enum { RUNS = 10, LENGTH = 1 << 14 };
    long double sum = 0, squares = 0;
    for (int r = 0; r < RUNS; ++r) {
        const double q[2] = { 1.1 + 1e-5*r, -1.1 - 2e-5*r }, p[2] = { 2.7746, 2.7746 };
        gvi_stepper *st = start(q, p);
        long double E0 = energy(q, p), d;
        for (int k = 0; k < LENGTH; ++k) assert_ok(gvi_step(st, 1.0/128));
        d = (energy(st->q, st->p) - E0)/E0;
        sum += d;
        squares += d*d;
    }
    print_message("    mean %.2Lg, root mean square %.2Lg\n", sum/RUNS, sqrtl(squares/RUNS));
    assert_close(sum/RUNS, 0, 4*sqrtl(squares)/RUNS);
    assert_between(0.1L*128*PER_STEP, sqrtl(squares/RUNS), 1.9L*128*PER_STEP);
}

RUN_TESTS(NULL, NULL)
