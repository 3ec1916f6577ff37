/* neighbours.c - tangent vectors carried along a motion with dry friction, through its changes of mode.
 *
 * The motion is the flow's own (ode/contact.c): slips, which are integrated in theta, dt = pace dtheta; rests,
 * in which the bead rolls; and short onsets of slips.  Along each of its steps the tangent vectors are carried
 * by the same method with the same stages, so that they are the derivatives of just the numbers that the step
 * computed, to the order of the method.
 *
 * Two kinds of difference.  At equal theta, a neighbour of the motion is off by d, and its clock by dt:
 *
 *     d'  = pace Df d + f (Dpace d)        (' is the derivative by theta)
 *     dt' = Dpace d
 *
 * What Newton's method wants is the difference at equal times, which is d - f dt.  While the slip dies,
 * differences at equal times of |V| and of its direction become large against |V| itself; at equal theta they
 * die with it.  So a tangent vector keeps its dt until the slip is over or the way ends.
 *
 * A bead that flies, and a disc that neither slips nor pivots, are not known here: fst_neighbours_known().
 *
 * Where the mode changes (w: what sticks or slips before, f: after):
 *
 *     slip -> stick     |V| has fallen to nothing in both at equal theta: what d still has of a slip is
 *                       taken out by the plate's impulse, and d - f dt goes on
 *     stick -> onset    f = w there: nothing happens (if static friction is hardly stronger: as below)
 *     onset -> slip     nothing happens here either
 *     stick -> slip     static friction was stronger: f != w.  The neighbour lets go at another time, off by
 *                       dt = -Dg d/(Dg w), g being what static friction could still take: d + w dt goes on
 *     onset -> stick    the slip has come back to nothing at the rate s': dt = -ds/s', d + (w - f) dt goes on
 *
 * Where the plate resists rolling (ode/rest.c), its modes are the same with the rotation W_h in place of the
 * slip: rolls -> rests as slip -> stick, rests -> starts as stick -> onset.  Two things are more delicate there:
 *
 *     starts -> rolls   the rotation is so small that differences at equal theta would grow, to cancel against
 *                       f dt in the end; so the neighbours go on at equal rotations, dt = -d|W_h|/|W_h|'
 *     both at once      f changes where the contact does, and with it what the resistance has to hold; so the
 *                       modes that follow are asked of a copy of the flow
 *
 * A bead at rest has no slip, and neither has any neighbour: nine directions become seven.  So a return that
 * sticks somewhere has two multipliers that are exactly zero.
 *
 * Not in the derivative: the angle by which an onset lags behind (`lean`, as it changes in time) is that of the
 * motion for its neighbours too.  What they would feel of the difference is of the order (hand-over)^(3/2),
 * 1e-8 at a tolerance of 1e-13; it bears on Newton's convergence alone, not on where it ends.
 */
#include "ode/neighbours.h"

#include <math.h>
#include <string.h>

#include "model/tangent.inl"

enum { STAGES = 12 };

/* ------------------------------------------------------------------ at one state */

/* Whether the derivative by the parameter is taken as a difference of setups. */
static int differs(const fst_neighbours *b)
{
    return b->parameter >= 0 && b->exact == 0.0;
}

/* By how much v differs in a setup if the contact slips as it does in the motion: the slip depends on eps. */
static void same_slip(const fst_world_double *c, const fst_world_double *other, const double *y, double by[2])
{
    double here[2], there[2];
    fst_slip_double(c, y, here);
    fst_slip_double(other, y, there);
    for (int i = 0; i < 2; ++i)
        by[i] = here[i] - there[i];
}

/* How v changes with the parameter at an unchanged slip. */
static void at_same_slip(const fst_neighbours *b, const fst_world_double *c, const double *y, double by[2])
{
    double below[2], above[2];
    by[0] = by[1] = 0.0;
    if (!differs(b))
        return;
    same_slip(c, &b->below, y, below);
    same_slip(c, &b->above, y, above);
    for (int i = 0; i < 2; ++i)
        by[i] = (above[i] - below[i]) / b->spread;
}

