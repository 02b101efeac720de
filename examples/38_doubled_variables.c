/* 38 - Is motion with friction a stationary action, too? Doubled variables

   No Lagrangian of q alone gives drag f = -k |v| v. One of two copies x, y of the system does:

     L(x, x') - L(y, y') + (f(x') + f(y'))'(x - y)/2

   Where both start alike they stay alike, and each moves as L with the force f does (Galley 2013). Here a satellite
   with drag as usual, n = 2 and a force, and doubled, n = 4 with masses 1, 1, -1, -1 and a Lagrangian term: the
   Lagrange-d'Alembert principle of the library is stationary action of the copies, to rounding.

   It is never a minimum: what the first copy gains, the second loses. Half of the curve's interior directions lower
   the action, at any step length, while the curve of the undamped satellite is a minimum. The order needs none: the
   second derivative by (x', y') is regular at x = y, the action changes sign as x and y change places, so curves with
   equal ends stay equal, and the theorem of docs/theory.md gives forces the order min(2s, u, 2(u - s + 1)) that
   Lagrangians have. To compute, take the force.

   prints

     after 1600 steps, t = 100: q = 0.152439520 0.207469115, from 0.5 to 0.257 off the centre
     the copies apart by: 0
     doubled against forced, below 1e-12: yes
     directions that lower the action, of 14 of one copy: 0
     directions that lower the action, of 28 of two copies: 14
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

static const double k = 0.002;

/* Potential and drag of a copy; `sign` is that of its action */
static void attract(const gvi_points *x, int copy, double sign)
{
    const double X = x->q[2*copy], Y = x->q[2*copy + 1], d2 = X*X + Y*Y, w = -sign/(d2*sqrt(d2));
    x->f[2*copy] += w*X;
    x->f[2*copy + 1] += w*Y;
}

static void drag_of(const double *v, double *f)
{
    const double speed = sqrt(v[0]*v[0] + v[1]*v[1]);
    f[0] = -k*speed*v[0];
    f[1] = -k*speed*v[1];
}

GVI_POINTS(attraction, 2, f)(const gvi_points *x, void *user)
{
    attract(x, 0, 1);
    return (void)user, 0;
}

GVI_POINTS(drag, 2, v, f)(const gvi_points *x, void *user)
{
    double f[2];
    drag_of(x->v, f);
    x->f[0] += f[0];
    x->f[1] += f[1];
    return (void)user, 0;
}

GVI_POINTS(both_attracted, 4, f)(const gvi_points *x, void *user)
{
    attract(x, 0, 1);
    attract(x, 1, -1);
    return (void)user, 0;
}

/* d/dx = (f(x') + f(y'))/2, d/dy its negative; d/dx' = (df/dx')'(x - y)/2, with df/dv = -k (|v| + v v'/|v|) */
GVI_POINTS(both_dragged, 4, v, f, dldv)(const gvi_points *x, void *user)
{
    const double *q = x->q, d[2] = { q[0] - q[2], q[1] - q[3] };
    double f[2][2];
    for (int copy = 0; copy < 2; ++copy) {
        const double *v = x->v + 2*copy, speed = sqrt(v[0]*v[0] + v[1]*v[1]), along = v[0]*d[0] + v[1]*d[1];
        drag_of(v, f[copy]);
        for (int i = 0; i < 2; ++i) x->dldv[2*copy + i] -= k*(speed*d[i] + along*v[i]/speed)/2;
    }
    for (int i = 0; i < 2; ++i) {
        x->f[i] += (f[0][i] + f[1][i])/2;
        x->f[2 + i] -= (f[0][i] + f[1][i])/2;
    }
    return (void)user, 0;
}

/* Negative directions of the action over the first step */
static int lowered(gvi_stepper *st, const double *q0, const double *v0)
{
    int negative = -1;
    gvi_discrete_lagrangian(st, 0, 0.0625, q0, st->q, &(gvi_discrete){ .negative = &negative, .guess = v0 });
    return negative;
}

int main(void)
{
    static const double masses[4] = { 1, 1, -1, -1 }, q0[4] = { 0.5, 0, 0.5, 0 }, v0[4] = { 0, 1.4142, 0, 1.4142 };
    static double memory[2][GVI_LENGTH(4, 8, 8)];
    const gvi_effect forced[] = { { .kind = GVI_POTENTIAL, .points = attraction },
                                  { .kind = GVI_FORCE, .points = drag } };
    const gvi_effect doubled[] = { { .kind = GVI_POTENTIAL, .points = both_attracted },
                                   { .kind = GVI_LAGRANGIAN, .points = both_dragged } };
    const gvi_desc one = { .n = 2, .degree = 8, .effects = forced, .effect_count = 2 };
    const gvi_desc two = { .n = 4, .degree = 8, .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = masses },
                           .effects = doubled, .effect_count = 2 };
    gvi_stepper a, b;
    gvi_init(&a, &one, memory[0], sizeof memory[0]);
    gvi_init(&b, &two, memory[1], sizeof memory[1]);
    gvi_start(&a, 0, q0, v0);
    gvi_start(&b, 0, q0, v0);
    gvi_step(&a, 0.0625);
    gvi_step(&b, 0.0625);
    const int alone = lowered(&a, q0, v0), pair = lowered(&b, q0, v0);

    int steps = 1;
    double apart = 0, off = 0;
    for (; steps < 1600 && a.status == GVI_OK && b.status == GVI_OK; ++steps) {
        gvi_step(&a, 0.0625);
        gvi_step(&b, 0.0625);
        for (int i = 0; i < 2; ++i) {
            apart = fmax(apart, fabs(b.q[i] - b.q[2 + i]));
            off = fmax(off, fmax(fabs(a.q[i] - b.q[i]), fabs(a.p[i] - b.p[i])));
        }
    }
    printf("after %d steps, t = %g: q = %.9f %.9f, from 0.5 to %.3f off the centre\n", steps, b.t, b.q[0], b.q[1],
           sqrt(b.q[0]*b.q[0] + b.q[1]*b.q[1]));
    printf("the copies apart by: %g\n", apart);
    printf("doubled against forced, below 1e-12: %s\n", off < 1e-12 ? "yes" : "no");
    printf("directions that lower the action, of 14 of one copy: %d\n", alone);
    printf("directions that lower the action, of 28 of two copies: %d\n", pair);
    return a.status != GVI_OK || b.status != GVI_OK;
}
