/* bead_columns.h - the columns of a sweep over a scene that lists beads. */
#ifndef FST_SWEEP_BEAD_COLUMNS_H
#define FST_SWEEP_BEAD_COLUMNS_H

#include <festoon/beads.h>

/* What a row says of a run of several beads; `largest` is the group of most beads, the first of several. */
typedef struct fst_beads_row {
    int outcome, method, group_count, largest_kind, largest_count;
    double mean_r, centre_rate, axis_rate; /* of the largest */
    double drive_power, plate_power, pair_power, impact_power, energy_residual, periods;
    int64_t counts[FST_BEAD_EVENTS], rhs_calls, accepted, rejected;
} fst_beads_row;
fst_beads_row fst_beads_row_of(const fst_beads_result *result);

/* A name of a list by its place, an int; an int; an int64_t; a double. */
typedef enum { FST_BEAD_NAME, FST_BEAD_INT, FST_BEAD_COUNT, FST_BEAD_REAL } fst_bead_column_kind;

/* A column: its name, what it holds, the list of names, "apart|walker|...", and the unit of a number. */
typedef struct fst_bead_column {
    const char *name;
    fst_bead_column_kind kind;
    const char *names, *unit;
    size_t offset; /* in fst_beads_row */
} fst_bead_column;
int fst_bead_column_count(void);
const fst_bead_column *fst_bead_column_at(int index);

/* The column of this name, or NULL. */
const fst_bead_column *fst_bead_column_find(const char *name);

#endif
