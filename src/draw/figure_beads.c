/* figure_beads.c - the paths of several beads over the plate as a chart: each in its colour, the beads at the end to
 * scale with their moments, contacts, and the magnet; unless the options say, of the last periods to the end. */
#include "draw/figure_beads.h"

#include "base/constants.h"
#include "base/error.h"
#include "base/grow.h"
#include "draw/chart.h"

#include <stdlib.h>
#include <string.h>

enum {
    CURVES =
        FST_PICTURE_LINES + 3 * FST_BEADS_MOST + 4, /* magnet; paths, discs and rims of each colour; marks */
    EDGES = 64,                                     /* of a disc */
    MANY_MARKS = 200,                               /* more marks than these are dots */
    SHARED = 32                                     /* beads that share the points of a path */
};

/* So many periods of the drive are shown, unless the options say. */
static const double MOST_PERIODS = 40;

/* A chart being made. */
typedef struct painting {
    const fst_beads_table *table;
    size_t first, last; /* rows shown: first <= row < last */
    int from_magnet, count;
    double length;    /* l in the figure's unit */
    char when[32];    /* the last row is */
    char periods[64]; /* what is shown of a trajectory, where that is not all */
    fst_chart *chart;
    fst_chart_curve *curves;
} painting;

/* Points that grow in number, of which a curve is made. */
typedef struct pen {
    double *x, *y, *spread;
    size_t count;
    int failed;
} pen;

static void put_wide(pen *to, double x, double y, double spread)
{
    if (to->failed || !fst_grow(&to->x, to->count, sizeof *to->x) ||
        !fst_grow(&to->y, to->count, sizeof *to->y) || !fst_grow(&to->spread, to->count, sizeof *to->spread)) {
        to->failed = 1;
        return;
    }
    to->x[to->count] = x;
    to->y[to->count] = y;
    to->spread[to->count++] = spread;
}

static void put(pen *to, double x, double y)
{
    put_wide(to, x, y, 0.0);
}

/* Make a curve of the points, which the chart keeps; 0: no memory. */
static int end_curve(painting *p, pen *from, fst_chart_curve curve)
{
    const size_t size = from->count * sizeof(double);
    double *kept = from->failed ? NULL : fst_chart_keep(p->chart, 3 * size + 1);
    if (kept && from->count) {
        memcpy(kept, from->x, size);
        memcpy(kept + from->count, from->y, size);
        memcpy(kept + 2 * from->count, from->spread, size);
        curve.x = kept;
        curve.y = kept + from->count;
        curve.spread = curve.style == FST_CURVE_BAND ? kept + 2 * from->count : NULL;
        curve.count = from->count;
        p->curves[p->count++] = curve;
    }
    free(from->x);
    free(from->y);
    free(from->spread);
    *from = (pen){.x = NULL};
    return kept != NULL;
}

static double period_of(const fst_beads_table *table, size_t row)
{
    return fst_drive_periods(&table->scene, table->t[row], table->drive_turns[row]);
}

/* Find the rows that are shown. */
static fst_status choose_part(const fst_beads_table *table, const fst_figure_options *options,
                              fst_figure_part *part, fst_error *error)
{
    fst_figure_options shown = *options;
    fst_table whole;
    if (isnan(shown.to))
        shown.to = INFINITY;
    fst_status status = fst_beads_table_alone(table, 0, 0, table->rows, &whole, error);
    if (status == FST_OK)
        status = fst_figure_part_of(&whole, &shown, part, error);
    if (status == FST_OK && isnan(shown.from) && table->scene.drive_waveform == FST_WAVEFORM_STEADY) {
        shown.from = fmax(period_of(table, part->first), period_of(table, part->last - 1) - MOST_PERIODS);
        status = fst_figure_part_of(&whole, &shown, part, error);
    }
    fst_table_free(&whole);
    return status;
}

/* Say which part of the trajectory it is. */
static void tell_part(painting *p)
{
    const char *word = p->table->scene.drive_waveform == FST_WAVEFORM_STEADY ? "turn" : "period";
    const double from = period_of(p->table, p->first), to = period_of(p->table, p->last - 1),
                 end = period_of(p->table, p->table->rows - 1);
    if (p->last < p->table->rows)
        (void)snprintf(p->when, sizeof p->when, "at %s %.4g", word, to);
    else
        (void)snprintf(p->when, sizeof p->when, "at the end");
    if (p->first > 0 || p->last < p->table->rows)
        (void)snprintf(p->periods, sizeof p->periods, ", %ss %.4g to %.4g of %.4g", word, from, to, end);
}

