/* Smoothed maps by the dozen: a noise told rightly is doubted as seldom as is said, one told wrongly always, and the map's
 * own noise is found; errors cover the truth where the probe was turned too, and drawn fields spread as they say.
 * labels: long
 * tests: model/charges.c model/charge_field.c model/smooth_map.c */
#include "noisy_maps.h"

/* 20 x 20 samples, 3.6 mm apart. */
static void take_few(void)
{
    side = 20;
    step = 3.6e-3;
}

static fst_map_fit fit_told(int which, uint64_t seed, double share, double *sigma)
{
    const fst_params p = magnet(which);
    fst_field_map *noisy = measure(&p, 0.0025, seed, 0.0, 0.0, sigma),
                  *made = smooth_told(noisy, HEIGHT, 0, share * *sigma);
    const fst_map_fit fit = fst_field_map_describe(made).fit;
    fst_field_map_free(made);
    fst_field_map_free(noisy);
    return fit;
}

/* At most 5 % of true noises are doubted, 2.5 % to either side: of 120, more than 12 with one in a hundred. */
static void test_false_alarms(void **unused)
{
    (void)unused;
    enum { MAPS = 40 };
    int doubted[2] = {0, 0}, missed = 0;
    double mean = 0.0, square = 0.0;
    take_few();
    for (int which = 0; which < MAGNETS; ++which)
        for (uint64_t seed = 1; seed <= MAPS; ++seed) {
            double sigma;
            const fst_map_fit fit = fit_told(which, 100 * (uint64_t)which + seed, 1.0, &sigma);
            const double z = (fit.chi2 - 0.5 * (fit.bound[0] + fit.bound[1])) / (fit.bound[1] - fit.bound[0]);
            doubted[0] += fit.verdict == FST_NOISE_TOO_LARGE;
            doubted[1] += fit.verdict == FST_NOISE_TOO_SMALL || fit.verdict == FST_NOISE_MISFIT;
            missed += sigma < fit.seen[1] || sigma > fit.seen[2];
            mean += z / (MAGNETS * MAPS);
            square += z * z / (MAGNETS * MAPS);
        }
    print_message(
        "doubted: %d as too large, %d as too small, of %d; mean %.3f, deviation %.3f of the bound's width\n",
        doubted[0], doubted[1], MAGNETS * MAPS, mean, sqrt(square - mean * mean));
    assert_in_range(doubted[0] + doubted[1], 0, 12);
    assert_int_equal(missed, doubted[0] + doubted[1]);
    CHECK_CLOSE(mean, 0.0, 0.15);
    CHECK_CLOSE(sqrt(square - mean * mean), 0.25,
                0.06); /* the bound is 3.92 deviations wide, or a little more */
}

static void test_wrong_noises(void **unused)
{
    (void)unused;
    enum { MAPS = 10 };
    int outside = 0;
    take_few();
    for (int which = 0; which < MAGNETS; ++which)
        for (uint64_t seed = 1; seed <= MAPS; ++seed)
            for (int large = 0; large < 2; ++large) {
                double sigma;
                const fst_map_fit fit =
                    fit_told(which, 900 + 100 * (uint64_t)which + seed, large ? 2.0 : 0.5, &sigma);
                assert_int_equal(fit.verdict, large ? FST_NOISE_TOO_LARGE : FST_NOISE_TOO_SMALL);
                outside += sigma < fit.seen[1] || sigma > fit.seen[2];
                CHECK_CLOSE(fit.seen[0], sigma, 0.1 * sigma);
            }
    print_message("the noise is outside of what is said %d times of %d\n", outside, 2 * MAGNETS * MAPS);
    assert_in_range(outside, 0, 8); /* 5 % of 60 are 3; the two of a pair are of one map */
}

/* Errors cover the truth over probes that were turned. */
static void test_turned_probe(void **unused)
{
    (void)unused;
    enum { MAPS = 24 };
    comparison all = {.count = 0.0};
    take_few();
    for (uint64_t seed = 1; seed <= MAPS; ++seed) {
        const fst_params p = magnet(1);
        double sigma;
        fst_field_map *turned = measure(&p, 0.0025, 300 + seed, 2.0 / DEGREES, 0.3e-3, &sigma),
                      *made = smooth(turned, HEIGHT, 1);
        compare(&p, made, HEIGHT, &all);
        fst_field_map_free(made);
        fst_field_map_free(turned);
    }
    print_message("B within 1 and 2 errors: %.3f %.3f\n", all.of_b[0] / (3.0 * all.count),
                  all.of_b[1] / (3.0 * all.count));
    check_coverage(&all);
}

/* Far above a magnet the field is so smooth that the angles' errors are a quarter of that of dBx/dx, and nothing of that
 * of dBy/dy, whose coverage is then that of a probe which is not turned. */
static void test_angles_of_a_smooth_field(void **unused)
{
    (void)unused;
    enum { MAPS = 40, PLACES = 4 };
    const fst_params p = magnet(1);
    double off[2] = {0.0, 0.0}, told[2] = {0.0, 0.0};
    take_few();
    above = 90e-3;
    fst_model *truth = model_at(&p, above);
    const double unit = fst_model_groups(truth).field_unit / MAP_B0;
    for (uint64_t seed = 1; seed <= MAPS; ++seed) {
        double sigma, b[3], g[2][3][3], eb[3], eg[3][3], ef[3];
        fst_field_map *turned = measure(&p, 0.0025, 1000 + seed, 2.0 / DEGREES, 0.0, &sigma),
                      *made = smooth(turned, above, 1);
        fst_model *model = model_over(&p, made, above);
        for (int i = 0; i < PLACES; ++i) {
            const double x = 0.4 * i - 0.6, y = 0.2 * i - 0.3;
            fst_field(truth, x, y, b, g[0]);
            fst_field(model, x, y, b, g[1]);
            assert_int_equal(fst_field_error(model, x, y, eb, eg, ef), 1);
            for (int k = 0; k < 2; ++k) {
                off[k] += (g[1][k][k] - unit * g[0][k][k]) * (g[1][k][k] - unit * g[0][k][k]);
                told[k] += eg[k][k] * eg[k][k];
            }
        }
        fst_model_free(model);
        fst_field_map_free(made);
        fst_field_map_free(turned);
    }
    fst_model_free(truth);
    above = HEIGHT;
    const double ratio[2] = {sqrt(off[0] / told[0]), sqrt(off[1] / told[1])};
    print_message("rms error over the one told: dBx/dx %.3f, dBy/dy %.3f\n", ratio[0], ratio[1]);
    CHECK_WITHIN(ratio[0], 0.75, 1.1);
    CHECK_CLOSE(ratio[0] / ratio[1], 1.0, 0.1); /* 1.29 without the angles */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_false_alarms),
        cmocka_unit_test(test_wrong_noises),
        cmocka_unit_test(test_turned_probe),
        cmocka_unit_test(test_angles_of_a_smooth_field),
    };
    return cmocka_run_group_tests_name("smoothed, many", tests, NULL, NULL);
}
