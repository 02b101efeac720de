/* The contract: defaults, memory, every status and what it leaves behind (conjugate points: test_queries.c),
   checkpoints, switched effects. */
#include "gvi_test.h"
#include "problems.h"

/* For any n: a chain of pendulums, a term linear in v, drag; and one effect that
   does nothing until `harm` tells it to misbehave. */
enum { N_MAX = 6 };

AT_EACH(chain)
{
    const int i = a/x->stride;
    real f = -(real)(1 + i)*sin(x->q[a]);
    if (i > 0) f += (x->q[a - x->stride] - x->q[a])/2;
    if (i + 1 < x->n) f += (x->q[a + x->stride] - x->q[a])/2;
    x->f[a] += f;
}

AT_EACH(chain_value)
{
    const real d = a >= x->stride ? x->q[a - x->stride] - x->q[a] : 0;
    x->value[a % x->stride] += d*d/4 - (real)(1 + a/x->stride)*cos(x->q[a]);
}

/* L = sum_i q_(i+1) v_i/5 */
static int next(const gvi_points *x, int a) { return (a + x->stride)%(x->n*x->stride); }

AT_EACH(coupling)
{
    x->dldv[a] += x->q[next(x, a)]/5;
    x->f[next(x, a)] += x->v[a]/5;
}

AT_EACH(coupling_value) { x->value[a % x->stride] += x->q[next(x, a)]*x->v[a]/5; }

AT_EACH(drag) { x->f[a] -= x->v[a]/10; }

/* Kinetic energy as a Lagrangian term: sum v^2/2 + v^4/20 */
AT_EACH(kinetic) { x->dldv[a] += x->v[a] + x->v[a]*x->v[a]*x->v[a]/5; }

AT_EACH(kinetic_value)
{
    const real v2 = x->v[a]*x->v[a];
    x->value[a % x->stride] += v2/2 + v2*v2/20;
}

/* M = diag(2 + cos q_i) + 1/10 everywhere */
AT_EACH(mass_points)
{
    
    for (int j = 0, i = a/x->stride; j <= i; ++j)
        x->mass[(i*(x->n - 1) + j)*x->stride + a] = (i == j ? 2 + cos(x->q[a]) : 0) + (real)0.1;
}

AT_EACH(mass_gradient) { x->f[a] -= sin(x->q[a])*x->v[a]*x->v[a]/2; }
AT_EACH(spring) { x->f[a] -= x->q[a]; }
AT_POINTS(nothing) { return 0; }

static const gvi_effect chain_only[] = { { .kind = GVI_POTENTIAL, .points = chain } };
static const gvi_effect spring_only[] = { { .kind = GVI_POTENTIAL, .points = spring } };

typedef enum harm { NO_HARM, REFUSE, GIVE_NAN, GIVE_INF } harm_kind;
static harm_kind harm, mass_harm, value_harm;

/* At coordinate n-1, point 0 or, where there are three, 2 */
static int apply_harm(harm_kind what, const gvi_points *x, real *rows, int n)
{
    const int at = (n - 1)*x->stride + (x->count > 2 ? 2 : 0);
    if (what == GIVE_NAN) rows[at] = (real)NAN;
    if (what == GIVE_INF) rows[at] = (real)INFINITY;
    return what == REFUSE;
}

AT_POINTS(troublemaker) { return apply_harm(harm, x, x->f, x->n); }
AT_POINTS(troublesome_value) { return apply_harm(value_harm, x, x->value, 1); }
AT_POINTS(troublesome_mass) { return mass_points(x, user), apply_harm(mass_harm, x, x->mass, x->n*x->n); }

enum { POT = 1, COUP = 2, DRAG = 4, KIN = 8 };

typedef struct {
    gvi_formulation formulation;
    gvi_mass_kind   mass;
    int             has;                    /* POT | COUP | DRAG | KIN */
    int             n, s;
    gvi_rule_kind   rule;
    int             r;
} scene;

/* The description of a scene; the troublemaker is the last effect.  One at a
   time: the effects are kept here. */
static gvi_effect effects[8];

static gvi_desc describe(const scene *a)
{
    static const gvi_effect all[] = {
        { .kind = GVI_POTENTIAL, .points = chain, .value = chain_value },
        { .kind = GVI_LAGRANGIAN, .points = coupling, .value = coupling_value },
        { .kind = GVI_FORCE, .points = drag },
        { .kind = GVI_LAGRANGIAN, .points = kinetic, .value = kinetic_value },
        { .kind = GVI_POTENTIAL, .points = troublemaker, .value = troublesome_value },
    };
    static real diagonal[N_MAX], dense[N_MAX*N_MAX];
    gvi_desc d = { .n = a->n, .degree = a->s, .rule = { .kind = a->rule, .points = a->r },
                   .mass = { .kind = a->mass }, .effects = effects, .formulation = a->formulation };
    for (int i = 0; i < a->n; ++i) {
        diagonal[i] = (real)(1 + i);
        for (int j = 0; j < a->n; ++j) dense[i*a->n + j] = i == j ? 2 : (real)0.25;
    }
    for (int e = 0; e < COUNT(all); ++e)
        if ((a->has | 16) >> e & 1) effects[d.effect_count++] = all[e];
    if (a->mass == GVI_MASS_DIAGONAL) d.mass.matrix = diagonal;
    if (a->mass == GVI_MASS_DENSE) d.mass.matrix = dense;
    if (a->mass == GVI_MASS_POSITION) { d.mass.points = troublesome_mass; d.mass.gradient = mass_gradient; }
    harm = mass_harm = value_harm = NO_HARM;
    return d;
}

static const real q_start[N_MAX] = { 0.7, -0.4, 0.3, 1.1, -0.8, 0.2 };
static const real v_start[N_MAX] = { 0.1, 0.5, -0.2, 0.3, 0.4, -0.6 };
static const real h_good = 0.125;

/* One of each formulation and mass */
static const scene scenes[] = {
    { GVI_EXPLICIT,   GVI_MASS_UNIT,     POT,               2, 1, GVI_LOBATTO, 2 },
    { GVI_POSITIONS,  GVI_MASS_UNIT,     POT,               3, 8, GVI_GAUSS,   8 },
    { GVI_POSITIONS,  GVI_MASS_DENSE,    POT,               2, 3, GVI_LOBATTO, 4 },
    { GVI_AUTO,       GVI_MASS_DIAGONAL, POT,               3, 4, GVI_GAUSS,   6 },
    { GVI_MOMENTA,    GVI_MASS_DIAGONAL, POT | COUP,        3, 5, GVI_GAUSS,   5 },
    { GVI_AUTO,       GVI_MASS_DENSE,    POT | COUP | DRAG, 2, 4, GVI_GAUSS,   4 },
    { GVI_MOMENTA,    GVI_MASS_POSITION, POT,               3, 4, GVI_GAUSS,   4 },
    { GVI_AUTO,       GVI_MASS_POSITION, POT | COUP | DRAG, 2, 3, GVI_LOBATTO, 3 },
    { GVI_NEWTON,     GVI_MASS_UNIT,     POT | DRAG,        2, 4, GVI_GAUSS,   4 },
    { GVI_AUTO,       GVI_MASS_POSITION, POT | COUP,        2, 3, GVI_GAUSS,   5 },
    { GVI_AUTO,       GVI_MASS_NONE,     POT | KIN,         2, 3, GVI_GAUSS,   3 },
    { GVI_VELOCITIES, GVI_MASS_DIAGONAL, POT | DRAG,        3, 5, GVI_GAUSS,   5 },
};

