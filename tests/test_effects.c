/* The effects of examples/tools/effects.h: forces are derivatives of their values, Hessians those
   of the forces; each reads and writes its own coordinates only; all points at once are the points
   one by one, to the bit (given that the compiler does not contract a*b + c: -ffp-contract=off);
   and what each law says of power, sums and special places. Bounds are multiples of powers of EPS:
   the same file serves float, double and long double. */
#include "gvi_test.h"
#include "tools/effects_tangent.h"

enum { N = 17, ROOM = 16, POINTS = 13 };

/* Every effect, acting on coordinates first..last-1 of N = 17. */

static const real mass[] = { 2, 1, 3, 1 };
static const struct uniform_field field = { { 2, 3, 3 }, mass, { 1, -2, 3 } };
static const struct uniform_field flat_field = { { 3, 4, 2 }, mass, { 1, -2, 0 } };
static const struct pair_gravity pairs = { { 2, 4, 3 }, mass, 2 };
static const struct pair_gravity flat_pairs = { { 1, 4, 2 }, mass, 2 };
static const struct central_gravity centre = { { 5, 3, 3 }, mass, 3, { -1, 0, -2 } };
static const struct central_gravity flat_centre = { { 5, 3, 2 }, mass, 3, { -1, 0, 0 } };
static const struct oblateness bulge = { { 4, 3, 3 }, mass, 3, 1, (real)0.5L };
static const struct spring list[] = { { 0, 1, 3, 1 }, { 3, 1, 2, 0 }, { 2, 0, 1, 2 } };
static const struct springs net = { { 3, 4, 3 }, list, 3, N };
static const struct springs flat_net = { { 3, 4, 2 }, list, 3, N };
static const struct tether hook[] = { { 1, 3, 1, { -1, -1, 0 } }, { 0, 2, 0, { 1, -1, 0 } } };
static const struct tethers hooks = { { 6, 2, 3 }, hook, 2, N };
static const struct tethers flat_hooks = { { 6, 2, 2 }, hook, 2, N };
static const struct weights links = { 4, 3, mass };
static const struct quartic_well wells = { 5, 4, -1, 2, N };
static const struct chain bonds = { 3, 6, 2, (real)0.5L, (real)0.75L, N };
static const struct linear_drag oil = { 6, 5, (real)0.25L, N };
static const struct air_drag air = { { 2, 3, 3 }, 2, N };
static const struct air_drag flat_air = { { 2, 3, 2 }, 2, N };
static const struct atmosphere thin_air = { { 3, 2, 3 }, 2, 1, 3 };
static const joint joints[] = { { -1, 4 }, { 4, 6 }, { 6, 5 } };
static const struct joint_friction gears = { joints, 3, 2 };
static const struct motor engine = { { 4, 5 }, 1, 2, 3, 1 };
static const struct motor drive = { { -1, 7 }, 0, 2, 3, 1 };
static const struct servo arm = { { 8, 7 }, 3, 2, 1, (real)0.5L, 2, 1 };
static const struct servo grounded = { { -1, 7 }, 3, 2, 1, (real)0.5L, 2, 1 };
static const struct magnetic magnet = { { 4, 3, 3 }, mass, { 1, -2, 3 } };
static const struct rotating_frame frame = { { 4, 3, 2 }, mass, 2 };

typedef struct specimen { const char *name; gvi_effect effect; int first, last; } specimen;

enum { SPECIMENS = 26 };

