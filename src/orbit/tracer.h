/* tracer.h - following one branch after another, with those that are born on the way. */
#ifndef FST_ORBIT_TRACER_H
#define FST_ORBIT_TRACER_H

#include "orbit/curve.h"

enum { FST_PENDING = 64 };

/* A branch still to be followed. */
typedef struct fst_pending {
    fst_node start;
    int branch, family; /* its number, and that of the branch on which it was born (-1) */
    int depth;          /* how many births away from the first */
    int one_way;        /* it was born at a special point: only away from that */
} fst_pending;

typedef struct fst_tracer {
    fst_family family;
    const fst_branch_options *options;
    fst_branch *out;
    fst_pending pending[FST_PENDING];
    int pending_count, branch_count;
    int branch, depth; /* of the curve being followed */
    int follow_hopf;   /* follow orbits born from equilibria */
    int other;         /* branch at whose Hopf point that curve ended too; -1: none */
    double last_value;
    fst_watch watch;              /* its present part: the branches that are pending */
    int done;                     /* of the pending ones */
    int nodes;                    /* on the present one */
    char what[96];                /* for the watch: which of the branches, and where on it */
    fst_node starts[FST_PENDING]; /* special points from which curves over two parameters begin */
    int start_count;
} fst_tracer;

/* Put a branch that passes through `start` on the list. */
fst_status fst_tracer_add(fst_tracer *t, const fst_node *start, fst_error *error);

/* Follow every pending branch, and those that are born on the way. */
fst_status fst_tracer_run(fst_tracer *t, fst_error *error);

/* Find counter-rotating orbits in the range, and follow the branches on which they lie (counter.c). */
fst_status fst_follow_counter(fst_tracer *t, fst_error *error);

/* Find equilibria at several values in the range, and follow each unless a branch passes through it already
 * (locked.c). */
fst_status fst_follow_locked(fst_tracer *t, fst_error *error);

#endif
