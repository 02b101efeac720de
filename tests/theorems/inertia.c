/* Minimum or saddle: the number of negative eigenvalues of the second variation of
   the discrete action, ends fixed, against the number of conjugate points inside
   the step (Morse); what the boundary-value solve says at a conjugate point, and
   that the initial-value step carries on there.  Nonlinear: test_theorems.c.

     inertia [folder]      writes theorem_inertia.svg                          */
#include "inertia.h"
#include "tables.h"

enum { LINES = 5, POINTS = 321, MOST = 6 };

static double x[POINTS];
static const double APART = 0.05;            /* of lines that would hide each other */

/* Where the index of the step from y first exceeds k, by bisection in (a, b) */
static real rise(const problem *pb, const method *m, real t, const real *y, int k, real a, real b)
{
    for (int it = 0; it < 40; ++it) {
        real middle = (a + b)/2;
        if (index_of_step(pb, m, t, y, middle) > k) b = middle; else a = middle;
    }
    return (a + b)/2;
}

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
    draw(folder, "theorem_inertia", &(svg_plot){ .title = "Second variation of one step, oscillator, Gauss s",
        .x_label = "h (times omega)", .y_label = "negative eigenvalues (lines 0.05 apart)",
        .lines = lines, .line_count = LINES });
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

int main(int argc, char **argv)
{
    oscillator_index(argc > 1 ? argv[1] : ".");
    oscillator_conjugate_points();
    return 0;
}
