/* watch.h - how the inner loops of a long computation tell the caller how far it is, and learn that it is to
 * stop.
 *
 * One watch is handed down into the innermost loop.  It counts work in evaluations of the equations of motion
 * and asks the caller at even intervals of work, whatever the loop.  Once the caller says stop, the watch
 * repeats that answer for ever: many loops take a failure for "nothing found here" and go on, and each of them
 * then meets the same answer at its next step, before it does any work.
 *
 *  caller's fst_progress <-- fst_watch <-- fst_watch_count() in loops   counts evaluations, asks every 4000
 *                        <-- fst_part  <-- fst_part_tell() of a part    [0, 1] of the part within the whole
 */
#ifndef FST_BASE_WATCH_H
#define FST_BASE_WATCH_H

#include <festoon/festoon.h>

/* Tell the caller, if there is one.  tell() gets room for an error also where the caller of the library wants
 * none. */
static inline fst_status fst_tell(const fst_progress *progress, double fraction, const char *what,
                                  fst_error *error)
{
    fst_error unheard = {FST_OK, "", ""};
    return progress ? progress->tell(progress->user, fraction, what, error ? error : &unheard) : FST_OK;
}

/* A part of a longer piece of work, which goes from one fraction of the whole to another.  fst_part_tell() with
 * the part as its user is the tell() that the part is given. */
typedef struct fst_part {
    const fst_progress *whole; /* NULL: nobody wants to know */
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
    const fst_progress *progress; /* NULL: no reports, and the work cannot be stopped */
    double share[2];              /* where the present part begins and ends in the whole work */
    double fraction;              /* largest fraction reported so far: progress never falls */
    const char *what;             /* what is at work, for people; NULL: nothing to say */
    unsigned work;                /* evaluations since the last question */
    fst_status status;            /* other than FST_OK once the caller said stop, or memory ran out */
    fst_error error;              /* what was said then */
} fst_watch;

static inline void fst_watch_begin(fst_watch *watch, const fst_progress *progress)
{
    *watch = (fst_watch){.progress = progress, .share = {0.0, 1.0}};
}

/* Set where the present part begins and ends. */
static inline void fst_watch_part(fst_watch *watch, double from, double to)
{
    if (watch) {
        watch->share[0] = from;
        watch->share[1] = to;
    }
}

/* Set how much of the present part is done. */
static inline void fst_watch_reach(fst_watch *watch, double x)
{
    if (!watch)
        return;
    const double fraction = watch->share[0] + x * (watch->share[1] - watch->share[0]);
    watch->fraction = fraction > watch->fraction ? fraction : watch->fraction;
}

/* Let a part of the work end with `status`.  That memory ran out is repeated for ever, as a stop is. */
static inline fst_status fst_watch_end(fst_watch *watch, fst_status status, const fst_error *error)
{
    if (watch && status == FST_NO_MEMORY && watch->status == FST_OK) {
        watch->status = status;
        watch->error = error ? *error : (fst_error){status, "", "out of memory"};
    }
    return status;
}

/* Tell the caller, and ask whether to go on.  FST_OK where it says so, and where there is no watch. */
static inline fst_status fst_watch_ask(fst_watch *watch, fst_error *error)
{
    if (!watch)
        return FST_OK;
    watch->work = 0;
    if (watch->status == FST_OK && watch->progress)
        watch->status =
            watch->progress->tell(watch->progress->user, watch->fraction, watch->what, &watch->error);
    if (watch->status != FST_OK && error)
        *error = watch->error;
    return watch->status;
}

/* The same from an inner loop that has done so many evaluations, or is about to: the caller is asked once
 * FST_WATCH_WORK of them have come together. */
static inline fst_status fst_watch_count(fst_watch *watch, unsigned evaluations, fst_error *error)
{
    if (!watch)
        return FST_OK;
    watch->work += evaluations;
    return watch->status != FST_OK || watch->work >= FST_WATCH_WORK ? fst_watch_ask(watch, error) : FST_OK;
}

#endif
