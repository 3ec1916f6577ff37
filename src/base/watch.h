/* watch.h - the caller of a long computation is told how far it is, and may want no more of it.
 *
 * One watch goes down with the work, into the innermost loop.  Work is counted in evaluations of the equations
 * of motion, so that the caller is asked at even intervals whatever the loop.  Once the answer is no, the watch
 * answers so for good: many loops take a failure for "nothing is here" and go on, and each then meets the same
 * answer at its next step, without any work being done.
 */
#ifndef FST_BASE_WATCH_H
#define FST_BASE_WATCH_H

#include <festoon/festoon.h>

/* Tell the caller, if there is one to tell. */
static inline fst_status fst_tell(const fst_progress *progress, double fraction, const char *what,
                                  fst_error *error)
{
    return progress ? progress->tell(progress->user, fraction, what, error) : FST_OK;
}

/* A part of a longer piece of work, from one fraction of it to another: fst_part_tell(), with the part as its
 * user, is the tell() of the part and tells the caller of the whole. */
typedef struct fst_part {
    const fst_progress *whole; /* NULL: nobody is told */
    double from, to;
    const char *what; /* the name of the part; NULL: the name that the part itself gives */
} fst_part;

static inline fst_status fst_part_tell(void *user, double fraction, const char *what, fst_error *error)
{
    const fst_part *part = (const fst_part *)user;
    return fst_tell(part->whole, part->from + fraction * (part->to - part->from),
                    part->what ? part->what : what, error);
}

enum { FST_WATCH_WORK = 4000 }; /* evaluations between two questions: a few milliseconds */

typedef struct fst_watch {
    const fst_progress *progress; /* NULL: nobody is told, and nobody stops the work */
    double share[2];              /* of the whole work: where the present part begins and ends */
    double fraction;              /* of the whole work; it never falls */
    unsigned work;                /* since the last question */
    fst_status status;            /* other than FST_OK once the caller wanted no more */
    fst_error error;              /* what the caller said then */
} fst_watch;

static inline void fst_watch_begin(fst_watch *watch, const fst_progress *progress)
{
    *watch = (fst_watch){.progress = progress, .share = {0.0, 1.0}};
}

/* The present part of the work. */
static inline void fst_watch_part(fst_watch *watch, double from, double to)
{
    if (watch) {
        watch->share[0] = from;
        watch->share[1] = to;
    }
}

/* How much of the present part is done. */
static inline void fst_watch_reach(fst_watch *watch, double x)
{
    if (!watch)
        return;
    const double fraction = watch->share[0] + x * (watch->share[1] - watch->share[0]);
    watch->fraction = fraction > watch->fraction ? fraction : watch->fraction;
}

/* Tell the caller, and ask whether the work may go on: FST_OK, or the answer.  No watch: FST_OK. */
static inline fst_status fst_watch_ask(fst_watch *watch, fst_error *error)
{
    if (!watch)
        return FST_OK;
    watch->work = 0;
    if (watch->status == FST_OK && watch->progress)
        watch->status = watch->progress->tell(watch->progress->user, watch->fraction, NULL, &watch->error);
    if (watch->status != FST_OK && error)
        *error = watch->error;
    return watch->status;
}

/* The same from an inner loop, which has done, or is about to do, so many evaluations: the caller is asked when
 * enough have come together. */
static inline fst_status fst_watch_count(fst_watch *watch, unsigned evaluations, fst_error *error)
{
    if (!watch)
        return FST_OK;
    watch->work += evaluations;
    return watch->status != FST_OK || watch->work >= FST_WATCH_WORK ? fst_watch_ask(watch, error) : FST_OK;
}

#endif
