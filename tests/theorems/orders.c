/* Theorems about orders: the exponent of h in an error, cell by cell, rule against degree.

     order           4.1 for Gauss, Lobatto and rules of the caller: min(2s, u, 2(u - s + 1))
     rules           the same for nodes at random, with weights of any sign, on everything that the theorem admits,
                     and what else it says, with forces; exponent against u
     constant        the leading term of L_d - L_exact, measured over predicted
     counterexample  4.1 as printed asks for no more than u >= s
     lagrangian      2.1: |L_d - L_exact| = O(h^(order + 1)), between any two ends
     curve           5.1, corrected: between the ends of an exact solution the curve has order min(s, u - s + 1) + 1 in
                     the maximum norm, one more in L1, its velocity one less each
     forced          6: the order of the step with drag, with air drag like |v|v, and with a motor whose torque
                     depends on time and speed; what is left of L_d and of the discrete forces; (dLdA3) and 6.2 as
                     printed

     orders study [folder]      writes theorem_*.svg                           */
#include "inertia.h"
#include "constant.h"
#include "printed.h"
#include "stability.h"
#include "tables.h"

enum { S = 8, MOST_ROWS = 14, GRIDS = 8 };

/* ----------------------------------------------------------------------- rules */

/* r points, or where r <= 0 as many as the degree and -r more; of a random rule r is its order */
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
static own_rule interpolatory(int u) { return random_rule(u, u, 1); }
static own_rule drawn(int u) { return random_rule(u + 2, u, 1); }

static const row at_random[] = {
    { "u = 1, 1 point", GVI_OWN, 1, interpolatory }, { "2, 2 points", GVI_OWN, 2, interpolatory },
    { "3, 3 points", GVI_OWN, 3, interpolatory }, { "4, 4 points", GVI_OWN, 4, interpolatory },
    { "5, 5 points", GVI_OWN, 5, interpolatory }, { "6, 6 points", GVI_OWN, 6, interpolatory },
    { "7, 7 points", GVI_OWN, 7, interpolatory }, { "8, 8 points", GVI_OWN, 8, interpolatory },
    { "3, 5 points", GVI_OWN, 3, drawn }, { "4, 6 points", GVI_OWN, 4, drawn }, { "5, 7 points", GVI_OWN, 5, drawn },
    { "6, 8 points", GVI_OWN, 6, drawn }, { "7, 9 points", GVI_OWN, 7, drawn },
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
    if (line->own) r = (*own = line->own(r)).r;
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
    real error[PARTS_AND_SUMS];
    force_errors(pb, m, h, error);
    return error[which];
}

static real d1_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 0); }
static real d2_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 1); }
static real minus_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 2); }
static real plus_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 3); }
static real sum_error(const problem *pb, const method *m, real h) { return part_error(pb, m, h, 5); }

/* The expected exponent is the order of the step, or of the velocity along the curve, and `more` */
typedef enum order_of { STEP, VELOCITY } order_of;
typedef struct grid { const problem *pb; error_fn *error; order_of of; int more; const char *title; } grid;

/* A table of `rows` for each grid; `most`, of odd orders `most_odd`: steps in which a run is cut; `misses`: how many
   docs/theory.md names                                                       */
typedef struct study {
    const char *name, *file, *title, *note;
    const row  *rows;
    int         row_count, s, most, most_odd, misses;
    double      within;
    grid        grids[GRIDS];
} study;

#define KEPLER   &problems[0]
#define PENDULUM &problems[1]
#define MAGNETIC &problems[2]
#define LENGTH   &problems[3]
#define SADDLE   &problems[4]
#define MIXED    &problems[5]
#define DRAG     &forced_problems[0]
#define AIR      &forced_problems[1]
#define MOTOR    &forced_problems[2]
#define SWIRL    &forced_problems[3]

