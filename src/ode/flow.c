/* flow.c - one trajectory of the bead.
 *
 * The steps themselves are the body's (flow.inl).  This file adds what is a bead's own:
 *
 * The drive.  The magnet turns at omega, or from ramp_start on at omega_start + ramp (t - ramp_start).  Its
 * angle is the integral of that, kept to twice the digits of a double, because laboratory positions after a
 * million turns need the fraction of a turn.
 *
 * Phi, the bead's direction in the turning frame, counted past full turns.  It is never summed up: it is the
 * angle of the last position plus 2 pi times a whole number, which changes where the path crosses the half-axis
 * Y = 0, X < 0.  A straight line from one step's end to the next decides that, unless it passes close to the
 * axis, where the curved path may pass on the other side:
 *
 *               end o---___
 *                  (       ---o start      the straight line passes above the axis
 *                   (  + axis  )
 *                     (______)             the path passes below it
 *
 * There the path is halved by the dense output, and halved again, until no piece is doubtful.
 *
 * Failures in words: where the bead was when its steps became too small or a number was not finite.
 */
#include "ode/flight.h"

#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"

double fst_flow_omega(const fst_flow *flow, fst_twofold t)
{
    return fst_bead_flow_omega(flow, t);
}

/* Angle of the drive since t = 0: what it was when the ramp began, and omega t + ramp t^2/2 since. */
static fst_twofold drive_phase(const fst_flow *flow, fst_twofold t)
{
    const fst_twofold before = flow->ramp_start;
    const double on_ramp = fst_twofold_difference(t, before);
    const fst_twofold since = fst_twofold_add(fst_twofold_add(t, -before.high), -before.low);
    fst_twofold phase = fst_twofold_times(since, flow->omega_start);
    if (on_ramp > 0)
        phase = fst_twofold_add(phase, 0.5 * flow->step.ramp * (on_ramp * on_ramp));
    return fst_twofold_add(fst_twofold_add(phase, flow->phase_start.high), flow->phase_start.low);
}

void fst_flow_begin_ramp(fst_flow *flow, double rate)
{
    const double omega = fst_flow_omega(flow, flow->t);
    flow->phase_start = drive_phase(flow, flow->t);
    flow->omega_start = omega;
    flow->ramp_start = flow->t;
    flow->step.ramp = rate;
}

/* Follow the angle over the fractions [x0, x1] of the last step; `state` is the one at x1.  Where the straight
 * line passes the axis closely the path is bisected until it does not, or until the pieces are at rounding. */
static void follow_bead_angle(fst_flow *flow, fst_winding *angle, double x0, double x1, const double *state)
{
    const double middle = 0.5 * (x0 + x1);
    if (x1 - x0 > 1e-13 && fst_winding_is_doubtful(angle, state[FST_X], state[FST_Y])) {
        double between[FST_STATE_SIZE];
        fst_flow_at(flow, middle, between);
        follow_bead_angle(flow, angle, x0, middle, between);
        follow_bead_angle(flow, angle, middle, x1, state);
        return;
    }
    fst_winding_advance(angle, state[FST_X], state[FST_Y]);
}

fst_winding fst_flow_bead_angle(fst_flow *flow, double x)
{
    if (x == 1.0)
        return flow->bead_angle;
    fst_winding angle = flow->bead_angle_start;
    double state[FST_STATE_SIZE];
    fst_flow_at(flow, x, state);
    follow_bead_angle(flow, &angle, 0.0, x, state);
    return angle;
}

void fst_flow_follow(fst_flow *flow, const double *end)
{
    follow_bead_angle(flow, &flow->bead_angle, 0.0, 1.0, end);
}

fst_status fst_flow_fail(const fst_flow *flow, fst_error *error)
{
    const fst_bead_step_double *s = &flow->step;
    const double r = sqrt(s->y[FST_X] * s->y[FST_X] + s->y[FST_Y] * s->y[FST_Y]);
    char where[96];
    (void)snprintf(where, sizeof where, "t = %.10g (%.6g drive periods), r = %.6g", flow->t.high,
                   flow->t.high * s->omega / FST_TWO_PI, r);
    if (flow->control.worst_error == INFINITY)
        return fst_fail(
            error, FST_NOT_FINITE, where,
            "the motion stopped being finite at %s; try a smaller run.rtol, and check kappa, h and the "
            "start for extreme values",
            where);
    return fst_fail(
        error, FST_STEP_UNDERFLOW, where,
        "the step size underflowed at %s (error %.3g times the tolerance at step %.3g); try a larger "
        "run.rtol",
        where, flow->control.worst_error, flow->control.size);
}

void fst_flow_make_dense(fst_flow *flow)
{
    fst_bead_flow_form_dense(flow);
}

void fst_flow_at(fst_flow *flow, double x, double state[FST_STATE_SIZE])
{
    fst_bead_flow_state_at(flow, x, state);
    if (fst_flight_is_on(flow)) { /* what is looked at next is the field there */
        double height, climb;
        fst_flight_at(flow, x, &height, &climb);
        fst_raise_source_double(&flow->step.context, height);
    }
}

void fst_flow_slope(const fst_flow *flow, double slope[FST_STATE_SIZE])
{
    memcpy(slope, FST_PATH_SLOPE(&flow->step, FST_PATH_END), FST_STATE_SIZE * sizeof *slope);
    if (flow->step.context.coefficients.kinds.paced) { /* the step's own are not by time */
        fst_pull_double unused;
        fst_rhs_double(&flow->step.context.coefficients, fst_flow_omega(flow, flow->t), flow->step.end, slope,
                       &unused);
    }
}

double fst_flow_speed(const fst_flow *flow)
{
    return fst_step_speed_double(&flow->step);
}

double fst_flow_fraction(fst_flow *flow, fst_twofold t)
{
    const double since_start = fst_twofold_difference(t, flow->t_start);
    if (flow->step.context.coefficients.kinds.paced) /* a step that landed did so just there */
        return fst_twofold_difference(t, flow->t) == 0.0 ? 1.0 : fst_contact_fraction(flow, since_start);
    return since_start / flow->step.h;
}

fst_twofold fst_flow_time(fst_flow *flow, double x)
{
    if (flow->step.context.coefficients.kinds.paced && x != 1.0)
        return fst_twofold_add(flow->t_start, fst_contact_time(flow, x));
    return fst_bead_flow_time_at(flow, x);
}

double fst_flow_drive_at_place(const fst_flow *flow, int place)
{
    const fst_bead_step_double *s = &flow->step;
    const double by_node = s->omega + (s->h * FST_PATH_NODE[place]) * s->ramp;
    return fst_stage_drive_double(&s->context, s->h, s->omega, s->ramp, by_node, FST_PATH_STAGE_[place]);
}

void fst_flow_drive_turns(const fst_flow *flow, fst_twofold t, double *whole, double *rest)
{
    /* (omega t + ramp t_ramp^2/2)/(2 pi), with 1/(2 pi) as the sum of two doubles. */
    static const double inverse_high = 0.15915494309189535, inverse_low = -9.839338337591243e-18;
    const fst_twofold phase = drive_phase(flow, t);
    fst_twofold turns = fst_twofold_times(phase, inverse_high);
    turns = fst_twofold_add(turns, phase.high * inverse_low);
    *whole = floor(turns.high);
    *rest = (turns.high - *whole) + turns.low;
    if (*rest < 0) {
        *whole -= 1.0;
        *rest += 1.0;
    }
}
