/* Newton's method with constraints, and gvi_project: orders on both sides in every type, against reduced motions in
   angles, closed forms, and what defines the nearest point; none of it computed by gvi.h. */
#define OWN_REAL
#include "gvi_test.h"
typedef long double real;
#define EXTRAPOLATE_MOST 4
#include "hard/extrapolate.h"

static gvi_status start(gvi_stepper *st, const gvi_desc *desc, const gvi_real *q, const gvi_real *v)
{
    *st = new_stepper(desc);
    return gvi_start(st, 0, q, v);
}

AT_POINTS(circle)                                 // |q| = 1 in the plane; with a user on the line y = x as well
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real X = x->q[k], Y = x->q[R + k];
        x->g[k] = user ? X - Y : (X*X + Y*Y - 1)/2;
        x->jacobian[k] = user ? 1 : X;
        x->jacobian[R + k] = user ? -1 : Y;
    }
    return 0;
}

AT_POINTS(weight)                                 // V = y
{
    for (int k = 0; k < x->count; ++k) {
        if (x->f) x->f[x->stride + k] -= 1;
        if (x->value) x->value[k] += x->q[x->stride + k];
    }
    return 0;
}

AT_POINTS(spring)                                 // V = omega^2 q^2/2
{
    const gvi_real k = *(const gvi_real *)user**(const gvi_real *)user;
    FOR_EACH(x, a) {
        if (x->f) x->f[a] -= k*x->q[a];
        if (x->value) x->value[a % x->stride] += k*x->q[a]*x->q[a]/2;
    }
    return 0;
}

AT_POINTS(quartic)                                // L = a v^4/4
{
    const int R = x->stride;
    const gvi_real a = *(const gvi_real *)user;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real v2 = x->v[k]*x->v[k] + x->v[R + k]*x->v[R + k];
        if (x->value) x->value[k] += a*v2*v2/4;
        for (int i = 0; x->dldv && i < 2; ++i) x->dldv[i*R + k] += a*v2*x->v[i*R + k];
    }
    return 0;
}

AT_POINTS(relativistic)                           // L = -sqrt(1 - v^2)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real v2 = x->v[k]*x->v[k] + x->v[R + k]*x->v[R + k];
        if (!(v2 < 1)) return 1;
        if (x->value) x->value[k] -= sqrt(1 - v2);
        for (int i = 0; x->dldv && i < 2; ++i) x->dldv[i*R + k] += x->v[i*R + k]/sqrt(1 - v2);
    }
    return 0;
}

AT_POINTS(slower_than_light)                      // v from p
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < 2; ++i)
            x->velocity[i*R + k] = x->p[i*R + k]/sqrt(1 + x->p[k]*x->p[k] + x->p[R + k]*x->p[R + k]);
    return 0;
}

AT_POINTS(constant_force)
{
    FOR_EACH(x, a) if (x->f) x->f[a] += ((const gvi_real *)user)[a/x->stride];
    return 0;
}

AT_POINTS(quartics)                               // L = sum v^4/4
{
    FOR_EACH(x, a) {
        const gvi_real v = x->v[a];
        if (x->value) x->value[a % x->stride] += v*v*v*v/4;
        if (x->dldv) x->dldv[a] += v*v*v;
    }
    return 0;
}

/* p = v + v^3, so p is along the line as v is.  The push across it takes p off: by as much as makes inertia there half as
   large again, twice, and more */
TEST(a_step_ends_along_the_line_to_rounding_however_much_inertia_changes)
{
    const gvi_real slow = (gvi_real)0.125L;
    int steps = 0;
    for (gvi_real f = 1; f < 6; f *= (gvi_real)1.03L) {
        gvi_real push[2] = { f, -f };
        const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = constant_force, .user = push },
                                     { .kind = GVI_LAGRANGIAN, .points = quartics, .value = quartics },
                                     { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1, .user = push } };
        const gvi_desc desc = { .n = 2, .degree = 2, .effects = scene, .effect_count = 3 };
        const gvi_real q[2] = { 1, 1 }, v[2] = { slow, slow };
        gvi_stepper st;
        assert_ok(start(&st, &desc, q, v));
        if (gvi_step(&st, 1) != GVI_OK) continue;
        ++steps;
        assert_close(st.p[0], st.p[1], 16*EPS*f);
    }
    assert_true(steps > 10);
}

/* stiff springs: constrained to a line, the step is Gauss's for one oscillator, whose map is the diagonal Pade
   approximation of e^(i z), z = h omega, of modulus 1 and argument 2 arg P(i z), P of degree s                 ---- */

