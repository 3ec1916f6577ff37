/* figure_field.c - the magnet's field on a plane, as a rule that of the bead's centre (the paper's Fig. 5). */
#include "base/error.h"
#include "draw/field_map.h"
#include "draw/legend.h"
#include "draw/poles.h"

#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    LEFT = 56, /* pixels about the map */
    RIGHT = 20,
    AXIS = 54,
    SCALE = 64,      /* for the scale of colours */
    ARROW_STEP = 12, /* map points from one arrow to the next */
    LEVELS = 8,      /* about as many lines of equal field */
    LABEL_GAP = 14   /* pixels between two of their labels */
};

/* What each quantity is called: on the scale of colours, and in the title. */
static const struct {
    const char *label, *title;
} words[] = {
    [FST_FIELD_STRENGTH] = {"|B|", "The magnet's field"},
    [FST_FIELD_X] = {"B_X", "The field's component along X"},
    [FST_FIELD_Y] = {"B_Y", "The field's component along Y"},
    [FST_FIELD_Z] = {"B_Z", "The field's component upwards"},
    [FST_FIELD_FORCE] = {"horizontal force", "The magnet's horizontal pull on a bead"},
    [FST_FIELD_LOAD] = {"load", "A bead's load on the plate"},
};

typedef struct field_figure {
    fst_drawn_map map;
    fst_magnet_body bodies[FST_PARTS_MAX];
    int body_count;
    int poles;              /* which poles are drawn: bits of fst_figure_write_poles() */
    double strongest;       /* of what the arrows show, scaled */
    int top, frame, height; /* where the map begins, how high it is, and the figure; pixels */
} field_figure;

/* ------------------------------------------------------------------ data */

static void write_map(fst_figure_file *figure, const fst_drawn_map *map)
{
    fst_figure_block(figure, "map", "X Y and what is shown");
    for (int row = 0; row < FST_MAP_ROWS; ++row) {
        for (int column = 0; column < FST_MAP_COLUMNS; ++column) {
            const double x = fst_drawn_map_x(map, column), y = fst_drawn_map_y(map, row);
            const double value = fst_drawn_map_value(map, x, y);
            (void)fprintf(figure->data, "%.5g %.5g ", map->length * x, map->length * y);
            if (isnan(value)) /* in a part of the magnet */
                (void)fputs("NaN\n", figure->data);
            else
                (void)fprintf(figure->data, "%.5g\n", value);
        }
        (void)fputc('\n', figure->data);
    }
}

/* The length of the longest arrow, in l. */
static double longest_arrow(const fst_drawn_map *map)
{
    return 1.1 * ARROW_STEP * 2.0 * map->half_width / (FST_MAP_COLUMNS - 1);
}

/* Arrows of the field, or of the force, in the plane.  Their length goes with the square root of the strength,
 * so that weak fields show too. */
static void write_arrows(fst_figure_file *figure, field_figure *f)
{
    const fst_drawn_map *map = &f->map;
    double v[2];
    f->strongest = 0.0;
    for (int row = ARROW_STEP / 2; row < FST_MAP_ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < FST_MAP_COLUMNS; column += ARROW_STEP) {
            fst_drawn_map_arrow(map, fst_drawn_map_x(map, column), fst_drawn_map_y(map, row), v);
            f->strongest = fmax(f->strongest, hypot(v[0], v[1]));
        }
    fst_figure_block(figure, "arrows", "X Y dX dY: the part in the plane");
    for (int row = ARROW_STEP / 2; row < FST_MAP_ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < FST_MAP_COLUMNS; column += ARROW_STEP) {
            const double x = fst_drawn_map_x(map, column), y = fst_drawn_map_y(map, row);
            fst_drawn_map_arrow(map, x, y, v);
            const double plane = hypot(v[0], v[1]);
            const double scale = plane > 0.0 ? longest_arrow(map) * sqrt(plane / f->strongest) / plane : 0.0;
            (void)fprintf(figure->data, "%.5g %.5g %.4g %.4g\n", map->length * (x - 0.5 * scale * v[0]),
                          map->length * (y - 0.5 * scale * v[1]), map->length * scale * v[0],
                          map->length * scale * v[1]);
        }
}

static void write_marks(fst_figure_file *figure, field_figure *f)
{
    const fst_drawn_map *map = &f->map;
    if (map->bar)
        fst_figure_block(figure, "lines", "X Y: the magnet's lines");
    for (int line = 0; map->bar && line < map->groups.lines; ++line) {
        double y = (line - 0.5 * (map->groups.lines - 1)) * map->groups.lambda;
        (void)fprintf(figure->data, "%.6g %.6g\n%.6g %.6g\n\n", -map->length, map->length * y, map->length,
                      map->length * y);
    }
    f->poles = fst_figure_write_poles(figure, f->bodies, f->body_count, 0.0);
    if (map->maximum_count)
        fst_figure_block(figure, "maxima", "X Y: maxima of |B|");
    for (int m = 0; m < map->maximum_count; ++m)
        (void)fprintf(figure->data, "%.8g %.8g\n", map->length * map->maxima[m][0],
                      map->length * map->maxima[m][1]);
}

