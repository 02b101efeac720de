/* animate.h - films of points, lines and trails as SVG files, for gvi.h; needs svg.h

   One call writes one film: points that move, lines that join them, trails, and
   next to it two plots with a mark that runs along.  It plays in a browser without
   a script (SMIL); where nothing moves it shows the start and all of the trails. */
#ifndef ANIMATE_H
#define ANIMATE_H

#include "svg.h"
#include <stdlib.h>

typedef struct animate_line { int first, step, count; } animate_line;

typedef struct animation {
    const char     *title, *caption, *unit; /* unit of xy; NULL: no scale      */
    int             points, samples;    /* xy is [samples][points][2]          */
    const double   *xy, *t;             /* t: the clock of both plots          */
    int             every;              /* samples from one frame to the next  */
    double          seconds;            /* one showing; repeated for ever      */
    const double   *sizes;              /* radii: pixels, or below 0 in units of xy; 0: none */
    int             trail_first, trails;
    const animate_line *lines;          /* points first, first + step, ... joined */
    int             line_count;
    double          view[4];            /* x0 x1 y0 y1; all 0: what there is   */
    svg_plot        plots[2];
} animation;

/* A colour for each of a few points, one for many.                            */
static inline const char *animate_colour(int i, int of)
{
    static const char *const colour[] = { "#0072b2", "#d55e00", "#009e73", "#aa4499", "#b8860b", "#444444" };
    return colour[of > 6 ? 0 : i];
}

static const double *animate_at(const animation *a, int sample, int point)
{
    return a->xy + 2*((size_t)sample*(size_t)a->points + (size_t)point);
}

/* Number to a tenth of a pixel, as short as it goes.                          */
static inline void animate_number(FILE *f, double x)
{
    double tenths = floor(10*x + 0.5);
    if (fmod(tenths, 10) < 0 || fmod(tenths, 10) > 0) fprintf(f, "%.1f", tenths/10);
    else fprintf(f, "%.0f", tenths/10 + 0.0);
}

static inline void animate_point(FILE *f, const animation *a, const svg_axis *x, const svg_axis *y,
                          int sample, int point)
{
    const double *at = animate_at(a, sample, point);
    animate_number(f, svg_pixel(x, at[0]));
    putc(' ', f);
    animate_number(f, svg_pixel(y, at[1]));
}

/* What the picture must show, then squared by widening.                       */
static inline void animate_fit(const animation *a, svg_axis *x, svg_axis *y)
{
    x->lo = y->lo = HUGE_VAL;
    x->hi = y->hi = -HUGE_VAL;
    for (int s = 0; s < a->samples; ++s)
        for (int i = 0; i < a->points; ++i) {
            const double *at = animate_at(a, s, i), room = a->sizes[i] < 0 ? -a->sizes[i] : 0;
            x->lo = fmin(x->lo, at[0] - room), x->hi = fmax(x->hi, at[0] + room);
            y->lo = fmin(y->lo, at[1] - room), y->hi = fmax(y->hi, at[1] + room);
        }
    if (a->view[1] > a->view[0])
        x->lo = a->view[0], x->hi = a->view[1], y->lo = a->view[2], y->hi = a->view[3];
    double x_room = (x->hi - x->lo)/20 + 1e-300, y_room = (y->hi - y->lo)/20 + 1e-300;
    x->lo -= x_room, x->hi += x_room;
    y->lo -= y_room, y->hi += y_room;
    svg_square(x, y);
}

static inline void animate_begin(FILE *f, const char *attribute)
{
    fprintf(f, "<animate attributeName=\"%s\" values=\"", attribute);
}

static inline void animate_end(FILE *f, const animation *a)
{
    fprintf(f, "\" dur=\"%.6gs\" repeatCount=\"indefinite\"/>", a->seconds);
}

/* How far along its trail the point is at each sample, in pixels.             */
static inline void animate_lengths(const animation *a, const svg_axis *x, const svg_axis *y,
                            int point, double *length)
{
    length[0] = 0;
    for (int s = 1; s < a->samples; ++s) {
        const double *now = animate_at(a, s, point), *was = animate_at(a, s - 1, point);
        length[s] = length[s-1] + hypot(svg_pixel(x, now[0]) - svg_pixel(x, was[0]),
                                        svg_pixel(y, now[1]) - svg_pixel(y, was[1]));
    }
}

