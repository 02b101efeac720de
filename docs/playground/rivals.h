/* rivals.h - what one would take otherwise: Stoermer-Verlet, Runge-Kutta 4, DOP853

   They integrate a scene's effects one point a call.  So that no loop over points is left in them,
   each callback has a copy in which count and stride are the constant 1 (ONE).  With a constant mass
   the unknowns are (q, v), with M(q) they are (q, p).  Constraints become accelerations (index 1). */
#ifndef RIVALS_H
#define RIVALS_H

#include "scenes.h"

#define ONE(name)                                                                         \
    static int name##_one(const gvi_points *x, void *user)                                \
    {                                                                                     \
        gvi_points y = *x;                                                                \
        y.count = y.stride = 1;                                                           \
        return name(&y, user);                                                            \
    }
ONE(uniform_field_force) ONE(pair_gravity_force) ONE(central_gravity_force) ONE(oblateness_force)
ONE(springs_force) ONE(tethers_force) ONE(weights_force) ONE(linear_drag_force) ONE(air_drag_force)
ONE(joint_friction_force) ONE(motor_force) ONE(servo_force) ONE(magnetic_force_points)
ONE(two_links_gradient) ONE(two_links_velocity) ONE(top_gradient) ONE(top_velocity)

/* The copy for one point; where there is none, the function itself does it.               */
static gvi_points_fn *one_point(gvi_points_fn *many)
{
    static const struct { gvi_points_fn *many, *one; } list[] = {
#define OF(name) { name, name##_one }
        OF(uniform_field_force), OF(pair_gravity_force), OF(central_gravity_force), OF(oblateness_force),
        OF(springs_force), OF(tethers_force), OF(weights_force), OF(linear_drag_force), OF(air_drag_force),
        OF(joint_friction_force), OF(motor_force), OF(servo_force), OF(magnetic_force_points),
        OF(two_links_gradient), OF(two_links_velocity), OF(top_gradient), OF(top_velocity)
    };
    for (size_t i = 0; i < sizeof list/sizeof *list; ++i)
        if (list[i].many == many) return list[i].one;
    return many;
}

enum { RIVAL_VERLET = 1, RIVAL_RK4, RIVAL_DOP853, RIVAL_STAGES = 12 };

/* Coefficients as published, in tests/cost: there in long double, here as doubles.        */
#define long
#include "../../tests/cost/coefficients.h"
#undef long

typedef struct rival {
    int         n, effects, method, reads_velocity;
    struct { gvi_points_fn *points, *value; void *user; } effect[SCENE_EFFECTS];
    const scene_setup *setup;                        /* of the constraints in `on`, rows in all */
    unsigned    on;
    int         rows;
    gvi_mass    mass;
    double      inverse[SCENE_MOST];                 /* 1/m                                */
    double      t, h, y[2*SCENE_MOST];               /* q, then v or p                     */
    double      k[RIVAL_STAGES][2*SCENE_MOST], z[2*SCENE_MOST];
    double      tolerance;                           /* DOP853                             */
    double      evaluations;
    int         fresh;                               /* k[0] holds the slope at y          */
} rival;

/* d/de [G(q + e v) v] by a difference over e v and -e v: exact where g is quadratic.       */
static void rival_bend(const rival *r, int n, const double *q, const double *v, double e, double *bend)
{
    static double g[SCENE_ROWS], rate[SCENE_ROWS], G[SCENE_ROWS*SCENE_MOST], moved[SCENE_MOST];
    for (int a = 0; a < r->rows; ++a) bend[a] = 0;
    for (double to = e; to > -2*e; to -= 2*e) {
        for (int i = 0; i < n; ++i) moved[i] = q[i] + to*v[i];
        scene_hold(r->setup, r->on, n, 0, moved, v, g, G, rate);
        for (int a = 0; a < r->rows; ++a)
            for (int i = 0; i < n; ++i) bend[a] += G[a*n+i]*v[i]/(2*to);
    }
}

/* f += M^-1 G' lambda, with (G M^-1 G') lambda = -(G f + bend): positive, so no pivots; a row that
   depends on those before it gets no force.                                               */
static void rival_hold(const rival *r, int n, const double *y, double *f)
{
    static double g[SCENE_ROWS], x[SCENE_ROWS], whole[SCENE_ROWS];
    static double G[SCENE_ROWS*SCENE_MOST], A[SCENE_ROWS][SCENE_ROWS];
    const int m = scene_hold(r->setup, r->on, n, 0, y, y + n, g, G, x);
    rival_bend(r, n, y, y + n, 1, x);
    for (int a = 0; a < m; ++a) {
        for (int i = 0; i < n; ++i) x[a] += G[a*n+i]*f[i];
        for (int b = 0; b < m; ++b) {
            A[a][b] = 0;
            for (int i = 0; i < n; ++i) A[a][b] += G[a*n+i]*r->inverse[i]*G[b*n+i];
        }
        whole[a] = A[a][a];
    }
    for (int c = 0; c < m; ++c) {
        if (!(A[c][c] > 1e-9*whole[c])) A[c][c] = INFINITY;
        for (int a = c + 1; a < m; ++a) {
            const double l = A[a][c]/A[c][c];
            for (int b = c; b < m; ++b) A[a][b] -= l*A[c][b];
            x[a] -= l*x[c];
        }
    }
    for (int a = m - 1; a >= 0; --a) {
        for (int b = a + 1; b < m; ++b) x[a] -= A[a][b]*x[b];
        x[a] /= A[a][a];
        for (int i = 0; i < n; ++i) f[i] -= r->inverse[i]*G[a*n+i]*x[a];
    }
}

