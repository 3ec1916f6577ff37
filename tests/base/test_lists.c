/* The lists of lists.def: names that differ, counts, and units that values are written in and read back from.
 * tests: base/units.c base/listed.h
 * labels: memcheck */
#include "physics.h"

#include <festoon/beads.h>
#include <festoon/festoon_tools.h>

/* Each name stands once among its list's words, at the place that is its number. */
static void check_names(const char *const *names, int count, const char *words)
{
    for (int i = 0; i < count; ++i) {
        assert_true(strlen(names[i]) > 0);
        assert_int_equal(fst_name_place(names[i], words), i);
    }
    assert_int_equal(fst_name_place("", words), -1);
    assert_int_equal(fst_name_place(words, words), count > 1 ? -1 : 0);
}

#define CHECK(LIST, stem)                                                                                      \
    {                                                                                                          \
        static const char *const names[] = {LIST(FST_ROW_NAME)};                                               \
        assert_int_equal(sizeof names / sizeof *names, FST_##stem##_COUNT);                                    \
        check_names(names, FST_##stem##_COUNT, FST_WORDS(LIST));                                               \
    }

static void test_names(void **unused)
{
    (void)unused;
    CHECK(FST_MATERIALS, MATERIAL)
    CHECK(FST_DYNAMICS, DYNAMICS)
    CHECK(FST_PATCHES, PATCH)
    CHECK(FST_SPINS, SPIN)
    CHECK(FST_UNTILS, UNTIL)
    CHECK(FST_UNITS, UNIT)
    CHECK(FST_SHOWN, SHOWN)
    CHECK(FST_REGIMES, REGIME)
    CHECK(FST_STOPS, STOP)
    CHECK(FST_SYMMETRIES, SYMMETRY)
    CHECK(FST_ARITHMETICS, ARITHMETIC)
    CHECK(FST_CARRIES, CARRY)
    CHECK(FST_EXPORTS, EXPORT)
    CHECK(FST_ROLLING_ENDS, ROLLING)
    CHECK(FST_BRANCH_KINDS, BRANCH)
    CHECK(FST_SPECIALS, SPECIAL)
    CHECK(FST_ENDS, END)
    CHECK(FST_MEASURED_QUANTITIES, MEASURED)
    CHECK(FST_MOTIONS, MOTION)
    CHECK(FST_FIGURES, FIGURE)
    CHECK(FST_FIELDS, FIELD)
    CHECK(FST_COLOURS, COLOUR)
    CHECK(FST_FLOATINGS, FLOATING)
    assert_string_equal(fst_regime_name(FST_REGIME_CHAOTIC), "chaotic");
    assert_string_equal(fst_end_name(FST_END_LOST), "lost");
    assert_string_equal(fst_end_name(FST_END_COUNT), "unknown");
    assert_string_equal(fst_special_name(FST_SPECIAL_COUNT), "unknown");
    assert_null(fst_symmetry_name(FST_SYMMETRY_NONE));
    assert_string_equal(fst_symmetry_name(FST_SYMMETRY_S2), "S2");
    assert_string_equal(fst_status_text(FST_INTERRUPTED), "interrupted");
    assert_string_equal(fst_status_text(FST_STATUS_COUNT), "unknown status");
}

/* What is accepted of a kind is read, and its customary unit is so many times that of SI. */
static void test_units(void **unused)
{
    (void)unused;
    for (int kind = FST_UNIT_LENGTH; kind < FST_UNIT_COUNT; ++kind) {
        int power;
        char text[64];
        double value;
        const char *customary = fst_unit_customary((fst_unit)kind, &power);
        (void)snprintf(text, sizeof text, "1e%d %s", power, customary);
        assert_int_equal(fst_parse_value(text, (fst_unit)kind, &value, NULL), FST_OK);
        CHECK_CLOSE(value, 1.0, 1e-15);
        (void)snprintf(text, sizeof text, "1 %s", fst_unit_name((fst_unit)kind));
        assert_int_equal(fst_parse_value(text, (fst_unit)kind, &value, NULL), FST_OK);
        assert_true(value == 1.0);
        for (const char *unit = fst_unit_accepted((fst_unit)kind); *unit && *unit != '"';
             unit += strspn(unit, " ")) {
            const int length = (int)strcspn(unit, " ");
            (void)snprintf(text, sizeof text, "1 %.*s", length, unit);
            assert_int_equal(fst_parse_value(text, (fst_unit)kind, &value, NULL), FST_OK);
            unit += length;
        }
    }
    int power;
    assert_string_equal(fst_unit_customary(FST_UNIT_LENGTH, &power), "mm");
    assert_int_equal(power, 3);
    assert_string_equal(fst_unit_customary(FST_UNIT_PRESSURE, &power), "GPa");
    assert_int_equal(power, -9);
    assert_string_equal(fst_unit_customary(FST_UNIT_MOMENT, &power), "A m^2");
}

/* One default of the tolerance. */
static void test_tolerance(void **unused)
{
    (void)unused;
    const fst_flow_options flow = fst_default_flow_options();
    assert_true(fst_default_params().run_rtol == FST_DEFAULT_RTOL);
    assert_true(flow.rtol == FST_DEFAULT_RTOL && flow.atol[FST_STATE_SIZE - 1] == FST_DEFAULT_RTOL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_names),
        cmocka_unit_test(test_units),
        cmocka_unit_test(test_tolerance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