/* All of the trail, pale; over it the last `tail` of it, dark: one dash, which
   an offset moves along.                                                     */
static inline void animate_trail(FILE *f, const animation *a, const svg_axis *x, const svg_axis *y, int point)
{
    double *length = (double *)malloc((size_t)a->samples*sizeof *length), all, tail;
    if (!length) return;
    animate_lengths(a, x, y, point, length);
    all = length[a->samples-1];
    tail = fmin(all/5, 250);
    fprintf(f, "<defs><path id=\"t%d\" d=\"M", point);
    for (int s = 0; s < a->samples; ++s) {
        fputs(s == 0 ? "" : s % 12 == 0 ? "\n" : " ", f);
        animate_point(f, a, x, y, s, point);
    }
    fprintf(f, "\"/></defs>\n<g fill=\"none\" stroke-linejoin=\"round\"");
    fprintf(f, " stroke=\"%s\">", animate_colour(point, a->points));
    fprintf(f, "<use href=\"#t%d\" stroke-opacity=\"0.35\"/>\n", point);
    fprintf(f, "<use href=\"#t%d\" stroke-width=\"2\"", point);
    fprintf(f, " stroke-dasharray=\"%.0f %.0f\" stroke-dashoffset=\"%.0f\">", tail, all + tail, tail);
    animate_begin(f, "stroke-dashoffset");
    for (int s = 0, k = 0; s < a->samples; s += a->every, ++k) {
        fputs(k == 0 ? "" : k % 24 == 0 ? ";\n" : ";", f);
        animate_number(f, tail - length[s]);
    }
    animate_end(f, a);
    fprintf(f, "</use></g>\n");
    free(length);
}

static inline void animate_body(FILE *f, const animation *a, const svg_axis *x, const svg_axis *y, int point)
{
    const double size = a->sizes[point], *at = animate_at(a, 0, point);
    const double r = size < 0 ? -size*fabs(x->b - x->a)/(x->hi - x->lo) : size;
    int moves = 0;
    if (!(r > 0)) return;
    for (int s = 0; s < a->samples; s += a->every) {
        const double *now = animate_at(a, s, point);
        moves |= fabs(svg_pixel(x, now[0]) - svg_pixel(x, at[0])) > 0.05;
        moves |= fabs(svg_pixel(y, now[1]) - svg_pixel(y, at[1])) > 0.05;
    }
    fprintf(f, "<circle r=\"%.1f\" fill=\"%s\"", r, size < 0 ? "#cfe0ee" : animate_colour(point, a->points));
    fprintf(f, " cx=\"%.1f\" cy=\"%.1f\"", svg_pixel(x, at[0]), svg_pixel(y, at[1]));
    fputs(moves ? ">\n" : "/>\n", f);
    for (int c = 0; c < 2 && moves; ++c) {
        animate_begin(f, c ? "cy" : "cx");
        for (int s = 0, k = 0; s < a->samples; s += a->every, ++k) {
            fputs(k == 0 ? "" : k % 24 == 0 ? ";\n" : ";", f);
            animate_number(f, svg_pixel(c ? y : x, animate_at(a, s, point)[c]));
        }
        animate_end(f, a);
    }
    if (moves) fprintf(f, "</circle>\n");
}

static inline void animate_joined(FILE *f, const animation *a, const svg_axis *x, const svg_axis *y,
                           const animate_line *l, int s)
{
    for (int k = 0; k < l->count; ++k) {
        putc(k ? ' ' : 'M', f);
        animate_point(f, a, x, y, s, l->first + k*l->step);
    }
}

static inline void animate_lines(FILE *f, const animation *a, const svg_axis *x, const svg_axis *y)
{
    for (int k = 0; k < a->line_count; ++k) {
        const animate_line *l = a->lines + k;
        fprintf(f, "<path fill=\"none\" stroke=\"#555\" stroke-width=\"%s\" stroke-linejoin=\"round\" d=\"",
                a->line_count > 4 ? "1.3" : "2.5");
        animate_joined(f, a, x, y, l, 0);
        fprintf(f, "\">");
        animate_begin(f, "d");
        for (int s = 0; s < a->samples; s += a->every) {
            if (s) fputs(";\n", f);
            animate_joined(f, a, x, y, l, s);
        }
        animate_end(f, a);
        fprintf(f, "</path>\n");
    }
}