enum { PAD = 64 };                                    /* reals on both sides */

typedef struct { real *base, *memory; size_t size; } guarded;

/* Inside NaN, so that a value read before it was written cannot stay hidden */
static guarded guard(size_t size)
{
    size_t reals = (size + sizeof(real) - 1)/sizeof(real) + 2*PAD;
    guarded g = { malloc(reals*sizeof(real)), NULL, size };
    assert_non_null(g.base);
    memset(g.base, 0xA5, reals*sizeof(real));
    g.memory = g.base + PAD;
    memset(g.memory, 0xFF, size);
    return g;
}

static void release(guarded *g)
{
    const unsigned char *before = (const unsigned char *)g->base;
    const unsigned char *after = (const unsigned char *)g->memory + g->size;
    for (size_t k = 0; k < PAD*sizeof(real); ++k) assert_true(before[k] == 0xA5 && after[k] == 0xA5);
    free(g->base);
}

/* A stepper with memory of exactly the size that was asked for */
typedef struct { gvi_stepper st; guarded g; gvi_desc desc; } bench;

static bench set_up_as(const gvi_desc *desc)
{
    bench b = { .desc = *desc };
    size_t size = gvi_size(desc);
    assert_true(size > 0);
    b.g = guard(size);
    memset(&b.st, 0xFF, sizeof b.st);
    assert_ok(gvi_init(&b.st, &b.desc, b.g.memory, size));
    return b;
}

static bench start_as(const gvi_desc *desc, const real *q, const real *v)
{
    bench b = set_up_as(desc);
    assert_ok(gvi_start(&b.st, 0, q, v));
    return b;
}

static bench set_up(const scene *a)
{
    const gvi_desc desc = describe(a);
    return set_up_as(&desc);
}

static bench start(const scene *a)
{
    bench b = set_up(a);
    assert_ok(gvi_start(&b.st, 0.25, q_start, v_start));
    return b;
}

static void steps(gvi_stepper *st, int count, real h)
{
    for (int k = 0; k < count; ++k) assert_ok(gvi_step(st, h));
}

static void tear_down(bench *b) { release(&b->g); }

/* gvi_init in memory enough for anything, where it need not succeed */
static gvi_stepper refused;

static gvi_status init(const gvi_desc *desc)
{
    static real memory[20000];
    memset(&refused, 0, sizeof refused);
    return gvi_init(&refused, desc, memory, sizeof memory);
}

/* Everything that can be asked, as numbers */
enum { CURVE_POINTS = 5 };
typedef struct {
    real t, h, q[N_MAX], p[N_MAX], v[N_MAX], energy, action;
    real curve[CURVE_POINTS][2*N_MAX], inside[3*N_MAX];
} snapshot;

static snapshot take(gvi_stepper *st)
{
    const harm_kind harms[] = { harm, mass_harm, value_harm };
    const gvi_stepper was = *st;
    snapshot s;
    harm = mass_harm = value_harm = NO_HARM;
    memset(&s, 0, sizeof s);
    s.t = st->t;
    s.h = st->h;
    memcpy(s.q, st->q, (size_t)st->n*sizeof(real));
    memcpy(s.p, st->p, (size_t)st->n*sizeof(real));
    assert_ok(gvi_velocity(st, s.v));
    assert_ok(gvi_energy(st, &s.energy));
    if (s.h != 0) {                                            /* there was a step */
        assert_ok(gvi_action(st, &s.action));
        assert_ok(gvi_state_at(st, s.t - s.h/3, s.inside, s.inside + N_MAX, s.inside + 2*N_MAX));
        for (int k = 0; k < CURVE_POINTS; ++k)
            assert_ok(gvi_curve(st, (real)k/(CURVE_POINTS - 1), s.curve[k], s.curve[k] + N_MAX));
    }
    st->fault = was.fault;
    st->status = was.status;
    harm = harms[0], mass_harm = harms[1], value_harm = harms[2];
    return s;
}

static void assert_same(const snapshot *a, const snapshot *b) { assert_memory_equal(a, b, sizeof *a); }

static void expect_snapshot(gvi_stepper *st, const snapshot *before)
{
    const snapshot after = take(st);
    assert_same(before, &after);
}

/* UNTOUCHED(st) { ... }: after it every answer is what it was before */
#define UNTOUCHED(st) \
    for (snapshot was_ = take(st), *once_ = &was_; once_; expect_snapshot(st, once_), once_ = NULL)

TEST(a_description_of_zeros_is_filled_in)
{
    gvi_desc desc = { .n = 2, .effects = chain_only, .effect_count = 1 };
    gvi_stepper st = new_stepper(&desc);
    assert_int_equal(st.n, 2);
    assert_int_equal(st.s, 8);
    assert_int_equal(st.r, 8);
    assert_int_equal(st.order, 16);
    assert_int_equal(st.formulation, GVI_POSITIONS);
    assert_int_equal(st.status, GVI_OK);
    assert_true(st.h == 0);
    assert_int_equal(st.counters.steps, 0);
    desc.degree = 3;
    desc.rule.kind = GVI_LOBATTO;
    st = new_stepper(&desc);
    assert_int_equal(st.r, 4);
    assert_int_equal(st.order, 6);
}

TEST(the_scene_chooses_the_formulation)
{
    static const struct { scene a; gvi_formulation wanted; } cases[] = {
        { { GVI_AUTO, GVI_MASS_UNIT,     POT,        2, 1, GVI_LOBATTO, 2 }, GVI_EXPLICIT },
        { { GVI_AUTO, GVI_MASS_UNIT,     POT,        2, 1, GVI_GAUSS,   1 }, GVI_POSITIONS },
        { { GVI_AUTO, GVI_MASS_DENSE,    POT,        2, 4, GVI_GAUSS,   6 }, GVI_POSITIONS },
        { { GVI_AUTO, GVI_MASS_UNIT,     POT | DRAG, 2, 1, GVI_LOBATTO, 2 }, GVI_VELOCITIES },
        { { GVI_AUTO, GVI_MASS_DIAGONAL, POT | COUP, 2, 4, GVI_GAUSS,   4 }, GVI_MOMENTA },
        { { GVI_AUTO, GVI_MASS_DIAGONAL, POT | COUP, 2, 4, GVI_GAUSS,   5 }, GVI_NEWTON },
        { { GVI_AUTO, GVI_MASS_POSITION, POT | DRAG, 2, 4, GVI_GAUSS,   4 }, GVI_MOMENTA },
        { { GVI_AUTO, GVI_MASS_POSITION, POT,        2, 4, GVI_GAUSS,   5 }, GVI_NEWTON },
        { { GVI_AUTO, GVI_MASS_NONE,     POT | KIN,  2, 4, GVI_GAUSS,   4 }, GVI_NEWTON },
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        bench b = start(&cases[k].a);
        assert_int_equal(b.st.formulation, cases[k].wanted);
        assert_true(strlen(gvi_formulation_text(&b.st)) > 0);
        steps(&b.st, 1, 0.05);
        assert_int_equal(b.st.formulation, cases[k].wanted);
        tear_down(&b);
    }
}

