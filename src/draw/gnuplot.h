/* gnuplot.h - gnuplot, run as a process. */
#ifndef FST_DRAW_GNUPLOT_H
#define FST_DRAW_GNUPLOT_H

#include <festoon/festoon.h>

/* Run gnuplot in `directory` on the file `script` there, with its variable `figure` set to the file name that
 * it is to draw into.  No shell is involved, the user's gnuplot start-up files are not read,
 * and a gnuplot that does not end is ended after a minute.
 * FST_UNAVAILABLE: no gnuplot on this machine; FST_IO: it failed, and the sentence has its own words. */
fst_status fst_gnuplot_run(const char *directory, const char *script, const char *figure, fst_error *error);

#endif
