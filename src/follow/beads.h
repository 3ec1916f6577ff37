/* beads.h - one to four beads from frame to frame, each under its name. */
#ifndef FST_FOLLOW_BEADS_H
#define FST_FOLLOW_BEADS_H

#include "follow/bead.h"
#include "follow/split.h"

/* What is known of a bead's motion. */
typedef struct follow_mover {
    follow_place last;
    double rate[2];    /* pixels a second, from the place before to the last one; 0 where there was none */
    double when, step; /* of the last place, s, and the time from the place before; 0: there was none */
} follow_mover;

typedef struct follow_beads {
    follow_bead film; /* the frames; and the bead, where there is but one */
    int count;
    follow_mover movers[FST_TRACKED_BEADS];
    follow_place places[FST_TRACKED_BEADS]; /* in the frame before */
    int named;                              /* all beads were seen in one frame, and got their names by it */
    double bend, fastest; /* the greatest acceleration and speed of late, pixels/s^2 and pixels/s */
    unsigned doubtful;    /* the beads whose names were in doubt in the frame before, bit by bit */
} follow_beads;

fst_status follow_beads_begin(follow_beads *follower, follow_blobs *blobs, const follow_look *look, int count,
                              fst_error *error);
void follow_beads_end(follow_beads *follower);

/* Find the beads in the next frame, which was taken at a time (s).  `doubt` becomes a set of beads, bit by bit, that may have
 * exchanged their names from this frame on; 0: none. */
fst_status follow_beads_next(follow_beads *follower, const unsigned char *frame, double time,
                             follow_place places[FST_TRACKED_BEADS], unsigned *doubt, fst_error *error);

#endif
