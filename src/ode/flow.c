/* flow.c - one trajectory of the bead: adaptive steps, time, Phi. */
#include "ode/flow.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "model/params.h"

#define TWO_PI 6.283185307179586476925287

fst_flow_options fst_default_flow_options(void)
{
    fst_flow_options o;
    memset(&o, 0, sizeof o);
    o.cookie = FST_FLOW_OPTIONS_COOKIE;
    o.rtol = 1e-10;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = 1e-10;
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

/* Scaled root mean square, the norm of the step control. */
static double scaled_norm(const fst_flow *flow, const double *v)
{
    double sum = 0;
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        const double scaled = v[i] / (flow->atol[i] + flow->rtol * fabs(flow->step.y[i]));
        sum += scaled * scaled;
    }
    return sqrt(sum / FST_STATE_SIZE);
}

/* A first step size from the sizes of the state, its derivative, and how that changes over a small Euler step
 * (Hairer, Norsett and Wanner, section II.4, with eighth roots by square roots). */
static double choose_first_step(fst_flow *flow)
{
    fst_bead_step_double *s = &flow->step;
    const double size = scaled_norm(flow, s->y), slope = scaled_norm(flow, s->k[0]);
    const double trial = size < 1e-5 || slope < 1e-5 ? 1e-6 : 0.01 * size / slope;
    double state[FST_STATE_SIZE], next[FST_STATE_SIZE];
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        state[i] = s->y[i] + trial * s->k[0][i];
    fst_pull_double p;
    fst_rhs_double(&s->context.coefficients, s->omega, state, next, &p);
    flow->rhs_calls += 1;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        next[i] -= s->k[0][i];
    const double bend = scaled_norm(flow, next) / trial;
    const double steepest = slope > bend ? slope : bend;
    const double h = steepest <= 1e-15 ? 1e-3 : sqrt(sqrt(sqrt(0.01 / steepest)));
    return h < 100.0 * trial ? h : 100.0 * trial;
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
    s->context.coefficients = model->coefficients;
    made->groups = model->groups;
    made->rtol = options->rtol;
    memcpy(made->atol, options->atol, sizeof made->atol);
    made->greatest_step = options->greatest_step;
    s->ramp = options->ramp;
    s->omega = made->omega_start = model->groups.omega;
    memcpy(s->y, state, sizeof s->y);
    (void)fst_renormalise_double(s->y);
    fst_begin_steps_double(s);
    made->rhs_calls = 1;
    memcpy(s->end, s->y, sizeof s->end);
    made->phi.x = s->y[FST_X];
    made->phi.y = s->y[FST_Y];
    made->phi_start = made->phi;
    made->cursor = 1.0;
    made->h_next = options->first_step > 0 ? options->first_step : choose_first_step(made);
    *flow = made;
    return FST_OK;
}

void fst_flow_restart(fst_flow *flow)
{
    fst_bead_step_double *s = &flow->step;
    memcpy(s->y, s->end, sizeof s->y);
    s->omega = fst_flow_omega(flow, flow->t);
    fst_begin_steps_double(s);
    flow->rhs_calls += 1;
    flow->phi_start = flow->phi;
    flow->t_start = flow->t;
    flow->has_step = flow->has_dense = 0;
}

void fst_flow_free(fst_flow *flow)
{
    free(flow);
}

