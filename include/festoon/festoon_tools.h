/* festoon_tools.h - scenes, files, figures and reports around festoon.h.
 *
 * The library libfestoon-tools holds what needs files, other libraries or other programs; programs that embed
 * the physics alone need festoon.h and libfestoon only.
 */
#ifndef FESTOON_FESTOON_TOOLS_H
#define FESTOON_FESTOON_TOOLS_H

#include <stdio.h>

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ scenes */

#define FST_SCENE_SIZE_LIMIT (1024 * 1024) /* bytes */

/* Read a YAML scene over `params` (usually the defaults): groups of keys as in params.def, values with
 * optional units.  FST_BAD_INPUT (error->where is "FILE:LINE"): unknown key (with the nearest valid one), wrong
 * unit, out of range, a key or quantity given twice, an alias or anchor, more than one document, no text, over
 * FST_SCENE_SIZE_LIMIT, a directory, a missing file.  `params` is unchanged on failure. */
FST_API fst_status fst_scene_read(const char *path, fst_params *params, fst_error *error);

/* The same from memory; `name` stands for the path in messages. */
FST_API fst_status fst_scene_parse(const char *text, size_t size, const char *name, fst_params *params,
                                   fst_error *error);

/* The scene as YAML text, with the docs and units as comments where `commented`; free() it.  NULL: no memory.
 * Reading it back gives the same parameters, bit by bit. */
FST_API char *fst_scene_text(const fst_params *params, int commented);

/* Write that text to a file.  FST_BAD_INPUT where the file is there already and `overwrite` is 0. */
FST_API fst_status fst_scene_write(const char *path, const fst_params *params, int commented, int overwrite,
                                   fst_error *error);

/* ------------------------------------------------------------------ JSON */

/* One JSON document each, 17 significant digits, undefined numbers null, a newline at the end; free() it.
 * NULL: no memory.  The keys are those of run.def and of params.def. */
FST_API char *fst_run_json(const fst_params *params, const fst_run_result *result, const fst_ramp_point *ramp,
                           size_t ramp_count);
FST_API char *fst_schema_json(void);

/* The scene in SI and its scaled groups: `scene`, `groups`. */
FST_API char *fst_scene_json(const fst_params *params);

/* The field at (x, y): `x`, `y`, `b` (3), `grad` (3 x 3), in the magnet's frame, scaled. */
FST_API char *fst_field_json(const fst_model *model, double x, double y);

/* `orbit`; `others` (NULL: none asked for) are further patterns with the same number of festoons. */
FST_API char *fst_orbit_json(const fst_params *params, const fst_orbit *orbit, const fst_orbit *others,
                             size_t count);
FST_API char *fst_locked_json(const fst_params *params, double omega, const fst_locked_list *list);
FST_API char *fst_branch_json(const fst_params *params, const fst_branch *branch);
FST_API char *fst_lyapunov_json(const fst_params *params, const fst_lyapunov *lyapunov);

/* The JSON of a branch as a file, whole or not at all. */
FST_API fst_status fst_branch_write(const char *path, const fst_params *params, const fst_branch *branch,
                                    fst_error *error);

/* A branch read back whole from the JSON above (crossings after the other special points).  FST_BAD_INPUT: the
 * file is none, or a member of it is not what it may be: which, and what it is, stands in the sentence. FST_IO:
 * the disk failed. */
FST_API fst_status fst_branch_read(const char *path, fst_branch *branch, fst_error *error);

/* Pairs (parameter, observable) from a file of one or more documents that `run --json` printed; free(*dots). */
FST_API fst_status fst_run_dots_read(const char *path, const char *key, const char *observable, double **dots,
                                     size_t *count, fst_error *error);

/* ------------------------------------------------------------------ trajectories */

/* A file that a run streams into; `format` by the ending: .h5 (HDF5, with the scene and the result inside) or
 * .csv (a commented head with the scene, then a line of column names with units).  It is written beside its
 * place as a temporary file and renamed by fst_trajectory_close(). */
