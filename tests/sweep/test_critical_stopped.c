/* A search for the critical speed that is interrupted keeps the runs that were done: in the scan some of them, at the
 * border all of the scan.
 * tests: sweep/critical.c
 * labels: numbers */
#include "numeric.h"

#include <string.h>

#include <festoon/festoon_tools.h>

enum { COUNT = 24 };

/* Interrupt as soon as more than this fraction is done. */
static fst_status stop_at(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    if (fraction < *(const double *)user)
        return FST_OK;
    *error = (fst_error){.code = FST_INTERRUPTED, .sentence = "enough"};
    return FST_INTERRUPTED;
}

/* Interrupt a search by runs of so many periods there; how many were done. */
static int runs_until(double until, double periods)
{
    fst_params params = fst_default_params();
    const fst_progress progress = {&until, stop_at};
    fst_critical_options o = fst_default_critical_options();
    fst_critical found;
    fst_error error;
    int runs = 0;
    params.run_periods = periods;
    params.run_discard = 0.5 * periods;
    o.over = "drive.frequency=8Hz:12Hz:24";
    o.progress = &progress;
    assert_int_equal(fst_critical_find(&params, &o, &found, &error), FST_INTERRUPTED);
    assert_string_equal(error.sentence, "enough");
    assert_int_equal(found.found, 0);
    assert_true(isnan(found.value));
    assert_non_null(strstr(found.reason, "interrupted"));
    for (size_t k = 0; k < found.stretch_count; ++k) {
        runs += found.stretches[k].runs;
        assert_true(found.stretches[k].from >= 8.0 && found.stretches[k].to <= 12.0);
        assert_true(found.stretches[k].from <= found.stretches[k].to);
    }
    print_message("interrupted at %g: %d runs\n", until, found.runs);
    assert_int_equal(runs, found.runs);
    fst_critical_free(&found);
    return runs;
}

static void what_was_done_is_kept(void **unused)
{
    (void)unused;
    /* Progress is asked for by the clock: short runs may all be done before. */
    int some = COUNT;
    for (double periods = 60; some == COUNT && periods < 1e4; periods *= 2)
        some = runs_until(0.3, periods);
    assert_in_range(some, 1, COUNT - 1);
    assert_true(runs_until(0.65, 60) >= COUNT); /* the scan ends at 0.6 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(what_was_done_is_kept)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
