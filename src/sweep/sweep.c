/* sweep.c - a sweep: threads compute rows, and one thread of one process keeps the journal.
 *
 *  grid --> points without a row --> tasks queue --> workers --> rows queue --> journal --> FILE.db
 *           look_for_tasks()         workers.c       workers.c   workers.c      journal.c
 *
 * A refined sweep takes its points from refine.c, which learns of each row that comes to the journal.
 *
 * That one thread, the caller's, goes round in keep_journal(): it fills the queue of tasks from the journal,
 * hands tasks to the other ranks where mpirun started several processes (ranks.h), writes the rows and images
 * that came back, commits now and then, and tells the caller's progress.  A stop (Ctrl-C, a failure) goes the
 * same way: no new tasks, unfinished runs leave their images, and everything is committed before the call
 * returns.
 */
#include "sweep/sweep.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/clock.h"
#include "base/error.h"
#include "base/watch.h"
#include "host/threads.h"
#include "sweep/checkpoints.h"
#include "sweep/outcomes.h"
#include "sweep/ranks.h"
#include "sweep/refined.h"
#include "sweep/workers.h"

enum { OPTIONS_COOKIE = 0x53574550, COMMIT_ROWS = 256 };
static const double COMMIT_SECONDS = 0.5;
/* How long to wait for rows. */
static const double WAIT_SECONDS = 0.05;
/* The same under mpirun, where messages of the other processes are looked for between two waits. */
static const double WAIT_SECONDS_RANKS = 0.002;
static const double FAREWELL_SECONDS = 10.0; /* how long to wait for followers that were told to stop */

typedef struct sweep {
    fst_sweep_identity identity;
    fst_journal *journal;
    fst_checkpoints *checkpoints;
    const fst_sweep_options *options;
    fst_ranks ranks;
    fst_leader *leader; /* NULL where there is one rank */
    fst_workers *workers;
    fst_refining refining;
    fst_refinement *refinement; /* NULL: every point is computed */
    int64_t next;               /* the points or chains before this one were looked up in the journal */
    fst_sweep_counts *counts;   /* the caller's, always up to date */
    double started, committed;
    double processor_started, journal_started;
    double told;     /* the greatest part that was reported as done */
    int uncommitted; /* rows and images added since the last commit */
    int stopping;    /* the sweep is ending: commit whatever comes at once */
    int no_answer;   /* a follower was told to stop and did not answer */
} sweep;

fst_sweep_options fst_default_sweep_options(void)
{
    fst_sweep_options o;
    memset(&o, 0, sizeof o);
    o.cookie = OPTIONS_COOKIE;
    o.arithmetic = fst_best_arithmetic();
    o.checkpoint_seconds = 3.0;
    return o;
}

