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
 * Where the mode changes (w: what sticks or slips before, f: after):
 *
 *     slip -> stick     |V| has fallen to nothing in both at equal theta: what d still has of a slip is
 *                       taken out by the plate's impulse, and d - f dt goes on
 *     stick -> onset    f = w there: nothing happens (if static friction is hardly stronger: as below)
 *     onset, creep -> slip  nothing happens here either
 *     stick -> slip     static friction was stronger: f != w.  The neighbour lets go at another time, off by
 *                       dt = -Dg d/(Dg w), g being what static friction could still take: d + w dt goes on
 *     slip -> creep     the slip hardly changes: d - f dt goes on, with the slip in the direction that follows the
 *     creep -> creep    neighbour's push, by the plate's impulse (at each end of a step, ode/creep.c; a disc slips)
 *     onset, creep -> stick  the slip has come back to nothing at the rate s': dt = -ds/s', d + (w - f) dt goes on
 *
 * A bead that flies (ode/flight.c) has a height and a climb, z and z', and so have its neighbours:
 *
 *     leaves the plate  at N = 0 friction has ceased and z'' = 0: f = w, and nothing happens.  (A neighbour that
 *                       leaves dt later is higher by the order of dt^3.)
 *     comes down        off by dt = -dz/z'; there its slip, which the impact rubs, and the speed of its fall are
 *                       off by those of d + w dt.  The impact's derivative maps these on, dz' -> -e_n dz', and
 *                       dz is 0.  Its clock stays off by dt, from impact to impact
 *     stays down        what dz' still was is dropped: hops that grow shorter like e_n^k leave no more of it
 *                       than of z', and their dt add up to that of the last touch
 *
 * Where the plate resists rolling (ode/rest.c), its modes are the same with the rotation W_h in place of the
 * slip: rolls -> rests as slip -> stick, rests -> starts as stick -> onset.  Two things are more delicate there:
 *
 *     starts -> rolls   the rotation is so small that differences at equal theta would grow, to cancel against
 *                       f dt in the end; so the neighbours go on at equal rotations, dt = -d|W_h|/|W_h|'
 *     both at once      f changes where the contact does, and with it what the resistance has to hold; so the
 *                       modes that follow are asked of a copy of the flow
 *
 * A bead at rest has no slip, and neither has any neighbour: nine directions become seven, six where a held disc
 * does not pivot either.  So a return that sticks somewhere has two or three multipliers that are exactly zero.
 *
 * Not in the derivative: the angle by which an onset lags behind (`lean`, as it changes in time) is that of the
 * motion for its neighbours too.  What they would feel of the difference is of the order (hand-over)^(3/2),
 * 1e-8 at a tolerance of 1e-13; it bears on Newton's convergence alone, not on where it ends.
 */
#include "ode/neighbours.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "ode/creep.h"
#include "ode/flight.h"
#include "ode/slip.h"
#include "ode/two_neighbours.h"

#include "ode/carried.inl"

enum { STAGES = 12 };
const double fst_stage_weights[16][15] = DOP_WEIGHTS;

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

/* The derivatives of a motion's numbers by theta change by this with the parameter, at an unchanged slip: a slip
 * that is nearly nothing would not be one in a setup with another eps. */
static void by_parameter(const fst_neighbours *b, const fst_world_double *c, const fst_modes_double *m,
                         const double *y, const fst_linear_double *linear, double *by)
{
    memset(by, 0, FST_NUMBERS * sizeof *by);
    if (b->parameter < 0)
        return;
    if (b->exact != 0.0) {
        const double here = b->exact * fst_pace_double(c, m, y);
        fst_rhs_by_omega_double(y, by);
        for (int i = 0; i < FST_STATE_SIZE; ++i)
            by[i] *= here;
        return;
    }
    double rate[2][FST_STATE_SIZE], paces[2], climbs[2];
    for (int side = 0; side < 2; ++side) {
        const fst_world_double *other = side ? &b->above : &b->below;
        fst_linear_double there = {.at = linear->at};
        double state[FST_NUMBERS], change[2], force[3];
        memcpy(state, y, sizeof state);
        same_slip(c, other, y, change);
        state[FST_VX] += change[0];
        state[FST_VY] += change[1];
        paces[side] = fst_pace_double(other, m, state);
        if (has_field_of(other, c))
            fst_linearise_in_field_double(other, m, other->omega, state, &there, rate[side]);
        else
            fst_linearise_double(other, m, other->omega, state, &there, rate[side]);
        fst_times_gradient_double(&there.at.gradient, there.dipole, force);
        climbs[side] = -fst_load_double(other, force);
    }
    for (int i = 0; i < FST_STATE_SIZE; ++i)
        by[i] = (paces[1] * rate[1][i] - paces[0] * rate[0][i]) / b->spread;
    by[FST_STEP_TIME] = (paces[1] - paces[0]) / b->spread;
    if (fst_in_flight_double(m))
        by[FST_CLIMB] = (climbs[1] - climbs[0]) / b->spread;
}

