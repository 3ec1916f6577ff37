/* run_beads.c - festoon run of a scene that lists beads: their trajectory, and what is told of them. */
#include "cli/run_beads.h"

#include "cli/run_files.h"
#include "cli/terminal.h"

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
    bead_outputs to = {{NULL, NULL}, {NULL, NULL}};
    fst_shown_units units = FST_SHOWN_AS_GIVEN;
    fst_beads_result result = {.count = 0};
    fst_beads_options options = fst_default_beads_options();
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_status status = refuse_options(given, error);
    if (status == FST_OK)
        status = read_units(given, &units, error);
    if (status == FST_OK)
        status = open_bead_files(given, scene, &to, &options, error);
    if (status == FST_OK) {
        options.progress = &progress;
        progress_begin(&line);
        status = fst_beads_run_scene(scene, &options, &result, error);
        progress_end(&line);
    }
    status = close_bead_files(&to, status, &result, NULL, error);
    if (status == FST_OK && option_value(given, "json"))
        status = print_and_free(fst_beads_json(scene, &result, units), out, error);
    else if (status == FST_OK)
        print_beads(out, scene, &result, units);
    fst_beads_free(&result);
    return status;
}
