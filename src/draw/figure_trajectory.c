/* figure_trajectory.c - fst_figure_trajectory(): a figure of a trajectory by its kind. */
#include "draw/figure_trajectory.h"

#include <string.h>

#include "base/error.h"

enum { OPTIONS_COOKIE = 0x46494721 };

#define NO_COLUMNS "only figures of time, sections and ramps show columns of choice"

fst_figure_options fst_default_figure_options(void)
{
    return (fst_figure_options){.cookie = OPTIONS_COOKIE,
                                .kind = FST_FIGURE_PATH,
                                .arrows = 1,
                                .from = NAN,
                                .to = NAN,
                                .zoom = {NAN, NAN, NAN, NAN}};
}

/* The path as a bare curve on a square, for charts of several. */
static fst_status chart_path(const fst_table *table, const fst_figure_options *options, fst_chart *chart,
                             fst_error *error)
{
    fst_path_picture path;
    if (options->keys[0])
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.keys", NO_COLUMNS);
    fst_status status = fst_path_picture_of(table, options, &path, error);
    if (status != FST_OK)
        return status;
    double *x = fst_chart_keep(chart, 2 * path.count * sizeof *x), *y = x + path.count;
    fst_chart_curve *curve = fst_chart_keep(chart, sizeof *curve);
    fst_chart_panel *panel = fst_chart_keep(chart, sizeof *panel);
    if (x && curve && panel) {
        memcpy(x, path.x, path.count * sizeof *x);
        memcpy(y, path.y, path.count * sizeof *y);
        *curve = (fst_chart_curve){
            .x = x, .y = y, .count = path.count, .colour = FST_COLOUR_BLUE, .style = FST_CURVE_LINE};
        *panel = (fst_chart_panel){.left_label = fst_chart_text(chart, path.y_label),
                                   .low = path.box[2],
                                   .high = path.box[3],
                                   .curves = curve,
                                   .curve_count = 1};
        chart->title = fst_chart_text(chart, options->title ? options->title : path.title);
        chart->about = fst_chart_text(chart, path.about);
        chart->x_label = fst_chart_text(chart, path.x_label);
        chart->x_low = path.box[0];
        chart->x_high = path.box[1];
        chart->square = 1;
        chart->panels = panel;
        chart->panel_count = 1;
    }
    if (!x || !curve || !panel || !panel->left_label || !chart->title || !chart->about || !chart->x_label)
        status =
            fst_fail(error, FST_NO_MEMORY, "fst_figure_trajectory", "no memory for %zu places", path.count);
    fst_path_picture_free(&path);
    return status;
}

fst_status fst_chart_of_trajectory(const fst_table *table, const fst_figure_options *options, int from_zero,
                                   fst_chart **chart, fst_error *error)
{
    fst_status status = FST_NO_MEMORY;
    *chart = fst_chart_new();
    if (!*chart)
        return fst_fail(error, status, "fst_figure_trajectory", "no memory for a figure");
    switch (options->kind) {
    case FST_FIGURE_PATH:
        status = chart_path(table, options, *chart, error);
        break;
    case FST_FIGURE_TIME:
        status = fst_chart_time(table, options, from_zero, *chart, error);
        break;
    case FST_FIGURE_SECTION:
        status = fst_chart_section(table, options, *chart, error);
        break;
    case FST_FIGURE_RAMP:
        status = fst_chart_ramp(table, options, *chart, error);
        break;
    default:
        status = fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                          "several trajectories in one figure: of the kinds path, time, section and ramp");
    }
    if (status == FST_OK)
        return FST_OK;
    fst_chart_free(*chart);
    *chart = NULL;
    return status;
}

static fst_status draw_chart(const fst_table *table, const fst_figure_options *options, const char *out,
                             fst_error *error)
{
    fst_chart *chart;
    fst_status status = fst_chart_of_trajectory(table, options, 0, &chart, error);
    if (status == FST_OK)
        status = fst_figure_chart_as(out, chart, options->title, options->size, error);
    fst_chart_free(chart);
    return status;
}

fst_status fst_figure_trajectory(const fst_table *table, const char *out, const fst_figure_options *options,
                                 fst_error *error)
{
    fst_figure_options defaults = fst_default_figure_options();
    if (!options)
        options = &defaults;
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_trajectory",
                        "the options were not made by fst_default_figure_options()");
    const int chooses = options->kind == FST_FIGURE_TIME || options->kind == FST_FIGURE_SECTION ||
                        options->kind == FST_FIGURE_RAMP;
    if (options->keys[0] && !chooses)
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.keys", NO_COLUMNS);
    switch (options->kind) {
    case FST_FIGURE_PATH:
        return fst_figure_path(table, out, options, error);
    case FST_FIGURE_LOCAL_N:
        return fst_figure_local_n(table, out, options, error);
    case FST_FIGURE_RADIUS_FIELD:
        return fst_figure_radius_field(table, out, options, error);
    case FST_FIGURE_TIME:
    case FST_FIGURE_SECTION:
    case FST_FIGURE_RAMP:
        return draw_chart(table, options, out, error);
    case FST_FIGURE_LAG:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of the lag is of a bead in a world, and this one is on a plate: the kind "
                        "time shows its angles");
    case FST_FIGURE_GROUPS:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "a figure of groups is of several beads, and this trajectory is of one");
    case FST_FIGURE_CURVES:
    case FST_FIGURE_MAP:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.kind",
                        "curves and maps are of sweeps, and this is a trajectory");
    default:
        return fst_fail(error, FST_BAD_INPUT, "fst_figure_trajectory", "no such kind of figure");
    }
}
