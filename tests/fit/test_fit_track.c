/* Parameters from the places of one film.  The film is made of a run's samples, not of the Fourier series with
 * which the fit compares them; noise, tilt, exposure, lost and wild frames are put on top.
 * tests: fit/track.c fit/film.c fit/film_slip.c fit/path.c tracks/read_columns.c */
#include "numeric.h"
#include "fit_films.h"

static void test_plain_film_with_lost_and_wild_frames(void **state)
{
    fst_track track;
    fst_fit fit;
    fst_fit_options options = fst_default_fit_options();
    make_track(*state, 0, 0.0, 0, 0.1, &track);
    for (size_t i = 100; i < 104; ++i) {
        track.x[i] = track.y[i] = NAN;
        track.flag[i] = FST_FRAME_LOST;
    }
    track.x[200] += 1.2; /* 12 standard deviations, too little to be impossible */
    must_fit(&track, &options, &fit);
    check(&fit);
    fst_fit_free(&fit);
    fst_track_free(&track);
}

/* A film that begins before the motion has settled: a circle too wide that shrinks, by so little that no place is rejected.
 * The fit has the frames from where measure says that the motion has settled, and finds the truth. */
static void test_a_film_that_begins_too_early(void **state)
{
    fst_track track;
    fst_fit fit;
    fst_error error;
    fst_measurement measured;
    fst_measure_options measuring = fst_default_measure_options();
    fst_fit_options options = fst_default_fit_options();
    make_track(*state, 0, 0.0, 0, 0.1, &track);
    for (size_t i = 0; i < track.rows; ++i) {
        const double wider = 1.0 + 0.02 * exp(-(track.t[i] - track.t[0]) / 0.3);
        track.x[i] = 40.0 + wider * (track.x[i] - 40.0);
        track.y[i] = 30.0 + wider * (track.y[i] - 30.0);
    }
    measuring.drive = 11.3;
    assert_int_equal(fst_measure_track(&track, &measuring, &measured, &error), FST_OK);
    assert_true(measured.settled_after_s > 0.0);
    int settled = 0;
    for (size_t i = 0; i < track.rows; ++i)
        settled += track.t[i] - track.t[0] >= measured.settled_after_s;
    must_fit(&track, &options, &fit);
    print_message("settled after %.3g s: %d of %zu frames, %d coordinates\n", measured.settled_after_s, settled,
                  track.rows, (int)fit.points);
    assert_in_range(fit.points, 2 * settled * 98 / 100, 2 * settled);
    check(&fit);
    fst_fit_free(&fit);
    fst_track_free(&track);
}

/* The slip that the bead's marks showed agrees with the model's, in a picture as it is and, of a bead
 * larger by 1 %, mirrored, and says more of the friction than places that scatter by 0.3 mm do; slip of another motion is not believed, and errors that are too
 * small are widened; the numbers survive being written and read, and with them that no window smoothed the slip. */
static void test_slip(void **state)
{
    enum { WITHOUT, AS_IT_IS, MIRRORED, BACKWARDS, TOO_SURE, READ, WHOLE, CASES };
    double misfit[CASES], error[CASES];
    for (int which = 0; which < CASES; ++which) {
        fst_track track;
        fst_fit fit;
        fst_fit_options options = fst_default_fit_options();
        uint64_t seed = 17;
        const int mirrored = which == MIRRORED;
        make_track(*state, 0, 0.0, mirrored, 0.3, &track);
        const int told =
            which == WITHOUT ? 0 : add_slip(*state, mirrored, 1.0, mirrored ? 0.01 : 0.0, 0.02, &seed, &track);
        for (size_t i = 0; i < track.rows && which == TOO_SURE; ++i)
            track.turning[i].slip_error /= 3.0;
        for (size_t i = 0; i < track.rows && which == BACKWARDS; ++i)
            for (int k = 0; k < 2; ++k)
                track.turning[i].slip[k] *= -1.0;
        const film *f = *state;
        for (int i = 0; i < (int)track.rows && which == WHOLE; ++i) {
            track.rhythm = 10;
            track.turning[i].slip_error *= 0.25;
            for (int k = 0; k < 2; ++k)
                track.turning[i].slip[k] =
                    f->slip[EACH * i][k] + track.turning[i].slip_error * fit_normal(&seed);
        }
        if (which == READ || which == WHOLE) {
            const fst_track_options reading = fst_default_track_options();
            assert_int_equal(fst_track_write("slip.csv", &track, NULL), FST_OK);
            fst_track_free(&track);
            assert_int_equal(fst_track_read("slip.csv", &reading, &track, NULL, NULL), FST_OK);
            (void)remove("slip.csv");
            assert_int_equal(track.rhythm, which == WHOLE ? 10 : 0);
        }
        options.drive = mirrored ? -11.3 : 11.3;
        must_fit(&track, &options, &fit);
        assert_int_equal(fit.slip_frames, told);
        assert_int_equal(strstr(fit.remarks, "slip, measured in") != NULL, told > 0);
        misfit[which] = fit.slip_misfit;
        error[which] = fit.parameters[1].error;
        print_message("gamma %.2f +- %.2f, misfit of the slip %.4f, chi^2 %.1f of %d frames\n",
                      fit.parameters[1].value, error[which], misfit[which], fit.slip_chi2, fit.slip_fitted);
        assert_true(fabs(fit.parameters[1].value - 290.0) < 3.0 * error[which]);
        assert_true(isnan(fit.slip_chi2) == (fit.slip_fitted == 0));
        if (which == AS_IT_IS)
            assert_true(fabs(0.5 * fit.slip_chi2 / fit.slip_fitted - 1.0) < 0.3);
        fst_fit_free(&fit);
        fst_track_free(&track);
    }
    assert_true(fabs(misfit[AS_IT_IS] - 1.0) < 0.1 && fabs(misfit[MIRRORED] - 1.0) < 0.1);
    assert_true(error[AS_IT_IS] < 0.5 * error[WITHOUT] && error[MIRRORED] < 0.5 * error[WITHOUT]);
    assert_true(fabs(error[TOO_SURE] / error[AS_IT_IS] - 1.0) <
                0.1); /* what is left tells that errors are too small */
    assert_true(misfit[BACKWARDS] > 5.0 && error[BACKWARDS] > 0.8 * error[WITHOUT]);
    assert_true(fabs(misfit[READ] - misfit[AS_IT_IS]) < 1e-3);
    assert_true(fabs(misfit[WHOLE] - 1.0) < 0.1);
}

