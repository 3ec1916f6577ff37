/* contact.c - dry friction along a trajectory: when a contact slips, sticks and lets go.
 *
 * The modes are those of model/contact/coulomb.inl.  A step has one mode, and the next one may have another:
 *
 *              |V| < captured and |A| < (7/2) mu(0) N
 *        +------------------------------------------------+
 *        |                                                v
 *      slip <---- |V| = handed over ---- onset        stick <---+
 *        ^                                 ^  |           |     |
 *        |                                 |  +-- |V| = 0 ------+
 *        |       mu_s = mu(0) ------------ + -------------+
 *        +------ mu_s > mu(0) ----------------------------+   |A| > (7/2) mu_s N
 *
 * Capture.  Two numbers, the components of V, must vanish for a slip to end, and no function of the state
 * changes its sign there: in time, |V| falls to zero like t* - t and its direction turns ever faster towards
 * that of A, so that a method of high order silently becomes one of low order.  In the time theta of the law's
 * pace it falls like exp(-theta) for ever, and the direction turns at a bounded rate: everything is smooth,
 * passes close by V = 0 too.  The slip is over when it is `captured`, a size at which nothing feels the rest.
 *
 *     |V| |\                                  log |V| |\
 *         | \          in time                        | \      in theta
 *         |  `.                                       |  `.
 *         |    `.                                     |    `.
 *         +------*--- stick --> t                     +      `. captured: stick
 *                t*
 *
 * Release.  |A| passes (7/2) mu_s N, a function of the state whose zero is located as other events are; the
 * step is made anew as long as up to there.  If friction is (nearly) as strong in sliding, the slip begins with
 * onset: the slip grows from nothing while its direction is tied to that of A, and is handed over to slip when
 * it is large enough to have a direction of its own.  If friction is weaker in sliding, the slip begins at
 * once, with a tiny speed along A.
 *
 * Sizes follow the tolerance: `captured` is a thousandth of it, and the hand-over goes with its power 5/16, by
 * which the error of onset, (hand-over)^(7/2), shrinks like the tolerance (onset.c).
 *
 */
#include "ode/disc.h"
#include "ode/flight.h"
#include "ode/rest.h"

#include "base/error.h"

static const double HAND_OVER = 0.12;        /* times tolerance^(5/16) */
static const double LEAST_HAND_OVER = 100.0; /* but at least so many captured */
static const double USUAL_GROWTH = 0.1; /* of a slip, in l gamma^3: the time of the hand-over follows from it */
static const double FEW = 0.01;         /* slip then, in those of the hand-over */
static const double FALL_AT_ONCE = 1.01; /* static friction over sliding */
static const double FIRST_SIZE = 0.05;   /* of a step in a mode that was not met before */

/* ------------------------------------------------------------------ the contact at a state */

static fst_coulomb_double *law_of(fst_flow *flow)
{
    return &flow->step.context.coefficients.law.coulomb;
}

static int is_disc(const fst_flow *flow)
{
    return flow->step.context.coefficients.kinds.patch != FST_PATCH_POINT;
}

/* The greatest |A| that static friction takes. */
static double hold(const fst_flow *flow, const fst_contact_double *at)
{
    const fst_coulomb_double *law = &flow->step.context.coefficients.law.coulomb;
    return 3.5 * law->holding * fst_coulomb_load_double(at);
}

/* And the one under which a slip comes to rest. */
static double brake(const fst_flow *flow, const fst_contact_double *at)
{
    const fst_coulomb_double *law = &flow->step.context.coefficients.law.coulomb;
    return 3.5 * fst_coulomb_mu_double(law, 0.0) * fst_coulomb_load_double(at);
}

static double captured(const fst_flow *flow)
{
    return fst_captured_double(flow->rtol);
}

static double handed_over(const fst_flow *flow)
{
    const double quarter = sqrt(sqrt(flow->rtol));
    return HAND_OVER * (quarter * sqrt(sqrt(quarter)));
}

static fst_contact_double contact_at(const fst_flow *flow, const double *state)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    fst_pull_double p;
    fst_magnetic_pull_double(c, state, &p);
    return fst_contact_of_double(c, state, &p);
}

