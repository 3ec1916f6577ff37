/* completion_words.c - what can stand on the command line, from the tables of options, parameters, results and
 * columns. */
#include "cli/completion_words.h"

#include <string.h>

value_kind kind_of_value(const option *row)
{
    static const char *const files[] = {"FILE", "FIG", "FILM", "DIR", "FOLDER"};
    if (!row->value)
        return VALUE_NONE;
    if (strcmp(row->value, "KEY=VALUE") == 0)
        return VALUE_SETTING;
    if (strncmp(row->value, "KEY=", 4) == 0)
        return VALUE_KEY;
    if (strcmp(row->value, "KEY,KEY") == 0)
        return VALUE_KEYS;
    if (strcmp(row->value, "KEY,...") == 0 || strcmp(row->value, "KEY[:STEP]") == 0)
        return VALUE_RESULTS;
    if (strcmp(row->value, "COLUMN") == 0)
        return VALUE_COLUMN;
    if (strchr(row->value, '|') &&
        strspn(row->value, "abcdefghijklmnopqrstuvwxyz0123456789|-") == strlen(row->value))
        return VALUE_CHOICE;
    for (size_t i = 0; i < sizeof files / sizeof *files; ++i)
        if (strncmp(row->value, files[i], strlen(files[i])) == 0)
            return VALUE_FILE;
    return VALUE_FREE;
}

void print_words(FILE *out, const char *list, const char *before, const char *behind)
{
    while (*list) {
        const size_t length = strcspn(list, "|");
        (void)fprintf(out, "%s%.*s%s", before, (int)length, list, behind);
        list += length + (list[length] == '|');
    }
}

const fst_param_info *offered_param(int index)
{
    return index < fst_param_count() || fst_param_part(index) == 0 ? fst_param_at(index) : NULL;
}

void print_keys(FILE *out, const char *before, const char *behind)
{
    for (int i = 0; offered_param(i); ++i)
        (void)fprintf(out, "%s%s%s", before, offered_param(i)->key, behind);
}

void print_results(FILE *out, const char *before, const char *behind)
{
    (void)fprintf(out, "%sregime%s", before, behind);
    for (int i = 0; i < fst_result_count(); ++i)
        (void)fprintf(out, "%s%s%s", before, fst_result_at(i)->name, behind);
}

void print_columns(FILE *out, const char *before, const char *behind)
{
    for (int i = 0; i < fst_column_count(); ++i)
        (void)fprintf(out, "%s%s%s", before, fst_column_at(i)->name, behind);
}

const char *file_endings(const char *synopsis, char endings[64])
{
    const char *point = synopsis + strcspn(synopsis, ". ");
    endings[0] = '\0';
    if (*point == '.') {
        const char *from = point + 1 + (point[1] == '(');
        (void)snprintf(endings, 64, "%.*s", (int)strspn(from, "abcdefghijklmnopqrstuvwxyz0123456789|"), from);
    }
    return endings;
}

void print_quoted(FILE *out, const char *text, const char *quote, const char *special)
{
    for (; *text; ++text) {
        if (*text == '\'') {
            (void)fputs(quote, out);
            continue;
        }
        if (strchr(special, *text))
            (void)fputc('\\', out);
        (void)fputc(*text == '\n' ? ' ' : *text, out);
    }
}
