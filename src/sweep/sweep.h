/* sweep.h - what the sweep's files share: tasks, and the chains along which states are carried. */
#ifndef FST_SWEEP_SWEEP_H
#define FST_SWEEP_SWEEP_H

#include "sweep/journal.h"

/* A piece of work: a point, or with carrying the first point without a row of a chain, whose rest is done in
 * the same place. */
typedef struct fst_sweep_task {
    int64_t point;
    int has_start; /* `start` is the end of the neighbour before */
    double start[FST_STATE_SIZE];
} fst_sweep_task;

/* Chains run along the first axis, in the direction of carrying: their number, the point at a place of one, and
 * the place of a point and its chain. */
int64_t fst_chain_count(const fst_sweep_identity *identity);
int64_t fst_chain_length(const fst_sweep_identity *identity);
int64_t fst_chain_point(const fst_sweep_identity *identity, int64_t chain, int64_t place);
int64_t fst_chain_place(const fst_sweep_identity *identity, int64_t point, int64_t *chain);

/* Number of tasks that the whole sweep has. */
int64_t fst_sweep_task_count(const fst_sweep_identity *identity);

/* A hash of a short fixed run: machines and builds on which it differs compute other bits. */
fst_status fst_arithmetic_fingerprint(fst_arithmetic arithmetic, int lanes, uint64_t *fingerprint,
                                      fst_error *error);

#endif
