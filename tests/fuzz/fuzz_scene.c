/* fuzz_scene.c - descriptions and sequences of calls from bytes, for libFuzzer

   The first bytes make a description: sizes, rule, mass, effects, formulation; the
   rest is a sequence of calls with arguments of any bits.  Callbacks compute, refuse
   or give NaN as their bytes say.  What is asserted is the contract of gvi.h: a status
   of the list, a failure that leaves t, q and p as they were, a success that leaves
   finite numbers, work that is bounded; memory is watched by the sanitizers, or by
   PAD numbers on both sides of it (test_hostile.c).

     make fuzz                60 seconds
     fuzz_scene FILE          one input again                                  */
#define GVI_IMPLEMENTATION
#include "gvi.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef PAD
#define PAD 0
#endif
enum { N = 4, EFFECTS = 4, ROWS = EFFECTS*(N + 1), POINTS = 24 };

/* -------------------------------------------------------------------- bytes */

static const uint8_t *at, *end;

static unsigned byte(void) { return at < end ? *at++ : 0; }
static unsigned below(unsigned n) { return byte() % n; }

/* Eight bytes as they are, or one as a small number */
static double number(void)
{
    const unsigned kind = byte();
    double x = 0;
    uint64_t bits = 0;
    if (kind < 200) return ((double)byte() - 128)/64;
    if (kind < 220) return ldexp((double)byte() - 128, (int)byte() - 128);
    for (int k = 0; k < 8; ++k) bits = bits << 8 | byte();
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* ---------------------------------------------------------------- callbacks */

typedef struct mood { unsigned kind, when, calls; double strength; int rows; double level[N]; } mood;
static unsigned long long asked;
static long started, succeeded;                    /* scenes, calls */

static int sick(mood *a) { return a->calls++ % 64 == a->when; }

static double answer(const mood *a, double q)
{
    switch (a->kind % 6) {
    case 0:  return -a->strength*q;
    case 1:  return -sin(q);
    case 2:  return -a->strength*q*q*q;
    case 3:  return -1e6*q;
    case 4:  return NAN;
    default: return a->strength;
    }
}

static int points(const gvi_points *x, void *user)
{
    mood *a = user;
    const int bad = sick(a);
    asked += (unsigned long long)x->count;
    if (bad && a->kind > 200) return 1;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k) {
            const int j = i*x->stride + k;
            const double y = bad || a->kind % 6 < 4 ? answer(a, x->q[j]) : -x->q[j];
            if (x->f) x->f[j] += y;
            if (x->f && x->v) x->f[j] -= x->v[j]/8;
            if (x->dldv) x->dldv[j] += x->v[j]*(1 + (bad ? a->strength : 0));
        }
    for (int k = 0; k < x->count && x->value; ++k) x->value[k] += bad ? answer(a,
                                                                               x->q[k]) : 1 + x->q[k]*x->q[k];
    return 0;
}

static int point(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *f, gvi_real *dldv, void *user)
{
    mood *a = user;
    ++asked;
    if (sick(a) && a->kind > 200) return -1;
    f[0] += answer(a, q[0]);
    if (v) f[0] -= v[0]*t/8;
    if (dldv) dldv[0] += v[0];
    return 0;
}

static int hessian(gvi_real t, const gvi_real *q, const gvi_real *v, gvi_real *fq, gvi_real *fv,
                   gvi_real *pv, void *user)
{
    mood *a = user;
    (void)t; (void)v;
    fq[0] -= 1 + a->strength*q[0];
    if (fv) fv[0] -= 0.125;
    if (pv) pv[0] += 1;
    return sick(a) && a->kind > 220;
}

static int mass(const gvi_points *x, void *user)
{
    mood *a = user;
    const int bad = sick(a);
    asked += (unsigned long long)x->count;
    for (int i = 0; i < x->n; ++i)
        for (int j = 0; j <= i; ++j)
            for (int k = 0; k < x->count; ++k)
                x->mass[(i*x->n + j)*x->stride + k] = bad ? answer(a,
                                                                   x->q[k]) : i == j ? 2 + cos(x->q[k]) : 0;
    return bad && a->kind > 200;
}

