/* run.c - festoon run: simulate a scene and describe the motion. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/groups.h"
#include "cli/run_beads.h"
#include "cli/run_files.h"
#include "cli/run_report.h"
#include "cli/run_world.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"output", 'o', "FILE", "write the trajectory to FILE.h5 (HDF5) or FILE.csv"},
    {"csv", '\0', "FILE", "write the trajectory to FILE.csv too"},
    UNITS_JSON_OPTION,
    {"sample-rate", '\0', "F",
     "samples of the trajectory a second, as a camera takes them, instead of run.samples a turn"},
    {"ramp", '\0', "FROM:TO",
     "slow ramp of the drive after the discard: 7:20 or 420rpm:1200rpm, or omega=0.2:0.4"},
    {"ramp-points", '\0', "N", "pieces of the ramp over which means are taken (64)"},
    {"ramp-wait", '\0', "TURNS",
     "longest wait half way through each piece, in turns, for the motion to settle (1000; 0: a steady ramp)"},
    {"ramp-disturbance", EXPERT, "SIZE",
     "scaled disturbance of the velocities when a wait begins, so that the motion leaves unstable states "
     "(1e-6)"},
    {NULL, '\0', NULL, NULL},
};

/* Where the samples and ramp points of a run go. */
typedef struct run_outputs {
    fst_trajectory *files[2];
    const char *paths[2];
    fst_ramp_point *ramp;
    size_t ramp_count, ramp_room;
} run_outputs;

/* ---------------------------------------------------------------- callbacks */

static fst_status take_sample(void *user, const fst_sample *sample, fst_error *error)
{
    run_outputs *outputs = user;
    fst_status status = FST_OK;
    for (int i = 0; i < 2 && status == FST_OK; ++i)
        if (outputs->files[i])
            status = fst_trajectory_append(outputs->files[i], sample, error);
    return status;
}

static fst_status take_ramp_point(void *user, const fst_ramp_point *point, fst_error *error)
{
    run_outputs *outputs = user;
    if (outputs->ramp_count == outputs->ramp_room) {
        size_t room = outputs->ramp_room ? 2 * outputs->ramp_room : 64;
        fst_ramp_point *longer = realloc(outputs->ramp, room * sizeof *longer);
        if (!longer)
            return fail(error, FST_NO_MEMORY, "--ramp", "out of memory");
        outputs->ramp = longer;
        outputs->ramp_room = room;
    }
    outputs->ramp[outputs->ramp_count++] = *point;
    return FST_OK;
}

/* ---------------------------------------------------------------- options */

/* Read an end of a ramp as omega. */
static fst_status read_ramp_end(const char *text, int scaled, double gamma, double *omega, fst_error *error)
{
    fst_status status = fst_parse_value(text, scaled ? FST_UNIT_NUMBER : FST_UNIT_FREQUENCY, omega, error);
    if (status != FST_OK) {
        (void)snprintf(error->where, sizeof error->where, "--ramp");
        return status;
    }
    if (!scaled)
        *omega *= TWO_PI / gamma;
    const fst_param_info *range = fst_param_at(fst_param_find("drive.omega"));
    if (!(*omega >= range->least && *omega <= range->greatest))
        return fail(error, FST_BAD_INPUT, "--ramp", "\"%.40s\" is out of range: omega must be %g to %g", text,
                    range->least, range->greatest);
    return FST_OK;
}

/* Read a number that only a ramp needs, within bounds. */
static fst_status read_of_ramp(const arguments *given, const char *name, double greatest, double *value,
                               fst_error *error)
{
    const char *text = option_value(given, name);
    char shown[32];
    (void)snprintf(shown, sizeof shown, "--%s", name);
    if (!text)
        return FST_OK;
    if (!option_value(given, "ramp"))
        return fail(error, FST_BAD_INPUT, "", "%s needs --ramp FROM:TO", shown);
    fst_status status = read_numbers(shown, text, value, 1, error);
    if (status == FST_OK && !(*value >= 0 && *value <= greatest))
        status = fail(error, FST_BAD_INPUT, shown, "\"%.40s\" must be a number from 0 to %g", text, greatest);
    return status;
}

static fst_status read_ramp(const arguments *given, double gamma, fst_run_options *run, fst_error *error)
{
    const char *text = option_value(given, "ramp"), *points = option_value(given, "ramp-points");
    if (!text)
        return points ? fail(error, FST_BAD_INPUT, "", "--ramp-points needs --ramp FROM:TO") : FST_OK;
    int scaled = strncmp(text, "omega=", 6) == 0;
    const char *from = scaled ? text + 6 : text, *colon = strchr(from, ':');
    char first[64];
    if (!colon || colon - from >= (int)sizeof first)
        return fail(error, FST_BAD_INPUT, "--ramp",
                    "\"%.60s\" must be FROM:TO, as in 7:20 (Hz) or omega=0.2:0.4", text);
    (void)snprintf(first, sizeof first, "%.*s", (int)(colon - from), from);
    fst_status status = read_ramp_end(first, scaled, gamma, &run->ramp_from, error);
    if (status == FST_OK)
        status = read_ramp_end(colon + 1, scaled, gamma, &run->ramp_to, error);
    if (status != FST_OK || !points)
        return status;
    double count = 0.0;
    const value_option row = {"ramp-points", VALUE_WHOLE, &count, 1, 100000};
    status = read_values(given, &row, 1, error);
    if (status == FST_OK)
        run->ramp_points = (int)count;
    return status;
}

