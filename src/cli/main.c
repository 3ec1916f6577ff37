/* main.c - the program festoon: finding the command. */
#include <string.h>

#include "cli/command.h"
#include "cli/completion.h"
#include "cli/help.h"
#include "cli/program.h"

/* words[0] is the program's name. */
static fst_status perform(int count, char **words, FILE *out, fst_error *error)
{
    const char *first = count > 1 ? words[1] : NULL;
    if (!first) {
        print_greeting(out);
        return FST_OK;
    }
    if (strcmp(first, "--version") == 0) {
        char components[FST_COMPONENTS_SIZE];
        (void)fprintf(out, "festoon %s\n%s\n", fst_version(), fst_tools_components(components));
        return FST_OK;
    }
    if (strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
        return help(0, words, out, error);
    if (strcmp(first, "help") == 0)
        return help(count - 2, words + 2, out, error);
    if (strcmp(first, "completion") == 0)
        return print_completion(count - 2, words + 2, out, error);
    const command *wanted = find_command(first);
    return wanted ? perform_command(wanted, count - 1, words + 1, out, error) : unknown_command(first, error);
}

int main(int argc, char **argv)
{
    const command *wanted = argc > 1 ? find_command(argv[1]) : NULL;
    return run_program(argc, argv, wanted && wanted->much_output, perform);
}
