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

/* Write the poles, turned by `angle` (rad), as the blocks 'north' and 'south' of a figure; returns which there
 * are, bits 1 and 2.  fst_figure_plot_poles() then plots their outlines, each clause ended by a comma. */
int fst_figure_write_poles(fst_figure_file *figure, const fst_magnet_body *bodies, int count, double angle);
void fst_figure_plot_poles(FILE *script, int which);

/* The key to these lines; `where` they are: "below the plate". */
void fst_legend_add_poles(fst_legend *legend, const fst_magnet_body *bodies, int count, const char *where);

#endif
