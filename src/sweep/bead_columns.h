/* bead_columns.h - rows of a sweep that are not runs of a bead on the plate (fst_row_kind): what they hold, their columns,
 * and how they are computed. */
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

/* Of a world, beside the result of its run. */
typedef struct fst_world_row {
    int frame;
    double mean_height, mean_medium_power, mean_velocity, mean_velocity_error, final_state[FST_BEAD_NUMBERS];
} fst_world_row;

/* Of the places where a bead floats: the best one below the magnet and above it. */
typedef struct fst_levitation_row {
    int places;
    struct {
        int word; /* fst_floating */
        double height_mm, tilt_deg, gap_mm, growth_per_s;
    } side[2];
} fst_levitation_row;

/* A finished point. */
typedef struct fst_sweep_record {
    int64_t point;
    int carried;       /* it started from its neighbour's end state */
    fst_status status; /* other than FST_OK: the run failed, and result.reason says why */
    int dynamics;      /* fst_dynamics */
    fst_run_result result;
    union { /* by the kind of the rows */
        fst_beads_row beads;
        fst_world_row world;
        fst_levitation_row levitation;
    };
} fst_sweep_record;

/* Compute the row of a point: status, result.reason and what its kind has; of a world from the state `start` unless it is
 * NULL.  FST_INTERRUPTED: progress said so. */
fst_status fst_own_row(fst_row_kind kind, const fst_params *params, const double *start,
                       const fst_progress *progress, fst_sweep_record *record, fst_error *error);

/* Whether a run of a world may start from the end of this one. */
int fst_can_go_on(const fst_sweep_record *record);

/* Whether runs of worlds can start where others ended: all that changes with time must then be as at the start, and the
 * first axis must not move the plate or the wave under the bead. */
fst_status fst_check_carried_worlds(const fst_grid *grid, const fst_progress *progress, fst_error *error);

/* A name of a list by its place, an int; an int; an int64_t; a double. */
typedef enum { FST_BEAD_NAME, FST_BEAD_INT, FST_BEAD_COUNT, FST_BEAD_REAL } fst_bead_column_kind;

/* A column: whose rows have it, its name, what it holds, the list of names, "apart|walker|...", and the unit of a
 * number. */
typedef struct fst_bead_column {
    fst_row_kind rows;
    const char *name;
    fst_bead_column_kind kind;
    const char *names, *unit;
    size_t offset; /* in fst_sweep_record */
} fst_bead_column;
int fst_bead_column_count(fst_row_kind kind);
const fst_bead_column *fst_bead_column_at(fst_row_kind kind, int index);

/* The first column of this name of any kind, or NULL. */
const fst_bead_column *fst_bead_column_find(const char *name);

#endif
