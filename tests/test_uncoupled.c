/* Many coordinates go in whole vectors, one alone does not.  Coordinates that know nothing of each other
   have to move as each of them alone, to the bit: explicit and in the fixed points, any mass that is a number
   for each, rounded or not, steps forward and back, one that fails between them.  In every formulation each
   converges by its own size, to some roundings of it; and where large forces cancel nothing is refused. */
#include "gvi_test.h"

enum { MOST = 100, STEPS = 40 };

#ifndef THINNED
#define THINNED 1                                 // under sanitizers not every seed
#endif

/* the coordinate of a stepper that has one, or -1; which of them is NaN, or -1 */
typedef struct place { int alone, bad; } place;

static real masses[MOST];

/* an oscillator each, of its own frequency, with a cubic term and a drive; whole numbers over powers of two */
static int springs(const gvi_points *x, void *user)
{
    const place *w = (const place *)user;
    for (int i = 0; i < x->n; ++i) {
        const int is = w->alone < 0 ? i : w->alone;
        const real k = 1 + (real)(is % 7)/4, cubic = (real)(is % 5)/8;
        for (int j = 0; j < x->count; ++j) {
            const real q = x->q[i*x->stride + j];
            x->f[i*x->stride + j] += (x->t[j]/4 - k*q) - cubic*(q*q*q);
            if (is == w->bad) x->f[i*x->stride + j] += (real)NAN;
        }
    }
    return 0;
}

static real q_of(int i) { return (real)((37*i) % 64 - 31)/32; }
static real p_of(int i) { return (real)((23*i) % 64 - 17)/16; }

typedef struct rule_of_test { const char *name; int degree; gvi_rule rule; int iterations; } rule_of_test;

/* Stoermer-Verlet; a drift first; a kick first that the last step does not know, and one of weight 0 */
static const real drift_c[] = { (real)0.25L, (real)0.75L }, half[] = { (real)0.5L, (real)0.5L };
static const real some_c[] = { 0, (real)0.375L, (real)0.625L, 1 };
static const real some_b[] = { (real)0.3125L, (real)0.25L, (real)0.4375L, 0 };
static const rule_of_test rules[] = {
    { "Verlet",      1, { .kind = GVI_LOBATTO, .points = 2 }, 0 },
    { "drift first", 1, { GVI_KICKS, 2, drift_c, half }, 0 },
    { "weight 0",    1, { GVI_KICKS, 4, some_c, some_b }, 0 },
    { "degree 2",    2, { .kind = GVI_GAUSS }, 5 },
    { "degree 4",    4, { .kind = GVI_GAUSS }, 5 },
    { "degree 8",    8, { .kind = GVI_GAUSS }, 6 },
    { "degree 12",  12, { .kind = GVI_GAUSS }, 6 } };

static gvi_desc describe(const rule_of_test *r, int n, int diagonal, real tolerance, const gvi_effect *scene)
{
    const place *w = (const place *)scene->user;
    gvi_desc d = { .n = n, .degree = r->degree, .rule = r->rule, .effects = scene, .effect_count = 1,
                   .tolerance = tolerance, .iterations = r->iterations };
    if (r->iterations) d.formulation = GVI_POSITIONS;
    if (diagonal) d.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = masses + (w->alone < 0 ? 0 : w->alone) };
    return d;
}

/* One step fails where bad is a coordinate: nothing may have moved.  z: q, then p, at the end; the same inside the
   last step, which wants its start */
