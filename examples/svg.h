/* svg.h - line plots as SVG files, for the examples and figures of gvi.h

   One call writes one picture: lines with a legend, linear or logarithmic
   axes, ticks at round numbers.  Points that an axis cannot show (0 or less on
   a logarithmic one, not finite) are left out and break the line.            */
#ifndef SVG_H
#define SVG_H

#include <math.h>
#include <stdio.h>

typedef struct svg_line {
    const char   *name;
    const double *x, *y;
    int           count;
} svg_line;

typedef struct svg_plot {
    const char     *title, *x_label, *y_label;
    int             log_x, log_y;       /* logarithmic axes                    */
    int             equal;              /* one unit is as long in x as in y    */
    const svg_line *lines;
    int             line_count;
} svg_plot;

/* An axis shows the numbers lo..hi (or their logarithms) at pixels a..b, with at
   most `most` ticks.                                                         */
typedef struct svg_axis { int log; double lo, hi, a, b; int most; } svg_axis;

static double svg_value(const svg_axis *axis, double x) { return axis->log ? log10(x) : x; }

static double svg_pixel(const svg_axis *axis, double value)
{
    return axis->a + (value - axis->lo)/(axis->hi - axis->lo)*(axis->b - axis->a);
}

/* The smallest of 1, 2, 5 times a power of ten that makes few enough ticks.    */
static double svg_tick(const svg_axis *axis)
{
    double step = pow(10, floor(log10((axis->hi - axis->lo)/axis->most)));
    static const double factor[] = { 1, 2, 5, 10 };
    int k = 0;
    if (axis->log && step < 1) return 1;
    while (k < 3 && (axis->hi - axis->lo)/(factor[k]*step) > axis->most) ++k;
    return factor[k]*step;
}

static void svg_fit(svg_axis *axis, const svg_plot *plot, int vertical, int margins)
{
    axis->lo = HUGE_VAL;
    axis->hi = -HUGE_VAL;
    for (int i = 0; i < plot->line_count; ++i)
        for (int k = 0; k < plot->lines[i].count; ++k) {
            double z = svg_value(axis, vertical ? plot->lines[i].y[k] : plot->lines[i].x[k]);
            if (isfinite(z) && z < axis->lo) axis->lo = z;
            if (isfinite(z) && z > axis->hi) axis->hi = z;
        }

    // nothing to show, or a single value: some room around it
    if (axis->lo > axis->hi) axis->lo = 0, axis->hi = 1;
    if (!(axis->hi - axis->lo > 1e-9*(fabs(axis->lo) + fabs(axis->hi)))) axis->lo -= 1, axis->hi += 1;
    if (axis->log) {
        axis->lo = floor(axis->lo);
        axis->hi = ceil(axis->hi);
    } else if (margins) {
        double margin = (axis->hi - axis->lo)/20;
        axis->lo -= margin;
        axis->hi += margin;
    }
}

/* Widens one of two axes until a unit has the same length on both.           */
static void svg_square(svg_axis *x, svg_axis *y)
{
    double sx = (x->hi - x->lo)/fabs(x->b - x->a), sy = (y->hi - y->lo)/fabs(y->b - y->a);
    svg_axis *less = sx < sy ? x : y;
    double middle = (less->lo + less->hi)/2, half = (sx < sy ? sy : sx)*fabs(less->b - less->a)/2;
    less->lo = middle - half;
    less->hi = middle + half;
}

static void svg_ticks(FILE *f, const svg_axis *axis, const svg_axis *other, int vertical)
{
    double step = svg_tick(axis);
    for (double k = ceil(axis->lo/step - 1e-9); k*step <= axis->hi + 1e-9*step; k += 1) {
        double z = svg_pixel(axis, k*step);
        char text[80];
        if (axis->log)
            snprintf(text, sizeof text, "10<tspan dy=\"-7\" font-size=\"12\">%.0f</tspan>", k*step);
        else
            snprintf(text, sizeof text, "%.6g", k*step + 0.0);
        if (vertical) {
            fprintf(f, "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#ddd\"/>", other->a, z, other->b);
            fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", other->a - 9, z + 5, text);
        } else {
            fprintf(f, "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#ddd\"/>", z, other->a, other->b);
            fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", z, other->a + 23, text);
        }
    }
}

static void svg_curve(FILE *f, const svg_line *line, const svg_axis *x, const svg_axis *y, const char *colour)
{
    int drawing = 0;
    fprintf(f, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.7\" stroke-linejoin=\"round\" d=\"", colour);
    for (int k = 0; k < line->count; ++k) {
        double a = svg_pixel(x, svg_value(x, line->x[k])), b = svg_pixel(y, svg_value(y, line->y[k]));
        int shown = isfinite(a) && isfinite(b);
        if (shown) fprintf(f, "%s%.1f %.1f", drawing ? "L" : "M", a, b);
        if (shown && k % 16 == 15) fprintf(f, "\n");
        drawing = shown;
    }
    fprintf(f, "\"/>\n");
}

/* Writes the picture.  Returns 0, or -1 if the file cannot be written.        */
static inline int svg_write(const char *path, const svg_plot *plot)
{
    static const char *const colour[] = { "#0072b2", "#d55e00", "#009e73", "#aa4499", "#b8860b", "#444444" };
    const double width = 760, height = 460;
    svg_axis x = { plot->log_x, 0, 1, 80, 610, 8 }, y = { plot->log_y, 0, 1, 400, 50, 8 };
    FILE *f = fopen(path, "w");
    if (!f) return -1;
    svg_fit(&x, plot, 0, plot->equal);
    svg_fit(&y, plot, 1, 1);
    if (plot->equal) svg_square(&x, &y);

    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\"", width, height);
    fprintf(f, " width=\"%.0f\" height=\"%.0f\"", width, height);
    fprintf(f, " font-family=\"Helvetica, Arial, sans-serif\" font-size=\"15\" fill=\"#222\">\n");
    fprintf(f, "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
    svg_ticks(f, &x, &y, 0);
    svg_ticks(f, &y, &x, 1);
    fprintf(f, "<path d=\"M%.0f %.0fV%.0fH%.0f\" fill=\"none\" stroke=\"#222\"/>\n", x.a, y.b, y.a, x.b);
    for (int i = 0; i < plot->line_count; ++i) {
        svg_curve(f, &plot->lines[i], &x, &y, colour[i % 6]);
        fprintf(f, "<path d=\"M%.0f %dh20\" stroke=\"%s\" stroke-width=\"3\"/>", x.b + 18, 70 + 24*i, colour[i % 6]);
        fprintf(f, "<text x=\"%.0f\" y=\"%d\">%s</text>\n", x.b + 45, 75 + 24*i, plot->lines[i].name);
    }
    fprintf(f, "<text x=\"%.0f\" y=\"28\" font-size=\"17\" font-weight=\"bold\">%s</text>\n", x.a, plot->title);
    fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\">%s</text>\n",
            (x.a + x.b)/2, height - 12, plot->x_label);
    fprintf(f, "<text transform=\"translate(22 %.0f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n</svg>\n",
            (y.a + y.b)/2, plot->y_label);
    return fclose(f) ? -1 : 0;
}

#endif