static double read_clock(clockid_t clock)
{
    struct timespec time = {0, 0};
    (void)clock_gettime(clock, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* Note how much time the sweep has taken so far. */
static void read_clocks(sweep *s)
{
    s->counts->seconds = fst_clock_seconds() - s->started;
    s->counts->processor_seconds = read_clock(CLOCK_PROCESS_CPUTIME_ID) - s->processor_started;
    s->counts->journal_seconds = read_clock(CLOCK_THREAD_CPUTIME_ID) - s->journal_started;
}

/* The part that is done.  It never falls, though a refinement may find that more points are wanted. */
static double fraction_done(sweep *s)
{
    const double part = (double)s->counts->computed / (double)s->counts->expected;
    s->told = part > s->told ? part : s->told;
    return s->told;
}

/* Note how many points have their rows, and how many are to have one. */
static void count_points(sweep *s)
{
    fst_sweep_counts *c = s->counts;
    const fst_refinement_counts refined =
        s->refinement ? fst_refinement_count(s->refinement)
                      : (fst_refinement_counts){fst_sweep_point_count(&s->identity), c->there,
                                                fst_sweep_point_count(&s->identity), 0};
    c->wanted = refined.wanted;
    c->computed = refined.known;
    c->expected = refined.expected;
    c->undefined = refined.undefined;
}

/* ------------------------------------------------------------------ tasks */

/* The task that goes on with a chain; *found is 0 where the chain is finished. */
static fst_status resume_chain(sweep *s, int64_t chain, fst_sweep_task *t, int *found, fst_error *error)
{
    const int64_t count = fst_chain_length(&s->identity);
    int there = 1, usable = 0;
    *found = 0;
    t->has_start = 0;
    for (int64_t place = 0; place < count; ++place) {
        t->point = fst_chain_point(&s->identity, chain, place);
        double end[FST_BEAD_NUMBERS];
        const fst_status status = fst_journal_end_state(s->journal, t->point, &there, &usable, end, error);
        if (status != FST_OK)
            return status;
        if (!there) {
            *found = 1;
            return FST_OK;
        }
        t->has_start = usable;
        memcpy(t->start, end, sizeof end);
    }
    return FST_OK;
}

/* Find points that the refinement wants and that have no row.  A point that has one, from an earlier call, only
 * tells its value. */
static fst_status look_for_refined(sweep *s, fst_sweep_task *fresh, int room, int *found, fst_error *error)
{
    enum { MOST_LOOKS = 4096 }; /* between two looks at everything else: some milliseconds */
    fst_status status = FST_OK;
    int64_t point;
    for (int i = 0; i < MOST_LOOKS && *found < room && status == FST_OK; ++i) {
        int there = 0;
        double value = 0.0;
        if (!fst_refinement_next(s->refinement, &point))
            break;
        status = fst_journal_value(s->journal, point, &there, &value, error);
        if (status == FST_OK && there)
            status = fst_refinement_note(s->refinement, point, value, error);
        else if (status == FST_OK)
            fresh[(*found)++] = (fst_sweep_task){.point = point};
    }
    return status;
}

/* Find tasks for points without a row; *found is 0 when there are none now. */
static fst_status look_for_tasks(sweep *s, fst_sweep_task *fresh, int room, int *found, fst_error *error)
{
    fst_status status = FST_OK;
    *found = 0;
    if (s->refinement)
        return look_for_refined(s, fresh, room, found, error);
    if (s->identity.carry == FST_CARRY_NO) {
        int64_t points[FST_WORKERS_TASKS];
        status = fst_journal_missing(s->journal, &s->next, points, room, found, error);
        for (int i = 0; i < *found; ++i) {
            fresh[i].point = points[i];
            fresh[i].has_start = 0;
        }
        return status;
    }
    for (; s->next < fst_chain_count(&s->identity) && *found < room && status == FST_OK; ++s->next) {
        int is_open;
        if (!fst_sweep_has_task(&s->identity, s->next))
            continue;
        status = resume_chain(s, s->next, &fresh[*found], &is_open, error);
        *found += status == FST_OK && is_open;
    }
    return status;
}

/* Give the workers the images of unfinished runs, before the tasks that go on from them. */
static void find_images(sweep *s, const fst_sweep_task *tasks, int count)
{
    for (int i = 0; i < count; ++i) {
        size_t size;
        void *bytes = fst_checkpoints_get(s->checkpoints, tasks[i].point, &size);
        fst_image *image = bytes ? fst_image_new(tasks[i].point, bytes, size) : NULL;
        if (image)
            fst_workers_give_image(s->workers, image);
        free(bytes);
    }
}

/* Whether rows that are not there yet may make further tasks. */
static int may_want_more(const sweep *s)
{
    if (!s->refinement)
        return 0;
    const fst_refinement_counts counts = fst_refinement_count(s->refinement);
    return counts.known < counts.wanted;
}

/* Fill up the workers' queue of tasks. */
static fst_status refill(sweep *s, fst_error *error)
{
    if (s->refinement)
        fst_workers_expect(s->workers, !fst_refinement_has_next(s->refinement) && may_want_more(s));
    const int room = fst_workers_room(s->workers);
    if (room == 0)
        return FST_OK;
    fst_sweep_task *fresh = malloc((size_t)room * sizeof *fresh);
    if (!fresh)
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    int found;
    const fst_status status = look_for_tasks(s, fresh, room, &found, error);
    const int is_over = found == 0 && !may_want_more(s);
    if (status == FST_OK && (found > 0 || is_over)) {
        find_images(s, fresh, found);
        fst_workers_give(s->workers, fresh, found);
    }
    free(fresh);
    return status;
}

/* ------------------------------------------------------------------ rows */

static fst_status commit(sweep *s, fst_error *error)
{
    const fst_status status = fst_journal_commit(s->journal, error);
    s->committed = fst_clock_seconds();
    s->uncommitted = 0;
    return status;
}

/* Tell the refinement what a new row says, as the database will say it to a later call. */
static fst_status note_row(sweep *s, int64_t point, fst_error *error)
{
    int there;
    double value;
    const fst_status status = fst_journal_value(s->journal, point, &there, &value, error);
    return status == FST_OK ? fst_refinement_note(s->refinement, point, value, error) : status;
}

/* Write rows, and commit now and then. */
static fst_status write_rows(sweep *s, const fst_sweep_record *rows, int count, fst_error *error)
{
    fst_status status = FST_OK;
    for (int i = 0; i < count && status == FST_OK; ++i) {
        status = fst_journal_add(s->journal, &rows[i], error);
        if (status == FST_OK)
            status = fst_checkpoints_drop(s->checkpoints, rows[i].point, error);
        if (status == FST_OK && s->refinement)
            status = note_row(s, rows[i].point, error);
    }
    for (int i = 0; i < count; ++i)
        s->counts->failed += rows[i].status != FST_OK;
    s->uncommitted += count;
    if (status == FST_OK && s->uncommitted > 0 &&
        (s->stopping || s->uncommitted >= COMMIT_ROWS || fst_clock_seconds() - s->committed > COMMIT_SECONDS))
        status = commit(s, error);
    if (status == FST_OK) {
        s->counts->added += count;
        fst_outcomes_add(fst_grid_row_kind(s->identity.grid), rows, count, s->counts);
        s->counts->there += count;
    }
    return status;
}

/* Write images of unfinished runs, and free the list. */
static fst_status write_images(sweep *s, fst_image *images, fst_error *error)
{
    fst_status status = FST_OK;
    for (const fst_image *i = images; i && status == FST_OK; i = i->next) {
        status = fst_checkpoints_put(s->checkpoints, i->point, i->bytes, i->size, error);
        s->uncommitted += 1;
    }
    fst_images_free(images);
    return status;
}

/* Write the rows of the other ranks.  A failure there is put into *outcome: rows that have come are written all
 * the same, unless the journal itself has failed. */
static fst_status hear_followers(sweep *s, fst_sweep_record *rows, int abandoned, fst_status *outcome,
                                 fst_error *error)
{
    fst_status status = FST_OK;
    int count = s->leader != NULL;
    while (count > 0 && status == FST_OK) {
        fst_error trouble;
        fst_image *images = NULL;
        const fst_status heard = fst_leader_attend(s->leader, s->workers, rows, &count, &images, &trouble);
        if (*outcome == FST_OK && heard != FST_OK) {
            *outcome = heard;
            if (error)
                *error = trouble;
        }
        if (abandoned) {
            fst_images_free(images);
            continue;
        }
        status = write_images(s, images, error);
        if (status == FST_OK)
            status = write_rows(s, rows, count, error);
    }
    return status;
}

/* Write the rows and images of our own workers; wait up to `seconds` for rows. */
static fst_status hear_workers(sweep *s, fst_sweep_record *rows, double seconds, int abandoned, int *busy,
                               fst_error *error)
{
    const int count = fst_workers_take(s->workers, rows, seconds, busy);
    fst_image *images = fst_workers_take_images(s->workers);
    if (abandoned) {
        fst_images_free(images);
        return FST_OK;
    }
    const fst_status status = write_images(s, images, error);
    return status == FST_OK ? write_rows(s, rows, count, error) : status;
}

/* Begin no more runs.  First commit what is there: the program that ends the other ranks may soon
 * end this one. */
static fst_status stop(sweep *s, fst_sweep_record *rows, fst_status status, fst_error *error)
{
    int busy;
    fst_workers_stop(s->workers, status != FST_OK);
    if (s->leader)
        fst_leader_stop(s->leader);
    s->stopping = 1;
    if (status == FST_OK)
        status = hear_workers(s, rows, 0.0, 0, &busy, error);
    return status == FST_OK ? commit(s, error) : status;
}

static int followers(const sweep *s)
{
    return s->leader ? fst_leader_followers(s->leader) : 0;
}

static void wait_for_messages(const sweep *s, int busy)
{
    const struct timespec time = {0, (long)(1e9 * WAIT_SECONDS_RANKS)};
    if (!busy && followers(s) > 0)
        (void)nanosleep(&time, NULL);
}

/* Keep the journal until no worker works any more.  After an interruption this still writes what was done. */
static fst_status keep_journal(sweep *s, fst_sweep_record *rows, fst_error *error)
{
    const double seconds = s->leader ? WAIT_SECONDS_RANKS : WAIT_SECONDS;
    fst_status status = FST_OK, outcome = FST_OK; /* of the journal; of everything else */
    double stopped = 0.0;
    int busy = 1;
    while (busy || followers(s) > 0) {
        if (status == FST_OK && outcome == FST_OK)
            status = refill(s, error);
        const int failed = status != FST_OK;
        const fst_status heard = hear_followers(s, rows, failed, &outcome, failed ? NULL : error);
        status = failed ? status : heard;
        const fst_status taken = hear_workers(s, rows, seconds, status != FST_OK, &busy, error);
        status = status == FST_OK ? taken : status;
        read_clocks(s);
        count_points(s);
        if (status == FST_OK && outcome == FST_OK)
            outcome = fst_tell(s->options->progress, fraction_done(s), NULL, error);
        if (stopped == 0.0 && (status != FST_OK || outcome != FST_OK)) {
            status = stop(s, rows, status, error);
            stopped = fst_clock_seconds();
        }
        s->no_answer = stopped > 0.0 && followers(s) > 0 && fst_clock_seconds() - stopped > FAREWELL_SECONDS;
        if (s->no_answer && !busy)
            break;
        wait_for_messages(s, busy);
    }
    return status != FST_OK ? status : outcome;
}

/* ------------------------------------------------------------------ the sweep */

/* As many threads as this process has processors, or its share of them where it has neighbours. */
static int thread_count(const sweep *s)
{
    const int asked = s->options->threads, wanted = asked > 0 ? asked : fst_processors(s->ranks.neighbours);
    const int64_t tasks = fst_sweep_task_count(&s->identity);
    return wanted > tasks ? (int)tasks : wanted;
}

/* One process writes all images.  So the more runs there are, the more rarely each is saved. */
static fst_workers_plan workers_plan(const sweep *s)
{
    enum { THREADS_AT_FULL_RATE = 8 };
    const int threads = thread_count(s), all = threads * s->ranks.count;
    const double share = 1.0 + (double)((all - 1) / THREADS_AT_FULL_RATE);
    return (fst_workers_plan){.threads = threads,
                              .depth = FST_WORKERS_TASKS,
                              .lanes = s->options->lanes,
                              .checkpoint_seconds = share * s->options->checkpoint_seconds};
}

static fst_status work(sweep *s, fst_error *error)
{
    const fst_workers_plan plan = workers_plan(s);
    fst_sweep_record *rows = malloc(FST_WORKERS_ROWS * sizeof *rows);
    fst_status status = rows ? FST_OK : fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    if (status == FST_OK && s->ranks.link)
        status = fst_leader_new(&s->ranks, &s->leader, error);
    if (status == FST_OK)
        status = fst_workers_new(&s->identity, &plan, &s->workers, error);
    if (status == FST_OK) {
        status = keep_journal(s, rows, error);
        fst_error own = {FST_OK, "", ""};
        const fst_status computed = fst_workers_end(s->workers, &own);
        if (status == FST_OK && computed != FST_OK) {
            status = computed;
            if (error)
                *error = own;
        }
    } else {
        s->no_answer =
            s->ranks.link != NULL; /* the followers wait in vain; the end of this process ends them */
    }
    fst_leader_free(s->leader);
    free(rows);
    return status;
}

static fst_status check_options(const fst_sweep_options *o, const fst_grid *grid, fst_error *error)
{
    if (o->lanes != 0 && o->lanes != 1 && o->lanes != 4 && o->lanes != 8)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.lanes",
                        "the number of lanes is 1, 4 or 8, not %d", o->lanes);
    if (!(o->checkpoint_seconds > 0))
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.checkpoint_seconds", "%g s must be positive",
                        o->checkpoint_seconds);
    const fst_row_kind kind = fst_grid_row_kind(grid);
    if ((kind == FST_ROWS_OF_BEADS || kind == FST_ROWS_OF_LEVITATION) &&
        (o->carry != FST_CARRY_NO || o->refine != 0))
        return fst_fail(
            error, FST_BAD_INPUT, o->refine ? "fst_sweep_options.refine" : "fst_sweep_options.carry",
            "the points of several beads and of levitation are all computed, each from its own start: leave "
            "this out");
    if (fst_grid_base(grid)->bead_count > FST_BEADS_MOST)
        return fst_fail(error, FST_BAD_INPUT, "beads", "a sweep takes at most %d beads, and the scene lists %d",
                        FST_BEADS_MOST, fst_grid_base(grid)->bead_count);
    const char *key = fst_grid_key(grid, 0);
    if (o->carry != FST_CARRY_NO &&
        (strcmp(key, "friction.gamma") == 0 || strcmp(key, "magnet.half_length") == 0))
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep_options.carry",
                        "%s changes the units, so a state cannot be carried along it", key);
    return kind == FST_ROWS_OF_WORLDS && o->carry != FST_CARRY_NO
               ? fst_check_carried_worlds(grid, o->progress, error)
               : FST_OK;
}

