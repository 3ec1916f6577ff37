/* settle.h - runs that end as soon as their motion is known (run.until: settled). */
#ifndef FST_STUDY_SETTLE_H
#define FST_STUDY_SETTLE_H

#include "study/watched_run.h"

/* Call when a run has begun: if it ends once it has settled, its window opens at its start. */
void fst_settling_begin(fst_watched_run *run);

/* After a step was observed: 1 if the window was begun anew at its end, where the flow then starts again. */
int fst_settling_look(fst_watched_run *run);

/* Widen the errors of the means by the way that the motion had still to go when the short window began. */
void fst_settling_widen_errors(const fst_watched_run *run, fst_run_result *result);

/* Whether extremes of the present window are wanted. */
int fst_settling_seeks_extremes(const fst_watched_run *run);

/* Whether the next look may need the integrals of its step, besides those that the window needs. */
int fst_settling_needs_integrals(const fst_watched_run *run);

/* Whether a run can go on from what an image holds. */
int fst_settling_is_sound(const fst_settling *settling);

/* The greatest rate at which small deviations from a state of rest grow or, if it is negative, die out: the
 * greatest real part of an eigenvalue of the Jacobian there, across |n|, which stays 1 (standstill.c). */
double fst_rest_rate(const fst_model *model, const double state[FST_STATE_SIZE]);

/* The end of the last step is where the flow goes on; the mode of a contact goes on too. */
void fst_stand_at_end(fst_flow *flow);

#endif
