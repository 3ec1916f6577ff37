/* lane_images.c - images of the runs that are at work in lanes. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "study/lane_crew.h"

void fst_crew_take_up(const fst_crew *c, fst_lane *at)
{
    at->image = NULL;
    if (!c->images)
        return;
    at->saved = fst_clock_seconds();
    at->image = c->images->find(c->images->user, &at->job, &at->image_size);
    if (at->image &&
        fst_run_image_take(at->image, at->image_size, c->engine->numbers, at->run, &at->place, &at->numbers))
        return;
    free(at->image);
    at->image = NULL;
}

static unsigned with_bit(unsigned lanes, int l, int set)
{
    return (lanes & ~fst_lane_bit(l)) | (set ? fst_lane_bit(l) : 0);
}

void fst_crew_restore(fst_crew *c, fst_squad *s, int l)
{
    fst_lane *at = &s->lanes[l];
    c->engine->restore(s->batch, l, at->numbers);
    if (s == &c->observed) {
        c->in_window = with_bit(c->in_window, l, at->place.in_window);
        c->tracked = with_bit(c->tracked, l, at->place.tracked);
        c->turning = with_bit(c->turning, l, at->place.turning);
    }
    free(at->image);
    at->image = NULL;
}

/* The image of a run, if it is due. */
static void save(fst_crew *c, fst_lane *at, const fst_squad *s, int l, fst_run_stage stage, double time)
{
    const fst_row_images *images = c->images;
    if (!at->run || time - at->saved < images->seconds)
        return;
    at->saved = time;
    if (at->image) { /* nothing has happened to it */
        images->save(images->user, &at->job, at->image, at->image_size);
        return;
    }
    if (c->aside > 0)
        fst_crew_locate(c); /* extremes that were set aside belong to the runs */
    const unsigned bit = fst_lane_bit(l);
    const int observed = stage == FST_STAGE_OBSERVED;
    const fst_run_place place = {stage, observed && c->in_window & bit, observed && c->tracked & bit,
                                 observed && c->turning & bit};
    double *numbers;
    size_t size;
    void *image = fst_run_image_make(at->run, &place, s ? c->engine->numbers : 0, &numbers, &size);
    if (!image)
        return; /* without memory there is no image, which costs nothing but what it would have saved */
    if (s)
        c->engine->save(s->batch, l, numbers);
    images->save(images->user, &at->job, image, size);
    free(image);
}

int fst_crew_stopped(fst_crew *c)
{
    const int stop = c->work->stopped(c->work->user);
    if (!c->images)
        return stop;
    const double time = stop ? INFINITY : fst_clock_seconds();
    for (int l = 0; l < c->engine->width; ++l) {
        save(c, &c->run_up.lanes[l], &c->run_up, l, FST_STAGE_RUN_UP, time);
        save(c, &c->observed.lanes[l], &c->observed, l, FST_STAGE_OBSERVED, time);
    }
    for (int i = 0; i < c->ready_count; ++i)
        save(c, &c->ready[i], NULL, 0, FST_STAGE_READY, time);
    for (int i = 0; i < c->parked_count; ++i)
        save(c, &c->parked[i], NULL, 0, FST_STAGE_PARKED, time);
    return stop;
}
