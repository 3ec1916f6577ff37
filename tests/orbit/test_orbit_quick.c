/* One orbit, short branches over one parameter and two, and exponents: just enough of each to run all the code,
 * for valgrind.
 * tests: orbit/search.c orbit/branch.c orbit/special_curve.c orbit/lyapunov.c
 * labels: memcheck */
#include "special_curves.h"

static void one_orbit(void **state)
{
    (void)state;
    const fst_params params = scene_of(1.0, "rigid");
    fst_orbit orbit;
    fst_error error;
    if (fst_orbit_find(&params, NULL, &orbit, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    assert_int_equal(orbit.symmetry, FST_SYMMETRY_S2);
    assert_true(orbit.stable);
    CHECK_CLOSE(orbit.residual, 0.0, 1e-12);
    CHECK_CLOSE(orbit.means.festoons, 2.0 * (1.0 + 1.0 / fabs(orbit.means.mean_alpha_dot)), 1e-12);
}

/* With a rough tolerance the pitchfork is as accurate as that tolerance. */
static void a_short_branch_and_curve(void **state)
{
    (void)state;
    const fst_params params = scene_at(0.2695, 1.5);
    fst_branch_options o = over_omega(FST_BRANCH_COUNTER, 0.2685, 0.2695);
    o.tolerance = 1e-8;
    o.second_key = "model.kappa";
    o.second_from = 1.499;
    o.second_to = 1.501;
    o.special = FST_SPECIAL_PITCHFORK;
    fst_branch b = followed(&params, &o);
    CHECK_CLOSE(special_near(&b, FST_SPECIAL_PITCHFORK, 0.26885303399)->value, 0.26885303399, 1e-7);
    assert_true(b.point_count > 2);
    fst_branch_free(&b);
}

static void exponents(void **state)
{
    (void)state;
    fst_params params = scene_of(1.0, "rigid");
    params.run_periods = 4;
    params.run_discard = 1;
    fst_lyapunov l;
    double sum = 0.0;
    assert_int_equal(fst_lyapunov_find(&params, NULL, &l, NULL), FST_OK);
    for (int i = 0; i < FST_EIGENVALUE_COUNT; ++i)
        sum += l.exponents[i];
    CHECK_CLOSE(sum, -7.0, 1e-6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_orbit),
        cmocka_unit_test(a_short_branch_and_curve),
        cmocka_unit_test(exponents),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
