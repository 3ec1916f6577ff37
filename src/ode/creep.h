/* creep.h - a slip so slow that its direction is known (creep.c). */
#ifndef FST_ODE_CREEP_H
#define FST_ODE_CREEP_H

#include "ode/flow.h"

/* Whether the slip at the end of the last step, in the mode slip, goes on as one that creeps. */
int fst_creep_begins(const fst_flow *flow);

/* A creep begins or goes on at `state`, whose slip is turned into the direction that it has. */
void fst_creep_enter(fst_flow *flow, double *state);

/* Whether a disc that was held begins to creep in a state where it lets go. */
int fst_creep_is_released(const fst_flow *flow, const double *state);

/* Neighbours are carried along from now on: a disc slips instead of creeping, from its next mode on. */
void fst_creep_is_followed(fst_flow *flow);

/* The fraction of the last step, in the mode creep, at which another mode or another lag must follow, 2 where
 * none; *next: the mode.  And the mode at its end. */
double fst_creep_ends(fst_flow *flow, int *next);
int fst_creep_after(const fst_flow *flow);

/* How the slip differs of a neighbour that is off by d from a bead that creeps, in the state y. */
void fst_creep_slip_change(const fst_world_double *c, const fst_modes_double *m, double omega, const double *y,
                           const double *d, double slip[2]);

#endif
