/* Steps of two and three coordinates, and of M(q) with two, in one piece against the same steps by the general functions: bits, counters,
   faults and refusals are to be the same.                                      */
#ifndef GVI_REAL
#define GVI_REAL double
#endif
#include "gvi_test.h"

typedef gvi_real real;
enum { MOST = 12000 };
static real memory[2][MOST], saved[MOST];

/* what a force does beside pulling */
typedef struct mood {
    real wall;                  /* refuses beyond x = wall */
    real edge;                  /* is NaN beyond x = edge */
    real walls[2];              /* M and its gradient refuse beyond */
    real rigid;                 /* M(q) is singular beyond */
    unsigned long long asked, masses;   /* points, since the start */
} mood;

static int pull(const gvi_points *p, mood *m, void (*law)(int n, const real *q, real *f))
{
    const real *x = p->q;
    m->asked += (unsigned long long)p->count;
    for (int k = 0; k < p->count; ++k) if (x[k] > m->wall) return 1;
    for (int k = 0; k < p->count; ++k) {
        real q[3], f[3];
        for (int i = 0; i < p->n; ++i) q[i] = x[i*p->stride + k];
        for (int i = 0; i < p->n; ++i) f[i] = p->f[i*p->stride + k];
        law(p->n, q, f);
        for (int i = 0; i < p->n; ++i) p->f[i*p->stride + k] = f[i];
        if (x[k] > m->edge) p->f[k] = (real)NAN;
    }
    return 0;
}

// V = (x^2 + y^2)/2 + x^2 y - y^3/3, and z^2/2 + x z^2
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

static void nothing(int n, const real *q, real *f) { (void)n, (void)q, (void)f; }

static int points_hh(const gvi_points *p, void *user) { return pull(p, user, henon_heiles); }
static int points_nothing(const gvi_points *p, void *user) { return pull(p, user, nothing); }
static int points_kepler(const gvi_points *p, void *user) { return pull(p, user, kepler); }

/* M(q) of two links, in angles from the vertical; their weight; and friction in the joints beside it */
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

static void weight(int n, const real *q, real *f)
{
    for (int i = 0; i < n; ++i) f[i] -= (real)(2 - i)*(real)sinl((long double)q[i]);
}

static int points_links(const gvi_points *p, void *user) { return pull(p, user, weight); }

static int points_drag(const gvi_points *p, void *user)
{
    for (int k = 0; k < p->count; ++k) p->f[k] -= p->v[k]/64;
    return pull(p, user, weight);
}

static int points_velocity(const gvi_points *p, void *user)
{
    const real *x = p->q, *y = x + p->stride, *a = p->p, *b = a + p->stride;
    for (int k = 0; k < p->count; ++k) {
        const real c = (real)cosl((long double)(x[k] - y[k])), over = 1/(2 - c*c);
        p->velocity[k] = (a[k] - c*b[k])*over;
        p->velocity[p->stride + k] = (2*b[k] - c*a[k])*over;
    }
    return (void)user, 0;
}

/* two steppers of one scene; the second is kept from steps in one piece */
typedef struct pair {
    gvi_stepper st[2];
    gvi_effect  effect[2];
    mood        mood[2];
    int         whole;          /* steps in one piece */
} pair;

static void begin(pair *z, gvi_points_fn *points, gvi_desc desc, real x, real vy)
{
    const real q[3] = { x, (real)0.05L, (real)0.03L }, v[3] = { (real)0.1L, vy, (real)-0.1L };
    memset(z, 0, sizeof *z);
    desc.effect_count = 1;
    for (int i = 0; i < 2; ++i) {
        const mood calm = { (real)1e9L, (real)1e9L, { (real)1e9L, (real)1e9L }, (real)1e9L, 0, 0 };
        const gvi_kind kind = points == points_drag ? GVI_FORCE : GVI_POTENTIAL;
        const gvi_effect effect = { .kind = kind, .points = points, .user = z->mood + i };
        desc.mass.user = z->mood + i;
        z->mood[i] = calm;
        z->effect[i] = effect;
        desc.effects = z->effect + i;
        assert_true(gvi_size(&desc) > 0 && gvi_size(&desc) <= sizeof memory[i]);
        assert_ok(gvi_init(z->st + i, &desc, memory[i], sizeof memory[i]));
        assert_ok(gvi_start(z->st + i, 0, q, v));
    }
}

