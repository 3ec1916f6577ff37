/* settle.h - runs that end as soon as their motion is known (run.until: settled). */
#ifndef FST_STUDY_SETTLE_H
#define FST_STUDY_SETTLE_H

#include "study/watched_run.h"

/* A run was begun: its window opens at its start, if it is to end once it has settled. */
void fst_settling_begin(fst_watched_run *run);

/* After a step was observed: 1 if the window was begun anew at its end, where the flow then starts again. */
int fst_settling_look(fst_watched_run *run);

/* The end of the last step is where the flow goes on; the mode of a contact goes on too. */
void fst_stand_at_end(fst_flow *flow);

#endif
