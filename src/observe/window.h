/* window.h - what is seen of a motion between two times: an observation, the same for one run and for lanes.
 *
 * A window is begun with a span of time, fed with the flow's steps from the motion's start on, and then asked
 * for means (means.h), extremes, marks and returns.  It opens at the span's beginning, when the first mark is
 * taken.
 */
#ifndef FST_OBSERVE_WINDOW_H
#define FST_OBSERVE_WINDOW_H

#include "base/constants.h"
#include "observe/extremes.h"
#include "observe/marks.h"
#include "observe/returns.h"
#include "observe/span.h"
#include "observe/swings.h"

typedef struct fst_window {
    fst_span span;
    double period;     /* of the drive: one mark each, from the span's beginning on */
    fst_groups groups; /* of the model */
    int dry;           /* its contact slips and sticks */
    fst_quadrature quadrature;
    fst_extreme extremes[FST_TRACK_COUNT];
    fst_returns returns;
    fst_mark_series periods; /* one mark a whole drive period */
    double activity;         /* greatest speed in the turning frame since the last of these */
    double least_bead_angle,
        greatest_bead_angle; /* range of Phi; once wider than a whole turn it is followed no more */
    fst_swings swings;       /* one mark a whole cycle, while that range is no more than a whole turn */
    double opens_at;         /* where in the last step the window opened; 0 in the steps after it */
} fst_window;

void fst_window_begin(fst_window *w, const fst_span *span, double period, const fst_flow *flow);

/* Take in the flow's last step. */
void fst_window_step(fst_window *w, fst_flow *flow);

/* Whether the window has opened: its first mark is the state there. */
static inline int fst_window_is_open(const fst_window *w)
{
    return w->periods.offered > 0;
}

/* The time of the next mark of a period. */
static inline double fst_window_next_mark(const fst_window *w)
{
    return w->span.from + (double)w->periods.offered * w->period;
}

/* The marks between which the means are taken: of whole returns where Phi has turned regularly until `now`, of
 * whole cycles where Phi has not turned, else of drive periods. */
const fst_mark_series *fst_window_series(const fst_window *w, fst_twofold now);

/* Whether Phi has stayed within a whole turn. */
static inline int fst_window_is_bounded(const fst_window *w)
{
    return w->greatest_bead_angle - w->least_bead_angle <= FST_TWO_PI;
}

/* The parts of fst_window_step(), for lanes, which know what a step may hold and add up integrals themselves.
 */

/* All but the integrals, which are in w->quadrature already where a mark needs them; `seek_extremes`: else they
 * are located by others and offered (extremes.h). */
void fst_window_look(fst_window *w, fst_flow *flow, int seek_extremes);

/* Marks of the periods that end in the flow's last step.  Where they need no integrals, the flow's clock is all
 * that is looked at. */
void fst_window_mark_periods(fst_window *w, fst_flow *flow);

/* The window is looked at again after a part of it was not (left_out.h): the periods that ended before the
 * flow's time have marks without integrals. */
void fst_window_pass_left_out(fst_window *w, const fst_flow *flow);

/* Whether a mark of a period that ends in the flow's last step needs integrals. */
int fst_window_period_needs_integrals(const fst_window *w, fst_flow *flow);

/* The end of a step: the speed there, and where the window is open the range of Phi.  This is all there is to
 * do for a step that holds no mark, no return and no extreme. */
void fst_window_pass(fst_window *w, const fst_winding *bead_angle, double speed);

/* Whether a step after which the bead has this speed is to be looked at if r passes a maximum in it; if it is
 * not looked at, the maximum is passed. */
int fst_window_needs_maximum(const fst_window *w, double speed);
void fst_window_pass_maximum(fst_window *w, double speed);

#endif
