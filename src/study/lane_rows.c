/* lane_rows.c - rows in lanes: which run is in which lane, and when.
 *
 * An engine (lanes.h) makes one step of every lane of a batch at once, and adds up the integrals.  Everything
 * else about a run is the code of fst_run(): each lane has a watched run of its own, whose window observes it.
 * That code would cost more than the step, so a step is taken out of its lane only when it may hold something:
 * the end of the run, a mark, a return to the section, an extreme.  The engine tells which steps may;
 * lane_watch.c looks at them.
 *
 * A row's way, in the fast form:
 *
 *     next job ----> run-up batch ----> ready ----> observed batch ----> parked ----> result
 *                    (discard)          (queue)     (window)             (queue)
 *                        |                              |                   |
 *                        +--- ejected, lifted ----------+--- regime known --+--- exponent found: many at once
 *
 * There are two batches so that no lane is observed for nothing because its neighbour has to be.  A run without
 * a discard starts in the queue of ready ones.  The observed batch makes its steps when all its lanes are
 * occupied, or no run is left before it; in between the run-up batch makes its own:
 *
 *     run-up     |a b c d|   |a - c d|   |a e c d|    the discard of b is over: its window opens, and b goes to
 *     ready                      b                    the queue; a new job, e, takes its lane
 *     observed   |- - - -|   |- - - -|   |b - - -|
 *
 * The portable form has the bits of fst_run(), which opens a window within a step; so there all runs begin in
 * the observed batch, and new extremes are looked for by the window's own code.  In the fast form steps that
 * may hold an extreme are set aside, and located as many at a time as there are lanes.
 *
 * A batch shares the integers of its models: number of lines, material, dynamics.  A job that differs is
 * deferred until nothing is at work; the next batch then takes its kind.  Some motions need their largest
 * exponent to be told (conclude.h).  Their runs are parked until there are as many as lanes, and followed side
 * by side too.
 *
 * Runs with dry friction have an engine of their own, which takes the place of the usual one while nothing is
 * at work, and modes that end in a step (lane_contact.c).  Those with a disc of contact or with flight are done
 * alone, while the lanes wait.
 *
 * No row's bits depend on any of this: lanes do not mix (only the order in which rows come out does).
 */
#include "study/lane_rows.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "study/conclude.h"
#include "study/lane_worker.h"
#include "study/lone_run.h"

/* ------------------------------------------------------------------ beginning and ending */

static void free_run(fst_lane *at)
{
    if (!at->run)
        return;
    free(at->image);
    at->image = NULL;
    fst_watched_run_free(at->run);
    free(at->run);
    at->run = NULL;
    free(at->exponent);
    at->exponent = NULL;
}

static void move_run(fst_lane *to, fst_lane *from)
{
    *to = *from;
    from->run = NULL;
    from->image = NULL;
    from->exponent = NULL;
    to->run->params = &to->job.params;
}

/* The run of a lane is no longer there. */
static void vacate(fst_row_worker *w, fst_lane_batch *b, int l)
{
    w->engine->release(b->memory, l);
    b->occupied -= 1;
    if (b == &w->observed) {
        w->in_window &= ~fst_lane_bit(l);
        w->tracked &= ~fst_lane_bit(l);
        w->turning &= ~fst_lane_bit(l);
    }
}

/* Runs that are on their way to their ends. */
static int on_their_way(const fst_row_worker *w)
{
    return w->run_up.occupied + w->observed.occupied + w->ready_count;
}

/* These, and those at their ends whose exponents are wanted. */
static int at_work(const fst_row_worker *w)
{
    return on_their_way(w) + w->parked_count;
}

/* Whether a model can share the batches with those at work. */
static int fits(const fst_row_worker *w, const fst_model *model)
{
    return at_work(w) == 0 || fst_kinds_equal(&w->kind.kinds, &model->coefficients.kinds);
}

typedef enum { BEGUN, REFUSED, ALONE, FAILED } beginning;

/* Whether lanes know the contact of a model. */
static int lanes_know(const fst_kinds *kinds)
{
    return !kinds->dry || (kinds->patch == FST_PATCH_POINT && !kinds->flies && !kinds->resists);
}

