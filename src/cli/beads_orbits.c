/* beads_orbits.c - festoon locked, orbit and branch of a scene that lists beads, or of one bead in a bowl or a medium: one locked state, one orbit, one branch,
 * those to which the start leads. */
#include "cli/beads_orbits.h"

#include <stdlib.h>

#include <festoon/bead_files.h>

#include "cli/groups.h"
#include "cli/terminal.h"

/* Options that only a single bead has. */
static fst_status refuse(const arguments *given, const char *const *names, const char *why, fst_error *error)
{
    for (; *names; ++names)
        if (option_value(given, *names))
            return fail(error, FST_BAD_INPUT, "", "--%s is for one bead on a flat plate in air: %s", *names,
                        why);
    return FST_OK;
}

static void print_pairs(FILE *out, const char *title, const double *re, const double *im, int count)
{
    (void)fprintf(out, "  %s:", title);
    for (int i = 0; i < count; ++i)
        if (im[i] >= 0)
            (void)fprintf(out, im[i] > 0 ? " %.6g+-%.6gi" : " %.6g", unsigned_zero(re[i], ALL_DIGITS), im[i]);
    (void)fprintf(out, "\n");
}

/* Print the eigenvalues.  The title names their unit, but where nobody asked for units. */
static void print_rates(const page *p, const fst_beads_locked *l)
{
    const char *unit;
    const double factor = fst_unit_shown("gamma", p->units, &p->scales, &unit);
    double re[sizeof l->eigenvalue_re / sizeof *l->eigenvalue_re], im[sizeof re / sizeof *re];
    char title[32];
    for (int i = 0; i < l->eigenvalues; ++i) {
        re[i] = factor * l->eigenvalue_re[i];
        im[i] = factor * l->eigenvalue_im[i];
    }
    (void)snprintf(title, sizeof title, p->units == FST_SHOWN_AS_GIVEN ? "eigenvalues" : "eigenvalues (%s)",
                   unit);
    print_pairs(p->out, title, re, im, l->eigenvalues);
}

static void print_locked(const page *p, const fst_beads_locked *l)
{
    FILE *out = p->out;
    const char *far, *strong, *powers;
    const double length = fst_unit_shown("l", p->units, &p->scales, &far);
    const double force = fst_unit_shown("l gamma^2", p->units, &p->scales, &strong);
    const double power = fst_unit_shown("l^2 gamma^3", p->units, &p->scales, &powers);
    char heads[2][16];
    (void)snprintf(heads[0], sizeof heads[0], "r (%s)", far);
    (void)snprintf(heads[1], sizeof heads[1], "z (%s)", far);
    (void)fprintf(out, l->count > 1 ? "%d beads turn with the magnet" : "the bead turns with the magnet",
                  l->count);
    (void)fputs(", ", out);
    print_omega(p, l->omega);
    (void)fprintf(out, ": %s\n\n", l->stable ? "stable" : "unstable");
    (void)fprintf(out, "  %4s %14s %10s %14s  %26s %14s\n", "bead", heads[0], "Phi (deg)", heads[1], "n",
                  "load (weights)");
    for (int i = 0; i < l->count; ++i) {
        const double *n = l->state[i] + 6;
        (void)fprintf(out, "  %4d %14.10f %10.4f %14.10f  %8.5f %8.5f %8.5f %14.7g\n", i + 1, length * l->r[i],
                      isfinite(l->phi_deg[i]) ? unsigned_zero(l->phi_deg[i], 4) : 0.0,
                      unsigned_zero(length * l->height[i], 10), unsigned_zero(n[0], 5), unsigned_zero(n[1], 5),
                      unsigned_zero(n[2], 5), unsigned_zero(l->load_weights[i], ALL_DIGITS));
    }
    (void)fprintf(out, "\n");
    for (int k = 0; k < l->touch_count; ++k)
        if (l->touches[k].beads[1] >= 0)
            (void)fprintf(out, "  beads %d and %d press each other with %.10g %s\n", l->touches[k].beads[0] + 1,
                          l->touches[k].beads[1] + 1, force * l->touches[k].force, strong);
    (void)fprintf(out, "  power of the drive %.10g %s%s\n", power * unsigned_zero(l->power, ALL_DIGITS), powers,
                  l->forces_unique ? ""
                                   : "; the contacts are more than the directions: the forces are one choice");
    if (l->free)
        (void)fprintf(out,
                      "  one of a continuum of states in %d directions: spins that nothing rubs are free\n",
                      l->free);
    print_rates(p, l);
    (void)fprintf(out, "  residual %.2g\n", l->residual);
}

