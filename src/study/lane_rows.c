/* lane_rows.c - rows in lanes: the engine makes the steps and their integrals, the code of fst_run() looks at
 * them.
 *
 * Each lane has the fst_run_state of its run.  Time, windings and what is to be looked at are followed in the
 * lanes.  A step that may hold an end, a mark or a return to the section is taken out of the lanes into the
 * run's own flow and quadrature, and fst_run_watch_step() does the rest: dense output, locating, marking.  In
 * the portable form new extremes go the same way, so that a row has the bits of fst_run(); in the fast forms
 * the steps that may hold one are set aside, and located as many at a time as there are lanes.
 *
 * In the fast forms there are two batches: in one, runs go up to the end of their discard, in the other they
 * are observed, so that no lane is observed for nothing because its neighbour has to be.
 */
#include "study/lane_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "study/lane_crew.h"

/* ------------------------------------------------------------------ beginning and ending */

static void free_run(fst_lane *at)
{
    if (!at->run)
        return;
    free(at->image);
    at->image = NULL;
    fst_flow_free(at->run->flow);
    fst_model_free(at->run->model);
    free(at->run);
    at->run = NULL;
}

static void move_run(fst_lane *to, fst_lane *from)
{
    *to = *from;
    from->run = NULL;
    from->image = NULL;
    to->options.start = to->job.has_start ? to->job.start : NULL;
    to->run->params = &to->job.params;
    to->run->options = &to->options;
}

/* The run of a lane is no longer there. */
static void vacate(fst_crew *c, fst_squad *s, int l)
{
    c->engine->release(s->batch, l);
    s->occupied -= 1;
    if (s == &c->observed) {
        c->in_window &= ~fst_lane_bit(l);
        c->tracked &= ~fst_lane_bit(l);
        c->turning &= ~fst_lane_bit(l);
    }
}

/* Runs that are on their way to their ends. */
static int on_their_way(const fst_crew *c)
{
    return c->run_up.occupied + c->observed.occupied + c->ready_count;
}

/* These, and those at their ends whose exponents are wanted. */
static int at_work(const fst_crew *c)
{
    return on_their_way(c) + c->parked_count;
}

/* Whether a model can share the batches with those at work. */
static int fits(const fst_crew *c, const fst_model *model)
{
    return at_work(c) == 0 || fst_kinds_equal(&c->kind.kinds, &model->coefficients.kinds);
}

typedef enum { BEGUN, REFUSED, FAILED } beginning;

/* Begin the job of `at`.  FAILED: `error` says why; REFUSED: it has to wait until nothing is at work. */
static beginning begin(fst_crew *c, fst_lane *at, fst_status *status, fst_error *error)
{
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
    c->kind = run->model->coefficients;
    run->extremes_elsewhere = c->engine->fused;
    run->exponent_elsewhere = 1;
    run->sparse_marks = 1;
    return BEGUN;
}

/* Hand over the result of a job; 1 if another one follows in its place. */
static int hand_over(fst_crew *c, fst_lane *at, fst_status status, const fst_run_result *result,
                     const fst_error *error)
{
    return c->work->done(c->work->user, &at->job, status, result, error);
}

static int idle_lane(const fst_crew *c, const fst_squad *s)
{
    int l = 0;
    while (l < c->engine->width && s->lanes[l].run)
        ++l;
    return l;
}

/* A run is to be observed from now on. */
static void enter_observed(fst_crew *c, int l, fst_lane *from)
{
    fst_squad *s = &c->observed;
    move_run(&s->lanes[l], from);
    fst_run_state *run = s->lanes[l].run;
    s->occupied += 1;
    c->engine->load(s->batch, l, run->flow, run->t_end);
    s->view.next_mark[l] = fst_next_mark(run);
    if (run->in_window) { /* it comes from the run-up */
        c->in_window |= fst_lane_bit(l);
        c->tracked |= fst_lane_bit(l);
        s->view.r_reference[l] = run->q.r_reference;
        s->view.b_reference[l] = run->q.b_reference;
        fst_crew_keep_phi_range(c, l);
    }
    if (s->lanes[l].image)
        fst_crew_restore(c, s, l);
}

