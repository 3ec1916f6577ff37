/* values.c - values of options that several commands have: units, names of columns. */
#include <string.h>

#include "cli/command.h"

fst_status read_units(const arguments *given, fst_shown_units *units, fst_error *error)
{
    static const char *const names[] = {"scaled", "lab", "si"};
    static const fst_shown_units values[] = {FST_SHOWN_SCALED, FST_SHOWN_LAB, FST_SHOWN_SI};
    const char *text = option_value(given, "units");
    char nearest[16];
    *units = FST_SHOWN_AS_GIVEN;
    if (!text)
        return FST_OK;
    for (int i = 0; i < 3; ++i)
        if (strcmp(text, names[i]) == 0) {
            *units = values[i];
            return FST_OK;
        }
    fst_nearest_name(text, "scaled|lab|si", nearest, sizeof nearest);
    return fail(error, FST_BAD_INPUT, "--units", "unknown units \"%.40s\"; the nearest is %s (scaled, lab, si)",
                text, nearest);
}

fst_status read_keys(const char *text, char words[KEYS_SIZE], const char *keys[KEY_LIMIT], int *count,
                     fst_error *error)
{
    *count = 0;
    if (strlen(text) >= KEYS_SIZE)
        return fail(error, FST_BAD_INPUT, "--key", "the list is longer than %d letters", KEYS_SIZE - 1);
    (void)snprintf(words, KEYS_SIZE, "%s", text);
    for (char *word = words; *word;) {
        const size_t length = strcspn(word, ",");
        if (length == 0)
            return fail(error, FST_BAD_INPUT, "--key", "a name is missing in \"%.60s\"", text);
        if (*count == KEY_LIMIT)
            return fail(error, FST_BAD_INPUT, "--key", "there are more than %d names", KEY_LIMIT);
        keys[(*count)++] = word;
        if (!word[length])
            break;
        word[length] = '\0';
        word += length + 1;
    }
    return FST_OK;
}
