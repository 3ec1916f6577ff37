/* options.h - reading a command line by a table. */
#ifndef FST_CLI_OPTIONS_H
#define FST_CLI_OPTIONS_H

#include <festoon/festoon.h>

/* One row of the table; a row without a name ends it. */
typedef struct option {
    const char *name; /* "json" for --json */
    char letter; /* 'o' for -o; '\0': none; EXPERT: none, and the help has it at its end, because few need it */
    const char *value; /* what its value is called in the help; NULL: it takes none */
    const char *help;
} option;
enum { EXPERT = 1 };

struct command;

/* The options that every command takes. */
extern const option common_options[];

#define OPTION_LIMIT 256 /* the most options that are accepted */
#define OPERAND_LIMIT 4096

typedef struct given_option {
    const option *row;
    const char *value; /* "" for an option without value */
} given_option;

typedef struct arguments {
    given_option options[OPTION_LIMIT];
    int option_count;
    const char *operands[OPERAND_LIMIT];
    int operand_count;
    int draws_path;          /* an option of before that asked for the path, whatever the trajectory holds */
    fst_bead_params **beads; /* of a scene that lists many, which are freed after the command */
    fst_field_map **map;     /* the map of the scene, which is freed after the command */
} arguments;

/* Read words[0..count) by the table of a command.  A value may begin with a minus.  Only --over, --given, --points and options of a
 * KEY=VALUE may be repeated.  A name that an option had before is taken, with a sentence on standard error.  FST_BAD_INPUT:
 * unknown option (the sentence names the nearest), missing or superfluous value, too many operands. */
fst_status read_arguments(const struct command *of, int count, char **words, arguments *given,
                          fst_error *error);

/* The row of a word that is an option of a command, "--name", "--name=..." or "-o"; NULL: it is none. */
const option *find_option(const struct command *of, const char *word);

/* The value of --name, "" for an option without value; NULL where it was not given. */
const char *option_value(const arguments *given, const char *name);

/* The first operand, or NULL. */
const char *operand(const arguments *given);

#endif
