/* Corners that went wrong once: each a few lines, each its own reason. */
#include "gvi_test.h"

static real memory[8000];

AT_EACH(spring) { x->f[a] -= x->q[a]; }
AT_EACH(drag) { x->f[a] -= x->v[a]; }

GVI_EACH(not_a_number, 1, f) { x->f[0] += *(const int *)user ? (real)NAN : 0; }

static gvi_stepper *set_up(gvi_stepper *st, gvi_desc desc, real *where)
{
    *st = new_stepper(&desc);
    return st;
}

/* It decays through the subnormals to 0, where no change has a sure digit */
TEST(a_damped_motion_may_die_out)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring }, { .kind = GVI_FORCE, .points = drag } };
    const gvi_formulation pins[] = { GVI_AUTO, GVI_VELOCITIES, GVI_MOMENTA, GVI_NEWTON };
    for (int f = 0; f < COUNT(pins); ++f) {
        gvi_stepper st;
        set_up(&st, (gvi_desc){ .n = 1, .degree = 3, .effects = scene, .effect_count = 2, .formulation = pins[f] }, memory);
        assert_ok(gvi_start(&st, 0, (real[]){ 1 }, (real[]){ 0 }));
        for (int k = 0; k < 50000; ++k) assert_ok(gvi_step(&st, (real)0.125));
        assert_between(-(long double)1e-30, st.q[0], (long double)1e-30);
    }
}

/* A velocity of 1e-25 beside a position of 1: no scale to measure it by but its own */
TEST(a_start_from_next_to_nothing_is_a_start)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring }, { .kind = GVI_FORCE, .points = drag } };
    gvi_stepper st;
    set_up(&st, (gvi_desc){ .n = 2, .degree = 3, .effects = scene, .effect_count = 2, .formulation = GVI_VELOCITIES }, memory);
    assert_ok(gvi_start(&st, 0, (real[]){ 0, 1 }, (real[]){ (real)1e-25, 0 }));
    for (int k = 0; k < 100; ++k) assert_ok(gvi_step(&st, (real)0.125));
    assert_between(0, fabsl((long double)st.q[0]), 1e-25L);
}

/* Two free oscillators, one 1e20 times heavier (and as stiff): nothing conjugate */
TEST(heavy_and_light_are_no_conjugate_points)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    for (int e = 0; e <= 20; e += 4) {
        const real mass[2] = { 1, (real)pow(10, e) }, q0[2] = { 1, 1 }, q1[2] = { (real)1.1, (real)0.9 };
        real p0[2], h = (real)0.125;
        gvi_stepper st;
        set_up(&st, (gvi_desc){ .n = 2, .degree = 5, .effects = scene, .effect_count = 1,
                                .mass = { GVI_MASS_DIAGONAL, mass, 0, 0, 0, 0 } }, memory);
        assert_ok(gvi_discrete_lagrangian(&st, 0, h, q0, q1, &(gvi_discrete){ .p0 = p0 }));
        for (int i = 0; i < 2; ++i) {               // m omega (q1 - q0 cos)/sin
            double w = 1/sqrt((double)mass[i]), m = (double)mass[i];
            double s = sin(w*(double)h), c1 = 2*sin(w*(double)h/2)*sin(w*(double)h/2);
            double exact = m*w*(((double)q1[i] - (double)q0[i]) + (double)q0[i]*c1)/s;
            assert_close(p0[i]/(real)exact, 1, 64*(EPS > DBL_EPSILON ? EPS : DBL_EPSILON));
        }
    }
}

/* The first failure of a chain of calls is the one that is left at its end */
TEST(a_chain_of_calls_keeps_its_first_cause)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    const real massless[1] = { 0 }, q[1] = { 1 }, v[1] = { 0 };
    const gvi_desc heavy = { .n = 1, .effects = scene, .effect_count = 1 };
    const gvi_desc light = { .n = 1, .effects = scene, .effect_count = 1, .mass = { GVI_MASS_DIAGONAL, massless, 0, 0, 0, 0 } };
    gvi_stepper st;
    real x;
    assert_status(gvi_init(&st, &heavy, memory, 8), GVI_E_MEMORY);
    assert_status(gvi_start(&st, 0, q, v), GVI_E_MEMORY);
    assert_status(gvi_step(&st, 1), GVI_E_MEMORY);
    assert_status(gvi_velocity(&st, &x), GVI_E_MEMORY);
    assert_status(gvi_init(&st, &light, memory, sizeof memory), GVI_E_SINGULAR);
    assert_int_equal(st.fault.coordinate, 0);
    assert_status(gvi_start(&st, 0, q, v), GVI_E_SINGULAR);
    assert_status(gvi_step(&st, 1), GVI_E_SINGULAR);
}