double fst_flow_omega(const fst_flow *flow, fst_twofold t)
{
    return flow->omega_start + flow->step.ramp * fst_twofold_difference(t, flow->ramp_start);
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

/* One try at the size s->h; the error over its tolerance, or infinity where a number is not finite. */
static double try_once(fst_flow *flow)
{
    fst_bead_step_double *s = &flow->step;
    fst_bead_try_step_double(s);
    flow->rhs_calls += 11;
    const double error = fst_bead_step_error_double(s, flow->rtol, flow->atol);
    return isfinite(error) ? error : INFINITY;
}

void fst_flow_plan(fst_flow *flow, double t_limit)
{
    const fst_twofold limit = {t_limit, 0.0};
    const double rest = fst_twofold_difference(limit, flow->t), distance = fabs(rest);
    double h = flow->h_next;
    if (flow->greatest_step > 0 && h > flow->greatest_step)
        h = flow->greatest_step;
    flow->attempt_lands = h * 1.01 >= distance;
    flow->attempt = flow->attempt_lands ? rest : rest < 0 ? -h : h;
    flow->rejections = 0;
    flow->worst_error = 0.0;
}

int fst_flow_reject(fst_flow *flow, double error, double factor)
{
    flow->rejected += 1;
    flow->rejections += 1;
    flow->worst_error = error;
    flow->attempt *= error < INFINITY ? factor : 0.1;
    flow->attempt_lands = 0;
    return fabs(flow->attempt) >= 1e-14 * (1.0 + fabs(flow->t.high)) && flow->rejections <= 401;
}

void fst_flow_accept(fst_flow *flow, double error, double factor, double drift, double t_limit)
{
    const double size = fabs(flow->attempt);
    flow->norm_drift += drift;
    flow->rhs_calls += 1;
    flow->accepted += 1;
    flow->t_start = flow->t;
    flow->t = fst_twofold_add(flow->t, flow->attempt);
    if (flow->attempt_lands)
        flow->t = (fst_twofold){t_limit, 0.0};
    flow->has_step = 1;
    flow->has_dense = 0;
    const double proposal = size * factor;
    /* A step cut short to land says nothing against the size that was planned. */
    flow->h_next = flow->attempt_lands && proposal < flow->h_next && error <= 1.0 ? flow->h_next : proposal;
    if (flow->rejections > 0 && flow->h_next > size)
        flow->h_next = size;
    flow->phi_start = flow->phi;
    flow->cursor = 1.0;
}

/* Follow the angle over the fractions [x0, x1] of the last step; `state` is the one at x1.  Where the straight
 * line passes the axis closely the path is bisected until it does not, or until the pieces are at rounding. */
static void follow_phi(fst_flow *flow, fst_winding *phi, double x0, double x1, const double *state)
{
    const double middle = 0.5 * (x0 + x1);
    if (x1 - x0 > 1e-13 && fst_winding_is_doubtful(phi, state[FST_X], state[FST_Y])) {
        double between[FST_STATE_SIZE];
        fst_flow_at(flow, middle, between);
        follow_phi(flow, phi, x0, middle, between);
        follow_phi(flow, phi, middle, x1, state);
        return;
    }
    fst_winding_advance(phi, state[FST_X], state[FST_Y]);
}

fst_winding fst_flow_phi(fst_flow *flow, double x)
{
    if (x == 1.0)
        return flow->phi;
    fst_winding phi = flow->phi_start;
    double state[FST_STATE_SIZE];
    fst_flow_at(flow, x, state);
    follow_phi(flow, &phi, 0.0, x, state);
    return phi;
}

void fst_flow_follow(fst_flow *flow, const double *end)
{
    follow_phi(flow, &flow->phi, 0.0, 1.0, end);
}

fst_status fst_flow_fail(const fst_flow *flow, fst_error *error)
{
    const fst_bead_step_double *s = &flow->step;
    const double r = sqrt(s->y[FST_X] * s->y[FST_X] + s->y[FST_Y] * s->y[FST_Y]);
    char where[96];
    (void)snprintf(where, sizeof where, "t = %.10g (%.6g drive periods), r = %.6g", flow->t.high,
                   flow->t.high * s->omega / TWO_PI, r);
    if (flow->worst_error == INFINITY)
        return fst_fail(
            error, FST_NOT_FINITE, where,
            "the motion stopped being finite at %s; try a smaller run.rtol, and check kappa, h and the "
            "start for extreme values",
            where);
    return fst_fail(
        error, FST_STEP_UNDERFLOW, where,
        "the step size underflowed at %s (error %.3g times the tolerance at step %.3g); try a larger "
        "run.rtol",
        where, flow->worst_error, flow->attempt);
}

fst_status fst_flow_step(fst_flow *flow, double t_limit, fst_error *error)
{
    fst_bead_step_double *s = &flow->step;
    if (flow->has_step) {
        fst_next_step_double(s, fst_flow_omega(flow, flow->t));
        flow->has_step = 0;
    }
    fst_flow_plan(flow, t_limit);
    for (;;) {
        s->h = flow->attempt;
        const double e = try_once(flow);
        if (e <= 1.0) {
            const double drift = fst_finish_step_double(s);
            fst_flow_accept(flow, e, fst_step_factor_double(e), drift, t_limit);
            fst_flow_follow(flow, s->end);
            return FST_OK;
        }
        if (!fst_flow_reject(flow, e, fst_step_factor_double(e)))
            break;
    }
    memcpy(s->end, s->y, sizeof s->end);
    return fst_flow_fail(flow, error);
}

void fst_flow_make_dense(fst_flow *flow)
{
    if (flow->has_dense)
        return;
    fst_bead_make_dense_double(&flow->step); /* not counted: who looks on does not make the method work more */
    flow->has_dense = 1;
}

void fst_flow_at(fst_flow *flow, double x, double state[FST_STATE_SIZE])
{
    fst_flow_make_dense(flow);
    fst_bead_evaluate_dense_double(FST_STATE_SIZE, &flow->step.dense[0][0], FST_STATE_SIZE, x, state);
    (void)fst_renormalise_double(state);
}

const double *fst_flow_slope(const fst_flow *flow)
{
    return flow->step.k[12];
}

double fst_flow_speed(const fst_flow *flow)
{
    const double *slope = fst_flow_slope(flow);
    double greatest = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        greatest = fabs(slope[i]) > greatest ? fabs(slope[i]) : greatest;
    return greatest;
}

double fst_flow_fraction(const fst_flow *flow, fst_twofold t)
{
    return fst_twofold_difference(t, flow->t_start) / flow->step.h;
}

fst_twofold fst_flow_time(const fst_flow *flow, double x)
{
    return x == 1.0 ? flow->t : fst_twofold_add(flow->t_start, x * flow->step.h);
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
