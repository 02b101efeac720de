/* 08 - A charge in a magnetic field: a Lagrangian term linear in the velocity

   In the plane, with field B = r across it and potential 0.01/r,

         L = v'v/2 + A(x,y)'v - 0.01/r        A = r/3 (-y, x)

   The magnetic part is a term of its own: it adds dL/dq to f and dL/dv to dldv,
   so that the momentum is p = v + A.  The field is symmetric about the origin,
   and x p_y - y p_x is conserved: exactly, whatever the step.  The same field
   as a force f = B (v_y, -v_x) follows the same orbit to the order of the
   method, but nothing tells the step of its symmetry.  The energy is conserved
   by neither exactly; its error stays level in both.

   prints

     degree 2, steps of 0.1, t = 2000       as Lagrangian term   as force
     x p_y - y p_x kept to 1e-12            yes                  no
     largest relative error of the energy   2e-08                9e-10
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>

GVI_EACH(magnetic_term, 2, v, f, dldv, value)
{
    double X = x->q[0], Y = x->q[1], u = x->v[0], v = x->v[1], r = GVI_SQRT(X*X + Y*Y);
    double l = X*v - Y*u;  // L = r l/3
    x->value[0] += r*l/3;
    x->f[0] += (X/r*l + r*v)/3;
    x->f[1] += (Y/r*l - r*u)/3;
    x->dldv[0] -= r*Y/3;
    x->dldv[1] += r*X/3;
}

GVI_EACH(magnetic_force, 2, v, f)
{
    double r = GVI_SQRT(x->q[0]*x->q[0] + x->q[1]*x->q[1]);
    x->f[0] += r*x->v[1];
    x->f[1] -= r*x->v[0];
}

GVI_EACH(electric, 2, f, value)
{
    double X = x->q[0], Y = x->q[1], r2 = X*X + Y*Y, r = GVI_SQRT(r2);
    x->value[0] += 0.01/r;
    x->f[0] += 0.01*X/(r2*r);
    x->f[1] += 0.01*Y/(r2*r);
}

/* x (v_y + A_y) - y (v_x + A_x), from the velocity: the same for both.        */
static double rotation(gvi_stepper *st)
{
    double v[2] = { 0, 0 }, r2 = st->q[0]*st->q[0] + st->q[1]*st->q[1];
    gvi_velocity(st, v);
    return st->q[0]*v[1] - st->q[1]*v[0] + r2*sqrt(r2)/3;
}

static int run(const gvi_effect *magnetic, double *momentum, double *energy)
{
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = electric, .value = electric }, *magnetic };
    const gvi_desc desc = { .n = 2, .degree = 2, .effects = scene, .effect_count = 2 };
    double memory[GVI_LENGTH(2, 2, 2)], e0 = 0, e = 0, l0;
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, (double[]){ 0, 1 }, (double[]){ 0.1, 0.01 });
    gvi_energy(&st, &e0);
    l0 = rotation(&st);
    *momentum = *energy = 0;
    for (int k = 0; k < 20000 && gvi_step(&st, 0.1) == GVI_OK; ++k) {
        gvi_energy(&st, &e);
        *energy = fmax(*energy, fabs((e - e0)/e0));
        *momentum = fmax(*momentum, fabs((rotation(&st) - l0)/l0));
    }
    if (st.status != GVI_OK) puts(gvi_why(&st));
    return st.status;
}

int main(void)
{
    const gvi_effect term = { .kind = GVI_LAGRANGIAN, .points = magnetic_term, .value = magnetic_term };
    const gvi_effect force = { .kind = GVI_FORCE, .points = magnetic_force };
    double m1, e1, m2, e2;
    if (run(&term, &m1, &e1) || run(&force, &m2, &e2)) return 1;
    printf("degree 2, steps of 0.1, t = 2000       as Lagrangian term   as force\n");
    printf("x p_y - y p_x kept to 1e-12            %-20s %s\n", m1 < 1e-12 ? "yes" : "no", m2 < 1e-12 ? "yes" : "no");
    printf("largest relative error of the energy   %-20.0e %.0e\n", e1, e2);
    return 0;
}
