/* scene.c - reading scenes in YAML.
 *
 * The reader walks through libyaml's events, which know their lines, and accepts only what a scene may hold:
 * one mapping of groups of keys to single values.  Values are collected first and applied at the end, because
 * the order in which they must be applied is not the order in which people write them.
 */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "host/regular_file.h"
#include "io/scene_reader.h"

/* A group may be opened once.  There is room for more names than params.def has groups. */
#define GROUP_LIMIT 16

/* ---------------------------------------------------------------- keys and values */

/* Note that the scene gives `key` this value, on this line. */
static fst_status note_value(scene_reader *reader, const char *key, int line, const yaml_event_t *event)
{
    char sentence[512];
    const int index = fst_param_find(key);
    fst_params scratch = fst_default_params();
    if (index < 0) {
        fst_error why;
        fst_params_set(&scratch, key, "", &why);
        return fst_scene_fail(reader, line, why.sentence);
    }
    if (fst_param_part(index) >= 0 || fst_param_bead(index) >= 0) {
        (void)snprintf(sentence, sizeof sentence, "%s: a scene lists its %s whole, as in \"%s\"", key,
                       fst_param_part(index) >= 0 ? "parts" : "beads",
                       fst_param_part(index) >= 0 ? "parts: [{kind: cuboid, centre: ...}]"
                                                  : "beads: [{start.phi: 3 deg}, {start.phi: 183 deg}]");
        return fst_scene_fail(reader, line, sentence);
    }
    if (reader->values[index]) {
        (void)snprintf(sentence, sizeof sentence, "%s is given twice: first on line %d", key,
                       reader->lines[index]);
        return fst_scene_fail(reader, line, sentence);
    }
    if (fst_param_coil(index) >= 0)
        scratch.coil_count = fst_param_coil(index); /* those before it have their own keys */
    const char *text = fst_scene_scalar(event);
    if (!text || fst_scene_null(event)) {
        (void)snprintf(sentence, sizeof sentence, "%s has no value: give it one, or remove the line", key);
        return fst_scene_fail(reader, line, sentence);
    }
    /* Try the value on a copy of the defaults, so that a wrong unit or range is reported with its line. */
    return fst_scene_note(reader, index, line, text, &scratch);
}

/* Whether `name` is the group of some key. */
static int is_group(const char *name)
{
    size_t length = strlen(name);
    for (int i = 0; fst_param_at(i); ++i) {
        const char *key = fst_param_at(i)->key;
        if (strncmp(key, name, length) == 0 && key[length] == '.')
            return 1;
    }
    return 0;
}

static fst_status unknown_group(scene_reader *reader, int line, const char *name)
{
    char names[256] = "", quoted[FST_QUOTE_SIZE];
    char suggestion[FST_SUGGESTION_SIZE], sentence[FST_SUGGESTION_SIZE + FST_QUOTE_SIZE];
    for (int i = 0; i < fst_param_count(); ++i) {
        char group[32];
        const char *key = fst_param_at(i)->key;
        (void)snprintf(group, sizeof group, "%.*s|", (int)strcspn(key, "."), key);
        if (!strstr(names, group))
            strncat(names, group, sizeof names - strlen(names) - 1);
    }
    (void)snprintf(sentence, sizeof sentence, "unknown group %s; %s", fst_quote(name, quoted),
                   fst_suggest_name(name, names, suggestion));
    return fst_scene_fail(reader, line, sentence);
}

static fst_status read_mapping(scene_reader *reader, const char *group, int start_line);

/* Whether the key stands for a list of numbers, as start.position does. */
static int is_list(const char *key)
{
    char first[112];
    (void)snprintf(first, sizeof first, "%s[0]", key);
    return fst_param_find(first) >= 0;
}

/* Read a list whose start was read: its numbers have the keys key[0], key[1], ... */
static fst_status read_list(scene_reader *reader, const char *key)
{
    fst_status status = FST_OK;
    for (int i = 0, ends = 0; status == FST_OK && !ends; ++i) {
        yaml_event_t event;
        char element[112];
        (void)snprintf(element, sizeof element, "%s[%d]", key, i);
        status = fst_scene_event(reader, &event);
        if (status != FST_OK)
            return status;
        const int line = fst_scene_line(event.start_mark);
        ends = event.type == YAML_SEQUENCE_END_EVENT;
        if (!ends && event.type == YAML_SCALAR_EVENT)
            status = note_value(reader, element, line, &event);
        else if (!ends)
            status = fst_scene_fail(reader, line, "a list within a list says nothing here");
        yaml_event_delete(&event);
    }
    return status;
}

