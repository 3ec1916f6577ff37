/* locked.c - festoon locked: every state in which the bead goes round with the magnet. */
#include "cli/beads_orbits.h"
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    {NULL, '\0', NULL, NULL},
};

/* Phi in degrees; a bead on the axis has none. */
static const char *angle_text(double degrees, char text[32])
{
    if (!isfinite(degrees))
        return "any";
    (void)snprintf(text, 32, "%.4f", degrees < -179.99995 ? 180.0 : unsigned_zero(degrees, 4));
    return text;
}

static void print_list(FILE *out, double omega, int dry, const fst_locked_list *list)
{
    (void)fprintf(out, "omega = %.10g: %zu locked states from %d starts, sum of indices %d\n\n", omega,
                  list->count, list->starts, list->index_sum);
    if (list->truncated)
        (void)fprintf(
            out,
            "There are more: without friction, torque or remanence locked states form continua, and these are "
            "members of them.\n\n");
    else if (list->index_sum != 2 && !dry)
        (void)fprintf(
            out,
            "The sum of indices is 2 where all states are found and none is a member of a continuum: this list "
            "may lack some.\n\n");
    (void)fprintf(out, "%14s %10s  %26s  %28s %14s %12s\n", "r (l)", "Phi (deg)", "n", "W (gamma)",
                  "slip (l gamma)", "max Re");
    int stable = 0;
    for (size_t i = 0; i < list->count; ++i) {
        const fst_locked *l = &list->states[i];
        double greatest = l->eigenvalue_re[0];
        for (int k = 1; k < FST_EIGENVALUE_COUNT; ++k)
            greatest = fmax(greatest, l->eigenvalue_re[k]);
        char phi[32];
        (void)fprintf(out, "%14.10f %10s ", unsigned_zero(l->r, 10), angle_text(l->bead_angle_deg, phi));
        for (int k = FST_NX; k <= FST_WZ; ++k)
            (void)fprintf(out, "%s%*.5f", k == FST_WX ? " " : "", k < FST_WX ? 9 : 10,
                          unsigned_zero(l->state[k], 5));
        (void)fprintf(out, " %14.6g %12.5g  %s\n", unsigned_zero(l->slip, 12), greatest,
                      l->stable ? "stable" : "unstable");
        stable += l->stable != 0;
    }
    if (list->count > 0 && stable == 0)
        (void)fprintf(out, "\nNone is stable: a bead that is disturbed leaves each of them.\n");
}

static void print_families(FILE *out, const fst_locked_list *list)
{
    (void)fprintf(out,
                  "\n%zu families of locked beads whose contact does not slip, from one end to the other:\n",
                  list->family_count);
    if (list->family_count > 0)
        (void)fprintf(out, "%14s %10s  %17s  %19s %10s  %s\n", "r (l)", "Phi (deg)", "n_X, n_Z",
                      "W_X, W_Z (gamma)", "|f|/(mu N)", "ends by");
    for (size_t i = 0; i < 2 * list->family_count; ++i) {
        const fst_rolling_family *family = &list->families[i / 2];
        const fst_rolling_lock *l = i % 2 ? &family->to : &family->from;
        char phi[32];
        (void)fprintf(out, "%14.10f %10s  %8.5f %8.5f  %9.5f %9.5f %10.6f  %s%s\n", unsigned_zero(l->r, 10),
                      angle_text(l->bead_angle_deg, phi), unsigned_zero(l->state[FST_NX], 5),
                      unsigned_zero(l->state[FST_NZ], 5), unsigned_zero(l->state[FST_WX], 5),
                      unsigned_zero(l->state[FST_WZ], 5), l->use, fst_rolling_end_name(l->end),
                      i % 2 ? "\n" : "");
    }
}

/* Where a bead floats without a plate. */
static fst_status find_levitation(const arguments *given, const fst_params *params, FILE *out, fst_error *error)
{
    fst_levitation_list list;
    const fst_status status = fst_levitation_find(params, NULL, &list, error);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json")) {
        char *text = fst_levitation_json(params, &list);
        fst_levitation_free(&list);
        return print_and_free(text, out, error);
    }
    (void)fprintf(out, "%zu places where the bead floats, at rest in the turning frame\n\n", list.count);
    if (list.count)
        (void)fprintf(out, "%12s %12s %12s %12s %16s\n", "height (mm)", "gap (mm)", "tilt (deg)", "circle (mm)",
                      "max Re (1/s)");
    for (size_t i = 0; i < list.count; ++i) {
        const fst_levitation *l = &list.states[i];
        (void)fprintf(out, "%12.5f %12.5f %12.5f %12.5f %16.6g  %s, %s the magnet\n", l->height_mm, l->gap_mm,
                      l->tilt_deg, l->circle_mm, unsigned_zero(l->eigenvalue_re[0], ALL_DIGITS),
                      l->stable ? "stable" : "unstable",
                      l->state[2] * (params->plate_gravity < 0 ? -1.0 : 1.0) > 0 ? "above" : "below");
    }
    if (list.count && list.states[0].family)
        (void)fprintf(
            out, "\nNothing slows the bead's turning: its spin about its moment is conserved, and these places "
                 "are those\nwithout spin, each one of a family.\n");
    fst_levitation_free(&list);
    return FST_OK;
}

static fst_status perform(const arguments *given, FILE *out, fst_error *error)
{
    fst_params params;
    fst_locked_list list;
    fst_model *model = NULL;
    fst_status status = read_scene(given, operand(given), &params, error);
    if (status == FST_OK && params.plate_shape == FST_PLATE_NONE)
        return find_levitation(given, &params, out, error);
    if (status == FST_OK && (params.bead_count || fst_key_of_world(&params)))
        return locked_beads(given, &params, out, error);
    if (status == FST_OK)
        status = fst_model_new(&params, &model, error);
    if (status == FST_OK) {
        warn_of_material(&params);
        progress_line line;
        const fst_progress progress = {&line, progress_tell};
        progress_begin(&line);
        status = fst_locked_find(&params, &progress, &list, error);
        progress_end(&line);
    }
    if (status == FST_OK) {
        const double omega = fst_model_groups(model).omega;
        if (option_value(given, "json"))
            status = print_and_free(fst_locked_json(&params, omega, &list), out, error);
        else
            print_list(out, omega,
                       params.friction_law == FST_FRICTION_COULOMB ||
                           params.friction_law == FST_FRICTION_ROLLING,
                       &list);
        if (!option_value(given, "json") &&
            (params.friction_law == FST_FRICTION_COULOMB || params.friction_law == FST_FRICTION_ROLLING))
            print_families(out, &list);
        fst_locked_free(&list);
    }
    fst_model_free(model);
    return status;
}

const command locked_command = {
    .name = "locked",
    .synopsis = "[SCENE.yaml] [--json]",
    .summary = "Every equilibrium of the turning frame: the bead goes round with the magnet",
    .details =
        "Vectors are inertial, in components along the magnet's axes.  docs/inside/orbits.md says why the list "
        "is believed to be\n"
        "complete.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
