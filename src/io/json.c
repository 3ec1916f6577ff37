/* json.c - results and the table of parameters as JSON, and reading JSON. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "io/json.h"

/* A parameter's value; null where it was not given. */
static json_t *parameter(const fst_params *params, int index)
{
    const fst_param_info *info = fst_param_at(index);
    char text[FST_PARAM_TEXT_SIZE];
    double real;
    int integer;
    if (fst_params_get(params, index, text, sizeof text) == 0)
        return json_null();
    if (info->kind == FST_KIND_CHOICE || info->kind == FST_KIND_TEXT)
        return fst_json_text_value(text);
    memcpy(&integer, (const char *)params + info->offset, sizeof integer);
    if (info->kind == FST_KIND_INT)
        return json_integer(integer);
    memcpy(&real, (const char *)params + info->offset, sizeof real);
    return fst_json_number(real);
}

/* The parts as a list of objects, each with its kind, and lists of numbers in SI. */
static void put_parts(fst_json *json, const fst_params *params)
{
    fst_json_open(json, "magnet.parts", '[');
    for (int i = fst_param_count(); fst_param_part(i) >= 0 && fst_param_part(i) < params->magnet_part_count;
         ++i) {
        const char *key = strrchr(fst_param_at(i)->key, '.') + 1;
        const size_t length = strcspn(key, "[");
        char name[32];
        (void)snprintf(name, sizeof name, "%.*s", (int)length, key);
        json_t *value = parameter(params, i);
        if (strcmp(name, "kind") == 0) {
            if (i > fst_param_count())
                fst_json_close(json);
            fst_json_open(json, NULL, '{');
            fst_json_put(json, name, value);
        } else if (json_is_string(value)) {
            fst_json_put(json, name, value);
        } else if (json_is_null(value)) {
            json_decref(value); /* the kind of part has no such number */
        } else {
            json_t *part = json->open[json->depth - 1];
            if (!json_object_get(part, name))
                fst_json_put(json, name, json_array());
            json->failed |= json_array_append_new(json_object_get(part, name), value) != 0;
        }
    }
    fst_json_close(json);
    fst_json_close(json);
}

/* The beads as a list of objects, each with what the bead says of its own. */
static void put_beads(fst_json *json, const fst_params *params)
{
    fst_params alone = fst_default_params();
    alone.bead_count = 1;
    fst_json_open(json, "beads", '[');
    for (int bead = 0; bead < params->bead_count; ++bead) {
        alone.beads[0] = params->bead_count > FST_BEADS_MOST ? params->bead_list[bead] : params->beads[bead];
        fst_json_open(json, NULL, '{');
        for (int i = fst_param_count(); i < fst_params_row_count(&alone); ++i) {
            json_t *value = fst_param_bead(i) == 0 ? parameter(&alone, i) : json_null();
            if (json_is_null(value))
                json_decref(value);
            else
                fst_json_put(json, strchr(fst_param_at(i)->key, ']') + 2, value);
        }
        fst_json_close(json);
    }
    fst_json_close(json);
}

void fst_json_scene(fst_json *json, const fst_params *params)
{
    fst_json_open(json, "scene", '{');
    for (int i = 0; i < fst_param_count(); ++i)
        fst_json_put(json, fst_param_at(i)->key, parameter(params, i));
    if (params->magnet_part_count)
        put_parts(json, params);
    for (int i = fst_param_count(); i < fst_params_row_count(params); ++i)
        if (fst_param_part(i) < 0 && fst_param_bead(i) < 0 && fst_param_coil(i) < params->coil_count)
            fst_json_put(json, fst_param_at(i)->key, parameter(params, i));
    if (params->bead_count)
        put_beads(json, params);
    fst_json_close(json);
}

