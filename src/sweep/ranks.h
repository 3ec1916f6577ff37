/* ranks.h - the processes (ranks) that mpirun or srun started together, and what they tell each other.
 *
 * Rank 0 leads: it alone opens the database, hands out tasks and writes rows.  The others follow: they ask for
 * tasks, compute, and send rows.  Every rank, the leader too, computes with workers of its own.
 *
 *              FILE.db
 *                 |
 *      rank 0: journal + workers
 *        |  tasks, images  ^  rows, images
 *        v                 |
 *      rank 1: workers    rank 2: workers   ...
 */
#ifndef FST_SWEEP_RANKS_H
#define FST_SWEEP_RANKS_H

#include "sweep/ranks_module.h"
#include "sweep/workers.h"

typedef struct fst_ranks {
    const fst_mpi_module_table *mpi;
    fst_mpi_link *link; /* NULL where this process is alone */
    int rank, count;
    int neighbours; /* ranks on this machine, this one included */
} fst_ranks;

/* Join the ranks of this job; alone where this process was not started as one of several.  FST_UNAVAILABLE: it
 * was, but this build has no MPI, or MPI does not see the others. */
fst_status fst_ranks_open(fst_ranks *ranks, fst_error *error);
void fst_ranks_close(fst_ranks *ranks, int together);

/* What the leader decides for all: whether the sweep begins, in which arithmetic, and which sweep it is. */
typedef struct fst_ranks_start {
    fst_status status;
    fst_arithmetic arithmetic;
    uint64_t identity; /* fst_journal_identity_hash() */
} fst_ranks_start;
fst_status fst_ranks_share_start(const fst_ranks *ranks, fst_ranks_start *start, fst_error *error);

/* ------------------------------------------------------------------ the leader's side */

typedef struct fst_leader fst_leader;
fst_status fst_leader_new(const fst_ranks *ranks, fst_leader **leader, fst_error *error);

/* Handle messages until one has brought rows (room for FST_WORKERS_ROWS), or no more have come.  Images that
 * come are added to *images; tasks that are asked for are taken from `workers`.  Returns FST_OK, or the failure
 * of a follower. */
fst_status fst_leader_attend(fst_leader *leader, fst_workers *workers, fst_sweep_record *rows, int *count,
                             fst_image **images, fst_error *error);

/* Tell the followers to stop. */
void fst_leader_stop(fst_leader *leader);

/* The number of followers still at work. */
int fst_leader_followers(const fst_leader *leader);
void fst_leader_free(fst_leader *leader);

/* ------------------------------------------------------------------ a follower's side */

/* Compute what the leader hands out until there is no more. options->progress is told now and then; its answer
 * other than FST_OK ends this.  With `failed` other than FST_OK this only tells the leader so. */
fst_status fst_follow(const fst_ranks *ranks, const fst_sweep_identity *identity,
                      const fst_sweep_options *options, const fst_workers_plan *plan, fst_status failed,
                      fst_error *error);

#endif
