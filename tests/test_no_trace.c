/* Twins: two steppers of one scene.  One of them is asked questions, fails, is saved and restored, or lives in
   other units; the other just steps.  They must agree to the bit.  Then what the first guess of an iteration
   must not spoil: steps that change their length, that are very long, whose guess a callback refuses. */
#include "gvi_test.h"

enum { MOST = 12000, ROOM = 3 };
static real memory[2][MOST], saved[MOST];

/* What can be made to go wrong, and how often the callbacks were called */
typedef struct mood {
    real wall;                          /* the force fails beyond x = wall */
    real edge;                          /* and is NaN beyond x = edge */
    real walls[2];                      /* M and its gradient fail beyond */
    real rigid;                         /* M is singular beyond */
    unsigned long long points, masses;  /* evaluated since the start */
} mood;

static const real far_away = (real)1e9L;
static const mood calm = { far_away, far_away, { far_away, far_away }, far_away, 0, 0 };

typedef void law(int n, const real *q, real *f);

static int pull(const gvi_points *p, mood *m, law *force)
{
    const real *x = p->q;
    m->points += (unsigned long long)p->count;
    for (int k = 0; k < p->count; ++k) if (x[k] > m->wall) return 1;
    for (int k = 0; k < p->count; ++k) {
        real q[ROOM], f[ROOM];
        for (int i = 0; i < p->n; ++i) q[i] = x[i*p->stride + k];
        for (int i = 0; i < p->n; ++i) f[i] = p->f[i*p->stride + k];
        force(p->n, q, f);
        for (int i = 0; i < p->n; ++i) p->f[i*p->stride + k] = f[i];
        if (x[k] > m->edge) p->f[k] = (real)NAN;
    }
    return 0;
}

/* V = (x^2 + y^2)/2 + x^2 y - y^3/3, and z^2/2 + x z^2 */
static void henon_heiles(int n, const real *q, real *f)
{
    f[0] -= q[0] + 2*q[0]*q[1];
    f[1] -= q[1] + q[0]*q[0] - q[1]*q[1];
    if (n < 3) return;
    f[0] -= q[2]*q[2];
    f[2] -= q[2] + 2*q[0]*q[2];
}

static void kepler(int n, const real *q, real *f)
{
    const real r2 = q[0]*q[0] + q[1]*q[1] + (n > 2 ? q[2]*q[2] : 0), r = (real)sqrtl((long double)r2);
    for (int i = 0; i < n; ++i) f[i] -= q[i]/(r2*r);
}

/* Springs of frequency 1, 10 and 2, nearly */
static void stiff(int n, const real *q, real *f)
{
    static const real k[ROOM] = { 1, 100, 4 };
    for (int i = 0; i < n; ++i) f[i] -= k[i]*q[i] + q[i]*q[i]*q[i];
}

static void nothing(int n, const real *q, real *f) { (void)n, (void)q, (void)f; }

static void weight(int n, const real *q, real *f)
{
    for (int i = 0; i < n; ++i) f[i] -= (real)(2 - i)*(real)sinl((long double)q[i]);
}

static int points_hh(const gvi_points *p, void *user) { return pull(p, user, henon_heiles); }
static int points_stiff(const gvi_points *p, void *user) { return pull(p, user, stiff); }
static int points_nothing(const gvi_points *p, void *user) { return pull(p, user, nothing); }
static int points_kepler(const gvi_points *p, void *user) { return pull(p, user, kepler); }
static int points_links(const gvi_points *p, void *user) { return pull(p, user, weight); }

static int points_drag(const gvi_points *p, void *user)
{
    for (int k = 0; k < p->count; ++k) p->f[k] -= p->v[k]/64;
    return pull(p, user, weight);
}

/* M(q) of two links, in angles from the vertical */
static int points_mass(const gvi_points *p, void *user)
{
    mood *m = user;
    const real *x = p->q, *y = x + p->stride;
    m->masses += (unsigned long long)p->count;
    for (int k = 0; k < p->count; ++k) {
        if (x[k] > m->walls[0]) return 1;
        p->mass[k] = 2;
        p->mass[2*p->stride + k] = x[k] > m->rigid ? 2 : (real)cosl((long double)(x[k] - y[k]));
        p->mass[3*p->stride + k] = x[k] > m->rigid ? 2 : 1;
    }
    return 0;
}