static void put_groups(fst_json *json, const fst_params *params)
{
    fst_model *model = NULL;
    const fst_status status = fst_field_model_new(params, NAN, &model, NULL);
    if (status != FST_OK) {
        fst_json_put(json, "groups", status == FST_NO_MEMORY ? NULL : json_null());
        return;
    }
    const fst_groups g = fst_model_groups(model);
    fst_model_free(model);
    const struct {
        const char *name;
        double value;
    } numbers[] = {
        {"eps", g.eps},
        {"inertia", g.inertia},
        {"h", g.h},
        {"lambda", g.lambda},
        {"kappa", g.kappa},
        {"a", g.a},
        {"b", g.b},
        {"omega", g.omega},
        {"gravity", g.gravity},
        {"plate_radius", g.plate_radius},
        {"length_unit_m", g.length_unit},
        {"time_unit_s", g.time_unit},
        {"mass_kg", g.mass},
        {"field_unit_t", g.field_unit},
    };
    fst_json_open(json, "groups", '{');
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
        fst_json_real(json, numbers[i].name, numbers[i].value);
    fst_json_integer(json, "lines", g.lines);
    fst_json_close(json);
}

static void put_ramp(fst_json *json, const fst_ramp_point *ramp, size_t count)
{
    fst_json_open(json, "ramp", '[');
    for (size_t i = 0; i < count; ++i) {
        fst_json_open(json, NULL, '{');
        fst_json_real(json, "omega", ramp[i].omega);
        fst_json_real(json, "frequency_hz", ramp[i].frequency_hz);
        fst_json_real(json, "mean_r", ramp[i].mean_r);
        fst_json_real(json, "std_r", ramp[i].std_r);
        fst_json_real(json, "mean_alpha_dot", ramp[i].mean_alpha_dot);
        fst_json_real(json, "mean_phi_dot", ramp[i].mean_phi_dot);
        fst_json_real(json, "mean_nz", ramp[i].mean_nz);
        fst_json_flag(json, "settled", ramp[i].settled);
        fst_json_close(json);
    }
    fst_json_close(json);
}

static const char *choice_text(const fst_params *params, const char *key, char *text, size_t size)
{
    (void)fst_params_get(params, fst_param_find(key), text, size);
    return text;
}

/* All but the state. */
static void put_run(fst_json *json, const fst_params *params, const fst_run_result *result)
{
    char dynamics[48];
    fst_json_text(json, "regime", fst_regime_name(result->regime));
    fst_json_text(json, "reason", result->reason[0] ? result->reason : NULL);
    fst_json_text(json, "symmetry", fst_symmetry_name(result->symmetry));
    fst_json_text(json, "dynamics", choice_text(params, "model.dynamics", dynamics, sizeof dynamics));
    for (int i = 0; i < fst_result_count(); ++i) {
        const fst_result_info *info = fst_result_at(i);
        double value;
        memcpy(&value, (const char *)result + info->offset, sizeof value);
        fst_json_real(json, info->name, value);
    }
    fst_json_put(json, "never_slips",
                 result->never_slips < 0 ? json_null() : json_boolean(result->never_slips));
    fst_json_integer(json, "returns", result->returns);
    fst_json_integer(json, "rhs_calls", (int64_t)result->rhs_calls);
    fst_json_integer(json, "steps_accepted", (int64_t)result->accepted);
    fst_json_integer(json, "steps_rejected", (int64_t)result->rejected);
}

void fst_json_run(fst_json *json, const fst_params *params, const fst_run_result *result)
{
    put_run(json, params, result);
    fst_json_reals(json, "final_state", result->final_state, FST_STATE_SIZE);
}

/* The text on one line. */
static char *end_line(fst_json *json)
{
    char *text = fst_json_end(json, JSON_COMPACT);
    if (text)
        text[strlen(text) - 1] = '\0';
    return text;
}

char *fst_result_line(const fst_params *params, const fst_run_result *result)
{
    fst_json json = fst_json_begin('{');
    fst_json_run(&json, params, result);
    return end_line(&json);
}

