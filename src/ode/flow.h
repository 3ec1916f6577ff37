/* flow.h - one trajectory of the bead, step by step: what fst_flow is made of (flow.inl has the scheme). */
#ifndef FST_ODE_FLOW_H
#define FST_ODE_FLOW_H

#include <stdatomic.h>
#include <string.h>

#include "base/winding.h"
#include "model/drive.h"

#include "ode/outside.h"
#define STEP_OUTSIDE
#include "ode/bead_step.inl"
#undef STEP_OUTSIDE
#include "ode/path.inl"
#include "ode/paced.inl"
#include "ode/step_control.inl"

/* Half of the contact of a bead under a law with modes: its slip, or its rotation (automaton.inl). */
typedef struct fst_part_state {
    int next;             /* the mode that begins with the next step; -1: the mode goes on */
    fst_twofold released; /* when the last motion began that was not free at once, */
    double free_at;       /* the speed at which it is, */
    double free_by;       /* and the time after which it usually is */
    double longest;       /* of a slip that creeps, the greatest size of the next step */
} fst_part_state;

typedef struct fst_contact_state {
    fst_part_state slip, roll;
    double proposal[FST_MODES][FST_ROLL_MODES]; /* size of the next step in each pair of modes */
    int followed;     /* whether neighbours of a disc are carried along (neighbours.c), which know no creep */
    int64_t captures; /* slips that came to rest before the last step */
    double dip;       /* in the last step, the least push that static friction could have taken besides */
    int64_t touches;  /* steps in which that was so little that another tolerance might have let go */
    int64_t impacts;  /* of a bead that flew, the impulses that held it up, and the energy they took */
    double impulse, impact_loss;
} fst_contact_state;

/* The error of a bead's step over its tolerance. */
double fst_bead_error(const fst_bead_step_double *s, double rtol, const double *atol);

/* The derivatives of a bead's numbers by theta, outside any step. */
static inline void fst_bead_derivative(const fst_bead_step_double *s, const double *y, double *dy)
{
    fst_pull_double unused;
    fst_bead_rhs_double(&s->context, s->omega, y, dy, &unused);
}

#define FLOW_DIM FST_STATE_SIZE
#define FLOW_NUMBERS FST_NUMBERS
#define FLOW_TAG fst_flow
#define FLOW_NAME(name) fst_bead_flow_##name
#define FLOW_STEP(name) fst_bead_##name##_double
#define FLOW_BEGIN(s) fst_begin_steps_double(s)
#define FLOW_FINISH(s) fst_finish_step_double(s)
#define FLOW_NEXT(s, omega) fst_next_step_double(s, omega)
#define FLOW_PROJECT(y) ((void)fst_renormalise_double(y))
#define FLOW_DERIVATIVE(s, y, dy) fst_bead_derivative(s, y, dy)
#define FLOW_ERROR(flow) fst_bead_error(&(flow)->step, (flow)->rtol, (flow)->atol)
/* What a bead's flow has besides: where the caller of fst_flow_next() is, how far into the last step (0 to
 * 1), the time there (where that was asked for), the sign of X there (0 before the first step), and the bounds
 * that were reported and from which the bead has not come back (FST_AT_*); what began at step.end and is not
 * reported yet (FST_AT_*); the caller's progress; whether fst_flow_next() is at work; Phi at step.y and at
 * step.end; and the contact, under a law with modes. */
#define FLOW_MEMBERS                                                                                           \
    fst_groups groups;                                                                                         \
    fst_winding bead_angle_start, bead_angle;                                                                  \
    double cursor;                                                                                             \
    fst_twofold cursor_time;                                                                                   \
    const fst_progress *progress;                                                                              \
    atomic_int at_work;                                                                                        \
    int section_side;                                                                                          \
    unsigned beyond, begun;                                                                                    \
    fst_contact_state contact;

#include "ode/flow.inl"

/* What never changes along the way, and the modes of the motion. */
static inline const fst_world_double *fst_flow_world(const fst_flow *flow)
{
    return FST_WORLD(&flow->step);
}

static inline const fst_modes_double *fst_flow_modes(const fst_flow *flow)
{
    return FST_MODES(&flow->step);
}

/* Make one accepted step towards t_limit, forward or backward in time, landing on it exactly where it is in
 * reach. FST_STEP_UNDERFLOW, FST_NOT_FINITE: the flow stays at the end of its last good step. */
fst_status fst_flow_step(fst_flow *flow, double t_limit, fst_error *error);

/* The end of the last step becomes a start, at which the first stage is evaluated anew. */
void fst_flow_restart(fst_flow *flow);

/* Follow Phi to the end of the last step, which was made in lanes; where it passes the axis closely, the step
 * must be in flow->step. */
void fst_flow_follow(fst_flow *flow, const double *end);

