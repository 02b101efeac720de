/* Linear stability: one step on the oscillator, Gauss s and Lobatto s + 1,
   s = 1..6, over h omega from 0 to 20, from the library's own step and from theory.

   Gauss turns at any step size.  Lobatto has windows of h omega in which it grows;
   they are listed with the largest growth a step in them.

     stability [folder]    writes theorem_stability_gauss.svg, ..._lobatto.svg  */
#include "stability.h"
#include "tables.h"

enum { S = 6, POINTS = 2001 };
static const double TOP = 20;

static double x[POINTS], seen[S][POINTS];

static method method_of(int lobatto_, int s)
{
    return (method){ s, { lobatto_ ? GVI_LOBATTO : GVI_GAUSS, .points = lobatto_ ? s + 1 : s } };
}

static real theory(int lobatto_, int s, real h)
{
    return lobatto_ ? lobatto_half_trace(s + 1, h) : gauss_half_trace(s, h);
}

/* Fills `seen`; prints how far from theory it is, where theory is moderate */
static void sweep(int lobatto_)
{
    for (int s = 1; s <= S; ++s) {
        method m = method_of(lobatto_, s);
        double worst = 0;
        int failed = 0;
        for (int k = 0; k < POINTS; ++k) {
            real h = TOP*(k + 0.5L)/POINTS, want = theory(lobatto_, s, h), got = half_trace(&m, h);
            x[k] = (double)h;
            seen[s - 1][k] = (double)got;
            if (isnan(got)) ++failed;
            else worst = fmax(worst, (double)(fabs(got - want)/(1 + want*want)));
        }
        printf("%s s = %d: |half trace - theory|/(1 + theory^2) <= %.0f eps, %d steps failed\n",
               lobatto_ ? "Lobatto" : "Gauss", s, worst/(double)UNIT, failed);
    }
}

/* Where |half trace| passes 1, between a and b, by bisection of the library's */
static real edge(const method *m, real a, real b)
{
    int inside = fabs(half_trace(m, a)) > 1;
    for (int it = 0; it < 50; ++it) {
        real middle = (a + b)/2;
        if ((fabs(half_trace(m, middle)) > 1) == inside) a = middle; else b = middle;
    }
    return (a + b)/2;
}

/* 1e-9: at a touching point rounding may not open a window */
static int grows(double half) { return fabs(half) > 1 + 1e-9; }

static void windows(int s)
{
    method m = method_of(1, s);
    double growth = 1;
    printf("Lobatto s = %d unstable for h omega in", s);
    for (int k = 1; k < POINTS; ++k) {
        double half = fabs(seen[s - 1][k]);
        if (grows(half)) growth = fmax(growth, half + sqrt(half*half - 1));
        if (grows(seen[s - 1][k]) == grows(seen[s - 1][k - 1])) continue;
        real at = edge(&m, (real)x[k - 1], (real)x[k]);
        if (grows(half)) printf(" (%.6f, ", (double)at);
        else printf("%.6f; %.4g)", (double)at, growth);
        if (!grows(half)) growth = 1;
    }
    if (grows(seen[s - 1][POINTS - 1])) printf("%g...; %.4g)", TOP, growth);
    printf("\n");
}

static void draw_traces(const char *folder, int lobatto_)
{
    static const char *const names[S] = { "s = 1", "s = 2", "s = 3", "s = 4", "s = 5", "s = 6" };
    static double shown[S][POINTS];
    svg_line lines[S];
    for (int s = 0; s < S; ++s) {
        for (int k = 0; k < POINTS; ++k) {
            double half = seen[s][k];
            shown[s][k] = fabs(half) <= 2.5 ? half : (double)NAN;
        }
        lines[s] = (svg_line){ names[s], x, shown[s], POINTS };
    }
    const char *title = lobatto_ ? "Half trace of a step, oscillator, Lobatto s + 1: beyond 1 it grows"
                                 : "Half trace of a step, oscillator, Gauss s: never beyond 1";
    const svg_plot plot = { .title = title, .x_label = "h omega",
                            .y_label = "half trace (exact: cos h omega)",
                            .lines = lines, .line_count = S };
    draw(folder, lobatto_ ? "theorem_stability_lobatto" : "theorem_stability_gauss", &plot);
}

int main(int argc, char **argv)
{
    for (int lobatto_ = 0; lobatto_ < 2; ++lobatto_) {
        sweep(lobatto_);
        if (lobatto_) {
            printf("windows, with the largest factor a step\n");
            for (int s = 1; s <= S; ++s) windows(s);
        }
        draw_traces(argc > 1 ? argv[1] : ".", lobatto_);
    }
    return 0;
}
