/* The pieces of docs/guide.md that stand in no example, compiled. */
#define GVI_IMPLEMENTATION
#include "gvi.h"

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

int main(void)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .point = stiff, .hessian = stiff_hessian } };
    const gvi_desc verlet = { .n = 1, .degree = 1, .rule = { .kind = GVI_LOBATTO },
                              .effects = scene, .effect_count = 1 };
    static const double nodes[] = { 1.0/3, 1 }, weights[] = { 0.75, 0.25 };
    const gvi_desc radau = { .n = 1, .degree = 2,
                             .rule = { .kind = GVI_OWN, .points = 2, .nodes = nodes, .weights = weights },
                             .effects = scene, .effect_count = 1 };
    static double memory[GVI_LENGTH(1, 2, 2)];
    gvi_stepper st;

    // Stoermer-Verlet, explicit; then Radau's rule, whose order is measured
    if (gvi_init(&st, &verlet, memory, sizeof memory) || st.formulation != GVI_EXPLICIT) return 1;
    if (gvi_init(&st, &radau, memory, sizeof memory) || st.order != 3) return 2;
    return 0;
}
