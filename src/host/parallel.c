/* parallel.c - independent pieces of work on several threads; the calling thread tells the caller how far they
 * are. */
#include <festoon/festoon_tools.h>

#include "base/error.h"
#include "base/watch.h"
#include "host/threads.h"

static const double ASK_SECONDS = 0.02; /* between two calls of the caller's tell() */

typedef struct pool {
    const fst_work *work;
    pthread_mutex_t lock; /* guards everything below */
    pthread_cond_t changed;
    int next, done, busy;
    int stopped;      /* no new piece begins ... */
    int refused;      /* ... because the caller wants no more */
    int failed_piece; /* the lowest index of a piece that failed, or work->count */
    fst_status status;
    fst_error error;
} pool;

static void *labour(void *argument)
{
    pool *all = argument;
    pthread_mutex_lock(&all->lock);
    while (!all->stopped && all->next < all->work->count) {
        int index = all->next++;
        pthread_mutex_unlock(&all->lock);
        fst_error error = {.code = FST_OK};
        fst_status status = all->work->piece(all->work->user, index, &error);
        pthread_mutex_lock(&all->lock);
        ++all->done;
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
    --all->busy;
    pthread_cond_signal(&all->changed);
    pthread_mutex_unlock(&all->lock);
    return NULL;
}

/* Tell the caller how far the work is, until no thread works any more.  Called with the lock held. */
static fst_status watch(pool *all, fst_error *error)
{
    fst_status status = FST_OK;
    while (all->busy > 0) {
        const int told = all->done;
        if (all->work->progress && status == FST_OK) {
            pthread_mutex_unlock(&all->lock);
            status = fst_tell(all->work->progress, (double)told / all->work->count, NULL, error);
            pthread_mutex_lock(&all->lock);
            if (status != FST_OK)
                all->stopped = all->refused = 1;
        }
        if (all->busy > 0 && all->done == told) /* else another piece ended meanwhile: tell of it at once */
            fst_condition_wait(&all->changed, &all->lock, ASK_SECONDS);
    }
    return status;
}

/* tell() of work->within. */
static fst_status ask(void *user, double fraction, const char *what, fst_error *error)
{
    pool *all = user;
    (void)fraction;
    (void)what;
    pthread_mutex_lock(&all->lock);
    const int refused = all->refused;
    pthread_mutex_unlock(&all->lock);
    return refused ? fst_fail(error, FST_INTERRUPTED, "fst_parallel", "interrupted") : FST_OK;
}

fst_status fst_parallel(const fst_work *work, fst_error *error)
{
    pool all = {.work = work, .failed_piece = work->count, .status = FST_OK};
    pthread_mutex_init(&all.lock, NULL);
    fst_condition_init(&all.changed);
    if (work->within)
        *work->within = (fst_progress){&all, ask};
    const int processors = fst_processors(1);
    const int wanted = processors < work->count ? processors : work->count;

    fst_threads threads;
    pthread_mutex_lock(&all.lock);
    const int started = all.busy = fst_threads_start(&threads, wanted, labour, &all);
    fst_status status = watch(&all, error);
    pthread_mutex_unlock(&all.lock);
    fst_threads_join(&threads);
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
