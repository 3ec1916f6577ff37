/* search.c - the orbit to which a start leads: integrate until returns come close, then Newton's method.
 *
 *     start --> integrate --> do two returns differ by little? --yes--> Newton --> is it the orbit that
 *                  ^                      | no                                     the bead approaches?
 *                  |                      |                                         | no         | yes
 *                  '----------------------+-----------------------------------------'           found
 *
 * Two kinds of returns are watched.  A bead that turns regularly passes X = 0 on alternating sides; its states
 * there are compared after half a turn (with the image under S2, if the field has that symmetry) and after a
 * whole one.  A bead that librates has no such regular passages; its latest state where r is greatest is
 * compared with earlier ones.
 *
 * Newton's method finds orbits that repel too, and orbits on which the bead is not.  So its orbit counts only
 * if it attracts, and lies as near to the bead as the returns say: a bead at distance d from an orbit of
 * greatest multiplier rho moves by (1 - rho) d in a return.  Tries are dear, and become rarer with time.
 *
 * Other ends: the bead flies away (r > 50), it comes to rest at an equilibrium that attracts, or the time is
 * over.  A bead that leaves an equilibrium very slowly is helped by departure.c.
 */
#include "orbit/search.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/constants.h"
#include "base/error.h"
#include "observe/marks.h"
#include "ode/flight.h"
#include "ode/neighbours.h"
#include "orbit/describe.h"
#include "study/conclude.h"

#define SEARCH_TOLERANCE 1e-8 /* of the way to the orbit, which Newton's method then finds exactly */

/* A slower bead is taken for one at rest: the errors of the steps leave it no slower. */
#define REST (10.0 * SEARCH_TOLERANCE)

enum { PEAKS = 48, RECENT = 20 /* drive periods */, RETURNS = 8 /* after which a motion is seen to close */ };

/* A trajectory that is watched for returns. */
typedef struct search {
    const fst_family *family; /* with no free parameter */
    fst_model *model;
    fst_flow *flow;
    /* The latest passages of X = 0, on the side Y > 0 (images under S2); where the magnet has not that symmetry, on
     * either side. */
    double section[2 * RETURNS + 1][FST_STATE_SIZE];
    double section_time[3];
    int section_is_image; /* the latest is one: the bead was on the side Y < 0 */
    int in_the_air;       /* the bead flew over X = 0, and the state is that of its landing instead */
    int comes_down;       /* from such a flight, to land soon */
    int passages;         /* since the turning was last irregular */
    int peaks_since;      /* the latest passage: a bead that turns has one or two to a half turn */
    int last_half;
    double peak[PEAKS][FST_STATE_SIZE]; /* the latest places where r was greatest */
    double peak_time[PEAKS];
    int peaks;
    double half_distance, full_distance; /* of the latest returns */
    double drive_period;
    int attempts;
    int at_rest; /* the latest guess ended at an equilibrium that attracts */
    int leaves;  /* ... at one that does not: the bead is leaving it, or will */
    int tried_departure;
    double slipped;              /* the time at which a contact that can stick last slipped */
    double unfollowed;           /* the time at which neighbours of the bead were last not known */
    double rest[FST_STATE_SIZE]; /* that equilibrium */
    fst_orbit_outcome outcome;
} search;

/* The equilibrium that Newton's method finds from a state; 1 if it attracts. */
static int attracts(const search *s, const double *near, fst_solution *rest)
{
    fst_error ignored;
    memset(rest, 0, sizeof *rest);
    memcpy(rest->y[0], near, sizeof rest->y[0]);
    return fst_solution_correct(s->family, rest, NULL, &ignored) == FST_OK &&
           fst_solution_spectrum(s->family, rest, &ignored) == FST_OK && fst_solution_is_stable(rest);
}

/* Whether the bead comes to rest: an equilibrium that attracts lies near a state where the search stands, and
 * the swings about it decay. */
