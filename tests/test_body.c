/* examples/tools/body.h: rigid bodies.  What is expected comes from Euler's equations in elliptic functions,
   from Runge's and Kutta's method in long double with tiny steps, from the closed forms of Lagrange's top, and from
   the work of a force. */
#include "gvi_test.h"
#include "tools/body.h"

typedef long double exact;

/* With |e| = 1 as a constraint: the row is the scene's last one. */
static void hold(gvi_desc *desc, gvi_effect *scene, const bodies *all)
{
    scene[desc->effect_count++] = body_unit(all);
    desc->effects = scene;
    desc->mass.velocity = NULL;
}

static real off_unit(const real *e) { return fabs(sqrt(body_dot(e, e)) - 1); }

/* sn, cn, dn of u with modulus k, by descending means (Abramowitz, Stegun 16.4). */
static void jacobi(exact u, exact k, exact *sn, exact *cn, exact *dn)
{
    exact a[12] = { 1 }, c[12] = { k }, b = sqrtl(1 - k*k);
    int N = 0;
    while (N < 11 && fabsl(c[N]) > 1e-18L) {
        ++N;
        a[N] = (a[N-1] + b)/2;
        c[N] = (a[N-1] - b)/2;
        b = sqrtl(a[N-1]*b);
    }
    exact phi = ldexpl(a[N]*u, N);
    for (; N > 0; --N) phi = (phi + asinl(c[N]/a[N]*sinl(phi)))/2;
    *sn = sinl(phi);
    *cn = cosl(phi);
    *dn = sqrtl(1 - k*k**sn**sn);
}

static real worst_of(int n, const real *a, const exact *b)
{
    real worst = 0;
    for (int i = 0; i < n; ++i) worst = fmax(worst, fabs(a[i] - (real)b[i]));
    return worst;
}

static const body stone = { .inertia = { 1, R(1.75), R(2.5) } };
static const real stone_e[] = { R(0.5), R(0.5), R(-0.5), R(0.5) };
static const exact stone_w[] = { 0.75L, 0, 1 };                  /* 2 E I2 < M^2 */

/* Landau, Lifshitz: Mechanics, 37. */
static void euler(exact t, exact *w)
{
    const exact A = stone.inertia[0], B = stone.inertia[1], C = stone.inertia[2];
    const exact E2 = A*stone_w[0]*stone_w[0] + C*stone_w[2]*stone_w[2];
    const exact M2 = A*A*stone_w[0]*stone_w[0] + C*C*stone_w[2]*stone_w[2];
    const exact k = sqrtl((B - A)*(E2*C - M2)/((C - B)*(M2 - E2*A)));
    exact sn, cn, dn;
    jacobi(t*sqrtl((C - B)*(M2 - E2*A)/(A*B*C)), k, &sn, &cn, &dn);
    w[0] = stone_w[0]*cn;
    w[1] = sqrtl((E2*C - M2)/(B*(C - B)))*sn;
    w[2] = stone_w[2]*dn;
}

/* Independently: e' = e (0, w)/2 with that w, by the classical method. */
static void turned(const exact *e, exact t, exact *rate)
{
    exact w[3];
    euler(t, w);
    rate[0] = (-e[1]*w[0] - e[2]*w[1] - e[3]*w[2])/2;
    rate[1] = (e[0]*w[0] + e[2]*w[2] - e[3]*w[1])/2;
    rate[2] = (e[0]*w[1] + e[3]*w[0] - e[1]*w[2])/2;
    rate[3] = (e[0]*w[2] + e[1]*w[1] - e[2]*w[0])/2;
}

static void attitude(exact T, exact *e)
{
    const int steps = 4000;
    const exact h = T/steps;
    for (int i = 0; i < 4; ++i) e[i] = stone_e[i];
    for (int n = 0; n < steps; ++n) {
        exact k[4][4], z[4];
        for (int j = 0; j < 4; ++j) {
            const exact part = j == 0 ? 0 : j == 3 ? 1 : 0.5L;
            for (int i = 0; i < 4; ++i) z[i] = e[i] + (j ? h*part*k[j-1][i] : 0);
            turned(z, n*h + part*h, k[j]);
        }
        for (int i = 0; i < 4; ++i) e[i] += h/6*(k[0][i] + 2*k[1][i] + 2*k[2][i] + k[3][i]);
    }
}

