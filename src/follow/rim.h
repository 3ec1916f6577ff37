/* rim.h - the edge of the plate in the still picture. */
#ifndef FST_FOLLOW_RIM_H
#define FST_FOLLOW_RIM_H

#include "follow/plane.h"
#include "follow/still.h"

/* Find the ellipse that the edge of a round plate is seen as: around a middle, and farther from it than
 * `within` pixels.  *error_px becomes the deviation of the edge from it.  FST_BAD_INPUT: there is none. */
fst_status follow_rim_find(const follow_still *still, const char *path, const double middle[2], double within,
                           follow_ellipse *rim, double *error_px, fst_error *error);

#endif