/* Neighbour `column` as the derivatives at an unchanged slip see it: all others differ by their start alone. */
static void neighbour(const fst_neighbours *b, const fst_world_double *c, const double *y, int column,
                      const double *d, double *seen)
{
    double by[2];
    memcpy(seen, d, FST_NUMBERS * sizeof *seen);
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
    double seen[FST_NUMBERS];
    neighbour(b, c, y, column, b->d[column], seen);
    fst_slip_double(c, seen, slip);
}

/* Take slips (and pivoting, of a disc) out. */
static void stop_slips(fst_neighbours *b, const fst_world_double *c, const double *y)
{
    for (int column = 0; column < b->count; ++column) {
        double slip[2], *d = b->d[column];
        slip_of(b, c, y, column, slip);
        fst_change_neighbour_slip_double(c, (const double[2]){-slip[0], -slip[1]}, d);
        slip_of(b, c, y, column, slip); /* what rounding left */
        d[FST_VX] -= slip[0];
        d[FST_VY] -= slip[1];
        if (c->kinds.patch)
            d[FST_WZ] = 0.0;
    }
}

/* Turn the slips of a motion that creeps into the direction that follows the push; y is its state. */
static void turn_slips(fst_neighbours *b, const fst_world_double *c, const fst_modes_double *m, double omega,
                       const double *y)
{
    for (int column = 0; column < b->count; ++column) {
        double slip[2], turned[2], seen[FST_NUMBERS], *d = b->d[column];
        neighbour(b, c, y, column, d, seen);
        fst_slip_double(c, seen, slip);
        fst_creep_slip_change(c, m, omega, y, seen, turned);
        fst_change_neighbour_slip_double(c, (const double[2]){turned[0] - slip[0], turned[1] - slip[1]}, d);
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

/* The derivatives of one difference by theta at a stage, where the motion was linearised and changes by f in time. */
static void slope_of_one(const fst_world_double *c, const fst_modes_double *m, double omega, const double *y,
                         const fst_linear_double *linear, const double *f, const double *seen, double *k)
{
    if (fst_in_flight_double(m)) {
        fst_change_aloft_double(c, omega, y, linear, seen, k);
        return;
    }
    fst_neighbour_slope_double(c, m, omega, y, linear, f, fst_pace_double(c, m, y), seen, k);
    k[FST_HEIGHT] = k[FST_CLIMB] = 0.0;
}

/* Those of all. */
static void slopes(const fst_neighbours *b, const fst_world_double *c, const fst_modes_double *m, double omega,
                   const double *y, double d[FST_NEIGHBOURS][FST_NUMBERS],
                   double k[FST_NEIGHBOURS][FST_NUMBERS])
{
    fst_linear_double linear;
    double f[FST_STATE_SIZE], by[FST_NUMBERS], seen[FST_NEIGHBOURS][FST_NUMBERS];
    const int flies = fst_in_flight_double(m);
    fst_linearise_double(c, m, omega, y, &linear, f);
    if (c->kinds.flies && !flies) /* the step that ends at lift-off, N = 0, belongs to N > 0 all the way */
        linear.contact.load = fmax(linear.contact.load, DBL_MIN);
    by_parameter(b, c, m, y, &linear, by);
    for (int column = 0; column < b->count; ++column)
        neighbour(b, c, y, column, d[column], seen[column]);
    if (b->count > 1 && fst_neighbours_pair(&c->kinds))
        fst_slopes_of_two(c, omega, y, &linear, f, b->count, seen, k);
    else
        for (int column = 0; column < b->count; ++column)
            slope_of_one(c, m, omega, y, &linear, f, seen[column], k[column]);
    for (int i = 0; i < (flies ? FST_NUMBERS : FST_HEIGHT) && b->parameter >= 0; ++i)
        k[b->parameter][i] += by[i];
}

/* Carry the differences along the flow's last step, by its own stages. */
static void carry_along_step(fst_neighbours *b, const fst_flow *flow)
{
    const fst_bead_step_double *s = &flow->step;
    double k[STAGES][FST_NEIGHBOURS][FST_NUMBERS], at[FST_NEIGHBOURS][FST_NUMBERS];
    for (int stage = 0; stage <= STAGES; ++stage) { /* the last is the end of the step */
        for (int column = 0; column < b->count; ++column)
            fst_neighbour_at_stage_double(s->h, stage, FST_NUMBERS, b->d[column], k[0][column],
                                          FST_NEIGHBOURS * FST_NUMBERS, at[column]);
        if (stage < STAGES)
            slopes(b, FST_WORLD(s), FST_MODES(s), s->omega, s->stage[stage], at, k[stage]);
    }
    memcpy(b->d, at, (size_t)b->count * sizeof *at);
    stop_what_stops(b, FST_WORLD(s), FST_MODES(s), s->end);
}

/* ------------------------------------------------------------------ where the mode changes */

/* The derivatives by time of a motion's numbers at the end of the last step, in the modes of the contact and of
 * rolling; 0 of the clock. */
static void rate_in(const fst_flow *flow, int contact, int rolling, double *f)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_modes_double m = *fst_flow_modes(flow);
    fst_pull_double pull;
    m.contact = contact;
    m.rolling = rolling;
    memset(f, 0, FST_NUMBERS * sizeof *f);
    fst_rhs_double(c, &m, flow->step.omega, flow->step.end, f, &pull);
    if (contact != FST_MODE_FLIGHT)
        return;
    f[FST_HEIGHT] = flow->step.end[FST_CLIMB];
    f[FST_CLIMB] = -fst_load_double(c, pull.force);
}

/* Every neighbour, off by its clock, at the time of the motion: `sign` -1.  And the other way round: +1. */
static void shift(fst_neighbours *b, const double *f, double sign)
{
    for (int column = 0; column < b->count; ++column)
        for (int i = 0; i < FST_NUMBERS; ++i)
            b->d[column][i] += sign * b->d[column][FST_STEP_TIME] * f[i];
}

static void forget_clocks(fst_neighbours *b)
{
    for (int column = 0; column < b->count; ++column)
        b->d[column][FST_STEP_TIME] = 0.0;
}

/* The neighbours let go when they do, not when the motion does. */
static void let_go(fst_neighbours *b, const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const fst_modes_double *m = fst_flow_modes(flow);
    const double *y = flow->step.end, omega = flow->step.omega;
    double w[FST_NUMBERS];
    rate_in(flow, FST_MODE_STICK, fst_contact_roll(flow), w);
    const double rate = fst_grip_change(c, m, omega, y, w);
    for (int column = 0; column < b->count; ++column)
        b->d[column][FST_STEP_TIME] = -fst_grip_change(c, m, omega, y, b->d[column]) / rate;
    if (differs(b))
        b->d[b->parameter][FST_STEP_TIME] -=
            (fst_grip_left(&b->above, m, y) - fst_grip_left(&b->below, m, y)) / b->spread / rate;
    shift(b, w, 1.0);
    stop_slips(b, c, y);
}

/* Bring every neighbour, by a time of its own, to the place where its slip, or its rotation, along the push is
 * that of the motion. */
static void at_equal_speeds(fst_neighbours *b, const fst_flow *flow, int rolls)
{
    const fst_world_double *c = fst_flow_world(flow);
    const double *y = flow->step.end;
    double w[FST_NUMBERS], slip[2];
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
        b->d[column][FST_STEP_TIME] += dt;
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

/* Neighbours that were compared at equal theta are compared at equal times from now on. */
static void catch_up(fst_neighbours *b, const fst_flow *flow, const fst_flow *then)
{
    double f[FST_NUMBERS];
    rate_then(flow, then, f);
    shift(b, f, -1.0);
    forget_clocks(b);
}

/* The neighbours of a motion that lets go, or sinks back, do so at times of their own; they must be compared at
 * equal times before. */
static void bring_to_equal_times(fst_neighbours *b, const fst_flow *flow)
{
    double w[FST_NUMBERS];
    if (!fst_flow_world(flow)->kinds.resists) /* then they are */
        return;
    rate_in(flow, fst_contact_mode(flow), fst_contact_roll(flow), w);
    shift(b, w, -1.0);
    forget_clocks(b);
}

/* ------------------------------------------------------------------ where the bead leaves the plate */

/* Neighbours are compared at equal times in the air: friction has ceased where they leave the plate. */
static void leave(fst_neighbours *b, const fst_flow *flow)
{
    double f[FST_NUMBERS];
    rate_in(flow, fst_contact_mode(flow), fst_contact_roll(flow), f);
    shift(b, f, -1.0);
    forget_clocks(b);
    for (int column = 0; column < b->count; ++column)
        b->d[column][FST_HEIGHT] = b->d[column][FST_CLIMB] = 0.0;
}

/* An impact: the slip, the speed of the fall, the impulse of friction, and the part of the slip that it leaves. */
typedef struct impact {
    double slip[2], falls, impulse, left;
    int stops; /* the slip */
} impact;

static impact impact_at(const fst_world_double *c, const double *y)
{
    impact at = {.falls = fmax(-y[FST_CLIMB], 0.0)};
    fst_slip_double(c, y, at.slip);
    const double s2 = at.slip[0] * at.slip[0] + at.slip[1] * at.slip[1];
    at.left = fst_impact_leaves(c, s2, (1.0 + c->law.coulomb.restitution) * at.falls, &at.impulse);
    at.stops = !(at.impulse < c->share * sqrt(s2));
    return at;
}

/* How the slip that an impact leaves differs where the slip before it differs by `d` and the fall by dfalls. */
static void rub(const fst_world_double *c, const impact *at, const double d[2], double dfalls, double out[2])
{
    const fst_coulomb_double *law = &c->law.coulomb;
    const double *v = at->slip, s2 = v[0] * v[0] + v[1] * v[1], s = sqrt(s2), more = 1.0 + law->restitution;
    out[0] = out[1] = 0.0;
    if (at->stops)
        return;
    const double along = (v[0] * d[0] + v[1] * d[1]) / s2;
    const double dimpulse = more * (fst_coulomb_mu_double(law, s2) * dfalls +
                                    2.0 * s2 * along * fst_coulomb_mu_by_s2_double(law, s2) * at->falls);
    const double dleft = -c->yielding * (dimpulse - at->impulse * along) / s;
    for (int i = 0; i < 2; ++i)
        out[i] = at->left * d[i] + dleft * v[i];
}

/* The state that an impact leaves in another setup, at the same slip before it. */
static void impact_in(const fst_world_double *c, const fst_world_double *other, const double *y, double *after)
{
    double change[2];
    memcpy(after, y, FST_NUMBERS * sizeof *after);
    same_slip(c, other, y, change);
    after[FST_VX] += change[0];
    after[FST_VY] += change[1];
    const impact at = impact_at(other, after);
    fst_set_slip_double(other, after, (const double[2]){at.left * at.slip[0], at.left * at.slip[1]});
    after[FST_CLIMB] = other->law.coulomb.restitution * at.falls;
}

/* The neighbours come down when they do, not when the motion does; their clocks stay off by that. */
static void come_down(fst_neighbours *b, const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const double *y = flow->step.end;
    const impact at = impact_at(c, y);
    double w[FST_NUMBERS], seen[FST_NUMBERS], slip[2], rubbed[2], after[2][FST_NUMBERS];
    rate_in(flow, FST_MODE_FLIGHT, fst_contact_roll(flow), w);
    for (int column = 0; column < b->count; ++column) {
        double *d = b->d[column];
        const double dt = at.falls > 0.0 ? d[FST_HEIGHT] / at.falls : 0.0;
        for (int i = 0; i < FST_NUMBERS; ++i)
            d[i] += dt * w[i];
        d[FST_STEP_TIME] += dt;
        d[FST_HEIGHT] = 0.0;
        neighbour(b, c, y, column, d, seen);
        fst_slip_double(c, seen, slip);
        rub(c, &at, slip, -d[FST_CLIMB], rubbed);
        memcpy(d, seen, sizeof seen);
        fst_set_slip_double(c, d, rubbed);
        d[FST_CLIMB] *= -c->law.coulomb.restitution;
    }
    if (!differs(b))
        return;
    impact_in(c, &b->below, y, after[0]);
    impact_in(c, &b->above, y, after[1]);
    for (int i = 0; i < FST_NUMBERS; ++i)
        b->d[b->parameter][i] += (after[1][i] - after[0][i]) / b->spread;
}

/* A bead that was in the air touches the plate; where it stays down, `then` is the flow on the plate. */
static void touch(fst_neighbours *b, const fst_flow *flow, fst_flow *then)
{
    const int after = fst_contact_mode(then);
    double f[FST_NUMBERS];
    come_down(b, flow);
    if (after == FST_MODE_FLIGHT)
        return;
    for (int column = 0; column < b->count; ++column)
        b->d[column][FST_CLIMB] = 0.0;
    if (after == FST_MODE_SLIP) /* it goes on at equal theta */
        return;
    stop_slips(b, fst_flow_world(then), then->step.end);
    then->step.end[FST_STEP_TIME] = 0.0;
    rate_in(then, after, fst_contact_roll(then), f);
    shift(b, f, -1.0);
    forget_clocks(b);
}

/* ------------------------------------------------------------------ where any mode changes */

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
static void change_contact(fst_neighbours *b, const fst_flow *flow, fst_flow *then)
{
    const int before = fst_contact_mode(flow), after = fst_contact_mode(then);
    const fst_world_double *c = fst_flow_world(flow);
    const int jumps = c->law.coulomb.holding > fst_coulomb_mu_double(&c->law.coulomb, 0.0);
    if (before == FST_MODE_FLIGHT) {
        touch(b, flow, then);
    } else if (after == FST_MODE_FLIGHT) {
        leave(b, flow);
    } else if (before == FST_MODE_SLIP && after == FST_MODE_SLIP) { /* against a push that turns it round */
        stop_slips(b, c, flow->step.end);
    } else if (after == FST_MODE_CREEP) {
        catch_up(b, flow, flow);
        turn_slips(b, c, fst_flow_modes(then), then->step.omega, then->step.y);
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
    } else if (before != FST_MODE_STICK && after == FST_MODE_STICK) { /* an onset or a creep */
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

void fst_neighbours_start(fst_neighbours *b, fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    fst_creep_is_followed(flow);
    if (flow->contact.followed)
        fst_contact_begin_next(flow);
    for (int column = 0; column < b->count; ++column)
        memset(b->d[column] + FST_STATE_SIZE, 0, (FST_NUMBERS - FST_STATE_SIZE) * sizeof *b->d[column]);
    if (c->kinds.resists && fst_contact_roll(flow) != FST_ROLL_ROLLS)
        stop_rolling(b, c);
    if (fst_sticks_double(c, fst_flow_modes(flow)) > 0.5 || fst_contact_mode(flow) == FST_MODE_ONSET)
        stop_slips(b, c, flow->step.y);
    else if (fst_contact_mode(flow) == FST_MODE_CREEP)
        turn_slips(b, c, fst_flow_modes(flow), flow->step.omega, flow->step.y);
}

int fst_neighbours_known(const fst_flow *flow)
{
    const fst_world_double *c = fst_flow_world(flow);
    const int held = fst_contact_mode(flow) == FST_MODE_STICK || flow->contact.slip.next == FST_MODE_STICK;
    return !(c->kinds.patch && held) || c->law.coulomb.holding > fst_coulomb_mu_double(&c->law.coulomb, 0.0);
}

void fst_neighbours_change(fst_neighbours *b, const fst_flow *flow)
{
    if (fst_contact_changes(flow))
        change_mode(b, flow);
}

void fst_neighbours_follow(fst_neighbours *b, const fst_flow *flow)
{
    carry_along_step(b, flow);
    fst_neighbours_change(b, flow);
}

void fst_neighbours_at_equal_times(fst_neighbours *b, const fst_flow *flow)
{
    double f[FST_NUMBERS];
    if (!fst_flow_world(flow)->kinds.modes ||
        flow->contact.slip.next >= 0) /* where a mode just ended, the clocks were set, or must wait */
        return;
    rate_in(flow, fst_contact_mode(flow), fst_contact_roll(flow), f);
    shift(b, f, -1.0);
    forget_clocks(b);
}