static real pade_argument(int s, real z)
{
    real c = 1, part[4] = { 0, 0, 0, 0 }, power = 1;
    for (int j = 0; j <= s; ++j) {
        part[j % 4] += c*power;
        power *= z;
        c *= (real)(s - j)/((real)(2*s - j)*(real)(j + 1));
    }
    return 2*atan2(part[1] - part[3], part[0] - part[2]);
}

TEST(stiff_springs_on_a_line_turn_as_pades_fraction)
{
    static const int degrees[] = { 1, 2, 4, 8 };
    for (int d = 0; d < COUNT(degrees); ++d)
        for (real z = 0.5L; z < 2e4L; z *= 3) {
            gvi_real omega = 16*(gvi_real)z;
            const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring, .value = spring, .user = &omega },
                                         { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1, .user = &omega } };
            const gvi_desc desc = { .n = 2, .degree = degrees[d], .effects = scene, .effect_count = 2 };
            const gvi_real q[2] = { 1, 1 }, v[2] = { 0, 0 };
            gvi_stepper st;
            assert_ok(start(&st, &desc, q, v));
            for (int k = 1; k <= 20; ++k) {
                assert_ok(gvi_step(&st, (gvi_real)0.0625L));
                const real wanted = cos((real)k*pade_argument(degrees[d], omega/16));
                for (int i = 0; i < 2; ++i) assert_close(st.q[i], wanted, 60*(real)k*EPS*(1 + z/16));
            }
            if (z > 20) assert_int_equal(st.formulation, GVI_NEWTON);
        }
}

typedef struct bead { gvi_real a; int relativistic, own; } bead;

static void bead_rates(real t, const real *y, real *dy, void *user)
{
    const bead *b = user;
    const real w = y[1], m = b->relativistic ? pow(1 - w*w, -1.5L) : 1 + 3*(real)b->a*w*w;
    (void)t;
    dy[0] = w;
    dy[1] = -sin(y[0])/m;
}

static real bead_error(const bead *b, int s, gvi_formulation f, int steps, const real *end)
{
    gvi_real a = b->a;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
        { .kind = GVI_LAGRANGIAN, .points = b->relativistic ? relativistic : quartic,
          .value = b->relativistic ? relativistic : quartic, .user = &a },
        { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1 } };
    const gvi_desc desc = { .n = 2, .degree = s, .effects = scene, .effect_count = 3, .formulation = f,
        .mass = { .kind = b->relativistic ? GVI_MASS_NONE : GVI_MASS_UNIT, .velocity = b->own ? slower_than_light : NULL } };
    const gvi_real q[2] = { 1, 0 }, v[2] = { 0, (gvi_real)0.6L };
    gvi_stepper st;
    gvi_real w[2];
    assert_ok(start(&st, &desc, q, v));
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(&st, 2/(gvi_real)steps));
    assert_ok(gvi_velocity(&st, w));
    assert_close(st.q[0]*st.q[0] + st.q[1]*st.q[1], 1, 8*EPS);
    assert_close(st.q[0]*w[0] + st.q[1]*w[1], 0, 16*EPS);
    const real miss = hypot(st.q[0] - sin(end[0]), st.q[1] + cos(end[0]));
    return miss + fabs(w[0]*cos(end[0]) + w[1]*sin(end[0]) - end[1]);
}

TEST(a_mass_that_depends_on_velocity_costs_no_order)
{
    static const bead beads[] = { { (gvi_real)0.1L, 0, 0 }, { 1, 0, 0 }, { 30, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 } };
    static const int steps[] = { 0, KIND == 1 ? 10 : 40, KIND == 1 ? 4 : 12, 8 };
    for (int k = 0; k < COUNT(beads); ++k) {
        bead b = beads[k];
        const motion exact = { 2, bead_rates, &b };
        real end[2] = { acos(-1.0L)/2, 0.6L };
        flow(&exact, 0, 2, 0.05L, end);
        for (int s = 1; s <= (KIND == 1 ? 2 : 3); ++s)
            for (int f = 0; f < 2; ++f) {
                const gvi_formulation use = f ? GVI_NEWTON : GVI_AUTO;
                const int N = s == 3 && k == 1 ? 16 : steps[s];
                const real first = bead_error(&b, s, use, N, end), second = bead_error(&b, s, use, 2*N, end);
                assert_between(2*s - 0.25L, log2(first/second), 2*s + 0.45L);
            }
        assert_between(0, bead_error(&b, KIND == 3 ? 10 : 8, GVI_AUTO, 20, end), 40*EPS);
    }
}

typedef struct rods { int n, from[4], to[4]; gvi_real length2[4]; } rods;

