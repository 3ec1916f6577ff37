/* ramp.c - means over the pieces of a slow frequency ramp. */
#include "study/run_state.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define TWO_PI 6.283185307179586476925287

/* End the piece at the last whole drive of its steps: means over the whole returns of Phi in it, or over all of
 * it where there were none. */
static fst_status end_piece(fst_run_state *run, const fst_mark *end, fst_error *error)
{
    const int whole_return = run->piece_returns >= 3;
    fst_ramp_point point = {.settled = 0};
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

/* ------------------------------------------------------------------ a ramp that waits
 *
 * When an orbit loses its stability on a ramp, the deviation from it has decayed to rounding, and has to grow
 * again from there while the drive moves on: the bead leaves the orbit late, by more the faster the ramp, and
 * at the usual rates not at all (a delayed bifurcation).  So the drive stands still half way through each
 * piece, a small disturbance is added to the velocities, and the means are taken when it has either died out or
 * grown to a new orbit.
 *
 * The asymmetry is watched by a second difference of successive half returns x0, x1, x2, mapped by S2 to one
 * side: |x2 - 2 x1 + x0|/4.  It is the amplitude of what alternates, and blind to what moves slowly one way.
 */
static const double DIED_OUT = 1e-2; /* asymmetry over the disturbance: below, the orbit is symmetric */
static const double GROWN = 1e2;     /* the same: above, the orbit is not, if it changes no more */
static const double STEADY = 1e-3;   /* relative change of the asymmetry over the last returns */
static const double ARRIVED = 2e-5;  /* what is left of the way to the orbit, where the means begin */
static const double SLOWEST =
    0.9999;                 /* a return's distance over the one before: nearer to 1 is not told from it */
enum { FEWEST_TURNS = 16 }; /* in which a turning bead makes its returns; else none are waited for */

double fst_ramp_progress(const fst_run_state *run)
{
    return (double)run->ramp_piece / run->options->ramp_points;
}

void fst_ramp_crossing(fst_run_state *run, const fst_mark *mark, const double *image)
{
    const fst_returns *r = &run->returns;
    fst_ramp_wait *w = &run->wait;
    if (r->since_break < 3 || r->crossings % 2 == 0)
        return;
    double greatest = 0.0;
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        greatest = fmax(greatest, 0.25 * fabs(image[i] - 2.0 * r->section[0][i] + r->section[1][i]));
    const int place = (int)(w->returns % (FST_WAIT_RETURNS + 1));
    w->marks[place] = *mark;
    w->asymmetry[place] = greatest;
    w->returns += 1;
}

/* The way that is left to the orbit where the means begin, which is at the `oldest` mark: the distances of
 * whole returns fall by the same factor from return to return, and this is the sum of all that follow.  The
 * last one alone does not tell: the returns before it, over which the means are taken, may be a thousand times
 * as far. */
static double way_left(const fst_mark *oldest, const fst_mark *latest, double rounding)
{
    if (oldest->full_distance <= rounding)
        return 0.0;
    const double ratio = fmax(latest->full_distance, rounding) / oldest->full_distance;
    return oldest->full_distance / (1.0 - fmin(pow(ratio, 1.0 / FST_WAIT_RETURNS), SLOWEST));
}

/* The orbit has closed: it is symmetric, or asymmetric by an amount that no longer changes. */
static int has_settled(const fst_run_state *run)
{
    const fst_ramp_wait *w = &run->wait;
    if (w->returns <= FST_WAIT_RETURNS)
        return 0;
    const int latest = (int)((w->returns - 1) % (FST_WAIT_RETURNS + 1)),
              oldest = (int)(w->returns % (FST_WAIT_RETURNS + 1));
    const double now = w->asymmetry[latest], before = w->asymmetry[oldest];
    const double noise = fmax(run->options->ramp_disturbance, 10.0 * run->params->run_rtol);
    const double rounding = 100.0 * run->params->run_rtol;
    if (!(way_left(&w->marks[oldest], &w->marks[latest], rounding) < ARRIVED))
        return 0;
    return now < DIED_OUT * noise || (now > GROWN * noise && fabs(now - before) <= STEADY * now);
}

/* Every velocity a little larger: what is unstable has something to grow from. */
static void disturb(fst_run_state *run)
{
    double *state = run->flow->step.end;
    for (int i = FST_VX; i < FST_STATE_SIZE; ++i)
        if (i < FST_NX || i > FST_NZ)
            state[i] += run->options->ramp_disturbance;
    fst_flow_restart(run->flow);
}

/* Stand still until the motion has settled, but for a bounded time; the means of the piece. */
static fst_status wait_and_measure(fst_run_state *run, fst_ramp_point *point, fst_error *error)
{
    fst_mark from, to;
    const double period = TWO_PI / fst_flow_omega(run->flow, run->flow->t), begun = run->flow->t.high;
    const double longest = begun + run->options->ramp_wait * period;
    fst_mark_take(&from, &run->q, run->flow, 1.0, 1);
    fst_flow_begin_ramp(run->flow, 0.0);
    disturb(run);
    run->is_waiting = 1;
    memset(&run->wait, 0, sizeof run->wait);
    run->returns.since_break = 0;
    fst_status status = FST_OK;
    int settled = 0, turns = 1;
    while (status == FST_OK && !run->ended && !settled && turns && run->flow->t.high < longest) {
        status = fst_run_one_step(run, longest, error);
        settled = has_settled(run);
        turns = run->flow->t.high < begun + FEWEST_TURNS * period || run->wait.returns > FST_WAIT_RETURNS / 2;
    }
    run->is_waiting = 0;
    if (status != FST_OK || run->ended)
        return status;
    fst_mark_take(&to, &run->q, run->flow, 1.0, 1);
    const fst_ramp_wait *w = &run->wait;
    const int whole = w->returns > FST_WAIT_RETURNS;
    fst_means_between(run, whole ? &w->marks[w->returns % (FST_WAIT_RETURNS + 1)] : &from,
                      whole ? &w->marks[(w->returns - 1) % (FST_WAIT_RETURNS + 1)] : &to, point);
    point->settled = settled;
    return FST_OK;
}

fst_status fst_ramp_with_waiting(fst_run_state *run, fst_error *error)
{
    const int pieces = run->options->ramp_points;
    const double half = 0.5 * (run->t_end - run->t_discard) / pieces;
    run->t_end = INFINITY; /* the time spent waiting is not known before */
    fst_status status = FST_OK;
    while (status == FST_OK && !run->ended && run->ramp_piece < pieces) {
        fst_ramp_point point;
        fst_flow_begin_ramp(run->flow, run->ramp_rate);
        status = fst_run_steps_until(run, run->flow->t.high + half, error);
        if (status == FST_OK && !run->ended)
            status = wait_and_measure(run, &point, error);
        if (status != FST_OK || run->ended)
            break;
        if (!point.settled) {
            run->unsettled_first = run->unsettled_pieces > 0 ? run->unsettled_first : point.omega;
            run->unsettled_last = point.omega;
            run->unsettled_pieces += 1;
        }
        const fst_run_sink *sink = &run->options->sink;
        run->ramp_piece += 1;
        if (sink->ramp_point)
            status = sink->ramp_point(sink->user, &point, error);
        fst_flow_begin_ramp(run->flow, run->ramp_rate);
        if (status == FST_OK)
            status = fst_run_steps_until(run, run->flow->t.high + half, error);
    }
    run->t_end = run->flow->t.high;
    return status;
}

void fst_ramp_conclude(const fst_run_state *run, fst_run_result *result)
{
    if (!run->ramp_waits)
        (void)snprintf(
            result->reason, sizeof result->reason,
            "a ramp has no single regime; this one did not wait: where an orbit loses its stability the bead "
            "follows it on for a while, or to the end, and leaves it late");
    else
        (void)snprintf(result->reason, sizeof result->reason,
                       "a ramp has no single regime; %d of its %d pieces settled on an orbit that closes "
                       "within %g turns%s",
                       run->ramp_piece - run->unsettled_pieces, run->ramp_piece, run->options->ramp_wait,
                       run->unsettled_pieces > 0 ? ", the others tell where the bead was then" : "");
}
