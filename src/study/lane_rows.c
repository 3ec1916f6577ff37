/* lane_rows.c - rows in lanes: the engine makes the steps and their integrals, the code of fst_run() looks at
 * them.
 *
 * Each lane has the fst_run_state of its run.  Time, windings and what is to be looked at are followed in the
 * lanes.  A step that may hold an end, a mark or a return to the section is taken out of the lanes into the
 * run's own flow and quadrature, and fst_run_watch_step() does the rest: dense output, locating, marking.  In
 * the portable form new extremes go the same way, so that a row has the bits of fst_run(); in the fast forms
 * the steps that may hold one are set aside, and located as many at a time as there are lanes.
 */
#include "study/lane_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "ode/path_stages.h"
#include "study/run_state.h"

typedef struct lane {
    fst_run_state *run; /* NULL: idle */
    fst_row_job job;
    fst_run_options options;
} lane;

typedef struct crew {
    const fst_row_work *work;
    const fst_lane_engine *engine;
    void *batch;
    fst_lane_view view;
    lane lanes[FST_MOST_LANES];
    double observe_from[FST_MOST_LANES]; /* steps that end later are taken into the integrals */
    unsigned observed, in_window;        /* lanes whose steps are, and those in their window */
    unsigned tracked;                    /* those in which extremes are looked for */
    unsigned turning;                    /* those whose Phi has gone so far that its range no longer matters */
    void *slots;                         /* the fast form: steps that were set aside, */
    struct {
        int lane, record;
    } set_aside[FST_MOST_LANES]; /* and for what */
    int aside;
    int occupied;
    lane parked[2 * FST_MOST_LANES]; /* runs to their ends whose exponents are wanted: less than a batch, and */
    int parked_count;                /* those of one step, in which all lanes may end */
    fst_row_job waiting[3 * FST_MOST_LANES]; /* jobs for lanes to come: as many as were in lanes or parked */
    int waiting_count;
    int misfit; /* one of them shares no batch with those at work */
    int no_more;
} crew;

static unsigned bit(int l)
{
    return 1u << l;
}

/* ------------------------------------------------------------------ beginning and ending */

static void free_run(lane *at)
{
    if (!at->run)
        return;
    fst_flow_free(at->run->flow);
    fst_model_free(at->run->model);
    free(at->run);
    at->run = NULL;
}

/* The run of a lane is no longer there. */
static void vacate(crew *c, int l)
{
    c->engine->release(c->batch, l);
    c->observed &= ~bit(l);
    c->in_window &= ~bit(l);
    c->tracked &= ~bit(l);
    c->turning &= ~bit(l);
    c->occupied -= 1;
}

/* Whether a model can share the batch with those in it: the integers of its coefficients are the same. */
static int fits(const crew *c, const fst_model *model)
{
    for (int l = 0; l < c->engine->width; ++l)
        if (c->lanes[l].run) {
            const fst_coefficients_double *a = &c->lanes[l].run->model->coefficients, *b = &model->coefficients;
            return a->lines == b->lines && a->magnetisable == b->magnetisable &&
                   a->gyroscopic_term_lost == b->gyroscopic_term_lost;
        }
    return 1;
}

static double next_mark(const fst_run_state *run)
{
    return run->t_discard + (double)run->next_period * run->drive_period;
}

typedef enum { BEGUN, REFUSED, FAILED } beginning;

