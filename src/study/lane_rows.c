/* lane_rows.c - rows in lanes: which run is in which lane, and when.
 *
 * An engine (lanes.h) makes one step of every lane of a batch at once, and adds up the integrals.  Everything
 * else about a run is the code of fst_run(): each lane has a watched run of its own, whose window observes it.
 * That code would cost more than the step, so a step is taken out of its lane only when it may hold something:
 * the end of the run, a mark, a return to the section, an extreme.  The engine says which steps may;
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
 * Observing costs more than stepping.  So in the fast form a run whose returns repeat themselves goes back to
 * the run-up batch, where nobody looks at it, and is observed again shortly before its end
 * (observe/left_out.h).  It moves as an image of its lane does, so that its steps keep their bits:
 *
 *     observed batch --- repeats ---> unwatched ----> run-up batch --- near the end ---> ready ----> observed
 *                                     (queue)
 *
 * A run that comes back as another motion was near an unstable orbit; it begins anew and is observed
 * throughout.
 *
 * A batch shares the integers of its models: number of lines, material, dynamics.  A job that differs is
 * deferred until nothing is at work; the next batch then takes its kind.  Some motions need their largest
 * exponent to be recognised (conclude.h).  Their runs are parked until there are as many as lanes, and followed side
 * by side too; with dry friction until the first is done, whose lane the next one to be parked takes.
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
#include "study/settle.h"

/* Hand over the result of a job; another one may follow. */
static void hand_over(fst_row_worker *w, fst_row_job *job, fst_status status, const fst_run_result *result,
                      const fst_error *error)
{
    if (w->work->done(w->work->user, job, status, result, error))
        w->waiting[w->waiting_count++] = *job;
}

/* A finished run needs its exponent: it waits for others that do. */
static fst_status park(fst_row_worker *w, fst_lane *at, fst_error *error)
{
    at->exponent = malloc(sizeof *at->exponent);
    if (!at->exponent)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    fst_ask_exponent(at->run, at->exponent);
    fst_worker_move_run(&w->parked[w->parked_count++], at);
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
    fst_worker_vacate(w, b, l);
    if (status == FST_OK && needs_exponent) {
        status = park(w, at, error);
        if (status == FST_OK)
            return;
    }
    fst_worker_free_run(at);
    hand_over(w, &at->job, status, &result, error);
}

static fst_status watch_exponents(void *user, double fraction, const char *what, fst_error *error)
{
    (void)fraction, (void)what;
    return fst_worker_ask(user, error);
}

/* Follow the exponents of the first `count` parked runs side by side.  *over: those that are known then, one bit each. */
static fst_status follow_parked(fst_row_worker *w, int count, unsigned *over, fst_error *error)
{
    fst_exponent *asked[FST_MOST_LANES] = {NULL};
    for (int i = 0; i < count; ++i)
        asked[i] = w->parked[i].exponent;
    const fst_progress progress = {w, watch_exponents};
    *over = (1u << count) - 1;
    if (!w->kind.kinds.dry || !w->kind.kinds.modes)
        return fst_largest_exponents(&w->engine->tangents, asked, count, &progress, error);
    if (!w->exponents)
        w->exponents = fst_dry_exponents_new(w->dry);
    if (!w->exponents)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    return fst_dry_exponents_follow(w->exponents, asked, count, over, &progress, error);
}

/* Conclude the first of the parked runs, as many as there are lanes, or those of them that are over first. */
static fst_status conclude_parked(fst_row_worker *w, fst_error *error)
{
    const int count = w->parked_count < w->engine->width ? w->parked_count : w->engine->width;
    unsigned over;
    const fst_status status = follow_parked(w, count, &over, error);
    int left = 0;
    for (int i = 0; status == FST_OK && i < w->parked_count; ++i) {
        fst_lane *at = &w->parked[i];
        fst_run_result result;
        fst_error own = {FST_OK, "", ""};
        int needs_exponent;
        if (!(over >> i & 1u)) {
            if (left < i)
                fst_worker_move_run(&w->parked[left], at);
            left += 1;
            continue;
        }
        fst_result_clear(&result);
        const fst_status concluded = fst_conclude(at->run, at->exponent, &result, &needs_exponent, &own);
        fst_worker_free_run(at);
        hand_over(w, &at->job, concluded, &result, &own);
    }
    w->parked_count = status == FST_OK ? left : w->parked_count;
    return status;
}

