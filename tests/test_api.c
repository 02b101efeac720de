/* The contract: defaults, memory, every status and what it leaves behind (conjugate
   points: test_queries.c), moved steppers, checkpoints, pinned formulations,
   switched effects.                                                          */
#ifndef GVI_REAL
#define GVI_REAL double
#endif
#include "gvi_test.h"
#include <tgmath.h>

typedef gvi_real real;

/* ------------------------------------------------------------------ scenes

   For any n: a chain of pendulums, a term linear in v, drag; and one effect that
   does nothing until `harm` tells it to misbehave.                            */
enum { N_MAX = 6 };

static int chain(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const real *q = x->q + i*x->stride + k;
            real f = -(real)(1 + i)*sin(*q);
            if (i > 0) f += (q[-x->stride] - *q)/2;
            if (i + 1 < x->n) f += (q[x->stride] - *q)/2;
            x->f[i*x->stride + k] += f;
        }
    return 0;
}

static int chain_value(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const real *q = x->q + i*x->stride + k;
            real d = i > 0 ? q[-x->stride] - *q : 0;
            x->value[k] += d*d/4 - (real)(1 + i)*cos(*q);
        }
    return 0;
}

/* The same, one point a call: q is of length n, known from user */
static int chain_at_a_point(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    int n = *(const int *)user;
    (void)t; (void)v; (void)dldv;
    for (int i = 0; i < n; ++i) {
        f[i] -= (real)(1 + i)*sin(q[i]);
        if (i > 0) f[i] += (q[i - 1] - q[i])/2;
        if (i + 1 < n) f[i] += (q[i + 1] - q[i])/2;
    }
    return 0;
}

static int chain_hessian(real t, const real *q, const real *v, real *fq, real *fv, real *pv, void *user)
{
    int n = *(const int *)user;
    (void)t; (void)v; (void)fv; (void)pv;
    for (int i = 0; i < n; ++i) {
        fq[i*n + i] -= (real)(1 + i)*cos(q[i]);
        if (i > 0) { fq[i*n + i] -= 0.5; fq[i*n + i - 1] += 0.5; }
        if (i + 1 < n) { fq[i*n + i] -= 0.5; fq[i*n + i + 1] += 0.5; }
    }
    return 0;
}

/* L = sum_i q_(i+1) v_i/5 */
static int coupling(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i) {
        int a = i*x->stride, b = (i + 1)%x->n*x->stride;
        for (int k = 0; k < x->count; ++k) {
            x->dldv[a + k] += x->q[b + k]/5;
            x->f[b + k] += x->v[a + k]/5;
        }
    }
    return 0;
}

static int coupling_value(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k)
            x->value[k] += x->q[(i + 1)%x->n*x->stride + k]*x->v[i*x->stride + k]/5;
    return 0;
}

static int drag(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= x->v[i*x->stride + k]/10;
    return 0;
}

/* Kinetic energy as a Lagrangian term: sum v^2/2 + v^4/20 */
static int kinetic(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            real v = x->v[i*x->stride + k];
            x->dldv[i*x->stride + k] += v + v*v*v/5;
        }
    return 0;
}

static int kinetic_value(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            real v2 = x->v[i*x->stride + k]*x->v[i*x->stride + k];
            x->value[k] += v2/2 + v2*v2/20;
        }
    return 0;
}

/* M = diag(2 + cos q_i) + 1/10 everywhere */
static int mass_points(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < x->count; ++k)
                x->mass[(i*x->n + j)*x->stride + k]
                    = (i == j ? 2 + cos(x->q[i*x->stride + k]) : 0) + (real)0.1;
    return 0;
}

static int mass_gradient(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            int a = i*x->stride + k;
            x->f[a] -= sin(x->q[a])*x->v[a]*x->v[a]/2;
        }
    return 0;
}

/* M^-1 p by Sherman and Morrison's formula */
static int mass_velocity(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        real sum = 0, trace = 0;
        for (int i = 0; i < x->n; ++i) {
            real d = 2 + cos(x->q[i*x->stride + k]);
            sum += x->p[i*x->stride + k]/d;
            trace += 1/d;
        }
        sum *= (real)0.1/(1 + (real)0.1*trace);
        for (int i = 0; i < x->n; ++i)
            x->velocity[i*x->stride + k] = (x->p[i*x->stride + k] - sum)/(2 + cos(x->q[i*x->stride + k]));
    }
    return 0;
}

enum harm { NO_HARM, REFUSE, GIVE_NAN, GIVE_INF };
static enum harm harm, mass_harm, value_harm;

/* At coordinate n-1, point 0 or, where there are three, 2 */
static int apply_harm(enum harm what, const gvi_points *x, real *rows, int n)
{
    int k = x->count > 2 ? 2 : 0;
    if (what == REFUSE) return 1;
    if (what == GIVE_NAN) rows[(n - 1)*x->stride + k] = (real)NAN;
    if (what == GIVE_INF) rows[(n - 1)*x->stride + k] = (real)INFINITY;
    return 0;
}

static int troublemaker(const gvi_points *x, void *user)
{
    (void)user;
    return apply_harm(harm, x, x->f, x->n);
}

static int troublesome_value(const gvi_points *x, void *user)
{
    (void)user;
    return apply_harm(value_harm, x, x->value, 1);
}

static int troublesome_mass(const gvi_points *x, void *user)
{
    mass_points(x, user);
    return apply_harm(mass_harm, x, x->mass, x->n*x->n);
}

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
   time: the effects are kept here.                                           */
static gvi_effect effects[8];

static gvi_desc describe(const scene *a)
{
    static real diagonal[N_MAX], dense[N_MAX*N_MAX];
    gvi_desc d = { .n = a->n, .degree = a->s, .rule = { .kind = a->rule, .points = a->r },
                   .mass = { .kind = a->mass }, .effects = effects, .formulation = a->formulation };
    int e = 0;
    for (int i = 0; i < a->n; ++i) {
        diagonal[i] = (real)(1 + i);
        for (int j = 0; j < a->n; ++j) dense[i*a->n + j] = i == j ? 2 : (real)0.25;
    }
    if (a->has & POT) effects[e++] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = chain, .value = chain_value };
    if (a->has & COUP)
        effects[e++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = coupling, .value = coupling_value };
    if (a->has & KIN) effects[e++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = kinetic, .value = kinetic_value };
    if (a->has & DRAG) effects[e++] = (gvi_effect){ .kind = GVI_FORCE, .points = drag };
    effects[e++] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = troublemaker, .value = troublesome_value };
    d.effect_count = e;
    if (a->mass == GVI_MASS_DIAGONAL) d.mass.matrix = diagonal;
    if (a->mass == GVI_MASS_DENSE) d.mass.matrix = dense;
    if (a->mass == GVI_MASS_POSITION) { d.mass.points = troublesome_mass; d.mass.gradient = mass_gradient; }
    harm = mass_harm = value_harm = NO_HARM;
    return d;
}

static const real q_start[N_MAX] = { 0.7, -0.4, 0.3, 1.1, -0.8, 0.2 };
static const real v_start[N_MAX] = { 0.1, 0.5, -0.2, 0.3, 0.4, -0.6 };

/* One of each formulation and mass */
static const scene scenes[] = {
    { GVI_EXPLICIT,   GVI_MASS_UNIT,     POT,               2, 1, GVI_LOBATTO, 2 },
    { GVI_POSITIONS,  GVI_MASS_UNIT,     POT,               3, 8, GVI_GAUSS,   8 },
    { GVI_POSITIONS,  GVI_MASS_DENSE,    POT,               2, 3, GVI_LOBATTO, 4 },
    { GVI_AUTO,       GVI_MASS_DIAGONAL, POT,               3, 4, GVI_GAUSS,   6 },
    { GVI_VELOCITIES, GVI_MASS_DIAGONAL, POT | COUP,        3, 5, GVI_GAUSS,   5 },
    { GVI_AUTO,       GVI_MASS_DENSE,    POT | COUP | DRAG, 2, 4, GVI_GAUSS,   4 },
    { GVI_MOMENTA,    GVI_MASS_POSITION, POT,               3, 4, GVI_GAUSS,   4 },
    { GVI_AUTO,       GVI_MASS_POSITION, POT | COUP | DRAG, 2, 3, GVI_LOBATTO, 3 },
    { GVI_NEWTON,     GVI_MASS_UNIT,     POT | DRAG,        2, 4, GVI_GAUSS,   4 },
    { GVI_AUTO,       GVI_MASS_POSITION, POT | COUP,        2, 3, GVI_GAUSS,   5 },
    { GVI_AUTO,       GVI_MASS_NONE,     POT | KIN,         2, 3, GVI_GAUSS,   3 },
};

/* ------------------------------------------------------------ guarded memory */

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

static int is_whole(const guarded *g)
{
    const unsigned char *before = (const unsigned char *)g->base;
    const unsigned char *after = (const unsigned char *)g->memory + g->size;
    for (size_t k = 0; k < PAD*sizeof(real); ++k)
        if (before[k] != 0xA5 || after[k] != 0xA5) return 0;
    return 1;
}

/* A stepper with memory of exactly the size that was asked for */
typedef struct { gvi_stepper st; guarded g; gvi_desc desc; } bench;

static bench set_up(const scene *a)
{
    bench b;
    b.desc = describe(a);
    size_t size = gvi_size(&b.desc);
    assert_true(size > 0);
    b.g = guard(size);
    memset(&b.st, 0xFF, sizeof b.st);
    assert_ok(gvi_init(&b.st, &b.desc, b.g.memory, size));
    return b;
}

