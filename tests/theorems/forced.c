/* Forced systems: is the order 2s there as well?  The paper expects it and does not
   prove it.

   As order.c, with linear drag, air drag that grows like |v|v, and a motor whose
   torque depends on time and speed.

     forced [folder]       writes theorem_forced.svg                           */
#include "bench.h"
#include "rules.h"
#include "tables.h"

enum { S = 6, ROWS = 6 };
static const double WITHIN = 0.2;

static const char *const s_names[S] = { "s = 1", "2", "3", "4", "5", "6" };
static const char *const row_names[ROWS] = {
    "Gauss s", "Gauss s + 2", "Lobatto s", "Lobatto s + 1", "Radau s", "Newton-Cotes s"
};
static int misses, cells;

static svg_cell cell_of(const problem *pb, int row, int s)
{
    own_rule own = row == 4 ? radau(s) : newton_cotes(s < 3 ? 3 : s);
    int r = row == 1 ? s + 2 : row == 3 ? s + 1 : s, u = row < 2 ? 2*r : row < 4 ? 2*r - 2 : own.u;
    method m = { s, rule_or_own(row < 2 ? GVI_GAUSS : row < 4 ? GVI_LOBATTO : GVI_OWN, r, &own) };
    if ((row == 2 && s < 2) || (row == 5 && s < 3)) return (svg_cell){ NAN, 0 };
    int expected = order_expected(s, u), most = expected%2 ? 1600 : 64;            /* as in order.c */
    svg_cell cell = { (double)slope(end_error, pb, &m, expected, most), expected };
    ++cells;
    if (!(fabs(cell.got - cell.expected) <= WITHIN)) ++misses;
    return cell;
}

int main(int argc, char **argv)
{
    static svg_cell table[FORCED][ROWS][S];
    static svg_table grids[FORCED];
    char path[500];
    printf("Order with forces, with %d bits\n", LDBL_MANT_DIG);
    for (int k = 0; k < FORCED; ++k) {
        for (int row = 0; row < ROWS; ++row)
            for (int s = 1; s <= S; ++s) table[k][row][s - 1] = cell_of(&forced_problems[k], row, s);
        grids[k] = (svg_table){ forced_problems[k].name, row_names, s_names, ROWS, S, table[k][0] };
        print_table(&grids[k]);
    }
    snprintf(path, sizeof path, "%s/theorem_forced.svg", argc > 1 ? argv[1] : ".");
    if (svg_write_tables(path, "Order seen, with forces",
                   "blue: within 0.2 of min(2s, u); Newton-Cotes: of min(u, 2(u - s + 1))",
                   WITHIN, grids, FORCED, 2)) return 1;
    printf("\n%d of %d cells not within %.1f\n", misses, cells, WITHIN);
    return LDBL_MANT_DIG >= 113 && misses > 0;                /* fewer bits: rounding, not order */
}