/* A scale that is wrong by a tenth gives a path that the model does not have: the places are farther from it than they
 * scatter, and this is said; of a right one it is not. */
static void test_doubt(void **state)
{
    for (int wrong = 0; wrong < 2; ++wrong) {
        fst_track track;
        fst_fit fit;
        fst_fit_options options = fst_default_fit_options();
        make_track(*state, 0, 0.0, 0, 0.1, &track);
        for (size_t i = 0; i < track.rows && wrong; ++i) {
            track.x[i] *= 1.1;
            track.y[i] *= 1.1;
        }
        options.drive = 11.3;
        must_fit(&track, &options, &fit);
        assert_int_equal(strstr(fit.remarks, "from the model's path as they scatter") != NULL, wrong);
        fst_fit_free(&fit);
        fst_track_free(&track);
    }
}

static void test_refusals(void **state)
{
    const fst_params start = fst_default_params();
    fst_track track;
    fst_fit fit;
    fst_error error;
    fst_fit_options options = fst_default_fit_options();
    options.free = fit_keys;
    options.free_count = 2;
    make_track(*state, 0, 0.0, 0, 0.05, &track);
    (void)snprintf(track.length_unit, sizeof track.length_unit, "px");
    assert_int_equal(fst_fit_track(&start, &track, &options, &fit, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "pixels"));
    (void)snprintf(track.length_unit, sizeof track.length_unit, "mm");
    static const char *const lost[] = {"model.kappa", "bead.mass"};
    options.free = lost;
    assert_int_equal(fst_fit_track(&start, &track, &options, &fit, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "apart"));
    fst_track_free(&track);
}

/* With the sign of a drive that the magnet did not have, there is no path, whatever is sought: this ends the fit, and says
 * why, also in a film that is mirrored.  Places that scatter by a sixth of the path's size have one. */
static void test_the_other_sense(void **state)
{
    const fst_params start = fst_default_params();
    fst_track track;
    fst_fit fit;
    fst_error error;
    for (int mirrored = 0; mirrored < 2; ++mirrored) {
        fst_fit_options options = fst_default_fit_options();
        options.free = fit_keys;
        options.free_count = 1 + mirrored;
        options.drive = mirrored ? 11.3 : -11.3;
        make_track(*state, 0, 0.0, mirrored, 0.1, &track);
        assert_int_equal(fst_fit_track(&start, &track, &options, &fit, &error), FST_BAD_INPUT);
        assert_string_equal(error.where, "fst_fit_options.drive");
        assert_non_null(strstr(error.sentence, "mirrored, or the drive has the other sign"));
        assert_non_null(strstr(error.sentence, mirrored ? "try -11.3 Hz" : "try 11.3 Hz"));
        fst_track_free(&track);
    }
    fst_fit_options options = fst_default_fit_options();
    options.drive = 11.3;
    make_track(*state, 0, 0.0, 0, 3.0, &track);
    must_fit(&track, &options, &fit);
    assert_true(fabs(fit.parameters[1].value - 290.0) < 4.0 * fit.parameters[1].error);
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
        cmocka_unit_test_prestate(test_plain_film_with_lost_and_wild_frames, &made),
        cmocka_unit_test_prestate(test_a_film_that_begins_too_early, &made),
        cmocka_unit_test_prestate(test_slip, &made),
        cmocka_unit_test_prestate(test_doubt, &made),
        cmocka_unit_test_prestate(test_refusals, &made),
        cmocka_unit_test_prestate(test_the_other_sense, &made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
