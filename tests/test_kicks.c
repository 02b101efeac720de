/* GVI_KICKS: compositions of Stoermer-Verlet and kick-drift splittings by a table.
   In long double, so that order 8 is seen well above rounding; the coefficients
   of most tables have 15 digits, so errors are compared where they are above 1e-14. */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#include "gvi_test.h"
#include "problems.h"
#include "hard/extrapolate.h"
#include "splittings.h"

static real dense[4] = { 2, 0.5L, 0.5L, 1 };
static real diagonal[2] = { 2, 0.75L };

static void force(real t, const real *q, real *f) { weights(t, q, NULL, f, NULL, dense); }

static void over_mass(gvi_mass_kind mass, const real *p, real *v)
{
    const real det = dense[0]*dense[3] - dense[1]*dense[2];
    for (int i = 0; i < 2; ++i) v[i] = mass == GVI_MASS_UNIT ? p[i] : p[i]/diagonal[i];
    if (mass != GVI_MASS_DENSE) return;
    v[0] = (dense[3]*p[0] - dense[1]*p[1])/det;
    v[1] = (dense[0]*p[1] - dense[2]*p[0])/det;
}

static void rates(real t, const real *y, real *dy, void *user)
{
    over_mass(*(gvi_mass_kind *)user, y + 2, dy);
    dy[2] = dy[3] = 0;
    force(t, y, dy + 2);
}

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = weights, .user = dense } };
static const real start[4] = { 0.7L, -0.4L, 1.1L, 0.6L };
static const real when = 0.3L, length = 1.5L;
static real memory[4000], more[4000];

static int table_count;
#define EACH_TABLE(a) \
    for (const table *first_ = tables(&table_count), *a = first_; a < first_ + table_count; ++a)

static gvi_desc describe(const table *a, gvi_mass_kind mass)
{
    const real *matrix = mass == GVI_MASS_DENSE ? dense : diagonal;
    return (gvi_desc){ .n = 2, .rule = { GVI_KICKS, a->r, a->c, a->b }, .effects = scene, .effect_count = 1,
                       .mass = { .kind = mass, .matrix = mass == GVI_MASS_UNIT ? NULL : matrix } };
}

static gvi_stepper *set_up(gvi_stepper *st, const gvi_desc *desc, const real *y, real *where)
{
    assert_true(gvi_size(desc) > 0 && gvi_size(desc) <= sizeof memory);
    assert_ok(gvi_init(st, desc, where, sizeof memory));
    assert_ok(gvi_start_momentum(st, when, y, y + 2));
    return st;
}

static real distance(const real *q, const real *p, const real *y)
{
    return hypot(hypot(q[0] - y[0], q[1] - y[1]), hypot(p[0] - y[2], p[1] - y[3]));
}

/* Errors at the end of N steps, and at a time inside the last one */
static void errors(const table *a, gvi_mass_kind mass, int N, real last, real *end, real *inside)
{
    const motion exact = { 4, rates, &mass };
    const real h = length/N;
    const gvi_desc desc = describe(a, mass);
    gvi_stepper st;
    real y[4], q[2], p[2];
    set_up(&st, &desc, start, memory);
    assert_int_equal(st.formulation, GVI_EXPLICIT);
    for (int k = 0; k < N; ++k) assert_ok(gvi_step(&st, h));
    memcpy(y, start, sizeof y);
    flow(&exact, when, last, 1/16.0L, y);
    assert_ok(gvi_state_at(&st, last, q, NULL, p));
    *inside = distance(q, p, y);
    flow(&exact, last, when + length, 1/16.0L, y);
    *end = distance(st.q, st.p, y);
}

/* Two-sided: the next term of the expansion is 1/8 or less of the first by then */
TEST(every_table_has_its_order_on_both_sides)
{
    EACH_TABLE(method)
    for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_DENSE; ++mass) {
        const int N = method->r == 23 ? 6 : method->order == 8 ? 12 : method->order == 6 ? 10 : 64;
        const real last = when + length - length/N*3/16;        // inside the last step of both
        real end[2], inside[2];
        for (int k = 0; k < 2; ++k) errors(method, (gvi_mass_kind)mass, N << k, last, &end[k], &inside[k]);
        const real order = log2(end[0]/end[1]), within = log2(inside[0]/inside[1]);
        assert_true(end[1] > 1e-15L);          // far above rounding, also that of the tables
        assert_between(method->order - 0.3L, order, method->order + 0.3L);
        assert_between(method->order - 0.3L, within, method->order + 0.3L);
    }
}

