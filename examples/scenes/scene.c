/* scene - runs one of the scenes in this directory, and draws it

     scene                          lists the scenes
     scene NAME [options]           runs one and says what it took and kept
       --steps k   --h x   --degree s
       --off a,b                    listed, but switched off
       --without a,b                not listed at all
       --svg file                   the motion, with the energy next to it

   The energy that is not accounted for is E(t) - E(0) less the work that forces
   did, which is integrated with each step's own curve.                        */
#define GVI_IMPLEMENTATION
#include "gvi.h"
#include "tools/animate.h"
#include "scenes.c"

#include <stdio.h>

enum { SAMPLES = 6000, FRAMES = 150, PLOTTED = 1200 };      /* most of a film, and of its plots */

typedef struct options {
    long        steps;
    double      h;
    int         degree;
    const char *off, *without, *svg;
} options;

/* What a run leaves: samples for the film and the balance of each.            */
typedef struct record {
    int       count, room;
    long      seen, thin;                    /* of all samples offered, each thin-th is kept */
    double   *xy, t[SAMPLES + 1], kinetic[SAMPLES + 1], potential[SAMPLES + 1], total[SAMPLES + 1];
    double    missing[SAMPLES + 1], curve[SCENE_CURVES][SAMPLES + 1];
    gvi_real  energy0, energy, worst, most_kinetic;     /* worst: energy not accounted for */
    gvi_real  work[GVI_EFFECTS], first[SCENE_CURVES], change[SCENE_CURVES];
    unsigned  off;
} record;

static int list(void)
{
    static scene_setup made;
    for (int i = 0; i < scene_count; ++i) {
        scene_build(scenes[i], &made, NULL);
        printf("%-20s n = %3d  ", scenes[i]->name, scenes[i]->n);
        for (int e = 0; e < made.desc.effect_count; ++e) printf("%s%s", e ? ", " : "", made.names[e]);
        printf("\n");
    }
    return 0;
}

/* Energies and conserved quantities at the state as it is.                    */
static gvi_status balance(const scene *a, const scene_setup *s, gvi_stepper *st, record *r)
{
    gvi_real v[SCENE_MAX], now[SCENE_CURVES] = { 0 }, work = 0;
    if (gvi_energy(st, &r->energy) || gvi_velocity(st, v)) return st->status;
    if (st->counters.steps == 0) r->energy0 = r->energy;
    for (int e = 0; e < s->desc.effect_count; ++e) work += r->work[e];
    const gvi_real missing = r->energy - r->energy0 - work;
    const gvi_real kinetic = r->energy - scene_potential(s, r->off, st->t, st->q);
    r->worst = fmax(r->worst, fabs(missing));
    r->most_kinetic = fmax(r->most_kinetic, kinetic);
    if (!a->quantities) return GVI_OK;
    a->quantities(st->q, v, st->p, now);
    for (int i = 0; i < SCENE_CURVES && a->conserved[i]; ++i) {
        if (st->counters.steps == 0) r->first[i] = now[i];
        r->change[i] = fmax(r->change[i], fabs(now[i] - r->first[i]));
    }
    return GVI_OK;
}

/* Adds a sample at tau in the last step (1: the state itself).                */
static void sample(const scene *a, const scene_setup *s, gvi_stepper *st, double tau, record *r)
{
    const int k = r->count;
    double xy[SCENE_BODIES][2] = { { 0 } }, curves[SCENE_CURVES] = { 0 };
    gvi_real q[SCENE_MAX], v[SCENE_MAX], work = 0;
    if (k >= r->room || r->seen++ % r->thin) return;
    if (tau < 1) gvi_curve(st, tau, q, v);
    else {
        memcpy(q, st->q, (size_t)st->n*sizeof *q);
        gvi_velocity(st, v);
    }
    a->place(q, v, xy);
    memcpy(r->xy + 2*(size_t)k*(size_t)a->points, xy, 2*(size_t)a->points*sizeof(double));
    for (int e = 0; e < s->desc.effect_count; ++e) work += r->work[e];
    const gvi_real t = st->t - (tau < 1 ? (1 - tau)*st->h : 0);
    r->t[k] = a->time_scale*(double)t;
    // the total is that at the end of the step: samples inside repeat it
    r->total[k] = a->energy_scale*(double)r->energy;
    r->potential[k] = a->energy_scale*(double)scene_potential(s, r->off, t, q);
    r->kinetic[k] = r->total[k] - r->potential[k];
    r->missing[k] = (double)(r->energy - r->energy0 - work);
    if (a->curves) a->curves(q, v, curves);
    for (int i = 0; i < SCENE_CURVES; ++i) r->curve[i][k] = curves[i];
    ++r->count;
}

