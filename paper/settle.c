/* settle.c - runs that are made longer until their motion has settled, so that no statement rests on the means
 * of a transient. */
#include "paper/runs.h"

#include <stdio.h>

/* A run that has not settled is made again, twice as long and with all of the earlier time discarded, at most
 * so many times. */
enum { MOST_DOUBLINGS = 3 };
/* A mean with a greater relative error than this is not known: the verdicts ask for a hundredth at best. */
static const double KNOWN = 1e-3;

static int is_known(double mean, double error, double scale)
{
    return error <= KNOWN * fmax(fabs(mean), scale); /* false where the error is undefined */
}

int fst_paper_is_settled(const fst_run_result *result)
{
    if (result->regime == FST_REGIME_LOCKED)
        return 1;
    return (result->regime == FST_REGIME_LIBRATING || result->regime == FST_REGIME_COUNTER_ROTATING ||
            result->regime == FST_REGIME_COROTATING) &&
           is_known(result->mean_r, result->mean_r_error, 0.0) &&
           is_known(result->mean_alpha_dot, result->mean_alpha_dot_error, 1e-3 * result->omega);
}

int fst_paper_may_settle(const fst_run_result *result)
{
    return !fst_paper_is_settled(result) && result->regime != FST_REGIME_CHAOTIC &&
           result->regime != FST_REGIME_EJECTED && result->regime != FST_REGIME_LIFTED;
}

/* Make all means undefined, so that nothing can rest on them. */
static void forget_means(fst_run_result *result)
{
    const double omega = result->omega, frequency = result->frequency_hz, periods = result->periods;
    const double time = result->end_time, exponent = result->largest_exponent;
    const double exponent_error = result->largest_exponent_error;
#define FST_RESULT(name, unit, doc) result->name = NAN;
#include <festoon/run.def>
#undef FST_RESULT
    result->omega = omega;
    result->frequency_hz = frequency;
    result->periods = periods;
    result->end_time = time;
    result->largest_exponent = exponent;
    result->largest_exponent_error = exponent_error;
}

/* Make the run, and up to `tries` - 1 times more, each time twice as long, while it may settle. */
static fst_status run_longer(fst_params *params, int tries, const fst_progress *progress,
                             fst_run_result *result, fst_table *trajectory, fst_error *error)
{
    fst_run_options options = fst_default_run_options();
    options.progress = progress;
    for (;;) {
        const fst_status status = trajectory ? fst_collect_run(params, progress, result, trajectory, error)
                                             : fst_run(params, &options, result, error);
        if (status != FST_OK || !fst_paper_may_settle(result) || --tries == 0)
            return status;
        if (trajectory)
            fst_table_free(trajectory);
        params->run_discard = params->run_periods;
        params->run_periods *= 2.0;
    }
}

fst_status fst_paper_run_settled(fst_params *params, const fst_progress *progress, fst_run_result *result,
                                 fst_table *trajectory, fst_error *error)
{
    const fst_status status = run_longer(params, 1 + MOST_DOUBLINGS, progress, result, trajectory, error);
    if (status == FST_OK && fst_paper_may_settle(result))
        forget_means(result);
    return status;
}

fst_status fst_paper_run_dry(fst_paper_run *run, int tries, const fst_progress *progress, fst_table *trajectory,
                             fst_error *error)
{
    const fst_status status = run_longer(&run->params, tries, progress, &run->result, trajectory, error);
    run->done = status == FST_OK || status == FST_STEP_UNDERFLOW;
    return run->done ? FST_OK : status;
}

int fst_paper_unsettled(const fst_paper_state *paper, fst_scan scan, fst_dynamics dynamics)
{
    int count = 0;
    for (int i = 0; scan < FST_SCAN_NONE && i < paper->counts[scan]; ++i) {
        const fst_paper_run *run = &paper->scans[scan][dynamics][i];
        count += run->done && fst_paper_may_settle(&run->result);
    }
    return count;
}