/* Read the list of coils, whose start was read: each is a group of keys, coils[0], coils[1], ... */
static fst_status read_coils(scene_reader *reader)
{
    for (int i = 0;; ++i) {
        yaml_event_t event;
        char coil[32];
        fst_status status = fst_scene_event(reader, &event);
        if (status != FST_OK)
            return status;
        const int line = fst_scene_line(event.start_mark), ends = event.type == YAML_SEQUENCE_END_EVENT;
        const int maps = event.type == YAML_MAPPING_START_EVENT;
        yaml_event_delete(&event);
        (void)snprintf(coil, sizeof coil, "coils[%d]", i);
        if (maps)
            status = read_mapping(reader, coil, line);
        else if (!ends)
            status = fst_scene_fail(reader, line, "a coil is keys and values, as in \"- radius: 5 cm\"");
        if (status != FST_OK || ends)
            return status;
    }
}

/* Read the value behind the key `name`, on this line, in `group` (NULL: top level). */
static fst_status read_value(scene_reader *reader, const char *group, const char *name, int line,
                             const yaml_event_t *event)
{
    char key[96], quoted[FST_QUOTE_SIZE], sentence[256];
    if (!group && strcmp(name, "beads") == 0)
        return fst_scene_beads(reader, line, event);
    if (!group && event->type == YAML_MAPPING_START_EVENT)
        return is_group(name) ? read_mapping(reader, name, line) : unknown_group(reader, line, name);
    (void)snprintf(key, sizeof key, "%s%s%.80s", group ? group : "", group ? "." : "", name);
    if (strcmp(key, "magnet.parts") == 0)
        return fst_scene_parts(reader, line, event);
    if (event->type == YAML_SEQUENCE_START_EVENT && is_list(key))
        return read_list(reader, key);
    if (event->type == YAML_SCALAR_EVENT && is_list(key)) {
        (void)snprintf(sentence, sizeof sentence, "%s must be a list of numbers: [x, y, z]", key);
        return fst_scene_fail(reader, line, sentence);
    }
    if (strcmp(key, "coils") == 0 && event->type == YAML_SEQUENCE_START_EVENT)
        return read_coils(reader);
    if (event->type != YAML_SCALAR_EVENT) {
        (void)snprintf(sentence, sizeof sentence, "%s must be one value, not a %s", fst_quote(key, quoted),
                       event->type == YAML_SEQUENCE_START_EVENT ? "list" : "group of keys");
        return fst_scene_fail(reader, line, sentence);
    }
    if (!group && is_group(name)) {
        (void)snprintf(sentence, sizeof sentence, "%s is a group: write its keys below it, or remove the line",
                       name);
        return fst_scene_fail(reader, line, sentence);
    }
    return note_value(reader, key, line, event);
}

/* Note a name that may be a group's.  YAML forbids the same key twice, and so do we. */
static fst_status note_group(scene_reader *reader, char seen[GROUP_LIMIT][32], int *count, const char *name,
                             int line)
{
    char sentence[128];
    if (!is_group(name))
        return FST_OK;
    for (int i = 0; i < *count; ++i)
        if (strcmp(seen[i], name) == 0) {
            (void)snprintf(sentence, sizeof sentence, "the group %s is given twice: put its keys together",
                           name);
            return fst_scene_fail(reader, line, sentence);
        }
    if (*count < GROUP_LIMIT)
        (void)snprintf(seen[(*count)++], 32, "%s", name);
    return FST_OK;
}

/* Read the keys and values of a mapping whose start was read, to its end. */
static fst_status read_mapping(scene_reader *reader, const char *group, int start_line)
{
    char seen[GROUP_LIMIT][32];
    int seen_count = 0, keys = 0;
    for (;; ++keys) {
        yaml_event_t key, value;
        fst_status status = fst_scene_event(reader, &key);
        if (status != FST_OK)
            return status;
        int line = fst_scene_line(key.start_mark);
        if (key.type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(&key);
            return keys || !group ? FST_OK : fst_scene_fail(reader, start_line, "this group has no keys");
        }
        const char *name = key.type == YAML_SCALAR_EVENT ? fst_scene_scalar(&key) : NULL;
        if (!name) {
            yaml_event_delete(&key);
            return fst_scene_fail(reader, line, "a key must be a word, as in \"radius: 2.5 mm\"");
        }
        status = group ? FST_OK : note_group(reader, seen, &seen_count, name, line);
        if (status == FST_OK) {
            status = fst_scene_event(reader, &value);
            if (status == FST_OK) {
                status = read_value(reader, group, name, line, &value);
                yaml_event_delete(&value);
            }
        }
        yaml_event_delete(&key);
        if (status != FST_OK)
            return status;
    }
}

