/* Nonholonomic constraints: orders against closed forms and an index-1 reference in long double; slip, energy and
   reversibility in long runs; with rods, redundant rows and all calls; refusals. */
#include "gvi_test.h"

static real memory[60000];

/* ---- a knife edge on a slope: x, y, direction.  Its closed form is that of u, the speed along the blade */

enum { SLOPE = 29 };                              // tenths

GVI_EACH(slope, 3, f, value)
{
    x->f[0] += (real)SLOPE/10;
    x->value[0] -= (real)SLOPE/10*x->q[0];
}

GVI_EACH(knife, 3, rows(1))
{
    x->jacobian[0] = sin(x->q[2]);
    x->jacobian[1] = -cos(x->q[2]);
}

static const gvi_effect knife_scene[] = { { .kind = GVI_POTENTIAL, .points = slope, .value = slope },
                                          { .kind = GVI_NONHOLONOMIC, .points = knife, .rows = 1 } };
static const gvi_desc knife_desc = { .n = 3, .effects = knife_scene, .effect_count = 2 };

static void knife_exact(long double t, long double *z, long double *lambda)
{
    const long double a = SLOPE/10.0L, th0 = 0.2L, th = th0 + t, u0 = 0.5L - a*sin(th0), u = u0 + a*sin(th);
    z[0] = u0*(sin(th) - sin(th0)) + a*(sin(th)*sin(th) - sin(th0)*sin(th0))/2;
    z[1] = -u0*(cos(th) - cos(th0)) + a*(t/2 - (sin(2*th) - sin(2*th0))/4);
    z[2] = th;
    z[3] = u*cos(th);
    z[4] = u*sin(th);
    z[5] = 1;
    *lambda = -(a*sin(th) + u);
}

static void knife_start(real *q, real *v)
{
    long double z[6], lambda;
    knife_exact(0, z, &lambda);
    for (int i = 0; i < 3; ++i) q[i] = (real)z[i], v[i] = (real)z[3 + i];
}

/* ---- a falling disc of mass and radius 1: x, y, yaw, tilt, spin; inertia 1/4 and 1/2 */

GVI_EACH(disc_mass, 5, mass)
{
    const real c = cos(x->q[3]), s = sin(x->q[3]);
    x->mass[0] = x->mass[6] = 1;
    x->mass[12] = s*s/4 + c*c/2;
    x->mass[18] = (real)0.25L + c*c;
    x->mass[22] = c/2;
    x->mass[24] = (real)0.5L;
}

GVI_EACH(disc_slope, 5, v, f)
{
    const real c = cos(x->q[3]), s = sin(x->q[3]), *v = x->v;
    x->f[3] += -c*s*v[3]*v[3] + v[2]*v[2]*s*c/4 - (v[4] + c*v[2])*s*v[2]/2;
}

GVI_EACH(disc_weight, 5, f, value)
{
    x->f[3] -= R(9.81)*cos(x->q[3]);
    x->value[0] += R(9.81)*sin(x->q[3]);
}

GVI_EACH(disc_rolls, 5, rows(2))
{
    const real cf = cos(x->q[2]), sf = sin(x->q[2]), c = cos(x->q[3]), s = sin(x->q[3]);
    real *A = x->jacobian, *B = A + 5;
    A[0] = 1, A[2] = c*cf, A[3] = -s*sf, A[4] = cf;
    B[1] = 1, B[2] = c*sf, B[3] = s*cf, B[4] = sf;
}

static const gvi_effect disc_scene[] = { { .kind = GVI_POTENTIAL, .points = disc_weight, .value = disc_weight },
                                         { .kind = GVI_NONHOLONOMIC, .points = disc_rolls, .rows = 2 } };
static const gvi_desc disc_desc = { .n = 5, .effects = disc_scene, .effect_count = 2,
    .mass = { .kind = GVI_MASS_POSITION, .points = disc_mass, .gradient = disc_slope } };

