/* figure_branch.h - the curves of a bifurcation diagram, for other figures of a branch. */
#ifndef FST_DRAW_FIGURE_BRANCH_H
#define FST_DRAW_FIGURE_BRANCH_H

#include "draw/smooth.h"

/* An observable over the parameter, in the units of the file, as a smooth curve through the points of one stability
 * that reaches to the special points at its ends.  The chart owns it; returns 0 where there is no memory. */
int fst_branch_curve(fst_chart *chart, const fst_branch *b, const char *observable, int stable,
                     fst_columns *curve);

/* A curve with the title, the colour and the sign of a type of special points, and no points yet. */
fst_chart_curve fst_special_curve(fst_special_type type);

#endif
