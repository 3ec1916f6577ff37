/* params.c - parameters: defaults, setting them from text, and checking a whole struct.  All is generated from
 * params.def or driven by the rows made from it. */
#include "model/params.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/listed.h"
#include "base/number.h"
#include "base/text.h"
#include "base/units.h"
#include "model/bead_list.h"
#include "model/bead_rows.h"
#include "model/forms.h"
#include "model/coil_rows.h"
#include "model/list_rows.h"
#include "model/part_rows.h"

fst_params fst_default_params(void)
{
    fst_params params = {
        .cookie = FST_PARAMS_COOKIE,
#define FST_REAL(group, name, unit, initial, least, greatest, doc) .group##_##name = (initial),
#define FST_INT(group, name, initial, least, greatest, doc) .group##_##name = (initial),
#define FST_CHOICE(group, name, names, initial, doc) .group##_##name = (initial),
#define FST_TEXT(group, name, room, doc) .group##_##name = "",
#define FST_REALS2(...)
#define FST_REALS3(...)
#include <festoon/params.def>
#undef FST_REALS2
#undef FST_REALS3
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
    };
    for (int i = 0; i < FST_LIST_ROWS; ++i)
        fst_param_put(&params, fst_list_row(i), fst_list_row(i)->initial);
    for (int i = 0; i < FST_COIL_ROWS; ++i)
        fst_param_put(&params, fst_coil_row(i), fst_coil_row(i)->initial);
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
    char shown[64], remark[128] = "";
    (void)snprintf(shown, sizeof shown, "%.*s", (int)(length < 40 ? length : 40), trimmed);
    const char *meant = fst_param_is_bare(text) ? fst_param_unit_meant(row, value) : NULL;
    if (meant)
        (void)snprintf(remark, sizeof remark, ", and %.9g without a unit is %.9g %s; did you mean %.9g %s?",
                       value, value, fst_unit_name(row->unit), value, meant);
    const fst_status status = fst_param_check_range(row, value, shown, remark, error);
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
                        "%s: this is not text in UTF-8 without control characters: \"%s\"", row->key, tamed);
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
    const int of_part = fst_param_part(index) >= 0, bead = fst_param_bead(index), coil = fst_param_coil(index);
    status = of_part ? fst_part_may_set(&made, part_row, error) : fst_bead_may_set(&made, bead, error);
    if (status == FST_OK)
        status = fst_coil_may_set(&made, coil, error);
    if (status == FST_OK)
        status = row->kind == FST_KIND_CHOICE ? set_choice(&made, row, text, error)
                 : row->kind == FST_KIND_TEXT ? set_text(&made, row, text, error)
                                              : set_number(&made, row, text, error);
    if (status != FST_OK)
        return status;
    if (of_part)
        fst_part_was_set(&made, part_row);
    else if (bead >= 0)
        fst_bead_was_set(&made, bead, row);
    else
        fst_form_was_set(&made, key);
    if (coil == made.coil_count)
        ++made.coil_count;
    fst_param_note_bare(&made, index, text);
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
    if (part >= params->magnet_part_count || fst_param_coil(index) >= params->coil_count)
        return 0;
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

/* The parts of a real magnet, and what gives the strength of its pull. */
static fst_status validate_magnet(const fst_params *params, fst_error *error)
{
    fst_status status = fst_parts_validate(params, error);
    if (status == FST_OK)
        status = fst_lists_validate(params, error);
    if (status == FST_OK)
        status = fst_beads_validate(params, error);
    if (status == FST_OK)
        status = fst_coils_validate(params, error);
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

/* What contradicts itself in a world of the bead that is not a flat plate in air. */
static fst_status validate_world(const fst_params *params, fst_error *error)
{
    const double radius =
        isnan(params->model_eps) ? params->bead_radius : params->model_eps * params->magnet_half_length;
    const int bowl = params->plate_shape == FST_PLATE_BOWL;
    if (bowl && !(params->plate_bowl_radius > radius))
        return fst_fail(
            error, FST_BAD_INPUT, "plate.bowl_radius",
            isnan(params->plate_bowl_radius)
                ? "plate.shape: bowl needs the radius of the bowl: give plate.bowl_radius"
                : "plate.bowl_radius = %g m: the bowl must be larger than the bead, whose radius is %g m",
            params->plate_bowl_radius, radius);
    if (params->plate_gravity < 0 && params->plate_shape != FST_PLATE_NONE)
        return fst_fail(
            error, FST_BAD_INPUT, "plate.gravity",
            "plate.gravity = %g m/s^2 pulls the bead off its plate: only plate.shape none has a bead "
            "that hangs below the magnet",
            params->plate_gravity);
    const int rates = !isnan(params->medium_drag_rate) || !isnan(params->medium_spin_drag_rate);
    if (rates && !isnan(params->medium_viscosity))
        return fst_fail(error, FST_BAD_INPUT, "medium.viscosity",
                        "medium.viscosity and medium.%s both say how the medium drags: give one of them",
                        isnan(params->medium_drag_rate) ? "spin_drag_rate" : "drag_rate");
    if (!isnan(params->medium_quadratic_drag) && params->medium_drag_coefficient > 0)
        return fst_fail(error, FST_BAD_INPUT, "medium.drag_coefficient",
                        "medium.drag_coefficient and medium.quadratic_drag say the same: give one of them");
    return FST_OK;
}

/* Of settled parameters. */
static fst_status validate(const fst_params *params, fst_error *error)
{
    for (int i = 0; i < fst_param_count(); i++) {
        fst_status status = fst_param_validate(params, fst_param_at(i), error);
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
    const char *length = isnan(params->run_duration) ? "run.periods" : "run.duration";
    if (!(fst_run_discard(params) < fst_run_periods(params)))
        return fst_fail(error, FST_BAD_INPUT, "run.discard",
                        "run.discard = %g leaves nothing of %s = %g: make %s larger or run.discard smaller",
                        params->run_discard, length,
                        isnan(params->run_duration) ? params->run_periods : params->run_duration, length);
    return validate_world(params, error);
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
