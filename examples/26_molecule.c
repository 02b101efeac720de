/* 26 - A molecule from a file: butane

   butane.txt holds four atoms with three digits, as such files do, five distances that are to be
   held, and a torsion. A start must fulfil its constraints to rounding: gvi_project takes q and v
   to the nearest that do, by the masses, and says how far that is; the largest shift of an atom
   here is what three digits explain, so the file is right. (A wrong line shows as a large one.)

   Units: nm, ps, u; energies then come out in kJ/mol. Bonds and angles do not vibrate, so steps of
   10 fs at degree 4 are short. At this energy the chain turns about its middle bond, from gauche
   over the barrier to trans and on.

   prints

     butane.txt: 4 atoms, 5 distances held, off by 0.00066 nm at most
     gvi_project: moved by 0.00037 nm at most
     energy 57.98 kJ/mol, its error in 20 ps below 1e-6: yes
     distances held to 1e-14 of themselves, momentum to 1e-11: yes
     trans for the first time after 0.23 ps, and for a fifth of the time or more: yes
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ATOMS = 4, HELD = 5, N = 3*ATOMS };

typedef struct molecule {
    int    atoms, held, first[HELD], second[HELD];
    double mass[N], q[N], length[HELD], torsion[6];
} molecule;

static int read_molecule(const char *path, molecule *m)
{
    char line[200], name[16];
    FILE *file = fopen(path, "r");
    if (!file) return perror(path), 1;
    while (fgets(line, sizeof line, file)) {
        double *q = m->q + 3*m->atoms, *C = m->torsion, mass;
        if (m->atoms < ATOMS && sscanf(line, "atom %15s %lf %lf %lf %lf", name, &mass, q, q + 1, q + 2) == 5) {
            for (int i = 0; i < 3; ++i) m->mass[3*m->atoms + i] = mass;
            m->atoms += 1;
        }
        if (m->held < HELD && sscanf(line, "hold %d %d %lf", m->first + m->held, m->second + m->held, m->length + m->held) == 3)
            m->held += 1;
        sscanf(line, "torsion %lf %lf %lf %lf %lf %lf", C, C + 1, C + 2, C + 3, C + 4, C + 5);
    }
    fclose(file);
    return m->atoms != ATOMS || m->held != HELD;
}

static int hold(const gvi_points *x, void *user)
{
    const molecule *m = user;
    const int R = x->stride;
    for (int a = 0; a < m->held; ++a) {
        const int first = 3*(m->first[a] - 1), second = 3*(m->second[a] - 1);
        double *G = x->jacobian + a*x->n*R;
        for (int k = 0; k < x->count; ++k) x->g[a*R + k] = -m->length[a]*m->length[a]/2;
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < x->count; ++k) {
                const double d = x->q[(second + i)*R + k] - x->q[(first + i)*R + k];
                x->g[a*R + k] += d*d/2;
                G[(second + i)*R + k] = d;
                G[(first + i)*R + k] = -d;
            }
    }
    return 0;
}

static void cross(const double *a, const double *b, double *c)
{
    for (int i = 0; i < 3; ++i) c[i] = a[(i + 1)%3]*b[(i + 2)%3] - a[(i + 2)%3]*b[(i + 1)%3];
}

static double dot(const double *a, const double *b) { return a[0]*b[0] + a[1]*b[1] + a[2]*b[2]; }

/* The normals u, w of the planes of atoms 1 2 3 and 2 3 4, of unit length; returns the cosine of the
   angle between them: -1 where the chain is stretched out (trans) */
static double planes(double bond[3][3], double *u, double *w, double *length)
{
    cross(bond[0], bond[1], u);
    cross(bond[1], bond[2], w);
    length[0] = sqrt(dot(u, u));
    length[1] = sqrt(dot(w, w));
    for (int i = 0; i < 3; ++i) u[i] /= length[0], w[i] /= length[1];
    return dot(u, w);
}

static double bonds_and_planes(const double *q, int stride, double bond[3][3], double *u, double *w, double *length)
{
    for (int b = 0; b < 3; ++b)
        for (int i = 0; i < 3; ++i) bond[b][i] = q[(3*b + 3 + i)*stride] - q[(3*b + i)*stride];
    return planes(bond, u, w, length);
}

/* V(c), c = -cos phi. With left = dV/d(b1 x b2) and right = dV/d(b2 x b3), dV is
   left . (db1 x b2 + b1 x db2) + right . (db2 x b3 + b2 x db3) */
