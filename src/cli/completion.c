/* completion.c - festoon completion: a script for a shell.
 *
 * The scripts know no word of festoon: they ask the program (offer_words()), and hand its answer to the shell.
 * Nothing that was typed, and no name of a file, is ever evaluated.
 */
#include "cli/completion.h"

#include <string.h>

/* It needs bash 4.  Readline breaks words at "=", so the script joins them again. */
static const char bash[] =
    "# bash completion for festoon, made by: festoon completion bash\n"
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
    "\n"
    "_festoon() {\n"
    "    local current=${COMP_WORDS[COMP_CWORD]} at=$COMP_CWORD word kind offer\n"
    "    local -a offers endings\n"
    "    COMPREPLY=()\n"
    "    # Join what readline broke at \"=\".\n"
    "    word=$current\n"
    "    while (( at > 2 )) && [[ ${COMP_WORDS[at]} == = || ${COMP_WORDS[at-1]} == = ]]; do\n"
    "        at=$((at - 1))\n"
    "        word=${COMP_WORDS[at]}$word\n"
    "    done\n"
    "    [[ $current == = ]] && current=\n"
    "    mapfile -t offers < <(command festoon completion offer \"${COMP_WORDS[@]:1:at-1}\" \"$word\" "
    "2>/dev/null)\n"
    "    kind=${offers[0]}\n"
    "    if [[ $kind == 'files '* ]]; then\n"
    "        IFS='|' read -r -a endings <<< \"${kind#files }\"\n"
    "        _festoon_files \"${current##*=}\" \"${endings[@]}\"\n"
    "        return\n"
    "    fi\n"
    "    [[ $kind == open ]] && compopt -o nospace 2>/dev/null\n"
    "    for offer in \"${offers[@]:1}\"; do\n"
    "        offer=${offer%%$'\\t'*}\n"
    "        COMPREPLY+=(\"${offer#\"${word%\"$current\"}\"}\")\n"
    "    done\n"
    "}\n"
    "\n"
    "complete -F _festoon festoon\n";

static const char zsh[] =
    "#compdef festoon\n"
    "# zsh completion for festoon, made by: festoon completion zsh\n"
    "\n"
    "_festoon() {\n"
    "    local -a offers\n"
    "    local kind\n"
    "    # An empty list between quotes would be an empty word.\n"
    "    offers=(\"${(@f)$(command festoon completion offer ${words[2,CURRENT-1]} \"$PREFIX\" "
    "2>/dev/null)}\")\n"
    "    kind=$offers[1]\n"
    "    offers=(\"${(@)offers[2,-1]//:/\\\\:}\")\n"
    "    offers=(\"${(@)offers/$'\\t'/:}\")\n"
    "    case $kind in\n"
    "    'files ')\n"
    "        compset -P '--*='\n"
    "        _files ;;\n"
    "    files*)\n"
    "        compset -P '--*='\n"
    "        _files -g \"*.(${kind#files })(-.)\" ;;\n"
    "    open) _describe -t keys key offers -S '' ;;\n"
    "    words) _describe -t words word offers ;;\n"
    "    esac\n"
    "}\n"
    "\n"
    "if [ \"$funcstack[1]\" = _festoon ]; then\n    _festoon \"$@\"\nelse\n"
    "    compdef _festoon festoon\nfi\n";

static const char fish[] =
    "# fish completion for festoon, made by: festoon completion fish\n"
    "\n"
    "function __festoon_offer -d 'What the program offers for the word at the cursor'\n"
    "    set -l word (commandline -ct)\n"
    "    set -l before (commandline -opc)\n"
    "    set -l offers (command festoon completion offer $before[2..] \"$word\" 2>/dev/null)\n"
    "    if not string match -q 'files *' -- \"$offers[1]\"\n"
    "        printf '%s\\n' $offers[2..]\n"
    "        return\n"
    "    end\n"
    "    set -l lead (string match -r '^--[^=]*=' -- \"$word\")\n"
    "    set -l endings (string split -n '|' -- (string replace 'files ' '' -- $offers[1]))\n"
    "    set -l start (string replace -- \"$lead\" '' \"$word\")\n"
    "    for file in (__fish_complete_path $start)\n"
    "        set -l name (string split \\t -- $file)[1]\n"
    "        if test -z \"$endings\"; or string match -q '*/' -- $name\n"
    "            or contains -- (string replace -r '.*\\.' '' -- $name) $endings\n"
    "            echo \"$lead$name\"\n"
    "        end\n"
    "    end\n"
    "end\n"
    "\n"
    "complete -c festoon -f -a '(__festoon_offer)'\n";

fst_status print_completion(int count, char **words, FILE *out, fst_error *error)
{
    static const struct {
        const char *name, *script;
    } shells[] = {{"bash", bash}, {"zsh", zsh}, {"fish", fish}};
    for (size_t i = 0; count == 1 && i < sizeof shells / sizeof *shells; ++i)
        if (strcmp(words[0], shells[i].name) == 0) {
            (void)fputs(shells[i].script, out);
            return FST_OK;
        }
    if (count > 0 && strcmp(words[0], "offer") == 0) { /* the scripts ask this */
        offer_words(count - 1, words + 1, out);
        return FST_OK;
    }
    const int help = count == 1 && (strcmp(words[0], "--help") == 0 || strcmp(words[0], "-h") == 0);
    if (!help)
        return fail(error, FST_BAD_INPUT, "", "say for which shell: festoon completion bash, zsh or fish");
    (void)fputs(
        "usage: festoon completion bash|zsh|fish\n\n"
        "Print a script by which the shell completes commands, options, parameters and names of files.\n"
        "The script asks the festoon on your path what fits.\n\n"
        "make install puts it where the shell looks for it.  To try it in this shell alone:\n"
        "  bash:  source <(festoon completion bash)\n"
        "  zsh:   source <(festoon completion zsh)     (after compinit)\n"
        "  fish:  festoon completion fish | source\n",
        out);
    return FST_OK;
}
