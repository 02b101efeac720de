/* effects.h - a small set of effects: a scene is mostly a list of these

   Each effect is a struct of parameters and a function of the same name, which
   makes the row for gvi_desc.effects:

     static const struct uniform_field weight = { { 0, 2, 3 }, mass, { 0, 0, -9.81 } };
     const gvi_effect scene[] = { uniform_field(&weight), ... };

   The parameters are not copied.  An effect reads and adds to the coordinates
   that its parameters name and to no others; all points of a step are done in
   the innermost loop.  A potential and a Lagrangian term bring their value.
   Stiff ones bring a Hessian for Newton's method if `n`, the degrees of freedom
   of the whole scene, is given (0: none, differences are taken).

     uniform_field     gravity, electric field     V = -sum m_i g.r_i
     pair_gravity      of all pairs                V = -sum G m_i m_j/r_ij
     central_gravity   towards a fixed point       V = -sum gm m_i/r_i
     oblateness        J2 of a flattened body
     springs           between particles           V = sum k (r - rest)^2/2
     tethers           springs to fixed points
     weights           of links, in angles         V = -sum w_i cos q_i
     quartic_well      Duffing's spring            V = sum a q^2/2 + b q^4/4
     chain             bonds of a FPUT chain       V = sum k d^2/2 + a d^3/3 + b d^4/4
     linear_drag       f = -c v
     air_drag          f = -c |v| v
     atmosphere        the same, c thinning out with height
     joint_friction    torque -c (rate of a joint)
     motor             torque a + b cos(w t + phase); as a force: a drive
     servo             torque towards a moving target angle
     magnetic_force    f = e v x B
     magnetic_field    the same as a Lagrangian term
     rotating_frame    Coriolis and centrifugal, a Lagrangian term
     two_links, top    masses that depend on the position
     rods              constraints: particles at fixed distances, also from fixed points */
#ifndef EFFECTS_H
#define EFFECTS_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "gvi.h"
#include <math.h>
#ifndef __cplusplus
#include <tgmath.h>
#undef I                              /* <complex.h> comes with it; I is a user's name */
#endif
#ifdef __cplusplus
#define restrict __restrict            /* to the end of this file */
#endif

/* Coordinate c of particle i is q[first + i*dim + c]; dim is 2 or 3.          */
typedef struct particles { int first, count, dim; } particles;

static inline size_t effect_row(const gvi_points *x, int coordinate)
{
    return (size_t)coordinate*(size_t)x->stride;
}

/* The loops over points that compilers would not take for independent stand in
   functions of their own, called ..._rows: there `restrict` says so, and `space`
   (dim == 3) is a constant at each call, so that no loop has a branch.        */
static inline size_t particle_row(const gvi_points *x, particles on, int i)
{
    return effect_row(x, on.first + i*on.dim);
}

/* ------------------------------------------------------------ uniform field */

/* Gravity with masses and g, or an electric field with charges and E.         */
struct uniform_field { particles on; const gvi_real *charge; gvi_real field[3]; };

static inline int uniform_field_force(const gvi_points *x, void *user)
{
    const struct uniform_field *u = (const struct uniform_field *)user;
    for (int i = 0; i < u->on.count; ++i)
        for (int c = 0; c < u->on.dim; ++c) {
            gvi_real *f = x->f + particle_row(x, u->on, i) + effect_row(x, c);
            const gvi_real w = u->charge[i]*u->field[c];
            for (int k = 0; k < x->count; ++k) f[k] += w;
        }
    return 0;
}

static inline int uniform_field_value(const gvi_points *x, void *user)
{
    const struct uniform_field *u = (const struct uniform_field *)user;
    for (int i = 0; i < u->on.count; ++i)
        for (int c = 0; c < u->on.dim; ++c) {
            const gvi_real *q = x->q + particle_row(x, u->on, i) + effect_row(x, c);
            const gvi_real w = u->charge[i]*u->field[c];
            for (int k = 0; k < x->count; ++k) x->value[k] -= w*q[k];
        }
    return 0;
}

static inline int effect_no_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                    gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    return (void)t, (void)q, (void)v, (void)fq, (void)fv, (void)pv, (void)user, 0;      // all zero
}

static inline gvi_effect uniform_field(const struct uniform_field *u)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = uniform_field_force, .value = uniform_field_value,
                         .hessian = effect_no_hessian, .user = (void *)u };
}

/* ------------------------------------------------------------------ gravity */

struct pair_gravity { particles on; const gvi_real *mass; gvi_real G; };

static inline void pair_gravity_rows(int count, int d, const gvi_real *restrict a, const gvi_real *restrict b,
                                     gvi_real *restrict f, gvi_real *restrict g, gvi_real mm, int space)
{
    for (int k = 0; k < count; ++k) {
        gvi_real u = b[k] - a[k], v = b[d+k] - a[d+k], w = space ? b[2*d+k] - a[2*d+k] : 0;
        gvi_real r2 = u*u + v*v + w*w, s = mm/(r2*sqrt(r2));
        f[k]   += s*u;  g[k]   -= s*u;
        f[d+k] += s*v;  g[d+k] -= s*v;
        if (space) f[2*d+k] += s*w, g[2*d+k] -= s*w;
    }
}

