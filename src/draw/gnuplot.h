/* gnuplot.h - gnuplot, run as a process. */
#ifndef FST_DRAW_GNUPLOT_H
#define FST_DRAW_GNUPLOT_H

#include <festoon/festoon.h>

#include <stdio.h>

/* Write `text` as a gnuplot string: within single quotes nothing is replaced or run, and a quote is doubled.  A
 * line ends a string, so that no control character may pass: each becomes '?'.  Every text that is not written
 * out in this program's sources reaches gnuplot through here. */
void fst_gnuplot_quote(FILE *out, const char *text);

/* Run gnuplot in `directory` on the file `script` there.  Its variable `data` is set to the name of the data
 * file, and the figure goes into `figure`: gnuplot itself never opens a file for writing, because it would not
 * tell of a full disk.  No shell is involved, the user's gnuplot start-up files are not read, and a gnuplot
 * that does not end is ended after a minute. FST_UNAVAILABLE: no gnuplot on this machine; FST_IO: it failed,
 * and the sentence has its own words. */
fst_status fst_gnuplot_run(const char *directory, const char *script, const char *data, FILE *figure,
                           fst_error *error);

#endif