static const specimen *specimens(void)
{
    static specimen all[SPECIMENS];
    const specimen made[SPECIMENS] = {
        { "uniform field", uniform_field(&field), 2, 11 },
        { "uniform field, plane", uniform_field(&flat_field), 3, 11 },
        { "pair gravity", pair_gravity(&pairs), 2, 14 },
        { "pair gravity, plane", pair_gravity(&flat_pairs), 1, 9 },
        { "central gravity", central_gravity(&centre), 5, 14 },
        { "central gravity, plane", central_gravity(&flat_centre), 5, 11 },
        { "oblateness", oblateness(&bulge), 4, 13 },
        { "springs", springs(&net), 3, 15 }, { "springs, plane", springs(&flat_net), 3, 11 },
        { "tethers", tethers(&hooks), 6, 12 }, { "tethers, plane", tethers(&flat_hooks), 6, 10 },
        { "weights", weights(&links), 4, 7 }, { "quartic well", quartic_well(&wells), 5, 9 },
        { "chain", chain(&bonds), 3, 9 }, { "linear drag", linear_drag(&oil), 6, 11 },
        { "air drag", air_drag(&air), 2, 11 }, { "air drag, plane", air_drag(&flat_air), 2, 8 },
        { "atmosphere", atmosphere(&thin_air), 3, 9 }, { "joint friction", joint_friction(&gears), 4, 7 },
        { "motor", motor(&engine), 4, 6 }, { "drive", motor(&drive), 7, 8 },
        { "servo", servo(&arm), 7, 9 }, { "servo on the ground", servo(&grounded), 7, 8 },
        { "magnetic force", magnetic_force(&magnet), 4, 13 },
        { "magnetic field", magnetic_field(&magnet), 4, 13 },
        { "rotating frame", rotating_frame(&frame), 4, 10 } };
    memcpy(all, made, sizeof made);
    return all;
}

/* Particles on a rough line, so that no two come closer than 1/2. */
static void draw(uint64_t from, real *q, real *v)
{
    dice = from;
    for (int i = 0; i < N; ++i) {
        q[i] = (real)(i % 7)/2 + 1 + uniform()/4;
        v[i] = 2*uniform() - 1;
    }
}

/* One point: f and dldv (or value) of an effect, from zero. */
static void ask(const gvi_effect *e, real t, const real *q, const real *v, real *f, real *g)
{
    const gvi_points x = { .n = N, .count = 1, .stride = 1, .t = &t, .q = q, .f = f,
                           .v = e->kind == GVI_POTENTIAL ? NULL : v,
                           .dldv = e->kind == GVI_LAGRANGIAN ? g : NULL };
    for (int i = 0; i < N; ++i) f[i] = g[i] = 0;
    assert_int_equal(e->points(&x, e->user), 0);
}

static real value(const gvi_effect *e, real t, const real *q, const real *v)
{
    real sum = 0;
    const gvi_points x = { .n = N, .count = 1, .stride = 1, .t = &t, .q = q, .value = &sum,
                           .v = e->kind == GVI_POTENTIAL ? NULL : v };
    assert_int_equal(e->value(&x, e->user), 0);
    return sum;
}

/* Central differences of order 8.  At distance d = EPS^(1/9)/4 they truncate by
   d^8 |f^(9)|/630, below EPS^(8/9)/100 for functions that vary over 1/2, and
   round by about 4 EPS |f|/d = 16 EPS^(8/9) |f|. */
static const real weight[4] = { (real)4/5, -(real)1/5, (real)4/105, -(real)1/280 };

static real distance(void) { return pow((real)EPS, 1/(real)9)/4; }
static real bound(real size) { return 100*pow((real)EPS, 8/(real)9)*(1 + size); }

/* Is `force` the derivative of `valued`, by q and, for Lagrangian terms, by v?
   The largest difference over its bound. */
static real mismatch(const gvi_effect *force, const gvi_effect *valued, uint64_t from)
{
    real q[N], v[N], f[N], g[N], worst = 0, d = distance(), t = (real)0.375L;
    draw(from, q, v);
    ask(force, t, q, v, f, g);
    const real sign = force->kind == GVI_POTENTIAL ? -1 : 1, size = fabs(value(valued, t, q, v));
    for (int i = 0; i < 2*N; ++i) {
        real *x = i < N ? &q[i] : &v[i-N], at = *x, slope = 0, given = i < N ? f[i] : g[i-N];
        for (int j = 1; j <= 4; ++j) {
            *x = at + (real)j*d;
            const real up = value(valued, t, q, v), right = *x;
            *x = at - (real)j*d;
            slope += weight[j-1]*(up - value(valued, t, q, v))*(2*(real)j*d/(right - *x));
        }
        *x = at;
        worst = fmax(worst, fabs(sign*slope/d - given)/bound(size + fabs(given)));
    }
    return worst;
}

