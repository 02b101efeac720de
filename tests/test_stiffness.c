/* desc.stiffness: the same steps in fewer rounds, and where the fixed point alone does not
   contract.  Expected is the step without it; for an oscillator what theory says of Gauss
   collocation: a rotation by the diagonal Pade approximant of exp(i h omega).          */
#include "gvi_test.h"

#include <complex.h>

typedef gvi_real real;

/* ---------------------------------------------------------------- the scene

   Four masses, each on a spring of its own, in a row with soft quartic springs between;
   drag; a magnetic field, L = B (q0 v1 - q1 v0)/2.                             */

enum { N = 4 };
static const real mass[N] = { 1, 2, (real)0.5L, 1 }, k[N] = { 0, 400, 900, 400 };
static const real q0[N] = { (real)0.5L, (real)0.03L, (real)-0.02L, (real)0.01L };
static const real v0[N] = { (real)0.25L, (real)-0.25L, (real)0.5L, (real)0.25L };
static int refuses;                               // the springs, if not 0

static int springs(const gvi_points *x, void *user)
{
    const real *unit = (const real *)user;        // of force over length, of 1/length^2
    for (int j = 0; j < x->count; ++j)
        for (int i = 0; i < N; ++i) {
            const real *q = x->q + j, here = q[i*x->stride];
            const real left = i > 0 ? here - q[(i - 1)*x->stride] : 0;
            const real right = i + 1 < N ? q[(i + 1)*x->stride] - here : 0;
            x->f[i*x->stride + j] += *unit*(unit[1]*(right*right*right - left*left*left) - k[i]*here);
        }
    return refuses;
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

static real units[2] = { 1, 1 };
static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = springs, .user = units },
                                    { .kind = GVI_FORCE, .points = drag },
                                    { .kind = GVI_LAGRANGIAN, .points = magnetic, .value = magnetic } };

typedef struct trial {
    gvi_stepper st;
    real        memory[GVI_LENGTH(N, 16, 17)];
} trial;
static trial plain, stiff, other;

static void set_up(trial *a, gvi_desc desc, const real *stiffness)
{
    desc.n = N;
    desc.effects = scene;
    if (!desc.effect_count) desc.effect_count = 1;
    desc.mass.kind = GVI_MASS_DIAGONAL;
    desc.mass.matrix = mass;
    desc.stiffness = stiffness;
    assert_ok(gvi_init(&a->st, &desc, a->memory, sizeof a->memory));
    assert_ok(gvi_start(&a->st, 0, q0, v0));
}

static void steps(trial *a, int count, real h)
{
    for (; count > 0; --count) assert_ok(gvi_step(&a->st, h));
}

/* over the amplitudes, 0.5 of a soft coordinate and 0.05 of a stiff one; momenta in units of
   omega = 30 times that                                                        */
static real apart(const trial *a, const trial *b)
{
    real worst = 0;
    for (int i = 0; i < N; ++i) {
        const real size = i ? (real)0.05L : (real)0.5L;
        worst = (real)fmaxl(worst, fabsl((long double)a->st.q[i] - b->st.q[i])/size);
        worst = (real)fmaxl(worst, fabsl((long double)a->st.p[i] - b->st.p[i])/(size*30));
    }
    return worst;
}

static void assert_same(const trial *a, const trial *b)
{
    assert_memory_equal(a->st.q, b->st.q, N*sizeof(real));
    assert_memory_equal(a->st.p, b->st.p, N*sizeof(real));
}

/* --------------------------------------------------- the same way to the step */

/* 40 steps, h omega from 0.4 to 1.3; what rounding does, a few EPS a step       */
static void compare(gvi_desc desc)
{
    const real h = (real)0.03125L;
    set_up(&plain, desc, NULL);
    set_up(&stiff, desc, k);
    steps(&plain, 40, h);
    steps(&stiff, 40, h);
    assert_between(0, apart(&plain, &stiff), 200*EPS);
    const int fewer = stiff.st.counters.iterations < plain.st.counters.iterations;
    if (!fewer && desc.degree > 1)
        print_error("degree %d, %d effects: %d rounds, %d without stiffness\n", desc.degree,
                    desc.effect_count, (int)stiff.st.counters.iterations, (int)plain.st.counters.iterations);
    assert_true(fewer || desc.degree == 1);
    assert_int_equal(stiff.st.formulation, plain.st.formulation);
}

