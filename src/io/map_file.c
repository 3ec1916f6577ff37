/* map_file.c - maps of a field in files: which format, its checksum, and the map of a scene. */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

#include "base/checksum.h"
#include "base/error.h"
#include "base/text.h"
#include "host/regular_file.h"
#include "io/map_points.h"

static fst_status read_points(const char *text, size_t size, fst_map_points *points)
{
    if (fst_ends_in(points->path, ".csv") || fst_ends_in(points->path, ".txt"))
        return fst_map_csv_read(text, size, points);
    if (fst_ends_in(points->path, ".vtk"))
        return fst_map_vtk_read(text, size, points);
    if (fst_ends_in(points->path, ".vti") || fst_ends_in(points->path, ".vtr"))
        return fst_map_points_refuse(points,
                                     "VTK's XML is not read: meshio makes a file of it that is, by meshio "
                                     "convert map%s map.vtk",
                                     strrchr(points->path, '.'));
    if (fst_ends_in(points->path, ".h5") || fst_ends_in(points->path, ".hdf5"))
        return fst_map_hdf5_read(points);
    return fst_map_points_refuse(points, "the name of a map ends in .csv, .txt, .vtk or .h5");
}

fst_status fst_map_lend(fst_params *params, fst_field_map *map, const char checksum[17], fst_error *error)
{
    if (params->magnet_checksum[0] && strcmp(params->magnet_checksum, checksum) != 0)
        return fst_fail(
            error, FST_BAD_INPUT, params->magnet_file,
            "the content of this map has changed: its checksum is %s, and the scene's magnet.checksum is "
            "%s: restore the map, or remove magnet.checksum from the scene",
            checksum, params->magnet_checksum);
    memcpy(params->magnet_checksum, checksum, sizeof params->magnet_checksum);
    params->magnet_map = map;
    return FST_OK;
}

fst_status fst_field_map_read(const char *path, const fst_progress *progress, fst_field_map **map,
                              char checksum[17], fst_error *error)
{
    char *text;
    size_t size;
    fst_error unseen;
    *map = NULL;
    fst_status status = fst_read_regular(path, FST_MAP_FILE_LIMIT, &text, &size, error);
    if (status != FST_OK)
        return status;
    (void)snprintf(checksum, 17, "%016llx", (unsigned long long)fst_checksum_bytes(0, text, size));
    fst_map_points points = {
        .path = path, .called = "line", .progress = progress, .error = error ? error : &unseen};
    status = read_points(text, size, &points);
    free(text);
    if (status == FST_OK)
        status = fst_map_points_arrange(&points, map);
    fst_map_points_free(&points);
    return status;
}

fst_status fst_params_read_map(fst_params *params, const fst_progress *progress, fst_field_map **map,
                               fst_error *error)
{
    char checksum[sizeof params->magnet_checksum];
    *map = NULL;
    if (!params->magnet_file[0])
        return FST_OK;
    fst_status status = fst_field_map_read(params->magnet_file, progress, map, checksum, error);
    if (status == FST_OK)
        status = fst_map_lend(params, *map, checksum, error);
    if (status != FST_OK) {
        fst_field_map_free(*map);
        *map = NULL;
    }
    return status;
}