static void run(const gvi_desc *d, place *w, int bad, real *z)
{
    real was[2*MOST], q0[MOST], p0[MOST];
    const int n = d->n, first = w->alone < 0 ? 0 : w->alone;
    for (int i = 0; i < n; ++i) {
        q0[i] = q_of(first + i);
        p0[i] = p_of(first + i);
    }
    gvi_stepper st = new_stepper(d);
    assert_ok(gvi_start_momentum(&st, 0, q0, p0));
    for (int k = 0; k < STEPS; ++k) {
        if (bad >= 0 && k % 9 == 4) {
            memcpy(was, st.q, sizeof(real)*(size_t)n);
            memcpy(was + n, st.p, sizeof(real)*(size_t)n);
            w->bad = bad;
            assert_status(gvi_step(&st, (real)0.1L), GVI_E_NON_FINITE);
            w->bad = -1;
            assert_same_numbers(was, st.q, n);
            assert_same_numbers(was + n, st.p, n);
        }
        assert_ok(gvi_step(&st, k == 17 ? (real)-0.07L : (real)0.1L));
    }
    memcpy(z, st.q, sizeof(real)*(size_t)n);
    memcpy(z + n, st.p, sizeof(real)*(size_t)n);
    assert_ok(gvi_state_at(&st, st.t - (real)0.07L, z + 2*n, NULL, z + 3*n));
}

static void compare(const rule_of_test *r, int n, int diagonal, real tolerance)
{
    real z[4*MOST], one[4];
    for (int bad = -1; bad < n; bad += n - 1) {
        place w = { -1, -1 };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = &w } };
        const gvi_desc d = describe(r, n, diagonal, tolerance, scene);
        run(&d, &w, bad, z);
    }
    for (int i = 0; i < n; ++i) {
        place w = { i, -1 };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = &w } };
        const gvi_desc d = describe(r, 1, diagonal, tolerance, scene);
        run(&d, &w, i, one);
        for (int k = 0; k < 4; ++k)
            if (z[k*n + i] < one[k] || z[k*n + i] > one[k])
                fail_msg("%s, %d coordinates%s%s: number %d of %d is %.17Lg, alone %.17Lg", r->name, n,
                         diagonal ? ", masses" : "", tolerance > 0 ? ", tolerance" : "", k, i,
                         (long double)z[k*n + i], (long double)one[k]);
    }
}

TEST(each_of_many_moves_as_alone)
{
    static const int counts[] = { 3, 8, 13, MOST };
    for (int i = 0; i < MOST; ++i) masses[i] = (real)(3 + i % 11)/4;
    for (int k = 0; k < COUNT(rules); ++k)
        for (int j = 0; j < COUNT(counts); ++j)
            for (int with = 0; with < 4; ++with)
                compare(&rules[k], counts[j], with & 1, with & 2 ? (real)1e-4L : 0);
}

enum { DRAG = 1, QUARTIC = 2, MQ = 4, SPEED = 8, CLOCK = 16, HESSIAN = 32, DIAGONAL = 64, DENSE = 128, RODS = 256,
       SIZES = 14, PLACES = 2*SIZES };

/* each in units of its own: length and mass; spring, its cubic term, drag */
typedef struct own { real length, mass, k, cubic, drag; } own;
static own owns[PLACES];

typedef struct form { const char *name; gvi_formulation f; int degree, with; } form;
static const form forms[] = {
    { "Verlet",            GVI_EXPLICIT,    1, DIAGONAL },
    { "degree 1",          GVI_POSITIONS,   1, 0 },
    { "positions",         GVI_POSITIONS,   3, DIAGONAL },
    { "degree 8",          GVI_POSITIONS,   8, 0 },
    { "degree 16",         GVI_POSITIONS,  16, DIAGONAL },
    { "a full mass",       GVI_POSITIONS,   6, DENSE },
    { "AUTO",              GVI_AUTO,        2, DIAGONAL },
    { "drag",              GVI_VELOCITIES,  6, DRAG | DIAGONAL },
    { "Lagrangian terms",  GVI_MOMENTA,     6, DRAG | QUARTIC | DIAGONAL },
    { "momenta",           GVI_MOMENTA,     4, DRAG | DIAGONAL },
    { "M(q)",              GVI_MOMENTA,     6, DRAG | MQ },
    { "v = M(q)^-1 p",     GVI_MOMENTA,     6, DRAG | MQ | SPEED },
    { "a clock",           GVI_MOMENTA,     6, CLOCK | DRAG | DIAGONAL },
    { "M(q) and a clock",  GVI_MOMENTA,     6, CLOCK | MQ },
    { "AUTO, M(q)",        GVI_AUTO,        8, DRAG | MQ },
    { "Newton",            GVI_NEWTON,      4, HESSIAN | DIAGONAL },
    { "Newton, L",         GVI_NEWTON,      4, DRAG | QUARTIC | DIAGONAL },
    { "Newton, M(q)",      GVI_NEWTON,      4, DRAG | MQ },
    { "rods",              GVI_POSITIONS,   4, RODS | DIAGONAL },
    { "rods, drag",        GVI_VELOCITIES,  4, RODS | DRAG | DIAGONAL },
    { "rods, momenta",     GVI_MOMENTA,     4, RODS | DRAG | DIAGONAL },
    { "RATTLE",            GVI_EXPLICIT,    1, RODS | DIAGONAL } };

