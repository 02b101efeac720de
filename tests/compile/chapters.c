/* chapters.c - scenes, one a line: what each needs, status, state and a point of the curve to the bit, or "refused".  Then the
   memory that scenes of many sizes take, against GVI_LENGTH.

   tests/tools/chapters.sh compiles it with chapters left out, and compares. */
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

static void run(const char *needs, const gvi_desc *desc, int steps)
{
    static real memory[20000];
    const real q[] = { 1, (real)0.5 }, v[] = { 0, 1 };
    gvi_stepper st;
    real curve[2] = { 0 };
    if (gvi_init(&st, desc, memory, sizeof memory) == GVI_E_FORMULATION) {
        printf("%s: refused\n", needs);
        return;
    }
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < steps && st.status == GVI_OK; ++k) gvi_step(&st, (real)0.125);
    printf("%s: %d", needs, st.status);
    if (gvi_curve(&st, (real)0.25, curve, NULL) != GVI_OK) curve[0] = 0;
    printf(" %La %La %La %La %La %La\n", (long double)st.t, (long double)st.q[0], (long double)st.q[1],
           (long double)st.p[0], (long double)st.p[1], (long double)curve[0]);
}

/* ---- memory ---- */

static int anything(const gvi_points *x, void *user) { return (void)x, (void)user, 0; }

enum { DRAGGED = 1, TERM = 2, CLOCK = 4, HELD = 8, DIALLED = 16, EVERY = 32 };

// the numbers that a scene takes, of those that GVI_LENGTH says: 0 if it is refused
static double taken(gvi_formulation formulation, gvi_mass_kind kind, int has, int n, int s, gvi_rule rule)
{
    static real matrix[64];
    const gvi_effect all[] = { { .kind = GVI_POTENTIAL, .points = anything, .value = anything },
                               { .kind = GVI_FORCE, .points = anything },
                               { .kind = GVI_LAGRANGIAN, .points = anything, .value = anything },
                               { .kind = GVI_CLOCK, .points = anything },
                               { .kind = GVI_CONSTRAINT, .points = anything, .rows = n } };
    gvi_effect scene[5] = { all[0] };
    gvi_desc d = { .n = n, .degree = s, .rule = rule, .effects = scene, .effect_count = 1, .formulation = formulation };
    const int m = has & HELD ? n : 0;
    for (int e = 1; e < 5; ++e)
        if (has >> (e - 1) & 1) scene[d.effect_count++] = all[e];
    d.mass = (gvi_mass){ .kind = kind, .matrix = matrix, .points = anything, .gradient = anything };
    if (kind < GVI_MASS_POSITION) d.mass.points = d.mass.gradient = NULL;
    for (int i = 0; i < 64; ++i) matrix[i] = i % (n + 1) == 0;
    if (has & DIALLED) d.resolution = (real)0.001;
    return (double)gvi_size(&d)/(double)sizeof(real)
           /(double)(m ? GVI_CONSTRAINED_LENGTH(n, s, rule.points, m) : GVI_LENGTH(n, s, rule.points));
}

// the most that any scene takes of GVI_LENGTH
static double most_taken(void)
{
    static const int degrees[] = { 1, 2, 4, 5, 8 }, sizes[] = { 1, 2, 5 };
    static const real nodes[12] = { 0 }, weights[12] = { 1 };
    double most = 0;
    for (int f = GVI_AUTO; f <= GVI_NEWTON; ++f)
    for (int mass = GVI_MASS_UNIT; mass <= GVI_MASS_NONE; ++mass)
    for (int has = 0; has < EVERY; ++has)
    for (int k = 0; k < 5; ++k)
    for (int n = 0; n < 3; ++n)
    for (int extra = 0; extra <= 3; ++extra)
    for (int kind = GVI_GAUSS; kind <= GVI_KICKS; ++kind) {
        const int kicks = kind == GVI_KICKS;
        const gvi_rule rule = { (gvi_rule_kind)kind, degrees[k] + extra, kicks ? nodes : NULL, kicks ? weights : NULL };
        if (kind == GVI_OWN) continue;                        // as Gauss's
        const double part = taken((gvi_formulation)f, (gvi_mass_kind)mass, has, sizes[n], degrees[k], rule);
        if (part > most) most = part;
    }
    return most;
}