static bench start(const scene *a)
{
    bench b = set_up(a);
    assert_ok(gvi_start(&b.st, 0.25, q_start, v_start));
    return b;
}

static void tear_down(bench *b)
{
    assert_true(is_whole(&b->g));
    free(b->g.base);
}

/* Everything that can be asked, as numbers */
enum { CURVE_POINTS = 5 };
typedef struct {
    real t, h, q[N_MAX], p[N_MAX], v[N_MAX], energy, action;
    real curve[CURVE_POINTS][2*N_MAX], inside[3*N_MAX];
} snapshot;

static snapshot take(gvi_stepper *st)
{
    snapshot s;
    memset(&s, 0, sizeof s);
    s.t = st->t;
    s.h = st->h;
    memcpy(s.q, st->q, (size_t)st->n*sizeof(real));
    memcpy(s.p, st->p, (size_t)st->n*sizeof(real));
    assert_ok(gvi_velocity(st, s.v));
    assert_ok(gvi_energy(st, &s.energy));
    if (s.h == 0) return s;                                    /* no step yet */
    assert_ok(gvi_action(st, &s.action));
    assert_ok(gvi_state_at(st, s.t - s.h/3, s.inside, s.inside + N_MAX, s.inside + 2*N_MAX));
    for (int k = 0; k < CURVE_POINTS; ++k)
        assert_ok(gvi_curve(st, (real)k/(CURVE_POINTS - 1), s.curve[k], s.curve[k] + N_MAX));
    return s;
}

static void assert_same(const snapshot *a, const snapshot *b)
{
    assert_memory_equal(a, b, sizeof *a);
}

/* ------------------------------------------------------------------- defaults */

static void a_description_of_zeros_is_filled_in(void **state)
{
    static const gvi_effect only[] = { { .kind = GVI_POTENTIAL, .points = chain } };
    gvi_desc desc = { .n = 2, .effects = only, .effect_count = 1 };
    real *memory = malloc(gvi_size(&desc));
    gvi_stepper st;
    (void)state;
    assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
    assert_int_equal(st.n, 2);
    assert_int_equal(st.s, 8);
    assert_int_equal(st.r, 8);
    assert_int_equal(st.order, 16);
    assert_int_equal(st.formulation, GVI_POSITIONS);
    assert_int_equal(st.status, GVI_OK);
    assert_true(st.h == 0);
    assert_int_equal(st.counters.steps, 0);
    free(memory);

    desc.degree = 3;
    desc.rule.kind = GVI_LOBATTO;
    memory = malloc(gvi_size(&desc));
    assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
    assert_int_equal(st.r, 4);
    assert_int_equal(st.order, 6);
    free(memory);
}

/* Nothing acts: straight lines */
static void a_scene_without_effects_moves_uniformly(void **state)
{
    const gvi_desc desc = { .n = 2, .degree = 3 };
    real *memory = malloc(gvi_size(&desc));
    gvi_stepper st;
    (void)state;
    assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
    assert_ok(gvi_start(&st, 0, (const real[]){ 1, 2 }, (const real[]){ 3, -4 }));
    assert_ok(gvi_step(&st, 0.5));
    assert_close(st.q[0], 2.5, 4*EPS);
    assert_close(st.q[1], 0, 4*EPS);
    assert_true(st.p[0] == 3 && st.p[1] == -4);
    free(memory);
}

static void the_scene_chooses_the_formulation(void **state)
{
    static const struct { scene a; gvi_formulation wanted; } cases[] = {
        { { GVI_AUTO, GVI_MASS_UNIT,     POT,        2, 1, GVI_LOBATTO, 2 }, GVI_EXPLICIT },
        { { GVI_AUTO, GVI_MASS_UNIT,     POT,        2, 1, GVI_GAUSS,   1 }, GVI_POSITIONS },
        { { GVI_AUTO, GVI_MASS_DENSE,    POT,        2, 4, GVI_GAUSS,   6 }, GVI_POSITIONS },
        { { GVI_AUTO, GVI_MASS_UNIT,     POT | DRAG, 2, 1, GVI_LOBATTO, 2 }, GVI_VELOCITIES },
        { { GVI_AUTO, GVI_MASS_DIAGONAL, POT | COUP, 2, 4, GVI_GAUSS,   4 }, GVI_VELOCITIES },
        { { GVI_AUTO, GVI_MASS_POSITION, POT | DRAG, 2, 4, GVI_GAUSS,   4 }, GVI_MOMENTA },
        { { GVI_AUTO, GVI_MASS_POSITION, POT,        2, 4, GVI_GAUSS,   5 }, GVI_NEWTON },
        { { GVI_AUTO, GVI_MASS_NONE,     POT | KIN,  2, 4, GVI_GAUSS,   4 }, GVI_NEWTON },
    };
    (void)state;
    for (int k = 0; k < COUNT(cases); ++k) {
        bench b = start(&cases[k].a);
        assert_int_equal(b.st.formulation, cases[k].wanted);
        assert_true(strlen(gvi_formulation_text(&b.st)) > 0);
        assert_ok(gvi_step(&b.st, 0.05));
        assert_int_equal(b.st.formulation, cases[k].wanted);
        tear_down(&b);
    }
}

static void every_status_has_a_sentence_of_its_own(void **state)
{
    (void)state;
    for (int a = GVI_OK; a >= GVI_E_CONJUGATE; --a) {
        assert_true(strlen(gvi_status_text((gvi_status)a)) > 1);
        for (int b = GVI_OK; b > a; --b)
            assert_string_not_equal(gvi_status_text((gvi_status)a), gvi_status_text((gvi_status)b));
    }
    assert_non_null(gvi_status_text((gvi_status)-99));
    assert_non_null(gvi_status_text((gvi_status)99));
}

/* --------------------------------------------------------------------- memory */

/* Everything the interface has, in an order that a user might have */
static void use_everything(bench *b)
{
    gvi_stepper *st = &b->st, saved;
    size_t bytes = b->g.size;
    real *copy = malloc(bytes), q1[N_MAX], number, v[8][N_MAX];
    const gvi_discrete out = { &number, v[0], v[1], v[2], v[3], v[4], v[5], NULL, NULL };
    gvi_status discrete;

    assert_ok(gvi_start(st, 0, q_start, v_start));
    assert_ok(gvi_step(st, 0.02));
    assert_ok(gvi_step(st, 0.02));
    memcpy(copy, b->g.memory, bytes);
    saved = *st;
    assert_ok(gvi_step(st, 0.01));
    assert_ok(gvi_restore(st, &saved, copy));
    assert_ok(gvi_step(st, -0.03));
    take(st);
    for (int i = 0; i < st->n; ++i) q1[i] = st->q[i] + (real)0.02*v_start[i];
    discrete = gvi_discrete_lagrangian(st, 0, 0.02, st->q, q1, &out);
    assert_true(discrete == GVI_OK || discrete == GVI_E_FORMULATION);
    discrete = gvi_start_configurations(st, 0, 0.02, q_start, q1);
    assert_true(discrete == GVI_OK || discrete == GVI_E_FORMULATION || discrete == GVI_E_CONVERGENCE);
    assert_ok(gvi_switch(st, b->desc.effect_count - 1, 0));
    assert_ok(gvi_start(st, 0, q_start, v_start));
    assert_ok(gvi_step(st, 0.02));
    free(copy);
}

/* All of a grid of scenes; those that a pinned formulation does not cover are
   left out.  AUTO covers everything.                                         */
typedef void scene_fn(const scene *a);

static void for_all_scenes(scene_fn *use)
{
    static const int degrees[] = { 1, 2, 4, 5, 8 }, effect_sets[] = { POT, POT | COUP, POT | DRAG, POT | COUP | DRAG };
    static const int sizes[] = { 1, 2, 3, 5 };
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
        use(&a);
    }
}

static int scenes_used;

static void expect_memory_to_be_exact(const scene *a)
{
    gvi_desc desc = describe(a);
    size_t size = gvi_size(&desc);
    gvi_stepper st;
    guarded g = guard(size);
    gvi_status got;
    if (size == 0) {
        assert_true(a->formulation != GVI_AUTO);
        assert_status(gvi_init(&st, &desc, g.memory, 1000000), GVI_E_FORMULATION);
        free(g.base);
        return;
    }
    assert_int_equal(size % sizeof(real), 0);
    got = gvi_init(&st, &desc, g.memory, size - 1);
    assert_int_equal(got, GVI_E_MEMORY);
    assert_status(gvi_init(&st, &desc, (real *)(void *)((char *)g.memory + 1), size), GVI_E_ARGUMENT);
    assert_ok(gvi_init(&st, &desc, g.memory, size));
    assert_true(is_whole(&g));
    free(g.base);
    ++scenes_used;
}

static void the_size_is_exact_and_one_byte_less_is_refused(void **state)
{
    (void)state;
    scenes_used = 0;
    for_all_scenes(expect_memory_to_be_exact);
    assert_true(scenes_used > 2000);
}

static void nothing_outside_the_memory_is_touched(void **state)
{
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k)
        for (int n = 1; n <= 5; ++n) {
            scene a = scenes[k];
            a.n = n;
            bench b = set_up(&a);
            use_everything(&b);
            tear_down(&b);
        }
}

static void expect_length_to_suffice(const scene *a)
{
    gvi_desc desc = describe(a);
    size_t enough = (size_t)GVI_LENGTH(a->n, a->s, a->r)*sizeof(real);
    if (gvi_size(&desc) <= enough) return;
    print_error("GVI_LENGTH(%d, %d, %d) = %lu reals, %lu needed: formulation %d, mass %d, effects %d\n",
                a->n, a->s, a->r, (unsigned long)(enough/sizeof(real)),
                (unsigned long)(gvi_size(&desc)/sizeof(real)), (int)a->formulation, (int)a->mass, a->has);
    ++scenes_used;                                             /* here: misses */
}

