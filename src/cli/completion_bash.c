/* completion_bash.c - the script for bash.
 *
 * It needs bash 4 and nothing else.  All words that it offers stand in it; names of files come from compgen -f
 * and are compared, quoted by readline and never evaluated.  Readline breaks words at "=", so the script joins
 * them again.
 */
#include <string.h>

#include "cli/completion_words.h"

static const char head[] =
    "# bash completion for festoon, made by: festoon completion bash\n"
    "\n"
    "# Offer those of the words that begin with $1; $2 goes before each.\n"
    "_festoon_words() {\n"
    "    local start=$1 lead=$2 word\n"
    "    shift 2\n"
    "    for word; do\n"
    "        [[ $word == \"$start\"* ]] && COMPREPLY+=(\"$lead$word\")\n"
    "    done\n"
    "}\n"
    "\n"
    "# The same for the last word of a list with commas.\n"
    "_festoon_list() {\n"
    "    local list=$1 lead=$2\n"
    "    shift 2\n"
    "    compopt -o nospace 2>/dev/null\n"
    "    _festoon_words \"${list##*,}\" \"$lead${list%\"${list##*,}\"}\" \"$@\"\n"
    "}\n"
    "\n"
    "# Offer directories, and files that have one of the endings behind $1 (any file where there are none).\n"
    "_festoon_files() {\n"
    "    local start=$1 file ending\n"
    "    local -a found\n"
    "    shift\n"
    "    compopt -o filenames 2>/dev/null\n"
    "    mapfile -t found < <(compgen -f -- \"$start\")\n"
    "    for file in \"${found[@]}\"; do\n"
    "        if (( $# == 0 )) || [[ -d ${file/#\\~\\//$HOME/} ]]; then\n"
    "            COMPREPLY+=(\"$file\")\n"
    "            continue\n"
    "        fi\n"
    "        for ending; do\n"
    "            [[ $file == *.\"$ending\" ]] && COMPREPLY+=(\"$file\")\n"
    "        done\n"
    "    done\n"
    "}\n"
    "\n";

static const char body[] =
    "_festoon() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} at=$COMP_CWORD word option value\n"
    "    COMPREPLY=()\n"
    "    if (( COMP_CWORD == 1 )); then\n"
    "        _festoon_words \"$current\" '' $_festoon_commands\n"
    "        return\n"
    "    fi\n"
    "    # Join what readline broke at \"=\".\n"
    "    word=$current\n"
    "    while (( at > 2 )) && [[ ${COMP_WORDS[at]} == = || ${COMP_WORDS[at-1]} == = ]]; do\n"
    "        at=$((at - 1))\n"
    "        word=${COMP_WORDS[at]}$word\n"
    "    done\n"
    "    [[ $current == = ]] && current=\n"
    "    if [[ $word == --*=* ]]; then\n"
    "        option=${word%%=*} value=${word#*=}\n"
    "    else\n"
    "        option=${COMP_WORDS[at-1]} value=$word\n"
    "    fi\n"
    "    # The rest of the value behind its last \"=\", and what of the present word stands before it.\n"
    "    local rest=${value##*=} lead\n"
    "    lead=${current%\"$rest\"}\n";

/* One line of a case: the words of an option in a command. */
static void print_pattern(FILE *out, const command *shown, const option *row)
{
    (void)fprintf(out, "    '%s --%s'", shown->name, row->name);
    if (row->letter)
        (void)fprintf(out, "|'%s -%c'", shown->name, row->letter);
    (void)fputs(") ", out);
}

