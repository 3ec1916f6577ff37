/* run_beads.h - festoon run of a scene that lists beads. */
#ifndef FST_CLI_RUN_BEADS_H
#define FST_CLI_RUN_BEADS_H

#include <festoon/bead_files.h>

#include "cli/command.h"

fst_status run_beads(const arguments *given, const fst_params *scene, FILE *out, fst_error *error);

/* Print the numbers of the run in words and tables; as given: in units of the laboratory. */
void print_beads(FILE *out, const fst_params *scene, const fst_beads_result *result, fst_shown_units units);

#endif
