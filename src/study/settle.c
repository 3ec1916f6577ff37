/* settle.c - when is a run's motion known, so that it need not go on?
 *
 * With run.until: settled the motion is observed from its start.  As soon as it is known, a short window
 * begins, and its end is the run's:
 *
 *     from the start     |--o--o--o--o|                             it comes closer to itself: states alone
 *     first repetition                |--o--o-|                     it repeats: integrals, too
 *     short window                            |--o--o--o--o--|      means, extremes and regime are of these
 *
 *     discard                  |---------------------------- - -    never known: as with run.until: periods
 *
 * A motion is known when its whole returns repeat (observe/closing.h); when it swings without turning, and the
 * maxima of r repeat (observe/cycle.h); or when the bead has stood still in the turning frame for some periods.
 * Maxima are looked for while Phi does not turn.  An orbit that does not close and chaos are never known in
 * this way; they take the whole run.
 *
 * If the motion is another one at the end of the short window, it was an unstable one that the bead passed.
 * Then nothing is known yet, and the run goes on.
 */
#include "study/settle.h"

#include <math.h>

#include "base/constants.h"
#include "study/regime.h"

/* Drive periods, returns and cycles that the short window lasts: what a regime is decided on. */
static const double LEAST_PERIODS = 5.5, LEAST_TURNS = 9.5;
/* A window that is no shorter than this part of the rest of the run is not worth the trouble. */
static const double WORTHWHILE = 0.5;
/* Greatest |d(state)/dt| of a bead that stands still, in units of run.rtol or of the default tolerance (the
 * integrator's noise, docs/regimes.md), but no more than MOST_AT_REST: a faster bead may as well leave a place
 * slowly.  At the window's end it may be so many times as much: noise has peaks. */
static const double AT_REST = 100.0, DEFAULT_RTOL = 1e-10, MOST_AT_REST = 1e-5, STILL_AT_REST = 100.0;
static const double GROWS = 1e-6; /* rate at which a deviation from rest grows */
/* Under dry friction that rate is known only where the contact slips, so that the bead must have been faster than
 * at rest, by FAR, or faster than QUICK and by MORE, to be known to come to rest there. */
static const double FAR = 1000.0, QUICK = 1e-3, MORE = 10.0;
enum {
    PERIODS_AT_REST = 4,
    PERIODS_WITHOUT_TURNING = 2 /* from then on maxima of r are looked for */
};

