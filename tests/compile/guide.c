/* The pieces of docs/guide.md and docs/tools.md that stand in no example, compiled. */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>

static int stiff(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    f[0] -= 1e4*q[0] + q[0]*q[0]*q[0];
    return (void)t, (void)v, (void)dldv, (void)user, 0;
}

static int stiff_hessian(double t, const double *q, const double *v, double *fq, double *fv, double *pv, void *user)
{
    fq[0] -= 1e4 + 3*q[0]*q[0];
    return (void)t, (void)v, (void)fv, (void)pv, (void)user, 0;
}

// g(q) = |q|: value and gradient
GVI_EACH(distance, 2, f, value)
{
    double d = GVI_SQRT(x->q[0]*x->q[0] + x->q[1]*x->q[1]);
    x->value[0] += d;
    x->f[0] += x->q[0]/d;
    x->f[1] += x->q[1]/d;
}

GVI_EACH(attraction, 2, f, value)
{
    double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, d = sqrt(d2), w = -1/(d2*d);
    x->value[0] -= 1/d;
    x->f[0] += w*X;
    x->f[1] += w*Y;
}

static const double mass[6] = { 1, 2, 3, 4, 5, 6 };

GVI_POINTS(gravity, 18, f)(const gvi_points *x, void *user)
{
    GVI_UNROLL for (int i = 1; i < 6; ++i)
        GVI_UNROLL for (int j = 0; j < i; ++j) {
            const double *a = x->q + 3*i, *b = x->q + 3*j, u = b[0] - a[0], v = b[1] - a[1], w = b[2] - a[2];
            const double r2 = u*u + v*v + w*w, s = mass[i]*mass[j]/(r2*GVI_SQRT(r2));
            double *f = x->f + 3*i, *g = x->f + 3*j;
            f[0] += s*u;  f[1] += s*v;  f[2] += s*w;
            g[0] -= s*u;  g[1] -= s*v;  g[2] -= s*w;
        }
    return (void)user, 0;
}

// forces of six bodies on each other have no sum
static int bodies(void)
{
    double t = 0, q[18], f[18] = { 0 }, sum = 0;
    const gvi_points x = { .n = 18, .count = 1, .stride = 1, .t = &t, .q = q, .f = f };
    for (int i = 0; i < 18; ++i) q[i] = sin(i + 1);
    const int failed = gravity(&x, NULL) || !(fabs(f[0]) > 0.1);
    for (int i = 0; i < 18; i += 3) sum += f[i];
    return failed || fabs(sum) > 1e-12;
}

static int comet(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    const gvi_effect scene[] = {
        { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
        { .kind = GVI_CLOCK, .points = distance },
    };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 2 };
    gvi_stepper st;
    double q[2];
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0.01, 0 }, (double[]){ 0, sqrt(199) });
    while (st.status == GVI_OK && st.t < 1) gvi_step(&st, 0.1);
    gvi_state_at(&st, 1, q, NULL, NULL);
    return st.status != GVI_OK || !(q[0] < -1 && q[0] > -2);
}

// the same way by the dial, to its end
static int dial(void)
{
    static double memory[GVI_LENGTH(2, 8, 8)];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1, .resolution = 1e-13 };
    const double revolution = 6.283185307179586, q[] = { 0.01, 0 }, v[] = { 0, sqrt(199) };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    while (st.status == GVI_OK && st.t < revolution)
        gvi_advance(&st, revolution);
    return st.status != GVI_OK || fabs(st.q[0] - 0.01) > 1e-9;
}

GVI_POINTS(rod, 2, rows(1))(const gvi_points *x, void *user)
{
    x->g[0] = (x->q[0]*x->q[0] + x->q[1]*x->q[1] - 1)/2;
    x->jacobian[0] = x->q[0];
    x->jacobian[1] = x->q[1];
    return (void)user, 0;
}

// three digits on a circle of radius 1
static int from_a_file(void)
{
    static double memory[GVI_CONSTRAINED_LENGTH(2, 8, 8, 1)];
    const gvi_effect scene[] = { { .kind = GVI_CONSTRAINT, .points = rod, .rows = 1 } };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 1 };
    double q[] = { 0.6, 0.801 }, v[] = { 1, 1 };
    gvi_stepper st;
    double moved[2];
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_project(&st, 0, q, v, moved);          // moved: of q and of v, sqrt(d'M d)
    gvi_start(&st, 0, q, v);
    return st.status != GVI_OK || !(moved[0] > 1e-4 && moved[0] < 1e-3);
}

int main(void)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = stiff, .hessian = stiff_hessian } };
    const gvi_desc verlet = { .n = 1, .degree = 1, .rule = { .kind = GVI_LOBATTO },
                              .effects = scene, .effect_count = 1 };
    static const double nodes[] = { 1.0/3, 1 }, weights[] = { 0.75, 0.25 };
    const gvi_desc radau = { .n = 1, .degree = 2,
                             .rule = { .kind = GVI_OWN, .points = 2, .nodes = nodes, .weights = weights },
                             .effects = scene, .effect_count = 1 };
    static const double at[] = { 0, 1.35120719195965763, -0.35120719195965763, 1 };
    static const double kick[] = { 0.67560359597982882, -0.17560359597982882, -0.17560359597982882, 0.67560359597982882 };
    const gvi_desc forest = { .n = 1, .rule = { .kind = GVI_KICKS, .points = 4, .nodes = at, .weights = kick },
                              .effects = scene, .effect_count = 1 };
    static double memory[GVI_LENGTH(1, 8, 8)];
    gvi_stepper st;

    // Stoermer-Verlet, explicit; then Radau's rule, whose order is measured
    if (gvi_init(&st, &verlet, memory, sizeof memory) || st.formulation != GVI_EXPLICIT) return 1;
    if (gvi_init(&st, &radau, memory, sizeof memory) || st.order != 3) return 2;
    if (gvi_init(&st, &forest, memory, sizeof memory) || st.formulation != GVI_EXPLICIT) return 3;
    return comet() || dial() || bodies() || from_a_file();
}
