/* A part of a window in which the motion repeats itself is not observed (observe/left_out.h): means, marks and
 * returns are those of a window that was observed from end to end, and an orbit that is left is noticed.
 * tests: observe/left_out.c
 * labels: numbers */
#include "branches.h"
#include "physics.h"

#include "observe/means.h"
#include "study/conclude.h"

typedef struct observed {
    fst_run_result result;
    int64_t returns, periods;
    int kept, left_out, failed;
    double kept_t[FST_MARKS + 1];
} observed;

/* A run as lanes make it: `leaves` a part out if it repeats itself. */
static observed observe(const fst_params *p, const double *start, int leaves)
{
    fst_watched_run run;
    observed seen = {.left_out = 0};
    assert_int_equal(fst_watched_run_begin(&run, p, start, NULL), FST_OK);
    fst_window *w = &run.window;
    fst_left_out *part = &w->returns.left_out;
    const fst_twofold end = {w->span.until, 0.0};
    w->span.asked_at_end = 1;
    part->rtol = p->run_rtol;
    part->limit = fmax(1e-9, 10.0 * p->run_rtol);
    while (fst_twofold_difference(end, run.flow->t) > 0 && !seen.failed) {
        assert_int_equal(fst_watched_run_step(&run, w->span.until, NULL), FST_OK);
        seen.failed = part->state == FST_LEFT_OUT_FAILED;
        if (!leaves || !w->returns.crossed || w->returns.crossings % 2 == 0 ||
            !fst_left_out_begin(part, &w->returns.marks, &w->span))
            continue;
        for (; run.flow->t.high < fst_left_out_until(part, &w->span); ++seen.left_out)
            assert_int_equal(fst_flow_step(run.flow, w->span.until, NULL), FST_OK);
        fst_window_pass_left_out(w, run.flow);
    }
    int needs_exponent;
    fst_result_clear(&seen.result);
    assert_int_equal(fst_conclude(&run, NULL, &seen.result, &needs_exponent, NULL), FST_OK);
    assert_true(seen.failed || !leaves || seen.left_out == 0 || part->state == FST_LEFT_OUT_DONE);
    seen.returns = w->returns.marks.offered;
    seen.periods = w->periods.offered;
    seen.kept = w->returns.marks.count;
    for (int i = 0; i < seen.kept; ++i)
        seen.kept_t[i] = w->returns.marks.kept[i].t.high;
    fst_watched_run_free(&run);
    return seen;
}

/* Error bars and what a single return shows better than many are not means. */
static int is_compared(const char *name)
{
    return !strstr(name, "_error") && strcmp(name, "energy_residual") != 0;
}

static void check_equal(const fst_params *p)
{
    const observed whole = observe(p, NULL, 0), part = observe(p, NULL, 1);
    assert_true(part.left_out > 500);
    assert_false(part.failed);
    assert_int_equal(part.returns, whole.returns);
    assert_int_equal(part.periods, whole.periods);
    assert_int_equal(part.result.returns, whole.result.returns);
    assert_int_equal(part.result.regime, whole.result.regime);
    assert_int_equal(part.result.symmetry, whole.result.symmetry);
    assert_int_equal(part.kept, whole.kept);
    for (int i = 0; i < part.kept; ++i)
        CHECK_CLOSE(part.kept_t[i], whole.kept_t[i], 1e-8);
    for (int k = 0; k < fst_result_count(); ++k) {
        const fst_result_info *info = fst_result_at(k);
        double a, b;
        memcpy(&a, (const char *)&whole.result + info->offset, sizeof a);
        memcpy(&b, (const char *)&part.result + info->offset, sizeof b);
        if (!(isnan(a) && isnan(b)) && is_compared(info->name) && !(fabs(a - b) <= 1e-10 * fmax(1.0, fabs(a))))
            fail_msg("%s: %.17g, with a part left out %.17g", info->name, a, b);
    }
    assert_memory_equal(whole.result.final_state, part.result.final_state, sizeof part.result.final_state);
}

