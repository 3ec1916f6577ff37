/* Runs by the splitting method against runs by events, its order, and its rows in lanes: the same bits whatever
 * the lane, the width and the neighbours. */
#include "physics.h"

#include "lanes/lanes.h"
#include "same_results.h"
#include "study/splitting_run.h"

/* A bead with dry friction, at a frequency in Hz. */
static fst_params dry_bead(double mu, double frequency, double step)
{
    fst_params p = fst_default_params();
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = mu;
    p.drive_frequency = frequency;
    p.run_method = FST_METHOD_SPLITTING;
    p.run_step = step;
    return p;
}

/* ------------------------------------------------------------------ rows */

enum { MOST_JOBS = 64 };

/* Jobs in an order of choice; one that is done is followed by `follows`, if that is 1 for it. */
typedef struct jobs {
    fst_row_job job[MOST_JOBS];
    int follows[MOST_JOBS]; /* the job's end is another one's beginning, whose number this is; 0: none */
    int order[MOST_JOBS], count, next;
    fst_run_result result[MOST_JOBS];
    fst_status status[MOST_JOBS];
    int done[MOST_JOBS];
} jobs;

static int next_job(void *user, fst_row_job *job)
{
    jobs *j = user;
    if (j->next == j->count)
        return 0;
    *job = j->job[j->order[j->next++]];
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    (void)error;
    jobs *j = user;
    const int i = (int)job->point;
    j->result[i] = *result;
    j->status[i] = status;
    j->done[i] += 1;
    if (!j->follows[i])
        return 0;
    *job = j->job[j->follows[i]];
    memcpy(job->start, result->final_state, sizeof job->start);
    job->has_start = 1;
    return 1;
}

static void do_jobs(jobs *j, fst_arithmetic arithmetic, int lanes)
{
    const fst_row_work work = {
        .user = j, .arithmetic = arithmetic, .lanes = lanes, .next = next_job, .done = job_done};
    fst_error error = {FST_OK, "", ""};
    j->next = 0;
    memset(j->done, 0, sizeof j->done);
    if (fst_rows(&work, &error) != FST_OK)
        fail_msg("fst_rows: %s", error.sentence);
}

/* Twenty short runs of many kinds: other numbers of lines, ends, lengths and methods, one that cannot begin,
 * and one that follows another. */
static void make_jobs(jobs *j)
{
    memset(j, 0, sizeof *j);
    j->count = 20;
    for (int i = 0; i < j->count; ++i) {
        fst_params p = dry_bead(0.1 + 0.02 * i, 8.0 + 1.3 * i, 0.05 + 0.005 * (i % 3));
        p.run_periods = 20 + i;
        p.run_discard = 8;
        p.start_phi = 20.0 * i;
        p.start_r = 0.5 + 0.05 * i;
        p.magnet_lines = i % 7 == 3 ? 3 : 5;
        p.run_method = i % 9 == 4 ? FST_METHOD_EVENTS : FST_METHOD_SPLITTING;
        if (i == 6)
            p.model_dynamics = FST_DYNAMICS_FARAGO2020; /* refused */
        j->job[i].params = p;
        j->job[i].point = i;
        j->order[i] = i;
    }
    j->follows[2] = 19;
    j->follows[3] = 18;
    j->count = 18;
}

static void check_rows(const jobs *want, const jobs *got)
{
    for (int i = 0; i < 20; ++i) {
        assert_int_equal(got->done[i], 1);
        assert_int_equal(got->status[i], want->status[i]);
        check_same_result(i, &got->result[i], &want->result[i]);
    }
}

static void test_same_bits_in_every_lane(void **unused)
{
    (void)unused;
    static jobs want, got;
    static const struct {
        fst_arithmetic arithmetic;
        int lanes, other_lanes;
    } forms[] = {{FST_ARITHMETIC_PORTABLE, 1, 4},
                 {FST_ARITHMETIC_PORTABLE, 1, 8},
                 {FST_ARITHMETIC_AVX2, 4, 4},
                 {FST_ARITHMETIC_AVX512, 8, 8}};
    for (size_t f = 0; f < sizeof forms / sizeof *forms; ++f) {
        if (forms[f].other_lanes > 1 && !fst_lane_engine_of(forms[f].arithmetic, forms[f].other_lanes))
            continue;
        make_jobs(&want);
        do_jobs(&want, forms[f].arithmetic, forms[f].lanes);
        for (int turn = 1; turn < 18; turn += 5) { /* other neighbours, other lanes */
            make_jobs(&got);
            for (int i = 0; i < got.count; ++i)
                got.order[i] = (7 * i + turn) % got.count;
            do_jobs(&got, forms[f].arithmetic, forms[f].other_lanes);
            check_rows(&want, &got);
        }
    }
    assert_int_equal(want.result[0].regime, FST_REGIME_EJECTED);
    assert_int_equal(want.status[6], FST_BAD_INPUT);
}

/* The portable rows have the bits of fst_run(). */
static void test_bits_of_a_single_run(void **unused)
{
    (void)unused;
    static jobs rows;
    make_jobs(&rows);
    do_jobs(&rows, FST_ARITHMETIC_PORTABLE, fst_lane_engine_of(FST_ARITHMETIC_PORTABLE, 4) ? 4 : 1);
    for (int i = 0; i < 18; ++i)
        if (rows.status[i] == FST_OK) {
            const fst_run_result alone = run_of(&rows.job[i].params);
            check_same_result(i, &rows.result[i], &alone);
        }
}