/* Where a bead is seen in a row, in the figure's unit. */
static void place_of(const painting *p, size_t row, int bead, double place[2])
{
    double at[3];
    fst_beads_table_vector(p->table, row, bead, 0, p->from_magnet, at);
    place[0] = at[0] * p->length;
    place[1] = at[1] * p->length;
}

/* ------------------------------------------------------------------ paths and magnet */

static fst_colour colour_of_line(const fst_picture_line *line)
{
    for (int i = 0; i < FST_COLOUR_COUNT; ++i)
        if (strcmp(fst_colour_code((fst_colour)i), line->colour) == 0)
            return (fst_colour)i;
    return FST_COLOUR_GREY;
}

/* The magnet as the picture of a bead has it, and the words that are the same for all. */
static int put_magnet(painting *p, const fst_path_picture *picture)
{
    int good = 1;
    for (int i = 0; i < picture->line_count && good; ++i) {
        const fst_picture_line *line = &picture->lines[i];
        pen to = {.x = NULL};
        for (size_t k = 0; k < line->count; ++k)
            put(&to, line->x[k], line->y[k]);
        const char *words = fst_chart_text(p->chart, line->words);
        good = words && end_curve(p, &to, (fst_chart_curve){.title = words, .colour = colour_of_line(line)});
    }
    p->chart->x_label = fst_chart_text(p->chart, picture->x_label);
    return good && p->chart->x_label;
}

/* Add the path of a bead to its colour's, and widen the square by it. */
static fst_status add_path(painting *p, int bead, const fst_figure_options *options, pen *to, double *reach,
                           const char **y_label, fst_error *error)
{
    fst_table alone;
    fst_path_picture picture = {.count = 0};
    fst_figure_options whole = *options;
    whole.arrows = 0;
    whole.from = -INFINITY;
    whole.to = INFINITY;
    for (int i = 0; i < 4; ++i)
        whole.zoom[i] = NAN;
    fst_status status = fst_beads_table_alone(p->table, bead, p->first, p->last, &alone, error);
    if (status == FST_OK)
        status = fst_path_picture_of(&alone, &whole, &picture, error);
    if (status == FST_OK && bead == 0 &&
        !(put_magnet(p, &picture) && (*y_label = fst_chart_text(p->chart, picture.y_label))))
        status = fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    const size_t step = 1 + (size_t)p->table->count / SHARED;
    for (size_t i = 0; i < picture.count; i += step)
        put(to, picture.x[i], picture.y[i]);
    put(to, NAN, NAN);
    *reach = fmax(*reach, status == FST_OK ? picture.box[1] : 0.0);
    fst_path_picture_free(&picture);
    fst_table_free(&alone);
    return status;
}

static fst_status put_paths(painting *p, const fst_figure_options *options, double *reach, const char **y_label,
                            fst_error *error)
{
    const int beads = p->table->count;
    fst_status status = FST_OK;
    for (int first = 0; first < beads && first < FST_BEADS_MOST && status == FST_OK; ++first) {
        pen to = {.x = NULL};
        char words[32];
        (void)snprintf(words, sizeof words, "bead %d", first + 1);
        const char *title = beads > FST_BEADS_MOST ? NULL : fst_chart_text(p->chart, words);
        for (int bead = first; bead < beads && status == FST_OK; bead += FST_BEADS_MOST)
            status = add_path(p, bead, options, &to, reach, y_label, error);
        if (!end_curve(p, &to, (fst_chart_curve){.title = title, .colour = fst_bead_colour(first)}) &&
            status == FST_OK)
            status = fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    }
    return status;
}

/* ------------------------------------------------------------------ beads at the end */

/* The moment's horizontal part as an arrow through the bead, as long as the bead where it lies flat. */
static void put_moment(const painting *p, int bead, const double at[2], double radius, pen *to)
{
    double n[3];
    fst_beads_table_vector(p->table, p->last - 1, bead, 6, p->from_magnet, n);
    const double x = 0.85 * radius * n[0], y = 0.85 * radius * n[1];
    const double tip[2] = {at[0] + x, at[1] + y};
    put(to, at[0] - x, at[1] - y);
    put(to, tip[0], tip[1]);
    put(to, NAN, NAN);
    put(to, tip[0] - 0.6 * x - 0.4 * y, tip[1] - 0.6 * y + 0.4 * x);
    put(to, tip[0], tip[1]);
    put(to, tip[0] - 0.6 * x + 0.4 * y, tip[1] - 0.6 * y - 0.4 * x);
    put(to, NAN, NAN);
}

