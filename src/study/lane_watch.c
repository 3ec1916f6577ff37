/* lane_watch.c - a close look at steps that were made in lanes, by the code that observes one run.
 *
 * After each round of the observed batch the engine names the lanes whose steps may hold something:
 *
 *     ending      the bead may have left the plate     step and path go to the run's flow, which looks exactly
 *     at_mark     a drive period ends                  a mark, and integrals for it if it will be kept
 *     close       X changed its sign, or an angle      the window looks for a crossing, as in fst_run(); the
 *                 is doubtful, or a direction          lane is told the turns that were counted, and the
 *                 turns fast                           integrals over the step
 *     at_maximum  r passed a maximum                   a mark of a cycle, while Phi does not turn
 *     wandering   Phi may have left its range so far   the window widens the range, and tells the lane
 *     beaten      a record may be beaten               the portable form: the window seeks extremes;
 *                                                      the fast form: the step is set aside, and located later
 *
 * Most steps hold nothing, and cost nothing here.  What the lane and the window both know (turns, activity,
 * time of the next mark, records) is copied back and forth around the look, so that both go on with the same
 * numbers.
 */
#include "study/lane_worker.h"
#include "study/settle.h"

#include <math.h>

#include "base/constants.h"

void fst_worker_locate(fst_row_worker *w)
{
    double values[FST_MOST_LANES];
    w->engine->locate(w->pending_steps, values);
    for (int i = 0; i < w->pending_count; ++i)
        if (w->pending[i].lane >= 0)
            fst_extremes_offer(w->observed.lanes[w->pending[i].lane].run->window.extremes, w->pending[i].record,
                               values[i]);
    w->pending_count = 0;
}

/* The portable form: the lane goes on with the records of its window. */
static void keep_records(fst_row_worker *w, int l, const fst_window *window)
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i)
        w->observed.view.records[i * w->engine->width + l] = fst_extremes_record(window->extremes, i);
}

/* Whether the orbit repeats itself so closely that later returns, even hundreds, cannot change a record by more
 * than 1e-6, or than the integration's own errors at loose tolerances.  The fast form then stops looking for
 * extremes, and soon at all (observe/left_out.h). */
static int repeats(const fst_watched_run *run)
{
    const fst_returns *returns = &run->window.returns;
    return returns->marks.offered >= 3 && returns->marks.latest.full_distance < returns->left_out.limit;
}

void fst_worker_set_aside(fst_row_worker *w, const unsigned *beaten)
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i)
        for (int l = 0; (beaten[i] & w->tracked) != 0 && l < w->engine->width; ++l)
            if (beaten[i] & w->tracked & fst_lane_bit(l)) {
                w->engine->set_aside(w->observed.memory, l, i, w->pending_steps, w->pending_count);
                w->pending[w->pending_count].lane = l;
                w->pending[w->pending_count].record = i;
                w->pending_count += 1;
                if (w->pending_count == w->engine->width)
                    fst_worker_locate(w);
            }
}

/* A lane's state at the end of its step. */
static void read_end(const fst_row_worker *w, int l, double end[FST_STATE_SIZE])
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        end[i] = w->observed.view.end[i * w->engine->width + l];
}

void fst_worker_keep_angle_range(fst_row_worker *w, int l)
{
    const int width = w->engine->width;
    const fst_watched_run *run = w->observed.lanes[l].run;
    const double range = run->window.greatest_bead_angle - run->window.least_bead_angle;
    if (range > FST_TWO_PI) { /* as fst_window_pass() has it */
        w->turning |= fst_lane_bit(l);
        return;
    }
    const int known = range >= 0 && range < 3.0;
    w->observed.view.bead_angle_least[l] = known ? cos(run->window.least_bead_angle) : 0.0;
    w->observed.view.bead_angle_least[width + l] = known ? sin(run->window.least_bead_angle) : 0.0;
    w->observed.view.bead_angle_most[l] = known ? cos(run->window.greatest_bead_angle) : 0.0;
    w->observed.view.bead_angle_most[width + l] = known ? sin(run->window.greatest_bead_angle) : 0.0;
}

