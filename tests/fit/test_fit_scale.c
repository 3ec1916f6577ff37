/* A scale that is wrong by a known share: all lengths of a table, or of a film, are wrong alike, and the errors of
 * kappa gamma^2 and gamma cover the truth all the same.
 * tests: fit/problem.c fit/track.c
 * labels: slow numbers */
#include "numeric.h"
#include "fit_films.h"

#define SCALE_ERROR 0.01

static void fit_one(const fst_points *points, fst_fit *fit)
{
    const fst_params start = fst_default_params();
    fst_fit_options options = fst_default_fit_options();
    fst_error error;
    options.free = fit_keys;
    options.free_count = 2;
    assert_int_equal(fst_fit_points(&start, points, &options, fit, &error), FST_OK);
}

/* By how many of its errors kappa gamma^2 is wrong, and gamma. */
static void pulls(const fst_fit *fit, double out[2])
{
    const fst_params right = truth();
    const double product = right.model_kappa * right.friction_gamma * right.friction_gamma;
    out[0] = (fit->kappa_gamma2 - product) / fit->kappa_gamma2_error;
    out[1] = (fit->parameters[1].value - right.friction_gamma) / fit->parameters[1].error;
}

/* Of 16 tables about 68 % are within one error.  Taken for right, the scale would make them wrong by
 * more. */
static void tables(void **state)
{
    (void)state;
    enum { TABLES = 16, COMPARED = 4 };
    const fst_params right = truth();
    fst_points exact, points;
    uint64_t seed = 5;
    int within[2] = {0, 0};
    double known = 0.0, taken_for_right = 0.0; /* mean squares of what kappa gamma^2 is wrong by, in errors */
    assert_true(fit_table(&right, 10.0, 17.0, 3, &exact));
    for (int k = 0; k < TABLES; ++k) {
        const double scale = 1.0 + SCALE_ERROR * fit_normal(&seed);
        double pull[2];
        fst_fit fit;
        points = exact;
        points.rows = malloc(exact.count * sizeof *points.rows);
        assert_non_null(points.rows);
        memcpy(points.rows, exact.rows, exact.count * sizeof *points.rows);
        fit_add_noise(&points, &seed);
        for (size_t i = 0; i < points.count; ++i)
            for (int q = 0; q < FST_MEASURED_BEAD_FREQUENCY; ++q)
                points.rows[i].value[q] *= scale;
        if (k < COMPARED) {
            fit_one(&points, &fit);
            pulls(&fit, pull);
            taken_for_right += pow(pull[0] * fit.error_scale, 2.0) / COMPARED;
            fst_fit_free(&fit);
        }
        for (size_t i = 0; i < points.count; ++i)
            points.rows[i].scale_error = SCALE_ERROR;
        fit_one(&points, &fit);
        pulls(&fit, pull);
        known += pull[0] * pull[0] / TABLES;
        for (int i = 0; i < 2; ++i)
            within[i] += fabs(pull[i]) < 1.0;
        assert_true(fit.outlier_count <= 1);
        assert_true(fit.chi2 / fit.dof < 3.5);
        fst_fit_free(&fit);
        free(points.rows);
    }
    print_message("within one error: kappa gamma^2 %d of %d, gamma %d; mean square %.2f, of a scale taken for "
                  "right %.2f\n",
                  within[0], TABLES, within[1], known, taken_for_right);
    for (int i = 0; i < 2; ++i)
        assert_in_range(within[i], TABLES * 54 / 100, TABLES * 82 / 100);
    assert_true(known < 1.7 && taken_for_right > 3.0);
    fst_points_free(&exact);
}

/* A film whose scale is 1 % too great: the shape of the path tells it, where the fit knows that it may be wrong. */
static void film_of_a_wrong_scale(void **state)
{
    const fst_params start = fst_default_params();
    fst_fit_options options = fst_default_fit_options();
    fst_track track;
    fst_fit fit;
    fst_error error;
    double pull[4][2];
    options.free = fit_keys;
    options.free_count = 2;
    options.drive = 11.3;
    for (int i = 0; i < 4; ++i) {
        const double scale = i % 2 ? 1.0 + SCALE_ERROR : 1.0;
        make_track(*state, 0, 0.0, 0, 0.1, &track);
        for (size_t k = 0; k < track.rows; ++k) {
            track.x[k] *= scale;
            track.y[k] *= scale;
        }
        track.scale_error = i < 2 ? 0.0 : SCALE_ERROR;
        assert_int_equal(fst_fit_track(&start, &track, &options, &fit, &error), FST_OK);
        pulls(&fit, pull[i]);
        fst_fit_free(&fit);
        fst_track_free(&track);
    }
    print_message(
        "kappa gamma^2 is wrong by %.2f and %.2f errors, by %.2f and %.2f where the scale is taken for right\n",
        pull[2][0], pull[3][0], pull[0][0], pull[1][0]);
    assert_true(fabs(pull[1][0] - pull[0][0]) > 3.0);
    for (int i = 2; i < 4; ++i)
        assert_true(fabs(pull[i][0]) < 2.0 && fabs(pull[i][1]) < 2.0);
    assert_true(fabs(pull[3][0] - pull[2][0]) < 0.3);
}

int main(void)
{
    static film made;
    if (!fst_fit_present() || !fst_lapack_present())
        return 77;
    make_film(&made);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables),
        cmocka_unit_test_prestate(film_of_a_wrong_scale, &made),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