static void disc_start(real *q, real *v)
{
    static const real q0[] = { 0, 0, 0, R(1.2), 0 }, v0[] = { 0, 0, R(0.6), R(0.1), -6 };
    memcpy(q, q0, sizeof q0);
    memcpy(v, v0, sizeof v0);
    v[0] = -(cos(q[3])*v[2] + v[4]);
    v[1] = -sin(q[3])*v[3];
}

/* ---- a knife edge with a load on a rod: x, y, direction, and the load's u, w */

GVI_EACH(pulled, 5, f, value)
{
    x->f[0] += (real)SLOPE/10;
    x->value[0] -= (real)SLOPE/10*x->q[0];
}

GVI_EACH(blade, 5, rows(1))
{
    x->jacobian[0] = sin(x->q[2]);
    x->jacobian[1] = -cos(x->q[2]);
}

GVI_EACH(rod, 5, rows(1))
{
    const real a = x->q[3] - x->q[0], b = x->q[4] - x->q[1];
    x->g[0] = (a*a + b*b - 1)/2;
    x->jacobian[0] = -a, x->jacobian[1] = -b, x->jacobian[3] = a, x->jacobian[4] = b;
}

static const gvi_effect load_scene[] = { { .kind = GVI_CONSTRAINT, .points = rod, .rows = 1 },
                                         { .kind = GVI_POTENTIAL, .points = pulled, .value = pulled },
                                         { .kind = GVI_NONHOLONOMIC, .points = blade, .rows = 1 } };
static const gvi_desc load_desc = { .n = 5, .effects = load_scene, .effect_count = 3 };

static void load_start(real *q, real *v)
{
    static const real q0[] = { 0, 0, 0, -1, 0 }, v0[] = { R(0.5), 0, 1, R(0.5), R(0.3) };
    memcpy(q, q0, sizeof q0);
    memcpy(v, v0, sizeof v0);
}

/* ---- index-1 reference: M v' - A' lambda = F - M' v, A v' = -A' v (by hand), Runge and Kutta's method.  Steps are powers
   of 2: others round the same way every time */

typedef void accelerations(const long double *q, const long double *v, long double *matrix, long double *right);

static void disc_accelerations(const long double *q, const long double *v, long double *a, long double *b)
{
    const long double cf = cos(q[2]), sf = sin(q[2]), c = cos(q[3]), s = sin(q[3]), f = v[2], t = v[3], w = v[4];
    const long double A[2][5] = { { 1, 0, c*cf, -s*sf, cf }, { 0, 1, c*sf, s*cf, sf } };
    a[0] = a[8] = 1;
    a[16] = s*s/4 + c*c/2;
    a[18] = a[30] = c/2;
    a[24] = 0.25L + c*c;
    a[32] = 0.5L;
    b[2] = s*c/2*t*f + s/2*t*w;
    b[3] = 2*c*s*t*t - c*s*t*t + f*f*s*c/4 - (w + c*f)*s*f/2 - 9.81L*c;
    b[4] = s/2*t*f;
    b[5] = -((-s*t*cf - c*sf*f)*f - sf*f*w - (c*t*sf + s*cf*f)*t);
    b[6] = -((-s*t*sf + c*cf*f)*f + cf*f*w + (c*t*cf - s*sf*f)*t);
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 5; ++i) a[(5 + k)*7 + i] = A[k][i], a[i*7 + 5 + k] = -A[k][i];
}

static void load_accelerations(const long double *q, const long double *v, long double *m, long double *right)
{
    const long double a = q[3] - q[0], b = q[4] - q[1], c = cos(q[2]), s = sin(q[2]);
    const long double A[2][5] = { { s, -c, 0, 0, 0 }, { -a, -b, 0, a, b } };
    for (int i = 0; i < 5; ++i) m[8*i] = 1;
    right[0] = SLOPE/10.0L;
    right[5] = -v[2]*(c*v[0] + s*v[1]);
    right[6] = -((v[3] - v[0])*(v[3] - v[0]) + (v[4] - v[1])*(v[4] - v[1]));
    for (int k = 0; k < 2; ++k)
        for (int i = 0; i < 5; ++i) m[(5 + k)*7 + i] = A[k][i], m[i*7 + 5 + k] = -A[k][i];
}

