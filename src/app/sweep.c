/* sweep.c - a sweep as a job: threads compute rows, the calling thread alone keeps the journal.
 *
 * The calling thread fills a queue of tasks from what the journal lacks and writes the rows that come back;
 * both queues are bounded, so that the memory of a sweep does not grow with its points.  A task is a point, or
 * with carrying the first point of a chain without a row, the rest of which follows in the same place.
 */
#include "app/sweep.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"
#include "model/params.h"

enum { TASKS = 1024, ROWS = 512, MOST_THREADS = 256, COMMIT_ROWS = 256 };
static const double COMMIT_SECONDS = 0.5, WAIT_SECONDS = 0.05;

typedef struct task {
    int64_t point;
    int has_start;
    double start[FST_STATE_SIZE];
} task;

typedef struct job {
    fst_sweep_identity identity;
    fst_grid *grid;
    fst_journal *journal;
    const fst_sweep_options *options;
    int64_t next; /* point or chain from which on the journal is yet to be looked through */
    fst_sweep_progress progress;
    double started, committed;
    int uncommitted;

    pthread_mutex_t lock; /* guards everything below */
    pthread_cond_t task_came, row_came, room_came;
    task tasks[TASKS];
    int first_task, task_count, no_more_tasks;
    fst_sweep_record rows[ROWS];
    int first_row, row_count;
    int busy;          /* threads at work */
    int stopping;      /* no new tasks, runs are broken off */
    int abandoned;     /* rows are not taken any more */
    fst_status status; /* of threads */
    fst_error error;
} job;

fst_sweep_options fst_default_sweep_options(void)
{
    fst_sweep_options o;
    memset(&o, 0, sizeof o);
    o.cookie = FST_SWEEP_OPTIONS_COOKIE;
    o.arithmetic = fst_best_arithmetic();
    return o;
}

