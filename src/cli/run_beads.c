/* run_beads.c - festoon run of a scene that lists beads: their trajectory, and what is told of them. */
#include "cli/run_beads.h"

#include "cli/run_files.h"
#include "cli/terminal.h"

/* Where the samples go. */
typedef struct outputs {
    fst_beads_trajectory *files[2];
    const char *paths[2];
} outputs;

static fst_status take_sample(void *user, const fst_beads_sample *sample, fst_error *error)
{
    outputs *to = user;
    fst_status status = FST_OK;
    for (int i = 0; i < 2 && status == FST_OK; ++i)
        if (to->files[i])
            status = fst_beads_trajectory_append(to->files[i], sample, error);
    return status;
}

/* Keep the files of a finished or interrupted run, discard those of a failed one. */
static fst_status close_files(outputs *to, fst_status status, const fst_beads_result *result, fst_error *error)
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
            fst_beads_trajectory_close(to->files[i], complete ? result : NULL, complete, error);
        if (closed != FST_OK)
            status = closed;
        else
            tell_written(to->paths[i], complete ? "" : " (incomplete)");
    }
    return status;
}

static fst_status refuse_options(const arguments *given, fst_error *error)
{
    static const char *const of_one[] = {"ramp", "ramp-points", "ramp-wait", "ramp-disturbance"};
    for (size_t i = 0; i < sizeof of_one / sizeof *of_one; ++i)
        if (option_value(given, of_one[i]))
            return fail(error, FST_BAD_INPUT, "",
                        "--%s is for one bead, and the scene lists several: sweep drive.frequency", of_one[i]);
    return FST_OK;
}

fst_status run_beads(const arguments *given, const fst_params *scene, FILE *out, fst_error *error)
{
    outputs to = {{NULL, NULL}, {NULL, NULL}};
    fst_shown_units units = FST_SHOWN_AS_GIVEN, of_file[2];
    fst_beads_result result = {.count = 0};
    fst_beads_options options = fst_default_beads_options();
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_status status = refuse_options(given, error);
    if (status == FST_OK)
        status = read_units(given, &units, error);
    if (status == FST_OK)
        status = read_paths(given, to.paths, of_file, error);
    if (status == FST_OK)
        status = read_fps(given, scene->friction_gamma, &options.sample_spacing, error);
    for (int i = 0; i < 2 && status == FST_OK; ++i)
        if (to.paths[i])
            status = fst_beads_trajectory_create(to.paths[i], scene, of_file[i], &to.files[i], error);
    if (status == FST_OK) {
        options.progress = &progress;
        options.user = &to;
        options.sample = to.files[0] || to.files[1] ? take_sample : NULL;
        progress_begin(&line);
        status = fst_beads_run_scene(scene, &options, &result, error);
        progress_end(&line);
    }
    status = close_files(&to, status, &result, error);
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_beads_json(scene, &result, units), out, error);
    else if (status == FST_OK)
        print_beads(out, scene, &result, units == FST_SHOWN_SI);
    fst_beads_free(&result);
    return status;
}