int main(void)
{
    static const real dense[] = { 2, 1, 1, 3 }, nodes[] = { (real)0.25, (real)0.75 }, halves[] = { (real)0.5, (real)0.5 };
    static const gvi_effect dragged[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                          { .kind = GVI_FORCE, .points = drag } };
    static const gvi_effect term[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                       { .kind = GVI_LAGRANGIAN, .points = gyroscope } };
    static const gvi_effect timed[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                        { .kind = GVI_CLOCK, .points = slow } };
    static const gvi_effect bad[] = { { .kind = GVI_FORCE, .points = drag },
                                      { .kind = GVI_POTENTIAL, .points = broken } };
    static const gvi_effect point[] = { { .kind = GVI_POTENTIAL, .point = quartic_point } };
    static const gvi_effect held[] = { { .kind = GVI_POTENTIAL, .points = quartic, .value = quartic },
                                       { .kind = GVI_CONSTRAINT, .points = circle, .rows = 1 } };
    const gvi_mass moving = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = mass_gradient },
                   full = { .kind = GVI_MASS_DENSE, .matrix = dense };
    const gvi_rule verlet = { .kind = GVI_LOBATTO, .points = 2 },
                   own = { .kind = GVI_OWN, .points = 2, .nodes = nodes, .weights = halves },
                   jumps = { .kind = GVI_KICKS, .points = 2, .nodes = nodes, .weights = halves };

    gvi_desc d = { .n = 2, .degree = 1, .rule = verlet, .effects = dragged, .effect_count = 1 };
    d.formulation = GVI_EXPLICIT;
    run("Verlet KICKS", &d, 20);
    d.rule = jumps;
    run("kicks KICKS", &d, 20);
    d.rule = verlet;
    d.formulation = GVI_POSITIONS;
    run("Lobatto", &d, 20);
    d.iterations = 3;
    run("given", &d, 20);

    d = (gvi_desc){ .n = 2, .degree = 4, .effects = point, .effect_count = 1 };
    run("point", &d, 20);
    d.effects = dragged;
    run("positions", &d, 20);
    d.mass = full;
    run("dense", &d, 20);
    d.effect_count = 2;
    run("velocities, dense", &d, 20);
    d.mass = (gvi_mass){ .kind = GVI_MASS_UNIT };
    for (d.degree = 1; d.degree < 9; d.degree += 1 + (d.degree > 3)) run("velocities", &d, 20);
    d.iterations = 3;
    d.effects = bad;
    run("broken", &d, 60);
    d.iterations = 0;

    d.degree = 4;
    d.effects = dragged;
    d.formulation = GVI_NEWTON;
    run("by Newton NEWTON", &d, 20);
    d.effects = term;
    run("term, by Newton LAGRANGIAN NEWTON", &d, 20);
    d.formulation = GVI_MOMENTA;
    run("term, momenta LAGRANGIAN MOMENTA", &d, 20);
    d.effects = dragged;
    d.mass = moving;
    run("momenta MOMENTA", &d, 20);
    d.formulation = GVI_NEWTON;
    run("momenta, by Newton MOMENTA NEWTON", &d, 20);
    d.formulation = GVI_MOMENTA;
    d.mass = (gvi_mass){ .kind = GVI_MASS_UNIT };
    d.effects = timed;
    run("clock CLOCK", &d, 20);

    d = (gvi_desc){ .n = 2, .degree = 2, .rule = own, .effects = dragged, .effect_count = 1, .formulation = GVI_POSITIONS };
    run("own RULES", &d, 20);
    d.rule = (gvi_rule){ .kind = GVI_GAUSS };
    d.degree = 4;
    d.resolution = (real)0.01;
    run("dial DIAL", &d, 20);
    d.resolution = 0;
    d.effects = held;
    d.effect_count = 2;
    run("held CONSTRAINTS", &d, 20);
    d.formulation = GVI_NEWTON;
    run("held, by Newton CONSTRAINTS NEWTON", &d, 20);
    d.formulation = GVI_MOMENTA;
    d.mass = moving;
    run("held, momenta CONSTRAINTS MOMENTA", &d, 20);

    const double most = most_taken();
    fprintf(stderr, "%.3f\n", most);
    return !(most > 0.8 && most <= 1);          // enough, and no more than some scene needs
}