static double now(void)
{
    struct timespec time = {0, 0};
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* ------------------------------------------------------------------ chains */

static int64_t chain_count(const job *j)
{
    return j->progress.points / fst_grid_axis_points(j->grid, 0);
}

/* The point at place `place` of a chain, in the direction of carrying. */
static int64_t chain_point(const job *j, int64_t chain, int64_t place)
{
    const int64_t stride = fst_grid_axis_stride(j->grid, 0), count = fst_grid_axis_points(j->grid, 0);
    const int64_t first = chain / stride * (stride * count) + chain % stride;
    const int rises =
        fst_grid_value(j->grid, 0, first) <= fst_grid_value(j->grid, 0, first + (count - 1) * stride);
    const int forward = rises == (j->identity.carry == FST_CARRY_UP);
    return first + (forward ? place : count - 1 - place) * stride;
}

/* The place of a point in its chain, and the chain. */
static int64_t place_of(const job *j, int64_t point, int64_t *chain)
{
    const int64_t stride = fst_grid_axis_stride(j->grid, 0), count = fst_grid_axis_points(j->grid, 0);
    *chain = point / (stride * count) * stride + point % stride;
    const int64_t index = point / stride % count;
    return chain_point(j, *chain, index) == point ? index : count - 1 - index;
}

/* The task that goes on with a chain, if there is anything left of it. */
static fst_status resume_chain(job *j, int64_t chain, task *t, int *found, fst_error *error)
{
    const int64_t count = fst_grid_axis_points(j->grid, 0);
    int there = 1, usable = 0;
    *found = 0;
    t->has_start = 0;
    for (int64_t place = 0; place < count; ++place) {
        t->point = chain_point(j, chain, place);
        double end[FST_STATE_SIZE];
        const fst_status status = fst_journal_end_state(j->journal, t->point, &there, &usable, end, error);
        if (status != FST_OK)
            return status;
        if (!there) {
            *found = 1;
            return FST_OK;
        }
        t->has_start = usable;
        memcpy(t->start, end, sizeof end);
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ the threads' side */

static int next_task(void *user, fst_row_job *row)
{
    job *j = user;
    pthread_mutex_lock(&j->lock);
    while (j->task_count == 0 && !j->no_more_tasks && !j->stopping)
        pthread_cond_wait(&j->task_came, &j->lock);
    const int more = j->task_count > 0 && !j->stopping;
    if (more) {
        const task *t = &j->tasks[j->first_task];
        row->point = t->point;
        row->has_start = t->has_start;
        memcpy(row->start, t->start, sizeof row->start);
        j->first_task = (j->first_task + 1) % TASKS;
        j->task_count -= 1;
        if (j->task_count == TASKS / 4)
            pthread_cond_signal(&j->row_came);
    }
    pthread_mutex_unlock(&j->lock);
    if (more)
        (void)fst_grid_params(j->grid, row->point, &row->params, NULL); /* checked when the grid was made */
    return more;
}

static void hand_over(job *j, const fst_sweep_record *record)
{
    pthread_mutex_lock(&j->lock);
    while (j->row_count == ROWS && !j->abandoned)
        pthread_cond_wait(&j->room_came, &j->lock);
    if (!j->abandoned)
        j->rows[(j->first_row + j->row_count++) % ROWS] = *record;
    if (j->row_count == ROWS / 2)
        pthread_cond_signal(&j->row_came);
    pthread_mutex_unlock(&j->lock);
}

static int row_done(void *user, fst_row_job *row, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    job *j = user;
    fst_sweep_record record;
    memset(&record, 0, sizeof record);
    record.point = row->point;
    record.carried = row->has_start;
    record.status = status;
    record.dynamics = row->params.model_dynamics;
    record.result = *result;
    if (status != FST_OK)
        (void)snprintf(record.result.reason, sizeof record.result.reason, "%.255s", error->sentence);
    hand_over(j, &record);
    if (j->identity.carry == FST_CARRY_NO)
        return 0;
    int64_t chain;
    const int64_t place = place_of(j, row->point, &chain) + 1;
    if (place == fst_grid_axis_points(j->grid, 0))
        return 0;
    row->point = chain_point(j, chain, place);
    row->has_start =
        status == FST_OK && result->regime != FST_REGIME_EJECTED && result->regime != FST_REGIME_LIFTED;
    memcpy(row->start, result->final_state, sizeof row->start);
    (void)fst_grid_params(j->grid, row->point, &row->params, NULL);
    return 1;
}

static int stopped(void *user)
{
    job *j = user;
    pthread_mutex_lock(&j->lock);
    const int stop = j->stopping;
    pthread_mutex_unlock(&j->lock);
    return stop;
}

static void *labour(void *user)
{
    job *j = user;
    fst_error error = {FST_OK, "", ""};
    const fst_row_work work = {.user = j,
                               .arithmetic = j->identity.arithmetic,
                               .lanes = j->options->lanes,
                               .next = next_task,
                               .done = row_done,
                               .stopped = stopped};
    const fst_status status = fst_rows(&work, &error);
    pthread_mutex_lock(&j->lock);
    if (status != FST_OK && status != FST_INTERRUPTED && j->status == FST_OK) {
        j->status = status;
        j->error = error;
        j->stopping = 1;
        pthread_cond_broadcast(&j->task_came);
    }
    j->busy -= 1;
    pthread_cond_signal(&j->row_came);
    pthread_mutex_unlock(&j->lock);
    return NULL;
}

/* ------------------------------------------------------------------ the journal's side */

/* Tasks from the journal into `fresh`; *found is 0 when there are no more. */
static fst_status look_for_tasks(job *j, task *fresh, int room, int *found, fst_error *error)
{
    fst_status status = FST_OK;
    *found = 0;
    if (j->identity.carry == FST_CARRY_NO) {
        int64_t points[TASKS];
        status = fst_journal_missing(j->journal, &j->next, points, room, found, error);
        for (int i = 0; i < *found; ++i) {
            fresh[i].point = points[i];
            fresh[i].has_start = 0;
        }
        return status;
    }
    for (; j->next < chain_count(j) && *found < room && status == FST_OK; ++j->next) {
        int is_open;
        status = resume_chain(j, j->next, &fresh[*found], &is_open, error);
        *found += status == FST_OK && is_open;
    }
    return status;
}

/* Fill the queue of tasks up; called by the journal's thread alone, without the lock. */
static fst_status refill(job *j, fst_error *error)
{
    static const int few = TASKS / 4;
    pthread_mutex_lock(&j->lock);
    const int room = j->no_more_tasks || j->stopping || j->task_count > few ? 0 : TASKS - j->task_count;
    pthread_mutex_unlock(&j->lock);
    if (room == 0)
        return FST_OK;
    task *fresh = malloc((size_t)room * sizeof *fresh);
    if (!fresh)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    int found;
    const fst_status status = look_for_tasks(j, fresh, room, &found, error);
    pthread_mutex_lock(&j->lock);
    for (int i = 0; status == FST_OK && i < found; ++i)
        j->tasks[(j->first_task + j->task_count++) % TASKS] = fresh[i];
    j->no_more_tasks = found == 0;
    pthread_cond_broadcast(&j->task_came);
    pthread_mutex_unlock(&j->lock);
    free(fresh);
    return status;
}

/* Write what has come, and commit now and then. */
static fst_status write_rows(job *j, const fst_sweep_record *rows, int count, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < count && status == FST_OK; ++i)
        status = fst_journal_add(j->journal, &rows[i], error);
    for (int i = 0; i < count; ++i)
        j->progress.failed += rows[i].status != FST_OK;
    j->uncommitted += count;
    if (status == FST_OK && j->uncommitted > 0 &&
        (j->uncommitted >= COMMIT_ROWS || now() - j->committed > COMMIT_SECONDS)) {
        status = fst_journal_commit(j->journal, error);
        j->committed = now();
        j->uncommitted = 0;
    }
    if (status == FST_OK) {
        j->progress.added += count;
        j->progress.there += count;
    }
    return status;
}

static struct timespec soon(void)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_REALTIME, &time);
    time.tv_nsec += (long)(1e9 * WAIT_SECONDS);
    time.tv_sec += time.tv_nsec / 1000000000;
    time.tv_nsec %= 1000000000;
    return time;
}

