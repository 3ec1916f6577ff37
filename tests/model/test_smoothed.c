/* Charges below a noisy map: their field has neither curl nor divergence, pulls a bead as the magnet does, at other
 * heights too, and what is told of its errors covers the truth; a turned probe is found; fields that are none are
 * refused.
 * tests: model/charges.c model/charge_sums.c model/charge_field.c model/smooth_map.c
 * labels: numbers */
#include "noisy_maps.h"

enum { SEEDS = 2 };

/* ------------------------------------------------------------------ noise */

static void test_noise(void **unused)
{
    (void)unused;
    comparison all = {.count = 0.0};
    for (int which = 0; which < MAGNETS; ++which)
        for (uint64_t seed = 1; seed <= SEEDS; ++seed) {
            const fst_params p = magnet(which);
            double sigma;
            comparison one = {.count = 0.0};
            fst_field_map *noisy = measure(&p, 0.0025, seed, 0.0, 0.0, &sigma),
                          *made = smooth(noisy, HEIGHT, 0);
            const fst_field_map_facts facts = fst_field_map_describe(made);
            CHECK_WITHIN(fst_field_map_describe(noisy).curl, 0.1, 1.0);
            CHECK_WITHIN(facts.curl, 0.0, 1e-5);
            CHECK_CLOSE(facts.fit.noise, sigma, 0.02 * sigma); /* sqrt(2 x 10800) numbers: 0.7 % */
            CHECK_CLOSE(facts.fit.chi2, 1.0, 0.1);
            CHECK_WITHIN(facts.fit.free, 10000, 10800);
            assert_int_equal(fst_field_map_describe(noisy).fit.charges, 0);
            compare(&p, made, HEIGHT, &one);
            CHECK_WITHIN(one.force, 0.0, 0.01 * one.greatest_force);
            compare(&p, made, HEIGHT, &all);
            fst_field_map_free(made);
            fst_field_map_free(noisy);
        }
    check_coverage(&all);
}

/* Maps of two heights know the derivatives by z, which one map takes for granted. */
static void test_curl_and_divergence(void **unused)
{
    (void)unused;
    const fst_params p = magnet(1);
    const double apart = 0.02e-3;
    double sigma, sums[2] = {0.0, 0.0};
    fst_field_map *noisy = measure(&p, 0.0025, 5, 0.0, 0.0, &sigma), *maps[3];
    fst_model *models[3];
    for (int i = 0; i < 3; ++i) {
        maps[i] = smooth(noisy, HEIGHT + (i - 1) * apart, 0);
        models[i] = model_over(&p, maps[i], HEIGHT + (i - 1) * apart);
    }
    for (int i = 0; i < 100; ++i) {
        double b[3][3], g[3][3], unused_g[3][3];
        const double x = i % 10 * 0.2 - 0.9, y = i / 10 * 0.2 - 0.9;
        fst_field(models[0], x, y, b[0], unused_g);
        fst_field(models[1], x, y, b[1], g);
        fst_field(models[2], x, y, b[2], unused_g);
        double up[3];
        for (int k = 0; k < 3; ++k)
            up[k] = (b[2][k] - b[0][k]) / (2.0 * apart / L);
        const double faults[4] = {g[0][0] + g[1][1] + up[2], g[0][1] - g[1][0], up[0] - g[2][0],
                                  up[1] - g[2][1]};
        for (int k = 0; k < 4; ++k)
            sums[0] += faults[k] * faults[k];
        for (int k = 0; k < 9; ++k)
            sums[1] += g[k / 3][k % 3] * g[k / 3][k % 3];
    }
    CHECK_WITHIN(sqrt(sums[0] / sums[1]), 0.0, 1e-4);
    for (int i = 0; i < 3; ++i) {
        fst_model_free(models[i]);
        fst_field_map_free(maps[i]);
    }
    fst_field_map_free(noisy);
}

/* ------------------------------------------------------------------ other heights */

static void test_heights(void **unused)
{
    (void)unused;
    static const double heights[3] = {HEIGHT - 4e-3, HEIGHT, HEIGHT + 10e-3};
    comparison all[3] = {{.count = 0.0}, {.count = 0.0}, {.count = 0.0}};
    for (int which = 1; which < MAGNETS; ++which) {
        const fst_params p = magnet(which);
        double sigma;
        fst_field_map *noisy = measure(&p, 0.0025, 11, 0.0, 0.0, &sigma);
        for (int i = 0; i < 3; ++i) {
            fst_field_map *made = smooth(noisy, heights[i], 0);
            compare(&p, made, heights[i], &all[i]);
            fst_field_map_free(made);
        }
        fst_field_map_free(noisy);
    }
    check_coverage(&all[0]);
    check_coverage(&all[1]);
    CHECK_WITHIN(all[2].of_b[1] / (3.0 * all[2].count), 0.95,
                 1.0); /* far errors are those of places beyond the map */
    CHECK_WITHIN(all[2].of_slope[1] / (9.0 * all[2].count), 0.95, 1.0);
    CHECK_WITHIN(all[0].told / all[1].told, 3.0, 30.0);
    CHECK_WITHIN(all[2].told / all[1].told, 0.0, 0.5);
}

