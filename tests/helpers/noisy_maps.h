/* noisy_maps.h - maps as a probe over known magnets shows them, with noise, and how far smoothed ones are from the truth.
 */
#ifndef FST_TESTS_NOISY_MAPS_H
#define FST_TESTS_NOISY_MAPS_H

#include "measured_field.h"

#include <math.h>

enum { MOST_SIDE = 60, MAGNETS = 3 };
static const double L = 0.023;
#define HEIGHT 18.7e-3

/* 60 x 60 samples, 1.2 mm apart, 18.7 mm over the middle of the magnets, unless a test takes fewer of them. */
static int side = MOST_SIDE;
static double step = 1.2e-3, above = HEIGHT;

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
    static double b[MOST_SIDE * MOST_SIDE * 3];
    fst_model *model = model_at(p, above);
    const double unit = fst_model_groups(model).field_unit, first = -0.5 * (side - 1) * step;
    double greatest = 0.0, grad[3][3];
    for (int i = 0; i < side * side; ++i) {
        double *at = &b[3 * i], in[3];
        fst_field(model, (first + i % side * step) / L, (first + i / side * step) / L, in, grad);
        greatest = fmax(greatest, unit * sqrt(in[0] * in[0] + in[1] * in[1] + in[2] * in[2]));
        at[0] = unit * (cos(turn) * in[0] + sin(turn) * in[1]) + offset;
        at[1] = unit * (cos(turn) * in[1] - sin(turn) * in[0]);
        at[2] = unit * in[2];
    }
    *sigma = noise * greatest;
    for (int i = 0; i < 3 * side * side; ++i)
        b[i] += noise > 0 ? *sigma * normal(&seed) : 0.0;
    fst_model_free(model);
    const fst_field_samples samples = {{side, side, 1}, {first, first, above}, {step, step, 0.0}, b};
    return map_of_samples(&samples);
}

static fst_field_map *smooth_told(const fst_field_map *map, double height, int probe, double noise)
{
    const fst_smoothing how = {.noise = noise, .probe = probe, .height = height, .lies = NAN};
    fst_field_map *made;
    fst_error error = {FST_OK, "", ""};
    if (fst_field_map_smooth(map, &how, NULL, &made, &error) != FST_OK)
        fail_msg("%s", error.sentence);
    return made;
}

static fst_field_map *smooth(const fst_field_map *map, double height, int probe)
{
    return smooth_told(map, height, probe, NAN);
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
    const double reach = WITHIN * 0.5 * (side - 1) * step / L;
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

#endif
