/* rolling_scenes.c - random rolling scenes against an index-1 reference, and what users get wrong

   Up to six coordinates, three rows A(q) v + a(t) = 0 of sines, masses, springs, a coupling and friction, degree 6, five steps
   of 1/20.  One scene in three has M(q) = D + (1 + sin(b.q)/2) u u', one in three a term of L that bends the way and one of the
   fourth power of v, one in two of those with two rows or three gives some of them as g(q) = 0.  The reference eliminates the
   multipliers from M v' = F + A' lambda, d/dt (A v + a) = 0, in long double, by DOP853's formula, with 20 steps or more.  What is asserted: a run that is ok is right, and rows that fit are not refused.  One
   scene in two has a trap:

     repeated      one row is a combination of the others: left out, the same motion
     empty         A = 0: GVI_E_SINGULAR, at the start or in the first step, with the effect
     slip          the start slips: GVI_E_CONSTRAINT with a row that does
     integrable    rows are those of a g(q) = 0: the motion is right, and g drifts by the error of the steps
     quarrel       two rows agree at the start and contradict each other later: not ok for long
     awake         a row is left out at the start and independent later: the same
     vanishing     A passes 0 within a step: ok only if right

     rolling_scenes [scenes, 200000 [seed]]                                                               */
#include "hard.h"
#include "cost/coefficients.h"

enum { N = 6, M = 3, STEPS = 5, FINE = 20 };
static const double END = 0.25, NEAR = 1e-4;       // least over largest pivot: rows are about to depend on each other
typedef enum { PLAIN, REPEATED, EMPTY, SLIP, INTEGRABLE, QUARREL, AWAKE, VANISHING, TRAPS } trap;
static const char *const names[] = { "plain", "repeated", "empty", "slip", "integrable", "quarrel", "awake", "vanishing" };

/* Row a: c_i + b_i sin(w.q + turn_i); the rate: drive sin(beat t).  A row of INTEGRABLE is b w cos(w.q), plus c constant. */
typedef struct row { double c[N], b[N], w[N], turn[N], drive, beat; } row;
typedef struct scene {
    trap   kind;
    int    n, m, held, formulation;           // the first `held` of the m rows are those of a g
    row    rows[M];
    double mix[M], mass[N], spring[N], couple, friction, instant, level[M];
    int    turning, bending;                  // M(q); terms of L
    double u[N], b[N], along[N], about[N], fourth;
} scene;

/* The rolling rows' effect: after the force and the rows of g */
static int rolling_effect(const scene *s) { return 1 + (s->held > 0); }

/* Is row k that of a g, c.q - b cos(w.q + 1)? */
static int integrable(const scene *s, int k) { return s->kind == INTEGRABLE || k < s->held; }

/* A and its derivative along v, a and its derivative, of the rows that count, in the reference's type */
typedef long double exact;
static void make_rows(const scene *s, exact t, const exact *q, const exact *v, exact (*A)[N], exact (*dA)[N], exact *a, exact *da)
{
    for (int k = 0; k < s->m; ++k) {
        const row *r = s->rows + k;
        exact along = 0, moving = 0;
        for (int i = 0; i < s->n; ++i) along += r->w[i]*q[i], moving += r->w[i]*v[i];
        for (int i = 0; i < s->n; ++i) {
            const exact b = integrable(s, k) ? r->b[0]*r->w[i] : r->b[i], turn = integrable(s, k) ? 1 : r->turn[i];
            A[k][i] = r->c[i] + b*sinl(along + turn);
            dA[k][i] = b*cosl(along + turn)*moving;
        }
        a[k] = r->drive*sinl(r->beat*t);
        da[k] = r->drive*r->beat*cosl(r->beat*t);
    }
}

static exact dot(int n, const double *a, const exact *b)
{
    exact sum = 0;
    for (int i = 0; i < n; ++i) sum += a[i]*b[i];
    return sum;
}

