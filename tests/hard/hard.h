/* hard.h - what the long studies of docs/hard-cases.md share

   gvi.h, a number of bounds that are met or missed, progress on stderr where it is
   a terminal, random numbers that are the same everywhere, straight lines, springs, and
   a state with all its digits.                                                  */
#ifndef HARD_H
#define HARD_H

#define _POSIX_C_SOURCE 200809L                   /* isatty */

#ifndef GVI_REAL
#define GVI_REAL double
#endif
#define GVI_IMPLEMENTATION
#include "gvi.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define HARD_MAYBE __attribute__((unused)) static
#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))

typedef gvi_real real;
#if GVI__KIND == 1
#define EPS FLT_EPSILON
#elif GVI__KIND == 2
#define EPS DBL_EPSILON
#else
#define EPS LDBL_EPSILON
#endif

static int misses;

/* Prints a figure with its bounds; NaN is a miss */
HARD_MAYBE void expect(const char *what, double lo, double x, double hi)
{
    const int good = lo <= x && x <= hi;
    printf("  %-58s %10.3g   %s\n", what, x, good ? "ok" : "FAILED");
    if (!good) printf("      wanted from %.3g to %.3g\n", lo, hi);
    misses += !good;
    fflush(stdout);
}

HARD_MAYBE int verdict(const char *name)
{
    printf("%s: %s, %.1f s\n", name, misses ? "FAILED" : "ok", (double)clock()/CLOCKS_PER_SEC);
    return misses > 0;
}

/* Ends the program: what follows would mean nothing */
HARD_MAYBE void must(gvi_status status)
{
    if (status == GVI_OK) return;
    printf("  FAILED: %s\n", gvi_status_text(status));
    exit(1);
}

HARD_MAYBE void progress(const char *what, long done, long all)
{
    if (isatty(2)) fprintf(stderr, "\r  %s: %3ld %%%s", what, 100*done/all, done == all ? "\r\033[K" : "");
}

/* Uniform in [-1, 1) (Knuth's MMIX) */
HARD_MAYBE uint64_t seed = 1;
HARD_MAYBE double uniform(void)
{
    seed = seed*6364136223846793005u + 1442695040888963407u;
    return (double)(seed >> 33)/1073741824.0 - 1;
}

/* Least squares: slope of y over x and its standard error */
HARD_MAYBE double slope_of(int n, const double *x, const double *y, double *error)
{
    double mx = 0, my = 0, sxy = 0, sxx = 0, rest = 0;
    for (int k = 0; k < n; ++k) { mx += x[k]/n; my += y[k]/n; }
    for (int k = 0; k < n; ++k) { sxy += (x[k] - mx)*(y[k] - my); sxx += (x[k] - mx)*(x[k] - mx); }
    for (int k = 0; k < n; ++k) {
        const double d = y[k] - my - sxy/sxx*(x[k] - mx);
        rest += d*d;
    }
    if (error) *error = sqrt(rest/(n - 2)/sxx);
    return sxy/sxx;
}

/* A spring to 0 for each coordinate; user: real[n], their stiffness */
HARD_MAYBE int springs(const gvi_points *x, void *user)
{
    const real *stiff = user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= stiff[i]*x->q[i*x->stride + k];
    return 0;
}

/* q and p with what rounding left of them, which the stepper carries: else reading an
   energy would be as wrong as some 1000 steps                                 */
HARD_MAYBE void read_state(const gvi_stepper *st, long double *q, long double *p)
{
    for (int i = 0; i < st->n; ++i) {
        q[i] = (long double)st->q[i] + (long double)st->q_low[i];
        p[i] = (long double)st->p[i] + (long double)st->p_low[i];
    }
}

#endif
