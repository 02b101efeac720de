/* scaling.c - time and memory against degree s, coordinates n and quadrature points r

     scaling [--quick] [--out DIR]

   A chain of n masses, springs d + d^3 between neighbours and walls, set off in one long wave, in
   the formulation by positions: a sparse effect, so that the cost is to be linear in n.  An iteration
   multiplies n rows by a table of r*r numbers, so it should grow like n r^2 where the table is what
   counts, like n r where the effect is.  Rows are padded to whole vectors of eight points.
   Time: CPU, best of several runs, per iteration and per step; iterations a step are beside it;
   and of gvi_init.
   Exponents: least squares through logarithms, over the part that is named.
   Written: DIR/scaling.csv, scaling-n.svg, scaling-s.svg.                                      */
#define _POSIX_C_SOURCE 200809L
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
#if defined(__GNUC__) && !defined(__clang__)
#define INDEPENDENT _Pragma("GCC ivdep")
#else
#define INDEPENDENT
#endif
enum { MOST = 10000, LINES = 3, SAMPLES = 16 };

/* ---------------------------------------------------------------- the chain */

/* Bond from coordinate i - 1 to i, at all points; walls hold still                              */
static void bond(const gvi_points *x, int i)
{
    const int R = x->stride, count = x->count;
    const double *a = x->q + (i - 1)*R, *b = a + R;
    double *left = x->f + (i - 1)*R, *right = left + R;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double d = b[k] - a[k], pull = d + d*d*d;
        left[k] += pull;
        right[k] -= pull;
    }
}

static void wall(const gvi_points *x, int i)
{
    const int count = x->count;
    const double *q = x->q + i*x->stride;
    double *f = x->f + i*x->stride;
    INDEPENDENT for (int k = 0; k < count; ++k) f[k] -= q[k] + q[k]*q[k]*q[k];
}

static int chain(const gvi_points *x, void *user)
{
    for (int i = 1; i < x->n; ++i) bond(x, i);
    wall(x, 0);
    wall(x, x->n - 1);
    return 0;
}

/* ---------------------------------------------------------------- one sample */

typedef struct sample {
    const char *sweep;
    int         s, n, r;
    double      step, iteration, iterations, bytes, init;    /* ns, ns, a step, in all, ns       */
} sample;

static double cpu_ns(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e9 + (double)t.tv_nsec;
}

/* The best of `runs` runs of so many steps that each takes about a millisecond or more.  The first
   steps, which extrapolate from nothing, are not timed.                                        */
static void time_steps(gvi_stepper *st, int runs, sample *m)
{
    enum { WARM = 8 };
    const double h = 0.1;
    long steps = 4;
    for (int k = 0; k < WARM; ++k) gvi_step(st, h);
    m->step = HUGE_VAL;
    for (int k = 0; k < runs;) {
        const unsigned long long before = st->counters.iterations;
        double begin = cpu_ns(), time;
        for (long i = 0; i < steps; ++i) gvi_step(st, h);
        time = cpu_ns() - begin;
        if (time < 1e6 && steps < 100000) { steps *= 2; continue; }
        ++k;
        if (!(time/(double)steps < m->step)) continue;
        m->step = time/(double)steps;
        m->iterations = (double)(st->counters.iterations - before)/(double)steps;
        m->iteration = m->step/m->iterations;
    }
}

/* Returns 0, or a status that is printed.                                                     */
static int measure(int runs, sample *m)
{
    static double q[MOST], v[MOST];
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = chain } };
    const gvi_desc desc = { .n = m->n, .degree = m->s, .rule = { .points = m->r }, .effects = scene,
                            .effect_count = 1, .formulation = GVI_POSITIONS };
    const size_t size = gvi_size(&desc);
    double *memory = malloc(size);
    gvi_stepper st;
    for (int i = 0; i < m->n; ++i) q[i] = sin(3.14159265358979324*(i + 1)/(m->n + 1));
    m->bytes = (double)size;
    m->init = HUGE_VAL;
    for (int k = 0; k < 2*runs; ++k) {
        const double begin = cpu_ns();
        gvi_init(&st, &desc, memory, size);
        m->init = fmin(m->init, cpu_ns() - begin);
    }
    gvi_start(&st, 0, q, v);
    if (st.status == GVI_OK) time_steps(&st, runs, m);
    free(memory);
    if (st.status == GVI_OK) return 0;
    fprintf(stderr, "s = %d, n = %d, r = %d: %s\n", m->s, m->n, m->r, gvi_status_text(st.status));
    return 1;
}

/* ---------------------------------------------------------------- sweeps */

typedef struct sweep {
    const char *name, *varied;
    int         count, values[SAMPLES];
    const char *labels[LINES];
    int         fixed[LINES], from;          /* the exponent is fitted from here on             */
} sweep;

static const sweep sweeps[] = {
    { "n", "coordinates, r = s", 13, { 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000 },
      { "s = 4", "s = 8", "s = 16" }, { 4, 8, 16 }, 100 },
    { "s", "degree, r = s", 16, { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16 },
      { "n = 10", "n = 100", "n = 1000" }, { 10, 100, 1000 }, 8 },
    { "r", "points, s = 8", 5, { 8, 9, 10, 11, 12 },
      { "n = 10", "n = 100", "n = 1000" }, { 10, 100, 1000 }, 8 } };

