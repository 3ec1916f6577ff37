/* onset.h - the lag behind its push of a slip, or of a rotation, that begins (onset.c). */
#ifndef FST_ODE_ONSET_H
#define FST_ODE_ONSET_H

#include "ode/flow.h"

/* The tolerance to the power 5/16, with which the sizes go at which a motion is handed over. */
double fst_hand_over(double rtol);

/* Begin the mode onset in a state, at the release of a bead that stuck; returns the time that it may last, over
 * the usual one. */
double fst_begin_onset(fst_flow *flow, const double *state);

/* Begin to roll in a state, against a resistance that held the bead so far: how strong it is, and how fast the
 * push outgrows it and changes, as rates of W_h. */
void fst_begin_rolling(fst_flow *flow, const double *state, double *strength, double *growth, double *turning);

#endif
