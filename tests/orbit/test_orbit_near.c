/* fst_orbit_near() gives the orbit that fst_orbit_find() gives, from that of a neighbouring setup; and refuses
 * where there is none like it.
 * tests: orbit/near.c
 * labels: memcheck */
#include "numeric.h"

#include <festoon/festoon.h>

static fst_orbit find(const fst_params *params)
{
    fst_orbit orbit;
    assert_int_equal(fst_orbit_find(params, NULL, &orbit, NULL), FST_OK);
    return orbit;
}

static void test_same_orbit(void **state)
{
    (void)state;
    static const double frequencies[] = {10.7, 16.0}; /* without the symmetry S2, and with it */
    for (int i = 0; i < 2; ++i) {
        fst_params params = fst_default_params();
        params.drive_frequency = frequencies[i];
        const fst_orbit guess = find(&params);
        params.friction_gamma *= 1.01;
        params.magnet_depth *= 0.999;
        const fst_orbit wanted = find(&params);
        fst_orbit orbit;
        assert_int_equal(fst_orbit_near(&params, &guess, 1e-12, NULL, &orbit, NULL), FST_OK);
        assert_int_equal(orbit.symmetry, wanted.symmetry);
        assert_true(orbit.stable);
        assert_true(fabs(orbit.means.mean_r - wanted.means.mean_r) < 1e-10);
        assert_true(fabs(orbit.means.std_r - wanted.means.std_r) < 1e-10);
        assert_true(fabs(orbit.means.mean_alpha_dot - wanted.means.mean_alpha_dot) < 1e-10);
        assert_true(fabs(orbit.means.mean_r - guess.means.mean_r) > 1e-4);
        for (int k = 0; k < FST_STATE_SIZE; ++k)
            assert_true(fabs(orbit.state[k] - wanted.state[k]) < 1e-8);
        /* A rougher integration is as near as it says. */
        assert_int_equal(fst_orbit_near(&params, &guess, 1e-9, NULL, &orbit, NULL), FST_OK);
        assert_true(fabs(orbit.means.mean_r - wanted.means.mean_r) < 1e-7);
    }
}

static void test_refusals(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    params.drive_frequency = 16.0;
    fst_orbit guess = find(&params), orbit;
    fst_error error;
    /* The symmetric orbit is there at 10.7 Hz, but repels. */
    for (double f = 15.0; f > 10.6; f -= 0.5) {
        params.drive_frequency = f;
        if (fst_orbit_near(&params, &guess, 1e-12, NULL, &orbit, &error) != FST_OK)
            break;
        guess = orbit;
    }
    assert_int_equal(error.code, FST_NO_CONVERGENCE);
    assert_non_null(strstr(error.sentence, "repels"));
    assert_int_equal(fst_orbit_near(&params, &guess, 1.0, NULL, &orbit, &error), FST_BAD_INPUT);
    guess.outcome = FST_ORBIT_LOCKED;
    assert_int_equal(fst_orbit_near(&params, &guess, 1e-12, NULL, &orbit, &error), FST_BAD_INPUT);
}

int main(void)
{
    if (!fst_lapack_present())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_same_orbit),
        cmocka_unit_test(test_refusals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
