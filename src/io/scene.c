/* scene.c - reading scenes in YAML.
 *
 * The reader walks through libyaml's events, which know their lines, and accepts only what a scene may hold:
 * one mapping of groups of keys to single values.  Values are collected first and applied at the end, because
 * the order in which they must be applied is not the order in which people write them.
 */
#include <festoon/festoon_tools.h>

#include <stdlib.h>
#include <string.h>
#include <yaml.h>

#include "base/error.h"
#include "base/text.h"
#include "host/regular_file.h"

/* What the scene said so far: values are applied at the end (see above). */
typedef struct scene_reader {
    yaml_parser_t parser;
    const char *name; /* of the file, for messages */
    const char *text;
    size_t size;
    int count;     /* the number of parameters */
    char **values; /* by the parameter's index; NULL: not given */
    int *lines;    /* the line on which each was given */
    fst_error *error;
} scene_reader;

/* A group may be opened once.  There is room for more names than params.def has groups. */
#define GROUP_LIMIT 16

/* ---------------------------------------------------------------- messages with FILE:LINE */

static fst_status fail_at(scene_reader *reader, int line, const char *sentence)
{
    char where[sizeof reader->error->where];
    (void)snprintf(where, sizeof where, "%.200s:%d", reader->name, line);
    return fst_fail(reader->error, FST_BAD_INPUT, where, "%s", sentence);
}

static int line_of(yaml_mark_t mark)
{
    return (int)mark.line + 1;
}

/* libyaml's own error.  Its reader (encoding, control characters) gives bytes, its scanner lines. */
static fst_status fail_yaml(scene_reader *reader)
{
    const yaml_parser_t *parser = &reader->parser;
    if (parser->error == YAML_MEMORY_ERROR)
        return fst_fail(reader->error, FST_NO_MEMORY, reader->name, "out of memory");
    char sentence[256];
    if (parser->error == YAML_READER_ERROR) {
        int line = 1;
        for (size_t i = 0; i < parser->problem_offset && i < reader->size; ++i)
            line += reader->text[i] == '\n';
        (void)snprintf(sentence, sizeof sentence, "this is no text in UTF-8 (%s, byte %zu): a scene is YAML",
                       parser->problem, parser->problem_offset);
        return fail_at(reader, line, sentence);
    }
    (void)snprintf(sentence, sizeof sentence, "this is no YAML: %s%s%s",
                   parser->problem ? parser->problem : "?", parser->context ? " " : "",
                   parser->context ? parser->context : "");
    return fail_at(reader, line_of(parser->problem_mark), sentence);
}

/* ---------------------------------------------------------------- events */

/* The next event, which has no anchor, alias or tag: a scene says everything where it stands and needs none.
 * The caller deletes the event. */
static fst_status next_event(scene_reader *reader, yaml_event_t *event)
{
    if (!yaml_parser_parse(&reader->parser, event))
        return fail_yaml(reader);
    const unsigned char *anchor = NULL, *tag = NULL;
    if (event->type == YAML_SCALAR_EVENT) {
        anchor = event->data.scalar.anchor;
        tag = event->data.scalar.tag;
    } else if (event->type == YAML_MAPPING_START_EVENT) {
        anchor = event->data.mapping_start.anchor;
        tag = event->data.mapping_start.tag;
    } else if (event->type == YAML_SEQUENCE_START_EVENT) {
        anchor = event->data.sequence_start.anchor;
        tag = event->data.sequence_start.tag;
    }
    const char *sentence = NULL;
    if (event->type == YAML_ALIAS_EVENT || anchor)
        sentence = "YAML anchors and aliases have no place in a scene: write the value out";
    else if (tag)
        sentence = "YAML tags have no place in a scene: write the bare value";
    if (!sentence)
        return FST_OK;
    int line = line_of(event->start_mark);
    yaml_event_delete(event);
    return fail_at(reader, line, sentence);
}

static fst_status skip_event(scene_reader *reader, yaml_event_type_t *type)
{
    yaml_event_t event;
    fst_status status = next_event(reader, &event);
    if (status != FST_OK)
        return status;
    *type = event.type;
    yaml_event_delete(&event);
    return FST_OK;
}

/* An empty value: `radius:` or `radius: ~`. */
static int is_null(const yaml_event_t *event)
{
    const char *text = (const char *)event->data.scalar.value;
    return event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE &&
           (text[0] == '\0' || strcmp(text, "~") == 0 || strcmp(text, "null") == 0);
}

