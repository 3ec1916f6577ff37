/* orbit_json.c - orbits, equilibria, branches and exponents as JSON. */
#include <festoon/festoon_tools.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "host/regular_file.h"
#include "host/whole_file.h"
#include "io/json_parts.h"

enum { INDENT = 2 };

#define SPACES " \t\r\n"

static json_t *pairs(const double *re, const double *im, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; ++i) {
        const double pair[2] = {re[i], im[i]};
        json_array_append_new(array, fst_json_numbers(pair, 2));
    }
    return array;
}

static json_t *symmetry_of(fst_symmetry symmetry)
{
    const char *name = fst_symmetry_name(symmetry);
    return name ? json_string(name) : json_null();
}

static json_t *orbit_object(const fst_params *params, const fst_orbit *orbit)
{
    json_t *object = fst_json_run(params, &orbit->means);
    /* Remove what describes a run and its length: an orbit has neither. */
    static const char *const of_runs[] = {"reason",        "returns",          "rhs_calls",
                                          "accepted",      "rejected",         "final_state",
                                          "periods",       "window_periods",   "end_time",
                                          "norm_drift",    "mean_r_error",     "mean_alpha_dot_error",
                                          "mean_nz_error", "largest_exponent", "largest_exponent_error",
                                          "ramp"};
    for (size_t i = 0; i < sizeof of_runs / sizeof *of_runs; ++i)
        (void)json_object_del(object, of_runs[i]);
    json_object_set_new(object, "symmetry", symmetry_of(orbit->symmetry));
    json_object_set_new(object, "period", fst_json_number(orbit->means.period));
    json_object_set_new(object, "turns", json_integer(orbit->turns));
    json_object_set_new(object, "multipliers",
                        pairs(orbit->multiplier_re, orbit->multiplier_im, FST_MULTIPLIER_COUNT));
    json_object_set_new(object, "stable", json_boolean(orbit->stable));
    json_object_set_new(object, "relaxation_time", fst_json_number(orbit->relaxation_time));
    json_object_set_new(object, "swing_ratio", fst_json_number(orbit->swing_ratio));
    json_object_set_new(object, "residual", fst_json_number(orbit->residual));
    json_object_set_new(object, "trivial_multiplier_error", fst_json_number(orbit->trivial_error));
    json_object_set_new(object, "state", fst_json_numbers(orbit->state, FST_STATE_SIZE));
    return object;
}

char *fst_orbit_json(const fst_params *params, const fst_orbit *orbit, const fst_orbit *others, size_t count)
{
    json_t *object = orbit_object(params, orbit);
    if (others) {
        json_t *array = json_array();
        for (size_t i = 0; i < count; ++i)
            json_array_append_new(array, orbit_object(params, &others[i]));
        json_object_set_new(object, "others", array);
    }
    json_object_set_new(object, "scene", fst_json_scene(params));
    return fst_json_dump(object, JSON_INDENT(INDENT));
}

static json_t *rolling_object(const fst_rolling_lock *l)
{
    json_t *state = json_object();
    json_object_set_new(state, "r", fst_json_number(l->r));
    json_object_set_new(state, "phi_deg", fst_json_number(l->bead_angle_deg));
    json_object_set_new(state, "n", fst_json_numbers(l->state + FST_NX, 3));
    json_object_set_new(state, "w", fst_json_numbers(l->state + FST_WX, 3));
    json_object_set_new(state, "use", fst_json_number(l->use));
    json_object_set_new(state, "end", json_string(fst_rolling_end_name(l->end)));
    json_object_set_new(state, "state", fst_json_numbers(l->state, FST_STATE_SIZE));
    return state;
}

