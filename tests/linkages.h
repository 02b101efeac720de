/* linkages.h - constrained systems that tests and studies integrate, for all types

   To be included after gvi.h and a typedef of `real`; brings <tgmath.h>.  Each brings constraint, effects,
   mass, start, and what of it an index-1 integration needs that shares nothing with gvi.h. */
#ifndef TESTS_LINKAGES_H
#define TESTS_LINKAGES_H

#include <string.h>
#include <tgmath.h>
#undef I                                          // of <complex.h>, which it includes

enum { MOST_N = 9, MOST_M = 6 };
typedef enum { PENDULUM, SPHERE, RODS, FOUR_BAR, DIRECTORS, QUATERNION, PIVOT, FRICTION, MAGNET, LINKAGES } linkage_id;
#define LINKAGE static __attribute__((unused))

/* |q| = 1, from the pivot if there is one: (sin(2t)/3, 0, ...) */
LINKAGE int sphere(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real a = user ? sin(2*x->t[k])/3 : 0, da = user ? 2*cos(2*x->t[k])/3 : 0;
        x->g[k] = -(real)0.5L;
        for (int i = 0; i < x->n; ++i) {
            const real q = x->q[i*R + k] - (i == 0 ? a : 0);
            x->g[k] += q*q/2;
            x->jacobian[i*R + k] = q;
            if (i == 0 && user) x->rate[k] = -da*q;
        }
    }
    return 0;
}

/* A rod between points i and j of the plane, or from i to a fixed point (x, y): (|r|^2 - length^2)/2 */
LINKAGE void rod(const gvi_points *x, int row, int i, int j, real length, real px, real py)
{
    const int R = x->stride, n = x->n;
    for (int k = 0; k < x->count; ++k) {
        const real a = x->q[2*i*R + k] - (j < 0 ? px : x->q[2*j*R + k]);
        const real b = x->q[(2*i + 1)*R + k] - (j < 0 ? py : x->q[(2*j + 1)*R + k]);
        x->g[row*R + k] = (a*a + b*b - length*length)/2;
        x->jacobian[(row*n + 2*i)*R + k] = a;
        x->jacobian[(row*n + 2*i + 1)*R + k] = b;
        if (j < 0) continue;
        x->jacobian[(row*n + 2*j)*R + k] = -a;
        x->jacobian[(row*n + 2*j + 1)*R + k] = -b;
    }
}

/* Two rods of unit length, or of that given; or one of them alone */
LINKAGE int rods(const gvi_points *x, void *user)
{
    const real length = user ? *(const real *)user : 1;
    rod(x, 0, 0, -1, length, 0, 0);
    rod(x, 1, 1, 0, length, 0, 0);
    return 0;
}
LINKAGE int upper_rod(const gvi_points *x, void *user) { return (void)user, rod(x, 0, 0, -1, 1, 0, 0), 0; }
LINKAGE int lower_rod(const gvi_points *x, void *user) { return (void)user, rod(x, 0, 1, 0, 1, 0, 0), 0; }

/* Crank 1, coupler 5/2, rocker 2 about (3, 0) */
LINKAGE int four_bar(const gvi_points *x, void *user)
{
    (void)user;
    rod(x, 0, 0, -1, 1, 0, 0);
    rod(x, 1, 1, 0, (real)2.5L, 0, 0);
    rod(x, 2, 1, -1, 2, 3, 0);
    return 0;
}

/* d_a . d_b = delta_ab for three directors */
GVI_EACH(directors, 9, rows(6))
{
    for (int row = 0, a = 0; a < 3; ++a)
        for (int b = a; b < 3; ++b, ++row) {
            real sum = a == b ? -1 : 0;
            for (int i = 0; i < 3; ++i) {
                sum += x->q[3*a + i]*x->q[3*b + i];
                x->jacobian[row*9 + 3*a + i] = x->q[3*b + i];
                x->jacobian[row*9 + 3*b + i] = x->q[3*a + i];
            }
            x->g[row] = a == b ? sum/2 : sum;
        }
}

/* Three equal cranks in parallel, all bars between their ends: 6 rows of rank 5.  Each end swings as a pendulum */
LINKAGE int cranks(const gvi_points *x, void *user)
{
    for (int k = 0; k < 3; ++k) rod(x, k, k, -1, 1, (real)(k*(k + 1)/2), 0);
    rod(x, 3, 1, 0, 1, 0, 0);
    rod(x, 4, 2, 1, 2, 0, 0);
    rod(x, 5, 2, 0, 3, 0, 0);
    return (void)user, 0;
}