static int comes_to_rest(const search *s, const double *near)
{
    const int kept = s->peaks < PEAKS ? s->peaks : PEAKS;
    fst_solution rest;
    if (kept < 2 || !attracts(s, near, &rest))
        return 0;
    const double first = fst_state_distance(s->peak[(s->peaks - kept) % PEAKS], rest.y[0]);
    const double last = fst_state_distance(s->peak[(s->peaks - 1) % PEAKS], rest.y[0]);
    return last < first && last < 0.1;
}

/* Nearer than this to the circle a multiplier does not tell an orbit without the symmetry from the symmetric
 * one on which it was born: their distance, of the order of the root of this, is lost in Newton's residual. */
#define RESOLVED 1e-7

static double greatest_multiplier(const fst_solution *s)
{
    double greatest = 0.0;
    for (int i = 0; i < s->multipliers; ++i)
        greatest = fmax(greatest, hypot(s->re[i], s->im[i]));
    return greatest;
}

/* Newton's method, which converges slowly beside a point where orbits meet: every iteration takes a third of
 * the distance.  It is tried on as long as the residual falls. */
static fst_status correct(search *s, fst_solution *guess, fst_error *error)
{
    double before = INFINITY;
    fst_status status;
    for (int i = 0; i < 4; ++i) {
        status = fst_solution_correct(s->family, guess, NULL, error);
        if (status != FST_NO_CONVERGENCE || !(guess->residual < 1e-6 && guess->residual < 0.1 * before))
            break;
        before = guess->residual;
    }
    return status;
}

/* Newton's method from a guess.  The orbit is the one that the bead approaches if it attracts, and if the bead
 * is as far from it as its last return `gap` says: a return moves the bead by (1 - rho) of its distance, rho
 * being the greatest multiplier. */
static int polish(search *s, fst_solution *guess, double gap, fst_error *error)
{
    double start[FST_STATE_SIZE];
    const double period = guess->period;
    s->attempts += 1;
    s->at_rest = s->leaves = 0;
    if (fst_solution_keep_to_plate(s->family, guess, error) != FST_OK)
        return 0;
    memcpy(start, guess->y[0], sizeof start);
    if (fst_solution_chain(s->family, guess, guess->symmetric ? 1 : 2, error) != FST_OK ||
        correct(s, guess, error) != FST_OK || fst_solution_spectrum(s->family, guess, error) != FST_OK)
        return 0;
    if (!fst_solution_moves(s->family, guess)) { /* equilibria solve the equations of orbits, with any period */
        s->at_rest = comes_to_rest(s, guess->y[0]);
        s->leaves = !s->at_rest;
        memcpy(s->rest, guess->y[0], sizeof s->rest);
        return 0;
    }
    if (!fst_solution_is_stable(guess))
        return 0;
    return fst_state_distance(start, guess->y[0]) <= 6.0 * gap / (1.0 - greatest_multiplier(guess)) + 1e-7 &&
           fabs(guess->period / period - 1.0) < 0.1;
}

/* An S1 orbit whose halves are alike may be an S2 orbit seen by the full map. */
static void prefer_symmetric(search *s, fst_solution *orbit)
{
    fst_solution half = *orbit;
    fst_error ignored;
    fst_apply_s2(orbit->y[1], half.y[1]);
    const double gap = fst_state_distance(half.y[1], orbit->y[0]);
    half.symmetric = 1;
    half.period = 0.5 * orbit->period;
    if (gap < 0.01 && polish(s, &half, gap, &ignored))
        *orbit = half;
}

/* Of two conjugate orbits, each the image of the other under S2, the one on which the bead is. */
static void choose_conjugate(const search *s, fst_solution *orbit)
{
    for (int i = 0; i < orbit->segments && !orbit->symmetric && s->section_is_image; ++i)
        fst_apply_s2(orbit->y[i], orbit->y[i]);
}

