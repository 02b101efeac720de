/* Theorems about orders: the exponent of h in an error, cell by cell, rule against degree.

     order           4.1: degree s and a rule of order u >= 2s - 2 give order min(2s, u); rules that are too
                     weak give min(u, 2(u - s + 1)), as theory.md expects
     counterexample  4.1 as printed does not ask for u >= 2s - 2, and needs it
     lagrangian      2.1 and 3: |L_d - L_exact| = O(h^(order + 1)), between the ends of an exact solution
     curve           5.1: between the ends of an exact solution the curve has order min(s, u/2) + 1 in the
                     maximum norm, one more in L1, its velocity one less each
     forced          6: the order of the step with drag, with air drag like |v|v, and with a motor whose torque
                     depends on time and speed; what is left of L_d and of the discrete forces

     orders study [folder]      writes theorem_*.svg                           */
#include "inertia.h"
#include "tables.h"

enum { S = 8, MOST_ROWS = 14, GRIDS = PROBLEMS + 1, SIZES = 16, LINES = 6 };

/* ----------------------------------------------------------------------- rules */

/* r points, or where r <= 0 as many as the degree and -r more */
typedef struct row { const char *name; gvi_rule_kind kind; int r; own_rule (*own)(int r); } row;

static const row standard[] = {
    { "Gauss r = s", GVI_GAUSS, 0, NULL }, { "s + 1", GVI_GAUSS, -1, NULL }, { "s + 2", GVI_GAUSS, -2, NULL },
    { "s + 3", GVI_GAUSS, -3, NULL }, { "Lobatto r = s", GVI_LOBATTO, 0, NULL }, { "s + 1", GVI_LOBATTO, -1, NULL },
    { "s + 2", GVI_LOBATTO, -2, NULL }, { "s + 3", GVI_LOBATTO, -3, NULL },
};
static const row weak[] = {
    { "Newton-Cotes 3", GVI_OWN, 3, newton_cotes }, { "Newton-Cotes 4", GVI_OWN, 4, newton_cotes },
    { "Newton-Cotes 5", GVI_OWN, 5, newton_cotes }, { "Newton-Cotes 6", GVI_OWN, 6, newton_cotes },
    { "Newton-Cotes 7", GVI_OWN, 7, newton_cotes }, { "Clenshaw-Curtis 4", GVI_OWN, 4, clenshaw_curtis },
    { "Clenshaw-Curtis 5", GVI_OWN, 5, clenshaw_curtis }, { "Clenshaw-Curtis 6", GVI_OWN, 6, clenshaw_curtis },
    { "Clenshaw-Curtis 7", GVI_OWN, 7, clenshaw_curtis }, { "Clenshaw-Curtis 8", GVI_OWN, 8, clenshaw_curtis },
    { "Radau 2", GVI_OWN, 2, radau }, { "Radau 3", GVI_OWN, 3, radau }, { "Radau 4", GVI_OWN, 4, radau },
    { "Radau 5", GVI_OWN, 5, radau },
};
static const row few[] = {
    { "Gauss s", GVI_GAUSS, 0, NULL }, { "Gauss s + 1", GVI_GAUSS, -1, NULL }, { "Lobatto s", GVI_LOBATTO, 0, NULL },
    { "Lobatto s + 1", GVI_LOBATTO, -1, NULL },
    { "Newton-Cotes s", GVI_OWN, 0, newton_cotes }, { "Radau s", GVI_OWN, 0, radau },
};

static const row two[] = { { "Gauss s", GVI_GAUSS, 0, NULL }, { "Lobatto s + 1", GVI_LOBATTO, -1, NULL } };

/* The order u of the rule of `line` for degree s, and the method; 0: there is no such rule */
static int method_of(const row *line, int s, method *m, own_rule *own)
{
    int r = line->r > 0 ? line->r : s - line->r;
    if (r < (line->own == newton_cotes ? 3 : line->kind == GVI_LOBATTO ? 2 : 1)) return 0;
    if (line->own) *own = line->own(r);
    *m = (method){ s, rule_or_own(line->kind, r, own) };
    return line->kind == GVI_OWN ? own->u : line->kind == GVI_LOBATTO ? 2*r - 2 : 2*r;
}

/* --------------------------------------------------------------------- studies */