/* ------------------------------------------------------------------ changes of mode */

/* A disc is held, or let go of, at `state`. */
static void hold_disc(const fst_flow *flow, int mode, double *state)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    fst_pull_double p;
    double slip[2] = {0.0, 0.0}, pivot = 0.0;
    fst_magnetic_pull_double(c, state, &p);
    if (mode == FST_MODE_SLIP && fst_contact_mode(flow) != FST_MODE_STICK)
        return;
    if (mode == FST_MODE_SLIP)
        fst_disc_release(flow, state, &p, slip, &pivot);
    fst_set_slip_double(c, state, slip);
    state[FST_WZ] = pivot;
}

/* The mode of a bead whose contact lets go: slip, if friction falls at once, so that the slip has an
 * acceleration to begin with. */
static int released_mode(const fst_flow *flow)
{
    const fst_coulomb_double *law = &flow->step.context.coefficients.law.coulomb;
    const int falls_at_once = law->holding > FALL_AT_ONCE * fst_coulomb_mu_double(law, 0.0);
    return falls_at_once || is_disc(flow) ? FST_MODE_SLIP : FST_MODE_ONSET;
}

/* The mode of a bead that is put down in a state. */
static int mode_at(const fst_flow *flow, const double *state)
{
    fst_pull_double p;
    fst_magnetic_pull_double(&flow->step.context.coefficients, state, &p);
    if (fst_flight_allowed(flow) && fst_flight_load(flow, state, &p) < 0)
        return FST_MODE_FLIGHT;
    if (is_disc(flow))
        return fst_disc_rests(flow, state, &p) ? FST_MODE_STICK : FST_MODE_SLIP;
    const fst_contact_double at = fst_contact_of_double(&flow->step.context.coefficients, state, &p);
    if (fst_norm_2_double(at.slip) > captured(flow))
        return FST_MODE_SLIP;
    return fst_norm_2_double(at.push) <= hold(flow, &at) ? FST_MODE_STICK : released_mode(flow);
}

/* A bead leaves the plate, or comes back to it: the mode that follows. */
static int leave_or_return(fst_flow *flow, double *state)
{
    if (fst_flight_is_on(flow))
        return fst_flight_impact(flow, state) ? mode_at(flow, state) : FST_MODE_FLIGHT;
    fst_flight_begin(flow, 0.0);
    return FST_MODE_FLIGHT;
}

/* The mode of the contact changes at `state`, which may be moved by less than anything else feels. */
static void enter_contact(fst_flow *flow, int mode, double *state)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    static const double nothing[2] = {0.0, 0.0};
    double slip[2];
    fst_slip_double(c, state, slip);
    if (mode == FST_MODE_FLIGHT) {
        ; /* the state is no matter of the plate */
    } else if (is_disc(flow)) {
        hold_disc(flow, mode, state);
    } else if (mode == FST_MODE_STICK) {
        fst_set_slip_double(c, state, nothing);
    } else if (mode == FST_MODE_ONSET) {
        const double part = fst_contact_begin_onset(flow, state);
        flow->contact.slips_from = fmax(handed_over(flow) * part * part, LEAST_HAND_OVER * captured(flow));
        flow->contact.released = flow->t;
    } else if (fst_norm_2_double(slip) < captured(flow)) {
        const fst_contact_double at = contact_at(flow, state);
        const double part = captured(flow) / fst_norm_2_double(at.push);
        fst_set_slip_double(c, state, (const double[2]){part * at.push[0], part * at.push[1]});
    }
    law_of(flow)->mode = mode;
}

/* The mode of a contact that sticks while the bead comes to rest: it may not be able to hold it there. */
static int held_at_rest(fst_flow *flow, int mode, const double *state)
{
    if (mode != FST_MODE_STICK || is_disc(flow))
        return mode;
    const fst_contact_double at = contact_at(flow, state);
    return fst_norm_2_double(at.push) <= hold(flow, &at) * (1.0 + PACED_SLACK) ? mode : released_mode(flow);
}

