/* exponent.h - the largest Lyapunov exponent across the flow. */
#ifndef FST_STUDY_EXPONENT_H
#define FST_STUDY_EXPONENT_H

#include <festoon/festoon.h>

#include "lanes/lanes.h"

enum { FST_EXPONENT_WAY = 1024 };

/* A question, and its answer. */
typedef struct fst_exponent {
    const fst_world_double *world;
    double state[FST_STATE_SIZE]; /* where to begin */
    double duration, rtol;
    double value,
        standard_error; /* weighted mean over the time after the alignment (growth.h), and its error */
    /* The part of the error that is due to chance: it decides whether the exponent is positive.  A rate that
     * differs between the halves of the time widens the error too, even where it is positive in both. */
    double chance;
    uint64_t rhs_calls;
    int failed;  /* the step size underflowed */
    int unknown; /* the program does not know neighbours of such a motion (ode/neighbours.h) */
    /* How far the work has got (zeros: it has not begun); asked again, it goes on from there to the same bits.
     */
    int has_way;
    double way_state[FST_TANGENT_DIM];
    unsigned char way[FST_EXPONENT_WAY];
} fst_exponent;

/* The largest exponents of `count` beads, at most as many as the engine is wide.  Tangent vectors along the
 * flow and along |n| are projected out.  `progress` (may be NULL) is told between steps, when the
 * members way and way_state are up to date; a status other than FST_OK ends the work.  FST_NO_MEMORY. */
fst_status fst_largest_exponents(const fst_tangent_engine *engine, fst_exponent *const *asked, int count,
                                 const fst_progress *progress, fst_error *error);

/* The same under a law with modes, in the lanes of an engine of dry contacts; NULL: out of memory. */
typedef struct fst_dry_exponents fst_dry_exponents;
fst_dry_exponents *fst_dry_exponents_new(const fst_lane_engine *engine);
void fst_dry_exponents_free(fst_dry_exponents *exponents);

/* Follow `count` beads, at most as many as the engine is wide, until some are over: *over, one bit each.  The others
 * must be asked again: they stay in their lanes.  A new bead begins, and it does so anew if the work was given up. */
fst_status fst_dry_exponents_follow(fst_dry_exponents *exponents, fst_exponent *const *asked, int count,
                                    unsigned *over, const fst_progress *progress, fst_error *error);

#endif
