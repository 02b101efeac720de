/* tangent.h - a scene together with its own derivative, for gvi.h

   A step maps (q, p) to (q1, p1).  Its derivative in a direction (dq, dp) is the
   same step of a larger scene: n more coordinates dq, on which acts what the
   derivative of each effect makes of that direction,

     df = F_q dq + F_v dv          d(dL/dv) = P_q dq + P_v dv

   No difference quotient, no second integrator: this is the derivative of the
   step itself, to rounding, at every degree, rule and h.  For a scene without
   friction the matrix of all 2n directions is therefore symplectic.

     columns   directions, then parameters, then h if by_h is set
     rows      coordinate i of the scene is row i; of column j, row n (1 + j) + i
     masses    constant ones are repeated.  M(q) and no mass work in momenta:
               v = M^-1 p     dv = M^-1 (dp - dM v)
               with products of mass.velocity and mass.gradient.  M(q) without mass.velocity
               is factored here, and dM comes from the gradient's product alone, n of them a
               point: df_i/dv_j = sum_k dM_jk/dq_i v_k.  Parameters must not be in M then
     parameter theta: a column that starts from zero and gets dF/dtheta besides
     h         (autonomous scenes, all steps of length h): with dp + p/h in the
               place of dp, and so dv + v/h in that of dv, the column obeys (1), (2)
               of gvi.h with the force dF + 2 F/h; tangent_column takes p/h off again

   Why: the action of L_q d + L_v d' on the curves q and d of one step is the
   derivative of the discrete action in the direction d.  Varying d gives the
   scene's own equations, varying q their derivative.

   Refused: constraints, a clock (GVI_E_FORMULATION), no mass
   without mass.velocity, M(q) pinned to Newton's method (the same), an
   effect without its product (GVI_E_ARGUMENT).  gvi_energy of the larger scene
   says GVI_E_VALUE.  A wrong product cannot be seen by a step: tangent_check.

   Limits    In its last bits the motion computed with its derivative can differ from the motion
             alone, by another number of iterations; desc.iterations makes both the same.
             Columns of a chaotic motion grow: scale them and start again before they
             overflow, as 31_tangent.c does.  In momenta there is no Newton's method to
             fall back to: where a step fails, halve it.
   Time      One column: twice that of the scene alone; four: 3.6 to 4.4 times, with as many
             iterations (Henon-Heiles, degree 8; gcc -O3 -march=native, -O2).

   Use    tangent T = { .plain = { .n = 2, .effects = scene, .effect_count = 1 },
                        .product = { product }, .directions = 4,
                        .room = room, .room_length = TANGENT_ROOM(2, 4) };
          tangent_scene(&T);                             fills T.desc
          gvi_init(&st, &T.desc, memory, sizeof memory);       GVI_LENGTH(TANGENT_N(2, 4), s, r) numbers
          tangent_start(&T, &st, 0, q, p, NULL, NULL);   NULL: the unit directions; else dq[n*j + i],
                                                         dp likewise: coordinate i of direction j
          gvi_step(&st, h);                              or gvi_advance: the columns count, too
          tangent_column(&T, &st, j, dq, dp);

   T must stay where it is while the stepper is used; two steppers that run at
   the same time take two of them.  Source of the idea: the doubled and the
   tangent Lagrangian, Marsden and West 2001, 1.3; Gauss collocation commutes
   with differentiation, Bochev and Scovel, BIT 34, 1994.                      */
#ifndef TANGENT_H
#define TANGENT_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "gvi.h"
#include <stddef.h>

/* The product of an effect's derivative with one direction.  x: the scene's points,
   no outputs.  d: the direction, d->q, d->v, d->p; adds to d->f and d->dldv what
   the effect adds to f and dldv, or writes d->velocity for mass.velocity.  With
   parameter >= 0 the column is the derivative by that parameter: what the effect
   adds changes by it as well.  Whatever of v, p, f, dldv is NULL for the effect is
   NULL here.  Returns as the effect does.                                     */
typedef int tangent_fn(const gvi_points *x, const gvi_points *d, int parameter, void *user);

struct tangent;
typedef struct tangent_part {            /* one effect, or a callback of the mass  */
    struct tangent *scene;
    gvi_points_fn  *points;
    gvi_point_fn   *point;
    tangent_fn     *product;
    void           *user;
} tangent_part;

