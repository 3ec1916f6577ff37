/* conclude.h - from a run to its result. */
#ifndef FST_STUDY_CONCLUDE_H
#define FST_STUDY_CONCLUDE_H

#include "study/exponent.h"
#include "study/ramp.h"
#include "study/watched_run.h"

/* How a run ended that came to an end before its time.  A bead that leaves the map of magnet.file inside the
 * plate is not ejected: nothing is known of the field there, so the regime is undecided. */
fst_regime fst_regime_of_end(const fst_groups *groups, fst_regime end, const char **how);

/* Every number of a result set to NAN, the rest to zero. */
void fst_result_clear(fst_run_result *result);

/* Fill in a cleared result from what the run has reached: means, extremes, and by docs/regimes.md's criteria
 * regime and symmetry.  Some motions need their largest Lyapunov exponent to be recognised: *needs_exponent then, and
 * the result means nothing until the run is concluded once more with that `exponent` (NULL: it is not known).
 */
fst_status fst_conclude(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result,
                        int *needs_exponent, fst_error *error);

/* The exponent that a run needs: what to ask for, over its window. */
void fst_ask_exponent(const fst_watched_run *run, fst_exponent *asked);

/* The same for a run whose drive was ramped: it has no single regime. */
void fst_conclude_ramp(const fst_watched_run *run, const fst_ramp *ramp, fst_run_result *result);

#endif
