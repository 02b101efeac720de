/* M(q): velocities and momenta against each other in more digits, points without an inverse, and what asking for M saves where M^-1 p could be had. */
#include "gvi_test.h"

enum { MOST = 6, POINTS = 16 };

/* [n*n][stride], B B' + 1/2 at each point, its sign as wanted: definite, condition below 100 */
static void random_mass(int n, int stride, int count, real sign, real *m)
{
    for (int k = 0; k < count; ++k) {
        real B[MOST][MOST];
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) B[i][j] = random_unit();
        for (int i = 0; i < n; ++i)
            for (int j = 0; j <= i; ++j) {
                real sum = i == j ? (real)0.5 : 0;
                for (int l = 0; l < n; ++l) sum += B[i][l]*B[j][l];
                m[(i*n + j)*stride + k] = sign*sum;
            }
    }
}

/* What a scene of one random M, the same everywhere, is made of */
typedef struct constant { int n; real m[MOST*MOST]; } constant;

static int nothing(const gvi_points *x, void *user) { return 0; }

static int constant_mass(const gvi_points *x, void *user)
{
    const constant *a = user;
    for (int i = 0; i < a->n; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < x->count; ++k) x->mass[(i*a->n + j)*x->stride + k] = a->m[i*a->n + j];
    return 0;
}

/* |M v - p|_i <= (3n + 4) eps sqrt(M_ii) sum_j sqrt(M_jj) |v_j|: the bound of Cholesky's solution (Higham, Accuracy
   and stability of numerical algorithms, thm. 10.4, with eps/2 for each rounding), and some for 1/D */
static void assert_solves(const constant *a, const real *v, const real *p, long double more)
{
    for (int i = 0; i < a->n; ++i) {
        long double sum = 0, size = 0;
        for (int j = 0; j < a->n; ++j) {
            sum += (long double)a->m[i > j ? i*a->n + j : j*a->n + i]*v[j];
            size += sqrtl(fabsl((long double)a->m[j*a->n + j]))*fabsl((long double)v[j]);
        }
        assert_close(sum, p[i], ((3*a->n + 4)*size + more)*sqrtl(fabsl((long double)a->m[i*a->n + i]))*(long double)EPS);
    }
}

/* At one point, by a query; and at all points of a step, where free motion makes of it h M^-1 p.  M positive
   and negative. */
TEST(velocities_solve_for_the_momenta)
{
    static const real zero[MOST];
    for (int n = 1; n <= MOST; ++n)
        for (int degree = 1; degree <= POINTS; ++degree)
            for (int s = -1; s <= 1; s += 2) {
                constant a = { n, { 0 } };
                const gvi_desc desc = { .n = n, .degree = degree, .formulation = GVI_MOMENTA,
                                        .mass = { .kind = GVI_MASS_POSITION, .points = constant_mass, .gradient = nothing,
                                                  .user = &a } };
                real p[MOST], v[MOST], moved[MOST];
                long double most = 0;
                random_mass(n, 1, 1, (real)s, a.m);
                for (int i = 0; i < n; ++i) p[i] = random_unit();
                gvi_stepper st = new_stepper(&desc);
                assert_ok(gvi_start_momentum(&st, 0, zero, p));
                assert_ok(gvi_velocity(&st, v));
                assert_solves(&a, v, p, 0);
                assert_ok(gvi_step(&st, 1));
                for (int i = 0; i < n; ++i) {
                    moved[i] = st.q[i];
                    most += sqrtl(fabsl((long double)a.m[i*n + i]))*fabsl((long double)v[i]);
                    assert_true(st.p[i] == p[i]);
                }
                assert_solves(&a, moved, p, 4*most);      // the sum over the points
            }
}

/* diag(1, 1), but (1, 0) where q_1 > 1 */
GVI_EACH(ends_at_one, 2, mass)
{
    x->mass[0] = 1;
    x->mass[2] = 0;
    x->mass[3] = x->q[0] <= 1;
}

