/* Random Lagrangians (examples/tools/lagrangian.h): sums and products of functions, in units and with origins from
   over many decades.  10,000 right ones: is one refused, found to be too simple, or stopped by the watch?
   1,000 with a kind forced that is too small, 1,000 with a derivative lost from a place on: how many steps later
   is it seen?  make typed [TYPED_FACTOR=0.1] */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/lagrangian.h"
#include <stdlib.h>

enum { MOST = 3, TERMS = 3 };
typedef struct term { int function, i; double size, wave, shift; } term;
typedef struct system_of {
    int    n, kind, lost;
    double energy, time, length[MOST], origin[MOST], mass[MOST], couple, lost_from;
    term   potential[TERMS], heavy[TERMS], linear[TERMS];
} system_of;

static unsigned long long seed = 1;

static double uniform(double from, double to)
{
    seed = seed*6364136223846793005ull + 1442695040888963407ull;
    return from + (to - from)*(double)(seed >> 11)/9007199254740992.0;
}

static double decades(double most) { return pow(10, uniform(-most, most)); }

static number of(const term *f, const number *x)
{
    const number y = f->wave*x[f->i] + f->shift;
    switch (f->function) {
    case 0:  return f->size*sin(y);
    case 1:  return f->size*exp(-y*y);
    case 2:  return f->size/(1 + y*y);
    case 3:  return f->size*y*y/4;
    case 4:  return f->size*sqrt(1 + y*y);
    case 5:  return f->size*log(1 + y*y);
    case 6:  return f->size*tanh(y);
    case 7:  return f->size*atan(y)*cos(y);
    default: return f->size*y*y*y*y/16;
    }
}

static number value(number t, const number *q, const number *v, const void *user)
{
    const system_of *s = (const system_of *)user;
    number x[MOST + 1], u[MOST], kinetic = 0, rest = 0, L;
    for (int i = 0; i < s->n; ++i) {
        x[i] = (q[i] - s->origin[i])/s->length[i];
        u[i] = v[i]*s->time/s->length[i];
    }
    x[s->n] = t/s->time;
    for (int i = 0; i < s->n; ++i) {
        kinetic += s->mass[i]*u[i]*u[i]/2;
        if (i) kinetic += s->couple*sqrt(s->mass[i]*s->mass[i-1])*u[i]*u[i-1];
    }
    for (int k = 0; k < TERMS; ++k) {
        rest -= of(s->potential + k, x)*(k ? 1 : of(s->potential + 1, x));
        if (s->kind == LAGRANGIAN_MASS || s->kind == LAGRANGIAN_MASS_LINEAR) {
            const number factor = of(s->heavy + k, x);
            rest += factor*factor*u[k%s->n]*u[k%s->n];
        }
        if (s->kind == LAGRANGIAN_LINEAR || s->kind == LAGRANGIAN_MASS_LINEAR) rest += of(s->linear + k, x)*u[(k + 1)%s->n];
    }
    if (s->kind == LAGRANGIAN_GENERAL) rest += kinetic*kinetic/8;
    L = kinetic + rest;
    const double over = creal(x[0]) - s->lost_from;
    if (s->lost && over > 0) L -= over*over*over;
    return s->energy*L;
}

LAGRANGIAN(one, 1) { return value(t, q, v, user); }
LAGRANGIAN(two, 2) { return value(t, q, v, user); }
LAGRANGIAN(three, 3) { return value(t, q, v, user); }

static void some(term *f, int n)
{
    for (int k = 0; k < TERMS; ++k)
        f[k] = (term){ (int)uniform(0, 9), (int)uniform(0, n + (k == 2)), uniform(-1, 1), uniform(0.3, 2), uniform(-1, 1) };
}

static system_of draw(int kind)
{
    system_of s = { .n = 1 + (int)uniform(0, MOST), .kind = kind, .energy = decades(12), .time = decades(8), .couple = uniform(-0.4, 0.4),
                    .lost_from = 0.5 };
    for (int i = 0; i < s.n; ++i) {
        s.length[i] = decades(6);
        s.origin[i] = uniform(0, 1) < 0.5 ? 0 : s.length[i]*uniform(-1, 1)*pow(10, uniform(0, 6));
        s.mass[i] = uniform(1, 3);
    }
    some(s.potential, s.n);
    some(s.heavy, s.n);
    some(s.linear, s.n);
    s.heavy[0].i = s.linear[0].i = 0;
    s.heavy[0].size = s.linear[0].size = uniform(0.3, 1);
    return s;
}

static lagrangian L;
static gvi_stepper st;

