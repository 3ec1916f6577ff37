/* gnuplot.h - running gnuplot as a process. */
#ifndef FST_DRAW_GNUPLOT_H
#define FST_DRAW_GNUPLOT_H

#include <festoon/festoon_tools.h>

#include <stdio.h>

/* Write `text` as a gnuplot string.  Within single quotes gnuplot replaces and runs nothing; a quote is
 * doubled, or joined as a string of its own.  A line end would end the string, so each control character becomes '?'.  Every text that does not
 * stand in this program's sources must reach gnuplot through this function. */
void fst_gnuplot_quote(fst_printed *printed, const char *text);

/* Run gnuplot in `directory` on the file `script` there.  Its variable `data` becomes the name of the data
 * file.  The figure comes back through a pipe and is written to `figure` here: gnuplot itself would not tell of
 * a full disk.  No shell is involved, the user's start-up files are not read, and a gnuplot that does not end
 * is ended after a minute.  FST_UNAVAILABLE: there is no gnuplot; FST_IO: it failed, and the sentence quotes
 * it. */
fst_status fst_gnuplot_run(const char *directory, const char *script, const char *data, FILE *figure,
                           fst_error *error);

#endif
