/* examples/tools/check.h: right scenes pass, and every planted slip is found and named:
   which effect, which derivative, which coordinates.  Slips are planted by
   callbacks that ask the right ones and then spoil one entry. */
#include "gvi_test.h"
#include "scenes/scenes.c"
#include "tools/check.h"

enum { ROOM = 64, ROWS = SCENE_MAX*64 };

static scene_setup made;
static check_finding list[ROOM];
static check_report report;
static char line[240];

static int check(void)
{
    report.list = list;
    report.room = ROOM;
    return check_scene(&made.desc, 0, made.q, made.v, &report);
}

static const scene *build(const char *name)
{
    const scene *a = scene_find(name);
    assert_non_null(a);
    scene_build(a, &made, NULL);
    return a;
}

/* A scene of at most one effect, where every number is another */
static void build_own(int n, gvi_effect effect, gvi_mass mass)
{
    static const double q[] = { 0.7, -1.3 }, v[] = { 0.4, 1.9 };
    memset(&made, 0, sizeof made);
    const int count = effect.points != NULL;
    made.desc = (gvi_desc){ .n = n, .effects = count ? made.effects : NULL, .effect_count = count, .mass = mass };
    made.effects[0] = effect;
    for (int i = 0; i < n && i < 2; ++i) made.q[i] = q[i], made.v[i] = v[i];
}

TEST(right_scenes_pass)
{
    long checked = 0;
    for (int i = 0; i < scene_count; ++i) {
        build(scenes[i]->name);
        const int count = check();
        for (int k = 0; k < count && k < ROOM; ++k)
            print_error("  %s: %s\n", scenes[i]->name, check_line(list + k, line, sizeof line));
        assert_int_equal(count, 0);
        assert_int_equal(report.unchecked, 0);
        assert_true(report.checked > 20);
        assert_between(1e-10, report.worst, made.desc.n > 40 ? 1e-4 : 1e-8);    // a net's soft direction
        checked += report.checked;
    }
    assert_true(checked > 100000);
}

typedef enum slip_kind {
    NONE, FACTOR, INDEX, OVERWRITES, LAST_POINT, PAST_ROWS, READS_V, REFUSES
} slip_kind;

/* Of one output: "f", "dldv", "value", "fq", "fv", "pv", "mass", "gradient", "velocity". */
typedef struct slip {
    gvi_effect  right;
    gvi_mass    mass;
    slip_kind   kind;
    const char *entry;
    int         i, j;
    double      factor;
} slip;

static slip planted;

/* Output `own` of the right callback, spoiled, then added to (or put in) `out`. */
static void spoil(const gvi_points *x, const char *entry, double *own, double *out, int rows, int add)
{
    const slip *s = &planted;
    const int at = rows == x->n*x->n ? s->i*x->n + s->j : s->i, d = x->stride;
    const int here = !strcmp(entry, s->entry);
    for (int k = 0; k < x->count && here; ++k) {
        if (s->kind == FACTOR) own[at*d+k] *= s->factor;
        if (s->kind == INDEX) own[s->j*d+k] += own[s->i*d+k], own[s->i*d+k] = 0;       // i's goes to j
        if (s->kind == READS_V && x->v) own[at*d+k] += 1e-3*x->v[k];
    }
    if (here && s->kind == LAST_POINT && x->count > 1) own[at*d + x->count - 1] = 0;
    const int left = here && s->kind == INDEX && !add ? s->i : -1;
    for (int r = 0; r < rows; ++r)
        for (int k = 0; k < x->count; ++k) {
            if (!add && r/x->n < r % x->n && rows == x->n*x->n) continue;         // lower triangle
            if (r == left) continue;
            out[r*d+k] = own[r*d+k] + (add && !(here && s->kind == OVERWRITES && r == at) ? out[r*d+k] : 0);
        }
    if (here && s->kind == PAST_ROWS) out[rows*d] += 1;
}

static double scratch[3][ROWS];

static gvi_points on_scratch(const gvi_points *x, int square)
{
    gvi_points y = *x;
    const size_t rows = (size_t)(square ? x->n*x->n : x->n)*(size_t)x->stride;
    assert_true(rows <= ROWS);
    for (int m = 0; m < 3; ++m) memset(scratch[m], 0, rows*sizeof(double));
    if (x->f) y.f = scratch[0];
    if (x->dldv) y.dldv = scratch[1];
    if (x->value) y.value = scratch[2];
    if (x->mass) y.mass = scratch[0];
    if (x->velocity) y.velocity = scratch[0];
    return y;
}

