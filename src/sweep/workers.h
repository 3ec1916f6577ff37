/* workers.h - the threads that compute the rows of a sweep, between two bounded queues.
 *
 * The thread that calls these functions keeps the journal and is not a worker itself; it gives tasks and takes
 * rows.
 */
#ifndef FST_SWEEP_WORKERS_H
#define FST_SWEEP_WORKERS_H

#include "sweep/images.h"
#include "sweep/sweep.h"

enum { FST_WORKERS_TASKS = 1024, FST_WORKERS_ROWS = 512 };

typedef struct fst_workers fst_workers;

/* How many threads (fewer if the system has no more), how many tasks in their queue, how many lanes each thread
 * has, and after how many seconds of work the image of a run is made. */
typedef struct fst_workers_plan {
    int threads, depth, lanes;
    double checkpoint_seconds;
} fst_workers_plan;

fst_status fst_workers_new(const fst_sweep_identity *identity, const fst_workers_plan *plan,
                           fst_workers **workers, fst_error *error);

/* How many tasks should be given now: 0 while there are enough, or where no more are expected. */
int fst_workers_room(fst_workers *workers);

/* Tasks are on their way, or depend on rows that are not there.  Until they come, fst_workers_take() does not
 * return early to ask for more; with `expecting` 0 it does again. */
void fst_workers_expect(fst_workers *workers, int expecting);

/* Give tasks, at most fst_workers_room(); an empty list says that there will never be more. */
void fst_workers_give(fst_workers *workers, const fst_sweep_task *tasks, int count);

/* Take back tasks that no thread has begun: one `share`-th of them, at least one and at most `most`. *over
 * becomes 1 where there are none and none will come. */
int fst_workers_withdraw(fst_workers *workers, fst_sweep_task *tasks, int most, int share, int *over);

/* Take the finished rows (room for FST_WORKERS_ROWS), waiting for them up to `seconds`. *busy tells whether
 * more can follow. */
int fst_workers_take(fst_workers *workers, fst_sweep_record *rows, double seconds, int *busy);

/* Give the image of a point before its task; it then belongs to the workers.  Take it back when the task was
 * taken back (NULL: there is none). */
void fst_workers_give_image(fst_workers *workers, fst_image *image);
fst_image *fst_workers_withdraw_image(fst_workers *workers, int64_t point);

/* Take the images made since the last call, of runs whose rows were not taken yet. */
fst_image *fst_workers_take_images(fst_workers *workers);

/* Break runs off and begin no more; with `abandon` rows are not taken any more either. */
void fst_workers_stop(fst_workers *workers, int abandon);

/* Wait for the threads and free the workers.  Returns the first failure of a thread. */
fst_status fst_workers_end(fst_workers *workers, fst_error *error);

#endif
