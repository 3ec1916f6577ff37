/* flight.h - a bead that has left the plate, and comes down again (flight.c). */
#ifndef FST_ODE_FLIGHT_H
#define FST_ODE_FLIGHT_H

#include "ode/flow.h"

/* Whether the bead may leave the plate and go on, and whether it is in the air. */
int fst_flight_allowed(const fst_flow *flow);
int fst_flight_is_on(const fst_flow *flow);

/* The bead leaves the plate with the next step, at the speed `climb`. */
void fst_flight_begin(fst_flow *flow, double climb);

/* A bead in the air goes on from the end of its last step. */
void fst_flight_go_on(fst_flow *flow);

/* The bead, which was in the air, is back on the plate at `state`; the impact changes it.  Returns whether the
 * bead stays down; else it flies on. */
int fst_flight_impact(fst_flow *flow, double *state);

/* The load less what it may fall short of 0 before a bead leaves the plate: negative, it does. */
double fst_flight_load(const fst_flow *flow, const double *state, const fst_pull_double *p);

/* Whether the bead comes down in the last step, and at which fraction of it. */
int fst_flight_lands(fst_flow *flow, double *x);

/* How much longer the last step, which ends near the plate, must be to end on it. */
double fst_flight_missing(const fst_flow *flow);

/* The error of height and climb in a step, over the tolerance. */
double fst_flight_error(const fst_bead_step_double *s, double rtol);

/* Height and climb at the fraction x of the last step. */
void fst_flight_at(fst_flow *flow, double x, double *height, double *climb);

/* Energy of height and climb there, per mass, 0 on the plate; the field is that of the height from now on. */
double fst_flight_energy(fst_flow *flow, double x);

#endif
