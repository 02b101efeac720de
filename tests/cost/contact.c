/* contact.c - what contact costs: where nothing touches, and beside other ways to bounce

   Open: CPU time of gvi_step and of contact_step with one contact that stays away, degree 4 and 8: a planet and a sphere in the
   middle, a double pendulum of two rods and a wall.

   Bounce: lesson 20's ball on a wavy table, elastic, T = 6, by contact.h; by event.h and a mirrored momentum; by a spring of
   stiffness k in place of the table, the step as long as is best for the error at the end.  Reference: contact.h, degree 12,
   3,000 steps; event.h shares none of its search.  CPU time, best of five.

     contact                                                                                               */
#define GVI_STATIC
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/contact.h"
#include "tools/event.h"
#include <math.h>
#include <stdio.h>
#include <time.h>

static double memory[200000];

static double now(void) { return (double)clock()/CLOCKS_PER_SEC; }

/* ---- open ---- */

GVI_EACH(attraction, 2, f)
{
    const double X = x->q[0], Y = x->q[1], d2 = X*X + Y*Y, w = -1/(d2*sqrt(d2));
    x->f[0] += w*X, x->f[1] += w*Y;
}
GVI_EACH(weight, 4, f) { x->f[1] -= 1, x->f[3] -= 1; }
GVI_EACH(rods, 4, rows(2))
{
    const double X = x->q[0], Y = x->q[1], U = x->q[2] - X, V = x->q[3] - Y;
    double *G = x->jacobian;
    x->g[0] = (X*X + Y*Y - 1)/2, x->g[1] = (U*U + V*V - 1)/2;
    G[0] = X, G[1] = Y, G[4] = -U, G[5] = -V, G[6] = U, G[7] = V;
}
static void sphere(int which, double t, const double *q, double *phi, double *G, double *rate, void *user)
{
    const double r = sqrt(q[0]*q[0] + q[1]*q[1]);
    (void)which, (void)t, (void)rate, (void)user;
    *phi = r - 0.1, G[0] = q[0]/r, G[1] = q[1]/r;
}
static void wall(int which, double t, const double *q, double *phi, double *G, double *rate, void *user)
{
    (void)which, (void)t, (void)rate, (void)user;
    *phi = 2.5 - q[2], G[2] = -1;
}

/* Microseconds a step */
static double step_time(int pendulum, int degree, int contacts)
{
    enum { STEPS = 20000 };
    contact c = { .count = 1, .slots = 1, .gap = pendulum ? wall : sphere };
    gvi_effect scene[3] = { { .kind = GVI_POTENTIAL, .points = pendulum ? weight : attraction } };
    if (pendulum) scene[1] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = rods, .rows = 2 };
    contact_rows(&c, scene + 1 + pendulum);
    const gvi_desc desc = { .n = pendulum ? 4 : 2, .degree = degree, .effects = scene, .effect_count = 2 + pendulum };
    static const double q[2][4] = { { 0.4, 0, 0, 0 }, { 0.6, 0.8, 0, 1.6 } }, v[2][4] = { { 0, 2, 0, 0 }, { 0, 0, 0, 0 } };
    double best = 1e9;
    for (int again = 0; again < 5; ++again) {
        gvi_status status = contact_init(&c, &desc, memory, sizeof memory);
        if (!status) status = contact_start(&c, 0, q[pendulum], v[pendulum]);
        const double begin = now();
        for (int k = 0; k < STEPS && !status; ++k) status = contacts ? contact_step(&c, 0.05) : gvi_step(&c.st, 0.05);
        best = fmin(best, (now() - begin)/STEPS*1e6);
        if (status) puts(contact_why(&c, status));
    }
    return best;
}

/* ---- a ball on a wavy table ---- */