/* A constant force; V = -force'q */
LINKAGE int constant(const gvi_points *x, void *user)
{
    const real *force = (const real *)user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            if (x->f) x->f[i*x->stride + k] += force[i];
            if (x->value) x->value[k] -= force[i]*x->q[i*x->stride + k];
        }
    return 0;
}

LINKAGE int drag(const gvi_points *x, void *user)
{
    (void)user;
    for (int i = 0; i < x->n*x->stride; ++i) x->f[i] -= x->v[i]/10;
    return 0;
}

/* L = (x vy - y vx)/2: a homogeneous field */
GVI_EACH(magnet, 3, v, f, dldv, value)
{
    const real *q = x->q, *v = x->v;
    x->value[0] += (q[0]*v[1] - q[1]*v[0])/2;
    x->f[0] += v[1]/2;
    x->f[1] -= v[0]/2;
    x->dldv[0] -= q[1]/2;
    x->dldv[1] += q[0]/2;
}

/* V = q0^2 - q1^2 - q2^2 + q3^2: the height of the body's third axis */
GVI_EACH(top_weight, 4, f, value)
{
    for (int i = 0; i < 4; ++i) {
        const real q = x->q[i], sign = i % 3 ? -1 : 1;
        x->f[i] -= 2*sign*q;
        x->value[0] += sign*q*q;
    }
}

LINKAGE void quaternion_product(const real *a, const real *b, real *c)
{
    c[0] = a[0]*b[0] - a[1]*b[1] - a[2]*b[2] - a[3]*b[3];
    c[1] = a[0]*b[1] + a[1]*b[0] + a[2]*b[3] - a[3]*b[2];
    c[2] = a[0]*b[2] - a[1]*b[3] + a[2]*b[0] + a[3]*b[1];
    c[3] = a[0]*b[3] + a[1]*b[2] - a[2]*b[1] + a[3]*b[0];
}

/* M = 4 L'IL, the columns of L = conj(q) e_j */
GVI_EACH(body_mass, 4, mass)
{
    const real *I0 = (const real *)user, q[4] = { x->q[0], -x->q[1], -x->q[2], -x->q[3] };
    real L[4][4];
    for (int j = 0; j < 4; ++j) {
        const real e[4] = { j == 0, j == 1, j == 2, j == 3 };
        quaternion_product(q, e, L[j]);
    }
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j <= i; ++j) {
            real sum = 0;
            for (int a = 0; a < 4; ++a) sum += I0[a]*L[i][a]*L[j][a];
            x->mass[i*4 + j] = 4*sum;
        }
}

/* dT/dq_j = 4 sum_i I_i (conj(q) v)_i (conj(e_j) v)_i */
GVI_EACH(body_gradient, 4, v, f)
{
    const real *I0 = (const real *)user, q[4] = { x->q[0], -x->q[1], -x->q[2], -x->q[3] };
    real w[4], u[4];
    quaternion_product(q, x->v, w);
    for (int j = 0; j < 4; ++j) {
        const real e[4] = { j == 0, j == 1 ? -1 : 0, j == 2 ? -1 : 0, j == 3 ? -1 : 0 };
        quaternion_product(e, x->v, u);
        for (int a = 0; a < 4; ++a) x->f[j] += 4*I0[a]*w[a]*u[a];
    }
}

typedef struct { int n, m; gvi_effect effects[3]; int count; gvi_mass mass; real q[MOST_N], v[MOST_N]; } linkage;