TEST(every_status_has_a_sentence_of_its_own)
{
    for (int a = GVI_OK; a >= GVI_E_CONJUGATE; --a) {
        assert_true(strlen(gvi_status_text((gvi_status)a)) > 1);
        for (int b = GVI_OK; b > a; --b)
            assert_string_not_equal(gvi_status_text((gvi_status)a), gvi_status_text((gvi_status)b));
    }
    assert_non_null(gvi_status_text((gvi_status)-99));
    assert_non_null(gvi_status_text((gvi_status)99));
}

/* Everything the interface has, in an order that a user might have */
static void use_everything(bench *b)
{
    gvi_stepper *st = &b->st, saved;
    real *copy = malloc(b->g.size), q1[N_MAX], number, v[8][N_MAX];
    const gvi_discrete out = { &number, v[0], v[1], v[2], v[3], v[4], v[5], NULL, NULL };
    gvi_status discrete;

    assert_ok(gvi_start(st, 0, q_start, v_start));
    steps(st, 2, 0.02);
    memcpy(copy, b->g.memory, b->g.size);
    saved = *st;
    steps(st, 1, 0.01);
    assert_ok(gvi_restore(st, &saved, copy));
    steps(st, 1, -0.03);
    take(st);
    for (int i = 0; i < st->n; ++i) q1[i] = st->q[i] + (real)0.02*v_start[i];
    discrete = gvi_discrete_lagrangian(st, 0, 0.02, st->q, q1, &out);
    assert_true(discrete == GVI_OK || discrete == GVI_E_FORMULATION);
    discrete = gvi_start_configurations(st, 0, 0.02, q_start, q1);
    assert_true(discrete == GVI_OK || discrete == GVI_E_FORMULATION || discrete == GVI_E_CONVERGENCE);
    assert_ok(gvi_switch(st, b->desc.effect_count - 1, 0));
    assert_ok(gvi_start(st, 0, q_start, v_start));
    steps(st, 1, 0.02);
    free(copy);
}

/* gvi_size is exact, a byte less is refused, and GVI_LENGTH is enough.  What a pinned formulation does
   not cover is refused and returns 0; AUTO covers everything. */
static int expect_memory_to_be_exact(const scene *a)
{
    gvi_desc desc = describe(a);
    size_t size = gvi_size(&desc), enough = (size_t)GVI_LENGTH(a->n, a->s, a->r)*sizeof(real);
    gvi_stepper st;
    guarded g = guard(size);
    if (size == 0) {
        assert_true(a->formulation != GVI_AUTO);
        assert_status(gvi_init(&st, &desc, g.memory, 1000000), GVI_E_FORMULATION);
    } else {
        assert_int_equal(size % sizeof(real), 0);
        assert_status(gvi_init(&st, &desc, g.memory, size - 1), GVI_E_MEMORY);
        assert_status(gvi_init(&st, &desc, (real *)(void *)((char *)g.memory + 1), size), GVI_E_ARGUMENT);
        assert_ok(gvi_init(&st, &desc, g.memory, size));
    }
    if (size > enough)
        fail_msg("GVI_LENGTH(%d, %d, %d): %lu bytes, %lu needed: formulation %d, mass %d, effects %d", a->n, a->s,
                 a->r, (unsigned long)enough, (unsigned long)size, (int)a->formulation, (int)a->mass, a->has);
    release(&g);
    return size > 0;
}

TEST(the_size_is_exact_and_gvi_length_enough)
{
    static const int degrees[] = { 1, 2, 4, 5, 8 }, effect_sets[] = { POT, POT | COUP, POT | DRAG, POT | COUP | DRAG };
    static const int sizes[] = { 1, 2, 3, 5 };
    int scenes_used = 0;
    for (int f = GVI_AUTO; f <= GVI_NEWTON; ++f)
    for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_NONE; ++mass)
    for (int e = 0; e < COUNT(effect_sets); ++e)
    for (int n = 0; n < COUNT(sizes); ++n)
    for (int k = 0; k < COUNT(degrees); ++k)
    for (int extra = 0; extra <= 3; ++extra)
    for (int rule = GVI_GAUSS; rule <= GVI_LOBATTO; ++rule) {
        int s = degrees[k], r = s + extra;
        scene a = { (gvi_formulation)f, (gvi_mass_kind)mass, effect_sets[e], sizes[n], s, (gvi_rule_kind)rule, r };
        if (mass == GVI_MASS_NONE) a.has |= KIN;
        if (rule == GVI_LOBATTO && r < 2) continue;
        scenes_used += expect_memory_to_be_exact(&a);
    }
    assert_true(scenes_used > 2000);
}

TEST(gvi_length_is_a_constant_and_enough_for_large_scenes_too)
{
    static const int large[][3] = { { 6, 16, 16 }, { 6, 16, 19 }, { 1, 64, 64 }, { 1, 64, 128 }, { 6, 3, 40 } };
    static real array[GVI_LENGTH(2, 8, 8)];
    assert_true(sizeof array > sizeof(real));
    for (int k = 0; k < COUNT(large); ++k)
        for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_NONE; ++mass) {
            scene a = { GVI_AUTO, (gvi_mass_kind)mass, POT | COUP | DRAG | (mass == GVI_MASS_NONE ? KIN : 0),
                        large[k][0], large[k][1], GVI_GAUSS, large[k][2] };
            expect_memory_to_be_exact(&a);
        }
}

TEST(nothing_outside_the_memory_is_touched)
{
    for (int k = 0; k < COUNT(scenes); ++k)
        for (int n = 1; n <= 5; ++n) {
            scene a = scenes[k];
            a.n = n;
            bench b = set_up(&a);
            use_everything(&b);
            tear_down(&b);
        }
}

#define REFUSED(call) assert_status(call, GVI_E_ARGUMENT)

TEST(null_pointers_are_refused)
{
    bench b = start(&scenes[1]);
    gvi_stepper st;
    real x[N_MAX] = { 0 };
    assert_int_equal(gvi_size(NULL), 0);
    REFUSED(gvi_init(NULL, &b.desc, b.g.memory, b.g.size));
    REFUSED(gvi_init(&st, NULL, b.g.memory, b.g.size));
    REFUSED(gvi_init(&st, &b.desc, NULL, b.g.size));
    for (int k = 0; k < 2; ++k) {
        const real *one = k ? x : NULL, *two = k ? NULL : x;
        REFUSED(gvi_start(&b.st, 0, one, two));
        REFUSED(gvi_start_momentum(&b.st, 0, one, two));
        REFUSED(gvi_start_configurations(&b.st, 0, 1, one, two));
    }
    REFUSED(gvi_velocity(&b.st, NULL));
    REFUSED(gvi_energy(&b.st, NULL));
    assert_ok(gvi_step(&b.st, 0.01));
    REFUSED(gvi_action(&b.st, NULL));
    REFUSED(gvi_discrete_lagrangian(&b.st, 0, 1, x, x, NULL));
    REFUSED(gvi_step(NULL, 0.1));
    REFUSED(gvi_restore(&b.st, NULL, b.g.memory));
    REFUSED(gvi_discrete_lagrangian(&b.st, 0, 1, NULL, x, &(gvi_discrete){ .p0 = x }));
    REFUSED(gvi_discrete_lagrangian(&b.st, 0, 1, x, NULL, &(gvi_discrete){ .p0 = x }));
    REFUSED(gvi_discrete_lagrangian(NULL, 0, 1, x, x, &(gvi_discrete){ .p0 = x }));
    REFUSED(gvi_velocity(NULL, x));
    REFUSED(gvi_energy(NULL, x));
    REFUSED(gvi_action(NULL, x));
    REFUSED(gvi_multipliers(NULL, x));
    REFUSED(gvi_switch(NULL, 0, 0));
    REFUSED(gvi_restore(NULL, &b.st, b.g.memory));
    REFUSED(gvi_restore(&b.st, &b.st, NULL));
    tear_down(&b);
}

