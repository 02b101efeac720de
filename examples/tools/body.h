/* body.h - rigid bodies by quaternions, for gvi.h

   The orientation of a body is a quaternion e = (w, x, y, z), which takes body axes to space:
   a_space = e a_body conj(e)/|e|^2.  Only its direction counts: all formulas are those of e/|e|, so
   that e needs no constraint |e| = 1.  What is left over, |e| itself, gets a kinetic energy of
   its own, which no force acts on (J = 4 (I1 + I2 + I3)/3: the rows of e are then alike):

     L = m x'x'/2 + w'I w/2 + J (e.e')^2/(2|e|^4)     w = 2 G e'/|e|^2, the spin in body axes
     M = (4 G'I G + J e e')/|e|^4     M^-1 = G'I^-1 G/4 + e e'/J     G b = Im(conj(e) b)

   From e.e' = 0 (which body_turn gives) |e| stays what it is, to rounding (below 3e-10 after 20,000
   steps), and where it goes changes nothing else. No angle is singular. The angular momentum
   is I w = G p/2 in body axes, kept to rounding as ever where a symmetry says so.

     coordinates   of a body with mass: x (3), e (4); of one that turns about a fixed point,
                   mass = 0: e (4) alone.  Bodies one after the other; n is their sum
     refused       by the mass (GVI_E_CALLBACK), body_wrong says why: mass below 0, moments of 0
                   or less, one above the sum of the others
     |e| = 1       held to rounding by one more row of the scene, body_unit(&scene); then with
                   .mass.velocity = NULL.  The same curves: each row here serves both ways
     rolling       balls and wheels: body_rolls(&round) and body_touches(&round)
     joints        between bodies with mass, or one and the world: body_joined(BODY_HINGE, ...), body_gear,
                   body_rope, at the end of this file, with the forces that they bear
     body axes     principal axes through the centre of mass, or through the fixed point
     force, torque add to the f of an effect at one point (GVI_POINTS), q and f being that body's
     start         e, and e' = body_turn(e, w) for a spin w in body axes

   Use    static const body top[] = { { .inertia = { 2e-4, 2e-4, 8e-5 } } };
          static const bodies scene = { top, 1 };
          desc:  .n = 4, .mass = body_mass(&scene)

   Source: Betsch, Siebert: Rigid body dynamics in terms of quaternions, Int. J. Numer. Meth. Eng. 79,
   2009, with the scale left free in place of their constraint, or with both.       */
#ifndef BODY_H
#define BODY_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "gvi.h"
#include <stdlib.h>
typedef struct body { gvi_real mass, inertia[3]; } body;
typedef struct bodies { const struct body *body; int count; } bodies;

/* Im(conj(a) b) = G(a) b.                                                         */
static inline void body_imaginary(const gvi_real *a, const gvi_real *b, gvi_real *out)
{
    out[0] = a[0]*b[1] - b[0]*a[1] - (a[2]*b[3] - a[3]*b[2]);
    out[1] = a[0]*b[2] - b[0]*a[2] - (a[3]*b[1] - a[1]*b[3]);
    out[2] = a[0]*b[3] - b[0]*a[3] - (a[1]*b[2] - a[2]*b[1]);
}

/* a (0, u): G(a)' u.                                                             */
static inline void body_transposed(const gvi_real *a, const gvi_real *u, gvi_real *out)
{
    out[0] = -(a[1]*u[0] + a[2]*u[1] + a[3]*u[2]);
    out[1] = a[0]*u[0] + a[2]*u[2] - a[3]*u[1];
    out[2] = a[0]*u[1] + a[3]*u[0] - a[1]*u[2];
    out[3] = a[0]*u[2] + a[1]*u[1] - a[2]*u[0];
}

static inline gvi_real body_dot(const gvi_real *a, const gvi_real *b)
{
    return a[0]*b[0] + a[1]*b[1] + a[2]*b[2] + a[3]*b[3];
}

static inline void body_cross(const gvi_real *a, const gvi_real *b, gvi_real *out)
{
    out[0] = a[1]*b[2] - a[2]*b[1];
    out[1] = a[2]*b[0] - a[0]*b[2];
    out[2] = a[0]*b[1] - a[1]*b[0];
}

/* ---------------------------------------------------- what effects and users call */

