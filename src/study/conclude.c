/* conclude.c - from a run to its result: the end, means, extremes, regime. */
#include "study/conclude.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/festoons.h"
#include "base/listed.h"
#include "study/regime.h"
#include "study/settle.h"

static const fst_result_info RESULTS[] = {
#define FST_RESULT(name, unit, doc) {#name, unit, doc, offsetof(fst_run_result, name)},
#include <festoon/run.def>
#undef FST_RESULT
};

int fst_result_count(void)
{
    return (int)(sizeof RESULTS / sizeof *RESULTS);
}

const fst_result_info *fst_result_at(int index)
{
    return index >= 0 && index < fst_result_count() ? &RESULTS[index] : NULL;
}

const char *fst_regime_name(fst_regime regime)
{
    FST_NAME_IN(FST_REGIMES, regime, "undecided");
}

const char *fst_symmetry_name(fst_symmetry symmetry)
{
    if (symmetry == FST_SYMMETRY_NONE)
        return NULL;
    FST_NAME_IN(FST_SYMMETRIES, symmetry, NULL);
}

void fst_result_clear(fst_run_result *result)
{
    memset(result, 0, sizeof *result);
    result->never_slips = -1;
#define FST_RESULT(name, unit, doc) result->name = NAN;
#include <festoon/run.def>
#undef FST_RESULT
}

/* The end of the run; `steady`: the drive was the same all the time. */
static void fill_end(const fst_watched_run *run, int steady, fst_run_result *result)
{
    fst_flow *flow = run->flow;
    const double x = run->end.happened ? run->end.fraction : 1.0;
    const fst_twofold t = fst_flow_time(flow, x);
    if (x == 1.0)
        memcpy(result->final_state, flow->step.end, sizeof result->final_state);
    else
        fst_flow_at(flow, x, result->final_state);
    double whole, rest;
    fst_drive_turns(&flow->drive, t, &whole, &rest);
    result->end_time = t.high;
    result->settled_at = run->end.happened ? NAN : run->settling.settled_at;
    const int all_done = steady && t.high == run->window.span.until && isnan(run->settling.settled_at);
    result->periods = all_done ? fst_run_periods(run->params) : whole + rest;
    result->omega = fst_drive_rate_double(&flow->drive, t);
    const fst_model *model = run->model;
    const int as_given = steady && isnan(model->params.drive_omega);
    result->frequency_hz =
        as_given ? model->params.drive_frequency : result->omega / (FST_TWO_PI * model->groups.time_unit);
    result->norm_drift = flow->norm_drift;
    result->accepted = flow->accepted;
    result->rejected = flow->rejected;
    result->rhs_calls += flow->rhs_calls;
}

fst_regime fst_regime_of_end(const fst_groups *groups, fst_regime end, const char **how)
{
    *how = "the normal load on the plate fell to zero";
    if (end == FST_REGIME_LIFTED)
        return end;
    *how = "the bead passed the plate's edge";
    if (groups->map_radius > groups->plate_radius)
        return FST_REGIME_EJECTED;
    *how = "the bead left the disc that the map of magnet.file covers, beyond which the field is not known,";
    return FST_REGIME_UNDECIDED;
}

/* The bead left the plate: nothing else is said of the run. */
static void tell_of_end(const fst_watched_run *run, fst_run_result *result)
{
    const char *how;
    result->regime = fst_regime_of_end(&run->model->groups, run->end.regime, &how);
    const double r = sqrt(result->final_state[FST_X] * result->final_state[FST_X] +
                          result->final_state[FST_Y] * result->final_state[FST_Y]);
    (void)snprintf(result->reason, sizeof result->reason,
                   "%s at t = %.10g, after %.6g drive periods, at r = %.6g", how, result->end_time,
                   result->periods, r);
}

/* Patterns and period of a turning bead.  Where the symmetry is not known, there may be twice as many festoons; a
 * magnet that is not its own image under half a turn leaves no doubt. */
static void fill_turning(const fst_watched_run *run, fst_run_result *result)
{
    if (result->regime != FST_REGIME_COUNTER_ROTATING && result->regime != FST_REGIME_COROTATING)
        return;
    const double single = fst_festoons_a_lap(1, result->omega, result->mean_alpha_dot);
    const size_t told = strlen(result->reason);
    result->period = fst_drive_period_double(fabs(result->omega - result->mean_alpha_dot));
    if (result->symmetry != FST_SYMMETRY_NONE || !run->model->has_s2)
        result->festoons = result->symmetry == FST_SYMMETRY_S2 ? 2.0 * single : single;
    else
        (void)snprintf(result->reason + told, sizeof result->reason - told, "; festoons: %.4g, or %.4g if S2",
                       single, 2.0 * single);
}

/* Say why it is not known whether the contact slips. */
static void tell_of_contact(const fst_watched_run *run, fst_run_result *result)
{
    const size_t told = strlen(result->reason);
    if (run->window.dry && result->never_slips < 0)
        (void)snprintf(result->reason + told, sizeof result->reason - told,
                       "; whether the contact slips depends on run.rtol");
}

void fst_conclude_ramp(const fst_watched_run *run, const fst_ramp *ramp, fst_run_result *result)
{
    fill_end(run, 0, result);
    if (run->end.happened)
        tell_of_end(run, result);
    else
        fst_ramp_explain(ramp, result);
}

fst_status fst_conclude(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result,
                        int *needs_exponent, fst_error *error)
{
    *needs_exponent = 0;
    fill_end(run, 1, result);
    if (run->end.happened) {
        tell_of_end(run, result);
        return FST_OK;
    }
    const fst_mark_series *series = fst_window_series(&run->window, run->flow->t);
    if (series->offered < 2) {
        (void)snprintf(
            result->reason, sizeof result->reason,
            "the run is too short: %.6g drive periods and %.6g of them discarded leave no two whole ones for "
            "the means; raise run.periods or lower run.discard",
            fst_run_periods(run->params), run->window.span.from / run->window.period);
        return FST_OK;
    }
    fst_means_fill(&run->window, series, run->params, result);
    fst_settling_widen_errors(run, result);
    result->returns = run->window.returns.crossings;
    if (exponent && exponent->failed)
        return fst_fail(error, FST_STEP_UNDERFLOW, "Lyapunov exponent",
                        "the step size underflowed while the Lyapunov exponent was computed; try a larger "
                        "run.rtol");
    *needs_exponent = !fst_decide_regime(run, exponent, result);
    if (result->regime == FST_REGIME_CHAOTIC)
        fst_means_of_chaos(&run->window, series, run->params, result);
    fill_turning(run, result);
    tell_of_contact(run, result);
    if (result->regime == FST_REGIME_LOCKED && !fst_n_is_free(run))
        result->tilt_deg = NAN; /* n stands still in the end; a plane would be that of the way there */
    return FST_OK;
}

void fst_ask_exponent(const fst_watched_run *run, fst_exponent *asked)
{
    const fst_mark *first = &run->window.periods.kept[0];
    memset(asked, 0, sizeof *asked);
    asked->world = fst_flow_world(run->flow);
    memcpy(asked->state, first->state, sizeof asked->state);
    asked->duration = fst_twofold_difference(run->flow->t, first->t);
    asked->rtol = run->params->run_rtol;
}
