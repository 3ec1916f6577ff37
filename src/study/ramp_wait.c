/* ramp_wait.c - a ramp that waits for the motion to settle.
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
#include "study/simulation.h"

#include <math.h>
#include <string.h>

#include "base/constants.h"

static const double DIED_OUT = 1e-2;  /* asymmetry over the disturbance: below, the orbit is symmetric */
static const double GROWN = 1e2;      /* the same: above, the orbit is not, if it changes no more */
static const double STEADY = 1e-3;    /* relative change of the asymmetry over the last returns */
static const double ARRIVED = 2e-5;   /* distance to the orbit at which the means begin */
static const double SLOWEST = 0.9999; /* a return's distance over the one before: nearer to 1 counts as 1 */
enum { FEWEST_TURNS = 16 };           /* in which a turning bead makes its returns; else none are waited for */

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
static int has_settled(const fst_simulation *s)
{
    const fst_ramp_wait *w = &s->ramp.wait;
    const double tolerance = s->run.params->run_rtol;
    if (w->returns <= FST_WAIT_RETURNS)
        return 0;
    const int latest = (int)((w->returns - 1) % (FST_WAIT_RETURNS + 1)),
              oldest = (int)(w->returns % (FST_WAIT_RETURNS + 1));
    const double now = w->asymmetry[latest], before = w->asymmetry[oldest];
    const double noise = fmax(s->options->ramp_disturbance, 10.0 * tolerance);
    const double rounding = 100.0 * tolerance;
    if (!(way_left(&w->marks[oldest], &w->marks[latest], rounding) < ARRIVED))
        return 0;
    return now < DIED_OUT * noise || (now > GROWN * noise && fabs(now - before) <= STEADY * now);
}

/* Every velocity a little larger: what is unstable has something to grow from. */
static void disturb(fst_simulation *s)
{
    double *state = s->run.flow->step.end;
    for (int i = FST_VX; i < FST_STATE_SIZE; ++i)
        if (i < FST_NX || i > FST_NZ)
            state[i] += s->options->ramp_disturbance;
    fst_flow_restart(s->run.flow);
    s->run.window.returns.since_break = 0;
}

/* The means over the whole returns that were kept, or where they are too few over all of the waiting. */
static void measure(const fst_simulation *s, const fst_mark *from, const fst_mark *to, fst_ramp_point *point)
{
    enum { RING = FST_WAIT_RETURNS + 1 };
    const fst_ramp_wait *w = &s->ramp.wait;
    const int whole = w->returns > FST_WAIT_RETURNS;
    fst_means_between(&s->run.window, whole ? &w->marks[w->returns % RING] : from,
                      whole ? &w->marks[(w->returns - 1) % RING] : to, point);
}

/* Stand still until the motion has settled, but for a bounded time; the means of the piece. */
static fst_status wait_and_measure(fst_simulation *s, fst_ramp_point *point, fst_error *error)
{
    fst_mark from, to;
    fst_flow *flow = s->run.flow;
    fst_ramp_wait *w = &s->ramp.wait;
    const double period = fst_drive_period_double(fst_drive_rate_double(&flow->drive, flow->t)),
                 begun = flow->t.high;
    const double longest = begun + s->options->ramp_wait * period;
    fst_mark_take(&from, &s->run.window.quadrature, flow, 1.0, 1);
    fst_flow_begin_ramp(flow, 0.0);
    disturb(s);
    s->ramp.is_waiting = 1;
    memset(w, 0, sizeof *w);
    fst_status status = FST_OK;
    int settled = 0, turns = 1;
    while (status == FST_OK && !s->run.end.happened && !settled && turns && flow->t.high < longest) {
        status = fst_simulation_step(s, longest, error);
        settled = has_settled(s);
        turns = flow->t.high < begun + FEWEST_TURNS * period || w->returns > FST_WAIT_RETURNS / 2;
    }
    s->ramp.is_waiting = 0;
    if (status != FST_OK || s->run.end.happened)
        return status;
    fst_mark_take(&to, &s->run.window.quadrature, flow, 1.0, 1);
    measure(s, &from, &to, point);
    point->settled = settled;
    return FST_OK;
}

fst_status fst_simulation_ramp_with_waiting(fst_simulation *s, fst_error *error)
{
    fst_ramp *ramp = &s->ramp;
    fst_flow *flow = s->run.flow;
    double *until = &s->run.window.span.until;
    const int pieces = s->options->ramp_points;
    const double half = 0.5 * (ramp->until - ramp->from) / pieces;
    *until = INFINITY; /* the time spent waiting is not known before */
    fst_status status = FST_OK;
    while (status == FST_OK && !s->run.end.happened && ramp->piece < pieces) {
        fst_ramp_point point;
        fst_flow_begin_ramp(flow, ramp->rate);
        status = fst_simulation_until(s, flow->t.high + half, error);
        if (status == FST_OK && !s->run.end.happened)
            status = wait_and_measure(s, &point, error);
        if (status != FST_OK || s->run.end.happened)
            break;
        ramp->unsettled += !point.settled;
        status = fst_ramp_tell(ramp, &point, error);
        fst_flow_begin_ramp(flow, ramp->rate);
        if (status == FST_OK)
            status = fst_simulation_until(s, flow->t.high + half, error);
    }
    *until = flow->t.high;
    return status;
}
