/* adjoint.h - the gradient of a cost by stepping back, for gvi.h; needs tangent.h

   J is a function of the state at the end, or an integral on the way, or both. Its
   gradient by the initial state and by any number of parameters costs one run back,
   without a tape and without a matrix: a scene of states and costates,

     rows q   momentum p    the scene itself
     rows l   momentum pi   pi = M l' + f_v' l       pi' = F_q' l

   (f_v', F_q': transposed) starts at the end from l = dJ/dp, pi = -dJ/dq and is stepped
   by -h.  With a symmetric rule a step back retraces the step, and then the rows l are
   exactly its transposed derivative: this is the gradient of the discrete J, to
   rounding, whatever the degree and the step.  At any time dJ/dp = l, dJ/dq = -pi, and

     dJ/dtheta = sum over steps and nodes  h b_i (l_i . dF_i/dtheta + l_i' . dP_i/dtheta)

   with F = dL/dq + f, P = dL/dv at the node: two products for one parameter or a thousand.

   What the products give (tangent_fn of tangent.h; direction d = (l, l'))
     potential, Lagrangian term   the tangent's products: they are symmetric
     force f(t,q,v)               the transposed: adds f_q' l to d->f, f_v' l to d->dldv,
                                  to those that are not NULL, and is finite at v = 0
     mass.gradient                the tangent's
     mass.velocity                writes the l' whose pi is d->p: M^-1 (pi - dM v - f_v' l),
                                  dM = derivative of M along l; f_v' l and a running cost's
                                  g_v count here as well

   running cost g(t,q,v): .running adds g_q to d->f and g_v to d->dldv; J is then
   sum h b_i g_i (a sum over gvi_curve at the nodes), and dJ/dtheta gets h b_i dg_i/dtheta.

   Friction: going back it amplifies rounding, up to exp(c T) altogether. From about 1e3 on keep
   states on the way (adjoint_keep), every tenth step for instance: rounding then grows
   over ten steps only.  2n + 1 numbers each.

   By the dial: record st.h of each step of gvi_advance, set scene.desc.resolution = 0 before gvi_init,
   and go back over these steps.

   Refused (GVI_E_FORMULATION): constraints, a clock, rules that are not symmetric,
   M(q) without mass.velocity.  Kicks have gradients by the state alone.
   Source: the doubled Lagrangian L(q + e l) - L(q) + e l.f, to first order in e.   */
#ifndef ADJOINT_H
#define ADJOINT_H
#if defined __cplusplus && defined __GNUC__
#pragma GCC system_header          /* C++ would warn of fields that an initialiser does not name */
#endif

#include "tangent.h"

/* Adds weight (l.dF/dtheta + dl.dP/dtheta + dg/dtheta) to the gradient, at node i of the step. */
typedef void adjoint_gradient_fn(gvi_real t, const gvi_real *q, const gvi_real *v, const gvi_real *l,
                                 const gvi_real *dl, gvi_real weight, int node, gvi_real *gradient, void *user);

typedef struct adjoint {
    gvi_desc             plain;                 /* the scene as it is               */
    tangent_fn          *product[GVI_EFFECTS];  /* of each effect, see above        */
    tangent_fn          *gradient, *velocity;   /* of mass.gradient, mass.velocity  */
    tangent_fn          *running;               /* running cost, or NULL            */
    adjoint_gradient_fn *by_parameters;         /* or NULL                          */
    void                *user;                  /* of these two                     */
    gvi_real            *room;                  /* [ADJOINT_ROOM(n, r)]             */
    size_t               room_length;
    gvi_real            *kept;                  /* [kept_length] for adjoint_keep, or NULL */
    size_t               kept_length;
    int                  every;                 /* steps between states kept, from 1 */

    tangent scene;                              /* from here on made; scene.desc is what */
    long    step;                               /* gvi_init wants                   */
} adjoint;

#define ADJOINT_ROOM(n, r) (TANGENT_ROOM(n, 1) + 6*(size_t)(n) + 2*(size_t)(r))
#define ADJOINT_KEPT(n, steps, every) ((2*(size_t)(n) + 1)*((size_t)(steps)/(size_t)(every) + 1))

/* A force and its transposed: rows l take part in dL/dv, so for gvi.h it is a Lagrangian term. */
static inline int adjoint_force(const gvi_points *x, void *user)
{
    const tangent_part *part = (const tangent_part *)user;
    gvi_points own = *x, d;
    own.n = part->scene->plain.n;
    d = own;
    tangent_next(&d);
    own.dldv = NULL;
    if (own.f && tangent_plain(part, &own)) return 1;
    own.f = NULL;
    return part->product(&own, &d, -1, part->user);
}

static inline int adjoint_running(const gvi_points *x, void *user)
{
    const adjoint *A = (const adjoint *)user;
    gvi_points own = *x, d;
    own.n = A->plain.n;
    d = own;
    tangent_next(&d);
    own.f = own.dldv = NULL;
    return A->running(&own, &d, -1, A->user);
}

static inline int adjoint_symmetric(const gvi_rule *rule)
{
    if (rule->kind != GVI_OWN && rule->kind != GVI_KICKS) return 1;
    if (!rule->nodes || !rule->weights) return 1;                        // gvi_init refuses it
    for (int i = 0; i < rule->points; ++i) {
        const int j = rule->points - 1 - i;
        const gvi_real c = rule->nodes[i] + rule->nodes[j] - 1, b = rule->weights[i] - rule->weights[j];
        if (1 + c/8 < 1 || 1 + c/8 > 1 || 1 + b/8 < 1 || 1 + b/8 > 1) return 0;
    }
    return 1;
}

