/* run.c - fst_run(): simulate, watch, and describe. */
#include "study/run_state.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"
#include "model/params.h"

#define TWO_PI 6.283185307179586476925287

fst_run_options fst_default_run_options(void)
{
    fst_run_options o;
    memset(&o, 0, sizeof o);
    o.cookie = FST_RUN_OPTIONS_COOKIE;
    o.ramp_from = o.ramp_to = NAN;
    o.ramp_points = 64;
    o.ramp_wait = 1000.0;
    o.ramp_disturbance = 1e-6;
    return o;
}

static fst_status check_options(const fst_run_options *o, fst_error *error)
{
    if (o->cookie != FST_RUN_OPTIONS_COOKIE)
        return fst_fail(error, FST_BAD_INPUT, "fst_run",
                        "the options were not made by fst_default_run_options()");
    if (isnan(o->ramp_from) != isnan(o->ramp_to))
        return fst_fail(error, FST_BAD_INPUT, "fst_run", "a ramp needs both ends, ramp_from and ramp_to");
    if (!isnan(o->ramp_from) &&
        (!(o->ramp_from > 0) || !(o->ramp_to > 0) || !isfinite(o->ramp_from) || !isfinite(o->ramp_to)))
        return fst_fail(error, FST_BAD_INPUT, "fst_run", "the drive of a ramp must stay positive: %g to %g",
                        o->ramp_from, o->ramp_to);
    if (!(o->ramp_wait >= 0 && o->ramp_wait <= 1e6) ||
        !(o->ramp_disturbance >= 0 && o->ramp_disturbance <= 1e-2))
        return fst_fail(error, FST_BAD_INPUT, "fst_run",
                        "ramp_wait = %g or ramp_disturbance = %g is out of range: 0 to 1e6, and 0 to 0.01",
                        o->ramp_wait, o->ramp_disturbance);
    if (o->ramp_points < 1 || o->ramp_points > 1000000)
        return fst_fail(error, FST_BAD_INPUT, "fst_run", "ramp_points = %d is out of range: 1 to 1000000",
                        o->ramp_points);
    return FST_OK;
}

/* ------------------------------------------------------------------ samples */

static void fill_sample(fst_run_state *run, double x, fst_twofold t, fst_sample *sample)
{
    fst_flow *flow = run->flow;
    memset(sample, 0, sizeof *sample);
    if (x == 1.0)
        memcpy(sample->state, flow->step.end, sizeof sample->state);
    else
        fst_flow_at(flow, x, sample->state);
    double whole, rest;
    fst_flow_drive_turns(flow, t, &whole, &rest);
    const fst_winding phi = fst_flow_phi(flow, x);
    sample->t = t.high;
    sample->drive_turns = whole + rest;
    sample->omega = fst_flow_omega(flow, t);
    sample->phi = fst_winding_angle(&phi);
    sample->alpha = sample->phi + TWO_PI * (whole + rest);
    const double c = cos(TWO_PI * rest), s = sin(TWO_PI * rest), *y = sample->state;
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
    sample->seen = fst_observe_double(&flow->step.context.coefficients, sample->omega, y);
}

/* Every sample that falls into the last step, up to its fraction `until`. */
static fst_status push_samples(fst_run_state *run, double until, fst_error *error)
{
    const fst_run_sink *sink = &run->options->sink;
    if (!sink->sample)
        return FST_OK;
    const fst_twofold period = {run->drive_period, 0.0};
    for (;;) {
        const fst_twofold t = fst_twofold_times(period, (double)run->next_sample / run->params->run_samples);
        double x = run->flow->has_step ? fst_flow_fraction(run->flow, t) : (t.high == 0.0 ? 1.0 : 2.0);
        const double slack = run->flow->has_step ? 1e-9 : 0.0; /* the rounding of times over a short step */
        if (x > until + (until == 1.0 ? slack : 0.0) || t.high > run->t_end * (1.0 + 1e-12))
            return FST_OK;
        if (x > 1.0 - slack)
            x = 1.0;
        run->next_sample += 1;
        if (t.high < run->options->sample_from * run->drive_period * (1.0 - 1e-14))
            continue;
        fst_sample sample;
        fill_sample(run, x < 0 ? 0.0 : x, t, &sample);
        const fst_status status = sink->sample(sink->user, &sample, error);
        if (status != FST_OK)
            return status;
    }
}

/* ------------------------------------------------------------------ the steps */

/* Whether the mark of a whole period is needed whole: it will be kept, or is the last. */
static int is_period_needed(const fst_run_state *run, int64_t period)
{
    if (!run->sparse_marks)
        return 1;
    const double last = floor((run->t_end * (1.0 + 1e-12) - run->t_discard) / run->drive_period);
    return period >= (int64_t)last || period % fst_marks_stride((int64_t)last + 1) == 0;
}