static const study studies[] = {
    { "order", "theorem_order", "Order seen, degree s against rule",
      "blue: within 0.2 of min(2s, u), all u &gt;= 2s - 2; u = 2r for Gauss, 2r - 2 for Lobatto",
      standard, 8, 8, 64, 64, 0, 0.2,
      { { KEPLER, end_error, STEP, 0, NULL }, { PENDULUM, end_error, STEP, 0, NULL },
        { MAGNETIC, end_error, STEP, 0, NULL }, { LENGTH, end_error, STEP, 0, NULL } } },
    { "order", "theorem_weak_rules", "Order seen, rules of the caller",
      "blue: within 0.2 of min(2s, u, 2(u - s + 1)); no: r &lt; s or u &lt; s, refused", weak, 14, 8, 64, 1600, 0, 0.2,
      { { PENDULUM, end_error, STEP, 0, NULL }, { LENGTH, end_error, STEP, 0, NULL } } },
    { "rules", "theorem_rules", "Exponent of h in one step's error, nodes at random",
      "blue: within 0.25 of min(2s, u, 2(u - s + 1)) + 1; 2 points more than u: weights drawn too",
      at_random, 13, 6, 6400, 6400, 0, 0.25,
      { { KEPLER, step_error, STEP, 1, NULL }, { PENDULUM, step_error, STEP, 1, NULL },
        { MAGNETIC, step_error, STEP, 1, NULL }, { LENGTH, step_error, STEP, 1, NULL },
        { SADDLE, step_error, STEP, 1, NULL }, { MIXED, step_error, STEP, 1, NULL },
        { AIR, step_error, STEP, 1, NULL }, { SWIRL, step_error, STEP, 1, NULL } } },
    { "rules", "theorem_rules_step", "Exponents of h, nodes at random, mixed problem with forces",
      "blue: within 0.25 of l + 1, l, l, l + 1, sigma + 1, sigma; l = min(2s, u, 2 sigma), sigma = min(s, u - s + 1)",
      at_random, 13, 6, 400, 400, 0, 0.25,
      { { SWIRL, lagrangian_error, STEP, 1, "L_d" }, { SWIRL, minus_error, STEP, 0, "F-" },
        { SWIRL, plus_error, STEP, 0, "F+" }, { SWIRL, sum_error, STEP, 1, "F- + F+" },
        { SWIRL, q_most, VELOCITY, 1, "curve" }, { SWIRL, v_most, VELOCITY, 0, "its velocity" } } },
    { "lagrangian", "theorem_lagrangian_order", "Exponent of h in |L_d - L_exact|",
      "blue: within 0.25 of min(2s, u) + 1, for the last row of min(u, 2(u - s + 1)) + 1", few, 5, 8, 96, 96, 3, 0.25,
      { { &oscillator, lagrangian_error, STEP, 1, NULL }, { KEPLER, lagrangian_error, STEP, 1, NULL },
        { PENDULUM, lagrangian_error, STEP, 1, NULL }, { MAGNETIC, lagrangian_error, STEP, 1, NULL },
        { LENGTH, lagrangian_error, STEP, 1, NULL }, { SADDLE, lagrangian_error, STEP, 1, NULL },
        { MIXED, lagrangian_error, STEP, 1, NULL },
        { PENDULUM, any_lagrangian_error, STEP, 1, "pendulum, any two ends" } } },
    { "curve", "theorem_curve_order", "Exponent of h in the curve's distance, double pendulum",
      "blue: within 0.25 of min(s, u - s + 1) and 1, 2, 0, 1 more", few, 6, 6, 96, 96, 0, 0.25,
      { { PENDULUM, q_most, VELOCITY, 1, "position, maximum" }, { PENDULUM, q_mean, VELOCITY, 2, "position, L1" },
        { PENDULUM, v_most, VELOCITY, 0, "velocity, maximum" }, { PENDULUM, v_mean, VELOCITY, 1, "velocity, L1" } } },
    { "forced", "theorem_forced", "Order seen, with forces",
      "blue: within 0.2 of min(2s, u); Newton-Cotes: of min(u, 2(u - s + 1))", few, 6, 6, 64, 1600, 0, 0.2,
      { { DRAG, end_error, STEP, 0, NULL }, { AIR, end_error, STEP, 0, NULL },
        { MOTOR, end_error, STEP, 0, NULL }, { SWIRL, end_error, STEP, 0, NULL } } },
    { "forced", "theorem_forced_lagrangian", "Exponent of h, pendulum with motor and friction",
      "blue: within 0.2 of 2s + 1 for L_d, 2s for its derivatives and the discrete forces", two, 2, 5, 48, 48, 0, 0.2,
      { { MOTOR, lagrangian_error, STEP, 1, "L_d" }, { MOTOR, d1_error, STEP, 0, "D_1 L_d" },
        { MOTOR, d2_error, STEP, 0, "D_2 L_d" }, { MOTOR, minus_error, STEP, 0, "F-" },
        { MOTOR, plus_error, STEP, 0, "F+" } } },
};

