/* parts.c - scenes, one a line: name, state and a point of the curve to the bit, or "refused"; then one that fails

   tests/tools/parts.sh compiles it with each macro that leaves code out, and compares. */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"

#include <stdio.h>

typedef gvi_real real;

// a quartic oscillator in each coordinate
static int quartic(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const real q = x->q[i*x->stride + k];
            if (x->f) x->f[i*x->stride + k] -= q*q*q;
            if (x->value) x->value[k] += q*q*q*q/4;
        }
    return 0;
}

// a constant force, and NaN beyond 2
static int broken(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) x->f[k] += x->q[k] > 2 ? x->q[k]*0/(x->q[k]*0) : 1;
    return 0;
}

static int quartic_point(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    for (int i = 0; i < 2; ++i) f[i] -= q[i]*q[i]*q[i];
    return (void)t, (void)v, (void)dldv, (void)user, 0;
}

static int drag(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= x->v[i*x->stride + k]/8;
    return 0;
}

// L = v_0 q_1/4
static int gyroscope(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        x->f[x->stride + k] += x->v[k]/4;
        x->dldv[k] += x->q[x->stride + k]/4;
    }
    return 0;
}

static int slow(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        x->value[k] += 1 + x->q[k]*x->q[k]/4;
        x->f[k] += x->q[k]/2;
    }
    return 0;
}

// on a circle
static int circle(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[k], b = x->q[x->stride + k] - (real)0.5;
        x->g[k] = (a*a + b*b - 1)/2;
        x->jacobian[k] = a;
        x->jacobian[x->stride + k] = b;
    }
    return 0;
}

// M = 2 + q_0^2, and 1
static int mass(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) {
        x->mass[k] = 2 + x->q[k]*x->q[k];
        x->mass[2*x->stride + k] = 0;
        x->mass[3*x->stride + k] = 1;
    }
    return 0;
}

static int mass_gradient(const gvi_points *x, void *user)
{
    (void)user;
    for (int k = 0; k < x->count; ++k) x->f[k] += x->q[k]*x->v[k]*x->v[k];
    return 0;
}

static void run(const char *name, const gvi_desc *desc)
{
    static real memory[20000];
    const real q[] = { 1, (real)0.5 }, v[] = { 0, 1 };
    gvi_stepper st;
    if (gvi_init(&st, desc, memory, sizeof memory) == GVI_E_FORMULATION) {
        printf("%s refused\n", name);
        return;
    }
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 20; ++k) gvi_step(&st, (real)0.125);
    real curve[2];
    if (gvi_curve(&st, (real)0.25, curve, NULL) != GVI_OK) curve[0] = 0;
    printf("%s %s %La %La %La %La %La\n", name, gvi_why(&st), (long double)st.q[0], (long double)st.q[1],
           (long double)st.p[0], (long double)st.p[1], (long double)curve[0]);
}

// the status and the fault of the first step that fails; what it left is where it was
static void run_broken(const gvi_desc *desc)
{
    static real memory[2000];
    const real q[] = { 1, 0 }, v[] = { 0, 1 };
    gvi_stepper st;
    if (gvi_init(&st, desc, memory, sizeof memory) == GVI_E_FORMULATION) {
        printf("broken refused\n");
        return;
    }
    gvi_start(&st, 0, q, v);
    while (gvi_step(&st, (real)0.125) == GVI_OK) {}
    printf("broken: %s, effect %d, t %La q %La\n", gvi_why(&st), st.fault.effect, (long double)st.t,
           (long double)st.q[0]);
}

int main(void)
{
    static const real dense[] = { 2, 1, 1, 3 }, nodes[] = { (real)0.25, (real)0.75 }, weights[] = { (real)0.5, (real)0.5 };
    static const gvi_effect potential[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                            { .kind = GVI_FORCE, .points = drag } };
    static const gvi_effect term[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                       { .kind = GVI_LAGRANGIAN, .points = gyroscope } };
    static const gvi_effect clock[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                        { .kind = GVI_CLOCK, .points = slow } };
    static const gvi_effect bad[] = { { .kind = GVI_FORCE, .points = drag },
                                      { .kind = GVI_POTENTIAL, .points = broken } };
    static const gvi_effect point[] = { { .kind = GVI_POTENTIAL, .point = quartic_point } };
    static const gvi_effect held[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                       { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1 } };
    const gvi_rule verlet = { .kind = GVI_LOBATTO, .points = 2 };
    gvi_desc d = { .n = 2, .degree = 4, .effects = potential, .effect_count = 1 }, e = d;
    e.degree = 1;
    e.rule = verlet;
    e.formulation = GVI_EXPLICIT;
    run("explicit", &e);
    e.formulation = GVI_POSITIONS;
    run("positions", &e);
    e.iterations = 3;
    run("given", &e);
    d.effects = point;
    d.formulation = GVI_POSITIONS;
    run("point", &d);
    d.effects = potential;
    d.effect_count = 2;
    d.formulation = GVI_VELOCITIES;
    run("velocities", &d);
    for (d.degree = 1; d.degree < 4; ++d.degree) run("few", &d);
    d.effects = bad;
    d.iterations = 3;
    run_broken(&d);
    d.effects = potential;
    d.iterations = 0;
    d.formulation = GVI_MOMENTA;
    d.mass = (gvi_mass){ .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient };
    run("momenta", &d);
    d.formulation = GVI_NEWTON;
    run("newton", &d);
    d.formulation = GVI_VELOCITIES;
    d.mass = (gvi_mass){ .kind = GVI_MASS_UNIT };
    d.effects = term;
    run("lagrangian", &d);
    d.formulation = GVI_MOMENTA;
    d.effects = clock;
    run("clock", &d);
    d.effects = potential;
    d.effect_count = 1;
    d.formulation = GVI_POSITIONS;
    d.mass = (gvi_mass){ .kind = GVI_MASS_DENSE, .matrix = dense };
    run("dense", &d);
    d.degree = 2;
    d.mass = (gvi_mass){ .kind = GVI_MASS_UNIT };
    d.rule = (gvi_rule){ .kind = GVI_OWN, .points = 2, .nodes = nodes, .weights = weights };
    run("own", &d);
    d.rule = (gvi_rule){ .kind = GVI_GAUSS };
    d.effects = held;
    d.effect_count = 2;
    run("held", &d);
    return 0;
}
