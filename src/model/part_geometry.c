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
