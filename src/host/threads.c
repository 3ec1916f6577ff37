/* threads.c - how many threads a process should have, starting them, and waiting for them. */
#define _GNU_SOURCE /* sched_getaffinity() */
#include "host/threads.h"

#include <sched.h>
#include <time.h>
#include <unistd.h>

int fst_processors(int sharers)
{
    cpu_set_t mine;
    const long online = sysconf(_SC_NPROCESSORS_ONLN);
    int count = online > 0 ? (int)online / (sharers > 1 ? sharers : 1) : 1;
    if (sched_getaffinity(0, sizeof mine, &mine) == 0 && CPU_COUNT(&mine) < count)
        count = CPU_COUNT(&mine);
    return count > 1 ? count : 1;
}

int fst_threads_start(fst_threads *threads, int wanted, void *(*labour)(void *user), void *user)
{
    threads->count = 0;
    while (threads->count < wanted && threads->count < FST_MOST_THREADS &&
           pthread_create(&threads->ids[threads->count], NULL, labour, user) == 0)
        ++threads->count;
    return threads->count;
}

void fst_threads_join(fst_threads *threads)
{
    for (int i = 0; i < threads->count; ++i)
        pthread_join(threads->ids[i], NULL);
    threads->count = 0;
}

void fst_condition_init(pthread_cond_t *condition)
{
    pthread_condattr_t monotonic;
    pthread_condattr_init(&monotonic);
    pthread_condattr_setclock(&monotonic, CLOCK_MONOTONIC);
    pthread_cond_init(condition, &monotonic);
    pthread_condattr_destroy(&monotonic);
}

void fst_condition_wait(pthread_cond_t *condition, pthread_mutex_t *lock, double seconds)
{
    struct timespec until;
    (void)clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += (long)(1e9 * seconds);
    until.tv_sec += until.tv_nsec / 1000000000;
    until.tv_nsec %= 1000000000;
    (void)pthread_cond_timedwait(condition, lock, &until);
}
