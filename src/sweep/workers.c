/* workers.c - the threads that compute the rows of a sweep.
 *
 *      fst_workers_give()                                     fst_workers_take()
 *    journal's thread --> [ tasks, at most 1024 ] --> threads --> [ rows, at most 512 ] --> journal's thread
 *
 * Both queues are bounded, so the memory of a sweep does not grow with its points.  A thread waits where there
 * is no task, or no room for a row; the journal's thread waits for rows, but never for long.  One lock guards
 * both queues.
 */
#include "sweep/workers.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "host/threads.h"

struct fst_workers {
    const fst_sweep_identity *identity;
    fst_workers_plan plan;
    fst_threads threads;

    pthread_mutex_t lock; /* guards everything below */
    pthread_cond_t task_came, row_came, room_came;
    fst_sweep_task tasks[FST_WORKERS_TASKS];
    int first_task, task_count, expecting, no_more_tasks;
    fst_sweep_record rows[FST_WORKERS_ROWS];
    int first_row, row_count;
    fst_image *found;  /* images of runs that a thread will go on from */
    fst_image *made;   /* images of runs at work, to be taken by the other side */
    int busy;          /* threads at work */
    int stopping;      /* begin no more tasks, break runs off */
    int abandoned;     /* the other side takes no more rows */
    fst_status status; /* of the first thread that failed */
    fst_error error;
};

/* ------------------------------------------------------------------ the threads' side */

static int take_task(fst_workers *w, fst_sweep_task *task)
{
    pthread_mutex_lock(&w->lock);
    const int over = w->stopping || (w->no_more_tasks && w->task_count == 0);
    const int more = over ? 0 : w->task_count > 0 ? 1 : FST_JOBS_LATER;
    if (more > 0) {
        *task = w->tasks[w->first_task];
        w->first_task = (w->first_task + 1) % FST_WORKERS_TASKS;
        w->task_count -= 1;
        if (w->task_count == w->plan.depth / 4)
            pthread_cond_signal(&w->row_came);
    }
    pthread_mutex_unlock(&w->lock);
    return more;
}

static int next_task(void *user, fst_row_job *row)
{
    fst_workers *w = user;
    fst_sweep_task task;
    const int more = take_task(w, &task);
    if (more > 0) {
        row->point = task.point;
        row->has_start = task.has_start;
        memcpy(row->start, task.start, sizeof row->start);
        /* cannot fail: the values were checked when the grid was made */
        (void)fst_grid_params(w->identity->grid, row->point, &row->params, NULL);
    }
    return more;
}

/* With carrying: the point behind a finished one of its chain; 0: that was the last. */
static int follow_chain(const fst_workers *w, int64_t *point)
{
    int64_t chain;
    if (w->identity->carry == FST_CARRY_NO)
        return 0;
    const int64_t place = fst_chain_place(w->identity, *point, &chain) + 1;
    if (place == fst_chain_length(w->identity))
        return 0;
    *point = fst_chain_point(w->identity, chain, place);
    return 1;
}

/* The work ends with an error, the first one; the lock is held. */
static void give_up(fst_workers *w, const fst_error *error)
{
    if (w->status == FST_OK) {
        w->status = error->code;
        w->error = *error;
        w->stopping = 1;
        pthread_cond_broadcast(&w->task_came);
    }
}

/* What befell the machine is not a row: the same command may fill it in another time. */
static int is_of_the_machine(fst_status status)
{
    return status == FST_NO_MEMORY || status == FST_UNAVAILABLE;
}

static void hand_over(fst_workers *w, const fst_sweep_record *record)
{
    fst_error error;
    pthread_mutex_lock(&w->lock);
    if (is_of_the_machine(record->status)) {
        (void)fst_fail(&error, record->status, "", "%s", record->result.reason);
        give_up(w, &error);
        pthread_mutex_unlock(&w->lock);
        return;
    }
    while (w->row_count == FST_WORKERS_ROWS && !w->abandoned)
        pthread_cond_wait(&w->room_came, &w->lock);
    if (!w->abandoned)
        w->rows[(w->first_row + w->row_count++) % FST_WORKERS_ROWS] = *record;
    free(fst_image_take(&w->made, record->point)); /* the run is over, so its image is of no use */
    /* New tasks may depend on this row. */
    const int is_starving = w->expecting && w->task_count == 0;
    if (w->row_count == FST_WORKERS_ROWS / 2 || is_starving)
        pthread_cond_signal(&w->row_came);
    pthread_mutex_unlock(&w->lock);
}