static double stiffness;
GVI_EACH(trough, 2, f)
{
    const double X = x->q[0], Y = x->q[1], into = cos(3*X)/10 - Y;
    x->f[0] -= X*(1 + X*X + Y/5), x->f[1] -= 1 + X*X/10;
    if (stiffness > 0 && into > 0) x->f[0] += stiffness*into*0.3*sin(3*X), x->f[1] += stiffness*into;
}
static void table(int which, double t, const double *q, double *phi, double *G, double *rate, void *user)
{
    (void)which, (void)t, (void)rate, (void)user;
    *phi = q[1] - cos(3*q[0])/10, G[0] = 0.3*sin(3*q[0]), G[1] = 1;
}
static double height(double t, const double *q, const double *v, void *user)
{
    return (void)t, (void)v, (void)user, q[1] - cos(3*q[0])/10;
}

typedef enum { BY_CONTACT, BY_EVENT, BY_SPRING } way;

static void bounce(way by, int degree, int steps, double *q)
{
    const double e = 1, T = 6, h = T/steps, q0[] = { 0.3, 1 }, v0[] = { 0.2, 0 };
    contact c = { .count = 1, .slots = 1, .gap = table, .e = &e };
    gvi_effect scene[2] = { { .kind = GVI_POTENTIAL, .points = trough } };
    contact_rows(&c, scene + 1);
    const gvi_desc desc = { .n = 2, .degree = degree, .effects = scene, .effect_count = 1 + (by == BY_CONTACT) };
    gvi_stepper st, *const last = by == BY_CONTACT ? &c.st : &st;
    double p[2], v[2];
    gvi_status status;
    if (by == BY_CONTACT) {
        status = contact_init(&c, &desc, memory, sizeof memory);
        if (!status) status = contact_start(&c, 0, q0, v0);
    } else {
        status = gvi_init(&st, &desc, memory, sizeof memory);
        if (!status) status = gvi_start(&st, 0, q0, v0);
    }
    event found = { .g = height, .q = q, .v = v, .p = p };
    for (int k = 0; k < steps && !status; ++k) {
        if (by == BY_CONTACT) { status = contact_step(&c, h); continue; }
        for (double end = h*(k + 1); !status && st.t < end - 1e-12; ) {
            status = gvi_step(&st, end - st.t);
            if (status || by == BY_SPRING || event_next(&found, &st) <= 0 || found.rising) continue;
            const double a = 0.3*sin(3*q[0]), z = 2*(a*p[0] + p[1])/(a*a + 1);
            p[0] -= a*z, p[1] -= z;
            status = gvi_start_momentum(&st, found.t, q, p);
        }
    }
    if (status) puts(gvi_why(last));
    q[0] = last->q[0], q[1] = last->q[1];
}

static void compare(const char *name, way by, int degree, int steps, const double *exact)
{
    double q[2], best = 1e9;
    for (int again = 0; again < 5; ++again) {
        const double begin = now();
        bounce(by, degree, steps, q);
        best = fmin(best, now() - begin);
    }
    printf("  %-24s degree %2d, %7d steps: off by %.1e, %8.1f us\n", name, degree, steps,
           hypot(q[0] - exact[0], q[1] - exact[1]), best*1e6);
}

int main(void)
{
    static const char *const names[] = { "planet and sphere", "two rods and a wall" };
    for (int pendulum = 0; pendulum < 2; ++pendulum)
        for (int degree = 4; degree <= 8; degree += 4) {
            const double alone = step_time(pendulum, degree, 0), with = step_time(pendulum, degree, 1);
            printf("  %-20s degree %d: a step %5.2f us, with a contact that is open %5.2f us, %.2f times\n",
                   names[pendulum], degree, alone, with, with/alone);
        }
    double exact[2];
    bounce(BY_CONTACT, 12, 3000, exact);
    compare("contact.h", BY_CONTACT, 4, 60, exact);
    compare("contact.h", BY_CONTACT, 8, 60, exact);
    compare("event.h", BY_EVENT, 4, 60, exact);
    compare("event.h", BY_EVENT, 8, 60, exact);
    for (int k = 4; k <= 8; k += 2) {
        char name[40];
        stiffness = pow(10, k);
        snprintf(name, sizeof name, "spring, k = 1e%d", k);
        for (int steps = 600; steps <= 600000; steps *= 10) compare(name, BY_SPRING, 2, steps, exact);
    }
    return 0;
}
