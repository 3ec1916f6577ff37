/* swings.h - marks of the whole cycles of a motion that swings without turning about the magnet's axis. */
#ifndef FST_OBSERVE_SWINGS_H
#define FST_OBSERVE_SWINGS_H

#include "observe/marks.h"

enum { FST_SWINGS_PAST = 8 }; /* maxima of r that a cycle may have */

typedef struct fst_swings {
    double noise;                                 /* a slower motion may be the integrator's errors */
    int seen;                                     /* of those below, the first so many are known */
    double past[FST_SWINGS_PAST][FST_STATE_SIZE]; /* states at the latest maxima of r, the last one first */
    int maxima;  /* of r in a cycle; 0: not known yet, and every maximum is looked at */
    int to_come; /* maxima until the next mark */
    fst_mark_series marks;
} fst_swings;

void fst_swings_begin(fst_swings *s, double rtol);

/* Whether a maximum of r has to be located, in a step after which the bead has this speed in the turning frame:
 * then by fst_swings_look().  Else it is counted, by fst_swings_pass(). */
int fst_swings_need(const fst_swings *s, double speed);
void fst_swings_pass(fst_swings *s, double speed);

/* Locate the maximum in the flow's last step, and mark it. */
void fst_swings_look(fst_swings *s, fst_quadrature *q, fst_flow *flow);

/* Whether the marks represent a window from `from` to `now`: there are enough, over most of it. */
int fst_swings_cover(const fst_swings *s, double from, double now);

#endif
