/* embedded.c - a step on a small processor: what its instructions buy

     embedded --table COUNTS            Markdown: instructions, bound, drift and error of every setting; steps
                                        a second for a tenth of 80 MHz, two cycles an instruction
     embedded --choice FILE COUNTS      over the step size: the cheapest setting for a drift or an error, and
                                        what gvi.h costs over what a step by hand costs, also with a force
                                        that takes 300, 1000 or 3000 instructions more; FILE: a picture
     embedded --rounding COUNTS NAME    a million steps; NAME: carried, or plain where gvi.h was changed

   COUNTS are the lines that embedded_count.c printed; tests/tools/embedded_cost.sh does all of it.
   Drift and error are found here, in the same type: the state after the counted steps must have the same
   bits on both machines, or this program fails.

   Drift: the energy, averaged over the last tenth of the steps, less that of the first, over that at
   the start; the averages have smooth weights, so that what only swings is not counted.
   Error: the largest of q in the first 1000 steps, against Runge-Kutta of order 4 in double with
   64 times as many steps.                                                                      */
#define GVI_IMPLEMENTATION
#define GVI_STATIC
#include "gvi.h"
#include "embedded_run.h"
#include "embedded_bound.h"
#include "embedded_truth.h"
#include "tools/svg.h"

#include <stdlib.h>
#include <string.h>

enum { DRIFT_STEPS = 100000, SWEPT_STEPS = 30000, ERROR_STEPS = 1000, LONG_STEPS = 1000000 };
enum { SIZES = 13, LINES = 8 };

typedef struct counts {
    int      present, steps;
    double   mean;
    long     most, first, iterations, failures;
    uint32_t bits;
} counts;

static counts counted[SCENES][SETTINGS];
static int bad;

static void complain(const char *what, const scene *s, const setting *t)
{
    fprintf(stderr, "FAILED: embedded: %s: %s, method %d, degree %d, %d iterations\n", s->name, what,
            (int)t->method, t->degree, t->iterations);
    bad = 1;
}

/* -------------------------------------------------------------------- runs */

static int run_failed(const run *r) { return !by_hand_only(r->setting) && r->st.status != GVI_OK; }

static void run_step(run *r)
{
    run_control(r);
    if (r->step) r->step(&drive, &r->hand, r->h);
    else gvi_step(&r->st, r->h);
    ++r->k;
}

/* Configuration and velocity with what rounding left of them                                    */
static void run_state(const run *r, double *y)
{
    const int n = r->scene->n;
    for (int i = 0; i < n; ++i)
        if (by_hand_only(r->setting)) {
            y[i] = (double)r->hand.y[i] + (double)r->hand.rest[i];
            y[n + i] = (double)r->hand.y[n + i] + (double)r->hand.rest[n + i];
        } else {
            y[i] = (double)r->st.q[i] + (double)r->st.q_low[i];
            y[n + i] = (double)r->st.p[i] + (double)r->st.p_low[i];
        }
    if (!by_hand_only(r->setting)) true_velocity((int)(r->scene - scenes), y);
}

static double run_energy(const run *r)
{
    double y[4];
    run_state(r, y);
    return true_energy((int)(r->scene - scenes), y);
}

/* A smooth bump on (0, 1): averages of what oscillates vanish faster than any power             */
static double bump(double x) { return x > 0 && x < 1 ? exp(-1/(x*(1 - x))) : 0; }

/* The energy at the start, and averages over the first and the last tenth of the steps          */
typedef struct averages { double first, a, b, weight_a, weight_b; } averages;

static void average(averages *m, const run *r, long k, long steps)
{
    const double tenth = (double)steps/10, a = bump((double)k/tenth), b = bump((double)(k - steps)/tenth + 1);
    if (k > 0 && !(a > 0) && !(b > 0)) return;
    const double e = run_energy(r);
    if (k == 0) m->first = e;
    m->a += a*(e/m->first - 1);
    m->b += b*(e/m->first - 1);
    m->weight_a += a;
    m->weight_b += b;
}

/* What it gains from start to end, a fraction of the first; HUGE_VAL if a step has failed       */
static double drift(const averages *m, const run *r)
{
    return run_failed(r) ? HUGE_VAL : fabs(m->b/m->weight_b - m->a/m->weight_a)/0.9;
}

