/* 18 - What would have to be different? A gradient by stepping back

   A body around a planet, in thin air, was not seen where it should be. Which number is to blame, and
   by how much: the drag, the start, a push on the way? One question about the end, many
   numbers that it depends on: the derivative of lesson 17 would take a column for each.
   The other way round takes one run for all of them. tools/adjoint.h makes a scene of the
   body and of its costate l, starts it at the end from the derivative of the question J,
   and steps back. Then l is dJ/dp at every time: what a push there would have done. The
   force's derivative by the drag, times l, summed over the nodes, is dJ/dc. It is the gradient of the numbers that the steps made, to rounding: differences agree as
   far as they can. Nothing is stored on the way but the state after every fifth step, and
   that for one reason: friction, going back, amplifies rounding.

   prints

     dJ/dc = -1.38446060404
     differences, two more runs, agree to 1e-7:                    yes
     what a push at t = 1 would have done, differences to 1e-7:    yes
     from where it was seen, the drag comes out as 0.05 to 1e-11:  yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/adjoint.h"
#include <math.h>
#include <stdio.h>

enum { STEPS = 10, DEGREE = 8, EVERY = 5 };
static const double h = 0.2, q0[] = { 1, 0.2 }, p0[] = { -0.1, 1.1 };
static double drag;                                                  // c

static int attraction(const gvi_points *x, void *user)
{
    const double *X = x->q, *Y = X + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double d2 = X[k]*X[k] + Y[k]*Y[k], w = -1/(d2*sqrt(d2));
        x->f[k] += w*X[k], x->f[x->stride + k] += w*Y[k];
    }
    return (void)user, 0;
}

/* Its derivative times l.  A potential's is symmetric: its own transpose.       */
static int attraction_product(const gvi_points *x, const gvi_points *l, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double X = x->q[k], Y = x->q[s+k], a = l->q[k], b = l->q[s+k], d2 = X*X + Y*Y;
        const double w = 1/(d2*sqrt(d2)), along = 3*(X*a + Y*b)/d2;
        l->f[k] += w*(along*X - a);
        l->f[s+k] += w*(along*Y - b);
    }
    return (void)parameter, (void)user, 0;
}

/* The air: f = -c |v| v.                                                        */
static int air(const gvi_points *x, void *user)
{
    const double *u = x->v, *v = u + x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double z = drag*sqrt(u[k]*u[k] + v[k]*v[k]);
        x->f[k] -= z*u[k], x->f[x->stride + k] -= z*v[k];
    }
    return (void)user, 0;
}

/* f_v' l, which belongs to the momentum of l; f_q is 0.                         */
static int air_transposed(const gvi_points *x, const gvi_points *l, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count && l->dldv; ++k) {
        const double u = x->v[k], v = x->v[s+k], z = sqrt(u*u + v*v), a = l->q[k], b = l->q[s+k];
        const double along = z > 0 ? (u*a + v*b)/z : 0;
        l->dldv[k] -= drag*(z*a + along*u);
        l->dldv[s+k] -= drag*(z*b + along*v);
    }
    return (void)parameter, (void)user, 0;
}

/* Adds weight l.df/dc: what node by node makes dJ/dc.                           */
static void by_drag(double t, const double *q, const double *v, const double *l, const double *dl,
                    double weight, int node, double *gradient, void *user)
{
    gradient[0] -= weight*sqrt(v[0]*v[0] + v[1]*v[1])*(v[0]*l[0] + v[1]*l[1]);
    (void)t, (void)q, (void)dl, (void)node, (void)user;
}

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction }, { .kind = GVI_FORCE, .points = air } };
static const gvi_desc body = { .n = 2, .degree = DEGREE, .effects = scene, .effect_count = 2 };
static double memory[GVI_LENGTH(2, DEGREE, DEGREE)], back_memory[GVI_LENGTH(4, DEGREE, DEGREE)];
static double room[ADJOINT_ROOM(2, DEGREE)], kept[ADJOINT_KEPT(2, STEPS, EVERY)];

