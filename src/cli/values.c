/* values.c - values of options that several commands have: units, names of columns, numbers, times. */
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"

fst_status read_choice(const char *option_name, const char *text, const char *what, const char *names,
                       int *place, fst_error *error)
{
    char suggestion[FST_SUGGESTION_SIZE];
    const int found = text ? fst_name_place(text, names) : *place;
    if (found >= 0) {
        *place = found;
        return FST_OK;
    }
    return fail(error, FST_BAD_INPUT, option_name, "unknown %s \"%.60s\"; %s", what, text,
                fst_suggest_name(text, names, suggestion));
}

fst_status read_units(const arguments *given, fst_shown_units *units, fst_error *error)
{
    int place = FST_SHOWN_AS_GIVEN;
    const fst_status status =
        read_choice("--units", option_value(given, "units"), "units", FST_WORDS(FST_SHOWN), &place, error);
    *units = (fst_shown_units)place;
    return status;
}

fst_status read_look(const arguments *given, const char **title, double size[2], fst_error *error)
{
    const char *text = option_value(given, "size"), *cross = text ? strchr(text, 'x') : NULL;
    char width[40];
    if (option_value(given, "title"))
        *title = option_value(given, "title");
    if (!text)
        return FST_OK;
    (void)snprintf(width, sizeof width, "%.*s", cross ? (int)(cross - text) : 39, text);
    if (fst_parse_value(width, FST_UNIT_LENGTH, &size[0], NULL) != FST_OK || !(size[0] > 0.0) ||
        (cross && (fst_parse_value(cross + 1, FST_UNIT_LENGTH, &size[1], NULL) != FST_OK || !(size[1] > 0.0))))
        return fail(error, FST_BAD_INPUT, "--size", "\"%.40s\" is not a size: write it as 86mm or 86mmx60mm",
                    text);
    return FST_OK;
}

fst_status read_quantities(const arguments *given, char words[KEYS_SIZE], const char **names, int most,
                           fst_error *error)
{
    const char *text = option_value(given, "quantity");
    if (text && strlen(text) >= KEYS_SIZE)
        return fail(error, FST_BAD_INPUT, "--quantity", "the list is longer than %d letters", KEYS_SIZE - 1);
    (void)snprintf(words, KEYS_SIZE, "%s", text ? text : "");
    for (int count = 0; *words; ++count) {
        const size_t length = strcspn(words, ",");
        const int last = !words[length];
        if (length == 0)
            return fail(error, FST_BAD_INPUT, "--quantity", "a name is missing in \"%.60s\"", text);
        if (count == most)
            return fail(error, FST_BAD_INPUT, "--quantity", "this shows at most %d, not \"%.60s\"", most, text);
        names[count] = words;
        if (last)
            break;
        words[length] = '\0';
        words += length + 1;
    }
    return FST_OK;
}

fst_status read_unit(const char *name, const char *text, fst_unit unit, double *value, fst_error *error)
{
    const fst_status status = fst_parse_value(text, unit, value, error);
    if (status != FST_OK)
        (void)snprintf(error->where, sizeof error->where, "%s", name);
    return status;
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
        double value;
        if (!reciprocal && strchr(number, ',')) /* the sentence about decimal commas */
            return read_unit(name, text, FST_UNIT_TIME, seconds, error);
        if (fst_parse_value(number, FST_UNIT_NUMBER, &value, error) != FST_OK || (reciprocal && value == 0.0))
            break;
        *seconds = units[i].worth * (reciprocal ? 1.0 / value : value);
        return FST_OK;
    }
    return fail(error, FST_BAD_INPUT, name, "\"%.40s\" is not a time: write it as 2ms, 0.002s or 1/500s", text);
}

static fst_status read_value(const value_option *row, const char *name, const char *text, fst_error *error)
{
    if (row->kind == VALUE_TIME)
        return read_time(name, text, row->value, error);
    if (row->kind != VALUE_WHOLE && row->kind != FST_UNIT_NUMBER)
        return read_unit(name, text, (fst_unit)row->kind, row->value, error);
    double number;
    const fst_status status = read_numbers(name, text, &number, 1, error);
    if (status != FST_OK)
        return status;
    if (row->kind == VALUE_WHOLE &&
        !(number >= row->least && number <= row->greatest && number == floor(number)))
        return fail(error, FST_BAD_INPUT, name, "\"%.40s\" must be an integer from %.0f to %.0f", text,
                    row->least, row->greatest);
    *row->value = number;
    return FST_OK;
}

fst_status read_values(const arguments *given, const value_option *rows, size_t count, fst_error *error)
{
    fst_status status = FST_OK;
    for (size_t i = 0; i < count && status == FST_OK; ++i) {
        const char *text = option_value(given, rows[i].name);
        char name[32];
        (void)snprintf(name, sizeof name, "--%s", rows[i].name);
        if (text)
            status = read_value(&rows[i], name, text, error);
    }
    return status;
}

fst_status read_track_scale(const char *text, fst_track_options *how, char unit[FST_LENGTH_UNIT_SIZE],
                            fst_error *error)
{
    char *end, plain[80];
    const double number = strtod(text, &end);
    end += strspn(end, " ");
    if (end != text && strncmp(end, "+-", 2) == 0) { /* the error, and then the length without it */
        const char *from = end + 2;
        how->scale_error = strtod(from, &end) / number;
        if (end == from || !(how->scale_error > 0.0 && how->scale_error < 1.0))
            return fail(error, FST_BAD_INPUT, "--scale",
                        "\"%.40s\": an error between zero and the length was expected, as in 0.123+-0.001mm",
                        text);
        (void)snprintf(plain, sizeof plain, "%.17g %.40s", number, end);
        return read_track_scale(plain, how, unit, error);
    }
    end += strspn(end, " ");
    if (end != text && (strcmp(end, "px") == 0)) {
        how->scale = number;
        how->scale_unit = "px";
        return FST_OK;
    }
    if (end == text || !*end)
        return fail(error, FST_BAD_INPUT, "--scale", "\"%.40s\": a length with a unit was expected (px %s)",
                    text, fst_unit_accepted(FST_UNIT_LENGTH));
    const fst_status status = fst_parse_value(text, FST_UNIT_LENGTH, &how->scale, error);
    if (status != FST_OK)
        (void)snprintf(error->where, sizeof error->where, "--scale");
    (void)snprintf(unit, FST_LENGTH_UNIT_SIZE, "%.7s", end);
    how->scale_unit = unit;
    return status;
}
