/* What can be asked of a stepper: velocity, energy, the curve, the state inside a step, the action,
   the discrete Lagrangian with all that belongs to it. Against closed forms, against each other,
   and against differences (in long double by default, so that those say something). */
#ifndef GVI_REAL
#define GVI_REAL long double
#endif
#include "gvi_test.h"
#include "problems.h"

#define PI 3.14159265358979323846264338327950288L

static real memory[2][60000];

static void set_up(gvi_stepper *st, const gvi_desc *desc, int slot)
{
    *st = new_stepper(desc);
}

static void assert_vectors_close(const real *a, const real *b, real tol)
{
    for (int i = 0; i < 2; ++i) assert_close(a[i], b[i], tol);
}

/* Two degrees of freedom.  V = -g(t) (2 cos q1 + cos(q1 + q2)), g = 1 + sin(2t)/2;
   a term linear in v, a = (-q2 (1 + q1^2), q1)/2; drag and a drive. */

static real clock_of(real t) { return 1 + sin(2*t)/2; }
static real V(real t, const real *q) { return -clock_of(t)*(2*cos(q[0]) + cos(q[0] + q[1])); }

AT_POINT(drag)
{
    f[0] += cos(t)/3 - v[0]/4;
    f[1] -= (1 + q[0]*q[0])*v[1]/5;
    return 0;
}

HESSIAN(drag_hessian)
{
    fv[0] -= 0.25L;
    fq[2] -= 2*q[0]*v[1]/5;
    fv[3] -= (1 + q[0]*q[0])/5;
    return 0;
}

static const real diagonal[2] = { 2, 0.5L }, dense[4] = { 2, 0.5L, 0.5L, 1 };

/* What M is, by hand */
static void mass_by_hand(gvi_mass_kind kind, const real *q, real *m11, real *m12, real *m22)
{
    real c = cos(q[1]);
    *m11 = kind == GVI_MASS_UNIT ? 1 : kind == GVI_MASS_POSITION ? 3 + 2*c : 2;
    *m12 = kind == GVI_MASS_DENSE ? 0.5L : kind == GVI_MASS_POSITION ? 1 + c : 0;
    *m22 = kind == GVI_MASS_DIAGONAL ? 0.5L : 1;
}

static gvi_mass mass_of(gvi_mass_kind kind)
{
    gvi_mass m = { .kind = kind };
    if (kind == GVI_MASS_DIAGONAL) m.matrix = diagonal;
    if (kind == GVI_MASS_DENSE) m.matrix = dense;
    if (kind == GVI_MASS_POSITION) { m.points = pendulum_mass; m.gradient = pendulum_mass_gradient; }
    return m;
}

static const gvi_effect effects[] = {
    { .kind = GVI_POTENTIAL, .point = weights, .value = weights_value, .hessian = weights_hessian, .user = memory },
    { .kind = GVI_LAGRANGIAN, .point = field, .value = field_value, .hessian = field_hessian },
    { .kind = GVI_FORCE, .point = drag, .hessian = drag_hessian },
};
enum { CONSERVATIVE = 2, FORCED = 3 };                       /* how many of them */

static const real q_start[2] = { 0.7L, -0.4L }, v_start[2] = { 0.3L, 0.5L };

static gvi_desc scene(gvi_mass_kind kind, int effect_count, int s, int r)
{
    return (gvi_desc){ .n = 2, .degree = s, .rule = { .points = r }, .mass = mass_of(kind),
                       .effects = effects, .effect_count = effect_count };
}

static void start_scene(gvi_stepper *st, int kind, int effect_count, int s, int r, real t)
{
    const gvi_desc desc = scene((gvi_mass_kind)kind, effect_count, s, r);
    set_up(st, &desc, 0);
    assert_ok(gvi_start(st, t, q_start, v_start));
}

