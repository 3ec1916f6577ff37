/* part_rows.c - the keys of a magnet's parts: one static table for all parts that a magnet may have, so that a
 * number of a part is set, swept, fitted and compared like any parameter of params.def. */
#include "model/part_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "model/forms.h"
#include "model/params.h"

#define NUMBER(i, name, unit, initial, least, greatest, doc)                                                   \
    FST_PARAM_ROW("magnet.parts[" #i "]." #name, REAL, unit, NULL, initial, least, greatest, doc,              \
                  magnet_parts[i].name)
#define CENTRE(i, k, axis)                                                                                     \
    NUMBER(i, centre[k], LENGTH, NAN, -10.0, 10.0, "Centre of the part along " axis " of the magnet's frame.")
#define REMANENCE(i, k, axis)                                                                                  \
    NUMBER(i, remanence[k], FIELD, NAN, -10.0, 10.0,                                                           \
           "Remanence along the part's own " axis "; not of a dipole.")
#define MOMENT(i, k, axis)                                                                                     \
    NUMBER(i, moment[k], MOMENT, NAN, -1e6, 1e6, "Magnetic moment of a dipole along its own " axis ".")
#define TURN(i, k, axis)                                                                                       \
    NUMBER(i, rotation[k], NUMBER, 0.0, -1e6, 1e6,                                                             \
           "The axis about which the part is turned, its component along " axis ".")
#define PART(i)                                                                                                \
    FST_PARAM_ROW("magnet.parts[" #i "].kind", CHOICE, NUMBER, FST_WORDS(FST_PARTS), NAN, 0, 0,                \
                  "What the part is: a block, a cylinder, a sphere or a point dipole.", magnet_parts[i].kind), \
        CENTRE(i, 0, "x"), CENTRE(i, 1, "y"), CENTRE(i, 2, "z"),                                               \
        NUMBER(i, size[0], LENGTH, NAN, 1e-6, 10.0,                                                            \
               "Edge of a cuboid along its own x; diameter of a cylinder or a sphere."),                       \
        NUMBER(i, size[1], LENGTH, NAN, 1e-6, 10.0,                                                            \
               "Edge of a cuboid along its own y; height of a cylinder, along its own z."),                    \
        NUMBER(i, size[2], LENGTH, NAN, 1e-6, 10.0, "Edge of a cuboid along its own z."),                      \
        REMANENCE(i, 0, "x"), REMANENCE(i, 1, "y"), REMANENCE(i, 2, "z"), MOMENT(i, 0, "x"),                   \
        MOMENT(i, 1, "y"), MOMENT(i, 2, "z"),                                                                  \
        NUMBER(i, rotation[0], ANGLE, 0.0, -1e6, 1e6,                                                          \
               "Angle by which the part is turned about an axis through its centre."),                         \
        TURN(i, 1, "x"), TURN(i, 2, "y"), TURN(i, 3, "z"),                                                     \
        FST_PARAM_ROW("magnet.parts[" #i "].motion", CHOICE, NUMBER, FST_WORDS(FST_PART_MOTIONS),              \
                      FST_PART_TURNING, 0, 0, "Whether the part turns with the magnet: turning or fixed.",     \
                      magnet_parts[i].motion)

static const fst_param_info rows[] = {PART(0),  PART(1),  PART(2),  PART(3), PART(4),  PART(5),
                                      PART(6),  PART(7),  PART(8),  PART(9), PART(10), PART(11),
                                      PART(12), PART(13), PART(14), PART(15)};
_Static_assert(sizeof rows / sizeof rows[0] == FST_PART_ROWS, "a row for each key of each part");

const fst_param_info *fst_part_row(int row)
{
    return &rows[row];
}

/* ------------------------------------------------------------------ what a kind has */

enum {
    KIND_FIELD,
    CENTRE_FIELD,
    SIZE_FIELD = 4,
    REMANENCE_FIELD = 7,
    MOMENT_FIELD = 10,
    TURN_FIELD = 13,
    MOTION_FIELD = 17
};

#define KIND(NAME, name, doc, sizes, size_count) {name, sizes, size_count},
static const struct {
    const char *name, *sizes;
    int size_count;
} kinds[] = {FST_PARTS(KIND)};
#undef KIND

