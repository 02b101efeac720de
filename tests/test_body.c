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
    for (int k = 0; k < 2; ++k) body_place(moved[k], at[0], there[k]);
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
TEST(a_scene_with_another_number_of_coordinates_is_refused)
{
    static const body rock = { 1, { 1, 2, 3 } };
    const bodies turns = { &stone, 1 }, moves = { &rock, 1 }, none = { NULL, 0 }, *const all[] = { &turns, &moves, &none };
    static const int wrong[] = { 7, 4, 4 };
    const real q[7] = { 1, 0, 0, 1, 0, 0, 0 }, v[7] = { 0 };
    assert_int_equal(body_coordinates(&turns), 4);
    assert_int_equal(body_coordinates(&moves), 7);
    for (int i = 0; i < 2*COUNT(all); ++i) {
        gvi_desc desc = { .n = wrong[i/2], .mass = body_mass(all[i/2]) };
        if (i % 2) desc.mass.velocity = NULL;
        gvi_stepper st = new_stepper(&desc);
        assert_status(gvi_start(&st, 0, q, v), GVI_E_CALLBACK);
    }
}

/* No such body; a flat one is, also with moments of three digits, and in float. */
TEST(bodies_that_cannot_be_are_refused)
{
    static const body wrong[] = { { -1, { 1, 1, 1 } }, { NAN, { 1, 1, 1 } }, { INFINITY, { 1, 1, 1 } }, { 1, { 1, 0, 1 } },
        { 1, { 1, 1, -1 } }, { 0, { NAN, 1, 1 } }, { 0, { INFINITY, 1, 1 } }, { 1, { 1, 1, R(2.01) } }, { 1, { R(0.1), 3, 1 } },
        { 0, { 5, 1, 3 } } };
    static const body right[] = { { 0, { R(0.0014), R(0.0164), R(0.0178) } }, { 1, { 1, 1, 2 } }, { 1, { R(1.004), R(1.004), R(2.009) } } };
    real q[7] = { 0, 0, 0, 1, 0, 0, 0 };
    const real v[7] = { 0 };
    for (int i = 0; i < COUNT(wrong) + COUNT(right); ++i) {
        const body *b = i < COUNT(wrong) ? wrong + i : right + (i - COUNT(wrong));
        const bodies one = { b, 1 };
        const gvi_effect unit[] = { body_unit(&one) };
        for (int k = 0; k < 3; ++k) {                        // with mass.velocity, without, with |e| held
            gvi_desc desc = { .n = b->mass > 0 ? 7 : 4, .mass = body_mass(&one) };
            if (k > 0) desc.mass.velocity = NULL;
            if (k > 1) desc.effects = unit, desc.effect_count = 1;
            gvi_stepper st = new_stepper(&desc);
            assert_status(gvi_start(&st, 0, q + (desc.n == 4 ? 3 : 0), v), i < COUNT(wrong) ? GVI_E_CALLBACK : GVI_OK);
        }
        assert_true(!body_wrong(b) == (i >= COUNT(wrong)));
    }
}

/* Wheels, joints, gears and ropes of bodies that the scene has not, or that cannot be. */
TEST(rows_that_cannot_be_are_refused)
{
    static const body rock[] = { { 1, { 1, 1, 1 } } };
    static const bodies one = { rock, 1 };
    static const body_round wheel[] = { { 1, 1, { 0, 1, 0 } }, { -1, 1, { 0, 1, 0 } }, { 0, 0, { 0, 1, 0 } },
                                        { 0, -1, { 0, 1, 0 } }, { 0, NAN, { 0, 1, 0 } } };
    static const body_rope rope = { { BODY_WORLD, BODY_WORLD, 7 }, { { 0 } }, 1 };
    const real q[14] = { 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0 }, v[7] = { 0 }, z[3] = { 0, 0, 1 };
    const body_joint far = body_joined(BODY_BALL, q, 7, BODY_WORLD, z, z, NULL), near = body_joined(BODY_HINGE, q, 0, BODY_WORLD, z, z, NULL),
                     back = body_joined(BODY_BALL, q, BODY_WORLD, 7, z, z, NULL);
    const body_gear gear[] = { { { &near, &near }, { 0, 1 } }, { { &near, &near }, { 1, 0 } }, { { &near, &far }, { 1, 1 } } };
    gvi_effect rows[16] = { body_pulls(&rope), body_holds(&far), body_holds(&back), body_meshes(gear), body_meshes(gear + 1),
                            body_meshes(gear + 2) };
    for (int i = 0; i < COUNT(wheel); ++i) rows[6 + 2*i] = body_touches(wheel + i), rows[7 + 2*i] = body_rolls(wheel + i);
    for (int i = 0; i < COUNT(rows); ++i) {
        gvi_desc desc = { .n = 7, .mass = body_mass(&one), .effects = rows + i, .effect_count = 1 };
        desc.mass.velocity = NULL;
        gvi_stepper st = new_stepper(&desc);
        assert_status(gvi_start(&st, 0, q, v), GVI_E_CALLBACK);
    }
}

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

