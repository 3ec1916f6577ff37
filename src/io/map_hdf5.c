/* map_hdf5.c - a map of the field from HDF5: the module reads it, and here its units are told. */
#include <stdlib.h>

#include "base/text.h"
#include "io/map_points.h"
#include "io/load_hdf5.h"

/* The factor to SI of the units of a data set. */
static fst_status read_units(const fst_map_points *points, const char *name, const char *unit, fst_unit kind,
                             double *factor)
{
    char whole[FST_HDF5_UNIT_SIZE + 4], quoted[FST_QUOTE_SIZE];
    fst_error why;
    (void)snprintf(whole, sizeof whole, "1 %s", unit);
    if (unit[0] && fst_parse_value(whole, kind, factor, &why) == FST_OK)
        return FST_OK;
    return fst_map_points_refuse(points, "the data set %s has %s %s (attribute units; known here: %s)", name,
                                 unit[0] ? "the unknown units" : "no units",
                                 unit[0] ? fst_quote(unit, quoted) : "", fst_unit_accepted(kind));
}

static fst_status add_samples(const fst_hdf5_map *map, fst_map_points *points)
{
    static const char *const names[] = {"x", "y", "z", "B"};
    double factors[4] = {1.0, 1.0, 1.0, 1.0};
    fst_status status = FST_OK;
    for (int i = 0; i < 4 && status == FST_OK; ++i)
        if (i == 3 || map->places[i])
            status = read_units(points, names[i], map->units[i], i < 3 ? FST_UNIT_LENGTH : FST_UNIT_FIELD,
                                &factors[i]);
    const size_t samples = map->count[0] * map->count[1] * map->count[2];
    for (size_t i = 0; i < samples && status == FST_OK; ++i) {
        double row[MAP_COLUMNS];
        size_t rest = i;
        for (int axis = 0; axis < 3; ++axis) {
            row[axis] = map->places[axis] ? map->places[axis][rest % map->count[axis]] * factors[axis] : NAN;
            rest /= map->count[axis];
            row[MAP_BX + axis] = map->b[3 * i + (size_t)axis] * factors[3];
            if (!isfinite(row[MAP_BX + axis]) || (map->places[axis] && !isfinite(row[axis])))
                return fst_map_points_fail(points, i + 1, "a number of this sample is not finite");
        }
        status = fst_map_points_add(points, row, i + 1);
    }
    return status;
}

fst_status fst_map_hdf5_read(fst_map_points *points)
{
    const fst_hdf5_module_table *module;
    fst_hdf5_map map = {.b = NULL};
    char *bytes;
    size_t size;
    points->called = "sample";
    fst_status status = fst_load_hdf5_file(&module, points->path, &bytes, &size, points->error);
    if (status == FST_OK)
        status = module->read_map(points->path, bytes, size, &map, points->error);
    if (status == FST_OK)
        status = add_samples(&map, points);
    for (int axis = 0; axis < 3; ++axis)
        free(map.places[axis]);
    free(map.b);
    free(bytes);
    return status;
}