static void test_same_step(void **state)
{
    static const int degrees[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16 };
    for (int i = 0; i < COUNT(degrees); ++i)
        for (int effects = 1; effects <= 3; ++effects)
            for (int more = 0; more < 3; ++more) {
                gvi_desc desc = { .degree = degrees[i], .effect_count = effects };
                desc.rule.kind = more == 2 ? GVI_LOBATTO : GVI_GAUSS;
                desc.rule.points = more ? degrees[i] + 1 : 0;
                if (desc.degree == 1 && more == 2 && effects == 1) continue;         // explicit
                desc.formulation = effects == 1 ? GVI_POSITIONS : GVI_VELOCITIES;
                compare(desc);
            }
    (void)state;
}

/* Whatever k says, the step is the same; where the rounds then do not contract Newton's method
   takes over.                                                                  */
static void test_any_k(void **state)
{
    static const real wrong[][N] = { { 400, 0, 0, 0 }, { 1, 200, 1800, 1000 }, { -50, 380, 900, 420 },
                                     { 0, 0, 0, -300 }, { 40000, 400, 900, 400 }, { 0, 0, 0, 0 } };
    const real h = (real)0.03125L;
    for (int i = 0; i < COUNT(wrong); ++i) {
        const gvi_desc desc = { .degree = 6 };
        set_up(&plain, desc, NULL);
        set_up(&stiff, desc, wrong[i]);
        steps(&plain, 40, h);
        steps(&stiff, 40, h);
        assert_between(0, apart(&plain, &stiff), 200*EPS);
    }
    (void)state;
}

/* ---------------------------------------------------------------- an oscillator */

static real omega2, weight, rest;                 // the place where it is at rest
static int pull(const gvi_points *x, void *user)
{
    for (int j = 0; j < x->count; ++j) x->f[j] -= weight*omega2*(x->q[j] - rest);
    return (void)user, 0;
}

/* R(z) = P_s(z)/P_s(-z), P_(j+1)(z) = 2 (2j + 1) P_j(z) + z^2 P_(j-1)(z)         */
static long double complex pade(int s, long double complex z)
{
    long double complex a[2] = { 1, 1 }, b[2] = { 2 + z, 2 - z };
    for (int j = 1; j < s; ++j)
        for (int i = 0; i < 2; ++i) {
            const long double complex next = 2*(2*j + 1)*b[i] + z*z*a[i];
            a[i] = b[i];
            b[i] = next;
        }
    return b[0]/b[1];
}

/* Ten steps from q = rest + 1, v = 0 with omega = h omega, h = 1 and a k that is wrong by `off`; returns
   the first one's rounds, or -1 where there is no convergence.  Rounding of a force at rows of 1 moves
   them by (h omega)^2/10 EPS or so, of which a step sees less                  */
static int swing(int s, real h_omega, real m, real off, int given)
{
    int rounds = 0;
    static real memory[GVI_LENGTH(1, 16, 16)], none = 0;
    const real begin = rest + 1;
    gvi_stepper st;
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = pull };
    gvi_desc desc = { .n = 1, .degree = s, .effects = &effect, .effect_count = 1,
                      .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = &weight }, .formulation = GVI_POSITIONS };
    omega2 = h_omega*h_omega;
    weight = m;
    real stiffness = m*omega2*(1 + off);
    if (given) desc.stiffness = &stiffness;
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    stiffness = 0;                                // read by gvi_init only
    assert_ok(gvi_start(&st, 0, &begin, &none));
    long double complex z = 1;
    for (int i = 0; i < 10; ++i) {
        const gvi_status status = gvi_step(&st, 1);
        if (status != GVI_OK) {
            assert_int_equal(status, GVI_E_CONVERGENCE);
            return -1;
        }
        if (i == 0) rounds = st.iterations;
        z *= pade(s, (long double)h_omega*I);
    }
    const real bound = 4*(8 + 4*h_omega + h_omega*h_omega)*EPS*(1 + rest);
    assert_close(st.q[0] - rest, creall(z), bound);
    assert_close(st.p[0]/(m*h_omega), -cimagl(z), bound);
    return rounds;
}

