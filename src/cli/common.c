/* common.c - what several commands need: errors, warnings, names of files, numbers. */
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "cli/command.h"
#include "cli/groups.h"

fst_status fail(fst_error *error, fst_status code, const char *where, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    (void)vsnprintf(error->sentence, sizeof error->sentence, format, values);
    va_end(values);
    (void)snprintf(error->where, sizeof error->where, "%s", where);
    fst_text_tame(error->sentence);
    fst_text_tame(error->where);
    error->code = code;
    return code;
}

void warn_of_material(const fst_params *params)
{
    char sentence[512];
    if (fst_bead_contradiction(params, sentence, sizeof sentence))
        (void)fprintf(stderr, "festoon: warning: %s\n", sentence);
}

fst_status print_and_free(char *text, FILE *out, fst_error *error)
{
    if (!text)
        return fail(error, FST_NO_MEMORY, "", "out of memory");
    (void)fputs(text, out);
    free(text);
    return FST_OK;
}

const char *shown(const char *path, char text[SHOWN_SIZE])
{
    (void)snprintf(text, SHOWN_SIZE, "%s", path);
    fst_text_tame(text);
    return text;
}

void tell_written(const char *path, const char *remark)
{
    char text[SHOWN_SIZE];
    (void)fprintf(stderr, "wrote %s%s\n", shown(path, text), remark);
}

int ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), wanted = strlen(ending);
    return length > wanted && strcmp(path + length - wanted, ending) == 0;
}

double unsigned_zero(double value, int decimals)
{
    return fabs(value) <= 0.5 * pow(10.0, -decimals) ? 0.0 : value;
}

void print_shown(const page *p, const char *name, const double *values, int count, const char *key,
                 const char *unit)
{
    const char *shown_unit;
    const double factor = fst_number_shown(key, unit, p->units, &p->scales, &shown_unit);
    (void)fprintf(p->out, "  %-24s", name);
    for (int i = 0; i < count; ++i)
        (void)fprintf(p->out, "%s %.12g", i ? "," : " ", unsigned_zero(factor * values[i], ALL_DIGITS));
    (void)fprintf(p->out, "%s%s\n", *shown_unit ? " " : "", shown_unit);
}

shown_parameter show_parameter(const page *p, const char *key)
{
    const int row = fst_param_find(key);
    const char *unit = row >= 0 ? fst_unit_name(fst_param_at(row)->unit) : "";
    shown_parameter shown = {1.0, ""};
    int power = 0;
    if (strcmp(key, "drive.omega") == 0)
        shown.factor = fst_number_shown("omega", "gamma", p->units, &p->scales, &unit);
    else if (strcmp(key, "drive.frequency") == 0 && p->units == FST_SHOWN_SCALED) {
        shown.factor = TWO_PI * p->scales.time;
        unit = "gamma";
    } else if (row >= 0 && p->units == FST_SHOWN_LAB) {
        unit = fst_unit_customary(fst_param_at(row)->unit, &power);
        shown.factor = pow(10.0, power);
    }
    if (strcmp(unit, "1") != 0 && *unit)
        (void)snprintf(shown.unit, sizeof shown.unit, " %s", unit);
    return shown;
}

void print_omega(const page *p, double omega)
{
    const char *unit;
    const double factor = fst_number_shown("omega", "gamma", p->units, &p->scales, &unit);
    (void)fprintf(p->out, "omega = %.10g%s%s", factor * omega, p->units == FST_SHOWN_AS_GIVEN ? "" : " ",
                  p->units == FST_SHOWN_AS_GIVEN ? "" : unit);
}

fst_status read_numbers(const char *option_name, const char *text, double *numbers, int count, fst_error *error)
{
    const char *at = text;
    for (int i = 0; i < count; ++i) {
        char word[64];
        size_t length = strcspn(at, ",");
        int last = i + 1 == count;
        (void)snprintf(word, sizeof word, "%.*s", (int)(length < 63 ? length : 63), at);
        if (at[length] != (last ? '\0' : ',') ||
            fst_parse_value(word, FST_UNIT_NUMBER, &numbers[i], error) != FST_OK)
            return count == 1
                       ? fail(error, FST_BAD_INPUT, option_name, "\"%.60s\" must be a number, without a unit",
                              text)
                       : fail(error, FST_BAD_INPUT, option_name,
                              "\"%.60s\" must be %d numbers separated by commas, without spaces or units", text,
                              count);
        at += length + !last;
    }
    return FST_OK;
}