static fst_status skip_event(scene_reader *reader, yaml_event_type_t *type)
{
    yaml_event_t event;
    fst_status status = fst_scene_event(reader, &event);
    if (status != FST_OK)
        return status;
    *type = event.type;
    yaml_event_delete(&event);
    return FST_OK;
}

/* Read the whole stream: nothing, or one document that is one mapping. */
static fst_status read_stream(scene_reader *reader)
{
    yaml_event_type_t type;
    fst_status status = skip_event(reader, &type); /* stream start */
    if (status == FST_OK)
        status = skip_event(reader, &type);
    if (status != FST_OK || type == YAML_STREAM_END_EVENT)
        return status; /* only comments: nothing is changed */
    yaml_event_t root;
    status = fst_scene_event(reader, &root);
    if (status != FST_OK)
        return status;
    int line = fst_scene_line(root.start_mark);
    type = root.type;
    int nothing = type == YAML_SCALAR_EVENT && fst_scene_null(&root);
    yaml_event_delete(&root);
    if (type != YAML_MAPPING_START_EVENT && !nothing)
        return fst_scene_fail(reader, line,
                              "a scene is made of groups of keys, as in \"bead:\" and \"  radius: 2.5 mm\"");
    if (!nothing)
        status = read_mapping(reader, NULL, line);
    if (status == FST_OK)
        status = skip_event(reader, &type); /* document end */
    if (status != FST_OK)
        return status;
    yaml_event_t end;
    status = fst_scene_event(reader, &end);
    if (status != FST_OK)
        return status;
    if (end.type != YAML_STREAM_END_EVENT)
        status = fst_scene_fail(reader, fst_scene_line(end.start_mark),
                                "a scene is one YAML document; a second one begins here");
    yaml_event_delete(&end);
    return status;
}

/* ---------------------------------------------------------------- applying what was read */

static fst_status given_twice(scene_reader *reader, int one, int two)
{
    const int last = reader->lines[one] >= reader->lines[two] ? one : two, first = one + two - last;
    const char *key = fst_param_at(last)->key, *other = fst_param_at(first)->key;
    const int field = strcmp(key, "magnet.b0") == 0 || strcmp(other, "magnet.b0") == 0;
    char sentence[256];
    (void)snprintf(sentence, sizeof sentence,
                   "%s is given here and %s on line %d: %sthey give the same quantity, keep one", key, other,
                   reader->lines[first], field ? "with the bead's moment " : "");
    return fst_scene_fail(reader, reader->lines[last], sentence);
}

/* A quantity given in two ways is an error, because nobody knows which was meant. */
static fst_status check_forms(scene_reader *reader, const fst_params *params)
{
    for (int one = 0; one < reader->count; ++one)
        for (int two = one + 1; two < reader->count && reader->values[one]; ++two)
            if (reader->values[two] && fst_params_clash(params, fst_param_at(one)->key, fst_param_at(two)->key))
                return given_twice(reader, one, two);
    return FST_OK;
}

static fst_status set_given(const scene_reader *reader, int index, fst_params *params)
{
    if (!reader->values[index])
        return FST_OK;
    return fst_params_set(params, fst_param_at(index)->key, reader->values[index], reader->error);
}

/* The magnet's kind is applied first, for it says what takes the place of what, and model.kappa next: setting
 * it clears magnet.b0, which may be given beside it to scale the field. */
static fst_status apply(const scene_reader *reader, fst_params *changed)
{
    const int shape = fst_param_find("magnet.shape"), kappa = fst_param_find("model.kappa");
    if (reader->lists_parts)
        changed->magnet_part_count = 0;
    if (reader->bead_count) {
        changed->bead_count = reader->bead_count;
        changed->bead_list = reader->bead_count > FST_BEADS_MOST ? reader->beads : NULL;
        for (int i = 0; i < reader->bead_count && i < FST_BEADS_MOST; ++i)
            changed->beads[i] = reader->beads[i];
    }
    fst_status status = set_given(reader, shape, changed);
    if (status == FST_OK)
        status = set_given(reader, kappa, changed);
    for (int i = 0; i < reader->count && status == FST_OK; ++i)
        if (i != shape && i != kappa)
            status = set_given(reader, i, changed);
    return status;
}

