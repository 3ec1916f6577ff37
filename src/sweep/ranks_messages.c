/* ranks_messages.c - the messages between the leader (rank 0) and the followers of a sweep.
 *
 *  follower                         leader
 *    ASK    I have room for n tasks   -->
 *                                     <--  IMAGE   of an unfinished run, before the task that goes on from it
 *                                     <--  TASKS   an empty list: there are no more
 *    ROWS   finished points           -->
 *    IMAGE  of an unfinished run      -->
 *                                     <--  STOP    the caller wants the work to end
 *    DONE   my status and error       -->
 *                                     <--  BYE     the last message between the two
 *
 * All ranks run the same build on the same kind of machine (their fingerprints agree), so structures are sent
 * as they lie in memory.
 */
#include "sweep/ranks.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/error.h"
#include "base/watch.h"

enum { TAG_ASK = 1, TAG_TASKS, TAG_ROWS, TAG_STOP, TAG_DONE, TAG_BYE, TAG_IMAGE };
enum { FOLLOWER_TASKS = 64, MOST_LETTERS = 16 };
static const double WAIT_SECONDS = 0.002;

static void wait_a_little(void)
{
    const struct timespec time = {0, (long)(1e9 * WAIT_SECONDS)};
    (void)nanosleep(&time, NULL);
}

/* ------------------------------------------------------------------ images */

static const size_t IMAGE_HEAD = offsetof(fst_image, bytes) - offsetof(fst_image, point);

static void post_image(const fst_ranks *r, int to, const fst_image *image)
{
    /* If an image cannot be sent, its run begins anew: that costs time, and nothing else. */
    (void)r->mpi->post(r->link, to, TAG_IMAGE, &image->point, IMAGE_HEAD + image->size);
}

/* Receive an image of this size; NULL where the message is not an image or there is no memory. *received tells
 * whether a message was taken. */
static fst_image *receive_image(const fst_ranks *r, int from, size_t size, int *received)
{
    fst_image *image = size >= IMAGE_HEAD ? fst_image_new(0, NULL, size - IMAGE_HEAD) : NULL;
    *received = image && r->mpi->receive(r->link, from, TAG_IMAGE, &image->point, size);
    if (*received && image->size == size - IMAGE_HEAD)
        return image;
    free(image);
    return NULL;
}

/* What a follower says at its end. */
typedef struct farewell {
    fst_status status;
    char machine[64];
    fst_error error;
} farewell;

/* ------------------------------------------------------------------ the leader's side */

struct fst_leader {
    const fst_ranks *ranks;
    int *room; /* tasks for which each rank has room and waits */
    int followers, stopped;
};

fst_status fst_leader_new(const fst_ranks *ranks, fst_leader **leader, fst_error *error)
{
    *leader = calloc(1, sizeof **leader);
    int *room = calloc((size_t)ranks->count, sizeof *room);
    if (!*leader || !room) {
        free(*leader);
        free(room);
        *leader = NULL;
        return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    }
    **leader = (fst_leader){.ranks = ranks, .room = room, .followers = ranks->count - 1};
    return FST_OK;
}

void fst_leader_free(fst_leader *leader)
{
    if (!leader)
        return;
    free(leader->room);
    free(leader);
}

int fst_leader_followers(const fst_leader *leader)
{
    return leader->followers;
}

void fst_leader_stop(fst_leader *leader)
{
    const fst_ranks *r = leader->ranks;
    for (int to = 1; to < r->count && !leader->stopped; ++to)
        (void)r->mpi->post(r->link, to, TAG_STOP, NULL, 0);
    leader->stopped = 1;
}

/* Tasks that leave this process take their images with them. */
static void hand_out_images(const fst_ranks *r, fst_workers *workers, int to, const fst_sweep_task *tasks,
                            int count)
{
    for (int i = 0; i < count; ++i) {
        fst_image *image = fst_workers_withdraw_image(workers, tasks[i].point);
        if (image)
            post_image(r, to, image);
        free(image);
    }
}

/* Hand tasks to the ranks that wait for them. */
static fst_status hand_out(fst_leader *leader, fst_workers *workers, fst_error *error)
{
    const fst_ranks *r = leader->ranks;
    fst_sweep_task tasks[FOLLOWER_TASKS];
    for (int to = 1; to < r->count; ++to) {
        int over = 0;
        if (leader->room[to] == 0)
            continue;
        const int most = leader->room[to] < FOLLOWER_TASKS ? leader->room[to] : FOLLOWER_TASKS;
        const int count = fst_workers_withdraw(workers, tasks, most, 2 * r->count, &over);
        if (count == 0 && !over)
            continue; /* the leader fills its queue before it comes here again */
        leader->room[to] = 0;
        hand_out_images(r, workers, to, tasks, count);
        if (!r->mpi->post(r->link, to, TAG_TASKS, tasks, (size_t)count * sizeof *tasks))
            return fst_fail(error, FST_IO, "MPI", "rank %d cannot be reached", to);
    }
    return FST_OK;
}

static fst_status hear_farewell(fst_leader *leader, int from, const farewell *last, fst_error *error)
{
    const fst_ranks *r = leader->ranks;
    leader->followers -= 1;
    (void)r->mpi->post(r->link, from, TAG_BYE, NULL, 0);
    if (last->status == FST_OK)
        return FST_OK;
    char where[128];
    (void)snprintf(where, sizeof where, "rank %d on %.63s", from, last->machine);
    return fst_fail(error, last->status, where, "%s%s%s", last->error.where, last->error.where[0] ? ": " : "",
                    last->error.sentence);
}