static int points_gradient(const gvi_points *p, void *user)
{
    const real *x = p->q, *y = x + p->stride, *u = p->v, *w = u + p->stride;
    const mood *m = user;
    for (int k = 0; k < p->count; ++k) {
        const real push = (real)sinl((long double)(x[k] - y[k]))*u[k]*w[k];
        if (x[k] > m->walls[1]) return 1;
        p->f[k] -= push;
        p->f[p->stride + k] += push;
    }
    return 0;
}

typedef struct twins {
    gvi_stepper st[2];
    gvi_effect  effect[2];
    mood        mood[2];
} twins;

static gvi_desc described(int n, int degree, real tolerance, const real *mass)
{
    gvi_desc desc = { .n = n, .degree = degree, .tolerance = tolerance };
    if (mass) desc.mass.kind = GVI_MASS_DIAGONAL;
    desc.mass.matrix = mass;
    return desc;
}

static gvi_desc linked(int degree, real tolerance)
{
    gvi_desc desc = described(2, degree, tolerance, NULL);
    desc.mass.kind = GVI_MASS_POSITION;
    desc.mass.points = points_mass;
    desc.mass.gradient = points_gradient;
    return desc;
}

static const real masses[ROOM] = { (real)1.7L, (real)0.3L, (real)0.8L };

static void begin(twins *z, gvi_points_fn *points, gvi_desc desc, real x, real vy)
{
    const real q[ROOM] = { x, (real)0.05L, (real)0.03L }, v[ROOM] = { (real)0.1L, vy, (real)-0.1L };
    memset(z, 0, sizeof *z);
    desc.effect_count = 1;
    for (int i = 0; i < 2; ++i) {
        const gvi_kind kind = points == points_drag ? GVI_FORCE : GVI_POTENTIAL;
        const gvi_effect effect = { .kind = kind, .points = points, .user = z->mood + i };
        desc.mass.user = z->mood + i;
        z->mood[i] = calm;
        z->effect[i] = effect;
        desc.effects = z->effect + i;
        assert_true(gvi_size(&desc) > 0 && gvi_size(&desc) <= sizeof memory[i]);
        assert_ok(gvi_init(z->st + i, &desc, memory[i], sizeof memory[i]));
        assert_ok(gvi_start(z->st + i, 0, q, v));       // its look at the callbacks is not counted
        z->mood[i] = calm;
        z->st[i].counters.mass = 0;
        assert_ok(gvi_start(z->st + i, 0, q, v));
    }
}

/* The whole state, with its compensation, and what the last step was */
static void assert_same(const twins *z)
{
    const gvi_stepper *a = z->st, *b = z->st + 1;
    for (int i = 0; i < a->n; ++i) {
        assert_true(a->q[i] == b->q[i] && a->p[i] == b->p[i]);
        assert_true(a->q_low[i] == b->q_low[i] && a->p_low[i] == b->p_low[i]);
    }
    assert_true(a->t == b->t && a->t_low == b->t_low && a->t0 == b->t0 && a->h == b->h);
    assert_int_equal(a->formulation, b->formulation);
}

static gvi_status both(twins *z, real h)
{
    const gvi_status status = gvi_step(z->st, h);
    assert_int_equal(gvi_step(z->st + 1, h), status);
    assert_same(z);
    return status;
}

/* Questions to the first of them; it goes on from a checkpoint after some steps that are forgotten */
static void disturb(twins *z, int k)
{
    real q[ROOM], v[ROOM], p[ROOM];
    gvi_stepper *st = z->st;
    if (k % 3 == 1) assert_ok(gvi_state_at(st, st->t - st->h/3, q, v, p));
    if (k % 4 == 2) assert_ok(gvi_curve(st, (real)0.3L, q, v));
    if (k % 5 == 3) assert_ok(gvi_velocity(st, v));
    if (k % 11 == 6) {
        const gvi_stepper then = *st;
        memcpy(saved, memory[0], sizeof saved);
        gvi_step(st, then.h);
        gvi_step(st, then.h/2);
        assert_ok(gvi_restore(st, &then, saved));
        assert_same(z);
    }
}

static const real tolerances[] = { 0, (real)1e-4L, 64*EPS };