/* h omega to 30, where the fixed point diverges; with the right k two rounds find the step, and no
   more than 14 see that what still moves is rounding                           */
static void test_oscillator(void **state)
{
    static const int degrees[] = { 1, 2, 3, 4, 5, 8, 11, 16 };
    for (int i = 0; i < COUNT(degrees); ++i) {
        assert_int_equal(swing(degrees[i], 30, 1, 0, 0), -1);
        for (int w = 1; w <= 30; w = w < 4 ? w + 1 : 2*w - 1)
            for (int heavy = 0; heavy < 2; ++heavy) {
                rest = heavy ? 16 : 0;
                assert_between(1, swing(degrees[i], (real)w, heavy ? (real)7.3L : 1, 0, 1), 16);
            }
        rest = 0;
    }
    (void)state;
}

/* The error of a round is off (I + X)^-1 X of that of the one before, X = (h omega)^2 g b: it takes
   log EPS/log off rounds, where k is off by a thousandth and by a tenth          */
static void test_rounds_follow_k(void **state)
{
    for (int w = 2; w <= 32; w *= 2) {
        const int exact = swing(8, (real)w, 1, 0, 1), near = swing(8, (real)w, 1, (real)0.001L, 1);
        const int far = swing(8, (real)w, 1, (real)0.1L, 1);
        const int digits = (int)(-log10((double)EPS));
        assert_between(exact, near, 8 + digits/1.5);      // |X/(1 + X)| may be some times 1
        assert_between(near + 1, far, 10 + 2*digits);
    }
    (void)state;
}

/* Degree 1, Gauss: X = h^2 k/4 = -1 has no inverse; k is not heeded then, and is again at another h */
static void test_no_inverse(void **state)
{
    static real memory[GVI_LENGTH(1, 1, 1)], one = 1, none = 0;
    gvi_stepper st;
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = pull };
    const real stiffness = -4, m = 1;
    const gvi_desc desc = { .n = 1, .degree = 1, .effects = &effect, .effect_count = 1, .stiffness = &stiffness,
                            .formulation = GVI_POSITIONS };
    weight = m;
    omega2 = (real)0.25L;
    assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
    assert_ok(gvi_start(&st, 0, &one, &none));
    assert_ok(gvi_step(&st, 1));
    assert_close(st.q[0], creall(pade(1, 0.5L*I)), 8*EPS);
    for (int i = 0; i < 3; ++i) assert_ok(gvi_step(&st, i == 1 ? 1 : (real)0.5L));
    const long double complex z = pade(1, 0.5L*I)*pade(1, 0.5L*I)*pade(1, 0.25L*I)*pade(1, 0.25L*I);
    assert_close(st.q[0], creall(z), 64*EPS);
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

static void test_not_heeded(void **state)
{
    static const real nodes[] = { 0, 1 }, weights[] = { (real)0.5L, (real)0.5L };
    static const real full[N*N] = { 1, 0, 0, 0,  0, 2, 0, 0,  0, 0, (real)0.5L, 0,  0, 0, 0, 1 };
    const gvi_desc all[] = {
        { .degree = 1, .rule = { .kind = GVI_LOBATTO } },
        { .rule = { .kind = GVI_KICKS, .points = 2, .nodes = nodes, .weights = weights } },
        { .degree = 4, .formulation = GVI_MOMENTA }, { .degree = 4, .formulation = GVI_NEWTON },
        { .degree = 4, .mass = { .kind = GVI_MASS_DENSE, .matrix = full } },
        { .degree = 4, .mass = { .kind = GVI_MASS_POSITION, .points = unit_mass, .gradient = no_gradient } } };
    for (int i = 0; i < COUNT(all); ++i)
        for (int given = 0; given < 2; ++given) {
            gvi_desc desc = all[i];
            trial *a = given ? &stiff : &plain;
            desc.n = N;
            desc.effects = scene;
            desc.effect_count = 1;
            if (!desc.mass.kind) desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = mass };
            const size_t size = gvi_size(&desc);
            if (given) desc.stiffness = k;
            assert_true(gvi_size(&desc) == size);
            assert_ok(gvi_init(&a->st, &desc, a->memory, sizeof a->memory));
            assert_ok(gvi_start(&a->st, 0, q0, v0));
            steps(a, 10, (real)0.03125L);
            if (given) assert_same(&plain, &stiff);
        }
    (void)state;
}

