/* Charges below a noisy map: their field has neither curl nor divergence, pulls a bead as the magnet does, at other
 * heights too, and what is told of its errors covers the truth; a turned probe is found; fields that are none are
 * refused.
 * tests: model/charges.c model/charge_sums.c model/smooth_map.c
 * labels: numbers */
#include "measured_field.h"

#include <math.h>

/* 60 x 60 samples, 1.2 mm apart, 18.7 mm over the middle of the magnets. */
enum { SIDE = 60, MAGNETS = 3, SEEDS = 2 };
static const double STEP = 1.2e-3, L = 0.023;
#define HEIGHT 18.7e-3

/* The five lines, a bar, and two discs of opposite polarity. */
static fst_params magnet(int which)
{
    static const char *const keys[MAGNETS][9][2] = {{{"magnet.b0", "0.01"}},
                                                    {{"magnet.shape", "parts"},
                                                     {"magnet.parts[0].kind", "cuboid"},
                                                     {"magnet.parts[0].size[0]", "56mm"},
                                                     {"magnet.parts[0].size[1]", "40mm"},
                                                     {"magnet.parts[0].size[2]", "9mm"},
                                                     {"magnet.parts[0].remanence[0]", "0.567"}},
                                                    {{"magnet.shape", "parts"},
                                                     {"magnet.parts[0].kind", "cylinder"},
                                                     {"magnet.parts[0].centre[0]", "15mm"},
                                                     {"magnet.parts[0].size[0]", "20mm"},
                                                     {"magnet.parts[0].size[1]", "5mm"},
                                                     {"magnet.parts[0].remanence[2]", "1.2"},
                                                     {"magnet.parts[1].kind", "sphere"},
                                                     {"magnet.parts[1].centre[0]", "-15mm"},
                                                     {"magnet.parts[1].size[0]", "14mm"}}};
    fst_params p = bead_at(0.3, FST_DYNAMICS_RIGID);
    for (int i = 0; i < 9 && keys[which][i][0]; ++i)
        assert_int_equal(fst_params_set(&p, keys[which][i][0], keys[which][i][1], NULL), FST_OK);
    if (which == 2)
        assert_int_equal(fst_params_set(&p, "magnet.parts[1].remanence[2]", "-1.2", NULL), FST_OK);
    return p;
}

static fst_model *model_at(const fst_params *p, double height)
{
    fst_model *model;
    fst_error error = {FST_OK, "", ""};
    if (fst_field_model_new(p, height / L, &model, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return model;
}

/* Gauss's distribution by the sum of twelve even ones. */
static double normal(uint64_t *seed)
{
    double sum = 0.0;
    for (int i = 0; i < 12; ++i)
        sum += uniform(seed, -0.5, 0.5);
    return sum;
}

/* What a probe shows over a magnet: noise is a share of the greatest field, whose size comes back in *sigma; its axes
 * are turned about z by `turn`, and show `offset` along x in no field. */
static fst_field_map *measure(const fst_params *p, double noise, uint64_t seed, double turn, double offset,
                              double *sigma)
{
    static double b[SIDE * SIDE * 3];
    fst_model *model = model_at(p, HEIGHT);
    const double unit = fst_model_groups(model).field_unit, first = -0.5 * (SIDE - 1) * STEP;
    double greatest = 0.0, grad[3][3];
    for (int i = 0; i < SIDE * SIDE; ++i) {
        double *at = &b[3 * i], in[3];
        fst_field(model, (first + i % SIDE * STEP) / L, (first + i / SIDE * STEP) / L, in, grad);
        greatest = fmax(greatest, unit * sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2]));
        at[0] = unit * (cos(turn) * in[0] + sin(turn) * in[1]) + offset;
        at[1] = unit * (cos(turn) * in[1] - sin(turn) * in[0]);
        at[2] = unit * in[2];
    }
    *sigma = noise * greatest;
    for (int i = 0; i < 3 * SIDE * SIDE; ++i)
        b[i] += noise > 0 ? *sigma * normal(&seed) : 0.0;
    fst_model_free(model);
    const fst_field_samples samples = {{SIDE, SIDE, 1}, {first, first, HEIGHT}, {STEP, STEP, 0.0}, b};
    return map_of_samples(&samples);
}