static inline int pair_gravity_force(const gvi_points *x, void *user)
{
    const struct pair_gravity *p = (const struct pair_gravity *)user;
    for (int i = 1; i < p->on.count; ++i)
        for (int j = 0; j < i; ++j) {
            const size_t a = particle_row(x, p->on, i), b = particle_row(x, p->on, j);
            const gvi_real *q = x->q, mm = p->G*p->mass[i]*p->mass[j];
            gvi_real *f = x->f;
            if (p->on.dim == 3) pair_gravity_rows(x->count, x->stride, q + a, q + b, f + a, f + b, mm, 1);
            else pair_gravity_rows(x->count, x->stride, q + a, q + b, f + a, f + b, mm, 0);
        }
    return 0;
}

static inline int pair_gravity_value(const gvi_points *x, void *user)
{
    const struct pair_gravity *p = (const struct pair_gravity *)user;
    const int d = x->stride, space = p->on.dim == 3;
    for (int i = 1; i < p->on.count; ++i)
        for (int j = 0; j < i; ++j) {
            const gvi_real *a = x->q + particle_row(x, p->on, i), *b = x->q + particle_row(x, p->on, j);
            const gvi_real mm = p->G*p->mass[i]*p->mass[j];
            for (int k = 0; k < x->count; ++k) {
                gvi_real u = b[k] - a[k], v = b[d+k] - a[d+k], w = space ? b[2*d+k] - a[2*d+k] : 0;
                x->value[k] -= mm/sqrt(u*u + v*v + w*w);
            }
        }
    return 0;
}

static inline gvi_effect pair_gravity(const struct pair_gravity *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = pair_gravity_force, .value = pair_gravity_value,
                         .user = (void *)p };
}

/* gm is that of the centre; in the plane centre[2] must be 0.                 */
struct central_gravity { particles on; const gvi_real *mass; gvi_real gm, centre[3]; };

static inline void central_gravity_rows(int count, int d, const gvi_real *restrict q, gvi_real *restrict f,
                                        gvi_real mm, const gvi_real *o, int space)
{
    const gvi_real X = o[0], Y = o[1], Z = o[2];
    for (int k = 0; k < count; ++k) {
        gvi_real u = X - q[k], v = Y - q[d+k], w = space ? Z - q[2*d+k] : 0;
        gvi_real r2 = u*u + v*v + w*w, s = mm/(r2*sqrt(r2));
        f[k] += s*u;
        f[d+k] += s*v;
        if (space) f[2*d+k] += s*w;
    }
}

static inline int central_gravity_force(const gvi_points *x, void *user)
{
    const struct central_gravity *p = (const struct central_gravity *)user;
    for (int i = 0; i < p->on.count; ++i) {
        const size_t at = particle_row(x, p->on, i);
        const gvi_real mm = p->gm*p->mass[i];
        if (p->on.dim == 3) central_gravity_rows(x->count, x->stride, x->q + at, x->f + at, mm, p->centre, 1);
        else central_gravity_rows(x->count, x->stride, x->q + at, x->f + at, mm, p->centre, 0);
    }
    return 0;
}

static inline int central_gravity_value(const gvi_points *x, void *user)
{
    const struct central_gravity *p = (const struct central_gravity *)user;
    const int d = x->stride, space = p->on.dim == 3;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real *q = x->q + particle_row(x, p->on, i), *o = p->centre, mm = p->gm*p->mass[i];
        for (int k = 0; k < x->count; ++k) {
            gvi_real u = o[0] - q[k], v = o[1] - q[d+k], w = space ? o[2] - q[2*d+k] : 0;
            x->value[k] -= mm/sqrt(u*u + v*v + w*w);
        }
    }
    return 0;
}

static inline gvi_effect central_gravity(const struct central_gravity *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = central_gravity_force,
                         .value = central_gravity_value, .user = (void *)p };
}

/* Adds to central gravity about the origin what the flattening of a body of the
   given radius about the third axis does: V = gm m J2 R^2 (3 z^2/r^2 - 1)/(2 r^3);
   in space only.                                                             */
struct oblateness { particles on; const gvi_real *mass; gvi_real gm, radius, j2; };

static inline void oblateness_rows(int count, int d, const gvi_real *restrict q, gvi_real *restrict f,
                                   gvi_real a)
{
    for (int k = 0; k < count; ++k) {
        gvi_real u = q[k], v = q[d+k], w = q[2*d+k], r2 = u*u + v*v + w*w;
        gvi_real s = 3*a/(2*r2*r2*sqrt(r2)), z = 5*w*w/r2;
        f[k]     += s*(z - 1)*u;
        f[d+k]   += s*(z - 1)*v;
        f[2*d+k] += s*(z - 3)*w;
    }
}

static inline int oblateness_force(const gvi_points *x, void *user)
{
    const struct oblateness *p = (const struct oblateness *)user;
    for (int i = 0; i < p->on.count; ++i) {
        const size_t at = particle_row(x, p->on, i);
        const gvi_real a = p->gm*p->mass[i]*p->j2*p->radius*p->radius;
        oblateness_rows(x->count, x->stride, x->q + at, x->f + at, a);
    }
    return 0;
}