static void test_bad_input(void **state)
{
    const real bad[] = { (real)NAN, (real)INFINITY, -(real)INFINITY };
    for (int i = 0; i < COUNT(bad); ++i)
        for (int at = 0; at < N; ++at) {
            real given[N] = { 0, 1, 1, 0 };
            gvi_desc desc = { .n = N, .effects = scene, .effect_count = 1, .stiffness = given };
            given[at] = bad[i];
            assert_status(gvi_init(&stiff.st, &desc, stiff.memory, sizeof stiff.memory), GVI_E_ARGUMENT);
            assert_int_equal(stiff.st.fault.coordinate, at);
        }
    (void)state;
}

/* GVI_LENGTH is enough, with a table for each coordinate                          */
static void test_length(void **state)
{
    static real many[40], masses[40];
    for (int i = 0; i < COUNT(many); ++i) many[i] = masses[i] = (real)(i + 1);
    for (int n = 1; n <= COUNT(many); n += n < 4 ? 1 : n/2)
        for (int s = 1; s <= 16; ++s)
            for (int r = s; r <= 3*s && r < 40; r += s > 3 ? 5 : 1)
                for (int way = 0; way < 8; ++way) {
                    gvi_desc desc = { .n = n, .degree = s, .rule = { .points = r }, .effects = scene,
                                      .effect_count = way & 1 ? 3 : 1, .stiffness = many };
                    if (way & 2) desc.mass = (gvi_mass){ .kind = GVI_MASS_DIAGONAL, .matrix = masses };
                    if (way & 2) masses[0] = 2;
                    if (way & 4) desc.formulation = way & 1 ? GVI_VELOCITIES : GVI_POSITIONS;
                    assert_between(1, gvi_size(&desc), (size_t)GVI_LENGTH(n, s, r)*sizeof(real));
                    desc.stiffness = NULL;
                    assert_between(1, gvi_size(&desc), (size_t)GVI_LENGTH(n, s, r)*sizeof(real));
                }
    (void)state;
}

/* ------------------------------------------------------------------ a bond */

static real least;                                // distance that was asked for
static int bond(const gvi_points *x, void *user)  // V = r^-12 - 2 r^-6, V''(1) = 72
{
    for (int j = 0; j < x->count; ++j) {
        const real r = x->q[j], r6 = 1/(r*r*r*r*r*r);
        if (r < least) least = r;
        x->f[j] += 12*(r6*r6 - r6)/r;
    }
    return (void)user, least < (real)0.5L;
}

/* At rest at 1 and not at 0: a step that knows nothing of the force begins where the bond is, and takes
   fewer rounds at h omega = 2, to the same end; at 3 the others ask within 0.5     */
static void test_bond(void **state)
{
    static real memory[GVI_LENGTH(1, 8, 8)];
    const real k72[] = { 72 }, q = (real)1.01L, v = 0;
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = bond };
    for (int w = 1; w <= 3; ++w) {
        real end[2] = { 0, 0 };
        unsigned long long rounds[2] = { 0, 0 };
        for (int told = w == 3; told < 2; ++told) {
            const gvi_desc desc = { .n = 1, .effects = &effect, .effect_count = 1,
                                    .formulation = GVI_POSITIONS, .stiffness = told ? k72 : NULL };
            gvi_stepper st;
            least = 1;
            assert_ok(gvi_init(&st, &desc, memory, sizeof memory));
            assert_ok(gvi_start(&st, 0, &q, &v));
            for (int i = 0; i < 100; ++i) assert_ok(gvi_step(&st, (real)(w/8.48528137423857029)));
            assert_between(0.9, least, 1);
            end[told] = st.q[0];
            rounds[told] = st.counters.iterations;
        }
        if (w < 3) assert_close(end[0], end[1], 1000*EPS);
        assert_true(w != 2 || rounds[1] < rounds[0]);
    }
    (void)state;
}

/* ------------------------------------------------------- beside everything else */

static const gvi_desc six = { .degree = 6, .effect_count = 2 };
static const real step = 0.0625;                  // h omega to 2.7