TEST(velocity_and_energy_are_right_for_every_mass)
{
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind) {
        gvi_stepper st;
        start_scene(&st, kind, FORCED, 4, 4, 0.3L);
        for (int k = 0; k <= 3; ++k) {
            real m11, m12, m22, v[2], E;
            const real a[2] = { -st.q[1]*(1 + st.q[0]*st.q[0])/2, st.q[0]/2 };
            mass_by_hand((gvi_mass_kind)kind, st.q, &m11, &m12, &m22);
            assert_ok(gvi_velocity(&st, v));
            assert_ok(gvi_energy(&st, &E));
            assert_close(m11*v[0] + m12*v[1] + a[0], st.p[0], 16*EPS);
            assert_close(m12*v[0] + m22*v[1] + a[1], st.p[1], 16*EPS);
            assert_close(E, (m11*v[0]*v[0] + 2*m12*v[0]*v[1] + m22*v[1]*v[1])/2 + V(st.t, st.q), 16*EPS);
            if (k == 0) assert_vectors_close(v, v_start, 8*EPS);
            assert_ok(gvi_step(&st, 0.1L));
        }
    }
}

/* L = -sqrt(1 - v'v): p = v/sqrt(1 - v'v), so v = p/sqrt(1 + p'p) and the energy
   is sqrt(1 + p'p). */
AT_POINT(relativistic)
{
    real w = 1 - v[0]*v[0] - v[1]*v[1];
    if (!(w > 0)) return 1;                                  /* faster than light */
    dldv[0] += v[0]/sqrt(w);
    dldv[1] += v[1]/sqrt(w);
    return 0;
}

GVI_EACH(relativistic_value, 2, v, value)
{
    real a = x->v[0], b = x->v[1];
    x->value[0] -= sqrt(1 - a*a - b*b);
}

AT_EACH(relativistic_velocity)
{
    const int k = a % x->stride;
    x->velocity[a] = x->p[a]/sqrt(1 + x->p[k]*x->p[k] + x->p[x->stride + k]*x->p[x->stride + k]);
}

static const gvi_effect fast[] = {
    { .kind = GVI_LAGRANGIAN, .point = relativistic, .value = relativistic_value },
    { .kind = GVI_POTENTIAL, .point = weights, .value = weights_value, .user = memory },
};

/* By Newton's method where only dL/dv is known, and by the caller's own inverse */
TEST(velocity_and_energy_are_right_for_a_general_lagrangian)
{
    for (int given = 0; given <= 1; ++given) {
        const gvi_desc desc = { .n = 2, .degree = 4, .effects = fast, .effect_count = 2,
                                .mass = { .kind = GVI_MASS_NONE, .velocity = given ? relativistic_velocity : NULL } };
        gvi_stepper st;
        set_up(&st, &desc, 0);
        assert_int_equal(st.formulation, given ? GVI_MOMENTA : GVI_NEWTON);
        for (int by_momentum = 0; by_momentum <= 1; ++by_momentum) {
            if (by_momentum) assert_ok(gvi_start_momentum(&st, 0.3L, q_start, (const real[]){ 0.5L, -0.2L }));
            else assert_ok(gvi_start(&st, 0.3L, q_start, (const real[]){ 0.6L, 0.5L }));
            for (int k = 0; k < 3; ++k) {
                real v[2], E, w = sqrt(1 + st.p[0]*st.p[0] + st.p[1]*st.p[1]);
                assert_ok(gvi_velocity(&st, v));
                assert_ok(gvi_energy(&st, &E));
                assert_vectors_close(v, (const real[]){ st.p[0]/w, st.p[1]/w }, 16*EPS);
                /* p'v - L adds and subtracts numbers of the size of 1/(1 - v'v) */
                assert_close(E, w + V(st.t, st.q), 32*EPS);
                assert_ok(gvi_step(&st, 0.1L));
            }
        }
    }
}

/* A charge in a field, dL/dv = v + a(q): a difference of dL/dv by a v_i next to 0 must not be lost in a */
GVI_EACH(uniform_field, 2, v, f, dldv)
{
    x->f[0] += x->v[1]/2, x->f[1] -= x->v[0]/2;
    x->dldv[0] -= x->q[1]/2, x->dldv[1] += x->q[0]/2;
}

