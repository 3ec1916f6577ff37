/* options.c - reading a command line by a table of options. */
#include "cli/options.h"

#include <stdio.h>
#include <string.h>

#include "cli/command.h"

/* The row of the table for "--name" (length counts the name alone) or for "-o". */
static const option *find_long(const option *table, const char *name, size_t length)
{
    for (; table->name; ++table)
        if (strlen(table->name) == length && memcmp(table->name, name, length) == 0)
            return table;
    return NULL;
}

static const option *find_letter(const option *table, char letter)
{
    for (; table->name; ++table)
        if (table->letter && table->letter == letter)
            return table;
    return NULL;
}

/* The parameter that has this name without its group: who types --frequency means drive.frequency. */
static const char *parameter_named(const char *name)
{
    for (int i = 0; i < fst_param_count(); ++i)
        if (strcmp(strchr(fst_param_at(i)->key, '.') + 1, name) == 0)
            return fst_param_at(i)->key;
    return NULL;
}

static fst_status unknown_option(const option *table, const char *word, fst_error *error)
{
    char names[1024] = "--help", suggestion[FST_SUGGESTION_SIZE];
    char written[64];
    (void)snprintf(written, sizeof written, "%.*s", (int)strcspn(word, "="), word);
    const char *meant = word[1] == '-' && find_long(table, "set", 3) ? parameter_named(written + 2) : NULL;
    if (meant)
        return fail(error, FST_BAD_INPUT, "", "unknown option %s; a parameter is set by --set %s=VALUE",
                    written, meant);
    for (; table->name; ++table) {
        size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "|--%s", table->name);
    }
    return fail(error, FST_BAD_INPUT, "", "unknown option %s; %s", written,
                fst_suggest_name(written, names, suggestion));
}

/* Whether `word` is an option of the table: then it is not the value of another one. */
static int is_option(const option *table, const char *word)
{
    if (word[0] != '-')
        return 0;
    if (word[1] == '-')
        return find_long(table, word + 2, strcspn(word + 2, "=")) != NULL;
    return word[1] && !word[2] && find_letter(table, word[1]) != NULL;
}

static fst_status keep_option(arguments *given, const option *row, const char *value, fst_error *error)
{
    const int may_repeat = strcmp(row->name, "over") == 0 || strcmp(row->name, "given") == 0 ||
                           (row->value && strcmp(row->value, "KEY=VALUE") == 0);
    if (!may_repeat && option_value(given, row->name))
        return fail(error, FST_BAD_INPUT, "", "--%s is given twice", row->name);
    if (given->option_count == OPTION_LIMIT)
        return fail(error, FST_BAD_INPUT, "", "there are more than %d options", OPTION_LIMIT);
    given->options[given->option_count++] = (given_option){row, value};
    return FST_OK;
}

/* Read the option words[*at], whose value is in the same word or in the next one; moves *at to its
 * last word. */
static fst_status read_option(const option *table, int count, char **words, int *at, arguments *given,
                              fst_error *error)
{
    const char *word = words[*at], *value = NULL;
    const option *row;
    if (word[1] == '-') {
        size_t length = strcspn(word + 2, "=");
        row = find_long(table, word + 2, length);
        if (word[2 + length] == '=')
            value = word + 2 + length + 1;
    } else {
        row = find_letter(table, word[1]);
        if (word[2])
            value = word + 2;
    }
    if (!row)
        return unknown_option(table, word, error);
    if (!row->value) {
        if (value)
            return fail(error, FST_BAD_INPUT, "", "--%s takes no value", row->name);
        return keep_option(given, row, "", error);
    }
    if (!value) {
        if (*at + 1 == count)
            return fail(error, FST_BAD_INPUT, "", "--%s needs a value: %s", row->name, row->value);
        value = words[++*at];
        if (is_option(table, value))
            return fail(error, FST_BAD_INPUT, "", "--%s needs a value (%s), but %s follows", row->name,
                        row->value, value);
    }
    return keep_option(given, row, value, error);
}

fst_status read_arguments(const option *table, int most_operands, int count, char **words, arguments *given,
                          fst_error *error)
{
    given->option_count = 0;
    given->operand_count = 0;
    int only_operands = 0;
    for (int at = 0; at < count; ++at) {
        const char *word = words[at];
        fst_status status = FST_OK;
        if (!only_operands && strcmp(word, "--") == 0)
            only_operands = 1;
        else if (!only_operands && word[0] == '-' && word[1])
            status = read_option(table, count, words, &at, given, error);
        else if (given->operand_count < most_operands)
            given->operands[given->operand_count++] = word;
        else
            status = fail(error, FST_BAD_INPUT, "", "unexpected argument \"%.60s\"", word);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}

const char *option_value(const arguments *given, const char *name)
{
    for (int i = 0; i < given->option_count; ++i)
        if (strcmp(given->options[i].row->name, name) == 0)
            return given->options[i].value;
    return NULL;
}

const char *operand(const arguments *given)
{
    return given->operand_count ? given->operands[0] : NULL;
}
