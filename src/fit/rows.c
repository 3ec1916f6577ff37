/* rows.c - the model at the frequencies of a table.
 *
 * Each row keeps the orbit of the parameters at which the search stands, and how that orbit changes along each
 * coordinate.  From both the orbit at a trial is guessed, and Newton's method is there in one to three steps.
 * Where that fails (the orbit has lost its stability, or the trial is far away) the bead is followed from
 * start.* as `fst_orbit_find()` does; where that finds no orbit either, a run shows what the bead does, as long as
 * this row never had an orbit: then the points are perhaps those of a locked bead.
 *
 * Rows are independent, and each depends on its own past alone.  So they are computed on all processors, and
 * the result does not depend on how many there are.
 */
#include "fit/rows.h"

#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"

/* Orbits are wanted to 1e-9, a millionth of what films tell. */
#define ORBIT_TOLERANCE 1e-10

/* Steps of the coordinates for derivatives; runs without an orbit are less exact. */
#define ORBIT_STEP 5e-5
#define RUN_STEP 1e-2

#define PERIODS_OF_ANOTHER 100.0

fst_status fit_rows_begin(fit_rows *rows, const fit_space *space, const double *frequencies, int count,
                          const fst_progress *progress, fst_error *error)
{
    *rows = (fit_rows){.space = space, .count = count, .progress = progress};
    rows->rows = calloc((size_t)count, sizeof *rows->rows);
    if (!rows->rows)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    for (int i = 0; i < count; ++i)
        rows->rows[i].frequency = frequencies[i];
    return FST_OK;
}

void fit_rows_free(fit_rows *rows)
{
    free(rows->rows);
    rows->rows = NULL;
}

/* ------------------------------------------------------------------ one value */

/* The table's sign: a magnet that turns clockwise, and the bead with it, is the mirror image of one that turns
 * counter-clockwise (PHYSICS, symmetries: M). */
static fst_status take_means(const fst_run_result *means, const fst_params *params, double sense,
                             fit_value *out, fst_error *error)
{
    fst_model *model = NULL;
    const fst_status status = fst_model_new(params, &model, error);
    if (status != FST_OK)
        return status;
    const fst_groups groups = fst_model_groups(model);
    fst_model_free(model);
    out->value[FST_MEASURED_MEAN_R] = means->mean_r * groups.length_unit;
    out->value[FST_MEASURED_STD_R] = means->std_r * groups.length_unit;
    out->value[FST_MEASURED_BEAD_FREQUENCY] = sense * means->mean_alpha_dot / (FST_TWO_PI * groups.time_unit);
    return FST_OK;
}

/* Whether a status says nothing of the parameters, so that the search cannot go on. */
static int ends_the_search(fst_status status)
{
    return status == FST_INTERRUPTED || status == FST_UNAVAILABLE || status == FST_NO_MEMORY;
}

static int is_finite(const fit_value *v)
{
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        if (!isfinite(v->value[q]))
            return 0;
    return 1;
}

/* The orbit at u as it is to be expected from the kept one. */
static void guess_orbit(const fit_rows *rows, const fit_row *row, const double *u, fst_orbit *guess)
{
    *guess = row->last.orbit;
    for (int k = 0; k < rows->space->count && row->has_slopes; ++k) {
        const double step = u[k] - row->at[k];
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            guess->state[i] += step * row->state_slope[k][i];
        guess->means.period += step * row->period_slope[k];
    }
}

/* A run where no orbit attracts: what its means are, if it stays on the plate. */
static fst_status by_run(const fst_params *params, double sense, const fst_progress *progress, fit_value *out,
                         fst_error *error)
{
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    options.progress = progress;
    fst_status status = fst_run(params, &options, &result, error);
    if (status == FST_OK && result.regime != FST_REGIME_EJECTED && result.regime != FST_REGIME_LIFTED) {
        status = take_means(&result, params, sense, out, error);
        out->origin = is_finite(out) ? FIT_RUN : FIT_NOTHING;
    }
    return ends_the_search(status) ? status : FST_OK;
}

