/* festoon_tools.h - scenes, files, sweeps, figures and films around festoon.h.
 *
 * The library libfestoon-tools holds what needs files, other libraries or other programs.  A program that only
 * needs the physics uses festoon.h and libfestoon.
 */
#ifndef FESTOON_FESTOON_TOOLS_H
#define FESTOON_FESTOON_TOOLS_H

#include <stdio.h>

#include <festoon/beads.h>
#include <festoon/festoon.h>
#include <festoon/look.h>
#include <festoon/charts.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ scenes */

#define FST_SCENE_SIZE_LIMIT (1024 * 1024) /* bytes */

/* Read a YAML scene over `params` (usually the defaults): groups of keys as in params.def, values with optional
 * units.  FST_BAD_INPUT (error->where is "FILE:LINE"): an unknown key (the sentence names the nearest valid
 * one), a wrong unit, a value out of range, a key or quantity given twice, an alias or anchor, more than one
 * document, no text, more than FST_SCENE_SIZE_LIMIT, a directory, a missing file.  `params` is unchanged on
 * failure. */
FST_API fst_status fst_scene_read(const char *path, fst_params *params, fst_error *error);

/* The same from memory; `name` stands for the path in messages. */
FST_API fst_status fst_scene_parse(const char *text, size_t size, const char *name, fst_params *params,
                                   fst_error *error);

/* The same two for scenes that list up to FST_BEADS_MANY beads: more than FST_BEADS_MOST, which the above refuse, come in
 * *beads, which the parameters borrow and the caller frees.  NULL otherwise. */
FST_API fst_status fst_scene_read_beads(const char *path, fst_params *params, fst_bead_params **beads,
                                        fst_error *error);
FST_API fst_status fst_scene_parse_beads(const char *text, size_t size, const char *name, fst_params *params,
                                         fst_bead_params **beads, fst_error *error);

/* The scene as YAML text, with docs and units as comments if `commented`; free() it.  NULL: no memory.  Reading
 * it gives the same parameters, bit by bit. */
FST_API char *fst_scene_text(const fst_params *params, int commented);

/* Write that text to a file.  FST_BAD_INPUT where the file is there already and `overwrite` is 0. */
FST_API fst_status fst_scene_write(const char *path, const fst_params *params, int commented, int overwrite,
                                   fst_error *error);

/* ------------------------------------------------------------------ maps of a field */

/* Read a map of the field; fst_field_map_free() it.  The ending of the name is that of the format,
 * docs/magnets.md describes them.  `checksum` receives 16 hexadecimal digits that belong to the file's content.
 * FST_BAD_INPUT: no such file, a hole, a sample twice, unequal spacing, a unit or a number that is none; the
 * error says where. */
FST_API fst_status fst_field_map_read(const char *path, const fst_progress *progress, fst_field_map **map,
                                      char checksum[17], fst_error *error);

/* Read the map that magnet.file names, if it names one, and let the parameters use it.  They borrow it: free
 * *map (NULL: no map was wanted) when neither they nor copies of them are used any more.  FST_BAD_INPUT: as
 * above, or magnet.checksum is that of another content. */
FST_API fst_status fst_params_read_map(fst_params *params, const fst_progress *progress, fst_field_map **map,
                                       fst_error *error);

/* Write a map of a model's field as CSV: a square grid of steps of `spacing`, out to `radius` from the axis
 * along X and Y (both in m), at the height of the bead's centre.  fst_field_map_read() reads it back. */
FST_API fst_status fst_field_map_write(const char *path, const fst_model *model, double radius, double spacing,
                                       const fst_progress *progress, fst_error *error);

/* ------------------------------------------------------------------ JSON */

/* One JSON document each: 17 significant digits, undefined numbers null, a newline at the end; free() it.
 * NULL: no memory.  The keys are those of run.def and of params.def. */
FST_API char *fst_run_json(const fst_params *params, const fst_run_result *result, const fst_ramp_point *ramp,
                           size_t ramp_count);
FST_API char *fst_schema_json(void);

/* The scene in SI and its scaled groups: `scene`, `groups`. */
FST_API char *fst_scene_json(const fst_params *params);

/* `orbit`; `others` (NULL: not asked for) are further patterns with the same number of festoons.  `units`: as of
 * fst_run_json_in(); with `state_si`, the state in m, m/s and rad/s. */
FST_API char *fst_orbit_json(const fst_params *params, const fst_orbit *orbit, const fst_orbit *others,
                             size_t count, fst_shown_units units);