/* Weak marks, a given number of rounds, a tolerance, an effect switched off        */
static void test_with_options(void **state)
{
    gvi_effect marked[2];
    memcpy(marked, scene, sizeof marked);
    marked[1].weak = 1;
    set_up(&plain, six, k);
    gvi_desc desc = { .n = N, .degree = 6, .effects = marked, .effect_count = 2, .stiffness = k,
                      .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = mass } };
    assert_ok(gvi_init(&stiff.st, &desc, stiff.memory, sizeof stiff.memory));
    assert_ok(gvi_start(&stiff.st, 0, q0, v0));
    desc.effects = scene;
    desc.iterations = 12;
    assert_ok(gvi_init(&other.st, &desc, other.memory, sizeof other.memory));
    assert_ok(gvi_start(&other.st, 0, q0, v0));
    for (int part = 0; part < 3; ++part) {
        trial *const all[] = { &plain, &stiff, &other };
        for (int i = 0; i < 3; ++i) {
            assert_ok(gvi_switch(&all[i]->st, 1, part != 1));
            steps(all[i], 10, step);
        }
        assert_between(0, apart(&plain, &stiff), 200*EPS);
        assert_between(0, apart(&plain, &other), 200*EPS);
    }
    (void)state;
}

/* A checkpoint, queries, a step that fails, steps of other lengths: the same to the bit */
static void test_nothing_is_lost(void **state)
{
    static real saved[GVI_LENGTH(N, 16, 17)], q[N], p[N];
    set_up(&plain, six, k);
    set_up(&stiff, six, k);
    set_up(&other, six, k);
    for (int i = 0; i < 30; ++i) {
        const real h = i % 4 == 3 ? step/2 : i % 7 == 5 ? -step : step;
        steps(&plain, 1, h);
        if (i == 7) {
            const gvi_stepper copy = stiff.st;
            memcpy(saved, stiff.memory, sizeof saved);
            assert_ok(gvi_restore(&other.st, &copy, saved));
        }
        refuses = 1;
        assert_status(gvi_step(&stiff.st, h/3), GVI_E_CALLBACK);
        refuses = 0;
        steps(&stiff, 1, h);
        assert_same(&plain, &stiff);
        assert_ok(gvi_state_at(&stiff.st, stiff.st.t - h/4, q, NULL, p));
        if (i < 7) continue;
        steps(&other, 1, h);
        assert_same(&plain, &other);
    }

    // the state inside the step is that of the step's beginning, one partial step on
    set_up(&other, six, k);
    assert_ok(gvi_start_momentum(&other.st, 0, plain.st.q, plain.st.p));
    steps(&plain, 1, step);
    assert_ok(gvi_state_at(&plain.st, plain.st.t - step*3/4, q, NULL, p));
    steps(&other, 1, step/4);
    for (int i = 0; i < N; ++i) assert_close(q[i], other.st.q[i], 100*EPS*(real)0.5L);
    (void)state;
}

/* Powers of two as units of time, length and mass scale the steps to the bit        */
static void test_units(void **state)
{
    for (int a = -6; a <= 6; a += 4)
        for (int b = -5; b <= 7; b += 6) {
            const real time = (real)ldexp(1, a), length = (real)ldexp(1, b);
            real scaled[N], q[N], v[N];
            for (int i = 0; i < N; ++i) {
                scaled[i] = k[i]/(time*time);
                q[i] = q0[i]*length;
                v[i] = v0[i]*length/time;
            }
            const gvi_desc desc = { .degree = 5, .formulation = GVI_POSITIONS };
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
                const real p = plain.st.p[i]*length/time;
                assert_true(!(stiff.st.p[i] < p) && !(stiff.st.p[i] > p));
            }
        }
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_step),
        cmocka_unit_test(test_any_k),
        cmocka_unit_test(test_oscillator),
        cmocka_unit_test(test_rounds_follow_k),
        cmocka_unit_test(test_no_inverse),
        cmocka_unit_test(test_not_heeded),
        cmocka_unit_test(test_bad_input),
        cmocka_unit_test(test_length),
        cmocka_unit_test(test_bond),
        cmocka_unit_test(test_with_options),
        cmocka_unit_test(test_nothing_is_lost),
        cmocka_unit_test(test_units),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
