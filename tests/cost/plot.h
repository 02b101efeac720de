/* plot.h - error against time: panels side by side with one legend, as SVG                    */
#ifndef PLOT_H
#define PLOT_H

#include <math.h>
#include <stdio.h>

enum { PLOT_THIN, PLOT_THICK, PLOT_DASHED };
typedef struct plot_line {
    const char   *name;
    int           style;
    int           count;
    const double *x, *y;
} plot_line;

typedef struct plot_panel {
    const char      *title, *x_label, *y_label;
    int              linear;                /* y axis, from 0; x is always logarithmic         */
    const plot_line *lines;
    int              line_count;
} plot_panel;

/* The values lo..hi (log10 of them) at pixels a..b.                                           */
typedef struct plot_axis { int linear; double lo, hi, a, b; } plot_axis;

static double plot_at(const plot_axis *axis, double x)
{
    double z = axis->linear ? x : x > 0 ? log10(x) : -HUGE_VAL;
    return axis->a + (z - axis->lo)/(axis->hi - axis->lo)*(axis->b - axis->a);
}

/* 1, 2 or 5 times a power of ten, next to x: below for up = 0.                                */
static double plot_round(double x, int up)
{
    double ten = pow(10, floor(log10(x) + 1e-9)), m = x/ten;
    if (up) return ten*(m > 5.001 ? 10 : m > 2.001 ? 5 : m > 1.001 ? 2 : 1);
    return ten*(m > 4.999 ? 5 : m > 1.999 ? 2 : 1);
}

static void plot_fit(plot_axis *axis, const plot_panel *panel, int vertical)
{
    double lo = HUGE_VAL, hi = 0;
    for (int i = 0; i < panel->line_count; ++i)
        for (int k = 0; k < panel->lines[i].count; ++k) {
            double z = vertical ? panel->lines[i].y[k] : panel->lines[i].x[k];
            if (z > 0 && z < lo) lo = z;
            if (z > hi && z < HUGE_VAL) hi = z;
        }
    if (!(hi > 0)) lo = 0.1, hi = 1;
    axis->linear = vertical && panel->linear;
    if (axis->linear) axis->lo = 0, axis->hi = 1.1*hi;
    else if (vertical) axis->lo = floor(log10(lo)), axis->hi = ceil(log10(hi));
    else axis->lo = log10(plot_round(lo, 0)), axis->hi = log10(plot_round(hi, 1));
    if (!(axis->hi > axis->lo)) axis->hi = axis->lo + 1;
}

static void plot_tick(FILE *f, const plot_axis *axis, const plot_axis *other, int vertical, double x,
                      int power)
{
    double z = plot_at(axis, x);
    char text[80];
    if (power) snprintf(text, sizeof text, "10<tspan dy=\"-7\" font-size=\"12\">%.0f</tspan>", log10(x));
    else snprintf(text, sizeof text, "%.6g", x);
    if (vertical) {
        fprintf(f, "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#ddd\"/>", other->a, z, other->b);
        fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", other->a - 9, z + 5, text);
    } else {
        fprintf(f, "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#ddd\"/>", z, other->a, other->b);
        fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", z, other->a + 23, text);
    }
}

/* Every second or third decade upwards if there are many; 1, 2, 5 along the time, up to two and
   a half, beyond which their numbers would touch.                                            */
static void plot_ticks(FILE *f, const plot_axis *axis, const plot_axis *other, int vertical)
{
    double decades = axis->hi - axis->lo;
    if (axis->linear) {
        double step = plot_round(decades/6, 1);
        for (int k = 0; k*step <= axis->hi; ++k) plot_tick(f, axis, other, vertical, k*step, 0);
    } else if (vertical) {
        int step = decades > 16 ? 3 : decades > 8 ? 2 : 1;
        for (int k = (int)axis->hi; k >= (int)axis->lo; k -= step)
            plot_tick(f, axis, other, 1, pow(10, k), 1);
    } else {
        static const double of_decade[] = { 1, 2, 5 };
        for (int k = (int)floor(axis->lo + 1e-9); k <= axis->hi + 1e-9; ++k)
            for (int m = 0; m < (decades > 2.51 ? 1 : 3); ++m) {
                double x = of_decade[m]*pow(10, k);
                double z = log10(x);
                if (z > axis->lo - 1e-9 && z < axis->hi + 1e-9) plot_tick(f, axis, other, 0, x, 0);
            }
    }
}

