/* 52 - Rows as they stand: a turning wire, a knife edge, a ball on a turntable, friction

   What holds, what rolls and what rubs is typed as on paper, as L is in lesson 40: HOLDS for g(t,q) = 0, ROLLS
   for A(t,q)v + a(t,q) = 0, DISSIPATION for Rayleigh's function F(t,q,v), whose force is -dF/dv. The Jacobian and the
   rate, which lessons 22 and 43 derive by hand, are exact to rounding.

   A bead slides on a straight wire that turns with w: r = cosh(wt). A knife edge, or a skate, on a slope glides
   along its edge alone and spins with s: x = c sin²(st), y = c(st - sin(st) cos(st)), c = g sin(slope)/(2s²); it never
   runs off down the slope. The centre of a solid ball on a turntable moves in a circle, at 2/7 of the speed of the
   table. And a body that friction -bv brings to rest goes v/b far.

   prints

     turning wire:  x = 0.833730025, y = 1.298457581
     knife edge:    x = 0.012829829, y = 2.022706641
     turntable:     x = 0.833185674, y = 0.567875924
     friction:      x = 0.981684361, y = 0.000000000
     against formulas, below 1e-12: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"

static const double w = 0.5, slope = 0.3, spin = 1.5, b = 2;

LAGRANGIAN(bead, 2) { return (v[0]*v[0] + v[1]*v[1])/2; }
LAGRANGIAN(blade, 3) { return (v[0]*v[0] + v[1]*v[1])/2 + 0.1*v[2]*v[2] + 9.81*sin(slope)*q[0]; }

HOLDS(wire, 2, 1) { row[0] = cos(w*t)*q[1] - sin(w*t)*q[0]; }
ROLLS(edge, 3, 1) { row[0] = sin(q[2])*v[0] - cos(q[2])*v[1]; }
DISSIPATION(rubs, 2) { return b*(v[0]*v[0] + v[1]*v[1])/2; }

/* A ball of mass and radius 1: its centre, and Euler's angles, which give the speed of turning in space */
#define TURNING                                                                                 \
    const number s = sin(q[3]), wx = v[3]*cos(q[2]) + v[4]*s*sin(q[2]), wy = v[3]*sin(q[2]) - v[4]*s*cos(q[2])

LAGRANGIAN(ball, 5)
{
    TURNING;
    const number wz = v[2] + v[4]*cos(q[3]);
    return (v[0]*v[0] + v[1]*v[1])/2 + (wx*wx + wy*wy + wz*wz)/5;
}

/* Where it touches, the ball is as fast as the table, which turns with 1. */
ROLLS(table, 5, 2)
{
    TURNING;
    row[0] = v[0] - wy + q[1];
    row[1] = v[1] + wx - q[0];
}

/* Two seconds; how far off the formulas it ends */
static double run(const char *name, lagrangian_function function, gvi_effect row, const double *q, const double *v, double x, double y)
{
    static double memory[GVI_CONSTRAINED_LENGTH(5, 8, 8, 2)];
    static lagrangian L;
    const char *wrong = lagrangian_init(&L, function, NULL, 0, q, v);
    if (wrong) return puts(wrong), 1;
    const gvi_effect scene[] = { lagrangian_effect(&L), row };
    const gvi_desc desc = { .n = function.n, .degree = 8, .mass = lagrangian_mass(&L), .effects = scene, .effect_count = 2 };
    gvi_stepper st;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int k = 0; k < 64 && st.status == GVI_OK; ++k) gvi_step(&st, 1.0/32);
    if (st.status != GVI_OK) return puts(gvi_why(&st)), 1;
    printf("%-14s x = %.9f, y = %.9f\n", name, st.q[0], fabs(st.q[1]));
    return fmax(fabs(st.q[0] - x), fabs(st.q[1] - y));
}

int main(void)
{
    const double T = 2, c = 9.81*sin(slope)/(2*spin*spin), a = spin*T, k = 2/7.0, r = 0.3/k;
    const double start[] = { 1, 0, 0 }, none[] = { 0, 0, 0 }, turning[] = { 0, w }, spinning[] = { 0, 0, spin }, moving[] = { 2, 0 },
                 on_table[] = { 1, 0, 0, 1.5, 0 }, rolling[] = { 0, 0.3, 0, 0.7, 0 };
    double off[4];
    off[0] = run("turning wire:", bead, (gvi_effect){ .kind = GVI_CONSTRAINT, .points = wire, .rows = 1 }, start, turning,
                 cosh(w*T)*cos(w*T), cosh(w*T)*sin(w*T));
    off[1] = run("knife edge:", blade, (gvi_effect){ .kind = GVI_NONHOLONOMIC, .points = edge, .rows = 1 }, none, spinning,
                 c*sin(a)*sin(a), c*(a - sin(a)*cos(a)));
    off[2] = run("turntable:", ball, (gvi_effect){ .kind = GVI_NONHOLONOMIC, .points = table, .rows = 2 }, on_table, rolling,
                 1 - r*(1 - cos(k*T)), r*sin(k*T));
    off[3] = run("friction:", bead, (gvi_effect){ .kind = GVI_FORCE, .points = rubs }, none, moving, 2/b*(1 - exp(-b*T)), 0);
    printf("against formulas, below 1e-12: %s\n", fmax(fmax(off[0], off[1]), fmax(off[2], off[3])) < 1e-12 ? "yes" : "no");
    return 0;
}
