/* Two sweeps of one file in one process, and reading a file that this process is writing, are refused: SQLite's
 * locks end when any descriptor of the file is closed in the process (src/sweep/lock.h).
 * tests: sweep/lock.c
 * labels: threads */
#include "numeric.h"

#include <fcntl.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>

#include <festoon/festoon_tools.h>

static const char *const axes[] = {"model.kappa=0.5:1.5:6"};

static fst_params short_run(void)
{
    fst_params p = fst_default_params();
    p.run_periods = 8;
    p.run_discard = 4;
    return p;
}

static fst_sweep_options options_of(const fst_progress *progress)
{
    fst_sweep_options o = fst_default_sweep_options();
    o.axes = axes;
    o.axis_count = 1;
    o.threads = 1;
    o.progress = progress;
    return o;
}

/* Whether another process sees SQLite's lock of this process on the file: the 510 bytes behind 2^30 + 2, which
 * every reader and writer of a database holds. */
static int is_locked_by_sqlite(const char *path)
{
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct flock lock = {.l_type = F_WRLCK, .l_whence = SEEK_SET, .l_start = (1 << 30) + 2, .l_len = 510};
        const int descriptor = open(path, O_RDWR);
        _exit(descriptor < 0 || fcntl(descriptor, F_GETLK, &lock) != 0 ? 2 : lock.l_type != F_UNLCK);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status) && WEXITSTATUS(status) < 2);
    return WEXITSTATUS(status);
}

/* The same, or that SQLite is at work on the file: the other call may be about to open or to close it. */
static void expect_refused(fst_status status, const fst_error *error)
{
    assert_int_equal(status, FST_IO);
    if (!strstr(error->sentence, "another call of this process"))
        CHECK_CONTAINS(error->sentence, "this process is itself at work");
}

typedef struct meeting {
    const char *path, *link;
    int calls;
} meeting;

static void expect_own(fst_status status, const fst_error *error)
{
    assert_int_equal(status, FST_IO);
    CHECK_CONTAINS(error->sentence, "this process is itself at work");
}

static fst_status try_everything(void *user, double fraction, const char *what, fst_error *unused)
{
    (void)fraction, (void)what;
    (void)unused;
    meeting *m = user;
    if (m->calls++ > 0)
        return FST_OK;
    const fst_params p = short_run();
    const fst_sweep_options o = options_of(NULL);
    fst_sweep_counts result;
    fst_sweep_table table;
    fst_grid *grid;
    fst_error error = {FST_OK, "", ""};
    assert_true(is_locked_by_sqlite(m->path));
    for (int i = 0; i < 2; ++i) {
        const char *path = i ? m->link : m->path;
        const char *const keys[] = {"mean_r"};
        expect_own(fst_sweep(&p, path, &o, &result, &error), &error);
        expect_own(fst_sweep_export(path, FST_EXPORT_CSV, NULL, stderr, NULL, &error), &error);
        expect_own(fst_sweep_read(path, keys, 1, &table, &error), &error);
        expect_own(fst_sweep_read_grid(path, &grid, &error), &error);
        int is_sweep = 0;
        assert_int_equal(fst_is_sweep(path, &is_sweep, &error), FST_OK);
        assert_true(is_sweep);
        assert_true(is_locked_by_sqlite(m->path));
    }
    return FST_OK;
}

static void a_second_sweep_is_refused(void **state)
{
    (void)state;
    char folder[] = "/tmp/festoon-own-XXXXXX", path[64], other[64];
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/a.db", folder);
    (void)snprintf(other, sizeof other, "%s/b.db", folder);
    assert_int_equal(symlink("a.db", other), 0);
    meeting m = {path, other, 0};
    const fst_params p = short_run();
    const fst_progress progress = {&m, try_everything};
    const fst_sweep_options o = options_of(&progress), quiet = options_of(NULL);
    fst_sweep_counts result;
    fst_error error = {FST_OK, "", ""};
    if (fst_sweep(&p, path, &o, &result, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    assert_true(m.calls > 0);
    assert_int_equal(result.there, 6);
    /* The file is free afterwards. */
    assert_int_equal(fst_sweep(&p, path, &quiet, &result, &error), FST_OK);
    assert_int_equal(result.added, 0);
    assert_int_equal(unlink(other), 0);
    assert_int_equal(unlink(path), 0);
    assert_int_equal(rmdir(folder), 0);
}

/* Threads that begin a sweep of one file at the same moment: at least one finishes it, and each other one is
 * refused or comes after it. */
typedef struct racer {
    pthread_barrier_t *start;
    const char *path;
    fst_status status;
    fst_error error;
} racer;

static void *race(void *user)
{
    racer *r = user;
    const fst_params p = short_run();
    const fst_sweep_options o = options_of(NULL);
    fst_sweep_counts result;
    (void)pthread_barrier_wait(r->start);
    r->status = fst_sweep(&p, r->path, &o, &result, &r->error);
    return NULL;
}

static void threads_that_meet(void **state)
{
    (void)state;
    enum { THREADS = 4, TURNS = 10 };
    char folder[] = "/tmp/festoon-own-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    (void)snprintf(path, sizeof path, "%s/a.db", folder);
    for (int turn = 0; turn < TURNS; ++turn) {
        pthread_barrier_t start;
        pthread_t threads[THREADS];
        racer racers[THREADS];
        int done = 0;
        assert_int_equal(pthread_barrier_init(&start, NULL, THREADS), 0);
        for (int i = 0; i < THREADS; ++i) {
            racers[i] = (racer){.start = &start, .path = path};
            assert_int_equal(pthread_create(&threads[i], NULL, race, &racers[i]), 0);
        }
        for (int i = 0; i < THREADS; ++i)
            assert_int_equal(pthread_join(threads[i], NULL), 0);
        for (int i = 0; i < THREADS; ++i)
            if (racers[i].status == FST_OK)
                ++done;
            else
                expect_refused(racers[i].status, &racers[i].error);
        assert_true(done > 0);
        assert_int_equal(pthread_barrier_destroy(&start), 0);
        assert_int_equal(unlink(path), 0);
    }
    assert_int_equal(rmdir(folder), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_second_sweep_is_refused),
                                       cmocka_unit_test(threads_that_meet)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
