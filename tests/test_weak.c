/* gvi_effect.weak: the same steps from fewer evaluations of what is marked.  Expected
   is what the unmarked scene gives, to rounding or, where marks are not heeded, to the
   bit; and what theory says of energy and momentum.                           */
#include "gvi_test.h"

typedef gvi_real real;

/* ---------------------------------------------------------------- the scene

   A planet, GM = 1, n = 3.  Beside the Sun: a mass on a circle far out, whose place
   depends on t; a ring about the equator, to first order in its size; thin air.  */

enum { SUN, FAR, RING, AIR, EFFECTS, DEGREE = 8 };

static int sun(const gvi_points *x, void *user)
{
    const real k = *(const real *)user, *q = x->q;
    for (int j = 0; j < x->count; ++j, ++q) {
        const real r2 = q[0]*q[0] + q[x->stride]*q[x->stride] + q[2*x->stride]*q[2*x->stride];
        const real w = -k/(r2*GVI_SQRT(r2));
        for (int i = 0; i < 3; ++i) x->f[i*x->stride + j] += w*q[i*x->stride];
    }
    return 0;
}

static int sun_value(const gvi_points *x, void *user)
{
    const real k = *(const real *)user, *q = x->q;
    for (int j = 0; j < x->count; ++j, ++q)
        x->value[j] -= k/GVI_SQRT(q[0]*q[0] + q[x->stride]*q[x->stride] + q[2*x->stride]*q[2*x->stride]);
    return 0;
}

static int far_mass(const gvi_points *x, void *user)
{
    const real k = *(const real *)user;
    for (int j = 0; j < x->count; ++j) {
        const real at[3] = { 6*(real)cos((double)x->t[j]/15), 6*(real)sin((double)x->t[j]/15), 1 };
        real d[3], d2 = 0;
        for (int i = 0; i < 3; ++i) {
            d[i] = at[i] - x->q[i*x->stride + j];
            d2 += d[i]*d[i];
        }
        for (int i = 0; i < 3; ++i) x->f[i*x->stride + j] += k/(d2*GVI_SQRT(d2))*d[i];
    }
    return 0;
}

/* V = k (3 z^2/r^2 - 1)/(2 r^3): turns about the z axis leave it as it is       */
static int ring(const gvi_points *x, void *user)
{
    const real k = *(const real *)user, *q = x->q;
    for (int j = 0; j < x->count; ++j, ++q) {
        const real z = q[2*x->stride], r2 = q[0]*q[0] + q[x->stride]*q[x->stride] + z*z;
        const real w = (real)1.5*k/(r2*r2*GVI_SQRT(r2)), plane = w*(5*z*z/r2 - 1);
        x->f[j] += plane*q[0];
        x->f[x->stride + j] += plane*q[x->stride];
        x->f[2*x->stride + j] += (plane - 2*w)*z;
    }
    return 0;
}

static int ring_value(const gvi_points *x, void *user)
{
    const real k = *(const real *)user, *q = x->q;
    for (int j = 0; j < x->count; ++j, ++q) {
        const real z = q[2*x->stride], r2 = q[0]*q[0] + q[x->stride]*q[x->stride] + z*z;
        x->value[j] += k*(3*z*z/r2 - 1)/(2*r2*GVI_SQRT(r2));
    }
    return 0;
}

static int air(const gvi_points *x, void *user)
{
    const real k = *(const real *)user;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < x->count; ++j) x->f[i*x->stride + j] -= k*x->v[i*x->stride + j];
    return 0;
}

static int clock_rate(const gvi_points *x, void *user)      /* g = r^2 */
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < x->count; ++j) {
            const real q = x->q[i*x->stride + j];
            if (x->value) x->value[j] += q*q;
            if (x->f) x->f[i*x->stride + j] += 2*q;
        }
    return (void)user, 0;
}

