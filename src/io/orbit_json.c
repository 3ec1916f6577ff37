/* orbit_json.c - orbits, equilibria, branches and exponents as JSON. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/grow.h"
#include "base/text.h"
#include "host/regular_file.h"
#include "host/whole_file.h"
#include "io/branch_points.h"
#include "io/json.h"

enum { INDENT = 2 };

#define SPACES " \t\r\n"

/* What of an orbit is no mean of a run in SI too. */
static void put_orbit_si(fst_json *json, const fst_params *params, const fst_orbit *orbit)
{
    const fst_scales scales = fst_scales_of(params);
    fst_json_run_si(json, params, &orbit->means);
    fst_json_in_si(json, "relaxation_time", orbit->relaxation_time, "1/gamma", &scales);
    fst_json_state_si(json, "state_si", orbit->state, 2, &scales);
}

static void put_orbit(fst_json *json, const fst_params *params, const fst_orbit *orbit, fst_shown_units units)
{
    /* What describes a run and its length: an orbit has neither. */
    static const char *const of_runs[] = {"reason",
                                          "returns",
                                          "rhs_calls",
                                          "accepted",
                                          "rejected",
                                          "final_state",
                                          "periods",
                                          "window_periods",
                                          "end_time",
                                          "norm_drift",
                                          "mean_r_error",
                                          "mean_alpha_dot_error",
                                          "mean_nz_error",
                                          "largest_exponent",
                                          "largest_exponent_error",
                                          "ramp",
                                          "end_time_s",
                                          "mean_r_error_m",
                                          "mean_alpha_dot_error_per_s",
                                          "largest_exponent_per_s",
                                          "largest_exponent_error_per_s"};
    fst_json_run(json, params, &orbit->means);
    if (fst_json_with_si(units))
        put_orbit_si(json, params, orbit);
    for (size_t i = 0; i < sizeof of_runs / sizeof *of_runs; ++i)
        (void)json_object_del(json->open[json->depth - 1], of_runs[i]);
    fst_json_text(json, "symmetry", fst_symmetry_name(orbit->symmetry));
    fst_json_real(json, "period", orbit->means.period);
    fst_json_integer(json, "turns", orbit->turns);
    fst_json_pairs(json, "multipliers", orbit->multiplier_re, orbit->multiplier_im, FST_MULTIPLIER_COUNT);
    fst_json_flag(json, "stable", orbit->stable);
    fst_json_real(json, "relaxation_time", orbit->relaxation_time);
    fst_json_real(json, "swing_ratio", orbit->swing_ratio);
    fst_json_real(json, "residual", orbit->residual);
    fst_json_real(json, "trivial_multiplier_error", orbit->trivial_error);
    fst_json_reals(json, "state", orbit->state, FST_STATE_SIZE);
}

