/* fit_tables.h - synthetic tables of measured points, made by the library's own orbits, with noise of a known
 * size. */
#ifndef FESTOON_TESTS_FIT_TABLES_H
#define FESTOON_TESTS_FIT_TABLES_H

#include <festoon/festoon_tools.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Numbers that are evenly distributed from 0 to 1, and normally distributed ones (Box and Muller). */
static inline double fit_even(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*seed >> 11) + 0.5) / 9007199254740992.0;
}

static inline double fit_normal(uint64_t *seed)
{
    const double size = sqrt(-2.0 * log(fit_even(seed)));
    return size * cos(6.283185307179586 * fit_even(seed));
}

/* The errors of <r>, delta r, and the bead's frequency that a good film gives. */
static const double fit_errors[FST_MEASURED_COUNT] = {5e-5, 3e-5, 5e-3};

/* The exact numbers of a setup at a frequency; 0 where it has no orbit there. */
static inline int fit_exact(const fst_params *params, double frequency, double value[FST_MEASURED_COUNT])
{
    fst_params there = *params;
    fst_orbit orbit;
    there.drive_frequency = frequency;
    there.drive_omega = NAN;
    if (fst_orbit_find(&there, NULL, &orbit, NULL) != FST_OK)
        return 0;
    value[FST_MEASURED_MEAN_R] = orbit.means.mean_r * params->magnet_half_length;
    value[FST_MEASURED_STD_R] = orbit.means.std_r * params->magnet_half_length;
    value[FST_MEASURED_BEAD_FREQUENCY] =
        orbit.means.mean_alpha_dot * params->friction_gamma / 6.283185307179586;
    return 1;
}

/* A table of `count` exact rows from one frequency to another, with the errors above. free(points->rows). */
static inline int fit_table(const fst_params *params, double from, double to, int count, fst_points *points)
{
    *points = (fst_points){.rows = calloc((size_t)count, sizeof *points->rows), .column = {2, 4, 6}};
    for (int i = 0; points->rows && i < count; ++i) {
        fst_point *row = &points->rows[points->count++];
        row->frequency = from + (to - from) * i / (count - 1);
        row->frequency_error = NAN;
        row->line = i + 2;
        memcpy(row->error, fit_errors, sizeof row->error);
        if (!fit_exact(params, row->frequency, row->value))
            return 0;
    }
    return points->rows != NULL;
}

/* Add noise of the errors' size. */
static inline void fit_add_noise(fst_points *points, uint64_t *seed)
{
    for (size_t i = 0; i < points->count; ++i)
        for (int q = 0; q < FST_MEASURED_COUNT; ++q)
            points->rows[i].value[q] += points->rows[i].error[q] * fit_normal(seed);
}

#endif
