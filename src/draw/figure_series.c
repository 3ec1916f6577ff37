/* figure_series.c - any columns of a trajectory: against time, on the Poincare section, and over a ramp. */
#include "draw/figure_trajectory.h"

#include <math.h>

#include "base/constants.h"
#include "base/error.h"
#include "draw/view.h"

enum {
    PARTS = 8,        /* the most pieces of the smooth curve between two samples */
    ENOUGH = 1200,    /* about as many points as a smooth curve needs */
    WINDOWS = 150,    /* of a ramp, over each of which a mean is drawn */
    MANY_DOTS = 200,  /* more dots than these are small ones */
    ORBIT_PERIODS = 6 /* of the drive, of a closed orbit about its section */
};

/* The columns that a figure shows. */
typedef struct chosen {
    int count;
    const double *values[FST_FIGURE_KEYS];
    const fst_column_info *info[FST_FIGURE_KEYS];
    fst_quantity shown[FST_FIGURE_KEYS];
} chosen;

static fst_status choose(const fst_view *view, const fst_figure_options *options, const char *first,
                         const char *second, chosen *c, fst_error *error)
{
    const char *usual[] = {first, second};
    fst_status status = FST_OK;
    c->count = 0;
    if (options->colour)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.colour",
                        "figures of time, sections and ramps have no colour scale");
    for (int i = 0; i < FST_FIGURE_KEYS && status == FST_OK; ++i) {
        const char *key = options->keys[0] ? options->keys[i] : i < 2 ? usual[i] : NULL;
        if (!key)
            break;
        status = fst_view_column_for(view, "fst_figure_options.keys", key, &c->values[i], &c->info[i], error);
        if (status == FST_OK)
            c->shown[c->count++] = fst_view_quantity(view, c->info[i]);
    }
    return status;
}

static fst_status no_memory(size_t rows, fst_error *error)
{
    return fst_fail(error, FST_NO_MEMORY, "fst_figure_trajectory", "no memory for %zu samples", rows);
}

/* Give a chart its title, the line below it, the label of its abscissa and panels with their ordinates' labels.  0: no
 * memory. */
static int dress(fst_chart *chart, const fst_view *view, const char *title, const char *about,
                 const char *x_label, fst_chart_panel *panels, const chosen *c, int first)
{
    chart->title = fst_chart_text(chart, view->title ? view->title : title);
    chart->about = fst_chart_text(chart, about);
    chart->scene = fst_chart_scene(chart, &view->table->params);
    chart->x_label = fst_chart_text(chart, x_label);
    chart->panels = panels;
    chart->panel_count = c->count - first;
    int good = chart->title && chart->about && chart->x_label;
    for (int k = 0; k < chart->panel_count && good; ++k)
        good = (panels[k].left_label = fst_chart_text(chart, c->shown[first + k].label)) != NULL;
    return good;
}

/* A range of values with room about it that is at least `least`. */
static void range_of(const double *values, size_t count, double least, double *low, double *high)
{
    *low = INFINITY;
    *high = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        *low = fmin(*low, values[i]);
        *high = fmax(*high, values[i]);
    }
    const double span = *high - *low, usual = 1.12 * span;
    least = fmax(least, 1e-9 * fmax(fabs(*low), fabs(*high)) + 1e-12);
    if (span == 0.0) /* a constant: its place on the scale, not its last digit */
        least = fmax(least, *low == 0.0 ? 2.0 : 0.2 * fabs(*low));
    const double more = 0.5 * ((usual > least ? usual : least) - span);
    *low -= more;
    *high += more;
}

/* ------------------------------------------------------------------ time */

/* Put one column against the time since `begin`; returns the number of points. */
static size_t put_series(const fst_view *view, const chosen *c, int k, const double *t, double begin,
                         double time, double *memory, double *x, double *y)
{
    const size_t rows = view->last - view->first;
    for (size_t i = 0; i < rows; ++i) {
        memory[i] = time * (t[view->first + i] - begin);
        memory[rows + i] = c->shown[k].factor * c->values[k][view->first + i];
    }
    /* Dry friction makes corners, which are not a fault of the drawing. */
    const size_t wanted = view->table->params.friction_law == FST_FRICTION_COULOMB ? 1 : 1 + ENOUGH / rows;
    const int parts = wanted < PARTS ? (int)wanted : PARTS;
    return fst_smooth(memory, memory + rows, rows, parts, memory[rows - 1] - memory[0], INFINITY, x, y);
}

