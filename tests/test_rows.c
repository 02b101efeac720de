/* What lies behind the points of a row, from count to stride: a state of the scene, which a
   callback may go on to.  Every formulation, clock, M(q), stiffness and query is run twice,
   with callbacks that end at count and with ones that go on and leave numbers there: not one
   bit may differ.  The states behind are looked at: q is where the step began.  */
#include "gvi_test.h"

typedef gvi_real real;

enum { N = 3, STEPS = 12 };

/* what the callbacks are told, and what they saw */
typedef struct watch {
    const real *start;          /* of the step, or NULL in queries: then q is not compared */
    real        near;           /* how far q may be from there */
    int         whole, behind;  /* go on?  numbers seen behind count */
} watch;

static int end_of(const gvi_points *x, const watch *w) { return w->whole ? x->stride : x->count; }

static int is_finite(real x) { return x - x == 0; }

static void look_behind(const gvi_points *x, watch *w)
{
    for (int k = x->count; k < x->stride; ++k)
        for (int i = 0; i < x->n; ++i) {
            const int at = i*x->stride + k;
            if (!(is_finite(x->t[k]) && is_finite(x->q[at]) && (!x->v || is_finite(x->v[at]))))
                fail_msg("a state behind the points: t %Lg, q %Lg", (long double)x->t[k], (long double)x->q[at]);
            if (w->start && !(fabsl((long double)(x->q[at] - w->start[i])) <= (long double)w->near))
                fail_msg("behind the points q_%d is %Lg, not %Lg", i, (long double)x->q[at], (long double)w->start[i]);
            ++w->behind;
        }
}

/* leaves at the points behind what would be seen if it were read */
static void litter(const gvi_points *x, const watch *w)
{
    for (int k = x->count; k < end_of(x, w); ++k)
        for (int i = 0; i < x->n; ++i) {
            x->f[i*x->stride + k] += (real)(1000 + 7*i + k);
            if (x->dldv) x->dldv[i*x->stride + k] += (real)(500 - i);
        }
}

/* -1/|q - (0, 0, 3)|, with value */
static int attraction(const gvi_points *x, void *user)
{
    const int R = x->stride;
    look_behind(x, user);
    for (int k = 0; k < end_of(x, user); ++k) {
        const real a = x->q[k], b = x->q[R + k], c = x->q[2*R + k] - 3;
        const real d = (real)1/(real)sqrtl((long double)(a*a + b*b + c*c)), g = d*d*d;
        if (x->f) x->f[k] -= g*a, x->f[R + k] -= g*b, x->f[2*R + k] -= g*c;
        if (x->value) x->value[k] -= d;
    }
    if (x->f) litter(x, user);
    return 0;
}

/* k q_2^2/2, told as stiffness */
static int stiff_spring(const gvi_points *x, void *user)
{
    const real *q = x->q + 2*x->stride;
    look_behind(x, user);
    for (int k = 0; k < end_of(x, user); ++k) {
        if (x->f) x->f[2*x->stride + k] -= 100*q[k];
        if (x->value) x->value[k] += 50*q[k]*q[k];
    }
    return 0;
}

static int drag(const gvi_points *x, void *user)
{
    look_behind(x, user);
    for (int k = 0; k < end_of(x, user); ++k)
        for (int i = 0; i < x->n; ++i) x->f[i*x->stride + k] -= x->v[i*x->stride + k]/16 - x->t[k]/64;
    litter(x, user);
    return 0;
}

/* L = (q_0 v_1 - q_1 v_0)/4, with value */
static int magnetic(const gvi_points *x, void *user)
{
    const int R = x->stride;
    look_behind(x, user);
    for (int k = 0; k < end_of(x, user); ++k) {
        const real a = x->q[k]/4, b = x->q[R + k]/4, u = x->v[k], w = x->v[R + k];
        if (x->f) x->f[k] += w/4, x->f[R + k] -= u/4;
        if (x->dldv) x->dldv[k] -= b, x->dldv[R + k] += a;
        if (x->value) x->value[k] += a*w - b*u;
    }
    if (x->f && x->dldv) litter(x, user);
    return 0;
}

static int distance(const gvi_points *x, void *user)
{
    const int R = x->stride;
    look_behind(x, user);
    for (int k = 0; k < end_of(x, user); ++k) {
        const real a = x->q[k], b = x->q[R + k], g = (real)sqrtl((long double)(a*a + b*b));
        if (x->value) x->value[k] += g;
        if (x->f) x->f[k] += a/g, x->f[R + k] += b/g;
    }
    return 0;
}

/* M = diag(2 + q_1^2, 1, 1), and the same by v = M^-1 p */
static int mass(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < end_of(x, user); ++k)
        for (int i = 0; i < N; ++i)
            for (int j = 0; j <= i; ++j)
                x->mass[(i*N + j)*R + k] = i != j ? 0 : i > 0 ? 1 : 2 + x->q[R + k]*x->q[R + k];
    return 0;
}

static int mass_gradient(const gvi_points *x, void *user)
{
    const int R = x->stride;
    look_behind(x, user);
    for (int k = 0; k < end_of(x, user); ++k) {
        const real half = x->q[R + k]*x->v[k]*x->v[k];
        if (x->f) x->f[R + k] += half;
    }
    return 0;
}

static int mass_velocity(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < end_of(x, user); ++k) {
        const real m = 2 + x->q[R + k]*x->q[R + k];
        x->velocity[k] = x->p[k]/m;
        x->velocity[R + k] = x->p[R + k];
        x->velocity[2*R + k] = x->p[2*R + k];
    }
    return 0;
}