/* (d/dv)^2 of the kinetic energy and the terms, and what is left of Lagrange's equations without v' and multipliers */
static void inertia(const scene *s, const exact *q, const exact *v, exact (*z)[N + M + 1])
{
    const exact w = s->turning ? 1 + sinl(dot(s->n, s->b, q))/2 : 0, speed = dot(s->n, s->along, v);
    const exact fourth = s->bending ? 3*s->fourth*speed*speed : 0;
    for (int i = 0; i < s->n; ++i)
        for (int j = 0; j < s->n; ++j)
            z[i][j] = (i == j)*(exact)s->mass[i] + w*s->u[i]*s->u[j] + fourth*s->along[i]*s->along[j];
}

static void push(const scene *s, const exact *q, const exact *v, exact *f)
{
    const exact slope = s->turning ? cosl(dot(s->n, s->b, q))/2 : 0, uv = dot(s->n, s->u, v), bv = dot(s->n, s->b, v);
    const exact turn = s->bending ? cosl(dot(s->n, s->about, q)) : 0, kv = dot(s->n, s->along, v), xv = dot(s->n, s->about, v);
    exact sum = 0;
    for (int i = 0; i < s->n; ++i) sum += q[i];
    for (int i = 0; i < s->n; ++i)
        f[i] = -s->spring[i]*q[i] - s->couple*cosl(sum) - s->friction*v[i]
               + slope*uv*(uv*s->b[i]/2 - bv*s->u[i]) + turn*(kv*s->about[i] - xv*s->along[i]);
}

/* ---- the same for gvi.h ---- */

static int springs_and_coupling(const gvi_points *x, void *user)
{
    const scene *s = user;
    for (int k = 0; k < x->count; ++k) {
        double sum = 0;
        for (int i = 0; i < x->n; ++i) sum += x->q[i*x->stride + k];
        for (int i = 0; i < x->n; ++i) {
            const int j = i*x->stride + k;
            x->f[j] += -s->spring[i]*x->q[j] - s->couple*cos(sum) - s->friction*x->v[j];
        }
    }
    return 0;
}

/* At point k, in the reference's type */
static void take(const gvi_points *x, const double *from, int k, exact *to)
{
    for (int i = 0; i < x->n; ++i) to[i] = from[i*x->stride + k];
}

static int mass_at(const gvi_points *x, void *user)
{
    const scene *s = user;
    for (int k = 0; k < x->count; ++k) {
        exact q[N];
        take(x, x->q, k, q);
        const double w = 1 + sin((double)dot(s->n, s->b, q))/2;
        for (int i = 0; i < s->n; ++i)
            for (int j = 0; j <= i; ++j)
                x->mass[(i*s->n + j)*x->stride + k] = (i == j)*s->mass[i] + w*s->u[i]*s->u[j];
    }
    return 0;
}

static int mass_slope(const gvi_points *x, void *user)
{
    const scene *s = user;
    for (int k = 0; k < x->count; ++k) {
        exact q[N], v[N];
        take(x, x->q, k, q);
        take(x, x->v, k, v);
        const double uv = (double)dot(s->n, s->u, v), slope = cos((double)dot(s->n, s->b, q))/2;
        for (int i = 0; i < s->n; ++i) x->f[i*x->stride + k] += slope*uv*uv*s->b[i]/2;
    }
    return 0;
}

/* L = sin(about.q) (along.v) + fourth (along.v)^4/4 */
static int terms_at(const gvi_points *x, void *user)
{
    const scene *s = user;
    for (int k = 0; k < x->count; ++k) {
        exact q[N], v[N];
        take(x, x->q, k, q);
        take(x, x->v, k, v);
        const double angle = (double)dot(s->n, s->about, q), speed = (double)dot(s->n, s->along, v);
        for (int i = 0; i < s->n; ++i) {
            const int j = i*x->stride + k;
            if (x->f) x->f[j] += cos(angle)*speed*s->about[i];
            if (x->dldv) x->dldv[j] += (sin(angle) + s->fourth*speed*speed*speed)*s->along[i];
        }
    }
    return 0;
}

