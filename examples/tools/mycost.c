/* mycost - what accuracy costs for a scene of your own: error against CPU time, as a table and as an SVG

     make mycost FILE=mine.c                   the picture is build/mycost.svg

   The file includes what it uses of the tools, such as "tools/effects.h", and defines

     LAGRANGIAN(mine, 2) { return ...; }       lagrangian.h; or static const gvi_desc mine = ...;
                                               or static gvi_desc mine(void) { ... return desc; }, where rows
                                               are made by functions, as those of effects.h are
     static const double mine_q[] = ..., mine_v[] = ...;     the start, at t = 0
     static const double mine_horizon = 20;    the end
     static const double mine_h = 0.1;         a step worth beginning with

   Degrees 1, 2, 4, 8 and 16 with steps of one length, each from 4 mine_h down, and the dial (desc.resolution).
   The error is that of q at the horizon, over the largest |q_i|, against degree 16 with steps of
   mine_h/2; how far that is from mine_h/3 is its own error, and no point is shown below 4 times that, or above
   1.  If all errors are large, the motion is chaotic, or the horizon is too far. */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include "tools/svg.h"
#include <stdint.h>
#include <stdlib.h>
#include <time.h>

#include MYCOST_FILE

enum { MOST = 48, DEGREES = 5 };
typedef struct point { double error, seconds; } point;

static lagrangian L;
static gvi_effect effect;

static gvi_desc of_l(const void *function)
{
    const gvi_desc none = { 0 };
    const lagrangian_function *f = function;
    const char *wrong = lagrangian_init(&L, *f, NULL, 0, mine_q, mine_v);
    if (wrong) return puts(wrong), none;
    printf("L is %s\n", lagrangian_text(&L));
    effect = lagrangian_effect(&L);
    return (gvi_desc){ .n = f->n, .mass = lagrangian_mass(&L), .effects = &effect, .effect_count = 1 };
}

static gvi_desc of_desc(const void *desc) { return *(const gvi_desc *)desc; }
static gvi_desc of_maker(const void *maker) { return ((gvi_desc (*)(void))(uintptr_t)maker)(); }

/* To the horizon, by steps of h, or with h = 0 by the dial; q [n] there. */
static gvi_status run(const gvi_desc *desc, double h, double *q, double *seconds)
{
    const size_t size = gvi_size(desc);
    double *memory = malloc(size + 1);
    gvi_stepper st;
    gvi_init(&st, desc, memory, size);
    gvi_start(&st, 0, mine_q, mine_v);
    const clock_t from = clock();
    const int steps = (int)fmax(1, ceil(mine_horizon/fmax(h, 1e-300) - 1e-6));
    for (int k = 0; k < steps && h > 0 && st.status == GVI_OK; ++k) gvi_step(&st, mine_horizon/steps);
    while (h <= 0 && st.status == GVI_OK && st.t < mine_horizon) gvi_advance(&st, mine_horizon);
    *seconds = (double)(clock() - from)/CLOCKS_PER_SEC;
    for (int i = 0; i < desc->n; ++i) q[i] = st.q[i];
    free(memory);
    return st.status;
}

static double apart(int n, const double *a, const double *b)
{
    double off = 0, size = 0;
    for (int i = 0; i < n; ++i) {
        off = fmax(off, fabs(a[i] - b[i]));
        size = fmax(size, fabs(b[i]));
    }
    return off/size;
}

/* The least time of 1/20 s of runs, three at least. */
static int measure(const gvi_desc *desc, double h, const double *right, double *q, point *p)
{
    double all = 0, seconds;
    p->seconds = HUGE_VAL;
    for (int k = 0; k < 3 || (all < 0.05 && k < 1000); ++k) {
        if (run(desc, h, q, &seconds) != GVI_OK) return 0;
        p->seconds = fmin(p->seconds, seconds);
        all += seconds;
        if (all > 3) break;
    }
    p->seconds = fmax(p->seconds, 0.5/CLOCKS_PER_SEC);
    p->error = apart(desc->n, q, right);
    return 1;
}

int main(int argc, char **argv)
{
    static const int degrees[DEGREES] = { 1, 2, 4, 8, 16 };
    static const char *const names[] = { "degree 1", "degree 2", "degree 4", "degree 8", "degree 16", "the dial" };
    static double x[DEGREES + 1][MOST], y[DEGREES + 1][MOST];
    svg_line lines[DEGREES + 1];
    int drawn = 0;
    gvi_desc desc = _Generic(&mine, const lagrangian_function *: of_l, lagrangian_function *: of_l,
                             gvi_desc (*)(void): of_maker, default: of_desc)((const void *)(uintptr_t)&mine);
    if (!desc.n) return 1;
    if (!(mine_h > 0 && mine_horizon > 0 && mine_horizon/mine_h <= 1e8))
        return puts("mine_h and mine_horizon have to be above 0, and the horizon at most 1e8 steps away"), 1;
    double *right = calloc(3*(size_t)desc.n, sizeof *right), *other = right + desc.n, *q = other + desc.n, seconds;
    desc.degree = 16;
    if (run(&desc, mine_h/2, right, &seconds) != GVI_OK || run(&desc, mine_h/3, other, &seconds) != GVI_OK)
        return puts("the steps fail: give a smaller mine_h"), 1;
    const double floor_of = fmax(4*apart(desc.n, other, right), 1e-15);
    printf("to t = %g; the reference is good to %.0e\n\n%-10s %12s %10s %12s\n", mine_horizon, floor_of/4, "", "h or dial", "error", "seconds");
    for (int d = 0; d <= DEGREES; ++d) {
        int count = 0;
        for (int k = 0; k < MOST; ++k) {
            const double dial = pow(0.1, 3 + k), h = d < DEGREES ? 4*mine_h*pow(0.5, k/2.0) : 0;
            point p;
            desc.degree = d < DEGREES ? degrees[d] : 8;
            desc.resolution = d < DEGREES ? 0 : dial;
            if (d == DEGREES && dial < 1e-15) break;
            if (!measure(&desc, h, right, q, &p)) continue;
            if (!(p.error >= floor_of)) break;
            if (p.error > 1) continue;
            printf("%-10s %12.3g %10.1e %12.3g\n", names[d], d < DEGREES ? h : dial, p.error, p.seconds);
            x[d][count] = p.seconds;
            y[d][count++] = p.error;
            if (p.seconds > 0.5) break;
        }
        if (count > 1) lines[drawn++] = (svg_line){ names[d], x[d], y[d], count };
        else printf("%-10s is not drawn: at these steps it fails, or is off by more than 1 or less than %.0e, four times the\n"
                    "           error of the reference; give a smaller mine_h or a shorter horizon\n", names[d], floor_of);
    }
    const svg_plot plot = { .title = "What accuracy costs", .x_label = "CPU time, in s", .y_label = "error of q at the end",
                            .log_x = 1, .log_y = 1, .lines = lines, .line_count = drawn };
    const char *path = argc > 1 ? argv[1] : "mycost.svg";
    if (svg_write(path, &plot)) return perror(path), 1;
    printf("\n%s\n", path);
    free(right);
    return 0;
}