static void gvi_length_is_a_constant_and_enough_for_every_scene(void **state)
{
    static real array[GVI_LENGTH(2, 8, 8)];
    (void)state;
    assert_true(sizeof array > sizeof(real));
    scenes_used = 0;
    for_all_scenes(expect_length_to_suffice);
    assert_int_equal(scenes_used, 0);
}

static void gvi_length_is_enough_for_large_scenes_too(void **state)
{
    static const int large[][3] = { { 6, 16, 16 }, { 6, 16, 19 }, { 1, 64, 64 }, { 1, 64, 128 }, { 6, 3, 40 } };
    (void)state;
    scenes_used = 0;
    for (int k = 0; k < COUNT(large); ++k)
        for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_NONE; ++mass) {
            scene a = { GVI_AUTO, (gvi_mass_kind)mass, POT | COUP | DRAG | (mass == GVI_MASS_NONE ? KIN : 0),
                        large[k][0], large[k][1], GVI_GAUSS, large[k][2] };
            expect_length_to_suffice(&a);
        }
    assert_int_equal(scenes_used, 0);
}

/* "pinned: no fall-back and no memory for one" */
static void a_pinned_formulation_needs_less_memory(void **state)
{
    scene a = { GVI_AUTO, GVI_MASS_UNIT, POT, 3, 8, GVI_GAUSS, 8 };
    gvi_desc desc = describe(&a);
    size_t with_newton = gvi_size(&desc);
    (void)state;
    desc.formulation = GVI_POSITIONS;
    assert_true(gvi_size(&desc) < with_newton);
}

/* ---------------------------------------------------------- faulty arguments */

static int count_two = 2;
static real bad_mass[4];
static gvi_effect bad_effects[GVI_EFFECTS + 1];

/* The k-th way to spoil a good description, 0 when there is none left */
static int spoil(gvi_desc *d, int k)
{
    static const real wrong[] = { (real)NAN, (real)INFINITY };
    gvi_effect *e = bad_effects;
    switch (k) {
    case 0:  d->n = 0; break;
    case 1:  d->n = -1; break;
    case 2:  d->degree = -1; break;
    case 3:  d->rule.points = -1; break;
    case 4:  d->rule.kind = (gvi_rule_kind)7; break;
    case 5:  d->rule.kind = GVI_OWN; d->rule.points = 8; break;                   /* no nodes */
    case 6:  d->effects = NULL; break;
    case 7:  d->effect_count = -1; break;
    case 8:  d->effect_count = GVI_EFFECTS + 1; break;
    case 9:  e->kind = (gvi_kind)9; break;
    case 10: e->points = NULL; break;                                             /* neither */
    case 11: e->point = chain_at_a_point; e->user = &count_two; break;            /* both */
    case 12: d->mass.kind = (gvi_mass_kind)9; break;
    case 13: d->mass.kind = GVI_MASS_DIAGONAL; break;                             /* no matrix */
    case 14: d->mass.kind = GVI_MASS_DENSE; break;
    case 15: d->mass.kind = GVI_MASS_POSITION; d->mass.gradient = mass_gradient; break;
    case 16: d->mass.kind = GVI_MASS_POSITION; d->mass.points = mass_points; break;
    case 17:
    case 18:
        bad_mass[0] = bad_mass[3] = 1;
        bad_mass[2] = wrong[k - 17];
        d->mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = bad_mass };
        break;
    case 19: d->formulation = (gvi_formulation)9; break;
    case 20: d->tolerance = -1; break;
    case 21: d->tolerance = (real)NAN; break;
    case 22: d->max_iterations = -1; break;
    case 23: d->iterations = -1; break;
    case 24: d->iterations = 1000001; break;
    case 25: bad_mass[0] = bad_mass[3] = 1; d->mass.matrix = bad_mass; break;     /* of which kind? */
    case 26: d->mass.points = mass_points; d->mass.gradient = mass_gradient; break;
    case 27: d->rule.points = 8; d->rule.nodes = d->rule.weights = bad_mass; break;
    default: return 0;
    }
    return 1;
}

static void faulty_descriptions_are_refused(void **state)
{
    static real memory[20000];
    (void)state;
    for (int k = 0; ; ++k) {
        gvi_desc desc = { .n = 2, .effects = bad_effects, .effect_count = 1 };
        gvi_stepper st;
        gvi_status got;
        for (int i = 0; i < COUNT(bad_effects); ++i)
            bad_effects[i] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = chain };
        if (!spoil(&desc, k)) break;
        got = gvi_init(&st, &desc, memory, sizeof memory);
        if (got != GVI_E_ARGUMENT) print_error("way %d to spoil a description\n", k);
        assert_int_equal(got, GVI_E_ARGUMENT);
        if (k != 17 && k != 18) assert_int_equal(gvi_size(&desc), 0);  /* the matrix is gvi_init's to read */
    }
}

static void null_pointers_are_refused(void **state)
{
    scene a = scenes[1];
    bench b = start(&a);
    gvi_stepper st;
    real x[N_MAX] = { 0 };
    (void)state;
    assert_int_equal(gvi_size(NULL), 0);
    assert_status(gvi_init(NULL, &b.desc, b.g.memory, b.g.size), GVI_E_ARGUMENT);
    assert_status(gvi_init(&st, NULL, b.g.memory, b.g.size), GVI_E_ARGUMENT);
    assert_status(gvi_init(&st, &b.desc, NULL, b.g.size), GVI_E_ARGUMENT);
    assert_status(gvi_start(&b.st, 0, NULL, x), GVI_E_ARGUMENT);
    assert_status(gvi_start(&b.st, 0, x, NULL), GVI_E_ARGUMENT);
    assert_status(gvi_start_momentum(&b.st, 0, NULL, x), GVI_E_ARGUMENT);
    assert_status(gvi_start_momentum(&b.st, 0, x, NULL), GVI_E_ARGUMENT);
    assert_status(gvi_start_configurations(&b.st, 0, 1, NULL, x), GVI_E_ARGUMENT);
    assert_status(gvi_start_configurations(&b.st, 0, 1, x, NULL), GVI_E_ARGUMENT);
    assert_status(gvi_velocity(&b.st, NULL), GVI_E_ARGUMENT);
    assert_status(gvi_energy(&b.st, NULL), GVI_E_ARGUMENT);
    assert_ok(gvi_step(&b.st, 0.01));
    assert_status(gvi_action(&b.st, NULL), GVI_E_ARGUMENT);
    assert_status(gvi_discrete_lagrangian(&b.st, 0, 1, x, x, NULL), GVI_E_ARGUMENT);
    assert_status(gvi_step(NULL, 0.1), GVI_E_ARGUMENT);
    assert_status(gvi_restore(&b.st, NULL, b.g.memory), GVI_E_ARGUMENT);
    assert_status(gvi_restore(&b.st, &b.st, NULL), GVI_E_ARGUMENT);
    tear_down(&b);
}

static void numbers_that_are_none_are_refused_and_change_nothing(void **state)
{
    static const real wrong[] = { (real)NAN, (real)INFINITY, -(real)INFINITY };
    bench b = start(&scenes[5]);
    snapshot before, after;
    real bad[N_MAX] = { 0 };
    (void)state;
    assert_ok(gvi_step(&b.st, 0.1));
    before = take(&b.st);
    assert_status(gvi_step(&b.st, 0), GVI_E_ARGUMENT);
    assert_status(gvi_start_configurations(&b.st, 0, 0, q_start, v_start), GVI_E_ARGUMENT);
    for (int k = 0; k < COUNT(wrong); ++k) {
        bad[1] = wrong[k];
        assert_status(gvi_step(&b.st, wrong[k]), GVI_E_ARGUMENT);
        assert_int_equal(b.st.status, GVI_E_ARGUMENT);
        assert_status(gvi_start(&b.st, wrong[k], q_start, v_start), GVI_E_ARGUMENT);
        assert_status(gvi_start(&b.st, 0, bad, v_start), GVI_E_ARGUMENT);
        assert_status(gvi_start(&b.st, 0, q_start, bad), GVI_E_ARGUMENT);
        assert_status(gvi_start_momentum(&b.st, 0, q_start, bad), GVI_E_ARGUMENT);
        assert_status(gvi_start_configurations(&b.st, 0, 0.1, q_start, bad), GVI_E_ARGUMENT);
        assert_status(gvi_start_configurations(&b.st, 0, wrong[k], q_start, q_start), GVI_E_ARGUMENT);
        assert_true(gvi_curve(&b.st, wrong[k], bad, NULL) != GVI_OK);
        assert_true(gvi_state_at(&b.st, wrong[k], bad, NULL, NULL) != GVI_OK);
    }
    after = take(&b.st);
    assert_same(&before, &after);
    tear_down(&b);
}

