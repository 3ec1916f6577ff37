/* settle.h - runs that end as soon as their motion is known (run.until: settled). */
#ifndef FST_STUDY_SETTLE_H
#define FST_STUDY_SETTLE_H

#include "study/watched_run.h"

/* A run was begun: its window opens at its start, if it is to end once it has settled. */
void fst_settling_begin(fst_watched_run *run);

/* After a step was observed: 1 if the window was begun anew at its end, where the flow then starts again. */
int fst_settling_look(fst_watched_run *run);

/* The errors of the means take in the way that the motion had still to go when the short window began. */
void fst_settling_widen_errors(const fst_watched_run *run, fst_run_result *result);

/* Whether extremes of the present window are wanted. */
int fst_settling_seeks_extremes(const fst_watched_run *run);

/* Whether the next look may need the integrals of its step, besides those that the window needs. */
int fst_settling_needs_integrals(const fst_watched_run *run);

/* Whether what an image holds can be gone on with. */
int fst_settling_is_sound(const fst_settling *settling);

/* The end of the last step is where the flow goes on; the mode of a contact goes on too. */
void fst_stand_at_end(fst_flow *flow);

#endif
