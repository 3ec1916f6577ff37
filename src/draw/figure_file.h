/* figure_file.h - a figure being made: script and data grow in memory and become OUT.gp and OUT.dat, from which
 * gnuplot draws OUT.svg, OUT.pdf or OUT.png. */
#ifndef FST_DRAW_FIGURE_FILE_H
#define FST_DRAW_FIGURE_FILE_H

#include "base/number.h"

#include <festoon/festoon_tools.h>

#include <stdio.h>

/* Every layout is this many pixels wide, so that its words can be read in a column of 86 mm and on a phone. */
enum { FST_FIGURE_WIDTH = 480 };

/* How a layout lies in the size that is wanted.  Its letters grow with the width. */
typedef struct fst_canvas {
    double millimetres[2]; /* the size that is wanted; 0: as usual, a pixel being 1/96 inch */
    int height;            /* of the layout, in its pixels */
    int more;              /* by how much its frames are higher than usual, all together */
    int pad;               /* what is free on its left and on its right */
} fst_canvas;

/* The canvas of a figure that usually is so many pixels high, and whose frames may lose the pixels `give`.  `size`:
 * width and height in m, 0 as usual; NULL: both are. */
fst_canvas fst_canvas_for(const double *size, int usual, int give);

typedef struct fst_figure_file {
    FILE *script, *data; /* gnuplot commands and data blocks are written into these */
    fst_printed script_text, data_text;
    int blocks;      /* how many blocks the data has */
    char *out;       /* the figure's path */
    char *directory; /* the figure's directory; "." where the path has none */
    char *stem;      /* its file name without the ending */
    char ending[4];  /* svg, pdf or png */
    fst_canvas canvas;
    fst_c_locale locale;
} fst_figure_file;

/* Start a figure on a canvas, in the format of the ending of `out`.  The script
 * then knows `data` (the data file), the terminal, and the house style.  Until fst_figure_finish() or
 * fst_figure_abandon() the calling thread's locale is "C", so that numbers are written with a point.
 * FST_BAD_INPUT: another ending, no file name, a control character in it, or no size for a figure. */
fst_status fst_figure_begin(fst_figure_file *figure, const char *out, const fst_canvas *canvas,
                            fst_error *error);

/* Write a scene into the script as comments, so that nothing of it is lost; NULL: none, or no memory for it. */
void fst_figure_scene(fst_figure_file *figure, const char *scene);

/* The same of parameters. */
void fst_figure_scene_of(fst_figure_file *figure, const fst_params *params);

/* Begin the data block that scripts address by `data index 'NAME'`, with a line that names its columns. */
void fst_figure_block(fst_figure_file *figure, const char *name, const char *columns);

/* Write `text` into the script as a quoted gnuplot string that means exactly these characters. */
void fst_figure_quote(fst_figure_file *figure, const char *text);

/* Write script and data, draw, and put all files into their places.  Frees everything, also on failure. */
fst_status fst_figure_finish(fst_figure_file *figure, fst_error *error);
void fst_figure_abandon(fst_figure_file *figure);

#endif