static int gradient(const gvi_points *x, void *user)
{
    mood *a = user;
    for (int k = 0; k < x->count; ++k) x->f[k] += sick(a) ? answer(a, x->q[k]) : 0;
    return 0;
}

static int velocity(const gvi_points *x, void *user)
{
    mood *a = user;
    const int bad = sick(a);
    asked += (unsigned long long)x->count;
    for (int i = 0; i < x->n; ++i)
        for (int k = 0; k < x->count; ++k)
            x->velocity[i*x->stride + k] = bad ? answer(a, x->p[i*x->stride + k]) : x->p[i*x->stride + k]/2;
    return bad && a->kind > 200;
}

/* Rods |(q_i, q_j)|^2/2 = level, a ring of them: together n rows depend on each other if n is even.  By
   kind: all the same row, a level that moves, a Jacobian of another function, NaN now and then.  */
static int rods(const gvi_points *x, void *user)
{
    mood *a = user;
    const int bad = sick(a), kind = (int)(a->kind % 6), n = x->n, R = x->stride;
    const double rate = kind == 2 ? a->strength : 0;
    asked += (unsigned long long)x->count;
    for (int r = 0; r < a->rows; ++r) {
        const int i = kind == 1 ? 0 : r % n, j = (i + 1) % n;
        for (int k = 0; k < x->count; ++k) {
            const double u = x->q[i*R + k], w = x->q[j*R + k];
            x->g[r*R + k] = (u*u + w*w)/2 - a->level[r % N] - rate*x->t[k];
            x->jacobian[(r*n + i)*R + k] = bad && kind > 3 ? NAN : kind == 3 ? a->strength : u;
            x->jacobian[(r*n + j)*R + k] = i == j ? 2*u : w;
            if (rate < 0 || rate > 0) x->rate[r*R + k] = bad ? answer(a, u) : -rate;
        }
    }
    return bad && a->kind > 200;
}

/* -------------------------------------------------------------- description */

static gvi_effect effects[EFFECTS];
static mood       moods[EFFECTS + 1];
static double     matrix[N*N], nodes[POINTS], weights[POINTS];

static mood any_mood(void)
{
    mood a = { 0 };
    a.kind = byte();
    a.when = below(64);
    a.strength = number();
    return a;
}

/* A scene with constraints of which gvi_init refuses few: at random hardly one in a thousand starts */
static void constrain(gvi_desc *d)
{
    if (d->effect_count == 0) d->effect_count = 1;
    for (int e = 0; e < d->effect_count; ++e) {
        effects[e].rows = moods[e].rows = e ? 0 : 1 + (int)below((unsigned)d->n);
        if (effects[e].kind > GVI_LAGRANGIAN) effects[e].kind = GVI_FORCE;
    }
    effects[0] = (gvi_effect){ .kind = GVI_CONSTRAINT, .points = rods, .user = moods, .rows = moods->rows };
    d->mass = (gvi_mass){ .kind = below(2) ? GVI_MASS_POSITION : GVI_MASS_UNIT, .user = &moods[EFFECTS] };
    if (d->mass.kind == GVI_MASS_POSITION) {
        d->mass.points = mass;
        d->mass.gradient = gradient;
    }
    d->rule = (gvi_rule){ .kind = below(2) ? GVI_LOBATTO : GVI_GAUSS };
    if (d->formulation == GVI_NEWTON) d->formulation = GVI_AUTO;
    d->tolerance = 0;
}