/* Whether a whole period, counted from the discard, ends by the end of the last step; its fraction *x there. */
static int period_ends(const fst_run_state *run, int64_t period, double *x)
{
    const double t_high = run->t_discard + (double)period * run->drive_period;
    const fst_twofold t = {t_high > run->t_end * (1 - 1e-15) ? run->t_end : t_high, 0.0};
    *x = fst_flow_fraction(run->flow, t);
    return *x <= 1.0 + 1e-12 && t_high <= run->t_end * (1.0 + 1e-12);
}

void fst_run_mark_periods(fst_run_state *run)
{
    double x;
    while (period_ends(run, run->next_period, &x)) {
        fst_mark mark;
        if (is_period_needed(run, run->next_period))
            fst_mark_take(&mark, &run->q, run->flow, x < 0 ? 0.0 : x > 1.0 - 1e-12 ? 1.0 : x, 1);
        else
            memset(&mark, 0, sizeof mark);
        mark.activity = run->activity;
        run->activity = 0.0;
        if (run->next_period == 0) {
            memcpy(run->window_start, mark.state, sizeof mark.state);
            run->in_window = 1;
            run->window_from = fmin(fmax(x, 0.0), 1.0);
            run->piece_start = mark;
        }
        fst_marks_offer(&run->period_marks, &mark);
        run->next_period += 1;
    }
}

int fst_run_period_needs_integrals(const fst_run_state *run)
{
    double x;
    int needed = 0;
    for (int64_t period = run->next_period; !needed && period_ends(run, period, &x); ++period)
        needed = is_period_needed(run, period);
    return needed;
}

int fst_run_watch_end(fst_run_state *run)
{
    double x;
    run->end_fraction = 2.0;
    if (fst_flow_first_negative(run->flow, fst_edge_function, 0.0, &x)) {
        run->ended = 1;
        run->end_regime = FST_REGIME_EJECTED;
        run->end_fraction = x;
    }
    if (fst_flow_first_negative(run->flow, fst_load_function, 0.0, &x) && x < run->end_fraction) {
        run->ended = 1;
        run->end_regime = FST_REGIME_LIFTED;
        run->end_fraction = x;
    }
    return run->ended;
}

/* Phi's range, which decides whether it is bounded: beyond a whole turn it no longer matters by how much. */
static void watch_phi(fst_run_state *run)
{
    if (run->greatest_phi - run->least_phi > TWO_PI)
        return;
    const double phi = fst_winding_angle(&run->flow->phi);
    run->least_phi = phi < run->least_phi ? phi : run->least_phi;
    run->greatest_phi = phi > run->greatest_phi ? phi : run->greatest_phi;
}

void fst_run_watch_quietly(fst_run_state *run, double activity)
{
    run->activity = activity > run->activity ? activity : run->activity;
    if (run->in_window)
        watch_phi(run);
}

void fst_run_watch_step(fst_run_state *run)
{
    run->window_from = 0.0;
    fst_run_mark_periods(run);
    fst_returns_step(run);
    const double *k = run->flow->step.k[12];
    double activity = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        activity = fabs(k[i]) > activity ? fabs(k[i]) : activity;
    if (run->in_window && !run->extremes_elsewhere)
        fst_quadrature_track(&run->q, run->flow, run->window_from);
    fst_run_watch_quietly(run, activity);
}

static fst_status report_progress(fst_run_state *run, fst_error *error)
{
    const fst_progress *progress = run->options->progress;
    if (!progress || run->flow->accepted % 64 != 0)
        return FST_OK;
    const double done = run->ramp_waits ? fst_ramp_progress(run) : run->flow->t.high / run->t_end;
    const double share = run->ramp_rate != 0.0 ? 1.0 : FST_RUN_SHARE; /* a ramp needs no exponent */
    return fst_tell(progress, share * done, NULL, error);
}

fst_status fst_run_one_step(fst_run_state *run, double t_limit, fst_error *error)
{
    fst_status status = fst_flow_step(run->flow, t_limit, error);
    if (status != FST_OK)
        return status;
    if (!run->in_window)
        fst_quadrature_set_references(&run->q, run->flow);
    fst_quadrature_step(&run->q, run->flow);
    if (fst_run_watch_end(run))
        return push_samples(run, run->end_fraction, error);
    fst_run_watch_step(run);
    status = push_samples(run, 1.0, error);
    if (status == FST_OK && run->is_ramp && !run->ramp_waits)
        status = fst_ramp_step(run, error);
    return status == FST_OK ? report_progress(run, error) : status;
}

