/* help.c - the greeting, the list of commands, and the help of each. */
#include "cli/help.h"

#include <string.h>

#include "cli/completion.h"

void print_greeting(FILE *out)
{
    (void)fprintf(
        out,
        "festoon %s - what a magnetic bead does on a magnetic stirrer\n\n"
        "Three commands to begin with:\n\n"
        "  festoon run --set \"drive.frequency=642 rpm\" -o bead.h5   what does the bead do at this speed?\n"
        "  festoon plot bead.h5 -o path.png                         its path, as a picture\n"
        "  festoon init my-bead.yaml                                a commented scene for a bead of your "
        "own\n\n"
        "festoon --help lists all commands, festoon COMMAND --help the options of one, man festoon "
        "everything.\n",
        fst_version());
}

static void print_help(FILE *out)
{
    (void)fprintf(out,
                  "festoon %s - a magnetic bead on a magnetic stirrer\n\n"
                  "usage: festoon COMMAND [SCENE.yaml] [--set KEY=VALUE]... [options]\n\n",
                  fst_version());
    for (const command *const *row = all_commands; *row; ++row)
        (void)fprintf(out, "  %-8s %s\n", (*row)->name, (*row)->summary);
    (void)fprintf(
        out,
        "\nWithout a scene: the bead of Farago et al. (2020) at 10.7 Hz; - reads a scene from standard input.\n"
        "festoon COMMAND --help tells more; festoon --version lists the optional parts of this build;\n"
        "festoon completion bash|zsh|fish prints what lets a shell complete these words.\n\n"
        "Status: 0 done; 1 the computation failed; 2 bad usage, scene or input file; 130 interrupted.\n");
}

/* Print words, those that do not fit below the first; the first line has begun and is `column` letters long. */
static void print_wrapped(FILE *out, const char *text, int column, int indent)
{
    enum { WIDTH = 110 };
    for (int first = 1; *text; first = 0) {
        const int length = (int)strcspn(text, " \n");
        if (!first && column + 1 + length > WIDTH) {
            (void)fprintf(out, "\n%*s", indent, "");
            column = indent;
        } else if (!first) {
            (void)fputc(' ', out);
            ++column;
        }
        (void)fprintf(out, "%.*s", length, text);
        column += length;
        text += length;
        text += strspn(text, " \n");
    }
    (void)fputc('\n', out);
}

/* Print the rows of a table that only experts need, or the others. */
static void print_options(FILE *out, const option *row, int expert)
{
    enum { OPTION_COLUMN = 31 };
    for (; row->name; ++row) {
        char words[128];
        const int has_letter = row->letter > EXPERT;
        if ((row->letter == EXPERT) != expert)
            continue;
        (void)snprintf(words, sizeof words, "%s%c%s--%s %s", has_letter ? "-" : "",
                       has_letter ? row->letter : ' ', has_letter ? ", " : "", row->name,
                       row->value ? row->value : "");
        if (strlen(words) > 28)
            (void)fprintf(out, "  %s\n  %-28s ", words, "");
        else
            (void)fprintf(out, "  %-28s ", words);
        print_wrapped(out, row->help, OPTION_COLUMN, OPTION_COLUMN);
    }
}

void print_command_help(FILE *out, const command *shown)
{
    const int named = fprintf(out, "usage: festoon %s ", shown->name);
    print_wrapped(out, shown->synopsis, named, (int)strlen("usage: festoon "));
    (void)fprintf(out, "\n%s.\n", shown->summary);
    if (shown->details[0])
        (void)fprintf(out, "\n%s", shown->details);
    (void)fputs("\noptions:\n", out);
    print_options(out, shown->options, 0);
    print_options(out, common_options, 0);
    const option *row = shown->options;
    while (row->name && row->letter != EXPERT)
        ++row;
    if (row->name)
        (void)fputs("\nexpert:\n", out);
    print_options(out, row, 1);
}

fst_status unknown_command(const char *name, fst_error *error)
{
    char names[512] = "help|completion|--help|--version", suggestion[FST_SUGGESTION_SIZE];
    for (const command *const *row = all_commands; *row; ++row) {
        size_t used = strlen(names);
        (void)snprintf(names + used, sizeof names - used, "|%s", (*row)->name);
    }
    return fail(error, FST_BAD_INPUT, "", "unknown command \"%.60s\"; %s", name,
                fst_suggest_name(name, names, suggestion));
}

fst_status help(int count, char **words, FILE *out, fst_error *error)
{
    if (count > 0 && strcmp(words[0], "completion") == 0)
        return print_completion(1, (char *[]){"--help"}, out, error);
    if (count == 0 || strcmp(words[0], "help") == 0) {
        print_help(out);
        return FST_OK;
    }
    const command *shown = find_command(words[0]);
    if (!shown)
        return unknown_command(words[0], error);
    print_command_help(out, shown);
    return FST_OK;
}