FST_API char *fst_levitation_json(const fst_params *params, const fst_levitation_list *list);
FST_API char *fst_locked_json(const fst_params *params, double omega, const fst_locked_list *list,
                              fst_shown_units units);
FST_API char *fst_branch_json(const fst_params *params, const fst_branch *branch, fst_shown_units units);
FST_API char *fst_lyapunov_json(const fst_params *params, const fst_lyapunov *lyapunov);

/* Write the JSON of a branch to a file, whole or not at all. */
FST_API fst_status fst_branch_write(const char *path, const fst_params *params, const fst_branch *branch,
                                    fst_error *error);

/* Read a branch back from the JSON above (crossings come after the other special points).  FST_BAD_INPUT: the
 * file is not a branch, or a member has a value that it cannot have; the sentence names both.  FST_IO: the disk
 * failed. */
FST_API fst_status fst_branch_read(const char *path, fst_branch *branch, fst_error *error);

/* Read pairs (parameter, observable) from a file of one or more documents that `run --json` printed;
 * free(*dots). */
FST_API fst_status fst_run_dots_read(const char *path, const char *key, const char *observable, double **dots,
                                     size_t *count, fst_error *error);

/* fst_run_json(); with FST_SHOWN_LAB or FST_SHOWN_SI also the numbers that have an SI unit, beside the scaled
 * ones: `mean_r_m`, `mean_b_tesla`, `mean_friction_power_watts`, `mean_load_newtons`, ...; null where B0 is not
 * known. */
FST_API char *fst_run_json_in(const fst_params *params, const fst_run_result *result,
                              const fst_ramp_point *ramp, size_t ramp_count, fst_shown_units units);

/* The same of a world, with the state's twelve numbers, `frame`, and the end on the laboratory's axes: `final_time`,
 * `final_lab`, `final_lab_si`. */
FST_API char *fst_world_json(const fst_params *params, const fst_world_result *result, fst_shown_units units);

/* A motion that repeats itself with the drive: `period`, `frame`, `multipliers` (pairs), `stable`, `state`, `residual`;
 * in SI `period_s`, `state_si`. */
FST_API char *fst_world_orbit_json(const fst_params *params, const fst_world_orbit *orbit,
                                   fst_shown_units units);

/* The field at (x, y), as JSON: `x`, `y`, `b` (3), `grad` (3 x 3), in the magnet's frame,
 * scaled; `height`, and the `force` and `load` of fst_field_pull(); with FST_SHOWN_LAB or FST_SHOWN_SI also
 * `b_tesla` and `grad_tesla_per_m`, null where B0 does not follow from the parameters, `force_newtons` and
 * `load_newtons`; at a time (fst_field_model_at()) `time`.  Of a smoothed map also their errors, `b_error` and so on, and `fit`. */
FST_API char *fst_field_json(const fst_model *model, double x, double y, fst_shown_units units);

/* ------------------------------------------------------------------ trajectories */

/* A file into which a run streams its samples; the ending chooses the format: .h5 (HDF5, with the scene and the
 * result inside) or .csv (a commented head with the scene, then a line of column names with units).  It is
 * written under a temporary name and renamed by fst_trajectory_close(). */
typedef struct fst_trajectory fst_trajectory;
FST_API fst_status fst_trajectory_create(const char *path, const fst_params *params,
                                         fst_trajectory **trajectory, fst_error *error);
/* A trajectory for other programs: a .csv whose columns are in laboratory or SI units (`units`), named in its
 * line of columns.  fst_trajectory_read() refuses it. */
FST_API fst_status fst_trajectory_create_in(const char *path, const fst_params *params, fst_shown_units units,
                                            fst_trajectory **trajectory, fst_error *error);
/* FST_BAD_INPUT: a number of the sample is not finite; such a file could not be read back. */
FST_API fst_status fst_trajectory_append(fst_trajectory *trajectory, const fst_sample *sample,
                                         fst_error *error);
/* Finish the file.  `result` (may be NULL) is stored in it; `complete` is 0 for an interrupted run, and the
 * file then says complete = false. */
FST_API fst_status fst_trajectory_close(fst_trajectory *trajectory, const fst_run_result *result, int complete,
                                        fst_error *error);
/* Give up: remove the temporary file. */
FST_API void fst_trajectory_discard(fst_trajectory *trajectory);

