/* ncdp.c - round-off over half a million steps, and its price, against the published standard

     ncdp [--quick]          2^19 steps; quick: a sixteenth of them

   The non-chaotic double pendulum of Antonana, Makazaga, Murua: Reducing and monitoring round-off
   error propagation for symplectic implicit Runge-Kutta schemes, Numer. Algorithms 76, 2017 [A].
   Second angle relative to the first, m = l = 1, g = 9.8, Gauss with 6 stages, h = 2^-7:
     H = (p1^2 - 2 (1 + cos q2) p1 p2 + (3 + 2 cos q2) p2^2)/(2 (1 + sin^2 q2))
         - 2 g cos q1 - g cos(q1 + q2)

   In one run, the fixed-point algorithm of [A], written from its formulas, and gvi.h in the formulation
   by momenta.  [A] in three forms: iterations that begin with y0, as the authors' own example does (8.58 a
   step there); with the last step's curve continued, their other choice; and that with n and s known to the
   compiler, which no library can have.  The formulas of the right-hand side are the same for all, and all
   have the sine of sines.h, which vectorises.

   Energy: in long double from q and p at every step, in a run that is not timed.  Its error is a
   random walk; noise: what a step adds, root mean square, from its change over 2^13 steps.  The
   maximum over N steps is then 1.25 noise sqrt(N), more or less by a third.  CPU time: best of 3. */
#define _POSIX_C_SOURCE 200809L
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "../gauss.h"
#include "sines.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#if defined(__GNUC__) && !defined(__clang__)
#define INDEPENDENT _Pragma("GCC ivdep")
#else
#define INDEPENDENT
#endif

#define G 9.8
enum { S = 6, N = 4 };                                  /* stages; (q1, q2, p1, p2)               */
static const double h = 1.0/128;
static const double start_q[] = { 1.1, -1.1 }, start_p[] = { 2.7746, 2.7746 };
static const double end_q[] = { -0.540054552496, 1.762261020480 };    /* [A]'s code after 2^19 steps */

static long double energy(const double *q, const double *p)
{
    const long double a = (long double)q[0], b = (long double)q[1], c = cosl(b), g = (long double)G;
    const long double u = (long double)p[0], v = (long double)p[1];
    return (u*u - 2*(1 + c)*u*v + (3 + 2*c)*v*v)/(2 - c*c)/2 - 2*g*cosl(a) - g*cosl(a + b);
}

enum { BLOCK = 1 << 13 };
typedef struct walk { long double first, worst, last, squares; long steps; } walk;

static void look(walk *w, const double *q, const double *p)
{
    long double d = (energy(q, p) - w->first)/w->first;
    if (!(fabsl(d) <= w->worst)) w->worst = fabsl(d);
    if (++w->steps % BLOCK) return;
    w->squares += (d - w->last)*(d - w->last);
    w->last = d;
}

static long double noise(const walk *w) { return sqrtl(w->squares/w->steps); }

typedef struct result {
    double    q[2], ms;
    long long evaluations, iterations;
    int       failed;
    walk      walk;
} result;

/* ------------------------------------------------------ right-hand side */

INLINE double sine_of(double x)
{
    double s, c;
    sine_and_cosine(x, &s, &c);
    return s;
}

/* v = M^-1 p; what both angles share is p1 - p2.  det M = 1 + sin^2 q2                         */
INLINE void velocity_at(double s, double c, double p1, double p2, double *v1, double *v2)
{
    double p = p1 - p2, d = 1/(1 + s*s);
    *v1 = (p - c*p2)*d;
    *v2 = ((2 + c)*p2 - (1 + c)*p)*d;
}

/* One point, y = (q, p), for the port                                                         */
static void slope(const double *y, double *f)
{
    double s, c, v1, v2, joint = G*sine_of(y[0] + y[1]);
    sine_and_cosine(y[1], &s, &c);
    velocity_at(s, c, y[2], y[3], &v1, &v2);
    f[0] = v1;
    f[1] = v2;
    f[2] = -(2*G*sine_of(y[0]) + joint);
    f[3] = -joint - s*v1*(v1 + v2);
}