/* all that a user can see, and the rests */
static void assert_same(const pair *z)
{
    const gvi_stepper *a = z->st, *b = z->st + 1;
    const gvi_counters *c = &a->counters, *d = &b->counters;
    for (int i = 0; i < a->n; ++i) {
        assert_true(a->q[i] == b->q[i] && a->p[i] == b->p[i]);
        assert_true(a->x.qe[i] == b->x.qe[i] && a->x.pe[i] == b->x.pe[i]);
        assert_true(a->x.q0[i] == b->x.q0[i] && a->x.p0[i] == b->x.p0[i]);
    }
    assert_true(a->t == b->t && a->h == b->h && a->x.t0 == b->x.t0 && a->x.te == b->x.te);
    assert_int_equal(a->status, b->status);
    assert_int_equal(a->formulation, b->formulation);
    assert_int_equal(a->iterations, b->iterations);
    assert_int_equal(a->fault.effect, b->fault.effect);
    assert_int_equal(a->fault.coordinate, b->fault.coordinate);
    assert_int_equal(a->fault.point, b->fault.point);
    assert_true(c->steps == d->steps && c->failures == d->failures && c->iterations == d->iterations);
    assert_true(c->newton_iterations == d->newton_iterations);
    assert_true(c->effect[0] == z->mood[0].asked && d->effect[0] == z->mood[1].asked);
    assert_true(c->velocities == d->velocities && c->factorizations == d->factorizations);
    assert_true(c->most_iterations == d->most_iterations);
    assert_true(c->worst_contraction == d->worst_contraction);
    assert_true(c->worst_change == d->worst_change);
}

/* a step of each, of one outcome */
static gvi_status both(pair *z, real h)
{
    z->whole += z->st[0].x.usual != 0;
    z->st[1].x.usual = 0;
    const gvi_status status = gvi_step(z->st, h);
    assert_int_equal(gvi_step(z->st + 1, h), status);
    assert_same(z);
    return status;
}

/* were at least so many of the steps made in one piece? */
static void assert_whole(const pair *z, int least) { if (GVI__PIECES) assert_true(z->whole >= least); }

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

static const real masses[3] = { (real)1.7L, (real)0.3L, (real)0.8L };

/* Every size, tolerance and mass of these steps, short ones and as long as the iteration allows.  */
static void same_bits(void **state)
{
    static const real tolerances[] = { 0, (real)1e-4L, 64*EPS };
    const int n = *(int *)*state;
    for (int degree = 8; degree <= 16; degree += 8)
        for (int k = 0; k < COUNT(tolerances); ++k)
            for (int heavy = 0; heavy < 2; ++heavy)
                for (int scene = 0; scene < 2 - heavy; ++scene) {      // Kepler's with two masses is chaos
                    pair z;
                    const real h = scene ? (real)0.15L : heavy ? (real)0.6L : (real)1.6L;
                    begin(&z, scene ? points_kepler : points_hh,
                          described(n, degree, tolerances[k], heavy ? masses : NULL),
                          scene ? (real)1 : (real)0.1L, scene ? (real)0.8L : (real)0.2L);
                    for (int i = 0; i < 300; ++i) assert_ok(both(&z, h));
                    assert_whole(&z, 150);
                }
}

/* Near the pericentre the iteration takes too long: to Newton's method and back; pinned and with fewer
   iterations than it takes, failed, and past it by shorter steps.              */
