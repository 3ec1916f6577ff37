/* figure_lag.c - the phase portrait of a lock: by how much the moment of one bead lags behind the field that carries it,
 * and how fast that changes.  A lock is a point or a closed curve, its loss a line that runs on through all angles. */
#include "draw/figure_beads.h"

#include "base/constants.h"
#include "base/error.h"
#include "draw/chart.h"
#include "draw/style.h"

#include <math.h>
#include <string.h>

/* The lag, in turns of the field, and its rate in gamma, of a row. */
typedef struct lag {
    double angle, rate;
} lag;

/* The moment's angle in the plane spanned by the axes a and b, from a to b, and how fast it turns: n' = W x n. */
static lag turning(const double n[3], const double w[3], int a, int b, double sign)
{
    const double rate[3] = {w[1] * n[2] - w[2] * n[1], w[2] * n[0] - w[0] * n[2], w[0] * n[1] - w[1] * n[0]};
    const double across = n[a] * n[a] + n[b] * n[b];
    return (lag){atan2(sign * n[b], n[a]), sign * (n[a] * rate[b] - n[b] * rate[a]) / across};
}

/* In a wave, B = p (cos th, 0, -sin th) with th = k x - omega t, and from above the same with -th; over a magnet that turns
 * about z, the angle of the magnet. */
static lag lag_of(const fst_beads_table *table, size_t row, double omega, double wave_number)
{
    double x[3], v[3], n[3], w[3];
    fst_beads_table_vector(table, row, 0, 0, 0, x);
    fst_beads_table_vector(table, row, 0, 3, 0, v);
    fst_beads_table_vector(table, row, 0, 6, 0, n);
    fst_beads_table_vector(table, row, 0, 9, 0, w);
    const double turned = omega * table->t[row];
    if (wave_number == 0.0) {
        const lag moment = turning(n, w, 0, 1, 1.0);
        return (lag){moment.angle - turned, moment.rate - omega};
    }
    const double sign = table->scene.wave_ratio > 1.0 ? -1.0 : 1.0; /* the stronger field is that from above */
    const lag moment = turning(n, w, 0, 2, -1.0);
    return (lag){moment.angle - sign * (wave_number * x[0] - turned),
                 moment.rate - sign * (wave_number * v[0] - omega)};
}

static fst_status check(const fst_beads_table *table, fst_error *error)
{
    const int waveform = table->scene.drive_waveform;
    if (table->count != 1)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of the lag is of one bead in a world, and this trajectory is of %d",
                        table->count);
    if (waveform != FST_WAVEFORM_WAVE && waveform != FST_WAVEFORM_STEADY)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of the lag needs a wave or a magnet that turns steadily");

    return FST_OK;
}

/* Lags between -180 and 180 degrees, broken where they pass from one to the other.  Returns the number of points. */
static size_t put_points(const fst_beads_table *table, const fst_figure_part *part, double unit, double *x,
                         double *y)
{
    const fst_params *scene = &table->scene;
    const fst_scales scales = fst_scales_of(scene);
    const double omega = FST_TWO_PI * fst_drive_frequency(scene) * scales.time;
    const double wave_number =
        scene->drive_waveform == FST_WAVEFORM_WAVE ? 2.0 * FST_PI * scales.length / scene->wave_length : 0.0;
    size_t count = 0;
    for (size_t row = part->first; row < part->last; ++row) {
        const lag here = lag_of(table, row, omega, wave_number);
        const double degrees = 180.0 / FST_PI * remainder(here.angle, 2.0 * FST_PI);
        if (!isfinite(here.rate)) /* a moment along the axis has no angle */
            continue;
        if (count > 0 && fabs(degrees - x[count - 1]) > 180.0) {
            x[count] = y[count] = NAN;
            ++count;
        }
        x[count] = degrees;
        y[count++] = unit * here.rate;
    }
    return count;
}

/* All lags, or all angles where the lag runs through them. */
static void choose_range(fst_chart *chart, const double *x, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        low = fmin(low, x[i]);
        high = fmax(high, x[i]);
    }
    const double margin = fmax(0.05 * (high - low), 0.5);
    const int through = high - low > 330.0;
    chart->x_low = through ? -180.0 : low - margin;
    chart->x_high = through ? 180.0 : high + margin;
}

fst_status fst_chart_of_lag(const fst_beads_table *table, const fst_figure_options *options, fst_chart *chart,
                            fst_error *error)
{
    fst_table whole = {.rows = 0};
    fst_figure_part part;
    fst_status status = check(table, error);
    if (status == FST_OK)
        status = fst_beads_table_alone(table, 0, 0, table->rows, &whole, error);
    if (status == FST_OK)
        status = fst_figure_part_of(&whole, options, &part, error);
    fst_table_free(&whole);
    if (status != FST_OK)
        return status;
    const char *unit;
    char label[96], symbols[32];
    const fst_scales scales = fst_scales_of(&table->scene);
    const double shown = fst_number_shown("mean_phi_dot", "gamma", part.units, &scales, &unit);
    const size_t room = 2 * (part.last - part.first);
    double *x = fst_chart_keep(chart, room * sizeof *x), *y = fst_chart_keep(chart, room * sizeof *y);
    fst_chart_curve *curves = fst_chart_keep(chart, 2 * sizeof *curves);
    fst_chart_panel *panel = fst_chart_keep(chart, sizeof *panel);
    if (!x || !y || !curves || !panel)
        return fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    fst_unit_symbols(unit, symbols, sizeof symbols);
    (void)snprintf(label, sizeof label, "its rate%s (%s)", strcmp(unit, "Hz") == 0 ? "/2π" : "", symbols);
    curves[0] = (fst_chart_curve){.x = x, .y = y, .colour = FST_COLOUR_BLUE};
    curves[0].count = put_points(table, &part, shown, x, y);
    if (curves[0].count == 0)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "the moment lies along the axis of the drive all the time, so that it has no lag");
    curves[1] = (fst_chart_curve){.title = "at the beginning",
                                  .x = x,
                                  .y = y,
                                  .count = 1,
                                  .colour = FST_COLOUR_BLACK,
                                  .style = FST_CURVE_POINTS};
    *panel = (fst_chart_panel){.left_label = fst_chart_text(chart, label),
                               .low = NAN,
                               .high = NAN,
                               .curves = curves,
                               .curve_count = 2};
    chart->panels = panel;
    chart->panel_count = 1;
    chart->title =
        fst_chart_text(chart, options->title ? options->title : "Lag of the moment behind the field");
    chart->about = fst_chart_text(chart, part.about);
    chart->scene = fst_chart_scene(chart, &table->scene);
    chart->x_label = "moment's angle less the field's (degrees)";
    choose_range(chart, x, curves[0].count);
    return chart->title && chart->about && panel->left_label
               ? FST_OK
               : fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
}