void fst_json_run_si(fst_json *json, const fst_params *params, const fst_run_result *result)
{
    const fst_scales scales = fst_scales_of(params);
    for (int i = 0; i < fst_result_count(); ++i) {
        const fst_result_info *info = fst_result_at(i);
        const char *in_weights = strstr(info->name, "_weights");
        char key[64];
        double value;
        memcpy(&value, (const char *)result + info->offset, sizeof value);
        if (in_weights) {
            (void)snprintf(key, sizeof key, "%.*s_newtons", (int)(in_weights - info->name), info->name);
            fst_json_real(json, key, value * scales.mass * params->plate_gravity);
        }
        fst_json_in_si(json, info->name, value, info->unit, &scales);
    }
}

static void put_world(fst_json *json, const fst_world_result *result)
{
    fst_json_reals(json, "final_state", result->final_state, FST_BEAD_NUMBERS);
    fst_json_name(json, "frame", FST_WORDS(FST_FRAMES), result->frame);
    fst_json_real(json, "final_time", result->final_time);
    fst_json_reals(json, "final_lab", result->final_lab, FST_BEAD_NUMBERS);
    fst_json_reals(json, "final_lab_si", result->final_lab_si, FST_BEAD_NUMBERS);
    fst_json_real(json, "mean_height", result->mean_height);
    fst_json_real(json, "mean_medium_power", result->mean_medium_power);
    fst_json_real(json, "mean_velocity", result->mean_velocity);
    fst_json_real(json, "mean_velocity_error", result->mean_velocity_error);
}

static void put_world_si(fst_json *json, const fst_params *params, const fst_world_result *result)
{
    const fst_scales scales = fst_scales_of(params);
    fst_json_state_si(json, "final_state_si", result->final_state, 3, &scales);
    fst_json_in_si(json, "final_time", result->final_time, "1/gamma", &scales);
    fst_json_in_si(json, "mean_height", result->mean_height, "l", &scales);
    fst_json_in_si(json, "mean_medium_power", result->mean_medium_power, "l^2 gamma^3", &scales);
    fst_json_in_si(json, "mean_velocity", result->mean_velocity, "l gamma", &scales);
    fst_json_in_si(json, "mean_velocity_error", result->mean_velocity_error, "l gamma", &scales);
}

char *fst_world_line(const fst_params *params, const fst_world_result *result)
{
    fst_json json = fst_json_begin('{');
    put_run(&json, params, &result->run);
    put_world(&json, result);
    return end_line(&json);
}

char *fst_world_json(const fst_params *params, const fst_world_result *result, fst_shown_units units)
{
    fst_json json = fst_json_begin('{');
    put_run(&json, params, &result->run);
    if (fst_json_with_si(units))
        fst_json_run_si(&json, params, &result->run);
    put_world(&json, result);
    if (fst_json_with_si(units))
        put_world_si(&json, params, result);
    put_groups(&json, params);
    fst_json_scene(&json, params);
    fst_json_text(&json, "version", fst_version());
    return fst_json_end(&json, JSON_INDENT(2));
}

char *fst_run_json(const fst_params *params, const fst_run_result *result, const fst_ramp_point *ramp,
                   size_t ramp_count)
{
    return fst_run_json_in(params, result, ramp, ramp_count, FST_SHOWN_SCALED);
}

char *fst_run_json_in(const fst_params *params, const fst_run_result *result, const fst_ramp_point *ramp,
                      size_t ramp_count, fst_shown_units units)
{
    fst_json json = fst_json_begin('{');
    const fst_scales scales = fst_scales_of(params);
    fst_json_run(&json, params, result);
    if (fst_json_with_si(units)) {
        fst_json_run_si(&json, params, result);
        fst_json_state_si(&json, "final_state_si", result->final_state, 2, &scales);
    }
    put_groups(&json, params);
    fst_json_scene(&json, params);
    if (ramp_count)
        put_ramp(&json, ramp, ramp_count);
    fst_json_text(&json, "version", fst_version());
    return fst_json_end(&json, JSON_INDENT(2));
}

