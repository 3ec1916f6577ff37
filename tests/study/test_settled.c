/* Runs that end once their motion is known (run.until: settled): librations, which marks show a motion to be
 * known, and unstable orbits, which do not.
 * tests: study/settle.c study/standstill.c observe/cycle.c */
#include "branches.h"
#include "few_rows.h"
#include "physics.h"

#include "observe/closing.h"
#include "study/conclude.h"
#include "study/regime.h"
#include "study/settle.h"

static fst_params libration(double frequency, double kappa)
{
    fst_params p = fst_default_params();
    p.drive_frequency = frequency;
    p.model_kappa = kappa;
    p.run_until = FST_UNTIL_SETTLED;
    return p;
}

/* Wide and narrow swings, with one maximum of r in a cycle or several, some that cross the section X = 0: the
 * cycle is the same from another start and at another tolerance, and its extremes are those of a long run. */
static void test_librations(void **unused)
{
    (void)unused;
    static const double scenes[][2] = {{7.29, 1.035}, {3.52, 0.287}, {11.06, 2.9}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; ++i) {
        fst_params p = libration(scenes[i][0], scenes[i][1]);
        const fst_run_result first = run_of(&p);
        p.start_r = 0.6;
        p.run_rtol = 1e-11;
        const fst_run_result other = run_of(&p);
        p.run_until = FST_UNTIL_PERIODS;
        p.run_periods = 1.5 * first.settled_at;
        p.run_discard = first.settled_at;
        p.run_rtol = 1e-10;
        const fst_run_result whole = run_of(&p);
        assert_int_equal(first.regime, FST_REGIME_LIBRATING);
        assert_int_equal(other.regime, FST_REGIME_LIBRATING);
        assert_int_equal(whole.regime, FST_REGIME_LIBRATING);
        assert_true(first.settled_at < first.periods && first.periods < 150 &&
                    other.settled_at < other.periods);
        assert_true(isnan(whole.settled_at) && isnan(first.largest_exponent));
        assert_true(first.mean_r_error < 1e-6 && other.mean_r_error < 1e-6);
        CHECK_CLOSE(other.mean_r, first.mean_r, fmin(first.mean_r_error + other.mean_r_error, 1e-8));
        CHECK_CLOSE(other.mean_nz, first.mean_nz, fmin(first.mean_nz_error + other.mean_nz_error, 1e-8));
        CHECK_CLOSE(other.std_r, first.std_r, 1e-8);
        CHECK_CLOSE(first.max_r, whole.max_r, 1e-8);
        CHECK_CLOSE(first.min_r, whole.min_r, 1e-8);
        /* whole drive periods are not whole cycles: their means are less sharp */
        CHECK_CLOSE(first.mean_r, whole.mean_r, 5.0 * whole.mean_r_error);
        CHECK_CLOSE(first.mean_alpha_dot, first.omega, 1e-9);
    }
}

static void fill_row(const void *with, int row, fst_row_job *job)
{
    (void)with;
    static const double scenes[][2] = {{7.29, 1.035}, {10.7, 1.5}, {3.52, 0.287}, {4.0, 1.5}, {11.06, 2.9}};
    job->params = libration(scenes[row][0], scenes[row][1]);
    job->params.run_discard = row == 3 ? 0.0 : 200.0;
}

/* In the portable form a row has the bits of its run; in the fast forms it depends on nothing beside it. */
static void test_rows(void **unused)
{
    (void)unused;
    enum { ROWS = 5 };
    static few_rows rows = {.count = ROWS, .fill = fill_row}, again = {.count = ROWS, .fill = fill_row};
    do_few_rows(&rows, FST_ARITHMETIC_PORTABLE, 4);
    for (int i = 0; i < ROWS; ++i) {
        fst_row_job job;
        fill_row(NULL, i, &job);
        const fst_run_result run = run_of(&job.params);
        assert_memory_equal(run.final_state, rows.results[i].final_state, sizeof run.final_state);
        assert_true(run.settled_at == rows.results[i].settled_at && run.settled_at < run.periods);
        assert_true(run.max_r == rows.results[i].max_r);
        CHECK_CLOSE(run.mean_r, rows.results[i].mean_r, 1e-15);
        assert_int_equal(run.regime, rows.results[i].regime);
    }
    for (int form = FST_ARITHMETIC_AVX2; form <= FST_ARITHMETIC_AVX512; ++form) {
        if (!fst_lane_engine_of((fst_arithmetic)form, 0))
            continue;
        do_few_rows(&again, (fst_arithmetic)form, 0);
        for (int i = 0; i < ROWS; ++i) {
            assert_int_equal(again.results[i].regime, rows.results[i].regime);
            CHECK_CLOSE(again.results[i].mean_r, rows.results[i].mean_r, 1e-8);
            CHECK_CLOSE(again.results[i].max_r, rows.results[i].max_r, 1e-8);
        }
    }
}