AT_POINTS(bad_points)
{
    const gvi_points y = on_scratch(x, 0);
    if (planted.kind == REFUSES && !strcmp(planted.entry, "f")) return 1;
    if (planted.right.points ? planted.right.points(&y, user) : 1) return 1;
    if (x->f) spoil(x, "f", y.f, x->f, x->n, 1);
    if (x->dldv) spoil(x, "dldv", y.dldv, x->dldv, x->n, 1);
    if (x->value) spoil(x, "value", y.value, x->value, 1, 1);
    return 0;
}

AT_POINTS(bad_value)
{
    const gvi_points y = on_scratch(x, 0);
    if (planted.right.value(&y, user)) return 1;
    spoil(x, "value", y.value, x->value, 1, 1);
    return 0;
}

static void spoil_matrix(const char *entry, int n, double *own, double *out)
{
    const slip *s = &planted;
    for (int k = 0; out && k < n*n; ++k) {
        const int here = !strcmp(entry, s->entry), at = here && k == s->i*n + s->j;
        double x = own[k];
        if (at && s->kind == FACTOR) x *= s->factor;
        if (here && s->kind == INDEX) x = own[k % n*n + k/n];                     // all transposed
        out[k] = x + (at && s->kind == OVERWRITES ? 0 : out[k]);
    }
    if (out && !strcmp(entry, s->entry) && s->kind == PAST_ROWS) out[n*n] += 1;
}

static int bad_hessian(double t, const double *q, const double *v,
                       double *fq, double *fv, double *pv, void *user)
{
    static double own[3][SCENE_MAX*SCENE_MAX];
    const int n = made.desc.n;
    memset(own, 0, sizeof own);
    if (planted.right.hessian(t, q, v, own[0], fv ? own[1] : NULL, pv ? own[2] : NULL, user)) return 1;
    spoil_matrix("fq", n, own[0], fq);
    spoil_matrix("fv", n, own[1], fv);
    spoil_matrix("pv", n, own[2], pv);
    return 0;
}

AT_POINTS(bad_mass)
{
    const gvi_points y = on_scratch(x, 1);
    if (planted.mass.points(&y, user)) return 1;
    spoil(x, "mass", y.mass, x->mass, x->n*x->n, 0);
    if (planted.kind == FACTOR && !strcmp(planted.entry, "upper"))               // the other triangle differs
        for (int k = 0; k < x->count; ++k)
            x->mass[(planted.i*x->n + planted.j)*x->stride+k] =
                planted.factor*x->mass[(planted.j*x->n + planted.i)*x->stride+k];
    return 0;
}

AT_POINTS(bad_gradient)
{
    const gvi_points y = on_scratch(x, 0);
    if (planted.mass.gradient(&y, user)) return 1;
    spoil(x, "gradient", y.f, x->f, x->n, 1);
    return 0;
}

AT_POINTS(bad_velocity)
{
    const gvi_points y = on_scratch(x, 0);
    if (planted.mass.velocity(&y, user)) return 1;
    spoil(x, "velocity", y.velocity, x->velocity, x->n, 0);
    return 0;
}

/* Row i, coordinate j of a constraint's Jacobian; what is 0 there gets a factor's excess over 1. */
AT_POINTS(bad_constraint)
{
    if (planted.right.points(x, user)) return 1;
    for (int k = 0; k < x->count; ++k) {
        double *at = !strcmp(planted.entry, "rate") ? x->rate + planted.i*x->stride + k
                                                    : x->jacobian + (planted.i*x->n + planted.j)*x->stride + k;
        *at += (planted.factor - 1)*(fabs(*at) > 0 ? *at : 1);
    }
    return 0;
}

/* Plants a slip in effect e (or the mass, GVI_FAULT_MASS) of the scene as built. */
static void plant(int e, slip_kind kind, const char *entry, int i, int j, double factor)
{
    planted = (slip){ .kind = kind, .entry = entry, .i = i, .j = j, .factor = factor,
                      .mass = made.desc.mass };
    if (e == GVI_FAULT_MASS) {
        made.desc.mass.points = bad_mass;
        made.desc.mass.gradient = bad_gradient;
        if (made.desc.mass.velocity) made.desc.mass.velocity = bad_velocity;
        return;
    }
    planted.right = made.effects[e];
    made.effects[e].points = made.effects[e].kind == GVI_CONSTRAINT ? bad_constraint : bad_points;
    if (made.effects[e].value) made.effects[e].value = bad_value;
    if (made.effects[e].hessian) made.effects[e].hessian = bad_hessian;
}

