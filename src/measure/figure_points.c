/* figure_points.c - measured points over the curves of a sweep or of a branch, with chi^2.
 *
 * A curve is made of straight pieces between neighbouring rows of a sweep with the same regime, or between
 * neighbouring points of a branch.  What was measured is compared with stable states alone: no bead stays on
 * others.
 */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"

enum { MOST_CURVES = 4 };

/* A straight piece of a curve, of one quantity, in Hz and SI. */
typedef struct piece {
    double x[2], y[2];
    int stable;
} piece;

typedef struct pieces {
    piece *list[FST_MEASURED_COUNT];
    size_t count[FST_MEASURED_COUNT], room;
    double low, high; /* Hz */
} pieces;

static fst_status make_room(pieces *p, size_t room, fst_error *error)
{
    p->room = room;
    for (int q = 0; q < FST_MEASURED_COUNT; ++q) {
        p->list[q] = malloc((room + 1) * sizeof *p->list[q]);
        if (!p->list[q])
            return fst_fail(error, FST_NO_MEMORY, "", "no memory for %zu pieces of curves", room);
    }
    return FST_OK;
}

static void free_pieces(pieces *p)
{
    for (int q = 0; q < FST_MEASURED_COUNT; ++q)
        free(p->list[q]);
}

static void add_piece(pieces *p, int quantity, const double x[2], double from, double to, int stable)
{
    if (isfinite(from) && isfinite(to))
        p->list[quantity][p->count[quantity]++] = (piece){{x[0], x[1]}, {from, to}, stable};
}

/* ---------------------------------------------------------------- curves of a sweep and of a branch */

/* How a value of the varied parameter becomes Hz; 0: it is no drive. */
static double to_hertz(const char *key, double gamma)
{
    return strcmp(key, "drive.frequency") == 0 ? 1.0
           : strcmp(key, "drive.omega") == 0   ? gamma / FST_TWO_PI
                                               : 0.0;
}

static fst_status no_drive(const char *path, const char *key, fst_error *error)
{
    return fst_fail(error, FST_BAD_INPUT, path,
                    "points lie over the drive, but this varies %s: vary drive.frequency or drive.omega alone",
                    key);
}

/* The axis of a sweep that varies; FST_BAD_INPUT: more than one, or not the drive, or a unit varies. */
static fst_status find_axis(const fst_grid *grid, const char *path, int *axis, double *hertz, fst_error *error)
{
    *axis = -1;
    for (int i = 0; i < fst_grid_axis_count(grid); ++i) {
        if (fst_grid_axis_points(grid, i) < 2)
            continue;
        *hertz = to_hertz(fst_grid_key(grid, i), fst_grid_base(grid)->friction_gamma);
        if (*axis >= 0 || *hertz == 0.0)
            return no_drive(path, fst_grid_key(grid, i), error);
        *axis = i;
    }
    return *axis >= 0
               ? FST_OK
               : fst_fail(error, FST_BAD_INPUT, path, "this sweep has one point: there is no curve to compare");
}

typedef struct sweep_row {
    double x, regime, value[FST_MEASURED_COUNT];
} sweep_row;

/* Locked and librating beads are of one curve. */
static double kind_of(double regime)
{
    return regime == FST_REGIME_LIBRATING ? FST_REGIME_LOCKED : regime;
}

static int by_x(const void *a, const void *b)
{
    const double p = ((const sweep_row *)a)->x, q = ((const sweep_row *)b)->x;
    return (p > q) - (p < q);
}