fst_status locked_beads(const arguments *given, const fst_params *scene, const page *p, fst_error *error)
{
    fst_beads_locked locked;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_beads_options options = fst_default_beads_options();
    options.progress = &progress;
    progress_begin(&line);
    const fst_status status = fst_beads_locked_scene(scene, &options, &locked, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_beads_locked_json(scene, &locked, p->units), p->out, error);
    print_locked(p, &locked);
    return FST_OK;
}

static void print_orbit(const page *p, const fst_beads_orbit *o)
{
    FILE *out = p->out;
    (void)fprintf(out, "omega = %.12g (%.9g Hz): %s%s\n", o->omega, o->omega / (TWO_PI * p->scales.time),
                  o->exchanges ? "two beads that change places in half a period, " : "",
                  o->stable ? "stable" : "unstable");
    print_shown(p, "period", &o->period, 1, "period", "1/gamma");
    for (int i = 0; i < o->count; ++i) {
        char name[32];
        (void)snprintf(name, sizeof name, "bead %d: <r>", i + 1);
        print_shown(p, name, &o->mean_r[i], 1, "mean_r", "l");
        print_shown(p, "        <alpha'>", &o->mean_alpha_dot[i], 1, "mean_alpha_dot", "gamma");
    }
    print_shown(p, "power of the drive", &o->drive_power, 1, "power", "l^2 gamma^3");
    print_pairs(out, o->exchanges ? "multipliers of half a turn, beads exchanged" : "multipliers",
                o->multiplier_re, o->multiplier_im, o->multipliers);
    (void)fprintf(out, "  residual %.2g, flow direction mapped onto itself to %.2g\n", o->residual,
                  o->trivial_error);
}

fst_status orbit_of_beads(const arguments *given, const fst_params *scene, const page *p, fst_error *error)
{
    static const char *const of_one[] = {"festoons", NULL};
    fst_beads_orbit orbit;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_beads_options options = fst_default_beads_options();
    options.progress = &progress;
    fst_status status = refuse(given, of_one, "find the orbit at one drive", error);
    if (status != FST_OK)
        return status;
    progress_begin(&line);
    status = fst_beads_orbit_scene(scene, &options, &orbit, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        return print_and_free(fst_beads_orbit_json(scene, &orbit, p->units), p->out, error);
    print_orbit(p, &orbit);
    return FST_OK;
}

static void print_branch(const page *p, const fst_beads_branch *b)
{
    FILE *out = p->out;
    const shown_parameter shown = show_parameter(p, b->key);
    (void)fprintf(out, "%zu points over %s = %.10g to %.10g%s\n\nspecial points\n", b->point_count, b->key,
                  shown.factor * b->from, shown.factor * b->to, shown.unit);
    for (size_t i = 0; i < b->special_count; ++i)
        (void)fprintf(out, "  %-16s %s = %.12g%s\n", fst_special_name(b->specials[i].type), b->key,
                      shown.factor * b->specials[i].value, shown.unit);
    (void)fprintf(out, "\nends\n");
    for (int i = 0; i < 2; ++i)
        (void)fprintf(out, "  at %.10g%s: %s\n", shown.factor * b->ends[i].value, shown.unit,
                      b->ends[i].reason);
}

fst_status branch_of_beads(const arguments *given, const fst_params *scene, const fst_branch_options *o,
                           const page *p, fst_error *error)
{
    static const char *const of_one[] = {"with", "follow", "output", "tolerance", "step", NULL};
    fst_beads_branch branch;
    progress_line line;
    const fst_progress progress = {&line, progress_tell};
    fst_beads_options options = fst_default_beads_options();
    options.progress = &progress;
    fst_status status = refuse(given, of_one, "--json prints the branch of their locked state", error);
    if (status == FST_OK && o->kind != FST_BRANCH_LOCKED)
        status = fail(error, FST_BAD_INPUT, "--kind", "with %s a branch is --kind locked%s",
                      scene->bead_count ? "several beads" : fst_key_of_world(scene),
                      scene->bead_count ? "" : ", levitating or driven");
    if (status != FST_OK)
        return status;
    progress_begin(&line);
    status = fst_beads_branch_scene(scene, &options, o->key, o->from, o->to, &branch, error);
    progress_end(&line);
    if (status != FST_OK)
        return status;
    if (option_value(given, "json"))
        status = print_and_free(fst_beads_branch_json(scene, &branch, p->units), p->out, error);
    else
        print_branch(p, &branch);
    fst_beads_branch_free(&branch);
    return status;
}
