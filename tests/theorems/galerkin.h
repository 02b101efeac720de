/* galerkin.h - the Galerkin integrator from its definition, without gvi.h

   For what gvi.h refuses (nodes outside [0,1], rules too weak, Gamma' singular) and to be compared with it where it
   does not: modes and the rows (1) and (2) of docs/theory.md, Newton's method with a matrix of differences.  The
   Lagrangian's derivatives are those of reference.h.                          */
#ifndef GALERKIN_H
#define GALERKIN_H

#include "bench.h"

enum { MAX_S = 10, UNKNOWNS = MAX_S*MAX_N };

/* A curve q0 + h sum_k Phi_k y_k on a step from t, and what belongs to it: y[k*n + i]; row[k*n + i], which for k = 0
   is the momentum p0 and else has to vanish; the momentum p1 and the action   */
typedef struct curve_of {
    const problem  *pb;
    const own_rule *rule;
    int             s;
    real            t, h, q0[MAX_N], y[UNKNOWNS], row[UNKNOWNS], p1[MAX_N], action;
} curve_of;

/* phi_k and its integral from 0, the modes of the velocity and of the position */
static MAYBE void modes_at(int s, real tau, real *phi, real *Phi)
{
    for (int k = 0; k < s; ++k) {
        phi[k] = (k%2 ? -1 : 1)*mode_at(k, tau);
        Phi[k] = k ? (k%2 ? -1 : 1)*(mode_at(k + 1, tau) - mode_at(k - 1, tau))/(4*k + 2) : tau;
    }
}

/* Position and velocity at tau */
static MAYBE void point_of(const curve_of *a, real tau, real *q, real *v)
{
    const int n = a->pb->n;
    real phi[MAX_S], Phi[MAX_S];
    modes_at(a->s, tau, phi, Phi);
    for (int i = 0; i < n; ++i) {
        q[i] = a->q0[i];
        v[i] = 0;
        for (int k = 0; k < a->s; ++k) {
            q[i] += a->h*Phi[k]*a->y[k*n + i];
            v[i] += phi[k]*a->y[k*n + i];
        }
    }
}

static MAYBE void fill_rows(curve_of *a)
{
    const int n = a->pb->n;
    for (int i = 0; i < a->s*n; ++i) a->row[i] = 0;
    for (int i = 0; i < n; ++i) a->p1[i] = 0;
    a->action = 0;
    for (int e = 0; e < a->rule->r; ++e) {
        const real c = a->rule->c[e], b = a->rule->b[e], t = a->t + c*a->h;
        real q[MAX_N], v[MAX_N], F[MAX_N], P[MAX_N], phi[MAX_S], Phi[MAX_S];
        modes_at(a->s, c, phi, Phi);
        point_of(a, c, q, v);
        gradient(a->pb, t, q, v, F, P);
        add_force(a->pb, t, q, v, F);
        a->action += a->h*b*a->pb->lagrangian(t, q, v);
        for (int i = 0; i < n; ++i) {
            a->p1[i] += b*(P[i] + a->h*c*F[i]);
            a->row[i] += b*(P[i] - a->h*(1 - c)*F[i]);
            for (int k = 1; k < a->s; ++k) a->row[k*n + i] += b*(phi[k]*P[i] + a->h*Phi[k]*F[i]);
        }
    }
}

/* The derivatives of the rows from `first` on by the unknowns from there on, by central differences */
static MAYBE void jacobian_of(const curve_of *a, int first, real *J)
{
    const int N = a->s*a->pb->n, m = N - first;
    const real delta = cbrt(UNIT);
    for (int j = 0; j < m; ++j) {
        curve_of up = *a, down = *a;
        up.y[first + j] += delta;
        down.y[first + j] -= delta;
        fill_rows(&up);
        fill_rows(&down);
        for (int i = 0; i < m; ++i) J[i*m + j] = (up.row[first + i] - down.row[first + i])/(2*delta);
    }
}

/* Solves the rows; p0 NULL: those of k >= 1, y_0 given.  0: no solution found  */
static MAYBE int find_curve(curve_of *a, const real *p0)
{
    const int n = a->pb->n, first = p0 ? 0 : n, N = a->s*n, m = N - first;
    real J[UNKNOWNS*UNKNOWNS], A[UNKNOWNS*UNKNOWNS], x[UNKNOWNS], last = 1;
    int found = m == 0;
    for (int it = 0; it < 60 && !found; ++it) {
        real most = 0;
        fill_rows(a);
        if (it < 3) jacobian_of(a, first, J);
        memcpy(A, J, (size_t)(m*m)*sizeof *A);
        for (int i = 0; i < m; ++i) x[i] = (p0 && i < n ? p0[i] : 0) - a->row[first + i];
        solve(m, A, x);
        for (int i = 0; i < m; ++i) {
            a->y[first + i] += x[i];
            most = larger(fabs(x[i]), most);
        }
        if (!(most < 100)) return 0;
        found = most < 4*UNIT || (most < 1e4L*UNIT && !(most < last));
        last = most;
    }
    fill_rows(a);
    return found;
}

