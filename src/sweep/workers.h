/* workers.h - the threads that compute the rows of a sweep, between two bounded queues.
 *
 * One thread, which is none of them, gives tasks and takes rows; since both queues are bounded, the memory
 * of a sweep does not grow with its points.
 */
#ifndef FST_SWEEP_WORKERS_H
#define FST_SWEEP_WORKERS_H

#include "sweep/images.h"
#include "sweep/sweep.h"

enum { FST_WORKERS_TASKS = 1024, FST_WORKERS_ROWS = 512 };

typedef struct fst_workers fst_workers;

/* What the workers are like: how many threads (fewer if the system has no more), the tasks in their queue, the
 * lanes of each thread, and the seconds of work after which the image of a run is made. */
typedef struct fst_workers_plan {
    int threads, depth, lanes;
    double checkpoint_seconds;
} fst_workers_plan;

fst_status fst_workers_new(const fst_sweep_identity *identity, const fst_workers_plan *plan,
                           fst_workers **workers, fst_error *error);

/* Number of tasks that should be given now: 0 while there are enough, or none are expected any more. */
int fst_workers_room(fst_workers *workers);

/* The leader has been asked for tasks: until they are given, fst_workers_take() need not hurry back for more.
 */
void fst_workers_expect(fst_workers *workers);

/* Give tasks (at most fst_workers_room()); none: there will never be more. */
void fst_workers_give(fst_workers *workers, const fst_sweep_task *tasks, int count);

/* Take tasks back that no thread has begun: at most `most`, and a `share`-th of them, but one at least; *over
 * is set to 1 where none are left and none will come. */
int fst_workers_withdraw(fst_workers *workers, fst_sweep_task *tasks, int most, int share, int *over);

/* Take the rows that are done (room for FST_WORKERS_ROWS), waiting for them up to `seconds`; *busy tells
 * whether more can follow. */
int fst_workers_take(fst_workers *workers, fst_sweep_record *rows, double seconds, int *busy);

/* Give the image of a point before the task that it belongs to (it is the workers' then); take it back when
 * that was withdrawn (NULL: none). */
void fst_workers_give_image(fst_workers *workers, fst_image *image);
fst_image *fst_workers_withdraw_image(fst_workers *workers, int64_t point);

/* Take the images that were made since the last time, of runs whose rows were not taken yet. */
fst_image *fst_workers_take_images(fst_workers *workers);

/* Break runs off and begin no more; with `abandon` rows are not taken any more either. */
void fst_workers_stop(fst_workers *workers, int abandon);

/* Wait for the threads and free the workers; the first failure of a thread. */
fst_status fst_workers_end(fst_workers *workers, fst_error *error);

#endif
