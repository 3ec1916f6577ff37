/* options.c - reading a command line by a table of options. */
#include "cli/options.h"

#include <stdio.h>
#include <string.h>

#include "cli/command.h"

const option common_options[] = {
    {"quiet", '\0', NULL, "no progress on standard error"},
    {"help", 'h', NULL, "the help of the command"},
    {NULL, '\0', NULL, NULL},
};

/* The names that options had before.  Scripts go on with them; who types one is told the new name.  What has no new
 * name is left aside. */
typedef struct old_name {
    const char *command, *old, *now;
    int draws_path; /* with it the path is drawn, of a ramp too */
} old_name;
static const old_name renamed[] = {
    {"plot", "key", "quantity", 0},   {"plot", "colour", "quantity", 1},  {"plot", "observable", "quantity", 0},
    {"export", "key", "quantity", 0}, {"movie", "colour", "quantity", 0}, {"field", "map", "quantity", 0},
    {"plot", "at", "only", 0},        {"measure", "track", "only", 0},    {"fit", "compare", "rivals", 0},
    {"run", "fps", "sample-rate", 0}, {"track", "picture", "figure", 0},  {"plot", "arrows", "", 1},
};

static const option gone = {"", '\0', NULL, NULL};

static int is_called(const char *word, const char *name, size_t length)
{
    return strlen(word) == length && memcmp(word, name, length) == 0;
}

static const option *find_in(const option *table, const char *name, size_t length)
{
    for (; table->name; ++table)
        if (is_called(table->name, name, length))
            return table;
    return NULL;
}

static const old_name *find_old(const command *of, const char *name, size_t length)
{
    for (size_t i = 0; i < sizeof renamed / sizeof *renamed; ++i)
        if (strcmp(renamed[i].command, of->name) == 0 && is_called(renamed[i].old, name, length))
            return &renamed[i];
    return NULL;
}

/* The row of a command for "--name", which may be its old name (length counts the name alone), or for "-o". */
static const option *find_long(const command *of, const char *name, size_t length)
{
    const option *row = find_in(of->options, name, length);
    if (!row)
        row = find_in(common_options, name, length);
    const old_name *before = row ? NULL : find_old(of, name, length);
    if (before)
        row = *before->now ? find_in(of->options, before->now, strlen(before->now)) : &gone;
    return row;
}

static const option *find_letter(const option *table, char letter)
{
    for (; table->name; ++table)
        if (table->letter > EXPERT && table->letter == letter)
            return table;
    return NULL;
}

/* Say that an option has another name now, or none. */
static void tell_of_new_name(const old_name *before, arguments *given)
{
    given->draws_path |= before->draws_path;
    (void)fprintf(stderr, "festoon %s: --%s ", before->command, before->old);
    if (*before->now)
        (void)fprintf(stderr, "is now --%s\n", before->now);
    else
        (void)fputs("has no effect any more\n", stderr);
}

/* The parameter that has this name without its group: who types --frequency means drive.frequency. */
static const char *parameter_named(const char *name)
{
    for (int i = 0; i < fst_param_count(); ++i)
        if (strcmp(strchr(fst_param_at(i)->key, '.') + 1, name) == 0)
            return fst_param_at(i)->key;
    return NULL;
}

static void list_names(const option *table, char *names, size_t size)
{
    for (; table->name; ++table) {
        const size_t used = strlen(names);
        (void)snprintf(names + used, size - used, "%s--%s", used ? "|" : "", table->name);
    }
}

/* What to type instead of an option that a command has not; capitals are no difference. */
static const char *suggest_option(const command *of, const char *word, char suggestion[FST_SUGGESTION_SIZE])
{
    char names[1024] = "", small[64];
    (void)snprintf(small, sizeof small, "%s", word);
    for (char *c = small; *c; ++c)
        *c = (char)(*c >= 'A' && *c <= 'Z' ? *c - 'A' + 'a' : *c);
    list_names(common_options, names, sizeof names);
    list_names(of->options, names, sizeof names);
    return fst_suggest_name(small, names, suggestion);
}

