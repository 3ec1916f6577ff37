/* events.h - what ends the present state of contacts, and which one follows. */
#ifndef FST_BEADS_EVENTS_H
#define FST_BEADS_EVENTS_H

#include "beads/flow.h"

/* What happens at the end of a step, besides contacts and, from BEADS_CONTACTS on, beads that go. */
enum { BEADS_LIMIT = BEADS_CONTACTS + FST_BEADS_MOST };

/* What a step does: it is good; a contact k passes its bounds within it; it did so at the start already; it
 * must be shortened, because a gap that just opened sinks, or a contact touches and parts within it. */
typedef enum { BEADS_GOOD, BEADS_CROSSES, BEADS_STALE, BEADS_SINKS, BEADS_BRUSHES } beads_verdict;

/* The verdict on the step from flow->start to flow->end.  *which: the contact, BEADS_CONTACTS + bead at the
 * plate's edge, or BEADS_LIMIT; of a GOOD step a contact whose slip is over at its end, or -1; *value: the least of what may not be negative at the end (CROSSES), or the fraction of the step
 * at which to end it (BRUSHES). */
beads_verdict beads_judge(const beads_flow *flow, int *which, double *value);

/* The least value, at a look at y, of what was positive at the start of the step, and whose it is. */
double beads_least(const beads_flow *flow, const beads_look *look, const double *y, int *which);

/* Whether a value that fell below 0 by so much at the end of the step is near enough to it. */
int beads_is_near_enough(const beads_flow *flow, int which, double value);

/* Change contacts, velocities and beads at step.y after the event. */
fst_status beads_happen(beads_flow *flow, int which, fst_error *error);

/* Choose the contact state at step.y without an event. */
fst_status beads_settle(beads_flow *flow, fst_error *error);

#endif
