/* shown.c - the units in which numbers leave: scaled ones, those of a laboratory, or SI. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"

/* A scaled unit is kg^mass l^length (1/gamma)^time B0^field; its counterparts are the units of `kind`. */
static const struct {
    const char *scaled;
    fst_unit kind;
    int mass, length, time, field;
} units_known[] = {
    {"l", FST_UNIT_LENGTH, 0, 1, 0, 0},           {"gamma", FST_UNIT_RATE, 0, 0, -1, 0},
    {"1/gamma", FST_UNIT_TIME, 0, 0, 1, 0},       {"l gamma", FST_UNIT_SPEED, 0, 1, -1, 0},
    {"l gamma^2", FST_UNIT_FORCE, 1, 1, -2, 0},   {"l^2 gamma^2", FST_UNIT_ENERGY, 1, 2, -2, 0},
    {"l^2 gamma^3", FST_UNIT_POWER, 1, 2, -3, 0}, {"B0", FST_UNIT_FIELD, 0, 0, 0, 1},
};

static double power(double base, int exponent)
{
    double product = 1.0;
    for (int i = 0; i < exponent; ++i)
        product *= base;
    for (int i = 0; i > exponent; --i)
        product /= base;
    return product;
}

fst_scales fst_scales_of(const fst_params *params)
{
    fst_scales scales = {
        .length = params->magnet_half_length,
        .time = 1.0 / params->friction_gamma,
        .mass = fst_bead_mass(params),
        .field = fst_field_scale(params),
    };
    return scales;
}

double fst_unit_shown(const char *unit, fst_shown_units units, const fst_scales *scales, const char **name)
{
    *name = unit;
    if (units != FST_SHOWN_LAB && units != FST_SHOWN_SI)
        return 1.0;
    for (size_t i = 0; i < sizeof units_known / sizeof units_known[0]; ++i) {
        if (strcmp(unit, units_known[i].scaled) != 0)
            continue;
        const double factor =
            power(scales->mass, units_known[i].mass) * power(scales->length, units_known[i].length) *
            power(scales->time, units_known[i].time) * (units_known[i].field ? scales->field : 1.0);
        if (!isfinite(factor))
            return 1.0;
        int times = 0;
        *name = units == FST_SHOWN_LAB ? fst_unit_customary(units_known[i].kind, &times)
                                       : fst_unit_name(units_known[i].kind);
        return factor * power(10.0, times);
    }
    return 1.0;
}

/* Numbers in gamma that say how fast something turns; the others are rates at which something grows or dies out. */
static int is_rotation(const char *name)
{
    static const char *const rotations[] = {"mean_alpha_dot",
                                            "mean_alpha_dot_error",
                                            "centre_rate",
                                            "axis_rate",
                                            "mean_phi_dot",
                                            "omega",
                                            "WX",
                                            "WY",
                                            "WZ",
                                            "w_x",
                                            "w_y",
                                            "w_z",
                                            "spin"};
    char plain[64]; /* of a column of one bead of several, WX_0, or of a sweep's last state, final_WX */
    (void)snprintf(plain, sizeof plain, "%s", strncmp(name, "final_", 6) == 0 ? name + 6 : name);
    size_t end = strlen(plain);
    while (end > 0 && plain[end - 1] >= '0' && plain[end - 1] <= '9')
        --end;
    if (end > 0 && plain[end] && plain[end - 1] == '_')
        plain[end - 1] = '\0';
    for (size_t i = 0; i < sizeof rotations / sizeof rotations[0]; ++i)
        if (strcmp(plain, rotations[i]) == 0)
            return 1;
    return 0;
}

double fst_number_shown(const char *number, const char *unit, fst_shown_units units, const fst_scales *scales,
                        const char **name)
{
    const double factor = fst_unit_shown(unit, units, scales, name);
    int power;
    if (*name == unit || strcmp(unit, "gamma") != 0 || !is_rotation(number))
        return factor;
    *name = units == FST_SHOWN_LAB ? fst_unit_customary(FST_UNIT_FREQUENCY, &power) : "rad/s";
    return units == FST_SHOWN_LAB ? factor / FST_TWO_PI : factor;
}

double fst_column_shown(const fst_column_info *column, fst_shown_units units, const fst_scales *scales,
                        const char **name)
{
    return fst_number_shown(column->name, column->unit, units, scales, name);
}
