/* tables.h - pictures of a study, and its tables as text */
#ifndef TABLES_H
#define TABLES_H

#include "examples/tools/svg.h"

static MAYBE void draw(const char *folder, const char *file, const svg_plot *plot)
{
    char path[500];
    snprintf(path, sizeof path, "%s/%s.svg", folder, file);
    if (svg_write(path, plot)) exit(1);
}

static MAYBE void print_table(const svg_table *t)
{
    printf("\n%-20s", t->title);
    for (int j = 0; j < t->column_count; ++j) printf("%8s", t->columns[j]);
    for (int i = 0; i < t->row_count; ++i) {
        printf("\n%-20s", t->rows[i]);
        for (int j = 0; j < t->column_count; ++j) {
            const svg_cell *cell = &t->cells[i*t->column_count + j];
            if (isnan(cell->got)) printf("%8s", isnan(cell->expected) ? "no" : "");
            else printf("%8.2f", cell->got);
        }
    }
    printf("\n");
    fflush(stdout);
}

#endif
