/* The defaults and bounds of the parameters, written here again from the paper and from what the model needs to
 * exist; and the greatest grid.
 * tests: model/param_table.c study/grid.c */
#include "physics.h"

#include <stdio.h>

/* The paper's bead and magnet in SI: radius 2.5 mm, mass 0.5 g, magnet 46 mm x 40 mm, its mid-plane 16.2 mm
 * below the plate, as five lines; friction 312.5 per second, kappa 1.5; and how runs are made unless told. */
static void test_defaults(void **unused)
{
    (void)unused;
    static const struct {
        const char *key;
        double value;
    } defaults[] = {
        {"bead.radius", 2.5e-3},   {"bead.mass", 0.5e-3},     {"magnet.half_length", 23e-3},
        {"magnet.width", 40e-3},   {"magnet.depth", 16.2e-3}, {"magnet.lines", 5},
        {"friction.gamma", 312.5}, {"model.kappa", 1.5},      {"drive.frequency", 10.7},
        {"plate.gravity", 9.81},   {"run.periods", 400},      {"run.discard", 200},
        {"run.rtol", 1e-10},       {"run.samples", 64},
    };
    const fst_params p = fst_default_params();
    for (size_t i = 0; i < sizeof defaults / sizeof *defaults; ++i) {
        char text[64];
        const int index = fst_param_find(defaults[i].key);
        assert_true(index >= 0);
        assert_true(fst_params_get(&p, index, text, sizeof text) > 0);
        double value;
        assert_int_equal(fst_parse_value(text, FST_UNIT_NUMBER, &value, NULL), FST_OK);
        CHECK_CLOSE(value, defaults[i].value, 1e-15 * defaults[i].value);
    }
}

/* No divisor may be zero, and no length, time or count of things negative. */
static void test_bounds(void **unused)
{
    (void)unused;
    static const char *const refused[][2] = {
        {"bead.radius", "0"},      {"bead.mass", "0"},        {"magnet.half_length", "0"},
        {"magnet.lines", "0"},     {"magnet.lines", "-1"},    {"magnet.lines", "2.5"},
        {"friction.gamma", "0"},   {"drive.frequency", "0"},  {"drive.omega", "0"},
        {"model.eps", "0"},        {"model.h", "0"},          {"plate.radius", "0"},
        {"run.periods", "0"},      {"run.rtol", "0"},         {"run.rtol", "1"},
        {"run.samples", "0"},      {"start.r", "-0.1"},       {"friction.mu", "-0.1"},
        {"magnet.depth", "-1 mm"}, {"model.kappa", "-1"},     {"run.discard", "-1"},
        {"drive.frequency", "-1"}, {"plate.gravity", "-1e9"},
    };
    static const char *const taken[][2] = {
        {"magnet.lines", "1"}, {"magnet.lines", "99"}, {"start.r", "0"},       {"friction.mu", "0"},
        {"run.discard", "0"},  {"model.kappa", "0"},   {"plate.gravity", "0"}, {"magnet.depth", "0"},
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; ++i) {
        fst_params p = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        if (fst_params_set(&p, refused[i][0], refused[i][1], &error) != FST_BAD_INPUT)
            fail_msg("%s = %s was taken", refused[i][0], refused[i][1]);
        assert_string_equal(error.where, refused[i][0]);
    }
    for (size_t i = 0; i < sizeof taken / sizeof *taken; ++i) {
        fst_params p = fst_default_params();
        fst_error error = {FST_OK, "", ""};
        if (fst_params_set(&p, taken[i][0], taken[i][1], &error) != FST_OK)
            fail_msg("%s", error.sentence);
    }
}

/* Axes with too many points together are refused, also if each alone is short, and if the product does not even
 * fit into 64 bits. */
static void test_the_greatest_grid(void **unused)
{
    (void)unused;
    static const char *const axes[] = {"drive.omega=0.1:0.5:1000000", "start.r=0.1:1:1000", "start.phi=0:90:2",
                                       "bead.mass=1g:2g:1000000000", "plate.radius=1:2:1000000000"};
    const fst_params p = fst_default_params();
    fst_grid *grid;
    fst_error error = {FST_OK, "", ""};
    assert_int_equal(fst_grid_new(&p, axes, 2, 0, &grid, &error), FST_OK);
    assert_true(fst_grid_points(grid) == 1000000000);
    fst_grid_free(grid);
    for (int count = 3; count <= 5; ++count) {
        assert_int_equal(fst_grid_new(&p, axes, count, 0, &grid, &error), FST_BAD_INPUT);
        assert_null(grid);
        CHECK_CONTAINS(error.sentence, "points");
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_the_greatest_grid),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