/* q_1 = 3/4 + c/2 at the nodes of a free step: the first point beyond 1 is named */
TEST(the_point_without_an_inverse_is_named)
{
    static const gvi_effect none[] = { { .kind = GVI_POTENTIAL, .points = nothing } };
    static const int degrees[] = { 2, 3, 6, 8, 12, 16 };
    for (int i = 0; i < COUNT(degrees); ++i) {
        const real q[2] = { (real)0.75, 0 }, v[2] = { (real)0.5, 0 };
        real c[16], b[16];
        int first = 0;
        const gvi_desc desc = { .n = 2, .degree = degrees[i], .effects = none, .effect_count = 1,
                                .mass = { .kind = GVI_MASS_POSITION, .points = ends_at_one, .gradient = nothing },
                                .formulation = GVI_MOMENTA };
        assert_ok(gvi_gauss(degrees[i], c, b));
        while ((real)0.75 + c[first]/2 <= 1) ++first;
        gvi_stepper st = new_motion(&desc, 0, q, v);
        assert_status(gvi_step(&st, 1), GVI_E_CONVERGENCE);           /* half of it helps */
        assert_int_equal(st.fault.effect, GVI_FAULT_MASS);
        assert_int_equal(st.fault.coordinate, 1);
        assert_int_equal(st.fault.point, first);
        assert_true(st.t == 0 && st.q[0] == q[0]);
    }
}

/* Beyond q_1 = 1 what is left of M_22 overflows, though all that is given is finite */
GVI_EACH(overflows, 2, mass)
{
    x->mass[0] = x->q[0] > 1 ? MIN*4 : 1;
    x->mass[2] = x->q[0] > 1 ? MAX/4 : 0;
    x->mass[3] = 1;
}

TEST(a_pivot_that_overflows_is_named)
{
    static const gvi_effect none[] = { { .kind = GVI_POTENTIAL, .points = nothing } };
    for (int degree = 3; degree <= 16; ++degree) {
        const real q[2] = { (real)0.75, 0 }, v[2] = { (real)0.5, 0 };
        const gvi_desc desc = { .n = 2, .degree = degree, .effects = none, .effect_count = 1,
                                .mass = { .kind = GVI_MASS_POSITION, .points = overflows, .gradient = nothing },
                                .formulation = GVI_MOMENTA };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        assert_status(gvi_step(&st, 1), GVI_E_NON_FINITE);
        assert_int_equal(st.fault.effect, GVI_FAULT_MASS);
        assert_int_equal(st.fault.coordinate, 1);
    }
}

/* What is left of M_22 is 3/2 of what rounding can leave, at all points: regular, though barely, and no
   matter how many points there are */
GVI_EACH(barely, 2, mass)
{
    x->mass[0] = x->mass[2] = 1;
    x->mass[3] = 1 + 3*EPS;
}

TEST(a_matrix_that_is_barely_regular_is_taken)
{
    static const gvi_effect none[] = { { .kind = GVI_POTENTIAL, .points = nothing } };
    const real zero[2] = { 0, 0 };
    for (int degree = 2; degree <= 16; ++degree) {
        const gvi_desc desc = { .n = 2, .degree = degree, .effects = none, .effect_count = 1,
                                .mass = { .kind = GVI_MASS_POSITION, .points = barely, .gradient = nothing },
                                .formulation = GVI_MOMENTA };
        gvi_stepper st = new_stepper(&desc);
        assert_ok(gvi_start_momentum(&st, 0, zero, zero));
        for (int k = 0; k < 3; ++k) assert_ok(gvi_step(&st, 1));
        assert_true(st.q[0] == 0 && st.q[1] == 0);
    }
}

/* M = (2, 1; 1, 1), springs of 1: omega^2 = (3 +- sqrt 5)/2, 2.618 and 0.382 */
AT_EACH(springs) { x->f[a] -= x->q[a]; }

GVI_EACH(of_points, 2, mass)
{
    x->mass[0] = 2;
    x->mass[2] = x->mass[3] = 1;
}

GVI_EACH(of_momentum, 2, p, velocity)
{
    x->velocity[0] = x->p[0] - x->p[1];
    x->velocity[1] = 2*x->p[1] - x->p[0];
}

static double iterations(int by_velocity, real h, real *q)
{
    static const gvi_effect pull[] = { { .kind = GVI_POTENTIAL, .points = springs } };
    const real start[2] = { 1, 0 }, rest[2] = { 0, 0 };
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = pull, .effect_count = 1, .formulation = GVI_MOMENTA,
                            .mass = { .kind = GVI_MASS_POSITION, .points = of_points, .gradient = nothing,
                                      .velocity = by_velocity ? of_momentum : NULL } };
    gvi_stepper st = new_stepper(&desc);
    assert_ok(gvi_start_momentum(&st, 0, start, rest));
    for (int k = 0; k < 100; ++k) assert_ok(gvi_step(&st, h));
    q[0] = st.q[0];
    q[1] = st.q[1];
    return (double)st.counters.iterations/100;
}

