/* 32 - How do I run ten thousand orbits? Threads, and a cluster

   Where is a motion regular, and where chaotic? An orbit from each point of a grid says it, and
   the orbits do not know of each other. gvi.h keeps nothing outside of a stepper and its array,
   so an orbit is a function that has both on its stack: any thread of any process can run it,
   and its numbers are the same to the last bit. tools/ensemble.h shares the orbits out, in
   chunks to whoever is free, and gathers the results in order:

     cc 32_ensemble.c -lm                              one after the other
     cc -fopenmp 32_ensemble.c -lm                     on all cores of this machine
     mpicc -fopenmp -DUSE_MPI 32_ensemble.c -lm        on all that mpirun is given

   The orbits and MEGNO are those of lesson 31, from (0, y) with y' = w at energy 1/8. An orbit is
   over when its neighbour is 1e12 times further away: chaotic orbits take 0.37 as many steps.

   32_ensemble [side [numbers.csv [map.svg]]]         120 has 10,786 orbits
   prints

     110 orbits, 0 failed: 61 % chaotic
*/
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/svg.h"
#include "tools/ensemble.h"
#include "tools/tangent.h"
#include <stdlib.h>

enum { MOST = 1000, STEPS = 5000 };
static const double h = 0.4, chaotic = 4;
static const svg_axis along_y = { 0, -0.45, 0.68, 80, 610, 8, 0 }, along_w = { 0, -0.5, 0.5, 400, 50, 8, 0 };

typedef struct result { double y, w, megno; int steps, status; } result;

GVI_EACH(potential, 2, f)
{
    const double X = x->q[0], Y = x->q[1];
    x->f[0] -= X + 2*X*Y;
    x->f[1] -= Y + X*X - Y*Y;
}

static int product(const gvi_points *x, const gvi_points *d, int parameter, void *user)
{
    const int s = x->stride;
    const double *X = x->q, *Y = X + s, *dX = d->q, *dY = dX + s;
    for (int k = 0; k < x->count; ++k) {
        d->f[k]     -= (1 + 2*Y[k])*dX[k] + 2*X[k]*dY[k];
        d->f[s + k] -= 2*X[k]*dX[k] + (1 - 2*Y[k])*dY[k];
    }
    return (void)parameter, (void)user, 0;
}

/* From point k of the grid; *user: points on a side. No step where the energy does not reach. */
static void orbit(int k, void *out, void *user)
{
    static const gvi_effect scene[] = { { .kind = GVI_POTENTIAL, .points = potential } };
    double memory[GVI_LENGTH(4, 8, 8)], room[TANGENT_ROOM(2, 1)], d[4] = { 0.8, 0, 0, 0.6 }, mean = 0, before = 1;
    tangent T = { .plain = { .n = 2, .degree = 8, .effects = scene, .effect_count = 1 },
                  .product = { product }, .directions = 1, .room = room, .room_length = TANGENT_ROOM(2, 1) };
    const int side = *(int *)user;
    const double y = along_y.lo + (along_y.hi - along_y.lo)*(k % side + 0.5)/side;
    const double w = along_w.lo + (along_w.hi - along_w.lo)*(k / side + 0.5)/side;
    const double v2 = 0.25 - w*w - y*y + 2*y*y*y/3, q[] = { 0, y }, p[] = { sqrt(v2), w };
    result *z = out;
    gvi_stepper st;
    *z = (result){ .y = y, .w = w };
    if (!(v2 > 0)) return;
    if ((z->status = tangent_scene(&T)) || (z->status = gvi_init(&st, &T.desc, memory, sizeof memory))) return;
    tangent_start(&T, &st, 0, q, p, d, d + 2);
    while (z->steps < STEPS && before < 1e12 && !st.status && !gvi_step(&st, h)) {
        const int i = ++z->steps;
        tangent_column(&T, &st, 0, d, d + 2);
        const double size = sqrt(d[0]*d[0] + d[1]*d[1] + d[2]*d[2] + d[3]*d[3]), growth = log(size/before);
        mean += 2*growth - mean/i;
        z->megno += (mean - z->megno)/i;
        before = size;
    }
    z->status = st.status;
}

/* The grid is drawn in its own units, a line of cells at a time, one path for each shade. */
static int shade_of(const result *z)
{
    static const double least[] = { 1, 1.8, 2.2, 4, 10 };
    int c = 0;
    while (c < 5 && z->megno >= least[c]) ++c;
    return z->steps > 0 ? c : -1;
}

static int draw(const char *path, const result *z, int side)
{
    static const char *const colour[] = { "#08519c", "#4292c6", "#9ecae1", "#fee391", "#fe9929", "#a63603" };
    static const char *const name[] = { "below 1", "1 to 1.8", "1.8 to 2.2", "2.2 to 4", "4 to 10", "above 10" };
    FILE *f = svg_begin(path, 760, 460);
    if (!f) return -1;
    for (int c = 0; c < 6; ++c) {
        fprintf(f, "<path stroke=\"%s\" stroke-width=\"1.04\" transform=\"translate(%g %g) scale(%.4f %.4f)\" d=\"",
                colour[c], along_y.a, along_w.a, (along_y.b - along_y.a)/side, (along_w.b - along_w.a)/side);
        for (int k = 0, next; k < side*side; k = next) {
            for (next = k + 1; next % side && shade_of(z + next) == shade_of(z + k); ++next) {}
            if (shade_of(z + k) == c) fprintf(f, "M%d %d.5h%d\n", k % side, k / side, next - k);
        }
        fprintf(f, "\"/>\n<path stroke=\"%s\" stroke-width=\"14\" d=\"M628 %dh22\"/>", colour[c], 100 + 26*c);
        fprintf(f, "<text x=\"657\" y=\"%d\">%s</text>\n", 105 + 26*c, name[c]);
    }
    svg_ticks(f, &along_y, &along_w, 0);
    svg_ticks(f, &along_w, &along_y, 1);
    fprintf(f, "<text x=\"80\" y=\"28\" font-size=\"17\" font-weight=\"bold\">"
               "Orbits of Hénon and Heiles at energy 1/8</text><text x=\"628\" y=\"75\">MEGNO</text>"
               "<text x=\"345\" y=\"448\">y</text><text x=\"16\" y=\"230\">y'</text>\n");
    return svg_end(f);
}

int main(int argc, char **argv)
{
    static result z[MOST*MOST];
    const int rank = ensemble_begin(&argc, &argv);
    int side = argc > 1 ? atoi(argv[1]) : 12, orbits = 0, chaos = 0, bad = side < 1 || side > MOST;
    if (!bad) ensemble_run(side*side, 100, sizeof z[0], orbit, &side, z);
    if (rank == 0 && !bad) {
        for (int k = 0; k < side*side; ++k)
            orbits += z[k].steps > 0, chaos += z[k].megno > chaotic, bad += z[k].status != GVI_OK;
        printf("%d orbits, %d failed: %.0f %% chaotic\n", orbits, bad, 100.0*chaos/orbits);
        FILE *f = argc > 2 ? fopen(argv[2], "w") : NULL;
        for (int k = 0; f && k < side*side; ++k)
            if (z[k].steps) fprintf(f, "%.17g,%.17g,%.17g,%d\n", z[k].y, z[k].w, z[k].megno, z[k].steps);
        if ((argc > 2 && (!f || fclose(f))) || (argc > 3 && draw(argv[3], z, side))) bad = 1, puts("cannot write");
    }
    ensemble_end();
    return bad;
}
