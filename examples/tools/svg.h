/* svg.h - plots and tables as SVG files, for programs that use gvi.h

     const svg_line lines[] = { { "angle", t, q, count } };          // a name, x and y [count]
     const svg_plot plot = { .title = "A pendulum", .x_label = "t", .y_label = "q", .lines = lines, .line_count = 1 };
     if (svg_write("pendulum.svg", &plot)) perror("pendulum.svg");    // 0: written

   One call writes one picture: lines with a legend, linear or logarithmic
   axes, ticks at round numbers; several panels side by side; tables whose cells
   are coloured.  Points that an axis cannot show (0 or less on a logarithmic
   one, not finite) are left out and break the line.                          */
#ifndef SVG_H
#define SVG_H

#include <math.h>
#include <stdio.h>
#include <string.h>

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
    int             from_zero;          /* a linear y axis that begins at 0    */
    unsigned        thick, dashed, faint; /* lines drawn so, one bit each; faint: thin and grey */
    const char *const *colours;         /* of the lines; NULL, also for one: by its place */
    double          x_step;             /* between the ticks of x; 0: a round number */
} svg_plot;

/* An axis shows the numbers lo..hi (or their logarithms) at pixels a..b, with at
   most `most` ticks, or one every `step`.                                           */
typedef struct svg_axis { int log; double lo, hi, a, b; int most; double step; } svg_axis;

static inline double svg_value(const svg_axis *axis, double x) { return axis->log ? x > 0 ? log10(x) : -HUGE_VAL : x; }

static inline double svg_pixel(const svg_axis *axis, double value)
{
    return axis->a + (value - axis->lo)/(axis->hi - axis->lo)*(axis->b - axis->a);
}

/* 1, 2 or 5 times a power of ten, next to x: below for up = 0.                */
static inline double svg_round(double x, int up)
{
    const double ten = pow(10, floor(log10(x) + 1e-9)), m = x/ten;
    if (up) return ten*(m > 5.001 ? 10 : m > 2.001 ? 5 : m > 1.001 ? 2 : 1);
    return ten*(m > 4.999 ? 5 : m > 1.999 ? 2 : 1);
}

/* Of a logarithmic axis: whole decades.  A step of which there were thousands is not taken. */
static inline double svg_tick(const svg_axis *axis)
{
    const double step = 1000*axis->step > axis->hi - axis->lo ? axis->step : svg_round((axis->hi - axis->lo)/axis->most, 1);
    return axis->log && step < 1 ? 1 : step;
}

static inline void svg_fit(svg_axis *axis, const svg_plot *plot, int vertical)
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
    const double size = 1e-9*(fabs(axis->lo) + fabs(axis->hi)), room = fmax(size, 1);
    if (!(axis->hi - axis->lo > size)) axis->lo -= room, axis->hi += room;
    if (axis->log && !vertical && axis->hi - axis->lo < 3) {
        axis->lo = log10(svg_round(pow(10, axis->lo), 0));
        axis->hi = log10(svg_round(pow(10, axis->hi), 1));
    } else if (axis->log) {
        axis->lo = floor(axis->lo);
        axis->hi = ceil(axis->hi);
    } else if (vertical && plot->from_zero) {
        axis->lo = 0;
        axis->hi *= 1.1;
    } else if (vertical || plot->equal) {
        double margin = (axis->hi - axis->lo)/20;
        axis->lo -= margin;
        axis->hi += margin;
    }
}

/* Widens one of two axes until a unit has the same length on both.           */
static inline void svg_square(svg_axis *x, svg_axis *y)
{
    double sx = (x->hi - x->lo)/fabs(x->b - x->a), sy = (y->hi - y->lo)/fabs(y->b - y->a);
    svg_axis *less = sx < sy ? x : y;
    double middle = (less->lo + less->hi)/2, half = (sx < sy ? sy : sx)*fabs(less->b - less->a)/2;
    less->lo = middle - half;
    less->hi = middle + half;
}

static inline void svg_mark(FILE *f, const svg_axis *axis, const svg_axis *other, int vertical, double value, const char *text)
{
    const double z = svg_pixel(axis, value);
    if (vertical) {
        fprintf(f, "<path d=\"M%.1f %.1fH%.1f\" stroke=\"#ddd\"/>", other->a, z, other->b);
        fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"end\">%s</text>\n", other->a - 9, z + 5, text);
    } else {
        fprintf(f, "<path d=\"M%.1f %.1fV%.1f\" stroke=\"#ddd\"/>", z, other->a, other->b);
        fprintf(f, "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", z, other->a + 23, text);
    }
}

/* Powers of ten on logarithmic axes; 1, 2, 5 on a horizontal one that is shorter than two and a half, beyond
   which their numbers would touch.                                            */