/* ---------------------------------------------------------------- files */

static fst_status open_files(const arguments *given, const fst_params *params, run_outputs *outputs,
                             fst_error *error)
{
    fst_shown_units units[2];
    fst_status status = read_paths(given, outputs->paths, units, error);
    for (int i = 0; i < 2 && status == FST_OK; ++i)
        if (outputs->paths[i])
            status = fst_trajectory_create_in(outputs->paths[i], params, units[i], &outputs->files[i], error);
    return status;
}

/* Close the files: keep them for a finished or interrupted run, discard them for a failed one. */
static fst_status close_files(run_outputs *outputs, fst_status status, const fst_run_result *result,
                              fst_error *error)
{
    for (int i = 0; i < 2; ++i) {
        if (!outputs->files[i])
            continue;
        if (status != FST_OK && status != FST_INTERRUPTED) {
            fst_trajectory_discard(outputs->files[i]);
            continue;
        }
        fst_status closed = fst_trajectory_close(outputs->files[i], result, status == FST_OK, error);
        if (closed != FST_OK)
            status = closed;
        else
            tell_written(outputs->paths[i], status == FST_OK ? "" : " (incomplete)");
    }
    return status;
}

/* ---------------------------------------------------------------- the command */

static fst_status print_result(const arguments *given, const fst_params *params, const fst_run_result *result,
                               const run_outputs *outputs, FILE *out, fst_error *error)
{
    fst_shown_units units;
    fst_status status = read_units(given, &units, error);
    if (status == FST_OK && option_value(given, "json"))
        return print_and_free(fst_run_json_in(params, result, outputs->ramp, outputs->ramp_count, units), out,
                              error);
    fst_model *model = NULL;
    if (status == FST_OK)
        status = fst_field_model_new(params, NAN, &model, error);
    if (status != FST_OK)
        return status;
    const fst_groups groups = fst_model_groups(model);
    fst_model_free(model);
    if (option_value(given, "ramp"))
        print_ramp(out, &groups, result, outputs->ramp, outputs->ramp_count);
    else
        print_run(out, &groups, result, units == FST_SHOWN_SI);
    return FST_OK;
}

static fst_status run_into(const arguments *given, const fst_params *params, run_outputs *outputs, FILE *out,
                           fst_error *error)
{
    fst_run_result result;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_run_options run = fst_default_run_options();
    fst_status status = read_ramp(given, params->friction_gamma, &run, error);
    if (status == FST_OK)
        status = read_of_ramp(given, "ramp-wait", 1e6, &run.ramp_wait, error);
    if (status == FST_OK)
        status = read_of_ramp(given, "ramp-disturbance", 1e-2, &run.ramp_disturbance, error);
    if (status == FST_OK)
        status = read_sample_rate(given, params->friction_gamma, &run.sample_spacing, error);
    if (status == FST_OK)
        status = open_files(given, params, outputs, error);
    if (status == FST_OK) {
        run.sink.user = outputs;
        run.progress = &progress;
        run.sink.ramp_point = take_ramp_point;
        if (outputs->files[0] || outputs->files[1])
            run.sink.sample = take_sample;
        progress_begin(&line);
        status = fst_run(params, &run, &result, error);
        progress_end(&line);
    }
    status = close_files(outputs, status, &result, error);
    return status == FST_OK ? print_result(given, params, &result, outputs, out, error) : status;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    run_outputs outputs = {.ramp = NULL};
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK && params.bead_count)
        return run_beads(given, &params, out, error);
    if (status == FST_OK)
        warn_of_material(&params);
    if (status == FST_OK && fst_key_of_world(&params))
        return run_world(given, &params, out, error);
    if (status == FST_OK)
        status = run_into(given, &params, &outputs, out, error);
    free(outputs.ramp);
    return status;
}

const command run_command = {
    .name = "run",
    .synopsis = "[SCENE.yaml] [-o FILE.h5] [--json] [options]",
    .summary = "Simulate the bead and describe its motion",
    .details = "The means are over whole returns of the motion after run.discard drive periods.  A trajectory "
               "has run.samples\n"
               "rows in each drive period; festoon plot draws it, in scaled units.  A scene may list several "
               "beads (beads:).\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
