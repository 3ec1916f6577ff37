/* threads.h - the one pool of threads: they start together, run one function, and are waited for together.
 *
 * Work that is a list of independent pieces goes through fst_parallel(), which is built on this.
 */
#ifndef FST_HOST_THREADS_H
#define FST_HOST_THREADS_H

#include <pthread.h>

enum { FST_MOST_THREADS = 256 };

typedef struct fst_threads {
    int count;
    pthread_t ids[FST_MOST_THREADS];
} fst_threads;

/* The number of processors for this process, at least 1: the processors that it may run on (taskset, a batch
 * system), but no more than an equal part of the machine where `sharers` processes share it. */
int fst_processors(int sharers);

/* Start up to `wanted` threads, or fewer where the system has no more; returns how many, which may be 0.  Hold
 * a lock that `labour` takes first: then no thread begins before all of them have started. */
int fst_threads_start(fst_threads *threads, int wanted, void *(*labour)(void *user), void *user);

/* Wait until all have ended. */
void fst_threads_join(fst_threads *threads);

/* A condition that is waited for with a time limit, by a clock that only runs forward (the time of day may be
 * set back). */
void fst_condition_init(pthread_cond_t *condition);
void fst_condition_wait(pthread_cond_t *condition, pthread_mutex_t *lock, double seconds);

#endif
