/* flow.c - one trajectory of the bead.
 *
 * The steps themselves are the body's (flow.inl).  This file adds what is a bead's own:
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
#include "ode/flow.h"

#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"

void fst_flow_begin_ramp(fst_flow *flow, double rate)
{
    fst_drive_change(&flow->drive, flow->t, rate);
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
                   flow->t.high / fst_drive_period_double(s->omega), r);
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
}

void fst_flow_components_at(fst_flow *flow, double x, int first, int count, double *out)
{
    fst_flow_make_dense(flow);
    fst_bead_evaluate_dense_double(count, &flow->step.dense[0][first], FST_DENSE_ROW(&flow->step), x, out);
}

void fst_flow_motion_at(fst_flow *flow, double x, fst_motion_double *motion)
{
    double *numbers = motion->numbers;
    motion->modes = *fst_flow_modes(flow);
    memset(numbers, 0, sizeof motion->numbers);
    if (x == 1.0) {
        memcpy(numbers, flow->step.end, sizeof motion->numbers);
        return;
    }
    fst_flow_at(flow, x, numbers);
    if (fst_flow_world(flow)->kinds.modes)
        fst_flow_components_at(flow, x, FST_STATE_SIZE, FST_NUMBERS - FST_STATE_SIZE, numbers + FST_STATE_SIZE);
    else if (flow->step.context.outside)
        numbers[FST_STEP_TIME] = x * flow->step.h;
}

void fst_flow_slope(const fst_flow *flow, double slope[FST_STATE_SIZE])
{
    const fst_world_double *c = fst_flow_world(flow);
    memcpy(slope, FST_PATH_SLOPE(&flow->step, FST_PATH_END), FST_STATE_SIZE * sizeof *slope);
    if (c->kinds.modes) { /* the step's own are not by time */
        fst_pull_double unused;
        fst_rhs_double(c, fst_flow_modes(flow), fst_drive_rate_double(&flow->drive, flow->t), flow->step.end,
                       slope, &unused);
    }
}

double fst_flow_speed(const fst_flow *flow)
{
    return fst_step_speed_double(&flow->step);
}

double fst_flow_drive_at_place(const fst_flow *flow, int place)
{
    const fst_bead_step_double *s = &flow->step;
    const double by_node = s->omega + (s->h * FST_PATH_NODE[place]) * s->ramp;
    return STEP_DRIVE(s, by_node, FST_PATH_STATE(s, place));
}
