/* lanes.h - steps of several trajectories at once, behind plain doubles.
 *
 * An engine is one body of steps (lanes.inl) compiled for one width and form of arithmetic.  A batch is its
 * memory: value i of lane l of an array lies at [i * width + l].  Each lane has its own parameters, state and
 * step size; what the lanes share are the integers of the model (number of lines, material, dynamics).
 */
#ifndef FST_ENSEMBLE_LANES_H
#define FST_ENSEMBLE_LANES_H

#include "ode/flow.h"

enum { FST_MOST_LANES = 8 };

/* The arrays of a batch that are read and written from outside. */
typedef struct fst_lane_view {
    double *h;                      /* size of the next try */
    const double *y, *end;          /* states at its start and end */
    const double *error, *factor;   /* step_error and step_factor of the last try */
    const double *drift;            /* | |n| - 1 | at its end before n is renormalised */
    const double *activity;         /* greatest component of |d(state)/dt| at its end */
    double *total_high, *total_low; /* integrals up to the start of the last observed step, FST_Q_COUNT */
    double *increment;              /* and over it */
    double *r_reference, *b_reference;
    double *integrands, *tracked; /* at the path's stages: FST_PATH_STAGES times FST_Q_COUNT, FST_TRACK_COUNT */
    double *greatest, *least;     /* records of the tracked quantities, FST_TRACK_COUNT */
} fst_lane_view;

typedef struct fst_lane_engine {
    const char *name;
    int width;
    int fused;    /* the fast form: its bits are its own */
    size_t bytes; /* of a batch, to be aligned to 64 */
    void (*view)(void *batch, fst_lane_view *view);

    /* Put a trajectory that has its first stage into a lane; an idle lane holds any trajectory, with h = 0. */
    void (*load)(void *batch, int lane, const fst_flow *flow);

    /* Try a step of size h in every lane; the lanes (bits) whose error is within the tolerance. */
    unsigned (*try_steps)(void *batch);

    /* The lanes in whose last step the bead may have left the plate, sideways or upwards: all that have, and a
     * few more. */
    unsigned (*may_end)(const void *batch);

    /* Take the last step of the lanes `accepted` into their integrals; references are renewed in lanes that are
     * not in their window yet.  Returns the lanes in which a record of a tracked quantity may be beaten. */
    unsigned (*observe)(void *batch, unsigned accepted, unsigned in_window);

    /* Make the end of the last step the start of the next. */
    void (*advance)(void *batch, unsigned accepted);

    /* The last step of a lane as the scalar step, stages, derivatives and fields included. */
    void (*extract)(const void *batch, int lane, fst_bead_step_double *step);
} fst_lane_engine;

/* The engine of a form of arithmetic and a width (0: the widest of that form), or NULL where this processor or
 * this build has none. */
const fst_lane_engine *fst_lane_engine_of(fst_arithmetic arithmetic, int lanes);

#endif
