/* splitting_run.c - runs by the splitting method (ode/splitting.inl).
 *
 * Such a run has no events and no dense output, so it tells less than a run by events: means, extremes among
 * the kicks, how the contact slips and sticks, and the motion's outcome by criteria of its own
 * (docs/splitting.md). Numbers that need located returns, as the symmetry and with it the number of
 * festoons, stay NAN.
 */
#include "study/splitting_run.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "base/watch.h"
#include "study/conclude.h"

#define REASON(...) (void)snprintf(result->reason, sizeof result->reason, __VA_ARGS__)

static const double AT_REST = 1e-7;   /* speed in the turning frame below which the bead is locked */
static const double FALLING = 0.5;    /* the speed of the second half over that of the first: dying out */
static const double UNSETTLED = 1e-3; /* difference of a mean between the halves of the window, in its unit */
enum { LEAST_PERIODS = 8, LEAST_CROSSINGS = 4 };

/* ------------------------------------------------------------------ beginning */

static fst_status refuse(const char *key, const char *what, fst_error *error)
{
    return fst_fail(error, FST_BAD_INPUT, key, "run.method splitting %s; choose run.method = events", what);
}

static fst_status check(const fst_params *p, fst_error *error)
{
    if (p->friction_law != FST_FRICTION_COULOMB)
        return refuse("friction.law", "is for friction.law coulomb alone", error);
    if (p->model_dynamics != FST_DYNAMICS_RIGID)
        return refuse("model.dynamics", "is for model.dynamics rigid alone", error);
    if (!isnan(p->friction_mu_static) && p->friction_mu_static != p->friction_mu)
        return refuse("friction.mu_static", "needs static friction as great as sliding friction", error);
    if (p->friction_rolling_resistance != 0.0)
        return refuse("friction.rolling_resistance", "knows no rolling resistance", error);
    if (p->friction_contact_rate != 0.0)
        return refuse("friction.contact_rate", "knows no viscous part of the friction", error);
    if (p->contact_patch != FST_PATCH_POINT)
        return refuse("contact.patch", "is for contact.patch point alone", error);
    if (!isnan(p->impact_restitution))
        return refuse("impact.restitution", "ends where the bead lifts off, and knows no flight", error);
    return FST_OK;
}

/* A whole number of steps, the nearest that are not longer than run.step. */
static fst_status plan_steps(fst_splitting_run *run, fst_error *error)
{
    const fst_params *p = run->params;
    const double length = p->run_periods * run->period, steps = ceil(length / p->run_step * (1.0 - 1e-12));
    if (!(steps <= 1e12))
        return fst_fail(error, FST_BAD_INPUT, "run.step",
                        "run.step = %g makes %.3g steps of this run: raise it or lower run.periods",
                        p->run_step, steps);
    run->job.steps = fmax(steps, 1.0);
    run->job.h = length / run->job.steps;
    run->job.discard = fmin(ceil(fst_run_discard(p) * run->period / run->job.h), run->job.steps);
    return FST_OK;
}

fst_status fst_splitting_begin(fst_splitting_run *run, const fst_params *params, const double *start,
                               fst_error *error)
{
    memset(run, 0, sizeof *run);
    run->params = params;
    fst_status status = check(params, error);
    if (status == FST_OK)
        status = fst_model_new(params, &run->model, error);
    if (status != FST_OK)
        return status;
    if (start)
        memcpy(run->job.start, start, sizeof run->job.start);
    else
        status = fst_start_state(params, run->model, run->job.start, error);
    run->job.coefficients = &run->model->coefficients;
    run->job.plate_radius = run->model->groups.plate_radius;
    run->period = FST_TWO_PI / run->model->groups.omega;
    if (status == FST_OK)
        status = plan_steps(run, error);
    if (status == FST_OK)
        fst_splitting_prepare(&run->job);
    return status;
}

void fst_splitting_free(fst_splitting_run *run)
{
    fst_model_free(run->model);
    run->model = NULL;
}

/* ------------------------------------------------------------------ the result */

static void fill_end(const fst_splitting_run *run, const fst_splitting_outcome *o, fst_run_result *result)
{
    const fst_groups *g = &run->model->groups;
    const int done = o->end == FST_SPLITTING_DONE;
    memcpy(result->final_state, o->state, sizeof result->final_state);
    result->end_time = o->step * run->job.h;
    result->periods = done ? run->params->run_periods : result->end_time / run->period;
    result->omega = g->omega;
    result->frequency_hz =
        isnan(run->params->drive_omega) ? run->params->drive_frequency : g->omega / (FST_TWO_PI * g->time_unit);
    result->accepted = result->rhs_calls = (uint64_t)ceil(o->step);
}