static int torsion(const gvi_points *x, void *user)
{
    const double *C = ((const molecule *)user)->torsion;
    const int R = x->stride;
    for (int k = 0; k < x->count; ++k) {
        double bond[3][3], u[3], w[3], length[2], V = 0, slope = 0, along[3][3], left[3], right[3];
        const double c = -bonds_and_planes(x->q + k, R, bond, u, w, length);
        for (int j = 5; j >= 0; --j) slope = slope*c + V, V = V*c + C[j];       // Horner
        if (x->value) x->value[k] += V;
        if (!x->f) continue;
        for (int i = 0; i < 3; ++i) {
            left[i] = -slope*(w[i] + c*u[i])/length[0];
            right[i] = -slope*(u[i] + c*w[i])/length[1];
        }
        cross(bond[1], left, along[0]);                       // dV/d(bond)
        cross(left, bond[0], along[1]);
        cross(bond[2], right, along[2]);
        for (int i = 0; i < 3; ++i) along[1][i] += along[2][i];
        cross(right, bond[1], along[2]);
        for (int b = 0; b < 3; ++b)
            for (int i = 0; i < 3; ++i) {
                x->f[(3*b + 3 + i)*R + k] -= along[b][i];
                x->f[(3*b + i)*R + k] += along[b][i];
            }
    }
    return 0;
}

/* The largest |distance - length| of those held, in nm or relative */
static double off(const molecule *m, const double *q, int relative)
{
    double worst = 0;
    for (int a = 0; a < m->held; ++a) {
        const double *x = q + 3*(m->first[a] - 1), *y = q + 3*(m->second[a] - 1);
        const double d[3] = { y[0] - x[0], y[1] - x[1], y[2] - x[2] }, miss = fabs(sqrt(dot(d, d)) - m->length[a]);
        worst = fmax(worst, relative ? miss/m->length[a] : miss);
    }
    return worst;
}

int main(void)
{
    static molecule m;
    static double memory[GVI_CONSTRAINED_LENGTH(N, 4, 5, HELD)];
    if (read_molecule("examples/butane.txt", &m)) return 1;
    const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = torsion, .value = torsion, .user = &m },
                                 { .kind = GVI_CONSTRAINT, .points = hold, .rows = HELD, .user = &m } };
    const gvi_desc desc = { .n = N, .degree = 4, .effects = scene, .effect_count = 2, .rule.kind = GVI_LOBATTO,
                            .mass = { .kind = GVI_MASS_DIAGONAL, .matrix = m.mass } };
    gvi_stepper st;
    double q[N], v[N], E, E0, shift = 0, p[3] = { 0 }, p0[3] = { 0 };
    memcpy(q, m.q, sizeof q);
    for (int i = 0; i < N; ++i) v[i] = 2*sin(1 + 2.3*i);      // any velocities; gvi_project makes them possible
    for (int i = 0; i < N; ++i) p0[i % 3] += m.mass[i]*v[i]/(2*(15.035 + 14.027));
    for (int i = 0; i < N; ++i) v[i] -= p0[i % 3];            // at rest as a whole, and so it stays
    printf("butane.txt: %d atoms, %d distances held, off by %.5f nm at most\n", m.atoms, m.held, off(&m, q, 0));
    gvi_init(&st, &desc, memory, sizeof memory);
    gvi_project(&st, 0, q, v, NULL);
    for (int a = 0; a < ATOMS; ++a) {
        const double d[3] = { q[3*a] - m.q[3*a], q[3*a + 1] - m.q[3*a + 1], q[3*a + 2] - m.q[3*a + 2] };
        shift = fmax(shift, sqrt(dot(d, d)));
    }
    printf("gvi_project: moved by %.5f nm at most\n", shift);
    gvi_start(&st, 0, q, v);
    gvi_energy(&st, &E0);
    double worst = 0, held = 0;
    int steps = 0, trans = 0;
    double first = 0;
    for (; steps < 2000 && st.status == GVI_OK; ++steps) {
        double bond[3][3], u[3], w[3], length[2];
        gvi_step(&st, 0.01);
        const double c = bonds_and_planes(st.q, 1, bond, u, w, length);
        if (c < -0.5 && !trans++) first = st.t;
        held = fmax(held, off(&m, st.q, 1));
        gvi_energy(&st, &E);
        worst = fmax(worst, fabs(E - E0));
    }
    for (int i = 0; i < N; ++i) p[i % 3] += st.p[i];
    const double push = fabs(p[0]) + fabs(p[1]) + fabs(p[2]);
    printf("energy %.2f kJ/mol, its error in 20 ps below 1e-6: %s\n", E0, worst < 1e-6 ? "yes" : "no");
    printf("distances held to 1e-14 of themselves, momentum to 1e-11: %s\n", held < 1e-14 && push < 1e-11 ? "yes" : "no");
    printf("trans for the first time after %.2f ps, and for a fifth of the time or more: %s\n", first, 5*trans > steps ? "yes" : "no");
    return st.status != GVI_OK;
}
