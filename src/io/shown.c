/* shown.c - the units in which numbers leave: scaled ones, those of a laboratory, or SI. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <string.h>

/* A scaled unit is kg^mass l^length (1/gamma)^time B0^field; `lab` and `si` name its counterparts, and
 * `lab_factor` is how many of the laboratory's unit make one of SI. */
static const struct {
    const char *scaled, *lab, *si;
    int mass, length, time, field;
    double lab_factor;
} units_known[] = {
    {"l", "mm", "m", 0, 1, 0, 0, 1e3},
    {"gamma", "1/s", "1/s", 0, 0, -1, 0, 1.0},
    {"1/gamma", "s", "s", 0, 0, 1, 0, 1.0},
    {"l gamma", "mm/s", "m/s", 0, 1, -1, 0, 1e3},
    {"l gamma^2", "mN", "N", 1, 1, -2, 0, 1e3},
    {"l^2 gamma^2", "uJ", "J", 1, 2, -2, 0, 1e6},
    {"l^2 gamma^3", "mW", "W", 1, 2, -3, 0, 1e3},
    {"B0", "mT", "T", 0, 0, 0, 1, 1e3},
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
        .field = NAN,
    };
    fst_model *model = NULL;
    if (fst_model_new(params, &model, NULL) == FST_OK)
        scales.field = fst_model_groups(model).field_unit;
    fst_model_free(model);
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
        *name = units == FST_SHOWN_LAB ? units_known[i].lab : units_known[i].si;
        return units == FST_SHOWN_LAB ? factor * units_known[i].lab_factor : factor;
    }
    return 1.0;
}

double fst_column_shown(const fst_column_info *column, fst_shown_units units, const fst_scales *scales,
                        const char **name)
{
    const double factor = fst_unit_shown(column->unit, units, scales, name);
    if (*name != column->unit && strcmp(column->unit, "gamma") == 0)
        *name = "rad/s";
    return factor;
}
