/* springs.h - masses in a row: spring i is between i and i + 1, the last one at the wall */
#ifndef TESTS_SPRINGS_H
#define TESTS_SPRINGS_H

/* How far spring i is stretched; coordinates are d apart */
static gvi_real stretch(int n, int i, int d, const gvi_real *q)
{
    return (i + 1 < n ? q[(i + 1)*d] : 0) - q[i*d];
}

static void add_tension(int n, int i, int d, gvi_real tension, gvi_real *f)
{
    f[i*d] += tension;
    if (i + 1 < n) f[(i + 1)*d] -= tension;
}

/* Of spring i to the Hessian, n by n */
static void add_stiffness(int n, int i, gvi_real k, gvi_real *fq)
{
    fq[i*n + i] -= k;
    if (i + 1 == n) return;
    fq[(i + 1)*n + i + 1] -= k;
    fq[i*n + i + 1] += k;
    fq[(i + 1)*n + i] += k;
}

#endif