typedef struct fst_trajectory fst_trajectory;
FST_API fst_status fst_trajectory_create(const char *path, const fst_params *params,
                                         fst_trajectory **trajectory, fst_error *error);
/* FST_BAD_INPUT: a number of the sample is not finite; such a file could not be read back. */
FST_API fst_status fst_trajectory_append(fst_trajectory *trajectory, const fst_sample *sample,
                                         fst_error *error);
/* Finish the file: `result` (may be NULL) is stored in it; `complete` is 0 for an interrupted run, whose
 * file then says complete = false. */
FST_API fst_status fst_trajectory_close(fst_trajectory *trajectory, const fst_run_result *result, int complete,
                                        fst_error *error);
/* Give up: removes the temporary file. */
FST_API void fst_trajectory_discard(fst_trajectory *trajectory);

/* The columns of a trajectory, in order: name, unit, doc. */
typedef struct fst_column_info {
    const char *name, *unit, *doc;
} fst_column_info;
FST_API int fst_column_count(void);
FST_API const fst_column_info *fst_column_at(int index);

/* A trajectory read back from .h5 or .csv: columns[i][row] in the order of fst_column_at(). */
typedef struct fst_table {
    size_t rows;
    double **columns;
    fst_params params; /* the scene it was made by */
    int complete;
} fst_table;
/* FST_BAD_INPUT: no trajectory, cut off, damaged, or with a number that is not finite.  FST_NO_MEMORY: HDF5
 * files are read into memory as a whole, if they take no more than half of it. */
FST_API fst_status fst_trajectory_read(const char *path, fst_table *table, fst_error *error);
FST_API void fst_table_free(fst_table *table);

/* ------------------------------------------------------------------ figures */

/* What a figure of a trajectory shows. */
typedef enum {
    FST_FIGURE_PATH,        /* the lab path coloured by a quantity, arrows of the horizontal moment */
    FST_FIGURE_LOCAL_N,     /* the path of n in the local frame (r, alpha, z) */
    FST_FIGURE_RADIUS_FIELD /* r and |B| against Phi over half a revolution of the magnet */
} fst_figure_kind;

typedef struct fst_figure_options {
    uint32_t cookie;
    fst_figure_kind kind;
    const char *colour; /* a column's name: "n_z", "slip", "angle", ... */
    int arrows;         /* draw arrows of the horizontal moment */
    int inset;          /* the path of the moment in the local frame as an inset of the path's figure */
    double from, to;    /* drive periods shown; NAN: from the discard, as long as a good picture wants */
    double zoom[4];     /* x0 x1 y0 y1 in mm; NAN: all */
    const char *title;  /* NULL: made from the scene */
} fst_figure_options;
FST_API fst_figure_options fst_default_figure_options(void);

/* Draw a trajectory to OUT.(svg|pdf|png) with gnuplot; the script OUT.gp and the data OUT.dat stay beside
 * it, and running gnuplot on the script draws the figure again.  FST_UNAVAILABLE: no gnuplot (the sentence
 * names the package). */
FST_API fst_status fst_figure_trajectory(const fst_table *table, const char *out,
                                         const fst_figure_options *options, fst_error *error);

/* Draw a branch: `observable` ("mean_r", "mean_alpha_dot", "mean_nz", "festoons", "min_r", "period") over the
 * parameter, stable parts solid, unstable ones dashed, special points labelled, `dots` (pairs of abscissa and
 * ordinate, may be NULL) on top; or, with "multipliers", the multipliers in the complex plane with the unit
 * circle.  FST_BAD_INPUT: the branch has no points. */
FST_API fst_status fst_figure_branch(const fst_branch *branch, const char *observable, const double *dots,
                                     size_t dot_count, const char *out, fst_error *error);

/* The map of the magnet's field on the plane of the bead's centre (the paper's Fig. 5). */
FST_API fst_status fst_figure_field(const fst_params *params, const char *out, fst_error *error);

/* ------------------------------------------------------------------ sweeps */

/* Whether a point starts from the end of its neighbour along the first axis, and in which direction of its
 * values. */
