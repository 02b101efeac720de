/* Minimum or saddle: the number of negative eigenvalues of the second variation of
   the discrete action, ends fixed, against the number of conjugate points inside
   the step (Morse); what the boundary-value solve says at a conjugate point, and
   that the initial-value step carries on there.

     inertia [folder]      writes theorem_inertia.svg, theorem_inertia_magnetic.svg */
#include "inertia.h"
#include "examples/tools/svg.h"

enum { LINES = 5, POINTS = 321, MOST = 6 };

static double x[POINTS];
static const double APART = 0.05;            /* of lines that would hide each other */

static void draw(const char *folder, const char *file, const char *title, const svg_line *lines, int count)
{
    char path[500];
    snprintf(path, sizeof path, "%s/%s", folder, file);
    const svg_plot plot = { .title = title, .x_label = "h (times omega)",
                            .y_label = "negative eigenvalues (lines 0.05 apart)",
                            .lines = lines, .line_count = count };
    if (svg_write(path, &plot)) exit(1);
}

/* Where the index of the step from y first exceeds k, by bisection in (a, b) */
static real rise(const problem *pb, const method *m, real t, const real *y, int k, real a, real b)
{
    for (int it = 0; it < 40; ++it) {
        real middle = (a + b)/2;
        if (index_of_step(pb, m, t, y, middle) > k) b = middle; else a = middle;
    }
    return (a + b)/2;
}

/* -------------------------------------------------------------- oscillator */

static void oscillator_index(const char *folder)
{
    static const int degrees[LINES - 1] = { 2, 4, 8, 16 };
    static const char *const names[LINES] = { "s = 2", "s = 4", "s = 8", "s = 16", "theory" };
    static double index[LINES][POINTS];
    svg_line lines[LINES];
    const real y[2] = { 1, 0.5L };
    for (int i = 0; i < LINES; ++i) {
        for (int k = 0; k < POINTS; ++k) {
            real h = (k + 0.5L)/16;
            method m = { i < LINES - 1 ? degrees[i] : 1, { 0 } };
            x[k] = (double)h;
            index[i][k] = i < LINES - 1 ? index_of_step(&oscillator, &m, 0, y, h) : (double)floor(h/(TAU/2));
            index[i][k] += APART*i;
        }
        lines[i] = (svg_line){ names[i], x, index[i], POINTS };
    }
    draw(folder, "theorem_inertia.svg", "Second variation of one step, oscillator, Gauss s", lines, LINES);
}

/* The steps where the index rises, less k pi; and what the two solves say there */
static void oscillator_conjugate_points(void)
{
    const real y[2] = { 1, 0.5L };
    printf("Oscillator: where the index rises to k, less k pi (-: never, up to (k + 1/2) pi)\n  s ");
    for (int k = 1; k <= 4; ++k) printf("      k = %d", k);
    for (int s = 2; s <= 16; s += 2) {
        printf("\n%3d ", s);
        for (int k = 1; k <= 4; ++k) {
            method m = { s, { 0 } };
            real top = (k + 0.5L)*TAU/2;
            if (index_of_step(&oscillator, &m, 0, y, top) < k) { printf("         -"); continue; }
            printf("  %8.1e", (double)(rise(&oscillator, &m, 0, y, k - 1, (k - 0.5L)*TAU/2, top) - k*TAU/2));
        }
    }
    printf("\n\nAt h omega = k pi, degree 32\n");
    for (int k = 1; k <= MOST; ++k) {
        method m = { 32, { 0 } };
        real h = k*TAU/2, q1[1] = { k%2 ? -1 : 1 }, Ld;
        gvi_stepper *st = bench(&oscillator, &m, 0, y);
        gvi_status boundary = gvi_discrete_lagrangian(st, 0, h, y, q1, &(gvi_discrete){ .lagrangian = &Ld });
        gvi_status step = gvi_step(st, h);
        printf("k = %d   boundary values: %-45s step: %s, wrong by %.1e\n", k, gvi_status_text(boundary),
               gvi_status_text(step), (double)(fabs(st->q[0] - q1[0]) + fabs(st->p[0] - q1[0]/2)));
    }
}

/* ------------------------------------------------------------- nonlinear ones */

/* The conjugate points of the solution from start `start`, up to h */
static int conjugate_points(const problem *pb, const real *y, real h, real *at)
{
    int count = 0;
    real step = 0.05L, last = jacobi_determinant(pb, 0, y, step);
    for (real a = step; a < h && count < MOST; a += step) {
        real next = jacobi_determinant(pb, 0, y, a + step), lo = a, hi = a + step;
        if ((next < 0) != (last < 0)) {
            for (int it = 0; it < 30; ++it) {
                real middle = (lo + hi)/2;
                if ((jacobi_determinant(pb, 0, y, middle) < 0) == (last < 0)) lo = middle; else hi = middle;
            }
            at[count++] = (lo + hi)/2;
        }
        last = next;
    }
    return count;
}

static void nonlinear_conjugate_points(const problem *pb, int start, real top)
{
    static const int degrees[] = { 6, 8, 12, 16 };
    real y[MAX_Y], at[MOST];
    start_state(pb, start, y);
    int count = conjugate_points(pb, y, top, at);
    printf("\n%s: conjugate points up to %g, and how much later the index of a step rises\n",
           pb->name, (double)top);
    for (int k = 0; k < count; ++k) {
        printf("  %.9f", (double)at[k]);
        for (int i = 0; i < 4; ++i) {
            method m = { degrees[i], { 0 } };
            real a = at[k] - 0.3L, b = at[k] + 0.3L;
            int before = index_of_step(pb, &m, 0, y, a), after = index_of_step(pb, &m, 0, y, b);
            printf("   s = %d: ", degrees[i]);
            if (before == k && after == k + 1) printf("%8.1e", (double)(rise(pb, &m, 0, y, k, a, b) - at[k]));
            else if (before < 0 || after < 0) printf("no step ");
            else printf("%d to %d  ", before, after);
        }
        printf("\n");
    }
}

static void draw_magnetic(const char *folder)
{
    const problem *pb = &problems[2];
    static double index[3][POINTS], at_h[POINTS];
    real y[MAX_Y], at[MOST];
    start_state(pb, 0, y);
    int count = conjugate_points(pb, y, 6, at), points = 96;
    for (int k = 0; k < points; ++k) {
        real h = 0.05L*(k + 0.5L);
        method m8 = { 8, { 0 } }, m16 = { 16, { 0 } };
        int before = 0;
        for (int i = 0; i < count; ++i) before += at[i] < h;
        at_h[k] = (double)h;
        index[0][k] = index_of_step(pb, &m8, 0, y, h);
        index[1][k] = index_of_step(pb, &m16, 0, y, h);
        index[2][k] = before + 2*APART;
        for (int i = 0; i < 2; ++i) index[i][k] += index[i][k] < 0 ? (double)NAN : APART*i;
    }
    svg_line lines[3] = { { "s = 8", at_h, index[0], points }, { "s = 16", at_h, index[1], points },
                          { "theory", at_h, index[2], points } };
    draw(folder, "theorem_inertia_magnetic.svg", "Second variation of one step, magnetic, Gauss s", lines, 3);
}

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : ".";
    oscillator_index(folder);
    oscillator_conjugate_points();
    nonlinear_conjugate_points(&problems[1], 2, 4);
    nonlinear_conjugate_points(&problems[2], 0, 6);
    nonlinear_conjugate_points(&problems[3], 0, 8);
    draw_magnetic(folder);
    return 0;
}