static gvi_status run(const scene *a, const scene_setup *s, gvi_stepper *st, gvi_real *memory,
                      const options *o, record *r)
{
    gvi_init(st, &s->desc, memory, gvi_size(&s->desc));
    for (int e = 0; e < s->desc.effect_count; ++e)
        if (scene_lists(o->off, s->names[e])) {
            gvi_switch(st, e, 0);
            r->off |= 1u << e;
        }
    if (gvi_start(st, 0, s->q, s->v) || balance(a, s, st, r)) return st->status;
    sample(a, s, st, 1, r);
    for (long k = 1; k <= o->steps; ++k) {
        if (gvi_step(st, o->h)) return st->status;
        if (scene_work(st, s, r->off, r->work)) return GVI_E_CALLBACK;
        if (balance(a, s, st, r)) return st->status;
        for (int j = 1; j <= a->samples; ++j) sample(a, s, st, (double)j/a->samples, r);
        if (a->samples < 0 && k % -a->samples == 0) sample(a, s, st, 1, r);
    }
    return GVI_OK;
}

static int draw(const scene *a, record *r, const char *path)
{
    const int every = (r->count - 1 + FRAMES - 1)/FRAMES > 0 ? (r->count - 1 + FRAMES - 1)/FRAMES : 1;
    const int count = (r->count - 1)/every*every + 1;
    const double scale = r->most_kinetic > 0 ? (double)r->most_kinetic : 1;
    const int thin = 1 + count/PLOTTED, shown = (count - 1)/thin + 1;
    char title[96];
    animate_line joined[16];
    svg_line energies[] = { { "kinetic", r->t, r->kinetic, shown },
                            { "potential", r->t, r->potential, shown },
                            { "total", r->t, r->total, shown } };
    svg_line missing = { "", r->t, r->missing, shown }, curves[SCENE_CURVES];
    animation film = { .title = a->title, .caption = a->caption, .unit = a->unit, .points = a->points,
                       .samples = count, .xy = r->xy, .t = r->t, .every = every, .seconds = a->seconds,
                       .sizes = a->sizes, .lines = joined,
                       .trail_first = a->trail_first, .trails = a->trails };
    for (int i = 0; i < shown; ++i) {
        r->t[i] = r->t[i*thin];                     // the film's own time needs the last one alone, which stays
        r->kinetic[i] = r->kinetic[i*thin];
        r->potential[i] = r->potential[i*thin];
        r->total[i] = r->total[i*thin];
        r->missing[i] = r->missing[i*thin]/scale;
        for (int c = 0; c < SCENE_CURVES; ++c) r->curve[c][i] = r->curve[c][i*thin];
    }
    for (; film.line_count < 16 && a->lines[film.line_count].count; ++film.line_count) {
        const scene_line *l = &a->lines[film.line_count];
        joined[film.line_count] = (animate_line){ l->first, l->step, l->count };
    }
    memcpy(film.view, a->view, sizeof film.view);
    snprintf(title, sizeof title, "energy%s%s", *a->energy_unit ? ", " : "", a->energy_unit);
    film.plots[0] = (svg_plot){ .title = title, .lines = energies, .line_count = 3 };
    if (a->curves) {
        film.plots[0] = (svg_plot){ .title = a->curves_title, .lines = curves };
        for (int i = 0; i < SCENE_CURVES && a->curve_names[i]; ++i, ++film.plots[0].line_count)
            curves[i] = (svg_line){ a->curve_names[i], r->t, r->curve[i], shown };
    }
    film.plots[1] = (svg_plot){ .title = "energy gained less work, of the largest kinetic", .lines = &missing,
                                .line_count = 1, .x_label = *a->time_unit ? a->time_unit : "time" };
    return animate_write(path, &film);
}

