/* figure_field.c - the magnet's field on the plane of the bead's centre (the paper's Fig. 5). */
#include "base/error.h"
#include "draw/style.h"

#include <festoon/festoon_tools.h>

#include <stdlib.h>

enum {
    WIDTH = 760,
    HEIGHT = 590,
    LEFT = 78, /* margins about the map, in pixels */
    RIGHT = 132,
    TOP = 48,
    BOTTOM = 112,
    COLUMNS = 181, /* of the map */
    ROWS = 145,
    ARROW_STEP = 9, /* map points from one arrow to the next */
    MAXIMA = 8      /* the most maxima that are marked */
};

typedef struct field_map {
    const fst_model *model;
    fst_groups groups;
    int bar;                        /* whether the source is the bar of lines, which is marked */
    double half_width, half_height; /* of the map, in l */
    double maxima[MAXIMA][2];
    int maximum_count;
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
    fst_figure_block(figure, "map", "X/l Y/l |B|/B0");
    for (int row = 0; row < ROWS; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            double x = column_x(map, column), y = row_y(map, row);
            (void)fprintf(figure->data, "%.5g %.5g %.5g\n", x, y, strength(map->model, x, y));
        }
        (void)fputc('\n', figure->data);
    }
}

/* Arrows of the field in the plane.  Their length goes with the square root of the strength, so that weak
 * fields show too. */
static void write_arrows(fst_figure_file *figure, const field_map *map)
{
    double greatest = 0.0;
    for (int row = ARROW_STEP / 2; row < ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < COLUMNS; column += ARROW_STEP) {
            double b[3], gradient[3][3];
            fst_field(map->model, column_x(map, column), row_y(map, row), b, gradient);
            greatest = fmax(greatest, hypot(b[0], b[1]));
        }
    double longest = 1.1 * ARROW_STEP * 2.0 * map->half_width / (COLUMNS - 1);
    fst_figure_block(figure, "arrows", "X/l Y/l dX dY: direction of the in-plane field");
    for (int row = ARROW_STEP / 2; row < ROWS; row += ARROW_STEP)
        for (int column = ARROW_STEP / 2; column < COLUMNS; column += ARROW_STEP) {
            double b[3], gradient[3][3], x = column_x(map, column), y = row_y(map, row);
            fst_field(map->model, x, y, b, gradient);
            double plane = hypot(b[0], b[1]);
            double scale = plane > 0.0 ? longest * sqrt(plane / greatest) / plane : 0.0;
            (void)fprintf(figure->data, "%.5g %.5g %.4g %.4g\n", x - 0.5 * scale * b[0], y - 0.5 * scale * b[1],
                          scale * b[0], scale * b[1]);
        }
}

static void write_marks(fst_figure_file *figure, const field_map *map)
{
    if (map->bar)
        fst_figure_block(figure, "lines", "X/l Y/l: the magnet's lines");
    for (int line = 0; map->bar && line < map->groups.lines; ++line) {
        double y = (line - 0.5 * (map->groups.lines - 1)) * map->groups.lambda;
        (void)fprintf(figure->data, "-1 %.6g\n1 %.6g\n\n", y, y);
    }
    fst_figure_block(figure, "maxima", "X/l Y/l: maxima of |B|");
    for (int m = 0; m < map->maximum_count; ++m)
        (void)fprintf(figure->data, "%.8g %.8g\n", map->maxima[m][0], map->maxima[m][1]);
}

/* ------------------------------------------------------------------ script */

