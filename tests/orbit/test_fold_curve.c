/* Folds over two parameters: an eigenvalue is zero all along the curve, and the curve's ends are folds over one
 * parameter.
 * tests: orbit/special_curve.c orbit/surface.c
 * labels: numbers */
#include "special_curves.h"

static void folds_of_locked_states(void **state)
{
    (void)state;
    fst_branch b = curve(FST_BRANCH_LOCKED, FST_SPECIAL_FOLD, 0.1262, 0.1292, 1.49, 1.51);
    assert_true(b.point_count >= 3);
    for (size_t i = 0; i < b.point_count; ++i)
        CHECK_CLOSE(nearest_multiplier(&b.points[i], 0.0), 0.0, 1e-7);
    CHECK_ENDS(&b, FST_BRANCH_LOCKED, FST_SPECIAL_FOLD, 0.1262, 0.1292, 1.49, 1.51, 1e-8);
    fst_branch_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(folds_of_locked_states)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