TEST(questions_and_checkpoints_change_no_bit)
{
    for (int n = 2; n <= 3; ++n)
        for (int degree = 4; degree <= 16; degree *= 2)
            for (int k = 0; k < COUNT(tolerances); ++k)
                for (int heavy = 0; heavy < 2; ++heavy) {
                    twins z;
                    begin(&z, points_hh, described(n, degree, tolerances[k], heavy ? masses : NULL), (real)0.1L, (real)0.2L);
                    for (int i = 0; i < 150; ++i) {
                        assert_ok(both(&z, i % 50 < 40 ? (real)0.4L : (real)0.3L));
                        disturb(&z, i);
                    }
                }
}

TEST(questions_and_checkpoints_change_no_bit_with_a_mass_that_moves)
{
    for (int degree = 4; degree <= 16; degree *= 2)
        for (int k = 0; k < COUNT(tolerances); ++k)
            for (int drags = 0; drags < 2; ++drags) {
                twins z;
                begin(&z, drags ? points_drag : points_links, linked(degree, tolerances[k]), 1, (real)0.3L);
                assert_int_equal(z.st[0].formulation, GVI_MOMENTA);
                for (int i = 0; i < 150; ++i) {
                    assert_ok(both(&z, i % 50 < 40 ? (real)0.2L : (real)0.15L));
                    disturb(&z, i);
                }
            }
}

/* Steps of two periods of the stiffest spring now and then, for which the fixed point does not contract: to Newton's method
   and back, with checkpoints on both sides.  Kepler's ellipse of eccentricity 0.84 is near the limit, and keeps
   its angular momentum to rounding by either. */
TEST(nor_between_newton_and_the_fixed_point)
{
    for (int n = 2; n <= 3; ++n) {
        twins z;
        int turned = 0;
        begin(&z, points_stiff, described(n, 8, 0, NULL), (real)0.1L, (real)0.2L);
        for (int i = 0; i < 300; ++i) {
            if (both(&z, i % 40 < 30 ? (real)0.25L : (real)1.5L) != GVI_OK) assert_ok(both(&z, (real)0.25L));
            disturb(&z, i);
            turned += z.st[0].formulation == GVI_NEWTON;
        }
        assert_between(20, turned, 280);
        begin(&z, points_kepler, described(n, 8, 0, NULL), 1, n == 2 ? (real)0.4L : (real)0.38L);
        const gvi_stepper *st = z.st;
        const long double L = (long double)st->q[0]*st->p[1] - (long double)st->q[1]*st->p[0];
        for (int i = 0; i < 600; ++i) {
            assert_ok(both(&z, (real)0.15L));
            disturb(&z, i);
            assert_close((long double)st->q[0]*st->p[1] - (long double)st->q[1]*st->p[0], L, 200*(long double)EPS);
        }
    }
}

/* The first twin's steps fail now and then, in the midst of their iteration: nothing has moved, the fault is
   named, and what follows is what the other does, who never tried. */
static void failures(gvi_points_fn *points, gvi_desc desc, real x, real h, int how, gvi_status wanted)
{
    twins z;
    int failed = 0;
    begin(&z, points, desc, x, (real)0.3L);
    for (int i = 0; i < 30; ++i) assert_ok(both(&z, h));
    for (int i = 0; i < 100; ++i) {
        mood *m = z.mood;
        real *const which[] = { &m->wall, &m->edge, m->walls, m->walls + 1 };
        *which[how] = (real)-0.2L + (real)(i % 20)/40;
        const gvi_status status = gvi_step(z.st, h);
        *which[how] = far_away;
        if (status != GVI_OK) {
            assert_status(status, wanted);
            assert_int_equal(z.st[0].fault.effect, how < 2 ? 0 : GVI_FAULT_MASS);
            assert_same(&z);
            assert_int_equal(z.st[0].counters.failures, ++failed);
            assert_ok(gvi_step(z.st, h));
        }
        assert_ok(gvi_step(z.st + 1, h));
        assert_same(&z);
    }
    assert_between(4, failed, 99);
}

TEST(steps_that_fail_leave_no_trace)
{
    for (int degree = 4; degree <= 16; degree *= 2) {
        for (int n = 2; n <= 3; ++n) {
            failures(points_hh, described(n, degree, (real)1e-9L, NULL), (real)0.1L, (real)0.7L, 0, GVI_E_CALLBACK);
            failures(points_hh, described(n, degree, (real)1e-9L, NULL), (real)0.1L, (real)0.7L, 1, GVI_E_NON_FINITE);
        }
        failures(points_links, linked(degree, (real)1e-9L), 1, (real)0.2L, 0, GVI_E_CALLBACK);
        failures(points_links, linked(degree, (real)1e-9L), 1, (real)0.2L, 1, GVI_E_NON_FINITE);
        failures(points_links, linked(degree, (real)1e-9L), 1, (real)0.2L, 2, GVI_E_CALLBACK);
        failures(points_links, linked(degree, (real)1e-9L), 1, (real)0.2L, 3, GVI_E_CALLBACK);
    }
}

