/* forms.c - one quantity, several forms: which form counts, and what giving one does to the others.
 *
 * The drive is drive.omega or drive.frequency; a model needs to know which.  A form is given by
 * fst_params_set(), or by a program that writes into the field.  So the struct carries `notes`: the values that
 * these fields had when the library last looked.  A field that differs from its note was written by the
 * program, and then counts as if fst_params_set() had been called.  Two forms of one quantity that were both
 * written since then contradict each other, for nobody knows which came last.
 *
 *   written        noted as seen    meaning
 *   same value     any              nothing was said
 *   a number       another          this form is given; the other forms go back to their defaults
 *   NAN            a number         this form is given no longer
 */
#include "model/forms.h"

#include <string.h>

#include "base/error.h"
#include "model/params.h"

/* Each scaled form, which overrides the SI form behind it where it is given. */
#define FORM(group, name)                                                                                      \
    {                                                                                                          \
#group "." #name, offsetof(fst_params, group##_##name)                                                 \
    }
static const struct {
    const char *key;
    size_t offset;
} forms[] = {FORM(drive, omega),  FORM(drive, frequency), FORM(model, eps),       FORM(bead, radius),
             FORM(model, h),      FORM(magnet, depth),    FORM(model, lambda),    FORM(magnet, width),
             FORM(model, kappa),  FORM(magnet, b0),       FORM(contact, modulus), FORM(contact, radius),
             FORM(bead, density), FORM(bead, mass),       FORM(bead, remanence),  FORM(bead, moment),
             FORM(run, duration), FORM(run, periods)};
enum { KAPPA = 8, B0, REMANENCE = 14, MOMENT, FORMS = FST_FORMS }; /* places in this table */
_Static_assert(sizeof forms / sizeof *forms == FORMS, "a note for each form");

/* The form that stands beside a form in the table. */
static int other_form(int form)
{
    return form ^ 1;
}

/* FORMS: the key's quantity has one form only. */
static int form_of(const char *key)
{
    int form = 0;
    while (form < FORMS && strcmp(forms[form].key, key) != 0)
        ++form;
    return form;
}

const char *fst_param_other_form(const char *key)
{
    const int form = form_of(key);
    return form < FORMS ? forms[other_form(form)].key : NULL;
}

static double value_of(const fst_params *params, int form)
{
    double value;
    memcpy(&value, (const char *)params + forms[form].offset, sizeof value);
    return value;
}

static void put(fst_params *params, int form, double value)
{
    memcpy((char *)params + forms[form].offset, &value, sizeof value);
}

static double default_of(int form)
{
    return fst_param_at(fst_param_find(forms[form].key))->initial;
}

/* ------------------------------------------------------------------ which form counts */

static int moment_given(const fst_params *params)
{
    return !isnan(params->bead_moment) || !isnan(params->bead_remanence);
}

int fst_magnet_in_tesla(const fst_params *params)
{
    return params->magnet_shape == FST_MAGNET_PARTS || params->magnet_shape == FST_MAGNET_GRID;
}

int fst_kappa_given(const fst_params *params)
{
    return params->notes.kappa_given;
}

int fst_kappa_follows(const fst_params *params)
{
    if (fst_magnet_in_tesla(params))
        return !fst_kappa_given(params);
    return moment_given(params) && !isnan(params->magnet_b0);
}

static int is_overridden(const fst_params *params, int form)
{
    const double value = value_of(params, form);
    if (!isnan(value) && value != default_of(form))
        return 0; /* it contradicts the other form */
    if (form == KAPPA)
        return fst_kappa_follows(params);
    return other_form(form) < form && form != B0 && !isnan(value_of(params, other_form(form)));
}

/* Whether a key tells the place of the start: 1 by distance and angle, 2 by a vector. */
static int start_place(const char *key)
{
    if (strcmp(key, "start.r") == 0 || strcmp(key, "start.phi") == 0)
        return 1;
    return strcmp(key, "start.position[0]") == 0 || strcmp(key, "start.position[1]") == 0 ? 2 : 0;
}

int fst_form_overridden(const fst_params *params, const char *key)
{
    const int form = form_of(key);
    if (start_place(key) == 1)
        return !isnan(params->start_position[0]) || !isnan(params->start_position[1]);
    return form < FORMS && is_overridden(params, form);
}

/* Whether two forms, given together, say one quantity twice.  kappa is special: with lines it has two makers,
 * and B0 alone is no other form of it but the tesla scale; beside a real magnet B0 is a unit, and kappa and
 * moment are two forms of one quantity.  See params.def. */
static int tell_the_same(const fst_params *params, int one, int two)
{
    const int first = one < two ? one : two, second = one < two ? two : one;
    const int real = fst_magnet_in_tesla(params);
    if (first != KAPPA)
        return second == other_form(first);
    return second == B0 ? !real && moment_given(params) : real && (second == MOMENT || second == REMANENCE);
}

/* The key behind "beads[N].", where both are keys of that bead; else as it is. */
static const char *without_bead(const char *key, const char *other)
{
    const char *end = strncmp(key, "beads[", strlen("beads[")) == 0 ? strchr(key, ']') : NULL;
    return end && strncmp(key, other, (size_t)(end - key) + 1) == 0 ? end + 2 : key;
}

