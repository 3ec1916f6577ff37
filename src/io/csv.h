/* csv.h - trajectories as text, of one bead or of several. */
#ifndef FST_IO_CSV_H
#define FST_IO_CSV_H

#include <stdio.h>

#include <festoon/festoon_tools.h>

#include "io/columns.h"
#include "io/text_table.h"

/* Write the head: what the file is, its scene and the names of its columns, in scaled units or (`units` not NULL) in
 * those, for other programs.  Failures are seen on the stream. */
void fst_csv_begin(FILE *out, int of_beads, const char *scene, const fst_column_info *const *columns, int count,
                   const char *const *units);
void fst_csv_row(FILE *out, const double *values, int count);

/* Write the end; `result` is a line of JSON or NULL. */
void fst_csv_end(FILE *out, const char *result, int complete);

/* Read a trajectory of one bead.  The caller frees the table, also on failure.  FST_BAD_INPUT: the sentence says which
 * line is wrong. */
fst_status fst_csv_read(const fst_text *text, fst_table *table, fst_error *error);

/* Whether the first line is that of a trajectory of several beads. */
int fst_csv_of_beads(const fst_text *text);

/* Read what the comments say: the scene, whether the run was complete, and the line (from 1) that says so, 0 where there
 * is none; `beads` as in fst_scene_parse_beads(). */
fst_status fst_csv_comments(const fst_text *text, int of_beads, fst_params *params, fst_bead_params **beads,
                            size_t *ended, int *complete, fst_error *error);

/* The result, as JSON; NULL: there is none. */
const char *fst_csv_result(const fst_text *text);

/* Read the rows: data[i] of each column.  Where none of those from `needed` on is there, their numbers are zeros; with
 * `gaps` a cell may say that there is no number (NAN).  The caller frees data[i], also on failure. */
fst_status fst_csv_rows(const fst_text *text, size_t ended, const fst_column_info *const *columns, int needed,
                        int count, int gaps, double **data, size_t *rows, fst_error *error);

#endif