/* The columns of a trajectory, in order: name, unit, doc. */
typedef struct fst_column_info {
    const char *name, *unit, *doc;
} fst_column_info;
FST_API int fst_column_count(void);
FST_API const fst_column_info *fst_column_at(int index);

/* The values of a sample in all columns, fst_column_count() of them, in their order. */
FST_API void fst_column_values(const fst_sample *sample, double *values);

/* A trajectory that was read from .h5 or .csv: columns[i][row], in the order of fst_column_at(). */
typedef struct fst_table {
    size_t rows;
    double **columns;
    fst_params params; /* the scene that made it */
    int complete;
    fst_field_map *map; /* of that scene; NULL: it has none, or the map's file is gone or has changed */
} fst_table;
/* FST_BAD_INPUT: no trajectory, cut off, damaged, or with a number that is not finite.  FST_NO_MEMORY: HDF5
 * files are read into memory as a whole, if they take no more than half of it. */
FST_API fst_status fst_trajectory_read(const char *path, fst_table *table, fst_error *error);
FST_API void fst_table_free(fst_table *table);

/* Run `params` and keep the samples from the discard on in memory instead of a file; free the table with
 * fst_table_free().  `progress` may be NULL. */
FST_API fst_status fst_collect_run(const fst_params *params, const fst_progress *progress,
                                   fst_run_result *result, fst_table *table, fst_error *error);
/* The column of that name; NULL: there is none. */
FST_API const double *fst_collected(const fst_table *table, const char *name);

/* ------------------------------------------------------------------ figures */

/* What a figure of a trajectory shows. */
typedef enum { FST_FIGURES(FST_ROW_ENUM) FST_FIGURE_COUNT } fst_figure_kind;

#define FST_FIGURE_KEYS 6

/* The kind of figure that shows a trajectory best: of a ramp its means over the drive, else the path. */
FST_API fst_figure_kind fst_figure_kind_of(const fst_table *table);

typedef struct fst_figure_options {
    uint32_t cookie;
    fst_figure_kind kind;
    const char *colour; /* a column's name: "n_z", "slip", "angle", ... */
    int arrows;         /* draw arrows of the horizontal moment */
    int inset;          /* draw the path of the moment in the local frame as an inset of the path's figure */
    double from,
        to; /* drive periods shown; NAN: from the discard, for as long as makes a good picture; all of a ramp */
    double zoom[4];    /* x0 x1 y0 y1 in mm; NAN: everything */
    const char *title; /* NULL: made from the scene */
    double size[2];    /* as in fst_chart */
    /* Columns that figures of time, sections and ramps show; NULL ends a shorter list, an empty one is chosen.
     */
    const char *keys[FST_FIGURE_KEYS];
    fst_shown_units units; /* as given: lengths in mm for paths, otherwise scaled */
    int from_magnet;       /* the path as seen from the turning magnet */
} fst_figure_options;
FST_API fst_figure_options fst_default_figure_options(void);

/* Draw a trajectory to OUT.(svg|pdf|png) with gnuplot.  The script OUT.gp and the data OUT.dat stay beside it,
 * and gnuplot draws the same figure again from the script.  FST_UNAVAILABLE: there is no gnuplot (the sentence
 * names the package). */
FST_API fst_status fst_figure_trajectory(const fst_table *table, const char *out,
                                         const fst_figure_options *options, fst_error *error);

/* Draw a branch: `observable` ("mean_r", "mean_alpha_dot", "mean_nz", "festoons", "min_r", "period") over the
 * parameter, with stable parts solid, unstable ones dashed, special points labelled, and `dots` (pairs of
 * abscissa and ordinate, may be NULL) on top; or, with "multipliers", the multipliers in the complex plane with
 * the unit circle (of locked states: their eigenvalues).  As given: laboratory units where the parameter has
 * one. FST_BAD_INPUT: the branch has no value of the observable; the sentence names those it has. */
FST_API fst_status fst_figure_branch(const fst_branch *branch, const char *observable, fst_shown_units units,
                                     const double *dots, size_t dot_count, const char *out, fst_error *error);

/* What a map of the field shows: |B|, a component of B, the horizontal magnetic force on a bead whose moment
 * lies along the field, or the load of such a bead on the plate. */