/* Drift to each node, kick, drift to the end */
static void by_hand(const table *a, gvi_mass_kind mass, real t, real h, real *y)
{
    real at = 0, v[2];
    for (int j = 0; j <= a->r; ++j) {
        const real to = j < a->r ? a->c[j] : 1;
        real f[2] = { 0, 0 };
        over_mass(mass, y + 2, v);
        for (int i = 0; i < 2; ++i) y[i] += (to - at)*h*v[i];
        at = to;
        if (j == a->r) break;
        force(t + at*h, y, f);
        for (int i = 0; i < 2; ++i) y[2 + i] += h*a->b[j]*f[i];
    }
}

/* 50 steps of a regular motion: a rounding each of 2r sums a step, passed on about 1:1 */
TEST(steps_are_those_of_a_splitting_written_by_hand)
{
    EACH_TABLE(method)
    for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_DENSE; ++mass) {
        const gvi_desc desc = describe(method, (gvi_mass_kind)mass);
        gvi_stepper st;
        real y[4];
        memcpy(y, start, sizeof y);
        set_up(&st, &desc, start, memory);
        for (int k = 0; k < 50; ++k) {
            by_hand(method, (gvi_mass_kind)mass, when + k*0.0625L, 0.0625L, y);
            assert_ok(gvi_step(&st, 0.0625L));
        }
        assert_between(0, distance(st.q, st.p, y), 8*EPS*sqrt((real)100*method->r));
        assert_close(st.t, when + 50*0.0625L, 2*EPS);
    }
}

TEST(two_kicks_are_lobatto_of_degree_one_to_the_bit)
{
    static const table two = { "", 2, 2, 1, { 0, 1 }, { 0.5L, 0.5L } };
    for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_DENSE; ++mass) {
        const gvi_desc kicks = describe(&two, (gvi_mass_kind)mass);
        gvi_desc lobatto = kicks;
        gvi_stepper x, y;
        lobatto.degree = 1;
        lobatto.rule = (gvi_rule){ GVI_LOBATTO, 2, NULL, NULL };
        set_up(&x, &kicks, start, memory);
        set_up(&y, &lobatto, start, more);
        assert_int_equal(y.formulation, GVI_EXPLICIT);
        for (int k = 0; k < 1000; ++k) move_alike(&x, &y, 1, 0.01L*(k % 3 + 1));
    }
}

/* A rounding of a kick or a drift changes q x p by EPS/2 of |q||p| or less, at most 2
   here; r + 1 of them a step, independent: the bound is four standard deviations */
TEST(angular_momentum_is_kept_by_every_kick)
{
    static const gvi_effect sun[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    EACH_TABLE(method) {
        gvi_desc desc = describe(method, GVI_MASS_UNIT);
        gvi_stepper st;
        desc.effects = sun;
        set_up(&st, &desc, (const real[]){ 0.4L, 0, 0, 2 }, memory);
        check_angular_momentum(&st, 2000, 0.05L, 4*sqrt((real)method->r + 1));
    }
}

/* The force at the end of a step is that at the start of the next, if both are nodes */
TEST(the_last_kick_is_not_asked_for_twice)
{
    EACH_TABLE(method) {
        const gvi_desc desc = describe(method, GVI_MASS_UNIT);
        const int r = method->r, shared = method->c[0] == 0 && method->c[r - 1] == 1;
        gvi_stepper st;
        set_up(&st, &desc, start, memory);
        for (int k = 0; k < 100; ++k) assert_ok(gvi_step(&st, 0.01L));
        assert_int_equal(st.counters.effect[0], shared ? 100*(r - 1) + 1 : 100*r);
        assert_int_equal(st.counters.iterations + st.counters.newton_iterations, 0);
        assert_int_equal(st.counters.factorizations, 0);
    }
}

/* Zeros at the start, in the middle, two together, before the last: the step is that without them, to a
   rounding of each drift, which is in two parts then; a kick at the end is asked for, for the next step */
TEST(kicks_of_weight_zero_are_left_out)
{
    static const table without = { "", 4, 3, 0, { 0, 0.6L, 1 }, { 0.25L, 0.5L, 0.25L } };
    static const table with[] = {
        { "", 4, 4, 0, { 0, 0.3L, 0.6L, 1 }, { 0.25L, 0, 0.5L, 0.25L } },
        { "", 4, 6, 0, { 0, 0.3L, 0.4L, 0.6L, 0.9L, 1 }, { 0.25L, 0, 0, 0.5L, 0, 0.25L } },
        { "", 4, 4, 0, { 0, 0, 0.6L, 1 }, { 0, 0.25L, 0.5L, 0.25L } },
        { "", 4, 4, 0, { 0, 0.6L, 1, 1 }, { 0.25L, 0.5L, 0.25L, 0 } },
    };
    static const int asked[] = { 100*2 + 1, 100*2 + 1, 100*3, 100*3 + 1 };
    for (int i = 0; i < COUNT(with); ++i)
    for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_DENSE; ++mass) {
        const gvi_desc a = describe(&without, (gvi_mass_kind)mass), b = describe(&with[i], (gvi_mass_kind)mass);
        gvi_stepper x, y;
        set_up(&x, &a, start, memory);
        set_up(&y, &b, start, more);
        for (int k = 0; k < 100; ++k) {
            assert_ok(gvi_step(&x, 0.01L));
            assert_ok(gvi_step(&y, 0.01L));
        }
        const real end[] = { y.q[0], y.q[1], y.p[0], y.p[1] };
        assert_between(0, distance(x.q, x.p, end), 4*EPS);
        assert_int_equal(y.counters.effect[0], asked[i]);
    }
}