static double drift_of(run *r, long steps)
{
    averages m = { 0, 0, 0, 0, 0 };
    average(&m, r, 0, steps);
    for (long k = 1; k <= steps && !run_failed(r); ++k) {
        run_step(r);
        average(&m, r, k, steps);
    }
    return drift(&m, r);
}

static double distance(const run *r, const truth *x)
{
    double y[4], most = 0;
    run_state(r, y);
    for (int i = 0; i < r->scene->n; ++i) most = fmax(most, fabs(y[i] - x->y[i]));
    return most;
}

static double error_of(run *r, long steps, int substeps)
{
    const int index = (int)(r->scene - scenes);
    double most = 0;
    truth x;
    true_start(index, &x);
    for (long k = 0; k < steps; ++k) {
        run_step(r);
        if (run_failed(r)) return HUGE_VAL;
        true_step(index, &x, (double)r->h, substeps);
        most = fmax(most, distance(r, &x));
    }
    return most;
}

/* -------------------------------------------------------------------- counts */

static void read_counts(const char *path)
{
    char line[400];
    FILE *f = fopen(path, "r");
    int i, k, steps;
    unsigned long all, bits;
    counts c;
    while (f && fgets(line, sizeof line, f))
        if (sscanf(line, "row %d %d %d %lu %ld %ld %ld %lu %ld", &i, &k, &steps, &all, &c.most, &c.first,
                   &c.iterations, &bits, &c.failures) == 9
            && i >= 0 && i < SCENES && k >= 0 && k < SETTINGS) {
            c.present = 1;
            c.steps = steps;
            c.mean = (double)all/(steps - STEPS_FIRST);
            c.bits = (uint32_t)bits;
            counted[i][k] = c;
        }
    if (!f) { fprintf(stderr, "FAILED: embedded: no %s\n", path); exit(1); }
    fclose(f);
}

/* Do as many steps as were counted end with the same bits here?                                 */
static void check_bits(const scene *s, int index)
{
    static run r;
    const counts *c = &counted[s - scenes][index];
    if (c->failures > 0) return;
    run_start(&r, s, settings + index, s->h);
    for (int k = 0; k < c->steps; ++k) run_step(&r);
    if (run_bits(&r) != c->bits) complain("other bits than on the small processor", s, settings + index);
}

/* -------------------------------------------------------------------- table */

static void name_of(const setting *t, char *name, size_t size)
{
    static const char *const names[] = { "Verlet by hand", "Verlet by hand, compensated", "RK4 by hand",
                                         "RK4 by hand, compensated", "Lobatto 2 (Verlet)", "kicks, Suzuki 4" };
    if (t->method < FIXED) snprintf(name, size, "%s", names[t->method]);
    else snprintf(name, size, "Gauss, s = %d%s", t->degree, t->method == FIXED_GIVEN ? ", v given" : "");
}

/* Operations, of which there is a bound where the iterations are fixed                          */
static double bound_of(const scene *s, const setting *t)
{
    const int r = t->method == SUZUKI ? 6 : t->method == EXPLICIT ? 2 : t->degree;
    if (by_hand_only(t) || (t->method >= FIXED && t->iterations == 0)) return 0;
    return flops_of_step(t->method < FIXED ? GVI_EXPLICIT : s->fixed,
                         t->method == FIXED_GIVEN ? GVI_MASS_UNIT : s->mass.kind, s->n, r, t->iterations);
}

static void print_cell(double x)
{
    if (!(x < HUGE_VAL)) printf(" fails |");
    else printf(" %.1e |", x);
}

static void table_row(const scene *s, int index)
{
    static run r;
    const setting *t = settings + index;
    const counts *c = &counted[s - scenes][index];
    const double bound = bound_of(s, t);
    char name[60];
    name_of(t, name, sizeof name);
    printf("| %s |", name);
    if (t->method < FIXED) printf(" - |");
    else if (t->iterations > 0) printf(" %d |", t->iterations);
    else printf(" to rounding: %.1f |", (double)c->iterations/c->steps);
    printf(" %.0f | %ld | %ld |", c->mean, c->most, c->first);
    if (bound > 0) printf(" %.0f |", bound);
    else printf(" - |");
    const int fails = c->failures > 0 || run_start(&r, s, t, s->h) != 0;
    if (!(s->turn > 0)) print_cell(fails ? HUGE_VAL : drift_of(&r, DRIFT_STEPS));
    print_cell(fails || run_start(&r, s, t, s->h) ? HUGE_VAL : error_of(&r, ERROR_STEPS, SUBSTEPS));
    printf("\n");
}