static int try_turning(search *s, fst_solution *out, fst_error *error)
{
    for (int symmetric = s->model->has_s2; symmetric >= 0; --symmetric) {
        /* Towards a symmetric orbit the half map often alternates, and whole returns look closer than half
         * ones. */
        const double gap = symmetric ? s->half_distance : s->full_distance;
        if (!(gap < (symmetric ? 0.1 : 0.05)))
            continue;
        memset(out, 0, sizeof *out);
        out->symmetric = symmetric;
        out->on_section = !s->in_the_air;
        memcpy(out->y[0], s->section[0], sizeof out->y[0]);
        if (out->on_section)
            out->y[0][FST_X] = 0.0;
        out->period = s->section_time[0] - s->section_time[symmetric ? 1 : 2];
        if (polish(s, out, gap, error)) {
            if (!symmetric && s->model->has_s2)
                prefer_symmetric(s, out);
            if (!out->symmetric && 1.0 - greatest_multiplier(out) < RESOLVED)
                continue;
            choose_conjugate(s, out);
            return 1;
        }
    }
    return 0;
}

/* A libration: the latest peak of r against earlier ones. */
static int try_librating(search *s, fst_solution *out, fst_error *error)
{
    const int last = (s->peaks - 1) % PEAKS;
    for (int back = 1; back < PEAKS && back < s->peaks; ++back) {
        const int earlier = (s->peaks - 1 - back) % PEAKS;
        const double gap = fst_state_distance(s->peak[last], s->peak[earlier]);
        if (!(gap < 0.02))
            continue;
        memset(out, 0, sizeof *out);
        memcpy(out->y[0], s->peak[last], sizeof out->y[0]);
        out->period = s->peak_time[last] - s->peak_time[earlier];
        return polish(s, out, gap, error);
    }
    return 0;
}

/* A libration about an equilibrium that the bead leaves too slowly to wait for. */
static int try_departure(search *s, fst_solution *out, fst_error *error)
{
    const double close = 1e-3;
    const double *latest = s->peak[(s->peaks - 1) % PEAKS];
    double gap;
    if (!s->leaves || s->tried_departure || !(fst_state_distance(latest, s->rest) < close))
        return 0;
    s->tried_departure = 1;
    return fst_departure_guess(s->family, latest, 4.0 * close, out, &gap) && polish(s, out, gap, error);
}

/* A passage on the side `half`, at the state y and the time t; 1 if it completes a regular turn. */
static int take_passage(search *s, int half, double y[FST_STATE_SIZE], double t)
{
    s->section_is_image = half < 0 && s->model->has_s2;
    if (s->section_is_image)
        fst_apply_s2(y, y);
    memmove(s->section[1], s->section[0], 2 * RETURNS * sizeof s->section[0]);
    memmove(s->section_time + 1, s->section_time, 2 * sizeof s->section_time[0]);
    memcpy(s->section[0], y, FST_STATE_SIZE * sizeof *y);
    s->section_time[0] = t;
    s->half_distance =
        s->passages > 1 && s->model->has_s2 ? fst_state_distance(s->section[0], s->section[1]) : INFINITY;
    s->full_distance = s->passages > 2 ? fst_state_distance(s->section[0], s->section[2]) : INFINITY;
    return s->passages > 3;
}