/* ---- joints ---- */

static const int kinds[] = { BODY_BALL, BODY_UNIVERSAL, BODY_HINGE, BODY_SLIDER, BODY_CYLINDER, BODY_WELD };
static const real joint_q[14] = { 0, 0, 0, 1, 0, 0, 0, 1, R(0.5), R(-0.25), R(0.5), R(0.5), R(-0.5), R(0.5) },
                  joint_at[3] = { R(0.5), R(-0.25), R(0.125) }, joint_z[3] = { R(0.5), 1, R(-0.25) }, joint_x[3] = { 1, 0, R(0.5) };

/* An effect's rows at one point */
static void rows_of(const gvi_effect *effect, int n, const real *q, real *g, real *G)
{
    const real t = 0;
    const gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &t, .q = q, .g = g, .jacobian = G };
    for (int i = 0; i < effect->rows*n; ++i) G[i] = 0;
    assert_int_equal(effect->points(&x, effect->user), 0);
}

static real angle_of(const body_joint *joint, const real *q)
{
    real turn[2];
    body_turned(joint, q, turn);
    return atan2(turn[1], turn[0]);
}

/* Rows are 0 where the joint was made, and their jacobian is what differences say, off the joint, too. */
static void expect_derivatives(const gvi_effect *effect, int n, const real *made)
{
    real q[21], g[2][6], there[6], G[126], spare[126], d = cbrt(EPS);
    rows_of(effect, n, made, there, G);
    for (int a = 0; a < effect->rows; ++a) assert_close(there[a], 0, 8*EPS);
    for (int i = 0; i < n; ++i) q[i] = made[i] + R(0.0625)*(real)((i*5)%7 - 3);
    rows_of(effect, n, q, there, G);
    for (int i = 0; i < n; ++i) {
        const real was = q[i];
        for (int k = 0; k < 2; ++k) {
            q[i] = was + (k ? d : -d);
            rows_of(effect, n, q, g[k], spare);
        }
        q[i] = was;
        for (int a = 0; a < effect->rows; ++a)
            assert_close(G[a*n + i], (g[1][a] - g[0][a])/(2*d), 400*d*d*(1 + fabs(G[a*n + i])));
    }
}

TEST(the_jacobians_of_joints_are_their_derivatives)
{
    const int rows[] = { 3, 4, 5, 5, 4, 6 };
    real q[21];
    for (int i = 0; i < 21; ++i) q[i] = joint_q[i % 14] + (real)(i/14);
    for (int k = 0; k < COUNT(kinds); ++k)
        for (int b = 7; b >= BODY_WORLD; b -= 8) {
            const body_joint joint = body_joined(kinds[k], q, 0, b, joint_at, joint_z, k % 2 ? joint_x : NULL);
            const gvi_effect effect = body_holds(&joint);
            assert_int_equal(effect.rows, rows[k]);
            expect_derivatives(&effect, 14, q);
        }
    for (int k = 0; k < 2; ++k) {
        const body_joint first = body_joined(BODY_HINGE, q, k ? 7 : BODY_WORLD, 0, joint_at, joint_z, NULL),
                         second = body_joined(BODY_HINGE, q, 7, 14, joint_at, joint_x, NULL);
        const body_gear gear = { { &first, &second }, { k ? 3 : -5, k ? -2 : 1 } };
        const gvi_effect effect = body_meshes(&gear);
        expect_derivatives(&effect, 21, q);
    }
    body_rope rope = { { 7, 0, BODY_WORLD }, { { R(0.25), 1, 0 }, { 0, R(0.5), -1 }, { 2, 1, R(0.5) } }, 0 };
    const gvi_effect effect = body_pulls(&rope);
    real length, spare[14];
    rows_of(&effect, 14, q, &length, spare);
    rope.length = -length;
    expect_derivatives(&effect, 14, q);
}

