/* Equivalences (Ober-Bloebaum 2017): what Galerkin variational integrators
   coincide with, as largest differences over 20 steps, in units of eps.

     degree 1, Gauss 1        the implicit midpoint rule
     degree 1, Lobatto 2      Stoermer-Verlet                   (constant mass)
     degree s, Gauss s        Gauss collocation
     degree s, Lobatto s      the Lobatto IIIA-IIIB pair

   The other side is Hamilton's equations with tables made here from collocation
   (rules.h).  tests/test_identities.c does the same with published tables, in
   every formulation of the library.

     identities [folder]   writes theorem_identities.svg                       */
#include "identities.h"
#include "tables.h"

enum { ROWS = 12 };

/* Rows: midpoint, Verlet, Gauss 2..6, Lobatto 2..6 */
static double row_difference(const problem *pb, int row)
{
    int stages = row < 2 ? 1 : row < 7 ? row : row - 5, lobatto_ = row == 1 || row >= 7;
    own_rule rule = lobatto_ ? lobatto(row == 1 ? 2 : stages) : gauss(stages);
    tableau T = table_of(&rule);
    method m = { row == 1 ? 1 : stages, { lobatto_ ? GVI_LOBATTO : GVI_GAUSS, .points = rule.r } };
    return difference(pb, &m, row == 0 ? midpoint : row == 1 ? verlet : partitioned, &T);
}

int main(int argc, char **argv)
{
    static const char *const rows[ROWS] = {
        "midpoint", "Stoermer-Verlet", "Gauss 2", "Gauss 3", "Gauss 4", "Gauss 5", "Gauss 6",
        "Lobatto A-B 2", "Lobatto A-B 3", "Lobatto A-B 4", "Lobatto A-B 5", "Lobatto A-B 6"
    };
    static const char *const columns[PROBLEMS] = { "Kepler", "pend.", "magn.", "length" };
    static svg_cell cells[ROWS][PROBLEMS];
    const svg_table g = { "eps", rows, columns, ROWS, PROBLEMS, cells[0] };
    char path[500];
    for (int row = 0; row < ROWS; ++row)
        for (int k = 0; k < PROBLEMS; ++k) {
            int separable = row != 1 || k == 0;
            cells[row][k] = (svg_cell){ separable ? row_difference(&problems[k], row) : (double)NAN, 0 };
        }
    printf("Largest difference over %d steps, in eps = %.2e\n", IDENTITY_STEPS, (double)UNIT);
    print_table(&g);
    snprintf(path, sizeof path, "%s/theorem_identities.svg", argc > 1 ? argv[1] : ".");
    return svg_write_tables(path, "Differences after 20 steps, in eps", "blue: within 10", 10, &g, 1, 1) ? 1 : 0;
}
