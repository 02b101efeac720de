/* fermi_pasta_ulam.h - the chain of Hairer, Lubich, Wanner, Geometric numerical integration, I.5.1:
   n/2 stiff springs of frequency omega, linked by soft quartic ones; q = their centres and lengths.
   For programs with a double omega.                                                        */
#ifndef FERMI_PASTA_ULAM_H
#define FERMI_PASTA_ULAM_H

/* 1/4 sum of fourth powers of the soft springs' lengths, and the stiff ones */
static int fermi_pasta_ulam_forces(const gvi_points *x, void *user)
{
    const int d = x->stride, M = x->n/2;
    for (int k = 0; k < x->count; ++k)
        for (int j = 0; j <= M; ++j) {
            const double *slow = x->q + k, *fast = slow + M*d;
            double u = 0, w;
            if (j < M) u += slow[j*d] - fast[j*d];
            if (j > 0) u -= slow[(j - 1)*d] + fast[(j - 1)*d];
            w = u*u*u;
            if (j < M) {
                x->f[j*d + k] -= w;
                x->f[(M + j)*d + k] += w - omega*omega*fast[j*d];
            }
            if (j > 0) {
                x->f[(j - 1)*d + k] += w;
                x->f[(M + j - 1)*d + k] += w;
            }
        }
    return 0;
}

#endif