typedef enum { FST_CARRY_NO, FST_CARRY_UP, FST_CARRY_DOWN } fst_carry;

/* How far a sweep is, or how it ended. */
typedef struct fst_sweep_counts {
    int64_t points, there; /* of the grid; with a row */
    int64_t added, failed; /* rows added by this call; of these, runs that failed */
    double seconds;        /* since the call */
    double processor_seconds,
        journal_seconds; /* of this process; of these, of the thread that keeps the database */
    int rank, ranks;     /* of this process among those of an MPI job: only rank 0 counts; 0 of 1 without */
    /* The database was found damaged: its sound rows were kept, those that are known to be lost are computed
     * again, and the damaged file lies beside it as FILE.damaged. */
    int repaired;
    int64_t lost;
} fst_sweep_counts;

typedef struct fst_sweep_options {
    uint32_t cookie;
    const char *const *axes; /* as for fst_grid_new() */
    int axis_count;
    uint64_t seed;
    fst_carry carry;
    fst_arithmetic arithmetic; /* the fastest that the processor has, unless set */
    int threads;               /* 0: as many as there are processors */
    int lanes;                 /* runs side by side on a thread, 1, 4 or 8; 0: as many as the processor likes */
    /* Share the points with the other processes that mpirun (Open MPI) or srun --mpi=pmix started with this
     * one; all make the same call, rank 0 alone touches the database, and what fails is told by rank 0: the
     * error of the others has the code only.  0: work alone, whoever started this process. */
    int with_ranks;
    /* Told every tenth of a second or so (NULL: nobody is told), after the counts were brought up to date.  A
     * status other than FST_OK ends the sweep; the rows that are done are kept. */
    const fst_progress *progress;
    /* Seconds of work on a run after which its state is kept in the database, so that killed it goes on from
     * there: 3, unless set.  With more than 8 threads in all ranks, so many times more. */
    double checkpoint_seconds;
} fst_sweep_options;
FST_API fst_sweep_options fst_default_sweep_options(void);

/* Run every point of a grid that has no row yet in the database `path` (made if missing), and add the rows as
 * they come. A run that fails, or whose bead leaves the plate, is a row too.  Rows depend on nothing but their
 * parameters and the form of arithmetic; killed at any moment, the file keeps what was committed, and the same
 * call goes on. FST_BAD_INPUT: axes; a foreign or differently made file, or one that is damaged beyond repair,
 * which is left untouched.  FST_IO: full disk, no permission; another command is at work on the file; it was
 * deleted or renamed under way.  FST_INTERRUPTED: from `progress`.
 * `counts` is up to date whenever `progress` is told, and at the end.
 *
 * While this call is at work on a file, the same process must not open that file by itself: closing it would
 * end SQLite's locks.  Further calls of fst_sweep() and of the readers below for that file end with FST_IO. */
FST_API fst_status fst_sweep(const fst_params *params, const char *path, const fst_sweep_options *options,
                             fst_sweep_counts *counts, fst_error *error);

typedef enum { FST_EXPORT_CSV, FST_EXPORT_JSON, FST_EXPORT_HDF5 } fst_export_format;

/* Write the rows of a sweep's database in the order of the points: CSV with a line of column names; JSON, a
 * list of objects with the keys of `run`; HDF5, a data set a column.  To the file `out`, or, if that is NULL,
 * to `stream` (not HDF5).  FST_BAD_INPUT may also mean that some rows are damaged: the others are written all
 * the same, and the sentence names the lost ones. */
FST_API fst_status fst_sweep_export(const char *path, fst_export_format format, const char *out, FILE *stream,
                                    fst_error *error);

/* Some keys of a sweep by point: the value of key i at a point is values[i * fst_grid_points(grid) + point],
 * NAN where there is none; `regime` and `symmetry` by their numbers. */
typedef struct fst_sweep_table {
    fst_grid *grid;
    double *values;
} fst_sweep_table;
FST_API fst_status fst_sweep_read(const char *path, const char *const *keys, int count, fst_sweep_table *table,
                                  fst_error *error);
