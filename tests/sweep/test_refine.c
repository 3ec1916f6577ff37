/* Refinements driven by values that are made up: how many points are expected on the way, that the order of
 * values does not matter, and values that are undefined.
 * tests: sweep/refine.c
 * labels: memcheck */
#include <stdlib.h>

#include "physics.h"
#include "sweep/refine.h"

enum { COUNT = 129, POINTS = COUNT * COUNT };

typedef double value_at(double x, double y);

static double disc(double x, double y)
{
    return (x - 0.6) * (x - 0.6) + (y - 0.45) * (y - 0.45) < 0.09;
}

/* The rows that come first say nothing of the boundaries at the other end. */
static double stripes_at_the_end(double x, double y)
{
    return x > 0.7 ? floor(8.0 * y + sin(9.0 * x)) : 0.0;
}

static double even(double x, double y)
{
    return 0.0 * x * y;
}

static double undefined(double x, double y)
{
    return x * y * NAN;
}

static fst_refinement *refinement_of(int levels)
{
    const char *const axes[] = {"drive.frequency=1:2:129", "model.kappa=1:2:129"};
    const fst_params base = fst_default_params();
    fst_grid *grid;
    fst_refinement *r;
    assert_int_equal(fst_grid_new(&base, axes, 2, 1, &grid, NULL), FST_OK);
    assert_int_equal(fst_refinement_new(grid, levels, 0.0, &r, NULL), FST_OK);
    fst_grid_free(grid);
    return r;
}

static void note(fst_refinement *r, value_at *f, int64_t point)
{
    const double x = (double)(point / COUNT) / (COUNT - 1), y = (double)(point % COUNT) / (COUNT - 1);
    assert_int_equal(fst_refinement_note(r, point, f(x, y), NULL), FST_OK);
}

/* What a whole refinement expected on its way: how far the part that is done fell at most, how many points it
 * had in the end, and the expected number by that when a quarter of them was known. */
typedef struct way {
    double fall, early;
    int64_t total;
} way;

/* The numbers never contradict each other, and agree in the end. */
static way go_through(value_at *f)
{
    static double expected[POINTS];
    fst_refinement *r = refinement_of(4);
    double greatest = 0.0;
    way found = {0.0, 0.0, 0};
    int64_t point;
    while (fst_refinement_next(r, &point)) {
        note(r, f, point);
        const fst_refinement_counts c = fst_refinement_count(r);
        assert_int_equal(c.known, ++found.total);
        assert_true(c.known <= c.wanted && c.wanted <= c.expected && c.expected <= POINTS && c.undefined == 0);
        const double part = (double)c.known / (double)c.expected;
        greatest = fmax(greatest, part);
        found.fall = fmax(found.fall, greatest - part);
        expected[found.total - 1] = (double)c.expected;
    }
    assert_true(greatest == 1.0 && expected[found.total - 1] == (double)found.total);
    found.early = expected[found.total / 4] / (double)found.total;
    fst_refinement_free(r);
    return found;
}

static void test_expected_points(void **state)
{
    (void)state;
    const way round = go_through(disc), striped = go_through(stripes_at_the_end), none = go_through(even);
    assert_true(round.fall < 0.03 && fabs(round.early - 1.0) < 0.1);     /* found: 0.014, 0.999 */
    assert_true(striped.fall < 0.11 && fabs(striped.early - 1.0) < 0.2); /* found: 0.055, 0.939 */
    assert_true(none.fall == 0.0 && none.total == 81);
}

/* Which points are wanted in the end: the last one that is known to be wanted is always taken first, or the
 * first one. */
static void find_points(unsigned char *found, int last_first)
{
    fst_refinement *r = refinement_of(4);
    int64_t *stack = malloc(POINTS * sizeof *stack), count = 0, next = 0;
    assert_non_null(stack);
    for (int going = 1; going;) {
        while (fst_refinement_next(r, &stack[count]))
            ++count;
        going = last_first ? count > 0 : next < count;
        if (going) {
            const int64_t point = last_first ? stack[--count] : stack[next++];
            assert_int_equal(found[point], 0); /* each of them once */
            found[point] = 1;
            note(r, disc, point);
        }
    }
    free(stack);
    fst_refinement_free(r);
}

static void test_order_does_not_matter(void **state)
{
    (void)state;
    static unsigned char one[POINTS], other[POINTS];
    find_points(one, 0);
    find_points(other, 1);
    assert_memory_equal(one, other, POINTS);
}

static void test_undefined_values(void **state)
{
    (void)state;
    fst_refinement *r = refinement_of(4);
    int64_t point;
    while (fst_refinement_next(r, &point))
        note(r, undefined, point);
    const fst_refinement_counts c = fst_refinement_count(r);
    assert_true(c.known == 81 && c.undefined == 81);
    fst_refinement_free(r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_expected_points),
        cmocka_unit_test(test_order_does_not_matter),
        cmocka_unit_test(test_undefined_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
