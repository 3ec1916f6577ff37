/* camera_view.h - a pinhole camera over the plate: where a place is seen, and what a pixel sees.
 *
 * Lengths are in mm; the plate is z = 0 with the axis of rotation in its middle.  Pixels are counted as tables
 * of them are: (0, 0) is the centre of the first pixel at the top left, columns go right and rows go down.
 */
#ifndef FST_FILM_CAMERA_VIEW_H
#define FST_FILM_CAMERA_VIEW_H

typedef struct fst_camera_view {
    double place[3];                  /* of the pinhole */
    double right[3], up[3], ahead[3]; /* unit vectors */
    double focal;                     /* pixels */
    double middle[2];                 /* column and row that the axis of the camera meets */
} fst_camera_view;

/* A camera of width x height pixels that looks at the middle of the plate from `distance`, `tilt` (rad) off the
 * vertical, standing at the polar angle `side`.  A disc of radius `reach` around the middle just fits a camera
 * that is not tilted. */
fst_camera_view fst_camera_view_make(int width, int height, double distance, double tilt, double side,
                                     double reach);

/* Where a place is seen: seen[0] the column, seen[1] the row. */
void fst_camera_view_project(const fst_camera_view *view, const double place[3], double seen[2]);

/* The direction into which a pixel looks, a unit vector. */
void fst_camera_view_ray(const fst_camera_view *view, double column, double row, double direction[3]);

#endif