/* The model in one row at the coordinates u and the frequency f. */
static fst_status find_value(const fit_rows *rows, const fit_row *row, const double *u, double f,
                             const fst_progress *progress, fit_value *out, fst_error *error)
{
    fst_params params;
    fst_orbit guess;
    const double sense = f < 0.0 ? -1.0 : 1.0;
    *out = (fit_value){.origin = FIT_NOTHING, .value = {NAN, NAN, NAN}};
    (void)fit_space_params(rows->space, u, &params);
    params.drive_frequency = fabs(f);
    params.drive_omega = NAN;
    fst_status status = FST_NO_CONVERGENCE;
    if (row->last.origin == FIT_ORBIT) {
        guess_orbit(rows, row, u, &guess);
        status = fst_orbit_near(&params, &guess, ORBIT_TOLERANCE, progress, &out->orbit, error);
    }
    /* Where a known orbit was lost another one is near, or none: long waits would only slow the search down. */
    if (row->last.origin == FIT_ORBIT) {
        params.run_periods = fmin(fst_run_periods(&params), PERIODS_OF_ANOTHER);
        params.run_duration = NAN;
    }
    if (status != FST_OK && !ends_the_search(status))
        status = fst_orbit_find(&params, progress, &out->orbit, error);
    if (status == FST_OK) {
        status = take_means(&out->orbit.means, &params, sense, out, error);
        out->origin = is_finite(out) ? FIT_ORBIT : FIT_NOTHING;
        return ends_the_search(status) ? status : FST_OK;
    }
    if (ends_the_search(status))
        return status;
    return row->last.origin == FIT_ORBIT ? FST_OK : by_run(&params, sense, progress, out, error);
}

/* ------------------------------------------------------------------ all rows at once */

/* One value to be computed. */
typedef struct task {
    const fit_row *row;
    double u[FIT_MOST], frequency;
    fit_value *out;
} task;

typedef struct batch {
    const fit_rows *rows;
    task *tasks;
    fst_progress asking; /* by which a task learns whether to go on */
} batch;

static fst_status do_task(void *user, int index, fst_error *error)
{
    batch *b = user;
    const task *t = &b->tasks[index];
    return find_value(b->rows, t->row, t->u, t->frequency, &b->asking, t->out, error);
}

static fst_status do_batch(const fit_rows *rows, task *tasks, int count, fst_error *error)
{
    batch b = {.rows = rows, .tasks = tasks};
    const fst_work work = {&b, count, do_task, rows->progress, &b.asking};
    return fst_parallel(&work, error);
}

static task *new_tasks(const fit_rows *rows, int each, fst_error *error)
{
    task *tasks = calloc((size_t)rows->count * (size_t)each, sizeof *tasks);
    if (!tasks)
        (void)fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    return tasks;
}

fst_status fit_rows_values(const fit_rows *rows, const double *u, fit_value *values, fst_error *error)
{
    task *tasks = new_tasks(rows, 1, error);
    if (!tasks)
        return FST_NO_MEMORY;
    for (int i = 0; i < rows->count; ++i) {
        tasks[i] = (task){.row = &rows->rows[i], .frequency = rows->rows[i].frequency, .out = &values[i]};
        memcpy(tasks[i].u, u, (size_t)rows->space->count * sizeof *u);
    }
    const fst_status status = do_batch(rows, tasks, rows->count, error);
    free(tasks);
    return status;
}

void fit_rows_keep(fit_rows *rows, const double *u, const fit_value *values)
{
    for (int i = 0; i < rows->count; ++i) {
        fit_row *row = &rows->rows[i];
        if (values[i].origin == FIT_NOTHING)
            continue;
        row->last = values[i];
        memcpy(row->at, u, (size_t)rows->space->count * sizeof *u);
        row->has_slopes = 0;
    }
}

