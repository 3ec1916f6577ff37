/* figure_file.h - a figure being made: script and data grow in memory and become OUT.gp and OUT.dat, from which
 * gnuplot draws OUT.svg, OUT.pdf or OUT.png. */
#ifndef FST_DRAW_FIGURE_FILE_H
#define FST_DRAW_FIGURE_FILE_H

#include "base/number.h"

#include <festoon/festoon_tools.h>

#include <stdio.h>

typedef struct fst_figure_file {
    FILE *script, *data; /* gnuplot commands and data blocks are written into these */
    fst_printed script_text, data_text;
    int blocks;      /* how many blocks the data has */
    char *out;       /* the figure's path */
    char *directory; /* the figure's directory; "." where the path has none */
    char *stem;      /* its file name without the ending */
    char ending[4];  /* svg, pdf or png */
    fst_c_locale locale;
} fst_figure_file;

/* Start a figure of width x height pixels (at 96 an inch), in the format of the ending of `out`.  The script
 * then knows `data` (the data file), the terminal, and the house style.  Until fst_figure_finish() or
 * fst_figure_abandon() the calling thread's locale is "C", so that numbers are written with a point.
 * FST_BAD_INPUT: another ending, no file name, or a control character in it. */
fst_status fst_figure_begin(fst_figure_file *figure, const char *out, int width, int height, fst_error *error);

/* Begin the data block that scripts address by `data index 'NAME'`, with a line that names its columns. */
void fst_figure_block(fst_figure_file *figure, const char *name, const char *columns);

/* Write `text` into the script as a quoted gnuplot string that means exactly these characters. */
void fst_figure_quote(fst_figure_file *figure, const char *text);

/* Write script and data, draw, and put all files into their places.  Frees everything, also on failure. */
fst_status fst_figure_finish(fst_figure_file *figure, fst_error *error);
void fst_figure_abandon(fst_figure_file *figure);

#endif
