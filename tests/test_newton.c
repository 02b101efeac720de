/* Newton's method: steps against those of the fixed points, of other derivatives, and of the Runge-Kutta
   matrix A of Gauss's method, which is made here from its definition. */
#include "gvi_test.h"
#include "problems.h"
#include "gauss.h"

typedef long double wide;
enum { MOST = 20 };

static gvi_real memory[GVI_LENGTH(MOST, 17, 18)], spare[GVI_LENGTH(MOST, 17, 18)];

/* Springs of different stiffness; `cubic` of u^3 in all of them */
typedef struct row { gvi_real cubic, damping, turning; int hessians; } row;

static gvi_real spring_of(int i) { return (gvi_real)(1 + 400*(i % 2)); }

AT_POINTS(springs)
{
    const row *a = user;
    for (int i = 0, n = x->n, d = x->stride; i < n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const real u = stretch(n, i, d, x->q + k);
            add_tension(n, i, d, spring_of(i)*u + a->cubic*u*u*u, x->f + k);
        }
    return 0;
}

HESSIAN(springs_hessian)
{
    const row *a = user;
    for (int i = 0; i < MOST; ++i) {
        const real u = stretch(MOST, i, 1, q);
        add_stiffness(MOST, i, spring_of(i) + 3*a->cubic*u*u, fq);
    }
    return 0;
}

/* f_i = -damping (v_i - v_(i+1)/2): not symmetric */
AT_EACH(damper)
{
    const real next = a/x->stride + 1 < x->n ? x->v[a + x->stride]/2 : 0;
    x->f[a] -= ((const row *)user)->damping*(x->v[a] - next);
}

HESSIAN(damper_hessian)
{
    const row *a = user;
    for (int i = 0; i < MOST; ++i) {
        fv[i*MOST + i] -= a->damping;
        if (i + 1 < MOST) fv[i*MOST + i + 1] += a->damping/2;
    }
    return 0;
}

/* L = sum turning (q_i v_(i+1) - q_(i+1) v_i)/2 + cubic q_i^2 v_i^2/100 over even i */
AT_EACH(magnet)
{
    const row *r = user;
    const int b = a + x->stride, i = a/x->stride;
    const real w = r->turning/2;
    if (i % 2 || i + 1 == x->n) return;
    x->f[a] += w*x->v[b] + r->cubic*x->q[a]*x->v[a]*x->v[a]/50;
    x->f[b] -= w*x->v[a];
    x->dldv[a] -= w*x->q[b] - r->cubic*x->q[a]*x->q[a]*x->v[a]/50;
    x->dldv[b] += w*x->q[a];
}

HESSIAN(magnet_hessian)
{
    const row *a = user;
    for (int i = 0; i + 1 < MOST; i += 2) {
        fv[i*MOST + i + 1] += a->turning/2;
        fv[(i + 1)*MOST + i] -= a->turning/2;
        fq[i*MOST + i] += a->cubic*v[i]*v[i]/50;
        fv[i*MOST + i] += a->cubic*q[i]*v[i]/25;
        pv[i*MOST + i] += a->cubic*q[i]*q[i]/50;
    }
    return 0;
}

/* M_ii = 3 + sin q_i, M_i(i+1) = cos(q_i + q_(i+1))/2: definite for any q */
AT_EACH(mass)
{
    for (int i = a/x->stride, j = 0; j <= i; ++j) x->mass[(i*(x->n - 1) + j)*x->stride + a] = i == j ? 3 + sin(x->q[a]) : 0;
    if (a < x->stride) return;
    const int i = a/x->stride;
    x->mass[(i*(x->n - 1) + i - 1)*x->stride + a] = cos(x->q[a] + x->q[a - x->stride])/2;
}

AT_EACH(mass_gradient)
{
    const int b = a + x->stride;
    x->f[a] += cos(x->q[a])*x->v[a]*x->v[a]/2;
    if (b >= x->n*x->stride) return;
    const real w = -sin(x->q[a] + x->q[b])/2*x->v[a]*x->v[b];
    x->f[a] += w;
    x->f[b] += w;
}

/* What a scene of the tests consists of */
enum { DAMPED = 1, TURNED = 2, MOVING_MASS = 4, HESSIANS = 8, DENSE = 16 };

static row parameters;
static gvi_effect scene[3];

