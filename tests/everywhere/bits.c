/* bits.c - the bits of what gvi.h computes, to be compared between machines

   Every formulation, rule and query on small scenes whose callbacks use + - * / and
   sqrt alone, which IEEE 754 rounds correctly, with constants that are quotients of
   small integers.  Prints lines "scene what numbers", each number as its bits in
   hexadecimal, most significant digit first, whatever the order of the bytes is;
   counts of steps and iterations are decimal.  In float or double.

   -DFREESTANDING takes all mathematics from freestanding.h, includes nothing that
   -ffreestanding lacks, and gives the text character by character to bits_put
   (driver.c).                                                                  */
#ifdef FREESTANDING
#include "freestanding.h"
#endif
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <stdint.h>
#ifdef FREESTANDING
extern void bits_put(int character);
extern int bits_main(void);
#else
#include <math.h>
#include <stdio.h>
#define bits_put  putchar
#define bits_main main
#endif

typedef gvi_real real;

#if GVI__KIND == 1
typedef uint32_t word;
#define DIGITS 8
#elif GVI__KIND == 2
typedef uint64_t word;
#define DIGITS 16
#else
#error "long double has another format on every machine"
#endif
#ifdef FREESTANDING
#define ROOT(x) GVI_SQRT(x)
#elif GVI__KIND == 1
#define ROOT(x) sqrtf(x)
#else
#define ROOT(x) sqrt(x)
#endif
#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))

static int failures;

static void print_text(const char *text)
{
    while (*text) bits_put(*text++);
}

static void print_count(unsigned long long count)
{
    char digits[24];
    int n = 0;
    do digits[n++] = (char)('0' + count % 10); while (count /= 10);
    bits_put(' ');
    while (n > 0) bits_put(digits[--n]);
}

static void print_bits(real x)
{
    union { real value; word bits; } both;
    both.value = x;
    bits_put(' ');
    for (int k = DIGITS - 1; k >= 0; --k) bits_put("0123456789abcdef"[both.bits >> 4*k & 15u]);
}

static void print_names(const char *scene, const char *what)
{
    print_text(scene);
    bits_put(' ');
    print_text(what);
}

static void print_line(const char *scene, const char *what, int n, const real *x)
{
    print_names(scene, what);
    for (int i = 0; i < n; ++i) print_bits(x[i]);
    bits_put('\n');
}

static void check(const char *scene, const char *what, gvi_status status)
{
    if (status == GVI_OK) return;
    print_names(scene, what);
    print_text(" failed: ");
    print_text(gvi_status_text(status));
    bits_put('\n');
    ++failures;
}

/* ------------------------------------------------------------ the effects */

static int attraction(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[d + k], d2 = X*X + Y*Y, one_over_r = 1/ROOT(d2);
        if (x->f) {
            x->f[k] -= X*one_over_r/d2;
            x->f[d + k] -= Y*one_over_r/d2;
        }
        if (x->value) x->value[k] -= one_over_r;
    }
    return (void)user, 0;
}

#define THRICE(m) m, m, m
static const real planet_mass[] = { THRICE(1), THRICE(1/(real)8), THRICE(1/(real)16) };

static void pull(const gvi_points *x, int a, int b, int k)
{
    const int d = x->stride;
    const real *p = x->q + 3*a*d + k, *q = x->q + 3*b*d + k;
    const real u = q[0] - p[0], v = q[d] - p[d], w = q[2*d] - p[2*d];
    const real d2 = u*u + v*v + w*w, m = planet_mass[3*a]*planet_mass[3*b]/ROOT(d2), s = m/d2;
    if (x->value) x->value[k] -= m;
    if (!x->f) return;
    real *f = x->f + 3*a*d + k, *g = x->f + 3*b*d + k;
    f[0] += s*u;  f[d] += s*v;  f[2*d] += s*w;
    g[0] -= s*u;  g[d] -= s*v;  g[2*d] -= s*w;
}

static int gravity(const gvi_points *x, void *user)
{
    for (int k = 0; k < x->count; ++k) {
        pull(x, 0, 1, k);
        pull(x, 0, 2, k);
        pull(x, 1, 2, k);
    }
    return (void)user, 0;
}

/* quadratic drag, and a force across the velocity as of a magnetic field */
static int drag(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real u = x->v[k], v = x->v[d + k], speed = ROOT(u*u + v*v)/64;
        x->f[k] += v/4 - speed*u;
        x->f[d + k] -= u/4 + speed*v;
    }
    return (void)user, 0;
}

