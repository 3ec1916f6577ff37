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

/* A film that begins before the motion has settled: a circle a fifth too wide that shrinks.  The fit begins where measure says
 * that the motion has settled, and finds the truth. */
static void test_a_film_that_begins_too_early(void **state)
{
    fst_track track;
    fst_fit fit;
    fst_fit_options options = fst_default_fit_options();
    make_track(*state, 0, 0.0, 0, 0.05, &track);
    for (size_t i = 0; i < track.rows; ++i) {
        const double wider = 1.0 + 0.2 * exp(-(track.t[i] - track.t[0]) / 0.15);
        track.x[i] = 40.0 + wider * (track.x[i] - 40.0);
        track.y[i] = 30.0 + wider * (track.y[i] - 30.0);
    }
    must_fit(&track, &options, &fit);
    assert_in_range(fit.points, track.rows,
                    2 * track.rows * 15 / 16); /* two coordinates a frame, and a sixteenth less */
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