static const char *plot_colour(const plot_line *line, int index)
{
    static const char *const colour[] = { "#d55e00", "#0072b2", "#009e73", "#aa4499", "#b8860b",
                                          "#56b4e9", "#88562b", "#444444" };
    return line->style == PLOT_THICK ? "#111111" : colour[(index + 8) % 8];
}

static const char *plot_dashes(const plot_line *line)
{
    return line->style == PLOT_DASHED ? " stroke-dasharray=\"6 3\"" : "";
}

static void plot_curve(FILE *f, const plot_line *line, const plot_axis *x, const plot_axis *y,
                       const char *colour)
{
    int drawing = 0;
    fprintf(f, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"%s stroke-linejoin=\"round\" d=\"", colour,
            line->style == PLOT_THICK ? "3.6" : "1.7", plot_dashes(line));
    for (int k = 0; k < line->count; ++k) {
        double a = plot_at(x, line->x[k]), b = plot_at(y, line->y[k]);
        int shown = isfinite(a) && isfinite(b);
        if (shown) fprintf(f, "%s%.1f %.1f", drawing ? "L" : "M", a, b);
        drawing = shown;
    }
    fprintf(f, "\"/>\n");
}

static void plot_one(FILE *f, const plot_panel *panel, double left, double right)
{
    plot_axis x = { 0, 0, 1, left, right }, y = { 0, 0, 1, 400, 50 };
    plot_fit(&x, panel, 0);
    plot_fit(&y, panel, 1);
    plot_ticks(f, &x, &y, 0);
    plot_ticks(f, &y, &x, 1);
    fprintf(f, "<path d=\"M%.0f %.0fV%.0fH%.0f\" fill=\"none\" stroke=\"#222\"/>\n", x.a, y.b, y.a, x.b);
    for (int i = panel->line_count - 1; i >= 0; --i)
        plot_curve(f, panel->lines + i, &x, &y, plot_colour(panel->lines + i, i - 1));
    fprintf(f, "<text x=\"%.0f\" y=\"28\" font-size=\"17\" font-weight=\"bold\">%s</text>\n",
            x.a, panel->title);
    fprintf(f, "<text x=\"%.0f\" y=\"448\" text-anchor=\"middle\">%s</text>\n",
            (x.a + x.b)/2, panel->x_label);
    fprintf(f, "<text transform=\"translate(%.0f 225) rotate(-90)\" text-anchor=\"middle\">%s</text>\n",
            x.a - 58, panel->y_label);
}

/* Writes one or two panels; the legend is that of the first.  Returns 0, or -1.               */
static int plot_write(const char *path, const plot_panel *panels, int count)
{
    const double end = 440 + 480.0*(count - 1);
    FILE *f = fopen(path, "w");
    if (!f) return -1;
    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f 460\"", end + 240);
    fprintf(f, " width=\"%.0f\" height=\"460\"", end + 240);
    fprintf(f, " font-family=\"Helvetica, Arial, sans-serif\" font-size=\"15\" fill=\"#222\">\n");
    fprintf(f, "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
    for (int k = 0; k < count; ++k) plot_one(f, panels + k, 80 + 480*k, 440 + 480*k);
    for (int i = 0; i < panels->line_count; ++i) {
        const plot_line *line = panels->lines + i;
        fprintf(f, "<path d=\"M%.0f %dh22\" stroke=\"%s\" stroke-width=\"%s\"%s/>", end + 20, 70 + 26*i,
                plot_colour(line, i - 1), line->style == PLOT_THICK ? "4.5" : "3", plot_dashes(line));
        fprintf(f, "<text x=\"%.0f\" y=\"%d\"%s>%s</text>\n", end + 50, 75 + 26*i,
                line->style == PLOT_THICK ? " font-weight=\"bold\"" : "", line->name);
    }
    fprintf(f, "</svg>\n");
    return fclose(f) ? -1 : 0;
}

#endif
