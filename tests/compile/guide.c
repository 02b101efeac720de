/* The pieces of docs/guide.md that stand in no example, compiled. */
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
    double d = sqrt(x->q[0]*x->q[0] + x->q[1]*x->q[1]);
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
    return comet();
}
