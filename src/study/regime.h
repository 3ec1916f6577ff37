/* regime.h - what kind of motion a run has reached; the criteria stand in docs/regimes.md. */
#ifndef FST_STUDY_REGIME_H
#define FST_STUDY_REGIME_H

#include "study/run_state.h"

/* The marks between which the means are taken: whole returns where Phi turns regularly, else drive periods. */
const fst_mark_series *fst_window_of(const fst_run_state *run);

/* Fill in regime, symmetry, reason and, where it was needed, the largest exponent. */
fst_status fst_decide_regime(fst_run_state *run, fst_run_result *result, fst_error *error);

#endif
