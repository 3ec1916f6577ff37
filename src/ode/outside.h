/* outside.h - what a caller adds to the motion of one flow: a field, a force, a torque (outside.c has how). */
#ifndef FST_ODE_OUTSIDE_H
#define FST_ODE_OUTSIDE_H

#include "model/drive.h"

typedef struct fst_outside_state {
    fst_outside given;
    fst_twofold t; /* at the start of the step, */
    fst_drive_double drive;
    fst_status status;    /* of the call that failed, */
    fst_error error;      /* and its error */
    double not_finite_at; /* the time at which something was not finite in this step; NAN: it all was finite */
    int must_restart;     /* the first stage was spoilt: evaluate it anew */
} fst_outside_state;

struct fst_bead_double;

/* The magnet's pull and what is added, at the numbers y of a motion. */
void fst_outside_pull(const struct fst_bead_double *bead, const double *y, fst_pull_double *p,
                      double torque[3]);

/* The derivatives of these numbers; the pull is left in `p`. */
void fst_outside_rhs(const struct fst_bead_double *bead, double drive, const double *y, double *k,
                     fst_pull_double *p);

/* The flow gets what `given` says, before its first step; fst_flow_free() frees it.  The status that the first
 * calls had. */
fst_status fst_outside_begin(fst_flow *flow, const fst_outside *given, fst_error *error);
fst_status fst_outside_begun(const fst_flow *flow, fst_error *error);

/* Before a step; and why a step was given up: FST_OK where the reason is not from outside. */
void fst_outside_before_step(fst_flow *flow);
fst_status fst_outside_fail(const fst_flow *flow, fst_error *error);

#endif