/* The rows of g; level makes them 0 where the scene starts */
static double held_value(const scene *s, const exact *q, int b)
{
    const row *r = s->rows + b;
    return (double)(dot(s->n, r->c, q) - r->b[0]*cosl(dot(s->n, r->w, q) + 1) - s->level[b]);
}

static int held_at(const gvi_points *x, void *user)
{
    const scene *s = user;
    for (int k = 0; k < x->count; ++k) {
        exact q[N], v[N] = { 0 }, A[M][N], dA[M][N], a[M], da[M];
        take(x, x->q, k, q);
        make_rows(s, x->t[k], q, v, A, dA, a, da);
        for (int b = 0; b < s->held; ++b) {
            x->g[b*x->stride + k] = held_value(s, q, b);
            for (int i = 0; i < x->n; ++i) x->jacobian[(b*x->n + i)*x->stride + k] = (double)A[b][i];
        }
    }
    return 0;
}

/* The rolling rows; the trap's, behind them, is made of all the others */
static int rows_at(const gvi_points *x, void *user)
{
    const scene *s = user;
    const int R = x->stride, extra = s->kind == REPEATED || s->kind == QUARREL || s->kind == AWAKE;
    for (int k = 0; k < x->count; ++k) {
        exact q[N], v[N] = { 0 }, A[M][N], dA[M][N], a[M], da[M];
        take(x, x->q, k, q);
        make_rows(s, x->t[k], q, v, A, dA, a, da);
        const double factor = s->kind == VANISHING ? x->t[k] - s->instant : 1;
        for (int b = s->held; b < s->m; ++b) {
            const double part = s->kind == EMPTY && b == s->held ? 0 : factor;
            for (int i = 0; i < x->n; ++i) x->jacobian[((b - s->held)*x->n + i)*R + k] = part*(double)A[b][i];
            x->rate[(b - s->held)*R + k] = part*(double)a[b];
        }
        for (int i = 0; i < x->n && extra; ++i) {
            double sum = s->kind == AWAKE && i == 0 ? x->t[k] : 0;
            for (int b = 0; b < s->m; ++b) sum += s->mix[b]*(double)A[b][i];
            x->jacobian[((s->m - s->held)*x->n + i)*R + k] = sum;
        }
        if (extra) {
            double sum = s->kind == QUARREL ? x->t[k]/4 : 0;
            for (int b = 0; b < s->m; ++b) sum += s->mix[b]*(double)a[b];
            x->rate[(s->m - s->held)*R + k] = sum;
        }
    }
    return 0;
}

/* ---- linear systems and the reference ---- */

/* Gauss with pivots; the least pivot over the largest */
static exact solve(int n, exact (*a)[N + M + 1])
{
    exact least = 1e30L, most = 0;
    for (int k = 0; k < n; ++k) {
        int best = k;
        for (int i = k; i < n; ++i) if (fabsl(a[i][k]) > fabsl(a[best][k])) best = i;
        for (int j = 0; j <= n; ++j) {
            const exact was = a[k][j];
            a[k][j] = a[best][j];
            a[best][j] = was;
        }
        least = fminl(least, fabsl(a[k][k]));
        most = fmaxl(most, fabsl(a[k][k]));
        for (int i = 0; i < n; ++i) {
            if (i == k || least == 0) continue;
            const exact part = a[i][k]/a[k][k];
            for (int j = k; j <= n; ++j) a[i][j] -= part*a[k][j];
        }
    }
    for (int k = 0; k < n && least > 0; ++k) a[k][n] /= a[k][k];
    return least/most;
}

/* (M, -A'; A, 0) (x, lambda) = (f, b) */
static exact saddle(const scene *s, const exact *y, exact (*A)[N], const exact *f, const exact *b, exact *x)
{
    exact z[N + M][N + M + 1] = { { 0 } };
    const int n = s->n, m = s->m;
    inertia(s, y, y + N, z);
    for (int i = 0; i < n; ++i) z[i][n + m] = f[i];
    for (int k = 0; k < m; ++k) {
        for (int i = 0; i < n; ++i) z[i][n + k] = -A[k][i], z[n + k][i] = A[k][i];
        z[n + k][n + m] = b[k];
    }
    const exact grade = solve(n + m, z);
    for (int i = 0; i < n; ++i) x[i] = z[i][n + m];
    return grade;
}

