/* Error bars of means that keep the limit: librations in runs of any length, orbits with the symmetry S2 at
 * loose tolerances, dry rolling; and verdicts that a loose tolerance cannot tell.
 * tests: observe/means.c observe/swings.c study/drift.c
 * labels: numbers */
#include "few_rows.h"
#include "physics.h"

#include "study/conclude.h"

static fst_params bead(double frequency, double kappa)
{
    fst_params p = fst_default_params();
    p.drive_frequency = frequency;
    p.model_kappa = kappa;
    return p;
}

static double error_over_bar(double value, double limit, double bar)
{
    return fabs(value - limit) / bar;
}

/* Cycles of one maximum of r and of several, some of which are nearly commensurate with the drive; the limit is
 * that of a run that may end as soon as its cycle repeats. */
enum { LIBRATIONS = 6 };
static const double LIBRATION[LIBRATIONS][2] = {{15.583, 4.974}, {7.29, 1.035}, {3.52, 0.287},
                                                {11.06, 2.9},    {14.6, 4.8},   {16.2, 5.2}};

static fst_run_result limit_of(int which)
{
    fst_params p = bead(LIBRATION[which][0], LIBRATION[which][1]);
    p.run_until = FST_UNTIL_SETTLED;
    const fst_run_result limit = run_of(&p);
    assert_int_equal(limit.regime, FST_REGIME_LIBRATING);
    assert_true(limit.mean_r_error < 1e-8 && limit.mean_nz_error < 1e-8);
    return limit;
}

static void check_libration(const fst_run_result *run, const fst_run_result *limit)
{
    assert_int_equal(run->regime, FST_REGIME_LIBRATING);
    CHECK_CLOSE(run->mean_r, limit->mean_r, run->mean_r_error + limit->mean_r_error);
    CHECK_CLOSE(run->mean_nz, limit->mean_nz, run->mean_nz_error + limit->mean_nz_error);
    assert_true(error_over_bar(run->mean_alpha_dot, run->omega, run->mean_alpha_dot_error) < 1.0);
}

static void test_librations(void **unused)
{
    (void)unused;
    static const double lengths[] = {80.0, 121.0, 200.0};
    for (int i = 0; i < LIBRATIONS; ++i) {
        const fst_run_result limit = limit_of(i);
        for (size_t k = 0; k < sizeof lengths / sizeof *lengths; ++k) {
            fst_params p = bead(LIBRATION[i][0], LIBRATION[i][1]);
            p.run_periods = lengths[k];
            p.run_discard = 0.5 * lengths[k];
            const fst_run_result run = run_of(&p);
            check_libration(&run, &limit);
            if (k == 2) { /* long enough to have come to the cycle: the bars are those of whole cycles */
                assert_true(run.mean_r_error < 1e-7 && run.mean_nz_error < 1e-7);
                assert_true(run.mean_alpha_dot_error < 1e-7);
                CHECK_CLOSE(run.std_r, limit.std_r, 1e-8);
            }
        }
    }
}

static void fill_row(const void *with, int row, fst_row_job *job)
{
    (void)with;
    job->params = bead(LIBRATION[row][0], LIBRATION[row][1]);
    job->params.run_periods = 121.0;
    job->params.run_discard = row == 1 ? 0.0 : 60.5;
}

/* In the portable form a row has its run's bits; in the fast forms it counts the same cycles. */
static void test_rows(void **unused)
{
    (void)unused;
    static few_rows rows = {.count = LIBRATIONS, .fill = fill_row};
    for (int form = FST_ARITHMETIC_PORTABLE; form <= FST_ARITHMETIC_AVX512; ++form) {
        if (!fst_lane_engine_of((fst_arithmetic)form, 0))
            continue;
        do_few_rows(&rows, (fst_arithmetic)form, 0);
        for (int i = 0; i < LIBRATIONS; ++i) {
            fst_row_job job;
            fill_row(NULL, i, &job);
            const fst_run_result run = run_of(&job.params), *row = &rows.results[i];
            const int same = form == FST_ARITHMETIC_PORTABLE;
            CHECK_CLOSE(run.window_periods, row->window_periods, same ? 1e-12 : 3.0);
            CHECK_CLOSE(run.mean_r, row->mean_r, same ? 1e-15 : run.mean_r_error + row->mean_r_error);
            CHECK_CLOSE(run.mean_nz, row->mean_nz, same ? 1e-15 : run.mean_nz_error + row->mean_nz_error);
            assert_true(row->mean_r_error < 10.0 * run.mean_r_error);
            assert_int_equal(run.regime, row->regime);
        }
    }
}

