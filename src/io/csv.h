/* csv.h - trajectories as text: a commented head with the scene, a line of column names, rows, a
 * commented end. */
#ifndef FST_IO_CSV_H
#define FST_IO_CSV_H

#include <stdio.h>

#include <festoon/festoon_tools.h>

#include "io/columns.h"
#include "io/text_table.h"

/* Write to `out`.  A failure is seen by ferror(out). */
void fst_csv_begin(FILE *out, const char *scene);
/* The same for a table in other units, which festoon does not read. */
void fst_csv_begin_in(FILE *out, const char *scene, const char *const units[FST_COLUMN_COUNT]);
void fst_csv_row(FILE *out, const double values[FST_COLUMN_COUNT]);
/* `result` is JSON on one line, or NULL. */
void fst_csv_end(FILE *out, const char *result, int complete);

/* Read such a text.  The caller frees the table, also on failure.  FST_BAD_INPUT: the sentence says which line
 * is wrong. */
fst_status fst_csv_read(const fst_text *text, fst_table *table, fst_error *error);

#endif
