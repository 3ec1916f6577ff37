/* plane.h - from pixels to millimetres: what a person says of the scale, and the map that follows from it.
 *
 * All maps are homographies: they take straight lines to straight lines, as a pinhole camera does.  Pixels come
 * as column and row (down); places leave with x to the right and y up in the picture.
 */
#ifndef FST_FOLLOW_PLANE_H
#define FST_FOLLOW_PLANE_H

#include <festoon/film_tracks.h>

typedef enum {
    FOLLOW_SCALE_NONE,  /* pixels */
    FOLLOW_SCALE_BEAD,  /* the bead's diameter is known */
    FOLLOW_SCALE_PLATE, /* the plate's diameter is known, and its edge is seen */
    FOLLOW_SCALE_TWO,   /* the distance of two points is known */
    FOLLOW_SCALE_FOUR   /* four points are the corners of a known rectangle */
} follow_scale_kind;

/* What a person said. */
typedef struct follow_scale {
    follow_scale_kind kind;
    double length[2];    /* mm: the diameter, the distance, or the sides of the rectangle */
    double points[4][2]; /* column, row */
} follow_scale;

/* Read "bead 5 mm", "plate 460 mm", "X1,Y1:X2,Y2=50mm", "X1,Y1:X2,Y2:X3,Y3:X4,Y4=80mm" (a square) or
 * "...=80x60mm"; pixels count from the top left, as in viewers of pictures. */
fst_status follow_scale_read(const char *text, follow_scale *scale, fst_error *error);

/* Read some of them, between which stand semicolons, and keep their words in `told`; *count is 1 or more. */
fst_status follow_scales_read(const char *text, follow_scale scales[FST_FILM_SCALES],
                              fst_film_scale told[FST_FILM_SCALES], int *count, fst_error *error);

/* A homography: place = M (column, row, 1), divided by its third component. */
typedef struct follow_plane {
    double m[3][3];
} follow_plane;

void follow_plane_map(const follow_plane *plane, double column, double row, double *x, double *y);

/* mm (or whatever the plane has) that a pixel is at a place: the root of the area that it covers. */
double follow_plane_step(const follow_plane *plane, double column, double row);

/* The same in the direction in which a tilted plane is not foreshortened, as a ball is not. */
double follow_plane_least_step(const follow_plane *plane, double column, double row);

/* x = factor column, y = factor (last_row - row). */
follow_plane follow_plane_even(double factor, double last_row);

/* The plane in which four points are the corners of a rectangle around the origin, the first side from the
 * first to the second point; turned so that x points to the right in the picture.  FST_BAD_INPUT: they are no
 * corners of a rectangle seen from any side. */
fst_status follow_plane_of_rectangle(const follow_scale *scale, follow_plane *plane, fst_error *error);

/* The plane in which an ellipse with this centre, these semi-axes and this angle (rad) of the longer one is a
 * circle of `radius` around the origin, where the picture is first divided by 1 + horizon (pixel - centre): a
 * perspective. */
typedef struct follow_ellipse {
    double centre[2], axes[2], angle;
} follow_ellipse;
fst_status follow_plane_of_circle(const follow_ellipse *seen, const double horizon[2], double radius,
                                  follow_plane *plane, fst_error *error);

/* The ellipse nearest to points (pairs): a conic by least squares.  Returns 0 where they lie on no ellipse. */
int follow_ellipse_fit(const double *points, int count, follow_ellipse *ellipse);
/* A point of an ellipse, at a part of 2 pi from the end of its first axis. */
void follow_ellipse_point(const follow_ellipse *ellipse, double turn, double point[2]);

/* Solve n equations a x = b (a is n x n, by rows; both are changed); 0: they have no single solution. */
int follow_solve(double *a, double *b, int n);

#endif