typedef struct tangent {
    gvi_desc    plain;                   /* the scene as it is                     */
    tangent_fn *product[GVI_EFFECTS];    /* of each effect                         */
    tangent_fn *gradient, *velocity;     /* of mass.gradient and mass.velocity     */
    int         directions, parameters;  /* columns                                */
    int         by_h;                    /* one more, by h:                        */
    gvi_real    h;                       /* the step that will be taken            */
    gvi_real   *room;                    /* [TANGENT_ROOM(n, columns)] at most     */
    size_t      room_length;             /* numbers                                */

    gvi_desc     desc;                   /* from here on made by tangent_scene     */
    gvi_effect   effect[GVI_EFFECTS];
    tangent_part part[GVI_EFFECTS + 2];
    int          columns;
} tangent;

/* Enough for any kind of mass; without a dense one, or M(q) to be factored, 13 N numbers are enough. */
#define TANGENT_N(n, columns)    ((size_t)(n)*(1 + (size_t)(columns)))
#define TANGENT_ROOM(n, columns) (TANGENT_N(n, columns)*(13 + TANGENT_N(n, columns)))

/* For an effect that reads neither q nor v and no parameter: its derivative is 0. */
static inline int tangent_constant(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    return (void)x, (void)d, (void)parameter, (void)user, 0;
}

/* The next block of n rows: block 0 is the scene, block 1 + j its column j.     */
static inline void tangent_next(gvi_points *y)
{
    const ptrdiff_t rows = (ptrdiff_t)y->n*y->stride;
    y->q += rows;
    if (y->v) y->v += rows;
    if (y->p) y->p += rows;
    if (y->f) y->f += rows;
    if (y->dldv) y->dldv += rows;
    if (y->velocity) y->velocity += rows;
}

/* Row a of point k, gathered into z; NULL stays NULL.                          */
static const gvi_real *tangent_take(const gvi_real *a, int k, const gvi_points *x, gvi_real *z)
{
    for (int i = 0; a && i < x->n; ++i) z[i] = a[i*x->stride + k];
    return a ? z : NULL;
}

static inline gvi_real *tangent_zero(const gvi_real *a, int n, gvi_real *z)
{
    for (int i = 0; i < n; ++i) z[i] = 0;
    return a ? z : NULL;
}

/* One point of x in arrays of its own: q, v, p, f, dldv, velocity at z, n each. */
static gvi_points tangent_gather(const gvi_points *x, int k, gvi_real *z)
{
    const int n = x->n;
    gvi_points y = { .n = n, .count = 1, .stride = 1, .t = x->t + k, .q = tangent_take(x->q, k, x, z),
                     .v = tangent_take(x->v, k, x, z + n), .p = tangent_take(x->p, k, x, z + 2*n),
                     .f = tangent_zero(x->f, n, z + 3*n), .dldv = tangent_zero(x->dldv, n, z + 4*n),
                     .velocity = tangent_zero(x->velocity, n, z + 5*n) };
    return y;
}

/* The effect itself, whichever form it is given in.                            */
static inline int tangent_plain(const tangent_part *part, const gvi_points *x)
{
    int failed = 0;
    if (part->points) return part->points(x, part->user);
    for (int k = 0; k < x->count && !failed; ++k) {
        const gvi_points y = tangent_gather(x, k, part->scene->room);
        failed = part->point(y.t[0], y.q, y.v, y.f, y.dldv, part->user);
        for (int i = 0; x->f && i < x->n; ++i) x->f[i*x->stride + k] += y.f[i];
        for (int i = 0; x->dldv && i < x->n; ++i) x->dldv[i*x->stride + k] += y.dldv[i];
    }
    return failed;
}

/* The column by h, point by point: it needs this effect's own F, not the sum.   */
static inline int tangent_by_h(const tangent_part *part, const gvi_points *whole, const gvi_points *d)
{
    const gvi_real h = part->scene->h;
    const int n = part->scene->plain.n;
    gvi_points x = *whole;
    gvi_real *room = part->scene->room + 6*n, *dv = room + 12*n, *dp = dv + n;
    int failed = 0;
    x.n = n;
    for (int k = 0; k < x.count && !failed; ++k) {
        const gvi_points out = tangent_gather(&x, k, room);
        gvi_points y = out, e = tangent_gather(d, k, room + 6*n);
        failed = tangent_plain(part, &out);
        if (x.velocity) y.v = out.velocity;
        y.f = y.dldv = y.velocity = NULL;
        for (int i = 0; i < n; ++i) {
            if (e.v) dv[i] = e.v[i] - y.v[i]/h;
            if (e.p) dp[i] = e.p[i] - y.p[i]/h;
        }
        if (e.v) e.v = dv;
        if (e.p) e.p = dp;
        if (!failed) failed = part->product(&y, &e, -1, part->user);
        for (int i = 0; i < n; ++i) {
            const int at = i*x.stride + k;
            if (d->f) d->f[at] += e.f[i] + 2*out.f[i]/h;
            if (d->dldv) d->dldv[at] += e.dldv[i] + out.dldv[i]/h;
            if (d->velocity) d->velocity[at] = e.velocity[i] + out.velocity[i]/h;
        }
    }
    return failed;
}

