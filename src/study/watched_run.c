/* watched_run.c - a run of one bead from its start, step by step.
 *
 *     start      discard             window                    end
 *       |-------------------|-----------------------------------|
 *       0               span.from                           span.until
 *
 * The flow makes the steps, the window observes them, and here is looked whether a step takes the bead off the
 * plate. Who makes the steps is left open: fst_run() (run.c) makes them one at a time, with samples and ramps;
 * rows without lanes (rows.c) likewise; rows in lanes (lane_rows.c) have them made by an engine.
 */
#include "study/watched_run.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"
#include "model/params.h"
#include "study/settle.h"

fst_status fst_watched_run_begin(fst_watched_run *run, const fst_params *params, const double *start,
                                 fst_error *error)
{
    memset(run, 0, sizeof *run);
    run->params = params;
    fst_status status = fst_model_new(params, &run->model, error);
    if (status != FST_OK)
        return status;
    double state[FST_STATE_SIZE];
    if (start)
        memcpy(state, start, sizeof state);
    else
        status = fst_start_state(params, run->model, state, error);
    if (status != FST_OK)
        return status;
    fst_flow_options o = fst_default_flow_options();
    o.rtol = params->run_rtol;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        o.atol[i] = params->run_rtol;
    status = fst_flow_new(run->model, &o, state, &run->flow, error);
    if (status != FST_OK)
        return status;
    const double period = fst_drive_period_double(run->model->groups.omega);
    const fst_span span = {.from = fst_run_discard(params) * period, .until = fst_run_periods(params) * period};
    fst_window_begin(&run->window, &span, period, run->flow);
    run->window.returns.left_out.rtol = params->run_rtol;
    run->window.returns.left_out.limit = fmax(1e-9, 10.0 * params->run_rtol);
    fst_settling_begin(run);
    return FST_OK;
}

void fst_watched_run_free(fst_watched_run *run)
{
    fst_flow_free(run->flow);
    fst_model_free(run->model);
    run->flow = NULL;
    run->model = NULL;
}

int fst_watched_run_ends(fst_watched_run *run)
{
    fst_run_end *end = &run->end;
    double x;
    end->fraction = 2.0;
    if (fst_flow_first_negative(run->flow, fst_edge_function, 0.0, &x))
        *end = (fst_run_end){1, FST_REGIME_EJECTED, x};
    if (fst_flow_first_negative(run->flow, fst_load_function, 0.0, &x) && x < end->fraction)
        *end = (fst_run_end){1, FST_REGIME_LIFTED, x};
    return end->happened;
}

fst_status fst_watched_run_step(fst_watched_run *run, double t_limit, fst_error *error)
{
    const fst_status status = fst_flow_step(run->flow, t_limit, error);
    if (status == FST_OK && !fst_watched_run_ends(run))
        fst_window_step(&run->window, run->flow);
    return status;
}

fst_status fst_watched_run_go_on(fst_watched_run *run, int steps, int *over, fst_error *error)
{
    fst_status status = FST_OK;
    *over = 0;
    for (int i = 0; i < steps && status == FST_OK && !*over; ++i) {
        status = fst_watched_run_step(run, run->window.span.until, error);
        if (status == FST_OK)
            (void)fst_settling_look(run);
        const fst_twofold end = {run->window.span.until, 0.0};
        *over = run->end.happened || fst_twofold_difference(end, run->flow->t) <= 0;
    }
    return status;
}
