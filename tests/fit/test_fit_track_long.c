/* Parameters from the places of one film, the harder ones: a tilted camera, a magnet that turns clockwise, a
 * long exposure; how often errors with slip are right, and two laws of friction told apart by it.
 * tests: fit/track.c fit/film.c fit/film_slip.c fit/path.c
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

/* Slip whose errors are alike in neighbouring frames, a bead of another size than was said, and a wrong scale: of 40
 * films about 68 % have gamma within one error. */
static void test_errors_with_slip(void **state)
{
    enum { FILMS = 40 };
    uint64_t seed = 71;
    int within[2] = {0, 0};
    double squares[2] = {0.0, 0.0};
    const fst_params right = truth();
    for (int k = 0; k < FILMS; ++k) {
        fst_track track;
        fst_fit fit;
        fst_fit_options options = fst_default_fit_options();
        options.drive = 11.3;
        make_track(*state, 0, 0.0, 0, 0.0, &track);
        const double scale = 1.0 + 0.003 * fit_normal(&seed);
        (void)add_slip(*state, 0, scale, 0.01 * fit_normal(&seed), 0.02, &seed, &track);
        for (size_t i = 0; i < track.rows; ++i) {
            track.x[i] = scale * (track.x[i] + 0.3 * fit_normal(&seed));
            track.y[i] = scale * (track.y[i] + 0.3 * fit_normal(&seed));
        }
        track.scale_error = 0.003;
        must_fit(&track, &options, &fit);
        assert_true(fit.slip_fitted > 80);
        const double off[2] = {(fit.parameters[1].value - right.friction_gamma) / fit.parameters[1].error,
                               (fit.kappa_gamma2 - right.model_kappa * 290.0 * 290.0) / fit.kappa_gamma2_error};
        for (int i = 0; i < 2; ++i) {
            within[i] += fabs(off[i]) < 1.0;
            squares[i] += off[i] * off[i] / FILMS;
        }
        fst_fit_free(&fit);
        fst_track_free(&track);
    }
    print_message("gamma within an error in %d of %d, kappa gamma^2 in %d; mean squares %.2f and %.2f\n",
                  within[0], FILMS, within[1], squares[0], squares[1]);
    for (int i = 0; i < 2; ++i) {
        assert_in_range(within[i], 19, 35);
        assert_true(squares[i] < 1.7);
    }
}

/* A film of a bead under dry friction: its slip is the dry law's, and not the viscous one's. */
static void test_dry_or_viscous(void **state)
{
    static const char *const keys[2][2] = {{"model.kappa", "friction.gamma"}, {"model.kappa", "friction.mu"}};
    static film made;
    (void)state;
    fst_params dry = truth();
    dry.friction_law = FST_FRICTION_COULOMB;
    make_film_of(&dry, &made);
    for (int law = 0; law < 2; ++law) {
        fst_params start = fst_default_params();
        fst_track track;
        fst_fit fit;
        fst_fit_options options = fst_default_fit_options();
        uint64_t seed = 5;
        make_track(&made, 0, 0.0, 0, 0.05, &track);
        (void)add_slip(&made, 0, 1.0, 0.0, 0.05, &seed, &track);
        start.friction_gamma = 290.0;
        start.friction_mu = 0.21;
        start.friction_law = law ? FST_FRICTION_COULOMB : FST_FRICTION_VISCOUS;
        options.free = keys[law];
        options.free_count = 2;
        options.drive = 11.3;
        assert_int_equal(fst_fit_track(&start, &track, &options, &fit, NULL), FST_OK);
        print_message("%s: %s %.5g +- %.2g, misfit of the slip %.3f, fitted in %d frames, chi^2 %.1f\n",
                      law ? "dry" : "viscous", keys[law][1], fit.parameters[1].value, fit.parameters[1].error,
                      fit.slip_misfit, fit.slip_fitted, fit.slip_chi2);
        if (law) {
            assert_true(fit.slip_misfit < 1.1 && fit.slip_chi2 < 1.4 * 2 * fit.slip_fitted);
            assert_true(fabs(fit.parameters[1].value - dry.friction_mu) < 3.0 * fit.parameters[1].error);
        } else {
            assert_true(fit.slip_misfit > 3.0);
        }
        fst_fit_free(&fit);
        fst_track_free(&track);
    }
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
        cmocka_unit_test_prestate(test_errors_with_slip, &made),
        cmocka_unit_test(test_dry_or_viscous),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