TEST(forces_are_derivatives_of_their_values)
{
    const specimen *s = specimens();
    int seen = 0;
    for (int e = 0; e < SPECIMENS; ++e) {
        if (s[e].effect.kind == GVI_FORCE) continue;
        assert_non_null(s[e].effect.value);
        for (uint64_t from = 1; from <= 5; ++from, ++seen) {
            const real worst = mismatch(&s[e].effect, &s[e].effect, from);
            assert_true(worst < 1);
        }
    }
    assert_int_equal(seen, 16*5);
}

static real hessian_mismatch(const gvi_effect *e, uint64_t from)
{
    static real fq[N*N], fv[N*N];
    real q[N], v[N], up[N], down[N], g[N], worst = 0, d = distance(), t = (real)0.375L;
    draw(from, q, v);
    memset(fq, 0, sizeof fq);
    memset(fv, 0, sizeof fv);
    e->hessian(t, q, v, fq, e->kind == GVI_POTENTIAL ? NULL : fv, NULL, e->user);
    for (int j = 0; j < 2*N; ++j) {
        real *x = j < N ? &q[j] : &v[j-N], at = *x, slope[N] = { 0 };
        for (int k = 1; k <= 4; ++k) {
            *x = at + (real)k*d;
            ask(e, t, q, v, up, g);
            *x = at - (real)k*d;
            ask(e, t, q, v, down, g);
            for (int i = 0; i < N; ++i) slope[i] += weight[k-1]*(up[i] - down[i])/d;
        }
        *x = at;
        for (int i = 0; i < N; ++i) {
            const real given = j < N ? fq[i*N+j] : fv[i*N+j-N];
            worst = fmax(worst, fabs(slope[i] - given)/bound(10 + fabs(given)));
            if (j < N && e->kind == GVI_POTENTIAL)
                assert_close(fq[i*N+j], fq[j*N+i], 8*(real)EPS*fabs(given));
        }
    }
    return worst;
}

TEST(hessians_are_derivatives_of_the_forces)
{
    const specimen *s = specimens();
    int seen = 0;
    for (int e = 0; e < SPECIMENS; ++e) {
        if (!s[e].effect.hessian) continue;
        ++seen;
        for (uint64_t from = 1; from <= 3; ++from) {
            const real worst = hessian_mismatch(&s[e].effect, from);
            assert_true(worst < 1);
        }
    }
    assert_int_equal(seen, 13);

    // without n there is none: its rows could not be found
    struct springs no_n = net;
    no_n.n = 0;
    assert_null(springs(&no_n).hessian);
}

TEST(each_effect_reads_and_writes_its_own_coordinates_only)
{
    const specimen *s = specimens();
    for (int e = 0; e < SPECIMENS; ++e) {
        const gvi_effect *x = &s[e].effect;
        real q[N], v[N], f[N], g[N], full[N], full_g[N];
        draw(7, q, v);
        ask(x, 1, q, v, full, full_g);
        int moved = 0;
        for (int i = 0; i < N; ++i) {
            const int own = i >= s[e].first && i < s[e].last;
            moved += own && (full[i] < 0 || full[i] > 0);
            if (!own) q[i] = v[i] = (real)NAN;
        }
        assert_true(moved >= (s[e].last - s[e].first + 1)/2);

        // what others hold is not read (it would spread), and what they got is not written
        const gvi_points one = { .n = N, .count = 1, .stride = 1, .t = (real[]){ 1 }, .q = q, .f = f,
                                 .v = x->kind == GVI_POTENTIAL ? NULL : v,
                                 .dldv = x->kind == GVI_LAGRANGIAN ? g : NULL };
        volatile real before[N];                  // not in a register wider than it
        for (int i = 0; i < N; ++i) f[i] = g[i] = before[i] = i < s[e].first || i >= s[e].last ? 1/(real)(i + 3) : 0;
        assert_int_equal(x->points(&one, x->user), 0);
        for (int i = 0; i < N; ++i) {
            const int own = i >= s[e].first && i < s[e].last;
            assert_true(f[i] == (own ? full[i] : before[i]));
            assert_true(g[i] == (own ? (x->kind == GVI_LAGRANGIAN ? full_g[i] : 0) : before[i]));
        }
        if (x->value) assert_true(isfinite(value(x, 1, q, v)));
    }
}

