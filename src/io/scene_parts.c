/* scene_parts.c - reading magnet.parts of a scene: a list of bodies, each a mapping of a few keys to lists of
 * numbers.  What is read becomes values of the keys magnet.parts[0].kind, magnet.parts[0].centre[0], ..., which
 * is how parts are known everywhere else. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "io/scene_reader.h"

enum { KIND, CENTRE, SIZE, REMANENCE, MOMENT, ROTATION, MOTION, FIELDS, MOST_VALUES = 4 };

/* The keys of a part.  `shape` shows a list of them; the unit of a size follows from the kind. */
static const struct {
    const char *name, *shape;
    int values;
} fields[FIELDS] = {
    [KIND] = {"kind", "cuboid", 1},
    [CENTRE] = {"centre", "[x, y, z]", 3},
    [SIZE] = {"size", NULL, 3},
    [REMANENCE] = {"remanence", "[x, y, z]", 3},
    [MOMENT] = {"moment", "[x, y, z]", 3},
    [ROTATION] = {"rotation", "[degrees, x, y, z]", 4},
    [MOTION] = {"motion", "turning", 1},
};
#define FIELD_NAMES "kind|centre|size|remanence|moment|rotation|motion"

static const char *const size_shapes[FST_PART_KINDS] = {
    [FST_PART_CUBOID] = "[edge along x, along y, along z]",
    [FST_PART_CYLINDER] = "[diameter, height]",
    [FST_PART_SPHERE] = "[diameter]",
    [FST_PART_DIPOLE] = "",
};

/* One part as the scene writes it. */
typedef struct part_text {
    int part, line;
    char *values[FIELDS][MOST_VALUES];
    int value_lines[FIELDS][MOST_VALUES];
    int counts[FIELDS], lines[FIELDS];
} part_text;

static fst_status no_memory(const scene_reader *reader)
{
    return fst_fail(reader->error, FST_NO_MEMORY, "magnet.parts", "out of memory");
}

/* ------------------------------------------------------------------ reading the text */

static fst_status take_value(scene_reader *reader, part_text *p, int field, const yaml_event_t *event)
{
    char sentence[256];
    const int line = fst_scene_line(event->start_mark);
    const char *text = event->type == YAML_SCALAR_EVENT ? fst_scene_scalar(event) : NULL;
    if (!text || fst_scene_null(event)) {
        (void)snprintf(sentence, sizeof sentence,
                       "magnet.parts[%d].%s must be %s, without anything empty or nested", p->part,
                       fields[field].name,
                       fields[field].values == 1 ? "a word" : "a list of numbers such as [1, 2, 3]");
        return fst_scene_fail(reader, line, sentence);
    }
    int *count = &p->counts[field];
    if (*count == fields[field].values) {
        (void)snprintf(sentence, sizeof sentence, "magnet.parts[%d].%s has more than %d value%s", p->part,
                       fields[field].name, *count, *count == 1 ? "" : "s");
        return fst_scene_fail(reader, line, sentence);
    }
    p->value_lines[field][*count] = line;
    p->values[field][*count] = strdup(text);
    return p->values[field][(*count)++] ? FST_OK : no_memory(reader);
}

/* A value, or a list of values. */
static fst_status read_values(scene_reader *reader, part_text *p, int field)
{
    yaml_event_t event;
    fst_status status = fst_scene_event(reader, &event);
    if (status != FST_OK)
        return status;
    const int list = event.type == YAML_SEQUENCE_START_EVENT;
    if (!list)
        status = take_value(reader, p, field, &event);
    yaml_event_delete(&event);
    for (int ends = !list; status == FST_OK && !ends;) {
        status = fst_scene_event(reader, &event);
        if (status != FST_OK)
            return status;
        ends = event.type == YAML_SEQUENCE_END_EVENT;
        if (!ends)
            status = take_value(reader, p, field, &event);
        yaml_event_delete(&event);
    }
    return status;
}

static fst_status find_field(scene_reader *reader, const part_text *p, const yaml_event_t *key, int *field)
{
    char sentence[FST_SUGGESTION_SIZE], suggestion[FST_SUGGESTION_SIZE], quoted[FST_QUOTE_SIZE];
    const int line = fst_scene_line(key->start_mark);
    const char *name = key->type == YAML_SCALAR_EVENT ? fst_scene_scalar(key) : NULL;
    if (!name)
        return fst_scene_fail(reader, line, "a key of a part must be a word, as in \"kind: cuboid\"");
    for (*field = 0; *field < FIELDS && strcmp(fields[*field].name, name) != 0;)
        ++*field;
    if (*field == FIELDS) {
        (void)snprintf(sentence, sizeof sentence, "magnet.parts[%d]: unknown key %s; %.400s", p->part,
                       fst_quote(name, quoted), fst_suggest_name(name, FIELD_NAMES, suggestion));
        return fst_scene_fail(reader, line, sentence);
    }
    if (p->lines[*field]) {
        (void)snprintf(sentence, sizeof sentence, "magnet.parts[%d].%s is given twice: first on line %d",
                       p->part, fields[*field].name, p->lines[*field]);
        return fst_scene_fail(reader, line, sentence);
    }
    return FST_OK;
}

static fst_status read_part_text(scene_reader *reader, part_text *p)
{
    for (;;) {
        yaml_event_t key;
        int field = 0;
        fst_status status = fst_scene_event(reader, &key);
        if (status != FST_OK)
            return status;
        const int ends = key.type == YAML_MAPPING_END_EVENT, line = fst_scene_line(key.start_mark);
        if (!ends)
            status = find_field(reader, p, &key, &field);
        yaml_event_delete(&key);
        if (status == FST_OK && !ends) {
            p->lines[field] = line;
            status = read_values(reader, p, field);
        }
        if (status != FST_OK || ends)
            return status;
    }
}