/* Two bodies on a joint, free in space: it holds, its forces do no work and change neither momentum nor angular momentum.
   From any velocities, made to fit. */
TEST(two_bodies_on_a_joint_keep_momentum_and_energy)
{
    for (int kind = 0; kind < 2*COUNT(kinds); ++kind) {
        const body_joint joint = body_joined(kinds[kind/2], joint_q, 0, 7, joint_at, joint_z, joint_x);
        const int held = kind % 2;
        gvi_effect scene[2] = { body_holds(&joint) };
        gvi_desc desc = { .n = 14, .degree = 6, .effects = scene, .effect_count = 1, .mass = body_mass(&two) };
        real q[14], v[14] = { R(0.5), R(-0.25), 0, 0, 0, 0, 0, R(-0.25), 0, R(0.25) }, g[6], G[84], E[2], sum[2][6], moved[2];
        desc.mass.velocity = NULL;
        if (held) hold(&desc, scene, &two);
        for (int i = 0; i < 14; ++i) q[i] = joint_q[i];
        body_turn(q + 3, (real[]){ 1, R(0.5), 0 }, v + 3);
        body_turn(q + 10, (real[]){ 0, -1, 2 }, v + 10);
        gvi_stepper st = new_stepper(&desc);
        assert_ok(gvi_project(&st, 0, q, v, moved));
        assert_ok(gvi_start(&st, 0, q, v));
        for (int k = 0; k <= 100; ++k) {
            totals(st.q, st.p, sum[k > 0]);
            assert_ok(gvi_energy(&st, &E[k > 0]));
            rows_of(scene, 14, st.q, g, G);
            for (int i = 0; i < scene->rows; ++i) assert_close(g[i], 0, 16*EPS*(1 + fabs(st.q[0])));
            for (int i = 0; i < 6 && k; ++i) assert_close(sum[1][i], sum[0][i], 128*EPS);
            if (k) assert_close(E[1], E[0], 64*EPS*E[0]);
            assert_ok(gvi_step(&st, R(0.05)));
        }
    }
}

static const body bar[] = { { 2, { R(0.5), R(0.375), R(0.25) } } };
static const bodies bars = { bar, 1 };
static const real pull = 10;

GVI_EACH(bar_weight, 7, f, value)
{
    x->f[2] -= 2*pull;
    x->value[0] += 2*pull*x->q[2];
}

static const gvi_effect of_bar = { .kind = GVI_POTENTIAL, .points = bar_weight, .value = bar_weight };

/* A pendulum on a hinge along x at the origin, its centre at (c, l sin a, -l cos a), from rest at a = 1:
   a'a' = 2 m g l (cos a - cos 1)/I and a'' = -m g l sin a/I, I = Ix + m l l.  The hinge bears m (x'' + g), and a torque
   that keeps the axis, which passes beside the centre by c; none about it. */