static gvi_desc describe(int n, int s, int what, gvi_formulation formulation)
{
    static gvi_real full[MOST*MOST];
    gvi_desc desc = { .n = n, .degree = s, .effects = scene, .effect_count = 1, .formulation = formulation };
    const int h = what & HESSIANS;
    scene[0] = (gvi_effect){ .kind = GVI_POTENTIAL, .points = springs, .hessian = h ? springs_hessian : NULL, .user = &parameters };
    if (what & DAMPED)
        scene[desc.effect_count++] = (gvi_effect){ .kind = GVI_FORCE, .points = damper, .hessian = h ? damper_hessian : NULL,
                                                   .user = &parameters };
    if (what & TURNED)
        scene[desc.effect_count++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = magnet, .hessian = h ? magnet_hessian : NULL,
                                                   .user = &parameters };
    if (what & MOVING_MASS)
        desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient };
    if (what & DENSE) {
        for (int i = 0; i < n*n; ++i) full[i] = i/n == i % n ? 2 : i/n == i % n + 1 ? (gvi_real)0.5 : 0;
        desc.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = full };
    }
    return desc;
}

static void begin(gvi_stepper *st, const gvi_desc *desc, gvi_real *where, size_t size)
{
    gvi_real q[MOST], v[MOST];
    for (int i = 0; i < desc->n; ++i) {
        q[i] = (gvi_real)(0.5*sin(0.7*i + 0.3));
        v[i] = (gvi_real)(0.5*cos(1.3*i));
    }
    *st = new_stepper(desc);
    assert_ok(gvi_start(st, 0, q, v));
}

static void go(gvi_stepper *st, gvi_real h, int steps)
{
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(st, h));
}

static wide apart(const gvi_stepper *a, const gvi_stepper *b)
{
    wide d = 0;
    for (int i = 0; i < a->n; ++i) {
        d = fmaxl(d, fabsl((wide)a->q[i] - b->q[i]));
        d = fmaxl(d, fabsl((wide)a->p[i] - b->p[i])/20);                 // the largest frequency
    }
    return d;
}

static const int degrees[] = { 2, 3, 4, 5, 7, 8 };

/* Linear scenes: derivatives are the same everywhere, so one factorisation serves all steps of one length; in
   float rounding may ask for a second. */
TEST(linear_scenes_need_one_factorisation)
{
    static const int kinds[] = { 0, DAMPED, TURNED, DAMPED | TURNED, DENSE | DAMPED };
    parameters = (row){ 0, (gvi_real)0.7, 3, 1 };
    for (int d = 0; d < COUNT(degrees); ++d)
        for (int k = 0; k < COUNT(kinds); ++k) {
            gvi_stepper st;
            const gvi_desc desc = describe(MOST, degrees[d], kinds[k] | HESSIANS, GVI_NEWTON);
            begin(&st, &desc, memory, sizeof memory);
            st.counters.factorizations = 0;
            go(&st, (gvi_real)0.1, 20);
            assert_between(1, (wide)st.counters.factorizations, KIND == 1 ? 2 : 1);
            st.counters.factorizations = 0;
            go(&st, (gvi_real)0.05, 1);
            assert_between(1, (wide)st.counters.factorizations, KIND == 1 ? 2 : 1);
        }
}

TEST(a_step_that_fails_leaves_everything_as_it_was)
{
    gvi_stepper st, copy;
    parameters = (row){ 400, 0, 0, 1 };
    gvi_desc desc = describe(MOST, 6, HESSIANS, GVI_NEWTON);
    desc.max_iterations = 6;
    begin(&st, &desc, memory, sizeof memory);
    go(&st, (gvi_real)0.001, 1);
    begin(&copy, &desc, spare, sizeof spare);
    go(&copy, (gvi_real)0.001, 1);
    assert_status(gvi_step(&st, (gvi_real)0.5), GVI_E_CONVERGENCE);
    assert_same_numbers(st.q, copy.q, MOST);
    assert_same_numbers(st.p, copy.p, MOST);
    assert_same_numbers(st.q_low, copy.q_low, MOST);
    assert_same_numbers(st.p_low, copy.p_low, MOST);
    go(&st, (gvi_real)0.001, 1);                  // a failure ends what is kept of derivatives
    go(&copy, (gvi_real)0.001, 1);
    assert_close(apart(&st, &copy), 0, 4*EPS);
}

static int calls_left;

static int refusing(const gvi_points *x, void *user)
{
    return calls_left-- == 0 ? 1 : springs(x, user);
}

/* A refusal at the values that a step begins with is no matrix's fault: once is enough */
TEST(a_refusal_at_the_start_is_reported_at_once)
{
    gvi_stepper st;
    parameters = (row){ 0, 0, 0, 1 };
    const gvi_desc desc = describe(MOST, 6, HESSIANS, GVI_NEWTON);
    scene[0].points = refusing;
    calls_left = -1;
    begin(&st, &desc, memory, sizeof memory);
    calls_left = 0;
    assert_status(gvi_step(&st, (gvi_real)0.1), GVI_E_CALLBACK);
    assert_int_equal(st.fault.effect, 0);
    assert_int_equal(calls_left, -1);
    assert_ok(gvi_step(&st, (gvi_real)0.1));
}

