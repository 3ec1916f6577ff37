/* world_orbit.h - motions of one bead that repeat themselves with the drive's period. */
#ifndef FST_ORBIT_WORLD_ORBIT_H
#define FST_ORBIT_WORLD_ORBIT_H

#include "orbit/beads_lock.h"

/* One bead, seen once a period. */
typedef struct world_strobe {
    const fst_lapack *lapack;
    const fst_progress *progress;
    fst_model *model; /* of the world; free it behind the last use */
    beads_world world;
    beads_modes modes; /* of the contact at the start of a period, to which it comes back */
    beads_flow flow;   /* of the latest period */
    double rtol;
    beads_repeat repeat; /* what Newton's method asks */
} world_strobe;

/* The world and the period of the parameters, of which `state` becomes the start. */
fst_status world_strobe_set(world_strobe *s, const fst_params *params, const fst_beads_options *options,
                            double state[BEADS_NUMBERS], fst_error *error);

/* Follow the motion of a world that world_strobe_set() has set for run.discard periods, and find the one beside it that
 * repeats itself. */
fst_status world_strobe_find(world_strobe *s, const fst_params *params, const double *state, beads_lock *lock,
                             fst_error *error);

/* A multiplier of its exponent. */
void world_multiplier(const beads_lock *lock, double period, int i, double *re, double *im);

#endif
