/* beads_orbits.h - festoon locked, orbit and branch of a scene that lists beads. */
#ifndef FST_CLI_BEADS_ORBITS_H
#define FST_CLI_BEADS_ORBITS_H

#include "cli/command.h"

fst_status locked_beads(const arguments *given, const fst_params *scene, const page *p, fst_error *error);
fst_status orbit_of_beads(const arguments *given, const fst_params *scene, const page *p, fst_error *error);
fst_status branch_of_beads(const arguments *given, const fst_params *scene, const fst_branch_options *o,
                           const page *p, fst_error *error);

#endif