static void begin(gvi_stepper *st, const gvi_desc *desc, const real *e, const real *w)
{
    real rate[4];
    body_turn(e, w, rate);
    *st = new_stepper(desc);
    assert_ok(gvi_start(st, 0, e, rate));
}

static void spin(gvi_stepper *st, real *w)
{
    real v[4];
    assert_ok(gvi_velocity(st, v));
    body_spin(st->q, v, w);
}

/* Error of the spin, or of the attitude, at t = 4. */
static real free_error(int s, int steps, int attitudes, int held)
{
    static const bodies scene = { &stone, 1 };
    gvi_desc desc = { .n = 4, .degree = s, .mass = body_mass(&scene) };
    gvi_effect rows[1];
    const real w0[] = { (real)stone_w[0], (real)stone_w[1], (real)stone_w[2] };
    static exact e[4];
    exact known[3];
    real w[3];
    gvi_stepper st;
    if (held) hold(&desc, rows, &scene);
    begin(&st, &desc, stone_e, w0);
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, 4/(real)steps));
    if (held) assert_between(0, off_unit(st.q), 4*EPS);
    if (attitudes && fabsl(e[0]) < 1e-9L) attitude(4, e);
    if (attitudes) return worst_of(4, st.q, e);
    spin(&st, w);
    euler(4, known);
    return worst_of(3, w, known);
}

static void expect_order(real coarse, real fine, int order)
{
    assert_between((real)order - R(0.15), log2(coarse/fine), (real)order + R(0.15));
}

TEST(a_free_body_obeys_eulers_equations)
{
    static const int steps[] = { 160, 80, 40, 20 };
    for (int held = 0; held < 2; ++held) {
        assert_between(0, free_error(8, 20, 0, held), 40*EPS);
        assert_between(0, free_error(8, 20, 1, held), 40*EPS + R(3e-15));       /* Runge and Kutta's error */
        for (int s = 1; s <= 4 && DIG > 50; ++s)
            for (int attitudes = 0, n = steps[s-1]; attitudes < 2; ++attitudes)
                expect_order(free_error(s, n, attitudes, held), free_error(s, 2*n, attitudes, held), 2*s);
    }
}

/* 20,000 steps: angular momentum in space, energy, and |e|, which nothing holds, or a constraint. */
static void expect_kept(int held)
{
    static const bodies scene = { &stone, 1 };
    gvi_desc desc = { .n = 4, .mass = body_mass(&scene) };
    gvi_effect rows[1];
    const real w0[] = { (real)stone_w[0], (real)stone_w[1], (real)stone_w[2] };
    real own[3], L[2][3], E[2], size = 0, turned_by = 0, kept = 0;
    gvi_stepper st;
    if (held) hold(&desc, rows, &scene);
    begin(&st, &desc, stone_e, w0);
    for (int k = 0; k <= 20000; ++k) {
        const int now = k > 0;
        body_momentum(st.q, st.p, own);
        body_rotate(st.q, 0, own, L[now]);
        assert_ok(gvi_energy(&st, &E[now]));
        for (int i = 0; i < 3 && now; ++i) turned_by = fmax(turned_by, fabs(L[1][i] - L[0][i]));
        if (now) kept = fmax(kept, fabs(E[1]/E[0] - 1));
        size = fmax(size, off_unit(st.q));
        assert_ok(gvi_step(&st, R(0.2)));
    }
    const real most = held ? 20000*EPS/50 : 64*EPS;                 /* held: level no more, EPS/100 a step */
    assert_between(0, turned_by, most);
    assert_between(0, kept, most);
    assert_between(0, size, held ? 4*EPS : 4000*sqrt(R(20000.0))*2*EPS);     /* e.p in a random walk, for 4,000 s */
}