static fst_status take_sweep(const char *path, pieces *p, fst_error *error)
{
    static const char *const keys[] = {"mean_r", "std_r", "mean_alpha_dot", "regime"};
    fst_sweep_table table;
    int axis = 0;
    double hertz = 0.0;
    fst_status status = fst_sweep_read(path, keys, 4, &table, error);
    if (status != FST_OK)
        return status;
    const size_t count = (size_t)fst_grid_points(table.grid);
    const fst_params *base = fst_grid_base(table.grid);
    const double factors[] = {base->magnet_half_length, base->magnet_half_length,
                              base->friction_gamma / FST_TWO_PI};
    sweep_row *rows = malloc((count + 1) * sizeof *rows);
    status = rows ? find_axis(table.grid, path, &axis, &hertz, error)
                  : fst_fail(error, FST_NO_MEMORY, path, "no memory for %zu rows", count);
    if (status == FST_OK)
        status = make_room(p, count, error);
    for (size_t i = 0; i < count && status == FST_OK; ++i) {
        rows[i].x = hertz * fst_grid_value(table.grid, axis, (int64_t)i);
        rows[i].regime = kind_of(table.values[3 * count + i]);
        for (size_t q = 0; q < FST_MEASURED_COUNT; ++q)
            rows[i].value[q] = factors[q] * table.values[q * count + i];
    }
    if (status == FST_OK)
        qsort(rows, count, sizeof *rows, by_x);
    for (size_t i = 0; i + 1 < count && status == FST_OK; ++i) {
        const double x[2] = {rows[i].x, rows[i + 1].x};
        for (int q = 0; q < FST_MEASURED_COUNT; ++q)
            if (rows[i].regime == rows[i + 1].regime)
                add_piece(p, q, x, rows[i].value[q], rows[i + 1].value[q], 1);
    }
    free(rows);
    fst_sweep_table_free(&table);
    return status;
}

static fst_status take_branch(const char *path, pieces *p, fst_error *error)
{
    fst_branch branch;
    fst_status status = fst_branch_read(path, &branch, error);
    if (status != FST_OK)
        return status;
    const double hertz = to_hertz(branch.key, branch.gamma), rate = branch.gamma / FST_TWO_PI;
    if (hertz == 0.0 || branch.second_key[0])
        status = no_drive(path, branch.second_key[0] ? branch.second_key : branch.key, error);
    else if (isnan(branch.gamma) || isnan(branch.half_length))
        status = fst_fail(error, FST_BAD_INPUT, path,
                          "this branch does not say by which length and rate it is scaled: "
                          "follow it again");
    if (status == FST_OK)
        status = make_room(p, branch.point_count, error);
    for (size_t i = 0; i + 1 < branch.point_count && status == FST_OK; ++i) {
        const fst_branch_point *a = &branch.points[i], *b = a + 1;
        if (a->branch != b->branch)
            continue;
        const double x[2] = {hertz * a->value, hertz * b->value};
        add_piece(p, FST_MEASURED_MEAN_R, x, branch.half_length * a->mean_r, branch.half_length * b->mean_r,
                  a->stable && b->stable);
        /* Where an orbit passes the axis the bead's frequency jumps by the drive's. */
        if (fabs(b->mean_alpha_dot - a->mean_alpha_dot) * rate < 0.5 * fmin(x[0], x[1]))
            add_piece(p, FST_MEASURED_BEAD_FREQUENCY, x, rate * a->mean_alpha_dot, rate * b->mean_alpha_dot,
                      a->stable && b->stable);
    }
    fst_branch_free(&branch);
    return status;
}

/* ---------------------------------------------------------------- chi^2 */

/* The stable piece at a frequency that is nearest to a value; NULL: there is none. */
static const piece *nearest_piece(const pieces *p, int quantity, double x, double value)
{
    const piece *best = NULL;
    double nearest = INFINITY;
    for (size_t i = 0; i < p->count[quantity]; ++i) {
        const piece *here = &p->list[quantity][i];
        if (!here->stable || x < fmin(here->x[0], here->x[1]) || x > fmax(here->x[0], here->x[1]) ||
            here->x[0] == here->x[1])
            continue;
        const double y = here->y[0] + (x - here->x[0]) / (here->x[1] - here->x[0]) * (here->y[1] - here->y[0]);
        if (fabs(y - value) < nearest) {
            best = here;
            nearest = fabs(y - value);
        }
    }
    return best;
}

