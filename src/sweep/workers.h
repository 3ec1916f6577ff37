/* workers.h - the threads that compute the rows of a sweep, between two bounded queues.
 *
 * One thread, which is none of the crew, gives tasks and takes rows; since both queues are bounded, the memory
 * of a sweep does not grow with its points.
 */
#ifndef FST_SWEEP_WORKERS_H
#define FST_SWEEP_WORKERS_H

#include "sweep/images.h"
#include "sweep/sweep.h"

enum { FST_CREW_TASKS = 1024, FST_CREW_ROWS = 512 };

typedef struct fst_crew fst_crew;

/* What a crew is like: its threads (fewer if the system has no more), the tasks in its queue, the lanes of each
 * thread, and the seconds of work after which the image of a run is made. */
typedef struct fst_crew_plan {
    int threads, depth, lanes;
    double checkpoint_seconds;
} fst_crew_plan;

fst_status fst_crew_new(const fst_sweep_identity *identity, const fst_crew_plan *plan, fst_crew **crew,
                        fst_error *error);

/* Number of tasks that should be given now: 0 while there are enough, or none are expected any more. */
int fst_crew_room(fst_crew *crew);

/* Tasks have been asked for elsewhere: until they are given, fst_crew_take() need not hurry back for more. */
void fst_crew_expect(fst_crew *crew);

/* Give tasks (at most fst_crew_room()); none: there will never be more. */
void fst_crew_give(fst_crew *crew, const fst_sweep_task *tasks, int count);

/* Take tasks back that no thread has begun: at most `most`, and a `share`-th of them, but one at least; *over
 * is set to 1 where none are left and none will come. */
int fst_crew_withdraw(fst_crew *crew, fst_sweep_task *tasks, int most, int share, int *over);

/* Take the rows that are done (room for FST_CREW_ROWS), waiting for them up to `seconds`; *busy tells whether
 * more can follow. */
int fst_crew_take(fst_crew *crew, fst_sweep_record *rows, double seconds, int *busy);

/* Give the image of a point before the task that it belongs to (it is the crew's then); take it back when that
 * was withdrawn (NULL: none). */
void fst_crew_give_image(fst_crew *crew, fst_image *image);
fst_image *fst_crew_withdraw_image(fst_crew *crew, int64_t point);

/* Take the images that were made since the last time, of runs whose rows were not taken yet. */
fst_image *fst_crew_take_images(fst_crew *crew);

/* Break runs off and begin no more; with `abandon` rows are not taken any more either. */
void fst_crew_stop(fst_crew *crew, int abandon);

/* Wait for the threads and free the crew; the first failure of a thread. */
fst_status fst_crew_end(fst_crew *crew, fst_error *error);

#endif