/* How far the reference may be off: against itself with half as many steps                      */
static double reference_error(int index)
{
    static run r;
    truth a, b;
    double most = 0;
    run_start(&r, scenes + index, settings + RK4, scenes[index].h);
    true_start(index, &a);
    true_start(index, &b);
    for (int k = 0; k < ERROR_STEPS; ++k, ++r.k) {
        run_control(&r);
        true_step(index, &a, (double)r.h, SUBSTEPS);
        true_step(index, &b, (double)r.h, SUBSTEPS/2);
        for (int i = 0; i < r.scene->n; ++i) most = fmax(most, fabs(a.y[i] - b.y[i]));
    }
    return most;
}

static void table(const scene *s)
{
    printf("\n%s\n\n", s->title);
    printf("| setting | iterations | instructions | most | first 3 steps | operations at most |");
    printf("%s\n|---|---|---|---|---|---|---|%s\n", s->turn > 0 ? " error of q |" : " drift | error of q |",
           s->turn > 0 ? "" : "---|");
    for (int k = 0; k < SETTINGS; ++k)
        if (counted[s - scenes][k].present) {
            check_bits(s, k);
            table_row(s, k);
        }
    printf("\nThe reference for the error is right to %.0e.\n", reference_error((int)(s - scenes)));
}

/* --------------------------------------------------------------- loop rates */

static int find(method m, int degree, int n)
{
    int k = 0;
    while (settings[k].method != m || settings[k].degree != degree || settings[k].iterations != n) ++k;
    return k;
}

/* Steps a second that a tenth of a processor of 80 MHz has time for, at two cycles an instruction: more
   than embedded_trace.awk finds where there are no wait states, but for a root and a quotient      */
static void rates_row(int index)
{
    char name[60];
    name_of(settings + index, name, sizeof name);
    printf("| %s%s", name, settings[index].method < FIXED ? "" : ", N = ");
    if (settings[index].method >= FIXED) printf("%d", settings[index].iterations);
    for (int k = 0; k < SCENES; ++k)
        if (counted[k][index].present) printf(" | %.0f", 0.1*80e6/(2*(double)counted[k][index].most));
        else printf(" | -");
    printf(" |\n");
}

static void rates_table(void)
{
    printf("\n| steps a second |");
    for (int k = 0; k < SCENES; ++k) printf(" %s |", scenes[k].name);
    printf("\n|---|---|---|---|---|---|\n");
    rates_row(RK4_CARRIED);
    rates_row(EXPLICIT);
    rates_row(find(FIXED, 2, 2));
    rates_row(find(FIXED, 2, 3));
    rates_row(find(FIXED, 3, 3));
    rates_row(find(FIXED, 4, 3));
}

/* --------------------------------------------------------------- step sizes */

typedef struct point { double h, drift, error; } point;

static point swept[SCENES][SETTINGS][SIZES];

/* Instructions do not depend on h where the iterations are fixed                                */
static int worth_sweeping(const scene *s, int index)
{
    const setting *t = settings + index;
    if (!counted[s - scenes][index].present) return 0;
    return t->method < FIXED || (t->iterations > 1 && t->iterations < 5);
}

/* From eight times the table's h to an eighth of it; drift over SWEPT_STEPS of the table's steps, the
   error over ERROR_STEPS                                                                       */
static void sweep(const scene *s, int index)
{
    static run r;
    for (int k = 0; k < SIZES; ++k) {
        const double factor = pow(2, 3 - k/2.0);
        point *p = &swept[s - scenes][index][k];
        p->h = (double)s->h*factor;
        p->drift = run_start(&r, s, settings + index, (real)p->h) ? HUGE_VAL
                 : drift_of(&r, lround(SWEPT_STEPS/factor));
        p->error = run_start(&r, s, settings + index, (real)p->h) ? HUGE_VAL
                 : error_of(&r, lround(ERROR_STEPS/factor), (int)ceil(SUBSTEPS*factor));
    }
}

static const int conservative[] = { PENDULUM, ORBIT, ARM };

static void sweep_all(void)
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < SETTINGS; ++k)
            if (worth_sweeping(scenes + conservative[i], k)) sweep(scenes + conservative[i], k);
}

/* ------------------------------------------------------------------- choice */