static void questions_at_the_wrong_time_are_refused(void **state)
{
    bench b = set_up(&scenes[1]);
    real x[N_MAX], number;
    (void)state;
    assert_status(gvi_step(&b.st, 0.1), GVI_E_STATE);
    assert_status(gvi_velocity(&b.st, x), GVI_E_STATE);
    assert_status(gvi_energy(&b.st, &number), GVI_E_STATE);
    assert_ok(gvi_start(&b.st, 0.25, q_start, v_start));
    assert_status(gvi_curve(&b.st, 0.5, x, NULL), GVI_E_STATE);
    assert_status(gvi_action(&b.st, &number), GVI_E_STATE);
    assert_status(gvi_state_at(&b.st, 0.3, x, NULL, NULL), GVI_E_STATE);
    assert_ok(gvi_step(&b.st, 0.1));
    assert_status(gvi_state_at(&b.st, 0.24, x, NULL, NULL), GVI_E_STATE);
    assert_status(gvi_state_at(&b.st, 0.36, x, NULL, NULL), GVI_E_STATE);
    assert_true(gvi_curve(&b.st, -0.01, x, NULL) != GVI_OK);
    assert_true(gvi_curve(&b.st, 1.01, x, NULL) != GVI_OK);
    assert_ok(gvi_start(&b.st, 0, q_start, v_start));          /* a new start forgets the step */
    assert_status(gvi_curve(&b.st, 0.5, x, NULL), GVI_E_STATE);
    tear_down(&b);
}

/* ------------------------------------------------------------------ own rules */

static gvi_status init_with_rule(int s, int r, const real *c, const real *b)
{
    static real memory[20000];
    static const gvi_effect only[] = { { .kind = GVI_POTENTIAL, .points = chain } };
    const gvi_desc desc = { .n = 2, .degree = s, .rule = { GVI_OWN, r, c, b }, .effects = only, .effect_count = 1 };
    gvi_stepper st;
    gvi_status got = gvi_init(&st, &desc, memory, sizeof memory);
    if (got == GVI_E_NODES || got == GVI_E_ORDER || r < s) assert_int_equal(gvi_size(&desc), 0);
    return got;
}

static void rules_that_cannot_work_are_refused(void **state)
{
    const real third[] = { 0, 0.5, 1 }, simpson[] = { 1/(real)6, 4/(real)6, 1/(real)6 };
    const real hole[] = { 0.5, 0, 0.5 };
    real gauss[3], weights[2];
    (void)state;
    assert_ok(init_with_rule(2, 3, third, simpson));
    assert_status(init_with_rule(2, 3, (const real[]){ -0.001, 0.5, 1 }, simpson), GVI_E_NODES);
    assert_status(init_with_rule(2, 3, (const real[]){ 0, 0.5, 1.001 }, simpson), GVI_E_NODES);
    assert_status(init_with_rule(2, 3, (const real[]){ 0, 0.5, 0.5 }, simpson), GVI_E_NODES);
    assert_status(init_with_rule(2, 3, (const real[]){ 0, (real)NAN, 1 }, simpson), GVI_E_NODES);
    assert_status(init_with_rule(2, 3, third, (const real[]){ 0.2, 0.5, 0.2 }), GVI_E_ORDER);
    assert_status(init_with_rule(2, 3, third, (const real[]){ 0, 0, 0 }), GVI_E_ORDER);
    assert_status(init_with_rule(4, 3, third, simpson), GVI_E_POINTS);            /* r < s */
    assert_ok(init_with_rule(1, 3, third, hole));
    assert_status(init_with_rule(3, 3, third, hole), GVI_E_ORDER);                /* u = 2 < s */
    /* Gauss 2 with a point of no weight: of order 4, but for three modes it is blind */
    assert_ok(gvi_gauss(2, gauss, weights));
    gauss[2] = gauss[1];
    gauss[1] = 0.5;
    assert_status(init_with_rule(3, 3, gauss, hole), GVI_E_POINTS);
    assert_ok(init_with_rule(2, 3, gauss, hole));
}

/* The caller's own copy of a built-in rule is the built-in rule */
static void own_nodes_may_come_in_any_order(void **state)
{
    real c[3], b[3], order[2][3], weights[2][3], q[2][N_MAX];
    (void)state;
    assert_ok(gvi_gauss(3, c, b));
    for (int k = 0; k < 3; ++k) {
        order[0][k] = c[k];
        weights[0][k] = b[k];
        order[1][(k + 1)%3] = c[k];
        weights[1][(k + 1)%3] = b[k];
    }
    for (int way = 0; way < 2; ++way) {
        scene a = { GVI_AUTO, GVI_MASS_POSITION, POT | DRAG, 2, 3, GVI_GAUSS, 3 };
        gvi_desc desc = describe(&a);
        desc.rule = (gvi_rule){ GVI_OWN, 3, order[way], weights[way] };
        real *memory = malloc(gvi_size(&desc));
        gvi_stepper st;
        assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
        assert_int_equal(st.order, 6);
        assert_ok(gvi_start(&st, 0, q_start, v_start));
        for (int k = 0; k < 5; ++k) assert_ok(gvi_step(&st, 0.1));
        memcpy(q[way], st.q, 2*sizeof(real));
        free(memory);
    }
    for (int i = 0; i < 2; ++i) assert_close(q[0][i], q[1][i], 16*EPS);
}

/* --------------------------------------------------------------- formulations */

static void pinned_formulations_that_do_not_cover_the_scene_are_refused(void **state)
{
    static const scene impossible[] = {
        { GVI_EXPLICIT,   GVI_MASS_UNIT,     POT,        2, 2, GVI_LOBATTO, 3 },
        { GVI_EXPLICIT,   GVI_MASS_UNIT,     POT,        2, 1, GVI_GAUSS,   1 },
        { GVI_EXPLICIT,   GVI_MASS_UNIT,     POT | DRAG, 2, 1, GVI_LOBATTO, 2 },
        { GVI_EXPLICIT,   GVI_MASS_POSITION, POT,        2, 1, GVI_LOBATTO, 2 },
        { GVI_POSITIONS,  GVI_MASS_UNIT,     POT | DRAG, 2, 4, GVI_GAUSS,   4 },
        { GVI_POSITIONS,  GVI_MASS_UNIT,     POT | COUP, 2, 4, GVI_GAUSS,   4 },
        { GVI_POSITIONS,  GVI_MASS_POSITION, POT,        2, 4, GVI_GAUSS,   4 },
        { GVI_VELOCITIES, GVI_MASS_POSITION, POT,        2, 4, GVI_GAUSS,   4 },
        { GVI_VELOCITIES, GVI_MASS_NONE,     POT | KIN,  2, 4, GVI_GAUSS,   4 },
        { GVI_MOMENTA,    GVI_MASS_POSITION, POT,        2, 4, GVI_GAUSS,   5 },
        { GVI_MOMENTA,    GVI_MASS_NONE,     POT | KIN,  2, 4, GVI_GAUSS,   4 },
    };
    static real memory[20000];
    (void)state;
    for (int k = 0; k < COUNT(impossible); ++k) {
        gvi_desc desc = describe(&impossible[k]);
        gvi_stepper st;
        gvi_status got = gvi_init(&st, &desc, memory, sizeof memory);
        if (got != GVI_E_FORMULATION) print_error("case %d: %s\n", k, gvi_status_text(got));
        assert_int_equal(got, GVI_E_FORMULATION);
        assert_int_equal(gvi_size(&desc), 0);
    }
}

static void the_boundary_value_problem_needs_newtons_memory(void **state)
{
    bench b = start(&scenes[1]);
    real Ld;
    (void)state;
    assert_status(gvi_discrete_lagrangian(&b.st, 0, 0.1, q_start, v_start, &(gvi_discrete){ .lagrangian = &Ld }),
                  GVI_E_FORMULATION);
    assert_status(gvi_start_configurations(&b.st, 0, 0.1, q_start, v_start), GVI_E_FORMULATION);
    tear_down(&b);
    scene line = { GVI_POSITIONS, GVI_MASS_UNIT, POT, 2, 1, GVI_GAUSS, 1 };       /* nothing to solve */
    b = start(&line);
    assert_ok(gvi_discrete_lagrangian(&b.st, 0, 0.1, q_start, v_start, &(gvi_discrete){ .lagrangian = &Ld }));
    tear_down(&b);
}

static int stiff_springs(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] -= 10000*x->q[k];
        x->f[x->stride + k] -= x->q[x->stride + k];
    }
    return 0;
}

static const gvi_effect stiff[] = { { .kind = GVI_POTENTIAL, .points = stiff_springs } };

static gvi_stepper *start_stiff(gvi_formulation formulation)
{
    static gvi_stepper st;
    static real memory[20000];
    const gvi_desc desc = { .n = 2, .degree = 4, .effects = stiff, .effect_count = 1, .formulation = formulation };
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, (const real[]){ 0.01, 1 }, (const real[]){ 1, 0 }));
    return &st;
}

/* h omega = 50.  Gauss keeps quadratic invariants, stiff or not. */
static void auto_goes_over_to_newton_on_a_stiff_scene_and_says_so(void **state)
{
    char before[200];
    gvi_stepper *st = start_stiff(GVI_AUTO);
    (void)state;
    strncpy(before, gvi_formulation_text(st), sizeof before - 1);
    before[sizeof before - 1] = 0;
    assert_int_equal(st->formulation, GVI_POSITIONS);
    for (int k = 0; k < 50; ++k) {
        assert_ok(gvi_step(st, 0.5));
        assert_int_equal(st->formulation, GVI_NEWTON);
        assert_close(st->p[0]*st->p[0] + 10000*st->q[0]*st->q[0], 2, 2000*EPS);
        assert_close(st->p[1]*st->p[1] + st->q[1]*st->q[1], 1, 200*EPS);
    }
    assert_string_not_equal(before, gvi_formulation_text(st));
    assert_true(st->counters.factorizations > 0);
    assert_true(st->counters.newton_iterations > 0);
}