/* Which shard it is, if it is one. */
static fst_status take_shard(const fst_sweep_options *o, fst_sweep_identity *identity, fst_error *error)
{
    static const char where[] = "fst_sweep_options.shard";
    if (o->shard == 0 && o->shards == 0)
        return FST_OK;
    if (o->shard < 1 || o->shard > o->shards)
        return fst_fail(error, FST_BAD_INPUT, where,
                        "%d of %d is not a shard: they are counted from 1 to their number", o->shard,
                        o->shards);
    if (o->refine != 0)
        return fst_fail(error, FST_BAD_INPUT, where,
                        "a refined sweep has no shards, because which points it computes follows from the rows "
                        "around them: compute it with more threads, or by MPI");
    const int64_t tasks = fst_sweep_task_count(identity);
    if (o->shards > tasks)
        return fst_fail(error, FST_BAD_INPUT, where, "this sweep has only %lld %s to be shared by %d shards",
                        (long long)tasks, o->carry == FST_CARRY_NO ? "points" : "chains of carried states",
                        o->shards);
    identity->shard = o->shard - 1;
    identity->shards = o->shards;
    return FST_OK;
}

/* The part of rank 0, or of the only process: it has the journal. */
static fst_status lead(sweep *s, const char *path, fst_error *error)
{
    fst_status status =
        fst_arithmetic_fingerprint(s->identity.arithmetic, s->options->lanes, &s->identity.fingerprint, error);
    if (status == FST_OK)
        status = fst_journal_open(path, &s->identity, &s->journal, error);
    if (status == FST_OK)
        s->counts->repaired = fst_journal_repaired(s->journal, &s->counts->lost);
    if (status == FST_OK)
        status = fst_journal_refine(s->journal, &s->refining, error);
    if (status == FST_OK)
        status = fst_journal_count(s->journal, &s->counts->there, error);
    count_points(s);
    if (status == FST_OK)
        status =
            fst_checkpoints_open(s->journal, fst_journal_identity_hash(&s->identity), &s->checkpoints, error);
    if (status == FST_OK)
        s->counts->begun_anew = fst_checkpoints_damaged(s->checkpoints);
    fst_ranks_start start = {status, s->identity.arithmetic, fst_journal_identity_hash(&s->identity)};
    fst_error silence;
    const fst_status shared = fst_ranks_share_start(&s->ranks, &start, status == FST_OK ? error : &silence);
    status = status == FST_OK ? shared : status;
    if (status == FST_OK && (s->counts->there < s->counts->wanted || s->refinement || s->ranks.link))
        status = work(s, error);
    count_points(s);
    if (status == FST_OK)
        status = fst_journal_all_failed(s->journal, s->counts->all_failed, sizeof s->counts->all_failed, error);
    if (status == FST_OK && s->checkpoints)
        status = fst_checkpoints_drop_all(s->checkpoints, error);
    fst_checkpoints_close(s->checkpoints);
    fst_error closing;
    const fst_status closed = fst_journal_close(s->journal, &closing);
    if (closed != FST_OK && (status == FST_OK || status == FST_INTERRUPTED)) {
        status = closed;
        if (error)
            *error = closing;
    }
    return status;
}

