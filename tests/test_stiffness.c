/* desc.stiffness: coordinates on arcs.  Expected is what theory says of the method: the exact
   rotation where the spring is all there is, the order, the symplectic form, the generating
   function; and an extrapolated midpoint rule in long double for where the motion goes.  */
#include "gvi_test.h"

typedef long double real;
#define EXTRAPOLATE_MOST 16
#include "hard/extrapolate.h"
#include "splittings.h"

/* ---------------------------------------------------------------- the scene

   Four masses, each on a spring of its own, in a row with soft quartic springs between; a weak
   quartic trough; drag; a magnetic field, L = B (q0 v1 - q1 v0)/2.             */

enum { N = 4, TABLES = 8 };
static const gvi_real mass[N] = { 1, 2, (gvi_real)0.5L, 1 }, k[N] = { 0, 400, 900, 400 };
static const gvi_real q0[N] = { (gvi_real)0.5L, (gvi_real)0.03L, (gvi_real)-0.02L, (gvi_real)0.01L };
static const gvi_real v0[N] = { (gvi_real)0.25L, (gvi_real)-0.25L, (gvi_real)0.5L, (gvi_real)0.25L };
static int refuses;                               // the springs, if not 0

static int springs(const gvi_points *x, void *user)
{
    const gvi_real *unit = (const gvi_real *)user;        // of force over length, of 1/length^2
    const int d = x->stride;
    for (int j = 0; j < x->count; ++j)
        for (int i = 0; i < N; ++i) {
            const gvi_real *q = x->q + j, here = q[i*d];
            const gvi_real left = i > 0 ? here - q[(i - 1)*d] : 0;
            const gvi_real right = i + 1 < N ? q[(i + 1)*d] - here : 0;
            if (x->f) x->f[i*d + j] += *unit*(unit[1]*(right*right*right - left*left*left) - k[i]*here);
            if (x->value) x->value[j] += right*right*right*right/4 + k[i]*here*here/2;
        }
    return refuses;
}

static int trough(const gvi_points *x, void *user)
{
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < x->count; ++j) {
            const gvi_real q = x->q[i*x->stride + j];
            if (x->f) x->f[i*x->stride + j] -= q*q*q/64;
            if (x->value) x->value[j] += q*q*q*q/256;
        }
    return (void)user, 0;
}

static int drag(const gvi_points *x, void *user)
{
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < x->count; ++j) x->f[i*x->stride + j] -= x->v[i*x->stride + j]/8;
    return (void)user, 0;
}

static int magnetic(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int j = 0; j < x->count; ++j) {
        if (x->f) x->f[j] += x->v[d + j]/2;
        if (x->f) x->f[d + j] -= x->v[j]/2;
        if (x->dldv) x->dldv[j] -= x->q[d + j]/2;
        if (x->dldv) x->dldv[d + j] += x->q[j]/2;
        if (x->value) x->value[j] += (x->q[j]*x->v[d + j] - x->q[d + j]*x->v[j])/2;
    }
    return (void)user, 0;
}

static gvi_real units[2] = { 1, 1 };
static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .value = springs, .user = units },
                                    { .kind = GVI_POTENTIAL, .points = trough, .value = trough },
                                    { .kind = GVI_FORCE, .points = drag },
                                    { .kind = GVI_LAGRANGIAN, .points = magnetic, .value = magnetic } };

// the same in long double, without the last; drag if dragged
static int dragged;
static void rates(real t, const real *y, real *dy, void *user)
{
    const real *v = y + N;
    for (int i = 0; i < N; ++i) {
        const real left = i > 0 ? y[i] - y[i - 1] : 0, right = i + 1 < N ? y[i + 1] - y[i] : 0;
        dy[i] = v[i];
        dy[N + i] = right*right*right - left*left*left - k[i]*y[i] - y[i]*y[i]*y[i]/64 - dragged*v[i]/8;
        dy[N + i] /= mass[i];
    }
    (void)t, (void)user;
}

typedef struct trial {
    gvi_stepper st;
    gvi_real    memory[GVI_LENGTH(N, 16, 17)];
} trial;
static trial plain, stiff, other;

static void set_up(trial *a, gvi_desc desc, const gvi_real *stiffness)
{
    desc.n = N;
    if (!desc.effects) desc.effects = scene;
    if (!desc.effect_count) desc.effect_count = 2;
    desc.mass.kind = GVI_MASS_DIAGONAL;
    desc.mass.matrix = mass;
    desc.stiffness = stiffness;
    assert_ok(gvi_init(&a->st, &desc, a->memory, sizeof a->memory));
    assert_ok(gvi_start(&a->st, 0, q0, v0));
}

// table i of kicks; -1: Stoermer-Verlet as a rule of Lobatto's
static gvi_rule rule_of(int i)
{
    int count;
    const table *all = tables(&count);
    if (i < 0) return (gvi_rule){ .kind = GVI_LOBATTO, .points = 2 };
    assert_true(i < count);
    return (gvi_rule){ GVI_KICKS, all[i].r, all[i].c, all[i].b };
}

static void steps(trial *a, int count, gvi_real h)
{
    for (; count > 0; --count) assert_ok(gvi_step(&a->st, h));
}

static const gvi_real amplitude[N] = { (gvi_real)0.5L, (gvi_real)0.05L, (gvi_real)0.05L, (gvi_real)0.05L };

// over the amplitudes; momenta in units of omega = 30 times that
static real apart(const trial *a, const real *q, const real *p)
{
    real worst = 0;
    for (int i = 0; i < N; ++i) {
        worst = fmaxl(worst, fabsl(a->st.q[i] - q[i])/amplitude[i]);
        worst = fmaxl(worst, fabsl(a->st.p[i] - p[i])/(amplitude[i]*30));
    }
    return worst;
}

static real between(const trial *a, const trial *b)
{
    real q[N], p[N];
    for (int i = 0; i < N; ++i) q[i] = b->st.q[i], p[i] = b->st.p[i];
    return apart(a, q, p);
}

// how far a is from the truth
static real error_of(const trial *a)
{
    static real known_t, known[2*N];
    static int of;
    if (dragged != of || !(a->st.t >= known_t && a->st.t <= known_t)) {
        of = dragged;
        const motion m = { 2*N, rates, NULL };
        for (int i = 0; i < N; ++i) known[i] = q0[i], known[N + i] = v0[i];
        flow(&m, 0, a->st.t, 1/64.0L, known);
        for (int i = 0; i < N; ++i) known[N + i] *= mass[i];
        known_t = a->st.t;
    }
    return apart(a, known, known + N);
}

static const gvi_real step = (gvi_real)0.0625L;   // h omega to 2.7

static void assert_same(const trial *a, const trial *b)
{
    for (int i = 0; i < N; ++i) {                 // by value: a long double has bytes that say nothing
        assert_true(!(a->st.q[i] < b->st.q[i]) && !(a->st.q[i] > b->st.q[i]));
        assert_true(!(a->st.p[i] < b->st.p[i]) && !(a->st.p[i] > b->st.p[i]));
    }
}

/* ---------------------------------------------------------------- an oscillator */

static gvi_real constant;                         // of its spring
static int pull(const gvi_points *x, void *user)
{
    for (int j = 0; j < x->count; ++j) x->f[j] -= constant*x->q[j];
    return (void)user, 0;
}

static gvi_real small[2][GVI_LENGTH(1, 16, 16)], one_mass;

