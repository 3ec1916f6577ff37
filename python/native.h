/* native.h - the part of the Python module that is written in C, because Python is never in the inner loop: a
 * buffer of samples, a batch of runs, a tell() that seldom bothers Python, the field at many points.
 */
#ifndef FESTOON_PYTHON_NATIVE_H
#define FESTOON_PYTHON_NATIVE_H

#include <festoon/bead_files.h>
#include <festoon/festoon_tools.h>

/* The names of lists.def for which the library has no function, "one|two|...". */
extern const char *const pyf_figures, *const pyf_units, *const pyf_carries, *const pyf_stops;

/* A tell() that calls Python at most every few hundredths of a second.  `last` begins with 0. */
typedef struct pyf_watch {
    double last; /* when Python was called, s */
    void *handle;
} pyf_watch;
fst_status pyf_tell(void *watch, double fraction, const char *what, fst_error *error);

/* What a run leaves: rows of all columns, ramp points, and the file (NULL: none) into which samples go
 * instead.  Begin with {0}; the arrays are free()d one by one, by pyf_free(). */
typedef struct pyf_samples {
    double *values;
    size_t rows, room;
    fst_ramp_point *ramp;
    size_t ramp_count, ramp_room;
    fst_trajectory *file;
} pyf_samples;
fst_status pyf_take_sample(void *samples, const fst_sample *sample, fst_error *error);
fst_status pyf_take_ramp_point(void *samples, const fst_ramp_point *point, fst_error *error);
void pyf_free(void *memory);

/* The same of several beads: rows of t, drive_turns, the twelve numbers of each bead, and the load of each, NAN in the
 * air. */
typedef struct pyf_bead_samples {
    double *values;
    size_t rows, room;
    fst_beads_trajectory *file;
} pyf_bead_samples;
fst_status pyf_take_beads_sample(void *samples, const fst_beads_sample *sample, fst_error *error);

/* A row of a batch; all zeros as long as the run is not done, so that memory is not touched before it is
 * needed.
 */
typedef struct pyf_row {
    fst_run_result result;
    int done, status; /* an fst_status */
    fst_error *error; /* of a run that failed, otherwise NULL */
} pyf_row;

/* The runs of a grid, done by pyf_batch_work() in so many threads, as far as there are processors; `progress` is told by
 * the calling one.  The grid must live as long.  pyf_batch_new() gives NULL where there is no memory. */
typedef struct pyf_batch pyf_batch;
pyf_batch *pyf_batch_new(const fst_grid *grid, fst_arithmetic arithmetic, int lanes);
void pyf_batch_free(pyf_batch *batch);
fst_status pyf_batch_work(pyf_batch *batch, int threads, const fst_progress *progress, fst_error *error);
pyf_row *pyf_batch_rows(pyf_batch *batch);

/* Keep the error of a row that failed; 0: no memory. */
int pyf_row_fail(pyf_row *row, const char *where, const char *sentence);

/* The scales of these points of a grid. */
fst_status pyf_grid_scales(const fst_grid *grid, const int64_t *points, size_t count, fst_scales *scales,
                           fst_error *error);

/* The field at `count` points: 3 numbers of b and 9 of grad for each. */
void pyf_field(const fst_model *model, size_t count, const double *x, const double *y, double *b, double *grad);

/* fst_rhs(), fst_jacobian() and fst_observe() of `count` states, one after the other. */
void pyf_rhs(const fst_model *model, size_t count, const double *states, double *out);
void pyf_jacobian(const fst_model *model, size_t count, const double *states, double *out);
void pyf_observe(const fst_model *model, size_t count, const double *states, fst_observation *out);

#endif