/* What is known of a measured field, in SI. */
static void put_map(fst_json *json, const fst_field_map *map)
{
    const fst_field_map_facts facts = fst_field_map_describe(map);
    fst_json_open(json, "map", '{');
    fst_json_open(json, "count", '[');
    for (int axis = 0; axis < 3; ++axis)
        fst_json_integer(json, NULL, facts.count[axis]);
    fst_json_close(json);
    fst_json_reals(json, "first_m", facts.first, 3);
    fst_json_reals(json, "spacing_m", facts.spacing, 3);
    fst_json_real(json, "radius_m", facts.radius);
    fst_json_real(json, "greatest_b_tesla", facts.greatest);
    fst_json_real(json, "curl", facts.curl);
    fst_json_close(json);
}

char *fst_scene_json(const fst_params *params)
{
    char sentence[512];
    fst_json json = fst_json_begin('{');
    fst_json_scene(&json, params);
    put_groups(&json, params);
    fst_json_open(&json, "warnings", '[');
    if (fst_bead_contradiction(params, sentence, sizeof sentence))
        fst_json_text(&json, NULL, sentence);
    if (fst_params_bare_number(params, sentence, sizeof sentence))
        fst_json_text(&json, NULL, sentence);
    fst_json_close(&json);
    if (params->magnet_map)
        put_map(&json, params->magnet_map);
    return fst_json_end(&json, JSON_INDENT(2));
}

/* The field and its gradient times the units `field` and `slope`, under two keys. */
static void put_field(fst_json *json, const double b[3], double grad[3][3], double field, double slope,
                      const char *field_key, const char *slope_key)
{
    double scaled[4][3];
    for (int k = 0; k < 3; ++k) {
        scaled[0][k] = field * b[k];
        for (int i = 0; i < 3; ++i)
            scaled[1 + i][k] = slope * grad[i][k];
    }
    fst_json_reals(json, field_key, scaled[0], 3);
    fst_json_open(json, slope_key, '[');
    for (int i = 0; i < 3; ++i)
        fst_json_reals(json, NULL, scaled[1 + i], 3);
    fst_json_close(json);
}

/* The magnetic force on a bead whose moment lies along the field, and its load on the plate, or their errors. */
static void put_pull(fst_json *json, const fst_groups *g, double force[3], double load,
                     const char *const keys[4], int in_si)
{
    const double newton = g->mass * g->length_unit / (g->time_unit * g->time_unit);
    fst_json_reals(json, keys[0], force, 3);
    fst_json_real(json, keys[1], load);
    if (!in_si)
        return;
    for (int i = 0; i < 3; ++i)
        force[i] *= newton;
    fst_json_reals(json, keys[2], force, 3);
    fst_json_real(json, keys[3], newton * load);
}

/* The errors of a smoothed map's field, and its fit in SI. */
static void put_errors(fst_json *json, const fst_model *model, double x, double y, int in_si)
{
    double b[3], grad[3][3], force[3];
    char sentence[256];
    const fst_groups g = fst_model_groups(model);
    if (!fst_field_error(model, x, y, b, grad, force))
        return;
    const fst_map_fit fit = fst_field_map_describe(fst_model_map(model)).fit;
    put_field(json, b, grad, 1.0, 1.0, "b_error", "grad_error");
    if (in_si)
        put_field(json, b, grad, g.field_unit, g.field_unit / g.length_unit, "b_error_tesla",
                  "grad_error_tesla_per_m");
    put_pull(json, &g, force, force[2],
             (const char *const[]){"force_error", "load_error", "force_error_newtons", "load_error_newtons"},
             in_si);
    fst_json_open(json, "fit", '{');
    fst_json_integer(json, "charges", fit.charges);
    fst_json_real(json, "depth_m", fit.depth);
    fst_json_real(json, "rms_tesla", fit.rms);
    fst_json_real(json, "noise_tesla", fit.noise);
    fst_json_real(json, "rough_noise_tesla", fit.rough);
    fst_json_real(json, "degrees_of_freedom", fit.free);
    fst_json_real(json, "chi2_per_degree", fit.chi2);
    fst_json_real(json, "noise_told_tesla", fit.told);
    fst_json_reals(json, "chi2_bound", fit.bound, 2);
    fst_json_text(json, "noise_verdict", fst_noise_verdict_name(fit.verdict));
    fst_json_real(json, "noise_seen_tesla", fit.seen[0]);
    fst_json_reals(json, "noise_seen_bound_tesla", fit.seen + 1, 2);
    fst_map_fit_sentence(&fit, sentence, sizeof sentence);
    fst_json_text(json, "sentence", sentence);
    if (fit.turned_error[0] > 0) {
        fst_json_reals(json, "probe_turned_rad", fit.turned, 3);
        fst_json_reals(json, "probe_turned_error_rad", fit.turned_error, 3);
        fst_json_reals(json, "probe_offset_tesla", fit.offset, 3);
        fst_json_reals(json, "probe_offset_error_tesla", fit.offset_error, 3);
    }
    fst_json_close(json);
}