/* Sums over lengths that one scale makes wrong alike, by s of its errors: chi^2 is least over s, as a fit has it. */
typedef struct scaled {
    double product, square;
} scaled;

/* The part of one measured number in chi^2: the error of the frequency counts by the curve's slope. */
static double part_of_chi2(const piece *at, const fst_point *point, int quantity, scaled *by_scale)
{
    const double slope = (at->y[1] - at->y[0]) / (at->x[1] - at->x[0]);
    const double y = at->y[0] + slope * (point->frequency - at->x[0]);
    const double along = isfinite(point->frequency_error) ? slope * point->frequency_error : 0.0;
    const double off = point->value[quantity] - y, error = point->error[quantity];
    const double variance = error * error + along * along;
    if (point->scale_error > 0.0 && fst_measured_unit((fst_measured)quantity) == FST_UNIT_LENGTH) {
        const double step = point->scale_error * point->value[quantity];
        by_scale->product += off * step / variance;
        by_scale->square += step * step / variance;
    }
    return off * off / variance;
}

static void add_chi2(const pieces *p, const fst_points *points, int quantity, scaled *by_scale,
                     fst_points_fit *fit)
{
    for (size_t i = 0; i < points->count; ++i) {
        const fst_point *point = &points->rows[i];
        if (isnan(point->value[quantity]))
            continue;
        const piece *at = nearest_piece(p, quantity, point->frequency, point->value[quantity]);
        ++fit->all;
        if (at) {
            ++fit->counted;
            fit->chi2 += part_of_chi2(at, point, quantity, by_scale);
        }
    }
}

/* ---------------------------------------------------------------- the figure */

/* Columns of numbers of one panel. */
typedef struct panel_data {
    double *x[3], *y[3], *spread;
    size_t count[3];
    fst_chart_curve curves[MOST_CURVES];
    int curve_count;
    char label[96];
} panel_data;

static double factor_of(int quantity)
{
    int power;
    (void)fst_unit_customary(fst_measured_unit((fst_measured)quantity), &power);
    return pow(10.0, power);
}

static fst_status fill_panel(panel_data *d, const pieces *p, const fst_points *points, int quantity,
                             fst_error *error)
{
    const size_t room = 3 * p->count[quantity] + points->count + 1;
    const double factor = factor_of(quantity);
    memset(d, 0, sizeof *d);
    double *memory = malloc(7 * room * sizeof *memory);
    if (!memory)
        return fst_fail(error, FST_NO_MEMORY, "", "no memory for a figure");
    for (int k = 0; k < 3; ++k) {
        d->x[k] = memory + (size_t)(2 * k) * room;
        d->y[k] = d->x[k] + room;
    }
    d->spread = memory + 6 * room;
    for (size_t i = 0; i < p->count[quantity]; ++i) {
        const piece *here = &p->list[quantity][i];
        const int k = here->stable ? 0 : 1;
        for (int end = 0; end < 3; ++end) { /* both ends, and a gap */
            d->x[k][d->count[k]] = end < 2 ? here->x[end] : NAN;
            d->y[k][d->count[k]++] = end < 2 ? factor * here->y[end] : NAN;
        }
    }
    for (size_t i = 0; i < points->count; ++i)
        if (isfinite(points->rows[i].value[quantity])) {
            d->x[2][d->count[2]] = points->rows[i].frequency;
            d->y[2][d->count[2]] = factor * points->rows[i].value[quantity];
            d->spread[d->count[2]++] = factor * points->rows[i].error[quantity];
        }
    return FST_OK;
}

