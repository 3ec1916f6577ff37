/* figure_field.c - the magnet's field on the plane of the bead's centre (the paper's Fig. 5). */
#include "base/error.h"
#include "draw/legend.h"

#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

enum {
    LEFT = 56, /* pixels about the map */
    RIGHT = 20,
    AXIS = 54,
    SCALE = 64,    /* for the scale of colours */
    COLUMNS = 181, /* of the map */
    ROWS = 145,
    ARROW_STEP = 12, /* map points from one arrow to the next */
    MAXIMA = 8,      /* the most maxima that are marked */
    LEVELS = 8,      /* about as many lines of equal field */
    LABEL_GAP = 14   /* pixels between two of their labels */
};

typedef struct field_map {
    const fst_model *model;
    fst_groups groups;
    int bar;                        /* whether the source is the bar of lines, which is marked */
    double half_width, half_height; /* of the map, in l */
    double maxima[MAXIMA][2];
    int maximum_count;
    double length, field;                 /* how many of the figure's units make l and B0 */
    const char *length_unit, *field_unit; /* their names */
    double strongest;                     /* of the parts in the plane, where arrows are; in B0 */
    int top, frame, height;               /* where the map begins, how high it is, and the figure; pixels */
} field_map;

static double strength(const fst_model *model, double x, double y)
{
    double b[3], gradient[3][3];
    fst_field(model, x, y, b, gradient);
    return sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
}

static double column_x(const field_map *map, int column)
{
    return map->half_width * (2.0 * column / (COLUMNS - 1) - 1.0);
}

static double row_y(const field_map *map, int row)
{
    return map->half_height * (2.0 * row / (ROWS - 1) - 1.0);
}

/* ------------------------------------------------------------------ maxima */

/* Climb from a map point to the maximum: step along both axes, and halve the step where none leads up. */
static void climb(const fst_model *model, double step, double place[2])
{
    double here = strength(model, place[0], place[1]);
    while (step > 1e-9) {
        static const double ways[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
        int moved = 0;
        for (int i = 0; i < 4 && !moved; ++i) {
            double x = place[0] + step * ways[i][0], y = place[1] + step * ways[i][1];
            double there = strength(model, x, y);
            if (there > here) {
                here = there;
                place[0] = x;
                place[1] = y;
                moved = 1;
            }
        }
        if (!moved)
            step *= 0.5;
    }
}

/* Every map point that is not lower than its eight neighbours leads to a maximum. */
static void find_maxima(field_map *map)
{
    for (int row = 1; row < ROWS - 1; ++row) {
        for (int column = 1; column < COLUMNS - 1; ++column) {
            double here = strength(map->model, column_x(map, column), row_y(map, row));
            int highest = 1;
            for (int i = 0; i < 9 && highest; ++i)
                highest = here >=
                          strength(map->model, column_x(map, column + i % 3 - 1), row_y(map, row + i / 3 - 1));
            if (!highest || map->maximum_count == MAXIMA)
                continue;
            double place[2] = {column_x(map, column), row_y(map, row)};
            climb(map->model, column_x(map, 1) - column_x(map, 0), place);
            int known = 0;
            for (int m = 0; m < map->maximum_count; ++m)
                known = known || hypot(place[0] - map->maxima[m][0], place[1] - map->maxima[m][1]) < 1e-4;
            if (known)
                continue;
            map->maxima[map->maximum_count][0] = place[0];
            map->maxima[map->maximum_count][1] = place[1];
            ++map->maximum_count;
        }
    }
}

/* ------------------------------------------------------------------ data */

static void write_map(fst_figure_file *figure, const field_map *map)
{
    fst_figure_block(figure, "map", "X Y |B|");
    for (int row = 0; row < ROWS; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            double x = column_x(map, column), y = row_y(map, row);
            (void)fprintf(figure->data, "%.5g %.5g %.5g\n", map->length * x, map->length * y,
                          map->field * strength(map->model, x, y));
        }
        (void)fputc('\n', figure->data);
    }
}

/* The length of the longest arrow, in l. */
static double longest_arrow(const field_map *map)
{
    return 1.1 * ARROW_STEP * 2.0 * map->half_width / (COLUMNS - 1);
}

/* Arrows of the field in the plane.  Their length goes with the square root of the strength, so that weak
 * fields show too. */
