/* window.c - one observation: which part looks at a step, and in which order.
 *
 *     flow        |--step--|--step--|--step--|--step--|--step--|--step--|
 *     span                      from                              until
 *     periods                   0           1          2          3         marks.c: one mark each
 *     returns                       o     x     o    x     o    x           returns.c: crossings of the section
 *     integrals   ================================================          quadrature.c: since the start
 *     extremes                  ==================================          extremes.c: since the opening
 *
 * Marks, not steps, bound everything that is reported.  Integrals are added up from the start of the motion,
 * because what counts is the difference of two marks.  The step in which the window opens is looked at from
 * there on.
 *
 * Activity is the greatest component of |d(state)/dt| at the ends of steps, kept period by period: how fast the
 * bead moves in the turning frame, in which a locked bead stands still.
 */
#include "observe/window.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

void fst_window_begin(fst_window *w, const fst_span *span, double period, const fst_flow *flow)
{
    memset(w, 0, sizeof *w);
    w->span = *span;
    w->period = period;
    w->groups = flow->groups;
    w->dry = fst_flow_world(flow)->kinds.dry;
    fst_quadrature_begin(&w->quadrature, flow);
    fst_extremes_begin(w->extremes);
    fst_returns_begin(&w->returns);
    fst_marks_begin(&w->periods);
    fst_swings_begin(&w->swings, flow->rtol);
    w->least_bead_angle = INFINITY;
    w->greatest_bead_angle = -INFINITY;
}

const fst_mark_series *fst_window_series(const fst_window *w, fst_twofold now)
{
    const int repeats = w->returns.of_cycles || fst_returns_are_regular(&w->returns, now);
    if (repeats && w->returns.marks.offered >= 2)
        return &w->returns.marks;
    return fst_window_is_bounded(w) && fst_swings_cover(&w->swings, w->span.from, now.high) ? &w->swings.marks
                                                                                            : &w->periods;
}

/* ------------------------------------------------------------------ drive periods */

/* Whether the mark of a whole period is needed whole: it will be kept, or is the last. */
static int is_period_needed(const fst_window *w, int64_t period)
{
    if (!w->span.asked_at_end || w->span.states_only)
        return !w->span.states_only;
    const double last = floor((w->span.until * (1.0 + 1e-12) - w->span.from) / w->period);
    return period >= (int64_t)last || period % fst_marks_stride((int64_t)last + 1) == 0;
}

/* Whether a whole period, counted from the span's beginning, ends by the end of the last step, and its fraction
 * *x there. */
static int period_ends(const fst_window *w, fst_flow *flow, int64_t period, double *x)
{
    const double until = w->span.until, t_high = w->span.from + (double)period * w->period;
    const fst_twofold t = {t_high > until * (1 - 1e-15) ? until : t_high, 0.0};
    *x = fst_flow_fraction(flow, t);
    return *x <= 1.0 + 1e-12 && t_high <= until * (1.0 + 1e-12);
}

void fst_window_mark_periods(fst_window *w, fst_flow *flow)
{
    double x;
    while (period_ends(w, flow, w->periods.offered, &x)) {
        fst_mark mark;
        if (is_period_needed(w, w->periods.offered))
            fst_mark_take(&mark, &w->quadrature, flow, x < 0 ? 0.0 : x > 1.0 - 1e-12 ? 1.0 : x, 1);
        else
            memset(&mark, 0, sizeof mark);
        mark.activity = w->activity;
        w->activity = 0.0;
        if (!fst_window_is_open(w))
            w->opens_at = fmin(fmax(x, 0.0), 1.0);
        fst_marks_offer(&w->periods, &mark);
    }
}

void fst_window_pass_left_out(fst_window *w, const fst_flow *flow)
{
    fst_mark mark = w->periods.latest;
    w->returns.left_out.state = FST_LEFT_OUT_FIRST;
    w->returns.side = (flow->step.end[FST_X] > 0) - (flow->step.end[FST_X] < 0);
    fst_quadrature_begin_moment_angle(&w->quadrature, flow->step.end);
    w->activity = mark.activity;
    while (fst_window_next_mark(w) <= flow->t.high) {
        mark.t = (fst_twofold){fst_window_next_mark(w), 0.0};
        fst_marks_offer(&w->periods, &mark);
    }
}

int fst_window_period_needs_integrals(const fst_window *w, fst_flow *flow)
{
    double x;
    int needed = 0;
    for (int64_t period = w->periods.offered; !needed && period_ends(w, flow, period, &x); ++period)
        needed = is_period_needed(w, period);
    return needed;
}

/* ------------------------------------------------------------------ steps */

/* Phi's range, which decides whether it is bounded: beyond a whole turn it no longer matters by how much. */
static void watch_bead_angle(fst_window *w, const fst_winding *bead_angle)
{
    if (!fst_window_is_bounded(w))
        return;
    const double angle = fst_winding_angle(bead_angle);
    w->least_bead_angle = angle < w->least_bead_angle ? angle : w->least_bead_angle;
    w->greatest_bead_angle = angle > w->greatest_bead_angle ? angle : w->greatest_bead_angle;
}

void fst_window_pass(fst_window *w, const fst_winding *bead_angle, double speed)
{
    w->activity = speed > w->activity ? speed : w->activity;
    if (fst_window_is_open(w))
        watch_bead_angle(w, bead_angle);
}

static int counts_maxima(const fst_window *w)
{
    return fst_window_is_open(w) && !w->span.states_only && fst_window_is_bounded(w);
}

int fst_window_needs_maximum(const fst_window *w, double speed)
{
    return counts_maxima(w) && fst_swings_need(&w->swings, speed);
}

void fst_window_pass_maximum(fst_window *w, double speed)
{
    if (counts_maxima(w))
        fst_swings_pass(&w->swings, speed);
}

/* The maximum of r in the flow's last step, if it holds one; in the step in which the window opens, it may lie
 * before the window. */
static void look_at_maximum(fst_window *w, fst_flow *flow, double speed)
{
    if (w->opens_at > 0.0 || !(fst_radial_function(flow, flow->step.y, NULL) > 0.0) ||
        !(fst_radial_function(flow, flow->step.end, NULL) <= 0.0))
        return;
    if (fst_window_needs_maximum(w, speed))
        fst_swings_look(&w->swings, &w->quadrature, flow);
    else
        fst_window_pass_maximum(w, speed);
}

void fst_window_look(fst_window *w, fst_flow *flow, int seek_extremes)
{
    w->opens_at = 0.0;
    fst_window_mark_periods(w, flow);
    fst_returns_step(&w->returns, &w->span, &w->quadrature, flow);
    if (fst_window_is_open(w) && seek_extremes)
        fst_extremes_step(w->extremes, &w->quadrature, flow, w->opens_at);
    const double speed = fst_flow_speed(flow);
    look_at_maximum(w, flow, speed);
    fst_window_pass(w, &flow->bead_angle, speed);
}

void fst_window_step(fst_window *w, fst_flow *flow)
{
    if (!w->span.states_only)
        fst_quadrature_step(&w->quadrature, flow, !fst_window_is_open(w));
    fst_window_look(w, flow, !w->span.states_only);
}
