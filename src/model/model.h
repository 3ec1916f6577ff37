/* model.h - the model over double, for the rooms that integrate it. */
#ifndef FST_MODEL_MODEL_H
#define FST_MODEL_MODEL_H

#include <festoon/festoon.h>
#include "base/real_double.h"

#include "model/bodies.inl"

struct fst_model {
    fst_params params;
    fst_groups groups;
    fst_coefficients_double coefficients;
    fst_field_map *map; /* of a measured field, which the coefficients point into; else NULL */
    int has_s2;         /* whether the magnet's field has the symmetry S2: B(-X, -Y) = (B_X, B_Y, -B_Z)(X, Y) */
};

/* The angle between n and B from gap2 = |n - B/|B||^2, rad. */
double fst_angle_of_gap(double gap2);

/* The public observation of a state at the drive omega. */
fst_observation fst_observe_double(const fst_coefficients_double *c, double omega, const double *state);

#endif