/* dy = slope of y: (v, M^-1 f), (v, dL/dq + f) or (dH/dp, -dH/dq).                        */
static void rival_slope(rival *r, int n, double t, const double *y, double *dy)
{
    gvi_points x = { .n = n, .count = 1, .stride = 1, .t = &t, .q = y, .f = dy + n };
    r->evaluations += 1;
    if (r->setup->slope) {
        r->setup->slope(t, y, dy);
        return;
    }
    for (int i = 0; i < n; ++i) dy[n+i] = 0;
    if (r->mass.kind == GVI_MASS_POSITION) {
        x.p = y + n;
        x.velocity = dy;
        r->mass.velocity(&x, r->mass.user);
        x.v = dy;
        x.velocity = NULL;
        r->mass.gradient(&x, r->mass.user);
    } else {
        for (int i = 0; i < n; ++i) dy[i] = y[n+i];
        x.v = y + n;
    }
    for (int e = 0; e < r->effects; ++e) r->effect[e].points(&x, r->effect[e].user);
    if (r->mass.kind == GVI_MASS_DIAGONAL)
        for (int i = 0; i < n; ++i) dy[n+i] *= r->inverse[i];
    if (r->rows) rival_hold(r, n, y, dy + n);
}

static double rival_root8(double x) { return sqrt(sqrt(sqrt(x))); }

/* One step of h of an explicit table.  h k_0..: the slopes stay in r->k.                   */
static void rival_stages(rival *r, int n, const runge_kutta *table, double h)
{
    for (int i = r->fresh ? 1 : 0; i < table->stages; ++i) {
        const double *A = table->A[i];
        for (int l = 0; l < 2*n; ++l) r->z[l] = r->y[l];
        for (int j = 0; j < i; ++j) {
            const double a = h*A[j];
            if (!(a < 0) && !(a > 0)) continue;
            for (int l = 0; l < 2*n; ++l) r->z[l] += a*r->k[j][l];
        }
        rival_slope(r, n, r->t + h*table->c[i], r->z, r->k[i]);
    }
    r->fresh = 0;
}

static void rival_rk4(rival *r, int n, double h)
{
    rival_stages(r, n, &classical_table, h);
    const double *b = classical_table.b;
    for (int l = 0; l < 2*n; ++l)
        r->y[l] += h*(b[0]*r->k[0][l] + b[1]*r->k[1][l] + b[2]*r->k[2][l] + b[3]*r->k[3][l]);
    r->t += h;
}

/* Step control as in Hairer's code, with the tolerance for absolute and relative errors.   */
static int rival_dop853(rival *r, int n, double end)
{
    const runge_kutta *T = &dop853_table;
    for (int tries = 0; tries < 40; ++tries) {
        double h = r->h, five = 0, three = 0;
        const double left = end - r->t;
        if (h >= left) h = left;
        rival_stages(r, n, T, h);
        for (int l = 0; l < 2*n; ++l) {
            double sum = 0, e = 0, e3 = 0;
            for (int j = 0; j < 12; ++j) {
                sum += T->b[j]*r->k[j][l];
                e += T->e[j]*r->k[j][l];
                e3 += T->third[j]*r->k[j][l];
            }
            r->z[l] = r->y[l] + h*sum;
            const double a = fabs(r->y[l]), b = fabs(r->z[l]), scale = r->tolerance*(1 + (a > b ? a : b));
            e /= scale;
            e3 = (sum - e3)/scale;
            five += e*e;
            three += e3*e3;
        }
        double below = five + 0.01*three;
        if (!(below > 0)) below = 1;
        const double error = h*five/sqrt(below*2*n), grown = 0.9/rival_root8(error > 1e-20 ? error : 1e-20);
        const double factor = grown > 6 ? 6 : grown > 1/3.0 ? grown : 1/3.0;
        if (error <= 1) {
            for (int l = 0; l < 2*n; ++l) r->y[l] = r->z[l];
            r->t = h < left ? r->t + h : end;
            if (h < r->h) { if (factor < 1) r->h = h*factor; }      /* cut at the end      */
            else r->h = h*factor;
            return 0;
        }
        r->fresh = 1;                                               /* k[0] still holds    */
        r->h = h*(factor < 1 ? factor : 1/3.0);
    }
    return -1;
}