static inline int oblateness_value(const gvi_points *x, void *user)
{
    const struct oblateness *p = (const struct oblateness *)user;
    const int d = x->stride;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real *q = x->q + particle_row(x, p->on, i);
        const gvi_real a = p->gm*p->mass[i]*p->j2*p->radius*p->radius;
        for (int k = 0; k < x->count; ++k) {
            gvi_real u = q[k], v = q[d+k], w = q[2*d+k], r2 = u*u + v*v + w*w;
            x->value[k] += a*(3*w*w/r2 - 1)/(2*r2*sqrt(r2));
        }
    }
    return 0;
}

static inline gvi_effect oblateness(const struct oblateness *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = oblateness_force, .value = oblateness_value,
                         .user = (void *)p };
}

/* ------------------------------------------------------------------ springs */

struct spring { int a, b; gvi_real k, rest; };           /* between particles a and b */
struct springs { particles on; const struct spring *list; int count, n; };

/* Force over distance; a spring without rest length has one at distance 0, too. */
static inline int spring_rests(gvi_real rest) { return !(rest <= 0 && rest >= 0); }

static inline gvi_real spring_pull(gvi_real k, gvi_real rest, gvi_real r2)
{
    return spring_rests(rest) ? k - k*rest/sqrt(r2) : k;
}

static inline void springs_rows(int count, int d, const gvi_real *restrict a, const gvi_real *restrict b,
                                gvi_real *restrict f, gvi_real *restrict g, const struct spring *s, int space)
{
    const gvi_real stiff = s->k, rest = s->rest;
    for (int k = 0; k < count; ++k) {
        gvi_real u = b[k] - a[k], v = b[d+k] - a[d+k], w = space ? b[2*d+k] - a[2*d+k] : 0;
        gvi_real pull = spring_pull(stiff, rest, u*u + v*v + w*w);
        f[k]   += pull*u;  g[k]   -= pull*u;
        f[d+k] += pull*v;  g[d+k] -= pull*v;
        if (space) f[2*d+k] += pull*w, g[2*d+k] -= pull*w;
    }
}

static inline int springs_force(const gvi_points *x, void *user)
{
    const struct springs *p = (const struct springs *)user;
    for (const struct spring *s = p->list; s < p->list + p->count; ++s) {
        const size_t a = particle_row(x, p->on, s->a), b = particle_row(x, p->on, s->b);
        const gvi_real *q = x->q;
        gvi_real *f = x->f;
        if (p->on.dim == 3) springs_rows(x->count, x->stride, q + a, q + b, f + a, f + b, s, 1);
        else springs_rows(x->count, x->stride, q + a, q + b, f + a, f + b, s, 0);
    }
    return 0;
}

static inline int springs_value(const gvi_points *x, void *user)
{
    const struct springs *p = (const struct springs *)user;
    const int d = x->stride, space = p->on.dim == 3;
    for (const struct spring *s = p->list; s < p->list + p->count; ++s) {
        const gvi_real *a = x->q + particle_row(x, p->on, s->a), *b = x->q + particle_row(x, p->on, s->b);
        for (int k = 0; k < x->count; ++k) {
            gvi_real u = b[k] - a[k], v = b[d+k] - a[d+k], w = space ? b[2*d+k] - a[2*d+k] : 0;
            gvi_real stretch = sqrt(u*u + v*v + w*w) - s->rest;
            x->value[k] += s->k*stretch*stretch/2;
        }
    }
    return 0;
}

/* d(pull u)/du = pull + k rest/r^3 u u' for the difference u of the ends.      */
static inline gvi_real spring_stiffness(gvi_real k, gvi_real rest, int dim, const gvi_real *u, int i, int j)
{
    gvi_real r2 = u[0]*u[0] + u[1]*u[1] + (dim == 3 ? u[2]*u[2] : 0);
    return (i == j ? spring_pull(k, rest, r2) : 0) + (spring_rests(rest) ? k*rest*u[i]*u[j]/(r2*sqrt(r2)) : 0);
}

static inline int springs_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                  gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    const struct springs *p = (const struct springs *)user;
    const int dim = p->on.dim;
    for (const struct spring *s = p->list; s < p->list + p->count; ++s) {
        const int a = p->on.first + s->a*dim, b = p->on.first + s->b*dim;
        gvi_real u[3] = { 0, 0, 0 };
        for (int c = 0; c < dim; ++c) u[c] = q[b+c] - q[a+c];
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j) {
                gvi_real m = spring_stiffness(s->k, s->rest, dim, u, i, j);
                fq[(a+i)*p->n + a+j] -= m;  fq[(a+i)*p->n + b+j] += m;
                fq[(b+i)*p->n + a+j] += m;  fq[(b+i)*p->n + b+j] -= m;
            }
    }
    return (void)t, (void)v, (void)fv, (void)pv, 0;
}

static inline gvi_effect springs(const struct springs *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = springs_force, .value = springs_value,
                         .hessian = p->n ? springs_hessian : NULL, .user = (void *)p };
}

struct tether { int a; gvi_real k, rest, to[3]; };       /* from particle a to a fixed point */
struct tethers { particles on; const struct tether *list; int count, n; };