/* ------------------------------------------------------------------ the probe */

static void test_probe(void **unused)
{
    (void)unused;
    const fst_params p = magnet(1);
    const double turn = 2.0 / DEGREES, offset = 0.5e-3;
    double sigma;
    fst_field_map *turned = measure(&p, 0.0025, 3, turn, offset, &sigma), *made = smooth(turned, HEIGHT, 0);
    CHECK_WITHIN(fst_field_map_describe(made).fit.chi2, 1.2, 1e3);
    fst_field_map_free(made);
    made = smooth(turned, HEIGHT, 1);
    const fst_map_fit fit = fst_field_map_describe(made).fit;
    const double turns[3] = {0.0, 0.0, turn}, offsets[3] = {offset, 0.0, 0.0};
    CHECK_CLOSE(fit.chi2, 1.0, 0.1);
    for (int i = 0; i < 3; ++i) {
        CHECK_CLOSE(fit.turned[i], turns[i], 3.0 * fit.turned_error[i]);
        CHECK_CLOSE(fit.offset[i], offsets[i], 3.0 * fit.offset_error[i]);
        CHECK_WITHIN(fit.turned_error[i], 1e-5, 0.05 / DEGREES);
        CHECK_WITHIN(fit.offset_error[i], 1e-6, 0.4e-3);
    }
    comparison c = {.count = 0.0};
    compare(&p, made, HEIGHT, &c);
    CHECK_WITHIN(c.of_b[1] / (3.0 * c.count), 0.93, 1.0);
    CHECK_WITHIN(c.of_slope[1] / (9.0 * c.count), 0.93, 1.0);
    CHECK_WITHIN(c.of_slope[0] / (9.0 * c.count), 0.6,
                 1.0); /* of one map alone; test_smoothed_long.c has many */
    fst_field_map_free(made);
    fst_field_map_free(turned);
}

/* ------------------------------------------------------------------ the noise told, and drawn fields */

/* 20 x 20 samples, 3.6 mm apart; test_smoothed_long.c has many of them. */
static fst_field_map *measure_few(double turn, double *sigma)
{
    const fst_params p = magnet(1);
    side = 20;
    step = 3.6e-3;
    fst_field_map *map = measure(&p, 0.0025, 17, turn, 0.0, sigma);
    return map;
}

static void take_all(void)
{
    side = MOST_SIDE;
    step = 1.2e-3;
}