/* a point on the paraboloid z = (x^2 + y^2)/2: M = 1 + q q' */
static int bowl_mass(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[d + k];
        x->mass[k] = 1 + X*X;
        x->mass[2*d + k] = X*Y;
        x->mass[3*d + k] = 1 + Y*Y;
    }
    return (void)user, 0;
}

static int bowl_gradient(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real u = x->v[k], v = x->v[d + k], along = x->q[k]*u + x->q[d + k]*v;
        x->f[k] += u*along;
        x->f[d + k] += v*along;
    }
    return (void)user, 0;
}

/* height, or any other (x^2 + y^2)/2 */
static int height(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[d + k];
        if (x->f) {
            x->f[k] -= X;
            x->f[d + k] -= Y;
        }
        if (x->value) x->value[k] += (X*X + Y*Y)/2;
    }
    return (void)user, 0;
}

/* L = 1 - sqrt(1 - v^2), one point a call */
static int relativistic(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    const real w = ROOT(1 - (v[0]*v[0] + v[1]*v[1]));
    dldv[0] += v[0]/w;
    dldv[1] += v[1]/w;
    return (void)t, (void)q, (void)f, (void)user, 0;
}

static int relativistic_value(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real u = x->v[k], v = x->v[d + k];
        x->value[k] += 1 - ROOT(1 - (u*u + v*v));
    }
    return (void)user, 0;
}

static int relativistic_hessian(real t, const real *q, const real *v, real *fq, real *fv, real *pv,
                                void *user)
{
    const real w2 = 1 - (v[0]*v[0] + v[1]*v[1]), w3 = w2*ROOT(w2);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j) pv[2*i + j] += (v[i]*v[j] + (i == j ? w2 : 0))/w3;
    return (void)t, (void)q, (void)fq, (void)fv, (void)user, 0;
}

/* the v at which dL/dv = p */
static int relativistic_velocity(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real u = x->p[k], v = x->p[d + k], w = ROOT(1 + (u*u + v*v));
        x->velocity[k] = u/w;
        x->velocity[d + k] = v/w;
    }
    return (void)user, 0;
}

/* a stiff spring of length 1 to the origin; its Hessian is left to differences */
static int stiff(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[d + k], r = ROOT(X*X + Y*Y), s = 4096*(r - 1);
        if (x->f) {
            x->f[k] -= s*X/r;
            x->f[d + k] -= s*Y/r;
        }
        if (x->value) x->value[k] += s*(r - 1)/2;
    }
    return (void)user, 0;
}

/* clock g = |q| */
static int distance(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real X = x->q[k], Y = x->q[d + k], r = ROOT(X*X + Y*Y);
        if (x->value) x->value[k] += r;
        if (x->f) {
            x->f[k] += X/r;
            x->f[d + k] += Y/r;
        }
    }
    return (void)user, 0;
}

/* ------------------------------------------------------------- the scenes */

