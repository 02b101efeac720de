/* Theorem 4.1: degree s and a rule of order u give order min(2s, u).

   The order that is seen, from the errors at the end of runs with two step sizes,
   for s = 1..8 against Gauss and Lobatto with r = s..s+3, on four problems; then
   against rules that are too weak, where theory.md expects min(u, 2(u - s + 1)).

     order [folder]        writes theorem_order.svg and theorem_weak_rules.svg  */
#include "bench.h"
#include "rules.h"
#include "tables.h"

enum { S = 8, EXTRA = 4, OWN = 14 };
static const double WITHIN = 0.2;

static const char *const s_names[S] = { "s = 1", "2", "3", "4", "5", "6", "7", "8" };
static const char *const rule_names[2*EXTRA] = {
    "Gauss r = s", "s + 1", "s + 2", "s + 3", "Lobatto r = s", "s + 1", "s + 2", "s + 3"
};

static int misses, cells;

static svg_cell measure(const problem *pb, const method *m, int expected)
{
    /* odd orders belong to rules that are not symmetric: their errors have all
       powers of h, and the first shows late                                   */
    int most = expected%2 ? 1600 : 64;
    svg_cell cell = { (double)slope(end_error, pb, m, expected, most), expected };
    ++cells;
    if (!(fabs(cell.got - cell.expected) <= WITHIN)) ++misses;
    return cell;
}

static svg_cell standard_cell(const problem *pb, int s, int row)
{
    int lobatto_ = row >= EXTRA, r = s + row%EXTRA, u = lobatto_ ? 2*r - 2 : 2*r;
    method m = { s, { .kind = lobatto_ ? GVI_LOBATTO : GVI_GAUSS, .points = r } };
    if (lobatto_ && r < 2) return (svg_cell){ NAN, 0 };
    return measure(pb, &m, smaller_int(2*s, u));
}

static svg_cell own_cell(const problem *pb, int s, const own_rule *rule)
{
    int expected = s <= rule->r ? order_expected(s, rule->u) : 0;
    method m = { s, { GVI_OWN, rule->r, rule->c, rule->b } };
    if (expected == 0) {
        gvi_desc desc = bench_desc(pb, &m);
        gvi_status status = gvi_init(&bench_stepper, &desc, bench_memory, sizeof bench_memory);
        int refused = status == GVI_E_POINTS || status == GVI_E_ORDER;
        if (!refused) { ++misses; return (svg_cell){ -1, 0 }; }
        return (svg_cell){ NAN, NAN };
    }
    return measure(pb, &m, expected);
}

static void standard_rules(const char *folder)
{
    static svg_cell table[PROBLEMS][2*EXTRA][S];
    static svg_table grids[PROBLEMS];
    char path[500];
    for (int k = 0; k < PROBLEMS; ++k) {
        for (int row = 0; row < 2*EXTRA; ++row)
            for (int s = 1; s <= S; ++s) table[k][row][s - 1] = standard_cell(&problems[k], s, row);
        grids[k] = (svg_table){ problems[k].name, rule_names, s_names, 2*EXTRA, S, table[k][0] };
        print_table(&grids[k]);
    }
    snprintf(path, sizeof path, "%s/theorem_order.svg", folder);
    if (svg_write_tables(path, "Order seen, degree s against rule",
                   "blue: within 0.2 of min(2s, u); u = 2r for Gauss, 2r - 2 for Lobatto",
                   WITHIN, grids, PROBLEMS, 2)) exit(1);
}

static void weak_rules(const char *folder)
{
    static own_rule rules[OWN];
    static char names[OWN][40];
    static const char *rows[OWN];
    static svg_cell table[2][OWN][S];
    static svg_table grids[2];
    static const int which[2] = { 1, 3 };
    char path[500];
    for (int k = 0; k < OWN; ++k) {
        rules[k] = k < 5 ? newton_cotes(k + 3) : k < 10 ? clenshaw_curtis(k - 1) : radau(k - 8);
        snprintf(names[k], sizeof names[k], "%s %d", rules[k].name, rules[k].r);
        rows[k] = names[k];
    }
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < OWN; ++i)
            for (int s = 1; s <= S; ++s) table[k][i][s - 1] = own_cell(&problems[which[k]], s, &rules[i]);
        grids[k] = (svg_table){ problems[which[k]].name, rows, s_names, OWN, S, table[k][0] };
        print_table(&grids[k]);
    }
    snprintf(path, sizeof path, "%s/theorem_weak_rules.svg", folder);
    if (svg_write_tables(path, "Order seen, rules of the caller",
                   "blue: within 0.2 of min(2s, u), or where u &lt; 2s - 2 of min(u, 2(u - s + 1)); "
                   "no: r &lt; s or u &lt; s, refused", WITHIN, grids, 2, 2)) exit(1);
}

int main(int argc, char **argv)
{
    const char *folder = argc > 1 ? argv[1] : ".";
    printf("Theorem 4.1, order min(2s, u), with %d bits\n", LDBL_MANT_DIG);
    standard_rules(folder);
    weak_rules(folder);
    printf("\n%d of %d cells not within %.1f\n", misses, cells, WITHIN);
    return LDBL_MANT_DIG >= 113 && misses > 0;                /* fewer bits: rounding, not order */
}