static real strength[EFFECTS] = { 1, (real)0.01L, (real)0.001L, (real)0.0001L };
static const gvi_effect all[EFFECTS] = {
    { .kind = GVI_POTENTIAL, .points = sun, .value = sun_value, .user = strength + SUN },
    { .kind = GVI_POTENTIAL, .points = far_mass, .user = strength + FAR },
    { .kind = GVI_POTENTIAL, .points = ring, .value = ring_value, .user = strength + RING },
    { .kind = GVI_FORCE, .points = air, .user = strength + AIR } };
static const real q0[] = { (real)0.75L, 0, (real)0.125L }, v0[] = { 0, (real)1.25L, (real)0.25L };

/* A stepper of `wanted` effects, one bit each; those in `marked` are weak       */
typedef struct trial {
    gvi_effect  effects[EFFECTS + 1];
    gvi_stepper st;
    real        memory[GVI_LENGTH(3, DEGREE, DEGREE)];
} trial;

static void set_up(trial *a, unsigned wanted, unsigned marked, gvi_desc desc)
{
    desc.n = 3;
    if (!desc.degree) desc.degree = DEGREE;
    desc.effects = a->effects;
    for (int e = 0; e < EFFECTS; ++e)
        if (wanted >> e & 1u) {
            a->effects[desc.effect_count] = all[e];
            a->effects[desc.effect_count++].weak = marked >> e & 1u;
        }
    assert_ok(gvi_init(&a->st, &desc, a->memory, sizeof a->memory));
    assert_ok(gvi_start(&a->st, 0, q0, v0));
}

static const real h = (real)0.5L;                 // 12 steps a revolution, nearly
static void steps(trial *a, int count) { while (count-- > 0) assert_ok(gvi_step(&a->st, h)); }

static real apart(const trial *a, const trial *b)
{
    real worst = 0;
    for (int i = 0; i < 3; ++i) worst = (real)fmaxl(worst, fabsl((long double)a->st.q[i] - b->st.q[i]));
    return worst;
}

static void assert_same(const trial *a, const trial *b)
{
    assert_memory_equal(a->st.q, b->st.q, 3*sizeof(real));
    assert_memory_equal(a->st.p, b->st.p, 3*sizeof(real));
}

enum { STEPS = 120 };
static trial plain, marked;

/* In all formulations that iterate: the same q, of what is marked not more than `share`
   of the evaluations, and about a round more a step: a third of them where they are many */
static void compare(unsigned wanted, unsigned weak, gvi_formulation f, double share)
{
    const gvi_desc desc = { .formulation = f };
    set_up(&plain, wanted, 0, desc);
    set_up(&marked, wanted, weak, desc);
    steps(&plain, STEPS);
    steps(&marked, STEPS);
    assert_between(0, apart(&plain, &marked), 2000*EPS);    // errors along the orbit grow with t^2
    const gvi_counters *a = &plain.st.counters, *b = &marked.st.counters;
    // the answers of the weak effects count for nothing in it: seen to be within 1.6 of each other
    assert_between(a->worst_contraction/2, b->worst_contraction, 2*a->worst_contraction);
    for (int e = 0, i = 0; e < EFFECTS; ++e) {
        if (!(wanted >> e & 1u)) continue;
        const double ratio = (double)b->effect[i]/(double)a->effect[i];
        const double rounds = (double)a->effect[i]/(STEPS*DEGREE), more = rounds*(ratio - 1);       // a step
        ++i;
        if (GVI__WEAK && weak >> e & 1u) assert_between(0.2, ratio, share);
        else if (!(weak >> e & 1u)) assert_between(-rounds/10, more, fmax(1.3, rounds*0.35));
    }
}