static const check_finding *found(check_what what, int e, const char *entry, int i, int j)
{
    for (int k = 0; k < report.count && k < ROOM; ++k)
        if (list[k].what == what && list[k].effect == e && !strcmp(list[k].entry, entry) && list[k].i == i
            && list[k].j == j) return list + k;
    return NULL;
}

static void assert_found(check_what what, int e, const char *entry, int i, int j)
{
    if (found(what, e, entry, i, j)) return;
    for (int k = 0; k < report.count && k < ROOM; ++k)
        print_error("  %s\n", check_line(list + k, line, sizeof line));
    print_error("%d, effect %d, %s[%d][%d] is not among these\n", (int)what, e, entry, i, j);
    fail();
}

AT_POINTS(nothing) { return 0; }

/* The scene with a slip in it, checked; other effects, which are right, are left out of what takes time */
static void slip_in(const char *name, int e, slip_kind kind, const char *entry, int i, int j, double factor)
{
    build(name);
    plant(e, kind, entry, i, j, factor);
    for (int k = 0; k < made.desc.effect_count; ++k)
        if (e >= 0 && k != e) made.effects[k] = (gvi_effect){ .kind = GVI_FORCE, .points = nothing };
    check();
}

static void ask(int e, const double *q, const double *v, double *f, double *dldv)
{
    static const double t = 0;
    const gvi_effect *a = made.effects + e;
    const gvi_points x = { .n = made.desc.n, .count = 1, .stride = 1, .t = &t, .q = q, .f = f,
                           .v = a->kind == GVI_POTENTIAL ? NULL : v,
                           .dldv = a->kind == GVI_LAGRANGIAN ? dldv : NULL };
    memset(f, 0, sizeof(double)*SCENE_MAX);
    memset(dldv, 0, sizeof(double)*SCENE_MAX);
    assert_int_equal(a->points(&x, a->user), 0);
}

/* Entries of no more than rounding cannot be right or wrong. */
static double largest(const double *f)
{
    double most = 0;
    for (int i = 0; i < made.desc.n; ++i) most = fmax(most, fabs(f[i]));
    return most;
}

/* Every coordinate of every effect that has a value, in every scene: a wrong sign,
   a factor 2, one part in a million.  The effect and coordinate are named, the value
   that should be there is given, and no other coordinate is accused. */
TEST(wrong_entries_of_f_are_named)
{
    static const double factors[] = { -1, 2, 0, 1 + 1e-6 };
    static const check_hint hints[] = { CHECK_SIGN, CHECK_TWICE, CHECK_MISSING, CHECK_NO_HINT };
    int planted_count = 0;
    for (int a = 0; a < scene_count; ++a)
        for (int e = 0; e == 0 || e < made.desc.effect_count; ++e) {
            double f[SCENE_MAX], p[SCENE_MAX];
            build(scenes[a]->name);
            if (made.effects[e].kind == GVI_FORCE || made.effects[e].kind == GVI_CONSTRAINT) continue;
            ask(e, made.q, made.v, f, p);
            for (int i = 0; i < made.desc.n; ++i)
                for (int k = 0; k < COUNT(factors); ++k) {
                    if (fabs(f[i]) < 1e-6*largest(f) || !(largest(f) > 0)) continue;
                    if (made.desc.n >= 40 && (i + 47*k) % made.desc.n) continue;   // each factor once: they take time
                    slip_in(scenes[a]->name, e, FACTOR, "f", i, 0, factors[k]);
                    assert_found(CHECK_DERIVATIVE, e, "f", i, -1);
                    const check_finding *y = found(CHECK_DERIVATIVE, e, "f", i, -1);
                    assert_int_equal(y->point, 0);
                    assert_close(y->right, f[i], 1e-8*fabs(f[i]));
                    assert_close(y->found, factors[k]*f[i], 1e-14*fabs(f[i]));
                    assert_int_equal(y->hint, hints[k]);
                    assert_int_equal(report.count, 1);
                    ++planted_count;
                }
        }
    assert_true(planted_count > 150);
}