/* ------------------------------------------------------------------ lines of equal field */

/* Label lines of equal field where they pass the column of the map beside a maximum, on which the field falls:
 * between two columns of arrows, and no closer to the label before than letters are high. */
static void write_levels(fst_figure_file *figure, const fst_drawn_map *map)
{
    enum { STEPS = 2000 };
    const double peak = map->maximum_count ? fabs(map->maxima[0][0]) : 0.0;
    const double place = (peak / map->half_width + 1.0) / 2.0 * (FST_MAP_COLUMNS - 1) / ARROW_STEP;
    const double x = fst_drawn_map_x(map, ARROW_STEP * (int)(place + 0.5));
    const double from = map->quantity == FST_FIELD_STRENGTH ? 0.0 : map->least;
    const double step = fst_round_step((map->greatest - from) / LEVELS);
    const double pixel = 2.0 * map->half_width / (FST_FIGURE_WIDTH - LEFT - RIGHT);
    double before = fst_drawn_map_value(map, x, 0.0), labelled = -INFINITY;
    (void)fprintf(figure->script, "set cntrparam levels incremental %.9g,%.9g,%.9g\n",
                  step * (floor(from / step) + 1.0), step, map->greatest);
    for (int i = 1; i <= STEPS; ++i) {
        const double y = 0.95 * map->half_height * i / STEPS;
        const double here = fst_drawn_map_value(map, x, y);
        const double level = step * fmax(floor(before / step), floor(here / step));
        const int passes = floor(before / step) != floor(here / step) && isfinite(before) && isfinite(here);
        if (passes && (level > 0.0 || from < 0.0) && y - labelled > LABEL_GAP * pixel) {
            (void)fprintf(
                figure->script,
                "set label '%.4g' at %.6g,%.6g center front boxed font ',11' textcolor rgb '#0b2a4a'\n", level,
                map->length * x, map->length * y);
            labelled = y;
        }
        before = here;
    }
}

/* ------------------------------------------------------------------ script */

static void write_distance(fst_figure_file *figure, const fst_drawn_map *map)
{
    if (map->maximum_count != 2)
        return;
    const double(*m)[2] = map->maxima, u = map->length;
    const double distance = map->length * hypot(m[0][0] - m[1][0], m[0][1] - m[1][1]);
    (void)fprintf(
        figure->script,
        "set label '%.3g %s' at %.6g,%.6g center offset character 0,0.9 front boxed font ',11'\n"
        "set arrow from %.6g,%.6g to %.6g,%.6g heads size screen 0.010,20 front lc rgb 'black' lw 1.5\n",
        distance, map->length_unit, u * (m[0][0] + m[1][0]) / 2.0, u * (m[0][1] + m[1][1]) / 2.0, u * m[0][0],
        u * m[0][1], u * m[1][0], u * m[1][1]);
}

static void write_axes(fst_figure_file *figure, const field_figure *f)
{
    const fst_drawn_map *map = &f->map;
    const int scale = f->top + f->frame + AXIS;
    const double frame[4] = {LEFT, FST_FIGURE_WIDTH - RIGHT, f->top, f->top + f->frame};
    char label[96];
    fst_figure_place(figure, f->height, frame);
    (void)snprintf(label, sizeof label, "X (%s)%s", map->length_unit,
                   map->bar ? ", along the magnet's lines" : "");
    fst_figure_axis_label(figure, f->height, FST_SIDE_BELOW, label, FST_COLOUR_BLACK, frame);
    (void)snprintf(label, sizeof label, "Y (%s)", map->length_unit);
    fst_figure_axis_label(figure, f->height, FST_SIDE_LEFT, label, FST_COLOUR_BLACK, frame);
    (void)snprintf(label, sizeof label, "%s (%s)", words[map->quantity].label, map->unit);
    fst_figure_colour_scale(figure, f->height, label, (const double[4]){frame[0], frame[1], scale, scale + 12});
    (void)fprintf(figure->script, "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nunset key\n",
                  -map->length * map->half_width, map->length * map->half_width,
                  -map->length * map->half_height, map->length * map->half_height);
}

/* A component has both signs, and grey is its zero; the load may be of any sign. */
static void write_colours(fst_figure_file *figure, const fst_drawn_map *map)
{
    const int component = map->quantity >= FST_FIELD_X && map->quantity <= FST_FIELD_Z;
    const double most = fmax(fabs(map->least), fabs(map->greatest));
    if (component)
        (void)fprintf(figure->script, "set cbrange [%.9g:%.9g]\n", -most, most);
    else
        (void)fputs(map->quantity == FST_FIELD_LOAD ? "set cbrange [*:*]\n" : "set cbrange [0:*]\n",
                    figure->script);
    fst_figure_palette(figure, component ? FST_PALETTE_DIVERGING : FST_PALETTE_MAP);
}

