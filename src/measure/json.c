/* json.c - a measurement as JSON. */
#include <festoon/festoon_tools.h>

#include <string.h>

#include "measure/work.h"

void measure_write(fst_json *json, const fst_measurement *measured)
{
    for (int i = 0; i < fst_measured_count(); ++i) {
        const fst_measured_info *info = fst_measured_at(i);
        double value;
        memcpy(&value, (const char *)measured + info->offset, sizeof value);
        fst_json_real(json, info->name, value);
    }
    fst_json_reals(json, "centre", measured->centre, 2);
    fst_json_reals(json, "centre_error", measured->centre_error, 2);
    fst_json_integer(json, "frames", measured->frames);
    fst_json_integer(json, "lost", measured->lost);
    fst_json_integer(json, "rejected", measured->rejected);
    fst_json_integer(json, "repeated", measured->repeated);
    fst_json_integer(json, "left_out", measured->left_out);
    fst_json_text(json, "motion",
                  measured->motion == FST_MOTION_UNKNOWN ? NULL : fst_motion_name(measured->motion));
    fst_json_text(json, "symmetry", fst_symmetry_name((fst_symmetry)measured->symmetry));
    fst_json_text(json, "length_unit", measured->length_unit);
    fst_json_open(json, "warnings", '[');
    for (int i = 0; i < measured->warning_count; ++i)
        fst_json_text(json, NULL, measured->warnings[i]);
    fst_json_close(json);
}

char *fst_measurement_json(const fst_measurement *measured)
{
    fst_json json = fst_json_begin('{');
    measure_write(&json, measured);
    return fst_json_end(&json, JSON_INDENT(2));
}
