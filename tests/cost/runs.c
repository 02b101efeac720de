/* runs.c - what a step costs in fixed runs of all kinds, by the public interface alone

     runs [MS]        each run for about MS milliseconds of CPU time, 20 without, but three times at least
     runs MS NAME     that run alone
     runs --compiler  which one made this program, for which machine
     runs --counts    the runs that have a short name: that, steps, points evaluated, iterations
     runs --ends      the same, and where they end
     runs --count NAME  one of them, under callgrind: what is collected is run_steps

   Timed, so that two headers can be compared (tests/tools/compare.sh): name|ns a step, the least|iterations a step|
   sum of |q| at the end, or name|FAILED|why.  Every pass of a run begins with gvi_init and takes the same steps:
   the sum does not depend on MS.  The forces are written as users write them: some go to count, some to stride.
   Counted, by tests/tools/instructions.sh: sines.h has the sines of M(q), and of libm there are square roots alone,
   so with -ffp-contract=off points and iterations are the same on every machine, with every compiler.   */
#define _POSIX_C_SOURCE 200809L
#include "gvi.h"
#include "coefficients.h"
#include "sines.h"
#include "solar.h"

typedef double real;
#include "../problems.h"
static double omega = 50;

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define COUNT(a) ((int)(sizeof(a)/sizeof(a)[0]))
enum { MOST = 100, LINKS = 3, SIDE = 4, KNOTS = SIDE*SIDE, NET = 3*KNOTS };

/* --------------------------------------------------------------- scenes */

/* Attraction of problems.h, a point a call */
static int attraction_at(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    const double d2 = q[0]*q[0] + q[1]*q[1], w = -1/(d2*sqrt(d2));
    f[0] += w*q[0];
    f[1] += w*q[1];
    return 0;
}

/* And in space */
static int sun(const gvi_points *x, void *user)
{
    const int R = x->stride;
    const double *q = x->q;
    double *f = x->f;
    for (int k = 0; k < R; ++k) {
        const double d2 = q[k]*q[k] + q[R + k]*q[R + k] + q[2*R + k]*q[2*R + k], w = -1/(d2*sqrt(d2));
        f[k] += w*q[k];
        f[R + k] += w*q[R + k];
        f[2*R + k] += w*q[2*R + k];
    }
    return 0;
}

/* g = |q|^(3/2) */
static int clock_of_distance(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double X = x->q[k], Y = x->q[R + k], d = sqrt(X*X + Y*Y), s = sqrt(d);
        if (x->value) x->value[k] += d*s;
        if (x->f) {
            x->f[k] += 1.5*s*X/d;
            x->f[R + k] += 1.5*s*Y/d;
        }
    }
    return 0;
}

static int henon_heiles(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < R; ++k) {
        const double a = x->q[k], b = x->q[R + k];
        x->f[k] -= a + 2*a*b;
        x->f[R + k] -= b + a*a - b*b;
    }
    return 0;
}

/* All pairs, and for each of them all points */
static int gravitation(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int i = 1; i < 6; ++i)
        for (int j = 0; j < i; ++j) {
            const double *a = x->q + 3*i*R, *b = x->q + 3*j*R, g = solar_mass[3*i]*solar_mass[3*j];
            double *f = x->f + 3*i*R, *e = x->f + 3*j*R;
            for (int k = 0; k < R; ++k) {
                const double X = a[k] - b[k], Y = a[R + k] - b[R + k], Z = a[2*R + k] - b[2*R + k];
                const double d2 = X*X + Y*Y + Z*Z, w = -g/(d2*sqrt(d2));
                f[k] += w*X;  f[R + k] += w*Y;  f[2*R + k] += w*Z;
                e[k] -= w*X;  e[R + k] -= w*Y;  e[2*R + k] -= w*Z;
            }
        }
    return 0;
}

/* All points, and for each of them all pairs: no compiler makes vectors of it */
static int gravitation_plainly(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k)
        for (int i = 1; i < 6; ++i)
            for (int j = 0; j < i; ++j) {
                double d[3], d2 = 0;
                for (int l = 0; l < 3; ++l) {
                    d[l] = x->q[(3*i + l)*R + k] - x->q[(3*j + l)*R + k];
                    d2 += d[l]*d[l];
                }
                const double w = -solar_mass[3*i]*solar_mass[3*j]/(d2*sqrt(d2));
                for (int l = 0; l < 3; ++l) {
                    x->f[(3*i + l)*R + k] += w*d[l];
                    x->f[(3*j + l)*R + k] -= w*d[l];
                }
            }
    return 0;
}