/* ------------------------------------------------------------------ what it says */

/* The row of a number of the part. */
static int row_of(const part_text *p, int field, int k)
{
    char key[64];
    if (field == KIND || field == MOTION)
        (void)snprintf(key, sizeof key, "magnet.parts[%d].%s", p->part, fields[field].name);
    else
        (void)snprintf(key, sizeof key, "magnet.parts[%d].%s[%d]", p->part, fields[field].name, k);
    return fst_param_find(key);
}

/* How many numbers a part of this kind has under a key. */
static int wanted(const part_text *p, int field, const fst_params *scratch)
{
    char text[64];
    int count = 0;
    while (count < fields[field].values &&
           fst_params_get(scratch, row_of(p, field, count), text, sizeof text) > 0)
        ++count;
    return count;
}

/* Where too few numbers are given, or none. */
static fst_status too_few(scene_reader *reader, const part_text *p, int field, int kind)
{
    char sentence[256], name[32];
    const char *shape = field == SIZE ? size_shapes[kind] : fields[field].shape;
    const char *names = fst_param_at(row_of(p, KIND, 0))->names;
    size_t length;
    names = fst_name_at(names, kind, &length);
    (void)snprintf(name, sizeof name, "%.*s", (int)length, names);
    if (p->lines[field])
        (void)snprintf(sentence, sizeof sentence, "magnet.parts[%d].%s has %d value%s, but that of a %s is %s",
                       p->part, fields[field].name, p->counts[field], p->counts[field] == 1 ? "" : "s", name,
                       shape);
    else
        (void)snprintf(sentence, sizeof sentence, "magnet.parts[%d], a %s, lacks its %s: %s", p->part, name,
                       fields[field].name, shape);
    return fst_scene_fail(reader, p->lines[field] ? p->lines[field] : p->line, sentence);
}

static fst_status note_field(scene_reader *reader, const part_text *p, int field, fst_params *scratch)
{
    const int kind = scratch->magnet_parts[p->part].kind, count = p->counts[field];
    const int needed = wanted(p, field, scratch), optional = field >= ROTATION;
    if (count < needed && (p->lines[field] || !optional))
        return too_few(reader, p, field, kind);
    if (p->lines[field] && count == 0)
        return fst_scene_fail(reader, p->lines[field], "this list is empty: remove the line");
    fst_status status = FST_OK;
    for (int k = 0; k < count && status == FST_OK; ++k) /* beyond what the kind has, the sentence says so */
        status =
            fst_scene_note(reader, row_of(p, field, k), p->value_lines[field][k], p->values[field][k], scratch);
    return status;
}

static fst_status note_part(scene_reader *reader, const part_text *p, fst_params *scratch)
{
    char sentence[256];
    if (!p->counts[KIND]) {
        (void)snprintf(sentence, sizeof sentence, "magnet.parts[%d] has no kind: one of %s", p->part,
                       fst_param_at(row_of(p, KIND, 0))->names);
        return fst_scene_fail(reader, p->line, sentence);
    }
    fst_status status = fst_scene_note(reader, row_of(p, KIND, 0), p->lines[KIND], p->values[KIND][0], scratch);
    for (int field = CENTRE; field < FIELDS && status == FST_OK; ++field)
        status = note_field(reader, p, field, scratch);
    return status;
}

static fst_status read_part(scene_reader *reader, int part, const yaml_event_t *start, fst_params *scratch)
{
    char sentence[256];
    part_text p = {.part = part, .line = fst_scene_line(start->start_mark)};
    if (start->type != YAML_MAPPING_START_EVENT) {
        (void)snprintf(
            sentence, sizeof sentence,
            "magnet.parts[%d] must be keys and values: kind, centre, size and remanence (of a dipole: "
            "kind, centre and moment)",
            part);
        return fst_scene_fail(reader, p.line, sentence);
    }
    if (part == FST_PARTS_MAX) {
        (void)snprintf(sentence, sizeof sentence, "magnet.parts has more than %d parts, which is the most",
                       FST_PARTS_MAX);
        return fst_scene_fail(reader, p.line, sentence);
    }
    reader->part_lines[part] = p.line;
    fst_status status = read_part_text(reader, &p);
    if (status == FST_OK)
        status = note_part(reader, &p, scratch);
    for (int field = 0; field < FIELDS; ++field)
        for (int k = 0; k < p.counts[field]; ++k)
            free(p.values[field][k]);
    return status;
}

fst_status fst_scene_parts(scene_reader *reader, int line, const yaml_event_t *start)
{
    fst_params scratch = fst_default_params(); /* each value is tried on it */
    if (start->type != YAML_SEQUENCE_START_EVENT)
        return fst_scene_fail(
            reader, line,
            "magnet.parts must be a list of parts, each \"- kind: ...\" with its centre, size and "
            "remanence below");
    if (reader->lists_parts)
        return fst_scene_fail(reader, line, "magnet.parts is given twice");
    reader->lists_parts = 1;
    for (int part = 0;; ++part) {
        yaml_event_t event;
        fst_status status = fst_scene_event(reader, &event);
        if (status != FST_OK)
            return status;
        const int ends = event.type == YAML_SEQUENCE_END_EVENT;
        if (!ends)
            status = read_part(reader, part, &event, &scratch);
        yaml_event_delete(&event);
        if (ends && part == 0)
            return fst_scene_fail(reader, line, "magnet.parts lists no part");
        if (status != FST_OK || ends)
            return status;
    }
}
