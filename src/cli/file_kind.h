/* file_kind.h - what a file is that was given to a command that takes no such file. */
#ifndef FST_CLI_FILE_KIND_H
#define FST_CLI_FILE_KIND_H

#include "cli/command.h"

/* A command found bad input in a file that was given to it.  Where that is a file of another kind than the command
 * takes, `error` tells instead what it is and which commands take it: what a trajectory lacks to be a scene helps
 * nobody. */
void tell_file_kind(const command *wanted, const arguments *given, fst_error *error);

#endif
