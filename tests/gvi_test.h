/* What every test includes: gvi.h with its implementation (for most compiled once and
   linked: Makefile), cmocka, and a comparison of its own (cmocka 1.1.5 compares
   doubles as floats, and accepts NaN against NaN). */
#ifndef GVI_TEST_H
#define GVI_TEST_H

#define GVI_IMPLEMENTATION
#include "gvi.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <cmocka.h>
#include <tgmath.h>
#undef I

#if GVI__KIND == 1
#define KIND 1                  /* 1 float, 2 double, 3 long double: GVI__KIND is for #if */
#define EPS FLT_EPSILON
#define MIN FLT_MIN
#define MAX FLT_MAX
#define DIG FLT_MANT_DIG
#elif GVI__KIND == 2
#define KIND 2
#define EPS DBL_EPSILON
#define MIN DBL_MIN
#define MAX DBL_MAX
#define DIG DBL_MANT_DIG
#else
#define KIND 3
#define EPS LDBL_EPSILON
#define MIN LDBL_MIN
#define MAX LDBL_MAX
#define DIG LDBL_MANT_DIG
#endif

/* TEST(name) { ... } is a test; RUN_TESTS(setup, teardown), a file's last line, runs them in their order. */
static __attribute__((unused)) struct CMUnitTest registered_tests[64];
static __attribute__((unused)) int registered_count;
#ifdef __TINYC__                        /* has no constructors: everywhere.sh lists the tests */
#define CONSTRUCTOR
static void register_tests(void);
#else
#define CONSTRUCTOR __attribute__((constructor))
#define register_tests() ((void)0)
#endif
#define TEST(name) \
    static void name(void **state); \
    static CONSTRUCTOR void name##_registers(void) \
    { registered_tests[registered_count++] = (struct CMUnitTest)cmocka_unit_test(name); } \
    static void name(__attribute__((unused)) void **state)
#define RUN_TESTS(setup, teardown) \
    int main(void) { register_tests(); return cmocka_run_group_tests(registered_tests, setup, teardown); }

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))

#ifndef OWN_REAL
typedef gvi_real real;
#define R(x) ((real)x##L)
#endif

/* Callbacks, and a loop over each coordinate at each point: f[a], q[a] */
#define AT_POINTS(name) static int name(const gvi_points *x, void *user)
#define AT_POINT(name) \
    static int name(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *f, gvi_real *dldv, void *user)
#define FOR_EACH(x, a) \
    for (int i_ = 0; i_ < (x)->n; ++i_) \
        for (int a = i_*(x)->stride, end_ = a + (x)->count; a < end_; ++a)

