/* rows.h - many runs at once: grids of parameters, and the runs of their points side by side in the lanes of
 * the processor; festoon.h includes it.
 *
 * festoon_tools.h keeps the rows of a grid in a database (fst_sweep).
 */
#ifndef FESTOON_ROWS_H
#define FESTOON_ROWS_H

#include <festoon/festoon.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------ grids: the points of a sweep */

#define FST_AXIS_LIMIT 8
typedef struct fst_grid fst_grid;

/* A grid: the points over the parameters `base` along `count` axes.  An axis is written KEY=LO:HI:COUNT
 * (evenly, both ends included), KEY=LO:HI:COUNT:log, KEY=A,B,C (a list, also of choices), or
 * KEY=LO:HI:random:COUNT (evenly distributed, drawn from `seed`); values may carry units.  Axes multiply, and
 * the last one runs fastest; random axes are drawn together and must have the same count.  FST_BAD_INPUT:
 * unknown key, wrong unit, out of range, or none of these forms. */
FST_API fst_status fst_grid_new(const fst_params *base, const char *const *axes, int count, uint64_t seed,
                                fst_grid **grid, fst_error *error);
FST_API void fst_grid_free(fst_grid *grid);

/* What the rows of a sweep over a grid tell: runs of a bead on the plate, which fst_rows() does too; runs of the beads
 * that the scene lists; runs where a point has a world (fst_key_of_world()), so that a bead needs three dimensions; or,
 * asked for, where a bead floats (fst_levitation_find() of beads.h). */
typedef enum { FST_ROWS_OF_RUNS, FST_ROWS_OF_BEADS, FST_ROWS_OF_WORLDS, FST_ROWS_OF_LEVITATION } fst_row_kind;
FST_API fst_row_kind fst_grid_row_kind(const fst_grid *grid);

/* Ask for the last.  FST_BAD_INPUT: it is one of several beads, or has a plate. */
FST_API fst_status fst_grid_ask_levitation(fst_grid *grid, fst_error *error);

FST_API int64_t fst_grid_points(const fst_grid *grid);
FST_API int fst_grid_axis_count(const fst_grid *grid);
FST_API const fst_params *fst_grid_base(const fst_grid *grid);

/* Of an axis: the parameter's key, the text from which it was made, its number of values, and the distance in
 * points from one value to the next. */
FST_API const char *fst_grid_key(const fst_grid *grid, int axis);
FST_API const char *fst_grid_axis_text(const fst_grid *grid, int axis);
FST_API int64_t fst_grid_axis_points(const fst_grid *grid, int axis);
FST_API int64_t fst_grid_axis_stride(const fst_grid *grid, int axis);

/* How the values of an axis are spaced. */
typedef enum { FST_SPACING_LINEAR, FST_SPACING_LOG, FST_SPACING_LIST, FST_SPACING_RANDOM } fst_spacing;
FST_API fst_spacing fst_grid_axis_spacing(const fst_grid *grid, int axis);

/* The value of an axis at a point, in SI (of a choice: its index). */
FST_API double fst_grid_value(const fst_grid *grid, int axis, int64_t point);

/* The parameters of a point. */
FST_API fst_status fst_grid_params(const fst_grid *grid, int64_t point, fst_params *params, fst_error *error);

/* What a grid can hardly mean: 0, or 1 with a sentence.  Beads of no material, and parts that overlap only where they
 * are varied, for which up to 256 points are looked at; axes along which nothing or only units change (fst_params_changes());
 * axes that take back what the scene gives (fst_params_takes_back()). */
FST_API int fst_grid_contradiction(const fst_grid *grid, char *sentence, size_t size);
FST_API int fst_grid_idle_axes(const fst_grid *grid, char *sentence, size_t size);
FST_API int fst_grid_followers(const fst_grid *grid, char *sentence, size_t size);

/* ------------------------------------------------------------------ rows: many runs at once */

/* The forms of arithmetic: which operations a step is made of.  Within one form the bits of a result depend on
 * its parameters alone, whatever runs beside it.  The portable form (+ - * / sqrt, nothing fused) has the bits
 * of fst_run() on every machine. */
typedef enum { FST_ARITHMETICS(FST_ROW_ENUM) FST_ARITHMETIC_COUNT } fst_arithmetic;
FST_API const char *fst_arithmetic_name(fst_arithmetic arithmetic);

/* The fastest form that this processor can do. */
FST_API fst_arithmetic fst_best_arithmetic(void);

/* A run to be done: its parameters and, if `has_start`, the state from which it starts instead of start.*. */
typedef struct fst_row_job {
    int64_t point;
    fst_params params;
    int has_start;
    double start[FST_STATE_SIZE];
} fst_row_job;

enum { FST_JOBS_LATER = -1 };

/* Where runs come from and where their results go. */
typedef struct fst_row_work {
    void *user;
    fst_arithmetic arithmetic;
    int lanes; /* runs side by side: 1, 4 or 8; 0: as many as suit the processor */
    /* Fill in the next job and return 1; return 0 where there is none, and FST_JOBS_LATER where some may come
     * when others are done.  fst_rows() then goes on with the runs that it has, and asks again; it returns when
     * it has none, and may be called again. */
    int (*next)(void *user, fst_row_job *job);
    /* Take a result; for a run that failed `status` and `error` say why.  Return 1 after filling in the job
     * that is to follow at once, otherwise 0. */
    int (*done)(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                const fst_error *error);
    /* Asked often, in each thread that works on this source, by a fraction of 0: only the source knows how much
     * work there is.  NULL: nobody is asked. */
    const fst_progress *progress;
} fst_row_work;

/* Do jobs in the calling thread until there are none.  Several threads may work on one source, each with a call
 * of its own.  FST_UNAVAILABLE: this processor cannot do the arithmetic; any other status: progress said so. */
FST_API fst_status fst_rows(const fst_row_work *work, fst_error *error);

/* Where images of unfinished runs are kept, so that another process can go on with them.  An image is bytes
 * that only this build can read, in the same arithmetic; a run that goes on from it ends with the same bits as
 * one that was never broken off. */
typedef struct fst_row_images {
    void *user;
    double seconds; /* seconds of work after which a run is saved, again and again; all are saved when the
                       work is to end */
    /* Take a copy of the image of an unfinished job. */
    void (*save)(void *user, const fst_row_job *job, const void *image, size_t size);
    /* The image of a job that begins, from malloc(), or NULL.  An image that this build cannot read
     * is ignored. */
    void *(*find)(void *user, const fst_row_job *job, size_t *size);
} fst_row_images;

/* fst_rows() with images (NULL: without). */
FST_API fst_status fst_rows_with_images(const fst_row_work *work, const fst_row_images *images,
                                        fst_error *error);

#ifdef __cplusplus
}
#endif

#endif
