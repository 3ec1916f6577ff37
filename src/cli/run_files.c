/* run_files.c - which trajectories festoon run writes, and how densely. */
#include "cli/run_files.h"

#include <string.h>

#include "cli/terminal.h"

static int is_csv(const char *path)
{
    const size_t length = path ? strlen(path) : 0;
    return length > 4 && strcmp(path + length - 4, ".csv") == 0;
}

fst_status read_sample_rate(const arguments *given, double gamma, double *spacing, fst_error *error)
{
    const char *text = option_value(given, "sample-rate");
    double rate;
    if (!text)
        return FST_OK;
    if (!option_value(given, "output") && !option_value(given, "csv"))
        return fail(error, FST_BAD_INPUT, "--sample-rate",
                    "it concerns a trajectory: give -o FILE or --csv FILE");
    fst_status status = read_numbers("--sample-rate", text, &rate, 1, error);
    if (status == FST_OK && !(rate >= 0.01 && rate <= 1e7))
        status =
            fail(error, FST_BAD_INPUT, "--sample-rate", "\"%.40s\" must be a number from 0.01 to 1e7", text);
    if (status == FST_OK)
        *spacing = gamma / rate;
    return status;
}

fst_status read_paths(const arguments *given, const char *paths[2], fst_shown_units units[2], fst_error *error)
{
    const char *csv = option_value(given, "csv");
    fst_status status = read_units(given, &units[1], error);
    if (status != FST_OK)
        return status;
    paths[0] = option_value(given, "output");
    paths[1] = csv;
    units[0] = !csv && is_csv(paths[0]) ? units[1] : FST_SHOWN_SCALED;
    if (csv && !is_csv(csv))
        return fail(error, FST_BAD_INPUT, "--csv", "the name \"%.200s\" must end in .csv", csv);
    if (csv && paths[0] && strcmp(csv, paths[0]) == 0)
        return fail(error, FST_BAD_INPUT, "--csv", "-o and --csv name the same file");
    return FST_OK;
}

static fst_status take_sample(void *user, const fst_beads_sample *sample, fst_error *error)
{
    bead_outputs *to = user;
    fst_status status = FST_OK;
    for (int i = 0; i < 2 && status == FST_OK; ++i)
        if (to->files[i])
            status = fst_beads_trajectory_append(to->files[i], sample, error);
    return status;
}

fst_status open_bead_files(const arguments *given, const fst_params *scene, bead_outputs *to,
                           fst_beads_options *options, fst_error *error)
{
    fst_shown_units units[2];
    *to = (bead_outputs){{NULL, NULL}, {NULL, NULL}};
    fst_status status = read_paths(given, to->paths, units, error);
    if (status == FST_OK)
        status = read_sample_rate(given, scene->friction_gamma, &options->sample_spacing, error);
    for (int i = 0; i < 2 && status == FST_OK; ++i)
        if (to->paths[i])
            status = fst_beads_trajectory_create(to->paths[i], scene, units[i], &to->files[i], error);
    options->user = to;
    options->sample = to->files[0] || to->files[1] ? take_sample : NULL;
    return status;
}

fst_status close_bead_files(bead_outputs *to, fst_status status, const fst_beads_result *beads,
                            const fst_world_result *world, fst_error *error)
{
    for (int i = 0; i < 2; ++i) {
        if (!to->files[i])
            continue;
        if (status != FST_OK && status != FST_INTERRUPTED) {
            fst_beads_trajectory_discard(to->files[i]);
            continue;
        }
        const int complete = status == FST_OK;
        const fst_status closed =
            world ? fst_world_trajectory_close(to->files[i], complete ? world : NULL, complete, error)
                  : fst_beads_trajectory_close(to->files[i], complete ? beads : NULL, complete, error);
        if (closed != FST_OK)
            status = closed;
        else
            tell_written(to->paths[i], complete ? "" : " (incomplete)");
    }
    return status;
}