static void slopes(accelerations *at, const long double *z, long double *dz)
{
    long double a[49] = { 0 }, b[7] = { 0 };
    at(z, z + 5, a, b);
    for (int k = 0; k < 7; ++k) {
        int best = k;
        for (int i = k; i < 7; ++i) if (fabs(a[i*7 + k]) > fabs(a[best*7 + k])) best = i;
        for (int j = 0; j <= 7; ++j) {
            long double *x = j < 7 ? a + k*7 + j : b + k, *y = j < 7 ? a + best*7 + j : b + best, was = *x;
            *x = *y;
            *y = was;
        }
        for (int i = k + 1; i < 7; ++i) {
            const long double part = a[i*7 + k]/a[k*7 + k];
            for (int j = k; j < 7; ++j) a[i*7 + j] -= part*a[k*7 + j];
            b[i] -= part*b[k];
        }
    }
    for (int k = 7; k-- > 0; b[k] /= a[k*8])
        for (int j = k + 1; j < 7; ++j) b[k] -= a[k*7 + j]*b[j];
    for (int i = 0; i < 5; ++i) dz[i] = z[5 + i], dz[5 + i] = b[i];
}

static void reference(accelerations *at, int steps, long double *z)
{
    const long double h = 1.0L/steps;
    for (int k = 0; k < steps; ++k) {
        static const long double part[] = { 0, 0.5L, 0.5L, 1 }, weight[] = { 1/6.0L, 1/3.0L, 1/3.0L, 1/6.0L };
        long double y[10], d[10] = { 0 }, sum[10] = { 0 };
        for (int l = 0; l < 4; ++l) {
            for (int i = 0; i < 10; ++i) y[i] = z[i] + part[l]*h*d[i];
            slopes(at, y, d);
            for (int i = 0; i < 10; ++i) sum[i] += weight[l]*d[i];
        }
        for (int i = 0; i < 10; ++i) z[i] += h*sum[i];
    }
}

/* ---- what all tests do */

static gvi_status begin(gvi_stepper *st, const gvi_desc *desc, const real *q, const real *v)
{
    assert_true(gvi_size(desc) > 0 && gvi_size(desc) <= sizeof memory);
    assert_ok(gvi_init(st, desc, memory, sizeof memory));
    return gvi_start(st, 0, q, v);
}

/* The error at T = 1, in `steps` steps. */
static long double error_of(gvi_desc desc, int s, int steps, const real *q, const real *v, const long double *z)
{
    gvi_stepper st;
    real now[5];
    long double error = 0;
    desc.degree = s;
    assert_ok(begin(&st, &desc, q, v));
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, 1/(real)steps));
    assert_ok(gvi_velocity(&st, now));
    for (int i = 0; i < desc.n; ++i) error += fabs(st.q[i] - z[i]) + fabs(now[i] - z[desc.n + i]);
    return error;
}

static void check_orders(const gvi_desc *desc, const int *steps, const real *q, const real *v, const long double *z)
{
    for (int s = 1; s <= (KIND == 1 ? 1 : KIND == 2 ? 4 : 5) && steps[s] > 0; ++s) {
        const long double a = error_of(*desc, s, 2*steps[s], q, v, z), b = error_of(*desc, s, 3*steps[s], q, v, z);
        const double order = (double)(log(a/b)/log(1.5L));
        if (!(fabs(order - 2*s) < 0.1)) print_message("s = %d: order %.3f, errors %Lg %Lg\n", s, order, a, b);
        assert_true(fabs(order - 2*s) < 0.1);
    }
}

