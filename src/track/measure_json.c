/* measure_json.c - a measurement as JSON. */
#include <festoon/festoon_tools.h>

#include <string.h>

#include "io/json_parts.h"

char *fst_measurement_json(const fst_measurement *measured)
{
    static const char *const motions[] = {
        [FST_MOTION_TURNING] = "turning", [FST_MOTION_LOCKED] = "locked", [FST_MOTION_UNKNOWN] = NULL};
    static const char *const symmetries[] = {NULL, "S1", "S2"};
    json_t *document = json_object(), *warnings = json_array();
    for (int i = 0; i < fst_measured_count(); ++i) {
        const fst_measured_info *info = fst_measured_at(i);
        double value;
        memcpy(&value, (const char *)measured + info->offset, sizeof value);
        json_object_set_new(document, info->name, fst_json_number(value));
    }
    json_object_set_new(document, "centre", fst_json_numbers(measured->centre, 2));
    json_object_set_new(document, "centre_error", fst_json_numbers(measured->centre_error, 2));
    json_object_set_new(document, "frames", json_integer(measured->frames));
    json_object_set_new(document, "lost", json_integer(measured->lost));
    json_object_set_new(document, "rejected", json_integer(measured->rejected));
    json_object_set_new(document, "repeated", json_integer(measured->repeated));
    const char *motion = motions[measured->motion], *symmetry = symmetries[measured->symmetry];
    json_object_set_new(document, "motion", motion ? json_string(motion) : json_null());
    json_object_set_new(document, "symmetry", symmetry ? json_string(symmetry) : json_null());
    json_object_set_new(document, "length_unit", json_string(measured->length_unit));
    for (int i = 0; i < measured->warning_count; ++i)
        json_array_append_new(warnings, json_string(measured->warnings[i]));
    json_object_set_new(document, "warnings", warnings);
    return fst_json_dump(document, JSON_INDENT(2));
}
