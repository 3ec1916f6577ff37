/* splitting_rows.c - rows by the splitting method, side by side in lanes.
 *
 * Jobs come from one source, which may mix the methods:
 *
 *     source --next--> jobs of events    --> by_events()
 *                  \-> jobs of splitting --> lanes here
 *
 * Each side takes jobs until it meets one of the other's, which it leaves in the queue `left`; it then finishes
 * what it has, and the other side goes on with the queue.  A source whose jobs are all of one method, as nearly
 * every sweep, never changes sides.
 *
 * The kinds of a model (lines, material) are shared by a batch: a job of another kind waits until the lanes are
 * empty.  Runs are short, so no images of unfinished ones are made: a sweep that is killed does them again.
 */
#include "study/splitting_rows.h"

#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"
#include "study/conclude.h"
#include "study/splitting_run.h"

enum { MOST_LANES = 8, MOST_LEFT = 64 };

typedef struct source {
    const fst_row_work *work;
    int method;                  /* of the side that is at work */
    fst_row_job left[MOST_LEFT]; /* jobs that were taken but are of the other side, or could not begin yet */
    int left_count;
    int exhausted; /* the work has no more jobs */
    int later;     /* it has none at the moment */
} source;

/* Take a job of the present side from the queue. */
static int take_left(source *s, fst_row_job *job)
{
    for (int i = 0; i < s->left_count; ++i)
        if (s->left[i].params.run_method == s->method) {
            *job = s->left[i];
            s->left[i] = s->left[--s->left_count];
            return 1;
        }
    return 0;
}

/* The next job of the present side, as fst_row_work.next; 0 also where one of the other side is first, which
 * waits from then on. */
static int next_job(void *user, fst_row_job *job)
{
    source *s = user;
    if (take_left(s, job))
        return 1;
    if (s->left_count > 0 || s->exhausted)
        return 0;
    const int came = s->work->next(s->work->user, job);
    s->exhausted = came == 0;
    s->later = came < 0;
    if (came <= 0)
        return came;
    if (job->params.run_method == s->method)
        return 1;
    s->left[s->left_count++] = *job;
    return 0;
}

static int job_done(void *user, fst_row_job *job, fst_status status, const fst_run_result *result,
                    const fst_error *error)
{
    source *s = user;
    if (!s->work->done(s->work->user, job, status, result, error))
        return 0;
    if (job->params.run_method == s->method)
        return 1;
    s->left[s->left_count++] = *job;
    return 0;
}

/* ------------------------------------------------------------------ lanes */

typedef struct lane {
    int busy;
    fst_row_job job;
    fst_splitting_run run;
} lane;

typedef struct batch {
    source *from;
    const fst_splitting_engine *engine;
    void *memory;
    lane lanes[MOST_LANES];
    int occupied, loaded; /* lanes with a run; whether any was ever loaded */
    fst_kinds kinds;      /* of the runs in the lanes */
    int job_waits;        /* a job of other kinds is in the queue */
} batch;

/* Hand over a result; 1 where `l` has a job that is to follow. */
static int hand_over(batch *b, lane *l, fst_status status, const fst_run_result *result, const fst_error *error)
{
    return job_done(b->from, &l->job, status, result, error);
}

/* Begin the job of a lane; 0: it failed, and that was handed over, or it has to wait. */
static int begin(batch *b, int index)
{
    lane *l = &b->lanes[index];
    fst_error error = {FST_OK, "", ""};
    int has_job = 1;
    while (has_job) {
        const double *start = l->job.has_start ? l->job.start : NULL;
        const fst_status status = fst_splitting_begin(&l->run, &l->job.params, start, &error);
        if (status == FST_OK)
            break;
        fst_splitting_free(&l->run);
        fst_run_result nothing;
        fst_result_clear(&nothing);
        has_job = hand_over(b, l, status, &nothing, &error);
    }
    if (!has_job)
        return 0;
    const fst_kinds *kinds = &l->run.model->coefficients.kinds;
    if (b->occupied > 0 && !fst_kinds_equal(kinds, &b->kinds)) {
        fst_splitting_free(&l->run);
        b->from->left[b->from->left_count++] = l->job;
        b->job_waits = 1;
        return 0;
    }
    /* A lane that has never been used would compute with numbers that are none. */
    for (int i = 0; !b->loaded && i < b->engine->width; ++i)
        b->engine->load(b->memory, i, &l->run.job);
    b->kinds = *kinds;
    b->engine->load(b->memory, index, &l->run.job);
    b->loaded = 1;
    l->busy = 1;
    b->occupied += 1;
    return 1;
}

static void fill(batch *b)
{
    if (b->occupied == 0)
        b->job_waits = 0;
    for (int i = 0; i < b->engine->width && !b->job_waits; ++i)
        while (!b->lanes[i].busy && !b->job_waits && next_job(b->from, &b->lanes[i].job) > 0)
            (void)begin(b, i);
}

/* The run of a lane is over; the job that follows it, if any, takes the lane. */
static void finish(batch *b, int index)
{
    lane *l = &b->lanes[index];
    fst_run_result result;
    fst_splitting_outcome outcome;
    fst_error error = {FST_OK, "", ""};
    fst_result_clear(&result);
    fst_splitting_outcome_of(b->engine, b->memory, index, &l->run.job, &outcome);
    const fst_status status = fst_splitting_conclude(&l->run, &outcome, &result, &error);
    fst_splitting_free(&l->run);
    l->busy = 0;
    b->occupied -= 1;
    if (hand_over(b, l, status, &result, &error))
        (void)begin(b, index);
}

static fst_status splitting_side(source *from, const fst_splitting_engine *engine, fst_error *error)
{
    enum { STEPS = 2048 }; /* between two looks: some milliseconds */
    batch *b = calloc(1, sizeof *b);
    void *memory = aligned_alloc(64, (engine->bytes + 63) / 64 * 64);
    fst_status status = b && memory ? FST_OK : fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    if (status == FST_OK) {
        memset(memory, 0, engine->bytes);
        *b = (batch){.from = from, .engine = engine, .memory = memory};
        fill(b);
    }
    while (status == FST_OK && b->occupied > 0) {
        const unsigned over = engine->go_on(memory, STEPS);
        for (int i = 0; i < engine->width; ++i)
            if (b->lanes[i].busy && (over >> i & 1u))
                finish(b, i);
        fill(b);
        if (b->occupied > 0)
            status = fst_tell(from->work->progress, 0.0, NULL, error);
    }
    for (int i = 0; b && i < engine->width; ++i)
        if (b->lanes[i].busy)
            fst_splitting_free(&b->lanes[i].run);
    free(memory);
    free(b);
    return status;
}

/* Whether there is something to do now. */
static int is_unfinished(const source *s)
{
    return s->left_count > 0 || !(s->exhausted || s->later);
}

fst_status fst_rows_by_method(const fst_row_work *work, const fst_row_images *images,
                              const fst_splitting_engine *engine, fst_event_rows *by_events, void *user,
                              fst_error *error)
{
    source *s = calloc(1, sizeof *s);
    if (!s)
        return fst_fail(error, FST_NO_MEMORY, "fst_rows", "out of memory");
    s->work = work;
    fst_row_work side = *work;
    side.user = s;
    side.next = next_job;
    side.done = job_done;
    fst_status status = FST_OK;
    while (status == FST_OK && is_unfinished(s)) {
        s->method = FST_METHOD_EVENTS;
        status = by_events(&side, images, user, error);
        s->method = FST_METHOD_SPLITTING;
        if (status == FST_OK && is_unfinished(s))
            status = splitting_side(s, engine, error);
    }
    free(s);
    return status;
}