/* The end (q, p) with a drag c and a push along x at t = 1.  A keeps states.    */
static int run(double c, double push, adjoint *A, double *end)
{
    gvi_stepper st;
    drag = c;
    gvi_init(&st, &body, memory, sizeof memory);
    gvi_start_momentum(&st, 0, q0, p0);
    for (int k = 0; k < STEPS && !st.status; ++k) {
        if (A) adjoint_keep(A, &st);
        if (k == STEPS/2) gvi_start_momentum(&st, st.t, st.q, (double[]){ st.p[0] + push, st.p[1] });
        gvi_step(&st, h);
    }
    for (int i = 0; i < 2; ++i) end[i] = st.q[i], end[2 + i] = st.p[i];
    if (A) adjoint_keep(A, &st);
    return st.status;
}

/* dJ/dc with the drag c, for dJ/d(q, p) at the end as given, or, NULL, for J = |q - seen|^2/2;
   push: dJ/dp_x at t = 1.                                                      */
static double gradient(double c, const double *by_end, const double *seen, double *push)
{
    adjoint A = { .plain = body, .product = { attraction_product, air_transposed }, .by_parameters = by_drag,
                  .room = room, .room_length = ADJOINT_ROOM(2, DEGREE),
                  .kept = kept, .kept_length = ADJOINT_KEPT(2, STEPS, EVERY), .every = EVERY };
    double end[4], g = 0, by_q[2], by_p[2];
    gvi_stepper ad;
    if (adjoint_scene(&A) || gvi_init(&ad, &A.scene.desc, back_memory, sizeof back_memory) || run(c, 0, &A, end)) return NAN;
    const double miss[] = { seen ? end[0] - seen[0] : 0, seen ? end[1] - seen[1] : 0, 0, 0 };
    adjoint_start(&A, &ad, STEPS*h, end, end + 2, by_end ? by_end : miss, by_end ? by_end + 2 : miss + 2);
    for (int k = STEPS - 1; k >= 0; --k) {
        if (adjoint_step(&A, &ad, h, &g)) return NAN;
        adjoint_gradient(&A, &ad, by_q, by_p);
        if (k == STEPS/2) *push = by_p[0];
    }
    return g;
}

int main(void)
{
    const double J[] = { 1, -2, 0.4, 3 }, D = 1e-4;                  // J = x - 2 y + 0.4 p_x + 3 p_y
    double a[4], b[4], u[4], w[4], seen[4], by_c = 0, by_push = 0, push, c[2] = { 0.02, 0.03 }, slope[2];
    const double g = gradient(0.05, J, NULL, &push);
    printf("dJ/dc = %.11f\n", g);

    if (run(0.05 + D, 0, NULL, a) || run(0.05 - D, 0, NULL, b) || run(0.05, D, NULL, u) || run(0.05, -D, NULL, w)) return 1;
    for (int i = 0; i < 4; ++i) by_c += J[i]*(a[i] - b[i])/(2*D), by_push += J[i]*(u[i] - w[i])/(2*D);
    printf("differences, two more runs, agree to 1e-7:                    %s\n", fabs(by_c - g) < 1e-7 ? "yes" : "no");
    printf("what a push at t = 1 would have done, differences to 1e-7:    %s\n", fabs(by_push - push) < 1e-7 ? "yes" : "no");

    // Seen at the end of a run with 0.05: the drag at which the gradient of the miss is 0, by secants.
    if (run(0.05, 0, NULL, seen)) return 1;
    for (int k = 0; k < 2; ++k) slope[k] = gradient(c[k], NULL, seen, &push);
    for (int k = 0; k < 20 && fabs(c[1] - c[0]) > 1e-13; ++k) {
        const double next = c[1] - slope[1]*(c[1] - c[0])/(slope[1] - slope[0]);
        c[0] = c[1], slope[0] = slope[1];
        c[1] = next, slope[1] = gradient(next, NULL, seen, &push);
    }
    printf("from where it was seen, the drag comes out as 0.05 to 1e-11:  %s\n", fabs(c[1] - 0.05) < 1e-11 ? "yes" : "no");
    return 0;
}