/* The number of the mark with which states that come closer by a factor rho each are known, or -1. */
static int known_at(double from, double rho, int marks, double floor)
{
    fst_closing c;
    fst_mark mark = {.full_distance = from};
    fst_closing_begin(&c, 1e-10);
    for (int i = 0; i < marks; ++i) {
        mark.t = (fst_twofold){i, 0.0};
        if (fst_closing_add(&c, &mark, 10.0 * marks))
            return i;
        mark.full_distance = fmax(mark.full_distance * rho, floor * (1.0 + 0.5 * (i % 3)));
    }
    return -1;
}

/* The way that is left is then below 1e-9, and was not at the mark before. */
static void test_way(void **unused)
{
    (void)unused;
    static const double factors[] = {0.6, 0.9, 0.99, 0.995};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; ++i) {
        const double rho = factors[i];
        const int at = known_at(1e-2, rho, 6000, 0.0);
        CHECK_CLOSE(at, ceil(log(1e-7 * (1.0 - rho)) / log(rho)), 1.0);
    }
    /* at least four marks below the limit */
    assert_int_equal(known_at(1e-2, 0.01, 100, 0.0), 4 + 4);
    /* errors of the steps: small beside the limit, or not */
    assert_true(known_at(1e-2, 0.6, 200, 1e-12) > 0);
    assert_int_equal(known_at(1e-2, 0.99, 4000, 1e-10), -1);
    /* what was never far is not known to be attracted */
    assert_int_equal(known_at(5e-7, 0.6, 200, 0.0), -1);
    /* what does not come closer is not known */
    assert_int_equal(known_at(1e-5, 1.0, 2000, 0.0), -1);
}

/* A run from an unstable orbit, whose returns repeat at first, ends on the stable one. */
static void test_unstable_orbit(void **unused)
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
    p.run_until = FST_UNTIL_SETTLED;
    double start[FST_STATE_SIZE];
    memcpy(start, unstable->state, sizeof start);
    start[FST_VX] += 1e-10;
    for (int deceived = 0; deceived < 2; ++deceived) {
        fst_watched_run run;
        fst_run_result result;
        int over = 0, was_known = 0, needs_exponent;
        fst_result_clear(&result);
        assert_int_equal(fst_watched_run_begin(&run, &p, start, NULL), FST_OK);
        run.settling.returns.approached = deceived; /* as if it had come there from far away */
        while (!over) {
            assert_int_equal(fst_watched_run_go_on(&run, 1, &over, NULL), FST_OK);
            was_known |= run.settling.as != FST_SETTLED_NOT && run.flow->t.high < 20.0 * run.window.period;
        }
        assert_int_equal(was_known, deceived);
        assert_int_equal(fst_conclude(&run, NULL, &result, &needs_exponent, NULL), FST_OK);
        assert_int_equal(result.regime, FST_REGIME_COUNTER_ROTATING);
        assert_int_equal(result.symmetry, FST_SYMMETRY_S1);
        assert_true(result.settled_at > 20.0);
        fst_watched_run_free(&run);
    }
    fst_branch_free(&branch);
}

/* The rate at rest is the greatest real part of the eigenvalues that a branch of such states has. */
static void test_rest(void **unused)
{
    (void)unused;
    const fst_params scene = scene_of(0.1, "rigid");
    const fst_branch_options options = over_omega(FST_BRANCH_LOCKED, 0.02, 0.15);
    fst_branch branch = followed(&scene, &options);
    int stable = 0, unstable = 0;
    for (size_t i = 0; i < branch.point_count; ++i) {
        const fst_branch_point *at = &branch.points[i];
        fst_params p = scene;
        p.drive_omega = at->value;
        fst_model *model = model_of(&p);
        const double rate = fst_rest_rate(model, at->state);
        fst_model_free(model);
        double greatest = -INFINITY;
        for (int k = 0; k < at->multipliers; ++k)
            greatest = fmax(greatest, at->multiplier_re[k]);
        CHECK_CLOSE(rate, greatest, 1e-7);
        stable += at->stable;
        unstable += !at->stable;
    }
    assert_true(stable > 3 && unstable > 3);
    fst_branch_free(&branch);
}

/* A bead comes to an unstable place of rest within 1e-6 before it leaves; below the noise of a loose tolerance.
 */
