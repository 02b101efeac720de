/* complex_step.h - products for tangent.h from a force written once, for complex numbers

   For gvi.h in double; needs tangent.h and C99's complex numbers.

   An analytic f, written for complex numbers, has f(x + i e d) = f(x) + i e f'(x) d + O(e^2).
   With e = 1e-100 the imaginary part divided by e is the product f'(x) d to rounding:
   nothing is subtracted, so no digit is lost, and e^2 is beyond all digits. Products
   that are written by hand run three to ten times faster.

     force     adds to f, or for mass.gradient the same: out[n] of q, v (v: zeros for a
               potential); writes every entry that is not 0, the others are 0 beforehand
     velocity  for mass.velocity: out[n] = velocity of q and p

   Only what is analytic: no fabs, no comparisons of the real part with a limit that matters,
   sqrt(x x + y y) instead of cabs. n at most COMPLEX_MOST, else the callback fails.
   tangent_check compares with differences.

   Use    static const complex_effect weight = { .force = weight_force };
          effect:  { .kind = GVI_POTENTIAL, .points = complex_points, .user = (void *)&weight }
          product: complex_product

   Source: Squire, Trapp: Using complex variables to estimate derivatives of real functions,
   SIAM Review 40, 1998.                                                        */
#ifndef COMPLEX_STEP_H
#define COMPLEX_STEP_H

#ifdef __cplusplus
#error "complex_step.h is C: C++ has complex numbers of another kind"
#endif
#include "tangent.h"
#include <complex.h>

#ifndef COMPLEX_MOST
#define COMPLEX_MOST 32
#endif

typedef double complex complex_number;
typedef void complex_fn(const complex_number *q, const complex_number *v, complex_number *out);
typedef struct complex_effect { complex_fn *force, *velocity; } complex_effect;

/* The product along d, or with d NULL the effect itself.                        */
static int complex_both(const gvi_points *x, const gvi_points *d, const complex_effect *effect)
{
    const double e = 1e-100;
    const gvi_points *y = d ? d : x;
    const double *v = y->velocity ? x->p : x->v, *dv = y->velocity ? y->p : y->v;
    if (x->n > COMPLEX_MOST) return 1;
    for (int k = 0; k < x->count; ++k) {
        complex_number Q[COMPLEX_MOST], V[COMPLEX_MOST], out[COMPLEX_MOST];
        for (int i = 0, at = k; i < x->n; ++i, at += x->stride) {
            Q[i] = x->q[at] + (d ? e*y->q[at]*(complex_number)_Complex_I : 0);
            V[i] = (v ? v[at] : 0) + (d && v ? e*dv[at]*(complex_number)_Complex_I : 0);
            out[i] = 0;
        }
        (y->velocity ? effect->velocity : effect->force)(Q, V, out);
        for (int i = 0, at = k; i < x->n; ++i, at += x->stride) {
            const double result = d ? cimag(out[i])/e : creal(out[i]);
            if (y->velocity) y->velocity[at] = result;
            else y->f[at] += result;
        }
    }
    return 0;
}

static inline int complex_points(const gvi_points *x, void *user) { return complex_both(x, NULL, user); }

static inline int complex_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    return (void)parameter, complex_both(x, d, user);
}

#endif