static void print_value(FILE *out, const option *row)
{
    char endings[64];
    switch (kind_of_value(row)) {
    case VALUE_CHOICE:
        (void)fputs("_festoon_words \"$rest\" \"$lead\"", out);
        print_words(out, row->value, " ", "");
        break;
    case VALUE_SETTING:
        (void)fputs("_festoon_setting \"$value\" \"$rest\" \"$lead\"", out);
        break;
    case VALUE_KEY:
        (void)fputs("_festoon_key \"$value\" \"$lead\"", out);
        break;
    case VALUE_KEYS:
        (void)fputs("_festoon_list \"$rest\" \"$lead\" \"${_festoon_keys[@]%=}\"", out);
        break;
    case VALUE_RESULTS:
        (void)fputs("_festoon_list \"$rest\" \"$lead\" $_festoon_results", out);
        break;
    case VALUE_COLUMN:
        (void)fputs("_festoon_words \"$rest\" \"$lead\" $_festoon_columns", out);
        break;
    case VALUE_FILE:
        (void)fputs("_festoon_files \"$rest\"", out);
        print_words(out, file_endings(row->value, endings), " ", "");
        break;
    default:
        (void)fputs(":", out);
        break;
    }
    (void)fputs("; return ;;\n", out);
}

/* Parameters, and the choices of the parameters that have some. */
static void print_settings(FILE *out)
{
    (void)fputs("_festoon_key() {\n"
                "    [[ $1 == *=* ]] && return\n"
                "    compopt -o nospace 2>/dev/null\n"
                "    _festoon_words \"$1\" \"$2\" \"${_festoon_keys[@]}\"\n"
                "}\n\n"
                "# $1: all of KEY=VALUE; $2: what is typed of the value; $3: what goes before it.\n"
                "_festoon_setting() {\n"
                "    case $1 in\n",
                out);
    for (int i = 0; offered_param(i); ++i)
        if (offered_param(i)->kind == FST_KIND_CHOICE) {
            (void)fprintf(out, "    '%s='*) _festoon_words \"$2\" \"$3\"", offered_param(i)->key);
            print_words(out, offered_param(i)->names, " ", "");
            (void)fputs(" ;;\n", out);
        }
    (void)fputs("    *) _festoon_key \"$1\" \"$3\" ;;\n"
                "    esac\n"
                "}\n\n",
                out);
}

void print_bash(FILE *out)
{
    char endings[64];
    (void)fputs(head, out);
    (void)fputs("_festoon_commands='", out);
    for (const command *const *row = all_commands; *row; ++row)
        (void)fprintf(out, "%s ", (*row)->name);
    (void)fputs("help completion --help --version'\n_festoon_keys=(", out);
    print_keys(out, " '", "='");
    (void)fputs(")\n_festoon_results='", out);
    print_results(out, "", " ");
    (void)fputs("'\n_festoon_columns='", out);
    print_columns(out, "", " ");
    (void)fputs("'\n\n", out);
    print_settings(out);
    (void)fputs(body, out);
    (void)fputs("    case \"${COMP_WORDS[1]} $option\" in\n", out);
    for (const command *const *row = all_commands; *row; ++row)
        for (const option *o = (*row)->options; o->name; ++o)
            if (o->value) {
                print_pattern(out, *row, o);
                print_value(out, o);
            }
    (void)fputs("    esac\n    case ${COMP_WORDS[1]} in\n", out);
    for (const command *const *row = all_commands; *row; ++row) {
        (void)fprintf(out, "    %s)\n        if [[ $word == -* ]]; then _festoon_words \"$word\" ''",
                      (*row)->name);
        for (const option *o = (*row)->options; o->name; ++o)
            (void)fprintf(out, " --%s", o->name);
        (void)fputs(" --help\n", out);
        if ((*row)->most_operands > 0) {
            (void)fputs("        else _festoon_files \"$word\"", out);
            print_words(out, file_endings((*row)->synopsis, endings), " ", "");
            (void)fputs("\n", out);
        }
        (void)fputs("        fi ;;\n", out);
    }
    (void)fputs("    help) _festoon_words \"$current\" '' $_festoon_commands ;;\n"
                "    completion) _festoon_words \"$current\" '' bash zsh fish ;;\n"
                "    esac\n"
                "}\n\n"
                "complete -F _festoon festoon\n",
                out);
}