/* The text of a value; NULL where a zero byte hides in it. */
static const char *scalar_text(const yaml_event_t *event)
{
    const char *text = (const char *)event->data.scalar.value;
    return strlen(text) == event->data.scalar.length ? text : NULL;
}

/* ---------------------------------------------------------------- keys and values */

/* Note that the scene gives `key` this value, on this line. */
static fst_status note_value(scene_reader *reader, const char *key, int line, const yaml_event_t *event)
{
    char sentence[512], quoted[FST_QUOTE_SIZE];
    int index = fst_param_find(key);
    if (index < 0) {
        fst_params scratch = fst_default_params();
        fst_error why;
        fst_params_set(&scratch, key, "", &why);
        return fail_at(reader, line, why.sentence);
    }
    if (reader->values[index]) {
        (void)snprintf(sentence, sizeof sentence, "%s is given twice: first on line %d", key,
                       reader->lines[index]);
        return fail_at(reader, line, sentence);
    }
    const char *text = scalar_text(event);
    if (!text || is_null(event)) {
        (void)snprintf(sentence, sizeof sentence, "%s has no value: give it one, or remove the line", key);
        return fail_at(reader, line, sentence);
    }
    /* Try the value on a copy of the defaults, so that a wrong unit or range is reported with its line. */
    fst_params scratch = fst_default_params();
    fst_error why;
    if (fst_params_set(&scratch, key, text, &why) != FST_OK)
        return fail_at(reader, line, why.sentence);
    reader->values[index] = strdup(text);
    reader->lines[index] = line;
    if (!reader->values[index])
        return fst_fail(reader->error, FST_NO_MEMORY, fst_quote(key, quoted), "out of memory");
    return FST_OK;
}

/* Whether `name` is the group of some key. */
static int is_group(const char *name)
{
    size_t length = strlen(name);
    for (int i = 0; i < fst_param_count(); ++i) {
        const char *key = fst_param_at(i)->key;
        if (strncmp(key, name, length) == 0 && key[length] == '.')
            return 1;
    }
    return 0;
}

static fst_status unknown_group(scene_reader *reader, int line, const char *name)
{
    char names[256] = "", nearest[32], quoted[FST_QUOTE_SIZE], sentence[256];
    for (int i = 0; i < fst_param_count(); ++i) {
        char group[32];
        const char *key = fst_param_at(i)->key;
        (void)snprintf(group, sizeof group, "%.*s|", (int)strcspn(key, "."), key);
        if (!strstr(names, group))
            strncat(names, group, sizeof names - strlen(names) - 1);
    }
    fst_nearest_name(name, names, nearest, sizeof nearest);
    (void)snprintf(sentence, sizeof sentence, "unknown group %s; the nearest is %s", fst_quote(name, quoted),
                   nearest);
    return fail_at(reader, line, sentence);
}

static fst_status read_mapping(scene_reader *reader, const char *group, int start_line);