/* Springs d + 0.3 d^3 in a row between two walls */
static int chain(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < R; ++k) {
            const double a = i > 0 ? x->q[(i - 1)*R + k] : 0, b = i < n ? x->q[i*R + k] : 0;
            const double d = b - a, f = d + 0.3*d*d*d;
            if (i > 0) x->f[(i - 1)*R + k] += f;
            if (i < n) x->f[i*R + k] -= f;
        }
    return 0;
}

/* Soft and stiff ones in turn, with second derivatives */
static int springs(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int i = 0; i <= n; ++i)
        for (int k = 0; k < R; ++k) {
            const double a = i > 0 ? x->q[(i - 1)*R + k] : 0, b = i < n ? x->q[i*R + k] : 0;
            const double d = b - a, f = i % 2 ? d + d*d*d : 2500*d;
            if (i > 0) x->f[(i - 1)*R + k] += f;
            if (i < n) x->f[i*R + k] -= f;
        }
    return 0;
}

static int springs_hessian(double t, const double *q, const double *v, double *fq, double *fv, double *pv, void *user)
{
    const int n = *(const int *)user;
    for (int i = 0; i <= n; ++i) {
        const double a = i > 0 ? q[i - 1] : 0, b = i < n ? q[i] : 0, d = b - a, k = i % 2 ? 1 + 3*d*d : 2500;
        if (i > 0) fq[(i - 1)*n + i - 1] -= k;
        if (i < n) fq[i*n + i] -= k;
        if (i > 0 && i < n) {
            fq[(i - 1)*n + i] += k;
            fq[i*n + i - 1] += k;
        }
    }
    return 0;
}

INLINE double sine_of(double x) { double s, c; sine_and_cosine(x, &s, &c); return s; }
INLINE double cosine_of(double x) { double s, c; sine_and_cosine(x, &s, &c); return c; }

/* A pendulum of n links of length 1, of mass 1 at the end of each, absolute angles:
   M_ij = (n - j) cos(q_i - q_j), i <= j                                              */
static int links_mass(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < R; ++k)
                x->mass[(i*n + j)*R + k] = i == j ? n - i : (n - i)*cosine_of(x->q[i*R + k] - x->q[j*R + k]);
    return 0;
}
static int links_gradient(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < R; ++k) {
                const double s = (n - i)*sine_of(x->q[i*R + k] - x->q[j*R + k])*x->v[i*R + k]*x->v[j*R + k];
                x->f[i*R + k] -= s;
                x->f[j*R + k] += s;
            }
    return 0;
}
static int links_weight(const gvi_points *x, void *user)
{
    const int R = x->stride, n = x->n;
    for (int i = 0; i < n; ++i)
        for (int k = 0; k < R; ++k) x->f[i*R + k] -= (n - i)*9.8*sine_of(x->q[i*R + k]);
    return 0;
}

/* Two links: M = (2, c; c, 1) */
static int links_velocity(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double c = cosine_of(x->q[k] - x->q[R + k]), p = x->p[k], o = x->p[R + k], over = 1/(2 - c*c);
        x->velocity[k] = (p - c*o)*over;
        x->velocity[R + k] = (2*o - c*p)*over;
    }
    return 0;
}

static int pendulum_at(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    f[0] -= sin(q[0]);
    return 0;
}
static int driven_at(double t, const double *q, const double *v, double *f, double *dldv, void *user)
{
    f[0] += -0.1*v[0] + 0.5*cos(0.7*t);
    return 0;
}

/* f = -c m v, c that of a medium that hardly brakes */
static int drag(const gvi_points *x, void *user)
{
    const double *c = user;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= c[i]*x->v[i*x->stride + k];
    return 0;
}

/* L = v'A, A = (-y, x)/2: the plane's field */
static int field_in_plane(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < R; ++k) {
        const double X = x->q[k], Y = x->q[R + k], vx = x->v[k], vy = x->v[R + k];
        if (x->f) {
            x->f[k] += vy/2;
            x->f[R + k] -= vx/2;
        }
        if (x->dldv) {
            x->dldv[k] -= Y/2;
            x->dldv[R + k] += X/2;
        }
    }
    return 0;
}