/* A partial step: the state that steps would have.  The derivatives that the steps keep stay as they are:
   what follows has the same bits as without the question */
TEST(partial_steps_are_steps)
{
    gvi_stepper st, half;
    parameters = (row){ 0, (gvi_real)0.3, 1, 1 };
    const gvi_desc desc = describe(MOST, 8, DAMPED | TURNED | HESSIANS, GVI_NEWTON);
    gvi_real q[MOST], p[MOST], end[MOST];
    begin(&st, &desc, memory, sizeof memory);
    begin(&half, &desc, spare, sizeof spare);
    go(&st, (gvi_real)0.0625, 2);
    go(&half, (gvi_real)0.0625, 1);
    go(&half, (gvi_real)0.015625, 1);
    assert_ok(gvi_state_at(&st, (gvi_real)0.078125, q, NULL, p));
    for (int i = 0; i < MOST; ++i) {
        assert_close(q[i], half.q[i], 16*EPS);
        assert_close(p[i], half.p[i], 100*EPS);
    }
    st.counters.factorizations = 0;
    go(&st, (gvi_real)0.0625, 1);
    assert_int_equal(st.counters.factorizations, 0);
    memcpy(end, st.q, sizeof end);
    begin(&half, &desc, spare, sizeof spare);
    go(&half, (gvi_real)0.0625, 3);
    assert_same_numbers(end, half.q, COUNT(end));
}

/* A point at a spring of length 1 and frequency 64, h omega = 6.4, as in everywhere/bits.c */
enum { STIFFNESS = 4096, POINTS = 8 };

GVI_EACH(pendulum, 2, f)
{
    const gvi_real X = x->q[0], Y = x->q[1], r = (gvi_real)sqrtl((wide)(X*X + Y*Y));
    const gvi_real s = STIFFNESS*(r - 1);
    x->f[0] -= s*X/r;
    x->f[1] -= s*Y/r;
}

typedef struct gauss { wide A[POINTS][POINTS], c[POINTS], b[POINTS]; } gauss;

/* a_ij = integral of the j-th Lagrange polynomial from 0 to c_i, by the rule on [0, c_i] */
static gauss gauss_rule(void)
{
    gauss g;
    gauss_nodes(POINTS, g.c, g.b);
    for (int i = 0; i < POINTS; ++i)
        for (int j = 0; j < POINTS; ++j) {
            g.A[i][j] = 0;
            for (int k = 0; k < POINTS; ++k) {
                wide l = g.c[i]*g.b[k];
                for (int m = 0; m < POINTS; ++m)
                    if (m != j) l *= (g.c[i]*g.c[k] - g.c[m])/(g.c[j] - g.c[m]);
                g.A[i][j] += l;
            }
        }
    return g;
}

// x_i = start + h sum_j A_ij f_j
static void integral(const gauss *g, wide start, wide h, const wide *f, wide *x)
{
    for (int i = 0; i < POINTS; ++i) {
        x[i] = start;
        for (int j = 0; j < POINTS; ++j) x[i] += h*g->A[i][j]*f[j];
    }
}

/* F := forces on the curve from z = (q, p) that F makes; returns the largest change */
static wide ask_again(const gauss *g, wide h, const wide *z, wide F[2][POINTS])
{
    wide P[POINTS], Q[2][POINTS], change = 0;
    for (int k = 0; k < 2; ++k) {
        integral(g, z[2 + k], h, F[k], P);
        integral(g, z[k], h, P, Q[k]);
    }
    for (int i = 0; i < POINTS; ++i) {
        const wide r = sqrtl(Q[0][i]*Q[0][i] + Q[1][i]*Q[1][i]);
        for (int k = 0; k < 2; ++k) {
            const wide f = -STIFFNESS*(r - 1)*Q[k][i]/r;
            change = fmaxl(change, fabsl(f - F[k][i]));
            F[k][i] = f;
        }
    }
    return change;
}

static void state_of(const gvi_stepper *st, wide *z)
{
    for (int i = 0; i < 2; ++i) {
        z[i] = (wide)st->q[i] + st->q_low[i];
        z[2 + i] = (wide)st->p[i] + st->p_low[i];
    }
}

/* The square of the error of p after a step: the same step from the same state in long double, which starts
   from the forces that were found */
