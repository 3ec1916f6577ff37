/* field_map.c - what a map of the magnet's field shows: |B|, a component, or the force and load of a bead. */
#include "draw/field_map.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "draw/poles.h"

double fst_drawn_map_x(const fst_drawn_map *map, int column)
{
    return map->half_width * (2.0 * column / (FST_MAP_COLUMNS - 1) - 1.0);
}

double fst_drawn_map_y(const fst_drawn_map *map, int row)
{
    return map->half_height * (2.0 * row / (FST_MAP_ROWS - 1) - 1.0);
}

static double strength(const fst_model *model, double x, double y)
{
    double b[3], gradient[3][3];
    fst_field(model, x, y, b, gradient);
    return sqrt(b[0] * b[0] + b[1] * b[1] + b[2] * b[2]);
}

int fst_drawn_map_of_bead(const fst_drawn_map *map)
{
    return map->quantity == FST_FIELD_FORCE || map->quantity == FST_FIELD_LOAD;
}

static int is_inside(const fst_drawn_map *map, double x, double y)
{
    const double l = map->groups.length_unit, place[3] = {l * x, l * y, l * map->groups.h};
    return map->params->magnet_shape == FST_MAGNET_PARTS && fst_part_touched(map->params, place, 0.0) >= 0;
}

double fst_drawn_map_value(const fst_drawn_map *map, double x, double y)
{
    double b[3], gradient[3][3], force[3], load;
    if (is_inside(map, x, y))
        return NAN;
    switch (map->quantity) {
    case FST_FIELD_STRENGTH:
        return map->value * strength(map->model, x, y);
    case FST_FIELD_FORCE:
        fst_field_pull(map->model, x, y, force, &load);
        return map->value * hypot(force[0], force[1]);
    case FST_FIELD_LOAD:
        fst_field_pull(map->model, x, y, force, &load);
        return map->value * load;
    default:
        fst_field(map->model, x, y, b, gradient);
        return map->value * b[map->quantity - FST_FIELD_X];
    }
}

void fst_drawn_map_arrow(const fst_drawn_map *map, double x, double y, double arrow[2])
{
    double v[3], gradient[3][3], load;
    if (fst_drawn_map_of_bead(map))
        fst_field_pull(map->model, x, y, v, &load);
    else
        fst_field(map->model, x, y, v, gradient);
    const int nothing = is_inside(map, x, y);
    arrow[0] = nothing ? 0.0 : v[0];
    arrow[1] = nothing ? 0.0 : v[1];
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

static void note_maximum(fst_drawn_map *map, int column, int row)
{
    double place[2] = {fst_drawn_map_x(map, column), fst_drawn_map_y(map, row)};
    climb(map->model, fst_drawn_map_x(map, 1) - fst_drawn_map_x(map, 0), place);
    for (int m = 0; m < map->maximum_count; ++m)
        if (hypot(place[0] - map->maxima[m][0], place[1] - map->maxima[m][1]) < 1e-4)
            return;
    map->maxima[map->maximum_count][0] = place[0];
    map->maxima[map->maximum_count][1] = place[1];
    ++map->maximum_count;
}

/* Every map point that is not lower than its eight neighbours leads to a maximum. */
static void find_maxima(fst_drawn_map *map)
{
    for (int row = 1; row < FST_MAP_ROWS - 1; ++row)
        for (int column = 1; column < FST_MAP_COLUMNS - 1 && map->maximum_count < FST_MAP_MAXIMA; ++column) {
            const double here =
                fst_drawn_map_value(map, fst_drawn_map_x(map, column), fst_drawn_map_y(map, row));
            int highest = 1;
            for (int i = 0; i < 9 && highest; ++i)
                highest = here >= fst_drawn_map_value(map, fst_drawn_map_x(map, column + i % 3 - 1),
                                                      fst_drawn_map_y(map, row + i / 3 - 1));
            if (highest)
                note_maximum(map, column, row);
        }
}

void fst_drawn_map_survey(fst_drawn_map *map)
{
    map->least = INFINITY;
    map->greatest = -INFINITY;
    for (int row = 0; row < FST_MAP_ROWS; ++row)
        for (int column = 0; column < FST_MAP_COLUMNS; ++column) {
            const double value =
                fst_drawn_map_value(map, fst_drawn_map_x(map, column), fst_drawn_map_y(map, row));
            map->least = fmin(map->least, value); /* of NAN the other */
            map->greatest = fmax(map->greatest, value);
        }
    if (map->quantity == FST_FIELD_STRENGTH)
        find_maxima(map);
}

/* ------------------------------------------------------------------ making it */

static void choose_units(fst_drawn_map *map, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(map->params);
    map->length = fst_unit_shown("l", units, &scales, &map->length_unit);
    map->value = fst_unit_shown(fst_drawn_map_of_bead(map) ? "l gamma^2" : "B0", units, &scales, &map->unit);
    if (strcmp(map->length_unit, "l") == 0)
        map->length_unit = "ℓ";
    if (strcmp(map->unit, "B0") == 0)
        map->unit = "B_0";
    if (strcmp(map->unit, "l gamma^2") == 0)
        map->unit = "ℓγ²";
}

/* The map shows the poles and the corners of the magnet, with room about them that grows with the height. */
static void choose_extent(fst_drawn_map *map)
{
    const double h = map->groups.h, half_lines = 0.5 * (map->groups.lines - 1) * map->groups.lambda;
    const double l = map->groups.length_unit;
    map->half_width = fmin(1.0 + 0.9 * h + 0.3, map->groups.map_radius); /* a measured field ends there */
    map->half_height = map->bar ? half_lines + 0.9 * h : map->half_width;
    fst_magnet_body *bodies = calloc(FST_PARTS_MAX, sizeof *bodies);
    const int count = bodies && !map->bar ? fst_magnet_bodies(map->params, 1.0 / l, 1.0, bodies) : 0;
    double reach[2] = {0.0, 0.0}, middle = 0.0;
    for (int i = 0; i < count; ++i) {
        middle += 0.5 * (bodies[i].seen.low + bodies[i].seen.high) / count;
        for (int k = 0; k < bodies[i].seen.count; ++k)
            for (int axis = 0; axis < 2; ++axis)
                reach[axis] = fmax(reach[axis], fabs(bodies[i].seen.corners[k][axis]));
    }
    free(bodies);
    if (count == 0)
        return;
    const double room = fmax(0.9 * fabs(h - middle), 0.15 * fmax(reach[0], reach[1]));
    map->half_width = fmax(reach[0] + room, (reach[1] + room) / 1.25);
    map->half_height = fmax(reach[1] + room, 0.5 * map->half_width);
}

fst_status fst_drawn_map_make(fst_drawn_map *map, const fst_params *params, const fst_field_options *options,
                              fst_error *error)
{
    fst_model *model = NULL;
    *map = (fst_drawn_map){.params = params,
                           .quantity = options->quantity,
                           .other_height = !isnan(options->height),
                           .bar = params->magnet_shape == FST_MAGNET_LINES};
    const fst_status status = map->other_height ? fst_field_model_new(params, options->height, &model, error)
                                                : fst_model_new(params, &model, error);
    map->model = model;
    if (status != FST_OK)
        return status;
    map->groups = fst_model_groups(model);
    choose_units(map, options->units);
    choose_extent(map);
    return FST_OK;
}

void fst_drawn_map_free(fst_drawn_map *map)
{
    fst_model_free((fst_model *)map->model);
}