static curve_kind what;                          /* the errors below see this */

static real norm_error(const problem *pb, const method *m, real h, int which)
{
    real norm[NORMS];
    curve_norms(pb, m, h, what, norm);
    return norm[which];
}

static real q_most(const problem *pb, const method *m, real h) { return norm_error(pb, m, h, 0); }
static real q_mean(const problem *pb, const method *m, real h) { return norm_error(pb, m, h, 1); }
static real v_most(const problem *pb, const method *m, real h) { return norm_error(pb, m, h, 2); }
static real v_mean(const problem *pb, const method *m, real h) { return norm_error(pb, m, h, 3); }

static real part_error(const problem *pb, const method *m, real h, int which)
{
    real error[PARTS];
    force_errors(pb, m, h, error);
    return error[which];
}

static real d1_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 0); }
static real d2_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 1); }
static real minus_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 2); }
static real plus_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 3); }

/* The expected exponent is the order and `more`; of a curve, half the order and `more` */
typedef struct grid { const problem *pb; error_fn *error; int more; const char *title; } grid;

/* A table of `rows` for each grid; `misses`: how many docs/theory.md names */
typedef struct study {
    const char *name, *file, *title, *note;
    const row  *rows;
    int         row_count, s, most, misses;
    double      within;
    grid        grids[GRIDS];
} study;

static const study studies[] = {
    { "order", "theorem_order", "Order seen, degree s against rule",
      "blue: within 0.2 of min(2s, u), all u &gt;= 2s - 2; u = 2r for Gauss, 2r - 2 for Lobatto",
      standard, 8, 8, 64, 0, 0.2,
      { { &problems[0], end_error, 0, NULL }, { &problems[1], end_error, 0, NULL },
        { &problems[2], end_error, 0, NULL }, { &problems[3], end_error, 0, NULL } } },
    { "order", "theorem_weak_rules", "Order seen, rules of the caller",
      "blue: within 0.2 of min(2s, u), or where u &lt; 2s - 2 of min(u, 2(u - s + 1)); "
      "no: r &lt; s or u &lt; s, refused", weak, 14, 8, 64, 0, 0.2,
      { { &problems[1], end_error, 0, NULL }, { &problems[3], end_error, 0, NULL } } },
    { "lagrangian", "theorem_lagrangian_order", "Exponent of h in |L_d - L_exact|",
      "blue: within 0.25 of min(2s, u) + 1, for the last row of min(u, 2(u - s + 1)) + 1", few, 5, 8, 96, 1, 0.25,
      { { &oscillator, lagrangian_error, 1, NULL }, { &problems[0], lagrangian_error, 1, NULL },
        { &problems[1], lagrangian_error, 1, NULL }, { &problems[2], lagrangian_error, 1, NULL },
        { &problems[3], lagrangian_error, 1, NULL } } },
    { "curve", "theorem_curve_order", "Exponent of h in the curve's distance, double pendulum",
      "blue: within 0.25 of min(s, u/2) + 1, + 2, + 0, + 1", few, 4, 6, 96, 0, 0.25,
      { { &problems[1], q_most, 1, "position, maximum" }, { &problems[1], q_mean, 2, "position, L1" },
        { &problems[1], v_most, 0, "velocity, maximum" }, { &problems[1], v_mean, 1, "velocity, L1" } } },
    { "forced", "theorem_forced", "Order seen, with forces",
      "blue: within 0.2 of min(2s, u); Newton-Cotes: of min(u, 2(u - s + 1))", few, 6, 6, 64, 0, 0.2,
      { { &forced_problems[0], end_error, 0, NULL }, { &forced_problems[1], end_error, 0, NULL },
        { &forced_problems[2], end_error, 0, NULL } } },
    { "forced", "theorem_forced_lagrangian", "Exponent of h, pendulum with motor and friction",
      "blue: within 0.2 of 2s + 1 for L_d, 2s for its derivatives and the discrete forces", two, 2, 5, 48, 0, 0.2,
      { { &forced_problems[2], lagrangian_error, 1, "L_d" }, { &forced_problems[2], d1_error, 0, "D_1 L_d" },
        { &forced_problems[2], d2_error, 0, "D_2 L_d" }, { &forced_problems[2], minus_error, 0, "F-" },
        { &forced_problems[2], plus_error, 0, "F+" } } },
};

