/* written.h - a scene written otherwise

   What a way of writing may change of a scene: units, origin, axes, speed and date of the frame, how many copies there are,
   how its laws are listed.  A point of the written scene is mapped back to the scene, the law is evaluated there, and what
   it gives is mapped forth:

     q' = l R (q - 0) + a + u (t' - t0')     t' = T t + t0'     m' = M m     L' = M l^2/T^2 L

   l, T, M: units; R: axes (orthogonal); a: origin; u: speed.  The equations of a step are the same in both, whatever the
   rule, since all this is linear: the ends differ by roundings alone.                          */
#ifndef EVERYDAY_WRITTEN_H
#define EVERYDAY_WRITTEN_H

#include "scene.h"

enum { COPIES = 2, MOST = N*COPIES, LISTED = 16 };
typedef enum { AS_IT_IS, AS_DENSE, AS_POSITION, AS_TERM } mass_form;

typedef struct written {
    const scene *scene;
    int  copies;
    real length, time, mass;            /* units                                                           */
    real copy_length, copy_mass;        /* those of the second copy over those of the first                */
    real date, origin[N], speed[N], R[N][N];
    mass_form inertia;
    int  reversed, split, idle, gauge, potential_as_term, doubled;
    /* how it is integrated */
    int  degree, points;
    gvi_rule_kind rule;
    gvi_formulation formulation;
    real dial;
} written;

static written plainly(const scene *s)
{
    written w = { .scene = s, .copies = 1, .length = 1, .time = 1, .mass = 1, .copy_length = 1, .copy_mass = 1, .degree = 8 };
    for (int i = 0; i < N; ++i) w.R[i][i] = 1;
    return w;
}

/* ---- maps of states; c: the copy */

static real length_of(const written *w, int c) { return c ? w->length*w->copy_length : w->length; }
static real energy_of(const written *w, int c)
{
    const real v = length_of(w, c)/w->time;
    return w->mass*(c ? w->copy_mass : 1)*v*v;
}

static void forth(const written *w, const real *q, const real *v, real *Q, real *V)
{
    const int n = w->scene->n;
    for (int c = 0; c < w->copies; ++c)
        for (int i = 0; i < n; ++i) {
            real x = 0, y = 0;
            for (int j = 0; j < n; ++j) x += w->R[i][j]*q[j], y += w->R[i][j]*v[j];
            Q[c*n + i] = length_of(w, c)*(x + w->origin[i]);
            V[c*n + i] = length_of(w, c)/w->time*(y + w->speed[i]);
        }
}

/* of row i at stride: of points, or 1; V may be NULL */
static void back(const written *w, int c, real t, const real *Q, const real *V, int stride, real *q, real *v)
{
    const int n = w->scene->n;
    const real l = length_of(w, c);
    for (int j = 0; j < n; ++j) q[j] = v[j] = 0;
    for (int i = 0; i < n; ++i) {
        const real x = Q[(c*n + i)*stride]/l - w->origin[i] - w->speed[i]*t;
        const real y = V ? V[(c*n + i)*stride]*w->time/l - w->speed[i] : 0;
        for (int j = 0; j < n; ++j) q[j] += w->R[i][j]*x, v[j] += w->R[i][j]*y;
    }
}

/* ---- one law at one point */

/* What an effect of the written scene is: a law of the scene, a kinetic energy as term, or d/dt of q'K q/2 */
typedef enum { LAW_, KINETIC, GAUGE } role_kind;
typedef struct role {
    const written *w;
    role_kind kind;
    part part;
    real share, sign;                   /* of the law; of its value                                        */
} role;

typedef struct place {                  /* of the scene, with room for what a law gives                    */
    real t, q[N], v[N], f[N], d[N], value, M[N*N], g[ROWS], G[ROWS*N], rate[ROWS];
} place;

static gvi_points points_of(const scene *s, place *a)
{
    const gvi_points x = { .n = s->n, .count = 1, .stride = 1, .t = &a->t, .q = a->q, .v = a->v, .f = a->f, .dldv = a->d,
                           .value = &a->value, .mass = a->M, .g = a->g, .jacobian = a->G, .rate = a->rate };
    return x;
}

static void take(const written *w, int c, const gvi_points *x, int k, place *a)
{
    memset(a, 0, sizeof *a);
    a->t = (x->t[k] - w->date)/w->time;
    back(w, c, a->t, x->q + k, x->v ? x->v + k : NULL, x->stride, a->q, a->v);
}

static void inertia(const written *w, place *a)
{
    const scene *s = w->scene;
    const gvi_points x = points_of(s, a);
    if (s->mass) s->mass(&x, s->par);
    else for (int i = 0; i < s->n; ++i) a->M[i*s->n + i] = s->massless ? 0 : s->m[i] > 0 ? s->m[i] : 1;
    for (int i = 0; i < s->n; ++i) for (int j = i + 1; j < s->n; ++j) a->M[i*s->n + j] = a->M[j*s->n + i];
}