/* Every entry of seven bars' Jacobian, be it 0 or not, and dg/dt: row and coordinate are named. */
TEST(wrong_jacobians_are_named)
{
    static const double factors[] = { -1, 0, 1 + 1e-3, 1 + 1e-6 };
    static const check_hint hints[] = { CHECK_SIGN, CHECK_MISSING, CHECK_NO_HINT, CHECK_NO_HINT };
    const char *name = "peaucellier";
    int planted_count = 0;
    build(name);
    const int n = made.desc.n, e = made.desc.effect_count - 1, rows = made.effects[e].rows;
    for (int a = 0; a < rows; ++a)
        for (int i = 0; i <= n; ++i)
            for (int k = 0; k < COUNT(factors); ++k) {
                const char *entry = i < n ? "jacobian" : "rate";
                double t = 0, g[SCENE_MAX], rate[SCENE_MAX] = { 0 }, G[SCENE_MAX*SCENE_MAX] = { 0 };
                build(name);
                const gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &t, .q = made.q, .g = g, .rate = rate,
                                       .jacobian = G };
                assert_int_equal(made.effects[e].points(&x, made.effects[e].user), 0);
                const double right = i < n ? G[a*n + i] : 0, size = fabs(right) > 0 ? right : 1;
                if (size*size > right*right && k != 2) continue;                 // 0: 1e-3 alone
                slip_in(name, e, FACTOR, entry, a, i, factors[k]);
                const check_finding *y = found(CHECK_DERIVATIVE, e, entry, a, i < n ? i : -1);
                if (!y) assert_found(CHECK_DERIVATIVE, e, entry, a, i < n ? i : -1);
                assert_close(y->right, right, 1e-8);
                assert_close(y->found, right + (factors[k] - 1)*size, 1e-14);
                assert_int_equal(y->hint, fabs(right) > 0 ? hints[k] : CHECK_SURPLUS);
                assert_int_equal(report.count, 1);
                ++planted_count;
            }
    assert_int_equal(planted_count, 4*22 + 7*9 - 22);          // three bars hold one joint, four hold two
}

TEST(wrong_entries_of_dldv_are_named)
{
    static const char *const where[] = { "crossed_fields", "arenstorf" };
    for (int a = 0; a < COUNT(where); ++a) {
        double f[SCENE_MAX], p[SCENE_MAX];
        build(where[a]);
        const int e = made.desc.effect_count - 1;
        ask(e, made.q, made.v, f, p);
        assert_int_equal(made.effects[e].kind, GVI_LAGRANGIAN);
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k) {
                if (!k && !(fabs(p[i]) > 0)) continue;        // a small part of 0
                slip_in(where[a], e, FACTOR, "dldv", i, 0, k ? -1 : 1 + 1e-6);
                assert_found(CHECK_DERIVATIVE, e, "dldv", i, -1);
                for (int m = 0; m < report.count; ++m) assert_string_equal(list[m].entry, "dldv");
            }
    }
}

/* Each nonzero entry of each Hessian that the effects bring (every 401st of large ones). */
TEST(wrong_entries_of_hessians_are_named)
{
    static double H[3][SCENE_MAX*SCENE_MAX];
    static const char *const entry[] = { "fq", "fv", "pv" };
    int planted_count = 0;
    for (int a = 0; a < scene_count; ++a)
        for (int e = 0; e == 0 || e < made.desc.effect_count; ++e) {
            build(scenes[a]->name);
            const gvi_effect *y = made.effects + e;
            const int n = made.desc.n, forced = y->kind == GVI_FORCE;
            if (!y->hessian || y->kind == GVI_LAGRANGIAN) continue;
            memset(H, 0, sizeof H);
            assert_int_equal(y->hessian(0, made.q, made.v, H[0], forced ? H[1] : NULL, NULL, y->user), 0);
            for (int m = 0; m <= forced; ++m)
                for (int k = 0, seen = 0; k < n*n; ++k) {
                    if (fabs(H[m][k]) < 1e-3 || (n > 40 && seen++ % 1601)) continue;
                    slip_in(scenes[a]->name, e, FACTOR, entry[m], k/n, k % n, k % 2 ? -1 : 1 + 1e-5);
                    assert_found(CHECK_DERIVATIVE, e, entry[m], k/n, k % n);
                    assert_int_equal(report.count, 1);
                    ++planted_count;
                }
        }
    assert_true(planted_count >= 8);
}

/* A Hessian that is not symmetric, transposed: two blocks of it differ. */
AT_POINTS(turn_points)
{
    for (int k = 0; k < x->count; ++k) {
        x->f[k] += x->q[k]*x->q[x->stride+k];
        x->f[x->stride+k] -= 2*x->q[k] + x->v[k]*x->v[x->stride+k];
    }
    return 0;
}