/* The part of any other rank: it computes what the leader computes, or says that it cannot. */
static fst_status follow(sweep *s, fst_error *error)
{
    fst_ranks_start start;
    fst_status status = fst_ranks_share_start(&s->ranks, &start, error);
    if (status != FST_OK || start.status != FST_OK)
        return status == FST_OK ? start.status : status;
    s->identity.arithmetic = start.arithmetic;
    status = fst_arithmetic_fingerprint(start.arithmetic, s->options->lanes, &s->identity.fingerprint, error);
    if (status == FST_OK && fst_journal_identity_hash(&s->identity) != start.identity)
        status =
            fst_fail(error, FST_BAD_INPUT, "fst_sweep",
                     "this rank would compute other rows than rank 0: its processor, its festoon, its scene or "
                     "its options differ");
    const fst_workers_plan plan = workers_plan(s);
    return fst_follow(&s->ranks, &s->identity, s->options, &plan, status, error);
}

/* Lead, follow, or work alone.  The leader reports what happened to followers. */
static fst_status run_sweep(sweep *s, const char *path, fst_error *error)
{
    fst_status status = s->options->with_ranks ? fst_ranks_open(&s->ranks, error) : FST_OK;
    if (status != FST_OK) {
        fst_ranks_close(&s->ranks, 0);
        return status;
    }
    s->counts->rank = s->ranks.rank;
    s->counts->ranks = s->ranks.count;
    status = s->ranks.rank == 0 ? lead(s, path, error) : follow(s, error);
    if (s->ranks.rank != 0 && error)
        *error = (fst_error){status, "", ""};
    fst_ranks_close(&s->ranks, !s->no_answer);
    return status;
}