static int misses, cells;

/* NaN: there is no such rule; both NaN: it has to be refused, and is */
static svg_cell measure(const study *a, const grid *g, const row *line, int s)
{
    method m;
    own_rule own;
    const int u = method_of(line, s, &m, &own), of_curve = strcmp(a->name, "curve") == 0;
    int order = u && s <= m.rule.points ? order_expected(s, u) : 0;
    if (u == 0) return (svg_cell){ NAN, 0 };
    if (order == 0) {
        const gvi_desc desc = bench_desc(g->pb, &m);
        const gvi_status status = gvi_init(&bench_stepper, &desc, bench_memory, sizeof bench_memory);
        if (status == GVI_E_POINTS || status == GVI_E_ORDER) return (svg_cell){ NAN, NAN };
        return ++misses, (svg_cell){ -1, 0 };
    }
    what = OF_THE_ENDS;
    const int expected = (of_curve ? order/2 : order) + g->more;
    /* odd orders belong to rules that are not symmetric: their errors have all powers of h, and the first shows late */
    const int most = !of_curve && order%2 ? 1600 : a->most;
    const svg_cell cell = { (double)slope(g->error, g->pb, &m, expected, most), expected };
    ++cells;
    misses += !(fabs(cell.got - expected) <= a->within);
    return cell;
}

static int run(const study *a, const char *folder)
{
    static const char *const columns[S] = { "s = 1", "2", "3", "4", "5", "6", "7", "8" };
    static svg_cell table[GRIDS][MOST_ROWS][S];
    svg_table tables[GRIDS];
    const char *names[MOST_ROWS];
    char path[500];
    int count = 0;
    misses = cells = 0;
    for (int i = 0; i < a->row_count; ++i) names[i] = a->rows[i].name;
    for (; count < GRIDS && a->grids[count].pb; ++count) {
        const grid *g = &a->grids[count];
        svg_cell *to = table[count][0];
        for (int i = 0; i < a->row_count; ++i)
            for (int s = 1; s <= a->s; ++s) to[i*a->s + s - 1] = measure(a, g, &a->rows[i], s);
        tables[count] = (svg_table){ g->title ? g->title : g->pb->name, names, columns, a->row_count, a->s, to };
        print_table(&tables[count]);
    }
    printf("\n%d of %d cells not within %.2f\n", misses, cells, a->within);
    snprintf(path, sizeof path, "%s/%s.svg", folder, a->file);
    if (svg_write_tables(path, a->title, a->note, a->within, tables, count, 2)) exit(1);
    return LDBL_MANT_DIG >= 113 && misses > a->misses;            /* fewer bits: rounding, not order */
}

/* ------------------------------------------------------------------ error against h */

static real state_most(const problem *pb, const method *m, real h)
{
    what = STATE_AT;
    return q_most(pb, m, h);
}

typedef struct against { const char *name; error_fn *error; method m; } against;

static void against_h(const char *folder, const char *file, const char *title, const char *y_label,
                      const problem *pb, const against *line)
{
    static const int steps[SIZES] = { 2, 3, 4, 5, 6, 8, 10, 13, 16, 20, 25, 32, 40, 51, 64, 81 };
    static double h[SIZES], error[LINES][SIZES];
    svg_line lines[LINES];
    for (int i = 0; i < LINES; ++i) {
        for (int k = 0; k < SIZES; ++k) {
            what = OF_THE_STEP;
            h[k] = (double)pb->time/steps[k];
            error[i][k] = (double)line[i].error(pb, &line[i].m, pb->time/steps[k]);
        }
        lines[i] = (svg_line){ line[i].name, h, error[i], SIZES };
    }
    draw(folder, file, &(svg_plot){ .title = title, .x_label = "step h", .y_label = y_label, .log_x = 1, .log_y = 1,
                                    .lines = lines, .line_count = LINES });
}

