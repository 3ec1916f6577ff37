/* run_world.c - festoon run of a bead in three dimensions: in a bowl, in a medium, without a plate. */
#include "cli/run_world.h"

#include "cli/groups.h"
#include "cli/run_files.h"
#include "cli/terminal.h"

/* What only a bead on a flat plate in air has. */
static fst_status check_options(const arguments *given, const char *key, fst_error *error)
{
    static const char *const others[] = {"ramp", "ramp-points", "ramp-wait", "ramp-disturbance"};
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
        if (option_value(given, others[i]))
            return fail(error, FST_BAD_INPUT, "",
                        "--%s is for a bead on a flat plate in air, not with %s: festoon sweep --carry up or "
                        "down --over "
                        "drive.frequency=FROM:TO:COUNT follows a motion from drive to drive",
                        others[i], key);
    return FST_OK;
}

static void print_vector(FILE *out, const char *name, const double v[3], double factor, const char *unit)
{
    (void)fprintf(out, "  %-32s %12.6g %12.6g %12.6g  %s\n", name, factor * v[0], factor * v[1], factor * v[2],
                  unit);
}

static void print_line(FILE *out, const char *name, double value, const char *unit)
{
    if (isfinite(value))
        (void)fprintf(out, "  %-32s %12.6g  %s\n", name, value, unit);
}

static fst_status print_world(const fst_params *params, const fst_world_result *result, FILE *out,
                              fst_error *error)
{
    fst_model *model;
    const fst_run_result *run = &result->run;
    const fst_status status = fst_field_model_new(params, NAN, &model, error);
    if (status != FST_OK)
        return status;
    const fst_groups g = fst_model_groups(model);
    fst_model_free(model);
    const double *end = result->final_lab_si, mm = 1e3 * g.length_unit;
    const double watts = g.mass * g.length_unit * g.length_unit / (g.time_unit * g.time_unit * g.time_unit);
    (void)fprintf(out, "%s: %s\n\n", fst_regime_name(run->regime), run->reason);
    (void)fprintf(out,
                  "  %.6g periods of the drive (%.6g s), in the frame of the %s, means over the last %.6g\n",
                  run->periods, result->final_time * g.time_unit,
                  result->frame == FST_FRAME_LABORATORY ? "laboratory" : "turning magnet", run->window_periods);
    print_line(out, "mean distance from the axis", run->mean_r * mm, "mm");
    print_line(out, "mean height", result->mean_height * mm, "mm");
    print_line(out, "bead's circling <alpha'>", run->mean_alpha_dot / (TWO_PI * g.time_unit), "Hz");
    print_line(out, "mean velocity along the wave", result->mean_velocity * mm / g.time_unit, "mm/s");
    print_line(out, "limit of its error", result->mean_velocity_error * mm / g.time_unit, "mm/s");
    print_line(out, "load on the plate", run->mean_load_weights, "weights");
    print_line(out, "power of the drive", run->mean_drive_power * watts, "W");
    print_line(out, "power lost to friction", run->mean_friction_power * watts, "W");
    print_line(out, "power lost to the medium", result->mean_medium_power * watts, "W");
    print_line(out, "energy residual", run->energy_residual, "");
    (void)fprintf(out, "At the end, on the laboratory's axes:\n");
    print_vector(out, "place", end, 1e3, "mm");
    print_vector(out, "velocity", end + 3, 1e3, "mm/s");
    print_vector(out, "direction of the moment", end + 6, 1.0, "");
    print_vector(out, "angular velocity", end + 9, 1.0, "1/s");
    return FST_OK;
}

fst_status run_world(const arguments *given, const fst_params *params, FILE *out, fst_error *error)
{
    fst_world_result result;
    fst_shown_units units;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    bead_outputs to = {{NULL, NULL}, {NULL, NULL}};
    fst_beads_options options = fst_default_beads_options();
    fst_status status = check_options(given, fst_key_of_world(params), error);
    if (status == FST_OK)
        status = read_units(given, &units, error);
    if (status == FST_OK)
        status = open_bead_files(given, params, &to, &options, error);
    if (status == FST_OK) {
        options.progress = &progress;
        progress_begin(&line);
        status = fst_world_run(params, &options, &result, error);
        progress_end(&line);
    }
    status = close_bead_files(&to, status, NULL, &result, error);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_world_json(params, &result, units), out, error);
    return print_world(params, &result, out, error);
}
