/* Parameters from synthetic tables: what went in comes out, with errors that cover; wild numbers are named;
 * what cannot be known is said.  test_fit_long.c has the coverage of a hundred fits.
 * tests: fit/minpack.c fit/fit.c fit/search.c fit/problem.c fit/rows.c fit/space.c fit/errors.c fit/outliers.c fit/rivals.c
 *   fit/words.c fit/curve.c fit/minpack_module.c fit/matrix.c
 * labels: numbers */
#include "numeric.h"
#include "fit_tables.h"

static const char *const kappa_gamma[] = {"model.kappa", "friction.gamma"};

static fst_fit_options wishes(const char *const *keys, int count)
{
    fst_fit_options options = fst_default_fit_options();
    options.free = keys;
    options.free_count = count;
    return options;
}

static fst_params truth(void)
{
    fst_params params = fst_default_params();
    params.model_kappa = 1.72;
    params.friction_gamma = 289.0;
    return params;
}

static void must_fit(const fst_points *points, const fst_fit_options *options, fst_fit *fit)
{
    const fst_params start = fst_default_params();
    fst_error error = {0};
    if (fst_fit_points(&start, points, options, fit, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
}

static void test_exact_numbers_give_their_parameters(void **state)
{
    (void)state;
    const fst_params params = truth();
    fst_points points;
    fst_fit fit;
    assert_true(fit_table(&params, 10.5, 19.0, 4, &points));
    const fst_fit_options options = wishes(kappa_gamma, 2);
    must_fit(&points, &options, &fit);
    assert_true(fabs(fit.parameters[0].value / params.model_kappa - 1.0) < 1e-6);
    assert_true(fabs(fit.parameters[1].value / params.friction_gamma - 1.0) < 1e-6);
    assert_true(fit.chi2 < 1e-6);
    assert_int_equal(fit.points, 12);
    assert_int_equal(fit.dof, 10);
    assert_int_equal(fit.outlier_count, 0);
    /* kappa gamma^2 is known much better than kappa, and the two are degenerate. */
    const double strength = params.model_kappa * params.friction_gamma * params.friction_gamma;
    assert_true(fabs(fit.kappa_gamma2 / strength - 1.0) < 1e-6);
    assert_true(fit.kappa_gamma2_error / fit.kappa_gamma2 <
                0.2 * fit.parameters[0].error / fit.parameters[0].value);
    assert_true(fit.correlation[0][1] < -0.98 && fit.correlation[0][1] == fit.correlation[1][0]);
    assert_true(fit.correlation[0][0] == 1.0);
    /* The profile's interval is about as wide as two standard deviations, and holds the value. */
    for (int i = 0; i < 2; ++i) {
        const fst_fit_parameter *p = &fit.parameters[i];
        assert_true(p->interval[0] < p->value && p->value < p->interval[1]);
        assert_true(fabs((p->interval[1] - p->interval[0]) / (2.0 * p->error) - 1.0) < 0.15);
    }
    assert_non_null(strstr(fit.weakest, "friction.gamma"));
    fst_fit_free(&fit);
    free(points.rows);
}

/* The error of the error: refits of noisy tables scatter as the covariance says.  With 12 fits the variance of
 * two parameters, decorrelated, has a relative error of sqrt(2/24): bounds at about 3.5 times that. */
static void test_errors_cover(void **state)
{
    (void)state;
    enum { FITS = 6 };
    const fst_params params = truth();
    fst_points exact, noisy;
    uint64_t seed = 20;
    double gamma = 0.0, strength = 0.0;
    assert_true(fit_table(&params, 11.0, 19.0, 3, &exact));
    noisy = exact;
    noisy.rows = calloc(exact.count, sizeof *noisy.rows);
    const fst_fit_options options = wishes(kappa_gamma, 2);
    const double kappa_gamma2 = params.model_kappa * params.friction_gamma * params.friction_gamma;
    for (int i = 0; i < FITS; ++i) {
        fst_fit fit;
        memcpy(noisy.rows, exact.rows, exact.count * sizeof *exact.rows);
        fit_add_noise(&noisy, &seed);
        must_fit(&noisy, &options, &fit);
        gamma += pow((fit.parameters[1].value - params.friction_gamma) / fit.parameters[1].error, 2.0);
        strength += pow((fit.kappa_gamma2 - kappa_gamma2) / fit.kappa_gamma2_error, 2.0);
        fst_fit_free(&fit);
    }
    assert_true(gamma + strength > 3.0 && gamma + strength < 33.0);
    free(noisy.rows);
    free(exact.rows);
}

/* kappa gamma^2 is told where something that is sought enters it, with the error that follows from that: twice gamma's where
 * kappa is held.  Beside a real magnet B0 is but the unit, so a part's strength says nothing of it. */
static void test_kappa_gamma2_is_told_where_it_is_measured(void **state)
{
    (void)state;
    static const struct {
        int real, count;
        const char *keys[2];
        double power; /* with which the first key enters; 0: it is not told */
        const char *given;
    } rows[] = {{0, 1, {"model.kappa"}, 1.0, NULL},
                {0, 1, {"friction.gamma"}, 2.0, NULL},
                {0, 2, {"magnet.depth", "bead.radius"}, 0.0, NULL},
                {1, 1, {"bead.remanence"}, 1.0, NULL},
                {1, 1, {"bead.radius"}, -2.0, NULL},
                {1, 1, {"friction.gamma"}, 0.0, NULL},
                {1, 1, {"magnet.depth"}, 0.0, NULL},
                {1, 2, {"magnet.parts[0].remanence[0]", "friction.gamma"}, 0.0, NULL},
                {1, 1, {"magnet.parts[0].remanence[0]"}, 0.0, "bead.remanence=1.2+-0.01 T"}};
    fst_params setups[2] = {truth(), fst_default_params()};
    static const struct {
        const char *key, *value;
    } real[] = {{"magnet.shape", "parts"},
                {"magnet.parts[0].kind", "cuboid"},
                {"magnet.parts[0].size[0]", "44 mm"},
                {"magnet.parts[0].size[1]", "20 mm"},
                {"magnet.parts[0].size[2]", "8 mm"},
                {"magnet.parts[0].remanence[0]", "0.5 T"},
                {"magnet.depth", "14 mm"},
                {"bead.radius", "2 mm"},
                {"friction.gamma", "280"},
                {"bead.density", "7.5 g/cm^3"},
                {"bead.remanence", "1.2 T"}};
    for (size_t i = 0; i < sizeof real / sizeof *real; ++i)
        assert_int_equal(fst_params_set(&setups[1], real[i].key, real[i].value, NULL), FST_OK);
    fst_points points[2];
    for (int k = 0; k < 2; ++k)
        assert_true(fit_table(&setups[k], 11.0, 14.0, 2, &points[k]));
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i) {
        fst_fit fit;
        fst_error error = {0};
        fst_fit_options options = wishes(rows[i].keys, rows[i].count);
        options.given = &rows[i].given;
        options.given_count = rows[i].given != NULL;
        if (fst_fit_points(&setups[rows[i].real], &points[rows[i].real], &options, &fit, &error) != FST_OK)
            fail_msg("%s: %s: %s", rows[i].keys[0], error.where, error.sentence);
        const double expected = fabs(rows[i].power) * fit.parameters[0].error / fit.parameters[0].value;
        if (rows[i].power == 0.0)
            assert_true(isnan(fit.kappa_gamma2) && isnan(fit.kappa_gamma2_error));
        else
            assert_true(fabs(fit.kappa_gamma2_error / fit.kappa_gamma2 / expected - 1.0) < 1e-3);
        fst_fit_free(&fit);
    }
    for (int k = 0; k < 2; ++k)
        free(points[k].rows);
}

/* The least chi^2 where gamma is held. */
static double held(const fst_points *points, double gamma)
{
    static const char *const kappa[] = {"model.kappa"};
    fst_params start = fst_default_params();
    fst_fit_options options = wishes(kappa, 1);
    fst_fit fit;
    fst_error error;
    start.model_kappa *= pow(start.friction_gamma / gamma, 2.0);
    start.friction_gamma = gamma;
    if (fst_fit_points(&start, points, &options, &fit, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    const double chi2 = fit.chi2;
    fst_fit_free(&fit);
    return chi2;
}

/* Numbers that hardly tell kappa from gamma: chi^2 rises slowly on one side.  Two errors away it has risen by 4, as another
 * fit finds that holds gamma there; two errors of the curvature away it has not.  Of good numbers nothing is widened, and of
 * numbers that no model has no interval is sought. */
static void test_no_parabola(void **state)
{
    (void)state;
    const fst_params params = fst_default_params();
    const fst_fit_options options = wishes(kappa_gamma, 2);
    fst_points points;
    fst_fit fit;
    enum { GOOD = 1 }; /* the second table */
    uint64_t seed = 23767;
    for (int table = 0; table <= GOOD; ++table) {
        assert_true(fit_table(&params, 10.0, 20.0, 5, &points));
        for (size_t i = 0; i < points.count && table < GOOD; ++i)
            for (int q = 0; q < FST_MEASURED_COUNT; ++q)
                points.rows[i].error[q] *= 10.0;
        fit_add_noise(&points, &seed);
        must_fit(&points, &options, &fit);
        assert_int_equal(strstr(fit.remarks, "not a parabola") != NULL, fit.widened > 1.0);
        const double gamma = fit.parameters[1].value, error = fit.parameters[1].error;
        const double rise = held(&points, gamma + 2.0 * error) - fit.chi2,
                     by_curvature = held(&points, gamma + 2.0 * error / fit.widened) - fit.chi2;
        print_message("gamma %.1f +- %.1f, widened %.3f: chi^2 rises by %.2f, by the curvature %.2f\n", gamma,
                      error, fit.widened, rise, by_curvature);
        assert_true(rise > 4.0 / (1.2 * 1.2)); /* nothing is widened that is too small by less than a fifth */
        if (table < GOOD)
            assert_true(fit.widened > 1.5 && by_curvature < 3.0);
        else
            assert_true(fit.widened == 1.0);
        fst_fit_free(&fit);
        if (table == GOOD) {
            for (size_t i = 0; i < points.count; ++i)
                points.rows[i].value[FST_MEASURED_MEAN_R] *= 1.1;
            must_fit(&points, &options, &fit);
            assert_true(fit.error_scale > 3.0 && isnan(fit.parameters[0].interval[0]));
            assert_non_null(strstr(fit.remarks, "does not fit"));
            fst_fit_free(&fit);
        }
        free(points.rows);
    }
}

static void test_wild_number_is_named_and_does_not_drag(void **state)
{
    (void)state;
    const fst_params params = truth();
    fst_points points;
    fst_fit fit;
    assert_true(fit_table(&params, 10.5, 19.0, 4, &points));
    points.rows[2].value[FST_MEASURED_STD_R] += 2e-3; /* 67 standard deviations */
    const fst_fit_options options = wishes(kappa_gamma, 2);
    must_fit(&points, &options, &fit);
    assert_int_equal(fit.outlier_count, 1);
    assert_int_equal(fit.outliers[0].line, 4);
    assert_int_equal(fit.outliers[0].column, 4);
    assert_int_equal(fit.outliers[0].what, FST_MEASURED_STD_R);
    assert_true(fit.outliers[0].deviation > 60.0 && fit.outliers[0].deviation < 70.0);
    assert_int_equal(fit.points, 11);
    assert_true(fabs(fit.parameters[1].value / params.friction_gamma - 1.0) < 1e-5);
    fst_fit_free(&fit);
    free(points.rows);
}

/* A magnet that turns clockwise, and frequencies of the bead without their sign. */
static void test_signs(void **state)
{
    (void)state;
    const fst_params params = truth();
    fst_points points;
    fst_fit fit;
    assert_true(fit_table(&params, 10.5, 19.0, 3, &points));
    const fst_fit_options options = wishes(kappa_gamma, 2);
    for (size_t i = 0; i < points.count; ++i) {
        points.rows[i].frequency = -points.rows[i].frequency;
        points.rows[i].value[FST_MEASURED_BEAD_FREQUENCY] = -points.rows[i].value[FST_MEASURED_BEAD_FREQUENCY];
    }
    must_fit(&points, &options, &fit);
    assert_true(fabs(fit.parameters[1].value / params.friction_gamma - 1.0) < 1e-5);
    assert_string_equal(fit.remarks, "");
    fst_fit_free(&fit);
    for (size_t i = 0; i < points.count; ++i)
        points.rows[i].frequency = -points.rows[i].frequency;
    must_fit(&points, &options, &fit);
    assert_true(fabs(fit.parameters[1].value / params.friction_gamma - 1.0) < 1e-5);
    assert_non_null(strstr(fit.remarks, "without a sign"));
    fst_fit_free(&fit);
    free(points.rows);
}

/* What is given holds a parameter, and its error enters those of the others. */
static void test_what_is_given(void **state)
{
    (void)state;
    const fst_params params = truth();
    static const char *const given[] = {"friction.gamma=289+-3 1/s"};
    fst_points points;
    fst_fit fit;
    assert_true(fit_table(&params, 11.0, 19.0, 3, &points));
    fst_fit_options options = wishes(kappa_gamma, 1);
    options.given = given;
    options.given_count = 1;
    must_fit(&points, &options, &fit);
    assert_int_equal(fit.free_count, 1);
    assert_int_equal(fit.count, 2);
    assert_string_equal(fit.parameters[1].key, "friction.gamma");
    assert_true(fit.parameters[1].error > 2.0 && fit.parameters[1].error < 3.0);
    assert_true(fabs(fit.parameters[0].value / params.model_kappa - 1.0) < 1e-5);
    /* kappa is known as gamma^-2 is: twice gamma's relative error. */
    const double ratio = (fit.parameters[0].error / fit.parameters[0].value) /
                         (fit.parameters[1].error / fit.parameters[1].value);
    assert_true(ratio > 1.9 && ratio < 2.3);
    assert_int_equal(fit.dof, 8);
    fst_fit_free(&fit);
    free(points.rows);
}

/* An error of the frequency that moves every number of its row by the model's slope: the parameters' errors
 * grow. */
static void test_errors_of_the_frequency(void **state)
{
    (void)state;
    const fst_params params = truth();
    fst_points points;
    fst_fit exact, blurred;
    assert_true(fit_table(&params, 11.0, 19.0, 3, &points));
    const fst_fit_options options = wishes(kappa_gamma, 2);
    must_fit(&points, &options, &exact);
    for (size_t i = 0; i < points.count; ++i)
        points.rows[i].frequency_error = 0.5;
    /* One row truly stands 0.5 Hz off: its chi^2 is at most 1, whatever its three numbers say. */
    assert_true(fit_exact(&params, points.rows[1].frequency + 0.5, points.rows[1].value));
    must_fit(&points, &options, &blurred);
    assert_true(blurred.chi2 < 1.1);
    assert_true(blurred.kappa_gamma2_error > 1.3 * exact.kappa_gamma2_error);
    assert_true(fabs(blurred.kappa_gamma2 / exact.kappa_gamma2 - 1.0) <
                2.0 * blurred.kappa_gamma2_error / exact.kappa_gamma2);
    fst_fit_free(&exact);
    fst_fit_free(&blurred);
    free(points.rows);
}

static void test_what_cannot_be_fitted_is_said(void **state)
{
    (void)state;
    fst_params params = truth();
    fst_points points;
    fst_fit fit;
    fst_error error;
    assert_true(fit_table(&params, 11.0, 19.0, 2, &points));
    static const struct {
        const char *keys[2], *given, *says;
    } wrong[] = {
        {{"model.kapa", NULL}, NULL, "of those that can be fitted the nearest is model.kappa"},
        {{"drive.frequency", NULL}, NULL, "the table says"},
        {{"start.r", NULL}, NULL, "how the motion begins"},
        {{"friction.law", NULL}, NULL, "not a real number"},
        {{"model.kappa", "model.kappa"}, NULL, "twice"},
        {{"model.kappa", "bead.mass"}, NULL, "do not depend on bead.mass"},
        {{"bead.moment", NULL}, NULL, "no value from which"},
        {{"model.kappa", NULL}, "magnet.depth=16.2 mm", "KEY=VALUE+-ERROR"},
        {{"model.kappa", NULL}, "magnet.depth=16.2+-0 mm", "greater than 0"},
        {{"model.kappa", NULL}, "magnet.depth=16.2+-0.2 kg", "unit"},
        {{"model.kappa", NULL}, "magnet.deph=16.2+-0.2 mm", "magnet.depth"},
        {{NULL, NULL}, NULL, "which parameters are sought"},
    };
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        fst_fit_options options =
            wishes(wrong[i].keys, (wrong[i].keys[0] != NULL) + (wrong[i].keys[1] != NULL));
        options.given = &wrong[i].given;
        options.given_count = wrong[i].given != NULL;
        memset(&error, 0, sizeof error);
        assert_int_equal(fst_fit_points(&params, &points, &options, &fit, &error), FST_BAD_INPUT);
        if (!strstr(error.sentence, wrong[i].says))
            fail_msg("case %zu: \"%s\" does not say \"%s\"", i, error.sentence, wrong[i].says);
        assert_null(fit.remarks);
    }
    /* The moment and B0 act by their product alone. */
    static const char *const product[] = {"bead.moment", "magnet.b0"};
    fst_fit_options options = wishes(product, 2);
    params.model_kappa = NAN;
    params.bead_moment = 0.0625;
    params.magnet_b0 = 8e-3;
    assert_int_equal(fst_fit_points(&params, &points, &options, &fit, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "cannot tell these parameters apart: bead.moment, magnet.b0"));
    /* Fewer numbers than parameters. */
    options = wishes(kappa_gamma, 2);
    params = truth();
    points.count = 1;
    for (int q = 1; q < FST_MEASURED_COUNT; ++q)
        points.rows[0].value[q] = points.rows[0].error[q] = NAN;
    assert_int_equal(fst_fit_points(&params, &points, &options, &fit, &error), FST_BAD_INPUT);
    assert_non_null(strstr(error.sentence, "1 numbers, and 2 parameters"));
    free(points.rows);
}

static fst_status stop_soon(void *user, double fraction, const char *what, fst_error *error)
{
    int *asked = user;
    (void)what;
    assert_true(fraction >= 0.0 && fraction <= 1.0);
    (void)snprintf(error->sentence, sizeof error->sentence, "stopped");
    return ++*asked > 5 ? FST_INTERRUPTED : FST_OK;
}

static void test_caller_may_stop_it(void **state)
{
    (void)state;
    const fst_params params = truth(), start = fst_default_params();
    fst_points points;
    fst_fit fit;
    fst_error error;
    int asked = 0;
    const fst_progress progress = {&asked, stop_soon};
    assert_true(fit_table(&params, 11.0, 19.0, 3, &points));
    fst_fit_options options = wishes(kappa_gamma, 2);
    options.progress = &progress;
    assert_int_equal(fst_fit_points(&start, &points, &options, &fit, &error), FST_INTERRUPTED);
    assert_int_equal(asked, 6);
    free(points.rows);
}

int main(void)
{
    if (!fst_fit_present() || !fst_lapack_present())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_numbers_give_their_parameters),
        cmocka_unit_test(test_errors_cover),
        cmocka_unit_test(test_kappa_gamma2_is_told_where_it_is_measured),
        cmocka_unit_test(test_no_parabola),
        cmocka_unit_test(test_wild_number_is_named_and_does_not_drag),
        cmocka_unit_test(test_signs),
        cmocka_unit_test(test_what_is_given),
        cmocka_unit_test(test_errors_of_the_frequency),
        cmocka_unit_test(test_what_cannot_be_fitted_is_said),
        cmocka_unit_test(test_caller_may_stop_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