/* AT_EACH(name) { what x->f[a], x->q[a] is for this a } */
#define AT_EACH(name) \
    static void name##_at_each(const gvi_points *x, void *user, int a); \
    AT_POINTS(name) { FOR_EACH(x, a) name##_at_each(x, user, a); return 0; } \
    static void name##_at_each(const gvi_points *x, void *user, int a)

static __attribute__((unused)) void
check_close(long double a, long double b, long double tol, const char *what, const char *file, int line)
{
    long double d = a > b ? a - b : b - a;
    if (d <= tol) return;                         /* false for NaN */
    print_error("%s:%d: %s\n  %.21Lg\n  %.21Lg differ by %.3Lg, allowed %.3Lg\n",
                file, line, what, a, b, d, tol);
    _fail(file, line);
}

static __attribute__((unused)) void
check_between(long double lo, long double x, long double hi, const char *what, const char *file, int line)
{
    if (lo <= x && x <= hi) return;
    print_error("%s:%d: %s = %.9Lg is not in [%.9Lg, %.9Lg]\n", file, line, what, x, lo, hi);
    _fail(file, line);
}

static __attribute__((unused)) void
check_numbers(const gvi_real *a, const gvi_real *b, int count, const char *what, const char *file, int line)
{
    for (int i = 0; i < count; ++i) {
        if (a[i] == b[i] && !signbit(a[i]) == !signbit(b[i])) continue;
        print_error("%s:%d: %s, number %d\n  %.21Lg\n  %.21Lg\n", file, line, what, i, (long double)a[i], (long double)b[i]);
        _fail(file, line);
    }
}

/* |a - b| <= tol; a NaN fails. */
#define assert_close(a, b, tol) \
    check_close((long double)(a), (long double)(b), (long double)(tol), #a " against " #b, __FILE__, __LINE__)
/* lo <= x <= hi; a NaN fails. */
#define assert_between(lo, x, hi) \
    check_between((long double)(lo), (long double)(x), (long double)(hi), #x, __FILE__, __LINE__)
/* The same bits but for the padding of a long double: the same numbers with the same signs; a NaN fails. */
#define assert_same_numbers(a, b, count) check_numbers(a, b, count, #a " against " #b, __FILE__, __LINE__)
/* A status, by name in the message. */
#define assert_status(call, wanted) do { \
    gvi_status got_ = (call); \
    if (got_ != (wanted)) print_error("%s: %s\n", #call, gvi_status_text(got_)); \
    assert_int_equal(got_, (wanted)); } while (0)
#define assert_ok(call) assert_status(call, GVI_OK)

/* Reproducible numbers, the same on every machine (Knuth's MMIX): 32 bits, in (-1, 1), in (0, 1) */
static __attribute__((unused)) uint64_t dice;
static __attribute__((unused)) unsigned random_bits(void)
{
    dice = dice*6364136223846793005u + 1442695040888963407u;
    return (unsigned)(dice >> 32);
}
static __attribute__((unused)) gvi_real random_unit(void)
{
    return (gvi_real)(((long double)random_bits() - 2147483647.5L)/2147483648.0L);
}
static __attribute__((unused)) gvi_real uniform(void) { return (random_unit() + 1)/2; }

/* A stepper of this description, not started, in the next part of a ring: memory for the last few of them */
static __attribute__((unused)) gvi_stepper new_stepper(const gvi_desc *desc)
{
    static long double room[1 << 21];
    static size_t used;
    const size_t size = (gvi_size(desc) + sizeof *room - 1)/sizeof *room;
    gvi_stepper st;
    assert_between(1, size, COUNT(room)/4);
    if (used + size > COUNT(room)) used = 0;
    assert_ok(gvi_init(&st, desc, (gvi_real *)(void *)(room + used), size*sizeof *room));
    used += size;
    return st;
}

/* The same, started */
static __attribute__((unused)) gvi_stepper
new_motion(const gvi_desc *desc, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    gvi_stepper st = new_stepper(desc);
    assert_ok(gvi_start(&st, t, q, v));
    return st;
}

/* SAME_STATE(st) { ... }: t, q and p after it are those before, to the bit */
typedef struct { const gvi_stepper *st; gvi_real t, q[16], p[16]; } test_state;

static __attribute__((unused)) test_state state_now(const gvi_stepper *st)
{
    test_state s = { .st = st, .t = st->t };
    for (int i = 0; i < st->n && i < 16; ++i) s.q[i] = st->q[i], s.p[i] = st->p[i];
    return s;
}

static __attribute__((unused)) const test_state *
compare_state(const test_state *was, const char *file, int line)
{
    const test_state now = state_now(was->st);
    int same = now.t == was->t;
    for (int i = 0; i < 16; ++i) same = same && now.q[i] == was->q[i] && now.p[i] == was->p[i];
    if (!same) _fail(file, line);
    return NULL;
}
#define SAME_STATE(st) \
    for (const test_state was_ = state_now(st), *once_ = &was_; once_; once_ = compare_state(once_, __FILE__, __LINE__))

/* Both make steps of h, and agree to the bit after each */
static __attribute__((unused)) void
move_alike(gvi_stepper *a, gvi_stepper *b, int steps, gvi_real h)
{
    for (int k = 0; k < steps; ++k) {
        assert_ok(gvi_step(a, h));
        assert_ok(gvi_step(b, h));
        test_state s = state_now(a);
        s.st = b;
        compare_state(&s, __FILE__, __LINE__);
    }
}

/* Steps of h[k % m], and the same back: the largest |q - q0|, |p - p0| */
static __attribute__((unused)) gvi_real
there_and_back(gvi_stepper *st, int steps, const gvi_real *h, int m)
{
    const test_state was = state_now(st);
    gvi_real worst = 0;
    for (int k = 0; k < steps; ++k) assert_ok(gvi_step(st, h[k % m]));
    assert_true(st->q[0] != was.q[0] && st->p[0] != was.p[0]);
    for (int k = steps; k-- > 0; ) assert_ok(gvi_step(st, -h[k % m]));
    for (int i = 0; i < 2*st->n; ++i) {
        gvi_real d = i % 2 ? st->p[i/2] - was.p[i/2] : st->q[i/2] - was.q[i/2];
        if (!((d < 0 ? -d : d) <= worst)) worst = d < 0 ? -d : d;                  // keeps NaN
    }
    return worst;
}

/* q x p in a plane is kept to 2 EPS, for reading it, and a walk of `walk` EPS a step: the worst, in EPS */
static __attribute__((unused)) gvi_real
check_angular_momentum(gvi_stepper *st, int steps, gvi_real h, gvi_real walk)
{
    const gvi_real L0 = st->q[0]*st->p[1] - st->q[1]*st->p[0];
    gvi_real worst = 0;
    for (int k = 1; k <= steps; ++k) {
        assert_ok(gvi_step(st, h));
        gvi_real d = st->q[0]*st->p[1] - st->q[1]*st->p[0] - L0;
        d = d < 0 ? -d : d;
        assert_between(0, d, (2 + walk*sqrtl((long double)k))*EPS);
        worst = d > worst ? d : worst;
    }
    return worst/EPS;
}

#endif