char *fst_orbit_json(const fst_params *params, const fst_orbit *orbit, const fst_orbit *others, size_t count,
                     fst_shown_units units)
{
    fst_json json = fst_json_begin('{');
    put_orbit(&json, params, orbit, units);
    if (others) {
        fst_json_open(&json, "others", '[');
        for (size_t i = 0; i < count; ++i) {
            fst_json_open(&json, NULL, '{');
            put_orbit(&json, params, &others[i], units);
            fst_json_close(&json);
        }
        fst_json_close(&json);
    }
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

/* A state of two or three axes; and in m, m/s and rad/s where `si` is not NULL. */
static void put_state(fst_json *json, const double *state, int axes, const fst_scales *si)
{
    fst_json_reals(json, "state", state, 2 * axes + 6);
    if (si)
        fst_json_state_si(json, "state_si", state, axes, si);
}

static void put_rolling(fst_json *json, const char *key, const fst_rolling_lock *l, const fst_scales *si)
{
    fst_json_open(json, key, '{');
    fst_json_scaled(json, "r", l->r, "l", si);
    fst_json_real(json, "phi_deg", l->bead_angle_deg);
    fst_json_reals(json, "n", l->state + FST_NX, 3);
    fst_json_reals(json, "w", l->state + FST_WX, 3);
    fst_json_real(json, "use", l->use);
    fst_json_text(json, "end", fst_rolling_end_name(l->end));
    put_state(json, l->state, 2, si);
    fst_json_close(json);
}

static void put_locked(fst_json *json, const fst_locked *l, const fst_scales *si)
{
    fst_json_open(json, NULL, '{');
    fst_json_scaled(json, "r", l->r, "l", si);
    fst_json_real(json, "phi_deg", l->bead_angle_deg);
    fst_json_reals(json, "n", l->state + FST_NX, 3);
    fst_json_reals(json, "w", l->state + FST_WX, 3);
    fst_json_rates(json, l->eigenvalue_re, l->eigenvalue_im, FST_EIGENVALUE_COUNT, si);
    fst_json_flag(json, "stable", l->stable);
    fst_json_scaled(json, "slip", l->slip, "l gamma", si);
    fst_json_scaled(json, "friction_power", l->friction_power, "l^2 gamma^3", si);
    fst_json_real(json, "residual", l->residual);
    fst_json_integer(json, "found", l->found);
    put_state(json, l->state, 2, si);
    fst_json_close(json);
}

/* The members of one. */
static void put_levitation(fst_json *json, const fst_levitation *l)
{
    fst_json_reals(json, "position_m", l->position_m, 3);
    fst_json_reals(json, "n", l->state + 6, 3);
    fst_json_reals(json, "w", l->w_per_s, 3);
    fst_json_real(json, "height_mm", l->height_mm);
    fst_json_real(json, "tilt_deg", l->tilt_deg);
    fst_json_real(json, "circle_mm", l->circle_mm);
    fst_json_real(json, "gap_mm", l->gap_mm);
    fst_json_flag(json, "stable", l->stable);
    fst_json_flag(json, "family", l->family);
    fst_json_pairs(json, "eigenvalues_per_s", l->eigenvalue_re, l->eigenvalue_im, FST_LEVITATION_DIRECTIONS);
    fst_json_real(json, "residual", l->residual);
    fst_json_reals(json, "state", l->state, FST_BEAD_NUMBERS);
}

char *fst_levitation_json(const fst_params *params, const fst_levitation_list *list)
{
    fst_json json = fst_json_begin('{');
    fst_json_open(&json, "states", '[');
    for (size_t i = 0; i < list->count; ++i) {
        fst_json_open(&json, NULL, '{');
        put_levitation(&json, &list->states[i]);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

char *fst_locked_json(const fst_params *params, double omega, const fst_locked_list *list,
                      fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(params);
    const fst_scales *si = fst_json_with_si(units) ? &scales : NULL;
    fst_json json = fst_json_begin('{');
    fst_json_scaled(&json, "omega", omega, "gamma", si);
    fst_json_open(&json, "states", '[');
    for (size_t i = 0; i < list->count; ++i)
        put_locked(&json, &list->states[i], si);
    fst_json_close(&json);
    if (params->friction_law == FST_FRICTION_COULOMB || params->friction_law == FST_FRICTION_ROLLING) {
        fst_json_open(&json, "families", '[');
        for (size_t i = 0; i < list->family_count; ++i) {
            fst_json_open(&json, NULL, '{');
            put_rolling(&json, "from", &list->families[i].from, si);
            put_rolling(&json, "to", &list->families[i].to, si);
            fst_json_close(&json);
        }
        fst_json_close(&json);
    }
    fst_json_integer(&json, "starts", list->starts);
    fst_json_integer(&json, "index_sum", list->index_sum);
    fst_json_flag(&json, "truncated", list->truncated);
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

const fst_point_number fst_point_numbers[FST_POINT_NUMBER_COUNT] = {
    {"value", "", offsetof(fst_branch_point, value)},
    {"second", "", offsetof(fst_branch_point, second)},
    {"omega", "gamma", offsetof(fst_branch_point, omega)},
    {"mean_r", "l", offsetof(fst_branch_point, mean_r)},
    {"mean_alpha_dot", "gamma", offsetof(fst_branch_point, mean_alpha_dot)},
    {"mean_nz", "1", offsetof(fst_branch_point, mean_nz)},
    {"festoons", "1", offsetof(fst_branch_point, festoons)},
    {"period", "1/gamma", offsetof(fst_branch_point, period)},
    {"min_r", "l", offsetof(fst_branch_point, min_r)},
    {"phi_deg", "deg", offsetof(fst_branch_point, bead_angle_deg)},
    {"slip", "l gamma", offsetof(fst_branch_point, slip)},
    {"relaxation_time", "1/gamma", offsetof(fst_branch_point, relaxation_time)},
    {"swing_ratio", "1", offsetof(fst_branch_point, swing_ratio)},
};

static void put_point(fst_json *json, const char *key, const fst_branch *branch, const fst_branch_point *p,
                      const fst_scales *si)
{
    const fst_branch_kind kind = branch->kind;
    fst_json_open(json, key, '{');
    for (int i = 0; i < FST_POINT_NUMBER_COUNT; ++i) {
        double value;
        memcpy(&value, (const char *)p + fst_point_numbers[i].offset, sizeof value);
        fst_json_scaled(json, fst_point_numbers[i].key, value, fst_point_numbers[i].unit, si);
    }
    fst_json_text(json, "symmetry", fst_symmetry_name(p->symmetry));
    fst_json_integer(json, "turns", p->turns);
    fst_json_integer(json, "branch", p->branch);
    if (kind == FST_BRANCH_LEVITATING) {
        put_levitation(json, &p->levitation);
    } else if (kind == FST_BRANCH_DRIVEN) {
        fst_json_flag(json, "stable", p->stable);
        fst_json_pairs(json, "multipliers", p->multiplier_re, p->multiplier_im, p->multipliers);
        put_state(json, p->levitation.state, 3, si);
    } else {
        fst_json_flag(json, "stable", p->stable);
        if (p->multipliers == FST_EIGENVALUE_COUNT)
            fst_json_rates(json, p->multiplier_re, p->multiplier_im, p->multipliers, si);
        else
            fst_json_pairs(json, "multipliers", p->multiplier_re, p->multiplier_im, p->multipliers);
        put_state(json, p->state, 2, si);
    }
    fst_json_close(json);
}

/* The scaled units at a point. */
static fst_scales scales_at(const fst_params *params, const fst_branch *branch, const fst_branch_point *p)
{
    const char *const keys[2] = {branch->key, branch->second_key};
    return fst_json_scales_at(params, keys, (const double[]){p->value, p->second});
}

/* The special points of a branch; or those where two families only cross, because nothing is born or ends
 * there. */
static void put_specials(fst_json *json, const char *key, const fst_params *params, const fst_branch *branch,
                         int crossings, fst_shown_units units)
{
    fst_json_open(json, key, '[');
    for (size_t i = 0; i < branch->special_count; ++i) {
        const fst_special *s = &branch->specials[i];
        if ((s->type == FST_SPECIAL_TRANSCRITICAL) != crossings)
            continue;
        fst_json_open(json, NULL, '{');
        fst_json_text(json, "type", fst_special_name(s->type));
        fst_json_text(json, "parameter", branch->key);
        const fst_scales scales = scales_at(params, branch, &s->at);
        const fst_scales *si = fst_json_with_si(units) ? &scales : NULL;
        fst_json_real(json, "value", s->value);
        fst_json_scaled(json, "omega", s->omega, "gamma", si);
        fst_json_integer(json, "branch", s->branch);
        fst_json_text(json, "criticality",
                      s->criticality > 0   ? "supercritical"
                      : s->criticality < 0 ? "subcritical"
                                           : NULL);
        fst_json_place(json, "born", s->born);
        put_point(json, "at", branch, &s->at, si);
        fst_json_close(json);
    }
    fst_json_close(json);
}

static void put_end(fst_json *json, const fst_branch_end *e, int over_two)
{
    fst_json_open(json, NULL, '{');
    fst_json_integer(json, "branch", e->branch);
    fst_json_place(json, "born_on", e->family);
    fst_json_real(json, "value", e->value);
    if (e->type != FST_END_NONE)
        fst_json_text(json, "type", fst_end_name(e->type));
    fst_json_text(json, "reason", e->reason);
    if (!over_two && e->image >= 0 && e->image != e->branch)
        fst_json_integer(json, "image_under_s2", e->image);
    else if (!over_two)
        fst_json_text(json, "image_under_s2", e->image >= 0 ? "itself" : "not listed");
    fst_json_close(json);
}

/* Every point, with the scales that its parameters make. */
static void put_points(fst_json *json, const fst_params *params, const fst_branch *branch,
                       fst_shown_units units)
{
    fst_json_open(json, "points", '[');
    for (size_t i = 0; i < branch->point_count; ++i) {
        const fst_branch_point *p = &branch->points[i];
        const fst_scales scales = scales_at(params, branch, p);
        put_point(json, NULL, branch, p, fst_json_with_si(units) ? &scales : NULL);
    }
    fst_json_close(json);
}

char *fst_branch_json(const fst_params *params, const fst_branch *branch, fst_shown_units units)
{
    const int over_two = branch->second_key[0] != '\0';
    fst_json json = fst_json_begin('{');
    fst_json_text(&json, "kind", fst_branch_kind_name(branch->kind));
    fst_json_text(&json, "parameter", branch->key);
    fst_json_real(&json, "from", branch->from);
    fst_json_real(&json, "to", branch->to);
    if (over_two) {
        fst_json_text(&json, "followed", fst_special_name(branch->followed));
        fst_json_text(&json, "second_parameter", branch->second_key);
        fst_json_real(&json, "second_from", branch->second_from);
        fst_json_real(&json, "second_to", branch->second_to);
    }
    fst_json_flag(&json, "complete", branch->complete);
    fst_json_integer(&json, "branches", branch->branches);
    put_specials(&json, "specials", params, branch, 0, units);
    put_specials(&json, "crossings", params, branch, 1, units);
    fst_json_open(&json, "ends", '[');
    for (size_t i = 0; i < branch->end_count; ++i)
        put_end(&json, &branch->ends[i], over_two);
    fst_json_close(&json);
    put_points(&json, params, branch, units);
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(1));
}

fst_status fst_branch_write(const char *path, const fst_params *params, const fst_branch *branch,
                            fst_error *error)
{
    fst_whole_file file;
    char *text = fst_branch_json(params, branch, FST_SHOWN_SCALED);
    if (!text)
        return fst_fail(error, FST_NO_MEMORY, path, "out of memory");
    fst_status status = fst_whole_file_open(&file, path, error);
    if (status == FST_OK) {
        (void)fputs(text, file.stream);
        status = fst_whole_file_commit(&file, error);
    }
    free(text);
    return status;
}

char *fst_lyapunov_json(const fst_params *params, const fst_lyapunov *l)
{
    fst_json json = fst_json_begin('{');
    fst_json_reals(&json, "exponents", l->exponents, FST_EIGENVALUE_COUNT);
    fst_json_reals(&json, "errors", l->errors, FST_EIGENVALUE_COUNT);
    fst_json_real(&json, "error", l->error);
    fst_json_flag(&json, "converged", l->converged);
    fst_json_place(&json, "flow_direction", l->flow_direction);
    fst_json_real(&json, "divergence", l->divergence);
    fst_json_real(&json, "time", l->time);
    fst_json_open(&json, "trace", '[');
    for (int i = 0; i < l->trace_count; ++i) {
        fst_json_open(&json, NULL, '{');
        fst_json_real(&json, "time", l->trace_time[i]);
        fst_json_reals(&json, "exponents", l->trace[i], FST_EIGENVALUE_COUNT);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

/* A speed; and in Hz where `hertz` is not 0. */
static void put_speed(fst_json *json, const char *key, double value, double hertz)
{
    char in_hertz[32];
    fst_json_real(json, key, value);
    (void)snprintf(in_hertz, sizeof in_hertz, "%s_hz", key);
    if (hertz > 0)
        fst_json_real(json, in_hertz, value * hertz);
}

char *fst_critical_json(const fst_params *params, const fst_critical *c, fst_shown_units units)
{
    const double hertz = !fst_json_with_si(units)                 ? 0.0
                         : strcmp(c->key, "drive.frequency") == 0 ? 1.0
                                                                  : params->friction_gamma / FST_TWO_PI;
    fst_json json = fst_json_begin('{');
    fst_json_text(&json, "key", c->key);
    fst_json_flag(&json, "found", c->found);
    fst_json_text(&json, "reason", c->found ? NULL : c->reason);
    put_speed(&json, "value", c->value, hertz);
    put_speed(&json, "error", c->error, hertz);
    fst_json_text(&json, "special", c->special >= 0 ? fst_special_name((fst_special_type)c->special) : NULL);
    fst_json_text(&json, "below", c->found ? fst_regime_name(c->below) : NULL);
    fst_json_text(&json, "above", c->found ? fst_regime_name(c->above) : NULL);
    put_speed(&json, "until", c->until, hertz);
    put_speed(&json, "parting", c->parting, hertz);
    put_speed(&json, "parting_error", c->parting_error, hertz);
    fst_json_integer(&json, "runs", c->runs);
    fst_json_open(&json, "stretches", '[');
    for (size_t i = 0; i < c->stretch_count; ++i) {
        fst_json_open(&json, NULL, '{');
        put_speed(&json, "from", c->stretches[i].from, hertz);
        put_speed(&json, "to", c->stretches[i].to, hertz);
        fst_json_text(&json, "regime", fst_regime_name(c->stretches[i].regime));
        fst_json_integer(&json, "runs", c->stretches[i].runs);
        fst_json_close(&json);
    }
    fst_json_close(&json);
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(INDENT));
}

/* ---------------------------------------------------------------- simulated points */

/* The parameter `key` in the document of a run: the drive from its results, any other from its scene. */
static const json_t *parameter_of(const json_t *run, const char *key)
{
    if (strcmp(key, "drive.omega") == 0)
        return json_object_get(run, "omega");
    if (strcmp(key, "drive.frequency") == 0)
        return json_object_get(run, "frequency_hz");
    return json_object_get(json_object_get(run, "scene"), key);
}

/* Take a point from a run's document, if it has both numbers; 0 where memory is short. */
static int add_dot(const json_t *run, const char *key, const char *observable, double **dots, size_t *count)
{
    const json_t *x = parameter_of(run, key), *y = json_object_get(run, observable);
    if (!json_is_number(x) || !json_is_number(y))
        return 1;
    if (!fst_grow(dots, *count, 2 * sizeof **dots))
        return 0;
    (*dots)[2 * *count] = json_number_value(x);
    (*dots)[2 * (*count)++ + 1] = json_number_value(y);
    return 1;
}

/* How long the document is that begins at `text`: to the bracket that ends it, or all. */
static size_t document_length(const char *text)
{
    int depth = 0, quoted = 0;
    for (const char *c = text; *c; ++c) {
        if (*c == '"')
            quoted = !quoted;
        else if (quoted)
            c += *c == '\\' && c[1];
        else if (*c == '{' || *c == '[')
            ++depth;
        else if ((*c == '}' || *c == ']') && --depth <= 0)
            return (size_t)(c - text) + 1;
    }
    return strlen(text);
}

fst_status fst_run_dots_read(const char *path, const char *key, const char *observable, double **dots,
                             size_t *count, fst_error *error)
{
    char *text;
    size_t size;
    *dots = NULL;
    *count = 0;
    fst_status status = fst_read_regular(path, FST_LONGEST_JSON, &text, &size, error);
    if (status != FST_OK)
        return status;
    int document = 0;
    for (size_t at = strspn(text, SPACES); at < size && status == FST_OK; at += strspn(text + at, SPACES)) {
        json_error_t why;
        const size_t length = document_length(text + at);
        json_t *run = fst_json_read(text + at, length, &why, &status);
        ++document;
        if (run && !add_dot(run, key, observable, dots, count))
            status = FST_NO_MEMORY;
        if (status == FST_NO_MEMORY)
            (void)fst_fail(error, status, path, "out of memory");
        else if (!run)
            (void)fst_fail(error, status, path, "document %d is not JSON: %s", document, why.text);
        at += length;
        json_decref(run);
    }
    free(text);
    if (status == FST_OK && *count == 0)
        status = fst_fail(error, FST_BAD_INPUT, path,
                          "it contains no document of fst_run_json() that has %s and %s", key, observable);
    if (status != FST_OK) {
        free(*dots);
        *dots = NULL;
    }
    return status;
}
