/* run_world.c - festoon run of a bead in three dimensions: in a bowl, in a medium, without a plate. */
#include "cli/run_world.h"

#include <festoon/festoon_tools.h>

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

/* Three numbers in SI, which are called `key` in tables; `unit` is their scaled one. */
static void print_vector(const page *p, const char *name, const double v[3], const char *key, const char *unit)
{
    const char *shown;
    double factor = 1.0 / fst_number_shown(key, unit, FST_SHOWN_SI, &p->scales, &shown);
    factor *= fst_number_shown(key, unit, p->units, &p->scales, &shown);
    (void)fprintf(p->out, "  %-32s %12.6g %12.6g %12.6g  %s\n", name, factor * v[0], factor * v[1],
                  factor * v[2], shown);
}

/* A scaled number; the units of a pure one are words. */
static void print_line(const page *p, const char *name, double value, const char *key, const char *unit)
{
    const char *shown;
    const double factor = fst_number_shown(key, unit, p->units, &p->scales, &shown);
    if (isfinite(value))
        (void)fprintf(p->out, "  %-32s %12.6g  %s\n", name, factor * value, shown);
}

static void print_world(const fst_params *params, const fst_world_result *result, fst_shown_units units,
                        FILE *out)
{
    const page shown = {out, units == FST_SHOWN_AS_GIVEN ? FST_SHOWN_LAB : units, fst_scales_of(params)},
               *p = &shown;
    const fst_run_result *run = &result->run;
    const double *end = result->final_lab_si;
    const char *second;
    const double time = fst_unit_shown("1/gamma", p->units, &p->scales, &second);
    (void)fprintf(out, "%s: %s\n\n", fst_regime_name(run->regime), run->reason);
    (void)fprintf(out, "  %.6g periods of the drive (%.6g %s), in the frame of the %s", run->periods,
                  result->final_time * time, second,
                  result->frame == FST_FRAME_LABORATORY ? "laboratory" : "turning magnet");
    if (isfinite(run->window_periods))
        (void)fprintf(out, ", means and powers over the last %.6g, in which the bead's own energy may change",
                      run->window_periods);
    (void)fprintf(out, "\n");
    print_line(p, "mean distance from the axis", run->mean_r, "mean_r", "l");
    print_line(p, "limit of its error", run->mean_r_error, "mean_r_error", "l");
    print_line(p, "mean height", result->mean_height, "mean_height", "l");
    print_line(p, "bead's circling <alpha'>", run->mean_alpha_dot, "mean_alpha_dot", "gamma");
    print_line(p, "limit of its error", run->mean_alpha_dot_error, "mean_alpha_dot_error", "gamma");
    print_line(p, "mean velocity along the wave", result->mean_velocity, "mean_velocity", "l gamma");
    print_line(p, "limit of its error", result->mean_velocity_error, "mean_velocity_error", "l gamma");
    print_line(p, "load on the plate", run->mean_load_weights, "mean_load_weights", "weights");
    print_line(p, "power of the drive", run->mean_drive_power, "mean_drive_power", "l^2 gamma^3");
    print_line(p, "power lost to friction", run->mean_friction_power, "mean_friction_power", "l^2 gamma^3");
    print_line(p, "power lost to the medium", result->mean_medium_power, "mean_medium_power", "l^2 gamma^3");
    print_line(p, "energy residual", run->energy_residual, "energy_residual", "");
    (void)fprintf(out, "At the end, on the laboratory's axes:\n");
    print_vector(p, "place", end, "X", "l");
    print_vector(p, "velocity", end + 3, "vX", "l gamma");
    print_vector(p, "direction of the moment", end + 6, "nX", "");
    print_vector(p, "angular velocity", end + 9, "WX", "gamma");
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
    print_world(params, &result, units, out);
    return FST_OK;
}