/* NULL: refused.  The step at which it fails, or `steps`; x[0] there */
static const char *run(const system_of *s, int kind, int steps, int *at, double *x, double *before)
{
    static double memory[GVI_LENGTH(3, 8, 8) + 4096];
    const lagrangian_function functions[] = { one, two, three };
    double q[MOST], v[MOST];
    for (int i = 0; i < s->n; ++i) {
        q[i] = s->origin[i] + s->length[i]*(i ? uniform(-1, 1) : uniform(-0.3, 0.3));
        v[i] = s->length[i]/s->time*(i ? uniform(-1, 1) : uniform(0.7, 1));
    }
    *at = 0;
    const char *wrong = lagrangian_init(&L, functions[s->n - 1], s, 0, q, v);
    if (wrong) return wrong;
    if (kind) L.kind = (lagrangian_kind)kind;
    const gvi_effect effect = lagrangian_effect(&L);
    const gvi_desc desc = { .n = s->n, .degree = 8, .mass = lagrangian_mass(&L), .effects = &effect, .effect_count = 1 };
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    *before = *x = 0;
    for (; *at < steps && st.status == GVI_OK; ++*at) {
        *before = *x;
        gvi_step(&st, s->time/16);
        *x = (st.q[0] - s->origin[0])/s->length[0];
    }
    return NULL;
}

static int count, alarms, refused, simple, not_solved, most, late[4], unseen, at_start, not_reached;

static void right(int runs)
{
    int at;
    double x, before;
    for (int k = 0; k < runs; ++k) {
        const system_of s = draw(1 + k%5);
        const char *wrong = run(&s, 0, 40, &at, &x, &before);
        ++count;
        if (wrong) printf("refused (%d, %d): %s\n", k, s.kind, wrong), ++refused;
        else if (st.status == GVI_E_CALLBACK) printf("alarm (%d, %d): %s\n", k, s.kind, gvi_why(&st)), ++alarms;
        else if (st.status != GVI_OK) ++not_solved;
        if (!wrong && L.kind != (lagrangian_kind)s.kind) L.kind < (lagrangian_kind)s.kind ? ++simple : ++most;
    }
    printf("%d right: %d refused, %d false alarms, %d found too simple, %d too general, %d where a step has no solution\n", count,
           refused, alarms, simple, most, not_solved);
}

static void forced(int runs)
{
    int at;
    double x, before;
    count = unseen = refused = 0;
    memset(late, 0, sizeof late);
    for (int k = 0; k < runs; ++k) {
        static const int kinds[][2] = { { 2, 1 }, { 3, 1 }, { 4, 1 }, { 4, 2 }, { 4, 3 }, { 5, 1 }, { 3, 2 }, { 2, 3 } };
        const system_of s = draw(kinds[k%8][0]);
        if (run(&s, kinds[k%8][1], 16, &at, &x, &before)) { ++refused; continue; }
        ++count;
        if (st.status != GVI_E_CALLBACK) printf("unseen (%d): %d as %d, %s\n", k, s.kind, kinds[k%8][1], gvi_why(&st)), ++unseen;
        else ++late[at > 3 ? 3 : at - 1];
    }
    printf("%d of a kind too small: %d seen in the first step, %d in the second, %d in the third, %d later, %d not in 16\n", count,
           late[0], late[1], late[2], late[3], unseen);
}

static void lost(int runs)
{
    int at;
    double x, before;
    count = unseen = refused = at_start = not_reached = 0;
    memset(late, 0, sizeof late);
    for (int k = 0; k < runs; ++k) {
        system_of s = draw(1 + k%5);
        s.lost = 1;
        s.lost_from = uniform(0.5, 3);
        if (run(&s, 0, 64, &at, &x, &before)) { ++at_start; continue; }
        if (st.status != GVI_E_CALLBACK && x < s.lost_from + 0.25) { ++not_reached; continue; }
        ++count;
        if (st.status != GVI_E_CALLBACK) printf("unseen (%d): kind %d, x %g, %s\n", k, s.kind, x, gvi_why(&st)), ++unseen;
        else if (x < s.lost_from) ++late[0];
        else ++late[x - s.lost_from < 0.25 ? 1 : x - s.lost_from < 0.5 ? 2 : 3];
    }
    printf("%d lost from a place on: %d seen before it is reached (by lagrangian_init), %d go less than 1/4 beyond it; of %d, %d seen in the "
           "step over it, %d within 1/4 length (4 steps), %d within 1/2, %d later, %d not\n", runs, at_start, not_reached, count, late[0],
           late[1], late[2], late[3], unseen);
}

int main(int argc, char **argv)
{
    const double factor = argc > 1 ? atof(argv[1]) : 1;
    right((int)(10000*factor));
    forced((int)(1000*factor));
    lost((int)(1000*factor));
    return simple > 0;
}
