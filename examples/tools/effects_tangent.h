/* effects_tangent.h - products of gravity, J2 and air of effects.h, for tangent.h and adjoint.h

   A satellite's scene and its state-transition matrix (the variational equations) without a
   derivative of your own:

     const gvi_effect scene[] = { central_gravity(&earth), oblateness(&bulge), atmosphere(&air) };
     tangent T = { .plain = { ... }, .product = EFFECTS_TANGENT_ORBIT, ... };
     adjoint A = { .plain = { ... }, .product = EFFECTS_ADJOINT_ORBIT, ... };

   Each is the derivative of a force f(q, v) of one particle in space, in blocks of 3x3, A = df/dq
   and B = df/dv: the tangent adds A d + B d', the adjoint A' l to the force and B' l to dL/dv.  A
   force is linear in gm, j2 and c: f/gm, f/j2, f/c are its derivatives by them.  As columns:

     parameter 0   gm of central_gravity (not of oblateness)
     parameter 1   j2
     parameter 2   c of atmosphere

   For other effects write such blocks: effects_tangent_apply does the rest.  A particle not in
   space (dim 2) fails.  In C++20, too.  Held to differences by tests/test_effects.c. */
#ifndef EFFECTS_TANGENT_H
#define EFFECTS_TANGENT_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "effects.h"
#include "tangent.h"

/* f[3], A[9] and B[9] of the force on a particle of mass m at q with v; B is 0 beforehand, and v NULL for a potential. */
typedef void effects_tangent_blocks(const void *effect, gvi_real m, const gvi_real *q, const gvi_real *v,
                                    gvi_real *f, gvi_real *A, gvi_real *B);

/* Adds to out[3], of rows `d` apart, M z, or with `transposed` M' z.            */
static inline void effects_tangent_add(const gvi_real *M, const gvi_real *z, int d, int transposed, gvi_real *out)
{
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) out[i*d] += (transposed ? M[3*j + i] : M[3*i + j])*z[j*d];
}

/* The particles of one effect; `theta` is the parameter's value where the column is the derivative by it, else 0.  */
static inline int effects_tangent_apply(const gvi_points *x, const gvi_points *y, particles on, const gvi_real *mass,
                                        const void *effect, effects_tangent_blocks *blocks, gvi_real theta, int transposed)
{
    const int d = x->stride;
    if (on.dim != 3) return 1;
    for (int i = 0; i < on.count; ++i)
        for (int k = 0; k < x->count; ++k) {
            const size_t at = particle_row(x, on, i) + (size_t)k;
            gvi_real q[3], v[3] = { 0, 0, 0 }, f[3], A[9], B[9] = { 0 };
            for (int c = 0; c < 3; ++c) {
                q[c] = x->q[at + (size_t)(c*d)];
                if (x->v) v[c] = x->v[at + (size_t)(c*d)];
            }

            blocks(effect, mass ? mass[i] : 1, q, v, f, A, B);
            if (y->f) effects_tangent_add(A, y->q + at, d, transposed, y->f + at);
            if (transposed && y->dldv) effects_tangent_add(B, y->q + at, d, 1, y->dldv + at);
            if (!transposed && y->f && y->v) effects_tangent_add(B, y->v + at, d, 0, y->f + at);
            for (int c = 0; c < 3 && (theta < 0 || theta > 0); ++c) y->f[at + (size_t)(c*d)] += f[c]/theta;
        }
    return 0;
}

/* f = -w u, w = gm m/r^3:  A = -w (1 - 3 u u'/r^2)                             */
static inline void central_gravity_blocks(const void *effect, gvi_real m, const gvi_real *q, const gvi_real *v,
                                          gvi_real *f, gvi_real *A, gvi_real *B)
{
    const struct central_gravity *p = (const struct central_gravity *)effect;
    const gvi_real u[3] = { q[0] - p->centre[0], q[1] - p->centre[1], q[2] - p->centre[2] };
    const gvi_real r2 = u[0]*u[0] + u[1]*u[1] + u[2]*u[2], w = p->gm*m/(r2*sqrt(r2));
    for (int i = 0; i < 3; ++i) {
        f[i] = -w*u[i];
        for (int j = 0; j < 3; ++j) A[3*i + j] = w*(3*u[i]*u[j]/r2 - (i == j));
    }
    (void)v, (void)B;
}

