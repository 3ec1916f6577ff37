/* completion_words.h - what can stand on the command line, for the scripts of all shells. */
#ifndef FST_CLI_COMPLETION_WORDS_H
#define FST_CLI_COMPLETION_WORDS_H

#include "cli/command.h"

/* What completes the value of an option. */
typedef enum value_kind {
    VALUE_NONE,    /* it takes none */
    VALUE_FREE,    /* a number, or another text that nobody can guess */
    VALUE_CHOICE,  /* one of the words in option.value */
    VALUE_SETTING, /* a parameter, "=", and its choices if it has some */
    VALUE_KEY,     /* a parameter and "=" */
    VALUE_KEYS,    /* parameters, with commas between */
    VALUE_RESULTS, /* keys of festoon run, with commas between */
    VALUE_COLUMN,  /* a column of a trajectory */
    VALUE_FILE
} value_kind;

value_kind kind_of_value(const option *row);

/* Print what stands between the bars of "a|b|c", a word each: `before`, the word, `behind`. */
void print_words(FILE *out, const char *list, const char *before, const char *behind);

/* The parameters that are offered: all, and behind them those of a magnet's first part, which the others have
 * too. NULL behind the last. */
const fst_param_info *offered_param(int index);

/* The same for their keys, for the results of a run, and for the columns of a trajectory. */
void print_keys(FILE *out, const char *before, const char *behind);
void print_results(FILE *out, const char *before, const char *behind);
void print_columns(FILE *out, const char *before, const char *behind);

/* The endings of files in "[SCENE.yaml] ..." or "FILE.(h5|csv) ...", with bars between: "yaml", "h5|csv", or
 * "". */
const char *file_endings(const char *synopsis, char endings[64]);

/* Print a text between the marks of a string of the shell: `quote` is printed where an apostrophe stands in it,
 * and a backslash before each letter of `special`. */
void print_quoted(FILE *out, const char *text, const char *quote, const char *special);

/* The scripts. */
void print_bash(FILE *out);
void print_zsh(FILE *out);
void print_fish(FILE *out);

#endif
