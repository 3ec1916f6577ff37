/* setup.h - from parameters to a world of several beads and its start. */
#ifndef FST_BEADS_SETUP_H
#define FST_BEADS_SETUP_H

#include "beads/look.h"

/* Make the world of these beads and the numbers they start with.  *model, of the first bead, is the world's
 * source: free it after the world is no longer used. */
fst_status beads_set_up(const fst_params *beads, int count, const fst_beads_options *options, fst_model **model,
                        beads_world *world, double state[BEADS_NUMBERS], fst_error *error);

#endif