static void test_noise_told(void **unused)
{
    (void)unused;
    static const struct {
        double share, turn;
        fst_noise_verdict verdict;
        const char *sentence;
    } cases[] = {{NAN, 0.0, FST_NOISE_NOT_TOLD, ""},
                 {1.0, 0.0, FST_NOISE_AGREES, "times the noise told, with which"},
                 {0.5, 0.0, FST_NOISE_TOO_SMALL, "times the noise told: it is probably"},
                 {2.0, 0.0, FST_NOISE_TOO_LARGE, "times the noise told: it is probably"},
                 {1.0, 0.05, FST_NOISE_MISFIT, "more is left than noise: a turned probe"},
                 {NAN, 0.05, FST_NOISE_MISFIT, "more is left than noise: a turned probe"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        double sigma;
        char sentence[256];
        fst_field_map *noisy = measure_few(cases[i].turn, &sigma),
                      *made = smooth_told(noisy, HEIGHT, 0, cases[i].share * sigma);
        const fst_map_fit fit = fst_field_map_describe(made).fit;
        fst_map_fit_sentence(&fit, sentence, sizeof sentence);
        assert_string_equal(fst_noise_verdict_name(fit.verdict), fst_noise_verdict_name(cases[i].verdict));
        CHECK_CONTAINS(sentence, cases[i].sentence);
        assert_int_equal(isnan(fit.bound[0]) && isnan(fit.told), isnan(cases[i].share));
        if (cases[i].turn == 0.0)
            CHECK_WITHIN(sigma, fit.seen[1], fit.seen[2]);
        if (cases[i].share == 1.0) /* 1200 numbers, of which about 200 follow the charges */
            CHECK_CLOSE(fit.bound[1] - fit.bound[0], 2.0 * 1.96 * sqrt(2.0 / fit.free), 0.06);
        fst_field_map_free(made);
        fst_field_map_free(noisy);
    }
    take_all();
}

/* The errors of a fit with a free probe are of charges and angles together, and many drawn fields spread by them.  Far
 * above a magnet the angles are a quarter of the error of dBx/dx. */
static void test_draws(void **unused)
{
    (void)unused;
    enum { DRAWS = 100 };
    double sigma, b[2][3], grad[2][3][3], eb[3], eg[3][3], ef[3], of_b = 0.0, of_slope = 0.0;
    const fst_params p = magnet(1);
    above = 90e-3;
    fst_field_map *noisy = measure_few(0.03, &sigma), *made = smooth(noisy, above, 1), *drawn, *none;
    fst_model *model = model_over(&p, made, above);
    fst_error error;
    fst_field(model, 0.4, 0.2, b[0], grad[0]);
    assert_int_equal(fst_field_error(model, 0.4, 0.2, eb, eg, ef), 1);
    fst_model_free(model);
    for (uint64_t seed = 1; seed <= DRAWS; ++seed) {
        assert_int_equal(fst_field_map_draw(made, seed, NULL, &drawn, &error), FST_OK);
        model = model_over(&p, drawn, above);
        fst_field(model, 0.4, 0.2, b[1], grad[1]);
        for (int k = 0; k < 3; ++k)
            of_b += (b[1][k] - b[0][k]) * (b[1][k] - b[0][k]) / (eb[k] * eb[k]);
        of_slope += (grad[1][0][0] - grad[0][0][0]) * (grad[1][0][0] - grad[0][0][0]) / (eg[0][0] * eg[0][0]);
        fst_model_free(model);
        fst_field_map_free(drawn);
    }
    CHECK_CLOSE(sqrt(of_b / (3 * DRAWS)), 1.0, 0.1);
    CHECK_CLOSE(sqrt(of_slope / DRAWS), 1.0, 0.12); /* 1.24 where the errors leave the angles out */
    assert_int_equal(fst_field_map_draw(noisy, 1, NULL, &none, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "smoothed map");
    assert_null(none);
    fst_field_map_free(made);
    fst_field_map_free(noisy);
    above = HEIGHT;
    take_all();
}

/* Two planes, unlike numbers of samples, one odd, and a middle that is not the axis. */
static void test_planes(void **unused)
{
    (void)unused;
    enum { NX = 41, NY = 34, NZ = 2 };
    static double b[3 * NX * NY * NZ];
    const fst_params p = magnet(1);
    const double sigma = 0.1e-3;
    uint64_t seed = 4;
    fst_field_samples s = {{NX, NY, NZ}, {-44e-3, -30e-3, HEIGHT}, {2e-3, 2e-3, 3e-3}, b};
    for (int i = 0; i < NX * NY * NZ; ++i) {
        double grad[3][3];
        fst_model *model = model_at(&p, HEIGHT + i / (NX * NY) * s.spacing[2]);
        fst_field(model, (s.first[0] + i % NX * s.spacing[0]) / L,
                  (s.first[1] + i / NX % NY * s.spacing[1]) / L, &b[3 * i], grad);
        for (int k = 0; k < 3; ++k)
            b[3 * i + k] = fst_model_groups(model).field_unit * b[3 * i + k] + sigma * normal(&seed);
        fst_model_free(model);
    }
    fst_field_map *map = map_of_samples(&s), *made = smooth(map, HEIGHT + 1.5e-3, 0);
    const fst_map_fit fit = fst_field_map_describe(made).fit;
    CHECK_CLOSE(fit.noise, sigma, 0.03 * sigma);
    CHECK_CLOSE(fit.rough, sigma, 0.05 * sigma);
    comparison c = {.count = 0.0};
    fst_model *models[2] = {model_at(&p, HEIGHT + 1.5e-3), model_over(&p, made, HEIGHT + 1.5e-3)};
    for (int i = 0; i < 60; ++i) {
        const double x = uniform(&seed, -40e-3, 32e-3) / L, y = uniform(&seed, -26e-3, 32e-3) / L;
        compare_at((const fst_model *[]){models[0], models[1]}, x, y, &c);
    }
    check_coverage(&c);
    for (int m = 0; m < 2; ++m)
        fst_model_free(models[m]);
    fst_field_map_free(made);
    fst_field_map_free(map);
}

/* ------------------------------------------------------------------ fields without noise, and none */

/* An exact map keeps its splines; its charges know other heights nearly as well. */
static void test_exact(void **unused)
{
    (void)unused;
    const fst_params p = magnet(1);
    double sigma, before[3], after[3], grad[3][3];
    fst_field_map *exact = measure(&p, 0.0, 1, 0.0, 0.0, &sigma);
    fst_model *model = model_over(&p, exact, HEIGHT);
    fst_field(model, 0.3, -0.4, before, grad);
    fst_field_map *made = smooth(exact, HEIGHT + 5e-3, 0);
    fst_field(model, 0.3, -0.4, after, grad);
    for (int i = 0; i < 3; ++i)
        CHECK_SAME_BITS(after[i], before[i]);
    assert_int_equal(fst_field_error(model, 0.3, -0.4, after, grad, before), 0);
    comparison c = {.count = 0.0};
    compare(&p, made, HEIGHT + 5e-3, &c);
    CHECK_WITHIN(c.force, 0.0, 1e-4 * c.greatest_force);
    CHECK_WITHIN(c.of_slope[1] / (9.0 * c.count), 0.95, 1.0);
    fst_model_free(model);
    fst_field_map_free(made);
    fst_field_map_free(exact);
}

static void test_refusals(void **unused)
{
    (void)unused;
    static double b[8 * 8 * 3];
    const fst_field_samples samples = {{8, 8, 1}, {-4e-3, -4e-3, NAN}, {1e-3, 1e-3, 0.0}, b};
    const struct {
        double value;
        fst_smoothing how;
        const char *sentence;
    } cases[] = {{0.0, {NAN, 0, 0.02, 0.02}, "zero everywhere"},
                 {1e-3, {NAN, 0, 0.02, NAN}, "height of the map"},
                 {1e-3, {NAN, 0, NAN, 0.02}, "height of the map"},
                 {1e-3, {-1.0, 0, 0.02, 0.02}, "a positive field"},
                 {1e-3, {1.0, 0, 0.02, 0.02}, "a positive field"},
                 {1e-3, {NAN, 0, 0.0, 0.02}, "too near to the charges"},
                 {1e-3, {NAN, 1, 0.02, 0.02}, "does not tell how the probe"}};
    fst_field_map *map, *made;
    fst_error error;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i) {
        for (int k = 0; k < 8 * 8; ++k)
            b[3 * k + 2] = cases[i].value;
        map = map_of_samples(&samples);
        assert_int_equal(fst_field_map_smooth(map, &cases[i].how, NULL, &made, &error), FST_BAD_INPUT);
        CHECK_CONTAINS(error.sentence, cases[i].sentence);
        assert_null(made);
        fst_field_map_free(map);
    }
    static double narrow[300 * 8 * 3];
    for (int k = 0; k < 300 * 8; ++k)
        narrow[3 * k + 2] = 1e-3;
    map = map_of_samples(&(fst_field_samples){{300, 8, 1}, {-0.15, -4e-3, NAN}, {1e-3, 1e-3, 0.0}, narrow});
    const fst_smoothing usual = {NAN, 0, 0.02, 0.02};
    assert_int_equal(fst_field_map_smooth(map, &usual, NULL, &made, &error), FST_BAD_INPUT);
    CHECK_CONTAINS(error.sentence, "long and narrow");
    fst_field_map_free(map);
    map = map_of_samples(&samples); /* an even field is one, in the smallest map */
    assert_int_equal(fst_field_map_smooth(map, &(fst_smoothing){NAN, 0, 0.02, 0.02}, NULL, &made, &error),
                     FST_OK);
    CHECK_WITHIN(fst_field_map_describe(made).greatest, 0.99e-3, 1.01e-3);
    fst_field_map_free(made);
    fst_field_map_free(map);
}

static fst_status stop(void *user, double fraction, const char *what, fst_error *error)
{
    (void)what;
    (void)error;
    return ++*(int *)user > 3 && fraction < 1.0 ? FST_INTERRUPTED : FST_OK;
}

static void test_stop(void **unused)
{
    (void)unused;
    const fst_params p = magnet(1);
    double sigma;
    int asked = 0;
    const fst_progress progress = {&asked, stop};
    fst_field_map *noisy = measure(&p, 0.0025, 1, 0.0, 0.0, &sigma), *made;
    fst_error error;
    assert_int_equal(
        fst_field_map_smooth(noisy, &(fst_smoothing){NAN, 0, HEIGHT, NAN}, &progress, &made, &error),
        FST_INTERRUPTED);
    assert_null(made);
    assert_int_equal(asked, 4);
    fst_field_map_free(noisy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_noise),      cmocka_unit_test(test_curl_and_divergence),
        cmocka_unit_test(test_heights),    cmocka_unit_test(test_probe),
        cmocka_unit_test(test_planes),     cmocka_unit_test(test_exact),
        cmocka_unit_test(test_refusals),   cmocka_unit_test(test_stop),
        cmocka_unit_test(test_noise_told), cmocka_unit_test(test_draws),
    };
    return cmocka_run_group_tests_name("smoothed", tests, NULL, NULL);
}