/* Not through the boundary values either */
TEST(no_nan_passes_for_a_momentum)
{
    int sick = 1;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = not_a_number, .user = &sick } };
    for (int s = 1; s <= 4; ++s) {
        gvi_stepper st;
        real p0 = 7, q0 = 0, q1 = 1;
        set_up(&st, (gvi_desc){ .n = 1, .degree = s, .effects = scene, .effect_count = 1 }, memory);
        assert_status(gvi_discrete_lagrangian(&st, 0, 1, &q0, &q1, &(gvi_discrete){ .p0 = &p0 }), GVI_E_NON_FINITE);
        assert_int_equal(st.fault.effect, 0);
        assert_true(p0 == 7);
        assert_status(gvi_start_configurations(&st, 0, 1, &q0, &q1), GVI_E_NON_FINITE);
    }
}

/* The ends' weights of too many equispaced points are 0 in this type: no basis */
TEST(weights_that_vanish_are_refused)
{
    enum { MANY = 20000 };
    static real x[MANY], w[MANY];
    for (int i = 0; i < MANY; ++i) x[i] = (real)i;
    assert_status(gvi_barycentric(sizeof(real) > 8 ? MANY : 1200, x, w), GVI_E_NODES);
}

AT_EACH(push) { x->f[a] += x->t[a % x->stride] > 2; }

/* A coordinate next to nothing rests for two steps; then a force of 1 sets in, and it moves by a factor
   whose square no type has.  Of every formulation that iterates: q = t^2/2, p = t. */
TEST(a_force_may_set_in_where_next_to_nothing_was)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = push } };
    const gvi_formulation pins[] = { GVI_POSITIONS, GVI_VELOCITIES, GVI_MOMENTA };
    const real none[5] = { 0 };
    for (int k = 0; k < COUNT(pins)*2; ++k) {
        gvi_stepper st;
        real tiny[5];
        for (int i = 0; i < 5; ++i) tiny[i] = 16*MIN/EPS;
        set_up(&st, (gvi_desc){ .n = 5, .degree = k % 2 ? 3 : 8, .effects = scene, .effect_count = 1,
                                .formulation = pins[k/2] }, memory);
        assert_ok(gvi_start(&st, 0, tiny, none));
        assert_ok(gvi_step(&st, 1));
        assert_ok(gvi_step(&st, 1));
        for (int i = 1; i <= 3; ++i) {
            assert_ok(gvi_step(&st, 1));
            assert_close(st.q[4], i*i/2.0L, 8*EPS);
            assert_close(st.p[4], i, 8*EPS);
        }
    }
}

/* What rounding is known to leave, as docs/theory.md quotes it from here: 200,000
   steps of an oscillator by Newton's method and by a fixed point at large h omega. */
TEST(the_drift_that_rounding_leaves_is_no_larger_than_documented)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    const gvi_formulation pins[] = { GVI_NEWTON, GVI_POSITIONS };
    const struct { int s; double h; } runs[] = { { 4, 2.7 }, { 2, 2.7 }, { 8, 1.6 } };
    for (int k = 0; k < COUNT(runs)*2; ++k) {
        gvi_stepper st;
        set_up(&st, (gvi_desc){ .n = 1, .degree = runs[k/2].s, .effects = scene, .effect_count = 1,
                                .formulation = pins[k%2], .max_iterations = 1000 }, memory);
        assert_ok(gvi_start(&st, 0, (real[]){ 1 }, (real[]){ 0 }));
        for (int i = 0; i < 200000; ++i) assert_ok(gvi_step(&st, (real)runs[k/2].h));
        long double q = st.q[0], p = st.p[0], error = q*q + p*p - 1;
        print_message("    degree %d, h omega %.1f, %s: %.2Lg\n", runs[k/2].s, runs[k/2].h,
                      k % 2 ? "positions" : "Newton", error);
        assert_between(k % 2 ? -6e4L*EPS : -2e4L*EPS, error, k % 2 ? 6e4L*EPS : 2e4L*EPS);
    }
}

AT_EACH(pendula) { x->f[a] -= (real)sinl((long double)x->q[a]); }

