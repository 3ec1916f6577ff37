/* test_paramagnet_long.c - the search for a paramagnetic bead that counter-rotates, at length.
 *
 * More than a thousand starts over drives, strengths and places; none is left circling against the magnet.  And
 * the law of the transient: a weak bead forgets its free rolling the more slowly, the weaker it is, but it
 * does.
 * tests: paper/paramagnet.c
 * labels: long slow */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <festoon/festoon_tools.h>

#include "paper/paramagnet.h"

enum { STARTS = 1500 };

static fst_status search_piece(void *user, int index, fst_error *error)
{
    fst_search_entry *entries = user;
    return fst_search_one(index, FST_DYNAMICS_RIGID, &entries[index], error);
}

static void many_starts_do_not_counter_rotate(void **unused)
{
    (void)unused;
    static fst_search_entry entries[STARTS];
    fst_work work = {.user = entries, .count = STARTS, .piece = search_piece};
    fst_error error;
    assert_int_equal(fst_parallel(&work, &error), FST_OK);
    int fates[FST_FATE_COUNT] = {0}, at_first = 0;
    double longest = 0.0;
    for (int i = 0; i < STARTS; i++) {
        fates[entries[i].last]++;
        at_first += entries[i].first == FST_FATE_COUNTER;
        if (entries[i].first == FST_FATE_COUNTER && entries[i].periods > longest)
            longest = entries[i].periods;
        if (entries[i].last == FST_FATE_COUNTER) {
            fst_params params;
            assert_int_equal(fst_search_params(i, FST_DYNAMICS_RIGID, &params, NULL), FST_OK);
            print_error("start %d: a %g drive %g r %g phi %g still counter-rotates\n", i, params.bead_a,
                        params.drive_omega, params.start_r, params.start_phi);
        }
    }
    print_message("with %d, standing %d, away %d; %d against the magnet at first, the last for %.0f periods\n",
                  fates[FST_FATE_WITH], fates[FST_FATE_STANDING], fates[FST_FATE_AWAY], at_first, longest);
    assert_int_equal(fates[FST_FATE_COUNTER], 0);
    assert_true(at_first > 150); /* the search must meet beads that circle against the magnet at first */
}

/* Drive periods after which a bead of strength a, rolling against the magnet at the start, has stopped doing
 * so. */
static double periods_until_turned(double a)
{
    fst_params params = fst_default_params();
    params.bead_material = FST_MATERIAL_PARAMAGNETIC;
    params.bead_a = a;
    params.drive_omega = 0.119;
    params.drive_frequency = NAN;
    params.start_r = 1.29;
    params.start_phi = 10.0;
    params.run_rtol = 1e-8;
    double low = 0.0, high = 64000.0;
    for (int i = 0; i < 7;
         i++) { /* the mean over the second half of a run changes its sign later than the bead */
        double middle = low > 0.0 ? sqrt(low * high) : high / 64.0, speed;
        fst_fate fate;
        assert_int_equal(fst_fate_of(&params, middle, &fate, &speed, NULL), FST_OK);
        assert_int_not_equal(fate, FST_FATE_AWAY);
        *(fate == FST_FATE_COUNTER ? &low : &high) = middle;
    }
    return high;
}

static void weak_beads_turn_later_but_turn(void **unused)
{
    (void)unused;
    double strong = periods_until_turned(1e-4), weak = periods_until_turned(4e-5);
    print_message("turned after %.0f and %.0f periods at a = 1e-4 and 4e-5\n", strong, weak);
    /* The exponent lies between a^-1 (a force on the rolling bead) and a^-2 (the work that friction can do). */
    assert_true(weak / strong > 2.5 && weak / strong < 6.25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(many_starts_do_not_counter_rotate),
        cmocka_unit_test(weak_beads_turn_later_but_turn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
