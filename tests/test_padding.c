/* What lies behind the points of a row, from count to stride: t and q of the step's start, which a
   callback may go on to.  Every formulation, mass, clock and query is run twice, with callbacks that
   end at count and with ones that go on and leave NaN there: not one bit may differ. */
#include "gvi_test.h"

enum { N = 3, STEPS = 12, MOST = 24 };

/* what the callbacks are told, and what they saw */
typedef struct watch {
    real start[2][N], t[2];     /* of the step; of queries that may begin at its end, too */
    real near;                  /* how far q may be from there */
    int  whole, behind;         /* go on?  numbers seen behind count */
    int  bad;                   /* the drag is NaN in coordinate 1 at point 2 */
} watch;

static int end_of(const gvi_points *x, const watch *w) { return w->whole ? x->stride : x->count; }

/* is it one of the two, given that both are of one state? */
static int is_start(const gvi_points *x, const watch *w, int k)
{
    for (int from = 0; from < 2; ++from) {
        int is = fabsl((long double)(x->t[k] - w->t[from])) <= (long double)w->near;
        for (int i = 0; i < x->n; ++i)
            is &= fabsl((long double)(x->q[i*x->stride + k] - w->start[from][i])) <= (long double)w->near;
        if (is) return 1;
    }
    return 0;
}

static void look_behind(const gvi_points *x, watch *w)
{
    for (int k = x->count; k < x->stride; ++k, ++w->behind)
        if (!is_start(x, w, k))
            fail_msg("behind the points t is %Lg, q %Lg, %Lg, %Lg", (long double)x->t[k], (long double)x->q[k],
                     (long double)x->q[x->stride + k], (long double)x->q[2*x->stride + k]);
}

/* leaves at the points behind what would be seen if it were read */
static void litter(const gvi_points *x, const watch *w)
{
    for (int k = x->count; k < end_of(x, w); ++k) {
        if (x->value) x->value[k] += (real)NAN;
        for (int i = 0; i < x->n; ++i) {
            if (x->f) x->f[i*x->stride + k] += (real)NAN;
            if (x->dldv) x->dldv[i*x->stride + k] += (real)NAN;
            if (x->velocity) x->velocity[i*x->stride + k] = (real)NAN;
            for (int j = 0; j <= i && x->mass; ++j) x->mass[(i*x->n + j)*x->stride + k] = (real)NAN;
        }
    }
}

/* a law at point k, and at all that are to be computed */
typedef void law(const gvi_points *x, int R, int k);

static int at_points(const gvi_points *x, watch *w, law *at)
{
    look_behind(x, w);
    for (int k = 0; k < end_of(x, w); ++k) at(x, x->stride, k);
    litter(x, w);
    return 0;
}

/* -1/|q - (0, 0, 3)|, with value */
static void attraction_at(const gvi_points *x, int R, int k)
{
    const real a = x->q[k], b = x->q[R + k], c = x->q[2*R + k] - 3;
    const real d = (real)1/(real)sqrtl((long double)(a*a + b*b + c*c)), g = d*d*d;
    if (x->f) x->f[k] -= g*a, x->f[R + k] -= g*b, x->f[2*R + k] -= g*c;
    if (x->value) x->value[k] -= d;
}

static void drag_at(const gvi_points *x, int R, int k)
{
    for (int i = 0; i < x->n; ++i) x->f[i*R + k] -= x->v[i*R + k]/16 - x->t[k]/64;
}

/* L = (q_0 v_1 - q_1 v_0)/4, with value */
static void magnetic_at(const gvi_points *x, int R, int k)
{
    const real a = x->q[k]/4, b = x->q[R + k]/4, u = x->v[k], w = x->v[R + k];
    if (x->f) x->f[k] += w/4, x->f[R + k] -= u/4;
    if (x->dldv) x->dldv[k] -= b, x->dldv[R + k] += a;
    if (x->value) x->value[k] += a*w - b*u;
}

/* the clock's g = |(q_0, q_1)| */
static void distance_at(const gvi_points *x, int R, int k)
{
    const real a = x->q[k], b = x->q[R + k], g = (real)sqrtl((long double)(a*a + b*b));
    if (x->value) x->value[k] += g;
    if (x->f) x->f[k] += a/g, x->f[R + k] += b/g;
}