static void a_pinned_fixed_point_fails_on_a_stiff_scene_and_leaves_it_alone(void **state)
{
    gvi_stepper *st = start_stiff(GVI_POSITIONS);
    (void)state;
    assert_status(gvi_step(st, 0.5), GVI_E_CONVERGENCE);
    assert_int_equal(st->formulation, GVI_POSITIONS);
    assert_int_equal(st->counters.failures, 1);
    assert_int_equal(st->counters.steps, 0);
    assert_true(st->t == 0 && st->h == 0 && st->q[0] == (real)0.01 && st->p[0] == 1);
    assert_ok(gvi_step(st, 0.005));                            /* halve h and go on */
}

static int unit_spring(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) x->f[k] -= x->q[k];
    return 0;
}

/* Up to h omega = 4 the fixed point of degree 8 contracts: a tolerance of 1e-14 is
   reached in 17 iterations.  Then the end at rounding must be seen too, at every
   phase: also where q begins and ends the step near zero, and is large inside.
   Roundings of a few EPS h a step, independent, 300 steps.                    */
static void a_fixed_point_that_contracts_is_never_called_divergent(void **state)
{
    static const gvi_effect only[] = { { .kind = GVI_POTENTIAL, .points = unit_spring } };
    const gvi_desc desc = { .n = 1, .effects = only, .effect_count = 1, .formulation = GVI_POSITIONS };
    real *memory = malloc(gvi_size(&desc));
    (void)state;
    for (int k = 1; k <= 10; ++k) {
        gvi_stepper st;
        int failures = 0;
        assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
        assert_ok(gvi_start(&st, 0, (const real[]){ 1 }, (const real[]){ 0 }));
        for (int j = 0; j < 300; ++j) failures += gvi_step(&st, (real)0.4*(real)k) != GVI_OK;
        if (failures) print_error("h omega = %.1f: %d of 300 steps failed\n", 0.4*k, failures);
        assert_int_equal(failures, 0);
        assert_close(st.q[0]*st.q[0] + st.p[0]*st.p[0], 1, 600*EPS);
    }
    free(memory);
}

/* Mass 1 and L = a v^2/2 beside it: q = cos(t) for a spring of 1 + a.  V = (P - a V)/1 is
   found by iterations that contract like a, at any h */
static real more_mass;

static int added_mass(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->dldv[k] += more_mass*x->v[k];
    return (void)user, 0;
}

static int strong_spring(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[k] -= (1 + more_mass)*x->q[k];
    return (void)user, 0;
}

static const gvi_effect added[] = { { .kind = GVI_LAGRANGIAN, .points = added_mass },
                                    { .kind = GVI_POTENTIAL, .points = strong_spring } };

static void short_steps_do_not_hide_velocities_that_diverge(void **state)
{
    (void)state;
    more_mass = 3;
    for (int f = GVI_VELOCITIES; f <= GVI_NEWTON; ++f)
    for (real h = 1e-15; h < 2e-3; h *= 100) {
        const gvi_desc desc = { .n = 1, .degree = 2, .effects = added, .effect_count = 2,
                                .formulation = (gvi_formulation)f };
        static real memory[20000];
        gvi_stepper st;
        gvi_status got;
        assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
        assert_ok(gvi_start(&st, 0, (const real[]){ 1 }, (const real[]){ 1 }));
        got = gvi_step(&st, h);
        if (f == GVI_NEWTON) assert_ok(got);
        if (got == GVI_OK) assert_close(st.q[0], cos(h) + sin(h), 4*EPS);
        else assert_status(got, GVI_E_CONVERGENCE);
    }
}

static void short_steps_do_not_leave_velocities_half_way(void **state)
{
    (void)state;
    more_mass = 0.5;
    for (int f = GVI_VELOCITIES; f <= GVI_NEWTON; ++f) {
        const gvi_desc desc = { .n = 1, .degree = 3, .effects = added, .effect_count = 2,
                                .formulation = (gvi_formulation)f };
        static const real share[] = { 1.25, 0.75, 1 };
        static real memory[20000];
        gvi_stepper st;
        assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
        assert_ok(gvi_start(&st, 0, (const real[]){ 1 }, (const real[]){ 0 }));
        for (int k = 0; k < 30000; ++k) assert_ok(gvi_step(&st, 1e-5*share[k % 3]));
        assert_close(st.q[0], cos(st.t), 4*EPS);
    }
}

/* A spring, and a mass matrix that is 1: whatever the rule, what is extrapolated from two
   steps of 0.1 on |q| <= 1.1 lies within 2 of the origin.  Two steps of two points, ends
   among them, are three points: a polynomial that four would determine is rounding. */
static real farthest;

static int spring_that_looks(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        if (!(fabs(x->q[k]) <= farthest)) farthest = fabs(x->q[k]);
        x->f[k] -= x->q[k];
    }
    return 0;
}

static int unit_mass(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) x->mass[k] = 1;
    return 0;
}

static int no_gradient(const gvi_points *x, void *user) { return (void)x, (void)user, 0; }

static void an_iteration_starts_near_the_motion_with_every_rule(void **state)
{
    static const real ends[] = { 0, 1 }, halves[] = { 0.5, 0.5 };
    static const real near[] = { 0, 16*EPS, 1 }, few[] = { 0.25, 0.25, 0.5 };
    static const gvi_effect looking[] = { { .kind = GVI_POTENTIAL, .points = spring_that_looks } };
    const gvi_rule own[] = { { GVI_OWN, 2, ends, halves }, { GVI_OWN, 3, near, few } };
    static real memory[20000];
    (void)state;
    for (int k = 0; k < 2 + 2*11; ++k) {
        const int r = 2 + (k - 2)/2;
        gvi_rule rule = { k % 2 ? GVI_LOBATTO : GVI_GAUSS, r, NULL, NULL };
        gvi_desc desc = { .n = 1, .degree = k < 2 ? 2 : r, .rule = k < 2 ? own[k] : rule, .effects = looking,
                          .effect_count = 1, .mass = { .kind = GVI_MASS_POSITION, .points = unit_mass,
                          .gradient = no_gradient } };
        gvi_stepper st;
        assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
        assert_ok(gvi_start(&st, 0, (real[]){ 1 }, (real[]){ 0.3 }));
        farthest = 0;
        for (int m = 0; m < 20; ++m) assert_ok(gvi_step(&st, 0.1));
        assert_true(farthest < 2);
    }
}

static void too_few_iterations_are_a_failure(void **state)
{
    gvi_desc desc = { .n = 2, .degree = 4, .effects = stiff, .effect_count = 1,
                      .formulation = GVI_POSITIONS, .max_iterations = 3 };
    static real memory[20000];
    gvi_stepper st;
    (void)state;
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, (const real[]){ 0.01, 1 }, (const real[]){ 1, 0 }));
    assert_status(gvi_step(&st, 0.01), GVI_E_CONVERGENCE);
    assert_true(st.counters.iterations <= 3);
}

static void a_tolerance_buys_iterations(void **state)
{
    unsigned long long iterations[2];
    real q[2][N_MAX];
    (void)state;
    for (int k = 0; k < 2; ++k) {
        gvi_desc desc = describe(&scenes[3]);
        real *memory = malloc(gvi_size(&desc));
        gvi_stepper st;
        desc.tolerance = k ? (real)sqrt((real)EPS) : 0;
        assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
        assert_ok(gvi_start(&st, 0, q_start, v_start));
        for (int j = 0; j < 10; ++j) assert_ok(gvi_step(&st, 0.2));
        iterations[k] = st.counters.iterations;
        memcpy(q[k], st.q, 3*sizeof(real));
        free(memory);
    }
    assert_true(iterations[1] < iterations[0]);
    for (int i = 0; i < 3; ++i) assert_close(q[0][i], q[1][i], 100*sqrt((real)EPS));
}

/* ------------------------------------------------- a given number of iterations */

/* 20 steps of N iterations on q'' = -q, each with N evaluations at all points.
   Returns the largest error against cos, sin.                                 */
static real run_given(int N, gvi_formulation formulation, size_t *size)
{
    static const gvi_effect only[] = { { .kind = GVI_POTENTIAL, .points = unit_spring } };
    const gvi_desc desc = { .n = 1, .degree = 4, .effects = only, .effect_count = 1,
                            .formulation = formulation, .iterations = N };
    static real memory[2000];
    gvi_stepper st;
    real worst = 0;
    *size = gvi_size(&desc);
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, (const real[]){ 1 }, (const real[]){ 0 }));
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
   what is left after N falls by that or better, until it is rounding.         */
static void a_given_number_of_iterations_is_made(void **state)
{
    size_t size, pinned;
    (void)state;
    for (int N = 1; N < 12; ++N) {
        const real first = run_given(N, GVI_AUTO, &size), next = run_given(N + 1, GVI_POSITIONS, &pinned);
        assert_true(next <= first/50 + 100*EPS);
        assert_int_equal(size, pinned);                       /* no memory for Newton */
        if (N == 1) assert_true(first > 1e-6);                /* one is not enough */
    }
    assert_true(run_given(12, GVI_AUTO, &size) < 100*EPS);
}

static void given_iterations_that_diverge_are_a_failure(void **state)
{
    const gvi_desc desc = { .n = 2, .effects = stiff, .effect_count = 1, .iterations = 5 };
    gvi_desc newton = desc;
    static real memory[20000];
    gvi_stepper st;
    (void)state;
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, (const real[]){ 0.01, 1 }, (const real[]){ 1, 0 }));
    assert_status(gvi_step(&st, 0.5), GVI_E_CONVERGENCE);
    assert_true(st.t == 0 && st.q[0] == (real)0.01 && st.p[0] == 1);
    assert_ok(gvi_step(&st, 0.005));
    newton.formulation = GVI_NEWTON;                          /* it has no fixed point */
    assert_status(gvi_init(&st, &newton, memory, sizeof memory), GVI_E_FORMULATION);
}

