/* setup.h - from parameters to a world of several beads and its start. */
#ifndef FST_BEADS_SETUP_H
#define FST_BEADS_SETUP_H

#include "beads/world.h"

#define FST_BEADS_OPTIONS_COOKIE 0xfe570006u

/* Make the world of these beads and the numbers they start with.  *model, of the first bead, is the world's
 * source: free it after the world is no longer used. */
fst_status beads_set_up(const fst_params *beads, int count, const fst_beads_options *options, fst_model **model,
                        beads_world *world, double *state, fst_error *error);

/* The beads of a scene's list, as parameters of their own (free them), and the options with what its keys say. */
fst_status beads_of_scene(const fst_params *scene, const fst_beads_options *options, fst_params **beads,
                          fst_beads_options *said, fst_error *error);

#endif
