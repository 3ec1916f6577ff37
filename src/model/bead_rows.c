/* bead_rows.c - the keys of the beads of a list: what params.def has of bead.* and start.*, once more for each bead. */
#include "model/bead_rows.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "model/params.h"

/* ------------------------------------------------------------------ the table */

#define QUOTE(number) #number
#define BEAD_KEY(number, group, name) "beads[" QUOTE(number) "]." #group "." #name
#define FST_KEYS_OF_A_BEAD
#define FST_REAL(group, name, unit, initial, least, greatest, doc)                                             \
    FST_PARAM_ROW(BEAD_KEY(BEAD, group, name), REAL, unit, NULL, NAN, least, greatest, doc,                    \
                  beads[BEAD].group##_##name),
#define FST_CHOICE(group, name, names, initial, doc)                                                           \
    FST_PARAM_ROW(BEAD_KEY(BEAD, group, name), CHOICE, NUMBER, names, FST_BEAD_NO_CHOICE, 0, 0, doc,           \
                  beads[BEAD].group##_##name),
#define ELEMENT(group, name, k, unit, least, greatest, doc)                                                    \
    FST_PARAM_ROW(BEAD_KEY(BEAD, group, name) "[" #k "]", REAL, unit, NULL, NAN, least, greatest, doc,         \
                  beads[BEAD].group##_##name[k]),
#define FST_REALS3(group, name, unit, initial, least, greatest, doc)                                           \
    ELEMENT(group, name, 0, unit, least, greatest, doc)                                                        \
    ELEMENT(group, name, 1, unit, least, greatest, doc) ELEMENT(group, name, 2, unit, least, greatest, doc)

static const fst_param_info rows[] = {
#define BEAD 0
#include <festoon/params.def>
#undef BEAD
#define BEAD 1
#include <festoon/params.def>
#undef BEAD
#define BEAD 2
#include <festoon/params.def>
#undef BEAD
#define BEAD 3
#include <festoon/params.def>
#undef BEAD
#define BEAD 4
#include <festoon/params.def>
#undef BEAD
#define BEAD 5
#include <festoon/params.def>
#undef BEAD
#define BEAD 6
#include <festoon/params.def>
#undef BEAD
#define BEAD 7
#include <festoon/params.def>
#undef BEAD
};
_Static_assert(sizeof rows / sizeof rows[0] == FST_BEAD_ROWS, "a row for each key of each bead");

const fst_param_info *fst_bead_row(int row)
{
    return &rows[row];
}

const char *fst_bead_key_of_setup(const char *key)
{
    return strchr(key, ']') + 2;
}

void fst_bead_whole_key(const char *key, char *whole, size_t size)
{
    static const char list[] = "beads[";
    const char *name = strchr(key, ']');
    const int bare = strncmp(key, list, strlen(list)) == 0 && name && name[1] == '.' && !strchr(name + 2, '.');
    if (bare)
        (void)snprintf(whole, size, "%.*s.bead%s", (int)(name + 1 - key), key, name + 1);
    else
        (void)snprintf(whole, size, "%s", key);
}

/* ------------------------------------------------------------------ what a bead says */

fst_bead_params fst_bead_says_nothing(void)
{
    fst_params scratch;
    for (int i = 0; i < FST_BEAD_FIELDS; ++i)
        fst_param_put(&scratch, &rows[i], rows[i].initial);
    return scratch.beads[0];
}

/* ------------------------------------------------------------------ keys that do not exist */

fst_status fst_bead_unknown_key(const char *key, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE], names[FST_BEAD_FIELDS * 40] = "", suggestion[FST_SUGGESTION_SIZE], *end = NULL;
    fst_quote(key, quoted);
    const char *behind = key + strlen("beads");
    const long bead = *behind == '[' ? strtol(behind + 1, &end, 10) : -1;
    if (bead < 0 || *end != ']' || end == behind + 1)
        return fst_fail(error, FST_BAD_INPUT, key,
                        "unknown key %s: a key of a bead is such as beads[0].start.phi, or beads[0].radius",
                        quoted);
    if (bead >= FST_BEADS_MOST)
        return fst_fail(
            error, FST_BAD_INPUT, key,
            "unknown key %s: the beads with keys are beads[0] to beads[%d]; a scene may list up to %d", quoted,
            FST_BEADS_MOST - 1, FST_BEADS_MANY);
    const int bare = *end && !strchr(end + 1 + (end[1] == '.'), '.'); /* such as beads[1].radius */
    for (int field = 0; field < FST_BEAD_FIELDS; ++field) {
        const size_t used = strlen(names);
        const char *name = fst_bead_key_of_setup(rows[field].key);
        if (bare && strncmp(name, "bead.", strlen("bead.")) == 0)
            name += strlen("bead.");
        (void)snprintf(names + used, sizeof names - used, "%sbeads[%ld].%s", used ? "|" : "", bead, name);
    }
    return fst_fail(error, FST_BAD_INPUT, key, "unknown key %s; %s", quoted,
                    fst_suggest_name(key, names, suggestion));
}
