/* Runs that end once their motion is known (run.until: settled): librations, which marks show a motion to be
 * known, and unstable orbits, which do not. */
#include "branches.h"
#include "few_rows.h"
#include "physics.h"

#include "observe/closing.h"
#include "study/conclude.h"
#include "study/settle.h"
#include "study/standstill.h"

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
        CHECK_CLOSE(other.mean_r, first.mean_r, fmin(first.mean_r_error + other.mean_r_error, 1e-8));
        CHECK_CLOSE(other.mean_nz, first.mean_nz, fmin(first.mean_nz_error + other.mean_nz_error, 1e-8));
        CHECK_CLOSE(other.std_r, first.std_r, 1e-8);
        CHECK_CLOSE(first.max_r, whole.max_r, 1e-8);
        CHECK_CLOSE(first.min_r, whole.min_r, 1e-8);
        /* whole drive periods are no whole cycles: their means are less sharp */
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
    p.run_rtol = 1e-7;
    const fst_run_result result = run_of(&p);
    assert_int_equal(result.regime, FST_REGIME_LIBRATING);
    assert_true(result.max_r - result.min_r > 0.01);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_librations), cmocka_unit_test(test_rows),
        cmocka_unit_test(test_way),        cmocka_unit_test(test_unstable_orbit),
        cmocka_unit_test(test_rest),       cmocka_unit_test(test_unstable_rest),
        cmocka_unit_test(test_put_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
