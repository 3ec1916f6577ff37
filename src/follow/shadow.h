/* shadow.h - the bead's outline, and the shadow beside it. */
#ifndef FST_FOLLOW_SHADOW_H
#define FST_FOLLOW_SHADOW_H

#include "follow/blobs.h"

enum { FOLLOW_SECTORS = 16, FOLLOW_BEYOND = 8, FOLLOW_HALVES = 8 };

/* What the samples show of the bead's outline.  Begin with {0}. */
typedef struct follow_outline {
    int seen;                                                     /* samples with an outline; of these: */
    double diameters[FOLLOW_SAMPLES], contrasts[FOLLOW_SAMPLES];  /* pixels; parts of the background's level */
    double halves[FOLLOW_HALVES][FOLLOW_SAMPLES];                 /* diameters by half of the outline */
    double beyond[FOLLOW_SECTORS][FOLLOW_BEYOND][FOLLOW_SAMPLES]; /* how dark it is beyond the outline, by
                                                                     direction and distance */
    double side[FOLLOW_SAMPLES][2];   /* the same, summed as vectors of these directions */
    double places[FOLLOW_SAMPLES][2]; /* column and row of its centre, sample by sample; 0, 0: not seen */
    /* By all of them: */
    double diameter, error; /* pixels; the error is one standard deviation, 0: nothing was seen */
    double shade;           /* the part of the background's level that a shadow takes away; 0: there is none */
} follow_outline;

/* Add the outline of the spot of a sample: the circle across which the brightness steps most.  `sign` is 1
 * of a dark bead, -1 of a bright one.  FST_NO_MEMORY is
 * the only failure. */
fst_status follow_outline_add(follow_outline *outline, const follow_blobs *blobs, int sample, double sign,
                              const follow_box *box, fst_error *error);

/* Decide by all samples how wide the bead is, and whether it has a shadow. */
void follow_outline_decide(follow_outline *outline, double sign);

#endif
