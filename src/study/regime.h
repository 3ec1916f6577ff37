/* regime.h - what kind of motion a run has reached; the criteria stand in docs/regimes.md. */
#ifndef FST_STUDY_REGIME_H
#define FST_STUDY_REGIME_H

#include "study/exponent.h"
#include "study/watched_run.h"

/* Fill in regime, symmetry and reason.  0: the motion cannot be recognised without its largest exponent, and
 * `exponent` is NULL; the result means nothing then. */
int fst_decide_regime(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result);

/* Greatest component of d(state)/dt at the end of the last step.  Where nothing acts on n, its turning does not
 * count. */
double fst_speed_at_end(const fst_watched_run *run);
int fst_n_is_free(const fst_watched_run *run);

/* Whether anything takes energy from the motion: friction, unless its contact never slips. */
int fst_is_braked(const fst_watched_run *run);

#endif