AT_POINTS(rods_hold)                              // in the plane; from < 0: the fixed point (to[], 0) is -from - 1
{
    const rods *r = user;
    const int R = x->stride, n = x->n;
    for (int a = 0; a < r->n; ++a)
        for (int k = 0; k < x->count; ++k) {
            x->g[a*R + k] = -r->length2[a]/2;
            for (int i = 0; i < 2; ++i) {
                const int from = 2*r->from[a] + i, to = 2*r->to[a] + i;
                const gvi_real pivot = i == 0 ? (gvi_real)(-r->from[a] - 1) : 0,
                               d = x->q[to*R + k] - (r->from[a] < 0 ? pivot : x->q[from*R + k]);
                x->g[a*R + k] += d*d/2;
                x->jacobian[(a*n + to)*R + k] = d;
                if (r->from[a] >= 0) x->jacobian[(a*n + from)*R + k] = -d;
            }
        }
    return 0;
}

static void measure(rods *r, const gvi_real *q)
{
    for (int a = 0; a < r->n; ++a) {
        r->length2[a] = 0;
        for (int i = 0; i < 2; ++i) {
            const gvi_real pivot = i == 0 ? (gvi_real)(-r->from[a] - 1) : 0,
                           d = q[2*r->to[a] + i] - (r->from[a] < 0 ? pivot : q[2*r->from[a] + i]);
            r->length2[a] += d*d;
        }
    }
}

TEST(nearly_dependent_rows_turn_as_a_body)
{
    static const int steps[] = { 0, KIND == 1 ? 8 : 64, KIND == 1 ? 3 : 16, 8 };
    for (int k = 0; k < (KIND == 1 ? 1 : 3); ++k) {
        const gvi_real off = k == 0 ? (gvi_real)0.1L : k == 1 ? (gvi_real)0.003L : (gvi_real)0.001L;
        rods r = { 3, { 0, 1, 0 }, { 1, 2, 2 }, { 0 } };
        const gvi_real q[6] = { -1, -off, 0, 2*off, 1, -off }, v[6] = { off, -1, -2*off, 0, off, 1 };
        measure(&r, q);
        for (int s = 1; s <= (KIND == 1 ? 2 : 3); ++s) {
            real error[2];
            for (int half = 0; half < 2; ++half) {
                const gvi_effect hold = { .kind = GVI_CONSTRAINT, .points = rods_hold, .rows = 3, .user = &r };
                const gvi_desc desc = { .n = 6, .degree = s, .effects = &hold, .effect_count = 1 };
                const int N = steps[s] << half;
                gvi_stepper st;
                assert_ok(start(&st, &desc, q, v));
                for (int i = 0; i < N; ++i) assert_ok(gvi_step(&st, 1/(gvi_real)N));
                error[half] = hypot(st.q[4] - (cos(1.0L) + off*sin(1.0L)), st.q[5] - (sin(1.0L) - off*cos(1.0L)));
            }
            assert_between(2*s - 0.1L, log2(error[0]/error[1]), 2*s + 0.1L);
        }
    }
}

/* A parallelogram through its flat position, where it could go on as another linkage: no step gets there, and the
   state before it stays the state */
TEST(the_flat_position_is_refused)
{
    for (int s = 1; s <= 6; ++s)
        for (int pinned = 0; pinned < 2; ++pinned)
            for (int k = 0; k < (KIND == 1 ? 8 : 20); ++k) {
                const gvi_real a = (KIND == 1 ? (gvi_real)0.02L : (gvi_real)0.003L)*(gvi_real)(k + 1), h = a*((gvi_real)1.1L + (gvi_real)0.1L*(gvi_real)k);
                rods r = { 3, { -1, 0, -2 }, { 0, 1, 1 }, { 1, 1, 1 } };
                const gvi_effect hold = { .kind = GVI_CONSTRAINT, .points = rods_hold, .rows = 3, .user = &r };
                const gvi_desc desc = { .n = 4, .degree = s, .effects = &hold, .effect_count = 1,
                                        .formulation = pinned ? GVI_NEWTON : GVI_AUTO };
                const gvi_real q[4] = { cos(a), sin(a), 1 + cos(a), sin(a) }, v[4] = { sin(a), -cos(a), sin(a), -cos(a) };
                gvi_stepper st;
                assert_ok(start(&st, &desc, q, v));
                const gvi_status status = gvi_step(&st, h);
                if (pinned || status != GVI_OK) assert_true(status == GVI_E_SINGULAR || status == GVI_E_CONVERGENCE);
                else assert_close(st.q[1], st.q[3], a/(KIND == 1 ? 50 : 1000));          // never on the other branch
                for (int i = 0; status != GVI_OK && i < 4; ++i) assert_true(st.q[i] == q[i]);
            }
}