TEST(all_points_at_once_are_the_points_one_by_one)
{
    static real q[N*ROOM], v[N*ROOM], f[N*ROOM], g[N*ROOM], V[ROOM], t[ROOM];
    const specimen *s = specimens();
    for (int e = 0; e < SPECIMENS; ++e) {
        const gvi_effect *x = &s[e].effect;
        gvi_points all = { .n = N, .count = POINTS, .stride = ROOM, .t = t, .q = q, .f = f,
                           .v = x->kind == GVI_POTENTIAL ? NULL : v,
                           .dldv = x->kind == GVI_LAGRANGIAN ? g : NULL };
        for (int k = 0; k < ROOM; ++k) {
            real a[N], b[N];
            draw((uint64_t)k + 20, a, b);
            t[k] = (real)k/8;
            V[k] = 0;
            for (int i = 0; i < N; ++i) q[i*ROOM+k] = a[i], v[i*ROOM+k] = b[i], f[i*ROOM+k] = g[i*ROOM+k] = 0;
        }
        assert_int_equal(x->points(&all, x->user), 0);
        all.f = all.dldv = NULL;
        all.value = V;
        if (x->value) assert_int_equal(x->value(&all, x->user), 0);
        for (int k = 0; k < ROOM; ++k) {
            real a[N], b[N], one[N] = { 0 }, two[N] = { 0 };
            for (int i = 0; i < N; ++i) a[i] = q[i*ROOM+k], b[i] = v[i*ROOM+k];
            if (k < POINTS) ask(x, t[k], a, b, one, two);                   // beyond: padding, stays 0
            for (int i = 0; i < N; ++i) assert_true(f[i*ROOM+k] == one[i] && g[i*ROOM+k] == two[i]);
            if (x->value) assert_true(V[k] == (k < POINTS ? value(x, t[k], a, b) : 0));
        }
    }
}

/* Power f.v of a force at drawn point `from`. */
static real power(const gvi_effect *e, uint64_t from)
{
    real q[N], v[N], f[N], g[N], sum = 0;
    draw(from, q, v);
    ask(e, 1, q, v, f, g);
    for (int i = 0; i < N; ++i) sum += f[i]*v[i];
    return sum;
}

TEST(drag_takes_power_and_a_magnetic_force_none)
{
    const gvi_effect drags[] = { linear_drag(&oil), air_drag(&air), air_drag(&flat_air),
                                 atmosphere(&thin_air), joint_friction(&gears) };
    const gvi_effect still = magnetic_force(&magnet);
    for (uint64_t from = 1; from <= 50; ++from) {
        for (int i = 0; i < COUNT(drags); ++i) assert_true(power(&drags[i], from) < 0);

        // the power is a sum of terms e B_i v_j v_k below |e| |v|^2 3, each rounded three times
        real q[N], v[N], size = 0;
        draw(from, q, v);
        for (int i = 0; i < 9; ++i) size += 3*mass[i/3]*v[4+i]*v[4+i];
        assert_close(power(&still, from), 0, 4*(real)EPS*size);
    }

    // a rigid turn of all links in joint friction: only the joint to the ground rubs
    real q[N] = { 0 }, v[N], f[N], g[N];
    const gvi_effect rub = joint_friction(&gears);
    for (int i = 0; i < N; ++i) v[i] = 3;
    ask(&rub, 0, q, v, f, g);
    assert_true(f[4] == -6 && f[5] == 0 && f[6] == 0);
}

TEST(air_drag_is_quadratic)
{
    real q[N], v[N], f[N], g[N], twice[N];
    const gvi_effect e = air_drag(&air), thin = atmosphere(&thin_air);
    draw(1, q, v);
    ask(&e, 0, q, v, f, g);
    for (int i = 0; i < N; ++i) v[i] *= 2;
    ask(&e, 0, q, v, twice, g);
    for (int i = 0; i < N; ++i) assert_true(twice[i] == 4*f[i]);         // powers of 2: exact

    // speed 5, c = 2; at rest nothing; one scale height up: a factor e
    for (int i = 0; i < N; ++i) q[i] = v[i] = 0;
    v[2] = 3, v[4] = 4;
    ask(&e, 0, q, v, f, g);
    assert_true(f[2] == -30 && f[3] == 0 && f[4] == -40 && f[5] == 0);
    q[3] = 4, v[3] = 1;                                                   // radius 1, height 3
    ask(&thin, 0, q, v, f, g);
    assert_close(f[3], -2*sqrt((real)17)*exp((real)-1), 16*(real)EPS);
}

