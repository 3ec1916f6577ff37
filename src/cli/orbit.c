/* orbit.c - festoon orbit: the periodic orbit to which a start leads, or the one with a given number of
 * festoons. */
#include "cli/beads_orbits.h"
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    UNITS_JSON_OPTION,
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

static void print_motion(const page *p, const fst_run_result *m)
{
    print_shown(p, "period", &m->period, 1, "period", "1/gamma");
    print_shown(p, "<r>, delta r", (const double[]){m->mean_r, m->std_r}, 2, "mean_r", "l");
    print_shown(p, "r from, to", (const double[]){m->min_r, m->max_r}, 2, "min_r", "l");
    print_shown(p, "<alpha'>", &m->mean_alpha_dot, 1, "mean_alpha_dot", "gamma");
    (void)fprintf(p->out,
                  "  <n_z>                     %.12g\n"
                  "  greatest angle(n, B)      %.10g degrees\n"
                  "  tilt of the plane of n    %.10g degrees\n",
                  unsigned_zero(m->mean_nz, ALL_DIGITS), m->max_angle_deg, m->tilt_deg);
}

static void print_orbit(const page *p, const fst_orbit *o)
{
    FILE *out = p->out;
    const fst_run_result *m = &o->means;
    const char *symmetry = fst_symmetry_name(o->symmetry);
    (void)fprintf(out, "omega = %.12g (%.9g Hz): %s%s%s, %s\n", m->omega, m->frequency_hz, kind_of(o),
                  symmetry ? ", symmetry " : "", symmetry ? symmetry : "", o->stable ? "stable" : "unstable");
    if (o->turns != 0)
        (void)fprintf(out, "  festoons N                %.12g\n", m->festoons);
    print_motion(p, m);
    if (m->min_load_weights <= 0)
        (void)fprintf(out, "  the normal load vanishes on it (least %.4g weights): the bead would lift off\n",
                      m->min_load_weights);
    (void)fprintf(out, "  multipliers of the %s map:", o->symmetry == FST_SYMMETRY_S2 ? "half" : "full");
    for (int i = 0; i < FST_MULTIPLIER_COUNT; ++i)
        (void)fprintf(out, " %.4g%s%.4gi", unsigned_zero(o->multiplier_re[i], ALL_DIGITS),
                      o->multiplier_im[i] < 0 ? "-" : "+", fabs(o->multiplier_im[i]));
    (void)fprintf(out, "\n");
    if (isfinite(o->relaxation_time))
        print_shown(p, "relaxation time", &o->relaxation_time, 1, "relaxation_time", "1/gamma");
    if (isfinite(o->swing_ratio))
        (void)fprintf(out, "  p, ratio of swings - 1    %.10g\n", o->swing_ratio);
    (void)fprintf(out, "  residual %.2g, flow direction mapped onto itself to %.2g\n", o->residual,
                  o->trivial_error);
}

static fst_status with_festoons(const arguments *given, const fst_params *params, const page *p,
                                fst_error *error)
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
        status = print_and_free(
            fst_orbit_json(params, &list.orbits[0], list.orbits + 1, list.count - 1, p->units), p->out, error);
    else
        for (size_t i = 0; i < list.count; ++i)
            print_orbit(p, &list.orbits[i]);
    fst_festoons_free(&list);
    return status;
}

static void print_world(const page *p, const fst_world_orbit *orbit)
{
    FILE *out = p->out;
    (void)fprintf(out, "a motion with the period of the drive, %s\n", orbit->stable ? "stable" : "unstable");
    print_shown(p, "period", &orbit->period, 1, "period", "1/gamma");
    (void)fprintf(out, "  state in the frame of the %s:\n",
                  orbit->frame == FST_FRAME_LABORATORY ? "laboratory" : "turning magnet");
    print_shown(p, "  place", orbit->state, 3, "X", "l");
    print_shown(p, "  velocity", orbit->state + 3, 3, "vX", "l gamma");
    print_shown(p, "  direction of the moment", orbit->state + 6, 3, "nX", "");
    print_shown(p, "  angular velocity", orbit->state + 9, 3, "WX", "gamma");
    (void)fprintf(out, "  multipliers:");
    for (int i = 0; i < orbit->count; ++i)
        (void)fprintf(out, " %.4g%s%.4gi", unsigned_zero(orbit->multipliers[i][0], ALL_DIGITS),
                      orbit->multipliers[i][1] < 0 ? "-" : "+", fabs(orbit->multipliers[i][1]));
    (void)fprintf(out, "\n  residual %.2g\n", orbit->residual);
}

/* The motion of a world that repeats itself with the drive. */
static fst_status of_world(const arguments *given, const fst_params *params, const page *p, fst_error *error)
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
        return print_and_free(fst_world_orbit_json(params, &orbit, p->units), p->out, error);
    print_world(p, &orbit);
    return FST_OK;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_orbit orbit;
    page p = {.out = out};
    fst_status status = read_units(given, &p.units, error);
    if (status == FST_OK)
        status = read_scene(given, operand(given), &params, error);
    if (status != FST_OK)
        return status;
    p.scales = fst_scales_of(&params);
    if (params.bead_count || (fst_key_of_world(&params) && !fst_key_of_surroundings(&params)))
        return orbit_of_beads(given, &params, &p, error);
    warn_of_material(&params);
    if (fst_key_of_world(&params))
        return of_world(given, &params, &p, error);
    if (option_value(given, "festoons"))
        return with_festoons(given, &params, &p, error);
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    progress_begin(&line);
    status = fst_orbit_find(&params, &progress, &orbit, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_orbit_json(&params, &orbit, NULL, 0, p.units), out, error);
    print_orbit(&p, &orbit);
    return FST_OK;
}

const command orbit_command = {
    .name = "orbit",
    .synopsis = "[SCENE.yaml] [--festoons N] [--json] [--units U]",
    .summary = "The periodic orbit that the start leads to, exactly, with its multipliers",
    .details = "With --festoons the drive is solved for: the lowest omega at which a stable pattern closes "
               "after N festoons, and\n"
               "the others.  docs/inside/orbits.md explains how.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