/* Change the engine, while nothing is at work. */
static void use_engine(fst_row_worker *w, const fst_lane_engine *engine)
{
    fst_lane_batch *batches[] = {&w->observed, &w->run_up};
    if (engine == w->engine)
        return;
    w->engine = engine;
    memset(w->pending_steps, 0, engine->waiting_bytes);
    for (int i = 0; i < 2; ++i) {
        memset(batches[i]->memory, 0, engine->bytes);
        engine->view(batches[i]->memory, &batches[i]->view);
    }
}

/* Begin the job of `at`.  FAILED: `error` says why; REFUSED: it has to wait until nothing is at work; ALONE: it
 * is one for no lane. */
static beginning begin(fst_row_worker *w, fst_lane *at, fst_status *status, fst_error *error)
{
    fst_watched_run *run = calloc(1, sizeof *run);
    if (!run) {
        *status = fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
        return FAILED;
    }
    *status = fst_watched_run_begin(run, &at->job.params, at->job.has_start ? at->job.start : NULL, error);
    const int alone = *status == FST_OK && !lanes_know(&run->model->coefficients.kinds);
    const int refused = *status == FST_OK && !alone && !fits(w, run->model);
    if (*status != FST_OK || refused || alone) {
        fst_watched_run_free(run);
        free(run);
        return alone ? ALONE : refused ? REFUSED : FAILED;
    }
    if (at_work(w) == 0)
        use_engine(w, run->model->coefficients.kinds.dry ? w->dry : w->usual);
    at->run = run;
    w->kind = run->model->coefficients;
    run->window.span.asked_at_end = 1;
    return BEGUN;
}

/* Hand over the result of a job; 1 if another one follows in its place. */
static int hand_over(fst_row_worker *w, fst_lane *at, fst_status status, const fst_run_result *result,
                     const fst_error *error)
{
    return w->work->done(w->work->user, &at->job, status, result, error);
}

static int idle_lane(const fst_row_worker *w, const fst_lane_batch *b)
{
    int l = 0;
    while (l < w->engine->width && b->lanes[l].run)
        ++l;
    return l;
}

/* A run is to be observed from now on. */
static void enter_observed(fst_row_worker *w, int l, fst_lane *from)
{
    fst_lane_batch *b = &w->observed;
    move_run(&b->lanes[l], from);
    fst_watched_run *run = b->lanes[l].run;
    b->occupied += 1;
    w->engine->load(b->memory, l, run->flow, run->window.span.until);
    b->view.next_mark[l] = fst_window_next_mark(&run->window);
    if (fst_window_is_open(&run->window)) { /* it comes from the run-up */
        w->in_window |= fst_lane_bit(l);
        w->tracked |= fst_lane_bit(l);
        b->view.r_reference[l] = run->window.quadrature.sums.r_reference;
        b->view.b_reference[l] = run->window.quadrature.sums.b_reference;
        fst_worker_keep_angle_range(w, l);
    }
    if (b->lanes[l].image)
        fst_worker_restore(w, b, l);
}

static void enter_run_up(fst_row_worker *w, int l, fst_lane *from)
{
    fst_lane_batch *b = &w->run_up;
    move_run(&b->lanes[l], from);
    b->occupied += 1;
    w->engine->load(b->memory, l, b->lanes[l].run->flow, b->lanes[l].run->window.span.from);
    if (b->lanes[l].image)
        fst_worker_restore(w, b, l);
}

/* A run that was begun, or taken up, goes to its place. */
static void place(fst_row_worker *w, fst_lane *fresh)
{
    const int runs_up = w->engine->fused && fresh->run->window.span.from > 0;
    const fst_run_station station = fresh->image ? fresh->place.station
                                    : runs_up    ? FST_STATION_RUN_UP
                                                 : FST_STATION_READY;
    if (station == FST_STATION_RUN_UP) {
        enter_run_up(w, idle_lane(w, &w->run_up), fresh);
        return;
    }
    fst_lane *to = station == FST_STATION_PARKED ? &w->parked[w->parked_count++] : &w->ready[w->ready_count++];
    move_run(to, fresh);
    if (station == FST_STATION_OBSERVED)
        return; /* the image is wanted when there is a lane */
    free(to->image);
    to->image = NULL;
}

