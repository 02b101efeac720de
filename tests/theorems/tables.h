/* tables.h - the tables of svg.h as text */
#ifndef TABLES_H
#define TABLES_H

#include "tools/svg.h"

static void print_table(const svg_table *t)
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
