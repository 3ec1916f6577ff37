/* figure_sweep_map.c - a key of a sweep over the plane of its two axes: a regime map or a heat map. */
#include "draw/figure_sweep.h"

#include "base/error.h"
#include "draw/legend.h"

#include <stdlib.h>
#include <string.h>

enum {
    MOST_CELLS = 1024,
    MOST_NAMES = FST_REGIME_COUNT,
    LEFT = 62, /* pixels about the map */
    NAMES = 108,
    RIGHT = 22,
    LEAST_FRAME = 200,
    FRAME = 320,
    AXIS = 54,
    SCALE = 72, /* for the scale of colours */
    TICS = 7    /* that point outwards */
};

/* A value of an axis and the points that have it. */
typedef struct place {
    double value;
    int64_t offset; /* what is added to the point's number */
} place;

/* An axis with its values in rising order, each once.  Cell i reaches from edges[i] to edges[i + 1]. */
typedef struct side {
    place *places;
    double *edges;
    int64_t count,
        step; /* one of every `step` values is drawn: more cells than pixels would show nothing more */
} side;

typedef struct map {
    const fst_sweep_table *table;
    const fst_sweep_slice *slice;
    const fst_sweep_axis *axes; /* of the slice: the first one goes upward, the second one to the right */
    side up, right;
    const fst_sweep_names *names; /* that colours mean; NULL: the values are numbers */
} map;

/* The points of the slice, and the value at one of them. */
static int64_t point_count(const map *m)
{
    return m->axes[0].count * m->axes[1].count;
}

static double value_of(const map *m, int64_t i)
{
    const fst_grid *grid = m->table->grid;
    return m->table
        ->values[m->slice->start + i / m->axes[1].count * fst_grid_axis_stride(grid, m->axes[0].index) +
                 i % m->axes[1].count * fst_grid_axis_stride(grid, m->axes[1].index)];
}

/* ------------------------------------------------------------------ cells */

static int by_value(const void *a, const void *b)
{
    const place *left = a, *right = b;
    if (left->value != right->value)
        return left->value < right->value ? -1 : 1;
    return (left->offset > right->offset) - (left->offset < right->offset);
}

/* The middle between two neighbours, on the scale of the figure. */
static double between(const fst_sweep_axis *axis, double a, double b)
{
    return axis->logarithmic ? sqrt(a * b) : 0.5 * (a + b);
}

/* The outermost cells reach equally far to both sides of their values. */
static double mirrored(const fst_sweep_axis *axis, double value, double edge)
{
    return axis->logarithmic ? value * (value / edge) : value + (value - edge);
}

/* The distance of two values on that scale. */
static double axis_length(const fst_sweep_axis *axis, double low, double high)
{
    return axis->logarithmic ? log(high / low) : high - low;
}

static void lay_edges(side *s, const fst_sweep_axis *axis)
{
    const int64_t n = s->count;
    for (int64_t i = 1; i < n; ++i)
        s->edges[i] = between(axis, s->places[i - 1].value, s->places[i].value);
    const double lone = s->places[0].value; /* a list of one value, which was given more than once */
    s->edges[0] = n > 1 ? mirrored(axis, lone, s->edges[1]) : lone - fmax(0.1 * fabs(lone), 1e-9);
    s->edges[n] = mirrored(axis, s->places[n - 1].value, s->edges[n - 1]);
}

static fst_status lay_side(side *s, const fst_grid *grid, const fst_sweep_axis *axis, fst_error *error)
{
    const int64_t stride = fst_grid_axis_stride(grid, axis->index);
    s->places = malloc((size_t)axis->count * sizeof *s->places);
    s->edges = malloc((size_t)(axis->count + 1) * sizeof *s->edges);
    if (!s->places || !s->edges)
        return fst_fail(error, FST_NO_MEMORY, "fst_figure_sweep", "no memory for %lld values",
                        (long long)axis->count);
    for (int64_t i = 0; i < axis->count; ++i)
        s->places[i] = (place){fst_sweep_axis_value(grid, axis, i * stride), i * stride};
    qsort(s->places, (size_t)axis->count, sizeof *s->places, by_value);
    s->count = 1;
    for (int64_t i = 1; i < axis->count; ++i)
        if (s->places[i].value != s->places[s->count - 1].value)
            s->places[s->count++] = s->places[i];
    s->step = (s->count + MOST_CELLS - 1) / MOST_CELLS;
    s->count = (s->count + s->step - 1) / s->step;
    for (int64_t i = 1; i < s->count; ++i)
        s->places[i] = s->places[i * s->step];
    lay_edges(s, axis);
    return FST_OK;
}

static double value_at(const map *m, int64_t row, int64_t column)
{
    return m->table->values[m->slice->start + m->up.places[row].offset + m->right.places[column].offset];
}

/* ------------------------------------------------------------------ drawing */

