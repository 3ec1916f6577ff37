/* beads_orbit_json.c - locked states, orbits and branches of several beads as JSON. */
#include <festoon/bead_files.h>

#include <math.h>

#include "io/json.h"

enum { INDENT = 2 };

static void put_forces(fst_json *json, const fst_beads_locked *l, const fst_scales *si)
{
    fst_json_open(json, "pair_forces", '[');
    for (int k = 0; k < l->touch_count; ++k) {
        const fst_bead_touch *touch = &l->touches[k];
        if (touch->beads[1] < 0)
            continue;
        fst_json_open(json, NULL, '{');
        fst_json_integer(json, "a", touch->beads[0]);
        fst_json_integer(json, "b", touch->beads[1]);
        fst_json_scaled(json, "force", touch->force, "l gamma^2", si);
        fst_json_close(json);
    }
    fst_json_close(json);
    fst_json_flag(json, "forces_unique", l->forces_unique);
}

static void put_locked(fst_json *json, const fst_beads_locked *l, const fst_scales *si)
{
    fst_json_open(json, "beads", '[');
    for (int i = 0; i < l->count; ++i) {
        fst_json_open(json, NULL, '{');
        fst_json_scaled(json, "r", l->r[i], "l", si);
        fst_json_real(json, "phi_deg", l->phi_deg[i]);
        fst_json_scaled(json, "z", l->height[i], "l", si);
        fst_json_reals(json, "n", l->state[i] + 6, 3);
        fst_json_reals(json, "w", l->state[i] + 9, 3);
        fst_json_real(json, "load_weights", l->load_weights[i]);
        fst_json_reals(json, "state", l->state[i], FST_BEAD_NUMBERS);
        if (si)
            fst_json_state_si(json, "state_si", l->state[i], 3, si);
        fst_json_close(json);
    }
    fst_json_close(json);
    put_forces(json, l, si);
    fst_json_scaled(json, "power", l->power, "l^2 gamma^3", si);
    fst_json_rates(json, l->eigenvalue_re, l->eigenvalue_im, l->eigenvalues, si);
    fst_json_flag(json, "stable", l->stable);
    fst_json_integer(json, "free_directions", l->free);
    fst_json_real(json, "residual", l->residual);
}

char *fst_beads_locked_json(const fst_params *scene, const fst_beads_locked *locked, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(scene);
    const fst_scales *si = fst_json_with_si(units) ? &scales : NULL;
    fst_json json = fst_json_begin('{');
    fst_json_scaled(&json, "omega", locked->omega, "gamma", si);
    fst_json_open(&json, "states", '[');
    fst_json_open(&json, NULL, '{');
    put_locked(&json, locked, si);
    fst_json_close(&json);
    fst_json_close(&json);
    fst_json_scene(&json, scene);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

static double mean(const double *values, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; ++i)
        sum += values[i];
    return sum / count;
}

char *fst_beads_orbit_json(const fst_params *scene, const fst_beads_orbit *orbit, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(scene);
    const fst_scales *si = fst_json_with_si(units) ? &scales : NULL;
    fst_json json = fst_json_begin('{');
    fst_json_scaled(&json, "omega", orbit->omega, "gamma", si);
    fst_json_scaled(&json, "period", orbit->period, "1/gamma", si);
    fst_json_scaled(&json, "mean_r", mean(orbit->mean_r, orbit->count), "l", si);
    fst_json_scaled(&json, "mean_alpha_dot", mean(orbit->mean_alpha_dot, orbit->count), "gamma", si);
    fst_json_pairs(&json, "multipliers", orbit->multiplier_re, orbit->multiplier_im, orbit->multipliers);
    fst_json_flag(&json, "stable", orbit->stable);
    fst_json_text(&json, "symmetry", orbit->exchanges ? "exchange" : fst_symmetry_name(orbit->symmetry));
    fst_json_open(&json, "beads", '[');
    for (int i = 0; i < orbit->count; ++i) {
        fst_json_open(&json, NULL, '{');
        fst_json_scaled(&json, "mean_r", orbit->mean_r[i], "l", si);
        fst_json_scaled(&json, "mean_alpha_dot", orbit->mean_alpha_dot[i], "gamma", si);
        fst_json_reals(&json, "state", orbit->state[i], FST_BEAD_NUMBERS);
        if (si)
            fst_json_state_si(&json, "state_si", orbit->state[i], 3, si);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_open(&json, "powers", '{');
    fst_json_scaled(&json, "drive", orbit->drive_power, "l^2 gamma^3", si);
    fst_json_scaled(&json, "plate", orbit->plate_power, "l^2 gamma^3", si);
    fst_json_scaled(&json, "pair", orbit->pair_power, "l^2 gamma^3", si);
    fst_json_close(&json);
    fst_json_real(&json, "residual", orbit->residual);
    fst_json_real(&json, "trivial_multiplier_error", orbit->trivial_error);
    fst_json_scene(&json, scene);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

/* The drive and the state at a value of the parameter. */
static void put_place(fst_json *json, const char *at, const fst_params *scene, const fst_beads_branch *branch,
                      double value, const fst_beads_locked *l, fst_shown_units units)
{
    const char *const keys[2] = {branch->key, NULL};
    const fst_scales scales = fst_json_scales_at(scene, keys, (const double[]){value, NAN});
    const fst_scales *si = fst_json_with_si(units) ? &scales : NULL;
    fst_json_real(json, "value", value);
    fst_json_scaled(json, "omega", l->omega, "gamma", si);
    if (at)
        fst_json_open(json, at, '{');
    put_locked(json, l, si);
    if (at)
        fst_json_close(json);
}

char *fst_beads_branch_json(const fst_params *scene, const fst_beads_branch *branch, fst_shown_units units)
{
    fst_json json = fst_json_begin('{');
    fst_json_text(&json, "kind", fst_branch_kind_name(FST_BRANCH_LOCKED));
    fst_json_text(&json, "parameter", branch->key);
    fst_json_real(&json, "from", branch->from);
    fst_json_real(&json, "to", branch->to);
    fst_json_open(&json, "specials", '[');
    for (size_t i = 0; i < branch->special_count; ++i) {
        const fst_beads_special *s = &branch->specials[i];
        fst_json_open(&json, NULL, '{');
        fst_json_text(&json, "type", fst_special_name(s->type));
        fst_json_text(&json, "parameter", branch->key);
        put_place(&json, "at", scene, branch, s->value, &s->at, units);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_open(&json, "ends", '[');
    for (int i = 0; i < 2; ++i) {
        fst_json_open(&json, NULL, '{');
        fst_json_real(&json, "value", branch->ends[i].value);
        fst_json_text(&json, "type", fst_end_name(branch->ends[i].type));
        fst_json_text(&json, "reason", branch->ends[i].reason);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_open(&json, "points", '[');
    for (size_t i = 0; i < branch->point_count; ++i) {
        fst_json_open(&json, NULL, '{');
        put_place(&json, NULL, scene, branch, branch->values[i], &branch->points[i], units);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_scene(&json, scene);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}