/* Every callback at coordinate i, point k: its own sizes are o, the numbers at `at` */
#define EACH(x, user) \
    const own *o = (const own *)(user); \
    for (int i = 0; i < (x)->n; ++i, ++o) \
        for (int k = 0, at = i*(x)->stride; k < (x)->count; ++k, ++at)

static int soft(const gvi_points *x, void *user)
{
    EACH(x, user) {
        const real q = x->q[at], z = q/o->length;
        if (x->f) x->f[at] -= o->mass*(o->k*q + o->cubic*z*z*q);
        if (x->value) x->value[k] += o->mass*(o->k*q*q/2 + o->cubic*z*z*q*q/4);
    }
    return 0;
}

static int hessian_size;                                   // which a Hessian is not told

static int soft_hessian(real t, const real *q, const real *v, real *fq, real *fv, real *pv, void *user)
{
    const own *o = (const own *)user;
    for (int i = 0; i < hessian_size; ++i, ++o)
        fq[i*(hessian_size + 1)] -= o->mass*(o->k + 3*o->cubic*(q[i]/o->length)*(q[i]/o->length));
    return 0;
}

static int own_drag(const gvi_points *x, void *user)
{
    EACH(x, user) {
        const real v = x->v[at]/o->length;
        x->f[at] -= o->mass*o->length*o->drag*(v + v*v*v);
    }
    return 0;
}

static int own_quartic(const gvi_points *x, void *user)
{
    EACH(x, user) {
        const real v = x->v[at]/o->length;
        x->dldv[at] += o->mass*o->length*v*v*v/64;
    }
    return 0;
}

/* m (1 + (q/l)^2/4) */
static int own_mass(const gvi_points *x, void *user)
{
    EACH(x, user) for (int j = 0; j <= i; ++j) {
        const real z = x->q[at]/o->length;
        x->mass[(i*x->n + j)*x->stride + k] = i == j ? o->mass*(1 + z*z/4) : 0;
    }
    return 0;
}

static int own_gradient(const gvi_points *x, void *user)
{
    EACH(x, user) x->f[at] += o->mass*(x->q[at]/o->length)*(x->v[at]/o->length)*x->v[at]/4;
    return 0;
}

static int own_velocity(const gvi_points *x, void *user)
{
    EACH(x, user) {
        const real z = x->q[at]/o->length;
        x->velocity[at] = x->p[at]/(o->mass*(1 + z*z/4));
    }
    return 0;
}

GVI_EACH(steady, 1, value) { x->value[0] += (real)1.25L; }

/* pairs at the end of a rod of their length, and a weight */
static int rods(const gvi_points *x, void *user)
{
    EACH(x, user) {
        const int row = i/2;
        const real q = x->q[at], r = x->q[at + (i % 2 ? -x->stride : x->stride)];
        if (i % 2 == 0) x->g[row*x->stride + k] = (q*q + r*r)/o->length - o->length;
        x->jacobian[(row*x->n + i)*x->stride + k] = 2*q/o->length;
    }
    return 0;
}

static int own_weight(const gvi_points *x, void *user)
{
    EACH(x, user) if (i % 2) x->f[at] -= o->mass*o->k*o->length;
    return 0;
}

/* Twelve steps of coordinates first to first + n - 1; z: q, then p, of each step.  The number of the step that
   failed, or -1 */
