/* completion.h - how a shell completes the words of festoon. */
#ifndef FST_CLI_COMPLETION_H
#define FST_CLI_COMPLETION_H

#include "cli/command.h"

/* festoon completion bash|zsh|fish, of which `words` are those behind "completion". */
fst_status print_completion(int count, char **words, FILE *out, fst_error *error);

/* Say what can stand in the place of the last of the words, which stand behind the program's name and are never
 * obeyed.  The first line is "words", "open" (more follows each of them without a blank), or "files" with the
 * endings that they may have ("files h5|csv"; any, where there are none); each further line is a whole word
 * and, behind a tab, what it is.  Nothing at all where there is nothing to say. */
void offer_words(int count, char **words, FILE *out);

#endif