/* Discs, rims and moments of the beads where they are at the end. */
static int put_beads(painting *p, double *reach)
{
    const int beads = p->table->count;
    pen arrows = {.x = NULL};
    char words[80];
    int good = 1;
    for (int first = 0; first < beads && first < FST_BEADS_MOST && good; ++first) {
        pen disc = {.x = NULL}, rim = {.x = NULL};
        for (int bead = first; bead < beads; bead += FST_BEADS_MOST) {
            const double radius = p->table->radii[bead] * p->length;
            double at[2];
            place_of(p, p->last - 1, bead, at);
            for (int i = 0; i <= EDGES; ++i) {
                const double half = FST_PI * i / EDGES, whole = FST_TWO_PI * i / EDGES;
                put_wide(&disc, at[0] - radius * cos(half), at[1], radius * sin(half));
                put(&rim, at[0] + radius * cos(whole), at[1] + radius * sin(whole));
            }
            put(&disc, NAN, NAN);
            put(&rim, NAN, NAN);
            put_moment(p, bead, at, radius, &arrows);
            *reach = fmax(*reach, 1.03 * (fmax(fabs(at[0]), fabs(at[1])) + radius));
        }
        const fst_colour colour = fst_bead_colour(first);
        good = end_curve(p, &disc, (fst_chart_curve){.colour = colour, .style = FST_CURVE_BAND}) &
               end_curve(p, &rim, (fst_chart_curve){.colour = colour, .style = FST_CURVE_THIN});
    }
    (void)snprintf(words, sizeof words, "horizontal parts of the moments %s", p->when);
    return end_curve(p, &arrows,
                     (fst_chart_curve){.title = fst_chart_text(p->chart, words),
                                       .colour = FST_COLOUR_BLACK,
                                       .style = FST_CURVE_THIN}) &&
           good;
}

/* ------------------------------------------------------------------ contacts */

/* Mark where the pairs touch in `row` that do not in `other`; of equal rows all. */
static void mark(const painting *p, size_t row, size_t other, pen *to)
{
    const fst_beads_table *table = p->table;
    for (size_t k = table->first[row]; k < table->first[row + 1]; ++k) {
        const int *two = table->touches[k].beads;
        double a[2], b[2];
        if (two[1] < 0 || (other != row && fst_beads_touch_in(table, other, two)))
            continue;
        const double part = table->radii[two[0]] / (table->radii[two[0]] + table->radii[two[1]]);
        place_of(p, row, two[0], a);
        place_of(p, row, two[1], b);
        put(to, a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1]));
    }
}

static int put_contacts(painting *p)
{
    pen meet = {.x = NULL}, leave = {.x = NULL}, end = {.x = NULL};
    char words[48];
    for (size_t row = p->first + 1; row < p->last; ++row) {
        mark(p, row, row - 1, &meet);
        mark(p, row - 1, row, &leave);
    }
    mark(p, p->last - 1, p->last - 1, &end);
    (void)snprintf(words, sizeof words, "contacts %s", p->when);
    const fst_curve_style style = meet.count + leave.count > MANY_MARKS ? FST_CURVE_DOTS : FST_CURVE_SIGNS;
    return end_curve(p, &meet,
                     (fst_chart_curve){.title = "two beads meet",
                                       .colour = FST_COLOUR_BLACK,
                                       .style = style,
                                       .sign = style == FST_CURVE_SIGNS ? 2 : 0}) &
           end_curve(p, &leave,
                     (fst_chart_curve){.title = "two beads part",
                                       .colour = FST_COLOUR_GREY,
                                       .style = style,
                                       .sign = style == FST_CURVE_SIGNS ? 1 : 0}) &
           end_curve(p, &end,
                     (fst_chart_curve){.title = fst_chart_text(p->chart, words),
                                       .colour = FST_COLOUR_BLACK,
                                       .style = FST_CURVE_POINTS});
}

/* ------------------------------------------------------------------ the chart */

/* The square that is shown: about the axis, or the zoom, which must not lie beside all paths. */
static fst_status choose_square(const painting *p, const double *zoom, double reach, fst_chart_panel *panel,
                                fst_error *error)
{
    double box[4] = {-reach, reach, -reach, reach};
    if (!isnan(zoom[0])) {
        const double millimetres = 1e3 * p->table->scene.magnet_half_length / p->length;
        double range[4] = {INFINITY, -INFINITY, INFINITY, -INFINITY};
        for (const fst_chart_curve *curve = p->curves; curve < p->curves + p->count; ++curve)
            for (size_t i = 0; i < curve->count && curve->style == FST_CURVE_THIN; ++i) {
                range[0] = fmin(range[0], curve->x[i] * millimetres);
                range[1] = fmax(range[1], curve->x[i] * millimetres);
                range[2] = fmin(range[2], curve->y[i] * millimetres);
                range[3] = fmax(range[3], curve->y[i] * millimetres);
            }
        if (zoom[0] > range[1] || zoom[1] < range[0] || zoom[2] > range[3] || zoom[3] < range[2])
            return fst_fail(error, FST_BAD_INPUT, "fst_figure_options.zoom",
                            "no bead is in the zoom %s, when they are within %.4g,%.4g,%.4g,%.4g (mm)", p->when,
                            range[0], range[1], range[2], range[3]);
        for (int i = 0; i < 4; ++i)
            box[i] = zoom[i] / millimetres;
    }
    p->chart->x_low = box[0];
    p->chart->x_high = box[1];
    panel->low = box[2];
    panel->high = box[3];
    return FST_OK;
}