static int run_form(const form *f, int first, int n, const real *q, const real *v, real h, real *z)
{
    static real m[PLACES*PLACES];
    own *user = owns + first;
    gvi_effect scene[4] = { { .kind = GVI_POTENTIAL, .points = soft, .value = soft, .user = user,
                              .hessian = f->with & HESSIAN ? soft_hessian : NULL } };
    gvi_desc d = { .n = n, .degree = f->degree, .effects = scene, .effect_count = 1, .formulation = f->f };
    if (f->f == GVI_EXPLICIT) d.rule = (gvi_rule){ .kind = GVI_LOBATTO, .points = 2 };
    if (f->with & RODS) {
        scene[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = own_weight, .user = user };
        scene[d.effect_count++] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = rods, .rows = n/2, .user = user };
    }
    if (f->with & DRAG) scene[d.effect_count++] = (gvi_effect){ .kind = GVI_FORCE, .points = own_drag, .user = user };
    if (f->with & QUARTIC)
        scene[d.effect_count++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = own_quartic, .user = user };
    if (f->with & CLOCK) scene[d.effect_count++] = (gvi_effect){ .kind = GVI_CLOCK, .points = steady, .value = steady };
    hessian_size = n;
    memset(m, 0, sizeof m);
    for (int i = 0; i < n; ++i) m[f->with & DENSE ? i*(n + 1) : i] = owns[first + i].mass;
    if (f->with & (DENSE | DIAGONAL))
        d.mass = (gvi_mass){ .kind = f->with & DENSE ? GVI_MASS_DENSE : GVI_MASS_DIAGONAL, .matrix = m };
    if (f->with & MQ)
        d.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = own_mass, .gradient = own_gradient, .user = user,
                             .velocity = f->with & SPEED ? own_velocity : NULL };
    gvi_stepper st = new_motion(&d, 0, q, v);
    for (int k = 0; k < 12; ++k, z += 2*n) {
        if (gvi_step(&st, h) != GVI_OK) return k;
        memcpy(z, st.q, sizeof(real)*(size_t)n);
        memcpy(z + n, st.p, sizeof(real)*(size_t)n);
    }
    return -1;
}

static real between(real lo, real hi)
{
    dice = dice*6364136223846793005ull + 1442695040888963407ull;
    return lo + (hi - lo)*(real)(dice >> 40)/(real)(1 << 24);
}

/* sizes in order, in the opposite one, or at random; masses that differ by 1e20, in float 1e10 */
static void draw(const form *f, int seed, real *q, real *v)
{
    const double span = KIND == 1 ? 5 : 13;
    dice = 977*(unsigned)seed + 13;
    for (int i = 0; i < PLACES; ++i) {
        const double at = span*(f->with & RODS ? i/2 : i%SIZES)/(SIZES - 1);
        const double e = seed % 3 == 0 ? at : seed % 3 == 1 ? span - at : span*(double)between(0, 1);
        const real w = between((real)0.3L, 2);
        own *o = owns + i;
        *o = (own){ .mass = 1, .k = w*w, .cubic = between(0, w*w/4), .drag = between(0, (real)0.25L) };
        if (seed % 2 && f->with & (DIAGONAL | DENSE | MQ))
            o->mass = (real)pow(10, KIND == 1 ? (double)between(-5, 5) : (double)between(-10, 10));
        o->length = (real)(pow(10, -e)/sqrt((double)o->mass));   // an amplitude is |q| sqrt(m)
        q[i] = between(-1, 1)*(seed % 5 == 4 && i % 4 == 2 ? 0 : o->length);
        v[i] = between(-1, 1)*(seed % 5 == 4 && i % 4 == 1 ? 0 : o->length);
        if (!(f->with & RODS) || i % 2 == 0) continue;
        const double turn = (double)between(-4, 0);
        const real spin = between((real)-0.5L, (real)0.5L);
        *o = o[-1];
        q[i - 1] = o->length*(real)cos(turn), q[i] = o->length*(real)sin(turn);
        v[i - 1] = -spin*q[i], v[i] = spin*q[i - 1];
    }
}

/* 12 steps round each number some times: 32 units of its last place; rods fall by unstable places, too, and at long
   steps contract slowly, or not at all */