FST_API void fst_sweep_table_free(fst_sweep_table *table);

/* The grid alone, which fst_grid_free() frees. */
FST_API fst_status fst_sweep_read_grid(const char *path, fst_grid **grid, fst_error *error);

/* The units that a sweep's figure has on its axes: those of the parameters that were varied (lengths in mm);
 * those of the laboratory (Hz, mm, mm/s, 1/s, s); or scaled ones (drive omega, lengths in l). */
typedef enum { FST_SHOWN_AS_GIVEN, FST_SHOWN_LAB, FST_SHOWN_SCALED } fst_shown_units;

/* Draw a sweep: over one axis curves of the keys, over two a map of the one key, of regimes where it is
 * `regime`.  With count = 0 the keys are chosen: mean r and its deviation, the mean angular velocity and the
 * regime over one axis, the regime over two.  Logarithmic axes are drawn so.  FST_BAD_INPUT: more than two
 * axes, more than one key on a map, units that a varied parameter changes. */
FST_API fst_status fst_figure_sweep(const char *path, const char *const *keys, int count, fst_shown_units units,
                                    const char *out, fst_error *error);

/* Whether a file begins like a sweep's database, as any database of SQLite does; fst_sweep_read_grid() tells
 * whether it is one. */
FST_API int fst_is_sweep(const char *path);

/* ------------------------------------------------------------------ films */

typedef struct fst_film_options {
    uint32_t cookie;
    int width, height;            /* pixels, both even */
    double fps;                   /* frames a second */
    double from, to;              /* drive periods shown; NAN: all there is */
    double seconds_per_turn;      /* of film for a turn of the magnet */
    const char *colour;           /* the column that colours the trail; NULL: "slip" */
    const fst_progress *progress; /* NULL: nobody is told */
} fst_film_options;
/* 720 x 720 pixels, 30 frames a second, one second a turn. */
FST_API fst_film_options fst_default_film_options(void);

/* Make a film of a trajectory: the plate from above with the magnet turning beneath it, the bead with its poles
 * and surface marks, its trail, and a view from the front.  `out` ends in .mp4 or .gif, or is a folder for PNG
 * frames.  FST_BAD_INPUT: an odd size, no samples there, an unknown column; FST_UNAVAILABLE: no Cairo in this
 * build, or no ffmpeg, and then the frames are kept in a folder that the sentence names. */
FST_API fst_status fst_film(const fst_table *table, const char *out, const fst_film_options *options,
                            fst_error *error);

/* ------------------------------------------------------------------ the paper */

typedef struct fst_paper_options {
    uint32_t cookie;
    int reduced;      /* fewer points and shorter runs, for tests */
    int starts;       /* of the search for a paramagnetic bead that counter-rotates; 0: as usual */
    int films;        /* the supplement's two films as well, film_0215.mp4 and film_04.mp4 */
    const char *only; /* if not NULL: the one statement to compute, by its id in paper.json */
    char **summary; /* if not NULL: set to Table 1 and a count of the verdicts as text, or to the one statement
                       as JSON; free() it */
    const fst_progress *progress; /* NULL: nobody is told; `what` names the stage */
} fst_paper_options;
FST_API fst_paper_options fst_default_paper_options(void);

/* Compute what the paper shows, by both dynamics, and write paper.json, the figures and report.html into
 * `directory` (made if missing).  After an interruption or a failure on the way they hold what was done until
 * then, and say "complete": false.  With `only` no more is computed than that statement needs, nothing is
 * written, and `directory` may be NULL. */
FST_API fst_status fst_paper(const char *directory, const fst_paper_options *options, fst_error *error);

/* The rules of the verdicts and the list of the paper's statements with their criteria, as Markdown; free() it,
 * NULL: no memory. */
FST_API char *fst_paper_statements_text(void);

/* "gnuplot yes, hdf5 yes, ...": the optional parts and whether this build and machine have them. */
FST_API const char *fst_tools_components(void);

#ifdef __cplusplus
}
#endif
#endif
