/* orbit.c - festoon orbit: the periodic orbit to which a start leads, or the one with a given number of
 * festoons. */
#include "cli/beads_orbits.h"
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {"festoons", '\0', "N",
     "find the drive at which a stable pattern closes in the laboratory after N festoons"},
    {NULL, '\0', NULL, NULL},
};

static const char *kind_of(const fst_orbit *orbit)
{
    return orbit->turns == 0                 ? "librates: the bead swings about a direction of the magnet"
           : orbit->means.mean_alpha_dot < 0 ? "counter-rotates"
                                             : "corotates";
}

static void print_orbit(FILE *out, const fst_orbit *o)
{
    const fst_run_result *m = &o->means;
    const char *symmetry = fst_symmetry_name(o->symmetry);
    (void)fprintf(out, "omega = %.12g (%.9g Hz): %s%s%s, %s\n", m->omega, m->frequency_hz, kind_of(o),
                  symmetry ? ", symmetry " : "", symmetry ? symmetry : "", o->stable ? "stable" : "unstable");
    if (o->turns != 0)
        (void)fprintf(out, "  festoons N                %.12g\n", m->festoons);
    (void)fprintf(out,
                  "  period                    %.12g 1/gamma\n"
                  "  <r>, delta r              %.12g, %.12g l\n"
                  "  r from, to                %.12g, %.12g l\n"
                  "  <alpha'>                  %.12g gamma\n"
                  "  <n_z>                     %.12g\n"
                  "  greatest angle(n, B)      %.10g degrees\n"
                  "  tilt of the plane of n    %.10g degrees\n",
                  m->period, m->mean_r, m->std_r, m->min_r, m->max_r,
                  unsigned_zero(m->mean_alpha_dot, ALL_DIGITS), unsigned_zero(m->mean_nz, ALL_DIGITS),
                  m->max_angle_deg, m->tilt_deg);
    if (m->min_load_weights <= 0)
        (void)fprintf(out, "  the normal load vanishes on it (least %.4g weights): the bead would lift off\n",
                      m->min_load_weights);
    (void)fprintf(out, "  multipliers of the %s map:", o->symmetry == FST_SYMMETRY_S2 ? "half" : "full");
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i)
        (void)fprintf(out, " %.4g%s%.4gi", unsigned_zero(o->multiplier_re[i], ALL_DIGITS),
                      o->multiplier_im[i] < 0 ? "-" : "+", fabs(o->multiplier_im[i]));
    if (isfinite(o->relaxation_time))
        (void)fprintf(out, "\n  relaxation time           %.10g 1/gamma", o->relaxation_time);
    if (isfinite(o->swing_ratio))
        (void)fprintf(out, "\n  p, ratio of swings - 1    %.10g", o->swing_ratio);
    (void)fprintf(out, "\n  residual %.2g, flow direction mapped onto itself to %.2g\n", o->residual,
                  o->trivial_error);
}

static fst_status with_festoons(const arguments *given, const fst_params *params, FILE *out, fst_error *error)
{
    double wanted;
    fst_festoon_list list;
    fst_status status = read_numbers("--festoons", option_value(given, "festoons"), &wanted, 1, error);
    if (status != FST_OK)
        return status;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    status = fst_festoons_find(params, wanted, &progress, &list, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        status = print_and_free(fst_orbit_json(params, &list.orbits[0], list.orbits + 1, list.count - 1), out,
                                error);
    else
        for (size_t i = 0; i < list.count; ++i)
            print_orbit(out, &list.orbits[i]);
    fst_festoons_free(&list);
    return status;
}

/* The motion of a world that repeats itself with the drive. */
static fst_status of_world(const arguments *given, const fst_params *params, FILE *out, fst_error *error)
{
    fst_world_orbit orbit;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_beads_options run = fst_default_beads_options();
    if (option_value(given, "festoons"))
        return fail(error, FST_BAD_INPUT, "--festoons",
                    "festoons are counted against a magnet that turns steadily and alone under a flat plate, "
                    "not with %s",
                    fst_key_of_world(params));
    run.progress = &progress;
    progress_begin(&line);
    const fst_status status = fst_world_orbit_find(params, &run, &orbit, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_world_orbit_json(params, &orbit), out, error);
    (void)fprintf(out, "a motion with the period of the drive, %s\n  period                    %.12g 1/gamma\n",
                  orbit.stable ? "stable" : "unstable", orbit.period);
    (void)fprintf(out, "  state in the frame of the %s:\n   ",
                  orbit.frame == FST_FRAME_LABORATORY ? "laboratory" : "turning magnet");
    for (int i = 0; i < FST_BEAD_NUMBERS; ++i)
        (void)fprintf(out, " %.10g", unsigned_zero(orbit.state[i], ALL_DIGITS));
    (void)fprintf(out, "\n  multipliers:");
    for (int i = 0; i < orbit.count; ++i)
        (void)fprintf(out, " %.4g%s%.4gi", unsigned_zero(orbit.multipliers[i][0], ALL_DIGITS),
                      orbit.multipliers[i][1] < 0 ? "-" : "+", fabs(orbit.multipliers[i][1]));
    (void)fprintf(out, "\n  residual %.2g\n", orbit.residual);
    return FST_OK;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_orbit orbit;
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status != FST_OK)
        return status;
    if (params.bead_count || (fst_key_of_world(&params) && !fst_key_of_surroundings(&params)))
        return orbit_of_beads(given, &params, out, error);
    warn_of_material(&params);
    if (fst_key_of_world(&params))
        return of_world(given, &params, out, error);
    if (option_value(given, "festoons"))
        return with_festoons(given, &params, out, error);
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    status = fst_orbit_find(&params, &progress, &orbit, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_orbit_json(&params, &orbit, NULL, 0), out, error);
    print_orbit(out, &orbit);
    return FST_OK;
}

const command orbit_command = {
    .name = "orbit",
    .synopsis = "[SCENE.yaml] [--festoons N] [--json]",
    .summary = "The periodic orbit that the start leads to, exactly, with its multipliers",
    .details = "With --festoons the drive is solved for: the lowest omega at which a stable pattern closes "
               "after N festoons, and\n"
               "the others.  docs/inside/orbits.md explains how.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