/* The same where the plate resists rolling.  A bead that does not roll is at rest where both friction and
 * resistance hold it; a bead that is to begin to slip and to roll at once is set rolling at a tiny speed. */
static void enter_resisted(fst_flow *flow, int mode, int roll, double *state)
{
    const int released = roll == FST_ROLL_STARTS;
    const int still = mode != FST_MODE_FLIGHT && fst_rest_is_still(flow, state);
    fst_rest_enter(flow, still ? FST_ROLL_RESTS : FST_ROLL_ROLLS, state);
    if (still)
        mode = held_at_rest(flow, mode, state);
    enter_contact(flow, mode, state);
    if (!still)
        return;
    fst_rest_enter(flow, FST_ROLL_RESTS, state); /* what the impulse of a capture left */
    if (!released && fst_rest_holds(flow, state))
        return;
    fst_rest_enter(flow, mode == FST_MODE_ONSET ? FST_ROLL_ROLLS : FST_ROLL_STARTS, state);
    const int then = held_at_rest(flow, mode, state);
    if (then != mode) {
        fst_rest_enter(flow, FST_ROLL_ROLLS, state);
        enter_contact(flow, then, state);
    }
}

/* The mode of a contact that goes on while rolling changes: in an onset with another push. */
static int goes_on(const fst_flow *flow, const double *state)
{
    double slip[2];
    fst_slip_double(&flow->step.context.coefficients, state, slip);
    const int mode = fst_contact_mode(flow);
    return mode == FST_MODE_ONSET && fst_norm_2_double(slip) > captured(flow) ? FST_MODE_SLIP : mode;
}

/* The modes change at `state`; -1: one goes on. */
static void enter(fst_flow *flow, int mode, int roll, double *state)
{
    fst_contact_state *contact = &flow->contact;
    const int resists = flow->step.context.coefficients.kinds.resists;
    contact->proposal[fst_contact_mode(flow)][fst_contact_roll(flow)] = flow->control.proposal;
    if (mode == FST_MODE_FLIGHT)
        mode = leave_or_return(flow, state);
    mode = mode >= 0 ? mode : goes_on(flow, state);
    if (resists)
        enter_resisted(flow, mode, roll, state);
    else
        enter_contact(flow, mode, state);
    const double known = contact->proposal[fst_contact_mode(flow)][fst_contact_roll(flow)];
    flow->control.proposal = known > 0 ? known : FIRST_SIZE;
    contact->next_mode = contact->next_roll = -1;
}

void fst_contact_put_down(fst_flow *flow, double *state)
{
    const fst_coefficients_double *c = &flow->step.context.coefficients;
    static const double nothing[2] = {0.0, 0.0};
    if (is_disc(flow))
        fst_disc_begin(flow);
    if (fst_flight_is_on(flow))
        fst_flight_go_on(flow);
    else if (flow->groups.friction == FST_FRICTION_ROLLING)
        fst_set_slip_double(c, state, nothing);
    if (c->kinds.paced && !fst_flight_is_on(flow))
        enter(flow, mode_at(flow, state), -1, state);
}

/* ------------------------------------------------------------------ events that end a mode */

/* What static friction could still take. */
static double release_function(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    if (is_disc(flow))
        return fst_disc_hold(flow, state, p) + PACED_SLACK;
    return fst_grip_left_double(&flow->step.context.coefficients, state, p);
}

/* In onset: the speed along A, which began at 0. */
static double onset_speed(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    const fst_contact_double at = fst_contact_of_double(&flow->step.context.coefficients, state, p);
    return (at.slip[0] * at.push[0] + at.slip[1] * at.push[1]) / fst_norm_2_double(at.push);
}

static double until_handed_over(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return flow->contact.slips_from - onset_speed(flow, state, p);
}

static double until_back_at_rest(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    return onset_speed(flow, state, p) + captured(flow);
}