static void write_script(fst_figure_file *figure, const field_map *map)
{
    FILE *script = figure->script;
    double millimetres = 1e3 * map->groups.length_unit;
    double left = LEFT / (double)WIDTH, right = 1.0 - RIGHT / (double)WIDTH;
    double top = 1.0 - TOP / (double)HEIGHT, bottom = BOTTOM / (double)HEIGHT;
    (void)fprintf(
        script,
        "set title 'The magnet''s field at the height of the bead''s centre (unit of length ℓ = %.4g mm)'\n"
        "set size ratio -1\n"
        "set xrange [%.6g:%.6g]\n"
        "set yrange [%.6g:%.6g]\n"
        "set xlabel 'X (ℓ)%s'\n"
        "set ylabel 'Y (ℓ)'\n"
        "set cblabel '|B| (B_0)'\n"
        "set cbrange [0:*]\n"
        "set lmargin at screen %.4f\n"
        "set rmargin at screen %.4f\n"
        "set tmargin at screen %.4f\n"
        "set bmargin at screen %.4f\n"
        "set key at screen %.4f, screen 0.015 left bottom Left reverse maxrows 2 samplen 2 width 2\n",
        millimetres, -map->half_width, map->half_width, -map->half_height, map->half_height,
        map->bar ? ", along the magnet''s lines" : "", left, right, top, bottom, left);
    fst_figure_palette(figure, FST_PALETTE_MAP);
    if (map->maximum_count == 2) {
        double distance =
            millimetres * hypot(map->maxima[0][0] - map->maxima[1][0], map->maxima[0][1] - map->maxima[1][1]);
        (void)fprintf(
            script,
            "set style textbox opaque margins 0.5,0.5 fillcolor rgb 'white' noborder\n"
            "set label '%.1f mm' at %.6g,%.6g center offset character 0,0.9 front boxed\n"
            "set arrow from %.6g,%.6g to %.6g,%.6g heads size screen 0.008,20 front lc rgb 'black' lw 1.5\n",
            distance, (map->maxima[0][0] + map->maxima[1][0]) / 2.0,
            (map->maxima[0][1] + map->maxima[1][1]) / 2.0, map->maxima[0][0], map->maxima[0][1],
            map->maxima[1][0], map->maxima[1][1]);
    }
    (void)fputs("set contour base\n"
                "set cntrparam levels auto 12\n"
                "unset surface\n"
                "set table $contours\n"
                "splot data index 'map' using 1:2:3\n"
                "unset table\n"
                "unset contour\n"
                "set surface\n"
                "plot data index 'map' using 1:2:3 with image notitle, \\\n"
                "     $contours using 1:2 with lines lc rgb '#6f8fae' lw 0.8 title 'lines of equal |B|', \\\n",
                script);
    if (map->bar)
        (void)fputs("     data index 'lines' using 1:2 with lines lc rgb '#50d55e00' lw 3 title 'the magnet''s "
                    "lines, below', \\\n",
                    script);
    (void)fputs("     data index 'arrows' using 1:2:3:4 with vectors head filled size screen 0.008,20 lc rgb "
                "'#333333' lw 1 title 'in-plane direction of B', \\\n"
                "     data index 'maxima' using 1:2 with points pt 2 ps 1.4 lw 3 lc rgb '#000000' title "
                "'maxima of |B|'\n",
                script);
}

fst_status fst_figure_field(const fst_params *params, const char *out, fst_error *error)
{
    fst_model *model = NULL;
    fst_status status = fst_model_new(params, &model, error);
    if (status != FST_OK)
        return status;
    field_map map = {
        .model = model, .groups = fst_model_groups(model), .bar = params->magnet_shape == FST_MAGNET_LINES};
    /* The map shows the poles and the corners of the bar of lines, with room about them, whatever its shape; of
     * another source it shows a square of that width. */
    double half_lines = 0.5 * (map.groups.lines - 1) * map.groups.lambda;
    map.half_width = 1.0 + 0.9 * map.groups.h + 0.3;
    map.half_height = map.bar ? half_lines + 0.9 * map.groups.h : map.half_width;
    fst_figure_file figure;
    status = fst_figure_begin(&figure, out, WIDTH, HEIGHT, error);
    if (status == FST_OK) {
        find_maxima(&map);
        write_map(&figure, &map);
        write_arrows(&figure, &map);
        write_marks(&figure, &map);
        write_script(&figure, &map);
        status = fst_figure_finish(&figure, error);
    }
    fst_model_free(model);
    return status;
}
