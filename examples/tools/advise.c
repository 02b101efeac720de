/* advise - finds the cheapest way to integrate a scene with a wanted error

     advise                             lists scenes and problems
     make advise FILE=mine.c ERROR=1e-8        for a scene of your own, to an error of q; the file defines
                                               static const gvi_desc mine;
                                               static const double mine_q[], mine_v[], mine_horizon, mine_h;
                                               (h: a step worth beginning with), and includes nothing of gvi.h's
     advise NAME [options]
       --error e      of q at the horizon, over the largest |q_i|: 1e-8
       --time s       or: the least error that this much CPU time buys
       --horizon t    1/10 of what the scene shows, the end of a problem
       --trials s     longest single run that is tried: 2

   NAME is a scene of examples/scenes, or a problem of `make cost` (P1, ...).  How
   it is done stands in advise.h.  The last lines are C, to be pasted.          */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "scenes/scenes.c"
#include "tools/advise.h"
#include "../../tests/cost/baselines.h"

enum { TABLES = 5, KICKS = 40 };

#ifdef ADVISE_FILE
#include ADVISE_FILE
#endif

typedef struct options { double error, time, horizon, trials; } options;

static void say(const char *line)
{
    printf("%s\n", line);
    fflush(stdout);
}

/* The splittings, where q'' depends on t and q alone: gvi.h knows.             */
static void add_kicks(advise_case *a)
{
    static const char *const names[TABLES] = { "Stoermer-Verlet", "Blanes-Moan SRKN11", "Blanes-Moan SRKN14",
                                               "Splitting 8", "Sofroniou-Spaletta 10" };
    static const int orders[TABLES] = { 2, 6, 6, 8, 10 };
    static double nodes[TABLES][KICKS], weights[TABLES][KICKS];
    baselines_begin();
    for (int i = 0; i < TABLES; ++i) {
        const int points = baseline_kicks(baseline_named(names[i]), nodes[i], weights[i]);
        a->kicks[i] = (advise_kicks){ names[i], orders[i], points, nodes[i], weights[i] };
    }
    const advise_setting first = { .kicks = &a->kicks[0] };
    const gvi_desc d = advise_desc(a, &first);
    a->kicks_count = gvi_size(&d) > 0 ? TABLES : 0;
}

static int list(void)
{
    for (int i = 0; i < scene_count; ++i) printf("%-20s %s\n", scenes[i]->name, scenes[i]->title);
    for (int i = 0; i < problem_count; ++i) printf("%-20s %s\n", problems[i].key, problems[i].title);
    return 0;
}

static int get_case(const char *name, advise_case *a)
{
    static scene_setup made;
    const scene *s = scene_find(name);
    const problem *p = problem_named(name);
    if (s) {
        scene_build(s, &made, NULL);
        *a = (advise_case){ .desc = made.desc, .q = made.q, .v = made.v, .h = s->h };
        a->horizon = s->duration/10;
    } else if (p) {
        *a = (advise_case){ .q = p->q, .v = p->v, .momentum = p->slope != NULL, .horizon = p->end,
                            .h = 24*p->end/p->evaluations };
        a->desc = (gvi_desc){ .n = p->n, .mass = p->mass, .effects = p->effects,
                              .effect_count = p->effect_count };
    }
#ifdef ADVISE_FILE
    if (!strcmp(name, ADVISE_FILE)) {
        *a = (advise_case){ .desc = mine, .q = mine_q, .v = mine_v, .horizon = mine_horizon, .h = mine_h };
        return 1;
    }
#endif
    return s || p;
}

static int read_options(int argc, char **argv, options *o)
{
    for (int i = 2; i + 1 < argc; i += 2) {
        const double x = atof(argv[i+1]);
        if (!strcmp(argv[i], "--error")) o->error = x;
        else if (!strcmp(argv[i], "--time")) o->time = x;
        else if (!strcmp(argv[i], "--horizon")) o->horizon = x;
        else if (!strcmp(argv[i], "--trials")) o->trials = x;
        else return 0;
        if (!(x > 0)) return 0;
    }
    return argc % 2 == 0;
}

/* The least error for a time: cost goes with a power of the error, from search to search. */
static int find_for_time(const advise_case *a, advise_options *o, double time, advise_result *r)
{
    advise_result best = { .cost = HUGE_VAL, .error = HUGE_VAL };
    double power = -1.0/14, error = 1e-6;
    double last = 0, last_cost = 0;
    for (int k = 0; k < 4; ++k) {
        o->error = error;
        printf("\nwanted error %.1e\n", error);
        if (advise_find(a, o, r)) break;
        printf("takes %.3g s of %.3g\n", r->cost, time);
        if (r->cost <= time && r->error < best.error) best = *r;
        if (r->cost <= time && r->cost > 0.8*time) break;
        if (last > 0 && fabs(log(error/last)) > 0.1) power = log(r->cost/last_cost)/log(error/last);
        power = fmin(fmax(power, -0.3), -0.03);
        last = error;
        last_cost = r->cost;
        error = fmin(fmax(error*pow(0.9*time/r->cost, 1/power), 1e-12), 1e-2);
    }
    if (best.cost >= HUGE_VAL) best.why = r->why ? r->why : "the time is too short";
    *r = best;
    return best.why ? -1 : 0;
}

static void print_table(const char *name, int count, const double *x)
{
    printf("static const double %s[] = {", name);
    for (int i = 0; i < count; ++i) printf("%s%s%.17g", i ? "," : "", i % 4 ? " " : "\n    ", x[i]);
    printf(" };\n");
}

static void print_result(const advise_case *a, const advise_result *r)
{
    const advise_setting *s = &r->setting;
    char name[96];
    printf("\n%s: error %.1e%s, %.3g s for %ld steps\n\n", advise_name(s, name, sizeof name), r->error,
           r->proved ? "" : " (extrapolated)", r->cost, r->steps);
    if (s->kicks) {
        print_table("nodes", s->kicks->points, s->kicks->nodes);
        print_table("weights", s->kicks->points, s->kicks->weights);
    }
    printf("const gvi_desc desc = { .n = %d, .degree = %d,", a->desc.n, s->kicks ? 1 : s->degree);
    if (s->kicks) printf(" .rule = { GVI_KICKS, %d, nodes, weights },", s->kicks->points);
    if (s->rule == GVI_LOBATTO) printf(" .rule = { .kind = GVI_LOBATTO },");
    if (s->tolerance > 0) printf(" .tolerance = %g,", s->tolerance);
    if (a->desc.mass.kind != GVI_MASS_UNIT || a->desc.mass.velocity) printf(" .mass = mass,");
    printf(" .effects = effects, .effect_count = %d };\n", a->desc.effect_count);
    printf("const double h = %.17g;\n", r->h);
}

int main(int argc, char **argv)
{
    options o = { 1e-8, 0, 0, 2 };
    advise_case a;
    advise_result r;
    if (argc < 2) return list();
    if (!get_case(argv[1], &a) || !read_options(argc, argv, &o)) {
        fprintf(stderr, "no such scene or option\n");
        return 2;
    }
    if (o.horizon > 0) a.horizon = o.horizon;
    add_kicks(&a);
    advise_options wanted = { .error = o.error, .seconds = o.trials, .say = say };
    if (o.time > 0) wanted.seconds = fmax(o.trials, 2*o.time);
    printf("%s to t = %g\n", argv[1], a.horizon);
    if (o.time > 0 ? find_for_time(&a, &wanted, o.time, &r) : advise_find(&a, &wanted, &r)) {
        printf("nothing found: %s\n", r.why);
        return 1;
    }
    print_result(&a, &r);
    return 0;
}