TEST(a_hinge_bears_what_a_pendulum_asks_for)
{
    const real c = R(0.25), l = R(0.5), origin[] = { 0, 0, 0 }, x[] = { 1, 0, 0 }, mgl = 2*pull*l, I = R(0.5) + 2*l*l;
    const real q[7] = { c, l*sin(R(1.0)), -l*cos(R(1.0)), cos(R(0.5)), sin(R(0.5)), 0, 0 }, v[7] = { 0 };
    for (int turned_round = 0; turned_round < 2; ++turned_round) {
        const body_joint hinge = turned_round ? body_joined(BODY_HINGE, q, 0, BODY_WORLD, origin, x, NULL)
                                              : body_joined(BODY_HINGE, q, BODY_WORLD, 0, origin, x, NULL);
        const gvi_effect scene[] = { of_bar, body_holds(&hinge) };
        gvi_desc desc = { .n = 7, .degree = 6, .effects = scene, .effect_count = 2, .mass = body_mass(&bars) };
        const real sign = turned_round ? -1 : 1, near = (KIND == 1 ? 400 : 4000)*EPS + (KIND == 3 ? R(1e-13) : 0);
        desc.mass.velocity = NULL;
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k < 50; ++k) {
            real lambda[5], force[3], torque[3];
            assert_ok(gvi_step(&st, R(0.02)));
            assert_ok(gvi_multipliers(&st, lambda));
            body_reaction(&hinge, st.q, lambda, force, torque);
            const real a = 1 + sign*angle_of(&hinge, st.q), rate2 = 2*mgl*(cos(a) - cos(R(1.0)))/I, rate1 = -mgl*sin(a)/I;
            const real y = 2*l*(rate1*cos(a) - rate2*sin(a)), z = 2*l*(rate1*sin(a) + rate2*cos(a)) + 2*pull;
            const real force_is[] = { 0, y, z }, torque_is[] = { 0, -c*z, c*y };
            for (int i = 0; i < 3; ++i) {
                assert_close(sign*force[i], force_is[i], 2*pull*near);
                assert_close(sign*torque[i], torque_is[i], 2*pull*near);
            }
        }
    }
}

/* Down a slide along (0, cos b, -sin b): g sin b t t/2; across it m g cos b, and a torque where the slide is off the centre. */
TEST(a_slider_bears_the_weight_across_its_way)
{
    const real b = R(0.5), q[7] = { 0, 0, 0, 1, 0, 0, 0 }, v[7] = { 0 }, along[] = { 0, cos(b), -sin(b) }, at_side[] = { R(0.5), 0, 0 };
    const body_joint slide = body_joined(BODY_SLIDER, q, BODY_WORLD, 0, at_side, along, NULL);
    const gvi_effect scene[] = { of_bar, body_holds(&slide) };
    gvi_desc desc = { .n = 7, .effects = scene, .effect_count = 2, .mass = body_mass(&bars) };
    desc.mass.velocity = NULL;
    gvi_stepper st = new_motion(&desc, 0, q, v);
    real lambda[5], force[3], torque[3];
    for (int k = 0; k < 8; ++k) assert_ok(gvi_step(&st, R(0.125)));
    assert_ok(gvi_multipliers(&st, lambda));
    body_reaction(&slide, st.q, lambda, force, torque);
    const real way = pull*sin(b)/2, across = 2*pull*cos(b), known[] = { 0, across*sin(b), across*cos(b) };
    for (int i = 0; i < 3; ++i) {
        assert_close(st.q[i], way*along[i], 256*EPS);
        assert_close(force[i], known[i], 2048*EPS);
    }
    /* at (1/2, 0, 0) from the centre: -(1/2, 0, 0) x force */
    assert_close(torque[0], 0, 2048*EPS);
    assert_close(torque[1], known[2]/2, 2048*EPS);
    assert_close(torque[2], -known[1]/2, 2048*EPS);
}

/* Two shafts at 1/2, hinged to the world, a universal joint between them, no torque: tan b = tan a cos 1/2, and the energy.
   Three of the 14 rows are redundant. */