static real slip_of(gvi_stepper *st, gvi_points_fn *rows, int m)
{
    real g[4] = { 0 }, A[20] = { 0 }, rate[4] = { 0 }, v[5], most = 0;
    assert_ok(gvi_velocity(st, v));
    gvi_points at = { .n = st->n, .count = 1, .stride = 1, .t = &st->t, .q = st->q, .g = g, .jacobian = A, .rate = rate };
    rows(&at, NULL);
    for (int a = 0; a < m; ++a) {
        real sum = rate[a];
        for (int i = 0; i < st->n; ++i) sum += A[a*st->n + i]*v[i];
        most = fmax(most, fabs(sum));
    }
    return most;
}

TEST(knife_edge_has_order_2s_against_its_closed_form)
{
    static const int steps[] = { 0, 48, 12, 6, 3, 3 };
    long double z[6], lambda;
    real q[3], v[3];
    knife_start(q, v);
    knife_exact(1, z, &lambda);
    for (int f = 0; f < 2; ++f) {
        gvi_desc desc = knife_desc;
        desc.formulation = f ? GVI_NEWTON : GVI_VELOCITIES;
        check_orders(&desc, steps, q, v, z);
    }
}

/* docs/theory.md: 2s where the rule's order u is 2s or more; below, as for holonomic rows, u = 2s - 2 is measured */
TEST(the_order_is_2s_by_rules_of_order_2s_and_less_by_lesser_ones)
{
    static const struct { int kind, more, less; } rules[] = { { GVI_GAUSS, 1, 0 }, { GVI_LOBATTO, 1, 0 }, { GVI_LOBATTO, 0, 2 } };
    long double z[6], lambda;
    real q[3], v[3];
    knife_start(q, v);
    knife_exact(1, z, &lambda);
    for (int k = 0; k < COUNT(rules); ++k)
        for (int s = KIND == 1 ? 1 : 2; s <= (KIND == 1 ? 1 : 3) && s + rules[k].more > 1; ++s) {
            gvi_desc desc = knife_desc;
            desc.rule.kind = (gvi_rule_kind)rules[k].kind;
            desc.rule.points = s + rules[k].more;
            const int steps = s == 1 ? 32 : s == 2 ? 8 : 4, order = 2*s - rules[k].less;
            const long double a = error_of(desc, s, 2*steps, q, v, z), b = error_of(desc, s, 3*steps, q, v, z);
            const double seen = (double)(log(a/b)/log(1.5L));
            if (!(fabs(seen - order) < 0.1)) print_message("rule %d, s = %d: order %.3f\n", k, s, seen);
            assert_true(fabs(seen - order) < 0.1);
        }
}

TEST(falling_disc_has_order_2s_against_the_index_1_equations)
{
    static const int steps[] = { 0, 64, 16, 8, 6, 5 };
    long double z[10], finer[10];
    real q[5], v[5];
    disc_start(q, v);
    for (int i = 0; i < 5; ++i) z[i] = finer[i] = q[i], z[5 + i] = finer[5 + i] = v[i];
    reference(disc_accelerations, 16384, z);
    reference(disc_accelerations, 32768, finer);
    for (int i = 0; i < 10; ++i) assert_true(fabs(z[i] - finer[i]) < 1e-13L);
    for (int f = 0; f < 2; ++f) {
        gvi_desc desc = disc_desc;
        desc.formulation = f ? GVI_NEWTON : GVI_MOMENTA;
        check_orders(&desc, steps, q, v, finer);
    }
}

TEST(beside_a_rod_the_order_is_the_same)
{
    static const int steps[] = { 0, 96, 24, 12, DIG > 53 ? 7 : 6, 0 };     // beyond, the reference is no better
    long double z[10];
    real q[5], v[5];
    load_start(q, v);
    for (int i = 0; i < 5; ++i) z[i] = q[i], z[5 + i] = v[i];
    reference(load_accelerations, 131072, z);
    check_orders(&load_desc, steps, q, v, z);
}

