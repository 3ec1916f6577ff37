#include "sweep/workers.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/error.h"

enum { MOST_THREADS = 256 };

struct fst_crew {
    const fst_sweep_identity *identity;
    fst_crew_plan plan;
    int started;
    pthread_t threads[MOST_THREADS];

    pthread_mutex_t lock; /* guards everything below */
    pthread_cond_t task_came, row_came, room_came;
    fst_sweep_task tasks[FST_CREW_TASKS];
    int first_task, task_count, expecting, no_more_tasks;
    fst_sweep_record rows[FST_CREW_ROWS];
    int first_row, row_count;
    fst_image *found;  /* images that runs to come go on from */
    fst_image *made;   /* images of runs at work, yet to be taken */
    int busy;          /* threads at work */
    int stopping;      /* no new tasks, runs are broken off */
    int abandoned;     /* rows are not taken any more */
    fst_status status; /* of threads */
    fst_error error;
};

/* ------------------------------------------------------------------ the threads' side */

static int next_task(void *user, fst_row_job *row)
{
    fst_crew *c = user;
    pthread_mutex_lock(&c->lock);
    while (c->task_count == 0 && !c->no_more_tasks && !c->stopping)
        pthread_cond_wait(&c->task_came, &c->lock);
    const int more = c->task_count > 0 && !c->stopping;
    if (more) {
        const fst_sweep_task *t = &c->tasks[c->first_task];
        row->point = t->point;
        row->has_start = t->has_start;
        memcpy(row->start, t->start, sizeof row->start);
        c->first_task = (c->first_task + 1) % FST_CREW_TASKS;
        c->task_count -= 1;
        if (c->task_count == c->plan.depth / 4)
            pthread_cond_signal(&c->row_came);
    }
    pthread_mutex_unlock(&c->lock);
    if (more) /* the values were checked when the grid was made */
        (void)fst_grid_params(c->identity->grid, row->point, &row->params, NULL);
    return more;
}

static void hand_over(fst_crew *c, const fst_sweep_record *record)
{
    pthread_mutex_lock(&c->lock);
    while (c->row_count == FST_CREW_ROWS && !c->abandoned)
        pthread_cond_wait(&c->room_came, &c->lock);
    if (!c->abandoned)
        c->rows[(c->first_row + c->row_count++) % FST_CREW_ROWS] = *record;
    free(fst_image_take(&c->made, record->point)); /* the run is over */
    if (c->row_count == FST_CREW_ROWS / 2)
        pthread_cond_signal(&c->row_came);
    pthread_mutex_unlock(&c->lock);
}

static int row_done(void *user, fst_row_job *row, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    fst_crew *c = user;
    fst_sweep_record record;
    memset(&record, 0, sizeof record);
    record.point = row->point;
    record.carried = row->has_start;
    record.status = status;
    record.dynamics = row->params.model_dynamics;
    record.result = *result;
    if (status != FST_OK)
        (void)snprintf(record.result.reason, sizeof record.result.reason, "%.255s", error->sentence);
    hand_over(c, &record);
    if (c->identity->carry == FST_CARRY_NO)
        return 0;
    int64_t chain;
    const int64_t place = fst_chain_place(c->identity, row->point, &chain) + 1;
    if (place == fst_chain_length(c->identity))
        return 0;
    row->point = fst_chain_point(c->identity, chain, place);
    row->has_start =
        status == FST_OK && result->regime != FST_REGIME_EJECTED && result->regime != FST_REGIME_LIFTED;
    memcpy(row->start, result->final_state, sizeof row->start);
    (void)fst_grid_params(c->identity->grid, row->point, &row->params, NULL);
    return 1;
}

static int stopped(void *user)
{
    fst_crew *c = user;
    pthread_mutex_lock(&c->lock);
    const int stop = c->stopping;
    pthread_mutex_unlock(&c->lock);
    return stop;
}