/* f_i = s (z - c_i) u_i, s = 3 gm m J2 R^2/(2 r^5), z = 5 u_3^2/r^2, c = 1, 1, 3:
   ds/du_j = -5 s u_j/r^2     dz/du_j = (10 [j = 3] u_3 - 2 z u_j)/r^2          */
static inline void oblateness_blocks(const void *effect, gvi_real m, const gvi_real *u, const gvi_real *v,
                                     gvi_real *f, gvi_real *A, gvi_real *B)
{
    const struct oblateness *p = (const struct oblateness *)effect;
    const gvi_real r2 = u[0]*u[0] + u[1]*u[1] + u[2]*u[2], z = 5*u[2]*u[2]/r2;
    const gvi_real s = 3*p->gm*m*p->j2*p->radius*p->radius/(2*r2*r2*sqrt(r2));
    for (int i = 0; i < 3; ++i) {
        const gvi_real c = i == 2 ? z - 3 : z - 1;
        f[i] = s*c*u[i];
        for (int j = 0; j < 3; ++j) {
            const gvi_real dz = ((j == 2 ? 10*u[2] : 0) - 2*z*u[j])/r2;
            A[3*i + j] = s*((i == j ? c : 0) + u[i]*(dz - 5*c*u[j]/r2));
        }
    }
    (void)v, (void)B;
}

/* f = -k |v| v, k = c exp((R - r)/H):  dk/du = -k u/(H r)                      */
static inline void atmosphere_blocks(const void *effect, gvi_real m, const gvi_real *u, const gvi_real *v,
                                     gvi_real *f, gvi_real *A, gvi_real *B)
{
    const struct atmosphere *p = (const struct atmosphere *)effect;
    const gvi_real r = sqrt(u[0]*u[0] + u[1]*u[1] + u[2]*u[2]), speed = sqrt(v[0]*v[0] + v[1]*v[1] + v[2]*v[2]);
    const gvi_real k = p->c*exp((p->radius - r)/p->height);
    for (int i = 0; i < 3; ++i) {
        f[i] = -k*speed*v[i];
        for (int j = 0; j < 3; ++j) {
            A[3*i + j] = k*speed*v[i]*u[j]/(p->height*r);
            B[3*i + j] = speed > 0 ? -k*((i == j ? speed : 0) + v[i]*v[j]/speed) : 0;
        }
    }
    (void)m;
}

/* For tangent.product; and for adjoint.product, where the air alone is not symmetric. */
static inline int central_gravity_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const struct central_gravity *p = (const struct central_gravity *)user;
    return effects_tangent_apply(x, d, p->on, p->mass, p, central_gravity_blocks, parameter == 0 ? p->gm : 0, 0);
}

static inline int oblateness_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const struct oblateness *p = (const struct oblateness *)user;
    return effects_tangent_apply(x, d, p->on, p->mass, p, oblateness_blocks, parameter == 1 ? p->j2 : 0, 0);
}

static inline int atmosphere_product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const struct atmosphere *p = (const struct atmosphere *)user;
    return effects_tangent_apply(x, d, p->on, NULL, p, atmosphere_blocks, parameter == 2 ? p->c : 0, 0);
}

static inline int atmosphere_transposed(const gvi_points *x, const gvi_points *l, int parameter, void *user)
{
    const struct atmosphere *p = (const struct atmosphere *)user;
    return (void)parameter, effects_tangent_apply(x, l, p->on, NULL, p, atmosphere_blocks, 0, 1);
}

#define EFFECTS_TANGENT_ORBIT { central_gravity_product, oblateness_product, atmosphere_product }
#define EFFECTS_ADJOINT_ORBIT { central_gravity_product, oblateness_product, atmosphere_transposed }

#endif
