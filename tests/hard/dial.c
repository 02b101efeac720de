/* dial.c - how near st.resolution is to the error of a step (docs/design.md)

   Orbits, a double pendulum with M(q), drag, a magnetic field, Fermi, Pasta and Ulam's chain, rods, tops, in
   long double: from four states each, steps of twice to 1/400 of a period at degrees 3 to 16, against
   the same in 14 steps of degree 16.  The error is that of each coordinate's path over h and of its
   velocity, over the largest velocity at both ends and in the middle.                        */
#define GVI_REAL long double
#include "hard.h"
#include "../problems.h"
#include "../linkages.h"

typedef struct { const char *name; gvi_desc desc; real q[MOST_N], v[MOST_N], period; } problem;

static int air(const gvi_points *x, void *user)
{
    const int s = x->stride;
    for (int k = 0; k < x->count; ++k) {
        const real speed = sqrt(x->v[k]*x->v[k] + x->v[s + k]*x->v[s + k]);
        x->f[k] -= speed*x->v[k]/2;
        x->f[s + k] -= speed*x->v[s + k]/2 + 1;
    }
    return (void)user, 0;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static real *begin(gvi_stepper *st, const gvi_desc *desc)
{
    const size_t size = gvi_size(desc);
    real *memory = malloc(size + 1);
    must(gvi_init(st, desc, memory, size));
    return memory;
}

/* The error of a step, or -1 where there is no reference */
static double error_of(gvi_stepper *st, const problem *p, real t, real h, const real *q, const real *momentum)
{
    gvi_desc fine = p->desc;
    fine.degree = 16;
    fine.resolution = 1e-15L;
    gvi_stepper to;
    real *memory = begin(&to, &fine), a[MOST_N], b[MOST_N], m[MOST_N], v0[MOST_N];
    double worst = 0;
    int failed = gvi_start_momentum(&to, t, q, momentum) || gvi_velocity(&to, v0);
    for (int k = 0; k < 14 && !failed; ++k) failed = gvi_step(&to, h/14) != GVI_OK;
    failed = failed || gvi_velocity(&to, b) || gvi_velocity(st, a) || gvi_curve(st, 0.5L, NULL, m);
    for (int i = 0; i < st->n && !failed; ++i) {
        const real size = fmax(fabs(v0[i]), fmax(fabs(b[i]), fabs(m[i]))) + 1e-15L;
        worst = fmax(worst, (double)(fmax(fabs(a[i] - b[i]), fabs(st->q[i] - to.q[i])/h)/size));
    }
    free(memory);
    return failed ? -1 : worst;
}

int main(void)
{
    static const int degrees[] = { 3, 4, 5, 6, 7, 8, 10, 12, 16 };
    static const linkage_id linked[] = { SPHERE, RODS, FRICTION, MAGNET, DIRECTORS, QUATERNION };
    static real omega = 50;
    static double ratio[COUNT(degrees)][20000];
    int seen[COUNT(degrees)] = { 0 };
    static gvi_effect orbit[] = { { .kind = GVI_POTENTIAL, .points = attraction }, { .kind = GVI_LAGRANGIAN, .point = field } };
    static gvi_effect swing[] = { { .kind = GVI_POTENTIAL, .point = weights } }, flight[] = { { .kind = GVI_FORCE, .points = air } };
    static gvi_effect chain[] = { { .kind = GVI_POTENTIAL, .points = fermi_pasta_ulam_forces, .user = &omega } };
    problem list[6 + COUNT(linked)] = {
        { "orbit, e = 0.6", { .n = 2, .effects = orbit, .effect_count = 1 }, { 0.4L }, { 0, 2 }, 6.28L },
        { "orbit, e = 0.9", { .n = 2, .effects = orbit, .effect_count = 1 }, { 0.1L }, { 0, 4.35889894354067L }, 6.28L },
        { "in a field", { .n = 2, .effects = orbit, .effect_count = 2 }, { 1 }, { 0, 1.1L }, 6.28L },
        { "double pendulum", { .n = 2, .effects = swing, .effect_count = 1, .mass = { .kind = GVI_MASS_POSITION,
          .points = pendulum_mass, .gradient = pendulum_mass_gradient } }, { 2, 1 }, { 0.1L }, 6.28L },
        { "air drag", { .n = 2, .effects = flight, .effect_count = 1 }, { 0 }, { 2, 3 }, 3 },
        { "chain", { .n = 6, .effects = chain, .effect_count = 1 }, { 1, 0, 0, 0.02L }, { 1, 0, 0, 1 }, 0.1256L } };
    static linkage links[COUNT(linked)];
    for (int i = 0; i < COUNT(linked); ++i) {
        problem *p = list + 6 + i;
        links[i] = make_linkage(linked[i]);
        p->name = "linkage";
        p->desc = linkage_desc(links + i, 0);
        p->period = linked[i] >= DIRECTORS && linked[i] <= QUATERNION ? 1.2L : 6;
        memcpy(p->q, links[i].q, sizeof p->q);
        memcpy(p->v, links[i].v, sizeof p->v);
    }
    for (int a = 0; a < COUNT(list); ++a) {
        problem *p = list + a;
        gvi_desc along = p->desc;
        along.degree = 12;
        gvi_stepper st, at;
        real *memory = begin(&st, &along);
        must(gvi_start(&st, 0, p->q, p->v));
        for (int state = 0; state < 4; ++state) {
            for (int k = 0; k < 9; ++k) must(gvi_step(&st, p->period/40));
            for (int d = 0; d < COUNT(degrees); ++d) {
                p->desc.degree = degrees[d];
                p->desc.resolution = 0.999L;
                real *own = begin(&at, &p->desc);
                for (real h = 2*p->period; h > p->period/400; h /= 1.7L) {
                    must(gvi_start_momentum(&at, st.t, st.q, st.p));
                    if (gvi_step(&at, h) != GVI_OK || at.resolution > 1e-3L || at.resolution < 1e-15L) continue;
                    const double error = error_of(&at, p, st.t, h, st.q, st.p);
                    if (error >= 0) ratio[d][seen[d]++] = log10(fmax(error, 1e-18)/(double)at.resolution);
                }
                free(own);
            }
        }
        free(memory);
    }
    for (int d = 0; d < COUNT(degrees); ++d) {
        double *x = ratio[d];
        qsort(x, (size_t)seen[d], sizeof *x, compare);
        printf("degree %d: %d steps, log10(error/resolution)\n", degrees[d], seen[d]);
        expect("median", -4, x[seen[d]/2], 0);
        expect("one in fifty is above", -2, x[seen[d]*98/100], 2);
        expect("largest", -2, x[seen[d] - 1], 3);
    }
    return verdict("dial");
}