/* Fills A->scene.desc from what the caller set.                                */
static inline gvi_status adjoint_scene(adjoint *A)
{
    tangent *T = &A->scene;
    const int effects = A->plain.effect_count;
    *T = (tangent){ .plain = A->plain, .gradient = A->gradient, .velocity = A->velocity, .directions = 1,
                    .room = A->room, .room_length = A->room_length };
    for (int i = 0; i < GVI_EFFECTS; ++i) T->product[i] = A->product[i];
    // tangent.h's own M^-1 leaves f_v' l out
    if (A->plain.mass.kind == GVI_MASS_POSITION && !A->plain.mass.velocity) return GVI_E_FORMULATION;
    const gvi_status status = tangent_scene(T);
    if (status) return status;
    if (!adjoint_symmetric(&A->plain.rule)) return GVI_E_FORMULATION;
    if (A->running && effects == GVI_EFFECTS) return GVI_E_ARGUMENT;
    for (int i = 0; i < effects; ++i)
        if (A->plain.effects[i].kind == GVI_FORCE) {
            T->effect[i].kind = GVI_LAGRANGIAN;
            T->effect[i].points = adjoint_force;
        }
    if (A->running) {
        T->effect[effects] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = adjoint_running, .user = A };
        ++T->desc.effect_count;
    }
    A->step = -1;
    return GVI_OK;
}

/* Forward: before the first step and after each one.  Keeps every A->every-th state.  */
static inline gvi_status adjoint_keep(adjoint *A, const gvi_stepper *st)
{
    const int n = A->plain.n;
    const size_t size = 2*(size_t)n + 1;
    if (A->every < 1 || !A->kept) return GVI_E_ARGUMENT;
    if (++A->step % A->every) return GVI_OK;
    const size_t at = (size_t)(A->step/A->every)*size;
    if (at + size > A->kept_length) return GVI_E_MEMORY;
    gvi_real *z = A->kept + at;
    for (int i = 0; i < n; ++i) z[i] = st->q[i], z[n + i] = st->p[i];
    z[2*n] = st->t;
    return GVI_OK;
}

/* At the end: the state there and the gradient of J by it; zeros where J is a running
   cost alone.                                                                  */
static inline gvi_status adjoint_start(adjoint *A, gvi_stepper *ad, gvi_real t, const gvi_real *q,
                                       const gvi_real *p, const gvi_real *by_q, const gvi_real *by_p)
{
    const int n = A->plain.n, r = ad->r;
    const gvi_rule *rule = &A->plain.rule;
    gvi_real *z = A->room + TANGENT_ROOM(n, 1), *c = z + 6*n, *b = c + r;
    if (!q || !p || !by_q || !by_p) return GVI_E_ARGUMENT;
    if (A->room_length < ADJOINT_ROOM(n, r)) return GVI_E_MEMORY;
    if (rule->kind == GVI_GAUSS) gvi_gauss(r, c, b);
    else if (rule->kind == GVI_LOBATTO) gvi_lobatto(r, c, b);
    else for (int i = 0; i < r; ++i) c[i] = rule->nodes[i], b[i] = rule->weights[i];
    for (int i = 0; i < n; ++i) {
        z[i] = q[i], z[n + i] = by_p[i];
        z[2*n + i] = p[i], z[3*n + i] = -by_q[i];
    }
    return gvi_start_momentum(ad, t, z, z + 2*n);
}

/* Back over the step of h; adds to the gradient by parameters, if there is by_parameters. */
static inline gvi_status adjoint_step(adjoint *A, gvi_stepper *ad, gvi_real h, gvi_real *gradient)
{
    const int n = A->plain.n, r = ad->r;
    gvi_real *z = A->room + TANGENT_ROOM(n, 1), *c = z + 6*n, *b = c + r;
    if (gvi_step(ad, -h)) return ad->status;
    for (int i = 0; i < r && A->by_parameters; ++i) {
        if (gvi_curve(ad, 1 - c[i], z, z + 2*n)) return ad->status;
        A->by_parameters(ad->t + c[i]*h, z, z + 2*n, z + n, z + 3*n, h*b[i], i, gradient, A->user);
    }
    if (!A->kept || A->step < 1 || --A->step % A->every) return GVI_OK;
    const gvi_real *kept = A->kept + (size_t)(A->step/A->every)*(2*(size_t)n + 1);
    for (int i = 0; i < n; ++i) {
        z[i] = kept[i], z[n + i] = ad->q[n + i];
        z[2*n + i] = kept[n + i], z[3*n + i] = ad->p[n + i];
    }
    return gvi_start_momentum(ad, kept[2*n], z, z + 2*n);
}

/* The gradient of J by the state where the stepper is now.                      */
static inline void adjoint_gradient(const adjoint *A, const gvi_stepper *ad, gvi_real *by_q, gvi_real *by_p)
{
    const int n = A->plain.n;
    for (int i = 0; i < n; ++i) by_q[i] = -ad->p[n + i], by_p[i] = ad->q[n + i];
}

#endif