/* A vector in body axes to space (inverse = 0) or back (1).                        */
static inline void body_rotate(const gvi_real *e, int inverse, const gvi_real *a, gvi_real *out)
{
    const gvi_real sign = inverse ? -1 : 1, s = 2/body_dot(e, e), w = sign*e[0];
    gvi_real b[3], c[3];
    body_cross(e + 1, a, b);
    body_cross(e + 1, b, c);
    for (int i = 0; i < 3; ++i) out[i] = a[i] + s*(w*b[i] + c[i]);
}

/* e' for the spin w in body axes; and w back from e'.                              */
static inline void body_turn(const gvi_real *e, const gvi_real *w, gvi_real *rate)
{
    body_transposed(e, w, rate);
    for (int i = 0; i < 4; ++i) rate[i] /= 2;
}

static inline void body_spin(const gvi_real *e, const gvi_real *rate, gvi_real *w)
{
    const gvi_real size = body_dot(e, e);
    body_imaginary(e, rate, w);
    for (int i = 0; i < 3; ++i) w[i] = 2*w[i]/size;
}

/* The angular momentum I w in body axes, from the momenta of e.                    */
static inline void body_momentum(const gvi_real *e, const gvi_real *p, gvi_real *L)
{
    body_imaginary(e, p, L);
    for (int i = 0; i < 3; ++i) L[i] /= 2;
}

/* A torque in body axes: f.w dt = f.e' dt, so f = 2 G' torque/|e|^2, added to the 4 of f. */
static inline void body_torque(const gvi_real *e, const gvi_real *torque, gvi_real *f)
{
    const gvi_real s = 2/body_dot(e, e);
    gvi_real g[4];
    body_transposed(e, torque, g);
    for (int i = 0; i < 4; ++i) f[i] += s*g[i];
}

static inline void body_torque_in_space(const gvi_real *e, const gvi_real *torque, gvi_real *f)
{
    gvi_real own[3];
    body_rotate(e, 1, torque, own);
    body_torque(e, own, f);
}

/* A force, in body axes or in space, at a place in body axes: on a body with mass, q and f
   its seven; about a fixed point (body_force_about), e and f its four.              */
static inline void body_force_about(const gvi_real *e, const gvi_real *at, const gvi_real *force, gvi_real *f)
{
    gvi_real torque[3];
    body_cross(at, force, torque);
    body_torque(e, torque, f);
}

static inline void body_force(const gvi_real *q, const gvi_real *at, const gvi_real *force, gvi_real *f)
{
    gvi_real out[3];
    body_rotate(q + 3, 0, force, out);
    for (int i = 0; i < 3; ++i) f[i] += out[i];
    body_force_about(q + 3, at, force, f + 3);
}

static inline void body_force_in_space(const gvi_real *q, const gvi_real *at, const gvi_real *force, gvi_real *f)
{
    gvi_real own[3];
    body_rotate(q + 3, 1, force, own);
    body_force(q, at, own, f);
}

/* Coordinates row .. row + count - 1 of point k, for callbacks at all points.         */
static inline void body_take(const gvi_points *x, const gvi_real *from, int row, int count, int k, gvi_real *out)
{
    for (int i = 0; i < count; ++i) out[i] = from[(row + i)*x->stride + k];
}

/* ------------------------------------------------------------------- the mass */

static inline gvi_real body_along(const body *b) { return 4*(b->inertia[0] + b->inertia[1] + b->inertia[2])/3; }

/* Of one body at one point: v = M^-1 p.                                           */
static inline void body_solve(const body *b, const gvi_real *e, const gvi_real *p, gvi_real *v)
{
    const gvi_real along = body_dot(e, p)/body_along(b);
    gvi_real w[3];
    body_imaginary(e, p, w);
    for (int i = 0; i < 3; ++i) w[i] /= 4*b->inertia[i];
    body_transposed(e, w, v);
    for (int i = 0; i < 4; ++i) v[i] += along*e[i];
}

/* The kinetic energy's derivative by e at fixed v = e', with G(e) v = -G(v) e and a = e.v/|e|^2:
   (J a v - 2 G(v)'I w - 2 (w.I w + J a^2) e)/|e|^2.  Divided, here and in body_spin: the rounding of
   1/|e|^2 has a sign while |e| is next to 1, and |e| would drift a hundred times faster.    */
