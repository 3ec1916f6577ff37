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
    fst_motion_double at;
    memset(sample, 0, sizeof *sample);
    fst_flow_motion_at(flow, x, &at);
    memcpy(sample->state, at.numbers, sizeof sample->state);
    double whole, rest, place[3] = {0.0}, velocity[3] = {0.0}, lab[3];
    fst_drive_turns(&flow->drive, t, &whole, &rest);
    const fst_winding angle = fst_flow_bead_angle(flow, x);
    sample->t = t.high;
    sample->drive_turns = whole + rest;
    sample->omega = fst_drive_rate_double(&flow->drive, t);
    sample->bead_angle = fst_winding_angle(&angle);
    sample->alpha = sample->bead_angle + FST_TWO_PI * (whole + rest);
    memcpy(place, at.numbers + FST_X, 2 * sizeof *place);
    memcpy(velocity, at.numbers + FST_VX, 2 * sizeof *velocity);
    fst_drive_to_laboratory(rest, place, lab);
    sample->x = lab[0];
    sample->y = lab[1];
    fst_drive_to_laboratory(rest, velocity, lab);
    memcpy(sample->v_lab, lab, sizeof sample->v_lab);
    fst_drive_to_laboratory(rest, at.numbers + FST_NX, sample->n_lab);
    fst_drive_to_laboratory(rest, at.numbers + FST_WX, sample->w_lab);
    sample->flies = fst_flight_is_on(flow);
    sample->height = at.numbers[FST_HEIGHT];
    sample->climb = at.numbers[FST_CLIMB];
    sample->seen = fst_observe_motion(fst_flow_world(flow), &at, sample->omega);
}

fst_status fst_simulation_samples(fst_simulation *s, double until, fst_error *error)
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

/* ------------------------------------------------------------------ steps */

static fst_status report_progress(fst_simulation *s, fst_error *error)
{
    const fst_progress *progress = s->options->progress;
    const fst_flow *flow = s->run.flow;
    if (!progress || flow->accepted % 64 != 0)
        return FST_OK;
    const double done =
        s->ramp.waits ? (double)s->ramp.piece / s->options->ramp_points : flow->t.high / s->run.settling.until;
    const double share = s->ramp.rate != 0.0 ? 1.0 : FST_RUN_SHARE; /* a ramp needs no exponent */
    return fst_tell(progress, share * done, NULL, error);
}

fst_status fst_simulation_step(fst_simulation *s, double t_limit, fst_error *error)
{
    fst_status status = fst_watched_run_step(&s->run, t_limit, error);
    if (status != FST_OK)
        return status;
    if (s->run.end.happened)
        return fst_simulation_samples(s, s->run.end.fraction, error);
    status = fst_simulation_samples(s, 1.0, error);
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
