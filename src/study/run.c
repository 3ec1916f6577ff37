/* run.c - fst_run(): simulate, watch, and describe. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/error.h"
#include "base/watch.h"
#include "model/params.h"
#include "study/conclude.h"
#include "study/simulation.h"

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
    if (!(o->sample_spacing >= 0) || !isfinite(o->sample_spacing))
        return fst_fail(error, FST_BAD_INPUT, "fst_run", "sample_spacing = %g is not a time",
                        o->sample_spacing);
    if (o->ramp_points < 1 || o->ramp_points > 1000000)
        return fst_fail(error, FST_BAD_INPUT, "fst_run", "ramp_points = %d is out of range: 1 to 1000000",
                        o->ramp_points);
    return FST_OK;
}

/* ------------------------------------------------------------------ the steps */

static fst_status simulate(fst_simulation *s, fst_error *error)
{
    fst_status status = fst_simulation_samples(s, 1.0, error);
    if (status == FST_OK && s->ramp.rate != 0.0) {
        status = fst_simulation_until(s, s->run.window.span.from, error);
        if (status == FST_OK && s->ramp.waits)
            return fst_simulation_ramp_with_waiting(s, error);
        fst_flow_begin_ramp(s->run.flow, s->ramp.rate);
    }
    if (status == FST_OK)
        status = fst_simulation_until(s, s->run.settling.until, error);
    return status;
}

/* ------------------------------------------------------------------ the conclusion */

/* What the run says of its motion; where that needs the largest exponent, it is computed now, unless the caller
 * has ended the run. */
static fst_status conclude(const fst_simulation *s, int interrupted, fst_run_result *result, fst_error *error)
{
    if (s->ramp.rate != 0.0) {
        fst_conclude_ramp(&s->run, &s->ramp, result);
        return FST_OK;
    }
    int needs_exponent;
    const fst_status status = fst_conclude(&s->run, NULL, result, &needs_exponent, error);
    if (status != FST_OK || !needs_exponent || interrupted)
        return status;
    fst_part last = {s->options->progress, FST_RUN_SHARE, 1.0, NULL};
    const fst_progress progress = {&last, fst_part_tell};
    fst_exponent exponent, *asked = &exponent;
    fst_ask_exponent(&s->run, asked);
    const fst_status found =
        fst_largest_exponents(&fst_tangents_scalar, &asked, 1, last.whole ? &progress : NULL, error);
    if (found != FST_OK)
        return found;
    fst_result_clear(result);
    return fst_conclude(&s->run, asked, result, &needs_exponent, error);
}

fst_status fst_run(const fst_params *params, const fst_run_options *options, fst_run_result *result,
                   fst_error *error)
{
    fst_result_clear(result);
    fst_status status = check_options(options, error);
    if (status != FST_OK)
        return status;
    if (params->run_until == FST_UNTIL_SETTLED && !isnan(options->ramp_from))
        return fst_fail(
            error, FST_BAD_INPUT, "run.until",
            "a ramp ends where its last frequency is reached: run.until settled is for a steady drive");
    fst_params at_start = *params;
    status = fst_params_settle(&at_start, error);
    if (status != FST_OK)
        return status;
    if (!isnan(options->ramp_from))
        at_start.drive_omega = options->ramp_from; /* a ramp starts at its own frequency */
    fst_simulation *s = calloc(1, sizeof *s);
    if (!s)
        return fst_fail(error, FST_NO_MEMORY, "fst_run", "out of memory");
    s->options = options;
    status = fst_watched_run_begin(&s->run, &at_start, options->start, error);
    if (status == FST_OK) {
        fst_ramp_begin(&s->ramp, options, fst_run_discard(params), fst_run_periods(params), &s->run.window);
        if (s->ramp.is_given)
            s->run.settling.until = s->ramp.until; /* its drive has arrived */
        status = simulate(s, error);
    }
    if (s->run.flow && (status == FST_OK || status == FST_INTERRUPTED)) {
        fst_error unheard; /* the error of the caller who ended the run stays */
        const int interrupted = status == FST_INTERRUPTED;
        const fst_status concluded = conclude(s, interrupted, result, interrupted ? &unheard : error);
        if (status == FST_OK)
            status = concluded;
        if (status == FST_INTERRUPTED)
            (void)snprintf(result->reason, sizeof result->reason,
                           "interrupted at t = %.10g, after %.6g periods", s->run.flow->t.high,
                           s->run.flow->t.high / s->run.window.period);
    }
    fst_watched_run_free(&s->run);
    free(s);
    return status;
}
