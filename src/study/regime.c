/* regime.c - locked, librating, counter-rotating, corotating, chaotic, or undecided.
 *
 * The questions are asked in this order, and the first answer stands; docs/regimes.md gives the reasons.
 *
 *     does the bead stand still at the end?          -> locked (unless the speed grows: undecided)
 *     is it known to repeat in cycles (settle.h)?    -> librating
 *     does Phi turn regularly?                       decide_turning()
 *         do the means still drift?                      -> undecided
 *         do half or whole returns close?                -> counter-rotating or corotating, S2 or S1
 *         are they still closing?                        -> the same, without a symmetry
 *         else decide_open(): is it chaotic?             -> chaotic
 *                             could a drift hide?        -> undecided
 *                             else                       -> counter-rotating or corotating, not closed
 *     does Phi stay within a turn?                   decide_bounded()
 *         is it only noise, or dying out?                -> locked, or undecided
 *         do the means still drift?                      -> undecided
 *         is it chaotic?                                 -> chaotic
 *         else                                           -> librating
 *     Phi turns irregularly: is it chaotic?          -> chaotic, else undecided
 *
 * "Is it chaotic?" needs the largest Lyapunov exponent.  Where nobody has computed it yet, the decision is put
 * off: the caller gets it (conclude.h), and asks again.
 */
#include "study/regime.h"

#include <stdio.h>
#include <string.h>

#include "base/constants.h"
#include "observe/means.h"
#include "study/drift.h"

/* Thresholds, scaled.  docs/regimes.md says why these. */
static const double AT_REST = 1e-8; /* greatest |d(state)/dt| of a locked bead, or run.rtol if larger */
static const double STILL = 50.0;   /* times run.rtol: n within this of rest is at rest */
static const double KEPT = 1e-9;    /* Phi within this, or within run.rtol, keeps its place */
/* Times run.rtol: slower motion, or a smaller difference of half returns, is not told from the integrator's
 * noise. */
static const double NOISE = 100.0;
/* A looser run.rtol has noise as fast as librations are: what it hides is not decided. */
static const double LOOSEST = 1e-4;
/* Times run.rtol: slower motion that grows comes from the errors of the steps. */
static const double LEAVING = 10.0;
/* Activity of a third of the window over the one before: above this, twice in a row, it grows. */
static const double GROWING = 2.0;
static const double CLOSED = 1e-6;   /* greatest distance of successive section states of a closed orbit */
static const double STEADY = 0.01;   /* relative change of the half distance over half the window: S1 */
static const double RELAXING = 1e-2; /* below this, distances that halve over half the window are relaxing */
static const double STILL_FALLING = 0.95; /* activity of the last half over the first: below, it dies out */
static const double SMALL = 1e-6;         /* range of Phi whose growth is seen in the speed alone */
static const double WIDE = 0.3;           /* range of Phi of a wide libration */
static const double GROWTH = 10.0;        /* exponent times duration: e^10 of growth is chaos */
static const double QUIET = 2.0;          /* the same: below e^2 of growth a motion with friction is regular */
/* The same without friction: neighbours on tori part like a power of time, by e^2.4 for the first. */
static const double QUIET_WITHOUT_FRICTION = 4.0;
static const double SIGNIFICANT = 3.0; /* exponent over the part of its error that is chance */
static const double ONE_WAY = 2.5;     /* |<alpha'>| over its error: below, the bead circles neither way */
enum {
    LEAST_PERIODS = 4,                   /* whole drive periods without which nothing is decided */
    LEAST_OPEN_CROSSINGS = 64,           /* the same, where the orbit does not close */
    LEAST_PERIODS_WITHOUT_FRICTION = 100 /* without friction, for a wide libration and for chaos */
};

int fst_is_braked(const fst_watched_run *run)
{
    const fst_world_double *c = fst_flow_world(run->flow);
    if (!c->kinds.dry)
        return fst_kinds_brake(&c->kinds);
    return c->resistance.arm > 0 || !fst_never_slips(&run->window, &run->window.periods);
}

#define REASON(...) (void)snprintf(result->reason, sizeof result->reason, __VA_ARGS__)

/* What the exponent says: neighbours part exponentially, they do not, the window is too short to say, or
 * nobody has computed it yet. */