/* Whether the magnet's field is the same in another setup: most parameters are not the magnet's. */
static int has_field_of(const fst_world_double *other, const fst_world_double *c)
{
    return other->height == c->height && memcmp(&other->source, &c->source, sizeof c->source) == 0;
}

/* d(state)/dtheta changes by this with the parameter, and the pace by *pace, at an unchanged slip: a slip that
 * is nearly nothing would not be one in a setup with another eps. */
static void by_parameter(const fst_neighbours *b, const fst_world_double *c, const fst_modes_double *m,
                         const double *y, const fst_linear_double *linear, double *by, double *pace)
{
    memset(by, 0, FST_STATE_SIZE * sizeof *by);
    *pace = 0.0;
    if (b->parameter < 0)
        return;
    if (b->exact != 0.0) {
        const double here = b->exact * fst_pace_double(c, m, y);
        fst_rhs_by_omega_double(y, by);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            by[i] *= here;
        return;
    }
    double rate[2][FST_STATE_SIZE], paces[2];
    for (int side = 0; side < 2; ++side) {
        const fst_world_double *other = side ? &b->above : &b->below;
        fst_linear_double there = {.at = linear->at};
        double state[FST_NUMBERS], change[2];
        memcpy(state, y, sizeof state);
        same_slip(c, other, y, change);
        state[FST_VX] += change[0];
        state[FST_VY] += change[1];
        paces[side] = fst_pace_double(other, m, state);
        if (has_field_of(other, c))
            fst_linearise_in_field_double(other, m, other->omega, state, &there, rate[side]);
        else
            fst_linearise_double(other, m, other->omega, state, &there, rate[side]);
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        by[i] = (paces[1] * rate[1][i] - paces[0] * rate[0][i]) / b->spread;
    *pace = (paces[1] - paces[0]) / b->spread;
}

/* Neighbour `column` as the derivatives at an unchanged slip see it: all others differ by their start alone. */
static void neighbour(const fst_neighbours *b, const fst_world_double *c, const double *y, int column,
                      const double *d, double *seen)
{
    double by[2];
    memcpy(seen, d, FST_STATE_SIZE * sizeof *seen);
    if (column != b->parameter)
        return;
    at_same_slip(b, c, y, by);
    seen[FST_VX] -= by[0];
    seen[FST_VY] -= by[1];
}

/* How the slip differs in neighbour `column`. */
static void slip_of(const fst_neighbours *b, const fst_world_double *c, const double *y, int column,
                    double slip[2])
{
    double seen[FST_STATE_SIZE];
    neighbour(b, c, y, column, b->d[column], seen);
    fst_slip_double(c, seen, slip);
}

/* Take the slip out of all neighbours, as the plate's impulse does: the moment about the contact stays. */
static void stop_slips(fst_neighbours *b, const fst_world_double *c, const double *y)
{
    for (int column = 0; column < b->count; ++column) {
        double slip[2], *d = b->d[column];
        slip_of(b, c, y, column, slip);
        d[FST_VX] -= c->share * slip[0];
        d[FST_VY] -= c->share * slip[1];
        d[FST_WX] -= c->spin_up * slip[1];
        d[FST_WY] += c->spin_up * slip[0];
        slip_of(b, c, y, column, slip); /* what rounding left */
        d[FST_VX] -= slip[0];
        d[FST_VY] -= slip[1];
    }
}

/* Take the rotation out of all neighbours of a bead that rests; each keeps its slip. */
static void stop_rolling(fst_neighbours *b, const fst_world_double *c)
{
    for (int column = 0; column < b->count; ++column)
        fst_stop_rolling_double(c, b->d[column]);
}

/* What a mode of the motion allows no neighbour to have. */
static void stop_what_stops(fst_neighbours *b, const fst_world_double *c, const fst_modes_double *m,
                            const double *y)
{
    if (c->kinds.resists && fst_rests_double(m))
        stop_rolling(b, c);
    if (fst_sticks_double(c, m) > 0.5)
        stop_slips(b, c, y);
}

/* ------------------------------------------------------------------ along a step */

/* The derivatives of the differences by theta at a stage. */
static void slopes(const fst_neighbours *b, const fst_world_double *c, const fst_modes_double *m, double omega,
                   const double *y, double d[FST_NEIGHBOURS][FST_STATE_SIZE],
                   double k[FST_NEIGHBOURS][FST_STATE_SIZE], double *kt)
{
    fst_linear_double linear;
    double f[FST_STATE_SIZE], by[FST_STATE_SIZE], seen[FST_STATE_SIZE], pace_by;
    const double pace = fst_pace_double(c, m, y);
    fst_linearise_double(c, m, omega, y, &linear, f);
    by_parameter(b, c, m, y, &linear, by, &pace_by);
    for (int column = 0; column < b->count; ++column) {
        neighbour(b, c, y, column, d[column], seen);
        const double faster = fst_pace_change_double(c, m, y, seen);
        fst_change_along_double(c, omega, y, &linear, seen, k[column]);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            k[column][i] = pace * k[column][i] + faster * f[i];
        kt[column] = faster;
    }
    for (int i = 0; i < FST_STATE_SIZE && b->parameter >= 0; ++i)
        k[b->parameter][i] += by[i];
    if (b->parameter >= 0)
        kt[b->parameter] += pace_by;
}

/* Carry the differences along the flow's last step, by its own stages. */
static void carry_along_step(fst_neighbours *b, const fst_flow *flow)
{
    static const double weights[16][15] = DOP_WEIGHTS;
    const fst_bead_step_double *s = &flow->step;
    double k[STAGES][FST_NEIGHBOURS][FST_STATE_SIZE], kt[STAGES][FST_NEIGHBOURS],
        at[FST_NEIGHBOURS][FST_STATE_SIZE];
    for (int stage = 0; stage <= STAGES; ++stage) { /* the last is the end of the step */
        memcpy(at, b->d, sizeof at);
        for (int before = 0; before < stage; ++before) {
            const double weight = s->h * weights[stage][before], *slope = k[before][0];
            double *to = at[0];
            for (int i = 0; i < b->count * FST_STATE_SIZE && weight != 0.0; ++i)
                to[i] += weight * slope[i];
        }
        if (stage < STAGES)
            slopes(b, FST_WORLD(s), FST_MODES(s), s->omega, s->stage[stage], at, k[stage], kt[stage]);
    }
    memcpy(b->d, at, sizeof at);
    for (int stage = 0; stage < STAGES; ++stage)
        for (int column = 0; column < b->count; ++column)
            b->dt[column] += s->h * weights[STAGES][stage] * kt[stage][column];
    stop_what_stops(b, FST_WORLD(s), FST_MODES(s), s->end);
}

/* ------------------------------------------------------------------ where the mode changes */

/* d(state)/dt at the end of the last step, in the modes of the contact and of rolling. */
static void rate_in(const fst_flow *flow, int contact, int rolling, double *f)
{
    fst_modes_double m = *fst_flow_modes(flow);
    fst_pull_double unused;
    m.contact = contact;
    m.rolling = rolling;
    fst_rhs_double(fst_flow_world(flow), &m, flow->step.omega, flow->step.end, f, &unused);
}

/* Every neighbour, off by its dt, at the time of the motion: `sign` -1.  And the other way round: +1. */
static void shift(fst_neighbours *b, const double *f, double sign)
{
    for (int column = 0; column < b->count; ++column)
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            b->d[column][i] += sign * b->dt[column] * f[i];
}

static void forget_clocks(fst_neighbours *b)
{
    memset(b->dt, 0, sizeof b->dt);
}

/* What static friction could still take, in a setup, of the push in a state, and its change in time or along a
 * neighbour. */
static double grip(const fst_world_double *c, const fst_modes_double *m, const double *y)
{
    fst_pull_double p;
    fst_magnetic_pull_double(c, m, y, &p);
    const fst_contact_double at = fst_contact_of_double(c, m, y, &p);
    return fst_grip_double(&at, c->yielding, c->law.coulomb.holding, 0.0);
}

static double grip_change(const fst_world_double *c, const fst_modes_double *m, double omega, const double *y,
                          const double *along)
{
    fst_linear_double l;
    double f[FST_STATE_SIZE], force[3], turning[3], twist[3], torque[3];
    fst_contact_double by;
    fst_linearise_double(c, m, omega, y, &l, f);
    fst_pull_change_double(c, &l, y, along, force, turning);
    by.load = l.contact.load > 0 ? -force[2] : 0.0;
    fst_cross_double(along + FST_NX, l.at.b, twist);
    fst_cross_double(y + FST_NX, turning, torque);
    fst_dry_change_double(c, &l, y, along, force, twist, torque, &by);
    const double *a = l.contact.push;
    return c->yielding * c->law.coulomb.holding * by.load -
           (a[0] * by.push[0] + a[1] * by.push[1]) / fst_norm_2_double(a);
}

/* The neighbours let go when they do, not when the motion does. */
static void let_go(fst_neighbours *b, const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    const double *y = flow->step.end, omega = flow->step.omega;
    double w[FST_STATE_SIZE];
    rate_in(flow, FST_MODE_STICK, fst_contact_roll(flow), w);
    const double rate = grip_change(c, m, omega, y, w);
    for (int column = 0; column < b->count; ++column)
        b->dt[column] = -grip_change(c, m, omega, y, b->d[column]) / rate;
    if (differs(b))
        b->dt[b->parameter] -= (grip(&b->above, m, y) - grip(&b->below, m, y)) / b->spread / rate;
    shift(b, w, 1.0);
    stop_slips(b, c, y);
}

/* Bring every neighbour, by a time of its own, to the place where its slip, or its rotation, along the push is
 * that of the motion. */
static void at_equal_speeds(fst_neighbours *b, const fst_flow *flow, int rolls)
{
    const fst_world_double *c = fst_flow_world(flow);
    const double *y = flow->step.end;
    double w[FST_STATE_SIZE], slip[2];
    fst_pull_double p;
    fst_magnetic_pull_double(c, fst_flow_modes(flow), y, &p);
    const fst_contact_double at = fst_contact_of_double(c, fst_flow_modes(flow), y, &p);
    const double *push = rolls ? at.balance : at.push;
    rate_in(flow, fst_contact_mode(flow), fst_contact_roll(flow), w);
    fst_slip_double(c, w, slip);
    const double *slowing = rolls ? w + FST_WX : slip;
    const double rate = push[0] * slowing[0] + push[1] * slowing[1];
    for (int column = 0; column < b->count; ++column) {
        slip_of(b, c, y, column, slip);
        const double *speed = rolls ? b->d[column] + FST_WX : slip;
        const double dt = -(push[0] * speed[0] + push[1] * speed[1]) / rate;
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            b->d[column][i] += dt * w[i];
        b->dt[column] += dt;
    }
}

/* The flow after the modes changed at the end of its last step. */
static void change(const fst_flow *flow, fst_flow *then)
{
    *then = *flow;
    fst_contact_begin_next(then);
}

/* d(state)/dt where the modes have just changed. */
static void rate_then(const fst_flow *flow, const fst_flow *then, double *f)
{
    rate_in(flow, fst_contact_mode(then), fst_contact_roll(then), f);
}

/* Neighbours that were compared at equal theta are compared at equal times from now on.  (Not while a tiny slip
 * goes on.) */
static void catch_up(fst_neighbours *b, const fst_flow *flow, const fst_flow *then)
{
    double f[FST_STATE_SIZE];
    rate_then(flow, then, f);
    shift(b, f, -1.0);
    forget_clocks(b);
}

/* The neighbours of a motion that lets go, or sinks back, do so at times of their own; they must be compared at
 * equal times before. */
static void bring_to_equal_times(fst_neighbours *b, const fst_flow *flow)
{
    double w[FST_STATE_SIZE];
    if (!fst_flow_world(flow)->kinds.resists) /* then they are */
        return;
    rate_in(flow, fst_contact_mode(flow), fst_contact_roll(flow), w);
    shift(b, w, -1.0);
    forget_clocks(b);
}

/* The mode of rolling changes, at the end of the flow's last step, to that of `then`. */
static void change_roll(fst_neighbours *b, const fst_flow *flow, const fst_flow *then)
{
    const fst_world_double *c = fst_flow_world(flow);
    const int before = fst_contact_roll(flow), after = fst_contact_roll(then);
    if (before == after)
        return;
    const int starts = before == FST_ROLL_STARTS;
    if (before == FST_ROLL_RESTS) { /* f = w: nothing happens */
        bring_to_equal_times(b, flow);
        return;
    }
    if (starts) /* at equal rotations */
        at_equal_speeds(b, flow, 1);
    if (after == FST_ROLL_ROLLS)
        return;
    stop_rolling(b, c);
    if (fst_sticks_double(c, fst_flow_modes(flow)) > 0.5)
        stop_slips(b, c, flow->step.end);
    if (starts || fst_contact_mode(then) != FST_MODE_SLIP)
        catch_up(b, flow, then);
}

/* That of the contact. */
static void change_contact(fst_neighbours *b, const fst_flow *flow, const fst_flow *then)
{
    const int before = fst_contact_mode(flow), after = fst_contact_mode(then);
    const fst_world_double *c = fst_flow_world(flow);
    const int jumps = c->law.coulomb.holding > fst_coulomb_mu_double(&c->law.coulomb, 0.0);
    if (before == FST_MODE_SLIP && after == FST_MODE_SLIP) { /* against a push that turns it round */
        stop_slips(b, c, flow->step.end);
    } else if (before == FST_MODE_SLIP) { /* the rest of a slip dies at equal theta */
        stop_slips(b, c, flow->step.end);
        catch_up(b, flow, then);
    } else if (before == FST_MODE_STICK && after == FST_MODE_SLIP) {
        bring_to_equal_times(b, flow);
        let_go(b, flow);
    } else if (before == FST_MODE_STICK && after == FST_MODE_ONSET && jumps) {
        bring_to_equal_times(b, flow);
        let_go(b, flow);
        catch_up(b, flow, then);
    } else if (before == FST_MODE_ONSET && after == FST_MODE_STICK) {
        at_equal_speeds(b, flow, 0);
        stop_slips(b, c, flow->step.end);
        catch_up(b, flow, then);
    }
}

/* A mode changes at the end of the flow's last step.  The other one may change with it. */
static void change_mode(fst_neighbours *b, const fst_flow *flow)
{
    fst_flow then;
    change(flow, &then);
    if (flow->contact.roll.next >= 0)
        change_roll(b, flow, &then);
    if (flow->contact.slip.next >= 0)
        change_contact(b, flow, &then);
    if (fst_flow_world(&then)->kinds.resists)
        stop_what_stops(b, fst_flow_world(&then), fst_flow_modes(&then), then.step.end);
}

/* ------------------------------------------------------------------ the way */

void fst_neighbours_start(fst_neighbours *b, const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    forget_clocks(b);
    if (c->kinds.resists && fst_contact_roll(flow) != FST_ROLL_ROLLS)
        stop_rolling(b, c);
    if (fst_sticks_double(c, fst_flow_modes(flow)) > 0.5 || fst_contact_mode(flow) == FST_MODE_ONSET)
        stop_slips(b, c, flow->step.y);
}

int fst_neighbours_known(const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const int now = fst_contact_mode(flow), next = flow->contact.slip.next;
    const int held = c->kinds.patch && (now == FST_MODE_STICK || next == FST_MODE_STICK);
    return now != FST_MODE_FLIGHT && next != FST_MODE_FLIGHT && !held;
}

void fst_neighbours_follow(fst_neighbours *b, const fst_flow *flow)
{
    carry_along_step(b, flow);
    if (fst_contact_changes(flow))
        change_mode(b, flow);
}

void fst_neighbours_at_equal_times(fst_neighbours *b, const fst_flow *flow)
{
    double f[FST_STATE_SIZE];
    if (!fst_flow_world(flow)->kinds.modes ||
        flow->contact.slip.next >= 0) /* where a mode just ended, the clocks were set, or must wait */
        return;
    rate_in(flow, fst_contact_mode(flow), fst_contact_roll(flow), f);
    shift(b, f, -1.0);
    forget_clocks(b);
}