static void write_script(fst_figure_file *figure, const field_figure *f)
{
    FILE *script = figure->script;
    fst_figure_panels(figure);
    (void)fputs("set style textbox opaque margins 0.4,0.3 fillcolor rgb 'white' noborder\n", script);
    write_levels(figure, &f->map);
    (void)fputs("set contour base\nunset surface\nset table $contours\n"
                "splot data index 'map' using 1:2:3\n"
                "unset table\nunset contour\nset surface\n",
                script);
    write_axes(figure, f);
    write_colours(figure, &f->map);
    write_distance(figure, &f->map);
    (void)fputs("plot data index 'map' using 1:2:3 with image notitle, \\\n"
                "     $contours using 1:2 with lines lc rgb '#6f8fae' lw 0.8 notitle, \\\n",
                script);
    if (f->map.bar)
        (void)fputs("     data index 'lines' using 1:2 with lines lc rgb '#50d55e00' lw 3 notitle, \\\n",
                    script);
    fst_figure_plot_poles(script, f->poles);
    (void)fputs("     data index 'arrows' using 1:2:3:4 with vectors head filled size screen 0.011,20 lc rgb "
                "'#333333' lw 1 notitle",
                script);
    if (f->map.maximum_count)
        (void)fputs(
            ", \\\n     data index 'maxima' using 1:2 with points pt 2 ps 1.2 lw 3 lc rgb '#000000' notitle",
            script);
    (void)fputc('\n', script);
}

static fst_legend make_legend(const field_figure *f)
{
    const fst_drawn_map *map = &f->map;
    fst_legend legend = {.count = 0};
    char text[128], unit[32];
    if (map->other_height)
        (void)snprintf(legend.title, sizeof legend.title, "%s at the height %.4g mm",
                       words[map->quantity].title, 1e3 * map->groups.h * map->groups.length_unit);
    else
        (void)snprintf(legend.title, sizeof legend.title, "%s%s", words[map->quantity].title,
                       fst_drawn_map_of_bead(map) ? "" : " at the height of the bead's centre");
    fst_unit_symbols("l", unit, sizeof unit);
    (void)snprintf(legend.about, sizeof legend.about, "%s: %s = %.4g mm%s",
                   map->bar ? "half length of the magnet's lines" : "unit of length", unit,
                   1e3 * map->groups.length_unit,
                   fst_drawn_map_of_bead(map) ? "; the bead's moment along the field" : "");
    (void)snprintf(text, sizeof text, "lines of equal %s", words[map->quantity].label);
    fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#6f8fae' lw 0.8", text);
    if (map->maximum_count > 0)
        fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 2 ps 1.2 lw 3 lc rgb '#000000'", "maxima of |B|");
    if (map->bar)
        fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#50d55e00' lw 3",
                       "the magnet's lines, below the plate");
    fst_legend_add_poles(&legend, f->bodies, f->body_count, "below the plate");
    const double longest = map->value * f->strongest;
    (void)snprintf(text, sizeof text, "%s: this length is %.*g %s, others as its square root",
                   fst_drawn_map_of_bead(map) ? "horizontal force" : "in-plane part of B",
                   longest < 100.0 ? 2 : 3, longest, map->unit);
    fst_legend_add(&legend, FST_SAMPLE_ARROW, "lc rgb '#333333' lw 1", text);
    legend.entries[legend.count - 1].length =
        longest_arrow(map) / (2.0 * map->half_width) * (FST_FIGURE_WIDTH - LEFT - RIGHT);
    return legend;
}

static fst_status draw(field_figure *f, const char *out, fst_error *error)
{
    fst_figure_file figure;
    f->strongest = 1.0;
    fst_legend legend = make_legend(f);
    f->top = fst_legend_head(&legend) + 6;
    f->frame = (int)((FST_FIGURE_WIDTH - LEFT - RIGHT) * f->map.half_height / f->map.half_width);
    f->height = f->top + f->frame + AXIS + SCALE + fst_legend_foot(&legend);
    const fst_status status = fst_figure_begin(&figure, out, FST_FIGURE_WIDTH, f->height, error);
    if (status != FST_OK)
        return status;
    write_map(&figure, &f->map);
    write_arrows(&figure, f);
    write_marks(&figure, f);
    write_script(&figure, f);
    legend = make_legend(f); /* the strongest arrow is known now */
    fst_legend_write(&figure, &legend, f->height);
    return fst_figure_finish(&figure, error);
}

fst_status fst_figure_field_map(const fst_params *params, const fst_field_options *options, const char *out,
                                fst_error *error)
{
    field_figure *f = calloc(1, sizeof *f);
    if (!f)
        return fst_fail(error, FST_NO_MEMORY, out, "out of memory");
    fst_status status = fst_drawn_map_make(&f->map, params, options, error);
    if (status == FST_OK) {
        fst_drawn_map_survey(&f->map);
        if (!f->map.bar)
            f->body_count =
                fst_magnet_bodies(params, f->map.length / params->magnet_half_length, 1.0, f->bodies);
        status = draw(f, out, error);
    }
    fst_drawn_map_free(&f->map);
    free(f);
    return status;
}

fst_status fst_figure_field(const fst_params *params, fst_shown_units units, const char *out, fst_error *error)
{
    const fst_field_options options = {FST_FIELD_STRENGTH, NAN, units};
    return fst_figure_field_map(params, &options, out, error);
}