static void style_panel(panel_data *d, int quantity, fst_chart_panel *panel)
{
    static const char *const labels[] = {"mean r (mm)", "deviation of r (mm)", "bead frequency (Hz)"};
    static const char *const titles[] = {"model", "model, unstable", "measured"};
    static const fst_colour colours[] = {FST_COLOUR_BLUE, FST_COLOUR_GREY, FST_COLOUR_VERMILION};
    static const fst_curve_style styles[] = {FST_CURVE_LINE, FST_CURVE_DASHED, FST_CURVE_ERRORS};
    for (int k = 0; k < 3; ++k)
        if (d->count[k] > 0)
            d->curves[d->curve_count++] = (fst_chart_curve){.title = titles[k],
                                                            .x = d->x[k],
                                                            .y = d->y[k],
                                                            .count = d->count[k],
                                                            .colour = colours[k],
                                                            .style = styles[k],
                                                            .spread = k == 2 ? d->spread : NULL};
    *panel = (fst_chart_panel){.left_label = labels[quantity],
                               .low = NAN,
                               .high = NAN,
                               .curves = d->curves,
                               .curve_count = d->curve_count};
}

static fst_status draw(const pieces *p, const fst_points *points, const char *out, const fst_points_fit *fit,
                       fst_error *error)
{
    panel_data data[FST_MEASURED_COUNT];
    fst_chart_panel panels[FST_MEASURED_COUNT];
    char about[128];
    int shown = 0;
    double low = INFINITY, high = -INFINITY;
    fst_status status = FST_OK;
    for (int q = 0; q < FST_MEASURED_COUNT && status == FST_OK; ++q) {
        status = fill_panel(&data[shown], p, points, q, error);
        if (status != FST_OK)
            break;
        if (data[shown].count[2] == 0) { /* nothing was measured of it */
            free(data[shown].x[0]);
            continue;
        }
        style_panel(&data[shown], q, &panels[shown]);
        ++shown;
        for (size_t i = 0; i < p->count[q]; ++i) {
            low = fmin(low, fmin(p->list[q][i].x[0], p->list[q][i].x[1]));
            high = fmax(high, fmax(p->list[q][i].x[0], p->list[q][i].x[1]));
        }
    }
    for (size_t i = 0; i < points->count; ++i) {
        low = fmin(low, points->rows[i].frequency);
        high = fmax(high, points->rows[i].frequency);
    }
    const double margin = 0.02 * (high - low) + 1e-3;
    (void)snprintf(about, sizeof about, "χ² = %.4g of %d measured numbers%s", fit->chi2, fit->counted,
                   fit->counted < fit->all ? ", where there is a stable curve" : "");
    const fst_chart chart = {.title = "Measured points over the computed curves",
                             .about = about,
                             .x_label = "drive frequency (Hz)",
                             .x_low = low - margin,
                             .x_high = high + margin,
                             .panels = panels,
                             .panel_count = shown};
    if (status == FST_OK)
        status = fst_figure_chart(out, &chart, error);
    for (int i = 0; i < shown; ++i)
        free(data[i].x[0]);
    return status;
}

fst_status fst_figure_points(const char *results, const char *points_path, const char *out, fst_points_fit *fit,
                             fst_error *error)
{
    pieces p = {.room = 0};
    fst_points points = {0};
    fst_points_fit found = {0.0, 0, 0};
    scaled by_scale = {0.0, 0.0};
    int is_sweep = 0;
    fst_status status = fst_points_read(points_path, &points, error);
    if (status == FST_OK)
        status = fst_is_sweep(results, &is_sweep, error);
    if (status == FST_OK)
        status = is_sweep ? take_sweep(results, &p, error) : take_branch(results, &p, error);
    for (int q = 0; q < FST_MEASURED_COUNT && status == FST_OK; ++q)
        add_chi2(&p, &points, q, &by_scale, &found);
    found.chi2 -= by_scale.product * by_scale.product / (1.0 + by_scale.square);
    if (status == FST_OK && found.all == 0)
        status = fst_fail(error, FST_BAD_INPUT, points_path, "this table has no measured number");
    if (status == FST_OK)
        status = draw(&p, &points, out, &found, error);
    if (status == FST_OK && fit)
        *fit = found;
    free_pieces(&p);
    fst_points_free(&points);
    return status;
}
