/* rim.h - the edge of the plate in the still picture. */
#ifndef FST_TRACK_RIM_H
#define FST_TRACK_RIM_H

#include "track/plane.h"
#include "track/still.h"

/* Find the ellipse that the edge of a round plate is seen as: around a middle, and farther from it than
 * `within` pixels.  *error_px becomes the deviation of the edge from it.  FST_BAD_INPUT: there is none. */
fst_status track_rim_find(const track_still *still, const char *path, const double middle[2], double within,
                          track_ellipse *rim, double *error_px, fst_error *error);

#endif
