/* bead.h - the bead from frame to frame. */
#ifndef FST_FOLLOW_BEAD_H
#define FST_FOLLOW_BEAD_H

#include "follow/blobs.h"

/* Where the bead is in a frame, in pixels: columns from the left, rows from the top; NAN where it is lost. */
typedef struct follow_place {
    double column, row;
    double diameter; /* of a disc that is as wide as the bead across its motion */
    int twin;        /* the frame is the one before once more */
} follow_place;

typedef struct follow_bead {
    follow_blobs *blobs;
    const follow_look *look;
    follow_place last[2]; /* where it was seen last, and before */
    double when[2];
    int seen;              /* how many of these there are */
    unsigned char *before; /* the frame before */
    float *gains;          /* of the rows of this one */
    int frames;
} follow_bead;

fst_status follow_bead_begin(follow_bead *follower, follow_blobs *blobs, const follow_look *look,
                             fst_error *error);
void follow_bead_end(follow_bead *follower);

/* Find the spots of the next frame; returns whether it is the one before once more. */
int follow_bead_see(follow_bead *follower, const unsigned char *frame);

/* Find the bead in the next frame, which was taken at a time (s).  What is found depends on this frame and on
 * those before alone. */
fst_status follow_bead_next(follow_bead *follower, const unsigned char *frame, double time, follow_place *place,
                            fst_error *error);

#endif
