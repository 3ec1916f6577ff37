/* json.c - a fit as JSON. */
#include <festoon/festoon_tools.h>

#include <math.h>
#include <string.h>

#include "io/json.h"

static void put_parameters(fst_json *json, const char *key, const fst_fit *fit, int from, int to)
{
    fst_json_open(json, key, '[');
    for (int i = from; i < to; ++i) {
        const fst_fit_parameter *p = &fit->parameters[i];
        fst_json_open(json, NULL, '{');
        fst_json_text(json, "key", p->key);
        fst_json_real(json, "value", p->value);
        fst_json_real(json, "error", p->error);
        fst_json_reals(json, "interval", p->interval, 2);
        fst_json_text(json, "unit", fst_unit_name(p->unit));
        if (!isnan(p->prior[0]))
            fst_json_reals(json, "given", p->prior, 2);
        if (fit->bootstrap_count > 0)
            fst_json_real(json, "bootstrap_error", p->bootstrap_error);
        fst_json_close(json);
    }
    fst_json_close(json);
}

static void put_derived(fst_json *json, const fst_fit *fit)
{
    fst_json_open(json, "derived", '{');
    if (!isnan(fit->kappa_gamma2)) {
        fst_json_open(json, "kappa_gamma2", '{');
        fst_json_real(json, "value", fit->kappa_gamma2);
        fst_json_real(json, "error", fit->kappa_gamma2_error);
        fst_json_text(json, "unit", "1/s^2");
        fst_json_close(json);
    }
    fst_json_close(json);
}

static void put_outliers(fst_json *json, const fst_fit *fit)
{
    fst_json_open(json, "outliers", '[');
    for (size_t i = 0; i < fit->outlier_count; ++i) {
        const fst_fit_outlier *o = &fit->outliers[i];
        fst_json_open(json, NULL, '{');
        fst_json_integer(json, "line", o->line);
        fst_json_text(json, "column", fst_measured_name(o->what));
        fst_json_integer(json, "column_number", o->column);
        fst_json_real(json, "value", o->value);
        fst_json_real(json, "expected", o->expected);
        fst_json_real(json, "deviation", o->deviation);
        fst_json_close(json);
    }
    fst_json_close(json);
}

/* The names of a parameter's choices. */
static const char *names_of(const char *key)
{
    return fst_param_at(fst_param_find(key))->names;
}

static void put_rivals(fst_json *json, const fst_fit *fit)
{
    fst_json_open(json, "rivals", '[');
    for (int i = 0; i < fit->rival_count; ++i) {
        const fst_fit_rival *r = &fit->rivals[i];
        fst_json_open(json, NULL, '{');
        fst_json_name(json, "law", names_of("friction.law"), r->law);
        fst_json_name(json, "dynamics", names_of("model.dynamics"), r->dynamics);
        fst_json_real(json, "chi2", r->fitted ? r->chi2 : NAN);
        fst_json_real(json, "aicc", r->fitted ? r->aicc : NAN);
        fst_json_close(json);
    }
    fst_json_close(json);
}

/* The remarks, a line each. */
static void put_warnings(fst_json *json, const fst_fit *fit)
{
    fst_json_open(json, "warnings", '[');
    for (const char *at = fit->remarks; *at;) {
        const size_t length = strcspn(at, "\n");
        fst_json_put(json, NULL, json_stringn(at, length));
        at += length + (at[length] == '\n');
    }
    fst_json_close(json);
}

char *fst_fit_json(const fst_params *params, const fst_fit *fit)
{
    fst_json json = fst_json_begin('{');
    put_parameters(&json, "parameters", fit, 0, fit->free_count);
    put_parameters(&json, "given", fit, fit->free_count, fit->count);
    put_derived(&json, fit);
    fst_json_open(&json, "correlation", '[');
    for (int i = 0; i < fit->free_count; ++i)
        fst_json_reals(&json, NULL, fit->correlation[i], fit->free_count);
    fst_json_close(&json);
    fst_json_real(&json, "chi2", fit->chi2);
    fst_json_integer(&json, "dof", fit->dof);
    fst_json_integer(&json, "points", fit->points);
    fst_json_real(&json, "error_scale", fit->error_scale);
    fst_json_real(&json, "aicc", fit->aicc);
    if (fit->drive != 0.0) {
        fst_json_open(&json, "drive", '{');
        fst_json_real(&json, "value", fit->drive);
        fst_json_real(&json, "error", fit->drive_error);
        fst_json_real(&json, "given", fit->drive_given);
        fst_json_text(&json, "unit", "Hz");
        fst_json_close(&json);
    }
    if (fit->slip_frames > 0) {
        fst_json_integer(&json, "slip_frames", fit->slip_frames);
        fst_json_integer(&json, "slip_fitted", fit->slip_fitted);
        fst_json_real(&json, "slip_misfit", fit->slip_misfit);
        fst_json_real(&json, "slip_chi2", fit->slip_chi2);
    }
    fst_json_text(&json, "weakest", fit->weakest);
    put_outliers(&json, fit);
    if (fit->rival_count)
        put_rivals(&json, fit);
    if (fit->bootstrap_count)
        fst_json_integer(&json, "bootstrap", fit->bootstrap_count);
    put_warnings(&json, fit);
    fst_json_scene(&json, params);
    return fst_json_end(&json, JSON_INDENT(2));
}