static exact rate_of(const scene *s, exact t, const exact *y, exact *dy)
{
    exact A[M][N], dA[M][N], a[M], da[M], f[N], b[M];
    make_rows(s, t, y, y + N, A, dA, a, da);
    push(s, y, y + N, f);
    for (int k = 0; k < s->m; ++k) {
        b[k] = -da[k];
        for (int i = 0; i < s->n; ++i) b[k] -= dA[k][i]*y[N + i];
    }
    for (int i = 0; i < s->n; ++i) dy[i] = y[N + i];
    return saddle(s, y, A, f, b, dy + N);
}

static const runge_kutta *const dop853 = &dop853_table;

static exact integrate(const scene *s, exact T, int steps, exact *y)
{
    const exact h = T/steps;
    exact K[12][2*N], x[2*N], grade = 1;
    for (int step = 0; step < steps; ++step) {
        for (int i = 0; i < 12; ++i) {
            exact c = 0;
            memcpy(x, y, sizeof x);
            for (int j = 0; j < i; ++j) {
                c += dop853->A[i][j];
                for (int l = 0; l < 2*N; ++l) x[l] += h*dop853->A[i][j]*K[j][l];
            }
            memset(K[i], 0, sizeof K[i]);
            grade = fminl(grade, rate_of(s, (step + c)*h, x, K[i]));
        }
        for (int j = 0; j < 12; ++j)
            for (int l = 0; l < 2*N; ++l) y[l] += h*dop853->b[j]*K[j][l];
    }
    return grade;
}

/* With twice the steps until that changes nothing; -1 if it always does: near a change of rank */
static exact reference(const scene *s, exact T, exact *y)
{
    exact coarse[2*N], fine[2*N], off = 1;
    memcpy(coarse, y, sizeof coarse);
    (void)integrate(s, T, FINE, coarse);
    for (int steps = 2*FINE; steps <= 32*FINE; steps *= 2) {
        memcpy(fine, y, sizeof fine);
        const exact grade = integrate(s, T, steps, fine);
        off = 0;
        for (int i = 0; i < 2*N; ++i) {
            const exact apart = fabsl(fine[i] - coarse[i])/(1 + fabsl(fine[i]));
            if (!(apart <= off) && off >= 0) off = apart;             // keeps NaN
        }
        memcpy(coarse, fine, sizeof coarse);
        if (off < 1e-14L) return memcpy(y, fine, sizeof fine), grade;
    }
    return -1;
}

/* ---- scenes ---- */

