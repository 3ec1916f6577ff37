/* map_vtk_grid.c - what the formats of VTK share: the grid, its numbers, and its samples with their units.
 *
 * VTK knows no units: the name of the vectors tells them, "B[mT,mm]".
 */
#include "io/map_vtk.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"

size_t vtk_samples(const vtk_grid *grid)
{
    return (size_t)grid->count[0] * (size_t)grid->count[1] * (size_t)grid->count[2];
}

fst_status vtk_set_counts(vtk_grid *grid, const double counts[3])
{
    double all = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(counts[axis] >= 1 && counts[axis] <= 1e6) || counts[axis] != floor(counts[axis]))
            return fst_map_points_refuse(grid->points, "%g samples along %c make no grid", counts[axis],
                                         "xyz"[axis]);
        grid->count[axis] = (int)counts[axis];
        all *= counts[axis];
    }
    if (all > FST_MAP_SAMPLES_LIMIT)
        return fst_map_points_refuse(grid->points, "a grid of %.0f samples is larger than a map may be, %d",
                                     all, FST_MAP_SAMPLES_LIMIT);
    return FST_OK;
}

double *vtk_room(vtk_grid *grid, int axis)
{
    double **room = axis < 3 ? &grid->places[axis] : &grid->vectors;
    free(*room);
    *room = calloc(axis < 3 ? (size_t)grid->count[axis] : 3 * vtk_samples(grid), sizeof **room);
    if (!*room)
        (void)fst_fail(grid->points->error, FST_NO_MEMORY, grid->points->path, "no memory for this map");
    return *room;
}

fst_status vtk_space_evenly(vtk_grid *grid, int axis, double first, double spacing)
{
    double *places = vtk_room(grid, axis);
    if (!places)
        return FST_NO_MEMORY;
    for (int i = 0; i < grid->count[axis]; ++i)
        places[i] = first + i * spacing;
    return FST_OK;
}

/* The factors to T and m of "B[mT,mm]". */
static fst_status read_units(const vtk_grid *grid, double *tesla, double *metre)
{
    char unit[2][24] = {"T", "m"}, whole[32];
    const char *open = strchr(grid->name, '[');
    fst_error why;
    if (open) {
        const char *comma = strchr(open, ','), *close = strchr(open, ']');
        const size_t first = strcspn(open + 1, ",]");
        (void)snprintf(unit[0], sizeof unit[0], "%.*s", (int)(first < 20 ? first : 20), open + 1);
        if (comma && close && comma < close)
            (void)snprintf(unit[1], sizeof unit[1], "%.*s",
                           (int)(close - comma - 1 < 20 ? close - comma - 1 : 20), comma + 1);
    }
    (void)snprintf(whole, sizeof whole, "1 %s", unit[0]);
    if (fst_parse_value(whole, FST_UNIT_FIELD, tesla, &why) != FST_OK)
        return fst_map_points_refuse(grid->points, "the vectors \"%s\": %s", grid->name, why.sentence);
    (void)snprintf(whole, sizeof whole, "1 %s", unit[1]);
    if (fst_parse_value(whole, FST_UNIT_LENGTH, metre, &why) != FST_OK)
        return fst_map_points_refuse(grid->points, "the vectors \"%s\": %s", grid->name, why.sentence);
    return FST_OK;
}

fst_status vtk_add_samples(vtk_grid *grid)
{
    double tesla, metre;
    static const double farthest = 10.0; /* m: nobody measures a magnet so far away */
    if (!grid->vectors || !grid->places[0] || !grid->places[1] || !grid->places[2])
        return fst_map_points_refuse(grid->points, "the %s missing",
                                     grid->vectors ? "places of the grid are" : "vectors of the field are");
    fst_status status = read_units(grid, &tesla, &metre);
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis)
        for (int i = 0; i < grid->count[axis]; ++i)
            if (!(fabs(grid->places[axis][i] * metre) <= farthest))
                return fst_map_points_refuse(
                    grid->points,
                    "a place of the map along %c is %g m from the origin: VTK knows no units, so places are "
                    "in metres and fields in tesla unless the name of the vectors says, as in B[mT,mm]",
                    "xyz"[axis], grid -> places[axis][i] * metre);
    const size_t samples = status == FST_OK ? vtk_samples(grid) : 0;
    for (size_t i = 0; i < samples && status == FST_OK; ++i) {
        double row[MAP_COLUMNS];
        size_t rest = i;
        for (int axis = 0; axis < 3; ++axis) {
            row[axis] = grid->places[axis][rest % (size_t)grid->count[axis]] * metre;
            rest /= (size_t)grid->count[axis];
            row[MAP_BX + axis] = grid->vectors[3 * i + (size_t)axis] * tesla;
        }
        for (int c = 0; c < 3; ++c)
            if (!isfinite(row[MAP_BX + c]))
                return fst_map_points_fail(grid->points, i + 1, "B%c is %g, not finite", "xyz"[c],
                                           row[MAP_BX + c]);
        status = fst_map_points_add(grid->points, row, i + 1);
    }
    return status;
}

void vtk_free(vtk_grid *grid)
{
    for (int axis = 0; axis < 3; ++axis)
        free(grid->places[axis]);
    free(grid->vectors);
}

void vtk_floats(const unsigned char *bytes, size_t count, int size, int highest_first, double *numbers)
{
    for (size_t i = 0; i < count; ++i, bytes += size) {
        uint64_t word = 0;
        for (int k = 0; k < size; ++k)
            word |= (uint64_t)bytes[highest_first ? size - 1 - k : k] << (8 * k);
        if (size == 8) {
            memcpy(&numbers[i], &word, sizeof word);
        } else {
            const uint32_t half = (uint32_t)word;
            float number;
            memcpy(&number, &half, sizeof half);
            numbers[i] = (double)number;
        }
    }
}