TEST(what_a_long_run_keeps) { expect_kept(0); }
TEST(what_a_long_run_with_the_constraint_keeps) { expect_kept(1); }

static const body top = { .inertia = { R(2e-4), R(2e-4), R(8e-5) } };
static const real lever = R(0.04), heavy = R(0.981);                    /* m, N */
static const real tilt = R(0.5);

static int weight(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    body_force_about(q, (real[]){ 0, 0, lever }, (real[]){ 0, 0, 0 }, f);
    real own[3];
    body_rotate(q, 1, (real[]){ 0, 0, -heavy }, own);
    body_force_about(q, (real[]){ 0, 0, lever }, own, f);
    return 0;
}

static const gvi_effect weighted[] = { { .kind = GVI_POTENTIAL, .point = weight } };
static const bodies one_top = { &top, 1 };

/* The axis in space after 0.2 s; spin in body axes at first, tilted about x. */
static void spun(int s, int steps, int held, const real *w, real *axis)
{
    gvi_desc desc = { .n = 4, .degree = s, .effects = weighted, .effect_count = 1, .mass = body_mass(&one_top) };
    gvi_effect rows[2] = { weighted[0] };
    gvi_stepper st;
    if (held) hold(&desc, rows, &one_top);
    begin(&st, &desc, (real[]){ cos(tilt/2), sin(tilt/2), 0, 0 }, w);
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, R(0.2)/(real)steps));
    body_rotate(st.q, 0, (real[]){ 0, 0, 1 }, axis);
    if (held) assert_between(0, off_unit(st.q), 4*EPS);
}

/* Steady precession: A W^2 cos a - C w W + m g l = 0, the axis goes round at W. */
static real precession_error(int s, int steps, int held)
{
    const exact A = top.inertia[0], C = top.inertia[2], a = tilt, W = 20, mgl = (exact)lever*heavy;
    const exact w = (A*W*W*cosl(a) + mgl)/(C*W);
    const exact known[] = { sinl(a)*sinl(W*0.2L), -sinl(a)*cosl(W*0.2L), cosl(a) };
    real axis[3];
    spun(s, steps, held, (real[]){ 0, (real)(W*sinl(a)), (real)w }, axis);
    return worst_of(3, axis, known);
}

TEST(lagranges_top_precesses_steadily)
{
    static const int steps[] = { 400, 160, 80, 25 };
    for (int held = 0; held < 2; ++held) {
        assert_between(0, precession_error(8, 40, held), 80*EPS);
        for (int s = 1, n; s <= 4 && DIG > 50; ++s)
            n = steps[s-1], expect_order(precession_error(s, n, held), precession_error(s, 2*n, held), 2*s);
    }
}

static const body pair[] = { { R(1.5), { 1, 2, R(2.5) } }, { R(0.75), { R(0.5), R(0.25), R(0.5) } } };
static const bodies two = { pair, 2 };
static const real at[2][3] = { { R(0.5), R(-0.25), R(0.125) }, { R(-0.25), R(0.5), R(0.75) } };

/* Where at is, in space. */
static void place(const real *q, const real *own, real *out)
{
    body_rotate(q + 3, 0, own, out);
    for (int i = 0; i < 3; ++i) out[i] += q[i];
}

/* f.q' is the force times the velocity of its place, for velocities that leave |e| alone: the place's
   velocity by differences. */
