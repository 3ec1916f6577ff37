/* space.c - the unknowns of a fit.
 *
 * Nearly all parameters are positive, and are known to a percentage rather than to an amount: they are sought
 * by their logarithms, which also keeps them positive.
 *
 * kappa = mu B0/(m R^2 gamma^2) is the magnetic strength measured in gamma, so nothing in it can be known
 * better than gamma.  What the motion feels is kappa gamma^2, and the friction beside it:
 *
 *      ln gamma |      the data's ellipse in (ln kappa, ln gamma) is a needle of slope -1/2;
 *               | \    in (ln kappa gamma^2, ln gamma) it stands upright, and both coordinates
 *               |  \   have errors of their own
 *               +------ ln kappa
 */
#include "fit/space.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/dot.h"
#include "base/error.h"
#include "base/number.h"
#include "base/text.h"

/* ------------------------------------------------------------------ keys */

/* Groups and keys that say how a motion begins, how long a run lasts and what ends it, or what the table says.
 */
static const char *unfit(const char *key)
{
    static const struct {
        const char *beginning, *why;
    } rows[] = {
        {"drive.", "the table says how often the magnet turns"},
        {"start.", "it says how the motion begins, and the table is of the motion that is left in the end"},
        {"run.", "it says how long a run lasts and how exact it is"},
        {"plate.radius", "it says where a bead is lost"},
        {"model.eps", "fit bead.radius, which is the same in metres"},
        {"model.h", "fit magnet.depth, which is the same in metres"},
        {"model.lambda", "fit magnet.width, which is the same in metres"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; ++i)
        if (strncmp(key, rows[i].beginning, strlen(rows[i].beginning)) == 0)
            return rows[i].why;
    return NULL;
}

static double value_of(const fst_params *params, const fst_param_info *info)
{
    double value;
    memcpy(&value, (const char *)params + info->offset, sizeof value);
    return value;
}

static fst_status unknown_key(const char *key, fst_error *error)
{
    size_t size = 1;
    for (int i = 0; i < fst_param_count(); ++i)
        size += strlen(fst_param_at(i)->key) + 1;
    char *names = calloc(size, 1), suggestion[FST_SUGGESTION_SIZE], quoted[FST_QUOTE_SIZE];
    if (!names)
        return fst_fail(error, FST_NO_MEMORY, "fst_fit_options", "out of memory");
    for (int i = 0; i < fst_param_count(); ++i)
        if (fst_param_at(i)->kind == FST_KIND_REAL && !unfit(fst_param_at(i)->key)) {
            if (names[0])
                strcat(names, "|");
            strcat(names, fst_param_at(i)->key);
        }
    (void)fst_suggest_name(key, names, suggestion);
    free(names);
    return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free",
                    "there is no key %s; of those that can be fitted %s", fst_quote(key, quoted), suggestion);
}

/* The value with which the search begins. */
static fst_status start_of(const fst_params *params, const fst_param_info *info, double *start,
                           fst_error *error)
{
    char text[64];
    *start = value_of(params, info);
    if (strcmp(info->key, "model.kappa") == 0 && fst_magnet_in_tesla(params) &&
        isfinite(fst_bead_moment(params)) &&
        fst_params_get(params, fst_param_find(info->key), text, sizeof text) == 0)
        return fst_fail(
            error, FST_BAD_INPUT, info->key,
            "beside a magnet in tesla kappa follows from the bead's moment: fit bead.remanence or bead.moment");
    if (strcmp(info->key, "model.kappa") == 0 && isfinite(params->bead_moment) && isfinite(params->magnet_b0))
        return fst_fail(error, FST_BAD_INPUT, info->key,
                        "kappa follows from bead.moment and magnet.b0, which were given: fit one of these");
    if (isnan(*start))
        return fst_fail(error, FST_BAD_INPUT, info->key,
                        "it has no value from which the search could begin; give it one in the scene");
    return FST_OK;
}

