/* flow.h - one trajectory of the bead, step by step: what fst_flow is made of. */
#ifndef FST_ODE_FLOW_H
#define FST_ODE_FLOW_H

#include "base/compensated.h"
#include "base/winding.h"
#include "model/model.h"

#include "ode/bead_step.inl"

struct fst_flow {
    fst_bead_step_double step; /* the last accepted step, from step.y to step.end */
    fst_groups groups;
    double rtol, atol[FST_STATE_SIZE], greatest_step;
    double omega_start;          /* drive at ramp_start, from where it changes at the rate step.ramp */
    fst_twofold ramp_start;      /* when that began */
    fst_twofold phase_start;     /* angle of the drive there */
    fst_twofold t_start, t;      /* times of step.y and step.end */
    double h_next;               /* proposal for the next step, positive */
    int has_step;                /* a step was made: step.end is the state, else step.y */
    int has_dense;               /* step.dense belongs to the last step */
    fst_winding phi_start, phi;  /* Phi at step.y and at step.end */
    double cursor;               /* fst_flow_advance: how far into the last step its caller has got, 0 to 1 */
    fst_twofold cursor_time;     /* the time there, where that was asked for */
    int section_side;            /* sign of X where the caller is, 0 before the first step */
    unsigned beyond;             /* bounds (1 << FST_STOP_*) that were reported and not come back from */
    double attempt, worst_error; /* size of the present try; error of the last one that failed */
    int attempt_lands, rejections;
    double norm_drift;
    uint64_t rhs_calls, accepted, rejected;
};

/* Make one accepted step towards t_limit, forward or backward in time, landing on it exactly where it is in
 * reach. FST_STEP_UNDERFLOW, FST_NOT_FINITE: the flow stays at the end of its last good step. */
fst_status fst_flow_step(fst_flow *flow, double t_limit, fst_error *error);

/* The end of the last step becomes a start, at which the first stage is evaluated anew. */
void fst_flow_restart(fst_flow *flow);

/* The parts of a step, for whoever makes the tries elsewhere (in lanes).  Choose the size of the first try
 * towards t_limit: flow->attempt. */
void fst_flow_plan(fst_flow *flow, double t_limit);

/* A try failed: choose the next size by step_factor() of its error.  0: the steps have become too small. */
int fst_flow_reject(fst_flow *flow, double error, double factor);

/* A try was accepted: time, counters, the next size.  Phi is left to fst_flow_follow(). */
void fst_flow_accept(fst_flow *flow, double error, double factor, double drift, double t_limit);

/* Follow Phi to the end of the accepted step; where it passes the axis closely, the step must be in flow->step.
 */
void fst_flow_follow(fst_flow *flow, const double *end);

/* The failure after fst_flow_reject() gave up; flow->step.y is where the bead was. */
fst_status fst_flow_fail(const fst_flow *flow, fst_error *error);

/* Form the dense output of the last step (three more evaluations), unless it is there. */
void fst_flow_make_dense(fst_flow *flow);

/* The state at the fraction x of the last step, n renormalised; makes the dense output. */
void fst_flow_at(fst_flow *flow, double x, double state[FST_STATE_SIZE]);

/* Phi at the fraction x of the last step. */
fst_winding fst_flow_phi(fst_flow *flow, double x);

/* Greatest component of |d(state)/dt| at the end of the last step. */
double fst_flow_speed(const fst_flow *flow);

/* d(state)/dt at the end of the last step. */
const double *fst_flow_slope(const fst_flow *flow);

/* The fraction of the last step at which the time t lies, and the time at a fraction. */
double fst_flow_fraction(const fst_flow *flow, fst_twofold t);
fst_twofold fst_flow_time(const fst_flow *flow, double x);

/* Let the drive change at this rate from now on; the flow must be at the end of a step. */
void fst_flow_begin_ramp(fst_flow *flow, double rate);

/* Drive at a time (on the ramp: not before its start). */
double fst_flow_omega(const fst_flow *flow, fst_twofold t);

/* Turns of the magnet since t = 0: whole turns, and the rest in [0, 1). */
void fst_flow_drive_turns(const fst_flow *flow, fst_twofold t, double *whole, double *rest);

/* A scalar function of the state along a trajectory, for events and extremes. */
typedef double (*fst_state_function)(const fst_flow *flow, const double *state, const fst_pull_double *p);

/* A state function at the fraction x of the last step. */
double fst_flow_function_at(fst_flow *flow, double x, fst_state_function function);

/* The zero of a function between the fractions lo and hi of the last step, where it has the values f_lo and
 * f_hi of opposite signs; located to rounding by bisection and secants on the dense output. */
double fst_flow_locate(fst_flow *flow, fst_state_function function, double lo, double hi, double f_lo,
                       double f_hi);

/* A function of the fraction x of the last step; `what` is its caller's. */
typedef double (*fst_step_function)(fst_flow *flow, double x, const void *what);

/* The place in [lo, hi] where sign * function is greatest, by golden sections and a parabola; *value is the
 * function there. */
double fst_flow_extreme(fst_flow *flow, fst_step_function function, const void *what, double sign, double lo,
                        double hi, double *value);

/* The functions of the events: X; plate radius minus r; the normal load. */
double fst_section_function(const fst_flow *flow, const double *state, const fst_pull_double *p);
double fst_edge_function(const fst_flow *flow, const double *state, const fst_pull_double *p);
double fst_load_function(const fst_flow *flow, const double *state, const fst_pull_double *p);

/* Whether an event function became negative in the part [lo, 1] of the last step, even if only between its
 * ends, and at which fraction first: *x. */
int fst_flow_first_negative(fst_flow *flow, fst_state_function function, double lo, double *x);

/* Least and greatest value of a function at the stages of the last step that lie on the trajectory. */
void fst_flow_stage_range(const fst_flow *flow, fst_state_function function, double *least, double *greatest);

#endif