static inline void body_slope(const body *b, const gvi_real *e, const gvi_real *v, gvi_real *f)
{
    const gvi_real size = body_dot(e, e), a = body_dot(e, v)/size, Ja = body_along(b)*a;
    gvi_real w[3], L[3], g[4], twice = 0;
    body_spin(e, v, w);
    for (int i = 0; i < 3; ++i) L[i] = b->inertia[i]*w[i], twice += L[i]*w[i];
    body_transposed(v, L, g);
    for (int i = 0; i < 4; ++i) f[i] = (Ja*v[i] - 2*g[i] - 2*(twice + Ja*a)*e[i])/size;
}

/* NULL, or why there is no such body.  Moments of flat ones may be rounded to three digits. */
static inline const char *body_wrong(const body *b)
{
    const gvi_real *a = b->inertia, all = a[0] + a[1] + a[2];
    if (!(b->mass >= 0 && b->mass - b->mass >= 0)) return "mass is not a finite number of 0 or more";
    for (int i = 0; i < 3; ++i)
        if (!(a[i] > 0 && all - all >= 0)) return "a moment of inertia is not a finite number above 0";
    for (int i = 0; i < 3; ++i)
        if (a[i] - (all - a[i]) > a[i]/1000) return "a moment of inertia is larger than the two others together";
    return NULL;
}

/* n of the scene; the mass refuses another (GVI_E_CALLBACK).                        */
static inline int body_coordinates(const bodies *all)
{
    int n = 0;
    for (int j = 0; j < all->count; ++j) n += all->body[j].mass > 0 ? 7 : 4;
    return n;
}

static inline int body_mass_points(const gvi_points *x, void *user)
{
    const bodies *all = (const bodies *)user;
    const int n = x->n;
    if (n != body_coordinates(all)) return 1;
    for (int j = 0; j < all->count; ++j)
        if (body_wrong(all->body + j)) return 1;
    for (int i = 0; i < n*n; ++i)
        for (int k = 0; k < x->count; ++k) x->mass[i*x->stride + k] = 0;
    for (int j = 0, row = 0; j < all->count; row += 4, ++j) {
        const body *b = all->body + j;
        for (int c = 0; b->mass > 0 && c < 3; ++c, ++row)
            for (int k = 0; k < x->count; ++k) x->mass[row*(n + 1)*x->stride + k] = b->mass;
        for (int k = 0; k < x->count; ++k) {
            gvi_real e[4], g[4][3];
            body_take(x, x->q, row, 4, k, e);
            const gvi_real size = 1/body_dot(e, e);
            for (int i = 0; i < 4; ++i) {                              // columns of G
                gvi_real unit[4] = { 0, 0, 0, 0 };
                unit[i] = 1;
                body_imaginary(e, unit, g[i]);
            }
            for (int i = 0; i < 4; ++i)
                for (int l = 0; l <= i; ++l) {
                    gvi_real sum = body_along(b)*e[i]*e[l];
                    for (int c = 0; c < 3; ++c) sum += 4*b->inertia[c]*g[i][c]*g[l][c];
                    x->mass[((row + i)*n + row + l)*x->stride + k] = sum*size*size;
                }
        }
    }
    return 0;
}

/* mass.gradient, and mass.velocity where there is a velocity to write.                */
static inline int body_mass_rows(const gvi_points *x, void *user)
{
    const bodies *all = (const bodies *)user;
    if (x->n != body_coordinates(all)) return 1;
    for (int j = 0, row = 0; j < all->count; row += 4, ++j) {
        const body *b = all->body + j;
        for (int c = 0; b->mass > 0 && c < 3; ++c, ++row)
            for (int k = 0; x->velocity && k < x->count; ++k)
                x->velocity[row*x->stride + k] = x->p[row*x->stride + k]/b->mass;
        for (int k = 0; k < x->count; ++k) {
            gvi_real e[4], z[4], out[4];
            body_take(x, x->q, row, 4, k, e);
            body_take(x, x->velocity ? x->p : x->v, row, 4, k, z);
            if (x->velocity) body_solve(b, e, z, out);
            else body_slope(b, e, z, out);
            for (int i = 0, at = row*x->stride + k; i < 4; ++i, at += x->stride)
                if (x->velocity) x->velocity[at] = out[i];
                else x->f[at] += out[i];
        }
    }
    return 0;
}

/* The constraints (|e|^2 - 1)/2 = 0, a row for each body.  Their forces are 0 but for the steps' error:
   nothing acts on |e|.                                                             */
