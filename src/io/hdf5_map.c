/* hdf5_map.c - reading a map of the field from HDF5, in the module festoon-hdf5.so.
 *
 * The file: the data sets x, y and, where it is known, z, lists of places with an attribute `units` ("mm"); and
 * B of ny x nx x 3 or nz x ny x nx x 3 numbers with its `units` ("mT"), as h5py writes B[iz, iy, ix,
 * component].
 */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "io/hdf5_session.h"

/* The text of the attribute `units` (or `unit`) of a data set; "" where there is none that can be read. */
static void read_units(hid_t set, char text[FST_HDF5_UNIT_SIZE])
{
    text[0] = '\0';
    const char *name = H5Aexists(set, "units") > 0 ? "units" : "unit";
    const hid_t attribute = H5Aopen(set, name, H5P_DEFAULT);
    if (attribute < 0)
        return;
    const hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
    const int is_text =
        type >= 0 && H5Tget_class(type) == H5T_STRING && H5Sget_simple_extent_npoints(space) == 1;
    if (is_text && H5Tis_variable_str(type) > 0) {
        char *whole = NULL;
        const hid_t memory = H5Tcopy(H5T_C_S1);
        (void)H5Tset_size(memory, H5T_VARIABLE);
        (void)H5Tset_cset(memory, H5Tget_cset(type));
        if (H5Aread(attribute, memory, &whole) >= 0 && whole) {
            (void)snprintf(text, FST_HDF5_UNIT_SIZE, "%.30s", whole);
            (void)H5free_memory(whole);
        }
        (void)H5Tclose(memory);
    } else if (is_text && H5Tget_size(type) < FST_HDF5_UNIT_SIZE) {
        if (H5Aread(attribute, type, text) < 0)
            text[0] = '\0';
        text[H5Tget_size(type)] = '\0';
    }
    fst_hdf5_close(type, space);
    (void)H5Aclose(attribute);
}

/* Read a data set of `dimensions` sizes; sizes[i] of 0 is filled in, another must be that of the file. */
static fst_status read_set(const fst_hdf5_session *s, const char *path, const char *name, int dimensions,
                           hsize_t *sizes, char unit[FST_HDF5_UNIT_SIZE], double **numbers, fst_error *error)
{
    const hid_t set = H5Dopen2(s->file, name, H5P_DEFAULT);
    if (set < 0)
        return fst_fail(
            error, FST_BAD_INPUT, path,
            "the data set %s is missing: a map has x, y, z (where it is known) and B, with the attribute "
            "units each",
            name);
    const hid_t space = H5Dget_space(set), type = H5Dget_type(set);
    hsize_t there[8] = {0}, all = 1;
    const int rank = space >= 0 ? H5Sget_simple_extent_ndims(space) : -1;
    int fits = rank == dimensions && H5Sget_simple_extent_dims(space, there, NULL) >= 0 && type >= 0 &&
               (H5Tget_class(type) == H5T_FLOAT || H5Tget_class(type) == H5T_INTEGER);
    for (int i = 0; i < dimensions && fits; ++i) {
        fits = (sizes[i] == 0 || sizes[i] == there[i]) && there[i] > 0 && there[i] <= FST_HDF5_MAP_LIMIT &&
               all <= 3 * FST_HDF5_MAP_LIMIT / there[i];
        sizes[i] = there[i];
        all *= there[i];
    }
    fst_status status = FST_OK;
    if (!fits)
        status = fst_fail(
            error, FST_BAD_INPUT, path,
            "the data set %s has not the shape of a map: x, y, z are lists, and B is ny x nx x 3 or, with "
            "several z, nz x ny x nx x 3 numbers",
            name);
    else if (H5Dget_storage_size(set) == 0)
        status = fst_fail(error, FST_BAD_INPUT, path, "the data set %s is empty", name);
    else if (!(*numbers = malloc((size_t)all * sizeof **numbers)))
        status = fst_fail(error, FST_NO_MEMORY, path, "no memory for the data set %s", name);
    else if (H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, *numbers) < 0)
        status = fst_fail(error, FST_BAD_INPUT, path, "the data set %s is damaged", name);
    if (status == FST_OK)
        read_units(set, unit);
    fst_hdf5_close(type, space);
    (void)H5Dclose(set);
    return status;
}

/* The rank of B, 3 or 4; another where there is no such data set. */
static int rank_of_field(const fst_hdf5_session *s)
{
    const hid_t set = H5Dopen2(s->file, "B", H5P_DEFAULT), space = set >= 0 ? H5Dget_space(set) : -1;
    const int rank = space >= 0 ? H5Sget_simple_extent_ndims(space) : 3;
    if (space >= 0)
        (void)H5Sclose(space);
    if (set >= 0)
        (void)H5Dclose(set);
    return rank;
}

fst_status fst_hdf5_read_map(const char *path, const char *bytes, size_t size, fst_hdf5_map *map,
                             fst_error *error)
{
    static const char *const names[] = {"x", "y", "z"};
    fst_hdf5_session s;
    memset(map, 0, sizeof *map);
    fst_status status = FST_OK;
    fst_hdf5_session_begin(bytes, size, &s);
    if (s.starved)
        status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    else if (s.file < 0)
        status = fst_fail(error, FST_BAD_INPUT, path, "HDF5 cannot open this file: it is damaged or cut off");
    map->count[2] = 1;
    for (int axis = 0; axis < 3 && status == FST_OK; ++axis) {
        hsize_t count = 0;
        if (axis == 2 && H5Lexists(s.file, "z", H5P_DEFAULT) <= 0)
            break;
        status = read_set(&s, path, names[axis], 1, &count, map->units[axis], &map->places[axis], error);
        map->count[axis] = (size_t)count;
    }
    if (status == FST_OK) {
        const int rank = rank_of_field(&s);
        hsize_t sizes[4] = {map->count[2], map->count[1], map->count[0], 3};
        const int flat = rank == 3 && map->count[2] == 1;
        status = read_set(&s, path, "B", flat ? 3 : 4, flat ? sizes + 1 : sizes, map->units[3], &map->b, error);
    }
    fst_hdf5_session_end(&s);
    return status;
}