static void write_arrows(fst_figure_file *figure, field_map *map)
{
    map->strongest = 0.0;
    for (int row = ARROW_STEP / 2; row < ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < COLUMNS; column += ARROW_STEP) {
            double b[3], gradient[3][3];
            fst_field(map->model, column_x(map, column), row_y(map, row), b, gradient);
            map->strongest = fmax(map->strongest, hypot(b[0], b[1]));
        }
    fst_figure_block(figure, "arrows", "X Y dX dY: the part of the field in the plane");
    for (int row = ARROW_STEP / 2; row < ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < COLUMNS; column += ARROW_STEP) {
            double b[3], gradient[3][3], x = column_x(map, column), y = row_y(map, row);
            fst_field(map->model, x, y, b, gradient);
            double plane = hypot(b[0], b[1]);
            double scale = plane > 0.0 ? longest_arrow(map) * sqrt(plane / map->strongest) / plane : 0.0;
            (void)fprintf(figure->data, "%.5g %.5g %.4g %.4g\n", map->length * (x - 0.5 * scale * b[0]),
                          map->length * (y - 0.5 * scale * b[1]), map->length * scale * b[0],
                          map->length * scale * b[1]);
        }
}

static void write_marks(fst_figure_file *figure, const field_map *map)
{
    if (map->bar)
        fst_figure_block(figure, "lines", "X Y: the magnet's lines");
    for (int line = 0; map->bar && line < map->groups.lines; ++line) {
        double y = (line - 0.5 * (map->groups.lines - 1)) * map->groups.lambda;
        (void)fprintf(figure->data, "%.6g %.6g\n%.6g %.6g\n\n", -map->length, map->length * y, map->length,
                      map->length * y);
    }
    fst_figure_block(figure, "maxima", "X Y: maxima of |B|");
    for (int m = 0; m < map->maximum_count; ++m)
        (void)fprintf(figure->data, "%.8g %.8g\n", map->length * map->maxima[m][0],
                      map->length * map->maxima[m][1]);
}

/* ------------------------------------------------------------------ lines of equal field */

/* Label lines of equal field where they pass the column of the map beside a maximum, on which the field falls:
 * between two columns of arrows, and no closer to the label before than letters are high. */