static void invent(scene *s, exact *y)
{
    exact A[M][N], dA[M][N], a[M], da[M], f[N] = { 0 }, b[M];
    memset(s, 0, sizeof *s);
    s->n = 2 + (int)((uniform() + 1)*2.5);
    s->m = 1 + (int)((uniform() + 1)*(s->n - 1 < M ? s->n - 1 : M)/2);
    s->kind = uniform() < 0 ? PLAIN : (trap)(1 + (int)((uniform() + 1)*(TRAPS - 1)/2));
    s->formulation = uniform() < 0.6 ? GVI_AUTO : uniform() < 0 ? GVI_MOMENTA : GVI_NEWTON;
    for (int k = 0; k < s->m; ++k) {
        row *r = s->rows + k;
        for (int i = 0; i < s->n; ++i) r->c[i] = uniform(), r->b[i] = uniform(), r->w[i] = 2*uniform(), r->turn[i] = 3*uniform();
        r->drive = uniform() < 0 ? 0 : uniform();
        r->beat = 3*uniform();
        s->mix[k] = 2*uniform();
    }
    if (s->m == s->n && s->kind == AWAKE) s->kind = PLAIN;
    for (int i = 0; i < s->n; ++i) s->mass[i] = exp(2*uniform()), s->spring[i] = 4*(uniform() + 1);
    s->couple = uniform();
    s->friction = uniform() < 0 ? 0 : uniform() + 1;
    s->instant = 0.125 + 0.1*uniform();
    s->held = s->m > 1 && s->kind != INTEGRABLE && uniform() < 0 ? 1 + (int)((uniform() + 1)*(s->m - 1)/2) : 0;
    for (int k = 0; k < s->held; ++k) s->rows[k].drive = 0;
    s->turning = uniform() < -1/3.0;
    s->bending = uniform() < -1/3.0;
    s->fourth = (uniform() + 1)/8;
    if (s->formulation == GVI_MOMENTA) s->fourth = 0;             // v comes from p by a fixed point there, which need not contract
    for (int i = 0; i < s->n; ++i) s->u[i] = uniform(), s->b[i] = 2*uniform(), s->along[i] = uniform(), s->about[i] = 2*uniform();

    memset(y, 0, 2*N*sizeof *y);
    for (int i = 0; i < s->n; ++i) y[i] = uniform(), y[N + i] = 2*uniform();
    make_rows(s, 0, y, y + N, A, dA, a, da);
    for (int k = 0; k < s->m; ++k) b[k] = -a[k];
    exact z[N + M][N + M + 1] = { { 0 } };
    inertia(s, y, y + N, z);
    for (int i = 0; i < s->n; ++i)
        for (int j = 0; j < s->n; ++j) f[i] += z[i][j]*y[N + j];
    if (s->kind != SLIP) saddle(s, y, A, f, b, y + N);            // the nearest velocity that does not slip
    for (int k = 0; k < s->held; ++k) s->level[k] = held_value(s, y, k);
}

/* does that row of an effect slip by more than rounding at the start? */
static int slips(const scene *s, const exact *y, int effect, int k)
{
    exact A[M][N], dA[M][N], a[M], da[M], sum;
    if (effect != 1 && effect != rolling_effect(s)) return 0;
    if (effect == rolling_effect(s)) k += s->held;
    make_rows(s, 0, y, y + N, A, dA, a, da);
    sum = a[k];
    for (int i = 0; i < s->n; ++i) sum += A[k][i]*y[N + i];
    return fabsl(sum) > 1e-13L;
}

typedef struct count { long scenes, ok, wrong, missed, unknown, refused[20]; double worst; } count;

static int made_of_others(const scene *s) { return s->kind == REPEATED || s->kind == QUARREL || s->kind == AWAKE; }

static gvi_status run(const scene *s, const exact *y, int steps, gvi_stepper *st, double *v)
{
    static real memory[20000];
    gvi_effect effects[4] = { { .kind = GVI_FORCE, .points = springs_and_coupling, .user = (void *)s } };
    int count = 1;
    if (s->held) effects[count++] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = held_at, .user = (void *)s, .rows = s->held };
    effects[count++] = (gvi_effect){ .kind = GVI_NONHOLONOMIC, .points = rows_at, .user = (void *)s,
                                     .rows = s->m - s->held + made_of_others(s) };
    if (s->bending) effects[count++] = (gvi_effect){ .kind = GVI_LAGRANGIAN, .points = terms_at, .user = (void *)s };
    const gvi_mass fixed = { .kind = GVI_MASS_DIAGONAL, .matrix = s->mass };
    const gvi_mass turning = { .kind = GVI_MASS_POSITION, .points = mass_at, .gradient = mass_slope, .user = (void *)s };
    const gvi_desc desc = { .n = s->n, .degree = 6, .effects = effects, .effect_count = count,
                            .mass = s->turning ? turning : fixed,
                            .formulation = (gvi_formulation)s->formulation };
    double q[N];
    for (int i = 0; i < s->n; ++i) q[i] = (double)y[i], v[i] = (double)y[N + i];
    gvi_status status = gvi_init(st, &desc, memory, sizeof memory);
    if (status == GVI_OK) status = gvi_start(st, 0, q, v);
    for (int k = 0; k < steps && status == GVI_OK; ++k) status = gvi_step(st, END/steps);
    return status == GVI_OK ? gvi_velocity(st, v) : status;
}

