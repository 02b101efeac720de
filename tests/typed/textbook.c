/* textbook.c - is it enough to type L?  Systems of systems.h, in C and in C++, against another method

   Reference: Gragg's extrapolation of the equations of motion derived by hand, in long double, of order 16; where there
   is a solution in closed form, that judges the reference.  Bound: each of N steps rounds each number of the state by
   ULPS, the errors walk, and each grows until T as the motion beside it does, which the reference shows.
   textbook; textbook show prints each error. */
#include "gvi.h"
#include "tools/lagrangian.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

typedef long double wide;
#include "systems.h"

enum { MOST = 6, COLUMNS = 8, ULPS = 2 };      /* of rounding in a step */
typedef void motion(wide t, const wide *q, const wide *v, wide *a);
typedef struct system_of {
    const char         *name;
    lagrangian_function L;
    motion             *by_hand;
    void              (*exact)(wide t, wide *q);
    lagrangian_kind     kind;
    double              T;
    int                 steps;
    double              q[MOST], v[MOST];
} system_of;

#define LIST(...) { __VA_ARGS__ }
#define WITHOUT(name, kind, T, steps, q, v) { #name, name, name##_by_hand, NULL, LAGRANGIAN_##kind, T, steps, q, v },
#define WITH(name, kind, T, steps, q, v) { #name, name, name##_by_hand, name##_exact, LAGRANGIAN_##kind, T, steps, q, v },

/* -- the reference */

static void slope(const system_of *s, wide t, const wide *z, wide *dz)
{
    const int n = s->L.n;
    for (int i = 0; i < n; ++i) dz[i] = z[n + i];
    s->by_hand(t, z, z + n, dz + n);
}

/* The modified midpoint rule in 2j substeps: by how much z changes */
static void midpoint(const system_of *s, wide t, const wide *z, wide H, int j, wide *change)
{
    const int n = 2*s->L.n, parts = 2*j;
    const wide h = H/parts;
    wide before[2*MOST] = { 0 }, now[2*MOST], at[2*MOST], dz[2*MOST];
    slope(s, t, z, dz);
    for (int i = 0; i < n; ++i) now[i] = h*dz[i];
    for (int p = 1; p <= parts; ++p) {
        for (int i = 0; i < n; ++i) at[i] = z[i] + now[i];
        slope(s, t + p*h, at, dz);
        for (int i = 0; i < n && p < parts; ++i) {
            const wide next = before[i] + 2*h*dz[i];
            before[i] = now[i];
            now[i] = next;
        }
    }
    for (int i = 0; i < n; ++i) change[i] = (before[i] + now[i] + h*dz[i])/2;
}

/* From z to the state at T; largest[] of each number on the way */
static void reference(const system_of *s, wide *z, wide *largest)
{
    const int n = 2*s->L.n;
    const wide H = (wide)s->T/s->steps;
    wide row[COLUMNS][2*MOST];
    for (int p = 0; p < s->steps; ++p) {
        for (int j = 1; j <= COLUMNS; ++j) {
            midpoint(s, p*H, z, H, j, row[j-1]);
            for (int c = j - 1; c > 0; --c)
                for (int i = 0; i < n; ++i) row[c-1][i] = row[c][i] + (row[c][i] - row[c-1][i])/((wide)(j*j)/(c*c) - 1);
        }
        for (int i = 0; i < n; ++i) {
            z[i] += row[0][i];
            if (largest && fabsl(z[i]) > largest[i]) largest[i] = fabsl(z[i]);
        }
    }
}

/* z at T, and how much what is rounded in each number, by 1 of its largest size, changes of each number at T */
static void with_growth(const system_of *s, const wide *start, wide *z, wide *growth)
{
    const int n = 2*s->L.n;
    wide largest[2*MOST], moved[2*MOST];
    for (int i = 0; i < n; ++i) {
        z[i] = start[i];
        largest[i] = fabsl(z[i]);
    }
    reference(s, z, largest);
    for (int i = 0; i < n; ++i) growth[i] = largest[i];
    for (int d = 0; d < n; ++d) {
        const wide change = largest[d]/1048576;
        if (!(change > 0)) continue;
        for (int i = 0; i < n; ++i) moved[i] = start[i];
        moved[d] += change;
        reference(s, moved, NULL);
        for (int i = 0; i < n; ++i) growth[i] += fabsl(moved[i] - z[i])/change*largest[d];
    }
}