AT_POINT(reads_v)
{
    f[0] -= v[0];
    if (dldv) dldv[0] += v[0];
    return 0;
}

static gvi_status status_of(const gvi_desc *desc)
{
    gvi_stepper st;
    const gvi_status status = gvi_init(&st, desc, memory, sizeof memory);
    assert_int_equal(gvi_size(desc) > 0, status == GVI_OK);
    return status;
}

TEST(faulty_tables_are_refused)
{
    static const gvi_status wanted[] = { GVI_OK, GVI_E_ORDER, GVI_E_NODES, GVI_E_NODES, GVI_E_ARGUMENT,
                                         GVI_E_ARGUMENT, GVI_OK, GVI_E_FORMULATION };
    for (int k = 0; k < COUNT(wanted); ++k) {
        table bad = tables(&table_count)[1];
        gvi_desc desc = describe(&bad, GVI_MASS_UNIT);
        if (k == 1) bad.b[1] += 1e-6L;
        if (k == 2) bad.b[1] = NAN;
        if (k == 3) bad.c[2] = INFINITY;
        if (k == 4) desc.rule.weights = NULL;
        if (k == 5) desc.degree = 2;
        if (k >= 6) desc.degree = 1;
        if (k == 7) desc.formulation = GVI_POSITIONS;
        assert_status(status_of(&desc), wanted[k]);
    }
}

TEST(scenes_that_no_kick_can_move_are_refused)
{
    for (int kind = GVI_FORCE; kind <= GVI_LAGRANGIAN; ++kind) {
        const gvi_effect effects[] = { scene[0], { .kind = (gvi_kind)kind, .point = reads_v } };
        gvi_desc desc = describe(tables(&table_count), GVI_MASS_UNIT);
        desc.effects = effects;
        desc.effect_count = 2;
        assert_int_equal(status_of(&desc), GVI_E_FORMULATION);
    }
}

TEST(questions_that_a_broken_line_cannot_answer_are_refused)
{
    const gvi_desc desc = describe(&tables(&table_count)[3], GVI_MASS_UNIT);
    gvi_stepper st;
    real q[2] = { 7, 7 }, number = 7;
    set_up(&st, &desc, start, memory);
    assert_ok(gvi_step(&st, 0.125L));
    assert_status(gvi_curve(&st, 0.5L, q, NULL), GVI_E_FORMULATION);
    assert_status(gvi_action(&st, &number), GVI_E_FORMULATION);
    assert_status(gvi_discrete_lagrangian(&st, 0, 0.125L, start, start + 2, &(gvi_discrete){ .p0 = q }),
                  GVI_E_FORMULATION);
    assert_status(gvi_start_configurations(&st, 0, 0.125L, start, start + 2), GVI_E_FORMULATION);
    assert_true(q[0] == 7 && q[1] == 7 && number == 7);
    assert_ok(gvi_step(&st, 0.125L));
}

TEST(a_checkpoint_continues_to_the_bit)
{
    static real saved_memory[4000];
    EACH_TABLE(method) {
        const gvi_desc desc = describe(method, GVI_MASS_DENSE);
        gvi_stepper a, b, saved;
        set_up(&a, &desc, start, memory);
        for (int k = 0; k < 7; ++k) assert_ok(gvi_step(&a, 0.125L));
        saved = a;
        memcpy(saved_memory, memory, sizeof memory);
        assert_ok(gvi_init(&b, &desc, more, sizeof more));
        assert_ok(gvi_restore(&b, &saved, saved_memory));
        move_alike(&a, &b, 7, 0.125L);
        assert_int_equal(a.counters.effect[0], b.counters.effect[0]);
    }
}