TEST(the_work_of_a_force_is_that_of_its_place)
{
    const real q[] = { 1, 2, 3, R(0.75), R(-0.5), R(0.25), 1 }, force[] = { R(0.5), -1, 2 }, w[] = { 1, R(-0.75), R(0.5) };
    real v[7] = { R(0.25), R(-0.5), 1 }, f[4][7] = { { 0 } }, moved[2][7], there[2][3], own[3], spun_back[3];
    real power = 0, d = cbrt(EPS);
    body_turn(q + 3, w, v + 3);
    body_spin(q + 3, v + 3, spun_back);
    for (int i = 0; i < 3; ++i) assert_close(spun_back[i], w[i], 4*EPS);
    for (int i = 0; i < 7; ++i) moved[0][i] = q[i] - d*v[i], moved[1][i] = q[i] + d*v[i];
    for (int k = 0; k < 2; ++k) place(moved[k], at[0], there[k]);
    for (int i = 0; i < 3; ++i) power += force[i]*(there[1][i] - there[0][i])/(2*d);

    body_rotate(q + 3, 1, force, own);
    body_force_in_space(q, at[0], force, f[0]);
    body_force(q, at[0], own, f[1]);
    for (int i = 0; i < 3; ++i) f[2][i] = force[i];
    body_force_about(q + 3, at[0], own, f[2] + 3);
    for (int k = 0; k < 3; ++k) {
        real work = 0;
        for (int i = 0; i < 7; ++i) work += f[k][i]*v[i];
        assert_close(work, power, 100*d*d);
    }
    /* a torque in space, the same in body axes; none works on |e| */
    real turn[2][4] = { { 0 } }, twist = 0;
    body_rotate(q + 3, 1, force, own);
    body_torque_in_space(q + 3, force, turn[0]);
    body_torque(q + 3, own, turn[1]);
    for (int i = 0; i < 3; ++i) twist += own[i]*w[i];
    for (int k = 0; k < 2; ++k) {
        assert_close(body_dot(turn[k], v + 3), twist, 16*EPS);
        assert_close(body_dot(turn[k], q + 3), 0, 16*EPS);
    }
}

/* M v = p for the v of p, and the gradient is what differences of v'Mv/2 say; |e| far from 1. */
TEST(the_mass_is_consistent)
{
    const gvi_mass mass = body_mass(&two);
    real q[14], p[14], v[14], M[196], f[14] = { 0 }, T[2], d = cbrt(EPS);
    for (int i = 0; i < 14; ++i) q[i] = R(0.25)*(real)((i*7)%9 - 4) + R(0.375), p[i] = R(0.5)*(real)((i*5)%7 - 3);
    gvi_points x = { .n = 14, .count = 1, .stride = 1, .q = q, .v = v, .p = p, .mass = M };
    assert_int_equal(mass.points(&x, mass.user), 0);
    x.velocity = v;
    assert_int_equal(mass.velocity(&x, mass.user), 0);
    for (int i = 0; i < 14; ++i) {
        real sum = 0;
        for (int j = 0; j < 14; ++j) sum += M[i > j ? i*14 + j : j*14 + i]*v[j];
        assert_close(sum, p[i], 64*EPS);
    }
    x.velocity = NULL;
    x.f = f;
    assert_int_equal(mass.gradient(&x, mass.user), 0);
    for (int c = 0; c < 14; ++c) {
        const real was = q[c];
        for (int k = 0; k < 2; ++k) {
            q[c] = was + (k ? d : -d);
            mass.points(&x, mass.user);
            T[k] = 0;
            for (int i = 0; i < 14; ++i)
                for (int j = 0; j < 14; ++j) T[k] += v[i]*M[i > j ? i*14 + j : j*14 + i]*v[j]/2;
        }
        q[c] = was;
        assert_close(f[c], (T[1] - T[0])/(2*d), 50*d*d*(1 + fabs(f[c])));
    }
}

/* Momentum and angular momentum of the two bodies. */
static void totals(const real *q, const real *p, real *sum)
{
    for (int i = 0; i < 6; ++i) sum[i] = 0;
    for (int j = 0; j < 2; ++j, q += 7, p += 7) {
        real own[3], L[3];
        body_momentum(q + 3, p + 3, own);
        body_rotate(q + 3, 0, own, L);
        body_cross(q, p, own);
        for (int i = 0; i < 3; ++i) sum[i] += p[i], sum[3+i] += L[i] + own[i];
    }
}

