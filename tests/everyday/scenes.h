/* scenes.h - the table of scenes

   The ordinary: what lessons, papers and users begin with, at rest and moving, on an axis and off it.     */
#ifndef EVERYDAY_SCENES_H
#define EVERYDAY_SCENES_H

#include "scene.h"

#define LAW(name) static void name(const gvi_points *x, const real *par)
#define CHART(name) static void name(const real *q, const real *v, real *Q, real *V)

static real sum_of_squares(int n, const real *a)
{
    real sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i]*a[i];
    return sum;
}

/* f_i -= w q_i */
static void pull(const gvi_points *x, int from, int n, real w)
{
    for (int i = from; i < from + n; ++i) x->f[i] -= w*x->q[i];
}

/* ---- one point under a force */

LAW(attraction)
{
    const real r = sqrt(sum_of_squares(x->n, x->q));
    pull(x, 0, x->n, 1/(r*r*r));
    *x->value -= 1/r;
}

LAW(well)
{
    pull(x, 0, x->n, par[1]);
    *x->value += par[1]*sum_of_squares(x->n, x->q)/2;
}

LAW(henon_heiles)
{
    const real X = x->q[0], Y = x->q[1];
    x->f[0] -= X + 2*X*Y;
    x->f[1] -= Y + X*X - Y*Y;
    *x->value += (X*X + Y*Y)/2 + X*X*Y - Y*Y*Y/3;
}

LAW(quartic)
{
    const real d2 = sum_of_squares(x->n, x->q);
    pull(x, 0, x->n, d2);
    *x->value += d2*d2/4;
}

LAW(elastic)                            /* a spring of length 1 and stiffness par[0] that hangs from 0     */
{
    const real r = sqrt(sum_of_squares(2, x->q)), stretch = r - 1;
    pull(x, 0, 2, par[0]*stretch/r);
    x->f[1] -= 1;
    *x->value += par[0]*stretch*stretch/2 + x->q[1];
}

LAW(gravity)                            /* g = par[2], along the last coordinate of each point of the plane */
{
    const int d = x->n == 3 ? 3 : 2;
    for (int i = d - 1; i < x->n; i += d) {
        x->f[i] -= par[2];
        *x->value += par[2]*x->q[i];
    }
}

LAW(swing)
{
    x->f[0] -= par[2]*sin(x->q[0]);
    *x->value -= par[2]*cos(x->q[0]);
}

LAW(field)
{
    x->f[0] += par[2];
    *x->value -= par[2]*x->q[0];
}

/* ---- magnetic fields par[0], as A.v in two gauges and as v x B */

LAW(round_gauge)
{
    const real B = par[0]/2, *q = x->q, *v = x->v;
    x->dldv[0] -= B*q[1];
    x->dldv[1] += B*q[0];
    x->f[0] += B*v[1];
    x->f[1] -= B*v[0];
    *x->value += B*(q[0]*v[1] - q[1]*v[0]);
}

LAW(landau_gauge)
{
    const real B = par[0];
    x->dldv[0] -= B*x->q[1];
    x->f[1] -= B*x->v[0];
    *x->value -= B*x->q[1]*x->v[0];
}

LAW(lorentz)
{
    x->f[0] += par[0]*x->v[1];
    x->f[1] -= par[0]*x->v[0];
}

LAW(bottle_gauge)                       /* A = b (-y, x, 0)/2, b = par[0] (1 + z^2)                        */
{
    const real *q = x->q, *v = x->v, B = par[0]*(1 + q[2]*q[2])/2, turn = q[0]*v[1] - q[1]*v[0];
    x->dldv[0] -= B*q[1];
    x->dldv[1] += B*q[0];
    x->f[0] += B*v[1];
    x->f[1] -= B*v[0];
    x->f[2] += par[0]*q[2]*turn;
    *x->value += B*turn;
}

LAW(bottle)                             /* v x curl A                                                      */
{
    const real *q = x->q, *v = x->v, b[] = { -par[0]*q[0]*q[2], -par[0]*q[1]*q[2], par[0]*(1 + q[2]*q[2]) };
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1)%3, k = (i + 2)%3;
        x->f[i] += v[j]*b[k] - v[k]*b[j];
    }
}

LAW(two_primaries)                      /* restricted three bodies in turning axes, without Coriolis force */
{
    const real m = R(.0123), *q = x->q, to[2][2] = { { q[0] + m, q[1] }, { q[0] - 1 + m, q[1] } };
    pull(x, 0, 2, -1);
    *x->value -= sum_of_squares(2, q)/2;
    for (int k = 0; k < 2; ++k) {
        const real r = sqrt(sum_of_squares(2, to[k])), w = k ? m : 1 - m;
        x->f[0] -= w*to[k][0]/(r*r*r);
        x->f[1] -= w*to[k][1]/(r*r*r);
        *x->value -= w/r;
    }
}

/* ---- driven and damped */

LAW(duffing)
{
    const real q = x->q[0], push = par[2]*cos(par[3]*x->t[0]);
    x->f[0] += q - q*q*q + push;
    *x->value += q*q*q*q/4 - q*q/2 - q*push;
}

