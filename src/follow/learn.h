/* learn.h - what the bead of a film looks like, learnt from the samples of its still picture. */
#ifndef FST_FOLLOW_LEARN_H
#define FST_FOLLOW_LEARN_H

#include "follow/blobs.h"

/* Find out whether one to four beads are darker or brighter than the background, by how much, and how large they are.
 * FST_BAD_INPUT: fewer things of the kind move, or more do; the sentence says what to look at. */
fst_status follow_learn(follow_blobs *blobs, const char *path, int beads, const fst_progress *progress,
                        follow_look *look, fst_error *error);

#endif
