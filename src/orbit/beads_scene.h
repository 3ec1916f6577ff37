/* beads_scene.h - several beads as a caller gives them, and the locked state to which their start leads. */
#ifndef FST_ORBIT_BEADS_SCENE_H
#define FST_ORBIT_BEADS_SCENE_H

#include "orbit/beads_lock.h"

typedef struct beads_scene {
    const fst_lapack *lapack;
    fst_model *model; /* free it behind the last use of the world */
    beads_world world;
    double state[BEADS_NUMBERS];
    double longest; /* that a start is followed: run.periods */
    const fst_progress *progress;
} beads_scene;

/* Check what orbits and locked states ask for, and set up. */
fst_status beads_scene_begin(const fst_params *beads, int count, const fst_beads_options *options,
                             beads_scene *scene, fst_error *error);

/* Follow the start until Newton's method finds a locked state beside it that attracts, and that its contacts can
 * hold. */
fst_status beads_scene_lock(const beads_scene *scene, beads_lock *lock, fst_error *error);

/* What is told of a locked state, and of the numbers of a state. */
void beads_tell_lock(const beads_world *world, const beads_lock *lock, fst_beads_locked *locked);
void beads_tell_state(const beads_world *world, const double *state, double told[][FST_BEAD_NUMBERS]);

#endif
