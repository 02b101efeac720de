/* Why the energy stays level: Stoermer-Verlet's modified Lagrangian on Kepler's ellipse

   How far the energy, and that of the modified Lagrangian to h^2 and to h^4, leave their first values in a run, and by
   how much the perihelion turns in a revolution.  Exponents of h: test_theorems.c.

     modified [folder]     writes theorem_modified.svg                          */
#include "modified.h"
#include "tables.h"

enum { REVOLUTIONS = 3, STEPS = 400 };

static void perihelion(void)
{
    static const double e[4] = { 0.1, 0.3, 0.5, 0.7 };
    printf("Perihelion's turn in a revolution, in degrees: measured, predicted to h^2, their ratio; per time 2 pi\n");
    for (int i = 0; i < 4; ++i)
        for (int N = 500; N <= 2000; N *= 2) {
            const real h = TAU/N;
            real revolution;
            const double seen = (double)(360/TAU*shift_measured(e[i], h, &revolution));
            const double said = (double)(360/TAU*shift_predicted(e[i], h));
            const double in_time = seen/said*(double)(TAU/revolution);
            printf("e = %.1f, %4d steps: %9.5f  %9.5f  %7.5f  %7.5f\n", e[i], N, seen, said, seen/said, in_time);
        }
}

/* Three revolutions of an ellipse with e = 1/2, from its aphelion */
static void picture(const char *folder)
{
    static const char *const names[ENERGIES] = { "energy", "of L_mod to h^2", "of L_mod to h^4" };
    static double t[REVOLUTIONS*STEPS], change[ENERGIES][REVOLUTIONS*STEPS];
    const real h = TAU/STEPS, y[MAX_Y] = { 1.5L, 0, 0, 1/sqrt(3.0L) };
    real first[ENERGIES], E[ENERGIES];
    svg_line lines[ENERGIES];
    gvi_stepper *st = bench(&problems[0], &verlet, 0, y);
    modified_energies(&problems[0], h, st->q, st->p, first);
    for (int k = 0; k < REVOLUTIONS*STEPS; ++k) {
        gvi_step(st, h);
        modified_energies(&problems[0], h, st->q, st->p, E);
        t[k] = (k + 1)/(double)STEPS;
        for (int i = 0; i < ENERGIES; ++i) change[i][k] = (double)fabs(E[i] - first[i]);
    }
    printf("\nKepler, e = 1/2, %d steps a revolution: largest |E(t) - E(0)|", STEPS);
    for (int i = 0; i < ENERGIES; ++i) {
        double most = 0;
        for (int k = 0; k < REVOLUTIONS*STEPS; ++k) most = fmax(most, change[i][k]);
        printf("  %.1e", most);
    }
    printf("\n");
    for (int i = 0; i < ENERGIES; ++i) lines[i] = (svg_line){ names[i], t, change[i], REVOLUTIONS*STEPS };
    draw(folder, "theorem_modified", &(svg_plot){ .title = "What Verlet keeps: Kepler, e = 1/2, 400 steps a revolution",
        .x_label = "revolutions", .y_label = "|E(t) - E(0)|", .log_y = 1, .lines = lines, .line_count = ENERGIES });
}

int main(int argc, char **argv)
{
    perihelion();
    picture(argc > 1 ? argv[1] : ".");
    return 0;
}
