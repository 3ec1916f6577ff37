/* settle.c - when is a run's motion known, so that it need not go on?
 *
 * With run.until: settled the motion is observed from its start.  As soon as it is known, a short window
 * begins, and its end is the run's:
 *
 *     from the start     |--o--o--o--o--o--o--|                     whole returns come closer, and repeat
 *     short window                            |--o--o--o--o--|      means, extremes and regime are of these
 *
 *     discard                  |---------------------------- - -    never known: as with run.until: periods
 *
 * A motion is known when its whole returns repeat and the means of a single return tell those of all to come
 * (observe/left_out.h), or when the bead has stood still in the turning frame for some periods.  A libration,
 * an orbit that does not close and chaos are never known in this way; they take the whole run.
 */
#include "study/settle.h"

#include <math.h>

#include "base/constants.h"

/* Drive periods and returns that the short window lasts: what a regime is decided on. */
static const double LEAST_PERIODS = 5.5, LEAST_RETURNS = 9.5;
/* Greatest |d(state)/dt| of a bead that stands still, or run.rtol (as docs/regimes.md has it). */
static const double AT_REST = 1e-8;
enum { PERIODS_AT_REST = 4 };

void fst_stand_at_end(fst_flow *flow)
{
    if (flow->step.context.coefficients.kinds.paced) {
        fst_contact_begin_step(flow);
        flow->t_start = flow->t;
        flow->bead_angle_start = flow->bead_angle;
    } else {
        fst_flow_restart(flow);
    }
}

void fst_settling_begin(fst_watched_run *run)
{
    fst_settling *s = &run->settling;
    s->asked = run->params->run_until == FST_UNTIL_SETTLED;
    s->settled_at = NAN;
    s->discard = run->window.span.from;
    if (s->asked)
        run->window.span.from = 0.0;
}

/* A new window from the flow's time on. */
static void begin_window(fst_watched_run *run, double until)
{
    fst_window *w = &run->window;
    const fst_span span = {run->flow->t.high, until, w->span.asked_at_end};
    const fst_left_out rule = {.rtol = w->returns.left_out.rtol,
                               .limit = w->returns.left_out.limit,
                               .state =
                                   isnan(run->settling.settled_at) ? FST_LEFT_OUT_NOTHING : FST_LEFT_OUT_NEVER};
    fst_stand_at_end(run->flow);
    fst_window_begin(w, &span, w->period, run->flow);
    w->returns.left_out = rule;
}

/* Whether the bead has stood still for some periods; asked when one has ended. */
static int rests(fst_watched_run *run)
{
    const fst_mark_series *periods = &run->window.periods;
    const int still = periods->offered > 1 && periods->latest.activity < fmax(AT_REST, run->params->run_rtol);
    run->settling.at_rest = still ? run->settling.at_rest + 1 : 0;
    return run->settling.at_rest >= PERIODS_AT_REST;
}

/* Whether the last step completed a return that tells all to come. */
static int repeats(fst_watched_run *run)
{
    fst_returns *r = &run->window.returns;
    return r->crossed && r->crossings % 2 == 1 &&
           fst_left_out_begin(&r->left_out, &r->marks, &run->window.span);
}

int fst_settling_look(fst_watched_run *run)
{
    fst_settling *s = &run->settling;
    fst_window *w = &run->window;
    const double now = run->flow->t.high, until = w->span.until;
    if (!s->asked || !isnan(s->settled_at) || run->end.happened || now >= until)
        return 0;
    const int period_ended = w->periods.offered != s->periods, turns = repeats(run);
    s->periods = w->periods.offered;
    if (turns || (period_ended && rests(run))) {
        const double turn = turns ? fst_left_out_turn(&w->returns.left_out) : 0.0;
        s->settled_at = now / w->period;
        begin_window(run, fmin(until, now + fmax(LEAST_PERIODS * w->period, LEAST_RETURNS * turn)));
        return 1;
    }
    if (!period_ended || w->span.from >= s->discard || now < s->discard)
        return 0;
    s->periods = s->at_rest = 0;
    begin_window(run, until);
    return 1;
}
