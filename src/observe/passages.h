/* passages.h - integrals over steps in which a local direction turns fast. */
#ifndef FST_OBSERVE_PASSAGES_H
#define FST_OBSERVE_PASSAGES_H

#include "ode/flow.h"

/* What a step passes: the axis r = 0, where e_r turns; the directions e_r and -e_r, near which that of n in the
 * plane (alpha, z) turns. */
enum { FST_PASSES_AXIS = 1, FST_PASSES_POLE = 2 };

/* What the flow's last step passes so closely that the places of the step do not resolve it. */
int fst_passages_of(const fst_flow *flow);

/* The integrals over the fractions [0, x] of the flow's last step, resolved, of those quantities whose
 * integrands turn with what the step passes; the others of `integrals` stay as they are.  Deviations of r are
 * taken from `r_reference`. */
void fst_passages_integrate(fst_flow *flow, int passages, double x, double r_reference,
                            double integrals[FST_Q_COUNT]);

#endif
