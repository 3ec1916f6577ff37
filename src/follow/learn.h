/* learn.h - what the bead of a film looks like, learnt from the samples of its still picture. */
#ifndef FST_FOLLOW_LEARN_H
#define FST_FOLLOW_LEARN_H

#include "follow/blobs.h"

/* Find out whether the bead is darker or brighter than the background, by how much, and how large it is.
 * FST_BAD_INPUT: nothing of the kind moves, or two things do; the sentence says what to look at. */
fst_status follow_learn(follow_blobs *blobs, const char *path, const fst_progress *progress, follow_look *look,
                        fst_error *error);

#endif
