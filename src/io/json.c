/* json.c - results and the table of parameters as JSON, by jansson. */
#include <festoon/festoon_tools.h>

#include <jansson.h>
#include <stdlib.h>
#include <string.h>

#include "io/json.h"
#include "io/json_parts.h"

json_t *fst_json_number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *text_or_null(const char *text)
{
    return text && text[0] ? json_string(text) : json_null();
}

static json_t *count_of(uint64_t value)
{
    return json_integer((json_int_t)value);
}

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
        return json_string(text);
    memcpy(&integer, (const char *)params + info->offset, sizeof integer);
    if (info->kind == FST_KIND_INT)
        return json_integer(integer);
    memcpy(&real, (const char *)params + info->offset, sizeof real);
    return fst_json_number(real);
}

/* The parts as a list of objects, each with its kind, and lists of numbers in SI. */
static json_t *parts_array(const fst_params *params)
{
    json_t *parts = json_array(), *part = NULL;
    for (int i = fst_param_count(); i < fst_params_row_count(params); ++i) {
        const char *key = strrchr(fst_param_at(i)->key, '.') + 1;
        const size_t length = strcspn(key, "[");
        char name[32];
        (void)snprintf(name, sizeof name, "%.*s", (int)length, key);
        json_t *value = parameter(params, i);
        if (fst_param_at(i)->kind == FST_KIND_CHOICE) {
            part = json_object();
            json_array_append_new(parts, part);
            json_object_set_new(part, name, value);
        } else if (json_is_null(value)) {
            json_decref(value); /* the kind of part has no such number */
        } else {
            if (!json_object_get(part, name))
                json_object_set_new(part, name, json_array());
            json_array_append_new(json_object_get(part, name), value);
        }
    }
    return parts;
}

json_t *fst_json_scene(const fst_params *params)
{
    json_t *scene = json_object();
    for (int i = 0; i < fst_param_count(); ++i)
        json_object_set_new(scene, fst_param_at(i)->key, parameter(params, i));
    if (params->magnet_part_count)
        json_object_set_new(scene, "magnet.parts", parts_array(params));
    return scene;
}

static json_t *groups_object(const fst_params *params)
{
    fst_model *model = NULL;
    if (fst_model_new(params, &model, NULL) != FST_OK)
        return json_null();
    fst_groups g = fst_model_groups(model);
    fst_model_free(model);
    json_t *groups = json_object();
    const struct {
        const char *name;
        double value;
    } numbers[] = {
        {"eps", g.eps},
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
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; ++i)
        json_object_set_new(groups, numbers[i].name, fst_json_number(numbers[i].value));
    json_object_set_new(groups, "lines", json_integer(g.lines));
    return groups;
}

json_t *fst_json_numbers(const double *values, int count)
{
    json_t *array = json_array();
    for (int i = 0; i < count; ++i)
        json_array_append_new(array, fst_json_number(values[i]));
    return array;
}

static json_t *ramp_array(const fst_ramp_point *ramp, size_t count)
{
    json_t *array = json_array();
    for (size_t i = 0; i < count; ++i) {
        json_t *point = json_object();
        json_object_set_new(point, "omega", fst_json_number(ramp[i].omega));
        json_object_set_new(point, "frequency_hz", fst_json_number(ramp[i].frequency_hz));
        json_object_set_new(point, "mean_r", fst_json_number(ramp[i].mean_r));
        json_object_set_new(point, "std_r", fst_json_number(ramp[i].std_r));
        json_object_set_new(point, "mean_alpha_dot", fst_json_number(ramp[i].mean_alpha_dot));
        json_object_set_new(point, "mean_phi_dot", fst_json_number(ramp[i].mean_phi_dot));
        json_object_set_new(point, "mean_nz", fst_json_number(ramp[i].mean_nz));
        json_object_set_new(point, "settled", json_boolean(ramp[i].settled));
        json_array_append_new(array, point);
    }
    return array;
}

static const char *choice_text(const fst_params *params, const char *key, char *text, size_t size)
{
    (void)fst_params_get(params, fst_param_find(key), text, size);
    return text;
}

char *fst_json_dump(json_t *document, size_t flags)
{
    char *text = document ? json_dumps(document, flags | JSON_REAL_PRECISION(17)) : NULL;
    json_decref(document);
    if (!text)
        return NULL;
    size_t length = strlen(text);
    char *longer = realloc(text, length + 2);
    if (!longer) {
        free(text);
        return NULL;
    }
    memcpy(longer + length, "\n", 2);
    return longer;
}

