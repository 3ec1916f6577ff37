/* view.h - from where the camera sees the bead.
 *
 * A point of the bead's front is seen at (right, up) from its centre, in radii, and is sqrt(1 - right^2 - up^2) nearer
 * to the camera.  The three directions are those of the line of sight, which turns as the bead goes round: off the
 * middle of the picture the camera sees a bead from the side.
 */
#ifndef FST_FOLLOW_VIEW_H
#define FST_FOLLOW_VIEW_H

#include "follow/plane.h"

/* A pinhole camera.  The laboratory has x to the right and y up in the picture, z towards the camera, and z = 0 where
 * the centre of the bead moves. */
typedef struct follow_camera {
    double axes[3][3]; /* rows: to the right, down and ahead in the laboratory */
    double place[3];   /* of the pinhole, mm */
    double focal;      /* pixels */
    double middle[2];  /* of the picture */
} follow_camera;

/* The camera that sees a plane in this way from `distance` (mm).  Returns 0 where there is none. */
int follow_camera_find(const follow_plane *plane, int width, int height, double distance,
                       follow_camera *camera);

/* The directions in which the bead at a pixel is seen, as columns: to the right, up, and to the camera.  Returns the
 * radius, in pixels, of a bead of `radius` (mm) there. */
double follow_camera_view(const follow_camera *camera, double column, double row, double radius,
                          double view[3][3]);

#endif