/* A step that may widen the range of Phi and holds nothing else. */
static void watch_bead_angle(fst_row_worker *w, int l)
{
    fst_watched_run *run = w->observed.lanes[l].run;
    double end[FST_STATE_SIZE];
    read_end(w, l, end);
    run->flow->bead_angle = (fst_winding){(int64_t)w->observed.view.turns[0][l], end[FST_X], end[FST_Y]};
    fst_window_pass(&run->window, &run->flow->bead_angle, 0.0);
    fst_worker_keep_angle_range(w, l);
}

void fst_worker_extract_step(const fst_row_worker *w, const fst_lane_batch *b, int l)
{
    fst_flow *flow = b->lanes[l].run->flow;
    w->engine->extract_clock(b->memory, l, flow);
    w->engine->extract(b->memory, l, &flow->step);
    const double *y = flow->step.y;
    flow->bead_angle_start = (fst_winding){(int64_t)b->view.turns_before[0][l], y[FST_X], y[FST_Y]};
    flow->bead_angle = flow->bead_angle_start;
    fst_flow_follow(flow, flow->step.end);
}

int fst_worker_ends_run(const fst_row_worker *w, const fst_lane_batch *b, int l)
{
    w->engine->extract_path(b->memory, l, &b->lanes[l].run->flow->step);
    return fst_watched_run_ends(b->lanes[l].run);
}

/* Whether the look at a step needs its integrals. */
static int needs_integrals(const fst_row_worker *w, const fst_watched_run *run, int at_mark, double speed)
{
    const fst_window *window = &run->window;
    return !w->engine->fused || fst_settling_needs_integrals(run) ||
           fst_returns_need_integrals(&window->returns, &window->span, run->flow) ||
           fst_window_needs_maximum(window, speed) ||
           (at_mark && fst_window_period_needs_integrals(window, run->flow));
}

/* The integrals of a lane's last step, as the window has them. */
static void extract_integrals(const fst_row_worker *w, int l, fst_quadrature *q)
{
    w->engine->extract_integrals(w->observed.memory, l, &q->sums);
    q->has_dense = 0;
}

/* Tell the lane what its window made of a step. */
static void follow_window(fst_row_worker *w, int l)
{
    fst_lane_batch *b = &w->observed;
    const fst_watched_run *run = b->lanes[l].run;
    const int is_open = fst_window_is_open(&run->window);
    b->view.activity[l] = run->window.activity;
    b->view.turns[0][l] = (double)run->flow->bead_angle.turns;
    b->view.turns[1][l] = (double)run->window.quadrature.moment_angle.turns;
    b->view.next_mark[l] = fst_window_next_mark(&run->window);
    w->in_window |= is_open ? fst_lane_bit(l) : 0;
    w->tracked &= ~fst_lane_bit(l);
    if (is_open && !(w->engine->fused && repeats(run)) && fst_settling_seeks_extremes(run))
        w->tracked |= fst_lane_bit(l);
    if (!w->engine->fused)
        keep_records(w, l, &run->window);
    fst_worker_keep_angle_range(w, l);
}

/* The run of a lane begins another window: extremes of the one before are no longer wanted. */
static void forget_window(fst_row_worker *w, int l)
{
    w->settled |= fst_lane_bit(l);
    w->tracked &= ~fst_lane_bit(l);
    for (int i = 0; i < w->pending_count; ++i)
        if (w->pending[i].lane == l)
            w->pending[i].lane = -1;
}

void fst_worker_look_at_settling(fst_row_worker *w, int l)
{
    if (fst_settling_look(w->observed.lanes[l].run))
        forget_window(w, l);
}

int fst_worker_seek(fst_row_worker *w, int l)
{
    fst_lane_batch *b = &w->run_up;
    fst_watched_run *run = b->lanes[l].run;
    run->window.activity = b->view.activity[l];
    fst_window_look(&run->window, run->flow, 0);
    const int anew = fst_settling_look(run);
    b->view.activity[l] = run->window.activity;
    b->view.next_mark[l] = fst_window_next_mark(&run->window);
    return anew;
}

