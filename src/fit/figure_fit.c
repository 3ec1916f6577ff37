/* figure_fit.c - what a figure of a fit shows: measured points with their errors over the model's curves, and below
 * them what is left over, at whose scale the curves' uncertainty can be seen. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <string.h>

#include "base/error.h"
#include "draw/chart.h"

enum { CURVES = 4 }; /* of a panel at most: band, line, points, outliers */

/* What is drawn of a quantity: points over the curve, or (`left`) both less the model. */
typedef struct part {
    const fst_points *points;
    const fst_fit *fit;
    fst_measured what;
    int left;
    double factor;
} part;

/* The model's curve with its spread. */
static int put_curve(fst_chart *chart, const part *p, fst_chart_curve *curve)
{
    const size_t n = p->fit->curve_count;
    double *x = fst_chart_keep(chart, 3 * n * sizeof *x), *y = x + n, *spread = y + n;
    for (size_t i = 0; x && i < n; ++i) {
        x[i] = p->fit->curve[i].frequency;
        y[i] = p->left && isfinite(p->fit->curve[i].value[p->what])
                   ? 0.0
                   : p->factor * p->fit->curve[i].value[p->what];
        spread[i] = p->factor * p->fit->curve[i].spread[p->what];
    }
    *curve = (fst_chart_curve){.x = x, .y = y, .count = n, .colour = FST_COLOUR_BLUE, .spread = spread};
    return x != NULL;
}

/* The numbers that were used, or the outliers, with their errors. */
static int put_numbers(fst_chart *chart, const part *p, int used, fst_chart_curve *curve)
{
    const size_t n = p->fit->number_count;
    double *x = fst_chart_keep(chart, 4 * n * sizeof *x), *y = x + n, *spread = y + n, *x_spread = spread + n;
    size_t count = 0;
    for (size_t i = 0; x && i < n; ++i) {
        const fst_fit_number *number = &p->fit->numbers[i];
        const fst_point *row = &p->points->rows[number->row];
        if (number->what != p->what || (number->used != 0) != used)
            continue;
        x[count] = row->frequency;
        y[count] = p->factor * (number->value - (p->left ? number->expected : 0.0));
        spread[count] = p->factor * row->error[p->what];
        x_spread[count++] = isfinite(row->frequency_error) ? row->frequency_error : 0.0;
    }
    *curve = (fst_chart_curve){.title = used ? "measured" : "left out",
                               .x = x,
                               .y = y,
                               .count = count,
                               .colour = used ? FST_COLOUR_BLACK : FST_COLOUR_VERMILION,
                               .style = used ? FST_CURVE_ERRORS : FST_CURVE_OPEN_ERRORS,
                               .spread = spread,
                               .x_spread = x_spread};
    return x != NULL;
}

/* Whether a band can be seen in its panel, whose height the curve and the points decide. */
static int is_wide(const fst_chart_curve *band, const fst_chart_curve *points)
{
    double low = INFINITY, high = -INFINITY, widest = 0.0;
    for (int c = 0; c < 2; ++c) {
        const fst_chart_curve *curve = c ? points : band;
        for (size_t i = 0; i < curve->count; ++i)
            if (isfinite(curve->y[i]) && isfinite(curve->spread[i])) {
                low = fmin(low, curve->y[i] - curve->spread[i]);
                high = fmax(high, curve->y[i] + curve->spread[i]);
                widest = c ? widest : fmax(widest, 2.0 * curve->spread[i]);
            }
    }
    return widest > 0.01 * (high - low);
}

