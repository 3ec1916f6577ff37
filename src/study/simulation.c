/* simulation.c - the steps of fst_run(): samples for the caller, the ramp's bookkeeping, progress. */
#include "study/simulation.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "base/watch.h"
#include "ode/flight.h"
#include "study/settle.h"

/* ------------------------------------------------------------------ samples */

static void fill_sample(fst_flow *flow, double x, fst_twofold t, fst_sample *sample)
{
    memset(sample, 0, sizeof *sample);
    if (x == 1.0)
        memcpy(sample->state, flow->step.end, sizeof sample->state);
    else
        fst_flow_at(flow, x, sample->state);
    double whole, rest;
    fst_flow_drive_turns(flow, t, &whole, &rest);
    const fst_winding angle = fst_flow_bead_angle(flow, x);
    sample->t = t.high;
    sample->drive_turns = whole + rest;
    sample->omega = fst_flow_omega(flow, t);
    sample->bead_angle = fst_winding_angle(&angle);
    sample->alpha = sample->bead_angle + FST_TWO_PI * (whole + rest);
    const double c = cos(FST_TWO_PI * rest), s = sin(FST_TWO_PI * rest), *y = sample->state;
    sample->x = c * y[FST_X] - s * y[FST_Y];
    sample->y = s * y[FST_X] + c * y[FST_Y];
    sample->v_lab[0] = c * y[FST_VX] - s * y[FST_VY];
    sample->v_lab[1] = s * y[FST_VX] + c * y[FST_VY];
    const double *from[2] = {y + FST_NX, y + FST_WX};
    double *to[2] = {sample->n_lab, sample->w_lab};
    for (int i = 0; i < 2; ++i) {
        to[i][0] = c * from[i][0] - s * from[i][1];
        to[i][1] = s * from[i][0] + c * from[i][1];
        to[i][2] = from[i][2];
    }
    sample->flies = fst_flight_is_on(flow);
    if (sample->flies) {
        fst_flight_at(flow, x, &sample->height, &sample->climb);
        fst_raise_source_double(&flow->step.context, sample->height);
    }
    sample->seen = fst_observe_double(&flow->step.context.coefficients, sample->omega, y);
    sample->seen.energy += fst_flight_energy(flow, x);
}

/* Every sample that falls into the last step, up to its fraction `until`. */
static fst_status push_samples(fst_simulation *s, double until, fst_error *error)
{
    const fst_run_sink *sink = &s->options->sink;
    fst_flow *flow = s->run.flow;
    const double drive_period = s->run.window.period, end = s->run.window.span.until;
    if (!sink->sample)
        return FST_OK;
    const int by_time = s->options->sample_spacing > 0.0;
    const fst_twofold unit = {by_time ? s->options->sample_spacing : drive_period, 0.0};
    for (;;) {
        const fst_twofold t =
            fst_twofold_times(unit, (double)s->next_sample / (by_time ? 1 : s->run.params->run_samples));
        double x = flow->has_step ? fst_flow_fraction(flow, t) : (t.high == 0.0 ? 1.0 : 2.0);
        const double slack = flow->has_step ? 1e-9 : 0.0; /* the rounding of times over a short step */
        if (x > until + (until == 1.0 ? slack : 0.0) || t.high > end * (1.0 + 1e-12))
            return FST_OK;
        if (x > 1.0 - slack)
            x = 1.0;
        s->next_sample += 1;
        if (t.high < s->options->sample_from * drive_period * (1.0 - 1e-14))
            continue;
        fst_sample sample;
        fill_sample(flow, x < 0 ? 0.0 : x, t, &sample);
        const fst_status status = sink->sample(sink->user, &sample, error);
        if (status != FST_OK)
            return status;
    }
}

fst_status fst_simulation_begin_samples(fst_simulation *s, fst_error *error)
{
    return push_samples(s, 1.0, error);
}

/* ------------------------------------------------------------------ steps */

static fst_status report_progress(fst_simulation *s, fst_error *error)
{
    const fst_progress *progress = s->options->progress;
    const fst_flow *flow = s->run.flow;
    if (!progress || flow->accepted % 64 != 0)
        return FST_OK;
    const double done = s->ramp.waits ? fst_ramp_progress(&s->ramp) : flow->t.high / s->run.settling.until;
    const double share = s->ramp.rate != 0.0 ? 1.0 : FST_RUN_SHARE; /* a ramp needs no exponent */
    return fst_tell(progress, share * done, NULL, error);
}

fst_status fst_simulation_step(fst_simulation *s, double t_limit, fst_error *error)
{
    fst_status status = fst_watched_run_step(&s->run, t_limit, error);
    if (status != FST_OK)
        return status;
    if (s->run.end.happened)
        return push_samples(s, s->run.end.fraction, error);
    status = push_samples(s, 1.0, error);
    if (status == FST_OK)
        (void)fst_settling_look(&s->run);
    if (status == FST_OK)
        status = fst_ramp_step(&s->ramp, &s->run.window, s->run.flow, error);
    return status == FST_OK ? report_progress(s, error) : status;
}

fst_status fst_simulation_until(fst_simulation *s, double t, fst_error *error)
{
    fst_status status = FST_OK;
    while (status == FST_OK && !s->run.end.happened) {
        const fst_window *window = &s->run.window; /* a run may settle before t, or look at another window */
        const fst_twofold end = {fmin(t, window->span.until), 0.0};
        if (fst_twofold_difference(end, s->run.flow->t) <= 0)
            break;
        status = fst_simulation_step(s, end.high, error);
    }
    return status;
}
