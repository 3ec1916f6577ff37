/* Grids: every form of an axis, units, the order of points, random values from a seed, and what is refused.
 * tests: study/grid.c
 * labels: memcheck */
#include "physics.h"

static fst_grid *grid_of(const char *const *axes, int count, uint64_t seed)
{
    const fst_params base = fst_default_params();
    fst_grid *grid;
    fst_error error = {FST_OK, "", ""};
    if (fst_grid_new(&base, axes, count, seed, &grid, &error) != FST_OK)
        fail_msg("fst_grid_new: %s", error.sentence);
    return grid;
}

static void test_forms(void **state)
{
    (void)state;
    const char *const axes[] = {"drive.frequency=5Hz:600rpm:6", "model.kappa=0.1:10:3:log",
                                "model.dynamics=farago2020,rigid", "magnet.lines=1:9:5"};
    fst_grid *grid = grid_of(axes, 4, 1);
    assert_int_equal(fst_grid_points(grid), 6 * 3 * 2 * 5);
    assert_int_equal(fst_grid_axis_count(grid), 4);
    assert_string_equal(fst_grid_key(grid, 1), "model.kappa");
    assert_true(fst_grid_value(grid, 0, 0) == 5.0);
    assert_true(fst_grid_value(grid, 0, 30) == 6.0);
    assert_true(fst_grid_value(grid, 0, 179) == 10.0);
    assert_true(fst_grid_value(grid, 1, 10) == 1.0);
    fst_params p;
    assert_int_equal(fst_grid_params(grid, 6, &p, NULL), FST_OK); /* the last axis runs fastest */
    assert_int_equal(p.magnet_lines, 3);
    assert_int_equal(p.model_dynamics, FST_DYNAMICS_RIGID);
    assert_true(p.model_kappa == 0.1 && p.drive_frequency == 5.0);
    fst_grid_free(grid);
}

static void test_random_axes_are_drawn_together(void **state)
{
    (void)state;
    const char *const axes[] = {"start.r=0.5:1.5:random:100", "model.kappa=1,2", "start.phi=0:180:100:random"};
    fst_grid *grid = grid_of(axes, 3, 7), *other = grid_of(axes, 3, 8);
    assert_int_equal(fst_grid_points(grid), 200);
    double sum = 0, changed = 0, product = 0;
    for (int i = 0; i < 200; ++i) {
        const double r = fst_grid_value(grid, 0, i);
        assert_true(r >= 0.5 && r < 1.5);
        sum += r / 200;
        changed += r != fst_grid_value(other, 0, i);
        product += (r - 1.0) * (fst_grid_value(grid, 2, i) - 90.0) / 200;
    }
    assert_true(fabs(sum - 1.0) < 0.1);
    assert_true(changed > 190);
    assert_true(
        fabs(product) <
        0.25 * 90.0 *
            0.5); /* if both axes drew the same numbers this would be 1/3 of that product of half widths */
    assert_true(fst_grid_value(grid, 2, 5) ==
                fst_grid_value(grid, 2, 105)); /* both values of kappa have the same draw */
    fst_grid_free(grid);
    fst_grid_free(other);
}

static void test_refusals(void **state)
{
    (void)state;
    const char *const wrong[] = {"model.kapa=1:2:3",
                                 "model.kappa",
                                 "model.kappa=",
                                 "model.kappa=1:2",
                                 "model.kappa=1:2:0",
                                 "model.kappa=1:2:3:4:5",
                                 "model.kappa=1:2:3:up",
                                 "model.kappa=-1:2:3",
                                 "model.kappa=1m:2:3",
                                 "model.kappa=0:1:3:log",
                                 "magnet.lines=1:2:3",
                                 "model.dynamics=rigid:rigid:2",
                                 "model.kappa=1:2:2000000000",
                                 "model.kappa=1,,2",
                                 "model.dynamics=rigit",
                                 "model.kappa=1:2:3x"};
    const fst_params base = fst_default_params();
    fst_grid *grid;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        fst_error error = {FST_OK, "", ""};
        if (fst_grid_new(&base, &wrong[i], 1, 1, &grid, &error) != FST_BAD_INPUT || !error.sentence[0])
            fail_msg("\"%s\" was not refused", wrong[i]);
        assert_null(grid);
    }
    const char *const twice[] = {"drive.omega=0.2,0.3", "drive.frequency=5,6"};
    assert_int_equal(fst_grid_new(&base, twice, 2, 1, &grid, NULL), FST_BAD_INPUT);
    const char *const uneven[] = {"start.r=0.5:1:random:3", "start.phi=0:9:random:4"};
    assert_int_equal(fst_grid_new(&base, uneven, 2, 1, &grid, NULL), FST_BAD_INPUT);
    assert_int_equal(fst_grid_new(&base, uneven, 0, 1, &grid, NULL), FST_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_forms),
        cmocka_unit_test(test_random_axes_are_drawn_together),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