TEST(velocities_next_to_0_are_found_beside_a_vector_potential)
{
    const gvi_effect charge[] = { { .kind = GVI_LAGRANGIAN, .points = uniform_field } };
    gvi_desc desc = { .n = 2, .degree = 4, .effects = charge, .effect_count = 1 };
    for (int newton = 0; newton <= 1; ++newton)
        for (real small = 1; small > 1e-30L; small /= 1000) {
            gvi_stepper st;
            real v[2];
            desc.formulation = newton ? GVI_NEWTON : GVI_AUTO;
            set_up(&st, &desc, 0);
            assert_ok(gvi_start(&st, 0, (const real[]){ 1, 1 }, (const real[]){ 1, small }));
            assert_ok(gvi_velocity(&st, v));
            assert_vectors_close(v, (const real[]){ 1, small }, 4*EPS);
            assert_ok(gvi_step(&st, 0.1L));                      // it turns, at unit speed
            assert_ok(gvi_velocity(&st, v));
            assert_close(hypot(v[0], v[1]), hypot(1, small), 16*EPS);
        }
}

TEST(the_three_starts_agree)
{
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind)
    for (int count = CONSERVATIVE; count <= FORCED; ++count) {
        gvi_desc desc = scene((gvi_mass_kind)kind, count, 4, 4);
        gvi_stepper st[2];
        real p0[2], q1[2], p1[2], h = 0.2L;

        start_scene(&st[0], kind, count, 4, 4, 0.3L);
        memcpy(p0, st[0].p, sizeof p0);
        assert_ok(gvi_step(&st[0], h));
        memcpy(q1, st[0].q, sizeof q1);
        memcpy(p1, st[0].p, sizeof p1);

        set_up(&st[1], &desc, 1);
        assert_ok(gvi_start_momentum(&st[1], 0.3L, q_start, p0));
        assert_same_numbers(st[1].q, q_start, 2);
        assert_same_numbers(st[1].p, p0, 2);
        assert_ok(gvi_step(&st[1], h));
        assert_vectors_close(st[1].q, q1, 8*EPS);
        assert_vectors_close(st[1].p, p1, 16*EPS);

        /* p0 from q1 - q0: rounding grows by 1/h */
        assert_ok(gvi_start_configurations(&st[1], 0.3L, h, q_start, q1));
        assert_true(st[1].t == 0.3L || fabs(st[1].t - 0.3L) < EPS);
        assert_same_numbers(st[1].q, q_start, 2);
        assert_vectors_close(st[1].p, p0, 16*EPS/h*4);
        assert_ok(gvi_step(&st[1], h));
        assert_vectors_close(st[1].q, q1, 16*EPS);
        assert_vectors_close(st[1].p, p1, 16*EPS/h*4);
    }
}

TEST(the_curve_begins_at_q0_and_ends_at_q1)
{
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind)
    for (int r = 4; r <= 5; ++r) {
        gvi_stepper st;
        real q0[2], q[2];
        start_scene(&st, kind, FORCED, 4, r, 0.3L);
        assert_ok(gvi_step(&st, 0.2L));
        memcpy(q0, st.q, sizeof q0);
        assert_ok(gvi_step(&st, 0.1L));
        assert_ok(gvi_curve(&st, 0, q, NULL));
        assert_vectors_close(q, q0, EPS);
        assert_ok(gvi_curve(&st, 1, q, NULL));
        assert_vectors_close(q, st.q, 2*EPS);
    }
}

/* From the nearer end: forwards from the start, backwards from the end */
TEST(the_state_inside_a_step_is_a_partial_step_from_the_nearer_end)
{
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind)
    for (int k = 1; k < 8; ++k) {
        gvi_stepper st, part;
        real h = 0.25L, t0 = 0.5L, q[2], v[2], p[2], want[2], q1[2], p1[2];
        if (k == 4) continue;                                /* both ends are as near */
        start_scene(&st, kind, FORCED, 3, 3 + k % 2, t0);
        assert_ok(gvi_step(&st, h));
        memcpy(q1, st.q, sizeof q1);
        memcpy(p1, st.p, sizeof p1);
        assert_ok(gvi_state_at(&st, t0 + h*k/8, q, v, p));

        const gvi_desc desc = scene((gvi_mass_kind)kind, FORCED, 3, 3 + k % 2);
        set_up(&part, &desc, 1);
        if (k < 4) assert_ok(gvi_start(&part, t0, q_start, v_start));
        else assert_ok(gvi_start_momentum(&part, t0 + h, q1, p1));
        assert_ok(gvi_step(&part, k < 4 ? h*k/8 : -h*(8 - k)/8));
        assert_ok(gvi_velocity(&part, want));
        assert_vectors_close(q, part.q, 8*EPS);
        assert_vectors_close(p, part.p, 16*EPS);
        assert_vectors_close(v, want, 16*EPS);
    }
}