static wide error_of_step(const gauss *g, gvi_stepper *st, gvi_real h)
{
    wide z[4], after[4], F[2][POINTS], sum = 0;
    state_of(st, z);
    assert_ok(gvi_step(st, h));
    state_of(st, after);
    for (int j = 0; j < POINTS; ++j) {
        gvi_real Q[2];
        assert_ok(gvi_curve(st, (gvi_real)g->c[j], Q, NULL));
        const wide r = sqrtl((wide)Q[0]*Q[0] + (wide)Q[1]*Q[1]);
        for (int k = 0; k < 2; ++k) F[k][j] = -STIFFNESS*(r - 1)*Q[k]/r;
    }
    for (int m = 0; m < 200 && ask_again(g, h, z, F) > STIFFNESS*(wide)EPS/256; ++m) continue;
    for (int k = 0; k < 2; ++k) {
        wide error = after[2 + k] - z[2 + k];
        for (int j = 0; j < POINTS; ++j) error -= h*g->b[j]*F[k][j];
        sum += error*error;
    }
    return sum;
}

/* The error of p in a step of Newton's method, rms over orbits of 100 steps, in units of a kick
   K EPS h sqrt(sum b^2).  (A fixed point at h omega = 6.4 can let roundings grow before they shrink.) */
static wide error_in_kicks(gvi_formulation formulation)
{
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = pendulum };
    const gvi_desc desc = { .n = 2, .degree = POINTS, .effects = &effect, .effect_count = 1,
                            .formulation = formulation };
    const gauss g = gauss_rule();
    wide error = 0, kicks = 0;
    for (int m = 0; m < 20; ++m) {
        const gvi_real q[] = { 1 + (gvi_real)random_unit()/1024, 1/(gvi_real)64 };
        const gvi_real v[] = { 1/(gvi_real)4, (1 + (gvi_real)random_unit()/1024)/3 };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k < 100; ++k) {
            const gvi_real h = (gvi_real)(k % 50 == 49 ? 0.05 : 0.1);   // then AUTO tries its fixed point
            const wide squared = error_of_step(&g, &st, h);
            if (st.formulation != GVI_NEWTON) continue;
            error += squared;
            for (int j = 0; j < POINTS; ++j) kicks += h*g.b[j]*h*g.b[j];
        }
    }
    return sqrtl(error/kicks)/(STIFFNESS*(wide)EPS);
}

/* Nothing can be more exact than the force, K (r - 1), and that knows r to 0.3 EPS rms: numbers in [1/2, 1)
   are rounded by EPS/4 at most, rms EPS/4/sqrt(3), those in [1, 2) by twice that; with r on both sides of 1,
   in squares of EPS, r itself gives 5/32/3, the point's place 1/16/3, and X^2 + Y^2, which moves r by half,
   1/16/3 with its terms: 0.094.  A force that is off at node j is a kick h b_j.  In p there are two of each:
   of the forces that y was solved with, and of those at the solution; in the first is what the iterations
   before left, a quarter of a quarter and so on: sqrt(1 + 1/(1 - 1/16)) = 1.44 in all, 0.44 kicks.  The
   turn of the spring from node to end only makes it less. */
TEST(a_stiff_spring_is_as_exact_as_its_force)
{
    if ((wide)EPS < 1000*(wide)LDBL_EPSILON) skip();
    assert_between(0.1L, error_in_kicks(GVI_NEWTON), 0.44L);
    assert_between(0.1L, error_in_kicks(GVI_AUTO), 0.44L);
}

/* Newton's method with a new matrix at each step contracts by about the step itself: what turns by h on
   a circle is foretold to h or better, and rounding is no contraction */
TEST(the_contraction_is_that_of_the_changes)
{
    static const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = attraction };
    static const gvi_desc desc = { .n = 2, .degree = 3, .effects = &effect, .effect_count = 1,
                                   .formulation = GVI_NEWTON };
    for (int k = 3; k < 8; ++k) {
        const gvi_real h = 1/(gvi_real)(1 << k);
        gvi_stepper st = new_motion(&desc, 0, (const gvi_real[]){ 1, 0 }, (const gvi_real[]){ 0, 1 });
        for (int j = 0; j < 200; ++j) assert_ok(gvi_step(&st, h));
        assert_between(0, st.counters.worst_contraction, h);
    }
}

AT_POINT(harmonic) { return f[0] -= q[0], 0; }