LINKAGE linkage make_linkage(linkage_id id)
{
    static real down[2], space_down[3], rods_down[4], four_down[4], top_down[9];
    static real rods_mass[16], four_mass[16], top_mass[9], inertia[4];
    linkage a;
    memset(&a, 0, sizeof a);
    const gvi_effect weight = { .kind = GVI_POTENTIAL, .points = constant, .value = constant };
    a.effects[0] = weight;
    a.effects[1].kind = GVI_CONSTRAINT;
    a.count = 2;
    a.m = 1;
    a.effects[1].points = sphere;
    switch (id) {
    case PENDULUM: case PIVOT:
        a.n = 2;
        down[1] = -1;
        a.effects[0].user = down;
        a.q[0] = (real)0.6L; a.q[1] = -(real)0.8L;
        a.v[0] = (real)1.2L; a.v[1] = (real)0.9L;
        if (id == PENDULUM) break;
        a.effects[1].user = down;                 /* not NULL: the pivot moves */
        a.v[0] += (real)2/3;
        break;
    case SPHERE: case MAGNET:
        a.n = 3;
        space_down[2] = -1;
        a.effects[0].user = space_down;
        a.q[0] = (real)0.6L; a.q[2] = -(real)0.8L;
        a.v[0] = (real)0.4L; a.v[1] = 1; a.v[2] = (real)0.3L;
        if (id == SPHERE) break;
        a.effects[2].kind = GVI_LAGRANGIAN;
        a.effects[2].points = a.effects[2].value = magnet;
        a.count = 3;
        break;
    case RODS: case FRICTION:
        a.n = 4; a.m = 2;
        rods_down[1] = -1; rods_down[3] = -(real)0.5L;
        a.effects[0].user = rods_down;
        a.effects[1].points = rods;
        for (int i = 0; i < 2; ++i) {
            rods_mass[5*i] = (real)2/3;
            rods_mass[5*i + 10] = (real)1/3;
            rods_mass[4*i + i + 2] = rods_mass[4*(i + 2) + i] = (real)1/6;
        }
        a.mass.kind = GVI_MASS_DENSE;
        a.mass.matrix = rods_mass;
        a.q[0] = 1; a.q[2] = (real)1.6L; a.q[3] = (real)0.8L;
        if (id == RODS) break;
        a.effects[2].kind = GVI_FORCE;
        a.effects[2].points = drag;
        a.count = 3;
        break;
    case FOUR_BAR:
        a.n = 4; a.m = 3;
        four_down[1] = -(real)1.75L; four_down[3] = -(real)2.25L;
        a.effects[0].user = four_down;
        a.effects[1].points = four_bar;
        for (int i = 0; i < 2; ++i) {
            four_mass[5*i] = (real)3.5L/3;
            four_mass[5*i + 10] = (real)1.5L;
            four_mass[4*i + i + 2] = four_mass[4*(i + 2) + i] = (real)2.5L/6;
        }
        a.mass.kind = GVI_MASS_DENSE;
        a.mass.matrix = four_mass;
        {
            const real along = (10 + (real)6.25L - 4)/20, across = sqrt((real)6.25L - along*along*10)/sqrt((real)10);
            a.q[1] = 1;
            a.q[2] = 3*along + across; a.q[3] = 1 - along + 3*across;
            a.v[0] = -(real)2.5L;
            const real X = a.q[2], Y = a.q[3] - 1, U = a.q[2] - 3, W = a.q[3], r = X*a.v[0], det = X*W - Y*U;
            a.v[2] = r*W/det; a.v[3] = -r*U/det;
        }
        break;
    case DIRECTORS:
        a.n = 9; a.m = 6;
        top_down[8] = -1;
        a.effects[0].user = top_down;
        a.effects[1].points = directors;
        for (int i = 0; i < 9; ++i) top_mass[i] = i < 6 ? (real)0.25L : (real)0.75L;
        a.mass.kind = GVI_MASS_DIAGONAL;
        a.mass.matrix = top_mass;
        a.q[0] = 1; a.q[4] = (real)0.6L; a.q[5] = (real)0.8L; a.q[7] = -(real)0.8L; a.q[8] = (real)0.6L;
        for (int b = 0; b < 3; ++b) {             /* d' = w x d, w = d1/2 + 5 d3 */
            const real *d = a.q + 3*b;
            real w[3];
            for (int i = 0; i < 3; ++i) w[i] = a.q[i]/2 + 5*a.q[6 + i];
            for (int i = 0; i < 3; ++i)
                a.v[3*b + i] = w[(i + 1) % 3]*d[(i + 2) % 3] - w[(i + 2) % 3]*d[(i + 1) % 3];
        }
        break;
    case QUATERNION: default:
        a.n = 4;
        inertia[0] = inertia[1] = inertia[2] = 1;
        inertia[3] = (real)0.5L;
        a.effects[0].points = a.effects[0].value = top_weight;
        a.mass.kind = GVI_MASS_POSITION;
        a.mass.points = body_mass;
        a.mass.gradient = body_gradient;
        a.mass.user = inertia;
        a.q[0] = 2/sqrt((real)5); a.q[1] = 1/sqrt((real)5);
        {
            const real w[4] = { 0, (real)0.25L, 0, (real)2.5L };
            quaternion_product(a.q, w, a.v);
        }
    }
    a.effects[1].rows = a.m;
    return a;
}

LINKAGE gvi_desc linkage_desc(const linkage *a, int degree)
{
    const gvi_desc desc = { .n = a->n, .degree = degree, .effects = a->effects, .effect_count = a->count,
                            .mass = a->mass };
    return desc;
}

/* g, G and dg/dt at the state */
LINKAGE void constraint_of_state(const gvi_stepper *st, const linkage *a, real *g, real *G, real *rate)
{
    gvi_points x;
    memset(&x, 0, sizeof x);
    x.n = a->n;
    x.count = x.stride = 1;
    x.t = &st->t;
    x.q = st->q;
    x.g = g;
    x.jacobian = G;
    x.rate = rate;
    a->effects[1].points(&x, a->effects[1].user);
}

#endif
