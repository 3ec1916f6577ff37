/* rim.h - the edge of the plate in the still picture. */
#ifndef FST_FOLLOW_RIM_H
#define FST_FOLLOW_RIM_H

#include <festoon/film_tracks.h>

#include "follow/plane.h"
#include "follow/still.h"

/* Ellipses along which the picture has an edge, the steepest first, and which one is the plate's. */
typedef struct follow_rim {
    follow_ellipse ellipses[FST_PLATE_EDGES];
    fst_plate_edge edges[FST_PLATE_EDGES]; /* what is told of each */
    int count, taken;
} follow_rim;

/* Find the ellipse that the edge of a round plate is seen as: around a middle, and farther from it than
 * `within` pixels.  A ring printed on the plate is one too, so the outermost edge is taken that is not faint beside the
 * steepest.  FST_BAD_INPUT: there is none. */
fst_status follow_rim_find(const follow_still *still, const char *path, const double middle[2], double within,
                           follow_rim *rim, fst_error *error);

#endif