typedef enum { REGULAR, UNCLEAR, CHAOTIC, NOT_KNOWN } chaos;

/* Whether the regime is decided, or has to wait for the exponent. */
typedef enum { DECIDED, NEEDS_EXPONENT } decision;

/* Chaotic if the exponent across the flow is positive beyond its error: the regime is set then, and the reason
 * too where it cannot be told. */
static chaos test_chaos(const fst_watched_run *run, const fst_exponent *known, fst_run_result *result)
{
    if (!known)
        return NOT_KNOWN;
    if (known->unknown) {
        REASON("regular or chaotic cannot be told: how neighbours of a bead move that a disc of contact holds, "
               "is not "
               "known to this program");
        return UNCLEAR;
    }
    const double exponent = known->value, standard_error = known->standard_error;
    result->rhs_calls += known->rhs_calls;
    result->largest_exponent = exponent;
    result->largest_exponent_error = standard_error;
    const int friction = fst_is_braked(run);
    const double growth = exponent * known->duration;
    const double quiet = friction ? QUIET : QUIET_WITHOUT_FRICTION;
    chaos found = exponent > SIGNIFICANT * known->chance && growth > GROWTH ? CHAOTIC
                  : growth > quiet                                          ? UNCLEAR
                                                                            : REGULAR;
    if (found != REGULAR && result->mean_r == 0.0) {
        found = UNCLEAR;
        REASON("the bead stays on the axis, which beads beside it leave: neighbours part by e^%.2g over the "
               "window, and whether the moment alone moves regularly is not told by them",
               growth);
    } else if (found == CHAOTIC && !friction && run->window.periods.offered <= LEAST_PERIODS_WITHOUT_FRICTION) {
        REASON("chaotic over the window (exponent %.4g +- %.2g), but without friction nothing holds the bead: "
               "run longer",
               exponent, standard_error);
    } else if (found == CHAOTIC) {
        result->regime = FST_REGIME_CHAOTIC;
        REASON("the largest Lyapunov exponent is positive over the window: %.4g +- %.2g", exponent,
               standard_error);
    } else if (found == UNCLEAR) {
        REASON("regular or chaotic cannot be told yet: the Lyapunov exponent across the flow is %.3g +- %.2g, "
               "so that "
               "neighbours parted by e^%.2g over the window; run longer",
               exponent, standard_error, growth);
    }
    return found;
}

/* Phi turns regularly: with, against, or - where <alpha'> does not stand out of its error - neither. */
static void set_direction(fst_run_result *result)
{
    const double error = isnan(result->mean_alpha_dot_error) ? 0.0 : result->mean_alpha_dot_error;
    if (fabs(result->mean_alpha_dot) <= ONE_WAY * error + 1e-9 * result->omega)
        REASON("Phi turns, but the bead circles neither way: <alpha'> = %.2g +- %.2g", result->mean_alpha_dot,
               error);
    else
        result->regime = result->mean_alpha_dot < 0 ? FST_REGIME_COUNTER_ROTATING : FST_REGIME_COROTATING;
}

/* The distances of successive returns fall from mark to mark over the second half of the window. */
static int is_closing(const fst_mark_series *marks)
{
    const int from = marks->count / 2;
    for (int i = from; i + 1 < marks->count; ++i)
        if (!(marks->kept[i + 1].full_distance < marks->kept[i].full_distance))
            return 0;
    return marks->count - from >= 4;
}

/* The returns of the window's last quarter all come close; a single one may do so by chance. */
static int stays_close(const fst_mark_series *marks)
{
    const int from = marks->count - (marks->count + 3) / 4;
    for (int i = from; i < marks->count; ++i)
        if (!(marks->kept[i].full_distance < RELAXING))
            return 0;
    return 1;
}

/* The motion goes on to another one: how far its means are from that one's is not known. */
static void tell_no_errors(fst_run_result *result)
{
    result->mean_r_error = result->mean_nz_error = result->mean_alpha_dot_error = NAN;
}

