/* sweep.h - what the files of the sweep share: tasks, and the chains along which states are carried. */
#ifndef FST_SWEEP_SWEEP_H
#define FST_SWEEP_SWEEP_H

#include "sweep/journal.h"

/* A task: a point; or, with carrying, the first point of a chain that has no row.  The thread that does it also
 * does the rest of the chain. */
typedef struct fst_sweep_task {
    int64_t point;
    int has_start;                  /* `start` is the end state of the point before */
    double start[FST_BEAD_NUMBERS]; /* ten of them, or of a world all */
} fst_sweep_task;

/* Chains run along the first axis, in the direction of carrying.  Their length and number, the point at a place
 * of a chain, and the place of a point with its chain. */
int64_t fst_chain_count(const fst_sweep_identity *identity);
int64_t fst_chain_length(const fst_sweep_identity *identity);
int64_t fst_chain_point(const fst_sweep_identity *identity, int64_t chain, int64_t place);
int64_t fst_chain_place(const fst_sweep_identity *identity, int64_t point, int64_t *chain);

/* Whether a task, a point or a chain, is one of the sweep, or of its shard; and the number of these. */
int fst_sweep_has_task(const fst_sweep_identity *identity, int64_t task);
int64_t fst_sweep_task_count(const fst_sweep_identity *identity);

/* Points that are to have a row: all, or those of the shard; and whether a point is one of them. */
int64_t fst_sweep_point_count(const fst_sweep_identity *identity);
int fst_sweep_has_point(const fst_sweep_identity *identity, int64_t point);

/* A hash of a short fixed run: a machine or build on which it differs computes other bits. */
fst_status fst_arithmetic_fingerprint(fst_arithmetic arithmetic, int lanes, uint64_t *fingerprint,
                                      fst_error *error);

#endif