/* also late, where t has a compensation term */
TEST(the_state_at_the_ends_of_a_step_is_the_state_there_to_the_bit)
{
    gvi_stepper st;
    real q0[2], p0[2], q[2], p[2], v[2], want[2];
    start_scene(&st, GVI_MASS_POSITION, FORCED, 4, 4, 0.5L);
    assert_ok(gvi_start(&st, 1e6L, q_start, v_start));
    for (int k = 0; k < 1000; ++k) {
        const real h = (1 + k*37 % 101)/(real)(k % 3 ? 400 : -700);
        memcpy(q0, st.q, sizeof q0);
        memcpy(p0, st.p, sizeof p0);
        assert_ok(gvi_step(&st, h));
        assert_ok(gvi_state_at(&st, st.t0, q, NULL, p));
        assert_same_numbers(q, q0, 2);
        assert_same_numbers(p, p0, 2);
        assert_ok(gvi_state_at(&st, st.t, q, v, p));
        assert_same_numbers(q, st.q, 2);
        assert_same_numbers(p, st.p, 2);
        assert_ok(gvi_state_at(&st, st.t - st.h, q, NULL, p));
        assert_vectors_close(q, q0, 1e8L*EPS);                     // a rounding of t
    }
    assert_ok(gvi_velocity(&st, want));
    assert_vectors_close(v, want, 4*EPS);
}

static void ask_everything(gvi_stepper *st, int k)
{
    real a[2], b[2], c[2], number, q1[2] = { st->q[0] + 0.1L, st->q[1] - 0.05L };
    const gvi_discrete out = { .lagrangian = &number, .d1 = a, .d2 = b, .minus = c };
    assert_ok(gvi_velocity(st, a));
    assert_ok(gvi_energy(st, a));
    assert_ok(gvi_curve(st, (real)k/40, a, b));
    assert_ok(gvi_state_at(st, st->t - st->h*(1 + k % 7)/9, a, b, c));
    assert_ok(gvi_action(st, a));
    assert_ok(gvi_discrete_lagrangian(st, 0, 0.2L, st->q, q1, &out));
}

static void start_both(gvi_stepper *one, gvi_stepper *other, const gvi_desc *desc)
{
    set_up(one, desc, 0);
    set_up(other, desc, 1);
    assert_ok(gvi_start(one, 0, q_start, v_start));
    assert_ok(gvi_start(other, 0, q_start, v_start));
}

/* Two runs, one of which is asked everything after each step */
static void expect_queries_to_change_nothing(const gvi_desc *desc, real h, gvi_formulation used)
{
    gvi_stepper quiet, asked;
    start_both(&quiet, &asked, desc);
    for (int k = 0; k < 40; ++k) {
        assert_ok(gvi_step(&quiet, k % 5 ? h : 1.5L*h));
        assert_ok(gvi_step(&asked, k % 5 ? h : 1.5L*h));
        assert_same_numbers(quiet.q, asked.q, 2);
        assert_same_numbers(quiet.p, asked.p, 2);
        assert_int_equal(quiet.formulation, used);
        assert_int_equal(asked.formulation, used);
        ask_everything(&asked, k);
    }
    assert_true(quiet.t == asked.t);
}

AT_EACH(stiff_springs)
{
    const real stiffness = a < x->stride ? 10000 : 1;
    if (x->f) x->f[a] -= stiffness*x->q[a];
    if (x->value) x->value[a % x->stride] += stiffness*x->q[a]*x->q[a]/2;
}

