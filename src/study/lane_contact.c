/* lane_contact.c - steps in lanes that may end the mode of a dry contact, or the way.
 *
 * The engine makes steps in all modes, but where a mode ends it does not know: the event has to be located on
 * the step's dense output.  So such a step, which is good but not accepted, is copied out of its lane with all
 * its stages, and the run's own flow looks for the event (ode/contact.c):
 *
 *     lane    --step--|--step--|.tried...|                  |-made anew-|--step--|--step--
 *                                   |                       ^           ^
 *                                  copy            so long! |           | the next mode
 *                                   v                       |           |
 *     flow                          where does it end? -----+           enter, first stage
 *
 * The step that is made anew is observed like all others.  Where nothing ends the step is accepted as it is.
 * Only the last step of a run up, or of a run, is made by the flow: it takes some tries to land.
 */
#include "study/lane_worker.h"

static double limit_of(const fst_row_worker *w, const fst_lane_batch *b, int l)
{
    const fst_window *window = &b->lanes[l].run->window;
    return b == &w->observed || fst_window_is_open(window) ? window->span.until : window->span.from;
}

static fst_lane_flows flows_of(const fst_row_worker *w, const fst_lane_batch *b, unsigned lanes)
{
    fst_lane_flows at = {.engine = w->engine, .memory = b->memory};
    for (int l = 0; (lanes >> l) != 0; ++l)
        if (lanes & fst_lane_bit(l)) {
            at.flows[l] = b->lanes[l].run->flow;
            at.limits[l] = limit_of(w, b, l);
        }
    return at;
}

/* The step that a lane has tried, as the flow has it. */
static fst_flow *copy_try(const fst_lane_flows *at, int l)
{
    fst_flow *flow = at->flows[l];
    at->engine->extract_clock(at->memory, l, flow);
    at->engine->extract(at->memory, l, &flow->step);
    at->engine->extract_path(at->memory, l, &flow->step);
    return flow;
}

fst_lane_contacts fst_lanes_look_at_contacts(const fst_lane_flows *at, fst_lane_tries tries)
{
    fst_lane_contacts contacts = {.turned = tries.anew};
    for (int l = 0; (tries.contact >> l) != 0; ++l) {
        if (!(tries.contact & fst_lane_bit(l)))
            continue;
        double end;
        fst_flow *flow = copy_try(at, l);
        if (fst_contact_look_ahead(flow, at->limits[l], &end)) {
            contacts.landed |= fst_lane_bit(l);
        } else if (end < 1.0) {
            at->engine->make_anew(at->memory, l, end * flow->step.h);
            flow->rhs_calls += DOP_TRY_EVALUATIONS + 1; /* the clock will count the other try */
        } else {
            contacts.passed |= fst_lane_bit(l);
            if (flow->contact.slip.next >= 0 || fst_contact_mode(flow) == FST_MODE_ONSET)
                contacts.turned |= fst_lane_bit(l);
        }
    }
    if (contacts.passed)
        at->engine->pass(at->memory, contacts.passed);
    return contacts;
}

void fst_lane_land(const fst_lane_flows *at, int l)
{
    fst_flow *flow = copy_try(at, l);
    flow->rhs_calls += DOP_TRY_EVALUATIONS; /* the clock does not count this step */
    fst_contact_end_step(flow, at->limits[l]);
}

fst_lane_contacts fst_worker_look_at_contacts(fst_row_worker *w, fst_lane_batch *b, fst_lane_tries tries)
{
    const fst_lane_flows at = flows_of(w, b, tries.contact);
    return fst_lanes_look_at_contacts(&at, tries);
}

void fst_worker_begin_mode(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_flow *flow = b->lanes[l].run->flow;
    w->engine->extract_clock(b->memory, l, flow);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        flow->step.end[i] = b->view.y[i * w->engine->width + l];
    fst_contact_begin_step(flow);
    w->engine->reload(b->memory, l, flow, limit_of(w, b, l));
}

/* The integrals up to a lane's last step, and its angles, as its window goes on from them. */
static void hand_to_window(fst_row_worker *w, int l)
{
    const fst_lane_batch *b = &w->observed;
    fst_watched_run *run = b->lanes[l].run;
    fst_quadrature *q = &run->window.quadrature;
    if (w->pending_count > 0)
        fst_worker_locate(w);
    w->engine->extract_integrals(b->memory, l, &q->sums);
    q->has_dense = 0;
    fst_quadrature_begin_moment_angle(q, run->flow->step.y);
    q->moment_angle.turns = (int64_t)b->view.turns_before[1][l];
    if (!fst_window_is_open(&run->window)) /* crossings before it were not looked at */
        fst_returns_see_side(&run->window.returns, run->flow);
}

int fst_worker_land(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_watched_run *run = b->lanes[l].run;
    fst_flow *flow = run->flow;
    const double *y = flow->step.y;
    const int looks_for_extremes = !w->engine->fused || ((w->tracked | ~w->in_window) & fst_lane_bit(l));
    const fst_lane_flows at = flows_of(w, b, fst_lane_bit(l));
    fst_lane_land(&at, l);
    flow->bead_angle_start = (fst_winding){(int64_t)b->view.turns_before[0][l], y[FST_X], y[FST_Y]};
    flow->bead_angle = flow->bead_angle_start;
    fst_flow_follow(flow, flow->step.end);
    if (fst_watched_run_ends(run))
        return 1;
    run->window.activity = b->view.activity[l];
    if (b == &w->observed) {
        hand_to_window(w, l);
        fst_quadrature_step(&run->window.quadrature, flow, !fst_window_is_open(&run->window));
        fst_window_look(&run->window, flow, looks_for_extremes);
        fst_worker_look_at_settling(w, l);
    } else {
        fst_window_pass(&run->window, &flow->bead_angle, fst_flow_speed(flow));
        b->view.activity[l] = run->window.activity;
    }
    return 0;
}