/* A large scene is set up in memory that grows like n, and Newton's method is there when it is asked for */
TEST(a_large_scene_needs_no_matrices)
{
    static const gvi_effect effect = { .kind = GVI_POTENTIAL, .point = harmonic };
    gvi_desc desc = { .n = 512, .degree = 2, .effects = &effect, .effect_count = 1 };
    const size_t most = gvi_size(&desc);
    assert_true(most > 2*1024*1024*sizeof(gvi_real));              // two matrices, as far as it is ready
    desc.n = 513;
    assert_true(gvi_size(&desc) < most/10);
    const size_t one = gvi_size(&desc);
    desc.n = 2*513;
    assert_between(1.9L*one, gvi_size(&desc), 2.1L*one);
    desc.formulation = GVI_NEWTON;
    assert_between(30*one, gvi_size(&desc), 1e12L);
}

AT_POINT(swinging) { return f[0] -= sin(q[0]), 0; }

/* A pendulum at rest at 1 rad, steps longer than its period.  Newton's method found solutions, and its energy
   went from -0.54 to 51.  Steps may fail; none may leave the well (degree 2 to h = 8.5, beyond which it is too coarse) */
TEST(no_step_is_another_motions)
{
    static const gvi_effect effect = { .kind = GVI_POTENTIAL, .point = swinging };
    const gvi_real q = 1, v = 0;
    for (int degree = 2; degree <= 8; degree *= 2)
        for (int k = 0; k < (degree == 2 ? 31 : 40); ++k) {
            const gvi_desc desc = { .n = 1, .degree = degree, .effects = &effect, .effect_count = 1 };
            const gvi_real h = (gvi_real)(1 + 0.25*k);
            gvi_stepper st = new_motion(&desc, 0, &q, &v);
            for (int j = 0; j < 20 && gvi_step(&st, h) == GVI_OK; ++j) {
                const double p = (double)st.p[0];
                assert_between(-1.0001, p*p/2 - cos((double)st.q[0]), 1);
            }
        }
}

HESSIAN(wrong_hessian) { return fq[0] -= *(const real *)user, 0; }

/* L = v^2/2 + u v^4/4 + b q_1 v_0 - k q^2/2, user: u, b, k */
static int heavier_with_v(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    const real *a = user;
    for (int i = 0; i < 2; ++i) {
        dldv[i] += a[0]*v[i]*v[i]*v[i];
        f[i] -= a[2]*q[i];
    }
    dldv[0] += a[1]*q[1];
    f[1] += a[1]*v[0];
    return (void)t, 0;
}

/* Two of 60,000 random steps of up to 20 radians: iterations left for where v^3 is all, an inertia that is not that of v
   took v^3 for rounding there, and the steps ended beyond 1e7.  The energy bounds q, and four times that a coarse step. */
TEST(a_mass_may_grow_with_v)
{
    static const struct { int degree; double h, a[3], q[2], v[2]; } steps[] = {
        { 5, 1.7546501661905323, { 0.74016879116743628, -0.11757691303155249, 70.154765525836552 },
          { 0.50470296456697539, 0.54582082552175071 }, { 0.018411826816579158, -0.77828546882527205 } },
        { 7, 2.0852180846432309, { 0.72888878890151565, -0.7471216184772187, 85.078697549095736 },
          { -0.41667416105823318, 0.62300269381282969 }, { 0.19667644016289909, 0.23237246052938154 } } };
    for (int k = 0; k < COUNT(steps); ++k) {
        const double *A = steps[k].a;
        real a[] = { (real)A[0], (real)A[1], (real)A[2] }, energy = 0, q[2], v[2];
        for (int i = 0; i < 2; ++i) {
            q[i] = (real)steps[k].q[i];
            v[i] = (real)steps[k].v[i];
            energy += v[i]*v[i]/2 + 3*a[0]*v[i]*v[i]*v[i]*v[i]/4 + a[2]*q[i]*q[i]/2;
        }
        const gvi_effect e = { .kind = GVI_LAGRANGIAN, .point = heavier_with_v, .user = a };
        const gvi_desc desc = { .n = 2, .degree = steps[k].degree, .effects = &e, .effect_count = 1,
                                .formulation = GVI_NEWTON };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        if (gvi_step(&st, (real)steps[k].h) == GVI_OK)
            assert_between(0, (st.q[0]*st.q[0] + st.q[1]*st.q[1])*a[2]/2, 4*energy);
        assert_ok(gvi_start(&st, 0, q, v));
        for (int i = 0; i < 64; ++i) {
            assert_ok(gvi_step(&st, (real)steps[k].h/64));
            assert_between(0, (st.q[0]*st.q[0] + st.q[1]*st.q[1])*a[2]/2, energy*(1 + (real)0.01));
        }
    }
}