TEST(numbers_that_are_none_are_refused_and_change_nothing)
{
    static const real wrong[] = { (real)NAN, (real)INFINITY, -(real)INFINITY };
    bench b = start(&scenes[5]);
    real bad[N_MAX] = { 0 }, p[N_MAX];
    assert_ok(gvi_step(&b.st, 0.1));
    UNTOUCHED(&b.st) {
        REFUSED(gvi_step(&b.st, 0));
        REFUSED(gvi_start_configurations(&b.st, 0, 0, q_start, v_start));
        for (int k = 0; k < COUNT(wrong); ++k) {
            bad[1] = wrong[k];
            REFUSED(gvi_step(&b.st, wrong[k]));
            assert_int_equal(b.st.status, GVI_E_ARGUMENT);
            REFUSED(gvi_start(&b.st, wrong[k], q_start, v_start));
            REFUSED(gvi_start(&b.st, 0, bad, v_start));
            REFUSED(gvi_start(&b.st, 0, q_start, bad));
            REFUSED(gvi_start_momentum(&b.st, 0, q_start, bad));
            REFUSED(gvi_start_configurations(&b.st, 0, 0.1, q_start, bad));
            REFUSED(gvi_start_configurations(&b.st, 0, wrong[k], q_start, q_start));
            REFUSED(gvi_discrete_lagrangian(&b.st, wrong[k], 0.1, q_start, q_start, &(gvi_discrete){ .p0 = p }));
            REFUSED(gvi_discrete_lagrangian(&b.st, 0, 0.1, bad, q_start, &(gvi_discrete){ .p0 = p }));
            REFUSED(gvi_discrete_lagrangian(&b.st, 0, 0.1, q_start, q_start, &(gvi_discrete){ .p0 = p, .guess = bad }));
            assert_true(gvi_curve(&b.st, wrong[k], bad, NULL) != GVI_OK);
            assert_true(gvi_state_at(&b.st, wrong[k], bad, NULL, NULL) != GVI_OK);
        }
    }
    tear_down(&b);
}

/* Without a start and outside of the step: test_why.c, test_domains.c */
TEST(questions_beyond_the_step_are_refused)
{
    bench b = start(&scenes[1]);
    real x[N_MAX], number;
    assert_status(gvi_action(&b.st, &number), GVI_E_STATE);
    assert_ok(gvi_step(&b.st, 0.1));
    assert_true(gvi_curve(&b.st, -0.01, x, NULL) != GVI_OK);
    assert_true(gvi_curve(&b.st, 1.01, x, NULL) != GVI_OK);
    assert_ok(gvi_start(&b.st, 0, q_start, v_start));          /* a new start forgets the step */
    assert_status(gvi_curve(&b.st, 0.5, x, NULL), GVI_E_STATE);
    tear_down(&b);
}

TEST(rules_that_cannot_work_are_refused)
{
    static const struct { int s; real c[3], b[3]; gvi_status wanted; } rules[] = {
        { 2, { 0, 0.5, 1 },           { 1/(real)6, 4/(real)6, 1/(real)6 }, GVI_OK },
        { 2, { -0.001, 0.5, 1 },      { 1/(real)6, 4/(real)6, 1/(real)6 }, GVI_E_NODES },
        { 2, { 0, 0.5, 1.001 },       { 1/(real)6, 4/(real)6, 1/(real)6 }, GVI_E_NODES },
        { 2, { 0, 0.5, 0.5 },         { 1/(real)6, 4/(real)6, 1/(real)6 }, GVI_E_NODES },
        { 2, { 0, (real)NAN, 1 },     { 1/(real)6, 4/(real)6, 1/(real)6 }, GVI_E_NODES },
        { 2, { 0, 0.5, 1 },           { 0.2, 0.5, 0.2 },                   GVI_E_ORDER },
        { 2, { 0, 0.5, 1 },           { 0, 0, 0 },                         GVI_E_ORDER },
        { 4, { 0, 0.5, 1 },           { 1/(real)6, 4/(real)6, 1/(real)6 }, GVI_E_POINTS },  /* r < s */
        { 1, { 0, 0.5, 1 },           { 0.5, 0, 0.5 },                     GVI_OK },
        { 3, { 0, 0.5, 1 },           { 0.5, 0, 0.5 },                     GVI_E_ORDER },   /* u = 2 < s */
        /* Gauss 2 with a point of no weight: of order 4, but for three modes it is blind */
        { 3, { 0.21132486540518711775, 0.5, 0.78867513459481288225 }, { 0.5, 0, 0.5 }, GVI_E_POINTS },
        /* the same with next to none: it would leave half of the digits of the third mode */
        { 3, { 0.21132486539075336, 0.5, 0.78867513460924664 }, { 0.49999999995, 1e-10, 0.49999999995 }, GVI_E_POINTS },
        { 2, { 0.21132486540518711775, 0.5, 0.78867513459481288225 }, { 0.5, 0, 0.5 }, GVI_OK },
    };
    for (int k = 0; k < COUNT(rules); ++k) {
        const gvi_desc desc = { .n = 2, .degree = rules[k].s, .rule = { GVI_OWN, 3, rules[k].c, rules[k].b },
                                .effects = chain_only, .effect_count = 1 };
        gvi_status got = init(&desc);
        assert_status(got, rules[k].wanted);
        if (got == GVI_E_NODES || got == GVI_E_ORDER || 3 < rules[k].s) assert_int_equal(gvi_size(&desc), 0);
    }
}

/* The caller's own copy of a built-in rule is the built-in rule */
TEST(own_nodes_may_come_in_any_order)
{
    const scene a = { GVI_AUTO, GVI_MASS_POSITION, POT | DRAG, 2, 3, GVI_GAUSS, 3 };
    gvi_desc desc = describe(&a);
    real c[6], b[6], q[2][N_MAX];
    assert_ok(gvi_gauss(3, c, b));
    memcpy(c + 3, c, 3*sizeof(real));
    memcpy(b + 3, b, 3*sizeof(real));
    for (int way = 0; way < 2; ++way) {
        desc.rule = (gvi_rule){ GVI_OWN, 3, c + 2*way, b + 2*way };
        bench z = start_as(&desc, q_start, v_start);
        steps(&z.st, 10, 0.1);
        assert_int_equal(z.st.order, 6);
        memcpy(q[way], z.st.q, 2*sizeof(real));
        tear_down(&z);
    }
    for (int i = 0; i < 2; ++i) assert_close(q[0][i], q[1][i], 16*EPS);
}

TEST(the_boundary_value_problem_needs_newtons_memory)
{
    static const scene line = { GVI_POSITIONS, GVI_MASS_UNIT, POT, 2, 1, GVI_GAUSS, 1 };       /* nothing to solve */
    bench b = start(&scenes[1]), easy = start(&line);
    const gvi_discrete out = { .lagrangian = &(real){ 0 } };
    assert_status(gvi_discrete_lagrangian(&b.st, 0, 0.1, q_start, v_start, &out), GVI_E_FORMULATION);
    assert_status(gvi_start_configurations(&b.st, 0, 0.1, q_start, v_start), GVI_E_FORMULATION);
    assert_ok(gvi_discrete_lagrangian(&easy.st, 0, 0.1, q_start, v_start, &out));
    tear_down(&b);
    tear_down(&easy);
}