static void same_where_it_creeps(void **state)
{
    const int n = *(int *)*state;
    for (int pinned = 0; pinned < 2; ++pinned) {
        pair z;
        gvi_desc desc = described(n, 8, 0, NULL);
        int turned = 0, failed = 0;
        desc.formulation = pinned ? GVI_POSITIONS : GVI_AUTO;
        desc.max_iterations = !pinned ? 0 : GVI__KIND == 1 ? 7 : 9;
        begin(&z, points_kepler, desc, 1, n == 2 ? (real)0.4L : (real)0.38L);
        for (int i = 0; i < 600; ++i) {
            const gvi_status status = both(&z, (real)0.15L);
            turned += z.st[0].formulation == GVI_NEWTON;
            failed += status == GVI_E_CONVERGENCE;
            if (status != GVI_OK) both(&z, (real)0.02L);
        }
        assert_whole(&z, 150);
        if (GVI__PIECES) assert_true(pinned ? failed > 5 : turned > 5);
    }
}

/* A step that is refused in its midst, or meets NaN, says so as any other, and nothing moves.  */
static void same_where_it_fails(void **state)
{
    const int n = *(int *)*state;
    for (int nan = 0; nan < 2; ++nan) {
        pair z;
        int failures = 0;
        begin(&z, points_hh, described(n, 8, (real)1e-9L, NULL), (real)0.1L, (real)0.3L);
        for (int i = 0; i < 30; ++i) assert_ok(both(&z, (real)1.2L));
        for (int i = 0; i < 100; ++i) {
            for (int k = 0; k < 2; ++k) *(nan ? &z.mood[k].edge : &z.mood[k].wall) = (real)-0.2L + (real)i/200;
            const gvi_status status = both(&z, (real)1.2L);
            if (status == GVI_OK) continue;
            assert_int_equal(status, nan ? GVI_E_NON_FINITE : GVI_E_CALLBACK);
            assert_int_equal(z.st[0].fault.effect, 0);
            failures += 1;
            for (int k = 0; k < 2; ++k) z.mood[k].edge = z.mood[k].wall = (real)1e9L;
            assert_ok(both(&z, (real)1.2L));
        }
        assert_true(failures > 5);
        assert_whole(&z, 50);
    }
}

/* All points of the tenth step are finite, its end is not, in one of the coordinates.  */
static void same_where_it_overflows(void **state)
{
    const int n = *(int *)*state;
    for (int far = 0; far < n; ++far) {
        pair z;
        real q[3] = { 0, 0, 0 }, v[3] = { 1, 1, 1 };
        v[far] = (real)sqrtl((long double)MAX);
        const real h = MAX/v[far]/(real)9.99L;
        begin(&z, points_nothing, described(n, 8, 0, NULL), 1, 1);
        for (int i = 0; i < 2; ++i) {
            z.mood[i].wall = z.mood[i].edge = MAX;
            assert_ok(gvi_start(z.st + i, 0, q, v));
        }
        for (int i = 0; i < 9; ++i) assert_ok(both(&z, h));
        assert_status(both(&z, h), GVI_E_CONVERGENCE);
        assert_close(z.st[0].q[far]/MAX, 9/9.99L, 1e-6L);
        assert_whole(&z, 6);
    }
}

/* Refused whatever the step tries: its end, and nothing has moved.  */
static void a_refusal_ends_it(void **state)
{
    const int n = *(int *)*state;
    pair z;
    begin(&z, points_hh, described(n, 8, 0, NULL), (real)0.1L, (real)0.3L);
    for (int i = 0; i < 30; ++i) assert_ok(both(&z, (real)1.2L));
    const gvi_stepper *st = z.st;
    const real x = st->q[0];
    const unsigned long long asked = st->counters.effect[0];
    z.mood[0].wall = z.mood[1].wall = -100;
    assert_status(both(&z, (real)1.2L), GVI_E_CALLBACK);
    assert_true(st->q[0] == x && st->counters.effect[0] > asked);
    assert_int_equal(st->counters.failures, 1);
}