char *fst_locked_json(const fst_params *params, double omega, const fst_locked_list *list)
{
    json_t *states = json_array();
    for (size_t i = 0; i < list->count; ++i) {
        const fst_locked *l = &list->states[i];
        json_t *state = json_object();
        json_object_set_new(state, "r", fst_json_number(l->r));
        json_object_set_new(state, "phi_deg", fst_json_number(l->bead_angle_deg));
        json_object_set_new(state, "n", fst_json_numbers(l->state + FST_NX, 3));
        json_object_set_new(state, "w", fst_json_numbers(l->state + FST_WX, 3));
        json_object_set_new(state, "eigenvalues",
                            pairs(l->eigenvalue_re, l->eigenvalue_im, FST_EIGENVALUE_COUNT));
        json_object_set_new(state, "stable", json_boolean(l->stable));
        json_object_set_new(state, "slip", fst_json_number(l->slip));
        json_object_set_new(state, "friction_power", fst_json_number(l->friction_power));
        json_object_set_new(state, "residual", fst_json_number(l->residual));
        json_object_set_new(state, "found", json_integer(l->found));
        json_object_set_new(state, "state", fst_json_numbers(l->state, FST_STATE_SIZE));
        json_array_append_new(states, state);
    }
    json_t *object = json_object();
    json_object_set_new(object, "omega", fst_json_number(omega));
    json_object_set_new(object, "states", states);
    if (params->friction_law == FST_FRICTION_COULOMB || params->friction_law == FST_FRICTION_ROLLING) {
        json_t *families = json_array();
        for (size_t i = 0; i < list->family_count; ++i) {
            json_t *family = json_object();
            json_object_set_new(family, "from", rolling_object(&list->families[i].from));
            json_object_set_new(family, "to", rolling_object(&list->families[i].to));
            json_array_append_new(families, family);
        }
        json_object_set_new(object, "families", families);
    }
    json_object_set_new(object, "starts", json_integer(list->starts));
    json_object_set_new(object, "index_sum", json_integer(list->index_sum));
    json_object_set_new(object, "truncated", json_boolean(list->truncated));
    json_object_set_new(object, "scene", fst_json_scene(params));
    return fst_json_dump(object, JSON_INDENT(INDENT));
}

const fst_point_number fst_point_numbers[FST_POINT_NUMBER_COUNT] = {
    {"value", offsetof(fst_branch_point, value)},
    {"second", offsetof(fst_branch_point, second)},
    {"omega", offsetof(fst_branch_point, omega)},
    {"mean_r", offsetof(fst_branch_point, mean_r)},
    {"mean_alpha_dot", offsetof(fst_branch_point, mean_alpha_dot)},
    {"mean_nz", offsetof(fst_branch_point, mean_nz)},
    {"festoons", offsetof(fst_branch_point, festoons)},
    {"period", offsetof(fst_branch_point, period)},
    {"min_r", offsetof(fst_branch_point, min_r)},
    {"phi_deg", offsetof(fst_branch_point, bead_angle_deg)},
    {"slip", offsetof(fst_branch_point, slip)},
    {"relaxation_time", offsetof(fst_branch_point, relaxation_time)},
    {"swing_ratio", offsetof(fst_branch_point, swing_ratio)},
};

static json_t *point_object(const fst_branch_point *p)
{
    json_t *object = json_object();
    for (int i = 0; i < FST_POINT_NUMBER_COUNT; ++i) {
        double value;
        memcpy(&value, (const char *)p + fst_point_numbers[i].offset, sizeof value);
        json_object_set_new(object, fst_point_numbers[i].key, fst_json_number(value));
    }
    json_object_set_new(object, "symmetry", symmetry_of(p->symmetry));
    json_object_set_new(object, "stable", json_boolean(p->stable));
    json_object_set_new(object, "turns", json_integer(p->turns));
    json_object_set_new(object, "branch", json_integer(p->branch));
    json_object_set_new(object, p->multipliers == FST_EIGENVALUE_COUNT ? "eigenvalues" : "multipliers",
                        pairs(p->multiplier_re, p->multiplier_im, p->multipliers));
    json_object_set_new(object, "state", fst_json_numbers(p->state, FST_STATE_SIZE));
    return object;
}

static json_t *special_object(const fst_branch *branch, const fst_special *s)
{
    json_t *object = json_object();
    json_object_set_new(object, "type", json_string(fst_special_name(s->type)));
    json_object_set_new(object, "parameter", json_string(branch->key));
    json_object_set_new(object, "value", fst_json_number(s->value));
    json_object_set_new(object, "omega", fst_json_number(s->omega));
    json_object_set_new(object, "branch", json_integer(s->branch));
    json_object_set_new(object, "criticality",
                        s->criticality ? json_string(s->criticality > 0 ? "supercritical" : "subcritical")
                                       : json_null());
    json_object_set_new(object, "born", s->born >= 0 ? json_integer(s->born) : json_null());
    json_object_set_new(object, "at", point_object(&s->at));
    return object;
}

