/* path_stages.h - the stages of a step that approximate the trajectory well: those that carry weight in the
 * step and in its dense output, 1 and 6 to 13, in the order of their nodes.
 */
#ifndef FST_ODE_PATH_STAGES_H
#define FST_ODE_PATH_STAGES_H

enum { FST_PATH_STAGES = 9 };
static const int FST_PATH_STAGE[FST_PATH_STAGES] = {0, 6, 7, 5, 9, 8, 10, 11, 12};

/* What the greatest value at these stages may at most be exceeded by between them, over its fall to the
 * neighbours: 2.4 for a parabola (fst_quadrature_track), and some more. */
#define EXTREME_MARGIN 3.0

#endif