/* Queries, a checkpoint, a switch and other lengths in between: what the next step relies on is still there.  */
static void same_with_queries_between(void **state)
{
    const int n = *(int *)*state;
    for (int degree = 8; degree <= 16; degree += 8) {
        pair z;
        real q[3], v[3], p[3], u[3];
        begin(&z, points_hh, described(n, degree, (real)1e-6L, masses), (real)0.1L, (real)0.2L);
        for (int i = 0; i < 400; ++i) {
            const real h = i % 50 < 40 ? (real)0.4L : (real)0.3L;
            assert_ok(both(&z, h));
            gvi_stepper *st = z.st;
            if (i % 7 == 3) {
                assert_ok(gvi_state_at(st, st->t - h/3, q, v, p));
                assert_ok(gvi_state_at(st + 1, st->t - h/3, u, v, NULL));
                for (int k = 0; k < n; ++k) assert_true(q[k] == u[k]);
            }
            if (i % 7 == 4) {
                assert_ok(gvi_curve(st, (real)0.3L, q, v));
                assert_ok(gvi_curve(st + 1, (real)0.3L, u, NULL));
                for (int k = 0; k < n; ++k) assert_true(q[k] == u[k]);
            }
            for (int k = 0; k < 2 && i % 13 > 10; ++k) assert_ok(gvi_switch(st + k, 0, i % 13 == 12));
            if (i % 11 == 6) {
                const gvi_stepper then = *st;
                memcpy(saved, memory[0], sizeof saved);
                assert_ok(gvi_step(st, h));
                assert_ok(gvi_step(st, h/2));
                assert_ok(gvi_restore(st, &then, saved));
                z.mood[0].asked = st->counters.effect[0];
            }
        }
        assert_whole(&z, 150);
    }
}

/* M(q), alone and with a force that reads velocities; queries in between.  M is asked as often as counted.  */
static void momenta_same_bits(void **state)
{
    static const real tolerances[] = { 0, (real)1e-4L, 64*EPS };
    (void)state;
    for (int degree = 8; degree <= 16; degree += 8)
        for (int k = 0; k < COUNT(tolerances); ++k)
            for (int drags = 0; drags < 2; ++drags) {
                pair z;
                real q[2], v[2], u[2];
                begin(&z, drags ? points_drag : points_links, linked(degree, tolerances[k]), 1, (real)0.3L);
                assert_int_equal(z.st[0].formulation, GVI_MOMENTA);
                for (int i = 0; i < 300; ++i) {
                    const real h = i % 50 < 40 ? (real)0.2L : (real)0.15L;
                    for (int j = 0; j < 2; ++j) {
                        z.mood[j].asked = z.st[j].counters.effect[0];         // queries ask as well
                        z.mood[j].masses = z.st[j].counters.mass;
                    }
                    assert_ok(both(&z, h));
                    for (int j = 0; j < 2; ++j) assert_true(z.st[j].counters.mass == z.mood[j].masses);
                    if (i % 7 == 3) {
                        assert_ok(gvi_state_at(z.st, z.st[0].t - h/3, q, v, NULL));
                        assert_ok(gvi_state_at(z.st + 1, z.st[1].t - h/3, u, v, NULL));
                        assert_true(q[0] == u[0] && q[1] == u[1]);
                    }
                }
                assert_whole(&z, 150);
            }
}

/* Velocities given, or a number of iterations: not for these steps.  */
static void momenta_not_in_one_piece(void **state)
{
    (void)state;
    for (int given = 0; given < 2; ++given) {
        pair z;
        gvi_desc desc = linked(8, 0);
        if (given) desc.iterations = 9;
        else desc.mass.velocity = points_velocity;
        begin(&z, points_links, desc, 1, (real)0.3L);
        for (int i = 0; i < 40; ++i) assert_ok(both(&z, (real)0.05L));
        assert_int_equal(z.whole, 0);
    }
}

