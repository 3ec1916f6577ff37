/* How many points a refinement wants, and expects to want (sweep/refine.h), without any runs: sets that grow,
 * counts that are told while it goes on, each point once.
 * tests: sweep/refine.c sweep/refined.c sweep/point_set.c
 * labels: memcheck */
#include "numeric.h"

#include <stdlib.h>
#include <string.h>

#include "sweep/refine.h"
#include "sweep/refined.h"

static fst_grid *grid_of(int columns, int rows)
{
    char first[64], second[64];
    const char *const axes[] = {first, second};
    const fst_params p = fst_default_params();
    fst_grid *grid;
    (void)snprintf(first, sizeof first, "model.kappa=1:2:%d", columns);
    (void)snprintf(second, sizeof second, "start.r=0.5:1:%d", rows);
    assert_int_equal(fst_grid_new(&p, axes, 2, 0, &grid, NULL), FST_OK);
    return grid;
}

/* Note the value of every point that is wanted: 1 in columns from `change` on, else 0.  How many there were. */
static int64_t follow(fst_refinement *r, int columns, int rows, int change)
{
    char *seen = calloc((size_t)columns * (size_t)rows, 1);
    int64_t count = 0, point;
    for (; fst_refinement_next(r, &point); ++count) {
        assert_true(point >= 0 && point < (int64_t)columns * rows && !seen[point]);
        seen[point] = 1;
        assert_int_equal(fst_refinement_note(r, point, point / rows >= change, NULL), FST_OK);
        const fst_refinement_counts c = fst_refinement_count(r);
        assert_true(c.known == count + 1 && c.wanted >= c.known && c.expected >= c.wanted);
        assert_true(c.expected <= (int64_t)columns * rows);
    }
    free(seen);
    return count;
}

/* Where nothing changes only the coarse points are wanted, however many. */
static void test_coarse_points(void **unused)
{
    (void)unused;
    static const struct {
        int columns, rows, levels, coarse;
    } cases[] = {{129, 129, 2, 33 * 33},
                 {257, 257, 2, 65 * 65},
                 {100, 7, 3, 14 * 2},
                 {34, 22, 3, 6 * 4},
                 {40, 24, 3, 6 * 4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        fst_grid *grid = grid_of(cases[i].columns, cases[i].rows);
        fst_refinement *r;
        assert_int_equal(fst_refinement_new(grid, cases[i].levels, 0.0, &r, NULL), FST_OK);
        assert_int_equal(fst_refinement_count(r).wanted, cases[i].coarse);
        assert_int_equal(follow(r, cases[i].columns, cases[i].rows, 1000), cases[i].coarse);
        const fst_refinement_counts c = fst_refinement_count(r);
        assert_true(c.wanted == cases[i].coarse && c.known == c.wanted && c.expected == c.wanted);
        fst_refinement_free(r);
        fst_grid_free(grid);
    }
}

/* A straight boundary has two points in each row of the last level, and twice as many points on each level as
 * on the one before: that is what is expected at the beginning, of as many coarse points as there are. */
static void test_expected_points(void **unused)
{
    (void)unused;
    fst_grid *grid = grid_of(33, 33);
    fst_refinement *r;
    assert_int_equal(fst_refinement_new(grid, 3, 0.0, &r, NULL), FST_OK);
    assert_int_equal(fst_refinement_count(r).expected, 25 + 50 + 100 + 200);
    const int64_t count = follow(r, 33, 33, 17);
    assert_int_equal(fst_refinement_count(r).expected, count);
    assert_true(count > 25 + 2 * 33 && count < 33 * 33 / 2);
    fst_refinement_free(r);
    fst_grid_free(grid);
    grid = grid_of(5, 5); /* of which there are no more */
    assert_int_equal(fst_refinement_new(grid, 1, 0.0, &r, NULL), FST_OK);
    assert_int_equal(fst_refinement_count(r).expected, 25);
    fst_refinement_free(r);
    fst_grid_free(grid);
}

/* A value that comes again is known already. */
static void test_known_once(void **unused)
{
    (void)unused;
    fst_grid *grid = grid_of(33, 33);
    fst_refinement *r;
    int64_t point;
    assert_int_equal(fst_refinement_new(grid, 3, 0.0, &r, NULL), FST_OK);
    assert_true(fst_refinement_next(r, &point));
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(fst_refinement_note(r, point, i, NULL), FST_OK);
        assert_int_equal(fst_refinement_count(r).known, 1);
    }
    fst_refinement_free(r);
    fst_grid_free(grid);
}

/* A range of one point is not an axis along which cells lie: the other one is refined as if it were alone. */
static void test_a_single_point(void **unused)
{
    (void)unused;
    fst_grid *grid = grid_of(33, 1);
    fst_refinement *r;
    assert_int_equal(fst_refinement_new(grid, 3, 0.0, &r, NULL), FST_OK);
    assert_int_equal(fst_refinement_count(r).wanted, 5);
    assert_true(follow(r, 33, 1, 17) >= 5 + 3);
    fst_refinement_free(r);
    fst_grid_free(grid);
}

/* How many coarse points there would be is told to the last one. */
static void test_too_many_points(void **unused)
{
    (void)unused;
    fst_grid *grid = grid_of(30000, 20000);
    fst_refinement *r;
    fst_error error;
    assert_int_equal(fst_refinement_new(grid, 1, 0.0, &r, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, " 150025001 points")); /* 15001 * 10001 */
    assert_null(r);
    fst_grid_free(grid);
}

/* The step by which a number may change is a positive number. */
static void test_steps(void **unused)
{
    (void)unused;
    static const double bad[] = {INFINITY, NAN, 0.0, -1.0};
    fst_sweep_options o = fst_default_sweep_options();
    fst_refining refining;
    fst_error error;
    o.refine = 2;
    o.refine_by = "mean_r";
    for (int i = 0; i < 4; ++i) {
        o.refine_step = bad[i];
        assert_int_equal(fst_refining_of(&o, &refining, &error), FST_BAD_INPUT);
    }
    o.refine_step = 0.5;
    assert_int_equal(fst_refining_of(&o, &refining, &error), FST_OK);
    assert_true(refining.levels == 2 && refining.step == 0.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_coarse_points),   cmocka_unit_test(test_expected_points),
        cmocka_unit_test(test_known_once),      cmocka_unit_test(test_a_single_point),
        cmocka_unit_test(test_too_many_points), cmocka_unit_test(test_steps),
    };
    return cmocka_run_group_tests_name("refinement", tests, NULL, NULL);
}