static const gvi_effect
    kepler[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction } },
    planets[] = { { .kind = GVI_POTENTIAL, .points = gravity, .value = gravity } },
    braked[] = { { .kind = GVI_POTENTIAL, .points = height, .value = height },
                 { .kind = GVI_FORCE, .points = drag } },
    bowl[] = { { .kind = GVI_POTENTIAL, .points = height, .value = height } },
    fast[] = { { .kind = GVI_LAGRANGIAN, .point = relativistic, .value = relativistic_value },
               { .kind = GVI_POTENTIAL, .points = height, .value = height } },
    fast_known[] = { { .kind = GVI_LAGRANGIAN, .point = relativistic, .value = relativistic_value,
                       .hessian = relativistic_hessian },
                     { .kind = GVI_POTENTIAL, .points = height, .value = height } },
    bound[] = { { .kind = GVI_POTENTIAL, .points = stiff, .value = stiff } },
    timed[] = { { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
                { .kind = GVI_CLOCK, .points = distance, .value = distance } };

static const real dense[] = { 3, 0, 1, 2 };               /* lower triangle of (3 1; 1 2) */
static const real simpson[] = { 0, 1/(real)3, 2/(real)3, 1 };
static const real simpson_weights[] = { 1/(real)8, 3/(real)8, 3/(real)8, 1/(real)8 };
static const real corner[] = { 0, 1/(real)2, 1 }, kick[] = { 1/(real)6, 2/(real)3, 1/(real)6 };

#define UNIT     { GVI_MASS_UNIT, 0, 0, 0, 0, 0 }
#define DIAGONAL { GVI_MASS_DIAGONAL, planet_mass, 0, 0, 0, 0 }
#define DENSE    { GVI_MASS_DENSE, dense, 0, 0, 0, 0 }
#define BOWL     { GVI_MASS_POSITION, 0, bowl_mass, bowl_gradient, 0, 0 }
#define NONE     { GVI_MASS_NONE, 0, 0, 0, 0, 0 }
#define INVERSE  { GVI_MASS_NONE, 0, 0, 0, relativistic_velocity, 0 }
#define GAUSS(r)   { GVI_GAUSS, r, 0, 0 }
#define LOBATTO(r) { GVI_LOBATTO, r, 0, 0 }
#define SIMPSON    { GVI_OWN, 4, simpson, simpson_weights }
#define KICKS      { GVI_KICKS, 3, corner, kick }

struct start { int n; real q[9], v[9]; };
static const struct start
    ellipse = { 2, { 2/(real)5, 0 }, { 0, 2 } },
    three = { 9, { 0, 0, 0, 1, 0, 0, 0, 2, 1/(real)4 },
                 { 0, 0, 0, 0, 1, 1/(real)8, -3/(real)4, 0, 0 } },
    aside = { 2, { 3/(real)4, 1/(real)8 }, { 1/(real)16, 1/(real)2 } },
    straight = { 2, { 1, 1/(real)64 }, { 1/(real)4, 1/(real)3 } };

struct scene {
    const char         *name;
    const struct start *start;
    int                 degree;
    gvi_rule            rule;
    gvi_mass            mass;
    const gvi_effect   *effects;
    int                 count;
    gvi_formulation     formulation;
    int                 steps, per_unit;                  /* h = 1/per_unit */
};
#define EFFECTS(e) e, COUNT(e)

static const struct scene scenes[] = {
    { "positions-1",   &ellipse,  1,  GAUSS(0),    UNIT,     EFFECTS(kepler),  GVI_POSITIONS,  200, 64 },
    { "positions-2",   &ellipse,  2,  GAUSS(0),    UNIT,     EFFECTS(kepler),  GVI_POSITIONS,  200, 32 },
    { "positions-3",   &ellipse,  3,  LOBATTO(0),  UNIT,     EFFECTS(kepler),  GVI_POSITIONS,  200, 32 },
    { "positions-4",   &three,    4,  GAUSS(0),    DIAGONAL, EFFECTS(planets), GVI_POSITIONS,  200, 16 },
    { "positions-5",   &ellipse,  5,  GAUSS(0),    DENSE,    EFFECTS(bowl),    GVI_POSITIONS,  200, 8 },
    { "positions-7",   &ellipse,  5,  GAUSS(7),    UNIT,     EFFECTS(kepler),  GVI_POSITIONS,  200, 16 },
    { "positions-8",   &three,    8,  GAUSS(0),    DIAGONAL, EFFECTS(planets), GVI_POSITIONS,  200, 8 },
    { "positions-16",  &ellipse,  16, GAUSS(0),    UNIT,     EFFECTS(kepler),  GVI_POSITIONS,  100, 8 },
    { "positions-19",  &three,    17, LOBATTO(19), DIAGONAL, EFFECTS(planets), GVI_POSITIONS,  100, 8 },
    { "own",           &ellipse,  3,  SIMPSON,     UNIT,     EFFECTS(kepler),  GVI_POSITIONS,  200, 32 },
    { "velocities-2",  &aside,    2,  GAUSS(0),    UNIT,     EFFECTS(braked),  GVI_VELOCITIES, 200, 16 },
    { "velocities-4",  &aside,    4,  LOBATTO(0),  DENSE,    EFFECTS(braked),  GVI_VELOCITIES, 200, 8 },
    { "velocities-8",  &aside,    8,  GAUSS(0),    UNIT,     EFFECTS(braked),  GVI_VELOCITIES, 200, 8 },
    { "velocities-12", &aside,    12, GAUSS(0),    UNIT,     EFFECTS(braked),  GVI_VELOCITIES, 100, 8 },
    { "momenta-3",     &aside,    3,  GAUSS(0),    BOWL,     EFFECTS(bowl),    GVI_MOMENTA,    200, 16 },
    { "momenta-8",     &aside,    8,  GAUSS(0),    BOWL,     EFFECTS(bowl),    GVI_MOMENTA,    200, 8 },
    { "momenta-fast",  &aside,    6,  GAUSS(0),    INVERSE,     EFFECTS(fast),    GVI_MOMENTA,    200, 8 },
    { "newton-none",   &aside,    4,  GAUSS(0),    NONE,     EFFECTS(fast),    GVI_NEWTON,     100, 8 },
    { "newton-known",  &aside,    4,  LOBATTO(0),  NONE,     EFFECTS(fast_known), GVI_NEWTON,  100, 8 },
    { "newton-auto",   &aside,    12, GAUSS(0),    UNIT,     EFFECTS(fast_known), GVI_AUTO,    100, 8 },
    { "newton-bowl",   &aside,    3,  GAUSS(5),    BOWL,     EFFECTS(bowl),    GVI_AUTO,       100, 16 },
    { "newton-stiff",  &straight, 8,  GAUSS(0),    UNIT,     EFFECTS(bound),   GVI_AUTO,       100, 10 },
    { "verlet",        &three,    1,  LOBATTO(0),  DIAGONAL, EFFECTS(planets), GVI_EXPLICIT,   500, 64 },
    { "verlet-dense",  &ellipse,  1,  LOBATTO(0),  DENSE,    EFFECTS(bowl),    GVI_EXPLICIT,   500, 64 },
    { "kicks",         &three,    1,  KICKS,       DIAGONAL, EFFECTS(planets), GVI_EXPLICIT,   500, 64 },
    { "clock-4",       &ellipse,  4,  GAUSS(0),    UNIT,     EFFECTS(timed),   GVI_AUTO,       200, 8 },
    { "clock-8",       &ellipse,  8,  GAUSS(0),    UNIT,     EFFECTS(timed),   GVI_AUTO,       100, 4 },
};

/* ------------------------------------------------------------- what is asked */

static real memory[60000], saved[60000];

static void print_state(const char *name, const gvi_stepper *st)
{
    print_line(name, "t", 1, &st->t);
    print_line(name, "q", st->n, st->q);
    print_line(name, "p", st->n, st->p);
}

static void print_counters(const char *name, const gvi_stepper *st)
{
    const gvi_counters *c = &st->counters;
    print_names(name, "counts");
    print_count((unsigned long long)st->formulation);
    print_count(c->steps);
    print_count(c->iterations);
    print_count(c->newton_iterations);
    print_count(c->factorizations);
    bits_put('\n');
}

static void boundary_value(const char *name, gvi_stepper *st, const real *q0)
{
    real Ld = 0, d1[9], d2[9], p0[9], p1[9], q1[9];
    gvi_discrete out = { 0, 0, 0, 0, 0, 0, 0, 0, 0 };
    out.lagrangian = &Ld;
    out.d1 = d1;
    out.d2 = d2;
    out.p0 = p0;
    out.p1 = p1;
    for (int i = 0; i < st->n; ++i) q1[i] = st->q[i];
    const gvi_status status = gvi_discrete_lagrangian(st, 0, st->h, q0, q1, &out);
    if (status == GVI_E_FORMULATION || status == GVI_E_CONJUGATE) return;  /* no Newton's memory; h omega > pi */
    check(name, "boundary", status);
    print_line(name, "action", 1, &Ld);
    print_line(name, "d1", st->n, d1);
    print_line(name, "d2", st->n, d2);
}

static void queries(const char *name, gvi_stepper *st)
{
    real q[9], v[9], p[9], energy = 0, action;
    check(name, "velocity", gvi_velocity(st, v));
    print_line(name, "velocity", st->n, v);
    check(name, "energy", gvi_energy(st, &energy));
    print_line(name, "energy", 1, &energy);
    if (gvi_curve(st, 1/(real)3, q, v) == GVI_OK) {
        print_line(name, "curve", st->n, q);
        boundary_value(name, st, q);
    }
    if (gvi_state_at(st, st->t - st->h/8, q, v, p) == GVI_OK) print_line(name, "inside", st->n, q);
    if (gvi_action(st, &action) == GVI_OK) print_line(name, "sum", 1, &action);
}

static void integrate(const struct scene *it)
{
    const gvi_desc desc = {
        .n = it->start->n, .degree = it->degree, .rule = it->rule, .mass = it->mass,
        .effects = it->effects, .effect_count = it->count, .formulation = it->formulation,
    };
    const real h = 1/(real)it->per_unit;
    gvi_stepper st, copy;
    check(it->name, "init", gvi_init(&st, &desc, memory, sizeof memory));
    check(it->name, "start", gvi_start(&st, 0, it->start->q, it->start->v));
    if (st.status != GVI_OK) return;
    for (int k = 0; k < it->steps && st.status == GVI_OK; ++k) {
        check(it->name, "step", gvi_step(&st, k % 50 == 49 ? h/2 : h));     /* not all alike */
        if (k % 25 == 24) print_state(it->name, &st);
    }
    copy = st;
    for (int i = 0; i < COUNT(memory); ++i) saved[i] = memory[i];
    queries(it->name, &st);
    check(it->name, "restore", gvi_restore(&st, &copy, saved));
    check(it->name, "back", gvi_step(&st, -h));
    print_state(it->name, &st);
    print_counters(it->name, &st);
}

/* The stiff spring from 64 starts near that of the scene: its end depends on the last digits, so that one
   orbit compared says little                                                             */
static void springs(void)
{
    const gvi_desc desc = { .n = 2, .degree = 8, .effects = bound, .effect_count = 1 };
    for (int m = 0; m < 64; ++m) {
        const real q[] = { 1 + (real)(m/8)/8192, straight.q[1] };
        const real v[] = { straight.v[0] + (real)(m%8)/8192, straight.v[1] };
        gvi_stepper st;
        check("springs", "init", gvi_init(&st, &desc, memory, sizeof memory));
        check("springs", "start", gvi_start(&st, 0, q, v));
        for (int k = 0; k < 100 && st.status == GVI_OK; ++k)
            check("springs", "step", gvi_step(&st, k % 50 == 49 ? 1/(real)20 : 1/(real)10));
        print_line("springs", "p", st.n, st.p);
    }
}

/* -------------------------------------------------------- building blocks */

static void rules(void)
{
    static const int sizes[] = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 16, 25, 32, 64, 200 };
    static real c[200], b[200];
    for (int k = 0; k < COUNT(sizes); ++k) {
        const int n = sizes[k];
        check("gauss", "nodes", gvi_gauss(n, c, b));
        print_line("gauss", "nodes", n, c);
        print_line("gauss", "weights", n, b);
        if (n < 2) continue;
        check("lobatto", "nodes", gvi_lobatto(n, c, b));
        print_line("lobatto", "nodes", n, c);
        print_line("lobatto", "weights", n, b);
    }
}