/* The upper end of a box that ends with cell `last`.  Boxes overlap by a part of a pixel, so that no seams show. */
static double upper_end(const side *s, const fst_sweep_axis *axis, int64_t last)
{
    const double edge = s->edges[last + 1];
    if (last + 1 == s->count)
        return edge;
    const double pixel = 1e-3 * axis_length(axis, s->edges[0], s->edges[s->count]);
    const double part = 0.3 * axis_length(axis, edge, s->edges[last + 2]);
    const double beyond = fmin(pixel, part);
    return axis->logarithmic ? edge * exp(beyond) : edge + beyond;
}

/* Draw the cells of one name, as a regime, or all of them (regime < 0).  Neighbouring cells of a row with the same regime
 * become one box, which keeps the file small.  A refined map has one colour for a regime, whether a point was run
 * or lies between runs that agree: two would look like a weave, because the coarse grid was run everywhere. */
static void write_cells(fst_figure_file *figure, const map *m, int regime)
{
    char name[24];
    (void)snprintf(name, sizeof name, regime < 0 ? "cells" : "cells-%d", regime);
    fst_figure_block(figure, name, "x y x_low x_high y_low y_high value");
    for (int64_t row = 0; row < m->up.count; ++row)
        for (int64_t column = 0; column < m->right.count;) {
            const double value = value_at(m, row, column);
            int64_t next = column + 1;
            while (m->names && next < m->right.count && value_at(m, row, next) == value)
                ++next;
            if (regime < 0 ? isfinite(value) : value == regime)
                (void)fprintf(figure->data, "%.7g %.7g %.9g %.9g %.9g %.9g %.7g\n",
                              m->right.places[column].value, m->up.places[row].value, m->right.edges[column],
                              upper_end(&m->right, &m->axes[1], next - 1), m->up.edges[row],
                              upper_end(&m->up, &m->axes[0], row), value);
            column = next;
        }
}

static void write_axis(fst_figure_file *figure, const fst_sweep_axis *axis, const side *s, const char *letter)
{
    if (axis->logarithmic)
        fst_figure_logarithmic(figure, letter, s->edges[0], s->edges[s->count]);
    if (axis->choice) {
        char tics[512];
        fst_sweep_choice_tics(axis, tics, sizeof tics);
        (void)fprintf(figure->script, "set %stics %s\n", letter, tics);
    }
    (void)fprintf(figure->script, "set %srange [%.9g:%.9g]\n", letter, s->edges[0], s->edges[s->count]);
}

static void write_names(fst_figure_file *figure, const map *m, const int occurs[MOST_NAMES])
{
    (void)fputs("plot ", figure->script);
    for (int r = 0; r < m->names->count; ++r)
        if (occurs[r]) {
            write_cells(figure, m, r);
            (void)fprintf(
                figure->script,
                "data index 'cells-%d' using 1:2:3:4:5:6 with boxxyerror fillstyle solid 1.0 noborder "
                "lc rgb '%s' notitle, \\\n     ",
                r, fst_colour_code(m->names->colours[r]));
        }
    (void)fputs("NaN notitle\n", figure->script);
}

/* A quantity of both signs gets a palette whose middle is zero. */
static void write_heat(fst_figure_file *figure, const map *m, const char *label, int left, int scale,
                       int height)
{
    double least = INFINITY, greatest = -INFINITY;
    for (int64_t i = 0; i < point_count(m); ++i)
        if (isfinite(value_of(m, i))) {
            least = fmin(least, value_of(m, i));
            greatest = fmax(greatest, value_of(m, i));
        }
    const double both = fmax(-least, greatest);
    fst_figure_palette(figure, least < 0 && greatest > 0 ? FST_PALETTE_DIVERGING : FST_PALETTE_LINE);
    if (least < 0 && greatest > 0)
        (void)fprintf(figure->script, "set cbrange [%.9g:%.9g]\n", -both, both);
    write_cells(figure, m, -1);
    (void)fputs("set cbtics in\n", figure->script);
    fst_figure_colour_scale(figure, height, label,
                            (const double[4]){left, FST_FIGURE_WIDTH - RIGHT, scale + TICS, scale + TICS + 12});
    (void)fputs("plot data index 'cells' using 1:2:3:4:5:6:7 with boxxyerror fillstyle solid "
                "1.0 noborder lc palette notitle, NaN notitle\n",
                figure->script);
}

/* Count points without a value: they have no row yet, their run failed, or it is undefined there. */
static int64_t blank_points(const map *m)
{
    int64_t blank = 0;
    for (int64_t i = 0; i < point_count(m); ++i)
        blank += !isfinite(value_of(m, i));
    return blank;
}

