/* planets.h - the outer solar system of brouwer.c, drift.c and long.c: six bodies, masses times G */
#ifndef HARD_PLANETS_H
#define HARD_PLANETS_H

#include "hard.h"
#include "problems.h"

enum { BODIES = 6 };
static real gm[BODIES], mass_of[3*BODIES];

static int gravity(const gvi_points *x, void *user)
{
    const int d = x->stride;
    for (int i = 1; i < BODIES; ++i)
        for (int j = 0; j < i; ++j)
            for (int k = 0; k < x->count; ++k) {
                const real *a = x->q + 3*i*d + k, *c = x->q + 3*j*d + k;
                const real u = c[0] - a[0], v = c[d] - a[d], w = c[2*d] - a[2*d];
                const real r2 = u*u + v*v + w*w, s = gm[i]*gm[j]/(r2*sqrt(r2));
                real *f = x->f + 3*i*d + k, *g = x->f + 3*j*d + k;
                f[0] += s*u;  f[d] += s*v;  f[2*d] += s*w;
                g[0] -= s*u;  g[d] -= s*v;  g[2*d] -= s*w;
            }
    return 0;
}

HARD_MAYBE long double planets_energy(const long double *q, const long double *p)
{
    long double E = 0;
    for (int i = 0; i < BODIES; ++i) {
        const long double *a = q + 3*i, *u = p + 3*i;
        E += (u[0]*u[0] + u[1]*u[1] + u[2]*u[2])/(2*(long double)mass_of[3*i]);
        for (int j = 0; j < i; ++j) {
            const long double *c = q + 3*j, x = a[0] - c[0], y = a[1] - c[1], z = a[2] - c[2];
            E -= (long double)(gm[i]*gm[j])/sqrtl(x*x + y*y + z*z);
        }
    }
    return E;
}

/* examples/outer_solar_system.txt, moved to the centre of mass; sets gm and mass_of */
static void read_planets(real *q, real *p)
{
    double G = 0, m, x[6], centre[6] = { 0 }, all[BODIES][6], total = 0;
    char line[512];
    int n = 0;
    FILE *file = fopen("examples/outer_solar_system.txt", "r");
    while (file && n < BODIES && fgets(line, sizeof line, file)) {
        if (line[0] == '#' || sscanf(line, "G %lf", &G) == 1) continue;
        if (sscanf(line, "%*s %lf %lf %lf %lf %lf %lf %lf", &m, x, x + 1, x + 2, x + 3, x + 4,
                   x + 5) != 7) continue;
        gm[n] = (real)(G*m);
        memcpy(all[n], x, sizeof x);
        for (int i = 0; i < 6; ++i) centre[i] += (double)gm[n]*x[i];
        total += (double)gm[n++];
    }
    if (!file || n < BODIES) {
        printf("  FAILED: examples/outer_solar_system.txt cannot be read\n");
        exit(1);
    }
    fclose(file);
    for (int i = 0; i < 3*BODIES; ++i) {
        mass_of[i] = gm[i/3];
        q[i] = (real)(all[i/3][i%3] - centre[i%3]/total);
        p[i] = mass_of[i]*(real)(all[i/3][3 + i%3] - centre[3 + i%3]/total);
    }
}

#endif
