/* rest.h - a plate that resists rolling: when a bead comes to rest, and starts to roll again (rest.c). */
#ifndef FST_ODE_REST_H
#define FST_ODE_REST_H

#include "ode/flow.h"

/* Whether a bead in this state rotates so slowly that it is not said to roll. */
int fst_rest_is_still(const fst_flow *flow, const double *state);

/* Whether the resistance holds a bead that does not roll, in the mode that its contact is in. */
int fst_rest_holds(const fst_flow *flow, const double *state);

/* A mode of rolling begins at `state`. */
void fst_rest_enter(fst_flow *flow, int roll, double *state);

/* A bead that starts to roll goes on from the end of its last step. */
void fst_rest_go_on(fst_flow *flow);

/* The fraction of the last step at which its mode of rolling ends, 2 where it does not, and the one that
 * follows. */
double fst_rest_ends(fst_flow *flow, int *next);

/* The mode that follows a rotation that is nearly nothing, -1 where it goes on. */
int fst_rest_after(const fst_flow *flow);

#endif