/* A = (1 + z/2)(-y, x, 0)/2 in space, and a trap that holds */
static int field_in_space(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double X = x->q[k], Y = x->q[R + k], Z = x->q[2*R + k], vx = x->v[k], vy = x->v[R + k], b = 0.5 + Z/4;
        if (x->f) {
            x->f[k] += b*vy;
            x->f[R + k] -= b*vx;
            x->f[2*R + k] += (X*vy - Y*vx)/4;
        }
        if (x->dldv) {
            x->dldv[k] -= b*Y;
            x->dldv[R + k] += b*X;
        }
    }
    return 0;
}
static int trap(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < R; ++k) x->f[i*R + k] -= x->q[i*R + k];
    return 0;
}

/* L = -sqrt(1 - v'v), and v from p */
static int relativity(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count && x->dldv; ++k) {
        const double vx = x->v[k], vy = x->v[R + k], w = 1/sqrt(1 - vx*vx - vy*vy);
        x->dldv[k] += w*vx;
        x->dldv[R + k] += w*vy;
    }
    return 0;
}
static int relativity_velocity(const gvi_points *x, void *user)
{
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const double px = x->p[k], py = x->p[R + k], w = 1/sqrt(1 + px*px + py*py);
        x->velocity[k] = w*px;
        x->velocity[R + k] = w*py;
    }
    return 0;
}

/* A net of 16 knots, its weight, and drag: listed last, or not, or not in the program (-DNO_DRAG)  */
static void thread(const gvi_points *x, int a, int b)
{
    const int d = x->stride;
    const double *p = x->q + 3*a*d, *q = x->q + 3*b*d;
    double *f = x->f + 3*a*d, *g = x->f + 3*b*d;
    for (int k = 0; k < x->count; ++k) {
        const double u = q[k] - p[k], v = q[d+k] - p[d+k], w = q[2*d+k] - p[2*d+k];
        const double s = 40*(1 - 0.09/sqrt(u*u + v*v + w*w));
        f[k] += s*u;  f[d+k] += s*v;  f[2*d+k] += s*w;
        g[k] -= s*u;  g[d+k] -= s*v;  g[2*d+k] -= s*w;
    }
}

static int threads(const gvi_points *x, void *user)
{
    for (int i = 0; i < KNOTS; ++i) {
        if (i % SIDE < SIDE - 1) thread(x, i, i + 1);
        if (i/SIDE < SIDE - 1) thread(x, i, i + SIDE);
    }
    return 0;
}

static int net_weight(const gvi_points *x, void *user)
{
    for (int i = 0; i < KNOTS; ++i)
        for (int k = 0; k < x->count; ++k) x->f[(3*i+2)*x->stride + k] -= 9.81*0.005;
    return 0;
}

#ifndef NO_DRAG
static int net_drag(const gvi_points *x, void *user)
{
    for (int i = 0; i < NET; ++i)
        for (int k = 0; k < x->count; ++k) x->f[i*x->stride + k] -= 0.01*x->v[i*x->stride + k];
    return 0;
}
#endif

static const gvi_effect net_scene[] = { { .kind = GVI_POTENTIAL, .points = threads },
                                        { .kind = GVI_POTENTIAL, .points = net_weight },
#ifndef NO_DRAG
                                        { .kind = GVI_FORCE, .points = net_drag },
#endif
};
static double net_mass[NET], net_q[NET], net_v[NET];

static const double air[2] = { 0.001, 0.001 };
static double dust[18];                                   // 1e-9 of solar_mass
static int spring_count = 20;

static const gvi_effect kepler_scene[] = { { .kind = GVI_POTENTIAL, .points = attraction } };
static const gvi_effect kepler_at_scene[] = { { .kind = GVI_POTENTIAL, .point = attraction_at } };
static const gvi_effect space_scene[] = { { .kind = GVI_POTENTIAL, .points = sun } };
static const gvi_effect clock_scene[] = {
    { .kind = GVI_POTENTIAL, .points = attraction, .value = attraction },
    { .kind = GVI_CLOCK, .points = clock_of_distance } };