static void set_oscillator_of(gvi_stepper *st, int which, int s, gvi_rule rule, gvi_real m, gvi_real told,
                              gvi_real q, gvi_real p)
{
    static const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = pull };
    one_mass = m;
    const gvi_desc desc = { .n = 1, .degree = s, .rule = rule, .effects = &effect, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = &one_mass }, .stiffness = &told };
    assert_ok(gvi_init(st, &desc, small[which], sizeof small[which]));
    told = 0;                                     // read by gvi_init only
    assert_ok(gvi_start_momentum(st, 0, &q, &p));
}

static void set_oscillator(gvi_stepper *st, int which, int s, gvi_real m, gvi_real told, gvi_real q, gvi_real p)
{
    set_oscillator_of(st, which, s, (gvi_rule){ .kind = GVI_GAUSS }, m, told, q, p);
}

/* The right k: the exact rotation at any h omega and degree, a few EPS a step, in one round but for
   the first.  The frequency is that of k/m as rounded.                          */
static void test_rotation(void **state)
{
    static const int degrees[] = { 1, 2, 3, 4, 5, 8, 11, 16 };
    for (int i = 0; i < COUNT(degrees); ++i)
        for (int w = 1; w <= 40; ++w)
            for (int back = 0; back < 2; ++back) {
                gvi_stepper st;
                const gvi_real m = w % 2 ? 1 : (gvi_real)7.3L, h = back ? -1 : 1;
                const real omega = 0.75L*w;
                constant = (gvi_real)(omega*omega*m);
                const real exact = sqrtl((real)constant/m);
                set_oscillator(&st, 0, degrees[i], m, constant, 1, (gvi_real)(m*omega));
                for (int n = 1; n <= 50; ++n) {
                    assert_ok(gvi_step(&st, h));
                    const real turn = exact*h*n, p = (real)(gvi_real)(m*omega)/(m*exact);
                    const real bound = 8*EPS*(real)(n + 2);
                    assert_close(st.q[0], cosl(turn) + p*sinl(turn), bound);
                    assert_close(st.p[0]/(m*exact), p*cosl(turn) - sinl(turn), bound);
                    assert_between(1, st.iterations, 3);
                }
                assert_int_equal(st.formulation, GVI_POSITIONS);
            }
    (void)state;
}

/* Any k > 0: the area that two solutions span stays, to what rounding does at random, also where the
   step is far too long for what is left of the force to be followed.  Entries of K are rounded
   one by one, and an area sees that times X^2, X = h^2 (k - the true k)/m, over 2 at worst: signs
   differ, an eighth of it is allowed                                           */
static void test_area(void **state)
{
    static const gvi_real wrong[] = { (gvi_real)0.5L, (gvi_real)0.9L, 1, (gvi_real)1.1L, 2 };
    for (int i = 0; i < COUNT(wrong); ++i)
        for (int w = 1; w <= 16; w *= 2)
            for (int s = 1; s <= 16; s = s < 4 ? s + 1 : 2*s) {
                gvi_stepper st[2];
                const gvi_real omega = (gvi_real)(w*0.3L);
                constant = omega*omega;
                set_oscillator(st, 0, s, 1, constant*wrong[i], 1, 0);
                set_oscillator(st + 1, 1, s, 1, constant*wrong[i], 0, omega);
                int n = 0;
                while (n < 100 && gvi_step(st, 1) == GVI_OK && gvi_step(st + 1, 1) == GVI_OK) ++n;
                if (n < 100) {                    // too far from the truth to contract
                    assert_int_equal(st->status ? st->status : st[1].status, GVI_E_CONVERGENCE);
                    assert_true(w > 4);
                    continue;
                }
                const real area = (real)st[0].q[0]*st[1].p[0] - (real)st[1].q[0]*st[0].p[0];
                real size = fabsl((real)st[0].q[0]*st[1].p[0]) + fabsl((real)st[1].q[0]*st[0].p[0]);
                if (size < omega) size = omega;
                const real X = constant*(wrong[i] - 1);
                assert_close(area, omega, size*100*EPS*(1 + X*X/16));
            }
    (void)state;
}

/* --------------------------------------------------------------------- the order */

/* Two runs to t = 2 that differ by a factor of 2 in h: the error falls like h^(2s).  Right, rough
   and quite wrong k, also where there is no spring; as many points as the degree, one more, Lobatto's;
   without drag and with it.                                                     */
static void order(int effects)
{
    static const gvi_real told[][N] = { { 0, 400, 900, 400 }, { 3, 380, 1000, 410 }, { 40, 0, 450, 800 } };
    static const int begin[] = { 0, 64, 32, 16, 16, 16, 16 };
    for (int i = 0; i < COUNT(told); ++i)
        for (int s = 1; s <= 6; ++s)
            for (int more = 0; more < 3; ++more) {
                gvi_desc desc = { .degree = s, .effect_count = effects, .max_iterations = 300,
                                  .formulation = effects == 2 ? GVI_POSITIONS : GVI_VELOCITIES };
                desc.rule.kind = more == 2 ? GVI_LOBATTO : GVI_GAUSS;
                desc.rule.points = more ? s + 1 : 0;
                if (s == 1 && more == 2) continue;                                    // explicit
                real error[6], best = 0;
                for (int a = 0; a < 6; ++a) {
                    set_up(&stiff, desc, told[i]);
                    steps(&stiff, begin[s] << a, (gvi_real)2/(gvi_real)(begin[s] << a));
                    error[a] = error_of(&stiff);
                    if (a > 0 && error[a] > 1000*EPS && error[a - 1] < 0.1L)
                        best = fmaxl(best, log2l(error[a - 1]/error[a]));
                }
                assert_true(error[5] < 2e-3L);
                if (best > 0 && (s == 1 || GVI__KIND > 1)) assert_between(2*s - (GVI__KIND > 2 ? 0.5L : 1), best, 2*s + 2.5L);
            }
}

static void test_order(void **state)
{
    order(2);
    dragged = 1;
    order(3);
    dragged = 0;
    (void)state;
}

/* With velocities as rows, the same step                                         */
static void test_velocities(void **state)
{
    static const int degrees[] = { 1, 2, 3, 4, 5, 8, 11, 16 };
    for (int i = 0; i < COUNT(degrees); ++i) {
        set_up(&plain, (gvi_desc){ .degree = degrees[i], .formulation = GVI_POSITIONS }, k);
        set_up(&stiff, (gvi_desc){ .degree = degrees[i], .formulation = GVI_VELOCITIES }, k);
        steps(&plain, 30, (gvi_real)0.0625L);
        steps(&stiff, 30, (gvi_real)0.0625L);
        assert_between(0, between(&plain, &stiff), 200*EPS);
        assert_int_equal(stiff.st.formulation, GVI_VELOCITIES);
        gvi_real a[2], q[2][N], v[2][N];
        assert_ok(gvi_action(&plain.st, a));
        assert_ok(gvi_action(&stiff.st, a + 1));
        assert_close(a[0], a[1], 400*EPS);
        assert_ok(gvi_curve(&plain.st, (gvi_real)0.3L, q[0], v[0]));
        assert_ok(gvi_curve(&stiff.st, (gvi_real)0.3L, q[1], v[1]));
        for (int j = 1; j < N; ++j) assert_close(q[0][j], q[1][j], 40*EPS);
        for (int j = 1; j < N; ++j) assert_close(v[0][j], v[1][j], 1000*EPS);
    }
    (void)state;
}

