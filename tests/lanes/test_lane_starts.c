/* Rows that start from given states have the numbers of fst_run() from the same starts, in every engine of
 * lanes, and also along a chain, where each run starts from the end state of the one before.
 * tests: study/lane_places.c */
#include "physics.h"

enum { CHAINS = 11, LENGTH = 3 };

typedef struct chains {
    int begun;
    double tolerance; /* 0: the bits must agree */
    double end[CHAINS][FST_STATE_SIZE];
} chains;

static fst_params params_of(int chain, int place)
{
    fst_params p = bead_at(0.27 + 0.015 * chain + 0.01 * place, FST_DYNAMICS_RIGID);
    p.run_periods = 5.0;
    p.run_discard = chain % 3;
    return p;
}

/* Each chain has a start of its own, different from its scene's. */
static void first_state(int chain, double *state)
{
    fst_params p = params_of(chain, 0);
    p.start_r = 0.7 + 0.02 * chain;
    p.start_phi = 40.0 * chain;
    fst_model *model = model_of(&p);
    start_of(&p, model, state);
    fst_model_free(model);
}

static int next(void *user, fst_row_job *job)
{
    chains *c = user;
    if (c->begun == CHAINS)
        return 0;
    memset(job, 0, sizeof *job);
    job->point = 100 * c->begun;
    job->params = params_of(c->begun, 0);
    job->has_start = 1;
    first_state(c->begun, job->start);
    c->begun += 1;
    return 1;
}

static int done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                const fst_error *error)
{
    chains *c = user;
    const int chain = (int)(job->point / 100), place = (int)(job->point % 100);
    fst_run_options options = fst_default_run_options();
    fst_run_result alone;
    (void)error;
    assert_int_equal(status, FST_OK);
    options.start = job->start;
    assert_int_equal(fst_run(&job->params, &options, &alone, NULL), FST_OK);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        CHECK_CLOSE(result->final_state[i], alone.final_state[i], c->tolerance);
    CHECK_CLOSE(result->mean_r, alone.mean_r, c->tolerance);
    memcpy(c->end[chain], result->final_state, sizeof c->end[chain]);
    if (place + 1 == LENGTH)
        return 0;
    job->point += 1;
    job->params = params_of(chain, place + 1);
    memcpy(job->start, result->final_state, sizeof job->start);
    return 1;
}

static void test_rows_begin_where_they_are_told(void **unused)
{
    (void)unused;
    static const fst_arithmetic forms[] = {FST_ARITHMETIC_PORTABLE, FST_ARITHMETIC_PORTABLE,
                                           FST_ARITHMETIC_PORTABLE, FST_ARITHMETIC_AVX2, FST_ARITHMETIC_AVX512};
    static const int lanes[] = {1, 4, 8, 4, 8};
    for (int i = 0; i < 5; ++i) {
        chains c = {.begun = 0, .tolerance = forms[i] == FST_ARITHMETIC_PORTABLE ? 0.0 : 1e-7};
        const fst_row_work work = {
            .user = &c, .arithmetic = forms[i], .lanes = lanes[i], .next = next, .done = done};
        fst_error error = {FST_OK, "", ""};
        const fst_status status = fst_rows(&work, &error);
        if (status == FST_UNAVAILABLE) /* this processor lacks the instructions */
            continue;
        assert_int_equal(status, FST_OK);
        assert_int_equal(c.begun, CHAINS);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_rows_begin_where_they_are_told)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
