/* run_world.h - festoon run of a bead in three dimensions. */
#ifndef FST_CLI_RUN_WORLD_H
#define FST_CLI_RUN_WORLD_H

#include "cli/command.h"

fst_status run_world(const arguments *given, const fst_params *params, FILE *out, fst_error *error);

#endif
