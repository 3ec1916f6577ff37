/* The coverage of the errors of a fit: of a hundred tables with known noise (FESTOON_FITS: of so many) about 68 in 100
 * must give each parameter within one standard deviation, and about 68 within the profile's interval.  A wild number in
 * each of half as many changes nothing of it.
 * tests: fit/fit.c fit/errors.c fit/bootstrap.c fit/rivals.c
 * labels: long slow */
#include "numeric.h"
#include "fit_tables.h"

#include <stdio.h>

enum { ROWS = 5 };

static int fits_wanted(void)
{
    const char *given = getenv("FESTOON_FITS");
    const int fits = given ? atoi(given) : 100;
    return fits > 10 ? fits : 10;
}

static const char *const keys[] = {"model.kappa", "friction.gamma"};

/* How often the truth lay within one standard deviation, two, and the interval; for kappa, gamma, kappa
 * gamma^2. */
typedef struct coverage {
    int one[3], two[3], interval[2], outliers, named;
    double chi2;
} coverage;

static void count(coverage *c, const fst_fit *fit, const double *truth)
{
    const double value[] = {fit->parameters[0].value, fit->parameters[1].value, fit->kappa_gamma2};
    const double error[] = {fit->parameters[0].error, fit->parameters[1].error, fit->kappa_gamma2_error};
    for (int i = 0; i < 3; ++i) {
        c->one[i] += fabs(value[i] - truth[i]) < error[i];
        c->two[i] += fabs(value[i] - truth[i]) < 2.0 * error[i];
    }
    for (int i = 0; i < 2; ++i)
        c->interval[i] +=
            fit->parameters[i].interval[0] < truth[i] && truth[i] < fit->parameters[i].interval[1];
    c->outliers += (int)fit->outlier_count;
    c->chi2 += fit->chi2 / fit->dof;
}

static coverage fit_many(const fst_params *truth_params, int fits, int wild)
{
    const fst_params start = fst_default_params();
    const double strength = truth_params->model_kappa * pow(truth_params->friction_gamma, 2.0);
    const double truth[] = {truth_params->model_kappa, truth_params->friction_gamma, strength};
    coverage c = {0};
    uint64_t seed = 7;
    fst_points exact, noisy;
    assert_true(fit_table(truth_params, 10.5, 19.5, ROWS, &exact));
    noisy = exact;
    noisy.rows = calloc(ROWS, sizeof *noisy.rows);
    fst_fit_options options = fst_default_fit_options();
    options.free = keys;
    options.free_count = 2;
    for (int i = 0; i < fits; ++i) {
        fst_fit fit;
        fst_error error;
        memcpy(noisy.rows, exact.rows, ROWS * sizeof *exact.rows);
        fit_add_noise(&noisy, &seed);
        const int row = i % ROWS, what = i % FST_MEASURED_COUNT;
        if (wild)
            noisy.rows[row].value[what] += (i % 2 ? 20.0 : -20.0) * noisy.rows[row].error[what];
        if (fst_fit_points(&start, &noisy, &options, &fit, &error) != FST_OK)
            fail_msg("fit %d: %s: %s", i, error.where, error.sentence);
        count(&c, &fit, truth);
        for (size_t k = 0; k < fit.outlier_count; ++k)
            c.named += fit.outliers[k].line == row + 2 && (int)fit.outliers[k].what == what;
        fst_fit_free(&fit);
    }
    free(noisy.rows);
    free(exact.rows);
    (void)printf(
        "within one: %d %d %d, two: %d %d %d, interval: %d %d, outliers %d (wild ones %d), chi^2/dof %.3f\n",
        c.one[0], c.one[1], c.one[2], c.two[0], c.two[1], c.two[2], c.interval[0], c.interval[1], c.outliers,
        c.named, c.chi2 / fits);
    return c;
}