static void interpolation(void)
{
    enum { N = 12 };
    real x[N], w[N], f[N], l[N], b[N], value[2];
    gvi_gauss(N, x, b);
    for (int j = 0; j < N; ++j) f[j] = 1/(1 + x[j]*x[j]);
    check("interpolation", "weights", gvi_barycentric(N, x, w));
    print_line("interpolation", "weights", N, w);
    value[0] = gvi_interpolate(N, x, w, f, 1/(real)3);
    value[1] = gvi_interpolate_derivative(N, x, w, f, 1/(real)3);
    print_line("interpolation", "values", 2, value);
    gvi_basis_derivative(N, x, w, 1/(real)7, l);
    print_line("interpolation", "basis", N, l);
}

static void linear_algebra(void)
{
    enum { N = 20 };
    static real a[N*N];
    real pivot[N + 1], x[N], work[3*N], rcond;
    for (int i = 0; i < N; ++i)
        for (int j = 0; j < N; ++j) a[i*N + j] = 1/(real)((i*7 + j*11) % 23 + 1);
    for (int i = 0; i < N; ++i) x[i] = 1/(real)(i + 1);
    check("lu", "factor", gvi_lu_factor(N, a, pivot));
    gvi_lu_solve(N, a, pivot, x);
    print_line("lu", "solution", N, x);
    rcond = gvi_lu_rcond(N, a, pivot, work);
    print_line("lu", "rcond", 1, &rcond);
}

int bits_main(void)
{
    rules();
    interpolation();
    linear_algebra();
    for (int k = 0; k < COUNT(scenes); ++k) integrate(scenes + k);
    springs();
    return failures > 0;
}
