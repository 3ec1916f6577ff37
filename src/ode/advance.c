/* advance.c - the public way along a trajectory: to a time or the first event.
 *
 * The flow makes whole steps; the caller of fst_flow_advance() stops anywhere.  So the flow keeps a cursor, the
 * fraction of the last step at which the caller stands: the next call first looks through the rest of that
 * step.
 */
#include "ode/flow.h"

#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* The first event of the wanted kinds in ]cursor, 1] of the last step: its fraction, or 2 if there is none. */
static double first_event(fst_flow *flow, unsigned events, fst_stop *stop)
{
    double first = 2.0, x;
    const double lo = flow->cursor;
    const int side = sign_of(flow->step.end[FST_X]);
    if ((events & (1u << FST_STOP_SECTION)) && flow->section_side && side && side != flow->section_side) {
        const double f_lo = fst_flow_function_at(flow, lo, fst_section_function);
        first = sign_of(f_lo) == side
                    ? lo
                    : fst_flow_locate(flow, fst_section_function, lo, 1.0, f_lo, flow->step.end[FST_X]);
        *stop = FST_STOP_SECTION;
    }
    static const struct {
        fst_stop stop;
        fst_state_function function;
    } bounds[] = {{FST_STOP_EDGE, fst_edge_function}, {FST_STOP_LIFT_OFF, fst_load_function}};
    for (int i = 0; i < 2; ++i) {
        const unsigned bit = 1u << bounds[i].stop;
        if (flow->beyond & bit) { /* reported already: wait until the bead has come back */
            if (fst_flow_function_at(flow, 1.0, bounds[i].function) > 0)
                flow->beyond &= ~bit;
        } else if ((events & bit) && fst_flow_first_negative(flow, bounds[i].function, lo, &x) && x < first) {
            first = x;
            *stop = bounds[i].stop;
        }
    }
    return first;
}

/* Look through the last step from where the caller is: to an event, to `end` where it lies inside, or to the
 * step's end.  Returns whether the caller is to be told. */
static int look_through(fst_flow *flow, fst_twofold end, unsigned events, fst_stop *stop)
{
    const double end_at = fst_flow_fraction(flow, end); /* inside, if the call before stepped past `end` */
    const int end_inside = end_at >= 0.0 && end_at < 1.0;
    if (end_inside && end_at < flow->cursor) { /* back within the step */
        flow->cursor = end_at;
        flow->cursor_time = end;
        *stop = FST_STOP_TIME;
        return 1;
    }
    *stop = FST_STOP_TIME;
    const double event = first_event(flow, events, stop);
    if (end_inside && end_at < event) {
        flow->cursor = end_at;
        flow->cursor_time = end;
        *stop = FST_STOP_TIME;
        return 1;
    }
    const int side = sign_of(flow->step.end[FST_X]);
    if (event <= 1.0) {
        flow->cursor = event;
        flow->cursor_time = fst_flow_time(flow, event);
        if (*stop == FST_STOP_SECTION)
            flow->section_side = side;
        else
            flow->beyond |= 1u << *stop;
        return 1;
    }
    flow->cursor = 1.0;
    flow->section_side = side ? side : flow->section_side;
    return 0;
}

fst_status fst_flow_advance(fst_flow *flow, double t_end, unsigned events, fst_stop *stop, fst_error *error)
{
    if (!isfinite(t_end))
        return fst_fail(error, FST_BAD_INPUT, "fst_flow_advance", "t_end = %g is not finite", t_end);
    const fst_twofold end = {t_end, 0.0};
    const double all = fst_twofold_difference(end, flow->t);
    unsigned evaluations = 0; /* of the last step */
    fst_watch watch;
    fst_watch_begin(&watch, flow->progress);
    for (;;) {
        if (flow->cursor == 1.0) {
            const double left = fst_twofold_difference(end, flow->t);
            if (left == 0.0)
                break;
            flow->section_side = flow->section_side ? flow->section_side : sign_of(flow->step.end[FST_X]);
            fst_watch_reach(&watch, 1.0 - left / all);
            const uint64_t calls = flow->rhs_calls;
            fst_status status = fst_watch_count(&watch, evaluations, error);
            if (status == FST_OK)
                status = fst_flow_step(flow, t_end, error);
            if (status != FST_OK)
                return status;
            evaluations = (unsigned)(flow->rhs_calls - calls);
            flow->cursor = 0.0;
        }
        if (look_through(flow, end, events, stop))
            return FST_OK;
    }
    *stop = FST_STOP_TIME;
    return FST_OK;
}

fst_flow_info fst_flow_get(const fst_flow *flow)
{
    fst_flow copy = *flow; /* the dense output may have to be formed; the caller's flow stays as it is */
    fst_flow_info info;
    memset(&info, 0, sizeof info);
    const fst_twofold t = copy.cursor == 1.0 ? copy.t : copy.cursor_time;
    info.t = t.high;
    info.t_low = t.low;
    if (copy.cursor == 1.0)
        memcpy(info.state, copy.step.end, sizeof info.state);
    else
        fst_flow_at(&copy, copy.cursor, info.state);
    const fst_winding angle = fst_flow_bead_angle(&copy, copy.cursor);
    double whole, rest;
    fst_flow_drive_turns(&copy, t, &whole, &rest);
    info.omega = fst_flow_omega(&copy, t);
    info.step = copy.control.proposal;
    info.bead_angle = fst_winding_angle(&angle);
    info.drive_turns = whole + rest;
    info.alpha = info.bead_angle + FST_TWO_PI * (whole + rest);
    info.norm_drift = flow->norm_drift;
    info.rhs_calls = flow->rhs_calls;
    info.accepted = flow->accepted;
    info.rejected = flow->rejected;
    return info;
}