static inline void svg_ticks(FILE *f, const svg_axis *axis, const svg_axis *other, int vertical)
{
    const int fine = axis->log && !vertical && axis->hi - axis->lo < 2.51;
    const double step = svg_tick(axis);
    char text[80];
    for (double k = (fine ? floor(axis->lo) : ceil(axis->lo/step - 1e-9)); k*step <= axis->hi + 1e-9*step; k += 1)
        for (int m = 0; m < (fine ? 3 : 1); ++m) {
            static const double part[] = { 1, 2, 5 };
            const double value = fine ? k + log10(part[m]) : k*step + 0;        // not -0
            if (fine) snprintf(text, sizeof text, "%.6g", pow(10, value));
            else if (!axis->log) snprintf(text, sizeof text, "%.6g", value + 0.0);
            else snprintf(text, sizeof text, "10<tspan dy=\"-7\" font-size=\"12\">%.0f</tspan>", value);
            if (value > axis->lo - 1e-9*step && value < axis->hi + 1e-9*step) svg_mark(f, axis, other, vertical, value, text);
        }
}

/* width and dashes: attributes                                                */
static inline void svg_path(FILE *f, const svg_line *line, const svg_axis *x, const svg_axis *y, const char *colour,
                     const char *width, const char *dashes)
{
    int drawing = 0;
    if (line->count == 1)
        fprintf(f, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4\" fill=\"%s\"/>\n", svg_pixel(x, svg_value(x, *line->x)),
                svg_pixel(y, svg_value(y, *line->y)), colour);
    fprintf(f, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"%s stroke-linejoin=\"round\" d=\"", colour,
            width, dashes);
    for (int k = 0; k < line->count; ++k) {
        double a = svg_pixel(x, svg_value(x, line->x[k])), b = svg_pixel(y, svg_value(y, line->y[k]));
        int shown = isfinite(a) && isfinite(b);
        if (shown) fprintf(f, "%s%.1f %.1f", drawing ? "L" : "M", a, b);
        if (shown && k % 16 == 15) fprintf(f, "\n");
        drawing = shown;
    }
    fprintf(f, "\"/>\n");
}

static inline void svg_curve(FILE *f, const svg_line *line, const svg_axis *x, const svg_axis *y, const char *colour)
{
    svg_path(f, line, x, y, colour, "1.7", "");
}

static FILE *svg_begin(const char *path, double width, double height)
{
    FILE *f = fopen(path, "w");
    if (!f) return NULL;
    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\"", width, height);
    fprintf(f, " width=\"%.0f\" height=\"%.0f\"", width, height);
    fprintf(f, " font-family=\"Helvetica, Arial, sans-serif\" font-size=\"15\" fill=\"#222\">\n");
    fprintf(f, "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
    return f;
}

static inline int svg_end(FILE *f)
{
    fprintf(f, "</svg>\n");
    return fclose(f) ? -1 : 0;
}

static inline const char *svg_colour(const svg_plot *plot, int i)
{
    static const char *const colour[] = { "#0072b2", "#d55e00", "#009e73", "#aa4499", "#b8860b", "#56b4e9", "#88562b",
                                          "#444444" };
    if (plot->faint >> i & 1u) return "#c8c8c8";
    if (plot->colours && plot->colours[i]) return plot->colours[i];
    return plot->thick >> i & 1u ? "#111111" : colour[(i - (int)(plot->thick & 1u))%8];
}

static inline const char *svg_width(const svg_plot *plot, int i)
{
    if (plot->faint >> i & 1u) return "1";
    return plot->thick >> i & 1u ? "3.6" : "1.7";
}

static inline const char *svg_dashes(const svg_plot *plot, int i)
{
    return plot->dashed >> i & 1u ? " stroke-dasharray=\"6 3\"" : "";
}

/* One plot between left and right; the first line on top, the faint ones behind the others.  */
static inline void svg_panel(FILE *f, const svg_plot *plot, double left, double right)
{
    svg_axis x = { plot->log_x, 0, 1, left, right, 8, plot->x_step }, y = { plot->log_y, 0, 1, 400, 50, 8, 0 };
    svg_fit(&x, plot, 0);
    svg_fit(&y, plot, 1);
    if (plot->equal) svg_square(&x, &y);
    svg_ticks(f, &x, &y, 0);
    svg_ticks(f, &y, &x, 1);
    fprintf(f, "<path d=\"M%.0f %.0fV%.0fH%.0f\" fill=\"none\" stroke=\"#222\"/>\n", x.a, y.b, y.a, x.b);
    for (int k = 2*plot->line_count - 1; k >= 0; --k) {
        const int i = k % plot->line_count, behind = k >= plot->line_count;
        if ((int)(plot->faint >> i & 1u) != behind) continue;
        svg_path(f, &plot->lines[i], &x, &y, svg_colour(plot, i), svg_width(plot, i), svg_dashes(plot, i));
    }
    fprintf(f, "<text x=\"%.0f\" y=\"28\" font-size=\"17\" font-weight=\"bold\">%s</text>\n", x.a, plot->title);
    fprintf(f, "<text x=\"%.0f\" y=\"448\" text-anchor=\"middle\">%s</text>\n", (x.a + x.b)/2, plot->x_label);
    fprintf(f, "<text transform=\"translate(%.0f %.0f) rotate(-90)\" text-anchor=\"middle\">%s</text>\n", x.a - 58,
            (y.a + y.b)/2, plot->y_label);
}

