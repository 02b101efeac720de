/* dial.h - what you ask for, what you get, what it takes: the tables and pictures of `cost --dial`

   Part of cost.c.  A row each for gvi.h by its dial; then, for two errors, the time of the rest over its time. */
#ifndef DIAL_H
#define DIAL_H

/* The problems of the study: neither those twice in the list nor lattices and stiff chains, which one step suits */
enum { DRAWN = 8, STUDIED = 13 };          // the first ones are drawn
static const char *const studied[STUDIED] = { "P1", "P4", "P5", "P9", "P11", "P14", "P15", "P17", "P2", "P10", "P12", "P13", "P16" };

static int in_dial_study(const char *key)
{
    for (int d = 0; d < STUDIED; ++d)
        if (!strcmp(key, studied[d])) return 1;
    return 0;
}

/* The dial's samples, or an empty curve                                                        */
static const curve *dial_of(const study *y)
{
    static const curve none;
    for (int i = 0; i < y->count; ++i)
        if (y->curves[i].job.setting && y->curves[i].job.setting->dial) return y->curves + i;
    return &none;
}

static double family_time(const study *y, const char *family, double error)
{
    double least = HUGE_VAL;
    const sample *at;
    for (int i = 0; i < y->count; ++i)
        if (!strcmp(y->curves[i].family, family)) least = fmin(least, time_to(y->curves + i, error, &at));
    return least;
}

static void put_dial_cell(FILE *f, const curve *c, double dial)
{
    for (int k = 0; k < c->count; ++k)
        if (fabs(log(c->samples[k].parameter/dial)) < 0.1) {
            const sample *s = c->samples + k;
            fprintf(f, " %.0e, %lld, %.3g |", s->error, s->steps, s->ms);
            return;
        }
    fputs(" - |", f);
}

/* What is got, and what it takes; drawn for the page                                             */
static void put_dial_errors(FILE *f, const study *studies, int count)
{
    fputs("| error at the end, steps, CPU ms, for a dial of | 1e-4 | 1e-6 | 1e-8 | 1e-10 | 1e-12 | 1e-14 |\n"
          "|---|---|---|---|---|---|---|\n", f);
    for (int i = 0; i < count; ++i) {
        fprintf(f, "| %s %s |", studies[i].p->key, studies[i].p->title);
        for (int k = 4; k <= 14; k += 2) put_dial_cell(f, dial_of(studies + i), pow(10, -k));
        fputs("\n", f);
    }
    fputs("\n", f);
}

/* For docs/cost.md: the others against the dial                                                  */
static void put_dial_times(FILE *f, const study *studies, int count)
{
    static const char *const families[] = { "gvi.h, fixed steps", "Gauss-Radau 15", "DOP853", "RKN12(10)" };
    fputs("| time to 1e-7; 1e-10 | by the dial, ms |", f);
    for (int k = 0; k < COUNT(families); ++k) fprintf(f, " %s |", families[k]);
    fputs("\n|---|---|---|---|---|---|\n", f);
    for (int i = 0; i < count; ++i) {
        const study *y = studies + i;
        const double least[2] = { family_time(y, "gvi.h by its dial", 1e-7), family_time(y, "gvi.h by its dial", 1e-10) };
        fprintf(f, "| %s%s%s |", y->p->key, y->p->by_dial ? " " : "", y->p->by_dial ? y->p->title : "");
        put_time(f, " ", least[0], 1);
        put_time(f, "; ", least[1], 1);
        fputs(" |", f);
        for (int k = 0; k < COUNT(families); ++k) {
            put_time(f, " ", family_time(y, families[k], 1e-7), least[0]);
            put_time(f, "; ", family_time(y, families[k], 1e-10), least[1]);
            fputs(" |", f);
        }
        fputs("\n", f);
    }
}

/* What is got, and what it takes, over the dial                                                 */
static void draw_dial(const study *studies, int count, const options *o)
{
    static double dial[DRAWN][SAMPLES], error[DRAWN][SAMPLES], ms[DRAWN][SAMPLES];
    svg_line got[DRAWN + 1], takes[DRAWN];
    const char *colours[DRAWN + 1] = { NULL };
    static const double diagonal[] = { 1e-14, 1e-4 };
    int lines = 0;
    for (int d = 0; d < DRAWN; ++d)
        for (int i = 0; i < count; ++i) {
            const curve *c = dial_of(studies + i);
            if (strcmp(studies[i].p->key, studied[d]) || c->count == 0) continue;
            for (int k = 0; k < c->count; ++k) {
                dial[lines][k] = c->samples[k].parameter;
                error[lines][k] = c->samples[k].error;
                ms[lines][k] = c->samples[k].ms;
            }
            got[lines] = (svg_line){ studies[i].p->title, dial[lines], error[lines], c->count };
            takes[lines] = (svg_line){ studies[i].p->title, dial[lines], ms[lines], c->count };
            ++lines;
        }
    got[lines] = (svg_line){ "the dial", diagonal, diagonal, 2 };
    colours[lines] = "#999999";
    char path[512];
    snprintf(path, sizeof path, "%s/dial.svg", o->out);
    const svg_plot panels[2] = {
        { .title = "What you get for what you ask for", .x_label = "dial: desc.resolution", .y_label = "error of q at the end",
          .lines = got, .line_count = lines + 1, .log_x = 1, .log_y = 1, .dashed = 1u << lines, .colours = colours },
        { .title = "What it takes", .x_label = "dial: desc.resolution", .y_label = "CPU time, ms",
          .lines = takes, .line_count = lines, .log_x = 1, .log_y = 1 } };
    if (svg_write_all(path, panels, 2, 360)) perror(path);
}

static void report_dial(const study *studies, int count, const options *o)
{
    FILE *f = create(o, "dial", ".md");
    put_dial_errors(stdout, studies, count);
    put_dial_times(stdout, studies, count);
    if (!f) return;
    put_dial_times(f, studies, count);
    fclose(f);
    draw_dial(studies, count, o);
}

#endif
