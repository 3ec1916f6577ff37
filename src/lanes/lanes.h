/* lanes.h - steps of several trajectories at once, behind plain doubles.
 *
 * An engine is one body of steps (lanes.inl) compiled for one width and form of arithmetic.  A batch is its
 * memory: value i of lane l of an array lies at [i * width + l].  Each lane has its own parameters, state and
 * step size; what the lanes share are the integers of the model (number of lines, material, dynamics).
 */
#ifndef FST_LANES_LANES_H
#define FST_LANES_LANES_H

#include "lanes/tangents.h"
#include "observe/quadrature.h"
#include "ode/flow.h"

enum { FST_MOST_LANES = 8 };

/* The arrays of a batch that are read and written from outside. */
typedef struct fst_lane_view {
    const double *y, *end;         /* states at the step's start and end */
    double *turns[2];              /* whole turns of Phi and of phi at the end (base/winding.h) */
    const double *turns_before[2]; /* and at the start */
    double *activity;              /* greatest |component of d(state)/dt| since it was last set */
    const double *speed;           /* the same at the end of the step */
    double *next_mark;             /* time of the next mark */
    double *bead_angle_least,
        *bead_angle_most; /* unit vectors: the directions between which Phi has stayed; 0: not known */
    double *r_reference, *b_reference; /* from where deviations are taken */
    double *records; /* greatest values so far of tracked quantities times their signs, FST_RECORD_COUNT */
} fst_lane_view;

/* Lanes, one bit each: what is to be done after an accepted step. */
typedef struct fst_lane_events {
    unsigned ending;    /* the bead may have left the plate or lifted off; no such lane is left out */
    unsigned at_mark;   /* the time of the next mark is reached */
    unsigned close;     /* worth a close look: it may be ending, it has reached its limit of time, X has changed
                           its sign in the window, or an angle is doubtful */
    unsigned wandering; /* Phi may have left its bounds */
    unsigned at_maximum; /* r may have passed a maximum */
} fst_lane_events;

/* Lanes, one bit each. */
typedef struct fst_lane_tries {
    unsigned accepted; /* the step's error is within the tolerance: time has gone on */
    unsigned landed;   /* of these, those at their limit of time */
    unsigned failed;   /* the step was given up */
    /* Dry contacts: */
    unsigned contact; /* the step is good, but not accepted yet: its mode or the way may end in it */
    unsigned anew;    /* of those accepted, the steps that were made anew */
} fst_lane_tries;

typedef struct fst_lane_engine {
    const char *name;
    int width;
    int fused;    /* the fast form: its bits are its own */
    size_t bytes; /* of a batch, to be aligned to 64 and zeroed */
    void (*view)(void *batch, fst_lane_view *view);

    /* Put a trajectory that has its first stage into a lane, to go on to t_limit; and take it out. */
    void (*load)(void *batch, int lane, const fst_flow *flow, double t_limit);
    void (*release)(void *batch, int lane);

    /* Dry contacts: accept the last step of the lanes `contact` after all; make the one of a lane anew as its
     * next try, with another size and whatever its error; let a lane go on with the trajectory of its flow in
     * another mode, where everything else that it knows stays. */
    void (*pass)(void *batch, unsigned lanes);
    void (*make_anew)(void *batch, int lane, double size);
    void (*reload)(void *batch, int lane, const fst_flow *flow, double t_limit);

    /* Dry contacts: carry an infinitesimal neighbour of the trajectory of each of these lanes along its last step,
     * before advance().  `differences` has FST_STEP_TIME + 1 numbers of each lane (ode/neighbours.h). */
    void (*carry)(const void *batch, unsigned lanes, double *differences);

    /* All that a lane knows between two steps, as `numbers` doubles.  restore() follows load() of the same
     * trajectory, which then goes on with the same bits as if it had never left. */
    int numbers;
    void (*save)(const void *batch, int lane, double *numbers);
    void (*restore)(void *batch, int lane, const double *numbers);

    /* Try a step in every lane that is in use, and accept or reject it (ode/step_control.inl). */
    fst_lane_tries (*try_steps)(void *batch);

    /* What the last step of the lanes `accepted` may hold; phi is followed in the lanes `observed`. */
    fst_lane_events (*watch)(void *batch, unsigned accepted, unsigned observed, unsigned in_window);

    /* Add the last step of the lanes `accepted` to their integrals; lanes that are not in their window yet
     * renew their references.  beaten[]: the lanes among `tracked` in which a record may be beaten.  In the
     * fast form the records of these lanes follow the ends of steps by themselves; in the portable form the
     * caller sets them. */
    void (*observe)(void *batch, unsigned accepted, unsigned in_window, unsigned tracked,
                    unsigned beaten[FST_RECORD_COUNT]);

    /* Make the end of the last step the start of the next, and plan its size. */
    void (*advance)(void *batch, unsigned accepted);

    /* The last step of a lane as the scalar step, with the derivatives that the dense output needs; and the
     * states and pulls at the places of its path. */
    void (*extract)(const void *batch, int lane, fst_bead_step_double *step);
    void (*extract_path)(const void *batch, int lane, fst_bead_step_double *step);

    /* The integrals of a lane up to the last observed step and over it, as those of one run. */
    void (*extract_integrals)(const void *batch, int lane, fst_integrals_double *to);

    /* Put other integrals over the last observed step in the place of a lane's own. */
    void (*set_increments)(void *batch, int lane, const double increments[FST_Q_COUNT]);

    /* The fast form locates extremes in lanes too: a step that may hold one waits in a place of its own, and
     * when all places are taken, sign times the extreme of each is found. */
    size_t waiting_bytes;
    void (*set_aside)(const void *batch, int lane, int record, void *waiting, int place);
    void (*locate)(void *waiting, double *values);

    /* The time, size and counts of a lane, as its flow has them; the drive does not change in lanes. */
    void (*extract_clock)(const void *batch, int lane, fst_flow *flow);

    /* Of the same width and form; the engines of dry contacts have none. */
    fst_tangent_engine tangents;
} fst_lane_engine;

/* The engine of a form of arithmetic and a width (0: the widest of that form), or NULL where this processor or
 * this build has none. */
const fst_lane_engine *fst_lane_engine_of(fst_arithmetic arithmetic, int lanes);

/* The one for dry contacts, of the width and form of another. */
const fst_lane_engine *fst_dry_lane_engine_of(const fst_lane_engine *engine);

#endif
