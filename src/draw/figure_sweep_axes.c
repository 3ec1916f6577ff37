/* figure_sweep_axes.c - axes and keys of a sweep, converted into the units that the figure shows. */
#include "draw/figure_sweep_axes.h"

#include "base/constants.h"
#include "base/error.h"

#include <stdio.h>
#include <string.h>

/* ------------------------------------------------------------------ units */

/* "drive.frequency" -> "drive frequency" */
static void words_of(const char *key, char *words, size_t size)
{
    (void)snprintf(words, size, "%s", key);
    for (char *c = words; *c; ++c)
        if (*c == '.' || *c == '_')
            *c = ' ';
}

/* The scaled units' length in metres and time in seconds, which must be the same at all points. */
static fst_status units_of(const fst_grid *grid, const char *what, double *length, double *time,
                           fst_error *error)
{
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        const char *key = fst_grid_key(grid, i);
        if (fst_grid_axis_points(grid, i) > 1 && ((length && strcmp(key, "magnet.half_length") == 0) ||
                                                  (time && strcmp(key, "friction.gamma") == 0)))
            return fst_fail(error, FST_BAD_INPUT, "--units",
                            "the sweep varies %s, a unit itself, so %s is shown in the units it was made with",
                            key, what);
    }
    const fst_params *base = fst_grid_base(grid);
    if (length)
        *length = base->magnet_half_length;
    if (time)
        *time = 1.0 / base->friction_gamma;
    return FST_OK;
}

/* The drive, by its frequency in Hz or by its scaled angular velocity. */
static fst_status drive_axis(const fst_grid *grid, fst_shown_units units, fst_sweep_axis *axis,
                             fst_error *error)
{
    const char *key = fst_grid_key(grid, axis->index);
    const int in_hertz = strcmp(key, "drive.frequency") == 0;
    const int to_hertz = units == FST_SHOWN_LAB || (units == FST_SHOWN_AS_GIVEN && in_hertz);
    double time = 1.0;
    const fst_status status = in_hertz == to_hertz ? FST_OK : units_of(grid, key, NULL, &time, error);
    axis->factor = in_hertz == to_hertz ? 1.0 : in_hertz ? FST_TWO_PI * time : 1.0 / (FST_TWO_PI * time);
    (void)snprintf(axis->label, sizeof axis->label, "%s",
                   to_hertz ? "drive frequency (Hz)" : "drive ω (scaled)");
    return status;
}

/* A length, given in metres or (start.r) in l. */
static fst_status length_axis(const fst_grid *grid, fst_shown_units units, int in_metres, fst_sweep_axis *axis,
                              fst_error *error)
{
    const char *key = fst_grid_key(grid, axis->index);
    const int to_mm = units == FST_SHOWN_LAB || (units == FST_SHOWN_AS_GIVEN && in_metres);
    double length = 1.0;
    char words[64];
    const fst_status status = in_metres == to_mm ? FST_OK : units_of(grid, key, &length, NULL, error);
    axis->factor = (in_metres ? 1.0 : length) * (to_mm ? 1e3 : 1.0 / length);
    words_of(key, words, sizeof words);
    (void)snprintf(axis->label, sizeof axis->label, "%s (%s)", words, to_mm ? "mm" : "l");
    return status;
}

fst_status fst_sweep_axis_of(const fst_grid *grid, int index, fst_shown_units units, fst_sweep_axis *axis,
                             fst_error *error)
{
    const char *key = fst_grid_key(grid, index);
    const fst_param_info *info = fst_param_at(fst_param_find(key));
    *axis = (fst_sweep_axis){.index = index,
                             .count = fst_grid_axis_points(grid, index),
                             .factor = 1.0,
                             .logarithmic = fst_grid_axis_spacing(grid, index) == FST_SPACING_LOG,
                             .choice = info->kind == FST_KIND_CHOICE ? info : NULL};
    if (strncmp(key, "drive.", 6) == 0)
        return drive_axis(grid, units, axis, error);
    if (info->unit == FST_UNIT_LENGTH || strcmp(key, "start.r") == 0)
        return length_axis(grid, units, info->unit == FST_UNIT_LENGTH, axis, error);
    char words[64];
    words_of(key, words, sizeof words);
    if (info->kind != FST_KIND_REAL || info->unit == FST_UNIT_NUMBER)
        (void)snprintf(axis->label, sizeof axis->label, "%s", words);
    else
        (void)snprintf(axis->label, sizeof axis->label, "%s (%s)", words, fst_unit_name(info->unit));
    return FST_OK;
}