/* Two bodies: Newton's law in numbers; the flattened body over pole and equator. */
TEST(gravity_is_newtons_in_numbers)
{
    const struct pair_gravity two = { { 0, 2, 3 }, mass, 3 };
    const struct oblateness flat = { { 0, 1, 3 }, mass, 3, 1, (real)0.5L };
    const gvi_effect e = pair_gravity(&two), o = oblateness(&flat);
    real q[N] = { 0 }, v[N] = { 0 }, f[N], g[N];
    q[3] = 2, q[4] = 1, q[5] = 2;                                         // distance 3
    ask(&e, 0, q, v, f, g);
    assert_close(f[0], (real)(6*2)/27, 2*(real)EPS);                        // G m m = 6
    assert_close(f[4], (real)(-6*1)/27, 2*(real)EPS);
    assert_close(value(&e, 0, q, v), -2, 4*(real)EPS);
    q[0] = 0, q[1] = 0, q[2] = 2;                                         // gm m J2 R^2 = 3
    ask(&o, 0, q, v, f, g);
    assert_close(f[2], (real)3*3/16, 2*(real)EPS);                          // 3 a/r^4: outwards
    q[0] = 2, q[2] = 0;
    ask(&o, 0, q, v, f, g);
    assert_close(f[0], (real)-3*3/32, 2*(real)EPS);                         // 3/2 a/r^4: inwards
    assert_true(f[2] == 0);
}

/* A spring of rest length 0 has a force, and a Hessian, where its ends meet. */
TEST(a_spring_without_length_has_a_force_where_its_ends_meet)
{
    const struct spring s[] = { { 0, 1, 3, 0 } };
    const struct springs p = { { 0, 2, 2 }, s, 1, N };
    const gvi_effect e = springs(&p);
    static real fq[N*N];
    real q[N] = { 0 }, v[N] = { 0 }, f[N], g[N];
    memset(fq, 0, sizeof fq);
    ask(&e, 0, q, v, f, g);
    for (int i = 0; i < N; ++i) assert_true(f[i] == 0);
    assert_int_equal(e.hessian(0, q, v, fq, NULL, NULL, e.user), 0);
    assert_true(fq[0] == -3 && fq[2] == 3 && fq[1] == 0);
}

TEST(motors_and_servos_do_as_their_numbers_say)
{
    real q[N] = { 0 }, v[N] = { 0 }, f[N], g[N];
    const real t = (real)0.7L, clock = 2*t + 1, target = 1 + cos(clock)/2, rate = -sin(clock);
    const gvi_effect e = motor(&engine), s = servo(&arm), r = servo(&grounded);
    ask(&e, t, q, v, f, g);
    assert_close(f[5], 1 + 2*cos(3*t + 1), 8*(real)EPS);
    assert_true(f[4] == -f[5]);

    // on its target and as fast as it, the servo rests; off it, k and c say how strong it is
    q[8] = (real)0.25L, v[8] = (real)0.5L;
    q[7] = q[8] + target, v[7] = v[8] + rate;
    ask(&s, t, q, v, f, g);
    assert_close(f[7], 0, 16*(real)EPS);
    q[7] += (real)0.125L, v[7] += (real)0.25L;
    ask(&s, t, q, v, f, g);
    assert_close(f[7], -3*(real)0.125L - 2*(real)0.25L, 16*(real)EPS);
    assert_true(f[8] == -f[7]);
    q[7] -= q[8], v[7] -= v[8];
    ask(&r, t, q, v, g, f);
    assert_close(g[7], -3*(real)0.125L - 2*(real)0.25L, 16*(real)EPS);
}

/* The term linear in v has no energy v dL/dv - L; the frame has -w^2 r^2/2, and
   its force with that of dL/dv's change is Coriolis 2 w x v and centrifugal. */
