/* figure_sweep_curves.c - keys of a sweep against its one axis, in the style of the paper's Fig. comparison. */
#include "draw/figure_sweep.h"

#include "base/error.h"
#include "draw/chart.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_KEYS = 8, REGIMES = FST_REGIME_LIFTED + 1 };

typedef struct drawing {
    double *x, *by_regime;
    fst_chart_curve curves[MOST_KEYS + REGIMES];
    fst_chart_panel panels[MOST_KEYS];
    char labels[MOST_KEYS][96];
    int curve_count, panel_count;
    size_t points;
} drawing;

/* One curve for each regime that occurs, at the height of `values`: who does what where. */
static void add_regimes(drawing *d, const double *regime, const double *values)
{
    for (int r = 0; r < REGIMES; ++r) {
        double *y = d->by_regime + (size_t)r * d->points;
        int occurs = 0;
        for (size_t i = 0; i < d->points; ++i) {
            y[i] = regime[i] == r ? values[i] : NAN;
            occurs = occurs || isfinite(y[i]);
        }
        if (occurs)
            d->curves[d->curve_count++] = (fst_chart_curve){.title = fst_regime_name((fst_regime)r),
                                                            .x = d->x,
                                                            .y = y,
                                                            .count = d->points,
                                                            .colour = fst_regime_colour(r),
                                                            .style = FST_CURVE_POINTS};
    }
}

/* A panel a key; the regime, where it is asked for, colours the points of the key before it. */
static void add_panels(drawing *d, const fst_sweep_table *table, const char *const *keys, int count)
{
    for (int k = 0; k < count; ++k) {
        const double *values = table->values + (size_t)k * d->points;
        const int regimes_follow = k + 1 < count && strcmp(keys[k + 1], "regime") == 0;
        if (strcmp(keys[k], "regime") == 0 && k > 0)
            continue;
        fst_chart_panel *panel = &d->panels[d->panel_count];
        fst_sweep_key_label(keys[k], d->labels[d->panel_count], sizeof d->labels[0]);
        *panel = (fst_chart_panel){.left_label = d->labels[d->panel_count++],
                                   .low = NAN,
                                   .high = NAN,
                                   .key = regimes_follow ? "top right" : NULL,
                                   .curves = &d->curves[d->curve_count]};
        const int first = d->curve_count;
        if (regimes_follow)
            add_regimes(d, values + d->points, values);
        else
            d->curves[d->curve_count++] = (fst_chart_curve){.x = d->x,
                                                            .y = values,
                                                            .count = d->points,
                                                            .colour = FST_COLOUR_BLUE,
                                                            .style = FST_CURVE_POINTS};
        panel->curve_count = d->curve_count - first;
    }
}

fst_status fst_figure_sweep_curves(const fst_sweep_table *table, const char *const *keys, int count,
                                   const fst_sweep_axis *axis, const char *out, fst_error *error)
{
    if (count > MOST_KEYS)
        return fst_fail(error, FST_BAD_INPUT, "--key", "a figure shows at most %d keys", MOST_KEYS);
    drawing *d = calloc(1, sizeof *d);
    const size_t points = (size_t)fst_grid_points(table->grid);
    double *memory = malloc((1 + REGIMES) * points * sizeof *memory);
    if (!d || !memory) {
        free(d);
        free(memory);
        return fst_fail(error, FST_NO_MEMORY, out, "no memory for %zu points", points);
    }
    d->points = points;
    d->x = memory;
    d->by_regime = memory + points;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < points; ++i) {
        d->x[i] = fst_sweep_axis_value(table->grid, axis, (int64_t)i);
        low = fmin(low, d->x[i]);
        high = fmax(high, d->x[i]);
    }
    add_panels(d, table, keys, count);
    fst_model *model = NULL;
    const int in_hertz = strcmp(fst_grid_key(table->grid, axis->index), "drive.frequency") == 0;
    double scale = 0.0;
    if (in_hertz && fst_model_new(fst_grid_base(table->grid), &model, NULL) == FST_OK)
        scale = 6.283185307179586 * fst_model_groups(model).time_unit;
    fst_model_free(model);
    const fst_chart chart = {.title = "Sweep over one parameter",
                             .x_label = axis->label,
                             .x_low = low,
                             .x_high = high,
                             .x2_label = scale > 0 ? "drive ω (scaled)" : NULL,
                             .x2_factor = scale,
                             .panels = d->panels,
                             .panel_count = d->panel_count};
    const fst_status status = fst_figure_chart(out, &chart, error);
    free(memory);
    free(d);
    return status;
}
