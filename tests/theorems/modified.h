/* modified.h - what Stoermer-Verlet keeps instead of the energy

   Its steps are, to any power of h, the motion of a modified Lagrangian (Vermeeren: Modified equations for
   variational integrators, 2017).  L = v'v/2 - U(q), to h^4:

     L_mod = L + h^2/24 (|U'|^2 - 2 U''(v,v))
               + h^4/720 (U''''(v,v,v,v) - 6 U'''(v,v,U') - 2 |U''v|^2 + 3 U''(U',U'))

   Its energy, as a function of q and the momentum p = dL_mod/dv, which is that of the run:

     H_mod = H + h^2/24 (2 U''(p,p) - |U'|^2)
               + h^4/720 (-U''''(p,p,p,p) + 6 U'''(p,p,U') + 12 |U''p|^2 - 3 U''(U',U'))

   the Baker-Campbell-Hausdorff series of kick, drift, kick as well (Hairer, Lubich, Wanner, IX.4).           */
#ifndef MODIFIED_H
#define MODIFIED_H

#include "bench.h"

static const method verlet = { 1, { GVI_LOBATTO, .points = 2 } };

/* U, |U'|^2, U''(p,p), U''''(p,p,p,p), U'''(p,p,U'), |U''p|^2, U''(U',U') */
typedef struct terms { real U, UU, Upp, Upppp, UppU, UpUp, UUU; } terms;

/* U = -cos q */
static MAYBE int pull(real t, const real *q, const real *v, real *f, real *dldv, void *user)
{
    f[0] -= sin(q[0]);
    return 0;
}

static const MAYBE problem pendulum = {
    "pendulum", 1, { .kind = GVI_MASS_UNIT }, { { .kind = GVI_POTENTIAL, .point = pull } }, 1, 0,
    NULL, unit_1, momentum_is_velocity_1, { { 2 } }, { { 0.5L } }, 16
};

static MAYBE terms pendulum_terms(const real *q, const real *p)
{
    const real s = sin(q[0]), c = cos(q[0]), pp = p[0]*p[0];
    return (terms){ -c, s*s, c*pp, -c*pp*pp, -s*s*pp, c*c*pp, c*s*s };
}

/* U = -1/|q|; along p, U is a series of Legendre polynomials */
static MAYBE terms kepler_terms(const real *q, const real *p)
{
    const real r2 = q[0]*q[0] + q[1]*q[1], r = sqrt(r2), r4 = r2*r2;
    const real a = (q[0]*p[0] + q[1]*p[1])/r2, aa = a*a, b = (p[0]*p[0] + p[1]*p[1])/r2;
    return (terms){ -1/r, 1/r4, (b - 3*aa)/r, -3*(35*aa*aa - 30*aa*b + 3*b*b)/r, (9*aa - 3*b)/r4, (b + 3*aa)/r4,
                    -2/(r4*r2*r) };
}

/* The energy to h^0, h^2, h^4 */
enum { ENERGIES = 3 };

static MAYBE void modified_energies(const problem *pb, real h, const real *q, const real *p, real *E)
{
    const terms x = pb->n == 1 ? pendulum_terms(q, p) : kepler_terms(q, p);
    E[0] = x.U;
    for (int i = 0; i < pb->n; ++i) E[0] += p[i]*p[i]/2;
    E[1] = E[0] + h*h/24*(2*x.Upp - x.UU);
    E[2] = E[1] + h*h*h*h/720*(-x.Upppp + 6*x.UppU + 12*x.UpUp - 3*x.UUU);
}

typedef struct place { const problem *pb; real h; const real *q; } place;

/* L_mod to h^4 at v, as a map from v */
static MAYBE void modified_lagrangian(const void *what, const real *v, real *L)
{
    const place *at = what;
    const terms x = at->pb->n == 1 ? pendulum_terms(at->q, v) : kepler_terms(at->q, v);
    const real h2 = at->h*at->h;
    *L = -x.U + h2/24*(x.UU - 2*x.Upp) + h2*h2/720*(x.Upppp - 6*x.UppU - 2*x.UpUp + 3*x.UUU);
    for (int i = 0; i < at->pb->n; ++i) *L += v[i]*v[i]/2;
}