static inline void tethers_rows(int count, int d, const gvi_real *restrict a, gvi_real *restrict f,
                                const struct tether *s, int space)
{
    const gvi_real stiff = s->k, rest = s->rest, X = s->to[0], Y = s->to[1], Z = s->to[2];
    for (int k = 0; k < count; ++k) {
        gvi_real u = X - a[k], v = Y - a[d+k], w = space ? Z - a[2*d+k] : 0;
        gvi_real pull = spring_pull(stiff, rest, u*u + v*v + w*w);
        f[k] += pull*u;
        f[d+k] += pull*v;
        if (space) f[2*d+k] += pull*w;
    }
}

static inline int tethers_force(const gvi_points *x, void *user)
{
    const struct tethers *p = (const struct tethers *)user;
    for (const struct tether *s = p->list; s < p->list + p->count; ++s) {
        const size_t at = particle_row(x, p->on, s->a);
        if (p->on.dim == 3) tethers_rows(x->count, x->stride, x->q + at, x->f + at, s, 1);
        else tethers_rows(x->count, x->stride, x->q + at, x->f + at, s, 0);
    }
    return 0;
}

static inline int tethers_value(const gvi_points *x, void *user)
{
    const struct tethers *p = (const struct tethers *)user;
    const int d = x->stride, space = p->on.dim == 3;
    for (const struct tether *s = p->list; s < p->list + p->count; ++s) {
        const gvi_real *a = x->q + particle_row(x, p->on, s->a);
        for (int k = 0; k < x->count; ++k) {
            gvi_real u = s->to[0] - a[k], v = s->to[1] - a[d+k], w = space ? s->to[2] - a[2*d+k] : 0;
            gvi_real stretch = sqrt(u*u + v*v + w*w) - s->rest;
            x->value[k] += s->k*stretch*stretch/2;
        }
    }
    return 0;
}

static inline int tethers_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                  gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    const struct tethers *p = (const struct tethers *)user;
    const int dim = p->on.dim;
    for (const struct tether *s = p->list; s < p->list + p->count; ++s) {
        const int a = p->on.first + s->a*dim;
        gvi_real u[3] = { 0, 0, 0 };
        for (int c = 0; c < dim; ++c) u[c] = s->to[c] - q[a+c];
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim; ++j)
                fq[(a+i)*p->n + a+j] -= spring_stiffness(s->k, s->rest, dim, u, i, j);
    }
    return (void)t, (void)v, (void)fv, (void)pv, 0;
}

static inline gvi_effect tethers(const struct tethers *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = tethers_force, .value = tethers_value,
                         .hessian = p->n ? tethers_hessian : NULL, .user = (void *)p };
}

/* ------------------------------------------------- potentials of coordinates */

/* Links that hang at angles q from the vertical: w_i is their weight times the
   length of the lever.  Negative: they stand.                                */
struct weights { int first, count; const gvi_real *w; };

static inline int weights_force(const gvi_points *x, void *user)
{
    const struct weights *p = (const struct weights *)user;
    for (int i = 0; i < p->count; ++i) {
        const gvi_real *q = x->q + effect_row(x, p->first + i);
        gvi_real *f = x->f + effect_row(x, p->first + i);
        for (int k = 0; k < x->count; ++k) f[k] -= p->w[i]*sin(q[k]);
    }
    return 0;
}

static inline int weights_value(const gvi_points *x, void *user)
{
    const struct weights *p = (const struct weights *)user;
    for (int i = 0; i < p->count; ++i) {
        const gvi_real *q = x->q + effect_row(x, p->first + i);
        for (int k = 0; k < x->count; ++k) x->value[k] -= p->w[i]*cos(q[k]);
    }
    return 0;
}

static inline gvi_effect weights(const struct weights *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = weights_force, .value = weights_value,
                         .user = (void *)p };
}

struct quartic_well { int first, count; gvi_real a, b; int n; };

static inline int quartic_well_force(const gvi_points *x, void *user)
{
    const struct quartic_well *p = (const struct quartic_well *)user;
    for (int i = p->first; i < p->first + p->count; ++i) {
        const gvi_real *q = x->q + effect_row(x, i), a = p->a, b = p->b;
        gvi_real *f = x->f + effect_row(x, i);
        for (int k = 0; k < x->count; ++k) f[k] -= (a + b*q[k]*q[k])*q[k];
    }
    return 0;
}

static inline int quartic_well_value(const gvi_points *x, void *user)
{
    const struct quartic_well *p = (const struct quartic_well *)user;
    for (int i = p->first; i < p->first + p->count; ++i) {
        const gvi_real *q = x->q + effect_row(x, i);
        for (int k = 0; k < x->count; ++k) {
            gvi_real q2 = q[k]*q[k];
            x->value[k] += (2*p->a + p->b*q2)*q2/4;
        }
    }
    return 0;
}

static inline int quartic_well_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                       gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    const struct quartic_well *p = (const struct quartic_well *)user;
    for (int i = p->first; i < p->first + p->count; ++i) fq[i*p->n + i] -= p->a + 3*p->b*q[i]*q[i];
    return (void)t, (void)v, (void)fv, (void)pv, 0;
}

static inline gvi_effect quartic_well(const struct quartic_well *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = quartic_well_force, .value = quartic_well_value,
                         .hessian = p->n ? quartic_well_hessian : NULL, .user = (void *)p };
}