void fst_stand_at_end(fst_flow *flow)
{
    if (fst_flow_world(flow)->kinds.modes) {
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
    fst_span *span = &run->window.span;
    s->asked = run->params->run_until == FST_UNTIL_SETTLED;
    s->settled_at = NAN;
    s->discard = span->from;
    s->until = span->until;
    if (!s->asked)
        return;
    /* Lanes observe contacts with modes from the start. */
    span->states_only = s->discard > 0 && !fst_flow_world(run->flow)->kinds.modes;
    span->from = 0.0;
    span->until = s->discard > 0 ? s->discard : s->until;
    run->window.returns.left_out.state = FST_LEFT_OUT_NEVER;
    fst_closing_begin(&s->returns, run->params->run_rtol);
    fst_cycle_begin(&s->cycle, run->params->run_rtol);
    s->returns.floored = s->cycle.closing.floored = run->model->world.kinds.dry;
}

/* A new window from the flow's time on. */
static void begin_window(fst_watched_run *run, double until)
{
    fst_settling *s = &run->settling;
    fst_window *w = &run->window;
    const fst_span span = {run->flow->t.high, until, w->span.asked_at_end, 0};
    const fst_left_out rule = {
        .rtol = w->returns.left_out.rtol, .limit = w->returns.left_out.limit, .state = FST_LEFT_OUT_NEVER};
    fst_stand_at_end(run->flow);
    fst_window_begin(w, &span, w->period, run->flow);
    w->returns.left_out = rule;
    w->returns.of_cycles = s->as == FST_SETTLED_CYCLE;
    s->periods = s->crossings = 0;
}

/* Something repeats for the first time: from now on the marks need integrals. */
static void begin_integrals(fst_watched_run *run)
{
    fst_returns seen = run->window.returns;
    const int64_t crossings = run->settling.crossings;
    begin_window(run, run->window.span.until);
    fst_marks_begin(&seen.marks);
    seen.crossed = 0;
    run->window.returns = seen;
    run->settling.crossings = crossings;
}

/* Integrals begin anew: what repeats has to be seen again. */
static void forget(fst_settling *s)
{
    fst_cycle_forget(&s->cycle);
    fst_closing_forget(&s->returns);
    s->at_rest = 0;
}

/* How fast the bead was in the last period; where n turns freely, how fast all but n is now. */
static double speed_of_late(const fst_watched_run *run)
{
    return fst_n_is_free(run) ? fst_speed_at_end(run) : run->window.periods.latest.activity;
}

static double noise_of(const fst_watched_run *run)
{
    return fmin(AT_REST * fmax(DEFAULT_RTOL, run->params->run_rtol), MOST_AT_REST);
}

/* Whether the bead stands still at a place that it will leave, or was put down there. */
static int is_repelled(const fst_watched_run *run)
{
    const fst_flow *flow = run->flow;
    if (run->model->world.kinds.dry && !run->settling.has_moved)
        return 1;
    if (run->model->world.kinds.dry && !(fst_contact_slips(flow) && fst_contact_roll(flow) == FST_ROLL_ROLLS))
        return 0;
    return fst_rest_rate(run->model, run->flow->step.end) > GROWS + noise_of(run);
}

/* Whether the bead has stood still for some periods; asked when one has ended. */
static int rests(fst_watched_run *run)
{
    const double speed = speed_of_late(run), noise = noise_of(run);
    const int is_known = run->window.periods.offered > 1, still = is_known && speed < noise;
    run->settling.has_moved |= is_known && speed > fmax(MORE * noise, fmin(FAR * noise, QUICK));
    run->settling.at_rest = still ? run->settling.at_rest + 1 : 0;
    return run->settling.at_rest >= PERIODS_AT_REST && !is_repelled(run);
}

/* A period has ended: is Phi turning? */
static void watch_turning(fst_watched_run *run)
{
    fst_settling *s = &run->settling;
    const fst_returns *r = &run->window.returns;
    const int turns = r->crossings != s->crossings && r->since_break > 2;
    s->crossings = r->crossings;
    s->without_turning = turns ? 0 : s->without_turning + 1;
    /* Without friction no cycle attracts. */
    fst_cycle_watch(&s->cycle, s->without_turning >= PERIODS_WITHOUT_TURNING && fst_is_braked(run));
}

/* What the last step shows the motion to be: its returns or cycles repeat, or it stands still. */
static fst_settled_as recognise(fst_watched_run *run, int period_ended, double *turn)
{
    fst_settling *s = &run->settling;
    fst_window *w = &run->window;
    const fst_returns *r = &w->returns;
    *turn = 0.0;
    if (r->crossed && r->crossings % 2 == 1 && fst_closing_add(&s->returns, &r->crossing, s->until)) {
        *turn = fst_closing_turn(&s->returns);
        s->way = fst_closing_way(&s->returns, s->until);
        return FST_SETTLED_RETURNS;
    }
    if (fst_cycle_step(&s->cycle, &w->quadrature, run->flow) &&
        fst_cycle_settles(&s->cycle, s->until, w->periods.latest.activity)) {
        *turn = fst_closing_turn(&s->cycle.closing);
        s->way = fst_closing_way(&s->cycle.closing, s->until);
        return FST_SETTLED_CYCLE;
    }
    return period_ended && rests(run) ? FST_SETTLED_REST : FST_SETTLED_NOT;
}

/* Whether the motion is still that which was known when the short window began. */
static int still_holds(const fst_watched_run *run)
{
    const fst_settling *s = &run->settling;
    switch (s->as) {
    case FST_SETTLED_RETURNS:
        return fst_returns_are_regular(&run->window.returns, run->flow->t) && fst_closing_holds(&s->returns);
    case FST_SETTLED_CYCLE:
        return fst_closing_holds(&s->cycle.closing);
    default:
        return speed_of_late(run) < STILL_AT_REST * noise_of(run);
    }
}

/* In the short window: 1 if it has ended and the motion is another one, so that the run goes on. */
static int look_at_short_window(fst_watched_run *run)
{
    fst_settling *s = &run->settling;
    fst_window *w = &run->window;
    const fst_returns *r = &w->returns;
    if (s->as == FST_SETTLED_CYCLE && fst_cycle_step(&s->cycle, &w->quadrature, run->flow)) {
        fst_marks_offer(&w->returns.marks, &s->cycle.latest);
        fst_closing_go_on(&s->cycle.closing, s->cycle.latest.full_distance);
    }
    if (s->as == FST_SETTLED_RETURNS && r->crossed && r->crossings % 2 == 1)
        fst_closing_go_on(&s->returns, r->crossing.full_distance);
    if (run->flow->t.high < w->span.until || still_holds(run))
        return 0;
    s->as = FST_SETTLED_NOT;
    s->settled_at = NAN;
    forget(s);
    begin_window(run, run->flow->t.high < s->discard ? s->discard : s->until);
    return 1;
}

/* The motion is not known yet: 1 if a new window begins, with integrals, or at the end of the discard. */
static int look_further(fst_watched_run *run, int period_ended)
{
    fst_settling *s = &run->settling;
    fst_window *w = &run->window;
    const double now = run->flow->t.high;
    w->returns.need_whole = fst_closing_needs_integrals(&s->returns);
    if (period_ended) {
        s->periods = w->periods.offered;
        watch_turning(run);
    }
    if (w->span.from < s->discard && now >= s->discard) {
        forget(s);
        begin_window(run, s->until);
        return 1;
    }
    if (!w->span.states_only || !(w->returns.need_whole || fst_cycle_needs_integrals(&s->cycle)))
        return 0;
    begin_integrals(run);
    return 1;
}

int fst_settling_look(fst_watched_run *run)
{
    fst_settling *s = &run->settling;
    const double now = run->flow->t.high;
    if (!s->asked || run->end.happened)
        return 0;
    if (s->as != FST_SETTLED_NOT)
        return look_at_short_window(run);
    if (now >= s->until)
        return 0;
    double turn;
    const int period_ended = run->window.periods.offered != s->periods;
    const fst_settled_as as = recognise(run, period_ended, &turn);
    const double lasts = fmax(LEAST_PERIODS * run->window.period, LEAST_TURNS * turn);
    if (as == FST_SETTLED_NOT || !(lasts < WORTHWHILE * (s->until - now)))
        return look_further(run, period_ended);
    s->as = as;
    s->settled_at = now / run->window.period;
    begin_window(run, now + lasts);
    return 1;
}

void fst_settling_widen_errors(const fst_watched_run *run, fst_run_result *result)
{
    const fst_settled_as as = run->settling.as;
    /* A bead at rest may still swing about the place by its speed over the frequency. */
    const double way = as == FST_SETTLED_REST ? speed_of_late(run) / result->omega : run->settling.way;
    if (as == FST_SETTLED_NOT)
        return;
    result->mean_r_error = fmax(result->mean_r_error, way);
    result->mean_nz_error = fmax(result->mean_nz_error, way);
    if (as == FST_SETTLED_REST && fst_n_is_free(run)) /* n goes on turning, more slowly than the window shows */
        result->mean_nz_error = fmax(result->mean_nz_error, 1.0 - fabs(result->mean_nz));
    result->mean_alpha_dot_error = fmax(result->mean_alpha_dot_error, way * result->omega);
}

int fst_settling_seeks_extremes(const fst_watched_run *run)
{
    const fst_settling *s = &run->settling;
    return s->as != FST_SETTLED_NOT || run->window.span.from >= s->discard;
}

int fst_settling_needs_integrals(const fst_watched_run *run)
{
    return run->settling.asked && fst_cycle_needs_integrals(&run->settling.cycle);
}

int fst_settling_is_sound(const fst_settling *s)
{
    return s->cycle.seen >= 0 && s->cycle.seen <= FST_CYCLE_MAXIMA && s->cycle.since >= -1 &&
           s->cycle.since < FST_CYCLE_MAXIMA && s->returns.count >= 0 && s->cycle.closing.count >= 0 &&
           s->returns.known >= 0 && s->returns.known <= FST_CLOSING_PAST + 1 && s->cycle.closing.known >= 0 &&
           s->cycle.closing.known <= FST_CLOSING_PAST + 1 && (unsigned)s->as <= FST_SETTLED_REST;
}