static int turn_hessian(double t, const double *q, const double *v,
                        double *fq, double *fv, double *pv, void *user)
{
    fq[0] += q[1];
    fq[1] += q[0];
    fq[2] -= 2;
    fv[2] -= v[1];
    fv[3] -= v[0];
    return 0;
}

TEST(transposed_hessians_are_named)
{
    const gvi_effect turn = { .kind = GVI_FORCE, .points = turn_points, .hessian = turn_hessian };
    build_own(2, turn, (gvi_mass){ 0 });
    assert_int_equal(check(), 0);
    for (int m = 0; m < 2; ++m) {
        build_own(2, turn, (gvi_mass){ 0 });
        plant(0, INDEX, m ? "fv" : "fq", 0, 0, 1);
        check();
        assert_int_equal(report.count, 2);
        for (int k = 0; k < 2; ++k) {
            assert_found(CHECK_DERIVATIVE, 0, m ? "fv" : "fq", k, 1 - k);
            assert_int_equal(found(CHECK_DERIVATIVE, 0, m ? "fv" : "fq", k, 1 - k)->hint, CHECK_TRANSPOSED);
        }
        assert_string_not_equal(check_line(list, line, sizeof line), "");
        assert_non_null(strstr(line, "transposed?"));
    }
}

/* A potential without value: its force must be a gradient of something. */
TEST(forces_without_value_must_have_a_potential)
{
    build("outer_solar_system");
    made.effects[0].value = NULL;
    assert_int_equal(check(), 0);
    plant(0, FACTOR, "f", 4, 0, 1 + 1e-5);
    check();
    assert_true(report.count > 0);
    for (int k = 0; k < report.count && k < ROOM; ++k) {
        assert_int_equal(list[k].effect, 0);
        assert_int_equal(list[k].what, CHECK_CURL);
        assert_true(list[k].i == 4 || list[k].j == 4);
    }
}

GVI_EACH(to_the_stride, 2, f)
{
    const double I = x->q[0]*x->q[0] + x->q[1]*x->q[1];
    x->f[0] -= I*x->q[0];
    x->f[1] -= I*x->q[1];
}

/* Callbacks may loop to the stride, as those of GVI_EACH do */
TEST(padding_may_be_written)
{
    static const gvi_effect e = { .points = to_the_stride };
    static const double q[] = { 0.4, 0.7 }, v[] = { 0, 2 };
    const gvi_desc d = { .n = 2, .degree = 8, .effects = &e, .effect_count = 1 };
    check_report found_here = { .room = 0 };
    check_scene(&d, 0, q, v, &found_here);
    assert_int_equal(found_here.count, 0);
}

/* For every effect of every scene: overwriting, a forgotten last point, writing past the rows; of all
   outputs that it has. */
TEST(callbacks_that_overwrite_or_leave_points_out_are_named)
{
    static const struct { slip_kind slip; check_what what; } cases[] = {
        { OVERWRITES, CHECK_ADDS }, { LAST_POINT, CHECK_BATCH }, { PAST_ROWS, CHECK_BEYOND } };
    int planted_count = 0;
    for (int a = 0; a < scene_count; ++a)
        for (int e = 0; e == 0 || e < made.desc.effect_count; ++e) {
            double f[SCENE_MAX], p[SCENE_MAX];
            int i = 0;
            build(scenes[a]->name);
            if (made.desc.n > 40 || made.effects[e].kind == GVI_CONSTRAINT) continue;
            ask(e, made.q, made.v, f, p);
            while (i < made.desc.n - 1 && !(fabs(f[i]) > 0.1*largest(f) && largest(f) > 0)) ++i;
            for (int k = 0; k < COUNT(cases); ++k)
                for (int output = 0; output < 2; ++output) {
                    const char *entry = output ? "value" : "f";
                    build(scenes[a]->name);
                    if (output && !made.effects[e].value) continue;
                    slip_in(scenes[a]->name, e, cases[k].slip, entry, output ? 0 : i, 0, 0);
                    const int at = cases[k].slip == PAST_ROWS ? -1 : output ? 0 : i;
                    int named = 0;
                    for (int m = 0; m < report.count && m < ROOM; ++m) {
                        assert_int_equal(list[m].effect, e);
                        named |= list[m].what == cases[k].what && !strcmp(list[m].entry, entry)
                              && (list[m].i == at || cases[k].what == CHECK_BEYOND);
                    }
                    assert_true(named);
                    ++planted_count;
                }
        }
    assert_true(planted_count > 100);
}