LAW(drag) { for (int i = 0; i < x->n; ++i) x->f[i] -= par[0]*x->v[i]; }
LAW(air)
{
    const real w = par[0]*sqrt(sum_of_squares(x->n, x->v));
    for (int i = 0; i < x->n; ++i) x->f[i] -= w*x->v[i];
}
LAW(van_der_pol) { x->f[0] += par[0]*(1 - x->q[0]*x->q[0])*x->v[0]; }

/* A pendulum whose pivot moves as a cos(w t), w = par[0], a = par[1]: in its gravity, and as a term of L */
LAW(shaken)
{
    const real g = 1 - par[1]*par[0]*par[0]*cos(par[0]*x->t[0]);
    x->f[0] -= g*sin(x->q[0]);
    *x->value -= g*cos(x->q[0]);
}

LAW(shaken_term)
{
    const real a = -par[1]*par[0]*sin(par[0]*x->t[0]), s = sin(x->q[0]);
    x->dldv[0] += a*s;
    x->f[0] += a*cos(x->q[0])*x->v[0];
    *x->value += a*s*x->v[0];
}

/* ---- M(q) and terms of L: value, v'M v/2, is for terms alone */

LAW(double_mass)
{
    x->mass[0] = 2;
    x->mass[2] = cos(x->q[0] - x->q[1]);
    x->mass[3] = 1;
}
LAW(double_gradient)
{
    const real w = -sin(x->q[0] - x->q[1])*x->v[0]*x->v[1];
    x->f[0] += w;
    x->f[1] -= w;
}
LAW(double_weight)
{
    for (int i = 0; i < 2; ++i) {
        x->f[i] -= (real)(2 - i)*par[2]*sin(x->q[i]);
        *x->value -= (real)(2 - i)*par[2]*cos(x->q[i]);
    }
}

LAW(polar_mass) { x->mass[0] = 1; x->mass[3] = x->q[0]*x->q[0]; }
LAW(polar_gradient) { x->f[0] += x->q[0]*x->v[1]*x->v[1]; }
LAW(polar_attraction) { x->f[0] -= 1/(x->q[0]*x->q[0]); *x->value -= 1/x->q[0]; }
LAW(polar_well) { x->f[0] -= par[1]*x->q[0]; *x->value += par[1]*x->q[0]*x->q[0]/2; }
LAW(polar_field)
{
    const real B = par[0], r = x->q[0];
    x->dldv[1] += B/2*r*r;
    x->f[0] += B*r*x->v[1];
    *x->value += B/2*r*r*x->v[1];
}

LAW(sphere_mass)                        /* angle from below, longitude                                     */
{
    const real s = sin(x->q[0]);
    x->mass[0] = 1;
    x->mass[3] = s*s;
}
LAW(sphere_gradient) { x->f[0] += sin(x->q[0])*cos(x->q[0])*x->v[1]*x->v[1]; }

LAW(space_mass)                         /* r, latitude, longitude                                          */
{
    const real r = x->q[0], c = cos(x->q[1]);
    x->mass[0] = 1;
    x->mass[4] = r*r;
    x->mass[8] = r*r*c*c;
}
LAW(space_gradient)
{
    const real r = x->q[0], c = cos(x->q[1]), *v = x->v;
    x->f[0] += r*(v[1]*v[1] + c*c*v[2]*v[2]);
    x->f[1] -= r*r*c*sin(x->q[1])*v[2]*v[2];
}

LAW(relativistic)                       /* -c^2/gamma, c = 5                                               */
{
    const real c2 = 25, w = 1/sqrt(1 - sum_of_squares(x->n, x->v)/c2);
    for (int i = 0; i < x->n; ++i) x->dldv[i] += w*x->v[i];
    *x->value -= c2/w;
}

LAW(fourth_power)                       /* v^2/2 + v^4/4                                                   */
{
    for (int i = 0; i < x->n; ++i) {
        const real v = x->v[i];
        x->dldv[i] += v + v*v*v;
        *x->value += v*v/2 + v*v*v*v/4;
    }
}

/* A loudspeaker: a cone's place, a charge; the coil's inductance depends on the place */
LAW(coil)
{
    const real h = tanh(x->q[0]), induct = 1 + R(.3)*h, *v = x->v;
    x->dldv[0] += v[0];
    x->dldv[1] += induct*v[1];
    x->f[0] += R(.3)*(1 - h*h)*v[1]*v[1]/2;
    *x->value += v[0]*v[0]/2 + induct*v[1]*v[1]/2;
}
LAW(coil_mass) { x->mass[0] = 1; x->mass[3] = 1 + R(.3)*tanh(x->q[0]); }
LAW(coil_gradient)
{
    const real h = tanh(x->q[0]);
    x->f[0] += R(.3)*(1 - h*h)*x->v[1]*x->v[1]/2;
}
LAW(cone)
{
    x->f[0] -= 4*x->q[0];
    x->f[1] -= x->q[1];
    *x->value += 2*x->q[0]*x->q[0] + x->q[1]*x->q[1]/2;
}

/* ---- many bodies */

LAW(fermi_pasta_ulam)
{
    for (int i = 0; i <= x->n; ++i) {
        const real d = (i < x->n ? x->q[i] : 0) - (i ? x->q[i - 1] : 0), g = d + d*d/4;
        if (i < x->n) x->f[i] -= g;
        if (i) x->f[i - 1] += g;
        *x->value += d*d/2 + d*d*d/12;
    }
}

