/* flight.h - a bead that has left the plate, and comes down again (flight.c). */
#ifndef FST_ODE_FLIGHT_H
#define FST_ODE_FLIGHT_H

#include "ode/flow.h"

/* Whether the bead is in the air. */
static inline int fst_flight_is_on(const fst_flow *flow)
{
    return fst_in_flight_double(fst_flow_modes(flow));
}

/* The bead leaves the plate, at the speed `climb`. */
void fst_flight_begin(double *state, double climb);

/* The part that an impact of the normal impulse `normal` leaves of a slip, whose square is s2, by an impulse of
 * friction. */
double fst_impact_leaves(const fst_world_double *c, double s2, double normal, double *impulse);

/* The bead, which was in the air, is back on the plate at `state`; the impact changes it.  Returns whether the
 * bead stays down; else it flies on. */
int fst_flight_impact(fst_flow *flow, double *state);

/* Whether the bead comes down in the last step, and at which fraction of it. */
int fst_flight_lands(fst_flow *flow, double *x);

/* How much longer the last step, which ends near the plate, must be to end on it. */
double fst_flight_missing(const fst_flow *flow);

/* The error of height and climb in a step, over the tolerance. */
double fst_flight_error(const fst_bead_step_double *s, double rtol);

#endif