/* Place a of the first body is place b of the second.  The row of a place is what a unit force there is. */
static int ball_joint(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        real q[14], a[3], b[3];
        body_take(x, x->q, 0, 14, k, q);
        place(q, at[0], a);
        place(q + 7, at[1], b);
        for (int c = 0; c < 3; ++c) {
            const real plus[3] = { c == 0, c == 1, c == 2 }, minus[3] = { -plus[0], -plus[1], -plus[2] };
            real row[14] = { 0 };
            body_force_in_space(q, at[0], plus, row);
            body_force_in_space(q + 7, at[1], minus, row + 7);
            x->g[c*x->stride + k] = a[c] - b[c];
            for (int i = 0; i < 14; ++i) x->jacobian[(c*14 + i)*x->stride + k] = row[i];
        }
    }
    return 0;
}

/* Joined, free in space: the joint holds, and nothing changes momentum, angular momentum or energy. */
TEST(two_bodies_on_a_joint_keep_momentum_and_energy)
{
    static const gvi_effect joint = { .kind = GVI_CONSTRAINT, .points = ball_joint, .rows = 3 };
    for (int held = 0; held < 2; ++held) {
        gvi_effect scene[2] = { joint };
        gvi_desc desc = { .n = 14, .degree = 6, .effects = scene, .effect_count = 1, .mass = body_mass(&two) };
        real q[14] = { 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, R(0.5), R(0.5), R(0.5), R(0.5) }, v[14] = { 0 };
        real a[3], b[3], gap[3], E[2], sum[2][6];
        desc.mass.velocity = NULL;
        if (held) hold(&desc, scene, &two);
        place(q, at[0], a);
        place(q + 7, at[1], b);
        for (int i = 0; i < 3; ++i) q[7 + i] = a[i] - b[i];
        body_turn(q + 3, (real[]){ 1, R(0.5), 0 }, v + 3);              /* the joint is at rest */
        body_turn(q + 10, (real[]){ 0, -1, 2 }, v + 10);
        body_cross((real[]){ 1, R(0.5), 0 }, at[0], v);
        body_cross((real[]){ 0, -1, 2 }, at[1], b);
        body_rotate(q + 10, 0, b, v + 7);
        for (int i = 0; i < 3; ++i) v[i] = -v[i], v[7 + i] = -v[7 + i];
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k <= 200; ++k) {
            totals(st.q, st.p, sum[k > 0]);
            assert_ok(gvi_energy(&st, &E[k > 0]));
            place(st.q, at[0], a);
            place(st.q + 7, at[1], gap);
            for (int i = 0; i < 3; ++i) assert_close(a[i], gap[i], 8*EPS*(1 + fabs(st.q[i])));
            for (int i = 0; i < 6 && k; ++i) assert_close(sum[1][i], sum[0][i], 128*EPS);
            if (k) assert_close(E[1], E[0], 64*EPS*E[0]);
            assert_ok(gvi_step(&st, R(0.05)));
        }
    }
}

/* ---- Chaplygin's ball, whose inertias differ, on a plane.  Its angular momentum M about the point on the ground is
   fixed in space: in body axes M' = M x w, up' = up x w, M = I w + m r^2 up x (w x up) */

static const body ball = { 2, { R(0.5), R(0.75), 1 } };
static const bodies balls = { &ball, 1 };
static const body_round rolling_ball = { .at = 0, .radius = R(1.5) };
enum { MRR = 9 };                                                /* halves: m r^2 = 4.5 */

static void ball_spin(const exact *M, const exact *up, exact *w)
{
    exact a[3], b[3], c = MRR/2.0L, along = 0, square = 0;
    for (int i = 0; i < 3; ++i) {
        a[i] = M[i]/(ball.inertia[i] + c), b[i] = up[i]/(ball.inertia[i] + c);
        along += up[i]*a[i], square += up[i]*b[i];
    }
    for (int i = 0; i < 3; ++i) w[i] = a[i] + c*along/(1 - c*square)*b[i];
}

static void ball_momentum(const exact *w, const exact *up, exact *M)
{
    const exact along = w[0]*up[0] + w[1]*up[1] + w[2]*up[2];
    for (int i = 0; i < 3; ++i) M[i] = ball.inertia[i]*w[i] + MRR/2.0L*(w[i] - along*up[i]);
}