/* Rows that have come, waiting a little for them; *busy tells whether more can follow. */
static int take_rows(job *j, fst_sweep_record *rows, int *busy)
{
    const struct timespec until = soon();
    pthread_mutex_lock(&j->lock);
    const int hungry = j->task_count <= TASKS / 4 && !j->no_more_tasks && !j->stopping;
    if (j->row_count < ROWS / 2 && j->busy > 0 && !hungry)
        (void)pthread_cond_timedwait(&j->row_came, &j->lock, &until);
    const int count = j->row_count;
    for (int i = 0; i < count; ++i)
        rows[i] = j->rows[(j->first_row + i) % ROWS];
    j->first_row = (j->first_row + count) % ROWS;
    j->row_count = 0;
    *busy = j->busy > 0;
    pthread_cond_broadcast(&j->room_came);
    pthread_mutex_unlock(&j->lock);
    return count;
}

static void stop(job *j, int abandon)
{
    pthread_mutex_lock(&j->lock);
    j->stopping = 1;
    j->abandoned = j->abandoned || abandon;
    pthread_cond_broadcast(&j->task_came);
    pthread_cond_broadcast(&j->room_came);
    pthread_mutex_unlock(&j->lock);
}

/* Keep the journal until no thread works any more.  An interruption still writes what the threads had done. */
static fst_status keep_journal(job *j, fst_error *error)
{
    fst_sweep_record *rows = malloc(ROWS * sizeof *rows);
    fst_status status = rows ? FST_OK : fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    if (status != FST_OK)
        stop(j, 1);
    fst_status outcome = status;
    int busy = rows != NULL;
    while (busy) {
        if (status == FST_OK && outcome == FST_OK)
            status = refill(j, error);
        const int count = take_rows(j, rows, &busy);
        if (status == FST_OK)
            status = write_rows(j, rows, count, error);
        j->progress.seconds = now() - j->started;
        if (status == FST_OK && outcome == FST_OK && j->options->progress)
            outcome = j->options->progress(j->options->user, &j->progress, error);
        if (status != FST_OK || outcome != FST_OK)
            stop(j, status != FST_OK);
    }
    free(rows);
    return status != FST_OK ? status : outcome;
}

/* ------------------------------------------------------------------ the job */

