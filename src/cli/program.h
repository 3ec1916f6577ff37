/* program.h - what festoon and the programs it starts have in common. */
#ifndef FST_CLI_PROGRAM_H
#define FST_CLI_PROGRAM_H

#include "cli/command.h"

/* Do the command whose name, or whose program's name, is words[0]: its help, or what the options behind it say.
 */
fst_status perform_command(const command *wanted, int count, char **words, FILE *out, fst_error *error);

/* Prepare the terminal, perform the words of main(), and pass the output on, or the error; returns the exit
 * status. `much_output`: the output may be larger than memory. */
int run_program(int count, char **words, int much_output,
                fst_status (*perform)(int count, char **words, FILE *out, fst_error *error));

#endif
