/* drift.h - do the means of a window still drift? */
#ifndef FST_STUDY_DRIFT_H
#define FST_STUDY_DRIFT_H

#include "study/watched_run.h"

typedef struct fst_drift {
    const char *what; /* the mean that drifts most, for a sentence; NULL: none does */
    double change;    /* its change over the window, by a straight line through the blocks */
    double noise;     /* standard error of that change */
    double mean;      /* over the window */
    double turns;     /* length of the window in turns of the magnet */
} fst_drift;

/* Look for a drift of the window's means: of <r>, delta r, and where Phi turns of <alpha'> and <n_z>.
 * docs/regimes.md says by what test. */
fst_drift fst_drift_of(const fst_watched_run *run);

/* Whether a drift of <r> or <alpha'> of a turning motion by 2 % of them could not be seen: because the straight
 * line shows as much, which may be a slow swing's, or because a slow swing could hide it.  Then `what` is set,
 * and `noise` is the greatest change that a drift could have made. */
fst_drift fst_hidden_drift_of(const fst_watched_run *run);

/* Whether the speed in the turning frame grows over the second half of the window as a straight line of its
 * logarithm, beyond its scatter: so does a bead that is about to leave an unstable state of rest. */
int fst_speed_grows(const fst_watched_run *run);

#endif