static void save_image(void *user, const fst_row_job *job, const void *bytes, size_t size)
{
    fst_crew *c = user;
    fst_image *image = fst_image_new(job->point, bytes, size);
    if (!image)
        return; /* the run goes on all the same */
    pthread_mutex_lock(&c->lock);
    fst_image_put(&c->made, image);
    pthread_mutex_unlock(&c->lock);
}

static void *find_image(void *user, const fst_row_job *job, size_t *size)
{
    fst_crew *c = user;
    pthread_mutex_lock(&c->lock);
    fst_image *image = fst_image_take(&c->found, job->point);
    pthread_mutex_unlock(&c->lock);
    void *bytes = image ? malloc(image->size) : NULL;
    if (bytes) {
        memcpy(bytes, image->bytes, image->size);
        *size = image->size;
    }
    free(image);
    return bytes;
}

static void *labour(void *user)
{
    fst_crew *c = user;
    fst_error error = {FST_OK, "", ""};
    const fst_row_work work = {.user = c,
                               .arithmetic = c->identity->arithmetic,
                               .lanes = c->plan.lanes,
                               .next = next_task,
                               .done = row_done,
                               .stopped = stopped};
    const fst_row_images images = {
        .user = c, .seconds = c->plan.checkpoint_seconds, .save = save_image, .find = find_image};
    const fst_status status = fst_rows_with_images(&work, &images, &error);
    pthread_mutex_lock(&c->lock);
    if (status != FST_OK && status != FST_INTERRUPTED && c->status == FST_OK) {
        c->status = status;
        c->error = error;
        c->stopping = 1;
        pthread_cond_broadcast(&c->task_came);
    }
    c->busy -= 1;
    pthread_cond_signal(&c->row_came);
    pthread_mutex_unlock(&c->lock);
    return NULL;
}

/* ------------------------------------------------------------------ the other side */

static int is_hungry(const fst_crew *c)
{
    return c->task_count <= c->plan.depth / 4 && !c->no_more_tasks && !c->stopping && !c->expecting;
}

int fst_crew_room(fst_crew *c)
{
    pthread_mutex_lock(&c->lock);
    const int room = is_hungry(c) ? c->plan.depth - c->task_count : 0;
    pthread_mutex_unlock(&c->lock);
    return room;
}

void fst_crew_expect(fst_crew *c)
{
    pthread_mutex_lock(&c->lock);
    c->expecting = 1;
    pthread_mutex_unlock(&c->lock);
}

void fst_crew_give(fst_crew *c, const fst_sweep_task *tasks, int count)
{
    pthread_mutex_lock(&c->lock);
    for (int i = 0; i < count; ++i)
        c->tasks[(c->first_task + c->task_count++) % FST_CREW_TASKS] = tasks[i];
    c->no_more_tasks = count == 0;
    c->expecting = 0;
    pthread_cond_broadcast(&c->task_came);
    pthread_mutex_unlock(&c->lock);
}

int fst_crew_withdraw(fst_crew *c, fst_sweep_task *tasks, int most, int share, int *over)
{
    pthread_mutex_lock(&c->lock);
    int count = (c->task_count + share - 1) / share;
    if (count > most)
        count = most;
    if (c->stopping)
        count = 0;
    for (int i = 0; i < count; ++i) /* the last ones: threads take from the front */
        tasks[i] = c->tasks[(c->first_task + c->task_count - count + i) % FST_CREW_TASKS];
    c->task_count -= count;
    *over = count == 0 && (c->no_more_tasks || c->stopping);
    pthread_mutex_unlock(&c->lock);
    return count;
}

void fst_crew_give_image(fst_crew *c, fst_image *image)
{
    pthread_mutex_lock(&c->lock);
    fst_image_put(&c->found, image);
    pthread_mutex_unlock(&c->lock);
}

