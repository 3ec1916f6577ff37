/* params.c - parameters: defaults, setting them from text, and checking a whole struct.  All is generated from
 * params.def or driven by the rows made from it. */
#include "model/params.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/listed.h"
#include "base/number.h"
#include "base/text.h"
#include "base/units.h"
#include "model/forms.h"
#include "model/part_rows.h"

fst_params fst_default_params(void)
{
    fst_params params = {
        .cookie = FST_PARAMS_COOKIE,
#define FST_REAL(group, name, unit, initial, least, greatest, doc) .group##_##name = (initial),
#define FST_INT(group, name, initial, least, greatest, doc) .group##_##name = (initial),
#define FST_CHOICE(group, name, names, initial, doc) .group##_##name = (initial),
#define FST_TEXT(group, name, room, doc) .group##_##name = "",
#include <festoon/params.def>
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
    };
    fst_form_was_unset(&params, ""); /* every form is noted with its default */
    return params;
}

/* ---------------------------------------------------------------- reading a value from text */

static fst_status set_number(fst_params *params, const fst_param_info *row, const char *text, fst_error *error)
{
    double value;
    fst_error why = {FST_OK, "", ""};
    const fst_value_fault fault = fst_value_read(text, row->unit, &value, &why);
    if (fault != FST_VALUE_READ) {
        const char *accepted = fst_unit_accepted(row->unit);
        if (accepted[0] && fault != FST_VALUE_WRONG_UNIT && fault != FST_VALUE_COMMA)
            return fst_fail(error, FST_BAD_INPUT, row->key, "%s: %s (units here: %s)", row->key, why.sentence,
                            accepted);
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s: %s", row->key, why.sentence);
    }
    size_t length;
    const char *trimmed = fst_trim(text, &length);
    char shown[64];
    (void)snprintf(shown, sizeof shown, "%.*s", (int)(length < 40 ? length : 40), trimmed);
    const fst_status status = fst_param_check_range(row, value, shown, "", error);
    if (status == FST_OK)
        fst_param_put(params, row, value);
    return status;
}

static fst_status set_choice(fst_params *params, const fst_param_info *row, const char *text, fst_error *error)
{
    size_t length;
    const char *trimmed = fst_trim(text, &length);
    char word[64], suggestion[FST_SUGGESTION_SIZE], quoted[FST_QUOTE_SIZE];
    (void)snprintf(word, sizeof word, "%.*s", (int)(length < sizeof word ? length : sizeof word), trimmed);
    const int place = fst_name_place(word, row->names);
    const char *removed = fst_param_removed(row->key, word);
    if (place >= 0) {
        fst_param_put(params, row, place);
        return FST_OK;
    }
    if (removed)
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s", removed);
    return fst_fail(error, FST_BAD_INPUT, row->key, "%s: unknown choice %s; %s", row->key,
                    fst_quote(text, quoted), fst_suggest_name(word, row->names, suggestion));
}

/* Another file has another content; another checksum is that of another content. */
static void forget_map(fst_params *params, const char *key)
{
    const int file = strcmp(key, "magnet.file") == 0;
    if (file)
        params->magnet_checksum[0] = '\0';
    if (file || strcmp(key, "magnet.checksum") == 0)
        params->magnet_map = NULL;
}

/* A text is one line, because it is written into scenes and heads of files. */
static fst_status set_text(fst_params *params, const fst_param_info *row, const char *text, fst_error *error)
{
    size_t length;
    const char *trimmed = fst_trim(text, &length);
    if ((double)length > row->greatest)
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s: this text is longer than %g bytes", row->key,
                        row->greatest);
    char copy[FST_PARAM_TEXT_SIZE], tamed[FST_PARAM_TEXT_SIZE];
    (void)snprintf(copy, sizeof copy, "%.*s", (int)length, trimmed);
    (void)snprintf(tamed, sizeof tamed, "%s", copy);
    fst_text_tame(tamed);
    if (strcmp(copy, tamed) != 0)
        return fst_fail(error, FST_BAD_INPUT, row->key,
                        "%s: this is no text in UTF-8 without control characters: \"%s\"", row->key, tamed);
    memcpy((char *)params + row->offset, copy, length + 1);
    forget_map(params, row->key);
    return FST_OK;
}

fst_status fst_params_set(fst_params *params, const char *key, const char *text, fst_error *error)
{
    fst_params made = *params;
    fst_form_will_be_set(&made, key);
    fst_status status = fst_params_settle(&made, error);
    if (status != FST_OK)
        return status;
    const int index = fst_param_find(key), part_row = index - fst_param_count();
    if (index < 0)
        return fst_param_unknown_key(key, error);
    const fst_param_info *row = fst_param_at(index);
    status = part_row < 0 ? FST_OK : fst_part_may_set(&made, part_row, error);
    if (status == FST_OK)
        status = row->kind == FST_KIND_CHOICE ? set_choice(&made, row, text, error)
                 : row->kind == FST_KIND_TEXT ? set_text(&made, row, text, error)
                                              : set_number(&made, row, text, error);
    if (status != FST_OK)
        return status;
    if (part_row < 0)
        fst_form_was_set(&made, key);
    else
        fst_part_was_set(&made, part_row);
    *params = made;
    return FST_OK;
}

fst_status fst_params_unset(fst_params *params, const char *key, fst_error *error)
{
    const int index = fst_param_find(key);
    if (index < 0)
        return fst_param_unknown_key(key, error);
    if (fst_param_part(index) >= 0)
        return fst_fail(error, FST_BAD_INPUT, key,
                        "%s: the numbers of a part are given together, and none is taken back alone", key);
    const fst_status status = fst_params_settle(params, error);
    if (status != FST_OK)
        return status;
    const fst_param_info *row = fst_param_at(index);
    if (row->kind == FST_KIND_TEXT)
        memset((char *)params + row->offset, 0, (size_t)row->greatest + 1);
    else
        fst_param_put(params, row, row->initial);
    forget_map(params, key);
    fst_form_was_unset(params, key);
    return FST_OK;
}