/* ------------------------------------------------------ equivalent callbacks */

static void run_ten(const gvi_desc *desc, real *q, gvi_counters *counters)
{
    real *memory = malloc(gvi_size(desc));
    gvi_stepper st;
    assert_ok(gvi_init(&st, desc, memory, gvi_size(desc)));
    assert_ok(gvi_start(&st, 0, q_start, v_start));
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, 0.1));
    memcpy(q, st.q, (size_t)st.n*sizeof(real));
    if (counters) *counters = st.counters;
    free(memory);
}

static void one_point_a_call_and_all_at_once_are_the_same(void **state)
{
    int n = 3;
    real q[2][N_MAX];
    gvi_desc desc = describe(&scenes[1]);
    (void)state;
    run_ten(&desc, q[0], NULL);
    effects[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .point = chain_at_a_point, .user = &n };
    run_ten(&desc, q[1], NULL);
    for (int i = 0; i < n; ++i) assert_close(q[0][i], q[1][i], 8*EPS);
}

static void newton_with_second_derivatives_and_with_differences_agree(void **state)
{
    int n = 3;
    real q[2][N_MAX];
    scene a = { GVI_NEWTON, GVI_MASS_DENSE, POT, 3, 4, GVI_GAUSS, 5 };
    gvi_desc desc = describe(&a);
    (void)state;
    desc.effect_count = 1;
    run_ten(&desc, q[0], NULL);
    effects[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .point = chain_at_a_point, .hessian = chain_hessian, .user = &n };
    run_ten(&desc, q[1], NULL);
    for (int i = 0; i < n; ++i) assert_close(q[0][i], q[1][i], 16*EPS);
}

static void the_callers_velocity_replaces_the_linear_algebra(void **state)
{
    real q[2][N_MAX];
    gvi_counters counters[2];
    gvi_desc desc = describe(&scenes[6]);
    (void)state;
    run_ten(&desc, q[0], &counters[0]);
    desc.mass.velocity = mass_velocity;
    run_ten(&desc, q[1], &counters[1]);
    for (int i = 0; i < 3; ++i) assert_close(q[0][i], q[1][i], 16*EPS);
    assert_true(counters[0].factorizations > 0);
    assert_int_equal(counters[1].factorizations, 0);
}

/* ------------------------------------------------------- singular mass matrices */

static void a_massless_coordinate_is_named(void **state)
{
    static real memory[20000];
    static const gvi_effect only[] = { { .kind = GVI_POTENTIAL, .points = chain } };
    gvi_desc desc = { .n = 3, .degree = 3, .effects = only, .effect_count = 1 };
    gvi_stepper st;
    (void)state;
    desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = (const real[]){ 1, 0, 2 } };
    assert_status(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_SINGULAR);
    assert_int_equal(st.fault.coordinate, 1);
    desc.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = (const real[]){ 1, 0, 0, 0, 1, 0, 0, 0, 0 } };
    assert_status(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_SINGULAR);
    assert_int_equal(st.fault.coordinate, 2);
    /* x1 + x2 has mass, x1 - x2 has none: either may be named */
    desc.mass.matrix = (const real[]){ 1, 1, 0, 1, 1, 0, 0, 0, 1 };
    assert_status(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_SINGULAR);
    assert_between(0, st.fault.coordinate, 1);
}

/* diag(1, 0, 1) by callback */
static int mass_with_a_hole(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < x->count; ++k) x->mass[(i*x->n + j)*x->stride + k] = i == j && i != 1;
    return 0;
}

static int nothing(const gvi_points *x, void *user) { (void)x; (void)user; return 0; }

static void a_singular_mass_matrix_in_a_step_is_named_and_changes_nothing(void **state)
{
    (void)state;
    for (int newton = 0; newton <= 1; ++newton) {
        scene a = { newton ? GVI_NEWTON : GVI_MOMENTA, GVI_MASS_POSITION, POT, 3, 3, GVI_GAUSS, 3 };
        gvi_desc desc = describe(&a);
        real *memory;
        gvi_stepper st;
        desc.mass.points = mass_with_a_hole;
        desc.mass.gradient = nothing;
        memory = malloc(gvi_size(&desc));
        assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
        assert_ok(gvi_start(&st, 0, q_start, v_start));            /* p = M v needs no inverse */
        assert_status(gvi_step(&st, 0.1), GVI_E_SINGULAR);
        assert_int_equal(st.fault.coordinate, 1);
        assert_true(st.t == 0 && st.q[1] == q_start[1] && st.p[0] == v_start[0] && st.p[1] == 0);
        if (gvi_start_momentum(&st, 5, v_start, q_start) == GVI_OK) (void)gvi_step(&st, 0.1);
        assert_int_equal(st.status, GVI_E_SINGULAR);
        assert_int_equal(st.fault.coordinate, 1);
        free(memory);
    }
}

/* Kinetic energy for the first coordinate only */
static int half_kinetic(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) x->dldv[k] += x->v[k];
    return 0;
}

static void a_lagrangian_without_kinetic_energy_for_a_coordinate_is_named(void **state)
{
    static const gvi_effect some[] = {
        { .kind = GVI_LAGRANGIAN, .points = half_kinetic },
    };
    static real memory[20000], v[2];
    const gvi_desc desc = { .n = 2, .degree = 3, .effects = some, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_NONE } };
    gvi_stepper st;
    (void)state;
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    if (gvi_start_momentum(&st, 0, q_start, (const real[]){ 1, 0 }) == GVI_OK)
        assert_status(gvi_step(&st, 0.1), GVI_E_SINGULAR);
    assert_int_equal(st.status, GVI_E_SINGULAR);
    assert_int_equal(st.fault.coordinate, 1);
    assert_int_equal(gvi_velocity(&st, v) == GVI_OK, 0);
}

/* --------------------------------------------------------------------- failures */

static const real h_good = 0.125;

/* A step that fails, with all that it may not change */
static void expect_failure(bench *b, real h, gvi_status wanted, gvi_status or_this)
{
    enum harm was = harm, mass_was = mass_harm;
    snapshot before, after;
    unsigned long long failures, steps = b->st.counters.steps;
    gvi_fault fault;
    gvi_status got;

    harm = mass_harm = NO_HARM;
    before = take(&b->st);
    harm = was;
    mass_harm = mass_was;
    failures = b->st.counters.failures;
    got = gvi_step(&b->st, h);
    if (got != wanted && got != or_this) print_error("h = %g: %s\n", (double)h, gvi_status_text(got));
    assert_true(got == wanted || got == or_this);
    assert_int_equal(b->st.status, got);
    assert_int_equal(b->st.counters.failures, failures + 1);
    assert_int_equal(b->st.counters.steps, steps);
    fault = b->st.fault;
    harm = mass_harm = NO_HARM;
    after = take(&b->st);
    assert_same(&before, &after);
    b->st.fault = fault;
    b->st.status = got;
}

/* Fails, is healed, goes on; a twin without the failure ends at the same state */
static void expect_recovery(const scene *a, enum harm what, gvi_status wanted)
{
    bench b = start(a), twin;
    for (int k = 0; k < 3; ++k) assert_ok(gvi_step(&b.st, h_good));
    harm = what;
    expect_failure(&b, h_good, wanted, wanted);
    assert_int_equal(b.st.fault.effect, b.desc.effect_count - 1);
    if (wanted == GVI_E_NON_FINITE) {
        assert_int_equal(b.st.fault.coordinate, a->n - 1);
        assert_int_equal(b.st.fault.point, b.st.r > 2 ? 2 : 0);
    }
    for (int k = 0; k < 3; ++k) assert_ok(gvi_step(&b.st, h_good));
    twin = start(a);
    for (int k = 0; k < 6; ++k) assert_ok(gvi_step(&twin.st, h_good));
    for (int i = 0; i < a->n; ++i) {
        assert_close(b.st.q[i], twin.st.q[i], 16*EPS);
        assert_close(b.st.p[i], twin.st.p[i], 32*EPS);
    }
    assert_true(b.st.t == twin.st.t);
    tear_down(&b);
    tear_down(&twin);
}

static void a_callback_that_refuses_ends_the_step_and_nothing_else(void **state)
{
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k) expect_recovery(&scenes[k], REFUSE, GVI_E_CALLBACK);
}

static void nan_and_inf_are_traced_to_effect_coordinate_and_point(void **state)
{
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k) {
        expect_recovery(&scenes[k], GIVE_NAN, GVI_E_NON_FINITE);
        expect_recovery(&scenes[k], GIVE_INF, GVI_E_NON_FINITE);
    }
}

static void a_mass_callback_that_fails_is_named(void **state)
{
    static const gvi_status wanted[] = { GVI_OK, GVI_E_CALLBACK, GVI_E_NON_FINITE, GVI_E_NON_FINITE };
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k)
        for (int what = REFUSE; what <= GIVE_INF; ++what) {
            if (scenes[k].mass != GVI_MASS_POSITION) continue;
            bench b = start(&scenes[k]);
            assert_ok(gvi_step(&b.st, h_good));
            mass_harm = (enum harm)what;
            expect_failure(&b, h_good, wanted[what], wanted[what]);
            assert_int_equal(b.st.fault.effect, GVI_FAULT_MASS);
            assert_ok(gvi_step(&b.st, h_good));
            tear_down(&b);
        }
}

