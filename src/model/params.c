/* params.c - the table of parameters: defaults, look-up, setting from text.  Everything here is generated
 * from params.def or driven by the rows made from it. */
#include "model/params.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/number.h"
#include "base/text.h"
#include "base/units.h"
#include "model/kinds.h"
#include "model/part_rows.h"

static const fst_param_info rows[] = {
#define FST_REAL(group, name, unit, initial, least, greatest, doc)                                             \
    {#group "." #name,                                                                                         \
     FST_KIND_REAL,                                                                                            \
     FST_UNIT_##unit,                                                                                          \
     NULL,                                                                                                     \
     initial,                                                                                                  \
     least,                                                                                                    \
     greatest,                                                                                                 \
     doc,                                                                                                      \
     offsetof(fst_params, group##_##name)},
#define FST_INT(group, name, initial, least, greatest, doc)                                                    \
    {#group "." #name,                                                                                         \
     FST_KIND_INT,                                                                                             \
     FST_UNIT_NUMBER,                                                                                          \
     NULL,                                                                                                     \
     initial,                                                                                                  \
     least,                                                                                                    \
     greatest,                                                                                                 \
     doc,                                                                                                      \
     offsetof(fst_params, group##_##name)},
#define FST_CHOICE(group, name, names, initial, doc)                                                           \
    {#group "." #name,                                                                                         \
     FST_KIND_CHOICE,                                                                                          \
     FST_UNIT_NUMBER,                                                                                          \
     names,                                                                                                    \
     initial,                                                                                                  \
     0,                                                                                                        \
     0,                                                                                                        \
     doc,                                                                                                      \
     offsetof(fst_params, group##_##name)},
#define FST_TEXT(group, name, room, doc)                                                                       \
    {#group "." #name,                                                                                         \
     FST_KIND_TEXT,                                                                                            \
     FST_UNIT_NUMBER,                                                                                          \
     NULL,                                                                                                     \
     NAN,                                                                                                      \
     0,                                                                                                        \
     (room)-1,                                                                                                 \
     doc,                                                                                                      \
     offsetof(fst_params, group##_##name)},
#include <festoon/params.def>
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
};
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };

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
    return params;
}

int fst_param_count(void)
{
    return ROW_COUNT;
}

const fst_param_info *fst_param_at(int index)
{
    if (index < 0 || index >= ROW_COUNT + FST_PART_ROWS)
        return NULL;
    return index < ROW_COUNT ? &rows[index] : fst_part_row(index - ROW_COUNT);
}

int fst_params_row_count(const fst_params *params)
{
    return ROW_COUNT + FST_PART_FIELDS * params->magnet_part_count;
}

int fst_param_part(int index)
{
    return index < ROW_COUNT ? -1 : (index - ROW_COUNT) / FST_PART_FIELDS;
}

int fst_param_find(const char *key)
{
    for (int i = 0; i < ROW_COUNT + FST_PART_ROWS; i++)
        if (strcmp(fst_param_at(i)->key, key) == 0)
            return i;
    return -1;
}

static double *real_field(fst_params *params, const fst_param_info *row)
{
    return (double *)(void *)((char *)params + row->offset);
}

static int *int_field(fst_params *params, const fst_param_info *row)
{
    return (int *)(void *)((char *)params + row->offset);
}

static double real_value(const fst_params *params, const fst_param_info *row)
{
    double value;
    memcpy(&value, (const char *)params + row->offset, sizeof value);
    return value;
}

static int int_value(const fst_params *params, const fst_param_info *row)
{
    int value;
    memcpy(&value, (const char *)params + row->offset, sizeof value);
    return value;
}

/* ---------------------------------------------------------------- one quantity, two forms */

/* The scaled form of a quantity, and the SI form that it overrides where it is given. */
static const struct {
    const char *scaled, *si;
} forms[] = {
    {"drive.omega", "drive.frequency"}, {"model.eps", "bead.radius"},
    {"model.h", "magnet.depth"},        {"model.lambda", "magnet.width"},
    {"model.kappa", "magnet.b0"},       {"contact.modulus", "contact.radius"},
    {"bead.density", "bead.mass"},      {"bead.remanence", "bead.moment"},
};
enum { FORM_COUNT = sizeof forms / sizeof forms[0] };

const char *fst_param_other_form(const char *key)
{
    for (int i = 0; i < FORM_COUNT; i++) {
        if (strcmp(forms[i].scaled, key) == 0)
            return forms[i].si;
        if (strcmp(forms[i].si, key) == 0)
            return forms[i].scaled;
    }
    return NULL;
}

static int moment_given(const fst_params *params)
{
    return !isnan(params->bead_moment) || !isnan(params->bead_remanence);
}

int fst_magnet_in_tesla(const fst_params *p)
{
    return p->magnet_shape == FST_MAGNET_PARTS || p->magnet_shape == FST_MAGNET_GRID;
}

int fst_kappa_given(const fst_params *params)
{
    return params->model_kappa_given || params->model_kappa != rows[fst_param_find("model.kappa")].initial;
}

int fst_kappa_follows(const fst_params *params)
{
    if (fst_magnet_in_tesla(params))
        return !fst_kappa_given(params);
    return moment_given(params) && !isnan(params->magnet_b0);
}

/* Whether the value in the field plays no part because the other form of the quantity is given. */
static int is_overridden(const fst_params *params, const fst_param_info *row)
{
    if (strcmp(row->key, "model.kappa") == 0)
        return fst_kappa_follows(params);
    for (int i = 0; i < FORM_COUNT; i++)
        if (strcmp(forms[i].si, row->key) == 0 && strcmp(row->key, "magnet.b0") != 0)
            return !isnan(real_value(params, &rows[fst_param_find(forms[i].scaled)]));
    return 0;
}

/* kappa was set, or the moment or B0 from which it may follow.  kappa is special: with lines it has two makers,
 * and B0 alone is no other form of it but the tesla scale; beside a real magnet B0 is a unit, and kappa and
 * moment are two forms of one quantity.  See params.def. */
static void take_back_strength(fst_params *params, const char *key)
{
    const int real = fst_magnet_in_tesla(params);
    if (strcmp(key, "model.kappa") == 0) {
        params->model_kappa_given = 1;
        if (!real)
            params->magnet_b0 = NAN;
        if (real)
            params->bead_moment = NAN;
        params->bead_remanence = NAN;
    } else if (real ? strcmp(key, "magnet.b0") != 0 : moment_given(params) && !isnan(params->magnet_b0)) {
        params->model_kappa = rows[fst_param_find("model.kappa")].initial;
        params->model_kappa_given = 0;
    }
}

/* After `key` was set: take back what says the same quantity otherwise.  An SI form that is overridden falls
 * back to its default, so that no forgotten value stays behind. */
static void take_back_other_form(fst_params *params, const char *key)
{
    const int is_moment = strcmp(key, "bead.moment") == 0 || strcmp(key, "bead.remanence") == 0;
    const int is_strength = strcmp(key, "model.kappa") == 0 || strcmp(key, "magnet.b0") == 0;
    const char *other = is_strength ? NULL : fst_param_other_form(key);
    if (is_strength || is_moment)
        take_back_strength(params, key);
    if (other) {
        const fst_param_info *row = &rows[fst_param_find(other)];
        *real_field(params, row) = row->initial;
    }
}

/* ---------------------------------------------------------------- reading a value from text */

/* Which keys may have been meant by a wrong one, from sure to any. */
enum { SAME_NAME, BEGINNING_OF_NAME, ANY_KEY };

/* "radius" and "magnet.radius" have the name of bead.radius and plate.radius, "freq" the beginning of one. */
static int may_mean(const char *wrong, const char *key, int how)
{
    const char *point = strchr(wrong, '.'), *name = point ? point + 1 : wrong, *own = strchr(key, '.') + 1;
    if (how == SAME_NAME)
        return strcmp(own, name) == 0;
    return how == ANY_KEY || (!point && strlen(name) > 2 && strncmp(own, name, strlen(name)) == 0);
}

static fst_status unknown_key(const char *key, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE], names[ROW_COUNT * 32] = "", nearest[48];
    if (strncmp(key, "magnet.parts", strlen("magnet.parts")) == 0)
        return fst_part_unknown_key(key, error);
    for (int how = SAME_NAME; how <= ANY_KEY && !names[0]; how++)
        for (int i = 0; i < ROW_COUNT; i++) {
            size_t used = strlen(names);
            if (may_mean(key, rows[i].key, how))
                (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", rows[i].key);
        }
    fst_nearest_name(key, names, nearest, sizeof nearest);
    return fst_fail(error, FST_BAD_INPUT, key,
                    "unknown key %s; the nearest is %s (fst_param_at() lists them all)", fst_quote(key, quoted),
                    nearest);
}

/* "0.001 mm to 1000 mm", as a message wants it. */
static void range_text(const fst_param_info *row, char *text, size_t size)
{
    char least[64], greatest[64];
    (void)fst_value_write(least, sizeof least, row->least, row->unit);
    (void)fst_value_write(greatest, sizeof greatest, row->greatest, row->unit);
    (void)snprintf(text, size, "%s to %s", least, greatest);
}

static fst_status out_of_range(const fst_param_info *row, const char *shown, fst_error *error)
{
    char range[160];
    range_text(row, range, sizeof range);
    return fst_fail(error, FST_BAD_INPUT, row->key, "%s = %s is out of range: it must be %s%s", row->key, shown,
                    row->kind == FST_KIND_INT ? "an integer from " : "", range);
}

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
    if (!(value >= row->least && value <= row->greatest) ||
        (row->kind == FST_KIND_INT && value != floor(value)))
        return out_of_range(row, shown, error);
    if (row->kind == FST_KIND_INT)
        *int_field(params, row) = (int)value;
    else
        *real_field(params, row) = value;
    return FST_OK;
}

static fst_status set_choice(fst_params *params, const fst_param_info *row, const char *text, fst_error *error)
{
    size_t length;
    const char *word = fst_trim(text, &length);
    int index = 0;
    for (const char *name = row->names; *name; index++) {
        size_t name_length = strcspn(name, "|");
        if (name_length == length && memcmp(name, word, length) == 0) {
            *int_field(params, row) = index;
            return FST_OK;
        }
        name += name_length;
        name += *name == '|';
    }
    char nearest[48], quoted[FST_QUOTE_SIZE];
    fst_nearest_name(word, row->names, nearest, sizeof nearest);
    return fst_fail(error, FST_BAD_INPUT, row->key, "%s: unknown choice %s; the nearest is %s (choices: %s)",
                    row->key, fst_quote(text, quoted), nearest, row->names);
}

/* A text is one line, because it is written into scenes and heads of files. */
static fst_status set_text(fst_params *params, const fst_param_info *row, const char *text, fst_error *error)
{
    size_t length;
    char *field = (char *)params + row->offset;
    const char *trimmed = fst_trim(text, &length);
    if ((double)length > row->greatest)
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s: this text is longer than %g bytes", row->key,
                        row->greatest);
    char copy[FST_PARAM_TEXT_SIZE], tamed[FST_PARAM_TEXT_SIZE];
    memcpy(copy, trimmed, length);
    copy[length] = '\0';
    memcpy(tamed, copy, length + 1);
    fst_text_tame(tamed);
    if (strcmp(copy, tamed) != 0)
        return fst_fail(error, FST_BAD_INPUT, row->key,
                        "%s: this is no text in UTF-8 without control characters: \"%s\"", row->key, tamed);
    memcpy(field, copy, length + 1);
    if (strcmp(row->key, "magnet.file") == 0) { /* another file has another content */
        params->magnet_checksum[0] = '\0';
        params->magnet_map = NULL;
    }
    return FST_OK;
}

fst_status fst_params_set(fst_params *params, const char *key, const char *text, fst_error *error)
{
    if (params->cookie != FST_PARAMS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_params_set",
                        "the parameters were never initialised: begin with fst_default_params()");
    int index = fst_param_find(key);
    if (index < 0)
        return unknown_key(key, error);
    const fst_param_info *row = fst_param_at(index);
    fst_status status = index < ROW_COUNT ? FST_OK : fst_part_may_set(params, index - ROW_COUNT, error);
    if (status == FST_OK)
        status = row->kind == FST_KIND_CHOICE ? set_choice(params, row, text, error)
                 : row->kind == FST_KIND_TEXT ? set_text(params, row, text, error)
                                              : set_number(params, row, text, error);
    if (status != FST_OK)
        return status;
    if (index < ROW_COUNT)
        take_back_other_form(params, key);
    else
        fst_part_was_set(params, index - ROW_COUNT);
    return FST_OK;
}

int fst_params_get(const fst_params *params, int index, char *text, size_t size)
{
    const fst_param_info *row = fst_param_at(index);
    if (size)
        text[0] = '\0';
    if (!row || is_overridden(params, row) || index >= fst_params_row_count(params))
        return 0;
    const int part = fst_param_part(index);
    if (part >= 0 && !fst_part_has(params->magnet_parts[part].kind, index - ROW_COUNT))
        return 0;
    if (row->kind == FST_KIND_TEXT)
        return snprintf(text, size, "%s", (const char *)params + row->offset);
    if (row->kind == FST_KIND_INT)
        return snprintf(text, size, "%d", int_value(params, row));
    if (row->kind == FST_KIND_REAL) {
        double value = real_value(params, row);
        return isnan(value) ? 0 : fst_number_write(text, size, value);
    }
    const char *name = row->names;
    for (int i = int_value(params, row); i > 0 && *name; i--) {
        name += strcspn(name, "|");
        name += *name == '|';
    }
    return snprintf(text, size, "%.*s", (int)strcspn(name, "|"), name);
}

/* ---------------------------------------------------------------- checking a whole struct */

static int choice_count(const char *names)
{
    int count = 1;
    for (; *names; names++)
        count += *names == '|';
    return count;
}

/* Whether a field that a program filled in by hand is what fst_params_set() would have let pass. */
static fst_status validate_row(const fst_params *params, const fst_param_info *row, fst_error *error)
{
    char shown[64];
    if (row->kind == FST_KIND_TEXT) {
        if (memchr((const char *)params + row->offset, '\0', (size_t)row->greatest + 1))
            return FST_OK;
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s: this text has no end", row->key);
    }
    if (row->kind == FST_KIND_CHOICE) {
        int value = int_value(params, row);
        if (value >= 0 && value < choice_count(row->names))
            return FST_OK;
        return fst_fail(error, FST_BAD_INPUT, row->key, "%s: no choice has the number %d (choices: %s)",
                        row->key, value, row->names);
    }
    double value = row->kind == FST_KIND_INT ? int_value(params, row) : real_value(params, row);
    if (isnan(value) && (isnan(row->initial) || is_overridden(params, row)))
        return FST_OK;
    if (value >= row->least && value <= row->greatest)
        return FST_OK;
    (void)fst_number_write(shown, sizeof shown, value);
    return out_of_range(row, shown, error);
}

/* The parts of a real magnet, and what tells the strength of its pull. */
static fst_status validate_magnet(const fst_params *params, fst_error *error)
{
    const fst_status status = fst_parts_validate(params, error);
    if (status != FST_OK)
        return status;
    if (!isnan(params->bead_moment) && !isnan(params->bead_remanence))
        return fst_fail(
            error, FST_BAD_INPUT, "bead.remanence",
            "bead.remanence and bead.moment are both given, but the moment follows from the remanence: "
            "give one of them");
    if (!fst_magnet_in_tesla(params) && !isnan(params->bead_remanence) && isnan(params->magnet_b0))
        return fst_fail(
            error, FST_BAD_INPUT, "bead.remanence",
            "bead.remanence = %g T needs magnet.b0 where the magnet's strength is not told in tesla: give "
            "it too, or model.kappa in place of both",
            params->bead_remanence);
    static const double least_unit = 1e-9;
    if (fst_magnet_in_tesla(params) && params->magnet_b0 < least_unit)
        return fst_fail(error, FST_BAD_INPUT, "magnet.b0",
                        "magnet.b0 = %g T is the unit of fields beside a real magnet: it must be at least %g T",
                        params->magnet_b0, least_unit);
    if (fst_magnet_in_tesla(params) && fst_kappa_given(params) && moment_given(params))
        return fst_fail(
            error, FST_BAD_INPUT, "model.kappa",
            "model.kappa and %s are both given, but beside a real magnet each gives the bead's moment: "
            "give one of them",
            isnan(params->bead_moment) ? "bead.remanence" : "bead.moment");
    return FST_OK;
}

double fst_run_discard(const fst_params *params)
{
    static const double unless_told = 200.0;
    const int short_run = params->run_discard == unless_told && params->run_periods <= unless_told;
    return short_run ? 0.5 * params->run_periods : params->run_discard;
}

fst_status fst_params_validate(const fst_params *params, fst_error *error)
{
    if (params->cookie != FST_PARAMS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_params",
                        "the parameters were never initialised: begin with fst_default_params()");
    for (int i = 0; i < ROW_COUNT; i++) {
        fst_status status = validate_row(params, &rows[i], error);
        if (status != FST_OK)
            return status;
    }
    const fst_status of_magnet = validate_magnet(params, error);
    if (of_magnet != FST_OK)
        return of_magnet;
    if (params->friction_mu_static < params->friction_mu)
        return fst_fail(
            error, FST_BAD_INPUT, "friction.mu_static",
            "friction.mu_static = %g is less than friction.mu = %g: friction at rest is at least as "
            "strong as sliding friction",
            params->friction_mu_static, params->friction_mu);
    if (!isnan(params->contact_radius) && !isnan(params->contact_modulus))
        return fst_fail(
            error, FST_BAD_INPUT, "contact.radius",
            "contact.radius and contact.modulus are both given, but the radius follows from the modulus: "
            "give one of them");
    if (params->friction_law == FST_FRICTION_COULOMB && params->contact_patch != FST_PATCH_POINT &&
        isnan(params->contact_radius) && isnan(params->contact_modulus))
        return fst_fail(
            error, FST_BAD_INPUT, "contact.patch",
            "contact.patch needs the size of the disc: give contact.radius, or contact.modulus, from which "
            "the radius follows with the load");
    if (!(fst_run_discard(params) < params->run_periods))
        return fst_fail(error, FST_BAD_INPUT, "run.discard",
                        "run.discard = %g leaves nothing of run.periods = %g: make run.periods larger or "
                        "run.discard smaller",
                        params->run_discard, params->run_periods);
    return FST_OK;
}

const char *fst_dynamics_name(fst_dynamics dynamics)
{
    static const char *const names[] = {
        [FST_DYNAMICS_RIGID] = "rigid", [FST_DYNAMICS_FARAGO2020] = "farago2020"};
    return (unsigned)dynamics < sizeof names / sizeof *names ? names[dynamics] : "unknown";
}