static double deviation(double mean_square, double mean)
{
    return sqrt(fmax(mean_square - mean * mean, 0.0));
}

/* The difference of a mean between the two halves of the window.  It is not reported as the error of the mean,
 * because the error of the step may be greater. */
static double difference(const fst_splitting_sums *s, int quantity)
{
    return fabs(s->half_sum[1][quantity] / s->half_weight[1] - s->half_sum[0][quantity] / s->half_weight[0]);
}

/* The greatest of these, with rates in units of the drive. */
static double change_of_means(const fst_splitting_run *run, const fst_splitting_sums *s)
{
    const double turning = difference(s, FST_MEAN_ALPHA_DOT) / run->model->groups.omega;
    return fmax(fmax(difference(s, FST_MEAN_R), difference(s, FST_MEAN_NZ)), turning);
}

static void fill_contact(const fst_splitting_run *run, const fst_splitting_sums *s, fst_run_result *result)
{
    const fst_groups *g = &run->model->groups;
    const double slip2 = s->sum[FST_MEAN_SLIP2] / s->weight, load = s->sum[FST_MEAN_LOAD] / s->weight;
    result->rms_slip = sqrt(slip2);
    result->max_slip = sqrt(s->most[FST_SPAN_SLIP2]);
    result->mean_friction_power = s->sum[FST_MEAN_FRICTION_POWER] / s->weight;
    result->mean_drive_power = s->sum[FST_MEAN_DRIVE_POWER] / s->weight;
    result->mean_rolling_power = result->mean_pivoting_power = 0.0;
    result->sticking = s->sum[FST_MEAN_STICKING] / s->weight;
    result->never_slips = s->captures == 0 && result->sticking > 1.0 - 1e-6;
    if (result->never_slips)
        result->sticking = 1.0; /* without the time that a slip of rounding lasts */
    if (!result->never_slips && slip2 > 0)
        result->effective_rate = result->mean_friction_power / slip2;
    if (s->rising + s->falling >= 2)
        result->captures_per_return = s->captures / (0.5 * (s->rising + s->falling));
    if (g->gravity > 0) {
        result->mean_load_weights = load / g->gravity;
        result->min_load_weights = s->least[FST_SPAN_LOAD] / g->gravity;
        result->max_load_weights = s->most[FST_SPAN_LOAD] / g->gravity;
    }
    result->dry_friction_rate = run->params->friction_mu * load / (g->eps * g->omega) / g->time_unit;
}

static void fill_means(const fst_splitting_run *run, const fst_splitting_sums *s, fst_run_result *result)
{
    result->mean_r = s->sum[FST_MEAN_R] / s->weight;
    result->std_r = deviation(s->sum[FST_MEAN_R2] / s->weight, result->mean_r - s->r_reference);
    result->min_r = s->least[FST_SPAN_R];
    result->max_r = s->most[FST_SPAN_R];
    result->mean_alpha_dot = s->sum[FST_MEAN_ALPHA_DOT] / s->weight;
    result->mean_nz = s->sum[FST_MEAN_NZ] / s->weight;
    result->mean_b = s->sum[FST_MEAN_B] / s->weight;
    result->std_b = deviation(s->sum[FST_MEAN_B2] / s->weight, result->mean_b - s->b_reference);
    result->min_b = s->least[FST_SPAN_B];
    result->max_b = s->most[FST_SPAN_B];
    result->max_angle_deg = FST_DEGREES * fst_angle_of_gap(s->most[FST_SPAN_GAP2]);
    result->window_periods = (run->job.steps - run->job.discard) * run->job.h / run->period;
    result->returns = (int64_t)(s->rising + s->falling);
    fill_contact(run, s, result);
}

/* ------------------------------------------------------------------ the outcome */

/* Phi turns: regularly one way, and with the same means all the time? */
static void decide_turning(const fst_splitting_sums *s, double change, fst_run_result *result)
{
    const double back = fmin(s->rising, s->falling);
    if (back > 0 || s->rising + s->falling < LEAST_CROSSINGS) {
        REASON(
            "Phi passes the magnet's Y axis %g times rising and %g times falling: irregular, or too short; run "
            "longer, or with run.method = events",
            s->rising, s->falling);
        return;
    }
    result->regime = result->mean_alpha_dot < 0 ? FST_REGIME_COUNTER_ROTATING : FST_REGIME_COROTATING;
    result->period = FST_TWO_PI / fabs(result->omega - result->mean_alpha_dot);
    REASON("Phi turns one way, %g half turns in the window, and the means over its halves agree to %.2g",
           s->rising + s->falling, change);
}

