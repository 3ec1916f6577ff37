/* Rows under dry friction: however often they are broken off and go on from an image, in slip, stick or onset,
 * and whatever runs beside them, they have the same bits, in the portable form those of fst_run().
 * tests: study/lane_contact.c study/lone_run.c ode/paced.inl */
#include <stdio.h>
#include <stdlib.h>

#include "lanes/lanes.h"
#include "physics.h"
#include "same_results.h"

enum { JOBS = 15 };

/* What only the last step of a row tells: the turns of the moment and of Phi, where no return ends the means,
 * and the greatest r of a bead on its way out. */
static void special_rows(int which, fst_params *p)
{
    static const double drives[] = {2.2, 1.6, 0.1608}, mu[] = {0.3, 0.3, 0.2};
    *p = bead_at(drives[which], FST_DYNAMICS_RIGID);
    p->friction_law = FST_FRICTION_COULOMB;
    p->friction_mu = mu[which];
    p->run_rtol = 1e-8;
    p->run_discard = which == 2 ? 0.1 : 1;
    p->run_periods = which == 2 ? 1.1 : 2; /* too short for two returns */
}

static fst_params job_params(int i)
{
    fst_params p = bead_at(0.215 + 0.1 * (i / 4), i & 1 ? FST_DYNAMICS_FARAGO2020 : FST_DYNAMICS_RIGID);
    p.friction_law = i % 4 == 3 ? FST_FRICTION_ROLLING : FST_FRICTION_COULOMB;
    p.friction_mu = 0.2 + 0.1 * (i % 4);
    if (i == 2)
        p.friction_mu_static = 0.5;
    if (i == 6)
        p.friction_rolling_resistance = 0.3;
    if (i == 5) /* needs other lanes than its neighbours */
        p.friction_law = FST_FRICTION_VISCOUS;
    if (i == 8) { /* on its way out */
        p.start_r = 1.3;
        p.plate_radius = 0.03;
    }
    if (i == 10) { /* done alone, as the next, and the one that rolling resistance brings to rest */
        p.contact_patch = FST_PATCH_HERTZ;
        p.contact_radius = 5e-5;
    }
    if (i == 11)
        p.impact_restitution = 0.5;
    p.run_periods = i < 10 ? 20 : 6;
    p.run_discard = 4;
    p.run_rtol = 1e-8;
    if (i >= 12)
        special_rows(i - 12, &p);
    return p;
}

typedef struct store {
    int stride, next, patience, looks, broken_off, found;
    int done[JOBS];
    fst_run_result results[JOBS];
    fst_status statuses[JOBS];
    void *images[JOBS];
    size_t sizes[JOBS];
} store;

static int next_job(void *user, fst_row_job *job)
{
    store *s = user;
    while (s->next < JOBS && s->done[s->next * s->stride % JOBS])
        ++s->next;
    if (s->next == JOBS)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = s->next++ * s->stride % JOBS;
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

/* Does all jobs, in the order of multiples of `stride`, broken off again and again, each time after some more
 * questions than before, so that it ends.
 */
static void do_all(store *s, fst_arithmetic arithmetic, int lanes, int stride, int patience)
{
    memset(s, 0, sizeof *s);
    s->stride = stride;
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
        s->patience += patience > 0 ? 1 + s->patience / 2 : 0;
    }
    for (int i = 0; i < JOBS; ++i) {
        assert_true(s->done[i]);
        free(s->images[i]);
    }
}

static void check_rows(const store *s, const store *expected, const char *what)
{
    for (int i = 0; i < JOBS; ++i) {
        if (s->statuses[i] != expected->statuses[i])
            fail_msg("%s, %d times broken off: job %d: status %d, expected %d", what, s->broken_off, i,
                     (int)s->statuses[i], (int)expected->statuses[i]);
        if (s->statuses[i] == FST_OK)
            check_same_result(i, &s->results[i], &expected->results[i]);
    }
}

/* The same motions, to the tolerance. */
static void check_close(const store *s, const store *runs)
{
    for (int i = 0; i < JOBS; ++i) {
        const fst_run_result *a = &s->results[i], *b = &runs->results[i];
        assert_int_equal(a->regime, b->regime);
        if (fabs(a->mean_r - b->mean_r) > 1e-6 || fabs(a->sticking - b->sticking) > 1e-6 ||
            fabs(a->max_slip - b->max_slip) > 1e-6 || fabs(a->max_r - b->max_r) > 1e-6 ||
            fabs(a->mean_friction_power - b->mean_friction_power) > 1e-6)
            fail_msg("job %d: mean_r %.12g, sticking %.12g, max_slip %.12g; of the run %.12g, %.12g, %.12g", i,
                     a->mean_r, a->sticking, a->max_slip, b->mean_r, b->sticking, b->max_slip);
    }
}

/* The rows of a form by as many lanes: as expected in every order, broken off or not. */
static void check_form(fst_arithmetic form, int lanes, const store *runs)
{
    static store rows, again;
    do_all(&rows, form, lanes, 4, 0);
    if (form == FST_ARITHMETIC_PORTABLE) {
        check_rows(&rows, runs, "portable rows");
    } else {
        check_close(&rows, runs);
        do_all(&again, form, lanes, 1, 0);
        check_rows(&again, &rows, "another order");
    }
    do_all(&again, form, lanes, 1, 1);
    check_rows(&again, &rows, "broken off");
    assert_true(again.broken_off > 5 && again.found > 5);
}

static void test_bits(void **unused)
{
    (void)unused;
    static store runs;
    for (int i = 0; i < JOBS; ++i) {
        const fst_params p = job_params(i);
        const fst_run_options options = fst_default_run_options();
        fst_error error = {FST_OK, "", ""};
        runs.statuses[i] = fst_run(&p, &options, &runs.results[i], &error);
    }
    for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form)
        for (int lanes = 1; lanes <= 8; lanes *= 2)
            if ((lanes == 1 && form == FST_ARITHMETIC_PORTABLE) ||
                fst_lane_engine_of((fst_arithmetic)form, lanes))
                check_form((fst_arithmetic)form, lanes, &runs);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bits),
    };
    return cmocka_run_group_tests_name("dry_images", tests, NULL, NULL);
}