static void conclude(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_error error = {FST_OK, "", ""};
    finish(w, b, l, FST_OK, &error);
}

static void give_up_memory(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_error error;
    finish(w, b, l, fst_fail(&error, FST_NO_MEMORY, "fst_rows", "out of memory"), &error);
}

static void give_up(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_flow *flow = b->lanes[l].run->flow;
    fst_error error = {FST_OK, "", ""};
    w->engine->extract(b->memory, l, &flow->step);
    w->engine->extract_clock(b->memory, l, flow);
    finish(w, b, l, fst_flow_fail(flow, &error), &error);
}

/* Take a run out of its lane, to go on in another batch with the same bits; 0: no memory. */
static int take_out(fst_row_worker *w, fst_lane_batch *b, int l, fst_run_station station)
{
    fst_lane *at = &b->lanes[l];
    double *numbers;
    const fst_run_place place = {station, 1, 0, 1};
    at->image = fst_run_image_make(at->run, NULL, &place, w->engine->numbers, &numbers, &at->image_size);
    if (!at->image)
        return 0;
    w->engine->save(b->memory, l, numbers);
    at->numbers = numbers;
    at->place = place;
    fst_worker_vacate(w, b, l);
    return 1;
}

/* The run of a lane repeats itself: it goes on where it is not observed. */
static void leave(fst_row_worker *w, int l)
{
    if (w->pending_count > 0)
        fst_worker_locate(w);
    if (take_out(w, &w->observed, l, FST_STATION_RUN_UP))
        fst_worker_move_run(&w->unwatched[w->unwatched_count++], &w->observed.lanes[l]);
    else
        give_up_memory(w, &w->observed, l);
}

/* A run that left is observed again. */
static void come_back(fst_row_worker *w, int l)
{
    fst_watched_run *run = w->run_up.lanes[l].run;
    fst_window_pass_left_out(&run->window, run->flow);
    if (take_out(w, &w->run_up, l, FST_STATION_OBSERVED))
        fst_worker_move_run(&w->ready[w->ready_count++], &w->run_up.lanes[l]);
    else
        give_up_memory(w, &w->run_up, l);
}

/* It came back as another motion, because the one that repeated itself is unstable: all of it is observed. */
static void begin_anew(fst_row_worker *w, int l)
{
    fst_lane fresh = {.run = NULL}, *at = &w->observed.lanes[l];
    fst_error error = {FST_OK, "", ""};
    fst_status status;
    fresh.job = at->job;
    fresh.saved = at->saved;
    fst_worker_vacate(w, &w->observed, l);
    fst_worker_free_run(at);
    if (fst_worker_begin(w, &fresh, &status, &error) == FST_BEGUN) {
        fresh.run->window.returns.left_out.state = FST_LEFT_OUT_NEVER;
        fst_worker_place(w, &fresh);
        return;
    }
    fst_run_result nothing;
    fst_result_clear(&nothing);
    hand_over(w, &fresh.job, status, &nothing, &error);
}

/* A run begins another window (settle.h). */
static void watch_anew(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_worker_vacate(w, b, l);
    fst_worker_move_run(&w->ready[w->ready_count++], &b->lanes[l]);
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
        if (w->settled & bit)
            continue;
        if ((over | contacts.landed) & bit)
            conclude(w, b, l);
        else if (tries.failed & bit)
            give_up(w, b, l);
        else if (contacts.turned & bit)
            fst_worker_begin_mode(w, b, l);
    }
    for (int l = 0; (w->leaving | w->failed | w->settled) != 0 && l < w->engine->width; ++l) {
        if (w->settled & fst_lane_bit(l))
            watch_anew(w, &w->observed, l);
        else if (w->failed & fst_lane_bit(l))
            begin_anew(w, l);
        else if (w->leaving & fst_lane_bit(l))
            leave(w, l);
    }
}

/* ------------------------------------------------------------------ unobserved */

/* The discard of a run is over: its window begins with the state that it has. */
static void open_window(fst_row_worker *w, int l)
{
    fst_lane_batch *b = &w->run_up;
    fst_watched_run *run = b->lanes[l].run;
    run->window.activity = b->view.activity[l];
    fst_quadrature_begin_moment_angle(&run->window.quadrature, run->flow->step.end);
    fst_window_mark_periods(&run->window, run->flow);
    fst_stand_at_end(run->flow);
    fst_quadrature_set_references(&run->window.quadrature, run->flow);
    fst_returns_see_side(&run->window.returns, run->flow);
    fst_window_pass(&run->window, &run->flow->bead_angle, 0.0);
    fst_worker_vacate(w, b, l);
    fst_worker_move_run(&w->ready[w->ready_count++], &b->lanes[l]);
}