/* Refused by the effect, by M or by its gradient; NaN; M singular: as any other step, and nothing moves.  */
static void momenta_same_where_it_fails(void **state)
{
    (void)state;
    for (int how = 0; how < 5; ++how) {
        static const gvi_status ends[] = { GVI_E_CALLBACK, GVI_E_CALLBACK, GVI_E_CALLBACK, GVI_E_NON_FINITE };
        pair z;
        int failures = 0;
        begin(&z, points_links, linked(8, (real)1e-9L), 1, (real)0.3L);
        for (int i = 0; i < 30; ++i) assert_ok(both(&z, (real)0.2L));
        for (int i = 0; i < 100; ++i) {
            const real at = (real)0.2L + (real)(i % 20)/40;
            for (int k = 0; k < 2; ++k) {
                mood *m = z.mood + k;
                real *const which[] = { &m->wall, m->walls, m->walls + 1, &m->edge, &m->rigid };
                *which[how] = at;
            }
            const gvi_status status = both(&z, (real)0.2L);
            if (status == GVI_OK) continue;
            if (how < 4) assert_int_equal(status, ends[how]);         // singular at some points, the iteration may lose its way first
            if (how < 4) assert_int_equal(z.st[0].fault.effect, how == 0 || how == 3 ? 0 : GVI_FAULT_MASS);
            failures += 1;
            for (int k = 0; k < 2; ++k)
                z.mood[k].wall = z.mood[k].walls[0] = z.mood[k].walls[1] = z.mood[k].edge = z.mood[k].rigid = (real)1e9L;
            const gvi_status after = both(&z, (real)0.2L);
            if (how < 4) assert_ok(after);                        // near such an M velocities have become anything
        }
        assert_true(failures > 3);
        assert_whole(&z, 40);
    }
}

/* Steps that are too long for the iteration: to Newton's method and back, or failed.  */
static void momenta_same_where_it_creeps(void **state)
{
    (void)state;
    for (int pinned = 0; pinned < 2; ++pinned) {
        pair z;
        gvi_desc desc = linked(8, 0);
        int turned = 0, failed = 0;
        desc.formulation = pinned ? GVI_MOMENTA : GVI_AUTO;
        desc.max_iterations = pinned ? GVI__KIND == 1 ? 7 : 13 : 0;
        begin(&z, points_links, desc, 2, (real)2);
        for (int i = 0; i < 300; ++i) {
            const gvi_status status = both(&z, pinned ? (real)0.2L : i % 60 < 45 ? (real)0.2L : (real)0.7L);
            turned += z.st[0].formulation == GVI_NEWTON;
            failed += status != GVI_OK;
            if (status != GVI_OK) both(&z, (real)0.05L);
        }
        assert_whole(&z, 60);
        if (GVI__PIECES) assert_true(pinned ? failed > 5 : turned > 5);
    }
}

static int point_hh(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    henon_heiles(*(int *)user, q, f);
    return (void)t, (void)v, (void)dldv, 0;
}

/* A checkpoint goes on in a stepper whose effect takes one point a call.  */
static void restored_to_another_callback(void **state)
{
    static real third[MOST];
    int n = *(int *)*state;
    pair z;
    gvi_stepper other;
    const gvi_effect single = { .kind = GVI_POTENTIAL, .point = point_hh, .user = &n };
    gvi_desc desc = described(n, 8, 0, NULL);
    begin(&z, points_hh, desc, (real)0.1L, (real)0.3L);
    for (int i = 0; i < 10; ++i) assert_ok(both(&z, (real)0.5L));
    desc.effects = &single;
    desc.effect_count = 1;
    assert_ok(gvi_init(&other, &desc, third, sizeof third));
    assert_ok(gvi_restore(&other, z.st, memory[0]));
    for (int i = 0; i < 10; ++i) {
        assert_ok(both(&z, (real)0.5L));
        assert_ok(gvi_step(&other, (real)0.5L));
    }
    assert_whole(&z, 15);
    for (int i = 0; i < n; ++i) assert_close(other.q[i], z.st[0].q[i], 64*(long double)EPS);
}

