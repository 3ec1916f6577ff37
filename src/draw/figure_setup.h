/* figure_setup.h - figures of the experiment: the setup to scale, and the path as a camera sees it. */
#ifndef FST_DRAW_FIGURE_SETUP_H
#define FST_DRAW_FIGURE_SETUP_H

#include <festoon/festoon.h>

/* Plate, bead and magnet to scale, from above and from the side, and the angles of the moment (the paper's
 * Fig. 1). */
fst_status fst_figure_sketch(const fst_params *params, const char *out, fst_error *error);

/* The bead's path as a camera of 200 frames a second sees it: a point a frame, for two seconds (the paper's
 * Fig. 2).  `rows` samples of t (1/gamma), x and y (l). */
fst_status fst_figure_camera(const double *t, const double *x, const double *y, size_t rows,
                             const fst_params *params, const char *out, fst_error *error);

#endif