/* All points, for gvi.h.  The sines of q2 are kept from velocity to gradient.                 */
typedef struct sines { double q2[8]; } sines;

INLINE int velocity(const gvi_points *x, int count, int stride, sines *kept)
{
    const double *restrict q2 = x->q + stride, *restrict p = x->p;
    double *restrict v = x->velocity, *restrict keep = kept->q2;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double s, c;
        sine_and_cosine(q2[k], &s, &c);
        velocity_at(s, c, p[k], p[stride+k], v + k, v + stride + k);
        keep[k] = s;
    }
    return 0;
}

INLINE int gradient(const gvi_points *x, int count, int stride, const sines *kept)
{
    const double *restrict v = x->v;
    double *restrict f2 = x->f + stride;
    INDEPENDENT for (int k = 0; k < count; ++k) f2[k] -= kept->q2[k]*v[k]*(v[k] + v[stride+k]);
    return 0;
}

INLINE int gravity(const gvi_points *x, int count, int stride, const sines *kept)
{
    const double *restrict q = x->q;
    double *restrict f = x->f;
    INDEPENDENT for (int k = 0; k < count; ++k) {
        double joint = G*sine_of(q[k] + q[stride+k]);
        f[k] -= 2*G*sine_of(q[k]) + joint;
        f[stride+k] -= joint;
    }
    return 0;
}

/* Rows of eight as constants: six points and what is behind them; else, as at the start, as given */
#define WHOLE(call, x, user) \
    ((x)->count > 8 ? 1 : (x)->stride == 8 ? call(x, 8, 8, user) : call(x, (x)->count, (x)->stride, user))
static int velocity_all(const gvi_points *x, void *user) { return WHOLE(velocity, x, user); }
static int gradient_all(const gvi_points *x, void *user) { return WHOLE(gradient, x, user); }
static int gravity_all(const gvi_points *x, void *user) { return WHOLE(gravity, x, user); }

/* For the start alone, and for Newton's method, which a pinned formulation does not use        */
static int mass(const gvi_points *x, void *user)
{
    double *m11 = x->mass, *m21 = m11 + 2*x->stride, *m22 = m11 + 3*x->stride;
    sines *kept = user;
    for (int k = 0; k < x->count; ++k) {
        double q2 = x->q[x->stride+k], c = cos(q2);
        m11[k] = 3 + 2*c;
        m21[k] = 1 + c;
        m22[k] = 1;
        if (k < 8) kept->q2[k] = sin(q2);
    }
    return 0;
}

/* ------------------------------------------------ the algorithm of [A] */

/* mu_ij = a_ij/b_j, rounded so that mu_ij + mu_ji = 1 exactly; hb_i = h b_i, the outer two closing
   their sum to h; nu: the last step's curve, continued to the nodes of this one; order: of the
   sum, small increments first.                                                                */
typedef struct coefficients { double mu[S][S], hb[S], nu[S][S]; int order[S]; } coefficients;

/* sum_k (2k+1) P_k(1 - 2 c_j) times the integral of P_k(1 - 2x) from 0 to x                   */
static long double integral(int s, long double x, long double node)
{
    long double at[S+2], of[S+2], sum = x;
    legendre(s + 1, 1 - 2*x, at);
    legendre(s + 1, 1 - 2*node, of);
    for (int k = 1; k < s; ++k) sum += (at[k-1] - at[k+1])/2*of[k];
    return sum;
}