/* The failure after a step was given up; flow->step.y is where the bead was. */
fst_status fst_flow_fail(const fst_flow *flow, fst_error *error);

/* Form the dense output of the last step (three more evaluations), unless that is done. */
void fst_flow_make_dense(fst_flow *flow);

/* The state at the fraction x of the last step, n renormalised; makes the dense output. */
void fst_flow_at(fst_flow *flow, double x, double state[FST_STATE_SIZE]);

/* The whole motion there. */
void fst_flow_motion_at(fst_flow *flow, double x, fst_motion_double *motion);

/* Components `first` to `first` + count - 1 of it, as the dense output has them. */
void fst_flow_components_at(fst_flow *flow, double x, int first, int count, double *out);

/* Phi at the fraction x of the last step. */
fst_winding fst_flow_bead_angle(fst_flow *flow, double x);

/* Greatest component of |d(state)/dt| at the end of the last step. */
double fst_flow_speed(const fst_flow *flow);

/* d(state)/dt at the end of the last step. */
void fst_flow_slope(const fst_flow *flow, double slope[FST_STATE_SIZE]);

/* The fraction of the last step at which the time t lies, and the time at a fraction. */
double fst_flow_fraction(fst_flow *flow, fst_twofold t);
fst_twofold fst_flow_time(fst_flow *flow, double x);

/* The drive at a place of the last step: on a ramp it changes within the step. */
double fst_flow_drive_at_place(const fst_flow *flow, int place);

/* Dry friction (contact.c): the mode in which a bead begins that is put down in a state, whose slip it may not
 * have; and one step. */
void fst_contact_put_down(fst_flow *flow, double *state);
fst_status fst_contact_step(fst_flow *flow, double t_limit, fst_error *error);

/* The parts of such a step before and after the tries that are made until one is good, for lanes, which make
 * these.  Before: the mode that is to follow begins, and the flow stands at step.y with the first stage there.
 * After: the step is made anew up to an event or the end of the way, if it holds one, and passes. */
void fst_contact_begin_step(fst_flow *flow);
void fst_contact_end_step(fst_flow *flow, double t_limit);

/* Where a good step that has not passed yet must end, a fraction of it, and which mode follows; 1: that is the
 * end of the way, and the mode is not looked for. */
int fst_contact_look_ahead(fst_flow *flow, double t_limit, double *end);

/* Whether the modes of the last step are over; begin the ones that follow, if so. */
static inline int fst_contact_changes(const fst_flow *flow)
{
    return flow->contact.slip.next >= 0 || flow->contact.roll.next >= 0;
}
void fst_contact_begin_next(fst_flow *flow);

/* Steps under a law with modes (pace.c): the modes of the last step; the time that it took; the fraction at a
 * time since its start, and the other way round. */
static inline int fst_contact_mode(const fst_flow *flow)
{
    return (int)fst_flow_modes(flow)->contact;
}

/* Whether a contact slips, fast or creeping. */
static inline int fst_contact_slips(const fst_flow *flow)
{
    const int mode = fst_contact_mode(flow);
    return mode == FST_MODE_SLIP || mode == FST_MODE_CREEP;
}

static inline int fst_contact_roll(const fst_flow *flow)
{
    return (int)fst_flow_modes(flow)->rolling;
}

double fst_contact_elapsed(const fst_flow *flow);
double fst_contact_fraction(fst_flow *flow, double since_start);
double fst_contact_time(fst_flow *flow, double x);

/* Let the drive change at this rate from now on; the flow must be at the end of a step. */
void fst_flow_begin_ramp(fst_flow *flow, double rate);

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

/* The functions of the events: X; the radial velocity times r, zero where r is extreme; plate radius minus r;
 * the normal load.  And the radius of the map of the field minus r, for what knows no plate. */
double fst_section_function(const fst_flow *flow, const double *state, const fst_pull_double *p);
double fst_radial_function(const fst_flow *flow, const double *state, const fst_pull_double *p);
double fst_edge_function(const fst_flow *flow, const double *state, const fst_pull_double *p);
double fst_map_function(const fst_flow *flow, const double *state, const fst_pull_double *p);
double fst_load_function(const fst_flow *flow, const double *state, const fst_pull_double *p);

/* Whether an event function became negative in the part [lo, 1] of the last step, even if only between its
 * ends, and at which fraction first: *x. */
int fst_flow_first_negative(fst_flow *flow, fst_state_function function, double lo, double *x);

/* The same in the whole step, quicker where the function only rises or only falls. */
int fst_flow_becomes_negative(fst_flow *flow, fst_state_function function, double *x);

/* Least and greatest value of a function at the stages of the last step that lie on the trajectory. */
void fst_flow_path_range(const fst_flow *flow, fst_state_function function, double *least, double *greatest);

#endif
