/* Parameters from the places of one film, the harder ones: a tilted camera, a magnet that turns clockwise, a
 * long exposure.
 * tests: fit/track.c fit/path.c
 * labels: long */
#include "numeric.h"
#include "fit_films.h"

static void test_tilted_film_of_a_clockwise_magnet(void **state)
{
    fst_track track;
    fst_fit fit;
    fst_fit_options options = fst_default_fit_options();
    options.drive = -11.3;
    make_track(*state, 0, 15.0, 1, 0.05, &track);
    must_fit(&track, &options, &fit);
    check(&fit);
    fst_fit_free(&fit);
    fst_track_free(&track);
}

/* An exposure of 5 ms blurs delta r: unknown it makes a wrong gamma, given or sought the right one. */
static void test_long_exposure(void **state)
{
    const double exposure = 7.0 / (SAMPLES * 11.3);
    fst_track track;
    fst_fit fit;
    fst_fit_options options = fst_default_fit_options();
    make_track(*state, 3, 0.0, 0, 0.05, &track);
    must_fit(&track, &options, &fit);
    assert_true(fabs(fit.parameters[1].value - 290.0) > 5.0 * fit.parameters[1].error);
    fst_fit_free(&fit);
    options.exposure = exposure;
    must_fit(&track, &options, &fit);
    check(&fit);
    fst_fit_free(&fit);
    options.exposure = 0.85 * exposure;
    options.exposure_error = 0.2 * exposure;
    must_fit(&track, &options, &fit);
    check(&fit);
    fst_fit_free(&fit);
    fst_track_free(&track);
}

int main(void)
{
    static film made;
    if (!fst_fit_present() || !fst_lapack_present())
        return 77;
    make_film(&made);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_tilted_film_of_a_clockwise_magnet, &made),
        cmocka_unit_test_prestate(test_long_exposure, &made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
