/* What the tests use of cmocka, for machines that have none: the same names, the
   same "[  PASSED  ] n test(s)." and the same return, the number that failed.
   Found before the real one by -Itests/everywhere, which everywhere.sh alone gives.
   A failed assertion goes back to the runner by longjmp; on WebAssembly, which
   has none, it ends the program.  skip() is for the test's own function.
   Prints the failures and the counts.                                          */
#ifndef GVI_EVERYWHERE_CMOCKA_H
#define GVI_EVERYWHERE_CMOCKA_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if defined(__GNUC__)
#define RUNNER_REST __attribute__((unused))
#define RUNNER_FORMAT   __attribute__((unused, format(printf, 1, 2)))
#else
#define RUNNER_REST
#define RUNNER_FORMAT
#endif

struct CMUnitTest {
    const char *name;
    void (*test)(void **state);
    int (*setup)(void **), (*teardown)(void **);      // not called: no test here has its own
    void *initial_state;
};

static struct {
    int passed, failed, skipped, skips;
#ifndef __wasm__
    jmp_buf back;
#endif
} runner;

static RUNNER_REST void runner_leave(void)
{
#ifdef __wasm__
    printf("[  PASSED  ] %d test(s).\n[  FAILED  ] 1 test(s), those after it not run.\n", runner.passed);
    exit(1);
#else
    longjmp(runner.back, 1);
#endif
}

static RUNNER_FORMAT void print_message(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
}

static RUNNER_FORMAT void print_error(const char *format, ...)
{
    va_list list;
    va_start(list, format);
    vprintf(format, list);
    va_end(list);
}

static RUNNER_REST void _fail(const char *file, int line)
{
    printf("%s:%d: failed\n", file, line);
    runner_leave();
}

static RUNNER_REST void runner_is(int holds, const char *what, const char *file, int line)
{
    if (holds) return;
    printf("does not hold: %s\n", what);
    _fail(file, line);
}

static RUNNER_REST void runner_int(long long a, long long b, int same, const char *what,
                                   const char *file, int line)
{
    if ((a == b) == same) return;
    printf("%lld and %lld: ", a, b);
    runner_is(0, what, file, line);
}

static RUNNER_REST void runner_text(const char *a, const char *b, int same, const char *what,
                                    const char *file, int line)
{
    if ((strcmp(a, b) == 0) == same) return;
    printf("\"%s\" and \"%s\": ", a, b);
    runner_is(0, what, file, line);
}

#define RUNNER_HERE            __FILE__, __LINE__
#define assert_true(c)         runner_is((c) ? 1 : 0, #c, RUNNER_HERE)
#define assert_false(c)        runner_is((c) ? 0 : 1, "!(" #c ")", RUNNER_HERE)
#define assert_null(p)         runner_is((p) == NULL, #p " == NULL", RUNNER_HERE)
#define assert_non_null(p)     runner_is((p) != NULL, #p " != NULL", RUNNER_HERE)
#define assert_ptr_equal(a, b) runner_is((const void *)(a) == (const void *)(b), #a " == " #b, RUNNER_HERE)
#define assert_int_equal(a, b) runner_int((long long)(a), (long long)(b), 1, #a " == " #b, RUNNER_HERE)
#define assert_int_not_equal(a, b)    runner_int((long long)(a), (long long)(b), 0, #a " != " #b, RUNNER_HERE)
#define assert_string_equal(a, b)     runner_text((a), (b), 1, #a " is " #b, RUNNER_HERE)
#define assert_string_not_equal(a, b) runner_text((a), (b), 0, #a " is not " #b, RUNNER_HERE)
#define assert_memory_equal(a, b, n)  runner_is(memcmp((a), (b), (n)) == 0, #a " and " #b " in memory", RUNNER_HERE)
#define fail() _fail(RUNNER_HERE)
#define fail_msg(...) do { printf(__VA_ARGS__); printf("\n"); fail(); } while (0)
#define skip() do { runner.skips = 1; return; } while (0)

static RUNNER_REST void runner_one(const struct CMUnitTest *test, void **state)
{
    runner.skips = 0;
#ifndef __wasm__
    if (setjmp(runner.back)) {
        printf("[  FAILED  ] %s\n", test->name);
        ++runner.failed;
        return;
    }
#endif
    void *own = test->initial_state;
    test->test(own ? &own : state);
    runner.skipped += runner.skips;
    runner.passed += !runner.skips;
}

static RUNNER_REST int runner_group(const struct CMUnitTest *tests, size_t count,
                                        int (*setup)(void **), int (*teardown)(void **))
{
    void *state = NULL;
    setvbuf(stdout, NULL, _IONBF, 0);
    if (setup && setup(&state)) return 1;
    for (size_t k = 0; k < count && tests[k].test; ++k) runner_one(tests + k, &state);
    if (teardown && teardown(&state)) ++runner.failed;
    printf("[  PASSED  ] %d test(s).\n", runner.passed);
    if (runner.skipped) printf("[  SKIPPED ] %d test(s).\n", runner.skipped);
    if (runner.failed) printf("[  FAILED  ] %d test(s).\n", runner.failed);
    return runner.failed;
}

#define cmocka_unit_test(f) { #f, f, NULL, NULL, NULL }
#define cmocka_run_group_tests(tests, setup, teardown) \
    runner_group(tests, sizeof(tests)/sizeof((tests)[0]), setup, teardown)

#endif
