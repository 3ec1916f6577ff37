/* ramp.c - means over the pieces of a slow frequency ramp. */
#include "study/run_state.h"

/* End the piece at the last whole drive of its steps: means over the whole returns of Phi in it, or over all of
 * it where there were none. */
static fst_status end_piece(fst_run_state *run, const fst_mark *end, fst_error *error)
{
    const int whole_return = run->piece_returns >= 3;
    fst_ramp_point point;
    fst_means_between(run, whole_return ? &run->piece_first : &run->piece_start,
                      whole_return ? &run->piece_last : end, &point);
    run->piece_start = *end;
    run->piece_returns = 0;
    run->ramp_piece += 1;
    const fst_run_sink *sink = &run->options->sink;
    return sink->ramp_point ? sink->ramp_point(sink->user, &point, error) : FST_OK;
}

fst_status fst_ramp_step(fst_run_state *run, fst_error *error)
{
    const double piece = (run->t_end - run->t_discard) / run->options->ramp_points;
    while (run->ramp_piece < run->options->ramp_points) {
        const int last = run->ramp_piece + 1 == run->options->ramp_points;
        const fst_twofold t = {last ? run->t_end : run->t_discard + (run->ramp_piece + 1) * piece, 0.0};
        const double x = fst_flow_fraction(run->flow, t);
        if (x > 1.0 + 1e-12)
            return FST_OK;
        fst_mark end;
        fst_mark_take(&end, &run->q, run->flow, x > 1.0 - 1e-12 ? 1.0 : x, 1);
        const fst_status status = end_piece(run, &end, error);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}