TEST(the_magnetic_term_is_its_force_and_the_frame_is_coriolis)
{
    real q[N], v[N], f[N], g[N], full[N], sum = 0, centrifugal = 0;
    const gvi_effect term = magnetic_field(&magnet), force = magnetic_force(&magnet);
    const gvi_effect turn = rotating_frame(&frame);
    draw(9, q, v);
    ask(&term, 0, q, v, f, g);
    for (int i = 0; i < N; ++i) sum += v[i]*g[i];
    assert_close(sum, value(&term, 0, q, v), 64*(real)EPS);

    // dL/dq - d/dt dL/dv, dL/dv being linear in q: the force
    ask(&force, 0, q, v, full, g);
    ask(&term, 0, v, v, f, g);                                            // g: dL/dv at q = v is its rate
    ask(&term, 0, q, v, f, (real[N]){ 0 });
    for (int i = 0; i < N; ++i) assert_close(f[i] - g[i], full[i], 16*(real)EPS*(1 + fabs(full[i])));

    ask(&turn, 0, q, v, f, g);
    sum = -value(&turn, 0, q, v);
    for (int i = 0; i < N; ++i) sum += v[i]*g[i];
    for (int i = 0; i < 6; ++i) centrifugal -= mass[i/2]*4*q[4+i]*q[4+i]/2;
    assert_close(sum, centrifugal, 32*(real)EPS*fabs(centrifugal));
    ask(&turn, 0, v, v, full, g);
    for (int i = 0; i < 3; ++i) {
        const real m = mass[i], *x = q + 4 + 2*i, *u = v + 4 + 2*i;
        assert_close(f[4+2*i] - g[4+2*i], m*(4*x[0] + 4*u[1]), 64*(real)EPS*(1 + fabs(f[4+2*i])));
        assert_close(f[5+2*i] - g[5+2*i], m*(4*x[1] - 4*u[0]), 64*(real)EPS*(1 + fabs(f[5+2*i])));
    }
}

/* v'M(q)v/2 from the lower triangle that the callback writes. */
static real kinetic(const gvi_mass *m, int n, const real *q, const real *v, real *p)
{
    real M[9] = { 0 }, T = 0;
    const gvi_points x = { .n = n, .count = 1, .stride = 1, .q = q, .mass = M };
    assert_int_equal(m->points(&x, m->user), 0);
    for (int i = 0; i < n; ++i) {
        p[i] = 0;
        for (int j = 0; j < n; ++j) p[i] += M[i >= j ? i*n+j : j*n+i]*v[j];
        T += p[i]*v[i]/2;
    }
    return T;
}

static void check_mass(gvi_mass m, int n)
{
    real q[3] = { (real)0.7L, (real)-0.4L, (real)0.3L }, v[3] = { 1, -2, 3 };
    real p[3], w[3], f[3] = { 0 }, d = distance();
    const real T = kinetic(&m, n, q, v, p);
    const gvi_points back = { .n = n, .count = 1, .stride = 1, .q = q, .p = p, .velocity = w };
    const gvi_points grad = { .n = n, .count = 1, .stride = 1, .q = q, .v = v, .f = f };
    assert_int_equal(m.velocity(&back, m.user), 0);
    assert_int_equal(m.gradient(&grad, m.user), 0);
    for (int i = 0; i < n; ++i) {
        real slope = 0, at = q[i], other[3];
        assert_close(w[i], v[i], 64*(real)EPS);
        for (int k = 1; k <= 4; ++k) {
            q[i] = at + (real)k*d;
            const real up = kinetic(&m, n, q, v, other);
            q[i] = at - (real)k*d;
            slope += weight[k-1]*(up - kinetic(&m, n, q, v, other))/d;
        }
        q[i] = at;
        assert_close(slope, f[i], bound(T));
    }
}

