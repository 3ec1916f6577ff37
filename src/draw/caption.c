/* caption.c - what of a scene is not the default, for the line below a figure's title: two figures of different beads or
 * laws say so. */
#include "draw/caption.h"

#include <festoon/festoon_tools.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/units.h"

enum {
    LONGEST = 150, /* characters, which is two lines of a figure, */
    LAST = 40,     /* and a last key instead of the words that one more differs */
    VALUE = 264    /* bytes of a value: a file's name is one */
};

static int is_among(const char *key, const char *const *keys, int count)
{
    int i = 0;
    while (i < count && strcmp(key, keys[i]) != 0)
        ++i;
    return i < count;
}

/* Not told: the length of runs, the frame, and the checksum of a file that is named. */
static int may_be_told(const fst_param_info *row)
{
    return strcmp(row->key, "magnet.checksum") != 0 && strncmp(row->key, "run.", 4) != 0 &&
           strcmp(row->key, "world.frame") != 0;
}

/* Append "key value" behind a comma to a text that began at `begun`; 0: it would be longer than `longest` there, or than
 * `size`. */
static int tell(const fst_params *params, int index, char *text, size_t size, size_t begun, size_t longest)
{
    const fst_param_info *row = fst_param_at(index);
    char value[VALUE];
    double number;
    if (!fst_params_get(params, index, value, sizeof value) && fst_param_other_form(row->key))
        return 1; /* the quantity is given in its other form, which is told */
    if (row->kind == FST_KIND_TEXT)
        memmove(value, fst_file_name(value), strlen(fst_file_name(value)) + 1);
    else if (row->kind != FST_KIND_CHOICE && fst_parse_value(value, row->unit, &number, NULL) == FST_OK)
        (void)fst_value_write(value, sizeof value, number, row->unit);
    const size_t used = strlen(text), length = strlen(row->key) + strlen(value) + 3;
    if (used - begun + length > longest || used + length + 16 > size)
        return 0;
    (void)snprintf(text + used, size - used, "%s%s %s", used && text[used - 1] != ' ' ? ", " : "", row->key,
                   value[0] ? value : "not given");
    return 1;
}

static int agree(const fst_params *one, const fst_params *other, int index)
{
    char values[2][VALUE];
    (void)fst_params_get(one, index, values[0], sizeof values[0]);
    (void)fst_params_get(other, index, values[1], sizeof values[1]);
    return strcmp(values[0], values[1]) == 0;
}

/* Of the keys for which there was no room: `last` is one of them. */
static void count_left(const fst_params *params, char *text, size_t size, size_t begun, int left, int last)
{
    if (left > 1 || (left == 1 && !tell(params, last, text, size, begun, LONGEST + LAST)))
        (void)snprintf(text + strlen(text), size - strlen(text), " and %d more", left);
}

void fst_caption(const fst_params *params, const char *const *shown, int count, char *text, size_t size)
{
    const fst_params usual = fst_default_params();
    const size_t begun = strlen(text);
    int left = 0, last = 0;
    for (int i = 0; i < fst_param_count(); ++i) {
        char value[VALUE];
        const fst_param_info *row = fst_param_at(i);
        if (may_be_told(row) && !is_among(row->key, shown, count) &&
            fst_params_get(params, i, value, sizeof value) && !agree(params, &usual, i) &&
            !tell(params, i, text, size, begun, LONGEST)) {
            ++left;
            last = i;
        }
    }
    count_left(params, text, size, begun, left, last);
}

/* Whether these scenes have one value of a key. */
static int all_agree(const fst_params *const *scenes, int count, int index)
{
    int i = 1;
    while (i < count && agree(scenes[0], scenes[i], index))
        ++i;
    return i == count;
}

/* Whether a key in which scenes differ counts for one of them: not friction.mu where friction is viscous, whose runs are the
 * same with the values of the others. */
static int counts(const fst_params *const *scenes, int count, int one, int index)
{
    const fst_param_info *row = fst_param_at(index);
    for (int i = 0; i < count; ++i) {
        char value[VALUE];
        fst_params changed = *scenes[one];
        if (agree(scenes[one], scenes[i], index))
            continue;
        const fst_status status = fst_params_get(scenes[i], index, value, sizeof value)
                                      ? fst_params_set(&changed, row->key, value, NULL)
                                  : isnan(row->initial) ? fst_params_unset(&changed, row->key, NULL)
                                                        : FST_BAD_INPUT; /* it is given in its other form */
        if (status != FST_OK || fst_params_changes(scenes[one], &changed) != FST_CHANGE_NOTHING)
            return 1;
    }
    return 0;
}

void fst_caption_differences(const fst_params *const *scenes, int count, const char *const *shown,
                             int shown_count, char (*names)[FST_CAPTION_SIZE], char *same, size_t size)
{
    const fst_params usual = fst_default_params();
    int left[2] = {0, 0}, last[2] = {0, 0};
    same[0] = '\0';
    for (int i = 0; i < count; ++i)
        names[i][0] = '\0';
    for (int k = 0; k < fst_param_count(); ++k) {
        if (!may_be_told(fst_param_at(k)) || is_among(fst_param_at(k)->key, shown, shown_count))
            continue;
        if (!all_agree(scenes, count, k)) {
            size_t used[FST_CHARTS_OVER];
            int all = 1;
            for (int i = 0; i < count; ++i) {
                used[i] = strlen(names[i]);
                all &=
                    !counts(scenes, count, i, k) || tell(scenes[i], k, names[i], FST_CAPTION_SIZE, 0, LONGEST);
            }
            for (int i = 0; i < count && !all; ++i)
                names[i][used[i]] = '\0'; /* told of all or of none */
            left[0] += !all;
            last[0] = all ? last[0] : k;
        } else if (!agree(scenes[0], &usual, k) && !tell(scenes[0], k, same, size, 0, LONGEST)) {
            ++left[1];
            last[1] = k;
        }
    }
    for (int i = 0; i < count; ++i)
        count_left(scenes[i], names[i], FST_CAPTION_SIZE, 0, left[0], last[0]);
    count_left(scenes[0], same, size, 0, left[1], last[1]);
}

const char *fst_file_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

void fst_caption_of_files(const fst_params *const *scenes, const char *const *paths, int count,
                          const char *const *shown, int shown_count, char (*names)[FST_CAPTION_SIZE],
                          char *same, size_t size)
{
    int known = 1, alike[FST_CHARTS_OVER] = {0};
    for (int i = 0; i < count; ++i) {
        known = known && scenes[i];
        names[i][0] = '\0';
    }
    same[0] = '\0';
    if (known)
        fst_caption_differences(scenes, count, shown, shown_count, names, same, size);
    if (known && count > 1 && !same[0])
        (void)snprintf(same, size, "all else as by default");
    for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j)
            alike[i] |= j != i && strcmp(names[i], names[j]) == 0;
    for (int i = 0; i < count; ++i)
        if (alike[i] || !names[i][0]) {
            const size_t used = strlen(names[i]);
            (void)snprintf(names[i] + used, FST_CAPTION_SIZE - used, used ? " (%.100s)" : "%.100s",
                           fst_file_name(paths[i]));
        }
}

void fst_caption_slices(const char *const *slices, int count, const char *name, char *same, size_t size)
{
    int alike = slices[0][0] && !strstr(same, slices[0]) && !strstr(name, slices[0]);
    for (int i = 1; i < count; ++i)
        alike &= strcmp(slices[i], slices[0]) == 0;
    const size_t told = strlen(same);
    if (alike)
        (void)snprintf(same + told, size - told, "%sat %.160s", told ? "; " : "", slices[0]);
}