/* A mean drifts beyond its noise: nothing is settled yet. */
static int still_drifts(const fst_watched_run *run, fst_run_result *result)
{
    const fst_drift drift = fst_drift_of(run);
    if (!drift.what)
        return 0;
    REASON("still drifts: %s changed by %.2g +- %.1g over the window of %.4g turns (%.2g a turn, at a mean of "
           "%.4g); "
           "raise run.periods and run.discard, or start nearer to where it goes",
           drift.what, drift.change, drift.noise, drift.turns, drift.change / drift.turns, drift.mean);
    tell_no_errors(result);
    return 1;
}

/* Phi turns regularly on an orbit that does not close: chaotic, regular, or not to be told. */
static decision decide_open(const fst_watched_run *run, const fst_exponent *exponent, double full,
                            fst_run_result *result)
{
    const chaos found = test_chaos(run, exponent, result);
    if (found != REGULAR)
        return found == NOT_KNOWN ? NEEDS_EXPONENT : DECIDED;
    const fst_drift hidden = fst_hidden_drift_of(run);
    if (hidden.what) {
        REASON("may still drift: %s changed by %.2g over the window of %.4g turns (mean %.4g), and varies so "
               "slowly that a drift by %.2g could be in it; raise run.periods and run.discard until the window "
               "holds many swings",
               hidden.what, hidden.change, hidden.turns, hidden.mean, hidden.noise);
        tell_no_errors(result);
        return DECIDED;
    }
    if (!fst_is_braked(run)) {
        REASON(
            "Phi turned regularly %lld times on an orbit that does not close (whole returns differ by %.2g): "
            "without friction nothing holds the bead to such an orbit, and it may leave it at any time",
            (long long)(run->window.returns.crossings / 2), full);
        return DECIDED;
    }
    if (run->window.returns.crossings < LEAST_OPEN_CROSSINGS) {
        REASON("Phi turned regularly %lld times, but the orbit has not closed (whole returns differ by %.2g): "
               "run longer",
               (long long)(run->window.returns.crossings / 2), full);
        return DECIDED;
    }
    REASON("Phi turns regularly on an orbit that does not close in one return (differing by %.2g); exponent "
           "across the flow %.3g +- %.2g, not positive",
           full, result->largest_exponent, result->largest_exponent_error);
    set_direction(result);
    return DECIDED;
}

/* Phi turns regularly: which orbit closes, or is it chaotic, or open? */
static decision decide_turning(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result)
{
    const fst_mark *middle = &run->window.returns.marks.kept[run->window.returns.marks.count / 2];
    const fst_mark *last = &run->window.returns.marks.latest;
    const double half = last->half_distance, full = last->full_distance;
    if (still_drifts(run, result))
        return DECIDED;
    const int magnet_has_s2 = run->model->has_s2; /* without it a half return has no image to compare with */
    if (half < CLOSED && magnet_has_s2) {
        result->symmetry = FST_SYMMETRY_S2;
        REASON("a closed orbit with the symmetry S2: successive half returns differ by %.2g", half);
        set_direction(result);
        return DECIDED;
    }
    if (full < CLOSED && !magnet_has_s2) {
        result->symmetry = FST_SYMMETRY_S1;
        REASON("a closed orbit: successive whole returns differ by %.2g (the magnet is not its own image under "
               "half a turn)",
               full);
        set_direction(result);
        return DECIDED;
    }
    const int half_is_steady = fabs(half - middle->half_distance) <= STEADY * half;
    if (full < CLOSED && half_is_steady && half <= NOISE * run->params->run_rtol) {
        REASON(
            "a closed orbit: successive whole returns differ by %.2g, half returns by %.2g, which may be the "
            "errors of the steps; for the symmetry lower run.rtol",
            full, half);
        set_direction(result);
        return DECIDED;
    }
    if (full < CLOSED && half_is_steady) {
        result->symmetry = FST_SYMMETRY_S1;
        REASON("a closed orbit: successive whole returns differ by %.2g, half returns by %.2g", full, half);
        set_direction(result);
        return DECIDED;
    }
    const int nears = stays_close(&run->window.returns.marks) &&
                      (half < 0.5 * middle->half_distance || full < 0.5 * middle->full_distance ||
                       is_closing(&run->window.returns.marks));
    if (full < CLOSED || (full < RELAXING && nears && !fst_hidden_drift_of(run).what)) {
        REASON("Phi turns regularly and the orbit is still closing: half returns differ by %.2g, in the middle "
               "of the window by %.2g; whole ones by %.2g, %.2g; for the symmetry run longer",
               half, middle->half_distance, full, middle->full_distance);
        set_direction(result);
        return DECIDED;
    }
    return decide_open(run, exponent, full, result);
}

