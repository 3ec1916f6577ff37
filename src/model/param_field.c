/* param_field.c - one field of fst_params by its row: its value, and whether that lies in the row's range. */
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/listed.h"
#include "base/units.h"
#include "model/params.h"

double fst_param_value(const fst_params *params, const fst_param_info *row)
{
    const void *field = (const char *)params + row->offset;
    return row->kind == FST_KIND_REAL ? *(const double *)field : *(const int *)field;
}

void fst_param_put(fst_params *params, const fst_param_info *row, double value)
{
    void *field = (char *)params + row->offset;
    if (row->kind == FST_KIND_REAL)
        *(double *)field = value;
    else
        *(int *)field = (int)value;
}

fst_status fst_param_check_range(const fst_param_info *row, double value, const char *shown, const char *remark,
                                 fst_error *error)
{
    char given[64], least[64], greatest[64];
    const int whole = row->kind == FST_KIND_INT;
    if (value >= row->least && value <= row->greatest && (!whole || value == floor(value)))
        return FST_OK;
    (void)fst_value_write(given, sizeof given, value, row->unit);
    (void)fst_value_write(least, sizeof least, row->least, row->unit);
    (void)fst_value_write(greatest, sizeof greatest, row->greatest, row->unit);
    return fst_fail(error, FST_BAD_INPUT, row->key, "%s = %s is out of range: it must be %s%s to %s%s",
                    row->key, shown ? shown : given, whole ? "an integer from " : "", least, greatest, remark);
}

fst_status fst_param_validate(const fst_params *params, const fst_param_info *row, fst_error *error)
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
    if (value == row->initial || *fst_name_at(row->names, (int)value, &length))
        return FST_OK;
    return fst_fail(error, FST_BAD_INPUT, row->key, "%s: no choice has the number %g (choices: %s)", row->key,
                    value, row->names);
}
