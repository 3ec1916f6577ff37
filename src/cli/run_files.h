/* run_files.h - which trajectories festoon run writes. */
#ifndef FST_CLI_RUN_FILES_H
#define FST_CLI_RUN_FILES_H

#include <festoon/bead_files.h>

#include "cli/command.h"

/* Read --sample-rate: the time from sample to sample, in 1/gamma; as given where it is missing. */
fst_status read_sample_rate(const arguments *given, double gamma, double *spacing, fst_error *error);

/* Whether -o and --csv name trajectories, paths[0] and paths[1] (NULL: not given), and the units of each. */
fst_status read_paths(const arguments *given, const char *paths[2], fst_shown_units units[2], fst_error *error);

/* The trajectories of several beads, or of one in a world. */
typedef struct bead_outputs {
    fst_beads_trajectory *files[2];
    const char *paths[2];
} bead_outputs;

/* Open the files that -o and --csv ask for, and make `options` send every sample to them. */
fst_status open_bead_files(const arguments *given, const fst_params *scene, bead_outputs *to,
                           fst_beads_options *options, fst_error *error);

/* Keep the files of a finished or interrupted run, discard those of a failed one.  One of the results is NULL. */
fst_status close_bead_files(bead_outputs *to, fst_status status, const fst_beads_result *beads,
                            const fst_world_result *world, fst_error *error);

#endif