/* With the right k h is bounded by what is left of the force: at h omega = 2 the error is a hundredth of
   what the same steps without it leave, and rounds are fewer                    */
static void test_worth(void **state)
{
    const gvi_desc desc = { .degree = 6, .formulation = GVI_POSITIONS };
    const gvi_real h = (gvi_real)0.0625L;
    set_up(&plain, desc, NULL);
    set_up(&stiff, desc, k);
    steps(&plain, 32, h);
    steps(&stiff, 32, h);
    assert_true(error_of(&stiff) < error_of(&plain)/100 + 100*EPS);
    assert_true(stiff.st.counters.iterations*3 < plain.st.counters.iterations*2);
    (void)state;
}

/* ------------------------------------------------------------- the symplectic form */

static void step_from(trial *a, const gvi_real *z, gvi_real h, gvi_real *end)
{
    assert_ok(gvi_start_momentum(&a->st, 0, z, z + N));
    assert_ok(gvi_step(&a->st, h));
    for (int i = 0; i < N; ++i) end[i] = a->st.q[i], end[N + i] = a->st.p[i];
}

/* D' J D = J for the derivatives D of a step, by central differences: to the square of their width, and
   what rounding leaves over it                                                  */
static void symplectic(gvi_desc desc, const gvi_real *told, gvi_real h)
{
    enum { M = 2*N };
    const gvi_real width = (gvi_real)cbrtl(EPS);
    gvi_real z[M], up[M], down[M];
    real D[M][M];
    set_up(&stiff, desc, told);
    for (int i = 0; i < N; ++i) z[i] = q0[i], z[N + i] = v0[i]*mass[i];
    for (int i = 0; i < M; ++i) {
        const gvi_real was = z[i], d = width*amplitude[i % N]*(i < N ? 1 : 30);
        z[i] = was + d;
        step_from(&stiff, z, h, up);
        const gvi_real above = z[i];
        z[i] = was - d;
        step_from(&stiff, z, h, down);
        for (int j = 0; j < M; ++j) D[j][i] = ((real)up[j] - down[j])/((real)above - z[i]);
        z[i] = was;
    }
    for (int a = 0; a < M; ++a)
        for (int b = 0; b < a; ++b) {
            real sum = 0;
            for (int i = 0; i < N; ++i) sum += D[i][a]*D[N + i][b] - D[i][b]*D[N + i][a];
            const real unit = 1/((a < N ? 1 : 30.0L)*(b < N ? 1 : 30.0L))*900;
            assert_close(sum, a == b + N ? -1 : 0, unit*20*width*width);
        }
}

static void test_symplectic(void **state)
{
    static const gvi_real told[][N] = { { 0, 400, 900, 400 }, { 3, 380, 1000, 410 }, { 40, 0, 450, 800 } };
    for (int i = 0; i < COUNT(told); ++i)
        for (int s = 1; s <= 16; s = s < 4 ? s + 1 : 2*s)
            for (int more = 0; more < 3; ++more) {
                gvi_desc desc = { .degree = s, .formulation = GVI_POSITIONS };
                desc.rule.kind = more == 2 ? GVI_LOBATTO : GVI_GAUSS;
                desc.rule.points = more ? s + 1 : 0;
                if (s == 1 && more == 2) continue;
                symplectic(desc, told[i], (gvi_real)0.0625L);
                symplectic(desc, told[i], (gvi_real)-0.03L);
            }
    for (int i = 0; i < COUNT(told); ++i)
        for (int a = -1; a < TABLES; ++a) {
            symplectic((gvi_desc){ .degree = 1, .rule = rule_of(a) }, told[i], (gvi_real)0.0625L);
            symplectic((gvi_desc){ .degree = 1, .rule = rule_of(a) }, told[i], (gvi_real)-0.03L);
        }
    (void)state;
}

/* V = 200 r^2 + r^4/4 in a plane: with the same k/m for x and y, whatever it is, and masses 2, the step
   commutes with rotations, and angular momentum stays to rounding                */
static int bowl(const gvi_points *x, void *user)
{
    const gvi_real *X = x->q, *Y = X + x->stride;
    for (int j = 0; j < x->count; ++j) {
        const gvi_real pull = 400 + (X[j]*X[j] + Y[j]*Y[j]);
        x->f[j] -= pull*X[j];
        x->f[x->stride + j] -= pull*Y[j];
    }
    return (void)user, 0;
}

static void rotations(int s, gvi_rule rule, gvi_real h)
{
    static gvi_real memory[GVI_LENGTH(2, 16, 23)];
    const gvi_real two[] = { 2, 2 }, start[] = { 1, 0 }, p[] = { 3, (gvi_real)8.5L };
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = bowl };
    for (int told = 100; told <= 500; told += 100) {
        const gvi_real same[] = { (gvi_real)told, (gvi_real)told };
        const gvi_desc desc = { .n = 2, .degree = s, .rule = rule, .effects = &effect, .effect_count = 1,
                                .stiffness = same, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = two } };
        gvi_stepper st;
        assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
        assert_ok(gvi_start_momentum(&st, 0, start, p));
        for (int n = 0; n < 200; ++n) assert_ok(gvi_step(&st, h));
        assert_close((real)st.q[0]*st.p[1] - (real)st.q[1]*st.p[0], p[1], 2000*EPS);
    }
}

static void test_rotations(void **state)
{
    for (int s = 1; s <= 16; s *= 2) rotations(s, (gvi_rule){ .kind = GVI_GAUSS }, (gvi_real)0.1L);
    for (int i = -1; i < TABLES; ++i) rotations(1, rule_of(i), (gvi_real)0.04L);
    (void)state;
}

/* --------------------------------------------------------------- where it is not heeded */

static int unit_mass(const gvi_points *x, void *user)
{
    for (int i = 0; i < N; ++i)
        for (int l = 0; l <= i; ++l)
            for (int j = 0; j < x->count; ++j) x->mass[(i*N + l)*x->stride + j] = i == l ? mass[i] : 0;
    return (void)user, 0;
}
static int no_gradient(const gvi_points *x, void *user) { return (void)x, (void)user, 0; }

// not a bit and not a byte differs
static void ignored(gvi_desc desc, const gvi_real *told)
{
    for (int given = 0; given < 2; ++given) {
        trial *a = given ? &stiff : &plain;
        desc.n = N;
        desc.effects = scene;
        if (!desc.effect_count) desc.effect_count = 2;
        if (!desc.mass.kind) desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = mass };
        const size_t size = gvi_size(&desc);
        if (given) desc.stiffness = told;
        assert_true(gvi_size(&desc) == size);
        assert_ok(gvi_init(&a->st, &desc, a->memory, sizeof a->memory));
        assert_ok(gvi_start(&a->st, 0, q0, v0));
        steps(a, 10, (gvi_real)0.03125L);
        if (given) assert_same(&plain, &stiff);
    }
}

