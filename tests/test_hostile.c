/* Random scenes with callbacks that lie, overflow and refuse, sizes and steps that
   make no sense.  Whatever happens, every call returns after a bounded amount of
   work with a status from the list; a failure leaves the state as it was; a
   success leaves finite numbers; and nothing outside the memory is touched.    */
#ifndef GVI_REAL
#define GVI_REAL double
#endif
#include "gvi_test.h"
#include <limits.h>

typedef gvi_real real;

enum { SCENES = 30000, STEPS = 8, N_MAX = 4, S_MAX = 12, R_MAX = S_MAX + 4, EFFECTS_MAX = 4 };

/* Reproducible numbers, the same on every machine (Knuth's MMIX) */
static uint64_t seed;

static unsigned below(unsigned n)
{
    seed = seed*6364136223846793005u + 1442695040888963407u;
    return (unsigned)((seed >> 33) % n);
}

static real uniform(void) { return (real)below(1u << 20)/(real)(1u << 19) - 1; }

/* Mostly an ordinary number, at times one that nobody expects */
static real odd_number(void)
{
    static const double strange[] = { 0, 1e300, -1e300, 1e-300, 5e-324, -1e-310, 1e150, 1e16, -1e8 };
    unsigned k = below(400);
    if (k == 0) return (real)NAN;
    if (k == 1) return (real)INFINITY;
    if (k == 2) return -(real)INFINITY;
    if (k < 12) return (real)strange[below(COUNT(strange))];
    return uniform();
}

/* -------------------------------------------------------------- callbacks */

enum mood { SPRING, CUBIC, STIFF, HUGE_FORCE, GIVE_NAN, GIVE_INF, GIVE_1E300, NOISE, REFUSE, MOODS };

/* What an effect is like: its mood breaks out at call number `when`, or always */
typedef struct { enum mood mood; int when, calls; real strength; } temper;

static unsigned long long points_asked;             /* by all callbacks, since the call began */

static int breaks_out(temper *a)
{
    int now = a->calls++;
    return a->when < 0 || now == a->when;
}

static real answer(const temper *a, real q)
{
    switch (a->mood) {
    case CUBIC:      return -a->strength*q*q*q;
    case STIFF:      return -(real)1e6*q;
    case HUGE_FORCE: return (real)1e30*a->strength;
    case GIVE_NAN:   return (real)NAN;
    case GIVE_INF:   return (real)INFINITY;
    case GIVE_1E300: return (real)1e300;
    case NOISE:      return uniform()*(real)1e3;
    case SPRING: case REFUSE: case MOODS: default: return -a->strength*q;
    }
}

/* The force, and for Lagrangian terms a dL/dv that is or is not definite */
AT_POINTS(moody_points)
{
    temper *a = user;
    int bad = breaks_out(a);
    points_asked += (unsigned long long)x->count;
    if (bad && a->mood == REFUSE) return 1;
    FOR_EACH(x, at) {
        const real f = bad ? answer(a, x->q[at]) : -x->q[at];
        x->f[at] += f;
        if (x->v) x->f[at] -= x->v[at]/8;
        if (x->dldv) x->dldv[at] += bad && a->mood > STIFF ? f : x->v[at]*(1 + a->strength);
    }
    for (int k = 0; k < x->count && x->value; ++k)             /* a clock, or points and value in one */
        x->value[k] += bad ? answer(a, x->q[k]) : 1 + x->q[k]*x->q[k];
    return 0;
}

AT_POINT(moody_point)
{
    temper *a = user;
    int bad = breaks_out(a);
    ++points_asked;
    if (bad && a->mood == REFUSE) return -1;
    f[0] += bad ? answer(a, q[0]) : -q[0];
    if (v) f[0] -= v[0]*t/8;
    if (dldv) dldv[0] += v[0];
    return 0;
}

AT_POINTS(moody_value)
{
    temper *a = user;
    if (a->mood == REFUSE && breaks_out(a)) return 7;
    for (int k = 0; k < x->count; ++k) x->value[k] += a->when < 0 ? answer(a, x->q[k]) : x->q[k];
    return 0;
}

/* Whatever it says about second derivatives may be wrong */
static int moody_hessian(real t, const real *q, const real *v, real *fq, real *fv, real *pv, void *user)
{
    temper *a = user;
    if (a->mood == REFUSE && a->when < 0) return 1;
    fq[0] += a->mood == GIVE_NAN ? (real)NAN : -(1 + a->strength*q[0]);
    if (fv) fv[0] -= (real)0.125;
    if (pv) pv[0] += 1 + a->strength;
    return 0;
}

