/* Why the energy stays level: Stoermer-Verlet's modified Lagrangian, to h^4, on a pendulum and on Kepler's ellipse

   How far the energy, and that of the modified Lagrangian to h^2 and to h^4, leave their first values in a run, with
   the exponents of h; and by how much the perihelion turns in a revolution.

     modified [folder]     writes theorem_modified.svg                          */
#include "modified.h"
#include "tables.h"

enum { REVOLUTIONS = 3, STEPS = 400 };

static void ranges(const problem *pb)
{
    real old[ENERGIES] = { 0 };
    printf("\n%s: largest |E(t) - E(0)| in 0 < t <= %g, and the exponent of h\n"
           "      h        H               to h^2          to h^4\n", pb->name, (double)pb->time);
    for (int N = 32; N <= 512; N *= 2) {
        real now[ENERGIES];
        energy_ranges(pb, &verlet, 2/(real)N, now);
        printf("%9.5f", 2/(double)N);
        for (int i = 0; i < ENERGIES; ++i) {
            printf("  %8.2e ", (double)now[i]);
            if (old[i] > 0) printf("%5.2f", (double)(log(old[i]/now[i])/log(2.0L)));
            else printf("     ");
            old[i] = now[i];
        }
        printf("\n");
    }
}

static void perihelion(void)
{
    static const double e[4] = { 0.1, 0.3, 0.5, 0.7 };
    printf("\nPerihelion's turn in a revolution, in degrees: measured, predicted to h^2, their ratio\n");
    for (int i = 0; i < 4; ++i)
        for (int N = 500; N <= 2000; N *= 2) {
            const real h = TAU/N;
            const double seen = (double)(360/TAU*shift_measured(e[i], h)), said = (double)(360/TAU*shift_predicted(e[i], h));
            printf("e = %.1f, %4d steps: %9.5f  %9.5f  %7.5f\n", e[i], N, seen, said, seen/said);
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
    ranges(&pendulum);
    ranges(&problems[0]);
    perihelion();
    picture(argc > 1 ? argv[1] : ".");
    return 0;
}