TEST(memory_is_what_the_macro_says)
{
    for (int n = 1; n <= 7; ++n)
        for (int m = 1; m <= n; ++m)
            for (int s = 1; s <= 9; ++s)
                for (int r = s; r <= s + 2; ++r)
                    for (int f = 0; f < 2; ++f) {
                        const gvi_effect scene[] = { { .kind = GVI_CONSTRAINT, .points = circle, .rows = m },
                                                     { .kind = GVI_LAGRANGIAN, .points = quartic } };
                        const gvi_desc desc = { .n = n, .degree = s, .rule.points = r, .effects = scene,
                                                .effect_count = 1 + f, .formulation = f ? GVI_NEWTON : GVI_AUTO };
                        assert_between(1, gvi_size(&desc)/sizeof(gvi_real), GVI_CONSTRAINED_LENGTH(n, s, r, m));
                    }
}

/* Of a circle with two masses: q' - q normal in the metric M, so M(q' - q) = lambda q'; v' likewise */
TEST(a_projection_is_the_nearest_point)
{
    gvi_real mass[2] = { 1, 9 };
    const gvi_effect hold = { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1 };
    for (int unit = 0; unit < 2; ++unit)
        for (int k = 0; k < 40; ++k) {
            const gvi_desc desc = { .n = 2, .degree = 3, .effects = &hold, .effect_count = 1,
                .mass = { .kind = unit ? GVI_MASS_UNIT : GVI_MASS_DIAGONAL, .matrix = unit ? NULL : mass } };
            const real r = k % 4 == 0 ? 1.001L : k % 4 == 1 ? 0.9L : k % 4 == 2 ? 1.2L : 1 + 8*EPS, w[2] = { 1, unit ? 1 : 9 };
            gvi_real q[2] = { (gvi_real)(r*cos(0.3L*k)), (gvi_real)(r*sin(0.3L*k)) }, v[2] = { 1, 2 }, far[2];
            const real q0[2] = { q[0], q[1] };
            gvi_stepper st = new_stepper(&desc);
            assert_ok(gvi_project(&st, 0, q, v, far));
            const real d[2] = { q[0] - q0[0], q[1] - q0[1] }, dv[2] = { (real)v[0] - 1, (real)v[1] - 2 };
            assert_close((real)q[0]*q[0] + (real)q[1]*q[1], 1, 8*EPS);
            assert_close((real)q[0]*v[0] + (real)q[1]*v[1], 0, 16*EPS);
            assert_close(w[0]*d[0]*q[1] - w[1]*d[1]*q[0], 0, 40*EPS);
            assert_close(w[0]*dv[0]*q[1] - w[1]*dv[1]*q[0], 0, 80*EPS);
            assert_close(far[0], sqrt(w[0]*d[0]*d[0] + w[1]*d[1]*d[1]), 16*EPS);
            assert_close(far[1], sqrt(w[0]*dv[0]*dv[0] + w[1]*dv[1]*dv[1]), 100*EPS);
            if (unit && k % 4 == 1) assert_close(far[0], 0.1L, 8*EPS);
            const gvi_real again[4] = { q[0], q[1], v[0], v[1] };
            assert_ok(gvi_start(&st, 0, q, v));
            assert_ok(gvi_step(&st, (gvi_real)0.01L));
            assert_ok(gvi_project(&st, 0, q, v, NULL));        // it is there: no more than rounding
            for (int i = 0; i < 2; ++i) assert_close(q[i], again[i], 8*EPS);
            for (int i = 0; i < 2; ++i) assert_close(v[i], again[2 + i], 8*EPS);
        }
}

/* What cannot be: too far, dependent, not a number; q and v stay as they are, and so does a motion that is on */
static int square(const gvi_points *x, void *user)
{
    const gvi_real *level = user;
    for (int k = 0; k < x->count; ++k) {
        if (fabs(x->q[k]) > level[1] && fabs(x->q[k]) < level[2]) return 1;
        x->g[k] = x->q[k]*x->q[k] - level[0];
        x->jacobian[k] = 2*x->q[k];
    }
    return 0;
}

