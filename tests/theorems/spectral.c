/* Spectral convergence (Hall and Leok): at a fixed large step the error falls
   geometrically with the degree, down to rounding, and stays there.

   s = 1..64.  One step of 1/2 or 1 on each of the four problems; and a Kepler step
   through the pericentre, where the rate is known: the solution is analytic up to
   the collision in complex time, so that polynomials of degree s come to rho^-s of
   it, and superconvergence makes rho^-2s of that.

     spectral [folder]     writes theorem_spectral.svg and theorem_spectral_rate.svg */
#include "spectral.h"
#include "tables.h"

enum { S = 64 };

static double degree[S];

/* -------------------------------------------------------------- four problems */

static const real step_of[PROBLEMS] = { 0.5L, 0.5L, 1, 1, 0.5L, 0.5L };

static void four_problems(const char *folder)
{
    static const char *const names[PROBLEMS] = { "Kepler", "pendulum", "magnetic", "length", "saddle", "mixed" };
    static double error[PROBLEMS][S];
    svg_line lines[PROBLEMS];
    for (int k = 0; k < PROBLEMS; ++k) {
        for (int s = 1; s <= S; ++s) {
            method m = { s, { 0 } };
            error[k][s - 1] = (double)step_error(&problems[k], &m, step_of[k]);
        }
        lines[k] = (svg_line){ names[k], degree, error[k], S };
    }
    for (int s = 1; s <= S; s += s < 32 ? 1 : 8) {
        printf("%4d", s);
        for (int k = 0; k < PROBLEMS; ++k) printf("  %9.2e", error[k][s - 1]);
        printf("\n");
    }
    const svg_plot plot = { .title = "Error of one step: h = 1 (magnetic, length), else 1/2",
                            .x_label = "degree s", .y_label = "error of (q, p)", .log_y = 1,
                            .lines = lines, .line_count = PROBLEMS };
    draw(folder, "theorem_spectral", &plot);
}

/* ------------------------------------------------------------- a known rate */

/* Factor a degree, from the last stretch of ten that is above rounding */
static double seen_rate(const double *error)
{
    int s = S;
    while (s > 11 && !(error[s - 1] > 1e4*(double)UNIT)) --s;
    return pow(error[s - 1]/error[s - 11], 0.1);
}

static void known_rate(const char *folder)
{
    static const double h[3] = { 0.25, 0.5, 1 };
    static double error[3][S], theory[3][S];
    static const char *const names[6] = {
        "h = 1/4", "rho^-2s, h = 1/4", "h = 1/2", "rho^-2s, h = 1/2", "h = 1", "rho^-2s, h = 1"
    };
    static const char *const colours[6] = { "#0072b2", "#0072b2", "#d55e00", "#d55e00", "#009e73", "#009e73" };
    svg_line lines[6];
    const real e = 0.5L;
    printf("\nOne Kepler step through the pericentre, e = 1/2: factor a degree\n    h    seen   rho^-2\n");
    for (int k = 0; k < 3; ++k) {
        double rate = (double)(1/(rho_of(e, h[k])*rho_of(e, h[k])));
        for (int s = 1; s <= S; ++s) {
            error[k][s - 1] = (double)pericentre_error(e, h[k], s);
            theory[k][s - 1] = error[k][7]*pow(rate, s - 8);
            if (theory[k][s - 1] < (double)UNIT/10) theory[k][s - 1] = NAN;
        }
        printf("%5.2f  %6.4f  %6.4f\n", h[k], seen_rate(error[k]), rate);
        lines[2*k] = (svg_line){ names[2*k], degree, error[k], S };
        lines[2*k + 1] = (svg_line){ names[2*k + 1], degree, theory[k], S };
    }
    const svg_plot plot = { .title = "One Kepler step through the pericentre, e = 1/2", .x_label = "degree s",
                            .y_label = "error of (q, p)", .log_y = 1, .lines = lines, .line_count = 6,
                            .dashed = 0x2a, .colours = colours };
    draw(folder, "theorem_spectral_rate", &plot);
}

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : ".";
    for (int s = 1; s <= S; ++s) degree[s - 1] = s;
    printf("Error of one step against degree, eps = %.2e\n", (double)UNIT);
    printf("   s     Kepler   pendulum   magnetic     length\n");
    four_problems(folder);
    known_rate(folder);
    return 0;
}