typedef enum { FST_FIELDS(FST_ROW_ENUM) FST_FIELD_COUNT } fst_field_quantity;
typedef struct fst_field_options {
    uint32_t cookie;
    fst_field_quantity quantity;
    double height; /* over the magnet's reference plane, in l; NAN: that of a bead's centre */
    fst_shown_units units;
    double half_width, half_height; /* of the map, in l; NAN: what shows the magnet */
    const char *title;              /* NULL: made from what is shown */
    double size[2];                 /* as in fst_chart */
} fst_field_options;
/* The strength |B| at the height of the bead's centre, in the units as given. */
FST_API fst_field_options fst_default_field_options(void);

/* Draw such a map to OUT.(svg|pdf|png), as fst_figure_trajectory() does.  Without options (NULL) it is that of
 * the defaults. */
FST_API fst_status fst_figure_field_map(const fst_params *params, const fst_field_options *options,
                                        const char *out, fst_error *error);

/* The map of |B| on the plane of the bead's centre (the paper's Fig. 5). */
FST_API fst_status fst_figure_field(const fst_params *params, fst_shown_units units, const char *out,
                                    fst_error *error);

/* ------------------------------------------------------------------ sweeps */

/* Whether a run starts from the end state of its neighbour along the first axis, and in which direction of that
 * axis. */
typedef enum { FST_CARRIES(FST_ROW_ENUM) FST_CARRY_COUNT } fst_carry;

/* What became of a bead: of how many points, how often the equations of motion were evaluated for all of them, and how
 * many drive periods their runs took together. */
typedef struct fst_sweep_outcome {
    int64_t points, rhs_calls;
    double periods;
} fst_sweep_outcome;
enum { FST_SWEEP_OUTCOMES = FST_REGIME_COUNT + 1 };

/* The name of a place in fst_sweep_counts.outcomes. */
FST_API const char *fst_sweep_outcome_name(fst_row_kind kind, int place);

/* How far a sweep is, or how it ended. */
typedef struct fst_sweep_counts {
    int64_t points, there; /* points of the grid, and how many of them have a row */
    /* Points that this call wants to have rows, as far as it is known; how many of them have one; and about how
     * many it will be in the end.  Without refining these are `points`, `there` and `points`.  A refined sweep
     * tells too in how many rows the key by which it is refined has no value: in all of them means that nothing
     * was divided. */
    int64_t wanted, computed, expected, undefined;
    int64_t added, failed; /* rows added by this call, and how many of these are runs that failed */
    double seconds;        /* since the beginning of the call */
    double processor_seconds, journal_seconds; /* processor time of this process, and how much of it the thread
                                                  took that keeps the database */
    int rank, ranks; /* the number of this process among those of an MPI job, and how many there are: 0 of 1
                        without MPI; only rank 0 has counts */
    /* The database was damaged: its sound rows were kept, the rows that are known to be lost are computed
     * again, and the damaged file lies beside it as FILE.damaged. */
    int repaired;
    int64_t lost;
    int64_t begun_anew; /* runs begun anew, because what was saved of them after a while is damaged */
    char all_failed
        [288]; /* why the first run failed, if every row of a sweep that is done tells of one that did; else "" */
    /* Of the rows that this call added, by fst_regime, of several beads by fst_beads_outcome; the last place has runs that
     * failed, of which only the number is known. */
    fst_row_kind kind;
    fst_sweep_outcome outcomes[FST_SWEEP_OUTCOMES];
} fst_sweep_counts;

typedef struct fst_sweep_options {
    uint32_t cookie;
    const char *const *axes; /* as for fst_grid_new() */
    int axis_count;
    uint64_t seed;
    fst_carry carry;
    fst_arithmetic arithmetic; /* the default is the fastest that the processor can do */
    int threads;               /* 0: as many as this process may use */
    int lanes;                 /* runs side by side on a thread, 1, 4 or 8; 0: as many as suit the processor */
    /* Share the points with the other processes that mpirun (Open MPI) or srun --mpi=pmix started together with
     * this one.  All of them must make the same call.  Rank 0 alone touches the database and reports failures;
     * the error of the others has a code only.  0: work alone, even if other processes were started. */
    int with_ranks;
    /* Told every tenth of a second or so (NULL: nobody is told), after the counts were brought up to date.  A
     * status other than FST_OK ends the sweep; the rows that are done are kept. */
    const fst_progress *progress;
    /* Seconds of work on a run after which its state is saved in the database, so that after a kill the run
     * goes on from there; 3 by default.  With n threads in all ranks and n > 8, (n + 7)/8 times as many,
     * rounded down. */
    double checkpoint_seconds;
    /* 0: every point is computed.  N: first every 2^N-th point of each axis LO:HI:COUNT (and its last one),
     * then those between, halving the distance N times, where the key `refine_by` (NULL: the regime) differs
     * between neighbours: a number by more than `refine_step`, in its scaled unit.  Other axes are not refined:
     * each combination of their values is refined by itself.  The points follow from the rows alone.  A later
     * call on the file may refine otherwise, or not: it keeps all rows, and adds what it lacks. */
    int refine;
    const char *refine_by;
    double refine_step;
    int levitation; /* rows tell where the bead floats, fst_grid_ask_levitation(), and nothing is run */
    /* Compute shard 1 to `shards` alone, in a database of its own, which no other shard goes on with: one of
     * each `shards` points, or chains of carried points.  0 of 0: all.  A refined sweep has no shards. */
    int shard, shards;
} fst_sweep_options;
FST_API fst_sweep_options fst_default_sweep_options(void);

