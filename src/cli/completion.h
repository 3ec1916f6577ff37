/* completion.h - scripts by which a shell completes the words of festoon, made from the tables of options and
 * parameters. */
#ifndef FST_CLI_COMPLETION_H
#define FST_CLI_COMPLETION_H

#include "cli/command.h"

/* festoon completion bash|zsh|fish, of which `words` are those behind "completion". */
fst_status print_completion(int count, char **words, FILE *out, fst_error *error);

#endif
