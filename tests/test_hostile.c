/* Random scenes with callbacks that lie, overflow and refuse, sizes and steps that make no sense:
   what `make fuzz` does, from random bytes and with guarded memory. Whatever happens, every call
   returns after a bounded amount of work with a status from the list; a failure leaves the state as
   it was; a success leaves finite numbers; and nothing outside the memory is touched. */
#define GVI_REAL double
#define PAD 16
#include "gvi_test.h"
#include "tools/ensemble.h"
#include "tools/animate.h"
#include "fuzz/fuzz_scene.c"
#include <limits.h>

enum { SCENES = 20000, BYTES = 800 };

TEST(whatever_a_scene_does_every_call_ends_well)
{
    for (int number = 0; number < SCENES; ++number) {
        uint64_t seed = 1000003u*(uint64_t)number + 17;         /* Knuth's MMIX */
        uint8_t bytes[BYTES];
        for (int k = 0; k < BYTES; ++k) {
            seed = seed*6364136223846793005u + 1442695040888963407u;
            bytes[k] = (uint8_t)(seed >> 56);
        }
        LLVMFuzzerTestOneInput(bytes, sizeof bytes);
    }
    assert_true(started > SCENES/5);                             /* the menu is not all poison */
    assert_true(succeeded > SCENES/2);
}

/* No product of sizes may wrap round to a small one */
TEST(sizes_that_no_machine_has_are_refused)
{
    static const int sizes[] = { 1, 2, 1000, 1024, 4096, 65536, 0xFFFFFF, INT_MAX/2, INT_MAX };
    static const gvi_effect one[] = { { .kind = GVI_FORCE, .points = points } };
    static double little[64];
    for (int i = 0; i < COUNT(sizes); ++i)
    for (int j = 0; j < COUNT(sizes); ++j)
    for (int k = 0; k < COUNT(sizes); ++k)
    for (int formulation = GVI_AUTO; formulation <= GVI_NEWTON; ++formulation) {
        const gvi_desc desc = { .n = sizes[i], .degree = sizes[j], .rule = { .points = sizes[k] },
                                .effects = one, .effect_count = 1, .formulation = (gvi_formulation)formulation };
        gvi_stepper st;
        size_t size = gvi_size(&desc);
        double least = (double)sizes[i]*sizes[k]*sizeof(double);           /* one row for each coordinate */
        if (size == 0) assert_true(gvi_init(&st, &desc, little, sizeof little) != GVI_OK);
        else assert_true((double)size >= least);
        if (size > sizeof little) assert_status(gvi_init(&st, &desc, little, sizeof little), GVI_E_MEMORY);
    }
}

static void count_runs(int k, void *result, void *user) { *(int *)result = k + 1; ++*(int *)user; }

TEST(an_ensemble_ends_whatever_its_chunks)
{
    static const int chunks[] = { -1, 0, 1, 3, 100 };
    for (int i = 0; i < COUNT(chunks); ++i) {
        int result[10] = { 0 }, runs = 0;
        ensemble_run(-1, chunks[i], sizeof result[0], count_runs, &runs, result);
        assert_int_equal(runs, 0);
        ensemble_run(COUNT(result), chunks[i], sizeof result[0], count_runs, &runs, result);
        assert_int_equal(runs, COUNT(result));
        for (int k = 0; k < COUNT(result); ++k) assert_int_equal(result[k], k + 1);
    }
}

/* Ticks that are closer than doubles are, and films of nothing */
TEST(pictures_end_whatever_they_show)
{
    static const double x[] = { 0, 1 }, steps[] = { 0, -1, 1e-300, 1e-6, NAN, INFINITY },
                        heights[] = { 0, 9e15, -9e15, 1e17, 1e300, DBL_MAX, 5e-324, NAN, INFINITY };
    for (int i = 0; i < COUNT(heights); ++i)
        for (int k = 0; k < 4*COUNT(steps); ++k) {
            const double y[] = { heights[i], k & 1 ? -heights[i] : heights[i] };
            const svg_line line = { "", x, y, 2 };
            const svg_plot plot = { .title = "", .x_label = "", .y_label = "", .log_y = k & 2, .lines = &line, .line_count = 1,
                                    .x_step = steps[k/4] };
            assert_int_equal(svg_write("/dev/null", &plot), 0);
        }
    const animation film = { .title = "", .caption = "", .points = 1, .samples = 2, .xy = (double[]){ 0, 0, 1, 1 }, .t = x, .every = 1,
                             .seconds = 1, .sizes = x, .plots = { { .title = "", .x_label = "" }, { .title = "", .x_label = "" } } };
    assert_int_equal(animate_write("/dev/null", &film), 0);
    for (int i = 0; i < 5; ++i) {
        animation none = film;
        if (i == 0) none.every = 0;
        if (i == 1) none.samples = 0;
        if (i == 2) none.points = 0;
        if (i > 2) none.seconds = i == 3 ? 0 : NAN;
        assert_int_equal(animate_write("/dev/null", &none), -1);
    }
}

RUN_TESTS(NULL, NULL)