TEST(a_universal_joint_turns_its_shafts_unevenly)
{
    const real c = cos(R(0.5)), s = sin(R(0.5)), e = cos(R(0.25)), f = -sin(R(0.25)), r0 = c, w[2] = { 2, 2*r0 };
    const real z[] = { 0, 0, 1 }, x[] = { 1, 0, 0 }, along[] = { 0, s, c }, pin[] = { 0, c, -s }, centre[] = { 0, 0, 0 };
    const real q[14] = { 0, 0, -1, 1, 0, 0, 0, 0, s, c, e, f, 0, 0 };
    for (int first = 0; first < 2; ++first) {                       /* which rows are redundant */
        const body_joint hinge[] = { body_joined(BODY_HINGE, q, BODY_WORLD, 0, q, z, NULL),
                                     body_joined(BODY_HINGE, q, BODY_WORLD, 7, q + 7, along, NULL) };
        const body_joint cross = body_joined(BODY_UNIVERSAL, q, 0, 7, centre, x, pin);
        const gvi_effect scene[] = { body_holds(first ? &cross : hinge), body_holds(hinge + 1), body_holds(first ? hinge : &cross) };
        gvi_desc desc = { .n = 14, .degree = 6, .effects = scene, .effect_count = 3, .mass = body_mass(&two) };
        real v[14] = { 0 }, off = 0;
        desc.mass.velocity = NULL;
        for (int i = 0; i < 2; ++i) body_turn(q + 7*i + 3, (real[]){ 0, 0, w[i] }, v + 7*i + 3);
        gvi_stepper st = new_motion(&desc, 0, q, v);
        for (int k = 0; k < 100; ++k) {
            assert_ok(gvi_step(&st, R(0.04)));
            const real a = angle_of(hinge, st.q), b = angle_of(hinge + 1, st.q), low = cos(a)*cos(a) + c*c*sin(a)*sin(a);
            real now[14], spun[3];
            assert_ok(gvi_velocity(&st, now));
            body_spin(st.q + 3, now + 3, spun);
            assert_close(sin(b)*cos(a), cos(b)*sin(a)*c, 64*EPS);
            const real I = pair[0].inertia[2], K = pair[1].inertia[2], r = c/low;
            assert_close(spun[2]*spun[2]*(I + K*r*r), w[0]*w[0]*(I + K*r0*r0), 1024*EPS + (KIND == 3 ? R(1e-12) : 0));
            off = fmax(off, fabs(b - a));
        }
        assert_between(R(0.05), off, 1);
    }
}

/* A door, upright or leaning, on a hinge and on a joint that holds its axis once more: redundant rows whose terms are next to 0.
   It turns as on the hinge alone. */
TEST(a_door_may_be_held_twice)
{
    for (int leans = 0; leans < 2; ++leans)
        for (int order = 0; order < 2; ++order) {
            const real e[4] = { cos(R(0.25)*(real)leans), sin(R(0.25)*(real)leans), 0, 0 };
            const real own[3][3] = { { R(0.5), 0, -1 }, { R(0.5), 0, 1 }, { 0, 0, 1 } };
            real q[7] = { 0, 0, 0, e[0], e[1], 0, 0 }, v[7] = { 0 }, place[3][3], turn[2][2];
            for (int i = 0; i < 3; ++i) body_rotate(e, 0, own[i], place[i]);
            const body_joint hinge[] = { body_joined(BODY_HINGE, q, BODY_WORLD, 0, place[order], place[2], NULL),
                                         body_joined(8 + 16, q, BODY_WORLD, 0, place[!order], place[2], NULL) };
            const gvi_effect once[] = { of_bar, body_holds(hinge) }, twice[] = { of_bar, body_holds(hinge + order), body_holds(hinge + !order) };
            gvi_stepper st[2];
            for (int both = 0; both < 2; ++both) {
                gvi_desc desc = { .n = 7, .degree = 6, .effects = both ? twice : once, .effect_count = 2 + both,
                                  .mass = body_mass(&bars) };
                desc.mass.velocity = NULL;
                body_turn(e, (real[]){ 0, 0, 2 }, v + 3);
                body_cross((real[]){ 0, 0, 2 }, (real[]){ -own[0][0], 0, 0 }, place[0]);
                body_rotate(e, 0, place[0], v);
                st[both] = new_motion(&desc, 0, q, v);
                for (int k = 0; k < 100; ++k) assert_ok(gvi_step(&st[both], R(0.02)));
                body_turned(hinge, st[both].q, turn[both]);
            }
            for (int i = 0; i < 2; ++i) assert_close(turn[1][i], turn[0][i], 256*EPS);
        }
}

/* A wheel driven by a torque turns another, 3 to -2: A'' = torque/(I + 9/4 K); the teeth pass K B'' on. */
GVI_EACH(driven, 14, f)
{
    body_torque(x->q + 3, (real[]){ 0, 0, 1 }, x->f + 3);
}