/* Run every point of a grid that has no row yet in the database `path` (made if missing), and add the rows as
 * they come.  A run that fails, or whose bead leaves the plate, gets a row too.  Rows depend only on their
 * parameters and the form of arithmetic.  Killed at any moment, the file keeps what was committed, and the same
 * call goes on from there.  FST_BAD_INPUT: wrong axes, a file that is foreign or of another sweep, or one
 * damaged beyond repair; the file is left untouched.  FST_IO: full disk, no permission, another command at work
 * on the file, or the file deleted or renamed meanwhile.  FST_INTERRUPTED: from `progress`.  `counts` is up to
 * date whenever `progress` is told, and at the end.
 *
 * While this call is at work on a file, the same process must not open that file by itself: closing it would
 * end SQLite's locks.  Further calls of fst_sweep() and of the readers below for that file end with FST_IO.
 */
FST_API fst_status fst_sweep(const fst_params *params, const char *path, const fst_sweep_options *options,
                             fst_sweep_counts *counts, fst_error *error);

/* What fst_sweep_merge() made. */
typedef struct fst_sweep_merged {
    int64_t points, rows; /* of the grid, and of the new database */
    char missing[240];    /* the points without a row: "3, 7-12 and 5 more" */
    int damaged;          /* files of which rows are damaged, and were left out */
} fst_sweep_merged;

/* Join the shards of a sweep, whole or not, in a new database `out`, that of one sweep: the same fst_sweep() without
 * a shard goes on with it.  The files are only read; they may overlap.  FST_BAD_INPUT: `out` is there already; no
 * sweeps, or not of the same points under the same arithmetic, or refined ones; rows of a point that differ.  Then
 * nothing is written.  Where rows are damaged it is FST_BAD_INPUT too, but the others were merged, and `damaged` is
 * not 0. */
FST_API fst_status fst_sweep_merge(const char *const *paths, int count, const char *out,
                                   const fst_progress *progress, fst_sweep_merged *merged, fst_error *error);

/* The scaled unit of a key of the rows of a grid; "1" for a name or a pure number. */
FST_API const char *fst_sweep_key_unit(const fst_grid *grid, const char *key);

typedef enum { FST_EXPORTS(FST_ROW_ENUM) FST_EXPORT_COUNT } fst_export_format;

/* Write the rows of a sweep's database in the order of the points, as CSV with a line of column names; as JSON,
 * a list of objects with the keys of `run`; or as HDF5, a data set for each column.  They go to the file `out`
 * or, if that is NULL, to `stream` (not HDF5).  FST_BAD_INPUT may also mean that some rows are damaged: the
 * others are written all the same, and the sentence names the lost ones. */
FST_API fst_status fst_sweep_export(const char *path, fst_export_format format, const char *out, FILE *stream,
                                    const fst_progress *progress, fst_error *error);

/* Write chosen columns as CSV: the varied parameters and `keys` (count = 0: regime, mean_r, std_r,
 * mean_alpha_dot; one key "all": every column), in the wanted units, each name with its unit behind it:
 * "mean_r [mm]"; and `status`: done, missing where there is no row, or why the run failed.  Fails where rows are damaged. */
FST_API fst_status fst_sweep_export_keys(const char *path, const char *const *keys, int count,
                                         fst_shown_units units, const char *out, FILE *stream,
                                         const fst_progress *progress, fst_error *error);

/* Some keys of a sweep by point.  The value of key i at a point is values[i * fst_grid_points(grid) + point],
 * NAN where there is none; `regime` and `symmetry` have their numbers. */