/* f = -q, with -K as its derivative: K of 1e10 makes changes that are small, and the solution is not near */
TEST(a_wrong_hessian_costs_iterations_or_the_step)
{
    for (int e = -18; e <= 30; e += 2) {
        static const double few[] = { 2, -1, 0 };
        gvi_real stiff = (gvi_real)(e < -12 ? few[(e + 18)/2] : pow(10, e)*(1 + 0.9*sin(e)));
        const gvi_effect effect = { .kind = GVI_POTENTIAL, .point = harmonic, .hessian = wrong_hessian, .user = &stiff };
        const gvi_real q = 1, v = 0, h = (gvi_real)0.1L;
        for (int degree = 2; degree <= 8; degree *= 2) {
            const gvi_desc desc = { .n = 1, .degree = degree, .effects = &effect, .effect_count = 1,
                                    .formulation = GVI_NEWTON };
            gvi_stepper st = new_motion(&desc, 0, &q, &v);
            for (int k = 0; k < 10 && gvi_step(&st, h) == GVI_OK; ++k)
                assert_close(st.q[0], cos((double)st.t), degree == 2 ? 5e-7 + 20*EPS : 1e-8 + 20*EPS);
            if (e <= 0) assert_ok(st.status);
        }
    }
}

typedef struct units { gvi_real length[2], time, mass[2]; int term; } units;

/* In units of its own: L = ((1 + x^2) x'^2 + x'^4/2 + y'^2 + x x'y')/2 - (x - 1)^2/2 - y^2/2 + x y/4; or by a
   constant mass and with forces -(x - 1) + y/4 - x'y/4 - x'^3, -y + x/4 - y'|x'|/8 */
static int beads(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *f, gvi_real *dldv, void *user)
{
    const units *u = user;
    const gvi_real x = q[0]/u->length[0], y = q[1]/u->length[1];
    const gvi_real w = v[0]/u->length[0]*u->time, z = v[1]/u->length[1]*u->time;
    const gvi_real fx = 1 - x + y/4, fy = x/4 - y;
    if (u->term) {
        f[0] += (fx + x*w*w + w*z/2)/u->length[0];
        f[1] += fy/u->length[1];
        dldv[0] += ((1 + x*x)*w + w*w*w + x*z/2)*u->time/u->length[0];
        dldv[1] += (z + x*w/2)*u->time/u->length[1];
    }
    else {
        f[0] += (fx - w*y/4 - w*w*w)/u->length[0];
        f[1] += (fy - z*(gvi_real)fabs((double)w)/8)/u->length[1];
    }
    return (void)t, 0;
}

/* From rest at 0, derivatives by differences; units of length and time of 1e-30 to 1e30, in float of 1e-6 to 1e6.
   Energies are of 1: masses go with (time/length)^2, to 1e+-120 */
TEST(differences_have_no_units)
{
    const int most = EPS > (gvi_real)1e-10 ? 20 : 100;
    for (int term = 0; term < 2; ++term) {
        gvi_real first[2] = { 0, 0 };
        unsigned long counts[2] = { 0, 0 };
        for (int k = 0; k < 27; ++k) {
            // first of all the units of 1
            const int a = (k + 1)%3 - 1, b = (k/3 + 1)%3 - 1, c = (k/9 + 1)%3 - 1;
            units u = { { (gvi_real)ldexp(1, most*a), (gvi_real)ldexp(1, most*b) }, (gvi_real)ldexp(1, most*c),
                        { 0, 0 }, term };
            for (int i = 0; i < 2; ++i) u.mass[i] = u.time/u.length[i]*(u.time/u.length[i]);
            const gvi_effect effect = { .kind = term ? GVI_LAGRANGIAN : GVI_FORCE, .point = beads, .user = &u };
            const gvi_desc desc = { .n = 2, .degree = 4, .effects = &effect, .effect_count = 1,
                                    .mass = { .kind = term ? GVI_MASS_NONE : GVI_MASS_DIAGONAL, .matrix = u.mass },
                                    .formulation = GVI_NEWTON };
            const gvi_real q[2] = { 0, 0 }, v[2] = { 0, 0 };
            gvi_stepper st = new_motion(&desc, 0, q, v);
            go(&st, u.time/4, 1);
            const unsigned long one = (unsigned long)st.counters.newton_iterations;
            go(&st, u.time/4, 19);
            const unsigned long all = (unsigned long)st.counters.newton_iterations;
            for (int i = 0; i < 2 && k == 0; ++i) first[i] = st.q[i], counts[i] = i ? all : one;
            for (int i = 0; i < 2; ++i) assert_close(st.q[i]/u.length[i], first[i], 64*EPS);
            // pivots are chosen by rows, and that depends on the ratio of the units
            const long double slack = a == b ? 0 : 0.1L;
            assert_between((1 - slack)*counts[0] - 10*slack, one, (1 + slack)*counts[0] + 10*slack);
            assert_between((1 - slack)*counts[1], all, (1 + slack)*counts[1]);
        }
    }
}