static int thread_count(const job *j)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int wanted = j->options->threads > 0 ? j->options->threads : processors > 0 ? (int)processors : 1;
    const int64_t tasks = j->identity.carry == FST_CARRY_NO ? j->progress.points : chain_count(j);
    if (wanted > MOST_THREADS)
        wanted = MOST_THREADS;
    return wanted > tasks ? (int)tasks : wanted;
}

static fst_status work(job *j, fst_error *error)
{
    pthread_t threads[MOST_THREADS];
    const int wanted = thread_count(j);
    int started = 0;
    fst_status status = refill(j, error);
    pthread_mutex_lock(&j->lock);
    while (status == FST_OK && started < wanted && pthread_create(&threads[started], NULL, labour, j) == 0) {
        started += 1;
        j->busy += 1;
    }
    pthread_mutex_unlock(&j->lock);
    if (status == FST_OK && started == 0)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "no thread could be started");
    if (status == FST_OK)
        status = keep_journal(j, error);
    for (int i = 0; i < started; ++i)
        pthread_join(threads[i], NULL);
    if (status == FST_OK && j->status != FST_OK) {
        status = j->status;
        if (error)
            *error = j->error;
    }
    return status;
}

static fst_status check_options(const fst_sweep_options *o, const fst_grid *grid, fst_error *error)
{
    if (o->lanes != 0 && o->lanes != 1 && o->lanes != 4 && o->lanes != 8)
        return fst_fail(error, FST_BAD_INPUT, "--lanes", "the number of lanes is 1, 4 or 8, not %d", o->lanes);
    const char *key = fst_grid_key(grid, 0);
    if (o->carry != FST_CARRY_NO &&
        (strcmp(key, "friction.gamma") == 0 || strcmp(key, "magnet.half_length") == 0))
        return fst_fail(error, FST_BAD_INPUT, "--carry",
                        "%s changes the units, so a state cannot be carried along it", key);
    return FST_OK;
}

static fst_status run_job(job *j, const char *path, fst_error *error)
{
    fst_status status = fst_journal_open(path, &j->identity, &j->journal, error);
    if (status == FST_OK)
        status = fst_journal_count(j->journal, &j->progress.there, error);
    if (status == FST_OK && j->progress.there < j->progress.points)
        status = work(j, error);
    fst_error closing;
    const fst_status closed = fst_journal_close(j->journal, &closing);
    if (closed != FST_OK && (status == FST_OK || status == FST_INTERRUPTED)) {
        status = closed;
        if (error)
            *error = closing;
    }
    return status;
}

fst_status fst_sweep(const fst_params *params, const char *path, const fst_sweep_options *options,
                     fst_sweep_progress *result, fst_error *error)
{
    memset(result, 0, sizeof *result);
    if (options->cookie != FST_SWEEP_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep",
                        "the options were not made by fst_default_sweep_options()");
    fst_grid *grid;
    fst_status status = fst_grid_new(params, options->axes, options->axis_count, options->seed, &grid, error);
    if (status != FST_OK)
        return status;
    job *j = calloc(1, sizeof *j);
    if (!j)
        status = fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    else
        status = check_options(options, grid, error);
    if (status == FST_OK) {
        const fst_arithmetic form = options->arithmetic;
        j->identity = (fst_sweep_identity){grid, options->seed, options->carry, form, 0};
        j->grid = grid;
        j->options = options;
        j->progress.points = fst_grid_points(grid);
        j->started = j->committed = now();
        pthread_mutex_init(&j->lock, NULL);
        pthread_cond_init(&j->task_came, NULL);
        pthread_cond_init(&j->row_came, NULL);
        pthread_cond_init(&j->room_came, NULL);
        status = fst_arithmetic_fingerprint(form, options->lanes, &j->identity.fingerprint, error);
        if (status == FST_OK)
            status = run_job(j, path, error);
        *result = j->progress;
        pthread_cond_destroy(&j->room_came);
        pthread_cond_destroy(&j->row_came);
        pthread_cond_destroy(&j->task_came);
        pthread_mutex_destroy(&j->lock);
    }
    free(j);
    fst_grid_free(grid);
    return status;
}