/* How many of n have a property of this probability with no more than `rest` of all samples below. */
static int quantile(int n, double probability, double rest)
{
    long double term = powl(1.0 - probability, n), sum = term; /* of a thousand fits, too little for a double */
    int k = 0;
    while (sum < rest && k < n) {
        term *= (n - k) * probability / ((k + 1) * (1.0 - probability));
        sum += term;
        ++k;
    }
    return k;
}

/* Of 1000 samples of that size 997 lie between these bounds for one standard deviation, and as many above that for
 * two. */
static void check(const coverage *c, int fits)
{
    const double one = 0.6827, two = 0.9545, rest = 1.3e-3;
    const int fewest = quantile(fits, one, rest), most = fits - quantile(fits, 1.0 - one, rest);
    for (int i = 0; i < 3; ++i) {
        assert_in_range(c->one[i], fewest, most);
        assert_in_range(c->two[i], quantile(fits, two, rest), fits);
    }
    for (int i = 0; i < 2; ++i)
        assert_in_range(c->interval[i], fewest, most);
}

/* What the bounds are for samples that tables of the binomial distribution have. */
static void test_bounds(void **state)
{
    (void)state;
    assert_int_equal(quantile(100, 0.6827, 1.3e-3), 54);
    assert_int_equal(50 - quantile(50, 1.0 - 0.6827, 1.3e-3), 43);
    assert_int_equal(quantile(10, 0.5, 0.0107421875), 1);
    assert_int_equal(quantile(10, 0.5, 0.0107421876), 2);
    assert_int_equal(quantile(20, 0.5, 0.0206947326), 5);
}

static void test_coverage(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    params.model_kappa = 1.4;
    params.friction_gamma = 330.0;
    const int fits = fits_wanted();
    const coverage c = fit_many(&params, fits, 0);
    check(&c, fits);
    assert_in_range(c.outliers, 0, 2);
    const double deviation = sqrt(2.0 / (13.0 * fits)); /* of a mean of chi^2 / 13 */
    assert_true(fabs(c.chi2 / fits - 1.0) < 3.8 * deviation);
}

static void test_coverage_beside_a_wild_number(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    params.model_kappa = 1.8;
    params.friction_gamma = 270.0;
    const int fits = fits_wanted() / 2;
    const coverage c = fit_many(&params, fits, 1);
    check(&c, fits);
    assert_int_equal(c.named, fits);
    assert_in_range(c.outliers, fits, fits + 2);
}

/* The bootstrap knows nothing of the table's errors, and yet finds those of the covariance, within chance: of 24 numbers
 * whose scatter is as the table says, the mean square of 24 residuals is known to 0.3, so its root to 0.15; drawing anew
 * adds what it drops.  And AICc is what Sugiura's formula makes of chi^2. */
static void test_bootstrap_and_information(void **state)
{
    (void)state;
    fst_params params = fst_default_params();
    const fst_params start = params;
    double ratio = 0.0;
    uint64_t seed = 5;
    params.model_kappa = 1.72;
    params.friction_gamma = 289.0;
    for (int i = 0; i < 3; ++i) {
        fst_points points;
        fst_fit fit;
        fst_error error;
        fst_fit_options options = fst_default_fit_options();
        assert_true(fit_table(&params, 10.5, 19.5, 8, &points));
        fit_add_noise(&points, &seed);
        options.free = keys;
        options.free_count = 2;
        options.bootstrap = 60;
        if (fst_fit_points(&start, &points, &options, &fit, &error) != FST_OK)
            fail_msg("%s: %s", error.where, error.sentence);
        assert_true(fit.bootstrap_count > 55);
        for (int k = 0; k < 2; ++k)
            ratio += fit.parameters[k].bootstrap_error / fit.parameters[k].error / 6.0;
        assert_int_equal(fit.points, 24);
        assert_true(fabs(fit.aicc - (fit.chi2 + 2.0 * 2.0 + 2.0 * 2.0 * 3.0 / (24.0 - 2.0 - 1.0))) < 1e-12);
        fst_fit_free(&fit);
        free(points.rows);
    }
    if (!(ratio > 0.75 && ratio < 1.25))
        fail_msg("the bootstrap's errors are %.3f of those of the covariance", ratio);
}