/* Begin the next job, or put it aside if it does not fit; 0 if there is none. */
static int admit(fst_row_worker *w)
{
    fst_lane fresh = {.run = NULL};
    for (int has_job = 0;;) {
        if (!has_job && w->waiting_count > 0) {
            fresh.job = w->waiting[--w->waiting_count];
        } else if (!has_job && (w->no_more || !w->work->next(w->work->user, &fresh.job))) {
            w->no_more = 1;
            return 0;
        }
        fst_status status;
        fst_error error = {FST_OK, "", ""};
        const beginning begun = begin(w, &fresh, &status, &error);
        if (begun == ALONE) {
            w->answer = fst_row_alone(w->work, w->images, &fresh.job, &has_job, &w->said);
            w->no_more = w->no_more || w->answer != FST_OK;
            if (w->answer != FST_OK)
                return 0;
            continue;
        }
        if (begun == REFUSED) {
            w->deferred[w->deferred_count++] = fresh.job;
            return 1;
        }
        if (begun == BEGUN)
            break;
        fst_run_result nothing;
        fst_result_clear(&nothing);
        has_job = hand_over(w, &fresh, status, &nothing, &error);
    }
    fst_worker_take_up(w, &fresh);
    place(w, &fresh);
    return 1;
}

/* Idle lanes take runs that are ready, and new jobs; those that do not fit wait until nothing is at work. */
static void occupy_idle(fst_row_worker *w)
{
    const int width = w->engine->width;
    const fst_lane_batch *entrance = w->engine->fused ? &w->run_up : &w->observed;
    while (at_work(w) == 0 && w->deferred_count > 0)
        w->waiting[w->waiting_count++] = w->deferred[--w->deferred_count];
    do {
        while (w->ready_count > 0 && w->observed.occupied < width)
            enter_observed(w, idle_lane(w, &w->observed), &w->ready[--w->ready_count]);
    } while (w->ready_count == 0 && entrance->occupied < width && w->deferred_count < FST_MOST_DEFERRED &&
             w->parked_count < width && admit(w));
}

/* A finished run needs its exponent: it waits for others that do. */
static fst_status park(fst_row_worker *w, fst_lane *at, fst_error *error)
{
    at->exponent = malloc(sizeof *at->exponent);
    if (!at->exponent)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    fst_ask_exponent(at->run, at->exponent);
    move_run(&w->parked[w->parked_count++], at);
    return FST_OK;
}

/* The run of a lane is over; `status` other than FST_OK: it failed. */
static void finish(fst_row_worker *w, fst_lane_batch *b, int l, fst_status status, fst_error *error)
{
    fst_lane *at = &b->lanes[l];
    fst_run_result result;
    int needs_exponent = 0;
    fst_result_clear(&result);
    if (w->pending_count > 0)
        fst_worker_locate(w);
    if (status == FST_OK)
        status = fst_conclude(at->run, NULL, &result, &needs_exponent, error);
    vacate(w, b, l);
    if (status == FST_OK && needs_exponent) {
        status = park(w, at, error);
        if (status == FST_OK)
            return;
    }
    free_run(at);
    if (hand_over(w, at, status, &result, error))
        w->waiting[w->waiting_count++] = at->job;
}

static fst_status watch_exponents(void *user, double fraction, const char *what, fst_error *error)
{
    (void)fraction, (void)what;
    return fst_worker_ask(user, error);
}

/* The exponents of runs that are parked, side by side too: the last ones, as many as there are lanes. */
static fst_status conclude_parked(fst_row_worker *w, fst_error *error)
{
    fst_exponent *asked[FST_MOST_LANES] = {NULL};
    const int count = w->parked_count < w->engine->width ? w->parked_count : w->engine->width;
    fst_lane *last = w->parked + (w->parked_count - count);
    for (int i = 0; i < count; ++i)
        asked[i] = last[i].exponent;
    const fst_progress progress = {w, watch_exponents};
    const fst_status status = fst_largest_exponents(&w->engine->tangents, asked, count, &progress, error);
    for (int i = 0; status == FST_OK && i < count; ++i) {
        fst_lane *at = &last[i];
        fst_run_result result;
        fst_error own = {FST_OK, "", ""};
        int needs_exponent;
        fst_result_clear(&result);
        const fst_status concluded = fst_conclude(at->run, at->exponent, &result, &needs_exponent, &own);
        free_run(at);
        if (hand_over(w, at, concluded, &result, &own))
            w->waiting[w->waiting_count++] = at->job;
    }
    w->parked_count -= status == FST_OK ? count : 0;
    return status;
}

