/* lone_run.c - a row without neighbours: one run, from its start or its image to its end. */
#include "study/lane_rows.h"

#include <stdlib.h>

#include "base/clock.h"
#include "base/watch.h"
#include "base/error.h"
#include "study/conclude.h"
#include "study/run_image.h"

typedef struct lone_run {
    const fst_row_work *work;
    const fst_row_images *images;
    const fst_row_job *job;
    fst_watched_run *run;
    fst_run_station station;
    fst_exponent exponent; /* what a parked run waits for */
    double saved;
    fst_status answer; /* of the caller, whether to go on */
} lone_run;

/* Ask whether to go on; save the image if it is due, or if not. */
static fst_status ask(lone_run *l, fst_error *error)
{
    l->answer = fst_tell(l->work->progress, 0.0, NULL, error);
    const double time = l->images ? fst_clock_seconds() : 0.0;
    if (!l->images || (l->answer == FST_OK && time - l->saved < l->images->seconds))
        return l->answer;
    const fst_run_place place = {.station = l->station};
    double *none;
    size_t size;
    void *image = fst_run_image_make(l->run, l->station == FST_STATION_PARKED ? &l->exponent : NULL, &place, 0,
                                     &none, &size);
    if (image)
        l->images->save(l->images->user, l->job, image, size);
    free(image);
    l->saved = time;
    return l->answer;
}

static fst_status watch_exponent(void *user, double fraction, const char *what, fst_error *error)
{
    (void)fraction, (void)what;
    return ask(user, error);
}

static fst_status begin(lone_run *l, fst_error *error)
{
    l->station = FST_STATION_ALONE;
    l->run = calloc(1, sizeof *l->run);
    if (!l->run)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    const fst_status status =
        fst_watched_run_begin(l->run, &l->job->params, l->job->has_start ? l->job->start : NULL, error);
    if (status != FST_OK || !l->images)
        return status;
    size_t size;
    fst_run_place place;
    const double *none;
    void *image = l->images->find(l->images->user, l->job, &size);
    if (fst_run_image_take(image, size, 0, l->run, &l->exponent, &place, &none))
        l->station = place.station;
    free(image);
    l->saved = fst_clock_seconds();
    return FST_OK;
}

/* Follow the run to its end and fill in the result; FST_INTERRUPTED: it has not got there. */
static fst_status go_on(lone_run *l, fst_run_result *result, fst_error *error)
{
    enum { STEPS = 64 }; /* between two looks whether to stop */
    fst_status status = FST_OK;
    int needs_exponent = l->station == FST_STATION_PARKED;
    for (int over = needs_exponent; status == FST_OK && !over;) {
        status = fst_watched_run_go_on(l->run, STEPS, &over, error);
        if (status == FST_OK && !over)
            status = ask(l, error);
    }
    if (status == FST_OK && !needs_exponent) {
        status = fst_conclude(l->run, NULL, result, &needs_exponent, error);
        if (status == FST_OK && needs_exponent)
            fst_ask_exponent(l->run, &l->exponent);
    }
    if (status != FST_OK || !needs_exponent)
        return status;
    const fst_progress progress = {l, watch_exponent};
    fst_exponent *asked = &l->exponent;
    l->station = FST_STATION_PARKED;
    status = fst_largest_exponents(&fst_tangents_scalar, &asked, 1, &progress, error);
    fst_result_clear(result);
    return status == FST_OK ? fst_conclude(l->run, asked, result, &needs_exponent, error) : status;
}

fst_status fst_row_alone(const fst_row_work *work, const fst_row_images *images, fst_row_job *job, int *follows,
                         fst_error *error)
{
    lone_run l = {.work = work, .images = fst_run_images_possible() ? images : NULL, .job = job};
    fst_run_result result;
    fst_error own = {FST_OK, "", ""};
    fst_result_clear(&result);
    fst_status status = begin(&l, &own);
    if (status == FST_OK)
        status = go_on(&l, &result, &own);
    if (l.run)
        fst_watched_run_free(l.run);
    free(l.run);
    if (l.answer != FST_OK) {
        if (error)
            *error = own;
        return l.answer;
    }
    *follows = work->done(work->user, job, status, &result, &own);
    return FST_OK;
}