/* Stage values are made in whole vectors: which lane a coordinate is in must not be seen in a bit of it.  How many there are hardly changes when the iteration ends: with a tolerance the
   sum of all changes has a limit, so eight take a little longer than seven. */
TEST(coordinates_alike_move_alike)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = pendula }, { .kind = GVI_FORCE, .points = drag } };
    enum { most = 19, degrees = 9 };
    real q[most], v[most], m[most];
    int rounds[degrees][3][4];
    for (int i = 0; i < most; ++i) q[i] = (real)0.7L, v[i] = (real)-0.3L, m[i] = (real)1.7L;
    for (int n = 1; n <= most; ++n)
        for (int s = 1; s <= degrees; ++s)
            for (int f = GVI_POSITIONS; f <= GVI_MOMENTA; ++f)
                for (int kind = 0; kind < 4; ++kind) {
                    gvi_stepper st;
                    const gvi_mass unit = { .kind = GVI_MASS_UNIT }, mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m };
                    set_up(&st, (gvi_desc){ .n = n, .degree = s, .effects = scene, .effect_count = f == GVI_POSITIONS ? 1 : 2,
                                            .mass = kind & 1 ? mass : unit, .formulation = (gvi_formulation)f,
                                            .tolerance = kind & 2 ? (real)1e-5L : 0 }, memory);
                    assert_ok(gvi_start(&st, 0, q, v));
                    for (int k = 0; k < 12; ++k) assert_ok(gvi_step(&st, k < 8 ? (real)0.3L : (real)0.17L));
                    for (int i = 1; i < n; ++i)
                        assert_true(st.q[i] == st.q[0] && st.p[i] == st.p[0]
                                    && st.q_low[i] == st.q_low[0] && st.p_low[i] == st.p_low[0]);
                    const int its = (int)st.counters.iterations, *seven = &rounds[s - 1][f - GVI_POSITIONS][kind];
                    if (n == 7) rounds[s - 1][f - GVI_POSITIONS][kind] = its;      // of 40 to 120
                    // a tolerance is for the sum over all rows: one iteration more in each of the 12 steps at most
                    const int spread = kind > 1 ? 12 : 2;
                    if (n > 7) assert_between(*seven - spread, its, *seven + spread);
                }
}

GVI_EACH(square, 1, v, f, dldv)
{
    const real c = *(const real *)user;
    x->f[0] += 2*c*x->q[0]*x->v[0];
    x->dldv[0] += c*x->q[0]*x->q[0];
}

/* L = m v^2/2 + c q^2 v is free motion and p = m v + c q^2, whatever v rounding makes of it */
TEST(p_is_as_good_as_q_where_it_cancels_dldv)
{
    int steps = 0;
    for (int run = 0; run < 3*3*4*4*7; ++run) {
        gvi_stepper st;
        real c = (real[]){ (real)0.03L, (real)0.3L, 1 }[run % 3], m = (real[]){ (real)0.01L, (real)0.2L, 30 }[run/3 % 3],
             q = (real[]){ (real)-3.7L, (real)-0.6L, (real)1.9L, (real)3.3L }[run/9 % 4],
             v = (real[]){ (real)-2.9L, (real)0.07L, (real)0.5L, (real)3.6L }[run/36 % 4];
        const gvi_effect scene[] = { { .kind = GVI_LAGRANGIAN, .points = square, .user = &c } };
        set_up(&st, (gvi_desc){ .n = 1, .degree = 2 + run/144, .effects = scene, .effect_count = 1,
                                .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = &m } }, memory);
        assert_ok(gvi_start(&st, 0, &q, &v));
        for (int k = 0; k < 6; ++k) {
            const long double h = 0.1L + 0.3L*(run % 5), q0 = (long double)st.q[0] + st.q_low[0], p0 = (long double)st.p[0] + st.p_low[0];
            if (gvi_step(&st, (real)h) != GVI_OK) break;                  // h too long, and said so
            const long double q1 = (long double)st.q[0] + st.q_low[0], p1 = (long double)st.p[0] + st.p_low[0], mv = p0 - c*q0*q0;
            const long double terms = fabsl(mv) + c*fmaxl(q0*q0, q1*q1) + 2*c*h*fabsl(mv/m)*fmaxl(fabsl(q0), fabsl(q1));
            assert_between(0, fabsl(p1 - (mv + c*q1*q1)), 10*EPS*terms);
            steps += 1;
        }
    }
    assert_between(5000, steps, 6048);
}

RUN_TESTS(NULL, NULL)