typedef struct fst_sweep_table {
    fst_grid *grid;
    double *values;
    unsigned char *computed; /* by point: 1 where there is a row */
    int64_t rows;
    int refine;      /* as in the options of the last fst_sweep() */
    int64_t wanted;  /* the points that are to have a row, without refining: all, or those of a shard */
    fst_carry carry; /* as in the options of fst_sweep() */
    int at_work;     /* another process was at work on the sweep when it was read */
} fst_sweep_table;
FST_API fst_status fst_sweep_read(const char *path, const char *const *keys, int count, fst_sweep_table *table,
                                  fst_error *error);

/* The same, of at most FST_SWEEP_FILLED_KEYS keys, where a refined sweep has also values for the points
 * between: in a cell that was not refined, regimes and symmetries are those of its corners if these agree, and
 * numbers are interpolated between them.  Others stay NAN. */
enum { FST_SWEEP_FILLED_KEYS = 8 };
FST_API fst_status fst_sweep_read_filled(const char *path, const char *const *keys, int count,
                                         fst_sweep_table *table, fst_error *error);
FST_API void fst_sweep_table_free(fst_sweep_table *table);

/* Read only the grid; free it with fst_grid_free(). */
FST_API fst_status fst_sweep_read_grid(const char *path, fst_grid **grid, fst_error *error);

/* Which part of a sweep a figure shows, and how; all zeros: what suits it. */
#define FST_SWEEP_FIGURE_KEYS 8
typedef struct fst_sweep_figure {
    fst_figure_kind
        kind; /* FST_FIGURE_CURVES or FST_FIGURE_MAP; another: curves over one axis, and over two where one of
                             them has at most seven values, else a map */
    const char *keys
        [FST_SWEEP_FIGURE_KEYS]; /* NULL ends a shorter list, an empty one is chosen: mean r, its deviation, the
                                                mean angular velocity and the regime; of a map the regime */
    fst_shown_units
        units; /* as given: laboratory units where a varied parameter has one (Hz, mm), otherwise scaled */
    const char *at
        [FST_AXIS_LIMIT]; /* "KEY=VALUE": only the points where this axis has this value; NULL ends the list */
    const char *title;    /* NULL: made from what is shown */
    double size[2];       /* as in fst_chart */
} fst_sweep_figure;

/* Draw a sweep: over one axis curves of the keys; over two a map of one key, or of regimes where the key is `regime`, or a
 * curve for each value of the axis that has fewer.  An axis with logarithmic spacing is drawn logarithmically.
 * FST_BAD_INPUT: more than two axes, more than one key on a map, no points with such a value, or units that a varied
 * parameter changes.  NULL for options: all zeros. */
FST_API fst_status fst_figure_sweep(const char *path, const fst_sweep_figure *options, const char *out,
                                    fst_error *error);

/* Lay up to FST_CHARTS_OVER sweeps and branches over one parameter over each other, or as many trajectories, in one
 * figure, whose key says what differs between their scenes, or names the files where nothing does.  `trajectories` and
 * `sweeps` (NULL: the defaults) say what of each is shown, `observable` what of a branch (NULL: those keys of `sweeps` that
 * it has, or chosen).
 * FST_BAD_INPUT: files that have no axis in common, or the regime as a colour beside other keys. */
enum { FST_CHARTS_OVER = 8 };
FST_API fst_status fst_figure_over(const char *const *paths, int count, const fst_figure_options *trajectories,
                                   const fst_sweep_figure *sweeps, const char *observable, const char *out,
                                   fst_error *error);

/* Whether a file begins as a sweep's database does.  A file that cannot be opened does not; reading it says why.
 * FST_IO: reading it failed. */
FST_API fst_status fst_is_sweep(const char *path, int *is_sweep, fst_error *error);

/* ------------------------------------------------------------------ the critical speed */

/* Neighbouring runs with one outcome, from the first to the last. */
typedef struct fst_critical_stretch {
    double from, to;
    fst_regime regime;
    int runs;
} fst_critical_stretch;

/* The critical speed: the lowest drive from which on all runs that are decided, each from the scene's start, circle
 * against the magnet, for at least another tenth of the drive.  Values are those of `key`, in SI. */
