/* Forced systems: the discrete forces and the doubled Lagrangian.

   The exponents of h in |F+- - exact|, |L_d - exact| and |p0 - exact| between the
   ends of an exact solution; and the step of the doubled Lagrangian at Q = q, an
   integration of its own in 2n coordinates, against the forced step.

     doubled [folder]      writes theorem_forces.svg; prints the comparison     */
#include "doubled.h"
#include "tables.h"

enum { S = 4, ROWS = 4, MOST = 16, RULES = 4, STEPS = 20 };
static const double WITHIN = 0.3;

static const char *const s_names[S] = { "s = 1", "2", "3", "4" };
static const char *const row_names[ROWS] = { "F-, F+", "p0", "F- + F+", "L_d" };
static error_fn *const row_errors[ROWS] = { force_error, momentum_error, force_sum_error, lagrangian_error };

/* L_d is exact to h^(2s+1).  One of q0, q1 moved alone changes the velocity by
   1/h of that: a power less for what is differentiated by one of them.        */
static void draw_forces(const char *folder)
{
    static svg_cell table[FORCED][ROWS][S];
    static svg_table grids[FORCED];
    char path[500];
    for (int k = 0; k < FORCED; ++k) {
        for (int row = 0; row < ROWS; ++row)
            for (int s = 1; s <= S; ++s) {
                method m = { s, { 0 } };
                int expected = row < 2 ? 2*s : 2*s + 1;
                table[k][row][s - 1] = (svg_cell){
                    (double)slope(row_errors[row], &forced_problems[k], &m, expected, MOST), expected };
            }
        grids[k] = (svg_table){ forced_problems[k].name, row_names, s_names, ROWS, S, table[k][0] };
        print_table(&grids[k]);
    }
    snprintf(path, sizeof path, "%s/theorem_forces.svg", folder);
    if (svg_write_tables(path, "Exponent of h in the errors of a forced step, Gauss s",
                   "blue: within 0.3 of 2s for F-, F+ and p0, of 2s + 1 for F- + F+ and L_d",
                   WITHIN, grids, FORCED, 2)) exit(1);
}

static void compare_all(void)
{
    static const char *const names[RULES] = { "Gauss s", "Gauss s + 1", "Lobatto s", "Lobatto s + 1" };
    printf("\nForced step and doubled Lagrangian at Q = q, %d steps of 1/10: largest difference of q, of p,\n"
           "and |Q - q|, |P + p| in the doubled one, all in eps = %.1e\n", STEPS, (double)UNIT);
    for (int k = 0; k < FORCED; ++k)
        for (int row = 0; row < RULES; ++row)
            for (int s = 1; s <= 6; ++s) {
                method m = { s, { row < 2 ? GVI_GAUSS : GVI_LOBATTO, .points = s + row%2 } };
                if (m.rule.kind == GVI_LOBATTO && m.rule.points < 2) continue;
                doubled_result worst = { 0, 0, 0 };
                for (int start = 0; start < STARTS; ++start) {
                    doubled_result left = compare_with_doubled(&forced_problems[k], &m, start, 0.1L, STEPS);
                    worst.q = larger(worst.q, left.q);
                    worst.p = larger(worst.p, left.p);
                    worst.diagonal = larger(worst.diagonal, left.diagonal);
                }
                printf("%-18s %-14s s = %d %8.1f %8.1f %8.1f\n", forced_problems[k].name, names[row], s,
                       (double)(worst.q/UNIT), (double)(worst.p/UNIT), (double)(worst.diagonal/UNIT));
            }
}

int main(int argc, char **argv)
{
    printf("Forced steps, with %d bits\n", LDBL_MANT_DIG);
    draw_forces(argc > 1 ? argv[1] : ".");
    compare_all();
    return 0;
}
