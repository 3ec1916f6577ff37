/* disc.h - a contact that is a disc: when it is held, and how it lets go (disc.c). */
#ifndef FST_ODE_DISC_H
#define FST_ODE_DISC_H

#include "ode/flow.h"

/* A trajectory begins, with its tolerances set. */
void fst_disc_begin(fst_flow *flow);

/* What static friction could still take of a bead that is held; negative: it lets go. */
double fst_disc_hold(const fst_flow *flow, const double *state, const fst_pull_double *p);

/* Whether a bead is so slow that it is to be held. */
int fst_disc_rests(const fst_flow *flow, const double *state, const fst_pull_double *p);

/* The slip and the rate of pivoting, W.e, with which a bead that was held begins to move. */
void fst_disc_release(const fst_flow *flow, const double *state, const fst_pull_double *p, double velocity[2],
                      double *pivot);

#endif