/* A heavy top, L(q,v) of Euler's angles; its derivatives by central differences, wrong by 1e-6 and noisy by 1e-13 */
static double top(const double *q, const double *v)
{
    const double s = sin(q[0]), c = cos(q[0]), w = v[2] + v[1]*c;
    return 0.01*(v[0]*v[0] + v[1]*v[1]*s*s) + 0.0025*w*w - 0.5*c;
}

static int noisy_top(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *f, gvi_real *dldv, void *user)
{
    const double d = 1e-3;
    for (int i = 0; i < 3; ++i)
        for (int side = -1; side < 2; side += 2) {
            double x[3], y[3];
            for (int k = 0; k < 3; ++k) x[k] = (double)q[k], y[k] = (double)v[k];
            x[i] += side*d;
            f[i] += (gvi_real)(side*top(x, y)/(2*d));
            x[i] -= side*d;
            y[i] += side*d;
            if (dldv) dldv[i] += (gvi_real)(side*top(x, y)/(2*d));
        }
    return 0;
}

/* Newton's method may come to rest in noise and then run away from there, as its matrix, of differences of
   differences, is bad.  Once it had been at rest such a step was ok, wherever it ended: theta = 132, and
   more.  The top's is between the poles, 0 and pi, where p_phi != p_psi does not let it go. */
TEST(what_grows_is_not_at_rest)
{
    static const gvi_effect effect = { .kind = GVI_LAGRANGIAN, .point = noisy_top };
    static const gvi_desc desc = { .n = 3, .degree = 8, .mass = { .kind = GVI_MASS_NONE }, .effects = &effect,
                                   .effect_count = 1 };
    if (KIND != 2) skip();
    for (int m = 0; m < 100; ++m) {
        const gvi_real q[] = { (gvi_real)(0.8 + 0.5*(double)random_unit()), 0, 0 }, v[] = { 0, (gvi_real)(1 + (double)random_unit()), 200 };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k < 10 && gvi_step(&st, (gvi_real)0.01) == GVI_OK; ++k) assert_between(-10, st.q[0], 10);
    }
}

/* A charge in a trap and a field, L = |v|^2/2 + w (x vy - y vx) - |q|^2/2, from rest at (1, 0), where dL/dv is w and not 0:
   x + iy = (b e^(iat) - a e^(ibt))/(b - a), a, b = -w +- sqrt(w^2 + 1) */
GVI_EACH(charge_in_field, 2, v, f, dldv)
{
    const real w = *(const real *)user;
    x->f[0] += w*x->v[1] - x->q[0];
    x->f[1] += -w*x->v[0] - x->q[1];
    x->dldv[0] -= w*x->q[1];
    x->dldv[1] += w*x->q[0];
}

TEST(a_term_linear_in_v_starts_from_rest)
{
    for (int k = 0; k < 8*12*10; ++k) {
        const int s = 1 + k % 8;
        const wide w = ldexpl(1, k/8 % 12 - 8), h = ldexpl(1, -1 - k/96), root = sqrtl(w*w + 1), a = root - w, b = -root - w;
        real field = (real)w;
        const gvi_effect e = { .kind = GVI_LAGRANGIAN, .points = charge_in_field, .user = &field };
        const gvi_desc desc = { .n = 2, .degree = s, .effects = &e, .effect_count = 1 };
        gvi_stepper st = new_motion(&desc, 0, (real[]){ 1, 0 }, (real[]){ 0, 0 });
        assert_ok(gvi_step(&st, (real)h));
        if (s < 8 || h*(root + w) > 1) continue;
        assert_close(st.q[0], (b*cosl(a*h) - a*cosl(b*h))/(b - a), 32*EPS);
        assert_close(st.q[1], (b*sinl(a*h) - a*sinl(b*h))/(b - a), 32*EPS);
    }
}

/* Such a charge in polar coordinates, where L alone makes the masses, from rest or nearly, at steps so short that the
   angle moves by less than the rounding of p: L = (r'^2 + r^2 w^2)/2 + r^2 w - 3/2 r^2.  In a frame that turns by 1 it
   is an oscillator of frequency 2: x = cos 2t + r0'/2 sin 2t, y = (1 + w0)/2 sin 2t, and the angle is that of (x, y)
   less t. */