static int misses, cells;

/* NaN: there is no such rule; both NaN: it has to be refused, and is */
static svg_cell measure(const study *a, const grid *g, const row *line, int s)
{
    method m;
    own_rule own;
    const int u = method_of(line, s, &m, &own);
    const int order = u && s <= m.rule.points ? order_expected(s, u) : 0;
    if (u == 0) return (svg_cell){ NAN, 0 };
    if (order == 0) {
        const gvi_desc desc = bench_desc(g->pb, &m);
        const gvi_status status = gvi_init(&bench_stepper, &desc, bench_memory, sizeof bench_memory);
        if (status == GVI_E_POINTS || status == GVI_E_ORDER) return (svg_cell){ NAN, NAN };
        return ++misses, (svg_cell){ -1, 0 };
    }
    what = OF_THE_ENDS;
    const int expected = (g->of == VELOCITY ? velocity_expected(s, u) : order) + g->more;
    /* odd orders belong to rules that are not symmetric: their errors have all powers of h, and the first shows late */
    const int most = order%2 ? a->most_odd : a->most;
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

/* Two that know nothing of each other */
static void degree_20(void)
{
    printf("\nL_d of degree 20 at h = 1/4 against the reference:");
    for (int k = 0; k <= PROBLEMS; ++k) {
        const problem *pb = k ? &problems[k - 1] : &oscillator;
        const method m = { 20, { 0 } };
        printf("%s %s %.1e", k ? "," : "", pb->name, (double)lagrangian_error(pb, &m, 0.25L));
    }
    printf("\n");
}

/* ------------------------------------------------------------- exponent against u

   Order of the step on the mixed problem with forces, from one step's error, for s = 2..6 and u = s..2s + 2: the
   theorem as lines, what is measured as crosses                              */
static double mark_x[300], mark_y[300];
static int    marks;

static void mark(double x, double y)
{
    const double xs[] = { x - 0.09, x + 0.09, NAN, x, x, NAN }, ys[] = { y, y, NAN, y - 0.13, y + 0.13, NAN };
    memcpy(mark_x + marks, xs, sizeof xs);
    memcpy(mark_y + marks, ys, sizeof ys);
    marks += 6;
}

static int exponents(const char *folder)
{
    enum { FIRST = 2, DEGREES = 5, US = FIRST + DEGREES + 3 };
    static const char *const name[DEGREES] = { "s = 2", "s = 3", "s = 4", "s = 5", "s = 6" };
    static double us[DEGREES][US], law[DEGREES][US];
    svg_line lines[DEGREES + 1];
    int off = 0;
    printf("\norder of the step on the %s, u = s .. 2s + 2 at most 12; in brackets min(2s, u, 2(u - s + 1))\n", (SWIRL)->name);
    for (int k = 0; k < DEGREES; ++k) {
        const int s = FIRST + k;
        int count = 0;
        printf("%s:", name[k]);
        for (int u = s; u <= 2*s + 2 && u <= MAX_R; ++u, ++count) {
            const own_rule rule = random_rule(u, u, 1);
            const method m = { s, rule_or_own(GVI_OWN, u, &rule) };
            const int order = order_expected(s, u);
            const double seen = (double)slope(step_error, SWIRL, &m, order + 1, 6400) - 1;
            us[k][count] = u;
            law[k][count] = order;
            mark(u, seen);
            printf("  %.2f (%d)", seen, order);
            off += !(fabs(seen - order) <= 0.2);
        }
        lines[k] = (svg_line){ name[k], us[k], law[k], count };
        printf("\n");
    }
    lines[DEGREES] = (svg_line){ "measured", mark_x, mark_y, marks };
    draw(folder, "theorem_exponent", &(svg_plot){
        .title = "Order of the step: min(2s, u, 2(u - s + 1))", .x_label = "order u of the rule", .y_label = "order",
        .lines = lines, .line_count = DEGREES + 1, .thick = 1u << DEGREES });
    return off;
}

/* ------------------------------------------------------------------ the constant

   Rules with u < 2s - 2, and one with u > 2s */
typedef struct weak_case { const char *name; int s; own_rule rule; } weak_case;

static const own_rule smallest = { "smallest", 3, 3, { 0.25L, 0.5L, 1 }, { 4/9.0L, 1/3.0L, 2/9.0L } };

enum { WEAK_CASES = 6, STEPS = 14 };

static int constants(const char *folder)
{
    const weak_case cases[WEAK_CASES] = {
        { "4/9, 1/3, 2/9, s = 3", 3, smallest }, { "3/8, s = 4", 4, newton_cotes(4) },
        { "random u = 4, s = 4", 4, random_rule(6, 4, 1) }, { "Boole, s = 5", 5, newton_cotes(5) },
        { "random u = 6, s = 6", 6, random_rule(6, 6, 1) }, { "Gauss 3, s = 2", 2, gauss(3) },
    };
    static double h[STEPS], off[WEAK_CASES][STEPS];
    svg_line lines[WEAK_CASES];
    int far = 0;
    printf("\nL_d - L_exact over its leading term at h = 1/16384, of three starts the one farthest from 1\n%-22s", "");
    for (int i = 0; i <= PROBLEMS; ++i) printf("  %.10s", i ? problems[i - 1].name : oscillator.name);
    for (int k = 0; k < WEAK_CASES; ++k) {
        const weak_case *a = &cases[k];
        printf("\n%-22s", a->name);
        for (int i = 0; i <= PROBLEMS; ++i) {
            const double seen = (double)constant_seen(i ? &problems[i - 1] : &oscillator, &a->rule, a->s, 1/16384.0L);
            printf("  %8.5f", seen);
            far += !(fabs(seen - 1) <= 0.01);
        }
        for (int j = 0; j < STEPS; ++j) {
            h[j] = pow(2, -2 - j/1.5);
            off[k][j] = fabs((double)constant_seen(MIXED, &a->rule, a->s, h[j]) - 1);
        }
        lines[k] = (svg_line){ a->name, h, off[k], STEPS };
    }
    printf("\n%d of %d not within 0.01\n", far, WEAK_CASES*(PROBLEMS + 1));
    draw(folder, "theorem_constant", &(svg_plot){
        .title = "L_d - L_exact over its leading term, mixed problem", .x_label = "step h", .y_label = "distance from 1",
        .log_x = 1, .log_y = 1, .lines = lines, .line_count = WEAK_CASES });
    return far;
}

/* --------------------------------------------------- what theorem 4.1 does not say */

static void counterexample(void)
{
    const weak_case cases[] = {
        { "smallest", 3, smallest }, { "3/8", 3, newton_cotes(4) }, { "3/8", 4, newton_cotes(4) },
        { "Boole", 4, newton_cotes(5) }, { "Boole", 5, newton_cotes(5) }, { "Milne", 3, milne },
        { "X = 0", 4, rule_without_phi_2(6) }, { "outside", 3, random_rule(3, 3, 1.4L) },
        { "outside", 4, random_rule(5, 5, 1.4L) }, { "singular", 3, rule_without_phi_2(5) }, { "u < s", 4, random_rule(5, 3, 1) },
    };
    printf("\nKepler's problem: exponents of h; least ratio of the action's second variation to the integral of |w'|^2,\n"
           "of the rule, and of h <= 1/8 on the double pendulum over the least eigenvalue of M(q); negative directions\n"
           "rule       s  u  min(2s,u)  theorem    order    L_d       X   rule's  pendulum's  negative\n");
    for (size_t k = 0; k < sizeof cases/sizeof *cases; ++k) {
        const weak_case *a = &cases[k];
        const method m = { a->s, rule_or_own(GVI_OWN, a->rule.r, &a->rule) };
        const int order = order_expected(a->s, a->rule.u);
        const real c = coercivity(&a->rule, a->s);
        printf("%-9s %2d %2d  %9d  %7d  %7.2f  %5.2f  %6.3g  %7.4f  %10.4f  %2d of %d\n", a->name, a->s, a->rule.u,
               least(2*a->s, a->rule.u), order, (double)slope(own_step_error, KEPLER, &m, order + 1, 6400) - 1,
               (double)slope(own_lagrangian_error, KEPLER, &m, order + 1, 1600), (double)last_of_inverse(&a->rule, a->s),
               (double)c, c > 0.001L ? (double)coercivity_seen(PENDULUM, &a->rule, a->s) : NAN,
               most_negative(KEPLER, &m), 2*(a->s - 1));
    }

    const own_rule three_eighths = newton_cotes(4);
    const method m = { 4, rule_or_own(GVI_OWN, 4, &three_eighths) };
    printf("\n3/8, s = 4.  Oscillator: (omega - 1)/h^2 = ");
    for (int N = 8; N <= 512; N *= 8) printf("%.10f, ", (double)((acos(half_trace(&m, 1/(real)N))*N - 1)*N*N));
    printf("1/72 = %.10f\nUniform field g = 3/2: 72 (L_d - L_exact)/(g^2 h^3) = ", 1/72.0);
    for (int N = 2; N <= 32; N *= 4)
        printf("%.15f, ", (double)(72*lagrangian_excess(&uniform_field, &m, 0, 1/(real)N)*N*N*N/2.25L));
    printf("momenta wrong by %.0e\n", (double)part_error(&uniform_field, &m, 0.5L, 0));
}

/* ------------------------------------------------------------- forces, as printed */

static void as_printed(void)
{
    static const char *const where[] = { "Lobatto's", "equidistant", "at random" };
    printf("\n(dLdA3) as printed, q(1) of an oscillator with f = 1 - v/2, Gauss s\n");
    for (int s = 2; s <= 3; ++s) {
        const own_rule B = newton_cotes(s + 1), at = gauss(s);
        const method m = { s, rule_or_own(GVI_OWN, s, &at) };
        real y[MAX_Y], part[MAX_Y];
        share_of_push = 2*B.b[0];
        start_state(&pushed, 0, part);
        flow_of(&pushed, 0, 1, part);
        share_of_push = 1;
        start_state(&pushed, 0, y);
        gvi_stepper *st = bench(&pushed, &m, 0, y);
        for (int k = 0; k < 40; ++k) gvi_step(st, 1/40.0L);
        printf("s = %d: as printed, h = 1/10, 1/20, 1/40: %.7f %.7f %.7f; solution with %.4f f: %.7f\n"
               "       gvi.h, h = 1/40: %.7f;", s, (double)position_as_printed(s, 10), (double)position_as_printed(s, 20),
               (double)position_as_printed(s, 40), (double)(2*B.b[0]), (double)part[0], (double)st->q[0]);
        flow_of(&pushed, 0, 1, y);
        printf(" solution: %.7f\n", (double)y[0]);
    }
    printf("\n6.2, first term: exponents for s = 2..6, %s, control points\n", (MOTOR)->name);
    for (int k = AT_LOBATTO; k <= AT_RANDOM; ++k) {
        printf("%-12s", where[k]);
        control_points = (control)k;
        for (int s = 2; s <= 6; ++s)
            printf(" %6.2f", (double)slope(first_term, MOTOR, &(method){ s, { 0 } }, k ? s + 2 : 2*s + 1, k ? 400 : 48));
        printf("\n");
    }
}

int main(int argc, char **argv)
{
    const char *name = argc > 1 ? argv[1] : "order", *folder = argc > 2 ? argv[2] : ".";
    int failed = 0;
    printf("%s, with %d bits\n", name, LDBL_MANT_DIG);
    for (size_t k = 0; k < sizeof studies/sizeof *studies; ++k)
        if (strcmp(studies[k].name, name) == 0) failed |= run(&studies[k], folder);
    if (strcmp(name, "rules") == 0) failed |= exponents(folder) && LDBL_MANT_DIG >= 113;
    if (strcmp(name, "constant") == 0) failed |= constants(folder) && LDBL_MANT_DIG >= 113;
    if (strcmp(name, "counterexample") == 0) counterexample();
    if (strcmp(name, "lagrangian") == 0) degree_20();
    if (strcmp(name, "forced") == 0) as_printed();
    return failed;
}