static void test_not_heeded(void **state)
{
    const gvi_rule kicks = rule_of(3);
    static const gvi_real full[N*N] = { 1, 0, 0, 0,  0, 2, 0, 0,  0, 0, (gvi_real)0.5L, 0,  0, 0, 0, 1 };
    static const gvi_real none[][N] = { { 0, 0, 0, 0 }, { -1, -400, 0, -900 } };
    const gvi_desc all[] = {
        { .degree = 1, .rule = { .kind = GVI_LOBATTO }, .mass = { .kind = GVI_MASS_DENSE, .matrix = full } },
        { .rule = kicks, .mass = { .kind = GVI_MASS_DENSE, .matrix = full } },
        { .degree = 4, .effect_count = 4 },
        { .degree = 4, .formulation = GVI_MOMENTA }, { .degree = 4, .formulation = GVI_NEWTON },
        { .degree = 4, .mass = { .kind = GVI_MASS_DENSE, .matrix = full } },
        { .degree = 4, .mass = { .kind = GVI_MASS_POSITION, .points = unit_mass, .gradient = no_gradient } } };
    for (int i = 0; i < COUNT(all); ++i) ignored(all[i], k);
    for (int i = 0; i < COUNT(none); ++i) ignored((gvi_desc){ .degree = 4 }, none[i]);
    (void)state;
}

static void test_bad_input(void **state)
{
    const gvi_real bad[] = { (gvi_real)NAN, (gvi_real)INFINITY, -(gvi_real)INFINITY };
    for (int i = 0; i < COUNT(bad); ++i)
        for (int at = 0; at < N; ++at) {
            gvi_real given[N] = { 0, 1, 1, 0 };
            gvi_desc desc = { .n = N, .effects = scene, .effect_count = 1, .stiffness = given };
            given[at] = bad[i];
            assert_status(gvi_init(&stiff.st, &desc, stiff.memory, sizeof stiff.memory), GVI_E_ARGUMENT);
            assert_int_equal(stiff.st.fault.coordinate, at);
        }
    (void)state;
}

/* Its equations are its own: no turn to Newton's method, no boundary values.  Where the rounds do not
   contract, and where h omega has no digits left, the step says so and nothing is lost */
static void test_refusals(void **state)
{
    const gvi_real too_large[N] = { 400000, 400, 900, 400 }, huge = MAX/4;
    const gvi_desc desc = { .degree = 6 };
    gvi_real L;
    const gvi_discrete out = { .lagrangian = &L };
    gvi_stepper st;
    set_up(&stiff, desc, too_large);
    set_up(&plain, desc, too_large);
    assert_status(gvi_step(&stiff.st, (gvi_real)0.5L), GVI_E_CONVERGENCE);
    assert_same(&plain, &stiff);
    set_up(&stiff, desc, k);
    assert_status(gvi_discrete_lagrangian(&stiff.st, 0, (gvi_real)0.125L, q0, q0, &out), GVI_E_FORMULATION);
    assert_status(gvi_start_configurations(&stiff.st, 0, (gvi_real)0.125L, q0, q0), GVI_E_FORMULATION);
    constant = 1;
    set_oscillator(&st, 0, 4, 1, huge, 1, 0);
    assert_status(gvi_step(&st, 1), GVI_E_CONVERGENCE);
    assert_ok(gvi_start(&st, 0, q0, v0));
    for (int i = -1; i < TABLES; ++i) {
        set_up(&stiff, (gvi_desc){ .degree = 1, .rule = rule_of(i) }, k);
        assert_status(gvi_discrete_lagrangian(&stiff.st, 0, step, q0, q0, &out), GVI_E_FORMULATION);
        assert_status(gvi_start_configurations(&stiff.st, 0, step, q0, q0), GVI_E_FORMULATION);
        steps(&stiff, 1, step);
        assert_status(gvi_curve(&stiff.st, (gvi_real)0.5L, NULL, NULL), i < 0 ? GVI_OK : GVI_E_FORMULATION);
        assert_status(gvi_action(&stiff.st, &L), i < 0 ? GVI_OK : GVI_E_FORMULATION);
        set_oscillator_of(&st, 0, 1, rule_of(i), 1, huge, 1, 0);
        assert_status(gvi_step(&st, 1), GVI_E_CONVERGENCE);
        assert_true(!(st.q[0] < 1) && !(st.q[0] > 1) && !(st.t < 0) && !(st.t > 0));
    }
    (void)state;
}

/* GVI_LENGTH is enough, with tables for each coordinate                           */
static void test_length(void **state)
{
    static gvi_real many[40], masses[40];
    for (int i = 0; i < COUNT(many); ++i) many[i] = masses[i] = (gvi_real)(i + 1);
    masses[0] = 2;
    for (int n = 1; n <= COUNT(many); n += n < 4 ? 1 : n/2)
        for (int s = 1; s <= 16; ++s)
            for (int r = s; r <= 3*s && r < 40; r += s > 3 ? 5 : 1)
                for (int way = 0; way < 8; ++way) {
                    gvi_desc desc = { .n = n, .degree = s, .rule = { .points = r }, .effects = scene,
                                      .effect_count = way & 1 ? 4 : 2, .stiffness = many };
                    if (way & 2) desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = masses };
                    if (way & 4) desc.formulation = way & 1 ? GVI_VELOCITIES : GVI_POSITIONS;
                    gvi_effect marked[4];
                    memcpy(marked, scene, sizeof marked);
                    marked[1].weak = 1;
                    if (way & 4) desc.effects = marked;
                    assert_between(1, gvi_size(&desc), (size_t)GVI_LENGTH(n, s, r)*sizeof(gvi_real));
                    desc.stiffness = NULL;
                    assert_between(1, gvi_size(&desc), (size_t)GVI_LENGTH(n, s, r)*sizeof(gvi_real));
                }
    for (int n = 1; n <= COUNT(many); ++n)
        for (int i = -1; i < TABLES; ++i)
            for (int diagonal = 0; diagonal < 2; ++diagonal) {
                gvi_desc desc = { .n = n, .degree = 1, .rule = rule_of(i), .effects = scene, .effect_count = 1 };
                if (diagonal) desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = masses };
                const size_t without = gvi_size(&desc);
                desc.stiffness = many;
                assert_between(without + 1, gvi_size(&desc),
                               (size_t)GVI_LENGTH(n, 1, desc.rule.points)*sizeof(gvi_real));
            }
    (void)state;
}

/* Tables for each k/m, two of r R numbers and more, must not wrap where addresses have 32 bits */
static void test_too_many_tables(void **state)
{
    enum { MANY = 12471, POINTS = 412 };
    static gvi_real many[MANY];
    for (int i = 0; i < MANY; ++i) many[i] = (gvi_real)(i + 1);
    const gvi_desc desc = { .n = MANY, .degree = 1, .rule = { .points = POINTS }, .effects = scene,
                            .effect_count = 1, .formulation = GVI_POSITIONS, .stiffness = many };
    const double tables = 2.0*MANY*POINTS*GVI__ROW(POINTS)*sizeof(gvi_real), most = (double)SIZE_MAX;
    assert_true((double)gvi_size(&desc) >= (tables < most ? tables : most/16*15));
    (void)state;
}

/* ------------------------------------------------------------- kicks between arcs */

static void forces(const real *q, real *f)
{
    real y[2*N], dy[2*N];
    for (int i = 0; i < N; ++i) y[i] = q[i], y[N + i] = 0;
    rates(0, y, dy, NULL);
    for (int i = 0; i < N; ++i) f[i] = mass[i]*dy[N + i];
}

// cos omega t, sin omega t/omega
static void turns(real square, real t, real *C, real *S)
{
    const real omega = sqrtl(square);
    *C = cosl(omega*t);
    *S = square > 0 ? sinl(omega*t)/omega : t;
}

