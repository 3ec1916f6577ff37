/* beads_listed.c - locked states, orbits and branches of the beads that a scene lists, or of its one bead. */
#include <stdlib.h>
#include <string.h>

#include "beads/setup.h"

fst_status fst_beads_locked_scene(const fst_params *scene, const fst_beads_options *options,
                                  fst_beads_locked *locked, fst_error *error)
{
    fst_params *beads;
    fst_beads_options said;
    memset(locked, 0, sizeof *locked);
    fst_status status = beads_of_scene(scene, options, &beads, &said, error);
    if (status == FST_OK)
        status = fst_beads_locked_find(beads, beads_in_scene(scene), &said, locked, error);
    free(beads);
    return status;
}

fst_status fst_beads_orbit_scene(const fst_params *scene, const fst_beads_options *options,
                                 fst_beads_orbit *orbit, fst_error *error)
{
    fst_params *beads;
    fst_beads_options said;
    memset(orbit, 0, sizeof *orbit);
    fst_status status = beads_of_scene(scene, options, &beads, &said, error);
    if (status == FST_OK)
        status = fst_beads_orbit_find(beads, beads_in_scene(scene), &said, orbit, error);
    free(beads);
    return status;
}

fst_status fst_beads_branch_scene(const fst_params *scene, const fst_beads_options *options, const char *key,
                                  double from, double to, fst_beads_branch *branch, fst_error *error)
{
    fst_params *beads;
    fst_beads_options said;
    memset(branch, 0, sizeof *branch);
    fst_status status = beads_of_scene(scene, options, &beads, &said, error);
    if (status == FST_OK)
        status = fst_beads_branch_follow(beads, beads_in_scene(scene), &said, key, from, to, branch, error);
    free(beads);
    return status;
}
