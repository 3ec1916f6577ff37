/* locked.c - festoon locked: every state in which the bead goes round with the magnet. */
#include "cli/beads_orbits.h"
#include "cli/command.h"
#include "cli/terminal.h"

static const option options[] = {
    SCENE_OPTIONS,
    JSON_OPTION,
    UNITS_JSON_OPTION,
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

/* "W (gamma)": what stands in a column, and its unit; returns what its scaled numbers are multiplied by. */
static double head_of(const page *p, const char *words, const char *key, const char *unit, char head[48])
{
    const char *shown;
    const double factor = fst_number_shown(key, unit, p->units, &p->scales, &shown);
    (void)snprintf(head, 48, "%s (%s)", words, shown);
    return factor;
}

static void print_list(const page *p, double omega, int dry, const fst_locked_list *list)
{
    FILE *out = p->out;
    char heads[4][48];
    const double length = head_of(p, "r", "r", "l", heads[0]), turn = head_of(p, "W", "WX", "gamma", heads[1]);
    const double speed = head_of(p, "slip", "slip", "l gamma", heads[2]);
    const double rate = head_of(p, "max Re", "rate", "gamma", heads[3]);
    print_omega(p, omega);
    (void)fprintf(out, ": %zu locked states from %d starts, sum of indices %d\n\n", list->count, list->starts,
                  list->index_sum);
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
    (void)fprintf(out, "%14s %10s  %26s  %28s %14s %14s\n", heads[0], "Phi (deg)", "n", heads[1], heads[2],
                  heads[3]);
    int stable = 0;
    for (size_t i = 0; i < list->count; ++i) {
        const fst_locked *l = &list->states[i];
        double greatest = l->eigenvalue_re[0];
        for (int k = 1; k < FST_EIGENVALUE_COUNT; ++k)
            greatest = fmax(greatest, l->eigenvalue_re[k]);
        char phi[32];
        (void)fprintf(out, "%14.10f %10s ", unsigned_zero(length * l->r, 10),
                      angle_text(l->bead_angle_deg, phi));
        for (int k = FST_NX; k <= FST_WZ; ++k)
            (void)fprintf(out, "%s%*.5f", k == FST_WX ? " " : "", k < FST_WX ? 9 : 10,
                          unsigned_zero((k < FST_WX ? 1.0 : turn) * l->state[k], 5));
        (void)fprintf(out, " %14.6g %14.5g  %s\n", speed * unsigned_zero(l->slip, 12), rate * greatest,
                      l->stable ? "stable" : "unstable");
        stable += l->stable != 0;
    }
    if (list->count > 0 && stable == 0)
        (void)fprintf(out, "\nNone is stable: a bead that is disturbed leaves each of them.\n");
}

static void print_families(const page *p, const fst_locked_list *list)
{
    FILE *out = p->out;
    char heads[2][48];
    const double length = head_of(p, "r", "r", "l", heads[0]);
    const double turn = head_of(p, "W_X, W_Z", "WX", "gamma", heads[1]);
    (void)fprintf(out,
                  "\n%zu families of locked beads whose contact does not slip, from one end to the other:\n",
                  list->family_count);
    if (list->family_count > 0)
        (void)fprintf(out, "%14s %10s  %17s  %19s %10s  %s\n", heads[0], "Phi (deg)", "n_X, n_Z", heads[1],
                      "|f|/(mu N)", "ends by");
    for (size_t i = 0; i < 2 * list->family_count; ++i) {
        const fst_rolling_family *family = &list->families[i / 2];
        const fst_rolling_lock *l = i % 2 ? &family->to : &family->from;
        char phi[32];
        (void)fprintf(out, "%14.10f %10s  %8.5f %8.5f  %9.5f %9.5f %10.6f  %s%s\n",
                      unsigned_zero(length * l->r, 10), angle_text(l->bead_angle_deg, phi),
                      unsigned_zero(l->state[FST_NX], 5), unsigned_zero(l->state[FST_NZ], 5),
                      unsigned_zero(turn * l->state[FST_WX], 5), unsigned_zero(turn * l->state[FST_WZ], 5),
                      l->use, fst_rolling_end_name(l->end), i % 2 ? "\n" : "");
    }
}

/* Where a bead floats without a plate. */
static fst_status find_levitation(const arguments *given, const fst_params *params, const page *p,
                                  fst_error *error)
{
    FILE *out = p->out;
    char heads[4][48];
    const double length = 1e-3 / p->scales.length, rate = p->scales.time; /* of mm and 1/s, scaled */
    const page shown = {.units = p->units == FST_SHOWN_AS_GIVEN ? FST_SHOWN_LAB : p->units,
                        .scales = p->scales};
    fst_levitation_list list;
    const fst_status status = fst_levitation_find(params, NULL, &list, error);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json")) {
        char *text = fst_levitation_json(params, &list);
        fst_levitation_free(&list);
        return print_and_free(text, out, error);
    }
    const double far = length * head_of(&shown, "height", "r", "l", heads[0]);
    (void)head_of(&shown, "gap", "r", "l", heads[1]);
    (void)head_of(&shown, "circle", "r", "l", heads[2]);
    const double fast = rate * head_of(&shown, "max Re", "rate", "gamma", heads[3]);
    (void)fprintf(out, "%zu places where the bead floats, at rest in the turning frame\n\n", list.count);
    if (list.count)
        (void)fprintf(out, "%12s %12s %12s %12s %16s\n", heads[0], heads[1], "tilt (deg)", heads[2], heads[3]);
    for (size_t i = 0; i < list.count; ++i) {
        const fst_levitation *l = &list.states[i];
        (void)fprintf(out, "%12.5f %12.5f %12.5f %12.5f %16.6g  %s, %s the magnet\n", far * l->height_mm,
                      far * l->gap_mm, l->tilt_deg, far * l->circle_mm,
                      fast * unsigned_zero(l->eigenvalue_re[0], ALL_DIGITS), l->stable ? "stable" : "unstable",
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
    page p = {.out = out};
    fst_status status = read_units(given, &p.units, error);
    if (status == FST_OK)
        status = read_scene(given, operand(given), &params, error);
    if (status != FST_OK)
        return status;
    p.scales = fst_scales_of(&params);
    if (params.plate_shape == FST_PLATE_NONE)
        return find_levitation(given, &params, &p, error);
    if (params.bead_count || fst_key_of_world(&params))
        return locked_beads(given, &params, &p, error);
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
            status = print_and_free(fst_locked_json(&params, omega, &list, p.units), out, error);
        else
            print_list(&p, omega,
                       params.friction_law == FST_FRICTION_COULOMB ||
                           params.friction_law == FST_FRICTION_ROLLING,
                       &list);
        if (!option_value(given, "json") &&
            (params.friction_law == FST_FRICTION_COULOMB || params.friction_law == FST_FRICTION_ROLLING))
            print_families(&p, &list);
        fst_locked_free(&list);
    }
    fst_model_free(model);
    return status;
}

const command locked_command = {
    .name = "locked",
    .synopsis = "[SCENE.yaml] [--json] [--units U]",
    .summary = "Every equilibrium of the turning frame: the bead goes round with the magnet",
    .details =
        "Vectors are inertial, in components along the magnet's axes.  docs/inside/orbits.md says why the list "
        "is believed to be\n"
        "complete.\n",
    .options = options,
    .most_operands = 1,
    .perform = perform,
};