/* Displacements along a chain of `count` particles between two fixed walls:
   count + 1 bonds, d being the difference of neighbours (0 at the walls).     */
struct chain { int first, count; gvi_real k, a, b; int n; };

static inline int chain_force(const gvi_points *x, void *user)
{
    const struct chain *p = (const struct chain *)user;
    for (int i = 0; i <= p->count; ++i) {                      // bond i joins particles i-1 and i
        const int left = i > 0, right = i < p->count;
        const size_t at = effect_row(x, p->first + i), before = at - effect_row(x, left);
        const gvi_real *q = x->q + at, *l = x->q + before, K = p->k, a = p->a, b = p->b;
        gvi_real *f = x->f + at, *g = x->f + before;
        for (int k = 0; k < x->count; ++k) {
            gvi_real d = (right ? q[k] : 0) - (left ? l[k] : 0), pull = (K + (a + b*d)*d)*d;
            if (left) g[k] += pull;
            if (right) f[k] -= pull;
        }
    }
    return 0;
}

static inline int chain_value(const gvi_points *x, void *user)
{
    const struct chain *p = (const struct chain *)user;
    for (int i = 0; i <= p->count; ++i) {
        const int left = i > 0, right = i < p->count;
        const gvi_real *q = x->q + effect_row(x, p->first + i), *l = q - effect_row(x, left);
        for (int k = 0; k < x->count; ++k) {
            gvi_real d = (right ? q[k] : 0) - (left ? l[k] : 0);
            x->value[k] += (p->k/2 + (p->a/3 + p->b*d/4)*d)*d*d;
        }
    }
    return 0;
}

static inline int chain_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    const struct chain *p = (const struct chain *)user;
    for (int i = 0; i <= p->count; ++i) {
        const int left = i > 0, right = i < p->count, at = p->first + i;
        gvi_real d = (right ? q[at] : 0) - (left ? q[at-1] : 0), stiff = p->k + (2*p->a + 3*p->b*d)*d;
        if (right) fq[at*p->n + at] -= stiff;
        if (left) fq[(at-1)*p->n + at-1] -= stiff;
        if (left && right) fq[at*p->n + at-1] += stiff, fq[(at-1)*p->n + at] += stiff;
    }
    return (void)t, (void)v, (void)fv, (void)pv, 0;
}

static inline gvi_effect chain(const struct chain *p)
{
    return (gvi_effect){ .kind = GVI_POTENTIAL, .points = chain_force, .value = chain_value,
                         .hessian = p->n ? chain_hessian : NULL, .user = (void *)p };
}

/* --------------------------------------------------------- drag and friction */

struct linear_drag { int first, count; gvi_real c; int n; };

static inline int linear_drag_force(const gvi_points *x, void *user)
{
    const struct linear_drag *p = (const struct linear_drag *)user;
    for (int i = p->first; i < p->first + p->count; ++i) {
        const gvi_real *v = x->v + effect_row(x, i), c = p->c;
        gvi_real *f = x->f + effect_row(x, i);
        for (int k = 0; k < x->count; ++k) f[k] -= c*v[k];
    }
    return 0;
}

static inline int linear_drag_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                      gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    const struct linear_drag *p = (const struct linear_drag *)user;
    for (int i = p->first; i < p->first + p->count; ++i) fv[i*p->n + i] -= p->c;
    return (void)t, (void)q, (void)v, (void)fq, (void)pv, 0;
}

static inline gvi_effect linear_drag(const struct linear_drag *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = linear_drag_force,
                         .hessian = p->n ? linear_drag_hessian : NULL, .user = (void *)p };
}

/* c = (density)(drag coefficient)(area)/2                                     */
struct air_drag { particles on; gvi_real c; int n; };

static inline void air_drag_rows(int count, int d, const gvi_real *restrict v, gvi_real *restrict f,
                                 gvi_real c, int space)
{
    for (int k = 0; k < count; ++k) {
        gvi_real w = space ? v[2*d+k] : 0, s = c*sqrt(v[k]*v[k] + v[d+k]*v[d+k] + w*w);
        f[k] -= s*v[k];
        f[d+k] -= s*v[d+k];
        if (space) f[2*d+k] -= s*w;
    }
}

static inline int air_drag_force(const gvi_points *x, void *user)
{
    const struct air_drag *p = (const struct air_drag *)user;
    for (int i = 0; i < p->on.count; ++i) {
        const size_t at = particle_row(x, p->on, i);
        if (p->on.dim == 3) air_drag_rows(x->count, x->stride, x->v + at, x->f + at, p->c, 1);
        else air_drag_rows(x->count, x->stride, x->v + at, x->f + at, p->c, 0);
    }
    return 0;
}

/* d(|v| v)/dv = |v| + v v'/|v|, which is 0 at rest.                           */
static inline int air_drag_hessian(gvi_real t, const gvi_real *q, const gvi_real *v,
                                   gvi_real *fq, gvi_real *fv, gvi_real *pv, void *user)
{
    const struct air_drag *p = (const struct air_drag *)user;
    const int dim = p->on.dim;
    for (int b = 0; b < p->on.count; ++b) {
        const int at = p->on.first + b*dim;
        const gvi_real *u = v + at;
        const gvi_real speed = sqrt(u[0]*u[0] + u[1]*u[1] + (dim == 3 ? u[2]*u[2] : 0));
        for (int i = 0; i < dim; ++i)
            for (int j = 0; j < dim && speed > 0; ++j)
                fv[(at+i)*p->n + at+j] -= p->c*((i == j ? speed : 0) + u[i]*u[j]/speed);
    }
    return (void)t, (void)q, (void)fq, (void)pv, 0;
}