/* Each rival has as many parameters as the law that made the table, so AICc sets them in the order of chi^2, and is what
 * Sugiura's formula makes of it.  The maker's law leaves no more than chance, the others more. */
static void test_rivals(void **state)
{
    (void)state;
    const fst_params truth = fst_default_params();
    uint64_t seed = 3;
    fst_points points;
    fst_fit fit;
    fst_error error;
    fst_fit_options options = fst_default_fit_options();
    options.free = keys;
    options.free_count = 2;
    options.rivals = 1;
    assert_true(fit_table(&truth, 10.7, 19.0, ROWS, &points));
    fit_add_noise(&points, &seed);
    if (fst_fit_points(&truth, &points, &options, &fit, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    assert_int_equal(fit.rival_count, 4);
    for (int i = 0; i < fit.rival_count; ++i) {
        const fst_fit_rival *rival = &fit.rivals[i];
        const double chi2 = rival->chi2, n = 3.0 * ROWS;
        print_message("law %d, dynamics %d: chi^2 %.3f, AICc %.3f\n", (int)rival->law, (int)rival->dynamics,
                      chi2, rival->aicc);
        if (!rival->fitted)
            continue;
        assert_true(fabs(rival->aicc - (chi2 + 4.0 + 12.0 / (n - 3.0))) < 1e-12 * chi2);
        if (rival->law == truth.friction_law && rival->dynamics == truth.model_dynamics)
            assert_true(chi2 == fit.chi2 && chi2 > 3.0 &&
                        chi2 < 35.0); /* 13 degrees of freedom: 0.2 to 99.9 in 100 */
        else
            assert_true(chi2 > fit.chi2);
    }
    fst_fit_free(&fit);
    free(points.rows);
}

/* A lost minus makes a number wrong by a thousand errors: it drags the plain search far away, and the robust
 * one must find back without it. */
static void test_lost_sign_beside_a_wild_number(void **state)
{
    (void)state;
    const fst_params start = fst_default_params();
    fst_params params = start;
    fst_points points;
    fst_fit fit;
    fst_error error;
    params.model_kappa = 1.6;
    params.friction_gamma = 300.0;
    assert_true(fit_table(&params, 10.7, 19.9, 8, &points));
    points.rows[3].value[FST_MEASURED_MEAN_R] += 3e-3;
    points.rows[6].value[FST_MEASURED_BEAD_FREQUENCY] *= -1.0;
    fst_fit_options options = fst_default_fit_options();
    options.free = keys;
    options.free_count = 2;
    if (fst_fit_points(&start, &points, &options, &fit, &error) != FST_OK)
        fail_msg("%s: %s", error.where, error.sentence);
    assert_int_equal(fit.outlier_count, 2);
    assert_true(fit.outliers[0].line == 5 && fit.outliers[0].what == FST_MEASURED_MEAN_R);
    assert_true(fit.outliers[1].line == 8 && fit.outliers[1].what == FST_MEASURED_BEAD_FREQUENCY);
    assert_true(fabs(fit.parameters[0].value / params.model_kappa - 1.0) < 1e-4);
    assert_true(fabs(fit.parameters[1].value / params.friction_gamma - 1.0) < 1e-4);
    fst_fit_free(&fit);
    free(points.rows);
}

int main(void)
{
    if (!fst_fit_present() || !fst_lapack_present())
        return 77;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bounds),
        cmocka_unit_test(test_coverage),
        cmocka_unit_test(test_bootstrap_and_information),
        cmocka_unit_test(test_rivals),
        cmocka_unit_test(test_coverage_beside_a_wild_number),
        cmocka_unit_test(test_lost_sign_beside_a_wild_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