static void enter_run_up(fst_crew *c, int l, fst_lane *from)
{
    fst_squad *s = &c->run_up;
    move_run(&s->lanes[l], from);
    s->occupied += 1;
    c->engine->load(s->batch, l, s->lanes[l].run->flow, s->lanes[l].run->t_discard);
    if (s->lanes[l].image)
        fst_crew_restore(c, s, l);
}

/* A run that was begun, or taken up, goes to its place. */
static void place(fst_crew *c, fst_lane *fresh)
{
    const int runs_up = c->engine->fused && fresh->run->t_discard > 0;
    const fst_run_stage stage = fresh->image ? fresh->place.stage
                                : runs_up    ? FST_STAGE_RUN_UP
                                             : FST_STAGE_READY;
    if (stage == FST_STAGE_RUN_UP) {
        enter_run_up(c, idle_lane(c, &c->run_up), fresh);
        return;
    }
    fst_lane *to = stage == FST_STAGE_PARKED ? &c->parked[c->parked_count++] : &c->ready[c->ready_count++];
    move_run(to, fresh);
    if (stage == FST_STAGE_OBSERVED)
        return; /* the image is wanted when there is a lane */
    free(to->image);
    to->image = NULL;
}

/* Begin the next job, or put it aside if it does not fit; 0 if there is none. */
static int admit(fst_crew *c)
{
    fst_lane fresh = {.run = NULL};
    for (int has_job = 0;;) {
        if (!has_job && c->waiting_count > 0) {
            fresh.job = c->waiting[--c->waiting_count];
        } else if (!has_job && (c->no_more || !c->work->next(c->work->user, &fresh.job))) {
            c->no_more = 1;
            return 0;
        }
        fst_status status;
        fst_error error = {FST_OK, "", ""};
        const beginning begun = begin(c, &fresh, &status, &error);
        if (begun == REFUSED) {
            c->misfits[c->misfit_count++] = fresh.job;
            return 1;
        }
        if (begun == BEGUN)
            break;
        fst_run_result nothing;
        fst_result_clear(&nothing);
        has_job = hand_over(c, &fresh, status, &nothing, &error);
    }
    fst_crew_take_up(c, &fresh);
    place(c, &fresh);
    return 1;
}

/* Idle lanes take runs that are ready, and new jobs; those that do not fit wait until nothing is at work. */
static void occupy_idle(fst_crew *c)
{
    const int width = c->engine->width;
    const fst_squad *entrance = c->engine->fused ? &c->run_up : &c->observed;
    while (at_work(c) == 0 && c->misfit_count > 0)
        c->waiting[c->waiting_count++] = c->misfits[--c->misfit_count];
    do {
        while (c->ready_count > 0 && c->observed.occupied < width)
            enter_observed(c, idle_lane(c, &c->observed), &c->ready[--c->ready_count]);
    } while (c->ready_count == 0 && entrance->occupied < width && c->misfit_count < FST_MOST_MISFITS &&
             c->parked_count < width && admit(c));
}

/* The run of a lane is over; `status` other than FST_OK: it failed. */
static void finish(fst_crew *c, fst_squad *s, int l, fst_status status, fst_error *error)
{
    fst_lane *at = &s->lanes[l];
    fst_run_result result;
    fst_result_clear(&result);
    if (c->aside > 0)
        fst_crew_locate(c);
    if (status == FST_OK)
        status = fst_run_conclude(at->run, &result, error);
    vacate(c, s, l);
    if (status == FST_OK && at->run->exponent_is == FST_EXPONENT_WANTED) {
        move_run(&c->parked[c->parked_count++], at);
        return;
    }
    free_run(at);
    if (hand_over(c, at, status, &result, error))
        c->waiting[c->waiting_count++] = at->job;
}