json_t *fst_json_run(const fst_params *params, const fst_run_result *result)
{
    char dynamics[48], controller[48];
    json_t *run = json_object();
    json_object_set_new(run, "regime", text_or_null(fst_regime_name(result->regime)));
    json_object_set_new(run, "reason", text_or_null(result->reason));
    json_object_set_new(run, "symmetry", text_or_null(fst_symmetry_name(result->symmetry)));
    json_object_set_new(run, "dynamics",
                        text_or_null(choice_text(params, "model.dynamics", dynamics, sizeof dynamics)));
    json_object_set_new(run, "controller",
                        text_or_null(choice_text(params, "run.controller", controller, sizeof controller)));
    for (int i = 0; i < fst_result_count(); ++i) {
        const fst_result_info *info = fst_result_at(i);
        double value;
        memcpy(&value, (const char *)result + info->offset, sizeof value);
        json_object_set_new(run, info->name, fst_json_number(value));
    }
    json_object_set_new(run, "never_slips",
                        result->never_slips < 0 ? json_null() : json_boolean(result->never_slips));
    json_object_set_new(run, "returns", json_integer(result->returns));
    json_object_set_new(run, "rhs_calls", count_of(result->rhs_calls));
    json_object_set_new(run, "steps_accepted", count_of(result->accepted));
    json_object_set_new(run, "steps_rejected", count_of(result->rejected));
    json_object_set_new(run, "final_state", fst_json_numbers(result->final_state, FST_STATE_SIZE));
    return run;
}

char *fst_result_line(const fst_params *params, const fst_run_result *result)
{
    char *text = fst_json_dump(fst_json_run(params, result), JSON_COMPACT);
    if (text)
        text[strlen(text) - 1] = '\0';
    return text;
}

/* How the key of a number in SI ends, by the number's scaled unit. */
static const struct {
    const char *unit, *ending;
} si_endings[] = {
    {"l", "_m"},       {"B0", "_tesla"},          {"l gamma", "_m_per_s"},    {"gamma", "_per_s"},
    {"1/gamma", "_s"}, {"l gamma^2", "_newtons"}, {"l^2 gamma^2", "_joules"}, {"l^2 gamma^3", "_watts"},
};

/* The numbers of a run in SI; a load in weights, mean_load_weights, becomes mean_load_newtons. */
static void add_si(json_t *run, const fst_params *params, const fst_run_result *result)
{
    const fst_scales scales = fst_scales_of(params);
    for (int i = 0; i < fst_result_count(); ++i) {
        const fst_result_info *info = fst_result_at(i);
        const char *in_weights = strstr(info->name, "_weights"), *unused;
        char key[64];
        double value;
        memcpy(&value, (const char *)result + info->offset, sizeof value);
        if (in_weights) {
            (void)snprintf(key, sizeof key, "%.*s_newtons", (int)(in_weights - info->name), info->name);
            json_object_set_new(run, key, fst_json_number(value * scales.mass * params->plate_gravity));
        }
        for (size_t k = 0; k < sizeof si_endings / sizeof *si_endings; ++k) {
            if (strcmp(info->unit, si_endings[k].unit) != 0)
                continue;
            const int unknown = strcmp(info->unit, "B0") == 0 && isnan(scales.field);
            const double factor = fst_unit_shown(info->unit, FST_SHOWN_SI, &scales, &unused);
            (void)snprintf(key, sizeof key, "%s%s", info->name, si_endings[k].ending);
            json_object_set_new(run, key, fst_json_number(unknown ? NAN : value * factor));
        }
    }
}

char *fst_run_json(const fst_params *params, const fst_run_result *result, const fst_ramp_point *ramp,
                   size_t ramp_count)
{
    return fst_run_json_in(params, result, ramp, ramp_count, FST_SHOWN_SCALED);
}

char *fst_run_json_in(const fst_params *params, const fst_run_result *result, const fst_ramp_point *ramp,
                      size_t ramp_count, fst_shown_units units)
{
    json_t *run = fst_json_run(params, result);
    if (units == FST_SHOWN_LAB || units == FST_SHOWN_SI)
        add_si(run, params, result);
    json_object_set_new(run, "groups", groups_object(params));
    json_object_set_new(run, "scene", fst_json_scene(params));
    if (ramp_count)
        json_object_set_new(run, "ramp", ramp_array(ramp, ramp_count));
    json_object_set_new(run, "version", json_string(fst_version()));
    return fst_json_dump(run, JSON_INDENT(2));
}

/* What can be told of a measured field, in SI. */
static json_t *map_object(const fst_field_map *map)
{
    const fst_field_map_facts facts = fst_field_map_describe(map);
    json_t *object = json_object(), *count = json_array();
    for (int axis = 0; axis < 3; ++axis)
        json_array_append_new(count, json_integer(facts.count[axis]));
    json_object_set_new(object, "count", count);
    json_object_set_new(object, "first_m", fst_json_numbers(facts.first, 3));
    json_object_set_new(object, "spacing_m", fst_json_numbers(facts.spacing, 3));
    json_object_set_new(object, "radius_m", fst_json_number(facts.radius));
    json_object_set_new(object, "greatest_b_tesla", fst_json_number(facts.greatest));
    json_object_set_new(object, "curl", fst_json_number(facts.curl));
    return object;
}

