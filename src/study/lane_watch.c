/* lane_watch.c - what the steps of runs in lanes hold, looked at by the code of fst_run(). */
#include <math.h>

#include "study/lane_crew.h"

#define TWO_PI 6.283185307179586476925287

/* Locate the extremes that were set aside. */
void fst_crew_locate(fst_crew *c)
{
    double values[FST_MOST_LANES];
    c->engine->locate(c->slots, values);
    for (int i = 0; i < c->aside; ++i) {
        const int record = c->set_aside[i].record;
        fst_extreme *e = &c->observed.lanes[c->set_aside[i].lane].run->q.extreme[FST_RECORD_TRACKS[record]];
        if (fst_record_sign(record) > 0)
            e->greatest = values[i] > e->greatest ? values[i] : e->greatest;
        else
            e->least = -values[i] < e->least ? -values[i] : e->least;
    }
    c->aside = 0;
}

/* The integrals of a lane's last step, as the scalar quadrature has them. */
static void extract_quadrature(const fst_crew *c, int l, fst_quadrature *q)
{
    const int width = c->engine->width;
    const fst_lane_view *v = &c->observed.view;
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        q->total[i].high = v->total_high[i * width + l];
        q->total[i].low = v->total_low[i * width + l];
        q->increment[i] = v->increment[i * width + l];
    }
    q->r_reference = v->r_reference[l];
    q->b_reference = v->b_reference[l];
    for (int n = 0; n < FST_PATH_POINTS; ++n) {
        for (int i = 0; i < FST_Q_COUNT; ++i)
            q->integrands[n][i] = v->integrands[(n * FST_Q_COUNT + i) * width + l];
        for (int i = 0; i < FST_TRACK_COUNT; ++i)
            q->tracked[n][i] = v->tracked[(n * FST_TRACK_COUNT + i) * width + l];
    }
    q->has_dense = 0;
}

/* The portable form's records are those of the run. */
static void keep_records(fst_crew *c, int l, const fst_quadrature *q)
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i) {
        const fst_extreme *e = &q->extreme[FST_RECORD_TRACKS[i]];
        c->observed.view.records[i * c->engine->width + l] = fst_record_sign(i) > 0 ? e->greatest : -e->least;
    }
}

/* Whether the orbit repeats itself so closely that later returns can raise no record by what counts (1e-6 after
 * hundreds of returns, or what the integration's errors make of them at loose tolerances): the fast form then
 * looks for extremes no more. */
static int repeats(const fst_run_state *run)
{
    const fst_mark_series *marks = &run->section_marks;
    return marks->offered >= 3 && marks->latest.full_distance < fmax(1e-9, 10.0 * run->params->run_rtol);
}

/* The fast form: set the steps aside in which a record may be beaten. */
void fst_crew_set_aside(fst_crew *c, const unsigned *beaten)
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i)
        for (int l = 0; (beaten[i] & c->tracked) != 0 && l < c->engine->width; ++l)
            if (beaten[i] & c->tracked & fst_lane_bit(l)) {
                c->engine->set_aside(c->observed.batch, l, i, c->slots, c->aside);
                c->set_aside[c->aside].lane = l;
                c->set_aside[c->aside].record = i;
                c->aside += 1;
                if (c->aside == c->engine->width)
                    fst_crew_locate(c);
            }
}

/* A lane's state at the end of its step. */
static void read_end(const fst_crew *c, int l, double end[FST_STATE_SIZE])
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        end[i] = c->observed.view.end[i * c->engine->width + l];
}

/* Tell the lanes between which directions Phi has stayed; where that is more than half a turn, they cannot
 * know. */
void fst_crew_keep_phi_range(fst_crew *c, int l)
{
    const int width = c->engine->width;
    const fst_run_state *run = c->observed.lanes[l].run;
    const double range = run->greatest_phi - run->least_phi;
    if (range > TWO_PI) { /* as fst_run_watch_quietly() has it */
        c->turning |= fst_lane_bit(l);
        return;
    }
    const int known = range >= 0 && range < 3.0;
    c->observed.view.phi_least[l] = known ? cos(run->least_phi) : 0.0;
    c->observed.view.phi_least[width + l] = known ? sin(run->least_phi) : 0.0;
    c->observed.view.phi_most[l] = known ? cos(run->greatest_phi) : 0.0;
    c->observed.view.phi_most[width + l] = known ? sin(run->greatest_phi) : 0.0;
}

