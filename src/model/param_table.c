/* param_table.c - the table of parameters, generated from params.def: its rows, and looking keys up. */
#include <stdio.h>
#include <string.h>

#include "base/error.h"
#include "base/text.h"
#include "model/bead_rows.h"
#include "model/coil_rows.h"
#include "model/list_rows.h"
#include "model/params.h"
#include "model/part_rows.h"

static const fst_param_info rows[] = {
#define FST_REAL(group, name, unit, initial, least, greatest, doc)                                             \
    FST_PARAM_ROW(#group "." #name, REAL, unit, NULL, initial, least, greatest, doc, group##_##name),
#define FST_INT(group, name, initial, least, greatest, doc)                                                    \
    FST_PARAM_ROW(#group "." #name, INT, NUMBER, NULL, initial, least, greatest, doc, group##_##name),
#define FST_CHOICE(group, name, names, initial, doc)                                                           \
    FST_PARAM_ROW(#group "." #name, CHOICE, NUMBER, names, initial, 0, 0, doc, group##_##name),
#define FST_TEXT(group, name, room, doc)                                                                       \
    FST_PARAM_ROW(#group "." #name, TEXT, NUMBER, NULL, NAN, 0, (room)-1, doc, group##_##name),
#define FST_REALS2(...)
#define FST_REALS3(...)
#include <festoon/params.def>
#undef FST_REALS2
#undef FST_REALS3
#undef FST_REAL
#undef FST_INT
#undef FST_CHOICE
#undef FST_TEXT
};
enum { ROW_COUNT = sizeof rows / sizeof rows[0] };
enum { LIST_ROW_0 = ROW_COUNT + FST_PART_ROWS, COIL_ROW_0 = LIST_ROW_0 + FST_LIST_ROWS };
enum { BEAD_ROW_0 = COIL_ROW_0 + FST_COIL_ROWS, ALL_ROWS = BEAD_ROW_0 + FST_BEAD_ROWS };

int fst_param_count(void)
{
    return ROW_COUNT;
}

const fst_param_info *fst_param_at(int index)
{
    if (index < 0 || index >= ALL_ROWS)
        return NULL;
    if (index >= BEAD_ROW_0)
        return fst_bead_row(index - BEAD_ROW_0);
    if (index >= COIL_ROW_0)
        return fst_coil_row(index - COIL_ROW_0);
    if (index >= LIST_ROW_0)
        return fst_list_row(index - LIST_ROW_0);
    return index < ROW_COUNT ? &rows[index] : fst_part_row(index - ROW_COUNT);
}

int fst_params_row_count(const fst_params *params)
{
    const int keyed = params->bead_count <= FST_BEADS_MOST; /* beads of a longer list have no keys */
    return BEAD_ROW_0 + (keyed ? FST_BEAD_FIELDS * params->bead_count : 0);
}

int fst_param_part(int index)
{
    return index < ROW_COUNT || index >= LIST_ROW_0 ? -1 : (index - ROW_COUNT) / FST_PART_FIELDS;
}

int fst_param_coil(int index)
{
    return index < COIL_ROW_0 || index >= BEAD_ROW_0 ? -1 : (index - COIL_ROW_0) / FST_COIL_FIELDS;
}

int fst_param_bead(int index)
{
    return index < BEAD_ROW_0 ? -1 : (index - BEAD_ROW_0) / FST_BEAD_FIELDS;
}

int fst_param_find(const char *key)
{
    char whole[64];
    fst_bead_whole_key(key, whole, sizeof whole);
    for (int i = 0; i < ALL_ROWS; i++)
        if (strcmp(fst_param_at(i)->key, whole) == 0)
            return i;
    return -1;
}

/* ---------------------------------------------------------------- keys that are no more */

/* The answers to old scenes, commands and programs that use keys and choices that are gone. */
static const struct {
    const char *key, *choice, *sentence; /* choice "": the whole key */
} gone[] = {
    {"contact.patch", "pade",
     "contact.patch: pade is gone: it approached hertz to within 48 %; choose hertz, which is exact"},
    {"friction.contact_rate", "",
     "friction.contact_rate is gone: dry friction has no viscous part any more; leave the key out (0, its "
     "default, was no such part)"},
    {"run.controller", "",
     "run.controller is gone: runs follow the rule that was called plain; leave the key out, and lower "
     "run.rtol where damped was meant to make a run more exact"},
    {"run.method", "splitting",
     "run.method: splitting is gone: every run locates the events of dry friction; leave the key out"},
};

const char *fst_param_removed(const char *key, const char *choice)
{
    for (size_t i = 0; i < sizeof gone / sizeof *gone; ++i)
        if (strcmp(gone[i].key, key) == 0 && strcmp(gone[i].choice, choice) == 0)
            return gone[i].sentence;
    return NULL;
}

/* Which keys may have been meant by a wrong one, from sure to any. */
enum { SAME_NAME, BEGINNING_OF_NAME, ANY_KEY };

/* "radius" and "magnet.radius" have the name of bead.radius and plate.radius, "freq" the beginning of one. */
static int may_mean(const char *wrong, const char *key, int how)
{
    const char *point = strchr(wrong, '.'), *name = point ? point + 1 : wrong, *own = strchr(key, '.') + 1;
    if (how == SAME_NAME)
        return strcmp(own, name) == 0;
    return how == ANY_KEY || (!point && strlen(name) > 2 && strncmp(own, name, strlen(name)) == 0);
}

/* The key whose own name is nearest to a wrong one that has no group: "kapa" is far from all of "model.kappa".  NULL: more
 * than a third of its letters are others. */
static const char *key_of_nearest_name(const char *wrong)
{
    char names[ROW_COUNT * 32] = "", nearest[48];
    for (int i = 0; i < ROW_COUNT; i++) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "",
                       strchr(rows[i].key, '.') + 1);
    }
    const int edits = fst_nearest_name(wrong, names, nearest, sizeof nearest);
    return 3 * (size_t)edits > strlen(wrong) ? NULL : rows[fst_name_place(nearest, names)].key;
}

fst_status fst_param_unknown_key(const char *key, fst_error *error)
{
    char quoted[FST_QUOTE_SIZE], names[ROW_COUNT * 32] = "";
    char suggestion[FST_SUGGESTION_SIZE];
    if (strncmp(key, "magnet.parts", strlen("magnet.parts")) == 0)
        return fst_part_unknown_key(key, error);
    if (strncmp(key, "beads", strlen("beads")) == 0)
        return fst_bead_unknown_key(key, error);
    if (strncmp(key, "coils", strlen("coils")) == 0)
        return fst_coil_unknown_key(key, error);
    const char *removed = fst_param_removed(key, "");
    if (removed)
        return fst_fail(error, FST_BAD_INPUT, key, "%s", removed);
    const int last = strchr(key, '.') ? ANY_KEY : BEGINNING_OF_NAME;
    for (int how = SAME_NAME; how <= last && !names[0]; how++)
        for (int i = 0; i < ROW_COUNT; i++) {
            size_t used = strlen(names);
            if (may_mean(key, rows[i].key, how))
                (void)snprintf(names + used, sizeof names - used, "%s%s", used ? "|" : "", rows[i].key);
        }
    const char *nearest = names[0] ? NULL : key_of_nearest_name(key);
    if (names[0])
        (void)fst_suggest_name(key, names, suggestion);
    else
        (void)snprintf(suggestion, sizeof suggestion, nearest ? "the nearest is %s" : "no name is like it",
                       nearest);
    return fst_fail(error, FST_BAD_INPUT, key, "unknown key %s; %s (fst_param_at() lists them all)",
                    fst_quote(key, quoted), suggestion);
}