static inline int body_unit_points(const gvi_points *x, void *user)
{
    const bodies *all = (const bodies *)user;
    if (x->n != body_coordinates(all)) return 1;
    for (int j = 0, row = 0; j < all->count; row += 4, ++j) {
        if (all->body[j].mass > 0) row += 3;
        for (int k = 0; k < x->count; ++k) {
            gvi_real e[4];
            body_take(x, x->q, row, 4, k, e);
            x->g[j*x->stride + k] = (body_dot(e, e) - 1)/2;
            for (int i = 0; i < 4; ++i) x->jacobian[(j*x->n + row + i)*x->stride + k] = e[i];
        }
    }
    return 0;
}

static inline gvi_effect body_unit(const bodies *all)
{
    return (gvi_effect){ .kind = GVI_CONSTRAINT, .points = body_unit_points, .user = (void *)all, .rows = all->count };
}

/* For scenes of potentials and forces; with Lagrangian terms or constraints set .velocity = NULL. */
static inline gvi_mass body_mass(const bodies *all)
{
    return (gvi_mass){ .kind = GVI_MASS_POSITION, .points = body_mass_points, .gradient = body_mass_rows,
                       .velocity = body_mass_rows, .user = (void *)all };
}

/* ------------------------------------------------------- balls and wheels on the plane z = 0

   body_touches: the lowest point is at height 0; body_rolls: it does not slip.  Both, or with its z
   left to steps' error the second alone, are rows of the velocity of a point of the body:
   body_contact_row, for ground of any shape and bodies of any other.                          */

/* Callbacks refuse (GVI_E_CALLBACK) a body whose coordinates are not in the scene, a radius that is not above 0,
   a gear without teeth.  The world is nowhere.                                                   */
static inline int body_within(const gvi_points *x, int at) { return at <= x->n - 7; }

/* `at` is the body's first coordinate, of 7; axis, in body axes, that of a wheel, 0 of a ball      */
typedef struct body_round { int at; gvi_real radius, axis[3]; } body_round;

/* The velocity along `direction` of the body's point at `from` off the centre, both in space, is row . q':
   added to the 7 of row.                                                                  */
static inline void body_contact_row(const gvi_real *q, const gvi_real *from, const gvi_real *direction, gvi_real *row)
{
    gvi_real own[3];
    body_rotate(q + 3, 1, from, own);
    body_force_in_space(q, own, direction, row);
}

/* The lowest point, off the centre.  A wheel that lies flat has none: NaN.                          */
static inline void body_lowest(const body_round *a, const gvi_real *q, gvi_real *from)
{
    gvi_real axis[3];
    body_rotate(q + 3, 0, a->axis, axis);
    const gvi_real square = axis[0]*axis[0] + axis[1]*axis[1] + axis[2]*axis[2], along = square > 0 ? axis[2]/square : 0;
    for (int i = 0; i < 3; ++i) from[i] = along*axis[i];
    from[2] -= 1;
    const gvi_real size = a->radius/GVI_SQRT(from[0]*from[0] + from[1]*from[1] + from[2]*from[2]);
    for (int i = 0; i < 3; ++i) from[i] *= size;
}

static inline int body_contact_points(const gvi_points *x, const body_round *a, int rolls)
{
    if (a->at < 0 || !body_within(x, a->at) || !(a->radius > 0)) return 1;
    for (int k = 0; k < x->count; ++k) {
        gvi_real q[7], from[3];
        body_take(x, x->q, a->at, 7, k, q);
        body_lowest(a, q, from);
        if (!rolls) x->g[k] = q[2] + from[2];
        for (int j = 0; j < (rolls ? 2 : 1); ++j) {
            const gvi_real direction[3] = { (gvi_real)(rolls && j == 0), (gvi_real)(j == 1), (gvi_real)!rolls };
            gvi_real row[7] = { 0, 0, 0, 0, 0, 0, 0 };
            body_contact_row(q, from, direction, row);
            for (int i = 0; i < 7; ++i) x->jacobian[(j*x->n + a->at + i)*x->stride + k] = row[i];
        }
    }
    return 0;
}

static inline int body_rolls_points(const gvi_points *x, void *user)
{
    return body_contact_points(x, (const body_round *)user, 1);
}

static inline int body_touches_points(const gvi_points *x, void *user)
{
    return body_contact_points(x, (const body_round *)user, 0);
}