static fst_params long_run(double frequency)
{
    fst_params p = fst_default_params();
    p.drive_frequency = frequency;
    p.run_periods = 200;
    p.run_discard = 60;
    return p;
}

static void test_viscous(void **unused)
{
    (void)unused;
    static const double frequencies[] = {10.7, 14.5, 19.9, 18.3};
    for (size_t i = 0; i < sizeof frequencies / sizeof *frequencies; ++i) {
        const fst_params p = long_run(frequencies[i]);
        check_equal(&p);
    }
}

static void test_dry(void **unused)
{
    (void)unused;
    fst_params p = long_run(10.7);
    p.friction_law = FST_FRICTION_COULOMB;
    check_equal(&p);
}

typedef struct store {
    const fst_params *params;
    const double *start;
    fst_run_result result;
    int given;
} store;

static int next_job(void *user, fst_row_job *job)
{
    store *s = user;
    if (s->given++)
        return 0;
    memset(job, 0, sizeof *job);
    job->params = *s->params;
    job->has_start = 1;
    memcpy(job->start, s->start, sizeof job->start);
    return 1;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    (void)job, (void)error;
    assert_int_equal(status, FST_OK);
    ((store *)user)->result = *result;
    return 0;
}

/* In lanes such a run begins anew and is observed from end to end. */
static void check_row_of_unstable(const fst_params *p, const double *start)
{
    const observed whole = observe(p, start, 0);
    store s = {.params = p, .start = start};
    const fst_row_work work = {&s, fst_best_arithmetic(), 0, next_job, job_done, NULL};
    fst_error error;
    if (fst_rows(&work, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_int_equal(s.result.regime, whole.result.regime);
    assert_int_equal(s.result.symmetry, whole.result.symmetry);
    CHECK_CLOSE(s.result.mean_r, whole.result.mean_r, 1e-5);
    CHECK_CLOSE(s.result.max_r, whole.result.max_r, 1e-6);
    CHECK_CLOSE(s.result.energy_residual, 0.0, 1e-7);
}

/* On an unstable orbit the returns repeat themselves for a while.  The bead leaves it where nobody looks. */
static void test_unstable_orbit_is_noticed(void **unused)
{
    (void)unused;
    const fst_params scene = scene_of(0.26, "rigid");
    const fst_branch_options options = over_omega(FST_BRANCH_COUNTER, 0.25, 0.28);
    fst_branch branch = followed(&scene, &options);
    const fst_branch_point *unstable = NULL;
    for (size_t i = 0; i < branch.point_count; ++i)
        if (!branch.points[i].stable && branch.points[i].symmetry == FST_SYMMETRY_S2 &&
            (!unstable || branch.points[i].value < unstable->value))
            unstable = &branch.points[i];
    assert_non_null(unstable);
    fst_params p = scene;
    p.drive_omega = unstable->value;
    p.run_periods = 400;
    p.run_discard = 0;
    p.run_rtol = 1e-12;
    double start[FST_STATE_SIZE]; /* so far beside the orbit that the errors of the steps play no part */
    memcpy(start, unstable->state, sizeof start);
    start[FST_VX] += 1e-10;
    const observed seen = observe(&p, start, 1);
    assert_true(seen.left_out > 0);
    assert_true(seen.failed);
    check_row_of_unstable(&p, start);
    fst_branch_free(&branch);
}

/* run.until: settled ends a run soon, and says of its motion what the long run says. */
static void check_settles(fst_params *p)
{
    const fst_run_options options = fst_default_run_options();
    fst_run_result whole, settled;
    assert_int_equal(fst_run(p, &options, &whole, NULL), FST_OK);
    p->run_until = FST_UNTIL_SETTLED;
    assert_int_equal(fst_run(p, &options, &settled, NULL), FST_OK);
    assert_true(isnan(whole.settled_at));
    assert_true(settled.settled_at > 3 && settled.settled_at < settled.periods);
    assert_true(settled.periods < 0.5 * whole.periods);
    CHECK_CLOSE(settled.end_time * settled.omega / 6.283185307179586, settled.periods, 1e-9);
    assert_int_equal(settled.regime, whole.regime);
    assert_int_equal(settled.symmetry, whole.symmetry);
    CHECK_CLOSE(settled.mean_r, whole.mean_r, 1e-8);
    CHECK_CLOSE(settled.mean_alpha_dot, whole.mean_alpha_dot, 1e-8);
    CHECK_CLOSE(settled.max_r, whole.max_r, 1e-7);
    CHECK_CLOSE(settled.min_b, whole.min_b, 1e-6);
    if (whole.regime == FST_REGIME_COUNTER_ROTATING) {
        CHECK_CLOSE(settled.festoons, whole.festoons, 1e-7);
        assert_true(fabs(settled.mean_r - whole.mean_r) <= 5.0 * settled.mean_r_error);
    }
}

static void test_settled(void **unused)
{
    (void)unused;
    static const double frequencies[] = {10.7, 19.9, 1.0, 30.0};
    for (size_t i = 0; i < sizeof frequencies / sizeof *frequencies; ++i) {
        fst_params p = long_run(frequencies[i]);
        check_settles(&p);
    }
    fst_params dry = long_run(10.7);
    dry.friction_law = FST_FRICTION_COULOMB;
    check_settles(&dry);
}

/* A motion that is never known: the window opens after the discard, and the run goes to its end. */
static void test_not_settled(void **unused)
{
    (void)unused;
    fst_params p = long_run(14.0);
    p.model_kappa = 1.597; /* beside the period halving <n_z> settles slowly */
    p.run_periods = 60;
    p.run_discard = 20;
    p.run_until = FST_UNTIL_SETTLED;
    const fst_run_options options = fst_default_run_options();
    fst_run_result result;
    assert_int_equal(fst_run(&p, &options, &result, NULL), FST_OK);
    assert_int_equal(result.regime, FST_REGIME_UNDECIDED);
    assert_true(isnan(result.settled_at));
    CHECK_CLOSE(result.periods, 60.0, 1e-12);
    assert_true(result.window_periods > 37.0 && result.window_periods < 40.0);
}

/* Means that approach a limit geometrically: the integral over the part is then exact. */
static void test_geometric_approach(void **unused)
{
    (void)unused;
    enum { BEFORE = 5, RETURNS = 40 };
    const double rho = 0.8, limit = 2.0, excess = 1e-11, turn = 3.0;
    const fst_span span = {.until = turn * (BEFORE + RETURNS + 6), .asked_at_end = 1};
    fst_left_out part = {.rtol = 1e-10, .limit = 1e-9};
    fst_mark_series marks;
    fst_quadrature q = {.has_dense = 0};
    fst_mark mark = {.bead_angle = 0.0};
    double integral = 0.0, distance = 1e-10;
    int begun = 0;
    fst_marks_begin(&marks);
    for (int i = 0; i < BEFORE + RETURNS + 2; ++i) {
        mark.t = (fst_twofold){turn * i, 0.0};
        mark.bead_angle = -FST_TWO_PI * i;
        mark.full_distance = distance;
        mark.integrals[FST_Q_R] = begun && i > BEFORE ? integral - 7.0 : integral; /* what was not added up */
        if (!begun || i >= BEFORE + RETURNS) {
            if (begun && part.state == FST_LEFT_OUT_AWAY)
                part.state = FST_LEFT_OUT_FIRST;
            if (begun)
                fst_left_out_end(&part, &mark, &marks, &q);
            else
                fst_marks_offer(&marks, &mark);
            begun = begun || fst_left_out_begin(&part, &marks, &span);
        }
        integral += turn * (limit + excess * pow(rho, i));
        distance *= rho;
    }
    assert_int_equal(part.state, FST_LEFT_OUT_DONE);
    assert_int_equal(marks.offered, BEFORE + RETURNS + 2);
    CHECK_CLOSE(q.left_out[FST_Q_R], 7.0, 1e-13);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_viscous),
        cmocka_unit_test(test_dry),
        cmocka_unit_test(test_unstable_orbit_is_noticed),
        cmocka_unit_test(test_settled),
        cmocka_unit_test(test_not_settled),
        cmocka_unit_test(test_geometric_approach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