/* How often a step asks for the force                                                           */
static int evaluations(const setting *t)
{
    const int of_hand[] = { 1, 1, 4, 4, 1, 5 };
    return t->method < FIXED ? of_hand[t->method] : t->iterations*t->degree;
}

/* The cheapest step by hand, or of gvi.h, that stays below both, the force being dearer by `more`
   instructions; its price for a unit of time                                                    */
typedef struct choice { int setting; double h, price; } choice;

static choice cheapest(const scene *s, int hand, double most_drift, double most_error, double more)
{
    choice best = { -1, 0, HUGE_VAL };
    for (int i = 0; i < SETTINGS; ++i)
        for (int k = 0; k < SIZES && worth_sweeping(s, i) && by_hand_only(settings + i) == hand; ++k) {
            const point *p = &swept[s - scenes][i][k];
            const double price = (counted[s - scenes][i].mean + more*evaluations(settings + i))/p->h;
            if (p->drift > most_drift || p->error > most_error || price >= best.price) continue;
            best.setting = i;
            best.h = p->h;
            best.price = price;
        }
    return best;
}

static void print_choice(const choice *c)
{
    char name[60];
    if (c->setting < 0) { printf(" - |"); return; }
    name_of(settings + c->setting, name, sizeof name);
    printf(" %s", name);
    if (settings[c->setting].method >= FIXED) printf(", N = %d", settings[c->setting].iterations);
    printf("; %.2g |", c->h);
}

static void choice_row(const scene *s, const char *what, double most_drift, double most_error)
{
    static const double more[] = { 0, 300, 1000, 3000 };
    printf("| %s | %s %.0e |", s->name, what, fmin(most_drift, most_error));
    for (int k = 0; k < 4; ++k) {
        const choice hand = cheapest(s, 1, most_drift, most_error, more[k]);
        const choice gvi = cheapest(s, 0, most_drift, most_error, more[k]);
        if (k == 0) {
            print_choice(&hand);
            print_choice(&gvi);
        }
        if (gvi.setting < 0 || hand.setting < 0) printf(" - |");
        else printf(" %.2g |", gvi.price/hand.price);
    }
    printf("\n");
}

static void choice_table(void)
{
    const int wide = sizeof(real) > 4;
    const double drifts[] = { 1e-4, wide ? 1e-6 : 1e-5, wide ? 1e-9 : 2e-6 };
    const double errors[] = { wide ? 1e-4 : 1e-3, wide ? 1e-6 : 1e-4, wide ? 1e-8 : 1e-5 };
    printf("\n| scene | wanted | by hand; h | gvi.h; h | +0 | +300 | +1000 | +3000 |\n");
    printf("|---|---|---|---|---|---|---|---|\n");
    for (int i = 0; i < 3; ++i) {
        const scene *s = scenes + conservative[i];
        for (int k = 0; k < 3; ++k) choice_row(s, "drift", drifts[k], HUGE_VAL);
        for (int k = 0; k < 3; ++k) choice_row(s, "error", HUGE_VAL, errors[k]);
    }
}

/* ------------------------------------------------------------------- picture */

typedef struct family { const char *name; int setting, dashed; double x[SIZES], y[SIZES]; int count; } family;

static void points_of(const scene *s, family *f)
{
    f->count = 0;
    if (!worth_sweeping(s, f->setting)) return;
    for (int k = 0; k < SIZES; ++k) {
        const point *p = &swept[s - scenes][f->setting][k];
        if (!(p->drift < 1)) continue;
        f->x[f->count] = counted[s - scenes][f->setting].mean/p->h/1e6;
        f->y[f->count++] = p->drift;
    }
}

static void panel_of(const scene *s, const char *title, family *f, svg_line *lines, svg_plot *panel)
{
    static const char *const colours[LINES] = { "#009e73", "#aa4499", "#b8860b", "#444444", "#d55e00", "#56b4e9",
                                                "#0072b2", "#0072b2" };
    unsigned dashed = 0;
    for (int k = 0; k < LINES; ++k) {
        points_of(s, f + k);
        const svg_line line = { f[k].name, f[k].x, f[k].y, f[k].count };
        lines[k] = line;
        dashed |= (unsigned)f[k].dashed << k;
        if (f[k].count == 0 && s->verlet) complain("no point in the picture", s, settings + f[k].setting);
    }
    const svg_plot p = { .title = title, .x_label = "millions of instructions for a unit of time",
                         .y_label = "drift of the energy", .log_x = 1, .log_y = 1, .lines = lines, .line_count = LINES,
                         .dashed = dashed, .colours = colours };
    *panel = p;
}