static const gvi_effect air_scene[] = {
    { .kind = GVI_POTENTIAL, .points = attraction }, { .kind = GVI_FORCE, .points = drag, .user = (void *)air } };
static const gvi_effect henon_scene[] = { { .kind = GVI_POTENTIAL, .points = henon_heiles } };
static const gvi_effect solar_scene[] = { { .kind = GVI_POTENTIAL, .points = gravitation } };
static const gvi_effect plain_scene[] = { { .kind = GVI_POTENTIAL, .points = gravitation_plainly } };
static const gvi_effect dust_scene[] = {
    { .kind = GVI_POTENTIAL, .points = gravitation }, { .kind = GVI_FORCE, .points = drag, .user = dust } };
static const gvi_effect chain_scene[] = { { .kind = GVI_POTENTIAL, .points = chain } };
static const gvi_effect springs_scene[] = {
    { .kind = GVI_POTENTIAL, .points = springs, .hessian = springs_hessian, .user = &spring_count } };
static const gvi_effect fpu_scene[] = { { .kind = GVI_POTENTIAL, .points = fermi_pasta_ulam_forces, .user = &omega } };
static const gvi_effect links_scene[] = { { .kind = GVI_POTENTIAL, .points = links_weight } };
static const gvi_effect driven_scene[] = {
    { .kind = GVI_POTENTIAL, .point = pendulum_at }, { .kind = GVI_FORCE, .point = driven_at } };
static const gvi_effect field_scene[] = {
    { .kind = GVI_POTENTIAL, .points = henon_heiles }, { .kind = GVI_LAGRANGIAN, .points = field_in_plane } };
static const gvi_effect trap_scene[] = {
    { .kind = GVI_POTENTIAL, .points = trap }, { .kind = GVI_LAGRANGIAN, .points = field_in_space } };
static const gvi_effect fast_scene[] = {
    { .kind = GVI_POTENTIAL, .points = trap }, { .kind = GVI_LAGRANGIAN, .points = relativity } };

static const double kepler_q[2] = { 0.4, 0 }, kepler_v[2] = { 0, 2 };
static const double space_q[3] = { 1, 0, 0 }, space_v[3] = { 0, 0.8, 0.5 };
static const double far_q[2] = { 1.9, 0 }, far_v[2] = { 0, 0.22941573387056177 };    // eccentricity 0.9
static const double henon_q[2] = { 0.1, -0.2 }, henon_v[2] = { 0.3, 0.25 };
static const double links_q[3] = { 1.1, -0.7, 0.3 }, rest[3] = { 0, 0, 0 };
static const double one[1] = { 1 }, field_q[2] = { 0.1, 0 }, field_v[2] = { 0, 0.2 };
static const double trap_q[3] = { 0.5, 0, 0.3 }, trap_v[3] = { 0, 0.6, 0.2 };
static const double fast_q[2] = { 1, 0 }, fast_v[2] = { 0, 0.5 };
static const double fpu_q[6] = { 1, 0, 0, 0.02, 0, 0 }, fpu_v[6] = { 1, 0, 0, 1, 0, 0 };
static double chain_q[MOST], chain_v[MOST], springs_q[20], springs_v[20];
static double dense[36];

/* Yoshida's triple jump of Stoermer-Verlet; the splitting of order 8 of coefficients.h; rules */
#define GAMMA 1.3512071919596576
static const double jump_at[] = { 0, GAMMA, 1 - GAMMA, 1 };
static const double jump_by[] = { GAMMA/2, (1 - GAMMA)/2, (1 - GAMMA)/2, GAMMA/2 };
enum { HALF = COUNT(splitting8_b), EIGHT = 2*HALF + 1 };
static double eight_at[EIGHT], eight_by[EIGHT];
#define ROOT 0.70710678118654752
static const double cc_at[] = { 0, (1 - ROOT)/2, 0.5, (1 + ROOT)/2, 1 };     // Clenshaw, Curtis
static const double cc_by[] = { 1/30.0, 4/15.0, 0.4, 4/15.0, 1/30.0 };
static const double maclaurin_at[] = { 1/6.0, 0.5, 5/6.0 }, maclaurin_by[] = { 0.375, 0.25, 0.375 };