/* V of the new P, by M or by M^-1 p: an iteration integrates twice, so that as many do */
TEST(with_M_or_its_inverse_as_many_iterations_do)
{
    for (real h = (real)0.25; h < (real)1.25; h += (real)0.25) {
        real q[2][2];
        const double by_points = iterations(0, h, q[0]), by_velocity = iterations(1, h, q[1]);
        assert_between(by_points - 0.5, by_velocity, by_points + 0.5);
        for (int i = 0; i < 2; ++i) assert_close(q[0][i], q[1][i], 64*EPS);
    }
}

/* A first step from rest, of one iteration, or to a tolerance: q'' = F(q0), which a constant force has anyway */
TEST(one_iteration_from_rest_moves_q)
{
    static const gvi_effect pull[] = { { .kind = GVI_POTENTIAL, .points = springs } };
    const real start[2] = { 1, 0 }, rest[2] = { 0, 0 }, h = (real)0.1;
    for (int with = 0; with < 4; ++with) {
        gvi_desc desc = { .n = 2, .degree = 4, .effects = pull, .effect_count = 1, .formulation = GVI_MOMENTA,
                          .mass = { .kind = GVI_MASS_POSITION, .points = of_points, .gradient = nothing,
                                    .velocity = with & 1 ? of_momentum : NULL } };
        if (with & 2) desc.tolerance = (real)0.01;
        else desc.iterations = 1;
        gvi_stepper st = new_stepper(&desc);
        assert_ok(gvi_start_momentum(&st, 0, start, rest));
        assert_ok(gvi_step(&st, h));
        const real p = st.p[0]/h, r = st.p[1]/h;           // v = M^-1 p grows from 0 to that
        assert_close(st.q[0] - 1, (p - r)*h*h/2, h*h*h*h);
        assert_close(st.q[1], (2*r - p)*h*h/2, h*h*h*h);
        assert_true(st.iterations <= 3);
    }
}

static real squares(const real *z) { return z[0]*z[0] + z[1]*z[1] + z[2]*z[2]; }
GVI_EACH(of_direction, 3, mass)                   /* M = 1/|q|^2 */
{
    for (int i = 0; i < 3; ++i) x->mass[4*i] = 1/squares(x->q);
}
GVI_EACH(of_direction_gradient, 3, v, f)
{
    for (int i = 0; i < 3; ++i) x->f[i] -= squares(x->v)*x->q[i]/(squares(x->q)*squares(x->q));
}
GVI_EACH(velocity_of_direction, 3, p, velocity)
{
    for (int i = 0; i < 3; ++i) x->velocity[i] = squares(x->q)*x->p[i];
}
GVI_EACH(weight_of_direction, 3, f)               /* V = z/|q| */
{
    const real qq = squares(x->q), r = sqrt(qq);
    for (int i = 0; i < 3; ++i) x->f[i] -= ((i == 2) - x->q[2]*x->q[i]/qq)/r;
}

/* A conical pendulum turns at constant height: its forces on z cancel, and the iteration's P_z tends to 0, by
   its whole size in each iteration.  The fixed point must not be given up for that. */
TEST(a_momentum_that_tends_to_0_converges)
{
    static const gvi_effect weight[] = { { .kind = GVI_POTENTIAL, .points = weight_of_direction } };
    const real angle = (real)0.75, z = -2*(real)cos(0.75), turn = 1/(real)sqrtl(-z/2);
    for (int s = 1; s <= 8; ++s)
        for (int steps = 20; steps <= 200; steps *= 2) {
            gvi_desc desc = { .n = 3, .degree = s, .effects = weight, .effect_count = 1 };
            desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = of_direction,
                                    .gradient = of_direction_gradient, .velocity = velocity_of_direction };
            const real q[3] = { 2*(real)sin((double)angle), 0, z }, v[3] = { 0, q[0]*turn, 0 };
            gvi_stepper st = new_motion(&desc, 0, q, v);
            for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, 3/(real)steps));
            assert_int_equal(st.formulation, GVI_MOMENTA);
            if (s == 8) assert_close(st.q[2]*st.q[2]/squares(st.q), z*z/4, 64*EPS*(real)steps);
        }
}