static void ball_reference(exact T, exact *w)
{
    const int steps = 4096;
    const exact h = T/steps;
    exact y[6] = { 0, 0, 0, 0, 0, 1 };
    ball_momentum(w, y + 3, y);
    for (int n = 0; n < steps; ++n) {
        exact k[4][6], z[6];
        for (int j = 0; j < 4; ++j) {
            for (int i = 0; i < 6; ++i) z[i] = y[i] + (j ? h*(j == 3 ? 1 : 0.5L)*k[j-1][i] : 0);
            ball_spin(z, z + 3, w);
            for (int i = 0; i < 6; ++i) {
                const exact *a = z + i/3*3;
                k[j][i] = a[(i + 1)%3]*w[(i + 2)%3] - a[(i + 2)%3]*w[(i + 1)%3];
            }
        }
        for (int i = 0; i < 6; ++i) y[i] += h/6*(k[0][i] + 2*k[1][i] + 2*k[2][i] + k[3][i]);
    }
    ball_spin(y, y + 3, w);
}

static const real ball_w[] = { 1, R(-0.5), R(0.75) };

static gvi_stepper roll_ball(int s, int held, real far)
{
    static gvi_effect scene[3];
    gvi_desc desc = { .n = 7, .degree = s, .effects = scene, .effect_count = 2, .mass = body_mass(&balls) };
    real q[7] = { far, far, rolling_ball.radius, 1, 0, 0, 0 }, v[7] = { 0 };
    scene[0] = body_touches(&rolling_ball);
    scene[1] = body_rolls(&rolling_ball);
    desc.mass.velocity = NULL;
    if (held) hold(&desc, scene, &balls);
    v[0] = ball_w[1]*rolling_ball.radius;
    v[1] = -ball_w[0]*rolling_ball.radius;
    body_turn(q + 3, ball_w, v + 3);
    return new_motion(&desc, 0, q, v);
}

TEST(a_rolling_ball_has_order_2s_against_chaplygins_equations)
{
    exact known[3] = { ball_w[0], ball_w[1], ball_w[2] };
    ball_reference(2, known);
    for (int held = 0; held < 2; ++held)
        for (int s = 1; s <= (KIND == 1 ? 1 : 4); ++s) {
            static const int steps[] = { 0, 32, 10, 6, 5 };
            real error[2];
            for (int j = 0; j < 2; ++j) {
                const int count = (2 + j)*steps[s];
                gvi_stepper st = roll_ball(s, held, 0);
                real v[7], w[3];
                for (int k = 0; k < count; ++k) assert_ok(gvi_step(&st, 2/(real)count));
                assert_ok(gvi_velocity(&st, v));
                body_spin(st.q + 3, v + 3, w);
                error[j] = worst_of(3, w, known);
            }
            assert_between(2*s - 0.15, log(error[0]/error[1])/log(1.5L), 2*s + 0.15);
        }
}

/* docs/theory.md, Rolling: turning about the contact is a linear symmetry that every row allows.  So M is constant at any
   degree and step, and the energy is not. */
TEST(a_rolling_ball_keeps_its_angular_momentum_about_the_ground_at_any_degree)
{
    for (int s = 1; s <= 3; ++s) {
        gvi_stepper st = roll_ball(s, 1, 0);
        real E[2], M[2][3], off = 0;
        for (int k = 0; k <= 400; ++k) {
            real v[7], w[3], from[3] = { 0, 0, rolling_ball.radius }, L[3];
            assert_ok(gvi_velocity(&st, v));
            assert_ok(gvi_energy(&st, E + (k > 0)));
            body_spin(st.q + 3, v + 3, w);
            for (int i = 0; i < 3; ++i) w[i] *= ball.inertia[i];
            body_rotate(st.q + 3, 0, w, L);
            body_cross(from, v, M[k > 0]);
            for (int i = 0; i < 3; ++i) M[k > 0][i] = L[i] + ball.mass*M[k > 0][i];
            for (int i = 0; i < 3 && k; ++i) assert_close(M[1][i], M[0][i], 100*EPS*10);
            if (k) off = fmax(off, fabs(E[1]/E[0] - 1));
            assert_close(st.q[2], rolling_ball.radius, 8*EPS);
            assert_ok(gvi_step(&st, R(0.25)));
        }
        if (KIND > 1) assert_between(s == 1 ? 1e-4L : s == 2 ? 1e-6L : 1e-9L, off, 0.05L);
    }
}

