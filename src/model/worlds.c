/* worlds.c - which surroundings a setup asks for: those of a bead on a flat plate in air over a magnet that turns steadily,
 * or others, which need the engine of src/beads. */
#include "model/worlds.h"

#include <math.h>

#include "base/error.h"
#include "model/params.h"

/* A component of a vector of the scene. */
static double given(double component)
{
    return isnan(component) ? 0.0 : component;
}

const char *fst_stands_still(const fst_params *p)
{
    if (given(p->field_uniform[0]) != 0 || given(p->field_uniform[1]) != 0)
        return "field.uniform";
    if (p->plate_tilt != 0)
        return "plate.tilt";
    if (p->coil_count)
        return "coils";
    for (int i = 0; i < p->magnet_part_count && p->magnet_shape == FST_MAGNET_PARTS; ++i)
        if (p->magnet_parts[i].motion == FST_PART_FIXED)
            return "magnet.parts.motion";
    if (p->drive_waveform == FST_WAVEFORM_CARRIED || p->drive_waveform == FST_WAVEFORM_WAVE)
        return "drive.waveform";
    return NULL;
}

int fst_frame_of_world(const fst_params *p)
{
    return fst_stands_still(p) || p->world_frame == FST_FRAME_LABORATORY ? FST_FRAME_LABORATORY
                                                                         : FST_FRAME_TURNING;
}

const char *fst_key_of_surroundings(const fst_params *p)
{
    const char *still = fst_stands_still(p);
    if (still || p->drive_waveform != FST_WAVEFORM_STEADY)
        return still ? still : "drive.waveform";
    if (given(p->field_uniform[2]) != 0)
        return "field.uniform";
    return p->world_frame == FST_FRAME_LABORATORY ? "world.frame" : NULL;
}

/* The key that is given, or NULL. */
static const char *first_above_zero(const fst_params *p)
{
    const struct {
        const char *key;
        double value;
    } rows[] = {{"medium.density", p->medium_density},
                {"medium.viscosity", p->medium_viscosity},
                {"medium.drag_rate", p->medium_drag_rate},
                {"medium.spin_drag_rate", p->medium_spin_drag_rate},
                {"medium.quadratic_drag", p->medium_quadratic_drag}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        if (rows[i].value > 0)
            return rows[i].key;
    return NULL;
}

const char *fst_key_of_world(const fst_params *params)
{
    const double radius =
        isnan(params->model_eps) ? params->bead_radius : params->model_eps * params->magnet_half_length;
    if (params->plate_shape != FST_PLATE_FLAT)
        return "plate.shape";
    if (fst_key_of_surroundings(params))
        return fst_key_of_surroundings(params);
    if (fabs(params->start_position[2] - radius) > 1e-9 * params->magnet_half_length)
        return "start.position[2]";
    if (fabs(params->start_velocity[2]) > 0)
        return "start.velocity[2]";
    return first_above_zero(params);
}

fst_status fst_check_no_world(const fst_params *params, fst_error *error)
{
    const char *key = fst_key_of_world(params);
    if (!key)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, key,
                    "%s asks for a bead in three dimensions, which run, locked, orbit and branch know; this "
                    "computation is one "
                    "of a bead on a flat plate in air",
                    key);
}