GVI_EACH(quartic, 1, f) { x->f[0] -= x->q[0] + x->q[0]*x->q[0]*x->q[0]; }      /* V = q^2/2 + q^4/4 */
GVI_EACH(rate_of_cube, 1, v, f, dldv)             /* L = d(q^3/3)/dt */
{
    x->f[0] += 2*x->q[0]*x->v[0];
    x->dldv[0] += x->q[0]*x->q[0];
}
GVI_EACH(velocity_at_q, 1, p, velocity) { x->velocity[0] = x->p[0] - x->q[0]*x->q[0]; }

/* mass.velocity reads q: that of this step, whatever a step that failed or a query has left */
TEST(a_velocity_is_of_its_own_step)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = quartic },
                                        { .kind = GVI_LAGRANGIAN, .points = rate_of_cube } };
    for (int with = 0; with < 3; ++with) {
        const gvi_desc desc = { .n = 1, .effects = scene, .effect_count = 2, .formulation = GVI_MOMENTA,
                                .mass = { .velocity = velocity_at_q }, .tolerance = with == 1 ? (real)0.0001 : 0,
                                .iterations = with == 2 ? 4 : 0 };
        const real q = 1, v = (real)0.5;
        real end[2][2];
        for (int disturbed = 0; disturbed < 2; ++disturbed) {
            gvi_stepper st = new_motion(&desc, 0, &q, &v);
            for (int k = 0; k < 20; ++k) {
                real at;
                assert_ok(gvi_step(&st, k % 2 ? (real)0.125 : (real)0.0625));
                if (disturbed && with > 0) assert_ok(gvi_state_at(&st, st.t0 + (real)0.03125, &at, NULL, NULL));
                if (disturbed && with == 0 && k < 9) assert_true(gvi_step(&st, 10*(real)(k + 1)) != GVI_OK);
            }
            end[disturbed][0] = st.q[0];
            end[disturbed][1] = st.p[0];
        }
        assert_true(end[0][0] == end[1][0] && end[0][1] == end[1][1]);
    }
}

/* M(q) = diag(2 + q_1^2, 3), as it is and with its zero written: the same bits */
static int diagonal_mass(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        x->mass[k] = 2 + x->q[x->stride + k]*x->q[x->stride + k];
        if (user) x->mass[2*x->stride + k] = 0;
        x->mass[3*x->stride + k] = 3;
    }
    return 0;
}
static int diagonal_gradient(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) x->f[x->stride + k] += x->q[x->stride + k]*x->v[k]*x->v[k];
    return 0;
}

TEST(entries_of_mass_are_0_before)
{
    static const real q[] = { 1, 0.5L }, v[] = { 0.25L, -1 };
    static real memory[4000];
    for (int degree = 1; degree <= 9; ++degree)
        for (int newton = 0; newton < 2; ++newton) {
            real u[2][2], E[2];
            for (int k = 0; k < 2; ++k) {
                const gvi_desc d = { .n = 2, .degree = degree, .formulation = newton ? GVI_NEWTON : GVI_MOMENTA,
                                     .mass = { .kind = GVI_MASS_POSITION, .points = diagonal_mass,
                                               .gradient = diagonal_gradient, .user = k ? memory : NULL } };
                gvi_stepper st;
                assert_ok(gvi_init(&st, &d, memory, sizeof memory));
                assert_ok(gvi_start(&st, 0, q, v));
                for (int i = 0; i < 5; ++i) assert_ok(gvi_step(&st, (real)0.125));
                assert_ok(gvi_velocity(&st, u[k]));
                assert_ok(gvi_energy(&st, &E[k]));
            }
            assert_true(E[0] == E[1] && u[0][0] == u[1][0] && u[0][1] == u[1][1]);
        }
}

/* ---- the arm of lesson 10: M_ij = B_ij cos(q_i - q_j), as a rigid-body library gives it, M and c(q, v) ---- */

static const real arm_b[3][3] = { { R(0.64), R(0.28), R(0.04) }, { R(0.28), R(0.204), R(0.035) }, { R(0.04), R(0.035), R(0.0133) } };