TEST(slip_and_energy_stay_at_rounding)
{
    for (int s = 4; s <= 8; s += 4) {
        gvi_desc desc = disc_desc;
        gvi_stepper st;
        real q[5], v[5], start, now, off = 0, slip = 0;
        desc.degree = s;
        disc_start(q, v);
        assert_ok(begin(&st, &desc, q, v));
        assert_ok(gvi_energy(&st, &start));
        for (int k = 0; k < 20000; ++k) {
            assert_ok(gvi_step(&st, R(0.05)));
            assert_ok(gvi_energy(&st, &now));
            off = fmax(off, fabs(now/start - 1));
            slip = fmax(slip, slip_of(&st, disc_rolls, 2));
        }
        assert_true(slip < 45*EPS);               // of terms to 6: 1e-14 in double
        if (KIND == 2) assert_true(off < 1e-13 && st.counters.iterations < 20000*13);
        if (KIND == 1) assert_true(off < 1e-4);
    }
}

/* x' = cos t and y' = z x': x = sin t, z = t, y = t sin t + cos t - 1.  Two effects, each of which counts its points */
AT_POINTS(conveyor)
{
    *(unsigned long long *)user += (unsigned)x->count;
    for (int k = 0; k < x->count; ++k) x->jacobian[k] = 1, x->rate[k] = -cos(x->t[k]);
    return 0;
}

AT_POINTS(follower)
{
    *(unsigned long long *)user += (unsigned)x->count;
    for (int k = 0; k < x->count; ++k) x->jacobian[k] = -x->q[2*x->stride + k], x->jacobian[x->stride + k] = 1;
    return 0;
}

TEST(two_that_roll_each_have_their_own_rows)
{
    for (int order = 0; order < 2; ++order) {
        unsigned long long points[2] = { 0, 0 };
        gvi_effect scene[] = { { .kind = GVI_NONHOLONOMIC, .points = conveyor, .rows = 1, .user = points },
                               { .kind = GVI_NONHOLONOMIC, .points = follower, .rows = 1, .user = points + 1 } };
        if (order) scene[0].points = follower, scene[1].points = conveyor;
        const gvi_desc desc = { .n = 3, .degree = 8, .effects = scene, .effect_count = 2 };
        const real zero[3] = { 0 }, v[3] = { 1, 0, 1 };
        gvi_stepper st;
        assert_ok(begin(&st, &desc, zero, v));
        for (int k = 0; k < 8; ++k) assert_ok(gvi_step(&st, R(0.125)));
        assert_close(st.q[0], sinl(1), 16*EPS);
        assert_close(st.q[1], sinl(1) + cosl(1) - 1, 16*EPS);
        assert_close(st.q[2], 1, 4*EPS);
        for (int e = 0; e < 2; ++e) assert_int_equal(st.counters.effect[e], points[e]);
    }
}

/* What a step has gathered of slip, when it fails, is no g of the next start */
TEST(a_step_that_failed_leaves_no_slip_behind)
{
    unsigned long long points = 0;
    const gvi_effect scene[] = { { .kind = GVI_NONHOLONOMIC, .points = conveyor, .rows = 1, .user = &points },
                                 { .kind = GVI_NONHOLONOMIC, .points = follower, .rows = 1, .user = &points } };
    const gvi_desc desc = { .n = 3, .degree = 4, .effects = scene, .effect_count = 2, .max_iterations = 2 };
    real q[3] = { 0 }, v[3] = { 1, 0, 1 }, moved[2];
    gvi_stepper st;
    assert_ok(begin(&st, &desc, q, v));
    assert_status(gvi_step(&st, 2), GVI_E_CONVERGENCE);
    assert_ok(gvi_project(&st, 0, q, v, moved));
    assert_true(moved[0] == 0 && q[0] == 0 && q[1] == 0);
    assert_ok(gvi_start(&st, 0, q, v));
}