static inline gvi_effect body_rolls(const body_round *a)
{
    return (gvi_effect){ .kind = GVI_NONHOLONOMIC, .points = body_rolls_points, .user = (void *)a, .rows = 2 };
}

static inline gvi_effect body_touches(const body_round *a)
{
    return (gvi_effect){ .kind = GVI_CONSTRAINT, .points = body_touches_points, .user = (void *)a, .rows = 1 };
}

/* ------------------------------------------------------- joints, gears and ropes

   Between bodies with mass, given by their first coordinate of 7, or one and BODY_WORLD.  A joint has a frame at a
   place, of which one copy goes with a, one with b; where it is made, they are one.  It holds a sum of

      1, 2, 4   b's place is at a's: along x, y, z of a's frame       8, 16   z of a at right angles to x, y of b
                                                                         32   x of a at right angles to y of b

   in this order its rows.  No row reads velocities or t.  Rows that a closed loop makes redundant are left out by the
   library, and the rows before them bear their share: a scene may have more rows than coordinates.    */
enum { BODY_WORLD = -1 };
enum { BODY_BALL = 7, BODY_UNIVERSAL = 15,     /* its pins are z, fixed in a, and x, fixed in b    */
       BODY_HINGE = 31, BODY_SLIDER = 59,      /* about z, along z                                 */
       BODY_CYLINDER = 27, BODY_WELD = 63 };   /* both; none                                       */

typedef struct body_joint { int holds, a, b; gvi_real place[2][3], axis[2][3][3]; } body_joint;

/* A multiplier of 1 is this force at this place and this torque, all in space, on b, and the opposite on a. */
typedef struct body_row { gvi_real g, place[3], force[3], torque[3]; } body_row;

/* The joint as the bodies lie at q, its place, z and x in space; x is made square to z.  NULL: any x.  */
static inline body_joint body_joined(int holds, const gvi_real *q, int a, int b, const gvi_real *place,
                                     const gvi_real *z, const gvi_real *x)
{
    const gvi_real none[7] = { 0, 0, 0, 1, 0, 0, 0 };
    const int flat = z[0]*z[0] > z[1]*z[1];
    const gvi_real any[3] = { (gvi_real)!flat, (gvi_real)flat, 0 };
    body_joint j = { .holds = holds, .a = a, .b = b };
    gvi_real axis[3][3];
    body_cross(z, x ? x : any, axis[1]);
    body_cross(axis[1], z, axis[0]);
    for (int i = 0; i < 3; ++i) axis[2][i] = z[i];
    for (int c = 0; c < 3; ++c) {
        gvi_real *d = axis[c], size = GVI_SQRT(d[0]*d[0] + d[1]*d[1] + d[2]*d[2]);
        for (int i = 0; i < 3; ++i) d[i] /= size;
    }
    for (int side = 0; side < 2; ++side) {
        const int at = side ? b : a;
        const gvi_real *own = at < 0 ? none : q + at;
        gvi_real from[3];
        for (int i = 0; i < 3; ++i) from[i] = place[i] - own[i];
        body_rotate(own + 3, 1, from, j.place[side]);
        for (int c = 0; c < 3; ++c) body_rotate(own + 3, 1, axis[c], j.axis[side][c]);
    }
    return j;
}

/* The 7 of a body, or of the world, at point k.                                                   */
static inline void body_seven(const gvi_points *x, int at, int k, gvi_real *q)
{
    for (int i = 0; i < 7; ++i) q[i] = at < 0 ? (gvi_real)(i == 3) : x->q[(at + i)*x->stride + k];
}

/* A place of a body, in space.                                                                    */
static inline void body_place(const gvi_real *q, const gvi_real *own, gvi_real *out)
{
    body_rotate(q + 3, 0, own, out);
    for (int i = 0; i < 3; ++i) out[i] += q[i];
}

/* Of axis i of a and axis k of b: their product, a.b, and the torque on b that makes it grow.      */
static inline gvi_real body_between(const body_joint *j, gvi_real (*q)[7], int i, int k, gvi_real *torque)
{
    gvi_real a[3], b[3];
    body_rotate(q[0] + 3, 0, j->axis[0][i], a);
    body_rotate(q[1] + 3, 0, j->axis[1][k], b);
    body_cross(b, a, torque);
    return a[0]*b[0] + a[1]*b[1] + a[2]*b[2];
}