static fst_field_map *smooth(const fst_field_map *map, double height, int probe)
{
    const fst_smoothing how = {.noise = NAN, .probe = probe, .height = height, .lies = NAN};
    fst_field_map *made;
    fst_error error = {FST_OK, "", ""};
    if (fst_field_map_smooth(map, &how, NULL, &made, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return made;
}

static fst_model *model_over(const fst_params *p, const fst_field_map *map, double height)
{
    fst_params measured = *p;
    measured.magnet_shape = FST_MAGNET_GRID;
    measured.magnet_b0 = MAP_B0;
    measured.magnet_map = map;
    measured.bead_material = FST_MATERIAL_MIXED;
    measured.bead_a = 0.02; /* a bead soft and hard, whose force is of both degrees in the field */
    return model_at(&measured, height);
}

/* How a smoothed map differs from the truth, up to a share of its half width; its last four samples are its rim. */
static const double WITHIN = 0.87;
typedef struct comparison {
    double of_b[2], of_slope[2], of_each[9][2], of_force[3][2],
        count; /* shares within 1 and 2 standard errors, and places */
    double force, greatest_force,
        told; /* greatest error, greatest force; mean error told of a slope, in B0/l */
} comparison;

static void count_in(double off, double error, double shares[2])
{
    shares[0] += fabs(off) < error;
    shares[1] += fabs(off) < 2.0 * error;
}

static void compare_at(const fst_model *models[2], double x, double y, comparison *c)
{
    double b[2][3], g[2][3][3], eb[3], eg[3][3], ef[3], force[2][3] = {{0}};
    const fst_groups groups = fst_model_groups(models[1]);
    const double hard = groups.kappa * groups.eps * groups.eps, soft = 2.0 * (groups.a + groups.b);
    for (int m = 0; m < 2; ++m) {
        const double unit = fst_model_groups(models[m]).field_unit / MAP_B0;
        fst_field(models[m], x, y, b[m], g[m]);
        const double strength = sqrt(b[m][0] * b[m][0] + b[m][1] * b[m][1] + b[m][2] * b[m][2]);
        for (int i = 0; i < 3; ++i)
            for (int k = 0; k < 3; ++k)
                force[m][k] += unit * g[m][i][k] * b[m][i] * (hard / strength + soft * unit);
        for (int i = 0; i < 3; ++i) {
            b[m][i] *= unit;
            for (int k = 0; k < 3; ++k)
                g[m][i][k] *= unit;
        }
    }
    assert_int_equal(fst_field_error(models[1], x, y, eb, eg, ef), 1);
    double off = 0.0, size = 0.0;
    for (int i = 0; i < 3; ++i) {
        count_in(b[1][i] - b[0][i], eb[i], c->of_b);
        count_in(force[1][i] - force[0][i], ef[i], c->of_force[i]);
        off += (force[1][i] - force[0][i]) * (force[1][i] - force[0][i]);
        size += force[0][i] * force[0][i];
        for (int k = 0; k < 3; ++k) {
            count_in(g[1][i][k] - g[0][i][k], eg[i][k], c->of_slope);
            count_in(g[1][i][k] - g[0][i][k], eg[i][k], c->of_each[3 * i + k]);
            c->told += eg[i][k] / 9.0;
        }
    }
    c->force = fmax(c->force, sqrt(off));
    c->greatest_force = fmax(c->greatest_force, sqrt(size));
    c->count += 1.0;
}

static void compare(const fst_params *p, const fst_field_map *smoothed, double height, comparison *c)
{
    enum { PLACES = 60 };
    fst_model *models[2] = {model_at(p, height), model_over(p, smoothed, height)};
    const double reach = WITHIN * 0.5 * (SIDE - 1) * STEP / L;
    uint64_t seed = 7;
    for (int i = 0; i < PLACES; ++i) {
        const double x = uniform(&seed, -reach, reach), y = uniform(&seed, -reach, reach);
        compare_at((const fst_model *[]){models[0], models[1]}, x, y, c);
    }
    for (int m = 0; m < 2; ++m)
        fst_model_free(models[m]);
}

/* 68 and 95 % of the truth are within 1 and 2 errors; errors that are told too large are no help either. */
static void check_coverage(const comparison *c)
{
    CHECK_WITHIN(c->of_b[0] / (3.0 * c->count), 0.63, 0.9);
    CHECK_WITHIN(c->of_b[1] / (3.0 * c->count), 0.93, 1.0);
    CHECK_WITHIN(c->of_slope[0] / (9.0 * c->count), 0.63, 0.9);
    CHECK_WITHIN(c->of_slope[1] / (9.0 * c->count), 0.93, 1.0);
    for (int within = 0; within < 2;
         ++within) { /* one component alone less surely: neighbouring errors are alike */
        const double lowest[2] = {0.63, 0.93}, alone[2] = {0.5, 0.88}, highest[2] = {0.9, 1.0};
        double all = 0.0;
        for (int i = 0; i < 3; ++i) {
            CHECK_WITHIN(c->of_force[i][within] / c->count, alone[within], 1.0);
            all += c->of_force[i][within] / (3.0 * c->count);
        }
        CHECK_WITHIN(all, lowest[within], highest[within]);
    }
    for (int i = 0; i < 9; ++i) {
        CHECK_WITHIN(c->of_each[i][0] / c->count, 0.5, 0.93);
        CHECK_WITHIN(c->of_each[i][1] / c->count, 0.88, 1.0);
    }
}

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
    for (int which = 1; which < MAGNETS; ++which)
        for (int i = 0; i < 3; ++i) {
            const fst_params p = magnet(which);
            double sigma;
            fst_field_map *noisy = measure(&p, 0.0025, 11, 0.0, 0.0, &sigma),
                          *made = smooth(noisy, heights[i], 0);
            compare(&p, made, heights[i], &all[i]);
            fst_field_map_free(made);
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
    fst_field_map_free(made);
    fst_field_map_free(turned);
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
        cmocka_unit_test(test_noise),    cmocka_unit_test(test_curl_and_divergence),
        cmocka_unit_test(test_heights),  cmocka_unit_test(test_probe),
        cmocka_unit_test(test_planes),   cmocka_unit_test(test_exact),
        cmocka_unit_test(test_refusals), cmocka_unit_test(test_stop),
    };
    return cmocka_run_group_tests_name("smoothed", tests, NULL, NULL);
}