static fst_status fill_time(const fst_view *view, const chosen *c, int from_zero, fst_chart *chart,
                            fst_error *error)
{
    const double *t;
    const fst_column_info *info;
    fst_status status = fst_view_column(view, "t", &t, &info, error);
    const size_t rows = view->last - view->first, room = PARTS * rows;
    double *memory = fst_chart_keep(chart, (2 * rows + 2 * room * (size_t)c->count) * sizeof *memory);
    fst_chart_curve *curves = fst_chart_keep(chart, FST_FIGURE_KEYS * sizeof *curves);
    fst_chart_panel *panels = fst_chart_keep(chart, FST_FIGURE_KEYS * sizeof *panels);
    if (status == FST_OK && !(memory && curves && panels))
        status = no_memory(rows, error);
    if (status != FST_OK)
        return status;
    const fst_quantity time = fst_view_quantity(view, info);
    const double begin = from_zero ? t[view->first] : 0.0;
    for (int k = 0; k < c->count; ++k) {
        double *x = memory + 2 * rows + 2 * room * (size_t)k, *y = x + room;
        const size_t count = put_series(view, c, k, t, begin, time.factor, memory, x, y);
        curves[k] = (fst_chart_curve){
            .x = x, .y = y, .count = count, .colour = FST_COLOUR_BLUE, .style = FST_CURVE_LINE};
        panels[k] = (fst_chart_panel){.low = NAN, .high = NAN, .curves = &curves[k], .curve_count = 1};
        range_of(y, count, 0.0, &panels[k].low, &panels[k].high);
    }
    chart->x_low = time.factor * (t[view->first] - begin);
    chart->x_high = time.factor * (t[view->last - 1] - begin);
    chart->height = c->count > 3 ? 140 : 0;
    return dress(chart, view, "The motion against time", view->about, time.label, panels, c, 0)
               ? FST_OK
               : no_memory(rows, error);
}

fst_status fst_chart_time(const fst_table *table, const fst_figure_options *options, int from_zero,
                          fst_chart *chart, fst_error *error)
{
    fst_view view;
    chosen c;
    fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK)
        status = choose(&view, options, "r", "n_z", &c, error);
    return status == FST_OK ? fill_time(&view, &c, from_zero, chart, error) : status;
}

/* ------------------------------------------------------------------ the Poincare section */

/* The cubic through four samples, `part` of the way from the second to the third. */
static double cubic(const double *values, double part)
{
    const double a = part + 1.0, b = part, c = part - 1.0, d = part - 2.0;
    return -b * c * d / 6.0 * values[0] + a * c * d / 2.0 * values[1] - a * b * d / 2.0 * values[2] +
           a * b * c / 6.0 * values[3];
}

