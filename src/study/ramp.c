/* ramp.c - means over the pieces of a slow ramp of the drive.
 *
 * On a ramp the drive changes steadily from the end of the discard to the end of the run.  The way is cut into
 * pieces of equal length, each of which has its means:
 *
 *     omega    |              .  '
 *              |        .  '     :           a steady ramp: means over the whole returns in each piece, or over all
 *              |  .  '     :     :           of it where the bead does not turn
 *              +--------------------- t
 *
 *     omega    |            .-----'          a ramp that waits (ramp_wait.c): the drive stands still half way through
 *              |      .-----'                each piece until the motion has settled, and the means are those of the
 *              |  .---'                      motion there
 *              +--------------------- t
 */
#include "study/ramp.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/constants.h"

void fst_ramp_begin(fst_ramp *ramp, const fst_run_options *options, double discard, double periods,
                    fst_window *window)
{
    memset(ramp, 0, sizeof *ramp);
    ramp->options = options;
    ramp->is_given = !isnan(options->ramp_from);
    if (!ramp->is_given)
        return;
    /* The discard runs at the first frequency; the rest of the periods are counted at the ramp's mean. */
    const double turns = periods - discard;
    const double duration = turns * FST_TWO_PI / (0.5 * (options->ramp_from + options->ramp_to));
    ramp->rate = (options->ramp_to - options->ramp_from) / duration;
    ramp->from = window->span.from;
    ramp->until = window->span.until = window->span.from + duration;
    ramp->waits = ramp->rate != 0.0 && options->ramp_wait > 0;
}

fst_status fst_ramp_tell(fst_ramp *ramp, const fst_ramp_point *point, fst_error *error)
{
    const fst_run_sink *sink = &ramp->options->sink;
    ramp->piece += 1;
    return sink->ramp_point ? sink->ramp_point(sink->user, point, error) : FST_OK;
}

/* ------------------------------------------------------------------ steady */

/* End the piece at the last whole drive of its steps: means over the whole returns of Phi in it, or over all of
 * it where there were none. */
static fst_status end_piece(fst_ramp *ramp, const fst_window *window, const fst_mark *end, fst_error *error)
{
    const int whole_return = ramp->returns >= 3;
    const fst_mark *start = ramp->piece > 0 ? &ramp->start : &window->periods.kept[0];
    fst_ramp_point point = {.settled = 0};
    fst_means_between(window, whole_return ? &ramp->first : start, whole_return ? &ramp->last : end, &point);
    ramp->start = *end;
    ramp->returns = 0;
    return fst_ramp_tell(ramp, &point, error);
}

/* A crossing of the section: every second one completes a whole return. */
static void count_return(fst_ramp *ramp, const fst_mark *crossing)
{
    if (ramp->returns == 0)
        ramp->first = *crossing;
    if (ramp->returns % 2 == 0)
        ramp->last = *crossing;
    ramp->returns += 1;
}

static fst_status end_pieces(fst_ramp *ramp, fst_window *window, fst_flow *flow, fst_error *error)
{
    const int pieces = ramp->options->ramp_points;
    const double length = (ramp->until - ramp->from) / pieces;
    while (ramp->piece < pieces) {
        const int last = ramp->piece + 1 == pieces;
        const fst_twofold t = {last ? ramp->until : ramp->from + (ramp->piece + 1) * length, 0.0};
        const double x = fst_flow_fraction(flow, t);
        if (x > 1.0 + 1e-12)
            return FST_OK;
        fst_mark end;
        fst_mark_take(&end, &window->quadrature, flow, x > 1.0 - 1e-12 ? 1.0 : x, 1);
        const fst_status status = end_piece(ramp, window, &end, error);
        if (status != FST_OK)
            return status;
    }
    return FST_OK;
}

/* ------------------------------------------------------------------ waiting */

/* A crossing of the section while the ramp waits: the whole return that it completes, and the asymmetry there
 * (ramp_wait.c). */
static void note_return(fst_ramp_wait *w, const fst_returns *r)
{
    if (r->since_break < 3 || r->crossings % 2 == 0)
        return;
    double greatest = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        greatest = fmax(greatest, 0.25 * fabs(r->section[0][i] - 2.0 * r->section[1][i] + r->section[2][i]));
    const int place = (int)(w->returns % (FST_WAIT_RETURNS + 1));
    w->marks[place] = r->crossing;
    w->asymmetry[place] = greatest;
    w->returns += 1;
}

fst_status fst_ramp_step(fst_ramp *ramp, fst_window *window, fst_flow *flow, fst_error *error)
{
    const fst_returns *r = &window->returns;
    if (!ramp->is_given)
        return FST_OK;
    if (ramp->waits) {
        if (ramp->is_waiting && r->crossed)
            note_return(&ramp->wait, r);
        return FST_OK;
    }
    if (r->crossed)
        count_return(ramp, &r->crossing);
    return end_pieces(ramp, window, flow, error);
}

/* ------------------------------------------------------------------ the end */

void fst_ramp_explain(const fst_ramp *ramp, fst_run_result *result)
{
    if (!ramp->waits)
        (void)snprintf(
            result->reason, sizeof result->reason,
            "a ramp has no single regime; this one did not wait: where an orbit loses its stability the bead "
            "follows it on for a while, or to the end, and leaves it late");
    else
        (void)snprintf(result->reason, sizeof result->reason,
                       "a ramp has no single regime; %d of its %d pieces settled on an orbit that closes "
                       "within %g turns%s",
                       ramp->piece - ramp->unsettled, ramp->piece, ramp->options->ramp_wait,
                       ramp->unsettled > 0 ? ", the others tell where the bead was then" : "");
}