static void conclude(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_error error = {FST_OK, "", ""};
    finish(w, b, l, FST_OK, &error);
}

static void give_up(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_flow *flow = b->lanes[l].run->flow;
    fst_error error = {FST_OK, "", ""};
    w->engine->extract(b->memory, l, &flow->step);
    w->engine->extract_clock(b->memory, l, flow);
    finish(w, b, l, fst_flow_fail(flow, &error), &error);
}

/* Make a step in every lane whose run is observed. */
static void step_observed(fst_row_worker *w)
{
    fst_lane_batch *b = &w->observed;
    const fst_lane_tries tries = w->engine->try_steps(b->memory);
    const fst_lane_contacts contacts = fst_worker_look_at_contacts(w, b, tries);
    const unsigned accepted = tries.accepted | contacts.passed;
    fst_lane_events events = w->engine->watch(b->memory, accepted, accepted, w->in_window);
    unsigned beaten[FST_RECORD_COUNT] = {0};
    /* In the fast form, a run that is not in its window yet has no discard: its first step is in it. */
    const unsigned tracked = w->engine->fused ? w->tracked | ~w->in_window : w->tracked;
    if (accepted)
        w->engine->observe(b->memory, accepted, w->in_window, tracked, beaten);
    for (int i = 0; !w->engine->fused && i < FST_RECORD_COUNT; ++i)
        events.close |= beaten[i];
    const unsigned over = fst_worker_look(w, events);
    if (w->engine->fused)
        fst_worker_set_aside(w, beaten);
    w->engine->advance(b->memory, accepted & ~over);
    for (int l = 0; (over | tries.failed | contacts.turned | contacts.landed) != 0 && l < w->engine->width;
         ++l) {
        const unsigned bit = fst_lane_bit(l);
        if (contacts.landed & bit)
            (void)fst_worker_land(w, b, l);
        if ((over | contacts.landed) & bit)
            conclude(w, b, l);
        else if (tries.failed & bit)
            give_up(w, b, l);
        else if (contacts.turned & bit)
            fst_worker_begin_mode(w, b, l);
    }
}

/* ------------------------------------------------------------------ before the window */

/* The end of the last step is where the flow goes on; the mode of a contact goes on too. */
static void stand_at_end(fst_flow *flow)
{
    if (flow->step.context.coefficients.kinds.paced) {
        fst_contact_begin_step(flow);
        flow->t_start = flow->t;
        flow->bead_angle_start = flow->bead_angle;
    } else {
        fst_flow_restart(flow);
    }
}

/* The discard of a run is over: its window begins with the state that it has. */
static void open_window(fst_row_worker *w, int l)
{
    fst_lane_batch *b = &w->run_up;
    fst_watched_run *run = b->lanes[l].run;
    run->window.activity = b->view.activity[l];
    fst_quadrature_begin_moment_angle(&run->window.quadrature, run->flow->step.end);
    fst_window_mark_periods(&run->window, run->flow);
    stand_at_end(run->flow);
    fst_quadrature_set_references(&run->window.quadrature, run->flow);
    fst_returns_see_side(&run->window.returns, run->flow);
    fst_window_pass(&run->window, &run->flow->bead_angle, 0.0);
    vacate(w, b, l);
    move_run(&w->ready[w->ready_count++], &b->lanes[l]);
}

/* Look at the steps that may hold something; the lanes whose runs are over. */
static unsigned look_at_run_up(fst_row_worker *w, fst_lane_events events)
{
    fst_lane_batch *b = &w->run_up;
    unsigned over = 0;
    for (int l = 0; (events.close >> l) != 0; ++l)
        if (events.close & fst_lane_bit(l)) {
            fst_worker_extract_step(w, b, l);
            b->view.turns[0][l] = (double)b->lanes[l].run->flow->bead_angle.turns;
            b->view.activity[l] = fmax(b->view.activity[l], b->view.speed[l]);
            over |= (events.ending & fst_lane_bit(l)) && fst_worker_ends_run(w, b, l) ? fst_lane_bit(l) : 0;
        }
    return over;
}