/* Where the slip hardly grows, its direction is no longer known after some time; *x: that place in the step. */
static int onset_is_long(fst_flow *flow, double *x)
{
    const double time = sqrt(2.0 * flow->contact.slips_from / USUAL_GROWTH) - law_of(flow)->lag.since;
    const double whole = fst_contact_elapsed(flow);
    *x = time > 0 && time < whole ? fst_contact_fraction(flow, time) : 1.0;
    return time <= whole && fst_flow_function_at(flow, *x, onset_speed) >= FEW * flow->contact.slips_from;
}

/* The fraction of the last step at which an event ends its mode, 2 where none does, and the mode that follows.
 */
static double mode_ends(fst_flow *flow, int *next)
{
    double first = 2.0, x;
    if (fst_flight_is_on(flow)) {
        *next = FST_MODE_FLIGHT;
        return fst_flight_lands(flow, &x) ? x : first;
    }
    if (fst_flight_allowed(flow) && fst_flow_first_negative(flow, fst_flight_load, 0.0, &x)) {
        *next = FST_MODE_FLIGHT;
        first = x;
    }
    if (fst_contact_mode(flow) == FST_MODE_STICK && fst_flow_becomes_negative(flow, release_function, &x) &&
        x < first) {
        *next = released_mode(flow);
        first = x;
    }
    if (fst_contact_mode(flow) != FST_MODE_ONSET)
        return first;
    if ((fst_flow_becomes_negative(flow, until_handed_over, &x) || onset_is_long(flow, &x)) && x < first) {
        *next = FST_MODE_SLIP;
        first = x;
    }
    if (fst_flow_becomes_negative(flow, until_back_at_rest, &x) && x < first) {
        *next = FST_MODE_STICK;
        first = x;
    }
    return first;
}

/* The mode that follows a slip that is nearly nothing, -1 where it goes on.  It ends where friction is stronger
 * than the push.  A slip straight against a push that is stronger stops as well, but lets go at once; it would
 * approach rest for ever in theta. */
static int after_slip(const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    if (fst_contact_mode(flow) != FST_MODE_SLIP)
        return -1;
    if (is_disc(flow))
        return fst_disc_rests(flow, s->end, FST_PATH_PULL(s, FST_PATH_END)) ? FST_MODE_STICK : -1;
    if (!fst_slip_is_over_double(s, flow->rtol))
        return -1;
    const fst_contact_double at =
        fst_contact_of_double(&s->context.coefficients, s->end, FST_PATH_PULL(s, FST_PATH_END));
    const int against = at.slip[0] * at.push[0] + at.slip[1] * at.push[1] < 0;
    if (fst_norm_2_double(at.push) < (against ? hold(flow, &at) : brake(flow, &at)))
        return FST_MODE_STICK;
    return against ? released_mode(flow) : -1;
}

/* ------------------------------------------------------------------ steps */

/* Make the last step anew, with another size. */
static void make_anew(fst_flow *flow, double size)
{
    flow->step.h = size;
    fst_bead_try_step_double(&flow->step);
    flow->norm_drift += fst_finish_step_double(&flow->step);
    flow->rhs_calls += DOP_TRY_EVALUATIONS + 1;
    flow->has_dense = flow->contact.has_clock = 0;
}

/* Make the last step anew so that it takes the time `rest`. */
static void land(fst_flow *flow, double rest)
{
    enum { TRIES = 8 };
    make_anew(flow, flow->step.h * fst_contact_fraction(flow, rest));
    for (int i = 0; i < TRIES; ++i) {
        const double late = fst_contact_elapsed(flow) - rest, pace = FST_PATH_PACE(&flow->step, FST_PATH_END);
        if (fabs(late) <= 1e-15 * (1.0 + fabs(flow->t.high)) || !(pace > 0))
            return;
        make_anew(flow, flow->step.h - late / pace);
    }
}

/* Make the last step anew, up to the event at its fraction x: a bead in the air comes down just there. */
static void cut_at(fst_flow *flow, double x)
{
    enum { TRIES = 4 };
    if (x < 1.0)
        make_anew(flow, x * flow->step.h);
    for (int i = 0; fst_flight_is_on(flow) && i < TRIES; ++i) {
        const double missing = fst_flight_missing(flow);
        if (fabs(missing) <= 1e-15 * (1.0 + fabs(flow->t.high)) || missing < -0.5 * flow->step.h)
            return;
        make_anew(flow, flow->step.h + missing);
    }
}

