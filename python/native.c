/* native.c - buffers, batches and progress of the Python module. */
#include "native.h"

#include <math.h>
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

static fst_status no_memory(fst_error *error, const char *where, int64_t count, const char *what)
{
    if (error) {
        error->code = FST_NO_MEMORY;
        (void)snprintf(error->where, sizeof error->where, "%s", where);
        (void)snprintf(error->sentence, sizeof error->sentence, "no memory for %lld %s", (long long)count,
                       what);
    }
    return FST_NO_MEMORY;
}

/* An array with room for another element; NULL: no memory, and the old array stays. */
static void *with_room(void *array, size_t count, size_t *room, size_t size)
{
    if (count < *room)
        return array;
    const size_t wanted = *room ? 2 * *room : 64;
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
        return no_memory(error, "trajectory", (int64_t)samples->rows + 1, "samples");
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
        return no_memory(error, "ramp", (int64_t)samples->ramp_count + 1, "points");
    samples->ramp = ramp;
    samples->ramp[samples->ramp_count++] = *point;
    return FST_OK;
}

fst_status pyf_take_beads_sample(void *user, const fst_beads_sample *sample, fst_error *error)
{
    pyf_bead_samples *samples = user;
    if (samples->file)
        return fst_beads_trajectory_append(samples->file, sample, error);
    const size_t beads = (size_t)sample->count, states = beads * FST_BEAD_NUMBERS, columns = 2 + states + beads;
    double *values = with_room(samples->values, samples->rows, &samples->room, columns * sizeof *values);
    if (!values)
        return no_memory(error, "trajectory", (int64_t)samples->rows + 1, "samples");
    samples->values = values;
    double *row = values + columns * samples->rows++, *loads = row + 2 + states;
    row[0] = sample->t;
    row[1] = sample->drive_turns;
    memcpy(row + 2, sample->states, states * sizeof *row);
    for (size_t i = 0; i < beads; ++i)
        loads[i] = NAN;
    for (int k = 0; k < sample->touch_count; ++k)
        if (sample->touches[k].beads[1] < 0)
            loads[sample->touches[k].beads[0]] = sample->touches[k].force;
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
    atomic_int stop, starved;
    const fst_progress *progress;
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

/* A failure of a run is what its row says; without memory for the sentence the row still has the status.  A run that
 * gets no memory is not a row, because the same run has a row on a machine with more memory. */
static void keep(pyf_batch *batch, int64_t point, fst_status status, const fst_run_result *result,
                 const fst_error *error)
{
    pyf_row *row = &batch->rows[point];
    if (status == FST_NO_MEMORY) {
        atomic_store(&batch->starved, 1);
        atomic_store(&batch->stop, 1);
    }
    if (status == FST_INTERRUPTED || status == FST_NO_MEMORY)
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

/* What one thread does: runs as long as there are some. */
static fst_status work(void *user, int index, fst_error *error)
{
    pyf_batch *batch = user;
    const fst_progress progress = {batch, ask_stop};
    (void)index;
    const fst_row_work rows = {.user = batch,
                               .arithmetic = batch->arithmetic,
                               .lanes = batch->lanes,
                               .next = next_job,
                               .done = take_result,
                               .progress = &progress};
    const fst_status status = fst_rows(&rows, error);
    if (status != FST_OK)
        atomic_store(&batch->stop, 1);
    if (atomic_load(&batch->starved))
        return no_memory(error, "sweep", batch->points, "runs");
    return status == FST_INTERRUPTED ? FST_OK : status; /* it was told to stop, and who told it says why */
}

/* How far the runs are, for the thread that waits for them. */
static fst_status tell(void *user, double fraction, const char *what, fst_error *error)
{
    pyf_batch *batch = user;
    char text[64];
    const long long done = atomic_load(&batch->done), points = (long long)batch->points;
    (void)fraction;
    (void)what;
    (void)snprintf(text, sizeof text, "%lld of %lld runs", done, points);
    const fst_status status =
        batch->progress->tell(batch->progress->user, (double)done / (double)points, text, error);
    if (status != FST_OK)
        atomic_store(&batch->stop, 1);
    return status;
}

fst_status pyf_batch_work(pyf_batch *batch, int threads, const fst_progress *progress, fst_error *error)
{
    const fst_progress told = {batch, tell};
    const fst_work all = {.user = batch, .count = threads, .piece = work, .progress = &told};
    batch->progress = progress;
    return fst_parallel(&all, error);
}

pyf_row *pyf_batch_rows(pyf_batch *batch)
{
    return batch->rows;
}

fst_status pyf_grid_scales(const fst_grid *grid, const int64_t *points, size_t count, fst_scales *scales,
                           fst_error *error)
{
    fst_status status = FST_OK;
    for (size_t i = 0; i < count && status == FST_OK; ++i) {
        fst_params params;
        status = fst_grid_params(grid, points[i], &params, error);
        if (status == FST_OK)
            scales[i] = fst_scales_of(&params);
    }
    return status;
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