/* Where Phi passes `angle` downwards between the second and the third of four samples. */
static double passing(const double *bead_angle, double angle)
{
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        *(cubic(bead_angle, middle) > angle ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

/* Put both columns where Phi passes pi/2 and whole turns of it; returns how often it does. */
static size_t put_section(const fst_view *view, const chosen *c, const double *bead_angle, double *x, double *y)
{
    size_t count = 0;
    for (size_t row = view->first + 1; row + 2 < view->last; ++row) {
        const double turn = floor((bead_angle[row] - 0.5 * FST_PI) / FST_TWO_PI);
        const double angle = 0.5 * FST_PI + FST_TWO_PI * turn;
        if (!(bead_angle[row] >= angle && bead_angle[row + 1] < angle))
            continue;
        const double part = passing(bead_angle + row - 1, angle);
        x[count] = c->shown[0].factor * cubic(c->values[0] + row - 1, part);
        y[count++] = c->shown[1].factor * cubic(c->values[1] + row - 1, part);
    }
    return count;
}

/* Points within a fiftieth of the whole motion look like one. */
static double least_span(const fst_view *view, const chosen *c, int k)
{
    double least, greatest;
    fst_view_range(view, c->values[k], &least, &greatest);
    return 0.02 * fabs(c->shown[k].factor) * (greatest - least);
}

static int is_one_point(const fst_view *view, const chosen *c, int k, const double *values, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; ++i) {
        low = fmin(low, values[i]);
        high = fmax(high, values[i]);
    }
    return high - low <= least_span(view, c, k);
}

/* The motion about the section, for as long as a figure of the moment shows it; returns how many samples. */
static size_t put_motion(const fst_view *view, const chosen *c, double *x, double *y)
{
    const double *turns;
    size_t count = 0;
    if (fst_view_columns(view, NULL, "drive_turns", &turns, NULL) != FST_OK)
        return 0;
    const double from = turns[view->first];
    for (size_t row = view->first; row < view->last && turns[row] - from <= ORBIT_PERIODS; ++row, ++count) {
        x[count] = c->shown[0].factor * c->values[0][row];
        y[count] = c->shown[1].factor * c->values[1][row];
    }
    return count;
}

/* The points of a closed orbit all lie at one place, which means nothing without the orbit about it.  `motion` has
 * room for the samples twice. */
static fst_status fill_section(const fst_view *view, const chosen *c, const double *x, const double *y,
                               size_t count, double *motion, fst_chart *chart, fst_error *error)
{
    char about[320];
    const int one = is_one_point(view, c, 0, x, count) && is_one_point(view, c, 1, y, count);
    double *const motion_x = motion, *const motion_y = motion + (view->last - view->first);
    const size_t drawn = one ? put_motion(view, c, motion_x, motion_y) : 0;
    fst_chart_curve *curves = fst_chart_keep(chart, 2 * sizeof *curves);
    fst_chart_panel *panel = fst_chart_keep(chart, sizeof *panel);
    if (!curves || !panel)
        return no_memory(count, error);
    curves[0] = (fst_chart_curve){.title = one ? "the passages of Φ = 90°" : NULL,
                                  .x = x,
                                  .y = y,
                                  .count = count,
                                  .colour = FST_COLOUR_BLUE,
                                  .style = count > MANY_DOTS && !one ? FST_CURVE_DOTS : FST_CURVE_POINTS};
    curves[1] = (fst_chart_curve){.title = "the motion between them",
                                  .x = motion_x,
                                  .y = motion_y,
                                  .count = drawn,
                                  .colour = FST_COLOUR_GREY,
                                  .style = FST_CURVE_THIN};
    *panel = (fst_chart_panel){.curves = curves, .curve_count = one ? 2 : 1};
    range_of(one ? motion_x : x, one ? drawn : count, least_span(view, c, 0), &chart->x_low, &chart->x_high);
    range_of(one ? motion_y : y, one ? drawn : count, least_span(view, c, 1), &panel->low, &panel->high);
    (void)snprintf(about, sizeof about,
                   one ? "%.200s; all %zu passages at one place: the orbit is closed"
                       : "%.200s; a point for each of %zu passages",
                   view->about, count);
    chart->height = 330;
    return dress(chart, view, "Poincaré section at Φ = 90°, passed downwards", about, c->shown[0].label, panel,
                 c, 1)
               ? FST_OK
               : no_memory(count, error);
}

fst_status fst_chart_section(const fst_table *table, const fst_figure_options *options, fst_chart *chart,
                             fst_error *error)
{
    fst_view view;
    chosen c;
    const double *bead_angle = NULL;
    fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK)
        status = choose(&view, options, "r", "n_z", &c, error);
    if (status == FST_OK && c.count != 2)
        status = fst_fail(error, FST_BAD_INPUT, "fst_figure_options.keys",
                          "a section shows two columns, one against the other, not %d", c.count);
    if (status == FST_OK)
        status = fst_view_columns(&view, error, "Phi", &bead_angle, NULL);
    if (status != FST_OK)
        return status;
    const size_t rows = view.last - view.first;
    double *memory = fst_chart_keep(chart, 4 * rows * sizeof *memory);
    if (!memory)
        return no_memory(rows, error);
    const size_t count = put_section(&view, &c, bead_angle, memory, memory + rows);
    return count > 0
               ? fill_section(&view, &c, memory, memory + rows, count, memory + 2 * rows, chart, error)
               : fst_fail(
                     error, FST_BAD_INPUT, "fst_figure_options.kind",
                     "the bead's angle Phi against the magnet never passes 90 degrees downwards in the part "
                     "shown, so that there is no section: figures of time show such a motion");
}

/* ------------------------------------------------------------------ ramps */

/* Means, least and greatest values over windows of the drive. */
typedef struct windows {
    size_t count;
    double *drive, *mean[FST_FIGURE_KEYS], *low[FST_FIGURE_KEYS], *high[FST_FIGURE_KEYS];
} windows;

static int make_windows(fst_chart *chart, windows *w, int keys)
{
    double *memory = fst_chart_keep(chart, (size_t)(1 + 3 * keys) * (WINDOWS + 1) * sizeof *memory);
    w->count = 0;
    w->drive = memory;
    for (int k = 0; k < keys && memory; ++k) {
        w->mean[k] = memory + (size_t)(1 + 3 * k) * (WINDOWS + 1);
        w->low[k] = w->mean[k] + WINDOWS + 1;
        w->high[k] = w->low[k] + WINDOWS + 1;
    }
    return memory != NULL;
}

