/* scene_beads.c - reading beads of a scene: a list of what each bead says of its own, by the keys of bead.* and start.*,
 * nested (start: {phi: 3 deg}), dotted (start.phi: 3 deg) or, of the bead's own, bare (radius: 2 mm). */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "io/scene_reader.h"

/* The bead that is being read. */
typedef struct bead_text {
    int bead;  /* its number in the list */
    int keyed; /* the number under which its keys are known: beads behind the last with keys share its */
    int first; /* the row of its first key */
    int lines[sizeof(fst_bead_params) / sizeof(int)]; /* of each of its rows; 0: not given */
    fst_params scratch;                               /* takes the values */
} bead_text;

/* Fail with a sentence about the bead as the library knows it, by the number that it has in the list. */
static fst_status fail_of_bead(scene_reader *reader, const bead_text *b, int line, const char *sentence)
{
    char known[24], corrected[sizeof reader->error->sentence];
    (void)snprintf(known, sizeof known, "beads[%d]", b->keyed);
    if (b->bead == b->keyed || strncmp(sentence, known, strlen(known)) != 0)
        return fst_scene_fail(reader, line, sentence);
    (void)snprintf(corrected, sizeof corrected, "beads[%d]%.700s", b->bead, sentence + strlen(known));
    return fst_scene_fail(reader, line, corrected);
}

/* A key that was given already, or in another form. */
static fst_status check_given(scene_reader *reader, const bead_text *b, int row, int line)
{
    char sentence[256];
    const char *key = fst_param_at(row)->key;
    for (int other = b->first; fst_param_bead(other) == b->keyed; ++other) {
        const int before = b->lines[other - b->first];
        const char *name = fst_param_at(other)->key;
        if (!before || (other != row && !fst_params_clash(&b->scratch, key, name)))
            continue;
        if (other == row)
            (void)snprintf(sentence, sizeof sentence, "%s is given twice: first on line %d", key, before);
        else
            (void)snprintf(sentence, sizeof sentence,
                           "%s is given here and %s on line %d: they give the same quantity, keep one", key,
                           strchr(name, ']') + 2, before);
        return fail_of_bead(reader, b, line, sentence);
    }
    return FST_OK;
}

static fst_status note(scene_reader *reader, bead_text *b, const char *key, const yaml_event_t *event)
{
    char sentence[256];
    fst_error why;
    const int line = fst_scene_line(event->start_mark), row = fst_param_find(key);
    const char *text = event->type == YAML_SCALAR_EVENT ? fst_scene_scalar(event) : NULL;
    if (row >= 0 && (!text || fst_scene_null(event))) {
        (void)snprintf(sentence, sizeof sentence, "%s must be one value", key);
        return fail_of_bead(reader, b, line, sentence);
    }
    if (row >= 0) {
        const fst_status status = check_given(reader, b, row, line);
        if (status != FST_OK)
            return status;
        b->lines[row - b->first] = line;
    }
    if (fst_params_set(&b->scratch, key, row >= 0 ? text : "", &why) != FST_OK)
        return fail_of_bead(reader, b, line, why.sentence);
    return FST_OK;
}

/* The three numbers of a vector, whose list was opened. */
static fst_status read_vector(scene_reader *reader, bead_text *b, const char *key, int line)
{
    enum { NUMBERS = 3 };
    fst_status status = FST_OK;
    for (int k = 0, ends = 0; status == FST_OK && !ends; ++k) {
        char element[160];
        yaml_event_t event;
        (void)snprintf(element, sizeof element, "%s[%d]", key, k);
        status = fst_scene_event(reader, &event);
        if (status != FST_OK)
            return status;
        ends = event.type == YAML_SEQUENCE_END_EVENT;
        if (ends ? k < NUMBERS : k == NUMBERS) {
            (void)snprintf(element, sizeof element, "%.100s is a list of three numbers", key);
            status = fail_of_bead(reader, b, line, element);
        } else if (!ends) {
            status = note(reader, b, element, &event);
        }
        yaml_event_delete(&event);
    }
    return status;
}

static fst_status read_keys(scene_reader *reader, bead_text *b, const char *group);