/* Read the value behind the key `name`, on this line, in `group` (NULL: top level). */
static fst_status read_value(scene_reader *reader, const char *group, const char *name, int line,
                             const yaml_event_t *event)
{
    char key[96], quoted[FST_QUOTE_SIZE], sentence[256];
    if (!group && event->type == YAML_MAPPING_START_EVENT)
        return is_group(name) ? read_mapping(reader, name, line) : unknown_group(reader, line, name);
    (void)snprintf(key, sizeof key, "%s%s%.80s", group ? group : "", group ? "." : "", name);
    if (event->type != YAML_SCALAR_EVENT) {
        (void)snprintf(sentence, sizeof sentence, "%s must be one value, not a %s", fst_quote(key, quoted),
                       event->type == YAML_SEQUENCE_START_EVENT ? "list" : "group of keys");
        return fail_at(reader, line, sentence);
    }
    if (!group && is_group(name)) {
        (void)snprintf(sentence, sizeof sentence, "%s is a group: write its keys below it, or remove the line",
                       name);
        return fail_at(reader, line, sentence);
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
            return fail_at(reader, line, sentence);
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
        fst_status status = next_event(reader, &key);
        if (status != FST_OK)
            return status;
        int line = line_of(key.start_mark);
        if (key.type == YAML_MAPPING_END_EVENT) {
            yaml_event_delete(&key);
            return keys || !group ? FST_OK : fail_at(reader, start_line, "this group has no keys");
        }
        const char *name = key.type == YAML_SCALAR_EVENT ? scalar_text(&key) : NULL;
        if (!name) {
            yaml_event_delete(&key);
            return fail_at(reader, line, "a key must be a word, as in \"radius: 2.5 mm\"");
        }
        status = group ? FST_OK : note_group(reader, seen, &seen_count, name, line);
        if (status == FST_OK) {
            status = next_event(reader, &value);
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
    status = next_event(reader, &root);
    if (status != FST_OK)
        return status;
    int line = line_of(root.start_mark);
    type = root.type;
    int nothing = type == YAML_SCALAR_EVENT && is_null(&root);
    yaml_event_delete(&root);
    if (type != YAML_MAPPING_START_EVENT && !nothing)
        return fail_at(reader, line,
                       "a scene is made of groups of keys, as in \"bead:\" and \"  radius: 2.5 mm\"");
    if (!nothing)
        status = read_mapping(reader, NULL, line);
    if (status == FST_OK)
        status = skip_event(reader, &type); /* document end */
    if (status != FST_OK)
        return status;
    yaml_event_t end;
    status = next_event(reader, &end);
    if (status != FST_OK)
        return status;
    if (end.type != YAML_STREAM_END_EVENT)
        status =
            fail_at(reader, line_of(end.start_mark), "a scene is one YAML document; a second one begins here");
    yaml_event_delete(&end);
    return status;
}

/* ---------------------------------------------------------------- applying what was read */

static int line_given(const scene_reader *reader, const char *key)
{
    int index = fst_param_find(key);
    return reader->values[index] ? reader->lines[index] : 0;
}

/* A quantity given in two ways is an error, because nobody knows which was meant.  With magnet.b0 the same
 * holds for model.kappa, but only where bead.moment is given too. */
static fst_status check_forms(scene_reader *reader)
{
    for (int i = 0; i < reader->count; ++i) {
        const char *key = fst_param_at(i)->key, *other = fst_param_other_form(key);
        if (!other || !reader->values[i])
            continue;
        int first = line_given(reader, other);
        if (!first || first > reader->lines[i])
            continue; /* not given, or reported from the later of the two lines */
        int strength = strcmp(key, "model.kappa") == 0 || strcmp(other, "model.kappa") == 0;
        if (strength && !line_given(reader, "bead.moment"))
            continue;
        char sentence[256];
        (void)snprintf(sentence, sizeof sentence,
                       "%s is given here and %s%s on line %d: they give the same quantity, keep one", key,
                       other, strength ? " (with bead.moment)" : "", first);
        return fail_at(reader, reader->lines[i], sentence);
    }
    return FST_OK;
}

/* model.kappa is applied first: setting it clears magnet.b0, which may be given beside it to scale
 * the field. */
static fst_status apply(const scene_reader *reader, fst_params *params)
{
    fst_params changed = *params;
    int kappa = fst_param_find("model.kappa");
    for (int i = -1; i < reader->count; ++i) {
        int index = i < 0 ? kappa : i;
        if (!reader->values[index] || (i >= 0 && i == kappa))
            continue;
        fst_status status =
            fst_params_set(&changed, fst_param_at(index)->key, reader->values[index], reader->error);
        if (status != FST_OK)
            return status;
    }
    *params = changed;
    return FST_OK;
}

fst_status fst_scene_parse(const char *text, size_t size, const char *name, fst_params *params,
                           fst_error *error)
{
    fst_error unseen;
    scene_reader reader = {.name = name, .text = text, .size = size, .error = error ? error : &unseen};
    reader.count = fst_param_count();
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
        if (status == FST_OK)
            status = check_forms(&reader);
        if (status == FST_OK)
            status = apply(&reader, params);
    } else {
        fst_fail(error, FST_NO_MEMORY, name, "out of memory");
    }
    for (int i = 0; reader.values && i < reader.count; ++i)
        free(reader.values[i]);
    free(reader.values);
    free(reader.lines);
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
    char *text;
    size_t size;
    fst_params changed = *params;
    fst_status status = fst_read_regular(path, FST_SCENE_SIZE_LIMIT, &text, &size, error);
    if (status != FST_OK)
        return status;
    changed.magnet_file[0] = '\0';
    status = fst_scene_parse(text, size, path, &changed, error);
    free(text);
    if (status == FST_OK && !changed.magnet_file[0])
        memcpy(changed.magnet_file, params->magnet_file, sizeof changed.magnet_file);
    else if (status == FST_OK)
        status = begin_at_scene(path, changed.magnet_file, error);
    if (status == FST_OK)
        *params = changed;
    return status;
}