/* Further than a fixed point can follow; its divergence, which overflows, must not
   pass for convergence.  (An effect may be the first to overflow, v^2 say.)  Not
   EXPLICIT, which does not iterate.                                          */
static void a_step_that_is_too_large_leaves_everything_and_a_smaller_one_works(void **state)
{
    (void)state;
    for (int k = 1; k < COUNT(scenes); ++k) {
        scene a = scenes[k];
        if (a.formulation == GVI_AUTO || a.formulation == GVI_NEWTON) continue;
        for (real h = 10; h < 2e9; h *= 10) {
            bench b = start(&a);
            assert_ok(gvi_step(&b.st, h_good));
            expect_failure(&b, h, GVI_E_CONVERGENCE, GVI_E_NON_FINITE);
            if (b.st.status == GVI_E_NON_FINITE) assert_int_not_equal(b.st.fault.effect, GVI_FAULT_NONE);
            assert_ok(gvi_step(&b.st, h_good));
            tear_down(&b);
        }
    }
}

static void a_start_that_fails_leaves_the_state(void **state)
{
    bench b = start(&scenes[7]);
    snapshot before, after;
    (void)state;
    assert_ok(gvi_step(&b.st, h_good));
    before = take(&b.st);
    mass_harm = REFUSE;
    assert_status(gvi_start(&b.st, 5, v_start, v_start), GVI_E_CALLBACK);
    assert_int_equal(b.st.fault.effect, GVI_FAULT_MASS);
    harm = REFUSE;
    mass_harm = NO_HARM;
    assert_status(gvi_start_configurations(&b.st, 5, 0.1, v_start, v_start), GVI_E_CALLBACK);
    harm = NO_HARM;
    after = take(&b.st);
    assert_same(&before, &after);
    tear_down(&b);
}

static void a_query_that_fails_leaves_the_state(void **state)
{
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k) {
        bench b = start(&scenes[k]);
        snapshot before, after;
        real x[3*N_MAX], number;
        assert_ok(gvi_step(&b.st, h_good));
        before = take(&b.st);
        for (int what = REFUSE; what <= GIVE_INF; ++what) {
            gvi_status wanted = what == REFUSE ? GVI_E_CALLBACK : GVI_E_NON_FINITE;
            harm = (enum harm)what;
            assert_status(gvi_state_at(&b.st, b.st.t - h_good/3, x, x + N_MAX, x + 2*N_MAX), wanted);
            assert_int_equal(b.st.fault.effect, b.desc.effect_count - 1);
            harm = NO_HARM;
            value_harm = (enum harm)what;
            assert_status(gvi_energy(&b.st, &number), wanted);
            assert_int_equal(b.st.fault.effect, b.desc.effect_count - 1);
            assert_status(gvi_action(&b.st, &number), wanted);
            value_harm = NO_HARM;
        }
        after = take(&b.st);
        assert_same(&before, &after);
        assert_ok(gvi_step(&b.st, h_good));
        tear_down(&b);
    }
}

static void energy_without_a_value_names_the_effect(void **state)
{
    bench b = start(&scenes[4]);
    real number;
    (void)state;
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

/* ----------------------------------------------------------- plain data, moved */

static void a_stepper_may_be_moved(void **state)
{
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k) {
        bench b = start(&scenes[k]);
        snapshot stayed, moved;
        gvi_stepper *elsewhere;
        for (int j = 0; j < 6; ++j) assert_ok(gvi_step(&b.st, h_good));
        stayed = take(&b.st);
        tear_down(&b);
        b = start(&scenes[k]);
        for (int j = 0; j < 3; ++j) assert_ok(gvi_step(&b.st, h_good));
        elsewhere = malloc(sizeof *elsewhere);
        memcpy(elsewhere, &b.st, sizeof b.st);
        memset(&b.st, 0xFF, sizeof b.st);
        for (int j = 0; j < 3; ++j) assert_ok(gvi_step(elsewhere, h_good));
        moved = take(elsewhere);
        assert_same(&stayed, &moved);
        free(elsewhere);
        tear_down(&b);
    }
}

enum { RECORDED = 12 };

/* Steps of two lengths, so that the extrapolation of the guess changes too */
static void record(gvi_stepper *st, snapshot *log)
{
    for (int k = 0; k < RECORDED; ++k) {
        assert_ok(gvi_step(st, k % 4 == 3 ? h_good/2 : h_good));
        log[k] = take(st);
    }
}

static void expect_same_log(const snapshot *a, const snapshot *b)
{
    for (int k = 0; k < RECORDED; ++k) assert_same(&a[k], &b[k]);
}

/* In the stepper itself, later; in another one; and what was saved stays whole */
static void expect_exact_restart(const scene *a, int steps_before)
{
    static snapshot first[RECORDED], again[RECORDED];
    bench b = start(a), other = set_up(a);
    for (int k = 0; k < steps_before; ++k) assert_ok(gvi_step(&b.st, h_good));
    gvi_stepper saved = b.st;
    real *memory = malloc(b.g.size);
    memcpy(memory, b.g.memory, b.g.size);

    record(&b.st, first);
    assert_ok(gvi_restore(&b.st, &saved, memory));
    assert_true(b.st.t == saved.t);
    record(&b.st, again);
    expect_same_log(first, again);
    assert_ok(gvi_restore(&other.st, &saved, memory));
    tear_down(&b);                                             /* nothing may point there */
    record(&other.st, again);
    expect_same_log(first, again);
    free(memory);
    tear_down(&other);
}

static void a_checkpoint_continues_to_the_bit(void **state)
{
    (void)state;
    for (int k = 0; k < COUNT(scenes); ++k) {
        expect_exact_restart(&scenes[k], 0);
        expect_exact_restart(&scenes[k], 1);
        expect_exact_restart(&scenes[k], 7);
    }
}

/* The factorised matrix and the decision for Newton are part of the checkpoint */
static void a_checkpoint_on_a_stiff_scene_continues_to_the_bit(void **state)
{
    const gvi_desc desc = { .n = 2, .degree = 4, .effects = stiff, .effect_count = 1 };
    real *memory = malloc(gvi_size(&desc)), *copy = malloc(gvi_size(&desc)), q[20][2];
    gvi_stepper st, saved;
    (void)state;
    assert_ok(gvi_init(&st, &desc, memory, gvi_size(&desc)));
    assert_ok(gvi_start(&st, 0, (const real[]){ 0.01, 1 }, (const real[]){ 1, 0 }));
    for (int k = 0; k < 5; ++k) assert_ok(gvi_step(&st, 0.5));
    saved = st;
    memcpy(copy, memory, gvi_size(&desc));
    for (int k = 0; k < 20; ++k) {
        assert_ok(gvi_step(&st, k == 10 ? 0.25 : 0.5));
        memcpy(q[k], st.q, sizeof q[k]);
    }
    assert_ok(gvi_restore(&st, &saved, copy));
    for (int k = 0; k < 20; ++k) {
        assert_ok(gvi_step(&st, k == 10 ? 0.25 : 0.5));
        assert_memory_equal(q[k], st.q, sizeof q[k]);
    }
    free(memory);
    free(copy);
}

static int spring_points(const gvi_points *x, void *user)
{
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= x->q[i*x->stride + k];
    return (void)user, 0;
}

static int spring_point(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    for (int i = 0; i < 2; ++i) f[i] -= q[i];
    return (void)t, (void)v, (void)dldv, (void)user, 0;
}

/* v'v/2 */
static int inertia_points(const gvi_points *x, void *user)
{
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->dldv[i*x->stride + k] += x->v[i*x->stride + k];
    return (void)user, 0;
}

static void a_checkpoint_of_another_description_is_refused(void **state)
{
    static const scene others[] = {
        { GVI_POSITIONS, GVI_MASS_UNIT, POT, 2, 8, GVI_GAUSS, 8 },
        { GVI_POSITIONS, GVI_MASS_UNIT, POT, 3, 7, GVI_GAUSS, 8 },
        { GVI_POSITIONS, GVI_MASS_UNIT, POT, 3, 8, GVI_GAUSS, 9 },
        { GVI_NEWTON,    GVI_MASS_UNIT, POT, 3, 8, GVI_GAUSS, 8 },
    };
    (void)state;
    for (int k = 0; k < COUNT(others); ++k) {
        bench b = start(&scenes[1]), other = start(&others[k]);
        snapshot before, after;
        assert_ok(gvi_step(&other.st, h_good));
        before = take(&other.st);
        assert_status(gvi_restore(&other.st, &b.st, b.g.memory), GVI_E_ARGUMENT);
        after = take(&other.st);
        assert_same(&before, &after);
        tear_down(&b);
        tear_down(&other);
    }
}

/* Effects are not copied with a checkpoint: more or fewer of them, or another kind of mass, is another scene */
static void a_checkpoint_of_other_effects_is_refused(void **state)
{
    static const gvi_effect many[] = { { .kind = GVI_POTENTIAL, .points = spring_points },
                                       { .kind = GVI_POTENTIAL, .points = spring_points },
                                       { .kind = GVI_LAGRANGIAN, .points = inertia_points } };
    gvi_desc desc[] = { { .n = 2, .degree = 3, .effects = many, .effect_count = 3, .formulation = GVI_NEWTON },
                        { .n = 2, .degree = 3, .effects = many + 1, .effect_count = 2, .formulation = GVI_NEWTON },
                        { .n = 2, .degree = 3, .effects = many, .effect_count = 3, .formulation = GVI_NEWTON,
                          .mass = { .kind = GVI_MASS_NONE } } };
    static const real q[] = { 1, 0 };
    static real memory[3][GVI_LENGTH(2, 3, 3)];
    gvi_stepper st[3];
    (void)state;
    for (int k = 0; k < 3; ++k) {
        assert_ok(gvi_init(&st[k], &desc[k], memory[k], sizeof memory[k]));
        assert_ok(gvi_start(&st[k], 0, q, q));
        assert_ok(gvi_step(&st[k], (real)0.125));
    }
    for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
            assert_status(gvi_restore(&st[a], &st[b], memory[b]), a == b ? GVI_OK : GVI_E_ARGUMENT);
}