fst_status fst_run_steps_until(fst_run_state *run, double t, fst_error *error)
{
    const fst_twofold end = {t, 0.0};
    fst_status status = FST_OK;
    while (status == FST_OK && !run->ended && fst_twofold_difference(end, run->flow->t) > 0)
        status = fst_run_one_step(run, t, error);
    return status;
}

fst_status fst_run_go_on(fst_run_state *run, int steps, int *over, fst_error *error)
{
    const fst_twofold end = {run->t_end, 0.0};
    fst_status status = FST_OK;
    *over = 0;
    for (int i = 0; i < steps && status == FST_OK && !*over; ++i) {
        status = fst_run_one_step(run, run->t_end, error);
        *over = run->ended || fst_twofold_difference(end, run->flow->t) <= 0;
    }
    return status;
}

static fst_status simulate(fst_run_state *run, fst_error *error)
{
    fst_status status = push_samples(run, 1.0, error);
    if (status == FST_OK && run->ramp_rate != 0.0) {
        status = fst_run_steps_until(run, run->t_discard, error);
        if (status == FST_OK && run->ramp_waits)
            return fst_ramp_with_waiting(run, error);
        fst_flow_begin_ramp(run->flow, run->ramp_rate);
    }
    if (status == FST_OK)
        status = fst_run_steps_until(run, run->t_end, error);
    return status;
}

/* ------------------------------------------------------------------ before and after */

static void set_times(fst_run_state *run, const fst_groups *g)
{
    const fst_run_options *o = run->options;
    run->drive_period = TWO_PI / g->omega;
    run->t_discard = fst_run_discard(run->params) * run->drive_period;
    run->t_end = run->params->run_periods * run->drive_period;
    run->is_ramp = !isnan(o->ramp_from);
    if (!run->is_ramp)
        return;
    /* The discard runs at the first frequency; the rest of the periods are counted at the ramp's mean. */
    const double turns = run->params->run_periods - fst_run_discard(run->params);
    const double duration = turns * TWO_PI / (0.5 * (o->ramp_from + o->ramp_to));
    run->ramp_rate = (o->ramp_to - o->ramp_from) / duration;
    run->t_end = run->t_discard + duration;
    run->ramp_waits = run->ramp_rate != 0.0 && o->ramp_wait > 0;
}

fst_status fst_run_begin(fst_run_state *run, fst_error *error)
{
    fst_status status = fst_model_new(run->params, &run->model, error);
    if (status != FST_OK)
        return status;
    double state[FST_STATE_SIZE];
    if (run->options->start)
        memcpy(state, run->options->start, sizeof state);
    else
        status = fst_start_state(run->params, run->model, state, error);
    if (status != FST_OK)
        return status;
    fst_flow_options o = fst_default_flow_options();
    o.rtol = run->params->run_rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = run->params->run_rtol;
    status = fst_flow_new(run->model, &o, state, &run->flow, error);
    if (status != FST_OK)
        return status;
    set_times(run, &run->model->groups);
    fst_quadrature_begin(&run->q, run->flow);
    fst_marks_begin(&run->section_marks);
    fst_marks_begin(&run->period_marks);
    run->least_phi = INFINITY;
    run->greatest_phi = -INFINITY;
    return FST_OK;
}

fst_status fst_run(const fst_params *params, const fst_run_options *options, fst_run_result *result,
                   fst_error *error)
{
    fst_result_clear(result);
    fst_status status = check_options(options, error);
    if (status != FST_OK)
        return status;
    fst_params at_start = *params; /* a ramp starts at its own frequency */
    if (!isnan(options->ramp_from))
        at_start.drive_omega = options->ramp_from;
    fst_run_state *run = calloc(1, sizeof *run);
    if (!run)
        return fst_fail(error, FST_NO_MEMORY, "fst_run", "out of memory");
    run->params = &at_start;
    run->options = options;
    status = fst_run_begin(run, error);
    if (status == FST_OK)
        status = simulate(run, error);
    if (run->flow && (status == FST_OK || status == FST_INTERRUPTED)) {
        const fst_status concluded = fst_run_conclude(run, result, error);
        if (status == FST_OK)
            status = concluded;
        if (status == FST_INTERRUPTED)
            (void)snprintf(result->reason, sizeof result->reason,
                           "interrupted at t = %.10g, after %.6g periods", run->flow->t.high,
                           run->flow->t.high / run->drive_period);
    }
    fst_flow_free(run->flow);
    fst_model_free(run->model);
    free(run);
    return status;
}