/* Make a step in every lane whose run is not observed. */
static void step_run_up(fst_row_worker *w)
{
    fst_lane_batch *b = &w->run_up;
    const fst_lane_tries tries = w->engine->try_steps(b->memory);
    const fst_lane_contacts contacts = fst_worker_look_at_contacts(w, b, tries);
    const unsigned accepted = tries.accepted | contacts.passed, landed = tries.landed | contacts.landed;
    const unsigned over = look_at_run_up(w, w->engine->watch(b->memory, accepted, 0, 0));
    w->engine->advance(b->memory, accepted & ~(over | landed));
    for (int l = 0; (over | landed | tries.failed | contacts.turned) != 0 && l < w->engine->width; ++l) {
        const unsigned bit = fst_lane_bit(l);
        if (over & bit || (contacts.landed & bit && fst_worker_land(w, b, l)))
            conclude(w, b, l);
        else if (landed & bit)
            open_window(w, l);
        else if (tries.failed & bit)
            give_up(w, b, l);
        else if (contacts.turned & bit)
            fst_worker_begin_mode(w, b, l);
    }
}

/* ------------------------------------------------------------------ */

/* Room for a batch of either engine. */
static void *make_memory(size_t usual, size_t dry)
{
    const size_t bytes = ((usual > dry ? usual : dry) + 63) / 64 * 64;
    void *memory = aligned_alloc(64, bytes + 64);
    if (memory)
        memset(memory, 0, bytes);
    return memory;
}

static fst_row_worker *make_worker(const fst_row_work *work, const fst_row_images *images,
                                   const fst_lane_engine *engine)
{
    const fst_lane_engine *dry = fst_dry_lane_engine_of(engine);
    fst_row_worker *w = calloc(1, sizeof *w);
    if (!w)
        return NULL;
    w->work = work;
    w->images = fst_run_images_possible() ? images : NULL;
    w->usual = engine;
    w->dry = dry;
    w->pending_steps = make_memory(engine->waiting_bytes, dry->waiting_bytes);
    w->observed.memory = make_memory(engine->bytes, dry->bytes);
    w->run_up.memory = make_memory(engine->bytes, dry->bytes);
    if (w->pending_steps && w->observed.memory && w->run_up.memory) {
        use_engine(w, w->usual);
        return w;
    }
    free(w->run_up.memory);
    free(w->observed.memory);
    free(w->pending_steps);
    free(w);
    return NULL;
}

static void free_worker(fst_row_worker *w)
{
    for (int l = 0; l < w->engine->width; ++l) {
        free_run(&w->run_up.lanes[l]);
        free_run(&w->observed.lanes[l]);
    }
    for (int i = 0; i < w->ready_count; ++i)
        free_run(&w->ready[i]);
    for (int i = 0; i < w->parked_count; ++i)
        free_run(&w->parked[i]);
    free(w->run_up.memory);
    free(w->observed.memory);
    free(w->pending_steps);
    free(w);
}

fst_status fst_lane_rows(const fst_row_work *work, const fst_row_images *images, const fst_lane_engine *engine,
                         fst_error *error)
{
    fst_row_worker *w = make_worker(work, images, engine);
    if (!w)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    fst_status status = FST_OK;
    occupy_idle(w);
    for (unsigned steps = 1; status == FST_OK && at_work(w) > 0; ++steps) {
        /* Those that are observed wait until they are as many as lanes, or no more are to come. */
        if (w->observed.occupied == engine->width || (w->run_up.occupied == 0 && w->observed.occupied > 0))
            step_observed(w);
        else if (w->run_up.occupied > 0)
            step_run_up(w);
        occupy_idle(w);
        while (status == FST_OK &&
               (w->parked_count >= engine->width || (on_their_way(w) == 0 && w->parked_count > 0))) {
            status = conclude_parked(w, error);
            occupy_idle(w);
        }
        if (status == FST_OK && steps % 64 == 0)
            status = fst_worker_ask(w, error);
    }
    if (status == FST_OK && w->answer != FST_OK) {
        if (error)
            *error = w->said;
        status = w->answer;
    }
    free_worker(w);
    return status;
}
