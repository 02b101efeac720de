/* What size.sh compiles for a machine: the three calls that every program makes, and
   the length of a stepper as that of an array.  With SIZE_SCENES, for this machine: a program that
   prints the numbers (gvi_real) of memory that some scenes need, and the bound for any of that size.  */
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#include "gvi.h"

#if !defined SIZE_SCENES
gvi_status size_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size);
gvi_status size_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v);
gvi_status size_step(gvi_stepper *st, gvi_real h);
extern char size_stepper[sizeof(gvi_stepper)];

char size_stepper[sizeof(gvi_stepper)];

gvi_status size_init(gvi_stepper *st, const gvi_desc *desc, gvi_real *memory, size_t size)
{
    return gvi_init(st, desc, memory, size);
}

gvi_status size_start(gvi_stepper *st, gvi_real t, const gvi_real *q, const gvi_real *v)
{
    return gvi_start(st, t, q, v);
}

gvi_status size_step(gvi_stepper *st, gvi_real h) { return gvi_step(st, h); }

#else
#include <stdio.h>

static int anything(const gvi_points *x, void *user) { return (void)x, (void)user, 0; }

static void print(const char *name, int n, int s, gvi_formulation formulation)
{
    static const gvi_effect both[] = { { .kind = GVI_POTENTIAL, .points = anything },
                                       { .kind = GVI_FORCE, .points = anything } };
    gvi_desc desc = { .n = n, .degree = s, .effects = both, .effect_count = 2, .formulation = formulation };
    if (formulation == GVI_EXPLICIT) desc.rule.kind = GVI_LOBATTO;
    if (formulation <= GVI_POSITIONS) desc.effect_count = 1;
    if (formulation >= GVI_MOMENTA)
        desc.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = anything, .gradient = anything };
    const int r = formulation == GVI_EXPLICIT ? s + 1 : s;
    printf("%s|%u|%u\n", name, (unsigned)(gvi_size(&desc)/sizeof(gvi_real)), (unsigned)GVI_LENGTH(n, s, r));
}

/* Two rods in the plane, s = 2. */
static void print_rods(const char *name, gvi_formulation formulation)
{
    static const gvi_effect both[] = { { .kind = GVI_POTENTIAL, .points = anything },
                                       { .kind = GVI_CONSTRAINT, .points = anything, .rows = 2 } };
    const gvi_desc desc = { .n = 4, .degree = 2, .effects = both, .effect_count = 2, .formulation = formulation };
    printf("%s|%u|%u\n", name, (unsigned)(gvi_size(&desc)/sizeof(gvi_real)),
           (unsigned)GVI_CONSTRAINED_LENGTH(4, 2, 2, 2));
}

int main(void)
{
    print("planet, Verlet: explicit", 2, 1, GVI_EXPLICIT);
    print("pendulum, s = 3: positions", 1, 3, GVI_POSITIONS);
    print("planet, s = 3: positions", 2, 3, GVI_POSITIONS);
    print("driven pendulum, s = 3: velocities", 1, 3, GVI_VELOCITIES);
    print("arm of two joints, s = 2: momenta", 2, 2, GVI_MOMENTA);
    print("arm of two joints, s = 3: momenta", 2, 3, GVI_MOMENTA);
    print("arm of six joints, s = 2: momenta", 6, 2, GVI_MOMENTA);
    print("arm of two joints, s = 3: Newton", 2, 3, GVI_NEWTON);
    print_rods("two rods, s = 2: not pinned", GVI_AUTO);
    print_rods("two rods, s = 2: positions", GVI_POSITIONS);
    return 0;
}
#endif
