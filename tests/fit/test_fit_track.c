/* Parameters from the places of one film.  The film is made of a run's samples, not of the Fourier series with
 * which the fit compares them; noise, tilt, exposure, lost and wild frames are put on top.
 * tests: fit/track.c fit/path.c */
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

int main(void)
{
    static film made;
    if (!fst_fit_present() || !fst_lapack_present())
        return 77;
    make_film(&made);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_plain_film_with_lost_and_wild_frames, &made),
        cmocka_unit_test_prestate(test_a_film_that_begins_too_early, &made),
        cmocka_unit_test_prestate(test_refusals, &made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