static void test_unstable_rest(void **unused)
{
    (void)unused;
    fst_params p = libration(4.810108227422324, 1.6452284805574213);
    static const double tolerances[] = {1e-7, 1e-4};
    for (int i = 0; i < 2; ++i) {
        p.run_rtol = tolerances[i];
        const fst_run_result result = run_of(&p);
        assert_int_equal(result.regime, FST_REGIME_LIBRATING);
        assert_true(result.max_r - result.min_r > 0.01);
    }
}

/* A soft bead that is put down on the axis, which repels it, does not rest there, whatever the friction. */
static void test_put_down(void **unused)
{
    (void)unused;
    static const int laws[] = {FST_FRICTION_VISCOUS, FST_FRICTION_COULOMB, FST_FRICTION_ROLLING};
    for (size_t i = 0; i < sizeof laws / sizeof *laws; ++i) {
        fst_params p = libration(20.0, 1.5);
        p.friction_law = laws[i];
        p.bead_material = FST_MATERIAL_PARAMAGNETIC;
        p.bead_a = 1e-3;
        p.start_r = 1e-14;
        p.run_periods = 60.0;
        const fst_run_result result = run_of(&p);
        assert_true(isnan(result.settled_at) && result.regime != FST_REGIME_LOCKED);
        assert_true(result.max_r > 0.01);
    }
}

/* A run that was begun, and steps of it until so many drive periods are over, or its end. */
static void begin(fst_watched_run *run, const fst_params *p, const double *start)
{
    assert_int_equal(fst_watched_run_begin(run, p, start, NULL), FST_OK);
}

static void go_on(fst_watched_run *run, double periods)
{
    int over = 0;
    while (!over && run->flow->t.high < periods * run->window.period)
        assert_int_equal(fst_watched_run_go_on(run, 1, &over, NULL), FST_OK);
}

/* Under dry friction a slipping lock that repels the bead is not a rest, from however far it came: of those at 7.7
 * Hz the bead comes to rest at the pair that attracts it, at 8.2 Hz at none. */
static void test_unstable_slipping_rest(void **unused)
{
    (void)unused;
    for (int i = 0; i < 2; ++i) {
        fst_params p = libration(i == 0 ? 7.7 : 8.2, 1.5);
        fst_locked_list locks;
        int rests = 0;
        p.friction_law = FST_FRICTION_COULOMB;
        p.friction_mu = 0.05;
        p.run_periods = 16.0;
        p.run_discard = 0.0;
        assert_int_equal(fst_locked_find(&p, NULL, &locks, NULL), FST_OK);
        assert_int_equal(locks.count, 8);
        for (size_t k = 0; k < locks.count; ++k) {
            fst_watched_run run;
            begin(&run, &p, locks.states[k].state);
            run.settling.has_moved = 1; /* as if it had come from far */
            go_on(&run, INFINITY);
            assert_true((run.settling.as == FST_SETTLED_REST) == locks.states[k].stable);
            rests += locks.states[k].stable;
            fst_watched_run_free(&run);
        }
        assert_int_equal(rests, i == 0 ? 2 : 0);
        fst_locked_free(&locks);
    }
}

/* The error bars of means are those of the window, and take in the way that is left; at rest that is the
 * swing about the place, and where n turns freely all that <n_z> may become. */
static void test_error_bars(void **unused)
{
    (void)unused;
    for (int scene = 0; scene < 3; ++scene) {
        fst_params p = libration(scene == 0 ? 10.7 : 2.0, 1.5);
        if (scene == 2) {
            p.bead_material = FST_MATERIAL_PARAMAGNETIC;
            p.bead_a = 0.05;
        }
        fst_watched_run run;
        begin(&run, &p, NULL);
        go_on(&run, INFINITY);
        assert_int_equal(run.settling.as, scene == 0 ? FST_SETTLED_RETURNS : FST_SETTLED_REST);
        const double omega = run.model->groups.omega,
                     speed = scene == 1 ? run.window.periods.latest.activity : fst_speed_at_end(&run);
        run.settling.way = 0.02;
        const double way = scene == 0 ? 0.02 : speed / omega;
        for (int wide = 0; wide < 2; ++wide) {
            const double bar = wide ? 0.3 : 0.0;
            fst_run_result r = {.omega = omega, .mean_nz = -0.75};
            r.mean_r_error = r.mean_nz_error = r.mean_alpha_dot_error = bar;
            fst_settling_widen_errors(&run, &r);
            CHECK_CLOSE(r.mean_r_error, fmax(bar, way), 1e-15);
            CHECK_CLOSE(r.mean_nz_error, fmax(fmax(bar, way), scene == 2 ? 0.25 : 0.0), 1e-15);
            CHECK_CLOSE(r.mean_alpha_dot_error, fmax(bar, way * omega), 1e-15);
        }
        fst_watched_run_free(&run);
    }
}

