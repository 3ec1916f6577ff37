/* completion_fish.c - the script for fish. */
#include <string.h>

#include "cli/completion_words.h"

static void print_description(FILE *out, const char *text)
{
    (void)fputs(" -d '", out);
    print_quoted(out, text, "\\'", "\\");
    (void)fputs("'\n", out);
}

/* KEY= of each parameter, or KEY=CHOICE. */
static void print_settings(FILE *out)
{
    for (int i = 0; offered_param(i); ++i) {
        const fst_param_info *info = offered_param(i);
        char before[64];
        (void)snprintf(before, sizeof before, " %s=", info->key);
        if (info->kind == FST_KIND_CHOICE)
            print_words(out, info->names, before, "");
        else
            (void)fputs(before, out);
    }
}

static void print_value(FILE *out, const option *row)
{
    const value_kind kind = kind_of_value(row);
    if (kind == VALUE_NONE)
        return;
    if (kind == VALUE_FILE) {
        (void)fputs(" -rF", out);
        return;
    }
    (void)fputs(" -x", out);
    if (kind == VALUE_FREE)
        return;
    (void)fputs(" -a '", out);
    if (kind == VALUE_CHOICE)
        print_words(out, row->value, " ", "");
    else if (kind == VALUE_SETTING)
        print_settings(out);
    else if (kind == VALUE_KEY)
        print_keys(out, " ", "=");
    else if (kind == VALUE_KEYS)
        print_keys(out, " ", "");
    else if (kind == VALUE_RESULTS)
        print_results(out, " ", "");
    else
        print_columns(out, " ", "");
    (void)fputc('\'', out);
}

static void print_operands(FILE *out, const command *shown)
{
    char endings[64];
    if (shown->most_operands == 0)
        return;
    (void)fprintf(out, "complete -c festoon -n '__festoon_command %s'", shown->name);
    if (!file_endings(shown->synopsis, endings)[0]) {
        (void)fputs(" -F\n", out);
        return;
    }
    (void)fputs(" -k -a '(__fish_complete_suffix", out);
    print_words(out, endings, " .", "");
    (void)fputs(")'\n", out);
}

void print_fish(FILE *out)
{
    (void)fputs("# fish completion for festoon, made by: festoon completion fish\n\n"
                "function __festoon_command -d 'Whether the command of this line is one of the arguments'\n"
                "    set -l words (commandline -opc)\n"
                "    test (count $words) -gt 1; and contains -- $words[2] $argv\n"
                "end\n\n"
                "function __festoon_first -d 'Whether the command is still to be typed'\n"
                "    test (count (commandline -opc)) -eq 1\n"
                "end\n\n"
                "complete -c festoon -f\n"
                "complete -c festoon -n __festoon_first -l help -d 'The list of commands'\n"
                "complete -c festoon -n __festoon_first -l version -d 'Version and optional parts'\n",
                out);
    for (const command *const *row = all_commands; *row; ++row) {
        (void)fprintf(out, "complete -c festoon -n '__festoon_first; or __festoon_command help' -a %s",
                      (*row)->name);
        print_description(out, (*row)->summary);
    }
    (void)fputs(
        "complete -c festoon -n __festoon_first -a completion -d 'What lets a shell complete these words'\n"
        "complete -c festoon -n '__festoon_command completion' -a 'bash zsh fish'\n",
        out);
    for (const command *const *row = all_commands; *row; ++row) {
        print_operands(out, *row);
        (void)fprintf(out, "complete -c festoon -n '__festoon_command %s' -l help -d 'How to use it'\n",
                      (*row)->name);
        for (const option *o = (*row)->options; o->name; ++o) {
            (void)fprintf(out, "complete -c festoon -n '__festoon_command %s' -l %s", (*row)->name, o->name);
            if (o->letter)
                (void)fprintf(out, " -s %c", o->letter);
            print_value(out, o);
            print_description(out, o->help);
        }
    }
}
