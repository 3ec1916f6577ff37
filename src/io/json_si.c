/* json_si.c - numbers of a JSON document in SI, beside the scaled ones. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/number.h"
#include "io/json.h"

/* How the key of a number in SI ends, by the number's scaled unit. */
static const struct {
    const char *unit, *ending;
} si_endings[] = {
    {"l", "_m"},       {"B0", "_tesla"},          {"l gamma", "_m_per_s"},    {"gamma", "_per_s"},
    {"1/gamma", "_s"}, {"l gamma^2", "_newtons"}, {"l^2 gamma^2", "_joules"}, {"l^2 gamma^3", "_watts"},
};

void fst_json_in_si(fst_json *json, const char *name, double value, const char *unit, const fst_scales *scales)
{
    char key[64];
    const char *unused;
    for (size_t k = 0; k < sizeof si_endings / sizeof *si_endings; ++k) {
        if (strcmp(unit, si_endings[k].unit) != 0)
            continue;
        const int unknown = strcmp(unit, "B0") == 0 && isnan(scales->field);
        const double factor = fst_unit_shown(unit, FST_SHOWN_SI, scales, &unused);
        (void)snprintf(key, sizeof key, "%s%s", name, si_endings[k].ending);
        fst_json_real(json, key, unknown ? NAN : value * factor);
    }
}

void fst_json_scaled(fst_json *json, const char *key, double value, const char *unit, const fst_scales *si)
{
    fst_json_real(json, key, value);
    if (si)
        fst_json_in_si(json, key, value, unit, si);
}

void fst_json_rates(fst_json *json, const double *re, const double *im, int count, const fst_scales *si)
{
    fst_json_pairs(json, "eigenvalues", re, im, count);
    if (!si)
        return;
    fst_json_open(json, "eigenvalues_per_s", '[');
    for (int i = 0; i < count; ++i)
        fst_json_reals(json, NULL, (const double[]){re[i] / si->time, im[i] / si->time}, 2);
    fst_json_close(json);
}

fst_scales fst_json_scales_at(const fst_params *params, const char *const keys[2], const double values[2])
{
    fst_params there = *params;
    for (int i = 0; i < 2; ++i) {
        char text[40];
        (void)fst_number_write(text, sizeof text, values[i]);
        if (keys[i] && *keys[i])
            (void)fst_params_set(&there, keys[i], text, NULL);
    }
    return fst_scales_of(&there);
}

int fst_json_with_si(fst_shown_units units)
{
    return units == FST_SHOWN_LAB || units == FST_SHOWN_SI;
}

void fst_json_state_si(fst_json *json, const char *key, const double *state, int axes, const fst_scales *scales)
{
    double si[FST_BEAD_NUMBERS];
    const int count = 2 * axes + 6;
    for (int i = 0; i < count; ++i)
        si[i] = state[i] * (i < 2 * axes ? scales->length : 1.0) /
                (i < axes || (i >= 2 * axes && i < count - 3) ? 1.0 : scales->time);
    fst_json_reals(json, key, si, count);
}
