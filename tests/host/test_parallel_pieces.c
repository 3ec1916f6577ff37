/* Pieces of work side by side: they are at work at the same time, the first error in their order is the one
 * reported, and a process with one processor has one thread at work.
 * tests: host/parallel.c host/threads.c
 * labels: threads */
#define _GNU_SOURCE /* sched_setaffinity() */
#include "numeric.h"

#include <pthread.h>
#include <sched.h>
#include <time.h>

#include <festoon/festoon_tools.h>

#include "base/error.h"
#include "host/threads.h"

typedef struct meeting {
    pthread_mutex_t lock;
    pthread_cond_t came;
    int here, met, first_is_over;
} meeting;

/* Waits until both pieces are at work; 0 if the other one does not come. */
static int meet(meeting *m)
{
    struct timespec until;
    int patient = 1;
    (void)clock_gettime(CLOCK_REALTIME, &until);
    until.tv_sec += 60; /* ends the test only if they never meet */
    pthread_mutex_lock(&m->lock);
    m->here += 1;
    m->met = m->met || m->here == 2;
    pthread_cond_broadcast(&m->came);
    while (!m->met && patient)
        patient = pthread_cond_timedwait(&m->came, &m->lock, &until) == 0;
    const int met = m->met;
    pthread_mutex_unlock(&m->lock);
    return met;
}

static fst_status piece_that_meets(void *user, int index, fst_error *error)
{
    (void)index;
    return meet(user) ? FST_OK : fst_fail(error, FST_IO, "", "the other piece did not come");
}

/* Both fail, the second a little after the first. */
static fst_status piece_that_fails(void *user, int index, fst_error *error)
{
    meeting *m = user;
    if (!meet(m))
        return FST_IO;
    pthread_mutex_lock(&m->lock);
    if (index == 0)
        m->first_is_over = 1;
    pthread_cond_broadcast(&m->came);
    while (!m->first_is_over)
        pthread_cond_wait(&m->came, &m->lock);
    pthread_mutex_unlock(&m->lock);
    if (index == 1)
        (void)nanosleep(&(struct timespec){.tv_nsec = 50000000}, NULL);
    return fst_fail(error, index == 0 ? FST_NOT_FINITE : FST_IO, "", "piece %d", index);
}

static fst_status work_of_two(fst_status (*piece)(void *, int, fst_error *), fst_error *error)
{
    meeting m = {.here = 0};
    pthread_mutex_init(&m.lock, NULL);
    pthread_cond_init(&m.came, NULL);
    const fst_work work = {.user = &m, .count = 2, .piece = piece};
    const fst_status status = fst_parallel(&work, error);
    pthread_cond_destroy(&m.came);
    pthread_mutex_destroy(&m.lock);
    return status;
}

static void pieces_are_at_work_together(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    if (fst_processors(1) < 2)
        skip();
    if (work_of_two(piece_that_meets, &error) != FST_OK)
        fail_msg("%s", error.sentence);
}

static void the_first_failure_is_told(void **state)
{
    (void)state;
    fst_error error = {FST_OK, "", ""};
    if (fst_processors(1) < 2)
        skip();
    assert_int_equal(work_of_two(piece_that_fails, &error), FST_NOT_FINITE);
    assert_string_equal(error.sentence, "piece 0");
}

typedef struct company {
    pthread_mutex_t lock;
    int here, most; /* pieces at work now; the most at any time */
} company;

/* Time for another thread to come. */
static fst_status piece_that_counts(void *user, int index, fst_error *error)
{
    company *c = user;
    (void)index;
    (void)error;
    pthread_mutex_lock(&c->lock);
    c->here += 1;
    c->most = c->here > c->most ? c->here : c->most;
    pthread_mutex_unlock(&c->lock);
    (void)nanosleep(&(struct timespec){.tv_nsec = 2000000}, NULL);
    pthread_mutex_lock(&c->lock);
    c->here -= 1;
    pthread_mutex_unlock(&c->lock);
    return FST_OK;
}

static void threads_keep_to_the_processors_they_were_given(void **state)
{
    (void)state;
    cpu_set_t all, one;
    if (sched_getaffinity(0, sizeof all, &all) != 0)
        skip();
    assert_int_equal(fst_processors(1000000), 1);
    assert_true(fst_processors(1) <= CPU_COUNT(&all));
    size_t first = 0;
    while (!CPU_ISSET(first, &all))
        ++first;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    if (sched_setaffinity(0, sizeof one, &one) != 0)
        skip();
    company c = {.here = 0};
    pthread_mutex_init(&c.lock, NULL);
    const fst_work work = {.user = &c, .count = 20, .piece = piece_that_counts};
    const int processors = fst_processors(1);
    const fst_status status = fst_parallel(&work, NULL);
    assert_int_equal(sched_setaffinity(0, sizeof all, &all), 0);
    pthread_mutex_destroy(&c.lock);
    assert_int_equal(status, FST_OK);
    assert_int_equal(processors, 1);
    assert_int_equal(c.most, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_are_at_work_together),
        cmocka_unit_test(the_first_failure_is_told),
        cmocka_unit_test(threads_keep_to_the_processors_they_were_given),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