static void lagrangian_against_h(const char *folder)
{
    static const against lines[LINES] = {
        { "s = 1", lagrangian_error, { 1, { 0 } } }, { "s = 2", lagrangian_error, { 2, { 0 } } },
        { "s = 3", lagrangian_error, { 3, { 0 } } }, { "s = 4", lagrangian_error, { 4, { 0 } } },
        { "s = 5", lagrangian_error, { 5, { 0 } } }, { "s = 6", lagrangian_error, { 6, { 0 } } },
    };
    against_h(folder, "theorem_lagrangian", "Discrete against exact Lagrangian, double pendulum", "|L_d - L_exact|",
              &problems[1], lines);
    printf("\nL_d of degree 24 at h = 1/4 against the reference:");         /* two that know nothing of each other */
    for (int k = 0; k <= PROBLEMS; ++k) {
        const problem *pb = k ? &problems[k - 1] : &oscillator;
        const method m = { 24, { 0 } };
        printf("%s %s %.1e", k ? "," : "", pb->name, (double)lagrangian_error(pb, &m, 0.25L));
    }
    printf("\n");
}

static void curve_against_h(const char *folder)
{
    static const against lines[LINES] = {
        { "curve, s = 3", q_most, { 3, { 0 } } }, { "velocity, s = 3", v_most, { 3, { 0 } } },
        { "state, s = 3", state_most, { 3, { 0 } } }, { "curve, s = 6", q_most, { 6, { 0 } } },
        { "velocity, s = 6", v_most, { 6, { 0 } } }, { "state, s = 6", state_most, { 6, { 0 } } },
    };
    against_h(folder, "theorem_curve", "Largest error inside one step, double pendulum", "error", &problems[1], lines);
}

/* ---------------------------------------------------------- what theorem 4.1 needs

   Rules with u = 2s - 2 and with less; Milne's has a negative weight            */
static void counterexample(const char *folder)
{
    const own_rule rule[3] = { newton_cotes(4), newton_cotes(5), milne };
    static const char *const name[3] = { "3/8", "Boole", "Milne" };
    static const struct { int rule, s; } cases[] = { { 0, 3 }, { 0, 4 }, { 1, 4 }, { 1, 5 }, { 2, 3 } };
    const problem *pb = &problems[0];
    method m[5];
    printf("\nKepler's problem: exponents of h, negative directions of a step and how many there are, coercivity\n"
           "rule    s  u  min(2s,u)  order    L_d  d^s q/dt^s  negative  least c\n");
    for (int k = 0; k < 5; ++k) {
        const own_rule *at = &rule[cases[k].rule];
        const int s = cases[k].s;
        m[k] = (method){ s, rule_or_own(GVI_OWN, at->r, at) };
        printf("%-6s %2d %2d  %9d  %5.2f  %5.2f  %10.2f  %2d of %2d  %7.4f\n", name[cases[k].rule], s, at->u,
               at->u < 2*s ? at->u : 2*s, (double)slope(end_error, pb, &m[k], order_expected(s, at->u), 192),
               (double)slope(lagrangian_error, pb, &m[k], order_expected(s, at->u) + 1, 192),
               (double)slope(top_derivative, pb, &m[k], 1, 192), most_negative(pb, &m[k]), pb->n*(s - 1),
               (double)coercivity(at, s));
    }
    const against lines[LINES] = {
        { "3/8 rule, s = 3", end_error, m[0] }, { "3/8 rule, s = 4", end_error, m[1] },
        { "Boole, s = 4", end_error, m[2] }, { "Boole, s = 5", end_error, m[3] },
        { "d^4 q/dt^4, 3/8, s = 4", top_derivative, m[1] }, { "d^5 q/dt^5, Boole, s = 5", top_derivative, m[3] },
    };
    against_h(folder, "theorem_counterexample", "Kepler: a degree more than the rule can bear lowers the order",
              "error at t = 2; size of the derivative", pb, lines);
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "order", *folder = argc > 2 ? argv[2] : ".";
    int failed = 0;
    printf("%s, with %d bits\n", name, LDBL_MANT_DIG);
    for (size_t k = 0; k < sizeof studies/sizeof *studies; ++k)
        if (strcmp(studies[k].name, name) == 0) failed |= run(&studies[k], folder);
    if (strcmp(name, "counterexample") == 0) counterexample(folder);
    if (strcmp(name, "lagrangian") == 0) lagrangian_against_h(folder);
    if (strcmp(name, "curve") == 0) curve_against_h(folder);
    return failed;
}
