/* 14 - Four slips, and how they are found

   A charge on a spring, V = (|q| - 1)^2/2, in a magnetic field, L = B (x y' - y x')/2,
   and in air, f = -|v| v.  Written down twice: with slips that everybody makes, and
   mended.  A wrong derivative does not stop a step: the result is the motion of another
   system, or an energy that drifts.  So check_scene compares each with differences of
   the function that it belongs to.

   prints

     with slips: 5 found
       effect 0: f[1] is 0.115384615, but -dV/dq[1] is -0.115384615 (at the state given): wrong sign?
       effect 1: dldv[0] is -0.25, but dL/dv[0] is -0.125 (at the state given): twice what it should be
       effect 1: dldv[1] overwrites what was there: 0.3 for 0.8625 (at the state given)
       effect 2: fv[0][1] is 0, but df/dv[0][1] is 2.4 (at the state given): missing?
       effect 2: fv[1][0] is 0, but df/dv[1][0] is 2.4 (at the state given): missing?
     mended: 0 found
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/check.h"

#define B 0.5

static int slips = 1;

static int spring(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    double *fx = x->f, *fy = fx + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double pull = 1 - 1/sqrt(X[k]*X[k] + Y[k]*Y[k]);
        fx[k] -= pull*X[k];
        fy[k] -= slips ? -pull*Y[k] : pull*Y[k];              // the sign
    }
    return (void)user, 0;
}

static int spring_value(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        double stretch = sqrt(X[k]*X[k] + Y[k]*Y[k]) - 1;
        x->value[k] += stretch*stretch/2;
    }
    return (void)user, 0;
}

static int field(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride, *U = x->v, *V = U + x->stride;
    double *fx = x->f, *fy = fx + x->stride, *px = x->dldv, *py = px + x->stride;
    for (int k = 0; k < x->count; ++k) {
        fx[k] += B*V[k]/2;
        fy[k] -= B*U[k]/2;
        px[k] -= slips ? B*Y[k] : B*Y[k]/2;                   // a factor
        py[k] = slips ? B*X[k]/2 : py[k] + B*X[k]/2;          // = for +=
    }
    return (void)user, 0;
}

static int field_value(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride, *U = x->v, *V = U + x->stride;
    for (int k = 0; k < x->count; ++k) x->value[k] += B*(X[k]*V[k] - Y[k]*U[k])/2;
    return (void)user, 0;
}

static int air(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    double speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    for (int i = 0; i < 2; ++i) f[i] -= speed*v[i];
    return (void)t, (void)q, (void)dldv, (void)user, 0;
}

static int air_hessian(double t, const double *q, const double *v,
                       double *fq, double *fv, double *pv, void *user)
{
    double speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    for (int i = 0; i < 2; ++i)
        for (int j = 0; j < 2; ++j)
            if (!slips || i == j)                             // only the diagonal
                fv[2*i+j] -= (i == j ? speed : 0) + v[i]*v[j]/speed;
    return (void)t, (void)q, (void)fq, (void)pv, (void)user, 0;
}

int main(void)
{
    const gvi_effect scene[] = {
        { .kind = GVI_POTENTIAL, .points = spring, .value = spring_value },
        { .kind = GVI_LAGRANGIAN, .points = field, .value = field_value },
        { .kind = GVI_FORCE, .point = air, .hessian = air_hessian } };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 3 };
    for (; slips >= 0; --slips) {
        check_finding list[10];
        check_report report = { .list = list, .room = 10 };
        char line[300];
        int count = check_scene(&desc, 0, (double[]){ 1.2, 0.5 }, (double[]){ -3, 4 }, &report);
        printf("%s: %d found\n", slips ? "with slips" : "mended", count);
        for (int i = 0; i < count && i < 10; ++i) printf("  %s\n", check_line(&list[i], line, sizeof line));
    }
    return 0;
}