TEST(it_runs_back_as_it_came)
{
    gvi_stepper st;
    real q[5], v[5], w[5];
    disc_start(q, v);
    assert_ok(begin(&st, &disc_desc, q, v));
    for (int k = 0; k < 100; ++k) assert_ok(gvi_step(&st, R(0.05)));
    for (int k = 0; k < 100; ++k) assert_ok(gvi_step(&st, -R(0.05)));
    assert_ok(gvi_velocity(&st, w));
    for (int i = 0; i < 5; ++i) {
        assert_close(st.q[i], q[i], 450*EPS);
        assert_close(w[i], v[i], 450*EPS*6);
    }
}

TEST(rows_that_say_the_same_are_left_out)
{
    const gvi_effect scene[] = { knife_scene[0], knife_scene[1], knife_scene[1] };
    gvi_desc desc = knife_desc;
    gvi_stepper st;
    real q[3], v[3];
    long double z[6], lambda;
    knife_start(q, v);
    desc.effects = scene;
    desc.effect_count = 3;
    assert_ok(begin(&st, &desc, q, v));
    for (int k = 0; k < 20; ++k) assert_ok(gvi_step(&st, R(0.05)));
    knife_exact(1, z, &lambda);
    for (int i = 0; i < 3; ++i) assert_close(st.q[i], z[i], 100*EPS);
}

/* The second knife edge says the same at t = 0, and later that the first one slips */
GVI_EACH(quarrel, 3, rows(1))
{
    x->jacobian[0] = 2*sin(x->q[2]);
    x->jacobian[1] = -2*cos(x->q[2]);
    x->rate[0] = x->t[0]/8;
}

TEST(rows_that_come_to_contradict_each_other_are_named)
{
    const gvi_effect scene[] = { knife_scene[0], knife_scene[1], { .kind = GVI_NONHOLONOMIC, .points = quarrel, .rows = 1 } };
    for (int f = 0; f < 2; ++f) {
        gvi_desc desc = knife_desc;
        gvi_stepper st;
        real q[3], v[3];
        knife_start(q, v);
        desc.effects = scene;
        desc.effect_count = 3;
        desc.formulation = f ? GVI_NEWTON : GVI_AUTO;
        assert_ok(begin(&st, &desc, q, v));
        assert_int_equal(gvi_step(&st, R(0.05)), GVI_E_CONSTRAINT);
        assert_int_equal(st.fault.effect, 2);
        assert_int_equal(st.fault.coordinate, 0);
        for (int i = 0; i < 3; ++i) assert_true(st.q[i] == q[i]);
    }
}

TEST(multipliers_curve_checkpoint_and_dial)
{
    gvi_stepper st, saved;
    static real copy[COUNT(memory)];
    real q[3], v[3], lambda, at[3], w[3], end[3];
    long double z[6], exact;
    knife_start(q, v);
    assert_ok(begin(&st, &knife_desc, q, v));
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, R(0.125)));
    knife_exact(1.25L, z, &exact);
    assert_ok(gvi_multipliers(&st, &lambda));
    assert_close(lambda, exact, KIND == 1 ? 3e-3L : 1e-9L);
    assert_ok(gvi_state_at(&st, R(1.1875), at, w, NULL));
    knife_exact(1.1875L, z, &exact);
    for (int i = 0; i < 3; ++i) {
        assert_close(at[i], z[i], 200*EPS);
        assert_close(w[i], z[3 + i], 200*EPS);
    }
    saved = st;
    memcpy(copy, memory, sizeof memory);
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, R(0.125)));
    memcpy(end, st.q, sizeof end);
    assert_ok(gvi_restore(&st, &saved, copy));
    for (int k = 0; k < 10; ++k) assert_ok(gvi_step(&st, R(0.125)));
    assert_same_numbers(end, st.q, COUNT(end));

    gvi_desc desc = knife_desc;
    desc.resolution = KIND == 1 ? R(1e-4) : R(1e-10);
    assert_ok(begin(&st, &desc, q, v));
    st.next = R(0.5);
    while (st.t < 2) assert_ok(gvi_advance(&st, 2));
    knife_exact(2, z, &exact);
    for (int i = 0; i < 3; ++i) assert_close(st.q[i], z[i], 100*desc.resolution);
}