AT_POINTS(moody_mass)
{
    temper *a = user;
    int bad = breaks_out(a);
    points_asked += (unsigned long long)x->count;
    if (bad && a->mood == REFUSE) return 1;
    FOR_EACH(x, at)
        for (int j = 0, i = at/x->stride; j <= i; ++j) {
            const real q = x->q[at];
            x->mass[(i*(x->n - 1) + j)*x->stride + at]
                = bad && a->mood > SPRING ? answer(a, q) : i == j ? 2 + q*q/(1 + q*q) : 0;
        }
    return 0;
}

AT_POINTS(moody_gradient)
{
    temper *a = user;
    for (int k = 0; k < x->n*x->stride; k += x->stride) x->f[k] += a->mood == GIVE_INF ? (real)INFINITY : 0;
    return 0;
}

AT_POINTS(moody_velocity)
{
    temper *a = user;
    int bad = breaks_out(a);
    points_asked += (unsigned long long)x->count;
    if (bad && a->mood == REFUSE) return 1;
    FOR_EACH(x, at) x->velocity[at] = bad ? answer(a, x->p[at]) : x->p[at];
    return 0;
}

/* ------------------------------------------------------------------ scenes */

typedef struct {
    gvi_desc   desc;
    gvi_effect effects[EFFECTS_MAX];
    temper     tempers[EFFECTS_MAX + 1];
    real       matrix[N_MAX*N_MAX], nodes[R_MAX], weights[R_MAX];
} scene;

static temper random_temper(void)
{
    temper a = { (enum mood)below(MOODS), (int)below(60), 0, 0 };
    if (below(3)) a.mood = below(2) ? SPRING : CUBIC;          /* most are harmless */
    if (below(6) == 0) a.when = -1;
    a.strength = below(20) ? uniform() : odd_number();
    return a;
}

static void random_effects(scene *a)
{
    a->desc.effects = a->effects;
    a->desc.effect_count = (int)below(EFFECTS_MAX + 1);
    for (int e = 0; e < a->desc.effect_count; ++e) {
        gvi_effect *x = &a->effects[e];
        memset(x, 0, sizeof *x);
        a->tempers[e] = random_temper();
        x->kind = (gvi_kind)below(below(4) ? 3 : 4);
        if (below(2) || x->kind == GVI_CLOCK) x->points = moody_points;
        else x->point = moody_point;
        if (below(2)) x->value = moody_value;
        if (below(3) == 0) x->hessian = moody_hessian;
        x->user = &a->tempers[e];
    }
}

static void random_mass(scene *a)
{
    gvi_mass *m = &a->desc.mass;
    int n = a->desc.n;
    m->kind = (gvi_mass_kind)below(5);
    if (m->kind == GVI_MASS_UNIT && below(50)) return;         /* what it does not take is refused */
    m->matrix = a->matrix;
    for (int i = 0; i < n*n; ++i) a->matrix[i] = below(10) ? uniform() : odd_number();
    for (int i = 0; i < n; ++i)
        if (below(20)) a->matrix[m->kind == GVI_MASS_DENSE ? i*n + i : i] = 3 + uniform();
    m->points = moody_mass;
    m->gradient = moody_gradient;
    if (below(4) == 0) m->velocity = moody_velocity;
    a->tempers[EFFECTS_MAX] = random_temper();
    m->user = &a->tempers[EFFECTS_MAX];
}

static void random_rule(scene *a)
{
    gvi_rule *rule = &a->desc.rule;
    int s = a->desc.degree ? a->desc.degree : 8, r = s + (int)below(4);
    rule->kind = (gvi_rule_kind)below(2);
    rule->points = below(5) ? r : 0;
    if (below(6)) return;
    rule->kind = below(4) ? GVI_OWN : GVI_KICKS;               /* Gauss, more or less */
    rule->points = r;
    assert_ok(gvi_gauss(r, a->nodes, a->weights));
    if (below(3) == 0) a->nodes[below((unsigned)r)] = odd_number();
    if (below(3) == 0) a->weights[below((unsigned)r)] = odd_number();
    rule->nodes = a->nodes;
    rule->weights = a->weights;
}

static void random_scene(scene *a)
{
    static const int iterations[] = { 0, 0, 0, 1, 2, 5, 60, 200 };
    memset(a, 0, sizeof *a);
    a->desc.n = 1 + (int)below(N_MAX);
    a->desc.degree = (int)below(S_MAX + 1);
    random_effects(a);
    random_mass(a);
    random_rule(a);
    if (below(2)) a->desc.formulation = (gvi_formulation)below(6);
    if (below(5) == 0) a->desc.tolerance = uniform()/100;
    a->desc.max_iterations = iterations[below(COUNT(iterations))];
    if (below(5) == 0) a->desc.iterations = (int)below(6);
}

