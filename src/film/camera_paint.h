/* camera_paint.h - what a camera over the plate sees, in gray levels.
 *
 *   scene x light --> still picture --> the bead, row by row at the time of that row --> flicker --> noise
 *
 * A row of a rolling shutter begins later than the row above it.  Over its exposure the bead moves: its picture
 * is the mean over some moments, which blurs it as in a film.
 */
#ifndef FST_FILM_CAMERA_PAINT_H
#define FST_FILM_CAMERA_PAINT_H

#include "film/camera_view.h"
#include "film/marks.h"

#include <festoon/festoon_tools.h>

/* Where the bead is: columns of a trajectory, between whose rows cubic curves go. */
typedef struct fst_camera_motion {
    const double *t, *x, *y, *z, *vx, *vy, *vz; /* scaled, as the trajectory has them; NULL: no heights */
    size_t rows;
    double bead;                 /* radius, mm */
    double second, millimetre;   /* what the units of t and x are worth */
    size_t row;                  /* where the last look was */
    const fst_film_marks *marks; /* NULL: none */
} fst_camera_motion;

/* The place of the centre at a moment, in mm. */
void fst_camera_motion_at(fst_camera_motion *motion, double seconds, double place[3]);

typedef struct fst_camera_paint {
    fst_camera_view view;
    int width, height;
    double plate;             /* radius, mm */
    double marks;             /* half the side of the square at whose corners marks are printed, mm */
    double exposure, readout; /* s */
    double noise, flicker, uneven;
    uint64_t seed;
    float *still; /* the picture without a bead, in gray levels */
    float *row;   /* room for a row of a frame */
} fst_camera_paint;

/* Paint the still picture; `paint` has its other members.  FST_NO_MEMORY. */
fst_status fst_camera_paint_begin(fst_camera_paint *paint, fst_error *error);
void fst_camera_paint_end(fst_camera_paint *paint);

/* Paint the frame number `index` of so many beads, which begins at a moment of their motions. */
void fst_camera_paint_frame(const fst_camera_paint *paint, fst_camera_motion *motions, int count,
                            double seconds, uint64_t index, unsigned char *pixels);

/* Where the bead was on the mean over the exposure of the row on which it is seen: its place in mm, and column
 * and row. */
void fst_camera_paint_truth(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds,
                            double place[3], double seen[2]);

/* How the bead turns in the middle of the exposure of the row `seen[1]`: n, its angular velocity (rad/s), and the velocity
 * of its lowest point (mm/s). */
void fst_camera_paint_turning(const fst_camera_paint *paint, fst_camera_motion *motion, double seconds,
                              const double seen[2], double n[3], double w[3], double slip[2]);

#endif
