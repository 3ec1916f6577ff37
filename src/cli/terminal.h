/* terminal.h - the program and its terminal: signals, the progress line, standard output. */
#ifndef FST_CLI_TERMINAL_H
#define FST_CLI_TERMINAL_H

#include <stdio.h>

#include <festoon/festoon.h>

/* Prepare the standard streams and signals.  Call it before any file is opened. */
void terminal_prepare(void);

/* Between these calls a library that ends the program, or crashes, leaves a sentence and status 1. */
void terminal_work_begins(void);
void terminal_work_ends(void);

/* Whether SIGINT, SIGTERM or SIGHUP came. */
int interrupted(void);

/* Progress on standard error: one line that changes if that is a terminal, otherwise a line every half minute of work that
 * has taken a minute. */
typedef struct progress_line {
    double started, shown; /* s */
    int in_place;          /* it changes */
} progress_line;

/* No command that is begun from here on shows any. */
void progress_silence(void);

void progress_begin(progress_line *line);

/* Show `fraction`, the time left and `what` (may be NULL).  Once a signal came it returns FST_INTERRUPTED, with
 * `error` filled in; so a computation learns of the signal. */
fst_status progress_show(progress_line *line, double fraction, const char *what, fst_error *error);

/* The same where the time left does not follow from the fraction (INFINITY: it is unknown). */
fst_status progress_show_left(progress_line *line, double fraction, double seconds_left, const char *what,
                              fst_error *error);

/* progress_show() as the tell() of an fst_progress: `line` is a progress_line. */
fst_status progress_tell(void *line, double fraction, const char *what, fst_error *error);

/* Wipe the line that changes. */
void progress_end(progress_line *line);

/* Read standard input to its end, or `most` bytes of it.  Returns 0, or an errno; a signal ends it too. */
int read_standard_input(char *text, size_t most, size_t *size);

/* Write all of `text` to standard output.  Returns 0, or an errno. */
int write_standard_output(const char *text, size_t size);

/* Make a file without a name, for output that may not fit into memory, in $TMPDIR or /tmp; NULL: it cannot be
 * made.  The second function writes all of it to standard output, as above. */
FILE *spool_open(void);
int spool_to_standard_output(FILE *spool);

/* Standard output is written even if the command fails from here on: a table of several files says which failed. */
void output_keep(void);
int output_is_kept(void);

#endif