static inline gvi_effect air_drag(const struct air_drag *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = air_drag_force,
                         .hessian = p->n ? air_drag_hessian : NULL, .user = (void *)p };
}

/* The same in an atmosphere about the origin: c at distance `radius`, thinner by
   a factor e with each `height` above; in space only.                        */
struct atmosphere { particles on; gvi_real c, radius, height; };

static inline int atmosphere_force(const gvi_points *x, void *user)
{
    const struct atmosphere *p = (const struct atmosphere *)user;
    const int d = x->stride;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real *q = x->q + particle_row(x, p->on, i), *v = x->v + particle_row(x, p->on, i);
        gvi_real *f = x->f + particle_row(x, p->on, i);
        for (int k = 0; k < x->count; ++k) {
            gvi_real r = sqrt(q[k]*q[k] + q[d+k]*q[d+k] + q[2*d+k]*q[2*d+k]);
            gvi_real speed = sqrt(v[k]*v[k] + v[d+k]*v[d+k] + v[2*d+k]*v[2*d+k]);
            gvi_real s = p->c*exp((p->radius - r)/p->height)*speed;
            f[k]     -= s*v[k];
            f[d+k]   -= s*v[d+k];
            f[2*d+k] -= s*v[2*d+k];
        }
    }
    return 0;
}

static inline gvi_effect atmosphere(const struct atmosphere *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = atmosphere_force, .user = (void *)p };
}

/* A joint turns link `outer` against link `inner`, the ground if -1; both are
   coordinates, absolute angles.  A torque acts on one and its reverse on the
   other.                                                                     */
typedef struct joint { int inner, outer; } joint;

struct joint_friction { const joint *list; int count; gvi_real c; };

static inline int joint_friction_force(const gvi_points *x, void *user)
{
    const struct joint_friction *p = (const struct joint_friction *)user;
    for (int i = 0; i < p->count; ++i) {
        const int held = p->list[i].inner >= 0;
        const size_t out = effect_row(x, p->list[i].outer), in = held ? effect_row(x, p->list[i].inner) : out;
        for (int k = 0; k < x->count; ++k) {
            gvi_real torque = -p->c*(x->v[out+(size_t)k] - (held ? x->v[in+(size_t)k] : 0));
            x->f[out+(size_t)k] += torque;
            if (held) x->f[in+(size_t)k] -= torque;
        }
    }
    return 0;
}

static inline gvi_effect joint_friction(const struct joint_friction *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = joint_friction_force, .user = (void *)p };
}

/* ------------------------------------------------------------------- motors */

/* With inner = -1 also a force a + b cos(w t + phase) on any coordinate.      */
struct motor { joint on; gvi_real a, b, w, phase; };

static inline int motor_force(const gvi_points *x, void *user)
{
    const struct motor *p = (const struct motor *)user;
    const int held = p->on.inner >= 0;
    gvi_real *f = x->f + effect_row(x, p->on.outer), *g = held ? x->f + effect_row(x, p->on.inner) : f;
    for (int k = 0; k < x->count; ++k) {
        gvi_real torque = p->a + p->b*cos(p->w*x->t[k] + p->phase);
        f[k] += torque;
        if (held) g[k] -= torque;
    }
    return 0;
}

static inline gvi_effect motor(const struct motor *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = motor_force, .hessian = effect_no_hessian,
                         .user = (void *)p };
}

/* Torque k (target - angle) + c (target' - angle') with target = a + b cos(w t + phase);
   a wound-up spring and a damper on the angle of the joint.                  */
struct servo { joint on; gvi_real k, c, a, b, w, phase; };

static inline int servo_force(const gvi_points *x, void *user)
{
    const struct servo *p = (const struct servo *)user;
    const int held = p->on.inner >= 0;
    const size_t out = effect_row(x, p->on.outer), in = held ? effect_row(x, p->on.inner) : out;
    const gvi_real *q = x->q + out, *v = x->v + out, *r = x->q + in, *u = x->v + in;
    gvi_real *f = x->f + out, *g = x->f + in;
    for (int k = 0; k < x->count; ++k) {
        gvi_real clock = p->w*x->t[k] + p->phase;
        gvi_real angle = q[k] - (held ? r[k] : 0), rate = v[k] - (held ? u[k] : 0);
        gvi_real torque = p->k*(p->a + p->b*cos(clock) - angle) - p->c*(p->b*p->w*sin(clock) + rate);
        f[k] += torque;
        if (held) g[k] -= torque;
    }
    return 0;
}

static inline gvi_effect servo(const struct servo *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = servo_force, .user = (void *)p };
}

/* ------------------------------------------- magnetic field, rotating frame */

/* Uniform field, particles in space.  The force is simple; the Lagrangian term
   e B.(r x v)/2 has the symmetries of the field, and its momentum is canonical. */
