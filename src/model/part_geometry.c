/* part_geometry.c - where the parts of a magnet are: below the plate, and as an outline seen from above. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/units.h"
#include "model/model.h"
#include "model/params.h"
#include "model/part_rows.h"

/* Half the extent of a part along a direction of the magnet's frame, a unit vector. */
static double reach(const fst_magnet_part *part, const double direction[3])
{
    double axes[3][3], along[3];
    fst_set_axes_double(part->rotation, axes);
    for (int a = 0; a < 3; ++a)
        along[a] = fabs(axes[a][0] * direction[0] + axes[a][1] * direction[1] + axes[a][2] * direction[2]);
    switch (part->kind) {
    case FST_PART_CUBOID:
        return 0.5 * (part->size[0] * along[0] + part->size[1] * along[1] + part->size[2] * along[2]);
    case FST_PART_CYLINDER:
        return 0.5 * (part->size[0] * hypot(along[0], along[1]) + part->size[1] * along[2]);
    case FST_PART_SPHERE:
        return 0.5 * part->size[0];
    default:
        return 0.0;
    }
}

/* The plate's height over the reference plane, m. */
static double plate_height(const fst_params *p)
{
    const double l = p->magnet_half_length;
    if (isnan(p->model_h) && isnan(p->model_eps))
        return p->magnet_depth;
    const double centre = isnan(p->model_h) ? p->magnet_depth + p->bead_radius : p->model_h * l;
    return centre - (isnan(p->model_eps) ? p->bead_radius : p->model_eps * l);
}

fst_status fst_part_lies_below(const fst_params *params, int part, fst_error *error)
{
    static const double up[3] = {0, 0, 1};
    const fst_magnet_part *p = &params->magnet_parts[part];
    const double top = p->centre[2] + reach(p, up), plate = plate_height(params);
    if (top < plate)
        return FST_OK;
    char highest[64], limit[64], where[48];
    (void)fst_value_write(highest, sizeof highest, top, FST_UNIT_LENGTH);
    (void)fst_value_write(limit, sizeof limit, plate, FST_UNIT_LENGTH);
    (void)snprintf(where, sizeof where, "magnet.parts[%d]", part);
    return fst_fail(error, FST_BAD_INPUT, where,
                    "%s, a %s, reaches %s above the magnet's reference plane, but the plate lies at %s "
                    "(magnet.depth): a part must end below the plate",
                    where, fst_part_kind_name(p->kind), highest, limit);
}

/* ------------------------------------------------------------------ a place and the parts */

static double beyond(double coordinate, double half)
{
    return fmax(fabs(coordinate) - half, 0.0);
}

double fst_part_distance(const fst_magnet_part *part, const double place[3])
{
    double axes[3][3], d[3] = {0, 0, 0};
    fst_set_axes_double(part->rotation, axes);
    for (int a = 0; a < 3; ++a)
        for (int i = 0; i < 3; ++i)
            d[a] += axes[a][i] * (place[i] - part->centre[i]);
    const double *size = part->size;
    switch (part->kind) {
    case FST_PART_CUBOID:
        return hypot(hypot(beyond(d[0], 0.5 * size[0]), beyond(d[1], 0.5 * size[1])),
                     beyond(d[2], 0.5 * size[2]));
    case FST_PART_CYLINDER:
        return hypot(beyond(hypot(d[0], d[1]), 0.5 * size[0]), beyond(d[2], 0.5 * size[1]));
    case FST_PART_SPHERE:
        return beyond(hypot(hypot(d[0], d[1]), d[2]), 0.5 * size[0]);
    default:
        return hypot(hypot(d[0], d[1]), d[2]);
    }
}

int fst_part_touched(const fst_params *params, const double place[3], double radius)
{
    for (int i = 0; i < params->magnet_part_count; ++i)
        if (fst_part_distance(&params->magnet_parts[i], place) <= radius)
            return i;
    return -1;
}