/* The passage of X = 0 in the last step, or the landing after one in the air. */
static int note_passage(search *s)
{
    const double *start = s->flow->step.y, *end = s->flow->step.end;
    double y[FST_STATE_SIZE];
    if (s->comes_down && !fst_flight_is_on(s->flow)) {
        const int half = s->comes_down;
        s->comes_down = 0;
        memcpy(y, start, sizeof y);
        return take_passage(s, half, y, s->flow->t_start.high);
    }
    if ((start[FST_X] < 0) == (end[FST_X] < 0))
        return 0;
    const double x = start[FST_X] == 0.0
                         ? 0.0
                         : fst_flow_locate(s->flow, fst_section_function, 0.0, 1.0, start[FST_X], end[FST_X]);
    fst_flow_at(s->flow, x, y);
    const int half = y[FST_Y] > 0 ? 1 : -1, downward = (end[FST_X] >= 0) == (half > 0);
    s->peaks_since = 0;
    s->passages = downward && half != s->last_half ? s->passages + 1 : 1;
    s->last_half = downward ? half : 0;
    s->in_the_air = fst_flight_is_on(s->flow);
    if (s->in_the_air) {
        s->comes_down = half;
        return 0;
    }
    return take_passage(s, half, y, fst_flow_time(s->flow, x).high);
}

static int note_peak(search *s)
{
    const double before = fst_radial_function(s->flow, s->flow->step.y, NULL);
    const double after = fst_radial_function(s->flow, s->flow->step.end, NULL);
    if (!(before > 0 && after <= 0) || fst_flight_is_on(s->flow))
        return 0;
    const double x = fst_flow_locate(s->flow, fst_radial_function, 0.0, 1.0, before, after);
    fst_flow_at(s->flow, x, s->peak[s->peaks % PEAKS]);
    s->peak_time[s->peaks % PEAKS] = fst_flow_time(s->flow, x).high;
    s->peaks += 1;
    if (++s->peaks_since >= 4) { /* it turned for a while, and was caught */
        s->passages = s->last_half = 0;
        s->half_distance = s->full_distance = INFINITY;
    }
    return s->peaks > 2;
}

/* At rest, and not just passing an equilibrium from which it will depart slowly. */
static int is_locked(const search *s)
{
    fst_solution rest;
    if (fst_sticks_double(fst_flow_world(s->flow), fst_flow_modes(s->flow)) > 0.5)
        return fst_flow_speed(s->flow) < REST; /* a contact at rest keeps what it has */
    return fst_flow_speed(s->flow) < REST && attracts(s, s->flow->step.end, &rest);
}

/* What to try where there is no orbit to be found. */
static const char *advice(fst_orbit_outcome outcome)
{
    if (outcome == FST_ORBIT_ROLLS)
        return "Try another start, or friction.rolling_resistance, which selects";
    if (outcome == FST_ORBIT_SEVERAL)
        return "fst_branch_follow() follows those born where the period doubles, if the range reaches to where "
               "one return closes";
    return outcome == FST_ORBIT_UNSETTLED
               ? "Try a longer run.periods or another start; fst_lyapunov_find() tells whether the motion is "
                 "chaotic"
               : "Try another start.r, start.phi or omega; fst_locked_find() lists the states in which the "
                 "bead "
                 "follows the magnet";
}

static fst_status went_elsewhere(search *s, fst_orbit_outcome outcome, fst_error *error)
{
    const double *y = s->flow->step.end;
    s->outcome = outcome;
    return fst_fail(error, FST_NO_CONVERGENCE, "orbit",
                    "from this start the bead %s at omega = %.10g (after %.4g drive periods, at r = %.6g, "
                    "Phi = %.6g degrees): there is no orbit to polish",
                    outcome != FST_ORBIT_EJECTED         ? "locks to the magnet"
                    : isinf(s->model->groups.map_radius) ? "flies away"
                                                         : "leaves the map of magnet.file",
                    s->model->groups.omega, s->flow->t.high / s->drive_period, hypot(y[FST_X], y[FST_Y]),
                    atan2(y[FST_Y], y[FST_X]) * 360.0 / FST_TWO_PI);
}

/* The plate held the bead's disc of contact until lately: Newton's method, which needs neighbours, is of no use. */
static fst_status not_followed(search *s, fst_error *error)
{
    return fst_fail(
        error, FST_NO_CONVERGENCE, "orbit",
        "the plate holds the bead's disc of contact (the last time after %.4g drive periods at omega = %.10g), "
        "and neighbours of a bead, which Newton's method and multipliers need, are not followed through that. "
        "Try another start; run tells whether the motion repeats itself (period)",
        s->unfollowed / s->drive_period, s->model->groups.omega);
}

