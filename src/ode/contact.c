/* contact.c - dry friction along a trajectory: when a contact slips and sticks, a bead rolls and rests, and
 * flies.
 *
 * A step has one pair of modes (model/contact/modes.inl), and the next step may have another.  The slip and the
 * rotation are held and let go alike (automaton.inl; slip.c, rest.c).  Here the two are brought together, and
 * with flights (flight.c):
 *
 *     step ----> does a mode end in it? ----> make it anew, as long as up to there ----> enter the next modes
 *      ^                  | no                                                                   |
 *      +------------------+----------------------------------------------------------------------+
 */
#include "ode/flight.h"
#include "ode/rest.h"
#include "ode/slip.h"

#include "base/error.h"
#include "model/modes.h"

static const double FIRST_SIZE = 0.05; /* of a step in modes that were not met before */

/* ------------------------------------------------------------------ changes of mode */

/* The mode of a contact in a state, while the rolling has its mode. */
static int mode_at(const fst_flow *flow, const double *state)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    fst_pull_double p;
    fst_magnetic_pull_double(c, m, state, &p);
    return fst_contact_mode_at(c, m, state, &p, flow->rtol);
}

/* A bead leaves the plate, or comes back to it: the mode that follows. */
static int leave_or_return(fst_flow *flow, double *state)
{
    if (fst_flight_is_on(flow))
        return fst_flight_impact(flow, state) ? mode_at(flow, state) : FST_MODE_FLIGHT;
    fst_flight_begin(state, 0.0);
    return FST_MODE_FLIGHT;
}

/* The mode of a contact that sticks while the bead comes to rest: it may not be able to hold it there. */
static int held_at_rest(const fst_flow *flow, int mode, const double *state)
{
    return mode == FST_MODE_STICK ? fst_held_mode(fst_flow_world(flow), fst_flow_modes(flow), state) : mode;
}

/* The modes change on a plate that resists rolling.  A bead that does not roll is at rest where both friction
 * and resistance hold it; a bead that is to begin to slip and to roll at once is set rolling at a tiny speed.
 */
static void enter_resisted(fst_flow *flow, int mode, int roll, double *state)
{
    const int released = roll == FST_ROLL_STARTS;
    const int still = mode != FST_MODE_FLIGHT && fst_rest_is_still(flow, state);
    fst_rest_enter(flow, still ? FST_ROLL_RESTS : FST_ROLL_ROLLS, state);
    if (still)
        mode = held_at_rest(flow, mode, state);
    fst_slip_enter(flow, mode, state);
    if (!still)
        return;
    fst_rest_enter(flow, FST_ROLL_RESTS, state); /* what the impulse of a capture left */
    if (!released && fst_rest_holds(flow, state))
        return;
    fst_rest_enter(flow, mode == FST_MODE_ONSET ? FST_ROLL_ROLLS : FST_ROLL_STARTS, state);
    const int then = held_at_rest(flow, mode, state);
    if (then != mode) {
        fst_rest_enter(flow, FST_ROLL_ROLLS, state);
        fst_slip_enter(flow, then, state);
    }
}

/* The mode of a contact that goes on while rolling changes: in an onset or a creep with another push. */
static int goes_on(const fst_flow *flow, const double *state)
{
    const int mode = fst_contact_mode(flow);
    const int follows = mode == FST_MODE_ONSET || mode == FST_MODE_CREEP;
    return follows && fst_slip_is_felt(flow, state) ? FST_MODE_SLIP : mode;
}

/* The size of the next step in the present modes. */
static double *proposal(fst_flow *flow)
{
    return &flow->contact.proposal[fst_contact_mode(flow)][fst_contact_roll(flow)];
}

/* The modes change at `state`; -1: one goes on. */
static void enter(fst_flow *flow, int mode, int roll, double *state)
{
    *proposal(flow) = flow->control.proposal;
    if (mode == FST_MODE_FLIGHT)
        mode = leave_or_return(flow, state);
    mode = mode >= 0 && (mode != FST_MODE_CREEP || roll < 0) ? mode : goes_on(flow, state);
    if (fst_flow_world(flow)->kinds.resists)
        enter_resisted(flow, mode, roll, state);
    else
        fst_slip_enter(flow, mode, state);
    const double known = *proposal(flow);
    flow->control.proposal = known > 0 ? known : FIRST_SIZE;
    if (fst_contact_mode(flow) == FST_MODE_CREEP)
        flow->control.proposal = fmin(flow->control.proposal, flow->contact.slip.longest);
    flow->contact.slip.next = flow->contact.roll.next = -1;
}

