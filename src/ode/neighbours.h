/* neighbours.h - the infinitesimal neighbours of a motion with dry friction. */
#ifndef FST_ODE_NEIGHBOURS_H
#define FST_ODE_NEIGHBOURS_H

#include "ode/flow.h"

enum { FST_NEIGHBOURS = 10 };

typedef struct fst_neighbours {
    int count;
    int parameter; /* the one whose setup differs instead of its start; -1: none does */
    double exact;  /* the parameter sets the drive's omega alone: their ratio; else 0 */
    double spread; /* else: of the parameter between these two setups */
    fst_world_double below, above;
    /* By how much the numbers of their motions differ: the states; at equal theta the clocks (FST_STEP_TIME), by
     * which they are ahead; and height and climb of a bead in the air. */
    double d[FST_NEIGHBOURS][FST_NUMBERS];
} fst_neighbours;

/* The flow is at its start, where the neighbours differ by d. */
void fst_neighbours_start(fst_neighbours *b, fst_flow *flow);

/* Carry them along the flow's last step, and through the change of mode at its end. */
void fst_neighbours_follow(fst_neighbours *b, const fst_flow *flow);

/* The change alone, of neighbours that were carried along in lanes. */
void fst_neighbours_change(fst_neighbours *b, const fst_flow *flow);

/* Whether the flow's last step, and what follows it, is a motion of which neighbours are known: no disc
 * that is held by a static friction no stronger than sliding friction. */
int fst_neighbours_known(const fst_flow *flow);

/* Compare them with the motion at equal times from here on. */
void fst_neighbours_at_equal_times(fst_neighbours *b, const fst_flow *flow);

#endif
