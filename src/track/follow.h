/* follow.h - the bead from frame to frame. */
#ifndef FST_TRACK_FOLLOW_H
#define FST_TRACK_FOLLOW_H

#include "track/blobs.h"

/* Where the bead is in a frame, in pixels: columns from the left, rows from the top; NAN where it is lost. */
typedef struct track_place {
    double column, row;
    double diameter; /* of a disc that is as wide as the bead across its motion */
    int twin;        /* the frame is the one before once more */
} track_place;

typedef struct track_follower {
    track_blobs *blobs;
    const track_look *look;
    track_place last[2]; /* where it was seen last, and before */
    double when[2];
    int seen;              /* how many of these there are */
    unsigned char *before; /* the frame before */
    float *gains;          /* of the rows of this one */
    int frames;
} track_follower;

fst_status track_follow_begin(track_follower *follower, track_blobs *blobs, const track_look *look,
                              fst_error *error);
void track_follow_end(track_follower *follower);

/* Find the bead in the next frame, which was taken at a time (s).  What is found depends on this frame and on
 * those before alone. */
fst_status track_follow(track_follower *follower, const unsigned char *frame, double time, track_place *place,
                        fst_error *error);

#endif