static void kinetic(const written *w, place *a)
{
    const int n = w->scene->n;
    const gvi_points x = points_of(w->scene, a);
    inertia(w, a);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            a->d[i] += a->M[i*n + j]*a->v[j];
            a->value += a->v[i]*a->M[i*n + j]*a->v[j]/2;
        }
    if (w->scene->gradient) w->scene->gradient(&x, w->scene->par);
}

/* d/dt (q'K q/2) = q'K v: a rule of order 2s integrates it exactly */
static void exact_term(const written *w, place *a)
{
    const int n = w->scene->n;
    const real unit = 2/w->scene->period;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const real K = unit*(real)(1 + (i + j)%3)/3;
            a->d[i] += K*a->q[j];
            a->f[i] += K*a->v[j];
            a->value += K*a->q[j]*a->v[i];
        }
}

static void evaluate(const role *r, place *a)
{
    const gvi_points x = points_of(r->w->scene, a);
    if (r->kind == KINETIC) kinetic(r->w, a);
    else if (r->kind == GAUGE) exact_term(r->w, a);
    else r->part.at(&x, r->w->scene->par);
}

static real turned(const written *w, int i, const real *a)
{
    real sum = 0;
    for (int j = 0; j < w->scene->n; ++j) sum += w->R[i][j]*a[j];
    return sum;
}

/* ---- the callbacks */

static int give_forces(const gvi_points *x, void *user)
{
    const role *r = user;
    const written *w = r->w;
    const int n = w->scene->n;
    place a;
    for (int k = 0; k < x->count; ++k)
        for (int c = 0; c < w->copies; ++c) {
            const real E = r->share*energy_of(w, c), l = length_of(w, c);
            take(w, c, x, k, &a);
            evaluate(r, &a);
            for (int i = 0; i < n; ++i) {
                const int at = (c*n + i)*x->stride + k;
                if (x->f) x->f[at] += E/l*turned(w, i, a.f);
                if (x->dldv) x->dldv[at] += E/l*w->time*turned(w, i, a.d);
            }
            if (x->value) x->value[k] += r->sign*E*a.value;
        }
    return 0;
}

static int give_clock(const gvi_points *x, void *user)
{
    const role *r = user;
    place a;
    for (int k = 0; k < x->count; ++k) {
        take(r->w, 0, x, k, &a);
        evaluate(r, &a);
        x->value[k] += r->w->time*a.value;
        for (int i = 0; i < x->n; ++i) x->f[i*x->stride + k] += r->w->time/r->w->length*turned(r->w, i, a.f);
    }
    return 0;
}

static int give_rows(const gvi_points *x, void *user)
{
    const role *r = user;
    const written *w = r->w;
    const int n = w->scene->n, rows = r->part.rows;
    place a;
    for (int k = 0; k < x->count; ++k)
        for (int c = 0; c < w->copies; ++c) {
            take(w, c, x, k, &a);
            evaluate(r, &a);
            for (int b = 0; b < rows; ++b) {
                const int row = c*rows + b;
                real rate = a.rate[b]/w->time;
                for (int i = 0; i < n; ++i) {
                    const real G = turned(w, i, a.G + b*n)/length_of(w, c);
                    x->jacobian[(row*x->n + c*n + i)*x->stride + k] = G;
                    rate -= G*length_of(w, c)/w->time*w->speed[i];
                }
                if (r->part.kind == GVI_CONSTRAINT) x->g[row*x->stride + k] = a.g[b];
                x->rate[row*x->stride + k] = rate;
            }
        }
    return 0;
}

static int give_mass(const gvi_points *x, void *user)
{
    const written *w = user;
    const int n = w->scene->n;
    place a;
    for (int k = 0; k < x->count; ++k)
        for (int c = 0; c < w->copies; ++c) {
            take(w, c, x, k, &a);
            inertia(w, &a);
            for (int i = 0; i < n; ++i)
                for (int j = 0; j <= i; ++j) {
                    real sum = 0;
                    for (int e = 0; e < n; ++e) sum += w->R[i][e]*turned(w, j, a.M + e*n);
                    x->mass[((c*n + i)*x->n + c*n + j)*x->stride + k] = w->mass*(c ? w->copy_mass : 1)*sum;
                }
        }
    return 0;
}

static int give_gradient(const gvi_points *x, void *user)
{
    const written *w = user;
    const scene *s = w->scene;
    place a;
    if (!s->gradient) return 0;
    for (int k = 0; k < x->count; ++k)
        for (int c = 0; c < w->copies; ++c) {
            take(w, c, x, k, &a);
            const gvi_points at = points_of(s, &a);
            s->gradient(&at, s->par);
            for (int i = 0; i < s->n; ++i)
                x->f[(c*s->n + i)*x->stride + k] += energy_of(w, c)/length_of(w, c)*turned(w, i, a.f);
        }
    return 0;
}

