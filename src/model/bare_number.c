/* bare_number.c - numbers without a unit that are probably meant in another unit than SI's. */
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/number.h"
#include "base/text.h"
#include "base/units.h"
#include "model/params.h"

static const double UNLIKELY = 20, /* times the default */
    UNLIKELY_TURNS = 30;           /* the same of drive.omega, which orbits are followed over up to 5 */

int fst_param_is_bare(const char *text)
{
    size_t length;
    const char *trimmed = fst_trim(text, &length);
    return length > 0 && fst_number_length(trimmed) == length;
}

const char *fst_param_unit_meant(const fst_param_info *row, double value)
{
    char text[64];
    double there;
    const char *unit = fst_unit_meant(row->unit, value, row->initial);
    (void)snprintf(text, sizeof text, "%.17g %s", value, unit ? unit : "");
    return unit && fst_parse_value(text, row->unit, &there, NULL) == FST_OK &&
                   fst_param_check_range(row, there, NULL, "", NULL) == FST_OK
               ? unit
               : NULL;
}

static int is_unlikely(const fst_params *params, const fst_param_info *row)
{
    if (strcmp(row->key, "drive.omega") == 0)
        return fst_drive_frequency(params) >
               UNLIKELY_TURNS * fst_param_at(fst_param_find("drive.frequency"))->initial;
    return row->kind == FST_KIND_REAL && fabs(fst_param_value(params, row)) > UNLIKELY * fabs(row->initial) &&
           fst_param_unit_meant(row, fst_param_value(params, row));
}

void fst_param_note_bare(fst_params *params, int index, const char *text)
{
    if (fst_param_is_bare(text) && is_unlikely(params, fst_param_at(index)))
        params->notes.bare = index + 1;
    else if (params->notes.bare == index + 1)
        params->notes.bare = 0;
}

int fst_params_bare_number(const fst_params *params, char *sentence, size_t size)
{
    const fst_param_info *row = fst_param_at(params->notes.bare - 1);
    if (size > 0)
        sentence[0] = '\0';
    if (!row || !is_unlikely(params, row))
        return 0;
    const double value = fst_param_value(params, row);
    if (row->unit == FST_UNIT_NUMBER)
        return snprintf(sentence, size,
                        "drive.omega = %.15g is an angular velocity in units of friction.gamma, here %.4g "
                        "turns a second; did "
                        "you mean drive.frequency = %.15g Hz?",
                        value, fst_drive_frequency(params), value);
    return snprintf(sentence, size,
                    "%s = %.15g was read as %.15g %s, %.0f times the default; did you mean %.15g %s?", row->key,
                    value, value, fst_unit_name(row->unit), fabs(value / row->initial), value,
                    fst_param_unit_meant(row, value));
}