/* A window that is not worth the trouble is not begun, and a run whose integrals began before the end of the
 * discard is described from there to its end, to the bit. */
static void test_too_late_to_settle(void **unused)
{
    (void)unused;
    static const double lengths[][2] = {{33.0, 0.0}, {40.0, 20.0}, {30.0, 24.0}};
    for (int i = 0; i < 3; ++i) {
        fst_params p = libration(10.7, 1.5);
        fst_watched_run run;
        p.run_periods = lengths[i][0];
        p.run_discard = lengths[i][1];
        begin(&run, &p, NULL);
        go_on(&run, INFINITY);
        assert_true(isnan(run.settling.settled_at) && run.settling.as == FST_SETTLED_NOT);
        assert_true(run.window.span.from == lengths[i][1] * run.window.period);
        assert_true(run.flow->t.high == lengths[i][0] * run.window.period);
        fst_watched_run_free(&run);
    }
}

/* A bead that moves again at the end of the short window does not rest: the discard goes on, and the run. */
static void test_not_at_rest(void **unused)
{
    (void)unused;
    fst_params p = libration(10.7, 1.5);
    fst_watched_run run;
    fst_run_result result;
    int needs_exponent;
    fst_result_clear(&result);
    begin(&run, &p, NULL);
    go_on(&run, 2.0);
    run.settling.as = FST_SETTLED_REST; /* as if it had been slow */
    run.settling.settled_at = 2.0;
    run.window.span.until = 3.0 * run.window.period;
    go_on(&run, 3.5);
    assert_true(run.settling.as == FST_SETTLED_NOT && isnan(run.settling.settled_at));
    assert_true(run.window.span.until == 200.0 * run.window.period);
    go_on(&run, INFINITY);
    assert_int_equal(fst_conclude(&run, NULL, &result, &needs_exponent, NULL), FST_OK);
    assert_int_equal(result.regime, FST_REGIME_COUNTER_ROTATING);
    assert_true(result.settled_at > 20.0);
    /* a bead that leaves the plate has not settled */
    run.end = (fst_run_end){1, FST_REGIME_EJECTED, 1.0};
    assert_int_equal(fst_conclude(&run, NULL, &result, &needs_exponent, NULL), FST_OK);
    assert_true(result.regime == FST_REGIME_EJECTED && isnan(result.settled_at));
    fst_watched_run_free(&run);
}

/* A bead that is put down at rest is known to rest after the first period and four more. */
static void test_four_periods_at_rest(void **unused)
{
    (void)unused;
    fst_params p = libration(2.0, 1.5);
    fst_run_options options = fst_default_run_options();
    const fst_run_result rest = run_of(&p);
    fst_run_result again;
    assert_int_equal(rest.regime, FST_REGIME_LOCKED);
    options.start = rest.final_state;
    assert_int_equal(fst_run(&p, &options, &again, NULL), FST_OK);
    assert_true(again.settled_at >= 5.0 && again.settled_at < 6.0);
}

/* Returns and cycles are compared by the tolerance of the run. */
static void test_one_limit(void **unused)
{
    (void)unused;
    fst_params p = libration(10.7, 1.5);
    fst_watched_run run;
    p.run_rtol = 2e-9;
    begin(&run, &p, NULL);
    CHECK_CLOSE(run.settling.returns.limit, 2e-8, 1e-20);
    CHECK_CLOSE(run.settling.cycle.closing.limit, 2e-8, 1e-20);
    fst_watched_run_free(&run);
}

/* A ramp ends where its drive has arrived. */
static void test_ramps_are_refused(void **unused)
{
    (void)unused;
    const fst_params p = libration(10.7, 1.5);
    fst_run_options options = fst_default_run_options();
    fst_run_result result;
    fst_error error;
    options.ramp_from = 0.2;
    options.ramp_to = 0.3;
    assert_int_equal(fst_run(&p, &options, &result, &error), FST_BAD_INPUT);
    assert_string_equal(error.where, "run.until");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_librations),
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_way),
        cmocka_unit_test(test_unstable_orbit),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_unstable_rest),
        cmocka_unit_test(test_unstable_slipping_rest),
        cmocka_unit_test(test_put_down),
        cmocka_unit_test(test_error_bars),
        cmocka_unit_test(test_too_late_to_settle),
        cmocka_unit_test(test_not_at_rest),
        cmocka_unit_test(test_four_periods_at_rest),
        cmocka_unit_test(test_ramps_are_refused),
        cmocka_unit_test(test_one_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
