/* rest.c - linkages from rest by the dial: joints at 0 and offsets, torques, springs

   A loop of three bars with angles q_i + offset_i, and one run in two a fourth angle that only M couples to them.  Masses are
   diagonal, full or M(q); one angle in two starts at 0, where its size says nothing of what is small.  From rest the first
   velocities are no larger than rounding of g over h, which no shorter step mends.  By any dial from 1e-8 to 1e-14 t = 1 has
   to be reached, in 200 steps at most, with energy and loop kept to a dial a step.  Linkages whose rows depend on each
   other within that time are left out: those that 512 fixed steps cannot pass either.

     rest [linkages, 3000]                                                                                     */
#include "hard.h"

enum { N = 4, MOST = 200, FINE = 512 };
typedef struct linkage { double bar[3], offset[3], end[2], torque[N], spring[N]; } linkage;
static real memory[GVI_CONSTRAINED_LENGTH(N, 8, 8, 2)];

static double fraction(void) { return (uniform() + 1)/2; }

static int loop(const gvi_points *x, void *user)
{
    const linkage *a = (const linkage *)user;
    const int R = x->stride, n = x->n;
    for (int k = 0; k < x->count; ++k) {
        x->g[k] = -a->end[0];
        x->g[R + k] = -a->end[1];
        for (int i = 0; i < 3; ++i) {
            const real angle = x->q[i*R + k] + a->offset[i], X = a->bar[i]*cos(angle), Y = a->bar[i]*sin(angle);
            x->g[k] += X;
            x->g[R + k] += Y;
            x->jacobian[i*R + k] = -Y;
            x->jacobian[(n + i)*R + k] = X;
        }
    }
    return 0;
}

static int torques(const gvi_points *x, void *user)
{
    const linkage *a = (const linkage *)user;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < x->n; ++i) {
            const real q = x->q[i*x->stride + k];
            if (x->f) x->f[i*x->stride + k] += a->torque[i] - a->spring[i]*q;
            if (x->value) x->value[k] += a->spring[i]*q*q/2 - a->torque[i]*q;
        }
    return 0;
}

static int inertia(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < n; ++i) {
            x->mass[i*(n + 1)*R + k] = 1 + (real)i/5;
            for (int j = 0; j < i; ++j) x->mass[(i*n + j)*R + k] = (real)0.1*cos(x->q[i*R + k] - x->q[j*R + k]);
        }
    return (void)user, 0;
}

static int inertia_slope(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int i = 0; i < x->n; ++i)
            for (int j = 0; j < i; ++j) {
                const real turn = (real)-0.1*sin(x->q[i*R + k] - x->q[j*R + k])*x->v[i*R + k]*x->v[j*R + k];
                x->f[i*R + k] += turn;
                x->f[j*R + k] -= turn;
            }
    return (void)user, 0;
}

/* One linkage: steps that the dial takes to t = 1, 0 if it gets stuck, -1 if fixed steps cannot pass; how far its energy and
   its loop are off, over a dial a step */
static int run(double *off)
{
    linkage a = { { 0 }, { 0 }, { 0 }, { 0 }, { 0 } };
    real q[N], v[N] = { 0 }, full[N*N], masses[N], E0, E, g[2] = { 0 }, G[2*N] = { 0 };
    const int n = 3 + (fraction() < 0.5), kind = (int)(3*fraction());
    for (int i = 0; i < n; ++i) {
        a.torque[i] = uniform();
        a.spring[i] = fraction() < 0.3 ? fraction() : 0;
        q[i] = fraction() < 0.5 ? 0 : (real)(fraction() - 0.5);
        masses[i] = (real)pow(10, uniform());
        for (int j = 0; j < n; ++j) full[i*n + j] = i == j ? 1 + (real)0.3*(real)i : (real)0.2;
        if (i == 3) continue;
        a.bar[i] = 0.3 + fraction();
        a.offset[i] = fraction() < 0.3 ? 0 : 6.28*fraction();
        a.end[0] += a.bar[i]*cos((double)q[i] + a.offset[i]);
        a.end[1] += a.bar[i]*sin((double)q[i] + a.offset[i]);
    }
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = torques, .value = torques, .user = &a },
                                 { .kind = GVI_CONSTRAINT, .points = loop, .rows = 2, .user = &a } };
    gvi_desc desc = { .n = n, .degree = 8, .effects = scene, .effect_count = 2 };
    if (kind == 0) desc.mass.kind = GVI_MASS_DIAGONAL, desc.mass.matrix = masses;
    if (kind == 1) desc.mass.kind = GVI_MASS_DENSE, desc.mass.matrix = full;
    if (kind == 2) desc.mass.kind = GVI_MASS_POSITION, desc.mass.points = inertia, desc.mass.gradient = inertia_slope;

    gvi_stepper st;
    must(gvi_init(&st, &desc, memory, sizeof memory));
    if (gvi_start(&st, 0, q, v) != GVI_OK || gvi_steps(&st, 1/(real)FINE, FINE) != GVI_OK) return -1;
    desc.resolution = (real)pow(10, -8 - 6*fraction());
    must(gvi_init(&st, &desc, memory, sizeof memory));
    must(gvi_start(&st, 0, q, v));
    must(gvi_energy(&st, &E0));
    int steps = 0;
    for (; st.t < 1 && steps <= MOST; ++steps)
        if (gvi_advance(&st, 1) != GVI_OK) return 0;
    if (st.t < 1) return 0;
    must(gvi_energy(&st, &E));
    loop(&(gvi_points){ .n = n, .count = 1, .stride = 1, .q = st.q, .g = g, .jacobian = G }, &a);
    *off = (double)fmax(fabs(E - E0), fmax(fabs(g[0]), fabs(g[1])))/((double)steps*(double)desc.resolution + 256*(double)EPS);
    return steps;
}

int main(int argc, char **argv)
{
    const int all = argc > 1 ? atoi(argv[1]) : 3000;
    int stuck = 0, moved = 0, passed = 0;
    double worst = 0;
    for (int k = 0; k < all; ++k) {
        double off = 0;
        const int steps = run(&off);
        moved += steps > 0 ? steps : 0;
        passed += steps > 0;
        stuck += steps == 0;
        worst = fmax(worst, off);
    }
    printf("%d linkages from rest, %d left out, %.1f steps each\n", passed + stuck, all - passed - stuck, (double)moved/passed);
    expect("stuck", 0, stuck, 0);
    expect("energy and loop, over a dial a step", 0, worst, 1);
    return verdict("rest");
}