static void write_levels(fst_figure_file *figure, const field_map *map, double greatest)
{
    enum { STEPS = 2000 };
    const double peak = map->maximum_count ? fabs(map->maxima[0][0]) : 0.0;
    const double place = (peak / map->half_width + 1.0) / 2.0 * (COLUMNS - 1) / ARROW_STEP;
    const double x = column_x(map, ARROW_STEP * (int)(place + 0.5));
    const double step = fst_round_step(greatest / LEVELS);
    const double pixel = 2.0 * map->half_width / (FST_FIGURE_WIDTH - LEFT - RIGHT);
    double before = map->field * strength(map->model, x, 0.0), labelled = -INFINITY;
    (void)fprintf(figure->script, "set cntrparam levels incremental %.9g,%.9g,%.9g\n", step, step, greatest);
    for (int i = 1; i <= STEPS; ++i) {
        const double y = 0.95 * map->half_height * i / STEPS;
        const double here = map->field * strength(map->model, x, y), level = step * floor(before / step);
        if (here < level && before >= level && level > 0.0 && y - labelled > LABEL_GAP * pixel) {
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

static void write_distance(fst_figure_file *figure, const field_map *map)
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

static void write_script(fst_figure_file *figure, const field_map *map, double greatest)
{
    FILE *script = figure->script;
    const int scale = map->top + map->frame + AXIS;
    fst_figure_panels(figure);
    (void)fputs("set style textbox opaque margins 0.4,0.3 fillcolor rgb 'white' noborder\n", script);
    write_levels(figure, map, greatest);
    (void)fputs("set contour base\nunset surface\nset table $contours\n"
                "splot data index 'map' using 1:2:3\n"
                "unset table\nunset contour\nset surface\n",
                script);
    const double frame[4] = {LEFT, FST_FIGURE_WIDTH - RIGHT, map->top, map->top + map->frame};
    char label[96];
    fst_figure_place(figure, map->height, frame);
    (void)snprintf(label, sizeof label, "X (%s)%s", map->length_unit,
                   map->bar ? ", along the magnet's lines" : "");
    fst_figure_axis_label(figure, map->height, FST_SIDE_BELOW, label, FST_COLOUR_BLACK, frame);
    (void)snprintf(label, sizeof label, "Y (%s)", map->length_unit);
    fst_figure_axis_label(figure, map->height, FST_SIDE_LEFT, label, FST_COLOUR_BLACK, frame);
    (void)snprintf(label, sizeof label, "|B| (%s)", map->field_unit);
    fst_figure_colour_scale(figure, map->height, label,
                            (const double[4]){frame[0], frame[1], scale, scale + 12});
    (void)fprintf(script, "set xrange [%.6g:%.6g]\nset yrange [%.6g:%.6g]\nset cbrange [0:*]\nunset key\n",
                  -map->length * map->half_width, map->length * map->half_width,
                  -map->length * map->half_height, map->length * map->half_height);
    fst_figure_palette(figure, FST_PALETTE_MAP);
    write_distance(figure, map);
    (void)fputs("plot data index 'map' using 1:2:3 with image notitle, \\\n"
                "     $contours using 1:2 with lines lc rgb '#6f8fae' lw 0.8 notitle, \\\n",
                script);
    if (map->bar)
        (void)fputs("     data index 'lines' using 1:2 with lines lc rgb '#50d55e00' lw 3 notitle, \\\n",
                    script);
    (void)fputs("     data index 'arrows' using 1:2:3:4 with vectors head filled size screen 0.011,20 lc rgb "
                "'#333333' lw 1 notitle, \\\n"
                "     data index 'maxima' using 1:2 with points pt 2 ps 1.2 lw 3 lc rgb '#000000' notitle\n",
                script);
}

static fst_legend make_legend(const field_map *map)
{
    fst_legend legend = {.title = "The magnet's field at the height of the bead's centre"};
    char words[128], unit[32];
    fst_unit_symbols("l", unit, sizeof unit);
    (void)snprintf(legend.about, sizeof legend.about, "%s: %s = %.4g mm",
                   map->bar ? "half length of the magnet's lines" : "unit of length", unit,
                   1e3 * map->groups.length_unit);
    fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#6f8fae' lw 0.8", "lines of equal |B|");
    if (map->maximum_count > 0)
        fst_legend_add(&legend, FST_SAMPLE_POINT, "pt 2 ps 1.2 lw 3 lc rgb '#000000'", "maxima of |B|");
    if (map->bar)
        fst_legend_add(&legend, FST_SAMPLE_LINE, "lc rgb '#50d55e00' lw 3",
                       "the magnet's lines, below the plate");
    const double shown = map->field * map->strongest;
    (void)snprintf(words, sizeof words, "in-plane part of B: this length is %.2g %s, others as its square root",
                   shown, map->field_unit);
    fst_legend_add(&legend, FST_SAMPLE_ARROW, "lc rgb '#333333' lw 1", words);
    legend.entries[legend.count - 1].length =
        longest_arrow(map) / (2.0 * map->half_width) * (FST_FIGURE_WIDTH - LEFT - RIGHT);
    return legend;
}

static void choose_units(field_map *map, const fst_params *params, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(params);
    map->length = fst_unit_shown("l", units, &scales, &map->length_unit);
    map->field = fst_unit_shown("B0", units, &scales, &map->field_unit);
    if (strcmp(map->length_unit, "l") == 0)
        map->length_unit = "ℓ";
    if (strcmp(map->field_unit, "B0") == 0)
        map->field_unit = "B_0";
}

static fst_status draw(field_map *map, const char *out, fst_error *error)
{
    fst_figure_file figure;
    double greatest = 0.0;
    find_maxima(map);
    for (int row = 0; row < ROWS; ++row)
        for (int column = 0; column < COLUMNS; ++column)
            greatest =
                fmax(greatest, map->field * strength(map->model, column_x(map, column), row_y(map, row)));
    map->strongest = 1.0;
    fst_legend legend = make_legend(map);
    map->top = fst_legend_head(&legend) + 6;
    map->frame = (int)((FST_FIGURE_WIDTH - LEFT - RIGHT) * map->half_height / map->half_width);
    map->height = map->top + map->frame + AXIS + SCALE + fst_legend_foot(&legend);
    const fst_status status = fst_figure_begin(&figure, out, FST_FIGURE_WIDTH, map->height, error);
    if (status != FST_OK)
        return status;
    write_map(&figure, map);
    write_arrows(&figure, map);
    write_marks(&figure, map);
    write_script(&figure, map, greatest);
    legend = make_legend(map); /* the strongest arrow is known now */
    fst_legend_write(&figure, &legend, map->height);
    return fst_figure_finish(&figure, error);
}

fst_status fst_figure_field(const fst_params *params, fst_shown_units units, const char *out, fst_error *error)
{
    fst_model *model = NULL;
    fst_status status = fst_model_new(params, &model, error);
    if (status != FST_OK)
        return status;
    field_map map = {
        .model = model, .groups = fst_model_groups(model), .bar = params->magnet_shape == FST_MAGNET_LINES};
    choose_units(&map, params, units);
    /* The map shows the poles and the corners of the bar of lines, with room about them, whatever its shape; of
     * another source it shows a square of that width. */
    double half_lines = 0.5 * (map.groups.lines - 1) * map.groups.lambda;
    map.half_width = 1.0 + 0.9 * map.groups.h + 0.3;
    map.half_width = fmin(map.half_width, map.groups.map_radius); /* a measured field ends there */
    map.half_height = map.bar ? half_lines + 0.9 * map.groups.h : map.half_width;
    status = draw(&map, out, error);
    fst_model_free(model);
    return status;
}
