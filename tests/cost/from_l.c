/* What does it cost to give L alone (examples/tools/lagrangian.h)?  Systems with derivatives by hand and from L:
   time of a step of degree 8, as C or as C++, and how far apart the two are at the end.  from_l NAME 0 or 1: 500 steps of
   that system without the watch, or with it, whose instructions tests/tools/watch.sh counts.  make from-l */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include <math.h>
#include <stdio.h>
#include <time.h>

/* -- by hand, as the guide teaches */

GVI_EACH(attraction, 2, f)
{
    const double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2));
    x->f[0] += w*X;
    x->f[1] += w*Y;
}

/* a charge: A = (-y/2, x/2 + x^3/12), V = (x^2 + 4y^2)/2 */
GVI_EACH(magnetic, 2, v, f, dldv)
{
    const double X = x->q[0], Y = x->q[1];
    x->dldv[0] -= Y/2;
    x->dldv[1] += X/2 + X*X*X/12;
    x->f[0] += (0.5 + X*X/4)*x->v[1] - X;
    x->f[1] += -x->v[0]/2 - 4*Y;
}

static const double g = 9.81;

GVI_EACH(links, 2, mass)
{
    x->mass[0] = 2;
    x->mass[2] = cos(x->q[0] - x->q[1]);
    x->mass[3] = 1;
}

GVI_EACH(links_gradient, 2, v, f)
{
    const double s = sin(x->q[0] - x->q[1])*x->v[0]*x->v[1];
    x->f[0] -= s;
    x->f[1] += s;
}

GVI_EACH(weight, 2, f)
{
    x->f[0] -= 2*g*sin(x->q[0]);
    x->f[1] -= g*sin(x->q[1]);
}

/* lesson 41: x and the lean of a body on wheels */
GVI_EACH(wheels, 2, mass)
{
    x->mass[0] = 13;
    x->mass[2] = 5*cos(x->q[1]);
    x->mass[3] = 3.3;
}

GVI_EACH(wheels_gradient, 2, v, f) { x->f[1] -= 5*sin(x->q[1])*x->v[0]*x->v[1]; }
GVI_EACH(leaning_weight, 2, f) { x->f[1] += 5*g*sin(x->q[1]); }

/* the planet near the speed of light, c = 5 */
GVI_EACH(fast_by_hand, 2, v, f, dldv)
{
    const double X = x->q[0], Y = x->q[1], U = x->v[0], W = x->v[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2)),
                 gamma = 1/GVI_SQRT(1 - (U*U + W*W)/25);
    x->f[0] += w*X;
    x->f[1] += w*Y;
    x->dldv[0] += gamma*U;
    x->dldv[1] += gamma*W;
}

/* five bodies in the plane, G = 1 */
static const double masses[10] = { 1, 1, 1e-3, 1e-3, 3e-4, 3e-4, 4e-5, 4e-5, 5e-5, 5e-5 };

GVI_EACH(gravity, 10, f)
{
    GVI_UNROLL for (int i = 1; i < 5; ++i)
        GVI_UNROLL for (int j = 0; j < i; ++j) {
            const double u = x->q[2*i] - x->q[2*j], w = x->q[2*i+1] - x->q[2*j+1], d2 = u*u + w*w,
                         s = masses[2*i]*masses[2*j]/(d2*GVI_SQRT(d2));
            x->f[2*i] -= s*u;
            x->f[2*i+1] -= s*w;
            x->f[2*j] += s*u;
            x->f[2*j+1] += s*w;
        }
}

/* -- as on paper */

LAGRANGIAN(planet, 2) { return (v[0]*v[0] + v[1]*v[1])/2 + 1/sqrt(q[0]*q[0] + q[1]*q[1]); }

LAGRANGIAN(charge, 2)
{
    const number x = q[0], y = q[1];
    return (v[0]*v[0] + v[1]*v[1])/2 - y/2*v[0] + (x/2 + x*x*x/12)*v[1] - (x*x + 4*y*y)/2;
}

LAGRANGIAN(pendulum, 2)
{
    return v[0]*v[0] + v[1]*v[1]/2 + v[0]*v[1]*cos(q[0] - q[1]) + 2*g*cos(q[0]) + g*cos(q[1]);
}

LAGRANGIAN(leaning, 2)
{
    const number a = q[1], u = v[0], w = v[1];
    return (2 + 0.04/(0.2*0.2) + 10)*u*u/2 + 10*0.5*cos(a)*u*w + (10*0.5*0.5 + 0.8)*w*w/2 - 10*g*0.5*cos(a);
}

LAGRANGIAN(fast, 2)
{
    const double c2 = 25;
    return -c2*sqrt(1 - (v[0]*v[0] + v[1]*v[1])/c2) + 1/sqrt(q[0]*q[0] + q[1]*q[1]);
}

LAGRANGIAN(planets, 10)
{
    number L = 0;
    for (int i = 0; i < 5; ++i) {
        L += masses[2*i]*(v[2*i]*v[2*i] + v[2*i+1]*v[2*i+1])/2;
        for (int j = 0; j < i; ++j) {
            const number x = q[2*i] - q[2*j], y = q[2*i+1] - q[2*j+1];
            L += masses[2*i]*masses[2*j]/sqrt(x*x + y*y);
        }
    }
    return L;
}