/* The rounding of a place far away, and of p_z, which is 0, hides the convergence of what turns. */
TEST(a_ball_far_away_keeps_its_energy)
{
    gvi_stepper st = roll_ball(8, 1, KIND == 1 ? 100 : R(1e6));
    real E[2];
    assert_ok(gvi_energy(&st, E));
    for (int k = 0; k < 200; ++k) assert_ok(gvi_step(&st, R(0.125)));
    assert_ok(gvi_energy(&st, E + 1));
    assert_close(E[1], E[0], 64*EPS*E[0]);
}

/* Steady: centre on a circle, the tilt what gravity asks for */
static const body disc = { 1, { R(0.25), R(0.25), R(0.5) } };
static const bodies discs = { &disc, 1 };
static const body_round wheel = { .at = 0, .radius = 1, .axis = { 0, 0, 1 } };

GVI_EACH(disc_weight, 7, f, value)
{
    x->f[2] -= R(9.81);
    x->value[0] += R(9.81)*x->q[2];
}

TEST(a_wheel_that_leans_rolls_in_a_circle)
{
    static const gvi_effect weight = { .kind = GVI_POTENTIAL, .points = disc_weight, .value = disc_weight };
    const gvi_effect scene[] = { weight, body_touches(&wheel), body_rolls(&wheel) };
    gvi_desc desc = { .n = 7, .degree = KIND == 3 ? 8 : 6, .effects = scene, .effect_count = 3, .mass = body_mass(&discs) };
    const real a = R(1.1), c = cos(a), s = sin(a), W = R(1.5), along = (W*W*s*c/4 - R(9.81)*c)/(R(1.5)*s*W);
    /* turned about y by -a: its axis is (-s, 0, c), its lowest point at (-c, 0, -s) */
    real q[7] = { 0, 0, s, cos(a/2), 0, -sin(a/2), 0 }, v[7] = { 0 }, w[3], own[3], axis[3], from[3], lambda[3];
    body_rotate(q + 3, 0, wheel.axis, axis);
    for (int i = 0; i < 3; ++i) w[i] = (along - W*axis[2])*axis[i] + W*(i == 2);
    body_lowest(&wheel, q, from);
    assert_close(from[2], -s, 4*EPS);
    body_cross(from, w, v);                                      /* -w x from */
    body_rotate(q + 3, 1, w, own);
    body_turn(q + 3, own, v + 3);
    desc.mass.velocity = NULL;
    gvi_stepper st = new_motion(&desc, 0, q, v);
    const real radius = fabs(along)/W;
    for (int k = 0; k < 200; ++k) {
        assert_ok(gvi_step(&st, R(0.025)));
        body_rotate(st.q + 3, 0, wheel.axis, axis);
        assert_close(axis[2], c, 4000*EPS);
        assert_close(st.q[2], s, 4000*EPS);
    }
    const real turn = W*st.t, side = v[1]/fabs(v[1]);            /* counterclockwise: the centre is to its left */
    assert_close(st.q[0], -side*radius*(1 - cos(turn)), 20000*EPS);
    assert_close(st.q[1], side*radius*sin(turn), 20000*EPS);
    assert_ok(gvi_multipliers(&st, lambda));
    assert_close(lambda[0], R(9.81), 20000*EPS);                 /* its weight is on the ground */
    assert_close(sqrt(lambda[1]*lambda[1] + lambda[2]*lambda[2]), fabs(along)*W, 20000*EPS);
}

RUN_TESTS(NULL, NULL)