static int row_done(void *user, fst_row_job *row, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    fst_workers *w = user;
    fst_sweep_record record;
    memset(&record, 0, sizeof record);
    record.point = row->point;
    record.carried = row->has_start;
    record.status = status;
    record.dynamics = row->params.model_dynamics;
    record.result = *result;
    if (status != FST_OK)
        (void)snprintf(record.result.reason, sizeof record.result.reason, "%.255s", error->sentence);
    hand_over(w, &record);
    if (!follow_chain(w, &row->point))
        return 0;
    row->has_start = status == FST_OK && result->regime != FST_REGIME_EJECTED &&
                     result->regime != FST_REGIME_LIFTED &&
                     (result->periods >= fst_run_periods(&row->params) || !isnan(result->settled_at));
    memcpy(row->start, result->final_state, sizeof row->start);
    (void)fst_grid_params(w->identity->grid, row->point, &row->params, NULL);
    return 1;
}

/* The library's question whether to go on, in any of the threads. */
static fst_status answer(void *user, double fraction, const char *what, fst_error *error)
{
    fst_workers *w = user;
    (void)fraction, (void)what;
    pthread_mutex_lock(&w->lock);
    const int stop = w->stopping;
    pthread_mutex_unlock(&w->lock);
    return stop ? fst_fail(error, FST_INTERRUPTED, "", "interrupted") : FST_OK;
}

static void save_image(void *user, const fst_row_job *job, const void *bytes, size_t size)
{
    fst_workers *w = user;
    fst_image *image = fst_image_new(job->point, bytes, size);
    if (!image)
        return; /* without memory for the image the run goes on all the same */
    pthread_mutex_lock(&w->lock);
    fst_image_put(&w->made, image);
    pthread_mutex_unlock(&w->lock);
}

static void *find_image(void *user, const fst_row_job *job, size_t *size)
{
    fst_workers *w = user;
    pthread_mutex_lock(&w->lock);
    fst_image *image = fst_image_take(&w->found, job->point);
    pthread_mutex_unlock(&w->lock);
    void *bytes = image ? malloc(image->size) : NULL;
    if (bytes) {
        memcpy(bytes, image->bytes, image->size);
        *size = image->size;
    }
    free(image);
    return bytes;
}

/* Tasks whose rows are not runs of a bead on the plate, until there are none. */
static fst_status own_rows(fst_workers *w, fst_row_kind kind, const fst_progress *progress, fst_error *error)
{
    fst_params params;
    fst_sweep_task task;
    fst_status status = FST_OK;
    for (int goes_on = 0; status == FST_OK && (goes_on || take_task(w, &task) > 0);) {
        fst_sweep_record record;
        memset(&record, 0, sizeof record);
        record.point = task.point;
        record.carried = task.has_start;
        (void)fst_grid_params(w->identity->grid, task.point, &params, NULL);
        status = fst_own_row(kind, &params, task.has_start ? task.start : NULL, progress, &record, error);
        if (status == FST_OK)
            hand_over(w, &record);
        goes_on = follow_chain(w, &task.point);
        task.has_start = fst_can_go_on(&record);
        memcpy(task.start, record.world.final_state, sizeof task.start);
    }
    return status;
}

/* Wait for a task; 0: no more will come. */
static int wait_for_task(fst_workers *w)
{
    pthread_mutex_lock(&w->lock);
    while (w->task_count == 0 && !w->no_more_tasks && !w->stopping)
        pthread_cond_wait(&w->task_came, &w->lock);
    const int is_there = w->task_count > 0 && !w->stopping;
    pthread_mutex_unlock(&w->lock);
    return is_there;
}

static void *labour(void *user)
{
    fst_workers *w = user;
    fst_error error = {FST_OK, "", ""};
    const fst_progress progress = {w, answer};
    const fst_row_kind kind = fst_grid_row_kind(w->identity->grid);
    const fst_row_work work = {.user = w,
                               .arithmetic = w->identity->arithmetic,
                               .lanes = w->plan.lanes,
                               .next = next_task,
                               .done = row_done,
                               .progress = &progress};
    const fst_row_images images = {
        .user = w, .seconds = w->plan.checkpoint_seconds, .save = save_image, .find = find_image};
    fst_status status = FST_OK;
    while (status == FST_OK && wait_for_task(w))
        status = kind == FST_ROWS_OF_RUNS ? fst_rows_with_images(&work, &images, &error)
                                          : own_rows(w, kind, &progress, &error);
    pthread_mutex_lock(&w->lock);
    if (status != FST_OK && status != FST_INTERRUPTED)
        give_up(w, &error);
    w->busy -= 1;
    pthread_cond_signal(&w->row_came);
    pthread_mutex_unlock(&w->lock);
    return NULL;
}

/* ------------------------------------------------------------------ the other side */

static int is_hungry(const fst_workers *w)
{
    return w->task_count <= w->plan.depth / 4 && !w->no_more_tasks && !w->stopping && !w->expecting;
}

int fst_workers_room(fst_workers *w)
{
    pthread_mutex_lock(&w->lock);
    const int room = is_hungry(w) ? w->plan.depth - w->task_count : 0;
    pthread_mutex_unlock(&w->lock);
    return room;
}