static void test_same_steps(void **state)
{
    (void)state;
    compare(1u << SUN | 1u << FAR, 1u << FAR, GVI_AUTO, 0.7);
    compare(1u << SUN | 1u << FAR, 1u << FAR, GVI_POSITIONS, 0.7);
    compare(1u << SUN | 1u << FAR, 1u << FAR, GVI_VELOCITIES, 0.7);
    compare(1u << SUN | 1u << FAR, 1u << FAR, GVI_MOMENTA, 0.7);
    compare(1u << SUN | 1u << AIR, 1u << AIR, GVI_VELOCITIES, 0.7);
    compare(1u << SUN | 1u << AIR, 1u << AIR, GVI_MOMENTA, 0.7);
    compare((1u << EFFECTS) - 1, 1u << FAR | 1u << RING | 1u << AIR, GVI_AUTO, 0.8);
}

/* A mark where nothing is weak: the leading effect, all of them, the only one.  It costs a
   round a step, for the second answer, and another one in float, where there are three.  The
   same extrapolation for both: none of the steps tries the other                          */
static void test_wrong_marks(void **state)
{
    static const unsigned wrong[][2] = {
        { 1u << SUN | 1u << FAR, 1u << SUN }, { 1u << SUN | 1u << FAR, 1u << SUN | 1u << FAR },
        { 1u << SUN | 1u << AIR, 1u << SUN }, { 1u << SUN, 1u << SUN } };
    (void)state;
    for (int i = 0; i < COUNT(wrong); ++i) {
        set_up(&plain, wrong[i][0], 0, (gvi_desc){ 0 });
        set_up(&marked, wrong[i][0], wrong[i][1], (gvi_desc){ 0 });
        steps(&plain, 1);
        steps(&marked, 1);
        plain.st.x.learned.stage = marked.st.x.learned.stage = GVI__IDLES;
        steps(&plain, STEPS - 1);
        steps(&marked, STEPS - 1);
        assert_between(0, apart(&plain, &marked), 2000*EPS);
        assert_between(0, marked.st.counters.iterations,
                       plain.st.counters.iterations + STEPS*(GVI__KIND == 1 ? 2 : 1));
    }
}

/* Between weak and strong; the ring then changes the orbit beyond recognition     */
static void test_any_strength(void **state)
{
    (void)state;
    for (real k = (real)0.03125L; k > 16*EPS; k /= 8) {
        const real was = strength[RING];
        strength[RING] = k;
        compare(1u << SUN | 1u << RING, 1u << RING, GVI_AUTO, 1.3);
        strength[RING] = was;
    }
}

/* With a tolerance: no further from the truth than twice the unmarked scene, which may
   leave the tolerance in q each step, and of the orbit's phase t^2 times that        */
static void test_tolerance(void **state)
{
    const real tolerance = GVI__KIND == 1 ? (real)1e-4L : (real)1e-8L;
    const unsigned scene = 1u << SUN | 1u << FAR;
    real error[2];
    (void)state;
    set_up(&plain, scene, 0, (gvi_desc){ 0 });
    steps(&plain, STEPS);
    for (int i = 0; i < 2; ++i) {
        set_up(&marked, scene, i ? 1u << FAR : 0, (gvi_desc){ .tolerance = tolerance });
        steps(&marked, STEPS);
        error[i] = apart(&plain, &marked);
    }
    assert_between(0, error[0], tolerance*STEPS*STEPS/4);
    assert_between(0, error[1], 2*error[0]);
}

/* Over 4000 steps: momentum about the axis to rounding, energy without a trend       */
static void test_invariants(void **state)
{
    real E0, L0, worst[4] = { 0, 0, 0, 0 };
    const real *q = NULL, *p = NULL;
    (void)state;
    set_up(&marked, 1u << SUN | 1u << RING, 1u << RING, (gvi_desc){ 0 });
    q = marked.st.q;
    p = marked.st.p;
    assert_ok(gvi_energy(&marked.st, &E0));
    L0 = q[0]*p[1] - q[1]*p[0];
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 1000; ++i) {
            real E;
            steps(&marked, 1);
            assert_ok(gvi_energy(&marked.st, &E));
            worst[k] = (real)fmaxl(worst[k], fabsl((long double)E - E0));
            assert_close(q[0]*p[1] - q[1]*p[0], L0, 64*EPS);
        }
    assert_between(0, worst[3], 2*worst[0] + 64*EPS);
}

