/* coil_rows.c - the keys of coils: one static table for all that a scene may have, as part_rows.c has for parts. */
#include "model/coil_rows.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "model/params.h"

#define NUMBER(i, name, unit, initial, least, greatest, doc)                                                   \
    FST_PARAM_ROW("coils[" #i "]." #name, REAL, unit, NULL, initial, least, greatest, doc, coils[i].name)
#define CENTRE(i, k, axis)                                                                                     \
    NUMBER(i, centre[k], LENGTH, 0.0, -10.0, 10.0,                                                             \
           "Centre of the coil along " axis                                                                    \
           ": from the axis of rotation, and over the magnet's reference plane.")
#define AXIS(i, k, initial, along)                                                                             \
    NUMBER(i, axis[k], NUMBER, initial, -1e6, 1e6, "The coil's axis, its component along " along ".")
#define COIL(i)                                                                                                \
    NUMBER(i, radius, LENGTH, NAN, 1e-6, 10.0, "Radius of a circular coil that stands still."),                \
        CENTRE(i, 0, "x"), CENTRE(i, 1, "y"), CENTRE(i, 2, "z"), AXIS(i, 0, 0.0, "x"), AXIS(i, 1, 0.0, "y"),   \
        AXIS(i, 2, 1.0, "z"), NUMBER(i, turns, NUMBER, 1.0, 0.0, 1e6, "Turns of the coil's wire."),            \
        NUMBER(i, current, CURRENT, 0.0, -1e6, 1e6,                                                            \
               "Steady current, anticlockwise seen from where the axis points to."),                           \
        NUMBER(i, ac, CURRENT, 0.0, -1e6, 1e6,                                                                 \
               "Amplitude of an alternating current beside it, ac cos(2 pi frequency t + phase)."),            \
        NUMBER(i, frequency, FREQUENCY, 0.0, 0.0, 1e6, "Frequency of the alternating current."),               \
        NUMBER(i, phase, ANGLE, 0.0, -1e6, 1e6, "Its phase at the start.")

static const fst_param_info rows[] = {COIL(0), COIL(1), COIL(2), COIL(3), COIL(4), COIL(5), COIL(6), COIL(7)};
_Static_assert(sizeof rows / sizeof rows[0] == FST_COIL_ROWS, "a row for each key of each coil");

const fst_param_info *fst_coil_row(int row)
{
    return &rows[row];
}

fst_status fst_coil_may_set(const fst_params *params, int coil, fst_error *error)
{
    if (coil <= params->coil_count)
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, "coils",
                    "there is no coils[%d] before coils[%d]: coils are counted from 0", params->coil_count,
                    coil);
}

fst_status fst_coil_unknown_key(const char *key, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE], names[FST_COIL_FIELDS * 24] = "", suggestion[FST_SUGGESTION_SIZE];
    for (int field = 0; field < FST_COIL_FIELDS; ++field) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", rows[field].key);
    }
    return fst_fail(error, FST_BAD_INPUT, key, "unknown key %s; %s (at most %d coils, from coils[0] on)",
                    fst_quote(key, quoted), fst_suggest_name(key, names, suggestion), FST_COILS_MAX);
}

static fst_status check_coil(const fst_params *params, int i, fst_error *error)
{
    const double *axis = params->coils[i].axis;
    const fst_param_info *first = &rows[i * FST_COIL_FIELDS];
    if (isnan(params->coils[i].radius))
        return fst_fail(error, FST_BAD_INPUT, first->key, "coils[%d] has no radius: give %s", i, first->key);
    fst_status status = FST_OK;
    for (const fst_param_info *row = first; row < first + FST_COIL_FIELDS && status == FST_OK; ++row)
        status = fst_param_check_range(row, fst_param_value(params, row), NULL, "", error);
    if (status == FST_OK && axis[0] == 0.0 && axis[1] == 0.0 && axis[2] == 0.0)
        return fst_fail(error, FST_BAD_INPUT, "coils",
                        "coils[%d].axis is 0 0 0, which is not a direction: give x, y and z of the coil's axis",
                        i);
    return status;
}

fst_status fst_coils_validate(const fst_params *params, fst_error *error)
{
    if (params->coil_count < 0 || params->coil_count > FST_COILS_MAX)
        return fst_fail(error, FST_BAD_INPUT, "coils", "coil_count is %d: it must be 0 to %d",
                        params->coil_count, FST_COILS_MAX);
    fst_status status = FST_OK;
    for (int i = 0; i < params->coil_count && status == FST_OK; ++i)
        status = check_coil(params, i, error);
    return status;
}
