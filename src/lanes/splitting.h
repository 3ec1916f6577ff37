/* splitting.h - runs of dry beads by the splitting method (ode/splitting.inl), side by side, behind plain
 * doubles.
 *
 * As with fst_lane_engine, an engine is one body (splitting_lanes.inl) compiled for one width and form of
 * arithmetic; a width of 1 is the scalar form.  Every lane has its own parameters, step and length.  A lane
 * depends on nothing in the others.
 */
#ifndef FST_LANES_SPLITTING_H
#define FST_LANES_SPLITTING_H

#include "model/model.h"
#include "observe/weighted.h"
#include "ode/splitting.h"

typedef struct fst_splitting_job {
    const fst_coefficients_double *coefficients;
    double start[FST_STATE_SIZE];
    double h, steps;     /* step and how many of them */
    double discard;      /* steps before the means */
    double plate_radius; /* beyond it the bead is ejected */
    /* made of these by fst_splitting_prepare(): */
    fst_stride_double half, whole; /* half a step, a step */
    double first[FST_STATE_SIZE];  /* the state at the first kick */
} fst_splitting_job;

/* Make the rest of a job.  The engines' own files do no arithmetic on single doubles: for some instruction sets
 * gcc fuses products and sums there (a pattern of additions and subtractions in turn) though it is told not to.
 */
void fst_splitting_prepare(fst_splitting_job *job);

typedef enum {
    FST_SPLITTING_ON_ITS_WAY,
    FST_SPLITTING_DONE,
    FST_SPLITTING_EJECTED,
    FST_SPLITTING_LIFTED
} fst_splitting_end;

/* What a lane knows: sums and extremes as in FN(weighted), over double. */
typedef struct fst_splitting_sums {
    double weight, half_weight[2];
    double sum[FST_MEAN_COUNT], half_sum[2][FST_HALVED_COUNT];
    double r_reference, b_reference;
    double least[FST_SPAN_COUNT], most[FST_SPAN_COUNT];
    double fastest[2];
    double captures;
    double x_before;
    double turned, turned_least, turned_most;
    double rising, falling;
} fst_splitting_sums;

typedef struct fst_splitting_outcome {
    fst_splitting_end end;
    double step;                  /* steps made; one that ends the run counts as half */
    double state[FST_STATE_SIZE]; /* at the end */
    fst_splitting_sums sums;
} fst_splitting_outcome;

typedef struct fst_splitting_engine {
    int width;
    size_t bytes; /* to be aligned to 64 and zeroed */

    /* Put a run that is prepared into a lane. */
    void (*load)(void *memory, int lane, const fst_splitting_job *job);

    /* At most `count` steps in every lane.  The lanes whose runs are over, one bit each; they stand still.  All
     * lanes must have been loaded once. */
    unsigned (*go_on)(void *memory, int count);

    /* What has become of a lane's run; the state is that at the next kick. */
    void (*outcome)(const void *memory, int lane, fst_splitting_outcome *outcome);
} fst_splitting_engine;

/* The same, with the state at the end. */
void fst_splitting_outcome_of(const fst_splitting_engine *engine, const void *memory, int lane,
                              const fst_splitting_job *job, fst_splitting_outcome *outcome);

extern const fst_splitting_engine fst_splitting_scalar;

#endif
