/* slip.h - the slip of a contact along a trajectory: when it comes to rest and is let go (slip.c). */
#ifndef FST_ODE_SLIP_H
#define FST_ODE_SLIP_H

#include "ode/flow.h"

/* A mode of the contact begins at `state`, which may be moved by less than anything else feels. */
void fst_slip_enter(fst_flow *flow, int mode, double *state);

/* An onset goes on from the end of the last step. */
void fst_slip_go_on(fst_flow *flow);

/* The fraction of the last step at which its mode ends, but for flights, 2 where it does not, and the one that
 * follows. */
double fst_slip_ends(fst_flow *flow, int *next);

/* The mode that follows a slip that is nearly nothing, -1 where it goes on. */
int fst_slip_after(const fst_flow *flow);

/* Whether a slip is larger than nothing. */
int fst_slip_is_felt(const fst_flow *flow, const double *state);

/* What static friction could still take of the push in a state, and its change along a neighbour. */
double fst_grip_left(const fst_world_double *c, const fst_modes_double *m, const double *y);
double fst_grip_change(const fst_world_double *c, const fst_modes_double *m, double omega, const double *y,
                       const double *along);

#endif