static gvi_desc describe(void)
{
    gvi_desc d = { .n = (int)below(N) + 1, .degree = (int)below(9), .effects = effects };
    d.effect_count = (int)below(EFFECTS + 1);
    for (int e = 0; e < d.effect_count; ++e) {
        const unsigned how = byte();
        effects[e] = (gvi_effect){ .kind = (gvi_kind)below(6), .user = &moods[e] };
        if (effects[e].kind == GVI_CONSTRAINT) effects[e].points = rods;
        else if (how & 1) effects[e].points = points;
        else effects[e].point = point;
        if (how & 2) effects[e].value = points;
        if (how & 4) effects[e].hessian = hessian;
        moods[e] = any_mood();
        if (effects[e].kind == GVI_CONSTRAINT || how > 250)
            effects[e].rows = moods[e].rows = (int)below(how & 128 ? 2 : N + 2);
    }
    d.mass.kind = (gvi_mass_kind)below(5);
    for (int i = 0; i < N*N; ++i) matrix[i] = i % (N + 1) == 0 ? 2 : 0;
    for (int i = 0; i < d.n; ++i) matrix[below(N*N)] = number();
    if (d.mass.kind != GVI_MASS_UNIT) d.mass.matrix = matrix;
    if (d.mass.kind != GVI_MASS_UNIT) d.mass.points = mass;
    d.mass.gradient = gradient;
    if (below(4) == 0) d.mass.velocity = velocity;
    d.mass.user = &moods[EFFECTS];
    moods[EFFECTS] = any_mood();
    d.rule.kind = (gvi_rule_kind)below(4);
    d.rule.points = d.rule.kind >= GVI_OWN || below(2) ? (int)below(POINTS) : 0;
    if (d.rule.points > 0) (void)gvi_gauss(d.rule.points, nodes, weights);
    if (below(3) == 0) nodes[below(POINTS)] = number();
    if (below(3) == 0) weights[below(POINTS)] = number();
    if (d.rule.kind >= GVI_OWN) d.rule.nodes = nodes;
    d.rule.weights = weights;
    d.formulation = (gvi_formulation)below(6);
    if (below(6) == 0) d.tolerance = number();
    d.max_iterations = (int)below(100);
    if (below(4) == 0) d.iterations = (int)below(8);
    if (below(2)) constrain(&d);
    return d;
}

/* -------------------------------------------------------------------- calls */

static void broken(const char *what, gvi_status status)
{
    fprintf(stderr, "%s: status %d, %s\n", what, (int)status, gvi_status_text(status));
    abort();
}

static void check(const gvi_stepper *st, const gvi_desc *d, const double *before, gvi_status status,
                  int changes)
{
    double after[2*N + 1] = { st->t };
    const int most = d->max_iterations ? d->max_iterations : 60;
    const unsigned long long m = (unsigned long long)(d->iterations > most ? d->iterations : most);
    const unsigned long long n = (unsigned long long)st->n, r = (unsigned long long)st->r;
    const unsigned long long step = (m + 1)*r + 2*(m + 1)*r + ((2*n + 1)*r + n + 1)*(m/4 + 2) + 40*(n + 2);
    int finite = isfinite(st->t);
    for (int i = 0; i < st->n; ++i) {
        after[1 + i] = st->q[i];
        after[1 + N + i] = st->p[i];
        finite = finite && isfinite(st->q[i]) && isfinite(st->p[i]);
    }
    if (status > GVI_OK || status < GVI_E_RESOLUTION) broken("a status that is none", status);
    if ((status != GVI_OK || !changes) && memcmp(before, after, sizeof after)) broken("the state has changed",
                                                                                    status);
    if (status == GVI_OK && !finite) broken("a state that is not finite", status);
    // with a clock, gvi_state_at searches for h with at most 60 such steps
    if (asked > 64*2*step*(unsigned long long)(d->effect_count + 3)) broken("too much work", status);
}