/* Row 1 << bit of a joint whose bodies' coordinates are q[0], q[1].                                */
static inline body_row body_joint_row(const body_joint *j, gvi_real (*q)[7], int bit)
{
    static const int pair[3][2] = { { 2, 0 }, { 2, 1 }, { 0, 1 } };
    body_row row = { .g = 0 };
    gvi_real a[3];
    body_place(q[1], j->place[1], row.place);
    if (bit >= 3) row.g = body_between(j, q, pair[bit - 3][0], pair[bit - 3][1], row.torque);
    else {
        body_place(q[0], j->place[0], a);
        body_rotate(q[0] + 3, 0, j->axis[0][bit], row.force);
        for (int i = 0; i < 3; ++i) row.g += (row.place[i] - a[i])*row.force[i];
    }
    return row;
}

/* `times` that force and torque in row a of the jacobian, on the body at `at`, whose coordinates are q. */
static inline void body_enter(const gvi_points *x, int k, int a, const body_row *row, int at, const gvi_real *q,
                              gvi_real times)
{
    gvi_real from[3], f[7] = { 0, 0, 0, 0, 0, 0, 0 };
    for (int i = 0; i < 3; ++i) from[i] = row->place[i] - q[i];
    body_contact_row(q, from, row->force, f);
    body_torque_in_space(q + 3, row->torque, f + 3);
    for (int i = 0; i < 7 && at >= 0; ++i) x->jacobian[(a*x->n + at + i)*x->stride + k] += times*f[i];
}

/* The 7 of both bodies, at point k.                                                               */
static inline void body_both(const gvi_points *x, const body_joint *j, int k, gvi_real (*q)[7])
{
    body_seven(x, j->a, k, q[0]);
    body_seven(x, j->b, k, q[1]);
}

static inline int body_joint_points(const gvi_points *x, void *user)
{
    const body_joint *j = (const body_joint *)user;
    if (!body_within(x, j->a) || !body_within(x, j->b)) return 1;
    for (int k = 0; k < x->count; ++k) {
        gvi_real q[2][7];
        body_both(x, j, k, q);
        for (int bit = 0, a = 0; bit < 6; ++bit) {
            if (!(j->holds >> bit & 1)) continue;
            const body_row row = body_joint_row(j, q, bit);
            x->g[a*x->stride + k] = row.g;
            body_enter(x, k, a, &row, j->b, q[1], 1);
            body_enter(x, k, a++, &row, j->a, q[0], -1);
        }
    }
    return 0;
}

static inline gvi_effect body_holds(const body_joint *j)
{
    int rows = 0;
    for (int bit = 0; bit < 6; ++bit) rows += j->holds >> bit & 1;
    return (gvi_effect){ .kind = GVI_CONSTRAINT, .points = body_joint_points, .user = (void *)j, .rows = rows };
}

/* The force on b, at its place of the joint, and the torque, in space, at q = st->q; lambda: the first of the
   joint's rows in what gvi_multipliers gives.  On a: the opposite.                                  */
static inline void body_reaction(const body_joint *j, const gvi_real *q, const gvi_real *lambda, gvi_real *force, gvi_real *torque)
{
    const gvi_points x = { .stride = 1, .q = q };
    gvi_real both[2][7];
    body_both(&x, j, 0, both);
    for (int i = 0; i < 3; ++i) force[i] = torque[i] = 0;
    for (int bit = 0; bit < 6; ++bit) {
        if (!(j->holds >> bit & 1)) continue;
        const body_row row = body_joint_row(j, both, bit);
        for (int i = 0; i < 3; ++i) force[i] += *lambda*row.force[i], torque[i] += *lambda*row.torque[i];
        ++lambda;
    }
}

/* Cosine and sine of the angle by which b has turned about z since the joint was made; and the torques on b that make them
   grow.                                                                                             */
static inline void body_turning(const body_joint *j, gvi_real (*q)[7], gvi_real *turn, gvi_real (*torque)[3])
{
    turn[0] = body_between(j, q, 0, 0, torque[0]);
    turn[1] = body_between(j, q, 1, 0, torque[1]);
}

/* The two at q = st->q: the angle is atan2(turn[1], turn[0]).                                        */
static inline void body_turned(const body_joint *j, const gvi_real *q, gvi_real *turn)
{
    const gvi_points x = { .stride = 1, .q = q };
    gvi_real both[2][7], torque[2][3];
    body_both(&x, j, 0, both);
    body_turning(j, both, turn, torque);
}