/* One step: rotations by sine and cosine, kicks by what is left of the force; in long double */
static void by_hand(const table *a, const gvi_real *told, real h, real *q, real *p)
{
    real at = 0, f[N], C, S;
    for (int j = 0; j <= a->r; ++j) {
        const real to = j < a->r ? a->c[j] : 1;
        for (int i = 0; i < N; ++i) {
            const real was = q[i];
            turns((real)told[i]/mass[i], (to - at)*h, &C, &S);
            q[i] = C*was + S*p[i]/mass[i];
            p[i] = C*p[i] - told[i]*S*was;
        }
        at = to;
        if (j == a->r) break;
        forces(q, f);
        for (int i = 0; i < N; ++i) p[i] += h*a->b[j]*(f[i] + told[i]*q[i]);
    }
}

static const gvi_real right_and_wrong[][N] = { { 0, 400, 900, 400 }, { 3, 380, 1000, 410 }, { 40, 0, 450, 800 } };

/* 20 steps, h omega to 2.7 and more where drifts are longer than steps; nodes and weights as rounded are
   those of both                                                                 */
static void test_kicks_by_hand(void **state)
{
    int count;
    const table *all = tables(&count);
    assert_int_equal(count, TABLES);
    for (int a = 0; a < count; ++a)
        for (int t = 0; t < COUNT(right_and_wrong); ++t)
            for (int back = 0; back < 2; ++back) {
                const gvi_real *told = right_and_wrong[t], h = (gvi_real)((back ? -0.0625L : 0.0625L)/(t < 2 ? 1 : 4));
                real q[N], p[N];
                set_up(&stiff, (gvi_desc){ .rule = rule_of(a) }, told);
                assert_int_equal(stiff.st.formulation, GVI_EXPLICIT);
                for (int i = 0; i < N; ++i) q[i] = q0[i], p[i] = v0[i]*mass[i];
                for (int n = 0; n < 20; ++n) by_hand(&all[a], told, h, q, p);
                steps(&stiff, 20, h);
                assert_between(0, apart(&stiff, q, p), 100*EPS);
            }
    (void)state;
}

/* Deuflhard's method, C = cos h omega, S = sin h omega/omega:
     q1 = C q0 + S v0 + h S g0/(2m)     v1 = C v0 - omega^2 S q0 + h (C g0 + g1)/(2m)     */
static void test_deuflhard(void **state)
{
    const gvi_real h = (gvi_real)0.09375L;
    set_up(&stiff, (gvi_desc){ .degree = 1, .rule = rule_of(-1) }, k);
    set_up(&other, (gvi_desc){ .rule = rule_of(0) }, k);
    for (int n = 0; n < 60; ++n) {
        real q[N], v[N], g[2][N], end[N], p[N], C, S;
        for (int i = 0; i < N; ++i) q[i] = stiff.st.q[i], v[i] = (real)stiff.st.p[i]/mass[i];
        forces(q, g[0]);
        for (int i = 0; i < N; ++i) {
            turns((real)k[i]/mass[i], h, &C, &S);
            g[0][i] += k[i]*q[i];
            end[i] = C*q[i] + S*v[i] + h*S*g[0][i]/(2*mass[i]);
        }
        forces(end, g[1]);
        for (int i = 0; i < N; ++i) {
            turns((real)k[i]/mass[i], h, &C, &S);
            g[1][i] += k[i]*end[i];
            p[i] = C*v[i]*mass[i] - S*q[i]*k[i] + h*(C*g[0][i] + g[1][i])/2;
        }
        steps(&stiff, 1, h);
        steps(&other, 1, h);
        assert_between(0, apart(&stiff, end, p), 12*EPS);
        assert_same(&stiff, &other);
        assert_int_equal(stiff.st.counters.effect[0], n + 2);            // no more than without springs
    }
    (void)state;
}

/* The right k: the exact rotation at any h omega, of odd and even half turns too.  r + 1 drifts turn
   by angles as wrong as EPS/2 of their shears make them, at random; what is left of the force is a rounding
   of k q, where a product and a sum are one; and so is the angle that is compared with  */
static void test_kicks_rotate(void **state)
{
    int count;
    const table *all = tables(&count);
    for (int a = -1; a < count; ++a)
        for (int w = 1; w <= 40; ++w)
            for (int back = 0; back < 2; ++back) {
                gvi_stepper st;
                const gvi_real m = w % 2 ? 1 : (gvi_real)7.3L;
                const real omega = 0.75L*w;
                const int r = a < 0 ? 2 : all[a].r;
                constant = (gvi_real)(omega*omega*m);
                const real exact = sqrtl((real)constant/m);
                const gvi_real h = (gvi_real)((w % 5 ? 1 : 3.14159265358979323846L*w/5/exact)*(back ? -1 : 1));
                real kicks = 0;
                for (int j = 0; j < r; ++j) kicks += a < 0 ? 0.5L : fabsl(all[a].b[j]);
                set_oscillator_of(&st, 0, 1, rule_of(a), m, constant, 1, (gvi_real)(m*omega));
                for (int n = 1; n <= 50; ++n) {
                    assert_ok(gvi_step(&st, h));
                    const real turn = exact*h*n, p = (real)(gvi_real)(m*omega)/(m*exact);
                    const real bound = EPS*(real)(n + 2)*((r + 1)/2.0L + (1 + kicks)*fabsl(h)*exact);
                    assert_close(st.q[0], cosl(turn) + p*sinl(turn), bound);
                    assert_close(st.p[0]/(m*exact), p*cosl(turn) - sinl(turn), bound);
                }
                assert_int_equal(st.formulation, GVI_EXPLICIT);
            }
    (void)state;
}

/* The last two runs to t = 2, by a factor of 2 in h, that are far above rounding: the order, on both sides.
   With rough k, for what the right one leaves is too little                       */
static void test_kicks_order(void **state)
{
    int count;
    const table *all = tables(&count);
    for (int a = -1; a < count; ++a) {
        const int wanted = a < 0 ? 2 : all[a].order;
        real last = 1, order = 0;
        if (wanted == 3) continue;                // its error is that of order 4 here
        for (int e = 4; e < 11; ++e) {
            set_up(&stiff, (gvi_desc){ .degree = 1, .rule = rule_of(a) }, right_and_wrong[1]);
            steps(&stiff, 1 << e, (gvi_real)2/(gvi_real)(1 << e));
            const real error = error_of(&stiff);
            if (error > 2000*EPS && last < 0.003L) order = log2l(last/error);
            last = error;
        }
        if (GVI__KIND > 1 || wanted == 2) assert_between(wanted - 0.25L, order, wanted + 0.25L);
    }
    (void)state;
}

/* The area of an oscillator's orbit after steps of length 1, over what it was: two orbits, k told or not */
static real area_after(int steps, gvi_rule rule, gvi_real omega, gvi_real told)
{
    gvi_stepper st[2];
    constant = omega*omega;
    set_oscillator_of(st, 0, 1, rule, 1, constant*told, 1, 0);
    set_oscillator_of(st + 1, 1, 1, rule, 1, constant*told, 0, omega);
    for (int n = 0; n < steps; ++n) {
        assert_ok(gvi_step(st, 1));
        assert_ok(gvi_step(st + 1, 1));
    }
    return ((real)st[0].q[0]*st[1].p[0] - (real)st[1].q[0]*st[0].p[0])/omega;
}

/* Shears keep areas: a wrong k, 4096 steps, each kick and drift with a rounding at random; a rotation
   by a rounded sine and cosine loses EPS/2 or so in each of them, always the same way.  */