/* <n_z> of an orbit with the symmetry S2 is 0: what is left is an error of the steps, and the bar says so.  The
 * steps of one return are those of the one before, so that whole returns agree better than half ones: that is
 * no broken symmetry. */
static void test_symmetric_at_loose_tolerances(void **unused)
{
    (void)unused;
    static const struct {
        double frequency, kappa, rtol;
    } cases[] = {{23.55568827097466, 2.8374116034501204, 1e-3}, {14.508859997701686, 0.5301316898253084, 1e-3},
                 {37.91905836770434, 1.8923926917124525, 1e-5}, {15.775256419319314, 0.7502308831008377, 1e-5},
                 {23.55568827097466, 2.8374116034501204, 1e-6}, {33.84114133227481, 2.8794466880171137, 1e-6}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        for (int settled = 0; settled < 2; ++settled) {
            fst_params p = bead(cases[i].frequency, cases[i].kappa);
            p.run_periods = 200.0;
            p.run_rtol = cases[i].rtol;
            p.run_until = settled ? FST_UNTIL_SETTLED : FST_UNTIL_PERIODS;
            const fst_run_result run = run_of(&p);
            assert_int_equal(run.regime, FST_REGIME_COUNTER_ROTATING);
            assert_int_not_equal(run.symmetry, FST_SYMMETRY_S1);
            assert_true(error_over_bar(run.mean_nz, 0.0, run.mean_nz_error) < 1.0);
            assert_true(run.mean_nz_error < 30.0 * p.run_rtol);
        }
    /* an orbit without the symmetry is still told where its half returns differ by far more */
    fst_params p = bead_at(0.26, FST_DYNAMICS_RIGID);
    p.run_rtol = 1e-6;
    const fst_run_result broken = run_of(&p);
    assert_int_equal(broken.symmetry, FST_SYMMETRY_S1);
}

/* n of a locked bead stands still and has no plane, also where the window takes in how it came to rest. */
static void test_no_tilt_at_rest(void **unused)
{
    (void)unused;
    for (int way = 0; way < 3; ++way) {
        fst_params p = bead(4.0, 1.5);
        p.run_periods = 60.0;
        p.run_discard = way == 0 ? 0.0 : 30.0;
        p.run_until = way == 2 ? FST_UNTIL_SETTLED : FST_UNTIL_PERIODS;
        const fst_run_result run = run_of(&p);
        assert_int_equal(run.regime, FST_REGIME_LOCKED);
        assert_true(isnan(run.tilt_deg));
    }
}

/* A motion that goes on to another one has means of its window, but no errors of them. */
static void test_no_error_of_what_drifts(void **unused)
{
    (void)unused;
    fst_params p = bead(7.439062754292829, 3.9471289725749035);
    p.start_r = 0.9; /* it leaves an unstable place of rest, slowly */
    p.run_periods = 12.0;
    p.run_discard = 2.0;
    const fst_run_result run = run_of(&p);
    assert_int_equal(run.regime, FST_REGIME_UNDECIDED);
    assert_true(isfinite(run.mean_r) && isnan(run.mean_r_error) && isnan(run.mean_nz_error) &&
                isnan(run.mean_alpha_dot_error));
}

/* A bead that rolls inside the cone of static friction and comes near its edge: nothing damps what steps lose, and
 * whether it slips there is known at a tight tolerance only. */
static void test_rolling(void **state)
{
    (void)state;
    fst_params p = bead(8.0, 1.5);
    p.friction_law = FST_FRICTION_COULOMB;
    p.friction_mu = 0.4;
    p.run_rtol = 1e-11;
    const fst_run_result sure = run_of(&p);
    assert_int_equal(sure.never_slips, 0);
    assert_null(strstr(sure.reason, "run.rtol"));
    for (int i = 0; i < 2; ++i) {
        p.run_rtol = i ? 1e-8 : 1e-6;
        const fst_run_result loose = run_of(&p);
        assert_true(error_over_bar(loose.mean_r, sure.mean_r, loose.mean_r_error) < 0.5);
        assert_true(error_over_bar(loose.mean_alpha_dot, sure.mean_alpha_dot, loose.mean_alpha_dot_error) <
                    0.5);
        assert_int_equal(loose.never_slips, -1);
        assert_non_null(strstr(loose.reason, "whether the contact slips depends on run.rtol"));
        assert_true(loose.sticking > 0.99);
    }
    p.friction_mu = 10.0;
    assert_int_equal(run_of(&p).never_slips, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_librations),
        cmocka_unit_test(test_rows),
        cmocka_unit_test(test_symmetric_at_loose_tolerances),
        cmocka_unit_test(test_no_tilt_at_rest),
        cmocka_unit_test(test_no_error_of_what_drifts),
        cmocka_unit_test(test_rolling),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