GVI_EACH(charge_in_polar, 2, v, f, dldv)
{
    const real r = x->q[0], a = x->v[0], w = x->v[1];
    x->f[0] += r*w*w + 2*r*w - 3*r;
    x->dldv[0] += a;
    x->dldv[1] += r*r*w + r*r;
}

TEST(a_general_L_starts_from_rest_however_short_the_step)
{
    static const real small = (real)0x1p-20L, least = (real)0x1p-30L,
                      starts[][2] = { { 0, 0 }, { small, 0 }, { small, small }, { 0, least }, { 0.25L, -0.5L } };
    static const gvi_effect e = { .kind = GVI_LAGRANGIAN, .points = charge_in_polar };
    for (int k = 0; k < COUNT(starts); ++k)
        for (int j = 3; j <= 9; ++j)
            for (int degree = 4; degree <= 8; degree += 4) {
                const gvi_desc desc = { .n = 2, .degree = degree, .mass = { .kind = GVI_MASS_NONE }, .effects = &e, .effect_count = 1 };
                gvi_stepper st = new_motion(&desc, 0, (real[]){ 1, 0 }, starts[k]);
                const real h = pow((real)10, (real)-j);
                for (int i = 0; i < 20; ++i) assert_ok(gvi_step(&st, h));
                const wide t = 20*(wide)h, dr = starts[k][0], L = 1 + (wide)starts[k][1],
                           x = cosl(2*t) + dr/2*sinl(2*t), y = L/2*sinl(2*t);
                assert_close(st.q[0], sqrtl(x*x + y*y), 8*EPS);
                assert_close(st.q[1], atan2l(y, x) - t, 8*EPS*t);
            }
}

/* The same by the dial: beside a large p, rounding of v is no error of a step, however short the step is.  The inertia is
   d2L/dv2; p over v, which a gauge makes as large as it likes, would make that rounding an error of a step from rest. */
TEST(a_mass_of_terms_is_measured_as_it_is_whatever_the_gauge)
{
    static const gvi_effect e = { .kind = GVI_LAGRANGIAN, .points = charge_in_polar };
    const gvi_desc desc = { .n = 2, .degree = 8, .mass = { .kind = GVI_MASS_NONE }, .effects = &e, .effect_count = 1,
                            .resolution = (real)1e-4L };
    for (int k = 1; k <= 40; ++k) {
        gvi_stepper st = new_motion(&desc, 0, (real[]){ 1, 0 }, (real[]){ 0, 0 });
        assert_ok(gvi_step(&st, (real)ldexp(1, -k)));
    }

    gvi_stepper st = new_motion(&desc, 0, (real[]){ 1, 0 }, (real[]){ 0, 0 });
    while (st.status == GVI_OK && st.t < 1 && st.counters.steps < 100) gvi_advance(&st, 1);
    assert_ok(st.status);
    // 2^-10 of the way, and twice as long each time
    assert_in_range(st.counters.steps, 9, 12);
    assert_close(st.q[0], sqrtl(cosl(2)*cosl(2) + sinl(2)*sinl(2)/4), desc.resolution);
    assert_close(st.q[1], atan2l(sinl(2)/2, cosl(2)) - 1, desc.resolution);
}

/* Damped springs at a contraction of about 1/4: two bits an iteration, 27 and more of them a step, to Newton's 2 */
GVI_EACH(damped_spring, 4, v, f)
{
    for (int i = 0; i < 4; ++i) x->f[i] -= 16*x->q[i] + 4*x->v[i] + x->q[i]*x->q[i]*x->q[i]/64;
}

TEST(what_gains_less_than_two_bits_an_iteration_is_left_to_newton)
{
    const gvi_real q[] = { 1, (gvi_real)0.25, (gvi_real)-0.5, (gvi_real)0.125 }, v[] = { 0, 1, (gvi_real)0.5, -1 };
    const gvi_effect springs[] = { { .kind = GVI_FORCE, .points = damped_spring } };
    unsigned long long points[2];
    gvi_real end[2];
    for (int pinned = 0; pinned < 2; ++pinned) {
        const gvi_desc desc = { .n = 4, .degree = 1, .effects = springs, .effect_count = 1,
                                .formulation = pinned ? GVI_VELOCITIES : GVI_AUTO };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k < 200; ++k) assert_ok(gvi_step(&st, (gvi_real)0.1L));
        points[pinned] = st.counters.effect[0];
        end[pinned] = st.q[0];
    }
    assert_true(points[0] < points[1]/2);
    assert_close(end[0], end[1], 200*EPS);
}

RUN_TESTS(NULL, NULL)
