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

fst_status read_time(const char *name, const char *text, double *seconds, fst_error *error)
{
    static const struct {
        const char *unit;
        double worth;
    } units[] = {{"ms", 1e-3}, {"us", 1e-6}, {"s", 1.0}};
    char number[64];
    const int reciprocal = strncmp(text, "1/", 2) == 0;
    const char *begin = text + (reciprocal ? 2 : 0);
    for (size_t i = 0; i < sizeof units / sizeof *units; ++i) {
        const size_t length = strlen(begin), unit = strlen(units[i].unit);
        if (length <= unit || strcmp(begin + length - unit, units[i].unit) != 0)
            continue;
        (void)snprintf(number, sizeof number, "%.*s", (int)(length - unit < 60 ? length - unit : 60), begin);
        fst_error unheard;
        double value;
        if (fst_parse_value(number, FST_UNIT_NUMBER, &value, &unheard) != FST_OK ||
            (reciprocal && value == 0.0))
            break;
        *seconds = units[i].worth * (reciprocal ? 1.0 / value : value);
        return FST_OK;
    }
    return fail(error, FST_BAD_INPUT, name, "\"%.40s\" is no time: write it as 2ms, 0.002s or 1/500s", text);
}
