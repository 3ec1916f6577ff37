/* lane_places.c - rows in lanes: how a run begins, and where it is between its beginning and its end.
 *
 * lane_rows.c shows the way of a row from batch to queue to batch; here are the steps of that way which end at
 * a place: a job becomes a run, a run takes a lane or waits for one.
 */
#include "study/lane_worker.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "study/conclude.h"
#include "study/lane_rows.h"

void fst_worker_free_run(fst_lane *at)
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

void fst_worker_move_run(fst_lane *to, fst_lane *from)
{
    *to = *from;
    from->run = NULL;
    from->image = NULL;
    from->exponent = NULL;
    to->run->params = &to->job.params;
}

void fst_worker_vacate(fst_row_worker *w, fst_lane_batch *b, int l)
{
    w->engine->release(b->memory, l);
    b->occupied -= 1;
    if (b == &w->run_up)
        w->seeking &= ~fst_lane_bit(l);
    if (b == &w->observed) {
        w->in_window &= ~fst_lane_bit(l);
        w->tracked &= ~fst_lane_bit(l);
        w->turning &= ~fst_lane_bit(l);
        w->leaving &= ~fst_lane_bit(l);
        w->failed &= ~fst_lane_bit(l);
        w->settled &= ~fst_lane_bit(l);
    }
}

int fst_worker_on_their_way(const fst_row_worker *w)
{
    return w->run_up.occupied + w->observed.occupied + w->ready_count + w->unwatched_count;
}

int fst_worker_at_work(const fst_row_worker *w)
{
    return fst_worker_on_their_way(w) + w->parked_count;
}

/* Whether a model can share the batches with those at work. */
static int fits(const fst_row_worker *w, const fst_model *model)
{
    return fst_worker_at_work(w) == 0 || fst_kinds_equal(&w->kind.kinds, &model->world.kinds);
}

/* Whether lanes know the contact of a model. */
static int lanes_know(const fst_kinds *kinds)
{
    return !kinds->dry || (kinds->patch == FST_PATCH_POINT && !kinds->flies && !kinds->resists);
}

void fst_worker_use_engine(fst_row_worker *w, const fst_lane_engine *engine)
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

fst_beginning fst_worker_begin(fst_row_worker *w, fst_lane *at, fst_status *status, fst_error *error)
{
    fst_watched_run *run = calloc(1, sizeof *run);
    if (!run) {
        *status = fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
        return FST_BEGUN_FAILED;
    }
    *status = fst_watched_run_begin(run, &at->job.params, at->job.has_start ? at->job.start : NULL, error);
    const int alone = *status == FST_OK && !lanes_know(&run->model->world.kinds);
    const int refused = *status == FST_OK && !alone && !fits(w, run->model);
    if (*status != FST_OK || refused || alone) {
        fst_watched_run_free(run);
        free(run);
        return alone ? FST_BEGUN_ALONE : refused ? FST_BEGUN_REFUSED : FST_BEGUN_FAILED;
    }
    if (fst_worker_at_work(w) == 0)
        fst_worker_use_engine(w, run->model->world.kinds.dry ? w->dry : w->usual);
    at->run = run;
    w->kind = run->model->world;
    run->window.span.asked_at_end = 1;
    if (!w->usual->fused)
        run->window.returns.left_out.state = FST_LEFT_OUT_NEVER;
    return FST_BEGUN;
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
    fst_worker_move_run(&b->lanes[l], from);
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
    if (b->lanes[l].image) {
        fst_worker_restore(w, b, l);
        b->view.next_mark[l] =
            fst_window_next_mark(&run->window); /* its lane knew another one if it comes back */
    }
}

static void enter_run_up(fst_row_worker *w, int l, fst_lane *from)
{
    fst_lane_batch *b = &w->run_up;
    fst_worker_move_run(&b->lanes[l], from);
    b->occupied += 1;
    const fst_window *window = &b->lanes[l].run->window;
    const int seeks = window->span.states_only;
    w->engine->load(b->memory, l, b->lanes[l].run->flow, seeks ? window->span.until : window->span.from);
    if (b->lanes[l].image)
        fst_worker_restore(w, b, l);
    if (seeks) {
        w->seeking |= fst_lane_bit(l);
        b->view.next_mark[l] = fst_window_next_mark(window);
    }
    if (window->returns.left_out.state == FST_LEFT_OUT_AWAY)
        b->view.next_mark[l] = fst_left_out_until(&window->returns.left_out, &window->span);
}

void fst_worker_place(fst_row_worker *w, fst_lane *fresh)
{
    const fst_span *span = &fresh->run->window.span;
    const int runs_up = w->engine->fused && (span->states_only || span->from > 0);
    const fst_run_station station = fresh->image ? fresh->place.station
                                    : runs_up    ? FST_STATION_RUN_UP
                                                 : FST_STATION_READY;
    if (station == FST_STATION_RUN_UP) {
        fst_worker_move_run(&w->unwatched[w->unwatched_count++], fresh);
        return;
    }
    fst_lane *to = station == FST_STATION_PARKED ? &w->parked[w->parked_count++] : &w->ready[w->ready_count++];
    fst_worker_move_run(to, fresh);
    if (station == FST_STATION_OBSERVED)
        return; /* the image is wanted when there is a lane */
    free(to->image);
    to->image = NULL;
}

/* Begin the next job, or put it aside if it does not fit; 0 if no job is left. */
static int admit(fst_row_worker *w)
{
    fst_lane fresh = {.run = NULL};
    for (int has_job = 0;;) {
        if (!has_job && w->waiting_count > 0) {
            fresh.job = w->waiting[--w->waiting_count];
        } else if (!has_job) {
            const int came = w->no_more ? 0 : w->work->next(w->work->user, &fresh.job);
            w->no_more = came == 0;
            if (came <= 0)
                return 0;
        }
        fst_status status;
        fst_error error = {FST_OK, "", ""};
        const fst_beginning begun = fst_worker_begin(w, &fresh, &status, &error);
        if (begun == FST_BEGUN_ALONE) {
            w->answer = fst_row_alone(w->work, w->images, &fresh.job, &has_job, &w->said);
            w->no_more = w->no_more || w->answer != FST_OK;
            if (w->answer != FST_OK)
                return 0;
            continue;
        }
        if (begun == FST_BEGUN_REFUSED) {
            w->deferred[w->deferred_count++] = fresh.job;
            return 1;
        }
        if (begun == FST_BEGUN)
            break;
        fst_run_result nothing;
        fst_result_clear(&nothing);
        has_job = w->work->done(w->work->user, &fresh.job, status, &nothing, &error);
    }
    fst_worker_take_up(w, &fresh);
    fst_worker_place(w, &fresh);
    return 1;
}

void fst_worker_occupy_idle(fst_row_worker *w)
{
    const int width = w->engine->width;
    const fst_lane_batch *entrance = w->engine->fused ? &w->run_up : &w->observed;
    while (fst_worker_at_work(w) == 0 && w->deferred_count > 0)
        w->waiting[w->waiting_count++] = w->deferred[--w->deferred_count];
    do {
        while (w->unwatched_count > 0 && w->run_up.occupied < width)
            enter_run_up(w, idle_lane(w, &w->run_up), &w->unwatched[--w->unwatched_count]);
        while (w->ready_count > 0 && w->observed.occupied < width)
            enter_observed(w, idle_lane(w, &w->observed), &w->ready[--w->ready_count]);
    } while (w->ready_count == 0 && w->unwatched_count == 0 && entrance->occupied < width &&
             w->deferred_count < FST_MOST_DEFERRED && w->parked_count < width && admit(w));
}