int fst_part_has(int kind, int row)
{
    const int field = row % FST_PART_FIELDS;
    if (field >= SIZE_FIELD && field < REMANENCE_FIELD)
        return field - SIZE_FIELD < kinds[kind].size_count;
    if (field >= REMANENCE_FIELD && field < MOMENT_FIELD)
        return kind != FST_PART_DIPOLE;
    if (field >= MOMENT_FIELD && field < TURN_FIELD)
        return kind == FST_PART_DIPOLE;
    return 1;
}

static fst_status has_not(int kind, int row, fst_error *error)
{
    const int field = row % FST_PART_FIELDS;
    const char *key = rows[row].key;
    if (field < REMANENCE_FIELD)
        return fst_fail(error, FST_BAD_INPUT, key, "%s: a %s has %s", key, kinds[kind].name, kinds[kind].sizes);
    const int dipole = kind == FST_PART_DIPOLE;
    return fst_fail(error, FST_BAD_INPUT, key, "%s: a %s has no %s: give its %s", key, kinds[kind].name,
                    dipole ? "remanence" : "moment of its own", dipole ? "moment" : "remanence");
}

static const fst_magnet_part *part_of(const fst_params *params, int row)
{
    return &params->magnet_parts[row / FST_PART_FIELDS];
}

fst_status fst_part_may_set(const fst_params *params, int row, fst_error *error)
{
    const int part = row / FST_PART_FIELDS, count = params->magnet_part_count;
    const int begins = row % FST_PART_FIELDS == KIND_FIELD && part == count;
    if (part >= count && !begins)
        return fst_fail(error, FST_BAD_INPUT, rows[row].key,
                        "%s: the magnet has %d part%s, so there is no part %d: magnet.parts[%d].kind adds one",
                        rows[row].key, count, count == 1 ? "" : "s", part, count);
    if (!begins && !fst_part_has(part_of(params, row)->kind, row))
        return has_not(part_of(params, row)->kind, row, error);
    return FST_OK;
}

void fst_part_was_set(fst_params *params, int row)
{
    if (row % FST_PART_FIELDS != KIND_FIELD)
        return;
    const int part = row / FST_PART_FIELDS, kind = params->magnet_parts[part].kind;
    const int begins = part == params->magnet_part_count;
    params->magnet_part_count += begins;
    for (int field = 1; field < FST_PART_FIELDS; ++field)
        if (begins || !fst_part_has(kind, field))
            fst_param_put(params, &rows[row + field], 0.0);
}

/* ------------------------------------------------------------------ keys that do not exist */

fst_status fst_part_unknown_key(const char *key, fst_error *error)
{
    static const char list[] = "magnet.parts";
    char quoted[FST_QUOTE_SIZE], names[FST_PART_FIELDS * 40] = "", suggestion[FST_SUGGESTION_SIZE], *end;
    fst_quote(key, quoted);
    const char *behind = key + strlen(list);
    const long part = *behind == '[' ? strtol(behind + 1, &end, 10) : -1;
    if (part < 0 || *end != ']' || end == behind + 1)
        return fst_fail(error, FST_BAD_INPUT, key,
                        "unknown key %s: a number of a part has a key such as magnet.parts[0].size[2], its "
                        "kind magnet.parts[0].kind",
                        quoted);
    if (part >= FST_PARTS_MAX)
        return fst_fail(error, FST_BAD_INPUT, key,
                        "unknown key %s: a magnet has at most %d parts, magnet.parts[0] to magnet.parts[%d]",
                        quoted, FST_PARTS_MAX, FST_PARTS_MAX - 1);
    for (int field = 0; field < FST_PART_FIELDS; ++field) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "",
                       rows[(int)part * FST_PART_FIELDS + field].key);
    }
    return fst_fail(error, FST_BAD_INPUT, key, "unknown key %s; %s", quoted,
                    fst_suggest_name(key, names, suggestion));
}

/* ------------------------------------------------------------------ checking parts as a whole */

static fst_status validate_number(const fst_params *params, int row, fst_error *error)
{
    const double value = fst_param_value(params, &rows[row]);
    const int kind = part_of(params, row)->kind;
    if (!fst_part_has(kind, row))
        return value == 0.0 ? FST_OK : has_not(kind, row, error);
    char remark[64] = "";
    if (row % FST_PART_FIELDS >= SIZE_FIELD && row % FST_PART_FIELDS < REMANENCE_FIELD)
        (void)snprintf(remark, sizeof remark, " (a %s has %s)", kinds[kind].name, kinds[kind].sizes);
    return fst_param_check_range(&rows[row], value, NULL, remark, error);
}