TEST(other_slips_are_named)
{
    static const struct { const char *scene; int e; slip_kind slip; const char *entry; int i, j;
                          check_what what; int i_found, j_found; } cases[] = {
        { "elastic_pendulum", 1, OVERWRITES, "fq",    0, 1, CHECK_ADDS,    0, 1 },
        { "elastic_pendulum", 1, PAST_ROWS,  "fq",    0, 1, CHECK_BEYOND, -1, -1 },
        { "elastic_pendulum", 1, READS_V,    "f",     1, 0, CHECK_READS_V, 1, -1 },
        { "elastic_pendulum", 1, READS_V,    "value", 0, 0, CHECK_READS_V, -1, -1 },
        { "duffing",          0, REFUSES,    "f",     0, 0, CHECK_REFUSED, -1, -1 },
    };
    for (int k = 0; k < COUNT(cases); ++k) {
        slip_in(cases[k].scene, cases[k].e, cases[k].slip, cases[k].entry, cases[k].i, cases[k].j, 1);
        assert_found(cases[k].what, cases[k].e, cases[k].entry, cases[k].i_found, cases[k].j_found);
        if (k < 2) assert_int_equal(report.count, 1);
    }
}

/* One function for f and value that leaves f out when value is wanted, too. */
AT_POINTS(either)
{
    for (int k = 0; k < x->count; ++k) {
        if (x->value) x->value[k] += x->q[k]*x->q[k]/2;
        else x->f[k] -= x->q[k];
    }
    return 0;
}

AT_POINTS(each)
{
    for (int k = 0; x->value && k < x->count; ++k) x->value[k] += x->q[k]*x->q[k]/2;
    FOR_EACH(x, a) if (x->f) x->f[a] -= x->q[a];
    return 0;
}

TEST(f_left_out_beside_value_is_named)
{
    build_own(1, (gvi_effect){ .kind = GVI_POTENTIAL, .points = each, .value = each }, (gvi_mass){ 0 });
    assert_int_equal(check(), 0);
    made.effects[0].points = made.effects[0].value = either;
    check();
    assert_found(CHECK_BOTH, 0, "f", 0, -1);
    assert_int_equal(report.count, 1);
}

TEST(slips_of_a_mass_are_named)
{
    static const char *const where[] = { "double_pendulum", "robot_arm", "lagrange_top" };
    for (int a = 0; a < COUNT(where); ++a) {
        build(where[a]);
        assert_int_equal(check(), 0);
        const int n = made.desc.n;
        for (int i = 0; i < n; ++i) {                         // an entry of the diagonal forgotten
            slip_in(where[a], GVI_FAULT_MASS, INDEX, "mass", i*n + i, 0, 1);
            assert_found(CHECK_DEFINITE, GVI_FAULT_MASS, "mass", i, i);
        }
        build(where[a]);
        plant(GVI_FAULT_MASS, FACTOR, "upper", 0, n - 1, 1 + 1e-6);
        made.desc.mass.velocity = NULL;
        check();
        if (a < 2) assert_found(CHECK_SYMMETRY, GVI_FAULT_MASS, "mass", 0, n - 1);
        slip_in(where[a], GVI_FAULT_MASS, FACTOR, "mass", n - 1, n - 1, -1);
        assert_found(CHECK_DEFINITE, GVI_FAULT_MASS, "mass", n - 1, n - 1);
        slip_in(where[a], GVI_FAULT_MASS, LAST_POINT, "mass", 0, 0, 1);
        assert_found(CHECK_BATCH, GVI_FAULT_MASS, "mass", 0, 0);
        for (int i = 0; i < n; ++i) {
            slip_in(where[a], GVI_FAULT_MASS, FACTOR, "velocity", i, 0, 1 + 1e-4);
            assert_found(CHECK_VELOCITY, GVI_FAULT_MASS, "velocity", i, -1);
            assert_int_equal(report.count, 1);
        }
    }
}

TEST(slips_of_a_mass_gradient_are_named)
{
    static const struct { const char *scene; int n; } where[] = {
        { "double_pendulum", 2 }, { "lagrange_top", 1 } };
    static const double factors[] = { -1, 0, 2, 1 + 1e-5 };
    for (int a = 0; a < COUNT(where); ++a)
        for (int i = 0; i < where[a].n; ++i) {
            for (int k = 0; k < COUNT(factors); ++k) {
                slip_in(where[a].scene, GVI_FAULT_MASS, FACTOR, "gradient", i, 0, factors[k]);
                assert_found(CHECK_DERIVATIVE, GVI_FAULT_MASS, "gradient", i, -1);
                assert_int_equal(report.count, 1);
            }
            slip_in(where[a].scene, GVI_FAULT_MASS, OVERWRITES, "gradient", i, 0, 1);
            assert_found(CHECK_ADDS, GVI_FAULT_MASS, "gradient", i, -1);
            slip_in(where[a].scene, GVI_FAULT_MASS, LAST_POINT, "gradient", i, 0, 1);
            assert_found(CHECK_BATCH, GVI_FAULT_MASS, "gradient", i, -1);
        }
}