/* What can be said of the whole, with the line that it comes from. */
static fst_status check_whole(scene_reader *reader, const fst_params *params)
{
    fst_error why;
    fst_status status = check_forms(reader, params);
    if (!reader->lists_parts || params->magnet_shape != FST_MAGNET_PARTS)
        return status;
    for (int part = 0; part < params->magnet_part_count && status == FST_OK; ++part)
        if (fst_params_check_part(params, part, &why) != FST_OK)
            status = fst_scene_fail(reader, reader->part_lines[part], why.sentence);
    return status;
}

fst_status fst_scene_parse(const char *text, size_t size, const char *name, fst_params *params,
                           fst_error *error)
{
    return fst_scene_parse_beads(text, size, name, params, NULL, error);
}

fst_status fst_scene_parse_beads(const char *text, size_t size, const char *name, fst_params *params,
                                 fst_bead_params **beads, fst_error *error)
{
    fst_error unseen;
    scene_reader reader = {
        .name = name, .text = text, .size = size, .list = beads, .error = error ? error : &unseen};
    if (beads)
        *beads = NULL;
    while (fst_param_at(reader.count))
        ++reader.count;
    if (size > FST_SCENE_SIZE_LIMIT)
        return fst_fail(error, FST_BAD_INPUT, name, "this is larger than a scene may be, %d bytes",
                        FST_SCENE_SIZE_LIMIT);
    reader.values = calloc((size_t)reader.count, sizeof *reader.values);
    reader.lines = calloc((size_t)reader.count, sizeof *reader.lines);
    fst_status status = FST_NO_MEMORY;
    if (reader.values && reader.lines && yaml_parser_initialize(&reader.parser)) {
        yaml_parser_set_encoding(&reader.parser, YAML_UTF8_ENCODING);
        yaml_parser_set_input_string(&reader.parser, (const unsigned char *)text, size);
        status = read_stream(&reader);
        yaml_parser_delete(&reader.parser);
        fst_params changed = *params;
        if (status == FST_OK)
            status = apply(&reader, &changed);
        if (status == FST_OK)
            status = check_whole(&reader, &changed);
        if (status == FST_OK)
            *params = changed;
        if (status == FST_OK && reader.bead_count > FST_BEADS_MOST) {
            *beads = reader.beads;
            reader.beads = NULL;
        }
    } else {
        fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    }
    for (int i = 0; reader.values && i < reader.count; ++i)
        free(reader.values[i]);
    free(reader.values);
    free(reader.lines);
    free(reader.beads);
    return status;
}

/* ---------------------------------------------------------------- the file */

/* A path in a scene begins at the scene's folder. */
static fst_status begin_at_scene(const char *path, char file[sizeof((fst_params *)NULL)->magnet_file],
                                 fst_error *error)
{
    const char *slash = strrchr(path, '/');
    char joined[sizeof((fst_params *)NULL)->magnet_file];
    if (!file[0] || file[0] == '/' || !slash)
        return FST_OK;
    const int length = snprintf(joined, sizeof joined, "%.*s/%s", (int)(slash - path), path, file);
    if (length < 0 || (size_t)length >= sizeof joined)
        return fst_fail(error, FST_BAD_INPUT, path,
                        "magnet.file and the scene's folder make a path of more than %zu bytes: move the file",
                        sizeof joined - 1);
    memcpy(file, joined, sizeof joined);
    return FST_OK;
}

fst_status fst_scene_read(const char *path, fst_params *params, fst_error *error)
{
    return fst_scene_read_beads(path, params, NULL, error);
}

fst_status fst_scene_read_beads(const char *path, fst_params *params, fst_bead_params **beads, fst_error *error)
{
    char *text;
    size_t size;
    fst_params changed = *params;
    fst_status status = fst_read_regular(path, FST_SCENE_SIZE_LIMIT, &text, &size, error);
    if (status != FST_OK)
        return status;
    changed.magnet_file[0] = '\0';
    status = fst_scene_parse_beads(text, size, path, &changed, beads, error);
    free(text);
    if (status == FST_OK && !changed.magnet_file[0])
        memcpy(changed.magnet_file, params->magnet_file, sizeof changed.magnet_file);
    else if (status == FST_OK)
        status = begin_at_scene(path, changed.magnet_file, error);
    if (status == FST_OK)
        *params = changed;
    return status;
}
