/* figure_lag.c - the phase portrait of a lock: the angle of one bead's moment to the field that it is in, and how fast that
 * changes.  A lock is a point or a closed curve, its loss a line that runs on through all angles. */
#include "draw/figure_beads.h"

#include "base/constants.h"
#include "base/error.h"
#include "draw/chart.h"
#include "draw/style.h"

#include <math.h>
#include <string.h>

/* Between the moment and the field at the bead: the moment's angle less the field's about an axis, as a wave's field turns
 * about y and a magnet's about z; or the angle between them, where the field stands along that axis at some time. */
typedef enum angle_kind { ABOUT_Y = 1, ABOUT_Z, BETWEEN } angle_kind;

/* Moment and field a little before a row and a little after it. */
typedef struct moment_in_field {
    double n[2][3], b[2][3];
} moment_in_field;

/* How much before and after, in parts of the time between rows. */
static const double LITTLE = 1e-4;

/* A field whose part across the axis is less than this part of it stands along the axis. */
static const double ALONG = 0.2;

/* How high the plate lies over the magnet's reference plane, from which fields count heights; 0 without a plate. */
static fst_status find_plate(const fst_params *scene, double *plate, fst_error *error)
{
    fst_model *model;
    const fst_status status = fst_field_model_new(scene, NAN, &model, error);
    if (status != FST_OK)
        return status;
    const fst_groups groups = fst_model_groups(model);
    *plate = scene->plate_shape == FST_PLATE_NONE ? 0.0 : groups.h - groups.eps;
    fst_model_free(model);
    return FST_OK;
}

static fst_status look(const fst_beads_table *table, size_t row, double plate, double little,
                       moment_in_field *two, fst_error *error)
{
    double x[3], v[3], n[3], w[3], place[3], grad[3][3];
    fst_beads_table_vector(table, row, 0, 0, 0, x);
    fst_beads_table_vector(table, row, 0, 3, 0, v);
    fst_beads_table_vector(table, row, 0, 6, 0, n);
    fst_beads_table_vector(table, row, 0, 9, 0, w);
    fst_status status = FST_OK;
    for (int end = 0; end < 2 && status == FST_OK; ++end) {
        const double later = end ? little : -little;
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3, k = (i + 2) % 3;
            place[i] = x[i] + later * v[i];
            two->n[end][i] = n[i] + later * (w[j] * n[k] - w[k] * n[j]);
        }
        place[2] += plate;
        status = fst_field_at(&table->scene, table->t[row] + later, place, two->b[end], grad, error);
    }
    return status;
}

static double across(const double vector[3], int axis)
{
    return hypot(vector[(axis + 1) % 3], vector[(axis + 2) % 3]);
}

static double size_of(const double vector[3])
{
    return hypot(across(vector, 0), vector[0]);
}

static angle_kind kind_of(const fst_params *scene, const moment_in_field *rows, size_t count)
{
    const angle_kind kind = scene->drive_waveform == FST_WAVEFORM_WAVE ? ABOUT_Y : ABOUT_Z;
    for (size_t i = 0; i < count; ++i)
        if (across(rows[i].b[0], (int)kind) < ALONG * size_of(rows[i].b[0]))
            return BETWEEN;
    return kind;
}

static double azimuth(const double vector[3], int axis)
{
    return across(vector, axis) > 0.0 ? atan2(vector[(axis + 2) % 3], vector[(axis + 1) % 3]) : NAN;
}

static double angle_of(const moment_in_field *two, int end, angle_kind kind)
{
    const double *n = two->n[end], *b = two->b[end];
    if (kind != BETWEEN)
        return azimuth(n, (int)kind) - azimuth(b, (int)kind);
    const double normal[3] = {n[1] * b[2] - n[2] * b[1], n[2] * b[0] - n[0] * b[2], n[0] * b[1] - n[1] * b[0]};
    return size_of(b) > 0.0 ? atan2(size_of(normal), n[0] * b[0] + n[1] * b[1] + n[2] * b[2]) : NAN;
}