char *fst_field_json(const fst_model *model, double x, double y, fst_shown_units units)
{
    double b[3], grad[3][3], force[3], load;
    const fst_groups g = fst_model_groups(model);
    const int in_si = fst_json_with_si(units);
    fst_field(model, x, y, b, grad);
    fst_field_pull(model, x, y, force, &load);
    fst_json json = fst_json_begin('{');
    if (isfinite(fst_field_time(model)))
        fst_json_real(&json, "time", fst_field_time(model));
    fst_json_real(&json, "x", x);
    fst_json_real(&json, "y", y);
    put_field(&json, b, grad, 1.0, 1.0, "b", "grad");
    if (in_si)
        put_field(&json, b, grad, g.field_unit, g.field_unit / g.length_unit, "b_tesla", "grad_tesla_per_m");
    fst_json_real(&json, "height", fst_field_height(model, x, y));
    put_pull(&json, &g, force, load, (const char *const[]){"force", "load", "force_newtons", "load_newtons"},
             in_si);
    put_errors(&json, model, x, y, in_si);
    return fst_json_end(&json, JSON_INDENT(2));
}

char *fst_world_orbit_json(const fst_params *params, const fst_world_orbit *orbit, fst_shown_units units)
{
    const fst_scales scales = fst_scales_of(params);
    fst_json json = fst_json_begin('{');
    fst_json_real(&json, "period", orbit->period);
    if (fst_json_with_si(units)) {
        fst_json_in_si(&json, "period", orbit->period, "1/gamma", &scales);
        fst_json_state_si(&json, "state_si", orbit->state, 3, &scales);
    }
    fst_json_name(&json, "frame", FST_WORDS(FST_FRAMES), orbit->frame);
    fst_json_open(&json, "multipliers", '[');
    for (int i = 0; i < orbit->count; ++i)
        fst_json_reals(&json, NULL, orbit->multipliers[i], 2);
    fst_json_close(&json);
    fst_json_flag(&json, "stable", orbit->stable);
    fst_json_reals(&json, "state", orbit->state, FST_BEAD_NUMBERS);
    fst_json_real(&json, "residual", orbit->residual);
    fst_json_scene(&json, params);
    fst_json_text(&json, "version", fst_version());
    return fst_json_end(&json, JSON_INDENT(2));
}

/* The value that a parameter has at first. */
static json_t *schema_default(const fst_param_info *info, int index)
{
    const fst_params defaults = fst_default_params();
    char text[64];
    if (info->kind == FST_KIND_INT)
        return json_integer((json_int_t)info->initial);
    if (info->kind != FST_KIND_CHOICE)
        return fst_json_number(info->initial);
    (void)fst_params_get(&defaults, index, text, sizeof text);
    return text[0] ? json_string(text) : json_null();
}

