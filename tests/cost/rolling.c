/* rolling.c - what a rolling disc costs: gvi.h, DOP853 on quasi-velocities, methods of order 2

   A disc of mass and radius 1 that falls and rises, T = 10 (the start of tests/test_rolling.c).  gvi.h takes M(q) and
   the two rows as they are.  DOP853 and the midpoint rule integrate what is left after the rows are eliminated by hand, five
   first-order equations for tilt and rates and three quadratures (x, y, yaw, spin are functions of them):

     3/2 n' = f t sin,   (sin f)' /4 = t n/2 - t f cos/4,   5/4 t' = f f sin cos/4 - 3/2 n f sin - g cos      n = spin + f cos

   They need that elimination, keep no row but by it, and know no force.  The midpoint rule is symmetric, as is RATTLE's
   step, which is gvi.h with degree 1 and Lobatto's two points.  Reference: DOP853 in long double.  CPU time, best of several;
   a dash: not within eight seconds.

     rolling                                                                                               */
#define GVI_STATIC
#define main lesson_43
#include "43_coin.c"
#undef main
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include "coefficients.h"

static const double T = 10;

/* x, y, yaw, tilt, spin, and f, t, n */
#define RATE(name, type, SIN, COS)                                                             \
    static inline void name(const type *y, type *dy)                                            \
    {                                                                                           \
        const type s = SIN(y[3]), c = COS(y[3]), S = SIN(y[2]), C = COS(y[2]), f = y[5], t = y[6], n = y[7]; \
        dy[0] = -n*C + s*t*S;                                                                   \
        dy[1] = -n*S - s*t*C;                                                                   \
        dy[2] = f;                                                                              \
        dy[3] = t;                                                                              \
        dy[4] = n - c*f;                                                                        \
        dy[5] = (2*t*n - 2*t*f*c)/s;                                                            \
        dy[6] = (f*f*s*c/4 - (type)1.5*n*f*s - (type)9.81L*c)/(type)1.25;                       \
        dy[7] = f*t*s/(type)1.5;                                                                \
    }
RATE(rate, double, sin, cos)
RATE(exact_rate, long double, sinl, cosl)

#define DOP853(name, type, at)                                                                  \
    static void name(int steps, type *y, const type (*a)[12], const type *b)                    \
    {                                                                                           \
        const type h = (type)T/(type)steps;                                                     \
        type K[12][8], x[8];                                                                    \
        for (int k = 0; k < steps; ++k) {                                                       \
            for (int i = 0; i < 12; ++i) {                                                      \
                memcpy(x, y, sizeof x);                                                         \
                for (int j = 0; j < i; ++j)                                                     \
                    for (int l = 0; l < 8; ++l) x[l] += h*a[i][j]*K[j][l];                      \
                at(x, K[i]);                                                                    \
            }                                                                                   \
            for (int j = 0; j < 12; ++j)                                                        \
                for (int l = 0; l < 8; ++l) y[l] += h*b[j]*K[j][l];                             \
        }                                                                                       \
    }
DOP853(dop853, double, rate)
DOP853(exact_dop853, long double, exact_rate)

static void midpoint(int steps, double *y)
{
    const double h = T/steps;
    double d[8];
    rate(y, d);
    for (int k = 0; k < steps; ++k) {
        for (int j = 0; j < 50; ++j) {
            double x[8], was[8], change = 0;
            memcpy(was, d, sizeof was);
            for (int i = 0; i < 8; ++i) x[i] = y[i] + h/2*d[i];
            rate(x, d);
            for (int i = 0; i < 8; ++i) change = fmax(change, fabs(d[i] - was[i]));
            if (h*change < 1e-15) break;
        }
        for (int i = 0; i < 8; ++i) y[i] += h*d[i];
    }
}

/* ---- gvi.h: mass, gradient, weight and rows of examples/43_coin.c ---- */

static int by_gvi(int degree, int steps, double *y)
{
    static double memory[60000];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_NONHOLONOMIC, .points = rolls, .rows = 2 } };
    const gvi_desc desc = { .n = 5, .degree = degree, .effects = scene, .effect_count = 2,
                            .rule = { .kind = degree == 1 ? GVI_LOBATTO : GVI_GAUSS },
                            .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = slope } };
    double d[8], v[5];
    gvi_stepper st;
    rate(y, d);
    for (int i = 0; i < 5; ++i) v[i] = d[i];
    if (gvi_init(&st, &desc, memory, sizeof memory) || gvi_start(&st, 0, y, v)) return 0;
    for (int k = 0; k < steps && st.status == GVI_OK; ++k) gvi_step(&st, T/steps);
    for (int i = 0; i < 5; ++i) y[i] = st.q[i];
    return st.status == GVI_OK;
}

/* ---- the table ---- */

enum { GVI1, GVI4, GVI6, GVI8, MIDPOINT, DOP, METHODS };
static const char *const names[METHODS] = { "gvi.h 1, Lobatto 2: RATTLE's", "gvi.h 4", "gvi.h 6", "gvi.h 8",
                                            "midpoint rule, reduced", "DOP853, reduced" };
static const double start[8] = { 0, 0, 0, 1.2, 0, 0.6, 0.1, -6 };
static double table_a[12][12], table_b[12];

static int run(int method, int steps, double *y)
{
    memcpy(y, start, sizeof start);
    y[7] += cos(y[3])*y[5];
    if (method < MIDPOINT) return by_gvi(method == GVI1 ? 1 : 2 + 2*method, steps, y);
    if (method == MIDPOINT) midpoint(steps, y);
    else dop853(steps, y, (const double (*)[12])table_a, table_b);
    return 1;
}

int main(void)
{
    static const double wanted[] = { 1e-4, 1e-7, 1e-10, 1e-12 };
    long double known[8];
    for (int i = 0; i < 8; ++i) known[i] = (long double)start[i];
    known[3] = 1.2;
    known[7] += cosl(known[3])*known[5];
    exact_dop853(20000, known, dop853_table.A, dop853_table.b);
    for (int i = 0; i < 12; ++i) {
        table_b[i] = (double)dop853_table.b[i];
        for (int j = 0; j < 12; ++j) table_a[i][j] = (double)dop853_table.A[i][j];
    }
    printf("rolling disc, T = 10: CPU milliseconds to an error of\n%-32s", "");
    for (int w = 0; w < 4; ++w) printf("%9.0e", wanted[w]);
    puts("");
    for (int method = 0; method < METHODS; ++method) {
        double need[4] = { HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL };
        for (int N = 20, spent = 0; N < 4000000 && need[3] > 1e9 && spent < 8000; N += N/4) {
            double y[8], error = 0, best = HUGE_VAL, total = 0;
            if (!run(method, N, y)) continue;
            for (int i = 0; i < 5; ++i) error = fabs(y[i] - (double)known[i]) <= error ? error : fabs(y[i] - (double)known[i]);
            if (!(error <= wanted[0])) continue;
            for (int k = 0; k < 50 && (k < 5 || total < 50); ++k) {
                const clock_t t0 = clock();
                run(method, N, y);
                const double time = 1000*(double)(clock() - t0)/CLOCKS_PER_SEC;
                best = fmin(best, time);
                total += time;
            }
            for (int w = 0; w < 4; ++w)
                if (error <= wanted[w]) need[w] = fmin(need[w], best);
            spent += (int)total;
        }
        printf("%-32s", names[method]);
        for (int w = 0; w < 4; ++w)
            if (need[w] < 1e9) printf("%9.3f", need[w]);
            else printf("%9s", "-");
        puts("");
        fflush(stdout);
    }
    return 0;
}