static void coefficients_begin(coefficients *t)
{
    const int s = S;
    long double c[S], b[S];
    double sum = 0;
    gauss_nodes(s, c, b);
    for (int i = 0; i < s; ++i)
        for (int j = 0; j < s; ++j) {
            long double ahead = integral(s, 1 + c[i], c[j]) - 1;
            t->nu[i][j] = (double)ahead;
            if (j == i) t->mu[i][j] = 0.5;
            if (j > i) t->mu[j][i] = (double)integral(s, c[j], c[i]);
            if (j > i) t->mu[i][j] = 1 - t->mu[j][i];
        }
    // 1 - mu is exact for mu in [1/2, 2]; beyond, mu is that which is left of it
    for (int i = 0; i < s; ++i)
        for (int j = 0; j < i; ++j) t->mu[i][j] = 1 - t->mu[j][i];
    for (int i = 1; i < s - 1; ++i) sum += t->hb[i] = (double)((long double)h*b[i]);
    t->hb[0] = t->hb[s-1] = (h - sum)/2;
    for (int i = 0; i < s; ++i) t->order[i] = i/2 + (i % 2 ? s - 1 - 2*(i/2) : 0);
}

/* Where a step is at work.  [stage][component], also of the tables                            */
typedef struct work {
    double y[N], rest[N], Y[S*N], before[S*N], F[S*N], L[S*N], least[S*N];
    int    once_more;
} work;

/* Per component: smallest change so far; goes on while one falls below it, and once more then,
   unless nothing changes at all.                                                              */
INLINE int goes_on(const int s, const int n, work *w)
{
    int same = 0, falls = 0;
    for (int i = 0; i < s*n; ++i) {
        double d = fabs(w->Y[i] - w->before[i]);
        int less = (d > 0) & (d < w->least[i]);
        same += !(d > 0);
        falls |= less;
        w->least[i] = less ? d : w->least[i];
    }
    int stop = !falls && (w->once_more || same == s*n);
    w->once_more = !falls;
    return !stop;
}

/* y + rest += sum of L, with what rounding took from the products                             */
INLINE void advance(const int s, const int n, const coefficients *t, work *w)
{
#ifdef FP_FAST_FMA
    for (int i = 0; i < s; ++i)
        for (int k = 0; k < n; ++k) w->rest[k] += fma(t->hb[i], w->F[i*n+k], -w->L[i*n+k]);
#endif
    for (int i = 0; i < s; ++i)
        for (int k = 0; k < n; ++k) {
            double d = w->L[t->order[i]*n+k] + w->rest[k], y = w->y[k], sum = y + d;
            w->rest[k] = d - (sum - y);
            w->y[k] = sum;
        }
}

/* Y = y + (rest + table L)                                                                    */
INLINE void stages(const int s, const int n, double (*table)[S], const double *rest, work *w)
{
    for (int i = 0; i < s; ++i) {
        double sum[N];
        for (int k = 0; k < n; ++k) sum[k] = rest[k] + table[i][0]*w->L[k];
        for (int j = 1; j < s; ++j)
            for (int k = 0; k < n; ++k) sum[k] += table[i][j]*w->L[j*n+k];
        for (int k = 0; k < n; ++k) w->Y[i*n+k] = w->y[k] + sum[k];
    }
}

INLINE void increments(const int s, const int n, const coefficients *t, work *w)
{
    for (int i = 0; i < s; ++i) {
        slope(w->Y + i*n, w->F + i*n);
        for (int k = 0; k < n; ++k) w->L[i*n+k] = t->hb[i]*w->F[i*n+k];
    }
}

/* Returns the number of iterations, or 0 if that is too large.                                */
INLINE int port_step(const int s, const int n, const int from_curve, coefficients *t, work *w)
{
    static const double zeros[N];
    for (int i = 0; i < s*n; ++i) {
        w->least[i] = HUGE_VAL;
        w->Y[i] = w->y[i % n];
    }
    if (from_curve) stages(s, n, t->nu, zeros, w);
    w->once_more = 0;
    for (int round = 1; round <= 100; ++round) {
        memcpy(w->before, w->Y, sizeof w->Y);
        increments(s, n, t, w);
        stages(s, n, t->mu, w->rest, w);
        if (!goes_on(s, n, w)) return advance(s, n, t, w), round;
    }
    return 0;
}

INLINE void port(const int s, const int n, const int from_curve, long steps, int watched, result *r)
{
    coefficients t;
    work w = { .y = { start_q[0], start_q[1], start_p[0], start_p[1] } };
    coefficients_begin(&t);
    for (long i = 0; i < steps && !r->failed; ++i) {
        int rounds = port_step(s, n, from_curve, &t, &w);
        r->failed = !rounds;
        r->iterations += rounds;
        if (watched) look(&r->walk, w.y, w.y + 2);
    }
    r->evaluations = s*r->iterations;
    memcpy(r->q, w.y, sizeof r->q);
}