/* Between the ends of a solution or of anything: y_0 = (q1 - q0)/h */
static MAYBE curve_of curve_between(const problem *pb, const own_rule *rule, int s, real t, real h, const real *q0,
                                    const real *q1)
{
    curve_of a = { pb, rule, s, t, h, { 0 }, { 0 }, { 0 }, { 0 }, 0 };
    for (int i = 0; i < pb->n; ++i) {
        a.q0[i] = q0[i];
        a.y[i] = (q1[i] - q0[i])/h;
    }
    if (!find_curve(&a, NULL)) a.action = (real)NAN;
    return a;
}

/* A step from y = (q, p), which becomes its end */
static MAYBE int step_of_curve(const problem *pb, const own_rule *rule, int s, real t, real h, real *y)
{
    curve_of a = { pb, rule, s, t, h, { 0 }, { 0 }, { 0 }, { 0 }, 0 };
    memcpy(a.q0, y, (size_t)pb->n*sizeof *y);
    pb->velocity(t, y, y + pb->n, a.y);
    if (!find_curve(&a, y + pb->n)) return 0;
    for (int i = 0; i < pb->n; ++i) {
        y[i] += h*a.y[i];
        y[pb->n + i] = a.p1[i];
    }
    return 1;
}

static MAYBE own_rule rule_in(const method *m)
{
    own_rule rule = { "", m->rule.points, 0, { 0 }, { 0 } };
    memcpy(rule.c, m->rule.nodes, (size_t)rule.r*sizeof *rule.c);
    memcpy(rule.b, m->rule.weights, (size_t)rule.r*sizeof *rule.b);
    return rule;
}

/* step_error() and lagrangian_error() of rules of the caller, without gvi.h  */
static MAYBE real own_step_error(const problem *pb, const method *m, real h)
{
    const own_rule rule = rule_in(m);
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        real y0[MAX_Y], y1[MAX_Y];
        exact_step(pb, start, h, y0, y1);
        if (!step_of_curve(pb, &rule, m->s, step_time(pb, h), h, y0)) return (real)NAN;
        sum += square_distance(2*pb->n, y0, y1)/STARTS;
    }
    return sqrt(sum);
}

static MAYBE real own_lagrangian_error(const problem *pb, const method *m, real h)
{
    const own_rule rule = rule_in(m);
    real sum = 0;
    for (int start = 0; start < STARTS; ++start) {
        real y0[MAX_Y], y1[MAX_Y];
        exact_step(pb, start, h, y0, y1);
        const curve_of a = curve_between(pb, &rule, m->s, step_time(pb, h), h, y0, y1);
        sum += (a.action - y1[2*pb->n])*(a.action - y1[2*pb->n])/STARTS;
    }
    return sqrt(sum);
}

/* How coercive the action of exact steps of h = 1/8, 1/16, ... is: the least ratio of its second variation to the
   integral of w'M w', M the least eigenvalue of the mass in the middle, n = 2.  Modes scaled to unit integrals. */
static MAYBE real coercivity_seen(const problem *pb, const own_rule *rule, int s)
{
    const int n = pb->n, size = (s - 1)*n;
    real found = 10;
    for (int start = 0; start < STARTS; ++start)
        for (real h = 1/8.0L; h > 1/100.0L; h /= 2) {
            real y0[MAX_Y], y1[MAX_Y], C[UNKNOWNS*UNKNOWNS], M[3];
            const real one[3][MAX_N] = { { 1, 0 }, { 0, 1 }, { 1, 1 } };
            exact_step(pb, start, h, y0, y1);
            const curve_of a = curve_between(pb, rule, s, step_time(pb, h), h, y0, y1);
            jacobian_of(&a, n, C);
            for (int i = 0; i < size; ++i)
                for (int j = 0; j < size; ++j) C[i*size + j] *= sqrt((real)((2*(i/n) + 3)*(2*(j/n) + 3)));
            for (int k = 0; k < 3; ++k) M[k] = mass_of(pb, start, one[k]);
            const real off = (M[2] - M[0] - M[1])/2, half = (M[0] - M[1])/2;
            const real lowest = (M[0] + M[1])/2 - sqrt(half*half + off*off);
            const real c = least_eigenvalue(size, C)/lowest;
            if (!(c > found)) found = c;
        }
    return found;
}

#endif
