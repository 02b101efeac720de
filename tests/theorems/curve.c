/* Theorem 5.1: the curve of a step has order min(s, u/2) + 1 in the maximum norm,
   one more in L1 over the step, and its velocity one less.  Lemma 3.1: so has the
   interpolating polynomial.  Beside them the state inside a step at full order.

   One step from an exact state, compared with the solution at 49 times in it.

     curve [folder]        writes theorem_curve_order.svg, theorem_curve.svg and
                           theorem_curve_inside.svg                            */
#include "bench.h"
#include "tables.h"
#include "examples/tools/svg.h"

enum { S = 6, ROWS = 5, MOST = 192, SIZES = 16, LINES = 6 };
static const double WITHIN = 0.25;

static const char *const s_names[S] = { "s = 1", "2", "3", "4", "5", "6" };
static const char *const row_names[ROWS] = {
    "Gauss s", "Gauss s + 1", "Lobatto s", "Lobatto s + 1", "interpolation"
};
static const char *const norm_names[NORMS] = {
    "position, maximum", "position, L1", "velocity, maximum", "velocity, L1"
};
static int misses, cells;

static curve_kind what;                 /* the error_fn below see these two */
static int which;

static real norm_error(const problem *pb, const method *m, real h)
{
    real norm[NORMS];
    curve_norms(pb, m, h, what, norm);
    return norm[which];
}

/* The theorem's exponent of norm `norm` */
static int exponent(int s, int u, int norm)
{
    static const int more[NORMS] = { 1, 2, 0, 1 };
    return smaller_int(s, u/2) + more[norm];
}

static svg_cell cell_of(const problem *pb, int row, int s, int norm)
{
    int r = row == 1 || row == 3 ? s + 1 : s, u = row == 4 ? 2*s : row < 2 ? 2*r : 2*r - 2;
    method m = { s, { row == 2 || row == 3 ? GVI_LOBATTO : GVI_GAUSS, .points = r } };
    if (row == 2 && r < 2) return (svg_cell){ NAN, 0 };
    what = row == 4 ? INTERPOLATED : OF_THE_STEP;
    which = norm;
    svg_cell cell = { 0, exponent(s, u, norm) };
    /* a derivative carries rounding over h: not as many steps */
    cell.got = (double)slope(norm_error, pb, &m, (real)cell.expected, norm < 2 ? MOST : MOST/2);
    ++cells;
    if (!(fabs(cell.got - cell.expected) <= WITHIN)) ++misses;
    return cell;
}

static void draw_orders(const char *folder, int shown)
{
    static svg_cell table[NORMS][ROWS][S];
    static svg_table grids[NORMS];
    char path[500];
    for (int k = 0; k < PROBLEMS; ++k) {
        int p = (shown + 1 + k)%PROBLEMS;          /* the one that is drawn comes last */
        printf("\n%s", problems[p].name);
        for (int norm = 0; norm < NORMS; ++norm) {
            for (int row = 0; row < ROWS; ++row)
                for (int s = 1; s <= S; ++s) table[norm][row][s - 1] = cell_of(&problems[p], row, s, norm);
            grids[norm] = (svg_table){ norm_names[norm], row_names, s_names, ROWS, S, table[norm][0] };
            print_table(&grids[norm]);
        }
    }
    snprintf(path, sizeof path, "%s/theorem_curve_order.svg", folder);
    if (svg_write_tables(path, "Exponent of h in the curve's distance, double pendulum",
                   "blue: within 0.25 of min(s, u/2) + 1, + 2, + 0, + 1", WITHIN, grids, NORMS, 2)) exit(1);
}

static void draw_convergence(const char *folder, const problem *pb)
{
    static const char *const names[LINES] = {
        "curve, s = 3", "velocity, s = 3", "state, s = 3", "curve, s = 6", "velocity, s = 6", "state, s = 6"
    };
    static double h[SIZES], error[LINES][SIZES];
    svg_line lines[LINES];
    char path[500];
    for (int i = 0; i < LINES; ++i) {
        method m = { i < 3 ? 3 : 6, { 0 } };
        what = i%3 == 2 ? STATE_AT : OF_THE_STEP;
        which = i%3 == 1 ? 2 : 0;
        for (int k = 0; k < SIZES; ++k) {
            h[k] = pow(2, -k/3.0);
            error[i][k] = (double)norm_error(pb, &m, h[k]);
        }
        lines[i] = (svg_line){ names[i], h, error[i], SIZES };
    }
    snprintf(path, sizeof path, "%s/theorem_curve.svg", folder);
    const svg_plot plot = { .title = "Largest error inside one step, double pendulum", .x_label = "step h",
                            .y_label = "error", .log_x = 1, .log_y = 1, .lines = lines, .line_count = LINES };
    if (svg_write(path, &plot)) exit(1);
}

static void draw_inside(const char *folder, const problem *pb, real h)
{
    static const char *const names[4] = { "curve, s = 3", "state, s = 3", "curve, s = 6", "state, s = 6" };
    static double tau[INSIDE + 1], error[4][INSIDE + 1];
    svg_line lines[4];
    char path[500];
    for (int i = 0; i < 4; ++i) {
        method m = { i < 2 ? 3 : 6, { 0 } };
        real of_q[INSIDE + 1], of_v[INSIDE + 1];
        if (!curve_errors(pb, &m, 0, h, i%2 ? STATE_AT : OF_THE_STEP, of_q, of_v)) exit(1);
        for (int k = 0; k <= INSIDE; ++k) {
            tau[k] = (double)k/INSIDE;
            error[i][k] = (double)of_q[k];
        }
        error[i][0] = NAN;                         /* both start there: no logarithm */
        lines[i] = (svg_line){ names[i], tau, error[i], INSIDE + 1 };
    }
    snprintf(path, sizeof path, "%s/theorem_curve_inside.svg", folder);
    const svg_plot plot = { .title = "Position error inside a step of h = 1/4, double pendulum",
                            .x_label = "tau = (t - t0)/h", .y_label = "error", .log_y = 1, .lines = lines,
                            .line_count = 4 };
    if (svg_write(path, &plot)) exit(1);
}

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : ".";
    printf("Theorem 5.1: the curve, with %d bits\n", LDBL_MANT_DIG);
    draw_orders(folder, 1);
    draw_convergence(folder, &problems[1]);
    draw_inside(folder, &problems[1], 0.25L);
    printf("\n%d of %d cells not within %.2f\n", misses, cells, WITHIN);
    return LDBL_MANT_DIG >= 64 && misses > 0;                 /* fewer bits: rounding, not order */
}
