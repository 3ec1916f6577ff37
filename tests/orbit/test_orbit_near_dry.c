/* fst_orbit_near() under dry friction, at the tolerance of a fit; and at rest.
 * tests: orbit/near.c orbit/spectrum.c
 * labels: numbers */
#include "numeric.h"

#include <festoon/festoon.h>

static fst_orbit find(const fst_params *params)
{
    fst_orbit orbit;
    assert_int_equal(fst_orbit_find(params, NULL, &orbit, NULL), FST_OK);
    return orbit;
}

/* Under dry friction the flow has corners, so an orbit of loose steps maps its own direction less exactly: it moves all the
 * same.  What is at rest does not, however loose the steps. */
static void test_dry_orbits_and_rest(void **state)
{
    (void)state;
    static const double frequencies[] = {10.7, 16.0};
    for (int i = 0; i < 2; ++i) {
        fst_params params = fst_default_params();
        params.friction_law = FST_FRICTION_COULOMB;
        params.friction_mu = 0.18;
        params.drive_frequency = frequencies[i];
        const fst_orbit guess = find(&params);
        params.friction_mu *= 1.0 + 5e-5;
        const fst_orbit wanted = find(&params);
        fst_orbit orbit;
        fst_error error;
        if (fst_orbit_near(&params, &guess, 1e-10, NULL, &orbit, &error) != FST_OK)
            fail_msg("%g Hz: %s", frequencies[i], error.sentence);
        assert_true(fabs(orbit.means.mean_r - wanted.means.mean_r) < 1e-8);
        assert_true(orbit.stable);
    }
    fst_params params = fst_default_params();
    params.drive_frequency = 10.7;
    fst_orbit guess = find(&params), orbit;
    fst_locked_list locked;
    fst_error error;
    params.drive_frequency = 5.0;
    assert_int_equal(fst_locked_find(&params, NULL, &locked, &error), FST_OK);
    guess.turns = 0;
    memcpy(guess.state, locked.states[0].state, sizeof guess.state);
    fst_locked_free(&locked);
    for (double tolerance = 1e-12; tolerance < 2e-6; tolerance *= 100.0) {
        assert_int_equal(fst_orbit_near(&params, &guess, tolerance, NULL, &orbit, &error), FST_NO_CONVERGENCE);
    }
}

int main(void)
{
    if (!fst_lapack_present())
        return 77;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_dry_orbits_and_rest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