int fst_params_clash(const fst_params *params, const char *key, const char *other)
{
    const char *one = without_bead(key, other), *two = without_bead(other, key);
    if (start_place(one) + start_place(two) == 3)
        return 1;
    const int first = form_of(one), second = form_of(two);
    return first < FORMS && second < FORMS && tell_the_same(params, first, second);
}

int fst_params_takes_back(const fst_params *before, const fst_params *after, const char *key)
{
    const int form = form_of(key);
    if (form == KAPPA)
        return fst_kappa_given(before) && !fst_kappa_given(after);
    return (form == B0 || form == REMANENCE || form == MOMENT) && !isnan(value_of(before, form)) &&
           isnan(value_of(after, form));
}

/* ------------------------------------------------------------------ giving a form */

/* kappa was given, or the moment or B0 from which it may follow. */
static void take_back_strength(fst_params *params, int form)
{
    const int real = fst_magnet_in_tesla(params);
    if (form == KAPPA) {
        params->notes.kappa_given = 1;
        put(params, real ? MOMENT : B0, NAN);
        put(params, REMANENCE, NAN);
    } else if (real ? form != B0 : moment_given(params) && !isnan(params->magnet_b0)) {
        params->notes.kappa_given = 0;
        put(params, KAPPA, default_of(KAPPA));
    }
}

/* A form was given: take back what says the same quantity otherwise.  An SI form that is overridden falls back
 * to its default, so that no forgotten value stays behind. */
static void take_back_others(fst_params *params, int form)
{
    if (form == KAPPA || form == B0 || form == MOMENT || form == REMANENCE)
        take_back_strength(params, form);
    if (form != KAPPA && form != B0)
        put(params, other_form(form), default_of(other_form(form)));
}

static void note(fst_params *params)
{
    for (int form = 0; form < FORMS; ++form)
        params->notes.seen[form] = value_of(params, form);
}

void fst_form_will_be_set(fst_params *params, const char *key)
{
    const int given = form_of(key);
    for (int form = 0; form < FORMS && given < FORMS; ++form)
        if (form == given || tell_the_same(params, form, given))
            put(params, form, params->notes.seen[form]);
}

void fst_form_was_set(fst_params *params, const char *key)
{
    const int form = form_of(key), place = start_place(key);
    if (form < FORMS)
        take_back_others(params, form);
    if (place == 1)
        params->start_position[0] = params->start_position[1] = NAN;
    if (place == 2) {
        params->start_r = fst_param_at(fst_param_find("start.r"))->initial;
        params->start_phi = fst_param_at(fst_param_find("start.phi"))->initial;
    }
    note(params);
}

void fst_form_was_unset(fst_params *params, const char *key)
{
    if (form_of(key) == KAPPA)
        params->notes.kappa_given = 0;
    note(params);
}

/* ------------------------------------------------------------------ forms that a program wrote into the struct
 */

static int is_as_noted(const fst_params *params, int form)
{
    const double value = value_of(params, form), seen = params->notes.seen[form];
    return value == seen || (isnan(value) && isnan(seen));
}

static int is_written(const fst_params *params, int form)
{
    return !isnan(value_of(params, form)) && !is_as_noted(params, form);
}

static int all_as_noted(const fst_params *params)
{
    int form = 0;
    while (form < FORMS && is_as_noted(params, form))
        ++form;
    return form == FORMS;
}

/* Give the forms that were written into `written`, kappa first: giving it clears B0, which may be given beside
 * it to scale the field. */
static fst_params give_written(const fst_params *written)
{
    fst_params made = *written;
    if (isnan(made.model_kappa))
        made.notes.kappa_given = 0;
    for (int i = 0; i < FORMS; ++i) {
        const int form = (KAPPA + i) % FORMS;
        if (is_written(written, form)) {
            put(&made, form, value_of(written, form));
            take_back_others(&made, form);
        }
    }
    for (int form = 0; form < FORMS; ++form)
        if (is_overridden(&made, form))
            put(&made, form, default_of(form)); /* a program may have put NAN there */
    note(&made);
    return made;
}

fst_status fst_params_settle(fst_params *params, fst_error *error)
{
    if (params->cookie != FST_PARAMS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_params",
                        "the parameters were never initialised: begin with fst_default_params()");
    if (all_as_noted(params))
        return FST_OK;
    const fst_params made = give_written(params);
    for (int one = 0; one < FORMS; ++one)
        for (int two = one + 1; two < FORMS; ++two)
            if (is_written(params, one) && is_written(params, two) && tell_the_same(&made, one, two))
                return fst_fail(error, FST_BAD_INPUT, forms[one].key,
                                "%s and %s are both given, but they tell the same quantity%s: give one of them "
                                "(a field of fst_params is not given where it is NAN)",
                                forms[one].key, forms[two].key,
                                one == KAPPA ? " (with the bead's moment)" : "");
    *params = made;
    return FST_OK;
}

const fst_params *fst_params_settled(const fst_params *params, fst_params *room)
{
    if (all_as_noted(params))
        return params;
    *room = *params;
    return fst_params_settle(room, NULL) == FST_OK ? room : params;
}