struct magnetic { particles on; const gvi_real *charge; gvi_real B[3]; };

static inline void magnetic_force_rows(int count, int d, const gvi_real *restrict v, gvi_real *restrict f,
                                       gvi_real a, gvi_real b, gvi_real c)
{
    for (int k = 0; k < count; ++k) {
        f[k]     += v[d+k]*c - v[2*d+k]*b;
        f[d+k]   += v[2*d+k]*a - v[k]*c;
        f[2*d+k] += v[k]*b - v[d+k]*a;
    }
}

static inline int magnetic_force_points(const gvi_points *x, void *user)
{
    const struct magnetic *p = (const struct magnetic *)user;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real e = p->charge[i];
        const size_t at = particle_row(x, p->on, i);
        magnetic_force_rows(x->count, x->stride, x->v + at, x->f + at, e*p->B[0], e*p->B[1], e*p->B[2]);
    }
    return 0;
}

static inline gvi_effect magnetic_force(const struct magnetic *p)
{
    return (gvi_effect){ .kind = GVI_FORCE, .points = magnetic_force_points, .user = (void *)p };
}

/* dL/dv = e B x r/2, and dL/dr = e v x B/2.                                    */
static inline int magnetic_field_points(const gvi_points *x, void *user)
{
    const struct magnetic *p = (const struct magnetic *)user;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real e = p->charge[i]/2;
        const size_t at = particle_row(x, p->on, i);
        magnetic_force_rows(x->count, x->stride, x->v + at, x->f + at, e*p->B[0], e*p->B[1], e*p->B[2]);
        magnetic_force_rows(x->count, x->stride, x->q + at, x->dldv + at, -e*p->B[0], -e*p->B[1], -e*p->B[2]);
    }
    return 0;
}

static inline int magnetic_field_value(const gvi_points *x, void *user)
{
    const struct magnetic *p = (const struct magnetic *)user;
    const int d = x->stride;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real e = p->charge[i]/2, a = e*p->B[0], b = e*p->B[1], c = e*p->B[2];
        const gvi_real *q = x->q + particle_row(x, p->on, i), *v = x->v + particle_row(x, p->on, i);
        for (int k = 0; k < x->count; ++k)
            x->value[k] += a*(q[d+k]*v[2*d+k] - q[2*d+k]*v[d+k]) + b*(q[2*d+k]*v[k] - q[k]*v[2*d+k])
                         + c*(q[k]*v[d+k] - q[d+k]*v[k]);
    }
    return 0;
}

static inline gvi_effect magnetic_field(const struct magnetic *p)
{
    return (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = magnetic_field_points,
                         .value = magnetic_field_value, .user = (void *)p };
}

/* Axes that turn about the third at rate w: L = sum m (w (x v - y u) + w^2 (x^2 + y^2)/2),
   u and v being the velocities in x and y.                                   */
struct rotating_frame { particles on; const gvi_real *mass; gvi_real w; };

static inline void rotating_frame_rows(int count, int d, const gvi_real *restrict q,
                                       const gvi_real *restrict v, gvi_real *restrict f,
                                       gvi_real *restrict g, gvi_real m, gvi_real w)
{
    for (int k = 0; k < count; ++k) {
        f[k]   += m*(v[d+k] + w*q[k]);      g[k]   -= m*q[d+k];
        f[d+k] += m*(w*q[d+k] - v[k]);      g[d+k] += m*q[k];
    }
}

static inline int rotating_frame_points(const gvi_points *x, void *user)
{
    const struct rotating_frame *p = (const struct rotating_frame *)user;
    for (int i = 0; i < p->on.count; ++i) {
        const size_t at = particle_row(x, p->on, i);
        rotating_frame_rows(x->count, x->stride, x->q + at, x->v + at, x->f + at, x->dldv + at,
                            p->mass[i]*p->w, p->w);
    }
    return 0;
}

static inline int rotating_frame_value(const gvi_points *x, void *user)
{
    const struct rotating_frame *p = (const struct rotating_frame *)user;
    const int d = x->stride;
    for (int i = 0; i < p->on.count; ++i) {
        const gvi_real m = p->mass[i]*p->w;
        const gvi_real *q = x->q + particle_row(x, p->on, i), *v = x->v + particle_row(x, p->on, i);
        for (int k = 0; k < x->count; ++k)
            x->value[k] += m*(q[k]*v[d+k] - q[d+k]*v[k] + p->w*(q[k]*q[k] + q[d+k]*q[d+k])/2);
    }
    return 0;
}

static inline gvi_effect rotating_frame(const struct rotating_frame *p)
{
    return (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = rotating_frame_points,
                         .value = rotating_frame_value, .user = (void *)p };
}

/* ------------------------------------------------------------- constraints */

/* (r^2 - length^2)/2 = 0 between particles a and b, or for b < 0 from a to a fixed point.  The pull in
   a rod is -length times its multiplier.                                     */
struct rod { int a, b; gvi_real length, to[3]; };
struct rods { particles on; const struct rod *list; int count; };

