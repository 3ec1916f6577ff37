/* help.h - what the program says of itself. */
#ifndef FST_CLI_HELP_H
#define FST_CLI_HELP_H

#include "cli/command.h"

/* What a person who types "festoon" alone reads: three commands to begin with. */
void print_greeting(FILE *out);

/* festoon help [COMMAND], of which `words` are those behind "help". */
fst_status help(int count, char **words, FILE *out, fst_error *error);
void print_command_help(FILE *out, const command *shown);

/* Fill in `error`: no command has this name. */
fst_status unknown_command(const char *name, fst_error *error);

#endif