static fst_status watch_exponents(void *user, double fraction, fst_error *error)
{
    (void)fraction;
    return fst_crew_stopped(user) ? fst_fail(error, FST_INTERRUPTED, "", "interrupted") : FST_OK;
}

/* The exponents of runs that are parked, side by side too: the last ones, as many as there are lanes. */
static fst_status conclude_parked(fst_crew *c, fst_error *error)
{
    fst_exponent *asked[FST_MOST_LANES] = {NULL};
    const int count = c->parked_count < c->engine->width ? c->parked_count : c->engine->width;
    fst_lane *last = c->parked + (c->parked_count - count);
    for (int i = 0; i < count; ++i)
        asked[i] = &last[i].run->exponent;
    const fst_progress progress = {c, watch_exponents};
    const fst_status status = fst_largest_exponents(&c->engine->tangents, asked, count, &progress, error);
    for (int i = 0; status == FST_OK && i < count; ++i) {
        fst_lane *at = &last[i];
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

static void conclude(fst_crew *c, fst_squad *s, int l)
{
    fst_error error = {FST_OK, "", ""};
    finish(c, s, l, FST_OK, &error);
}

static void give_up(fst_crew *c, fst_squad *s, int l)
{
    fst_flow *flow = s->lanes[l].run->flow;
    fst_error error = {FST_OK, "", ""};
    c->engine->extract(s->batch, l, &flow->step);
    c->engine->extract_clock(s->batch, l, flow);
    finish(c, s, l, fst_flow_fail(flow, &error), &error);
}

/* A step in every lane of those that are observed. */
static void step_observed(fst_crew *c)
{
    fst_squad *s = &c->observed;
    const fst_lane_tries tries = c->engine->try_steps(s->batch);
    const unsigned accepted = tries.accepted;
    fst_lane_events events = c->engine->watch(s->batch, accepted, accepted, c->in_window);
    unsigned beaten[FST_RECORD_COUNT] = {0};
    /* In the fast form, a run that is not in its window yet has no discard: its first step is in it. */
    const unsigned tracked = c->engine->fused ? c->tracked | ~c->in_window : c->tracked;
    if (accepted)
        c->engine->observe(s->batch, accepted, c->in_window, tracked, beaten);
    for (int i = 0; !c->engine->fused && i < FST_RECORD_COUNT; ++i)
        events.close |= beaten[i];
    const unsigned over = fst_crew_look(c, events);
    if (c->engine->fused)
        fst_crew_set_aside(c, beaten);
    c->engine->advance(s->batch, accepted & ~over);
    for (int l = 0; (over | tries.failed) != 0 && l < c->engine->width; ++l) {
        if (over & fst_lane_bit(l))
            conclude(c, s, l);
        else if (tries.failed & fst_lane_bit(l))
            give_up(c, s, l);
    }
}

/* ------------------------------------------------------------------ before the window */

/* The discard of a run is over: its window begins with the state that it has. */
static void open_window(fst_crew *c, int l)
{
    fst_squad *s = &c->run_up;
    fst_run_state *run = s->lanes[l].run;
    run->activity = s->view.activity[l];
    fst_quadrature_begin_phi(&run->q, run->flow->step.end);
    fst_run_mark_periods(run);
    fst_flow_restart(run->flow);
    fst_quadrature_set_references(&run->q, run->flow);
    fst_returns_begin(run);
    fst_run_watch_quietly(run, 0.0);
    vacate(c, s, l);
    move_run(&c->ready[c->ready_count++], &s->lanes[l]);
}

/* A step in every lane of those that are not. */
static void step_run_up(fst_crew *c)
{
    fst_squad *s = &c->run_up;
    const fst_lane_tries tries = c->engine->try_steps(s->batch);
    const fst_lane_events events = c->engine->watch(s->batch, tries.accepted, 0, 0);
    unsigned over = 0;
    for (int l = 0; (events.close >> l) != 0; ++l)
        if (events.close & fst_lane_bit(l)) {
            fst_crew_extract_step(c, s, l);
            s->view.turns[0][l] = (double)s->lanes[l].run->flow->phi.turns;
            s->view.activity[l] = fmax(s->view.activity[l], s->view.speed[l]);
            over |= (events.ending & fst_lane_bit(l)) && fst_crew_ends_run(c, s, l) ? fst_lane_bit(l) : 0;
        }
    c->engine->advance(s->batch, tries.accepted & ~(over | tries.landed));
    for (int l = 0; (over | tries.landed | tries.failed) != 0 && l < c->engine->width; ++l) {
        if (over & fst_lane_bit(l))
            conclude(c, s, l);
        else if (tries.landed & fst_lane_bit(l))
            open_window(c, l);
        else if (tries.failed & fst_lane_bit(l))
            give_up(c, s, l);
    }
}

/* ------------------------------------------------------------------ */

static int make_squad(const fst_lane_engine *engine, fst_squad *s)
{
    s->batch = aligned_alloc(64, (engine->bytes + 63) / 64 * 64);
    if (!s->batch)
        return 0;
    memset(s->batch, 0, engine->bytes);
    engine->view(s->batch, &s->view);
    return 1;
}

static fst_crew *make_crew(const fst_row_work *work, const fst_row_images *images,
                           const fst_lane_engine *engine)
{
    fst_crew *c = calloc(1, sizeof *c);
    if (!c)
        return NULL;
    c->work = work;
    c->images = fst_run_images_possible() ? images : NULL;
    c->engine = engine;
    const size_t bytes = (engine->slots_bytes + 63) / 64 * 64;
    c->slots = bytes > 0 ? aligned_alloc(64, bytes) : NULL;
    if (c->slots)
        memset(c->slots, 0, bytes);
    if ((c->slots || bytes == 0) && make_squad(engine, &c->observed) && make_squad(engine, &c->run_up))
        return c;
    free(c->run_up.batch);
    free(c->observed.batch);
    free(c->slots);
    free(c);
    return NULL;
}

static void free_crew(fst_crew *c)
{
    for (int l = 0; l < c->engine->width; ++l) {
        free_run(&c->run_up.lanes[l]);
        free_run(&c->observed.lanes[l]);
    }
    for (int i = 0; i < c->ready_count; ++i)
        free_run(&c->ready[i]);
    for (int i = 0; i < c->parked_count; ++i)
        free_run(&c->parked[i]);
    free(c->run_up.batch);
    free(c->observed.batch);
    free(c->slots);
    free(c);
}

fst_status fst_lane_rows(const fst_row_work *work, const fst_row_images *images, const fst_lane_engine *engine,
                         fst_error *error)
{
    fst_crew *c = make_crew(work, images, engine);
    if (!c)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    fst_status status = FST_OK;
    occupy_idle(c);
    for (unsigned steps = 1; status == FST_OK && at_work(c) > 0; ++steps) {
        /* Those that are observed wait until they are as many as lanes, or no more are to come. */
        if (c->observed.occupied == engine->width || (c->run_up.occupied == 0 && c->observed.occupied > 0))
            step_observed(c);
        else if (c->run_up.occupied > 0)
            step_run_up(c);
        occupy_idle(c);
        while (status == FST_OK &&
               (c->parked_count >= engine->width || (on_their_way(c) == 0 && c->parked_count > 0))) {
            status = conclude_parked(c, error);
            occupy_idle(c);
        }
        if (status == FST_OK && steps % 64 == 0 && fst_crew_stopped(c))
            status = fst_fail(error, FST_INTERRUPTED, "", "interrupted");
    }
    free_crew(c);
    return status;
}