/* Look at the steps that may hold something; the lanes whose runs are over, and those whose runs begin to be
 * observed: *anew. */
static unsigned look_at_run_up(fst_row_worker *w, fst_lane_events events, unsigned *anew)
{
    fst_lane_batch *b = &w->run_up;
    unsigned worth = events.close | events.at_mark;
    for (int l = 0; (events.at_maximum & w->seeking) >> l != 0; ++l)
        if (events.at_maximum & w->seeking & fst_lane_bit(l) && b->lanes[l].run->settling.cycle.watched)
            worth |= fst_lane_bit(l);
    unsigned over = 0;
    for (int l = 0; (worth >> l) != 0; ++l)
        if (worth & fst_lane_bit(l)) {
            fst_worker_extract_step(w, b, l);
            b->view.turns[0][l] = (double)b->lanes[l].run->flow->bead_angle.turns;
            if (!(w->seeking & fst_lane_bit(l)))
                b->view.activity[l] = fmax(b->view.activity[l], b->view.speed[l]);
            over |= (events.ending & fst_lane_bit(l)) && fst_worker_ends_run(w, b, l) ? fst_lane_bit(l) : 0;
            if (w->seeking & ~over & fst_lane_bit(l) && fst_worker_seek(w, l))
                *anew |= fst_lane_bit(l);
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
    const fst_lane_events events = w->engine->watch(b->memory, accepted, 0, w->seeking);
    unsigned anew = 0;
    const unsigned over = look_at_run_up(w, events, &anew);
    const unsigned back = events.at_mark & ~(over | landed | w->seeking);
    w->engine->advance(b->memory, accepted & ~(over | landed));
    for (int l = 0; (over | landed | back | anew | tries.failed | contacts.turned) != 0 && l < w->engine->width;
         ++l) {
        const unsigned bit = fst_lane_bit(l);
        if (anew & bit)
            watch_anew(w, b, l);
        else if (over & bit || (contacts.landed & bit && fst_worker_land(w, b, l)))
            conclude(w, b, l);
        else if (landed & bit)
            open_window(w, l);
        else if (tries.failed & bit)
            give_up(w, b, l);
        else if (contacts.turned & bit)
            fst_worker_begin_mode(w, b, l);
        if (back & bit)
            come_back(w, l);
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

static void free_worker(fst_row_worker *w)
{
    for (int l = 0; l < FST_MOST_LANES; ++l) {
        fst_worker_free_run(&w->run_up.lanes[l]);
        fst_worker_free_run(&w->observed.lanes[l]);
    }
    for (int i = 0; i < w->ready_count; ++i)
        fst_worker_free_run(&w->ready[i]);
    for (int i = 0; i < w->unwatched_count; ++i)
        fst_worker_free_run(&w->unwatched[i]);
    for (int i = 0; i < w->parked_count; ++i)
        fst_worker_free_run(&w->parked[i]);
    fst_dry_exponents_free(w->exponents);
    free(w->run_up.memory);
    free(w->observed.memory);
    free(w->pending_steps);
    free(w);
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
        fst_worker_use_engine(w, w->usual);
        return w;
    }
    free_worker(w);
    return NULL;
}

fst_status fst_lane_rows(const fst_row_work *work, const fst_row_images *images, const fst_lane_engine *engine,
                         fst_error *error)
{
    fst_row_worker *w = make_worker(work, images, engine);
    if (!w)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    fst_status status = FST_OK;
    fst_worker_occupy_idle(w);
    for (unsigned steps = 1; status == FST_OK && fst_worker_at_work(w) > 0; ++steps) {
        /* Those that are observed wait until they are as many as lanes, or no more are to come. */
        if (w->observed.occupied == engine->width || (w->run_up.occupied == 0 && w->observed.occupied > 0))
            step_observed(w);
        else if (w->run_up.occupied > 0)
            step_run_up(w);
        fst_worker_occupy_idle(w);
        while (status == FST_OK &&
               (w->parked_count >= engine->width || (fst_worker_on_their_way(w) == 0 && w->parked_count > 0))) {
            status = conclude_parked(w, error);
            fst_worker_occupy_idle(w);
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