/* ------------------------------------------------------------------ the order */

/* The state after some drive periods in `steps` steps. */
static void split_state(const fst_params *params, const double *start, double periods, double steps,
                        double *end)
{
    fst_params p = *params;
    p.run_periods = periods;
    p.run_discard = 0.0;
    fst_splitting_run run;
    fst_splitting_outcome outcome;
    static _Alignas(64) char memory[1 << 16];
    assert_int_equal(fst_splitting_begin(&run, &p, start, NULL), FST_OK);
    run.job.steps = steps;
    run.job.h = periods * run.period / steps;
    fst_splitting_prepare(&run.job);
    assert_true(fst_splitting_scalar.bytes <= sizeof memory);
    fst_splitting_scalar.load(memory, 0, &run.job);
    while (!fst_splitting_scalar.go_on(memory, 1000))
        ;
    fst_splitting_outcome_of(&fst_splitting_scalar, memory, 0, &run.job, &outcome);
    memcpy(end, outcome.state, sizeof outcome.state);
    fst_splitting_free(&run);
}

/* The slope of a line through log(error) over log(step). */
static double fitted_slope(const double *steps, const double *errors, int count)
{
    double x = 0, y = 0, xx = 0, xy = 0;
    for (int i = 0; i < count; ++i) {
        const double lx = -log(steps[i]), ly = log(errors[i]);
        x += lx;
        y += ly;
        xx += lx * lx;
        xy += lx * ly;
    }
    return (count * xy - x * y) / (count * xx - x * x);
}

/* Through some twenty captures and as many releases, from several starts. */
static void test_order_of_the_state(void **unused)
{
    (void)unused;
    enum { COUNT = 7, STARTS = 6, PERIODS = 8 };
    fst_params p = dry_bead(0.2, 10.7, 0.02);
    fst_model *model = model_of(&p);
    double steps[COUNT], errors[COUNT] = {0};
    for (int k = 0; k < STARTS; ++k) {
        double start[FST_STATE_SIZE], exact[FST_STATE_SIZE], end[FST_STATE_SIZE];
        p.start_phi = 15.0 * k;
        start_of(&p, model, start);
        state_after(model, 1e-13, start, PERIODS * TWO_PI / fst_model_groups(model).omega, exact);
        for (int i = 0; i < COUNT; ++i) {
            steps[i] = floor(2000 * pow(2.0, i));
            split_state(&p, start, PERIODS, steps[i], end);
            errors[i] += greatest_difference(end, exact, FST_STATE_SIZE) / STARTS;
        }
    }
    for (int i = 0; i < COUNT; ++i)
        CHECK_WITHIN(fitted_slope(steps, errors, COUNT), 1.9, 2.1);
    assert_true(errors[COUNT - 1] < 1e-5);
    fst_model_free(model);
}

/* ------------------------------------------------------------------ bad input */

static void check_refused(const fst_params *p, const char *part)
{
    fst_run_result result;
    fst_error error = {FST_OK, "", ""};
    const fst_run_options options = fst_default_run_options();
    assert_int_equal(fst_run(p, &options, &result, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, part);
    CHECK_CONTAINS(error.sentence, "run.method = events");
}

static void test_refusals(void **unused)
{
    (void)unused;
    fst_params p = dry_bead(0.2, 10.7, 0.02);
    p.friction_law = FST_FRICTION_VISCOUS;
    check_refused(&p, "coulomb");
    p = dry_bead(0.2, 10.7, 0.02);
    p.model_dynamics = FST_DYNAMICS_FARAGO2020;
    check_refused(&p, "rigid");
    p = dry_bead(0.2, 10.7, 0.02);
    p.friction_mu_static = 0.3;
    check_refused(&p, "static");
    p = dry_bead(0.2, 10.7, 0.02);
    p.friction_rolling_resistance = 1e-3;
    check_refused(&p, "rolling resistance");
    p = dry_bead(0.2, 10.7, 0.02);
    p.friction_contact_rate = 1.0;
    check_refused(&p, "viscous part");
    p = dry_bead(0.2, 10.7, 0.02);
    p.contact_patch = FST_PATCH_HERTZ;
    p.contact_radius = 1e-5;
    check_refused(&p, "contact.patch point");
    p = dry_bead(0.2, 10.7, 0.02);
    p.impact_restitution = 0.7;
    check_refused(&p, "flight");
    fst_error error = {FST_OK, "", ""};
    p = dry_bead(0.2, 10.7, 0.01);
    assert_int_equal(fst_params_check_effects(&p, &error), FST_OK);
    p.run_method = FST_METHOD_EVENTS;
    assert_int_equal(fst_params_check_effects(&p, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "run.step = 0.01 has no effect");
    p = dry_bead(0.2, 10.7, 1e-6);
    p.run_periods = 1e9;
    fst_run_result result;
    fst_run_options options = fst_default_run_options();
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "run.step");
    p = dry_bead(0.2, 10.7, 0.02);
    options.ramp_from = 0.2;
    options.ramp_to = 0.3;
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "ramps");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_bits_in_every_lane),
        cmocka_unit_test(test_bits_of_a_single_run),
        cmocka_unit_test(test_order_of_the_state),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