/* Angles between -180 and 180 degrees, broken where they pass from one to the other.  Returns the number of points. */
static size_t put_points(const moment_in_field *rows, size_t row_count, angle_kind kind, double little,
                         double unit, double *x, double *y)
{
    size_t count = 0;
    for (size_t row = 0; row < row_count; ++row) {
        const double before = angle_of(&rows[row], 0, kind), after = angle_of(&rows[row], 1, kind);
        const double change = remainder(after - before, FST_TWO_PI);
        const double degrees = 180.0 / FST_PI * remainder(before + 0.5 * change, FST_TWO_PI);
        if (!(fabs(change) <
              0.5 * FST_PI)) /* a moment that passes the axis has no angle, nor has one without a field */
            continue;
        if (count > 0 && fabs(degrees - x[count - 1]) > 180.0) {
            x[count] = y[count] = NAN;
            ++count;
        }
        x[count] = degrees;
        y[count++] = unit * change / (2.0 * little);
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

/* The curve, its beginning and the words of the abscissa. */
static fst_status put_angles(const fst_beads_table *table, const fst_figure_part *part, double unit,
                             fst_chart *chart, fst_chart_curve curves[2], fst_error *error)
{
    static const char *const labels[] = {
        [ABOUT_Y] = "moment's angle less the field's at the bead, about y (degrees)",
        [ABOUT_Z] = "moment's angle less the field's at the bead, about z (degrees)",
        [BETWEEN] = "angle between the moment and the field at the bead (degrees)"};
    const size_t rows = part->last - part->first;
    const double little = LITTLE * (table->t[part->last - 1] - table->t[part->first]) / (double)(rows - 1);
    moment_in_field *seen = fst_chart_keep(chart, rows * sizeof *seen);
    double *x = fst_chart_keep(chart, 2 * rows * sizeof *x), *y = fst_chart_keep(chart, 2 * rows * sizeof *y);
    if (!seen || !x || !y)
        return fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    double plate = 0.0;
    fst_status status = find_plate(&table->scene, &plate, error);
    for (size_t i = 0; i < rows && status == FST_OK; ++i)
        status = look(table, part->first + i, plate, little, &seen[i], error);
    if (status != FST_OK)
        return status;
    const angle_kind kind = kind_of(&table->scene, seen, rows);
    const size_t count = put_points(seen, rows, kind, little, unit, x, y);
    if (count == 0)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_figure_options.kind",
            "the moment lies along the %s axis all the time, or no field is there, so that it has no lag",
            kind == ABOUT_Y ? "y" : "z");
    curves[0] = (fst_chart_curve){.x = x, .y = y, .count = count, .colour = FST_COLOUR_BLUE};
    curves[1] = (fst_chart_curve){.title = "at the beginning",
                                  .x = x,
                                  .y = y,
                                  .count = 1,
                                  .colour = FST_COLOUR_BLACK,
                                  .style = FST_CURVE_POINTS};
    chart->x_label = labels[kind];
    choose_range(chart, x, count);
    return FST_OK;
}

fst_status fst_chart_of_lag(const fst_beads_table *table, const fst_figure_options *options, fst_chart *chart,
                            fst_error *error)
{
    fst_table whole = {.rows = 0};
    fst_figure_part part;
    if (table->count != 1)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of the lag is of one bead in a world, and this trajectory is of %d",
                        table->count);
    fst_status status = fst_beads_table_alone(table, 0, 0, table->rows, &whole, error);
    if (status == FST_OK)
        status = fst_figure_part_of(&whole, options, &part, error);
    fst_table_free(&whole);
    if (status != FST_OK)
        return status;
    const char *unit;
    char label[96], symbols[32];
    const fst_scales scales = fst_scales_of(&table->scene);
    const double shown = fst_number_shown("mean_phi_dot", "gamma", part.units, &scales, &unit);
    fst_chart_curve *curves = fst_chart_keep(chart, 2 * sizeof *curves);
    fst_chart_panel *panel = fst_chart_keep(chart, sizeof *panel);
    if (!curves || !panel)
        return fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    status = put_angles(table, &part, shown, chart, curves, error);
    if (status != FST_OK)
        return status;
    fst_unit_symbols(unit, symbols, sizeof symbols);
    (void)snprintf(label, sizeof label, "its rate%s (%s)", strcmp(unit, "Hz") == 0 ? "/2π" : "", symbols);
    *panel = (fst_chart_panel){.left_label = fst_chart_text(chart, label),
                               .low = NAN,
                               .high = NAN,
                               .curves = curves,
                               .curve_count = 2};
    chart->panels = panel;
    chart->panel_count = 1;
    chart->title = fst_chart_text(chart, options->title ? options->title
                                                        : "Angle of the moment to the field, and its rate");
    chart->about = fst_chart_text(chart, part.about);
    chart->scene = fst_chart_scene(chart, &table->scene);
    return chart->title && chart->about && panel->left_label
               ? FST_OK
               : fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
}