fst_status fst_leader_attend(fst_leader *leader, fst_workers *workers, fst_sweep_record *rows, int *count,
                             fst_image **images, fst_error *error)
{
    const fst_ranks *r = leader->ranks;
    int from, tag;
    size_t size;
    farewell last;
    fst_status status = FST_OK;
    *count = 0;
    while (status == FST_OK && *count == 0 && r->mpi->probe(r->link, &from, &tag, &size)) {
        int room = 0, received = 1;
        if (tag == TAG_IMAGE) {
            fst_image *image = receive_image(r, from, size, &received);
            if (!received)
                return fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
            if (image)
                fst_image_put(images, image);
            continue;
        }
        void *into = tag == TAG_ASK ? (void *)&room : tag == TAG_ROWS ? (void *)rows : (void *)&last;
        const size_t most = tag == TAG_ASK    ? sizeof room
                            : tag == TAG_ROWS ? FST_WORKERS_ROWS * sizeof *rows
                                              : sizeof last;
        if (size > most || !r->mpi->receive(r->link, from, tag, into, size))
            return fst_fail(error, FST_IO, "MPI", "rank %d sent a message of an unknown kind", from);
        if (tag == TAG_ASK)
            leader->room[from] = room;
        else if (tag == TAG_ROWS)
            *count = (int)(size / sizeof *rows);
        else
            status = hear_farewell(leader, from, &last, error);
    }
    return status == FST_OK ? hand_out(leader, workers, error) : status;
}

/* ------------------------------------------------------------------ a follower's side */

/* Take the leader's messages; *over becomes 1 at BYE. */
static void hear_leader(const fst_ranks *r, fst_workers *workers, int *over)
{
    int from, tag;
    size_t size;
    fst_sweep_task tasks[FOLLOWER_TASKS];
    while (!*over && r->mpi->probe(r->link, &from, &tag, &size)) {
        if (tag == TAG_IMAGE) {
            int received;
            fst_image *image = receive_image(r, from, size, &received);
            if (!received)
                return;
            if (image && workers)
                fst_workers_give_image(workers, image);
            else
                free(image);
            continue;
        }
        if (size > sizeof tasks || !r->mpi->receive(r->link, from, tag, tasks, size))
            return;
        *over = tag == TAG_BYE;
        if (workers && tag == TAG_TASKS)
            fst_workers_give(workers, tasks, (int)(size / sizeof *tasks));
        if (workers && tag == TAG_STOP)
            fst_workers_stop(workers, 0);
    }
}

/* Exchange messages with the leader until the workers have nothing more to do. */
static fst_status serve(const fst_ranks *r, fst_workers *workers, fst_sweep_record *rows,
                        const fst_sweep_options *options, fst_error *error)
{
    fst_status outcome = FST_OK;
    int busy = 1, over = 0;
    while (busy) {
        const int room = fst_workers_room(workers);
        if (room > 0 && outcome == FST_OK) {
            fst_workers_expect(workers, 1);
            (void)r->mpi->post(r->link, 0, TAG_ASK, &room, sizeof room);
        }
        hear_leader(r, workers, &over);
        const int letters = r->mpi->pending(r->link);
        if (letters > MOST_LETTERS) { /* the leader is slower than the workers: give it time */
            wait_a_little();
        } else {
            const int count = fst_workers_take(workers, rows, WAIT_SECONDS, &busy);
            if (count > 0)
                (void)r->mpi->post(r->link, 0, TAG_ROWS, rows, (size_t)count * sizeof *rows);
            fst_image *images = fst_workers_take_images(workers);
            for (const fst_image *i = images; i; i = i->next)
                post_image(r, 0, i);
            fst_images_free(images);
        }
        if (outcome == FST_OK) /* only the leader knows how much is done */
            outcome = fst_tell(options->progress, 0.0, NULL, error);
        if (outcome != FST_OK)
            fst_workers_stop(workers, 0);
    }
    return outcome;
}

fst_status fst_follow(const fst_ranks *r, const fst_sweep_identity *identity, const fst_sweep_options *options,
                      const fst_workers_plan *plan, fst_status failed, fst_error *error)
{
    farewell last;
    memset(&last, 0, sizeof last);
    fst_workers *workers = NULL;
    fst_sweep_record *rows = malloc(FST_WORKERS_ROWS * sizeof *rows);
    fst_status status = failed;
    if (status == FST_OK && !rows)
        status = fst_fail(error, FST_NO_MEMORY, "fst_sweep", "out of memory");
    fst_workers_plan own = *plan;
    own.depth = FOLLOWER_TASKS;
    if (status == FST_OK)
        status = fst_workers_new(identity, &own, &workers, error);
    if (status == FST_OK) {
        const fst_status outcome = serve(r, workers, rows, options, error);
        status = fst_workers_end(workers, error);
        if (status == FST_OK)
            status = outcome;
    }
    free(rows);
    last.status = status;
    (void)gethostname(last.machine, sizeof last.machine - 1);
    if (status != FST_OK && error)
        last.error = *error;
    (void)r->mpi->post(r->link, 0, TAG_DONE, &last, sizeof last);
    for (int over = 0; !over;) {
        hear_leader(r, NULL, &over);
        (void)r->mpi->pending(r->link);
        wait_a_little();
    }
    return status;
}