/* Makes the levels of all rods those of q at t; v is 0, or turns the first of them and follows its level */
static void fit(int n, const gvi_desc *d, double t, const double *q, double *v)
{
    for (int e = 0; e < d->effect_count; ++e)
        for (int r = 0; r < moods[e].rows; ++r) {
            mood *a = &moods[e];
            const int i = a->kind % 6 == 1 ? 0 : r % n, j = (i + 1) % n;
            a->level[r % N] = (q[i]*q[i] + q[j]*q[j])/2 - (a->kind % 6 == 2 ? a->strength*t : 0);
        }
    const double r = q[0]*q[0] + q[n > 1]*q[n > 1], turn = n > 1 && below(4) == 0;
    const double out = d->effect_count && moods->kind % 6 == 2 && r > 0 ? moods->strength/r/(n > 1 ? 1 : 2) : 0;
    for (int i = 0; i < n; ++i) v[i] = i < 2 ? out*q[i] : 0;
    if (turn > 0) {
        v[0] -= q[1];
        v[1] += q[0];
    }
}

static void call(gvi_stepper *st, const gvi_desc *d, unsigned what)
{
    double before[2*N + 1] = { st->t }, a[N], b[N], c[ROWS], z[N], x = 0;
    int changes = 0, negative = 0;
    const gvi_discrete out = { .lagrangian = &x, .d1 = c, .d2 = z, .negative = below(2) ? &negative : NULL };
    gvi_status status;
    for (int i = 0; i < N; ++i) { a[i] = number(); b[i] = number(); }
    for (int i = 0; i < st->n; ++i) { before[1 + i] = st->q[i]; before[1 + N + i] = st->p[i]; }
    asked = 0;
    if ((what == 7 || what == 8) && st->n > 0 && below(4)) fit(st->n, d, a[0], a, b);
    switch (what) {
    case 0:  status = gvi_velocity(st, c); break;
    case 1:  status = gvi_energy(st, &x); break;
    case 2:  status = gvi_curve(st, a[0], c, z); break;
    case 3:  status = gvi_state_at(st, st->t - st->h*a[0], c, z, b); break;
    case 4:  status = gvi_action(st, &x); break;
    case 5:  status = gvi_switch(st, (int)below(6) - 1, (int)below(2)); break;
    case 6:  status = gvi_discrete_lagrangian(st, a[0], b[0], a, b, &out); break;
    case 7:  changes = 1; status = gvi_start(st, a[0], a, b); break;
    case 8:  changes = 1; status = gvi_start_momentum(st, a[0], a, b); break;
    case 9:  changes = 1; status = gvi_start_configurations(st, a[0], b[0], a, b); break;
    case 10: status = gvi_multipliers(st, c);
        for (int e = 0, row = 0; e < d->effect_count && status == GVI_OK; ++e)
            for (int r = 0; r < effects[e].rows; ++r)
                if (!isfinite(c[row++])) broken("a multiplier that is not finite", status);
        break;
    default: changes = 1; status = gvi_step(st, a[0]);
    }
    check(st, d, before, status, changes);
    succeeded += status == GVI_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    gvi_stepper st;
    at = data;
    end = data + size;
    const gvi_desc d = describe();
    const size_t needed = gvi_size(&d);
    const size_t length = (needed + sizeof(double) - 1)/sizeof(double), all = length + 2*PAD;
    double *const base = malloc((all ? all : 1)*sizeof *base), *const memory = base + PAD;
    if (!base) return 0;
    if (needed > 8u << 20) broken("too much memory for so small a scene", GVI_OK);
    memset(base, 0xA5, all*sizeof *base);
    memset(memory, 0xFF, length*sizeof *base);                    /* NaN: to be written before it is read */
    const gvi_status status = gvi_init(&st, &d, memory, needed ? needed : sizeof(double));
    if (status > GVI_OK || status < GVI_E_RESOLUTION) broken("a status that is none", status);
    if (status == GVI_OK && !needed) broken("no size, and yet it works", status);
    started += status == GVI_OK;
    if (status == GVI_OK)
        for (int k = 0; k < 12 && at < end; ++k) call(&st, &d, k > 0 || below(8) == 0 ? below(17) : 7);
    for (size_t k = 0; k < 2*PAD*sizeof *base; ++k)
        if (((unsigned char *)base)[k < PAD*sizeof *base ? k : k + length*sizeof *base] != 0xA5)
            broken("written outside the memory", status);
    free(base);
    return 0;
}
