/* native.c - buffers, batches and progress of the Python module. */
#include "native.h"

#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* In the module that cffi makes: calls the object behind `handle`. */
extern fst_status pyf_tell_python(void *handle, double fraction, const char *what, fst_error *error);

const char *const pyf_figures = FST_WORDS(FST_FIGURES);
const char *const pyf_units = FST_WORDS(FST_SHOWN);
const char *const pyf_carries = FST_WORDS(FST_CARRIES);
const char *const pyf_stops = FST_WORDS(FST_STOPS);

/* ------------------------------------------------------------------ progress */

static fst_status interrupted(fst_error *error)
{
    error->code = FST_INTERRUPTED;
    error->where[0] = '\0';
    (void)snprintf(error->sentence, sizeof error->sentence, "interrupted");
    return FST_INTERRUPTED;
}

fst_status pyf_tell(void *user, double fraction, const char *what, fst_error *error)
{
    static const double pause = 0.03;
    pyf_watch *watch = user;
    struct timespec now;
    (void)clock_gettime(CLOCK_MONOTONIC, &now);
    const double seconds = (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
    if (seconds - watch->last < pause)
        return FST_OK;
    watch->last = seconds;
    return pyf_tell_python(watch->handle, fraction, what, error) == FST_OK ? FST_OK : interrupted(error);
}

/* ------------------------------------------------------------------ samples */

static fst_status no_memory(fst_error *error, size_t count)
{
    if (error) {
        error->code = FST_NO_MEMORY;
        (void)snprintf(error->where, sizeof error->where, "trajectory");
        (void)snprintf(error->sentence, sizeof error->sentence, "no memory for %zu samples", count);
    }
    return FST_NO_MEMORY;
}

/* An array with room for another element; NULL: no memory, and the old array stays. */
static void *with_room(void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return array;
    const size_t wanted = *room ? 2 * *room : 1024;
    void *longer = realloc(array, wanted * size);
    if (longer)
        *room = wanted;
    return longer;
}

fst_status pyf_take_sample(void *user, const fst_sample *sample, fst_error *error)
{
    pyf_samples *samples = user;
    if (samples->file)
        return fst_trajectory_append(samples->file, sample, error);
    const size_t columns = (size_t)fst_column_count();
    double *values = with_room(samples->values, samples->rows, &samples->room, columns * sizeof *values);
    if (!values)
        return no_memory(error, samples->rows + 1);
    samples->values = values;
    fst_column_values(sample, values + columns * samples->rows++);
    return FST_OK;
}

fst_status pyf_take_ramp_point(void *user, const fst_ramp_point *point, fst_error *error)
{
    pyf_samples *samples = user;
    fst_ramp_point *ramp =
        with_room(samples->ramp, samples->ramp_count, &samples->ramp_room, sizeof *samples->ramp);
    if (!ramp)
        return no_memory(error, samples->ramp_count + 1);
    samples->ramp = ramp;
    samples->ramp[samples->ramp_count++] = *point;
    return FST_OK;
}

void pyf_free(void *memory)
{
    free(memory);
}

/* ------------------------------------------------------------------ batches */

struct pyf_batch {
    const fst_grid *grid;
    fst_arithmetic arithmetic;
    int lanes;
    int64_t points;
    atomic_llong next, done;
    atomic_int stop;
    pyf_row *rows;
};

pyf_batch *pyf_batch_new(const fst_grid *grid, fst_arithmetic arithmetic, int lanes)
{
    pyf_batch *batch = calloc(1, sizeof *batch);
    if (!batch)
        return NULL;
    batch->grid = grid;
    batch->arithmetic = arithmetic;
    batch->lanes = lanes;
    batch->points = fst_grid_points(grid);
    batch->rows = calloc((size_t)batch->points, sizeof *batch->rows);
    if (!batch->rows) {
        free(batch);
        return NULL;
    }
    return batch;
}

void pyf_batch_free(pyf_batch *batch)
{
    if (!batch)
        return;
    for (int64_t i = 0; i < batch->points; ++i)
        free(batch->rows[i].error);
    free(batch->rows);
    free(batch);
}

int pyf_row_fail(pyf_row *row, const char *where, const char *sentence)
{
    row->error = calloc(1, sizeof *row->error);
    if (!row->error)
        return 0;
    row->error->code = (fst_status)row->status;
    (void)snprintf(row->error->where, sizeof row->error->where, "%s", where);
    (void)snprintf(row->error->sentence, sizeof row->error->sentence, "%s", sentence);
    return 1;
}

/* A failure of a run is what its row says; without memory for the sentence the row still has the status. */
static void keep(pyf_batch *batch, int64_t point, fst_status status, const fst_run_result *result,
                 const fst_error *error)
{
    pyf_row *row = &batch->rows[point];
    if (status == FST_INTERRUPTED)
        return;
    if (result)
        row->result = *result;
    row->status = (int)status;
    row->done = 1;
    if (status != FST_OK && error)
        (void)pyf_row_fail(row, error->where, error->sentence);
    (void)atomic_fetch_add(&batch->done, 1);
}

static int next_job(void *user, fst_row_job *job)
{
    pyf_batch *batch = user;
    while (!atomic_load(&batch->stop)) {
        const int64_t point = atomic_fetch_add(&batch->next, 1);
        if (point >= batch->points)
            return 0;
        fst_error error;
        const fst_status status = fst_grid_params(batch->grid, point, &job->params, &error);
        if (status == FST_OK) {
            job->point = point;
            job->has_start = 0;
            return 1;
        }
        keep(batch, point, status, NULL, &error);
    }
    return 0;
}

static int take_result(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                       const fst_error *error)
{
    keep(user, job->point, status, result, error);
    return 0;
}

static fst_status ask_stop(void *user, double fraction, const char *what, fst_error *error)
{
    (void)fraction;
    (void)what;
    pyf_batch *batch = user;
    return atomic_load_explicit(&batch->stop, memory_order_relaxed) ? interrupted(error) : FST_OK;
}

fst_status pyf_batch_work(pyf_batch *batch, fst_error *error)
{
    const fst_progress progress = {batch, ask_stop};
    const fst_row_work work = {.user = batch,
                               .arithmetic = batch->arithmetic,
                               .lanes = batch->lanes,
                               .next = next_job,
                               .done = take_result,
                               .progress = &progress};
    return fst_rows(&work, error);
}

void pyf_batch_stop(pyf_batch *batch)
{
    atomic_store(&batch->stop, 1);
}

int64_t pyf_batch_done(const pyf_batch *batch)
{
    return atomic_load(&batch->done);
}

pyf_row *pyf_batch_rows(pyf_batch *batch)
{
    return batch->rows;
}

/* ------------------------------------------------------------------ the field, and states */

void pyf_field(const fst_model *model, size_t count, const double *x, const double *y, double *b, double *grad)
{
    for (size_t i = 0; i < count; ++i) {
        double slopes[3][3];
        fst_field(model, x[i], y[i], b + 3 * i, slopes);
        memcpy(grad + 9 * i, slopes, sizeof slopes);
    }
}

void pyf_rhs(const fst_model *model, size_t count, const double *states, double *out)
{
    for (size_t i = 0; i < count; ++i)
        fst_rhs(model, states + i * FST_STATE_SIZE, out + i * FST_STATE_SIZE);
}

void pyf_jacobian(const fst_model *model, size_t count, const double *states, double *out)
{
    for (size_t i = 0; i < count; ++i) {
        double slopes[FST_STATE_SIZE][FST_STATE_SIZE];
        fst_jacobian(model, states + i * FST_STATE_SIZE, slopes, NULL);
        memcpy(out + i * FST_STATE_SIZE * FST_STATE_SIZE, slopes, sizeof slopes);
    }
}

void pyf_observe(const fst_model *model, size_t count, const double *states, fst_observation *out)
{
    for (size_t i = 0; i < count; ++i)
        out[i] = fst_observe(model, states + i * FST_STATE_SIZE);
}