/* velocity must undo all of p: here the charge's canonical momentum, M = 1. */
AT_POINTS(forgetful)
{
    const double *p = x->p, half = *(const double *)user;
    for (int k = 0; k < x->count; ++k) {
        x->velocity[k] = p[k] + half*x->q[x->stride+k];
        x->velocity[x->stride+k] = p[x->stride+k] - half*x->q[k];
    }
    return 0;
}

TEST(velocity_counts_lagrangian_terms)
{
    static const double mass[] = { 1 };
    static const struct rotating_frame frame = { { 0, 1, 2 }, mass, 0.6 };
    static double half[] = { 0.6, 0 };
    for (int k = 0; k < 2; ++k) {
        build_own(2, rotating_frame(&frame), (gvi_mass){ .velocity = forgetful, .user = half + k });
        check();
        for (int i = 0; i < 2*k; ++i) assert_found(CHECK_VELOCITY, GVI_FAULT_MASS, "velocity", i, -1);
        assert_int_equal(report.count, 2*k);
    }
}

/* A constant matrix: which of its two triangles is meant? */
TEST(a_dense_matrix_must_be_symmetric_and_definite)
{
    double M[9] = { 2, 0.5, 0, 0.5, 3, 0.1, 0, 0.1, 1 };
    build_own(3, (gvi_effect){ 0 }, (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = M });
    assert_int_equal(check(), 0);
    M[5] = 0.2;
    check();
    assert_found(CHECK_SYMMETRY, GVI_FAULT_MASS, "mass", 1, 2);
    M[5] = M[7] = 2;
    check();
    assert_found(CHECK_DEFINITE, GVI_FAULT_MASS, "mass", 2, 2);
    assert_int_equal(report.count, 1);
}

/* g = |q|, with a slip on demand. */
static double clock_sign = 1, clock_factor = 1;

AT_POINTS(distance_clock)
{
    for (int k = 0; k < x->count; ++k) {
        double d = hypot(x->q[k], x->q[x->stride+k]);
        x->value[k] += clock_sign*d;
        x->f[k] += clock_sign*x->q[k]/d;
        x->f[x->stride+k] += clock_sign*clock_factor*x->q[x->stride+k]/d;
    }
    return 0;
}

TEST(clocks_are_checked)
{
    build_own(2, (gvi_effect){ .kind = GVI_CLOCK, .points = distance_clock }, (gvi_mass){ 0 });
    assert_int_equal(check(), 0);
    clock_factor = 1 + 1e-7;
    check();
    assert_found(CHECK_DERIVATIVE, 0, "f", 1, -1);
    assert_int_equal(report.count, 1);
    clock_factor = 1;
    clock_sign = -1;
    check();
    assert_found(CHECK_POSITIVE, 0, "value", -1, -1);
    assert_int_equal(report.count, 1);
    clock_sign = 1;
}

/* A skate: the row of velocities is no derivative, so that only numbers are to be wanted */
static gvi_real edge = 1;
static int skate(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        x->jacobian[k] = -sin(x->q[2*x->stride + k])*edge;
        x->jacobian[x->stride + k] = cos(x->q[2*x->stride + k]);
        x->rate[k] = x->t[k];
    }
    return (void)user, 0;
}

TEST(rows_of_velocities_have_to_be_numbers)
{
    const gvi_effect rows[] = { { .kind = GVI_NONHOLONOMIC, .points = skate, .rows = 1 } };
    const gvi_desc desc = { .n = 3, .effects = rows, .effect_count = 1 };
    const gvi_real q[3] = { 1, 2, 0.5 }, v[3] = { cos(0.5), sin(0.5), 1 };
    check_finding seen[9];
    check_report all = { .list = seen, .room = 9 };
    assert_int_equal(check_scene(&desc, 0, q, v, &all), 0);
    edge = NAN;
    assert_true(check_scene(&desc, 0, q, v, &all) > 0);
    assert_int_equal(seen[0].what, CHECK_REFUSED);
    edge = 1;
}

