/* completion.c - festoon completion: a script for a shell. */
#include "cli/completion.h"

#include <string.h>

#include "cli/completion_words.h"

fst_status print_completion(int count, char **words, FILE *out, fst_error *error)
{
    static const struct {
        const char *name;
        void (*print)(FILE *out);
    } shells[] = {{"bash", print_bash}, {"zsh", print_zsh}, {"fish", print_fish}};
    for (size_t i = 0; count == 1 && i < sizeof shells / sizeof *shells; ++i)
        if (strcmp(words[0], shells[i].name) == 0) {
            shells[i].print(out);
            return FST_OK;
        }
    const int help = count == 1 && (strcmp(words[0], "--help") == 0 || strcmp(words[0], "-h") == 0);
    if (!help)
        return fail(error, FST_BAD_INPUT, "", "say for which shell: festoon completion bash, zsh or fish");
    (void)fputs(
        "usage: festoon completion bash|zsh|fish\n\n"
        "Print a script by which the shell completes commands, options, parameters and names of files.\n\n"
        "make install puts it where the shell looks for it.  To try it in this shell alone:\n"
        "  bash:  source <(festoon completion bash)\n"
        "  zsh:   source <(festoon completion zsh)     (after compinit)\n"
        "  fish:  festoon completion fish | source\n",
        out);
    return FST_OK;
}
