/* clocks.h - two clocks for encounters: time runs as dt = g dtau, slowly where bodies are close

     distance_clock    g = |q|, one particle about the origin
     pair_clock        g = 1/sqrt(sum of 1/r_ij^2), the least distance of several          */
#ifndef CLOCKS_H
#define CLOCKS_H

#include "tools/effects.h"

struct distance_clock { particles on; };

static inline int distance_clock_points(const gvi_points *x, void *user)
{
    const struct distance_clock *p = user;
    for (int k = 0; k < x->count; ++k) {
        gvi_real r2 = 0;
        for (int c = 0; c < p->on.dim; ++c) {
            const gvi_real u = x->q[effect_row(x, p->on.first + c) + (size_t)k];
            r2 += u*u;
        }
        const gvi_real r = sqrt(r2);
        x->value[k] += r;
        for (int c = 0; c < p->on.dim; ++c) {
            const size_t at = effect_row(x, p->on.first + c) + (size_t)k;
            x->f[at] += x->q[at]/r;
        }
    }
    return 0;
}

static inline gvi_effect distance_clock(const struct distance_clock *p)
{
    return (gvi_effect){ .kind = GVI_CLOCK, .points = distance_clock_points, .user = (void *)p };
}

struct pair_clock { particles on; };

/* dg/dx_i = g^3 sum_j (x_i - x_j)/r_ij^4                                                  */
static inline int pair_clock_points(const gvi_points *x, void *user)
{
    const struct pair_clock *p = user;
    for (int k = 0; k < x->count; ++k) {
        const gvi_real *q = x->q + k;
        gvi_real sum = 0;
        for (int pass = 0; pass < 2; ++pass) {                 /* the sum, then its gradient */
            const gvi_real g = pass ? 1/sqrt(sum) : 0, g3 = g*g*g;
            if (pass) x->value[k] += g;
            for (int i = 1; i < p->on.count; ++i)
                for (int j = 0; j < i; ++j) {
                    const size_t a = particle_row(x, p->on, i), b = particle_row(x, p->on, j);
                    gvi_real r2 = 0;
                    for (int c = 0; c < p->on.dim; ++c) {
                        const gvi_real u = q[a + effect_row(x, c)] - q[b + effect_row(x, c)];
                        r2 += u*u;
                    }
                    if (!pass) sum += 1/r2;
                    for (int c = 0; pass && c < p->on.dim; ++c) {
                        const size_t to = effect_row(x, c) + (size_t)k;
                        const gvi_real d = g3*(x->q[a + to] - x->q[b + to])/(r2*r2);
                        x->f[a + to] += d;
                        x->f[b + to] -= d;
                    }
                }
        }
    }
    return 0;
}

static inline gvi_effect pair_clock(const struct pair_clock *p)
{
    return (gvi_effect){ .kind = GVI_CLOCK, .points = pair_clock_points, .user = (void *)p };
}

#endif
