/* grid_svg.h - a table of numbers as a picture, coloured by how near they are to
   what was expected; several tables side by side or below each other          */
#ifndef GRID_SVG_H
#define GRID_SVG_H

#include <math.h>
#include <stdio.h>

/* NaN in `got`: the cell is not there.  NaN in `expected`: refused, as it must be */
typedef struct grid_cell { double got, expected; } grid_cell;

typedef struct grid {
    const char        *title;
    const char *const *rows, *const *columns;
    int                row_count, column_count;
    const grid_cell   *cells;               /* [row_count][column_count] */
} grid;

static const double grid_w = 50, grid_h = 27, grid_left = 130, grid_top = 62;

/* Blue: within the tolerance; orange: not; grey: refused */
static const char *grid_colour(const grid_cell *cell, double tolerance)
{
    if (isnan(cell->expected)) return "#dddddd";
    if (!(fabs(cell->got - cell->expected) <= tolerance)) return "#f0a060";
    return "#b5d6ee";
}

static void grid_draw_cell(FILE *f, const grid_cell *cell, double tolerance, double x, double y)
{
    if (isnan(cell->got) && !isnan(cell->expected)) return;
    fprintf(f, "<rect x=\"%.0f\" y=\"%.0f\" width=\"%.0f\" height=\"%.0f\" fill=\"%s\" stroke=\"#fff\"/>",
            x, y, grid_w, grid_h, grid_colour(cell, tolerance));
    if (isnan(cell->expected))
        fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\" fill=\"#777\">no</text>\n",
                x + grid_w/2, y + 19);
    else
        fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\">%.2f</text>\n",
                x + grid_w/2, y + 19, cell->got);
}

static void grid_draw(FILE *f, const grid *g, double tolerance, double x, double y)
{
    fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" font-weight=\"bold\">%s</text>\n",
            x + grid_left, y + 20, g->title);
    for (int j = 0; j < g->column_count; ++j)
        fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"middle\">%s</text>\n",
                x + grid_left + (j + 0.5)*grid_w, y + grid_top - 14, g->columns[j]);
    for (int i = 0; i < g->row_count; ++i) {
        fprintf(f, "<text x=\"%.0f\" y=\"%.0f\" text-anchor=\"end\">%s</text>\n",
                x + grid_left - 8, y + grid_top + i*grid_h + 19, g->rows[i]);
        for (int j = 0; j < g->column_count; ++j)
            grid_draw_cell(f, &g->cells[i*g->column_count + j], tolerance,
                           x + grid_left + j*grid_w, y + grid_top + i*grid_h);
    }
}

/* The same as text */
static void grid_print(const grid *g)
{
    printf("\n%-20s", g->title);
    for (int j = 0; j < g->column_count; ++j) printf("%8s", g->columns[j]);
    for (int i = 0; i < g->row_count; ++i) {
        printf("\n%-20s", g->rows[i]);
        for (int j = 0; j < g->column_count; ++j) {
            const grid_cell *cell = &g->cells[i*g->column_count + j];
            if (isnan(cell->got)) printf("%8s", isnan(cell->expected) ? "no" : "");
            else printf("%8.2f", cell->got);
        }
    }
    printf("\n");
    fflush(stdout);
}

/* Writes the grids, `across` in a line.  Returns 0, or -1 if that fails.       */
static int grid_write(const char *path, const char *title, const char *note, double tolerance,
                      const grid *grids, int count, int across)
{
    double width = 0, height = 0;
    FILE *f = fopen(path, "w");
    if (!f) return -1;
    for (int k = 0; k < count; ++k) {
        width = fmax(width, grid_left + grids[k].column_count*grid_w + 20);
        height = fmax(height, grid_top + grids[k].row_count*grid_h + 16);
    }
    int down = (count + across - 1)/across;
    double W = across*width, H = 66 + down*height;
    fprintf(f, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\"", W, H);
    fprintf(f, " width=\"%.0f\" height=\"%.0f\"", W, H);
    fprintf(f, " font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" fill=\"#222\">\n");
    fprintf(f, "<rect width=\"100%%\" height=\"100%%\" fill=\"#fff\"/>\n");
    fprintf(f, "<text x=\"16\" y=\"28\" font-size=\"17\" font-weight=\"bold\">%s</text>\n", title);
    fprintf(f, "<text x=\"16\" y=\"50\">%s</text>\n", note);
    for (int k = 0; k < count; ++k) grid_draw(f, &grids[k], tolerance, k%across*width, 58 + k/across*height);
    fprintf(f, "</svg>\n");
    return fclose(f) ? -1 : 0;
}

#endif