int fst_params_get(const fst_params *params, int index, char *text, size_t size)
{
    fst_params room;
    const fst_param_info *row = fst_param_at(index);
    params = fst_params_settled(params, &room);
    if (size)
        text[0] = '\0';
    if (!row || fst_form_overridden(params, row->key) || index >= fst_params_row_count(params))
        return 0;
    const int part = fst_param_part(index);
    if (part >= 0 && !fst_part_has(params->magnet_parts[part].kind, index - fst_param_count()))
        return 0;
    if (row->kind == FST_KIND_TEXT)
        return snprintf(text, size, "%s", (const char *)params + row->offset);
    const double value = fst_param_value(params, row);
    if (row->kind != FST_KIND_CHOICE)
        return isnan(value) ? 0 : fst_number_write(text, size, value);
    size_t length;
    const char *name = fst_name_at(row->names, (int)value, &length);
    return snprintf(text, size, "%.*s", (int)length, name);
}

/* ---------------------------------------------------------------- checking a whole struct */

/* Whether a field that a program filled in by hand is what fst_params_set() would have let pass. */
static fst_status validate_row(const fst_params *params, const fst_param_info *row, fst_error *error)
{
    size_t length;
    if (row->kind == FST_KIND_TEXT) {
        if (memchr((const char *)params + row->offset, '\0', (size_t)row->greatest + 1))
            return FST_OK;
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s: this text has no end", row->key);
    }
    const double value = fst_param_value(params, row);
    if (row->kind != FST_KIND_CHOICE)
        return isnan(value) && isnan(row->initial) ? FST_OK
                                                   : fst_param_check_range(row, value, NULL, "", error);
    if (*fst_name_at(row->names, (int)value, &length))
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, row->key, "%s: no choice has the number %g (choices: %s)", row->key,
                    value, row->names);
}

/* The parts of a real magnet, and what gives the strength of its pull. */
static fst_status validate_magnet(const fst_params *params, fst_error *error)
{
    const fst_status status = fst_parts_validate(params, error);
    if (status != FST_OK)
        return status;
    if (!fst_magnet_in_tesla(params) && !isnan(params->bead_remanence) && isnan(params->magnet_b0))
        return fst_fail(error, FST_BAD_INPUT, "bead.remanence",
                        "bead.remanence = %g T needs magnet.b0 where the magnet's strength is not told in "
                        "tesla: give it too, or model.kappa in place of both",
                        params->bead_remanence);
    static const double least_unit = 1e-9;
    if (fst_magnet_in_tesla(params) && params->magnet_b0 < least_unit)
        return fst_fail(error, FST_BAD_INPUT, "magnet.b0",
                        "magnet.b0 = %g T is the unit of fields beside a real magnet: it must be at least %g T",
                        params->magnet_b0, least_unit);
    const int moment_given = !isnan(params->bead_moment) || !isnan(params->bead_remanence);
    if (fst_magnet_in_tesla(params) && fst_kappa_given(params) && moment_given)
        return fst_fail(error, FST_BAD_INPUT, "model.kappa",
                        "model.kappa and %s are both given, but beside a real magnet each gives the bead's "
                        "moment: give one of them",
                        isnan(params->bead_moment) ? "bead.remanence" : "bead.moment");
    return FST_OK;
}

double fst_run_discard(const fst_params *params)
{
    static const double unless_told = 200.0;
    const int short_run = params->run_discard == unless_told && params->run_periods <= unless_told;
    return short_run ? 0.5 * params->run_periods : params->run_discard;
}

/* Of settled parameters. */
static fst_status validate(const fst_params *params, fst_error *error)
{
    for (int i = 0; i < fst_param_count(); i++) {
        fst_status status = validate_row(params, fst_param_at(i), error);
        if (status != FST_OK)
            return status;
    }
    const fst_status of_magnet = validate_magnet(params, error);
    if (of_magnet != FST_OK)
        return of_magnet;
    if (params->friction_mu_static < params->friction_mu)
        return fst_fail(error, FST_BAD_INPUT, "friction.mu_static",
                        "friction.mu_static = %g is less than friction.mu = %g: friction at rest is at least "
                        "as strong as sliding friction",
                        params->friction_mu_static, params->friction_mu);
    if (params->friction_law == FST_FRICTION_COULOMB && params->contact_patch != FST_PATCH_POINT &&
        isnan(params->contact_radius) && isnan(params->contact_modulus))
        return fst_fail(error, FST_BAD_INPUT, "contact.patch",
                        "contact.patch needs the size of the disc: give contact.radius, or contact.modulus, "
                        "from which the radius follows with the load");
    if (!(fst_run_discard(params) < params->run_periods))
        return fst_fail(error, FST_BAD_INPUT, "run.discard",
                        "run.discard = %g leaves nothing of run.periods = %g: make run.periods larger or "
                        "run.discard smaller",
                        params->run_discard, params->run_periods);
    return FST_OK;
}

fst_status fst_params_check_part(const fst_params *params, int part, fst_error *error)
{
    fst_params room;
    return fst_part_check(fst_params_settled(params, &room), part, error);
}

fst_status fst_params_validate(fst_params *params, fst_error *error)
{
    const fst_status status = fst_params_settle(params, error);
    return status == FST_OK ? validate(params, error) : status;
}

const char *fst_dynamics_name(fst_dynamics dynamics)
{
    FST_NAME_IN(FST_DYNAMICS, dynamics, "unknown");
}
