/* 05 - The outer solar system from a file, over 200,000 days

   Gravity acts between all pairs.  How many bodies there are is known only when
   the file has been read, so the caller allocates what gvi_size says.  The system
   runs with a quarter, half and all of the degree; energy errors are level lines.

   05_outer_solar_system [days [step [degree [directory for the pictures]]]]
   prints, errors rounded up to a power of 10 (with an argument, as measured),

     6 bodies, 200000 days in steps of 200, degree 8
     relative error of the energy, never above: 1e-14
     against the 25-digit end state, AU:        1e-11
     pictures: build/orbits.svg build/energy.svg
*/
#define _POSIX_C_SOURCE 200809L  /* isatty */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include <stdlib.h>
#include <unistd.h>

enum { BODIES = 32, POINTS = 1000, RUNS = 3 };
typedef struct bodies {
    int n; char name[BODIES][16]; double gm[BODIES], mass[3*BODIES], q[3*BODIES], v[3*BODIES];
} bodies;
typedef struct trace { double x[BODIES][POINTS], y[BODIES][POINTS], t[64], error[64], worst; int orbit, count; } trace;

/* Two bodies, all points.  `restrict`: rows do not overlap, so the loop is made of vectors. */
static void pull(int count, int d, const double *restrict a, const double *restrict c, double *restrict f,
                 double *restrict g, double mm)
{
    for (int k = 0; k < count; ++k) {
        double u = c[k] - a[k], v = c[d+k] - a[d+k], w = c[2*d+k] - a[2*d+k], r2 = u*u + v*v + w*w, s = mm/(r2*sqrt(r2));
        f[k] += s*u;  f[d+k] += s*v;  f[2*d+k] += s*w;
        g[k] -= s*u;  g[d+k] -= s*v;  g[2*d+k] -= s*w;
    }
}

/* Both in one: the potential if x->value is wanted, else the force.           */
static int gravity(const gvi_points *x, void *user)
{
    const bodies *b = user;
    const int d = x->stride;
    for (int i = 1; i < b->n; ++i)
        for (int j = 0; j < i; ++j) {
            const double *a = x->q + 3*i*d, *c = x->q + 3*j*d, mm = b->gm[i]*b->gm[j];
            if (!x->value) pull(x->count, d, a, c, x->f + 3*i*d, x->f + 3*j*d, mm);
            for (int k = 0; k < x->count && x->value; ++k) {
                double u = c[k] - a[k], v = c[d+k] - a[d+k], w = c[2*d+k] - a[2*d+k];
                x->value[k] -= mm/sqrt(u*u + v*v + w*w);
            }
        }
    return 0;
}

static int read_bodies(const char *path, bodies *b)
{
    char line[512];
    double G = 0, m;
    FILE *file = fopen(path, "r");
    while (file && b->n < BODIES && fgets(line, sizeof line, file)) {
        double *q = b->q + 3*b->n, *v = b->v + 3*b->n;
        if (line[0] == '#' || sscanf(line, "G %lf", &G) == 1) continue;
        if (sscanf(line, "%15s %lf %lf %lf %lf %lf %lf %lf", b->name[b->n], &m, q, q+1, q+2, v, v+1, v+2) == 8)
            b->gm[b->n++] = G*m;
    }
    for (int i = 0; i < 3*b->n; ++i) b->mass[i] = b->gm[i/3];
    return file ? fclose(file) : -1;
}