/* A spring of length 1 and stiffness k between points i and j of the plane, j < 0: the origin */
static void spring(const gvi_points *x, int i, int j, real k)
{
    const real d[] = { x->q[2*i] - (j < 0 ? 0 : x->q[2*j]), x->q[2*i + 1] - (j < 0 ? 0 : x->q[2*j + 1]) };
    const real r = sqrt(sum_of_squares(2, d)), w = k*(r - 1)/r;
    for (int e = 0; e < 2; ++e) {
        x->f[2*i + e] -= w*d[e];
        if (j >= 0) x->f[2*j + e] += w*d[e];
    }
    *x->value += k*(r - 1)*(r - 1)/2;
}

LAW(spring_chain) { for (int i = 0; i < x->n/2; ++i) spring(x, i, i - 1, par[0]); }
LAW(square_net)                         /* four masses with four springs around and one across             */
{
    for (int i = 0; i < 4; ++i) spring(x, i, (i + 1)%4, par[0]);
    spring(x, 0, 2, par[0]);
}

/* Points of the plane of masses 1, par[3], par[4], ... attract each other */
LAW(bodies_attract)
{
    for (int i = 0; i < x->n/2; ++i)
        for (int j = 0; j < i; ++j) {
            const real d[] = { x->q[2*i] - x->q[2*j], x->q[2*i + 1] - x->q[2*j + 1] };
            const real r = sqrt(sum_of_squares(2, d)), mm = (i ? par[2 + i] : 1)*(j ? par[2 + j] : 1);
            for (int e = 0; e < 2; ++e) {
                x->f[2*i + e] -= mm*d[e]/(r*r*r);
                x->f[2*j + e] += mm*d[e]/(r*r*r);
            }
            *x->value -= mm/r;
        }
}

/* ---- constraints */

static void rod(const gvi_points *x, int row, int i, int j, real length, real px, real py)
{
    const real a = x->q[2*i] - (j < 0 ? px : x->q[2*j]), b = x->q[2*i + 1] - (j < 0 ? py : x->q[2*j + 1]);
    real *G = x->jacobian + row*x->n;
    x->g[row] = (a*a + b*b - length*length)/2;
    G[2*i] = a;
    G[2*i + 1] = b;
    if (j >= 0) G[2*j] = -a, G[2*j + 1] = -b;
}

LAW(one_rod) { rod(x, 0, 0, -1, 1, 0, 0); }
LAW(lower_rod) { rod(x, 0, 1, 0, 1, 0, 0); }
LAW(triangle) { for (int i = 0; i < 3; ++i) rod(x, i, i, (i + 1)%3, 1, 0, 0); }
LAW(four_bar)                           /* crank 1, coupler 5/2, rocker 2 about (3, 0)                     */
{
    rod(x, 0, 0, -1, 1, 0, 0);
    rod(x, 1, 1, 0, R(2.5), 0, 0);
    rod(x, 2, 1, -1, 2, 3, 0);
}
LAW(parallelogram)                      /* three cranks of length 1 about (0, 0), (1, 0), (2, 0); couplers of length 1: one row too many */
{
    for (int i = 0; i < 3; ++i) rod(x, i, i, -1, 1, (real)i, 0);
    rod(x, 3, 1, 0, 1, 0, 0);
    rod(x, 4, 2, 1, 1, 0, 0);
}
LAW(shaken_rod)                         /* its pivot moves as a cos(w t)                                   */
{
    const real y = x->q[1] - par[1]*cos(par[0]*x->t[0]);
    x->g[0] = (x->q[0]*x->q[0] + y*y - 1)/2;
    x->jacobian[0] = x->q[0];
    x->jacobian[1] = y;
    x->rate[0] = y*par[1]*par[0]*sin(par[0]*x->t[0]);
}
LAW(flat) { x->g[0] = x->q[1]; x->jacobian[1] = 1; }
LAW(wire) { x->g[0] = x->q[1] - x->q[0]*x->q[0]/2; x->jacobian[0] = -x->q[0]; x->jacobian[1] = 1; }
LAW(turning_rail)                       /* a rail through 0 that turns                                     */
{
    const real c = cos(par[0]*x->t[0]), s = sin(par[0]*x->t[0]);
    x->g[0] = c*x->q[1] - s*x->q[0];
    x->jacobian[0] = -s;
    x->jacobian[1] = c;
    x->rate[0] = -par[0]*(s*x->q[1] + c*x->q[0]);
}
LAW(ball) { x->g[0] = (sum_of_squares(x->n, x->q) - 1)/2; for (int i = 0; i < x->n; ++i) x->jacobian[i] = x->q[i]; }

/* ---- rolling */

