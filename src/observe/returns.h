/* returns.h - returns of the bead to the section X = 0 (Phi = pi/2 or -pi/2) within a window. */
#ifndef FST_OBSERVE_RETURNS_H
#define FST_OBSERVE_RETURNS_H

#include "observe/left_out.h"
#include "observe/marks.h"
#include "observe/span.h"

typedef struct fst_returns {
    int side;            /* sign of X where the bead is; 0 before the first step */
    int64_t crossings;   /* of the section, in the window */
    int last_half;       /* sign of Y at the last crossing */
    int last_direction;  /* sign of Phi' there */
    int irregular;       /* a crossing broke the alternation of halves or the direction */
    int64_t since_break; /* crossings since the last break; 0: a state was changed from outside */
    double section[3]
                  [FST_STATE_SIZE]; /* states at the latest crossings, the last one first, on the side Y > 0 */
    int crossed;                    /* the last step holds a crossing: `crossing` */
    fst_mark crossing;
    fst_mark_series marks; /* one mark a whole return */
    int need_whole;        /* the next whole return is to be marked with its integrals */
    int of_cycles; /* the marks are those of whole cycles of a libration (cycle.h), offered from outside */
    fst_left_out left_out; /* returns that nobody looked at */
} fst_returns;

void fst_returns_begin(fst_returns *r);

/* The side of the section where the bead is, before a step that is looked at after others were not. */
void fst_returns_see_side(fst_returns *r, const fst_flow *flow);

/* Look for a crossing in the flow's last step, and mark it. */
void fst_returns_step(fst_returns *r, const fst_span *span, fst_quadrature *q, fst_flow *flow);

/* Whether a crossing in the flow's last step, should there be one, is marked with its integrals. */
int fst_returns_need_integrals(const fst_returns *r, const fst_span *span, const fst_flow *flow);

/* Whether Phi turns regularly: halves alternated and the direction was kept, at six crossings or more, and the
 * turning did not stop within the window, which has come to the time `now`. */
int fst_returns_are_regular(const fst_returns *r, fst_twofold now);

#endif