void fst_workers_expect(fst_workers *w, int expecting)
{
    pthread_mutex_lock(&w->lock);
    w->expecting = expecting;
    pthread_mutex_unlock(&w->lock);
}

void fst_workers_give(fst_workers *w, const fst_sweep_task *tasks, int count)
{
    pthread_mutex_lock(&w->lock);
    for (int i = 0; i < count; ++i)
        w->tasks[(w->first_task + w->task_count++) % FST_WORKERS_TASKS] = tasks[i];
    w->no_more_tasks = count == 0;
    w->expecting = 0;
    pthread_cond_broadcast(&w->task_came);
    pthread_mutex_unlock(&w->lock);
}

int fst_workers_withdraw(fst_workers *w, fst_sweep_task *tasks, int most, int share, int *over)
{
    pthread_mutex_lock(&w->lock);
    int count = (w->task_count + share - 1) / share;
    if (count > most)
        count = most;
    if (w->stopping)
        count = 0;
    for (int i = 0; i < count; ++i) /* the last ones: threads take from the front */
        tasks[i] = w->tasks[(w->first_task + w->task_count - count + i) % FST_WORKERS_TASKS];
    w->task_count -= count;
    *over = count == 0 && (w->no_more_tasks || w->stopping);
    pthread_mutex_unlock(&w->lock);
    return count;
}

void fst_workers_give_image(fst_workers *w, fst_image *image)
{
    pthread_mutex_lock(&w->lock);
    fst_image_put(&w->found, image);
    pthread_mutex_unlock(&w->lock);
}

fst_image *fst_workers_withdraw_image(fst_workers *w, int64_t point)
{
    pthread_mutex_lock(&w->lock);
    fst_image *image = fst_image_take(&w->found, point);
    pthread_mutex_unlock(&w->lock);
    return image;
}

fst_image *fst_workers_take_images(fst_workers *w)
{
    pthread_mutex_lock(&w->lock);
    fst_image *images = w->made;
    w->made = NULL;
    pthread_mutex_unlock(&w->lock);
    return images;
}

int fst_workers_take(fst_workers *w, fst_sweep_record *rows, double seconds, int *busy)
{
    pthread_mutex_lock(&w->lock);
    const int enough = w->expecting && w->task_count == 0 ? 1 : FST_WORKERS_ROWS / 2;
    if (w->row_count < enough && w->busy > 0 && !is_hungry(w))
        fst_condition_wait(&w->row_came, &w->lock, seconds);
    const int count = w->row_count;
    for (int i = 0; i < count; ++i)
        rows[i] = w->rows[(w->first_row + i) % FST_WORKERS_ROWS];
    w->first_row = (w->first_row + count) % FST_WORKERS_ROWS;
    w->row_count = 0;
    *busy = w->busy > 0;
    pthread_cond_broadcast(&w->room_came);
    pthread_mutex_unlock(&w->lock);
    return count;
}

void fst_workers_stop(fst_workers *w, int abandon)
{
    pthread_mutex_lock(&w->lock);
    w->stopping = 1;
    w->abandoned = w->abandoned || abandon;
    pthread_cond_broadcast(&w->task_came);
    pthread_cond_broadcast(&w->room_came);
    pthread_mutex_unlock(&w->lock);
}

static void begin_locks(fst_workers *w)
{
    pthread_mutex_init(&w->lock, NULL);
    pthread_cond_init(&w->task_came, NULL);
    fst_condition_init(&w->row_came); /* it is waited for with a limit */
    pthread_cond_init(&w->room_came, NULL);
}

fst_status fst_workers_new(const fst_sweep_identity *identity, const fst_workers_plan *plan,
                           fst_workers **workers, fst_error *error)
{
    fst_workers *w = calloc(1, sizeof *w);
    *workers = w;
    if (!w)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    w->identity = identity;
    w->plan = *plan;
    w->plan.depth = plan->depth < FST_WORKERS_TASKS ? plan->depth : FST_WORKERS_TASKS;
    begin_locks(w);
    pthread_mutex_lock(&w->lock);
    const int started = w->busy = fst_threads_start(&w->threads, plan->threads, labour, w);
    pthread_mutex_unlock(&w->lock);
    if (started > 0)
        return FST_OK;
    (void)fst_workers_end(w, NULL);
    *workers = NULL;
    return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "no thread could be started");
}

fst_status fst_workers_end(fst_workers *w, fst_error *error)
{
    if (!w)
        return FST_OK;
    fst_threads_join(&w->threads);
    const fst_status status = w->status;
    if (status != FST_OK && error)
        *error = w->error;
    pthread_cond_destroy(&w->room_came);
    pthread_cond_destroy(&w->row_came);
    pthread_cond_destroy(&w->task_came);
    pthread_mutex_destroy(&w->lock);
    fst_images_free(w->found);
    fst_images_free(w->made);
    free(w);
    return status;
}
