/* lane_images.c - images of unfinished runs in lanes: made when they are due, taken up when a job begins. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/watch.h"
#include "study/lane_worker.h"

/* Make a run the one of its image; a parked one is given the exponent that it waits for. */
static int take(const fst_row_worker *w, fst_lane *at)
{
    fst_exponent *exponent = malloc(sizeof *exponent);
    const int taken = exponent && fst_run_image_take(at->image, at->image_size, w->engine->numbers, at->run,
                                                     exponent, &at->place, &at->numbers);
    if (taken && at->place.station == FST_STATION_PARKED)
        at->exponent = exponent;
    else
        free(exponent);
    return taken;
}

void fst_worker_take_up(const fst_row_worker *w, fst_lane *at)
{
    at->image = NULL;
    if (!w->images)
        return;
    at->saved = fst_clock_seconds();
    at->image = w->images->find(w->images->user, &at->job, &at->image_size);
    if (at->image && take(w, at))
        return;
    free(at->image);
    at->image = NULL;
}

static unsigned with_bit(unsigned lanes, int l, int set)
{
    return (lanes & ~fst_lane_bit(l)) | (set ? fst_lane_bit(l) : 0);
}

void fst_worker_restore(fst_row_worker *w, fst_lane_batch *b, int l)
{
    fst_lane *at = &b->lanes[l];
    w->engine->restore(b->memory, l, at->numbers);
    if (b == &w->observed) {
        w->in_window = with_bit(w->in_window, l, at->place.in_window);
        w->tracked = with_bit(w->tracked, l, at->place.tracked);
        w->turning = with_bit(w->turning, l, at->place.turning);
    }
    free(at->image);
    at->image = NULL;
}

/* The image of a run, if it is due. */
static void save(fst_row_worker *w, fst_lane *at, const fst_lane_batch *b, int l, fst_run_station station,
                 double time)
{
    const fst_row_images *images = w->images;
    if (!at->run || time - at->saved < images->seconds)
        return;
    at->saved = time;
    if (at->image) { /* the run has not moved since it was taken up */
        images->save(images->user, &at->job, at->image, at->image_size);
        return;
    }
    if (w->pending_count > 0)
        fst_worker_locate(w); /* an image holds the extremes found so far */
    const unsigned bit = fst_lane_bit(l);
    const int observed = station == FST_STATION_OBSERVED;
    const fst_run_place place = {station, observed && w->in_window & bit, observed && w->tracked & bit,
                                 observed && w->turning & bit};
    double *numbers;
    size_t size;
    void *image =
        fst_run_image_make(at->run, at->exponent, &place, b ? w->engine->numbers : 0, &numbers, &size);
    if (!image)
        return; /* out of memory: after a kill this run would start from an older image, no more */
    if (b)
        w->engine->save(b->memory, l, numbers);
    images->save(images->user, &at->job, image, size);
    free(image);
}

fst_status fst_worker_ask(fst_row_worker *w, fst_error *error)
{
    const fst_status answer = fst_tell(w->work->progress, 0.0, NULL, error);
    if (!w->images)
        return answer;
    const double time = answer == FST_OK ? fst_clock_seconds() : INFINITY;
    for (int l = 0; l < w->engine->width; ++l) {
        save(w, &w->run_up.lanes[l], &w->run_up, l, FST_STATION_RUN_UP, time);
        save(w, &w->observed.lanes[l], &w->observed, l, FST_STATION_OBSERVED, time);
    }
    for (int i = 0; i < w->ready_count; ++i)
        save(w, &w->ready[i], NULL, 0, FST_STATION_READY, time);
    for (int i = 0; i < w->unwatched_count; ++i)
        if (w->unwatched[i].image)
            save(w, &w->unwatched[i], NULL, 0, FST_STATION_RUN_UP, time);
    for (int i = 0; i < w->parked_count; ++i)
        save(w, &w->parked[i], NULL, 0, FST_STATION_PARKED, time);
    return answer;
}