TEST(each_of_any_size_moves_as_alone)
{
    static real all[24*PLACES], one[48], q[PLACES], v[PLACES];
    for (int f = 0; f < COUNT(forms); ++f) {
        const int each = forms[f].with & RODS ? 2 : 1, n = each*SIZES;
        const real allowed = (each == 2 ? 4096 : 32)*EPS;
        int compared = 0;
        for (int seed = 0; seed < 24; seed += THINNED) {
            draw(&forms[f], seed, q, v);
            const real h = each == 2 ? between((real)0.02L, (real)0.45L) : between((real)0.05L, (real)0.6L);
            const int failed = run_form(&forms[f], 0, n, q, v, h, all);
            for (int i = 0; i < n; i += each) {
                if (run_form(&forms[f], i, each, q + i, v + i, h, one) >= 0 || failed >= 0) {
                    if (each == 2) continue;
                    fail_msg("%s, seed %d, h = %Lg: step %d fails", forms[f].name, seed, (long double)h, failed);
                }
                ++compared;
                for (int k = 0; k < 24*each; ++k) {        // steps, q or p, coordinates
                    const int at = k/each*n + i + k % each;
                    const real size = owns[i].length*(k/each % 2 ? owns[i].mass : 1);
                    if (!(fabsl((long double)(all[at] - one[k])) <= (long double)(allowed*size)))
                        fail_msg("%s, seed %d, h = %Lg: coordinate %d of size %Lg is %.17Lg, alone %.17Lg", forms[f].name,
                                 seed, (long double)h, i, (long double)size, (long double)all[at], (long double)one[k]);
                }
            }
        }
        assert_true(compared > 24/THINNED*SIZES/4);
    }
}

/* 0: driven by the time, and a weak spring: its first change is its whole motion, its next ones are nothing.
   1: a spring about 1, whose changes are the last places of 1 */
typedef struct hidden { real weak, k; } hidden;

static int driven_and_still(const gvi_points *x, void *user)
{
    const hidden *a = (const hidden *)user;
    for (int k = 0; k < x->count; ++k) {
        x->f[k] += 100*(real)sin((double)(7*x->t[k])) - a->weak*x->q[k];
        x->f[x->stride + k] -= a->k*(x->q[x->stride + k] - 1);
    }
    return 0;
}

/* The change of all falls from that of 0 to that of 1: no ratio of the two is a contraction.  Of degree 1 a step is
   the midpoint rule: x1 (1 + a) = x0 (1 - a) + h p0, a = k h^2/4 */
TEST(a_row_that_falls_fast_does_not_end_the_iteration_of_another)
{
    const real h = (real)0.25L;
    for (int weak = 0; weak < 20; ++weak)
    for (int spring = 1; spring < 13; ++spring)
    for (int far = 1; far < DIG/2; ++far) {
        hidden z = { (real)ldexp(1, -weak), (real)spring };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = driven_and_still, .user = &z } };
        const gvi_desc d = { .n = 2, .degree = 1, .effects = scene, .effect_count = 1, .formulation = GVI_POSITIONS };
        const real off = (real)ldexp((double)EPS, far), q[] = { 0, 1 + off }, v[] = { 0, off };
        gvi_stepper st = new_motion(&d, 0, q, v);
        for (int step = 0; step < 6; ++step) {
            const long double x = (st.q[1] - 1) + (long double)st.q_low[1], p = st.p[1] + (long double)st.p_low[1],
                              a = z.k*h*h/4.0L, x1 = ((1 - a)*x + h*p)/(1 + a);
            assert_ok(gvi_step(&st, h));
            assert_close((st.q[1] - 1) + (long double)st.q_low[1], x1, 4*EPS);
        }
    }
}