fst_image *fst_crew_withdraw_image(fst_crew *c, int64_t point)
{
    pthread_mutex_lock(&c->lock);
    fst_image *image = fst_image_take(&c->found, point);
    pthread_mutex_unlock(&c->lock);
    return image;
}

fst_image *fst_crew_take_images(fst_crew *c)
{
    pthread_mutex_lock(&c->lock);
    fst_image *images = c->made;
    c->made = NULL;
    pthread_mutex_unlock(&c->lock);
    return images;
}

/* By the clock that nobody sets: that of the day may be set back by hours. */
static struct timespec after(double seconds)
{
    struct timespec time;
    (void)clock_gettime(CLOCK_MONOTONIC, &time);
    time.tv_nsec += (long)(1e9 * seconds);
    time.tv_sec += time.tv_nsec / 1000000000;
    time.tv_nsec %= 1000000000;
    return time;
}

int fst_crew_take(fst_crew *c, fst_sweep_record *rows, double seconds, int *busy)
{
    const struct timespec until = after(seconds);
    pthread_mutex_lock(&c->lock);
    if (c->row_count < FST_CREW_ROWS / 2 && c->busy > 0 && !is_hungry(c))
        (void)pthread_cond_timedwait(&c->row_came, &c->lock, &until);
    const int count = c->row_count;
    for (int i = 0; i < count; ++i)
        rows[i] = c->rows[(c->first_row + i) % FST_CREW_ROWS];
    c->first_row = (c->first_row + count) % FST_CREW_ROWS;
    c->row_count = 0;
    *busy = c->busy > 0;
    pthread_cond_broadcast(&c->room_came);
    pthread_mutex_unlock(&c->lock);
    return count;
}

void fst_crew_stop(fst_crew *c, int abandon)
{
    pthread_mutex_lock(&c->lock);
    c->stopping = 1;
    c->abandoned = c->abandoned || abandon;
    pthread_cond_broadcast(&c->task_came);
    pthread_cond_broadcast(&c->room_came);
    pthread_mutex_unlock(&c->lock);
}

/* The locks and the conditions; the one that is waited for with a limit counts by the monotonic clock. */
static void begin_locks(fst_crew *c)
{
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_mutex_init(&c->lock, NULL);
    pthread_cond_init(&c->task_came, NULL);
    pthread_cond_init(&c->row_came, &monotonic);
    pthread_cond_init(&c->room_came, NULL);
    pthread_condattr_destroy(&monotonic);
}

fst_status fst_crew_new(const fst_sweep_identity *identity, const fst_crew_plan *plan, fst_crew **crew,
                        fst_error *error)
{
    fst_crew *c = calloc(1, sizeof *c);
    *crew = c;
    if (!c)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    c->identity = identity;
    c->plan = *plan;
    c->plan.depth = plan->depth < FST_CREW_TASKS ? plan->depth : FST_CREW_TASKS;
    begin_locks(c);
    const int wanted = plan->threads < MOST_THREADS ? plan->threads : MOST_THREADS;
    pthread_mutex_lock(&c->lock);
    while (c->started < wanted && pthread_create(&c->threads[c->started], NULL, labour, c) == 0) {
        c->started += 1;
        c->busy += 1;
    }
    pthread_mutex_unlock(&c->lock);
    if (c->started > 0)
        return FST_OK;
    (void)fst_crew_end(c, NULL);
    *crew = NULL;
    return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "no thread could be started");
}

fst_status fst_crew_end(fst_crew *c, fst_error *error)
{
    if (!c)
        return FST_OK;
    for (int i = 0; i < c->started; ++i)
        pthread_join(c->threads[i], NULL);
    const fst_status status = c->status;
    if (status != FST_OK && error)
        *error = c->error;
    pthread_cond_destroy(&c->room_came);
    pthread_cond_destroy(&c->row_came);
    pthread_cond_destroy(&c->task_came);
    pthread_mutex_destroy(&c->lock);
    fst_images_free(c->found);
    fst_images_free(c->made);
    free(c);
    return status;
}
