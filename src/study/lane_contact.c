/* lane_contact.c - a step in a lane that ends the mode of a dry contact, or the way.
 *
 * The engine makes steps in all modes, but where a mode ends it does not know what to do: the event has to be
 * located, the step made anew up to there, and the next mode entered.  So such a step, which is good but not
 * passed in the lane, is taken out of it with all its stages.  What follows is what fst_flow_step() and
 * fst_window_step() do with a step of a single run:
 *
 *     lane    --step--|--step--|..tried..|                    |--step--|--
 *                                   |                         ^
 *                                take out                  put back
 *                                   v                         |
 *     flow                          event, cut, look, next mode
 *
 * The lane loses no round by that; its neighbours wait for the time of some evaluations.
 */
#include <math.h>

#include "study/lane_worker.h"

/* The lane's step as the run's own flow has it, and what its window has to go on from. */
static void take_out(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_watched_run *run = b->lanes[l].run;
    fst_flow *flow = run->flow;
    const double *y = flow->step.y;
    w->engine->extract_clock(b->memory, l, flow);
    w->engine->extract(b->memory, l, &flow->step);
    w->engine->extract_path(b->memory, l, &flow->step);
    flow->rhs_calls += DOP_TRY_EVALUATIONS; /* the clock does not count this step */
    flow->bead_angle = (fst_winding){(int64_t)b->view.turns_before[0][l], y[FST_X], y[FST_Y]};
    run->window.activity = b->view.activity[l];
    if (b != &w->observed)
        return;
    fst_quadrature *q = &run->window.quadrature;
    w->engine->extract_integrals(b->memory, l, &q->sums);
    q->has_dense = 0;
    fst_quadrature_begin_moment_angle(q, y);
    q->moment_angle.turns = (int64_t)b->view.turns_before[1][l];
    if (!fst_window_is_open(&run->window)) /* crossings before it were not looked at */
        fst_returns_see_side(&run->window.returns, flow);
}

/* The fast form: records that wait to be located belong to steps before this one. */
static void catch_up(fst_row_worker *w, int l)
{
    int waits = 0;
    for (int i = 0; i < w->pending_count; ++i)
        waits |= w->pending[i].lane == l;
    if (waits)
        fst_worker_locate(w);
}

static void look(fst_row_worker *w, int l)
{
    fst_watched_run *run = w->observed.lanes[l].run;
    const int fused = w->engine->fused;
    catch_up(w, l);
    fst_quadrature_step(&run->window.quadrature, run->flow, !fst_window_is_open(&run->window));
    fst_window_look(&run->window, run->flow, !fused || (w->tracked | ~w->in_window) & fst_lane_bit(l));
}

static void put_back(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_watched_run *run = b->lanes[l].run;
    const fst_lane_view *v = &b->view;
    const int observed = b == &w->observed;
    w->engine->reload(b->memory, l, run->flow, observed ? run->window.span.until : run->window.span.from);
    v->activity[l] = run->window.activity;
    v->turns[0][l] = v->turns_before[0][l] = (double)run->flow->bead_angle.turns;
    if (!observed)
        return;
    w->engine->load_integrals(b->memory, l, &run->window.quadrature.sums);
    fst_worker_follow_window(w, l);
    v->turns_before[1][l] = v->turns[1][l];
    for (int i = 0; w->engine->fused && i < FST_RECORD_COUNT; ++i) {
        double *record = &v->records[i * w->engine->width + l];
        *record = fmax(*record, fst_extremes_record(run->window.extremes, i));
    }
}

fst_lane_fate fst_worker_end_step(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_watched_run *run = b->lanes[l].run;
    fst_flow *flow = run->flow;
    const int observed = b == &w->observed;
    const double limit = observed ? run->window.span.until : run->window.span.from;
    take_out(w, b, l);
    fst_contact_end_step(flow, limit);
    flow->bead_angle_start = flow->bead_angle;
    fst_flow_follow(flow, flow->step.end);
    if (fst_watched_run_ends(run))
        return FST_LANE_OVER;
    if (observed)
        look(w, l);
    else
        run->window.activity = fmax(run->window.activity, fst_flow_speed(flow));
    b->view.activity[l] = run->window.activity;
    if (flow->t.high >= limit)
        return observed ? FST_LANE_OVER : FST_LANE_LANDED;
    fst_contact_begin_step(flow);
    put_back(w, b, l);
    return FST_LANE_GOES_ON;
}
