/* poles.h - the magnet as pictures show it: the bodies that it is made of, and which halves of them are north.
 */
#ifndef FST_DRAW_POLES_H
#define FST_DRAW_POLES_H

#include "draw/legend.h"

/* A body of the magnet.  `poles` are its outline seen from above in two pieces, north and south; one of them is
 * empty where the body is magnetised rather upwards or downwards than sideways. */
typedef struct fst_magnet_body {
    fst_part_shape seen;
    int pole_count[2];
    double poles[2][FST_OUTLINE_MOST + 2][2];
} fst_magnet_body;

/* The bodies of the magnet, with `unit` of them to a metre (1e3: in mm); lines of dipoles are shown as the bar
 * that they stand for, `over_lines` times as long.  Returns how many: 0 of a source that has no known shape. */
int fst_magnet_bodies(const fst_params *params, double unit, double over_lines,
                      fst_magnet_body bodies[FST_PARTS_MAX]);

/* The lines of a magnet that is not the bar of lines: the outlines of its poles, or of a measured field the places
 * where it stands up most.  `length` makes l, they are turned by `angle` (rad), and `where` they are ends the words
 * of the key: "below the plate".  0: no memory; it hangs on `memory` (fst_keep()). */
int fst_magnet_lines(const fst_params *params, double length, double angle, const char *where,
                     fst_picture_line lines[FST_PICTURE_LINES], int *count, void **memory);
/* The outline of the bar's lines, and the lines themselves. */
int fst_magnet_outline(const fst_params *params, double length, double angle, const char *words,
                       fst_picture_line *line, void **memory);
int fst_magnet_rows(const fst_groups *groups, double length, const char *words, fst_picture_line *line,
                    void **memory);

/* Write such lines as data, plot them (each clause ended by a comma), and add them to the key. */
void fst_figure_write_lines(fst_figure_file *figure, const fst_picture_line *lines, int count);
void fst_figure_plot_lines(FILE *script, const fst_picture_line *lines, int count);
void fst_legend_add_lines(fst_legend *legend, const fst_picture_line *lines, int count);

#endif