/* Greatest activity over the marks [from, to[. */
static double activity_over(const fst_mark_series *marks, int from, int to)
{
    double greatest = 0.0;
    for (int i = from; i < to; ++i)
        greatest = marks->kept[i].activity > greatest ? marks->kept[i].activity : greatest;
    return greatest;
}

/* The activity grows from third to third of the window.  Noise has single peaks, forty times as high as the
 * rest: two halves would not show whether they grow. */
static int grows(const fst_mark_series *marks)
{
    const int third = (marks->count - 1) / 3;
    const double a = activity_over(marks, 1, 1 + third), b = activity_over(marks, 1 + third, 1 + 2 * third),
                 c = activity_over(marks, marks->count - third, marks->count);
    return third > 0 && b > GROWING * a && c > GROWING * b;
}

/* The speed below which rest and noise look alike: the integrator's noise, or, while the bead keeps its place,
 * the speed that the torque of a strong magnet makes of the errors of n. */
static double noise_of(const fst_watched_run *run)
{
    const fst_world_double *c = fst_flow_world(run->flow);
    const double of_steps = NOISE * run->params->run_rtol;
    if (run->window.greatest_bead_angle - run->window.least_bead_angle > fmax(KEPT, run->params->run_rtol))
        return of_steps;
    fst_pull_double p;
    fst_magnetic_pull_double(c, fst_flow_modes(run->flow), run->flow->step.end, &p);
    const double b = sqrt(p.b[0] * p.b[0] + p.b[1] * p.b[1] + p.b[2] * p.b[2]);
    return fmax(of_steps, STILL * run->params->run_rtol * (c->torque * fabs(p.strength) * b));
}

/* Phi stays within one turn: librating, chaotic, or dying out towards a locked state. */
static decision decide_bounded(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result)
{
    const fst_mark_series *marks = &run->window.periods;
    const int half = 1 + (marks->count - 1) / 2;
    const double early = activity_over(marks, 1, half), late = activity_over(marks, half, marks->count);
    const double noise = noise_of(run);
    /* At an equilibrium the step size grows until the error of a step is the tolerance, and the state jitters.
     */
    if (late < noise && !grows(marks) && run->params->run_rtol > LOOSEST) {
        REASON("at rest or librating cannot be told at this accuracy: errors of the steps move the bead by up "
               "to %.2g, and "
               "|d(state)/dt| stays below %.2g; take run.rtol <= %g",
               noise, late, LOOSEST);
        tell_no_errors(result);
        return DECIDED;
    }
    if (late < noise && !grows(marks)) {
        result->regime = FST_REGIME_LOCKED;
        REASON("at rest in the turning frame to within the integrator's noise: |d(state)/dt| stays below %.2g, "
               "that is %.2g run.rtol, and does not grow",
               late, late / run->params->run_rtol);
        return DECIDED;
    }
    if (late < STILL_FALLING * early) {
        REASON("Phi is bounded and the motion is dying out (speed in the turning frame from %.2g to %.2g): run "
               "longer to see whether it locks",
               early, late);
        tell_no_errors(result);
        return DECIDED;
    }
    if (late >= noise && still_drifts(run, result))
        return DECIDED;
    const int small = run->window.greatest_bead_angle - run->window.least_bead_angle < SMALL;
    if (late < noise || (small && fst_speed_grows(run))) {
        REASON("the motion is hardly faster than the integrator's noise but grows (speed in the turning frame "
               "from "
               "%.2g "
               "to %.2g): run longer, or lower run.rtol",
               early, late);
        tell_no_errors(result);
        return DECIDED;
    }
    const chaos found = test_chaos(run, exponent, result);
    if (found != REGULAR)
        return found == NOT_KNOWN ? NEEDS_EXPONENT : DECIDED;
    const int friction = fst_is_braked(run);
    if (!friction && run->window.greatest_bead_angle - run->window.least_bead_angle > WIDE &&
        marks->offered <= LEAST_PERIODS_WITHOUT_FRICTION) {
        REASON("Phi stays within %.4g rad, but nothing damps so wide a motion, which may turn out chaotic: run "
               "longer",
               run->window.greatest_bead_angle - run->window.least_bead_angle);
        return DECIDED;
    }
    result->regime = FST_REGIME_LIBRATING;
    REASON("Phi stays within %.4g rad and the motion does not die out",
           run->window.greatest_bead_angle - run->window.least_bead_angle);
    return DECIDED;
}