/* In every formulation, and where AUTO has gone over to Newton's method */
TEST(queries_do_not_change_later_steps_to_the_bit)
{
    static const struct { gvi_mass_kind mass; int count, s, r; gvi_formulation used; } cases[] = {
        { GVI_MASS_DENSE,    1,            1, 1, GVI_POSITIONS },
        { GVI_MASS_DENSE,    1,            5, 5, GVI_POSITIONS },
        { GVI_MASS_DIAGONAL, FORCED,       4, 4, GVI_MOMENTA },
        { GVI_MASS_DIAGONAL, FORCED,       4, 6, GVI_NEWTON },
        { GVI_MASS_POSITION, CONSERVATIVE, 5, 5, GVI_MOMENTA },
        { GVI_MASS_POSITION, FORCED,       3, 4, GVI_NEWTON },
    };
    static const gvi_effect stiff[] = { { .kind = GVI_POTENTIAL, .points = stiff_springs, .value = stiff_springs } };
    for (int c = 0; c < COUNT(cases); ++c) {
        gvi_desc desc = scene(cases[c].mass, cases[c].count, cases[c].s, cases[c].r);
        expect_queries_to_change_nothing(&desc, 0.1L, cases[c].used);
    }
    const gvi_effect forced[] = { effects[0], effects[2] };
    gvi_desc damped = scene(GVI_MASS_DIAGONAL, 2, 4, 6);
    damped.effects = forced;
    expect_queries_to_change_nothing(&damped, 0.1L, GVI_VELOCITIES);
    gvi_desc verlet = scene(GVI_MASS_DENSE, 1, 1, 2);
    verlet.rule.kind = GVI_LOBATTO;
    expect_queries_to_change_nothing(&verlet, 0.1L, GVI_EXPLICIT);
    const gvi_desc desc = { .n = 2, .degree = 4, .effects = stiff, .effect_count = 1 };
    expect_queries_to_change_nothing(&desc, 0.5L, GVI_NEWTON);
}

/* A charge in a field B = 1 + x^2 + y^2, L = B (x v_y - y v_x)/2, with a quartic well */
GVI_EACH(field_and_well, 2, v, f, dldv)
{
    const real K = *(const real *)user, a = x->q[0], b = x->q[1], u = x->v[0], w = x->v[1];
    const real B = 1 + a*a + b*b, area = (a*w - b*u)/2;
    x->dldv[0] -= B*b/2;
    x->dldv[1] += B*a/2;
    x->f[0] += 2*a*area + B*w/2 - K*a*a*a;
    x->f[1] += 2*b*area - B*u/2 - K*b*b*b;
}

/* A step by Newton's method leaves no momenta of Lagrangian terms: where the fixed point comes after
   it, what it begins with is not what a query has left in scratch.  (17 of 4000 such runs.) */
TEST(queries_change_nothing_between_newton_and_fixed_point)
{
    int both = 0;
    for (int run = 0; run < 60; ++run) {
        real K = 4 << run % 6;
        const gvi_effect effect = { .kind = GVI_LAGRANGIAN, .points = field_and_well, .user = &K };
        const gvi_desc desc = { .n = 2, .degree = 1 + run % 7, .effects = &effect, .effect_count = 1 };
        const real h = 0.05L*(1 + run % 11);
        gvi_stepper quiet, asked;
        int by_newton = 0;
        start_both(&quiet, &asked, &desc);
        for (int k = 0; k < 20; ++k) {
            const real length = k % 5 == 4 ? 0.37L*h : h;
            real a[2], b[2], c[2];
            assert_int_equal(gvi_step(&quiet, length), gvi_step(&asked, length));
            assert_same_numbers(quiet.q, asked.q, 2);
            assert_same_numbers(quiet.p, asked.p, 2);
            if (by_newton && quiet.status == GVI_OK && quiet.formulation != GVI_NEWTON) ++both;
            by_newton = quiet.status == GVI_OK && quiet.formulation == GVI_NEWTON;
            if (asked.h > 0) (void)gvi_state_at(&asked, asked.t - 0.37L*asked.h, a, b, c);
        }
    }
    assert_true(both > 20);
}

TEST(the_action_of_a_step_is_the_discrete_lagrangian_of_its_ends)
{
    for (int count = 1; count <= FORCED; ++count)
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind) {
        gvi_stepper st;
        real action, Ld;
        start_scene(&st, kind, count, 4, 5, 0.3L);
        assert_ok(gvi_step(&st, 0.25L));
        assert_ok(gvi_action(&st, &action));
        assert_ok(gvi_discrete_lagrangian(&st, 0.3L, 0.25L, q_start, st.q, &(gvi_discrete){ .lagrangian = &Ld }));
        assert_close(Ld, action, 16*EPS);
    }
}