/* A reference without gvi.h's sums: RK4 in long double, a hundred thousand steps.  */
static void right_as_well(void **state)
{
    enum { STEPS = 40, PARTS = 100000 };
    const int n = *(int *)*state;
    pair z;
    begin(&z, points_hh, described(n, 8, 0, NULL), (real)0.1L, (real)0.3L);
    long double y[6];
    for (int i = 0; i < n; ++i) {
        y[i] = (long double)z.st[0].q[i];
        y[n + i] = (long double)z.st[0].p[i];
    }
    const real h = (real)0.25L;
    for (int i = 0; i < STEPS; ++i) assert_ok(both(&z, h));
    assert_whole(&z, 30);
    for (int i = 0; i < PARTS; ++i) {
        const long double part = STEPS*(long double)h/PARTS, share[4] = { 1, 2, 2, 1 }, at[4] = { 0, 0.5L, 0.5L, 1 };
        long double k[6] = { 0 }, sum[6] = { 0 };
        for (int stage = 0; stage < 4; ++stage) {
            long double w[6], *f = k + n;
            for (int j = 0; j < 2*n; ++j) w[j] = y[j] + part*at[stage]*k[j];
            for (int j = 0; j < n; ++j) k[j] = w[n + j];
            f[0] = -w[0] - 2*w[0]*w[1];
            f[1] = -w[1] - w[0]*w[0] + w[1]*w[1];
            if (n > 2) {
                f[0] -= w[2]*w[2];
                f[2] = -w[2] - 2*w[0]*w[2];
            }
            for (int j = 0; j < 2*n; ++j) sum[j] += share[stage]*k[j];
        }
        for (int j = 0; j < 2*n; ++j) y[j] += part/6*sum[j];
    }
    for (int i = 0; i < n; ++i) {
        assert_close(z.st[0].q[i], y[i], 20*(long double)EPS + 1e-14L);
        assert_close(z.st[0].p[i], y[n + i], 20*(long double)EPS + 1e-14L);
    }
}

/* After Newton's steps: what the last step was is said of each.  Sixteen points, in float eight: E is the same
   for both then.                                                               */
static void momenta_after_newton(void **state)
{
    (void)state;
    pair z;
    gvi_desc desc = linked(GVI__KIND == 1 ? 8 : 16, 0);
    int turned = 0;
    desc.max_iterations = GVI__KIND == 1 ? 5 : 7;
    begin(&z, points_links, desc, 1, (real)0.3L);
    for (int i = 0; i < 300; ++i) {
        both(&z, GVI__KIND == 1 ? (real)0.1L : (real)0.05L);
        turned += z.st[0].formulation == GVI_NEWTON;
    }
    assert_whole(&z, 20);
    if (GVI__PIECES) assert_true(turned > 20 && turned < 290);
}

#define WITH_TWO_AND_THREE(test) { #test ", two", test, NULL, NULL, &two }, { #test ", three", test, NULL, NULL, &three }

int main(void)
{
    static int two = 2, three = 3;
    const struct CMUnitTest tests[] = {
        WITH_TWO_AND_THREE(same_bits),
        WITH_TWO_AND_THREE(same_where_it_creeps),
        WITH_TWO_AND_THREE(same_where_it_fails),
        WITH_TWO_AND_THREE(same_where_it_overflows),
        WITH_TWO_AND_THREE(a_refusal_ends_it),
        WITH_TWO_AND_THREE(same_with_queries_between),
        WITH_TWO_AND_THREE(restored_to_another_callback),
        WITH_TWO_AND_THREE(right_as_well),
        cmocka_unit_test(momenta_same_bits),
        cmocka_unit_test(momenta_not_in_one_piece),
        cmocka_unit_test(momenta_same_where_it_fails),
        cmocka_unit_test(momenta_same_where_it_creeps),
        cmocka_unit_test(momenta_after_newton),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