/* The value of a key in a group (""): a group, a list or one value. */
static fst_status read_value(scene_reader *reader, bead_text *b, const char *group, const char *name)
{
    char key[128];
    yaml_event_t event;
    fst_status status = fst_scene_event(reader, &event);
    if (status != FST_OK)
        return status;
    (void)snprintf(key, sizeof key, "beads[%d].%.40s%s%.60s", b->keyed, group, group[0] ? "." : "", name);
    const int is_group = !group[0] && (strcmp(name, "bead") == 0 || strcmp(name, "start") == 0);
    if (is_group && event.type == YAML_MAPPING_START_EVENT)
        status = read_keys(reader, b, name);
    else if (event.type == YAML_SEQUENCE_START_EVENT)
        status = read_vector(reader, b, key, fst_scene_line(event.start_mark));
    else
        status = note(reader, b, key, &event);
    yaml_event_delete(&event);
    return status;
}

/* The keys of a bead, or of a group in it, whose mapping was opened. */
static fst_status read_keys(scene_reader *reader, bead_text *b, const char *group)
{
    for (;;) {
        yaml_event_t key;
        fst_status status = fst_scene_event(reader, &key);
        if (status != FST_OK)
            return status;
        const int ends = key.type == YAML_MAPPING_END_EVENT;
        const char *name = key.type == YAML_SCALAR_EVENT ? fst_scene_scalar(&key) : NULL;
        if (!ends && !name)
            status = fst_scene_fail(reader, fst_scene_line(key.start_mark),
                                    "a key of a bead must be a word, as in \"start.phi: 3 deg\"");
        else if (!ends)
            status = read_value(reader, b, group, name);
        yaml_event_delete(&key);
        if (status != FST_OK || ends)
            return status;
    }
}

static fst_status read_bead(scene_reader *reader, const yaml_event_t *start)
{
    const int bead = reader->bead_count, line = fst_scene_line(start->start_mark);
    bead_text b = {.bead = bead, .keyed = bead < FST_BEADS_MOST ? bead : FST_BEADS_MOST - 1};
    char key[32];
    if (start->type != YAML_MAPPING_START_EVENT)
        return fst_scene_fail(reader, line,
                              "a bead of the list must be keys and values, as in \"- start.phi: 3 deg\" ({}: "
                              "all as the scene says)");
    fst_bead_params *grown = realloc(reader->beads, (size_t)(bead + 1) * sizeof *grown);
    if (!grown)
        return fst_fail(reader->error, FST_NO_MEMORY, "beads", "out of memory");
    reader->beads = grown;
    /* A scratch list of as many beads, which say nothing. */
    b.scratch = fst_default_params();
    for (int i = 0; i <= b.keyed; ++i) {
        (void)snprintf(key, sizeof key, "beads[%d].start.r", i);
        (void)fst_params_set(&b.scratch, key, "1", NULL);
        (void)fst_params_unset(&b.scratch, key, NULL);
    }
    while (fst_param_bead(b.first) != b.keyed)
        ++b.first;
    const fst_status status = read_keys(reader, &b, "");
    grown[bead] = b.scratch.beads[b.keyed];
    reader->bead_count += status == FST_OK;
    return status;
}

fst_status fst_scene_beads(scene_reader *reader, int line, const yaml_event_t *start)
{
    if (start->type != YAML_SEQUENCE_START_EVENT)
        return fst_scene_fail(
            reader, line,
            "beads must be a list of beads, each \"- start.phi: 3 deg\" with what it says of its own");
    if (reader->bead_count)
        return fst_scene_fail(reader, line, "beads is given twice");
    for (;;) {
        yaml_event_t event;
        fst_status status = fst_scene_event(reader, &event);
        if (status != FST_OK)
            return status;
        const int ends = event.type == YAML_SEQUENCE_END_EVENT;
        if (!ends && reader->bead_count == (reader->list ? FST_BEADS_MANY : FST_BEADS_MOST))
            status = fst_scene_fail(reader, fst_scene_line(event.start_mark),
                                    reader->list ? "beads lists more than 1000 beads, which is the most"
                                                 : "beads lists more than 8 beads, which is the most here");
        else if (!ends)
            status = read_bead(reader, &event);
        yaml_event_delete(&event);
        if (ends && !reader->bead_count)
            return fst_scene_fail(reader, line, "beads lists no bead");
        if (status != FST_OK || ends)
            return status;
    }
}