/* -------------------------------------------------------------- guarded memory */

enum { PAD = 16, ROOM = 60000 };
static real memory[ROOM + 2*PAD];

static int is_whole(size_t length)
{
    const unsigned char *before = (const unsigned char *)memory;
    const unsigned char *after = (const unsigned char *)(memory + PAD + length);
    size_t k = 0;
    while (k < PAD*sizeof(real) && before[k] == 0xA5 && after[k] == 0xA5) ++k;
    return k == PAD*sizeof(real);
}

static size_t poisoned;

static void poison(size_t length)
{
    poisoned = length;
    memset(memory, 0xA5, PAD*sizeof(real));
    memset(memory + PAD, 0xFF, length*sizeof(real));
    memset(memory + PAD + length, 0xA5, PAD*sizeof(real));
}

/* -------------------------------------------------------------------- a call */

typedef struct { real t, q[N_MAX], p[N_MAX]; } whole_state;

static whole_state state_of(const gvi_stepper *st)
{
    whole_state s;
    memset(&s, 0, sizeof s);
    s.t = st->t;
    memcpy(s.q, st->q, (size_t)st->n*sizeof(real));
    memcpy(s.p, st->p, (size_t)st->n*sizeof(real));
    return s;
}

static int is_finite_state(const whole_state *s)
{
    int finite = isfinite(s->t);
    for (int i = 0; i < N_MAX; ++i) finite = finite && isfinite(s->q[i]) && isfinite(s->p[i]);
    return finite;
}

/* The most points that all callbacks together may be asked for in one call: the
   contract's bound for a step and each effect, the mass among them with up to
   three callbacks, twice because a failure is looked into once; Newton's method
   for the velocity at a point takes 40(n + 1) more.                          */
static unsigned long long most_points(const gvi_stepper *st, const gvi_desc *d)
{
    int most = d->max_iterations ? d->max_iterations : 60, n = st->n, r = st->r;
    int iterations = d->iterations > most ? d->iterations : most;
    int fixed_point = iterations*(r + 1), newton = 2*(iterations + 2 + (2*n + 1)*(iterations/4 + 3));
    // a solution is followed back in at most 32 times the iterations, a matrix each, and two solutions more
    newton *= 3;
    newton += 2*32*iterations*(2*n + 3);
    return 2ull*(unsigned long long)((fixed_point + newton)*r + 40*(n + 2))
         * (unsigned long long)(d->effect_count + 3);
}

static scene the_scene;
static int   the_number;                            /* of the scene, to find it again */

static int calls_that_worked;

/* After a call: status, work, memory, and the state if it may not have changed */
static void check_call(const char *what, const gvi_stepper *st, gvi_status got, const whole_state *before,
                       int may_change)
{
    whole_state after = state_of(st);
    int good = got <= GVI_OK && got >= GVI_E_CLOCK;
    good = good && is_whole(poisoned);
    good = good && points_asked <= most_points(st, &the_scene.desc);
    if (got != GVI_OK || !may_change) good = good && memcmp(before, &after, sizeof after) == 0;
    if (got == GVI_OK) good = good && is_finite_state(&after) && ++calls_that_worked;
    if (good) return;
    print_error("scene %d, %s: status %d, memory %s, %llu points asked of %llu, state %s\n", the_number, what, got,
                is_whole(poisoned) ? "whole" : "BROKEN", points_asked, most_points(st, &the_scene.desc),
                memcmp(before, &after, sizeof after) ? "changed" : "same");
    fail();
}

#define CHECK(st, may_change, call) do { \
    whole_state before_ = state_of(st); \
    points_asked = 0; \
    check_call(#call, (st), (call), &before_, (may_change)); \
} while (0)

static void random_vector(real *x)
{
    for (int i = 0; i < N_MAX; ++i) x[i] = odd_number();
}

static real random_step(void)
{
    static const double steps[] = { 0.1, 0.01, -0.1, 1, -0.02, 10, 0.3, 1e-8, 0.1, 0.01, 1e8,
                                    0, 1e300, -1e300, 5e-324, -1e-310 };
    unsigned k = below(COUNT(steps) + 2);
    if (k == COUNT(steps)) return (real)NAN;
    if (k == COUNT(steps) + 1) return (real)INFINITY;
    return (real)steps[k];
}

