/* scene_reader.h - what the readers of a scene's pieces share. */
#ifndef FST_IO_SCENE_READER_H
#define FST_IO_SCENE_READER_H

#include <yaml.h>

#include <festoon/festoon.h>

/* What the scene said so far: values are applied at the end (scene.c). */
typedef struct scene_reader {
    yaml_parser_t parser;
    const char *name; /* of the file, for messages */
    const char *text;
    size_t size;
    int count;     /* the number of parameters, those of parts included */
    char **values; /* by the parameter's index; NULL: not given */
    int *lines;    /* the line on which each was given */
    int lists_parts;
    int part_lines[FST_PARTS_MAX];
    int bead_count; /* of the list that was read */
    fst_bead_params *beads;
    fst_bead_params **list; /* where those of a long list go; NULL: nowhere */
    fst_error *error;
} scene_reader;

/* FST_BAD_INPUT with FILE:LINE. */
fst_status fst_scene_fail(scene_reader *reader, int line, const char *sentence);

int fst_scene_line(yaml_mark_t mark);

/* The next event, which has no anchor, alias or tag: a scene says everything where it stands and needs none.
 * The caller deletes the event. */
fst_status fst_scene_event(scene_reader *reader, yaml_event_t *event);

/* An empty value: `radius:` or `radius: ~`. */
int fst_scene_null(const yaml_event_t *event);

/* The text of a value; NULL where a zero byte hides in it. */
const char *fst_scene_scalar(const yaml_event_t *event);

/* Note a parameter's value, on this line, after it was tried on `scratch`. */
fst_status fst_scene_note(scene_reader *reader, int index, int line, const char *text, fst_params *scratch);

/* Read magnet.parts, whose first event was read (scene_parts.c), and beads (scene_beads.c). */
fst_status fst_scene_parts(scene_reader *reader, int line, const yaml_event_t *start);
fst_status fst_scene_beads(scene_reader *reader, int line, const yaml_event_t *start);

#endif
