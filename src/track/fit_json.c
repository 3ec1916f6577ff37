/* fit_json.c - a fit as JSON. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <string.h>

#include "io/json_parts.h"

static json_t *parameter_object(const fst_fit_parameter *p, int bootstrap)
{
    json_t *object = json_object();
    json_object_set_new(object, "key", json_string(p->key));
    json_object_set_new(object, "value", fst_json_number(p->value));
    json_object_set_new(object, "error", fst_json_number(p->error));
    json_object_set_new(object, "interval", fst_json_numbers(p->interval, 2));
    json_object_set_new(object, "unit", json_string(fst_unit_name(p->unit)));
    if (!isnan(p->prior[0]))
        json_object_set_new(object, "given", fst_json_numbers(p->prior, 2));
    if (bootstrap)
        json_object_set_new(object, "bootstrap_error", fst_json_number(p->bootstrap_error));
    return object;
}

static json_t *parameter_list(const fst_fit *fit, int from, int to)
{
    json_t *list = json_array();
    for (int i = from; i < to; ++i)
        json_array_append_new(list, parameter_object(&fit->parameters[i], fit->bootstrap_count > 0));
    return list;
}

static json_t *correlation(const fst_fit *fit)
{
    json_t *rows = json_array();
    for (int i = 0; i < fit->free_count; ++i)
        json_array_append_new(rows, fst_json_numbers(fit->correlation[i], fit->free_count));
    return rows;
}

static json_t *outliers(const fst_fit *fit)
{
    json_t *list = json_array();
    for (size_t i = 0; i < fit->outlier_count; ++i) {
        const fst_fit_outlier *o = &fit->outliers[i];
        json_t *object = json_object();
        json_object_set_new(object, "line", json_integer(o->line));
        json_object_set_new(object, "column", json_string(fst_measured_name(o->what)));
        json_object_set_new(object, "column_number", json_integer(o->column));
        json_object_set_new(object, "value", fst_json_number(o->value));
        json_object_set_new(object, "expected", fst_json_number(o->expected));
        json_object_set_new(object, "deviation", fst_json_number(o->deviation));
        json_array_append_new(list, object);
    }
    return list;
}

/* The name of a choice, by its row in the table of parameters. */
static json_t *choice_name(const char *key, int index)
{
    const char *names = fst_param_at(fst_param_find(key))->names;
    for (; index > 0 && *names; --index) {
        names += strcspn(names, "|");
        names += *names == '|';
    }
    return json_stringn(names, strcspn(names, "|"));
}

static json_t *rivals(const fst_fit *fit)
{
    json_t *list = json_array();
    for (int i = 0; i < fit->rival_count; ++i) {
        const fst_fit_rival *r = &fit->rivals[i];
        json_t *object = json_object();
        json_object_set_new(object, "law", choice_name("friction.law", r->law));
        json_object_set_new(object, "dynamics", choice_name("model.dynamics", r->dynamics));
        json_object_set_new(object, "chi2", fst_json_number(r->fitted ? r->chi2 : NAN));
        json_object_set_new(object, "aicc", fst_json_number(r->fitted ? r->aicc : NAN));
        json_array_append_new(list, object);
    }
    return list;
}

static json_t *remarks(const fst_fit *fit)
{
    json_t *list = json_array();
    for (const char *at = fit->remarks; *at;) {
        const size_t length = strcspn(at, "\n");
        json_array_append_new(list, json_stringn(at, length));
        at += length + (at[length] == '\n');
    }
    return list;
}

char *fst_fit_json(const fst_params *params, const fst_fit *fit)
{
    json_t *object = json_object(), *derived = json_object(), *strength = json_object();
    json_object_set_new(object, "parameters", parameter_list(fit, 0, fit->free_count));
    json_object_set_new(object, "given", parameter_list(fit, fit->free_count, fit->count));
    json_object_set_new(strength, "value", fst_json_number(fit->kappa_gamma2));
    json_object_set_new(strength, "error", fst_json_number(fit->kappa_gamma2_error));
    json_object_set_new(strength, "unit", json_string("1/s^2"));
    json_object_set_new(derived, "kappa_gamma2", strength);
    json_object_set_new(object, "derived", derived);
    json_object_set_new(object, "correlation", correlation(fit));
    json_object_set_new(object, "chi2", fst_json_number(fit->chi2));
    json_object_set_new(object, "dof", json_integer(fit->dof));
    json_object_set_new(object, "points", json_integer(fit->points));
    json_object_set_new(object, "error_scale", fst_json_number(fit->error_scale));
    json_object_set_new(object, "aicc", fst_json_number(fit->aicc));
    json_object_set_new(object, "weakest", json_string(fit->weakest));
    json_object_set_new(object, "outliers", outliers(fit));
    if (fit->rival_count)
        json_object_set_new(object, "rivals", rivals(fit));
    if (fit->bootstrap_count)
        json_object_set_new(object, "bootstrap", json_integer(fit->bootstrap_count));
    json_object_set_new(object, "warnings", remarks(fit));
    json_object_set_new(object, "scene", fst_json_scene(params));
    return fst_json_dump(object, JSON_INDENT(2));
}