static fst_status validate_numbers(const fst_params *params, int part, fst_error *error)
{
    const fst_magnet_part *p = &params->magnet_parts[part];
    const int first = part * FST_PART_FIELDS;
    if (p->kind < 0 || p->kind >= FST_PART_KINDS)
        return fst_fail(error, FST_BAD_INPUT, rows[first].key, "%s: no kind has the number %d (kinds: %s)",
                        rows[first].key, p->kind, FST_WORDS(FST_PARTS));
    if (p->motion < 0 || p->motion >= FST_PART_MOTION_COUNT)
        return fst_fail(error, FST_BAD_INPUT, rows[first].key, "%s: no motion has the number %d (motions: %s)",
                        rows[first + MOTION_FIELD].key, p->motion, FST_WORDS(FST_PART_MOTIONS));
    for (int field = 1; field < MOTION_FIELD; ++field) {
        const fst_status status = validate_number(params, first + field, error);
        if (status != FST_OK)
            return status;
    }
    const double *turn = p->rotation;
    if (turn[0] != 0.0 && turn[1] == 0.0 && turn[2] == 0.0 && turn[3] == 0.0)
        return fst_fail(error, FST_BAD_INPUT, rows[first + TURN_FIELD].key,
                        "magnet.parts[%d].rotation: a turn by %g degrees needs an axis: [degrees, x, y, z] "
                        "with x, y and z not all 0",
                        part, turn[0]);
    return FST_OK;
}

/* The plate's height over the reference plane, m. */
static double plate_height(const fst_params *p)
{
    const double l = p->magnet_half_length;
    if (isnan(p->model_h) && isnan(p->model_eps))
        return p->magnet_depth;
    const double centre = isnan(p->model_h) ? p->magnet_depth + p->bead_radius : p->model_h * l;
    return centre - (isnan(p->model_eps) ? p->bead_radius : p->model_eps * l);
}

/* FST_BAD_INPUT: the part touches the plate, or passes it. */
static fst_status lies_below(const fst_params *params, int part, fst_error *error)
{
    const fst_magnet_part *p = &params->magnet_parts[part];
    const double top = fst_part_seen(p).high, plate = plate_height(params);
    if (top < plate || params->plate_shape == FST_PLATE_NONE)
        return FST_OK;
    char where[48];
    (void)snprintf(where, sizeof where, "magnet.parts[%d]", part);
    return fst_fail(error, FST_BAD_INPUT, where,
                    "%s, a %s, reaches %.6g mm above the magnet's reference plane, but the plate lies at %.6g "
                    "mm (magnet.depth): a part must end below the plate",
                    where, kinds[p->kind].name, 1e3 * top, 1e3 * plate);
}

fst_status fst_part_check(const fst_params *params, int part, fst_error *error)
{
    if (part < 0 || part >= params->magnet_part_count || part >= FST_PARTS_MAX)
        return fst_fail(error, FST_BAD_INPUT, "magnet.parts", "the magnet has %d parts, and none is number %d",
                        params->magnet_part_count, part);
    const fst_status status = validate_numbers(params, part, error);
    return status == FST_OK ? lies_below(params, part, error) : status;
}

fst_status fst_parts_validate(const fst_params *params, fst_error *error)
{
    const int count = params->magnet_part_count;
    if (count < 0 || count > FST_PARTS_MAX)
        return fst_fail(error, FST_BAD_INPUT, "magnet.parts", "magnet_part_count is %d: it must be 0 to %d",
                        count, FST_PARTS_MAX);
    const double *even = params->field_uniform;
    const int other_field = params->coil_count > 0 || params->drive_waveform == FST_WAVEFORM_WAVE ||
                            !isnan(even[0]) || !isnan(even[1]) || !isnan(even[2]);
    if (params->magnet_shape == FST_MAGNET_PARTS && count == 0 && !other_field)
        return fst_fail(error, FST_BAD_INPUT, "magnet.parts",
                        "magnet.shape is parts, but there are none: list them in magnet.parts, each with kind, "
                        "centre, size and remanence");
    fst_status status = FST_OK;
    for (int part = 0; part < count && status == FST_OK; ++part)
        status = params->magnet_shape == FST_MAGNET_PARTS ? fst_part_check(params, part, error)
                                                          : validate_numbers(params, part, error);
    return status;
}
