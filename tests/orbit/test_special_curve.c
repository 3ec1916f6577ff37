/* Special points over two parameters, over short ranges: test_special_curve_long.c follows them further.
 * tests: orbit/special_curve.c orbit/surface.c
 * labels: numbers */
#include "special_curves.h"

/* The ends of a curve over kappa are special points of branches over omega there, for the commonest type; every
 * point has the multiplier -1. */
static void pitchforks(void **state)
{
    (void)state;
    fst_branch b = curve(FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, 0.26, 0.28, 1.48, 1.52);
    assert_int_equal(b.branches, 1);
    assert_int_equal(b.followed, FST_SPECIAL_PITCHFORK);
    for (size_t i = 0; i < b.point_count; ++i)
        CHECK_CLOSE(nearest_multiplier(&b.points[i], -1.0), 0.0, 1e-9);
    CHECK_ENDS(&b, FST_BRANCH_COUNTER, FST_SPECIAL_PITCHFORK, 0.26, 0.28, 1.48, 1.52, 1e-8);
    fst_branch_free(&b);
}

/* Equilibria: the Hopf point where the main locked state loses its stability. */
static void hopf_points(void **state)
{
    (void)state;
    fst_branch b = curve(FST_BRANCH_LOCKED, FST_SPECIAL_HOPF, 0.091, 0.0935, 1.49, 1.51);
    for (size_t i = 0; i < b.point_count; ++i)
        CHECK_CLOSE(least_real_part_of_pairs(&b.points[i]), 0.0, 1e-9);
    CHECK_ENDS(&b, FST_BRANCH_LOCKED, FST_SPECIAL_HOPF, 0.09, 0.0945, 1.49, 1.51, 1e-8);
    fst_branch_free(&b);
}

static void refusals(void **state)
{
    (void)state;
    const fst_params params = scene_at(0.3, 1.5);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.28, 0.3);
    fst_branch b;
    fst_error error;
    o.second_key = "model.kappa";
    o.second_from = 1.0;
    o.second_to = 2.0;
    o.special = FST_SPECIAL_FOLD;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_NO_CONVERGENCE);
    CHECK_CONTAINS(error.sentence, "no fold lies between");
    o.second_key = "drive.omega";
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    o.second_key = "bead.moment"; /* follows from other parameters here, so it has no value of its own */
    o.special = FST_SPECIAL_TRANSCRITICAL;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "transcritical points are not followed");
    o.special = FST_SPECIAL_PITCHFORK;
    o.from = 0.26;
    assert_int_equal(fst_branch_follow(&params, &o, &b, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "bead.moment");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pitchforks),
        cmocka_unit_test(hopf_points),
        cmocka_unit_test(refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
