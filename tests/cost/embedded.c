/* embedded.c - a step on a small processor: what its instructions buy

     embedded COUNTS     Markdown: instructions, drift and error of every setting; steps a second for a
                         tenth of 80 MHz, two cycles an instruction; over the step size: the cheapest
                         setting for a drift or an error, and what gvi.h costs over what a step by hand
                         costs, also with a force that takes 300, 1000 or 3000 instructions more

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

#include <stdio.h>
#include <stdlib.h>

enum { DRIFT_STEPS = 100000, SWEPT_STEPS = 30000, ERROR_STEPS = 1000, SIZES = 13 };

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

/* ------------------------------------------------------------------- truth */

/* Energies and references in double and with libm's sines, written apart from the callbacks */
enum { SUBSTEPS = 64 };

typedef struct truth { double y[4], torque[2]; } truth;

static double arm_one(double b) { return ARM_NEAR + ARM_FAR + 2*ARM_MID*cos(b); }
static double arm_two(double b) { return ARM_FAR + ARM_MID*cos(b); }

static void arm_accelerate(const truth *x, const double *y, double damping, double *dy)
{
    const double one = arm_one(y[1]), two = arm_two(y[1]), pull = ARM_MID*sin(y[1]);
    const double low = ARM_LOWER*sin(y[0] + y[1]), u = y[2], w = y[3];
    const double f = x->torque[0] - damping*u - ARM_UPPER*sin(y[0]) - low + pull*w*(2*u + w);
    const double g = x->torque[1] - damping*w - low - pull*u*u, det = one*ARM_FAR - two*two;
    dy[2] = (ARM_FAR*f - two*g)/det;
    dy[3] = (one*g - two*f)/det;
}

static void true_rates(int index, const truth *x, const double *y, double *dy)
{
    const int n = scenes[index].n;
    for (int i = 0; i < n; ++i) dy[i] = y[n + i];
    if (index == PENDULUM) dy[1] = -WEIGHT*sin(y[0]);
    if (index == MOTOR) dy[1] = x->torque[0] - DAMPING*y[1] - WEIGHT*sin(y[0]);
    if (index == ORBIT)
        for (int i = 0; i < 2; ++i) dy[2 + i] = -y[i]/pow(y[0]*y[0] + y[1]*y[1], 1.5);
    if (index == ARM || index == DRIVEN_ARM) arm_accelerate(x, y, index == ARM ? 0 : ARM_DAMPING, dy);
}

static void true_substep(int index, truth *x, double h)
{
    const int m = 2*scenes[index].n;
    double k[4][4], z[4];
    static const double at[4] = { 0, 0.5, 0.5, 1 };
    for (int stage = 0; stage < 4; ++stage) {
        for (int i = 0; i < m; ++i) z[i] = x->y[i] + (stage > 0 ? at[stage]*h*k[stage - 1][i] : 0);
        true_rates(index, x, z, k[stage]);
    }
    for (int i = 0; i < m; ++i) x->y[i] += h/6*(k[0][i] + 2*(k[1][i] + k[2][i]) + k[3][i]);
}

static void true_start(int index, truth *x)
{
    const int n = scenes[index].n;
    x->torque[0] = x->torque[1] = 0;
    for (int i = 0; i < n; ++i) {
        x->y[i] = (double)scenes[index].q[i];
        x->y[n + i] = (double)scenes[index].v[i];
    }
}

/* One step of h, the torque being that of the run                                               */
static void true_step(int index, truth *x, double h, int substeps)
{
    for (int i = 0; i < 2; ++i) x->torque[i] = (double)drive.torque[i];
    for (int k = 0; k < substeps; ++k) true_substep(index, x, h/substeps);
}

/* Of configuration and velocity, above the state of least energy; the orbit's is -1/2           */
static double true_energy(int index, const double *y)
{
    if (index == PENDULUM || index == MOTOR) return y[1]*y[1]/2 + WEIGHT*(1 - cos(y[0]));
    if (index == ORBIT) return (y[2]*y[2] + y[3]*y[3])/2 - 1/hypot(y[0], y[1]);
    const double kinetic = (arm_one(y[1])*y[2]*y[2] + ARM_FAR*y[3]*y[3])/2 + arm_two(y[1])*y[2]*y[3];
    return kinetic + ARM_UPPER*(1 - cos(y[0])) + ARM_LOWER*(1 - cos(y[0] + y[1]));
}

/* Momenta become velocities                                                                     */
static void true_velocity(int index, double *y)
{
    if (index != ARM && index != DRIVEN_ARM) return;
    const double one = arm_one(y[1]), two = arm_two(y[1]), det = one*ARM_FAR - two*two, p = y[2], o = y[3];
    y[2] = (ARM_FAR*p - two*o)/det;
    y[3] = (one*o - two*p)/det;
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
    char name[60];
    name_of(t, name, sizeof name);
    printf("| %s |", name);
    if (t->method < FIXED) printf(" - |");
    else if (t->iterations > 0) printf(" %d |", t->iterations);
    else printf(" to rounding: %.1f |", (double)c->iterations/c->steps);
    printf(" %.0f | %ld | %ld |", c->mean, c->most, c->first);
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
    printf("| setting | iterations | instructions | most | first 3 steps |");
    printf("%s\n|---|---|---|---|---|---|%s\n", s->turn > 0 ? " error of q |" : " drift | error of q |",
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

/* Steps a second that a tenth of a processor of 80 MHz has time for, at two cycles an instruction   */
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

int main(int argc, char **argv)
{
    if (argc != 2) return fputs("embedded COUNTS\n", stderr), 2;
    read_counts(argv[1]);
    for (int k = 0; k < SCENES; ++k) table(scenes + k);
    rates_table();
    sweep_all();
    choice_table();
    return bad;
}