static int never(const gvi_points *x, void *user) { return (void)x, (void)user, 1; }    /* an effect that is off */

/* ---- the description */

typedef struct listing {
    gvi_desc desc;
    gvi_effect effects[LISTED];
    role roles[LISTED];
    real matrix[MOST*MOST];
    int  idle;                          /* index of the effect to be switched off, or -1                   */
} listing;

static void list_role(listing *a, const written *w, role_kind kind, part p, real share)
{
    const int e = a->desc.effect_count++;
    const role r = { w, kind, p, share, 1 };
    gvi_effect *effect = a->effects + e;
    const gvi_effect none = { .kind = p.kind };
    a->roles[e] = r;
    *effect = none;
    effect->user = a->roles + e;
    effect->points = give_forces;
    if (p.kind == GVI_CLOCK) effect->points = effect->value = give_clock;
    else if (p.kind >= GVI_CONSTRAINT) effect->points = give_rows, effect->rows = p.rows*w->copies;
    else if (p.kind != GVI_FORCE) effect->value = give_forces;
}

static void list_part(listing *a, const written *w, part p, int first)
{
    const int acts = p.kind <= GVI_LAGRANGIAN, holds = p.kind >= GVI_CONSTRAINT;
    const int as_term = w->potential_as_term && p.kind == GVI_POTENTIAL;
    if (as_term) p.kind = GVI_LAGRANGIAN;
    const int from = a->desc.effect_count, twice = (w->split && first && acts) || (w->doubled && holds);
    list_role(a, w, LAW_, p, twice && acts ? R(.25) : 1);
    if (twice) list_role(a, w, LAW_, p, acts ? R(.75) : 1);
    for (int e = from; as_term && e < a->desc.effect_count; ++e) a->roles[e].sign = -1;
}

static void list_effects(listing *a, const written *w)
{
    const scene *s = w->scene;
    const int count = parts_of(s);
    const part term = { GVI_LAGRANGIAN, NULL, 0 };
    for (int e = 0; e < count; ++e) list_part(a, w, s->parts[w->reversed ? count - 1 - e : e], e == 0);
    if (w->inertia == AS_TERM) list_role(a, w, KINETIC, term, 1);
    if (w->gauge) list_role(a, w, GAUGE, term, 1);
    a->idle = -1;
    if (!w->idle) return;
    a->idle = a->desc.effect_count++;
    const gvi_effect off = { .kind = GVI_FORCE, .points = never };
    a->effects[a->idle] = off;
}

static void list_mass(listing *a, const written *w)
{
    const scene *s = w->scene;
    const int n = a->desc.n;
    gvi_mass *mass = &a->desc.mass;
    int diagonal = 1;
    if (s->massless || w->inertia == AS_TERM) { mass->kind = GVI_MASS_NONE; return; }
    mass->user = (void *)(size_t)w;
    mass->points = give_mass;
    mass->gradient = give_gradient;
    mass->kind = GVI_MASS_POSITION;
    if (s->mass || w->inertia == AS_POSITION) return;
    const real zeros[MOST] = { 0 };
    const gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &w->date, .q = zeros, .v = zeros, .mass = a->matrix };
    give_mass(&x, mass->user);
    for (int i = 0; i < n; ++i) for (int j = 0; j < i; ++j) diagonal &= a->matrix[i*n + j] == 0;
    mass->points = mass->gradient = NULL;
    mass->user = NULL;
    mass->matrix = a->matrix;
    mass->kind = GVI_MASS_DENSE;
    if (!diagonal || w->inertia == AS_DENSE) return;
    mass->kind = GVI_MASS_DIAGONAL;
    for (int i = 0; i < n; ++i) a->matrix[i] = a->matrix[i*n + i];
}

/* McLachlan's kicks and drifts of order 2, symmetric: b, 1 - 2b, b at 1/6, 1/2, 5/6 */
static const real kick_times[] = { R(1)/6, R(.5), R(5)/6 }, kick_weights[] = { R(.3), R(.4), R(.3) };

static void list_all(listing *a, const written *w)
{
    memset(a, 0, sizeof *a);
    a->desc.n = w->scene->n*w->copies;
    a->desc.degree = w->degree;
    a->desc.rule.kind = w->rule;
    a->desc.rule.points = w->points;
    if (w->rule == GVI_KICKS) a->desc.rule.nodes = kick_times, a->desc.rule.weights = kick_weights;
    a->desc.formulation = w->formulation;
    a->desc.resolution = w->dial;
    a->desc.effects = a->effects;
    list_effects(a, w);
    if (!a->desc.effect_count) a->desc.effects = NULL;
    list_mass(a, w);
}

#endif