TEST(masses_are_consistent)
{
    static const struct two_links rods = { 3, 1, (real)1.25L };
    static const struct top spinner = { 2, (real)0.75L };
    check_mass(two_links(&rods), 2);
    check_mass(top(&spinner), 3);

    // point masses 2 and 1 at the ends of rods 1 and 3/4: velocities of both, in the plane
    static const struct two_links points = { 3, (real)9/16, (real)3/4 };
    const gvi_mass m = two_links(&points);
    const real q[2] = { (real)0.5L, (real)1.25L }, v[2] = { 2, -3 };
    const real x = cos(q[0])*v[0], y = sin(q[0])*v[0], X = x + cos(q[1])*v[1]*3/4, Y = y + sin(q[1])*v[1]*3/4;
    real p[2];
    assert_close(kinetic(&m, 2, q, v, p), x*x + y*y + (X*X + Y*Y)/2, 32*(real)EPS);
}

/* A rest length of NaN is no rest length of 0, and one below 0 is what the value says */
TEST(parameters_that_cannot_be_are_refused)
{
    const real q[6] = { 0, 0, 0, 3, 0, 4 };
    for (int i = 0; i < 2; ++i) {
        const struct spring bond = { 0, 1, 2, i ? -1 : (real)NAN };
        const struct springs pair = { { 0, 2, 3 }, &bond, 1, 6 };
        const struct tether hold = { 1, 2, bond.rest, { 0, 0, 0 } };
        const struct tethers held = { { 0, 2, 3 }, &hold, 1, 6 };
        const gvi_effect effects[] = { springs(&pair), tethers(&held) };
        for (int k = 0; k < 2; ++k) {
            real f[6] = { 0 }, fq[36] = { 0 };
            const gvi_points x = { .n = 6, .count = 1, .stride = 1, .q = q, .f = f };
            assert_int_equal(effects[k].points(&x, effects[k].user), 0);
            assert_int_equal(effects[k].hessian(0, q, NULL, fq, NULL, NULL, effects[k].user), 0);
            if (i) assert_close(f[5], -2*(5 + 1)*(real)4/5, 16*(real)EPS);          // k (r - rest), r = 5
            if (i) assert_close(fq[35], -2 + 2*-1*((real)1/5 - (real)16/125), 16*(real)EPS);
            else assert_true(f[5] != f[5] && fq[35] != fq[35]);
        }
    }
    static const struct two_links wrong[] = { { 0, 1, 0 }, { -1, -1, 0 }, { 1, 1, 1 }, { 1, 1, -2 }, { 1, (real)NAN, 0 } };
    static const struct top tops[] = { { 0, 1 }, { 1, 0 }, { -1, 1 }, { 1, -1 }, { (real)NAN, 1 }, { 1, (real)NAN } };
    for (int i = 0; i < 2*(COUNT(wrong) + COUNT(tops)); ++i) {
        const int k = i/2, is_top = k >= COUNT(wrong);
        gvi_desc desc = { .n = is_top ? 3 : 2, .mass = is_top ? top(tops + (k - COUNT(wrong))) : two_links(wrong + k) };
        if (i % 2) desc.mass.velocity = NULL;
        gvi_stepper st = new_stepper(&desc);
        assert_status(gvi_start(&st, 0, q + 3, (real[]){ 1, 1, 1 }), GVI_E_CALLBACK);
    }
}

/* effects_tangent.h: blocks against differences, transposed products by l'(A d + B d') = d'A'l + d''B'l, columns by
   parameters against differences of two runs. */
static real tangent_memory[GVI_LENGTH(12, 4, 4)], tangent_room[TANGENT_ROOM(3, 3)];
static const real one_mass[] = { R(1.5) };
static struct central_gravity planet = { { 0, 1, 3 }, one_mass, R(1.25), { R(0.125), 0, R(-0.25) } };
static struct oblateness flattening = { { 0, 1, 3 }, one_mass, R(1.25), 1, R(0.0625) };
static struct atmosphere orbit_air = { { 0, 1, 3 }, R(0.03125), 1, R(0.75) };
static const real orbit_q[] = { R(1.25), R(-0.5), R(0.75) }, orbit_v[] = { R(0.25), R(0.5), R(-0.375) };

static void orbit_scene(gvi_effect *effect)
{
    effect[0] = central_gravity(&planet);
    effect[1] = oblateness(&flattening);
    effect[2] = atmosphere(&orbit_air);
}