LAW(slope) { x->f[0] += par[2]; *x->value -= par[2]*x->q[0]; }
LAW(blade) { x->jacobian[0] = sin(x->q[2]); x->jacobian[1] = -cos(x->q[2]); }
LAW(coin)                               /* x, y, direction, turn: upright, radius 1                        */
{
    x->jacobian[0] = 1;
    x->jacobian[3] = -cos(x->q[2]);
    x->jacobian[5] = 1;
    x->jacobian[7] = -sin(x->q[2]);
}
LAW(trailer)                            /* a blade at x, y with direction q2, a second one drawn 1 behind  */
{
    const real s = sin(x->q[2]), c = cos(x->q[2]), S = sin(x->q[3]), C = cos(x->q[3]);
    x->jacobian[0] = s;
    x->jacobian[1] = -c;
    x->jacobian[4] = S;
    x->jacobian[5] = -C;
    x->jacobian[7] = 1;
}
LAW(steer) { x->f[2] += par[2]*cos(x->q[2]); }

/* ---- clocks */

LAW(clock_by_distance)                  /* r^(3/2)                                                         */
{
    const real r = sqrt(sum_of_squares(x->n, x->q)), root = sqrt(r);
    *x->value += r*root;
    for (int i = 0; i < x->n; ++i) x->f[i] += 3*x->q[i]/(2*root);
}
LAW(clock_of_pairs)                     /* (sum 2/r^3)^(-1/2)                                              */
{
    real sum = 0, D[N] = { 0 };
    for (int i = 0; i < x->n/2; ++i)
        for (int j = 0; j < i; ++j) {
            const real d[] = { x->q[2*i] - x->q[2*j], x->q[2*i + 1] - x->q[2*j + 1] };
            const real r2 = sum_of_squares(2, d), w = 2/(r2*sqrt(r2));
            sum += w;
            for (int e = 0; e < 2; ++e) { D[2*i + e] -= 3*w*d[e]/r2; D[2*j + e] += 3*w*d[e]/r2; }
        }
    *x->value += 1/sqrt(sum);
    for (int i = 0; i < x->n; ++i) x->f[i] -= D[i]/(2*sum*sqrt(sum));
}

/* ---- a rigid body about its centre, by a quaternion that need not have length 1: examples/tools/body.h has the formulas */

static const real moments[] = { 1, 2, R(2.5) };
static void spin_rows(const real *e, real G[3][4])
{
    const real rows[3][4] = { { -e[1], e[0], e[3], -e[2] }, { -e[2], -e[3], e[0], e[1] }, { -e[3], e[2], -e[1], e[0] } };
    memcpy(G, rows, sizeof rows);
}
LAW(quaternion_mass)                    /* (4 G'I G + J e e')/|e|^4                                        */
{
    const real *e = x->q, e2 = sum_of_squares(4, e), J = 4*(moments[0] + moments[1] + moments[2])/3;
    real G[3][4];
    spin_rows(e, G);
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j <= i; ++j) {
            real sum = J*e[i]*e[j];
            for (int k = 0; k < 3; ++k) sum += 4*moments[k]*G[k][i]*G[k][j];
            x->mass[i*4 + j] = sum/(e2*e2);
        }
}
LAW(quaternion_gradient)                /* T = (2 sum I_k (G_k.e')^2 + J (e.e')^2/2)/|e|^4, G_k.e' = -G_k(e').e */
{
    const real *e = x->q, *v = x->v, e2 = sum_of_squares(4, e), J = 4*(moments[0] + moments[1] + moments[2])/3;
    real G[3][4], H[3][4], along = 0, T = 0, d[4];
    spin_rows(e, G);
    spin_rows(v, H);
    for (int i = 0; i < 4; ++i) along += e[i]*v[i];
    for (int i = 0; i < 4; ++i) d[i] = J*along*v[i];
    T = J*along*along/2;
    for (int k = 0; k < 3; ++k) {
        real w = 0;
        for (int i = 0; i < 4; ++i) w += G[k][i]*v[i];
        T += 2*moments[k]*w*w;
        for (int i = 0; i < 4; ++i) d[i] -= 4*moments[k]*w*H[k][i];
    }
    for (int i = 0; i < 4; ++i) x->f[i] += (d[i] - 4*T*e[i]/e2)/(e2*e2);
}
LAW(heavy)                              /* weight at body axis 3: z of it is (w^2 - x^2 - y^2 + z^2)/|e|^2 */
{
    const real *e = x->q, e2 = sum_of_squares(4, e), z = (e[0]*e[0] - e[1]*e[1] - e[2]*e[2] + e[3]*e[3])/e2;
    for (int i = 0; i < 4; ++i) x->f[i] -= par[2]*2*e[i]*((i == 0 || i == 3 ? 1 : -1) - z)/e2;
    *x->value += par[2]*z;
}

/* ---- L as it is typed: typed.c, typed.cpp */

law c_kepler, c_double_pendulum, c_charge, cxx_kepler, cxx_double_pendulum, cxx_charge;

/* ---- the same motion in the coordinates of another scene */

