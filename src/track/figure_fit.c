/* figure_fit.c - measured points with their errors over the model's curves with their bands. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>

#include "base/error.h"
#include "draw/chart.h"

enum { CURVES = 4 }; /* of a panel: band, line, points, outliers */

/* One panel and its numbers. */
typedef struct panel_data {
    double *x, *y, *spread;    /* of the curve */
    double *px, *py, *pspread; /* of the points */
    double *ox, *oy, *ospread; /* of the outliers */
    size_t points, outliers;
    fst_chart_curve curves[CURVES];
} panel_data;

static double factor_of(fst_measured what)
{
    return fst_measured_unit(what) == FST_UNIT_LENGTH ? 1e3 : 1.0;
}

/* Fill in the arrays of a panel out of one block of memory. */
static void fill(panel_data *d, double *memory, const fst_points *points, const fst_fit *fit, fst_measured what)
{
    const size_t n = fit->curve_count, m = fit->number_count;
    double **const places[] = {&d->x,       &d->y,  &d->spread, &d->px,     &d->py,
                               &d->pspread, &d->ox, &d->oy,     &d->ospread};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        *places[i] = memory;
        memory += i < 3 ? n : m;
    }
    const double factor = factor_of(what);
    for (size_t i = 0; i < n; ++i) {
        d->x[i] = fit->curve[i].frequency;
        d->y[i] = factor * fit->curve[i].value[what];
        d->spread[i] = factor * fit->curve[i].spread[what];
    }
    for (size_t i = 0; i < m; ++i) {
        const fst_fit_number *number = &fit->numbers[i];
        const fst_point *row = &points->rows[number->row];
        if (number->what != what)
            continue;
        const size_t at = number->used ? d->points++ : d->outliers++;
        (number->used ? d->px : d->ox)[at] = row->frequency;
        (number->used ? d->py : d->oy)[at] = factor * number->value;
        (number->used ? d->pspread : d->ospread)[at] = factor * row->error[what];
    }
}

static void arrange(panel_data *d, const fst_fit *fit, fst_chart_panel *panel, const char *label)
{
    int count = 0;
    d->curves[count++] = (fst_chart_curve){.title = "uncertainty of the curve (one standard deviation)",
                                           .x = d->x,
                                           .y = d->y,
                                           .count = fit->curve_count,
                                           .colour = FST_COLOUR_BLUE,
                                           .style = FST_CURVE_BAND,
                                           .spread = d->spread};
    d->curves[count++] = (fst_chart_curve){
        .title = "model", .x = d->x, .y = d->y, .count = fit->curve_count, .colour = FST_COLOUR_BLUE};
    d->curves[count++] = (fst_chart_curve){.title = "measured",
                                           .x = d->px,
                                           .y = d->py,
                                           .count = d->points,
                                           .colour = FST_COLOUR_BLACK,
                                           .style = FST_CURVE_ERRORS,
                                           .spread = d->pspread};
    if (d->outliers)
        d->curves[count++] = (fst_chart_curve){.title = "left out",
                                               .x = d->ox,
                                               .y = d->oy,
                                               .count = d->outliers,
                                               .colour = FST_COLOUR_VERMILION,
                                               .style = FST_CURVE_OPEN_ERRORS,
                                               .spread = d->ospread};
    *panel = (fst_chart_panel){
        .left_label = label, .low = NAN, .high = NAN, .curves = d->curves, .curve_count = count};
}

fst_status fst_figure_fit(const fst_points *points, const fst_fit *fit, const char *out, fst_error *error)
{
    static const char *const labels[] = {"⟨r⟩ (mm)", "δr (mm)", "bead's frequency (Hz)"};
    panel_data data[FST_MEASURED_COUNT] = {{0}};
    fst_chart_panel panels[FST_MEASURED_COUNT];
    const size_t each = 3 * fit->curve_count + 6 * fit->number_count;
    int count = 0;
    if (fit->curve_count < 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.curve_points",
                        "the fit was made without curves");
    double *memory = calloc(FST_MEASURED_COUNT * each, sizeof *memory);
    if (!memory)
        return fst_fail(error, FST_NO_MEMORY, out, "out of memory");
    for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
        fill(&data[q], memory + (size_t)q * each, points, fit, (fst_measured)q);
        if (data[q].points + data[q].outliers > 0) {
            arrange(&data[q], fit, &panels[count], labels[q]);
            count += 1;
        }
    }
    const fst_chart chart = {.title = "Measured points and the fitted model",
                             .x_label = "frequency of the magnet (Hz)",
                             .x_low = fit->curve[0].frequency,
                             .x_high = fit->curve[fit->curve_count - 1].frequency,
                             .panels = panels,
                             .panel_count = count};
    const fst_status status = fst_figure_chart(out, &chart, error);
    free(memory);
    return status;
}