/* After how many returns the motion repeats, where it does after several only; 0: it does not. */
static int closes_after(const search *s)
{
    for (int k = 2; k <= RETURNS && s->passages > 2 * k; ++k)
        if (fst_state_distance(s->section[0], s->section[2 * k]) < 1e-3 * s->full_distance)
            return k;
    return 0;
}

static fst_status never_settled(search *s, double t_end, fst_error *error)
{
    char motion[120];
    const int returns = closes_after(s);
    s->outcome = returns ? FST_ORBIT_SEVERAL : FST_ORBIT_UNSETTLED;
    if (returns)
        return fst_fail(
            error, FST_NO_CONVERGENCE, "orbit",
            "the bead settled within %.6g drive periods at omega = %.10g on an orbit that closes after %d "
            "returns (to %.2g; single ones differ by %.3g), and only orbits of one return are looked for",
            t_end / s->drive_period, s->model->groups.omega, returns,
            fst_state_distance(s->section[0], s->section[2 * returns]), s->full_distance);
    if (isfinite(s->full_distance))
        (void)snprintf(motion, sizeof motion, "its last returns differ by %.3g (half turns: %.3g)",
                       s->full_distance, s->half_distance);
    else
        (void)snprintf(motion, sizeof motion,
                       "at the end it did not turn regularly (speed in the turning frame: %.3g)",
                       fst_flow_speed(s->flow));
    return fst_fail(
        error, FST_NO_CONVERGENCE, "orbit",
        "the bead settled on no stable orbit within %.6g drive periods at omega = %.10g: %s, and Newton's "
        "method was tried %d times",
        t_end / s->drive_period, s->model->groups.omega, motion, s->attempts);
}

/* Dry friction: whether the contact has not slipped for a while.  Then nothing damps the motion (unless the
 * plate resists rolling), so that it approaches no orbit, and Newton's method has none to find: orbits of
 * rolling beads come in continua. */
static int only_rolls(search *s)
{
    const fst_world_double *c = fst_flow_world(s->flow);
    if (!c->kinds.dry || c->resistance.arm > 0.0)
        return 0;
    if (!(fst_sticks_double(c, fst_flow_modes(s->flow)) > 0.5))
        s->slipped = s->flow->t.high;
    return s->flow->t.high - s->slipped > RECENT * s->drive_period;
}

static fst_status rolls_for_ever(search *s, fst_error *error)
{
    s->outcome = FST_ORBIT_ROLLS;
    return fst_fail(
        error, FST_NO_CONVERGENCE, "orbit",
        "the contact does not slip from %.4g to %.4g drive periods at omega = %.10g: a bead that only "
        "rolls approaches no orbit, and its start decides how it moves",
        s->slipped / s->drive_period, s->flow->t.high / s->drive_period, s->model->groups.omega);
}