/* M becomes singular on the way: whatever the step says, it says no, and a way round it goes on as if
   nothing had been. */
TEST(nor_does_a_mass_that_has_no_inverse)
{
    twins z;
    int failed = 0;
    begin(&z, points_links, linked(8, (real)1e-9L), 1, (real)0.3L);
    for (int i = 0; i < 30; ++i) assert_ok(both(&z, (real)0.2L));
    for (int i = 0; i < 100; ++i) {
        z.mood[0].rigid = (real)-0.2L + (real)(i % 20)/40;
        gvi_stepper *st = z.st;
        const gvi_stepper then = *st;
        memcpy(saved, memory[0], sizeof saved);
        failed += gvi_step(st, (real)0.2L) != GVI_OK;
        if (st->status != GVI_OK) assert_same(&z);
        z.mood[0].rigid = far_away;
        assert_ok(gvi_restore(st, &then, saved));
        assert_ok(both(&z, (real)0.2L));
    }
    assert_between(4, failed, 99);
}

/* All points of the tenth step are finite, its end is not, in one of the coordinates. */
TEST(an_end_that_overflows_is_refused_in_each_coordinate)
{
    for (int n = 2; n <= 3; ++n)
        for (int far = 0; far < n; ++far) {
            twins z;
            real q[ROOM] = { 0, 0, 0 }, v[ROOM] = { 1, 1, 1 };
            v[far] = (real)sqrtl((long double)MAX);
            const real h = MAX/v[far]/(real)9.99L;
            begin(&z, points_nothing, described(n, 8, 0, NULL), 1, 1);
            for (int i = 0; i < 2; ++i) {
                z.mood[i].wall = z.mood[i].edge = MAX;
                assert_ok(gvi_start(z.st + i, 0, q, v));
            }
            for (int i = 0; i < 9; ++i) assert_ok(both(&z, h));
            assert_status(both(&z, h), GVI_E_CONVERGENCE);
            assert_close(z.st[0].q[far]/MAX, 9/9.99L, EPS);
        }
}

/* Counted is what was evaluated, also in steps that fail and in queries. */
TEST(the_counters_count_what_is_evaluated)
{
    for (int moving = 0; moving < 2; ++moving) {
        twins z;
        begin(&z, moving ? points_links : points_hh, moving ? linked(8, 0) : described(2, 8, 0, NULL), (real)0.5L, (real)0.2L);
        const gvi_counters *c = &z.st[0].counters;
        for (int i = 0; i < 60; ++i) {
            z.mood[0].wall = i % 10 == 7 ? -100 : far_away;
            assert_status(gvi_step(z.st, (real)0.2L), i % 10 == 7 ? GVI_E_CALLBACK : GVI_OK);
            z.mood[0].wall = far_away;
            if (i > 0 && i % 10 != 7) disturb(&z, i % 11 == 6 ? 0 : i);   // a checkpoint brings back its counters
            assert_true(c->effect[0] == z.mood[0].points && c->mass == z.mood[0].masses);
        }
        assert_int_equal(c->steps, 54);
        assert_int_equal(c->failures, 6);
    }
}

/* ... but not the look at each effect for the cause of a NaN, here at the first, which gives it */
TEST(a_look_for_a_cause_is_not_counted)
{
    mood m[2] = { calm, calm };
    const gvi_effect effects[] = { { .kind = GVI_POTENTIAL, .points = points_hh, .user = m },
                                   { .kind = GVI_POTENTIAL, .points = points_hh, .user = m + 1 } };
    const gvi_desc desc = { .n = 2, .degree = 4, .effects = effects, .effect_count = 2 };
    gvi_stepper st = new_motion(&desc, 0, masses, masses);
    m[0].edge = -100;
    assert_status(gvi_step(&st, (real)0.1L), GVI_E_NON_FINITE);
    assert_true(m[0].points > m[1].points);
    assert_true(st.counters.effect[0] == st.counters.effect[1]);
}

