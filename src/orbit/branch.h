/* branch.h - following one branch after another, and collecting what they tell. */
#ifndef FST_ORBIT_BRANCH_H
#define FST_ORBIT_BRANCH_H

#include "orbit/curve.h"
#include "orbit/surface.h"

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
    double last_value;
    fst_watch watch;                       /* its present part: the branches that are pending */
    int done;                              /* of the pending ones */
    int nodes;                             /* on the present one */
    fst_special_start starts[FST_PENDING]; /* of curves over two parameters */
    int start_count;
} fst_tracer;

/* Put a branch that passes through `start` on the list. */
fst_status fst_tracer_add(fst_tracer *t, const fst_node *start, fst_error *error);

/* Tell the caller how far the work is; the answer. */
fst_status fst_tracer_progress(fst_tracer *t, fst_error *error);

/* Follow every pending branch, and those that are born on the way. */
fst_status fst_tracer_run(fst_tracer *t, fst_error *error);

/* Whether a state lies on a branch that was followed. */
int fst_tracer_knows(const fst_tracer *t, const fst_branch_point *seen);

/* Points and ends of a branch; its points from index `first` on in the opposite order. */
fst_status fst_branch_add_point(fst_branch *out, const fst_branch_point *seen, int branch, fst_error *error);
fst_status fst_branch_add_end(fst_branch *out, int branch, int family, double value, const char *reason,
                              fst_error *error);
void fst_branch_reverse(fst_branch *out, size_t first);

/* The scale of a parameter for the length of arcs. */
double fst_branch_scale(const char *key, double from, double to);

/* Every family of equilibria, locked.c. */
fst_status fst_follow_locked(fst_tracer *t, fst_error *error);

#endif