/* n and s are read at run time, as in a library                                               */
static volatile int components_there = N, stages_there = S;

static void port_plain(long steps, int watched, result *r)
{
    port(stages_there, components_there, 0, steps, watched, r);
}

static void port_curve(long steps, int watched, result *r)
{
    port(stages_there, components_there, 1, steps, watched, r);
}

static void port_constant(long steps, int watched, result *r) { port(S, N, 1, steps, watched, r); }

/* ------------------------------------------------------------- gvi.h */

static void library(long steps, int watched, result *r)
{
    static double memory[GVI_LENGTH(2, S, S)];
    sines kept;
    gvi_stepper st;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = gravity_all } };
    const gvi_desc desc = { .n = 2, .degree = S, .effects = scene, .effect_count = 1,
                            .formulation = GVI_MOMENTA,
                            .mass = { .kind = GVI_MASS_POSITION, .points = mass, .gradient = gradient_all,
                                      .velocity = velocity_all, .user = &kept } };
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start_momentum(&st, 0, start_q, start_p);
    for (long i = 0; i < steps && st.status == GVI_OK; ++i) {
        gvi_step(&st, h);
        if (watched) look(&r->walk, st.q, st.p);
    }
    r->failed = st.status != GVI_OK;
    r->iterations = (long long)st.counters.iterations;
    r->evaluations = (long long)st.counters.effect[0];
    memcpy(r->q, st.q, sizeof r->q);
}

/* ------------------------------------------------------------ the table */

enum { PLAIN, CURVE, CONSTANT, OURS, METHODS };
typedef struct method { const char *name; void (*run)(long steps, int watched, result *r); } method;
static const method methods[METHODS] = {
    { "[A] from y0", port_plain }, { "[A] from the last curve", port_curve },
    { "[A] the same, n, s constants", port_constant }, { "gvi.h", library } };

static double cpu_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec*1e3 + (double)t.tv_nsec*1e-6;
}

/* In turns, so that a busy machine is busy for all                                            */
static void measure(long steps, result *all)
{
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < METHODS; ++i) {
            result r = { .walk.first = energy(start_q, start_p) };
            const double begin = cpu_ms();
            methods[i].run(steps, k == 0, &r);
            r.ms = cpu_ms() - begin;
            if (k == 0) all[i] = r;
            else if (k == 1 || r.ms < all[i].ms) all[i].ms = r.ms;
        }
}

int main(int argc, char **argv)
{
    static result r[METHODS];
    const int quick = argc > 1 && !strcmp(argv[1], "--quick");
    const long steps = quick ? 1L << 15 : 1L << 19;
    int bad = 0;
    measure(steps, r);
    printf("Double pendulum, relative angles, Gauss 6, h = 1/128, %ld steps; it, ev: iterations and points a step\n\n"
           "%-30s %9s %7s %9s %7s %7s   gvi.h's time to it\n", steps, "", "max dE/E", "noise", "CPU ms", "it", "ev");
    for (int i = 0; i < METHODS; ++i) {
        printf("  %-28s %9.2Le %7.1Le %9.1f %7.3f %7.2f", methods[i].name, r[i].walk.worst, noise(&r[i].walk),
               r[i].ms, (double)r[i].iterations/(double)steps, (double)r[i].evaluations/(double)steps);
        if (i != OURS) printf("   %.2f", r[OURS].ms/r[i].ms);
        puts(r[i].failed ? "   FAILED" : "");
        bad |= r[i].failed;
        for (int k = 0; !quick && k < 2; ++k) bad |= !(fabs(r[i].q[k] - end_q[k]) <= 1e-10);
    }
    if (!quick) printf("end state of [A]'s own code, to 1e-10: %s\n", bad ? "NOT REACHED" : "reached by all");
    return bad;
}
