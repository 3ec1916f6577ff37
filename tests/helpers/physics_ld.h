/* physics_ld.h - the bodies of the model over long double, and finite differences accurate to its rounding. */
#ifndef FST_TESTS_PHYSICS_LD_H
#define FST_TESTS_PHYSICS_LD_H

#include "physics.h"

#include "base/real_long_double.h"

#include "base/twofold.inl"
#include "model/bodies.inl"

/* CHECK_CLOSE of long doubles: their difference is taken before it is rounded. */
#define CHECK_CLOSE_LD(actual, expected, tolerance) CHECK_CLOSE((double)((actual) - (expected)), 0.0, tolerance)

typedef fst_world_long_double world_ld;

static inline world_ld world_of(const fst_params *p)
{
    fst_model *model = model_of(p);
    const fst_groups groups = fst_model_groups(model);
    fst_model_free(model);
    return fst_make_world_long_double(p, &groups);
}

/* The numbers of a motion in a state. */
static inline fst_motion_long_double motion_of(const double *state)
{
    fst_motion_long_double motion = {.modes = fst_new_modes_long_double()};
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        motion.numbers[i] = state[i];
    return motion;
}

/* Weights of the eighth-order central difference: f'(0) = sum of w_k (f(k d) - f(-k d))/d, error d^8/630 f^(9).
 */
static const long double DIFFERENCE_WEIGHTS[4] = {4.0L / 5, -1.0L / 5, 4.0L / 105, -1.0L / 280};

#endif
