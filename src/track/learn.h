/* learn.h - what the bead of a film looks like, learnt from the samples of its still picture. */
#ifndef FST_TRACK_LEARN_H
#define FST_TRACK_LEARN_H

#include "track/blobs.h"

/* Find out whether the bead is darker or brighter than the background, by how much, and how large it is.
 * FST_BAD_INPUT: nothing of the kind moves, or two things do; the sentence says what to look at. */
fst_status track_learn(track_blobs *blobs, const char *path, const fst_progress *progress, track_look *look,
                       fst_error *error);

#endif
