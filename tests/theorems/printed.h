/* printed.h - two statements of the paper about forces as they are printed

   (dLdA3): momenta p0 = -D_1 L_d - F-, p1 = D_2 L_d + F+, D_i the derivatives of the stationary L_d(q0, q1), but F-, F+
   at fixed inner control points, F- = h sum_i b_i f_i l_0(c_i), F+ = h sum_i b_i f_i l_s(c_i).  What the work of the
   inner points gives to the ends is lost: a force f acts as (B_0 + B_s) f, B_k the integral of l_k.

   6.2: the first term of L_d - L_exact is the action's difference between the forced solution and the polynomial
   through it at the control points.                                          */
#ifndef PRINTED_H
#define PRINTED_H

#include "galerkin.h"

/* L = v^2/2 - q^2/2, f = 1 - v/2, or a share of it */
static real share_of_push;

static MAYBE int push(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] += share_of_push*(1 - v[0]/2);
    return 0;
}

static const MAYBE problem pushed = {
    "oscillator, push", 1, { .kind = GVI_MASS_UNIT }, { SPRING, { .kind = GVI_FORCE, .point = push } }, 2, 1,
    oscillator_lagrangian, unit_1, momentum_is_velocity_1, { { 0.5L } }, { { 0.2L } }, 1
};

/* The Lagrange polynomial of control point k of k/s, k = 0..s, at tau */
static MAYBE real lagrange_at(int s, int k, real tau)
{
    real value = 1;
    for (int j = 0; j <= s; ++j)
        if (j != k) value *= (s*tau - j)/(k - j);
    return value;
}

/* One coordinate.  What the force does to each end: at fixed inner points, less with the curve's own dependence on its
   ends                                                                       */
static MAYBE void lost_work(const curve_of *a, real q1, real lost[2])
{
    const real delta = cbrt(UNIT);
    for (int end = 0; end < 2; ++end) {
        const real up_0 = a->q0[0] + (end ? 0 : delta), down_0 = a->q0[0] - (end ? 0 : delta);
        const real up_1 = q1 + (end ? delta : 0), down_1 = q1 - (end ? delta : 0);
        const curve_of up = curve_between(a->pb, a->rule, a->s, a->t, a->h, &up_0, &up_1);
        const curve_of down = curve_between(a->pb, a->rule, a->s, a->t, a->h, &down_0, &down_1);
        lost[end] = 0;
        for (int i = 0; i < a->rule->r; ++i) {
            const real c = a->rule->c[i];
            real q, v, q_up, q_down, f = 0;
            point_of(a, c, &q, &v);
            add_force(a->pb, a->t + c*a->h, &q, &v, &f);
            point_of(&up, c, &q_up, &v);
            point_of(&down, c, &q_down, &v);
            lost[end] += a->h*a->rule->b[i]*f*(lagrange_at(a->s, end*a->s, c) - (q_up - q_down)/(2*delta));
        }
    }
}

/* The position after `steps` steps of it in a time of 1; Gauss's rule of s points */
static MAYBE real position_as_printed(int s, int steps)
{
    const problem *pb = &pushed;
    const own_rule rule = gauss(s);
    const real h = 1/(real)steps;
    real q = pb->q[0][0], p = pb->v[0][0];
    for (int k = 0; k < steps; ++k) {
        real q1 = q + h*p, lost[2] = { 0, 0 };
        curve_of a = { 0 };
        for (int it = 0; it < 40; ++it) {                  /* dp0/dq1 is about -1/h */
            a = curve_between(pb, &rule, s, k*h, h, &q, &q1);
            lost_work(&a, q1, lost);
            q1 += h*(p - (a.row[0] - lost[0]));
        }
        p = a.p1[0] + lost[1];
        q = q1;
    }
    return q;
}

/* ------------------------------------------------------------------------ 6.2 */

typedef enum control { AT_LOBATTO, EQUIDISTANT, AT_RANDOM } control;
static MAYBE control control_points;

static MAYBE own_rule controls(int s)
{
    own_rule at = control_points == AT_LOBATTO ? lobatto(s + 1) : random_rule(s + 1, s + 1, 1);
    if (control_points == EQUIDISTANT) at = newton_cotes(s + 1);
    at.c[0] = 0;
    at.c[s] = 1;
    return at;
}

static MAYBE real first_term(const problem *pb, const method *m, real h)
{
    const own_rule at = controls(m->s), fine = gauss(12);
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        real y0[MAX_Y], y1[MAX_Y], node[MAX_R][MAX_Y], action = 0;
        exact_step(pb, start, h, y0, y1);
        nodes_of_step(pb, start, h, &at, node);
        for (int i = 0; i < fine.r; ++i) {
            real q[MAX_N], v[MAX_N];
            interpolant(pb, &at, h, node, fine.c[i], q, v);
            action += h*fine.b[i]*pb->lagrangian(step_time(pb, h) + fine.c[i]*h, q, v);
        }
        sum += (action - y1[2*pb->n])*(action - y1[2*pb->n])/STARTS;
    }
    return sqrt(sum);
}

#endif