static void test_kicks_area(void **state)
{
    static const gvi_real wrong[] = { (gvi_real)0.5L, (gvi_real)0.9L, (gvi_real)1.1L, 2 };
    for (int a = -1; a < TABLES; ++a)
        for (int i = 0; i < COUNT(wrong); ++i)
            for (int w = 1; w <= 4; ++w)
                assert_close(area_after(4096, rule_of(a), (gvi_real)(w*0.3L), wrong[i]), 1,
                             4*EPS*sqrtl(4096.0L*(rule_of(a).points + 1)));
    (void)state;
}

/* The same without stiffness, where F carries the momentum from kick to kick, and with it, for long: the
   bound is what 65536 (r + 1) roundings of EPS, each at random, leave as a standard deviation.  A factor in
   the tables that is rounded errs always the same way: 0.06 EPS a step were seen here, three times that. */
static void test_kicks_area_stays(void **state)
{
    static const gvi_real told[] = { 0, (gvi_real)0.5L, 2 };
    for (int a = -1; a < TABLES; ++a)
        for (int i = 0; i < COUNT(told); ++i)
            assert_close(area_after(65536, rule_of(a), (gvi_real)0.6L, told[i]), 1,
                         EPS*sqrtl(65536.0L*(rule_of(a).points + 1)));
    (void)state;
}

/* What F is over at a kick, all factors before it as they are, is the weight in the table, which the drift
   behind it goes by: what is between them, the same in every step, moves energy and area.  The best of 255
   pairs whose products lie anywhere within EPS/2 is EPS/700 off or so, in the mean; half of them would not do.
   In float, as more digits are needed to see it.                              */
static void test_kicks_weights(void **state)
{
    real mean = 0;
    int count = 0;
    if (LDBL_EPSILON > EPS/1e6L) skip();
    for (int a = 0; a < TABLES; ++a)
        for (int i = 0; i < 64; ++i) {
            const gvi_rule rule = rule_of(a);
            const gvi_real *weight, *ratio, *factor;
            gvi_stepper st;
            constant = 1;
            set_oscillator_of(&st, 0, 1, rule, 1, 0, 1, 0);
            assert_ok(gvi_step(&st, (gvi_real)0.3L + (gvi_real)i/97));
            weight = st.x.drift + rule.points + 1;
            ratio = weight + rule.points + 1;
            factor = ratio + rule.points + 1;
            real over = weight[0];
            for (int j = 1; j < rule.points; ++j) {
                over /= (real)ratio[j - 1]*factor[j - 1];
                mean += fabsl(weight[j]/over - 1);
                count += ratio[j - 1] != 1;
            }
        }
    assert_between(500, count, 100000);
    assert_close(mean/count, 0, EPS/500);
    (void)state;
}

/* 20,000 steps of order 8, whose own error is none at this h: energy moves as roundings at random do */
static void test_kicks_energy(void **state)
{
    real E[2];
    enum { many = 20000 };
    set_up(&stiff, (gvi_desc){ .rule = rule_of(7) }, k);
    for (int end = 0; end < 2; ++end) {
        const gvi_real *q = stiff.st.q, *p = stiff.st.p;
        E[end] = 0;
        for (int i = 0; i < N; ++i) {
            const real right = i + 1 < N ? (real)q[i + 1] - q[i] : 0;
            E[end] += ((real)p[i]*p[i]/mass[i] + (real)k[i]*q[i]*q[i])/2 + (right*right*right*right)/4
                + (real)q[i]*q[i]*q[i]*q[i]/256;
        }
        if (!end) steps(&stiff, many, (gvi_real)0.015625L);
    }
    assert_close(E[1]/E[0], 1, 4*EPS*sqrtl(many));
    (void)state;
}

/* Masses that are 1, given or not: the same bits */
static void test_kicks_unit_mass(void **state)
{
    static const gvi_real ones[N] = { 1, 1, 1, 1 };
    for (int a = -1; a < TABLES; ++a) {
        gvi_desc desc = { .n = N, .degree = 1, .rule = rule_of(a), .effects = scene, .effect_count = 2 };
        desc.stiffness = k;
        assert_ok(gvi_init(&plain.st, &desc, plain.memory, sizeof plain.memory));
        desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = ones };
        assert_ok(gvi_init(&stiff.st, &desc, stiff.memory, sizeof stiff.memory));
        assert_ok(gvi_start(&plain.st, 0, q0, v0));
        assert_ok(gvi_start(&stiff.st, 0, q0, v0));
        steps(&plain, 20, (gvi_real)0.0625L);
        steps(&stiff, 20, (gvi_real)0.0625L);
        assert_same(&plain, &stiff);
    }
    (void)state;
}

/* Stoermer-Verlet's curve: an arc from q0, after the first kick, to q1, and v is its derivative; a straight
   line where there is no spring; of a spring alone the oscillation                */
static void test_kicks_curve(void **state)
{
    const gvi_desc desc = { .degree = 1, .rule = rule_of(-1) };
    const gvi_real h = (gvi_real)0.09375L;
    gvi_real q[N], v[N], one[1], slope[1];
    gvi_stepper st;
    real g[N], from[N], start[N];
    set_up(&stiff, desc, k);
    steps(&stiff, 3, h);
    for (int i = 0; i < N; ++i) from[i] = stiff.st.q[i];
    forces(from, g);
    for (int i = 0; i < N; ++i) start[i] = (stiff.st.p[i] + h*(g[i] + k[i]*from[i])/2)/mass[i];
    steps(&stiff, 1, h);
    const real way = stiff.st.q[0] - from[0];
    for (int j = 0; j <= 8; ++j) {
        const real t = (real)h*j/8;
        assert_ok(gvi_curve(&stiff.st, (gvi_real)j/8, q, v));
        assert_close(q[0], from[0] + way*j/8, 4*EPS);
        assert_close(v[0], way/h, 16*EPS);
        for (int i = 1; i < N; ++i) {
            const real omega = sqrtl((real)k[i]/mass[i]), C = cosl(omega*t), S = sinl(omega*t);
            assert_close(q[i], C*from[i] + S*start[i]/omega, 4*EPS*amplitude[i]);
            assert_close(v[i], C*start[i] - omega*S*from[i], 4*EPS*amplitude[i]*30);
        }
    }
    for (int i = 0; i < N; ++i) assert_true(!(q[i] < stiff.st.q[i]) && !(q[i] > stiff.st.q[i]));
    constant = 4;
    set_oscillator_of(&st, 0, 1, rule_of(-1), 1, 4, 1, 0);
    assert_ok(gvi_step(&st, 9));                  // h omega = 18
    for (int j = 0; j <= 8; ++j) {
        assert_ok(gvi_curve(&st, (gvi_real)j/8, one, slope));
        assert_close(one[0], cosl(18.0L*j/8), 64*EPS);
        assert_close(slope[0], -2*sinl(18.0L*j/8), 128*EPS);
    }
    (void)state;
}

/* ------------------------------------------------------------------ a bond */

static gvi_real least;                            // distance that was asked for
static int bond(const gvi_points *x, void *user)  // V = r^-12 - 2 r^-6, V''(1) = 72
{
    for (int j = 0; j < x->count; ++j) {
        const gvi_real r = x->q[j], r6 = 1/(r*r*r*r*r*r);
        if (r < least) least = r;
        x->f[j] += 12*(r6*r6 - r6)/r;
    }
    return (void)user, least < (gvi_real)0.5L;
}