AT_EACH(stiff_springs) { x->f[a] -= (a < x->stride ? 10000 : 1)*x->q[a]; }

static const gvi_effect stiff[] = { { .kind = GVI_POTENTIAL, .points = stiff_springs } };

static gvi_stepper start_stiff(gvi_desc more)
{
    more.n = 2;
    more.effects = stiff;
    more.effect_count = 1;
    return new_motion(&more, 0, (const real[]){ 0.01, 1 }, (const real[]){ 1, 0 });
}

/* h omega = 50.  Gauss keeps quadratic invariants, stiff or not. */
TEST(auto_goes_over_to_newton_on_a_stiff_scene_and_says_so)
{
    char before[200] = "";
    gvi_stepper st = start_stiff((gvi_desc){ .degree = 4 });
    strncpy(before, gvi_formulation_text(&st), sizeof before - 1);
    assert_int_equal(st.formulation, GVI_POSITIONS);
    for (int k = 0; k < 50; ++k) {
        assert_ok(gvi_step(&st, 0.5));
        assert_int_equal(st.formulation, GVI_NEWTON);
        assert_close(st.p[0]*st.p[0] + 10000*st.q[0]*st.q[0], 2, 2000*EPS);
        assert_close(st.p[1]*st.p[1] + st.q[1]*st.q[1], 1, 30*EPS);
    }
    assert_string_not_equal(before, gvi_formulation_text(&st));
    assert_true(st.counters.factorizations > 0);
    assert_true(st.counters.newton_iterations > 0);
}

/* A fixed point that is pinned, one of a given number of iterations, one of too few */
TEST(iterations_that_do_not_converge_are_a_failure_and_leave_everything_alone)
{
    static const struct { gvi_desc desc; real h; } cases[] = {
        { { .degree = 4, .formulation = GVI_POSITIONS }, 0.5 },
        { { .iterations = 5 }, 0.5 },
        { { .degree = 4, .formulation = GVI_POSITIONS, .max_iterations = 3 }, 0.01 },
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        gvi_stepper st = start_stiff(cases[k].desc);
        assert_status(gvi_step(&st, cases[k].h), GVI_E_CONVERGENCE);
        assert_int_equal(st.formulation, GVI_POSITIONS);
        assert_int_equal(st.counters.failures, 1);
        assert_int_equal(st.counters.steps, 0);
        assert_true(st.t == 0 && st.h == 0 && st.q[0] == (real)0.01 && st.p[0] == 1);
        if (k == 2) assert_true(st.counters.iterations <= 3);
        else assert_ok(gvi_step(&st, 0.005));                /* a shorter one */
    }
    const gvi_desc newton = { .n = 2, .effects = stiff, .effect_count = 1, .iterations = 5, .formulation = GVI_NEWTON };
    assert_status(init(&newton), GVI_E_FORMULATION);           /* it has no fixed point */
}

/* Up to h omega = 4 the fixed point of degree 8 contracts: a tolerance of 1e-14 is
   reached in 17 iterations.  Then the end at rounding must be seen too, at every
   phase: also where q begins and ends the step near zero, and is large inside.
   Roundings of a few EPS h a step, independent, 300 steps. */
TEST(a_fixed_point_that_contracts_is_never_called_divergent)
{
    const gvi_desc desc = { .n = 1, .effects = spring_only, .effect_count = 1, .formulation = GVI_POSITIONS };
    for (int k = 1; k <= 10; ++k) {
        gvi_stepper st = new_motion(&desc, 0, (const real[]){ 1 }, (const real[]){ 0 });
        int failures = 0;
        for (int j = 0; j < 300; ++j) failures += gvi_step(&st, (real)0.4*(real)k) != GVI_OK;
        assert_int_equal(failures, 0);
        assert_close(st.q[0]*st.q[0] + st.p[0]*st.p[0], 1, 600*EPS);
    }
}

/* Mass 1 and L = a v^2/2 beside it: q = cos(t) for a spring of 1 + a.  V = (P - a V)/1 is
   found by iterations that contract like a, at any h */
static real more_mass;

AT_EACH(added_mass) { x->dldv[a] += more_mass*x->v[a]; }
AT_EACH(strong_spring) { x->f[a] -= (1 + more_mass)*x->q[a]; }

static gvi_stepper start_heavy(int degree, int formulation, real v)
{
    static const gvi_effect added[] = { { .kind = GVI_LAGRANGIAN, .points = added_mass },
                                        { .kind = GVI_POTENTIAL, .points = strong_spring } };
    const gvi_desc desc = { .n = 1, .degree = degree, .effects = added, .effect_count = 2,
                            .formulation = (gvi_formulation)formulation };
    return new_motion(&desc, 0, (const real[]){ 1 }, &v);
}

TEST(short_steps_do_not_hide_velocities_that_diverge)
{
    more_mass = 3;
    for (int f = GVI_MOMENTA; f <= GVI_NEWTON; ++f)
    for (real h = 1e-15; h < 2e-3; h *= 100) {
        gvi_stepper st = start_heavy(2, f, 1);
        const gvi_status got = gvi_step(&st, h);
        if (f == GVI_NEWTON) assert_ok(got);
        if (got == GVI_OK) assert_close(st.q[0], cos(h) + sin(h), 4*EPS);
        else assert_status(got, GVI_E_CONVERGENCE);
    }
}

TEST(short_steps_do_not_leave_velocities_half_way)
{
    static const real share[] = { 1.25, 0.75, 1 };
    for (int f = GVI_MOMENTA; f <= GVI_NEWTON; ++f)            /* the increment, with its low word */
        for (int k = 0; k < 16; ++k) {
            const long double h = powl(10, -k - 2), moved = sinl(h) - 2*sinl(h/2)*sinl(h/2);
            more_mass = k % 2 ? 0.5 : -0.5;
            gvi_stepper st = start_heavy(2, f, 1);
            assert_ok(gvi_step(&st, (real)h));
            assert_close(((long double)st.q[0] - 1 + st.q_low[0])/moved, 1, 16*EPS + powl(h, 4));
        }
    more_mass = 0.5;
    for (int f = GVI_MOMENTA; f <= GVI_NEWTON; ++f) {
        gvi_stepper st = start_heavy(3, f, 0);
        for (int k = 0; k < 30000; ++k) assert_ok(gvi_step(&st, 1e-5*share[k % 3]));
        assert_close(st.q[0], cos(st.t), 4*EPS);
    }
}

/* A spring, and a mass matrix that is 1: whatever the rule, what is extrapolated from two
   steps of 0.1 on |q| <= 1.1 lies within 2 of the origin.  Two steps of two points, ends
   among them, are three points: a polynomial that four would determine is rounding. */
static real farthest;

AT_POINTS(spring_that_looks)
{
    FOR_EACH(x, a) if (!(fabs(x->q[a]) <= farthest)) farthest = fabs(x->q[a]);
    return spring(x, user);
}

AT_EACH(unit_mass) { x->mass[a] = 1; }