static const struct { const char *name; gvi_formulation f; int drag, magnetic, clock, mass, spring; real tolerance; }
runs[] = {
    { "positions",             GVI_POSITIONS,  0, 0, 0, 0, 0, 0 },
    { "with a tolerance",      GVI_POSITIONS,  0, 0, 0, 0, 0, (real)1e-5L },
    { "stiffness",             GVI_POSITIONS,  0, 0, 0, 0, 1, 0 },
    { "drag",                  GVI_VELOCITIES, 1, 0, 0, 0, 0, 0 },
    { "drag, stiffness",       GVI_VELOCITIES, 1, 0, 0, 0, 1, (real)1e-5L },
    { "a Lagrangian term",     GVI_VELOCITIES, 1, 1, 0, 0, 0, 0 },
    { "momenta",               GVI_MOMENTA,    1, 0, 0, 0, 0, 0 },
    { "momenta, Lagrangian",   GVI_MOMENTA,    1, 1, 0, 0, 0, 0 },
    { "a clock",               GVI_MOMENTA,    1, 0, 1, 0, 0, 0 },
    { "M(q)",                  GVI_MOMENTA,    1, 0, 0, 1, 0, (real)1e-5L },
    { "v = M(q)^-1 p",         GVI_MOMENTA,    1, 0, 0, 2, 0, 0 },
    { "M(q) and a clock",      GVI_MOMENTA,    0, 0, 1, 1, 0, 0 },
    { "Newton",                GVI_NEWTON,     1, 1, 0, 0, 0, 0 },
    { "Newton, M(q)",          GVI_NEWTON,     1, 0, 0, 1, 0, 0 },
};

enum { KEPT = 32 };

static void take(real *kept, int *used, const real *x, int n)
{
    for (int i = 0; i < n; ++i) kept[(*used)++] = x[i];
}

/* a run, with its queries; what they gave goes to kept */
static void run(int which, int degree, watch *w, real *kept)
{
    static real memory[GVI_LENGTH(N, 16, 16)];
    static const real q0[N] = { 1, (real)0.25L, (real)0.125L }, v0[N] = { (real)-0.25L, (real)0.5L, (real)0.25L };
    gvi_effect scene[5];
    gvi_stepper st;
    int n = 0, used = 0;
    real q[N], v[N], p[N], one, stiffness[N] = { 0, 0, 100 };
    memset(scene, 0, sizeof scene);
    scene[n++] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = attraction, .value = attraction, .user = w };
    if (runs[which].drag) scene[n++] = (gvi_effect){ .kind = GVI_FORCE, .points = drag, .user = w };
    if (runs[which].magnetic)
        scene[n++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = magnetic, .value = magnetic, .user = w };
    if (runs[which].clock) scene[n++] = (gvi_effect){ .kind = GVI_CLOCK, .points = distance, .value = distance, .user = w };
    if (runs[which].spring)
        scene[n++] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = stiff_spring, .value = stiff_spring, .user = w };
    gvi_desc d = { .n = N, .degree = degree, .effects = scene, .effect_count = n, .tolerance = runs[which].tolerance,
                   .formulation = runs[which].f, .stiffness = runs[which].spring ? stiffness : NULL };
    if (runs[which].mass) {
        d.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient, .user = w };
        if (runs[which].mass == 2) d.mass.velocity = mass_velocity;
    }
    assert_true(gvi_size(&d) <= sizeof memory);
    assert_int_equal(gvi_init(&st, &d, memory, sizeof memory), GVI_OK);
    w->start = NULL;
    assert_int_equal(gvi_start(&st, 0, q0, v0), GVI_OK);
    for (int k = 0; k < STEPS; ++k) {
        w->start = st.q;
        assert_int_equal(gvi_step(&st, k < 8 ? (real)0.125L : (real)0.1L), GVI_OK);
    }
    w->start = NULL;
    take(kept, &used, st.q, N);
    take(kept, &used, st.p, N);
    take(kept, &used, &st.t, 1);
    if (!runs[which].clock) {
        assert_int_equal(gvi_state_at(&st, st.t - (real)0.03L, q, v, p), GVI_OK);
        take(kept, &used, q, N);
        take(kept, &used, v, N);
        take(kept, &used, p, N);
        assert_int_equal(gvi_action(&st, &one), GVI_OK);
        take(kept, &used, &one, 1);
    }
    assert_int_equal(gvi_energy(&st, &one), GVI_OK);
    take(kept, &used, &one, 1);
    one = (real)(st.counters.iterations + st.counters.newton_iterations);
    take(kept, &used, &one, 1);
    assert_true(used <= KEPT);
}

static void what_is_behind_the_points_is_not_read(void **state)
{
    static const int degrees[] = { 3, 5, 6, 7, 8, 9, 12, 16 };
    (void)state;
    for (int i = 0; i < COUNT(runs); ++i)
        for (int j = 0; j < COUNT(degrees); ++j) {
            real plain[KEPT] = { 0 }, whole[KEPT] = { 0 };
            watch w = { .near = 64*EPS };
            run(i, degrees[j], &w, plain);
            w.whole = 1;
            w.behind = 0;
            run(i, degrees[j], &w, whole);
            for (int k = 0; k < KEPT; ++k)
                if (memcmp(&plain[k], &whole[k], sizeof(real) > 10 ? 10 : sizeof(real)))
                    fail_msg("%s, degree %d, number %d: %.17Lg, and %.17Lg with what is behind", runs[i].name,
                             degrees[j], k, (long double)plain[k], (long double)whole[k]);
            assert_int_equal(w.behind > 0, degrees[j] > 4 && degrees[j] % 8 != 0);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(what_is_behind_the_points_is_not_read) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
