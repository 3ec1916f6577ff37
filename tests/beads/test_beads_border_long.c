/* Which beads come together: at four drives, of starts with two angles between them, the nearer ones touch within 2500 turns
 * of the magnet, and the others do not.
 *
 * tests: beads/run.c
 * labels: long numbers */
#include <festoon/beads.h>

#include "physics.h"

/* Whether two beads touch that start on r = 0.95 and differ by `apart` degrees. */
static int touch(double frequency, double apart)
{
    fst_params beads[2];
    fst_beads_options options = fst_default_beads_options();
    fst_beads_result result;
    fst_error error = {FST_OK, "", ""};
    options.chi = 1.243e-3;
    for (int i = 0; i < 2; ++i) {
        beads[i] = fst_default_params();
        beads[i].drive_frequency = frequency;
        beads[i].start_r = 0.95;
        beads[i].start_phi = 3 + apart * i;
        beads[i].run_periods = 2500;
        beads[i].run_discard = 2400;
    }
    if (fst_beads_run(beads, 2, &options, &result, &error) != FST_OK)
        fail_msg("fst_beads_run: %s", error.sentence);
    const int touched = result.counts[FST_BEAD_EVENT_TOUCH] > 0;
    assert_int_equal(result.outcome == FST_BEADS_APART, !touched);
    fst_beads_free(&result);
    return touched;
}

static void test_borders(void **unused)
{
    (void)unused;
    static const struct {
        double frequency, border;
    } cases[] = {{25, 108.2}, {30, 105.4}, {35, 111.3}, {40, 99.9}};
    for (int i = 0; i < 4; ++i) {
        assert_true(touch(cases[i].frequency, cases[i].border - 0.6));
        assert_false(touch(cases[i].frequency, cases[i].border + 0.6));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_borders)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