/* Kick, drift, kick; k[0] keeps the accelerations at the end for the next step.            */
static void rival_verlet(rival *r, int n, double h)
{
    if (!r->fresh) rival_slope(r, n, r->t, r->y, r->k[0]);
    for (int i = 0; i < n; ++i) {
        r->y[n+i] += h/2*r->k[0][n+i];
        r->y[i] += h*r->y[n+i];
    }
    r->t += h;
    rival_slope(r, n, r->t, r->y, r->k[0]);
    for (int i = 0; i < n; ++i) r->y[n+i] += h/2*r->k[0][n+i];
    r->fresh = 1;
}

/* A step.  Nonzero: gave up.                                                              */
static int rival_step(rival *r, double h, double end)
{
    if (r->method == RIVAL_DOP853) return rival_dop853(r, r->n, end);
    if (r->method == RIVAL_RK4) rival_rk4(r, r->n, h);
    else rival_verlet(r, r->n, h);
    return 0;
}

static double rival_energy(rival *r)
{
    double T = 0, V = 0, v[SCENE_MOST];
    if (r->setup->energy) return r->setup->energy(r->t, r->y, r->y + r->n);
    gvi_points x = { .n = r->n, .count = 1, .stride = 1, .t = &r->t, .q = r->y, .value = &V };
    for (int e = 0; e < r->effects; ++e)
        if (r->effect[e].value) r->effect[e].value(&x, r->effect[e].user);
    if (r->mass.kind == GVI_MASS_POSITION) {
        x.p = r->y + r->n;
        x.velocity = v;
        r->mass.velocity(&x, r->mass.user);
        for (int i = 0; i < r->n; ++i) T += r->y[r->n+i]*v[i]/2;
    } else
        for (int i = 0; i < r->n; ++i) T += r->y[r->n+i]*r->y[r->n+i]/r->inverse[i]/2;
    return T + V;
}

/* Whether rival_hold may take the constraints: not too many, mass constant, g quadratic, without t. */
static int rival_holds(rival *r, int n, double t, const double *q)
{
    static double g[SCENE_ROWS], rate[SCENE_ROWS], G[SCENE_ROWS*SCENE_MOST], bend[2][SCENE_ROWS], v[SCENE_MOST];
    r->rows = scene_hold(r->setup, r->on, n, t, q, NULL, g, G, rate);
    if (r->rows <= 0) return r->rows == 0;
    for (int i = 0; i < n; ++i) v[i] = i + 1;
    rival_bend(r, n, q, v, 1, bend[0]);
    rival_bend(r, n, q, v, 0.5, bend[1]);
    for (int a = 0; a < r->rows; ++a)
        if (rate[a] > 0 || rate[a] < 0 || !(fabs(bend[0][a] - bend[1][a]) <= 1e-9*(1 + fabs(bend[0][a])))) return 0;
    return r->mass.kind == GVI_MASS_UNIT || r->mass.kind == GVI_MASS_DIAGONAL;
}

/* Ready at (t, q, v, p): 0, or -1 where the method does not suit the scene.                */
static int rival_begin(rival *r, int method, int n, const scene_setup *s, unsigned on,
                       double t, const double *q, const double *v, const double *p)
{
    r->n = n;
    r->method = method;
    r->mass = s->slope ? (gvi_mass){ 0 } : s->mass;
    r->setup = s;
    r->on = 0;
    r->effects = r->fresh = 0;
    r->reads_velocity = s->slope && (s->row[0].effect.kind != GVI_POTENTIAL || s->rows > 1);
    r->evaluations = 0;
    r->t = t;
    for (int e = 0; e < s->rows; ++e) {
        const gvi_effect *effect = &s->row[e].force;
        if (!(on >> e & 1) || effect->kind == GVI_CLOCK || !effect->points) continue;
        if (effect->kind == GVI_CONSTRAINT && !s->slope) { r->on |= 1u << e; continue; }
        if (effect->kind != GVI_POTENTIAL && effect->kind != GVI_FORCE) return -1;
        /* a force that reads no v would do, but nothing says that it does not              */
        if (effect->kind == GVI_FORCE && effect->points != motor_force) r->reads_velocity = 1;
        r->effect[r->effects].points = one_point(effect->points);
        r->effect[r->effects].value = effect->value;
        r->effect[r->effects++].user = effect->user;
    }
    for (int i = 0; i < n; ++i) {
        r->inverse[i] = s->mass.kind == GVI_MASS_DIAGONAL ? 1/s->mass.matrix[i] : 1;
        r->y[i] = q[i];
        r->y[n+i] = r->mass.kind == GVI_MASS_POSITION ? p[i] : v[i];
    }
    if (!rival_holds(r, n, t, q) || (r->mass.kind == GVI_MASS_POSITION && !r->mass.velocity)) return -1;
    return method == RIVAL_VERLET && (r->reads_velocity || r->rows || s->mass.kind == GVI_MASS_POSITION) ? -1 : 0;
}

#endif
