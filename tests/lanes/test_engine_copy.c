/* An engine of lanes may be given to the rows as a copy, in which functions are others: rows have the same
 * bits. The benchmarks put clocks around its functions this way.
 * tests: study/lane_rows.c lanes/engines.c */
#include "physics.h"

#include "lanes/lanes.h"
#include "same_results.h"
#include "study/lane_rows.h"

enum { JOBS = 9 };

typedef struct jobs {
    int next;
    fst_run_result result[JOBS];
} jobs;

/* Every third one has dry friction, for which the engine's companion is asked. */
static int next_job(void *user, fst_row_job *job)
{
    jobs *j = user;
    if (j->next == JOBS)
        return 0;
    *job = (fst_row_job){.point = j->next, .params = fst_default_params()};
    job->params.drive_frequency = 6.0 + 2.0 * j->next;
    job->params.run_periods = 6.0;
    job->params.run_discard = 2.0;
    if (j->next % 3 == 2) {
        job->params.friction_law = FST_FRICTION_COULOMB;
        job->params.friction_mu = 0.2;
    }
    j->next += 1;
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    jobs *j = user;
    assert_int_equal(status, FST_OK);
    (void)error;
    j->result[job->point] = *result;
    return 0;
}

static int tries_of_copy;
static const fst_lane_engine *copied;

static fst_lane_tries counted_try_steps(void *batch)
{
    tries_of_copy += 1;
    return copied->try_steps(batch);
}

static void rows_by(const fst_lane_engine *engine, jobs *j)
{
    fst_error error;
    *j = (jobs){.next = 0};
    const fst_row_work work = {j, FST_ARITHMETIC_PORTABLE, 0, next_job, job_done, NULL};
    assert_int_equal(fst_lane_rows(&work, NULL, engine, &error), FST_OK);
}

static void test_copies(void **state)
{
    (void)state;
    static const fst_arithmetic forms[] = {FST_ARITHMETIC_PORTABLE, FST_ARITHMETIC_AVX2, FST_ARITHMETIC_AVX512};
    static jobs by_engine, by_copy;
    int seen = 0;
    for (int form = 0; form < 3; ++form)
        for (int lanes = 4; lanes <= 8; lanes += 4) {
            copied = fst_lane_engine_of(forms[form], lanes);
            if (!copied)
                continue;
            fst_lane_engine copy = *copied;
            copy.try_steps = counted_try_steps;
            assert_ptr_equal(fst_dry_lane_engine_of(&copy), fst_dry_lane_engine_of(copied));
            tries_of_copy = 0;
            rows_by(copied, &by_engine);
            assert_int_equal(tries_of_copy, 0);
            rows_by(&copy, &by_copy);
            assert_true(tries_of_copy > 0);
            for (int i = 0; i < JOBS; ++i)
                check_same_result(i, &by_engine.result[i], &by_copy.result[i]);
            seen += 1;
        }
    if (seen == 0)
        skip(); /* no lanes on this processor */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_copies)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
