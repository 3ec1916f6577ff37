/* model.h - the model over double, for the rooms that integrate it. */
#ifndef FST_MODEL_MODEL_H
#define FST_MODEL_MODEL_H

#include <festoon/festoon.h>
#include "base/compensated.h"

#include "model/bodies.inl"

struct fst_model {
    fst_params params; /* settled: each quantity has one form (forms.h) */
    fst_groups groups;
    fst_world_double world;
    fst_field_map *map; /* of a measured field, which the world points into; else NULL */
    int has_s2;         /* whether the magnet's field has the symmetry S2: B(-X, -Y) = (B_X, B_Y, -B_Z)(X, Y) */
    double bowl;        /* for fst_field(), where a bead's centre stays on a sphere: its radius; else 0 */
    struct fst_surroundings
        *surroundings; /* for fst_field(), where more than a turning magnet makes it, or at a time; else NULL */
    double field_time; /* of fst_field(); NAN: 0, on the magnet's axes */
};

/* The height of a bead's centre on the plate over the magnet's reference plane, in l. */
double fst_bead_height(const fst_params *p);

/* How much higher than in the middle a bead's centre lies at the distance r from the axis of a bowl, in which it stays on
 * a sphere of the radius rho; NAN beyond it. */
static inline double fst_bowl_rise(double rho, double r)
{
    return r < rho ? rho - sqrt(rho * rho - r * r) : NAN;
}

/* fst_field_model_new() into memory of the caller, who frees `map`; without surroundings. */
fst_status fst_model_fill(const fst_params *params, double height, fst_model *model, fst_error *error);

/* The angle between n and B from gap2 = |n - B/|B||^2, rad. */
double fst_angle_of_gap(double gap2);

/* The public observation of a motion at the drive omega. */
fst_observation fst_observe_motion(const fst_world_double *c, const fst_motion_double *motion, double omega);

#endif