/* ------------------------------------------------------------------ derivatives */

static double step_of(const fit_row *row)
{
    return row->last.origin == FIT_ORBIT ? ORBIT_STEP : RUN_STEP;
}

/* The change of a row from its kept value to `moved` at a distance `step`; 0 where the motion is another one.
 */
static void take_slope(const fit_row *row, const fit_value *moved, double step, double out[FST_MEASURED_COUNT])
{
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        out[q] = moved->origin == row->last.origin && moved->origin != FIT_NOTHING
                     ? (moved->value[q] - row->last.value[q]) / step
                     : 0.0;
}

static void take_orbit_slopes(const fit_rows *rows, fit_row *row, const fit_value *moved)
{
    const int n = rows->space->count;
    row->has_slopes = row->last.origin == FIT_ORBIT;
    for (int k = 0; k < n && row->has_slopes; ++k) {
        const fst_orbit *orbit = &moved[k].orbit;
        row->has_slopes = moved[k].origin == FIT_ORBIT && orbit->symmetry == row->last.orbit.symmetry;
        row->period_slope[k] = (orbit->means.period - row->last.orbit.means.period) / ORBIT_STEP;
        for (int i = 0; i < FST_STATE_SIZE; ++i) {
            row->state_slope[k][i] = (orbit->state[i] - row->last.orbit.state[i]) / ORBIT_STEP;
            row->has_slopes &= fabs(row->state_slope[k][i]) < 1e3; /* else a conjugate orbit */
        }
    }
}

/* The model a step beside every kept value: along each of the n coordinates, or in frequency (n = 0).  *moved
 * is to be freed, also after a failure. */
static fst_status move_rows(const fit_rows *rows, int n, fit_value **moved, fst_error *error)
{
    const int each = n ? n : 1, count = rows->count * each;
    *moved = calloc((size_t)count, sizeof **moved);
    task *tasks = *moved ? new_tasks(rows, each, error) : NULL;
    for (int i = 0; i < count && tasks; ++i) {
        const fit_row *row = &rows->rows[i / each];
        const double frequency = n ? row->frequency : row->frequency * (1.0 + step_of(row));
        tasks[i] = (task){.row = row, .frequency = frequency, .out = *moved + i};
        memcpy(tasks[i].u, row->at, sizeof row->at);
        if (n)
            tasks[i].u[i % n] += step_of(row);
    }
    const fst_status status = tasks ? do_batch(rows, tasks, count, error)
                                    : fst_fail(error, FST_NO_MEMORY, "fst_fit", "out of memory");
    free(tasks);
    return status;
}

fst_status fit_rows_slopes(fit_rows *rows, double (*derivative)[FST_MEASURED_COUNT], fst_error *error)
{
    const int n = rows->space->count;
    fit_value *moved;
    for (int i = 0; i < rows->count; ++i)
        rows->rows[i].has_slopes = 0; /* the kept orbit itself is the best guess for a small step */
    const fst_status status = move_rows(rows, n, &moved, error);
    for (int i = 0; i < rows->count && status == FST_OK; ++i) {
        for (int k = 0; k < n; ++k)
            take_slope(&rows->rows[i], &moved[i * n + k], step_of(&rows->rows[i]), derivative[i * n + k]);
        take_orbit_slopes(rows, &rows->rows[i], &moved[i * n]);
    }
    free(moved);
    return status;
}

fst_status fit_rows_by_frequency(const fit_rows *rows, double (*by_frequency)[FST_MEASURED_COUNT],
                                 fst_error *error)
{
    fit_value *moved;
    const fst_status status = move_rows(rows, 0, &moved, error);
    for (int i = 0; i < rows->count && status == FST_OK; ++i)
        take_slope(&rows->rows[i], &moved[i], rows->rows[i].frequency * step_of(&rows->rows[i]),
                   by_frequency[i]);
    free(moved);
    return status;
}
