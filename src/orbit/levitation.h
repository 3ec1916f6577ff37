/* levitation.h - places where a bead floats without a plate, in the room that looks for them and follows them. */
#ifndef FST_ORBIT_LEVITATION_H
#define FST_ORBIT_LEVITATION_H

#include "orbit/beads_lock.h"

/* Describe an equilibrium. */
void levitation_describe(const beads_world *world, const fst_groups *g, const beads_lock *lock,
                         fst_levitation *out);

/* The world of the parameters, whose model is to be freed after it; of a bead without a plate. */
fst_status levitation_world(const fst_params *params, fst_model **model, beads_world *world, fst_error *error);

/* Whether a branch is of one bead in three dimensions. */
static inline int fst_branch_is_of_world(fst_branch_kind kind)
{
    return kind == FST_BRANCH_LEVITATING || kind == FST_BRANCH_DRIVEN;
}

/* Follow places, or motions with the drive's period, over a parameter, for fst_branch_follow() (world_branch.c). */
fst_status fst_follow_world(const fst_params *params, const fst_branch_options *options, fst_branch *branch,
                            fst_error *error);

#endif
