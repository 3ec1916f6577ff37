/* setup.h - from parameters to a world of several beads and its start. */
#ifndef FST_BEADS_SETUP_H
#define FST_BEADS_SETUP_H

#include "beads/world.h"

#define FST_BEADS_OPTIONS_COOKIE 0xfe570006u

/* Make the world of these beads and the numbers they start with.  *model, of the first bead, is the world's
 * source: free it after the world is no longer used. */
fst_status beads_set_up(const fst_params *beads, int count, const fst_beads_options *options, fst_model **model,
                        beads_world *world, double *state, fst_error *error);

/* How many beads a scene lists; 1 of a scene without a list, whose bead needs three dimensions. */
static inline int beads_in_scene(const fst_params *scene)
{
    return scene->bead_count ? scene->bead_count : fst_key_of_world(scene) != NULL;
}

/* The beads of a scene's list, as parameters of their own (free them), and the options with what its keys say. */
fst_status beads_of_scene(const fst_params *scene, const fst_beads_options *options, fst_params **beads,
                          fst_beads_options *said, fst_error *error);

#endif