static const char *only;               /* this system, from L, for 500 steps   */
static int watch;

static double seconds(void)
{
    return (double)clock()/CLOCKS_PER_SEC;
}

/* Nanoseconds a step, the least of five runs; st ends at the end of the last */
static double run(const gvi_desc *desc, double h, int steps, const double *q, const double *v, gvi_stepper *st, double *memory,
                  size_t size)
{
    double best = HUGE_VAL;
    for (int k = 0; k < 5; ++k) {
        gvi_init(st, desc, memory, size);
        gvi_start(st, 0, q, v);
        const double from = seconds();
        for (int i = 0; i < steps && st->status == GVI_OK; ++i) gvi_step(st, h);
        best = fmin(best, 1e9*(seconds() - from)/steps);
    }
    if (st->status != GVI_OK) puts(gvi_why(st));
    return best;
}

static void compare(const char *name, lagrangian_function function, gvi_desc by_hand, double h, int steps, const double *q,
                    const double *v)
{
    static double memory[2][100000];
    static lagrangian L;
    gvi_stepper a, b;
    if (only && strcmp(only, name)) return;
    const char *wrong = lagrangian_init(&L, function, NULL, 0, q, v);
    if (wrong) { puts(wrong); return; }
    const gvi_effect effect = lagrangian_effect(&L);
    gvi_desc desc = by_hand;
    desc.effects = &effect;
    desc.mass = lagrangian_mass(&L);
    if (only) {
        if (!watch) L.points = -2000000000;                   // so many before the next look
        gvi_init(&b, &desc, memory[1], sizeof memory[1]);
        gvi_start(&b, 0, q, v);
        for (int i = 0; i < 500 && b.status == GVI_OK; ++i) gvi_step(&b, h);
        return;
    }
    const double hand = run(&by_hand, h, steps, q, v, &a, memory[0], sizeof memory[0]),
                 from_l = run(&desc, h, steps, q, v, &b, memory[1], sizeof memory[1]);
    double apart = 0;
    for (int i = 0; i < by_hand.n; ++i) apart = fmax(apart, fabs(a.q[i] - b.q[i]));
    printf("%-22s %-10s %8.0f %8.0f %6.2f   %.1e\n", name, strtok(strcpy(L.why, gvi_formulation_text(&b)), ":"), hand,
           from_l, from_l/hand, apart);
}

static gvi_desc scene(int n, gvi_effect *effect, gvi_kind kind, gvi_points_fn *points)
{
    gvi_desc desc;
    memset(&desc, 0, sizeof desc);
    memset(effect, 0, sizeof *effect);
    effect->kind = kind;
    effect->points = points;
    desc.n = n;
    desc.degree = 8;
    desc.effects = effect;
    desc.effect_count = 1;
    return desc;
}

int main(int argc, char **argv)
{
    only = argc > 2 ? argv[1] : NULL;
    watch = argc > 2 && argv[2][0] == '1';
    static const double q2[] = { 0.4, 0 }, v2[] = { 0, 2 }, q_charge[] = { 0.8, 0.4 }, v_charge[] = { 0, 0.5 },
                        at_rest[] = { 0, 0 }, q_leaning[] = { 0, 3 }, q_planets[] = { 0, 0, 5.2, 0, 0, 9.5, -19, 0, 0, -30 },
                        v_planets[] = { 0, 0, 0, 0.4385, -0.324, 0, 0, -0.229, 0.1826, 0 };
    gvi_effect effect;
    gvi_desc d;
    if (!only) puts("ns a step                         by hand   from L  ratio   apart");
    compare("planet", planet, scene(2, &effect, GVI_POTENTIAL, attraction), 0.1, 20000, q2, v2);
    d = scene(10, &effect, GVI_POTENTIAL, gravity);
    d.mass.kind = GVI_MASS_DIAGONAL;
    d.mass.matrix = masses;
    compare("five bodies", planets, d, 1, 2000, q_planets, v_planets);
    compare("charge", charge, scene(2, &effect, GVI_LAGRANGIAN, magnetic), 0.2, 10000, q_charge, v_charge);
    d = scene(2, &effect, GVI_POTENTIAL, weight);
    d.mass.kind = GVI_MASS_POSITION;
    d.mass.points = links;
    d.mass.gradient = links_gradient;
    compare("double pendulum", pendulum, d, 0.05, 10000, q_charge, at_rest);
    d = scene(2, &effect, GVI_POTENTIAL, leaning_weight);
    d.mass.kind = GVI_MASS_POSITION;
    d.mass.points = wheels;
    d.mass.gradient = wheels_gradient;
    compare("lesson 41", leaning, d, 0.05, 10000, q_leaning, at_rest);
    d = scene(2, &effect, GVI_LAGRANGIAN, fast_by_hand);
    d.mass.kind = GVI_MASS_NONE;
    compare("relativistic planet", fast, d, 0.1, 3000, q2, v2);
    return 0;
}