static sample sample_of(const sweep *w, int line, int k)
{
    sample m = { .sweep = w->name, .n = w->fixed[line], .s = 8 };
    switch (*w->name) {
    case 'n': m.s = w->fixed[line]; m.n = w->values[k]; m.r = m.s; break;
    case 's': m.s = w->values[k]; m.r = m.s; break;
    default:  m.r = w->values[k];
    }
    return m;
}

/* Slope of log y over log x                                                                   */
static double exponent(int count, const double *x, const double *y, double from)
{
    double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (int k = 0; k < count; ++k) {
        if (x[k] < from) continue;
        double a = log(x[k]), b = log(y[k]);
        n += 1;
        sx += a;
        sy += b;
        sxx += a*a;
        sxy += a*b;
    }
    return (n*sxy - sx*sy)/(n*sxx - sx*sx);
}

typedef struct curves { double x[SAMPLES], time[LINES][SAMPLES], bytes[LINES][SAMPLES]; } curves;

static void print_sample(FILE *csv, const sample *m)
{
    printf("  %3d %6d %3d %12.1f %8.2f %12.1f %11.3f %14.0f %10.1f %9.1f\n", m->s, m->n, m->r, m->step*1e-3,
           m->iterations, m->iteration, m->iteration/m->n/m->r, m->bytes, m->bytes/m->n, m->init*1e-3);
    if (csv)
        fprintf(csv, "%s,%d,%d,%d,%.3f,%.4f,%.3f,%.0f,%.2f,%.0f\n", m->sweep, m->s, m->n, m->r, m->step,
                m->iterations, m->iteration, m->bytes, m->bytes/m->n, m->init);
}

static int run_sweep(const sweep *w, int runs, FILE *csv, curves *c)
{
    int failed = 0;
    printf("\nOver %s: %s\n  %3s %6s %3s %12s %8s %12s %11s %14s %10s %9s\n", w->name, w->varied, "s", "n", "r",
           "us a step", "it", "ns an it", "ns/(n r)", "bytes", "bytes/n", "us set-up");
    for (int line = 0; line < LINES; ++line)
        for (int k = 0; k < w->count; ++k) {
            sample m = sample_of(w, line, k);
            failed |= measure(runs, &m);
            print_sample(csv, &m);
            c->x[k] = w->values[k];
            c->time[line][k] = m.iteration;
            c->bytes[line][k] = m.bytes/m.n;
        }
    for (int line = 0; line < LINES; ++line)
        printf("  %-9s time of an iteration ~ %s^%.2f from %s = %d on\n", w->labels[line], w->name,
               exponent(w->count, c->x, c->time[line], w->from), w->name, w->from);
    return failed;
}

/* ---------------------------------------------------------------- pictures */

static void lines_of(const sweep *w, const curves *c, int bytes, svg_line *lines)
{
    for (int i = 0; i < LINES; ++i) {
        svg_line line = { w->labels[i], c->x, bytes ? c->bytes[i] : c->time[i], w->count };
        lines[i] = line;
    }
}

static int draw(const char *out, const curves *c)
{
    svg_line time[LINES], memory[LINES], degree[LINES], points[LINES];
    char path[512];
    lines_of(sweeps, c, 0, time);
    lines_of(sweeps, c, 1, memory);
    lines_of(sweeps + 1, c + 1, 0, degree);
    lines_of(sweeps + 2, c + 2, 0, points);
    const svg_plot by_n[2] = {
        { .title = "A chain of n masses", .x_label = "n", .y_label = "ns for an iteration", .log_x = 1, .log_y = 1, .lines = time, .line_count = LINES },
        { .title = "", .x_label = "n", .y_label = "bytes of memory per coordinate", .log_x = 1, .log_y = 1, .lines = memory, .line_count = LINES } };
    const svg_plot by_s[2] = {
        { .title = "A chain of n masses, r = s", .x_label = "s", .y_label = "ns for an iteration", .log_x = 1, .log_y = 1, .lines = degree, .line_count = LINES },
        { .title = "s = 8", .x_label = "r", .y_label = "ns for an iteration", .log_x = 1, .log_y = 1, .lines = points, .line_count = LINES } };
    snprintf(path, sizeof path, "%s/scaling-n.svg", out);
    if (svg_write_all(path, by_n, 2, 360)) return perror(path), 1;
    snprintf(path, sizeof path, "%s/scaling-s.svg", out);
    if (svg_write_all(path, by_s, 2, 360)) return perror(path), 1;
    return 0;
}

int main(int argc, char **argv)
{
    static curves c[COUNT(sweeps)];
    const char *out = ".";
    char path[512];
    int runs = 7, failed = 0;
    for (int i = 1; i < argc; ++i) {
        if (!strcmp(argv[i], "--quick")) runs = 3;
        else if (!strcmp(argv[i], "--out") && i + 1 < argc) out = argv[++i];
        else return fputs("scaling [--quick] [--out DIR]\n", stderr), 2;
    }
    snprintf(path, sizeof path, "%s/scaling.csv", out);
    FILE *csv = fopen(path, "w");
    if (!csv) return perror(path), 1;
    fprintf(csv, "sweep,s,n,r,ns_per_step,iterations,ns_per_iteration,bytes,bytes_per_n,ns_set_up\n");
    for (int i = 0; i < COUNT(sweeps); ++i) failed |= run_sweep(sweeps + i, runs, csv, c + i);
    failed |= draw(out, c);
    return fclose(csv) || failed;
}