CHART(from_polar)
{
    const real c = cos(q[1]), s = sin(q[1]);
    Q[0] = q[0]*c;
    Q[1] = q[0]*s;
    V[0] = v[0]*c - q[0]*s*v[1];
    V[1] = v[0]*s + q[0]*c*v[1];
}
CHART(from_space)
{
    const real c = cos(q[1]), s = sin(q[1]), C = cos(q[2]), S = sin(q[2]), r = q[0], *w = v;
    Q[0] = r*c*C;
    Q[1] = r*c*S;
    Q[2] = r*s;
    V[0] = w[0]*c*C - r*s*C*w[1] - r*c*S*w[2];
    V[1] = w[0]*c*S - r*s*S*w[1] + r*c*C*w[2];
    V[2] = w[0]*s + r*c*w[1];
}
CHART(from_angles)                      /* each from below, one rod under the other                        */
{
    real X = 0, Y = 0, U = 0, W = 0;
    for (int i = 0; i < 2; ++i) {
        Q[2*i] = X += sin(q[i]);
        Q[2*i + 1] = Y -= cos(q[i]);
        V[2*i] = U += cos(q[i])*v[i];
        V[2*i + 1] = W += sin(q[i])*v[i];
    }
}
CHART(from_angle) { Q[0] = sin(q[0]); Q[1] = -cos(q[0]); V[0] = cos(q[0])*v[0]; V[1] = sin(q[0])*v[0]; }
CHART(from_sphere)
{
    const real s = sin(q[0]), c = cos(q[0]), S = sin(q[1]), C = cos(q[1]);
    Q[0] = s*C;
    Q[1] = s*S;
    Q[2] = -c;
    V[0] = c*C*v[0] - s*S*v[1];
    V[1] = c*S*v[0] + s*C*v[1];
    V[2] = s*v[0];
}

/* ---- the table */

#define V_(law) { GVI_POTENTIAL, law, 0 }
#define F_(law) { GVI_FORCE, law, 0 }
#define L_(law) { GVI_LAGRANGIAN, law, 0 }
#define C_(law) { GVI_CLOCK, law, 0 }
#define G_(law, rows) { GVI_CONSTRAINT, law, rows }
#define A_(law, rows) { GVI_NONHOLONOMIC, law, rows }
#define TURN R(6.28318530717958647692528676655900577)

#define POLAR .mass = polar_mass, .gradient = polar_gradient
#define DOUBLE .mass = double_mass, .gradient = double_gradient

