/* splittings.h - tables of kicks, for the tests: Stoermer-Verlet, compositions of it, splittings, one that
   is not symmetric.  coefficients.h has 15 digits of most of them. */
#ifndef SPLITTINGS_H
#define SPLITTINGS_H

#include "cost/coefficients.h"

enum { MOST = 64 };
typedef struct table { const char *name; int order, r, symmetric; gvi_real c[MOST], b[MOST]; } table;

/* Verlet steps h g_1, h g_2, ...: half a kick at both ends of each, one after the other */
static void compose(table *a, int m, const long double *g)
{
    long double at = 0;
    a->r = m + 1;
    for (int j = 0; j <= m; ++j) {
        a->c[j] = j < m ? (gvi_real)at : 1;
        a->b[j] = (gvi_real)(((j > 0 ? g[j - 1] : 0) + (j < m ? g[j] : 0))/2);
        if (j < m) at += g[j];
    }
}

/* Symmetric composition from its first half; the middle one closes the sum to 1 */
static void compose_half(table *a, int half, const long double *g)
{
    long double all[MOST], sum = 0;
    for (int j = 0; j < half; ++j) sum += all[j] = all[2*half - j] = g[j];
    all[half] = 1 - 2*sum;
    compose(a, 2*half + 1, all);
}

/* Symmetric splitting from the first halves of its kicks and drifts; `drift_first` has
   one drift more before the first kick */
static void split(table *a, int kicks, const long double *b, const long double *drifts, int drift_first)
{
    long double at = 0;
    a->r = 2*kicks;
    for (int j = 0; j < kicks; ++j) {
        if (drift_first) at += drifts[j];
        a->c[j] = (gvi_real)at;
        a->b[j] = a->b[2*kicks - 1 - j] = (gvi_real)b[j];
        a->c[2*kicks - 1 - j] = (gvi_real)(1 - at);
        if (!drift_first && j < kicks - 1) at += drifts[j];
    }
}

/* The same with a kick in the middle, which closes the sum to 1; kick first */
static void split_about(table *a, int half, const long double *b, const long double *drifts)
{
    long double at = 0, sum = 0;
    a->r = 2*half + 1;
    for (int j = 0; j < half; ++j) {
        a->c[j] = (gvi_real)at;
        a->c[2*half - j] = (gvi_real)(1 - at);
        sum += a->b[j] = a->b[2*half - j] = (gvi_real)b[j];
        if (j < half - 1) at += drifts[j];
    }
    a->c[half] = 0.5L;
    a->b[half] = (gvi_real)(1 - 2*sum);
}

static const table *tables(int *count)
{
    static table all[9];
    const long double root = cbrtl(2), five = 1/(4 - cbrtl(4));
    const long double yoshida4[] = { 1/(2 - root), -root/(2 - root), 1/(2 - root) };
    const long double suzuki4[] = { five, five, 1 - 4*five, five, five }, one[] = { 1 };
    long double b[7], sum = 0;
    *count = COUNT(all);
    if (all[0].r) return all;
    all[0] = (table){ "Stoermer-Verlet", 2, 0, 1, { 0 }, { 0 } };
    compose(&all[0], 1, one);
    all[1] = (table){ "Yoshida 4", 4, 0, 1, { 0 }, { 0 } };
    compose(&all[1], 3, yoshida4);
    all[2] = (table){ "Suzuki 4", 4, 0, 1, { 0 }, { 0 } };
    compose(&all[2], 5, suzuki4);
    all[3] = (table){ "Kahan-Li 8", 8, 0, 1, { 0 }, { 0 } };
    compose_half(&all[3], COUNT(kahan_li8), kahan_li8);

    all[4] = (table){ "Blanes-Moan 11", 6, 0, 1, { 0 }, { 0 } };
    for (int j = 0; j < 5; ++j) sum += b[j] = blanes_moan11_b[j];
    b[5] = 0.5L - sum;
    split(&all[4], 6, b, blanes_moan11_a, 0);
    all[5] = (table){ "Blanes-Moan 14, drift first", 6, 0, 1, { 0 }, { 0 } };
    sum = 0;
    for (int j = 0; j < 6; ++j) sum += b[j] = blanes_moan14_b[j];
    b[6] = 0.5L - sum;
    split(&all[5], 7, b, blanes_moan14_a, 1);

    // Ruth 1983: back to the first node for the last kick
    all[7] = (table){ "of order 8, 22 kicks", 8, 0, 1, { 0 }, { 0 } };
    split_about(&all[7], COUNT(splitting8_b), splitting8_b, splitting8_a);
    all[6] = (table){ "Ruth 3", 3, 3, 0, { 0, 2/(gvi_real)3, 0 },
                      { 7/(gvi_real)24, 3/(gvi_real)4, -1/(gvi_real)24 } };
    all[8] = (table){ "symplectic Euler, drift first", 1, 1, 0, { 1 }, { 1 } };
    return all;
}

#endif