static void put_schema_row(fst_json *json, int index)
{
    static const char *const kinds[] = {[FST_KIND_REAL] = "real",
                                        [FST_KIND_INT] = "integer",
                                        [FST_KIND_CHOICE] = "choice",
                                        [FST_KIND_TEXT] = "text"};
    const fst_param_info *info = fst_param_at(index);
    const int choice = info->kind == FST_KIND_CHOICE, limits = !choice && info->kind != FST_KIND_TEXT;
    fst_json_open(json, NULL, '{');
    fst_json_text(json, "key", info->key);
    fst_json_text(json, "kind", kinds[info->kind]);
    fst_json_text(json, "unit", limits ? fst_unit_name(info->unit) : NULL);
    fst_json_put(json, "default", schema_default(info, index));
    fst_json_real(json, "min", limits ? info->least : NAN);
    fst_json_real(json, "max", limits ? info->greatest : NAN);
    fst_json_text(json, "doc", info->doc);
    if (choice) {
        fst_json_open(json, "names", '[');
        size_t length;
        for (int i = 0; *fst_name_at(info->names, i, &length); ++i)
            fst_json_name(json, NULL, info->names, i);
        fst_json_close(json);
    } else {
        fst_json_text(json, "names", NULL);
    }
    fst_json_text(json, "other_form", fst_param_other_form(info->key));
    fst_json_flag(json, "expert", fst_name_place(info->key, FST_EXPERT_KEYS) >= 0);
    /* of a key of the first part: how many parts may have it */
    fst_json_place(json, "parts", fst_param_part(index) == 0 ? FST_PARTS_MAX : -1);
    fst_json_close(json);
}

char *fst_schema_json(void)
{
    fst_json json = fst_json_begin('[');
    for (int i = 0; i < fst_param_count() || fst_param_part(i) == 0; ++i)
        put_schema_row(&json, i);
    return fst_json_end(&json, JSON_INDENT(2));
}

/* ---------------------------------------------------------------- reading */

/* jansson's scanner leaves out a letter where it cannot grow its memory.  So it first reads a long text, which
 * comes back whole if the scanner has room for it; no name and no number of ours is longer. */
enum { LONGEST_WORD = 4096 };

typedef struct fed_text {
    const char *pieces[3];
    size_t sizes[3];
} fed_text;

static size_t feed(void *buffer, size_t room, void *user)
{
    fed_text *fed = user;
    size_t given = 0;
    for (int i = 0; i < 3 && given < room; ++i) {
        const size_t size = fed->sizes[i] < room - given ? fed->sizes[i] : room - given;
        memcpy((char *)buffer + given, fed->pieces[i], size);
        fed->pieces[i] += size;
        fed->sizes[i] -= size;
        given += size;
    }
    return given;
}

static json_t *read_once(const char *text, size_t size, json_error_t *why)
{
    char before[LONGEST_WORD + 4];
    memset(before, ' ', sizeof before);
    memcpy(before, "[\"", 2);
    memcpy(before + 2 + LONGEST_WORD - 2, "\",", 2);
    fed_text fed = {{before, text, "]"}, {LONGEST_WORD + 2, size, 1}};
    json_t *both = json_load_callback(feed, &fed, JSON_REJECT_DUPLICATES, why);
    const size_t length = json_string_length(json_array_get(both, 0));
    json_t *document =
        json_array_size(both) == 2 && length == LONGEST_WORD - 2 ? json_array_get(both, 1) : NULL;
    if (both && json_array_size(both) != 2)
        (void)snprintf(why->text, sizeof why->text, "end of file expected");
    json_incref(document);
    json_decref(both);
    return document;
}

json_t *fst_json_read(const char *text, size_t size, json_error_t *why, fst_status *status)
{
    /* Without memory jansson may speak of an invalid text: it must do so twice, while there is memory. */
    json_t *document = read_once(text, size, why);
    if (!document)
        document = read_once(text, size, why);
    void *some = document ? NULL : malloc(LONGEST_WORD);
    *status = document ? FST_OK : some && why->text[0] ? FST_BAD_INPUT : FST_NO_MEMORY;
    free(some);
    return document;
}
