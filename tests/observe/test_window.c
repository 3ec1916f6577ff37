/* A window of observation: how its marks are thinned; and that a window which is asked only at its end may
 * leave out the integrals of most marks without changing any number of a result.
 * tests: observe/window.c observe/marks.c
 * labels: memcheck */
#include "physics.h"

#include "observe/means.h"
#include "study/conclude.h"

/* Kept are the marks whose index is a multiple of the stride, which is known beforehand; at least half of the
 * room is used. */
static void test_marks_are_kept_evenly(void **unused)
{
    (void)unused;
    fst_mark_series series;
    fst_marks_begin(&series);
    for (int64_t offered = 1; offered <= 1500; ++offered) {
        const fst_mark mark = {.t = {(double)(offered - 1), 0.0}};
        fst_marks_offer(&series, &mark);
        assert_int_equal(series.offered, offered);
        assert_true(series.latest.t.high == (double)(offered - 1));
        assert_true(series.count <= FST_MARKS);
        assert_true(offered < FST_MARKS ? series.count == offered : 2 * series.count > FST_MARKS - 1);
        for (int i = 0; i < series.count; ++i)
            assert_true(series.kept[i].t.high == (double)(i * series.stride));
        assert_int_equal(fst_marks_stride(offered), series.stride);
    }
}

/* Follows a bead to its end, with a window that is asked only at its end, or at any time. */
static fst_run_result observe(const fst_params *p, int asked_at_end)
{
    fst_watched_run run;
    fst_run_result result;
    int over = 0;
    assert_int_equal(fst_watched_run_begin(&run, p, NULL, NULL), FST_OK);
    run.window.span.asked_at_end = asked_at_end;
    while (!over)
        assert_int_equal(fst_watched_run_go_on(&run, 64, &over, NULL), FST_OK);
    fst_result_clear(&result);
    fst_means_fill(&run.window, fst_window_series(&run.window, run.flow->t), p, &result);
    result.returns = run.window.returns.crossings;
    fst_watched_run_free(&run);
    return result;
}

static void test_what_may_be_left_out(void **unused)
{
    (void)unused;
    int turning = 0, others = 0;
    for (int i = 0; i < 24; ++i) {
        fst_params p = bead_at(0.05 + 0.04 * i, i % 2 ? FST_DYNAMICS_RIGID : FST_DYNAMICS_FARAGO2020);
        p.run_discard = i % 3 ? 3.7 : 0.0;
        p.run_periods = 40.0 + 3.3 * i;
        p.run_rtol = 1e-7;
        const fst_run_result all = observe(&p, 0), some = observe(&p, 1);
        for (int k = 0; k < fst_result_count(); ++k)
            if (memcmp((const char *)&all + fst_result_at(k)->offset,
                       (const char *)&some + fst_result_at(k)->offset, sizeof(double)) != 0)
                fail_msg("bead %d: %s differs", i, fst_result_at(k)->name);
        assert_int_equal(all.returns, some.returns);
        turning += all.returns > 40;
        others += all.returns <= 2;
    }
    assert_true(turning > 5 && others > 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_marks_are_kept_evenly),
        cmocka_unit_test(test_what_may_be_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