typedef struct fst_critical {
    char key[64];
    int found;        /* 0: there is none in this range, because of `reason`; then `value` is NAN */
    char reason[160]; /* "" where it is found */
    double value,
        error;   /* half of what the runs on either side leave open, or the error of the special point */
    int special; /* the fst_special_type of the branch's point that it is; -1: of none, it is enclosed by runs */
    fst_regime below, above; /* the outcomes on either side */
    double
        until; /* the last run that circles against the magnet before one that does otherwise or is undecided;
                     NAN where not found */
    double parting,
        parting_error; /* up to here the bead goes with the magnet in all runs; NAN: in none, or in all */
    fst_critical_stretch *stretches; /* of all runs, in order */
    size_t stretch_count;
    int runs;
} fst_critical;

typedef struct fst_critical_options {
    const char
        *over; /* "drive.frequency=2Hz:30Hz:113", an axis of fst_grid_new() that is a range of the drive */
    double tolerance; /* relative width of a border; 1e-4 */
    const fst_progress *progress;
} fst_critical_options;
FST_API fst_critical_options fst_default_critical_options(void);

/* Find it by runs over the range, then by more about the border, and by the branch of counter-rotating orbits where the
 * friction is smooth.  FST_BAD_INPUT: no range of the drive, or a scene of several beads or a world.
 * FST_INTERRUPTED: the stretches are those of the runs that were done.  Free the result with fst_critical_free(), also
 * after a failure. */
FST_API fst_status fst_critical_find(const fst_params *params, const fst_critical_options *options,
                                     fst_critical *critical, fst_error *error);
FST_API void fst_critical_free(fst_critical *critical);
/* With FST_SHOWN_LAB or FST_SHOWN_SI every speed also in Hz: `value_hz`, ... */
FST_API char *fst_critical_json(const fst_params *params, const fst_critical *critical, fst_shown_units units);

/* ------------------------------------------------------------------ films */

typedef struct fst_film_options {
    uint32_t cookie;
    int width, height;            /* pixels, both even */
    double fps;                   /* frames a second */
    double from, to;              /* drive periods shown; NAN: everything */
    double seconds_per_turn;      /* seconds of film for a turn of the magnet */
    const char *colour;           /* the column that colours the trail; NULL: "slip" */
    fst_shown_units units;        /* of the scale of colours; as given: those in which the drive is given */
    const fst_progress *progress; /* NULL: nobody is told */
} fst_film_options;
/* 720 x 720 pixels, 30 frames a second, one second a turn. */
FST_API fst_film_options fst_default_film_options(void);

/* Make a film of a trajectory: the plate from above with the magnet turning beneath it, the bead with its poles
 * and surface marks, its trail, a view from the front, and a key of the poles and of the sense of rotation.
 * `out` ends in .mp4 or .gif, or is a folder for PNG frames.  FST_BAD_INPUT: an odd size, no samples in the
 * range, an unknown column.  FST_UNAVAILABLE: this build has no Cairo, or there is no ffmpeg; without ffmpeg
 * the frames are kept in a folder that the sentence names.
 */
FST_API fst_status fst_film(const fst_table *table, const char *out, const fst_film_options *options,
                            fst_error *error);

/* A film as a camera over the plate takes it.  Lengths are in m, times in s, angles in degrees. */
typedef struct fst_camera_options {
    uint32_t cookie;
    int width, height;        /* pixels, both even */
    double fps;               /* frames a second */
    double stored_fps;        /* what the film claims them to be; NAN: the truth */
    double from, to;          /* drive periods that are filmed; NAN: everything */
    double exposure, readout; /* of a row; from the first row to the last (a rolling shutter) */
    double noise;             /* deviation of a pixel, in gray levels of 255 */
    double uneven, flicker;   /* how much darker the darkest corner is; how much the lamps flicker: 0 to 1 */
    double tilt, side;        /* the camera's angle off the vertical; where it stands, from the x axis */
    double distance, plate;   /* from the plate's middle; the plate's diameter; NAN: what fits */
    int quality;              /* of the compression: 0, lossless, to 51 */
    int drop;                 /* every drop-th frame is lost; 0: none */
    uint64_t seed;            /* of the noise */
    const char *
        marks; /* a light coat with black marks on the bead: "half" (the northern half, and two dots on each half) or "dots" (a large
                          one on the north pole, a smaller one on the equator); NULL: none */
    const fst_progress *progress; /* NULL: nobody is told */
} fst_camera_options;
/* 1280 x 720 pixels, 240 frames a second exposed for 1 ms, 5 degrees of tilt, a readout of 3 ms, noise of 2
 * gray levels, light that falls by a fifth, a quality of 23. */