double fst_sweep_axis_value(const fst_grid *grid, const fst_sweep_axis *axis, int64_t point)
{
    return axis->factor * fst_grid_value(grid, axis->index, point);
}

void fst_sweep_choice_tics(const fst_param_info *choice, char *tics, size_t size)
{
    (void)snprintf(tics, size, "(");
    const char *name = choice->names;
    for (int i = 0; *name; ++i) {
        const size_t used = strlen(tics), length = strcspn(name, "|");
        (void)snprintf(tics + used, size - used, "%s'%.*s' %d", i ? ", " : "", (int)length, name, i);
        name += length + (name[length] == '|');
    }
    const size_t used = strlen(tics);
    (void)snprintf(tics + used, size - used, ")");
}

fst_status fst_sweep_quantity_of(const fst_grid *grid, const char *key, fst_shown_units units,
                                 fst_sweep_quantity *quantity, fst_error *error)
{
    /* Units of results that have a counterpart in the laboratory, as powers of l and of gamma. */
    static const struct {
        const char *scaled, *lab;
        int length, time;
    } table[] = {
        {"l", "mm", 1, 0}, {"gamma", "1/s", 0, -1}, {"1/gamma", "s", 0, 1}, {"l gamma", "mm/s", 1, -1}};
    const char *unit = "";
    fst_status status = FST_OK;
    *quantity = (fst_sweep_quantity){.key = key, .factor = 1.0};
    for (int i = 0; i < fst_result_count(); ++i)
        if (strcmp(fst_result_at(i)->name, key) == 0)
            unit = fst_result_at(i)->unit;
    for (size_t i = 0; units == FST_SHOWN_LAB && i < sizeof table / sizeof *table; ++i)
        if (strcmp(unit, table[i].scaled) == 0) {
            double length = 1e-3, time = 1.0;
            status = units_of(grid, key, table[i].length ? &length : NULL, table[i].time ? &time : NULL, error);
            quantity->factor = (table[i].length ? 1e3 * length : 1.0) * (table[i].time < 0   ? 1.0 / time
                                                                         : table[i].time > 0 ? time
                                                                                             : 1.0);
            unit = table[i].lab;
            break;
        }
    char words[64];
    words_of(key, words, sizeof words);
    if (unit[0] && strcmp(unit, "1") != 0)
        (void)snprintf(quantity->label, sizeof quantity->label, "%s (%s)", words, unit);
    else
        (void)snprintf(quantity->label, sizeof quantity->label, "%s", words);
    return status;
}

fst_colour fst_regime_colour(int regime)
{
    static const fst_colour colours[] = {
        [FST_REGIME_UNDECIDED] = FST_COLOUR_GREY,    [FST_REGIME_LOCKED] = FST_COLOUR_BLUE,
        [FST_REGIME_LIBRATING] = FST_COLOUR_SKY,     [FST_REGIME_COUNTER_ROTATING] = FST_COLOUR_GREEN,
        [FST_REGIME_COROTATING] = FST_COLOUR_PURPLE, [FST_REGIME_CHAOTIC] = FST_COLOUR_VERMILION,
        [FST_REGIME_EJECTED] = FST_COLOUR_BLACK,     [FST_REGIME_LIFTED] = FST_COLOUR_ORANGE};
    return colours[regime];
}