static void bond_rates(real t, const real *y, real *dy, void *user)
{
    const real r6 = 1/(y[0]*y[0]*y[0]*y[0]*y[0]*y[0]);
    dy[0] = y[1];
    dy[1] = 12*(r6*r6 - r6)/y[0];
    (void)t, (void)user;
}

/* At rest at 1 and not at 0: a step that knows nothing of the force begins where the bond is, and takes
   fewer rounds at h omega = 2 than without k; at 3 the others ask within 0.5    */
static void test_bond(void **state)
{
    const gvi_real k72[] = { 72 }, q = (gvi_real)1.01L, v = 0;
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = bond };
    for (int w = 1; w <= 3; ++w) {
        real truth[2] = { q, v };
        unsigned long long rounds[2] = { 0, 0 };
        const gvi_real h = (gvi_real)(w/8.5L);
        const motion m = { 2, bond_rates, NULL };
        flow(&m, 0, 20*(real)h, 1/32.0L, truth);
        for (int told = w == 3; told < 2; ++told) {
            const gvi_desc desc = { .n = 1, .degree = 12, .effects = &effect, .effect_count = 1,
                                    .formulation = GVI_POSITIONS, .stiffness = told ? k72 : NULL };
            gvi_stepper st;
            least = 1;
            assert_ok(gvi_init(&st, &desc, small[0], sizeof small[0]));
            assert_ok(gvi_start(&st, 0, &q, &v));
            for (int i = 0; i < 20; ++i) assert_ok(gvi_step(&st, h));
            assert_between(0.7, least, 1);
            rounds[told] = st.counters.iterations;
            if (told) assert_close(st.q[0], truth[0], (w < 3 ? 1e-11L : 1e-8L) + 2000*EPS);
        }
        assert_true(w != 2 || rounds[1] < rounds[0]);
    }
    (void)state;
}

/* ------------------------------------------------------- beside everything else */

static const gvi_desc six = { .degree = 6 };

/* Weak marks, a given number of rounds, a tolerance, an effect switched off        */
static void test_with_options(void **state)
{
    static trial rough;
    gvi_effect marked[2];
    memcpy(marked, scene, sizeof marked);
    marked[1].weak = 1;
    set_up(&plain, six, k);
    set_up(&stiff, (gvi_desc){ .degree = 6, .effects = marked }, k);
    set_up(&other, (gvi_desc){ .degree = 6, .iterations = 12 }, k);
    set_up(&rough, (gvi_desc){ .degree = 6, .tolerance = (gvi_real)1e-5L }, k);
    for (int part = 0; part < 3; ++part) {
        trial *const all[] = { &plain, &stiff, &other, &rough };
        for (int i = 0; i < 4; ++i) {
            assert_ok(gvi_switch(&all[i]->st, 1, part != 1));
            steps(all[i], 10, step);
        }
        assert_between(0, between(&plain, &stiff), 200*EPS);
        assert_between(0, between(&plain, &other), 200*EPS);
        assert_between(0, between(&plain, &rough), 1e-2L);
    }
    assert_true(stiff.st.counters.effect[1] < stiff.st.counters.effect[0]);
    assert_true(rough.st.counters.iterations < plain.st.counters.iterations || GVI__KIND == 1);
    (void)state;
}

/* What a tolerance leaves undone in a step is no more than that, of positions a few tenths large; in three quarters
   of a second the soft springs let it grow by less than ten                         */
static void test_tolerance(void **state)
{
    static const int degrees[] = { 3, 4, 6, 8, 12 };
    const int count = 24;
    for (int i = 0; i < 2*COUNT(degrees); ++i) {
        gvi_desc desc = { .degree = degrees[i/2], .effect_count = 2 + i % 2 };
        set_up(&stiff, desc, k);
        steps(&stiff, count, (gvi_real)0.03125);
        for (gvi_real tolerance = (gvi_real)0.01L; tolerance > 64*EPS; tolerance /= 10) {
            desc.tolerance = tolerance;
            set_up(&other, desc, k);
            steps(&other, count, (gvi_real)0.03125);
            for (int j = 0; j < N; ++j) assert_close(other.st.q[j], stiff.st.q[j], 10*(real)count*tolerance);
        }
    }
    (void)state;
}

/* h omega = MIN/4 EPS, of which a square or a few digits are lost: uniform motion, or a refusal */
static void test_springs_next_to_none(void **state)
{
    const gvi_real tiny = (gvi_real)(GVI__KIND == 1 ? FLT_MIN : GVI__KIND == 2 ? DBL_MIN : LDBL_MIN);
    const gvi_real weak = 4*tiny, h = (gvi_real)(sqrtl((long double)tiny)/8/EPS), from = 0, v = 1/h;
    const gvi_formulation pins[] = { GVI_EXPLICIT, GVI_POSITIONS };
    (void)state;
    for (int f = 0; f < COUNT(pins); ++f) {
        const gvi_desc desc = { .n = 1, .degree = f ? 4 : 1, .rule.kind = f ? GVI_GAUSS : GVI_LOBATTO,
                                .formulation = pins[f], .stiffness = &weak };
        assert_ok(gvi_init(&plain.st, &desc, plain.memory, sizeof plain.memory));
        assert_ok(gvi_start(&plain.st, 0, &from, &v));
        assert_status(gvi_step(&plain.st, h), f ? GVI_E_CONVERGENCE : GVI_OK);
        assert_close(plain.st.q[0], f ? 0 : 1, 4*EPS);
    }
}

/* A checkpoint, queries, a step that fails, steps of other lengths: the same to the bit */
static void nothing_is_lost(const gvi_desc *desc)
{
    static gvi_real saved[GVI_LENGTH(N, 16, 17)], q[N], p[N], L;
    set_up(&plain, *desc, k);
    set_up(&stiff, *desc, k);
    set_up(&other, *desc, k);
    for (int i = 0; i < 30; ++i) {
        const gvi_real h = i % 4 == 3 ? step/2 : i % 7 == 5 ? -step : step;
        steps(&plain, 1, h);
        if (i == 7) {
            const gvi_stepper copy = stiff.st;
            memcpy(saved, stiff.memory, sizeof saved);
            memset(stiff.memory, 0xff, sizeof saved);         // in another process it would be gone
            assert_ok(gvi_restore(&other.st, &copy, saved));
            memcpy(stiff.memory, saved, sizeof saved);
        }
        refuses = 1;
        assert_status(gvi_step(&stiff.st, h/3), GVI_E_CALLBACK);
        refuses = 0;
        steps(&stiff, 1, h);
        assert_same(&plain, &stiff);
        assert_ok(gvi_state_at(&stiff.st, stiff.st.t - h/4, q, NULL, p));
        const int kicks = desc->rule.kind == GVI_KICKS;
        assert_status(gvi_curve(&stiff.st, (gvi_real)0.3L, q, p), kicks ? GVI_E_FORMULATION : GVI_OK);
        if (desc->effect_count < 3 && !kicks) assert_ok(gvi_action(&stiff.st, &L));
        if (i < 7) continue;
        steps(&other, 1, h);
        assert_same(&plain, &other);
    }

    // the state inside the step is that of the step's beginning, one partial step on
    set_up(&other, *desc, k);
    assert_ok(gvi_start_momentum(&other.st, 0, plain.st.q, plain.st.p));
    steps(&plain, 1, step);
    assert_ok(gvi_state_at(&plain.st, plain.st.t - step*3/4, q, NULL, p));
    steps(&other, 1, step/4);
    for (int i = 0; i < N; ++i) assert_close(q[i], other.st.q[i], 100*EPS*0.5L);
}