/* What is shown, and how many points have no value. */
static fst_legend make_legend(const map *m, const fst_sweep_quantity *quantity, const int occurs[MOST_NAMES])
{
    fst_legend legend = {.count = 0};
    const int64_t points = point_count(m), blank = blank_points(m);
    char words[3][128];
    fst_sweep_words(strcmp(quantity->key, "regime") == 0    ? "Regimes of motion"
                    : strcmp(quantity->key, "outcome") == 0 ? "Outcomes of several beads"
                                                            : quantity->label,
                    words[0]);
    fst_sweep_words(m->axes[1].label, words[1]);
    fst_sweep_words(m->axes[0].label, words[2]);
    (void)snprintf(legend.title, sizeof legend.title, "%.80s over %.80s and %.80s", words[0], words[1],
                   words[2]);
    if (legend.title[0] >= 'a' && legend.title[0] <= 'z')
        legend.title[0] = (char)(legend.title[0] - 'a' + 'A');
    fst_sweep_about(m->table, m->slice, legend.about, sizeof legend.about);
    size_t used = strlen(legend.about);
    if (m->slice->words[0])
        (void)snprintf(legend.about + used, sizeof legend.about - used, "; at %s", m->slice->words);
    used = strlen(legend.about);
    if (m->up.step * m->right.step > 1)
        (void)snprintf(legend.about + used, sizeof legend.about - used, "; drawn: one point of %lld x %lld",
                       (long long)m->up.step, (long long)m->right.step);
    used = strlen(legend.about);
    if (m->table->refine)
        (void)snprintf(legend.about + used, sizeof legend.about - used, "; %s",
                       m->names ? "the others lie between runs that agree" : "interpolated between them");
    used = strlen(legend.about);
    if (blank > 0)
        (void)snprintf(legend.about + used, sizeof legend.about - used,
                       "; white: %lld of %lld points without a value", (long long)blank, (long long)points);
    for (int r = 0; m->names && r < m->names->count; ++r)
        if (occurs[r]) {
            char style[64], name[64];
            size_t length;
            const char *word = fst_name_at(m->names->words, r, &length);
            (void)snprintf(name, sizeof name, "%.*s", (int)length, word);
            (void)snprintf(style, sizeof style, "fs solid 1.0 noborder lc rgb '%s'",
                           fst_colour_code(m->names->colours[r]));
            fst_legend_add(&legend, FST_SAMPLE_BOX, style, name);
        }
    return legend;
}

static fst_status draw(map *m, const fst_sweep_quantity *quantity, const fst_sweep_figure *options,
                       const char *out, fst_error *error)
{
    const fst_grid *grid = m->table->grid;
    fst_figure_file figure;
    if (blank_points(m) == point_count(m))
        return fst_fail(error, FST_BAD_INPUT, out, "%s", fst_sweep_blank(m->table));
    fst_status status = lay_side(&m->up, grid, &m->axes[0], error);
    if (status == FST_OK)
        status = lay_side(&m->right, grid, &m->axes[1], error);
    if (status != FST_OK)
        return status;
    int occurs[MOST_NAMES] = {0};
    for (int64_t i = 0; m->names && i < point_count(m); ++i)
        if (isfinite(value_of(m, i)))
            occurs[(int)value_of(m, i)] = 1;
    fst_legend legend = make_legend(m, quantity, occurs);
    if (options->title)
        (void)snprintf(legend.title, sizeof legend.title, "%s", options->title);
    const int left = m->axes[0].choice ? NAMES : LEFT, top = fst_legend_head(&legend) + 8;
    const int around = top + AXIS + (m->names ? 0 : SCALE) + fst_legend_foot(&legend);
    const fst_canvas canvas = fst_canvas_for(options->size, around + FRAME, FRAME - LEAST_FRAME);
    const int frame_height = FRAME + canvas.more, scale = top + frame_height + AXIS, height = canvas.height;
    status = fst_figure_begin(&figure, out, &canvas, error);
    if (status != FST_OK)
        return status;
    fst_figure_scene_of(&figure, fst_grid_base(m->table->grid));
    fst_figure_panels(&figure);
    const double frame[4] = {left, FST_FIGURE_WIDTH - RIGHT, top, top + frame_height};
    fst_figure_place(&figure, height, frame);
    const double below[4] = {frame[0], frame[1], frame[2], frame[3] + TICS};
    fst_figure_axis_label(&figure, height, FST_SIDE_BELOW, m->axes[1].label, FST_COLOUR_BLACK, below);
    fst_figure_axis_label(&figure, height, FST_SIDE_LEFT, m->axes[0].label, FST_COLOUR_BLACK, frame);
    (void)fputs("set tics out nomirror\nunset key\n", figure.script);
    write_axis(&figure, &m->axes[1], &m->right, "x");
    write_axis(&figure, &m->axes[0], &m->up, "y");
    if (m->names)
        write_names(&figure, m, occurs);
    else
        write_heat(&figure, m, quantity->label, left, scale, height);
    fst_legend_write(&figure, &legend, height);
    return fst_figure_finish(&figure, error);
}

fst_status fst_figure_sweep_map(const fst_sweep_table *table, const fst_sweep_quantity *quantity,
                                const fst_sweep_slice *slice, const fst_sweep_figure *options, const char *out,
                                fst_error *error)
{
    map m = {.table = table, .slice = slice, .axes = slice->axes, .names = fst_sweep_names_of(quantity->key)};
    if (fst_grid_axis_stride(table->grid, m.axes[0].index) ==
        fst_grid_axis_stride(table->grid, m.axes[1].index))
        return fst_fail(error, FST_BAD_INPUT, out, "random points make no map: use fst_sweep_export()");
    const fst_status status = draw(&m, quantity, options, out, error);
    free(m.up.places);
    free(m.up.edges);
    free(m.right.places);
    free(m.right.edges);
    return status;
}