/* A stepper whose set-up failed last, at its mass, has the sizes of a checkpoint, but no state */
static void a_checkpoint_of_a_failed_set_up_is_refused(void **state)
{
    static const gvi_effect spring = { .kind = GVI_POTENTIAL, .points = spring_points };
    static const real one[] = { 1, 1 }, none[] = { 1, 0 }, q[] = { 1, 0 };
    static real memory[2][GVI_LENGTH(2, 3, 3)];
    gvi_desc desc = { .n = 2, .degree = 3, .effects = &spring, .effect_count = 1,
                      .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = one } };
    gvi_stepper st[2];
    (void)state;
    assert_ok(gvi_init(&st[0], &desc, memory[0], sizeof memory[0]));
    assert_ok(gvi_start(&st[0], 0, q, q));
    desc.mass.matrix = none;
    assert_status(gvi_init(&st[1], &desc, memory[1], sizeof memory[1]), GVI_E_SINGULAR);
    assert_status(gvi_restore(&st[0], &st[1], memory[1]), GVI_E_ARGUMENT);
    assert_ok(gvi_step(&st[0], (real)0.125));
}

/* As points in the one, as point in the other: the callbacks are those of the stepper that is restored */
static void a_checkpoint_goes_on_with_other_callbacks(void **state)
{
    static const gvi_effect whole = { .kind = GVI_POTENTIAL, .points = spring_points };
    static const gvi_effect single = { .kind = GVI_POTENTIAL, .point = spring_point };
    static const real q[] = { 1, 0 };
    static real memory[2][GVI_LENGTH(2, 3, 3)];
    gvi_stepper st[2];
    (void)state;
    for (int k = 0; k < 2; ++k) {
        const gvi_desc desc = { .n = 2, .degree = 3, .effects = k ? &single : &whole, .effect_count = 1 };
        assert_ok(gvi_init(&st[k], &desc, memory[k], sizeof memory[k]));
        assert_ok(gvi_start(&st[k], 0, q, q));
    }
    assert_ok(gvi_step(&st[0], (real)0.125));
    assert_ok(gvi_restore(&st[1], &st[0], memory[0]));
    for (int k = 0; k < 2; ++k) assert_ok(gvi_step(&st[k], (real)0.125));
    assert_memory_equal(st[0].q, st[1].q, 2*sizeof(real));
}

/* -------------------------------------------------------------------- switching */

static void a_switched_off_effect_is_as_if_it_were_not_listed(void **state)
{
    static const struct { int all, index, left; gvi_mass_kind mass; } cases[] = {
        { POT | DRAG,        1, POT,        GVI_MASS_UNIT },
        { POT | COUP,        1, POT,        GVI_MASS_DENSE },
        { POT | COUP | DRAG, 2, POT | COUP, GVI_MASS_POSITION },
        { POT | COUP | DRAG, 0, COUP | DRAG, GVI_MASS_DIAGONAL },
    };
    (void)state;
    for (int k = 0; k < COUNT(cases); ++k) {
        scene a = { GVI_AUTO, cases[k].mass, cases[k].left, 3, 4, GVI_GAUSS, 4 };
        bench b = start(&a);
        real q[3], p[3];
        for (int j = 0; j < 10; ++j) assert_ok(gvi_step(&b.st, h_good));
        memcpy(q, b.st.q, sizeof q);
        memcpy(p, b.st.p, sizeof p);
        tear_down(&b);
        a.has = cases[k].all;
        b = set_up(&a);
        assert_ok(gvi_switch(&b.st, cases[k].index, 0));
        assert_ok(gvi_start(&b.st, 0.25, q_start, v_start));
        for (int j = 0; j < 10; ++j) assert_ok(gvi_step(&b.st, h_good));
        for (int i = 0; i < 3; ++i) {
            assert_close(b.st.q[i], q[i], 32*EPS);
            assert_close(b.st.p[i], p[i], 64*EPS);
        }
        assert_int_equal(b.st.counters.effect[cases[k].index], 0);
        tear_down(&b);
    }
}

/* The momentum is the state: switching keeps q and p to the bit */
static void switching_keeps_the_state_and_refuses_what_is_not_there(void **state)
{
    bench b = start(&scenes[5]);
    real q[N_MAX], p[N_MAX];
    (void)state;
    assert_ok(gvi_step(&b.st, h_good));
    memcpy(q, b.st.q, 2*sizeof(real));
    memcpy(p, b.st.p, 2*sizeof(real));
    assert_status(gvi_switch(&b.st, -1, 0), GVI_E_ARGUMENT);
    assert_status(gvi_switch(&b.st, b.desc.effect_count, 0), GVI_E_ARGUMENT);
    for (int on = 0; on <= 1; ++on) {
        assert_ok(gvi_switch(&b.st, 1, on));
        assert_memory_equal(q, b.st.q, 2*sizeof(real));
        assert_memory_equal(p, b.st.p, 2*sizeof(real));
        assert_ok(gvi_step(&b.st, h_good));
        memcpy(q, b.st.q, 2*sizeof(real));
        memcpy(p, b.st.p, 2*sizeof(real));
    }
    tear_down(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_description_of_zeros_is_filled_in),
        cmocka_unit_test(a_scene_without_effects_moves_uniformly),
        cmocka_unit_test(the_scene_chooses_the_formulation),
        cmocka_unit_test(every_status_has_a_sentence_of_its_own),
        cmocka_unit_test(the_size_is_exact_and_one_byte_less_is_refused),
        cmocka_unit_test(nothing_outside_the_memory_is_touched),
        cmocka_unit_test(gvi_length_is_a_constant_and_enough_for_every_scene),
        cmocka_unit_test(gvi_length_is_enough_for_large_scenes_too),
        cmocka_unit_test(a_pinned_formulation_needs_less_memory),
        cmocka_unit_test(faulty_descriptions_are_refused),
        cmocka_unit_test(null_pointers_are_refused),
        cmocka_unit_test(numbers_that_are_none_are_refused_and_change_nothing),
        cmocka_unit_test(questions_at_the_wrong_time_are_refused),
        cmocka_unit_test(rules_that_cannot_work_are_refused),
        cmocka_unit_test(own_nodes_may_come_in_any_order),
        cmocka_unit_test(pinned_formulations_that_do_not_cover_the_scene_are_refused),
        cmocka_unit_test(the_boundary_value_problem_needs_newtons_memory),
        cmocka_unit_test(auto_goes_over_to_newton_on_a_stiff_scene_and_says_so),
        cmocka_unit_test(a_pinned_fixed_point_fails_on_a_stiff_scene_and_leaves_it_alone),
        cmocka_unit_test(a_fixed_point_that_contracts_is_never_called_divergent),
        cmocka_unit_test(short_steps_do_not_hide_velocities_that_diverge),
        cmocka_unit_test(short_steps_do_not_leave_velocities_half_way),
        cmocka_unit_test(an_iteration_starts_near_the_motion_with_every_rule),
        cmocka_unit_test(too_few_iterations_are_a_failure),
        cmocka_unit_test(a_tolerance_buys_iterations),
        cmocka_unit_test(a_given_number_of_iterations_is_made),
        cmocka_unit_test(given_iterations_that_diverge_are_a_failure),
        cmocka_unit_test(one_point_a_call_and_all_at_once_are_the_same),
        cmocka_unit_test(newton_with_second_derivatives_and_with_differences_agree),
        cmocka_unit_test(the_callers_velocity_replaces_the_linear_algebra),
        cmocka_unit_test(a_massless_coordinate_is_named),
        cmocka_unit_test(a_singular_mass_matrix_in_a_step_is_named_and_changes_nothing),
        cmocka_unit_test(a_lagrangian_without_kinetic_energy_for_a_coordinate_is_named),
        cmocka_unit_test(a_callback_that_refuses_ends_the_step_and_nothing_else),
        cmocka_unit_test(nan_and_inf_are_traced_to_effect_coordinate_and_point),
        cmocka_unit_test(a_mass_callback_that_fails_is_named),
        cmocka_unit_test(a_step_that_is_too_large_leaves_everything_and_a_smaller_one_works),
        cmocka_unit_test(a_start_that_fails_leaves_the_state),
        cmocka_unit_test(a_query_that_fails_leaves_the_state),
        cmocka_unit_test(energy_without_a_value_names_the_effect),
        cmocka_unit_test(a_stepper_may_be_moved),
        cmocka_unit_test(a_checkpoint_continues_to_the_bit),
        cmocka_unit_test(a_checkpoint_on_a_stiff_scene_continues_to_the_bit),
        cmocka_unit_test(a_checkpoint_of_another_description_is_refused),
        cmocka_unit_test(a_checkpoint_of_other_effects_is_refused),
        cmocka_unit_test(a_checkpoint_of_a_failed_set_up_is_refused),
        cmocka_unit_test(a_checkpoint_goes_on_with_other_callbacks),
        cmocka_unit_test(switching_keeps_the_state_and_refuses_what_is_not_there),
        cmocka_unit_test(a_switched_off_effect_is_as_if_it_were_not_listed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