/* A step of which nothing but Phi's range is of interest. */
static void watch_phi(fst_crew *c, int l)
{
    fst_run_state *run = c->observed.lanes[l].run;
    double end[FST_STATE_SIZE];
    read_end(c, l, end);
    run->flow->phi = (fst_winding){(int64_t)c->observed.view.turns[0][l], end[FST_X], end[FST_Y]};
    fst_run_watch_quietly(run, 0.0);
    fst_crew_keep_phi_range(c, l);
}

/* A lane's step as the run's own flow has it, the clock, and Phi at its end. */
void fst_crew_extract_step(const fst_crew *c, const fst_squad *s, int l)
{
    fst_flow *flow = s->lanes[l].run->flow;
    c->engine->extract_clock(s->batch, l, flow);
    c->engine->extract(s->batch, l, &flow->step);
    const double *y = flow->step.y;
    flow->phi_start = (fst_winding){(int64_t)s->view.turns_before[0][l], y[FST_X], y[FST_Y]};
    flow->phi = flow->phi_start;
    fst_flow_follow(flow, flow->step.end);
}

/* Whether a step that may end a run does. */
int fst_crew_ends_run(const fst_crew *c, const fst_squad *s, int l)
{
    c->engine->extract_path(s->batch, l, &s->lanes[l].run->flow->step);
    return fst_run_watch_end(s->lanes[l].run);
}

/* Whether a step that is looked at is wanted with its integrals. */
static int needs_integrals(const fst_crew *c, int l, int at_mark)
{
    const fst_run_state *run = c->observed.lanes[l].run;
    return !c->engine->fused || fst_returns_need_integrals(run) ||
           (at_mark && fst_run_period_needs_integrals(run));
}

/* Look closely at a lane's accepted step; 1 if its run is over. */
static int watch(fst_crew *c, int l, fst_lane_events events)
{
    fst_squad *s = &c->observed;
    fst_run_state *run = s->lanes[l].run;
    fst_flow *flow = run->flow;
    fst_crew_extract_step(c, s, l);
    fst_quadrature_begin_phi(&run->q, flow->step.y);
    run->q.small_phi.turns = (int64_t)s->view.turns_before[1][l];
    fst_quadrature_follow(&run->q, flow, flow->step.end);
    if ((events.ending & fst_lane_bit(l)) && fst_crew_ends_run(c, s, l))
        return 1;
    if (needs_integrals(c, l, (events.at_mark & fst_lane_bit(l)) != 0))
        extract_quadrature(c, l, &run->q);
    if (!run->in_window) /* crossings before it were not looked at */
        fst_returns_begin(run);
    run->activity = s->view.activity[l];
    fst_run_watch_step(run);
    s->view.activity[l] = run->activity;
    s->view.turns[0][l] = (double)flow->phi.turns;
    s->view.turns[1][l] = (double)run->q.small_phi.turns;
    s->view.next_mark[l] = fst_next_mark(run);
    c->in_window |= run->in_window ? fst_lane_bit(l) : 0;
    c->tracked &= ~fst_lane_bit(l);
    if (run->in_window && !(c->engine->fused && repeats(run)))
        c->tracked |= fst_lane_bit(l);
    if (!c->engine->fused)
        keep_records(c, l, &run->q);
    fst_crew_keep_phi_range(c, l);
    return flow->t.high >= run->t_end;
}

/* A step that ends a period whose mark is not needed, and holds nothing else. */
static void pass_mark(fst_crew *c, int l)
{
    fst_run_state *run = c->observed.lanes[l].run;
    run->activity = c->observed.view.activity[l];
    fst_run_mark_periods(run);
    c->observed.view.activity[l] =
        c->observed.view.speed[l] > run->activity ? c->observed.view.speed[l] : run->activity;
    c->observed.view.next_mark[l] = fst_next_mark(run);
}

/* Look at the accepted steps that may hold something; the lanes whose runs are over. */
unsigned fst_crew_look(fst_crew *c, fst_lane_events events)
{
    const unsigned wandering = events.wandering & c->in_window & ~c->turning;
    unsigned over = 0;
    for (int l = 0; ((events.close | events.at_mark | wandering) >> l) != 0; ++l) {
        int close = (events.close & fst_lane_bit(l)) != 0;
        if (!close && events.at_mark & fst_lane_bit(l)) {
            c->engine->extract_clock(c->observed.batch, l, c->observed.lanes[l].run->flow);
            close = fst_run_period_needs_integrals(c->observed.lanes[l].run);
            if (!close)
                pass_mark(c, l);
        }
        if (close)
            over |= watch(c, l, events) ? fst_lane_bit(l) : 0;
        else if (wandering & fst_lane_bit(l))
            watch_phi(c, l);
    }
    return over;
}
