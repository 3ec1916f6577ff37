#include "host/parallel.h"

#include "base/error.h"

#include <pthread.h>
#include <time.h>
#include <unistd.h>

enum { MOST_THREADS = 64 };

typedef struct crew {
    const fst_work *work;
    pthread_mutex_t lock; /* guards everything below */
    pthread_cond_t changed;
    int next, done, busy;
    int stopped;      /* no new pieces */
    int failed_piece; /* lowest index that failed, or work->count */
    fst_status status;
    fst_error error;
} crew;

static void *labour(void *argument)
{
    crew *all = argument;
    pthread_mutex_lock(&all->lock);
    while (!all->stopped && all->next < all->work->count) {
        int index = all->next++;
        pthread_mutex_unlock(&all->lock);
        fst_error error = {.code = FST_OK};
        fst_status status = all->work->piece(all->work->user, index, &error);
        pthread_mutex_lock(&all->lock);
        all->done++;
        if (status != FST_OK) {
            all->stopped = 1;
            if (index < all->failed_piece) {
                all->failed_piece = index;
                all->status = status;
                all->error = error;
            }
        }
        pthread_cond_signal(&all->changed);
    }
    all->busy--;
    pthread_cond_signal(&all->changed);
    pthread_mutex_unlock(&all->lock);
    return NULL;
}

/* Wait for the crew, but no longer than 20 ms: who is told wants to be asked too. */
static void wait_a_little(crew *all)
{
    struct timespec until;
    (void)clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += 20000000;
    if (until.tv_nsec >= 1000000000) {
        until.tv_nsec -= 1000000000;
        until.tv_sec++;
    }
    (void)pthread_cond_timedwait(&all->changed, &all->lock, &until);
}

/* Watch the crew and report, until nobody works any more; called with the lock held. */
static fst_status watch(crew *all, fst_error *error)
{
    fst_status status = FST_OK;
    while (all->busy > 0) {
        const int told = all->done;
        if (all->work->progress && status == FST_OK) {
            pthread_mutex_unlock(&all->lock);
            status = all->work->progress(all->work->user, told, error);
            pthread_mutex_lock(&all->lock);
            if (status != FST_OK)
                all->stopped = 1;
        }
        if (all->busy > 0 && all->done == told) /* else it changed in the meantime */
            wait_a_little(all);
    }
    return status;
}

fst_status fst_parallel(const fst_work *work, fst_error *error)
{
    crew all = {.work = work, .failed_piece = work->count, .status = FST_OK};
    pthread_mutex_init(&all.lock, NULL);
    pthread_condattr_t clock;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC); /* which nobody sets */
    pthread_cond_init(&all.changed, &clock);
    pthread_condattr_destroy(&clock);
    long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int wanted = processors < 1 ? 1 : processors > MOST_THREADS ? MOST_THREADS : (int)processors;
    if (wanted > work->count)
        wanted = work->count;

    pthread_t threads[MOST_THREADS];
    int started = 0;
    pthread_mutex_lock(&all.lock);
    while (started < wanted && pthread_create(&threads[started], NULL, labour, &all) == 0) {
        started++;
        all.busy++;
    }
    fst_status status = watch(&all, error);
    pthread_mutex_unlock(&all.lock);
    for (int i = 0; i < started; i++)
        pthread_join(threads[i], NULL);
    pthread_cond_destroy(&all.changed);
    pthread_mutex_destroy(&all.lock);

    if (status != FST_OK)
        return status;
    if (wanted > 0 && started == 0)
        return fst_fail(error, FST_NO_MEMORY, "fst_parallel", "no thread could be started");
    if (all.status != FST_OK && error)
        *error = all.error;
    return all.status;
}
