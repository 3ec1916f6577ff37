/* quadrature.h - what one trajectory has added up: its time integrals, and the angle phi. */
#ifndef FST_OBSERVE_QUADRATURE_H
#define FST_OBSERVE_QUADRATURE_H

#include "ode/flow.h"

#include "observe/integrals.inl"

typedef struct fst_quadrature {
    fst_integrals_double sums;
    /* Of the last step, once integrals within it were asked for: the integrands at the places that the dense
     * output adds, and the dense output of the increments. */
    double between[FST_DENSE_PLACES - FST_PATH_PLACES][FST_Q_COUNT];
    double dense[8][FST_Q_COUNT];
    int has_dense;
    /* What the last step passes closely (passages.h), and whether its increments have been integrated with
     * that in view. */
    int passages, is_resolved;
    /* Of a part of the window that was not observed (left_out.h), where there is one. */
    int lacks_part;
    double left_out[FST_Q_COUNT], left_out_moment_angle;
    fst_winding moment_angle_start,
        moment_angle; /* phi = atan2(n_alpha, -n_z), unwrapped: at the step's ends */
} fst_quadrature;

/* Begin at the flow's present state. */
void fst_quadrature_begin(fst_quadrature *q, const fst_flow *flow);

/* Begin to follow phi at a state. */
void fst_quadrature_begin_moment_angle(fst_quadrature *q, const double *state);

/* Follow phi to the end of the flow's last step; where the path passes the origin of its plane closely, the
 * step must be in flow->step. */
void fst_quadrature_follow(fst_quadrature *q, fst_flow *flow, const double *end);

/* Take deviations of r and |B| from their values at the start of the flow's last or next step. */
void fst_quadrature_set_references(fst_quadrature *q, const fst_flow *flow);

/* What the flow's last step passes; and its increments with that in view, unless they are there. */
void fst_quadrature_look_for_passages(fst_quadrature *q, const fst_flow *flow);
void fst_quadrature_resolve(fst_quadrature *q, fst_flow *flow);

/* Take in the flow's last step.  `renew`: deviations are taken from its start on, and nothing before them
 * counts: the increments need no resolving unless a mark falls into the step. */
void fst_quadrature_step(fst_quadrature *q, fst_flow *flow, int renew);

/* The integrals up to the fraction x of the last step, and phi there. */
void fst_quadrature_at(fst_quadrature *q, fst_flow *flow, double x, double integrals[FST_Q_COUNT],
                       double *moment_angle);

#endif
