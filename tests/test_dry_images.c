/* Rows under dry friction: whatever the arithmetic they are done with, and however often they are broken off
 * and go on from an image, in slip, stick or onset, they have the bits of fst_run(). */
#include <stdio.h>
#include <stdlib.h>

#include "lanes/lanes.h"
#include "physics.h"
#include "same_results.h"

enum { JOBS = 8 };

static fst_params job_params(int i)
{
    fst_params p = bead_at(0.215 + 0.1 * (i / 4), i & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.friction_law = i % 4 == 3 ? FST_FRICTION_ROLLING : FST_FRICTION_COULOMB;
    p.friction_mu = 0.2 + 0.1 * (i % 4);
    if (i == 2)
        p.friction_mu_static = 0.5;
    if (i == 6)
        p.friction_rolling_resistance = 0.3;
    if (i == 5) /* lanes do this row; the others are done alone */
        p.friction_law = FST_FRICTION_VISCOUS;
    p.run_periods = 25;
    p.run_discard = 5;
    return p;
}

typedef struct store {
    int next, patience, looks, broken_off, found;
    int done[JOBS];
    fst_run_result results[JOBS];
    fst_status statuses[JOBS];
    void *images[JOBS];
    size_t sizes[JOBS];
} store;

static int next_job(void *user, fst_row_job *job)
{
    store *s = user;
    while (s->next < JOBS && s->done[s->next])
        ++s->next;
    if (s->next == JOBS)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = s->next++;
    job->params = job_params((int)job->point);
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    (void)error;
    store *s = user;
    s->done[job->point] = 1;
    s->results[job->point] = *result;
    s->statuses[job->point] = status;
    return 0;
}

static fst_status answer(void *user, double fraction, const char *what, fst_error *error)
{
    store *s = user;
    (void)fraction, (void)what;
    if (s->patience == 0 || ++s->looks <= s->patience)
        return FST_OK;
    (void)snprintf(error->sentence, sizeof error->sentence, "no more patience");
    return error->code = FST_INTERRUPTED;
}

static void save(void *user, const fst_row_job *job, const void *bytes, size_t size)
{
    store *s = user;
    free(s->images[job->point]);
    s->images[job->point] = malloc(size);
    assert_non_null(s->images[job->point]);
    memcpy(s->images[job->point], bytes, size);
    s->sizes[job->point] = size;
}

static void *find(void *user, const fst_row_job *job, size_t *size)
{
    store *s = user;
    void *bytes = s->images[job->point];
    s->images[job->point] = NULL;
    *size = s->sizes[job->point];
    s->found += bytes != NULL;
    return bytes;
}

/* Does all jobs, broken off again and again, each time after some more questions than before, so that it ends.
 */
static void do_all(store *s, fst_arithmetic arithmetic, int lanes, int patience)
{
    const fst_row_images images = {.user = s, .seconds = 0.0, .save = save, .find = find};
    fst_status status = FST_INTERRUPTED;
    s->patience = patience;
    while (status == FST_INTERRUPTED) {
        const fst_progress progress = {s, answer};
        const fst_row_work work = {.user = s,
                                   .arithmetic = arithmetic,
                                   .lanes = lanes,
                                   .next = next_job,
                                   .done = job_done,
                                   .progress = &progress};
        fst_error error = {FST_OK, "", ""};
        s->next = s->looks = 0;
        status = fst_rows_with_images(&work, &images, &error);
        if (status != FST_OK && status != FST_INTERRUPTED)
            fail_msg("fst_rows_with_images: %s", error.sentence);
        s->broken_off += status == FST_INTERRUPTED;
        s->patience += patience > 0;
    }
    for (int i = 0; i < JOBS; ++i) {
        assert_true(s->done[i]);
        free(s->images[i]);
    }
}

/* The rows that are done one by one have the bits of fst_run() in every form. */
static void check_rows(const store *s, const store *runs, fst_arithmetic arithmetic)
{
    for (int i = 0; i < JOBS; ++i) {
        const int in_lanes = job_params(i).friction_law == FST_FRICTION_VISCOUS;
        if (in_lanes && arithmetic != FST_ARITHMETIC_PORTABLE)
            continue;
        if (s->statuses[i] != runs->statuses[i])
            fail_msg("%d times broken off: job %d, form %d: status %d, of the run %d", s->broken_off, i,
                     (int)arithmetic, (int)s->statuses[i], (int)runs->statuses[i]);
        if (s->statuses[i] == FST_OK)
            check_same_result(i, &s->results[i], &runs->results[i]);
    }
}

static void test_bits(void **unused)
{
    (void)unused;
    static store runs, rows, broken;
    for (int i = 0; i < JOBS; ++i) {
        const fst_params p = job_params(i);
        const fst_run_options options = fst_default_run_options();
        fst_error error = {FST_OK, "", ""};
        runs.statuses[i] = fst_run(&p, &options, &runs.results[i], &error);
    }
    for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form)
        for (int lanes = 1; lanes <= 8; lanes *= 2) {
            if (lanes == 2 || (lanes > 1 && !fst_lane_engine_of((fst_arithmetic)form, lanes)) ||
                (lanes == 1 && form != FST_ARITHMETIC_PORTABLE))
                continue;
            memset(&rows, 0, sizeof rows);
            do_all(&rows, (fst_arithmetic)form, lanes, 0);
            check_rows(&rows, &runs, (fst_arithmetic)form);
            memset(&broken, 0, sizeof broken);
            do_all(&broken, (fst_arithmetic)form, lanes, 1);
            check_rows(&broken, &runs, (fst_arithmetic)form);
            assert_true(broken.broken_off > 5 && broken.found > 5);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bits),
    };
    return cmocka_run_group_tests_name("dry_images", tests, NULL, NULL);
}
