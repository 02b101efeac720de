/* 15 - Are my derivatives right, and which degree and step suit my scene?

   A scene of your own in the two tools that help to set it up.  The checker
   compares forces with differences of the potentials; the advisor runs the scene
   for a while with one setting after the other and names the cheapest one that
   has the wanted error at the end.  Here: a body of 1 kg on a spring in air.
   Cost is counted in operations, so that this comes out the same on every
   machine; with .counted = 0 it is CPU time, which is what you want.

   prints

     derivatives: 44 compared, 0 wrong
     for 1e-06 at t = 60: degree 5, Gauss, tolerance 1e-09, 272 steps of 0.221
     for 1e-09 at t = 60: degree 7, Gauss, tolerance 1e-11, 912 steps of 0.0658
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/advise.h"
#include "tools/check.h"

static const double stiffness = 40, length = 1, g = 9.81, air = 0.02;

/* Spring from the origin, and weight: the force, or the value, whichever is wanted */
static int spring(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double d = sqrt(X[k]*X[k] + Y[k]*Y[k]), stretch = d - length, w = stiffness*stretch/d;
        if (x->value) x->value[k] += stiffness*stretch*stretch/2 + g*Y[k];
        if (!x->f) continue;
        x->f[k] -= w*X[k];
        x->f[x->stride + k] -= w*Y[k] + g;
    }
    return (void)user, 0;
}

static int drag(const gvi_points *x, void *user)
{
    const double *u = x->v, *v = u + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double w = air*sqrt(u[k]*u[k] + v[k]*v[k]);
        x->f[k] -= w*u[k];
        x->f[x->stride + k] -= w*v[k];
    }
    return (void)user, 0;
}

int main(void)
{
    // the scene, as any program describes it
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = spring, .value = spring },
                                 { .kind = GVI_FORCE, .points = drag } };
    const gvi_desc desc = { .n = 2, .effects = scene, .effect_count = 2 };
    const double q[] = { 0.8, -0.9 }, v[] = { 0.3, 0.5 };

    // 1: the checker; a state at which no term vanishes by accident
    check_finding list[10];
    check_report report = { .list = list, .room = 10 };
    char line[300];
    const int wrong = check_scene(&desc, 0, q, v, &report);
    printf("derivatives: %ld compared, %d wrong\n", report.checked, wrong);
    for (int i = 0; i < wrong && i < 10; ++i) puts(check_line(&list[i], line, sizeof line));

    // 2: the advisor; h is a step worth beginning with, weight the operations of an effect at a point
    const advise_case mine = { .desc = desc, .q = q, .v = v, .horizon = 60, .h = 0.1, .weight = { 40, 15 } };
    for (double error = 1e-6; error > 1e-10; error /= 1000) {
        const advise_options options = { .error = error, .seconds = 2, .counted = 1 };
        advise_result best;
        if (advise_find(&mine, &options, &best)) return puts(best.why), 1;
        printf("for %.0e at t = %g: %s, %ld steps of %.3g\n", error, mine.horizon,
               advise_name(&best.setting, line, sizeof line), best.steps, best.h);
    }
}
