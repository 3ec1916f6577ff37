/* turning.h - how the bead turns, by the marks on it.
 *
 *   frame --> patch.c    the bead's face, point by point          turning.c    the rotation in each frame, against the
 *             in room for 600 bytes a frame                  -->               surface that all frames show together
 *                                                                --> spin.c    n, W and slip, by its neighbours too
 *
 * What a point of the face sends back is
 *
 *   level = gain (even + marked a),      a = surface(where on the bead the point is)
 *
 * where `even` and `marked` belong to the point of the face: lamps and highlights do not turn with the bead.  All of
 * it is learnt from the film.
 */
#ifndef FST_FOLLOW_TURNING_H
#define FST_FOLLOW_TURNING_H

#include "follow/bead.h"
#include "follow/sphere.h"
#include "follow/view.h"

#include <festoon/festoon_tools.h>

enum { FOLLOW_FACE = 35, FOLLOW_MOST_POINTS = FOLLOW_FACE * FOLLOW_FACE };

#define FOLLOW_PER_RADIUS 13.0 /* points */

/* A rotation of the bead, the brightness of the face, and how badly both explain it: the mean square of what is left,
 * outliers cut off. */
typedef struct follow_pose {
    double turn[3][3], gain, misfit;
} follow_pose;

/* A frame in which the bead was seen. */
typedef struct follow_turn {
    int frame, good;    /* its number; whether its rotation is known */
    double time;        /* s */
    double column, row; /* pixels */
    double bright;      /* gray levels of the plate behind the bead */
    double place[2];    /* mm */
    double view[3][3];  /* right, up, to the camera */
    double close;       /* the radius of the bead over its distance from the camera */
    double shrink;      /* radii of the bead there that a radius of the patch is */
    double shift[2];    /* of its centre, to the right and up from that of the patch, in radii of the patch */
    follow_pose pose;
    double step[3][3];     /* the turning since the frame before, by what repeats itself */
    double expected[3][3]; /* the rotation that its neighbours expect, */
    double trust;          /* and how surely: the inverse of the variance of a component (1/rad^2); 0: none */
    double known[3][3];    /* the inverse of the covariance of its rotation vector, from this frame alone */
} follow_turn;

typedef struct follow_turning {
    double radius;      /* pixels */
    double millimetres; /* the radius */
    int points, count;  /* of a face; of frames */
    int few;            /* whether frames show few marks, so that only what repeats itself is sure */
    int capacity;
    short *map;            /* of each node of the square around the face: the number of its point, or -1 */
    double (*grid)[2];     /* of each point, to the right and up, in radii */
    unsigned char *levels; /* of each point of each frame */
    follow_turn *turns;
    double *even, *marked, *spread,
        *sigma; /* of each point; its deviation from frame to frame, and from what is expected */
    unsigned char *used;
    double (*facing)[3];        /* of the frame at work: where on the front each point is, in the laboratory */
    double (*slopes)[2][2];     /* of `even` and `marked` at each point: to the right and up, in radii */
    double (*light)[2];         /* and `even` and `marked` of each point */
    double view[3][3];          /* the mean of all */
    double trust;               /* of `step`, as above; 0: nothing repeats itself */
    follow_sphere sphere, rest; /* the surface; how much the faces still differ from it */
} follow_turning;

/* Prepare for a bead that is so many pixels wide.  FST_NO_MEMORY.  End it after a failure too. */
fst_status follow_turning_begin(follow_turning *turning, double diameter, fst_error *error);
void follow_turning_end(follow_turning *turning);

/* Keep the face of the bead in a frame, if it is there. */
fst_status follow_turning_take(follow_turning *turning, const follow_still *still, const unsigned char *pixels,
                               const float *gains, follow_place *place, int frame, double time,
                               fst_error *error);

/* Find from where each face was seen, by the plane in which the bead's centre moves; the bead's radius and the distance of
 * the camera from that plane are in mm.  FST_BAD_INPUT: no bead of this radius looks so wide. */
fst_status follow_turning_place(follow_turning *turning, const follow_still *still, const follow_plane *plane,
                                double radius, double distance, fst_error *error);

/* The point of a face that is at (right, up); -1: there is none. */
int follow_turning_point(double right, double up, const follow_turning *turning);

/* Find the rotation in each frame.  Returns which part of the variance of the faces it explains; 0: the bead has no
 * marks. */
fst_status follow_turning_find(follow_turning *turning, const fst_progress *progress, double *explained,
                               fst_error *error);

/* Find n, W and slip in each frame, and put them into the track.  FST_NO_MEMORY. */
fst_status follow_spin(const follow_turning *turning, fst_track *track, fst_error *error);

#endif