/* Springs and soft quartic ones between them, in units: of force over length, and of 1/length^2 */
static int springs(const gvi_points *x, void *user)
{
    static const real k[ROOM] = { 2, 9, 5 };
    const real *unit = user;
    const int d = x->stride;
    for (int j = 0; j < x->count; ++j)
        for (int i = 0; i < x->n; ++i) {
            const real *q = x->q + j, here = q[i*d];
            const real left = i > 0 ? here - q[(i - 1)*d] : 0, right = i + 1 < x->n ? q[(i + 1)*d] - here : 0;
            x->f[i*d + j] += unit[0]*(unit[1]*(right*right*right - left*left*left) - k[i]*here);
        }
    return 0;
}

/* Powers of two as units of time and length scale the motion to the bit, in every formulation. */
TEST(units_change_no_bit)
{
    static const real nodes[] = { 0, (real)0.375L, (real)0.625L, 1 };
    static const real weights[] = { (real)0.125L, (real)0.375L, (real)0.375L, (real)0.125L };
    static const gvi_desc forms[] = {
        { .degree = 1, .rule.kind = GVI_LOBATTO, .formulation = GVI_EXPLICIT },
        { .degree = 1, .rule = { GVI_KICKS, 4, nodes, weights } },
        { .degree = 3, .formulation = GVI_POSITIONS }, { .degree = 8, .formulation = GVI_POSITIONS },
        { .degree = 5, .formulation = GVI_VELOCITIES }, { .degree = 5, .formulation = GVI_MOMENTA },
        { .degree = 8, .tolerance = (real)1e-5L, .formulation = GVI_POSITIONS },
        { .degree = 4, .formulation = GVI_NEWTON }, { .degree = 6 } };
    const int most = KIND == 1 ? 16 : 100;        // squares of momenta and forces are numbers
    const real q0[ROOM] = { (real)0.5L, (real)-0.25L, (real)0.125L }, v0[ROOM] = { (real)0.25L, (real)0.5L, -1 };
    for (int f = 0; f < COUNT(forms); ++f)
        for (int a = -most; a <= most; a += most/2)
            for (int b = -most; b <= most; b += most/2) {
                const real time = (real)ldexp(1, a), length = (real)ldexp(1, b);
                gvi_stepper st[2];
                for (int k = 0; k < 2; ++k) {
                    real units[2] = { k ? 1/(time*time) : 1, k ? 1/(length*length) : 1 }, q[ROOM], v[ROOM];
                    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = springs, .user = units };
                    gvi_desc desc = forms[f];
                    desc.n = ROOM;
                    desc.effects = &effect;
                    desc.effect_count = 1;
                    for (int i = 0; i < ROOM; ++i) {
                        q[i] = k ? q0[i]*length : q0[i];
                        v[i] = k ? v0[i]*length/time : v0[i];
                    }
                    assert_ok(gvi_init(st + k, &desc, memory[k], sizeof memory[k]));
                    assert_ok(gvi_start(st + k, 0, q, v));
                    for (int i = 0; i < 40; ++i) assert_ok(gvi_step(st + k, (real)(i % 10 < 7 ? 0.125L : 0.1L)*(k ? time : 1)));
                }
                for (int i = 0; i < ROOM; ++i) {
                    assert_true(st[1].q[i] == st[0].q[i]*length);
                    assert_true(st[1].p[i] == st[0].p[i]*length/time);
                }
            }
}

static void slope(int n, const long double *y, long double *dy)
{
    for (int i = 0; i < n; ++i) dy[i] = y[n + i];
    dy[n] = -y[0] - 2*y[0]*y[1];
    dy[n + 1] = -y[1] - y[0]*y[0] + y[1]*y[1];
    if (n < 3) return;
    dy[n] -= y[2]*y[2];
    dy[n + 2] = -y[2] - 2*y[0]*y[2];
}

/* A reference that shares nothing with gvi.h */
static void runge_kutta(int n, long double h, int parts, long double *y)
{
    static const long double at[4] = { 0, 0.5L, 0.5L, 1 }, share[4] = { 1, 2, 2, 1 };
    while (parts-- > 0) {
        long double k[2*ROOM] = { 0 }, sum[2*ROOM] = { 0 };
        for (int s = 0; s < 4; ++s) {
            long double w[2*ROOM];
            for (int j = 0; j < 2*n; ++j) w[j] = y[j] + h*at[s]*k[j];
            slope(n, w, k);
            for (int j = 0; j < 2*n; ++j) sum[j] += share[s]*k[j];
        }
        for (int j = 0; j < 2*n; ++j) y[j] += h/6*sum[j];
    }
}