static void start_somehow(gvi_stepper *st)
{
    real a[N_MAX], b[N_MAX];
    random_vector(a);
    random_vector(b);
    switch (below(6)) {
    case 0:  CHECK(st, 1, gvi_start_configurations(st, odd_number(), random_step(), a, b)); break;
    case 1:
    case 2:  CHECK(st, 1, gvi_start_momentum(st, odd_number(), a, b)); break;
    default: CHECK(st, 1, gvi_start(st, odd_number(), a, b));
    }
}

static void ask_something(gvi_stepper *st)
{
    real a[N_MAX], b[N_MAX], c[N_MAX], d[N_MAX], number;
    int negative = 0;
    const gvi_discrete out = { &number, a, b, c, d, NULL, NULL, below(2) ? &negative : NULL, NULL };
    random_vector(a);
    random_vector(b);
    switch (below(7)) {
    case 0: CHECK(st, 0, gvi_velocity(st, a)); break;
    case 1: CHECK(st, 0, gvi_energy(st, &number)); break;
    case 2: CHECK(st, 0, gvi_curve(st, odd_number(), a, b)); break;
    case 3: CHECK(st, 0, gvi_state_at(st, st->t - st->h*odd_number(), a, b, c)); break;
    case 4: CHECK(st, 0, gvi_action(st, &number)); break;
    case 5: CHECK(st, 0, gvi_switch(st, (int)below(EFFECTS_MAX + 2) - 1, (int)below(2))); break;
    default: CHECK(st, 0, gvi_discrete_lagrangian(st, odd_number(), random_step(), a, b, &out));
    }
}

static void live_through(scene *a)
{
    gvi_stepper st;
    size_t size = gvi_size(&a->desc);
    gvi_status got;
    if (size > ROOM*sizeof(real)) fail_msg("scene %d needs %lu bytes", the_number, (unsigned long)size);
    poison(size/sizeof(real));
    got = gvi_init(&st, &a->desc, memory + PAD, size);
    assert_true(got <= GVI_OK && got >= GVI_E_CLOCK);
    assert_true(is_whole(size/sizeof(real)));
    assert_true(size > 0 || got != GVI_OK);
    if (got != GVI_OK) return;
    start_somehow(&st);
    for (int k = 0; k < STEPS; ++k) {
        CHECK(&st, 1, gvi_step(&st, random_step()));
        if (below(3) == 0) ask_something(&st);
        if (below(20) == 0) start_somehow(&st);
    }
}

/* ------------------------------------------------------------------- tests */

TEST(whatever_a_scene_does_every_call_ends_well)
{
    int lived = 0;
    calls_that_worked = 0;
    for (the_number = 0; the_number < SCENES; ++the_number) {
        seed = 1000003u*(uint64_t)the_number + 17;
        random_scene(&the_scene);
        live_through(&the_scene);
        lived += gvi_size(&the_scene.desc) > 0;
    }
    print_message("    %d scenes of %d could be set up, %d calls succeeded\n", lived, SCENES, calls_that_worked);
    assert_true(lived > SCENES/3);                             /* the menu is not all poison */
    assert_true(calls_that_worked > SCENES);
}

/* No product of sizes may wrap round to a small one */
TEST(sizes_that_no_machine_has_are_refused)
{
    static const int sizes[] = { 1, 2, 1000, 1024, 4096, 65536, 0xFFFFFF, INT_MAX/2, INT_MAX };
    static const gvi_effect effects[] = { { .kind = GVI_FORCE, .points = moody_points } };
    static real little[64];
    for (int i = 0; i < COUNT(sizes); ++i)
    for (int j = 0; j < COUNT(sizes); ++j)
    for (int k = 0; k < COUNT(sizes); ++k)
    for (int formulation = GVI_AUTO; formulation <= GVI_NEWTON; ++formulation) {
        const gvi_desc desc = { .n = sizes[i], .degree = sizes[j], .rule = { .points = sizes[k] },
                                .effects = effects, .effect_count = 1, .formulation = (gvi_formulation)formulation };
        gvi_stepper st;
        size_t size = gvi_size(&desc);
        double least = (double)sizes[i]*sizes[k]*sizeof(real);           /* one row for each coordinate */
        if (size == 0) assert_true(gvi_init(&st, &desc, little, sizeof little) != GVI_OK);
        else assert_true((double)size >= least);
        if (size > sizeof little) assert_status(gvi_init(&st, &desc, little, sizeof little), GVI_E_MEMORY);
    }
}

RUN_TESTS(NULL, NULL)