/* A bar of round length, to tell how large things are.                        */
static inline void animate_scale(FILE *f, const animation *a, const svg_axis *x)
{
    const double bar = svg_tick(x), left = x->a, right = left + bar*(x->b - x->a)/(x->hi - x->lo);
    if (!a->unit) return;
    fprintf(f, "<path d=\"M%.1f 484v6H%.1fv-6\" fill=\"none\" stroke=\"#666\"/>", left, right);
    fprintf(f, "<text x=\"%.1f\" y=\"492\" fill=\"#666\">%g %s</text>\n", right + 8, bar, a->unit);
}

/* One of the two plots, `top` pixels down, and the mark that runs along.      */
static inline void animate_plot(FILE *f, const animation *a, const svg_plot *plot, double top)
{
    svg_axis x = { 0, a->t[0], a->t[a->samples-1], 590, 880, 5, 0 }, y = { 0, 0, 1, top + 150, top, 5, 0 };
    svg_fit(&y, plot, 1);
    svg_ticks(f, &x, &y, 0);
    svg_ticks(f, &y, &x, 1);
    fprintf(f, "<path d=\"M%.0f %.0fV%.0fH%.0f\" fill=\"none\" stroke=\"#222\"/>\n", x.a, y.b, y.a, x.b);
    for (int i = 0; i < plot->line_count; ++i) {
        svg_curve(f, &plot->lines[i], &x, &y, animate_colour(i, plot->line_count));
        if (plot->line_count > 1)
            fprintf(f, "<text x=\"%d\" y=\"%.0f\" fill=\"%s\" text-anchor=\"end\">%s</text>\n",
                    880 - 75*(plot->line_count - 1 - i), top - 8, animate_colour(i, plot->line_count),
                    plot->lines[i].name);
    }
    fprintf(f, "<text x=\"530\" y=\"%.0f\" font-weight=\"bold\">%s</text>\n",
            top - (plot->line_count > 1 ? 26 : 13), plot->title);
    fprintf(f, "<path d=\"M%.0f %.0fV%.0f\" stroke=\"#d00\"><animateTransform attributeName=\"transform\" "
            "type=\"translate\" from=\"0\" to=\"%.0f\"", x.a, y.a, y.b, x.b - x.a);
    fprintf(f, " dur=\"%.6gs\" repeatCount=\"indefinite\"/></path>\n", a->seconds);
}

/* Writes the film.  Returns 0, or -1 if there is nothing to show or the file cannot be written. */
static inline int animate_write(const char *path, const animation *a)
{
    svg_axis x = { 0, 0, 1, 20, 480, 6, 0 }, y = { 0, 0, 1, 480, 40, 6, 0 };
    if (a->points < 1 || a->samples < 1 || a->every < 1 || !(a->seconds > 0)) return -1;
    FILE *f = fopen(path, "w");
    if (!f) return -1;
    animate_fit(a, &x, &y);
    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 900 500\"");
    fprintf(f, " font-family=\"Helvetica, Arial, sans-serif\" font-size=\"13\" fill=\"#222\">\n");
    fprintf(f, "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
    fprintf(f, "<text x=\"20\" y=\"26\" font-size=\"17\" font-weight=\"bold\">%s</text>\n", a->title);
    fprintf(f, "<text x=\"480\" y=\"494\" text-anchor=\"end\" fill=\"#666\">%s</text>\n", a->caption);
    animate_scale(f, a, &x);
    for (int i = 0; i < a->points; ++i)
        if (a->sizes[i] < 0) animate_body(f, a, &x, &y, i);
    for (int i = 0; i < a->trails; ++i) animate_trail(f, a, &x, &y, a->trail_first + i);
    animate_lines(f, a, &x, &y);
    for (int i = 0; i < a->points; ++i)
        if (!(a->sizes[i] < 0)) animate_body(f, a, &x, &y, i);
    animate_plot(f, a, &a->plots[0], 70);
    animate_plot(f, a, &a->plots[1], 300);
    fprintf(f, "<text x=\"735\" y=\"490\" text-anchor=\"middle\">%s</text>\n</svg>\n", a->plots[1].x_label);
    return fclose(f) ? -1 : 0;
}

#endif