/* What gvi.h calls: the effect on block 0, its products on the columns.        */
static inline int tangent_points(const gvi_points *x, void *user)
{
    const tangent_part *part = (const tangent_part *)user;
    const tangent *T = part->scene;
    gvi_points own = *x, d;
    own.n = T->plain.n;
    d = own;
    int failed = tangent_plain(part, &own);
    if (x->velocity) own.v = own.velocity;
    own.f = own.dldv = own.velocity = NULL;
    for (int j = 0; j < T->columns && !failed; ++j) {
        tangent_next(&d);
        if (T->by_h && j == T->columns - 1) failed = tangent_by_h(part, x, &d);
        else failed = part->product(&own, &d, j < T->directions ? -1 : j - T->directions, part->user);
    }
    return failed;
}

/* The mass has one user for both of its callbacks.                             */
static inline int tangent_velocity(const gvi_points *x, void *user)
{
    return tangent_points(x, (tangent_part *)user);
}

static inline int tangent_gradient(const gvi_points *x, void *user)
{
    return tangent_points(x, (tangent_part *)user + 1);
}

/* M := L D L', n*n, its lower triangle; and M^-1 z.                             */
static inline int tangent_factor(int n, gvi_real *M)
{
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < j; ++k) M[i*n + j] -= M[i*n + k]*M[j*n + k];        // L D so far
        for (int j = 0; j < i; ++j) {
            const gvi_real l = M[i*n + j]/M[j*n + j];
            M[i*n + i] -= l*M[i*n + j];
            M[i*n + j] = l;
        }
        if (!(M[i*n + i] > 0 || M[i*n + i] < 0)) return 0;
    }
    return 1;
}

static inline void tangent_divide(int n, const gvi_real *M, gvi_real *z)
{
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) z[i] -= M[i*n + j]*z[j];
    for (int i = 0; i < n; ++i) z[i] /= M[i*n + i];
    for (int i = n; i-- > 0; )
        for (int j = 0; j < i; ++j) z[j] -= M[i*n + j]*z[i];
}

/* mass.velocity of all blocks where the scene has none, point by point.         */
static inline int tangent_solve(const gvi_points *x, void *user)
{
    const tangent *T = ((const tangent_part *)user)->scene;
    const int n = T->plain.n, R = x->stride;
    gvi_real *q = T->room, *v = q + n, *unit = v + n, *none = unit + n, *z = none + n, *M = z + 16*n + 2*x->n, *B = M + n*n;
    for (int k = 0; k < x->count; ++k) {
        const gvi_points at = { .n = n, .count = 1, .stride = 1, .t = x->t + k, .q = q, .mass = M };
        gvi_points y = { .n = n, .count = 1, .stride = 1, .t = x->t + k, .q = q, .v = v };
        for (int i = 0; i < n; ++i) q[i] = x->q[i*R + k], v[i] = x->p[i*R + k], unit[i] = none[i] = 0;
        for (int i = 0; i < n*n; ++i) M[i] = B[i] = 0;
        if (T->plain.mass.points(&at, T->plain.mass.user) || !tangent_factor(n, M)) return 1;
        tangent_divide(n, M, v);
        for (int i = 0; i < n; ++i) x->velocity[i*R + k] = v[i];

        // row j of B: the gradient's derivative by v_j
        for (int j = 0; j < n; ++j) {
            const gvi_points d = { .n = n, .count = 1, .stride = 1, .t = y.t, .q = none, .v = unit, .f = B + j*n };
            unit[j] = 1;
            if (T->gradient(&y, &d, -1, T->plain.mass.user)) return 1;
            unit[j] = 0;
        }
        for (int block = n; block < x->n; block += n) {
            for (int j = 0; j < n; ++j) {
                z[j] = x->p[(block + j)*R + k];
                for (int i = 0; i < n; ++i) z[j] -= B[j*n + i]*x->q[(block + i)*R + k];
            }
            tangent_divide(n, M, z);
            for (int i = 0; i < n; ++i) x->velocity[(block + i)*R + k] = z[i];
        }
    }
    return 0;
}