/* Begin the job of a lane.  FAILED: `error` says why; REFUSED: it has to wait until the batch is empty. */
static beginning begin(crew *c, int l, fst_status *status, fst_error *error)
{
    lane *at = &c->lanes[l];
    fst_run_state *run = calloc(1, sizeof *run);
    if (!run) {
        *status = fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
        return FAILED;
    }
    at->options = fst_default_run_options();
    at->options.start = at->job.has_start ? at->job.start : NULL;
    run->params = &at->job.params;
    run->options = &at->options;
    *status = fst_run_begin(run, error);
    const int refused = *status == FST_OK && !fits(c, run->model);
    if (*status != FST_OK || refused) {
        fst_flow_free(run->flow);
        fst_model_free(run->model);
        free(run);
        return refused ? REFUSED : FAILED;
    }
    at->run = run;
    run->extremes_elsewhere = c->engine->fused;
    run->exponent_elsewhere = 1;
    run->sparse_marks = 1;
    c->occupied += 1;
    c->engine->load(c->batch, l, run->flow, run->t_end);
    c->view.next_mark[l] = next_mark(run);
    /* In the fast form, integrals begin with the step that the discard ends in. */
    c->observe_from[l] = c->engine->fused ? run->t_discard : -INFINITY;
    return BEGUN;
}

/* Hand over the result of a job; 1 if another one follows in its place. */
static int hand_over(crew *c, lane *at, fst_status status, const fst_run_result *result, const fst_error *error)
{
    return c->work->done(c->work->user, &at->job, status, result, error);
}

static void occupy(crew *c, int l, int has_job)
{
    lane *at = &c->lanes[l];
    for (;;) {
        if (!has_job && c->waiting_count > 0) {
            at->job = c->waiting[--c->waiting_count];
        } else if (!has_job && (c->no_more || !c->work->next(c->work->user, &at->job))) {
            c->no_more = 1;
            return;
        }
        fst_status status;
        fst_error error = {FST_OK, "", ""};
        switch (begin(c, l, &status, &error)) {
        case BEGUN:
            return;
        case REFUSED:
            c->waiting[c->waiting_count++] = at->job;
            c->misfit = 1;
            return;
        case FAILED:
            break;
        }
        fst_run_result nothing;
        fst_result_clear(&nothing);
        has_job = hand_over(c, at, status, &nothing, &error);
    }
}

/* Idle lanes take new jobs; where one fits not in, not before the batch is empty. */
static void occupy_idle(crew *c)
{
    c->misfit &= c->occupied > 0;
    for (int l = 0; l < c->engine->width; ++l)
        if (!c->lanes[l].run && !c->misfit)
            occupy(c, l, 0);
}

/* Locate the extremes that were set aside. */
static void locate(crew *c)
{
    double values[FST_MOST_LANES];
    c->engine->locate(c->slots, values);
    for (int i = 0; i < c->aside; ++i) {
        const int record = c->set_aside[i].record;
        fst_extreme *e = &c->lanes[c->set_aside[i].lane].run->q.extreme[FST_RECORD_TRACKS[record]];
        if (fst_record_sign(record) > 0)
            e->greatest = values[i] > e->greatest ? values[i] : e->greatest;
        else
            e->least = -values[i] < e->least ? -values[i] : e->least;
    }
    c->aside = 0;
}

/* Put the run of a lane where those are whose exponents are wanted. */
static void park(crew *c, int l)
{
    lane *to = &c->parked[c->parked_count++], *from = &c->lanes[l];
    *to = *from;
    from->run = NULL;
    to->run->params = &to->job.params;
    to->run->options = &to->options;
    vacate(c, l);
}

/* The run of a lane is over; `status` other than FST_OK: it failed. */
static void finish(crew *c, int l, fst_status status, fst_error *error)
{
    lane *at = &c->lanes[l];
    fst_run_result result;
    fst_result_clear(&result);
    if (c->aside > 0)
        locate(c);
    if (status == FST_OK)
        status = fst_run_conclude(at->run, &result, error);
    if (status == FST_OK && at->run->exponent_is == FST_EXPONENT_WANTED) {
        park(c, l);
        return;
    }
    free_run(at);
    vacate(c, l);
    if (hand_over(c, at, status, &result, error))
        occupy(c, l, 1);
}