static fst_status add_key(fit_space *space, const char *key, int *index, fst_error *error)
{
    const int row = fst_param_find(key);
    if (row < 0)
        return unknown_key(key, error);
    const fst_param_info *info = fst_param_at(row);
    if (info->kind != FST_KIND_REAL)
        return fst_fail(
            error, FST_BAD_INPUT, "fst_fit_options.free",
            "%s is not a real number, so it cannot be fitted; the rivals compare friction laws and dynamics",
            key);
    if (unfit(key))
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free", "%s cannot be fitted: %s", key,
                        unfit(key));
    for (*index = 0; *index < space->count; ++*index)
        if (space->keys[*index].info == info)
            return FST_OK;
    if (space->count == FST_FIT_MOST_KEYS)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free", "there are more than %d parameters",
                        FST_FIT_MOST_KEYS);
    fit_key *added = &space->keys[space->count++];
    *added = (fit_key){info, 0.0, 0.0, {NAN, NAN}};
    return start_of(&space->base, info, &added->start, error);
}

/* ------------------------------------------------------------------ what is given */

static fst_status wrong_prior(const char *text, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE];
    return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.given",
                    "%s must be KEY=VALUE+-ERROR with an error greater than 0, as in magnet.depth=16.2+-0.2 mm",
                    fst_quote(text, quoted));
}

/* Where the unit behind a number begins. */
static size_t unit_place(const char *text)
{
    size_t at = strspn(text, " \t");
    at += fst_number_length(text + at);
    return at + strspn(text + at, " \t");
}

/* Read "16.2+-0.2 mm" or "16.2 mm +- 200 um": a value without a unit has that of the error. */
static fst_status read_prior(const char *text, const char *numbers, fst_unit unit, double prior[2],
                             fst_error *error)
{
    static const char *const signs[] = {"+-", "+/-", "\xC2\xB1"};
    for (size_t i = 0; i < sizeof signs / sizeof *signs; ++i) {
        const char *sign = strstr(numbers, signs[i]);
        if (!sign)
            continue;
        char value[128], error_text[64];
        (void)snprintf(error_text, sizeof error_text, "%s", sign + strlen(signs[i]));
        (void)snprintf(value, sizeof value, "%.*s", (int)(sign - numbers < 60 ? sign - numbers : 60), numbers);
        const size_t behind = unit_place(value);
        if (!value[behind])
            (void)snprintf(value + behind, sizeof value - behind, " %s", error_text + unit_place(error_text));
        fst_status status = fst_parse_value(value, unit, &prior[0], error);
        if (status == FST_OK)
            status = fst_parse_value(error_text, unit, &prior[1], error);
        if (status != FST_OK && error)
            (void)snprintf(error->where, sizeof error->where, "fst_fit_options.given");
        return status != FST_OK ? status : prior[1] > 0.0 ? FST_OK : wrong_prior(text, error);
    }
    return wrong_prior(text, error);
}

static fst_status add_given(fit_space *space, const char *text, fst_error *error)
{
    char key[96];
    size_t length;
    const char *equals = strchr(text, '='), *begin = fst_trim(text, &length);
    if (!equals || equals - begin > 90 || equals <= begin)
        return wrong_prior(text, error);
    (void)snprintf(key, sizeof key, "%.*s", (int)(equals - begin), begin);
    (void)fst_trim(key, &length);
    key[length] = '\0';
    int index = 0;
    fst_status status = add_key(space, key, &index, error);
    if (status != FST_OK) {
        if (error && strcmp(error->where, "fst_fit_options.free") == 0)
            (void)snprintf(error->where, sizeof error->where, "fst_fit_options.given");
        return status;
    }
    fit_key *k = &space->keys[index];
    if (!isnan(k->prior[0]))
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.given", "%s is given twice", key);
    status = read_prior(text, equals + 1, k->info->unit, k->prior, error);
    if (status != FST_OK)
        return status;
    if (k->prior[0] < k->info->least || k->prior[0] > k->info->greatest)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.given", "%s must lie from %.6g to %.6g", key,
                        k->info->least, k->info->greatest);
    k->start = k->prior[0];
    return FST_OK;
}

/* ------------------------------------------------------------------ coordinates */