/* The fraction of the last step at which a mode ends, of the contact or of rolling, 2 where none does; the one
 * of both that ends there has a mode that follows. */
static double first_end(fst_flow *flow, int *next, int *next_roll)
{
    int contact = -1, roll = -1;
    const double of_contact = mode_ends(flow, &contact);
    const double of_roll = flow->step.context.coefficients.kinds.resists ? fst_rest_ends(flow, &roll) : 2.0;
    *next = of_contact <= of_roll && of_contact <= 1.0 ? contact : -1;
    *next_roll = of_roll <= of_contact && of_roll <= 1.0 ? roll : -1;
    return fmin(of_contact, of_roll);
}

void fst_contact_begin_next(fst_flow *flow)
{
    const int next_mode = flow->contact.next_mode;
    if (next_mode < 0 && flow->contact.next_roll < 0)
        return;
    flow->contact.captures += fst_contact_mode(flow) == FST_MODE_SLIP && next_mode == FST_MODE_STICK;
    enter(flow, next_mode, flow->contact.next_roll, flow->step.end);
    fst_bead_flow_restart(flow);
}

void fst_contact_begin_step(fst_flow *flow)
{
    fst_contact_begin_next(flow);
    fst_bead_flow_prepare(flow);
    if (fst_contact_mode(flow) == FST_MODE_ONSET)
        law_of(flow)->lag.since = fst_twofold_difference(flow->t, flow->contact.released);
    fst_rest_go_on(flow);
}

/* The modes that follow at the end of the last step, where no event has told. */
static void look_at_end(fst_flow *flow)
{
    if (flow->contact.next_mode < 0)
        flow->contact.next_mode = after_slip(flow);
    if (flow->contact.next_roll < 0)
        flow->contact.next_roll = fst_rest_after(flow);
}

int fst_contact_look_ahead(fst_flow *flow, double t_limit, double *end)
{
    const fst_twofold limit = {t_limit, 0.0};
    flow->contact.has_clock = flow->has_dense = 0;
    flow->t_start = flow->t; /* times within the step are asked for before it is over */
    int next = -1, next_roll = -1;
    const double event = first_end(flow, &next, &next_roll);
    const double way = fst_contact_fraction(flow, fst_twofold_difference(limit, flow->t));
    if (way <= 1.0 && way <= event) {
        *end = way;
        return 1;
    }
    *end = event <= 1.0 ? event : 1.0;
    flow->contact.next_mode = next;
    flow->contact.next_roll = next_roll;
    if (event > 1.0)
        look_at_end(flow);
    return 0;
}

void fst_contact_end_step(fst_flow *flow, double t_limit)
{
    const fst_twofold limit = {t_limit, 0.0};
    double end;
    const int lands = fst_contact_look_ahead(flow, t_limit, &end);
    if (lands)
        land(flow, fst_twofold_difference(limit, flow->t));
    else if (flow->contact.next_mode >= 0 || flow->contact.next_roll >= 0)
        cut_at(flow, end);
    flow->rhs_calls += 1;
    flow->accepted += 1;
    flow->t = lands ? limit : fst_twofold_add(flow->t, fst_contact_elapsed(flow));
    flow->has_step = 1;
    if (lands)
        flow->contact.next_mode = flow->contact.next_roll = -1;
    if (lands || end < 1.0)
        look_at_end(flow);
}

fst_status fst_contact_step(fst_flow *flow, double t_limit, fst_error *error)
{
    const fst_twofold limit = {t_limit, 0.0};
    if (fst_twofold_difference(limit, flow->t) < 0)
        return fst_fail(error, FST_BAD_INPUT, "fst_flow",
                        "time cannot run backwards under dry friction: what was at rest does not tell when it "
                        "came to rest");
    fst_contact_begin_step(flow);
    if (!fst_bead_flow_try_until_good(flow, INFINITY))
        return fst_flow_fail(flow, error);
    fst_contact_end_step(flow, t_limit);
    return FST_OK;
}