/* Queries, a step that fails and a checkpoint leave no trace                        */
static void test_no_trace(void **state)
{
    static trial other;
    static real copy[COUNT(marked.memory)];
    const unsigned scene = 1u << SUN | 1u << FAR;
    const gvi_desc desc = { .formulation = GVI_POSITIONS, .max_iterations = 7 + 4*GVI__KIND };
    (void)state;
    set_up(&plain, scene, 1u << FAR, desc);
    set_up(&marked, scene, 1u << FAR, desc);
    steps(&plain, 20);
    for (int k = 0; k < 20; ++k) {
        real v[3];
        steps(&marked, 1);
        assert_ok(gvi_velocity(&marked.st, v));
        assert_ok(gvi_state_at(&marked.st, marked.st.t - h/3, NULL, v, NULL));
        assert_status(gvi_step(&marked.st, 10*h), GVI_E_CONVERGENCE);      // after iterations that teach it
    }
    assert_same(&plain, &marked);

    const gvi_stepper saved = plain.st;
    memcpy(copy, plain.memory, sizeof copy);
    set_up(&other, scene, 1u << FAR, desc);
    assert_ok(gvi_restore(&other.st, &saved, copy));
    steps(&plain, 20);
    steps(&other, 20);
    assert_same(&plain, &other);
}

/* A checkpoint goes on with the marks of the stepper that it is restored to          */
static void test_own_marks(void **state)
{
    const unsigned scene = 1u << SUN | 1u << FAR | 1u << RING;
    const gvi_desc desc = { .formulation = GVI_POSITIONS };
    (void)state;
    set_up(&plain, scene, 1u << FAR, desc);
    set_up(&marked, scene, 1u << RING, desc);
    steps(&plain, 20);
    assert_ok(gvi_restore(&marked.st, &plain.st, plain.memory));
    const gvi_counters was = marked.st.counters, *is = &marked.st.counters;
    steps(&marked, 20);
    assert_true(is->effect[1] - was.effect[1] == is->effect[0] - was.effect[0]);
    if (GVI__WEAK) assert_true(is->effect[2] - was.effect[2] < is->effect[0] - was.effect[0]);
}

/* Switched off and on: as a scene without it, and as if it had just begun           */
static void test_switch(void **state)
{
    (void)state;
    set_up(&plain, 1u << SUN, 0, (gvi_desc){ .formulation = GVI_POSITIONS });
    set_up(&marked, 1u << SUN | 1u << FAR, 1u << FAR, (gvi_desc){ .formulation = GVI_POSITIONS });
    assert_ok(gvi_switch(&marked.st, 1, 0));
    steps(&plain, 20);
    steps(&marked, 20);
    assert_same(&plain, &marked);
    assert_int_equal(marked.st.counters.effect[1], 0);

    set_up(&plain, 1u << SUN | 1u << FAR, 0, (gvi_desc){ .formulation = GVI_POSITIONS });
    assert_ok(gvi_start(&plain.st, marked.st.t, marked.st.q, marked.st.p));
    assert_ok(gvi_start(&marked.st, marked.st.t, marked.st.q, marked.st.p));
    assert_ok(gvi_switch(&marked.st, 1, 1));
    steps(&plain, STEPS);
    steps(&marked, STEPS);
    assert_between(0, apart(&plain, &marked), 2000*EPS);
}