TEST(an_iteration_starts_near_the_motion_with_every_rule)
{
    static const real ends[] = { 0, 1 }, halves[] = { 0.5, 0.5 };
    static const real near[] = { 0, 16*EPS, 1 }, few[] = { 0.25, 0.25, 0.5 };
    static const gvi_effect looking[] = { { .kind = GVI_POTENTIAL, .points = spring_that_looks } };
    const gvi_rule own[] = { { GVI_OWN, 2, ends, halves }, { GVI_OWN, 3, near, few } };
    for (int k = 0; k < 2 + 2*11; ++k) {
        const int r = 2 + (k - 2)/2;
        gvi_rule rule = { k % 2 ? GVI_LOBATTO : GVI_GAUSS, r, NULL, NULL };
        gvi_desc desc = { .n = 1, .degree = k < 2 ? 2 : r, .rule = k < 2 ? own[k] : rule, .effects = looking,
                          .effect_count = 1, .mass = { .kind = GVI_MASS_POSITION, .points = unit_mass,
                          .gradient = nothing } };
        gvi_stepper st = new_motion(&desc, 0, (const real[]){ 1 }, (const real[]){ 0.3 });
        farthest = 0;
        steps(&st, 20, 0.1);
        assert_true(farthest < 2);
    }
}

/* 20 steps of N iterations on q'' = -q, each with N evaluations at all points.
   Returns the largest error against cos, sin. */
static real run_given(int N, gvi_formulation formulation, size_t *size)
{
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = spring_only, .effect_count = 1,
                            .formulation = formulation, .iterations = N };
    gvi_stepper st = new_motion(&desc, 0, (const real[]){ 1 }, (const real[]){ 0 });
    real worst = 0;
    *size = gvi_size(&desc);
    for (int k = 1; k <= 20; ++k) {
        assert_ok(gvi_step(&st, 0.125));
        assert_int_equal(st.iterations, N);
        assert_int_equal(st.counters.effect[0], (unsigned long long)(4*N*k));
        worst = fmax(worst, fabs(st.q[0] - cos(st.t)) + fabs(st.p[0] + sin(st.t)));
    }
    assert_int_equal(st.counters.newton_iterations, 0);
    return worst;
}

/* An iteration of (3) changes Q by no more than h^2/2 of what the one before did:
   what is left after N falls by that or better, until it is rounding. */
TEST(a_given_number_of_iterations_is_made)
{
    size_t size, pinned;
    for (int N = 1; N < 12; ++N) {
        const real first = run_given(N, GVI_AUTO, &size), next_one = run_given(N + 1, GVI_POSITIONS, &pinned);
        assert_true(next_one <= first/50 + 100*EPS);
        assert_int_equal(size, pinned);                       /* no memory for Newton */
        if (N == 1) assert_true(first > 1e-6);                /* one is not enough */
    }
    assert_true(run_given(12, GVI_AUTO, &size) < 100*EPS);
}

/* q'' = -q by the midpoint rule, which iterates Q := q + h p/2 - (h^2/4) Q: every change is h^2/4 of the one before,
   the first that of Q itself */
TEST(counters_tell_the_worst_of_all_steps)
{
    for (int N = 0; N < 5; ++N) {
        const gvi_desc desc = { .n = 1, .degree = 1, .effects = spring_only, .effect_count = 1, .iterations = N };
        const real hs[] = { 0.25, 0.5, 0.125 };
        int most = 0;
        gvi_stepper st = new_stepper(&desc);
        for (int k = 0; k < 3; ++k) {
            assert_ok(gvi_start(&st, 0, (const real[]){ 1 }, (const real[]){ 0.25 }));
            assert_ok(gvi_step(&st, hs[k]));
            if (st.iterations > most) most = st.iterations;
            const real ratio = (real)(k ? 0.0625L : 0.015625L), left = pow(ratio, N);
            assert_int_equal(st.counters.most_iterations, most);
            assert_close(st.counters.worst_contraction, N == 0 || N > 2 ? ratio : 0, ratio*1e-6);
            if (N) assert_between(0.9*left, st.counters.worst_change, 1.1*left);
            else assert_between(0, st.counters.worst_change, EPS);
        }
        assert_true(N > 0 || most > st.iterations);
    }
}

TEST(a_massless_coordinate_is_named)
{
    static const struct { gvi_mass_kind kind; real matrix[9]; int lowest, highest; } cases[] = {
        { GVI_MASS_DIAGONAL, { 1, 0, 2 }, 1, 1 },
        { GVI_MASS_DENSE, { 1, 0, 0, 0, 1, 0, 0, 0, 0 }, 2, 2 },
        { GVI_MASS_DENSE, { 1, 1, 0, 1, 1, 0, 0, 0, 1 }, 0, 1 },     /* x1 - x2 has none: either may be named */
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        const gvi_desc desc = { .n = 3, .degree = 3, .effects = chain_only, .effect_count = 1,
                                .mass = { .kind = cases[k].kind, .matrix = cases[k].matrix } };
        assert_status(init(&desc), GVI_E_SINGULAR);
        assert_between(cases[k].lowest, refused.fault.coordinate, cases[k].highest);
    }
}

/* diag(1, 0, 1) by callback */
AT_EACH(mass_with_a_hole)
{
    
    for (int j = 0, i = a/x->stride; j <= i; ++j) x->mass[(i*(x->n - 1) + j)*x->stride + a] = i == j && i != 1;
}

TEST(a_singular_mass_matrix_in_a_step_is_named_and_changes_nothing)
{
    for (int newton = 0; newton <= 1; ++newton) {
        scene a = { newton ? GVI_NEWTON : GVI_MOMENTA, GVI_MASS_POSITION, POT, 3, 3, GVI_GAUSS, 3 };
        gvi_desc desc = describe(&a);
        desc.mass.points = mass_with_a_hole;
        desc.mass.gradient = nothing;
        gvi_stepper st = new_motion(&desc, 0, q_start, v_start);               /* p = M v needs no inverse */
        assert_status(gvi_step(&st, 0.1), GVI_E_SINGULAR);
        assert_int_equal(st.fault.coordinate, 1);
        assert_true(st.t == 0 && st.q[1] == q_start[1] && st.p[0] == v_start[0] && st.p[1] == 0);
        if (gvi_start_momentum(&st, 5, v_start, q_start) == GVI_OK) (void)gvi_step(&st, 0.1);
        assert_int_equal(st.status, GVI_E_SINGULAR);
        assert_int_equal(st.fault.coordinate, 1);
    }
}

/* Kinetic energy for the first coordinate only */
GVI_EACH(half_kinetic, 1, v, dldv) { x->dldv[0] += x->v[0]; }

TEST(a_lagrangian_without_kinetic_energy_for_a_coordinate_is_named)
{
    static const gvi_effect some[] = { { .kind = GVI_LAGRANGIAN, .points = half_kinetic } };
    const gvi_desc desc = { .n = 2, .degree = 3, .effects = some, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_NONE } };
    gvi_stepper st = new_stepper(&desc);
    real v[2];
    if (gvi_start_momentum(&st, 0, q_start, (const real[]){ 1, 0 }) == GVI_OK)
        assert_status(gvi_step(&st, 0.1), GVI_E_SINGULAR);
    assert_int_equal(st.status, GVI_E_SINGULAR);
    assert_int_equal(st.fault.coordinate, 1);
    assert_true(gvi_velocity(&st, v) != GVI_OK);
}

