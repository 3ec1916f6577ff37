/* figure_sweep_curves.c - keys of a sweep against its one axis, in the style of the paper's Fig. 6. */
#include "draw/figure_sweep.h"

#include "base/constants.h"
#include "base/error.h"
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

enum { MOST_KEYS = 8, MOST_POINTS = 10000 };

typedef struct drawing {
    double *x, *by_regime; /* by_regime[(panel * FST_REGIME_COUNT + regime) * points + i] */
    fst_chart_curve curves[MOST_KEYS * FST_REGIME_COUNT];
    fst_chart_panel panels[MOST_KEYS];
    int curve_count, panel_count;
    size_t points;   /* how many are drawn */
    int64_t *chosen; /* which ones */
    char title[192], about[256];
    char tics[MOST_KEYS][256]; /* of panels whose values are names */
} drawing;

static int any_value(const double *values, size_t count)
{
    for (size_t i = 0; i < count; ++i)
        if (isfinite(values[i]))
            return 1;
    return 0;
}

/* A key without any value gets no panel; the line below the title says so. */
static void mention_empty(drawing *d, const char *label)
{
    const size_t used = strlen(d->about);
    (void)snprintf(d->about + used, sizeof d->about - used, "%s%s",
                   strstr(d->about, "no value of: ") ? ", " : "; no value of: ", label);
}

/* Add a curve to a panel for each regime that occurs, at the heights `values`, so that the points show their
 * regimes. */
