/* threads.h - the one pool of threads: they start together, do one thing, and are waited for together.
 *
 * Pieces of work that are known beforehand go through host/parallel.h, which stands on this.
 */
#ifndef FST_HOST_THREADS_H
#define FST_HOST_THREADS_H

#include <pthread.h>

enum { FST_MOST_THREADS = 256 };

typedef struct fst_threads {
    int count;
    pthread_t ids[FST_MOST_THREADS];
} fst_threads;

/* Number of processors for this process, at least 1: those that it may run on (taskset, a batch system), and no
 * more than an equal part of the machine where `sharers` processes share it. */
int fst_processors(int sharers);

/* Start up to `wanted` threads, fewer where the system has no more; their number, which may be 0.  Call with
 * the lock held that `labour` takes first, and the threads begin when all are there. */
int fst_threads_start(fst_threads *threads, int wanted, void *(*labour)(void *user), void *user);

/* Wait for them. */
void fst_threads_join(fst_threads *threads);

/* A condition that can be waited for with a limit, by the clock that nobody sets: that of the day may be set
 * back by hours. */
void fst_condition_init(pthread_cond_t *condition);
void fst_condition_wait(pthread_cond_t *condition, pthread_mutex_t *lock, double seconds);

#endif