/* From b to the end state in q; what is to be drawn in out.                   */
static gvi_status integrate(bodies *b, int degree, double days, double h, trace *out, double *q)
{
    const gvi_effect effect = { .kind = GVI_POTENTIAL, .points = gravity, .value = gravity, .user = b };
    const gvi_desc desc = { .n = 3*b->n, .degree = degree, .effects = &effect, .effect_count = 1,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = b->mass } };
    const long steps = lround(days/h), block = (steps + 39)/40, show = steps > 100000 && isatty(2) ? steps/100 : 0;
    double *memory = malloc(gvi_size(&desc)), e0 = 0, e = 0, high = 0;
    gvi_stepper st;
    if (!gvi_init(&st, &desc, memory, gvi_size(&desc)) && !gvi_start(&st, 0, b->q, b->v)) gvi_energy(&st, &e0);
    for (long k = 1; k <= steps && !st.status && !gvi_step(&st, h) && !gvi_energy(&st, &e); ++k) {
        high = fmax(high, fabs((e - e0)/e0));
        for (int i = 0; i < b->n && k <= POINTS; ++i, out->orbit = (int)k) {  // from the Sun, turned into the ecliptic
            out->x[i][k-1] = st.q[3*i] - st.q[0];
            out->y[i][k-1] = 0.917482*(st.q[3*i+1] - st.q[1]) + 0.397777*(st.q[3*i+2] - st.q[2]);
        }
        if (show && k % show == 0) fprintf(stderr, "\rdegree %d: %3ld %%%s", degree, k/show, k == steps ? "\n" : "");
        out->worst = fmax(out->worst, high);
        if (k % block) continue;
        out->t[out->count] = out->count ? st.t/365.25 : 0;
        out->error[out->count++] = high, high = 0;
    }
    if (st.status) fprintf(stderr, "t = %g: %s\n", st.t, gvi_why(&st));
    for (int i = 0; i < desc.n && !st.status; ++i) q[i] = st.q[i];
    free(memory);
    return st.status;
}

static double figure(double error, double least, int measured)
{
    return measured ? error : pow(10, ceil(log10(fmax(error, least))));
}

int main(int argc, char **argv)
{
    static bodies b, end;
    static trace out[RUNS];
    const double days = argc > 1 ? atof(argv[1]) : 200000, h = argc > 2 ? atof(argv[2]) : 200;
    const int top = argc > 3 ? atoi(argv[3]) : 8, degree[RUNS] = { (top + 3)/4, (top + 1)/2, top };
    char path[2][256], name[RUNS][16], title[64];
    double q[3*BODIES], miss = 0;
    const char *colours[BODIES] = { NULL };
    svg_line orbit[BODIES], level[RUNS];
    svg_plot orbits = { .title = title, .x_label = "AU", .y_label = "AU", .equal = 1,
                        .lines = orbit, .colours = colours };
    const svg_plot energy = { .title = "Error of the energy", .x_label = "years", .y_label = "|E - E(0)| / |E(0)|",
                              .log_y = 1, .lines = level, .line_count = RUNS };
    if (read_bodies("examples/outer_solar_system.txt", &b)) return perror("examples/outer_solar_system.txt"), 1;
    printf("%d bodies, %g days in steps of %g, degree %d\n", b.n, days, h, top);
    for (int i = 0; i < RUNS; ++i) {
        if (integrate(&b, degree[i], days, h, &out[i], q)) return 1;
        snprintf(name[i], sizeof name[i], "degree %d", degree[i]);
        level[i] = (svg_line){ name[i], out[i].t, out[i].error, out[i].count };
    }
    printf("relative error of the energy, never above: %.2g\n", figure(out[RUNS-1].worst, 2e-15, argc > 1));
    if (fabs(days - 200000) < 1 && !read_bodies("examples/outer_solar_system_reference.txt", &end)) {
        for (int i = 0; i < 3*b.n; ++i) miss = fmax(miss, fabs(q[i] - end.q[i]));
        printf("against the 25-digit end state, AU:        %.2g\n", figure(miss, 2e-12, argc > 1));
    }
    for (int i = 1; i < b.n; ++i)
        orbit[orbits.line_count++] = (svg_line){ b.name[i], out[RUNS-1].x[i], out[RUNS-1].y[i], out[RUNS-1].orbit };
    snprintf(title, sizeof title, "Outer solar system over %.0f years", days/365.25);
    colours[orbits.line_count - 1] = "#444444";                 // Pluto, unlike the Sun
    colours[orbits.line_count] = "#e69f00";
    orbit[orbits.line_count++] = (svg_line){ b.name[0], out[RUNS-1].x[0], out[RUNS-1].y[0], 1 };
    snprintf(path[0], sizeof path[0], "%s/orbits.svg", argc > 4 ? argv[4] : "build");
    snprintf(path[1], sizeof path[1], "%s/energy.svg", argc > 4 ? argv[4] : "build");
    if (svg_write(path[0], &orbits) || svg_write(path[1], &energy)) return perror(path[0]), 1;
    printf("pictures: %s %s\n", path[0], path[1]);
}