TEST(a_gear_turns_two_hinges_in_its_ratio)
{
    const real q[14] = { 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 1, 0, 0, 0 }, v[14] = { 0 }, z[] = { 0, 0, 1 };
    const body_joint hinge[] = { body_joined(BODY_HINGE, q, BODY_WORLD, 0, q, z, NULL),
                                 body_joined(BODY_HINGE, q, BODY_WORLD, 7, q + 7, z, NULL) };
    const body_gear gear = { { hinge, hinge + 1 }, { 3, -2 } };
    const gvi_effect scene[] = { { .kind = GVI_FORCE, .points = driven }, body_holds(hinge), body_holds(hinge + 1), body_meshes(&gear) };
    gvi_desc desc = { .n = 14, .effects = scene, .effect_count = 4, .mass = body_mass(&two) };
    const real I = pair[0].inertia[2], K = pair[1].inertia[2], A = 1/(I + 9*K/4);
    real lambda[11];
    desc.mass.velocity = NULL;
    gvi_stepper st = new_motion(&desc, 0, q, v);
    for (int k = 0; k < 16; ++k) assert_ok(gvi_step(&st, R(0.125)));
    assert_ok(gvi_multipliers(&st, lambda));
    assert_close(angle_of(hinge, st.q), 2*A, 256*EPS);
    assert_close(angle_of(hinge + 1, st.q), 3*A, 256*EPS);
    assert_close(-2*lambda[10], K*3*A/2, 2048*EPS);
}

/* Atwood's machine, and from one end hangs another: weights 3 | (1: 2 | 4), the numbers masses; the ring of the second is a body
   of mass 1.  With u of the first weight and y of the third about its ring, upwards: from Lagrange's equations
   3 u'' + 1 u'' + 2 (u'' + y'') + 4 (u'' - y'') = g (-3 + 1 + 2 + 4), 2 (u'' + y'') - 4 (u'' - y'') = g (2 - 4)
   where the ring, at -u, has rope ends at -u - y and -u + y. */
static const body weights[] = { { 3, { 1, 1, 1 } }, { 1, { 1, 1, 1 } }, { 2, { 1, 1, 1 } }, { 4, { 1, 1, 1 } } };
static const bodies four = { weights, 4 };

GVI_EACH(four_weights, 28, f)
{
    const real m[] = { 3, 1, 2, 4 };
    for (int i = 0; i < 4; ++i) x->f[7*i + 2] -= pull*m[i];
}

TEST(ropes_over_pulleys_are_atwoods_machine)
{
    const real h = R(0.125), v[28] = { 0 };
    const body_rope ropes[] = { { { 0, BODY_WORLD, 7 }, { { 0, 0, h }, { 0, 0, 4 }, { 0, 0, h } }, 8 - 2*h },
                                { { 14, 7, 21 }, { { 0, 0, h }, { 0, 0, -h }, { 0, 0, h } }, 8 - 4*h } };
    real q[28] = { 0 }, lambda[2];
    for (int i = 0; i < 4; ++i) q[7*i + 2] = i < 2 ? 0 : -4, q[7*i + 3] = 1;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = four_weights }, body_pulls(ropes), body_pulls(ropes + 1) };
    gvi_desc desc = { .n = 28, .degree = 4, .effects = scene, .effect_count = 3, .mass = body_mass(&four) };
    desc.mass.velocity = NULL;
    gvi_stepper st = new_motion(&desc, 0, q, v);
    for (int k = 0; k < 8; ++k) assert_ok(gvi_step(&st, R(0.0625)));
    assert_ok(gvi_multipliers(&st, lambda));
    /* 10 u'' - 2 y'' = 4 g, -2 u'' + 6 y'' = -2 g */
    const real up = pull*20/56, y = -pull*12/56, t2 = R(0.125);
    const real known[] = { up*t2, -up*t2, -4 - (up + y)*t2, -4 - (up - y)*t2 };
    for (int i = 0; i < 4; ++i) assert_close(st.q[7*i + 2], known[i], 64*EPS);
    assert_close(lambda[0], 3*(pull + up), 2048*EPS);
    assert_close(lambda[1], 2*(pull - up - y), 2048*EPS);
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