static void put_window(const chosen *c, const double *omega, double factor, size_t from, size_t to, windows *w)
{
    const size_t i = w->count++;
    w->drive[i] = 0.0;
    for (size_t row = from; row < to; ++row)
        w->drive[i] += factor * omega[row] / (double)(to - from);
    for (int k = 0; k < c->count; ++k) {
        double sum = 0.0, low = INFINITY, high = -INFINITY;
        for (size_t row = from; row < to; ++row) {
            const double value = c->shown[k].factor * c->values[k][row];
            sum += value;
            low = fmin(low, value);
            high = fmax(high, value);
        }
        w->mean[k][i] = sum / (double)(to - from);
        w->low[k][i] = low;
        w->high[k][i] = high;
    }
}

/* A window ends where Phi has made a whole turn, because the motion repeats then, or where it makes none. */
static void put_windows(const fst_view *view, const chosen *c, const double *turns, const double *bead_angle,
                        const double *omega, double factor, windows *w)
{
    const double all = turns[view->last - 1] - turns[view->first];
    const double each = fmax(2.0, all / WINDOWS);
    size_t from = view->first;
    for (size_t row = view->first + 1; row < view->last && w->count < WINDOWS; ++row) {
        const int whole = floor(bead_angle[row] / FST_TWO_PI) != floor(bead_angle[row - 1] / FST_TWO_PI);
        const double long_enough = turns[row] - turns[from] - each * (1.0 - 1e-9);
        if (long_enough >= 0.0 && (whole || long_enough > 2.0)) {
            put_window(c, omega, factor, from, row, w);
            from = row;
        }
    }
}

static fst_status fill_ramp(const fst_view *view, const chosen *c, const windows *w, const char *x_label,
                            fst_chart *chart, fst_error *error)
{
    fst_chart_curve *curves = fst_chart_keep(chart, 3 * FST_FIGURE_KEYS * sizeof *curves);
    fst_chart_panel *panels = fst_chart_keep(chart, FST_FIGURE_KEYS * sizeof *panels);
    if (!curves || !panels)
        return no_memory(w->count, error);
    for (int k = 0; k < c->count; ++k) {
        const double *const values[3] = {w->low[k], w->high[k], w->mean[k]};
        for (int i = 0; i < 3; ++i)
            curves[3 * k + i] =
                (fst_chart_curve){.title = i < 2 ? "least and greatest" : "mean over whole turns of Φ",
                                  .x = w->drive,
                                  .y = values[i],
                                  .count = w->count,
                                  .colour = i < 2 ? FST_COLOUR_SKY : FST_COLOUR_BLUE,
                                  .style = i < 2 ? FST_CURVE_THIN : FST_CURVE_LINE};
        panels[k] = (fst_chart_panel){.low = NAN, .high = NAN, .curves = &curves[3 * k], .curve_count = 3};
    }
    chart->x_low = INFINITY;
    chart->x_high = -INFINITY;
    for (size_t i = 0; i < w->count; ++i) {
        chart->x_low = fmin(chart->x_low, w->drive[i]);
        chart->x_high = fmax(chart->x_high, w->drive[i]);
    }
    return dress(chart, view, "The motion on a ramp of the drive", view->about, x_label, panels, c, 0)
               ? FST_OK
               : no_memory(w->count, error);
}

fst_status fst_chart_ramp(const fst_table *table, const fst_figure_options *options, fst_chart *chart,
                          fst_error *error)
{
    fst_view view;
    chosen c;
    windows w;
    const double *turns = NULL, *omega = NULL, *bead_angle = NULL;
    const fst_column_info *info = NULL;
    fst_status status = fst_view_of(&view, table, options, error);
    if (status == FST_OK)
        status = choose(&view, options, "r", NULL, &c, error);
    if (status == FST_OK)
        status = fst_view_columns(&view, error, "drive_turns", &turns, "Phi", &bead_angle, NULL);
    if (status == FST_OK)
        status = fst_view_column(&view, "omega", &omega, &info, error);
    if (status == FST_OK && !(fabs(view.omega - view.first_omega) > 1e-9 * view.omega))
        status = fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                          "the drive is the same in all that is shown: this is not a ramp");
    if (status == FST_OK && !make_windows(chart, &w, c.count))
        status = no_memory(view.last - view.first, error);
    if (status != FST_OK)
        return status;
    const fst_quantity drive = fst_view_quantity(&view, info);
    put_windows(&view, &c, turns, bead_angle, omega, drive.factor, &w);
    if (w.count < 2)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_figure_options.kind",
            "what is shown of the ramp is too short for two means over whole turns of Phi, of at least two "
            "drive periods each: the kinds path and time show it");
    return fill_ramp(&view, &c, &w, drive.label, chart, error);
}
