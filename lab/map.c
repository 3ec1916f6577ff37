/* map.c - a measured field that somebody gives to the page: read from a table, and the magnet of scenes that name it. */
#include "lab.h"

#include <stdio.h>

#include "base/checksum.h"
#include "base/error.h"
#include "base/text.h"
#include "io/map_points.h"

/* A file's name without its folders. */
static const char *own_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static fst_status read_table(const char *name, const char *bytes, size_t size, fst_field_map **map,
                             fst_error *error)
{
    fst_map_points points = {.path = name, .called = "line", .error = error};
    fst_status status;
    if (!fst_ends_in(name, ".csv") && !fst_ends_in(name, ".txt"))
        return fst_map_points_refuse(&points,
                                     "this page reads tables (.csv, .txt), not HDF5 or VTK: festoon run --csv "
                                     "makes one of a motion, festoon field --csv one of a field");
    status = fst_map_csv_read(bytes, size, &points);
    if (status == FST_OK)
        status = fst_map_points_arrange(&points, map);
    fst_map_points_free(&points);
    return status;
}

/* Read a map and keep it for scenes that name it, beside the one that the parameters use. */
EXPORT(lab_map) int lab_map(lab *l, const char *name, const char *bytes, int size)
{
    fst_field_map *map;
    const fst_status status = read_table(name, bytes, (size_t)size, &map, &l->error);
    if (status != FST_OK)
        return (int)status;
    lab_kept_map *slot = &l->maps[l->maps[0].map && l->maps[0].map == l->params.magnet_map];
    fst_field_map_free(slot->map);
    slot->map = map;
    l->latest = slot;
    (void)snprintf(slot->name, sizeof slot->name, "%s", own_name(name));
    (void)snprintf(slot->checksum, sizeof slot->checksum, "%016llx",
                   (unsigned long long)fst_checksum_bytes(0, bytes, (size_t)size));
    return FST_OK;
}

/* Of the map that was read last: its checksum. */
EXPORT(lab_map_checksum) const char *lab_map_checksum(const lab *l)
{
    return l->latest->checksum;
}

/* What makes the map doubtful that the parameters use, or "". */
EXPORT(lab_map_doubt) const char *lab_map_doubt(lab *l)
{
    if (!l->params.magnet_map || !fst_field_map_doubt(l->params.magnet_map, l->text, sizeof l->text))
        l->text[0] = '\0';
    return l->text;
}

static int is_meant(const lab *l, const lab_kept_map *slot)
{
    const char *checksum = l->params.magnet_checksum;
    return slot->map && strcmp(slot->name, own_name(l->params.magnet_file)) == 0 &&
           (!checksum[0] || strcmp(slot->checksum, checksum) == 0);
}

fst_status lab_lend_map(lab *l)
{
    lab_kept_map *slot = l->latest;
    if (l->params.magnet_shape != FST_MAGNET_GRID || !l->params.magnet_file[0])
        return FST_OK;
    for (int i = 0; i < 2 && slot && !is_meant(l, slot); ++i)
        slot = &l->maps[i];
    if (slot && !is_meant(l, slot))
        slot = l->latest; /* for a map of the name whose content is another */
    if (slot && strcmp(slot->name, own_name(l->params.magnet_file)) == 0)
        return fst_map_lend(&l->params, slot->map, slot->checksum, &l->error);
    return fst_fail(&l->error, FST_BAD_INPUT, "magnet.file",
                    "the page does not have the map %s yet: drop its file here",
                    own_name(l->params.magnet_file));
}

/* B_z where a map is known, of the parameters' magnet: `side` times `side` numbers (at most 64), rows along y, over
 * the square about the disc, whose radius (l) stands behind them; NAN outside.  NULL: lab_error. */
EXPORT(lab_map_picture) const double *lab_map_picture(lab *l, int side)
{
    fst_model *model;
    if (fst_field_model_new(&l->params, NAN, &model, &l->error) != FST_OK)
        return NULL;
    const double radius = fst_model_groups(model).map_radius;
    double *out = l->rows[0], b[3], grad[3][3];
    for (int i = 0; i < side * side; ++i) {
        const double x = radius * ((2 * (i % side) + 1.0) / side - 1),
                     y = radius * ((2 * (i / side) + 1.0) / side - 1);
        fst_field(model, x, y, b, grad);
        out[i] = x * x + y * y < radius * radius ? b[2] : NAN;
    }
    out[side * side] = radius;
    fst_model_free(model);
    return out;
}