static void choose_coordinates(fit_space *space)
{
    for (int i = 0; i < space->count; ++i) {
        fit_key *k = &space->keys[i];
        if (k->info->least < 0.0 || !(k->start > 0.0))
            k->scale = isfinite(k->prior[1]) ? k->prior[1]
                       : k->start != 0.0     ? fabs(k->start)
                                             : 1e-3 * fmin(k->info->greatest, 1.0);
        if (strcmp(k->info->key, "model.kappa") == 0)
            space->kappa = i;
        if (strcmp(k->info->key, "friction.gamma") == 0)
            space->gamma = i;
    }
    if (space->kappa < 0 || space->gamma < 0 || space->keys[space->kappa].scale != 0.0)
        space->kappa = space->gamma = -1;
}

fst_status fit_space_begin(fit_space *space, const fst_params *params, const fst_fit_options *options,
                           fst_error *error)
{
    *space = (fit_space){.base = *params, .kappa = -1, .gamma = -1};
    int index;
    const fst_status settled = fst_params_settle(&space->base, error);
    if (settled != FST_OK)
        return settled;
    if (options->free_count < 1)
        return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free",
                        "say which parameters are sought, such as model.kappa and friction.gamma");
    for (int i = 0; i < options->free_count; ++i) {
        const fst_status status = add_key(space, options->free[i], &index, error);
        if (status != FST_OK)
            return status;
        if (index != i)
            return fst_fail(error, FST_BAD_INPUT, "fst_fit_options.free", "%s is there twice",
                            options->free[i]);
    }
    space->free_count = space->count;
    for (int i = 0; i < options->given_count; ++i) {
        const fst_status status = add_given(space, options->given[i], error);
        if (status != FST_OK)
            return status;
    }
    choose_coordinates(space);
    return FST_OK;
}

void fit_space_own(const fit_space *space, int i, double c[FIT_MOST])
{
    memset(c, 0, FIT_MOST * sizeof *c);
    c[i] = 1.0;
    if (i == space->kappa)
        c[space->gamma] = -2.0; /* ln kappa = ln(kappa gamma^2) - 2 ln gamma */
}

double fit_space_at(const fit_space *space, int i, double q)
{
    const fit_key *k = &space->keys[i];
    return k->scale == 0.0 ? k->start * exp(q) : k->start + k->scale * q;
}

double fit_space_slope(const fit_space *space, int i, double q)
{
    const fit_key *k = &space->keys[i];
    return k->scale == 0.0 ? k->start * exp(q) : k->scale;
}

double fit_space_value(const fit_space *space, const double *u, int i)
{
    double c[FIT_MOST];
    fit_space_own(space, i, c);
    return fit_space_at(space, i, fst_dot(c, u, space->count));
}

double fit_space_params(const fit_space *space, const double *u, fst_params *params)
{
    double outside = 0.0;
    *params = space->base;
    for (int i = 0; i < space->count; ++i) {
        const fit_key *k = &space->keys[i];
        double value = fit_space_value(space, u, i);
        const double inside = fmin(fmax(value, k->info->least), k->info->greatest);
        if (value != inside)
            outside += k->scale == 0.0 ? fabs(log(value / inside)) : fabs(value - inside) / k->scale;
        value = inside;
        const char *other = fst_param_other_form(k->info->key);
        const int row = other ? fst_param_find(other) : -1;
        if (row >= 0 && fst_param_at(row)->kind == FST_KIND_REAL && isnan(fst_param_at(row)->initial)) {
            const double nothing = NAN;
            memcpy((char *)params + fst_param_at(row)->offset, &nothing, sizeof nothing);
        }
        memcpy((char *)params + k->info->offset, &value, sizeof value);
    }
    return outside;
}

fst_status fit_kappa_gamma2(const fst_params *params, double *value, fst_error *error)
{
    fst_model *model = NULL;
    const fst_status status = fst_model_new(params, &model, error);
    *value = NAN;
    if (status != FST_OK)
        return status == FST_NO_MEMORY ? status : FST_OK;
    const fst_groups groups = fst_model_groups(model);
    fst_model_free(model);
    *value = groups.kappa / (groups.time_unit * groups.time_unit);
    return FST_OK;
}