fst_status fst_sweep(const fst_params *params, const char *path, const fst_sweep_options *options,
                     fst_sweep_counts *counts, fst_error *error)
{
    memset(counts, 0, sizeof *counts);
    if (options->cookie != OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_sweep",
                        "the options were not made by fst_default_sweep_options()");
    fst_grid *grid;
    fst_status status = fst_grid_new(params, options->axes, options->axis_count, options->seed, &grid, error);
    if (status != FST_OK)
        return status;
    if (options->levitation)
        status = fst_grid_ask_levitation(grid, error);
    const fst_arithmetic arithmetic =
        fst_grid_row_kind(grid) == FST_ROWS_OF_RUNS ? options->arithmetic : FST_ARITHMETIC_PORTABLE;
    sweep s = {.identity = {grid, options->seed, options->carry, arithmetic, 0, 0, 1},
               .options = options,
               .counts = counts,
               .ranks = {.count = 1, .neighbours = 1}};
    if (status == FST_OK)
        status = check_options(options, grid, error);
    if (status == FST_OK)
        status = take_shard(options, &s.identity, error);
    if (status == FST_OK)
        status = fst_refining_of(options, &s.refining, error);
    if (status == FST_OK && options->refine != 0)
        status = fst_refinement_new(grid, s.refining.levels, s.refining.step, &s.refinement, error);
    if (status == FST_OK) {
        counts->points = fst_grid_points(grid);
        s.started = fst_clock_seconds();
        s.committed = s.started - COMMIT_SECONDS; /* the first row is committed at once */
        s.processor_started = read_clock(CLOCK_PROCESS_CPUTIME_ID);
        s.journal_started = read_clock(CLOCK_THREAD_CPUTIME_ID);
        status = run_sweep(&s, path, error);
        read_clocks(&s);
    }
    fst_refinement_free(s.refinement);
    fst_grid_free(grid);
    return status;
}