/* a hundred thousand, 1/h = 5 and 1/h = 2 of their periods among them */
TEST(a_hundred_thousand_move_as_alone)
{
    enum { N = 100000 };
    real *z = (real *)malloc(sizeof(real)*2*N), one[2];
    own *many = (own *)malloc(sizeof(own)*N);
    gvi_effect scene = { .kind = GVI_POTENTIAL, .points = soft, .user = many };
    gvi_desc d = { .n = N, .degree = 4, .effects = &scene, .effect_count = 1, .formulation = GVI_POSITIONS };
    gvi_real *memory = (gvi_real *)malloc(gvi_size(&d));
    gvi_stepper st;
    dice = 7;
    for (int i = 0; i < N; ++i) {
        const real w = between((real)0.1L, 2);
        many[i] = (own){ (real)pow(10, -(KIND == 1 ? 5 : 13)*(double)between(0, 1)), 1, w*w, w*w/4, 0 };
        z[i] = many[i].length;
        z[N + i] = between(-1, 1)*many[i].length;
    }
    assert_ok(gvi_init(&st, &d, memory, gvi_size(&d)));
    assert_ok(gvi_start(&st, 0, z, z + N));
    for (int k = 0; k < 3; ++k) assert_ok(gvi_step(&st, (real)0.4L));
    d.n = 1;
    for (int i = 0; i < N; i += 97) {
        scene.user = many + i;
        gvi_stepper alone = new_motion(&d, 0, z + i, z + N + i);
        for (int k = 0; k < 3; ++k) assert_ok(gvi_step(&alone, (real)0.4L));
        one[0] = alone.q[0], one[1] = alone.p[0];
        assert_close(st.q[i], one[0], 8*EPS*many[i].length);
        assert_close(st.p[i], one[1], 8*EPS*many[i].length);
    }
    free(memory);
    free(many);
    free(z);
}

enum { BODIES = 9, SPRINGS = 6, SPACE = 3*BODIES + SPRINGS };
typedef struct sky { int bodies; real mass[BODIES]; } sky;

/* gravity, and behind the bodies springs of constant 1, 2, .. */
static int heavens(const gvi_points *x, void *user)
{
    const sky *s = (const sky *)user;
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        for (int a = 0; a < s->bodies; ++a)
            for (int b = 0; b < a; ++b) {
                const real *A = x->q + 3*a*R + k, *B = x->q + 3*b*R + k;
                const real d[3] = { B[0] - A[0], B[R] - A[R], B[2*R] - A[2*R] };
                const real r2 = d[0]*d[0] + d[1]*d[1] + d[2]*d[2], w = s->mass[a]*s->mass[b]/(r2*(real)sqrtl((long double)r2));
                for (int c = 0; c < 3 && x->f; ++c) {
                    x->f[(3*a + c)*R + k] += w*d[c];
                    x->f[(3*b + c)*R + k] -= w*d[c];
                }
                if (x->value) x->value[k] -= w*r2;
            }
        for (int i = 3*s->bodies; i < x->n; ++i) {
            const real spring = (real)(i - 3*s->bodies + 1), q = x->q[i*R + k];
            if (x->f) x->f[i*R + k] -= spring*q;
            if (x->value) x->value[k] += spring*q*q/2;
        }
    }
    return 0;
}

static int thin_air(const gvi_points *x, void *user)
{
    for (int i = 0; i < 3; ++i)                            // on the body in the middle alone
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= ((sky *)user)->mass[0]*x->v[i*x->stride + k]/64;
    return 0;
}

/* A body in the middle of `pairs` pairs, each pair opposite: nothing pulls it, but for rounding.  Beside them springs
   of amplitude 1 to 1e-10 (float: 1e-5), whose motion is a cosine. */