static void fill(void)
{
    double at = 0, sum = 0;
    for (int i = 0; i < MOST; ++i) {
        chain_q[i] = sin(3.14159265*(i + 1)/101);
        chain_v[i] = 0.1*cos(i);
    }
    for (int i = 0; i < 20; ++i) {
        springs_q[i] = i % 2 ? springs_q[i - 1] + 0.006 : 0.5*sin(0.7*i);    // stiff springs hardly stretched
        springs_v[i] = 0.5*cos(1.3*i);
    }
    for (int i = 0; i < NET; ++i) {
        net_mass[i] = 0.005;
        net_q[i] = i % 3 == 2 ? 0.02*(i % 7) : 0.1*(i % 3 ? i/3/SIDE : i/3 % SIDE);
    }
    for (int i = 0; i < 18; ++i) dust[i] = 1e-9*solar_mass[i];
    for (int i = 0; i < 6; ++i)
        for (int j = 0; j < 6; ++j) dense[i*6 + j] = i == j ? 3 : 1.0/(1 + abs(i - j));
    for (int j = 0; j < HALF; ++j) {
        eight_at[j] = at;
        eight_at[EIGHT - 1 - j] = 1 - at;
        sum += eight_by[j] = eight_by[EIGHT - 1 - j] = (double)splitting8_b[j];
        if (j < HALF - 1) at += (double)splitting8_a[j];
    }
    eight_at[HALF] = 0.5;
    eight_by[HALF] = 1 - 2*sum;
}

/* ----------------------------------------------------------------- runs */

typedef struct run run;
typedef void take(gvi_stepper *st, const run *a);
struct run {
    const char   *name;
    gvi_desc      desc;
    const double *q, *v;
    double        h;
    int           steps;
    take         *take;                 // NULL: run_steps
    const char   *counted;              // its short name, or NULL
};

static double memory[1 << 20];

static void begin(gvi_stepper *st, const run *a)
{
    gvi_init(st, &a->desc, memory, sizeof memory);
    gvi_start(st, 0, a->q, a->v);
}

/* What callgrind collects: a function of its own */
void run_steps(gvi_stepper *st, const run *a);
void run_steps(gvi_stepper *st, const run *a)
{
    for (int k = 0; k < a->steps && st->status == GVI_OK; ++k) gvi_step(st, a->h);
}
static take *volatile steps_of = run_steps;

static void take_all_lengths(gvi_stepper *st, const run *a)
{
    for (int k = 0; k < a->steps && st->status == GVI_OK; ++k) gvi_step(st, a->h*(1 + 0.01*(k % 7)));
}
static void take_and_ask_state(gvi_stepper *st, const run *a)
{
    double q[MOST], v[MOST];
    for (int k = 0; k < a->steps && st->status == GVI_OK; ++k) {
        gvi_step(st, a->h);
        gvi_state_at(st, st->t - 0.375*a->h, q, v, NULL);
    }
}
static void take_and_ask_curve(gvi_stepper *st, const run *a)
{
    double q[MOST], v[MOST];
    for (int k = 0; k < a->steps && st->status == GVI_OK; ++k) {
        gvi_step(st, a->h);
        for (int i = 0; i < 4; ++i) gvi_curve(st, 0.25*i, q, v);
    }
}
static void take_with_third_off(gvi_stepper *st, const run *a)
{
    gvi_switch(st, 2, 0);
    steps_of(st, a);
}
static void take_anew(gvi_stepper *st, const run *a)
{
    for (int k = 0; k < a->steps && st->status == GVI_OK; ++k) {
        begin(st, a);
        gvi_step(st, a->h);
    }
}

#define SCENE(s) .effects = s, .effect_count = COUNT(s)
#define KICKS(at, by) { GVI_KICKS, COUNT(at), at, by }
#define SUNS { .kind = GVI_MASS_DIAGONAL, .matrix = solar_mass }
#define LINK_MASS { .kind = GVI_MASS_POSITION, .points = links_mass, .gradient = links_gradient }

