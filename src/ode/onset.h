/* onset.h - the lag behind its push of a slip, or of a rotation, that begins (onset.c). */
#ifndef FST_ODE_ONSET_H
#define FST_ODE_ONSET_H

#include "ode/flow.h"

/* The tolerance to the power 5/16, with which the sizes go at which a motion is handed over. */
double fst_hand_over(double rtol);

/* Begin the mode onset in a state, at the release of a bead that stuck; returns the time that it may last, over
 * the usual one. */
double fst_begin_onset(fst_flow *flow, const double *state);

/* A slip that creeps in a state: how it lags behind the push A, which has this size, exceeds what friction can
 * take of it by `excess`, and grows past that at the rate `growth`. */
typedef struct fst_creeping {
    fst_lag_double lag;
    double push[2], size, excess, growth;
} fst_creeping;

fst_creeping fst_creeping_at(const fst_flow *flow, const double *state);

/* How nu grows with tau in a disc that creeps. */
static inline double fst_disc_eases(const fst_disc_creep_double *k)
{
    return 8.0 / (3.0 * FST_PI * (1.0 - 0.75 * k->nu * k->nu));
}

/* Improve, so many times, the rate at which the slip of a disc changes that creeps in a state, in these modes. */
void fst_fit_gain(const fst_flow *flow, const double *state, fst_modes_double *modes, int rounds);

/* Begin to roll in a state, against a resistance that held the bead so far: how strong it is, and how fast the
 * push outgrows it and changes, as rates of W_h. */
void fst_begin_rolling(fst_flow *flow, const double *state, double *strength, double *growth, double *turning);

#endif
