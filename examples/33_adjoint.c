/* 33 - What would have to be different? A gradient by stepping back

   A body around a planet, in thin air, was not seen where it should be. Which number is to
   blame, and by how much: the drag, the start, a push on the way? One question about the end,
   and many numbers that it depends on: the derivative of lesson 31 would need a column for
   each. The other way round one run does for all. tools/adjoint.h makes a scene of the body and
   its costate l, starts it at the end from the derivative of the question J, and steps back.
   Then l is dJ/dp at every time: what a push there would have done. The force's derivative by
   the drag times l, summed over the nodes, is dJ/dc, exact for the steps that were made. Every
   fifth state is kept, against friction: it amplifies rounding on the way back.

   prints

     dJ/dc = -1.38446060404
     differences, two more runs, agree to 1e-7:     yes
     what a push at the start would do, likewise:   yes
     from the place it was seen at, drag 0.05:      yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/adjoint.h"
#include <math.h>
#include <stdio.h>

enum { STEPS = 10, DEGREE = 8, EVERY = 5 };
static const double h = 0.2, q0[] = { 1, 0.2 }, p0[] = { -0.1, 1.1 };
static double drag, room[ADJOINT_ROOM(2, DEGREE)], kept[ADJOINT_KEPT(2, STEPS, EVERY)];

GVI_EACH(attraction, 2, f)
{
    const double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*GVI_SQRT(d2));
    x->f[0] += w*X, x->f[1] += w*Y;
}

/* Its derivative times l.  A potential's is symmetric: its own transpose.       */
static int attraction_product(const gvi_points *x, const gvi_points *l, int parameter, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double X = x->q[k], Y = x->q[s+k], a = l->q[k], b = l->q[s+k], d2 = X*X + Y*Y;
        const double w = 1/(d2*sqrt(d2)), along = 3*(X*a + Y*b)/d2;
        l->f[k] += w*(along*X - a), l->f[s+k] += w*(along*Y - b);
    }
    return (void)parameter, (void)user, 0;
}

/* The air: f = -c |v| v.                                                        */
GVI_EACH(air, 2, v, f)
{
    const double u = x->v[0], v = x->v[1], z = drag*GVI_SQRT(u*u + v*v);
    x->f[0] -= z*u, x->f[1] -= z*v;
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

static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = attraction },
                                    { .kind = GVI_FORCE, .points = air } };
static const gvi_desc body = { .n = 2, .degree = DEGREE, .effects = scene, .effect_count = 2 };
static double memory[GVI_LENGTH(2, DEGREE, DEGREE)], back_memory[GVI_LENGTH(4, DEGREE, DEGREE)];

/* The end (q, p) with a drag c and a push along x at the start.  A keeps states. */
static int run(double c, double push, adjoint *A, double *end)
{
    gvi_stepper st;
    drag = c;
    gvi_init(&st, &body, memory, sizeof memory);
    gvi_start_momentum(&st, 0, q0, (double[]){ p0[0] + push, p0[1] });
    for (int k = 0; k <= STEPS && !st.status; ++k) {
        if (k > 0) gvi_step(&st, h);
        if (A) adjoint_keep(A, &st);
    }
    for (int i = 0; i < 2; ++i) end[i] = st.q[i], end[2 + i] = st.p[i];
    return st.status;
}

/* dJ/dc with the drag c, from dJ/d(q, p) at the end; push: dJ/dp_x at the start.  */
static double gradient(double c, const double *J, double *push)
{
    adjoint A = { .plain = body, .product = { attraction_product, air_transposed }, .by_parameters = by_drag,
                  .room = room, .room_length = ADJOINT_ROOM(2, DEGREE),
                  .kept = kept, .kept_length = ADJOINT_KEPT(2, STEPS, EVERY), .every = EVERY };
    double end[4], g = 0, by_q[2] = { 0 }, by_p[2] = { 0 };
    gvi_stepper ad;
    if (adjoint_scene(&A) || gvi_init(&ad, &A.scene.desc, back_memory, sizeof back_memory)) return HUGE_VAL;
    if (run(c, 0, &A, end) || adjoint_start(&A, &ad, STEPS*h, end, end + 2, J, J + 2)) return HUGE_VAL;
    for (int k = 0; k < STEPS && !ad.status; ++k) adjoint_step(&A, &ad, h, &g);
    adjoint_gradient(&A, &ad, by_q, by_p);
    *push = by_p[0];
    return ad.status ? HUGE_VAL : g;
}

/* The derivative by c of |q - seen|^2/2.                                        */
static double miss(double c, const double *seen)
{
    double end[4], unused;
    if (run(c, 0, NULL, end)) return HUGE_VAL;
    return gradient(c, (double[]){ end[0] - seen[0], end[1] - seen[1], 0, 0 }, &unused);
}

int main(void)
{
    const double J[] = { 1, -2, 0.4, 3 }, D = 1e-4;      // J = x - 2 y + 0.4 p_x + 3 p_y
    double more[4], less[4], push, by[2] = { 0, 0 }, seen[4], c[2] = { 0.02, 0.03 };
    const double g = gradient(0.05, J, &push);
    for (int k = 0; k < 2; ++k) {                        // by the drag, by a push
        const double a = k ? 0 : D, b = k ? D : 0;
        if (run(0.05 + a, b, NULL, more) || run(0.05 - a, -b, NULL, less)) return 1;
        for (int i = 0; i < 4; ++i) by[k] += J[i]*(more[i] - less[i])/(2*D);
    }
    printf("dJ/dc = %.11f\n", g);
    printf("differences, two more runs, agree to 1e-7:     %s\n", fabs(by[0] - g) < 1e-7 ? "yes" : "no");
    printf("what a push at the start would do, likewise:   %s\n", fabs(by[1] - push) < 1e-7 ? "yes" : "no");

    // seen at the end of a run with 0.05: by secants, the drag at which the miss has no slope
    if (run(0.05, 0, NULL, seen)) return 1;
    for (double before = miss(c[0], seen); fabs(c[1] - c[0]) > 1e-12; ) {
        const double slope = miss(c[1], seen), step = slope*(c[1] - c[0])/(slope - before);
        before = slope, c[0] = c[1], c[1] -= step;
    }
    printf("from the place it was seen at, drag 0.05:      %s\n", fabs(c[1] - 0.05) < 1e-11 ? "yes" : "no");
    return 0;
}