static fst_status unknown_option(const command *of, const char *word, fst_error *error)
{
    char suggestion[FST_SUGGESTION_SIZE];
    char written[64];
    (void)snprintf(written, sizeof written, "%.*s", (int)strcspn(word, "="), word);
    const char *meant = word[1] == '-' && find_long(of, "set", 3) ? parameter_named(written + 2) : NULL;
    if (meant)
        return fail(error, FST_BAD_INPUT, "", "unknown option %s; a parameter is set by --set %s=VALUE",
                    written, meant);
    return fail(error, FST_BAD_INPUT, "", "unknown option %s; %s", written,
                suggest_option(of, written, suggestion));
}

/* One argument too many; it may be an option without its dashes. */
static fst_status unexpected_argument(const command *of, const char *word, fst_error *error)
{
    char dashed[64], suggestion[FST_SUGGESTION_SIZE];
    (void)snprintf(dashed, sizeof dashed, "--%s", word);
    suggest_option(of, dashed, suggestion);
    const int is_near = strncmp(suggestion, "the nearest", strlen("the nearest")) == 0;
    return fail(error, FST_BAD_INPUT, "", "unexpected argument \"%.60s\"%s%s", word,
                is_near ? "; options begin with dashes: " : "", is_near ? suggestion : "");
}

const option *find_option(const command *of, const char *word)
{
    if (word[0] != '-')
        return NULL;
    if (word[1] == '-')
        return find_long(of, word + 2, strcspn(word + 2, "="));
    return word[1] && !word[2] ? find_letter(of->options, word[1]) : NULL;
}

static fst_status keep_option(arguments *given, const option *row, const char *value, fst_error *error)
{
    const int may_repeat = strcmp(row->name, "over") == 0 || strcmp(row->name, "given") == 0 ||
                           strcmp(row->name, "points") == 0 ||
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
static fst_status read_option(const command *of, int count, char **words, int *at, arguments *given,
                              fst_error *error)
{
    const char *word = words[*at], *value = NULL;
    const option *row;
    if (word[1] == '-') {
        size_t length = strcspn(word + 2, "=");
        row = find_long(of, word + 2, length);
        if (row && !is_called(row->name, word + 2, length))
            tell_of_new_name(find_old(of, word + 2, length), given);
        if (word[2 + length] == '=')
            value = word + 2 + length + 1;
    } else {
        row = find_letter(of->options, word[1]);
        if (word[2])
            value = word + 2;
    }
    if (!row)
        return unknown_option(of, word, error);
    if (row == &gone)
        return FST_OK;
    if (!row->value) {
        if (value)
            return fail(error, FST_BAD_INPUT, "", "--%s takes no value", row->name);
        return keep_option(given, row, "", error);
    }
    if (!value) {
        if (*at + 1 == count)
            return fail(error, FST_BAD_INPUT, "", "--%s needs a value: %s", row->name, row->value);
        value = words[++*at];
        if (find_option(of, value)) /* then it is not a value */
            return fail(error, FST_BAD_INPUT, "", "--%s needs a value (%s), but %s follows", row->name,
                        row->value, value);
        if (strcmp(row->value, "KEY=VALUE") == 0 && !strchr(value, '=') && *at + 1 < count &&
            words[*at + 1][0] == '-' && !find_option(of, words[*at + 1]))
            return fail(error, FST_BAD_INPUT, "", "a \"=\" is missing: --%s %s=%s", row->name, value,
                        words[*at + 1]);
    }
    return keep_option(given, row, value, error);
}

fst_status read_arguments(const command *of, int count, char **words, arguments *given, fst_error *error)
{
    given->option_count = given->operand_count = given->draws_path = 0;
    int only_operands = 0;
    for (int at = 0; at < count; ++at) {
        const char *word = words[at];
        fst_status status = FST_OK;
        if (!only_operands && strcmp(word, "--") == 0)
            only_operands = 1;
        else if (!only_operands && word[0] == '-' && word[1])
            status = read_option(of, count, words, &at, given, error);
        else if (given->operand_count < of->most_operands)
            given->operands[given->operand_count++] = word;
        else
            status = unexpected_argument(of, word, error);
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
