/* completion_zsh.c - the script for zsh, on its own _arguments and _files. */
#include <string.h>

#include "cli/completion_words.h"

/* What _arguments gives meaning in a description, and how an apostrophe stands in apostrophes. */
#define SPECIAL "[]:\\"
#define QUOTE "'\\''"

static void print_files(FILE *out, const char *name)
{
    char endings[64];
    (void)fputs("_files", out);
    if (file_endings(name, endings)[0])
        (void)fprintf(out, " -g \"*.(%s)(-.)\"", endings);
}

static void print_action(FILE *out, const option *row)
{
    (void)fputc(':', out);
    print_quoted(out, row->value, QUOTE, SPECIAL);
    (void)fputc(':', out);
    switch (kind_of_value(row)) {
    case VALUE_CHOICE:
        (void)fputs("(", out);
        print_words(out, row->value, "", " ");
        (void)fputs(")", out);
        break;
    case VALUE_SETTING:
        (void)fputs("_festoon_setting", out);
        break;
    case VALUE_KEY:
        (void)fputs("_festoon_key", out);
        break;
    case VALUE_KEYS:
        (void)fputs("_festoon_keys", out);
        break;
    case VALUE_RESULTS:
        (void)fputs("_festoon_results", out);
        break;
    case VALUE_COLUMN:
        (void)fputs("(", out);
        print_columns(out, "", " ");
        (void)fputs(")", out);
        break;
    case VALUE_FILE:
        print_files(out, row->value);
        break;
    default:
        (void)fputc(' ', out);
        break;
    }
}

static void print_option(FILE *out, const option *row)
{
    const int again = kind_of_value(row) == VALUE_SETTING || strcmp(row->name, "over") == 0;
    (void)fputs(" \\\n            ", out);
    if (row->letter)
        (void)fprintf(out, "'(-%c --%s)'{-%c,--%s%s}'[", row->letter, row->name, row->letter, row->name,
                      row->value ? "=" : "");
    else
        (void)fprintf(out, "'%s--%s%s[", again ? "*" : "", row->name, row->value ? "=" : "");
    print_quoted(out, row->help, QUOTE, SPECIAL);
    (void)fputc(']', out);
    if (row->value)
        print_action(out, row);
    (void)fputc('\'', out);
}

static void print_settings(FILE *out)
{
    (void)fputs("_festoon_key() {\n"
                "    compset -P '*=' || compadd -S = -q -- ",
                out);
    print_keys(out, "'", "' ");
    (void)fputs("\n}\n\n"
                "_festoon_keys() {\n"
                "    compset -P '*,'\n"
                "    compadd -S , -q -- ",
                out);
    print_keys(out, "'", "' ");
    (void)fputs("\n}\n\n"
                "_festoon_results() {\n"
                "    compset -P '*,'\n"
                "    compadd -S , -q -- ",
                out);
    print_results(out, "", " ");
    (void)fputs("\n}\n\n"
                "_festoon_setting() {\n"
                "    if ! compset -P '*='; then\n"
                "        _festoon_key\n"
                "        return\n"
                "    fi\n"
                "    case ${${IPREFIX%=}##*=} in\n",
                out);
    for (int i = 0; offered_param(i); ++i)
        if (offered_param(i)->kind == FST_KIND_CHOICE) {
            (void)fprintf(out, "    '%s') compadd --", offered_param(i)->key);
            print_words(out, offered_param(i)->names, " ", "");
            (void)fputs(" ;;\n", out);
        }
    (void)fputs("    esac\n}\n\n", out);
}

static void print_commands(FILE *out)
{
    (void)fputs("    local -a commands\n    commands=(\n", out);
    for (const command *const *row = all_commands; *row; ++row) {
        (void)fprintf(out, "        '%s:", (*row)->name);
        print_quoted(out, (*row)->summary, QUOTE, ":\\");
        (void)fputs("'\n", out);
    }
    (void)fputs("        'help:The help of a command'\n"
                "        'completion:What lets a shell complete these words'\n    )\n",
                out);
}

void print_zsh(FILE *out)
{
    (void)fputs("#compdef festoon\n# zsh completion for festoon, made by: festoon completion zsh\n\n", out);
    print_settings(out);
    (void)fputs("_festoon() {\n    local curcontext=$curcontext state line\n    typeset -A opt_args\n", out);
    print_commands(out);
    (void)fputs("    _arguments -C '(- *)--help[the list of commands]' '(- *)--version[version and optional "
                "parts]' \\\n"
                "        '1: :->command' '*:: :->rest' && return\n"
                "    case $state in\n"
                "    command) _describe -t commands command commands ;;\n"
                "    rest)\n"
                "        case $words[1] in\n",
                out);
    for (const command *const *row = all_commands; *row; ++row) {
        (void)fprintf(out, "        %s) _arguments -s", (*row)->name);
        for (const option *o = (*row)->options; o->name; ++o)
            print_option(out, o);
        (void)fputs(" \\\n            '(- *)--help[how to use it]'", out);
        if ((*row)->most_operands > 0) {
            (void)fputs(" \\\n            '::file:", out);
            print_files(out, (*row)->synopsis);
            (void)fputc('\'', out);
        }
        (void)fputs(" ;;\n", out);
    }
    (void)fputs("        help) _describe -t commands command commands ;;\n"
                "        completion) compadd -- bash zsh fish ;;\n"
                "        esac ;;\n"
                "    esac\n"
                "}\n\n"
                "if [ \"$funcstack[1]\" = _festoon ]; then\n    _festoon \"$@\"\nelse\n"
                "    compdef _festoon festoon\nfi\n",
                out);
}
