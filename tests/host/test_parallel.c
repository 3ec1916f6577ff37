/* test_parallel.c - independent pieces of work: the result does not tell how many threads did it.
 * tests: host/parallel.c
 * labels: threads */
#include "numeric.h"

#include <festoon/festoon_tools.h>

#include "base/error.h"

enum { PIECES = 500 };

typedef struct job {
    int results[PIECES];
    int fails_from; /* this piece and all later ones fail */
    int told;       /* the greatest number of finished pieces that was reported */
    int patience;   /* progress ends the work after so many pieces */
} job;

static fst_status square(void *user, int index, fst_error *error)
{
    job *all = user;
    if (index >= all->fails_from)
        return fst_fail(error, FST_NOT_FINITE, "square", "piece %d", index);
    all->results[index] = index * index;
    return FST_OK;
}

static fst_status watch(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    job *all = user;
    const int done = (int)lround(fraction * PIECES);
    assert_true(done >= all->told);
    all->told = done;
    return done > all->patience ? fst_fail(error, FST_INTERRUPTED, "watch", "enough") : FST_OK;
}

static void all_pieces_are_done_once(void **state)
{
    (void)state;
    job all = {.fails_from = PIECES, .patience = PIECES};
    const fst_progress progress = {&all, watch};
    fst_work work = {.user = &all, .count = PIECES, .piece = square, .progress = &progress};
    assert_int_equal(fst_parallel(&work, NULL), FST_OK);
    for (int i = 0; i < PIECES; i++)
        assert_int_equal(all.results[i], i * i);
    work.count = 0;
    assert_int_equal(fst_parallel(&work, NULL), FST_OK);
}

static void the_first_failure_is_the_one_told(void **state)
{
    (void)state;
    job all = {.fails_from = 100, .patience = PIECES};
    fst_work work = {.user = &all, .count = PIECES, .piece = square};
    fst_error error;
    assert_int_equal(fst_parallel(&work, &error), FST_NOT_FINITE);
    assert_string_equal(error.sentence, "piece 100");
    assert_int_equal(all.results[99], 99 * 99);
}

static void progress_can_end_the_work(void **state)
{
    (void)state;
    job all = {.fails_from = PIECES, .patience = -1};
    const fst_progress progress = {&all, watch};
    fst_work work = {.user = &all, .count = PIECES, .piece = square, .progress = &progress};
    fst_error error;
    assert_int_equal(fst_parallel(&work, &error), FST_INTERRUPTED);
    assert_string_equal(error.sentence, "enough");
}

/* A piece that lasts until it is told to end. */
static fst_status last(void *user, int index, fst_error *error)
{
    const fst_progress *asking = user;
    fst_status status = FST_OK;
    (void)index;
    while (status == FST_OK)
        status = asking->tell(asking->user, 0.0, NULL, error);
    return status;
}

static fst_status refuse(void *user, double fraction, const char *what, fst_error *error)
{
    (void)user, (void)fraction, (void)what;
    return fst_fail(error, FST_INTERRUPTED, "refuse", "enough");
}

static void a_long_piece_learns_that_the_work_is_ended(void **state)
{
    (void)state;
    fst_progress asking;
    const fst_progress progress = {NULL, refuse};
    const fst_work work = {&asking, 4, last, &progress, &asking};
    fst_error error;
    assert_int_equal(fst_parallel(&work, &error), FST_INTERRUPTED);
    assert_string_equal(error.sentence, "enough");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_pieces_are_done_once),
        cmocka_unit_test(the_first_failure_is_the_one_told),
        cmocka_unit_test(progress_can_end_the_work),
        cmocka_unit_test(a_long_piece_learns_that_the_work_is_ended),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