static void decide(const fst_splitting_run *run, const fst_splitting_sums *s, fst_run_result *result)
{
    const double speed = sqrt(s->fastest[1]), early = sqrt(s->fastest[0]),
                 turned = s->turned_most - s->turned_least;
    result->regime = FST_REGIME_UNDECIDED;
    if (result->window_periods < LEAST_PERIODS) {
        REASON("too short: nothing is decided on less than %d drive periods after the discard", LEAST_PERIODS);
        return;
    }
    if (speed < AT_REST) {
        result->regime = FST_REGIME_LOCKED;
        REASON("at rest in the turning frame: |d(x, n)/dt| stays below %.2g over the second half of the window",
               speed);
        return;
    }
    const double change = change_of_means(run, s);
    if (turned <= 2 && speed < FALLING * early) {
        REASON("Phi is bounded and the motion is dying out (speed in the turning frame from %.2g to %.2g): run "
               "longer to see whether it locks",
               early, speed);
        return;
    }
    if (!(change < UNSETTLED)) {
        REASON("the means over the two halves of the window differ by %.2g: the motion drifts or is irregular; "
               "run "
               "longer, or with run.method = events",
               change);
        return;
    }
    if (turned > 2) {
        decide_turning(s, change, result);
        return;
    }
    result->regime = FST_REGIME_LIBRATING;
    REASON("Phi is bounded, the motion does not die out, and the means over the halves of the window agree to "
           "%.2g",
           change);
}

fst_status fst_splitting_conclude(const fst_splitting_run *run, const fst_splitting_outcome *o,
                                  fst_run_result *result, fst_error *error)
{
    fill_end(run, o, result);
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        if (!isfinite(o->state[i]))
            return fst_fail(error, FST_NOT_FINITE, "splitting",
                            "the motion was lost near t = %.6g: lower run.step, or choose run.method = events",
                            result->end_time);
    if (o->end == FST_SPLITTING_EJECTED || o->end == FST_SPLITTING_LIFTED) {
        const int ejected = o->end == FST_SPLITTING_EJECTED;
        const char *how;
        result->regime =
            fst_regime_of_end(&run->model->groups, ejected ? FST_REGIME_EJECTED : FST_REGIME_LIFTED, &how);
        REASON("%s at t = %.6g, after %.6g drive periods, at r = %.6g (to within a step)", how,
               result->end_time, result->periods, hypot(o->state[FST_X], o->state[FST_Y]));
        return FST_OK;
    }
    if (!(o->sums.half_weight[0] > 0 && o->sums.half_weight[1] > 0)) {
        REASON("the run is too short for means: raise run.periods or lower run.discard or run.step");
        return FST_OK;
    }
    fill_means(run, &o->sums, result);
    decide(run, &o->sums, result);
    return FST_OK;
}

/* ------------------------------------------------------------------ one run */

static fst_status check_options(const fst_run_options *o, fst_error *error)
{
    if (!isnan(o->ramp_from))
        return refuse("run.method", "makes no ramps", error);
    if (o->sink.sample)
        return refuse("run.method", "gives no samples for a trajectory", error);
    return FST_OK;
}

fst_status fst_splitting_alone(const fst_params *params, const fst_run_options *options, fst_run_result *result,
                               fst_error *error)
{
    enum { STEPS = 4096 }; /* between two looks whether to stop: some milliseconds */
    const fst_splitting_engine *engine = &fst_splitting_scalar;
    fst_splitting_run run = {.model = NULL};
    fst_status status = check_options(options, error);
    if (status == FST_OK)
        status = fst_splitting_begin(&run, params, options->start, error);
    void *memory = status == FST_OK ? aligned_alloc(64, (engine->bytes + 63) / 64 * 64) : NULL;
    if (status == FST_OK && !memory)
        status = fst_fail(error, FST_NO_MEMORY, "fst_run", "out of memory");
    if (status == FST_OK) {
        memset(memory, 0, engine->bytes);
        engine->load(memory, 0, &run.job);
    }
    for (double made = 0; status == FST_OK && !engine->go_on(memory, STEPS); made += STEPS)
        status = fst_tell(options->progress, made / run.job.steps, NULL, error);
    if (memory && (status == FST_OK || status == FST_INTERRUPTED)) {
        fst_splitting_outcome outcome;
        fst_splitting_outcome_of(engine, memory, 0, &run.job, &outcome);
        if (status == FST_OK)
            status = fst_splitting_conclude(&run, &outcome, result, error);
        else
            fill_end(&run, &outcome, result);
        if (status == FST_INTERRUPTED)
            REASON("interrupted at t = %.10g, after %.6g periods", result->end_time, result->periods);
    }
    free(memory);
    fst_splitting_free(&run);
    return status;
}