char *fst_branch_json(const fst_params *params, const fst_branch *branch)
{
    json_t *object = json_object(), *points = json_array(), *specials = json_array(), *ends = json_array(),
           *crossings = json_array();
    for (size_t i = 0; i < branch->point_count; ++i)
        json_array_append_new(points, point_object(&branch->points[i]));
    for (size_t i = 0; i < branch->special_count;
         i++) /* nothing is born or ends where two families only cross */
        json_array_append_new(branch->specials[i].type == FST_SPECIAL_TRANSCRITICAL ? crossings : specials,
                              special_object(branch, &branch->specials[i]));
    for (size_t i = 0; i < branch->end_count; ++i) {
        const fst_branch_end *e = &branch->ends[i];
        json_t *end = json_object();
        json_object_set_new(end, "branch", json_integer(e->branch));
        json_object_set_new(end, "born_on", e->family >= 0 ? json_integer(e->family) : json_null());
        json_object_set_new(end, "value", fst_json_number(e->value));
        if (e->type != FST_END_NONE)
            json_object_set_new(end, "type", json_string(fst_end_name(e->type)));
        json_object_set_new(end, "reason", json_string(e->reason));
        if (!branch->second_key[0])
            json_object_set_new(end, "image_under_s2",
                                e->image == e->branch ? json_string("itself")
                                : e->image >= 0       ? json_integer(e->image)
                                                      : json_string("not listed"));
        json_array_append_new(ends, end);
    }
    json_object_set_new(object, "kind", json_string(fst_branch_kind_name(branch->kind)));
    json_object_set_new(object, "parameter", json_string(branch->key));
    json_object_set_new(object, "from", fst_json_number(branch->from));
    json_object_set_new(object, "to", fst_json_number(branch->to));
    if (branch->second_key[0]) {
        json_object_set_new(object, "followed", json_string(fst_special_name(branch->followed)));
        json_object_set_new(object, "second_parameter", json_string(branch->second_key));
        json_object_set_new(object, "second_from", fst_json_number(branch->second_from));
        json_object_set_new(object, "second_to", fst_json_number(branch->second_to));
    }
    json_object_set_new(object, "complete", json_boolean(branch->complete));
    json_object_set_new(object, "branches", json_integer(branch->branches));
    json_object_set_new(object, "specials", specials);
    json_object_set_new(object, "crossings", crossings);
    json_object_set_new(object, "ends", ends);
    json_object_set_new(object, "points", points);
    json_object_set_new(object, "scene", fst_json_scene(params));
    return fst_json_dump(object, JSON_INDENT(1));
}

fst_status fst_branch_write(const char *path, const fst_params *params, const fst_branch *branch,
                            fst_error *error)
{
    fst_whole_file file;
    char *text = fst_branch_json(params, branch);
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
    json_t *object = json_object(), *trace = json_array();
    json_object_set_new(object, "exponents", fst_json_numbers(l->exponents, FST_EIGENVALUE_COUNT));
    json_object_set_new(object, "errors", fst_json_numbers(l->errors, FST_EIGENVALUE_COUNT));
    json_object_set_new(object, "error", fst_json_number(l->error));
    json_object_set_new(object, "converged", json_boolean(l->converged));
    json_object_set_new(object, "flow_direction",
                        l->flow_direction >= 0 ? json_integer(l->flow_direction) : json_null());
    json_object_set_new(object, "divergence", fst_json_number(l->divergence));
    json_object_set_new(object, "time", fst_json_number(l->time));
    for (int i = 0; i < l->trace_count; ++i) {
        json_t *row = json_object();
        json_object_set_new(row, "time", fst_json_number(l->trace_time[i]));
        json_object_set_new(row, "exponents", fst_json_numbers(l->trace[i], FST_EIGENVALUE_COUNT));
        json_array_append_new(trace, row);
    }
    json_object_set_new(object, "trace", trace);
    json_object_set_new(object, "scene", fst_json_scene(params));
    return fst_json_dump(object, JSON_INDENT(INDENT));
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
    double *more = realloc(*dots, 2 * (*count + 1) * sizeof *more);
    if (!more)
        return 0;
    *dots = more;
    more[2 * *count] = json_number_value(x);
    more[2 * (*count)++ + 1] = json_number_value(y);
    return 1;
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
        json_t *run = json_loadb(text + at, size - at, JSON_DISABLE_EOF_CHECK, &why);
        ++document;
        if (!run)
            status = fst_fail(error, FST_BAD_INPUT, path, "document %d is no JSON: %s", document, why.text);
        else if (!add_dot(run, key, observable, dots, count))
            status = fst_fail(error, FST_NO_MEMORY, path, "out of memory");
        else
            at += (size_t)why.position;
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