/* A step that fails, with all that it may not change */
static void expect_failure(bench *b, real h, gvi_status wanted, gvi_status or_this)
{
    UNTOUCHED(&b->st) {
        const gvi_counters before = b->st.counters;
        gvi_status got = gvi_step(&b->st, h);
        assert_true(got == wanted || got == or_this);
        assert_int_equal(b->st.status, got);
        assert_int_equal(b->st.counters.failures, before.failures + 1);
        assert_int_equal(b->st.counters.steps, before.steps);
    }
    harm = mass_harm = NO_HARM;
}

/* Fails, is healed, goes on; a twin without the failure ends at the same state */
static void expect_recovery(const scene *a, harm_kind what, gvi_status wanted)
{
    bench b = start(a), twin;
    steps(&b.st, 3, h_good);
    harm = what;
    expect_failure(&b, h_good, wanted, wanted);
    assert_int_equal(b.st.fault.effect, b.desc.effect_count - 1);
    if (wanted == GVI_E_NON_FINITE) {
        assert_int_equal(b.st.fault.coordinate, a->n - 1);
        assert_int_equal(b.st.fault.point, b.st.r > 2 ? 2 : 0);
    }
    steps(&b.st, 3, h_good);
    twin = start(a);
    steps(&twin.st, 6, h_good);
    for (int i = 0; i < a->n; ++i) {
        assert_close(b.st.q[i], twin.st.q[i], 16*EPS);
        assert_close(b.st.p[i], twin.st.p[i], 32*EPS);
    }
    assert_true(b.st.t == twin.st.t);
    tear_down(&b);
    tear_down(&twin);
}

static const gvi_status harm_status[] = { GVI_OK, GVI_E_CALLBACK, GVI_E_NON_FINITE, GVI_E_NON_FINITE };

TEST(refusals_nan_and_inf_are_traced_to_effect_coordinate_and_point)
{
    for (int k = 0; k < COUNT(scenes); ++k)
        for (int what = REFUSE; what <= GIVE_INF; ++what)
            expect_recovery(&scenes[k], (harm_kind)what, harm_status[what]);
}

/* Further than a fixed point can follow; its divergence, which overflows, must not
   pass for convergence.  (An effect may be the first to overflow, v^2 say.)  Not
   EXPLICIT, which does not iterate. */
TEST(a_step_that_is_too_large_leaves_everything_and_a_smaller_one_works)
{
    for (int k = 1; k < COUNT(scenes); ++k) {
        if (scenes[k].formulation == GVI_AUTO || scenes[k].formulation == GVI_NEWTON) continue;
        for (real h = 10; h < 2e9; h *= 10) {
            bench b = start(&scenes[k]);
            assert_ok(gvi_step(&b.st, h_good));
            expect_failure(&b, h, GVI_E_CONVERGENCE, GVI_E_NON_FINITE);
            if (b.st.status == GVI_E_NON_FINITE) assert_int_not_equal(b.st.fault.effect, GVI_FAULT_NONE);
            assert_ok(gvi_step(&b.st, h_good));
            tear_down(&b);
        }
    }
}

TEST(a_start_that_fails_leaves_the_state)
{
    bench b = start(&scenes[7]);
    assert_ok(gvi_step(&b.st, h_good));
    UNTOUCHED(&b.st) {
        mass_harm = REFUSE;
        assert_status(gvi_start(&b.st, 5, v_start, v_start), GVI_E_CALLBACK);
        assert_int_equal(b.st.fault.effect, GVI_FAULT_MASS);
        harm = REFUSE;
        mass_harm = NO_HARM;
        assert_status(gvi_start_configurations(&b.st, 5, 0.1, v_start, v_start), GVI_E_CALLBACK);
    }
    tear_down(&b);
}

TEST(a_query_that_fails_leaves_the_state)
{
    for (int k = 0; k < COUNT(scenes); ++k) {
        bench b = start(&scenes[k]);
        const int last = b.desc.effect_count - 1;
        real x[3*N_MAX], number;
        assert_ok(gvi_step(&b.st, h_good));
        UNTOUCHED(&b.st)
            for (int what = REFUSE; what <= GIVE_INF; ++what) {
                harm = (harm_kind)what;
                assert_status(gvi_state_at(&b.st, b.st.t - h_good/3, x, x + N_MAX, x + 2*N_MAX), harm_status[what]);
                assert_int_equal(b.st.fault.effect, last);
                harm = NO_HARM;
                value_harm = (harm_kind)what;
                assert_status(gvi_energy(&b.st, &number), harm_status[what]);
                assert_int_equal(b.st.fault.effect, last);
                assert_status(gvi_action(&b.st, &number), harm_status[what]);
                value_harm = NO_HARM;
            }
        assert_ok(gvi_step(&b.st, h_good));
        tear_down(&b);
    }
}

TEST(energy_without_a_value_names_the_effect)
{
    bench b = start(&scenes[4]);
    real number;
    assert_ok(gvi_step(&b.st, h_good));
    effects[1].value = NULL;
    assert_status(gvi_energy(&b.st, &number), GVI_E_VALUE);
    assert_int_equal(b.st.fault.effect, 1);
    assert_status(gvi_action(&b.st, &number), GVI_E_VALUE);
    assert_int_equal(b.st.fault.effect, 1);
    assert_ok(gvi_switch(&b.st, 1, 0));                        /* who is off is not asked */
    assert_ok(gvi_energy(&b.st, &number));
    tear_down(&b);
}

enum { RECORDED = 12 };

/* Steps of two lengths, so that the extrapolation of the guess changes too; compared, or recorded first */
static void record(gvi_stepper *st, real h, snapshot *log, int again)
{
    for (int k = 0; k < RECORDED; ++k) {
        assert_ok(gvi_step(st, k % 4 == 3 ? h/2 : h));
        if (again) expect_snapshot(st, &log[k]);
        else log[k] = take(st);
    }
}

/* In the stepper itself, later; in another one; and what was saved stays whole */
static void expect_exact_restart(bench b, bench other, int steps_before, real h)
{
    static snapshot log[RECORDED];
    steps(&b.st, steps_before, h);
    gvi_stepper saved = b.st;
    real *memory = malloc(b.g.size);
    memcpy(memory, b.g.memory, b.g.size);

    record(&b.st, h, log, 0);
    assert_ok(gvi_restore(&b.st, &saved, memory));
    assert_true(b.st.t == saved.t);
    record(&b.st, h, log, 1);
    assert_ok(gvi_restore(&other.st, &saved, memory));
    tear_down(&b);                                             /* nothing may point there */
    saved = other.st;                                          /* and on, from where it is aligned now */
    memcpy(memory, other.g.memory, other.g.size);
    record(&other.st, h, log, 1);
    assert_ok(gvi_restore(&other.st, &saved, memory));
    record(&other.st, h, log, 1);
    free(memory);
    tear_down(&other);
}

TEST(a_checkpoint_continues_to_the_bit)
{
    for (int k = 0; k < COUNT(scenes); ++k)
        for (int before = 0; before <= 7; before += before ? 6 : 1)
            expect_exact_restart(start(&scenes[k]), set_up(&scenes[k]), before, h_good);
}