static real arm_m(const real *q, int i, int j) { return arm_b[i][j]*cos(q[i] - q[j]); }

static real arm_m_slope(const real *q, int i, int j, int k)
{
    return -arm_b[i][j]*sin(q[i] - q[j])*(real)((k == i) - (k == j));
}

static int arm_mass(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j <= i; ++j)
                x->mass[(3*i + j)*x->stride + k] = arm_b[i][j]*cos(x->q[i*x->stride + k] - x->q[j*x->stride + k]);
    return 0;
}

/* The gradient on paper, or, with user, by differences of v'M v/2 */
static int arm_gradient(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        real q[3], v[3];
        for (int i = 0; i < 3; ++i) q[i] = x->q[i*x->stride + k], v[i] = x->v[i*x->stride + k];
        for (int l = 0; l < 3; ++l) {
            const real was = q[l], d = R(1e-5);
            real sum = 0;
            for (int i = 0; i < 3; ++i)
                for (int j = 0; j < 3 && !user; ++j) sum += arm_m_slope(q, i, j, l)*v[i]*v[j]/2;
            for (int side = -1; side <= 1 && user; side += 2) {
                q[l] = was + (real)side*d;
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j) sum += (real)side*arm_m(q, i, j)*v[i]*v[j]/(4*d);
                q[l] = was;
            }
            x->f[l*x->stride + k] += sum;
        }
    }
    return 0;
}

/* c_i = sum_j B_ij sin(q_i - q_j) v_j^2, from Lagrange's equations on paper: what RNEA gives without gravity and acceleration.
   With C_ij = sum_k (dM_ij/dq_k + dM_ik/dq_j - dM_jk/dq_i) v_k/2, Christoffel's, c = C v. */
TEST(the_gradient_from_a_rigid_body_library)
{
    const real t = 0, q[] = { R(0.5), R(-0.25), R(1.25) }, v[] = { 1, R(-0.5), R(0.75) };
    real f[3] = { 0 }, C[3][3] = { { 0 } };
    const gvi_points x = { .n = 3, .count = 1, .stride = 1, .t = &t, .q = q, .v = v, .f = f };
    arm_gradient(&x, NULL);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k)
                C[i][j] += (arm_m_slope(q, i, j, k) + arm_m_slope(q, i, k, j) - arm_m_slope(q, j, k, i))*v[k]/2;
    for (int i = 0; i < 3; ++i) {
        real c = 0, Cv = 0, transposed = 0, rate = 0;
        for (int j = 0; j < 3; ++j) {
            c += arm_b[i][j]*sin(q[i] - q[j])*v[j]*v[j];
            Cv += C[i][j]*v[j];
            transposed += C[j][i]*v[j];
            for (int k = 0; k < 3; ++k) rate += arm_m_slope(q, i, j, k)*v[k]*v[j];
        }
        assert_close(Cv, c, 8*EPS);
        assert_close(transposed, f[i], 8*EPS);
        assert_close(rate - c, f[i], 8*EPS);
    }
}

AT_EACH(arm_weight) { x->f[a] -= 5*sin(x->q[a]); }

/* 200 steps with a gradient by differences: Newton's method in each of them, or in none with a tolerance above its noise */
TEST(a_gradient_by_differences_needs_a_tolerance)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = arm_weight } };
    const real q[] = { R(0.5), 1, R(0.25) }, v[] = { 0, 0, 0 };
    static int differences = 1;
    if (KIND == 1) return;                                        /* 1e-5 is no width for float */
    for (int tolerant = 0; tolerant < 2; ++tolerant) {
        const gvi_desc desc = { .n = 3, .degree = 8, .effects = scene, .effect_count = 1, .tolerance = tolerant ? R(1e-10) : 0,
                                .mass = { .kind = GVI_MASS_POSITION, .points = arm_mass, .gradient = arm_gradient, .user = &differences } };
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k < 200; ++k) assert_ok(gvi_step(&st, R(0.01)));
        print_message("    %llu iterations of Newton's method\n", st.counters.newton_iterations);
        assert_between(tolerant ? 0 : 200, st.counters.newton_iterations, tolerant ? 0 : 100000);
    }
}

RUN_TESTS(NULL, NULL)
