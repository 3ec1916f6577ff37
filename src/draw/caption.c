/* caption.c - what of a scene is not the default, for the line below a figure's title: two figures of different beads or
 * laws say so. */
#include "draw/caption.h"

#include <stdio.h>
#include <string.h>

#include "base/units.h"

enum { LONGEST = 150 }; /* characters, which is two lines of a figure */

static int is_among(const char *key, const char *const *keys, int count)
{
    int i = 0;
    while (i < count && strcmp(key, keys[i]) != 0)
        ++i;
    return i < count;
}

/* Not told: the length of runs, the frame, and texts, which are names of files and tables. */
static int may_be_told(const fst_param_info *row)
{
    return row->kind != FST_KIND_TEXT && strncmp(row->key, "run.", 4) != 0 &&
           strcmp(row->key, "world.frame") != 0;
}

void fst_caption(const fst_params *params, const char *const *shown, int count, char *text, size_t size)
{
    const fst_params usual = fst_default_params();
    size_t used = strlen(text);
    const size_t begun = used;
    int left = 0;
    for (int i = 0; i < fst_param_count(); ++i) {
        const fst_param_info *row = fst_param_at(i);
        char value[64], other[64];
        if (!may_be_told(row) || is_among(row->key, shown, count) ||
            !fst_params_get(params, i, value, sizeof value))
            continue;
        (void)fst_params_get(&usual, i, other, sizeof other);
        if (strcmp(value, other) == 0)
            continue;
        double number;
        if (row->kind != FST_KIND_CHOICE && fst_parse_value(value, row->unit, &number, NULL) == FST_OK)
            (void)fst_value_write(value, sizeof value, number, row->unit);
        const size_t length = strlen(row->key) + strlen(value) + 3;
        if (used - begun + length > LONGEST || used + length + 16 > size) {
            ++left;
            continue;
        }
        used += (size_t)snprintf(text + used, size - used, "%s%s %s", used && text[used - 1] != ' ' ? ", " : "",
                                 row->key, value);
    }
    if (left)
        (void)snprintf(text + used, size - used, " and %d more", left);
}