/* The exponents of runs that are parked, side by side too: the last ones, as many as there are lanes. */
static fst_status conclude_parked(crew *c, fst_error *error)
{
    fst_exponent *asked[FST_MOST_LANES] = {NULL};
    const int count = c->parked_count < c->engine->width ? c->parked_count : c->engine->width;
    lane *last = c->parked + (c->parked_count - count);
    for (int i = 0; i < count; ++i)
        asked[i] = &last[i].run->exponent;
    const fst_status status = fst_largest_exponents(&c->engine->tangents, asked, count, error);
    for (int i = 0; status == FST_OK && i < count; ++i) {
        lane *at = &last[i];
        fst_run_result result;
        fst_error own = {FST_OK, "", ""};
        fst_result_clear(&result);
        at->run->exponent_is = FST_EXPONENT_KNOWN;
        const fst_status concluded = fst_run_conclude(at->run, &result, &own);
        free_run(at);
        if (hand_over(c, at, concluded, &result, &own))
            c->waiting[c->waiting_count++] = at->job;
    }
    c->parked_count -= status == FST_OK ? count : 0;
    return status;
}

/* ------------------------------------------------------------------ steps */

/* The integrals of a lane's last step, as the scalar quadrature has them. */
static void extract_quadrature(const crew *c, int l, fst_quadrature *q)
{
    const int width = c->engine->width;
    const fst_lane_view *v = &c->view;
    for (int i = 0; i < FST_Q_COUNT; ++i) {
        q->total[i].high = v->total_high[i * width + l];
        q->total[i].low = v->total_low[i * width + l];
        q->increment[i] = v->increment[i * width + l];
    }
    q->r_reference = v->r_reference[l];
    q->b_reference = v->b_reference[l];
    for (int n = 0; n < FST_PATH_STAGES; ++n) {
        for (int i = 0; i < FST_Q_COUNT; ++i)
            q->stage[FST_PATH_STAGE[n]][i] = v->integrands[(n * FST_Q_COUNT + i) * width + l];
        for (int i = 0; i < FST_TRACK_COUNT; ++i)
            q->tracked[n][i] = v->tracked[(n * FST_TRACK_COUNT + i) * width + l];
    }
    q->has_dense = 0;
}