/* mass.points has to be given, and is not called where mass.velocity is.       */
static inline int tangent_no_matrix(const gvi_points *x, void *user) { return (void)x, (void)user, 1; }

/* Fills T->desc from what the caller set.                                      */
static inline gvi_status tangent_scene(tangent *T)
{
    const gvi_desc *plain = &T->plain;
    const gvi_mass *mass = &plain->mass;
    const int moving = mass->kind == GVI_MASS_POSITION || mass->kind == GVI_MASS_NONE, n = plain->n;
    const int dense = mass->kind == GVI_MASS_DENSE, solves = mass->kind == GVI_MASS_POSITION && !mass->velocity;
    T->columns = T->directions + T->parameters + (T->by_h != 0);
    const size_t N = TANGENT_N(n, T->columns), start = 20*(size_t)n + 2*N;
    if (n < 1 || T->columns < 1 || T->directions < 0 || T->parameters < 0 || !T->room) return GVI_E_ARGUMENT;
    if (plain->effect_count < 0 || plain->effect_count > GVI_EFFECTS) return GVI_E_ARGUMENT;
    if (plain->effect_count > 0 && !plain->effects) return GVI_E_ARGUMENT;
    if (T->by_h && !(T->h > 0 || T->h < 0)) return GVI_E_ARGUMENT;
    if (T->room_length < start + (dense ? N*N : solves ? 2*(size_t)n*(size_t)n : N)) return GVI_E_MEMORY;

    T->desc = *plain;
    T->desc.n = (int)N;
    T->desc.effects = T->effect;
    for (int i = 0; i < plain->effect_count; ++i) {
        const gvi_effect *e = &plain->effects[i];
        if (e->kind >= GVI_CLOCK) return GVI_E_FORMULATION;            // or constraints
        if (!T->product[i] || !e->points == !e->point) return GVI_E_ARGUMENT;
        T->part[i] = (tangent_part){ T, e->points, e->point, T->product[i], e->user };
        T->effect[i] = (gvi_effect){ .kind = e->kind, .points = tangent_points, .user = &T->part[i] };
    }
    if (moving) {
        tangent_part *part = T->part + GVI_EFFECTS;      // velocity, then gradient
        if ((!mass->velocity && !solves) || (plain->formulation != GVI_AUTO && plain->formulation != GVI_MOMENTA))
            return GVI_E_FORMULATION;
        if (solves ? !mass->points : !T->velocity) return GVI_E_ARGUMENT;
        if (mass->kind == GVI_MASS_POSITION && (!T->gradient || !mass->gradient))
            return GVI_E_ARGUMENT;
        T->desc.formulation = GVI_MOMENTA;
        part[0] = (tangent_part){ T, mass->velocity, NULL, T->velocity, mass->user };
        part[1] = (tangent_part){ T, mass->gradient, NULL, T->gradient, mass->user };
        T->desc.mass = (gvi_mass){ .kind = mass->kind, .velocity = solves ? tangent_solve : tangent_velocity, .user = part };
        if (mass->kind == GVI_MASS_POSITION) {
            T->desc.mass.points = tangent_no_matrix;
            T->desc.mass.gradient = tangent_gradient;
        }
    } else if (mass->matrix) {
        gvi_real *m = T->room + start;
        for (size_t k = 0; k < (dense ? N*N : N); ++k) m[k] = dense ? 0 : mass->matrix[k % (size_t)n];
        for (size_t i = 0; dense && i < N; ++i)
            for (size_t j = i - i % (size_t)n; j <= i; ++j)
                m[i*N + j] = mass->matrix[i % (size_t)n*(size_t)n + j % (size_t)n];
        T->desc.mass.matrix = m;
    }
    return GVI_OK;
}

/* Starts from (q, p) and the directions dq, dp [directions][n]; NULL: the unit ones,
   first along q, then along p.  The other columns start as they have to.       */
static inline gvi_status tangent_start(const tangent *T, gvi_stepper *st, gvi_real t, const gvi_real *q,
                                       const gvi_real *p, const gvi_real *dq, const gvi_real *dp)
{
    const int n = T->plain.n, N = n*(1 + T->columns);
    gvi_real *Q = T->room + 20*n, *P = Q + N;
    if (!q || !p) return gvi_start_momentum(st, t, q, p);           // says so
    for (int i = 0; i < n; ++i) Q[i] = q[i], P[i] = p[i];
    for (int j = 0; j < T->columns; ++j)
        for (int i = 0; i < n; ++i) {
            const int at = n*(1 + j) + i, given = j < T->directions;
            Q[at] = !given ? 0 : dq ? dq[n*j + i] : (gvi_real)(i == j);
            P[at] = !given ? 0 : dp ? dp[n*j + i] : (gvi_real)(i + n == j);
            if (T->by_h && j == T->columns - 1) P[at] = p[i]/T->h;
        }
    return gvi_start_momentum(st, t, Q, P);
}