/* The energy v'p - L_mod, p = dL_mod/dv, less H_mod(q, p), at the first start */
static MAYBE real legendre_error(const problem *pb, const method *m, real h)
{
    const place at = { pb, h, pb->q[0] };
    const real *v = pb->v[0];
    real L, p[MAX_N], E[ENERGIES], energy = 0;
    modified_lagrangian(&at, v, &L);
    derivative(modified_lagrangian, &at, pb->n, 1, v, UNIT, p);
    modified_energies(pb, h, at.q, p, E);
    for (int i = 0; i < pb->n; ++i) energy += v[i]*p[i];
    return fabs(energy - L - E[2]);
}

/* How far each of them leaves its first value in a run of Verlet's method from the first start */
static MAYBE void energy_ranges(const problem *pb, const method *m, real h, real *range)
{
    const int steps = (int)(pb->time/h + 0.5L);
    real y[MAX_Y], first[ENERGIES], E[ENERGIES];
    start_state(pb, 0, y);
    gvi_stepper *st = bench(pb, m, 0, y);
    modified_energies(pb, h, st->q, st->p, first);
    for (int i = 0; i < ENERGIES; ++i) range[i] = 0;
    for (int k = 0; k < steps; ++k) {
        gvi_step(st, h);
        modified_energies(pb, h, st->q, st->p, E);
        for (int i = 0; i < ENERGIES; ++i)
            range[i] = larger(st->status == GVI_OK ? fabs(E[i] - first[i]) : (real)NAN, range[i]);
    }
}

/* ------------------------------------------------------------ the ellipse turns

   Kepler, semi-axis a = 1, G = p x q, Lambda = sqrt(a): the mean over a revolution of what h^2 adds to H is
   (3 Lambda^2 - G^2)/(48 Lambda^5 G^5), and the perihelion turns as its derivative by G: in a revolution by        */
static MAYBE real shift_predicted(real e, real h)
{
    const real k = 1 - e*e;
    return -TAU/2*h*h*(4 + e*e)/(8*k*k*k);
}

/* The angle of the next perihelion after one at angle 0, and its time: where q'p = 0, by interpolation over q'p
   (Neville), from as many nodes before as after                              */
static MAYBE real shift_measured(real e, real h, real *revolution)
{
    enum { NODES = 12 };
    real y[MAX_Y] = { 1 - e, 0, 0, sqrt((1 + e)/(1 - e)) }, angle[NODES] = { 0 }, time[NODES] = { 0 }, w[NODES] = { 0 };
    gvi_stepper *st = bench(&problems[0], &verlet, 0, y);
    while (st->status == GVI_OK && !(st->t > TAU/2 && w[NODES/2 - 1] < 0 && w[NODES/2] >= 0)) {
        gvi_step(st, h);
        for (int k = 0; k + 1 < NODES; ++k) {
            w[k] = w[k + 1];
            angle[k] = angle[k + 1];
            time[k] = time[k + 1];
        }
        w[NODES - 1] = st->q[0]*st->p[0] + st->q[1]*st->p[1];
        angle[NODES - 1] = atan(st->q[1]/st->q[0]);
        time[NODES - 1] = st->t;
    }
    for (int m = 1; m < NODES; ++m)
        for (int k = 0; k + m < NODES; ++k) {
            angle[k] = (w[k + m]*angle[k] - w[k]*angle[k + 1])/(w[k + m] - w[k]);
            time[k] = (w[k + m]*time[k] - w[k]*time[k + 1])/(w[k + m] - w[k]);
        }
    *revolution = time[0];
    return st->status == GVI_OK ? angle[0] : (real)NAN;
}

#endif