static void test_nothing_is_lost(void **state)
{
    nothing_is_lost(&six);
    nothing_is_lost(&(gvi_desc){ .degree = 6, .effect_count = 3 });
    nothing_is_lost(&(gvi_desc){ .degree = 12, .effect_count = 3 });
    for (int i = -1; i < TABLES; ++i) nothing_is_lost(&(gvi_desc){ .degree = 1, .rule = rule_of(i) });
    (void)state;
}

/* The curve begins at q0 and v0, ends at q1 as exactly as a step is, and v is its derivative; of a spring
   alone it is the oscillation                                                   */
static void test_curve(void **state)
{
    gvi_real q[N], v[N], up[N], down[N], one[1], slope[1];
    const gvi_real width = (gvi_real)cbrtl(EPS);
    set_up(&stiff, (gvi_desc){ .degree = 10 }, k);
    steps(&stiff, 1, step);
    assert_ok(gvi_curve(&stiff.st, 0, q, v));
    for (int i = 0; i < N; ++i) assert_close(q[i], q0[i], 4*EPS);
    for (int i = 0; i < N; ++i) assert_close(v[i], v0[i], 1e-12L + 200*EPS);
    assert_ok(gvi_curve(&stiff.st, 1, q, v));
    for (int i = 0; i < N; ++i) assert_close(q[i], stiff.st.q[i], 1e-15L + 16*EPS);
    for (int j = 1; j < 8; ++j) {
        const gvi_real tau = (gvi_real)j/8;
        real y[2*N];
        const motion m = { 2*N, rates, NULL };
        assert_ok(gvi_curve(&stiff.st, tau, q, v));
        assert_ok(gvi_curve(&stiff.st, tau + width, up, NULL));
        assert_ok(gvi_curve(&stiff.st, tau - width, down, NULL));
        for (int i = 0; i < N; ++i) y[i] = q0[i], y[N + i] = v0[i];
        flow(&m, 0, (real)tau*step, 1/64.0L, y);
        for (int i = 0; i < N; ++i) {
            assert_close(v[i], (up[i] - down[i])/(2*width*step), 200*width*width);
            assert_close(q[i], y[i], 1e-13L + 16*EPS);
        }
    }
    constant = 4;
    gvi_stepper st;
    set_oscillator(&st, 0, 3, 1, 4, 1, 0);
    assert_ok(gvi_step(&st, 9));                  // h omega = 18
    for (int j = 0; j <= 8; ++j) {
        assert_ok(gvi_curve(&st, (gvi_real)j/8, one, slope));
        assert_close(one[0], cosl(18.0L*j/8), 64*EPS);
        assert_close(slope[0], -2*sinl(18.0L*j/8), 128*EPS);
    }
    (void)state;
}

static gvi_real action_from(const gvi_real *z, gvi_real h, gvi_real *end)
{
    gvi_real S;
    step_from(&stiff, z, h, end);
    assert_ok(gvi_action(&stiff.st, &S));
    return S;
}

/* The action is the step's generating function, dS = p1 dq1 - p0 dq0, by differences in all directions */
static void action(gvi_desc desc)
{
    static const gvi_real told[][N] = { { 0, 400, 900, 400 }, { 3, 380, 1000, 410 }, { 40, 0, 450, 800 } };
    const gvi_real width = (gvi_real)cbrtl(EPS);
    gvi_real z[2*N], end[2*N], up[2*N], down[2*N];
    for (int a = 0; a < COUNT(told); ++a) {
        set_up(&stiff, desc, told[a]);
        for (int i = 0; i < N; ++i) z[i] = q0[i], z[N + i] = v0[i]*mass[i];
        (void)action_from(z, step, end);
        for (int i = 0; i < 2*N; ++i) {
            const gvi_real was = z[i], d = width*amplitude[i % N]*(i < N ? 1 : 30);
            z[i] = was + d;
            const real above = z[i], S1 = action_from(z, step, up);
            z[i] = was - d;
            const real below = z[i], S0 = action_from(z, step, down);
            z[i] = was;
            real expected = i < N ? -(real)z[N + i] : 0;
            for (int j = 0; j < N; ++j) expected += end[N + j]*((real)up[j] - down[j])/(above - below);
            assert_close((S1 - S0)/(above - below), expected, 400*width*width);
        }
    }
}

static void test_action(void **state)
{
    action(six);
    action((gvi_desc){ .degree = 1, .rule = rule_of(-1) });
    (void)state;
}

/* Powers of two as units of time, length and mass scale the steps to the bit        */
static void units_of(gvi_desc desc)
{
    for (int a = -6; a <= 6; a += 4)
        for (int b = -5; b <= 7; b += 6) {
            const gvi_real time = (gvi_real)ldexp(1, a), length = (gvi_real)ldexp(1, b);
            gvi_real scaled[N], q[N], v[N];
            for (int i = 0; i < N; ++i) {
                scaled[i] = k[i]/(time*time);
                q[i] = q0[i]*length;
                v[i] = v0[i]*length/time;
            }
            set_up(&plain, desc, k);
            steps(&plain, 20, step);
            set_up(&stiff, desc, scaled);
            units[0] = 1/(time*time);
            units[1] = 1/(length*length);
            assert_ok(gvi_start(&stiff.st, 0, q, v));
            steps(&stiff, 20, step*time);
            units[0] = units[1] = 1;
            for (int i = 0; i < N; ++i) {
                assert_true(!(stiff.st.q[i] < plain.st.q[i]*length) && !(stiff.st.q[i] > plain.st.q[i]*length));
                const gvi_real p = plain.st.p[i]*length/time;
                assert_true(!(stiff.st.p[i] < p) && !(stiff.st.p[i] > p));
            }
        }
}

static void test_units(void **state)
{
    units_of((gvi_desc){ .degree = 5, .effect_count = 1 });
    units_of((gvi_desc){ .degree = 1, .rule = rule_of(4), .effect_count = 1 });
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rotation),
        cmocka_unit_test(test_area),
        cmocka_unit_test(test_order),
        cmocka_unit_test(test_velocities),
        cmocka_unit_test(test_worth),
        cmocka_unit_test(test_symplectic),
        cmocka_unit_test(test_rotations),
        cmocka_unit_test(test_not_heeded),
        cmocka_unit_test(test_bad_input),
        cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_length),
        cmocka_unit_test(test_too_many_tables),
        cmocka_unit_test(test_kicks_by_hand),
        cmocka_unit_test(test_deuflhard),
        cmocka_unit_test(test_kicks_rotate),
        cmocka_unit_test(test_kicks_order),
        cmocka_unit_test(test_kicks_area),
        cmocka_unit_test(test_kicks_area_stays),
        cmocka_unit_test(test_kicks_weights),
        cmocka_unit_test(test_kicks_energy),
        cmocka_unit_test(test_kicks_unit_mass),
        cmocka_unit_test(test_kicks_curve),
        cmocka_unit_test(test_bond),
        cmocka_unit_test(test_with_options),
        cmocka_unit_test(test_tolerance),
        cmocka_unit_test(test_nothing_is_lost),
        cmocka_unit_test(test_springs_next_to_none),
        cmocka_unit_test(test_curve),
        cmocka_unit_test(test_action),
        cmocka_unit_test(test_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
