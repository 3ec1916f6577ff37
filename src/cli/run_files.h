/* run_files.h - which trajectories festoon run writes. */
#ifndef FST_CLI_RUN_FILES_H
#define FST_CLI_RUN_FILES_H

#include <festoon/festoon_tools.h>

#include "cli/command.h"

/* Read --fps: the time from sample to sample, in 1/gamma; as given where it is missing. */
fst_status read_fps(const arguments *given, double gamma, double *spacing, fst_error *error);

/* Whether -o and --csv name trajectories, paths[0] and paths[1] (NULL: not given), and the units of each. */
fst_status read_paths(const arguments *given, const char *paths[2], fst_shown_units units[2], fst_error *error);

#endif