static const scene scenes[] = {
    { "kepler", 2, { V_(attraction) }, { R(.4), 0 }, { 0, 2 }, .period = TURN },
    { "kepler circle", 2, { V_(attraction) }, { 1, 0 }, { 0, 1 }, .period = TURN },
    { "kepler, near the sun", 2, { V_(attraction) }, { R(.1), 0 }, { R(.3), 4 }, .period = R(.3) },
    { "kepler in space", 3, { V_(attraction) }, { R(.5), 0, 0 }, { R(.2), 1, 1 }, .period = 3 },
    { "kepler by polar coordinates", 2, { V_(polar_attraction) }, { R(.4), 0 }, { 0, 5 }, .period = TURN, POLAR,
      .like = "kepler", .to = from_polar },
    { "kepler by space coordinates", 3, { V_(polar_attraction) }, { R(.5), 0, 0 }, { R(.2), 2, 2 }, .period = 3,
      .mass = space_mass, .gradient = space_gradient, .like = "kepler in space", .to = from_space },
    { "henon-heiles from rest", 2, { V_(henon_heiles) }, { 0, R(.4) }, { 0 }, .period = TURN },
    { "henon-heiles", 2, { V_(henon_heiles) }, { 0, R(.1) }, { R(.4), 0 }, .period = TURN },
    { "oscillator from rest", 2, { V_(well) }, { 1, 0 }, { 0 }, .period = TURN, .par = { 0, 1 } },
    { "oscillator from its middle", 2, { V_(well) }, { 0, 0 }, { 1, R(.5) }, .period = TURN, .par = { 0, 1 } },
    { "oscillators unlike", 2, { V_(well) }, { 1, R(.3) }, { 0 }, .period = R(.6283), .par = { 0, 1 }, .m = { R(.01), 1 } },
    { "quartic", 2, { V_(quartic) }, { 1, R(.2) }, { 0, R(.5) }, .period = 5 },
    { "spring, soft", 2, { V_(elastic) }, { R(1.2), 0 }, { 0 }, .period = TURN, .par = { 1 } },
    { "spring, stiff", 2, { V_(elastic) }, { R(1.001), 0 }, { 0 }, .period = R(.0628), .par = { 10000 } },
    { "spring, hanging", 2, { V_(elastic) }, { R(.1), R(-1.3) }, { R(.3), 0 }, .period = R(1.98), .par = { 10 } },
    { "pendulum from rest", 1, { V_(swing) }, { R(.5) }, { 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "pendulum over the top", 1, { V_(swing) }, { 0 }, { R(2.5) }, .period = 3, .par = { 0, 0, 1 } },
    { "pendulum, all but upright", 1, { V_(swing) }, { R(3.14) }, { 0 }, .period = TURN, .par = { 0, 0, 1 } },

    { "charge, A.v, r = 1", 2, { L_(round_gauge) }, { 1, 0 }, { 0, R(-.1) }, .period = TURN, .par = { 1 } },
    { "charge, A.v, r = 10", 2, { L_(round_gauge) }, { 10, 0 }, { 0, R(-.1) }, .period = TURN, .par = { 1 } },
    { "charge, A.v, r = .1", 2, { L_(round_gauge) }, { R(.1), 0 }, { 0, R(-.1) }, .period = TURN, .par = { 1 } },
    { "charge, v x B", 2, { F_(lorentz) }, { 1, 0 }, { 0, R(-.1) }, .period = TURN, .par = { 1 },
      .tags = EXACT, .like = "charge, A.v, r = 1" },
    { "charge, landau", 2, { L_(landau_gauge) }, { 1, 0 }, { 0, R(-.1) }, .period = TURN, .par = { 1 },
      .tags = EXACT, .like = "charge, A.v, r = 1" },
    { "charge and spring at rest on an axis", 2, { L_(round_gauge), V_(well) }, { 1, 0 }, { 0 }, .period = R(3.88), .par = { 1, 1 } },
    { "charge and spring at rest off it", 2, { L_(round_gauge), V_(well) }, { 1, R(.5) }, { 0 }, .period = R(3.88), .par = { 1, 1 } },
    { "charge and spring at rest, v x B", 2, { F_(lorentz), V_(well) }, { 1, 0 }, { 0 }, .period = R(3.88), .par = { 1, 1 },
      .tags = EXACT, .like = "charge and spring at rest on an axis" },
    { "charge and spring, polar", 2, { L_(polar_field), V_(polar_well) }, { 1, 0 }, { 0 }, .period = R(3.88), .par = { 1, 1 }, POLAR,
      .like = "charge and spring at rest on an axis", .to = from_polar },
    { "charge and spring moving, polar", 2, { L_(polar_field), V_(polar_well) }, { 1, 0 }, { R(.2), R(.3) },
      .period = R(3.88), .par = { 1, 1 }, POLAR },
    { "E x B from rest", 2, { L_(round_gauge), V_(field) }, { 1, 0 }, { 0 }, .period = TURN, .par = { 1, 0, R(.3) } },
    { "E x B from rest, v x B", 2, { F_(lorentz), V_(field) }, { 1, 0 }, { 0 }, .period = TURN, .par = { 1, 0, R(.3) },
      .tags = EXACT, .like = "E x B from rest" },
    { "magnetic bottle", 3, { L_(bottle_gauge) }, { R(.3), 0, R(.2) }, { 0, R(.5), R(.4) }, .period = 3, .par = { 2 } },
    { "magnetic bottle, v x B", 3, { F_(bottle) }, { R(.3), 0, R(.2) }, { 0, R(.5), R(.4) }, .period = 3, .par = { 2 }, .like = "magnetic bottle" },
    { "foucault", 2, { L_(round_gauge), V_(well) }, { 1, 0 }, { 0 }, .period = TURN, .par = { R(.02), 1 } },
    { "foucault, v x B", 2, { F_(lorentz), V_(well) }, { 1, 0 }, { 0 }, .period = TURN, .par = { R(.02), 1 }, .tags = EXACT, .like = "foucault" },
    { "turning table", 2, { L_(round_gauge), V_(well) }, { 1, R(.2) }, { 0, R(.3) }, .period = 3, .par = { 2, R(.5) } },
    { "three bodies, restricted, at rest", 2, { L_(round_gauge), V_(two_primaries) }, { R(.5), 0 }, { 0 }, .period = 1, .par = { 2 } },
    { "three bodies, restricted", 2, { L_(round_gauge), V_(two_primaries) }, { R(.5), R(.3) }, { R(.3), R(.5) }, .period = 2, .par = { 2 } },
    { "three bodies, restricted, Coriolis", 2, { F_(lorentz), V_(two_primaries) }, { R(.5), R(.3) }, { R(.3), R(.5) }, .period = 2, .par = { 2 },
      .tags = EXACT, .like = "three bodies, restricted" },

    { "duffing", 1, { V_(duffing), F_(drag) }, { 1 }, { 0 }, .period = R(4.4), .par = { R(.2), 0, R(.3), R(1.2) }, .tags = TIMED },
    { "projectile", 2, { V_(field), F_(air) }, { 0, 0 }, { 0, 1 }, .period = 3, .par = { R(.3), 0, R(.5) } },
    { "damped, stiff", 2, { V_(well), F_(drag) }, { 1, 0 }, { 0 }, .period = R(.2), .par = { 10, 1000 } },
    { "van der pol", 1, { V_(well), F_(van_der_pol) }, { 1 }, { 0 }, .period = TURN, .par = { 1, 1 } },
    { "vibrating pivot, as gravity", 1, { V_(shaken) }, { 3 }, { 0 }, .period = R(.1257), .par = { 50, R(.1) }, .tags = TIMED },
    { "vibrating pivot, as term", 1, { L_(shaken_term), V_(swing) }, { 3 }, { 0 }, .period = R(.1257), .par = { 50, R(.1), 1 }, .tags = TIMED,
      .like = "vibrating pivot, as gravity" },

    { "double pendulum from rest", 2, { V_(double_weight) }, { R(.8), R(.5) }, { 0 }, .period = 1, .par = { 0, 0, R(9.81) }, DOUBLE },
    { "double pendulum", 2, { V_(double_weight) }, { R(.3), R(.2) }, { 1, -2 }, .period = 1, .par = { 0, 0, R(9.81) }, DOUBLE },
    { "spherical pendulum", 2, { V_(swing) }, { R(.8), 0 }, { 0, 2 }, .period = 2, .par = { 0, 0, R(9.81) },
      .mass = sphere_mass, .gradient = sphere_gradient },
    { "relativistic kepler", 2, { L_(relativistic), V_(attraction) }, { R(.4), 0 }, { 0, 2 }, .period = 4, .massless = 1 },
    { "relativistic, a field, from rest", 2, { L_(relativistic), V_(field) }, { 0, 0 }, { 0 }, .period = 3, .par = { 0, 0, 1 }, .massless = 1 },
    { "fourth power of v", 2, { L_(fourth_power), V_(well) }, { 1, R(.5) }, { 0, R(.3) }, .period = 6, .par = { 0, 1 }, .massless = 1 },
    { "loudspeaker", 2, { L_(coil), V_(cone) }, { R(.5), 0 }, { 0, 1 }, .period = R(3.14), .massless = 1 },
    { "loudspeaker from rest", 2, { L_(coil), V_(cone) }, { R(.5), 1 }, { 0 }, .period = R(3.14), .massless = 1 },
    { "loudspeaker by M(q)", 2, { V_(cone) }, { R(.5), 0 }, { 0, 1 }, .period = R(3.14), .mass = coil_mass, .gradient = coil_gradient,
      .tags = EXACT, .like = "loudspeaker" },

    { "kepler, typed in C", 2, { L_(c_kepler) }, { R(.4), 0 }, { 0, 2 }, .period = TURN, .massless = 1, .tags = EXACT, .like = "kepler" },
    { "double pendulum, typed in C", 2, { L_(c_double_pendulum) }, { R(.3), R(.2) }, { 1, -2 }, .period = 1, .massless = 1,
      .tags = EXACT, .like = "double pendulum" },
    { "charge and spring, typed in C", 2, { L_(c_charge) }, { 1, R(.5) }, { 0 }, .period = R(3.88), .massless = 1,
      .tags = EXACT, .like = "charge and spring at rest off it" },
#ifndef WITHOUT_CXX
    { "kepler, typed in C++", 2, { L_(cxx_kepler) }, { R(.4), 0 }, { 0, 2 }, .period = TURN, .massless = 1, .tags = EXACT, .like = "kepler" },
    { "double pendulum, typed in C++", 2, { L_(cxx_double_pendulum) }, { R(.3), R(.2) }, { 1, -2 }, .period = 1, .massless = 1,
      .tags = EXACT, .like = "double pendulum" },
    { "charge and spring, typed in C++", 2, { L_(cxx_charge) }, { 1, R(.5) }, { 0 }, .period = R(3.88), .massless = 1,
      .tags = EXACT, .like = "charge and spring at rest off it" },
#endif

    { "chain of eight", 8, { V_(fermi_pasta_ulam) }, { R(.3), R(.5), R(.6), R(.4), R(.1), R(-.2), R(-.3), R(-.1) }, { 0 }, .period = R(3.14) },
    { "chain of eight, one moved", 8, { V_(fermi_pasta_ulam) }, { R(.5) }, { 0 }, .period = R(3.14) },
    { "hanging chain", 6, { V_(spring_chain), V_(gravity) }, { R(.6), R(-.8), R(1.5), R(-1.3), R(2.4), R(-1.5) }, { 0 },
      .period = R(.45), .par = { 100, 0, 1 } },
    { "net", 8, { V_(square_net) }, { 0, 0, 1, 0, R(1.1), 1, 0, 1 }, { R(.1) }, .period = 3, .par = { 2 } },
    { "three bodies", 6, { V_(bodies_attract) }, { 1, 0, R(-.5), R(.8), R(-.5), R(-.8) }, { 0, R(.8), R(-.7), R(-.4), R(.7), R(-.4) },
      .period = 3, .par = { 0, 0, 0, 1, 1 } },
    { "sun and planets", 6, { V_(bodies_attract) }, { 0, 0, 1, 0, 0, R(1.8) }, { 0, 0, 0, 1, R(-.7), 0 },
      .period = TURN, .par = { 0, 0, 0, R(.001), R(.0003) }, .m = { 1, 1, R(.001), R(.001), R(.0003), R(.0003) } },
    { "spinning body", 4, { { 0, NULL, 0 } }, { 1, 0, 0, 0 }, { 0, R(.05), 1, R(.05) }, .period = 3,
      .mass = quaternion_mass, .gradient = quaternion_gradient },
    { "spinning body, length 1", 4, { G_(ball, 1) }, { 1, 0, 0, 0 }, { 0, R(.05), 1, R(.05) }, .period = 3,
      .mass = quaternion_mass, .gradient = quaternion_gradient, .like = "spinning body" },
    { "heavy top", 4, { V_(heavy) }, { R(.96), R(.28), 0, 0 }, { R(-.14), R(.48), 0, 2 }, .period = R(1.5), .par = { 0, 0, 1 },
      .mass = quaternion_mass, .gradient = quaternion_gradient },

    { "rod from rest", 2, { V_(gravity), G_(one_rod, 1) }, { R(.6), R(-.8) }, { 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "rod", 2, { V_(gravity), G_(one_rod, 1) }, { 0, -1 }, { R(.7), 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "rod, level", 2, { V_(gravity), G_(one_rod, 1) }, { 1, 0 }, { 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "pendulum for the rod", 1, { V_(swing) }, { 0 }, { R(.7) }, .period = TURN, .par = { 0, 0, 1 }, .like = "rod", .to = from_angle },
    { "two rods from rest", 4, { V_(gravity), G_(one_rod, 1), G_(lower_rod, 1) }, { R(.6), R(-.8), R(1.2), R(-1.6) }, { 0 },
      .period = 4, .par = { 0, 0, 1 } },
    { "two rods, pushed", 4, { V_(gravity), G_(one_rod, 1), G_(lower_rod, 1) }, { 0, -1, 0, -2 }, { R(.5), 0, R(-.3), 0 },
      .period = 4, .par = { 0, 0, 1 } },
    { "double pendulum for two rods", 2, { V_(double_weight) }, { 0, 0 }, { R(.5), R(-.8) }, .period = 4, .par = { 0, 0, 1 }, DOUBLE,
      .like = "two rods, pushed", .to = from_angles },
    { "triangle of rods", 6, { V_(gravity), G_(triangle, 3) }, { 0, 0, 1, 0, R(.5), R(.86602540378443864676372317075294) },
      { 0, 0, 0, 1, R(-.86602540378443864676372317075294), R(.5) }, .period = 3, .par = { 0, 0, 1 } },
    { "four-bar linkage", 4, { V_(gravity), G_(four_bar, 3) }, { 0, 1, R(1.8633249580710800), R(1.6466624790355400) }, { 0 },
      .period = 3, .par = { 0, 0, 1 } },
    { "parallelogram", 6, { V_(gravity), G_(parallelogram, 5) }, { R(.6), R(-.8), R(1.6), R(-.8), R(2.6), R(-.8) }, { 0 },
      .period = TURN, .par = { 0, 0, 1 } },
    { "rod, vibrating pivot", 2, { V_(gravity), G_(shaken_rod, 1) }, { R(.6), R(-.7) }, { 0 },
      .period = R(.314), .par = { 20, R(.1), 1 }, .tags = TIMED },
    { "floor through 0", 2, { V_(field), G_(flat, 1) }, { 0, 0 }, { 1, 0 }, .period = 3, .par = { 0, 0, R(.5) } },
    { "floor and spring", 2, { V_(well), G_(flat, 1) }, { 1, 0 }, { 0 }, .period = TURN, .par = { 0, 1 } },
    { "wire", 2, { V_(gravity), G_(wire, 1) }, { 1, R(.5) }, { 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "wire from its bottom", 2, { V_(gravity), G_(wire, 1) }, { 0, 0 }, { 1, 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "turning rail", 2, { V_(well), G_(turning_rail, 1) }, { 1, 0 }, { 0, 1 }, .period = 3, .par = { 1, 2 }, .tags = TIMED },
    { "ball on a sphere", 3, { V_(gravity), G_(ball, 1) }, { R(.6), 0, R(-.8) }, { 0, R(.5), 0 }, .period = TURN, .par = { 0, 0, 1 } },
    { "angles for the ball", 2, { V_(swing) }, { R(.64350110879328438680280922871732), 0 }, { 0, R(.83333333333333333333333333333333) },
      .period = TURN, .par = { 0, 0, 1 },
      .mass = sphere_mass, .gradient = sphere_gradient, .like = "ball on a sphere", .to = from_sphere },
    { "charge on a rod", 2, { L_(round_gauge), V_(gravity), G_(one_rod, 1) }, { R(.6), R(-.8) }, { 0 }, .period = TURN, .par = { 1, 0, 1 } },

    { "sleigh", 3, { V_(slope), A_(blade, 1) }, { 0, 0, R(.2) }, { R(.4900332889206208), R(.09933466539753061), 1 },
      .period = 3, .par = { 0, 0, 1 } },
    { "coin", 4, { F_(steer), A_(coin, 2) }, { 0, 0, 0, 0 }, { 1, 0, R(.5), 1 }, .period = 4, .par = { 0, 0, 1 } },
    { "trailer", 4, { F_(steer), A_(trailer, 2) }, { 0, 0, 0, R(.3) }, { 1, 0, R(.5), R(-.29552020666133955) }, .period = 3, .par = { 0, 0, R(.5) } },

    { "kepler with a clock", 2, { V_(attraction), C_(clock_by_distance) }, { R(.4), 0 }, { 0, 2 }, .period = TURN },
    { "kepler with a clock and air", 2, { V_(attraction), F_(air), C_(clock_by_distance) }, { R(.4), 0 }, { 0, 2 }, .period = TURN,
      .par = { R(.05) } },
    { "kepler .99 with a clock", 2, { V_(attraction), C_(clock_by_distance) }, { R(1.99), 0 }, { 0, R(.07088812050083358) }, .period = TURN },
    { "kepler .999999 with a clock", 2, { V_(attraction), C_(clock_by_distance) }, { R(1.999999), 0 }, { 0, R(.000707106958) }, .period = TURN },
    { "three bodies with a clock", 6, { V_(bodies_attract), C_(clock_of_pairs) }, { 1, 0, R(-.5), R(.8), R(-.5), R(-.8) },
      { 0, R(.8), R(-.7), R(-.4), R(.7), R(-.4) }, .period = 3, .par = { 0, 0, 0, 1, 1 } },
};
#define SCENES COUNT(scenes)

#endif
