/* lagrangian.c - lagrangian.h for other languages: gvi.h, and four functions more, as one library

     cc -O2 -shared -fPIC -I. -Iexamples examples/languages/lagrangian.c -o libgvi_l.so -lm

   `add` is the caller's: it adds the derivatives of its L that are wanted (lagrangian_wanted). */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"

typedef void lagrangian_add_fn(const lagrangian_wanted *wanted);

size_t      typed_size(void);
const char *typed_init(lagrangian *L, int n, lagrangian_add_fn *add, double t, const double *q, const double *v);
void        typed_scene(lagrangian *L, gvi_effect *effect, gvi_mass *mass);
const char *typed_text(const lagrangian *L);

size_t typed_size(void) { return sizeof(lagrangian); }

/* NULL, or why L is refused */
const char *typed_init(lagrangian *L, int n, lagrangian_add_fn *add, double t, const double *q, const double *v)
{
    const lagrangian_function function = { n, add };
    return lagrangian_init(L, function, NULL, t, q, v);
}

void typed_scene(lagrangian *L, gvi_effect *effect, gvi_mass *mass)
{
    *effect = lagrangian_effect(L);
    *mass = lagrangian_mass(L);
}

const char *typed_text(const lagrangian *L) { return lagrangian_text(L); }