/* Where marks are not heeded: to the bit                                              */
static void test_not_heeded(void **state)
{
    const unsigned scene = 1u << SUN | 1u << RING, weak = 1u << RING;
    const gvi_desc elsewhere[] = {
        { .formulation = GVI_NEWTON }, { .iterations = 12 }, { .rule = { GVI_LOBATTO, 0, NULL, NULL }, .iterations = 12 } };
    (void)state;
    for (int i = 0; i < COUNT(elsewhere); ++i) {
        set_up(&plain, scene, 0, elsewhere[i]);
        set_up(&marked, scene, weak, elsewhere[i]);
        steps(&plain, 20);
        steps(&marked, 20);
        assert_same(&plain, &marked);
    }
    // Stoermer-Verlet with air: rows do not see the force at the end of the step, momentum does
    const gvi_desc verlet = { .degree = 1, .rule = { GVI_LOBATTO, 0, NULL, NULL } };
    set_up(&plain, 1u << SUN | 1u << AIR, 0, verlet);
    set_up(&marked, 1u << SUN | 1u << AIR, 1u << SUN, verlet);
    for (int k = 0; k < 20; ++k) {
        assert_ok(gvi_step(&plain.st, h/4));
        assert_ok(gvi_step(&marked.st, h/4));
    }
    assert_same(&plain, &marked);
    for (int k = 0; k < 2; ++k) {
        trial *a = k ? &marked : &plain;
        gvi_desc desc = { .effect_count = 0 };
        a->effects[0] = (gvi_effect){ .kind = GVI_CLOCK, .points = clock_rate };
        desc.effect_count = 1;
        set_up(a, scene, k ? weak : 0, desc);
        steps(a, 20);
    }
    assert_same(&plain, &marked);
}

/* Steps so long that the iteration runs away, beside a steep wall and a slow force: with a
   mark, too, none is taken for a solution.  Up to eight times the last length it is the extrapolation
   that leads astray, and plain rows lead to the solution                           */
static int steep(const gvi_points *x, void *user)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < x->count; ++j) {
            const real q = x->q[i*x->stride + j];
            x->f[i*x->stride + j] -= q*q*q;
        }
    return (void)user, 0;
}

static void test_divergence(void **state)
{
    int failed = 0, early = 0;
    (void)state;
    for (int weak = 0; weak < 4; ++weak)
        for (real k = 2; k < 12; k += (real)0.015625L) {
            set_up(&marked, 1u << FAR, 0, (gvi_desc){ .effect_count = 0 });
            marked.effects[1] = (gvi_effect){ .points = steep, .weak = weak & 1 };
            marked.effects[0].weak = weak >> 1;
            const gvi_desc desc = { .n = 3, .degree = DEGREE, .effects = marked.effects, .effect_count = 2,
                                    .formulation = GVI_POSITIONS };
            assert_ok(gvi_init(&marked.st, &desc, marked.memory, sizeof marked.memory));
            assert_ok(gvi_start(&marked.st, 0, q0, v0));
            steps(&marked, 4);
            const gvi_status status = gvi_step(&marked.st, k*h);
            failed += status != GVI_OK;
            early += status != GVI_OK && k < 8;
            for (int c = 0; c < 3 && status == GVI_OK; ++c) assert_between(-4, marked.st.q[c], 4);
        }
    assert_true(failed > 900);
    assert_true(early < 100);                     // of 1536
}

/* A spring too stiff for the fixed point, marked or not: AUTO goes over to Newton's method,
   a pinned fixed point says so                                                        */
static void test_no_contraction(void **state)
{
    (void)state;
    strength[SUN] = 400;
    for (unsigned weak = 0; weak < 2; ++weak) {
        set_up(&marked, 1u << SUN, weak, (gvi_desc){ .formulation = GVI_POSITIONS });
        assert_status(gvi_step(&marked.st, h), GVI_E_CONVERGENCE);
        assert_memory_equal(marked.st.q, q0, sizeof q0);
    }
    strength[SUN] = 1;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_steps),
        cmocka_unit_test(test_wrong_marks),
        cmocka_unit_test(test_any_strength),
        cmocka_unit_test(test_tolerance),
        cmocka_unit_test(test_invariants),
        cmocka_unit_test(test_no_trace),
        cmocka_unit_test(test_own_marks),
        cmocka_unit_test(test_switch),
        cmocka_unit_test(test_not_heeded),
        cmocka_unit_test(test_divergence),
        cmocka_unit_test(test_no_contraction),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