char *fst_scene_json(const fst_params *params)
{
    json_t *document = json_object();
    json_object_set_new(document, "scene", fst_json_scene(params));
    json_object_set_new(document, "groups", groups_object(params));
    json_t *warnings = json_array();
    char sentence[512];
    if (fst_bead_contradiction(params, sentence, sizeof sentence))
        json_array_append_new(warnings, json_string(sentence));
    json_object_set_new(document, "warnings", warnings);
    if (params->magnet_map)
        json_object_set_new(document, "map", map_object(params->magnet_map));
    return fst_json_dump(document, JSON_INDENT(2));
}

/* The field and its gradient times the units `field` and `slope`, under two keys. */
static void add_field(json_t *document, const double b[3], double grad[3][3], double field, double slope,
                      const char *field_key, const char *slope_key)
{
    double scaled[4][3];
    json_t *rows = json_array();
    for (int k = 0; k < 3; ++k) {
        scaled[0][k] = field * b[k];
        for (int i = 0; i < 3; ++i)
            scaled[1 + i][k] = slope * grad[i][k];
    }
    for (int i = 0; i < 3; ++i)
        json_array_append_new(rows, fst_json_numbers(scaled[1 + i], 3));
    json_object_set_new(document, field_key, fst_json_numbers(scaled[0], 3));
    json_object_set_new(document, slope_key, rows);
}

/* The magnetic force on a bead whose moment lies along the field, and its load on the plate. */
static void add_pull(json_t *document, const fst_model *model, double x, double y, fst_shown_units units)
{
    const fst_groups g = fst_model_groups(model);
    const double newton = g.mass * g.length_unit / (g.time_unit * g.time_unit);
    double force[3], load;
    fst_field_pull(model, x, y, force, &load);
    json_object_set_new(document, "height", fst_json_number(g.h));
    json_object_set_new(document, "force", fst_json_numbers(force, 3));
    json_object_set_new(document, "load", fst_json_number(load));
    if (units != FST_SHOWN_SI && units != FST_SHOWN_LAB)
        return;
    for (int i = 0; i < 3; ++i)
        force[i] *= newton;
    json_object_set_new(document, "force_newtons", fst_json_numbers(force, 3));
    json_object_set_new(document, "load_newtons", fst_json_number(newton * load));
}

char *fst_field_json(const fst_model *model, double x, double y, fst_shown_units units)
{
    double b[3], grad[3][3];
    const fst_groups groups = fst_model_groups(model);
    fst_field(model, x, y, b, grad);
    json_t *document = json_object();
    json_object_set_new(document, "x", fst_json_number(x));
    json_object_set_new(document, "y", fst_json_number(y));
    add_field(document, b, grad, 1.0, 1.0, "b", "grad");
    if (units == FST_SHOWN_SI || units == FST_SHOWN_LAB)
        add_field(document, b, grad, groups.field_unit, groups.field_unit / groups.length_unit, "b_tesla",
                  "grad_tesla_per_m");
    add_pull(document, model, x, y, units);
    return fst_json_dump(document, JSON_INDENT(2));
}

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

static json_t *schema_row(int index)
{
    static const char *const kinds[] = {[FST_KIND_REAL] = "real",
                                        [FST_KIND_INT] = "integer",
                                        [FST_KIND_CHOICE] = "choice",
                                        [FST_KIND_TEXT] = "text"};
    const fst_param_info *info = fst_param_at(index);
    const int choice = info->kind == FST_KIND_CHOICE, limits = !choice && info->kind != FST_KIND_TEXT;
    json_t *row = json_object();
    json_object_set_new(row, "key", json_string(info->key));
    json_object_set_new(row, "kind", json_string(kinds[info->kind]));
    json_object_set_new(row, "unit", limits ? json_string(fst_unit_name(info->unit)) : json_null());
    json_object_set_new(row, "default", schema_default(info, index));
    json_object_set_new(row, "min", limits ? fst_json_number(info->least) : json_null());
    json_object_set_new(row, "max", limits ? fst_json_number(info->greatest) : json_null());
    json_object_set_new(row, "doc", json_string(info->doc));
    json_t *names = choice ? json_array() : json_null();
    for (const char *name = choice ? info->names : ""; *name; name += strspn(name, "|")) {
        size_t length = strcspn(name, "|");
        json_array_append_new(names, json_stringn(name, length));
        name += length;
    }
    json_object_set_new(row, "names", names);
    json_object_set_new(row, "other_form", text_or_null(fst_param_other_form(info->key)));
    /* of a key of the first part: how many parts may have it */
    json_object_set_new(row, "parts", fst_param_part(index) == 0 ? json_integer(FST_PARTS_MAX) : json_null());
    return row;
}

char *fst_schema_json(void)
{
    json_t *schema = json_array();
    for (int i = 0; i < fst_param_count() || fst_param_part(i) == 0; ++i)
        json_array_append_new(schema, schema_row(i));
    return fst_json_dump(schema, JSON_INDENT(2));
}