TEST(products_of_gravity_j2_and_air_agree_with_differences)
{
    gvi_effect effect[3];
    const real dq[] = { R(0.25), R(0.5), R(-0.75) }, dv[] = { R(-0.5), R(0.75), R(0.25) };
    int part = -1;
    orbit_scene(effect);
    tangent T = { .plain = { .n = 3, .degree = 4, .effects = effect, .effect_count = 3 }, .product = EFFECTS_TANGENT_ORBIT,
                  .directions = 1, .room = tangent_room, .room_length = COUNT(tangent_room) };
    assert_ok(tangent_scene(&T));
    assert_between(0, tangent_check(&T, 0, orbit_q, orbit_v, dq, dv, &part), 400*pow((real)EPS, R(0.8)));
    planet.on.dim = 2;
    assert_between(-1, tangent_check(&T, 0, orbit_q, orbit_v, dq, dv, &part), -1);
    planet.on.dim = 3;
}

TEST(the_transposed_product_of_the_air_is_the_product_transposed)
{
    const real t = 0, d[] = { R(0.25), R(0.5), R(-0.75) }, dv[] = { R(-0.5), R(0.75), R(0.25) }, l[] = { 1, R(-0.25), R(0.5) };
    real f[3] = { 0 }, back[3] = { 0 }, by_v[3] = { 0 }, one = 0, other = 0;
    const gvi_points x = { .n = 3, .count = 1, .stride = 1, .t = &t, .q = orbit_q, .v = orbit_v };
    gvi_points along = x, costate = x;
    along.q = d, along.v = dv, along.f = f;
    costate.q = l, costate.f = back, costate.dldv = by_v;
    assert_int_equal(atmosphere_product(&x, &along, -1, &orbit_air), 0);
    assert_int_equal(atmosphere_transposed(&x, &costate, -1, &orbit_air), 0);
    for (int i = 0; i < 3; ++i) {
        one += l[i]*f[i];
        other += d[i]*back[i] + dv[i]*by_v[i];
    }
    assert_close(one, other, 8*EPS);
    assert_true(fabs(one) > R(0.001));
}

static real *orbit_parameter(int k) { return k == 0 ? &planet.gm : k == 1 ? &flattening.j2 : &orbit_air.c; }

TEST(columns_by_gm_j2_and_c_are_derivatives_of_the_run)
{
    gvi_effect effect[3];
    const real D = pow((real)EPS, R(0.2))/8, factor[] = { 1, -1, 2, -2 }, factor_of[] = { 8, -8, -1, 1 };
    gvi_stepper st;
    orbit_scene(effect);
    tangent T = { .plain = { .n = 3, .degree = 4, .effects = effect, .effect_count = 3 }, .product = EFFECTS_TANGENT_ORBIT,
                  .parameters = 3, .room = tangent_room, .room_length = COUNT(tangent_room) };
    assert_ok(tangent_scene(&T));
    assert_ok(gvi_init(&st, &T.desc, tangent_memory, sizeof tangent_memory));
    assert_ok(tangent_start(&T, &st, 0, orbit_q, orbit_v, NULL, NULL));
    for (int k = 0; k < 8; ++k) assert_ok(gvi_step(&st, R(0.125)));

    for (int j = 0; j < 3; ++j) {
        real dq[3], dp[3], slope[3] = { 0 }, *theta = orbit_parameter(j), was = *theta, d = D*was;
        tangent_column(&T, &st, j, dq, dp);
        for (int z = 0; z < 4; ++z) {
            static real memory[GVI_LENGTH(3, 4, 4)];
            gvi_stepper plain;
            *theta = was + factor[z]*d;
            assert_ok(gvi_init(&plain, &T.plain, memory, sizeof memory));
            assert_ok(gvi_start(&plain, 0, orbit_q, orbit_v));
            for (int k = 0; k < 8; ++k) assert_ok(gvi_step(&plain, R(0.125)));
            for (int i = 0; i < 3; ++i) slope[i] += factor_of[z]*plain.q[i]/(12*d);
        }
        *theta = was;
        for (int i = 0; i < 3; ++i) assert_close(dq[i], slope[i], 400*pow((real)EPS, R(0.75)));
    }
}

RUN_TESTS(NULL, NULL)