static fst_status follow(search *s, double t_end, fst_solution *out, fst_error *error)
{
    int turns = 0, peaks = 0, next_turn = 4, next_peak = 16;
    while (s->flow->t.high < t_end) {
        fst_status status = fst_flow_step(s->flow, t_end, error);
        fst_watch_reach(s->family->watch, s->flow->t.high / t_end);
        if (status == FST_OK)
            status = fst_watch_count(s->family->watch, FST_FLOW_STEP_WORK, error);
        if (status != FST_OK)
            return status;
        const double r = hypot(s->flow->step.end[FST_X], s->flow->step.end[FST_Y]);
        if (r > fmin(50.0, s->model->groups.map_radius))
            return went_elsewhere(s, FST_ORBIT_EJECTED, error);
        fst_error ignored;
        if (!fst_neighbours_known(s->flow))
            s->unfollowed = s->flow->t.high;
        if (only_rolls(s))
            continue;
        if (note_passage(s)) {
            turns += 1;
            if (turns >= next_turn) {
                /* Every try costs as much as a hundred turns: the later, the rarer. */
                next_turn = turns + (turns < 40 ? 4 : turns < 128 ? 32 : turns / 4);
                if (try_turning(s, out, &ignored))
                    return FST_OK;
            }
        }
        if (note_peak(s) && s->passages < 4 && s->flow->t.high > 20.0 * s->drive_period) {
            peaks += 1;
            if (peaks >= next_peak) {
                next_peak = peaks + (peaks < 64 ? 16 : peaks / 4);
                if (is_locked(s))
                    return went_elsewhere(s, FST_ORBIT_LOCKED, error);
                if (try_librating(s, out, &ignored) || try_departure(s, out, &ignored))
                    return FST_OK;
                if (s->at_rest)
                    return went_elsewhere(s, FST_ORBIT_LOCKED, error);
            }
        }
        if (s->flow->accepted % 64 == 0 && is_locked(s))
            return went_elsewhere(s, FST_ORBIT_LOCKED, error);
    }
    const fst_status status = fst_watch_ask(s->family->watch, error);
    if (status != FST_OK)
        return status;
    if (only_rolls(s))
        return rolls_for_ever(s, error);
    return t_end - s->unfollowed < RECENT * s->drive_period ? not_followed(s, error)
                                                            : never_settled(s, t_end, error);
}

fst_status fst_search_orbit(const fst_family *family, fst_solution *out, fst_orbit_outcome *outcome,
                            fst_error *error)
{
    *outcome = FST_ORBIT_FOUND;
    search *s = calloc(1, sizeof *s);
    if (!s)
        return fst_watch_end(family->watch, fst_fail(error, FST_NO_MEMORY, "orbit", "out of memory"), error);
    s->family = family;
    s->half_distance = s->full_distance = INFINITY;
    s->unfollowed = -INFINITY;
    double start[FST_STATE_SIZE];
    fst_model *model = NULL;
    fst_status status = fst_model_new(&family->params, &model, error);
    if (status == FST_OK)
        status = fst_start_state(&family->params, model, start, error);
    if (status == FST_OK)
        status = fst_solution_flow(family, 0.0, start, SEARCH_TOLERANCE, &s->model, &s->flow, error);
    if (status == FST_OK) {
        s->drive_period = fst_drive_period_double(model->groups.omega);
        status = follow(s, fst_run_periods(&family->params) * s->drive_period, out, error);
    }
    *outcome = s->outcome;
    fst_flow_free(s->flow);
    fst_model_free(s->model);
    fst_model_free(model);
    free(s);
    return fst_watch_end(family->watch, status, error);
}

fst_status fst_orbit_find(const fst_params *params, const fst_progress *progress, fst_orbit *orbit,
                          fst_error *error)
{
    fst_family family;
    fst_solution solution;
    fst_watch watch;
    fst_orbit_outcome outcome = FST_ORBIT_FOUND;
    memset(orbit, 0, sizeof *orbit);
    fst_result_clear(&orbit->means);
    fst_watch_begin(&watch, progress);
    fst_status status = fst_family_begin(&family, params, NULL, error);
    family.watch = &watch;
    if (status == FST_OK)
        status = fst_search_orbit(&family, &solution, &outcome, error);
    if (status == FST_NO_CONVERGENCE && outcome != FST_ORBIT_FOUND && error)
        (void)fst_fail(error, status, error->where, "%s. %s", error->sentence, advice(outcome));
    if (status == FST_OK)
        status = fst_orbit_from_solution(&family, &solution, orbit, error);
    orbit->outcome = status != FST_OK && outcome == FST_ORBIT_FOUND ? FST_ORBIT_UNSETTLED : outcome;
    return status;
}