/* The portable form's records are those of the run. */
static void keep_records(crew *c, int l, const fst_quadrature *q)
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i) {
        const fst_extreme *e = &q->extreme[FST_RECORD_TRACKS[i]];
        c->view.records[i * c->engine->width + l] = fst_record_sign(i) > 0 ? e->greatest : -e->least;
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
static void set_aside(crew *c, const unsigned *beaten)
{
    for (int i = 0; i < FST_RECORD_COUNT; ++i)
        for (int l = 0; (beaten[i] & c->tracked) != 0 && l < c->engine->width; ++l)
            if (beaten[i] & c->tracked & bit(l)) {
                c->engine->set_aside(c->batch, l, i, c->slots, c->aside);
                c->set_aside[c->aside].lane = l;
                c->set_aside[c->aside].record = i;
                c->aside += 1;
                if (c->aside == c->engine->width)
                    locate(c);
            }
}

/* A lane's state at the end of its step. */
static void read_end(const crew *c, int l, double end[FST_STATE_SIZE])
{
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        end[i] = c->view.end[i * c->engine->width + l];
}

/* Tell the lanes between which directions Phi has stayed; where that is more than half a turn, they cannot
 * know. */
static void keep_phi_range(crew *c, int l)
{
    const int width = c->engine->width;
    const fst_run_state *run = c->lanes[l].run;
    const double range = run->greatest_phi - run->least_phi;
    if (range > 7.0) {
        c->turning |= bit(l);
        return;
    }
    const int known = range >= 0 && range < 3.0;
    c->view.phi_least[l] = known ? cos(run->least_phi) : 0.0;
    c->view.phi_least[width + l] = known ? sin(run->least_phi) : 0.0;
    c->view.phi_most[l] = known ? cos(run->greatest_phi) : 0.0;
    c->view.phi_most[width + l] = known ? sin(run->greatest_phi) : 0.0;
}

/* A step of which nothing but Phi's range is of interest. */
static void watch_phi(crew *c, int l)
{
    fst_run_state *run = c->lanes[l].run;
    double end[FST_STATE_SIZE];
    read_end(c, l, end);
    run->flow->phi = (fst_winding){(int64_t)c->view.turns[0][l], end[FST_X], end[FST_Y]};
    fst_run_watch_quietly(run, 0.0);
    keep_phi_range(c, l);
}

/* A lane's step as the run's own flow has it, and Phi and phi at its end. */
static void extract_step(crew *c, int l, int observed)
{
    fst_run_state *run = c->lanes[l].run;
    fst_flow *flow = run->flow;
    c->engine->extract(c->batch, l, &flow->step);
    const double *y = flow->step.y;
    flow->phi_start = (fst_winding){(int64_t)c->view.turns_before[0][l], y[FST_X], y[FST_Y]};
    flow->phi = flow->phi_start;
    fst_flow_follow(flow, flow->step.end);
    if (observed) {
        fst_quadrature_begin_phi(&run->q, y);
        run->q.small_phi.turns = (int64_t)c->view.turns_before[1][l];
        fst_quadrature_follow(&run->q, flow, flow->step.end);
    }
}

/* Whether a step that is looked at is wanted with its integrals. */
static int needs_integrals(const crew *c, int l, int at_mark)
{
    const fst_run_state *run = c->lanes[l].run;
    return !c->engine->fused || fst_returns_need_integrals(run) ||
           (at_mark && fst_run_period_needs_integrals(run));
}

/* Look closely at a lane's accepted step; 1 if its run is over. */
static int watch(crew *c, int l, fst_lane_events events)
{
    fst_run_state *run = c->lanes[l].run;
    fst_flow *flow = run->flow;
    c->engine->extract_clock(c->batch, l, flow);
    extract_step(c, l, (c->observed & bit(l)) != 0);
    if (events.ending & bit(l)) {
        c->engine->extract_stages(c->batch, l, &flow->step);
        if (fst_run_watch_end(run))
            return 1;
    }
    if (needs_integrals(c, l, (events.at_mark & bit(l)) != 0))
        extract_quadrature(c, l, &run->q);
    if (!run->in_window) /* crossings before it were not looked at */
        fst_returns_begin(run);
    run->activity = c->view.activity[l];
    fst_run_watch_step(run);
    c->view.activity[l] = run->activity;
    c->view.turns[0][l] = (double)flow->phi.turns;
    c->view.turns[1][l] = (double)run->q.small_phi.turns;
    c->view.next_mark[l] = next_mark(run);
    c->in_window |= run->in_window ? bit(l) : 0;
    c->tracked &= ~bit(l);
    if (run->in_window && !(c->engine->fused && repeats(run)))
        c->tracked |= bit(l);
    if (!c->engine->fused)
        keep_records(c, l, &run->q);
    keep_phi_range(c, l);
    return flow->t.high >= run->t_end;
}

/* A step that ends a period whose mark is not needed, and holds nothing else. */
static void pass_mark(crew *c, int l)
{
    fst_run_state *run = c->lanes[l].run;
    run->activity = c->view.activity[l];
    fst_run_mark_periods(run);
    c->view.activity[l] = c->view.speed[l] > run->activity ? c->view.speed[l] : run->activity;
    c->view.next_mark[l] = next_mark(run);
}

/* Look at the accepted steps that may hold something; the lanes whose runs are over. */
static unsigned look_at_steps(crew *c, fst_lane_events events)
{
    const unsigned wandering = events.wandering & c->in_window & ~c->turning;
    unsigned over = 0;
    for (int l = 0; ((events.close | events.at_mark | wandering) >> l) != 0; ++l) {
        int close = (events.close & bit(l)) != 0;
        if (!close && events.at_mark & bit(l)) {
            c->engine->extract_clock(c->batch, l, c->lanes[l].run->flow);
            close = fst_run_period_needs_integrals(c->lanes[l].run);
            if (!close)
                pass_mark(c, l);
        }
        if (close)
            over |= watch(c, l, events) ? bit(l) : 0;
        else if (wandering & bit(l))
            watch_phi(c, l);
    }
    return over;
}

static void conclude(crew *c, int l)
{
    fst_error error = {FST_OK, "", ""};
    finish(c, l, FST_OK, &error);
}

static void give_up(crew *c, int l)
{
    fst_flow *flow = c->lanes[l].run->flow;
    fst_error error = {FST_OK, "", ""};
    c->engine->extract(c->batch, l, &flow->step);
    c->engine->extract_clock(c->batch, l, flow);
    finish(c, l, fst_flow_fail(flow, &error), &error);
}

/* In the fast form the first step that is observed is the one in which the window begins. */
static unsigned tracked_soon(const crew *c)
{
    return c->engine->fused ? c->observed & ~c->in_window : 0;
}

static void step(crew *c)
{
    const fst_lane_tries tries = c->engine->try_steps(c->batch);
    const unsigned accepted = tries.accepted;
    c->observed |= c->engine->past(c->batch, accepted & ~c->observed, c->observe_from);
    const unsigned observed = accepted & c->observed;
    fst_lane_events events = c->engine->watch(c->batch, accepted, observed, c->in_window);
    unsigned beaten[FST_RECORD_COUNT] = {0};
    if (observed)
        c->engine->observe(c->batch, observed, c->in_window, c->tracked | tracked_soon(c), beaten);
    for (int i = 0; !c->engine->fused && i < FST_RECORD_COUNT; ++i)
        events.close |= beaten[i];
    const unsigned over = look_at_steps(c, events);
    if (c->engine->fused)
        set_aside(c, beaten);
    c->engine->advance(c->batch, accepted & ~over);
    for (int l = 0; (over | tries.failed) != 0 && l < c->engine->width; ++l) {
        if (over & bit(l))
            conclude(c, l);
        else if (tries.failed & bit(l))
            give_up(c, l);
    }
}

/* ------------------------------------------------------------------ */

fst_status fst_lane_rows(const fst_row_work *work, const fst_lane_engine *engine, fst_error *error)
{
    crew *c = calloc(1, sizeof *c);
    void *batch = aligned_alloc(64, (engine->bytes + 63) / 64 * 64);
    void *slots = engine->slots_bytes > 0 ? aligned_alloc(64, (engine->slots_bytes + 63) / 64 * 64) : NULL;
    fst_status status = c && batch && (slots || engine->slots_bytes == 0)
                            ? FST_OK
                            : fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    if (status == FST_OK) {
        memset(batch, 0, engine->bytes);
        c->work = work;
        c->engine = engine;
        c->batch = batch;
        c->slots = slots;
        if (slots)
            memset(slots, 0, engine->slots_bytes);
        engine->view(batch, &c->view);
        occupy_idle(c);
    }
    for (unsigned steps = 1; status == FST_OK && c->occupied > 0; ++steps) {
        step(c);
        occupy_idle(c);
        while (status == FST_OK &&
               (c->parked_count >= engine->width || (c->occupied == 0 && c->parked_count > 0))) {
            status = conclude_parked(c, error);
            occupy_idle(c);
        }
        if (status == FST_OK && steps % 64 == 0 && work->stopped(work->user))
            status = fst_fail(error, FST_INTERRUPTED, "", "interrupted");
    }
    for (int l = 0; c && l < engine->width; ++l)
        free_run(&c->lanes[l]);
    for (int i = 0; c && i < c->parked_count; ++i)
        free_run(&c->parked[i]);
    free(slots);
    free(batch);
    free(c);
    return status;
}