FST_API fst_camera_options fst_default_camera_options(void);

/* What such a film shows. */
typedef struct fst_camera_facts {
    int frames, lost;
    double plate, distance, square; /* m; at the corners of a square around the axis there are four marks */
    double scale;                   /* m a pixel in the middle */
    double marks[4][2]; /* pixels from the top left, in an order around the square; the first side is
                           along x */
} fst_camera_facts;

/* Film a trajectory: gray pictures of plate and bead, in .mp4, .mov, .gif or a folder of images, and beside
 * them the truth as a table (NULL: none): frame, true time of its beginning, where the bead was on the mean
 * over the exposure, and the pixel that saw it (columns from the left, rows from the bottom); of a bead with marks n,
 * W and the velocity of its lowest point too.  The arguments
 * fail as those of fst_film(). */
FST_API fst_status fst_camera_film(const fst_table *table, const char *out, const char *truth,
                                   const fst_camera_options *options, fst_camera_facts *facts,
                                   fst_error *error);

/* ------------------------------------------------------------------ programs of your own */

/* Write a file that appears whole or not at all: under a temporary name beside its place, synced, and renamed.
 * Without a text (NULL), only see whether it could be written. */
FST_API fst_status fst_file_write(const char *path, const char *text, size_t size, fst_error *error);

/* A text that is collected by printing into `stream`, whole or not at all.  (A stream of open_memstream() forgets
 * that memory ran out: its text may lack any part.)  Do not move the struct meanwhile. */
typedef struct fst_printed {
    FILE *stream;
    char *text, *buffer;
    size_t size, room;
    int failed; /* set it where a part cannot be made: then there is no text */
} fst_printed;

/* Begin; NULL: no memory.  Otherwise this returns the stream. */
FST_API FILE *fst_print_begin(fst_printed *printed);
/* Close the stream.  Returns the text, of printed->size bytes and a zero; free() it.  NULL: it failed, mostly for
 * want of memory. */
FST_API char *fst_print_end(fst_printed *printed);

/* Independent pieces of work, for several threads. */
typedef struct fst_work {
    void *user;
    int count;
    /* Do piece `index`.  Pieces may run at the same time and in any order.  If each writes only into its own
     * place, the results do not depend on the threads. */
    fst_status (*piece)(void *user, int index, fst_error *error);
    /* Told every 20 ms or more often, by the calling thread alone, which fraction of the pieces is done; NULL:
     * nobody is told.  A status other than FST_OK ends the work: no new piece begins.  A piece at work is not
     * broken off, so a long piece must ask by itself: */
    const fst_progress *progress;
    fst_progress *within; /* becomes what pieces may ask whether to go on, in any thread; NULL: they do not */
} fst_work;

/* Do all pieces on as many threads as this process has processors, and wait for them.  If a piece fails, no new
 * one begins; the status and error are those of the failed piece with the lowest index. */
FST_API fst_status fst_parallel(const fst_work *work, fst_error *error);

/* ------------------------------------------------------------------ the lab: a page with the same physics */

/* The longest address, and the longest value in it, with the zero behind. */
enum { FST_LAB_ADDRESS_SIZE = 8192, FST_LAB_VALUE_SIZE = 256 };

/* The address of the page festoon-lab.html, which lies beside this library or in share/festoon, with `params`
 * behind its "#": what differs from the default scene.  FST_UNAVAILABLE: the page was not built, or is of
 * another version.  FST_BAD_INPUT: the page cannot read the scene, because its magnet is a measured map. */
FST_API fst_status fst_lab_address(const fst_params *params, char address[FST_LAB_ADDRESS_SIZE],
                                   fst_error *error);

/* Open such an address in the desktop's browser, by xdg-open.  *opened is 0 where there is no desktop. */
FST_API fst_status fst_lab_open(const char *address, int *opened, fst_error *error);

/* "gnuplot yes, hdf5 yes, mpi no (...), ...": which optional parts this build and machine have, and what is missing
 * for the others.  Modules are loaded to find out, which takes some 0.05 s.  Returns `text`. */
enum { FST_COMPONENTS_SIZE = 2048 };
FST_API const char *fst_tools_components(char text[FST_COMPONENTS_SIZE]);

#ifdef __cplusplus
}
#endif

#include <festoon/fit.h>
#include <festoon/tracks.h>
#include <festoon/film_tracks.h>

#endif