/* -- from L alone */

static const char *from_l(const system_of *s, gvi_real *q, gvi_real *v, lagrangian_kind *kind)
{
    static lagrangian L;
    static gvi_real memory[20000];
    gvi_stepper st;
    gvi_desc desc;
    const char *wrong = lagrangian_init(&L, s->L, NULL, 0, q, v);
    if (wrong) return wrong;
    *kind = L.kind;
    const gvi_effect effect = lagrangian_effect(&L);
    memset(&desc, 0, sizeof desc);
    desc.n = s->L.n;
    desc.degree = sizeof(gvi_real) > sizeof(double) ? 10 : 8;
    desc.mass = lagrangian_mass(&L);
    desc.effects = &effect;
    desc.effect_count = 1;
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_start(&st, 0, q, v);
    for (int i = 0; i < s->steps && st.status == GVI_OK; ++i) gvi_step(&st, (gvi_real)(s->T/s->steps));
    if (st.status == GVI_OK) gvi_velocity(&st, v);
    for (int i = 0; i < desc.n; ++i) q[i] = st.q[i];
    return st.status == GVI_OK ? NULL : strcpy(L.why, gvi_why(&st));
}

/* By how much the extrapolation multiplies what rounds its rows */
static wide weights(void)
{
    wide sum = 0;
    for (int j = 1; j <= COLUMNS; ++j) {
        wide weight = 1;
        for (int i = 1; i <= COLUMNS; ++i)
            if (i != j) weight *= (wide)(j*j)/(j*j - i*i);
        sum += fabsl(weight);
    }
    return sum;
}

/* The largest error as a part of its bound */
static wide judge(const system_of *s, const char **wrong, wide *closed, lagrangian_kind *kind)
{
    const int n = s->L.n;
    gvi_real q[MOST], v[MOST];
    wide start[2*MOST], z[2*MOST], growth[2*MOST], exact[MOST], worst = 0;
    for (int i = 0; i < n; ++i) {
        start[i] = q[i] = (gvi_real)s->q[i];
        start[n + i] = v[i] = (gvi_real)s->v[i];
    }
    with_growth(s, start, z, growth);
    *wrong = from_l(s, q, v, kind);
    const wide walk = ULPS*sqrtl(s->steps), own = walk*weights()*LDBL_EPSILON, bound = walk*lagrangian_eps() + own;
    for (int i = 0; i < n && !*wrong; ++i) {
        worst = fmaxl(worst, fabsl(q[i] - z[i])/(bound*growth[i]));
        worst = fmaxl(worst, fabsl(v[i] - z[n + i])/(bound*growth[n + i]));
    }
    *closed = 0;
    if (s->exact) s->exact(s->T, exact);
    for (int i = 0; i < n && s->exact; ++i) *closed = fmaxl(*closed, fabsl(z[i] - exact[i])/(own*growth[i]));
    return worst;
}

int main(int argc, char **argv)
{
    const system_of systems[] = { SYSTEMS(WITHOUT, WITH) };
    const int count = (int)(sizeof systems/sizeof systems[0]), show = argc > 1 && !strcmp(argv[1], "show");
    int failed = 0;
    for (int i = 0; i < count; ++i) {
        const char *wrong;
        wide closed;
        lagrangian_kind kind = LAGRANGIAN_REFUSED;
        const wide part = judge(systems + i, &wrong, &closed, &kind);
        const int right = !wrong && part <= 1 && closed <= 1 && kind == systems[i].kind;
        if (!right || show)
            printf("%-24s %-28s error %.3Lf, reference %.3Lf of the bound%s%s%s\n", systems[i].name,
                   lagrangian_kind_text(kind), part, closed, wrong ? ": " : "", wrong ? wrong : "", right ? "" : " WRONG");
        failed += !right;
    }
    printf("textbook: %d passed, %d failed\n", count - failed, failed);
    return failed > 0;
}