int fst_n_is_free(const fst_watched_run *run)
{
    const fst_world_double *c = fst_flow_world(run->flow);
    return c->hard == 0.0 && c->twice_b == 0.0;
}

double fst_speed_at_end(const fst_watched_run *run)
{
    const int n_is_free = fst_n_is_free(run);
    double speed = 0.0, slope[FST_STATE_SIZE];
    fst_flow_slope(run->flow, slope);
    for (int i = 0; i < FST_STATE_SIZE; ++i) {
        const double component = fabs(slope[i]);
        if (component > speed && !(n_is_free && i >= FST_NX && i <= FST_NZ))
            speed = component;
    }
    return speed;
}

/* The motion swings, and each cycle repeats the one before: that is regular without an exponent. */
static decision decide_cycle(const fst_watched_run *run, fst_run_result *result)
{
    const fst_mark_series *cycles = &run->window.returns.marks;
    const double turns = fst_twofold_difference(cycles->latest.t, cycles->kept[0].t) / run->window.period;
    result->regime = FST_REGIME_LIBRATING;
    REASON("Phi stays within %.4g rad and the motion repeats itself every %.4g turns of the magnet: successive "
           "cycles differ by %.2g",
           run->window.greatest_bead_angle - run->window.least_bead_angle,
           turns / (double)(cycles->offered - 1), cycles->latest.full_distance);
    return DECIDED;
}

static decision decide(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result)
{
    result->regime = FST_REGIME_UNDECIDED;
    if (run->window.periods.offered <= LEAST_PERIODS) {
        REASON("too short: nothing is decided on less than %d whole drive periods after the discard",
               LEAST_PERIODS);
        return DECIDED;
    }
    const double speed = fst_speed_at_end(run), at_rest = fmax(AT_REST, run->params->run_rtol);
    const fst_mark_series *marks = &run->window.periods;
    const double lately = activity_over(marks, 1 + (marks->count - 1) / 2, marks->count);
    if (speed < at_rest && lately > LEAVING * run->params->run_rtol && fst_speed_grows(run)) {
        REASON("nearly at rest in the turning frame (|d(state)/dt| = %.2g), but that grows: the bead may be "
               "leaving an unstable state; run longer",
               speed);
        tell_no_errors(result);
        return DECIDED;
    }
    if (speed < at_rest) {
        const fst_drift approach = fst_drift_of(run);
        result->regime = FST_REGIME_LOCKED;
        if (approach.what)
            REASON("at rest in the turning frame: |d(state)/dt| = %.2g; the means still take in the approach: "
                   "raise "
                   "run.discard",
                   speed);
        else
            REASON("at rest in the turning frame: |d(state)/dt| = %.2g", speed);
        return DECIDED;
    }
    if (run->window.returns.of_cycles)
        return decide_cycle(run, result);
    if (fst_returns_are_regular(&run->window.returns, run->flow->t))
        return decide_turning(run, exponent, result);
    if (run->window.greatest_bead_angle - run->window.least_bead_angle < FST_TWO_PI)
        return decide_bounded(run, exponent, result);
    if (still_drifts(run, result))
        return DECIDED;
    const chaos found = test_chaos(run, exponent, result);
    if (found == REGULAR)
        REASON("Phi turns irregularly (%lld crossings of the section), but the exponent %.3g +- %.2g is not "
               "positive "
               "beyond its error: run longer",
               (long long)run->window.returns.crossings, result->largest_exponent,
               result->largest_exponent_error);
    return found == NOT_KNOWN ? NEEDS_EXPONENT : DECIDED;
}

int fst_decide_regime(const fst_watched_run *run, const fst_exponent *exponent, fst_run_result *result)
{
    return decide(run, exponent, result) == DECIDED;
}