/* of q and v, relative; nearly dependent rows make large forces */
static double error_of(const scene *s, const gvi_stepper *st, const double *v, const exact *known, exact grade)
{
    double error = 0, size = 1;
    for (int i = 0; i < s->n; ++i) {
        size = fmax(size, fabs(v[i]));
        error = fmax(error, fmax(fabs(st->q[i] - (double)known[i]), fabs(v[i] - (double)known[N + i])));
    }
    return error*(double)grade/size;
}

/* Is the status that of the trap, and its fault?  For a long step it may be another refusal, not for one of a 64th */
static int rightly(const scene *s, const exact *y, gvi_stepper *st, gvi_status status)
{
    double v[N];
    if (s->kind == EMPTY) return status == GVI_E_SINGULAR && st->fault.effect == rolling_effect(s);
    if (s->kind == SLIP) return status == GVI_E_CONSTRAINT && slips(s, y, st->fault.effect, st->fault.coordinate);
    if (s->kind == QUARREL && status != GVI_E_CONSTRAINT) status = run(s, y, 64*STEPS, st, v);
    // any of the rows that contradict each other may be the one that is named; effect 0 is the force
    if (s->kind == QUARREL) return status == GVI_E_CONSTRAINT && st->fault.effect > 0;
    if (s->kind == AWAKE || s->kind == VANISHING) return 1;
    return run(s, y, 64*STEPS, st, v) == GVI_OK;
}

/* The error, or if it is more than rounding, that of 4, 16 or 64 times the steps: what these do not mend is no error of steps */
static double least_error(const scene *s, const exact *y, gvi_stepper *st, double *v, const exact *known, exact grade)
{
    double error = error_of(s, st, v, known, grade);
    for (int times = 4; times <= 64 && !(error < 1e-11); times *= 4)
        if (run(s, y, times*STEPS, st, v) == GVI_OK) error = error_of(s, st, v, known, grade);
    return error;
}

static void play(const scene *s, const exact *y, count *c)
{
    const int never = s->kind == EMPTY || s->kind == SLIP || s->kind == QUARREL || s->kind == AWAKE;
    gvi_stepper st;
    double v[N];
    exact known[2*N];
    const gvi_status status = run(s, y, STEPS, &st, v);
    ++c->scenes;
    c->ok += status == GVI_OK;
    if (status != GVI_OK) ++c->refused[-status];
    if (status == GVI_OK && never) ++c->wrong;
    if (status == GVI_OK ? never : rightly(s, y, &st, status)) return;

    memcpy(known, y, sizeof known);
    const exact grade = reference(s, (exact)END, known);
    if (!(grade > NEAR)) ++c->unknown;
    else if (status != GVI_OK) ++c->missed;
    else {
        const double error = least_error(s, y, &st, v, known, grade);
        c->worst = fmax(c->worst, error);
        c->wrong += error > 1e-11;
    }
}

int main(int argc, char **argv)
{
    const long scenes = argc > 1 ? atol(argv[1]) : 200000;
    static count counts[TRAPS];
    seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    for (long k = 0; k < scenes; ++k) {
        scene s;
        exact y[2*N];
        invent(&s, y);
        play(&s, y, counts + s.kind);
        if (k % 500 == 499) progress("rolling scenes", k + 1, scenes);
    }
    for (int k = 0; k < TRAPS; ++k) {
        const count *c = counts + k;
        printf("%s: %ld scenes, ok %ld, worst error %.1e; near a change of rank, not judged: %ld\n", names[k], c->scenes, c->ok,
               c->worst, c->unknown);
        for (int j = 1; j < 20; ++j) if (c->refused[j]) printf("  %6ld %s\n", c->refused[j], gvi_status_text((gvi_status)-j));
        expect("ok and wrong", 0, (double)c->wrong, 0);
        expect(k == PLAIN || k == REPEATED || k == INTEGRABLE ? "refused though the step is short" : "another status or row", 0,
               (double)c->missed, 0);
        expect("not judged, of all", 0, (double)c->unknown/(double)c->scenes, 0.01);
    }
    return verdict("rolling_scenes");
}
