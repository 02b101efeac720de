/* 24 - A rope of 200 rods falls through air: many constraints cost no more than their number

   Point masses of 10 g, rods of 1 cm, held at one end, let go from the horizontal; the air takes
   0.005 kg/s times the speed of each mass. A constraint is a rod, which shares coordinates with its two
   neighbours only: the library sees that from the zeros of G. Nothing is declared.

   prints

     after 0.5 s the end is at (1.394, -1.130) m
     rods are as long as they were, to 1e-13: yes
     energy lost to the air: 2.585 J, by its power 2.585 J
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

enum { RODS = 200, N = 2*RODS, DEGREE = 4 };
static const double length = 0.01, mass = 0.01, gravity = 9.81, drag = 0.005;

static int rods(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int a = 0; a < RODS; ++a)
        for (int k = 0; k < x->count; ++k) {
            const double dx = x->q[2*a*R + k] - (a > 0 ? x->q[(2*a - 2)*R + k] : 0);
            const double dy = x->q[(2*a + 1)*R + k] - (a > 0 ? x->q[(2*a - 1)*R + k] : 0);
            double *G = x->jacobian + (a*N + 2*a)*R + k;
            x->g[a*R + k] = (dx*dx + dy*dy - length*length)/2;
            G[0] = dx, G[R] = dy;
            if (a > 0) G[-2*R] = -dx, G[-R] = -dy;
        }
    return (void)user, 0;
}

static int weight(const gvi_points *x, void *user)
{
    for (int a = 0; a < RODS; ++a)
        for (int k = 0; k < x->count; ++k) {
            if (x->f) x->f[(2*a + 1)*x->stride + k] -= mass*gravity;
            if (x->value) x->value[k] += mass*gravity*x->q[(2*a + 1)*x->stride + k];
        }
    return (void)user, 0;
}

static int air(const gvi_points *x, void *user)
{
    for (int i = 0; i < N*x->stride; ++i) x->f[i] -= drag*x->v[i];
    return (void)user, 0;
}

int main(void)
{
    static double memory[GVI_CONSTRAINED_LENGTH(N, DEGREE, DEGREE, RODS)], masses[N], q[N], v[N];
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = weight, .value = weight },
                                 { .kind = GVI_FORCE, .points = air },
                                 { .kind = GVI_CONSTRAINT, .points = rods, .rows = RODS } };
    const gvi_desc desc = { .n = N, .degree = DEGREE, .effects = scene, .effect_count = 3,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = masses } };
    gvi_stepper st;
    double E0, E, lost = 0, before = 0, off = 0;
    for (int a = 0; a < RODS; ++a) {
        masses[2*a] = masses[2*a + 1] = mass;
        q[2*a] = length*(a + 1);
    }
    if (gvi_init(&st, &desc, memory, sizeof memory) != GVI_OK || gvi_start(&st, 0, q, v) != GVI_OK)
        return printf("%s\n", gvi_status_text(st.status)), 1;
    gvi_energy(&st, &E0);
    for (int k = 0; k < 1000; ++k) {
        double power = 0;
        if (gvi_step(&st, 0.0005) != GVI_OK)
            return printf("%s at %g s\n", gvi_status_text(st.status), st.t), 1;
        for (int i = 0; i < N; ++i) power += drag*st.p[i]*st.p[i]/(mass*mass);
        lost += 0.0005*(before + power)/2;
        before = power;
    }
    gvi_energy(&st, &E);
    for (int a = 0; a < RODS; ++a)
        off = fmax(off, fabs(hypot(st.q[2*a] - (a > 0 ? st.q[2*a - 2] : 0),
                                   st.q[2*a + 1] - (a > 0 ? st.q[2*a - 1] : 0))/length - 1));
    printf("after %.1f s the end is at (%.3f, %.3f) m\n", st.t, st.q[N - 2], st.q[N - 1]);
    printf("rods are as long as they were, to 1e-13: %s\n", off < 1e-13 ? "yes" : "no");
    printf("energy lost to the air: %.3f J, by its power %.3f J\n", E0 - E, lost);
    return 0;
}
