/* extrapolate.h - solutions to rounding by a method that shares nothing with gvi.h

   Gragg's modified midpoint rule, extrapolated in h^2 with Bulirsch's sequence
   (Hairer, Norsett, Wanner: Solving ordinary differential equations I, II.9), of
   order 16 (twice EXTRAPOLATE_COLUMNS); increments throughout and Kahan's summation, so that what rounding
   leaves is a few units of the last place of y a step.  For a floating-point type
   `real` and at most EXTRAPOLATE_MOST unknowns.                               */
#ifndef EXTRAPOLATE_H
#define EXTRAPOLATE_H

#ifndef EXTRAPOLATE_MOST
#define EXTRAPOLATE_MOST 16
#endif
#ifndef EXTRAPOLATE_COLUMNS
#define EXTRAPOLATE_COLUMNS 8
#endif

typedef void rates_fn(real t, const real *y, real *dy, void *user);
typedef struct motion { int n; rates_fn *rates; void *user; } motion;

static void midpoints(const motion *a, real t, real H, int m, const real *y, real *out)
{
    real now[EXTRAPOLATE_MOST], old[EXTRAPOLATE_MOST], d[EXTRAPOLATE_MOST], x[EXTRAPOLATE_MOST];
    const real h = H/(real)m;
    a->rates(t, y, d, a->user);
    for (int i = 0; i < a->n; ++i) { old[i] = 0; now[i] = h*d[i]; }
    for (int k = 1; k <= m; ++k) {
        for (int i = 0; i < a->n; ++i) x[i] = y[i] + now[i];
        a->rates(t + (real)k*h, x, d, a->user);
        if (k == m) break;
        for (int i = 0; i < a->n; ++i) {
            real next = old[i] + 2*h*d[i];
            old[i] = now[i];
            now[i] = next;
        }
    }
    for (int i = 0; i < a->n; ++i) out[i] = (old[i] + now[i] + h*d[i])/2;
}

/* The increment of y over H */
static void extrapolate(const motion *a, real t, real H, const real *y, real *increment)
{
    static const int substeps[] = { 2, 4, 6, 8, 12, 16, 24, 32, 48, 64 };
    real table[EXTRAPOLATE_COLUMNS][EXTRAPOLATE_MOST];
    for (int j = 0; j < EXTRAPOLATE_COLUMNS; ++j) {
        midpoints(a, t, H, substeps[j], y, table[j]);
        for (int k = j; k-- > 0; ) {
            const real ratio = (real)substeps[j]/(real)substeps[k], w = 1/(ratio*ratio - 1);
            for (int i = 0; i < a->n; ++i) table[k][i] = table[k + 1][i] + w*(table[k + 1][i] - table[k][i]);
        }
    }
    for (int i = 0; i < a->n; ++i) increment[i] = table[0][i];
}

/* Moves y from time t0 to t1 in equal steps of at most H */
static __attribute__((unused)) void flow(const motion *a, real t0, real t1, real H, real *y)
{
    const real span = t1 > t0 ? t1 - t0 : t0 - t1;
    const int m = (int)(span/H) + 1;
    real low[EXTRAPOLATE_MOST] = { 0 }, d[EXTRAPOLATE_MOST];
    for (int k = 0; k < m; ++k) {
        extrapolate(a, t0 + (t1 - t0)*(real)k/(real)m, (t1 - t0)/(real)m, y, d);
        for (int i = 0; i < a->n; ++i) {
            const real x = d[i] + low[i], sum = y[i] + x;
            low[i] = x - (sum - y[i]);
            y[i] = sum;
        }
    }
}

#endif