/* Column j: the derivatives of q and p.                                        */
static inline void tangent_column(const tangent *T, const gvi_stepper *st, int j, gvi_real *dq, gvi_real *dp)
{
    const int n = T->plain.n;
    for (int i = 0; i < n; ++i) {
        dq[i] = st->q[n*(1 + j) + i];
        dp[i] = st->p[n*(1 + j) + i];
        if (T->by_h && j == T->columns - 1) dp[i] -= st->p[i]/T->h;
    }
}

/* How far the products are from differences of their effects, of order 4, at one point: the
   largest |product - difference| over the larger of the two.  About eps^(4/5) where all is
   right; the share that is wrong, where something is; NaN, where something is not a number.  *part then says where: the number of
   the effect, GVI_EFFECTS for mass.velocity, GVI_EFFECTS + 1 for mass.gradient.  dq, dv [n]:
   the direction, of the size of the motion; for mass.velocity v, dv are p, dp.  -1: an effect
   refused.  Derivatives by parameters are not looked at.                      */
static inline gvi_real tangent_check(const tangent *T, gvi_real t, const gvi_real *q, const gvi_real *v,
                                     const gvi_real *dq, const gvi_real *dv, int *part)
{
    const int n = T->plain.n, moving = T->desc.mass.velocity != NULL;
    const gvi_real step[] = { 1, -1, 2, -2 }, weight[] = { 8, -8, -1, 1 };
    gvi_real D = (gvi_real)0.5, far = 0;
    while (1 + D*D*D*D*D > 1) D /= 2;
    for (int i = 0; i < GVI_EFFECTS + 2; ++i) {
        const tangent_part *a = T->part + i;
        const int mass = i >= GVI_EFFECTS, velocity = i == GVI_EFFECTS;
        const gvi_kind kind = mass ? GVI_FORCE : i < T->plain.effect_count ? T->effect[i].kind : GVI_FORCE;
        gvi_real *Q = T->room + 6*n, *V = Q + n, *out = V + n, *slope = out + 2*n, *product = slope + 2*n;
        gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &t, .q = Q,
                         .v = kind == GVI_POTENTIAL || velocity ? NULL : V, .p = velocity ? V : NULL,
                         .f = velocity ? NULL : out, .dldv = kind == GVI_LAGRANGIAN ? out + n : NULL,
                         .velocity = velocity ? out : NULL };
        if (mass ? !moving || !a->points : i >= T->plain.effect_count) continue;
        for (int k = 0; k < 2*n; ++k) slope[k] = product[k] = 0;
        for (int z = 0; z < 5; ++z) {
            for (int k = 0; k < n; ++k) {
                Q[k] = q[k] + (z < 4 ? step[z]*D*dq[k] : 0);
                V[k] = v[k] + (z < 4 ? step[z]*D*dv[k] : 0);
                out[k] = out[n + k] = 0;
            }
            if (tangent_plain(a, &x)) return -1;
            for (int k = 0; k < 2*n && z < 4; ++k) slope[k] += weight[z]*out[k]/(12*D);
        }
        gvi_points y = x, d = x;
        if (velocity) y.v = out;
        y.f = y.dldv = y.velocity = NULL;
        d.q = dq;
        if (x.v) d.v = dv;
        if (x.p) d.p = dv;
        if (x.f) d.f = product;
        if (x.dldv) d.dldv = product + n;
        if (x.velocity) d.velocity = product;
        if (a->product(&y, &d, -1, a->user)) return -1;
        gvi_real large = 0, off = 0;
        for (int k = 0; k < 2*n; ++k) {
            const gvi_real both[] = { product[k], slope[k] }, e = product[k] - slope[k];
            for (int z = 0; z < 2; ++z) {
                if (both[z] > large) large = both[z];
                if (-both[z] > large) large = -both[z];
            }
            if (off >= 0 && !(e <= off && -e <= off)) off = e < 0 ? -e : e;        // NaN stays
        }
        if (far >= 0 && !(off <= far*large)) far = off/large, *part = i;
    }
    return far;
}

#endif