static inline int rods_hold(const gvi_points *x, void *user)
{
    const struct rods *p = (const struct rods *)user;
    const int d = x->stride;
    for (int i = 0; i < p->count; ++i) {
        const struct rod *s = p->list + i;
        const size_t a = particle_row(x, p->on, s->a), b = s->b < 0 ? 0 : particle_row(x, p->on, s->b);
        gvi_real *g = x->g + i*d, *G = x->jacobian + (size_t)i*(size_t)x->n*(size_t)d;
        for (int k = 0; k < x->count; ++k) g[k] = -s->length*s->length/2;
        for (int c = 0; c < p->on.dim*d; c += d)
            for (int k = c; k < c + x->count; ++k) {
                const gvi_real u = x->q[a + (size_t)k] - (s->b < 0 ? s->to[c/d] : x->q[b + (size_t)k]);
                g[k - c] += u*u/2;
                G[a + (size_t)k] = u;
                if (s->b >= 0) G[b + (size_t)k] = -u;
            }
    }
    return 0;
}

static inline gvi_effect rods(const struct rods *p)
{
    return (gvi_effect){ .kind = GVI_CONSTRAINT, .points = rods_hold, .user = (void *)p, .rows = p->count };
}

/* ------------------------------------------------------------------- masses */

/* Two links in a plane, absolute angles:  M = ( a            c cos(q0 - q1) )
   n = 2 is the whole scene.                   ( c cos(...)   b              )
   For point masses at the ends a = (m1 + m2) l1^2, b = m2 l2^2, c = m2 l1 l2.
   Refused (GVI_E_CALLBACK) where M is not positive definite at all angles.     */
struct two_links { gvi_real a, b, c; };

static inline int two_links_mass(const gvi_points *x, void *user)
{
    const struct two_links *p = (const struct two_links *)user;
    const int d = x->stride;
    if (!(p->a > 0 && p->b > 0 && p->a*p->b > p->c*p->c)) return 1;
    for (int k = 0; k < x->count; ++k) {
        x->mass[k] = p->a;
        x->mass[2*d+k] = p->c*cos(x->q[k] - x->q[d+k]);
        x->mass[3*d+k] = p->b;
    }
    return 0;
}

static inline int two_links_gradient(const gvi_points *x, void *user)
{
    const struct two_links *p = (const struct two_links *)user;
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        gvi_real f = p->c*sin(x->q[k] - x->q[d+k])*x->v[k]*x->v[d+k];
        x->f[k] -= f;
        x->f[d+k] += f;
    }
    return 0;
}

static inline int two_links_velocity(const gvi_points *x, void *user)
{
    const struct two_links *p = (const struct two_links *)user;
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        gvi_real m = p->c*cos(x->q[k] - x->q[d+k]), det = p->a*p->b - m*m;
        x->velocity[k] = (p->b*x->p[k] - m*x->p[d+k])/det;
        x->velocity[d+k] = (p->a*x->p[d+k] - m*x->p[k])/det;
    }
    return 0;
}

static inline gvi_mass two_links(const struct two_links *p)
{
    return (gvi_mass){ .kind = GVI_MASS_POSITION, .points = two_links_mass, .gradient = two_links_gradient,
                       .velocity = two_links_velocity, .user = (void *)p };
}

/* A top on its tip: q = (tilt, precession, spin), Euler's angles.  across and
   along are the moments of inertia about the tip.  n = 3 is the whole scene;
   an upright top (tilt 0) is a singularity of the angles.  Refused (GVI_E_CALLBACK):
   moments that are not above 0.                                               */
struct top { gvi_real across, along; };

static inline int top_mass(const gvi_points *x, void *user)
{
    const struct top *p = (const struct top *)user;
    const int d = x->stride;
    if (!(p->across > 0 && p->along > 0)) return 1;
    for (int k = 0; k < x->count; ++k) {
        gvi_real c = cos(x->q[k]), s = sin(x->q[k]);
        x->mass[k] = p->across;
        x->mass[3*d+k] = 0;
        x->mass[4*d+k] = p->across*s*s + p->along*c*c;
        x->mass[6*d+k] = 0;
        x->mass[7*d+k] = p->along*c;
        x->mass[8*d+k] = p->along;
    }
    return 0;
}

static inline int top_gradient(const gvi_points *x, void *user)
{
    const struct top *p = (const struct top *)user;
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        gvi_real c = cos(x->q[k]), s = sin(x->q[k]), w = x->v[d+k], axial = x->v[2*d+k] + w*c;
        x->f[k] += (p->across*c*w - p->along*axial)*s*w;
    }
    return 0;
}

static inline int top_velocity(const gvi_points *x, void *user)
{
    const struct top *p = (const struct top *)user;
    const int d = x->stride;
    for (int k = 0; k < x->count; ++k) {
        gvi_real c = cos(x->q[k]), s = sin(x->q[k]), w = (x->p[d+k] - x->p[2*d+k]*c)/(p->across*s*s);
        x->velocity[k] = x->p[k]/p->across;
        x->velocity[d+k] = w;
        x->velocity[2*d+k] = x->p[2*d+k]/p->along - w*c;
    }
    return 0;
}

static inline gvi_mass top(const struct top *p)
{
    return (gvi_mass){ .kind = GVI_MASS_POSITION, .points = top_mass, .gradient = top_gradient,
                       .velocity = top_velocity, .user = (void *)p };
}

#ifdef __cplusplus
#undef restrict
#endif
#endif