/* After a return: may the run go on unobserved, or did it do so wrongly? */
static void look_at_returns(fst_row_worker *w, int l)
{
    fst_watched_run *run = w->observed.lanes[l].run;
    fst_window *window = &run->window;
    fst_returns *returns = &window->returns;
    fst_worker_look_at_settling(w, l);
    if (run->settling.asked || !w->engine->fused || !returns->crossed || returns->crossings % 2 == 0)
        return;
    if (fst_left_out_begin(&returns->left_out, &returns->marks, &window->span))
        w->leaving |= fst_lane_bit(l);
    if (returns->left_out.state == FST_LEFT_OUT_FAILED)
        w->failed |= fst_lane_bit(l);
}

/* Look closely at a lane's accepted step; 1 if its run is over. */
static int watch(fst_row_worker *w, int l, fst_lane_events events)
{
    fst_lane_batch *b = &w->observed;
    fst_watched_run *run = b->lanes[l].run;
    fst_flow *flow = run->flow;
    fst_quadrature *q = &run->window.quadrature;
    fst_worker_extract_step(w, b, l);
    fst_quadrature_begin_moment_angle(q, flow->step.y);
    q->moment_angle.turns = (int64_t)b->view.turns_before[1][l];
    fst_quadrature_follow(q, flow, flow->step.end);
    if ((events.ending & fst_lane_bit(l)) && fst_worker_ends_run(w, b, l))
        return 1;
    fst_quadrature_look_for_passages(q, flow);
    if (q->passages || needs_integrals(w, run, (events.at_mark & fst_lane_bit(l)) != 0, b->view.speed[l]))
        extract_integrals(w, l, q);
    if (fst_window_is_open(&run->window) && !run->window.span.states_only)
        fst_quadrature_resolve(q, flow);
    if (!fst_window_is_open(&run->window)) /* crossings before it were not looked at */
        fst_returns_see_side(&run->window.returns, flow);
    run->window.activity = b->view.activity[l];
    fst_window_look(&run->window, flow, !w->engine->fused && fst_settling_seeks_extremes(run));
    if (q->passages && q->is_resolved)
        w->engine->set_increments(w->observed.memory, l, q->sums.increment);
    look_at_returns(w, l);
    if (!(w->settled & fst_lane_bit(l)))
        follow_window(w, l);
    return flow->t.high >= run->window.span.until;
}

/* A step that ends a period whose mark is not needed, and holds nothing else. */
static void pass_mark(fst_row_worker *w, int l)
{
    const fst_lane_view *v = &w->observed.view;
    fst_watched_run *run = w->observed.lanes[l].run;
    run->window.activity = v->activity[l];
    fst_window_mark_periods(&run->window, run->flow);
    v->activity[l] = v->speed[l] > run->window.activity ? v->speed[l] : run->window.activity;
    v->next_mark[l] = fst_window_next_mark(&run->window);
}

unsigned fst_worker_look(fst_row_worker *w, fst_lane_events events)
{
    const unsigned wandering = events.wandering & w->in_window & ~w->turning;
    unsigned over = 0;
    for (int l = 0; ((events.close | events.at_mark | events.at_maximum | wandering) >> l) != 0; ++l) {
        int close = (events.close & fst_lane_bit(l)) != 0;
        const int at_maximum = (events.at_maximum & fst_lane_bit(l)) != 0;
        if (at_maximum)
            close |= w->observed.lanes[l].run->settling.cycle.watched ||
                     fst_window_needs_maximum(&w->observed.lanes[l].run->window, w->observed.view.speed[l]);
        if (!close && events.at_mark & fst_lane_bit(l)) {
            w->engine->extract_clock(w->observed.memory, l, w->observed.lanes[l].run->flow);
            close = fst_window_period_needs_integrals(&w->observed.lanes[l].run->window,
                                                      w->observed.lanes[l].run->flow);
            close |= w->observed.lanes[l].run->settling.asked;
            if (!close)
                pass_mark(w, l);
        }
        if (!close && at_maximum)
            fst_window_pass_maximum(&w->observed.lanes[l].run->window, w->observed.view.speed[l]);
        if (close)
            over |= watch(w, l, events) ? fst_lane_bit(l) : 0;
        else if (wandering & fst_lane_bit(l))
            watch_bead_angle(w, l);
    }
    return over;
}