/* M = diag(2 + q_1^2, 1, 1), v' dM/dq v/2, and v = M^-1 p */
static void mass_at(const gvi_points *x, int R, int k)
{
    for (int i = 0; i < N; ++i)
        for (int j = 0; j <= i; ++j)
            x->mass[(i*N + j)*R + k] = i != j ? 0 : i > 0 ? 1 : 2 + x->q[R + k]*x->q[R + k];
}

static void gradient_at(const gvi_points *x, int R, int k)
{
    if (x->f) x->f[R + k] += x->q[R + k]*x->v[k]*x->v[k];
}

static void velocity_at(const gvi_points *x, int R, int k)
{
    for (int i = 0; i < N; ++i) x->velocity[i*R + k] = x->p[i*R + k]/(i > 0 ? 1 : 2 + x->q[R + k]*x->q[R + k]);
}

static int attraction(const gvi_points *x, void *user) { return at_points(x, user, attraction_at); }
static int magnetic(const gvi_points *x, void *user) { return at_points(x, user, magnetic_at); }
static int distance(const gvi_points *x, void *user) { return at_points(x, user, distance_at); }
static int mass(const gvi_points *x, void *user) { return at_points(x, user, mass_at); }
static int mass_gradient(const gvi_points *x, void *user) { return at_points(x, user, gradient_at); }
static int mass_velocity(const gvi_points *x, void *user) { return at_points(x, user, velocity_at); }

static int drag(const gvi_points *x, void *user)
{
    const watch *w = user;
    at_points(x, user, drag_at);
    if (w->bad && x->count > 2) x->f[x->stride + 2] = (real)NAN;
    return 0;
}

enum { DRAG = 1, MAGNETIC = 2, CLOCK = 4, MASS = 8, SPEED = 16, DIAGONAL = 32, DENSE = 64,
       LOBATTO = 128, MORE = 256, COARSE = 512 };

static const struct { const char *name; gvi_formulation f; int with; } runs[] = {
    { "positions",             GVI_POSITIONS,  0 },
    { "a tolerance",           GVI_POSITIONS,  COARSE },
    { "masses",                GVI_POSITIONS,  DIAGONAL },
    { "a full mass",           GVI_POSITIONS,  DENSE },
    { "more points, masses",   GVI_POSITIONS,  DIAGONAL | MORE },
    { "drag",                  GVI_VELOCITIES, DRAG },
    { "drag, Lobatto",         GVI_VELOCITIES, DRAG | LOBATTO | COARSE },
    { "momenta",               GVI_MOMENTA,    DRAG },
    { "momenta, masses",       GVI_MOMENTA,    DRAG | DIAGONAL },
    { "momenta, a full mass",  GVI_MOMENTA,    DRAG | DENSE },
    { "momenta, Lagrangian",   GVI_MOMENTA,    DRAG | MAGNETIC },
    { "a clock",               GVI_MOMENTA,    DRAG | CLOCK },
    { "M(q)",                  GVI_MOMENTA,    DRAG | MASS | COARSE },
    { "v = M(q)^-1 p",         GVI_MOMENTA,    DRAG | MASS | SPEED },
    { "M(q) and a clock",      GVI_MOMENTA,    MASS | CLOCK },
    { "Newton",                GVI_NEWTON,     DRAG | MAGNETIC },
    { "Newton, M(q)",          GVI_NEWTON,     DRAG | MASS },
};

enum { KEPT = 48 };

static void take(real *kept, int *used, const real *x, int n)
{
    for (int i = 0; i < n; ++i) kept[(*used)++] = x[i];
}

static void starts(watch *w, int from, const gvi_stepper *st)
{
    w->t[from] = st->t;
    for (int i = 0; i < N; ++i) w->start[from][i] = st->q[i];
}