/* Steps too long, until one fails: that is no fault of an effect, and the state is a number, the last one.
   And a momentum that turns round next to the largest number: p is finite at both ends, its increment not */
AT_POINTS(spring)
{
    for (int k = 0; k < x->n*x->stride; ++k) x->f[k] -= user ? 0.9L*MAX : x->q[k];
    return 0;
}

TEST(what_overflows_is_refused)
{
    static const table some[] = { { "", 2, 1, 0, { 0.5L }, { 1 } }, { "", 2, 2, 0, { 0, 1 }, { 0.5L, 0.5L } } };
    static const gvi_effect one[] = { { .kind = GVI_POTENTIAL, .points = spring } };
    static const gvi_effect turning[] = { { .kind = GVI_POTENTIAL, .points = spring, .user = dense } };
    for (int i = 0; i < 2*40; ++i) {
        const real h = 2.1L + (i/2)*0.5L;
        gvi_desc desc = describe(&some[i % 2], GVI_MASS_UNIT);
        gvi_stepper st;
        desc.effects = one;
        set_up(&st, &desc, start, memory);
        gvi_status status = GVI_OK;
        for (int k = 0; k < 1000000 && status == GVI_OK; ++k) status = gvi_step(&st, h);
        assert_int_equal(status, GVI_E_CONVERGENCE);
        for (int j = 0; j < 2; ++j) assert_true(isfinite(st.q[j]) && isfinite(st.p[j]));
    }
    for (int i = 0; i < 2; ++i) {
        const real y[4] = { 0, 0, 0.9L*MAX, 0.9L*MAX };
        gvi_desc desc = describe(&some[i], GVI_MASS_UNIT);
        gvi_stepper st;
        desc.effects = turning;
        set_up(&st, &desc, y, memory);
        SAME_STATE(&st) assert_status(gvi_step(&st, 2), GVI_E_CONVERGENCE);
    }
}

/* Off is as if not listed, and the kept force is not used over a switch */
TEST(a_switched_effect_is_in_the_next_kick)
{
    const gvi_effect twice[] = { scene[0], scene[0] };
    EACH_TABLE(method) {
        const gvi_desc one = describe(method, GVI_MASS_DIAGONAL);
        gvi_desc two = one;
        gvi_stepper a, b;
        two.effects = twice;
        two.effect_count = 2;
        set_up(&a, &one, start, memory);
        set_up(&b, &two, start, more);
        assert_ok(gvi_switch(&b, 1, 0));
        move_alike(&a, &b, 5, 0.125L);
        assert_int_equal(b.counters.effect[1], 0);

        // both on: the step from here is that of a stepper that starts here
        const test_state here = state_now(&b);
        assert_ok(gvi_switch(&b, 1, 1));
        assert_ok(gvi_step(&b, 0.125L));
        gvi_stepper fresh = new_stepper(&two);
        assert_ok(gvi_start_momentum(&fresh, here.t, here.q, here.p));
        assert_ok(gvi_step(&fresh, 0.125L));
        assert_between(0, distance(b.q, b.p, (const real[]){ fresh.q[0], fresh.q[1], fresh.p[0], fresh.p[1] }), 8*EPS);
    }
}

/* gvi_steps: what a loop of gvi_step does, to the bit; forth and back, with what st says of the last step */
static void expect_alike(gvi_stepper *a, gvi_stepper *b)
{
    const test_state last = state_now(a);
    assert_true(a->t == b->t && a->t_low == b->t_low && a->t0 == b->t0 && a->h == b->h);
    for (int i = 0; i < 2; ++i)
        assert_true(last.q[i] == b->q[i] && last.p[i] == b->p[i] && a->q_low[i] == b->q_low[i] && a->p_low[i] == b->p_low[i]);
    assert_true(a->counters.steps == b->counters.steps && a->counters.effect[0] == b->counters.effect[0]);
    assert_true(a->status == b->status && a->iterations == b->iterations && a->formulation == b->formulation);
}