static void symmetric(const form *f, int pairs, int seed)
{
    static real memory[2000000], m[SPACE], q[SPACE], v[SPACE];
    sky s = { .bodies = 1 + 2*pairs };
    const int n = 3*s.bodies + SPRINGS;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = heavens, .value = heavens, .user = &s },
                                 { .kind = f->with & CLOCK ? GVI_CLOCK : GVI_FORCE, .points = f->with & CLOCK ? steady : thin_air,
                                   .value = f->with & CLOCK ? steady : NULL, .user = &s } };
    const gvi_desc d = { .n = n, .degree = f->degree, .effects = scene, .effect_count = f->with & (CLOCK | DRAG) ? 2 : 1,
                         .formulation = f->f, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m } };
    const real away = seed % 3 == 2 ? (real)0.7L : 0, drift = seed % 4 == 3 ? (real)0.25L : 0;
    dice = (unsigned)seed + 5;
    s.mass[0] = seed % 2 ? 1 : (real)pow(10, -(double)seed/2 - 1);
    for (int b = 0; b < s.bodies; ++b) {
        const double turn = seed + (b + 1)/2*2.4, r = 1 + (b + 1)/2*0.5, w = sqrt((seed % 2 ? 1 : (double)pairs)/r);
        const real sign = b == 0 ? 0 : b % 2 ? 1 : -1;
        if (b > 0) s.mass[b] = seed % 2 ? (real)0.001L : 1;
        q[3*b] = away + sign*(real)(r*cos(turn)), v[3*b] = drift - sign*(real)(w*sin(turn));
        q[3*b + 1] = away + sign*(real)(r*sin(turn)), v[3*b + 1] = sign*(real)(w*cos(turn));
        q[3*b + 2] = sign*(real)0.125L, v[3*b + 2] = 0;
    }
    for (int i = 0; i < 3*s.bodies; ++i) m[i] = s.mass[i/3];
    for (int i = 3*s.bodies; i < n; ++i) m[i] = 1, v[i] = 0, q[i] = (real)pow(10, -(KIND == 1 ? 1 : 2)*(i - 3*s.bodies));
    assert_true(gvi_size(&d) <= sizeof memory);
    gvi_stepper st = new_motion(&d, 0, q, v);
    const int steps = f->f == GVI_NEWTON ? 10 : 40;        // each asks for n times as many points
    for (int k = 0; k < steps; ++k)
        if (gvi_step(&st, (real)0.03L) != GVI_OK)
            fail_msg("%s, %d pairs, seed %d, step %d: %s", f->name, pairs, seed, k, gvi_why(&st));
    for (int i = 0; i < SPRINGS; ++i)
        assert_close(st.q[3*s.bodies + i]/q[3*s.bodies + i], cosl(sqrtl(i + 1)*(long double)st.t), 32*(long double)EPS + 1e-15L);
}

TEST(where_forces_cancel_nothing_is_refused)
{
    static const form skies[] = { { "positions", GVI_POSITIONS, 8, 0 }, { "degree 16", GVI_POSITIONS, 16, 0 },
        { "AUTO", GVI_AUTO, 8, DRAG }, { "velocities", GVI_VELOCITIES, 8, DRAG }, { "momenta", GVI_MOMENTA, 6, DRAG },
        { "a clock", GVI_MOMENTA, 6, CLOCK }, { "Newton", GVI_NEWTON, 5, 0 } };
    static const int seeds[] = { 0, 5, 10, 11 };           // heavy or light, away from 0 or not, at rest or not
    for (int f = 0; f < COUNT(skies); ++f)
        for (int pairs = 1; pairs <= 4; pairs += 3)
            for (int k = 0; k < COUNT(seeds); k += THINNED) symmetric(&skies[f], pairs, seeds[k]);
}

/* A weak spring about 1, and a push in time alone, whose first iteration is its last */
static int calm_and_pushed(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        x->f[k] -= (x->q[k] - 1)/2;
        x->f[x->stride + k] += 1000*x->t[k];
    }
    return (void)user, 0;
}

/* The change of all rows falls from 1 to that of the slow one, which looks like a fast descent. */
TEST(a_row_that_is_done_does_not_speak_for_another)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = calm_and_pushed } };
    const gvi_desc d = { .n = 2, .degree = 6, .effects = scene, .effect_count = 1 };
    gvi_stepper st = new_stepper(&d);
    for (long double away = 1e-3L; away > EPS; away /= 2) {
        const real q[] = { 1 + (real)away, 1 }, v[] = { 0, 0 };
        const long double h = 0.125L, w = sqrtl(0.5L), off = (long double)q[0] - 1;
        assert_ok(gvi_start(&st, 0, q, v));
        assert_ok(gvi_step(&st, (real)h));
        // the force sees Q rounded
        assert_close(st.q[0] + (long double)st.q_low[0], 1 + off*cosl(w*h), w*w*h*h/2*EPS + 4*LDBL_EPSILON);
    }
}

RUN_TESTS(NULL, NULL)