/* Steps of one length, and of lengths in turn up to six times the last and back */
TEST(steps_are_right_whatever_their_lengths)
{
    static const real lengths[][8] = { { (real)0.25L, (real)0.25L, (real)0.25L, (real)0.25L, (real)0.25L, (real)0.25L, (real)0.25L, (real)0.25L },
                                       { (real)0.25L, (real)0.25L, (real)0.125L, (real)0.75L, (real)0.5L, (real)0.25L, (real)-0.25L, (real)0.5L } };
    static const gvi_formulation pins[] = { GVI_AUTO, GVI_POSITIONS, GVI_VELOCITIES, GVI_MOMENTA };
    for (int n = 2; n <= 3; ++n)
        for (int f = 0; f < COUNT(pins); ++f)
            for (int k = 0; k < COUNT(lengths); ++k) {
                twins z;
                gvi_desc desc = described(n, 8, 0, NULL);
                desc.formulation = pins[f];
                begin(&z, points_hh, desc, (real)0.1L, (real)0.3L);
                long double y[2*ROOM];
                for (int i = 0; i < n; ++i) y[i] = (long double)z.st[0].q[i], y[n + i] = (long double)z.st[0].p[i];
                for (int i = 0; i < 40; ++i) {
                    const real h = lengths[k][i % 8];
                    assert_ok(both(&z, h));
                    runge_kutta(n, (long double)h/2500, 2500, y);
                }
                for (int i = 0; i < n; ++i) {
                    assert_close(z.st[0].q[i], y[i], 8*EPS + (k ? 4e-14L : 1e-15L));
                    assert_close(z.st[0].p[i], y[n + i], 8*EPS + (k ? 4e-14L : 1e-15L));
                }
            }
}

/* In steps of 3.3, half a period, what extrapolates the last step misses by a thousand times the motion: the
   iteration starts again from free motion and ends where it must.  No step fails. */
TEST(very_long_steps_get_over_a_bad_guess)
{
    static const gvi_formulation pins[] = { GVI_POSITIONS, GVI_MOMENTA, GVI_AUTO };
    if (KIND == 1) skip();
    for (int f = 0; f < COUNT(pins); ++f) {
        twins z;
        gvi_desc desc = described(2, 16, 0, NULL);
        desc.formulation = pins[f];
        begin(&z, points_hh, desc, 0, 0);
        const real q[2] = { 0, (real)0.1L }, v[2] = { (real)0.5L, 0 };
        long double y[4] = { q[0], q[1], v[0], v[1] };
        for (int i = 0; i < 2; ++i) assert_ok(gvi_start(z.st + i, 0, q, v));
        for (int k = 0; k < 40; ++k) {
            assert_ok(both(&z, (real)3.3L));
            runge_kutta(2, (long double)(real)3.3L/2000, 2000, y);
            for (int i = 0; i < 2; ++i) assert_close(z.st[0].q[i], y[i], 1e-10L);
        }
        assert_int_equal(z.st[0].counters.failures, 0);
    }
}

/* A pendulum that swings to 1 and refuses |q| > 2.5, in steps of 2: of extrapolated values most are refused,
   of the motion none. */
static int narrow(const gvi_points *p, void *user)
{
    for (int k = 0; k < p->count; ++k) {
        if (!(fabsl((long double)p->q[k]) < 2.5L)) return ++*(int *)user;
        p->f[k] -= (real)sinl((long double)p->q[k]);
    }
    return 0;
}

TEST(a_guess_that_a_callback_refuses_is_given_up)
{
    int refused = 0;
    const gvi_effect pendulum = { .kind = GVI_POTENTIAL, .points = narrow, .user = &refused };
    const gvi_desc desc = { .n = 1, .degree = 6, .effects = &pendulum, .effect_count = 1,
                            .formulation = GVI_POSITIONS };
    const real q = 1, v = 0;
    gvi_stepper st = new_motion(&desc, 0, &q, &v);
    for (int k = 0; k < 1000; ++k) {
        assert_ok(gvi_step(&st, 2));
        assert_close((long double)st.p[0]*st.p[0]/2 - cosl((long double)st.q[0]), -cosl(1), 4e-6L + 64*EPS);
    }
}

RUN_TESTS(NULL, NULL)
