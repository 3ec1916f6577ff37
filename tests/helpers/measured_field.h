/* measured_field.h - maps of fields for tests: a model's field as samples, with noise where it is wanted. */
#ifndef FST_TESTS_MEASURED_FIELD_H
#define FST_TESTS_MEASURED_FIELD_H

#include <stdio.h>
#include <stdlib.h>

#include "physics.h"

/* The unit of field of all these maps and their scenes. */
#define MAP_B0 0.01

/* A map of the samples. */
static inline fst_field_map *map_of_samples(const fst_field_samples *samples)
{
    fst_field_map *map;
    fst_error error = {FST_OK, "", ""};
    if (fst_field_map_new(samples, NULL, &map, &error) != FST_OK)
        fail_msg("fst_field_map_new: %s", error.sentence);
    return map;
}

/* The field of a setup on a square about the axis, `steps` of `spacing` (in l) each way; every component of
 * every sample is off by at most `noise` (in B0). */
static inline fst_field_map *map_of_model(const fst_params *p, double spacing, int steps, double noise)
{
    const int side = 2 * steps + 1;
    fst_model *model = model_of(p);
    const fst_groups g = fst_model_groups(model);
    double *b = malloc(3 * (size_t)side * (size_t)side * sizeof *b), grad[3][3];
    uint64_t seed = 17;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            double *at = &b[3 * (j * side + i)];
            fst_field(model, (i - steps) * spacing, (j - steps) * spacing, at, grad);
            for (int k = 0; k < 3; ++k)
                at[k] = MAP_B0 * (at[k] + (noise > 0 ? uniform(&seed, -noise, noise) : 0.0));
        }
    const double first = -steps * spacing * g.length_unit, step = spacing * g.length_unit;
    const fst_field_samples samples = {
        {side, side, 1}, {first, first, g.h * g.length_unit}, {step, step, 0.0}, b};
    fst_field_map *map = map_of_samples(&samples);
    fst_model_free(model);
    free(b);
    return map;
}

/* The setup over that map instead of its magnet. */
static inline fst_params over_map(const fst_params *p, const fst_field_map *map)
{
    fst_params measured = *p;
    char kappa[32];
    measured.magnet_shape = FST_MAGNET_GRID;
    measured.magnet_b0 = MAP_B0;
    measured.magnet_map = map;
    (void)snprintf(kappa, sizeof kappa, "%.17g", p->model_kappa); /* else the bead would be of neodymium */
    assert_int_equal(fst_params_set(&measured, "model.kappa", kappa, NULL), FST_OK);
    return measured;
}

#endif
