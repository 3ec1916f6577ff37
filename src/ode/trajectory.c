/* trajectory.c - a trajectory begins, makes its next step, and begins anew after a change from outside, under
 * whatever contact law.
 */
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/disc.h"
#include "model/params.h"
#include "ode/flow.h"

fst_flow_options fst_default_flow_options(void)
{
    fst_flow_options o;
    memset(&o, 0, sizeof o);
    o.cookie = FST_FLOW_OPTIONS_COOKIE;
    o.rtol = FST_DEFAULT_RTOL;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = FST_DEFAULT_RTOL;
    return o;
}

static fst_status check_options(const fst_flow_options *o, const double *state, fst_error *error)
{
    const char *where = "fst_flow_new";
    if (o->cookie != FST_FLOW_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, where, "the options were not made by fst_default_flow_options()");
    if (!(o->rtol >= 1e-16 && o->rtol <= 0.1))
        return fst_fail(error, FST_BAD_INPUT, where, "rtol = %g is out of range: 1e-16 to 0.1", o->rtol);
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        if (!(o->atol[i] > 0) || !isfinite(o->atol[i]))
            return fst_fail(error, FST_BAD_INPUT, where, "atol[%d] = %g must be positive", i, o->atol[i]);
        if (!isfinite(state[i]))
            return fst_fail(error, FST_BAD_INPUT, where, "component %d of the start state is not finite", i);
    }
    if (!isfinite(o->ramp) || !(o->greatest_step >= 0) || !(o->first_step >= 0))
        return fst_fail(error, FST_BAD_INPUT, where, "ramp or step bounds are not finite and non-negative");
    return FST_OK;
}

fst_status fst_flow_new(const fst_model *model, const fst_flow_options *options,
                        const double state[FST_STATE_SIZE], fst_flow **flow, fst_error *error)
{
    *flow = NULL;
    const fst_status status = check_options(options, state, error);
    if (status != FST_OK)
        return status;
    fst_flow *made = calloc(1, sizeof *made);
    if (!made)
        return fst_fail(error, FST_NO_MEMORY, "fst_flow_new", "out of memory");
    fst_bead_step_double *s = &made->step;
    s->context.world = model->world;
    s->context.modes = fst_new_modes_double();
    s->context.modes.slow_2 = fst_disc_slow_2(options->rtol);
    made->groups = model->groups;
    made->rtol = options->rtol;
    memcpy(made->atol, options->atol, sizeof made->atol);
    made->drive.omega = model->groups.omega;
    made->drive.ramp = options->ramp;
    memcpy(s->y, state, FST_STATE_SIZE * sizeof *state);
    (void)fst_renormalise_double(s->y);
    made->contact.slip.next = made->contact.roll.next = -1;
    fst_status begun = options->outside ? fst_outside_begin(made, options->outside, error) : FST_OK;
    if (begun == FST_OK) {
        fst_contact_put_down(made, s->y);
        fst_bead_flow_begin(made, options->first_step, options->greatest_step);
        begun = fst_outside_begun(made, error);
    }
    if (begun != FST_OK) {
        fst_flow_free(made);
        return begun;
    }
    made->bead_angle.x = s->y[FST_X];
    made->bead_angle.y = s->y[FST_Y];
    made->bead_angle_start = made->bead_angle;
    made->cursor = 1.0;
    made->progress = options->progress;
    *flow = made;
    return FST_OK;
}

void fst_flow_restart(fst_flow *flow)
{
    fst_contact_put_down(flow, flow->step.end);
    fst_bead_flow_restart(flow);
    flow->bead_angle_start = flow->bead_angle;
}

void fst_flow_free(fst_flow *flow)
{
    if (flow)
        free(flow->step.context.outside);
    free(flow);
}

fst_status fst_flow_step(fst_flow *flow, double t_limit, fst_error *error)
{
    if (flow->step.context.outside)
        fst_outside_before_step(flow);
    if (fst_flow_world(flow)->kinds.modes) {
        const fst_status status = fst_contact_step(flow, t_limit, error);
        if (status != FST_OK)
            return status;
    } else if (!fst_bead_flow_go(flow, t_limit)) {
        const fst_status failed = flow->step.context.outside ? fst_outside_fail(flow, error) : FST_OK;
        return failed == FST_OK ? fst_flow_fail(flow, error) : failed;
    }
    flow->bead_angle_start = flow->bead_angle;
    flow->cursor = 1.0;
    fst_flow_follow(flow, flow->step.end);
    return FST_OK;
}
