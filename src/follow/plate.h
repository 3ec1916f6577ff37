/* plate.h - the plane of a plate whose edge is seen, perspective included. */
#ifndef FST_FOLLOW_PLATE_H
#define FST_FOLLOW_PLATE_H

#include "follow/plane.h"

/* The shortest focal length of a camera, in diagonals of its picture: 18 mm on a film of 43 mm. */
#define FOLLOW_SHORTEST_LENS 0.42

/* Places of the bead and how wide it looked there. */
typedef struct follow_sizes {
    double count, sum[3][3], right[3]; /* of the normal equations of width = p + q (column, row) */
    double squares;                    /* of the widths, summed */
    double middle[2];                  /* columns and rows count from here */
} follow_sizes;

void follow_sizes_add(follow_sizes *sizes, double column, double row, double width);

/* The horizon for follow_plane_of_circle(): how the bead's width changes over the picture, along the direction
 * in which the edge's ellipse is short.  A camera without tilt has none.  `spread`: a standard deviation of it. */
void follow_plate_horizon(const follow_sizes *sizes, const follow_ellipse *rim, int width, int height,
                          double horizon[2], double spread[2]);

#endif
