/* Theorems 2.1 and 3.x: |L_d - L_exact| = O(h^(min(2s,u)+1)), which is what the
   order of the integrator comes from.

   L_d of the ends of an exact solution, from gvi_discrete_lagrangian, against the
   action of that solution: for the oscillator its closed form, else the action
   that was integrated along with the solution (reference.h).

     lagrangian [folder]   writes theorem_lagrangian.svg (one problem, against h)
                           and theorem_lagrangian_order.svg (all of them)       */
#include "bench.h"
#include "rules.h"
#include "tables.h"
#include "examples/tools/svg.h"

enum { S = 8, ROWS = 5, MOST = 96, SIZES = 16, LINES = 6 };
static const double WITHIN = 0.25;

static const char *const s_names[S] = { "s = 1", "2", "3", "4", "5", "6", "7", "8" };
static const char *const row_names[ROWS] = {
    "Gauss s", "Gauss s + 1", "Lobatto s", "Lobatto s + 1", "Newton-Cotes s"
};
static int misses, cells;

static svg_cell cell_of(const problem *pb, int row, int s)
{
    own_rule own = newton_cotes(s < 3 ? 3 : s);
    int r = row == 1 || row == 3 ? s + 1 : s, u = row < 2 ? 2*r : row < 4 ? 2*r - 2 : own.u;
    method m = { s, rule_or_own(row < 2 ? GVI_GAUSS : row < 4 ? GVI_LOBATTO : GVI_OWN, r, &own) };
    if (row >= 2 && r < (row == 4 ? 3 : 2)) return (svg_cell){ NAN, 0 };
    int expected = order_expected(s, u) + 1;
    svg_cell cell = { (double)slope(lagrangian_error, pb, &m, expected, MOST), expected };
    ++cells;
    if (!(fabs(cell.got - cell.expected) <= WITHIN)) ++misses;
    return cell;
}

static void draw_orders(const char *folder)
{
    static svg_cell table[PROBLEMS + 1][ROWS][S];
    static svg_table grids[PROBLEMS + 1];
    char path[500];
    for (int k = 0; k <= PROBLEMS; ++k) {
        const problem *pb = k ? &problems[k - 1] : &oscillator;
        for (int row = 0; row < ROWS; ++row)
            for (int s = 1; s <= S; ++s) table[k][row][s - 1] = cell_of(pb, row, s);
        grids[k] = (svg_table){ pb->name, row_names, s_names, ROWS, S, table[k][0] };
        print_table(&grids[k]);
    }
    snprintf(path, sizeof path, "%s/theorem_lagrangian_order.svg", folder);
    if (svg_write_tables(path, "Exponent of h in |L_d - L_exact|",
                   "blue: within 0.25 of min(2s, u) + 1, for the last row of min(u, 2(u - s + 1)) + 1",
                   WITHIN, grids, PROBLEMS + 1, 2)) exit(1);
}

static void draw_errors(const char *folder, const problem *pb)
{
    static const char *const names[LINES] = { "s = 1", "s = 2", "s = 3", "s = 4", "s = 5", "s = 6" };
    static double h[SIZES], error[LINES][SIZES];
    svg_line lines[LINES];
    char path[500];
    for (int s = 1; s <= LINES; ++s) {
        for (int k = 0; k < SIZES; ++k) {
            method m = { s, { 0 } };
            h[k] = pow(2, -k/3.0);
            error[s - 1][k] = (double)lagrangian_error(pb, &m, h[k]);
        }
        lines[s - 1] = (svg_line){ names[s - 1], h, error[s - 1], SIZES };
    }
    snprintf(path, sizeof path, "%s/theorem_lagrangian.svg", folder);
    const svg_plot plot = { .title = "Discrete against exact Lagrangian, double pendulum",
                            .x_label = "step h", .y_label = "|L_d - L_exact|", .log_x = 1, .log_y = 1,
                            .lines = lines, .line_count = LINES };
    if (svg_write(path, &plot)) exit(1);
}

/* Two that know nothing of each other: L_d of degree 24 and the reference */
static void compare_with_degree_24(void)
{
    printf("\nL_d of degree 24 at h = 1/4 against the reference:");
    for (int k = 0; k <= PROBLEMS; ++k) {
        const problem *pb = k ? &problems[k - 1] : &oscillator;
        method m = { 24, { 0 } };
        printf("%s %s %.1e", k ? "," : "", pb->name, (double)lagrangian_error(pb, &m, 0.25L));
    }
    printf("\n");
}

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : ".";
    printf("|L_d - L_exact| = O(h^(min(2s,u)+1)), with %d bits\n", LDBL_MANT_DIG);
    draw_orders(folder);
    draw_errors(folder, &problems[1]);
    compare_with_degree_24();
    printf("\n%d of %d cells not within %.2f\n", misses, cells, WITHIN);
    return LDBL_MANT_DIG >= 113 && misses > 1;                /* one is rounding: docs/theorems.md */
}