/* Other sizes; more or fewer effects, which are not copied; another kind of mass: another scene */
TEST(a_checkpoint_of_another_description_is_refused)
{
    static const scene all[] = {
        { GVI_POSITIONS, GVI_MASS_UNIT, POT,        3, 8, GVI_GAUSS, 8 },
        { GVI_POSITIONS, GVI_MASS_UNIT, POT,        2, 8, GVI_GAUSS, 8 },
        { GVI_POSITIONS, GVI_MASS_UNIT, POT,        3, 7, GVI_GAUSS, 8 },
        { GVI_POSITIONS, GVI_MASS_UNIT, POT,        3, 8, GVI_GAUSS, 9 },
        { GVI_NEWTON,    GVI_MASS_UNIT, POT,        3, 8, GVI_GAUSS, 8 },
        { GVI_NEWTON,    GVI_MASS_UNIT, POT | KIN,  3, 8, GVI_GAUSS, 8 },
        { GVI_NEWTON,    GVI_MASS_UNIT, KIN,        3, 8, GVI_GAUSS, 8 },
        { GVI_NEWTON,    GVI_MASS_NONE, POT | KIN,  3, 8, GVI_GAUSS, 8 },
    };
    for (int i = 0; i < COUNT(all); ++i)
        for (int j = 0; j < COUNT(all); ++j) {
            bench from = start(&all[i]), to;
            steps(&from.st, 1, h_good);
            to = start(&all[j]);
            steps(&to.st, 1, h_good);
            UNTOUCHED(&to.st)
                assert_status(gvi_restore(&to.st, &from.st, from.g.memory), i == j ? GVI_OK : GVI_E_ARGUMENT);
            tear_down(&from);
            tear_down(&to);
        }
}

/* The same effects in another order: the same sizes, and another scene */
AT_POINTS(ticks) { for (int k = 0; k < x->count; ++k) x->value[k] += 1; return 0; }
AT_POINTS(holds) { for (int k = 0; k < x->count; ++k) x->g[k] = x->q[k], x->jacobian[k] = 1; return 0; }

TEST(a_checkpoint_of_another_order_is_refused)
{
    static const gvi_effect special[] = { { .kind = GVI_CLOCK, .points = ticks }, { .kind = GVI_CONSTRAINT, .points = holds, .rows = 1 } };
    static real memory[2][4000];
    for (int k = 0; k < 4; ++k) {
        const gvi_effect force = { .kind = GVI_FORCE, .points = nothing };
        const gvi_effect lists[] = { force, special[k/2], force };
        gvi_stepper st[2];
        for (int i = 0; i < 2; ++i) {
            const gvi_desc desc = { .n = 2, .degree = 3, .effects = lists + (i + k)%2, .effect_count = 2 };
            assert_ok(gvi_init(st + i, &desc, memory[i], sizeof memory[i]));
            assert_ok(gvi_start(st + i, 0, (const real[]){ 0, 1 }, (const real[]){ 0, 1 }));
        }
        REFUSED(gvi_restore(st, st + 1, memory[1]));
    }
}

/* A stepper whose set-up failed last, at its mass, has the sizes of a checkpoint, but no state */
TEST(a_checkpoint_of_a_failed_set_up_is_refused)
{
    static const real one[] = { 1, 1 }, none[] = { 1, 0 };
    gvi_desc desc = { .n = 2, .degree = 3, .effects = spring_only, .effect_count = 1,
                      .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = one } };
    static real memory[2000];
    gvi_stepper st, good = new_motion(&desc, 0, none, none);
    desc.mass.matrix = none;
    assert_status(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_SINGULAR);
    REFUSED(gvi_restore(&good, &st, memory));
    assert_ok(gvi_step(&good, h_good));
}

/* The momentum is the state: switching keeps q and p to the bit */
TEST(switching_keeps_the_state_and_refuses_what_is_not_there)
{
    bench b = start(&scenes[5]);
    assert_ok(gvi_step(&b.st, h_good));
    for (int on = 0; on <= 1; ++on) {
        SAME_STATE(&b.st) {
            REFUSED(gvi_switch(&b.st, -1, 0));
            REFUSED(gvi_switch(&b.st, b.desc.effect_count, 0));
            assert_ok(gvi_switch(&b.st, 1, on));
        }
        assert_ok(gvi_step(&b.st, h_good));
    }
    tear_down(&b);
}

/* Newton's method follows for 64 steps, then the fixed point is tried again: at the same step, whatever was queried */
TEST(queries_leave_the_choice_of_method_alone)
{
    int iterations[80];
    for (int queried = 0; queried < 2; ++queried) {
        gvi_stepper st = start_stiff((gvi_desc){ .degree = 4 });
        for (int k = 0; k < 80; ++k) {
            real q[2];
            assert_ok(gvi_step(&st, 0.5));
            if (!queried) iterations[k] = st.iterations;
            assert_int_equal(st.iterations, iterations[k]);
            if (queried) assert_ok(gvi_state_at(&st, st.t - (real)0.2, q, NULL, NULL));
        }
    }
}

TEST(a_start_has_no_time_left_over)
{
    bench b = start(&scenes[1]);
    steps(&b.st, 3, 0.1);
    assert_true(b.st.t_low != 0);
    assert_ok(gvi_start(&b.st, 1, q_start, v_start));
    assert_true(b.st.t == 1 && b.st.t_low == 0 && b.st.h == 0);
    tear_down(&b);
}

/* Started again it goes as one that has just been started, to the bit: no low word is left over, no curve, no method */
TEST(a_start_leaves_nothing_of_the_last_motion)
{
    for (int k = 0; k < COUNT(scenes); ++k) {
        bench a = start(&scenes[k]), b = start(&scenes[k]);
        steps(&a.st, 7, 0.1);
        assert_ok(gvi_start(&a.st, 0.25, q_start, v_start));
        assert_true(a.st.t0 == 0.25 && a.st.formulation == b.st.formulation);
        move_alike(&a.st, &b.st, 20, h_good);
        tear_down(&a);
        tear_down(&b);
    }
    const real q[] = { 0.01, 1 }, v[] = { 1, 0 };
    gvi_stepper st = start_stiff((gvi_desc){ .degree = 4 });
    assert_ok(gvi_step(&st, 0.5));
    assert_int_equal(st.formulation, GVI_NEWTON);
    assert_ok(gvi_start(&st, 0, q, v));
    assert_int_equal(st.formulation, GVI_POSITIONS);
}

/* q and p in the second half of a step are rounded once: low words of q, p and t are in them */
AT_POINT(pull) { return f[0] += 0.7, 0; }

TEST(a_state_between_is_rounded_once)
{
    static const gvi_effect effect = { .kind = GVI_POTENTIAL, .point = pull };
    static const gvi_desc desc = { .n = 1, .degree = 2, .effects = &effect, .effect_count = 1 };
    const volatile long double one = 1, more = LDBL_EPSILON;
    if (LDBL_MANT_DIG == DIG || one + more <= one) skip();      // valgrind's long double is a double
    gvi_stepper st = new_motion(&desc, 0, (const real[]){ 1 }, (const real[]){ 1.1 });
    for (int k = 0; k < 150; ++k) {
        assert_ok(gvi_step(&st, 0.001));
        for (int i = 1; i < 5; ++i) {
            const real t = st.t - st.h*i/10;
            const long double T = t, f = (real)0.7, v = (real)1.1;
            real q, p;
            assert_ok(gvi_state_at(&st, t, &q, NULL, &p));
            assert_close(q, 1 + T*(v + T*f/2), 0.53L*EPS);
            assert_close(p, v + T*f, 0.53L*EPS);
        }
    }
}

RUN_TESTS(NULL, NULL)
