/* scene_reader.c - what the readers of a scene's pieces share: libyaml's events, errors with FILE:LINE, and the
 * values that were read. */
#include "io/scene_reader.h"

#include <stdio.h>
#include <string.h>

#include "base/error.h"

/* ---------------------------------------------------------------- messages with FILE:LINE */

fst_status fst_scene_fail(scene_reader *reader, int line, const char *sentence)
{
    char where[sizeof reader->error->where];
    (void)snprintf(where, sizeof where, "%.200s:%d", reader->name, line);
    return fst_fail(reader->error, FST_BAD_INPUT, where, "%s", sentence);
}

int fst_scene_line(yaml_mark_t mark)
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
        (void)snprintf(sentence, sizeof sentence, "this is not text in UTF-8 (%s, byte %zu): a scene is YAML",
                       parser->problem, parser->problem_offset);
        return fst_scene_fail(reader, line, sentence);
    }
    (void)snprintf(sentence, sizeof sentence, "this is not YAML: %s%s%s",
                   parser->problem ? parser->problem : "?", parser->context ? " " : "",
                   parser->context ? parser->context : "");
    return fst_scene_fail(reader, fst_scene_line(parser->problem_mark), sentence);
}

/* ---------------------------------------------------------------- events */

fst_status fst_scene_event(scene_reader *reader, yaml_event_t *event)
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
    int line = fst_scene_line(event->start_mark);
    yaml_event_delete(event);
    return fst_scene_fail(reader, line, sentence);
}

int fst_scene_null(const yaml_event_t *event)
{
    const char *text = (const char *)event->data.scalar.value;
    return event->data.scalar.style == YAML_PLAIN_SCALAR_STYLE &&
           (text[0] == '\0' || strcmp(text, "~") == 0 || strcmp(text, "null") == 0);
}

const char *fst_scene_scalar(const yaml_event_t *event)
{
    const char *text = (const char *)event->data.scalar.value;
    return strlen(text) == event->data.scalar.length ? text : NULL;
}

/* ---------------------------------------------------------------- values */

fst_status fst_scene_note(scene_reader *reader, int index, int line, const char *text, fst_params *scratch)
{
    const char *key = fst_param_at(index)->key;
    fst_error why;
    if (fst_params_set(scratch, key, text, &why) != FST_OK)
        return fst_scene_fail(reader, line, why.sentence);
    reader->values[index] = strdup(text);
    reader->lines[index] = line;
    if (!reader->values[index])
        return fst_fail(reader->error, FST_NO_MEMORY, key, "out of memory");
    return FST_OK;
}