TEST(switched_on_it_has_to_hold_and_projection_changes_velocities_alone)
{
    gvi_stepper st;
    real q[3], v[3], moved[2], was[3];
    knife_start(q, v);
    assert_ok(begin(&st, &knife_desc, q, v));
    assert_ok(gvi_switch(&st, 1, 0));
    for (int k = 0; k < 5; ++k) assert_ok(gvi_step(&st, R(0.05)));
    assert_int_equal(gvi_switch(&st, 1, 1), GVI_E_CONSTRAINT);
    assert_int_equal(st.fault.effect, 1);
    assert_int_equal(st.fault.coordinate, 0);
    memcpy(q, st.q, sizeof q);
    memcpy(was, q, sizeof q);
    assert_ok(gvi_velocity(&st, v));
    const real t = st.t, across = sin(q[2])*v[0] - cos(q[2])*v[1];
    const real x = v[0] - across*sin(q[2]), y = v[1] + across*cos(q[2]);
    assert_ok(begin(&st, &knife_desc, was, (const real[]){ cos(q[2]), sin(q[2]), 1 }));
    assert_ok(gvi_project(&st, t, q, v, moved));
    assert_same_numbers(q, was, COUNT(q));
    assert_close(v[0], x, 10*EPS);
    assert_close(v[1], y, 10*EPS);
    assert_close(moved[1], fabs(across), 10*EPS);
    assert_ok(gvi_start(&st, t, q, v));
    assert_ok(gvi_step(&st, R(0.05)));
    assert_true(slip_of(&st, knife, 1) < 20*EPS);
}

GVI_EACH(nothing, 3, rows(1)) { x->jacobian[0] = 0; }

TEST(refusals)
{
    gvi_stepper st;
    real q[3], v[3];
    knife_start(q, v);
    v[1] += R(0.01);
    assert_int_equal(begin(&st, &knife_desc, q, v), GVI_E_CONSTRAINT);
    assert_int_equal(st.fault.effect, 1);
    assert_int_equal(st.fault.coordinate, 0);

    const gvi_effect empty[] = { knife_scene[0], { .kind = GVI_NONHOLONOMIC, .points = nothing, .rows = 1 } };
    gvi_desc desc = knife_desc;
    desc.effects = empty;
    knife_start(q, v);
    if (begin(&st, &desc, q, v) == GVI_OK) (void)gvi_step(&st, R(0.05));
    assert_int_equal(st.status, GVI_E_SINGULAR);
    assert_int_equal(st.fault.effect, 1);

    desc = knife_desc;
    desc.degree = 1;
    desc.rule.kind = GVI_KICKS;
    desc.rule.points = 2;
    static const real nodes[] = { 0, 1 }, weights[] = { 0.5, 0.5 };
    desc.rule.nodes = nodes;
    desc.rule.weights = weights;
    assert_int_equal(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_FORMULATION);
    assert_int_equal(st.fault.effect, 1);

    gvi_effect without[] = { knife_scene[0], knife_scene[1] };
    without[1].rows = 0;
    desc = knife_desc;
    desc.effects = without;
    assert_int_equal(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_ARGUMENT);
    without[1].rows = 0x8000;
    assert_int_equal(gvi_init(&st, &desc, memory, sizeof memory), GVI_E_ARGUMENT);
}

RUN_TESTS(NULL, NULL)