static void steps_alike(const gvi_desc *desc)
{
    static const struct { int count; real h; } runs[] = { { 7, 0.125L }, { 1, 0.125L }, { 0, 0.125L }, { 5, -0.0625L }, { 3, 0.1L } };
    gvi_stepper a, b;
    set_up(&a, desc, start, memory);
    set_up(&b, desc, start, more);
    for (int k = 0; k < COUNT(runs); ++k) {
        for (int i = 0; i < runs[k].count; ++i) assert_ok(gvi_step(&a, runs[k].h));
        assert_ok(gvi_steps(&b, runs[k].h, runs[k].count));
        expect_alike(&a, &b);
        assert_ok(gvi_switch(&a, 0, 1));
        assert_ok(gvi_switch(&b, 0, 1));
    }
    real q[2][2], p[2][2];
    assert_ok(gvi_state_at(&a, a.t0 + (a.t - a.t0)/4, q[0], NULL, p[0]));
    assert_ok(gvi_state_at(&b, b.t0 + (b.t - b.t0)/4, q[1], NULL, p[1]));
    for (int i = 0; i < 2; ++i) assert_true(q[0][i] == q[1][i] && p[0][i] == p[1][i]);
}

TEST(steps_in_a_row_are_those_one_by_one)
{
    EACH_TABLE(method)
        for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_DENSE; ++mass) {
            const gvi_desc desc = describe(method, (gvi_mass_kind)mass);
            steps_alike(&desc);
        }
    const gvi_desc others[] = { { .n = 2, .degree = 1, .rule = { .kind = GVI_LOBATTO }, .effects = scene, .effect_count = 1 },
                                { .n = 2, .degree = 4, .effects = scene, .effect_count = 1 },
                                { .n = 2, .degree = 3, .effects = scene, .effect_count = 1, .formulation = GVI_MOMENTA },
                                { .n = 2, .degree = 3, .effects = scene, .effect_count = 1, .formulation = GVI_NEWTON } };
    for (int k = 0; k < COUNT(others); ++k) steps_alike(others + k);
}

/* From t = 1 on the force is not defined: the state is that after the last step that succeeded */
static int until_one(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        if (x->t[k] >= 1) return 1;
        x->f[k] -= x->q[k];
    }
    return 0;
}

TEST(steps_in_a_row_end_at_the_first_that_fails)
{
    static const gvi_effect effects[] = { { .points = until_one } };
    const gvi_desc desc = { .n = 1, .degree = 1, .rule = { .kind = GVI_LOBATTO }, .effects = effects, .effect_count = 1 };
    gvi_stepper a, b;
    assert_ok(gvi_init(&a, &desc, memory, sizeof memory));
    assert_ok(gvi_init(&b, &desc, more, sizeof more));
    assert_int_equal(gvi_steps(&a, 0.125L, 3), GVI_E_STATE);
    assert_ok(gvi_start(&a, 0, start, start + 2));
    assert_ok(gvi_start(&b, 0, start, start + 2));
    for (int k = 0; k < 7; ++k) assert_ok(gvi_step(&b, 0.125L));
    assert_int_equal(gvi_steps(&a, 0.125L, 20), GVI_E_CALLBACK);
    assert_true(a.t == 0.875L && a.q[0] == b.q[0] && a.p[0] == b.p[0] && a.counters.steps == 7 && a.counters.failures == 1);
    assert_int_equal(a.fault.effect, 0);
    SAME_STATE(&a) assert_int_equal(gvi_steps(&a, 0.125L, 2), GVI_E_CALLBACK);
    assert_ok(gvi_steps(&a, 0.125L, 0));          // does nothing: the failure stays where it can be read
    assert_true(a.status == GVI_E_CALLBACK && a.fault.effect == 0);
    assert_ok(gvi_steps(&a, -0.125L, 2));

    // a checkpoint between goes on to the bit
    const gvi_stepper saved = b;
    memcpy(memory, more, sizeof more);
    assert_ok(gvi_steps(&b, -0.125L, 3));
    gvi_stepper c;
    static real third[4000];
    assert_ok(gvi_init(&c, &desc, third, sizeof third));
    assert_ok(gvi_restore(&c, &saved, memory));
    assert_ok(gvi_steps(&c, -0.125L, 3));
    assert_true(c.q[0] == b.q[0] && c.p[0] == b.p[0] && c.t == b.t);
    SAME_STATE(&b) {
        assert_int_equal(gvi_steps(&b, 0.125L, -1), GVI_E_ARGUMENT);
        assert_int_equal(gvi_steps(&b, 0, 1), GVI_E_ARGUMENT);
        assert_ok(gvi_steps(&b, 0.125L, 0));
    }
}

RUN_TESTS(NULL, NULL)