#define OMEGA 1.3L

GVI_EACH(spring, 1, f, value)
{
    x->f[0] -= OMEGA*OMEGA*x->q[0];
    x->value[0] += OMEGA*OMEGA*x->q[0]*x->q[0]/2;
}

static const gvi_effect oscillator[] = { { .kind = GVI_POTENTIAL, .points = spring, .value = spring } };

static void start_oscillator(gvi_stepper *st, int s, gvi_rule_kind rule)
{
    const gvi_desc desc = { .n = 1, .degree = s, .rule = { .kind = rule }, .effects = oscillator, .effect_count = 1 };
    set_up(st, &desc, 0);
    assert_ok(gvi_start(st, 0, (const real[]){ 1 }, (const real[]){ 0.5L }));
}

GVI_EACH(growing, 1, f, value)
{
    x->f[0] += x->t[0];
    x->value[0] -= x->t[0]*x->q[0];
}

TEST(the_discrete_lagrangian_knows_the_time_in_every_formulation)
{
    static const gvi_effect effect[] = { { .kind = GVI_POTENTIAL, .points = growing, .value = growing } };
    const real t = 3, h = 0.5L, q0 = 0.75L, q1 = 0.5L, v = (q1 - q0)/h;
    for (int f = GVI_AUTO; f <= GVI_NEWTON; ++f) {
        gvi_stepper st;
        real Ld, d1, d2, p0, p1;
        if (f == GVI_MOMENTA) continue;                           /* needs r = s */
        const gvi_desc desc = { .n = 1, .degree = 1, .rule = { .kind = GVI_LOBATTO, .points = 2 }, .effects = effect,
                                .effect_count = 1, .formulation = (gvi_formulation)f };
        set_up(&st, &desc, 0);
        assert_ok(gvi_discrete_lagrangian(&st, t, h, &q0, &q1, &(gvi_discrete){
            .lagrangian = &Ld, .d1 = &d1, .d2 = &d2, .p0 = &p0, .p1 = &p1 }));
        assert_close(Ld, h*v*v/2 + h*(t*q0 + (t + h)*q1)/2, 8*EPS);
        assert_close(d1, -v + h*t/2, 8*EPS);
        assert_close(d2, v + h*(t + h)/2, 8*EPS);
        assert_close(p0, -d1, 8*EPS);
        assert_close(p1, d2, 8*EPS);
        assert_ok(gvi_start_configurations(&st, t, h, &q0, &q1));
        assert_ok(gvi_step(&st, h));
        assert_close(st.q[0], q1, 8*EPS);
        assert_close(st.p[0], p1, 8*EPS);
    }
}

/* All of a discrete Lagrangian's parts, by name */
typedef struct { real L, d1[2], d2[2], minus[2], plus[2], p0[2], p1[2]; } discrete;

static void ask_discrete(gvi_stepper *st, real t, real h, const real *q0, const real *q1, discrete *d)
{
    const gvi_discrete out = { &d->L, d->d1, d->d2, d->minus, d->plus, d->p0, d->p1, NULL, NULL };
    assert_ok(gvi_discrete_lagrangian(st, t, h, q0, q1, &out));
}

static const real q_end[2] = { 0.8L, -0.25L };

/* dL_d/dx by central differences of order 8, x one of the four boundary values */
static real difference(gvi_stepper *st, real t, real h, int which)
{
    static const real weight[4] = { (real)4/5, -(real)1/5, (real)4/105, -(real)1/280 };
    real delta = pow((real)EPS, 1/(real)9), sum = 0;
    for (int k = 1; k <= 4; ++k)
        for (int sign = -1; sign <= 1; sign += 2) {
            real x[4] = { q_start[0], q_start[1], q_end[0], q_end[1] }, L;
            x[which] += sign*k*delta;
            assert_ok(gvi_discrete_lagrangian(st, t, h, x, x + 2, &(gvi_discrete){ .lagrangian = &L }));
            sum += sign*weight[k - 1]*L/delta;
        }
    return sum;
}

/* The derivatives that are returned are those of the value that is returned: of
   the whole of it, so also where forces bend the curve.  Rounding of L over
   delta = EPS^(1/9), truncation of that size too.  With forces the answer needs
   second derivatives: those of M(q) are differences, exact to sqrt(EPS). */
