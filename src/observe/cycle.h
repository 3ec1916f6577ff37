/* cycle.h - motions that repeat themselves without turning about the magnet's axis: librations. */
#ifndef FST_OBSERVE_CYCLE_H
#define FST_OBSERVE_CYCLE_H

#include "observe/closing.h"

enum { FST_CYCLE_MAXIMA = 8 }; /* of r, that a cycle may have */

typedef struct fst_cycle {
    int watched;                                   /* maxima of r are looked for */
    int seen;                                      /* of those below, the first so many are known */
    double past[FST_CYCLE_MAXIMA][FST_STATE_SIZE]; /* states at the latest maxima of r, the last one first */
    int since;                                     /* maxima since a cycle was completed; -1: none was */
    fst_mark latest;                               /* the last maximum, of the last step if that held one */
    fst_closing closing;
} fst_cycle;

void fst_cycle_begin(fst_cycle *c, double rtol);

/* Begin to look for maxima, or cease to; what was seen is forgotten if that changes. */
void fst_cycle_watch(fst_cycle *c, int watch);

/* Integrals begin anew: cycles are to be completed again. */
void fst_cycle_forget(fst_cycle *c);

/* Look for a maximum of r in the flow's last step.  1: a cycle is completed, and c->latest is its mark. */
int fst_cycle_step(fst_cycle *c, fst_quadrature *q, fst_flow *flow);

/* Whether a maximum in the next step is to be marked with its integrals. */
static inline int fst_cycle_needs_integrals(const fst_cycle *c)
{
    return c->watched && c->since >= 0;
}

/* After fst_cycle_step() was 1: whether the motion has settled on this cycle, with Phi bounded; `speed` is the
 * greatest of late in the turning frame. */
int fst_cycle_settles(fst_cycle *c, double until, double speed);

#endif