static int picture(const char *path)
{
    static family f[2][LINES];
    svg_line lines[2][LINES];
    svg_plot panels[2];
    static const struct { const char *name; setting setting; } wanted[LINES] = {
        { "gvi.h, s = 2, N = 2", { FIXED, 2, 2 } }, { "gvi.h, s = 2, N = 3", { FIXED, 2, 3 } },
        { "gvi.h, s = 3, N = 3", { FIXED, 3, 3 } }, { "gvi.h, s = 4, N = 4", { FIXED, 4, 4 } },
        { "gvi.h, Verlet", { EXPLICIT, 1, 0 } }, { "gvi.h, Suzuki 4", { SUZUKI, 1, 0 } },
        { "RK4 by hand", { RK4, 4, 0 } }, { "RK4 by hand, compensated", { RK4_CARRIED, 4, 0 } } };
    for (int k = 0; k < 2*LINES; ++k) {
        family *x = &f[k/LINES][k%LINES];
        const setting *t = &wanted[k%LINES].setting;
        x->name = wanted[k%LINES].name;
        x->setting = find(t->method, t->degree, t->iterations);
        x->dashed = t->method == RK4;
    }
    panel_of(scenes + ORBIT, "orbit, 298 revolutions", f[0], lines[0], panels);
    panel_of(scenes + ARM, "arm of two links, 300 s", f[1], lines[1], panels + 1);
    return svg_write_all(path, panels, 2, 360);
}

/* ------------------------------------------------------------------ rounding */

typedef struct long_run { int setting; run r; averages m; double error; } long_run;

/* All at once, beside one reference                                                             */
static void long_runs(const scene *s, long_run *x, int count)
{
    truth t;
    true_start((int)(s - scenes), &t);
    for (long k = 0; k <= LONG_STEPS; ++k) {
        if (k > 0) true_step((int)(s - scenes), &t, (double)s->h, SUBSTEPS);
        for (int i = 0; i < count; ++i) {
            if (k == 0 && run_start(&x[i].r, s, settings + x[i].setting, s->h) != 0)
                complain("does not start", s, settings + x[i].setting);
            if (k > 0) run_step(&x[i].r);
            average(&x[i].m, &x[i].r, k, LONG_STEPS);
            if (k > LONG_STEPS - ERROR_STEPS) x[i].error = fmax(x[i].error, distance(&x[i].r, &t));
        }
    }
}

static void rounding(const char *rounds)
{
    const int shown[] = { PENDULUM, ORBIT }, plain = !strcmp(rounds, "plain");
    const int picked[] = { EXPLICIT, find(FIXED, 2, 3), find(FIXED, 3, 3), plain ? VERLET : VERLET_CARRIED,
                           plain ? RK4 : RK4_CARRIED };
    for (int i = 0; i < 2; ++i) {
        static long_run x[5];
        const scene *s = scenes + shown[i];
        memset(x, 0, sizeof x);
        for (int k = 0; k < 5; ++k) x[k].setting = picked[k];
        long_runs(s, x, 5);
        for (int k = 0; k < 5; ++k) {
            char name[60];
            name_of(settings + (k < 3 ? picked[k] : k == 3 ? VERLET : RK4), name, sizeof name);
            printf("| %s | %s%s | %s |", s->name, name, k == 1 || k == 2 ? ", N = 3" : "", rounds);
            printf(" %.0f | %.1e | %.1e |\n", counted[s - scenes][picked[k]].mean, drift(&x[k].m, &x[k].r),
                   x[k].error);
        }
    }
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], "--table")) {
        read_counts(argv[2]);
        for (int k = 0; k < SCENES; ++k) table(scenes + k);
        rates_table();
    } else if (argc == 4 && !strcmp(argv[1], "--choice")) {
        read_counts(argv[3]);
        sweep_all();
        choice_table();
        bad |= picture(argv[2]) != 0;
    } else if (argc == 4 && !strcmp(argv[1], "--rounding")) {
        read_counts(argv[2]);
        rounding(argv[3]);
    } else {
        fputs("embedded --table COUNTS | --choice FILE COUNTS | --rounding COUNTS NAME\n", stderr);
        return 2;
    }
    return bad;
}
