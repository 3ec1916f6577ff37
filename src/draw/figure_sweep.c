#include "draw/figure_sweep.h"

#include "base/error.h"

#include <stdio.h>
#include <string.h>

fst_sweep_axis fst_sweep_axis_of(const fst_grid *grid, int index)
{
    const char *key = fst_grid_key(grid, index);
    const fst_param_info *info = fst_param_at(fst_param_find(key));
    fst_sweep_axis axis = {.index = index, .count = fst_grid_axis_points(grid, index), .factor = 1.0};
    const char *unit = fst_unit_name(info->unit);
    if (info->unit == FST_UNIT_LENGTH) {
        axis.factor = 1e3;
        unit = "mm";
    }
    char name[64];
    (void)snprintf(name, sizeof name, "%s", key);
    for (char *c = name; *c; ++c)
        if (*c == '.' || *c == '_')
            *c = ' ';
    if (info->kind == FST_KIND_CHOICE)
        (void)snprintf(axis.label, sizeof axis.label, "%s (number of the choice)", name);
    else if (info->unit == FST_UNIT_NUMBER)
        (void)snprintf(axis.label, sizeof axis.label, "%s (scaled)", name);
    else
        (void)snprintf(axis.label, sizeof axis.label, "%s (%s)", name, unit);
    return axis;
}

double fst_sweep_axis_value(const fst_grid *grid, const fst_sweep_axis *axis, int64_t point)
{
    return axis->factor * fst_grid_value(grid, axis->index, point);
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

void fst_sweep_key_label(const char *key, char *label, size_t size)
{
    const char *unit = "";
    for (int i = 0; i < fst_result_count(); ++i)
        if (strcmp(fst_result_at(i)->name, key) == 0)
            unit = fst_result_at(i)->unit;
    char name[64];
    (void)snprintf(name, sizeof name, "%s", key);
    for (char *c = name; *c; ++c)
        *c = *c == '_' ? ' ' : *c;
    if (unit[0] && strcmp(unit, "1") != 0)
        (void)snprintf(label, size, "%s (%s)", name, unit);
    else
        (void)snprintf(label, size, "%s", name);
}

fst_status fst_figure_sweep(const char *path, const char *const *keys, int count, const char *out,
                            fst_error *error)
{
    static const char *const curves[] = {"mean_r", "std_r", "mean_alpha_dot", "regime"}, *const map[] = {
                                                                                             "regime"};
    /* The axes are known only when the file is read; the first look costs little. */
    fst_sweep_table table;
    fst_status status = fst_sweep_read(path, map, 1, &table, error);
    if (status != FST_OK)
        return status;
    fst_sweep_axis axes[FST_AXIS_LIMIT];
    int varied = 0;
    for (int i = 0; i < fst_grid_axis_count(table.grid); ++i)
        if (fst_grid_axis_points(table.grid, i) > 1)
            axes[varied++] = fst_sweep_axis_of(table.grid, i);
    fst_sweep_table_free(&table);
    if (varied < 1 || varied > 2)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "a figure shows a sweep over one or two axes; this one has %d: festoon export it",
                        varied);
    if (varied == 2 && count > 1)
        return fst_fail(error, FST_BAD_INPUT, "--key", "a map shows one key, not %d", count);
    const char *const *shown = count > 0 ? keys : varied == 1 ? curves : map;
    const int shown_count = count > 0 ? count : varied == 1 ? 4 : 1;
    status = fst_sweep_read(path, shown, shown_count, &table, error);
    if (status != FST_OK)
        return status;
    status = varied == 1 ? fst_figure_sweep_curves(&table, shown, shown_count, &axes[0], out, error)
                         : fst_figure_sweep_map(&table, shown[0], axes, out, error);
    fst_sweep_table_free(&table);
    return status;
}