TEST(projections_that_fail_change_nothing)
{
    const gvi_effect hold = { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1 };
    const gvi_desc desc = { .n = 2, .degree = 3, .effects = &hold, .effect_count = 1 };
    gvi_stepper st, twin;
    const gvi_real q0[2] = { 1, 0 }, v0[2] = { 0, 1 };
    gvi_real zero[2] = { 0, 0 }, v[2] = { 1, 1 }, bad[2] = { (gvi_real)NAN, 1 }, q[2] = { (gvi_real)1.01L, 0 };
    twin = new_stepper(&desc);
    assert_ok(gvi_start(&twin, 0, q0, v0));
    assert_ok(start(&st, &desc, q0, v0));
    for (int k = 0; k < 10; ++k) {
        assert_ok(gvi_step(&st, (gvi_real)0.1L));
        assert_ok(gvi_step(&twin, (gvi_real)0.1L));
        const gvi_status status = gvi_project(&st, 0, zero, v, NULL);       // G is 0 there
        assert_true(status == GVI_E_SINGULAR || status == GVI_E_CONVERGENCE || status == GVI_E_NON_FINITE);
        assert_true(zero[0] == 0 && zero[1] == 0 && v[0] == 1 && v[1] == 1);
        assert_status(gvi_project(&st, 0, bad, v, NULL), GVI_E_ARGUMENT);
        assert_status(gvi_project(&st, 0, NULL, v, NULL), GVI_E_ARGUMENT);
        assert_ok(gvi_project(&st, 0, q, v, NULL));
        v[0] = v[1] = 1;
        q[0] = (gvi_real)1.01L;
        for (int i = 0; i < 2; ++i) assert_true(st.q[i] == twin.q[i] && st.p[i] == twin.p[i]);
    }
    /* x^2 = -1 is met nowhere; and where Newton's method goes from 0.1 a callback may refuse: at 5.05, 2.62, -20.7 */
    for (int k = 0; k < 4; ++k) {
        gvi_real level[4][3] = { { -1, MAX, MAX }, { 1, 3, 9 }, { 1, 2, 3 }, { -1, 10, MAX } }, x = (gvi_real)0.1L, u = 0;
        const gvi_effect parabola = { .kind = GVI_CONSTRAINT, .points = square, .rows = 1, .user = level[k] };
        const gvi_desc line = { .n = 1, .degree = 3, .effects = &parabola, .effect_count = 1 };
        st = new_stepper(&line);
        assert_status(gvi_project(&st, 0, &x, &u, NULL), k ? GVI_E_CALLBACK : GVI_E_CONVERGENCE);
        assert_true(x == (gvi_real)0.1L && u == 0);
    }
    const gvi_desc none = { .n = 2, .degree = 3 };              // without constraints: nothing to do
    gvi_real far[2] = { 1, 1 };
    st = new_stepper(&none);
    assert_ok(gvi_project(&st, 0, q, v, far));
    assert_true(far[0] == 0 && far[1] == 0 && v[0] == 1);
    assert_status(gvi_project(NULL, 0, q, v, far), GVI_E_ARGUMENT);
}

/* A pendulum of length L in a field of strength L, in powers of two: the same motion, times L, to rounding */
static gvi_real unit_of_length;
AT_POINTS(long_rod)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real X = x->q[k], Y = x->q[R + k];
        x->g[k] = (X*X + Y*Y - unit_of_length*unit_of_length)/2;
        x->jacobian[k] = X;
        x->jacobian[R + k] = Y;
    }
    return 0;
}
AT_POINTS(strong_weight)
{
    for (int k = 0; k < x->count; ++k) x->f[x->stride + k] -= unit_of_length;
    return 0;
}

TEST(the_unit_of_length_does_not_matter)
{
    static const gvi_effect scene[] = { { .points = strong_weight }, { .kind = GVI_CONSTRAINT, .points = long_rod, .rows = 1 } };
    static const int powers[] = { 0, 10, -10, 30, -30, 60, -60, 180, -180 };
    gvi_real right = 0;
    for (int k = 0; k < COUNT(powers); ++k) {
        const gvi_desc desc = { .n = 2, .degree = 4, .effects = scene, .effect_count = 2, .formulation = GVI_NEWTON };
        gvi_stepper st;
        if (KIND == 1 && abs(powers[k]) > 30) continue;         // L^2 is no number of that type
        unit_of_length = (gvi_real)ldexpl(1, powers[k]);
        const gvi_real q[] = { (gvi_real)0.6L*unit_of_length, (gvi_real)-0.8L*unit_of_length }, v[2] = { 0, 0 };
        assert_ok(start(&st, &desc, q, v));
        for (int i = 0; i < 20; ++i) assert_ok(gvi_step(&st, (gvi_real)0.3L));
        if (k == 0) right = st.q[0];
        assert_close(st.q[0]/unit_of_length, right, 256*EPS);
    }
}

RUN_TESTS(NULL, NULL)
