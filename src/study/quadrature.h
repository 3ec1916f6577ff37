/* quadrature.h - time integrals and extremes along a trajectory, with the integrator's own stages. */
#ifndef FST_STUDY_QUADRATURE_H
#define FST_STUDY_QUADRATURE_H

#include "ode/flow.h"

typedef struct fst_extreme {
    double least, greatest;
} fst_extreme;

typedef struct fst_quadrature {
    fst_twofold total[FST_Q_COUNT];  /* integrals up to the start of the last step */
    double increment[FST_Q_COUNT];   /* and over it */
    double r_reference, b_reference; /* r and |B| when the window began: deviations are taken from them */
    double integrands[FST_DENSE_POINTS][FST_Q_COUNT]; /* at the points of the path (ode/path.h) */
    double dense[8][FST_Q_COUNT];
    int has_dense;
    double tracked[FST_PATH_POINTS][FST_TRACK_COUNT];
    fst_extreme extreme[FST_TRACK_COUNT];
    fst_winding small_phi_start, small_phi; /* phi = atan2(n_alpha, -n_z), unwrapped */
} fst_quadrature;

/* Begin at the flow's present state. */
void fst_quadrature_begin(fst_quadrature *q, const fst_flow *flow);

/* Take deviations of r and |B| from their values at the start of the flow's last step, before it is taken in.
 */
void fst_quadrature_set_references(fst_quadrature *q, const fst_flow *flow);

/* Follow phi to the end of the flow's last step; where the path passes the origin of its plane closely (then it
 * is doubtful), the step must be in flow->step. */
int fst_quadrature_phi_is_doubtful(const fst_quadrature *q, const double *end);
void fst_quadrature_follow(fst_quadrature *q, fst_flow *flow, const double *end);

/* Begin to follow phi at a state. */
void fst_quadrature_begin_phi(fst_quadrature *q, const double *state);

/* Take in the flow's last step. */
void fst_quadrature_step(fst_quadrature *q, fst_flow *flow);

/* The extremes met in the last step, from its fraction `from` on. */
void fst_quadrature_track(fst_quadrature *q, fst_flow *flow, double from);

/* The integrals up to the fraction x of the last step, and phi there. */
void fst_quadrature_at(fst_quadrature *q, fst_flow *flow, double x, double integrals[FST_Q_COUNT], double *phi);

#endif