static const run runs[] = {
    { "Kepler s8", { .n = 2, .degree = 8, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.1, 4000, NULL, "kepler" },
    { "Kepler s16", { .n = 2, .degree = 16, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.35, 2000, NULL },
    { "Kepler s4", { .n = 2, .degree = 4, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.05, 4000, NULL },
    { "Kepler s2", { .n = 2, .degree = 2, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.02, 5000, NULL },
    { "Kepler s1", { .n = 2, .degree = 1, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.01, 8000, NULL },
    { "Kepler Lobatto s4", { .n = 2, .degree = 4, SCENE(kepler_scene), .rule = { .kind = GVI_LOBATTO } },
      kepler_q, kepler_v, 0.05, 4000, NULL },
    { "Kepler own rule s3", { .n = 2, .degree = 3, SCENE(kepler_scene), .rule = { GVI_OWN, COUNT(cc_at), cc_at, cc_by } },
      kepler_q, kepler_v, 0.03, 4000, NULL },
    { "Kepler s8 tol 1e-9", { .n = 2, .degree = 8, SCENE(kepler_scene), .tolerance = 1e-9 },
      kepler_q, kepler_v, 0.1, 4000, NULL, "tolerance" },
    { "Kepler s8 tol 1e-8", { .n = 2, .degree = 8, SCENE(kepler_scene), .tolerance = 1e-8 },
      kepler_q, kepler_v, 0.1, 4000, NULL },
    { "Kepler s8 6 rounds", { .n = 2, .degree = 8, SCENE(kepler_scene), .iterations = 6 },
      kepler_q, kepler_v, 0.05, 4000, NULL },
    { "Kepler s8 .point", { .n = 2, .degree = 8, SCENE(kepler_at_scene) }, kepler_q, kepler_v, 0.1, 3000, NULL },
    { "Kepler s8 h varies", { .n = 2, .degree = 8, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.1, 1000, take_all_lengths },
    { "Kepler s8 state_at", { .n = 2, .degree = 8, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.1, 500, take_and_ask_state },
    { "Kepler s8 curve", { .n = 2, .degree = 8, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.1, 3000, take_and_ask_curve },
    { "Kepler s8 gvi_init", { .n = 2, .degree = 8, SCENE(kepler_scene) }, kepler_q, kepler_v, 0.1, 30, take_anew },
    { "Kepler clock s8", { .n = 2, .degree = 8, SCENE(clock_scene) }, far_q, far_v, 0.1, 1000, NULL, "clock" },
    { "Kepler drag s8", { .n = 2, .degree = 8, SCENE(air_scene) }, kepler_q, kepler_v, 0.1, 2000, NULL },
    { "Kepler Verlet", { .n = 2, .degree = 1, SCENE(kepler_scene), .rule = { .kind = GVI_LOBATTO } },
      kepler_q, kepler_v, 0.005, 40000, NULL },
    { "Kepler kicks", { .n = 2, .degree = 1, SCENE(kepler_scene), .rule = KICKS(jump_at, jump_by) },
      kepler_q, kepler_v, 0.02, 20000, NULL, "kicks" },
    { "space n3 s8", { .n = 3, .degree = 8, SCENE(space_scene) }, space_q, space_v, 0.2, 2000, NULL, "space" },
    { "Henon-Heiles s4", { .n = 2, .degree = 4, SCENE(henon_scene) }, henon_q, henon_v, 0.2, 5000, NULL },
    { "Henon-Heiles s8", { .n = 2, .degree = 8, SCENE(henon_scene) }, henon_q, henon_v, 0.5, 3000, NULL },
    { "Henon-Heiles s16", { .n = 2, .degree = 16, SCENE(henon_scene) }, henon_q, henon_v, 1.5, 1000, NULL },
    { "planets s4", { .n = 18, .degree = 4, SCENE(solar_scene), .mass = SUNS }, solar_q, solar_v, 60, 1000, NULL },
    { "planets s6", { .n = 18, .degree = 6, SCENE(solar_scene), .mass = SUNS }, solar_q, solar_v, 100, 800, NULL },
    { "planets s8", { .n = 18, .degree = 8, SCENE(solar_scene), .mass = SUNS }, solar_q, solar_v, 200, 600, NULL, "solar" },
    { "planets s16", { .n = 18, .degree = 16, SCENE(solar_scene), .mass = SUNS }, solar_q, solar_v, 500, 200, NULL },
    { "planets s8 tol 1e-9", { .n = 18, .degree = 8, SCENE(solar_scene), .mass = SUNS, .tolerance = 1e-9 },
      solar_q, solar_v, 200, 600, NULL },
    { "planets s8 tol 1e-8", { .n = 18, .degree = 8, SCENE(solar_scene), .mass = SUNS, .tolerance = 1e-8 },
      solar_q, solar_v, 200, 600, NULL },
    { "planets s8 plainly", { .n = 18, .degree = 8, SCENE(plain_scene), .mass = SUNS }, solar_q, solar_v, 200, 300, NULL },
    { "planets drag s6", { .n = 18, .degree = 6, SCENE(dust_scene), .mass = SUNS }, solar_q, solar_v, 100, 500, NULL },
    { "planets split 8", { .n = 18, .degree = 1, SCENE(solar_scene), .mass = SUNS, .rule = KICKS(eight_at, eight_by) },
      solar_q, solar_v, 300, 500, NULL },
    { "planets split 8 tol", { .n = 18, .degree = 1, SCENE(solar_scene), .mass = SUNS, .tolerance = 1e-6,
      .rule = KICKS(eight_at, eight_by) }, solar_q, solar_v, 300, 500, NULL },
    { "chain n32 s2", { .n = 32, .degree = 2, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.1, 1000, NULL },
    { "chain n32 s3", { .n = 32, .degree = 3, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.15, 700, NULL },
    { "chain n32 s4", { .n = 32, .degree = 4, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.2, 700, NULL },
    { "chain n100 s2", { .n = 100, .degree = 2, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.1, 400, NULL },
    { "chain n100 s3", { .n = 100, .degree = 3, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.15, 250, NULL },
    { "chain n100 s4", { .n = 100, .degree = 4, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.2, 200, NULL },
    { "chain n100 s8", { .n = 100, .degree = 8, SCENE(chain_scene), .formulation = GVI_POSITIONS }, chain_q, chain_v, 0.5, 100, NULL },
    { "chain n100 kicks", { .n = 100, .degree = 1, SCENE(chain_scene), .rule = KICKS(jump_at, jump_by) },
      chain_q, chain_v, 0.1, 1000, NULL },
    { "chain n100 Verlet", { .n = 100, .degree = 1, SCENE(chain_scene), .rule = { .kind = GVI_LOBATTO } },
      chain_q, chain_v, 0.02, 3000, NULL },
    { "dense mass n6 s6", { .n = 6, .degree = 6, SCENE(chain_scene), .mass = { .kind = GVI_MASS_DENSE, .matrix = dense } },
      chain_q, chain_v, 0.4, 1500, NULL },
    { "M(q) n2 s4", { .n = 2, .degree = 4, SCENE(links_scene), .mass = LINK_MASS }, links_q, rest, 0.01, 2000, NULL },
    { "M(q) n2 s8", { .n = 2, .degree = 8, SCENE(links_scene), .mass = LINK_MASS }, links_q, rest, 0.02, 1500, NULL, "links" },
    { "M(q) n2 s6 v of p", { .n = 2, .degree = 6, SCENE(links_scene), .formulation = GVI_MOMENTA,
      .mass = { .kind = GVI_MASS_POSITION, .points = links_mass, .gradient = links_gradient,
                .velocity = links_velocity } }, links_q, rest, 1/128.0, 2000, NULL, "pendulum" },
    { "M(q) n2 s16", { .n = 2, .degree = 16, SCENE(links_scene), .mass = LINK_MASS }, links_q, rest, 0.05, 700, NULL },
    { "M(q) n2 own rule s3", { .n = 2, .degree = 3, SCENE(links_scene), .mass = LINK_MASS,
      .rule = { GVI_OWN, COUNT(maclaurin_at), maclaurin_at, maclaurin_by } }, links_q, rest, 0.01, 2000, NULL },
    { "M(q) n3 s8", { .n = LINKS, .degree = 8, SCENE(links_scene), .mass = LINK_MASS }, links_q, rest, 0.02, 800, NULL },
    { "M(q) n2 Newton s4", { .n = 2, .degree = 4, SCENE(links_scene), .mass = LINK_MASS, .formulation = GVI_NEWTON },
      links_q, rest, 0.02, 300, NULL },
    { "driven n1 s8 .point", { .n = 1, .degree = 8, SCENE(driven_scene) }, one, rest, 0.1, 2000, NULL },
    { "magnetic n2 s8", { .n = 2, .degree = 8, SCENE(field_scene) }, field_q, field_v, 0.2, 1000, NULL },
    { "magnetic n3 s6", { .n = 3, .degree = 6, SCENE(trap_scene) }, trap_q, trap_v, 0.2, 1000, NULL },
    { "relativity s6", { .n = 2, .degree = 6, SCENE(fast_scene), .mass = { .kind = GVI_MASS_NONE } },
      fast_q, fast_v, 0.2, 200, NULL },
    { "relativity s6 v of p", { .n = 2, .degree = 6, SCENE(fast_scene),
      .mass = { .kind = GVI_MASS_NONE, .velocity = relativity_velocity } }, fast_q, fast_v, 0.2, 1000, NULL },
    { "FPU s8", { .n = 6, .degree = 8, SCENE(fpu_scene), .formulation = GVI_POSITIONS }, fpu_q, fpu_v, 0.05, 1000, NULL, "springs" },
    { "stiff FPU s8", { .n = 6, .degree = 8, SCENE(fpu_scene) }, fpu_q, fpu_v, 0.1, 150, NULL },
    { "springs Newton s4", { .n = 20, .degree = 4, SCENE(springs_scene), .formulation = GVI_NEWTON },
      springs_q, springs_v, 0.04, 100, NULL },
#define A_NET(count) { .n = NET, .degree = 6, .effects = net_scene, .effect_count = count, \
                       .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = net_mass } }, net_q, net_v, 0.005, 100
    { "net", A_NET(2), NULL, "net" },
#ifndef NO_DRAG
    { "net, drag off", A_NET(3), take_with_third_off, "net-off" },
    { "net, drag", A_NET(3), NULL, "net-drag" },
#endif
};

static double nanoseconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e9 + (double)t.tv_nsec;
}

static int perform(const run *a, double budget)
{
    gvi_stepper st;
    double best = 0, spent = 0, size = 0;
    for (int pass = 0; pass < 3 || spent < budget; ++pass) {
        begin(&st, a);
        const double from = nanoseconds();
        (a->take ? a->take : steps_of)(&st, a);
        const double time = nanoseconds() - from;
        if (st.status != GVI_OK) return printf("%s|FAILED|%s\n", a->name, gvi_why(&st)), 1;
        if (pass == 0 || time < best) best = time;
        spent += time;
    }
    for (int i = 0; i < st.n; ++i) size += fabs(st.q[i]);
    printf("%s|%.1f|%.3f|%.15g\n", a->name, best/a->steps,
           (double)(st.counters.iterations + st.counters.newton_iterations)/(double)st.counters.steps, size);
    fflush(stdout);
    return 0;
}

static int count(const run *a, int counts, int ends)
{
    gvi_stepper st;
    begin(&st, a);
    (a->take ? a->take : steps_of)(&st, a);
    if (st.status != GVI_OK) return fprintf(stderr, "%s: %s\n", a->counted, gvi_why(&st)), 1;
    if (counts) printf("%s %llu %llu %llu\n", a->counted, st.counters.steps, st.counters.effect[0],
                       st.counters.iterations + st.counters.newton_iterations);
    if (ends) printf("%s ends at %a\n", a->counted, st.q[st.n - 1]);
    return 0;
}

static int say_compiler(void)
{
#if defined(__clang__)
    const char *name = "clang";
#elif defined(__GNUC__)
    const char *name = "gcc";
#else
    const char *name = "unknown";
#endif
#if defined(__VERSION__)
    const char *version = __VERSION__;
#else
    const char *version = "?";
#endif
#if defined(__x86_64__)
    const char *machine = "x86-64";
#elif defined(__aarch64__)
    const char *machine = "aarch64";
#else
    const char *machine = "other";
#endif
    return printf("%s %s %s\n", name, version, machine) < 0;
}

int main(int argc, char **argv)
{
    const char *mode = argc > 1 ? argv[1] : "20";
    int failed = 0, seen = 0;
    fill();
    if (!strcmp(mode, "--compiler")) return say_compiler();
    for (int i = 0; i < COUNT(runs); ++i) {
        const run *a = runs + i;
        if (argc > 2 && strcmp(argv[2], mode[0] == '-' && a->counted ? a->counted : a->name)) continue;
        if (mode[0] != '-') failed |= perform(a, 1e6*atof(mode));
        else if (a->counted) failed |= count(a, strcmp(mode, "--count"), !strcmp(mode, "--ends"));
        ++seen;
    }
    return failed || !seen;
}
