/* split.h - a spot of several beads that touch in the picture, cut into beads. */
#ifndef FST_FOLLOW_SPLIT_H
#define FST_FOLLOW_SPLIT_H

#include "follow/blobs.h"

#include <festoon/tracks.h>

/* Cut a spot, of which follow_blobs_cover() was asked last, into `count` beads of the area `area`; parts[] gets their areas
 * and places.  Returns whether each of the parts looks like a bead; where beads hide each other too much it is 0. */
int follow_split(const follow_blobs *blobs, const follow_box *box, double area, int count,
                 follow_cover parts[FST_TRACKED_BEADS]);

#endif