static void report(const scene *a, const scene_setup *s, const gvi_stepper *st, const record *r)
{
    const gvi_counters *c = &st->counters;
    printf("%s\nn = %d, degree %d, %llu steps of %g %s\n", a->title, st->n, st->s, c->steps,
           (double)st->h*a->time_scale, a->time_unit);
    printf("%s; %.1f iterations a step", gvi_formulation_text(st),
           (double)(c->iterations + c->newton_iterations)/fmax(1, (double)c->steps));
    printf(", %zu bytes\n\n", gvi_size(&s->desc));
    printf("%-16s evaluations     work done, %s\n", "effect", a->energy_unit);
    for (int e = 0; e < s->desc.effect_count; ++e) {
        printf("%-16s %12llu", s->names[e], c->effect[e]);
        if (r->off >> e & 1u) printf("    off");
        else if (s->effects[e].kind == GVI_FORCE) printf("    %.6g", a->energy_scale*(double)r->work[e]);
        printf("\n");
    }
    printf("\nenergy           %.12g at first, %.12g at the end, %s\n", a->energy_scale*(double)r->energy0,
           a->energy_scale*(double)r->energy, a->energy_unit);
    printf("not accounted    %.2g of the largest kinetic energy, at most\n",
           (double)(r->worst/fmax(r->most_kinetic, (gvi_real)1e-300)));
    for (int i = 0; i < SCENE_CURVES && a->conserved[i]; ++i)
        printf("%-34s %.12g, changed by no more than %.2g\n", a->conserved[i],
               (double)r->first[i], (double)r->change[i]);
}

/* Options from the command line; 0 if one is not known.                       */
static int read_options(int argc, char **argv, options *o)
{
    for (int i = 2; i + 1 < argc; i += 2) {
        if (!strcmp(argv[i], "--steps")) o->steps = atol(argv[i+1]);
        else if (!strcmp(argv[i], "--h")) o->h = atof(argv[i+1]);
        else if (!strcmp(argv[i], "--degree")) o->degree = atoi(argv[i+1]);
        else if (!strcmp(argv[i], "--off")) o->off = argv[i+1];
        else if (!strcmp(argv[i], "--without")) o->without = argv[i+1];
        else if (!strcmp(argv[i], "--svg")) o->svg = argv[i+1];
        else return 0;
    }
    return argc % 2 == 0;
}

/* Does the scene have every effect of a comma-separated list?                  */
static int known(const scene_setup *s, const char *names)
{
    int wanted = names && *names, found = 0;
    for (const char *c = names; c && *c; ++c) wanted += *c == ',';
    for (int e = 0; e < s->desc.effect_count; ++e) found += scene_lists(names, s->names[e]);
    return found == wanted;
}

int main(int argc, char **argv)
{
    static scene_setup made;
    static gvi_stepper st;
    static record r;
    options o = { 0, 0, 0, NULL, NULL, NULL };
    if (argc < 2) return list();
    const scene *a = scene_find(argv[1]);
    if (!a || !read_options(argc, argv, &o)) return fprintf(stderr, "no such scene or option\n"), 2;
    scene_build(a, &made, NULL);
    if (!known(&made, o.off) || !known(&made, o.without)) return fprintf(stderr, "no such effect\n"), 2;
    scene_build(a, &made, o.without);
    if (o.degree) made.desc.degree = o.degree;
    if (!(o.h > 0)) o.h = a->h;
    if (o.steps <= 0) o.steps = lround((double)a->duration/o.h);
    r.thin = 1 + (a->samples > 0 ? o.steps*a->samples : o.steps/-a->samples)/SAMPLES;
    gvi_real *memory = malloc(gvi_size(&made.desc));
    r.room = o.svg ? SAMPLES : 1;
    r.xy = malloc(2*(size_t)SAMPLES*(size_t)a->points*sizeof *r.xy);
    if (!memory || !r.xy) return fprintf(stderr, "out of memory\n"), 1;
    const gvi_status status = run(a, &made, &st, memory, &o, &r);
    if (status) fprintf(stderr, "t = %g: %s\n", (double)st.t, gvi_why(&st));
    report(a, &made, &st, &r);
    const int undrawn = o.svg && draw(a, &r, o.svg);
    if (undrawn) perror(o.svg);
    free(r.xy);
    free(memory);
    return status != GVI_OK || undrawn;
}