static void add_regimes(drawing *d, int panel, const double *regime, const double *values)
{
    for (int r = 0; r < FST_REGIME_COUNT; ++r) {
        double *y = d->by_regime + (size_t)(panel * FST_REGIME_COUNT + r) * d->points;
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

/* One panel for each key.  The regime, where it is asked for beside other keys, has no panel: it colours the
 * points of all panels.  (A colour that means a regime in one panel must not mean anything else in the next.)
 */
static void add_panels(drawing *d, const fst_sweep_table *table, const fst_sweep_quantity *quantities,
                       int count)
{
    const size_t all = (size_t)fst_grid_points(table->grid);
    const double *regime = NULL;
    for (int k = 1; k < count; ++k)
        if (strcmp(quantities[k].key, "regime") == 0)
            regime = table->values + (size_t)k * all;
    for (int k = 0; k < count; ++k)
        for (size_t i = 0; i < d->points; ++i)
            table->values[(size_t)k * all + i] = table->values[(size_t)k * all + (size_t)d->chosen[i]];
    for (int k = 0; k < count; ++k) {
        double *values = table->values + (size_t)k * all;
        if (strcmp(quantities[k].key, "regime") == 0 && k > 0)
            continue;
        for (size_t i = 0; i < d->points; ++i)
            values[i] *= quantities[k].factor;
        if (!any_value(values, d->points)) {
            mention_empty(d, quantities[k].label);
            continue;
        }
        fst_chart_panel *panel = &d->panels[d->panel_count++];
        *panel = (fst_chart_panel){
            .left_label = quantities[k].label, .low = NAN, .high = NAN, .curves = &d->curves[d->curve_count]};
        const int names =
            fst_sweep_result_tics(quantities[k].key, d->tics[d->panel_count - 1], sizeof d->tics[0]);
        if (names) {
            panel->tics = d->tics[d->panel_count - 1];
            panel->low = -0.5;
            panel->high = names - 0.5;
        }
        const int first = d->curve_count;
        if (regime)
            add_regimes(d, d->panel_count - 1, regime, values);
        else
            d->curves[d->curve_count++] = (fst_chart_curve){.x = d->x,
                                                            .y = values,
                                                            .count = d->points,
                                                            .colour = FST_COLOUR_BLUE,
                                                            .style = FST_CURVE_POINTS};
        panel->curve_count = d->curve_count - first;
    }
}

/* Set the abscissa and its range: from the least value to the greatest, or half a unit beyond for a choice. */
static void lay_abscissa(drawing *d, const fst_grid *grid, const fst_sweep_axis *axis, double *low,
                         double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < d->points; ++i) {
        d->x[i] = fst_sweep_axis_value(grid, axis, d->chosen[i]);
        *low = fmin(*low, d->x[i]);
        *high = fmax(*high, d->x[i]);
    }
    const double wider = axis->choice ? 0.5 : *low < *high ? 0.0 : 0.1 * fabs(*low);
    *low -= wider;
    *high += wider;
}

/* The scaled angular velocity of a drive of 1 Hz; 0 for other axes. */
static double scale_of_drive(const fst_grid *grid, const fst_sweep_axis *axis)
{
    const char *key = fst_grid_key(grid, axis->index);
    const double factor = FST_TWO_PI / fst_grid_base(grid)->friction_gamma;
    const int in_hertz = strcmp(key, "drive.frequency") == 0
                             ? axis->factor == 1.0
                             : strcmp(key, "drive.omega") == 0 && axis->factor != 1.0;
    return in_hertz ? factor : 0.0;
}

/* Every `step`-th point; of a refined sweep, of those that were computed. */
static void choose_points(const fst_sweep_table *table, size_t step, int64_t *chosen)
{
    const int64_t points = fst_grid_points(table->grid);
    size_t seen = 0, count = 0;
    for (int64_t i = 0; i < points; ++i)
        if (!table->refine || table->computed[i]) {
            if (seen % step == 0)
                chosen[count++] = i;
            ++seen;
        }
}

fst_status fst_figure_sweep_curves(const fst_sweep_table *table, const fst_sweep_quantity *quantities,
                                   int count, const fst_sweep_axis *axis, const char *out, fst_error *error)
{
    drawing *d = calloc(1, sizeof *d);
    const size_t all = (size_t)(table->refine ? table->rows : fst_grid_points(table->grid));
    const size_t step = all > 0 ? (all + MOST_POINTS - 1) / MOST_POINTS : 1,
                 points = all / step + (all % step > 0);
    double *memory = malloc((1 + MOST_KEYS * FST_REGIME_COUNT) * (points + 1) * sizeof *memory);
    int64_t *chosen = malloc((points + 1) * sizeof *chosen);
    if (!d || !memory || !chosen) {
        free(d);
        free(chosen);
        free(memory);
        return fst_fail(error, FST_NO_MEMORY, out, "no memory for %zu points", points);
    }
    d->points = points;
    d->chosen = chosen;
    choose_points(table, step, chosen);
    d->x = memory;
    d->by_regime = memory + points;
    double low, high;
    lay_abscissa(d, table->grid, axis, &low, &high);
    char words[128];
    fst_sweep_words(axis->label, words);
    (void)snprintf(d->title, sizeof d->title, "Sweep over the %s", words);
    fst_sweep_about(table, d->about, sizeof d->about);
    if (step > 1)
        (void)snprintf(d->about + strlen(d->about), sizeof d->about - strlen(d->about),
                       "; drawn: one point of %zu", step);
    add_panels(d, table, quantities, count);
    char tics[512] = "";
    if (axis->choice)
        fst_sweep_choice_tics(axis, tics, sizeof tics);
    const double scale = scale_of_drive(table->grid, axis);
    const fst_chart chart = {.title = d->title,
                             .about = d->about,
                             .x_label = axis->label,
                             .x_low = low,
                             .x_high = high,
                             .x_logarithmic = axis->logarithmic,
                             .x_tics = axis->choice ? tics : NULL,
                             .x2_label = scale > 0 ? "drive ω (γ)" : NULL,
                             .x2_factor = scale,
                             .panels = d->panels,
                             .panel_count = d->panel_count};
    const fst_status status = d->panel_count > 0 ? fst_figure_chart(out, &chart, error)
                                                 : fst_fail(error, FST_BAD_INPUT, out,
                                                            "no point of the sweep has a value to draw yet");
    free(chosen);
    free(memory);
    free(d);
    return status;
}