/* Writes plots side by side, each `wide` pixels; the legend is that of the first.  Returns 0, or -1.  */
static inline int svg_write_all(const char *path, const svg_plot *plots, int count, double wide)
{
    const double end = 80 + wide*count + 120.0*(count - 1);
    size_t longest = 11;
    for (int i = 0; i < plots->line_count; ++i)
        if (strlen(plots->lines[i].name) > longest) longest = strlen(plots->lines[i].name);
    FILE *f = svg_begin(path, end + 40 + 10*(double)longest, 460);
    if (!f) return -1;
    for (int k = 0; k < count; ++k) svg_panel(f, plots + k, 80 + (wide + 120)*k, 80 + (wide + 120)*k + wide);
    for (int i = 0; i < plots->line_count; ++i) {
        const int thick = plots->thick >> i & 1u;
        fprintf(f, "<path d=\"M%.0f %dh22\" stroke=\"%s\" stroke-width=\"%s\"%s/>", end + 18, 70 + 26*i,
                svg_colour(plots, i), thick ? "4.5" : "3", svg_dashes(plots, i));
        fprintf(f, "<text x=\"%.0f\" y=\"%d\"%s%s>%s</text>\n", end + 47, 75 + 26*i, thick ? " font-weight=\"bold\"" : "",
                plots->faint >> i & 1u ? " fill=\"#999\"" : "", plots->lines[i].name);
    }
    return svg_end(f);
}

/* Writes one picture.  Returns 0, or -1 if the file cannot be written.        */
static inline int svg_write(const char *path, const svg_plot *plot) { return svg_write_all(path, plot, 1, 530); }

/* ------------------------------------------------------------------- tables */

/* NaN in `got`: the cell is not there.  NaN in `expected`: refused, as it must be */
typedef struct svg_cell { double got, expected; } svg_cell;

typedef struct svg_table {
    const char        *title;
    const char *const *rows, *const *columns;
    int                row_count, column_count;
    const svg_cell    *cells;               /* [row_count][column_count] */
} svg_table;

enum { SVG_CELL_WIDTH = 50, SVG_CELL_HEIGHT = 27, SVG_TABLE_LEFT = 150, SVG_TABLE_TOP = 62 };

/* Blue: within the tolerance; orange: not; grey: refused                      */
static inline void svg_draw_cell(FILE *f, const svg_cell *cell, double tolerance, double x, double y)
{
    const int refused = isnan(cell->expected), good = fabs(cell->got - cell->expected) <= tolerance;
    if (isnan(cell->got) && !refused) return;
    fprintf(f, "<rect x=\"%.0f\" y=\"%.0f\" width=\"%d\" height=\"%d\" fill=\"%s\" stroke=\"#fff\"/>", x, y,
            SVG_CELL_WIDTH, SVG_CELL_HEIGHT, refused ? "#dddddd" : good ? "#b5d6ee" : "#f0a060");
    fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\"", x + (int)SVG_CELL_WIDTH/2.0, y + 19);
    if (refused) fprintf(f, " fill=\"#777\">no</text>\n");
    else fprintf(f, ">%.2f</text>\n", cell->got);
}

static inline void svg_draw_table(FILE *f, const svg_table *t, double tolerance, double x, double y)
{
    const double left = x + (int)SVG_TABLE_LEFT, top = y + (int)SVG_TABLE_TOP;
    fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" font-weight=\"bold\">%s</text>\n", left, y + 20, t->title);
    for (int j = 0; j < t->column_count; ++j)
        fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\">%s</text>\n", left + (j + 0.5)*(int)SVG_CELL_WIDTH,
                top - 14, t->columns[j]);
    for (int i = 0; i < t->row_count; ++i) {
        fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"end\">%s</text>\n", left - 8, top + i*SVG_CELL_HEIGHT + 19,
                t->rows[i]);
        for (int j = 0; j < t->column_count; ++j)
            svg_draw_cell(f, &t->cells[i*t->column_count + j], tolerance, left + j*SVG_CELL_WIDTH, top + i*SVG_CELL_HEIGHT);
    }
}

/* Writes the tables, `across` in a line.  Returns 0, or -1 if that fails.     */
static inline int svg_write_tables(const char *path, const char *title, const char *note, double tolerance,
                                   const svg_table *tables, int count, int across)
{
    double width = 0, height = 0;
    for (int k = 0; k < count; ++k) {
        width = fmax(width, SVG_TABLE_LEFT + tables[k].column_count*SVG_CELL_WIDTH + 20);
        height = fmax(height, SVG_TABLE_TOP + tables[k].row_count*SVG_CELL_HEIGHT + 16);
    }
    FILE *f = svg_begin(path, across*width, 66 + (count + across - 1)/across*height);
    if (!f) return -1;
    fprintf(f, "<text x=\"16\" y=\"28\" font-size=\"17\" font-weight=\"bold\">%s</text>\n", title);
    fprintf(f, "<text x=\"16\" y=\"50\">%s</text>\n<g font-size=\"14\">\n", note);
    for (int k = 0; k < count; ++k) svg_draw_table(f, &tables[k], tolerance, k%across*width, 58 + k/across*height);
    fprintf(f, "</g>\n");
    return svg_end(f);
}

#endif