/* Of hinges turned by A and B since they were made: teeth[0] A + teeth[1] B = 0, as the row
   g = sin(teeth[0] A + teeth[1] B).  Whole numbers, positive where the hinges turn opposite ways, as small as
   the ratio allows.  A multiplier times teeth is the torque about that hinge's z.                    */
typedef struct body_gear { const body_joint *hinge[2]; int teeth[2]; } body_gear;

static inline int body_gear_points(const gvi_points *x, void *user)
{
    const body_gear *gear = (const body_gear *)user;
    for (int s = 0; s < 2; ++s)
        if (!gear->teeth[s] || !body_within(x, gear->hinge[s]->a) || !body_within(x, gear->hinge[s]->b)) return 1;
    for (int k = 0; k < x->count; ++k) {
        gvi_real q[2][2][7], turn[2][2], torque[2][2][3], re = 1, im = 0;      // of the product of (cos + i sin)^teeth
        for (int s = 0; s < 2; ++s) {
            const int back = gear->teeth[s] < 0;
            body_both(x, gear->hinge[s], k, q[s]);
            body_turning(gear->hinge[s], q[s], turn[s], torque[s]);
            if (back) turn[s][1] = -turn[s][1];
            for (int i = 0; i < 3 && back; ++i) torque[s][1][i] = -torque[s][1][i];
            for (int tooth = abs(gear->teeth[s]); tooth > 0; --tooth) {
                const gvi_real was = re;
                re = was*turn[s][0] - im*turn[s][1];
                im = was*turn[s][1] + im*turn[s][0];
            }
        }
        x->g[k] = im;
        for (int s = 0; s < 2; ++s) {                                          // d(z^n) = n z^n dz/z
            const gvi_real c = turn[s][0], d = turn[s][1], n = (gvi_real)abs(gear->teeth[s])/(c*c + d*d);
            const gvi_real by_cos = n*(im*c - re*d), by_sin = n*(im*d + re*c);
            body_row row = { .g = 0 };
            for (int i = 0; i < 3; ++i) row.torque[i] = by_cos*torque[s][0][i] + by_sin*torque[s][1][i];
            body_enter(x, k, 0, &row, gear->hinge[s]->b, q[s][1], 1);
            body_enter(x, k, 0, &row, gear->hinge[s]->a, q[s][0], -1);
        }
    }
    return 0;
}

static inline gvi_effect body_meshes(const body_gear *gear)
{
    return (gvi_effect){ .kind = GVI_CONSTRAINT, .points = body_gear_points, .user = (void *)gear, .rows = 1 };
}

/* A rope from a place of one body through a ring of another, a small pulley without mass, to a place of a third: any of them
   BODY_WORLD.  Its multiplier is its tension: above 0, or the rope would be slack.                  */
typedef struct body_rope { int at[3]; gvi_real place[3][3], length; } body_rope;

static inline int body_rope_points(const gvi_points *x, void *user)
{
    const body_rope *rope = (const body_rope *)user;
    for (int i = 0; i < 3; ++i)
        if (!body_within(x, rope->at[i])) return 1;
    for (int k = 0; k < x->count; ++k) {
        gvi_real q[3][7];
        body_row end[3];
        for (int i = 0; i < 3; ++i) {
            end[i] = (body_row){ .g = 0 };
            body_seven(x, rope->at[i], k, q[i]);
            body_place(q[i], rope->place[i], end[i].place);
        }
        x->g[k] = rope->length;
        for (int i = 0; i < 3; i += 2) {
            gvi_real d[3], size = 0;
            for (int c = 0; c < 3; ++c) d[c] = end[1].place[c] - end[i].place[c], size += d[c]*d[c];
            size = GVI_SQRT(size);
            for (int c = 0; c < 3; ++c) end[i].force[c] = d[c]/size, end[1].force[c] -= d[c]/size;
            x->g[k] -= size;
        }
        for (int i = 0; i < 3; ++i) body_enter(x, k, 0, end + i, rope->at[i], q[i], 1);
    }
    return 0;
}

static inline gvi_effect body_pulls(const body_rope *rope)
{
    return (gvi_effect){ .kind = GVI_CONSTRAINT, .points = body_rope_points, .user = (void *)rope, .rows = 1 };
}

#endif
