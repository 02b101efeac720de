/* points.c - GVI_POINTS against the loop over points written by hand, and against .point

   Nanoseconds of a call at eight points, the least of 200 runs, the callbacks in turn; then of a step of Kepler's
   problem and of a pendulum, degree 8, given in the three ways.  Ratios to the loop by hand.   */
#define _POSIX_C_SOURCE 199309L
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "points.h"

#include <stdio.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
enum { RUNS = 200, CALLS = 1000, STEPS = 300 };

typedef struct callback {
    const char    *name;
    int            n;
    gvi_points_fn *made, *loop;
} callback;

static const callback callbacks[] = {
    { "Kepler, force", 2, kepler, kepler_loop },
    { "six bodies, force", 18, bodies, bodies_loop },
    { "pendulum, force", 1, pendulum, pendulum_loop },
    { "three links, mass", 3, arm_mass, arm_mass_loop },
    { "three links, gradient", 3, arm_gradient, arm_gradient_loop },
    { "relativistic, velocity", 2, relativistic, relativistic_loop },
    { "two rods, g", 4, rods, rods_loop },
    { "chain of 18, force", 18, chain, chain_loop },
};

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e9*(double)t.tv_sec + (double)t.tv_nsec;
}

static double time_of(gvi_points_fn *volatile fn, const gvi_points *x)
{
    int failed = 0;
    const double from = now();
    for (int k = 0; k < CALLS; ++k) failed |= fn(x, NULL);
    return failed ? HUGE_VAL : (now() - from)/CALLS;
}

static void compare(const callback *c)
{
    static double t[8], q[144], v[144], f[144], mass[72], velocity[24], g[16], G[64], rate[16];
    const gvi_points x = { c->n, 8, 8, t, q, v, v, strstr(c->name, "force") || strstr(c->name, "gradient") ? f : NULL, NULL,
                           NULL, strstr(c->name, "mass") ? mass : NULL, strstr(c->name, "velocity") ? velocity : NULL, g, G, rate };
    double made = HUGE_VAL, loop = HUGE_VAL;
    for (int i = 0; i < 144; ++i) q[i] = 1 + 0.1*i + 0.5*(i % 13), v[i] = 0.3 + 0.02*i/(1 + i/24);
    for (int k = 0; k < RUNS; ++k) {
        memset(f, 0, sizeof f);
        made = fmin(made, time_of(c->made, &x));
        loop = fmin(loop, time_of(c->loop, &x));
    }
    printf("%-24s %8.1f %8.1f %8.2f\n", c->name, loop, made, made/loop);
}

/* One point a call, as kicks have: the loop that most people write, which is not one over points */
static int chain_by_hand(const gvi_points *x, void *user)
{
    const double *q = x->q;
    double *f = x->f;
    const int n = x->n;
    f[0] += spring(q[1] - q[0]) - spring(q[0]);
    for (int i = 1; i < n - 1; ++i) f[i] += spring(q[i + 1] - q[i]) - spring(q[i] - q[i - 1]);
    f[n - 1] += spring(-q[n - 1]) - spring(q[n - 1] - q[n - 2]);
    return 0;
}

static void compare_one_point(void)
{
    static double q[100], f[100];
    const gvi_points x = { .n = 100, .count = 1, .stride = 1, .q = q, .f = f };
    double made = HUGE_VAL, loop = HUGE_VAL;
    for (int i = 0; i < 100; ++i) q[i] = sin(1.3*i);
    for (int k = 0; k < RUNS; ++k) {
        made = fmin(made, time_of(chain, &x));
        loop = fmin(loop, time_of(chain_by_hand, &x));
    }
    printf("%-24s %8.1f %8.1f %8.2f\n", "chain of 100, one point", loop, made, made/loop);
}

static int kepler_point(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    const double d2 = q[0]*q[0] + q[1]*q[1], w = -1/(d2*sqrt(d2));
    f[0] += w*q[0];
    f[1] += w*q[1];
    return 0;
}

static int pendulum_point(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    f[0] -= sin(q[0]);
    return 0;
}

static double step_time(const gvi_effect *effect, int n, double h)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    const gvi_desc desc = { .n = n, .degree = 8, .effects = effect, .effect_count = 1 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0.4, 0 }, (double[]){ 0, 2 });
    const double from = now();
    for (int k = 0; k < STEPS; ++k) gvi_step(&st, h);
    return st.status ? HUGE_VAL : (now() - from)/STEPS;
}

static void steps(const char *name, int n, double h, gvi_points_fn *loop, gvi_points_fn *made, gvi_point_fn *point)
{
    const gvi_effect way[] = { { .points = loop }, { .points = made }, { .point = point } };
    double best[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
    for (int k = 0; k < RUNS; ++k)
        for (int i = 0; i < 3; ++i) best[i] = fmin(best[i], step_time(way + i, n, h));
    printf("%-24s %8.0f %8.0f %8.2f %8.0f %8.2f\n", name, best[0], best[1], best[1]/best[0], best[2], best[2]/best[0]);
}

int main(void)
{
    printf("%-24s %8s %8s %8s\n", "ns a call", "by hand", "made", "ratio");
    for (int i = 0; i < COUNT(callbacks); ++i) compare(callbacks + i);
    compare_one_point();
    printf("%-24s %8s %8s %8s %8s %8s\n", "ns a step, degree 8", "by hand", "made", "ratio", ".point", "ratio");
    steps("Kepler, e = 0.6", 2, 0.1, kepler_loop, kepler, kepler_point);
    steps("pendulum", 1, 0.3, pendulum_loop, pendulum, pendulum_point);
    return 0;
}