TEST(d1_and_d2_are_the_derivatives_of_the_value)
{
    static const int rules[][2] = { { 1, 1 }, { 3, 3 }, { 3, 5 }, { 6, 6 } };
    for (int count = 1; count <= FORCED; ++count)
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind)
    for (int k = 0; k < COUNT(rules); ++k) {
        real bound = count == FORCED && kind == GVI_MASS_POSITION ? sqrt((real)EPS) : 100*pow((real)EPS, 8/(real)9);
        gvi_stepper st;
        discrete d;
        start_scene(&st, kind, count, rules[k][0], rules[k][1], 0);
        ask_discrete(&st, 0.3L, 0.4L, q_start, q_end, &d);
        for (int i = 0; i < 2; ++i) {
            assert_close(d.d1[i], difference(&st, 0.3L, 0.4L, i), bound);
            assert_close(d.d2[i], difference(&st, 0.3L, 0.4L, 2 + i), bound);
        }
    }
}

/* p0 = -d1 - minus and p1 = d2 + plus are the momenta of the step from q0 to q1.
   1/h = 2.5 is the size of the second derivatives of L_d. */
TEST(its_momenta_are_those_of_the_step)
{
    for (int count = 1; count <= FORCED; ++count)
    for (int kind = GVI_MASS_UNIT; kind <= GVI_MASS_POSITION; ++kind)
    for (int s = 1; s <= 5; s += 2) {
        gvi_stepper st;
        discrete d;
        start_scene(&st, kind, count, s, s + (kind + s)/2 % 2, 0);
        ask_discrete(&st, 0.3L, 0.4L, q_start, q_end, &d);
        for (int i = 0; i < 2; ++i) {
            assert_close(d.p0[i], -d.d1[i] - d.minus[i], 32*EPS);
            assert_close(d.p1[i], d.d2[i] + d.plus[i], 4*EPS);
            if (count < FORCED) assert_true(d.minus[i] == 0 && d.plus[i] == 0);
            else assert_true(fabs(d.minus[i]) > 1e-3L && fabs(d.plus[i]) > 1e-3L);
        }
        assert_ok(gvi_start_momentum(&st, 0.3L, q_start, d.p0));
        assert_ok(gvi_step(&st, 0.4L));
        assert_vectors_close(st.q, q_end, 32*EPS);
        assert_vectors_close(st.p, d.p1, 64*EPS);
    }
}

/* The state is untouched, whatever the answer */
TEST(the_discrete_lagrangian_leaves_the_state_alone)
{
    gvi_stepper st;
    discrete d;
    start_scene(&st, GVI_MASS_POSITION, FORCED, 4, 4, 0.1L);
    assert_ok(gvi_step(&st, 0.1L));
    SAME_STATE(&st) ask_discrete(&st, 0.3L, 0.4L, q_start, q_end, &d);
    assert_true(st.h == (real)0.1L);
}

/* h omega = k pi: any curve A sin(omega t) joins 0 to 0. Degree 24 knows that to rounding. The
   step, which is given q0 and p0, does not care: it turns the phase by k pi. */
TEST(conjugate_points_are_reported_and_the_step_does_not_care)
{
    for (int k = 1; k <= 2; ++k) {
        real h = k*(real)PI/(real)OMEGA, q0 = 1, q1 = k == 1 ? -1 : 1, Ld;
        gvi_stepper st;
        start_oscillator(&st, 24, GVI_GAUSS);
        assert_status(gvi_discrete_lagrangian(&st, 0, h, &q0, &q1, &(gvi_discrete){ .lagrangian = &Ld }),
                      GVI_E_CONJUGATE);
        assert_status(gvi_start_configurations(&st, 0, h, &q0, &q1), GVI_E_CONJUGATE);
        assert_true(st.q[0] == 1 && st.p[0] == 0.5L && st.t == 0);
        assert_ok(gvi_step(&st, h));
        assert_close(st.q[0], q1, 50*EPS);                   /* rounding of h*omega too */
        assert_close(st.p[0], q1/2, 50*EPS);
    }
}

RUN_TESTS(NULL, NULL)
