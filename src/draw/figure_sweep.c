/* figure_sweep.c - fst_figure_sweep(): choosing which keys of a sweep are shown, as curves or as a map. */
#include "draw/figure_sweep.h"

#include "base/error.h"

enum { MOST_KEYS = 8, USUAL = 4 };

/* The axes that vary, one or two. */
static fst_status axes_of(const fst_grid *grid, const char *path, fst_shown_units units,
                          fst_sweep_axis axes[FST_AXIS_LIMIT], int *varied, fst_error *error)
{
    *varied = 0;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i)
        if (fst_grid_axis_points(grid, i) > 1) {
            const fst_status status = fst_sweep_axis_of(grid, i, units, &axes[(*varied)++], error);
            if (status != FST_OK)
                return status;
        }
    if (*varied < 1 || *varied > 2)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "a figure shows a sweep over one or two axes; this one has %d: use fst_sweep_export()",
                        *varied);
    return FST_OK;
}

/* The keys that are shown unless others are asked for; returns how many. */
static int choose_keys(const fst_grid *grid, int varied, const char *keys[USUAL])
{
    const fst_row_kind kind = fst_grid_row_kind(grid);
    static const char *const curves[][USUAL] = {
        [FST_ROWS_OF_RUNS] = {"mean_r", "std_r", "mean_alpha_dot", "regime"},
        [FST_ROWS_OF_BEADS] = {"outcome", "mean_r", "centre_rate", "axis_rate"},
        [FST_ROWS_OF_WORLDS] = {"mean_r", "mean_alpha_dot", "regime"},
        [FST_ROWS_OF_LEVITATION] = {"below_height_mm", "below_growth_per_s", "above_height_mm",
                                    "above_growth_per_s"}};
    const int is_map = varied == 2;
    int count = 0;
    for (; count < USUAL && curves[kind][count] && !is_map; ++count)
        keys[count] = curves[kind][count];
    if (kind == FST_ROWS_OF_WORLDS && fst_grid_base(grid)->drive_waveform == FST_WAVEFORM_WAVE && !is_map) {
        keys[0] = "mean_velocity"; /* it travels, and r grows for ever */
        keys[1] = "regime";
        return 2;
    }
    if (is_map)
        keys[count++] = kind == FST_ROWS_OF_LEVITATION ? "below"
                        : kind == FST_ROWS_OF_BEADS    ? "outcome"
                                                       : "regime";
    return count;
}

fst_status fst_figure_sweep(const char *path, const char *const *keys, int count, fst_shown_units units,
                            const char *out, fst_error *error)
{
    fst_sweep_axis axes[FST_AXIS_LIMIT];
    fst_sweep_quantity quantities[MOST_KEYS];
    int varied;
    fst_grid *grid;
    fst_status status = fst_sweep_read_grid(path, &grid, error);
    if (status != FST_OK)
        return status;
    const int asked = units != FST_SHOWN_AS_GIVEN;
    if (!asked)
        units = fst_sweep_units(grid);
    status = axes_of(grid, path, units, axes, &varied, error);
    if (status == FST_OK && varied == 2 && count > 1)
        status = fst_fail(error, FST_BAD_INPUT, "fst_figure_sweep.keys", "a map shows one key, not %d", count);
    if (status == FST_OK && count > MOST_KEYS)
        status = fst_fail(error, FST_BAD_INPUT, "fst_figure_sweep.keys", "a figure shows at most %d keys",
                          MOST_KEYS);
    const char *usual[USUAL];
    const int usual_count = choose_keys(grid, varied, usual);
    const char *const *shown = count > 0 ? keys : usual;
    const int shown_count = count > 0 ? count : usual_count;
    for (int i = 0; i < shown_count && status == FST_OK; ++i) {
        status = fst_sweep_quantity_of(grid, shown[i], units, &quantities[i], error);
        if (status == FST_BAD_INPUT && !asked) /* the units of the axis cannot show it */
            status = fst_sweep_quantity_of(grid, shown[i], FST_SHOWN_SCALED, &quantities[i], error);
    }
    fst_grid_free(grid);
    if (status != FST_OK)
        return status;
    fst_sweep_table table;
    status = varied == 1 ? fst_sweep_read(path, shown, shown_count, &table, error)
                         : fst_sweep_read_filled(path, shown, shown_count, &table, error);
    if (status != FST_OK)
        return status;
    status = varied == 1 ? fst_figure_sweep_curves(&table, quantities, shown_count, &axes[0], out, error)
                         : fst_figure_sweep_map(&table, &quantities[0], axes, out, error);
    fst_sweep_table_free(&table);
    return status;
}