/* What gvi_init refuses is not looked at: its callbacks or rows may not be there. */
TEST(scenes_that_cannot_be_are_refused)
{
    const gvi_effect good = { .kind = GVI_POTENTIAL, .points = each, .value = each };
    gvi_effect bad[] = { good, good, good };
    const gvi_mass no_matrix = { .kind = GVI_MASS_DIAGONAL }, no_callback = { .kind = GVI_MASS_POSITION };
    bad[0].points = NULL;
    bad[1].kind = (gvi_kind)77;
    bad[2] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = each, .rows = 0x8000 };
    for (int i = 0; i < COUNT(bad); ++i) {
        build_own(2, good, (gvi_mass){ 0 });
        made.effects[0] = bad[i];
        assert_int_equal(check(), GVI_E_ARGUMENT);
        assert_int_equal(report.count, 0);
    }
    build_own(2, good, no_matrix);
    assert_int_equal(check(), GVI_E_ARGUMENT);
    build_own(2, good, no_callback);
    assert_int_equal(check(), GVI_E_ARGUMENT);
    build_own(2, good, (gvi_mass){ 0 });
    made.desc.effects = NULL;
    assert_int_equal(check(), GVI_E_ARGUMENT);
    made.desc.n = -1;
    assert_int_equal(check(), GVI_E_ARGUMENT);
}

/* Numbers that are none are findings, wherever they come from: t, q, v, g, a value, a refusal. */
AT_POINTS(refuses) { return 1; }
AT_POINTS(no_value)
{
    for (int k = 0; k < x->count; ++k) x->value[k] = NAN;
    return 0;
}

AT_POINTS(weight_force) { return x->f[0] -= 1, 0; }             // whatever q and v are
AT_POINTS(no_row)
{
    for (int k = 0; k < x->count; ++k) x->g[k] = NAN, x->jacobian[k] = 1;
    return 0;
}

AT_POINTS(unit_mass)
{
    for (int k = 0; k < x->count; ++k) x->mass[k] = 1;
    return 0;
}

TEST(what_is_not_finite_is_found)
{
    static const double none[] = { NAN, INFINITY, -INFINITY };
    static const char *const name[] = { "t", "q", "v" };
    const gvi_effect weight = { .kind = GVI_POTENTIAL, .points = weight_force };
    for (int i = 0; i < COUNT(none)*3; ++i) {
        build_own(1, weight, (gvi_mass){ 0 });
        double *at = i/COUNT(none) == 1 ? made.q : made.v, t = 0;
        if (i < COUNT(none)) at = &t;
        *at = none[i % COUNT(none)];
        assert_int_equal(check_scene(&made.desc, t, made.q, made.v, &report), 1);
        assert_found(CHECK_STATE, GVI_FAULT_NONE, name[i/COUNT(none)], i < COUNT(none) ? -1 : 0, -1);
        check_line(list, line, sizeof line);
        assert_non_null(strstr(line, "the state: "));
        assert_non_null(strstr(line, "is not finite"));
    }
    build_own(1, (gvi_effect){ .kind = GVI_POTENTIAL, .points = weight_force, .value = refuses }, (gvi_mass){ 0 });
    check();
    assert_found(CHECK_REFUSED, 0, "-dV/dq", 0, -1);
    made.effects[0].value = no_value;
    check();
    assert_found(CHECK_REFUSED, 0, "-dV/dq", 0, -1);
    build_own(1, (gvi_effect){ .kind = GVI_CONSTRAINT, .points = no_row, .rows = 1 }, (gvi_mass){ 0 });
    check();
    assert_found(CHECK_REFUSED, 0, "dg/dq", 0, 0);
    build_own(1, weight, (gvi_mass){ .kind = GVI_MASS_POSITION, .points = unit_mass, .gradient = refuses });
    check();
    assert_found(CHECK_REFUSED, GVI_FAULT_MASS, "gradient", -1, -1);
    build_own(1, weight, (gvi_mass){ 0 });
    assert_int_equal(check_scene(NULL, 0, made.q, made.v, &report), GVI_E_ARGUMENT);
    assert_int_equal(check_scene(&made.desc, 0, NULL, made.v, &report), GVI_E_ARGUMENT);
    assert_int_equal(check_scene(&made.desc, 0, made.q, NULL, &report), GVI_E_ARGUMENT);
    assert_int_equal(check_scene(&made.desc, 0, made.q, made.v, NULL), GVI_E_ARGUMENT);
}

RUN_TESTS(NULL, NULL)