static gvi_desc describe(int with, gvi_formulation f, int degree, gvi_effect *scene, watch *w)
{
    static const real full[] = { 2, 0, 0, (real)0.5L, 3, 0, (real)0.25L, 0, 1 };
    static const real masses[N] = { 100, 50, 2 };
    gvi_desc d = { .n = N, .degree = degree, .effects = scene, .formulation = f };
    memset(scene, 0, 5*sizeof *scene);
    scene[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = attraction, .value = attraction, .user = w };
    scene[1] = (gvi_effect){ .kind = GVI_FORCE, .points = drag, .user = w };
    d.effect_count = with & DRAG ? 2 : 1;
    if (with & MAGNETIC)
        scene[d.effect_count++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = magnetic, .value = magnetic, .user = w };
    if (with & CLOCK)
        scene[d.effect_count++] = (gvi_effect){ .kind = GVI_CLOCK, .points = distance, .value = distance, .user = w };
    if (with & MASS) d.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient, .user = w };
    if (with & SPEED) d.mass.velocity = mass_velocity;
    if (with & (DIAGONAL | DENSE)) {
        d.mass.kind = with & DENSE ? GVI_MASS_DENSE : GVI_MASS_DIAGONAL;
        d.mass.matrix = with & DENSE ? full : masses;
    }
    if (with & LOBATTO) d.rule = (gvi_rule){ .kind = GVI_LOBATTO, .points = degree + 1 };
    if (with & MORE) d.rule.points = degree + 4;
    if (with & COARSE) d.tolerance = (real)1e-5L;
    return d;
}

/* a run, with a step that fails, its queries, and steps back; what they gave goes to kept */
static void run(int which, int degree, watch *w, real *kept)
{
    static real memory[GVI_LENGTH(N, MOST, MOST)];
    static const real q0[N] = { 1, (real)0.25L, (real)0.125L }, v0[N] = { (real)-0.25L, (real)0.5L, (real)0.25L };
    const int with = runs[which].with;
    gvi_effect scene[5];
    gvi_stepper st;
    gvi_desc d = describe(with, runs[which].f, degree, scene, w);
    int used = 0;
    real q[N], v[N], p[N], one;
    assert_true(gvi_size(&d) <= sizeof memory);
    if (gvi_init(&st, &d, memory, sizeof memory) != GVI_OK)
        fail_msg("%s, degree %d: %s", runs[which].name, degree, gvi_why(&st));
    for (int i = 0; i < N; ++i) w->start[0][i] = w->start[1][i] = q0[i];
    w->t[0] = w->t[1] = 0;
    assert_int_equal(gvi_start(&st, 0, q0, v0), GVI_OK);
    for (int k = 0; k < STEPS; ++k) {
        starts(w, 0, &st);
        starts(w, 1, &st);
        w->bad = k == 6 && with & DRAG;
        if (w->bad) {
            if (gvi_step(&st, (real)0.125L) != GVI_E_NON_FINITE)
                fail_msg("%s, degree %d: NaN gives %s", runs[which].name, degree, gvi_why(&st));
            one = (real)(100*st.fault.effect + 10*st.fault.coordinate + st.fault.point);
            take(kept, &used, &one, 1);
            w->bad = 0;
        }
        if (gvi_step(&st, k < 8 ? (real)0.125L : (real)-0.1L) != GVI_OK)
            fail_msg("%s, degree %d, step %d%s: %s", runs[which].name, degree, k, w->whole ? ", whole" : "",
                     gvi_why(&st));
    }
    starts(w, 1, &st);
    take(kept, &used, st.q, N);
    take(kept, &used, st.p, N);
    take(kept, &used, &st.t, 1);
    if (!(with & CLOCK)) {
        assert_int_equal(gvi_state_at(&st, st.t + (real)0.03L, q, v, p), GVI_OK);
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

static void compare(const char *name, int degree, const real *plain, const real *whole)
{
    for (int k = 0; k < KEPT; ++k)
        if (!(plain[k] == whole[k] && !signbit(plain[k]) == !signbit(whole[k])))
            fail_msg("%s, degree %d, number %d: %.17Lg, and %.17Lg with what is behind", name, degree, k,
                     (long double)plain[k], (long double)whole[k]);
}

TEST(what_is_behind_the_points_is_not_read)
{
    static const int degrees[] = { 3, 5, 6, 7, 8, 9, 12, 16, 18 };
    for (int i = 0; i < COUNT(runs); ++i) {
        int behind = 0;
        for (int j = 0; j < COUNT(degrees); ++j) {
            real plain[KEPT] = { 0 }, whole[KEPT] = { 0 };
            watch w = { .near = 256*EPS };
            run(i, degrees[j], &w, plain);
            w.whole = 1;
            w.behind = 0;
            run(i, degrees[j], &w, whole);
            compare(runs[i].name, degrees[j], plain, whole);
            behind += w.behind;
        }
#ifndef __OPTIMIZE_SIZE__                                  /* small code has rows of r numbers */
        assert_true(behind > 0);
#endif
    }
}

RUN_TESTS(NULL, NULL)