void fst_contact_put_down(fst_flow *flow, double *state)
{
    const fst_kinds *kinds = &fst_flow_world(flow)->kinds;
    static const double nothing[2] = {0.0, 0.0};
    if (fst_flight_is_on(flow))
        return;
    if (kinds->rolls)
        fst_set_slip_double(fst_flow_world(flow), state, nothing);
    if (kinds->modes)
        enter(flow, mode_at(flow, state), -1, state);
}

/* ------------------------------------------------------------------ events that end a mode */

static double load_left(const fst_flow *flow, const double *state, const fst_pull_double *p)
{
    (void)state;
    return fst_load_left(fst_flow_world(flow), p);
}

/* The fraction of the last step at which an event ends the mode of the contact, 2 where none does, and the mode
 * that follows. */
static double contact_ends(fst_flow *flow, int *next)
{
    double first = 2.0, x;
    int then = -1;
    *next = FST_MODE_FLIGHT;
    if (fst_flight_is_on(flow))
        return fst_flight_lands(flow, &x) ? x : first;
    if (fst_flow_world(flow)->kinds.flies && fst_flow_first_negative(flow, load_left, 0.0, &x))
        first = x;
    x = fst_slip_ends(flow, &then);
    if (x >= first)
        return first;
    *next = then;
    return x;
}

/* ------------------------------------------------------------------ steps */

/* Make the last step anew, with another size. */
static void make_anew(fst_flow *flow, double size)
{
    flow->step.h = size;
    fst_bead_try_step_double(&flow->step);
    flow->norm_drift += fst_finish_step_double(&flow->step);
    flow->rhs_calls += DOP_TRY_EVALUATIONS + 1;
    flow->has_dense = 0;
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

/* The fraction of the last step at which the first mode ends, 2 where none does.  *next and *next_roll are the
 * modes of the contact and of rolling that follow there, -1 for one that goes on. */
static double first_end(fst_flow *flow, int *next, int *next_roll)
{
    int contact = -1, roll = -1;
    const double of_contact = contact_ends(flow, &contact);
    const double of_roll = fst_flow_world(flow)->kinds.resists ? fst_rest_ends(flow, &roll) : 2.0;
    *next = of_contact <= of_roll && of_contact <= 1.0 ? contact : -1;
    *next_roll = of_roll <= of_contact && of_roll <= 1.0 ? roll : -1;
    return fmin(of_contact, of_roll);
}

void fst_contact_begin_next(fst_flow *flow)
{
    fst_contact_state *contact = &flow->contact;
    if (!fst_contact_changes(flow))
        return;
    contact->captures += fst_contact_slips(flow) && contact->slip.next == FST_MODE_STICK;
    enter(flow, contact->slip.next, contact->roll.next, flow->step.end);
    fst_bead_flow_restart(flow);
}

void fst_contact_begin_step(fst_flow *flow)
{
    fst_contact_begin_next(flow);
    fst_bead_flow_prepare(flow);
    fst_slip_go_on(flow);
    fst_rest_go_on(flow);
}

/* The modes that follow at the end of the last step, where no event has said them. */
static void look_at_end(fst_flow *flow)
{
    fst_contact_state *contact = &flow->contact;
    if (contact->slip.next < 0)
        contact->slip.next = fst_slip_after(flow);
    if (contact->roll.next < 0)
        contact->roll.next = fst_rest_after(flow);
}

int fst_contact_look_ahead(fst_flow *flow, double t_limit, double *end)
{
    const fst_twofold limit = {t_limit, 0.0};
    flow->has_dense = 0;
    flow->t_start = flow->t; /* times within the step are asked for before it is over */
    int next = -1, next_roll = -1;
    const double event = first_end(flow, &next, &next_roll);
    const double way = fst_contact_fraction(flow, fst_twofold_difference(limit, flow->t));
    if (way <= 1.0 && way <= event) {
        *end = way;
        return 1;
    }
    *end = event <= 1.0 ? event : 1.0;
    flow->contact.slip.next = next;
    flow->contact.roll.next = next_roll;
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
    else if (fst_contact_changes(flow))
        cut_at(flow, end);
    flow->rhs_calls += 1;
    flow->accepted += 1;
    flow->t = lands ? limit : fst_twofold_add(flow->t, fst_contact_elapsed(flow));
    flow->has_step = 1;
    if (lands)
        flow->contact.slip.next = flow->contact.roll.next = -1;
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