static int put_words(painting *p, const fst_figure_options *options, const char *about)
{
    char title[96], part[512];
    const char *seen = p->from_magnet ? "as seen from the magnet" : "from above";
    if (p->table->count > 1)
        (void)snprintf(title, sizeof title, "Paths of %d beads %s", p->table->count, seen);
    else
        (void)snprintf(title, sizeof title, "Path of the bead %s", seen);
    p->chart->title = fst_chart_text(p->chart, options->title ? options->title : title);
    (void)snprintf(part, sizeof part, "%s%s", about, p->periods);
    p->chart->about = fst_chart_text(p->chart, part);
    p->chart->scene = fst_chart_scene(p->chart, &p->table->scene);
    p->chart->square = 1;
    p->chart->panel_count = 1;
    if (p->table->count > FST_BEADS_MOST)
        p->chart->remark = "colours come again after eight beads; no contacts are known";
    return p->chart->title && p->chart->about;
}

fst_status fst_chart_of_paths(const fst_beads_table *table, const fst_figure_options *options, fst_chart *chart,
                              fst_error *error)
{
    fst_figure_part part;
    double reach = 0.0;
    fst_status status = choose_part(table, options, &part, error);
    if (status != FST_OK)
        return status;
    const fst_scales scales = fst_scales_of(&table->scene);
    const char *unit;
    painting p = {.table = table,
                  .first = part.first,
                  .last = part.last,
                  .from_magnet = options->from_magnet,
                  .length = fst_unit_shown("l", part.units, &scales, &unit),
                  .chart = chart,
                  .curves = fst_chart_keep(chart, CURVES * sizeof *p.curves)};
    fst_chart_panel *panel = fst_chart_keep(chart, sizeof *panel);
    tell_part(&p);
    if (p.curves && panel)
        status = put_paths(&p, options, &reach, &panel->left_label, error);
    if (status == FST_OK && !(p.curves && panel && put_beads(&p, &reach) && put_words(&p, options, part.about)))
        status = fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    if (status == FST_OK)
        status = choose_square(&p, options->zoom, reach, panel, error);
    if (status == FST_OK && !put_contacts(&p))
        status = fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    if (status != FST_OK)
        return status;
    panel->curves = p.curves;
    panel->curve_count = p.count;
    chart->panels = panel;
    return FST_OK;
}

/* ------------------------------------------------------------------ figures */

fst_status fst_chart_of_beads(const fst_beads_table *table, const fst_figure_options *options,
                              fst_chart **chart, fst_error *error)
{
    const fst_figure_options defaults = fst_default_figure_options();
    options = options ? options : &defaults;
    *chart = NULL;
    if (options->cookie != defaults.cookie)
        return fst_fail(error, FST_BAD_INPUT, "fst_chart_of_beads",
                        "the options were not made by fst_default_figure_options()");
    fst_status (*const draw)(const fst_beads_table *, const fst_figure_options *, fst_chart *, fst_error *) =
        options->kind == FST_FIGURE_PATH     ? fst_chart_of_paths
        : options->kind == FST_FIGURE_GROUPS ? fst_chart_of_groups
        : options->kind == FST_FIGURE_LAG    ? fst_chart_of_lag
                                             : NULL;
    if (!draw)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_figure_options.kind",
            "of several beads there are figures of their path and of their groups, and of one in a world "
            "of its path and its lag");
    fst_chart *made = fst_chart_new();
    if (!made)
        return fst_fail(error, FST_NO_MEMORY, "fst_chart_of_beads", "out of memory");
    const fst_status status = draw(table, options, made, error);
    if (status == FST_OK)
        *chart = made;
    else
        fst_chart_free(made);
    return status;
}

fst_status fst_figure_beads(const fst_beads_table *table, const char *out, const fst_figure_options *options,
                            fst_error *error)
{
    const fst_figure_options usual = fst_default_figure_options();
    fst_chart *chart;
    fst_status status = fst_chart_of_beads(table, options, &chart, error);
    if (status == FST_OK)
        status = fst_figure_chart_as(out, chart, options ? options->title : NULL,
                                     (options ? *options : usual).size, error);
    fst_chart_free(chart);
    return status;
}
