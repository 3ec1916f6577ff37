/* legend.h - the words around a figure: its title above, and below it a key that never lies over data. */
#ifndef FST_DRAW_LEGEND_H
#define FST_DRAW_LEGEND_H

#include "draw/style.h"

enum { FST_LEGEND_ENTRIES = 32 };

/* What stands before an entry's words. */
typedef enum {
    FST_SAMPLE_NONE,
    FST_SAMPLE_LINE,
    FST_SAMPLE_POINT,
    FST_SAMPLE_LINE_POINT,
    FST_SAMPLE_BOX,
    FST_SAMPLE_ARROW
} fst_sample_kind;

typedef struct fst_legend_entry {
    fst_sample_kind sample;
    double length;   /* of an arrow, in pixels */
    char style[96];  /* gnuplot's words for it, "lc rgb '#0072b2' lw 2" */
    char words[384]; /* an underscore lowers the next letter */
} fst_legend_entry;

typedef struct fst_legend {
    char title
        [1024]; /* what the figure shows; free text, in which no letter is lowered and a line end ends a line */
    char about[512]; /* of what: "ω = 0.215 (10.7 Hz), dynamics rigid"; "": nothing */
    fst_legend_entry entries[FST_LEGEND_ENTRIES];
    int count;
} fst_legend;

/* Add an entry, unless the same one is there already (panels may share curves of one meaning). */
void fst_legend_add(fst_legend *legend, fst_sample_kind sample, const char *style, const char *words);

/* A text as words of a key in which no sign lowers or raises another: of a file's name, say. */
void fst_plain_words(const char *text, char *words, size_t size);

/* Heights in pixels of the title and of the key; 0 for an empty key. */
int fst_legend_head(const fst_legend *legend);
int fst_legend_foot(const fst_legend *legend);

/* Write both as the last panel of a figure that is `height` pixels high; the script must be within a multiplot.
 */
void fst_legend_write(fst_figure_file *figure, const fst_legend *legend, int height);

/* How many lines a text takes where a line has room for `pixels`. */
int fst_lines_of(const char *text, double pixels);

/* The label of an axis of a panel, in as many lines as it needs.  gnuplot's own labels move with the width of
 * the numbers, out of the figure too.  `frame`: left, right, top and bottom of the panel in pixels. */
typedef enum { FST_SIDE_BELOW, FST_SIDE_LEFT, FST_SIDE_RIGHT, FST_SIDE_ABOVE } fst_side;
void fst_figure_axis_label(fst_figure_file *figure, int height, fst_side side, const char *text,
                           fst_colour colour, const double frame[4]);

/* The scale of colours as a bar with this frame, its label below it. */
void fst_figure_colour_scale(fst_figure_file *figure, int height, const char *label, const double frame[4]);

/* Begin a multiplot whose panels are placed in pixels by fst_figure_place(). */
void fst_figure_panels(fst_figure_file *figure);

/* How far a place of the layout lies from the left edge, in parts of the whole width. */
double fst_figure_across(const fst_figure_file *figure, double pixels);

/* Place the next panel's frame: left, right, top and bottom in pixels from the figure's left and upper edges.
 */
void fst_figure_place(fst_figure_file *figure, int height, const double frame[4]);

#endif