static int put_panel(fst_chart *chart, const part *p, fst_chart_panel *panel)
{
    fst_chart_curve *curves = fst_chart_keep(chart, CURVES * sizeof *curves);
    const fst_scales scales = fst_scales_of(&p->fit->params);
    const char *unit = fst_measured_unit(p->what) == FST_UNIT_LENGTH ? "l" : "Hz";
    fst_quantity shown = fst_quantity_of_result(fst_measured_name(p->what), unit, FST_SHOWN_LAB, &scales);
    if (p->left) {
        const char *in = strrchr(shown.label, '(');
        char words[sizeof shown.label];
        (void)snprintf(words, sizeof words, "measured − model %.60s", in ? in : "");
        memcpy(shown.label, words, sizeof words);
    }
    const char *label = fst_chart_text(chart, shown.label);
    if (!curves || !label || !put_curve(chart, p, &curves[0]) || !put_numbers(chart, p, 1, &curves[2]) ||
        !put_numbers(chart, p, 0, &curves[3]))
        return 0;
    curves[1] = curves[0];
    if (is_wide(&curves[0], &curves[2]))
        curves[0].title = "uncertainty of the model (one standard deviation)";
    curves[0].style = FST_CURVE_BAND;
    curves[1].title = "model";
    curves[1].spread = NULL;
    *panel = (fst_chart_panel){.left_label = label,
                               .low = NAN,
                               .high = NAN,
                               .curves = curves,
                               .curve_count = curves[3].count ? CURVES : CURVES - 1};
    return 1;
}

/* "magnetic strength κ = 1.5 ± 0.01, ..." */
static const char *found(fst_chart *chart, const fst_fit *fit)
{
    char about[512] = "";
    const fst_scales scales = fst_scales_of(&fit->params);
    for (int i = 0; i < fit->free_count; ++i) {
        const fst_fit_parameter *free = &fit->parameters[i];
        const fst_quantity shown = fst_quantity_of_parameter(free->key, FST_SHOWN_AS_GIVEN, &scales);
        const char *unit = strstr(shown.label, " (");
        const size_t used = strlen(about);
        const int words = unit ? (int)(unit - shown.label) : (int)strlen(shown.label);
        (void)snprintf(about + used, sizeof about - used, "%s%.*s = %.6g ± %.2g", i ? ", " : "", words,
                       shown.label, shown.factor * free->value, shown.factor * free->error);
        if (unit && strlen(about) + strlen(unit) < sizeof about)
            (void)snprintf(about + strlen(about), sizeof about - strlen(about), " %.*s", (int)strlen(unit) - 3,
                           unit + 2);
    }
    return fst_chart_text(chart, about);
}

static int fill(fst_chart *chart, part *p, int wanted)
{
    fst_chart_panel *panels = fst_chart_keep(chart, 2 * FST_MEASURED_COUNT * sizeof *panels);
    if (!panels || !(chart->about = found(chart, p->fit)))
        return 0;
    for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
        int there = 0, power;
        for (size_t i = 0; i < p->fit->number_count; ++i)
            there = there || (int)p->fit->numbers[i].what == q;
        p->what = (fst_measured)q;
        (void)fst_unit_customary(fst_measured_unit(p->what), &power);
        p->factor = pow(10.0, power);
        for (p->left = 0; p->left < 2 && there && (wanted < 0 || wanted == q); ++p->left)
            if (!put_panel(chart, p, &panels[chart->panel_count++]))
                return 0;
    }
    chart->title = "Measured points and the fitted model";
    chart->x_label = "frequency of the magnet (Hz)";
    chart->x_low = p->fit->curve[0].frequency;
    chart->x_high = p->fit->curve[p->fit->curve_count - 1].frequency;
    chart->panels = panels;
    return 1;
}

fst_status fst_chart_of_fit(const fst_points *points, const fst_fit *fit, int what, fst_chart **chart,
                            fst_error *error)
{
    part p = {.points = points, .fit = fit};
    *chart = NULL;
    if (fit->curve_count < 2)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.curve_points",
                        "the fit was made without curves");
    fst_chart *made = fst_chart_new();
    if (!made || !fill(made, &p, what)) {
        fst_chart_free(made);
        return fst_fail(error, FST_NO_MEMORY, "fst_chart_of_fit", "out of memory");
    }
    *chart = made;
    return FST_OK;
}

fst_status fst_figure_fit(const fst_points *points, const fst_fit *fit, const char *out, fst_error *error)
{
    fst_chart *chart;
    fst_status status = fst_chart_of_fit(points, fit, -1, &chart, error);
    if (status == FST_OK)
        status = fst_figure_chart(out, chart, error);
    fst_chart_free(chart);
    return status;
}
