/* advance.c - the public way along a trajectory: to a time or the first event.
 *
 * The flow makes whole steps; the caller of fst_flow_next() stops anywhere.  So the flow keeps a cursor, the
 * fraction of the last step at which the caller stands: the next call first looks through the rest of that
 * step.
 */
#include "ode/flight.h"

#include <assert.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"

static int sign_of(double x)
{
    return (x > 0) - (x < 0);
}

/* The first event of the wanted kinds in ]cursor, 1] of the last step: its fraction, or 2 without one. */
static double first_event(fst_flow *flow, unsigned events, fst_stop *stop)
{
    double first = 2.0, x;
    const double lo = flow->cursor;
    const int side = sign_of(flow->step.end[FST_X]);
    if ((events & FST_AT_SECTION) && flow->section_side && side && side != flow->section_side) {
        const double f_lo = fst_flow_function_at(flow, lo, fst_section_function);
        first = sign_of(f_lo) == side
                    ? lo
                    : fst_flow_locate(flow, fst_section_function, lo, 1.0, f_lo, flow->step.end[FST_X]);
        *stop = FST_AT_SECTION;
    }
    static const struct {
        fst_stop stop;
        fst_state_function function;
    } bounds[] = {{FST_AT_EDGE, fst_edge_function}, {FST_AT_LIFT_OFF, fst_load_function}};
    for (int i = 0; i < 2; ++i) {
        const unsigned bit = bounds[i].stop;
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
 * step's end.  Returns whether the caller wants to know of one. */
static int look_through(fst_flow *flow, fst_twofold end, unsigned events, fst_stop *stop)
{
    const double end_at = fst_flow_fraction(flow, end); /* inside, if the call before stepped past `end` */
    const int end_inside = end_at >= 0.0 && end_at < 1.0;
    if (end_inside && end_at < flow->cursor) { /* back within the step */
        flow->cursor = end_at;
        flow->cursor_time = end;
        *stop = FST_AT_TIME;
        return 1;
    }
    *stop = FST_AT_TIME;
    const double event = first_event(flow, events, stop);
    if (end_inside && end_at < event) {
        flow->cursor = end_at;
        flow->cursor_time = end;
        *stop = FST_AT_TIME;
        return 1;
    }
    const int side = sign_of(flow->step.end[FST_X]);
    if (event <= 1.0) {
        flow->cursor = event;
        flow->cursor_time = fst_flow_time(flow, event);
        if (*stop == FST_AT_SECTION)
            flow->section_side = side;
        else
            flow->beyond |= *stop;
        return 1;
    }
    flow->cursor = 1.0;
    flow->section_side = side ? side : flow->section_side;
    return 0;
}

/* What begins where the modes before and after are these: FST_AT_*. */
static unsigned begun(const fst_flow *before, const fst_flow *after)
{
    const fst_flow_info was = fst_flow_get(before), is = fst_flow_get(after);
    const int slipped = !was.flies && !was.sticks, slips = !is.flies && !is.sticks;
    unsigned events = 0;
    events |= is.flies && !was.flies ? FST_AT_LEAVE : 0;
    events |= after->contact.impacts > before->contact.impacts ? FST_AT_TOUCH : 0;
    events |= is.sticks && !was.sticks ? FST_AT_STICK : 0;
    events |= slips && !slipped ? FST_AT_SLIP : 0;
    events |= is.rests && !was.rests ? FST_AT_REST : 0;
    events |= was.rests && !is.rests ? FST_AT_ROLL : 0;
    return events;
}

/* The caller stands at the end of the last step.  The modes that follow begin here, and not with the next step,
 * if one of the wanted events is among what they begin.  Returns whether the caller wants to know of one. */
static int change_modes(fst_flow *flow, unsigned events, fst_stop *stop)
{
    static const unsigned of_modes =
        FST_AT_LEAVE | FST_AT_TOUCH | FST_AT_STICK | FST_AT_SLIP | FST_AT_REST | FST_AT_ROLL;
    if (fst_contact_changes(flow) && (events & of_modes)) {
        fst_flow changed = *flow; /* what follows shows only when it has begun */
        fst_contact_begin_next(&changed);
        changed.begun = begun(flow, &changed);
        if (changed.begun & events)
            *flow = changed;
    }
    const unsigned told = flow->begun & events, first = told & (~told + 1u);
    if (!told)
        return 0;
    flow->begun &= ~first;
    *stop = (fst_stop)first;
    return 1;
}

static fst_status advance(fst_flow *flow, double t_end, unsigned events, fst_stop *stop, fst_error *error)
{
    const fst_twofold end = {t_end, 0.0};
    const double all = fst_twofold_difference(end, flow->t);
    unsigned evaluations = 0; /* of the last step */
    fst_watch watch;
    fst_watch_begin(&watch, flow->progress);
    for (;;) {
        if (flow->cursor == 1.0) {
            const double left = fst_twofold_difference(end, flow->t);
            if (left >= 0 && change_modes(flow, events, stop))
                return FST_OK;
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
            flow->begun = 0;
            evaluations = (unsigned)(flow->rhs_calls - calls);
            flow->cursor = 0.0;
        }
        if (look_through(flow, end, events, stop))
            return FST_OK;
    }
    *stop = FST_AT_TIME;
    return FST_OK;
}

/* Whoever finds the mark set would work on a flow that is changing under its hands. */
fst_status fst_flow_next(fst_flow *flow, double t_end, unsigned events, fst_stop *stop, fst_error *error)
{
    const char *where = "fst_flow_next";
    if (!isfinite(t_end))
        return fst_fail(error, FST_BAD_INPUT, where, "t_end = %g is not finite", t_end);
    const int at_work = atomic_exchange(&flow->at_work, 1);
    assert(!at_work && "one fst_flow, two calls of fst_flow_next() at once");
    if (at_work)
        return fst_fail(error, FST_BAD_INPUT, where,
                        "this flow is being advanced by another call: one at a time");
    const fst_status status = advance(flow, t_end, events, stop, error);
    atomic_store(&flow->at_work, 0);
    return status;
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
    fst_drive_turns(&copy.drive, t, &whole, &rest);
    info.omega = fst_drive_rate_double(&copy.drive, t);
    info.step = copy.control.proposal;
    info.bead_angle = fst_winding_angle(&angle);
    info.drive_turns = whole + rest;
    info.alpha = info.bead_angle + FST_TWO_PI * (whole + rest);
    info.flies = fst_flight_is_on(flow);
    info.sticks = !info.flies && fst_sticks_double(fst_flow_world(flow), fst_flow_modes(flow)) > 0.5;
    info.rests = fst_flow_world(flow)->kinds.resists && fst_contact_roll(flow) == FST_ROLL_RESTS;
    info.norm_drift = flow->norm_drift;
    info.rhs_calls = flow->rhs_calls;
    info.accepted = flow->accepted;
    info.rejected = flow->rejected;
    return info;
}
