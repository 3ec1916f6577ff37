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

static void print_locked(FILE *out, const fst_beads_locked *l)
{
    (void)fprintf(out, l->count > 1 ? "%d beads turn with the magnet" : "the bead turns with the magnet",
                  l->count);
    (void)fprintf(out, ", omega = %.10g: %s\n\n", l->omega, l->stable ? "stable" : "unstable");
    (void)fprintf(out, "  %4s %14s %10s %14s  %26s %14s\n", "bead", "r (l)", "Phi (deg)", "z (l)", "n",
                  "load (weights)");
    for (int i = 0; i < l->count; ++i) {
        const double *n = l->state[i] + 6;
        (void)fprintf(out, "  %4d %14.10f %10.4f %14.10f  %8.5f %8.5f %8.5f %14.7g\n", i + 1, l->r[i],
                      isfinite(l->phi_deg[i]) ? unsigned_zero(l->phi_deg[i], 4) : 0.0,
                      unsigned_zero(l->height[i], 10), unsigned_zero(n[0], 5), unsigned_zero(n[1], 5),
                      unsigned_zero(n[2], 5), unsigned_zero(l->load_weights[i], ALL_DIGITS));
    }
    (void)fprintf(out, "\n");
    for (int k = 0; k < l->touch_count; ++k)
        if (l->touches[k].beads[1] >= 0)
            (void)fprintf(out, "  beads %d and %d press each other with %.10g l gamma^2\n",
                          l->touches[k].beads[0] + 1, l->touches[k].beads[1] + 1, l->touches[k].force);
    (void)fprintf(out, "  power of the drive %.10g l^2 gamma^3%s\n", unsigned_zero(l->power, ALL_DIGITS),
                  l->forces_unique ? ""
                                   : "; the contacts are more than the directions: the forces are one choice");
    if (l->free)
        (void)fprintf(out,
                      "  one of a continuum of states in %d directions: spins that nothing rubs are free\n",
                      l->free);
    print_pairs(out, "eigenvalues", l->eigenvalue_re, l->eigenvalue_im, l->eigenvalues);
    (void)fprintf(out, "  residual %.2g\n", l->residual);
}

fst_status locked_beads(const arguments *given, const fst_params *scene, FILE *out, fst_error *error)
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
        return print_and_free(fst_beads_locked_json(scene, &locked), out, error);
    print_locked(out, &locked);
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

static void print_branch(FILE *out, const fst_beads_branch *b)
{
    (void)fprintf(out, "%zu points over %s = %.10g to %.10g\n\nspecial points\n", b->point_count, b->key,
                  b->from, b->to);
    for (size_t i = 0; i < b->special_count; ++i)
        (void)fprintf(out, "  %-16s %s = %.12g\n", fst_special_name(b->specials[i].type), b->key,
                      b->specials[i].value);
    (void)fprintf(out, "\nends\n");
    for (int i = 0; i < 2; ++i)
        (void)fprintf(out, "  at %.10g: %s\n", b->ends[i].value, b->ends[i].reason);
}

fst_status branch_of_beads(const arguments *given, const fst_params *scene, const fst_branch_options *o,
                           FILE *out, fst_error *error)
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
        status = print_and_free(fst_beads_branch_json(scene, &branch), out, error);
    else
        print_branch(out, &branch);
    fst_beads_branch_free(&branch);
    return status;
}
